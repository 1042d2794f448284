//! The history.

texts! {
    TITLE: "History", "Historique";
    EMPTY: "Nothing was done yet.", "Rien n’a encore été fait.";
    UNDONE: "undone", "annulé";
    UNDO_OF: "undo of {n}", "annulation de {n}";
    REDO_OF: "redo of {n}", "rétablissement de {n}";
}
