//! Plans: the part of a query that the index answers, and the questions to the rows afterwards.

use chereme_sign::query::Comparison;
use tantivy::DocAddress;
use tantivy::query::{AllQuery, BooleanQuery, Occur, Query};

use super::beside::Beside;
use super::compile::{Ask, Asked};
use super::docs::{self, Docs};
use super::whole;

/// How a query is answered.
pub(crate) enum Plan {
    /// The index answers it.
    Index(Box<dyn Query>),
    /// The index answers what it does not want.
    Without(Box<dyn Query>),
    /// All of these.
    And(Vec<Plan>),
    /// Any of these.
    Or(Vec<Plan>),
    /// Not this.
    Not(Box<Plan>),
    /// Another annotation of the recording must be there.
    Beside(Box<Beside>),
    /// A whole text that is no gloss is compared.
    Whole(Box<WholeText>),
}

/// A comparison of whole texts.
pub(crate) struct WholeText {
    /// Translations if true, else remarks.
    pub(crate) translation: bool,
    pub(crate) comparison: Comparison,
    /// A condition that the index can check and that every passing token meets.
    pub(crate) narrowed: Option<Box<dyn Query>>,
}

impl Plan {
    /// Returns the plan that the index answers.
    pub(crate) fn index(query: impl Query) -> Self {
        Self::Index(Box::new(query))
    }

    /// Returns the plan for every token.
    pub(crate) fn everything() -> Self {
        Self::index(AllQuery)
    }

    /// Returns the plan for no token.
    pub(crate) fn nothing() -> Self {
        Self::Without(Box::new(AllQuery))
    }

    /// Returns the plan for all of these together.
    pub(crate) fn all(plans: Vec<Self>) -> Self {
        let mut clauses: Vec<(Occur, Box<dyn Query>)> = Vec::new();
        let mut rest = Vec::new();
        for plan in plans {
            match plan {
                Self::Index(query) => clauses.push((Occur::Must, query)),
                Self::Without(query) => clauses.push((Occur::MustNot, query)),
                Self::And(inner) => rest.extend(inner),
                other => rest.push(other),
            }
        }
        if !clauses.is_empty() || rest.is_empty() {
            rest.insert(0, conjunction(clauses));
        }
        if rest.len() == 1 {
            rest.remove(0)
        } else {
            Self::And(rest)
        }
    }

    /// Returns the plan for any of these.
    pub(crate) fn any(plans: Vec<Self>) -> Self {
        let mut clauses: Vec<Box<dyn Query>> = Vec::new();
        let mut rest = Vec::new();
        for plan in plans {
            match plan.indexed() {
                Ok(query) => clauses.push(query),
                Err(other) => rest.push(other),
            }
        }
        match clauses.len() {
            0 if rest.is_empty() => return Self::nothing(),
            0 => {}
            1 => rest.extend(clauses.pop().map(Self::Index)),
            _ => rest.push(Self::index(BooleanQuery::union(clauses))),
        }
        if rest.len() == 1 {
            rest.remove(0)
        } else {
            Self::Or(rest)
        }
    }

    /// Returns the plan for whatever this is not.
    pub(crate) fn not(self) -> Self {
        match self {
            Self::Index(query) => Self::Without(query),
            Self::Without(query) => Self::Index(query),
            Self::Not(inner) => *inner,
            other => Self::Not(Box::new(other)),
        }
    }

    /// Returns the query, where the index answers all of it.
    pub(crate) fn indexed(self) -> Result<Box<dyn Query>, Self> {
        match self {
            Self::Index(query) => Ok(query),
            Self::Without(query) => Ok(inverted(query)),
            other => Err(other),
        }
    }
}

fn inverted(query: Box<dyn Query>) -> Box<dyn Query> {
    Box::new(BooleanQuery::new(vec![
        (Occur::Must, Box::new(AllQuery) as Box<dyn Query>),
        (Occur::MustNot, query),
    ]))
}

fn conjunction(mut clauses: Vec<(Occur, Box<dyn Query>)>) -> Plan {
    let wanted = clauses
        .iter()
        .filter(|(occur, _)| *occur == Occur::Must)
        .count();
    if wanted == 0 {
        clauses.push((Occur::Must, Box::new(AllQuery)));
    }
    match clauses.pop() {
        Some((Occur::Must, query)) if clauses.is_empty() => Plan::Index(query),
        last => {
            clauses.extend(last);
            Plan::index(BooleanQuery::new(clauses))
        }
    }
}

/// Returns the documents that a plan selects, from those in `within` if it is given.
///
/// The rows are asked only about tokens that the rest of the plan leaves.
pub(crate) fn evaluate(ask: &Ask<'_>, plan: &Plan, within: Option<&[DocAddress]>) -> Asked<Docs> {
    if within.is_some_and(<[_]>::is_empty) {
        return Ok(Docs::new());
    }
    let inside = |found: Docs| match within {
        Some(within) => docs::intersection(&found, within),
        None => found,
    };
    let candidates = || match within {
        Some(within) => Ok(within.to_vec()),
        None => ask.run(&AllQuery),
    };
    match plan {
        Plan::Index(query) => Ok(inside(ask.run(query.as_ref())?)),
        Plan::Without(query) => {
            let query = inverted(query.box_clone());
            Ok(inside(ask.run(query.as_ref())?))
        }
        Plan::And(plans) => {
            let mut order: Vec<&Plan> = plans.iter().collect();
            order.sort_by_key(|plan| effort(plan));
            let mut left: Option<Docs> = None;
            for plan in order {
                left = Some(evaluate(ask, plan, left.as_deref().or(within))?);
            }
            left.map_or_else(|| Ok(candidates()?), Ok)
        }
        Plan::Or(plans) => plans.iter().try_fold(Docs::new(), |found, plan| {
            Ok(docs::union(found, evaluate(ask, plan, within)?))
        }),
        Plan::Not(inner) => {
            let candidates = candidates()?;
            let unwanted = evaluate(ask, inner, Some(&candidates))?;
            Ok(docs::difference(&candidates, &unwanted))
        }
        Plan::Beside(beside) => beside.filter(ask, candidates()?),
        Plan::Whole(text) => {
            let candidates = match &text.narrowed {
                Some(query) => inside(ask.run(query.as_ref())?),
                None => candidates()?,
            };
            whole::filter(ask, text, candidates)
        }
    }
}

fn effort(plan: &Plan) -> u8 {
    match plan {
        Plan::Index(_) | Plan::Without(_) => 0,
        Plan::Whole(text) if text.narrowed.is_some() => 1,
        Plan::And(_) => 2,
        Plan::Or(_) | Plan::Not(_) => 3,
        Plan::Whole(_) => 4,
        Plan::Beside(_) => 5,
    }
}
