//! The signs that a query names as examples by token: their glosses, and where they move.

use std::collections::BTreeMap;

use chereme_corpus::Details;
use chereme_motion::{Instant, Span};
use chereme_sign::query::Example;

use super::builder::{self, Condition};
use crate::context::{Outbox, PaneInput};
use crate::model::Known;
use crate::panes::inspector::Thing;
use crate::work::{Ended, Outcome, WorkId, recordings};

/// The known examples; others are looked up.
#[derive(Debug, Default)]
pub(super) struct Examples {
    known: BTreeMap<i64, Known>,
    looking: BTreeMap<WorkId, i64>,
}

/// Returns the tokens that a query names as examples.
fn tokens(query: &str) -> Vec<i64> {
    let Ok(query) = query.parse() else {
        return Vec::new();
    };
    let rows = builder::rows(&query).into_iter();
    let token = |row| match row {
        Condition::Like(Example::Token(number), ..) => number.parse().ok(),
        _ => None,
    };
    rows.filter_map(token).collect()
}

impl Examples {
    /// Looks up the unknown tokens of a query.
    pub(super) fn follow(&mut self, query: &str, seen: &PaneInput<'_>, out: &mut Outbox) {
        if !query.contains("token:") {
            return;
        }
        for token in tokens(query) {
            let asked = self.looking.values().any(|it| *it == token);
            if asked || self.known.contains_key(&token) {
                continue;
            }
            match seen.snapshot.token(token) {
                Some(known) => drop(self.known.insert(token, known)),
                None => {
                    let id = out.work(recordings::look(Thing::Token(token)));
                    self.looking.insert(id, token);
                }
            }
        }
    }

    pub(super) fn hear(&mut self, id: WorkId, ended: &Ended) {
        let Some(token) = self.looking.remove(&id) else {
            return;
        };
        let mut known = Known::default();
        if let Ok(Outcome::Looked(Details::Token(it))) = ended {
            let span = it.row.start_us.zip(it.row.end_us).map(|(start, end)| {
                Span::between(Instant::from_micros(start), Instant::from_micros(end))
            });
            known.gloss.clone_from(&it.row.gloss);
            known.place = it.row.recording_id.zip(span);
        }
        self.known.insert(token, known);
    }

    /// Returns the sign of an example, once it has been looked up.
    pub(super) fn get(&self, example: &Example, seen: &PaneInput<'_>) -> Option<Known> {
        match example {
            Example::Token(number) => self.known.get(&number.parse().ok()?).cloned(),
            Example::Sign(gloss) => {
                let signs = &seen.snapshot.overview.signs;
                let at = signs.binary_search_by(|it| it.gloss.as_str().cmp(gloss));
                Some(Known {
                    gloss: gloss.clone(),
                    place: at.ok().and_then(|at| signs[at].place),
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
        assert_eq!(tokens("like token:41 on placement gloss=A"), [41]);
        assert!(tokens("like CHAT").is_empty());
        assert!(tokens("token:").is_empty());
    }
}
