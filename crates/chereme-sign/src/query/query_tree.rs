//! The syntax tree of a query.

use super::{AttributeTest, NamedSearch, NotationPattern, TextPattern};
use crate::component::{ComponentField, ComponentReading};
use crate::relation::TimeRelation;
use std::ops::{Bound, Range};

/// A place in the text of a query, in characters (not bytes), half-open.
///
/// All places are equal, so that two trees are equal if they mean the same, whatever their spacing. Compare
/// [`range`](Self::char_range)s to compare places.
#[derive(Debug, Clone, Copy, Default)]
pub struct QueryPlace {
    /// The first character.
    pub start: usize,
    /// The character after the last.
    pub end: usize,
}

impl QueryPlace {
    /// Returns the place as a range.
    #[must_use]
    pub fn char_range(self) -> Range<usize> {
        self.start..self.end
    }

    /// Returns the place from the start of this one to the end of `other`.
    #[must_use]
    pub fn extend_place_to(self, other: Self) -> Self {
        Self {
            start: self.start,
            end: other.end,
        }
    }
}

impl From<Range<usize>> for QueryPlace {
    fn from(range: Range<usize>) -> Self {
        Self {
            start: range.start,
            end: range.end,
        }
    }
}

impl PartialEq for QueryPlace {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for QueryPlace {}

/// A query: a condition on the tokens of a corpus.
///
/// Printing gives canonical text, and parsing that text gives an equal query.
#[derive(Debug, Clone, PartialEq)]
pub struct TokenQuery {
    /// The condition on the tokens; an empty [`QueryExpression::And`] accepts all.
    pub root: QueryExpression,
}

impl TokenQuery {
    /// Returns every comparison of the query in written order, including those on the right of relations.
    #[must_use]
    pub fn query_tests(&self) -> Vec<&QueryTest> {
        let mut all_tests = Vec::new();
        self.root.collect_tests(&mut all_tests);
        all_tests
    }

    /// Returns whether the query asks for opinions, which do not count otherwise: it says `proposed:yes`, `disputed:yes`, or
    /// something of [`By`](WholeTokenProperty::By) or of confidence. Its comparisons then read them beside the values that
    /// count.
    #[must_use]
    pub fn asks_for_opinions(&self) -> bool {
        let says_no =
            |value: &QueryValue| matches!(&value.wanted, WantedValue::Named(name) if name.as_literal() == Some("no"));
        self.query_tests().into_iter().any(|test| match &test.what {
            TestSubject::Property(WholeTokenProperty::By, _) => true,
            TestSubject::Property(WholeTokenProperty::Proposed | WholeTokenProperty::Disputed, comparison) => {
                !comparison.values.iter().all(says_no)
            }
            TestSubject::Attribute(name, _) => name == CONFIDENCE_NAME,
            _ => false,
        })
    }
}

impl QueryTest {
    /// Returns whether the test asks who says something, or how surely.
    #[must_use]
    pub fn asks_for_source(&self) -> bool {
        use WholeTokenProperty::{By, Disputed, Proposed};
        match &self.what {
            TestSubject::Property(By | Proposed | Disputed, _) => true,
            TestSubject::Attribute(name, test) => name == CONFIDENCE_NAME && matches!(test, AttributeTest::Number(..)),
            _ => false,
        }
    }
}

/// The name of the confidence of values in conditions such as `confidence>0.8`.
pub const CONFIDENCE_NAME: &str = "confidence";

/// A condition that holds for a token or does not.
#[derive(Debug, Clone, PartialEq)]
pub enum QueryExpression {
    /// All of them hold; an empty list holds for every token. Never contains another `And` directly.
    And(Vec<QueryExpression>),
    /// At least one holds. Has two or more, and never contains another `Or` directly.
    Or(Vec<QueryExpression>),
    /// It does not hold.
    Not(Box<QueryExpression>),
    /// A comparison of one thing known about the token.
    Test(QueryTest),
    /// The token stands in a relation of time to another annotation of its recording.
    Relation(RelatedAnnotation),
    /// The token resembles another.
    Like(LikeSearch),
    /// The token is among the results of a saved search.
    Saved(NamedSearch),
}

impl QueryExpression {
    /// Returns the conjunction of `terms`, flattened; a single term is returned itself.
    #[must_use]
    pub fn all_of_terms(terms: impl IntoIterator<Item = Self>) -> Self {
        let flat = |term| match term {
            Self::And(inner) => inner,
            other => vec![other],
        };
        take_only_term(terms.into_iter().flat_map(flat).collect()).unwrap_or_else(Self::And)
    }

    /// Returns the disjunction of `terms`, flattened; a single term is returned itself.
    #[must_use]
    pub fn any_of_terms(terms: impl IntoIterator<Item = Self>) -> Self {
        let flat = |term| match term {
            Self::Or(inner) => inner,
            other => vec![other],
        };
        take_only_term(terms.into_iter().flat_map(flat).collect()).unwrap_or_else(Self::Or)
    }

    /// Returns its place in the query; for a negation, the place of the negated part.
    #[must_use]
    pub fn expression_place(&self) -> QueryPlace {
        match self {
            Self::And(terms) | Self::Or(terms) => match (terms.first(), terms.last()) {
                (Some(first), Some(last)) => first.expression_place().extend_place_to(last.expression_place()),
                _ => QueryPlace::default(),
            },
            Self::Not(inner) => inner.expression_place(),
            Self::Test(test) => test.at,
            Self::Relation(related) => related.at,
            Self::Like(like) => like.at,
            Self::Saved(saved) => saved.at,
        }
    }
}

impl QueryExpression {
    fn collect_tests<'a>(&'a self, found: &mut Vec<&'a QueryTest>) {
        match self {
            Self::And(terms) | Self::Or(terms) => {
                terms.iter().for_each(|term| term.collect_tests(found));
            }
            Self::Not(inner) => inner.collect_tests(found),
            Self::Test(test) => found.push(test),
            Self::Relation(related) => found.push(&related.other),
            Self::Like(_) | Self::Saved(_) => {}
        }
    }
}

fn take_only_term(mut terms: Vec<QueryExpression>) -> Result<QueryExpression, Vec<QueryExpression>> {
    match terms.pop() {
        Some(term) if terms.is_empty() => Ok(term),
        Some(term) => {
            terms.push(term);
            Err(terms)
        }
        None => Err(terms),
    }
}

/// A comparison of one property of a token with wanted values.
#[derive(Debug, Clone, PartialEq)]
pub struct QueryTest {
    /// The place of the whole comparison.
    pub at: QueryPlace,
    /// The place of the subject's name.
    pub subject_at: QueryPlace,
    /// The subject of the comparison.
    pub what: TestSubject,
}

/// The subject of a test.
#[derive(Debug, Clone, PartialEq)]
pub enum TestSubject {
    /// A component of the token: `right.configuration=U`. If no hand or phase is named, it holds if the reading of any
    /// hand or phase passes, for `!=` too.
    Component(ComponentField, ValueComparison),
    /// A component with who says so: `configuration=U{by=anna confidence>0.8}`. It holds if one value passes the comparison,
    /// and the source, the standing and the confidence of this very value pass the tests of [`By`](WholeTokenProperty::By),
    /// [`Proposed`](WholeTokenProperty::Proposed), [`Disputed`](WholeTokenProperty::Disputed) and confidence.
    Said(ComponentField, ValueComparison, Vec<QueryTest>),
    /// A property of the token as a whole: `origin=made`.
    Property(WholeTokenProperty, ValueComparison),
    /// A whole text: `gloss=CHAT`.
    Whole(TextField, ValueComparison),
    /// Words in a text: `gloss:BO*`, `"slow animal"`; one matching pattern is enough. A pattern of several words is a
    /// phrase.
    Words(TextField, Vec<TextPattern>),
    /// A text up to some slips: `gloss~ESCARGO`, `gloss~ESCARG~2`.
    Fuzzy {
        /// The text searched.
        field: TextField,
        /// The text to resemble.
        text: String,
        /// The most characters that may be added, left out, changed or swapped: 1 or 2.
        slips: u8,
    },
    /// An annotation on the tiers with a matching name that shares time with the token: `tier("Mouthing")=ma*`.
    Tier(TextPattern, ValueComparison),
    /// A length or a moment: `duration<0.8s`.
    Time(TimeField, TimeTest),
    /// A number or a text about the sign from a table: `frequency>0.4`, `attribute.class=Noun`.
    Attribute(String, AttributeTest),
    /// A curve of the face or head: `nonmanual.brows>0.5 for 0.3s`.
    Curve(CurveTest),
    /// A sequence of symbols in its notation: `notation~"hamfinger2 … hamcirclei"`.
    Notation(NotationPattern),
}

/// A condition on a curve of the face or head during the token, or a part of it.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveTest {
    /// The part or number after `nonmanual.`, such as `brows`, `jaw_open` or `head_yaw`.
    pub name: String,
    /// The numbers that pass; always a [`Number`](AttributeTest::Number).
    pub test: AttributeTest,
    /// The least time for which they pass, in microseconds; 0 for one frame.
    pub lasting: i64,
}

/// An operator with the values on its right.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ValueComparison {
    /// The kind of comparison.
    pub operator: ComparisonOperator,
    /// The values; at least one.
    pub values: Vec<QueryValue>,
}

impl ValueComparison {
    /// Returns whether a reading passes; one reading never passes for [`Steps`](WantedValue::Steps).
    ///
    /// `fits` decides whether a value is the query's [`Named`](WantedValue::Named) one, or has its
    /// [`Features`](WantedValue::Features). It is called for these two only, and must read the operator to know whether
    /// narrower values count.
    #[must_use]
    pub fn comparison_accepts_reading(
        &self,
        reading: &ComponentReading,
        fits: impl Fn(&str, &WantedValue) -> bool,
    ) -> bool {
        let passes = |value: &QueryValue| match (&value.wanted, reading) {
            (WantedValue::Missing(missing), reading) => missing.missing_reading() == *reading,
            (WantedValue::Present, ComponentReading::Value(_)) => true,
            (WantedValue::Steps(_), _) => false,
            (wanted, ComponentReading::Value(value)) => fits(value, wanted),
            _ => false,
        };
        let one = self.values.iter().any(passes);
        let names = |value: &QueryValue| {
            let wanted = &value.wanted;
            matches!(
                wanted,
                WantedValue::Named(_) | WantedValue::Features(_) | WantedValue::Steps(_)
            )
        };
        match self.operator {
            ComparisonOperator::Is | ComparisonOperator::Exactly => one,
            ComparisonOperator::IsNot => !one && (reading.reading_value().is_some() || !self.values.iter().any(names)),
        }
    }
}

/// An operator that compares a field with values.
///
/// A value of an inventory may have narrower ones below it: `chin` lies on the `head`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ComparisonOperator {
    /// `=`: it is one of the values or narrower than one of them; text without case and accents.
    Is,
    /// `==`: it is one of the values, exactly; text with case and accents; features and no others.
    Exactly,
    /// `!=`: the reading differs from all these values. If one of them is a name or a list of features, the reading
    /// must also *be* a value, unlike `not placement=chest`, which accepts uncoded tokens too.
    IsNot,
}

/// One value on the right of an operator.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct QueryValue {
    /// Its place in the query.
    pub at: QueryPlace,
    /// The condition that it states.
    pub wanted: WantedValue,
}

/// The wanted value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum WantedValue {
    /// `*`: any value.
    Present,
    /// A missing value, for this reason: `unset`, `n/a` or `unclear`.
    Missing(MissingReason),
    /// A value of this name; never `*` alone.
    Named(TextPattern),
    /// `[index -thumb]`: a value with all these features.
    Features(Vec<ValueFeature>),
    /// `head > chest`: the sign begins with the first and moves on to the others in this order,
    /// with or without further values between them. Two or more, each a name, features or `*`.
    Steps(Vec<QueryValue>),
}

/// A feature that a value must or must not have.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ValueFeature {
    /// Its place in the query, with its minus.
    pub at: QueryPlace,
    /// Its name as written.
    pub name: String,
    /// Whether the value must lack it.
    pub absent: bool,
}

/// The reason why a field has no value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum MissingReason {
    /// `unset`: nobody has coded it yet.
    Unset,
    /// `n/a`: there is nothing to code.
    NotApplicable,
    /// `unclear`: somebody looked and could not decide.
    Unclear,
}

impl MissingReason {
    /// The three reasons.
    pub const ALL_MISSING_REASONS: [Self; 3] = [Self::Unset, Self::NotApplicable, Self::Unclear];

    /// Returns the spelling in a query.
    #[must_use]
    pub fn missing_reason_name(self) -> &'static str {
        match self {
            Self::Unset => "unset",
            Self::NotApplicable => "n/a",
            Self::Unclear => "unclear",
        }
    }

    /// Returns the reading that it stands for.
    #[must_use]
    pub fn missing_reading(self) -> ComponentReading {
        match self {
            Self::Unset => ComponentReading::Unset,
            Self::NotApplicable => ComponentReading::NotApplicable,
            Self::Unclear => ComponentReading::Unclear,
        }
    }
}

/// A text that belongs to a token.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum TextField {
    /// All the texts below; bare words and quoted text search them.
    Any,
    /// The gloss.
    Gloss,
    /// The meaning, in a spoken language.
    Translation,
    /// The annotators' remarks.
    Comment,
}

/// A property of a token as a whole.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum WholeTokenProperty {
    /// `captured`, `made`, `lexicon` or `generated`.
    Origin,
    /// The signer, by name or number.
    Signer,
    /// The recording, by name or number.
    Recording,
    /// The lexical entry, by its gloss or number.
    Sign,
    /// The token itself, by number.
    Token,
    /// The name of the tier that the token is on.
    Tier,
    /// The name of an inventory that has values of the token.
    Inventory,
    /// The lexicon to which its sign belongs, by name.
    Lexicon,
    /// The sign language of that lexicon, as a code of ISO 639-3.
    Language,
    /// The name of a file that it came from.
    File,
    /// The hand for which the token is annotated, else the hands for which something is coded: `right`, `left`,
    /// `dominant`, `weak` or `both`.
    Hand,
    /// Whether a detector proposes something for it that nobody has accepted: `yes` or `no`.
    Proposed,
    /// Whether annotators say different things of it, and nothing decides between them: `yes` or `no`.
    Disputed,
    /// Who says something of it: an annotator, or `detector`.
    By,
}

/// A length or a moment of a token.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum TimeField {
    /// Its length.
    Duration,
    /// Its start, from the start of the recording.
    Start,
    /// Its end, from the start of the recording.
    End,
}

/// A condition on a time, in microseconds, never negative.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TimeTest {
    /// `<`.
    Below(i64),
    /// `<=`.
    AtMost(i64),
    /// `>`.
    Above(i64),
    /// `>=`.
    AtLeast(i64),
    /// `=0.5s..1s`, ends included; the first is at most the second.
    Between(i64, i64),
}

impl TimeTest {
    /// Returns the least and the greatest time, in microseconds.
    #[must_use]
    pub fn time_bounds(self) -> (Bound<i64>, Bound<i64>) {
        match self {
            Self::Below(most) => (Bound::Unbounded, Bound::Excluded(most)),
            Self::AtMost(most) => (Bound::Unbounded, Bound::Included(most)),
            Self::Above(least) => (Bound::Excluded(least), Bound::Unbounded),
            Self::AtLeast(least) => (Bound::Included(least), Bound::Unbounded),
            Self::Between(least, most) => (Bound::Included(least), Bound::Included(most)),
        }
    }
}

/// A relation of time to another annotation of the same recording.
///
/// It holds if at least one annotation that passes the test has the relation; with `not` before it, if no annotation
/// does.
#[derive(Debug, Clone, PartialEq)]
pub struct RelatedAnnotation {
    /// The place of the relation and its right side.
    pub at: QueryPlace,
    /// The relation of the token's span to that of the other annotation.
    pub relation: TimeRelation,
    /// The other annotation: a component, a text or a tier.
    pub other: QueryTest,
}

/// A search by example.
#[derive(Debug, Clone, PartialEq)]
pub struct LikeSearch {
    /// Its place in the query.
    pub at: QueryPlace,
    /// The place of the example's address.
    pub example_at: QueryPlace,
    /// The token to resemble.
    pub example: ExampleToken,
    /// The components that count; if the list is empty, all count equally.
    pub on: Vec<WeightedComponent>,
    /// `above 0.6`: the similarity, from 0 to 1, that a token must exceed to be found.
    pub above: Option<f64>,
}

/// The token that others are to resemble.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum ExampleToken {
    /// `token:41`: this token.
    Token(String),
    /// `sign:LIMACE` or the bare gloss: the citation form of this sign.
    Sign(String),
}

/// A component that counts in a search by example.
#[derive(Debug, Clone, PartialEq)]
pub struct WeightedComponent {
    /// Its place in the query.
    pub at: QueryPlace,
    /// The component.
    pub field: ComponentField,
    /// Its weight among the terms: above 0, at most 1000; 1 by default.
    pub weight: f64,
}
