//! A key with its modifiers, as people write it; the sets of default keys.

use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

use eframe::egui::{Key, Modifiers};
use serde::{Deserialize, Serialize};

use crate::words::{InterfaceLanguage, InterfaceText, key_names as words, shell};

/// A set of default keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum DefaultKeymap {
    /// Those of ELAN.
    #[default]
    Elan,
    /// Those of Praat, as far as it has any.
    Praat,
    /// Those of video editors: J, K, L.
    Editor,
}

impl DefaultKeymap {
    pub(crate) const ALL_KEYMAPS: [(Self, InterfaceText); 3] = [
        (Self::Elan, shell::KEYMAP_ELAN),
        (Self::Praat, shell::KEYMAP_PRAAT),
        (Self::Editor, shell::KEYMAP_EDITOR),
    ];
}

/// Keys that the user gave to actions, by action id; an empty list removes all keys of the action.
pub(crate) type ReboundKeys = BTreeMap<String, Vec<KeyChord>>;

/// A key with its modifiers: `Ctrl+Shift+Space`. Ctrl is the command key on a Mac.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub(crate) struct KeyChord {
    pub(crate) ctrl: bool,
    pub(crate) alt: bool,
    pub(crate) shift: bool,
    pub(crate) key: Key,
}

/// The error for a text that is not a [`KeyChord`].
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} is no key: write one like Ctrl+Shift+Space")]
pub(crate) struct NoChord(String);

impl KeyChord {
    pub(crate) fn new(key: Key, modifiers: Modifiers) -> Self {
        Self {
            ctrl: modifiers.command || modifiers.ctrl,
            alt: modifiers.alt,
            // Most keyboards have the plus behind Shift; others have a separate key for it.
            shift: modifiers.shift && key != Key::Plus,
            key,
        }
    }

    /// Returns whether a text field uses the chord itself.
    pub(crate) fn is_for_text(self) -> bool {
        const TEXT_EDITING_KEYS: [Key; 15] = [
            Key::A,
            Key::C,
            Key::V,
            Key::X,
            Key::Y,
            Key::Z,
            Key::Backspace,
            Key::Delete,
            Key::Enter,
            Key::ArrowLeft,
            Key::ArrowRight,
            Key::ArrowUp,
            Key::ArrowDown,
            Key::Home,
            Key::End,
        ];
        let function = self.key >= Key::F1 && self.key <= Key::F35;
        if self.ctrl {
            return TEXT_EDITING_KEYS.contains(&self.key) && !self.alt;
        }
        // Function keys and Alt type nothing in a field.
        !function && !self.alt
    }

    /// Returns the chord as people read it, with the printed sign of the key if it has one, and the names that are
    /// printed on keyboards of the language.
    pub(crate) fn chord_label(self, language: InterfaceLanguage) -> String {
        let name = self.key.name();
        let sign = match self.key {
            Key::Plus => "+",
            key => key.symbol_or_name(),
        };
        // Arrows and the like are easier to read as words.
        let key = match words::KEY_NAME_TEXTS.iter().find(|(key, _)| *key == self.key) {
            Some((_, text)) => text.text_in_language(language),
            None if sign.is_ascii() => sign,
            None => name,
        };
        let mut label = String::new();
        for (held, name) in [
            (self.ctrl, words::CTRL),
            (self.shift, words::SHIFT),
            (self.alt, words::ALT),
        ] {
            if held {
                label.push_str(name.text_in_language(language));
                label.push('+');
            }
        }
        label + key
    }

    /// Returns whether the chord is a digit, a letter, Enter or Delete, with Shift or alone: they code what is selected and
    /// are easily typed by mistake.
    pub(crate) fn is_for_coding(self) -> bool {
        let written = (Key::Num0..=Key::Z).contains(&self.key);
        let codes = matches!(self.key, Key::Delete | Key::Backspace | Key::Enter);
        !self.ctrl && !self.alt && (written || codes)
    }

    /// Returns whether a focused handle on the stage uses the chord itself.
    pub(crate) fn is_for_handles(self) -> bool {
        const HANDLE_MOVING_KEYS: [Key; 3] = [Key::PageUp, Key::PageDown, Key::Escape];
        !self.ctrl && !self.alt && HANDLE_MOVING_KEYS.contains(&self.key)
    }

    /// Returns whether a focused button, list or slider uses the chord itself.
    pub(crate) fn is_for_widgets(self) -> bool {
        const WIDGET_MOVING_KEYS: [Key; 11] = [
            Key::Space,
            Key::Enter,
            Key::Tab,
            Key::ArrowLeft,
            Key::ArrowRight,
            Key::ArrowUp,
            Key::ArrowDown,
            Key::PageUp,
            Key::PageDown,
            Key::Home,
            Key::End,
        ];
        !self.ctrl && !self.alt && WIDGET_MOVING_KEYS.contains(&self.key)
    }
}

impl fmt::Display for KeyChord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (held, name) in [(self.ctrl, "Ctrl+"), (self.shift, "Shift+"), (self.alt, "Alt+")] {
            if held {
                f.write_str(name)?;
            }
        }
        f.write_str(self.key.name())
    }
}

impl FromStr for KeyChord {
    type Err = NoChord;

    fn from_str(text: &str) -> Result<Self, NoChord> {
        let wrong = || NoChord(text.to_owned());
        let mut modifiers = Modifiers::NONE;
        let mut rest = text.trim();
        while let Some((word, after)) = rest.split_once('+').filter(|(_, after)| !after.is_empty()) {
            match word {
                "Ctrl" => modifiers.ctrl = true,
                "Shift" => modifiers.shift = true,
                "Alt" => modifiers.alt = true,
                _ => return Err(wrong()),
            }
            rest = after;
        }
        let key = Key::from_name(rest).ok_or_else(wrong)?;
        Ok(Self::new(key, modifiers))
    }
}

chereme_motion::keep_as_text!(KeyChord);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chords_read_as_they_are_written() {
        for text in [
            "Ctrl+Shift+Space",
            "L",
            "Alt+Left",
            "Shift+Alt+N",
            "F1",
            "Ctrl+Plus",
            "Comma",
        ] {
            assert_eq!(text.parse::<KeyChord>().expect("a chord").to_string(), text);
        }
        for (text, label) in [
            ("Ctrl+Comma", ["Ctrl+,", "Ctrl+,"]),
            ("Ctrl+Plus", ["Ctrl++", "Ctrl++"]),
            ("Alt+Left", ["Alt+Left", "Alt+Gauche"]),
            ("Period", [".", "."]),
            ("Shift+Slash", ["Shift+/", "Maj+/"]),
            ("Shift+Enter", ["Shift+Enter", "Maj+Entrée"]),
            ("Delete", ["Delete", "Suppr"]),
        ] {
            let chord = text.parse::<KeyChord>().expect("a chord");
            let labels = [InterfaceLanguage::English, InterfaceLanguage::French].map(|it| chord.chord_label(it));
            assert_eq!(labels, label);
        }
        assert_eq!("Ctrl++".parse::<KeyChord>().map(|it| it.key), Ok(Key::Plus));
        for bad in ["", "Ctrl+", "Hyper+A", "NoKey"] {
            assert!(bad.parse::<KeyChord>().is_err(), "{bad}");
        }
    }
}
