//! Retrieval: finds the tokens that answer a query.
//!
//! A query is compiled to a [plan](plan::QueryPlan): one request to the [index](index) for the conditions that it can
//! evaluate, and reads of rows for the others (temporal relations, whole texts), for only those tokens that the rest of
//! the query leaves.

mod alone;
mod answer;
mod compile;
mod docs;
pub(crate) mod index;
mod like;
mod probe;
pub(crate) mod saved_search;
mod search_attributes;
mod search_component;
mod search_curves;
mod search_everyday;
mod search_facets;
mod search_finding;
mod search_findings;
mod search_known;
mod search_plan;
mod search_recordings;
mod search_sources;
mod search_steps;
mod search_tally;
mod search_texts;
mod search_vocabulary;
#[cfg(test)]
mod tests;
mod text_match;
mod time_relations;

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;

use chereme_sign::query::{LikeSearch, QueryError, QueryExpression, QueryTest, TestSubject, TextPattern, TokenQuery};
use rusqlite::Connection;

use crate::Corpus;
use crate::db::signs::{self, TokenRow};
use crate::db::stored_search as rows;
use crate::error::{CorpusError, CorpusResult, WrongQuery};
use crate::forms::FormSelection;
use crate::progress::{ProgressReceiver, ProgressStep, ProgressUnit};

pub use crate::db::stored_columns::OpinionStanding;
use answer::DocumentRanks;
pub use answer::{HitOrder, SearchAnswer, SearchHit};
use compile::{QueryContext, QueryFailure, QueryResult};
use index::{SearchIndex, catch_index_panic};
use like::ExampleScores;
pub use search_everyday::{guessed_query_text, meant_query_text};
pub use search_facets::FACET_VALUES;
pub use search_finding::{FindingKind, QueryFinding};
pub use search_tally::{NO_VALUE, TallyRow, ValueTally};

/// The wanted part of an answer.
#[derive(Debug, Clone, PartialEq, Eq)]
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
    pub order: HitOrder,
}

impl Default for SearchOptions {
    fn default() -> Self {
        Self {
            limit: None,
            offset: 0,
            facets: true,
            facet_values: FACET_VALUES,
            order: HitOrder::Rank,
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
    /// [`CorpusError::Query`] with the place in the query that cannot be understood, or that names a value, signer or the
    /// like that does not exist.
    pub fn search_tokens(&mut self, query: &str, options: &SearchOptions) -> CorpusResult<SearchAnswer> {
        self.search_until(query, options, &mut ProgressReceiver::silent_progress())
    }

    /// Searches as [`search_tokens`](Self::search_tokens) does, and stops if `progress` asks to; it is called many times a second.
    ///
    /// # Errors
    /// Those of [`search_tokens`](Self::search_tokens), and [`CorpusError::Stopped`].
    pub fn search_until(
        &mut self,
        query: &str,
        options: &SearchOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<SearchAnswer> {
        self.evaluate_with_context(query, progress, &mut |ask, query| answer_query(ask, query, options))
    }

    /// Returns the recordings that a query means: those with a token that it finds. If all its conditions are about
    /// recordings, their files, their signers or attributes of signers, recordings without a token answer, too.
    ///
    /// # Errors
    /// Fails if the query cannot be read; [`CorpusError::Stopped`].
    pub fn recordings_of_query(
        &mut self,
        query: &str,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<BTreeSet<i64>> {
        if let Some(found) = self.recordings_without_tokens(query)? {
            return Ok(found);
        }
        let tokens = self.tokens_found(query, progress)?;
        Ok(tokens.iter().filter_map(|token| token.recording_id).collect())
    }

    /// Returns the recordings of a query about recordings alone; `None` if it is about tokens.
    pub(crate) fn recordings_without_tokens(&self, query: &str) -> CorpusResult<Option<BTreeSet<i64>>> {
        let connection = self.store.read_connection();
        let parsed = saved_search::parse_query_with_saved(connection, query)?;
        search_recordings::find_recordings(connection, &parsed.root)
    }

    /// Returns the tokens that a query finds, in the order of their rows.
    ///
    /// # Errors
    /// Those of [`search_until`](Self::search_until).
    pub(crate) fn tokens_found(
        &mut self,
        query: &str,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<Vec<TokenRow>> {
        let all = SearchOptions {
            facets: false,
            ..SearchOptions::default()
        };
        let answer = self.search_until(query, &all, progress)?;
        let ids: Vec<i64> = answer.hits.iter().map(|hit| hit.token).collect();
        let tokens = signs::load_token_rows(self.store.read_connection(), &ids)?;
        Ok(tokens.into_values().collect())
    }

    /// Returns the selection of the tokens that a query finds; without one of all signs.
    ///
    /// # Errors
    /// Those of [`search_tokens`](Self::search_tokens).
    pub(crate) fn select_forms(
        &mut self,
        query: Option<&str>,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<FormSelection> {
        Ok(match query {
            Some(query) => FormSelection::Tokens(self.tokens_found(query, progress)?),
            None => FormSelection::All,
        })
    }

    /// Evaluates a query with `ask` on one state of the corpus.
    fn evaluate_with_context<T>(
        &mut self,
        query: &str,
        progress: &mut ProgressReceiver<'_>,
        ask: &mut dyn FnMut(&QueryContext<'_>, &TokenQuery) -> QueryResult<T>,
    ) -> CorpusResult<T> {
        const MAX_SEARCH_ATTEMPTS: usize = 8;
        let parsed = saved_search::parse_query_with_saved(self.store.read_connection(), query)?;
        let hear = RefCell::new(|done| {
            progress.report_step(ProgressStep {
                task: "",
                done,
                total: None,
                unit: ProgressUnit::Items,
            })
        });
        let mut mended = false;
        for _ in 0..MAX_SEARCH_ATTEMPTS {
            let (connection, index) = self.store.searchable_connection()?;
            let reading = rows::begin_reading(connection)?;
            // Another program wrote between the refresh of the index and the begin of this reading.
            if !index.is_current(connection)? {
                continue;
            }
            // A damaged index can make its library panic; it is built again instead.
            let answer = catch_index_panic(|| {
                Ok(with_index(connection, index, &hear, |question| {
                    question.opinions.set(parsed.asks_for_opinions());
                    ask(question, &parsed)
                }))
            });
            // The rebuild writes, which an open reading of the same connection would forbid.
            drop(reading);
            let answer = match answer {
                Err(CorpusError::Index(_)) | Ok(Err(QueryFailure::Other(CorpusError::Index(_)))) if !mended => {
                    mended = true;
                    self.store
                        .rebuild_search_index(&mut ProgressReceiver::silent_progress())?;
                    self.store.index().note_rebuilt();
                    continue;
                }
                answered => answered?,
            };
            return answer.map_err(|failure| match failure {
                QueryFailure::Query(error) => wrong_query_error(query, &error),
                QueryFailure::Other(error) => error,
            });
        }
        Err(
            CorpusError::from_wrong_message("another program keeps writing to the corpus")
                .with_advice("try again when it is done"),
        )
    }
}

/// Returns the tokens that answer a query, in the order of [`Corpus::search_tokens`].
pub(crate) fn find_query_tokens(connection: &Connection, index: &SearchIndex, query: &str) -> CorpusResult<Vec<i64>> {
    let parsed = TokenQuery::parse_query(query).map_err(|error| wrong_query_error(query, &error))?;
    let options = SearchOptions {
        facets: false,
        ..SearchOptions::default()
    };
    let hear = RefCell::new(|_| Ok(()));
    let answer = with_index(connection, index, &hear, |ask| {
        ask.opinions.set(parsed.asks_for_opinions());
        answer_query(ask, &parsed, &options)
    });
    match answer {
        Ok(answer) => Ok(answer.hits.into_iter().map(|hit| hit.token).collect()),
        Err(QueryFailure::Query(error)) => Err(wrong_query_error(query, &error)),
        Err(QueryFailure::Other(error)) => Err(error),
    }
}

/// Returns the error for a query that cannot be understood.
pub(crate) fn wrong_query_error(query: &str, error: &QueryError) -> CorpusError {
    let corrected = error.corrected_query(query);
    let remedy = match &corrected {
        _ if !error.remedy.is_empty() => Some(error.remedy.clone()),
        Some(corrected) => Some(format!("write {corrected}").into()),
        None => None,
    };
    CorpusError::Query(Box::new(WrongQuery {
        message: error.fault_message(),
        drawn: error.draw_query_error(query),
        at: error.at.start,
        remedy,
        mended: error.suggestion.clone().zip(corrected),
    }))
}

fn with_index<T>(
    connection: &Connection,
    index: &SearchIndex,
    hear: &RefCell<dyn FnMut(u64) -> CorpusResult<()> + '_>,
    ask: impl FnOnce(&QueryContext<'_>) -> QueryResult<T>,
) -> QueryResult<T> {
    let now = index.current_index_reading();
    let vocabulary = index.query_memory().cached_vocabulary(connection)?;
    ask(&QueryContext {
        connection,
        index,
        now: &now,
        vocabulary,
        opinions: Cell::new(false),
        asks_sources: Cell::new(false),
        notes: Default::default(),
        findings: Default::default(),
        looked_at: Default::default(),
        hear,
    })
}

fn answer_query(ask: &QueryContext<'_>, query: &TokenQuery, options: &SearchOptions) -> QueryResult<SearchAnswer> {
    let plan = compile::plan_expression(ask, &query.root)?;
    let mut docs = search_plan::evaluate_query_plan(ask, &plan, None)?;
    let likes = likes(&query.root);
    let scores = match &likes[..] {
        [] => None,
        some => Some(ExampleScores::new(ask, some)?),
    };
    alone::report_empty_terms(ask, query, docs.len())?;
    if let Some(scores) = &scores {
        docs.retain(|doc| scores.passes_every_example(*doc));
    }
    let texts = match options.order {
        HitOrder::Rank => ranked_texts(ask, &query.root)?,
        _ => Vec::new(),
    };
    let ranks = DocumentRanks::new(ask, &docs, scores.as_ref(), &texts)?;
    let end = options
        .limit
        .map_or(usize::MAX, |limit| options.offset.saturating_add(limit));
    let attributes = options.order.load_order_attributes(ask)?;
    let page = answer::order_document_page(ask, &docs, &options.order, &attributes, &ranks, options.offset..end)?;
    let hits = answer::collect_search_hits(ask, &page, scores.as_ref(), &attributes)?;
    let (facets, facets_left_out) = if options.facets {
        search_facets::count_document_facets(ask, &docs, options.facet_values)?
    } else {
        Default::default()
    };
    if ask.index.take_rebuilt() {
        ask.add_query_note("the search index did not follow the rows and was built again".to_owned());
    }
    Ok(SearchAnswer {
        query: query.to_string(),
        total: docs.len(),
        hits,
        facets,
        facets_left_out,
        findings: deduplicate_findings(ask.findings.take()),
        notes: ask.notes.take().into_iter().collect(),
    })
}

/// Keeps the first of findings that say the same about conditions at different places.
fn deduplicate_findings(findings: Vec<QueryFinding>) -> Vec<QueryFinding> {
    let mut kept: Vec<QueryFinding> = Vec::new();
    for finding in findings {
        let same = |other: &QueryFinding| (&other.condition, &other.kind) == (&finding.condition, &finding.kind);
        if !kept.iter().any(same) {
            kept.push(finding);
        }
    }
    kept
}

/// Returns the terms of a conjunction.
fn conjunction_terms(root: &QueryExpression) -> &[QueryExpression] {
    match root {
        QueryExpression::And(terms) => terms,
        one => std::slice::from_ref(one),
    }
}

fn likes(root: &QueryExpression) -> Vec<&LikeSearch> {
    let likes = conjunction_terms(root).iter().filter_map(|term| match term {
        QueryExpression::Like(like) => Some(like),
        _ => None,
    });
    likes.collect()
}

/// Returns the places of the texts that determine the order: plain words, and texts compared up to slips.
fn ranked_texts(
    ask: &QueryContext<'_>,
    root: &QueryExpression,
) -> QueryResult<Vec<Vec<Option<search_plan::QueryPlan>>>> {
    let plain = |pattern: &TextPattern| pattern.as_literal().is_some();
    let ranked = |test: &&QueryTest| match &test.what {
        TestSubject::Words(_, patterns) => patterns.iter().all(plain),
        TestSubject::Fuzzy { .. } => true,
        _ => false,
    };
    let tests = conjunction_terms(root).iter().filter_map(|term| match term {
        QueryExpression::Test(test) => Some(test),
        _ => None,
    });
    tests
        .filter(ranked)
        .map(|test| text_match::plan_text_places(ask, test))
        .collect()
}
