//! Laws for any text and for any query.

use super::super::*;
use super::{CANONICAL, REWRITTEN, render_query_error};
use crate::component::{ComponentField, HandRef, SignComponent, SignPhase};
use crate::relation::TimeRelation;
use proptest::prelude::*;

/// Checks the laws for any text.
fn check_any(text: &str) {
    let count = text.chars().count();
    match TokenQuery::parse_query(text) {
        Ok(query) => assert_eq!(TokenQuery::parse_query(&query.to_string()), Ok(query), "{text:?}"),
        Err(error) => {
            assert!(
                error.at.start <= error.at.end && error.at.end <= count,
                "{text:?} {error:?}"
            );
            assert!(!error.message.is_empty() && !render_query_error(&error, text).is_empty());
            assert!(error.corrected_query(text).is_some() == error.suggestion.is_some());
        }
    }
    for cursor in (0..=count + 1).step_by(1 + count / 3) {
        let found = complete_query(text, cursor);
        assert!(
            found.replace.start <= found.replace.end && found.replace.end <= count,
            "{text:?}"
        );
    }
}

#[test]
fn no_sequence_of_words_panics() {
    const SOUP: &[&str] = &[
        " ",
        " ",
        " ",
        "gloss",
        "placement",
        "right",
        "left",
        ".",
        "=",
        "==",
        "!=",
        ":",
        "~",
        "<",
        ">=",
        "(",
        ")",
        "[",
        "]",
        ",",
        "*",
        "-",
        "\"",
        "“",
        "»",
        "«",
        "\\",
        "not",
        "or",
        "and",
        "like",
        "token:4",
        "on",
        "in",
        "within",
        "0.5",
        "s",
        "ms",
        "..",
        "overlaps",
        "before",
        "ovrlaps",
        "around",
        "of",
        "of-end",
        "tier",
        "origin",
        "made",
        "hand",
        "duration",
        "é",
        "e\u{301}",
        "手",
        "CHAT",
        "A1",
        "unset",
        "n/a",
        "~2",
        "\n",
        "nonmanual",
        "brows",
        "final",
        ">",
        "/",
        "/^a/",
        "@",
        "@x",
        "above",
        "ou",
        "chevauche",
        "comme",
    ];
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut random = |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state % below as u64) as usize
    };
    let whole: Vec<&str> = CANONICAL
        .iter()
        .chain(REWRITTEN.iter().map(|(text, _)| text))
        .copied()
        .collect();
    for round in 0..3000 {
        let mut text: String = (0..random(14)).map(|_| SOUP[random(SOUP.len())]).collect();
        if round % 2 == 0 {
            let chars: Vec<char> = whole[random(whole.len())].chars().collect();
            let at = random(chars.len() + 1);
            let skip = random(3).min(chars.len() - at);
            let middle = SOUP[random(SOUP.len())];
            text = chars[..at]
                .iter()
                .copied()
                .chain(middle.chars())
                .chain(chars[at + skip..].iter().copied())
                .collect();
        }
        check_any(&text);
    }
}

fn name() -> impl Strategy<Value = String> {
    prop_oneof![
        "[A-Za-z0-9][A-Za-z0-9é:()' -]{0,7}",
        "[a-z][ -~«»“”’手]{0,6}",
        prop::sample::select(vec![
            "unset", "n/a", "or", "NOT", "on", "in", "before", "tier", "like", "overlap", "et", "dans", "@a", "above",
            "comme", "a>b", "/x/"
        ])
        .prop_map(str::to_owned),
    ]
}

fn pattern() -> impl Strategy<Value = TextPattern> {
    prop_oneof![
        name().prop_map(TextPattern::literal_pattern),
        (name(), name()).prop_map(|(a, b)| TextPattern::from_glob(&format!("{a}*{b}"))),
        name().prop_map(|a| TextPattern::from_glob(&format!("{a}*"))),
        "[a-zé /\\\\]{0,3}[a-z^/$]{1,4}".prop_filter_map("an expression", |source| {
            let expression = RegularExpression::new(&source).ok();
            // A slash that is escaped already is the same as one that is not.
            let plain = !source.contains("\\/") && !source.trim().is_empty();
            expression.filter(|_| plain).map(TextPattern::of_expression)
        }),
    ]
}

fn field() -> impl Strategy<Value = ComponentField> {
    (
        prop::option::of(prop::sample::select(HandRef::ALL_HAND_REFS.to_vec())),
        prop::sample::select(SignComponent::ALL_COMPONENTS.to_vec()),
        prop::option::of("[a-z][a-z0-9_-]{0,4}"),
        prop::option::of(prop::sample::select(vec![
            SignPhase::Initial,
            SignPhase::Middle(2),
            SignPhase::Final,
        ])),
    )
        .prop_map(|(hand, component, feature, phase)| ComponentField {
            hand: hand.filter(|_| component.is_manual()),
            component,
            feature,
            phase,
        })
}

fn comparison(features: bool) -> impl Strategy<Value = ValueComparison> {
    let feature = ("[a-z_]{2,4}[a-z:-]{0,3}", any::<bool>())
        .prop_filter("a word of its own", |(name, _)| name != "not")
        .prop_map(|(name, absent)| ValueFeature {
            at: QueryPlace::default(),
            name,
            absent,
        });
    let named = pattern().prop_map(WantedValue::Named);
    let wanted = prop_oneof![
        Just(WantedValue::Present),
        prop::sample::select(MissingReason::ALL_MISSING_REASONS.to_vec()).prop_map(WantedValue::Missing),
        prop::collection::vec(feature, 1..3).prop_map(WantedValue::Features),
        named,
    ]
    .prop_filter("a component", move |wanted| {
        features || !matches!(wanted, WantedValue::Features(_))
    });
    let value = wanted.prop_map(value_of);
    let operator = prop::sample::select(vec![
        ComparisonOperator::Is,
        ComparisonOperator::Exactly,
        ComparisonOperator::IsNot,
    ]);
    (operator, prop::collection::vec(value, 1..3)).prop_map(|(operator, values)| ValueComparison { operator, values })
}

fn value_of(wanted: WantedValue) -> QueryValue {
    QueryValue {
        at: QueryPlace::default(),
        wanted,
    }
}

/// A component with a sequence of values.
fn path() -> impl Strategy<Value = TestSubject> {
    let step = prop_oneof![Just(WantedValue::Present), pattern().prop_map(WantedValue::Named)];
    let steps = prop::collection::vec(step.prop_map(value_of), 2..4);
    let operator = prop::sample::select(vec![ComparisonOperator::Is, ComparisonOperator::Exactly]);
    (field(), operator, steps).prop_map(|(field, operator, steps)| {
        let values = vec![value_of(WantedValue::Steps(steps))];
        TestSubject::Component(field, ValueComparison { operator, values })
    })
}

/// A test whose subject is an annotation.
fn annotation() -> impl Strategy<Value = QueryTest> {
    let text = || prop::sample::select(TextField::ALL_TEXT_FIELDS.to_vec());
    prop_oneof![
        (field(), comparison(true)).prop_map(|(field, comparison)| TestSubject::Component(field, comparison)),
        (text(), comparison(false)).prop_map(|(field, comparison)| TestSubject::Whole(field, comparison)),
        (pattern(), comparison(true)).prop_map(|(name, comparison)| TestSubject::Tier(name, comparison)),
        (text(), name(), 1..3u8).prop_map(|(field, text, slips)| TestSubject::Fuzzy { field, text, slips }),
        (
            prop::sample::select(TextField::ALL_TEXT_FIELDS[1..].to_vec()),
            prop::collection::vec(
                pattern().prop_filter("words", |word| word.regular_expression().is_none()),
                1..3
            )
        )
            .prop_map(|(field, words)| TestSubject::Words(field, words)),
    ]
    .prop_map(|what| QueryTest {
        at: QueryPlace::default(),
        subject_at: QueryPlace::default(),
        what,
    })
}

fn leaf() -> impl Strategy<Value = QueryExpression> {
    let micros = || prop_oneof![0..5_000_000_i64, 0..9_000_000_000_000_i64];
    let time = prop_oneof![
        micros().prop_map(TimeTest::Below),
        micros().prop_map(TimeTest::AtMost),
        micros().prop_map(TimeTest::Above),
        micros().prop_map(TimeTest::AtLeast),
        (micros(), micros()).prop_map(|(a, b)| TimeTest::Between(a.min(b), a.max(b))),
    ];
    let open = WholeTokenProperty::ALL_TOKEN_PROPERTIES
        .into_iter()
        .filter(|property| property.fixed_values().is_none());
    let what = prop_oneof![
        (prop::sample::select(TimeField::ALL_TIME_FIELDS.to_vec()), time)
            .prop_map(|(field, test)| TestSubject::Time(field, test)),
        (prop::sample::select(open.collect::<Vec<_>>()), comparison(false))
            .prop_map(|(property, comparison)| TestSubject::Property(property, comparison)),
        pattern()
            .prop_filter("words", |word| word.regular_expression().is_none())
            .prop_map(|word| TestSubject::Words(TextField::Any, vec![word])),
        path(),
    ];
    let test = what.prop_map(|what| QueryTest {
        at: QueryPlace::default(),
        subject_at: QueryPlace::default(),
        what,
    });
    let plain: Vec<TimeRelation> = TimeRelation::PLAIN_RELATIONS
        .into_iter()
        .map(|(_, relation)| relation)
        .collect();
    let relation = prop_oneof![
        prop::sample::select(plain),
        micros().prop_map(TimeRelation::Around),
        micros().prop_map(TimeRelation::OfBegin),
        micros().prop_map(TimeRelation::OfEnd),
    ];
    let weighted =
        (field(), prop::sample::select(vec![1.0, 2.0, 0.5, 0.1 + 0.2, 1000.0])).prop_map(|(field, weight)| {
            WeightedComponent {
                at: QueryPlace::default(),
                field,
                weight,
            }
        });
    let example = prop_oneof![
        name().prop_map(ExampleToken::Token),
        name().prop_map(ExampleToken::Sign)
    ];
    prop_oneof![
        annotation().prop_map(QueryExpression::Test),
        test.prop_map(QueryExpression::Test),
        (relation, annotation()).prop_map(|(relation, other)| QueryExpression::Relation(RelatedAnnotation {
            at: QueryPlace::default(),
            relation,
            other
        })),
        (
            example,
            prop::collection::vec(weighted, 0..3),
            prop::option::of(prop::sample::select(vec![0.0, 0.25, 0.6, 0.1 + 0.2]))
        )
            .prop_map(|(example, on, above)| QueryExpression::Like(LikeSearch {
                at: QueryPlace::default(),
                example_at: QueryPlace::default(),
                example,
                on,
                above,
            })),
        name().prop_map(|name| QueryExpression::Saved(NamedSearch {
            at: QueryPlace::default(),
            name
        })),
    ]
}

fn expr() -> impl Strategy<Value = QueryExpression> {
    leaf().prop_recursive(4, 16, 3, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 1..4).prop_map(QueryExpression::all_of_terms),
            prop::collection::vec(inner.clone(), 1..4).prop_map(QueryExpression::any_of_terms),
            inner.prop_map(|inner| QueryExpression::Not(Box::new(inner))),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn parsing_what_was_printed_gives_the_query_back(root in expr()) {
        let query = TokenQuery { root };
        let printed = query.to_string();
        prop_assert_eq!(TokenQuery::parse_query(&printed), Ok(query), "{}", printed);
    }

    #[test]
    fn any_text_is_a_query_or_an_error(text in "\\PC{0,40}") {
        check_any(&text);
    }
}
