//! The elements of an XML text by their byte spans, and changes of the text that leave all else as it is.

use std::collections::HashMap;
use std::ops::Range;

/// An element by its byte spans.
#[derive(Debug, Clone)]
pub(super) struct ElementSpan {
    /// Its name.
    pub(super) name: Range<usize>,
    /// The whole element, tags included.
    pub(super) span: Range<usize>,
    /// The text between its tags; for `<a/>` the empty span before `/>`.
    pub(super) inner: Range<usize>,
    /// Whether it is written as `<a/>`.
    pub(super) empty: bool,
    /// The index of the element around it.
    pub(super) parent: Option<usize>,
    /// The indices of the elements in it.
    pub(super) children: Vec<usize>,
}

/// An attribute by its byte spans.
#[derive(Debug, Clone)]
pub(super) struct AttributeSpan {
    /// The name.
    pub(super) name: Range<usize>,
    /// The value between its quotes.
    pub(super) value: Range<usize>,
}

/// The elements of a text.
pub(super) struct EafLayout<'a> {
    pub(super) text: &'a str,
    pub(super) elements: Vec<ElementSpan>,
    at: HashMap<usize, usize>,
}

impl<'a> EafLayout<'a> {
    /// Returns the layout of a text that the reader understood; `None` if its tags do not nest.
    pub(super) fn layout_from_text(text: &'a str) -> Option<Self> {
        let mut layout = Self {
            text,
            elements: Vec::new(),
            at: HashMap::new(),
        };
        let mut open: Vec<usize> = Vec::new();
        let mut cursor = 0;
        while let Some(next) = text[cursor..].find('<') {
            let start = cursor + next;
            let rest = &text[start..];
            let past = |mark: &str| rest.find(mark).map(|end| start + end + mark.len());
            cursor = if rest.starts_with("<!--") {
                past("-->")?
            } else if rest.starts_with("<![CDATA[") {
                past("]]>")?
            } else if rest.starts_with("<?") {
                past("?>")?
            } else if rest.starts_with("</") {
                let end = past(">")?;
                let element = &mut layout.elements[open.pop()?];
                element.inner.end = start;
                element.span.end = end;
                end
            } else {
                let end = start + tag_end(rest)?;
                layout.open_layout_element(start..end, &mut open);
                end
            };
        }
        (open.is_empty() && !layout.elements.is_empty()).then_some(layout)
    }

    fn open_layout_element(&mut self, tag: Range<usize>, open: &mut Vec<usize>) {
        let body = &self.text[tag.start + 1..tag.end - 1];
        let empty = body.ends_with('/');
        let length = body
            .find(|c: char| c.is_ascii_whitespace() || c == '/')
            .unwrap_or(body.len());
        let id = self.elements.len();
        let inner = if empty { tag.end - 2 } else { tag.end };
        let parent = open.last().copied();
        self.elements.push(ElementSpan {
            name: tag.start + 1..tag.start + 1 + length,
            span: tag.clone(),
            inner: inner..inner,
            empty,
            parent,
            children: Vec::new(),
        });
        self.at.insert(tag.start, id);
        if let Some(parent) = parent {
            self.elements[parent].children.push(id);
        }
        if !empty {
            open.push(id);
        }
    }

    /// Returns the element that starts at a byte.
    pub(super) fn element_starting_at(&self, at: usize) -> Option<usize> {
        self.at.get(&at).copied()
    }

    pub(super) fn layout_element_name(&self, element: usize) -> &'a str {
        &self.text[self.elements[element].name.clone()]
    }

    /// Returns the first child of that name.
    pub(super) fn first_child_named(&self, element: usize, name: &str) -> Option<usize> {
        self.children_named(element, name).next()
    }

    /// Returns the children of that name.
    pub(super) fn children_named<'s>(&'s self, element: usize, name: &'s str) -> impl Iterator<Item = usize> + 's {
        let all = self.elements[element].children.iter().copied();
        all.filter(move |child| self.layout_element_name(*child) == name)
    }

    /// Returns the attributes of an element in the order of the file.
    pub(super) fn element_attributes(&self, element: usize) -> Vec<AttributeSpan> {
        let it = &self.elements[element];
        let end = it.inner.start - usize::from(!it.empty);
        let mut found_attributes = Vec::new();
        let mut cursor = it.name.end;
        while let Some(attribute) = parse_attribute_span(self.text, cursor, end) {
            cursor = attribute.value.end + 1;
            found_attributes.push(attribute);
        }
        found_attributes
    }

    /// Returns the attribute of that name.
    pub(super) fn find_element_attribute(&self, element: usize, name: &str) -> Option<AttributeSpan> {
        let mut all = self.element_attributes(element).into_iter();
        all.find(|candidate| self.text[candidate.name.clone()] == *name)
    }

    /// Returns the blanks before an element on its line; `None` if it does not start the line.
    pub(super) fn element_indent(&self, element: usize) -> Option<&'a str> {
        let before = &self.text[..self.elements[element].span.start];
        let line = before.rfind(['\n', '\r']).map(|at| &before[at + 1..])?;
        line.chars().all(|c| c == ' ' || c == '\t').then_some(line)
    }

    /// Returns the span of an element with the lines that it fills.
    pub(super) fn element_line_span(&self, element: usize) -> Range<usize> {
        let span = self.elements[element].span.clone();
        let Some(indent) = self.element_indent(element) else {
            return span;
        };
        let after = &self.text[span.end..];
        let blanks = after.len() - after.trim_start_matches([' ', '\t']).len();
        let rest = &after[blanks..];
        let line_end = if rest.starts_with("\r\n") {
            2
        } else {
            usize::from(rest.starts_with(['\n', '\r']))
        };
        if line_end == 0 {
            return span;
        }
        span.start - indent.len()..span.end + blanks + line_end
    }
}

/// Returns the length of a start tag; a `>` in quotes does not end it.
fn tag_end(text: &str) -> Option<usize> {
    let mut quote = None;
    for (at, byte) in text.bytes().enumerate() {
        match (quote, byte) {
            (None, b'>') => return Some(at + 1),
            (None, b'"' | b'\'') => quote = Some(byte),
            (Some(open), close) if open == close => quote = None,
            _ => {}
        }
    }
    None
}

fn parse_attribute_span(text: &str, from: usize, to: usize) -> Option<AttributeSpan> {
    let part = text.get(from..to)?;
    let start = from + (part.len() - part.trim_ascii_start().len());
    let equals = start + text[start..to].find('=')?;
    let name = start..start + text[start..equals].trim_ascii_end().len();
    let open = equals + 1 + text[equals + 1..to].find(['"', '\''])?;
    let quote = char::from(text.as_bytes()[open]);
    let end = open + 1 + text[open + 1..to].find(quote)?;
    Some(AttributeSpan {
        name,
        value: open + 1..end,
    })
}

/// Replacements of spans of a text; several at one position are applied in the order in which they were added.
#[derive(Default)]
pub(super) struct TextEdits(Vec<(Range<usize>, String)>);

impl TextEdits {
    pub(super) fn replace_text_span(&mut self, span: Range<usize>, text: impl Into<String>) {
        self.0.push((span, text.into()));
    }

    pub(super) fn remove_text_span(&mut self, span: Range<usize>) {
        self.replace_text_span(span, "");
    }

    pub(super) fn insert_text_at(&mut self, at: usize, text: impl Into<String>) {
        self.replace_text_span(at..at, text);
    }

    /// Returns the changed text; `None` if two changes overlap.
    pub(super) fn apply_text_edits(mut self, text: &str) -> Option<String> {
        self.0.sort_by_key(|(span, _)| (span.start, span.end));
        let mut changed = String::with_capacity(text.len());
        let mut cursor = 0;
        for (span, new) in self.0 {
            changed.push_str(text.get(cursor..span.start)?);
            changed.push_str(&new);
            cursor = span.end;
        }
        changed.push_str(text.get(cursor..)?);
        Some(changed)
    }
}
