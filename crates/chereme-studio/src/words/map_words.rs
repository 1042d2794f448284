//! Texts of the map of signs.

texts! {
    TITLE: "Map", "Carte";
    BY: "Similar by", "Semblables par";
    WHOLE: "Whole map", "Toute la carte";
    COUNT: "Signs on the map: {n}", "Signes sur la carte : {n}";
    LEFT_OUT: "not coded for these: {n}", "non codés pour cela : {n}";
    NONE_IN_SIGHT: "No sign is in sight. “Whole map” shows all of them.", "Aucun signe n’est visible. « Toute la carte » les montre tous.";
    ALIKE: "most similar:", "les plus proches :";
    HINT: "The wheel zooms, a drag moves, a click opens a sign, Shift and a drag around signs select them.", "La molette agrandit, un glissement déplace, un clic ouvre un signe, Maj et un glissement autour de signes les choisissent.";
}
