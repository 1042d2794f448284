//! Mirrors an EAF document, element by element, in the names of the schema.
//!
//! Texts borrow from the bytes of the file if possible. Element order within each list is the file's; the
//! order of different elements is the schema's. Elements and attributes beyond the schema are kept in
//! [`Kept`] and written back at the end of their element.

use super::check::resolve;
pub use super::error::Error;
pub use super::read::{read, read_ecv};
pub use super::write::{upgraded, write};
use super::xml::line_of;
use crate::finding::Finding;
use std::borrow::Cow;

/// A text of the file, its references resolved.
pub type Text<'a> = Cow<'a, str>;

/// The contents of an element beyond the schema: attributes in order, then children as source text.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Unknown<'a> {
    /// Attributes by name.
    pub attributes: Vec<(Text<'a>, Text<'a>)>,
    /// Child elements, each as it is written in the file.
    pub elements: Vec<Text<'a>>,
}

/// [`Unknown`] parts of an element, if it has any.
pub type Kept<'a> = Option<Box<Unknown<'a>>>;

/// The byte at which an element starts in the text of the file; [`Document::line`] gives its line. It is
/// ignored in comparisons.
#[derive(Debug, Clone, Copy)]
pub struct At(pub(crate) u32);

impl Default for At {
    /// Returns the position of an element that is not from a file.
    fn default() -> Self {
        Self(u32::MAX)
    }
}

impl PartialEq for At {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for At {}

/// The text of the file; ignored in comparisons.
#[derive(Clone, Copy, Default)]
pub struct Source<'a>(pub(super) &'a str);

impl std::fmt::Debug for Source<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} bytes", self.0.len())
    }
}

impl PartialEq for Source<'_> {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for Source<'_> {}

/// `ANNOTATION_DOCUMENT`, or the `CV_RESOURCE` of an `.ecv` file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Document<'a> {
    /// `AUTHOR`; often empty.
    pub author: Text<'a>,
    /// `DATE` as an `xsd:dateTime`.
    pub date: Text<'a>,
    /// `VERSION` of the format.
    pub version: Text<'a>,
    /// `FORMAT`, the same as the version in practice.
    pub format: Option<Text<'a>>,
    /// `xsi:noNamespaceSchemaLocation`.
    pub schema: Option<Text<'a>>,
    /// `LICENSE` elements.
    pub licenses: Vec<License<'a>>,
    /// `HEADER`.
    pub header: Header<'a>,
    /// `TIME_ORDER`; its order matters, as slots without a value lie between their neighbours.
    pub time_order: Vec<TimeSlot<'a>>,
    /// `TIER` elements.
    pub tiers: Vec<Tier<'a>>,
    /// `LINGUISTIC_TYPE` elements.
    pub linguistic_types: Vec<LinguisticType<'a>>,
    /// `LOCALE` elements.
    pub locales: Vec<Locale<'a>>,
    /// `LANGUAGE` elements.
    pub languages: Vec<Language<'a>>,
    /// `CONSTRAINT` elements.
    pub constraints: Vec<Constraint<'a>>,
    /// `CONTROLLED_VOCABULARY` elements.
    pub vocabularies: Vec<Vocabulary<'a>>,
    /// `LEXICON_REF` elements.
    pub lexicon_refs: Vec<LexiconRef<'a>>,
    /// `REF_LINK_SET` elements.
    pub ref_link_sets: Vec<RefLinkSet<'a>>,
    /// `EXTERNAL_REF` elements.
    pub external_refs: Vec<ExternalRef<'a>>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
    /// The text it was read from.
    pub source: Source<'a>,
}

impl Document<'_> {
    /// Returns the line of the text, counted from 1, on which an element that was read starts.
    #[must_use]
    pub fn line(&self, at: At) -> Option<u64> {
        let before = self.source.0.as_bytes().get(..at.0 as usize)?;
        Some(line_of(before, before.len()))
    }
}

/// `LICENSE`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct License<'a> {
    /// `LICENSE_URL`.
    pub url: Text<'a>,
    /// The licence's text.
    pub text: Text<'a>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
}

/// `HEADER`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Header<'a> {
    /// `MEDIA_FILE`, obsolete: empty in files of ELAN.
    pub media_file: Text<'a>,
    /// `TIME_UNITS`: `milliseconds`, `PAL-frames` or `NTSC-frames`.
    pub time_units: Option<Text<'a>>,
    /// `MEDIA_DESCRIPTOR` elements.
    pub media: Vec<MediaDescriptor<'a>>,
    /// `LINKED_FILE_DESCRIPTOR` elements.
    pub linked_files: Vec<LinkedFile<'a>>,
    /// `PROPERTY` elements.
    pub properties: Vec<Property<'a>>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
}

/// `MEDIA_DESCRIPTOR`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct MediaDescriptor<'a> {
    /// `MEDIA_URL`.
    pub url: Text<'a>,
    /// `MIME_TYPE`.
    pub mime_type: Text<'a>,
    /// `RELATIVE_MEDIA_URL`.
    pub relative_url: Option<Text<'a>>,
    /// `TIME_ORIGIN`: the time of the media, in milliseconds, at which the timeline begins.
    pub time_origin: Option<i64>,
    /// `EXTRACTED_FROM`.
    pub extracted_from: Option<Text<'a>>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
}

/// `LINKED_FILE_DESCRIPTOR`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct LinkedFile<'a> {
    /// `LINK_URL`.
    pub url: Text<'a>,
    /// `MIME_TYPE`.
    pub mime_type: Text<'a>,
    /// `RELATIVE_LINK_URL`.
    pub relative_url: Option<Text<'a>>,
    /// `TIME_ORIGIN` in milliseconds.
    pub time_origin: Option<i64>,
    /// `ASSOCIATED_WITH`.
    pub associated_with: Option<Text<'a>>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
}

/// `PROPERTY`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Property<'a> {
    /// `NAME`.
    pub name: Option<Text<'a>>,
    /// The value.
    pub value: Text<'a>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
}

/// `TIME_SLOT`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct TimeSlot<'a> {
    /// `TIME_SLOT_ID`; ELAN renumbers them on every save.
    pub id: Text<'a>,
    /// `TIME_VALUE` in the header's units; `None` for an unaligned slot.
    pub value: Option<i64>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
    /// Its position in the text.
    pub at: At,
}

/// `TIER`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Tier<'a> {
    /// `TIER_ID`.
    pub id: Text<'a>,
    /// `LINGUISTIC_TYPE_REF`.
    pub linguistic_type: Text<'a>,
    /// `PARTICIPANT`.
    pub participant: Option<Text<'a>>,
    /// `ANNOTATOR`.
    pub annotator: Option<Text<'a>>,
    /// `DEFAULT_LOCALE`.
    pub locale: Option<Text<'a>>,
    /// `PARENT_REF`.
    pub parent: Option<Text<'a>>,
    /// `EXT_REF`.
    pub external_ref: Option<Text<'a>>,
    /// `LANG_REF`.
    pub language: Option<Text<'a>>,
    /// `ANNOTATION` elements.
    pub annotations: Vec<Annotation<'a>>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
    /// Its position in the text.
    pub at: At,
}

/// `ANNOTATION` with the `ALIGNABLE_ANNOTATION` or `REF_ANNOTATION` in it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Annotation<'a> {
    /// `ANNOTATION_ID`.
    pub id: Text<'a>,
    /// Its anchor.
    pub anchor: Anchor<'a>,
    /// `ANNOTATION_VALUE`.
    pub value: Text<'a>,
    /// `CVE_REF`: the vocabulary entry of the value.
    pub entry: Option<Text<'a>>,
    /// `EXT_REF`: one or more external references, separated by blanks.
    pub external_ref: Option<Text<'a>>,
    /// `LANG_REF`.
    pub language: Option<Text<'a>>,
    /// `SVG_REF`, of an alignable annotation.
    pub svg: Option<Text<'a>>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
    /// Its position in the text.
    pub at: At,
}

/// The anchor of an annotation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Anchor<'a> {
    /// `ALIGNABLE_ANNOTATION`: two time slots.
    Slots {
        /// `TIME_SLOT_REF1`.
        start: Text<'a>,
        /// `TIME_SLOT_REF2`.
        end: Text<'a>,
    },
    /// `REF_ANNOTATION`: another annotation.
    Parent {
        /// `ANNOTATION_REF`.
        parent: Text<'a>,
        /// `PREVIOUS_ANNOTATION`, under the same parent.
        previous: Option<Text<'a>>,
    },
}

/// `LINGUISTIC_TYPE`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct LinguisticType<'a> {
    /// `LINGUISTIC_TYPE_ID`.
    pub id: Text<'a>,
    /// `TIME_ALIGNABLE`.
    pub time_alignable: Option<bool>,
    /// `CONSTRAINTS`: a stereotype.
    pub constraints: Option<Text<'a>>,
    /// `GRAPHIC_REFERENCES`.
    pub graphic_references: Option<bool>,
    /// `CONTROLLED_VOCABULARY_REF`.
    pub vocabulary: Option<Text<'a>>,
    /// `EXT_REF`.
    pub external_ref: Option<Text<'a>>,
    /// `LEXICON_REF`.
    pub lexicon_ref: Option<Text<'a>>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
    /// Its position in the text.
    pub at: At,
}

/// `LOCALE`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Locale<'a> {
    /// `LANGUAGE_CODE`.
    pub language: Text<'a>,
    /// `COUNTRY_CODE`.
    pub country: Option<Text<'a>>,
    /// `VARIANT`.
    pub variant: Option<Text<'a>>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
}

/// `LANGUAGE`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Language<'a> {
    /// `LANG_ID`.
    pub id: Text<'a>,
    /// `LANG_DEF`.
    pub definition: Option<Text<'a>>,
    /// `LANG_LABEL`.
    pub label: Option<Text<'a>>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
}

/// `CONSTRAINT`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Constraint<'a> {
    /// `STEREOTYPE`.
    pub stereotype: Text<'a>,
    /// `DESCRIPTION`.
    pub description: Option<Text<'a>>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
}

/// `CONTROLLED_VOCABULARY`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Vocabulary<'a> {
    /// `CV_ID`.
    pub id: Text<'a>,
    /// `EXT_REF`: the address of an external vocabulary.
    pub external_ref: Option<Text<'a>>,
    /// `DESCRIPTION` elements; one without a language is the attribute of formats before 2.8.
    pub descriptions: Vec<Description<'a>>,
    /// `CV_ENTRY_ML` elements, or the `CV_ENTRY` elements of formats before 2.8.
    pub entries: Vec<Entry<'a>>,
    /// `EXTERNAL_REF` elements inside the vocabulary, as Global Signbank writes them.
    pub external_refs: Vec<ExternalRef<'a>>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
    /// Its position in the text.
    pub at: At,
}

/// `DESCRIPTION` of a vocabulary.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Description<'a> {
    /// `LANG_REF`; `None` before format 2.8.
    pub language: Option<Text<'a>>,
    /// The description.
    pub text: Text<'a>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
}

/// `CV_ENTRY_ML`, or the `CV_ENTRY` of formats before 2.8.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Entry<'a> {
    /// `CVE_ID`, unique within its vocabulary; optional before format 2.8.
    pub id: Option<Text<'a>>,
    /// `EXT_REF`.
    pub external_ref: Option<Text<'a>>,
    /// `CVE_VALUE` elements, one per language.
    pub values: Vec<EntryValue<'a>>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
}

/// `CVE_VALUE`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct EntryValue<'a> {
    /// `LANG_REF`; `None` before format 2.8.
    pub language: Option<Text<'a>>,
    /// `DESCRIPTION`.
    pub description: Option<Text<'a>>,
    /// The value.
    pub value: Text<'a>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
}

/// `LEXICON_REF`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct LexiconRef<'a> {
    /// `LEX_REF_ID`.
    pub id: Text<'a>,
    /// `NAME`.
    pub name: Text<'a>,
    /// `TYPE`.
    pub kind: Text<'a>,
    /// `URL`.
    pub url: Text<'a>,
    /// `LEXICON_ID`.
    pub lexicon_id: Text<'a>,
    /// `LEXICON_NAME`.
    pub lexicon_name: Text<'a>,
    /// `DATCAT_ID`.
    pub category_id: Option<Text<'a>>,
    /// `DATCAT_NAME`.
    pub category_name: Option<Text<'a>>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
}

/// `REF_LINK_SET`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct RefLinkSet<'a> {
    /// `LINK_SET_ID`, or the `LINKS_ID` of early files.
    pub id: Text<'a>,
    /// `LINK_SET_NAME`.
    pub name: Option<Text<'a>>,
    /// `EXT_REF`.
    pub external_ref: Option<Text<'a>>,
    /// `LANG_REF`.
    pub language: Option<Text<'a>>,
    /// `CV_REF`.
    pub vocabulary: Option<Text<'a>>,
    /// `CROSS_REF_LINK` and `GROUP_REF_LINK` elements.
    pub links: Vec<RefLink<'a>>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
}

/// `CROSS_REF_LINK` or `GROUP_REF_LINK`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct RefLink<'a> {
    /// `REF_LINK_ID`.
    pub id: Text<'a>,
    /// The elements that it links.
    pub ends: LinkEnds<'a>,
    /// `REF_LINK_NAME`.
    pub name: Option<Text<'a>>,
    /// `EXT_REF`.
    pub external_ref: Option<Text<'a>>,
    /// `LANG_REF`.
    pub language: Option<Text<'a>>,
    /// `CVE_REF`.
    pub entry: Option<Text<'a>>,
    /// `REF_TYPE`.
    pub kind: Option<Text<'a>>,
    /// The link's own text.
    pub text: Text<'a>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
}

/// The annotations or links that a [`RefLink`] joins.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LinkEnds<'a> {
    /// `CROSS_REF_LINK`.
    Cross {
        /// `REF1`.
        from: Text<'a>,
        /// `REF2`.
        to: Text<'a>,
        /// `DIRECTIONALITY`: `undirected`, `unidirectional` or `bidirectional`.
        directionality: Option<Text<'a>>,
    },
    /// `GROUP_REF_LINK`: `REFS`, separated by blanks.
    Group(Text<'a>),
}

impl Default for LinkEnds<'_> {
    fn default() -> Self {
        Self::Group(Text::default())
    }
}

/// `EXTERNAL_REF`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ExternalRef<'a> {
    /// `EXT_REF_ID`.
    pub id: Text<'a>,
    /// `TYPE`: `iso12620`, `ecv`, `cve_id`, `lexen_id` or `resource_url`.
    pub kind: Text<'a>,
    /// `VALUE`.
    pub value: Text<'a>,
    /// Parts beyond the schema.
    pub kept: Kept<'a>,
}

/// Returns the references of `document` that point nowhere and the ids that occur twice.
#[must_use]
pub fn check(document: &Document<'_>) -> Vec<Finding> {
    resolve(document).1
}
