//! Remedies in terms of the window, as those of the corpus name options of the command line.

use crate::words::{Language, Text, import as words, shell, spoken};

/// Parts of command line remedies, each with the corresponding remedy in the window.
const HERE: [(&str, Text); 13] = [
    ("--roles", words::HELP_ROLES),
    ("roles file", words::HELP_ROLES),
    ("--mend-root", words::HELP_ROOT),
    ("--unit", words::HELP_UNIT),
    ("--axes", words::HELP_AXES),
    ("--map", words::HELP_TIERS),
    ("mapping", words::HELP_TIERS),
    ("--like", words::HELP_TEMPLATE),
    ("--base", words::HELP_MERGE),
    ("--theirs", words::HELP_CHANGED),
    ("check --mend", shell::HELP_CHECK),
    ("transcribe", shell::HELP_NOTATION),
    ("animate", shell::HELP_NOTATION),
];

/// Returns the remedy in the window; `None` if only the command line offers one.
pub(crate) fn here(remedy: &str, language: Language) -> Option<String> {
    let known = HERE.iter().find(|(part, _)| remedy.contains(part));
    if let Some((_, text)) = known {
        return Some(text.of(language).to_owned());
    }
    is_of_the_window(remedy).then(|| spoken(remedy, language))
}

/// Returns whether a remedy of the corpus names no command or option of the command line.
pub(crate) fn is_of_the_window(remedy: &str) -> bool {
    !remedy.contains("`chereme ") && !remedy.contains("--")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn remedies_are_rephrased_for_the_window() {
        for (remedy, english) in [
            (
                "say which one in a roles file (--roles)",
                "Click the wrong joint",
            ),
            (
                "say the unit with --unit, such as --unit cm",
                "Choose the unit",
            ),
            (
                "say the axes with --axes, or name the joints",
                "Choose the axes",
            ),
            ("import it with --mend-root to read it so", "Tick"),
            (
                "give tiers their roles in a mapping file (--map), or with `chereme annotate`",
                "Choose the role",
            ),
        ] {
            for language in [Language::English, Language::French] {
                let told = here(remedy, language).expect("something");
                assert!(!told.contains("--") && !told.contains('`'), "{told}");
            }
            let told = here(remedy, Language::English).expect("something");
            assert!(told.starts_with(english), "{told}");
        }
        let plain = "correct the number in the file";
        assert_eq!(here(plain, Language::English).as_deref(), Some(plain));
        assert_eq!(
            here("`chereme list CORPUS tokens`", Language::English),
            None
        );
        assert_eq!(here("write it with --force", Language::French), None);
    }
}
