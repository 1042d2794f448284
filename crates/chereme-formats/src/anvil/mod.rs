//! Annotation files of ANVIL, `.anvil`.
//!
//! [`read_anvil`] turns tracks, whose elements have attributes, into an [`AnnotationTranscript`]. A track
//! becomes a tier that has its name, groups and all (`Gesture.Phase`). If its elements have one attribute, that is the
//! value; if they have several, or comments, the tier has one child tier for each (`Gesture.Phase.type`) and no values
//! of its own. Tracks relate as tiers do: a singleton is a Symbolic_Association below the track that it refers to, a
//! subdivision a Time_Subdivision; a span has the times of the elements that it covers, and no link. Points become
//! short annotations, as those of a TextGrid.

mod anvil_convert;
mod anvil_place;
mod anvil_raw;
#[cfg(test)]
mod tests;

use crate::transcript::AnnotationTranscript;

use crate::finding::ImportFinding;
use crate::markup::{MarkupError, MarkupTool};
pub use crate::transcript::ELEMENT_TIER_TYPE;

pub(crate) const ANVIL_TOOL: MarkupTool = MarkupTool {
    name: "ANVIL",
    root: "annotation",
};

/// Reads an annotation file.
///
/// # Errors
/// [`MarkupError`] if the bytes are not text, no XML, cut short, declare entities, or are no annotation file of ANVIL.
pub fn read_anvil(bytes: &[u8]) -> Result<(AnnotationTranscript, Vec<ImportFinding>), MarkupError> {
    ANVIL_TOOL.read_markup_file(bytes, anvil_raw::anvil_contents, |root, findings| {
        let document = anvil_raw::AnvilDocument::from_anvil_root(root)?;
        Ok(anvil_convert::transcript_from_anvil(&document, findings))
    })
}
