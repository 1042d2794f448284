//! The table of everything that keys, menus and the command palette can request; each row is an [`Action`].
//!
//! An action has no data; its object is the selection. To add one, write a row into [`table`] and a match arm in the code
//! of its [`ActionOwner`]; an action that only shows a pane needs no arm.

/// Declares the actions.
macro_rules! actions {
    ($(
        $action:ident $id:literal $menu:ident, $context:expr, $owner:expr, $($flag:ident)* $(,)? $elan:literal $praat:literal $editor:literal;
    )*) => {
        /// A request that needs no further input.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub(crate) enum Action {
            $(#[doc = concat!("`", $id, "`")] $action,)*
        }

        /// Every action, in the order of the menus.
        pub(crate) const ACTIONS: &[ActionRow] = &{
            use ActionContext::*;
            use ActionOwner::*;
            [$(ActionRow {
                action: Action::$action,
                id: $id,
                name: InterfaceText::from_id(concat!("menu-", $id)),
                menu: ActionMenu::$menu,
                context: $context,
                owner: $owner,
                repeats: false $(|| actions!(@repeats $flag))*,
                changes: false $(|| actions!(@changes $flag))*,
                edits: false $(|| actions!(@edits $flag))*,
                keys: [$elan, $praat, $editor],
            },)*]
        };
    };
    (@repeats repeats) => { true };
    (@repeats $other:ident) => { false };
    (@changes repeats) => { false };
    (@changes $other:ident) => { true };
    (@edits edits) => { true };
    (@edits $other:ident) => { false };
}

mod action_table;

use crate::key_chord::{DefaultKeymap, KeyChord};
use crate::layout::PaneKind;
use crate::words::InterfaceText;

pub(crate) use action_table::{ACTIONS, Action};

/// The menu that lists an action.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum ActionMenu {
    File,
    Edit,
    Annotation,
    Value,
    Timing,
    Tier,
    Play,
    Stage,
    View,
    Panes,
    Help,
}

impl ActionMenu {
    pub(crate) const ALL_ACTION_MENUS: [(Self, InterfaceText); 11] = [
        (Self::File, InterfaceText::from_id("menu-bar-file")),
        (Self::Edit, InterfaceText::from_id("menu-bar-edit")),
        (Self::Annotation, InterfaceText::from_id("menu-bar-annotation")),
        (Self::Value, InterfaceText::from_id("menu-bar-value")),
        (Self::Timing, InterfaceText::from_id("menu-bar-timing")),
        (Self::Tier, InterfaceText::from_id("menu-bar-tier")),
        (Self::Play, InterfaceText::from_id("menu-bar-play")),
        (Self::Stage, InterfaceText::from_id("menu-bar-stage")),
        (Self::View, InterfaceText::from_id("menu-bar-view")),
        (Self::Panes, InterfaceText::from_id("menu-bar-panes")),
        (Self::Help, InterfaceText::from_id("menu-bar-help")),
    ];
}

/// The part of the window in which the keys of an action have an effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum ActionContext {
    /// In the whole window.
    Everywhere,
    /// Only with a corpus open.
    Corpus,
    /// Only in the pane of this kind; there they take precedence over other actions with the same keys.
    Pane(PaneKind),
}

/// The part of the program that carries out an action.
#[derive(Debug, Clone, Copy)]
pub(crate) enum ActionOwner {
    /// The window, with or without a corpus.
    Window,
    /// The window, which brings the pane of this kind to the front.
    Shows(PaneKind),
    /// The player: the recording or sign on the stage.
    Player,
    /// The window, with a corpus open.
    WithCorpus,
    /// The pane of this kind.
    In(PaneKind),
}

/// A row of the table of actions.
#[derive(Debug)]
pub(crate) struct ActionRow {
    pub(crate) action: Action,
    /// Name of the action in the settings file; it never changes.
    pub(crate) id: &'static str,
    pub(crate) name: InterfaceText,
    pub(crate) menu: ActionMenu,
    pub(crate) context: ActionContext,
    /// Whether holding its key repeats it.
    pub(crate) repeats: bool,
    pub(crate) owner: ActionOwner,
    /// Whether it changes the corpus, or begins to.
    pub(crate) changes: bool,
    /// Whether it changes annotations or tiers of the timeline at once, so that its keys count only where they are seen.
    pub(crate) edits: bool,
    /// The keys of ELAN, of Praat and of video editors.
    keys: [&'static str; 3],
}

impl Action {
    /// Returns whether the action changes the corpus, or begins to change it.
    pub(crate) fn changes_corpus(self) -> bool {
        self.action_row().changes
    }

    /// Returns the row of this action.
    pub(crate) fn action_row(self) -> &'static ActionRow {
        &ACTIONS[self as usize]
    }
}

impl ActionRow {
    /// Returns the keys that a keymap gives the action.
    pub(crate) fn default_chords(&self, keymap: DefaultKeymap) -> Vec<KeyChord> {
        let text = match (keymap, self.keys) {
            (DefaultKeymap::Elan, [elan, ..])
            | (DefaultKeymap::Praat, [elan, "=", _])
            | (DefaultKeymap::Editor, [elan, _, "="]) => elan,
            (DefaultKeymap::Praat, [_, praat, _]) => praat,
            (DefaultKeymap::Editor, [_, _, editor]) => editor,
        };
        text.split_whitespace()
            .filter(|word| *word != "none")
            .filter_map(|chord| chord.parse().ok())
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::words::InterfaceLanguage;

    #[test]
    fn actions_are_found_by_name_and_ids_are_unique() {
        let ids: BTreeSet<&str> = ACTIONS.iter().map(|row| row.id).collect();
        assert_eq!(ids.len(), ACTIONS.len());
        for row in ACTIONS {
            assert_eq!(row.action.action_row().id, row.id);
        }
    }

    #[test]
    fn every_action_has_words_in_both_languages_and_valid_keys() {
        for row in ACTIONS {
            for (language, _) in InterfaceLanguage::BUILTIN_LANGUAGES {
                assert_ne!(row.name.text_in_language(language), row.name.text_id(), "{}", row.id);
            }
            for text in row.keys.iter().flat_map(|keys| keys.split_whitespace()) {
                let known = text == "=" || text == "none" || text.parse::<KeyChord>().is_ok();
                assert!(known, "{}: {text}", row.id);
            }
        }
    }
}
