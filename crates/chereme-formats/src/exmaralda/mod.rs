//! Basic transcriptions of EXMARaLDA's Partitur Editor, `.exb`.
//!
//! [`raw`] mirrors the file: a timeline, and tiers of events between its points. [`read`] turns it into a
//! [`Transcript`]: each tier keeps its name, its category is the tier type, its speaker the participant. Points
//! without a time lie evenly between their neighbours.

mod convert;
pub mod raw;
#[cfg(test)]
mod tests;

use crate::eaf::Transcript;
use crate::finding::Finding;
use crate::markup::{Error, Tool};

pub(crate) const TOOL: Tool = Tool {
    name: "EXMARaLDA",
    root: "basic-transcription",
};

/// Reads a basic transcription.
///
/// # Errors
/// [`Error`] if the bytes are not text, no XML, cut short, declare entities, or are no basic transcription.
pub fn read(bytes: &[u8]) -> Result<(Transcript, Vec<Finding>), Error> {
    let (text, mut findings) = TOOL.decode(bytes)?;
    let (document, more) = raw::read(&text)?;
    findings.extend(more);
    let (transcript, more) = convert::from_raw(&document);
    findings.extend(more);
    Ok((transcript, findings))
}
