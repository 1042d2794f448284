//! The syntax tree of a query.

use super::{AttributeTest, Pattern, Saved};
use crate::component::{Field, Reading};
use crate::relation::Relation;
use std::ops::{Bound, Range, RangeBounds};

/// A place in the text of a query, in characters (not bytes), half-open.
///
/// Every place equals every other, so that two trees are equal when they ask the same thing,
/// wherever it is written. Compare [`range`](Self::range)s to compare places.
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

/// A question to a corpus: which tokens are like this?
///
/// Printing gives canonical text, and parsing what was printed gives an equal query.
#[derive(Debug, Clone, PartialEq)]
pub struct Query {
    /// The condition on the tokens; an empty [`Expr::And`] accepts all.
    pub root: Expr,
}

impl Query {
    /// Returns every comparison of the query in written order, those on the right of relations too.
    #[must_use]
    pub fn tests(&self) -> Vec<&Test> {
        let mut found = Vec::new();
        self.root.collect_tests(&mut found);
        found
    }
}

/// Something that holds of a token or does not.
#[derive(Debug, Clone, PartialEq)]
pub enum Expr {
    /// All of them hold; none at all hold of everything. Never holds another `And` directly.
    And(Vec<Expr>),
    /// At least one holds. Has two or more, and never another `Or` directly.
    Or(Vec<Expr>),
    /// It does not hold.
    Not(Box<Expr>),
    /// A comparison of one thing known about the token.
    Test(Test),
    /// The token stands in a relation of time to another annotation of its recording.
    Relation(Related),
    /// The token resembles another.
    Like(Like),
    /// A saved search finds it.
    Saved(Saved),
}

impl Expr {
    /// Returns the conjunction of `terms`, flattened; one term stands for itself.
    #[must_use]
    pub fn all(terms: impl IntoIterator<Item = Self>) -> Self {
        let flat = |term| match term {
            Self::And(inner) => inner,
            other => vec![other],
        };
        only(terms.into_iter().flat_map(flat).collect()).unwrap_or_else(Self::And)
    }

    /// Returns the disjunction of `terms`, flattened; one term stands for itself.
    #[must_use]
    pub fn any(terms: impl IntoIterator<Item = Self>) -> Self {
        let flat = |term| match term {
            Self::Or(inner) => inner,
            other => vec![other],
        };
        only(terms.into_iter().flat_map(flat).collect()).unwrap_or_else(Self::Or)
    }

    /// Returns where this stands in the query; of a negation, where the negated part stands.
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

/// A comparison of one thing with what is wanted.
#[derive(Debug, Clone, PartialEq)]
pub struct Test {
    /// Where the whole comparison stands.
    pub at: At,
    /// Where the thing compared is named.
    pub subject_at: At,
    /// The subject of the comparison.
    pub what: What,
}

/// The subject of a test.
#[derive(Debug, Clone, PartialEq)]
pub enum What {
    /// A component of the token: `right.configuration=U`. Where no hand or phase is named, it
    /// holds when the reading of any hand or phase passes, for `!=` too.
    Component(Field, Comparison),
    /// Something known about the token as a whole: `origin=made`.
    Property(Property, Comparison),
    /// A whole text: `gloss=CHAT`.
    Whole(TextField, Comparison),
    /// Words in a text: `gloss:BO*`, `"slow animal"`; any of the patterns is enough. A pattern of
    /// several words is a phrase.
    Words(TextField, Vec<Pattern>),
    /// A text up to some slips: `gloss~ESCARGO`, `gloss~ESCARG~2`.
    Fuzzy {
        /// The text searched.
        field: TextField,
        /// The text to resemble.
        text: String,
        /// How many characters may be added, left out, changed or swapped: 1 or 2.
        slips: u8,
    },
    /// An annotation on the tiers so named that shares time with the token: `tier("Mouthing")=ma*`.
    Tier(Pattern, Comparison),
    /// A length or a moment: `duration<0.8s`.
    Time(TimeField, TimeTest),
    /// A number or a text that a table says of the sign: `frequency>0.4`, `attribute.class=Noun`.
    Attribute(String, AttributeTest),
    /// A curve of the face or head: `nonmanual.brows>0.5 for 0.3s`.
    Curve(CurveTest),
}

/// A condition on a curve of the face or head while the token lasts, or over a part of it.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveTest {
    /// The part or number after `nonmanual.`, such as `brows`, `jaw_open` or `head_yaw`.
    pub name: String,
    /// The numbers that pass; always a [`Number`](AttributeTest::Number).
    pub test: AttributeTest,
    /// How long they pass at least, in microseconds; 0 for one frame.
    pub lasting: i64,
}

/// An operator with the values on its right.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Comparison {
    /// How the values are compared.
    pub operator: Operator,
    /// At least one.
    pub values: Vec<Value>,
}

impl Comparison {
    /// Returns whether a reading passes; one reading never passes for [`Steps`](Wanted::Steps).
    ///
    /// `fits` decides whether a value is the [`Named`](Wanted::Named) one in the query, or has the
    /// [`Features`](Wanted::Features). It is called for these two only, and reads the operator to know whether
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

/// How a field is compared with values.
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

/// One value as it is asked for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Value {
    /// Where it stands in the query.
    pub at: At,
    /// What is asked for.
    pub wanted: Wanted,
}

/// The wanted value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Wanted {
    /// `*`: any value, as long as there is one.
    Present,
    /// None, for this reason: `unset`, `n/a` or `unclear`.
    Missing(Missing),
    /// One of this name; never `*` alone.
    Named(Pattern),
    /// `[index -thumb]`: one with all these features.
    Features(Vec<Feature>),
    /// `head > chest`: the sign begins with the first and moves on to the others in this order,
    /// with or without further values between them. Two or more, each a name, features or `*`.
    Steps(Vec<Value>),
}

/// A feature that a value must or must not have.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Feature {
    /// Where it stands in the query, with its minus.
    pub at: At,
    /// Its name as written.
    pub name: String,
    /// Whether the value must be without it.
    pub absent: bool,
}

/// Why a field has no value.
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
    /// The three ways of having no value.
    pub const ALL: [Self; 3] = [Self::Unset, Self::NotApplicable, Self::Unclear];

    /// Returns how a query spells it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Unset => "unset",
            Self::NotApplicable => "n/a",
            Self::Unclear => "unclear",
        }
    }

    /// Returns the reading that is asked for.
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

/// Something known about a token as a whole.
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
    /// The name of an inventory that values of the token come from.
    Inventory,
    /// The hand that the token is annotated for, else the hands that something is coded of: `right`,
    /// `left`, `dominant`, `weak` or `both`.
    Hand,
}

/// A length or a moment of a token.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum TimeField {
    /// How long it lasts.
    Duration,
    /// Its start, from the start of the recording.
    Start,
    /// Its end, from the start of the recording.
    End,
}

/// Which times are meant, in microseconds, never negative.
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
    /// `=0.5s..1s`, ends included; the first is never above the second.
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
/// It holds where at least one annotation that passes the test stands in the relation; `not`
/// before it says that none does.
#[derive(Debug, Clone, PartialEq)]
pub struct Related {
    /// Where the relation and its right side stand.
    pub at: At,
    /// How the token's span stands to that of the other annotation.
    pub relation: Relation,
    /// The other annotation: a component, a text or a tier.
    pub other: Test,
}

/// A search by example.
#[derive(Debug, Clone, PartialEq)]
pub struct Like {
    /// Where it stands in the query.
    pub at: At,
    /// Where the example is named.
    pub example_at: At,
    /// The token to resemble.
    pub example: Example,
    /// The components that count; all of them alike where the list is empty.
    pub on: Vec<Weighted>,
    /// `above 0.6`: how alike a token must be, more than this, to be found at all; from 0 to 1.
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
    /// Where it stands in the query.
    pub at: At,
    /// The component.
    pub field: Field,
    /// Its weight among the terms: above 0, at most 1000; 1 by default.
    pub weight: f64,
}
