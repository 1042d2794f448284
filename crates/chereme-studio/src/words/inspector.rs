//! The inspector.

texts! {
    TITLE: "Inspector", "Inspecteur";
    NOTHING: "Nothing is selected.", "Rien n’est sélectionné.";
    RECORDING: "Recording", "Enregistrement";
    SIGNER: "Signer", "Signeur";
    ORIGIN: "Origin", "Origine";
    DURATION: "Duration", "Durée";
    FRAMES: "Frames", "Images";
    RECIPE: "Recipe", "Recette";
    LICENCE: "Licence", "Licence";
    NOTES: "Notes", "Notes";
    TIER: "Tier", "Acteur";
    VALUE: "Value", "Valeur";
    SPAN: "Span", "Intervalle";
    CONFIDENCE: "Confidence", "Confiance";
}
