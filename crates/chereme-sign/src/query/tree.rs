//! The syntax tree of a query.

use super::{AttributeTest, Pattern, Saved};
use crate::component::{Field, Reading};
use crate::relation::Relation;
use std::ops::{Bound, Range, RangeBounds};

/// A place in the text of a query, in characters (not bytes), half-open.
///
/// All places are equal, so that two trees are equal if they mean the same, whatever their spacing. Compare
/// [`range`](Self::range)s to compare places.
#[derive(Debug, Clone, Copy, Default)]
pub struct At {
    /// The first character.
    pub start: usize,
    /// The character after the last.
    pub end: usize,
}

impl At {
    /// Returns the place as a range.
    #[must_use]
    pub fn range(self) -> Range<usize> {
        self.start..self.end
    }

    /// Returns the place from the start of this one to the end of `other`.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        Self {
            start: self.start,
            end: other.end,
        }
    }
}

impl From<Range<usize>> for At {
    fn from(range: Range<usize>) -> Self {
        Self {
            start: range.start,
            end: range.end,
        }
    }
}

impl PartialEq for At {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for At {}

/// A query: a condition on the tokens of a corpus.
///
/// Printing gives canonical text, and parsing that text gives an equal query.
#[derive(Debug, Clone, PartialEq)]
pub struct Query {
    /// The condition on the tokens; an empty [`Expr::And`] accepts all.
    pub root: Expr,
}

impl Query {
    /// Returns every comparison of the query in written order, including those on the right of relations.
    #[must_use]
    pub fn tests(&self) -> Vec<&Test> {
        let mut found = Vec::new();
        self.root.collect_tests(&mut found);
        found
    }
}

/// A condition that holds for a token or does not.
#[derive(Debug, Clone, PartialEq)]
pub enum Expr {
    /// All of them hold; an empty list holds for every token. Never contains another `And` directly.
    And(Vec<Expr>),
    /// At least one holds. Has two or more, and never contains another `Or` directly.
    Or(Vec<Expr>),
    /// It does not hold.
    Not(Box<Expr>),
    /// A comparison of one thing known about the token.
    Test(Test),
    /// The token stands in a relation of time to another annotation of its recording.
    Relation(Related),
    /// The token resembles another.
    Like(Like),
    /// The token is among the results of a saved search.
    Saved(Saved),
}

impl Expr {
    /// Returns the conjunction of `terms`, flattened; a single term is returned itself.
    #[must_use]
    pub fn all(terms: impl IntoIterator<Item = Self>) -> Self {
        let flat = |term| match term {
            Self::And(inner) => inner,
            other => vec![other],
        };
        only(terms.into_iter().flat_map(flat).collect()).unwrap_or_else(Self::And)
    }

    /// Returns the disjunction of `terms`, flattened; a single term is returned itself.
    #[must_use]
    pub fn any(terms: impl IntoIterator<Item = Self>) -> Self {
        let flat = |term| match term {
            Self::Or(inner) => inner,
            other => vec![other],
        };
        only(terms.into_iter().flat_map(flat).collect()).unwrap_or_else(Self::Or)
    }

    /// Returns its place in the query; for a negation, the place of the negated part.
    #[must_use]
    pub fn at(&self) -> At {
        match self {
            Self::And(terms) | Self::Or(terms) => match (terms.first(), terms.last()) {
                (Some(first), Some(last)) => first.at().to(last.at()),
                _ => At::default(),
            },
            Self::Not(inner) => inner.at(),
            Self::Test(test) => test.at,
            Self::Relation(related) => related.at,
            Self::Like(like) => like.at,
            Self::Saved(saved) => saved.at,
        }
    }
}

impl Expr {
    fn collect_tests<'a>(&'a self, found: &mut Vec<&'a Test>) {
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

fn only(mut terms: Vec<Expr>) -> Result<Expr, Vec<Expr>> {
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
pub struct Test {
    /// The place of the whole comparison.
    pub at: At,
    /// The place of the subject's name.
    pub subject_at: At,
    /// The subject of the comparison.
    pub what: What,
}

/// The subject of a test.
#[derive(Debug, Clone, PartialEq)]
pub enum What {
    /// A component of the token: `right.configuration=U`. If no hand or phase is named, it holds if the reading of any
    /// hand or phase passes, for `!=` too.
    Component(Field, Comparison),
    /// A property of the token as a whole: `origin=made`.
    Property(Property, Comparison),
    /// A whole text: `gloss=CHAT`.
    Whole(TextField, Comparison),
    /// Words in a text: `gloss:BO*`, `"slow animal"`; one matching pattern is enough. A pattern of several words is a
    /// phrase.
    Words(TextField, Vec<Pattern>),
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
    Tier(Pattern, Comparison),
    /// A length or a moment: `duration<0.8s`.
    Time(TimeField, TimeTest),
    /// A number or a text about the sign from a table: `frequency>0.4`, `attribute.class=Noun`.
    Attribute(String, AttributeTest),
    /// A curve of the face or head: `nonmanual.brows>0.5 for 0.3s`.
    Curve(CurveTest),
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
pub struct Comparison {
    /// The kind of comparison.
    pub operator: Operator,
    /// The values; at least one.
    pub values: Vec<Value>,
}

impl Comparison {
    /// Returns whether a reading passes; one reading never passes for [`Steps`](Wanted::Steps).
    ///
    /// `fits` decides whether a value is the query's [`Named`](Wanted::Named) one, or has its
    /// [`Features`](Wanted::Features). It is called for these two only, and must read the operator to know whether
    /// narrower values count.
    #[must_use]
    pub fn accepts(&self, reading: &Reading, fits: impl Fn(&str, &Wanted) -> bool) -> bool {
        let passes = |value: &Value| match (&value.wanted, reading) {
            (Wanted::Missing(missing), reading) => missing.reading() == *reading,
            (Wanted::Present, Reading::Value(_)) => true,
            (Wanted::Steps(_), _) => false,
            (wanted, Reading::Value(value)) => fits(value, wanted),
            _ => false,
        };
        let one = self.values.iter().any(passes);
        let names = |value: &Value| {
            let wanted = &value.wanted;
            matches!(
                wanted,
                Wanted::Named(_) | Wanted::Features(_) | Wanted::Steps(_)
            )
        };
        match self.operator {
            Operator::Is | Operator::Exactly => one,
            Operator::IsNot => {
                !one && (reading.value().is_some() || !self.values.iter().any(names))
            }
        }
    }
}

/// An operator that compares a field with values.
///
/// A value of an inventory may have narrower ones below it: `chin` lies on the `head`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Operator {
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
pub struct Value {
    /// Its place in the query.
    pub at: At,
    /// The condition that it states.
    pub wanted: Wanted,
}

/// The wanted value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Wanted {
    /// `*`: any value.
    Present,
    /// A missing value, for this reason: `unset`, `n/a` or `unclear`.
    Missing(Missing),
    /// A value of this name; never `*` alone.
    Named(Pattern),
    /// `[index -thumb]`: a value with all these features.
    Features(Vec<Feature>),
    /// `head > chest`: the sign begins with the first and moves on to the others in this order,
    /// with or without further values between them. Two or more, each a name, features or `*`.
    Steps(Vec<Value>),
}

/// A feature that a value must or must not have.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Feature {
    /// Its place in the query, with its minus.
    pub at: At,
    /// Its name as written.
    pub name: String,
    /// Whether the value must lack it.
    pub absent: bool,
}

/// The reason why a field has no value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Missing {
    /// `unset`: nobody has coded it yet.
    Unset,
    /// `n/a`: there is nothing to code.
    NotApplicable,
    /// `unclear`: somebody looked and could not decide.
    Unclear,
}

impl Missing {
    /// The three reasons.
    pub const ALL: [Self; 3] = [Self::Unset, Self::NotApplicable, Self::Unclear];

    /// Returns the spelling in a query.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Unset => "unset",
            Self::NotApplicable => "n/a",
            Self::Unclear => "unclear",
        }
    }

    /// Returns the reading that it stands for.
    #[must_use]
    pub fn reading(self) -> Reading {
        match self {
            Self::Unset => Reading::Unset,
            Self::NotApplicable => Reading::NotApplicable,
            Self::Unclear => Reading::Unclear,
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
pub enum Property {
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
    /// The hand for which the token is annotated, else the hands for which something is coded: `right`, `left`,
    /// `dominant`, `weak` or `both`.
    Hand,
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
    pub fn bounds(self) -> (Bound<i64>, Bound<i64>) {
        match self {
            Self::Below(most) => (Bound::Unbounded, Bound::Excluded(most)),
            Self::AtMost(most) => (Bound::Unbounded, Bound::Included(most)),
            Self::Above(least) => (Bound::Excluded(least), Bound::Unbounded),
            Self::AtLeast(least) => (Bound::Included(least), Bound::Unbounded),
            Self::Between(least, most) => (Bound::Included(least), Bound::Included(most)),
        }
    }

    /// Returns whether a time of this many microseconds passes.
    #[must_use]
    pub fn accepts(self, micros: i64) -> bool {
        self.bounds().contains(&micros)
    }
}

/// A relation of time to another annotation of the same recording.
///
/// It holds if at least one annotation that passes the test has the relation; with `not` before it, if no annotation
/// does.
#[derive(Debug, Clone, PartialEq)]
pub struct Related {
    /// The place of the relation and its right side.
    pub at: At,
    /// The relation of the token's span to that of the other annotation.
    pub relation: Relation,
    /// The other annotation: a component, a text or a tier.
    pub other: Test,
}

/// A search by example.
#[derive(Debug, Clone, PartialEq)]
pub struct Like {
    /// Its place in the query.
    pub at: At,
    /// The place of the example's address.
    pub example_at: At,
    /// The token to resemble.
    pub example: Example,
    /// The components that count; if the list is empty, all count equally.
    pub on: Vec<Weighted>,
    /// `above 0.6`: the similarity, from 0 to 1, that a token must exceed to be found.
    pub above: Option<f64>,
}

/// The token that others are to resemble.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Example {
    /// `token:41`: this token.
    Token(String),
    /// `sign:LIMACE` or the bare gloss: the citation form of this sign.
    Sign(String),
}

/// A component that counts in a search by example.
#[derive(Debug, Clone, PartialEq)]
pub struct Weighted {
    /// Its place in the query.
    pub at: At,
    /// The component.
    pub field: Field,
    /// Its weight among the terms: above 0, at most 1000; 1 by default.
    pub weight: f64,
}
