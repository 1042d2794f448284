//! ELAN's annotation files: `.eaf`, templates `.etf`, external vocabularies `.ecv`, preferences `.pfsx`.
//!
//! [`eaf_raw`] mirrors the file, [`eaf_convert`] interprets it: tiers, annotations with spans, and vocabularies. [`eaf_settings`]
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
//! let (transcript, findings) = chereme_formats::eaf::read_eaf(text)?;
//! assert_eq!(transcript.tiers[0].annotations[0].value, "CHIEN");
//! assert!(findings.is_empty());
//! # Ok::<(), chereme_formats::eaf::EafError>(())
//! ```

mod back;
mod eaf_check;
mod eaf_fields;
mod eaf_layout;
mod eaf_leaves;
mod eaf_output;
mod eaf_read;
mod eaf_write;
mod encoding;
mod error;
mod patch;
mod style;
pub(crate) mod xml;

pub mod eaf_convert;
pub mod eaf_raw;
pub mod eaf_settings;

pub use eaf_convert::{AnnotationTranscript, eaf_document_from_transcript, transcript_from_eaf};
pub use encoding::{DecodedEafText, decode_eaf};
pub use error::EafError;
pub use patch::{patch_eaf, same_meaning};

use crate::finding::ImportFinding;

/// Reads the vocabularies of an `.ecv` file.
///
/// # Errors
/// The same as [`eaf_raw::read_ecv`]'s.
pub fn read_vocabularies(
    bytes: &[u8],
) -> Result<(Vec<eaf_convert::ControlledVocabulary>, Vec<ImportFinding>), EafError> {
    let (document, findings) = eaf_raw::read_ecv(bytes)?;
    Ok((eaf_convert::document_vocabularies(&document), findings))
}

/// Reads an EAF document as a transcript: [`decode_eaf`], [`eaf_raw::read_eaf_document`], then [`transcript_from_eaf`].
///
/// # Errors
/// The same as those of [`decode_eaf`] and [`eaf_raw::read_eaf_document`].
pub fn read_eaf(bytes: &[u8]) -> Result<(AnnotationTranscript, Vec<ImportFinding>), EafError> {
    let decoded = decode_eaf(bytes)?;
    let (document, more) = eaf_raw::read_eaf_document(decoded.text.as_bytes())?;
    let mut findings = decoded.findings;
    findings.extend(more);
    let (transcript, more) = transcript_from_eaf(&document);
    findings.extend(more);
    Ok((transcript, findings))
}
