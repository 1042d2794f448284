//! The signs that a query names as examples by token: their glosses, and where they move.

use std::collections::BTreeMap;

use chereme_corpus::ObjectDetails;
use chereme_motion::TimeSpan;
use chereme_sign::query::ExampleToken;

use super::search_builder::{self, QueryCondition};
use crate::context::PaneInput;
use crate::model::{InspectedThing, TokenSign};
use crate::work::{WorkId, WorkOutcome, WorkResult, recordings_jobs};

/// The known examples; others are looked up.
#[derive(Debug, Default)]
pub(super) struct KnownExamples {
    known: BTreeMap<i64, TokenSign>,
    looking: BTreeMap<WorkId, i64>,
}

/// Returns the tokens that a query names as examples.
fn find_example_tokens(query: &str) -> Vec<i64> {
    let Ok(query) = query.parse() else {
        return Vec::new();
    };
    let rows = search_builder::rows_from_query(&query).into_iter();
    let token = |row| match row {
        QueryCondition::Like(ExampleToken::Token(number), ..) => number.parse().ok(),
        _ => None,
    };
    rows.filter_map(token).collect()
}

impl KnownExamples {
    /// Looks up the unknown tokens of a query.
    pub(super) fn look_up_unknown_examples(&mut self, query: &str, seen: &PaneInput<'_>) {
        if !query.contains("token:") {
            return;
        }
        for token in find_example_tokens(query) {
            let asked = self.looking.values().any(|asked_token| *asked_token == token);
            if asked || self.known.contains_key(&token) {
                continue;
            }
            match seen.snapshot.known_token_sign(token) {
                Some(known) => drop(self.known.insert(token, known)),
                None => {
                    let id = seen.request_work(recordings_jobs::look_up_details_job(InspectedThing::Token(token)));
                    self.looking.insert(id, token);
                }
            }
        }
    }

    pub(super) fn receive_example_result(&mut self, id: WorkId, ended: &WorkResult) {
        let Some(token) = self.looking.remove(&id) else {
            return;
        };
        let mut token_facts = TokenSign::default();
        if let Ok(WorkOutcome::Looked(details)) = ended
            && let ObjectDetails::Token(it) = &**details
        {
            let span = it
                .row
                .start_us
                .zip(it.row.end_us)
                .map(|(start, end)| TimeSpan::from_span_micros(start, end));
            token_facts.gloss.clone_from(&it.row.gloss);
            token_facts.place = it.row.recording_id.zip(span);
        }
        self.known.insert(token, token_facts);
    }

    /// Returns the sign of an example, once it has been looked up.
    pub(super) fn find_known_example(&self, example: &ExampleToken, seen: &PaneInput<'_>) -> Option<TokenSign> {
        match example {
            ExampleToken::Token(number) => self.known.get(&number.parse().ok()?).cloned(),
            ExampleToken::Sign(gloss) => {
                let signs = &seen.snapshot.overview.signs;
                let position = signs.binary_search_by(|sign| sign.gloss.as_str().cmp(gloss));
                Some(TokenSign {
                    gloss: gloss.clone(),
                    place: position.ok().and_then(|at| signs[at].place),
                })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tokens_named_in_a_query_are_looked_up() {
        assert_eq!(find_example_tokens("like token:41 on placement gloss=A"), [41]);
        assert!(find_example_tokens("like CHAT").is_empty());
        assert!(find_example_tokens("token:").is_empty());
    }
}
