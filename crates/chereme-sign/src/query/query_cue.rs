//! Comparisons of keys of cued speech: `cue=24`, `cue.shape=5`, `cue.placement=throat`, `cue.phase>100`.
//!
//! A key is a token whose gloss names placement and shape, so that these comparisons are short forms of a comparison of
//! its gloss, or of the attribute with the hand's delay in milliseconds.

use super::query_compare::comparison_of_key;
use super::query_lex::QueryCursor;
use super::query_tree::{QueryPlace, QueryValue, TestSubject, WantedValue};
use super::{QueryError, TextField, TextPattern, query_attributes};
use crate::cue;

/// The attribute of a key that holds its phase: milliseconds from the sound's start to the hand at its target.
const KEY_PHASE_ATTRIBUTE: &str = "cue-phase";

/// Returns whether a word names a property of a key.
pub(super) fn is_field(name: &str) -> bool {
    let lower = name.to_lowercase();
    matches!(&*lower, "cue" | "clé" | "cle") || lower.starts_with("cue.")
}

/// Reads the comparison after the field `name`, which is at `at`.
pub(super) fn parse_cue_test(
    cursor: &mut QueryCursor<'_>,
    name: &str,
    at: QueryPlace,
) -> Result<TestSubject, QueryError> {
    let written_part = name.split_once('.').map_or("", |(_, part)| part);
    let part = written_part.to_lowercase();
    let glob: fn(&str) -> Option<String> = match &*part {
        "" => cue_key_gloss,
        "shape" | "handshape" | "configuration" | "forme" => |text| Some(format!("cue:*-{text}")),
        "placement" | "place" | "location" | "lieu" => |text| Some(format!("cue:{}-*", cue_placement_name(text))),
        "phase" => {
            return query_attributes::parse_attribute_test(cursor, KEY_PHASE_ATTRIBUTE.to_owned());
        }
        _ => {
            let message = format!("a key has no part {part:?}");
            return Err(QueryError::new(
                at,
                message,
                "write cue=24, cue.shape=5, cue.placement=throat or cue.phase>100",
            ));
        }
    };
    let mut comparison = comparison_of_key(cursor)?;
    for value in &mut comparison.values {
        value.wanted = WantedValue::Named(cue_value_pattern(value, glob)?);
    }
    Ok(TestSubject::Whole(TextField::Gloss, comparison))
}

fn cue_value_pattern(value: &QueryValue, glob: fn(&str) -> Option<String>) -> Result<TextPattern, QueryError> {
    let glob_text = match &value.wanted {
        WantedValue::Present => Some("cue:*".to_owned()),
        WantedValue::Named(pattern) => pattern.as_literal().and_then(glob),
        _ => None,
    };
    glob_text.map(|text| TextPattern::from_glob(&text)).ok_or_else(|| {
        let remedy = "a key is written as placement and shape: mouth-4, or 24 with the numbers of the paper (1 side, 2 mouth, 3 chin, 4 cheek, 5 throat)";
        QueryError::new(value.at, "this is no key", remedy)
    })
}

/// Returns the gloss of a key, however it is written.
fn cue_key_gloss(text: &str) -> Option<String> {
    let (placement, shape) = cue::key_of_label(text)?;
    Some(cue::gloss_cue_key(placement, shape))
}

/// Returns the name of a placement; a number of the founding paper is translated.
fn cue_placement_name(text: &str) -> &str {
    let number = text.parse().ok().and_then(cue::placement_of_number);
    number.unwrap_or(text)
}

#[cfg(test)]
mod tests {
    use super::super::TokenQuery;

    #[test]
    fn keys_are_found_by_number_name_shape_and_placement() {
        for (text, canonical) in [
            ("cue=24", "gloss=cue:mouth-4"),
            ("cue=mouth-4,31", "gloss=cue:mouth-4,cue:chin-1"),
            ("cue.shape=5 cue.placement=throat", "gloss=cue:*-5 gloss=cue:throat-*"),
            ("cue.placement=5", "gloss=cue:throat-*"),
            ("cue=24 meets cue=31", "gloss=cue:mouth-4 meets gloss=cue:chin-1"),
            ("cue=*", "gloss=cue:*"),
            ("cue.phase>100", "attribute.cue-phase>100"),
        ] {
            let query: TokenQuery = text.parse().expect(text);
            assert_eq!(query.to_string(), canonical, "{text}");
            assert_eq!(canonical.parse::<TokenQuery>(), Ok(query), "{canonical}");
        }
        for wrong in ["cue=4", "cue=79", "cue=19", "cue.colour=red", "cue=unset"] {
            assert!(wrong.parse::<TokenQuery>().is_err(), "{wrong}");
        }
    }
}
