//! Battison's two conditions on signs with two hands.
//!
//! Symmetry: if both hands move, they have the same handshape (and movement and place, which are not looked at here).
//! Dominance: if the handshapes differ, one hand is passive, and its handshape is one of a few unmarked ones. Source:
//! Battison 1978.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use chereme_analysis::statistics::wilson_interval;
use chereme_formats::lexicon::is_value;
use chereme_sign::text::fold_text;
use serde::{Deserialize, Serialize};

use super::{STATS_INTERVAL_LEVEL, StatsEstimate, StatsOptions};
use crate::error::{CorpusError, CorpusResult};
use crate::forms::{SignForm, SignForms};

/// The unmarked handshapes of Battison 1978.
const UNMARKED_HANDSHAPES: [&str; 7] = ["B", "A", "S", "C", "O", "1", "5"];

/// The conditions on the two hands.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BattisonConditions {
    /// The number of one-handed entries.
    pub one_handed: usize,
    /// The number of entries of no known type.
    pub other: usize,
    /// The handshapes that count as unmarked.
    pub unmarked: Vec<String>,
    /// Symmetrical entries: both handshapes are the same.
    pub symmetry: HandCondition,
    /// Asymmetrical entries: the handshapes are the same, or that of the weak hand is unmarked.
    pub dominance: HandCondition,
}

/// A condition, and the entries that keep it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HandCondition {
    /// The number of entries of the type.
    pub entries: usize,
    /// The number of them with both handshapes.
    pub given: usize,
    /// The number of these whose handshapes are the same.
    pub same: usize,
    /// The number of these whose handshapes differ.
    pub different: usize,
    /// The number of those that differ whose weak hand is unmarked.
    pub different_unmarked: usize,
    /// The share of entries with both handshapes whose weak hand is unmarked, with Wilson's interval.
    pub unmarked_share: StatsEstimate,
    /// The share of entries with both handshapes that keep the condition, with Wilson's interval.
    pub kept: StatsEstimate,
    /// The entries that do not keep it, by gloss.
    pub exceptions: Vec<TwoHands>,
    /// The glosses of the entries without one of the handshapes.
    pub incomplete: Vec<String>,
}

/// The handshapes of an entry.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct TwoHands {
    /// The gloss.
    pub gloss: String,
    /// The line of its table.
    pub line: Option<u64>,
    /// The handshape of the strong hand.
    pub strong: String,
    /// The handshape of the weak hand.
    pub weak: String,
}

/// The types of signs by their hands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum SignType {
    OneHanded,
    Symmetrical,
    Asymmetrical,
}

/// Words for types, letters and digits alone, with the type.
static SIGN_TYPE_WORDS: LazyLock<BTreeMap<String, SignType>> = LazyLock::new(|| {
    let file = chereme_data::schema_text("sign_types.json");
    let file: BTreeMap<SignType, Vec<String>> =
        serde_json::from_str(file).expect("the shipped table of types is whole; a test reads it");
    let words = |(of, words): (SignType, Vec<String>)| -> Vec<(String, SignType)> {
        words.iter().map(|word| (fold_to_letters(word), of)).collect()
    };
    file.into_iter().flat_map(words).collect()
});

/// Returns the letters and digits of a word, without case and accents.
fn fold_to_letters(word: &str) -> String {
    fold_text(word)
        .chars()
        .filter(|letter| letter.is_alphanumeric())
        .collect()
}

/// Returns the type that a value names.
pub(super) fn sign_type(value: &str) -> Option<SignType> {
    SIGN_TYPE_WORDS.get(&fold_to_letters(value)).copied()
}

/// The places of the fields that say what the hands do.
pub(super) struct HandFieldRoles {
    pub(super) sign_type: Option<usize>,
    pub(super) strong: Option<usize>,
    pub(super) weak: Option<usize>,
    pub(super) placement: Option<usize>,
    pub(super) alternating: Option<usize>,
    /// Spellings of types that are slips of other ones; they are no types.
    slips: Vec<String>,
}

impl HandFieldRoles {
    pub(super) fn find_hand_fields(forms: &SignForms) -> Self {
        let place = |coding: &str| {
            let mut fields = forms.fields.iter();
            fields.position(|field| field.coding.as_deref() == Some(coding))
        };
        let sign_type = place("dominant.configuration.handedness");
        let slips = sign_type.map(|at| super::stats_findings::field_slips(forms, at));
        let slips = slips.into_iter().flatten();
        Self {
            slips: slips.map(|slip| slip.value.to_owned()).collect(),
            sign_type,
            strong: place("dominant.configuration"),
            weak: place("weak.configuration"),
            placement: place("placement"),
            alternating: place("movement.alternating"),
        }
    }

    /// Returns the type of an entry.
    pub(super) fn type_of(&self, row: &SignForm) -> Option<SignType> {
        let value = &row.cells[self.sign_type?];
        let is_slip = self.slips.contains(value);
        // A slip counts as a value of its own, so that its type would be reported twice.
        sign_type(value).filter(|_| !is_slip)
    }
}

/// Returns the conditions and the entries that do not keep them.
pub(super) fn battison_conditions(forms: &SignForms, options: &StatsOptions) -> CorpusResult<BattisonConditions> {
    let roles = HandFieldRoles::find_hand_fields(forms);
    let (Some(_), Some(strong), Some(weak)) = (roles.sign_type, roles.strong, roles.weak) else {
        let names: Vec<&str> = forms.fields.iter().map(|field| field.name.as_str()).collect();
        let text = "the fields do not say the type of a sign and the handshapes of both hands";
        return Err(CorpusError::from_wrong_message(text).with_error_place(names.join(", ")).with_command_advice("name them in --fields: columns such as Handedness, Handshape strong and Handshape weak, or configuration.handedness, configuration and weak.configuration"));
    };
    let unmarked: Vec<String> = match &options.unmarked[..] {
        [] => UNMARKED_HANDSHAPES.map(str::to_owned).to_vec(),
        some => some.to_vec(),
    };
    let types: Vec<Option<SignType>> = forms.rows.iter().map(|row| roles.type_of(row)).collect();
    let of = |wanted: Option<SignType>| types.iter().filter(|kind| **kind == wanted).count();
    let condition = |wanted: SignType| {
        let typed_rows = forms.rows.iter().zip(&types);
        let rows = typed_rows.filter(|(_, it)| **it == Some(wanted));
        let rows: Vec<&SignForm> = rows.map(|(row, _)| row).collect();
        hand_condition(&rows, [strong, weak], wanted, &unmarked)
    };
    Ok(BattisonConditions {
        one_handed: of(Some(SignType::OneHanded)),
        other: of(None),
        symmetry: condition(SignType::Symmetrical),
        dominance: condition(SignType::Asymmetrical),
        unmarked,
    })
}

fn hand_condition(rows: &[&SignForm], [strong, weak]: [usize; 2], of: SignType, unmarked: &[String]) -> HandCondition {
    let has_both = |row: &&SignForm| is_value(&row.cells[strong]) && is_value(&row.cells[weak]);
    let given: Vec<&SignForm> = rows.iter().copied().filter(has_both).collect();
    let is_unmarked = |row: &&SignForm| unmarked.contains(&row.cells[weak]);
    let is_same = |row: &&SignForm| row.cells[strong] == row.cells[weak];
    let (same, different): (Vec<&SignForm>, Vec<&SignForm>) = given.iter().partition(|row| is_same(row));
    // Symmetry demands equal handshapes; dominance also allows a weak hand with an unmarked one.
    let keeps = |row: &&SignForm| of == SignType::Asymmetrical && is_unmarked(row);
    let exception_rows = different.iter().filter(|row| !keeps(row));
    let exceptions: Vec<TwoHands> = exception_rows
        .map(|row| TwoHands {
            gloss: row.gloss.clone(),
            line: row.line,
            strong: row.cells[strong].clone(),
            weak: row.cells[weak].clone(),
        })
        .collect();
    let count = |among: &[&SignForm]| among.iter().filter(|row| is_unmarked(row)).count();
    let incomplete = rows.iter().filter(|row| !has_both(row));
    HandCondition {
        entries: rows.len(),
        given: given.len(),
        same: same.len(),
        different: different.len(),
        different_unmarked: count(&different),
        unmarked_share: wilson_share_estimate(count(&given), given.len()),
        kept: wilson_share_estimate(given.len() - exceptions.len(), given.len()),
        exceptions,
        incomplete: incomplete.map(|row| row.gloss.clone()).collect(),
    }
}

/// Returns a share with Wilson's interval.
fn wilson_share_estimate(count: usize, of: usize) -> StatsEstimate {
    let interval = wilson_interval(count as u64, of as u64, STATS_INTERVAL_LEVEL);
    StatsEstimate::new(interval.map(|_| count as f64 / of as f64)).with_interval(interval)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_of_signs_are_known_by_several_names() {
        for (value, wanted) in [
            ("1", Some(SignType::OneHanded)),
            ("OneHanded", Some(SignType::OneHanded)),
            ("2s", Some(SignType::Symmetrical)),
            ("SymmetricalOrAlternating", Some(SignType::Symmetrical)),
            ("AsymmetricalDifferentHandshape", Some(SignType::Asymmetrical)),
            ("DominanceViolation", Some(SignType::Asymmetrical)),
            ("asymétrique", Some(SignType::Asymmetrical)),
            ("2", None),
            ("", None),
        ] {
            assert_eq!(sign_type(value), wanted, "{value:?}");
        }
    }
}
