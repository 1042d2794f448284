//! Texts of the lists of recordings and signs.

texts! {
    TITLE: "Library", "Fonds";
    FILTER: "Filter", "Filtrer";
    EMPTY: "The corpus is empty. Import recordings to begin.", "Le corpus est vide. Importez des enregistrements pour commencer.";
    NONE_FIT: "No recording has this name.", "Aucun enregistrement ne porte ce nom.";
    NO_SIGN_FITS: "No sign has this name.", "Aucun signe ne porte ce nom.";
    NO_SIGNS: "There are no signs yet. Import a lexicon, or annotate glosses in the recordings.", "Il n’y a pas encore de signes. Importez un lexique, ou annotez des gloses dans les enregistrements.";
    NO_RECORDINGS: "There are no recordings yet, only signs.", "Il n’y a pas encore d’enregistrements, seulement des signes.";
    RECORDINGS: "Recordings ({n})", "Enregistrements ({n})";
    SIGNS: "Signs ({n})", "Signes ({n})";
    WALL: "Wall", "Mur";
    LIST: "List", "Liste";
    RECORDED: "recorded", "enregistré";
    NOTATED: "notated", "noté";
    IN_LEXICON: "lexicon entry", "entrée de lexique";
    TOKENS: "tokens: {n}", "occurrences : {n}";
    INSPECT: "All that is known of it", "Tout ce qu’on en sait";
    ONLY_CODED: "{gloss} is coded, but has no movement yet.", "{gloss} est codé, mais rien ne bouge encore.";
    ANIMATING: "{gloss} is being animated from its notation…", "{gloss} : animation d’après sa notation…";
    NOT_ANIMATED: "{gloss} could not be animated from its notation:", "{gloss} n’a pas pu être animé d’après sa notation :";
    ANIMATED: "{gloss} is animated from its notation, and not stored.", "{gloss} est animé d’après sa notation, et pas enregistré.";
    MAKE: "Make it by a recipe", "Le composer par une recette";
    TO_RECIPE: "Take it into a recipe", "Le prendre dans une recette";
    ALIKE: "Signs like it that move", "Signes semblables qui bougent";
    NONE_CHOSEN: "Choose a recording or a sign in the library first.", "Choisissez d’abord un enregistrement ou un signe dans le fonds.";
    DELETE_TITLE: "Delete {name}?", "Supprimer {name} ?";
    DELETE_SOURCE: "Generated signs take movement from {name}:", "Des signes composés prennent leur mouvement de {name} :";
    DELETE_ANNOTATED: "{name} is annotated in recordings that stay:", "{name} est annoté dans des enregistrements qui restent :";
    DELETE_WITH_MADE: "Delete them as well", "Les supprimer aussi";
    DELETE_WITH_ANNOTATIONS: "Delete its annotations as well", "Supprimer aussi ses annotations";
    DELETE_KEEPING: "Keep them with their own movement", "Les garder avec leur mouvement";
    NO_MARKERS: "Choose a recording with markers in the library first.", "Choisissez d’abord dans le fonds un enregistrement avec des marqueurs.";
    FIT_TITLE: "Whose markers?", "Les marqueurs de qui ?";
    FIT_PEOPLE: "The markers of {name} are those of several people. The body is fitted to those of one of them:", "Les marqueurs de {name} sont ceux de plusieurs personnes. Le corps est ajusté à ceux de l’une d’elles :";
    IMPORT: "Import…", "Importer…";
    SKELETON: "skeleton", "squelette";
    MARKERS: "markers", "marqueurs";
    CURVES: "curves", "courbes";
    FILM: "film", "film";
    CAPTURED: "captured", "capté";
    ANNOTATED: "annotated", "annoté";
    MADE: "synthesised", "composé";
    GENERATED: "generated", "produit";
}
