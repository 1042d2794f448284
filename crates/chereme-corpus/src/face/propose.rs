//! Proposals for non-manual tiers from the curves of a face.

use chereme_analysis::detect::{Detection, Detector, Nonmanuals, Observed};
use chereme_analysis::nonmanuals::Curves;
use chereme_formats::table::annotations::Moment;
use chereme_motion::{Face, Instant};
use chereme_sign::{Component, TierRole};
use serde::Serialize;

use super::performances::{CHANNELS, numbers};
use super::{Fits, no_face, recording_of};
use crate::Corpus;
use crate::address::{self, Address, Name};
use crate::annotate::{
    AnnotateOptions, AnnotationAction, AnnotationChange, AnnotationName, NewTier, TierName,
};
use crate::db::columns::AnnotationOrigin;
use crate::db::tiers;
use crate::error::Result;
use crate::progress::Progress;

/// The frames per second at which proposals are determined.
const RATE: f64 = 60.0;
/// The part of a recording that is examined, in seconds from its start.
const LONGEST: f64 = 7_200.0;

/// Proposals for the parts of a face in a recording.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FaceProposals {
    /// The recording's name.
    pub recording: String,
    /// The proposals, part by part in order of time.
    pub proposals: Vec<FaceProposal>,
    /// How many annotations were written.
    pub written: u64,
}

/// A proposed action of a part of a face.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FaceProposal {
    /// The tier on which it belongs.
    pub tier: String,
    /// Its start on the recording's clock, in microseconds.
    pub start_us: i64,
    /// The first microsecond after it.
    pub end_us: i64,
    /// The value of the part's inventory.
    pub value: String,
    /// The confidence, from 0.5 to 1.
    pub confidence: f64,
    /// The rule that found it, with its numbers.
    pub why: String,
}

impl Corpus {
    /// Proposes actions of brows, lids, gaze, mouth and head in a recording with a face. With `store` they become
    /// annotations of a detector on tiers such as `nonmanual.brows (proposed)`, and replace earlier proposals that
    /// nobody has changed.
    ///
    /// # Errors
    /// Fails if nothing has that address, it has no face, or the corpus cannot be written.
    pub fn propose_nonmanuals(
        &mut self,
        address: &Address,
        store: bool,
        progress: &mut Progress<'_>,
    ) -> Result<FaceProposals> {
        let connection = self.store.read();
        let recording = recording_of(connection, address)?;
        let row = address::recording(connection, &Name::Number(recording))?;
        let frames = ((row.duration_us as f64 / 1e6).min(LONGEST) * RATE) as usize;
        let moments: Vec<Instant> = (0..frames)
            .map(|n| Instant::from_seconds(n as f64 / RATE))
            .collect();
        let channels: Vec<usize> = (0..CHANNELS.len()).collect();
        let fits = Fits::of(connection)?;
        let found = numbers(connection, recording, &moments, &channels, &fits)?;
        let columns = found.ok_or_else(|| no_face(&row.name))?;
        let head = |at: usize| columns[at].as_deref();
        let of = |name: &str| columns[Face::position(name)? + 3].as_deref();
        let curves = Curves {
            rate: RATE,
            brow_raise: [of("brow_raise_right"), of("brow_raise_left")],
            brow_squeeze: of("brow_squeeze"),
            eye_close: [of("eye_close_right"), of("eye_close_left")],
            gaze_left: of("gaze_left"),
            gaze_up: of("gaze_up"),
            jaw_open: of("jaw_open"),
            lips_part: of("lips_part"),
            head_pitch: head(0),
            head_yaw: head(1),
        };
        let end = row.duration_us;
        let observed = Observed {
            face: Some(curves),
            ..Observed::default()
        };
        let proposal = |it: Detection| FaceProposal {
            tier: format!("{} (proposed)", it.field),
            start_us: it.span.start().micros().min(end),
            end_us: it.span.end().micros().min(end),
            value: it.value,
            confidence: (it.confidence * 1000.0).round() / 1000.0,
            why: it.why,
        };
        let mut report = FaceProposals {
            recording: row.name.clone(),
            proposals: Nonmanuals
                .detect(&observed)
                .into_iter()
                .map(proposal)
                .collect(),
            written: 0,
        };
        report.proposals.retain(|it| it.end_us > it.start_us);
        if store {
            report.written = self.write_proposals(recording, &report, progress)?;
        }
        Ok(report)
    }

    fn write_proposals(
        &mut self,
        recording: i64,
        report: &FaceProposals,
        progress: &mut Progress<'_>,
    ) -> Result<u64> {
        let mut changes: Vec<AnnotationChange> = Vec::new();
        let mut new: Vec<NewTier> = Vec::new();
        let mut names: Vec<&str> = report.proposals.iter().map(|it| it.tier.as_str()).collect();
        names.dedup();
        let mut written = 0;
        for name in names {
            let feature = name
                .trim_start_matches("nonmanual.")
                .trim_end_matches(" (proposed)");
            let all = tiers::tiers(self.store.read(), recording)?;
            let mut stay = Vec::new();
            match all.iter().find(|row| row.name == name) {
                Some(row) => {
                    for old in tiers::annotations(self.store.read(), row.id)? {
                        match old.origin {
                            AnnotationOrigin::Detector => changes.push(
                                AnnotationAction::Remove {
                                    annotation: AnnotationName::Number(old.id),
                                }
                                .into(),
                            ),
                            _ => stay.push(old.start_us..old.end_us),
                        }
                    }
                }
                None => {
                    let role = TierRole::Component {
                        component: Component::NonManual,
                        feature: Some(feature.to_owned()),
                    };
                    new.push(NewTier::new(Name::Number(recording), name, role));
                }
            }
            let free = |it: &&FaceProposal| {
                it.tier == name
                    && !stay
                        .iter()
                        .any(|own| own.start < it.end_us && it.start_us < own.end)
            };
            for it in report.proposals.iter().filter(free) {
                let time = |micros| Some(Moment::Time(Instant::from_micros(micros)));
                changes.push(
                    AnnotationAction::Add {
                        tier: TierName::Of {
                            recording: Name::Number(recording),
                            tier: name.to_owned(),
                        },
                        start: time(it.start_us),
                        end: time(it.end_us),
                        parent: None,
                        order: None,
                        value: it.value.clone(),
                        confidence: Some(it.confidence),
                    }
                    .into(),
                );
                written += 1;
            }
        }
        if !changes.is_empty() {
            let options = AnnotateOptions {
                origin: AnnotationOrigin::Detector,
                ..AnnotateOptions::default()
            };
            self.annotate_with("propose", &new, (&changes, &options), progress)?;
        }
        Ok(written)
    }
}
