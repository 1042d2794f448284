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
    AllQuery, BooleanQuery, ExistsQuery, FuzzyTermQuery, Occur, PhraseQuery, Query, RangeQuery, RegexPhraseQuery,
};
use tantivy::schema::Field;
use tantivy::{DocId, Score, Searcher, SegmentOrdinal, SegmentReader, TantivyError, Term};

use super::IndexFields;
use super::any_term::AnyTerm;
use crate::error::CorpusResult;
use crate::search::docs::DocumentList;
use crate::search::probe::{
    DocumentIndex, FacetCounts, IndexDocument, IndexProbe, IndexTextField, NumberColumn, RowField,
};

/// The largest number of index words that one pattern inside a phrase may match.
const MOST_EXPANSIONS: u32 = 1 << 20;
/// The smallest number of documents for which values are counted in a table over all documents.
const MIN_TABLE_COUNT_DOCUMENTS: usize = 1000;

/// The index at one moment.
pub(crate) struct IndexReading<'a> {
    pub(super) searcher: Searcher,
    pub(super) fields: IndexFields,
    pub(super) labels: &'a RefCell<KnownLabels>,
}

/// Facet values of each segment in use.
pub(super) type KnownLabels = HashMap<SegmentId, Arc<SegmentLabels>>;

/// The facet values of a segment, by ordinal: the number of the field, and the value.
pub(super) struct SegmentLabels {
    fields: Vec<String>,
    values: Vec<(u32, String)>,
}

impl IndexFields {
    fn text_index_field(&self, field: IndexTextField) -> Field {
        match field {
            IndexTextField::Gloss => self.gloss,
            IndexTextField::Words => self.words,
            IndexTextField::Translation => self.translation,
            IndexTextField::Comment => self.comment,
            IndexTextField::Reading => self.reading,
        }
    }

    fn row_index_field(&self, field: RowField) -> Field {
        match field {
            RowField::Token => self.id,
            RowField::Sign => self.sign,
            RowField::Recording => self.recording,
            RowField::Signer => self.signer,
        }
    }

    fn time_index_field(&self, field: TimeField) -> Field {
        match field {
            TimeField::Duration => self.duration,
            TimeField::Start => self.start,
            TimeField::End => self.end,
        }
    }

    /// Converts a probe to a query of the engine; a conjunction becomes a single query.
    fn probe_to_query(&self, probe: &IndexProbe) -> Box<dyn Query> {
        match probe {
            IndexProbe::All => Box::new(AllQuery),
            IndexProbe::Terms(field, terms) => Box::new(AnyTerm::any_text_term(self.text_index_field(*field), terms)),
            IndexProbe::Rows(field, rows) => Box::new(AnyTerm::any_number_term(
                self.row_index_field(*field),
                rows.iter().copied(),
            )),
            IndexProbe::Has(field) => Box::new(ExistsQuery::new(row_name(*field).to_owned(), false)),
            IndexProbe::Between(field, least, most) => {
                let field = self.time_index_field(*field);
                let term = |bound: &Bound<i64>| bound.map(|micros| Term::from_field_i64(field, micros));
                Box::new(RangeQuery::new(term(least), term(most)))
            }
            IndexProbe::Phrase(field, words) => {
                let field = self.text_index_field(*field);
                let terms = words.iter().map(|word| Term::from_field_text(field, word));
                Box::new(PhraseQuery::new(terms.collect()))
            }
            IndexProbe::Patterns(field, words) => {
                let mut query = RegexPhraseQuery::new(self.text_index_field(*field), words.clone());
                query.set_max_expansions(MOST_EXPANSIONS);
                Box::new(query)
            }
            IndexProbe::Near(field, word, slips) => {
                let term = Term::from_field_text(self.text_index_field(*field), word);
                Box::new(FuzzyTermQuery::new(term, *slips, true))
            }
            IndexProbe::And(wanted, unwanted) => self.conjunction(wanted, unwanted),
            IndexProbe::Or(any) => {
                let queries = any.iter().map(|probe| self.probe_to_query(probe));
                Box::new(BooleanQuery::union(queries.collect()))
            }
        }
    }

    fn conjunction(&self, wanted: &[IndexProbe], unwanted: &[IndexProbe]) -> Box<dyn Query> {
        if let ([one], []) = (wanted, unwanted) {
            return self.probe_to_query(one);
        }
        let all = |probes: &[IndexProbe], occur: Occur| -> Vec<(Occur, Box<dyn Query>)> {
            let queries = probes.iter().map(|probe| (occur, self.probe_to_query(probe)));
            queries.collect()
        };
        let mut clauses = all(wanted, Occur::Must);
        // The engine finds nothing by a query that only excludes.
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

impl DocumentIndex for IndexReading<'_> {
    fn find_matching_documents(&self, probe: &IndexProbe) -> CorpusResult<DocumentList> {
        Ok(self
            .searcher
            .search(&*self.fields.probe_to_query(probe), &AllDocumentsCollector)?)
    }

    fn field_terms(
        &self,
        field: IndexTextField,
        prefix: &str,
        wanted: &dyn Fn(&str) -> bool,
    ) -> CorpusResult<BTreeSet<String>> {
        let mut matching_terms = BTreeSet::new();
        for segment in self.searcher.segment_readers() {
            let index = segment.inverted_index(self.fields.text_index_field(field))?;
            // Terms are sorted, so that those with the prefix follow each other.
            let stream_result = index.terms().range().ge(prefix.as_bytes()).into_stream();
            let mut stream = stream_result.map_err(TantivyError::from)?;
            while stream.advance() {
                let Ok(term) = std::str::from_utf8(stream.key()) else {
                    continue;
                };
                if !term.starts_with(prefix) {
                    break;
                }
                if wanted(term) {
                    matching_terms.insert(term.to_owned());
                }
            }
        }
        Ok(matching_terms)
    }

    fn open_row_column(&self, field: RowField) -> CorpusResult<Box<dyn NumberColumn>> {
        let segments = self.searcher.segment_readers().iter();
        let columns = segments.map(|segment| segment.fast_fields().u64(row_name(field)));
        let columns: Vec<Numbers<u64>> = columns.collect::<tantivy::Result<_>>()?;
        Ok(Box::new(DocumentRows(columns)))
    }

    fn open_time_column(&self, field: TimeField) -> CorpusResult<Box<dyn NumberColumn>> {
        let segments = self.searcher.segment_readers().iter();
        let columns = segments.map(|segment| segment.fast_fields().i64(time_name(field)));
        let columns: Vec<Numbers<i64>> = columns.collect::<tantivy::Result<_>>()?;
        Ok(Box::new(SegmentTimes(columns)))
    }

    fn count_index_facets(
        &self,
        docs: &[IndexDocument],
        go_on: &dyn Fn() -> CorpusResult<()>,
    ) -> CorpusResult<FacetCounts> {
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

impl IndexReading<'_> {
    /// Returns the values of the facets of a segment.
    fn labels_of(&self, segment: &SegmentReader) -> CorpusResult<Arc<SegmentLabels>> {
        let mut label_cache = self.labels.borrow_mut();
        if let Some(labels) = label_cache.get(&segment.segment_id()) {
            return Ok(labels.clone());
        }
        let labels = Arc::new(read_labels(segment)?);
        // Segments vanish when they are merged, and their labels with them.
        let live: BTreeSet<SegmentId> = self
            .searcher
            .segment_readers()
            .iter()
            .map(SegmentReader::segment_id)
            .collect();
        label_cache.retain(|id, _| live.contains(id));
        label_cache.insert(segment.segment_id(), labels.clone());
        Ok(labels)
    }
}

fn read_labels(segment: &SegmentReader) -> CorpusResult<SegmentLabels> {
    let mut labels = SegmentLabels {
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

fn count_ordinals(column: &StrColumn, docs: &[IndexDocument], labels: &SegmentLabels) -> Vec<(usize, usize)> {
    // A table of all values costs more than sorting the few values of few documents.
    if docs.len() < MIN_TABLE_COUNT_DOCUMENTS {
        let mut all: Vec<u64> = docs.iter().flat_map(|doc| column.term_ords(doc.number)).collect();
        all.sort_unstable();
        let equal = all.chunk_by(|a, b| a == b);
        return equal.map(|equal| (equal[0] as usize, equal.len())).collect();
    }
    let mut counts = vec![0; labels.values.len()];
    for doc in docs {
        for ordinal in column.term_ords(doc.number) {
            if let Some(count) = counts.get_mut(ordinal as usize) {
                *count += 1;
            }
        }
    }
    counts.into_iter().enumerate().filter(|(_, count)| *count > 0).collect()
}

/// The database row of each document in the index: one column of numbers for each segment of the index.
struct DocumentRows(Vec<Numbers<u64>>);

impl NumberColumn for DocumentRows {
    fn document_number(&self, doc: IndexDocument) -> Option<i64> {
        let number = self.0[doc.part as usize].first(doc.number);
        number.map(|row| row as i64)
    }
}

/// Times, by segment.
struct SegmentTimes(Vec<Numbers<i64>>);

impl NumberColumn for SegmentTimes {
    fn document_number(&self, doc: IndexDocument) -> Option<i64> {
        self.0[doc.part as usize].first(doc.number)
    }
}

/// Collects every matching document.
struct AllDocumentsCollector;

struct OfSegment {
    segment: SegmentOrdinal,
    docs: DocumentList,
}

impl Collector for AllDocumentsCollector {
    type Fruit = DocumentList;
    type Child = OfSegment;

    fn for_segment(&self, segment: SegmentOrdinal, _: &SegmentReader) -> tantivy::Result<OfSegment> {
        let docs = Vec::new();
        Ok(OfSegment { segment, docs })
    }

    fn requires_scoring(&self) -> bool {
        false
    }

    fn merge_fruits(&self, fruits: Vec<DocumentList>) -> tantivy::Result<DocumentList> {
        let mut fruits = fruits.into_iter();
        let first = fruits.next().unwrap_or_default();
        // Segments come in order, so that their documents stay sorted when they are joined.
        Ok(fruits.fold(first, |mut all, docs| {
            all.extend(docs);
            all
        }))
    }
}

impl SegmentCollector for OfSegment {
    type Fruit = DocumentList;

    fn collect(&mut self, number: DocId, _: Score) {
        let part = self.segment;
        self.docs.push(IndexDocument { part, number });
    }

    fn harvest(self) -> DocumentList {
        self.docs
    }
}
