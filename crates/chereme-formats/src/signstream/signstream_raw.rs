//! Mirrors a collection: participants, a coding scheme, films, and utterances with tracks.

use super::SIGNSTREAM_TOOL;
use crate::eaf;
use crate::eaf::xml::{XmlCursor, XmlStartTag, line_at_byte};
use crate::finding::ImportFinding;
use crate::markup::{MarkupError, UnreadElements, find_tag_attribute};
use std::borrow::Cow;

/// A text of the file, its references resolved.
pub type SignstreamText<'a> = Cow<'a, str>;

/// A collection.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SignstreamDocument<'a> {
    /// `AUTHOR`.
    pub author: SignstreamText<'a>,
    /// `PARTICIPANT`: the id, and the name.
    pub participants: Vec<(SignstreamText<'a>, SignstreamText<'a>)>,
    /// `FIELD` of the coding scheme.
    pub fields: Vec<SignstreamField<'a>>,
    /// `MEDIA-FILE`: the id, and the path.
    pub media: Vec<(SignstreamText<'a>, SignstreamText<'a>)>,
    /// The utterances in the order of the file.
    pub utterances: Vec<SignstreamUtterance<'a>>,
    /// The text of the file, for line numbers.
    text: &'a str,
}

/// `FIELD`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SignstreamField<'a> {
    /// `ID`.
    pub id: SignstreamText<'a>,
    /// `NAME`.
    pub name: SignstreamText<'a>,
    /// `VALUE`: the id, and the name.
    pub values: Vec<(SignstreamText<'a>, SignstreamText<'a>)>,
}

/// `UTTERANCE`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SignstreamUtterance<'a> {
    /// `ID`.
    pub id: SignstreamText<'a>,
    /// `S`, in milliseconds of the film.
    pub start: SignstreamText<'a>,
    /// `E`, in milliseconds of the film.
    pub end: SignstreamText<'a>,
    /// `MEDIA-REF`: ids of films.
    pub media: Vec<SignstreamText<'a>>,
    /// `TRACK`, of all segments.
    pub tracks: Vec<SignstreamTrack<'a>>,
    /// The byte at which it starts.
    pub at: usize,
}

/// `TRACK` of a `SEGMENT`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SignstreamTrack<'a> {
    /// `PARTICIPANT-ID` of the segment.
    pub participant: SignstreamText<'a>,
    /// `FID`: the id of a field.
    pub field: SignstreamText<'a>,
    /// `A`, in the order of the file.
    pub items: Vec<SignstreamItem<'a>>,
}

/// `A`: an annotation.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SignstreamItem<'a> {
    /// `S`, in milliseconds from the start of the utterance.
    pub start: SignstreamText<'a>,
    /// `E`, in milliseconds from the start of the utterance.
    pub end: SignstreamText<'a>,
    /// `VID`: the id of a value of the field.
    pub value: Option<SignstreamText<'a>>,
    /// Its text.
    pub text: SignstreamText<'a>,
    /// The byte at which it starts.
    pub at: usize,
}

impl SignstreamDocument<'_> {
    /// Returns the line of a byte of the file, counted from 1.
    #[must_use]
    pub fn signstream_line_at(&self, at: usize) -> u64 {
        line_at_byte(self.text.as_bytes(), at)
    }
}

/// Reads the text of a collection.
///
/// # Errors
/// [`MarkupError`] if it is no XML, cut short, declares entities, its root is not `<SIGNSTREAM-DATABASE>`, or it holds no
/// `<UTTERANCES>`.
pub fn read_signstream_document(text: &str) -> Result<(SignstreamDocument<'_>, Vec<ImportFinding>), MarkupError> {
    let (cursor, root) = SIGNSTREAM_TOOL.open_markup_root(text)?;
    let mut reader = SignstreamReader {
        cursor,
        document: SignstreamDocument {
            text,
            ..SignstreamDocument::default()
        },
        unread: UnreadElements::default(),
        has_utterances: false,
    };
    reader
        .read_database_root(&root)
        .map_err(|error| MarkupError::from_eaf_error(SIGNSTREAM_TOOL, error))?;
    if !reader.has_utterances {
        return Err(MarkupError::Missing {
            tool: SIGNSTREAM_TOOL.name,
            line: root.start_tag_line(),
            parent: SIGNSTREAM_TOOL.root,
            child: "UTTERANCES",
        });
    }
    let mut findings = reader.cursor.findings;
    reader.unread.report_unread_elements(&mut findings);
    Ok((reader.document, findings.finish_finding_tally()))
}

struct SignstreamReader<'a> {
    cursor: XmlCursor<'a>,
    document: SignstreamDocument<'a>,
    unread: UnreadElements,
    has_utterances: bool,
}

impl<'a> SignstreamReader<'a> {
    fn read_database_root(&mut self, root: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        while let Some(child) = self.cursor.next_child_tag(root)? {
            match child.name {
                "AUTHOR" => self.document.author = self.cursor.read_tag_text(&child)?,
                "PARTICIPANTS" | "CODING-SCHEME" | "MEDIA-FILES" => {
                    while let Some(inner) = self.cursor.next_child_tag(&child)? {
                        self.read_listed_element(&inner)?;
                    }
                }
                "UTTERANCES" => {
                    self.has_utterances = true;
                    while let Some(inner) = self.cursor.next_child_tag(&child)? {
                        if inner.name == "UTTERANCE" {
                            self.utterance(&inner)?;
                        } else {
                            self.pass_over_element(&inner)?;
                        }
                    }
                }
                _ => self.pass_over_element(&child)?,
            }
        }
        self.cursor.check_document_end()
    }

    /// Passes over an element and counts it.
    fn pass_over_element(&mut self, tag: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        self.unread.count_unread_element(tag.name);
        self.cursor.skip_xml_element(tag).map(|_| ())
    }

    fn take_tag_attribute(&mut self, tag: &XmlStartTag<'a>, name: &str) -> Result<SignstreamText<'a>, eaf::EafError> {
        Ok(find_tag_attribute(&mut self.cursor, tag, name)?.unwrap_or_default())
    }

    /// Reads an element of one of the lists before the utterances.
    fn read_listed_element(&mut self, tag: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        let id = self.take_tag_attribute(tag, "ID")?;
        match tag.name {
            "PARTICIPANT" => {
                let mut name = self.take_tag_attribute(tag, "LABEL")?;
                if name.trim().is_empty() {
                    name = self.take_tag_attribute(tag, "NAME")?;
                }
                self.document.participants.push((id, name));
            }
            "MEDIA-FILE" => {
                let mut path = self.take_tag_attribute(tag, "LEGACY-PATH")?;
                for other in ["PATH", "URL", "NAME"] {
                    if path.trim().is_empty() {
                        path = self.take_tag_attribute(tag, other)?;
                    }
                }
                self.document.media.push((id, path));
            }
            "FIELD" => {
                let name = self.take_tag_attribute(tag, "NAME")?;
                let mut values = Vec::new();
                while let Some(value) = self.cursor.next_child_tag(tag)? {
                    if value.name == "VALUE" {
                        let id = self.take_tag_attribute(&value, "ID")?;
                        let name = self.take_tag_attribute(&value, "NAME")?;
                        values.push((id, name));
                    }
                    self.cursor.skip_xml_element(&value)?;
                }
                self.document.fields.push(SignstreamField { id, name, values });
                return Ok(());
            }
            _ => self.unread.count_unread_element(tag.name),
        }
        self.cursor.skip_xml_element(tag).map(|_| ())
    }

    fn utterance(&mut self, tag: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        let mut utterance = SignstreamUtterance {
            at: tag.start_tag_position().0 as usize,
            ..SignstreamUtterance::default()
        };
        self.cursor.visit_tag_attributes(tag, |name, value| match name {
            "ID" => utterance.id = value,
            "S" => utterance.start = value,
            "E" => utterance.end = value,
            _ => {}
        })?;
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            match child.name {
                "MEDIA-REF" => {
                    let id = self.take_tag_attribute(&child, "ID")?;
                    utterance.media.push(id);
                    self.cursor.skip_xml_element(&child)?;
                }
                "SEGMENT" => {
                    let participant = self.take_tag_attribute(&child, "PARTICIPANT-ID")?;
                    while let Some(inner) = self.cursor.next_child_tag(&child)? {
                        if inner.name == "TRACK" {
                            let track = self.read_segment_track(&inner, participant.clone())?;
                            utterance.tracks.push(track);
                        } else {
                            self.pass_over_element(&inner)?;
                        }
                    }
                }
                _ => self.pass_over_element(&child)?,
            }
        }
        self.document.utterances.push(utterance);
        Ok(())
    }

    fn read_segment_track(
        &mut self,
        tag: &XmlStartTag<'a>,
        participant: SignstreamText<'a>,
    ) -> Result<SignstreamTrack<'a>, eaf::EafError> {
        let field = self.take_tag_attribute(tag, "FID")?;
        let mut items = Vec::new();
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            if child.name != "A" {
                self.pass_over_element(&child)?;
                continue;
            }
            let mut item = SignstreamItem {
                at: child.start_tag_position().0 as usize,
                ..SignstreamItem::default()
            };
            self.cursor.visit_tag_attributes(&child, |name, value| match name {
                "S" => item.start = value,
                "E" => item.end = value,
                "VID" => item.value = Some(value),
                _ => {}
            })?;
            item.text = self.cursor.read_tag_text(&child)?;
            items.push(item);
        }
        Ok(SignstreamTrack {
            participant,
            field,
            items,
        })
    }
}
