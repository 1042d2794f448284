//! The query as rows of conditions: every term of its conjunction is a row.
//!
//! A [`Condition`] can be shown and changed in the builder; any other term stays as it is written.

use chereme_sign::query::{
    Comparison, Example, Expr, Like, Missing, Operator, Pattern, Property, Query, Test, TextField,
    TimeField, TimeTest, Value, Wanted, Weighted, What,
};
use chereme_sign::{Component, Field};

/// The subject of a condition.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Subject {
    Component(Field),
    Property(Property),
    /// A whole text.
    Text(TextField),
}

/// The relation between a subject and the values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum How {
    Is,
    Exactly,
    IsNot,
    /// It is not, or has no value.
    NotAtAll,
    /// It has any value.
    Has,
    Missing(Missing),
}

/// A row of the builder.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Condition {
    /// A subject with some of the values.
    Values(Subject, How, Vec<Pattern>),
    /// A text that contains one of the words.
    Words(TextField, Vec<Pattern>),
    /// A condition on a length or a moment.
    Time(TimeField, TimeTest),
    /// Similarity to an example: the weight of each component in the order of [`Component::ALL`], and the least
    /// similarity.
    Like(Example, [f64; 5], Option<f64>),
    /// A term that the builder cannot change.
    Written(Expr),
}

/// Returns the rows of a query.
pub(crate) fn rows(query: &Query) -> Vec<Condition> {
    match &query.root {
        Expr::And(terms) => terms.iter().map(condition).collect(),
        one => vec![condition(one)],
    }
}

/// Returns the query for tokens that meet all rows of one of the alternatives, as text.
pub(crate) fn either(alternatives: &[Vec<Condition>]) -> String {
    let each = alternatives.iter();
    let root = Expr::any(each.map(|rows| Expr::all(rows.iter().map(expr))));
    Query { root }.to_string()
}

/// Returns the query of rows, as text.
pub(crate) fn text(rows: &[Condition]) -> String {
    let root = Expr::all(rows.iter().map(expr));
    Query { root }.to_string()
}

/// Returns the row of a term.
pub(crate) fn condition(term: &Expr) -> Condition {
    let known = match term {
        Expr::Test(test) => of_test(&test.what, false),
        Expr::Not(inner) => match &**inner {
            Expr::Test(test) => of_test(&test.what, true),
            _ => None,
        },
        Expr::Like(like) => of_like(like),
        _ => None,
    };
    known.unwrap_or_else(|| Condition::Written(term.clone()))
}

fn of_test(what: &What, not: bool) -> Option<Condition> {
    Some(match (what, not) {
        (What::Component(field, comparison), not) => {
            of_comparison(Subject::Component(field.clone()), comparison, not)?
        }
        (What::Property(property, comparison), not) => {
            of_comparison(Subject::Property(*property), comparison, not)?
        }
        (What::Whole(field, comparison), not) => {
            of_comparison(Subject::Text(*field), comparison, not)?
        }
        (What::Words(field, words), false) => Condition::Words(*field, words.clone()),
        (What::Time(field, test), false) => Condition::Time(*field, *test),
        _ => return None,
    })
}

fn of_comparison(subject: Subject, comparison: &Comparison, not: bool) -> Option<Condition> {
    let how = match (comparison.operator, &comparison.values[..], not) {
        (Operator::Is, [only], false) => match &only.wanted {
            Wanted::Present => return Some(Condition::Values(subject, How::Has, Vec::new())),
            Wanted::Missing(missing) => {
                return Some(Condition::Values(
                    subject,
                    How::Missing(*missing),
                    Vec::new(),
                ));
            }
            _ => How::Is,
        },
        (Operator::Is, _, false) => How::Is,
        (Operator::Is, _, true) => How::NotAtAll,
        (Operator::Exactly, _, false) => How::Exactly,
        (Operator::IsNot, _, false) => How::IsNot,
        _ => return None,
    };
    let named = |value: &Value| match &value.wanted {
        Wanted::Named(pattern) => Some(pattern.clone()),
        _ => None,
    };
    let values: Option<Vec<Pattern>> = comparison.values.iter().map(named).collect();
    Some(Condition::Values(subject, how, values?))
}

fn of_like(like: &Like) -> Option<Condition> {
    let mut weights = [1.0; 5];
    if !like.on.is_empty() {
        weights = [0.0; 5];
        for one in &like.on {
            let place = Component::ALL
                .iter()
                .position(|it| *it == one.field.component)?;
            if one.field != Field::new(one.field.component) || weights[place] != 0.0 {
                return None;
            }
            weights[place] = one.weight;
        }
    }
    Some(Condition::Like(like.example.clone(), weights, like.above))
}

/// Returns the term of a row.
pub(crate) fn expr(row: &Condition) -> Expr {
    let test = |what| {
        Expr::Test(Test {
            at: Default::default(),
            subject_at: Default::default(),
            what,
        })
    };
    match row {
        Condition::Written(expr) => expr.clone(),
        Condition::Words(field, words) => test(What::Words(*field, words.clone())),
        Condition::Time(field, time) => test(What::Time(*field, *time)),
        Condition::Like(example, weights, above) => Expr::Like(Like {
            at: Default::default(),
            example_at: Default::default(),
            example: example.clone(),
            on: weighted(weights),
            above: *above,
        }),
        Condition::Values(subject, how, values) => {
            let comparison = comparison(*how, values);
            let term = test(match subject {
                Subject::Component(field) => What::Component(field.clone(), comparison),
                Subject::Property(property) => What::Property(*property, comparison),
                Subject::Text(field) => What::Whole(*field, comparison),
            });
            match how {
                How::NotAtAll => Expr::Not(Box::new(term)),
                _ => term,
            }
        }
    }
}

/// Returns the weights of the components; an empty list if all are 1, which means the same.
fn weighted(weights: &[f64; 5]) -> Vec<Weighted> {
    if weights.iter().all(|weight| *weight == 1.0) {
        return Vec::new();
    }
    let some = Component::ALL.into_iter().zip(weights);
    some.filter(|(_, weight)| **weight > 0.0)
        .map(|(component, weight)| Weighted {
            at: Default::default(),
            field: Field::new(component),
            weight: *weight,
        })
        .collect()
}

fn comparison(how: How, values: &[Pattern]) -> Comparison {
    let value = |wanted| Value {
        at: Default::default(),
        wanted,
    };
    let operator = match how {
        How::Exactly => Operator::Exactly,
        How::IsNot => Operator::IsNot,
        _ => Operator::Is,
    };
    let values = match how {
        How::Has => vec![value(Wanted::Present)],
        How::Missing(missing) => vec![value(Wanted::Missing(missing))],
        _ => values
            .iter()
            .map(|pattern| value(Wanted::Named(pattern.clone())))
            .collect(),
    };
    Comparison { operator, values }
}

/// Returns a pattern as text.
pub(crate) fn written(pattern: &Pattern) -> String {
    let segments = pattern.segments().iter();
    let escaped: Vec<String> = segments.map(|it| it.replace('*', "\\*")).collect();
    escaped.join("*")
}

/// Returns the text of a query with `value` of `field` as a further condition; `field` may be any that takes values.
pub(crate) fn with_value(query: &str, field: &str, value: &str) -> String {
    let quote = |value: &str| format!("\"{}\"", value.replace('\\', "\\\\").replace('"', "\\\""));
    let plain = value
        .chars()
        .all(|c| c.is_alphanumeric() || "-_./+".contains(c));
    let value = if plain {
        value.to_owned()
    } else {
        quote(value)
    };
    format!("{} {field}={value}", query.trim())
        .trim()
        .to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn round_trip(text: &str) -> String {
        let query: Query = text.parse().expect(text);
        self::text(&rows(&query))
    }

    #[test]
    fn the_rows_of_the_builder_give_the_query() {
        for text in [
            "",
            "right.configuration=U placement=chin",
            "gloss:BO* not weak.configuration=S",
            "movement=arc or movement=circle",
            "(movement=arc or movement=circle) placement!=chest",
            "placement==head placement=* movement=unset orientation.palm=n/a",
            "configuration=[index middle -thumb]",
            "duration<0.8s start>=120s duration=0.5s..1s",
            "origin=captured,made signer=\"A B\"",
            "like token:41 on configuration:2, placement",
            "like CHAT",
            "like CHAT on placement above 0.6",
            "gloss=CHAT overlaps nonmanual.brows=raised",
            "not (gloss=A gloss=B)",
            "gloss~ESCRGO~2 tier(\"Mouthing\")=ma*",
        ] {
            let query: Query = text.parse().expect(text);
            let again: Query = round_trip(text).parse().expect(text);
            assert_eq!(query, again, "{text}");
        }
    }

    #[test]
    fn rows_show_which_parts_are_editable() {
        let of = |text: &str| rows(&text.parse().expect(text));
        let [Condition::Values(Subject::Component(field), How::IsNot, values)] =
            &of("right.placement!=chin,\"neutral space\"")[..]
        else {
            panic!("it is one row");
        };
        assert_eq!(field.to_string(), "right.placement");
        let values: Vec<String> = values.iter().map(written).collect();
        assert_eq!(values, ["chin", "neutral space"]);
        assert!(matches!(
            of("movement=unset")[..],
            [Condition::Values(_, How::Missing(Missing::Unset), _)]
        ));
        assert!(matches!(
            of("not gloss=A")[..],
            [Condition::Values(_, How::NotAtAll, _)]
        ));
        assert!(matches!(of("a or b")[..], [Condition::Written(_)]));
        let [Condition::Like(_, weights, _)] = of("like token:1 on placement:3")[..] else {
            panic!("it is by example");
        };
        assert_eq!(weights, [0.0, 3.0, 0.0, 0.0, 0.0]);
        assert!(matches!(
            of("like token:1 on right.placement")[..],
            [Condition::Written(_)]
        ));
    }

    #[test]
    fn the_minimum_similarity_is_part_of_a_row() {
        let all = rows(&"like CHAT above 60%".parse().expect("a query"));
        let [Condition::Like(_, _, Some(above))] = all[..] else {
            panic!("it is by example");
        };
        assert!((above - 0.6).abs() < 1e-9);
        assert_eq!(text(&all), "like sign:CHAT above 0.6");
    }

    #[test]
    fn values_are_added_to_the_query() {
        assert_eq!(with_value("", "placement", "chin"), "placement=chin");
        assert_eq!(
            with_value("gloss:BO* ", "right.placement", "neutral space"),
            "gloss:BO* right.placement=\"neutral space\""
        );
        for value in ["a\"b", "X(1)", "a,b", "*", "n/a", "", "[x]", "é"] {
            let text = with_value("", "signer", value);
            assert!(text.parse::<Query>().is_ok() || value.is_empty(), "{text}");
        }
    }

    fn term() -> impl Strategy<Value = String> {
        let field = prop::sample::select(vec![
            "configuration",
            "right.placement",
            "final.weak.movement",
            "orientation.palm",
            "nonmanual.brows",
            "signer",
            "gloss",
        ]);
        let operator = prop::sample::select(vec!["=", "==", "!="]);
        let value = prop_oneof![
            "[A-Za-z][A-Za-z0-9-]{0,6}",
            "\"[a-z(][a-z ,)=]{0,5}[a-z]\"",
            Just("BO*".to_owned()),
            Just("*".to_owned()),
            Just("unset".to_owned()),
        ];
        let not = prop::sample::select(vec!["", "not "]);
        (not, field, operator, prop::collection::vec(value, 1..3)).prop_map(
            |(not, field, operator, values)| format!("{not}{field}{operator}{}", values.join(",")),
        )
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn text_and_rows_always_agree(terms in prop::collection::vec(term(), 0..5), any in any::<bool>()) {
            let text = terms.join(if any { " or " } else { " " });
            if let Ok(query) = text.parse::<Query>() {
                let again = self::text(&rows(&query));
                prop_assert_eq!(again.parse::<Query>().expect("a query"), query, "{}", again);
                // Reading and writing does not change a row.
                for row in rows(&text.parse().expect("a query")) {
                    prop_assert_eq!(condition(&expr(&row)), row);
                }
            }
        }
    }
}
