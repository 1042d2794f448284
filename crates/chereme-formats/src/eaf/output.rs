//! Writes elements in the spelling of a file.

use super::raw::Kept;
use super::style::Style;
use std::io::{self, Write};

/// An attribute: its name, and its value if it has one.
pub(super) type Pair<'p> = (&'p str, Option<&'p str>);

/// Writes elements to `out` in a style.
pub(super) struct Output<'s, W: Write> {
    pub(super) out: W,
    pub(super) style: &'s Style,
    indent: String,
}

/// Returns the text of the elements that `write` writes in a style at an indentation: from the first tag on, without
/// the last line end.
pub(super) fn written(
    style: &Style,
    indent: &str,
    write: impl FnOnce(&mut Output<'_, Vec<u8>>) -> io::Result<()>,
) -> Option<String> {
    let mut xml = Output::new(Vec::new(), style, indent);
    write(&mut xml).ok()?;
    let text = String::from_utf8(xml.out).ok()?;
    let inner = text.strip_suffix(style.newline)?;
    Some(inner.get(indent.len()..)?.to_owned())
}

impl<'s, W: Write> Output<'s, W> {
    pub(super) fn new(out: W, style: &'s Style, indent: &str) -> Self {
        Self {
            out,
            style,
            indent: indent.to_owned(),
        }
    }

    fn tag(
        &mut self,
        name: &str,
        pairs: &[Pair<'_>],
        kept: &Kept<'_>,
        end: &str,
    ) -> io::Result<()> {
        let own = pairs
            .iter()
            .filter_map(|(name, value)| Some((*name, (*value)?)));
        let more = kept.iter().flat_map(|kept| &kept.attributes);
        let attributes: Vec<(&str, &str)> = own
            .chain(more.map(|(name, value)| (&**name, &**value)))
            .collect();
        let tag = self.style.tag(&self.indent, name, &attributes);
        write!(self.out, "{}{tag}{end}", self.indent)
    }

    fn end_line(&mut self) -> io::Result<()> {
        self.out.write_all(self.style.newline.as_bytes())
    }

    /// Writes an element without children, except for its kept ones.
    pub(super) fn leaf(
        &mut self,
        name: &str,
        pairs: &[Pair<'_>],
        kept: &Kept<'_>,
    ) -> io::Result<()> {
        self.element(name, pairs, kept, true, |_| Ok(()))
    }

    /// Writes an element with the children that `inner` writes; no children if it is `empty`.
    pub(super) fn element(
        &mut self,
        name: &str,
        pairs: &[Pair<'_>],
        kept: &Kept<'_>,
        empty: bool,
        inner: impl FnOnce(&mut Self) -> io::Result<()>,
    ) -> io::Result<()> {
        let more = kept.iter().flat_map(|kept| &kept.elements);
        if empty && more.clone().next().is_none() {
            self.tag(name, pairs, kept, self.style.close())?;
            return self.end_line();
        }
        self.tag(name, pairs, kept, ">")?;
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
    pub(super) fn text(
        &mut self,
        name: &str,
        pairs: &[Pair<'_>],
        kept: &Kept<'_>,
        text: &str,
    ) -> io::Result<()> {
        if text.is_empty() && !self.style.pairs(name) {
            self.tag(name, pairs, kept, self.style.close())?;
            return self.end_line();
        }
        self.tag(name, pairs, kept, ">")?;
        let text = self.style.escape(text, None);
        write!(self.out, "{text}</{name}>")?;
        self.end_line()
    }
}
