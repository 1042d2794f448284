//! The list of commands, with one module for each, and errors that all of them share.

mod agree;
mod animate;
mod annotate;
mod check;
mod choose;
mod completions;
mod consent;
mod cue;
mod cued;
mod delete;
mod demo;
mod diff;
mod export;
mod face;
mod fit;
mod history;
mod import;
mod inventory;
mod keys;
mod list;
mod map;
mod merge;
mod milestones;
mod new;
mod onsets;
mod pairs;
mod propose;
mod publish;
mod recombine;
mod render;
mod score;
mod search;
mod stats;
mod studio;
mod study;
mod suggest;
mod tiers;
mod track;
mod transcribe;
mod words;

use std::io::ErrorKind;
use std::process::ExitCode;

use anyhow::Result;
use chereme_corpus::Error;
use chereme_corpus::remedy::{Choice, Remedy};
use clap::Subcommand;

use crate::args::Cli;
use crate::output::Output;

/// Declares the commands: the name, the function that runs it with its options, and a change of its errors, if any.
macro_rules! commands {
    ($($name:ident => $module:ident::$run:ident($args:ident) $(or $mend:ident)?;)*) => {
        /// The commands.
        #[derive(Debug, Subcommand)]
        pub(crate) enum Command {
            $($name($module::$args),)*
        }

        /// Runs the command.
        pub(crate) fn run(cli: &Cli, output: &mut Output) -> Result<ExitCode> {
            match &cli.command {
                $(Command::$name(args) => $module::$run(cli, args, output).map(Ended::code)$(.map_err($mend))?,)*
            }
        }
    };
}

commands! {
    Demo => demo::run(Args);
    New => new::run(Args);
    Import => import::run(Args);
    Info => list::info(InfoArgs);
    List => list::list(Args);
    Annotate => annotate::run(Args);
    Delete => delete::run(Args);
    Inventory => inventory::run(Args);
    Track => track::run(Args);
    Fit => fit::run(Args);
    Search => search::run(Args);
    Recombine => recombine::run(Args);
    Animate => animate::run(Args);
    Render => render::run(Args) or offer_force;
    Score => score::run(Args) or offer_force;
    Face => face::run(Args);
    Milestones => milestones::run(Args);
    Choose => choose::run(Args);
    Onsets => onsets::run(Args) or offer_force;
    Suggest => suggest::run(Args);
    Pairs => pairs::run(Args);
    Stats => stats::run(Args) or offer_force;
    Agree => agree::run(Args) or offer_force;
    Map => map::run(Args) or offer_force;
    Transcribe => transcribe::run(Args);
    Cue => cue::run(Args);
    Cued => cued::run(Args);
    Propose => propose::run(Args);
    Keys => keys::run(Args);
    Check => check::run(Args) or past_checking;
    Diff => diff::run(Args);
    Merge => merge::merge(MergeArgs);
    Conflicts => merge::conflicts(ConflictsArgs);
    Study => study::run(Args) or offer_force;
    Export => export::run(Args) or offer_force;
    Consent => consent::run(Args);
    Publish => publish::run(Args);
    Undo => history::undo(UndoArgs);
    Redo => history::redo(RedoArgs);
    Log => history::log(LogArgs);
    Words => words::run(Args);
    Completions => completions::run(Args);
    Man => completions::man(ManArgs);
    Studio => studio::run(Args);
}

/// The result of a command that did its work.
trait Ended {
    fn code(self) -> ExitCode;
}

impl Ended for () {
    fn code(self) -> ExitCode {
        ExitCode::SUCCESS
    }
}

impl Ended for ExitCode {
    fn code(self) -> ExitCode {
        self
    }
}

/// Replaces the remedy `chereme check` by another one if that command itself fails on damage.
fn past_checking(error: anyhow::Error) -> anyhow::Error {
    match error.downcast_ref::<Error>() {
        Some(known) if matches!(known.remedy(), Some(Remedy::Choice(Choice::Check, _))) => {
            let place = known.place().unwrap_or_default();
            Error::wrong(known.to_string())
                .at(place)
                .advise(Remedy::command("the check cannot go on: take a backup, or save what can be read with `chereme export CORPUS all --to FOLDER`"))
                .into()
        }
        _ => error,
    }
}

/// Adds the option `--force` to the remedy for an existing file, for commands that have this option.
fn offer_force(error: anyhow::Error) -> anyhow::Error {
    match error.downcast_ref::<Error>() {
        Some(Error::File { path, source }) if source.kind() == ErrorKind::AlreadyExists => {
            Error::wrong(format!(
                "{}: something of this name is there already",
                path.display()
            ))
            .at(path.display().to_string())
            .advise("choose another name, or write over it with --force")
            .into()
        }
        _ => error,
    }
}
