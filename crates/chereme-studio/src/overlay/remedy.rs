//! Remedies in the words of the window.

use chereme_corpus::remedy::{Choice, Remedy};

use crate::words::{Language, Text, import as words, shell, spoken, trouble};

/// Returns the remedy in the words of the window; `None` if only the command line offers one.
pub(crate) fn here(remedy: &Remedy, language: Language) -> Option<String> {
    match remedy {
        Remedy::Advice(text) => Some(spoken(text, language)),
        Remedy::Choice(choice, _) => Some(offered(*choice).of(language).to_owned()),
        Remedy::Command(_) => None,
    }
}

/// Returns the text for a choice, which names its place in the window.
fn offered(choice: Choice) -> Text {
    match choice {
        Choice::JointRoles => words::HELP_ROLES,
        Choice::RootOrder => words::HELP_ROOT,
        Choice::Unit => words::HELP_UNIT,
        Choice::Axes => words::HELP_AXES,
        Choice::TierRoles => words::HELP_TIERS,
        Choice::TiersLike => words::HELP_TEMPLATE,
        Choice::CommonAncestor => words::HELP_MERGE,
        Choice::Side => words::HELP_CHANGED,
        Choice::OtherCorpus => trouble::OTHER_CORPUS,
        Choice::Check => trouble::CHECK_HERE,
        Choice::Notation => shell::HELP_NOTATION,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_window_says_in_its_own_words_where_a_choice_is_offered() {
        let unit = Remedy::choice(Choice::Unit, "say the unit with --unit, such as --unit cm");
        for (language, begins) in [
            (Language::English, "Choose the unit"),
            (Language::French, "Choisissez l’unité"),
        ] {
            let shown = here(&unit, language).expect("a choice of the window");
            assert!(shown.starts_with(begins), "{shown}");
        }
    }

    #[test]
    fn advice_is_shown_as_it_is_and_commands_are_not() {
        let advice = Remedy::from("correct the number in the file");
        assert_eq!(
            here(&advice, Language::English).as_deref(),
            Some(advice.text())
        );
        let command = Remedy::command("`chereme list CORPUS tokens`");
        assert_eq!(here(&command, Language::English), None);
    }
}
