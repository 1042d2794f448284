//! Mirrors a TextGrid file.
//!
//! Praat reads text files by their free-standing numbers, quoted strings and flags, and skips every other word. The
//! reader does the same, and so reads both forms of text alike.

use std::borrow::Cow;

use crate::table::{TableError, decode_table_bytes};
use crate::tally::FindingTally;

/// The two text forms of a TextGrid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TextGridForm {
    /// Every value with its name, as Praat writes by default.
    #[default]
    Long,
    /// Values alone, one a line.
    Short,
}

/// A TextGrid.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RawTextGrid {
    /// The beginning in seconds.
    pub start: f64,
    /// The end in seconds.
    pub end: f64,
    /// The tiers in order.
    pub tiers: Vec<GridTier>,
}

/// A tier of intervals or points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GridTier {
    /// The name; several tiers may share one.
    pub name: String,
    /// Whether it holds points.
    pub is_points: bool,
    /// The beginning in seconds.
    pub start: f64,
    /// The end in seconds.
    pub end: f64,
    /// The intervals or points in the order of the file.
    pub items: Vec<GridTierItem>,
}

/// An interval, or a point whose end is its start.
#[derive(Debug, Clone, PartialEq)]
pub struct GridTierItem {
    /// The beginning in seconds.
    pub start: f64,
    /// The end in seconds.
    pub end: f64,
    /// The label.
    pub text: String,
    /// The line of the label, counted from 1; nothing in a binary file.
    pub line: Option<u64>,
}

impl GridTierItem {
    /// Returns an interval that is not from a file.
    #[must_use]
    pub fn new(start: f64, end: f64, text: &str) -> Self {
        Self {
            start,
            end,
            text: text.to_owned(),
            line: None,
        }
    }
}

/// Why bytes could not be read as a TextGrid.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum TextGridError {
    /// The bytes are neither text nor Praat's binary form.
    #[error("line {line}: this is not text; save it in Praat as a text file")]
    NotText {
        /// The line, counted from 1.
        line: u64,
    },
    /// The file is another one of Praat's.
    #[error("this holds a {class:?}, not a TextGrid; choose Save as text file for a TextGrid in Praat")]
    OtherObject {
        /// The object class that the file declares.
        class: String,
    },
    /// The file does not begin like Praat's files.
    #[error("this does not begin as a TextGrid does: File type = \"ooTextFile\", Object class = \"TextGrid\"")]
    NoTextGrid,
    /// The file lacks a value at a place that needs one.
    #[error("line {line}: {expected} belongs here; the file is cut short or damaged")]
    Expected {
        /// The line, counted from 1; 0 in a binary file.
        line: u64,
        /// The missing value.
        expected: &'static str,
    },
}

/// Reads a TextGrid in any of Praat's three forms.
pub(super) fn read_raw_textgrid(bytes: &[u8]) -> Result<(RawTextGrid, FindingTally), TextGridError> {
    let mut findings = FindingTally::default();
    if let Some(rest) = bytes.strip_prefix(b"ooBinaryFile") {
        return Ok((binary(rest)?, findings));
    }
    let bytes = without_mark(bytes);
    let text = decode_table_bytes(&bytes, &mut findings).map_err(|error| match error {
        TableError::NotText { line } => TextGridError::NotText { line },
        _ => TextGridError::NoTextGrid,
    })?;
    let grid = parse_raw_grid(&mut GridValues::from_grid_text(&text), &mut findings)?;
    Ok((grid, findings))
}

/// Adds a byte-order mark to text in UTF-16 that has none, recognised by the letter F with which Praat's files begin.
fn without_mark(bytes: &[u8]) -> Cow<'_, [u8]> {
    let mark: &[u8] = match bytes {
        [b'F', 0, ..] => &[0xff, 0xfe],
        [0, b'F', ..] => &[0xfe, 0xff],
        _ => return bytes.into(),
    };
    [mark, bytes].concat().into()
}

/// One value of the text, and its line.
enum GridValue {
    Number(f64),
    Text(String),
    Flag(bool),
}

/// The values of a text, in order.
struct GridValues<'t> {
    rest: &'t str,
    line: u64,
}

impl<'t> GridValues<'t> {
    fn from_grid_text(text: &'t str) -> Self {
        Self { rest: text, line: 1 }
    }

    fn skip_grid_bytes(&mut self, bytes: usize) {
        let (skipped, rest) = self.rest.split_at(bytes);
        self.line += skipped.bytes().filter(|byte| *byte == b'\n').count() as u64;
        self.rest = rest;
    }

    fn next(&mut self) -> Option<GridValue> {
        loop {
            let blanks = self.rest.len() - self.rest.trim_start().len();
            self.skip_grid_bytes(blanks);
            if self.rest.is_empty() {
                return None;
            }
            // Praat takes the rest of a line after ! for a comment.
            if self.rest.starts_with('!') {
                let end = self.rest.find('\n').unwrap_or(self.rest.len());
                self.skip_grid_bytes(end);
                continue;
            }
            if self.rest.starts_with('"') {
                return self.read_quoted_string().map(GridValue::Text);
            }
            let end = self.rest.find(char::is_whitespace).unwrap_or(self.rest.len());
            let word = &self.rest[..end];
            self.skip_grid_bytes(end);
            match word {
                "<exists>" => return Some(GridValue::Flag(true)),
                "<absent>" => return Some(GridValue::Flag(false)),
                _ => {}
            }
            // Words between values are there for readers only, even `inf` and `nan`, which would parse as numbers.
            let begins = word.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.'));
            if let Some(number) = word.parse().ok().filter(|_| begins) {
                return Some(GridValue::Number(number));
            }
        }
    }

    /// Reads a string; a doubled quote is a quote, and lines may end inside.
    fn read_quoted_string(&mut self) -> Option<String> {
        let mut text = String::new();
        let mut search_start = 1;
        loop {
            let quote = search_start + self.rest[search_start..].find('"')?;
            text.push_str(&self.rest[search_start..quote]);
            search_start = quote + 1;
            if !self.rest[search_start..].starts_with('"') {
                self.skip_grid_bytes(search_start);
                return Some(text.replace("\r\n", "\n"));
            }
            text.push('"');
            search_start += 1;
        }
    }

    fn expect_grid_number(&mut self, expected: &'static str) -> Result<f64, TextGridError> {
        match self.next() {
            Some(GridValue::Number(number)) => Ok(number),
            _ => Err(self.missing_value_error(expected)),
        }
    }

    fn expect_grid_count(&mut self, expected: &'static str) -> Result<u64, TextGridError> {
        let number = self.expect_grid_number(expected)?;
        if number.fract() == 0.0 && (0.0..=1e9).contains(&number) {
            Ok(number as u64)
        } else {
            Err(self.missing_value_error(expected))
        }
    }

    fn expect_grid_text(&mut self, expected: &'static str) -> Result<String, TextGridError> {
        match self.next() {
            Some(GridValue::Text(text)) => Ok(text),
            _ => Err(self.missing_value_error(expected)),
        }
    }

    fn missing_value_error(&self, expected: &'static str) -> TextGridError {
        TextGridError::Expected {
            line: self.line,
            expected,
        }
    }
}

fn parse_raw_grid(values: &mut GridValues<'_>, findings: &mut FindingTally) -> Result<RawTextGrid, TextGridError> {
    let header = values
        .expect_grid_text("\"ooTextFile\"")
        .map_err(|_| TextGridError::NoTextGrid)?;
    if header != "ooTextFile" {
        return Err(TextGridError::NoTextGrid);
    }
    let class = values
        .expect_grid_text("\"TextGrid\"")
        .map_err(|_| TextGridError::NoTextGrid)?;
    if class != "TextGrid" {
        return Err(TextGridError::OtherObject { class });
    }
    let mut grid = RawTextGrid {
        start: values.expect_grid_number("the beginning")?,
        end: values.expect_grid_number("the end")?,
        tiers: Vec::new(),
    };
    match values.next() {
        Some(GridValue::Flag(true)) => {}
        Some(GridValue::Flag(false)) => return Ok(grid),
        _ => return Err(values.missing_value_error("<exists>")),
    }
    let tiers = values.expect_grid_count("the number of tiers")?;
    for _ in 0..tiers {
        let class = values.expect_grid_text("the class of a tier")?;
        let is_points = match class.as_str() {
            "IntervalTier" => false,
            "TextTier" => true,
            _ => return Err(values.missing_value_error("\"IntervalTier\" or \"TextTier\"")),
        };
        let mut tier = GridTier {
            name: values.expect_grid_text("the name of a tier")?,
            is_points,
            start: values.expect_grid_number("the beginning of a tier")?,
            end: values.expect_grid_number("the end of a tier")?,
            items: Vec::new(),
        };
        let items = values.expect_grid_count("the number of intervals or points")?;
        for _ in 0..items {
            tier.items.push(parse_grid_item(values, is_points)?);
        }
        grid.tiers.push(tier);
    }
    // Two files that were joined begin with a whole one.
    if values.next().is_some() {
        let line = values.line;
        findings.add_limited_warning(
            "values after the end",
            line,
            || "values follow after the last tier; they were left out",
        );
    }
    Ok(grid)
}

fn parse_grid_item(values: &mut GridValues<'_>, is_point: bool) -> Result<GridTierItem, TextGridError> {
    let start = values.expect_grid_number("the time of an interval or point")?;
    let end = if is_point {
        start
    } else {
        values.expect_grid_number("the end of an interval")?
    };
    let text = values.expect_grid_text("a label")?;
    Ok(GridTierItem {
        start,
        end,
        text,
        line: Some(values.line),
    })
}

/// Bytes of the binary form.
struct BinaryGridBytes<'b>(&'b [u8]);

impl<'b> BinaryGridBytes<'b> {
    fn take_grid_bytes(&mut self, count: usize, expected: &'static str) -> Result<&'b [u8], TextGridError> {
        let fault = TextGridError::Expected { line: 0, expected };
        let (taken, rest) = self.0.split_at_checked(count).ok_or(fault)?;
        self.0 = rest;
        Ok(taken)
    }

    fn array<const VALUE_BYTE_COUNT: usize>(
        &mut self,
        expected: &'static str,
    ) -> Result<[u8; VALUE_BYTE_COUNT], TextGridError> {
        let mut bytes = [0; VALUE_BYTE_COUNT];
        bytes.copy_from_slice(self.take_grid_bytes(VALUE_BYTE_COUNT, expected)?);
        Ok(bytes)
    }

    fn read_binary_number(&mut self, expected: &'static str) -> Result<f64, TextGridError> {
        Ok(f64::from_be_bytes(self.array(expected)?))
    }

    fn read_binary_count(&mut self, expected: &'static str) -> Result<usize, TextGridError> {
        let count = i32::from_be_bytes(self.array(expected)?);
        usize::try_from(count).map_err(|_| TextGridError::Expected { line: 0, expected })
    }

    /// Reads a name: one byte of length, then letters of ASCII.
    fn short_text(&mut self, expected: &'static str) -> Result<String, TextGridError> {
        let [length] = self.array(expected)?;
        let bytes = self.take_grid_bytes(usize::from(length), expected)?;
        Ok(String::from_utf8_lossy(bytes).into_owned())
    }

    /// Reads a label: a length and ASCII, or -1, a length and UTF-16.
    fn read_binary_label(&mut self) -> Result<String, TextGridError> {
        let expected = "a label";
        let length = i16::from_be_bytes(self.array(expected)?);
        if let Ok(length) = usize::try_from(length) {
            let bytes = self.take_grid_bytes(length, expected)?;
            return Ok(String::from_utf8_lossy(bytes).into_owned());
        }
        let units = usize::from(u16::from_be_bytes(self.array(expected)?));
        let bytes = self.take_grid_bytes(2 * units, expected)?;
        let pairs = bytes.chunks_exact(2);
        let units: Vec<u16> = pairs.map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect();
        Ok(String::from_utf16_lossy(&units))
    }
}

fn binary(bytes: &[u8]) -> Result<RawTextGrid, TextGridError> {
    let mut bytes = BinaryGridBytes(bytes);
    let class = bytes.short_text("the class of the object")?;
    if class != "TextGrid" {
        return Err(TextGridError::OtherObject { class });
    }
    let mut grid = RawTextGrid {
        start: bytes.read_binary_number("the beginning")?,
        end: bytes.read_binary_number("the end")?,
        tiers: Vec::new(),
    };
    let [exists] = bytes.array("whether there are tiers")?;
    let tiers = if exists == 0 {
        0
    } else {
        bytes.read_binary_count("the number of tiers")?
    };
    for _ in 0..tiers {
        let class = bytes.short_text("the class of a tier")?;
        let is_points = class == "TextTier";
        let mut tier = GridTier {
            name: bytes.read_binary_label()?,
            is_points,
            start: bytes.read_binary_number("the beginning of a tier")?,
            end: bytes.read_binary_number("the end of a tier")?,
            items: Vec::new(),
        };
        for _ in 0..bytes.read_binary_count("the number of intervals or points")? {
            let start = bytes.read_binary_number("the time of an interval or point")?;
            let end = if is_points {
                start
            } else {
                bytes.read_binary_number("the end of an interval")?
            };
            let text = bytes.read_binary_label()?;
            tier.items.push(GridTierItem {
                start,
                end,
                text,
                line: None,
            });
        }
        grid.tiers.push(tier);
    }
    Ok(grid)
}
