//! The index's knowledge of itself: the readings it holds, terms that fit a pattern, and the names and order of
//! things; kept from query to query while the rows stay as they are.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use chereme_sign::text::fold;
use chereme_sign::{Component, Reading};
use rusqlite::Connection;

use super::probe::{Index, Text};
use super::texts::Glob;
use super::vocabulary::Vocabulary;
use crate::db::search::answers::{self, Named};
use crate::db::search::terms;
use crate::error::Result;

/// Every reading of a component that the index holds.
#[derive(Default)]
pub(crate) struct KnownReadings {
    /// By part, and there by folded value; readings that are no value stand under their terms' text.
    pub(crate) parts: BTreeMap<Option<String>, BTreeMap<String, Vec<KnownReading>>>,
}

/// A reading with its terms.
pub(crate) struct KnownReading {
    pub(crate) reading: Reading,
    /// Code of the hand, code of the phase, term.
    pub(crate) terms: Vec<(char, String, String)>,
}

/// Signs in the order of their glosses.
pub(crate) struct Signs {
    /// Row, gloss, folded gloss, by folded gloss.
    pub(crate) rows: Vec<(i64, String, String)>,
    pub(crate) rank: HashMap<i64, u64>,
}

/// The memory between queries.
#[derive(Default)]
pub(crate) struct Memory {
    /// The state of the index that `readings` and `signs` belong to.
    indexed: i64,
    readings: BTreeMap<Component, Arc<KnownReadings>>,
    signs: Option<Arc<Signs>>,
    vocabulary: Option<((i64, u64), Arc<Vocabulary>)>,
}

impl Memory {
    /// Forgets what belongs to another state of the index than this.
    pub(crate) fn turn_to(&mut self, indexed: i64) {
        if self.indexed != indexed {
            self.indexed = indexed;
            self.readings.clear();
            self.signs = None;
        }
    }

    /// Returns the inventories of the corpus.
    pub(crate) fn vocabulary(&mut self, connection: &Connection) -> Result<Arc<Vocabulary>> {
        let versions = answers::versions(connection)?;
        if let Some((known, vocabulary)) = &self.vocabulary
            && *known == versions
        {
            return Ok(vocabulary.clone());
        }
        let vocabulary = Arc::new(Vocabulary::load(connection)?);
        self.vocabulary = Some((versions, vocabulary.clone()));
        Ok(vocabulary)
    }

    /// Returns the readings of a component that the index holds.
    pub(crate) fn readings(
        &mut self,
        index: &dyn Index,
        component: Component,
    ) -> Result<Arc<KnownReadings>> {
        if let Some(known) = self.readings.get(&component) {
            return Ok(known.clone());
        }
        let prefix = terms::component_prefix(component.name());
        let mut known = KnownReadings::default();
        for term in index.terms(Text::Reading, &prefix, &|_| true)? {
            let Some(parsed) = terms::parse(&term) else {
                continue;
            };
            let text = match &parsed.reading {
                Reading::Value(value) => fold(value),
                other => terms::text_of(other).to_owned(),
            };
            let values = known
                .parts
                .entry(parsed.part.map(str::to_owned))
                .or_default();
            let alike = values.entry(text).or_default();
            let (hand, phase) = (parsed.hand, parsed.phase.to_owned());
            match alike
                .iter_mut()
                .find(|known| known.reading == parsed.reading)
            {
                Some(known) => known.terms.push((hand, phase, term)),
                None => alike.push(KnownReading {
                    reading: parsed.reading,
                    terms: vec![(hand, phase, term)],
                }),
            }
        }
        let known = Arc::new(known);
        self.readings.insert(component, known.clone());
        Ok(known)
    }

    /// Returns the signs of the corpus.
    pub(crate) fn signs(&mut self, connection: &Connection) -> Result<Arc<Signs>> {
        if let Some(signs) = &self.signs {
            return Ok(signs.clone());
        }
        let names = answers::names(connection, Named::Sign)?.into_iter();
        let mut rows: Vec<(i64, String, String)> = names
            .map(|(id, gloss)| {
                let folded = fold(&gloss);
                (id, gloss, folded)
            })
            .collect();
        rows.sort_by(|a, b| (&a.2, &a.1).cmp(&(&b.2, &b.1)));
        let rank = rows.iter().zip(0..).map(|(row, rank)| (row.0, rank));
        let signs = Arc::new(Signs {
            rank: rank.collect(),
            rows,
        });
        self.signs = Some(signs.clone());
        Ok(signs)
    }
}

/// Returns the terms of a field that fit a pattern.
pub(crate) fn fitting(index: &dyn Index, field: Text, glob: &Glob) -> Result<Vec<String>> {
    if let Some(text) = glob.literal() {
        return Ok(vec![text.to_owned()]);
    }
    let found = index.terms(field, glob.prefix(), &|term| glob.matches(term))?;
    Ok(found.into_iter().collect())
}
