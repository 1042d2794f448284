//! Comparisons of attributes, the numbers and texts about a sign in tables: `frequency>0.4`, `attribute.class=Noun`,
//! `attribute("Sign Frequency")=2..5`.

use super::QueryError;
use super::query_compare::{comparison_of_attribute, operator_place};
use super::query_lex::{QueryCursor, WordContext};
use super::query_tree::{QueryPlace, QueryTest, TestSubject, ValueComparison};
use std::fmt::{self, Display, Formatter};
use std::ops::{Bound, RangeBounds};

/// The condition on an attribute.
#[derive(Debug, Clone, PartialEq)]
pub enum AttributeTest {
    /// A number within bounds.
    Number(Bound<f64>, Bound<f64>),
    /// One of the values, or a value outside the list; a number equals the same number in another spelling.
    Value(ValueComparison),
}

impl AttributeTest {
    /// Returns whether a number lies within the bounds.
    #[must_use]
    pub fn accepts_attribute_number(&self, number: f64) -> bool {
        match self {
            Self::Number(least, most) => (*least, *most).contains(&number),
            Self::Value(_) => false,
        }
    }
}

impl Display for AttributeTest {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Value(comparison) => comparison.fmt(f),
            Self::Number(Bound::Excluded(least), _) => write!(f, ">{least}"),
            Self::Number(_, Bound::Excluded(most)) => write!(f, "<{most}"),
            Self::Number(Bound::Included(least), Bound::Included(most)) => {
                write!(f, "={least}..{most}")
            }
            Self::Number(Bound::Included(least), _) => write!(f, ">={least}"),
            Self::Number(_, Bound::Included(most)) => write!(f, "<={most}"),
            Self::Number(Bound::Unbounded, Bound::Unbounded) => f.write_str("=*"),
        }
    }
}

/// The word that opens the name of an attribute.
pub(super) const ATTRIBUTE_WORD: &str = "attribute";
/// The same in French.
const FRENCH_ATTRIBUTE_WORD: &str = "attribut";

/// Returns whether a word opens the name of an attribute in parentheses.
pub(super) fn opens_name(word: &str) -> bool {
    word == ATTRIBUTE_WORD || word == FRENCH_ATTRIBUTE_WORD
}

/// The words before the name of something that is said of a signer: `signer.region`.
const SIGNER_ATTRIBUTE_WORDS: [&str; 2] = ["signer", "signeur"];

/// The words before the name of a relation to other signs: `related.variant`.
const RELATION_WORDS: [&str; 2] = ["related", "relation"];

/// Returns the name of the attribute that a word is: the name after `attribute.`, or the whole of `signer.region` or
/// `related.variant`.
pub(super) fn attribute_name_of_word(word: &str) -> Option<String> {
    let (first, name) = word.split_once('.').filter(|(_, name)| !name.is_empty())?;
    let first = first.to_lowercase();
    let words = [SIGNER_ATTRIBUTE_WORDS, RELATION_WORDS];
    match words.iter().find(|words| words.contains(&first.as_str())) {
        Some([word, _]) => Some(format!("{word}.{name}")),
        None => opens_name(&first).then(|| name.to_owned()),
    }
}

/// Returns whether the operator and the text after it compare a name with a number, as in `frequency>0.4` or
/// `frequency=0.2..0.5`; the cursor is before the operator.
pub(super) fn is_attribute_comparison(cursor: &QueryCursor<'_>) -> bool {
    let (operator, text) = peek_operator_text(cursor);
    match &*operator {
        "<" | "<=" | "=<" | "≤" | ">" | ">=" | "=>" | "≥" => parse_plain_number(&text).is_some(),
        "=" => text.split_once("..").is_some_and(|(from, to)| {
            let bound = |text: &str| text.is_empty() || parse_plain_number(text).is_some();
            bound(from) && bound(to) && text.len() > 2
        }),
        _ => false,
    }
}

/// Returns whether the operator and the text after it compare a name with a single number, or ask whether it has a
/// value: `iconicity=5`, `frequency!=2`, `frequency=*`, `frequency=unset`; the cursor is before the operator.
pub(super) fn is_single_number_comparison(cursor: &QueryCursor<'_>) -> bool {
    let (operator, text) = peek_operator_text(cursor);
    ["=", "==", "!=", "≠"].contains(&&*operator)
        && (parse_plain_number(&text).is_some() || ["*", "unset"].contains(&&*text))
}

/// Returns the operator at the cursor and the text after it, without moving the cursor.
fn peek_operator_text(cursor: &QueryCursor<'_>) -> (String, String) {
    let mut ahead = cursor.clone();
    let operator_at = operator_place(&mut ahead);
    let operator = ahead.text_at_place(operator_at);
    ahead.skip_blanks();
    let chunk = ahead.skip_text_chunk();
    (operator, ahead.text_at_place(chunk))
}

/// Reads `("name")` and the comparison after the word `parse_attribute_comparison`, which is at `at`.
pub(super) fn in_parentheses(cursor: &mut QueryCursor<'_>, at: QueryPlace) -> Result<QueryTest, QueryError> {
    const PARENTHESES_REMEDY: &str = r#"write for example attribute("Sign Frequency")>2"#;
    cursor.skip_blanks();
    let open = cursor.next(1);
    cursor.pos = open.end;
    cursor.skip_blanks();
    let word = cursor.read_query_word(WordContext::Value)?;
    let name = word.pattern.as_literal().unwrap_or_default().trim();
    if name.is_empty() {
        return Err(QueryError::new(
            word.at,
            "the name of an attribute should stand here",
            PARENTHESES_REMEDY,
        ));
    }
    cursor.skip_blanks();
    // The name may be a word without quotes, which ends at the first blank.
    if !cursor.eat_char(')') {
        let remedy = "write ) after the name; a name with blanks needs quotes";
        return Err(QueryError::new(open, "this parenthesis is not closed", remedy));
    }
    let subject_at = cursor.place_since(at.start);
    cursor.skip_blanks();
    if cursor.peek_operator().is_none() {
        let message = "a comparison should follow the attribute";
        return Err(QueryError::new(cursor.next(0), message, PARENTHESES_REMEDY));
    }
    let what = parse_attribute_test(cursor, name.to_owned())?;
    Ok(QueryTest {
        at: cursor.place_since(at.start),
        subject_at,
        what,
    })
}

/// Reads the operator and its right side.
pub(super) fn parse_attribute_test(cursor: &mut QueryCursor<'_>, name: String) -> Result<TestSubject, QueryError> {
    let start = cursor.clone();
    let operator_at = operator_place(cursor);
    let operator = cursor.text_at_place(operator_at);
    cursor.skip_blanks();
    let chunk = cursor.skip_text_chunk();
    let text = cursor.text_at_place(chunk);
    let needed = |text: &str| {
        parse_plain_number(text).ok_or_else(|| {
            let message = format!("{text:?} is no number");
            QueryError::new(chunk, message, "write a number such as 0.4")
        })
    };
    let (least, most) = match &*operator {
        "<" => (Bound::Unbounded, Bound::Excluded(needed(&text)?)),
        "<=" | "=<" | "≤" => (Bound::Unbounded, Bound::Included(needed(&text)?)),
        ">" => (Bound::Excluded(needed(&text)?), Bound::Unbounded),
        ">=" | "=>" | "≥" => (Bound::Included(needed(&text)?), Bound::Unbounded),
        _ => match text.split_once("..") {
            Some((from, to)) if operator == "=" && is_attribute_comparison(&start) => {
                let bound = |text: &str| parse_plain_number(text).map_or(Bound::Unbounded, Bound::Included);
                (bound(from), bound(to))
            }
            _ => {
                *cursor = start;
                let comparison = comparison_of_attribute(cursor)?;
                return Ok(TestSubject::Attribute(name, AttributeTest::Value(comparison)));
            }
        },
    };
    if let (Bound::Included(from), Bound::Included(to)) = (least, most)
        && from > to
    {
        return Err(QueryError::new(
            chunk,
            "this range ends before it starts",
            "the lesser number stands first",
        )
        .with_suggestion(Some(format!("{to}..{from}"))));
    }
    Ok(TestSubject::Attribute(name, AttributeTest::Number(least, most)))
}

/// Reads a number as people and tables write it: `0.4`, `-1`, `1e3`, `0,4`.
#[must_use]
pub fn parse_plain_number(text: &str) -> Option<f64> {
    let text = text.trim();
    let numeral = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | 'e' | 'E');
    let point = match text.split_once(',') {
        Some((whole, part)) if !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit()) => {
            format!("{whole}.{part}")
        }
        _ => text.to_owned(),
    };
    let parsed = point.parse::<f64>().ok();
    parsed.filter(|number| number.is_finite() && point.chars().all(numeral))
}

/// Returns the name of an attribute as a query spells it: `attribute.frequency`, `attribute("Sign Frequency")`.
#[must_use]
pub fn attribute_field_text(name: &str) -> String {
    struct SpelledName<'a>(&'a str);
    impl fmt::Display for SpelledName<'_> {
        fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
            write_name(f, self.0)
        }
    }
    SpelledName(name).to_string()
}

/// Returns whether a text is the name of an attribute as a query spells it.
pub(super) fn is_attribute_field(text: &str) -> bool {
    let opens = text.split_once('(').is_some_and(|(word, _)| opens_name(word));
    opens || attribute_name_of_word(text).is_some()
}

/// Writes the name of an attribute as a query spells it.
pub(super) fn write_name(f: &mut Formatter<'_>, name: &str) -> fmt::Result {
    let plain = |c: char| c.is_alphanumeric() || "-_.".contains(c);
    if name.chars().all(plain) && !name.starts_with('.') {
        write!(f, "{ATTRIBUTE_WORD}.{name}")
    } else {
        write!(f, "{ATTRIBUTE_WORD}(")?;
        super::query_print::write_quoted(f, &super::TextPattern::literal_pattern(name))?;
        f.write_str(")")
    }
}

#[cfg(test)]
mod tests {
    use super::super::TokenQuery;

    #[test]
    fn attributes_are_compared_with_numbers_and_values() {
        for (text, canonical) in [
            ("frequency>0.4", "attribute.frequency>0.4"),
            ("frequency >= 2 placement=chin", "attribute.frequency>=2 placement=chin"),
            ("Iconicity(M)<3,5", "attribute(\"Iconicity(M)\")<3.5"),
            ("frequency=0.2..0.5", "attribute.frequency=0.2..0.5"),
            ("not frequency=..3", "not attribute.frequency<=3"),
            ("iconicity=5", "attribute.iconicity=5"),
            ("iconicity!=2", "attribute.iconicity!=2"),
            ("iconicity=*", "attribute.iconicity=*"),
            ("not iconicity=unset", "not attribute.iconicity=unset"),
            (
                "attribute.MajorLocation.2.0Frequency>-1",
                "attribute.MajorLocation.2.0Frequency>-1",
            ),
            ("attribute.class=Noun,Verb", "attribute.class=Noun,Verb"),
            ("attribut.class!=\"two words\"", "attribute.class!=\"two words\""),
            (
                "attribute(\"Sign Frequency\")=unset",
                "attribute(\"Sign Frequency\")=unset",
            ),
            ("attribute.n=2", "attribute.n=2"),
            ("signer.region=north", "attribute.signer.region=north"),
            (
                "Signeur.age>40 placement=chin",
                "attribute.signer.age>40 placement=chin",
            ),
            ("attribute.x=*", "attribute.x=*"),
        ] {
            let query: TokenQuery = text.parse().expect(text);
            assert_eq!(query.to_string(), canonical, "{text}");
            assert_eq!(canonical.parse::<TokenQuery>(), Ok(query), "{canonical}");
        }
        for (text, message) in [
            ("attribute.x>much", "\"much\" is no number"),
            ("attribute.x=5..2", "ends before it starts"),
            ("attribute(\"\")>2", "name of an attribute"),
            ("attribute(x>2", "not closed"),
            ("attribute(x)", "a comparison should follow"),
            ("attribute.x=[a]", "only components have features"),
            ("durration>0.8s", "there is no field"),
            ("overlaps frequency>2", "no annotation"),
        ] {
            let error = text.parse::<TokenQuery>().expect_err(text);
            assert!(error.message.contains(message), "{text}: {error:?}");
        }
    }
}
