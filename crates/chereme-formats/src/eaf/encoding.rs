//! The characters of annotation files as bytes: UTF-8, UTF-16, and Windows-1252 if a file declares it.

use std::borrow::Cow;

use super::error::EafError;
use super::xml::{MAX_XML_BYTES, declared_encoding, line_at_byte};
use crate::finding::ImportFinding;
use crate::windows_1252::{WINDOWS_1252_CHARS, decode_windows_byte};

/// How the characters of a file are written as bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum EafEncoding {
    /// UTF-8, with or without a byte-order mark.
    Utf8 { mark: bool },
    /// UTF-16, its high bytes first or last.
    Utf16 { big: bool, mark: bool },
    /// Latin-1, or Windows-1252, which has signs where Latin-1 has control characters.
    Western,
}

/// The names under which a declaration announces [`Encoding::Western`].
const WESTERN_XML_NAMES: [&str; 6] = [
    "iso-8859-1",
    "iso8859-1",
    "iso_8859-1",
    "latin1",
    "windows-1252",
    "cp1252",
];
/// The names of UTF-16.
const UTF16_XML_NAMES: [&str; 4] = ["utf-16", "utf16", "utf-16le", "utf-16be"];

/// Returns whether the reader knows a declared encoding.
pub(super) fn is_known(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    ["utf-8", "us-ascii", "utf8"].contains(&&*name)
        || WESTERN_XML_NAMES.contains(&&*name)
        || UTF16_XML_NAMES.contains(&&*name)
}

/// The text of a file, and how to write it again.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DecodedEafText<'b> {
    /// The text, without a byte-order mark.
    pub text: Cow<'b, str>,
    /// Oddities of the encoding.
    pub findings: Vec<ImportFinding>,
    pub(super) encoding: EafEncoding,
}

/// Returns the text of an EAF file in UTF-8, UTF-16 (with or without its mark), or, if it declares so, Latin-1 or
/// Windows-1252.
///
/// # Errors
/// [`EafError`] if the bytes are in another encoding, or too many.
pub fn decode_eaf(bytes: &[u8]) -> Result<DecodedEafText<'_>, EafError> {
    if bytes.len() > MAX_XML_BYTES {
        return Err(EafError::Limit {
            line: 1,
            what: "the file has too many bytes",
            limit: MAX_XML_BYTES,
        });
    }
    if let Some((big, mark)) = detect_utf16_order(bytes) {
        return in_utf16(bytes, big, mark);
    }
    let declared_name = declared_encoding(bytes).map(|name| name.to_ascii_lowercase());
    let stated_encoding = declared_name.as_deref();
    let (mark, rest) = match bytes.strip_prefix(b"\xef\xbb\xbf") {
        Some(rest) => (true, rest),
        None => (false, bytes),
    };
    let is_western = stated_encoding.is_some_and(|name| WESTERN_XML_NAMES.contains(&name)) && !mark;
    let Ok(text) = str::from_utf8(rest) else {
        if !is_western {
            // The XML reader names the fault and its line.
            return Err(super::xml::decode_utf8_xml(bytes)
                .err()
                .unwrap_or(EafError::NotXml { line: 1 }));
        }
        let text: String = bytes.iter().map(|byte| decode_windows_byte(*byte)).collect();
        let name = if bytes.iter().any(|byte| (0x80..0xa0).contains(byte)) {
            "Windows-1252"
        } else {
            "Latin-1"
        };
        return Ok(DecodedEafText {
            text: text.into(),
            findings: vec![noted(name)],
            encoding: EafEncoding::Western,
        });
    };
    let mut findings = Vec::new();
    if let Some(other) =
        stated_encoding.filter(|name| WESTERN_XML_NAMES.contains(name) || UTF16_XML_NAMES.contains(name))
        && (!is_western || !text.is_ascii())
    {
        findings.push(ImportFinding::new_note_finding(
            1,
            format!("the file says that it is in {other}, and is in UTF-8; it was read as UTF-8"),
        ));
    }
    let encoding = if is_western && text.is_ascii() {
        EafEncoding::Western
    } else {
        EafEncoding::Utf8 { mark }
    };
    Ok(DecodedEafText {
        text: text.into(),
        findings,
        encoding,
    })
}

fn noted(name: &str) -> ImportFinding {
    ImportFinding::new_note_finding(None, format!("the text is in {name}; it is written so again"))
}

/// Returns the byte order of text in UTF-16, and whether a byte-order mark states it.
fn detect_utf16_order(bytes: &[u8]) -> Option<(bool, bool)> {
    match bytes {
        [0xff, 0xfe, 0, 0, ..] => None,
        [0xff, 0xfe, ..] => Some((false, true)),
        [0xfe, 0xff, ..] => Some((true, true)),
        [b'<', 0, next, 0, ..] if *next != 0 => Some((false, false)),
        [0, b'<', 0, next, ..] if *next != 0 => Some((true, false)),
        _ => None,
    }
}

fn in_utf16(bytes: &[u8], big: bool, mark: bool) -> Result<DecodedEafText<'_>, EafError> {
    let units = &bytes[if mark { 2 } else { 0 }..];
    let unit = |pair: &[u8]| {
        let pair = [pair[0], pair[1]];
        if big {
            u16::from_be_bytes(pair)
        } else {
            u16::from_le_bytes(pair)
        }
    };
    let mut text = String::with_capacity(units.len() / 2);
    let characters = char::decode_utf16(units.chunks_exact(2).map(unit));
    for character in characters {
        let Ok(character) = character else {
            return Err(broken_utf16_error(&text));
        };
        text.push(character);
    }
    if units.len() % 2 == 1 {
        return Err(broken_utf16_error(&text));
    }
    Ok(DecodedEafText {
        text: text.into(),
        findings: vec![noted("UTF-16")],
        encoding: EafEncoding::Utf16 { big, mark },
    })
}

fn broken_utf16_error(before: &str) -> EafError {
    EafError::Encoding {
        encoding: "UTF-16 with half a character".to_owned(),
        line: line_at_byte(before.as_bytes(), before.len()),
    }
}

impl EafEncoding {
    /// Returns the bytes of a text of XML; a character that the encoding lacks becomes its number, as `&#x2019;`.
    pub(super) fn encode_xml_text(self, text: &str) -> Vec<u8> {
        match self {
            Self::Utf8 { mark } => {
                let mark: &[u8] = if mark { b"\xef\xbb\xbf" } else { b"" };
                [mark, text.as_bytes()].concat()
            }
            Self::Utf16 { big, mark } => {
                let mark = mark.then_some(0xfeff);
                let units = mark.into_iter().chain(text.encode_utf16());
                let bytes = |unit: u16| {
                    if big { unit.to_be_bytes() } else { unit.to_le_bytes() }
                };
                units.flat_map(bytes).collect()
            }
            Self::Western => {
                let mut bytes = Vec::with_capacity(text.len());
                for character in text.chars() {
                    match windows_1252_byte(character) {
                        Some(byte) => bytes.push(byte),
                        None => {
                            // References of numbers are XML in any encoding.
                            let number = format!("&#x{:X};", u32::from(character));
                            bytes.extend(number.bytes());
                        }
                    }
                }
                bytes
            }
        }
    }
}

/// Returns the byte of a character in Windows-1252.
fn windows_1252_byte(character: char) -> Option<u8> {
    if let Some(at) = WINDOWS_1252_CHARS.iter().position(|candidate| *candidate == character) {
        return u8::try_from(0x80 + at).ok();
    }
    let byte = u8::try_from(u32::from(character)).ok()?;
    (!(0x80..0xa0).contains(&byte)).then_some(byte)
}
