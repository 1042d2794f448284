//! SiGML: signs as notation in XML, `.sigml`.
//!
//! [`sigml_raw`] mirrors the file, [`sigml_convert`] interprets it: notated signs, each the tree of
//! [`chereme_sign::hamnosys`] with its gloss and the non-manual tiers. A file holds signs in gestural
//! SiGML (`hamgestural_sign`, the tree as elements), in H-SiGML (`hns_sign`, HamNoSys's symbols as
//! elements), or both.
//!
//! ```
//! let text = br#"<sigml><hamgestural_sign gloss="TWO"><sign_manual>
//!   <handconfig handshape="finger23spread"/><handconfig extfidir="u"/><handconfig palmor="u"/>
//! </sign_manual></hamgestural_sign></sigml>"#;
//! let (signs, findings) = chereme_formats::sigml::read_sigml_signs(text)?;
//! assert!(findings.is_empty());
//! let again = chereme_formats::sigml::write_gestural(signs.iter().map(|entry| &entry.sign));
//! assert_eq!(chereme_formats::sigml::read_sigml_signs(&again)?.0, signs);
//! # Ok::<(), chereme_formats::sigml::SigmlError>(())
//! ```

mod error;
mod gestural;
mod node;
mod sigml_symbols;
mod sigml_words;

pub mod sigml_convert;
pub mod sigml_raw;

pub use error::SigmlError;
pub use sigml_convert::{SigmlSign, interpret_sigml_document, to_gestural, to_symbols};

use crate::finding::{FindingSeverity, ImportFinding};
use crate::table::decode_table_bytes;
use crate::tally::FindingTally;
use chereme_sign::hamnosys::NotatedSign;

/// Reads the signs of a SiGML document: [`sigml_raw::read_sigml_document`], then [`interpret_sigml_document`]. UTF-16 with its mark is read,
/// too, and Latin-1 or Windows-1252 if the document declares it.
///
/// # Errors
/// The same as those of [`sigml_raw::read_sigml_document`] and [`interpret_sigml_document`].
pub fn read_sigml_signs(bytes: &[u8]) -> Result<(Vec<SigmlSign>, Vec<ImportFinding>), SigmlError> {
    let decoded = in_utf8(bytes);
    let (root, mut findings) = match &decoded {
        Some((text, _)) => sigml_raw::read_sigml_document(text.as_bytes())?,
        None => sigml_raw::read_sigml_document(bytes)?,
    };
    let (signs, more) = interpret_sigml_document(&root)?;
    findings.extend(more);
    if let Some((_, reported)) = decoded {
        findings.splice(0..0, reported);
    }
    Ok((signs, findings))
}

/// Returns the text of a document in another encoding that it declares, with findings.
fn in_utf8(bytes: &[u8]) -> Option<(String, Vec<ImportFinding>)> {
    const WESTERN_XML_ENCODINGS: [&str; 5] = ["iso-8859-1", "iso-8859-15", "latin1", "windows-1252", "cp1252"];
    if bytes.len() > sigml_raw::MAX_SIGML_BYTES {
        return None;
    }
    let wide = bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff");
    let declared = || {
        let head = String::from_utf8_lossy(&bytes[..bytes.len().min(200)]).to_ascii_lowercase();
        let declaration = head.split("?>").next().unwrap_or_default();
        let is_western = declaration.starts_with("<?xml")
            && WESTERN_XML_ENCODINGS.iter().any(|name| {
                [format!("\"{name}\""), format!("'{name}'")]
                    .iter()
                    .any(|quoted| declaration.contains(&**quoted))
            });
        is_western && !bytes.is_ascii() && str::from_utf8(bytes).is_err()
    };
    if !wide && !declared() {
        return None;
    }
    let mut findings = FindingTally::default();
    let text = decode_table_bytes(bytes, &mut findings).ok()?;
    // The encoding in the declaration is no longer true.
    let end = text.find("?>").filter(|_| text.starts_with("<?xml"));
    let (declaration, rest) = text.split_at(end.map_or(0, |end| end + 2));
    let lines = "\n".repeat(declaration.matches('\n').count());
    let reported = findings
        .finish_finding_tally()
        .into_iter()
        .map(|finding| ImportFinding {
            message: finding.message.replace(", so accents may be wrong", ", as it says"),
            remedy: None,
            severity: FindingSeverity::Note,
            ..finding
        });
    Some((format!("{lines}{rest}"), reported.collect()))
}

/// Writes signs as gestural SiGML, so that they read back equal.
#[must_use]
pub fn write_gestural<'s>(signs: impl IntoIterator<Item = &'s NotatedSign>) -> Vec<u8> {
    sigml_raw::write_sigml_document(&to_gestural(signs))
}

/// Writes signs as H-SiGML, symbol by symbol, and returns for each the parts that HamNoSys cannot express.
#[must_use]
pub fn write_symbols<'s>(signs: impl IntoIterator<Item = &'s NotatedSign>) -> (Vec<u8>, Vec<Vec<String>>) {
    let (root, lost) = to_symbols(signs);
    (sigml_raw::write_sigml_document(&root), lost)
}
