//! Differences between annotation files and recordings, and merges of files.

use std::path::Path;

use chereme_formats::compare::{self, MergeConflict, MergedTranscript, TranscriptDifference};
use chereme_formats::eaf::{self, AnnotationTranscript, eaf_document_from_transcript, eaf_raw, patch_eaf};
use chereme_formats::table::annotations;
use chereme_formats::{ImportFinding, subtitles, textgrid};
use serde::Serialize;

use crate::Corpus;
use crate::address::{self, CorpusAddress};
use crate::error::{CorpusError, CorpusResult};
use crate::import::readers;

/// One side of a comparison.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CompareSide {
    /// The tiers of a recording.
    Recording(CorpusAddress),
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
    pub changes: TranscriptDifference,
    /// Annotations that both changed in different ways. The merged file has that of `mine`; the other candidate is on a
    /// tier `NAME (theirs)`.
    pub conflicts: Vec<MergeConflict>,
}

/// The formats of annotation files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum AnnotationFileFormat {
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
    /// Fails if one of them is a recording, for which [`Corpus::diff_compare_sides`] is needed, or cannot be read.
    pub fn diff_annotation_files(&self, other: &Self) -> CorpusResult<TranscriptDifference> {
        let read = |side: &Self| match side {
            Self::File { name, bytes } => read_compared_document(name, bytes).map(|parsed| parsed.0),
            Self::Recording(address) => Err(CorpusError::from_wrong_message("a recording is in a corpus")
                .with_error_place(address.to_string())
                .with_command_advice("name the corpus first: `chereme diff CORPUS recording:1 recording:2`")),
        };
        Ok(compare::diff_transcripts(&read(self)?, &read(other)?))
    }
}

impl Corpus {
    /// Returns the differences between the tiers of two recordings, or of a recording and a file, by meaning.
    ///
    /// # Errors
    /// Fails if an address names no recording, or a file cannot be read.
    pub fn diff_compare_sides(&self, a: &CompareSide, b: &CompareSide) -> CorpusResult<TranscriptDifference> {
        Ok(compare::diff_transcripts(
            &self.load_side_transcript(a)?,
            &self.load_side_transcript(b)?,
        ))
    }

    fn load_side_transcript(&self, side: &CompareSide) -> CorpusResult<AnnotationTranscript> {
        match side {
            CompareSide::File { name, bytes } => read_compared_document(name, bytes).map(|parsed| parsed.0),
            CompareSide::Recording(address) => {
                let connection = self.store.read_connection();
                let stretch = address::find_addressed_stretch(connection, address)?;
                crate::export::export_eaf::tiers_of(connection, &stretch.recording)
            }
        }
    }
}

/// Merges two annotation files; `base` is the file that both were copied from, if it is known.
///
/// # Errors
/// Fails if a file cannot be read, or the merged one cannot be written in the format of mine.
pub fn merge_files(base: Option<(&str, &[u8])>, mine: (&str, &[u8]), theirs: (&str, &[u8])) -> CorpusResult<FileMerge> {
    let (own, format) = read_compared_document(mine.0, mine.1)?;
    let (other, _) = read_compared_document(theirs.0, theirs.1)?;
    let merged = match base {
        Some((name, bytes)) => compare::merge_transcripts(&read_compared_document(name, bytes)?.0, &own, &other),
        None => compare::merge_two(&own, &other),
    };
    let full_transcript = compare::with_candidates(&merged);
    let bytes = match format {
        AnnotationFileFormat::Eaf => write_eaf(mine.1, &full_transcript)?,
        AnnotationFileFormat::TextGrid => {
            let (text, _) = textgrid::write_textgrid(
                &full_transcript,
                textgrid::TextGridForm::Long,
                full_transcript.transcript_end(),
            );
            text.into_bytes()
        }
        AnnotationFileFormat::Other => {
            return Err(
                CorpusError::from_wrong_message("a merged file cannot be written in the format of this one")
                    .with_error_place(mine.0)
                    .with_command_advice(
                        "import it into a corpus, then the other with `chereme import CORPUS FILE --merge`",
                    ),
            );
        }
        AnnotationFileFormat::Subtitles => {
            return Err(
                CorpusError::from_wrong_message("subtitles are not merged: their lines have no tiers")
                    .with_error_place(mine.0)
                    .with_advice("merge the .eaf or .TextGrid, and export subtitles from it"),
            );
        }
    };
    let MergedTranscript { conflicts, .. } = merged;
    Ok(FileMerge {
        bytes,
        changes: compare::diff_transcripts(&own, &full_transcript),
        conflicts,
    })
}

fn write_eaf(mine: &[u8], whole: &AnnotationTranscript) -> CorpusResult<Vec<u8>> {
    let fault = |error: eaf::EafError| CorpusError::from_wrong_message(error.to_string());
    // A change in place keeps everything in the file that is not about annotations, byte by byte.
    if let Some(bytes) = patch_eaf(mine, whole).map_err(fault)? {
        return Ok(bytes);
    }
    let decoded = eaf::decode_eaf(mine).map_err(fault)?;
    // A file that cannot be changed in place gives its header and constraints to a new one.
    let (template, _) = eaf_raw::read_eaf_document(decoded.text.as_bytes()).map_err(fault)?;
    let mut bytes = Vec::new();
    eaf_raw::write_eaf_document(&eaf_document_from_transcript(whole, &template), &mut bytes)
        .map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    Ok(bytes)
}

/// The number of bytes that are enough to see whether a table is one of annotations.
const TABLE_HEAD: usize = 1 << 14;

/// Reads a document. Its contents determine its format; the ending of its name does if they do not.
fn read_compared_document(name: &str, bytes: &[u8]) -> CorpusResult<(AnnotationTranscript, AnnotationFileFormat)> {
    let (transcript, _, format) = read_annotation_document(name, bytes)?;
    Ok((transcript, format))
}

/// Reads an annotation file as [`read_compared_document`] does, with what is odd in it.
pub(crate) fn read_annotation_document(
    name: &str,
    bytes: &[u8],
) -> CorpusResult<(AnnotationTranscript, Vec<ImportFinding>, AnnotationFileFormat)> {
    let head = &bytes[..bytes.len().min(4096)];
    // Files in UTF-16 have a zero in each of these letters.
    let plain: Vec<u8> = head.iter().copied().filter(|byte| *byte != 0).collect();
    let says = |word: &[u8]| plain.windows(word.len()).any(|window| window == word);
    let fault = |error: String| CorpusError::from_wrong_message(error).with_error_place(name);
    if says(b"ooTextFile") || says(b"ooBinaryFile") {
        let (it, odd) = textgrid::read_textgrid_file(bytes).map_err(|error| fault(error.to_string()))?;
        return Ok((it, odd, AnnotationFileFormat::TextGrid));
    }
    let table = &bytes[..bytes.len().min(TABLE_HEAD)];
    // Text in an XML document may look like a table, so that its mark is looked for first.
    if !says(b"<?xml") && !says(b"<ANNOTATION_DOCUMENT") && annotations::is_export(table) {
        let (it, odd) = annotations::read_elan_table(bytes).map_err(|error| fault(error.to_string()))?;
        return Ok((it, odd, AnnotationFileFormat::Other));
    }
    if says(b"-->") && !says(b"<?xml") {
        let (it, odd) = subtitles::read_subtitles(bytes).map_err(|error| fault(error.to_string()))?;
        return Ok((it, odd, AnnotationFileFormat::Subtitles));
    }
    let by_name = readers::find_transcript_parser(Path::new(name)).filter(|_| !says(b"<ANNOTATION_DOCUMENT"));
    if let Some(read) = by_name {
        let (it, odd) = read(bytes).map_err(fault)?;
        return Ok((it, odd, AnnotationFileFormat::Other));
    }
    let (it, odd) = eaf::read_eaf(bytes).map_err(|error| {
        fault(error.to_string()).with_advice(format!("name annotation files: {}", readers::annotation_endings()))
    })?;
    Ok((it, odd, AnnotationFileFormat::Eaf))
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
            let (found, _) = read_compared_document(name, bytes).expect(name);
            let all: usize = found.tiers.iter().map(|it| it.annotations.len()).sum();
            assert_eq!(all, rows, "{name}");
        }
    }

    #[test]
    fn a_file_whose_contents_show_no_format_is_read_by_the_ending_of_its_name() {
        let message = |name: &str| {
            let error = read_compared_document(name, b"neither").expect_err("no annotation file");
            error.to_string()
        };
        assert!(message("a.TextGrid").contains("TextGrid"));
        assert!(message("a.eaf").contains("EAF"));
        assert_eq!(
            message("merge_file_1"),
            message("a.eaf").replace("a.eaf", "merge_file_1")
        );
        let error = read_compared_document("merge_file_1", b"neither").expect_err("no annotation file");
        let remedy = error.error_remedy().expect("a remedy").remedy_text().to_owned();
        assert!(remedy.contains(".eaf, .etf"), "{remedy}");
    }
}
