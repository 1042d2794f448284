//! Infers from a signer's takes at which angles each finger joint is straight and fully bent.
//!
//! Solvers, gloves and suits bend straight fingers by some 10 to 30 degrees, and stop short of a fist. The angles of
//! one signer over all takes show both: the straightest and the most bent posture of each joint. [`HandRange`] collects
//! them, and [`HandCorrection`] corrects angles.

use super::BodyAnatomy;
use crate::clip::Clip;
use crate::hand::{BodySide, HandAngles};

/// The lowest counted angle, in degrees.
const MIN_COUNTED_DEGREES: f64 = -60.0;
/// The number of counted degrees.
const DEGREE_BIN_COUNT: usize = 220;
/// The share of frames that is ignored as outliers at each end.
const OUTLIER_TAIL_SHARE: f64 = 0.02;
/// The least number of frames that allow a correction.
const MIN_CORRECTION_FRAMES: u32 = 10;

/// The greatest least bend of a joint, in degrees, that is taken for straight; if the joint's range is more than
/// [`MOVING_RANGE_DEGREES`] degrees, that is up to [`LAX_MOVING`].
const MAX_LAX_DEGREES: f64 = 25.0;
const LAX_MOVING: f64 = 40.0;
const MOVING_RANGE_DEGREES: f64 = 35.0;
/// The limit to which base, middle and end joints bend backwards in people, in degrees.
const BACKWARD_LIMIT_DEGREES: [f64; 3] = [-15.0, -10.0, -10.0];
/// The bends of base, middle and end joint in a fist, in degrees.
const FIST_JOINT_DEGREES: [f64; 3] = [88.0, 98.0, 68.0];
/// The share of [`FIST_JOINT_DEGREES`], averaged over a finger's joints, above which its most bent posture is taken for a fist;
/// joints whose share lies in [`SHORT_FIST_SHARES`] are then bent more.
const NEAR_FIST_SHARE: f64 = 0.66;
const SHORT_FIST_SHARES: std::ops::Range<f64> = 0.55..0.92;
/// A joint that is bent by less than this, in degrees, is straight and needs no correction.
const SLIGHT_BEND_DEGREES: f64 = 6.0;
/// For the radial and the palmar angle, in degrees: the value of a thumb next to the index finger, and the greatest
/// minimum in the takes that is taken for that posture.
const THUMB_BESIDE_DEGREES: [(f64, f64); 2] = [(12.0, 35.0), (2.0, 30.0)];
/// The least range of a thumb's angle that counts as movement, in degrees.
const THUMB_MOVES: f64 = 25.0;

/// The angles of one signer's hand, counted by degree.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct HandRange {
    counts: Vec<[u32; DEGREE_BIN_COUNT]>,
    frames: u32,
}

impl Default for HandRange {
    fn default() -> Self {
        Self {
            counts: vec![[0; DEGREE_BIN_COUNT]; HandAngles::HAND_ANGLE_COUNT],
            frames: 0,
        }
    }
}

impl HandRange {
    /// Adds every `step`th frame of a clip; does nothing for hands without fingers.
    pub fn observe_clip_frames(&mut self, clip: &Clip, anatomy: &BodyAnatomy, side: BodySide, step: usize) {
        for frame in (0..clip.clip_frame_count()).step_by(step.max(1)) {
            let pose = clip.clip_pose_at(frame);
            if let Some(angles) = anatomy.hand_angles(clip.clip_skeleton(), side, &pose) {
                self.add_hand_posture(&angles);
            }
        }
    }

    /// Adds one posture.
    pub fn add_hand_posture(&mut self, angles: &HandAngles) {
        for (counts, angle) in self.counts.iter_mut().zip(angles.to_array()) {
            // Angles beyond the counted ones are in the last bin, and outliers anyway.
            let bin = (angle.to_degrees() - MIN_COUNTED_DEGREES).clamp(0.0, (DEGREE_BIN_COUNT - 1) as f64);
            counts[bin as usize] = counts[bin as usize].saturating_add(1);
        }
        self.frames = self.frames.saturating_add(1);
    }

    /// Returns how many postures were added.
    #[must_use]
    pub fn posture_count(&self) -> u32 {
        self.frames
    }

    /// Returns the least and the largest value of an angle in degrees, without outliers.
    fn angle_extremes(&self, angle: usize) -> (f64, f64) {
        let most = (f64::from(self.frames) * OUTLIER_TAIL_SHARE).floor() as u32;
        let counts = &self.counts[angle];
        (
            cumulative_end_degree(counts, 0..DEGREE_BIN_COUNT, most),
            cumulative_end_degree(counts, (0..DEGREE_BIN_COUNT).rev(), most),
        )
    }

    /// Returns the correction that the postures suggest; the identity if there are few postures.
    #[must_use]
    pub fn suggest_hand_correction(&self) -> HandCorrection {
        let mut hand_correction = HandCorrection::default();
        if self.frames < MIN_CORRECTION_FRAMES {
            return hand_correction;
        }
        for finger in 0..4 {
            // Angle 6 is the index finger's first flexion: five of the thumb and one spread stand before it.
            let bends = [0, 1, 2].map(|joint| self.joint_bend_range(6 + 4 * finger + joint, joint));
            let share = |bend: &JointBendRange| bend.share;
            // The finger as a whole is closed: then joints that bend less are measured short.
            let fist = bends.iter().map(share).sum::<f64>() / 3.0 >= NEAR_FIST_SHARE;
            for (joint, bend) in bends.into_iter().enumerate() {
                let angle = 6 + 4 * finger + joint;
                hand_correction.zero[angle] = bend.zero.to_radians();
                // A joint that never moved may be stiff and is not stretched to a fist.
                if fist && bend.is_whole && SHORT_FIST_SHARES.contains(&bend.share) {
                    hand_correction.gain[angle] = 1.0 / bend.share;
                }
            }
        }
        for (angle, (beside, most)) in THUMB_BESIDE_DEGREES.into_iter().enumerate() {
            let (low, high) = self.angle_extremes(angle);
            if (beside + SLIGHT_BEND_DEGREES..=most).contains(&low) && high - low > THUMB_MOVES {
                hand_correction.zero[angle] = (low - beside).to_radians();
            }
        }
        // Angles 3 and 4 are the thumb's two flexions.
        for angle in [3, 4] {
            let (low, high) = self.angle_extremes(angle);
            if (SLIGHT_BEND_DEGREES..=MAX_LAX_DEGREES).contains(&low) && high - low > THUMB_MOVES {
                hand_correction.zero[angle] = low.to_radians();
            }
        }
        hand_correction
    }

    /// Returns the range of a finger's joint, from straight to closed.
    fn joint_bend_range(&self, angle: usize, joint: usize) -> JointBendRange {
        let (low, high) = self.angle_extremes(angle);
        let moves = high - low > MOVING_RANGE_DEGREES;
        // Nobody bends so far back: the sensor's zero lies off by the excess.
        let zero = if low < BACKWARD_LIMIT_DEGREES[joint] {
            low - BACKWARD_LIMIT_DEGREES[joint]
        } else if (SLIGHT_BEND_DEGREES..=MAX_LAX_DEGREES).contains(&low)
            // A base joint with much range may be laxer when straight than one that hardly moves, as rigs differ in the
            // bones before it. The bones on both sides of the other joints show when they are straight: a lone take
            // that goes from a relaxed hand to a fist shows no straight one.
            || (moves && joint == 0 && (SLIGHT_BEND_DEGREES..=LAX_MOVING).contains(&low))
        {
            low
        } else {
            0.0
        };
        JointBendRange {
            zero,
            share: (high - zero) / FIST_JOINT_DEGREES[joint],
            is_whole: moves && low <= LAX_MOVING,
        }
    }
}

/// The range of one joint.
struct JointBendRange {
    /// The angle that is straight, in degrees.
    zero: f64,
    /// Its largest bend from there, as a share of the bend in a fist.
    share: f64,
    /// Whether it is straight in some frames and bent in others.
    is_whole: bool,
}

/// Returns the first degree that exceeds a cumulative count of `most` frames.
fn cumulative_end_degree(counts: &[u32; DEGREE_BIN_COUNT], mut bins: impl Iterator<Item = usize>, most: u32) -> f64 {
    let mut passed = 0;
    let bin = bins.find(|&bin| {
        passed += counts[bin];
        passed > most
    });
    // The middle of the degree.
    bin.map_or(0.0, |bin| MIN_COUNTED_DEGREES + bin as f64 + 0.5)
}

/// A correction of the angles of one signer's hand: `(angle - zero) * gain`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HandCorrection {
    zero: [f64; HandAngles::HAND_ANGLE_COUNT],
    gain: [f64; HandAngles::HAND_ANGLE_COUNT],
}

impl Default for HandCorrection {
    /// Returns the correction that changes nothing.
    fn default() -> Self {
        Self {
            zero: [0.0; HandAngles::HAND_ANGLE_COUNT],
            gain: [1.0; HandAngles::HAND_ANGLE_COUNT],
        }
    }
}

impl HandCorrection {
    /// Returns the corrected angles.
    #[must_use]
    pub fn correct_hand_angles(&self, angles: &HandAngles) -> HandAngles {
        let all = angles.to_array();
        HandAngles::from_array(std::array::from_fn(|n| (all[n] - self.zero[n]) * self.gain[n]))
    }

    /// Returns whether the correction changes nothing.
    #[must_use]
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Returns the largest correction of a joint's zero, in radians.
    #[must_use]
    pub fn largest_zero_correction(&self) -> f64 {
        self.zero.iter().map(|zero| zero.abs()).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hand::FingerAngles;

    /// Returns a hand whose fingers are all bent by this share of a fist.
    fn bent(share: f64) -> HandAngles {
        let flexion = FIST_JOINT_DEGREES.map(|fist| (fist * share).to_radians());
        HandAngles {
            fingers: [FingerAngles { spread: 0.0, flexion }; 4],
            ..HandAngles::default()
        }
    }

    fn range(change: impl Fn(f64) -> f64, shares: std::ops::RangeInclusive<u32>) -> HandCorrection {
        let mut range = HandRange::default();
        for share in shares {
            range.add_hand_posture(&bent(f64::from(share) / 100.0).map_hand_angles(&change));
        }
        range.suggest_hand_correction()
    }

    fn off(correction: &HandCorrection, change: impl Fn(f64) -> f64, share: f64) -> f64 {
        let read = correction
            .correct_hand_angles(&bent(share).map_hand_angles(&change))
            .to_array();
        let want = bent(share).to_array();
        let apart = read.iter().zip(want).map(|(a, b)| (a - b).abs());
        apart.fold(0.0, f64::max).to_degrees()
    }

    #[test]
    fn fingers_that_are_never_straight_nor_closed_are_read_as_straight_and_closed() {
        let lax = |angle: f64| {
            if angle == 0.0 { 0.0 } else { 0.3 + angle * 0.72 }
        };
        let all = |angle: f64| 0.3 + angle * 0.72;
        let correction = range(all, 0..=100);
        for share in [0.01, 0.5, 1.0] {
            let raw = off(&HandCorrection::default(), lax, share);
            let now = off(&correction, lax, share);
            assert!(now < 5.0 && raw > 2.0 * now, "{share}: {raw} {now}");
        }
    }

    #[test]
    fn good_angles_are_kept_and_an_always_bent_hand_is_not_straightened() {
        let same = |angle: f64| angle;
        for (shares, worst) in [(0..=100, 3.5), (60..=90, 0.1), (45..=55, 0.1)] {
            let correction = range(same, shares.clone());
            for share in [0.5, 0.7] {
                let off = off(&correction, same, share);
                assert!(off < worst, "{shares:?} {share}: {off}");
            }
        }
        assert!(range(same, 0..=3).is_none(), "too few frames");
    }

    #[test]
    fn a_fist_after_a_relaxed_hand_is_closed_though_no_finger_was_straight() {
        let posture = |degrees: [f64; 3]| HandAngles {
            fingers: [FingerAngles {
                spread: 0.0,
                flexion: degrees.map(f64::to_radians),
            }; 4],
            ..HandAngles::default()
        };
        let [relaxed, closed] = [[20.0, 38.0, 20.0], [85.0, 80.0, 50.0]];
        let mut range = HandRange::default();
        for n in 0..100_u32 {
            let share = f64::from(n) / 99.0;
            range.add_hand_posture(&posture(std::array::from_fn(|joint| {
                relaxed[joint] + share * (closed[joint] - relaxed[joint])
            })));
        }
        let read = range.suggest_hand_correction().correct_hand_angles(&posture(closed));
        for finger in read.fingers {
            let share = finger.flexion[1].to_degrees() / FIST_JOINT_DEGREES[1];
            // The relaxed angle is taken for no straight one, which would leave the fist half open.
            assert!((0.8..1.1).contains(&share), "{share}");
        }
    }

    #[test]
    fn one_noisy_frame_does_not_set_the_straight_angle() {
        let mut range = HandRange::default();
        for _ in 0..200 {
            range.add_hand_posture(&bent(0.6));
        }
        range.add_hand_posture(&bent(0.1));
        range.add_hand_posture(&bent(9.0));
        assert!(range.suggest_hand_correction().is_none());
    }
}
