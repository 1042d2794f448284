//! Cache of facts about the index and the corpus: indexed readings, terms that match a pattern, and the names and order
//! of signs; valid from query to query while the rows stay the same.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use chereme_sign::text::fold_text;
use chereme_sign::{ComponentReading, SignComponent};
use rusqlite::Connection;

use super::probe::{DocumentIndex, IndexTextField};
use super::search_texts::TextGlob;
use super::search_vocabulary::QueryVocabulary;
use crate::db::stored_search::search_answers::{self, NamedRowKind};
use crate::db::stored_search::search_terms;
use crate::error::CorpusResult;

/// All indexed readings of a component.
#[derive(Default)]
pub(crate) struct KnownReadings {
    /// By part and then by folded value; readings without a value are listed under the text of their terms.
    pub(crate) parts: BTreeMap<Option<String>, ReadingsByValue>,
}

/// Readings by folded value.
pub(crate) type ReadingsByValue = BTreeMap<String, Vec<KnownReading>>;

/// A reading with its terms.
pub(crate) struct KnownReading {
    pub(crate) reading: ComponentReading,
    /// Hand code, phase code, and term.
    pub(crate) terms: Vec<(char, String, String)>,
}

/// Signs in the order of their glosses.
pub(crate) struct KnownSigns {
    /// Row, gloss and folded gloss, ordered by folded gloss.
    pub(crate) rows: Vec<(i64, String, String)>,
    pub(crate) rank: HashMap<i64, u64>,
}

/// Cache shared by queries.
#[derive(Default)]
pub(crate) struct QueryMemory {
    /// The state of the index for which `readings` and `signs` are valid.
    indexed: i64,
    /// The readings of a component that count, or those with the opinions about it.
    readings: BTreeMap<(SignComponent, bool), Arc<KnownReadings>>,
    signs: Option<Arc<KnownSigns>>,
    vocabulary: Option<((i64, u64), Arc<QueryVocabulary>)>,
}

impl QueryMemory {
    /// Discards data that belong to another state of the index than `indexed`.
    pub(crate) fn turn_to_state(&mut self, indexed: i64) {
        if self.indexed != indexed {
            self.indexed = indexed;
            self.readings.clear();
            self.signs = None;
        }
    }

    /// Returns the inventories of the corpus.
    pub(crate) fn cached_vocabulary(&mut self, connection: &Connection) -> CorpusResult<Arc<QueryVocabulary>> {
        // Inventories are no part of the index, whose state does not show when they change.
        let versions = search_answers::database_versions(connection)?;
        if let Some((known, vocabulary)) = &self.vocabulary
            && *known == versions
        {
            return Ok(vocabulary.clone());
        }
        let vocabulary = Arc::new(QueryVocabulary::load_vocabulary(connection)?);
        self.vocabulary = Some((versions, vocabulary.clone()));
        Ok(vocabulary)
    }

    /// Returns the readings of a component that the index holds: those that count, and with `opinions` the others, too.
    pub(crate) fn cached_readings(
        &mut self,
        index: &dyn DocumentIndex,
        component: SignComponent,
        opinions: bool,
    ) -> CorpusResult<Arc<KnownReadings>> {
        if let Some(known) = self.readings.get(&(component, opinions)) {
            return Ok(known.clone());
        }
        let name = component.component_name();
        let prefix = search_terms::component_prefix(name);
        let mut terms = index.field_terms(IndexTextField::Reading, &prefix, &|_| true)?;
        if opinions {
            let prefix = search_terms::component_prefix(&search_terms::opinion_component(name));
            terms.extend(index.field_terms(IndexTextField::Reading, &prefix, &|_| true)?);
        }
        let mut readings = KnownReadings::default();
        for term in terms {
            let Some(parsed) = search_terms::parse_reading_term(&term) else {
                continue;
            };
            // The text of a missing value begins with a control letter, so that no value folds to it.
            let text = match &parsed.reading {
                ComponentReading::Value(value) => fold_text(value),
                other => search_terms::reading_term_text(other).to_owned(),
            };
            let values = readings.parts.entry(parsed.part.map(str::to_owned)).or_default();
            let alike = values.entry(text).or_default();
            let (hand, phase) = (parsed.hand, parsed.phase.to_owned());
            // Values that fold alike share an entry, and each spelling keeps its own reading.
            match alike.iter_mut().find(|known| known.reading == parsed.reading) {
                Some(known) => known.terms.push((hand, phase, term)),
                None => alike.push(KnownReading {
                    reading: parsed.reading,
                    terms: vec![(hand, phase, term)],
                }),
            }
        }
        let shared_readings = Arc::new(readings);
        self.readings.insert((component, opinions), shared_readings.clone());
        Ok(shared_readings)
    }

    /// Returns the signs of the corpus in the order of their glosses; reads them once, then keeps them.
    pub(crate) fn cached_signs(&mut self, connection: &Connection) -> CorpusResult<Arc<KnownSigns>> {
        if let Some(signs) = &self.signs {
            return Ok(signs.clone());
        }
        let names = search_answers::list_row_names(connection, NamedRowKind::Sign)?.into_iter();
        let mut rows: Vec<(i64, String, String)> = names
            .map(|(id, gloss)| {
                let folded = fold_text(&gloss);
                (id, gloss, folded)
            })
            .collect();
        rows.sort_by(|a, b| (&a.2, &a.1).cmp(&(&b.2, &b.1)));
        let rank = rows.iter().zip(0..).map(|(row, rank)| (row.0, rank));
        let signs = Arc::new(KnownSigns {
            rank: rank.collect(),
            rows,
        });
        self.signs = Some(signs.clone());
        Ok(signs)
    }
}

/// Returns the terms of a field that match a pattern.
pub(crate) fn terms_matching_glob(
    index: &dyn DocumentIndex,
    field: IndexTextField,
    glob: &TextGlob,
) -> CorpusResult<Vec<String>> {
    // A pattern without wildcards is a term itself; whether it exists shows when it is looked up.
    if let Some(text) = glob.literal_text() {
        return Ok(vec![text.to_owned()]);
    }
    let fitting_terms = index.field_terms(field, glob.literal_prefix(), &|term| glob.matches_whole_text(term))?;
    Ok(fitting_terms.into_iter().collect())
}
