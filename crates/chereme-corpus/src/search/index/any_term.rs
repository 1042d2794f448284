//! A query for the documents that contain any of several terms.

use std::sync::Arc;

use tantivy::query::{BitSetDocSet, ConstScorer, EmptyScorer, EnableScoring, Explanation, Query, Scorer, Weight};
use tantivy::schema::{Field, IndexRecordOption};
use tantivy::{BitSet, DocId, DocSet, Score, SegmentReader, TERMINATED, TantivyError, Term};

/// A query for the documents that contain any of these terms, all in one field, without scores.
///
/// A single term is read directly; several are collected in a bit set over the documents of the segment.
#[derive(Debug, Clone)]
pub(crate) struct AnyTerm {
    field: Field,
    terms: Arc<Vec<Term>>,
}

impl AnyTerm {
    /// Returns the query for terms of `field`.
    pub(crate) fn new(field: Field, terms: Vec<Term>) -> Self {
        Self {
            field,
            terms: Arc::new(terms),
        }
    }

    /// Returns the query for these texts.
    pub(crate) fn any_text_term<T: AsRef<str>>(field: Field, texts: impl IntoIterator<Item = T>) -> Self {
        let terms = texts.into_iter();
        Self::new(
            field,
            terms.map(|text| Term::from_field_text(field, text.as_ref())).collect(),
        )
    }

    /// Returns the query for these numbers.
    pub(crate) fn any_number_term(field: Field, numbers: impl IntoIterator<Item = i64>) -> Self {
        let terms = numbers.into_iter();
        Self::new(
            field,
            terms.map(|number| Term::from_field_u64(field, number as u64)).collect(),
        )
    }
}

impl Query for AnyTerm {
    fn weight(&self, _: EnableScoring<'_>) -> tantivy::Result<Box<dyn Weight>> {
        Ok(Box::new(self.clone()))
    }
}

impl Weight for AnyTerm {
    fn scorer(&self, reader: &SegmentReader, boost: Score) -> tantivy::Result<Box<dyn Scorer>> {
        let index = reader.inverted_index(self.field)?;
        let mut term_infos = Vec::new();
        for term in self.terms.iter() {
            term_infos.extend(index.get_term_info(term)?);
        }
        match &term_infos[..] {
            [] => Ok(Box::new(EmptyScorer)),
            [one] => {
                let docs = index.read_postings_from_terminfo(one, IndexRecordOption::Basic)?;
                Ok(Box::new(ConstScorer::new(docs, boost)))
            }
            several => {
                // A union of many postings is slow; bits of all documents are filled one list after another.
                let mut bits = BitSet::with_max_value(reader.max_doc());
                for term in several {
                    let option = IndexRecordOption::Basic;
                    let mut docs = index.read_block_postings_from_terminfo(term, option)?;
                    while !docs.docs().is_empty() {
                        for doc in docs.docs() {
                            bits.insert(*doc);
                        }
                        docs.advance();
                    }
                }
                Ok(Box::new(ConstScorer::new(BitSetDocSet::from(bits), boost)))
            }
        }
    }

    fn explain(&self, reader: &SegmentReader, doc: DocId) -> tantivy::Result<Explanation> {
        let mut scorer = self.scorer(reader, 1.0)?;
        let is_match = scorer.doc() != TERMINATED && scorer.doc() <= doc && scorer.seek(doc) == doc;
        if is_match {
            Ok(Explanation::new("AnyTerm", 1.0))
        } else {
            let message = format!("document {doc} does not match");
            Err(TantivyError::InvalidArgument(message))
        }
    }
}
