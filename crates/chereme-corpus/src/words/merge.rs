//! Differences, merges and their conflicts.

use super::Text;
use crate::merge::Decision;

texts! {
    TITLE: "Conflicts", "Conflits";
    ADDED: "added: {what}", "ajouté : {what}";
    CHANGED: "changed: {what}", "modifié : {what}";
    REMOVED: "removed: {what}", "supprimé : {what}";
    NOTHING: "Nothing is new.", "Rien de nouveau.";
    NO_CONFLICTS: "no conflicts", "aucun conflit";
    DECIDE: "Decide with `chereme conflicts CORPUS NUMBER --take mine`, or with theirs or both.", "Décidez avec `chereme conflicts CORPUS NUMÉRO --take mine`, ou avec theirs ou both.";
    CONFLICT: "conflict on tier {tier}: mine {mine}, theirs {theirs}", "conflit sur l’acteur {tier} : le mien {mine}, le leur {theirs}";
    GONE: "(removed)", "(supprimé)";
    NUMBER: "number", "n°";
    WHAT: "what", "quoi";
    PLACE: "place", "où";
    MINE: "mine", "le mien";
    THEIRS: "theirs", "le leur";
    BOTH: "both", "les deux";
    FROM: "from", "de";
    DECIDED: "decided", "décidé";
    TIER_ADDED: "tier {tier} added", "acteur {tier} ajouté";
    TIER_REMOVED: "tier {tier} removed", "acteur {tier} supprimé";
    TIER_RENAMED: "tier {tier} renamed to {to}", "acteur {tier} renommé en {to}";
    TIER_CHANGED: "tier {tier} changed: {what}", "acteur {tier} modifié : {what}";
    TIP: "Your candidate stands until you choose. Undo takes a choice back.", "Votre version reste tant que vous n’avez pas choisi. Annuler revient sur un choix.";
    DID_MERGE: "Merged {what}", "Fusionné {what}";
    DID_DECIDE: "Decided {what}", "Décidé {what}";
}

/// Returns the word for a decision.
#[must_use]
pub fn decision(decision: Decision) -> Text {
    match decision {
        Decision::Mine => MINE,
        Decision::Theirs => THEIRS,
        Decision::Both => BOTH,
    }
}
