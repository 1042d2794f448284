//! A cursor over the elements of a hostile XML text, built on quick-xml's pull parser. Other annotation files in XML are
//! read with it, too.

use super::eaf_raw::{EafSourceText, ElementStart};
use super::encoding::is_known;
use super::error::EafError;
use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use quick_xml::Reader;
use quick_xml::errors::{Error as XmlError, IllFormedError, SyntaxError};
use quick_xml::events::Event;
use std::borrow::Cow;

/// The most elements open at once; EAF needs 6.
const MAX_OPEN_ELEMENTS: usize = 64;
/// The most attributes of one element; EAF needs 10.
const MAX_TAG_ATTRIBUTES: usize = 64;
/// The most elements within one text that are reported.
const MAX_REPORTED_ELEMENTS: usize = 1 << 16;
/// The longest text that is read, in bytes.
pub(super) const MAX_XML_BYTES: usize = 1 << 30;

/// The start tag of an element.
#[derive(Debug, Clone, Copy)]
pub(crate) struct XmlStartTag<'a> {
    pub(crate) name: &'a str,
    attributes: &'a str,
    empty: bool,
    start: usize,
    text: &'a str,
}

impl<'a> XmlStartTag<'a> {
    /// Returns the line of the tag, counted from 1; counting takes time.
    pub(crate) fn start_tag_line(&self) -> u64 {
        line_at_byte(self.text.as_bytes(), self.start)
    }

    /// Returns the position of the tag.
    pub(crate) fn start_tag_position(&self) -> ElementStart {
        ElementStart(u32::try_from(self.start).unwrap_or(u32::MAX))
    }

    /// Returns the whole text around the tag.
    pub(super) fn tag_source_text(&self) -> EafSourceText<'a> {
        EafSourceText(self.text)
    }
}

/// Walks through the elements of a text.
pub(crate) struct XmlCursor<'a> {
    text: &'a str,
    reader: Reader<&'a [u8]>,
    open: Vec<&'a str>,
    pub(crate) findings: FindingTally,
    /// Whether a document type is passed over with a finding if it only names another file.
    names_type: bool,
}

impl<'a> XmlCursor<'a> {
    /// Returns a cursor before the root element of `bytes`.
    pub(crate) fn new(bytes: &'a [u8]) -> Result<Self, EafError> {
        let text = decode_utf8_xml(bytes)?;
        if let Some(at) = control_character(text.as_bytes()) {
            return Err(EafError::NotXml {
                line: line_at_byte(text.as_bytes(), at),
            });
        }
        let mut reader = Reader::from_str(text);
        let config = reader.config_mut();
        config.trim_text_start = true;
        config.allow_dangling_amp = true;
        config.check_end_names = false;
        Ok(Self {
            text,
            reader,
            open: Vec::new(),
            findings: FindingTally::default(),
            names_type: false,
        })
    }

    /// Returns a cursor that passes over a document type without declarations of its own.
    pub(crate) fn new_with_type(bytes: &'a [u8]) -> Result<Self, EafError> {
        Ok(Self {
            names_type: true,
            ..Self::new(bytes)?
        })
    }

    /// Returns the root element, which has to be `expected`.
    pub(crate) fn read_root_tag(&mut self, expected: &'static str) -> Result<XmlStartTag<'a>, EafError> {
        loop {
            match self.next_xml_event()? {
                Event::Decl(decl) => {
                    let encoding = decl.encoding().and_then(Result::ok).unwrap_or("UTF-8".into());
                    // The bytes are UTF-8 by now, whatever the file's encoding was.
                    if !is_known(&encoding) {
                        return Err(EafError::Encoding {
                            encoding: encoding.into(),
                            line: self.cursor_line(),
                        });
                    }
                }
                Event::Comment(_) | Event::PI(_) => self.lost_comment(),
                Event::Start(tag) => {
                    let tag = self.open_xml_tag(tag.name().0.len(), tag.len(), false)?;
                    return self.checked_root(tag, expected);
                }
                Event::Empty(tag) => {
                    let tag = self.open_xml_tag(tag.name().0.len(), tag.len(), true)?;
                    return self.checked_root(tag, expected);
                }
                _ => {
                    return Err(EafError::NotXml {
                        line: self.cursor_line(),
                    });
                }
            }
        }
    }

    fn checked_root(&self, tag: XmlStartTag<'a>, expected: &'static str) -> Result<XmlStartTag<'a>, EafError> {
        if tag.name == expected {
            return Ok(tag);
        }
        Err(EafError::Root {
            line: tag.start_tag_line(),
            found: shorten_shown_text(tag.name),
            expected,
        })
    }

    /// Returns the next child of `parent`; `None` at its end. Each child must be read to its own end
    /// first.
    pub(crate) fn next_child_tag(&mut self, parent: &XmlStartTag<'a>) -> Result<Option<XmlStartTag<'a>>, EafError> {
        if parent.empty {
            return Ok(None);
        }
        loop {
            match self.next_xml_event()? {
                Event::Start(tag) => {
                    return self.open_xml_tag(tag.name().0.len(), tag.len(), false).map(Some);
                }
                Event::Empty(tag) => {
                    return self.open_xml_tag(tag.name().0.len(), tag.len(), true).map(Some);
                }
                Event::End(tag) => return self.close_xml_tag(tag.name().0).map(|()| None),
                Event::Comment(_) | Event::PI(_) => self.lost_comment(),
                Event::Eof => return Err(self.truncated()),
                Event::Text(text) if text.trim().is_empty() => {}
                _ => {
                    let message = format!(
                        "the text in <{}> stands outside any value; it was left out",
                        parent.name
                    );
                    self.add_counted_finding("text between elements", |line| {
                        ImportFinding::new_warning_finding(line, message)
                    });
                }
            }
        }
    }

    /// Returns the text of `tag` and moves to its end.
    pub(crate) fn read_tag_text(&mut self, tag: &XmlStartTag<'a>) -> Result<Cow<'a, str>, EafError> {
        let mut inner = Vec::new();
        let text = self.text_and_elements(tag, &mut inner)?;
        for inner in inner {
            self.report_unexpected_element(&inner, tag);
        }
        Ok(text)
    }

    /// Returns the text of `tag` without the elements in it, adds the first [`MAX_REPORTED_ELEMENTS`] of those to `inner`, and moves to
    /// its end.
    pub(crate) fn text_and_elements(
        &mut self,
        tag: &XmlStartTag<'a>,
        inner: &mut Vec<XmlStartTag<'a>>,
    ) -> Result<Cow<'a, str>, EafError> {
        if tag.empty {
            return Ok(Cow::Borrowed(""));
        }
        self.reader.config_mut().trim_text_start = false;
        let text = self.read_text_pieces(inner);
        self.reader.config_mut().trim_text_start = true;
        text
    }

    fn read_text_pieces(&mut self, into: &mut Vec<XmlStartTag<'a>>) -> Result<Cow<'a, str>, EafError> {
        let mut full_text: Cow<'a, str> = Cow::Borrowed("");
        loop {
            match self.next_xml_event()? {
                Event::End(end) => return self.close_xml_tag(end.name().0).map(|()| full_text),
                Event::Text(piece) => {
                    let piece = piece.into_inner();
                    // A bare & is no reference; it stays as text and is reported.
                    if memchr::memchr(b'&', piece.as_bytes()).is_some() {
                        self.entity("");
                    }
                    append_text_piece(&mut full_text, line_ends(piece));
                }
                Event::CData(piece) => append_text_piece(&mut full_text, line_ends(piece.into_inner())),
                Event::GeneralRef(name) => {
                    let name = name.into_inner();
                    let value = self.entity(&name);
                    append_text_piece(&mut full_text, value);
                }
                Event::Comment(_) | Event::PI(_) => self.lost_comment(),
                Event::Eof => return Err(self.truncated()),
                Event::Start(inner) => {
                    let inner = self.open_xml_tag(inner.name().0.len(), inner.len(), false)?;
                    if into.len() < MAX_REPORTED_ELEMENTS {
                        into.push(inner);
                    }
                    self.skip_xml_element(&inner)?;
                    self.reader.config_mut().trim_text_start = false;
                }
                Event::Empty(inner) => {
                    let inner = self.open_xml_tag(inner.name().0.len(), inner.len(), true)?;
                    if into.len() < MAX_REPORTED_ELEMENTS {
                        into.push(inner);
                    }
                }
                Event::Decl(_) | Event::DocType(_) => {}
            }
        }
    }

    fn report_unexpected_element(&mut self, inner: &XmlStartTag<'a>, outer: &XmlStartTag<'a>) {
        self.findings.add_limited_finding("elements inside a text", || {
            let (inner_name, outer) = (shorten_shown_text(inner.name), outer.name);
            let message = format!("<{inner_name}> stands inside the text of <{outer}>; it was left out");
            ImportFinding::new_warning_finding(inner.start_tag_line(), message)
        });
    }

    /// Moves to the end of `tag` and returns its source text, including its tags.
    pub(crate) fn skip_xml_element(&mut self, tag: &XmlStartTag<'a>) -> Result<&'a str, EafError> {
        self.reader.config_mut().trim_text_start = true;
        let depth = self.open.len();
        while !tag.empty && self.open.len() >= depth {
            match self.next_xml_event()? {
                Event::Start(inner) => {
                    self.open_xml_tag(inner.name().0.len(), inner.len(), false)?;
                }
                Event::End(end) => self.close_xml_tag(end.name().0)?,
                Event::Eof => return Err(self.truncated()),
                _ => {}
            }
        }
        Ok(&self.text[tag.start..self.cursor_byte_position()])
    }

    /// Checks that nothing but comments and blanks follows the root element.
    pub(crate) fn check_document_end(&mut self) -> Result<(), EafError> {
        loop {
            match self.next_xml_event()? {
                Event::Eof => return Ok(()),
                Event::Text(text) if text.trim().is_empty() => {}
                Event::Comment(_) | Event::PI(_) => self.lost_comment(),
                _ => {
                    let message = "there is more after the end of the document; it was left out";
                    self.add_counted_finding("text after the end", |line| {
                        ImportFinding::new_warning_finding(line, message)
                    });
                    return Ok(());
                }
            }
        }
    }

    /// Passes every attribute of `tag` to `take`, with references resolved.
    pub(crate) fn visit_tag_attributes(
        &mut self,
        tag: &XmlStartTag<'a>,
        mut take: impl FnMut(&'a str, Cow<'a, str>),
    ) -> Result<(), EafError> {
        let mut rest = tag.attributes;
        let mut count = 0;
        loop {
            rest = rest.trim_ascii_start();
            if rest.is_empty() {
                return Ok(());
            }
            count += 1;
            if count > MAX_TAG_ATTRIBUTES {
                return Err(EafError::Limit {
                    line: tag.start_tag_line(),
                    what: "the element has too many attributes",
                    limit: MAX_TAG_ATTRIBUTES,
                });
            }
            let written = split_written_attribute(rest).ok_or_else(|| EafError::Syntax {
                line: tag.start_tag_line(),
                message: format!(
                    "<{}> has a broken attribute; write NAME=\"value\"",
                    shorten_shown_text(tag.name)
                ),
            })?;
            let value = if written.special {
                self.resolve_attribute_value(written.value)
            } else {
                Cow::Borrowed(written.value)
            };
            take(written.name, value);
            rest = written.rest;
        }
    }

    fn resolve_attribute_value(&mut self, raw: &'a str) -> Cow<'a, str> {
        let blank = raw.replace("\r\n", " ").replace(['\n', '\t', '\r'], " ");
        let mut full_text = String::with_capacity(blank.len());
        let mut rest = &*blank;
        while let Some((before, after)) = rest.split_once('&') {
            full_text.push_str(before);
            rest = match after.bytes().take(32).position(|b| b == b';') {
                Some(end) => {
                    full_text.push_str(&self.entity(&after[..end]));
                    &after[end + 1..]
                }
                None => {
                    full_text.push_str(&self.entity(""));
                    after
                }
            };
        }
        full_text.push_str(rest);
        Cow::Owned(full_text)
    }

    /// Returns the text of `&name;`; an unknown entity stays as written.
    fn entity(&mut self, name: &str) -> Cow<'a, str> {
        let character = match name.strip_prefix('#') {
            None => quick_xml::escape::resolve_xml_entity(name).map(Cow::Borrowed),
            Some(number) => match number.strip_prefix(['x', 'X']) {
                Some(hex) => u32::from_str_radix(hex, 16).ok(),
                None => number.parse().ok(),
            }
            .and_then(char::from_u32)
            .filter(|c| is_xml(*c))
            .map(|c| Cow::Owned(c.to_string())),
        };
        character.unwrap_or_else(|| {
            let written = if name.is_empty() {
                "&".to_owned()
            } else {
                format!("&{name};")
            };
            let text = shorten_shown_text(&written);
            self.add_counted_finding("unknown references", |line| {
                ImportFinding::new_warning_finding(line, format!("{text} is unknown; it was kept as it is written"))
                    .with_remedy("write &amp; for an ampersand")
            });
            Cow::Owned(written)
        })
    }

    #[inline]
    fn next_xml_event(&mut self) -> Result<Event<'a>, EafError> {
        loop {
            return match self.reader.read_event() {
                Ok(Event::DocType(text)) if self.names_type && !text.contains('[') => {
                    self.add_counted_finding("document types", |line| {
                        let message = "a document type is named; it is not fetched, and not kept";
                        ImportFinding::new_note_finding(line, message)
                    });
                    continue;
                }
                Ok(Event::DocType(_)) => Err(EafError::Doctype {
                    line: self.cursor_line(),
                }),
                Ok(event) => Ok(event),
                Err(error) => Err(self.broken_xml_error(&error)),
            };
        }
    }

    #[inline]
    fn open_xml_tag(&mut self, name: usize, len: usize, empty: bool) -> Result<XmlStartTag<'a>, EafError> {
        let end = self.cursor_byte_position() - if empty { 2 } else { 1 };
        let start = end - len - 1;
        let (name, attributes) = self.text[start + 1..end].split_at(name);
        let tag = XmlStartTag {
            name,
            attributes,
            empty,
            start,
            text: self.text,
        };
        if !empty {
            if self.open.len() >= MAX_OPEN_ELEMENTS {
                let what = "elements are nested too deep";
                return Err(EafError::Limit {
                    line: tag.start_tag_line(),
                    what,
                    limit: MAX_OPEN_ELEMENTS,
                });
            }
            self.open.push(name);
        }
        Ok(tag)
    }

    fn close_xml_tag(&mut self, name: &str) -> Result<(), EafError> {
        let open = self.open.pop().unwrap_or_default();
        if open == name {
            return Ok(());
        }
        let message = format!(
            "</{}> closes <{}>; write </{}>",
            shorten_shown_text(name),
            shorten_shown_text(open),
            shorten_shown_text(open)
        );
        Err(EafError::Syntax {
            line: self.cursor_line(),
            message,
        })
    }

    fn lost_comment(&mut self) {
        self.add_counted_finding("comments", |line| {
            ImportFinding::new_note_finding(line, "an XML comment or instruction is not kept")
        });
    }

    fn add_counted_finding(&mut self, kind: &'static str, make: impl FnOnce(u64) -> ImportFinding) {
        if self.findings.count_finding_kind(kind) {
            let finding = make(self.cursor_line());
            self.findings.push_counted_finding(finding);
        }
    }

    fn broken_xml_error(&self, error: &XmlError) -> EafError {
        let error_offset = usize::try_from(self.reader.error_position()).unwrap_or(usize::MAX);
        let line = line_at_byte(self.text.as_bytes(), error_offset.min(self.text.len()));
        match error {
            XmlError::Syntax(SyntaxError::InvalidBangMarkup)
            | XmlError::IllFormed(IllFormedError::UnmatchedEndTag(_)) => EafError::Syntax {
                line,
                message: format!("{error}; the element is not well-formed XML"),
            },
            XmlError::Syntax(_) if self.open.is_empty() => EafError::NotXml { line },
            XmlError::Syntax(_) => self.truncated(),
            _ => EafError::Syntax {
                line,
                message: format!("{error}; the element is not well-formed XML"),
            },
        }
    }

    fn truncated(&self) -> EafError {
        let text = self.text.as_bytes();
        match self.open.last() {
            Some(open) => EafError::Truncated {
                line: line_at_byte(text, text.len()),
                open: shorten_shown_text(open),
            },
            None => EafError::NotXml {
                line: line_at_byte(text, text.len()),
            },
        }
    }

    fn cursor_byte_position(&self) -> usize {
        usize::try_from(self.reader.buffer_position()).unwrap_or(usize::MAX)
    }

    fn cursor_line(&self) -> u64 {
        line_at_byte(self.text.as_bytes(), self.cursor_byte_position())
    }
}

/// Returns whether XML 1.0 allows the character (section 2.2).
pub(super) fn is_xml(c: char) -> bool {
    matches!(c, '\t' | '\n' | '\r' | ' '..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'..)
}

/// One attribute of a start tag: its name, its value as written, whether the value needs
/// resolving, and what follows.
struct WrittenAttribute<'a> {
    name: &'a str,
    value: &'a str,
    special: bool,
    rest: &'a str,
}

/// Characters that end the name of an attribute.
const ENDS_NAME: [bool; 256] = bytes_of(b"= \n\t\r\"'<");
/// Characters in the value of an attribute that need decoding.
const SPECIAL_VALUE_BYTES: [bool; 256] = bytes_of(b"&\n\t\r");

const fn bytes_of(set: &[u8]) -> [bool; 256] {
    let mut table = [false; 256];
    let mut index = 0;
    while index < set.len() {
        table[set[index] as usize] = true;
        index += 1;
    }
    table
}

fn split_written_attribute(text: &str) -> Option<WrittenAttribute<'_>> {
    let bytes = text.as_bytes();
    let name = bytes.iter().position(|b| ENDS_NAME[usize::from(*b)])?;
    let blanks = |from: usize| {
        let blank = bytes[from..].iter().take_while(|b| b.is_ascii_whitespace());
        from + blank.count()
    };
    let equals = blanks(name);
    if name == 0 || bytes.get(equals) != Some(&b'=') {
        return None;
    }
    let open = blanks(equals + 1);
    let quote = *bytes.get(open).filter(|b| matches!(b, b'"' | b'\''))?;
    let (start, mut special) = (open + 1, false);
    let length = bytes[start..].iter().position(|b| {
        special |= SPECIAL_VALUE_BYTES[usize::from(*b)];
        *b == quote
    })?;
    let (value, rest) = (&text[start..start + length], &text[start + length + 1..]);
    Some(WrittenAttribute {
        name: &text[..name],
        value,
        special,
        rest,
    })
}

fn append_text_piece<'a>(whole: &mut Cow<'a, str>, piece: Cow<'a, str>) {
    if whole.is_empty() {
        *whole = piece;
    } else {
        whole.to_mut().push_str(&piece);
    }
}

fn line_ends(text: Cow<'_, str>) -> Cow<'_, str> {
    if memchr::memchr(b'\r', text.as_bytes()).is_none() {
        return text;
    }
    Cow::Owned(text.replace("\r\n", "\n").replace('\r', "\n"))
}

fn shorten_shown_text(text: &str) -> String {
    if text.chars().count() <= 40 {
        text.to_owned()
    } else {
        text.chars().take(40).chain(['…']).collect()
    }
}

/// Returns a text in UTF-8.
pub(super) fn decode_utf8_xml(bytes: &[u8]) -> Result<&str, EafError> {
    if bytes.len() > MAX_XML_BYTES {
        return Err(EafError::Limit {
            line: 1,
            what: "the file has too many bytes",
            limit: MAX_XML_BYTES,
        });
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    // Bytes that look like these are no UTF-8, even if a declaration says so.
    for (mark, encoding) in [
        (&b"\xff\xfe"[..], "UTF-16"),
        (b"\xfe\xff", "UTF-16"),
        (b"<\0", "UTF-16"),
        (b"\0<", "UTF-16"),
        (b"\0\0\xfe\xff", "UTF-32"),
    ] {
        if bytes.starts_with(mark) {
            return Err(EafError::Encoding {
                encoding: encoding.into(),
                line: 1,
            });
        }
    }
    str::from_utf8(bytes).map_err(|error| {
        let line = line_at_byte(bytes, error.valid_up_to());
        if memchr::memchr(0, bytes).is_some() {
            return EafError::NotXml { line };
        }
        let utf8 = |name: &String| name.eq_ignore_ascii_case("utf-8");
        let encoding = declared_encoding(bytes)
            .filter(|name| !utf8(name))
            .unwrap_or_else(|| "an unknown encoding".into());
        EafError::Encoding {
            encoding: shorten_shown_text(&encoding),
            line,
        }
    })
}

/// Returns the encoding that the declaration of a text names.
pub(super) fn declared_encoding(bytes: &[u8]) -> Option<String> {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(200)]);
    let declaration = head.split("?>").next()?;
    let (_, rest) = declaration.split_once("encoding")?;
    let rest = rest.trim_start().strip_prefix('=')?.trim_start();
    let quote = rest
        .chars()
        .next()
        .filter(|character| ['"', '\''].contains(character))?;
    rest[1..].split(quote).next().map(str::to_owned)
}

fn control_character(bytes: &[u8]) -> Option<usize> {
    let bad = |b: u8| b < 0x20 && b != b'\t' && b != b'\n' && b != b'\r';
    let chunk = bytes
        .chunks(4096)
        .position(|c| c.iter().fold(false, |any, b| any | bad(*b)))?;
    bytes[chunk * 4096..]
        .iter()
        .position(|b| bad(*b))
        .map(|at| chunk * 4096 + at)
}

pub(crate) fn line_at_byte(bytes: &[u8], at: usize) -> u64 {
    memchr::memchr_iter(b'\n', &bytes[..at.min(bytes.len())]).count() as u64 + 1
}
