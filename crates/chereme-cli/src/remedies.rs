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

/// Returns the string literals of source code without its tests, each with the code directly before it.
pub(crate) fn literals(text: &str) -> Vec<(String, String)> {
    let text = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = text.lines().map(str::trim_start);
    let code: Vec<&str> = lines.filter(|line| !line.starts_with("//")).collect();
    let code = code.join(" ").replace("'\"'", "' '").replace("\\\\", "  ");
    let code = code.replace("\\\"", "'");
    let mut found = Vec::new();
    let mut before = String::new();
    for (index, part) in code.split('"').enumerate() {
        match index % 2 {
            0 => part.clone_into(&mut before),
            _ => found.push((before.clone(), part.replace("\\ ", ""))),
        }
    }
    found
}

/// Returns whether a text names a command of the program, or an option of one.
fn names_the_command_line(text: &str) -> bool {
    let option = |word: &str| {
        let word = word.trim_start_matches(['(', '`']);
        word.strip_prefix("--")
            .is_some_and(|it| it.starts_with(|c: char| c.is_ascii_lowercase()))
    };
    // A literal that is nothing but an option is an argument for another program.
    text.contains("`chereme ") || text.contains(' ') && text.split_whitespace().any(option)
}

#[test]
fn remedies_of_the_command_line_are_typed_as_such() {
    let skins = ["crates/chereme-cli/", "crates/chereme-studio/"];
    let (mut typed, mut faults) = (0, Vec::new());
    for file in repository::rust_files() {
        let words = file.path.contains("/words/") || file.path.contains("/tests");
        let library = file.path.contains("/src/") && !words;
        if !library || skins.iter().any(|skin| file.path.starts_with(skin)) {
            continue;
        }
        for (before, text) in literals(&file.text) {
            let opened = before.trim_end().trim_end_matches("format!(").trim_end();
            let opened = opened.trim_end_matches("Cow::Borrowed(").trim_end();
            let choice = opened
                .trim_end_matches(',')
                .rsplit("Remedy::choice(")
                .next();
            let of_choice = choice.is_some_and(|it| it.trim().starts_with("Choice::"));
            let is_typed = opened.ends_with("Remedy::command(")
                || opened.ends_with("Remedy::Command(")
                || of_choice && choice.is_some_and(|it| !it.contains(';'));
            match names_the_command_line(&text) {
                true if is_typed => typed += 1,
                true => faults.push(format!("{}: {text}", file.path)),
                false => {}
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(typed > 80, "{typed} typed remedies are found");
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
