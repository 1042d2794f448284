//! Cache of facts about the index and the corpus: indexed readings, terms that match a pattern, and the names and order
//! of signs; valid from query to query while the rows stay the same.

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

/// All indexed readings of a component.
#[derive(Default)]
pub(crate) struct KnownReadings {
    /// By part and then by folded value; readings without a value are listed under the text of their terms.
    pub(crate) parts: BTreeMap<Option<String>, Values>,
}

/// Readings by folded value.
pub(crate) type Values = BTreeMap<String, Vec<KnownReading>>;

/// A reading with its terms.
pub(crate) struct KnownReading {
    pub(crate) reading: Reading,
    /// Hand code, phase code, and term.
    pub(crate) terms: Vec<(char, String, String)>,
}

/// Signs in the order of their glosses.
pub(crate) struct Signs {
    /// Row, gloss and folded gloss, ordered by folded gloss.
    pub(crate) rows: Vec<(i64, String, String)>,
    pub(crate) rank: HashMap<i64, u64>,
}

/// Cache shared by queries.
#[derive(Default)]
pub(crate) struct Memory {
    /// The state of the index for which `readings` and `signs` are valid.
    indexed: i64,
    readings: BTreeMap<Component, Arc<KnownReadings>>,
    signs: Option<Arc<Signs>>,
    vocabulary: Option<((i64, u64), Arc<Vocabulary>)>,
}

impl Memory {
    /// Discards data that belong to another state of the index than `indexed`.
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

    /// Returns the signs of the corpus in the order of their glosses; reads them once, then keeps them.
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

/// Returns the terms of a field that match a pattern.
pub(crate) fn fitting(index: &dyn Index, field: Text, glob: &Glob) -> Result<Vec<String>> {
    if let Some(text) = glob.literal() {
        return Ok(vec![text.to_owned()]);
    }
    let found = index.terms(field, glob.prefix(), &|term| glob.matches(term))?;
    Ok(found.into_iter().collect())
}
