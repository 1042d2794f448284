//! The elements of a file as a tree; a format takes the ones that it knows.

use std::borrow::Cow;

use super::{MarkupError, MarkupTool, UnreadElements};
use crate::eaf;
use crate::eaf::xml::{XmlCursor, XmlStartTag};
use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use crate::transcript::AnnotationTranscript;

/// The part of an element that a format reads.
#[derive(Debug, Clone, Copy)]
pub(crate) enum MarkupContents {
    /// Its elements; the text between them is reported.
    Elements,
    /// Its text; the elements in it are reported.
    Text,
    /// Its text, and the attributes of the elements in it.
    TextWithElements,
    /// Its attributes alone; the rest has no place in a transcript.
    Attributes,
}

/// Returns what is read of an element below the element with the name before it; an element without an answer is passed
/// over and counted.
pub(crate) type MarkupGrammar = fn(&str, &MarkupElement<'_>) -> Option<MarkupContents>;

/// An element with what was read of it.
#[derive(Debug, Clone)]
pub(crate) struct MarkupElement<'a> {
    tag: XmlStartTag<'a>,
    attributes: Vec<(&'a str, Cow<'a, str>)>,
    /// The elements in it.
    pub(crate) children: Vec<MarkupElement<'a>>,
    /// Its text, its references resolved.
    pub(crate) text: Cow<'a, str>,
}

impl<'a> MarkupElement<'a> {
    /// Returns the name.
    pub(crate) fn element_name(&self) -> &'a str {
        self.tag.name
    }

    /// Returns the line of its tag, counted from 1; counting takes time.
    pub(crate) fn element_line(&self) -> u64 {
        self.tag.start_tag_line()
    }

    /// Returns an attribute, in any case as old programs write it.
    pub(crate) fn stated_attribute(&self, wanted: &str) -> Option<&str> {
        let mut attributes = self.attributes.iter();
        let attribute = attributes.find(|(name, _)| name.eq_ignore_ascii_case(wanted))?;
        Some(&attribute.1)
    }

    /// Returns an attribute; empty if it is missing.
    pub(crate) fn attribute_text(&self, wanted: &str) -> &str {
        self.stated_attribute(wanted).unwrap_or_default()
    }

    /// Returns the elements at the end of a path of names below this one.
    pub(crate) fn elements_at(&self, path: &[&str]) -> Vec<&Self> {
        let mut level = vec![self];
        for name in path {
            let below = level.into_iter().flat_map(|element| &element.children);
            level = below.filter(|child| child.tag.name == *name).collect();
        }
        level
    }
}

/// Builds the tree.
struct TreeReader<'a> {
    cursor: XmlCursor<'a>,
    grammar: MarkupGrammar,
    unread: UnreadElements,
}

impl<'a> TreeReader<'a> {
    fn read_attributes(&mut self, tag: XmlStartTag<'a>) -> Result<MarkupElement<'a>, eaf::EafError> {
        let mut attributes = Vec::new();
        self.cursor
            .visit_tag_attributes(&tag, |name, value| attributes.push((name, value)))?;
        Ok(MarkupElement {
            tag,
            attributes,
            children: Vec::new(),
            text: Cow::Borrowed(""),
        })
    }

    fn read_contents(
        &mut self,
        element: &mut MarkupElement<'a>,
        contents: MarkupContents,
    ) -> Result<(), eaf::EafError> {
        let tag = element.tag;
        match contents {
            MarkupContents::Attributes => self.cursor.skip_xml_element(&tag).map(|_| ()),
            MarkupContents::Text => {
                element.text = self.cursor.read_tag_text(&tag)?;
                Ok(())
            }
            MarkupContents::TextWithElements => {
                let mut inner_tags = Vec::new();
                element.text = self.cursor.text_and_elements(&tag, &mut inner_tags)?;
                for inner in inner_tags {
                    let child = self.read_attributes(inner)?;
                    match (self.grammar)(tag.name, &child) {
                        Some(_) => element.children.push(child),
                        None => self.unread.count_unread_element(inner.name),
                    }
                }
                Ok(())
            }
            MarkupContents::Elements => {
                while let Some(inner) = self.cursor.next_child_tag(&tag)? {
                    let mut child = self.read_attributes(inner)?;
                    if let Some(contents) = (self.grammar)(tag.name, &child) {
                        self.read_contents(&mut child, contents)?;
                        element.children.push(child);
                    } else {
                        self.unread.count_unread_element(inner.name);
                        self.cursor.skip_xml_element(&inner)?;
                    }
                }
                Ok(())
            }
        }
    }
}

impl MarkupTool {
    /// Reads the tiers of a file: its tree by `grammar`, and their meaning by `convert`.
    pub(crate) fn read_markup_file(
        self,
        bytes: &[u8],
        grammar: MarkupGrammar,
        convert: impl FnOnce(&MarkupElement<'_>, &mut FindingTally) -> Result<AnnotationTranscript, MarkupError>,
    ) -> Result<(AnnotationTranscript, Vec<ImportFinding>), MarkupError> {
        let of_tool = |error| MarkupError::from_eaf_error(self, error);
        let decoded = eaf::decode_eaf(bytes).map_err(of_tool)?;
        let mut findings = decoded.findings;
        // These files are not written again.
        findings.retain(|finding| !finding.message.contains("written so again"));
        let (root, mut tally) = self.read_markup_tree(&decoded.text, grammar).map_err(of_tool)?;
        findings.append(&mut tally);
        let mut converted = FindingTally::default();
        let transcript = convert(&root, &mut converted)?;
        findings.extend(converted.finish_finding_tally());
        Ok((transcript, findings))
    }

    fn read_markup_tree<'t>(
        self,
        text: &'t str,
        grammar: MarkupGrammar,
    ) -> Result<(MarkupElement<'t>, Vec<ImportFinding>), eaf::EafError> {
        let mut reader = TreeReader {
            cursor: XmlCursor::new_with_type(text.as_bytes())?,
            grammar,
            unread: UnreadElements::default(),
        };
        let root = reader.cursor.read_root_tag(self.root)?;
        let mut root = reader.read_attributes(root)?;
        reader.read_contents(&mut root, MarkupContents::Elements)?;
        reader.cursor.check_document_end()?;
        let mut findings = reader.cursor.findings;
        reader.unread.report_unread_elements(&mut findings);
        Ok((root, findings.finish_finding_tally()))
    }

    /// Returns the error of a file whose root has no element of this name.
    pub(crate) fn check_child_element(self, root: &MarkupElement<'_>, child: &'static str) -> Result<(), MarkupError> {
        if !root.elements_at(&[child]).is_empty() {
            return Ok(());
        }
        Err(MarkupError::Missing {
            tool: self.name,
            line: root.element_line(),
            parent: self.root,
            child,
        })
    }
}
