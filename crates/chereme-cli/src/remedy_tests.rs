//! Tests that the program understands every command that a message, a help text or a guide names.

use chereme_tests::repository;
use clap::CommandFactory;
use clap::error::{ContextKind, ContextValue, ErrorKind};

use crate::args::CommandLine;

/// Splits a command into words as a shell does; placeholders of format strings become a word.
fn split_command_words(line: &str) -> Vec<String> {
    let mut plain = String::new();
    let mut open = false;
    for c in line.chars() {
        match c {
            // A brace before a quoted key is JSON that the command takes, and no blank of a format.
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
    let code = joined.lines().filter(|line| !line.trim_start().starts_with("//!"));
    let mut named_commands = Vec::new();
    for line in code {
        let inside = line.split('`').skip(1).step_by(2);
        let commands = inside.filter(|part| {
            let word = part.strip_prefix("chereme ");
            word.is_some_and(|first_word| first_word.starts_with(|c: char| c.is_ascii_lowercase()))
        });
        named_commands.extend(commands.map(|command| command.replace("\\\"", "\"")));
        if let Some(example) = line.strip_prefix("  chereme ") {
            let example_text = example.split("   (").next().unwrap_or_default();
            let example = example_text.trim_end_matches("\")]").trim_end_matches("\";");
            named_commands.push(format!("chereme {example}"));
        }
    }
    named_commands
}

/// Returns the commands in the shell blocks of a guide.
fn of_guide(text: &str) -> Vec<String> {
    let lines = text.lines().filter_map(|line| line.strip_prefix("chereme "));
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

fn find_remedy_fault(command: &str) -> Option<String> {
    let mut words = split_command_words(command);
    // The shell handles redirections.
    if let Some(end) = words
        .iter()
        .position(|word| ["|", ">", ">>", "<"].contains(&word.as_str()))
    {
        words.truncate(end);
    }
    let only_named = words.len() <= 3;
    let error = CommandLine::command().try_get_matches_from(&words).err()?;
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
pub(crate) fn source_string_literals(text: &str) -> Vec<(String, String)> {
    let text = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = text.lines().map(str::trim_start);
    let code_lines: Vec<&str> = lines.filter(|line| !line.starts_with("//")).collect();
    let code = code_lines.join(" ").replace("'\"'", "' '").replace("\\\\", "  ");
    let code = code.replace("\\\"", "'");
    let mut pairs = Vec::new();
    let mut before = String::new();
    for (index, part) in code.split('"').enumerate() {
        match index % 2 {
            0 => part.clone_into(&mut before),
            _ => pairs.push((before.clone(), part.replace("\\ ", ""))),
        }
    }
    pairs
}

/// Returns whether a text names a command of the program, or an option of one.
fn names_the_command_line(text: &str) -> bool {
    let option = |word: &str| {
        let word = word.trim_start_matches(['(', '`']);
        word.strip_prefix("--")
            .is_some_and(|first_word| first_word.starts_with(|c: char| c.is_ascii_lowercase()))
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
        for (before, text) in source_string_literals(&file.text) {
            let trimmed_before = before.trim_end().trim_end_matches("format!(").trim_end();
            let opened = trimmed_before.trim_end_matches("Cow::Borrowed(").trim_end();
            let choice = opened
                .trim_end_matches(',')
                .rsplit("ErrorRemedy::choice_remedy(")
                .next();
            let of_choice = choice.is_some_and(|opening| opening.trim().starts_with("RemedyChoice::"));
            let is_typed = opened.ends_with("ErrorRemedy::command_remedy(")
                || opened.ends_with(".with_command_advice(")
                || opened.ends_with("ErrorRemedy::Command(")
                || of_choice && choice.is_some_and(|opening| !opening.contains(';'));
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
    let mut named_commands = Vec::new();
    for file in repository::rust_files() {
        if file.path.contains("/src/") && !file.path.ends_with("remedy_tests.rs") {
            named_commands.extend(of_source(&file.text));
        }
    }
    for file in repository::text_files() {
        if file.path.ends_with(".md") {
            named_commands.extend(of_guide(&file.text));
        }
    }
    named_commands.sort();
    named_commands.dedup();
    assert!(named_commands.len() > 60, "{} commands are found", named_commands.len());
    let faults: Vec<String> = named_commands
        .iter()
        .filter_map(|command| find_remedy_fault(command))
        .collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_remedy_with_an_unknown_command_is_noticed() {
    assert!(find_remedy_fault("chereme list CORPUS values --no-such-option x").is_some());
    assert!(find_remedy_fault("chereme dance").is_some());
    assert!(find_remedy_fault("chereme check CORPUS --mend").is_none());
    assert!(find_remedy_fault("chereme search {corpus} 'a b'").is_none());
    assert_eq!(
        split_command_words("chereme search X 'a b' \"c\""),
        ["chereme", "search", "X", "a b", "c"]
    );
}
