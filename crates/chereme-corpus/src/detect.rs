//! Annotations that detectors find in recordings, stored as proposals on tiers of their own.

use chereme_analysis::detect::{Body, DETECTORS, Detection, Detector, Observed, Part, detector};
use chereme_formats::roles::Hands;
use chereme_formats::table::annotations::Moment;
use chereme_motion::{Instant, Span};
use chereme_sign::{Field, TierRole};
use rusqlite::Connection;
use serde::Serialize;

use crate::Corpus;
use crate::address::{self, Address, Name};
use crate::annotate::{
    AnnotateOptions, AnnotationAction, AnnotationChange, AnnotationName, NewTier, TierName,
};
use crate::db::columns::AnnotationOrigin;
use crate::db::recordings::{self, RecordingRow};
use crate::db::tiers;
use crate::error::{Error, Result};
use crate::face::FaceCurves;
use crate::movement::{ChannelGroup, MotionTrack};
use crate::progress::{Progress, Step, Unit};
use crate::propose::{ProposeScope, proposal_tier};
use crate::words::effect::OperationEffect;

/// The length of movement that is examined at once, in microseconds: two hours.
const PIECE: i64 = 7_200_000_000;
/// The time before and after such a piece that is read with it, in microseconds.
const AROUND: i64 = 10_000_000;

/// Options of a detection: the detector, and the recordings.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DetectOptions {
    /// The name of the detector, one of [`DETECTORS`].
    pub detector: String,
    /// The recordings; of a token or a span, the detections that overlap it.
    pub scope: ProposeScope,
}

/// The result of a detection.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Detected {
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
    pub proposals: Vec<Proposal>,
}

/// A proposed annotation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Proposal {
    /// The field that it describes.
    #[serde(skip)]
    pub field: Field,
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

impl Proposal {
    /// Creates the proposal for a detection in a recording that ends at `end`, in microseconds.
    fn new(it: Detection, end: i64) -> Self {
        Self {
            tier: proposal_tier(&it.field),
            start_us: it.span.start().micros().min(end),
            end_us: it.span.end().micros().min(end),
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
    /// [`Error::Stopped`] if `progress` asks to stop before anything is written. Fails if there is no such detector,
    /// nothing has the name in the scope, a named recording has no part that the detector examines, or the corpus cannot
    /// be written.
    pub fn detect(
        &mut self,
        options: &DetectOptions,
        progress: &mut Progress<'_>,
    ) -> Result<Detected> {
        let detector = named(&options.detector)?;
        let connection = self.store.read();
        let (all, within) = examined(connection, &options.scope)?;
        let mut detected = Detected {
            detector: options.detector.clone(),
            ..Detected::default()
        };
        let mut changes = ProposalChanges::default();
        for (done, row) in all.iter().enumerate() {
            progress.report(Step {
                task: &row.name,
                done: done as u64,
                total: Some(all.len() as u64),
                unit: Unit::Items,
            })?;
            let Some(mut proposals) = proposals(connection, detector, row)? else {
                if options.scope != ProposeScope::All {
                    return Err(unobserved(detector, row));
                }
                detected.unobserved += 1;
                continue;
            };
            let span = within.unwrap_or_else(|| whole(row));
            proposals.retain(|it| overlaps(span, it.start_us, it.end_us));
            changes.take(connection, row.id, span, (detector, &proposals))?;
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
        progress: &mut Progress<'_>,
    ) -> Result<Vec<String>> {
        if changes.changes.is_empty() {
            return Ok(Vec::new());
        }
        let options = AnnotateOptions {
            origin: AnnotationOrigin::Detector,
            ..AnnotateOptions::default()
        };
        let work = (changes.changes.as_slice(), &options);
        let report =
            self.annotate_with(OperationEffect::Propose, &changes.tiers, work, progress)?;
        Ok(report.recordings)
    }
}

/// Returns the detector of that name.
fn named(name: &str) -> Result<&'static dyn Detector> {
    detector(name).ok_or_else(|| {
        let names: Vec<&str> = DETECTORS.iter().map(|it| it.name()).collect();
        Error::wrong(format!("no detector is called {name:?}"))
            .at(name)
            .advise(format!("the detectors are: {}", names.join(", ")))
    })
}

/// Returns the recordings of a scope, and the span that detections must overlap.
fn examined(
    connection: &Connection,
    scope: &ProposeScope,
) -> Result<(Vec<RecordingRow>, Option<Span>)> {
    Ok(match scope {
        ProposeScope::All => (recordings::recordings(connection)?, None),
        ProposeScope::Recording(name) => (vec![address::recording(connection, name)?], None),
        ProposeScope::Span(name, span) => {
            (vec![address::recording(connection, name)?], Some(*span))
        }
        ProposeScope::Token(token) => {
            let found = address::stretch(connection, &Address::Token(*token))?;
            (vec![found.recording], Some(found.span))
        }
    })
}

/// Returns the proposals of a detector for a recording; `None` if the recording has no part that it examines.
pub(crate) fn proposals(
    connection: &Connection,
    detector: &dyn Detector,
    row: &RecordingRow,
) -> Result<Option<Vec<Proposal>>> {
    let examines = |part| detector.examines().contains(&part);
    let groups: &[ChannelGroup] = match (examines(Part::Body), examines(Part::Arms)) {
        (true, _) => &ChannelGroup::ALL,
        (false, true) => &[ChannelGroup::RightArm, ChannelGroup::LeftArm],
        (false, false) => &[],
    };
    let moves = !groups.is_empty() && recordings::body_track(connection, row.id)?.is_some();
    let face = match examines(Part::Face) {
        true => FaceCurves::read(connection, row)?,
        false => None,
    };
    if !moves && face.is_none() {
        return Ok(None);
    }
    let face = face.as_ref();
    let found = match moves {
        true => {
            let track = MotionTrack::of(connection, row.id)?;
            in_pieces(
                connection,
                detector,
                (&track, groups),
                face,
                (PIECE, AROUND),
            )?
        }
        false => detector.detect(&Observed {
            body: None,
            face: face.map(FaceCurves::curves),
        }),
    };
    let found = found.into_iter();
    let found = found.map(|it| Proposal::new(it, row.duration_us));
    Ok(Some(found.filter(|it| it.end_us > it.start_us).collect()))
}

/// Returns the detections in a movement, field by field in order of time, which is examined in pieces of so many
/// microseconds, each with some time around it; each detection belongs to the piece in which it starts.
fn in_pieces(
    connection: &Connection,
    detector: &dyn Detector,
    (track, groups): (&MotionTrack, &[ChannelGroup]),
    face: Option<&FaceCurves>,
    (piece, around): (i64, i64),
) -> Result<Vec<Detection>> {
    let anatomy = track.anatomy(connection)?;
    let first = track.row.offset_us;
    let at = |micros: i64| Instant::from_micros(first.saturating_add(micros));
    let length = track.rate.instant(track.frames()).micros();
    let mut all: Vec<Detection> = Vec::new();
    let mut start = 0;
    loop {
        let end = start + piece;
        let is_last = end >= length;
        let wanted = match (start, is_last) {
            (0, _) => at(0),
            _ => at(start - around),
        };
        let frames = track.frames_in(Span::between(wanted, at(end + around)));
        let frames = match is_last {
            true => frames.start..track.frames(),
            false => frames,
        };
        let begins = at(track.rate.instant(frames.start).micros());
        let clip = track.clip(connection, frames, groups)?;
        let found = detector.detect(&Observed {
            body: Some(Body {
                clip: &clip,
                anatomy: &anatomy,
                start: begins,
            }),
            face: face.map(FaceCurves::curves),
        });
        let own = |it: &Detection| {
            let from = it.span.start();
            (start == 0 || from >= at(start)) && (is_last || from < at(end))
        };
        for it in found.into_iter().filter(own) {
            let is_known =
                |known: &Detection| known.field == it.field && known.span.end() > it.span.start();
            let is_near = start > 0 && it.span.start() < at(start + around);
            if !is_near || !all.iter().any(is_known) {
                all.push(it);
            }
        }
        if is_last {
            if start > 0 {
                let fields = detector.fields();
                all.sort_by_key(|it| fields.iter().position(|field| *field == it.field));
            }
            return Ok(all);
        }
        start = end;
    }
}

/// Returns the error for a recording without any part that a detector examines.
fn unobserved(detector: &dyn Detector, row: &RecordingRow) -> Error {
    match detector.examines() {
        [Part::Face] => crate::face::no_face(&row.name),
        _ => crate::movement::no_movement(&row.name),
    }
}

fn whole(row: &RecordingRow) -> Span {
    Span::between(Instant::ZERO, Instant::from_micros(row.duration_us))
}

fn overlaps(span: Span, start: i64, end: i64) -> bool {
    start < span.end().micros() && span.start().micros() < end
}

impl ProposalChanges {
    /// Adds the changes that store the proposals of a detector for a recording: on each tier of its fields they replace
    /// the annotations of detectors that overlap `within`, and leave out what other annotations occupy.
    pub(crate) fn take(
        &mut self,
        connection: &Connection,
        recording: i64,
        within: Span,
        (detector, proposals): (&dyn Detector, &[Proposal]),
    ) -> Result<()> {
        let known = tiers::tiers(connection, recording)?;
        for field in detector.fields() {
            let name = proposal_tier(&field);
            let mut found = proposals.iter().filter(|it| it.tier == name).peekable();
            let mut occupied = Vec::new();
            match (known.iter().find(|row| row.name == name), found.peek()) {
                (Some(row), _) => {
                    for old in tiers::annotations(connection, row.id)? {
                        if old.origin == AnnotationOrigin::Detector
                            && overlaps(within, old.start_us, old.end_us)
                        {
                            let annotation = AnnotationName::Number(old.id);
                            self.changes
                                .push(AnnotationAction::Remove { annotation }.into());
                        } else {
                            occupied.push(old.start_us..old.end_us);
                        }
                    }
                }
                (None, Some(first)) => self.tiers.push(tier_of(recording, first)),
                (None, None) => {}
            }
            for it in found {
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
fn tier_of(recording: i64, proposal: &Proposal) -> NewTier {
    let field = &proposal.field;
    let role = TierRole::Component {
        component: field.component,
        feature: field.feature.clone(),
    };
    let mut tier = NewTier::new(Name::Number(recording), proposal.tier.clone(), role);
    tier.hand = field.hand.map(Hands::One);
    tier
}

/// Returns the change that adds a proposal to its tier.
fn addition(recording: i64, proposal: &Proposal) -> AnnotationChange {
    let time = |micros| Some(Moment::Time(Instant::from_micros(micros)));
    AnnotationAction::Add {
        tier: TierName::Of {
            recording: Name::Number(recording),
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
    use crate::{ImportOptions, starter_files, unheard};

    #[test]
    fn movement_in_pieces_has_the_detections_of_the_whole() {
        let folder = tempfile::tempdir().expect("a folder");
        let (_, bytes) = starter_files()
            .find(|(file, _)| file.ends_with("phrase.bvh"))
            .expect("a starter capture");
        let path = folder.path().join("phrase.bvh");
        std::fs::write(&path, bytes).expect("written");
        let mut corpus = Corpus::create(&folder.path().join("c.chereme"), "A").expect("made");
        let mut hear = unheard;
        let options = ImportOptions::default();
        corpus
            .import(&[path], &options, &mut Progress::new(&mut hear))
            .expect("taken in");
        let connection = corpus.store.read();
        let track = MotionTrack::of(connection, 1).expect("a track");
        let strokes = detector("strokes").expect("a detector");
        let found = |piece: i64, around: i64| {
            let groups = [ChannelGroup::RightArm, ChannelGroup::LeftArm];
            let of = (&track, &groups[..]);
            in_pieces(connection, strokes, of, None, (piece, around)).expect("examined")
        };
        let whole = found(PIECE, AROUND);
        assert!(whole.len() > 4, "{whole:?}");
        assert_eq!(found(2_000_000, AROUND), whole);
        let parts = found(3_000_000, 2_000_000);
        let facts = |all: &[Detection]| -> Vec<(String, String)> {
            let facts = all
                .iter()
                .map(|it| (it.field.to_string(), it.value.clone()));
            facts.collect()
        };
        assert_eq!(facts(&parts), facts(&whole));
        for (part, whole) in parts.iter().zip(&whole) {
            let off = part.span.start().micros() - whole.span.start().micros();
            assert!(off.abs() < 100_000, "{part:?} {whole:?}");
        }
    }
}
