//! Names of keys, as keyboards have them.

use eframe::egui::Key;

use super::InterfaceText;

pub(crate) use super::texts::key_names::*;

/// The keys whose names are words.
pub(crate) const KEY_NAME_TEXTS: [(Key, InterfaceText); 15] = [
    (Key::Space, SPACE),
    (Key::Enter, ENTER),
    (Key::Tab, TAB),
    (Key::Escape, ESCAPE),
    (Key::Backspace, BACKSPACE),
    (Key::Delete, DELETE),
    (Key::Insert, INSERT),
    (Key::Home, HOME),
    (Key::End, END),
    (Key::PageUp, PAGE_UP),
    (Key::PageDown, PAGE_DOWN),
    (Key::ArrowLeft, LEFT),
    (Key::ArrowRight, RIGHT),
    (Key::ArrowUp, UP),
    (Key::ArrowDown, DOWN),
];
