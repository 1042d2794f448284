//! Mirrors a SiGML document: elements with attributes, and their lines.
//!
//! SiGML has no text between its tags. [`sigml_convert`](super::sigml_convert) interprets the two spellings of signs.

use super::error::SigmlError;
use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use quick_xml::Reader;
use quick_xml::XmlVersion;
use quick_xml::errors::{Error as XmlError, SyntaxError};
use quick_xml::events::attributes::Attributes;
use quick_xml::events::{BytesDecl, Event};
use std::borrow::Cow;
use std::fmt::Write as _;

/// The longest file that is read, in bytes.
pub const MAX_SIGML_BYTES: usize = 64 << 20;
/// The most elements of a file.
pub const MAX_SIGML_ELEMENTS: usize = 1 << 20;
/// The most elements open at once; real files need 12.
pub const MAX_SIGML_DEPTH: usize = 64;
/// The most attributes of one element; SiGML's largest has 45.
pub const MAX_SIGML_ATTRIBUTES: usize = 64;

/// A text of the file, its references resolved.
pub type SigmlText<'a> = Cow<'a, str>;

/// An element with its contents.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SigmlElement<'a> {
    /// Its name, with a prefix if it has one.
    pub name: SigmlText<'a>,
    /// Its attributes in their order.
    pub attributes: Vec<(SigmlText<'a>, SigmlText<'a>)>,
    /// The elements in it.
    pub children: Vec<SigmlElement<'a>>,
    /// The line on which it starts.
    pub line: SigmlLine,
}

/// A line of the file that was read, counted from 1; 0 for an element that was not read. It is ignored in
/// comparisons.
#[derive(Debug, Clone, Copy, Default)]
pub struct SigmlLine(pub u64);

impl PartialEq for SigmlLine {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for SigmlLine {}

impl<'a> SigmlElement<'a> {
    /// Returns an element without attributes and children.
    #[must_use]
    pub fn new(name: impl Into<SigmlText<'a>>) -> Self {
        Self {
            name: name.into(),
            ..Self::default()
        }
    }

    /// Returns the first attribute of this name.
    #[must_use]
    pub fn find_attribute(&self, name: &str) -> Option<&str> {
        let attribute_pair = self.attributes.iter().find(|(known, _)| known == name);
        attribute_pair.map(|(_, value)| &**value)
    }
}

/// Reads the root element of a document.
///
/// A document type that names an external file is reported and not fetched; comments are reported and
/// dropped; text between tags is reported and left out.
///
/// # Errors
/// [`SigmlError`] if the bytes are not UTF-8, not well-formed XML, cut short, declare entities, or exceed the
/// limits of this module.
pub fn read_sigml_document(bytes: &[u8]) -> Result<(SigmlElement<'_>, Vec<ImportFinding>), SigmlError> {
    let text = decode_sigml_bytes(bytes)?;
    let mut reader = Reader::from_str(text);
    reader.config_mut().check_end_names = false;
    reader.config_mut().allow_dangling_amp = true;
    let mut builder = SigmlTreeBuilder {
        text,
        at: 0,
        line: 1,
        open: Vec::new(),
        root: None,
        elements: 0,
        astray: false,
        findings: FindingTally::default(),
    };
    loop {
        let event = match reader.read_event() {
            Ok(event) => event,
            Err(error) => return Err(builder.malformed_xml_error(&error, &reader)),
        };
        let end = usize::try_from(reader.buffer_position()).unwrap_or(text.len());
        if matches!(event, Event::Eof) {
            let (root, findings) = builder.finish_sigml_tree()?;
            return Ok((root, findings.finish_finding_tally()));
        }
        builder.take_xml_event(&event, end)?;
    }
}

/// Writes a document with this root element, indented by two blanks per level.
#[must_use]
pub fn write_sigml_document(root: &SigmlElement<'_>) -> Vec<u8> {
    let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    write_element(root, 0, &mut out);
    out.into_bytes()
}

fn write_element(element: &SigmlElement<'_>, depth: usize, out: &mut String) {
    let _ = write!(out, "{:1$}<{2}", "", depth * 2, element.name);
    for (name, value) in &element.attributes {
        let _ = write!(out, " {name}=\"");
        escape_sigml_text(value, out);
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

fn escape_sigml_text(text: &str, out: &mut String) {
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
fn local_element_name(name: &str) -> &str {
    name.rsplit_once(':').map_or(name, |(_, local)| local)
}

/// Builds elements from events.
struct SigmlTreeBuilder<'a> {
    text: &'a str,
    /// The byte up to which lines were counted.
    at: usize,
    line: u64,
    open: Vec<SigmlElement<'a>>,
    root: Option<SigmlElement<'a>>,
    elements: usize,
    /// Whether the last event was text where SiGML allows none.
    astray: bool,
    findings: FindingTally,
}

impl<'a> SigmlTreeBuilder<'a> {
    /// Takes the event that ends at byte `end`.
    fn take_xml_event(&mut self, event: &Event<'_>, end: usize) -> Result<(), SigmlError> {
        let astray = matches!(event, Event::Text(_) | Event::CData(_) | Event::GeneralRef(_));
        match event {
            Event::Start(tag) => {
                let element = self.read_tag_element(end - 1, tag.len(), tag.name().0.len())?;
                self.open.push(element);
                if self.open.len() > MAX_SIGML_DEPTH {
                    return Err(self.sigml_limit_error("elements are nested too deep", MAX_SIGML_DEPTH));
                }
            }
            Event::Empty(tag) => {
                let element = self.read_tag_element(end - 2, tag.len(), tag.name().0.len())?;
                self.close_sigml_element(element)?;
            }
            Event::End(tag) => self.end_open_element(tag.name().0)?,
            Event::Decl(declaration) => self.declaration(declaration)?,
            Event::DocType(doctype) => self.doctype(doctype)?,
            Event::Comment(_) | Event::PI(_) => self.report_sigml_finding("comments", |line| {
                ImportFinding::new_note_finding(line, "an XML comment or instruction is not kept")
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
    fn read_tag_element(&mut self, end: usize, len: usize, name: usize) -> Result<SigmlElement<'a>, SigmlError> {
        self.elements += 1;
        if self.elements > MAX_SIGML_ELEMENTS {
            return Err(self.sigml_limit_error("the file has too many elements", MAX_SIGML_ELEMENTS));
        }
        let (name, attributes) = self.text[end - len..end].split_at(name);
        let name = local_element_name(name);
        let mut element = SigmlElement {
            line: SigmlLine(self.line),
            ..SigmlElement::new(name)
        };
        for attribute in Attributes::new(attributes, 0).with_checks(false) {
            let Ok(attribute) = attribute else {
                return Err(SigmlError::Syntax {
                    line: self.line,
                    message: format!(
                        "<{}> has a broken attribute; write NAME=\"value\"",
                        shorten_sigml_text(name)
                    ),
                });
            };
            if element.attributes.len() == MAX_SIGML_ATTRIBUTES {
                return Err(self.sigml_limit_error("the element has too many attributes", MAX_SIGML_ATTRIBUTES));
            }
            let key = attribute.key.0;
            // It names the prefix that elements have, and is no part of a sign.
            if key.starts_with("xmlns:") {
                continue;
            }
            let value = match attribute.normalized_value(XmlVersion::Implicit1_0) {
                Ok(value) => value,
                Err(_) => {
                    self.report_sigml_finding("unknown references", |line| {
                        ImportFinding::new_warning_finding(line, "the value of an attribute holds a reference to nothing known; it was kept as it is written")
                            .with_remedy("write &amp; for an ampersand")
                    });
                    attribute.value
                }
            };
            if element.find_attribute(key).is_some() {
                let message = format!(
                    "<{}> has {} twice; the first one counts",
                    shorten_sigml_text(name),
                    shorten_sigml_text(key)
                );
                self.report_sigml_finding("attributes twice", |line| {
                    ImportFinding::new_warning_finding(line, message)
                });
            } else {
                element.attributes.push((Cow::Borrowed(key), value));
            }
        }
        Ok(element)
    }

    fn end_open_element(&mut self, name: &str) -> Result<(), SigmlError> {
        let name = local_element_name(name);
        let Some(element) = self.open.pop() else {
            return Err(SigmlError::Syntax {
                line: self.line,
                message: format!("</{}> closes nothing; take it away", shorten_sigml_text(name)),
            });
        };
        if element.name != name {
            let open = shorten_sigml_text(&element.name);
            let message = format!("</{}> closes <{open}>; write </{open}>", shorten_sigml_text(name));
            return Err(SigmlError::Syntax {
                line: self.line,
                message,
            });
        }
        self.close_sigml_element(element)
    }

    fn close_sigml_element(&mut self, element: SigmlElement<'a>) -> Result<(), SigmlError> {
        if let Some(parent) = self.open.last_mut() {
            parent.children.push(element);
        } else if self.root.is_none() {
            self.root = Some(element);
        } else {
            return Err(SigmlError::Syntax {
                line: element.line.0,
                message: format!(
                    "<{}> is a second root element; put all signs into one <sigml>",
                    shorten_sigml_text(&element.name)
                ),
            });
        }
        Ok(())
    }

    fn declaration(&self, declaration: &BytesDecl<'_>) -> Result<(), SigmlError> {
        let encoding = declaration.encoding().and_then(Result::ok);
        let encoding = encoding.unwrap_or("UTF-8".into());
        if ["utf-8", "utf8", "us-ascii"].contains(&&*encoding.to_ascii_lowercase()) || self.text.is_ascii() {
            return Ok(());
        }
        Err(SigmlError::Encoding {
            encoding: shorten_sigml_text(&encoding),
            line: self.line,
        })
    }

    fn doctype(&mut self, text: &str) -> Result<(), SigmlError> {
        if text.contains('[') {
            return Err(SigmlError::Entities { line: self.line });
        }
        self.report_sigml_finding("document types", |line| {
            ImportFinding::new_note_finding(line, "a document type is named; it is not fetched, and not kept")
        });
        Ok(())
    }

    fn stray(&mut self, end: usize) -> Result<(), SigmlError> {
        let text = self.text.get(self.at..end).unwrap_or_default();
        self.count_to(self.at + text.len() - text.trim_start().len());
        let Some(parent) = self.open.last() else {
            return match self.root {
                None => Err(SigmlError::NotXml { line: self.line }),
                Some(_) => {
                    self.report_sigml_finding("text after the end", |line| {
                        ImportFinding::new_warning_finding(line, "there is text after the end; it was left out")
                    });
                    Ok(())
                }
            };
        };
        let text = shorten_sigml_text(self.text.get(self.at..end).unwrap_or_default().trim());
        let message = format!(
            "there is text in <{}>: {text:?}; it was left out",
            shorten_sigml_text(&parent.name)
        );
        self.report_sigml_finding("text between elements", |line| {
            ImportFinding::new_warning_finding(line, message).with_remedy("SiGML says everything in attributes")
        });
        Ok(())
    }

    fn finish_sigml_tree(self) -> Result<(SigmlElement<'a>, FindingTally), SigmlError> {
        match (self.open.last(), self.root) {
            (Some(open), _) => Err(SigmlError::Truncated {
                line: self.line,
                open: shorten_sigml_text(&open.name),
            }),
            (None, Some(root)) => Ok((root, self.findings)),
            (None, None) => Err(SigmlError::NotXml { line: self.line }),
        }
    }

    fn malformed_xml_error(&self, error: &XmlError, reader: &Reader<&[u8]>) -> SigmlError {
        let error_offset = usize::try_from(reader.error_position()).unwrap_or(self.at);
        let line = sigml_line_at(self.text.as_bytes(), error_offset);
        match (error, self.open.last()) {
            (XmlError::Syntax(SyntaxError::InvalidBangMarkup), _) | (XmlError::IllFormed(_), _) => SigmlError::Syntax {
                line,
                message: format!("{error}; the element is not well-formed XML"),
            },
            (XmlError::Syntax(_), Some(open)) => SigmlError::Truncated {
                line: sigml_line_at(self.text.as_bytes(), self.text.len()),
                open: shorten_sigml_text(&open.name),
            },
            _ => SigmlError::NotXml { line },
        }
    }

    fn report_sigml_finding(&mut self, kind: &'static str, make: impl FnOnce(u64) -> ImportFinding) {
        let line = self.line;
        self.findings.add_limited_finding(kind, || make(line));
    }

    fn sigml_limit_error(&self, what: &'static str, limit: usize) -> SigmlError {
        SigmlError::Limit {
            line: self.line,
            what,
            limit,
        }
    }
}

fn is_blank(event: &Event<'_>) -> bool {
    matches!(event, Event::Text(text) if text.trim().is_empty())
}

fn decode_sigml_bytes(bytes: &[u8]) -> Result<&str, SigmlError> {
    if bytes.len() > MAX_SIGML_BYTES {
        return Err(SigmlError::Limit {
            line: 1,
            what: "the file has too many bytes",
            limit: MAX_SIGML_BYTES,
        });
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let wide = [&b"\xff\xfe"[..], b"\xfe\xff", b"<\0", b"\0<"];
    if wide.iter().any(|mark| bytes.starts_with(mark)) {
        return Err(SigmlError::Encoding {
            encoding: "UTF-16".into(),
            line: 1,
        });
    }
    let text = str::from_utf8(bytes).map_err(|error| {
        let line = sigml_line_at(bytes, error.valid_up_to());
        if memchr::memchr(0, bytes).is_some() {
            return SigmlError::NotXml { line };
        }
        SigmlError::Encoding {
            encoding: "an unknown encoding".into(),
            line,
        }
    })?;
    // Control characters are no XML in any spelling, and some readers pass over them.
    match text.find(|c| !is_xml(c)) {
        Some(at) => Err(SigmlError::NotXml {
            line: sigml_line_at(bytes, at),
        }),
        None => Ok(text),
    }
}

/// Returns the text, cut to 40 characters.
pub(super) fn shorten_sigml_text(text: &str) -> String {
    if text.chars().count() <= 40 {
        text.to_owned()
    } else {
        text.chars().take(40).chain(['…']).collect()
    }
}

fn sigml_line_at(bytes: &[u8], at: usize) -> u64 {
    memchr::memchr_iter(b'\n', &bytes[..at.min(bytes.len())]).count() as u64 + 1
}
