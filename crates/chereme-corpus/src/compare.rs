//! Differences between annotation files and recordings, and merges of files.

use std::path::Path;

use chereme_formats::compare::{self, Conflict, Difference, Merged};
use chereme_formats::eaf::{self, Transcript, patched, raw, to_raw};
use chereme_formats::table::annotations;
use chereme_formats::{subtitles, textgrid};
use chereme_sign::Remedy;
use serde::Serialize;

use crate::Corpus;
use crate::address::{self, Address};
use crate::error::{Error, Result};
use crate::import::readers;

/// One side of a comparison.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CompareSide {
    /// The tiers of a recording.
    Recording(Address),
    /// An annotation file.
    File {
        /// Its name, for errors.
        name: String,
        /// Its bytes.
        bytes: Vec<u8>,
    },
}

/// The result of a merge of annotation files.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FileMerge {
    /// The merged file, in the format and layout of `mine`.
    #[serde(skip)]
    pub bytes: Vec<u8>,
    /// The differences between `mine` and the merged file.
    pub changes: Difference,
    /// Annotations that both changed in different ways. The merged file has that of `mine`; the other candidate is on a
    /// tier `NAME (theirs)`.
    pub conflicts: Vec<Conflict>,
}

/// The formats of annotation files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Eaf,
    TextGrid,
    Subtitles,
    /// A format that is read, known by the ending of the file's name.
    Other,
}

impl CompareSide {
    /// Returns the differences between two annotation files.
    ///
    /// # Errors
    /// Fails if one of them is a recording, for which [`Corpus::diff`] is needed, or cannot be read.
    pub fn diff(&self, other: &Self) -> Result<Difference> {
        let read = |side: &Self| match side {
            Self::File { name, bytes } => read(name, bytes).map(|it| it.0),
            Self::Recording(address) => Err(Error::wrong("a recording is in a corpus")
                .at(address.to_string())
                .advise(Remedy::command(
                    "name the corpus first: `chereme diff CORPUS recording:1 recording:2`",
                ))),
        };
        Ok(compare::diff(&read(self)?, &read(other)?))
    }
}

impl Corpus {
    /// Returns the differences between the tiers of two recordings, or of a recording and a file, by meaning.
    ///
    /// # Errors
    /// Fails if an address names no recording, or a file cannot be read.
    pub fn diff(&self, a: &CompareSide, b: &CompareSide) -> Result<Difference> {
        Ok(compare::diff(&self.document(a)?, &self.document(b)?))
    }

    fn document(&self, side: &CompareSide) -> Result<Transcript> {
        match side {
            CompareSide::File { name, bytes } => read(name, bytes).map(|it| it.0),
            CompareSide::Recording(address) => {
                let connection = self.store.read();
                let stretch = address::stretch(connection, address)?;
                crate::export::eaf::tiers_of(connection, &stretch.recording)
            }
        }
    }
}

/// Merges two annotation files; `base` is the file that both were copied from, if it is known.
///
/// # Errors
/// Fails if a file cannot be read, or the merged one cannot be written in the format of mine.
pub fn merge_files(
    base: Option<(&str, &[u8])>,
    mine: (&str, &[u8]),
    theirs: (&str, &[u8]),
) -> Result<FileMerge> {
    let (own, format) = read(mine.0, mine.1)?;
    let (other, _) = read(theirs.0, theirs.1)?;
    let merged = match base {
        Some((name, bytes)) => compare::merge(&read(name, bytes)?.0, &own, &other),
        None => compare::merge_two(&own, &other),
    };
    let whole = compare::with_candidates(&merged);
    let bytes = match format {
        Format::Eaf => write_eaf(mine.1, &whole)?,
        Format::TextGrid => {
            let (text, _) = textgrid::write(&whole, textgrid::Form::Long, whole.end());
            text.into_bytes()
        }
        Format::Other => {
            return Err(
                Error::wrong("a merged file cannot be written in the format of this one")
                    .at(mine.0)
                    .advise(Remedy::command(
                        "import it into a corpus, then the other with `chereme import CORPUS FILE --merge`",
                    )),
            );
        }
        Format::Subtitles => {
            return Err(
                Error::wrong("subtitles are not merged: their lines have no tiers")
                    .at(mine.0)
                    .advise("merge the .eaf or .TextGrid, and export subtitles from it"),
            );
        }
    };
    let Merged { conflicts, .. } = merged;
    Ok(FileMerge {
        bytes,
        changes: compare::diff(&own, &whole),
        conflicts,
    })
}

fn write_eaf(mine: &[u8], whole: &Transcript) -> Result<Vec<u8>> {
    let fault = |error: eaf::Error| Error::wrong(error.to_string());
    if let Some(bytes) = patched(mine, whole).map_err(fault)? {
        return Ok(bytes);
    }
    let decoded = eaf::decode(mine).map_err(fault)?;
    let (template, _) = raw::read(decoded.text.as_bytes()).map_err(fault)?;
    let mut bytes = Vec::new();
    raw::write(&to_raw(whole, &template), &mut bytes)
        .map_err(|error| Error::wrong(error.to_string()))?;
    Ok(bytes)
}

/// The number of bytes that are enough to see whether a table is one of annotations.
const TABLE_HEAD: usize = 1 << 14;

/// Reads a document. Its contents determine its format; the ending of its name does if they do not.
fn read(name: &str, bytes: &[u8]) -> Result<(Transcript, Format)> {
    let head = &bytes[..bytes.len().min(4096)];
    let plain: Vec<u8> = head.iter().copied().filter(|byte| *byte != 0).collect();
    let says = |word: &[u8]| plain.windows(word.len()).any(|it| it == word);
    let fault = |error: String| Error::wrong(error).at(name);
    if says(b"ooTextFile") || says(b"ooBinaryFile") {
        let (it, _) = textgrid::read(bytes).map_err(|error| fault(error.to_string()))?;
        return Ok((it, Format::TextGrid));
    }
    let table = &bytes[..bytes.len().min(TABLE_HEAD)];
    if !says(b"<?xml") && !says(b"<ANNOTATION_DOCUMENT") && annotations::is_export(table) {
        let (it, _) = annotations::transcript(bytes).map_err(|error| fault(error.to_string()))?;
        return Ok((it, Format::Other));
    }
    if says(b"-->") && !says(b"<?xml") {
        let (it, _) = subtitles::read(bytes).map_err(|error| fault(error.to_string()))?;
        return Ok((it, Format::Subtitles));
    }
    let by_name = readers::transcript(Path::new(name)).filter(|_| !says(b"<ANNOTATION_DOCUMENT"));
    if let Some(read) = by_name {
        return Ok((read(bytes).map_err(fault)?.0, Format::Other));
    }
    let (it, _) = eaf::read(bytes).map_err(|error| {
        fault(error.to_string()).advise(format!(
            "name annotation files: {}",
            readers::annotation_endings()
        ))
    })?;
    Ok((it, Format::Eaf))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_annotation_file_that_an_import_reads_is_compared() {
        let table = b"G\t\t00:00:01.000\t00:00:02.000\tCHAT --> <b>\nG\t\t00:00:03.000\t00:00:04.000\t\"x\n";
        let subtitles = b"1\n00:00:01,000 --> 00:00:02,000\nCHAT\n";
        let short = b"File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n0\n1\n<exists>\n1\n\"IntervalTier\"\n\"G\"\n0\n1\n1\n0\n1\n\"CHAT\"\n";
        let titled = b"Tier\tBegin Time - msec\tEnd Time - msec\tAnnotation\nG\t1\t2\tCHAT\n";
        for (name, bytes, rows) in [
            ("a.elan.txt", &table[..], 2),
            ("merge_file_1", &table[..], 2),
            ("a.tsv", &titled[..], 1),
            ("a.srt", &subtitles[..], 1),
            ("a.TextGrid", &short[..], 1),
        ] {
            let (found, _) = read(name, bytes).expect(name);
            let all: usize = found.tiers.iter().map(|it| it.annotations.len()).sum();
            assert_eq!(all, rows, "{name}");
        }
    }

    #[test]
    fn a_file_whose_contents_show_no_format_is_read_by_the_ending_of_its_name() {
        let message = |name: &str| {
            let error = read(name, b"neither").expect_err("no annotation file");
            error.to_string()
        };
        assert!(message("a.TextGrid").contains("TextGrid"));
        assert!(message("a.eaf").contains("EAF"));
        assert_eq!(
            message("merge_file_1"),
            message("a.eaf").replace("a.eaf", "merge_file_1")
        );
        let error = read("merge_file_1", b"neither").expect_err("no annotation file");
        let remedy = error.remedy().expect("a remedy").text().to_owned();
        assert!(remedy.contains(".eaf, .etf"), "{remedy}");
    }
}
