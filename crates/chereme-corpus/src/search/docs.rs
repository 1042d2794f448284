//! Ordered sets of documents, and their times.

use chereme_sign::query::TimeField;

use super::probe::{DocumentIndex, IndexDocument, NumberColumn, RowField};
use crate::error::CorpusResult;

/// Documents in order, without duplicates.
pub(crate) type DocumentList = Vec<IndexDocument>;

/// Returns what is in both.
pub(crate) fn intersect_documents(a: &[IndexDocument], b: &[IndexDocument]) -> DocumentList {
    let (few, many) = if a.len() < b.len() { (a, b) } else { (b, a) };
    let mut rest = many;
    let mut both = Vec::with_capacity(few.len());
    for doc in few {
        rest = &rest[leap(rest, *doc)..];
        if rest.first() == Some(doc) {
            both.push(*doc);
        }
    }
    both
}

/// Returns what is in `a` and not in `b`.
pub(crate) fn subtract_documents(a: &[IndexDocument], b: &[IndexDocument]) -> DocumentList {
    let mut rest = b;
    let mut left = Vec::with_capacity(a.len());
    for doc in a {
        rest = &rest[leap(rest, *doc)..];
        if rest.first() != Some(doc) {
            left.push(*doc);
        }
    }
    left
}

/// Returns what is in either.
pub(crate) fn unite_documents(mut a: DocumentList, b: DocumentList) -> DocumentList {
    if a.is_empty() {
        return b;
    }
    if !b.is_empty() {
        a.extend(b);
        a.sort_unstable();
        a.dedup();
    }
    a
}

/// Returns the number of documents at the start of `docs` before `doc`; it is usually small.
fn leap(docs: &[IndexDocument], doc: IndexDocument) -> usize {
    // Steps double until one goes too far, which is quick both for a near and for a far document.
    let mut reach = 1;
    while reach < docs.len() && docs[reach] < doc {
        reach *= 2;
    }
    let (from, to) = (reach / 2, docs.len().min(reach + 1));
    from + docs[from..to].partition_point(|other| *other < doc)
}

/// The times of documents.
pub(crate) struct DocumentTimes {
    recording: Box<dyn NumberColumn>,
    start: Box<dyn NumberColumn>,
    end: Box<dyn NumberColumn>,
}

impl DocumentTimes {
    /// Opens the fields.
    pub(crate) fn open_document_times(index: &dyn DocumentIndex) -> CorpusResult<Self> {
        Ok(Self {
            recording: index.open_row_column(RowField::Recording)?,
            start: index.open_time_column(TimeField::Start)?,
            end: index.open_time_column(TimeField::End)?,
        })
    }

    /// Returns recording, start and end of a token; a lexicon entry has none.
    pub(crate) fn document_times(&self, doc: IndexDocument) -> Option<(i64, i64, i64)> {
        let recording = self.recording.document_number(doc)?;
        Some((
            recording,
            self.start.document_number(doc)?,
            self.end.document_number(doc)?,
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn unions_intersections_and_differences_equal_those_of_plain_sets() {
        let set = |numbers: &[u32]| -> DocumentList {
            let docs = numbers.iter().map(|n| IndexDocument {
                part: n / 8,
                number: n % 8,
            });
            docs.collect()
        };
        let cases: [&[u32]; 6] = [
            &[],
            &[0],
            &[3, 4, 9],
            &[0, 1, 2, 3, 5, 8, 13, 21],
            &[13],
            &[4, 5, 6, 7, 8, 9, 10, 22],
        ];
        for a in cases {
            for b in cases {
                let (x, y): (BTreeSet<u32>, BTreeSet<u32>) = (a.iter().copied().collect(), b.iter().copied().collect());
                let of = |found: BTreeSet<u32>| set(&found.into_iter().collect::<Vec<_>>());
                assert_eq!(intersect_documents(&set(a), &set(b)), of(&x & &y));
                assert_eq!(subtract_documents(&set(a), &set(b)), of(&x - &y));
                assert_eq!(unite_documents(set(a), set(b)), of(&x | &y));
            }
        }
    }
}
