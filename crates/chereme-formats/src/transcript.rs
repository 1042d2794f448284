//! The tiers of a recording with their annotations, independent of the format that they come from.

use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::TierStereotype;
use serde::Serialize;

/// The tier type of a tier that holds the elements of a track whose attributes have tiers of their own.
pub const ELEMENT_TIER_TYPE: &str = "ANVIL track";

/// The kind of a tier whose annotations are points in time.
pub const POINT_TIER_KIND: &str = "TextTier";

/// The tiers of one recording with what belongs to them.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct AnnotationTranscript {
    /// The author of the file; often empty.
    pub author: String,
    /// The time of the last save, as an `xsd:dateTime`.
    pub date: String,
    /// Media files, the main one first.
    pub media: Vec<TranscriptMedia>,
    /// Other files that belong to the recording, such as sensor data.
    pub linked_files: Vec<TranscriptMedia>,
    /// Named texts, such as ELAN's `URN`.
    pub properties: Vec<(String, String)>,
    /// The tiers in the order of the file.
    pub tiers: Vec<TranscriptTier>,
    /// The controlled vocabularies.
    pub vocabularies: Vec<ControlledVocabulary>,
}

/// A media file, or another file that belongs to the annotations.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct TranscriptMedia {
    /// Its address on the machine that wrote the file.
    pub url: String,
    /// Its address relative to the annotation file.
    pub relative_url: Option<String>,
    /// Its MIME type.
    pub mime_type: String,
    /// The time of the media, in milliseconds, that is time 0 of the annotations.
    pub time_origin: Option<i64>,
    /// The media file that it was extracted from or belongs to.
    pub source: Option<String>,
}

/// A tier and its annotations.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct TranscriptTier {
    /// The name, unique in its transcript.
    pub name: String,
    /// The tier above, as an index into the transcript's tiers.
    pub parent: Option<usize>,
    /// The constraint on annotations below the parent tier; `None` for a root tier.
    pub stereotype: Option<TierStereotype>,
    /// The name of its ELAN tier type.
    pub kind: String,
    /// The person who signs or speaks.
    pub participant: Option<String>,
    /// The person who annotated.
    pub annotator: Option<String>,
    /// The language of the values, as an ELAN language id such as `eng`.
    pub language: Option<String>,
    /// The keyboard locale, such as `en`.
    pub locale: Option<String>,
    /// The id of the vocabulary for the values.
    pub vocabulary: Option<String>,
    /// The annotations in the order of the file.
    pub annotations: Vec<TranscriptAnnotation>,
}

/// The address of an annotation in a [`AnnotationTranscript`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct AnnotationAddress {
    /// Index into the transcript's tiers.
    pub tier: usize,
    /// Index into the tier's annotations.
    pub index: usize,
}

/// One annotation.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct TranscriptAnnotation {
    /// Its id in the file, such as `a12`, unique in its transcript.
    pub id: String,
    /// Its time span.
    pub span: TimeSpan,
    /// The source of that time span.
    pub timing: AnnotationTiming,
    /// The annotation above it.
    pub parent: Option<AnnotationAddress>,
    /// Its position among its siblings below a symbolic parent, from 0; 0 elsewhere.
    pub order: u32,
    /// Its text; empty if nothing was entered.
    pub value: String,
    /// The id of the vocabulary entry of the value.
    pub entry: Option<String>,
    /// The language of the value, if it is not the tier's.
    pub language: Option<String>,
    /// Ids of external references.
    pub external_ref: Option<String>,
    /// The file's own milliseconds, which are written back unchanged; set this to `None` after moving the
    /// annotation, so that the span is rounded instead.
    pub millis: Option<[i64; 2]>,
}

/// The source of an annotation's span.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum AnnotationTiming {
    /// Both ends are the annotation's own.
    Own,
    /// An end was never set and is interpolated evenly between its neighbours.
    Proposed {
        /// The start was never set.
        start: bool,
        /// The end was never set.
        end: bool,
    },
    /// The span is that of the annotation above.
    Parent,
    /// The span is an even share of the annotation above.
    Share,
}

/// A controlled vocabulary.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct ControlledVocabulary {
    /// The name by which tiers refer to it.
    pub id: String,
    /// Descriptions by language; the language is empty before format 2.8.
    pub descriptions: Vec<(String, String)>,
    /// The entries in order; empty for a vocabulary in another file.
    pub entries: Vec<VocabularyEntry>,
    /// The address of an external vocabulary.
    pub external: Option<String>,
}

/// An entry of a [`ControlledVocabulary`].
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct VocabularyEntry {
    /// The id, unique in its vocabulary; empty in some files before format 2.8.
    pub id: String,
    /// The value in each language.
    pub values: Vec<VocabularyEntryValue>,
    /// The id of an external reference.
    pub external_ref: Option<String>,
}

/// The value of an [`VocabularyEntry`] in one language.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct VocabularyEntryValue {
    /// The language id; empty before format 2.8.
    pub language: String,
    /// The value.
    pub value: String,
    /// Its description.
    pub description: Option<String>,
}

impl AnnotationTranscript {
    /// Returns the annotation at `place`, if there is one.
    #[must_use]
    pub fn annotation_at(&self, place: AnnotationAddress) -> Option<&TranscriptAnnotation> {
        self.tiers.get(place.tier)?.annotations.get(place.index)
    }

    /// Returns the indices of the tiers, parents before those below them, else in the order of the file.
    #[must_use]
    pub fn tiers_parents_first(&self) -> Vec<usize> {
        // Parents in a circle must not be followed for ever.
        let depth = |tier: usize| {
            std::iter::successors(Some(tier), |at| self.tiers[*at].parent)
                .take(self.tiers.len() + 1)
                .count()
        };
        let mut order: Vec<usize> = (0..self.tiers.len()).collect();
        order.sort_by_key(|tier| (depth(*tier), *tier));
        order
    }

    /// Returns the end of the last annotation.
    #[must_use]
    pub fn transcript_end(&self) -> RecordingInstant {
        let all = self.tiers.iter().flat_map(|tier| &tier.annotations);
        all.map(|annotation| annotation.span.span_end_instant())
            .max()
            .unwrap_or_default()
    }
}
