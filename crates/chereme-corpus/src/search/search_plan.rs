//! Plans: the part of a query that the index evaluates, and the conditions on rows that are checked afterwards.

use chereme_sign::query::ValueComparison;

use super::compile::{QueryContext, QueryResult};
use super::docs::{self, DocumentList};
use super::probe::{IndexDocument, IndexProbe};
use super::text_match;
use super::time_relations::NeighbourRelation;

/// The way in which a query is evaluated.
pub(crate) enum QueryPlan {
    /// The index returns the documents.
    Index(IndexProbe),
    /// The index returns the documents to exclude.
    Without(IndexProbe),
    /// All of these.
    And(Vec<QueryPlan>),
    /// Any of these.
    Or(Vec<QueryPlan>),
    /// Not this.
    Not(Box<QueryPlan>),
    /// The recording must have another annotation in a given relation.
    Beside(Box<NeighbourRelation>),
    /// A whole text that is not a gloss is compared.
    Whole(Box<WholeText>),
}

/// A comparison of whole texts.
pub(crate) struct WholeText {
    /// Whether translations are compared; otherwise remarks.
    pub(crate) translation: bool,
    pub(crate) comparison: ValueComparison,
    /// A condition that the index can check and that every passing token meets.
    pub(crate) narrowed: Option<IndexProbe>,
}

impl QueryPlan {
    /// Returns the plan that selects every token.
    pub(crate) fn select_all_plan() -> Self {
        Self::Index(IndexProbe::All)
    }

    /// Returns the plan that selects no token.
    pub(crate) fn select_none_plan() -> Self {
        Self::Without(IndexProbe::All)
    }

    /// Returns the conjunction of these plans.
    pub(crate) fn conjoin_plans(plans: Vec<Self>) -> Self {
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
            // One request for all conditions lets the index intersect them by itself.
            let probe = match (wanted.len(), unwanted.is_empty()) {
                (1, true) => wanted.remove(0),
                _ => IndexProbe::And(wanted, unwanted),
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
    pub(crate) fn disjoin_plans(plans: Vec<Self>) -> Self {
        let mut clauses: Vec<IndexProbe> = Vec::new();
        let mut rest = Vec::new();
        for plan in plans {
            match plan.indexed_probe() {
                Ok(query) => clauses.push(query),
                Err(other) => rest.push(other),
            }
        }
        match clauses.len() {
            0 if rest.is_empty() => return Self::select_none_plan(),
            0 => {}
            1 => rest.extend(clauses.pop().map(Self::Index)),
            _ => rest.push(Self::Index(IndexProbe::Or(clauses))),
        }
        if rest.len() == 1 {
            rest.remove(0)
        } else {
            Self::Or(rest)
        }
    }

    /// Returns the negation of this plan.
    pub(crate) fn negate_plan(self) -> Self {
        match self {
            Self::Index(query) => Self::Without(query),
            Self::Without(query) => Self::Index(query),
            Self::Not(inner) => *inner,
            other => Self::Not(Box::new(other)),
        }
    }

    /// Returns the probe, if the index can evaluate the whole plan.
    pub(crate) fn indexed_probe(self) -> Result<IndexProbe, Self> {
        match self {
            Self::Index(probe) => Ok(probe),
            Self::Without(probe) => Ok(probe.invert_probe()),
            other => Err(other),
        }
    }
}

/// Returns the documents that a plan selects, from those in `within` if it is given.
///
/// Rows are read only for tokens that the rest of the plan leaves.
pub(crate) fn evaluate_query_plan(
    ask: &QueryContext<'_>,
    plan: &QueryPlan,
    within: Option<&[IndexDocument]>,
) -> QueryResult<DocumentList> {
    if within.is_some_and(<[_]>::is_empty) {
        return Ok(DocumentList::new());
    }
    let inside = |found: DocumentList| match within {
        Some(within) => docs::intersect_documents(&found, within),
        None => found,
    };
    let candidates = || match within {
        Some(within) => Ok(within.to_vec()),
        None => ask.run_index_probe(&IndexProbe::All),
    };
    match plan {
        QueryPlan::Index(probe) => Ok(inside(ask.run_index_probe(probe)?)),
        QueryPlan::Without(probe) => Ok(inside(ask.run_index_probe(&probe.clone().invert_probe())?)),
        QueryPlan::And(plans) => {
            let mut order: Vec<&QueryPlan> = plans.iter().collect();
            // Cheap conditions go first and leave few tokens to those that read rows.
            order.sort_by_key(|plan| effort(plan));
            let mut left: Option<DocumentList> = None;
            for plan in order {
                left = Some(evaluate_query_plan(ask, plan, left.as_deref().or(within))?);
            }
            left.map_or_else(|| Ok(candidates()?), Ok)
        }
        QueryPlan::Or(plans) => plans.iter().try_fold(DocumentList::new(), |found, plan| {
            Ok(docs::unite_documents(found, evaluate_query_plan(ask, plan, within)?))
        }),
        QueryPlan::Not(inner) => {
            let candidates = candidates()?;
            let unwanted = evaluate_query_plan(ask, inner, Some(&candidates))?;
            Ok(docs::subtract_documents(&candidates, &unwanted))
        }
        QueryPlan::Beside(beside) => beside.filter_related_candidates(ask, candidates()?),
        QueryPlan::Whole(text) => {
            let candidates = match &text.narrowed {
                Some(probe) => inside(ask.run_index_probe(probe)?),
                None => candidates()?,
            };
            text_match::filter_whole_texts(ask, text, candidates)
        }
    }
}

fn effort(plan: &QueryPlan) -> u8 {
    match plan {
        QueryPlan::Index(_) | QueryPlan::Without(_) => 0,
        QueryPlan::Whole(text) if text.narrowed.is_some() => 1,
        QueryPlan::And(_) => 2,
        QueryPlan::Or(_) | QueryPlan::Not(_) => 3,
        QueryPlan::Whole(_) => 4,
        QueryPlan::Beside(_) => 5,
    }
}
