//! The French of the command line, found by its English form: help, lines and titles of tables.
//!
//! The French of a command lies in `schema/words/fr/command-NAME.ftl`, beside its English in `en`; that of several commands in
//! `commands.ftl`.

pub(crate) mod kinds;
#[cfg(test)]
mod tests;

use chereme_corpus::words::{InterfaceLanguage, InterfaceText, fill_text_braces, help_text, translate_guide};
use chereme_corpus::{TierRole, readable_files};
use clap::builder::StyledStr;
use clap::{Arg, ArgAction, Command};

pub(crate) use chereme_corpus::words::{column_title as title, localized_message};

/// The phrases of clap, as English and French.
const CLAP_PHRASES: [(&str, &str); 20] = [
    ("error: ", "erreur : "),
    ("  tip: ", "  conseil : "),
    ("unexpected argument ", "argument inattendu : "),
    ("unrecognized subcommand ", "commande inconnue : "),
    ("the following required arguments were not provided:", "il manque :"),
    (" found\n", "\n"),
    ("a similar subcommand exists: ", "une commande semblable existe : "),
    ("a similar argument exists: ", "un argument semblable existe : "),
    ("a similar value exists: ", "une valeur semblable existe : "),
    (
        "some similar subcommands exist: ",
        "des commandes semblables existent : ",
    ),
    ("invalid value ", "valeur incorrecte "),
    (" for '", " pour '"),
    ("a value is required for ", "il faut une valeur pour "),
    (" but none was supplied", ", et il n’y en a pas"),
    ("[possible values: ", "[valeurs possibles : "),
    ("[default: ", "[défaut : "),
    ("[subcommands: ", "[sous-commandes : "),
    (
        " requires a subcommand but one was not provided",
        " demande une sous-commande",
    ),
    ("Usage: ", "Utilisation : "),
    ("For more information, try '--help'.", "Pour en savoir plus : '--help'."),
];

const HELP_TEMPLATE: &str = "\
{before-help}{about-with-newline}
Utilisation : {usage}

{all-args}{after-help}";

/// Returns the help of an option that takes the role of a tier.
pub(crate) fn tier_roles_help(language: InterfaceLanguage) -> String {
    let help = InterfaceText::from_id("tier-role-help");
    fill_text_braces(help.text_in_language(language), &[("roles", &TierRole::plain_kinds())])
}

/// Returns the command with its help in `language`; a text without French words stays English.
pub(crate) fn translate_command_help(command: Command, language: InterfaceLanguage) -> Command {
    match language {
        InterfaceLanguage::English => command,
        InterfaceLanguage::French => with_french_frame(translated_command(command, language)),
        InterfaceLanguage::Other(_) => translated_command(command, language),
    }
}

/// Returns the command with the texts of its help in `language`.
fn translated_command(command: Command, language: InterfaceLanguage) -> Command {
    let spoken = |text: &StyledStr| translate_help_text(text, language);
    let argument = |argument: Arg| {
        // An absent text stays absent: clap shows nothing for it.
        let short = argument.get_help().map(spoken);
        let long = argument.get_long_help().map(spoken);
        let argument = short.into_iter().fold(argument, Arg::help);
        long.into_iter().fold(argument, Arg::long_help)
    };
    let about = command.get_about().map(spoken);
    let long = command.get_long_about().map(spoken);
    let after = command.get_after_help().map(spoken);
    let after_long = command.get_after_long_help().map(spoken);
    let titled_command = about.into_iter().fold(command, Command::about);
    let command = long.into_iter().fold(titled_command, Command::long_about);
    let annotated_command = after.into_iter().fold(command, Command::after_help);
    let command = after_long.into_iter().fold(annotated_command, Command::after_long_help);
    let subcommand = |command: Command| translated_command(command, language);
    command.mut_args(argument).mut_subcommands(subcommand)
}

/// Returns a command, whose texts are French, with the frame that clap gives them in French.
fn with_french_frame(command: Command) -> Command {
    command
        .help_template(HELP_TEMPLATE)
        .subcommand_help_heading("Commandes ")
        .subcommand_value_name("COMMANDE")
        // Clap's own flags are English; French ones replace them below.
        .disable_help_flag(true)
        .disable_version_flag(true)
        .disable_help_subcommand(true)
        .mut_args(argument)
        .mut_subcommands(with_french_frame)
        .arg(build_help_flag(
            "help",
            'h',
            "Afficher l’aide ; -h en donne un résumé",
            ArgAction::Help,
        ))
        .arg(build_help_flag(
            "version",
            'V',
            "Afficher la version",
            ArgAction::Version,
        ))
}

fn build_help_flag(name: &'static str, short: char, help: &'static str, action: ArgAction) -> Arg {
    Arg::new(name)
        .short(short)
        .long(name)
        .action(action)
        .help(help)
        .help_heading("Options ")
}

/// Returns an argument, whose help is French, with its possible values and its default, which clap would introduce in
/// English.
fn argument(argument: Arg) -> Arg {
    let heading = match argument.is_positional() {
        true => "Arguments ",
        false => "Options ",
    };
    let values = argument_value_help(&argument);
    let explained = values.iter().any(|(_, help)| help.is_some());
    let names: Vec<&str> = values.iter().map(|(name, _)| name.as_str()).collect();
    let mut short = argument.get_help().map(ToString::to_string);
    let mut long = argument.get_long_help().map(ToString::to_string);
    // Values with explanations need lines of their own, which only the long help has.
    if explained {
        let text = long.take().or_else(|| short.clone()).unwrap_or_default();
        long = Some(format!(
            "{text}\n\nValeurs possibles :\n{}",
            format_value_lines(&values)
        ));
    }
    let defaults = match argument.get_action().takes_values() && !argument.is_hide_default_value_set() {
        true => argument.get_default_values(),
        false => &[],
    };
    let defaults: Vec<_> = defaults.iter().map(|value| value.to_string_lossy()).collect();
    let mut notes = Vec::new();
    if !defaults.is_empty() {
        notes.push(format!("[défaut : {}]", defaults.join(", ")));
    }
    let of_short = match names.is_empty() {
        true => None,
        false => Some(format!("[valeurs possibles : {}]", names.join(", "))),
    };
    let of_long = of_short.clone().filter(|_| !explained);
    let noted = |text: Option<String>, own: Option<String>, blank: &str| {
        let all: Vec<String> = notes.iter().cloned().chain(own).collect();
        match (text, all.is_empty()) {
            (text, true) => text,
            (Some(text), false) => Some(format!("{text}{blank}{}", all.join(" "))),
            (None, false) => Some(all.join(" ")),
        }
    };
    short = noted(short, of_short, " ");
    if long.is_some() {
        long = noted(long, of_long, "\n\n");
    }
    let mut argument = argument.help_heading(heading);
    if argument.get_action().takes_values() {
        // Clap would add its own English notes.
        argument = argument.hide_possible_values(true).hide_default_value(true);
    }
    if let Some(help) = short {
        argument = argument.help(help);
    }
    if let Some(long) = long {
        argument = argument.long_help(long);
    }
    argument
}

/// Returns the possible values of an argument that its help shows, with their French help.
fn argument_value_help(argument: &Arg) -> Vec<(String, Option<String>)> {
    if argument.is_hide_possible_values_set() || !argument.get_action().takes_values() {
        return Vec::new();
    }
    let all = argument.get_possible_values().into_iter();
    let shown = all.filter(|value| !value.is_hide_set());
    shown
        .map(|value| {
            let english_help = value.get_help();
            let help = english_help.map(|text| translate_help_text(text, InterfaceLanguage::French));
            (value.get_name().to_owned(), help)
        })
        .collect()
}

/// Returns values as lines, with their help.
fn format_value_lines(values: &[(String, Option<String>)]) -> String {
    let line = |(name, help): &(String, Option<String>)| match help {
        Some(help) => format!("- {name} : {help}"),
        None => format!("- {name}"),
    };
    values.iter().map(line).collect::<Vec<_>>().join("\n")
}

/// Returns a text of the help in `language`, paragraph by paragraph, and guides line by line; one that the language lacks
/// stays English.
fn translate_help_text(text: &StyledStr, language: InterfaceLanguage) -> String {
    let text = text.to_string();
    let help = |english: &str| help_text(english, language);
    // A whole text is found more often than its paragraphs.
    if let Some(known) = help(&text) {
        return known.to_owned();
    }
    let paragraph = |text: &str| {
        let lists = [readable_files, tier_roles_help];
        if let Some(list) = lists.iter().find(|list| list(InterfaceLanguage::English) == text) {
            return list(language);
        }
        let known_help = help(text).or_else(|| help(text.trim_end_matches('.')));
        known_help.map_or_else(|| translate_guide(text, language), str::to_owned)
    };
    let all: Vec<String> = text.split("\n\n").map(paragraph).collect();
    all.join("\n\n")
}

/// Returns the message of clap about wrong usage in French.
pub(crate) fn french_usage_message(text: &str) -> String {
    let mut message = text.to_owned();
    // Replacing phrases is enough here: clap offers no translation of its messages.
    for (english, french) in CLAP_PHRASES {
        message = message.replace(english, french);
    }
    let lines: Vec<String> = message.trim_end().lines().map(with_reason).collect();
    lines.join("\n")
}

/// Puts the reason for which a value was refused, at the end of a line of clap, into French.
fn with_reason(line: &str) -> String {
    // The reason comes from this program and is in the table of messages.
    let translated = line.rsplit_once("': ").and_then(|(head, reason)| {
        let reason = localized_message(reason, InterfaceLanguage::French)?;
        Some(format!("{head}' : {reason}"))
    });
    translated.unwrap_or_else(|| line.to_owned())
}
