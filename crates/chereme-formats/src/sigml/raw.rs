//! Mirrors a SiGML document: elements with attributes, and their lines.
//!
//! SiGML has no text between its tags. [`convert`](super::convert) interprets the two spellings of signs.

use super::error::Error;
use crate::finding::Finding;
use crate::tally::Findings;
use quick_xml::Reader;
use quick_xml::XmlVersion;
use quick_xml::errors::{Error as XmlError, SyntaxError};
use quick_xml::events::attributes::Attributes;
use quick_xml::events::{BytesDecl, Event};
use std::borrow::Cow;
use std::fmt::Write as _;

/// The longest file that is read, in bytes.
pub const BYTES: usize = 64 << 20;
/// The most elements of a file.
pub const ELEMENTS: usize = 1 << 20;
/// The most elements open at once; real files need 12.
pub const DEPTH: usize = 64;
/// The most attributes of one element; SiGML's largest has 45.
pub const ATTRIBUTES: usize = 64;

/// A text of the file, its references resolved.
pub type Text<'a> = Cow<'a, str>;

/// An element with its contents.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Element<'a> {
    /// Its name, with a prefix if it has one.
    pub name: Text<'a>,
    /// Its attributes in their order.
    pub attributes: Vec<(Text<'a>, Text<'a>)>,
    /// The elements in it.
    pub children: Vec<Element<'a>>,
    /// The line on which it starts.
    pub line: Line,
}

/// A line of the file that was read, counted from 1; 0 for an element that was not read. It is ignored in
/// comparisons.
#[derive(Debug, Clone, Copy, Default)]
pub struct Line(pub u64);

impl PartialEq for Line {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for Line {}

impl<'a> Element<'a> {
    /// Returns an element without attributes and children.
    #[must_use]
    pub fn new(name: impl Into<Text<'a>>) -> Self {
        Self {
            name: name.into(),
            ..Self::default()
        }
    }

    /// Returns the first attribute of this name.
    #[must_use]
    pub fn attribute(&self, name: &str) -> Option<&str> {
        let found = self.attributes.iter().find(|(known, _)| known == name);
        found.map(|(_, value)| &**value)
    }
}

/// Reads the root element of a document.
///
/// A document type that names an external file is reported and not fetched; comments are reported and
/// dropped; text between tags is reported and left out.
///
/// # Errors
/// [`Error`] if the bytes are not UTF-8, not well-formed XML, cut short, declare entities, or exceed the
/// limits of this module.
pub fn read(bytes: &[u8]) -> Result<(Element<'_>, Vec<Finding>), Error> {
    let text = decode(bytes)?;
    let mut reader = Reader::from_str(text);
    reader.config_mut().check_end_names = false;
    reader.config_mut().allow_dangling_amp = true;
    let mut builder = Builder {
        text,
        at: 0,
        line: 1,
        open: Vec::new(),
        root: None,
        elements: 0,
        astray: false,
        findings: Findings::default(),
    };
    loop {
        let event = match reader.read_event() {
            Ok(event) => event,
            Err(error) => return Err(builder.broken(&error, &reader)),
        };
        let end = usize::try_from(reader.buffer_position()).unwrap_or(text.len());
        if matches!(event, Event::Eof) {
            let (root, findings) = builder.finish()?;
            return Ok((root, findings.finish()));
        }
        builder.take(&event, end)?;
    }
}

/// Writes a document with this root element, indented by two blanks per level.
#[must_use]
pub fn write(root: &Element<'_>) -> Vec<u8> {
    let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    write_element(root, 0, &mut out);
    out.into_bytes()
}

fn write_element(element: &Element<'_>, depth: usize, out: &mut String) {
    let _ = write!(out, "{:1$}<{2}", "", depth * 2, element.name);
    for (name, value) in &element.attributes {
        let _ = write!(out, " {name}=\"");
        escape(value, out);
        out.push('"');
    }
    if element.children.is_empty() {
        out.push_str("/>\n");
        return;
    }
    out.push_str(">\n");
    for child in &element.children {
        write_element(child, depth + 1, out);
    }
    let _ = writeln!(out, "{:1$}</{2}>", "", depth * 2, element.name);
}

fn escape(text: &str, out: &mut String) {
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '"' => out.push_str("&quot;"),
            '\n' | '\t' | '\r' => {
                let _ = write!(out, "&#{};", u32::from(c));
            }
            c if is_xml(c) => out.push(c),
            _ => out.push('\u{fffd}'),
        }
    }
}

/// Returns whether XML 1.0 allows the character (section 2.2).
fn is_xml(c: char) -> bool {
    matches!(c, '\t' | '\n' | '\r' | ' '..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'..)
}

/// Returns the name of an element without the prefix of its namespace: `sigml` for `sg:sigml`.
fn local(name: &str) -> &str {
    name.rsplit_once(':').map_or(name, |(_, local)| local)
}

/// Builds elements from events.
struct Builder<'a> {
    text: &'a str,
    /// The byte up to which lines were counted.
    at: usize,
    line: u64,
    open: Vec<Element<'a>>,
    root: Option<Element<'a>>,
    elements: usize,
    /// Whether the last event was text where SiGML allows none.
    astray: bool,
    findings: Findings,
}

impl<'a> Builder<'a> {
    /// Takes the event that ends at byte `end`.
    fn take(&mut self, event: &Event<'_>, end: usize) -> Result<(), Error> {
        let astray = matches!(
            event,
            Event::Text(_) | Event::CData(_) | Event::GeneralRef(_)
        );
        match event {
            Event::Start(tag) => {
                let element = self.element(end - 1, tag.len(), tag.name().0.len())?;
                self.open.push(element);
                if self.open.len() > DEPTH {
                    return Err(self.limit("elements are nested too deep", DEPTH));
                }
            }
            Event::Empty(tag) => {
                let element = self.element(end - 2, tag.len(), tag.name().0.len())?;
                self.close(element)?;
            }
            Event::End(tag) => self.end(tag.name().0)?,
            Event::Decl(declaration) => self.declaration(declaration)?,
            Event::DocType(doctype) => self.doctype(doctype)?,
            Event::Comment(_) | Event::PI(_) => self.find("comments", |line| {
                Finding::note(line, "an XML comment or instruction is not kept")
            }),
            Event::Text(_) if is_blank(event) => {}
            _ if astray && self.astray => {}
            Event::Text(_) | Event::CData(_) | Event::GeneralRef(_) => self.stray(end)?,
            Event::Eof => {}
        }
        self.astray = astray && (self.astray || !is_blank(event));
        self.count_to(end);
        Ok(())
    }

    fn count_to(&mut self, end: usize) {
        let passed = self.text.as_bytes().get(self.at..end).unwrap_or_default();
        self.line += memchr::memchr_iter(b'\n', passed).count() as u64;
        self.at = self.at.max(end);
    }

    /// Reads the tag whose inside is the `len` bytes before `end`.
    fn element(&mut self, end: usize, len: usize, name: usize) -> Result<Element<'a>, Error> {
        self.elements += 1;
        if self.elements > ELEMENTS {
            return Err(self.limit("the file has too many elements", ELEMENTS));
        }
        let (name, attributes) = self.text[end - len..end].split_at(name);
        let name = local(name);
        let mut element = Element {
            line: Line(self.line),
            ..Element::new(name)
        };
        for attribute in Attributes::new(attributes, 0).with_checks(false) {
            let Ok(attribute) = attribute else {
                return Err(Error::Syntax {
                    line: self.line,
                    message: format!(
                        "<{}> has a broken attribute; write NAME=\"value\"",
                        shown(name)
                    ),
                });
            };
            if element.attributes.len() == ATTRIBUTES {
                return Err(self.limit("the element has too many attributes", ATTRIBUTES));
            }
            let key = attribute.key.0;
            // It names the prefix that elements have, and is no part of a sign.
            if key.starts_with("xmlns:") {
                continue;
            }
            let value = match attribute.normalized_value(XmlVersion::Implicit1_0) {
                Ok(value) => value,
                Err(_) => {
                    self.find("unknown references", |line| {
                        Finding::warning(line, "the value of an attribute holds a reference to nothing known; it was kept as it is written")
                            .with_remedy("write &amp; for an ampersand")
                    });
                    attribute.value
                }
            };
            if element.attribute(key).is_some() {
                let message = format!(
                    "<{}> has {} twice; the first one counts",
                    shown(name),
                    shown(key)
                );
                self.find("attributes twice", |line| Finding::warning(line, message));
            } else {
                element.attributes.push((Cow::Borrowed(key), value));
            }
        }
        Ok(element)
    }

    fn end(&mut self, name: &str) -> Result<(), Error> {
        let name = local(name);
        let Some(element) = self.open.pop() else {
            return Err(Error::Syntax {
                line: self.line,
                message: format!("</{}> closes nothing; take it away", shown(name)),
            });
        };
        if element.name != name {
            let open = shown(&element.name);
            let message = format!("</{}> closes <{open}>; write </{open}>", shown(name));
            return Err(Error::Syntax {
                line: self.line,
                message,
            });
        }
        self.close(element)
    }

    fn close(&mut self, element: Element<'a>) -> Result<(), Error> {
        if let Some(parent) = self.open.last_mut() {
            parent.children.push(element);
        } else if self.root.is_none() {
            self.root = Some(element);
        } else {
            return Err(Error::Syntax {
                line: element.line.0,
                message: format!(
                    "<{}> is a second root element; put all signs into one <sigml>",
                    shown(&element.name)
                ),
            });
        }
        Ok(())
    }

    fn declaration(&self, declaration: &BytesDecl<'_>) -> Result<(), Error> {
        let encoding = declaration.encoding().and_then(Result::ok);
        let encoding = encoding.unwrap_or("UTF-8".into());
        if ["utf-8", "utf8", "us-ascii"].contains(&&*encoding.to_ascii_lowercase())
            || self.text.is_ascii()
        {
            return Ok(());
        }
        Err(Error::Encoding {
            encoding: shown(&encoding),
            line: self.line,
        })
    }

    fn doctype(&mut self, text: &str) -> Result<(), Error> {
        if text.contains('[') {
            return Err(Error::Entities { line: self.line });
        }
        self.find("document types", |line| {
            Finding::note(
                line,
                "a document type is named; it is not fetched, and not kept",
            )
        });
        Ok(())
    }

    fn stray(&mut self, end: usize) -> Result<(), Error> {
        let text = self.text.get(self.at..end).unwrap_or_default();
        self.count_to(self.at + text.len() - text.trim_start().len());
        let Some(parent) = self.open.last() else {
            return match self.root {
                None => Err(Error::NotXml { line: self.line }),
                Some(_) => {
                    self.find("text after the end", |line| {
                        Finding::warning(line, "there is text after the end; it was left out")
                    });
                    Ok(())
                }
            };
        };
        let text = shown(self.text.get(self.at..end).unwrap_or_default().trim());
        let message = format!(
            "there is text in <{}>: {text:?}; it was left out",
            shown(&parent.name)
        );
        self.find("text between elements", |line| {
            Finding::warning(line, message).with_remedy("SiGML says everything in attributes")
        });
        Ok(())
    }

    fn finish(self) -> Result<(Element<'a>, Findings), Error> {
        match (self.open.last(), self.root) {
            (Some(open), _) => Err(Error::Truncated {
                line: self.line,
                open: shown(&open.name),
            }),
            (None, Some(root)) => Ok((root, self.findings)),
            (None, None) => Err(Error::NotXml { line: self.line }),
        }
    }

    fn broken(&self, error: &XmlError, reader: &Reader<&[u8]>) -> Error {
        let at = usize::try_from(reader.error_position()).unwrap_or(self.at);
        let line = line_of(self.text.as_bytes(), at);
        match (error, self.open.last()) {
            (XmlError::Syntax(SyntaxError::InvalidBangMarkup), _) | (XmlError::IllFormed(_), _) => {
                Error::Syntax {
                    line,
                    message: format!("{error}; the element is not well-formed XML"),
                }
            }
            (XmlError::Syntax(_), Some(open)) => Error::Truncated {
                line: line_of(self.text.as_bytes(), self.text.len()),
                open: shown(&open.name),
            },
            _ => Error::NotXml { line },
        }
    }

    fn find(&mut self, kind: &'static str, make: impl FnOnce(u64) -> Finding) {
        let line = self.line;
        self.findings.add(kind, || make(line));
    }

    fn limit(&self, what: &'static str, limit: usize) -> Error {
        Error::Limit {
            line: self.line,
            what,
            limit,
        }
    }
}

fn is_blank(event: &Event<'_>) -> bool {
    matches!(event, Event::Text(text) if text.trim().is_empty())
}

fn decode(bytes: &[u8]) -> Result<&str, Error> {
    if bytes.len() > BYTES {
        return Err(Error::Limit {
            line: 1,
            what: "the file has too many bytes",
            limit: BYTES,
        });
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let wide = [&b"\xff\xfe"[..], b"\xfe\xff", b"<\0", b"\0<"];
    if wide.iter().any(|mark| bytes.starts_with(mark)) {
        return Err(Error::Encoding {
            encoding: "UTF-16".into(),
            line: 1,
        });
    }
    let text = str::from_utf8(bytes).map_err(|error| {
        let line = line_of(bytes, error.valid_up_to());
        if memchr::memchr(0, bytes).is_some() {
            return Error::NotXml { line };
        }
        Error::Encoding {
            encoding: "an unknown encoding".into(),
            line,
        }
    })?;
    match text.find(|c| !is_xml(c)) {
        Some(at) => Err(Error::NotXml {
            line: line_of(bytes, at),
        }),
        None => Ok(text),
    }
}

/// Returns the text, cut to 40 characters.
pub(super) fn shown(text: &str) -> String {
    if text.chars().count() <= 40 {
        text.to_owned()
    } else {
        text.chars().take(40).chain(['…']).collect()
    }
}

fn line_of(bytes: &[u8], at: usize) -> u64 {
    memchr::memchr_iter(b'\n', &bytes[..at.min(bytes.len())]).count() as u64 + 1
}
