//! The help of the command line in French, found by its English form.

mod help;
pub(crate) mod kinds;
mod titles;

use chereme_corpus::words::{Language, Text, fill, guide, message};
use chereme_corpus::{TierRole, readable_files};
use clap::builder::StyledStr;
use clap::{Arg, ArgAction, Command};

pub(crate) use titles::title;

/// The phrases of clap, as English and French.
const FRAME: [(&str, &str); 20] = [
    ("error: ", "erreur : "),
    ("  tip: ", "  conseil : "),
    ("unexpected argument ", "argument inattendu : "),
    ("unrecognized subcommand ", "commande inconnue : "),
    (
        "the following required arguments were not provided:",
        "il manque :",
    ),
    (" found\n", "\n"),
    (
        "a similar subcommand exists: ",
        "une commande semblable existe : ",
    ),
    (
        "a similar argument exists: ",
        "un argument semblable existe : ",
    ),
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
    (
        "For more information, try '--help'.",
        "Pour en savoir plus : '--help'.",
    ),
];

const TEMPLATE: &str = "\
{before-help}{about-with-newline}
Utilisation : {usage}

{all-args}{after-help}";

/// Returns the help of an option that takes the role of a tier.
pub(crate) fn roles(language: Language) -> String {
    let help = Text::new(
        "The subject of its annotations: {roles}, or a component such as right.placement or nonmanual.brows; the word \
         before the dot is their hand",
        "L’objet de ses annotations : {roles}, ou un composant comme right.placement ou nonmanual.brows ; le mot avant \
         le point est leur main",
    );
    fill(help.of(language), &[("roles", &TierRole::plain_kinds())])
}

/// Returns the command with its help in `language`; a text without French words stays English.
pub(crate) fn spoken(command: Command, language: Language) -> Command {
    match language {
        Language::English => command,
        Language::French => french(command),
    }
}

fn french(command: Command) -> Command {
    let about = command.get_about().map(translated);
    let long = command.get_long_about().map(translated);
    let after = command.get_after_help().map(translated);
    let after_long = command.get_after_long_help().map(translated);
    let mut command = command
        .help_template(TEMPLATE)
        .subcommand_help_heading("Commandes ")
        .subcommand_value_name("COMMANDE")
        .disable_help_flag(true)
        .disable_version_flag(true)
        .disable_help_subcommand(true)
        .mut_args(argument)
        .mut_subcommands(french)
        .arg(flag(
            "help",
            'h',
            "Afficher l’aide ; -h en donne un résumé",
            ArgAction::Help,
        ))
        .arg(flag(
            "version",
            'V',
            "Afficher la version",
            ArgAction::Version,
        ));
    if let Some(about) = about {
        command = command.about(about);
    }
    if let Some(long) = long {
        command = command.long_about(long);
    }
    if let Some(after) = after {
        command = command.after_help(after);
    }
    if let Some(after) = after_long {
        command = command.after_long_help(after);
    }
    command
}

fn flag(name: &'static str, short: char, help: &'static str, action: ArgAction) -> Arg {
    Arg::new(name)
        .short(short)
        .long(name)
        .action(action)
        .help(help)
        .help_heading("Options ")
}

/// Returns an argument with its help in French, with its possible values and its default, which clap would introduce in
/// English.
fn argument(argument: Arg) -> Arg {
    let heading = match argument.is_positional() {
        true => "Arguments ",
        false => "Options ",
    };
    let values = values(&argument);
    let explained = values.iter().any(|(_, help)| help.is_some());
    let names: Vec<&str> = values.iter().map(|(name, _)| name.as_str()).collect();
    let mut short = argument.get_help().map(translated);
    let mut long = argument.get_long_help().map(translated);
    if explained {
        let text = long.take().or_else(|| short.clone()).unwrap_or_default();
        long = Some(format!(
            "{text}\n\nValeurs possibles :\n{}",
            listed(&values)
        ));
    }
    let defaults =
        match argument.get_action().takes_values() && !argument.is_hide_default_value_set() {
            true => argument.get_default_values(),
            false => &[],
        };
    let defaults: Vec<_> = defaults.iter().map(|it| it.to_string_lossy()).collect();
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
fn values(argument: &Arg) -> Vec<(String, Option<String>)> {
    if argument.is_hide_possible_values_set() || !argument.get_action().takes_values() {
        return Vec::new();
    }
    let all = argument.get_possible_values().into_iter();
    let shown = all.filter(|value| !value.is_hide_set());
    shown
        .map(|value| {
            (
                value.get_name().to_owned(),
                value.get_help().map(translated),
            )
        })
        .collect()
}

/// Returns values as lines, with their help.
fn listed(values: &[(String, Option<String>)]) -> String {
    let line = |(name, help): &(String, Option<String>)| match help {
        Some(help) => format!("- {name} : {help}"),
        None => format!("- {name}"),
    };
    values.iter().map(line).collect::<Vec<_>>().join("\n")
}

/// Returns a text of the help in French, paragraph by paragraph, and guides line by line; one without French words stays
/// English.
fn translated(text: &StyledStr) -> String {
    let text = text.to_string();
    if let Some(french) = help::of(&text) {
        return french.to_owned();
    }
    let paragraph = |text: &str| {
        let lists = [readable_files, roles];
        if let Some(list) = lists.iter().find(|list| list(Language::English) == text) {
            return list(Language::French);
        }
        let known = help::of(text).or_else(|| help::of(text.trim_end_matches('.')));
        known.map_or_else(|| guide(text, Language::French), str::to_owned)
    };
    let all: Vec<String> = text.split("\n\n").map(paragraph).collect();
    all.join("\n\n")
}

/// Returns the message of clap about wrong usage in French.
pub(crate) fn usage(text: &str) -> String {
    let mut message = text.to_owned();
    for (english, french) in FRAME {
        message = message.replace(english, french);
    }
    let lines: Vec<String> = message.trim_end().lines().map(with_reason).collect();
    lines.join("\n")
}

/// Puts the reason for which a value was refused, at the end of a line of clap, into French.
fn with_reason(line: &str) -> String {
    let translated = line.rsplit_once("': ").and_then(|(head, reason)| {
        let reason = message(reason, Language::French)?;
        Some(format!("{head}' : {reason}"))
    });
    translated.unwrap_or_else(|| line.to_owned())
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::args::Cli;
    use clap::CommandFactory;

    /// Returns every text of the help, first paragraphs only.
    fn texts(command: &Command, into: &mut BTreeSet<String>) {
        let mut take = |text: Option<&StyledStr>| {
            let text = text.map(ToString::to_string).unwrap_or_default();
            let first = text.split("\n\n").next().unwrap_or_default();
            if !first.is_empty() {
                into.insert(first.to_owned());
            }
        };
        take(command.get_about());
        for argument in command.get_arguments() {
            take(argument.get_help());
            for value in argument.get_possible_values() {
                take(value.get_help());
            }
        }
        for command in command.get_subcommands() {
            texts(command, into);
        }
    }

    #[test]
    fn nearly_all_help_has_a_french_form() {
        let mut all = BTreeSet::new();
        texts(&Cli::command(), &mut all);
        let missing: Vec<&String> = all.iter().filter(|text| help::of(text).is_none()).collect();
        // Options that are newer than the translation are shown in English.
        assert!(
            missing.len() * 5 < all.len(),
            "{} of {} are not there:\n{missing:#?}",
            missing.len(),
            all.len()
        );
        for command in Cli::command().get_subcommands() {
            let about = command
                .get_about()
                .map(ToString::to_string)
                .unwrap_or_default();
            assert!(help::of(&about).is_some(), "{about}");
        }
    }

    #[test]
    fn the_help_is_french_if_french_is_requested() {
        let mut command = spoken(Cli::command(), Language::French);
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
        let mut annotate = command
            .find_subcommand("annotate")
            .expect("annotate")
            .clone();
        for help in [annotate.render_help(), annotate.render_long_help()] {
            let help = help.to_string();
            let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(
                help.contains("bulldozer") && help.contains("[défaut : normal]"),
                "{help}"
            );
            for english in [
                "default:",
                "ossible values",
                "Options:",
                "Arguments:",
                "<COMMAND>",
            ] {
                assert!(!help.contains(english), "{english}: {help}");
            }
        }
        let add = annotate.find_subcommand_mut("add-tier").expect("add-tier");
        let help = add.render_help().to_string();
        let flat = help.split_whitespace().collect::<Vec<_>>().join(" ");
        let part = format!(
            "L’objet de ses annotations : {}, ou",
            TierRole::plain_kinds()
        );
        assert!(flat.contains(&part), "{help}");
        let mut import = command.find_subcommand("import").expect("import").clone();
        let long = import.render_long_help().to_string();
        let flat = long.split_whitespace().collect::<Vec<_>>().join(" ");
        for part in [
            "Fichiers lus : ",
            ".eaf (annotations)",
            "Un film est lié",
            "déjà importé",
        ] {
            assert!(flat.contains(part), "{part}: {long}");
        }
        let mut undo = command.find_subcommand("undo").expect("undo").clone();
        let long = undo.render_long_help().to_string();
        let flat: Vec<&str> = long.split_whitespace().collect();
        let flat = flat.join(" ");
        assert!(
            flat.contains("Toute modification peut être annulée"),
            "{long}"
        );
        let error = command
            .try_get_matches_from(["chereme", "dance"])
            .expect_err("no command");
        let said = usage(&error.render().to_string());
        assert!(
            said.starts_with("erreur : commande inconnue : 'dance'"),
            "{said}"
        );
    }
}
