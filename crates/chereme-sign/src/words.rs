//! Words that people read: the languages of the interfaces, and texts in them.
//!
//! Words lie in folders, one for each language: see [`folders`]. A [`InterfaceText`] names its words there by an id, or holds them in
//! English and French, as those of operators and detectors do, beside their code.

use serde::de::{Deserialize, Deserializer, Error as _};
use serde::{Serialize, Serializer};

pub mod folders;

use folders::{language_files, phrase_text};

/// A language of the user interfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum InterfaceLanguage {
    /// English, in which every text is written.
    #[default]
    English,
    /// French, in which every text is written, too.
    French,
    /// A language that is a folder of words, by its code; words that the folder lacks are English.
    Other(&'static str),
}

impl InterfaceLanguage {
    /// The languages in which every text is written, with their own names for themselves.
    pub const BUILTIN_LANGUAGES: [(Self, &'static str); 2] = [(Self::English, "English"), (Self::French, "Français")];

    /// Returns every language that has a folder of words, with its own name for itself.
    #[must_use]
    pub fn all_listed() -> Vec<(Self, &'static str)> {
        let named = |(code, files): (&'static String, &'static folders::LanguageFiles)| {
            Some((Self::from_code(code)?, files.language_name(code)))
        };
        let mut listed: Vec<_> = language_files().iter().filter_map(named).collect();
        listed.sort_by_key(|(language, _)| (matches!(language, Self::Other(_)), language.language_code()));
        listed
    }

    /// Returns the language of a code such as `fr`; nothing if there is no folder of words for it.
    #[must_use]
    pub fn from_code(code: &str) -> Option<Self> {
        let (code, _) = language_files().get_key_value(code)?;
        Some(match code.as_str() {
            "en" => Self::English,
            "fr" => Self::French,
            other => Self::Other(other),
        })
    }

    /// Returns its language code, which inventories use for their names.
    #[must_use]
    pub fn language_code(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::French => "fr",
            Self::Other(code) => code,
        }
    }

    /// Returns the language for a locale such as `fr_FR.UTF-8`, among those in which every text is written.
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
        let mut locales = ["LC_ALL", "LC_MESSAGES", "LANG"].into_iter().filter_map(variable);
        let locale = locales.find(|locale| !locale.is_empty());
        Self::of_locale(&locale.unwrap_or_default())
    }

    /// Returns the name in documents, such as the settings of the window.
    fn stored_name(self) -> &'static str {
        match self {
            Self::English => "english",
            Self::French => "french",
            Self::Other(code) => code,
        }
    }
}

impl Serialize for InterfaceLanguage {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(self.stored_name())
    }
}

impl<'de> Deserialize<'de> for InterfaceLanguage {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let name = String::deserialize(from)?;
        let mut complete = Self::BUILTIN_LANGUAGES.into_iter().map(|(language, _)| language);
        let stored = complete.find(|language| language.stored_name() == name);
        let language = stored.or_else(|| Self::from_code(&name));
        language.ok_or_else(|| D::Error::custom(format!("there are no words for the language {name}")))
    }
}

/// A text for people, by its id in the folders of words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct InterfaceText {
    id: &'static str,
}

impl InterfaceText {
    /// Creates a text from its id in the folders of words. Letters of the id are lowered, and dots and underscores are hyphens.
    #[must_use]
    pub const fn from_id(id: &'static str) -> Self {
        Self { id }
    }

    /// Returns the id.
    #[must_use]
    pub const fn text_id(self) -> &'static str {
        self.id
    }

    /// Returns the words in `language`; words that it lacks are English, and an id without words stays.
    #[must_use]
    pub fn text_in_language(self, language: InterfaceLanguage) -> &'static str {
        // Most ids are written as in their files, and windows ask for hundreds of them in each frame.
        let lowered = || self.id.to_lowercase().replace(['.', '_'], "-");
        let words = phrase_text(self.id, language).or_else(|| phrase_text(&lowered(), language));
        words.unwrap_or(self.id)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_language_is_a_folder_and_falls_back_to_english() {
        let codes: Vec<&str> = InterfaceLanguage::all_listed()
            .iter()
            .map(|(language, _)| language.language_code())
            .collect();
        assert_eq!(codes[..2], ["en", "fr"]);
        assert_eq!(InterfaceLanguage::from_code("fr"), Some(InterfaceLanguage::French));
        assert_eq!(InterfaceLanguage::from_code("tlh"), None);
        for (language, name) in InterfaceLanguage::all_listed() {
            assert_eq!(InterfaceLanguage::from_code(language.language_code()), Some(language));
            assert_ne!(name, language.language_code(), "language-name");
            let stored = serde_json::to_string(&language).expect("stored");
            let read: InterfaceLanguage = serde_json::from_str(&stored).expect("read");
            assert_eq!(read, language);
        }
        assert!(serde_json::from_str::<InterfaceLanguage>("\"tlh\"").is_err());
        let undo = InterfaceText::from_id("menu-edit.undo");
        let others = ["Undo", "Annuler", "Undo"];
        let languages = [
            InterfaceLanguage::English,
            InterfaceLanguage::French,
            InterfaceLanguage::Other("tlh"),
        ];
        assert_eq!(languages.map(|language| undo.text_in_language(language)), others);
        assert_eq!(
            InterfaceText::from_id("menu-none").text_in_language(InterfaceLanguage::French),
            "menu-none"
        );
    }

    #[test]
    fn the_language_is_that_of_the_locale() {
        assert_eq!(InterfaceLanguage::of_locale("fr_CH"), InterfaceLanguage::French);
        assert_eq!(InterfaceLanguage::of_locale("C"), InterfaceLanguage::English);
        let of = |name: &str| match name {
            "LC_ALL" => Some(String::new()),
            "LC_MESSAGES" => Some("fr_BE.UTF-8".to_owned()),
            "LANG" => Some("C".to_owned()),
            _ => None,
        };
        assert_eq!(InterfaceLanguage::of_environment(of), InterfaceLanguage::French);
        assert_eq!(InterfaceLanguage::of_environment(|_| None), InterfaceLanguage::English);
    }
}
