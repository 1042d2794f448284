//! SiGML: signs as notation in XML, `.sigml`.
//!
//! [`raw`] mirrors the file, [`convert`] interprets it: notated signs, each the tree of
//! [`chereme_sign::hamnosys`] with its gloss and the non-manual tiers. A file holds signs in gestural
//! SiGML (`hamgestural_sign`, the tree as elements), in H-SiGML (`hns_sign`, HamNoSys's symbols as
//! elements), or both.
//!
//! ```
//! let text = br#"<sigml><hamgestural_sign gloss="TWO"><sign_manual>
//!   <handconfig handshape="finger23spread"/><handconfig extfidir="u"/><handconfig palmor="u"/>
//! </sign_manual></hamgestural_sign></sigml>"#;
//! let (signs, findings) = chereme_formats::sigml::read(text)?;
//! assert!(findings.is_empty());
//! let again = chereme_formats::sigml::write_gestural(signs.iter().map(|entry| &entry.sign));
//! assert_eq!(chereme_formats::sigml::read(&again)?.0, signs);
//! # Ok::<(), chereme_formats::sigml::Error>(())
//! ```

mod error;
mod gestural;
mod node;
mod symbols;
mod words;

pub mod convert;
pub mod raw;

pub use convert::{SigmlSign, from_raw, to_gestural, to_symbols};
pub use error::Error;

use crate::finding::{Finding, Severity};
use crate::table::decode;
use crate::tally::Findings;
use chereme_sign::hamnosys::Notated;

/// Reads the signs of a SiGML document: [`raw::read`], then [`from_raw`]. UTF-16 with its mark is read,
/// too, and Latin-1 or Windows-1252 if the document declares it.
///
/// # Errors
/// The same as those of [`raw::read`] and [`from_raw`].
pub fn read(bytes: &[u8]) -> Result<(Vec<SigmlSign>, Vec<Finding>), Error> {
    let decoded = in_utf8(bytes);
    let (root, mut findings) = match &decoded {
        Some((text, _)) => raw::read(text.as_bytes())?,
        None => raw::read(bytes)?,
    };
    let (signs, more) = from_raw(&root)?;
    findings.extend(more);
    if let Some((_, reported)) = decoded {
        findings.splice(0..0, reported);
    }
    Ok((signs, findings))
}

/// Returns the text of a document in another encoding that it declares, with findings.
fn in_utf8(bytes: &[u8]) -> Option<(String, Vec<Finding>)> {
    const WESTERN: [&str; 5] = [
        "iso-8859-1",
        "iso-8859-15",
        "latin1",
        "windows-1252",
        "cp1252",
    ];
    if bytes.len() > raw::BYTES {
        return None;
    }
    let wide = bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff");
    let declared = || {
        let head = String::from_utf8_lossy(&bytes[..bytes.len().min(200)]).to_ascii_lowercase();
        let declaration = head.split("?>").next().unwrap_or_default();
        let said = declaration.starts_with("<?xml")
            && WESTERN.iter().any(|name| {
                [format!("\"{name}\""), format!("'{name}'")]
                    .iter()
                    .any(|quoted| declaration.contains(&**quoted))
            });
        said && !bytes.is_ascii() && str::from_utf8(bytes).is_err()
    };
    if !wide && !declared() {
        return None;
    }
    let mut findings = Findings::default();
    let text = decode(bytes, &mut findings).ok()?;
    // The encoding in the declaration is no longer true.
    let end = text.find("?>").filter(|_| text.starts_with("<?xml"));
    let (declaration, rest) = text.split_at(end.map_or(0, |end| end + 2));
    let lines = "\n".repeat(declaration.matches('\n').count());
    let reported = findings.finish().into_iter().map(|finding| Finding {
        message: finding
            .message
            .replace(", so accents may be wrong", ", as it says"),
        remedy: None,
        severity: Severity::Note,
        ..finding
    });
    Some((format!("{lines}{rest}"), reported.collect()))
}

/// Writes signs as gestural SiGML, so that they read back equal.
#[must_use]
pub fn write_gestural<'s>(signs: impl IntoIterator<Item = &'s Notated>) -> Vec<u8> {
    raw::write(&to_gestural(signs))
}

/// Writes signs as H-SiGML, symbol by symbol, and returns for each the parts that HamNoSys cannot express.
#[must_use]
pub fn write_symbols<'s>(
    signs: impl IntoIterator<Item = &'s Notated>,
) -> (Vec<u8>, Vec<Vec<String>>) {
    let (root, lost) = to_symbols(signs);
    (raw::write(&root), lost)
}
