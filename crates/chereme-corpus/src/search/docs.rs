//! Sets of documents, in order, and their numbers.

use tantivy::collector::{Collector, SegmentCollector};
use tantivy::columnar::Column;
use tantivy::query::Query;
use tantivy::{DocAddress, DocId, Score, Searcher, SegmentOrdinal, SegmentReader};

use crate::error::Result;

/// Documents in order, none twice.
pub(crate) type Docs = Vec<DocAddress>;

/// Returns the documents that a query asks for.
pub(crate) fn run(searcher: &Searcher, query: &dyn Query) -> Result<Docs> {
    Ok(searcher.search(query, &All)?)
}

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

    fn collect(&mut self, doc: DocId, _: Score) {
        self.docs.push(DocAddress::new(self.segment, doc));
    }

    fn harvest(self) -> Docs {
        self.docs
    }
}

/// Returns what is in both.
pub(crate) fn intersection(a: &[DocAddress], b: &[DocAddress]) -> Docs {
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
pub(crate) fn difference(a: &[DocAddress], b: &[DocAddress]) -> Docs {
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
pub(crate) fn union(mut a: Docs, b: Docs) -> Docs {
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

/// Returns how many documents at the start of `docs` come before `doc`, most often few.
fn leap(docs: &[DocAddress], doc: DocAddress) -> usize {
    let mut reach = 1;
    while reach < docs.len() && docs[reach] < doc {
        reach *= 2;
    }
    let (from, to) = (reach / 2, docs.len().min(reach + 1));
    from + docs[from..to].partition_point(|other| *other < doc)
}

/// One number of each document, by segment.
pub(crate) struct Numbers<T: 'static>(Vec<Column<T>>);

impl Numbers<u64> {
    /// Opens a field of row numbers.
    pub(crate) fn rows(searcher: &Searcher, field: &str) -> Result<Self> {
        let columns = searcher.segment_readers().iter();
        let columns = columns.map(|segment| segment.fast_fields().u64(field));
        Ok(Self(columns.collect::<tantivy::Result<_>>()?))
    }

    /// Returns the row number of a document.
    pub(crate) fn get(&self, doc: DocAddress) -> Option<i64> {
        self.0[doc.segment_ord as usize]
            .first(doc.doc_id)
            .map(|row| row as i64)
    }
}

impl Numbers<i64> {
    /// Opens a field of times.
    pub(crate) fn times(searcher: &Searcher, field: &str) -> Result<Self> {
        let columns = searcher.segment_readers().iter();
        let columns = columns.map(|segment| segment.fast_fields().i64(field));
        Ok(Self(columns.collect::<tantivy::Result<_>>()?))
    }

    /// Returns the time of a document.
    pub(crate) fn get(&self, doc: DocAddress) -> Option<i64> {
        self.0[doc.segment_ord as usize].first(doc.doc_id)
    }
}

/// Where each document lies in time.
pub(crate) struct Times {
    recording: Numbers<u64>,
    start: Numbers<i64>,
    end: Numbers<i64>,
}

impl Times {
    /// Opens the fields.
    pub(crate) fn open(searcher: &Searcher) -> Result<Self> {
        Ok(Self {
            recording: Numbers::rows(searcher, "recording")?,
            start: Numbers::times(searcher, "start")?,
            end: Numbers::times(searcher, "end")?,
        })
    }

    /// Returns recording, start and end of a token; a lexicon entry has none.
    pub(crate) fn get(&self, doc: DocAddress) -> Option<(i64, i64, i64)> {
        let recording = self.recording.get(doc)?;
        Some((recording, self.start.get(doc)?, self.end.get(doc)?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn sets_behave_as_sets() {
        let set = |numbers: &[u32]| -> Docs {
            let docs = numbers.iter().map(|n| DocAddress::new(n / 8, n % 8));
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
                let (x, y): (BTreeSet<u32>, BTreeSet<u32>) =
                    (a.iter().copied().collect(), b.iter().copied().collect());
                let of = |found: BTreeSet<u32>| set(&found.into_iter().collect::<Vec<_>>());
                assert_eq!(intersection(&set(a), &set(b)), of(&x & &y));
                assert_eq!(difference(&set(a), &set(b)), of(&x - &y));
                assert_eq!(union(set(a), set(b)), of(&x | &y));
            }
        }
    }
}
