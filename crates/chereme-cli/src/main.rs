//! The terminal skin: the binary `chereme`.
//!
//! Every command is an argument struct whose words are its help, a call of `chereme-corpus`, and
//! printing: a table for people, or with `--json` one document for programs.

mod args;
mod commands;
mod output;

use std::process::ExitCode;

use clap::Parser;

use args::Cli;
use output::Output;

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return output::usage(&error, std::env::args().any(|arg| arg == "--json")),
    };
    let mut output = Output::new(cli.json);
    chereme_corpus::on_waiting(output::waiting);
    let done = commands::run(&cli, &mut output).and_then(|code| output.finish().map(|()| code));
    match done {
        Ok(code) => code,
        Err(error) => output.fail(&error),
    }
}
