//! Mirrors a basic transcription: speakers, a timeline, and tiers of events.

use super::EXMARALDA_TOOL;
use crate::eaf;
use crate::eaf::xml::{XmlCursor, XmlStartTag, line_at_byte};
use crate::finding::ImportFinding;
use crate::markup::{MarkupError, UnreadElements, find_tag_attribute};
use std::borrow::Cow;

/// A text of the file, its references resolved.
pub type ExmaraldaText<'a> = Cow<'a, str>;

/// A basic transcription.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ExmaraldaDocument<'a> {
    /// `referenced-file`: addresses of films and sounds.
    pub files: Vec<ExmaraldaText<'a>>,
    /// Named texts of `meta-information`, such as `project-name`, and those that users named.
    pub properties: Vec<(ExmaraldaText<'a>, ExmaraldaText<'a>)>,
    /// `speaker`: the id, and the `abbreviation`.
    pub speakers: Vec<(ExmaraldaText<'a>, ExmaraldaText<'a>)>,
    /// `tli` of `common-timeline`, in their order.
    pub timeline: Vec<TimelinePoint<'a>>,
    /// The tiers in the order of the file.
    pub tiers: Vec<ExmaraldaTier<'a>>,
    /// The text of the file, for line numbers.
    text: &'a str,
}

/// `tli`: a point of the timeline.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct TimelinePoint<'a> {
    /// `id`.
    pub id: ExmaraldaText<'a>,
    /// `time`, in seconds.
    pub time: Option<ExmaraldaText<'a>>,
    /// The byte at which it starts.
    pub at: usize,
}

/// `tier`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ExmaraldaTier<'a> {
    /// `id`.
    pub id: ExmaraldaText<'a>,
    /// `speaker`: the id of a speaker.
    pub speaker: Option<ExmaraldaText<'a>>,
    /// `category`, such as `v` for speech.
    pub category: ExmaraldaText<'a>,
    /// `display-name`.
    pub name: Option<ExmaraldaText<'a>>,
    /// `event`, in the order of the file.
    pub events: Vec<ExmaraldaEvent<'a>>,
    /// The byte at which it starts.
    pub at: usize,
}

/// `event`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ExmaraldaEvent<'a> {
    /// `start`: the id of a point.
    pub start: ExmaraldaText<'a>,
    /// `end`: the id of a point.
    pub end: ExmaraldaText<'a>,
    /// Its text.
    pub text: ExmaraldaText<'a>,
    /// The byte at which it starts.
    pub at: usize,
}

impl ExmaraldaDocument<'_> {
    /// Returns the line of a byte of the file, counted from 1.
    #[must_use]
    pub fn exmaralda_line_at(&self, at: usize) -> u64 {
        line_at_byte(self.text.as_bytes(), at)
    }
}

/// Reads the text of a basic transcription.
///
/// # Errors
/// [`MarkupError`] if it is no XML, cut short, declares entities, or its root is not `<basic-transcription>`.
pub fn read_exmaralda_document(text: &str) -> Result<(ExmaraldaDocument<'_>, Vec<ImportFinding>), MarkupError> {
    let (cursor, root) = EXMARALDA_TOOL.open_markup_root(text)?;
    let mut reader = ExmaraldaReader {
        cursor,
        document: ExmaraldaDocument {
            text,
            ..ExmaraldaDocument::default()
        },
        unread: UnreadElements::default(),
    };
    reader
        .read_exmaralda_root(&root)
        .map_err(|error| MarkupError::from_eaf_error(EXMARALDA_TOOL, error))?;
    let mut findings = reader.cursor.findings;
    reader.unread.report_unread_elements(&mut findings);
    Ok((reader.document, findings.finish_finding_tally()))
}

struct ExmaraldaReader<'a> {
    cursor: XmlCursor<'a>,
    document: ExmaraldaDocument<'a>,
    unread: UnreadElements,
}

impl<'a> ExmaraldaReader<'a> {
    fn read_exmaralda_root(&mut self, root: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        while let Some(child) = self.cursor.next_child_tag(root)? {
            match child.name {
                "head" => self.read_exmaralda_head(&child)?,
                "basic-body" | "body" => self.read_exmaralda_body(&child)?,
                // How tiers are shown.
                "tierformat-table" => self.skip_exmaralda_element(&child)?,
                _ => self.pass_exmaralda_element(&child)?,
            }
        }
        self.cursor.check_document_end()
    }

    fn skip_exmaralda_element(&mut self, tag: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        self.cursor.skip_xml_element(tag).map(|_| ())
    }

    /// Passes over an element and counts it.
    fn pass_exmaralda_element(&mut self, tag: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        self.unread.count_unread_element(tag.name);
        self.skip_exmaralda_element(tag)
    }

    fn read_exmaralda_head(&mut self, head: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        while let Some(child) = self.cursor.next_child_tag(head)? {
            match child.name {
                "meta-information" => self.read_meta_information(&child)?,
                "speakertable" => {
                    while let Some(speaker) = self.cursor.next_child_tag(&child)? {
                        if speaker.name == "speaker" {
                            self.speaker(&speaker)?;
                        } else {
                            self.pass_exmaralda_element(&speaker)?;
                        }
                    }
                }
                _ => self.pass_exmaralda_element(&child)?,
            }
        }
        Ok(())
    }

    fn read_meta_information(&mut self, about: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        while let Some(child) = self.cursor.next_child_tag(about)? {
            match child.name {
                "referenced-file" => {
                    let stated_url = find_tag_attribute(&mut self.cursor, &child, "url")?;
                    let url = stated_url.filter(|url| !url.trim().is_empty());
                    self.document.files.extend(url);
                    self.skip_exmaralda_element(&child)?;
                }
                "ud-meta-information" => self.read_user_properties(&child)?,
                name => {
                    let text = self.cursor.read_tag_text(&child)?;
                    self.add_document_property(name.into(), text);
                }
            }
        }
        Ok(())
    }

    /// Reads the texts that users named.
    fn read_user_properties(&mut self, tag: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            let name = find_tag_attribute(&mut self.cursor, &child, "attribute-name")?.unwrap_or_default();
            let text = self.cursor.read_tag_text(&child)?;
            self.add_document_property(name, text);
        }
        Ok(())
    }

    fn add_document_property(&mut self, name: ExmaraldaText<'a>, text: ExmaraldaText<'a>) {
        if !text.trim().is_empty() {
            self.document.properties.push((name, text));
        }
    }

    fn speaker(&mut self, tag: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        let id = find_tag_attribute(&mut self.cursor, tag, "id")?.unwrap_or_default();
        let mut short = ExmaraldaText::default();
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            if child.name == "abbreviation" {
                short = self.cursor.read_tag_text(&child)?;
            } else {
                // Ages, languages and the like of people have no place in a transcript.
                self.skip_exmaralda_element(&child)?;
            }
        }
        self.document.speakers.push((id, short));
        Ok(())
    }

    fn read_exmaralda_body(&mut self, body: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        while let Some(child) = self.cursor.next_child_tag(body)? {
            match child.name {
                "common-timeline" => {
                    while let Some(point) = self.cursor.next_child_tag(&child)? {
                        if point.name == "tli" {
                            self.read_timeline_point(&point)?;
                        }
                        self.skip_exmaralda_element(&point)?;
                    }
                }
                "tier" => self.read_exmaralda_tier(&child)?,
                _ => self.pass_exmaralda_element(&child)?,
            }
        }
        Ok(())
    }

    fn read_timeline_point(&mut self, tag: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        let mut point = TimelinePoint {
            at: tag.start_tag_position().0 as usize,
            ..TimelinePoint::default()
        };
        self.cursor.visit_tag_attributes(tag, |name, value| match name {
            "id" => point.id = value,
            "time" => point.time = Some(value),
            _ => {}
        })?;
        self.document.timeline.push(point);
        Ok(())
    }

    fn read_exmaralda_tier(&mut self, tag: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        let mut tier = ExmaraldaTier {
            at: tag.start_tag_position().0 as usize,
            ..ExmaraldaTier::default()
        };
        self.cursor.visit_tag_attributes(tag, |name, value| match name {
            "id" => tier.id = value,
            "speaker" => tier.speaker = Some(value),
            "category" => tier.category = value,
            "display-name" => tier.name = Some(value),
            _ => {}
        })?;
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            match child.name {
                "event" => {
                    let event = self.read_exmaralda_event(&child)?;
                    tier.events.push(event);
                }
                _ => self.pass_exmaralda_element(&child)?,
            }
        }
        self.document.tiers.push(tier);
        Ok(())
    }

    fn read_exmaralda_event(&mut self, tag: &XmlStartTag<'a>) -> Result<ExmaraldaEvent<'a>, eaf::EafError> {
        let mut event = ExmaraldaEvent {
            at: tag.start_tag_position().0 as usize,
            ..ExmaraldaEvent::default()
        };
        self.cursor.visit_tag_attributes(tag, |name, value| match name {
            "start" => event.start = value,
            "end" => event.end = value,
            _ => {}
        })?;
        let mut inner = Vec::new();
        event.text = self.cursor.text_and_elements(tag, &mut inner)?;
        for inner in inner {
            self.unread.count_unread_element(inner.name);
        }
        Ok(event)
    }
}
