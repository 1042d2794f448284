//! Words shared by the command line and the window, in English and French.
//!
//! A text is a constant of its table; `{name}` in it is filled by [`fill`]. To add one, write a line
//! into the table of its part; to add a table, name it in `TABLES` of the tests below.

use std::fmt::Display;

use serde::{Deserialize, Serialize};

pub use count::{counted, counted_in, numbered};
pub use guides::guide;
pub use messages::message;

/// Declares the texts of one part.
macro_rules! texts {
    ($($name:ident: $en:literal, $fr:literal;)*) => {
        $(
            #[doc = concat!("“", $en, "”")]
            pub const $name: crate::words::Text = crate::words::Text { en: $en, fr: $fr };
        )*
        #[cfg(test)]
        pub(super) const ALL: &[(&str, crate::words::Text)] = &[$((stringify!($name), $name)),*];
    };
}

mod asking;
mod captures;
mod coding;
mod commands;
mod composing;
mod count;
pub mod deeds;
pub mod deletion;
mod documents;
mod editing;
mod findings;
mod guides;
pub mod history;
mod importing;
mod lines;
pub mod merge;
mod messages;
mod moving;
mod notes;
mod queries;
mod reading;
pub mod trouble;

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
    /// Returns the words in `language`.
    #[must_use]
    pub const fn of(self, language: Language) -> &'static str {
        match language {
            Language::English => self.en,
            Language::French => self.fr,
        }
    }
}

/// Returns `text` with each `{name}` replaced by its value in `values`.
#[must_use]
pub fn fill(text: &str, values: &[(&str, &dyn Display)]) -> String {
    let mut filled = text.to_owned();
    for (name, value) in values {
        filled = filled.replace(&format!("{{{name}}}"), &value.to_string());
    }
    filled
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLES: [&[(&str, Text)]; 5] = [
        deeds::ALL,
        deletion::ALL,
        history::ALL,
        merge::ALL,
        trouble::ALL,
    ];

    fn blanks(text: &str) -> Vec<&str> {
        let mut names: Vec<&str> = text
            .split('{')
            .skip(1)
            .filter_map(|rest| rest.split_once('}').map(|(name, _)| name))
            .collect();
        names.sort_unstable();
        names
    }

    #[test]
    fn every_text_exists_in_both_languages_with_the_same_blanks() {
        for (name, text) in TABLES.into_iter().flatten() {
            assert!(
                !text.en.trim().is_empty() && !text.fr.trim().is_empty(),
                "{name}"
            );
            assert_eq!(blanks(text.en), blanks(text.fr), "{name}");
        }
    }

    #[test]
    fn blanks_are_filled() {
        assert_eq!(fill("{n} of {all}", &[("n", &2), ("all", &"x")]), "2 of x");
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
