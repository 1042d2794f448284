//! The list of recordings and signs.

texts! {
    TITLE: "Recordings", "Enregistrements";
    FILTER: "Filter", "Filtrer";
    EMPTY: "The corpus is empty. Import recordings to begin.", "Le corpus est vide. Importez des enregistrements pour commencer.";
    NONE_FIT: "No recording is called like that.", "Aucun enregistrement ne s’appelle ainsi.";
    IMPORT: "Import…", "Importer…";
    CAPTURED: "captured", "capté";
    MADE: "made", "composé";
    GENERATED: "generated", "produit";
}
