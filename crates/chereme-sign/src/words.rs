//! Words that people read, in English and French: the words of operators and detectors stand beside their code.

use serde::{Deserialize, Serialize};

/// A language of the user interfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Language {
    /// English.
    #[default]
    English,
    /// French.
    French,
}

impl Language {
    /// Every language with its own name for itself.
    pub const ALL: [(Self, &'static str); 2] =
        [(Self::English, "English"), (Self::French, "Français")];

    /// Returns its language code, which inventories use for their names.
    #[must_use]
    pub fn code(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::French => "fr",
        }
    }

    /// Returns the language for a locale such as `fr_FR.UTF-8`.
    #[must_use]
    pub fn of_locale(locale: &str) -> Self {
        if locale.to_lowercase().starts_with("fr") {
            Self::French
        } else {
            Self::English
        }
    }

    /// Returns the language of the system from the environment, which `variable` reads.
    #[must_use]
    pub fn of_environment(variable: impl Fn(&str) -> Option<String>) -> Self {
        let mut locales = ["LC_ALL", "LC_MESSAGES", "LANG"]
            .into_iter()
            .filter_map(variable);
        let locale = locales.find(|locale| !locale.is_empty());
        Self::of_locale(&locale.unwrap_or_default())
    }
}

/// Words in every language.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Text {
    /// In English.
    pub en: &'static str,
    /// In French.
    pub fr: &'static str,
}

impl Text {
    /// Creates a text from its English and its French words.
    #[must_use]
    pub const fn new(en: &'static str, fr: &'static str) -> Self {
        Self { en, fr }
    }

    /// Returns the words in `language`.
    #[must_use]
    pub const fn of(self, language: Language) -> &'static str {
        match language {
            Language::English => self.en,
            Language::French => self.fr,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_language_is_that_of_the_locale() {
        assert_eq!(Language::of_locale("fr_CH"), Language::French);
        assert_eq!(Language::of_locale("C"), Language::English);
        let of = |name: &str| match name {
            "LC_ALL" => Some(String::new()),
            "LC_MESSAGES" => Some("fr_BE.UTF-8".to_owned()),
            "LANG" => Some("C".to_owned()),
            _ => None,
        };
        assert_eq!(Language::of_environment(of), Language::French);
        assert_eq!(Language::of_environment(|_| None), Language::English);
    }
}
