//! Mirrors a document of SPPAS: metadata, media, tiers with alternatives, and links between tiers.

use std::borrow::Cow;

use super::SPPAS_TOOL;
use crate::eaf;
use crate::eaf::xml::{XmlCursor, XmlStartTag, line_at_byte};
use crate::finding::ImportFinding;
use crate::markup::{MarkupError, UnreadElements, find_tag_attribute};

/// A text of the file, its references resolved.
pub type XraText<'a> = Cow<'a, str>;

/// A document of SPPAS.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct XraDocument<'a> {
    /// `author`.
    pub author: XraText<'a>,
    /// `date` of the last save.
    pub date: XraText<'a>,
    /// `Entry` of `Metadata`: keys with their texts.
    pub properties: Vec<(XraText<'a>, XraText<'a>)>,
    /// `url` of `Media`.
    pub media: Vec<XraText<'a>>,
    /// The tiers in the order of the file.
    pub tiers: Vec<XraTier<'a>>,
    /// `Link` of `Hierarchy`.
    pub links: Vec<XraLink<'a>>,
    /// The text of the file, for line numbers.
    text: &'a str,
}

/// `Tier`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct XraTier<'a> {
    /// `id`.
    pub id: XraText<'a>,
    /// `tiername`.
    pub name: XraText<'a>,
    /// `Entry` of its `Metadata`.
    pub properties: Vec<(XraText<'a>, XraText<'a>)>,
    /// Its annotations in the order of the file.
    pub annotations: Vec<XraAnnotation<'a>>,
    /// The byte at which it starts.
    pub at: usize,
}

/// `Annotation`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct XraAnnotation<'a> {
    /// `id`; empty before format 1.4.
    pub id: XraText<'a>,
    /// The alternatives of its `Location`.
    pub places: Vec<XraPlace<'a>>,
    /// The alternatives (`Tag`) of each `Label`.
    pub labels: Vec<Vec<XraText<'a>>>,
    /// The byte at which it starts.
    pub at: usize,
}

/// `Point`, `Interval` or `Disjoint`: a place in time, in seconds as they are written.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct XraPlace<'a> {
    /// The middle of the first point.
    pub begin: XraText<'a>,
    /// The middle of the last point; `None` for a point in time.
    pub end: Option<XraText<'a>>,
    /// `score`; the alternative with the highest one is the best.
    pub score: Option<XraText<'a>>,
    /// The number of intervals between both points.
    pub pieces: usize,
}

/// `Link`: a tier whose times another one follows.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct XraLink<'a> {
    /// `TimeAlignment` (every border of `to` is one of `from`) or `TimeAssociation` (both have the same intervals).
    pub kind: XraText<'a>,
    /// The id of the tier that states the times.
    pub from: XraText<'a>,
    /// The id of the tier that follows.
    pub to: XraText<'a>,
}

impl XraDocument<'_> {
    /// Returns the line of a byte of the file, counted from 1.
    #[must_use]
    pub fn xra_line_at(&self, at: usize) -> u64 {
        line_at_byte(self.text.as_bytes(), at)
    }
}

/// Reads the text of a document.
///
/// # Errors
/// [`MarkupError`] if it is no XML, cut short, declares entities, or its root is not `<Document>`.
pub fn read_xra_document(text: &str) -> Result<(XraDocument<'_>, Vec<ImportFinding>), MarkupError> {
    let (cursor, root) = SPPAS_TOOL.open_markup_root(text)?;
    let mut reader = XraReader {
        cursor,
        unread: UnreadElements::default(),
    };
    let mut document = XraDocument {
        text,
        ..XraDocument::default()
    };
    reader
        .read_xra_root(&root, &mut document)
        .map_err(|error| MarkupError::from_eaf_error(SPPAS_TOOL, error))?;
    let mut findings = reader.cursor.findings;
    reader.unread.report_unread_elements(&mut findings);
    Ok((document, findings.finish_finding_tally()))
}

struct XraReader<'a> {
    cursor: XmlCursor<'a>,
    unread: UnreadElements,
}

impl<'a> XraReader<'a> {
    fn read_xra_root(&mut self, root: &XmlStartTag<'a>, document: &mut XraDocument<'a>) -> Result<(), eaf::EafError> {
        document.author = self.tag_attribute(root, "author")?;
        document.date = self.tag_attribute(root, "date")?;
        while let Some(child) = self.cursor.next_child_tag(root)? {
            match child.name {
                "Metadata" => self.read_metadata(&child, &mut document.properties)?,
                "Media" => {
                    document.media.push(self.tag_attribute(&child, "url")?);
                    // A film that is embedded is left out, and its tiers are all tiers.
                    self.cursor.skip_xml_element(&child)?;
                }
                "Tier" => document.tiers.push(self.read_xra_tier(&child)?),
                "Hierarchy" => {
                    while let Some(link) = self.cursor.next_child_tag(&child)? {
                        document.links.push(XraLink {
                            kind: self.tag_attribute(&link, "type")?,
                            from: self.tag_attribute(&link, "from")?,
                            to: self.tag_attribute(&link, "to")?,
                        });
                        self.cursor.skip_xml_element(&link)?;
                    }
                }
                _ => self.pass_xra_element(&child)?,
            }
        }
        self.cursor.check_document_end()
    }

    /// Returns an attribute, in any case as old versions write it; empty if it is missing.
    fn tag_attribute(&mut self, tag: &XmlStartTag<'a>, wanted: &str) -> Result<XraText<'a>, eaf::EafError> {
        let mut first_value = None;
        self.cursor.visit_tag_attributes(tag, |name, value| {
            if name.eq_ignore_ascii_case(wanted) && first_value.is_none() {
                first_value = Some(value);
            }
        })?;
        Ok(first_value.unwrap_or_default())
    }

    /// Passes over an element and counts it.
    fn pass_xra_element(&mut self, tag: &XmlStartTag<'a>) -> Result<(), eaf::EafError> {
        self.unread.count_unread_element(tag.name);
        self.cursor.skip_xml_element(tag).map(|_| ())
    }

    fn read_metadata(
        &mut self,
        tag: &XmlStartTag<'a>,
        properties: &mut Vec<(XraText<'a>, XraText<'a>)>,
    ) -> Result<(), eaf::EafError> {
        while let Some(entry) = self.cursor.next_child_tag(tag)? {
            let key = self.tag_attribute(&entry, "key")?;
            let text = self.read_trimmed_text(&entry)?;
            properties.push((key, text));
        }
        Ok(())
    }

    /// Returns the text of an element without the blanks around it, which only lay out the file.
    fn read_trimmed_text(&mut self, tag: &XmlStartTag<'a>) -> Result<XraText<'a>, eaf::EafError> {
        Ok(match self.cursor.read_tag_text(tag)? {
            Cow::Borrowed(text) => Cow::Borrowed(text.trim()),
            Cow::Owned(text) => Cow::Owned(text.trim().to_owned()),
        })
    }

    fn read_xra_tier(&mut self, tag: &XmlStartTag<'a>) -> Result<XraTier<'a>, eaf::EafError> {
        let mut tier = XraTier {
            id: self.tag_attribute(tag, "id")?,
            name: self.tag_attribute(tag, "tiername")?,
            at: tag.start_tag_position().0 as usize,
            ..XraTier::default()
        };
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            match child.name {
                "Metadata" => self.read_metadata(&child, &mut tier.properties)?,
                "Annotation" => {
                    let annotation = self.read_xra_annotation(&child)?;
                    tier.annotations.push(annotation);
                }
                _ => self.pass_xra_element(&child)?,
            }
        }
        Ok(tier)
    }

    fn read_xra_annotation(&mut self, tag: &XmlStartTag<'a>) -> Result<XraAnnotation<'a>, eaf::EafError> {
        let mut annotation = XraAnnotation {
            id: self.tag_attribute(tag, "id")?,
            at: tag.start_tag_position().0 as usize,
            ..XraAnnotation::default()
        };
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            match child.name {
                "Location" => self.read_places(&child, None, &mut annotation.places)?,
                "Label" => {
                    let mut alternatives = Vec::new();
                    while let Some(alternative) = self.cursor.next_child_tag(&child)? {
                        alternatives.push(self.read_trimmed_text(&alternative)?);
                    }
                    annotation.labels.push(alternatives);
                }
                // The provenance of an annotation has no place in a transcript.
                "Metadata" => self.cursor.skip_xml_element(&child).map(|_| ())?,
                _ => self.pass_xra_element(&child)?,
            }
        }
        Ok(annotation)
    }

    /// Reads the alternatives of a location. Version 1.2 and older wrap each in a `Localization`, which has the score, and
    /// call them `TimePoint` and `TimeInterval`.
    fn read_places(
        &mut self,
        tag: &XmlStartTag<'a>,
        outer_score: Option<XraText<'a>>,
        places: &mut Vec<XraPlace<'a>>,
    ) -> Result<(), eaf::EafError> {
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            let score = find_tag_attribute(&mut self.cursor, &child, "score")?.or_else(|| outer_score.clone());
            match child.name {
                "Localization" => self.read_places(&child, score, places)?,
                "Disjoint" | "TimeDisjoint" => {
                    let mut pieces = Vec::new();
                    self.read_places(&child, None, &mut pieces)?;
                    if let (Some(first), Some(last)) = (pieces.first(), pieces.last()) {
                        places.push(XraPlace {
                            begin: first.begin.clone(),
                            end: last.end.clone(),
                            score,
                            pieces: pieces.len(),
                        });
                    }
                }
                name if name.ends_with("Interval") => {
                    let mut bounds = Vec::new();
                    while let Some(bound) = self.cursor.next_child_tag(&child)? {
                        bounds.push(self.tag_attribute(&bound, "midpoint")?);
                        self.cursor.skip_xml_element(&bound)?;
                    }
                    let end = bounds.pop();
                    let begin = bounds.pop().unwrap_or_default();
                    places.push(XraPlace {
                        begin,
                        end,
                        score,
                        pieces: 1,
                    });
                }
                name if name.ends_with("Point") => {
                    let begin = self.tag_attribute(&child, "midpoint")?;
                    places.push(XraPlace {
                        begin,
                        end: None,
                        score,
                        pieces: 1,
                    });
                    self.cursor.skip_xml_element(&child)?;
                }
                _ => self.pass_xra_element(&child)?,
            }
        }
        Ok(())
    }
}
