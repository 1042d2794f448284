//! Names of keys, as keyboards have them.

use eframe::egui::Key;

use super::InterfaceText;

texts! {
    CTRL: "Ctrl", "Ctrl";
    SHIFT: "Shift", "Maj";
    ALT: "Alt", "Alt";
    SPACE: "Space", "Espace";
    ENTER: "Enter", "Entrée";
    TAB: "Tab", "Tab";
    ESCAPE: "Escape", "Échap";
    BACKSPACE: "Backspace", "Retour arrière";
    DELETE: "Delete", "Suppr";
    INSERT: "Insert", "Inser";
    HOME: "Home", "Origine";
    END: "End", "Fin";
    PAGE_UP: "PageUp", "Page préc.";
    PAGE_DOWN: "PageDown", "Page suiv.";
    LEFT: "Left", "Gauche";
    RIGHT: "Right", "Droite";
    UP: "Up", "Haut";
    DOWN: "Down", "Bas";
}

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
