//! The history.

texts! {
    TITLE: "History", "Historique";
    EMPTY: "Nothing was done yet.", "Rien n’a encore été fait.";
    FILTER: "Who or what", "Qui ou quoi";
    NONE_FIT: "Nothing like that was done.", "Rien de tel n’a été fait.";
    NOW: "now", "maintenant";
    UNDONE: "undone", "annulé";
    GONE: "undone, and not to be done again", "annulé, et ne peut être rétabli";
    BEGINNING: "The empty corpus", "Le corpus vide";
    TIP_BACK: "Click to go back to just after this", "Cliquez pour revenir juste après ceci";
    TIP_FORWARD: "Click to do it again, up to here", "Cliquez pour rétablir jusqu’ici";
    WALK_BACK: "Undo {n} steps?", "Annuler {n} étapes ?";
    WALK_FORWARD: "Do {n} steps again?", "Rétablir {n} étapes ?";
    WALK_GO: "Yes", "Oui";
    WALKED_BACK: "{n} steps undone.", "{n} étapes annulées.";
    WALKED_FORWARD: "{n} steps done again.", "{n} étapes rétablies.";
    DID_IMPORT: "Imported: {what}", "Importé : {what}";
    DID_RECOMBINE: "{gloss} made: {recipe}", "{gloss} composé : {recipe}";
    DID_RECOMBINE_AGAIN: "{gloss} made anew: {recipe}", "{gloss} refait : {recipe}";
    DID_ANNOTATE: "{what} in {place}", "{what} dans {place}";
    ADDED: "{n} annotations added", "{n} annotations ajoutées";
    ONE_ADDED: "{n} annotation added", "{n} annotation ajoutée";
    CHANGED: "{n} changed", "{n} modifiées";
    ONE_CHANGED: "{n} annotation changed", "{n} annotation modifiée";
    REMOVED: "{n} removed", "{n} supprimées";
    ONE_REMOVED: "{n} annotation removed", "{n} annotation supprimée";
    DID_ADD_TIER: "Tier {tier} added to {place}", "Acteur {tier} ajouté à {place}";
    DID_CHANGE_TIER: "Tier {tier} of {place} changed", "Acteur {tier} de {place} modifié";
    DID_REMOVE_TIER: "Tier removed: {what}", "Acteur supprimé : {what}";
    DID_CHANGE_RECORDING: "Recording changed: {what}", "Enregistrement modifié : {what}";
    DID_CHANGE_SIGNER: "Signer changed: {what}", "Signeur modifié : {what}";
    DID_CHANGE_SIGN: "Sign changed: {what}", "Signe modifié : {what}";
    DID_CITE: "Citation form: {what}", "Forme de citation : {what}";
    DID_TRANSCRIBE: "Transcribed: {what}", "Transcrit : {what}";
}
