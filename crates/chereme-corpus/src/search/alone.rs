//! Counts of the single terms of a query, reported if they find nothing together.

use chereme_sign::query::{Expr, Query};

use super::compile::{self, Ask, Asked};
use super::finding::FindingKind;
use super::joined;
use super::plan;
use super::text_match;

/// Reports the terms that find nothing: all of them if the query has no results, and otherwise those within an `or`,
/// whose failure would go unnoticed.
pub(crate) fn report(ask: &Ask<'_>, query: &Query, total: usize) -> Asked<()> {
    let terms = joined(&query.root);
    if total > 0 {
        return terms.iter().try_for_each(|term| within_or(ask, term));
    }
    let ranked = |term: &&Expr| !matches!(term, Expr::Like(_));
    let mut counts = Vec::new();
    for term in terms.iter().filter(ranked) {
        let count = count(ask, term)?;
        if count == 0 {
            leaves(ask, term)?;
        }
        counts.push((term.to_string(), count));
    }
    if counts.len() > 1 && counts.iter().all(|(_, count)| *count > 0) {
        let kind = FindingKind::NoneTogether { terms: counts };
        ask.find(query.to_string(), query.root.at(), kind);
    }
    Ok(())
}

fn within_or(ask: &Ask<'_>, term: &Expr) -> Asked<()> {
    match term {
        Expr::Or(terms) => terms.iter().try_for_each(|term| {
            if count(ask, term)? == 0 {
                leaves(ask, term)?;
            }
            Ok(())
        }),
        Expr::And(terms) => terms.iter().try_for_each(|term| within_or(ask, term)),
        _ => Ok(()),
    }
}

fn count(ask: &Ask<'_>, term: &Expr) -> Asked<usize> {
    let plan = compile::plan(ask, term)?;
    Ok(plan::evaluate(ask, &plan, None)?.len())
}

/// Reports the comparisons within a term that find nothing, unless a more specific finding exists already.
fn leaves(ask: &Ask<'_>, term: &Expr) -> Asked<()> {
    match term {
        Expr::And(terms) | Expr::Or(terms) => terms.iter().try_for_each(|term| leaves(ask, term)),
        Expr::Test(_) | Expr::Relation(_) => {
            let at = term.at();
            let known = ask.findings.borrow();
            let said = known.iter().any(|it| {
                let (start, end) = it.at;
                let dead = matches!(
                    it.kind,
                    FindingKind::CannotMatch { .. } | FindingKind::NotCoded { .. }
                );
                dead && start >= at.start && end <= at.end
            });
            drop(known);
            if !said && count(ask, term)? == 0 {
                let (why, names) = match term {
                    Expr::Relation(_) => (
                        "no token has this relation to such an annotation",
                        Vec::new(),
                    ),
                    Expr::Test(test) => (
                        "no token of the corpus has it",
                        text_match::alternatives(ask, test)?,
                    ),
                    _ => ("no token of the corpus has it", Vec::new()),
                };
                let why = why.to_owned();
                let kind = FindingKind::CannotMatch { why, names };
                ask.find(term.to_string(), at, kind);
            }
            Ok(())
        }
        Expr::Not(_) | Expr::Like(_) | Expr::Saved(_) => Ok(()),
    }
}
