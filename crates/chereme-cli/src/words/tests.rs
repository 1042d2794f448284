//! Tests that everything that the command line prints has a French form.

use std::collections::BTreeMap;

use super::*;
use crate::{args::CommandLine, remedy_tests};
use chereme_corpus::words::has_message;
use chereme_tests::repository;
use clap::CommandFactory;

/// Returns the texts of a command's help that need French, each with the place where it stands.
fn texts(command: &Command, into: &mut BTreeMap<String, String>) {
    let mut take = |place: &str, text: Option<&StyledStr>| {
        let text = text.map(ToString::to_string).unwrap_or_default();
        for paragraph in text.split("\n\n").filter(|it| !it.trim().is_empty()) {
            into.insert(paragraph.to_owned(), format!("{}, {place}", command.get_name()));
        }
    };
    take("about", command.get_about());
    take("about", command.get_long_about());
    for argument in command.get_arguments() {
        let name = argument.get_id().as_str();
        take(name, argument.get_help());
        take(name, argument.get_long_help());
        for value in argument.get_possible_values() {
            take(name, value.get_help());
        }
    }
    for command in command.get_subcommands() {
        texts(command, into);
    }
}

#[test]
fn all_help_has_a_french_form() {
    let mut all = BTreeMap::new();
    texts(&CommandLine::command(), &mut all);
    assert!(all.len() > 300, "{} texts are found", all.len());
    let french = |text: &str| translate_help_text(&StyledStr::from(text.to_owned()), InterfaceLanguage::French);
    let missing = all.iter().filter(|(text, _)| french(text) == **text);
    let missing: Vec<String> = missing.map(|(text, place)| format!("{place}: {text}")).collect();
    assert!(missing.is_empty(), "{}\n{}", missing.len(), missing.join("\n"));
}

/// Returns the guides below the help of commands, each with the name of its command.
fn guides(command: &Command, into: &mut Vec<(String, String)>) {
    for text in [command.get_after_help(), command.get_after_long_help()]
        .into_iter()
        .flatten()
    {
        into.push((command.get_name().to_owned(), text.to_string()));
    }
    for command in command.get_subcommands() {
        guides(command, into);
    }
}

#[test]
fn every_note_behind_an_example_has_a_french_form() {
    let (mut all, mut missing, mut notes) = (Vec::new(), Vec::new(), 0);
    guides(&CommandLine::command(), &mut all);
    for (name, text) in &all {
        let french = translate_help_text(&StyledStr::from(text.clone()), InterfaceLanguage::French);
        assert_eq!(french.lines().count(), text.lines().count(), "{name}");
        for (line, french) in text.lines().zip(french.lines()) {
            let is_note = line.ends_with(')') && line.contains("  (") || !line.starts_with(' ');
            notes += usize::from(is_note);
            if is_note && !line.is_empty() && line == french {
                missing.push(format!("{name}: {line}"));
            }
        }
    }
    assert!(notes > 20, "{notes} notes are found");
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

#[test]
fn every_line_and_error_of_a_command_has_a_french_form() {
    let opened = [
        ".write_output_line(",
        ".filled_line(",
        "bail!(",
        "anyhow!(",
        "CorpusError::from_wrong_message(",
        ".write_remedy(",
        ".with_advice(",
        ".with_command_advice(",
        "ErrorRemedy::command_remedy(",
        ".context(",
    ];
    let (mut found, mut missing) = (0, Vec::new());
    for file in repository::rust_files() {
        if !file.path.starts_with("crates/chereme-cli/src/") || file.path.contains("/words") {
            continue;
        }
        for (before, text) in remedy_tests::source_string_literals(&file.text) {
            let before = before.trim_end().trim_end_matches("format!(").trim_end();
            if !opened.iter().any(|it| before.ends_with(it)) {
                continue;
            }
            let is_line = before.ends_with(".filled_line(");
            let has_line = is_line && has_message(&text, InterfaceLanguage::French);
            let text = filled(&text);
            // An address such as recording:7 is the same in both languages.
            let said = text.split_whitespace().filter(|it| !it.contains(":7"));
            let is_said = said
                .flat_map(|it| it.split(|c: char| !c.is_alphabetic()))
                .any(|it| it.len() > 1);
            found += usize::from(is_said);
            let is_known = match is_line {
                true => has_line,
                false => localized_message(text.trim_start(), InterfaceLanguage::French).is_some(),
            };
            if is_said && !is_known {
                missing.push(format!("{}: {text}", file.path));
            }
        }
    }
    assert!(found > 150, "{found} lines are found");
    assert!(missing.is_empty(), "{}\n{}", missing.len(), missing.join("\n"));
}

/// Returns the text of a format string with a number in each of its blanks.
fn filled(form: &str) -> String {
    let mut text = String::new();
    let mut is_blank = false;
    for c in form.chars() {
        match c {
            '{' => is_blank = true,
            '}' => {
                is_blank = false;
                text.push('7');
            }
            _ if !is_blank => text.push(c),
            _ => {}
        }
    }
    text
}

#[test]
fn titles_are_french_if_french_is_requested() {
    assert_eq!(title("length", InterfaceLanguage::French), "durée");
    assert_eq!(title("length", InterfaceLanguage::English), "length");
    assert_eq!(title("offset_us", InterfaceLanguage::French), "offset_us");
}

#[test]
fn the_help_is_french_if_french_is_requested() {
    let mut command = translate_command_help(CommandLine::command(), InterfaceLanguage::French);
    command.clone().debug_assert();
    let help = command.render_help().to_string();
    assert!(
        help.contains("Utilisation : chereme") && help.contains("Commandes :"),
        "{help}"
    );
    assert!(
        help.contains("Afficher l’aide") && !help.contains("Print help"),
        "{help}"
    );
    assert!(help.contains("Annuler la dernière modification"), "{help}");
    let mut annotate = command.find_subcommand("annotate").expect("annotate").clone();
    for help in [annotate.render_help(), annotate.render_long_help()] {
        let help = help.to_string();
        let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            help.contains("bulldozer") && help.contains("[défaut : normal]"),
            "{help}"
        );
        for english in ["default:", "ossible values", "Options:", "Arguments:", "<COMMAND>"] {
            assert!(!help.contains(english), "{english}: {help}");
        }
    }
    let add = annotate.find_subcommand_mut("add-tier").expect("add-tier");
    let help = add.render_help().to_string();
    let flat = help.split_whitespace().collect::<Vec<_>>().join(" ");
    let part = format!("L’objet de ses annotations : {}, ou", TierRole::plain_kinds());
    assert!(flat.contains(&part), "{help}");
    let mut import = command.find_subcommand("import").expect("import").clone();
    let long = import.render_long_help().to_string();
    let flat = long.split_whitespace().collect::<Vec<_>>().join(" ");
    for part in [
        "Fichiers lus : ",
        ".eaf (annotations)",
        "un film qu’un .eaf nomme",
        "déjà importé",
    ] {
        assert!(flat.contains(part), "{part}: {long}");
    }
    let mut undo = command.find_subcommand("undo").expect("undo").clone();
    let long = undo.render_long_help().to_string();
    let flat: Vec<&str> = long.split_whitespace().collect();
    let flat = flat.join(" ");
    assert!(flat.contains("Toute modification peut être annulée"), "{long}");
    let error = command
        .try_get_matches_from(["chereme", "dance"])
        .expect_err("no command");
    let said = french_usage_message(&error.render().to_string());
    assert!(said.starts_with("erreur : commande inconnue : 'dance'"), "{said}");
}
