//! A buffered source of bytes that counts lines.

use std::io::Read;

use super::{BvhError, BvhErrorKind};

/// Bytes in the buffer.
const SOURCE_CHUNK_BYTES: usize = 256 * 1024;
/// The longest token or name.
pub(super) const TOKEN_LIMIT: usize = 1024;

/// A stream of bytes with a window onto it.
pub(super) struct ByteSource<R> {
    read: R,
    buffer: Vec<u8>,
    /// The next byte in the buffer.
    at: usize,
    end: usize,
    ended: bool,
    read_before: u64,
    line: u64,
    after_return: bool,
    /// The first line that ends with CR LF.
    pub(super) cr_lf: Option<u64>,
    /// The first line that ends with CR alone.
    pub(super) cr: Option<u64>,
}

impl<R: Read> ByteSource<R> {
    pub(super) fn new(read: R) -> Self {
        Self {
            read,
            buffer: vec![0; SOURCE_CHUNK_BYTES],
            at: 0,
            end: 0,
            ended: false,
            read_before: 0,
            line: 1,
            after_return: false,
            cr_lf: None,
            cr: None,
        }
    }

    /// Returns the line of the next byte, counted from 1.
    pub(super) fn byte_source_line(&self) -> u64 {
        self.line
    }

    /// Returns the number of bytes taken from the reader.
    pub(super) fn bytes_read(&self) -> u64 {
        self.read_before + self.end as u64
    }

    /// Returns the bytes held and not yet taken.
    pub(super) fn held_bytes(&self) -> &[u8] {
        &self.buffer[self.at..self.end]
    }

    /// Returns the held bytes up to the end of the last whole token and the blank after it.
    pub(super) fn whole_tokens(&self) -> &[u8] {
        let after_last = self
            .held_bytes()
            .iter()
            .rposition(|&b| is_blank(b))
            .map_or(0, |last| last + 1);
        &self.held_bytes()[..after_last]
    }

    /// Reads more bytes; returns false at the end of the file or if the window is full.
    pub(super) fn fill_source_window(&mut self) -> Result<bool, BvhError> {
        self.buffer.copy_within(self.at..self.end, 0);
        self.read_before += self.at as u64;
        self.end -= self.at;
        self.at = 0;
        while !self.ended && self.end < SOURCE_CHUNK_BYTES {
            match self.read.read(&mut self.buffer[self.end..SOURCE_CHUNK_BYTES]) {
                Ok(0) => self.ended = true,
                Ok(count) => {
                    self.end += count;
                    return Ok(true);
                }
                Err(cause) if cause.kind() == std::io::ErrorKind::Interrupted => {}
                Err(cause) => return Err(BvhErrorKind::Io(cause).error_at_line(self.line)),
            }
        }
        Ok(false)
    }

    /// Returns the next byte without taking it, `None` at the end of the file.
    pub(super) fn peek_source_byte(&mut self) -> Result<Option<u8>, BvhError> {
        if self.at == self.end && !self.fill_source_window()? {
            return Ok(None);
        }
        Ok(Some(self.buffer[self.at]))
    }

    /// Takes the byte that [`ByteSource::peek_source_byte`] showed and counts lines.
    pub(super) fn take_source_byte(&mut self) {
        let byte = self.buffer[self.at];
        self.at += 1;
        // Only the byte after a CR shows whether the line ended with CR alone.
        if self.after_return && byte != b'\n' {
            self.cr.get_or_insert(self.line - 1);
        }
        match byte {
            b'\n' if self.after_return => {
                self.cr_lf.get_or_insert(self.line - 1);
            }
            b'\n' | b'\r' => self.line += 1,
            _ => {}
        }
        self.after_return = byte == b'\r';
    }

    /// Takes bytes without line ends.
    pub(super) fn advance_source_bytes(&mut self, count: usize) {
        if count > 0 && self.after_return {
            self.after_return = false;
            self.cr.get_or_insert(self.line - 1);
        }
        self.at += count;
    }

    /// Takes blanks and line ends, and returns the byte after them.
    pub(super) fn skip_blanks(&mut self) -> Result<Option<u8>, BvhError> {
        while let Some(byte) = self.peek_source_byte()? {
            if !is_blank(byte) {
                return Ok(Some(byte));
            }
            self.take_source_byte();
        }
        Ok(None)
    }

    /// Takes the bytes up to one that `stop` names, at most [`TOKEN_LIMIT`] of them.
    pub(super) fn take_until(&mut self, stop: impl Fn(u8) -> bool) -> Result<&[u8], BvhError> {
        let mut length = 0;
        loop {
            match self.held_bytes()[length..].iter().position(|&b| stop(b)) {
                Some(more) => {
                    length += more;
                    break;
                }
                None => length = self.held_bytes().len(),
            }
            if length > TOKEN_LIMIT || !self.fill_source_window()? {
                break;
            }
        }
        if length > TOKEN_LIMIT {
            return Err(BvhErrorKind::TooLong { limit: TOKEN_LIMIT }.error_at_line(self.line));
        }
        let start = self.at;
        self.advance_source_bytes(length);
        Ok(&self.buffer[start..start + length])
    }
}

/// Returns whether a byte separates tokens.
pub(super) fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | b'\r' | 0x0b | 0x0c)
}

/// Returns the token as displayable text: at most forty characters.
pub(super) fn shown_token_bytes(token: &[u8]) -> String {
    // Forty characters have at most 160 bytes.
    let text = String::from_utf8_lossy(&token[..token.len().min(160)]);
    let mut short: String = text.chars().take(40).collect();
    if short.len() < token.len() && short.chars().count() == 40 {
        short.push('…');
    }
    short
}
