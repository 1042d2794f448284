//! Plans: the part of a query that the index evaluates, and the conditions on rows that are checked afterwards.

use chereme_sign::query::Comparison;

use super::compile::{Ask, Asked};
use super::docs::{self, Docs};
use super::probe::{Doc, Probe};
use super::text_match;
use super::time_relations::Beside;

/// The way in which a query is evaluated.
pub(crate) enum Plan {
    /// The index returns the documents.
    Index(Probe),
    /// The index returns the documents to exclude.
    Without(Probe),
    /// All of these.
    And(Vec<Plan>),
    /// Any of these.
    Or(Vec<Plan>),
    /// Not this.
    Not(Box<Plan>),
    /// The recording must have another annotation in a given relation.
    Beside(Box<Beside>),
    /// A whole text that is not a gloss is compared.
    Whole(Box<WholeText>),
}

/// A comparison of whole texts.
pub(crate) struct WholeText {
    /// Whether translations are compared; otherwise remarks.
    pub(crate) translation: bool,
    pub(crate) comparison: Comparison,
    /// A condition that the index can check and that every passing token meets.
    pub(crate) narrowed: Option<Probe>,
}

impl Plan {
    /// Returns the plan that selects every token.
    pub(crate) fn everything() -> Self {
        Self::Index(Probe::All)
    }

    /// Returns the plan that selects no token.
    pub(crate) fn nothing() -> Self {
        Self::Without(Probe::All)
    }

    /// Returns the conjunction of these plans.
    pub(crate) fn all(plans: Vec<Self>) -> Self {
        let (mut wanted, mut unwanted) = (Vec::new(), Vec::new());
        let mut rest = Vec::new();
        for plan in plans {
            match plan {
                Self::Index(probe) => wanted.push(probe),
                Self::Without(probe) => unwanted.push(probe),
                Self::And(inner) => rest.extend(inner),
                other => rest.push(other),
            }
        }
        if !wanted.is_empty() || !unwanted.is_empty() || rest.is_empty() {
            let probe = match (wanted.len(), unwanted.is_empty()) {
                (1, true) => wanted.remove(0),
                _ => Probe::And(wanted, unwanted),
            };
            rest.insert(0, Self::Index(probe));
        }
        if rest.len() == 1 {
            rest.remove(0)
        } else {
            Self::And(rest)
        }
    }

    /// Returns the disjunction of these plans.
    pub(crate) fn any(plans: Vec<Self>) -> Self {
        let mut clauses: Vec<Probe> = Vec::new();
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
            _ => rest.push(Self::Index(Probe::Or(clauses))),
        }
        if rest.len() == 1 {
            rest.remove(0)
        } else {
            Self::Or(rest)
        }
    }

    /// Returns the negation of this plan.
    pub(crate) fn not(self) -> Self {
        match self {
            Self::Index(query) => Self::Without(query),
            Self::Without(query) => Self::Index(query),
            Self::Not(inner) => *inner,
            other => Self::Not(Box::new(other)),
        }
    }

    /// Returns the probe, if the index can evaluate the whole plan.
    pub(crate) fn indexed(self) -> Result<Probe, Self> {
        match self {
            Self::Index(probe) => Ok(probe),
            Self::Without(probe) => Ok(probe.inverted()),
            other => Err(other),
        }
    }
}

/// Returns the documents that a plan selects, from those in `within` if it is given.
///
/// Rows are read only for tokens that the rest of the plan leaves.
pub(crate) fn evaluate(ask: &Ask<'_>, plan: &Plan, within: Option<&[Doc]>) -> Asked<Docs> {
    if within.is_some_and(<[_]>::is_empty) {
        return Ok(Docs::new());
    }
    let inside = |found: Docs| match within {
        Some(within) => docs::intersection(&found, within),
        None => found,
    };
    let candidates = || match within {
        Some(within) => Ok(within.to_vec()),
        None => ask.run(&Probe::All),
    };
    match plan {
        Plan::Index(probe) => Ok(inside(ask.run(probe)?)),
        Plan::Without(probe) => Ok(inside(ask.run(&probe.clone().inverted())?)),
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
                Some(probe) => inside(ask.run(probe)?),
                None => candidates()?,
            };
            text_match::filter(ask, text, candidates)
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
