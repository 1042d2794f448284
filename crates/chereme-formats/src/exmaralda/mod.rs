//! Basic transcriptions of EXMARaLDA's Partitur Editor, `.exb`.
//!
//! [`exmaralda_raw`] mirrors the file: a timeline, and tiers of events between its points. [`read_exmaralda`] turns it into a
//! [`AnnotationTranscript`]: each tier keeps its name, its category is the tier type, its speaker the participant. Points
//! without a time lie evenly between their neighbours.

mod exmaralda_convert;
pub mod exmaralda_raw;
#[cfg(test)]
mod tests;

use crate::finding::ImportFinding;
use crate::markup::{MarkupError, MarkupTool};
use crate::transcript::AnnotationTranscript;

pub(crate) const EXMARALDA_TOOL: MarkupTool = MarkupTool {
    name: "EXMARaLDA",
    root: "basic-transcription",
};

/// Reads a basic transcription.
///
/// # Errors
/// [`MarkupError`] if the bytes are not text, no XML, cut short, declare entities, or are no basic transcription.
pub fn read_exmaralda(bytes: &[u8]) -> Result<(AnnotationTranscript, Vec<ImportFinding>), MarkupError> {
    let (text, mut findings) = EXMARALDA_TOOL.decode_markup_file(bytes)?;
    let (document, more) = exmaralda_raw::read_exmaralda_document(&text)?;
    findings.extend(more);
    let (transcript, more) = exmaralda_convert::transcript_from_exmaralda(&document);
    findings.extend(more);
    Ok((transcript, findings))
}
