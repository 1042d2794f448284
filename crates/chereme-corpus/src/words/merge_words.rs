//! Words for differences, merges and their conflicts.

use super::InterfaceText;
use super::effect::ConflictDecision;

pub use crate::words::texts::merging::*;

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
        ("sign_relation", SIGN_RELATION),
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
