//! Keys and their actions: default keymaps as a table, the user's changes, and matching.

pub(crate) mod chord;
pub(crate) mod gestures;

use std::collections::BTreeMap;

use eframe::egui::{Event, InputState, Key, Modifiers};
use serde::{Deserialize, Serialize};

use crate::action::{ACTIONS, Action, Context};
use crate::panes::PaneKind;
use crate::words::{Language, Text, shell};
use chord::Chord;

/// A set of default keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Keymap {
    /// Those of ELAN.
    #[default]
    Elan,
    /// Those of Praat, as far as it has any.
    Praat,
    /// Those of video editors: J, K, L.
    Editor,
}

impl Keymap {
    pub(crate) const ALL: [(Self, Text); 3] = [
        (Self::Elan, shell::KEYMAP_ELAN),
        (Self::Praat, shell::KEYMAP_PRAAT),
        (Self::Editor, shell::KEYMAP_EDITOR),
    ];
}

/// The keys of every action: a keymap with the user's own changes.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Keys {
    bound: BTreeMap<Action, Vec<Chord>>,
    /// The language of the keys' names.
    language: Language,
}

/// Keys that the user gave to actions, by action id; an empty list removes all keys of the action.
pub(crate) type Rebound = BTreeMap<String, Vec<Chord>>;

/// The state of the window when a key is pressed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct KeyContext {
    /// Whether a corpus is open.
    pub(crate) corpus: bool,
    /// The pane that was used last.
    pub(crate) pane: Option<PaneKind>,
    /// Whether a text field has the keyboard focus.
    pub(crate) typing: bool,
    /// Whether another widget has the keyboard focus.
    pub(crate) focused: bool,
    /// Whether that widget is a handle on the stage, which uses more keys to move in depth.
    pub(crate) held: bool,
    /// Whether text of a label is selected, so that Copy and Cut apply to that text.
    pub(crate) marked: bool,
    /// Whether a menu or a drop-down list is open.
    pub(crate) menu: bool,
}

impl Keys {
    /// Returns the keys of a keymap with the user's changes; a key that the user gave to one action is taken from the
    /// other actions of the same context.
    pub(crate) fn new(keymap: Keymap, rebound: &Rebound, language: Language) -> Self {
        let mut bound = BTreeMap::new();
        for row in ACTIONS {
            let own = rebound.get(row.id).cloned();
            bound.insert(row.action, own.unwrap_or_else(|| row.defaults(keymap)));
        }
        for (id, chords) in rebound {
            let Some(row) = ACTIONS.iter().find(|row| row.id == id) else {
                continue;
            };
            for other in ACTIONS
                .iter()
                .filter(|it| it.id != id && it.context == row.context)
            {
                if let Some(all) = bound.get_mut(&other.action)
                    && !rebound.contains_key(other.id)
                {
                    all.retain(|chord| !chords.contains(chord));
                }
            }
        }
        Self { bound, language }
    }

    /// Returns the keys of an action.
    pub(crate) fn of(&self, action: Action) -> &[Chord] {
        self.bound.get(&action).map_or(&[], Vec::as_slice)
    }

    /// Returns the keys of an action as people read them, such as `Ctrl+Z`; empty if it has no keys.
    pub(crate) fn text(&self, action: Action) -> String {
        let all: Vec<String> = self
            .of(action)
            .iter()
            .map(|it| it.label(self.language))
            .collect();
        all.join(", ")
    }

    /// Returns a text with each action id between braces replaced by the first keys of that action; an action without
    /// keys keeps its id, without the braces.
    pub(crate) fn named(&self, text: &str) -> String {
        let mut replaced = text.to_owned();
        for row in ACTIONS {
            let place = format!("{{{}}}", row.id);
            if replaced.contains(&place) {
                let keys = self
                    .of(row.action)
                    .first()
                    .map(|it| it.label(self.language));
                replaced = replaced.replace(&place, &keys.unwrap_or_else(|| row.id.to_owned()));
            }
        }
        replaced
    }

    /// Returns the action of `chord` in the state `place`: an action of the pane takes precedence.
    pub(crate) fn action(&self, chord: Chord, place: KeyContext) -> Option<Action> {
        let taken = (place.typing && chord.is_for_text())
            || (place.menu && !chord.ctrl && !chord.alt)
            || (place.focused && chord.is_for_widgets())
            || (place.held && chord.is_for_handles());
        if taken {
            return None;
        }
        let counts = |context: Context| match context {
            Context::Everywhere => true,
            Context::Corpus => place.corpus,
            Context::Pane(pane) => place.corpus && place.pane == Some(pane),
        };
        let mut found = ACTIONS
            .iter()
            .filter(|row| counts(row.context) && self.of(row.action).contains(&chord));
        found
            .clone()
            .find(|row| matches!(row.context, Context::Pane(_)))
            .or_else(|| found.next())
            .map(|row| row.action)
    }

    /// Removes the first pressed key that has an action from the input, and returns the action; for a paste, also the
    /// pasted text.
    ///
    /// Takes one key at a time, since its action decides where later keys go, for example into a field.
    pub(crate) fn take(
        &self,
        input: &mut InputState,
        place: KeyContext,
    ) -> Option<(Action, Option<String>)> {
        // egui reports these keys as copy, cut and paste events.
        let clipboard = |key| self.action(Chord::new(key, Modifiers::COMMAND), place);
        loop {
            let pressed = |event: &Event| match event {
                Event::Copy if !place.marked => Some((clipboard(Key::C)?, false)),
                Event::Cut if !place.marked => Some((clipboard(Key::X)?, false)),
                Event::Paste(_) => Some((clipboard(Key::V)?, false)),
                Event::Key {
                    key,
                    pressed: true,
                    repeat,
                    modifiers,
                    ..
                } => Some((self.action(Chord::new(*key, *modifiers), place)?, *repeat)),
                _ => None,
            };
            let mut found = input.events.iter().enumerate();
            let (at, (action, repeat)) = found.find_map(|(at, it)| Some((at, pressed(it)?)))?;
            let text = match input.events.remove(at) {
                Event::Paste(text) => Some(text),
                Event::Key { key, .. } => {
                    // The letter of a shortcut is no text for a field that is open or that the action opens.
                    let letter = key == Key::Space || key.symbol_or_name().chars().count() == 1;
                    if letter && matches!(input.events.get(at), Some(Event::Text(_))) {
                        input.events.remove(at);
                    }
                    None
                }
                _ => None,
            };
            if !repeat || action.row().repeats {
                return Some((action, text));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AT: KeyContext = KeyContext {
        corpus: true,
        pane: None,
        typing: false,
        focused: false,
        held: false,
        marked: false,
        menu: false,
    };

    fn chord(text: &str) -> Chord {
        text.parse().expect("a chord")
    }

    #[test]
    fn no_key_means_two_things_in_one_context() {
        for (keymap, _) in Keymap::ALL {
            let keys = Keys::new(keymap, &Rebound::new(), Language::English);
            for (at, row) in ACTIONS.iter().enumerate() {
                for other in &ACTIONS[at + 1..] {
                    let both = keys
                        .of(row.action)
                        .iter()
                        .find(|it| keys.of(other.action).contains(it));
                    // Keys of a pane take precedence over those of the whole window.
                    let pane = |context| match context {
                        Context::Pane(pane) => Some(pane),
                        _ => None,
                    };
                    let apart = pane(row.context) != pane(other.context);
                    assert!(
                        both.is_none() || apart,
                        "{keymap:?}: {} and {}: {both:?}",
                        row.id,
                        other.id
                    );
                }
            }
        }
    }

    #[test]
    fn keys_of_the_user_take_precedence_over_the_keymap() {
        let rebound = Rebound::from([("play.toggle".to_owned(), vec![chord("Ctrl+Z")])]);
        let keys = Keys::new(Keymap::Elan, &rebound, Language::English);
        assert_eq!(keys.action(chord("Ctrl+Z"), AT), Some(Action::Play));
        assert_eq!(keys.action(chord("Ctrl+Space"), AT), None);
        assert!(keys.of(Action::Undo).is_empty());
    }

    #[test]
    fn keys_typed_over_an_open_menu_reach_nothing_below_it() {
        let menu = KeyContext { menu: true, ..AT };
        for (keymap, _) in Keymap::ALL {
            let keys = Keys::new(keymap, &Rebound::new(), Language::English);
            for row in ACTIONS {
                let place = match row.context {
                    Context::Pane(pane) => KeyContext {
                        pane: Some(pane),
                        ..menu
                    },
                    _ => menu,
                };
                for chord in keys.of(row.action) {
                    let plain = !chord.ctrl && !chord.alt;
                    assert!(!plain || keys.action(*chord, place).is_none(), "{}", row.id);
                }
            }
        }
        let keys = Keys::new(Keymap::Elan, &Rebound::new(), Language::English);
        assert_eq!(keys.action(chord("Ctrl+Z"), menu), Some(Action::Undo));
    }

    #[test]
    fn the_letter_of_a_shortcut_is_no_text() {
        let keys = Keys::new(Keymap::Elan, &Rebound::new(), Language::English);
        let place = KeyContext {
            pane: Some(PaneKind::Timeline),
            typing: true,
            ..AT
        };
        let key = |key, pressed, modifiers| Event::Key {
            key,
            physical_key: None,
            pressed,
            repeat: false,
            modifiers,
        };
        let text = |text: &str| Event::Text(text.to_owned());
        let mut input = InputState::default();
        input.events = vec![
            key(Key::N, true, Modifiers::ALT),
            text("n"),
            key(Key::N, false, Modifiers::ALT),
            key(Key::X, true, Modifiers::NONE),
            text("x"),
            key(Key::F2, true, Modifiers::NONE),
            text("y"),
        ];
        let taken = std::iter::from_fn(|| keys.take(&mut input, place));
        let taken: Vec<Action> = taken.map(|it| it.0).collect();
        assert_eq!(taken, [Action::NextProposal, Action::EditValue]);
        let left = input
            .events
            .iter()
            .filter(|it| matches!(it, Event::Text(_)));
        assert_eq!(left.collect::<Vec<_>>(), [&text("x"), &text("y")]);
    }

    #[test]
    fn a_text_field_keeps_its_own_keys() {
        let keys = Keys::new(Keymap::Editor, &Rebound::new(), Language::English);
        let typing = KeyContext { typing: true, ..AT };
        assert_eq!(keys.action(chord("L"), AT), Some(Action::ShuttleForward));
        assert_eq!(keys.action(chord("L"), typing), None);
        assert_eq!(keys.action(chord("Ctrl+Z"), typing), None);
        assert_eq!(
            keys.action(chord("Ctrl+Shift+P"), typing),
            Some(Action::Palette)
        );
        assert_eq!(
            keys.action(
                chord("Space"),
                KeyContext {
                    focused: true,
                    ..AT
                }
            ),
            None
        );
        assert_eq!(
            keys.action(
                chord("L"),
                KeyContext {
                    corpus: false,
                    ..AT
                }
            ),
            None
        );
    }
}
