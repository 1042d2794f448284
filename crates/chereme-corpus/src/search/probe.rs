//! Requests to an index, and the interface that every index implements.
//!
//! Nothing here depends on how an index works: another engine is another implementation of [`Index`] in a folder of its
//! own, beside `index`. A [`Probe`] is passed as a whole, so that the engine can evaluate a conjunction at once.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Bound;

use chereme_sign::query::TimeField;

use super::docs::Docs;
use crate::error::Result;

/// A document of an index: the segment that contains it, and its number there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Doc {
    pub(crate) part: u32,
    pub(crate) number: u32,
}

/// A field of texts or terms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Text {
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
pub(crate) enum Probe {
    /// Every document.
    All,
    /// The field has any of these terms.
    Terms(Text, Vec<String>),
    /// The field holds any of these rows.
    Rows(RowField, Vec<i64>),
    /// The field holds a row.
    Has(RowField),
    /// The time in microseconds lies between these.
    Between(TimeField, Bound<i64>, Bound<i64>),
    /// The words are adjacent in this order.
    Phrase(Text, Vec<String>),
    /// Words that match these regular expressions are adjacent in this order.
    Patterns(Text, Vec<String>),
    /// A term differs from this one by at most this number of slips.
    Near(Text, String, u8),
    /// All of the first hold, and none of the second.
    And(Vec<Probe>, Vec<Probe>),
    /// Any of these holds.
    Or(Vec<Probe>),
}

impl Probe {
    /// Returns the probe for a reading or mark with any of these terms.
    pub(crate) fn readings<T: Into<String>>(terms: impl IntoIterator<Item = T>) -> Self {
        Self::Terms(Text::Reading, terms.into_iter().map(Into::into).collect())
    }

    /// Returns the probe for all documents that this one does not match.
    pub(crate) fn inverted(self) -> Self {
        Self::And(Vec::new(), vec![self])
    }
}

/// A column with one number for each document.
pub(crate) trait Column {
    /// Returns the number of a document, if it has one.
    fn get(&self, doc: Doc) -> Option<i64>;
}

/// How many documents have each value of each field.
pub(crate) type FacetCounts = BTreeMap<String, BTreeMap<String, usize>>;

/// An index over the documents of a corpus, at one moment.
pub(crate) trait Index {
    /// Returns the documents that match a probe.
    fn docs(&self, probe: &Probe) -> Result<Docs>;

    /// Returns the terms of a field that begin with `prefix` and for which `wanted` returns true, in order.
    fn terms(
        &self,
        field: Text,
        prefix: &str,
        wanted: &dyn Fn(&str) -> bool,
    ) -> Result<BTreeSet<String>>;

    /// Opens a column of row numbers.
    fn rows(&self, field: RowField) -> Result<Box<dyn Column>>;

    /// Opens a column of times.
    fn times(&self, field: TimeField) -> Result<Box<dyn Column>>;

    /// Counts the values of documents, which must be in order; `go_on` fails if the caller no longer wants an answer.
    fn facets(&self, docs: &[Doc], go_on: &dyn Fn() -> Result<()>) -> Result<FacetCounts>;
}
