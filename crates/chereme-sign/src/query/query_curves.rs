//! Conditions on curves of the face and head: `nonmanual.brows>0.5 for 0.3s`.

use super::query_lex::{QueryCursor, WordContext};
use super::query_tree::{CurveTest, TestSubject};
use super::{QueryError, query_attributes, query_times};

/// The words before the minimum duration of a condition.
const DURATION_WORDS: [&str; 2] = ["for", "pendant"];

/// Returns the name of a curve after the word of the component.
fn name_of(word: &str) -> Option<String> {
    let (first, name) = word.split_once('.')?;
    let component: crate::SignComponent = first.to_lowercase().parse().ok()?;
    let plain = |letter: char| letter.is_alphanumeric() || "_-".contains(letter);
    let named = component == crate::SignComponent::NonManual && !name.is_empty() && name.chars().all(plain);
    named.then(|| name.to_lowercase().replace('-', "_"))
}

/// Returns whether a word names a curve and a number follows; the cursor is before the operator.
pub(super) fn is_curve_comparison(cursor: &QueryCursor<'_>, word: &str) -> bool {
    name_of(word).is_some() && query_attributes::is_attribute_comparison(cursor)
}

/// Reads the operator, the number, and the minimum duration.
pub(super) fn parse_curve_test(cursor: &mut QueryCursor<'_>, word: &str) -> Result<CurveTest, QueryError> {
    let name = name_of(word).unwrap_or_default();
    let TestSubject::Attribute(name, test) = query_attributes::parse_attribute_test(cursor, name)? else {
        return Err(QueryError::new(
            cursor.next(0),
            "a number should stand here",
            "write for example nonmanual.brows>0.5",
        ));
    };
    let mut ahead = cursor.clone();
    ahead.skip_blanks();
    let word_at = ahead.skip_bare_word(WordContext::Term);
    let mut lasting = 0;
    if DURATION_WORDS.contains(&&*ahead.text_at_place(word_at)) {
        ahead.skip_blanks();
        let chunk = ahead.clone().skip_text_chunk();
        if ahead
            .text_at_place(chunk)
            .starts_with(|letter: char| letter.is_ascii_digit() || letter == '.')
        {
            lasting = query_times::parse_unit_time(&mut ahead)?;
            *cursor = ahead;
        }
    }
    Ok(CurveTest { name, test, lasting })
}

#[cfg(test)]
mod tests {
    use super::super::TokenQuery;

    #[test]
    fn curves_are_compared_with_numbers_for_a_time() {
        for (text, canonical) in [
            ("nonmanual.brows>0.5 for 0.3s", "nonmanual.brows>0.5 for 0.3s"),
            (
                "nonmanual.Brows > 0,5 for 300 ms gloss=QUI",
                "nonmanual.brows>0.5 for 0.3s gloss=QUI",
            ),
            ("not nonmanual.head-yaw<=-10", "not nonmanual.head_yaw<=-10"),
            ("nonmanual.lids=0.5..1 pendant 1s", "nonmanual.lids=0.5..1 for 1s"),
            (
                "nonmanual.brows>0.5 for 0.3s overlaps nonmanual.brows=raised",
                "nonmanual.brows>0.5 for 0.3s overlaps nonmanual.brows=raised",
            ),
        ] {
            let query: TokenQuery = text.parse().unwrap_or_else(|error| panic!("{text}: {error:?}"));
            assert_eq!(query.to_string(), canonical, "{text}");
            assert_eq!(canonical.parse::<TokenQuery>(), Ok(query), "{canonical}");
        }
        for (text, message) in [
            ("overlaps nonmanual.brows>0.5", "no annotation"),
            ("nonmanual.brows=5..2", "ends before it starts"),
            ("nonmanual.brows>0.5 for 3", "no unit"),
        ] {
            let error = text.parse::<TokenQuery>().expect_err(text);
            assert!(error.message.contains(message), "{text}: {error:?}");
        }
        let plain: TokenQuery = "nonmanual.brows=raised".parse().expect("a component");
        assert_eq!(plain.to_string(), "nonmanual.brows=raised");
    }
}
