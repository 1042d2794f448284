//! Mirrors an annotation file of ANVIL: its head, and tracks of elements with attributes.

use super::ANVIL_TOOL;
use crate::eaf;
use crate::eaf::xml::{XmlCursor, XmlStartTag, line_at_byte};
use crate::finding::ImportFinding;
use crate::markup::{MarkupError, UnreadElements, find_tag_attribute};
use std::borrow::Cow;

/// A text of the file, its references resolved.
pub type AnvilText<'a> = Cow<'a, str>;

/// An annotation file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct AnvilDocument<'a> {
    /// `specification`: the file of the coding scheme.
    pub specification: Option<AnvilText<'a>>,
    /// `video` and other elements of the head that name a file, by their names.
    pub media: Vec<(&'a str, AnvilText<'a>)>,
    /// `info`: keys with their texts.
    pub infos: Vec<(AnvilText<'a>, AnvilText<'a>)>,
    /// The tracks in the order of the file.
    pub tracks: Vec<AnvilTrack<'a>>,
    /// `set`: the name, and the number of its elements, which have no times.
    pub sets: Vec<(AnvilText<'a>, u64)>,
    /// The text of the file, for line numbers.
    text: &'a str,
}

/// `track`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct AnvilTrack<'a> {
    /// `name`, with the names of its groups before it: `Gesture.Phase`.
    pub name: AnvilText<'a>,
    /// `type`: `primary`, `primarypoint`, `singleton`, `span` or `subdivision`.
    pub kind: AnvilText<'a>,
    /// `ref`: the name of the track that this one refers to.
    pub reference: Option<AnvilText<'a>>,
    /// `el`, in the order of the file.
    pub elements: Vec<AnvilElement<'a>>,
    /// `el-group`: the index of the element that its elements divide.
    pub groups: Vec<Option<AnvilText<'a>>>,
    /// The byte at which it starts.
    pub at: usize,
}

/// `el`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct AnvilElement<'a> {
    /// `index`, by which others refer to it.
    pub index: Option<AnvilText<'a>>,
    /// `start`: a time in seconds, or the index of an element.
    pub start: Option<AnvilText<'a>>,
    /// `end`: a time in seconds, or the index of an element.
    pub end: Option<AnvilText<'a>>,
    /// `time` of a point, in seconds.
    pub time: Option<AnvilText<'a>>,
    /// `ref`: the index of an element.
    pub reference: Option<AnvilText<'a>>,
    /// The group of the track that it belongs to.
    pub group: Option<usize>,
    /// `attribute`, in the order of the file.
    pub attributes: Vec<AnvilAttribute<'a>>,
    /// `comment`.
    pub comment: Option<AnvilText<'a>>,
    /// The byte at which it starts.
    pub at: usize,
}

/// `attribute`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct AnvilAttribute<'a> {
    /// `name`.
    pub name: AnvilText<'a>,
    /// Its text.
    pub text: AnvilText<'a>,
    /// Links to other elements: the track and the index.
    pub links: Vec<(AnvilText<'a>, AnvilText<'a>)>,
}

impl AnvilDocument<'_> {
    /// Returns the line of a byte of the file, counted from 1.
    #[must_use]
    pub fn anvil_line_at(&self, at: usize) -> u64 {
        line_at_byte(self.text.as_bytes(), at)
    }
}

/// Reads the text of an annotation file.
///
/// # Errors
/// [`MarkupError`] if it is no XML, cut short, declares entities, or its root is not `<annotation>`.
pub fn read_anvil_document(text: &str) -> Result<(AnvilDocument<'_>, Vec<ImportFinding>), MarkupError> {
    let (cursor, root) = ANVIL_TOOL.open_markup_root(text)?;
    let mut reader = AnvilReader {
        cursor,
        document: AnvilDocument {
            text,
            ..AnvilDocument::default()
        },
        unread: UnreadElements::default(),
        has_body: false,
    };
    reader
        .read_anvil_root(&root)
        .map_err(|error| MarkupError::from_eaf_error(ANVIL_TOOL, error))?;
    // Other programs call their root <annotation>, too.
    if !reader.has_body {
        return Err(MarkupError::Missing {
            tool: ANVIL_TOOL.name,
            line: root.start_tag_line(),
            parent: ANVIL_TOOL.root,
            child: "body",
        });
    }
    let mut findings = reader.cursor.findings;
    reader.unread.report_unread_elements(&mut findings);
    Ok((reader.document, findings.finish_finding_tally()))
}

struct AnvilReader<'a> {
    cursor: XmlCursor<'a>,
    document: AnvilDocument<'a>,
    unread: UnreadElements,
    has_body: bool,
}

impl<'a> AnvilReader<'a> {
    fn read_anvil_root(&mut self, root: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        while let Some(child) = self.cursor.next_child_tag(root)? {
            match child.name {
                "head" => self.read_anvil_head(&child)?,
                "body" => {
                    self.has_body = true;
                    self.read_anvil_body(&child)?;
                }
                _ => self.pass_anvil_element(&child)?,
            }
        }
        self.cursor.check_document_end()
    }

    /// Passes over an element and counts it.
    fn pass_anvil_element(&mut self, tag: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        self.unread.count_unread_element(tag.name);
        self.cursor.skip_xml_element(tag).map(|_| ())
    }

    fn read_anvil_head(&mut self, head: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        while let Some(child) = self.cursor.next_child_tag(head)? {
            let source = find_tag_attribute(&mut self.cursor, &child, "src")?;
            match (child.name, source) {
                ("specification", source) => {
                    self.document.specification = source;
                    self.cursor.skip_xml_element(&child)?;
                }
                ("info", _) => {
                    let key = find_tag_attribute(&mut self.cursor, &child, "key")?.unwrap_or_default();
                    let text = self.cursor.read_tag_text(&child)?;
                    self.document.infos.push((key, trim_layout_blanks(text)));
                }
                (name, Some(source)) => {
                    self.document.media.push((name, source));
                    self.cursor.skip_xml_element(&child)?;
                }
                _ => self.pass_anvil_element(&child)?,
            }
        }
        Ok(())
    }

    fn read_anvil_body(&mut self, body: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        while let Some(child) = self.cursor.next_child_tag(body)? {
            match child.name {
                "track" => self.read_anvil_track(&child)?,
                "set" => {
                    let name = find_tag_attribute(&mut self.cursor, &child, "name")?.unwrap_or_default();
                    let mut many = 0;
                    while let Some(inner) = self.cursor.next_child_tag(&child)? {
                        many += 1;
                        self.cursor.skip_xml_element(&inner)?;
                    }
                    self.document.sets.push((name, many));
                }
                _ => self.pass_anvil_element(&child)?,
            }
        }
        Ok(())
    }

    fn read_anvil_track(&mut self, tag: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        let mut track = AnvilTrack {
            at: tag.start_tag_position().0 as usize,
            ..AnvilTrack::default()
        };
        self.cursor.visit_tag_attributes(tag, |name, value| match name {
            "name" => track.name = value,
            "type" => track.kind = value,
            "ref" => track.reference = Some(value),
            _ => {}
        })?;
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            match child.name {
                "el" => {
                    let element = self.read_anvil_element(&child, None)?;
                    track.elements.push(element);
                }
                "el-group" => {
                    let group = track.groups.len();
                    let reference = find_tag_attribute(&mut self.cursor, &child, "ref")?;
                    track.groups.push(reference);
                    while let Some(inner) = self.cursor.next_child_tag(&child)? {
                        if inner.name == "el" {
                            let element = self.read_anvil_element(&inner, Some(group))?;
                            track.elements.push(element);
                        } else {
                            self.pass_anvil_element(&inner)?;
                        }
                    }
                }
                _ => self.pass_anvil_element(&child)?,
            }
        }
        self.document.tracks.push(track);
        Ok(())
    }

    fn read_anvil_element(
        &mut self,
        tag: &XmlStartTag<'a>,
        group: Option<usize>,
    ) -> Result<AnvilElement<'a>, eaf::EafError> {
        let mut element = AnvilElement {
            at: tag.start_tag_position().0 as usize,
            group,
            ..AnvilElement::default()
        };
        self.cursor.visit_tag_attributes(tag, |name, value| match name {
            "index" => element.index = Some(value),
            "start" => element.start = Some(value),
            "end" => element.end = Some(value),
            "time" => element.time = Some(value),
            "ref" => element.reference = Some(value),
            _ => {}
        })?;
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            match child.name {
                "attribute" => {
                    let attribute = self.read_anvil_attribute(&child)?;
                    element.attributes.push(attribute);
                }
                "comment" => {
                    let text = self.cursor.read_tag_text(&child)?;
                    element.comment = Some(trim_layout_blanks(text));
                }
                _ => self.pass_anvil_element(&child)?,
            }
        }
        Ok(element)
    }

    fn read_anvil_attribute(&mut self, tag: &XmlStartTag<'a>) -> Result<AnvilAttribute<'a>, eaf::EafError> {
        let name = find_tag_attribute(&mut self.cursor, tag, "name")?.unwrap_or_default();
        let mut inner = Vec::new();
        let text = self.cursor.text_and_elements(tag, &mut inner)?;
        let mut links = Vec::new();
        for inner in inner {
            let (mut track, mut index) = (None, None);
            self.cursor.visit_tag_attributes(&inner, |name, value| match name {
                "ref-track" | "track" => track = Some(value),
                "ref-index" | "index" => index = Some(value),
                _ => {}
            })?;
            match (track, index) {
                (Some(track), Some(index)) => links.push((track, index)),
                _ => self.unread.count_unread_element(inner.name),
            }
        }
        Ok(AnvilAttribute {
            name,
            text: trim_layout_blanks(text),
            links,
        })
    }
}

/// Returns a text without the blanks around it, which come from the layout of the file.
fn trim_layout_blanks(text: AnvilText<'_>) -> AnvilText<'_> {
    match text {
        Cow::Borrowed(text) => Cow::Borrowed(text.trim()),
        Cow::Owned(text) => Cow::Owned(text.trim().to_owned()),
    }
}
