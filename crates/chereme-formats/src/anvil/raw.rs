//! Mirrors an annotation file of ANVIL: its head, and tracks of elements with attributes.

use super::TOOL;
use crate::eaf;
use crate::eaf::xml::{Cursor, Tag, line_of};
use crate::finding::Finding;
use crate::markup::{Error, Unread, attribute};
use std::borrow::Cow;

/// A text of the file, its references resolved.
pub type Text<'a> = Cow<'a, str>;

/// An annotation file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Document<'a> {
    /// `specification`: the file of the coding scheme.
    pub specification: Option<Text<'a>>,
    /// `video` and other elements of the head that name a file, by their names.
    pub media: Vec<(&'a str, Text<'a>)>,
    /// `info`: keys with their texts.
    pub infos: Vec<(Text<'a>, Text<'a>)>,
    /// The tracks in the order of the file.
    pub tracks: Vec<Track<'a>>,
    /// `set`: the name, and the number of its elements, which have no times.
    pub sets: Vec<(Text<'a>, u64)>,
    /// The text of the file, for line numbers.
    text: &'a str,
}

/// `track`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Track<'a> {
    /// `name`, with the names of its groups before it: `Gesture.Phase`.
    pub name: Text<'a>,
    /// `type`: `primary`, `primarypoint`, `singleton`, `span` or `subdivision`.
    pub kind: Text<'a>,
    /// `ref`: the name of the track that this one refers to.
    pub reference: Option<Text<'a>>,
    /// `el`, in the order of the file.
    pub elements: Vec<Element<'a>>,
    /// `el-group`: the index of the element that its elements divide.
    pub groups: Vec<Option<Text<'a>>>,
    /// The byte at which it starts.
    pub at: usize,
}

/// `el`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Element<'a> {
    /// `index`, by which others refer to it.
    pub index: Option<Text<'a>>,
    /// `start`: a time in seconds, or the index of an element.
    pub start: Option<Text<'a>>,
    /// `end`: a time in seconds, or the index of an element.
    pub end: Option<Text<'a>>,
    /// `time` of a point, in seconds.
    pub time: Option<Text<'a>>,
    /// `ref`: the index of an element.
    pub reference: Option<Text<'a>>,
    /// The group of the track that it belongs to.
    pub group: Option<usize>,
    /// `attribute`, in the order of the file.
    pub attributes: Vec<Attribute<'a>>,
    /// `comment`.
    pub comment: Option<Text<'a>>,
    /// The byte at which it starts.
    pub at: usize,
}

/// `attribute`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Attribute<'a> {
    /// `name`.
    pub name: Text<'a>,
    /// Its text.
    pub text: Text<'a>,
    /// Links to other elements: the track and the index.
    pub links: Vec<(Text<'a>, Text<'a>)>,
}

impl Document<'_> {
    /// Returns the line of a byte of the file, counted from 1.
    #[must_use]
    pub fn line(&self, at: usize) -> u64 {
        line_of(self.text.as_bytes(), at)
    }
}

/// Reads the text of an annotation file.
///
/// # Errors
/// [`Error`] if it is no XML, cut short, declares entities, or its root is not `<annotation>`.
pub fn read(text: &str) -> Result<(Document<'_>, Vec<Finding>), Error> {
    let (cursor, root) = TOOL.open(text)?;
    let mut reader = Reader {
        cursor,
        document: Document {
            text,
            ..Document::default()
        },
        unread: Unread::default(),
        has_body: false,
    };
    reader.root(&root).map_err(|error| Error::of(TOOL, error))?;
    // Other programs call their root <annotation>, too.
    if !reader.has_body {
        return Err(Error::Missing {
            tool: TOOL.name,
            line: root.line(),
            parent: TOOL.root,
            child: "body",
        });
    }
    let mut findings = reader.cursor.findings;
    reader.unread.report(&mut findings);
    Ok((reader.document, findings.finish()))
}

struct Reader<'a> {
    cursor: Cursor<'a>,
    document: Document<'a>,
    unread: Unread,
    has_body: bool,
}

impl<'a> Reader<'a> {
    fn root(&mut self, root: &Tag<'a>) -> Result<(), eaf::Error> {
        while let Some(child) = self.cursor.child(root)? {
            match child.name {
                "head" => self.head(&child)?,
                "body" => {
                    self.has_body = true;
                    self.body(&child)?;
                }
                _ => self.pass(&child)?,
            }
        }
        self.cursor.finish()
    }

    /// Passes over an element and counts it.
    fn pass(&mut self, tag: &Tag<'a>) -> Result<(), eaf::Error> {
        self.unread.count(tag.name);
        self.cursor.skip(tag).map(|_| ())
    }

    fn head(&mut self, head: &Tag<'a>) -> Result<(), eaf::Error> {
        while let Some(child) = self.cursor.child(head)? {
            let source = attribute(&mut self.cursor, &child, "src")?;
            match (child.name, source) {
                ("specification", source) => {
                    self.document.specification = source;
                    self.cursor.skip(&child)?;
                }
                ("info", _) => {
                    let key = attribute(&mut self.cursor, &child, "key")?.unwrap_or_default();
                    let text = self.cursor.text(&child)?;
                    self.document.infos.push((key, trimmed(text)));
                }
                (name, Some(source)) => {
                    self.document.media.push((name, source));
                    self.cursor.skip(&child)?;
                }
                _ => self.pass(&child)?,
            }
        }
        Ok(())
    }

    fn body(&mut self, body: &Tag<'a>) -> Result<(), eaf::Error> {
        while let Some(child) = self.cursor.child(body)? {
            match child.name {
                "track" => self.track(&child)?,
                "set" => {
                    let name = attribute(&mut self.cursor, &child, "name")?.unwrap_or_default();
                    let mut many = 0;
                    while let Some(inner) = self.cursor.child(&child)? {
                        many += 1;
                        self.cursor.skip(&inner)?;
                    }
                    self.document.sets.push((name, many));
                }
                _ => self.pass(&child)?,
            }
        }
        Ok(())
    }

    fn track(&mut self, tag: &Tag<'a>) -> Result<(), eaf::Error> {
        let mut track = Track {
            at: tag.at().0 as usize,
            ..Track::default()
        };
        self.cursor.attributes(tag, |name, value| match name {
            "name" => track.name = value,
            "type" => track.kind = value,
            "ref" => track.reference = Some(value),
            _ => {}
        })?;
        while let Some(child) = self.cursor.child(tag)? {
            match child.name {
                "el" => {
                    let element = self.element(&child, None)?;
                    track.elements.push(element);
                }
                "el-group" => {
                    let group = track.groups.len();
                    let reference = attribute(&mut self.cursor, &child, "ref")?;
                    track.groups.push(reference);
                    while let Some(inner) = self.cursor.child(&child)? {
                        if inner.name == "el" {
                            let element = self.element(&inner, Some(group))?;
                            track.elements.push(element);
                        } else {
                            self.pass(&inner)?;
                        }
                    }
                }
                _ => self.pass(&child)?,
            }
        }
        self.document.tracks.push(track);
        Ok(())
    }

    fn element(&mut self, tag: &Tag<'a>, group: Option<usize>) -> Result<Element<'a>, eaf::Error> {
        let mut element = Element {
            at: tag.at().0 as usize,
            group,
            ..Element::default()
        };
        self.cursor.attributes(tag, |name, value| match name {
            "index" => element.index = Some(value),
            "start" => element.start = Some(value),
            "end" => element.end = Some(value),
            "time" => element.time = Some(value),
            "ref" => element.reference = Some(value),
            _ => {}
        })?;
        while let Some(child) = self.cursor.child(tag)? {
            match child.name {
                "attribute" => {
                    let attribute = self.attribute(&child)?;
                    element.attributes.push(attribute);
                }
                "comment" => {
                    let text = self.cursor.text(&child)?;
                    element.comment = Some(trimmed(text));
                }
                _ => self.pass(&child)?,
            }
        }
        Ok(element)
    }

    fn attribute(&mut self, tag: &Tag<'a>) -> Result<Attribute<'a>, eaf::Error> {
        let name = attribute(&mut self.cursor, tag, "name")?.unwrap_or_default();
        let mut inner = Vec::new();
        let text = self.cursor.text_and_elements(tag, &mut inner)?;
        let mut links = Vec::new();
        for inner in inner {
            let (mut track, mut index) = (None, None);
            self.cursor.attributes(&inner, |name, value| match name {
                "ref-track" | "track" => track = Some(value),
                "ref-index" | "index" => index = Some(value),
                _ => {}
            })?;
            match (track, index) {
                (Some(track), Some(index)) => links.push((track, index)),
                _ => self.unread.count(inner.name),
            }
        }
        Ok(Attribute {
            name,
            text: trimmed(text),
            links,
        })
    }
}

/// Returns a text without the blanks around it, which come from the layout of the file.
fn trimmed(text: Text<'_>) -> Text<'_> {
    match text {
        Cow::Borrowed(text) => Cow::Borrowed(text.trim()),
        Cow::Owned(text) => Cow::Owned(text.trim().to_owned()),
    }
}
