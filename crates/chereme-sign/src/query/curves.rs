//! Conditions on curves of the face and head: `nonmanual.brows>0.5 for 0.3s`.

use super::lex::{Cursor, WordContext};
use super::tree::{CurveTest, What};
use super::{QueryError, attributes, times};

/// The words before the minimum duration of a condition.
const FOR: [&str; 2] = ["for", "pendant"];

/// Returns the name of a curve after the word of the component.
fn name_of(word: &str) -> Option<String> {
    let (first, name) = word.split_once('.')?;
    let component: crate::Component = first.to_lowercase().parse().ok()?;
    let plain = |it: char| it.is_alphanumeric() || "_-".contains(it);
    let named =
        component == crate::Component::NonManual && !name.is_empty() && name.chars().all(plain);
    named.then(|| name.to_lowercase().replace('-', "_"))
}

/// Returns whether a word names a curve and a number follows; the cursor is before the operator.
pub(super) fn opens(cursor: &Cursor<'_>, word: &str) -> bool {
    name_of(word).is_some() && attributes::follows(cursor)
}

/// Reads the operator, the number, and the minimum duration.
pub(super) fn test(cursor: &mut Cursor<'_>, word: &str) -> Result<CurveTest, QueryError> {
    let name = name_of(word).unwrap_or_default();
    let What::Attribute(name, test) = attributes::test(cursor, name)? else {
        return Err(QueryError::new(
            cursor.next(0),
            "a number should stand here",
            "write for example nonmanual.brows>0.5",
        ));
    };
    let mut ahead = cursor.clone();
    ahead.skip_blanks();
    let word_at = ahead.bare(WordContext::Term);
    let mut lasting = 0;
    if FOR.contains(&&*ahead.text(word_at)) {
        ahead.skip_blanks();
        let chunk = ahead.clone().chunk();
        if ahead
            .text(chunk)
            .starts_with(|it: char| it.is_ascii_digit() || it == '.')
        {
            lasting = times::time(&mut ahead)?;
            *cursor = ahead;
        }
    }
    Ok(CurveTest {
        name,
        test,
        lasting,
    })
}

#[cfg(test)]
mod tests {
    use super::super::Query;

    #[test]
    fn curves_are_compared_with_numbers_for_a_time() {
        for (text, canonical) in [
            (
                "nonmanual.brows>0.5 for 0.3s",
                "nonmanual.brows>0.5 for 0.3s",
            ),
            (
                "nonmanual.Brows > 0,5 for 300 ms gloss=QUI",
                "nonmanual.brows>0.5 for 0.3s gloss=QUI",
            ),
            ("not nonmanual.head-yaw<=-10", "not nonmanual.head_yaw<=-10"),
            (
                "nonmanual.lids=0.5..1 pendant 1s",
                "nonmanual.lids=0.5..1 for 1s",
            ),
            (
                "nonmanual.brows>0.5 for 0.3s overlaps nonmanual.brows=raised",
                "nonmanual.brows>0.5 for 0.3s overlaps nonmanual.brows=raised",
            ),
        ] {
            let query: Query = text
                .parse()
                .unwrap_or_else(|error| panic!("{text}: {error:?}"));
            assert_eq!(query.to_string(), canonical, "{text}");
            assert_eq!(canonical.parse::<Query>(), Ok(query), "{canonical}");
        }
        for (text, message) in [
            ("overlaps nonmanual.brows>0.5", "no annotation"),
            ("nonmanual.brows=5..2", "ends before it starts"),
            ("nonmanual.brows>0.5 for 3", "no unit"),
        ] {
            let error = text.parse::<Query>().expect_err(text);
            assert!(error.message.contains(message), "{text}: {error:?}");
        }
        let plain: Query = "nonmanual.brows=raised".parse().expect("a component");
        assert_eq!(plain.to_string(), "nonmanual.brows=raised");
    }
}
