//! Counts of the single terms of a query, reported if they find nothing together.

use chereme_sign::query::{QueryExpression, TokenQuery};

use super::compile::{self, QueryContext, QueryResult};
use super::conjunction_terms;
use super::search_finding::FindingKind;
use super::search_plan;
use super::text_match;

/// Reports the terms that find nothing: all of them if the query has no results, and otherwise those within an `or`,
/// whose failure would go unnoticed.
pub(crate) fn report_empty_terms(ask: &QueryContext<'_>, query: &TokenQuery, total: usize) -> QueryResult<()> {
    let terms = conjunction_terms(&query.root);
    if total > 0 {
        return terms.iter().try_for_each(|term| within_or(ask, term));
    }
    let ranked = |term: &&QueryExpression| !matches!(term, QueryExpression::Like(_));
    let mut counts = Vec::new();
    for term in terms.iter().filter(ranked) {
        let count = count_term_tokens(ask, term)?;
        if count == 0 {
            report_empty_leaves(ask, term)?;
        }
        counts.push((term.to_string(), count));
    }
    if counts.len() > 1 && counts.iter().all(|(_, count)| *count > 0) {
        let kind = FindingKind::NoneTogether { terms: counts };
        ask.add_query_finding(query.to_string(), query.root.expression_place(), kind);
    }
    Ok(())
}

fn within_or(ask: &QueryContext<'_>, term: &QueryExpression) -> QueryResult<()> {
    match term {
        QueryExpression::Or(terms) => terms.iter().try_for_each(|term| {
            if count_term_tokens(ask, term)? == 0 {
                report_empty_leaves(ask, term)?;
            }
            Ok(())
        }),
        QueryExpression::And(terms) => terms.iter().try_for_each(|term| within_or(ask, term)),
        _ => Ok(()),
    }
}

fn count_term_tokens(ask: &QueryContext<'_>, term: &QueryExpression) -> QueryResult<usize> {
    let plan = compile::plan_expression(ask, term)?;
    Ok(search_plan::evaluate_query_plan(ask, &plan, None)?.len())
}

/// Reports the comparisons within a term that find nothing, unless a more specific finding exists already.
fn report_empty_leaves(ask: &QueryContext<'_>, term: &QueryExpression) -> QueryResult<()> {
    match term {
        QueryExpression::And(terms) | QueryExpression::Or(terms) => {
            terms.iter().try_for_each(|term| report_empty_leaves(ask, term))
        }
        QueryExpression::Test(_) | QueryExpression::Relation(_) => {
            let term_range = term.expression_place();
            let findings = ask.findings.borrow();
            let is_reported = findings.iter().any(|finding| {
                let (start, end) = finding.at;
                let dead = matches!(
                    finding.kind,
                    FindingKind::CannotMatch { .. } | FindingKind::NotCoded { .. }
                );
                dead && start >= term_range.start && end <= term_range.end
            });
            // Counting below may add findings of its own, which this borrow would forbid.
            drop(findings);
            if !is_reported && count_term_tokens(ask, term)? == 0 {
                let (why, names) = match term {
                    QueryExpression::Relation(_) => ("no token has this relation to such an annotation", Vec::new()),
                    QueryExpression::Test(test) => (
                        "no token of the corpus has it",
                        text_match::alternative_glosses(ask, test)?,
                    ),
                    _ => ("no token of the corpus has it", Vec::new()),
                };
                let why = why.to_owned();
                let kind = FindingKind::CannotMatch { why, names };
                ask.add_query_finding(term.to_string(), term_range, kind);
            }
            Ok(())
        }
        QueryExpression::Not(_) | QueryExpression::Like(_) | QueryExpression::Saved(_) => Ok(()),
    }
}
