//! Recombination.

texts! {
    TITLE: "Recombine", "Recombiner";
    RECIPE: "Recipe", "Recette";
    HINT: "ESCARGOT | configure right U", "ESCARGOT | configure right U";
    PREVIEW: "Preview", "Aperçu";
    GLOSS: "Gloss of the new sign", "Glose du nouveau signe";
    STORE: "Store", "Enregistrer";
    REPORT: "How it was made", "Comment il est fait";
    NEEDS_GLOSS: "A new sign needs a gloss.", "Un nouveau signe a besoin d’une glose.";
}
