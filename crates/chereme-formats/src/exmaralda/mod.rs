//! Basic transcriptions of EXMARaLDA's Partitur Editor, `.exb`.
//!
//! [`read_exmaralda`] turns a timeline, and tiers of events between its points, into an
//! [`AnnotationTranscript`]: each tier keeps its name, its category is the tier type, its speaker the participant. Points
//! without a time lie evenly between their neighbours.

mod exmaralda_convert;
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
    EXMARALDA_TOOL.read_markup_file(bytes, exmaralda_convert::exmaralda_contents, |root, findings| {
        Ok(exmaralda_convert::transcript_from_exmaralda(root, findings))
    })
}
