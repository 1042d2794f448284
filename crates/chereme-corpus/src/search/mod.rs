//! Retrieval: finds the tokens that answer a query.
//!
//! A query is compiled to a [plan](plan::Plan): one request to the [index](index) for the conditions that it can
//! evaluate, and reads of rows for the others (temporal relations, whole texts), for only those tokens that the rest of
//! the query leaves.

mod alone;
mod answer;
mod attributes;
mod compile;
mod component;
mod curves;
mod docs;
mod everyday;
mod facets;
mod finding;
mod findings;
pub(crate) mod index;
mod known;
mod like;
mod plan;
mod probe;
mod steps;
mod tally;
#[cfg(test)]
mod tests;
mod text_match;
mod texts;
mod time_relations;
mod vocabulary;

use std::cell::RefCell;

use chereme_sign::query::{Expr, Like, Pattern, Query, QueryError, Test, What};
use rusqlite::Connection;

use crate::Corpus;
use crate::db::search as rows;
use crate::db::signs::{self, TokenRow};
use crate::error::{Error, Result, WrongQuery};
use crate::progress::{Progress, Step, Unit, unheard};
use crate::saved_search;

use answer::Ranks;
pub use answer::{Answer, Hit, Order};
use compile::{Ask, Asked, Failure};
pub use everyday::{guessed, meant};
pub use facets::FACET_VALUES;
pub use finding::{Finding, FindingKind};
use index::{SearchIndex, unbroken};
use like::Scores;
pub use tally::{NO_VALUE, Tally, TallyRow};

/// The wanted part of an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SearchOptions {
    /// The most tokens to show; all by default.
    pub limit: Option<usize>,
    /// The number of tokens to skip.
    pub offset: usize,
    /// Whether to count the values of all tokens found.
    pub facets: bool,
    /// The largest number of values to count for a field.
    pub facet_values: usize,
    /// The order of the tokens.
    pub order: Order,
}

impl Default for SearchOptions {
    fn default() -> Self {
        Self {
            limit: None,
            offset: 0,
            facets: true,
            facet_values: FACET_VALUES,
            order: Order::Rank,
        }
    }
}

impl Corpus {
    /// Finds the tokens that answer a query; see [`chereme_sign::query`] for the language.
    ///
    /// A search sees one state of the corpus: everything stored before it, by this program or another, and nothing
    /// stored meanwhile. `@NAME` in a query stands for the query that is [saved](Self::keep_searches) under that name.
    ///
    /// # Errors
    /// [`Error::Query`] with the place in the query that cannot be understood, or that names a value, signer or the
    /// like that does not exist.
    pub fn search(&mut self, query: &str, options: &SearchOptions) -> Result<Answer> {
        let mut hear = unheard;
        self.search_until(query, options, &mut Progress::new(&mut hear))
    }

    /// Searches as [`search`](Self::search) does, and stops if `progress` asks to; it is called many times a second.
    ///
    /// # Errors
    /// Those of [`search`](Self::search), and [`Error::Stopped`].
    pub fn search_until(
        &mut self,
        query: &str,
        options: &SearchOptions,
        progress: &mut Progress<'_>,
    ) -> Result<Answer> {
        self.asked(query, progress, &mut |ask, query| {
            answer(ask, query, options)
        })
    }

    /// Returns the tokens that a query finds, in the order of their rows.
    ///
    /// # Errors
    /// Those of [`search_until`](Self::search_until).
    pub(crate) fn tokens_found(
        &mut self,
        query: &str,
        progress: &mut Progress<'_>,
    ) -> Result<Vec<TokenRow>> {
        let all = SearchOptions {
            facets: false,
            ..SearchOptions::default()
        };
        let found = self.search_until(query, &all, progress)?;
        let ids: Vec<i64> = found.hits.iter().map(|hit| hit.token).collect();
        let tokens = signs::tokens(self.store.read(), &ids)?;
        Ok(tokens.into_values().collect())
    }

    /// Evaluates a query with `ask` on one state of the corpus.
    fn asked<T>(
        &mut self,
        query: &str,
        progress: &mut Progress<'_>,
        ask: &mut dyn FnMut(&Ask<'_>, &Query) -> Asked<T>,
    ) -> Result<T> {
        const ATTEMPTS: usize = 8;
        let parsed = saved_search::parsed(self.store.read(), query)?;
        let hear = RefCell::new(|done| {
            progress.report(Step {
                task: "",
                done,
                total: None,
                unit: Unit::Items,
            })
        });
        let mut mended = false;
        for _ in 0..ATTEMPTS {
            let (connection, index) = self.store.searchable()?;
            let reading = rows::begin_reading(connection)?;
            if !index.is_current(connection)? {
                continue;
            }
            let answer = unbroken(|| {
                Ok(with_index((connection, index), &hear, |it| {
                    ask(it, &parsed)
                }))
            });
            drop(reading);
            let answer = match answer {
                Err(Error::Index(_)) | Ok(Err(Failure::Other(Error::Index(_)))) if !mended => {
                    mended = true;
                    self.store.reindex(&mut Progress::new(&mut unheard))?;
                    self.store.index().note_rebuilt();
                    continue;
                }
                answered => answered?,
            };
            return answer.map_err(|failure| match failure {
                Failure::Query(error) => wrong(query, &error),
                Failure::Other(error) => error,
            });
        }
        Err(Error::wrong("another program keeps writing to the corpus")
            .advise("try again when it is done"))
    }
}

/// Returns the tokens that answer a query, in the order of [`Corpus::search`].
pub(crate) fn tokens(
    connection: &Connection,
    index: &SearchIndex,
    query: &str,
) -> Result<Vec<i64>> {
    let parsed = Query::parse(query).map_err(|error| wrong(query, &error))?;
    let options = SearchOptions {
        facets: false,
        ..SearchOptions::default()
    };
    let hear = RefCell::new(|_| Ok(()));
    let answer = with_index((connection, index), &hear, |ask| {
        answer(ask, &parsed, &options)
    });
    match answer {
        Ok(answer) => Ok(answer.hits.into_iter().map(|hit| hit.token).collect()),
        Err(Failure::Query(error)) => Err(wrong(query, &error)),
        Err(Failure::Other(error)) => Err(error),
    }
}

/// Returns the error for a query that cannot be understood.
pub(crate) fn wrong(query: &str, error: &QueryError) -> Error {
    let corrected = error.corrected(query);
    let remedy = match &corrected {
        _ if !error.remedy.is_empty() => Some(error.remedy.clone()),
        Some(corrected) => Some(format!("write {corrected}").into()),
        None => None,
    };
    Error::Query(Box::new(WrongQuery {
        message: error.fault(),
        drawn: error.drawn(query),
        at: error.at.start,
        remedy,
        mended: error.suggestion.clone().zip(corrected),
    }))
}

fn with_index<T>(
    (connection, index): (&Connection, &SearchIndex),
    hear: &RefCell<dyn FnMut(u64) -> Result<()> + '_>,
    ask: impl FnOnce(&Ask<'_>) -> Asked<T>,
) -> Asked<T> {
    let now = index.now();
    let vocabulary = index.memory().vocabulary(connection)?;
    ask(&Ask {
        connection,
        index,
        now: &now,
        vocabulary,
        notes: Default::default(),
        findings: Default::default(),
        looked_at: Default::default(),
        hear,
    })
}

fn answer(ask: &Ask<'_>, query: &Query, options: &SearchOptions) -> Asked<Answer> {
    let plan = compile::plan(ask, &query.root)?;
    let mut found = plan::evaluate(ask, &plan, None)?;
    let likes = likes(&query.root);
    let scores = match &likes[..] {
        [] => None,
        some => Some(Scores::new(ask, some)?),
    };
    alone::report(ask, query, found.len())?;
    if let Some(scores) = &scores {
        found.retain(|doc| scores.pass(*doc));
    }
    let texts = match options.order {
        Order::Rank => ranked_texts(ask, &query.root)?,
        _ => Vec::new(),
    };
    let ranks = Ranks::new(ask, &found, scores.as_ref(), &texts)?;
    let end = options
        .limit
        .map_or(usize::MAX, |limit| options.offset.saturating_add(limit));
    let page = answer::page(ask, &found, options.order, &ranks, options.offset..end)?;
    let hits = answer::hits(ask, &page, scores.as_ref())?;
    let (facets, facets_left_out) = if options.facets {
        facets::facets(ask, &found, options.facet_values)?
    } else {
        Default::default()
    };
    if ask.index.take_rebuilt() {
        ask.note("the search index did not follow the rows and was built again".to_owned());
    }
    Ok(Answer {
        query: query.to_string(),
        total: found.len(),
        hits,
        facets,
        facets_left_out,
        findings: once(ask.findings.take()),
        notes: ask.notes.take().into_iter().collect(),
    })
}

/// Keeps the first of findings that say the same about conditions at different places.
fn once(findings: Vec<Finding>) -> Vec<Finding> {
    let mut kept: Vec<Finding> = Vec::new();
    for finding in findings {
        let same = |it: &Finding| (&it.condition, &it.kind) == (&finding.condition, &finding.kind);
        if !kept.iter().any(same) {
            kept.push(finding);
        }
    }
    kept
}

/// Returns the terms of a conjunction.
fn joined(root: &Expr) -> &[Expr] {
    match root {
        Expr::And(terms) => terms,
        one => std::slice::from_ref(one),
    }
}

fn likes(root: &Expr) -> Vec<&Like> {
    let likes = joined(root).iter().filter_map(|term| match term {
        Expr::Like(like) => Some(like),
        _ => None,
    });
    likes.collect()
}

/// Returns the places of the texts that determine the order: plain words, and texts compared up to slips.
fn ranked_texts(ask: &Ask<'_>, root: &Expr) -> Asked<Vec<Vec<Option<plan::Plan>>>> {
    let plain = |pattern: &Pattern| pattern.as_literal().is_some();
    let ranked = |test: &&Test| match &test.what {
        What::Words(_, patterns) => patterns.iter().all(plain),
        What::Fuzzy { .. } => true,
        _ => false,
    };
    let tests = joined(root).iter().filter_map(|term| match term {
        Expr::Test(test) => Some(test),
        _ => None,
    });
    tests
        .filter(ranked)
        .map(|test| text_match::places(ask, test))
        .collect()
}
