//! ELAN's annotation files: `.eaf`, templates `.etf`, external vocabularies `.ecv`, preferences `.pfsx`.
//!
//! [`raw`] mirrors the file, [`convert`] interprets it: tiers, annotations with spans, and vocabularies. [`settings`]
//! reads how tiers are shown.
//!
//! ```
//! let text = br#"<ANNOTATION_DOCUMENT AUTHOR="" DATE="2024-01-01T00:00:00Z" VERSION="3.0">
//!   <TIME_ORDER><TIME_SLOT TIME_SLOT_ID="ts1" TIME_VALUE="0"/><TIME_SLOT TIME_SLOT_ID="ts2" TIME_VALUE="500"/></TIME_ORDER>
//!   <TIER TIER_ID="Gloss RH" LINGUISTIC_TYPE_REF="gloss"><ANNOTATION>
//!     <ALIGNABLE_ANNOTATION ANNOTATION_ID="a1" TIME_SLOT_REF1="ts1" TIME_SLOT_REF2="ts2">
//!       <ANNOTATION_VALUE>CHIEN</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION></TIER>
//!   <LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="gloss" TIME_ALIGNABLE="true"/>
//! </ANNOTATION_DOCUMENT>"#;
//! let (transcript, findings) = chereme_formats::eaf::read(text)?;
//! assert_eq!(transcript.tiers[0].annotations[0].value, "CHIEN");
//! assert!(findings.is_empty());
//! # Ok::<(), chereme_formats::eaf::Error>(())
//! ```

mod back;
mod check;
mod encoding;
mod error;
mod fields;
mod layout;
mod model;
mod output;
mod patch;
mod read;
mod style;
mod write;
pub(crate) mod xml;

pub mod convert;
pub mod raw;
pub mod settings;

pub use convert::{Transcript, from_raw, to_raw};
pub use encoding::{Decoded, decode};
pub use error::Error;
pub use patch::{patched, same_meaning};

use crate::finding::Finding;

/// Reads the vocabularies of an `.ecv` file.
///
/// # Errors
/// The same as [`raw::read_ecv`]'s.
pub fn read_vocabularies(bytes: &[u8]) -> Result<(Vec<convert::Vocabulary>, Vec<Finding>), Error> {
    let (document, findings) = raw::read_ecv(bytes)?;
    Ok((convert::vocabularies(&document), findings))
}

/// Reads an EAF document as a transcript: [`decode`], [`raw::read`], then [`from_raw`].
///
/// # Errors
/// The same as those of [`decode`] and [`raw::read`].
pub fn read(bytes: &[u8]) -> Result<(Transcript, Vec<Finding>), Error> {
    let decoded = decode(bytes)?;
    let (document, more) = raw::read(decoded.text.as_bytes())?;
    let mut findings = decoded.findings;
    findings.extend(more);
    let (transcript, more) = from_raw(&document);
    findings.extend(more);
    Ok((transcript, findings))
}
