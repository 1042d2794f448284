//! Adds conditions to the text of a query and removes them.

use super::query_attributes::{is_attribute_field, parse_plain_number};
use super::query_print::write_value;
use super::query_tree::{QueryExpression, TokenQuery};
use super::{TextField, TextPattern, WholeTokenProperty};
use crate::component::ComponentField;

/// Returns the query with a condition added: its text, in parentheses if it is an `or`, then the condition.
///
/// The text keeps its spelling. A query that already has the condition stays unchanged; a text that is not a valid
/// query gets the condition at its end, so that nothing typed is lost.
///
/// ```
/// use chereme_sign::query::{add_query_condition, remove_query_condition};
///
/// let narrowed = add_query_condition("gloss=A or gloss=B", "placement==chin");
/// assert_eq!(narrowed, "(gloss=A or gloss=B) placement==chin");
/// assert_eq!(remove_query_condition(&narrowed, "placement==chin"), "gloss=A or gloss=B");
/// ```
#[must_use]
pub fn add_query_condition(query: &str, condition: &str) -> String {
    let (query, condition) = (query.trim(), condition.trim());
    let (Ok(whole), Ok(added)) = (TokenQuery::parse_query(query), TokenQuery::parse_query(condition)) else {
        return format!("{query} {condition}").trim().to_owned();
    };
    if includes(&whole.root, &added.root) {
        return query.to_owned();
    }
    let wanted = TokenQuery {
        root: QueryExpression::all_of_terms([whole.root.clone(), added.root.clone()]),
    };
    let text = format!(
        "{} {}",
        bracketed(query, &whole.root),
        bracketed(condition, &added.root)
    );
    keep_equal_spelling(text.trim(), &wanted)
}

/// Returns the query without a condition; unchanged if it does not have the condition.
///
/// Only terms that must hold are removed: the condition inside an `or` or after `not` stays.
#[must_use]
pub fn remove_query_condition(query: &str, condition: &str) -> String {
    let query = query.trim();
    let (Ok(whole), Ok(removed)) = (TokenQuery::parse_query(query), TokenQuery::parse_query(condition)) else {
        return query.to_owned();
    };
    let removed = joined_terms(&removed.root);
    if removed.is_empty() || !includes(&whole.root, &QueryExpression::And(removed.to_vec())) {
        return query.to_owned();
    }
    let chars: Vec<char> = query.chars().collect();
    let (mut left, mut gaps) = (Vec::new(), Vec::new());
    for term in joined_terms(&whole.root) {
        if removed.contains(term) {
            gaps.push(term.expression_place());
        } else {
            left.push(term.clone());
        }
    }
    let wanted = TokenQuery {
        root: QueryExpression::all_of_terms(left),
    };
    let mut text = String::new();
    let mut from = 0;
    for gap in gaps {
        let until = gap.start.clamp(from, chars.len());
        let before: String = chars[from..until].iter().collect();
        text.push_str(before.trim_end());
        text.push(' ');
        from = gap.end.clamp(until, chars.len());
    }
    let rest: String = chars[from..].iter().collect();
    text.push_str(rest.trim_start());
    let text = text.trim();
    // Parentheses around all that is left mean nothing any more.
    let opened = text.strip_prefix('(').and_then(|text| text.strip_suffix(')'));
    match opened.map(|text| (text.trim(), TokenQuery::parse_query(text))) {
        Some((inner, Ok(query))) if query == wanted => inner.to_owned(),
        _ => keep_equal_spelling(text, &wanted),
    }
}

/// Returns whether a query has a condition: whether each of the condition's terms is one of its terms that must hold.
#[must_use]
pub fn has_query_condition(query: &str, condition: &str) -> bool {
    match (TokenQuery::parse_query(query), TokenQuery::parse_query(condition)) {
        (Ok(whole), Ok(condition)) => {
            !joined_terms(&condition.root).is_empty() && includes(&whole.root, &condition.root)
        }
        _ => false,
    }
}

/// Returns the condition for a value of a facet: exactly this value of this field.
///
/// `both.configuration`, which queries do not have, becomes a term for each hand. Returns `None` for a field that no
/// query can name.
#[must_use]
pub fn facet_condition(field: &str, value: &str) -> Option<String> {
    let mut written = String::new();
    write_value(&mut written, &TextPattern::literal_pattern(value)).ok()?;
    let (before, hand_and_after) = match field.split_once("both.") {
        Some((before, after)) if before.is_empty() || before.ends_with('.') => (before, Some(after)),
        _ => (field, None),
    };
    let fields = match hand_and_after {
        Some(after) => ["right", "left"].map(|hand| format!("{before}{hand}.{after}")).to_vec(),
        None => vec![field.to_owned()],
    };
    // Many different numbers of an attribute are counted in ranges, each without its upper end.
    let range = value.split_once(" to ").filter(|_| is_attribute_field(field));
    let range = range.and_then(|(from, to)| Some((parse_plain_number(from)?, parse_plain_number(to)?)));
    let terms: Vec<String> = match range {
        Some((from, to)) => vec![format!("{field}>={from}"), format!("{field}<{to}")],
        None => fields.iter().map(|field| format!("{field}=={written}")).collect(),
    };
    let text = terms.join(" ");
    let simple = |name: &str| {
        WholeTokenProperty::ALL_TOKEN_PROPERTIES
            .iter()
            .any(|property| property.property_name() == name)
            || TextField::ALL_TEXT_FIELDS
                .iter()
                .any(|text_field| text_field.text_field_name() == name)
    };
    let are_known = fields
        .iter()
        .all(|field| simple(field) || is_attribute_field(field) || field.parse::<ComponentField>().is_ok());
    (are_known && TokenQuery::parse_query(&text).is_ok()).then_some(text)
}

/// Returns the terms that must all hold.
fn joined_terms(root: &QueryExpression) -> &[QueryExpression] {
    match root {
        QueryExpression::And(terms) => terms,
        one => std::slice::from_ref(one),
    }
}

fn includes(whole: &QueryExpression, part: &QueryExpression) -> bool {
    let whole_terms = joined_terms(whole);
    joined_terms(part).iter().all(|term| whole_terms.contains(term))
}

fn bracketed(text: &str, root: &QueryExpression) -> String {
    match root {
        QueryExpression::Or(_) => format!("({text})"),
        _ => text.to_owned(),
    }
}

/// Returns the text if it means `wanted`, else the canonical text of `wanted`.
fn keep_equal_spelling(text: &str, wanted: &TokenQuery) -> String {
    match TokenQuery::parse_query(text) {
        Ok(query) if query == *wanted => text.to_owned(),
        _ => wanted.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn an_added_condition_narrows_the_whole_query_and_is_removed_again() {
        for (query, condition, narrowed) in [
            ("", "placement==chin", "placement==chin"),
            ("handshape=U", "placement==chin", "handshape=U placement==chin"),
            (
                "gloss=A or gloss=B",
                "placement==chin",
                "(gloss=A or gloss=B) placement==chin",
            ),
            ("a (b or c)", "gloss==\"X Y\"", "a (b or c) gloss==\"X Y\""),
            (
                "not a",
                "right.configuration==B left.configuration==B",
                "not a right.configuration==B left.configuration==B",
            ),
            (
                "like CHAT on configuration, placement",
                "hand==both",
                "like CHAT on configuration, placement hand==both",
            ),
            ("snail", "gloss=A or gloss=B", "snail (gloss=A or gloss=B)"),
        ] {
            assert_eq!(add_query_condition(query, condition), narrowed, "{query}");
            assert!(has_query_condition(narrowed, condition), "{narrowed}");
            // A condition is added only once.
            assert_eq!(add_query_condition(narrowed, condition), narrowed);
            if !condition.contains(" or ") {
                assert_eq!(remove_query_condition(narrowed, condition), query, "{narrowed}");
            }
        }
    }

    #[test]
    fn only_a_required_condition_is_removed() {
        for (query, condition, left) in [
            ("a placement=chin b", "placement=chin", "a b"),
            ("a and placement=chin and b", "placement=chin", "a b"),
            ("placement=chin", "placement=chin", ""),
            ("placement=chin or a", "placement=chin", "placement=chin or a"),
            ("not placement=chin", "placement=chin", "not placement=chin"),
            ("a not placement=chin b", "not placement=chin", "a b"),
            ("a b", "placement=chin", "a b"),
            ("(a placement=chin) b", "placement=chin", "(a) b"),
            ("gloss=(", "a", "gloss=("),
            ("é placement=chin", "placement=chin", "é"),
        ] {
            let text = remove_query_condition(query, condition);
            let same = match (TokenQuery::parse_query(&text), TokenQuery::parse_query(left)) {
                (Ok(found), Ok(wanted)) => found == wanted,
                _ => text == left,
            };
            assert!(same, "{query} without {condition}: {text}");
        }
        assert!(
            !has_query_condition("a or b", "a") && !has_query_condition("a", "") && has_query_condition("a b", "b")
        );
    }

    #[test]
    fn a_facet_is_a_condition() {
        for (field, value, condition) in [
            ("placement", "neutral space", r#"placement=="neutral space""#),
            ("initial.right.placement", "chin", "initial.right.placement==chin"),
            (
                "both.configuration",
                "B",
                "right.configuration==B left.configuration==B",
            ),
            (
                "initial.both.placement",
                "chin",
                "initial.right.placement==chin initial.left.placement==chin",
            ),
            ("gloss", "CHAT", "gloss==CHAT"),
            ("signer", "A*", r#"signer=="A\*""#),
            ("hand", "both", "hand==both"),
            ("attribute.class", "Noun", "attribute.class==Noun"),
            (
                "attribute.density",
                "10 to 20",
                "attribute.density>=10 attribute.density<20",
            ),
        ] {
            assert_eq!(facet_condition(field, value).as_deref(), Some(condition));
        }
        for (field, value) in [("nothing", "x"), ("placement", ""), ("movement.a b", "x")] {
            assert_eq!(facet_condition(field, value), None, "{field}={value}");
        }
    }

    fn query() -> impl Strategy<Value = String> {
        let term = prop::sample::select(vec![
            "a",
            "not b",
            "placement=chin",
            "(a or gloss=B)",
            "handshape=U,V",
            "overlaps gloss=C",
            "\"x y\"",
            "duration<1s",
        ]);
        let joint = prop::sample::select(vec![" ", " or ", " and "]);
        prop::collection::vec((term, joint), 0..5).prop_map(|parts| {
            let mut text = String::new();
            for (at, (term, joint)) in parts.iter().enumerate() {
                if at > 0 {
                    text.push_str(joint);
                }
                text.push_str(term);
            }
            text
        })
    }

    proptest! {
        #[test]
        fn an_added_condition_can_be_removed(query in query()) {
            let narrowed = add_query_condition(&query, "hand==weak");
            let parsed = TokenQuery::parse_query(&narrowed).expect("a query");
            let own = TokenQuery::parse_query(&query).expect("a query");
            let added = TokenQuery::parse_query("hand==weak").expect("a query");
            prop_assert_eq!(parsed.root, QueryExpression::all_of_terms([own.root.clone(), added.root]));
            let again = remove_query_condition(&narrowed, "hand==weak");
            prop_assert_eq!(TokenQuery::parse_query(&again).expect("a query"), own, "{}", narrowed);
        }

        #[test]
        fn any_text_is_accepted(query in ".{0,40}", condition in ".{0,20}") {
            let narrowed = add_query_condition(&query, &condition);
            let _ = remove_query_condition(&narrowed, &condition);
            let _ = has_query_condition(&query, &condition);
            let _ = facet_condition(&query, &condition);
        }
    }
}
