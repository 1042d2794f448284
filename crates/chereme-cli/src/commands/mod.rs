//! The list of commands, with one module for each, and errors that all of them share.

mod agree;
mod animate_command;
mod annotate;
mod check_command;
mod choose_command;
mod completions;
mod consent_command;
mod cue_command;
mod cued;
mod delete_command;
mod demo;
mod detect_command;
mod diff;
mod export_command;
mod face_command;
mod fit_command;
mod forget_command;
mod history_command;
mod import_command;
mod inventory_command;
mod keys_command;
mod lexicon_command;
mod list_command;
mod map_command;
mod merge_command;
mod milestones_command;
mod new;
mod onsets_command;
mod pairs_command;
mod people_command;
mod propose_command;
mod publish;
mod recombine_command;
mod render;
mod score_command;
mod search_command;
mod stats;
mod studio;
mod study;
mod suggest_command;
mod tiers_command;
mod track_command;
mod transcribe_command;
mod words_command;

use std::io::ErrorKind;
use std::process::ExitCode;

use anyhow::Result;
use chereme_corpus::CorpusError;
use chereme_corpus::remedy::{ErrorRemedy, RemedyChoice};
use clap::Subcommand;

use crate::args::CommandLine;
use crate::output::CommandOutput;

/// Declares the commands: the name, the function that runs it with its options, and a change of its errors, if any.
macro_rules! commands {
    ($($name:ident => $module:ident::$run:ident($args:ident) $(or $mend:ident)?;)*) => {
        /// The commands.
        #[derive(Debug, Subcommand)]
        pub(crate) enum Command {
            $($name($module::$args),)*
        }

        /// Runs the command.
        pub(crate) fn run(cli: &CommandLine, output: &mut CommandOutput) -> Result<ExitCode> {
            match &cli.command {
                $(Command::$name(args) => $module::$run(cli, args, output).map(FinishedCommand::command_exit_code)$(.map_err($mend))?,)*
            }
        }
    };
}

commands! {
    Demo => demo::run(DemoArgs);
    New => new::run(NewCorpusArgs);
    Import => import_command::run(ImportArgs);
    Info => list_command::show_corpus_info(InfoArgs);
    List => list_command::list_corpus_rows(ListArgs);
    Annotate => annotate::run(AnnotateArgs);
    Delete => delete_command::run(DeleteArgs);
    Forget => forget_command::run(ForgetArgs);
    People => people_command::run(PeopleArgs);
    Lexicon => lexicon_command::run(LexiconArgs);
    Inventory => inventory_command::run(InventoryArgs);
    Track => track_command::run(TrackArgs);
    Fit => fit_command::run(FitArgs);
    Search => search_command::run(SearchArgs);
    Recombine => recombine_command::run(RecombineArgs);
    Animate => animate_command::run(AnimateArgs);
    Render => render::run(RenderArgs) or offer_force;
    Score => score_command::run(ScoreArgs) or offer_force;
    Face => face_command::run(FaceArgs);
    Milestones => milestones_command::run(MilestonesArgs);
    Choose => choose_command::run(ChooseArgs);
    Onsets => onsets_command::run(OnsetsArgs) or offer_force;
    Suggest => suggest_command::run(SuggestArgs);
    Pairs => pairs_command::run(PairsArgs);
    Stats => stats::run(StatsArgs) or offer_force;
    Agree => agree::run(AgreeArgs) or offer_force;
    Map => map_command::run(MapArgs) or offer_force;
    Transcribe => transcribe_command::run(TranscribeArgs);
    Cue => cue_command::run(CueArgs);
    Cued => cued::run(CuedArgs);
    Propose => propose_command::run(ProposeArgs);
    Detect => detect_command::run(DetectArgs);
    Keys => keys_command::run(KeysArgs);
    Check => check_command::run(CheckArgs) or past_checking;
    Diff => diff::run(DiffArgs);
    Merge => merge_command::merge_corpora(MergeArgs);
    Conflicts => merge_command::list_or_decide_conflicts(ConflictsArgs);
    Study => study::run(StudyArgs) or offer_force;
    Export => export_command::run(ExportArgs) or offer_force;
    Consent => consent_command::run(ConsentArgs);
    Publish => publish::run(PublishArgs);
    Undo => history_command::undo_operations(UndoArgs);
    Redo => history_command::redo_operations(RedoArgs);
    Log => history_command::print_operation_log(LogArgs);
    Words => words_command::run(WordsArgs);
    Completions => completions::run(CompletionsArgs);
    Man => completions::write_man_pages(ManArgs);
    Studio => studio::run(StudioArgs);
}

/// The result of a command that did its work.
trait FinishedCommand {
    fn command_exit_code(self) -> ExitCode;
}

impl FinishedCommand for () {
    fn command_exit_code(self) -> ExitCode {
        ExitCode::SUCCESS
    }
}

impl FinishedCommand for ExitCode {
    fn command_exit_code(self) -> ExitCode {
        self
    }
}

/// Replaces the remedy `chereme check` by another one if that command itself fails on damage.
fn past_checking(error: anyhow::Error) -> anyhow::Error {
    match error.downcast_ref::<CorpusError>() {
        Some(known) if matches!(known.error_remedy(), Some(ErrorRemedy::Choice(RemedyChoice::Check, _))) => {
            let place = known.error_place().unwrap_or_default();
            CorpusError::from_wrong_message(known.to_string())
                .with_error_place(place)
                .with_command_advice("the check cannot go on: take a backup, or save what can be read with `chereme export CORPUS all --to FOLDER`")
                .into()
        }
        _ => error,
    }
}

/// Adds the option `--force` to the remedy for an existing file, for commands that have this option.
fn offer_force(error: anyhow::Error) -> anyhow::Error {
    match error.downcast_ref::<CorpusError>() {
        Some(CorpusError::File { path, source }) if source.kind() == ErrorKind::AlreadyExists => {
            CorpusError::from_wrong_message(format!("{}: something of this name is there already", path.display()))
                .with_error_place(path.display().to_string())
                .with_advice("choose another name, or write over it with --force")
                .into()
        }
        _ => error,
    }
}
