//! Tests that the program understands every command that a message, a help text or a guide names.

use chereme_tests::repository;
use clap::CommandFactory;
use clap::error::{ContextKind, ContextValue, ErrorKind};

use crate::args::Cli;

/// Splits a command into words as a shell does; placeholders of format strings become a word.
fn words(line: &str) -> Vec<String> {
    let mut plain = String::new();
    let mut open = false;
    for c in line.chars() {
        match c {
            '{' if !line.contains("\": ") => {
                open = true;
                plain.push('X');
            }
            '}' if open => open = false,
            _ if open => {}
            _ => plain.push(c),
        }
    }
    let (mut words, mut word, mut quote, mut any) = (Vec::new(), String::new(), None, false);
    for c in plain.chars() {
        match (quote, c) {
            (Some(end), c) if c == end => quote = None,
            (None, '\'' | '"') => (quote, any) = (Some(c), true),
            (None, c) if c.is_whitespace() => {
                if any || !word.is_empty() {
                    words.push(std::mem::take(&mut word));
                }
                any = false;
            }
            _ => word.push(c),
        }
    }
    if any || !word.is_empty() {
        words.push(word);
    }
    words
}

/// Returns the commands between backquotes in source code, without comments.
fn of_source(text: &str) -> Vec<String> {
    let joined = text.replace("\\\n", " ");
    let code = joined
        .lines()
        .filter(|line| !line.trim_start().starts_with("//!"));
    let mut found = Vec::new();
    for line in code {
        let inside = line.split('`').skip(1).step_by(2);
        let commands = inside.filter(|part| {
            let word = part.strip_prefix("chereme ");
            word.is_some_and(|it| it.starts_with(|c: char| c.is_ascii_lowercase()))
        });
        found.extend(commands.map(|it| it.replace("\\\"", "\"")));
        if let Some(example) = line.strip_prefix("  chereme ") {
            let example = example.split("   (").next().unwrap_or_default();
            let example = example.trim_end_matches("\")]").trim_end_matches("\";");
            found.push(format!("chereme {example}"));
        }
    }
    found
}

/// Returns the commands in the shell blocks of a guide.
fn of_guide(text: &str) -> Vec<String> {
    let lines = text
        .lines()
        .filter_map(|line| line.strip_prefix("chereme "));
    lines
        .filter(|line| !line.is_empty())
        .map(|line| format!("chereme {}", line.split(" #").next().unwrap_or_default()))
        .collect()
}

/// Returns whether the rejected value is a placeholder such as RECORDING.
fn is_of_a_placeholder(error: &clap::Error) -> bool {
    match error.get(ContextKind::InvalidValue) {
        Some(ContextValue::String(value)) => value.chars().all(|c| c.is_ascii_uppercase()),
        _ => false,
    }
}

fn fault(command: &str) -> Option<String> {
    let mut words = words(command);
    // The shell handles redirections.
    if let Some(end) = words
        .iter()
        .position(|word| ["|", ">", ">>", "<"].contains(&word.as_str()))
    {
        words.truncate(end);
    }
    let only_named = words.len() <= 3;
    let error = Cli::command().try_get_matches_from(&words).err()?;
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => None,
        ErrorKind::ValueValidation if is_of_a_placeholder(&error) => None,
        // A text may name a command without its arguments.
        ErrorKind::MissingRequiredArgument
        | ErrorKind::MissingSubcommand
        | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand
            if only_named =>
        {
            None
        }
        _ => Some(format!("{command}\n{error}")),
    }
}

#[test]
fn every_command_named_in_a_message_parses() {
    let mut found = Vec::new();
    for file in repository::rust_files() {
        if file.path.contains("/src/") && !file.path.ends_with("remedies.rs") {
            found.extend(of_source(&file.text));
        }
    }
    for file in repository::text_files() {
        if file.path.ends_with(".md") {
            found.extend(of_guide(&file.text));
        }
    }
    found.sort();
    found.dedup();
    assert!(found.len() > 60, "{} commands are found", found.len());
    let faults: Vec<String> = found.iter().filter_map(|command| fault(command)).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_remedy_with_an_unknown_command_is_noticed() {
    assert!(fault("chereme list CORPUS values --no-such-option x").is_some());
    assert!(fault("chereme dance").is_some());
    assert!(fault("chereme check CORPUS --mend").is_none());
    assert!(fault("chereme search {corpus} 'a b'").is_none());
    assert_eq!(
        words("chereme search X 'a b' \"c\""),
        ["chereme", "search", "X", "a b", "c"]
    );
}
