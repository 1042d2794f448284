//! Windows-1252, in which older programs write what is not Unicode.

/// The characters of the bytes 0x80 to 0x9F in Windows-1252; its other bytes are Latin-1.
pub(crate) const WINDOWS_1252_CHARS: [char; 32] = [
    '€', '\u{81}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{8d}', 'Ž', '\u{8f}', '\u{90}', '‘', '’',
    '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{9d}', 'ž', 'Ÿ',
];

/// Returns the character of a byte in Windows-1252.
pub(crate) fn decode_windows_byte(byte: u8) -> char {
    match byte {
        0x80..=0x9f => WINDOWS_1252_CHARS[usize::from(byte - 0x80)],
        _ => char::from(byte),
    }
}
