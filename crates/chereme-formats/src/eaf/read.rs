//! Reads bytes into a raw document.

use super::error::Error;
use super::fields::{DocumentReader, Field};
use super::raw::*;
use super::xml::{Cursor, Tag};
use crate::finding::Finding;

/// Reads an EAF document (or an `.etf` template) of any format version up to 3.0.
///
/// Attributes may come in any order. Parts beyond the schema are kept and reported as findings; a missing
/// attribute is reported, too, and becomes an empty text. [`check`] checks the references.
///
/// # Errors
/// [`Error`] if the bytes are not UTF-8 (see [`decode`](super::decode)), not XML, cut short, not EAF, declare a document type, or exceed
/// the limits on depth and attributes.
pub fn read(bytes: &[u8]) -> Result<(Document<'_>, Vec<Finding>), Error> {
    document(bytes, "ANNOTATION_DOCUMENT")
}

/// Reads an external controlled vocabulary (`.ecv`, root `CV_RESOURCE`); only the vocabularies,
/// languages and external references of the document are filled.
///
/// # Errors
/// The same as [`read`]'s.
pub fn read_ecv(bytes: &[u8]) -> Result<(Document<'_>, Vec<Finding>), Error> {
    document(bytes, "CV_RESOURCE")
}

fn document<'a>(
    bytes: &'a [u8],
    root: &'static str,
) -> Result<(Document<'a>, Vec<Finding>), Error> {
    let mut reader = DocumentReader {
        cursor: Cursor::new(bytes)?,
    };
    let root = reader.cursor.root(root)?;
    let document = reader.root(&root)?;
    reader.cursor.finish()?;
    Ok((document, reader.cursor.findings.finish()))
}

impl<'a> DocumentReader<'a> {
    fn root(&mut self, tag: &Tag<'a>) -> Result<Document<'a>, Error> {
        let mut doc = Document::default();
        let mut kept = self.fields(
            tag,
            &mut [
                ("AUTHOR", Field::Text(&mut doc.author)),
                ("DATE", Field::Text(&mut doc.date)),
                ("VERSION", Field::Text(&mut doc.version)),
                ("FORMAT", Field::Optional(&mut doc.format)),
                (
                    "xsi:noNamespaceSchemaLocation",
                    Field::Optional(&mut doc.schema),
                ),
                ("xmlns:xsi", Field::Ignored),
            ],
        )?;
        while let Some(child) = self.cursor.child(tag)? {
            match child.name {
                "LICENSE" => doc.licenses.push(self.license(&child)?),
                "HEADER" => self.header(&child, &mut doc.header)?,
                "TIME_ORDER" => self.time_order(&child, &mut doc.time_order)?,
                "TIER" => doc.tiers.push(self.tier(&child)?),
                "LINGUISTIC_TYPE" => doc.linguistic_types.push(self.linguistic_type(&child)?),
                "LOCALE" => doc.locales.push(self.locale(&child)?),
                "LANGUAGE" => doc.languages.push(self.language(&child)?),
                "CONSTRAINT" => doc.constraints.push(self.constraint(&child)?),
                "CONTROLLED_VOCABULARY" => doc.vocabularies.push(self.vocabulary(&child)?),
                "LEXICON_REF" => doc.lexicon_refs.push(self.lexicon_ref(&child)?),
                "REF_LINK_SET" => doc.ref_link_sets.push(self.ref_link_set(&child)?),
                "EXTERNAL_REF" => doc.external_refs.push(self.external_ref(&child)?),
                _ => self.keep(tag, &child, &mut kept)?,
            }
        }
        doc.kept = kept;
        doc.source = tag.source();
        Ok(doc)
    }

    fn license(&mut self, tag: &Tag<'a>) -> Result<License<'a>, Error> {
        let mut license = License::default();
        license.kept = self.fields(tag, &mut [("LICENSE_URL", Field::Text(&mut license.url))])?;
        license.text = self.cursor.text(tag)?;
        Ok(license)
    }

    fn header(&mut self, tag: &Tag<'a>, header: &mut Header<'a>) -> Result<(), Error> {
        let mut kept = self.fields(
            tag,
            &mut [
                ("MEDIA_FILE", Field::Text(&mut header.media_file)),
                ("TIME_UNITS", Field::Optional(&mut header.time_units)),
            ],
        )?;
        while let Some(child) = self.cursor.child(tag)? {
            match child.name {
                "MEDIA_DESCRIPTOR" => header.media.push(self.media(&child)?),
                "LINKED_FILE_DESCRIPTOR" => header.linked_files.push(self.linked_file(&child)?),
                "PROPERTY" => header.properties.push(self.property(&child)?),
                _ => self.keep(tag, &child, &mut kept)?,
            }
        }
        header.kept = kept;
        Ok(())
    }

    fn media(&mut self, tag: &Tag<'a>) -> Result<MediaDescriptor<'a>, Error> {
        let mut media = MediaDescriptor::default();
        let kept = self.fields(
            tag,
            &mut [
                ("MEDIA_URL", Field::Required(&mut media.url)),
                ("MIME_TYPE", Field::Required(&mut media.mime_type)),
                (
                    "RELATIVE_MEDIA_URL",
                    Field::Optional(&mut media.relative_url),
                ),
                ("TIME_ORIGIN", Field::Time(&mut media.time_origin)),
                ("EXTRACTED_FROM", Field::Optional(&mut media.extracted_from)),
            ],
        )?;
        media.kept = self.leaf(tag, kept)?;
        Ok(media)
    }

    fn linked_file(&mut self, tag: &Tag<'a>) -> Result<LinkedFile<'a>, Error> {
        let mut file = LinkedFile::default();
        let kept = self.fields(
            tag,
            &mut [
                ("LINK_URL", Field::Required(&mut file.url)),
                ("MIME_TYPE", Field::Required(&mut file.mime_type)),
                ("RELATIVE_LINK_URL", Field::Optional(&mut file.relative_url)),
                ("TIME_ORIGIN", Field::Time(&mut file.time_origin)),
                (
                    "ASSOCIATED_WITH",
                    Field::Optional(&mut file.associated_with),
                ),
            ],
        )?;
        file.kept = self.leaf(tag, kept)?;
        Ok(file)
    }

    fn property(&mut self, tag: &Tag<'a>) -> Result<Property<'a>, Error> {
        let mut property = Property::default();
        property.kept = self.fields(tag, &mut [("NAME", Field::Optional(&mut property.name))])?;
        property.value = self.cursor.text(tag)?;
        Ok(property)
    }

    fn time_order(&mut self, tag: &Tag<'a>, slots: &mut Vec<TimeSlot<'a>>) -> Result<(), Error> {
        let kept = self.fields(tag, &mut [])?;
        self.not_kept(tag, kept.as_deref());
        while let Some(child) = self.cursor.child(tag)? {
            if child.name == "TIME_SLOT" {
                slots.push(self.time_slot(&child)?);
            } else {
                self.skip_unknown(tag, &child)?;
            }
        }
        Ok(())
    }

    fn time_slot(&mut self, tag: &Tag<'a>) -> Result<TimeSlot<'a>, Error> {
        let mut slot = TimeSlot {
            at: tag.at(),
            ..TimeSlot::default()
        };
        let kept = self.fields(
            tag,
            &mut [
                ("TIME_SLOT_ID", Field::Required(&mut slot.id)),
                ("TIME_VALUE", Field::Time(&mut slot.value)),
            ],
        )?;
        slot.kept = self.leaf(tag, kept)?;
        Ok(slot)
    }

    fn tier(&mut self, tag: &Tag<'a>) -> Result<Tier<'a>, Error> {
        let mut tier = Tier {
            at: tag.at(),
            ..Tier::default()
        };
        let mut kept = self.fields(
            tag,
            &mut [
                ("TIER_ID", Field::Required(&mut tier.id)),
                (
                    "LINGUISTIC_TYPE_REF",
                    Field::Required(&mut tier.linguistic_type),
                ),
                ("PARTICIPANT", Field::Optional(&mut tier.participant)),
                ("ANNOTATOR", Field::Optional(&mut tier.annotator)),
                ("DEFAULT_LOCALE", Field::Optional(&mut tier.locale)),
                ("PARENT_REF", Field::Optional(&mut tier.parent)),
                ("EXT_REF", Field::Optional(&mut tier.external_ref)),
                ("LANG_REF", Field::Optional(&mut tier.language)),
            ],
        )?;
        while let Some(child) = self.cursor.child(tag)? {
            if child.name == "ANNOTATION" {
                self.annotations(&child, &mut tier.annotations)?;
            } else {
                self.keep(tag, &child, &mut kept)?;
            }
        }
        tier.kept = kept;
        Ok(tier)
    }

    fn annotations(&mut self, tag: &Tag<'a>, into: &mut Vec<Annotation<'a>>) -> Result<(), Error> {
        let kept = self.fields(tag, &mut [])?;
        self.not_kept(tag, kept.as_deref());
        let mut count = 0;
        while let Some(child) = self.cursor.child(tag)? {
            let mut annotation = blank(&child);
            match child.name {
                "ALIGNABLE_ANNOTATION" => self.alignable(&child, &mut annotation)?,
                "REF_ANNOTATION" => self.reference(&child, &mut annotation)?,
                _ => {
                    self.skip_unknown(tag, &child)?;
                    continue;
                }
            }
            into.push(annotation);
            count += 1;
        }
        if count != 1 {
            self.cursor.findings.add(
                "ANNOTATION elements with none or several annotations",
                || {
                    Finding::warning(
                        tag.line(),
                        format!("this ANNOTATION holds {count} annotations instead of one"),
                    )
                },
            );
        }
        Ok(())
    }

    fn alignable(&mut self, tag: &Tag<'a>, annotation: &mut Annotation<'a>) -> Result<(), Error> {
        let (mut start, mut end) = (Text::default(), Text::default());
        let kept = self.fields(
            tag,
            &mut [
                ("ANNOTATION_ID", Field::Required(&mut annotation.id)),
                ("TIME_SLOT_REF1", Field::Required(&mut start)),
                ("TIME_SLOT_REF2", Field::Required(&mut end)),
                ("CVE_REF", Field::Optional(&mut annotation.entry)),
                ("EXT_REF", Field::Optional(&mut annotation.external_ref)),
                ("LANG_REF", Field::Optional(&mut annotation.language)),
                ("SVG_REF", Field::Optional(&mut annotation.svg)),
            ],
        )?;
        annotation.anchor = Anchor::Slots { start, end };
        self.annotation_value(tag, annotation, kept)
    }

    fn reference(&mut self, tag: &Tag<'a>, annotation: &mut Annotation<'a>) -> Result<(), Error> {
        let (mut parent, mut previous) = (Text::default(), None);
        let kept = self.fields(
            tag,
            &mut [
                ("ANNOTATION_ID", Field::Required(&mut annotation.id)),
                ("ANNOTATION_REF", Field::Required(&mut parent)),
                ("PREVIOUS_ANNOTATION", Field::Optional(&mut previous)),
                ("CVE_REF", Field::Optional(&mut annotation.entry)),
                ("EXT_REF", Field::Optional(&mut annotation.external_ref)),
                ("LANG_REF", Field::Optional(&mut annotation.language)),
            ],
        )?;
        annotation.anchor = Anchor::Parent { parent, previous };
        self.annotation_value(tag, annotation, kept)
    }

    fn annotation_value(
        &mut self,
        tag: &Tag<'a>,
        annotation: &mut Annotation<'a>,
        mut kept: Kept<'a>,
    ) -> Result<(), Error> {
        while let Some(child) = self.cursor.child(tag)? {
            if child.name == "ANNOTATION_VALUE" {
                let unknown = self.fields(&child, &mut [])?;
                self.not_kept(&child, unknown.as_deref());
                annotation.value = self.cursor.text(&child)?;
            } else {
                self.keep(tag, &child, &mut kept)?;
            }
        }
        annotation.kept = kept;
        Ok(())
    }

    fn linguistic_type(&mut self, tag: &Tag<'a>) -> Result<LinguisticType<'a>, Error> {
        let mut kind = LinguisticType {
            at: tag.at(),
            ..LinguisticType::default()
        };
        let kept = self.fields(
            tag,
            &mut [
                ("LINGUISTIC_TYPE_ID", Field::Required(&mut kind.id)),
                ("TIME_ALIGNABLE", Field::Flag(&mut kind.time_alignable)),
                ("CONSTRAINTS", Field::Optional(&mut kind.constraints)),
                (
                    "GRAPHIC_REFERENCES",
                    Field::Flag(&mut kind.graphic_references),
                ),
                (
                    "CONTROLLED_VOCABULARY_REF",
                    Field::Optional(&mut kind.vocabulary),
                ),
                ("EXT_REF", Field::Optional(&mut kind.external_ref)),
                ("LEXICON_REF", Field::Optional(&mut kind.lexicon_ref)),
            ],
        )?;
        kind.kept = self.leaf(tag, kept)?;
        Ok(kind)
    }

    fn locale(&mut self, tag: &Tag<'a>) -> Result<Locale<'a>, Error> {
        let mut locale = Locale::default();
        let kept = self.fields(
            tag,
            &mut [
                ("LANGUAGE_CODE", Field::Required(&mut locale.language)),
                ("COUNTRY_CODE", Field::Optional(&mut locale.country)),
                ("VARIANT", Field::Optional(&mut locale.variant)),
            ],
        )?;
        locale.kept = self.leaf(tag, kept)?;
        Ok(locale)
    }

    fn language(&mut self, tag: &Tag<'a>) -> Result<Language<'a>, Error> {
        let mut language = Language::default();
        let kept = self.fields(
            tag,
            &mut [
                ("LANG_ID", Field::Required(&mut language.id)),
                ("LANG_DEF", Field::Optional(&mut language.definition)),
                ("LANG_LABEL", Field::Optional(&mut language.label)),
            ],
        )?;
        language.kept = self.leaf(tag, kept)?;
        Ok(language)
    }

    fn constraint(&mut self, tag: &Tag<'a>) -> Result<Constraint<'a>, Error> {
        let mut constraint = Constraint::default();
        let kept = self.fields(
            tag,
            &mut [
                ("STEREOTYPE", Field::Required(&mut constraint.stereotype)),
                ("DESCRIPTION", Field::Optional(&mut constraint.description)),
            ],
        )?;
        constraint.kept = self.leaf(tag, kept)?;
        Ok(constraint)
    }

    fn vocabulary(&mut self, tag: &Tag<'a>) -> Result<Vocabulary<'a>, Error> {
        let mut cv = Vocabulary {
            at: tag.at(),
            ..Vocabulary::default()
        };
        let mut legacy = None;
        let mut kept = self.fields(
            tag,
            &mut [
                ("CV_ID", Field::Required(&mut cv.id)),
                ("EXT_REF", Field::Optional(&mut cv.external_ref)),
                ("DESCRIPTION", Field::Optional(&mut legacy)),
            ],
        )?;
        cv.descriptions.extend(legacy.map(|text| Description {
            text,
            ..Description::default()
        }));
        while let Some(child) = self.cursor.child(tag)? {
            match child.name {
                "DESCRIPTION" => cv.descriptions.push(self.description(&child)?),
                "CV_ENTRY_ML" => cv.entries.push(self.entry(&child)?),
                "CV_ENTRY" => cv.entries.push(self.legacy_entry(&child)?),
                "EXTERNAL_REF" => cv.external_refs.push(self.external_ref(&child)?),
                _ => self.keep(tag, &child, &mut kept)?,
            }
        }
        cv.kept = kept;
        Ok(cv)
    }

    fn description(&mut self, tag: &Tag<'a>) -> Result<Description<'a>, Error> {
        let mut description = Description::default();
        description.kept = self.fields(
            tag,
            &mut [("LANG_REF", Field::Optional(&mut description.language))],
        )?;
        description.text = self.cursor.text(tag)?;
        Ok(description)
    }

    fn entry(&mut self, tag: &Tag<'a>) -> Result<Entry<'a>, Error> {
        let mut entry = Entry::default();
        let mut kept = self.fields(
            tag,
            &mut [
                ("CVE_ID", Field::Optional(&mut entry.id)),
                ("EXT_REF", Field::Optional(&mut entry.external_ref)),
            ],
        )?;
        while let Some(child) = self.cursor.child(tag)? {
            if child.name == "CVE_VALUE" {
                let mut value = EntryValue::default();
                value.kept = self.fields(
                    &child,
                    &mut [
                        ("LANG_REF", Field::Optional(&mut value.language)),
                        ("DESCRIPTION", Field::Optional(&mut value.description)),
                    ],
                )?;
                value.value = self.cursor.text(&child)?;
                entry.values.push(value);
            } else {
                self.keep(tag, &child, &mut kept)?;
            }
        }
        entry.kept = kept;
        Ok(entry)
    }

    fn legacy_entry(&mut self, tag: &Tag<'a>) -> Result<Entry<'a>, Error> {
        let mut entry = Entry::default();
        let mut value = EntryValue::default();
        entry.kept = self.fields(
            tag,
            &mut [
                ("ID", Field::Optional(&mut entry.id)),
                ("EXT_REF", Field::Optional(&mut entry.external_ref)),
                ("DESCRIPTION", Field::Optional(&mut value.description)),
            ],
        )?;
        value.value = self.cursor.text(tag)?;
        entry.values.push(value);
        Ok(entry)
    }

    fn lexicon_ref(&mut self, tag: &Tag<'a>) -> Result<LexiconRef<'a>, Error> {
        let mut lexicon = LexiconRef::default();
        let kept = self.fields(
            tag,
            &mut [
                ("LEX_REF_ID", Field::Required(&mut lexicon.id)),
                ("NAME", Field::Text(&mut lexicon.name)),
                ("TYPE", Field::Text(&mut lexicon.kind)),
                ("URL", Field::Text(&mut lexicon.url)),
                ("LEXICON_ID", Field::Text(&mut lexicon.lexicon_id)),
                ("LEXICON_NAME", Field::Text(&mut lexicon.lexicon_name)),
                ("DATCAT_ID", Field::Optional(&mut lexicon.category_id)),
                ("DATCAT_NAME", Field::Optional(&mut lexicon.category_name)),
            ],
        )?;
        lexicon.kept = self.leaf(tag, kept)?;
        Ok(lexicon)
    }

    fn ref_link_set(&mut self, tag: &Tag<'a>) -> Result<RefLinkSet<'a>, Error> {
        let mut set = RefLinkSet::default();
        let mut early = None;
        let mut kept = self.fields(
            tag,
            &mut [
                ("LINK_SET_ID", Field::Text(&mut set.id)),
                ("LINKS_ID", Field::Optional(&mut early)),
                ("LINK_SET_NAME", Field::Optional(&mut set.name)),
                ("EXT_REF", Field::Optional(&mut set.external_ref)),
                ("LANG_REF", Field::Optional(&mut set.language)),
                ("CV_REF", Field::Optional(&mut set.vocabulary)),
            ],
        )?;
        if set.id.is_empty() {
            set.id = early.unwrap_or_default();
        }
        while let Some(child) = self.cursor.child(tag)? {
            match child.name {
                "CROSS_REF_LINK" | "GROUP_REF_LINK" => set.links.push(self.ref_link(&child)?),
                _ => self.keep(tag, &child, &mut kept)?,
            }
        }
        set.kept = kept;
        Ok(set)
    }

    fn ref_link(&mut self, tag: &Tag<'a>) -> Result<RefLink<'a>, Error> {
        let mut link = RefLink::default();
        let (mut from, mut to, mut refs) = (None, None, None);
        let mut directionality = None;
        link.kept = self.fields(
            tag,
            &mut [
                ("REF_LINK_ID", Field::Required(&mut link.id)),
                ("REF1", Field::Optional(&mut from)),
                ("REF2", Field::Optional(&mut to)),
                ("REFS", Field::Optional(&mut refs)),
                ("DIRECTIONALITY", Field::Optional(&mut directionality)),
                ("REF_LINK_NAME", Field::Optional(&mut link.name)),
                ("EXT_REF", Field::Optional(&mut link.external_ref)),
                ("LANG_REF", Field::Optional(&mut link.language)),
                ("CVE_REF", Field::Optional(&mut link.entry)),
                ("REF_TYPE", Field::Optional(&mut link.kind)),
            ],
        )?;
        link.ends = if tag.name == "CROSS_REF_LINK" {
            let (from, to) = (from.unwrap_or_default(), to.unwrap_or_default());
            LinkEnds::Cross {
                from,
                to,
                directionality,
            }
        } else {
            LinkEnds::Group(refs.unwrap_or_default())
        };
        link.text = self.cursor.text(tag)?;
        Ok(link)
    }

    fn external_ref(&mut self, tag: &Tag<'a>) -> Result<ExternalRef<'a>, Error> {
        let mut reference = ExternalRef::default();
        let kept = self.fields(
            tag,
            &mut [
                ("EXT_REF_ID", Field::Required(&mut reference.id)),
                ("TYPE", Field::Text(&mut reference.kind)),
                ("VALUE", Field::Text(&mut reference.value)),
            ],
        )?;
        reference.kept = self.leaf(tag, kept)?;
        Ok(reference)
    }
}

fn blank<'a>(tag: &Tag<'a>) -> Annotation<'a> {
    Annotation {
        id: Text::default(),
        anchor: Anchor::Slots {
            start: Text::default(),
            end: Text::default(),
        },
        value: Text::default(),
        entry: None,
        external_ref: None,
        language: None,
        svg: None,
        kept: None,
        at: tag.at(),
    }
}
