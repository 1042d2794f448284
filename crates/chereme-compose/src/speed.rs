//! The speeds of hips, wrists and feet, and what a step adds to them.

use std::ops::Range;

use chereme_motion::{BodyPart, BodySide};

use crate::error::StepError;
use crate::work::{JointColumns, WorkingClip};

/// Parts of the body whose speed is watched.
struct WatchedPart {
    name: &'static str,
    parts: &'static [BodyPart],
    /// The speed in metres per second that a step may add without a warning: signers stand on their feet, and the
    /// wrists of captured ones stay below some 2 m/s.
    unwarned: f64,
}

const WATCHED_PARTS: [WatchedPart; 3] = [
    WatchedPart {
        name: "the hips",
        parts: &[BodyPart::Hips],
        unwarned: 0.5,
    },
    WatchedPart {
        name: "the wrists",
        parts: &[BodyPart::Hand(BodySide::Right), BodyPart::Hand(BodySide::Left)],
        unwarned: 4.0,
    },
    WatchedPart {
        name: "the feet",
        parts: &[BodyPart::Foot(BodySide::Right), BodyPart::Foot(BodySide::Left)],
        unwarned: 0.5,
    },
];

/// The multiple of the unwarned speed above which a step is refused.
const REFUSED_MULTIPLE: f64 = 3.0;

/// The greatest speeds of hips, wrists and feet in metres per second; zero for parts that the skeleton lacks.
pub(crate) type PeakSpeeds = [f64; WATCHED_PARTS.len()];

/// The speed of hips, wrists and feet from each frame to the next in metres per second, that of the faster side; empty
/// for parts that the skeleton lacks.
pub(crate) struct StepSpeeds([Vec<f64>; WATCHED_PARTS.len()]);

impl StepSpeeds {
    pub(crate) fn between_frames(work: &WorkingClip) -> Self {
        let watched_joints = WATCHED_PARTS.map(|watched| {
            let parts = watched.parts.iter();
            let joints = parts.filter_map(|&part| work.anatomy.part_joint(part));
            joints.collect::<Vec<usize>>()
        });
        let columns = JointColumns::joint_columns_of(work, watched_joints.iter().flatten().copied());
        let speed = |joint: usize, frame: usize| {
            let path = columns.joint_positions(joint);
            path[frame].distance(path[frame + 1]) * work.rate.per_second()
        };
        let steps = work.frames.saturating_sub(1);
        Self(watched_joints.map(|joints| {
            let steps = if joints.is_empty() { 0 } else { steps };
            let fastest = |frame: usize| {
                let speeds = joints.iter().map(|&joint| speed(joint, frame));
                speeds.fold(0.0, f64::max)
            };
            (0..steps).map(fastest).collect()
        }))
    }

    /// Returns the greatest speeds over a whole movement.
    pub(crate) fn peak_speeds(work: &WorkingClip) -> PeakSpeeds {
        Self::between_frames(work).peaks_over(0..work.frames)
    }

    /// Returns the greatest speeds over some steps; step n goes from frame n to the next.
    pub(crate) fn peaks_over(&self, steps: Range<usize>) -> PeakSpeeds {
        self.0.each_ref().map(|speeds| {
            let end = steps.end.min(speeds.len());
            let speeds = &speeds[steps.start.min(end)..end];
            speeds.iter().copied().fold(0.0, f64::max)
        })
    }

    /// Returns the speeds here and in `before` at the moments at which this movement is the most faster; both have the
    /// same frames. Parts that one of them lacks are left out.
    pub(crate) fn most_added(&self, before: &Self) -> (PeakSpeeds, PeakSpeeds) {
        let pairs: [(f64, f64); WATCHED_PARTS.len()] = std::array::from_fn(|n| {
            let pairs = before.0[n].iter().copied().zip(self.0[n].iter().copied());
            let most = pairs.max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)));
            most.unwrap_or_default()
        });
        (pairs.map(|pair| pair.0), pairs.map(|pair| pair.1))
    }

    /// Returns the speeds between two pieces, a sentence for each part.
    pub(crate) fn between_pieces(&self, steps: Range<usize>) -> Vec<String> {
        let peaks = self.peaks_over(steps);
        let known_parts = (0..WATCHED_PARTS.len()).filter(|&n| !self.0[n].is_empty());
        let sentence = |n: usize| {
            let name = WATCHED_PARTS[n].name;
            format!("up to {:.2} m/s at {name} between the pieces", peaks[n])
        };
        known_parts.map(sentence).collect()
    }
}

/// Returns the faster of two for each part.
pub(crate) fn faster_of_both(one: PeakSpeeds, other: PeakSpeeds) -> PeakSpeeds {
    std::array::from_fn(|n| one[n].max(other[n]))
}

/// Returns a warning for each part to which a step adds more speed than people need.
///
/// # Errors
/// [`StepError::Rushed`] if it adds over three times that.
pub(crate) fn check_added(before: PeakSpeeds, after: PeakSpeeds) -> Result<Vec<String>, StepError> {
    let mut warnings = Vec::new();
    for (n, watched) in WATCHED_PARTS.iter().enumerate() {
        let added = after[n] - before[n];
        if added > REFUSED_MULTIPLE * watched.unwarned {
            return Err(StepError::Rushed {
                part: watched.name,
                speed: after[n],
                added,
                most: REFUSED_MULTIPLE * watched.unwarned,
            });
        }
        if added > watched.unwarned {
            warnings.push(format!(
                "up to {:.1} m/s at {}, {added:.1} m/s more than before",
                after[n], watched.name
            ));
        }
    }
    Ok(warnings)
}
