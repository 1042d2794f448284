//! The timeline.

texts! {
    TITLE: "Timeline", "Ligne de temps";
    EMPTY: "This recording has no tiers yet.", "Cet enregistrement n’a pas encore d’acteurs.";
    NO_RECORDING: "Choose a recording to see its tiers.", "Choisissez un enregistrement pour voir ses acteurs.";
    TIER: "Tier {name}", "Acteur {name}";
    RULER: "Ruler", "Règle";
    UNSET: "unset", "non renseigné";
    NOT_APPLICABLE: "n/a", "sans objet";
    UNCLEAR: "unclear", "incertain";
    SELECTED: "Selected: {start} to {end}", "Sélection : {start} à {end}";
}
