//! Answers of the index to probes.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::ops::Bound;
use std::sync::Arc;

use chereme_sign::query::TimeField;
use tantivy::collector::{Collector, SegmentCollector};
use tantivy::columnar::{Column as Numbers, StrColumn};
use tantivy::index::SegmentId;
use tantivy::query::{
    AllQuery, BooleanQuery, ExistsQuery, FuzzyTermQuery, Occur, PhraseQuery, Query, RangeQuery,
    RegexPhraseQuery,
};
use tantivy::schema::Field;
use tantivy::{DocId, Score, Searcher, SegmentOrdinal, SegmentReader, TantivyError, Term};

use super::Fields;
use super::any_term::AnyTerm;
use crate::error::Result;
use crate::search::docs::Docs;
use crate::search::probe::{Column, Doc, FacetCounts, Index, Probe, RowField, Text};

/// The largest number of index words that one pattern inside a phrase may match.
const MOST_EXPANSIONS: u32 = 1 << 20;
/// The smallest number of documents for which values are counted in a table over all documents.
const MANY: usize = 1000;

/// The index at one moment.
pub(crate) struct Reading<'a> {
    pub(super) searcher: Searcher,
    pub(super) fields: Fields,
    pub(super) labels: &'a RefCell<KnownLabels>,
}

/// Facet values of each segment in use.
pub(super) type KnownLabels = HashMap<SegmentId, Arc<Labels>>;

/// The facet values of a segment, by ordinal: the number of the field, and the value.
pub(super) struct Labels {
    fields: Vec<String>,
    values: Vec<(u32, String)>,
}

impl Fields {
    fn text(&self, field: Text) -> Field {
        match field {
            Text::Gloss => self.gloss,
            Text::Words => self.words,
            Text::Translation => self.translation,
            Text::Comment => self.comment,
            Text::Reading => self.reading,
        }
    }

    fn row(&self, field: RowField) -> Field {
        match field {
            RowField::Token => self.id,
            RowField::Sign => self.sign,
            RowField::Recording => self.recording,
            RowField::Signer => self.signer,
        }
    }

    fn time(&self, field: TimeField) -> Field {
        match field {
            TimeField::Duration => self.duration,
            TimeField::Start => self.start,
            TimeField::End => self.end,
        }
    }

    /// Converts a probe to a query of the engine; a conjunction becomes a single query.
    fn query(&self, probe: &Probe) -> Box<dyn Query> {
        match probe {
            Probe::All => Box::new(AllQuery),
            Probe::Terms(field, terms) => Box::new(AnyTerm::texts(self.text(*field), terms)),
            Probe::Rows(field, rows) => {
                Box::new(AnyTerm::numbers(self.row(*field), rows.iter().copied()))
            }
            Probe::Has(field) => Box::new(ExistsQuery::new(row_name(*field).to_owned(), false)),
            Probe::Between(field, least, most) => {
                let field = self.time(*field);
                let term =
                    |bound: &Bound<i64>| bound.map(|micros| Term::from_field_i64(field, micros));
                Box::new(RangeQuery::new(term(least), term(most)))
            }
            Probe::Phrase(field, words) => {
                let field = self.text(*field);
                let terms = words.iter().map(|word| Term::from_field_text(field, word));
                Box::new(PhraseQuery::new(terms.collect()))
            }
            Probe::Patterns(field, words) => {
                let mut query = RegexPhraseQuery::new(self.text(*field), words.clone());
                query.set_max_expansions(MOST_EXPANSIONS);
                Box::new(query)
            }
            Probe::Near(field, word, slips) => {
                let term = Term::from_field_text(self.text(*field), word);
                Box::new(FuzzyTermQuery::new(term, *slips, true))
            }
            Probe::And(wanted, unwanted) => self.conjunction(wanted, unwanted),
            Probe::Or(any) => {
                let queries = any.iter().map(|probe| self.query(probe));
                Box::new(BooleanQuery::union(queries.collect()))
            }
        }
    }

    fn conjunction(&self, wanted: &[Probe], unwanted: &[Probe]) -> Box<dyn Query> {
        if let ([one], []) = (wanted, unwanted) {
            return self.query(one);
        }
        let all = |probes: &[Probe], occur: Occur| -> Vec<(Occur, Box<dyn Query>)> {
            let queries = probes.iter().map(|probe| (occur, self.query(probe)));
            queries.collect()
        };
        let mut clauses = all(wanted, Occur::Must);
        if clauses.is_empty() {
            clauses.push((Occur::Must, Box::new(AllQuery)));
        }
        clauses.extend(all(unwanted, Occur::MustNot));
        Box::new(BooleanQuery::new(clauses))
    }
}

fn row_name(field: RowField) -> &'static str {
    match field {
        RowField::Token => "id",
        RowField::Sign => "sign",
        RowField::Recording => "recording",
        RowField::Signer => "signer",
    }
}

fn time_name(field: TimeField) -> &'static str {
    match field {
        TimeField::Duration => "duration",
        TimeField::Start => "start",
        TimeField::End => "end",
    }
}

impl Index for Reading<'_> {
    fn docs(&self, probe: &Probe) -> Result<Docs> {
        Ok(self.searcher.search(&*self.fields.query(probe), &All)?)
    }

    fn terms(
        &self,
        field: Text,
        prefix: &str,
        wanted: &dyn Fn(&str) -> bool,
    ) -> Result<BTreeSet<String>> {
        let mut found = BTreeSet::new();
        for segment in self.searcher.segment_readers() {
            let index = segment.inverted_index(self.fields.text(field))?;
            let stream = index.terms().range().ge(prefix.as_bytes()).into_stream();
            let mut stream = stream.map_err(TantivyError::from)?;
            while stream.advance() {
                let Ok(term) = std::str::from_utf8(stream.key()) else {
                    continue;
                };
                if !term.starts_with(prefix) {
                    break;
                }
                if wanted(term) {
                    found.insert(term.to_owned());
                }
            }
        }
        Ok(found)
    }

    fn rows(&self, field: RowField) -> Result<Box<dyn Column>> {
        let columns = self.searcher.segment_readers().iter();
        let columns = columns.map(|segment| segment.fast_fields().u64(row_name(field)));
        let columns: Vec<Numbers<u64>> = columns.collect::<tantivy::Result<_>>()?;
        Ok(Box::new(Rows(columns)))
    }

    fn times(&self, field: TimeField) -> Result<Box<dyn Column>> {
        let columns = self.searcher.segment_readers().iter();
        let columns = columns.map(|segment| segment.fast_fields().i64(time_name(field)));
        let columns: Vec<Numbers<i64>> = columns.collect::<tantivy::Result<_>>()?;
        Ok(Box::new(Times(columns)))
    }

    fn facets(&self, docs: &[Doc], go_on: &dyn Fn() -> Result<()>) -> Result<FacetCounts> {
        let mut counts = FacetCounts::new();
        for docs in docs.chunk_by(|a, b| a.part == b.part) {
            let Some(first) = docs.first() else {
                continue;
            };
            let segment = self.searcher.segment_reader(first.part);
            let Some(column) = segment.fast_fields().str("facet")? else {
                continue;
            };
            go_on()?;
            let labels = self.labels_of(segment)?;
            for (ordinal, count) in count_ordinals(&column, docs, &labels) {
                let Some((field, value)) = labels.values.get(ordinal) else {
                    continue;
                };
                let field = labels.fields.get(*field as usize).cloned();
                let values = counts.entry(field.unwrap_or_default()).or_default();
                *values.entry(value.clone()).or_default() += count;
            }
        }
        Ok(counts)
    }
}

impl Reading<'_> {
    /// Returns the values of the facets of a segment.
    fn labels_of(&self, segment: &SegmentReader) -> Result<Arc<Labels>> {
        let mut known = self.labels.borrow_mut();
        if let Some(labels) = known.get(&segment.segment_id()) {
            return Ok(labels.clone());
        }
        let labels = Arc::new(read_labels(segment)?);
        let live: BTreeSet<SegmentId> = self
            .searcher
            .segment_readers()
            .iter()
            .map(SegmentReader::segment_id)
            .collect();
        known.retain(|id, _| live.contains(id));
        known.insert(segment.segment_id(), labels.clone());
        Ok(labels)
    }
}

fn read_labels(segment: &SegmentReader) -> Result<Labels> {
    let mut labels = Labels {
        fields: Vec::new(),
        values: Vec::new(),
    };
    let Some(column) = segment.fast_fields().str("facet")? else {
        return Ok(labels);
    };
    let mut numbers: BTreeMap<String, u32> = BTreeMap::new();
    let mut stream = column.dictionary().stream().map_err(TantivyError::from)?;
    while stream.advance() {
        let text = String::from_utf8_lossy(stream.key());
        let (field, value) = text.split_once('=').unwrap_or((&text, ""));
        let number = match numbers.get(field) {
            Some(number) => *number,
            None => {
                let number = labels.fields.len() as u32;
                labels.fields.push(field.to_owned());
                numbers.insert(field.to_owned(), number);
                number
            }
        };
        labels.values.push((number, value.to_owned()));
    }
    Ok(labels)
}

fn count_ordinals(column: &StrColumn, docs: &[Doc], labels: &Labels) -> Vec<(usize, usize)> {
    if docs.len() < MANY {
        let mut all: Vec<u64> = docs
            .iter()
            .flat_map(|doc| column.term_ords(doc.number))
            .collect();
        all.sort_unstable();
        let equal = all.chunk_by(|a, b| a == b);
        return equal
            .map(|equal| (equal[0] as usize, equal.len()))
            .collect();
    }
    let mut counts = vec![0; labels.values.len()];
    for doc in docs {
        for ordinal in column.term_ords(doc.number) {
            if let Some(count) = counts.get_mut(ordinal as usize) {
                *count += 1;
            }
        }
    }
    counts
        .into_iter()
        .enumerate()
        .filter(|(_, count)| *count > 0)
        .collect()
}

/// The database row of each document in the index: one column of numbers for each segment of the index.
struct Rows(Vec<Numbers<u64>>);

impl Column for Rows {
    fn get(&self, doc: Doc) -> Option<i64> {
        let number = self.0[doc.part as usize].first(doc.number);
        number.map(|row| row as i64)
    }
}

/// Times, by segment.
struct Times(Vec<Numbers<i64>>);

impl Column for Times {
    fn get(&self, doc: Doc) -> Option<i64> {
        self.0[doc.part as usize].first(doc.number)
    }
}

/// Collects every matching document.
struct All;

struct OfSegment {
    segment: SegmentOrdinal,
    docs: Docs,
}

impl Collector for All {
    type Fruit = Docs;
    type Child = OfSegment;

    fn for_segment(
        &self,
        segment: SegmentOrdinal,
        _: &SegmentReader,
    ) -> tantivy::Result<OfSegment> {
        let docs = Vec::new();
        Ok(OfSegment { segment, docs })
    }

    fn requires_scoring(&self) -> bool {
        false
    }

    fn merge_fruits(&self, fruits: Vec<Docs>) -> tantivy::Result<Docs> {
        let mut fruits = fruits.into_iter();
        let first = fruits.next().unwrap_or_default();
        Ok(fruits.fold(first, |mut all, docs| {
            all.extend(docs);
            all
        }))
    }
}

impl SegmentCollector for OfSegment {
    type Fruit = Docs;

    fn collect(&mut self, number: DocId, _: Score) {
        let part = self.segment;
        self.docs.push(Doc { part, number });
    }

    fn harvest(self) -> Docs {
        self.docs
    }
}
