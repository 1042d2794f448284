//! The commands, one module each.

mod check;
mod history;
mod import;
mod new;
mod recombine;
mod render;
mod score;
mod search;
mod suggest;

use std::process::ExitCode;

use anyhow::Result;
use clap::Subcommand;

use crate::args::Cli;
use crate::output::Output;

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    New(new::Args),
    Import(import::Args),
    Search(search::Args),
    Recombine(recombine::Args),
    Render(render::Args),
    Score(score::Args),
    Suggest(suggest::Args),
    Check(check::Args),
    Undo(history::UndoArgs),
    Redo(history::RedoArgs),
    Log(history::LogArgs),
}

/// Runs the command.
pub(crate) fn run(cli: &Cli, output: &mut Output) -> Result<ExitCode> {
    match &cli.command {
        Command::New(args) => new::run(cli, args, output),
        Command::Import(args) => return import::run(cli, args, output),
        Command::Check(args) => return check::run(cli, args, output),
        Command::Score(args) => score::run(cli, args, output),
        Command::Suggest(args) => suggest::run(cli, args, output),
        Command::Search(args) => search::run(cli, args, output),
        Command::Recombine(args) => recombine::run(cli, args, output),
        Command::Render(args) => render::run(cli, args, output),
        Command::Undo(args) => history::undo(cli, args, output),
        Command::Redo(args) => history::redo(cli, args, output),
        Command::Log(args) => history::log(cli, args, output),
    }?;
    Ok(ExitCode::SUCCESS)
}
