//! The parts that readers of annotation files in XML share: ANVIL's, EXMARaLDA's and SignStream's.

mod error;
mod lanes;
mod names;
mod times;

use std::borrow::Cow;
use std::collections::BTreeMap;

use crate::eaf;
use crate::eaf::convert::{Annotation, Media, Timing};
use crate::eaf::xml::{Cursor, Tag};
use crate::finding::Finding;
use crate::tally::Findings;
use chereme_motion::{Instant, Span};

pub use error::Error;
pub(crate) use lanes::{LANES, Timed, lanes, split};
pub(crate) use names::Names;
pub(crate) use times::{micros, millis};

/// The program that writes a kind of file, and the root element of its files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Tool {
    pub(crate) name: &'static str,
    pub(crate) root: &'static str,
}

impl Tool {
    /// Returns the text of a file, with findings about its encoding.
    pub(crate) fn decode(self, bytes: &[u8]) -> Result<(Cow<'_, str>, Vec<Finding>), Error> {
        let decoded = eaf::decode(bytes).map_err(|error| Error::of(self, error))?;
        let mut findings = decoded.findings;
        // These files are not written again.
        findings.retain(|it| !it.message.contains("written so again"));
        Ok((decoded.text, findings))
    }

    /// Returns a cursor at the root element of a text, and the element.
    pub(crate) fn open(self, text: &str) -> Result<(Cursor<'_>, Tag<'_>), Error> {
        let at_root = || {
            let mut cursor = Cursor::new_with_type(text.as_bytes())?;
            let root = cursor.root(self.root)?;
            Ok((cursor, root))
        };
        at_root().map_err(|error| Error::of(self, error))
    }
}

/// Returns one attribute of an element.
pub(crate) fn attribute<'a>(
    cursor: &mut Cursor<'a>,
    tag: &Tag<'a>,
    wanted: &str,
) -> Result<Option<Cow<'a, str>>, eaf::Error> {
    let mut found = None;
    cursor.attributes(tag, |name, value| {
        if name == wanted && found.is_none() {
            found = Some(value);
        }
    })?;
    Ok(found)
}

/// Elements that a reader passed over, by name, with their number.
#[derive(Debug, Default)]
pub(crate) struct Unread(BTreeMap<String, u64>);

impl Unread {
    /// Counts an element.
    pub(crate) fn count(&mut self, name: &str) {
        let name: String = name.chars().take(40).collect();
        let full = self.0.len() >= 20 && !self.0.contains_key(&name);
        *self
            .0
            .entry(if full { "…".to_owned() } else { name })
            .or_default() += 1;
    }

    /// Reports the elements.
    pub(crate) fn report(self, findings: &mut Findings) {
        for (name, many) in self.0 {
            findings.push(Finding::warning(
                None,
                format!("elements <{name}> are not read and were left out: {many}"),
            ));
        }
    }
}

/// Returns a medium at this address; its type follows from the ending.
pub(crate) fn medium(url: &str) -> Media {
    let ending = url.rsplit('.').next().unwrap_or_default();
    let mime = match &*ending.to_ascii_lowercase() {
        "mp4" | "m4v" => "video/mp4",
        "mov" => "video/quicktime",
        "mpg" | "mpeg" => "video/mpeg",
        "webm" => "video/webm",
        "avi" => "video/x-msvideo",
        "mkv" => "video/x-matroska",
        "wav" => "audio/x-wav",
        "mp3" => "audio/mpeg",
        _ => "",
    };
    Media {
        url: url.to_owned(),
        mime_type: mime.to_owned(),
        ..Media::default()
    }
}

/// Returns the id of an annotation. It depends on the name of its tier and its start alone, so that it stays the same if
/// the file gets other annotations.
pub(crate) fn id(tier: &str, start: Instant) -> String {
    // FNV-1a, cut to 32 bits: ids that are the same get numbers.
    let hash = tier.bytes().fold(0x811c_9dc5_u32, |hash, byte| {
        (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193)
    });
    format!("i{hash:08x}.{}", start.micros())
}

/// Returns an annotation with a time of its own.
pub(crate) fn annotation(id: String, span: Span, value: &str) -> Annotation {
    Annotation {
        id,
        span,
        timing: Timing::Own,
        parent: None,
        order: 0,
        value: value.to_owned(),
        entry: None,
        language: None,
        external_ref: None,
        millis: None,
    }
}
