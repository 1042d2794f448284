//! What an EAF document means, apart from how the file says it.

use chereme_motion::{Instant, Span};
use chereme_sign::Stereotype;
use serde::Serialize;

/// The tiers of one recording with what belongs to them.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct Transcript {
    /// Who made the file; often empty.
    pub author: String,
    /// When it was saved, as an `xsd:dateTime`.
    pub date: String,
    /// Media files, the main one first.
    pub media: Vec<Media>,
    /// Other files that belong to the recording, such as sensor data.
    pub linked_files: Vec<Media>,
    /// Named texts, such as ELAN's `URN`.
    pub properties: Vec<(String, String)>,
    /// The tiers in the order of the file.
    pub tiers: Vec<Tier>,
    /// The controlled vocabularies.
    pub vocabularies: Vec<Vocabulary>,
}

/// A media file or another file beside the annotations.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct Media {
    /// Where it was on the machine that wrote the file.
    pub url: String,
    /// Where it is from the annotation file.
    pub relative_url: Option<String>,
    /// Its MIME type.
    pub mime_type: String,
    /// The point of the media, in milliseconds, that is time 0 of the annotations.
    pub time_origin: Option<i64>,
    /// The media file that it was taken from or goes with.
    pub source: Option<String>,
}

/// A tier and its annotations.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct Tier {
    /// The name, unique in its transcript.
    pub name: String,
    /// The tier above, as an index into the transcript's tiers.
    pub parent: Option<usize>,
    /// How it hangs below its parent; nothing for a root tier.
    pub stereotype: Option<Stereotype>,
    /// The name of its ELAN tier type.
    pub kind: String,
    /// Who signs or speaks.
    pub participant: Option<String>,
    /// Who annotated.
    pub annotator: Option<String>,
    /// The language of the values, as an ELAN language id such as `eng`.
    pub language: Option<String>,
    /// The keyboard locale, such as `en`.
    pub locale: Option<String>,
    /// The id of the vocabulary that the values come from.
    pub vocabulary: Option<String>,
    /// The annotations in the order of the file.
    pub annotations: Vec<Annotation>,
}

/// An annotation of a [`Transcript`] by its tier and its place on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct Place {
    /// Index into the transcript's tiers.
    pub tier: usize,
    /// Index into the tier's annotations.
    pub index: usize,
}

/// One annotation.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Annotation {
    /// Its id in the file, such as `a12`, unique in its transcript.
    pub id: String,
    /// The time it holds.
    pub span: Span,
    /// Where that time comes from.
    pub timing: Timing,
    /// The annotation above it.
    pub parent: Option<Place>,
    /// The place among its siblings below a symbolic parent, from 0; 0 elsewhere.
    pub order: u32,
    /// What it says; empty where nothing was entered.
    pub value: String,
    /// The id of the vocabulary entry that the value is.
    pub entry: Option<String>,
    /// The language of the value where it is not the tier's.
    pub language: Option<String>,
    /// Ids of external references.
    pub external_ref: Option<String>,
    /// The file's own milliseconds, which are written back as they are; whoever moves the
    /// annotation sets this to nothing, and the span is rounded instead.
    pub millis: Option<[i64; 2]>,
}

/// Where the span of an annotation comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Timing {
    /// Both ends are the annotation's own.
    Own,
    /// An end was never set and lies evenly between its neighbours.
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
pub struct Vocabulary {
    /// The name by which tiers refer to it.
    pub id: String,
    /// Descriptions by language; the language is empty before format 2.8.
    pub descriptions: Vec<(String, String)>,
    /// The entries in order; none for one that lies in another file.
    pub entries: Vec<Entry>,
    /// Where an external vocabulary lies.
    pub external: Option<String>,
}

/// An entry of a [`Vocabulary`].
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct Entry {
    /// The id, unique in its vocabulary; empty in some files before format 2.8.
    pub id: String,
    /// The value in each language.
    pub values: Vec<EntryValue>,
    /// The id of an external reference.
    pub external_ref: Option<String>,
}

/// The value of an [`Entry`] in one language.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct EntryValue {
    /// The language id; empty before format 2.8.
    pub language: String,
    /// The value.
    pub value: String,
    /// What it means.
    pub description: Option<String>,
}

impl Transcript {
    /// Returns the annotation at `place`, if there is one.
    #[must_use]
    pub fn annotation(&self, place: Place) -> Option<&Annotation> {
        self.tiers.get(place.tier)?.annotations.get(place.index)
    }

    /// Returns the end of the last annotation.
    #[must_use]
    pub fn end(&self) -> Instant {
        let all = self.tiers.iter().flat_map(|tier| &tier.annotations);
        all.map(|annotation| annotation.span.end())
            .max()
            .unwrap_or_default()
    }
}
