//! Requests to an index, and the interface that every index implements.
//!
//! Nothing here depends on how an index works: another engine is another implementation of [`DocumentIndex`] in a folder of its
//! own, beside `index`. A [`IndexProbe`] is passed as a whole, so that the engine can evaluate a conjunction at once.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Bound;

use chereme_sign::query::TimeField;

use super::docs::DocumentList;
use crate::error::CorpusResult;

/// A document of an index: the segment that contains it, and its number there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct IndexDocument {
    pub(crate) part: u32,
    pub(crate) number: u32,
}

/// A field of texts or terms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum IndexTextField {
    /// The whole gloss, folded.
    Gloss,
    /// Words of the gloss.
    Words,
    /// Words of translations.
    Translation,
    /// Words of remarks.
    Comment,
    /// [Terms](crate::db::search::terms) for coded values, and marks.
    Reading,
}

/// A field of row numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RowField {
    /// The token itself.
    Token,
    /// Its sign.
    Sign,
    /// Its recording; a lexicon entry has none.
    Recording,
    /// Its signer, if known.
    Signer,
}

/// A condition on documents.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum IndexProbe {
    /// Every document.
    All,
    /// The field has any of these terms.
    Terms(IndexTextField, Vec<String>),
    /// The field holds any of these rows.
    Rows(RowField, Vec<i64>),
    /// The field holds a row.
    Has(RowField),
    /// The time in microseconds lies between these.
    Between(TimeField, Bound<i64>, Bound<i64>),
    /// The words are adjacent in this order.
    Phrase(IndexTextField, Vec<String>),
    /// Words that match these regular expressions are adjacent in this order.
    Patterns(IndexTextField, Vec<String>),
    /// A term differs from this one by at most this number of slips.
    Near(IndexTextField, String, u8),
    /// All of the first hold, and none of the second.
    And(Vec<IndexProbe>, Vec<IndexProbe>),
    /// Any of these holds.
    Or(Vec<IndexProbe>),
}

impl IndexProbe {
    /// Returns the probe for a reading or mark with any of these terms.
    pub(crate) fn from_reading_terms<T: Into<String>>(terms: impl IntoIterator<Item = T>) -> Self {
        Self::Terms(IndexTextField::Reading, terms.into_iter().map(Into::into).collect())
    }

    /// Returns the probe for all documents that this one does not match.
    pub(crate) fn invert_probe(self) -> Self {
        Self::And(Vec::new(), vec![self])
    }
}

/// A column with one number for each document.
pub(crate) trait NumberColumn {
    /// Returns the number of a document, if it has one.
    fn document_number(&self, doc: IndexDocument) -> Option<i64>;
}

/// How many documents have each value of each field.
pub(crate) type FacetCounts = BTreeMap<String, BTreeMap<String, usize>>;

/// An index over the documents of a corpus, at one moment.
pub(crate) trait DocumentIndex {
    /// Returns the documents that match a probe.
    fn find_matching_documents(&self, probe: &IndexProbe) -> CorpusResult<DocumentList>;

    /// Returns the terms of a field that begin with `prefix` and for which `wanted` returns true, in order.
    fn field_terms(
        &self,
        field: IndexTextField,
        prefix: &str,
        wanted: &dyn Fn(&str) -> bool,
    ) -> CorpusResult<BTreeSet<String>>;

    /// Opens a column of row numbers.
    fn open_row_column(&self, field: RowField) -> CorpusResult<Box<dyn NumberColumn>>;

    /// Opens a column of times.
    fn open_time_column(&self, field: TimeField) -> CorpusResult<Box<dyn NumberColumn>>;

    /// Counts the values of documents, which must be in order; `go_on` fails if the caller no longer wants an answer.
    fn count_index_facets(
        &self,
        docs: &[IndexDocument],
        go_on: &dyn Fn() -> CorpusResult<()>,
    ) -> CorpusResult<FacetCounts>;
}
