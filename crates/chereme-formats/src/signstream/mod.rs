//! Collections of SignStream in XML, as SignStream 2 and the NCSLGR corpus have them.
//!
//! [`read_signstream_file`] turns a coding scheme of fields, and utterances with tracks, into an [`AnnotationTranscript`]: each field becomes a tier, for each participant if there are several, and the utterances become one.

mod signstream_convert;
#[cfg(test)]
mod tests;

use crate::finding::ImportFinding;
use crate::markup::{MarkupError, MarkupTool};
use crate::transcript::AnnotationTranscript;

/// The name of the tier of utterances.
pub const UTTERANCE_TIER_NAME: &str = "utterance";

pub(crate) const SIGNSTREAM_TOOL: MarkupTool = MarkupTool {
    name: "SignStream",
    root: "SIGNSTREAM-DATABASE",
};

/// Reads a collection.
///
/// # Errors
/// [`MarkupError`] if the bytes are not text, no XML, cut short, declare entities, are no collection, or its utterances lie in
/// different films.
pub fn read_signstream_file(bytes: &[u8]) -> Result<(AnnotationTranscript, Vec<ImportFinding>), MarkupError> {
    SIGNSTREAM_TOOL.read_markup_file(
        bytes,
        signstream_convert::signstream_contents,
        signstream_convert::transcript_from_signstream,
    )
}
