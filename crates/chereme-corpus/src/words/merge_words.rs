//! Words for differences, merges and their conflicts.

use super::InterfaceText;
use super::effect::ConflictDecision;

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
    SHOW: "Show it on the stage and the timeline", "L’afficher sur la scène et la ligne de temps";
    TIP: "Your candidate stands until you choose. Undo takes a choice back.", "Votre version reste tant que vous n’avez pas choisi. Annuler revient sur un choix.";
    ANNOTATION: "annotation", "annotation";
    TIER: "tier", "acteur";
    RECORDING: "recording", "enregistrement";
    SOURCE_FILE: "source file", "fichier source";
    TRACK: "track", "piste";
    CHANNEL: "channel", "canal";
    SKELETON: "skeleton", "squelette";
    SIGNER: "signer", "signeur";
    PERSON_ALIAS: "other name of a person", "autre nom d’une personne";
    PERSON_ATTRIBUTE: "attribute of a person", "attribut d’une personne";
    LEXICON: "lexicon", "lexique";
    SIGN: "sign", "signe";
    TOKEN: "token", "occurrence";
    NOTATION: "notation", "notation";
    ATTRIBUTE: "attribute", "attribut";
    INVENTORY: "inventory", "inventaire";
    INVENTORY_VALUE: "inventory value", "valeur d’inventaire";
    RECIPE: "recipe", "recette";
    SEARCH: "saved search", "recherche enregistrée";
    STUDY: "study", "étude";
    PARTICIPANT: "participant of a study", "participant d’une étude";
    ANSWER: "answer of a study", "réponse d’une étude";
    ROW: "row", "ligne";
}

/// Returns the noun for an object of a merged kind, such as `annotation`.
#[must_use]
pub fn merged_kind_noun(table: &str) -> InterfaceText {
    let kinds = [
        ("annotation", ANNOTATION),
        ("tier", TIER),
        ("recording", RECORDING),
        ("source_file", SOURCE_FILE),
        ("track", TRACK),
        ("channel", CHANNEL),
        ("skeleton", SKELETON),
        ("signer", SIGNER),
        ("person_alias", PERSON_ALIAS),
        ("person_attribute", PERSON_ATTRIBUTE),
        ("lexicon", LEXICON),
        ("sign", SIGN),
        ("token", TOKEN),
        ("notation", NOTATION),
        ("attribute", ATTRIBUTE),
        ("inventory", INVENTORY),
        ("inventory_value", INVENTORY_VALUE),
        ("recipe", RECIPE),
        ("kept_search", SEARCH),
        ("study", STUDY),
        ("study_participant", PARTICIPANT),
        ("study_answer", ANSWER),
    ];
    let table_kind = kinds.into_iter().find(|(name, _)| *name == table);
    table_kind.map_or(ROW, |kind| kind.1)
}

/// Returns the word for a decision.
#[must_use]
pub fn decision_word(decision: ConflictDecision) -> InterfaceText {
    match decision {
        ConflictDecision::Mine => MINE,
        ConflictDecision::Theirs => THEIRS,
        ConflictDecision::Both => BOTH,
    }
}
