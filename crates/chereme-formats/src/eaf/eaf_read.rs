//! Reads bytes into a raw document.

use super::eaf_fields::{AttributeField, DocumentReader};
use super::eaf_raw::*;
use super::error::EafError;
use super::xml::{XmlCursor, XmlStartTag};
use crate::finding::ImportFinding;

/// Reads an EAF document (or an `.etf` template) of any format version up to 3.0.
///
/// Attributes may come in any order. Parts beyond the schema are kept and reported as findings; a missing
/// attribute is reported, too, and becomes an empty text. [`check_eaf_references`](super::eaf_raw::check_eaf_references) checks the references.
///
/// # Errors
/// [`EafError`] if the bytes are not UTF-8 (see [`decode_eaf`](super::decode_eaf)), not XML, cut short, not EAF, declare a document type, or exceed
/// the limits on depth and attributes.
pub fn read_eaf_document(bytes: &[u8]) -> Result<(EafDocument<'_>, Vec<ImportFinding>), EafError> {
    read_document_with_root(bytes, "ANNOTATION_DOCUMENT")
}

/// Reads an external controlled vocabulary (`.ecv`, root `CV_RESOURCE`); only the vocabularies,
/// languages and external references of the document are filled.
///
/// # Errors
/// The same as [`read_eaf_document`]'s.
pub fn read_ecv(bytes: &[u8]) -> Result<(EafDocument<'_>, Vec<ImportFinding>), EafError> {
    read_document_with_root(bytes, "CV_RESOURCE")
}

fn read_document_with_root<'a>(
    bytes: &'a [u8],
    root: &'static str,
) -> Result<(EafDocument<'a>, Vec<ImportFinding>), EafError> {
    let mut reader = DocumentReader {
        cursor: XmlCursor::new(bytes)?,
    };
    let root = reader.cursor.read_root_tag(root)?;
    let document = reader.read_eaf_root(&root)?;
    reader.cursor.check_document_end()?;
    Ok((document, reader.cursor.findings.finish_finding_tally()))
}

impl<'a> DocumentReader<'a> {
    fn read_eaf_root(&mut self, tag: &XmlStartTag<'a>) -> Result<EafDocument<'a>, EafError> {
        let mut doc = EafDocument::default();
        let mut kept = self.read_attribute_fields(
            tag,
            &mut [
                ("AUTHOR", AttributeField::Text(&mut doc.author)),
                ("DATE", AttributeField::Text(&mut doc.date)),
                ("VERSION", AttributeField::Text(&mut doc.version)),
                ("FORMAT", AttributeField::Optional(&mut doc.format)),
                (
                    "xsi:noNamespaceSchemaLocation",
                    AttributeField::Optional(&mut doc.schema),
                ),
                ("xmlns:xsi", AttributeField::Ignored),
            ],
        )?;
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            match child.name {
                "LICENSE" => doc.licenses.push(self.license(&child)?),
                "HEADER" => self.read_eaf_header(&child, &mut doc.header)?,
                "TIME_ORDER" => self.time_order(&child, &mut doc.time_order)?,
                "TIER" => doc.tiers.push(self.read_eaf_tier(&child)?),
                "LINGUISTIC_TYPE" => doc.linguistic_types.push(LinguisticType {
                    at: child.start_tag_position(),
                    ..LinguisticType::read_leaf(self, &child)?
                }),
                "LOCALE" => doc.locales.push(EafLocale::read_leaf(self, &child)?),
                "LANGUAGE" => doc.languages.push(EafLanguage::read_leaf(self, &child)?),
                "CONSTRAINT" => doc.constraints.push(EafConstraint::read_leaf(self, &child)?),
                "CONTROLLED_VOCABULARY" => doc.vocabularies.push(self.read_eaf_vocabulary(&child)?),
                "LEXICON_REF" => doc.lexicon_refs.push(LexiconRef::read_leaf(self, &child)?),
                "REF_LINK_SET" => doc.ref_link_sets.push(self.ref_link_set(&child)?),
                "EXTERNAL_REF" => doc.external_refs.push(ExternalRef::read_leaf(self, &child)?),
                _ => self.keep_unknown_child(tag, &child, &mut kept)?,
            }
        }
        doc.kept = kept;
        doc.source = tag.tag_source_text();
        Ok(doc)
    }

    fn license(&mut self, tag: &XmlStartTag<'a>) -> Result<EafLicense<'a>, EafError> {
        let mut license = EafLicense::default();
        license.kept =
            self.read_attribute_fields(tag, &mut [("LICENSE_URL", AttributeField::Text(&mut license.url))])?;
        license.text = self.cursor.read_tag_text(tag)?;
        Ok(license)
    }

    fn read_eaf_header(&mut self, tag: &XmlStartTag<'a>, header: &mut EafHeader<'a>) -> Result<(), EafError> {
        let mut kept = self.read_attribute_fields(
            tag,
            &mut [
                ("MEDIA_FILE", AttributeField::Text(&mut header.media_file)),
                ("TIME_UNITS", AttributeField::Optional(&mut header.time_units)),
            ],
        )?;
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            match child.name {
                "MEDIA_DESCRIPTOR" => header.media.push(MediaDescriptor::read_leaf(self, &child)?),
                "LINKED_FILE_DESCRIPTOR" => header.linked_files.push(LinkedFile::read_leaf(self, &child)?),
                "PROPERTY" => header.properties.push(self.read_eaf_property(&child)?),
                _ => self.keep_unknown_child(tag, &child, &mut kept)?,
            }
        }
        header.kept = kept;
        Ok(())
    }

    fn read_eaf_property(&mut self, tag: &XmlStartTag<'a>) -> Result<EafProperty<'a>, EafError> {
        let mut property = EafProperty::default();
        property.kept =
            self.read_attribute_fields(tag, &mut [("NAME", AttributeField::Optional(&mut property.name))])?;
        property.value = self.cursor.read_tag_text(tag)?;
        Ok(property)
    }

    fn time_order(&mut self, tag: &XmlStartTag<'a>, slots: &mut Vec<TimeSlot<'a>>) -> Result<(), EafError> {
        let kept = self.read_attribute_fields(tag, &mut [])?;
        self.not_kept(tag, kept.as_deref());
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            if child.name == "TIME_SLOT" {
                slots.push(TimeSlot {
                    at: child.start_tag_position(),
                    ..TimeSlot::read_leaf(self, &child)?
                });
            } else {
                self.skip_unknown(tag, &child)?;
            }
        }
        Ok(())
    }

    fn read_eaf_tier(&mut self, tag: &XmlStartTag<'a>) -> Result<EafTier<'a>, EafError> {
        let mut tier = EafTier {
            at: tag.start_tag_position(),
            ..EafTier::default()
        };
        let mut kept = self.read_attribute_fields(
            tag,
            &mut [
                ("TIER_ID", AttributeField::Required(&mut tier.id)),
                (
                    "LINGUISTIC_TYPE_REF",
                    AttributeField::Required(&mut tier.linguistic_type),
                ),
                ("PARTICIPANT", AttributeField::Optional(&mut tier.participant)),
                ("ANNOTATOR", AttributeField::Optional(&mut tier.annotator)),
                ("DEFAULT_LOCALE", AttributeField::Optional(&mut tier.locale)),
                ("PARENT_REF", AttributeField::Optional(&mut tier.parent)),
                ("EXT_REF", AttributeField::Optional(&mut tier.external_ref)),
                ("LANG_REF", AttributeField::Optional(&mut tier.language)),
            ],
        )?;
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            if child.name == "ANNOTATION" {
                self.read_eaf_annotations(&child, &mut tier.annotations)?;
            } else {
                self.keep_unknown_child(tag, &child, &mut kept)?;
            }
        }
        tier.kept = kept;
        Ok(tier)
    }

    fn read_eaf_annotations(
        &mut self,
        tag: &XmlStartTag<'a>,
        into: &mut Vec<EafAnnotation<'a>>,
    ) -> Result<(), EafError> {
        let kept = self.read_attribute_fields(tag, &mut [])?;
        self.not_kept(tag, kept.as_deref());
        let mut count = 0;
        while let Some(child) = self.cursor.next_child_tag(tag)? {
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
            self.cursor.findings.add_limited_warning(
                "ANNOTATION elements with none or several annotations",
                tag.start_tag_line(),
                || format!("this ANNOTATION holds {count} annotations instead of one"),
            );
        }
        Ok(())
    }

    fn alignable(&mut self, tag: &XmlStartTag<'a>, annotation: &mut EafAnnotation<'a>) -> Result<(), EafError> {
        let (mut start, mut end) = (EafText::default(), EafText::default());
        let kept = self.read_attribute_fields(
            tag,
            &mut [
                ("ANNOTATION_ID", AttributeField::Required(&mut annotation.id)),
                ("TIME_SLOT_REF1", AttributeField::Required(&mut start)),
                ("TIME_SLOT_REF2", AttributeField::Required(&mut end)),
                ("CVE_REF", AttributeField::Optional(&mut annotation.entry)),
                ("EXT_REF", AttributeField::Optional(&mut annotation.external_ref)),
                ("LANG_REF", AttributeField::Optional(&mut annotation.language)),
                ("SVG_REF", AttributeField::Optional(&mut annotation.svg)),
            ],
        )?;
        annotation.anchor = AnnotationAnchor::Slots { start, end };
        self.annotation_value(tag, annotation, kept)
    }

    fn reference(&mut self, tag: &XmlStartTag<'a>, annotation: &mut EafAnnotation<'a>) -> Result<(), EafError> {
        let (mut parent, mut previous) = (EafText::default(), None);
        let kept = self.read_attribute_fields(
            tag,
            &mut [
                ("ANNOTATION_ID", AttributeField::Required(&mut annotation.id)),
                ("ANNOTATION_REF", AttributeField::Required(&mut parent)),
                ("PREVIOUS_ANNOTATION", AttributeField::Optional(&mut previous)),
                ("CVE_REF", AttributeField::Optional(&mut annotation.entry)),
                ("EXT_REF", AttributeField::Optional(&mut annotation.external_ref)),
                ("LANG_REF", AttributeField::Optional(&mut annotation.language)),
            ],
        )?;
        annotation.anchor = AnnotationAnchor::Parent { parent, previous };
        self.annotation_value(tag, annotation, kept)
    }

    fn annotation_value(
        &mut self,
        tag: &XmlStartTag<'a>,
        annotation: &mut EafAnnotation<'a>,
        mut kept: KeptContents<'a>,
    ) -> Result<(), EafError> {
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            if child.name == "ANNOTATION_VALUE" {
                let unknown = self.read_attribute_fields(&child, &mut [])?;
                self.not_kept(&child, unknown.as_deref());
                annotation.value = self.cursor.read_tag_text(&child)?;
            } else {
                self.keep_unknown_child(tag, &child, &mut kept)?;
            }
        }
        annotation.kept = kept;
        Ok(())
    }

    fn read_eaf_vocabulary(&mut self, tag: &XmlStartTag<'a>) -> Result<EafVocabulary<'a>, EafError> {
        let mut cv = EafVocabulary {
            at: tag.start_tag_position(),
            ..EafVocabulary::default()
        };
        let mut legacy = None;
        let mut kept = self.read_attribute_fields(
            tag,
            &mut [
                ("CV_ID", AttributeField::Required(&mut cv.id)),
                ("EXT_REF", AttributeField::Optional(&mut cv.external_ref)),
                ("DESCRIPTION", AttributeField::Optional(&mut legacy)),
            ],
        )?;
        cv.descriptions.extend(legacy.map(|text| VocabularyDescription {
            text,
            ..VocabularyDescription::default()
        }));
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            match child.name {
                "DESCRIPTION" => cv.descriptions.push(self.read_vocabulary_description(&child)?),
                "CV_ENTRY_ML" => cv.entries.push(self.read_vocabulary_entry(&child)?),
                "CV_ENTRY" => cv.entries.push(self.legacy_entry(&child)?),
                "EXTERNAL_REF" => cv.external_refs.push(ExternalRef::read_leaf(self, &child)?),
                _ => self.keep_unknown_child(tag, &child, &mut kept)?,
            }
        }
        cv.kept = kept;
        Ok(cv)
    }

    fn read_vocabulary_description(&mut self, tag: &XmlStartTag<'a>) -> Result<VocabularyDescription<'a>, EafError> {
        let mut description = VocabularyDescription::default();
        description.kept = self.read_attribute_fields(
            tag,
            &mut [("LANG_REF", AttributeField::Optional(&mut description.language))],
        )?;
        description.text = self.cursor.read_tag_text(tag)?;
        Ok(description)
    }

    fn read_vocabulary_entry(&mut self, tag: &XmlStartTag<'a>) -> Result<EafVocabularyEntry<'a>, EafError> {
        let mut entry = EafVocabularyEntry::default();
        let mut kept = self.read_attribute_fields(
            tag,
            &mut [
                ("CVE_ID", AttributeField::Optional(&mut entry.id)),
                ("EXT_REF", AttributeField::Optional(&mut entry.external_ref)),
            ],
        )?;
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            if child.name == "CVE_VALUE" {
                let mut value = EafEntryValue::default();
                value.kept = self.read_attribute_fields(
                    &child,
                    &mut [
                        ("LANG_REF", AttributeField::Optional(&mut value.language)),
                        ("DESCRIPTION", AttributeField::Optional(&mut value.description)),
                    ],
                )?;
                value.value = self.cursor.read_tag_text(&child)?;
                entry.values.push(value);
            } else {
                self.keep_unknown_child(tag, &child, &mut kept)?;
            }
        }
        entry.kept = kept;
        Ok(entry)
    }

    fn legacy_entry(&mut self, tag: &XmlStartTag<'a>) -> Result<EafVocabularyEntry<'a>, EafError> {
        let mut entry = EafVocabularyEntry::default();
        let mut value = EafEntryValue::default();
        entry.kept = self.read_attribute_fields(
            tag,
            &mut [
                ("ID", AttributeField::Optional(&mut entry.id)),
                ("EXT_REF", AttributeField::Optional(&mut entry.external_ref)),
                ("DESCRIPTION", AttributeField::Optional(&mut value.description)),
            ],
        )?;
        value.value = self.cursor.read_tag_text(tag)?;
        entry.values.push(value);
        Ok(entry)
    }

    fn ref_link_set(&mut self, tag: &XmlStartTag<'a>) -> Result<RefLinkSet<'a>, EafError> {
        let mut set = RefLinkSet::default();
        let mut early = None;
        let mut kept = self.read_attribute_fields(
            tag,
            &mut [
                ("LINK_SET_ID", AttributeField::Text(&mut set.id)),
                ("LINKS_ID", AttributeField::Optional(&mut early)),
                ("LINK_SET_NAME", AttributeField::Optional(&mut set.name)),
                ("EXT_REF", AttributeField::Optional(&mut set.external_ref)),
                ("LANG_REF", AttributeField::Optional(&mut set.language)),
                ("CV_REF", AttributeField::Optional(&mut set.vocabulary)),
            ],
        )?;
        if set.id.is_empty() {
            set.id = early.unwrap_or_default();
        }
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            match child.name {
                "CROSS_REF_LINK" | "GROUP_REF_LINK" => set.links.push(self.ref_link(&child)?),
                _ => self.keep_unknown_child(tag, &child, &mut kept)?,
            }
        }
        set.kept = kept;
        Ok(set)
    }

    fn ref_link(&mut self, tag: &XmlStartTag<'a>) -> Result<RefLink<'a>, EafError> {
        let mut link = RefLink::default();
        let (mut from, mut to, mut refs) = (None, None, None);
        let mut directionality = None;
        link.kept = self.read_attribute_fields(
            tag,
            &mut [
                ("REF_LINK_ID", AttributeField::Required(&mut link.id)),
                ("REF1", AttributeField::Optional(&mut from)),
                ("REF2", AttributeField::Optional(&mut to)),
                ("REFS", AttributeField::Optional(&mut refs)),
                ("DIRECTIONALITY", AttributeField::Optional(&mut directionality)),
                ("REF_LINK_NAME", AttributeField::Optional(&mut link.name)),
                ("EXT_REF", AttributeField::Optional(&mut link.external_ref)),
                ("LANG_REF", AttributeField::Optional(&mut link.language)),
                ("CVE_REF", AttributeField::Optional(&mut link.entry)),
                ("REF_TYPE", AttributeField::Optional(&mut link.kind)),
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
        link.text = self.cursor.read_tag_text(tag)?;
        Ok(link)
    }
}

fn blank<'a>(tag: &XmlStartTag<'a>) -> EafAnnotation<'a> {
    EafAnnotation {
        id: EafText::default(),
        anchor: AnnotationAnchor::Slots {
            start: EafText::default(),
            end: EafText::default(),
        },
        value: EafText::default(),
        entry: None,
        external_ref: None,
        language: None,
        svg: None,
        kept: None,
        at: tag.start_tag_position(),
    }
}
