//! Annotations that detectors find in recordings, stored as proposals on tiers of their own.

pub(crate) mod detect_faces;
mod detect_glosses;

use std::ops::Range;

use chereme_analysis::cut::{BaselineCuts, UncutReason, cut_baselines};
use chereme_analysis::detect::{
    ALL_DETECTORS, AnnotationDetector, DetectedStretch, DetectedSubject, ObservedBody, ObservedSigner, SignDetector,
    SignerPart, find_detector,
};
use chereme_formats::roles::AnnotatedHands;
use chereme_formats::table::annotations::TableMoment;
use chereme_motion::ends::OddFrames;
use chereme_motion::{BodyAnatomy, RecordingInstant, TimeSpan};
use chereme_sign::TierRole;
use rusqlite::Connection;
use serde::Serialize;

use crate::Corpus;
use crate::address::{self, CorpusAddress, RowName};
use crate::annotate::{AnnotateOptions, AnnotationAction, AnnotationChange, AnnotationName, NewTier, TierRequestName};
use crate::contents::ProposalAcceptor;
use crate::db::stored_columns::{AnnotationOrigin, RecordOrigin};
use crate::db::stored_recordings::{self, RecordingRow};
use crate::db::stored_tiers::{self, AnnotationRow, PROPOSAL_TIER_SUFFIX, REJECTED_TIER_SUFFIX, TierRow, proposed_for};
use crate::error::{CorpusError, CorpusResult};
use crate::movement::{ChannelGroup, MotionTrack};
use crate::progress::ProgressReceiver;
use crate::propose::{ProposeScope, accepting_tier, proposal_tier};
use crate::words::effect::{AnnotationEffect, OperationEffect};

use detect_faces::FaceCurves;
pub use detect_faces::FaceProposals;
pub use detect_glosses::GLOSSES_FROM_NAMES;

/// The length of movement that is examined at once, in microseconds: ten minutes.
const DETECTION_PIECE_US: i64 = 600_000_000;
/// The time before and after such a piece that is read with it, in microseconds.
const DETECTION_MARGIN_US: i64 = 10_000_000;

/// Options of a detection: the detector, the recordings, and the use of what it finds.
#[derive(Debug, Clone, PartialEq)]
pub struct DetectOptions {
    /// The name of the detector, one of [`ALL_DETECTORS`].
    pub detector: String,
    /// The recordings; of a token or a span, the detections that overlap it.
    pub scope: ProposeScope,
    /// The use of the detections.
    pub use_as: DetectionUse,
    /// The cost of a sign for the detector of signs, if not the usual one: a larger one gives fewer signs.
    pub sign_cost: Option<f64>,
}

/// The use of detections.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DetectionUse {
    /// They are shown, and nothing is written.
    Shown,
    /// They become proposals, on tiers of their own.
    #[default]
    Proposed,
    /// They become codings by the author of the corpus, on the author's own tiers, where nothing else lies.
    Coded,
}

impl DetectOptions {
    /// Returns the options that propose what a detector finds in its usual way.
    #[must_use]
    pub fn propose_with(detector: impl Into<String>, scope: ProposeScope) -> Self {
        Self {
            detector: detector.into(),
            scope,
            use_as: DetectionUse::Proposed,
            sign_cost: None,
        }
    }
}

/// The result of a detection.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct DetectionReport {
    /// The name of the detector.
    pub detector: String,
    /// How many annotations were written.
    pub annotations: u64,
    /// The names of the recordings with new annotations, or without earlier ones that are no longer found, in order.
    pub recordings: Vec<String>,
    /// How many recordings have no part that the detector examines.
    pub unobserved: u64,
    /// The proposals of each recording with any.
    pub found: Vec<DetectedIn>,
    /// The recordings in which nothing was found, each with the reason, if the detector knows it.
    pub without: Vec<UndetectedIn>,
}

/// A recording in which nothing was found.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct UndetectedIn {
    /// The recording's name.
    pub recording: String,
    /// The reason, and what can be done.
    pub why: String,
}

/// The proposals for a recording.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DetectedIn {
    /// The recording's name.
    pub recording: String,
    /// The proposals, field by field in order of time.
    pub proposals: Vec<ProposedAnnotation>,
}

/// A proposed annotation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ProposedAnnotation {
    /// Its subject.
    #[serde(skip)]
    pub subject: DetectedSubject,
    /// The tier on which it belongs.
    pub tier: String,
    /// Its start on the recording's clock, in microseconds.
    pub start_us: i64,
    /// The first microsecond after it.
    pub end_us: i64,
    /// The gloss of a sign, or the value of the field's inventory.
    pub value: String,
    /// The confidence, from 0 to 1.
    pub confidence: f64,
    /// The rule that found it, with its numbers.
    pub why: String,
}

impl ProposedAnnotation {
    /// Creates the proposal for a detection in a recording that ends at `end`, in microseconds.
    fn new(detection: DetectedStretch, end: i64) -> Self {
        Self {
            tier: subject_tier(&detection.subject),
            start_us: detection.span.span_start_instant().instant_micros().min(end),
            end_us: detection.span.span_end_instant().instant_micros().min(end),
            value: detection.value,
            confidence: (detection.confidence * 1000.0).round() / 1000.0,
            why: detection.why,
            subject: detection.subject,
        }
    }
}

/// Returns the name of the tier for proposals about a subject, such as `gloss (proposed)`.
fn subject_tier(subject: &DetectedSubject) -> String {
    match subject {
        DetectedSubject::Sign => format!("gloss{PROPOSAL_TIER_SUFFIX}"),
        DetectedSubject::Field(field) => proposal_tier(field),
    }
}

/// Changes that store proposals.
#[derive(Default)]
pub(crate) struct ProposalChanges {
    tiers: Vec<NewTier>,
    changes: Vec<AnnotationChange>,
    /// The detector that found them.
    detector: Option<&'static str>,
    /// How many annotations are added.
    pub(crate) added: u64,
}

impl Corpus {
    /// Runs a detector on recordings, and by default writes its detections onto tiers of their own, named for example
    /// `gloss (proposed)`.
    ///
    /// Each is an annotation by a detector ([`AnnotationOrigin::Detector`]) with its confidence. Earlier proposals on
    /// the tiers of its subjects that nobody has changed are replaced, even if nothing is found there any more; annotations of
    /// people stay. All of it is one operation, which one undo reverts. Movement is examined in pieces of ten minutes, without
    /// odd frames at its ends.
    ///
    /// # Errors
    /// [`CorpusError::Stopped`] if `progress` asks to stop before anything is written. Fails if there is no such detector,
    /// nothing has the name in the scope, a named recording has no part that the detector examines, or the corpus cannot
    /// be written.
    pub fn run_detection(
        &mut self,
        options: &DetectOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<DetectionReport> {
        let priced = SignDetector {
            sign_cost: options.sign_cost,
        };
        // Only the detector of signs has a cost, so that it alone is replaced by one with the asked cost.
        let detector: &dyn AnnotationDetector = match find_detector_by_name(&options.detector)? {
            detector if detector.detector_name() == priced.detector_name() => &priced,
            detector if options.sign_cost.is_some() => {
                let text = format!("{} has no cost of a sign", detector.detector_name());
                return Err(CorpusError::from_wrong_message(text).with_advice("leave the cost out, or detect signs"));
            }
            detector => detector,
        };
        let connection = self.store.read_connection();
        let (all, within) = recordings_of_scope(connection, &options.scope)?;
        let mut detected = DetectionReport {
            detector: options.detector.clone(),
            ..DetectionReport::default()
        };
        let mut changes = ProposalChanges::default();
        for (done, row) in all.iter().enumerate() {
            progress.report_items(&row.name, done, all.len())?;
            let span = within.unwrap_or_else(|| whole_recording_span(row));
            let mut proposals = match propose_for_recording(connection, detector, row)? {
                DetectionOutcome::Found(proposals) => proposals,
                DetectionOutcome::Nothing(why) => {
                    let recording = row.name.clone();
                    detected.without.push(UndetectedIn { recording, why });
                    Vec::new()
                }
                DetectionOutcome::Unobserved => {
                    // Of many recordings some may have no body or face; one that is named alone should have
                    // it.
                    if !matches!(options.scope, ProposeScope::All | ProposeScope::Recordings(_)) {
                        return Err(unobserved(detector, row));
                    }
                    detected.unobserved += 1;
                    continue;
                }
            };
            // Whole recordings are examined, since a detector needs what lies around a span to judge it.
            proposals.retain(|proposal| span_overlaps_times(span, proposal.start_us, proposal.end_us));
            let coder = match options.use_as {
                DetectionUse::Coded => Some(self.proposal_acceptor(row.id)?),
                DetectionUse::Shown | DetectionUse::Proposed => None,
            };
            changes.take_proposals(connection, row.id, span, detector, &proposals, coder.as_ref())?;
            if !proposals.is_empty() {
                detected.found.push(DetectedIn {
                    recording: row.name.clone(),
                    proposals,
                });
            }
        }
        if options.use_as != DetectionUse::Shown {
            detected.annotations = changes.added;
            detected.recordings = self.store_proposals(&changes, options.use_as, progress)?;
        }
        Ok(detected)
    }

    /// Writes proposals as one operation, and returns the names of the changed recordings.
    pub(crate) fn store_proposals(
        &mut self,
        changes: &ProposalChanges,
        use_as: DetectionUse,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<Vec<String>> {
        // An operation without changes would still show in the history.
        if changes.changes.is_empty() {
            return Ok(Vec::new());
        }
        type EffectOf = fn(AnnotationEffect) -> OperationEffect;
        let (effect, origin): (EffectOf, _) = match use_as {
            DetectionUse::Coded => (OperationEffect::Annotate, AnnotationOrigin::Human),
            DetectionUse::Shown | DetectionUse::Proposed => (OperationEffect::Propose, AnnotationOrigin::Detector),
        };
        let options = AnnotateOptions {
            origin,
            detector: changes.detector,
            ..AnnotateOptions::default()
        };
        let report = self.annotate_with(effect, &changes.tiers, &changes.changes, &options, progress)?;
        Ok(report.recordings)
    }
}

/// Returns the detector of that name.
fn find_detector_by_name(name: &str) -> CorpusResult<&'static dyn AnnotationDetector> {
    find_detector(name).ok_or_else(|| {
        let names: Vec<&str> = ALL_DETECTORS
            .iter()
            .map(|candidate| candidate.detector_name())
            .collect();
        CorpusError::from_wrong_message(format!("no detector is called {name:?}"))
            .with_error_place(name)
            .with_advice(format!("the detectors are: {}", names.join(", ")))
    })
}

/// Returns the recordings of a scope, and the span that detections must overlap.
pub(crate) fn recordings_of_scope(
    connection: &Connection,
    scope: &ProposeScope,
) -> CorpusResult<(Vec<RecordingRow>, Option<TimeSpan>)> {
    Ok(match scope {
        ProposeScope::All => (stored_recordings::load_recording_rows(connection)?, None),
        ProposeScope::Recordings(names) => {
            let rows = names
                .iter()
                .map(|name| address::find_recording_by_name(connection, name));
            (rows.collect::<CorpusResult<_>>()?, None)
        }
        ProposeScope::Recording(name) => (vec![address::find_recording_by_name(connection, name)?], None),
        ProposeScope::Span(name, span) => (vec![address::find_recording_by_name(connection, name)?], Some(*span)),
        ProposeScope::Token(token) => {
            let token_stretch = address::find_addressed_stretch(connection, &CorpusAddress::Token(*token))?;
            (vec![token_stretch.recording], Some(token_stretch.span))
        }
    })
}

/// The detections in a recording.
pub(crate) enum DetectionOutcome {
    /// The proposals.
    Found(Vec<ProposedAnnotation>),
    /// It found nothing, for this reason.
    Nothing(String),
    /// The recording has no part that the detector examines.
    Unobserved,
}

/// Returns the proposals of a detector for a recording.
pub(crate) fn propose_for_recording(
    connection: &Connection,
    detector: &dyn AnnotationDetector,
    row: &RecordingRow,
) -> CorpusResult<DetectionOutcome> {
    let examines = |part| detector.examines().contains(&part);
    // A track is read only for a detector that looks at that part.
    let moves = examines(SignerPart::Body) && stored_recordings::body_track(connection, row.id)?.is_some();
    let face = match examines(SignerPart::Face) {
        true => FaceCurves::read_face_curves(connection, row)?,
        false => None,
    };
    if !moves && face.is_none() {
        return Ok(DetectionOutcome::Unobserved);
    }
    let face = face.as_ref();
    let detections = match moves {
        true => {
            let take = ExaminedTake::open_examined_take(connection, row, face)?;
            take.detect_in_pieces(detector, DETECTION_PIECE_US, DETECTION_MARGIN_US)?
        }
        false => detector.detect_annotations(&ObservedSigner {
            body: None,
            face: face.map(FaceCurves::detector_curves),
        }),
    };
    let detections = match detections {
        Ok(detections) => detections,
        Err(reason) => return Ok(DetectionOutcome::Nothing(reason.to_string())),
    };
    let mut proposals: Vec<ProposedAnnotation> = detections
        .into_iter()
        .map(|detection| ProposedAnnotation::new(detection, row.duration_us))
        .collect();
    // A detection past the recording's end was cut to it above, and may have no length left.
    proposals.retain(|proposal| proposal.end_us > proposal.start_us);
    Ok(DetectionOutcome::Found(proposals))
}

/// The movement of a recording that a detector examines, without odd frames at its ends.
pub(crate) struct ExaminedTake<'a> {
    connection: &'a Connection,
    track: MotionTrack,
    anatomy: BodyAnatomy,
    sound: Range<usize>,
    face: Option<&'a FaceCurves>,
}

impl<'a> ExaminedTake<'a> {
    pub(crate) fn open_examined_take(
        connection: &'a Connection,
        row: &RecordingRow,
        face: Option<&'a FaceCurves>,
    ) -> CorpusResult<Self> {
        let track = MotionTrack::open_motion_track(connection, row.id)?;
        let anatomy = track.track_anatomy(connection)?;
        let all = track.motion_frame_count();
        // Generated movement has no trouble of a capture at its ends, such as a pose for calibration.
        let sound = match row.origin {
            RecordOrigin::Made => 0..all,
            _ => OddFrames::remaining_frames(all, &track.odd_frames(connection, &anatomy)?),
        };
        Ok(Self {
            connection,
            track,
            anatomy,
            sound,
            face,
        })
    }

    /// Returns the cuts of the take in the simplest ways, on the recording's clock.
    pub(crate) fn cut_into_baselines(&self) -> CorpusResult<BaselineCuts> {
        let sound = self.sound.clone();
        // The cuts count from the first sound frame, and the track may begin later than the recording.
        let start = self.track.row.offset_us + self.track.rate.frame_start_instant(sound.start).instant_micros();
        let clip = self
            .track
            .read_motion_clip(self.connection, sound, &ChannelGroup::ALL_CHANNEL_GROUPS)?;
        let mut cuts = cut_baselines(&clip, &self.anatomy);
        for span in cuts.activities.iter_mut().chain(&mut cuts.speed_minima) {
            *span = span.shifted_span(start);
        }
        Ok(cuts)
    }

    /// Returns the detections, subject by subject in order of time. The movement is examined in pieces of so many
    /// microseconds, each with some time around it; each detection belongs to the piece in which it starts.
    fn detect_in_pieces(
        &self,
        detector: &dyn AnnotationDetector,
        piece: i64,
        around: i64,
    ) -> CorpusResult<Result<Vec<DetectedStretch>, UncutReason>> {
        let rate = self.track.rate;
        let frame_micros = |frame: usize| rate.frame_start_instant(frame).instant_micros();
        let first = self.track.row.offset_us + frame_micros(self.sound.start);
        let instant_at = |micros: i64| RecordingInstant::from_micros(first.saturating_add(micros));
        let length = frame_micros(self.sound.end) - frame_micros(self.sound.start);
        let mut all: Vec<DetectedStretch> = Vec::new();
        let mut reason = None;
        let mut start = 0;
        loop {
            let end = start + piece;
            let is_last = end >= length;
            let wanted = TimeSpan::span_between(instant_at((start - around).max(0)), instant_at(end + around));
            let wanted_frames = self.track.frames_in(wanted);
            // The last piece takes the frames up to the sound end, whatever rounding does to its time.
            let frames = match is_last {
                true => wanted_frames.start.max(self.sound.start)..self.sound.end,
                false => wanted_frames.start.max(self.sound.start)..wanted_frames.end.min(self.sound.end),
            };
            let begins = RecordingInstant::from_micros(self.track.row.offset_us + frame_micros(frames.start));
            let clip = self
                .track
                .read_motion_clip(self.connection, frames, &ChannelGroup::ALL_CHANNEL_GROUPS)?;
            let detections = detector.detect_annotations(&ObservedSigner {
                body: Some(ObservedBody {
                    clip: &clip,
                    anatomy: &self.anatomy,
                    start: begins,
                }),
                face: self.face.map(FaceCurves::detector_curves),
            });
            // A piece without detections is no failure of the take; the reason counts only if all pieces have
            // none.
            let detections = detections.unwrap_or_else(|why| {
                reason = Some(why);
                Vec::new()
            });
            // Margins overlap the neighbouring pieces, so that each detection counts in one piece only.
            let starts_inside = |detection: &DetectedStretch| {
                let from = detection.span.span_start_instant();
                (start == 0 || from >= instant_at(start)) && (is_last || from < instant_at(end))
            };
            for detection in detections.into_iter().filter(starts_inside) {
                let overlaps = |earlier: &DetectedStretch| {
                    earlier.subject == detection.subject
                        && earlier.span.span_end_instant() > detection.span.span_start_instant()
                };
                // The same detection may begin on either side of a border, as pieces see different
                // surroundings.
                let is_near = start > 0 && detection.span.span_start_instant() < instant_at(start + around);
                if !is_near || !all.iter().any(overlaps) {
                    all.push(detection);
                }
            }
            if is_last {
                // Pieces were appended one after another, and the sort is stable, so that times stay in
                // order.
                if start > 0 {
                    let subjects = detector.detected_subjects();
                    all.sort_by_key(|detection| subjects.iter().position(|subject| *subject == detection.subject));
                }
                return Ok(match reason {
                    Some(why) if all.is_empty() => Err(why),
                    _ => Ok(all),
                });
            }
            start = end;
        }
    }
}

/// Returns the error for a recording without any part that a detector examines.
fn unobserved(detector: &dyn AnnotationDetector, row: &RecordingRow) -> CorpusError {
    match detector.examines() {
        [SignerPart::Face] => crate::curves::face_captured::no_face(&row.name),
        _ => crate::movement::no_movement(&row.name),
    }
}

fn whole_recording_span(row: &RecordingRow) -> TimeSpan {
    TimeSpan::span_between(
        RecordingInstant::RECORDING_START,
        RecordingInstant::from_micros(row.duration_us),
    )
}

/// Returns whether a span and a stretch of microseconds have time in common.
pub(crate) fn span_overlaps_times(span: TimeSpan, start: i64, end: i64) -> bool {
    start < span.span_end_instant().instant_micros() && span.span_start_instant().instant_micros() < end
}

impl ProposalChanges {
    /// Adds the changes that store the proposals of a detector for a recording: on each tier of its subjects they replace
    /// the annotations of detectors that overlap `within`, and leave out what other annotations occupy. With a `coder` they
    /// go onto that person's tiers, and replace nothing.
    pub(crate) fn take_proposals(
        &mut self,
        connection: &Connection,
        recording: i64,
        within: TimeSpan,
        detector: &dyn AnnotationDetector,
        proposals: &[ProposedAnnotation],
        coder: Option<&ProposalAcceptor>,
    ) -> CorpusResult<()> {
        self.detector = Some(detector.detector_name());
        let tier_rows = stored_tiers::load_tier_rows(connection, recording)?;
        let rejected = rejected_proposals(connection, &tier_rows)?;
        let is_name_used = |name: &str| tier_rows.iter().any(|row| row.name == name);
        for subject in detector.detected_subjects() {
            let proposal_name = subject_tier(&subject);
            let mut tier = new_subject_tier(recording, &subject);
            let known_tier = match coder {
                None => tier_rows.iter().find(|row| row.name == proposal_name),
                Some(coder) => {
                    let own_name = proposed_for(&proposal_name).unwrap_or(&proposal_name);
                    tier.name = match is_name_used(own_name) {
                        true => format!("{own_name} ({})", coder.author),
                        false => own_name.to_owned(),
                    };
                    let row = TierRow {
                        name: proposal_name.clone(),
                        role: tier.role.clone(),
                        hand: tier.hand,
                        ..TierRow::default()
                    };
                    accepting_tier(&row, tier_rows.iter(), coder)
                }
            };
            // Annotations that stay, and proposals already taken, keep others from being laid over them.
            let mut occupied = Vec::new();
            if let Some(row) = known_tier {
                tier.name.clone_from(&row.name);
                for old in stored_tiers::load_tier_annotation_rows(connection, row.id)? {
                    let is_replaced = coder.is_none()
                        && old.origin == AnnotationOrigin::Detector
                        && span_overlaps_times(within, old.start_us, old.end_us);
                    if is_replaced {
                        let annotation = AnnotationName::Number(old.id);
                        self.changes.push(AnnotationAction::Remove { annotation }.into());
                    } else {
                        occupied.push(old.start_us..old.end_us);
                    }
                }
            }
            let name = tier.name.clone();
            // A tier is created with its first proposal only, so that no empty tiers appear.
            let mut needed_tier = known_tier.is_none().then_some(tier);
            for proposal in proposals.iter().filter(|proposal| proposal.subject == subject) {
                // Proposed again, it would have to be rejected again.
                let is_rejected = |(tier, row): &(String, AnnotationRow)| {
                    *tier == proposal_name && row.value == proposal.value && overlaps_proposal(row, proposal)
                };
                if rejected.iter().any(is_rejected) {
                    continue;
                }
                let mut others = occupied.iter();
                if others.any(|other| other.start < proposal.end_us && proposal.start_us < other.end) {
                    continue;
                }
                self.tiers.extend(needed_tier.take());
                occupied.push(proposal.start_us..proposal.end_us);
                self.changes.push(addition(recording, &name, proposal));
                self.added += 1;
            }
        }
        Ok(())
    }
}

/// Returns the proposals of a recording that a person rejected, each with the name of its tier of proposals.
fn rejected_proposals(connection: &Connection, tiers: &[TierRow]) -> CorpusResult<Vec<(String, AnnotationRow)>> {
    let mut rejected = Vec::new();
    for tier in tiers {
        if let Some(name) = tier.name.strip_suffix(REJECTED_TIER_SUFFIX) {
            let rows = stored_tiers::load_tier_annotation_rows(connection, tier.id)?;
            let name = format!("{name}{PROPOSAL_TIER_SUFFIX}");
            rejected.extend(rows.into_iter().map(|row| (name.clone(), row)));
        }
    }
    Ok(rejected)
}

/// Returns whether an annotation lies over at least half of a proposal.
fn overlaps_proposal(row: &AnnotationRow, proposal: &ProposedAnnotation) -> bool {
    let shared = row.end_us.min(proposal.end_us) - row.start_us.max(proposal.start_us);
    shared * 2 >= proposal.end_us - proposal.start_us
}

/// Returns the new tier for proposals about a subject.
fn new_subject_tier(recording: i64, subject: &DetectedSubject) -> NewTier {
    let (role, hand) = match subject {
        DetectedSubject::Sign => (TierRole::Gloss, None),
        DetectedSubject::Field(field) => {
            let role = TierRole::Component {
                component: field.component,
                feature: field.feature.clone(),
            };
            (role, field.hand)
        }
    };
    let mut tier = NewTier::new(RowName::Number(recording), subject_tier(subject), role);
    tier.hand = hand.map(AnnotatedHands::One);
    tier
}

/// Returns the change that adds a proposal to a tier.
fn addition(recording: i64, tier: &str, proposal: &ProposedAnnotation) -> AnnotationChange {
    let time = |micros| Some(TableMoment::Time(RecordingInstant::from_micros(micros)));
    AnnotationAction::Add {
        tier: TierRequestName::Of {
            recording: RowName::Number(recording),
            tier: tier.to_owned(),
        },
        start: time(proposal.start_us),
        end: time(proposal.end_us),
        parent: None,
        order: None,
        value: proposal.value.clone(),
        confidence: Some(proposal.confidence),
    }
    .into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ImportOptions, ignore_progress_step, starter_files};

    #[test]
    fn movement_in_pieces_has_the_detections_of_the_whole() {
        let folder = tempfile::tempdir().expect("a folder");
        let (_, bytes) = starter_files()
            .find(|(file, _)| file.ends_with("phrase.bvh"))
            .expect("a starter capture");
        let path = folder.path().join("phrase.bvh");
        std::fs::write(&path, bytes).expect("written");
        let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
        let mut hear = ignore_progress_step;
        let options = ImportOptions::default();
        corpus
            .import_paths(&[path], &options, &mut ProgressReceiver::new(&mut hear))
            .expect("taken in");
        let connection = corpus.store.read_connection();
        let row = stored_recordings::load_recording_row(connection, 1).expect("a recording");
        let take = ExaminedTake::open_examined_take(connection, &row, None).expect("a take");
        let signs = find_detector("signs").expect("a detector");
        let detect = |piece: i64, around: i64| {
            let detections = take.detect_in_pieces(signs, piece, around).expect("examined");
            detections.expect("signs")
        };
        let whole = detect(DETECTION_PIECE_US, DETECTION_MARGIN_US);
        assert!(whole.len() > 4, "{whole:?}");
        assert_eq!(detect(2_000_000, DETECTION_MARGIN_US), whole);
        let parts = detect(3_000_000, 2_000_000);
        let facts = |all: &[DetectedStretch]| -> Vec<(String, String)> {
            let facts = all
                .iter()
                .map(|detection| (format!("{:?}", detection.subject), detection.value.clone()));
            facts.collect()
        };
        assert_eq!(facts(&parts), facts(&whole));
        for (part, whole) in parts.iter().zip(&whole) {
            let off =
                part.span.span_start_instant().instant_micros() - whole.span.span_start_instant().instant_micros();
            assert!(off.abs() < 100_000, "{part:?} {whole:?}");
        }
    }
}
