//! How a file spells its XML: line ends, indentation, quotes, entities, and where start tags break.

use super::eaf_layout::EafLayout;
use super::xml::is_xml;
use std::collections::BTreeMap;

/// Start tags of ELAN 5 and 6 break before an attribute that would go beyond this column.
const TAG_BREAK_COLUMN: usize = 72;

/// The spelling of a file.
#[derive(Debug, Clone)]
pub(super) struct EafSpelling {
    /// The line end; empty if elements share lines.
    pub(super) newline: &'static str,
    /// The indentation of a level.
    pub(super) unit: String,
    /// Whether long start tags break.
    pub(super) wraps: bool,
    quote: char,
    /// Whether a blank stands before `/>`.
    blank: bool,
    /// Whether an empty value has two tags.
    pair: bool,
    /// Whether apostrophes in texts are written as references.
    apostrophe: bool,
    /// Whether quotation marks in texts are written as references.
    quotation: bool,
    /// The attributes of each element in the order of the file.
    order: BTreeMap<String, Vec<String>>,
}

impl EafSpelling {
    /// Returns the spelling of ELAN 5 and 6: attributes in alphabetical order, breaks at column 72.
    pub(super) fn elan_spelling() -> Self {
        Self {
            newline: "\n",
            unit: "    ".to_owned(),
            wraps: true,
            quote: '"',
            blank: false,
            pair: false,
            apostrophe: false,
            quotation: false,
            order: BTreeMap::new(),
        }
    }

    /// Returns the spelling of a text.
    pub(super) fn spelling_from_layout(layout: &EafLayout<'_>) -> Self {
        let text = layout.text;
        let lines = text.matches('\n').count();
        // Files that several programs wrote mix the ends of lines; the most frequent one counts.
        let newline = match (2 * text.matches("\r\n").count() > lines, lines) {
            (true, _) => "\r\n",
            (false, 0) if text.contains('\r') => "\r",
            (false, 0) => "",
            (false, _) => "\n",
        };
        let mut all = 0..layout.elements.len();
        let child = all.find_map(|element| layout.element_indent(element).filter(|indent| !indent.is_empty()));
        let mut style = Self {
            newline: if child.is_some() || lines > layout.elements.len() / 2 {
                newline
            } else {
                ""
            },
            unit: child.unwrap_or_default().to_owned(),
            quote: if text.contains("=\"") || !text.contains("='") {
                '"'
            } else {
                '\''
            },
            blank: 2 * text.matches(" />").count() > text.matches("/>").count(),
            apostrophe: text.contains("&apos;"),
            quotation: text.contains("&quot;"),
            ..Self::elan_spelling()
        };
        style.wraps = style.has_broken_tags(layout);
        let values = "ANNOTATION_VALUE";
        style.pair = if text.contains("<ANNOTATION_VALUE></ANNOTATION_VALUE>") {
            true
        } else {
            let short = (0..layout.elements.len())
                .any(|element| layout.elements[element].empty && layout.layout_element_name(element) == values);
            !short && !style.wraps
        };
        for element in 0..layout.elements.len() {
            let names = layout.element_attributes(element);
            let attribute_order = style
                .order
                .entry(layout.layout_element_name(element).to_owned())
                .or_default();
            for name in names {
                let name = &layout.text[name.name.clone()];
                if !attribute_order.iter().any(|listed| listed == name) {
                    attribute_order.push(name.to_owned());
                }
            }
        }
        style
    }

    /// Returns whether the file breaks long start tags, as far as its text shows.
    fn has_broken_tags(&self, layout: &EafLayout<'_>) -> bool {
        let mut long = false;
        for element in 0..layout.elements.len() {
            let it = &layout.elements[element];
            let tag = &layout.text[it.span.start..it.inner.start];
            if tag.contains('\n') && layout.layout_element_name(element) != "ANNOTATION_DOCUMENT" {
                return true;
            }
            let attributes = layout.element_attributes(element);
            let last = attributes.len().saturating_sub(2);
            let end = attributes.get(last).map_or(0, |attribute| attribute.value.end);
            let indent = layout.element_indent(element).map_or(0, str::len);
            long |= attributes.len() > 1 && indent + end.saturating_sub(it.span.start) > TAG_BREAK_COLUMN + 8;
        }
        !long
    }

    /// Returns the start of a tag: its name and attributes, without its end.
    ///
    /// An attribute that would go beyond column 72 stands on a line of its own, unless it is the last.
    pub(super) fn format_start_tag(&self, indent: &str, name: &str, attributes: &[(&str, &str)]) -> String {
        let mut sorted: Vec<&(&str, &str)> = attributes.iter().collect();
        let order = self.order.get(name);
        sorted.sort_by_key(|(name, _)| {
            let order_index = order.and_then(|order| order.iter().position(|listed| listed == name));
            (order_index.unwrap_or(usize::MAX), *name)
        });
        let mut tag = format!("<{name}");
        let mut column = indent.chars().count() + tag.chars().count();
        for (at, (name, value)) in sorted.iter().enumerate() {
            let written = self.format_xml_attribute(name, value);
            let length = written.chars().count();
            if self.wraps && at + 1 < sorted.len() && column + 1 + length > TAG_BREAK_COLUMN {
                tag.push_str(self.newline);
                tag.push_str(indent);
                tag.push_str("    ");
                column = indent.chars().count() + 4;
            } else {
                tag.push(' ');
                column += 1;
            }
            tag.push_str(&written);
            column += length;
        }
        tag
    }

    /// Returns an attribute with its value.
    pub(super) fn format_xml_attribute(&self, name: &str, value: &str) -> String {
        let quote = self.quote;
        format!("{name}={quote}{}{quote}", self.escape_xml_text(value, Some(quote)))
    }

    /// Returns the end of a tag without content.
    pub(super) fn empty_tag_end(&self) -> &'static str {
        if self.blank { " />" } else { "/>" }
    }

    /// Returns whether an element of that name is written with two tags if it has no text.
    pub(super) fn needs_tag_pair(&self, name: &str) -> bool {
        self.pair && name == "ANNOTATION_VALUE"
    }

    /// Returns a text as it is written between tags, or between the quotes of an attribute.
    ///
    /// Characters that XML cannot hold become U+FFFD.
    pub(super) fn escape_xml_text(&self, text: &str, quote: Option<char>) -> String {
        let mut out = String::with_capacity(text.len());
        for c in text.chars() {
            let reference = match (c, quote) {
                ('&', _) => "&amp;",
                ('<', _) => "&lt;",
                ('>', None) => "&gt;",
                ('"', Some('"')) => "&quot;",
                ('\'', Some('\'')) => "&apos;",
                ('\'', None) if self.apostrophe => "&apos;",
                ('"', None) if self.quotation => "&quot;",
                ('\n', Some(_)) => "&#10;",
                ('\t', Some(_)) => "&#9;",
                ('\r', _) => "&#13;",
                ('\n', None) if !self.newline.is_empty() => self.newline,
                (c, _) if !is_xml(c) => "\u{fffd}",
                (c, _) => {
                    out.push(c);
                    continue;
                }
            };
            out.push_str(reference);
        }
        out
    }
}
