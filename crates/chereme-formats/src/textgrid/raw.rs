//! Mirrors a TextGrid file.
//!
//! Praat reads text files by their free-standing numbers, quoted strings and flags, and skips every other word. The
//! reader does the same, and so reads both forms of text alike.

use std::borrow::Cow;

use crate::finding::Finding;
use crate::table::{TableError, decode};
use crate::tally::Findings;

/// The two text forms of a TextGrid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Form {
    /// Every value with its name, as Praat writes by default.
    #[default]
    Long,
    /// Values alone, one a line.
    Short,
}

/// A TextGrid.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Grid {
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
    pub items: Vec<Item>,
}

/// An interval, or a point whose end is its start.
#[derive(Debug, Clone, PartialEq)]
pub struct Item {
    /// The beginning in seconds.
    pub start: f64,
    /// The end in seconds.
    pub end: f64,
    /// The label.
    pub text: String,
    /// The line of the label, counted from 1; nothing in a binary file.
    pub line: Option<u64>,
}

impl Item {
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
pub enum Error {
    /// The bytes are neither text nor Praat's binary form.
    #[error("line {line}: this is not text; save it in Praat as a text file")]
    NotText {
        /// The line, counted from 1.
        line: u64,
    },
    /// The file is another one of Praat's.
    #[error(
        "this holds a {class:?}, not a TextGrid; choose Save as text file for a TextGrid in Praat"
    )]
    OtherObject {
        /// The object class that the file declares.
        class: String,
    },
    /// The file does not begin like Praat's files.
    #[error(
        "this does not begin as a TextGrid does: File type = \"ooTextFile\", Object class = \"TextGrid\""
    )]
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
pub(super) fn read(bytes: &[u8]) -> Result<(Grid, Findings), Error> {
    let mut findings = Findings::default();
    if let Some(rest) = bytes.strip_prefix(b"ooBinaryFile") {
        return Ok((binary(rest)?, findings));
    }
    let bytes = without_mark(bytes);
    let text = decode(&bytes, &mut findings).map_err(|error| match error {
        TableError::NotText { line } => Error::NotText { line },
        _ => Error::NoTextGrid,
    })?;
    let grid = grid(&mut Values::of(&text), &mut findings)?;
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
enum Value {
    Number(f64),
    Text(String),
    Flag(bool),
}

/// The values of a text, in order.
struct Values<'t> {
    rest: &'t str,
    line: u64,
}

impl<'t> Values<'t> {
    fn of(text: &'t str) -> Self {
        Self {
            rest: text,
            line: 1,
        }
    }

    fn skip(&mut self, bytes: usize) {
        let (skipped, rest) = self.rest.split_at(bytes);
        self.line += skipped.bytes().filter(|byte| *byte == b'\n').count() as u64;
        self.rest = rest;
    }

    fn next(&mut self) -> Option<Value> {
        loop {
            let blanks = self.rest.len() - self.rest.trim_start().len();
            self.skip(blanks);
            if self.rest.is_empty() {
                return None;
            }
            if self.rest.starts_with('!') {
                let end = self.rest.find('\n').unwrap_or(self.rest.len());
                self.skip(end);
                continue;
            }
            if self.rest.starts_with('"') {
                return self.quoted().map(Value::Text);
            }
            let end = self
                .rest
                .find(char::is_whitespace)
                .unwrap_or(self.rest.len());
            let word = &self.rest[..end];
            self.skip(end);
            match word {
                "<exists>" => return Some(Value::Flag(true)),
                "<absent>" => return Some(Value::Flag(false)),
                _ => {}
            }
            let begins =
                word.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.'));
            if let Some(number) = word.parse().ok().filter(|_| begins) {
                return Some(Value::Number(number));
            }
        }
    }

    /// Reads a string; a doubled quote is a quote, and lines may end inside.
    fn quoted(&mut self) -> Option<String> {
        let mut text = String::new();
        let mut at = 1;
        loop {
            let quote = at + self.rest[at..].find('"')?;
            text.push_str(&self.rest[at..quote]);
            at = quote + 1;
            if !self.rest[at..].starts_with('"') {
                self.skip(at);
                return Some(text.replace("\r\n", "\n"));
            }
            text.push('"');
            at += 1;
        }
    }

    fn number(&mut self, expected: &'static str) -> Result<f64, Error> {
        match self.next() {
            Some(Value::Number(number)) => Ok(number),
            _ => Err(self.fault(expected)),
        }
    }

    fn count(&mut self, expected: &'static str) -> Result<u64, Error> {
        let number = self.number(expected)?;
        if number.fract() == 0.0 && (0.0..=1e9).contains(&number) {
            Ok(number as u64)
        } else {
            Err(self.fault(expected))
        }
    }

    fn text(&mut self, expected: &'static str) -> Result<String, Error> {
        match self.next() {
            Some(Value::Text(text)) => Ok(text),
            _ => Err(self.fault(expected)),
        }
    }

    fn fault(&self, expected: &'static str) -> Error {
        Error::Expected {
            line: self.line,
            expected,
        }
    }
}

fn grid(values: &mut Values<'_>, findings: &mut Findings) -> Result<Grid, Error> {
    let header = values
        .text("\"ooTextFile\"")
        .map_err(|_| Error::NoTextGrid)?;
    if header != "ooTextFile" {
        return Err(Error::NoTextGrid);
    }
    let class = values.text("\"TextGrid\"").map_err(|_| Error::NoTextGrid)?;
    if class != "TextGrid" {
        return Err(Error::OtherObject { class });
    }
    let mut grid = Grid {
        start: values.number("the beginning")?,
        end: values.number("the end")?,
        tiers: Vec::new(),
    };
    match values.next() {
        Some(Value::Flag(true)) => {}
        Some(Value::Flag(false)) => return Ok(grid),
        _ => return Err(values.fault("<exists>")),
    }
    let tiers = values.count("the number of tiers")?;
    for _ in 0..tiers {
        let class = values.text("the class of a tier")?;
        let is_points = match class.as_str() {
            "IntervalTier" => false,
            "TextTier" => true,
            _ => return Err(values.fault("\"IntervalTier\" or \"TextTier\"")),
        };
        let mut tier = GridTier {
            name: values.text("the name of a tier")?,
            is_points,
            start: values.number("the beginning of a tier")?,
            end: values.number("the end of a tier")?,
            items: Vec::new(),
        };
        let items = values.count("the number of intervals or points")?;
        for _ in 0..items {
            tier.items.push(item(values, is_points)?);
        }
        grid.tiers.push(tier);
    }
    if values.next().is_some() {
        let line = values.line;
        findings.add("values after the end", || {
            Finding::warning(
                line,
                "values follow after the last tier; they were left out",
            )
        });
    }
    Ok(grid)
}

fn item(values: &mut Values<'_>, is_point: bool) -> Result<Item, Error> {
    let start = values.number("the time of an interval or point")?;
    let end = if is_point {
        start
    } else {
        values.number("the end of an interval")?
    };
    let text = values.text("a label")?;
    Ok(Item {
        start,
        end,
        text,
        line: Some(values.line),
    })
}

/// Bytes of the binary form.
struct Bytes<'b>(&'b [u8]);

impl<'b> Bytes<'b> {
    fn take(&mut self, count: usize, expected: &'static str) -> Result<&'b [u8], Error> {
        let fault = Error::Expected { line: 0, expected };
        let (taken, rest) = self.0.split_at_checked(count).ok_or(fault)?;
        self.0 = rest;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self, expected: &'static str) -> Result<[u8; N], Error> {
        let mut bytes = [0; N];
        bytes.copy_from_slice(self.take(N, expected)?);
        Ok(bytes)
    }

    fn number(&mut self, expected: &'static str) -> Result<f64, Error> {
        Ok(f64::from_be_bytes(self.array(expected)?))
    }

    fn count(&mut self, expected: &'static str) -> Result<usize, Error> {
        let count = i32::from_be_bytes(self.array(expected)?);
        usize::try_from(count).map_err(|_| Error::Expected { line: 0, expected })
    }

    /// Reads a name: one byte of length, then letters of ASCII.
    fn short_text(&mut self, expected: &'static str) -> Result<String, Error> {
        let [length] = self.array(expected)?;
        let bytes = self.take(usize::from(length), expected)?;
        Ok(String::from_utf8_lossy(bytes).into_owned())
    }

    /// Reads a label: a length and ASCII, or -1, a length and UTF-16.
    fn text(&mut self) -> Result<String, Error> {
        let expected = "a label";
        let length = i16::from_be_bytes(self.array(expected)?);
        if let Ok(length) = usize::try_from(length) {
            let bytes = self.take(length, expected)?;
            return Ok(String::from_utf8_lossy(bytes).into_owned());
        }
        let units = usize::from(u16::from_be_bytes(self.array(expected)?));
        let bytes = self.take(2 * units, expected)?;
        let pairs = bytes.chunks_exact(2);
        let units: Vec<u16> = pairs
            .map(|pair| u16::from_be_bytes([pair[0], pair[1]]))
            .collect();
        Ok(String::from_utf16_lossy(&units))
    }
}

fn binary(bytes: &[u8]) -> Result<Grid, Error> {
    let mut bytes = Bytes(bytes);
    let class = bytes.short_text("the class of the object")?;
    if class != "TextGrid" {
        return Err(Error::OtherObject { class });
    }
    let mut grid = Grid {
        start: bytes.number("the beginning")?,
        end: bytes.number("the end")?,
        tiers: Vec::new(),
    };
    let [exists] = bytes.array("whether there are tiers")?;
    let tiers = if exists == 0 {
        0
    } else {
        bytes.count("the number of tiers")?
    };
    for _ in 0..tiers {
        let class = bytes.short_text("the class of a tier")?;
        let is_points = class == "TextTier";
        let mut tier = GridTier {
            name: bytes.text()?,
            is_points,
            start: bytes.number("the beginning of a tier")?,
            end: bytes.number("the end of a tier")?,
            items: Vec::new(),
        };
        for _ in 0..bytes.count("the number of intervals or points")? {
            let start = bytes.number("the time of an interval or point")?;
            let end = if is_points {
                start
            } else {
                bytes.number("the end of an interval")?
            };
            let text = bytes.text()?;
            tier.items.push(Item {
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
