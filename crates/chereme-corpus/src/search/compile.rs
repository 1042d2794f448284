//! Compiles the tree of a query to a plan.

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::sync::Arc;

use chereme_sign::Component;
use chereme_sign::Remedy;
use chereme_sign::query::{
    At, Comparison, Expr, Missing, Operator, Property, QueryError, Test, TimeField, TimeTest,
    Value, Wanted, What,
};
use chereme_sign::text::{fold, nearest};
use rusqlite::Connection;

use super::attributes;
use super::component::ComponentTest;
use super::curves;
use super::docs::Docs;
use super::finding::{Finding, FindingKind};
use super::index::SearchIndex;
use super::known::{KnownReadings, Signs};
use super::plan::Plan;
use super::probe::{Index, Probe, RowField, Text};
use super::text_match;
use super::texts::Glob;
use super::time_relations::Beside;
use super::vocabulary::Vocabulary;
use crate::db::search::answers::{self, Named};
use crate::db::search::terms::TokenProperty;
use crate::error::{Error, Result};

/// The corpus and index against which a query is evaluated.
pub(crate) struct Ask<'a> {
    pub(crate) connection: &'a Connection,
    pub(crate) index: &'a SearchIndex,
    /// The index at the time of the query.
    pub(crate) now: &'a dyn Index,
    pub(crate) vocabulary: Arc<Vocabulary>,
    pub(crate) notes: RefCell<BTreeSet<String>>,
    pub(crate) findings: RefCell<Vec<Finding>>,
    /// The number of rows examined so far.
    pub(crate) looked_at: Cell<u64>,
    /// Receives the number of examined rows, and decides whether to go on.
    pub(crate) hear: &'a RefCell<dyn FnMut(u64) -> Result<()> + 'a>,
}

/// The reason why a query has no answer.
pub(crate) enum Failure {
    /// The query names something that does not exist.
    Query(QueryError),
    /// Rows or index cannot be read.
    Other(Error),
}

/// The result of a step of evaluation.
pub(crate) type Asked<T> = std::result::Result<T, Failure>;

impl From<QueryError> for Failure {
    fn from(error: QueryError) -> Self {
        Self::Query(error)
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::Other(error)
    }
}

impl Ask<'_> {
    /// Returns the readings of a component that the index holds.
    pub(crate) fn readings(&self, component: Component) -> Result<Arc<KnownReadings>> {
        let mut memory = self.index.memory();
        memory.readings(self.now, component)
    }

    /// Returns the documents that the index has for a probe.
    pub(crate) fn run(&self, probe: &Probe) -> Result<Docs> {
        self.go_on()?;
        self.now.docs(probe)
    }

    /// Fails if the caller no longer wants an answer.
    pub(crate) fn go_on(&self) -> Result<()> {
        (self.hear.borrow_mut())(self.looked_at.get())
    }

    /// Counts an examined row, and checks from time to time whether to go on.
    pub(crate) fn look(&self) -> Result<()> {
        const OFTEN: u64 = 64;
        let rows = self.looked_at.get() + 1;
        self.looked_at.set(rows);
        if rows.is_multiple_of(OFTEN) {
            self.go_on()?;
        }
        Ok(())
    }

    /// Returns the signs of the corpus.
    pub(crate) fn signs(&self) -> Result<Arc<Signs>> {
        self.index.memory().signs(self.connection)
    }

    /// Adds a note for the user.
    pub(crate) fn note(&self, text: String) {
        self.notes.borrow_mut().insert(text);
    }

    /// Adds a finding about a condition, once.
    pub(crate) fn find(&self, condition: String, at: At, kind: FindingKind) {
        let finding = Finding::new(condition, at, kind);
        let mut findings = self.findings.borrow_mut();
        if !findings.contains(&finding) {
            findings.push(finding);
        }
    }
}

/// Returns the plan for an expression. A search by example selects every token and only affects the order.
///
/// # Errors
/// Fails if the expression names a value, feature, signer or the like that does not exist, or ranks by what it
/// excludes.
pub(crate) fn plan(ask: &Ask<'_>, expr: &Expr) -> Asked<Plan> {
    match expr {
        Expr::And(terms) => {
            let ranked = |term: &&Expr| !matches!(term, Expr::Like(_));
            // The relation is then to a stretch of the curve, so the other may also lie in the token itself.
            let of_curve = terms.iter().any(is_of_curve);
            let plans = terms.iter().filter(ranked).map(|term| match term {
                Expr::Relation(related) if of_curve => {
                    let beside = Beside::new(ask, Some(related.relation), &related.other)?;
                    Ok(Plan::Beside(Box::new(beside.or_itself())))
                }
                term => plan(ask, term),
            });
            Ok(Plan::all(plans.collect::<Asked<_>>()?))
        }
        Expr::Or(terms) => {
            let plans = terms.iter().map(|term| inner(ask, term));
            Ok(Plan::any(plans.collect::<Asked<_>>()?))
        }
        Expr::Not(negated) => Ok(inner(ask, negated)?.not()),
        Expr::Test(test) => self::test(ask, test),
        Expr::Relation(related) => {
            let beside = Beside::new(ask, Some(related.relation), &related.other)?;
            Ok(Plan::Beside(Box::new(beside)))
        }
        Expr::Like(_) => Ok(Plan::everything()),
        Expr::Saved(saved) => Err(QueryError {
            at: saved.at.range(),
            message: format!("no search is saved as {:?}", saved.name),
            remedy: Remedy::command("`chereme list CORPUS searches` lists those that are"),
            suggestion: None,
        }
        .into()),
    }
}

fn is_of_curve(term: &Expr) -> bool {
    matches!(term, Expr::Test(test) if matches!(test.what, What::Curve(..)))
}

/// Returns the plan for an operand of a connective, in which a search by example is not allowed.
fn inner(ask: &Ask<'_>, expr: &Expr) -> Asked<Plan> {
    let example = match expr {
        Expr::Like(like) => Some(like),
        Expr::And(terms) => terms.iter().find_map(|term| match term {
            Expr::Like(like) => Some(like),
            _ => None,
        }),
        _ => None,
    };
    match example {
        None => plan(ask, expr),
        Some(like) => Err(QueryError {
            at: like.at.range(),
            message:
                "`like` orders the whole answer, or removes less similar tokens from all of it"
                    .to_owned(),
            remedy: "write it beside the other terms, not after `not` or `or`".into(),
            suggestion: None,
        }
        .into()),
    }
}

fn phase_of_no_token(at: std::ops::Range<usize>) -> QueryError {
    QueryError {
        at,
        message: "phases of movement are not values of a token: they divide the time of signing"
            .to_owned(),
        remedy: "write a relation to them: overlaps movement.phase=stroke".into(),
        suggestion: None,
    }
}

/// Returns the plan for one comparison.
pub(crate) fn test(ask: &Ask<'_>, test: &Test) -> Asked<Plan> {
    match &test.what {
        What::Component(field, comparison) => {
            let range = test.subject_at.range();
            if field.component == Component::Movement && field.feature.as_deref() == Some("phase") {
                return Err(phase_of_no_token(range).into());
            }
            ComponentTest::new(ask, field, comparison, range)?.plan(ask)
        }
        What::Property(property, comparison) => self::property(ask, *property, comparison),
        What::Whole(field, comparison) => text_match::plan(ask, *field, comparison),
        What::Words(..) | What::Fuzzy { .. } => text_match::words_plan(ask, test),
        What::Tier(..) => Ok(Plan::Beside(Box::new(Beside::new(ask, None, test)?))),
        What::Time(field, times) => Ok(Plan::Index(self::times(*field, *times))),
        What::Attribute(name, wanted) => attributes::plan(ask, test, name, wanted),
        What::Curve(wanted) => curves::plan(ask, test, wanted),
    }
}

fn times(field: TimeField, test: TimeTest) -> Probe {
    let (least, most) = test.bounds();
    Probe::Between(field, least, most)
}

fn property(ask: &Ask<'_>, property: Property, comparison: &Comparison) -> Asked<Plan> {
    let exactly = comparison.operator == Operator::Exactly;
    let values = comparison.values.iter();
    let plans = values.map(|value| match &value.wanted {
        Wanted::Present => has(ask, property),
        Wanted::Missing(Missing::Unset) => Ok(has(ask, property)?.not()),
        Wanted::Missing(_) | Wanted::Features(_) | Wanted::Steps(_) => Ok(Plan::nothing()),
        Wanted::Named(pattern) => {
            let (glob, text) = if exactly {
                (Glob::exact(pattern), pattern.to_string())
            } else {
                (Glob::whole(pattern), pattern.to_string())
            };
            let wanted = RequestedName {
                glob,
                exactly,
                text: pattern.as_literal().map_or(text, str::to_owned),
                literal: pattern.as_literal().is_some(),
                value,
            };
            named(ask, property, &wanted)
        }
    });
    let found = Plan::any(plans.collect::<Asked<_>>()?);
    if comparison.operator != Operator::IsNot {
        return Ok(found);
    }
    let names = |value: &Value| matches!(value.wanted, Wanted::Named(_));
    if comparison.values.iter().any(names) {
        Ok(Plan::all(vec![has(ask, property)?, found.not()]))
    } else {
        Ok(found.not())
    }
}

/// A requested name.
struct RequestedName<'a> {
    glob: Glob,
    exactly: bool,
    text: String,
    literal: bool,
    value: &'a Value,
}

impl RequestedName<'_> {
    fn is(&self, name: &str) -> bool {
        if self.exactly {
            self.glob.matches(name)
        } else {
            self.glob.fits(name, &fold(name))
        }
    }

    fn unknown(&self, kind: &str, known: impl IntoIterator<Item = String>) -> Failure {
        const NAMED: usize = 8;
        let known: Vec<String> = known.into_iter().collect();
        let shown = known.iter().take(NAMED).cloned().collect::<Vec<_>>();
        let more = match known.len() {
            0 => format!("the corpus has no {kind}"),
            1..=NAMED => format!("there are: {}", shown.join(", ")),
            count => format!("there are: {} and {} more", shown.join(", "), count - NAMED),
        };
        let near = nearest(&self.text, known.iter().map(String::as_str));
        Failure::Query(QueryError {
            at: self.value.at.range(),
            message: format!("no {kind} is called {:?}", self.text),
            remedy: more.into(),
            suggestion: near.map(quoted),
        })
    }
}

fn quoted(name: &str) -> String {
    let bare = |c: char| c.is_alphanumeric() || "-_.:".contains(c);
    if name.chars().all(bare) {
        name.to_owned()
    } else {
        format!("{name:?}")
    }
}

fn mark_of(property: Property) -> Option<TokenProperty> {
    match property {
        Property::Origin => Some(TokenProperty::Origin),
        Property::Hand => Some(TokenProperty::Hand),
        Property::Tier => Some(TokenProperty::Tier),
        Property::Inventory => Some(TokenProperty::Inventory),
        _ => None,
    }
}

/// Returns the plan for the tokens that have some value of a property.
fn has(ask: &Ask<'_>, property: Property) -> Asked<Plan> {
    if let Some(mark) = mark_of(property) {
        let terms = ask.now.terms(Text::Reading, &mark.prefix(), &|_| true)?;
        return Ok(Plan::Index(Probe::readings(terms)));
    }
    let field = match property {
        Property::Signer => RowField::Signer,
        Property::Recording => RowField::Recording,
        _ => return Ok(Plan::everything()),
    };
    Ok(Plan::Index(Probe::Has(field)))
}

fn named(ask: &Ask<'_>, property: Property, wish: &RequestedName<'_>) -> Asked<Plan> {
    if let Some(mark) = mark_of(property) {
        return marked(ask, property, mark, wish);
    }
    let (field, kind, rows) = match property {
        Property::Token => return token(wish),
        Property::Signer => (RowField::Signer, "signer", Named::Signer),
        Property::Recording => (RowField::Recording, "recording", Named::Recording),
        _ => (RowField::Sign, "sign", Named::Sign),
    };
    if wish.literal
        && let Ok(number) = wish.text.parse::<i64>()
        && answers::name(ask.connection, rows, number)?.is_some()
    {
        return Ok(Plan::Index(Probe::Rows(field, vec![number])));
    }
    let names = answers::names(ask.connection, rows)?;
    let found = names.iter().filter(|(_, name)| wish.is(name));
    let found: Vec<i64> = found.map(|(id, _)| *id).collect();
    if found.is_empty() && wish.literal {
        return Err(wish.unknown(kind, names.into_iter().map(|(_, name)| name)));
    }
    Ok(Plan::Index(Probe::Rows(field, found)))
}

fn marked(
    ask: &Ask<'_>,
    property: Property,
    mark: TokenProperty,
    wish: &RequestedName<'_>,
) -> Asked<Plan> {
    let prefix = mark.prefix();
    let terms = ask.now.terms(Text::Reading, &prefix, &|_| true)?;
    let name = |term: &String| term[prefix.len()..].to_owned();
    let found: Vec<&String> = terms.iter().filter(|term| wish.is(&name(term))).collect();
    if found.is_empty() && wish.literal && property.fixed_values().is_none() {
        let mut known: BTreeSet<String> = terms.iter().map(name).collect();
        if property == Property::Inventory {
            known.extend(ask.vocabulary.ids().map(str::to_owned));
        }
        if !known.iter().any(|name| wish.is(name)) {
            return Err(wish.unknown(property.name(), known));
        }
    }
    Ok(Plan::Index(Probe::readings(found)))
}

fn token(wish: &RequestedName<'_>) -> Asked<Plan> {
    match wish.text.parse::<i64>() {
        Ok(number) if number >= 0 => Ok(Plan::Index(Probe::Rows(RowField::Token, vec![number]))),
        _ => Err(QueryError {
            at: wish.value.at.range(),
            message: format!("{:?} is no number of a token", wish.text),
            remedy: "write token=41; a sign is found by gloss=CHAT".into(),
            suggestion: None,
        }
        .into()),
    }
}
