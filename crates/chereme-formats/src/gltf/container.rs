//! The JSON and the buffers of a GLB or `.gltf`.

use super::error::GltfError;
use super::gltf_model::{GltfBuffer, GltfDocument};

/// The most bytes of all buffers.
const MAX_BUFFER_BYTES: usize = 1 << 31;

/// Returns the JSON of a document and the binary chunk of a GLB.
pub(super) fn split_glb_chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), GltfError> {
    let word = |at: usize| -> Option<usize> {
        let bytes = bytes.get(at..at + 4)?;
        Some(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]) as usize)
    };
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes, None));
    }
    if word(4) != Some(2) {
        return Err(GltfError::NoGltf);
    }
    let (mut json, mut binary) = (None, None);
    let mut chunk_start = 12;
    while let (Some(length), Some(kind)) = (word(chunk_start), bytes.get(chunk_start + 4..chunk_start + 8)) {
        let chunk_body = bytes.get(chunk_start + 8..).and_then(|rest| rest.get(..length));
        let body = chunk_body.ok_or(GltfError::Short("a chunk"))?;
        match kind {
            b"JSON" if json.is_none() => json = Some(body),
            b"BIN\0" if binary.is_none() => binary = Some(body),
            _ => {}
        }
        chunk_start += 8 + length;
    }
    let json = json.ok_or(GltfError::Short("its JSON"))?;
    Ok((json, Some(binary.unwrap_or_default())))
}

/// Returns the bytes of each buffer: the binary chunk, a `data:` address, or a file beside the document.
pub(super) fn load_gltf_buffers(
    document: &GltfDocument,
    binary: Option<&[u8]>,
    beside: &dyn Fn(&str) -> Option<Vec<u8>>,
) -> Result<Vec<Vec<u8>>, GltfError> {
    let mut total = 0_usize;
    let bytes = |(at, buffer): (usize, &GltfBuffer)| {
        let bytes = match &buffer.uri {
            // Only the first buffer may stand for the binary chunk of a GLB.
            None => binary.filter(|_| at == 0).map(<[u8]>::to_vec).unwrap_or_default(),
            Some(uri) => match uri.strip_prefix("data:") {
                Some(data) => {
                    let (_, text) = data.split_once(";base64,").ok_or_else(|| external_file_error(uri))?;
                    decode_base64(text).ok_or_else(|| external_file_error(uri))?
                }
                // A document of strangers must not read files elsewhere.
                None if is_plain_name(uri) => beside(&unescaped(uri)).ok_or_else(|| external_file_error(uri))?,
                None => return Err(external_file_error(uri)),
            },
        };
        if bytes.len() < buffer.byte_length {
            return Err(GltfError::Short("a buffer"));
        }
        total = total.saturating_add(bytes.len());
        if total > MAX_BUFFER_BYTES {
            return Err(GltfError::gltf_element_error(
                "buffers",
                at,
                "makes more bytes than can be held",
            ));
        }
        Ok(bytes)
    };
    document.buffers.iter().enumerate().map(bytes).collect()
}

fn external_file_error(uri: &str) -> GltfError {
    GltfError::Elsewhere(uri.chars().take(60).collect())
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
pub(super) fn decode_base64(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    let (mut word, mut bits) = (0u32, 0);
    for letter in text.bytes().filter(|byte| !byte.is_ascii_whitespace() && *byte != b'=') {
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
