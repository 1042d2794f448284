//! Annotation files of ANVIL, `.anvil`.
//!
//! [`raw`] mirrors the file: tracks whose elements have attributes. [`read`] turns it into a [`Transcript`]. A track
//! becomes a tier that has its name, groups and all (`Gesture.Phase`). If its elements have one attribute, that is the
//! value; if they have several, or comments, the tier has one child tier for each (`Gesture.Phase.type`) and no values
//! of its own. Tracks relate as tiers do: a singleton is a Symbolic_Association below the track that it refers to, a
//! subdivision a Time_Subdivision; a span has the times of the elements that it covers, and no link. Points become
//! short annotations, as those of a TextGrid.

mod convert;
mod place;
pub mod raw;
#[cfg(test)]
mod tests;

use crate::eaf::Transcript;
use crate::finding::Finding;
use crate::markup::{Error, Tool};

/// The tier type of a tier that holds the elements of a track whose attributes have tiers of their own.
pub const ELEMENTS: &str = "ANVIL track";

pub(crate) const TOOL: Tool = Tool {
    name: "ANVIL",
    root: "annotation",
};

/// Reads an annotation file.
///
/// # Errors
/// [`Error`] if the bytes are not text, no XML, cut short, declare entities, or are no annotation file of ANVIL.
pub fn read(bytes: &[u8]) -> Result<(Transcript, Vec<Finding>), Error> {
    let (text, mut findings) = TOOL.decode(bytes)?;
    let (document, more) = raw::read(&text)?;
    findings.extend(more);
    let (transcript, more) = convert::from_raw(&document);
    findings.extend(more);
    Ok((transcript, findings))
}
