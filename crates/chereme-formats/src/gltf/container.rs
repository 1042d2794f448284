//! The JSON and the buffers of a GLB or `.gltf`.

use super::error::Error;
use super::model::{Buffer, Document};

/// The most bytes of all buffers.
const MOST_BYTES: usize = 1 << 31;

/// Returns the JSON of a document and the binary chunk of a GLB.
pub(super) fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), Error> {
    let word = |at: usize| -> Option<usize> {
        let bytes = bytes.get(at..at + 4)?;
        Some(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]) as usize)
    };
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes, None));
    }
    if word(4) != Some(2) {
        return Err(Error::NoGltf);
    }
    let (mut json, mut binary) = (None, None);
    let mut at = 12;
    while let (Some(length), Some(kind)) = (word(at), bytes.get(at + 4..at + 8)) {
        let body = bytes.get(at + 8..).and_then(|rest| rest.get(..length));
        let body = body.ok_or(Error::Short("a chunk"))?;
        match kind {
            b"JSON" if json.is_none() => json = Some(body),
            b"BIN\0" if binary.is_none() => binary = Some(body),
            _ => {}
        }
        at += 8 + length;
    }
    let json = json.ok_or(Error::Short("its JSON"))?;
    Ok((json, Some(binary.unwrap_or_default())))
}

/// Returns the bytes of each buffer: the binary chunk, a `data:` address, or a file beside the document.
pub(super) fn buffers(
    document: &Document,
    binary: Option<&[u8]>,
    beside: &dyn Fn(&str) -> Option<Vec<u8>>,
) -> Result<Vec<Vec<u8>>, Error> {
    let mut total = 0_usize;
    let bytes = |(at, buffer): (usize, &Buffer)| {
        let bytes = match &buffer.uri {
            None => binary
                .filter(|_| at == 0)
                .map(<[u8]>::to_vec)
                .unwrap_or_default(),
            Some(uri) => match uri.strip_prefix("data:") {
                Some(data) => {
                    let (_, text) = data.split_once(";base64,").ok_or_else(|| elsewhere(uri))?;
                    base64(text).ok_or_else(|| elsewhere(uri))?
                }
                None if is_plain_name(uri) => {
                    beside(&unescaped(uri)).ok_or_else(|| elsewhere(uri))?
                }
                None => return Err(elsewhere(uri)),
            },
        };
        if bytes.len() < buffer.byte_length {
            return Err(Error::Short("a buffer"));
        }
        total = total.saturating_add(bytes.len());
        if total > MOST_BYTES {
            return Err(Error::element(
                "buffers",
                at,
                "makes more bytes than can be held",
            ));
        }
        Ok(bytes)
    };
    document.buffers.iter().enumerate().map(bytes).collect()
}

fn elsewhere(uri: &str) -> Error {
    Error::Elsewhere(uri.chars().take(60).collect())
}

/// Returns whether an address is a file inside the folder: no scheme, no step up, no root.
fn is_plain_name(uri: &str) -> bool {
    let name = unescaped(uri);
    let steps = || name.split(['/', '\\']);
    !name.contains(':') && steps().all(|step| !step.is_empty() && step != "." && step != "..")
}

/// Decodes `%20` and similar escapes.
fn unescaped(uri: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = uri.as_bytes();
    while let Some((first, after)) = rest.split_first() {
        let hex = after.get(..2).and_then(|two| std::str::from_utf8(two).ok());
        let byte = hex.and_then(|two| u8::from_str_radix(two, 16).ok());
        match (first, byte) {
            (b'%', Some(byte)) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            _ => {
                bytes.push(*first);
                rest = after;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Decodes base64 (RFC 4648, section 4); blanks are skipped.
pub(super) fn base64(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    let (mut word, mut bits) = (0u32, 0);
    for letter in text
        .bytes()
        .filter(|byte| !byte.is_ascii_whitespace() && *byte != b'=')
    {
        let six = match letter {
            b'A'..=b'Z' => letter - b'A',
            b'a'..=b'z' => letter - b'a' + 26,
            b'0'..=b'9' => letter - b'0' + 52,
            b'+' | b'-' => 62,
            b'/' | b'_' => 63,
            _ => return None,
        };
        word = (word << 6) | u32::from(six);
        bits += 6;
        if bits >= 8 {
            bits -= 8;
            bytes.push((word >> bits) as u8);
            word &= (1 << bits) - 1;
        }
    }
    Some(bytes)
}
