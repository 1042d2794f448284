//! Ordered sets of documents, and their times.

use chereme_sign::query::TimeField;

use super::probe::{Column, Doc, Index, RowField};
use crate::error::Result;

/// Documents in order, without duplicates.
pub(crate) type Docs = Vec<Doc>;

/// Returns what is in both.
pub(crate) fn intersection(a: &[Doc], b: &[Doc]) -> Docs {
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
pub(crate) fn difference(a: &[Doc], b: &[Doc]) -> Docs {
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

/// Returns the number of documents at the start of `docs` before `doc`; it is usually small.
fn leap(docs: &[Doc], doc: Doc) -> usize {
    let mut reach = 1;
    while reach < docs.len() && docs[reach] < doc {
        reach *= 2;
    }
    let (from, to) = (reach / 2, docs.len().min(reach + 1));
    from + docs[from..to].partition_point(|other| *other < doc)
}

/// The times of documents.
pub(crate) struct Times {
    recording: Box<dyn Column>,
    start: Box<dyn Column>,
    end: Box<dyn Column>,
}

impl Times {
    /// Opens the fields.
    pub(crate) fn open(index: &dyn Index) -> Result<Self> {
        Ok(Self {
            recording: index.rows(RowField::Recording)?,
            start: index.times(TimeField::Start)?,
            end: index.times(TimeField::End)?,
        })
    }

    /// Returns recording, start and end of a token; a lexicon entry has none.
    pub(crate) fn get(&self, doc: Doc) -> Option<(i64, i64, i64)> {
        let recording = self.recording.get(doc)?;
        Some((recording, self.start.get(doc)?, self.end.get(doc)?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn unions_intersections_and_differences_equal_those_of_plain_sets() {
        let set = |numbers: &[u32]| -> Docs {
            let docs = numbers.iter().map(|n| Doc {
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
