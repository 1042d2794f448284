//! Annotations of SPPAS, `.xra`: tiers, alternatives, and which tier follows which.
//!
//! [`read_xra`] turns a file of any version from 1.1 to 1.5 into an [`AnnotationTranscript`]: the
//! labels of an annotation stand on lines of their own, alternatives of a label in braces (`{l|l-@}`), and a tier of
//! points has the kind [`POINT_TIER_KIND`](crate::transcript::POINT_TIER_KIND). [`write_xra`] undoes this, and writes
//! keys of cued speech as SPPAS does, as two labels: the shape, and the letter of the placement.

mod xra_convert;
mod xra_write;

#[cfg(test)]
mod tests;

use crate::finding::ImportFinding;
use crate::markup::{MarkupError, MarkupTool};
use crate::transcript::AnnotationTranscript;

pub use xra_write::write_xra;

pub(crate) const SPPAS_TOOL: MarkupTool = MarkupTool {
    name: "SPPAS",
    root: "Document",
};

/// The metadata of a tier that SPPAS has no other place for.
const PARTICIPANT_KEY: &str = "participant";
const ANNOTATOR_KEY: &str = "annotator";
const LANGUAGE_KEY: &str = "tier_language";
const TIER_TYPE_KEY: &str = "tier_type";
const PARENT_TIER_KEY: &str = "parent_tier";
const STEREOTYPE_KEY: &str = "tier_stereotype";

/// Reads a document of SPPAS.
///
/// # Errors
/// [`MarkupError`] if the bytes are not text, no XML, cut short, declare entities, or are no document of SPPAS.
pub fn read_xra(bytes: &[u8]) -> Result<(AnnotationTranscript, Vec<ImportFinding>), MarkupError> {
    SPPAS_TOOL.read_markup_file(bytes, xra_convert::xra_contents, |root, findings| {
        Ok(xra_convert::transcript_from_xra(root, findings))
    })
}
