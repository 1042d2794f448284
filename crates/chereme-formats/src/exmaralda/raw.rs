//! Mirrors a basic transcription: speakers, a timeline, and tiers of events.

use super::TOOL;
use crate::eaf;
use crate::eaf::xml::{Cursor, Tag, line_of};
use crate::finding::Finding;
use crate::markup::{Error, Unread, attribute};
use std::borrow::Cow;

/// A text of the file, its references resolved.
pub type Text<'a> = Cow<'a, str>;

/// A basic transcription.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Document<'a> {
    /// `referenced-file`: addresses of films and sounds.
    pub files: Vec<Text<'a>>,
    /// Named texts of `meta-information`, such as `project-name`, and those that users named.
    pub properties: Vec<(Text<'a>, Text<'a>)>,
    /// `speaker`: the id, and the `abbreviation`.
    pub speakers: Vec<(Text<'a>, Text<'a>)>,
    /// `tli` of `common-timeline`, in their order.
    pub timeline: Vec<Point<'a>>,
    /// The tiers in the order of the file.
    pub tiers: Vec<Tier<'a>>,
    /// The text of the file, for line numbers.
    text: &'a str,
}

/// `tli`: a point of the timeline.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Point<'a> {
    /// `id`.
    pub id: Text<'a>,
    /// `time`, in seconds.
    pub time: Option<Text<'a>>,
    /// The byte at which it starts.
    pub at: usize,
}

/// `tier`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Tier<'a> {
    /// `id`.
    pub id: Text<'a>,
    /// `speaker`: the id of a speaker.
    pub speaker: Option<Text<'a>>,
    /// `category`, such as `v` for speech.
    pub category: Text<'a>,
    /// `display-name`.
    pub name: Option<Text<'a>>,
    /// `event`, in the order of the file.
    pub events: Vec<Event<'a>>,
    /// The byte at which it starts.
    pub at: usize,
}

/// `event`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Event<'a> {
    /// `start`: the id of a point.
    pub start: Text<'a>,
    /// `end`: the id of a point.
    pub end: Text<'a>,
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

/// Reads the text of a basic transcription.
///
/// # Errors
/// [`Error`] if it is no XML, cut short, declares entities, or its root is not `<basic-transcription>`.
pub fn read(text: &str) -> Result<(Document<'_>, Vec<Finding>), Error> {
    let (cursor, root) = TOOL.open(text)?;
    let mut reader = Reader {
        cursor,
        document: Document {
            text,
            ..Document::default()
        },
        unread: Unread::default(),
    };
    reader.root(&root).map_err(|error| Error::of(TOOL, error))?;
    let mut findings = reader.cursor.findings;
    reader.unread.report(&mut findings);
    Ok((reader.document, findings.finish()))
}

struct Reader<'a> {
    cursor: Cursor<'a>,
    document: Document<'a>,
    unread: Unread,
}

impl<'a> Reader<'a> {
    fn root(&mut self, root: &Tag<'a>) -> Result<(), eaf::Error> {
        while let Some(child) = self.cursor.child(root)? {
            match child.name {
                "head" => self.head(&child)?,
                "basic-body" | "body" => self.body(&child)?,
                // How tiers are shown.
                "tierformat-table" => self.skip(&child)?,
                _ => self.pass(&child)?,
            }
        }
        self.cursor.finish()
    }

    fn skip(&mut self, tag: &Tag<'a>) -> Result<(), eaf::Error> {
        self.cursor.skip(tag).map(|_| ())
    }

    /// Passes over an element and counts it.
    fn pass(&mut self, tag: &Tag<'a>) -> Result<(), eaf::Error> {
        self.unread.count(tag.name);
        self.skip(tag)
    }

    fn head(&mut self, head: &Tag<'a>) -> Result<(), eaf::Error> {
        while let Some(child) = self.cursor.child(head)? {
            match child.name {
                "meta-information" => self.about(&child)?,
                "speakertable" => {
                    while let Some(speaker) = self.cursor.child(&child)? {
                        if speaker.name == "speaker" {
                            self.speaker(&speaker)?;
                        } else {
                            self.pass(&speaker)?;
                        }
                    }
                }
                _ => self.pass(&child)?,
            }
        }
        Ok(())
    }

    fn about(&mut self, about: &Tag<'a>) -> Result<(), eaf::Error> {
        while let Some(child) = self.cursor.child(about)? {
            match child.name {
                "referenced-file" => {
                    let url = attribute(&mut self.cursor, &child, "url")?;
                    let url = url.filter(|url| !url.trim().is_empty());
                    self.document.files.extend(url);
                    self.skip(&child)?;
                }
                "ud-meta-information" => self.named(&child)?,
                name => {
                    let text = self.cursor.text(&child)?;
                    self.property(name.into(), text);
                }
            }
        }
        Ok(())
    }

    /// Reads the texts that users named.
    fn named(&mut self, tag: &Tag<'a>) -> Result<(), eaf::Error> {
        while let Some(child) = self.cursor.child(tag)? {
            let name = attribute(&mut self.cursor, &child, "attribute-name")?.unwrap_or_default();
            let text = self.cursor.text(&child)?;
            self.property(name, text);
        }
        Ok(())
    }

    fn property(&mut self, name: Text<'a>, text: Text<'a>) {
        if !text.trim().is_empty() {
            self.document.properties.push((name, text));
        }
    }

    fn speaker(&mut self, tag: &Tag<'a>) -> Result<(), eaf::Error> {
        let id = attribute(&mut self.cursor, tag, "id")?.unwrap_or_default();
        let mut short = Text::default();
        while let Some(child) = self.cursor.child(tag)? {
            if child.name == "abbreviation" {
                short = self.cursor.text(&child)?;
            } else {
                // Ages, languages and the like of people have no place in a transcript.
                self.skip(&child)?;
            }
        }
        self.document.speakers.push((id, short));
        Ok(())
    }

    fn body(&mut self, body: &Tag<'a>) -> Result<(), eaf::Error> {
        while let Some(child) = self.cursor.child(body)? {
            match child.name {
                "common-timeline" => {
                    while let Some(point) = self.cursor.child(&child)? {
                        if point.name == "tli" {
                            self.point(&point)?;
                        }
                        self.skip(&point)?;
                    }
                }
                "tier" => self.tier(&child)?,
                _ => self.pass(&child)?,
            }
        }
        Ok(())
    }

    fn point(&mut self, tag: &Tag<'a>) -> Result<(), eaf::Error> {
        let mut point = Point {
            at: tag.at().0 as usize,
            ..Point::default()
        };
        self.cursor.attributes(tag, |name, value| match name {
            "id" => point.id = value,
            "time" => point.time = Some(value),
            _ => {}
        })?;
        self.document.timeline.push(point);
        Ok(())
    }

    fn tier(&mut self, tag: &Tag<'a>) -> Result<(), eaf::Error> {
        let mut tier = Tier {
            at: tag.at().0 as usize,
            ..Tier::default()
        };
        self.cursor.attributes(tag, |name, value| match name {
            "id" => tier.id = value,
            "speaker" => tier.speaker = Some(value),
            "category" => tier.category = value,
            "display-name" => tier.name = Some(value),
            _ => {}
        })?;
        while let Some(child) = self.cursor.child(tag)? {
            match child.name {
                "event" => {
                    let event = self.event(&child)?;
                    tier.events.push(event);
                }
                _ => self.pass(&child)?,
            }
        }
        self.document.tiers.push(tier);
        Ok(())
    }

    fn event(&mut self, tag: &Tag<'a>) -> Result<Event<'a>, eaf::Error> {
        let mut event = Event {
            at: tag.at().0 as usize,
            ..Event::default()
        };
        self.cursor.attributes(tag, |name, value| match name {
            "start" => event.start = value,
            "end" => event.end = value,
            _ => {}
        })?;
        let mut inner = Vec::new();
        event.text = self.cursor.text_and_elements(tag, &mut inner)?;
        for inner in inner {
            self.unread.count(inner.name);
        }
        Ok(event)
    }
}
