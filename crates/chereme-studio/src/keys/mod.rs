//! Keys and their actions: a keymap with the user's changes, and matching.

pub(crate) mod keys_gestures;

use std::collections::BTreeMap;

use eframe::egui::{Event, Key, Modifiers};

use crate::action::{ACTIONS, Action, ActionContext, ActionOwner, ActionRow};
use crate::key_chord::{DefaultKeymap, KeyChord, ReboundKeys};
use crate::layout::PaneKind;
use crate::words::InterfaceLanguage;

/// The keys of every action: a keymap with the user's own changes.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct ActionKeys {
    bound: BTreeMap<Action, Vec<KeyChord>>,
    /// The language of the keys' names.
    language: InterfaceLanguage,
}

/// The state of the window when a key is pressed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct KeyContext {
    /// Whether a corpus is open.
    pub(crate) corpus: bool,
    /// The pane that has the focus, if it is in sight.
    pub(crate) pane: Option<PaneKind>,
    /// Whether the rows of the timeline have the focus, so that digits, letters and Enter code.
    pub(crate) coding: bool,
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

impl ActionKeys {
    /// Returns the keys of a keymap with the user's changes; a key that the user gave to one action is taken from the
    /// other actions of the same context.
    pub(crate) fn new(keymap: DefaultKeymap, rebound: &ReboundKeys, language: InterfaceLanguage) -> Self {
        let mut bound = BTreeMap::new();
        for row in ACTIONS {
            let rebound_chords = rebound.get(row.id).cloned();
            bound.insert(row.action, rebound_chords.unwrap_or_else(|| row.default_chords(keymap)));
        }
        for (id, chords) in rebound {
            let Some(row) = ACTIONS.iter().find(|row| row.id == id) else {
                continue;
            };
            for other in ACTIONS
                .iter()
                .filter(|action_row| action_row.id != id && action_row.context == row.context)
            {
                // Keys that the user chose for another action as well stay with it.
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
    pub(crate) fn chords_of_action(&self, action: Action) -> &[KeyChord] {
        self.bound.get(&action).map_or(&[], Vec::as_slice)
    }

    /// Returns the keys of an action as people read them, such as `Ctrl+Z`; empty if it has no keys.
    pub(crate) fn action_keys_text(&self, action: Action) -> String {
        let all: Vec<String> = self
            .chords_of_action(action)
            .iter()
            .map(|chord| chord.chord_label(self.language))
            .collect();
        all.join(", ")
    }

    /// Returns a text with each action id between braces replaced by the first keys of that action; an action without
    /// keys keeps its id, without the braces.
    pub(crate) fn name_keys_in_text(&self, text: &str) -> String {
        let mut replaced = text.to_owned();
        for row in ACTIONS {
            // A variable part of a phrase has no dots.
            let place = format!("{{{}}}", row.id.replace('.', "-"));
            if replaced.contains(&place) {
                let keys = self
                    .chords_of_action(row.action)
                    .first()
                    .map(|chord| chord.chord_label(self.language));
                replaced = replaced.replace(&place, &keys.unwrap_or_else(|| row.id.to_owned()));
            }
        }
        replaced
    }

    /// Returns the action of `chord` in the state `place`: an action of the pane takes precedence.
    pub(crate) fn action_of_chord(&self, chord: KeyChord, place: KeyContext) -> Option<Action> {
        // Whatever is open or focused has its keys first.
        let taken = (place.typing && chord.is_for_text())
            || (place.menu && !chord.ctrl && !chord.alt)
            || (place.focused && chord.is_for_widgets())
            || (place.held && chord.is_for_handles());
        if taken {
            return None;
        }
        let counts = |row: &ActionRow| match row.context {
            ActionContext::Everywhere => true,
            ActionContext::Corpus => place.corpus && place.may_act(chord, row),
            ActionContext::Pane(pane) => place.corpus && place.pane == Some(pane),
        };
        let mut matching_rows = ACTIONS
            .iter()
            .filter(|row| counts(row) && self.chords_of_action(row.action).contains(&chord));
        matching_rows
            .clone()
            .find(|row| matches!(row.context, ActionContext::Pane(_)))
            .or_else(|| matching_rows.next())
            .map(|row| row.action)
    }

    /// Returns the action of an event, if it is a key with one, and whether the key only repeats as it is held.
    pub(crate) fn action_of(&self, event: &Event, place: KeyContext) -> Option<(Action, bool)> {
        // egui reports these keys as copy, cut and paste events.
        let clipboard = |key| self.action_of_chord(KeyChord::new(key, Modifiers::COMMAND), place);
        match event {
            Event::Copy if !place.marked => Some((clipboard(Key::C)?, false)),
            Event::Cut if !place.marked => Some((clipboard(Key::X)?, false)),
            Event::Paste(_) => Some((clipboard(Key::V)?, false)),
            Event::Key {
                key,
                pressed: true,
                repeat,
                modifiers,
                ..
            } => Some((self.action_of_chord(KeyChord::new(*key, *modifiers), place)?, *repeat)),
            _ => None,
        }
    }

    /// Returns whether an event, which has no action here and is for no widget, would edit annotations in the timeline.
    pub(crate) fn edits_elsewhere(&self, event: &Event, place: KeyContext) -> bool {
        let timeline = KeyContext {
            pane: Some(PaneKind::Timeline),
            coding: true,
            ..place
        };
        let action = self.action_of(event, timeline);
        !place.focused && action.is_some_and(|(action, _)| action.action_row().edits)
    }
}

impl KeyContext {
    /// Returns whether a chord may carry out an action here. One that codes does so only in the rows of the timeline, and
    /// plays also where the movement is looked at; another one edits annotations only while
    /// a pane that shows them has the focus.
    fn may_act(self, chord: KeyChord, row: &ActionRow) -> bool {
        use PaneKind::{Film, Inspector, Stage, Timeline};
        // Other keys are not typed by mistake, but edit only what is in sight.
        if !chord.is_for_coding() {
            let in_sight = [Timeline, Stage, Film, Inspector];
            return !row.edits || self.pane.is_some_and(|pane| in_sight.contains(&pane));
        }
        let looking = [None, Some(Stage), Some(Film)].contains(&self.pane) && !self.focused;
        match row.owner {
            ActionOwner::Player => self.coding || looking,
            ActionOwner::In(Timeline) => self.coding,
            _ => self.coding || !row.changes,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AT: KeyContext = KeyContext {
        corpus: true,
        pane: None,
        coding: false,
        typing: false,
        focused: false,
        held: false,
        marked: false,
        menu: false,
    };

    fn chord(text: &str) -> KeyChord {
        text.parse().expect("a chord")
    }

    #[test]
    fn no_key_means_two_things_in_one_context() {
        for (keymap, _) in DefaultKeymap::ALL_KEYMAPS {
            let keys = ActionKeys::new(keymap, &ReboundKeys::new(), InterfaceLanguage::English);
            for (at, row) in ACTIONS.iter().enumerate() {
                for other in &ACTIONS[at + 1..] {
                    let both = keys
                        .chords_of_action(row.action)
                        .iter()
                        .find(|it| keys.chords_of_action(other.action).contains(it));
                    // Keys of a pane take precedence over those of the whole window.
                    let pane = |context| match context {
                        ActionContext::Pane(pane) => Some(pane),
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
        let rebound = ReboundKeys::from([("play.toggle".to_owned(), vec![chord("Ctrl+Z")])]);
        let keys = ActionKeys::new(DefaultKeymap::Elan, &rebound, InterfaceLanguage::English);
        assert_eq!(keys.action_of_chord(chord("Ctrl+Z"), AT), Some(Action::Play));
        assert_eq!(keys.action_of_chord(chord("Ctrl+Space"), AT), None);
        assert!(keys.chords_of_action(Action::Undo).is_empty());
    }

    #[test]
    fn keys_typed_over_an_open_menu_reach_nothing_below_it() {
        let menu = KeyContext { menu: true, ..AT };
        for (keymap, _) in DefaultKeymap::ALL_KEYMAPS {
            let keys = ActionKeys::new(keymap, &ReboundKeys::new(), InterfaceLanguage::English);
            for row in ACTIONS {
                let place = match row.context {
                    ActionContext::Pane(pane) => KeyContext {
                        pane: Some(pane),
                        ..menu
                    },
                    _ => menu,
                };
                for chord in keys.chords_of_action(row.action) {
                    let plain = !chord.ctrl && !chord.alt;
                    assert!(!plain || keys.action_of_chord(*chord, place).is_none(), "{}", row.id);
                }
            }
        }
        let keys = ActionKeys::new(DefaultKeymap::Elan, &ReboundKeys::new(), InterfaceLanguage::English);
        assert_eq!(keys.action_of_chord(chord("Ctrl+Z"), menu), Some(Action::Undo));
    }

    #[test]
    fn plain_keys_code_only_in_the_rows_of_the_timeline() {
        let place = |pane, coding, focused| KeyContext {
            pane,
            coding,
            focused,
            ..AT
        };
        let rows = place(Some(PaneKind::Timeline), true, false);
        let mut others: Vec<KeyContext> = PaneKind::ALL_PANE_KINDS
            .into_iter()
            .map(|pane| place(Some(pane), false, false))
            .collect();
        others.extend([AT, place(Some(PaneKind::Timeline), false, true)]);
        for (keymap, _) in DefaultKeymap::ALL_KEYMAPS {
            let keys = ActionKeys::new(keymap, &ReboundKeys::new(), InterfaceLanguage::English);
            for row in ACTIONS.iter().filter(|row| row.context == ActionContext::Corpus) {
                let coding = keys.chords_of_action(row.action).iter().filter(|it| it.is_for_coding());
                for chord in coding {
                    let action = Some(row.action);
                    assert_eq!(keys.action_of_chord(*chord, rows), action, "{}", row.id);
                    let acting = others.iter().any(|it| keys.action_of_chord(*chord, *it) == action);
                    let plays = matches!(row.owner, ActionOwner::Player);
                    assert_eq!(acting, plays, "{keymap:?} {}", row.id);
                }
            }
            let search = place(Some(PaneKind::Search), false, false);
            assert_eq!(keys.action_of_chord(chord("3"), search), None);
            assert_eq!(keys.action_of_chord(chord("L"), search), None);
            let library = place(Some(PaneKind::Library), false, false);
            let delete = keys.action_of_chord(chord("Delete"), library);
            assert_eq!(delete, Some(Action::DeleteListed));
        }
    }

    #[test]
    fn keys_that_edit_annotations_act_only_in_panes_that_show_them() {
        use PaneKind::{Film, Inspector, Stage, Timeline};
        for (keymap, _) in DefaultKeymap::ALL_KEYMAPS {
            let keys = ActionKeys::new(keymap, &ReboundKeys::new(), InterfaceLanguage::English);
            let editing = ACTIONS.iter().filter(|row| row.edits);
            let chords = editing.flat_map(|row| keys.chords_of_action(row.action));
            for chord in chords.filter(|it| !it.is_for_coding()) {
                // After a change of layout no pane may have the focus.
                for pane in PaneKind::ALL_PANE_KINDS.map(Some).into_iter().chain([None]) {
                    let place = KeyContext { pane, ..AT };
                    let action = keys.action_of_chord(*chord, place);
                    let edits = action.is_some_and(|it| it.action_row().edits);
                    let in_sight = [Timeline, Stage, Film, Inspector].map(Some);
                    let wanted = in_sight.contains(&pane);
                    assert_eq!(edits, wanted, "{keymap:?} {pane:?} {chord}");
                }
            }
        }
        let keys = ActionKeys::new(DefaultKeymap::Elan, &ReboundKeys::new(), InterfaceLanguage::English);
        let search = KeyContext {
            pane: Some(PaneKind::Search),
            ..AT
        };
        let button = KeyContext {
            focused: true,
            ..search
        };
        for (text, place, said) in [
            ("Enter", search, true),
            ("Shift+Enter", search, true),
            ("3", search, true),
            ("Ctrl+Delete", search, true),
            ("Ctrl+F12", search, false),
            ("Enter", button, false),
        ] {
            let KeyChord { key, ctrl, shift, .. } = chord(text);
            let event = Event::Key {
                key,
                physical_key: None,
                pressed: true,
                repeat: false,
                modifiers: Modifiers {
                    shift,
                    command: ctrl,
                    ..Modifiers::NONE
                },
            };
            assert_eq!(keys.action_of(&event, place), None, "{text}");
            assert_eq!(keys.edits_elsewhere(&event, place), said, "{text}");
        }
    }

    #[test]
    fn a_text_field_keeps_its_own_keys() {
        let keys = ActionKeys::new(DefaultKeymap::Editor, &ReboundKeys::new(), InterfaceLanguage::English);
        let typing = KeyContext { typing: true, ..AT };
        assert_eq!(keys.action_of_chord(chord("L"), AT), Some(Action::ShuttleForward));
        assert_eq!(keys.action_of_chord(chord("L"), typing), None);
        assert_eq!(keys.action_of_chord(chord("Ctrl+Z"), typing), None);
        assert_eq!(
            keys.action_of_chord(chord("Ctrl+Shift+P"), typing),
            Some(Action::Palette)
        );
        assert_eq!(
            keys.action_of_chord(chord("Space"), KeyContext { focused: true, ..AT }),
            None
        );
        assert_eq!(
            keys.action_of_chord(chord("L"), KeyContext { corpus: false, ..AT }),
            None
        );
    }
}
