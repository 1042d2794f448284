//! Reads attributes into fields, and keeps elements and attributes that the schema lacks.

use super::error::Error;
use super::raw::{Kept, Text, Unknown};
use super::xml::{Cursor, Tag};
use crate::finding::Finding;

/// Reads the elements of a document one after the other.
pub(super) struct DocumentReader<'a> {
    pub(super) cursor: Cursor<'a>,
}

/// The largest time, in milliseconds or in PAL or NTSC frames, that fits into microseconds.
const LARGEST_TIME: u64 = i64::MAX as u64 / 40_000;

/// The destination of an attribute's value.
pub(super) enum Field<'f, 'a> {
    Text(&'f mut Text<'a>),
    Required(&'f mut Text<'a>),
    Optional(&'f mut Option<Text<'a>>),
    /// A time in milliseconds or frames that is within [`LARGEST_TIME`] of the start.
    Time(&'f mut Option<i64>),
    Flag(&'f mut Option<bool>),
    Ignored,
}

impl<'a> Field<'_, 'a> {
    /// Stores the value; on failure returns it with the expected form.
    #[inline]
    fn set(&mut self, value: Text<'a>) -> Result<(), (&'static str, Text<'a>)> {
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
struct Odd<'a> {
    /// The field's number, the expected form, and the actual text.
    wrong: Option<(usize, &'static str, Text<'a>)>,
    /// Whether an attribute occurs twice.
    twice: bool,
    /// The fields that were found, one bit each.
    seen: u32,
}

impl<'a> DocumentReader<'a> {
    /// Reads the attributes of `tag` into `fields` and returns those that no field takes.
    pub(super) fn fields(
        &mut self,
        tag: &Tag<'a>,
        fields: &mut [(&'static str, Field<'_, 'a>)],
    ) -> Result<Kept<'a>, Error> {
        let mut kept: Kept<'a> = None;
        let mut odd = Odd::default();
        self.cursor.attributes(tag, |name, value| {
            let Some(at) = fields.iter().position(|(known, _)| *known == name) else {
                let kept = kept.get_or_insert_default();
                kept.attributes.push((Text::Borrowed(name), value));
                return;
            };
            if odd.seen & (1 << at) != 0 {
                odd.twice = true;
                return;
            }
            odd.seen |= 1 << at;
            if let Err((expected, text)) = fields[at].1.set(value) {
                odd.wrong = Some((at, expected, text));
            }
        })?;
        let whole = odd.seen.count_ones() as usize == fields.len();
        if !whole || odd.twice || odd.wrong.is_some() || kept.is_some() {
            self.attribute_findings(tag, fields, &odd, kept.as_deref());
        }
        Ok(kept)
    }

    fn attribute_findings(
        &mut self,
        tag: &Tag<'a>,
        fields: &[(&'static str, Field<'_, 'a>)],
        odd: &Odd<'a>,
        kept: Option<&Unknown<'a>>,
    ) {
        let (element, findings) = (tag.name, &mut self.cursor.findings);
        for (at, (name, field)) in fields.iter().enumerate() {
            if matches!(field, Field::Required(_)) && odd.seen & (1 << at) == 0 {
                findings.add("missing attributes", || {
                    Finding::warning(tag.line(), format!("<{element}> has no {name}"))
                        .with_remedy(format!("add {name}=\"…\""))
                });
            }
        }
        if let Some((at, expected, text)) = &odd.wrong {
            findings.add("attributes that say nothing", || {
                let name = fields[*at].0;
                let text = format!("{name}={text:.40?} of <{element}> is not {expected}");
                Finding::warning(tag.line(), text + "; it was left out")
            });
        }
        if odd.twice {
            findings.add("attributes given twice", || {
                let text = format!("<{element}> has an attribute twice; the first counts");
                Finding::warning(tag.line(), text)
            });
        }
        for (name, _) in kept.iter().flat_map(|kept| &kept.attributes) {
            findings.add("attributes beyond the schema", || {
                Finding::note(tag.line(), format!("<{element}> has the attribute {name:.40?}, which EAF doesn't know; it was kept aside"))
            });
        }
    }

    /// Goes to the end of an element that should be empty.
    pub(super) fn leaf(&mut self, tag: &Tag<'a>, mut kept: Kept<'a>) -> Result<Kept<'a>, Error> {
        while let Some(child) = self.cursor.child(tag)? {
            self.keep(tag, &child, &mut kept)?;
        }
        Ok(kept)
    }

    pub(super) fn keep(
        &mut self,
        parent: &Tag<'a>,
        child: &Tag<'a>,
        kept: &mut Kept<'a>,
    ) -> Result<(), Error> {
        let source = self.cursor.skip(child)?;
        kept.get_or_insert_default()
            .elements
            .push(Text::Borrowed(source));
        let (outer, name) = (parent.name, child.name);
        self.cursor.findings.add("elements beyond the schema", || {
            Finding::note(
                child.line(),
                format!("<{name:.40}> in <{outer}> is not known to EAF; it was kept aside"),
            )
        });
        Ok(())
    }

    pub(super) fn skip_unknown(&mut self, parent: &Tag<'a>, child: &Tag<'a>) -> Result<(), Error> {
        self.cursor.skip(child)?;
        let (outer, name) = (parent.name, child.name);
        self.cursor.findings.add("elements that were left out", || {
            Finding::warning(
                child.line(),
                format!("<{name:.40}> in <{outer}> is not known to EAF; it was left out"),
            )
        });
        Ok(())
    }

    pub(super) fn not_kept(&mut self, tag: &Tag<'a>, unknown: Option<&Unknown<'a>>) {
        if unknown.is_some() {
            let element = tag.name;
            self.cursor
                .findings
                .add("attributes that were left out", || {
                    Finding::warning(
                        tag.line(),
                        format!("the attributes of <{element}> were left out"),
                    )
                });
        }
    }
}
