//! Collections of SignStream in XML, as SignStream 2 and the NCSLGR corpus have them.
//!
//! [`raw`] mirrors the file: a coding scheme of fields, and utterances with tracks. [`read`] turns it into a
//! [`Transcript`]: each field becomes a tier, for each participant if there are several, and the utterances become one.

mod convert;
pub mod raw;
#[cfg(test)]
mod tests;

use crate::eaf::Transcript;
use crate::finding::Finding;
use crate::markup::{Error, Tool};

/// The name of the tier of utterances.
pub const UTTERANCES: &str = "utterance";

pub(crate) const TOOL: Tool = Tool {
    name: "SignStream",
    root: "SIGNSTREAM-DATABASE",
};

/// Reads a collection.
///
/// # Errors
/// [`Error`] if the bytes are not text, no XML, cut short, declare entities, are no collection, or its utterances lie in
/// different films.
pub fn read(bytes: &[u8]) -> Result<(Transcript, Vec<Finding>), Error> {
    let (text, mut findings) = TOOL.decode(bytes)?;
    let (document, more) = raw::read(&text)?;
    findings.extend(more);
    let (transcript, more) = convert::from_raw(&document)?;
    findings.extend(more);
    Ok((transcript, findings))
}
