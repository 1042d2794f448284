//! SiGML: signs as notation in XML, `.sigml`.
//!
//! [`raw`] mirrors the file, [`convert`] says what it means: notated signs, each the tree of
//! [`chereme_sign::hamnosys`] with its gloss and the non-manual tiers. A file holds signs in gestural
//! SiGML (`hamgestural_sign`, elements that say the tree), in H-SiGML (`hns_sign`, HamNoSys's symbols as
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

pub use convert::{Entry, from_raw, to_gestural, to_symbols};
pub use error::Error;

use crate::finding::Finding;
use chereme_sign::hamnosys::Notated;

/// Reads a SiGML document for what it means: [`raw::read`], then [`from_raw`].
///
/// # Errors
/// Those of the two.
pub fn read(bytes: &[u8]) -> Result<(Vec<Entry>, Vec<Finding>), Error> {
    let (root, mut findings) = raw::read(bytes)?;
    let (signs, more) = from_raw(&root)?;
    findings.extend(more);
    Ok((signs, findings))
}

/// Writes signs as gestural SiGML, so that they read back equal.
#[must_use]
pub fn write_gestural<'s>(signs: impl IntoIterator<Item = &'s Notated>) -> Vec<u8> {
    raw::write(&to_gestural(signs))
}

/// Writes signs as H-SiGML, symbol by symbol, and returns for each what HamNoSys does not say.
#[must_use]
pub fn write_symbols<'s>(
    signs: impl IntoIterator<Item = &'s Notated>,
) -> (Vec<u8>, Vec<Vec<String>>) {
    let (root, lost) = to_symbols(signs);
    (raw::write(&root), lost)
}
