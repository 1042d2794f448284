//! What operations of the history did, as values: stored with their names and counts, and described in any language.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::history_words::operation_summary;

/// The decision on a conflict.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ConflictDecision {
    /// This corpus stays as it is.
    Mine,
    /// The other candidate replaces that of this corpus.
    Theirs,
    /// Both stay: the other annotation goes on its own tier if there is room, otherwise on a tier next to it.
    Both,
}

/// What was done with the tiers of several recordings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[expect(missing_docs, reason = "each is a word of the deed")]
pub enum TierRoundDeed {
    Added,
    Changed,
    Copied,
    Removed,
    Shifted,
}

/// What an operation did. It is stored as JSON, whose `does` is the name of the operation with hyphens for its spaces.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "does", rename_all = "kebab-case")]
#[expect(
    missing_docs,
    reason = "fields are named like the things whose names or counts they hold"
)]
pub enum OperationEffect {
    /// Files were imported or updated: how many, and the first and last of them by name.
    Import { count: u64, first: String, last: String },
    /// A sign was made by a recipe.
    Recombine { gloss: String, recipe: String },
    /// A sign was made again by another recipe.
    RecombineAgain { gloss: String, recipe: String },
    /// Annotations were changed.
    Annotate(AnnotationEffect),
    /// Annotations were proposed from movement.
    Propose(AnnotationEffect),
    /// Proposed values became annotations.
    Accept {
        count: u64,
        #[serde(flatten)]
        annotations: AnnotationEffect,
    },
    /// Proposed values were rejected.
    Reject {
        count: u64,
        #[serde(flatten)]
        annotations: AnnotationEffect,
    },
    /// A third tier was made of the tiers of two annotators.
    Adjudicate { tier: String },
    /// The readings of an annotator count before those of others; or, without a name, those of nobody.
    PreferAnnotator { annotator: String },
    /// A tier was added to a recording.
    AddTier { tier: String, recording: String },
    /// A tier of a recording got other properties.
    ChangeTier { tier: String, recording: String },
    /// A tier was removed, with those below it.
    RemoveTier {
        tiers: Vec<String>,
        annotations: u64,
        recording: String,
    },
    /// The tiers of a scheme were added to a recording.
    AddTiers { count: u64, recording: String },
    /// A tier was copied under another name.
    CopyTier {
        tier: String,
        recording: String,
        copy: String,
        annotations: u64,
    },
    /// Tiers of several recordings were worked on: what was done with how many of them.
    WorkOnTiers {
        deed: TierRoundDeed,
        tiers: u64,
        recordings: u64,
    },
    /// The tiers of a recording were put in order.
    OrderTiers { recording: String },
    /// A value was added to an inventory.
    AddValue { value: String, inventory: String },
    /// A value of an inventory took the place of another.
    MergeValues {
        value: String,
        into: String,
        inventory: String,
    },
    /// Two values of different inventories became one.
    EquateValues { value: String, other: String },
    /// A value is one with no other any more.
    PartValue { value: String },
    /// A recording got other properties.
    ChangeRecording { recording: String },
    /// A signer got other properties.
    ChangeSigner { signer: String },
    /// A sign got other properties, or another gloss, which was written into so many annotations.
    ChangeSign {
        sign: String,
        #[serde(skip_serializing_if = "Option::is_none")]
        former: Option<String>,
        annotations: u64,
    },
    /// A token became the citation form of its sign.
    SetCitation { token: i64, gloss: String },
    /// A person got other names or properties.
    ChangePerson { person: String },
    /// People became one.
    UnitePeople { names: Vec<String>, person: String },
    /// Lexicons became one.
    UniteLexicons { names: Vec<String>, lexicon: String },
    /// Relations between signs were added or taken away.
    RelateSigns { count: u64, relation: String },
    /// A person of whom nothing was recorded was removed.
    RemovePerson { person: String },
    /// A table of people was read.
    ImportPeople { file: String, people: u64 },
    /// A lexicon without signs was removed.
    RemoveLexicon { lexicon: String },
    /// The signs of a lexicon were measured.
    MeasureSigns { signs: u64 },
    /// A lexicon got other properties.
    ChangeLexicon { lexicon: String },
    /// The glosses of recordings are looked up in a lexicon.
    LinkLexicon { lexicon: String, recordings: u64 },
    /// The glosses of recordings are looked up in no lexicon.
    UnlinkLexicon { recordings: u64 },
    /// A token was transcribed.
    Transcribe { token: i64, gloss: String },
    /// Tracks were added to a recording.
    AddTracks { recording: String, tracks: Vec<String> },
    /// A track was moved, renamed or removed.
    ChangeTrack {
        recording: String,
        track: String,
        #[serde(flatten)]
        change: TrackEffect,
    },
    /// A recording got other media files.
    ChangeMedia { recording: String },
    /// A skeleton was fitted to the markers of a track, or to those of one person in it.
    FitMarkers {
        recording: String,
        markers: String,
        #[serde(skip_serializing_if = "Option::is_none")]
        subject: Option<String>,
        millimetres: u64,
    },
    /// Lost markers were computed for recordings.
    RestoreMarkers { places: u64, recordings: u64 },
    /// The curves of a face were fitted to a signer.
    FitFace {
        track: String,
        signer: String,
        recording: String,
    },
    /// A sentence was cued with movements of the dictionary.
    CueFromDictionary { gloss: String, movements: u64 },
    /// The targets of cues were found in recordings.
    FindTargets { keys: u64, recordings: u64 },
    /// Searches were saved.
    KeepSearch { names: Vec<String> },
    /// A saved search got another name.
    RenameSearch { from: String, to: String },
    /// A saved search was removed.
    ForgetSearch { name: String },
    /// Recordings and signs were deleted.
    Delete { names: Vec<String> },
    /// A study was planned.
    PlanStudy { study: String },
    /// The answers of participants were imported.
    ImportAnswers { study: String, participants: u64 },
    /// A participant of a study was deleted.
    ForgetParticipant { study: String },
    /// A study was deleted.
    DeleteStudy { study: String },
    /// Signers or recordings got another consent.
    ChangeConsent { names: Vec<String> },
    /// Another corpus was merged.
    Merge {
        from: String,
        added: u64,
        changed: u64,
        removed: u64,
        conflicts: u64,
    },
    /// Conflicts were decided.
    Decide {
        conflicts: Vec<usize>,
        decision: ConflictDecision,
    },
    /// Derived rows were made again.
    Mend {},
    /// An operation with no more than a sentence: an earlier program stored it, or a newer one did.
    SummaryOnly { name: String, summary: String },
}

/// What happened to a track.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "change", rename_all = "kebab-case")]
#[expect(
    missing_docs,
    reason = "fields are named like the things whose names or counts they hold"
)]
pub enum TrackEffect {
    /// It starts at another time, in seconds with six decimals.
    Moved { seconds: String },
    /// It has another name.
    Renamed { to: String },
    /// It is gone.
    Removed,
}

/// What happened to annotations, and where.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct AnnotationEffect {
    /// The changes by kind.
    pub changes: Vec<AnnotationDeed>,
    /// How many recordings the annotations belong to.
    pub recordings: u64,
    /// The name of the recording, if it is one.
    #[serde(default)]
    pub recording: String,
}

/// A kind of change of annotations, and how many annotations changed like that.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "does", rename_all = "kebab-case")]
#[expect(missing_docs, reason = "each has the count of its annotations")]
pub enum AnnotationDeed {
    /// They are new.
    AnnotationsAdded { count: u64 },
    /// They are different.
    AnnotationsChanged { count: u64 },
    /// They are gone.
    AnnotationsRemoved { count: u64 },
    /// They have another time.
    AnnotationsMoved { count: u64 },
    /// They became one, two by two.
    AnnotationsMerged { count: u64 },
    /// They became two each.
    AnnotationsSplit { count: u64 },
    /// They all got this value.
    AnnotationsValued { count: u64, of: ValuedThing, value: String },
    /// They got different values.
    AnnotationsRevalued { count: u64 },
}

/// The thing that the value of an annotation describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[expect(missing_docs, reason = "each is a word of the field")]
pub enum ValuedThing {
    Handshape,
    Placement,
    Movement,
    Orientation,
    Gloss,
    Annotation,
}

impl AnnotationEffect {
    /// Creates the effect of changes in recordings, given by their names.
    pub(crate) fn from_changes(changes: Vec<AnnotationDeed>, recordings: &[String]) -> Self {
        let recording = match recordings {
            [one] => one.clone(),
            _ => String::new(),
        };
        let recordings = recordings.len() as u64;
        Self {
            changes,
            recordings,
            recording,
        }
    }

    /// Returns how many annotations were removed for others.
    pub(crate) fn count_removed(&self) -> u64 {
        let removed = self.changes.iter().map(|deed| match deed {
            AnnotationDeed::AnnotationsRemoved { count } => *count,
            _ => 0,
        });
        removed.sum()
    }
}

impl OperationEffect {
    /// Returns the value that is stored.
    pub(super) fn to_json(&self) -> Value {
        // No field is a map with keys other than texts, so that nothing can fail.
        serde_json::to_value(self).unwrap_or_default()
    }

    /// Returns the name and the English summary of the operation, and the JSON that is stored beside them.
    pub(crate) fn stored_texts(&self) -> (String, String, Option<String>) {
        // Without an understood effect, the texts are kept as they were stored.
        if let Self::SummaryOnly { name, summary } = self {
            return (name.clone(), summary.clone(), None);
        }
        let json = self.to_json();
        let name = json["does"].as_str().unwrap_or_default().replace('-', " ");
        (name, operation_summary(self), Some(json.to_string()))
    }

    /// Reads the effect of a stored operation; without JSON that this program understands, its texts are all there is.
    pub(crate) fn from_stored_texts(name: &str, summary: &str, json: Option<&str>) -> Self {
        let read = json.and_then(|json| serde_json::from_str(json).ok());
        read.unwrap_or_else(|| Self::SummaryOnly {
            name: name.to_owned(),
            summary: summary.to_owned(),
        })
    }

    /// Returns the form of the summary: `{field}` stands for a field, `{quoted field}` for one in quotation marks,
    /// `{counted field}` for a number with the field's name as its noun.
    pub(super) fn summary_form(&self) -> &'static str {
        match self {
            Self::Import { count: 0, .. } => "nothing new",
            Self::Import { count: 1, .. } => "{first}",
            Self::Import { .. } => "{count} files from {first} to {last}",
            Self::Recombine { .. } | Self::RecombineAgain { .. } => "{gloss} = {recipe}",
            Self::Annotate(annotations)
            | Self::Propose(annotations)
            | Self::Accept { annotations, .. }
            | Self::Reject { annotations, .. } => match annotations.recordings {
                1 => "{changes} in {recording}",
                _ => "{changes} in {recordings} recordings",
            },
            Self::Adjudicate { .. } => "{tier}",
            Self::PreferAnnotator { .. } => "{annotator}",
            Self::AddTier { .. } => "{quoted tier} to {recording}",
            Self::ChangeTier { .. } => "{quoted tier} of {recording}",
            Self::RemoveTier { .. } => "{tiers} with {annotations} from {recording}",
            Self::AddTiers { .. } => "{count} to {recording}",
            Self::CopyTier { .. } => "{quoted tier} of {recording} as {quoted copy} with {annotations}",
            Self::WorkOnTiers { .. } => "{counted tiers} {deed} in {counted recordings}",
            Self::OrderTiers { .. } | Self::ChangeRecording { .. } | Self::ChangeMedia { .. } => "{recording}",
            Self::AddValue { .. } => "{value} to {inventory}",
            Self::MergeValues { .. } => "{value} into {into} in {inventory}",
            Self::EquateValues { .. } => "{value} and {other}",
            Self::PartValue { .. } => "{value}",
            Self::ChangeSigner { .. } => "{signer}",
            Self::ChangeSign { former: None, .. } => "{sign}",
            Self::ChangeSign { .. } => "{former} to {sign}, {annotations}",
            Self::SetCitation { .. } => "token:{token} for {gloss}",
            Self::ChangePerson { .. } | Self::RemovePerson { .. } => "{person}",
            Self::UnitePeople { .. } => "{names} into {person}",
            Self::UniteLexicons { .. } => "{names} into {lexicon}",
            Self::RelateSigns { .. } => "{relation}: {count}",
            Self::ImportPeople { .. } => "{people} people from {file}",
            Self::ChangeLexicon { .. } | Self::RemoveLexicon { .. } => "{lexicon}",
            Self::MeasureSigns { .. } => "{counted signs}",
            Self::LinkLexicon { .. } => "{lexicon}: {counted recordings}",
            Self::UnlinkLexicon { .. } => "{counted recordings}",
            Self::Transcribe { .. } => "token:{token} {gloss}",
            Self::AddTracks { .. } => "{recording}: {tracks}",
            Self::ChangeTrack { change, .. } => match change {
                TrackEffect::Moved { .. } => "{recording}: {track} starts at {seconds} s",
                TrackEffect::Renamed { .. } => "{recording}: {track} is now {to}",
                TrackEffect::Removed => "{recording}: {track} removed",
            },
            Self::FitMarkers { subject: None, .. } => "{recording}: a skeleton fitted to {markers}, {millimetres} mm",
            Self::FitMarkers { .. } => "{recording}: a skeleton fitted to {markers} of {subject}, {millimetres} mm",
            Self::RestoreMarkers { .. } => "{places} places of {recordings} recordings",
            Self::FitFace { .. } => "weights of {track} fitted to {signer} on {recording}",
            Self::CueFromDictionary { .. } => "{gloss} from {movements} movements",
            Self::FindTargets { .. } => "{keys} keys of {recordings} recordings",
            Self::KeepSearch { .. } | Self::Delete { .. } | Self::ChangeConsent { .. } => "{names}",
            Self::RenameSearch { .. } => "{from} to {to}",
            Self::ForgetSearch { .. } => "{name}",
            Self::PlanStudy { .. } | Self::ForgetParticipant { .. } | Self::DeleteStudy { .. } => "{study}",
            Self::ImportAnswers { .. } => "{study}, {participants}",
            Self::Merge { .. } => "{from}: {added} added, {changed} changed, {removed} removed, {conflicts}",
            Self::Decide { .. } => "conflict {conflicts}: {decision}",
            Self::Mend {} => "tokens derived again",
            Self::SummaryOnly { .. } => "{summary}",
        }
    }
}
