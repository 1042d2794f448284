//! Mirrors an EAF document, element by element, in the names of the schema.
//!
//! Texts borrow from the bytes of the file if possible. Element order within each list is the file's; the
//! order of different elements is the schema's. Elements and attributes beyond the schema are kept in
//! [`KeptContents`] and written back at the end of their element.

use super::eaf_check::resolve_eaf_references;
pub use super::eaf_read::{read_eaf_document, read_ecv};
pub use super::eaf_write::{upgrade_eaf_document, write_eaf_document};
pub use super::error::EafError;
use super::xml::line_at_byte;
use crate::finding::ImportFinding;
use std::borrow::Cow;

/// A text of the file, its references resolved.
pub type EafText<'a> = Cow<'a, str>;

/// The contents of an element beyond the schema: attributes in order, then children as source text.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct UnknownContents<'a> {
    /// Attributes by name.
    pub attributes: Vec<(EafText<'a>, EafText<'a>)>,
    /// Child elements, each as it is written in the file.
    pub elements: Vec<EafText<'a>>,
}

/// [`UnknownContents`] parts of an element, if it has any.
pub type KeptContents<'a> = Option<Box<UnknownContents<'a>>>;

/// The byte at which an element starts in the text of the file; [`EafDocument::line_of_element`] gives its line. It is
/// ignored in comparisons.
#[derive(Debug, Clone, Copy)]
pub struct ElementStart(pub(crate) u32);

impl Default for ElementStart {
    /// Returns the position of an element that is not from a file.
    fn default() -> Self {
        Self(u32::MAX)
    }
}

impl PartialEq for ElementStart {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for ElementStart {}

/// The text of the file; ignored in comparisons.
#[derive(Clone, Copy, Default)]
pub struct EafSourceText<'a>(pub(super) &'a str);

impl std::fmt::Debug for EafSourceText<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} bytes", self.0.len())
    }
}

impl PartialEq for EafSourceText<'_> {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for EafSourceText<'_> {}

/// `ANNOTATION_DOCUMENT`, or the `CV_RESOURCE` of an `.ecv` file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct EafDocument<'a> {
    /// `AUTHOR`; often empty.
    pub author: EafText<'a>,
    /// `DATE` as an `xsd:dateTime`.
    pub date: EafText<'a>,
    /// `PACKET_VERSION` of the format.
    pub version: EafText<'a>,
    /// `FORMAT`, the same as the version in practice.
    pub format: Option<EafText<'a>>,
    /// `xsi:noNamespaceSchemaLocation`.
    pub schema: Option<EafText<'a>>,
    /// `LICENSE` elements.
    pub licenses: Vec<EafLicense<'a>>,
    /// `HEADER`.
    pub header: EafHeader<'a>,
    /// `TIME_ORDER`; its order matters, as slots without a value lie between their neighbours.
    pub time_order: Vec<TimeSlot<'a>>,
    /// `VOICELESS_TIER_NAME` elements.
    pub tiers: Vec<EafTier<'a>>,
    /// `LINGUISTIC_TYPE` elements.
    pub linguistic_types: Vec<LinguisticType<'a>>,
    /// `LOCALE` elements.
    pub locales: Vec<EafLocale<'a>>,
    /// `LANGUAGE` elements.
    pub languages: Vec<EafLanguage<'a>>,
    /// `CONSTRAINT` elements.
    pub constraints: Vec<EafConstraint<'a>>,
    /// `CONTROLLED_VOCABULARY` elements.
    pub vocabularies: Vec<EafVocabulary<'a>>,
    /// `LEXICON_REF` elements.
    pub lexicon_refs: Vec<LexiconRef<'a>>,
    /// `REF_LINK_SET` elements.
    pub ref_link_sets: Vec<RefLinkSet<'a>>,
    /// `EXTERNAL_REF` elements.
    pub external_refs: Vec<ExternalRef<'a>>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
    /// The text it was read from.
    pub source: EafSourceText<'a>,
}

impl EafDocument<'_> {
    /// Returns the line of the text, counted from 1, on which an element that was read starts.
    #[must_use]
    pub fn line_of_element(&self, at: ElementStart) -> Option<u64> {
        let before = self.source.0.as_bytes().get(..at.0 as usize)?;
        Some(line_at_byte(before, before.len()))
    }
}

/// `LICENSE`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct EafLicense<'a> {
    /// `LICENSE_URL`.
    pub url: EafText<'a>,
    /// The licence's text.
    pub text: EafText<'a>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
}

/// `HEADER`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct EafHeader<'a> {
    /// `MEDIA_FILE`, obsolete: empty in files of ELAN.
    pub media_file: EafText<'a>,
    /// `TIME_UNITS`: `milliseconds`, `PAL-frames` or `NTSC-frames`.
    pub time_units: Option<EafText<'a>>,
    /// `MEDIA_DESCRIPTOR` elements.
    pub media: Vec<MediaDescriptor<'a>>,
    /// `LINKED_FILE_DESCRIPTOR` elements.
    pub linked_files: Vec<LinkedFile<'a>>,
    /// `PROPERTY` elements.
    pub properties: Vec<EafProperty<'a>>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
}

/// `MEDIA_DESCRIPTOR`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct MediaDescriptor<'a> {
    /// `MEDIA_URL`.
    pub url: EafText<'a>,
    /// `MIME_TYPE`.
    pub mime_type: EafText<'a>,
    /// `RELATIVE_MEDIA_URL`.
    pub relative_url: Option<EafText<'a>>,
    /// `TIME_ORIGIN`: the time of the media, in milliseconds, at which the timeline begins.
    pub time_origin: Option<i64>,
    /// `EXTRACTED_FROM`.
    pub extracted_from: Option<EafText<'a>>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
}

/// `LINKED_FILE_DESCRIPTOR`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct LinkedFile<'a> {
    /// `LINK_URL`.
    pub url: EafText<'a>,
    /// `MIME_TYPE`.
    pub mime_type: EafText<'a>,
    /// `RELATIVE_LINK_URL`.
    pub relative_url: Option<EafText<'a>>,
    /// `TIME_ORIGIN` in milliseconds.
    pub time_origin: Option<i64>,
    /// `ASSOCIATED_WITH`.
    pub associated_with: Option<EafText<'a>>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
}

/// `PROPERTY`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct EafProperty<'a> {
    /// `NAME`.
    pub name: Option<EafText<'a>>,
    /// The value.
    pub value: EafText<'a>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
}

/// `TIME_SLOT`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct TimeSlot<'a> {
    /// `TIME_SLOT_ID`; ELAN renumbers them on every save.
    pub id: EafText<'a>,
    /// `TIME_VALUE` in the header's units; `None` for an unaligned slot.
    pub value: Option<i64>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
    /// Its position in the text.
    pub at: ElementStart,
}

/// `VOICELESS_TIER_NAME`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct EafTier<'a> {
    /// `TIER_ID`.
    pub id: EafText<'a>,
    /// `LINGUISTIC_TYPE_REF`.
    pub linguistic_type: EafText<'a>,
    /// `PARTICIPANT`.
    pub participant: Option<EafText<'a>>,
    /// `ANNOTATOR`.
    pub annotator: Option<EafText<'a>>,
    /// `DEFAULT_LOCALE`.
    pub locale: Option<EafText<'a>>,
    /// `PARENT_REF`.
    pub parent: Option<EafText<'a>>,
    /// `EXT_REF`.
    pub external_ref: Option<EafText<'a>>,
    /// `LANG_REF`.
    pub language: Option<EafText<'a>>,
    /// `ANNOTATION` elements.
    pub annotations: Vec<EafAnnotation<'a>>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
    /// Its position in the text.
    pub at: ElementStart,
}

/// `ANNOTATION` with the `ALIGNABLE_ANNOTATION` or `REF_ANNOTATION` in it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct EafAnnotation<'a> {
    /// `ANNOTATION_ID`.
    pub id: EafText<'a>,
    /// Its anchor.
    pub anchor: AnnotationAnchor<'a>,
    /// `ANNOTATION_VALUE`.
    pub value: EafText<'a>,
    /// `CVE_REF`: the vocabulary entry of the value.
    pub entry: Option<EafText<'a>>,
    /// `EXT_REF`: one or more external references, separated by blanks.
    pub external_ref: Option<EafText<'a>>,
    /// `LANG_REF`.
    pub language: Option<EafText<'a>>,
    /// `SVG_REF`, of an alignable annotation.
    pub svg: Option<EafText<'a>>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
    /// Its position in the text.
    pub at: ElementStart,
}

/// The anchor of an annotation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum AnnotationAnchor<'a> {
    /// `ALIGNABLE_ANNOTATION`: two time slots.
    Slots {
        /// `TIME_SLOT_REF1`.
        start: EafText<'a>,
        /// `TIME_SLOT_REF2`.
        end: EafText<'a>,
    },
    /// `REF_ANNOTATION`: another annotation.
    Parent {
        /// `ANNOTATION_REF`.
        parent: EafText<'a>,
        /// `PREVIOUS_ANNOTATION`, under the same parent.
        previous: Option<EafText<'a>>,
    },
}

/// `LINGUISTIC_TYPE`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct LinguisticType<'a> {
    /// `LINGUISTIC_TYPE_ID`.
    pub id: EafText<'a>,
    /// `TIME_ALIGNABLE`.
    pub time_alignable: Option<bool>,
    /// `STEREOTYPE_CONSTRAINTS`: a stereotype.
    pub constraints: Option<EafText<'a>>,
    /// `GRAPHIC_REFERENCES`.
    pub graphic_references: Option<bool>,
    /// `CONTROLLED_VOCABULARY_REF`.
    pub vocabulary: Option<EafText<'a>>,
    /// `EXT_REF`.
    pub external_ref: Option<EafText<'a>>,
    /// `LEXICON_REF`.
    pub lexicon_ref: Option<EafText<'a>>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
    /// Its position in the text.
    pub at: ElementStart,
}

/// `LOCALE`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct EafLocale<'a> {
    /// `LANGUAGE_CODE`.
    pub language: EafText<'a>,
    /// `COUNTRY_CODE`.
    pub country: Option<EafText<'a>>,
    /// `VARIANT`.
    pub variant: Option<EafText<'a>>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
}

/// `LANGUAGE`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct EafLanguage<'a> {
    /// `LANG_ID`.
    pub id: EafText<'a>,
    /// `LANG_DEF`.
    pub definition: Option<EafText<'a>>,
    /// `LANG_LABEL`.
    pub label: Option<EafText<'a>>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
}

/// `CONSTRAINT`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct EafConstraint<'a> {
    /// `STEREOTYPE`.
    pub stereotype: EafText<'a>,
    /// `OPERATOR_DESCRIPTION`.
    pub description: Option<EafText<'a>>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
}

/// `CONTROLLED_VOCABULARY`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct EafVocabulary<'a> {
    /// `CV_ID`.
    pub id: EafText<'a>,
    /// `EXT_REF`: the address of an external vocabulary.
    pub external_ref: Option<EafText<'a>>,
    /// `OPERATOR_DESCRIPTION` elements; one without a language is the attribute of formats before 2.8.
    pub descriptions: Vec<VocabularyDescription<'a>>,
    /// `CV_ENTRY_ML` elements, or the `CV_ENTRY` elements of formats before 2.8.
    pub entries: Vec<EafVocabularyEntry<'a>>,
    /// `EXTERNAL_REF` elements inside the vocabulary, as Global Signbank writes them.
    pub external_refs: Vec<ExternalRef<'a>>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
    /// Its position in the text.
    pub at: ElementStart,
}

/// `OPERATOR_DESCRIPTION` of a vocabulary.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct VocabularyDescription<'a> {
    /// `LANG_REF`; `None` before format 2.8.
    pub language: Option<EafText<'a>>,
    /// The description.
    pub text: EafText<'a>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
}

/// `CV_ENTRY_ML`, or the `CV_ENTRY` of formats before 2.8.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct EafVocabularyEntry<'a> {
    /// `CVE_ID`, unique within its vocabulary; optional before format 2.8.
    pub id: Option<EafText<'a>>,
    /// `EXT_REF`.
    pub external_ref: Option<EafText<'a>>,
    /// `CVE_VALUE` elements, one per language.
    pub values: Vec<EafEntryValue<'a>>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
}

/// `CVE_VALUE`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct EafEntryValue<'a> {
    /// `LANG_REF`; `None` before format 2.8.
    pub language: Option<EafText<'a>>,
    /// `OPERATOR_DESCRIPTION`.
    pub description: Option<EafText<'a>>,
    /// The value.
    pub value: EafText<'a>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
}

/// `LEXICON_REF`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct LexiconRef<'a> {
    /// `LEX_REF_ID`.
    pub id: EafText<'a>,
    /// `NAME`.
    pub name: EafText<'a>,
    /// `TYPE`.
    pub kind: EafText<'a>,
    /// `URL`.
    pub url: EafText<'a>,
    /// `LEXICON_ID`.
    pub lexicon_id: EafText<'a>,
    /// `LEXICON_NAME`.
    pub lexicon_name: EafText<'a>,
    /// `DATCAT_ID`.
    pub category_id: Option<EafText<'a>>,
    /// `DATCAT_NAME`.
    pub category_name: Option<EafText<'a>>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
}

/// `REF_LINK_SET`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct RefLinkSet<'a> {
    /// `LINK_SET_ID`, or the `LINKS_ID` of early files.
    pub id: EafText<'a>,
    /// `LINK_SET_NAME`.
    pub name: Option<EafText<'a>>,
    /// `EXT_REF`.
    pub external_ref: Option<EafText<'a>>,
    /// `LANG_REF`.
    pub language: Option<EafText<'a>>,
    /// `CV_REF`.
    pub vocabulary: Option<EafText<'a>>,
    /// `CROSS_REF_LINK` and `GROUP_REF_LINK` elements.
    pub links: Vec<RefLink<'a>>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
}

/// `CROSS_REF_LINK` or `GROUP_REF_LINK`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct RefLink<'a> {
    /// `REF_LINK_ID`.
    pub id: EafText<'a>,
    /// The elements that it links.
    pub ends: LinkEnds<'a>,
    /// `REF_LINK_NAME`.
    pub name: Option<EafText<'a>>,
    /// `EXT_REF`.
    pub external_ref: Option<EafText<'a>>,
    /// `LANG_REF`.
    pub language: Option<EafText<'a>>,
    /// `CVE_REF`.
    pub entry: Option<EafText<'a>>,
    /// `REF_TYPE`.
    pub kind: Option<EafText<'a>>,
    /// The link's own text.
    pub text: EafText<'a>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
}

/// The annotations or links that a [`RefLink`] joins.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LinkEnds<'a> {
    /// `CROSS_REF_LINK`.
    Cross {
        /// `REF1`.
        from: EafText<'a>,
        /// `REF2`.
        to: EafText<'a>,
        /// `DIRECTIONALITY`: `undirected`, `unidirectional` or `bidirectional`.
        directionality: Option<EafText<'a>>,
    },
    /// `GROUP_REF_LINK`: `REFS`, separated by blanks.
    Group(EafText<'a>),
}

impl Default for LinkEnds<'_> {
    fn default() -> Self {
        Self::Group(EafText::default())
    }
}

/// `EXTERNAL_REF`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ExternalRef<'a> {
    /// `EXT_REF_ID`.
    pub id: EafText<'a>,
    /// `TYPE`: `iso12620`, `ecv`, `cve_id`, `lexen_id` or `resource_url`.
    pub kind: EafText<'a>,
    /// `VALUE`.
    pub value: EafText<'a>,
    /// Parts beyond the schema.
    pub kept: KeptContents<'a>,
}

/// Returns the references of `document` that point nowhere and the ids that occur twice.
#[must_use]
pub fn check_eaf_references(document: &EafDocument<'_>) -> Vec<ImportFinding> {
    resolve_eaf_references(document).1
}
