//! The query as rows of conditions: every term of its conjunction is a row.
//!
//! A [`QueryCondition`] can be shown and changed in the builder; any other term stays as it is written.

use chereme_sign::query::{
    ComparisonOperator, ExampleToken, LikeSearch, MissingReason, QueryExpression, QueryTest, QueryValue, TestSubject,
    TextField, TextPattern, TimeField, TimeTest, TokenQuery, ValueComparison, WantedValue, WeightedComponent,
    WholeTokenProperty,
};
use chereme_sign::{ComponentField, SignComponent};

/// The subject of a condition.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ConditionSubject {
    Component(ComponentField),
    Property(WholeTokenProperty),
    /// A whole text.
    Text(TextField),
}

/// The relation between a subject and the values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ConditionRelation {
    Is,
    Exactly,
    IsNot,
    /// It is not, or has no value.
    NotAtAll,
    /// It has any value.
    Has,
    Missing(MissingReason),
}

/// A row of the builder.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum QueryCondition {
    /// A subject with some of the values.
    Values(ConditionSubject, ConditionRelation, Vec<TextPattern>),
    /// A text that contains one of the words.
    Words(TextField, Vec<TextPattern>),
    /// A condition on a length or a moment.
    Time(TimeField, TimeTest),
    /// Similarity to an example: the weight of each component in the order of [`Component::ALL_COMPONENTS`], and the least
    /// similarity.
    Like(ExampleToken, [f64; 5], Option<f64>),
    /// A condition on a component, and those on who says this very value.
    Said(Box<QueryCondition>, Vec<QueryCondition>),
    /// A term that the builder cannot change, but for the least number that it wants.
    Written(QueryExpression),
}

/// Returns the rows of a query.
pub(crate) fn rows_from_query(query: &TokenQuery) -> Vec<QueryCondition> {
    match &query.root {
        QueryExpression::And(terms) => terms.iter().map(condition_from_term).collect(),
        one => vec![condition_from_term(one)],
    }
}

/// Returns the query for tokens that meet all rows of one of the alternatives, as text.
pub(crate) fn query_text_from_alternatives(alternatives: &[Vec<QueryCondition>]) -> String {
    let each = alternatives.iter();
    let root = QueryExpression::any_of_terms(
        each.map(|rows| QueryExpression::all_of_terms(rows.iter().map(term_from_condition))),
    );
    TokenQuery { root }.to_string()
}

/// Returns the query of rows, as text.
pub(crate) fn query_text_from_rows(rows: &[QueryCondition]) -> String {
    let root = QueryExpression::all_of_terms(rows.iter().map(term_from_condition));
    TokenQuery { root }.to_string()
}

/// Returns the row of a term.
pub(crate) fn condition_from_term(term: &QueryExpression) -> QueryCondition {
    let simple_condition = match term {
        QueryExpression::Test(test) => of_test(&test.what, false),
        QueryExpression::Not(inner) => match &**inner {
            QueryExpression::Test(test) => of_test(&test.what, true),
            _ => None,
        },
        QueryExpression::Like(like) => of_like(like),
        _ => None,
    };
    simple_condition.unwrap_or_else(|| QueryCondition::Written(term.clone()))
}

fn of_test(what: &TestSubject, not: bool) -> Option<QueryCondition> {
    Some(match (what, not) {
        (TestSubject::Component(field, comparison), not) => {
            of_comparison(ConditionSubject::Component(field.clone()), comparison, not)?
        }
        (TestSubject::Property(property, comparison), not) => {
            of_comparison(ConditionSubject::Property(*property), comparison, not)?
        }
        (TestSubject::Whole(field, comparison), not) => of_comparison(ConditionSubject::Text(*field), comparison, not)?,
        (TestSubject::Said(field, comparison, sources), not) => {
            let value = of_comparison(ConditionSubject::Component(field.clone()), comparison, not)?;
            let sources = sources
                .iter()
                .map(|test| condition_from_term(&QueryExpression::Test(test.clone())));
            QueryCondition::Said(Box::new(value), sources.collect())
        }
        (TestSubject::Words(field, words), false) => QueryCondition::Words(*field, words.clone()),
        (TestSubject::Time(field, test), false) => QueryCondition::Time(*field, *test),
        _ => return None,
    })
}

fn of_comparison(subject: ConditionSubject, comparison: &ValueComparison, not: bool) -> Option<QueryCondition> {
    let how = match (comparison.operator, &comparison.values[..], not) {
        (ComparisonOperator::Is, [only], false) => match &only.wanted {
            WantedValue::Present => {
                return Some(QueryCondition::Values(subject, ConditionRelation::Has, Vec::new()));
            }
            WantedValue::Missing(missing) => {
                return Some(QueryCondition::Values(
                    subject,
                    ConditionRelation::Missing(*missing),
                    Vec::new(),
                ));
            }
            _ => ConditionRelation::Is,
        },
        (ComparisonOperator::Is, _, false) => ConditionRelation::Is,
        (ComparisonOperator::Is, _, true) => ConditionRelation::NotAtAll,
        (ComparisonOperator::Exactly, _, false) => ConditionRelation::Exactly,
        (ComparisonOperator::IsNot, _, false) => ConditionRelation::IsNot,
        _ => return None,
    };
    let named = |value: &QueryValue| match &value.wanted {
        WantedValue::Named(pattern) => Some(pattern.clone()),
        _ => None,
    };
    let values: Option<Vec<TextPattern>> = comparison.values.iter().map(named).collect();
    Some(QueryCondition::Values(subject, how, values?))
}

fn of_like(like: &LikeSearch) -> Option<QueryCondition> {
    let mut weights = [1.0; 5];
    if !like.on.is_empty() {
        weights = [0.0; 5];
        for one in &like.on {
            let place = SignComponent::ALL_COMPONENTS
                .iter()
                .position(|component| *component == one.field.component)?;
            if one.field != ComponentField::new(one.field.component) || weights[place] != 0.0 {
                return None;
            }
            weights[place] = one.weight;
        }
    }
    Some(QueryCondition::Like(like.example.clone(), weights, like.above))
}

/// Returns the term of a row.
pub(crate) fn term_from_condition(row: &QueryCondition) -> QueryExpression {
    let test = |what| {
        QueryExpression::Test(QueryTest {
            at: Default::default(),
            subject_at: Default::default(),
            what,
        })
    };
    match row {
        QueryCondition::Written(expr) => expr.clone(),
        QueryCondition::Said(value, sources) => {
            let tests = sources.iter().filter_map(|source| match term_from_condition(source) {
                QueryExpression::Test(test) => Some(test),
                _ => None,
            });
            said_term(term_from_condition(value), tests.collect())
        }
        QueryCondition::Words(field, words) => test(TestSubject::Words(*field, words.clone())),
        QueryCondition::Time(field, time) => test(TestSubject::Time(*field, *time)),
        QueryCondition::Like(example, weights, above) => QueryExpression::Like(LikeSearch {
            at: Default::default(),
            example_at: Default::default(),
            example: example.clone(),
            on: weighted(weights),
            above: *above,
        }),
        QueryCondition::Values(subject, how, values) => {
            let comparison = build_pattern_comparison(*how, values);
            let term = test(match subject {
                ConditionSubject::Component(field) => TestSubject::Component(field.clone(), comparison),
                ConditionSubject::Property(property) => TestSubject::Property(*property, comparison),
                ConditionSubject::Text(field) => TestSubject::Whole(*field, comparison),
            });
            match how {
                ConditionRelation::NotAtAll => QueryExpression::Not(Box::new(term)),
                _ => term,
            }
        }
    }
}

/// Returns the term of a component with the conditions on who says the value. A missing value has no author, and gets no conditions.
fn said_term(value: QueryExpression, sources: Vec<QueryTest>) -> QueryExpression {
    let is_missing = |value: &QueryValue| matches!(value.wanted, WantedValue::Missing(_));
    match value {
        QueryExpression::Not(inner) => QueryExpression::Not(Box::new(said_term(*inner, sources))),
        QueryExpression::Test(QueryTest {
            at,
            subject_at,
            what: TestSubject::Component(field, comparison),
        }) if !sources.is_empty() && !comparison.values.iter().any(is_missing) => QueryExpression::Test(QueryTest {
            at,
            subject_at,
            what: TestSubject::Said(field, comparison, sources),
        }),
        plain => plain,
    }
}

/// Returns the weights of the components; an empty list if all are 1, which means the same.
fn weighted(weights: &[f64; 5]) -> Vec<WeightedComponent> {
    if weights.iter().all(|weight| *weight == 1.0) {
        return Vec::new();
    }
    let some = SignComponent::ALL_COMPONENTS.into_iter().zip(weights);
    some.filter(|(_, weight)| **weight > 0.0)
        .map(|(component, weight)| WeightedComponent {
            at: Default::default(),
            field: ComponentField::new(component),
            weight: *weight,
        })
        .collect()
}

fn build_pattern_comparison(how: ConditionRelation, values: &[TextPattern]) -> ValueComparison {
    let value = |wanted| QueryValue {
        at: Default::default(),
        wanted,
    };
    let operator = match how {
        ConditionRelation::Exactly => ComparisonOperator::Exactly,
        ConditionRelation::IsNot => ComparisonOperator::IsNot,
        _ => ComparisonOperator::Is,
    };
    let values = match how {
        ConditionRelation::Has => vec![value(WantedValue::Present)],
        ConditionRelation::Missing(missing) => vec![value(WantedValue::Missing(missing))],
        _ => values
            .iter()
            .map(|pattern| value(WantedValue::Named(pattern.clone())))
            .collect(),
    };
    ValueComparison { operator, values }
}

/// Returns a pattern as text.
pub(crate) fn format_query_pattern(pattern: &TextPattern) -> String {
    let segments = pattern.pattern_segments().iter();
    let escaped: Vec<String> = segments.map(|segment| segment.replace('*', "\\*")).collect();
    escaped.join("*")
}

/// Returns the text of a query with `value` of `field` as a further condition; `field` may be any that takes values.
pub(crate) fn with_value(query: &str, field: &str, value: &str) -> String {
    let quote = |value: &str| format!("\"{}\"", value.replace('\\', "\\\\").replace('"', "\\\""));
    let plain = value.chars().all(|c| c.is_alphanumeric() || "-_./+".contains(c));
    let value = if plain { value.to_owned() } else { quote(value) };
    format!("{} {field}={value}", query.trim()).trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn round_trip(text: &str) -> String {
        let query: TokenQuery = text.parse().expect(text);
        self::query_text_from_rows(&rows_from_query(&query))
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
            "configuration=U{by=anna}",
            "not right.configuration=U,V{by=anna,ben proposed:yes confidence>=0.8} gloss=A",
        ] {
            let query: TokenQuery = text.parse().expect(text);
            let again: TokenQuery = round_trip(text).parse().expect(text);
            assert_eq!(query, again, "{text}");
        }
    }

    #[test]
    fn rows_show_which_parts_are_editable() {
        let of = |text: &str| rows_from_query(&text.parse().expect(text));
        let [QueryCondition::Values(ConditionSubject::Component(field), ConditionRelation::IsNot, values)] =
            &of("right.placement!=chin,\"neutral space\"")[..]
        else {
            panic!("it is one row");
        };
        assert_eq!(field.to_string(), "right.placement");
        let values: Vec<String> = values.iter().map(format_query_pattern).collect();
        assert_eq!(values, ["chin", "neutral space"]);
        assert!(matches!(
            of("movement=unset")[..],
            [QueryCondition::Values(
                _,
                ConditionRelation::Missing(MissingReason::Unset),
                _
            )]
        ));
        assert!(matches!(
            of("not gloss=A")[..],
            [QueryCondition::Values(_, ConditionRelation::NotAtAll, _)]
        ));
        assert!(matches!(of("a or b")[..], [QueryCondition::Written(_)]));
        let [QueryCondition::Said(value, sources)] = &of("configuration=U{by=anna confidence>0.8}")[..] else {
            panic!("it has sources");
        };
        assert_eq!(query_text_from_rows(&[(**value).clone()]), "configuration=U");
        assert!(matches!(
            sources[..],
            [
                QueryCondition::Values(
                    ConditionSubject::Property(WholeTokenProperty::By),
                    ConditionRelation::Is,
                    _
                ),
                QueryCondition::Written(_)
            ]
        ));
        let none = QueryCondition::Said(value.clone(), Vec::new());
        assert_eq!(query_text_from_rows(&[none]), "configuration=U");
        let unset = QueryCondition::Said(Box::new(of("configuration=unset").remove(0)), sources.clone());
        assert_eq!(query_text_from_rows(&[unset]), "configuration=unset");
        let [QueryCondition::Like(_, weights, _)] = of("like token:1 on placement:3")[..] else {
            panic!("it is by example");
        };
        assert_eq!(weights, [0.0, 3.0, 0.0, 0.0, 0.0]);
        assert!(matches!(
            of("like token:1 on right.placement")[..],
            [QueryCondition::Written(_)]
        ));
    }

    #[test]
    fn the_minimum_similarity_is_part_of_a_row() {
        let all = rows_from_query(&"like CHAT above 60%".parse().expect("a query"));
        let [QueryCondition::Like(_, _, Some(above))] = all[..] else {
            panic!("it is by example");
        };
        assert!((above - 0.6).abs() < 1e-9);
        assert_eq!(query_text_from_rows(&all), "like sign:CHAT above 0.6");
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
            assert!(text.parse::<TokenQuery>().is_ok() || value.is_empty(), "{text}");
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
        (not, field, operator, prop::collection::vec(value, 1..3))
            .prop_map(|(not, field, operator, values)| format!("{not}{field}{operator}{}", values.join(",")))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn text_and_rows_always_agree(terms in prop::collection::vec(term(), 0..5), any in any::<bool>()) {
            let text = terms.join(if any { " or " } else { " " });
            if let Ok(query) = text.parse::<TokenQuery>() {
                let again = self::query_text_from_rows(&rows_from_query(&query));
                prop_assert_eq!(again.parse::<TokenQuery>().expect("a query"), query, "{}", again);
                // Reading and writing does not change a row.
                for row in rows_from_query(&text.parse().expect("a query")) {
                    prop_assert_eq!(condition_from_term(&term_from_condition(&row)), row);
                }
            }
        }
    }
}
