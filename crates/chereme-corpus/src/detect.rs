//! Annotations that detectors find in recordings, stored as proposals on tiers of their own.

pub(crate) mod detect_faces;

use chereme_analysis::detect::{
    ALL_DETECTORS, AnnotationDetector, DetectedStretch, ObservedBody, ObservedSigner, SignerPart, find_detector,
};
use chereme_formats::roles::AnnotatedHands;
use chereme_formats::table::annotations::TableMoment;
use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::{ComponentField, TierRole};
use rusqlite::Connection;
use serde::Serialize;

use crate::Corpus;
use crate::address::{self, CorpusAddress, RowName};
use crate::annotate::{AnnotateOptions, AnnotationAction, AnnotationChange, AnnotationName, NewTier, TierRequestName};
use crate::db::stored_columns::AnnotationOrigin;
use crate::db::stored_recordings::{self, RecordingRow};
use crate::db::stored_tiers;
use crate::error::{CorpusError, CorpusResult};
use crate::movement::{ChannelGroup, MotionTrack};
use crate::progress::{ProgressReceiver, ProgressStep, ProgressUnit};
use crate::propose::{ProposeScope, proposal_tier};
use crate::words::effect::OperationEffect;

use detect_faces::FaceCurves;
pub use detect_faces::FaceProposals;

/// The length of movement that is examined at once, in microseconds: two hours.
const DETECTION_PIECE_US: i64 = 7_200_000_000;
/// The time before and after such a piece that is read with it, in microseconds.
const DETECTION_MARGIN_US: i64 = 10_000_000;

/// Options of a detection: the detector, and the recordings.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DetectOptions {
    /// The name of the detector, one of [`ALL_DETECTORS`].
    pub detector: String,
    /// The recordings; of a token or a span, the detections that overlap it.
    pub scope: ProposeScope,
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
    /// The field that it describes.
    #[serde(skip)]
    pub field: ComponentField,
    /// The tier on which it belongs.
    pub tier: String,
    /// Its start on the recording's clock, in microseconds.
    pub start_us: i64,
    /// The first microsecond after it.
    pub end_us: i64,
    /// The value of the field's inventory.
    pub value: String,
    /// The confidence, from 0 to 1.
    pub confidence: f64,
    /// The rule that found it, with its numbers.
    pub why: String,
}

impl ProposedAnnotation {
    /// Creates the proposal for a detection in a recording that ends at `end`, in microseconds.
    fn new(it: DetectedStretch, end: i64) -> Self {
        Self {
            tier: proposal_tier(&it.field),
            start_us: it.span.span_start_instant().instant_micros().min(end),
            end_us: it.span.span_end_instant().instant_micros().min(end),
            value: it.value,
            confidence: (it.confidence * 1000.0).round() / 1000.0,
            why: it.why,
            field: it.field,
        }
    }
}

/// Changes that store proposals.
#[derive(Default)]
pub(crate) struct ProposalChanges {
    tiers: Vec<NewTier>,
    changes: Vec<AnnotationChange>,
    /// How many annotations are added.
    pub(crate) added: u64,
}

impl Corpus {
    /// Runs a detector on recordings, and writes its detections onto tiers of their own, named for example
    /// `movement.phase right (proposed)`.
    ///
    /// Each is an annotation by a detector ([`AnnotationOrigin::Detector`]) with its confidence. Earlier proposals on
    /// the tiers of its fields that nobody has changed are replaced, even if nothing is found there any more; annotations of
    /// people stay. All of it is one operation, which one undo reverts. Movement is examined in pieces of two hours.
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
        let detector = find_detector_by_name(&options.detector)?;
        let connection = self.store.read_connection();
        let (all, within) = examined(connection, &options.scope)?;
        let mut detected = DetectionReport {
            detector: options.detector.clone(),
            ..DetectionReport::default()
        };
        let mut changes = ProposalChanges::default();
        for (done, row) in all.iter().enumerate() {
            progress.report_step(ProgressStep {
                task: &row.name,
                done: done as u64,
                total: Some(all.len() as u64),
                unit: ProgressUnit::Items,
            })?;
            let Some(mut proposals) = propose_for_recording(connection, detector, row)? else {
                if options.scope != ProposeScope::All {
                    return Err(unobserved(detector, row));
                }
                detected.unobserved += 1;
                continue;
            };
            let span = within.unwrap_or_else(|| whole_recording_span(row));
            proposals.retain(|proposal| span_overlaps_times(span, proposal.start_us, proposal.end_us));
            changes.take_proposals(connection, row.id, span, detector, &proposals)?;
            if !proposals.is_empty() {
                detected.found.push(DetectedIn {
                    recording: row.name.clone(),
                    proposals,
                });
            }
        }
        detected.annotations = changes.added;
        detected.recordings = self.store_proposals(&changes, progress)?;
        Ok(detected)
    }

    /// Writes proposals as one operation, and returns the names of the changed recordings.
    pub(crate) fn store_proposals(
        &mut self,
        changes: &ProposalChanges,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<Vec<String>> {
        if changes.changes.is_empty() {
            return Ok(Vec::new());
        }
        let options = AnnotateOptions {
            origin: AnnotationOrigin::Detector,
            ..AnnotateOptions::default()
        };
        let propose = OperationEffect::Propose;
        let report = self.annotate_with(propose, &changes.tiers, &changes.changes, &options, progress)?;
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
fn examined(connection: &Connection, scope: &ProposeScope) -> CorpusResult<(Vec<RecordingRow>, Option<TimeSpan>)> {
    Ok(match scope {
        ProposeScope::All => (stored_recordings::load_recording_rows(connection)?, None),
        ProposeScope::Recording(name) => (vec![address::find_recording_by_name(connection, name)?], None),
        ProposeScope::Span(name, span) => (vec![address::find_recording_by_name(connection, name)?], Some(*span)),
        ProposeScope::Token(token) => {
            let token_stretch = address::find_addressed_stretch(connection, &CorpusAddress::Token(*token))?;
            (vec![token_stretch.recording], Some(token_stretch.span))
        }
    })
}

/// Returns the proposals of a detector for a recording; `None` if the recording has no part that it examines.
pub(crate) fn propose_for_recording(
    connection: &Connection,
    detector: &dyn AnnotationDetector,
    row: &RecordingRow,
) -> CorpusResult<Option<Vec<ProposedAnnotation>>> {
    let examines = |part| detector.examines().contains(&part);
    let groups: &[ChannelGroup] = match (examines(SignerPart::Body), examines(SignerPart::Arms)) {
        (true, _) => &ChannelGroup::ALL_CHANNEL_GROUPS,
        (false, true) => &[ChannelGroup::RightArm, ChannelGroup::LeftArm],
        (false, false) => &[],
    };
    let moves = !groups.is_empty() && stored_recordings::body_track(connection, row.id)?.is_some();
    let face = match examines(SignerPart::Face) {
        true => FaceCurves::read_face_curves(connection, row)?,
        false => None,
    };
    if !moves && face.is_none() {
        return Ok(None);
    }
    let face = face.as_ref();
    let detections = match moves {
        true => {
            let track = MotionTrack::open_motion_track(connection, row.id)?;
            in_pieces(
                connection,
                detector,
                &track,
                groups,
                face,
                DETECTION_PIECE_US,
                DETECTION_MARGIN_US,
            )?
        }
        false => detector.detect_annotations(&ObservedSigner {
            body: None,
            face: face.map(FaceCurves::detector_curves),
        }),
    };
    let detected = detections.into_iter();
    let kept_proposals = detected.map(|detection| ProposedAnnotation::new(detection, row.duration_us));
    Ok(Some(
        kept_proposals
            .filter(|proposal| proposal.end_us > proposal.start_us)
            .collect(),
    ))
}

/// Returns the detections in a movement, field by field in order of time, which is examined in pieces of so many
/// microseconds, each with some time around it; each detection belongs to the piece in which it starts.
fn in_pieces(
    connection: &Connection,
    detector: &dyn AnnotationDetector,
    track: &MotionTrack,
    groups: &[ChannelGroup],
    face: Option<&FaceCurves>,
    piece: i64,
    around: i64,
) -> CorpusResult<Vec<DetectedStretch>> {
    let anatomy = track.track_anatomy(connection)?;
    let first = track.row.offset_us;
    let instant_at = |micros: i64| RecordingInstant::from_micros(first.saturating_add(micros));
    let length = track
        .rate
        .frame_start_instant(track.motion_frame_count())
        .instant_micros();
    let mut all: Vec<DetectedStretch> = Vec::new();
    let mut start = 0;
    loop {
        let end = start + piece;
        let is_last = end >= length;
        let wanted = match (start, is_last) {
            (0, _) => instant_at(0),
            _ => instant_at(start - around),
        };
        let wanted_frames = track.frames_in(TimeSpan::span_between(wanted, instant_at(end + around)));
        let frames = match is_last {
            true => wanted_frames.start..track.motion_frame_count(),
            false => wanted_frames,
        };
        let begins = instant_at(track.rate.frame_start_instant(frames.start).instant_micros());
        let clip = track.read_motion_clip(connection, frames, groups)?;
        let detections = detector.detect_annotations(&ObservedSigner {
            body: Some(ObservedBody {
                clip: &clip,
                anatomy: &anatomy,
                start: begins,
            }),
            face: face.map(FaceCurves::detector_curves),
        });
        let starts_inside = |detection: &DetectedStretch| {
            let from = detection.span.span_start_instant();
            (start == 0 || from >= instant_at(start)) && (is_last || from < instant_at(end))
        };
        for it in detections.into_iter().filter(starts_inside) {
            let is_known = |known: &DetectedStretch| {
                known.field == it.field && known.span.span_end_instant() > it.span.span_start_instant()
            };
            let is_near = start > 0 && it.span.span_start_instant() < instant_at(start + around);
            if !is_near || !all.iter().any(is_known) {
                all.push(it);
            }
        }
        if is_last {
            if start > 0 {
                let fields = detector.detected_fields();
                all.sort_by_key(|detection| fields.iter().position(|field| *field == detection.field));
            }
            return Ok(all);
        }
        start = end;
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

fn span_overlaps_times(span: TimeSpan, start: i64, end: i64) -> bool {
    start < span.span_end_instant().instant_micros() && span.span_start_instant().instant_micros() < end
}

impl ProposalChanges {
    /// Adds the changes that store the proposals of a detector for a recording: on each tier of its fields they replace
    /// the annotations of detectors that overlap `within`, and leave out what other annotations occupy.
    pub(crate) fn take_proposals(
        &mut self,
        connection: &Connection,
        recording: i64,
        within: TimeSpan,
        detector: &dyn AnnotationDetector,
        proposals: &[ProposedAnnotation],
    ) -> CorpusResult<()> {
        let tier_rows = stored_tiers::load_tier_rows(connection, recording)?;
        for field in detector.detected_fields() {
            let name = proposal_tier(&field);
            let mut field_proposals = proposals.iter().filter(|proposal| proposal.tier == name).peekable();
            let mut occupied = Vec::new();
            match (tier_rows.iter().find(|row| row.name == name), field_proposals.peek()) {
                (Some(row), _) => {
                    for old in stored_tiers::load_tier_annotation_rows(connection, row.id)? {
                        if old.origin == AnnotationOrigin::Detector
                            && span_overlaps_times(within, old.start_us, old.end_us)
                        {
                            let annotation = AnnotationName::Number(old.id);
                            self.changes.push(AnnotationAction::Remove { annotation }.into());
                        } else {
                            occupied.push(old.start_us..old.end_us);
                        }
                    }
                }
                (None, Some(first)) => self.tiers.push(tier_of(recording, first)),
                (None, None) => {}
            }
            for it in field_proposals {
                let mut others = occupied.iter();
                if others.any(|own| own.start < it.end_us && it.start_us < own.end) {
                    continue;
                }
                occupied.push(it.start_us..it.end_us);
                self.changes.push(addition(recording, it));
                self.added += 1;
            }
        }
        Ok(())
    }
}

/// Returns the new tier for a proposal and others of its field.
fn tier_of(recording: i64, proposal: &ProposedAnnotation) -> NewTier {
    let field = &proposal.field;
    let role = TierRole::Component {
        component: field.component,
        feature: field.feature.clone(),
    };
    let mut tier = NewTier::new(RowName::Number(recording), proposal.tier.clone(), role);
    tier.hand = field.hand.map(AnnotatedHands::One);
    tier
}

/// Returns the change that adds a proposal to its tier.
fn addition(recording: i64, proposal: &ProposedAnnotation) -> AnnotationChange {
    let time = |micros| Some(TableMoment::Time(RecordingInstant::from_micros(micros)));
    AnnotationAction::Add {
        tier: TierRequestName::Of {
            recording: RowName::Number(recording),
            tier: proposal.tier.clone(),
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
        let track = MotionTrack::open_motion_track(connection, 1).expect("a track");
        let strokes = find_detector("strokes").expect("a detector");
        let found = |piece: i64, around: i64| {
            let groups = [ChannelGroup::RightArm, ChannelGroup::LeftArm];
            in_pieces(connection, strokes, &track, &groups, None, piece, around).expect("examined")
        };
        let whole = found(DETECTION_PIECE_US, DETECTION_MARGIN_US);
        assert!(whole.len() > 4, "{whole:?}");
        assert_eq!(found(2_000_000, DETECTION_MARGIN_US), whole);
        let parts = found(3_000_000, 2_000_000);
        let facts = |all: &[DetectedStretch]| -> Vec<(String, String)> {
            let facts = all.iter().map(|it| (it.field.to_string(), it.value.clone()));
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
