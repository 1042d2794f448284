//! The program `chereme`: parses the command line, runs a command, and reports its errors.
//!
//! Every command is an argument struct whose words are its help, a call of `chereme-corpus`, and
//! printing: a table for people, or with `--json` one document for programs.

mod args;
mod commands;
mod output;
#[cfg(test)]
mod remedy_tests;
mod streams;
mod table;
mod words;

use std::ffi::OsString;
use std::process::ExitCode;

use chereme_corpus::use_word_folder;
use clap::{CommandFactory, FromArgMatches};

use args::CommandLine;
use output::CommandOutput;

/// Returns the subcommands of the named command, if it has some and the words contain none of them.
fn missing_subcommands(words: &[OsString]) -> Vec<String> {
    let root_command = CommandLine::command();
    let named = words.iter().skip(1).filter_map(|word| word.to_str());
    let command = named.clone().find_map(|word| root_command.find_subcommand(word));
    let subcommands = command.into_iter().flat_map(clap::Command::get_subcommands);
    let actions: Vec<String> = subcommands.map(|subcommand| subcommand.get_name().to_owned()).collect();
    let is_known = named.clone().any(|word| actions.iter().any(|action| action == word));
    if is_known { Vec::new() } else { actions }
}

fn main() -> ExitCode {
    let mut words: Vec<_> = std::env::args_os().collect();
    // Needed before the arguments are parsed: errors of parsing are JSON too.
    let json = words.iter().any(|word| word == "--json");
    if let Some(folder) = std::env::var_os("CHEREME_WORDS").filter(|folder| !folder.is_empty())
        && let Err(error) = use_word_folder(folder.as_ref())
    {
        return CommandOutput::new(json, None, args::choose_language(None)).report_command_failure(&error.into());
    }
    let asked = args::take_language(&mut words);
    // The help of clap has to be in the right language before it parses.
    let language = args::choose_language(asked.as_deref());
    let parsed = words::translate_command_help(CommandLine::command(), language)
        .try_get_matches_from(&words)
        .and_then(|matches| CommandLine::from_arg_matches(&matches));
    let cli = match parsed {
        Ok(cli) => CommandLine { language: asked, ..cli },
        Err(error) => {
            return output::report_usage_error(&error, json, language, &missing_subcommands(&words));
        }
    };
    let mut output = CommandOutput::new(cli.json, cli.width, language);
    // A panic that the library catches and reports must not print a trace first.
    chereme_corpus::hide_handled_panics();
    chereme_corpus::on_waiting(output::print_waiting_note);
    // The buffered output is written even if the command's own code is a failure.
    let done = commands::run(&cli, &mut output).and_then(|code| output.finish_output().map(|()| code));
    match done {
        Ok(code) => code,
        Err(error) => output.report_command_failure(&error),
    }
}
