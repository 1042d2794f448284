//! Reads attributes into fields, and keeps elements and attributes that the schema lacks.

use super::eaf_raw::{EafText, KeptContents, UnknownContents};
use super::error::EafError;
use super::xml::{XmlCursor, XmlStartTag};
use crate::finding::ImportFinding;

/// Reads the elements of a document one after the other.
pub(super) struct DocumentReader<'a> {
    pub(super) cursor: XmlCursor<'a>,
}

/// The largest time, in milliseconds or in PAL or NTSC frames, that fits into microseconds.
const LARGEST_TIME: u64 = i64::MAX as u64 / 40_000;

/// The destination of an attribute's value.
pub(super) enum AttributeField<'f, 'a> {
    Text(&'f mut EafText<'a>),
    Required(&'f mut EafText<'a>),
    Optional(&'f mut Option<EafText<'a>>),
    /// A time in milliseconds or frames that is within [`LARGEST_TIME`] of the start.
    Time(&'f mut Option<i64>),
    Flag(&'f mut Option<bool>),
    Ignored,
}

impl<'a> AttributeField<'_, 'a> {
    /// Stores the value; on failure returns it with the expected form.
    #[inline]
    fn store_field_value(&mut self, value: EafText<'a>) -> Result<(), (&'static str, EafText<'a>)> {
        match self {
            Self::Text(text) | Self::Required(text) => **text = value,
            Self::Optional(text) => **text = Some(value),
            Self::Time(time) => match whole_number(&value) {
                Some(value) if value.unsigned_abs() <= LARGEST_TIME => **time = Some(value),
                _ => return Err(("a whole number within the range of times", value)),
            },
            Self::Flag(flag) => match boolean(&value) {
                Some(value) => **flag = Some(value),
                None => return Err(("true or false", value)),
            },
            Self::Ignored => {}
        }
        Ok(())
    }
}

fn whole_number(value: &str) -> Option<i64> {
    value.trim().parse().ok()
}

fn boolean(value: &str) -> Option<bool> {
    match value.trim() {
        "true" | "1" => Some(true),
        "false" | "0" => Some(false),
        _ => None,
    }
}

/// The oddities in the attributes of one element.
#[derive(Default)]
struct AttributeOddities<'a> {
    /// The field's number, the expected form, and the actual text.
    wrong: Option<(usize, &'static str, EafText<'a>)>,
    /// Whether an attribute occurs twice.
    twice: bool,
    /// The fields that were found, one bit each.
    seen: u32,
}

impl<'a> DocumentReader<'a> {
    /// Reads the attributes of `tag` into `fields` and returns those that no field takes.
    pub(super) fn read_attribute_fields(
        &mut self,
        tag: &XmlStartTag<'a>,
        fields: &mut [(&'static str, AttributeField<'_, 'a>)],
    ) -> Result<KeptContents<'a>, EafError> {
        let mut kept: KeptContents<'a> = None;
        let mut odd = AttributeOddities::default();
        self.cursor.visit_tag_attributes(tag, |name, value| {
            let Some(at) = fields.iter().position(|(known, _)| *known == name) else {
                let kept = kept.get_or_insert_default();
                kept.attributes.push((EafText::Borrowed(name), value));
                return;
            };
            if odd.seen & (1 << at) != 0 {
                odd.twice = true;
                return;
            }
            odd.seen |= 1 << at;
            if let Err((expected, text)) = fields[at].1.store_field_value(value) {
                odd.wrong = Some((at, expected, text));
            }
        })?;
        let is_complete = odd.seen.count_ones() as usize == fields.len();
        if !is_complete || odd.twice || odd.wrong.is_some() || kept.is_some() {
            self.attribute_findings(tag, fields, &odd, kept.as_deref());
        }
        Ok(kept)
    }

    fn attribute_findings(
        &mut self,
        tag: &XmlStartTag<'a>,
        fields: &[(&'static str, AttributeField<'_, 'a>)],
        odd: &AttributeOddities<'a>,
        kept: Option<&UnknownContents<'a>>,
    ) {
        let (element, findings) = (tag.name, &mut self.cursor.findings);
        for (at, (name, field)) in fields.iter().enumerate() {
            if matches!(field, AttributeField::Required(_)) && odd.seen & (1 << at) == 0 {
                findings.add_limited_finding("missing attributes", || {
                    ImportFinding::new_warning_finding(tag.start_tag_line(), format!("<{element}> has no {name}"))
                        .with_remedy(format!("add {name}=\"…\""))
                });
            }
        }
        if let Some((at, expected, text)) = &odd.wrong {
            findings.add_limited_finding("attributes that say nothing", || {
                let name = fields[*at].0;
                let text = format!("{name}={text:.40?} of <{element}> is not {expected}");
                ImportFinding::new_warning_finding(tag.start_tag_line(), text + "; it was left out")
            });
        }
        if odd.twice {
            findings.add_limited_finding("attributes given twice", || {
                let text = format!("<{element}> has an attribute twice; the first counts");
                ImportFinding::new_warning_finding(tag.start_tag_line(), text)
            });
        }
        for (name, _) in kept.iter().flat_map(|kept| &kept.attributes) {
            findings.add_limited_note("attributes beyond the schema", tag.start_tag_line(), || {
                format!("<{element}> has the attribute {name:.40?}, which EAF doesn't know; it was kept aside")
            });
        }
    }

    /// Goes to the end of an element that should be empty.
    pub(super) fn read_leaf_end(
        &mut self,
        tag: &XmlStartTag<'a>,
        mut kept: KeptContents<'a>,
    ) -> Result<KeptContents<'a>, EafError> {
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            self.keep_unknown_child(tag, &child, &mut kept)?;
        }
        Ok(kept)
    }

    pub(super) fn keep_unknown_child(
        &mut self,
        parent: &XmlStartTag<'a>,
        child: &XmlStartTag<'a>,
        kept: &mut KeptContents<'a>,
    ) -> Result<(), EafError> {
        let source = self.cursor.skip_xml_element(child)?;
        kept.get_or_insert_default().elements.push(EafText::Borrowed(source));
        let (outer, name) = (parent.name, child.name);
        self.cursor
            .findings
            .add_limited_note("elements beyond the schema", child.start_tag_line(), || {
                format!("<{name:.40}> in <{outer}> is not known to EAF; it was kept aside")
            });
        Ok(())
    }

    pub(super) fn skip_unknown(&mut self, parent: &XmlStartTag<'a>, child: &XmlStartTag<'a>) -> Result<(), EafError> {
        self.cursor.skip_xml_element(child)?;
        let (outer, name) = (parent.name, child.name);
        self.cursor
            .findings
            .add_limited_warning("elements that were left out", child.start_tag_line(), || {
                format!("<{name:.40}> in <{outer}> is not known to EAF; it was left out")
            });
        Ok(())
    }

    pub(super) fn not_kept(&mut self, tag: &XmlStartTag<'a>, unknown: Option<&UnknownContents<'a>>) {
        if unknown.is_some() {
            let element = tag.name;
            self.cursor
                .findings
                .add_limited_warning("attributes that were left out", tag.start_tag_line(), || {
                    format!("the attributes of <{element}> were left out")
                });
        }
    }
}
