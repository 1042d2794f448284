//! Mirrors a collection: participants, a coding scheme, films, and utterances with tracks.

use super::TOOL;
use crate::eaf;
use crate::eaf::xml::{Cursor, Tag, line_of};
use crate::finding::Finding;
use crate::markup::{Error, Unread, attribute};
use std::borrow::Cow;

/// A text of the file, its references resolved.
pub type Text<'a> = Cow<'a, str>;

/// A collection.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Document<'a> {
    /// `AUTHOR`.
    pub author: Text<'a>,
    /// `PARTICIPANT`: the id, and the name.
    pub participants: Vec<(Text<'a>, Text<'a>)>,
    /// `FIELD` of the coding scheme.
    pub fields: Vec<Field<'a>>,
    /// `MEDIA-FILE`: the id, and the path.
    pub media: Vec<(Text<'a>, Text<'a>)>,
    /// The utterances in the order of the file.
    pub utterances: Vec<Utterance<'a>>,
    /// The text of the file, for line numbers.
    text: &'a str,
}

/// `FIELD`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Field<'a> {
    /// `ID`.
    pub id: Text<'a>,
    /// `NAME`.
    pub name: Text<'a>,
    /// `VALUE`: the id, and the name.
    pub values: Vec<(Text<'a>, Text<'a>)>,
}

/// `UTTERANCE`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Utterance<'a> {
    /// `ID`.
    pub id: Text<'a>,
    /// `S`, in milliseconds of the film.
    pub start: Text<'a>,
    /// `E`, in milliseconds of the film.
    pub end: Text<'a>,
    /// `MEDIA-REF`: ids of films.
    pub media: Vec<Text<'a>>,
    /// `TRACK`, of all segments.
    pub tracks: Vec<Track<'a>>,
    /// The byte at which it starts.
    pub at: usize,
}

/// `TRACK` of a `SEGMENT`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Track<'a> {
    /// `PARTICIPANT-ID` of the segment.
    pub participant: Text<'a>,
    /// `FID`: the id of a field.
    pub field: Text<'a>,
    /// `A`, in the order of the file.
    pub items: Vec<Item<'a>>,
}

/// `A`: an annotation.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Item<'a> {
    /// `S`, in milliseconds from the start of the utterance.
    pub start: Text<'a>,
    /// `E`, in milliseconds from the start of the utterance.
    pub end: Text<'a>,
    /// `VID`: the id of a value of the field.
    pub value: Option<Text<'a>>,
    /// Its text.
    pub text: Text<'a>,
    /// The byte at which it starts.
    pub at: usize,
}

impl Document<'_> {
    /// Returns the line of a byte of the file, counted from 1.
    #[must_use]
    pub fn line(&self, at: usize) -> u64 {
        line_of(self.text.as_bytes(), at)
    }
}

/// Reads the text of a collection.
///
/// # Errors
/// [`Error`] if it is no XML, cut short, declares entities, its root is not `<SIGNSTREAM-DATABASE>`, or it holds no
/// `<UTTERANCES>`.
pub fn read(text: &str) -> Result<(Document<'_>, Vec<Finding>), Error> {
    let (cursor, root) = TOOL.open(text)?;
    let mut reader = Reader {
        cursor,
        document: Document {
            text,
            ..Document::default()
        },
        unread: Unread::default(),
        has_utterances: false,
    };
    reader.root(&root).map_err(|error| Error::of(TOOL, error))?;
    if !reader.has_utterances {
        return Err(Error::Missing {
            tool: TOOL.name,
            line: root.line(),
            parent: TOOL.root,
            child: "UTTERANCES",
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
    has_utterances: bool,
}

impl<'a> Reader<'a> {
    fn root(&mut self, root: &Tag<'a>) -> Result<(), eaf::Error> {
        while let Some(child) = self.cursor.child(root)? {
            match child.name {
                "AUTHOR" => self.document.author = self.cursor.text(&child)?,
                "PARTICIPANTS" | "CODING-SCHEME" | "MEDIA-FILES" => {
                    while let Some(inner) = self.cursor.child(&child)? {
                        self.listed(&inner)?;
                    }
                }
                "UTTERANCES" => {
                    self.has_utterances = true;
                    while let Some(inner) = self.cursor.child(&child)? {
                        if inner.name == "UTTERANCE" {
                            self.utterance(&inner)?;
                        } else {
                            self.pass(&inner)?;
                        }
                    }
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

    fn take(&mut self, tag: &Tag<'a>, name: &str) -> Result<Text<'a>, eaf::Error> {
        Ok(attribute(&mut self.cursor, tag, name)?.unwrap_or_default())
    }

    /// Reads an element of one of the lists before the utterances.
    fn listed(&mut self, tag: &Tag<'a>) -> Result<(), eaf::Error> {
        let id = self.take(tag, "ID")?;
        match tag.name {
            "PARTICIPANT" => {
                let mut name = self.take(tag, "LABEL")?;
                if name.trim().is_empty() {
                    name = self.take(tag, "NAME")?;
                }
                self.document.participants.push((id, name));
            }
            "MEDIA-FILE" => {
                let mut path = self.take(tag, "LEGACY-PATH")?;
                for other in ["PATH", "URL", "NAME"] {
                    if path.trim().is_empty() {
                        path = self.take(tag, other)?;
                    }
                }
                self.document.media.push((id, path));
            }
            "FIELD" => {
                let name = self.take(tag, "NAME")?;
                let mut values = Vec::new();
                while let Some(value) = self.cursor.child(tag)? {
                    if value.name == "VALUE" {
                        let id = self.take(&value, "ID")?;
                        let name = self.take(&value, "NAME")?;
                        values.push((id, name));
                    }
                    self.cursor.skip(&value)?;
                }
                self.document.fields.push(Field { id, name, values });
                return Ok(());
            }
            _ => self.unread.count(tag.name),
        }
        self.cursor.skip(tag).map(|_| ())
    }

    fn utterance(&mut self, tag: &Tag<'a>) -> Result<(), eaf::Error> {
        let mut utterance = Utterance {
            at: tag.at().0 as usize,
            ..Utterance::default()
        };
        self.cursor.attributes(tag, |name, value| match name {
            "ID" => utterance.id = value,
            "S" => utterance.start = value,
            "E" => utterance.end = value,
            _ => {}
        })?;
        while let Some(child) = self.cursor.child(tag)? {
            match child.name {
                "MEDIA-REF" => {
                    let id = self.take(&child, "ID")?;
                    utterance.media.push(id);
                    self.cursor.skip(&child)?;
                }
                "SEGMENT" => {
                    let participant = self.take(&child, "PARTICIPANT-ID")?;
                    while let Some(inner) = self.cursor.child(&child)? {
                        if inner.name == "TRACK" {
                            let track = self.track(&inner, participant.clone())?;
                            utterance.tracks.push(track);
                        } else {
                            self.pass(&inner)?;
                        }
                    }
                }
                _ => self.pass(&child)?,
            }
        }
        self.document.utterances.push(utterance);
        Ok(())
    }

    fn track(&mut self, tag: &Tag<'a>, participant: Text<'a>) -> Result<Track<'a>, eaf::Error> {
        let field = self.take(tag, "FID")?;
        let mut items = Vec::new();
        while let Some(child) = self.cursor.child(tag)? {
            if child.name != "A" {
                self.pass(&child)?;
                continue;
            }
            let mut item = Item {
                at: child.at().0 as usize,
                ..Item::default()
            };
            self.cursor.attributes(&child, |name, value| match name {
                "S" => item.start = value,
                "E" => item.end = value,
                "VID" => item.value = Some(value),
                _ => {}
            })?;
            item.text = self.cursor.text(&child)?;
            items.push(item);
        }
        Ok(Track {
            participant,
            field,
            items,
        })
    }
}
