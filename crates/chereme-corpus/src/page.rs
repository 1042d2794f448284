//! Common parts of the pages that the program writes: texts put into a page, and bytes as text.

use crate::map::escape_markup;

/// Returns a page with its parts, which stand in it as `@@NAME@@`. It is one pass, so that no text is taken for the
/// place of another part.
pub(crate) fn fill_page_parts(page: &str, parts: &[(&str, &str)]) -> String {
    let mut text = String::new();
    for (at, piece) in page.split("@@").enumerate() {
        // Every second piece stands between two marks, and only that can be a name.
        let part = parts.iter().find(|(name, _)| at % 2 == 1 && *name == piece);
        text.push_str(part.map_or(piece, |(_, part)| part));
    }
    text
}

/// Returns a text for a page, also within the quotes of an attribute.
pub(crate) fn quote_page_text(text: &str) -> String {
    escape_markup(text).replace('"', "&quot;")
}

/// Returns bytes in base64 (RFC 4648, section 4).
pub(crate) fn encode_base64(bytes: &[u8]) -> String {
    const BASE64_LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let mut bits = 0_u32;
        for at in 0..3 {
            bits = bits << 8 | u32::from(three.get(at).copied().unwrap_or(0));
        }
        for at in 0..4 {
            let letter = BASE64_LETTERS[(bits >> (18 - 6 * at) & 63) as usize];
            // Missing bytes are written as signs of equality, so that the length is divisible by four.
            text.push(if at <= three.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_agrees_with_the_vectors_of_rfc_4648() {
        let words = ["", "f", "fo", "foo", "foob", "fooba", "foobar"];
        let coded = ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"];
        for (word, coded) in words.iter().zip(coded) {
            assert_eq!(encode_base64(word.as_bytes()), coded);
        }
    }

    #[test]
    fn no_part_is_taken_for_the_place_of_another() {
        let page = fill_page_parts("<@@A@@|@@B@@>", &[("A", "@@B@@"), ("B", "b")]);
        assert_eq!(page, "<@@B@@|b>");
    }
}
