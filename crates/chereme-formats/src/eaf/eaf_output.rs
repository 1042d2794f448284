//! Writes elements in the spelling of a file.

use super::eaf_raw::KeptContents;
use super::style::EafSpelling;
use std::io::{self, Write};

/// An attribute: its name, and its value if it has one.
pub(super) type AttributePair<'p> = (&'p str, Option<&'p str>);

/// Writes elements to `out` in a style.
pub(super) struct XmlOutput<'s, W: Write> {
    pub(super) out: W,
    pub(super) style: &'s EafSpelling,
    indent: String,
}

/// Returns the text of the elements that `write` writes in a style at an indentation: from the first tag on, without
/// the last line end.
pub(super) fn render_eaf_elements(
    style: &EafSpelling,
    indent: &str,
    write: impl FnOnce(&mut XmlOutput<'_, Vec<u8>>) -> io::Result<()>,
) -> Option<String> {
    let mut xml = XmlOutput::new(Vec::new(), style, indent);
    write(&mut xml).ok()?;
    let text = String::from_utf8(xml.out).ok()?;
    let inner = text.strip_suffix(style.newline)?;
    Some(inner.get(indent.len()..)?.to_owned())
}

impl<'s, W: Write> XmlOutput<'s, W> {
    pub(super) fn new(out: W, style: &'s EafSpelling, indent: &str) -> Self {
        Self {
            out,
            style,
            indent: indent.to_owned(),
        }
    }

    fn write_start_tag(
        &mut self,
        name: &str,
        pairs: &[AttributePair<'_>],
        kept: &KeptContents<'_>,
        end: &str,
    ) -> io::Result<()> {
        let present_pairs = pairs.iter().filter_map(|(name, value)| Some((*name, (*value)?)));
        let more = kept.iter().flat_map(|kept| &kept.attributes);
        let attributes: Vec<(&str, &str)> = present_pairs
            .chain(more.map(|(name, value)| (&**name, &**value)))
            .collect();
        let tag = self.style.format_start_tag(&self.indent, name, &attributes);
        write!(self.out, "{}{tag}{end}", self.indent)
    }

    fn end_line(&mut self) -> io::Result<()> {
        self.out.write_all(self.style.newline.as_bytes())
    }

    /// Writes an element without children, except for its kept ones.
    pub(super) fn write_leaf_element(
        &mut self,
        name: &str,
        pairs: &[AttributePair<'_>],
        kept: &KeptContents<'_>,
    ) -> io::Result<()> {
        self.write_parent_element(name, pairs, kept, true, |_| Ok(()))
    }

    /// Writes an element with the children that `inner` writes; no children if it is `empty`.
    pub(super) fn write_parent_element(
        &mut self,
        name: &str,
        pairs: &[AttributePair<'_>],
        kept: &KeptContents<'_>,
        empty: bool,
        inner: impl FnOnce(&mut Self) -> io::Result<()>,
    ) -> io::Result<()> {
        let more = kept.iter().flat_map(|kept| &kept.elements);
        if empty && more.clone().next().is_none() {
            self.write_start_tag(name, pairs, kept, self.style.empty_tag_end())?;
            return self.end_line();
        }
        self.write_start_tag(name, pairs, kept, ">")?;
        self.end_line()?;
        let outer = self.indent.len();
        self.indent.push_str(&self.style.unit);
        inner(self)?;
        for source in more {
            write!(self.out, "{}{source}", self.indent)?;
            self.end_line()?;
        }
        self.indent.truncate(outer);
        write!(self.out, "{}</{name}>", self.indent)?;
        self.end_line()
    }

    /// Writes an element that holds a text.
    pub(super) fn write_text_element(
        &mut self,
        name: &str,
        pairs: &[AttributePair<'_>],
        kept: &KeptContents<'_>,
        text: &str,
    ) -> io::Result<()> {
        if text.is_empty() && !self.style.needs_tag_pair(name) {
            self.write_start_tag(name, pairs, kept, self.style.empty_tag_end())?;
            return self.end_line();
        }
        self.write_start_tag(name, pairs, kept, ">")?;
        let text = self.style.escape_xml_text(text, None);
        write!(self.out, "{text}</{name}>")?;
        self.end_line()
    }
}
