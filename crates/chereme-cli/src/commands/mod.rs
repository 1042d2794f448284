//! The list of commands, with one module for each, and errors that all of them share.

mod animate;
mod annotate;
mod check;
mod choose;
mod completions;
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
mod recombine;
mod render;
mod score;
mod search;
mod studio;
mod suggest;
mod tiers;
mod track;
mod transcribe;

use std::io::ErrorKind;
use std::process::ExitCode;

use anyhow::Result;
use chereme_corpus::Error;
use chereme_corpus::remedy::{Choice, Remedy};
use clap::Subcommand;

use crate::args::Cli;
use crate::output::Output;

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Demo(demo::Args),
    New(new::Args),
    Import(import::Args),
    Info(list::InfoArgs),
    List(list::Args),
    Annotate(annotate::Args),
    Delete(delete::Args),
    Inventory(inventory::Args),
    Track(track::Args),
    Fit(fit::Args),
    Search(search::Args),
    Recombine(recombine::Args),
    Animate(animate::Args),
    Render(render::Args),
    Score(score::Args),
    Face(face::Args),
    Milestones(milestones::Args),
    Choose(choose::Args),
    Onsets(onsets::Args),
    Suggest(suggest::Args),
    Pairs(pairs::Args),
    Map(map::Args),
    Transcribe(transcribe::Args),
    Cue(cue::Args),
    Cued(cued::Args),
    Propose(propose::Args),
    Keys(keys::Args),
    Check(check::Args),
    Diff(diff::Args),
    Merge(merge::MergeArgs),
    Conflicts(merge::ConflictsArgs),
    Export(export::Args),
    Undo(history::UndoArgs),
    Redo(history::RedoArgs),
    Log(history::LogArgs),
    Completions(completions::Args),
    Man(completions::ManArgs),
    Studio(studio::Args),
}

/// Runs the command.
pub(crate) fn run(cli: &Cli, output: &mut Output) -> Result<ExitCode> {
    match &cli.command {
        Command::Demo(args) => demo::run(cli, args, output),
        Command::Info(args) => list::info(cli, args, output),
        Command::List(args) => list::list(cli, args, output),
        Command::Annotate(args) => annotate::run(cli, args, output),
        Command::Delete(args) => delete::run(cli, args, output),
        Command::Inventory(args) => inventory::run(cli, args, output),
        Command::Export(args) => export::run(cli, args, output).map_err(offer_force),
        Command::New(args) => new::run(cli, args, output),
        Command::Import(args) => return import::run(cli, args, output),
        Command::Diff(args) => return diff::run(cli, args, output),
        Command::Merge(args) => merge::merge(cli, args, output),
        Command::Conflicts(args) => merge::conflicts(cli, args, output),
        Command::Check(args) => return check::run(cli, args, output).map_err(past_checking),
        Command::Score(args) => score::run(cli, args, output).map_err(offer_force),
        Command::Face(args) => face::run(cli, args, output),
        Command::Milestones(args) => milestones::run(cli, args, output),
        Command::Onsets(args) => onsets::run(cli, args, output).map_err(offer_force),
        Command::Choose(args) => choose::run(cli, args, output),
        Command::Suggest(args) => suggest::run(cli, args, output),
        Command::Pairs(args) => pairs::run(cli, args, output),
        Command::Map(args) => map::run(cli, args, output).map_err(offer_force),
        Command::Transcribe(args) => transcribe::run(cli, args, output),
        Command::Cue(args) => cue::run(cli, args, output),
        Command::Cued(args) => cued::run(cli, args, output),
        Command::Propose(args) => propose::run(cli, args, output),
        Command::Keys(args) => keys::run(cli, args, output),
        Command::Track(args) => track::run(cli, args, output),
        Command::Fit(args) => fit::run(cli, args, output),
        Command::Search(args) => search::run(cli, args, output),
        Command::Recombine(args) => recombine::run(cli, args, output),
        Command::Animate(args) => animate::run(cli, args, output),
        Command::Render(args) => render::run(cli, args, output).map_err(offer_force),
        Command::Undo(args) => history::undo(cli, args, output),
        Command::Redo(args) => history::redo(cli, args, output),
        Command::Log(args) => history::log(cli, args, output),
        Command::Completions(args) => completions::run(args, output),
        Command::Man(args) => completions::man(args, output),
        Command::Studio(args) => return studio::run(cli, args),
    }?;
    Ok(ExitCode::SUCCESS)
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
