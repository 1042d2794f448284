//! Lapses of a capture: frames within a take whose movement was lost, and frames that stand several times.
//!
//! When cameras or gloves lose a limb, programs write its last posture again and again, write zeros, or follow
//! something else for a moment. [`ClipLapses`] finds these frames by their jumps: a lapse begins or ends with a step that is far
//! longer than those around it. A hand that is held still moves on without a jump, and has no lapse. Nothing changes a clip.

use std::fmt;
use std::ops::Range;

use glam::{DQuat, DVec3};

use crate::anatomy::{BodyAnatomy, BodyPart};
use crate::clip::{Clip, JointChannel};
use crate::hand::BodySide;
use crate::pose::ModelPose;

/// Frames in which the movement of a limb was probably lost.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionLapse {
    /// The frames, counted from 0.
    pub frames: Range<usize>,
    /// The joints that were lost.
    pub limb: LapseLimb,
    /// The numbers in their place.
    pub what: LostMovement,
}

/// Joints that are lost together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LapseLimb {
    /// All joints.
    Body,
    /// The upper arm and the forearm, relative to the collar bone.
    Arm(BodySide),
    /// The joints below the wrist, relative to the hand.
    Fingers(BodySide),
}

/// The numbers that a file has in place of lost movement; distances in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LostMovement {
    /// The posture of the frame before, up to a jump of this distance.
    Still(f64),
    /// Zeros or the rest pose, with jumps; this is the longest.
    Rest(f64),
    /// Another place, this far away, from which the limb returns.
    Away(f64),
}

impl fmt::Display for LapseLimb {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Body => f.write_str("the body"),
            Self::Arm(side) => write!(f, "the {} arm", side.body_side_name()),
            Self::Fingers(side) => write!(f, "the {} fingers", side.body_side_name()),
        }
    }
}

impl fmt::Display for MotionLapse {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Range { start, end }, limb) = (&self.frames, self.limb);
        match end - start {
            1 => write!(f, "frame {start}: ")?,
            _ => write!(f, "frames {start} to {}: ", end - 1)?,
        }
        let [stands, jumps, returns] = match limb {
            // The English verb follows the number of the limb: fingers stand, an arm stands.
            LapseLimb::Fingers(_) => ["stand", "jump", "return"],
            _ => ["stands", "jumps", "returns"],
        };
        let cm = |metres: f64| 100.0 * metres;
        match self.what {
            LostMovement::Still(far) => {
                write!(f, "{limb} {stands} still, then {jumps} {:.0} cm", cm(far))
            }
            LostMovement::Rest(far) => {
                write!(f, "{limb} {jumps} {:.0} cm to the rest pose", cm(far))
            }
            LostMovement::Away(far) => {
                write!(f, "{limb} {jumps} {:.0} cm away and {returns}", cm(far))
            }
        }
    }
}

/// The lapses of a clip.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ClipLapses {
    /// The lapses, in order of time.
    pub found: Vec<MotionLapse>,
    /// The number of frames in which all joints stand as in the frame before, in short runs.
    pub repeated: usize,
    /// The number of frames outside of longer runs of such frames.
    pub moving: usize,
    /// Whether any joint turns.
    pub bends: bool,
}

/// The longest run of equal frames that a conversion from another frame rate writes.
const MAX_CONVERSION_RUN_FRAMES: usize = 8;
/// The least number of frames that stand still before a jump.
const MIN_STILL_FRAMES: usize = 3;
/// A jump is at least this many times as long as four of five steps around it, up to this many seconds away.
const LAPSE_JUMP_LIMITS: (f64, f64) = (3.0, 0.2);
/// The longest time for which a limb is away, in seconds, and the largest share of the jump by which it misses its own
/// path when it returns.
const LIMB_ABSENCE_LIMITS: (f64, f64) = (0.15, 0.35);
/// Rotations within this angle of rest, in radians, count as rest.
const LAPSE_REST_TOLERANCE_RADIANS: f64 = 1e-3;

impl LapseLimb {
    /// Returns every limb, the body first.
    fn all_lapse_limbs() -> impl Iterator<Item = Self> {
        let sides = BodySide::BOTH_SIDES.into_iter();
        std::iter::once(Self::Body).chain(sides.flat_map(|side| [Self::Arm(side), Self::Fingers(side)]))
    }

    /// Returns the least jump after frames that stand still or at rest, in metres.
    fn least_rest_jump(self) -> f64 {
        match self {
            Self::Body | Self::Arm(_) => 0.03,
            Self::Fingers(_) => 0.015,
        }
    }

    /// Returns the least jump away, in metres, and its least speed in metres per second: beyond what people can do.
    fn impossible_jump_limits(self) -> (f64, f64) {
        match self {
            Self::Body => (0.5, 20.0),
            Self::Arm(_) => (0.2, 12.0),
            Self::Fingers(_) => (0.06, 8.0),
        }
    }
}

impl ClipLapses {
    /// Examines a clip; `anatomy` belongs to its skeleton.
    #[must_use]
    pub fn find_clip_lapses(clip: &Clip, anatomy: &BodyAnatomy) -> Self {
        let mut lapses = Self {
            bends: has_bending_joints(clip, anatomy),
            ..Self::default()
        };
        // One frame has no steps to measure.
        if clip.clip_frame_count() < 2 {
            lapses.moving = clip.clip_frame_count();
            return lapses;
        }
        let mut paths: Vec<LimbPath> = LapseLimb::all_lapse_limbs()
            .filter_map(|limb| LimbPath::begin_limb_path(limb, clip, anatomy))
            .collect();
        let mut model = clip.model_pose(0);
        for frame in 0..clip.clip_frame_count() {
            model.set_local_pose(clip.clip_skeleton(), &clip.clip_pose_at(frame));
            for path in &mut paths {
                path.push_limb_frame(clip, anatomy, &model, frame);
            }
        }
        for path in &paths {
            for lapse in path.limb_path_lapses(clip.clip_frame_rate().per_second()) {
                // A lapse of the body covers those of its limbs; the body comes first in the list.
                let is_known = lapses.found.iter().any(|known: &MotionLapse| {
                    known.limb == LapseLimb::Body && has_common_frame(&known.frames, &lapse.frames)
                });
                if !is_known {
                    lapses.found.push(lapse);
                }
            }
        }
        lapses.found.sort_by_key(|lapse| lapse.frames.start);
        if let Some(body) = paths.iter().find(|path| path.limb == LapseLimb::Body) {
            // Short runs come from a conversion of the frame rate, long ones from a take that stands still.
            let long = |run: &Range<usize>| run.len() > MAX_CONVERSION_RUN_FRAMES;
            let (long, short): (Vec<_>, Vec<_>) = true_frame_runs(&body.same).partition(long);
            lapses.repeated = short.iter().map(ExactSizeIterator::len).sum();
            lapses.moving = clip.clip_frame_count() - long.iter().map(ExactSizeIterator::len).sum::<usize>();
        }
        lapses
    }
}

/// Returns whether any joint turns or moves, besides markers and the joints that carry the whole body. A skeleton without
/// an arm counts as one whose joints turn.
#[must_use]
pub fn has_bending_joints(clip: &Clip, anatomy: &BodyAnatomy) -> bool {
    if !BodySide::BOTH_SIDES
        .iter()
        .any(|&side| anatomy.arm_chain(side).is_some())
    {
        return true;
    }
    let skeleton = clip.clip_skeleton();
    // The joints above the hips carry the whole body and turn even if a figure is stiff.
    let hips = anatomy.part_joint(BodyPart::Hips).unwrap_or(0);
    let carriers: Vec<usize> = skeleton.joint_ancestors(hips).collect();
    let is_own = |joint: &usize| !carriers.contains(joint) && !anatomy.marker_joints().contains(joint);
    (0..skeleton.len()).filter(is_own).any(|joint| {
        let JointChannel {
            rotations,
            translations,
        } = clip.joint_channel(joint);
        let turns = rotations
            .iter()
            .any(|turn| turn.angle_between(rotations[0]) > LAPSE_REST_TOLERANCE_RADIANS);
        let places = translations.iter().flatten();
        turns
            || places
                .clone()
                .zip(places.skip(1))
                .any(|(a, b)| a.distance(*b) > LAPSE_REST_TOLERANCE_RADIANS)
    })
}

/// The movement of a limb.
struct LimbPath {
    limb: LapseLimb,
    joints: Vec<usize>,
    /// The joint relative to which the limb is measured.
    base: Option<usize>,
    /// The joints whose places are measured, and whether it is their tips.
    measured: Vec<(usize, bool)>,
    /// The measured places, in metres: those of the first frame, of the second and so on.
    places: Vec<DVec3>,
    /// Whether each frame is equal to the one before.
    same: Vec<bool>,
    /// Whether each frame is at rest.
    rest: Vec<bool>,
}

impl LimbPath {
    fn begin_limb_path(limb: LapseLimb, clip: &Clip, anatomy: &BodyAnatomy) -> Option<Self> {
        let skeleton = clip.clip_skeleton();
        let (joints, base, measured) = match limb {
            LapseLimb::Body => {
                // Three points show any movement of the trunk.
                let parts = [
                    BodyPart::Hips,
                    BodyPart::UpperArm(BodySide::Right),
                    BodyPart::UpperArm(BodySide::Left),
                ];
                let part_joints = parts.iter().filter_map(|&part| anatomy.part_joint(part));
                let measured: Vec<_> = part_joints.map(|joint| (joint, false)).collect();
                ((0..skeleton.len()).collect::<Vec<_>>(), None, measured)
            }
            LapseLimb::Arm(side) => {
                let arm = anatomy.arm_chain(side)?;
                let base = skeleton.joint_parent(arm.upper)?;
                let measured = vec![(arm.forearm, false), (arm.hand, false)];
                (vec![arm.upper, arm.forearm], Some(base), measured)
            }
            LapseLimb::Fingers(side) => {
                let joints = anatomy.possible_fingers(side);
                // Fingertips move farthest, so only the last joint of each finger is measured.
                let is_last = |joint: &usize| !joints.iter().any(|&other| skeleton.joint_parent(other) == Some(*joint));
                let measured: Vec<_> = joints
                    .iter()
                    .filter(|joint| is_last(joint))
                    .map(|&joint| (joint, true))
                    .collect();
                let base = anatomy.part_joint(BodyPart::Hand(side))?;
                (joints, Some(base), measured)
            }
        };
        (!measured.is_empty()).then_some(Self {
            limb,
            joints,
            base,
            measured,
            places: Vec::with_capacity(clip.clip_frame_count()),
            same: Vec::with_capacity(clip.clip_frame_count()),
            rest: Vec::with_capacity(clip.clip_frame_count()),
        })
    }

    fn push_limb_frame(&mut self, clip: &Clip, anatomy: &BodyAnatomy, model: &ModelPose, frame: usize) {
        let skeleton = clip.clip_skeleton();
        // Relative to its base a limb stands still even if the body walks.
        let (origin, turned) = match self.base {
            Some(base) => (
                model.model_joint_position(base),
                model.model_joint_rotation(base).inverse(),
            ),
            None => (DVec3::ZERO, DQuat::IDENTITY),
        };
        for &(joint, is_tip) in &self.measured {
            // Without a known tip the joint's own place is measured.
            let tip = anatomy.digit_end(skeleton, joint).filter(|_| is_tip);
            let joint_place = model.joint_point_to_model(joint, tip.unwrap_or_default());
            self.places.push(turned * (joint_place - origin));
        }
        let turns = |joint: usize| &clip.joint_channel(joint).rotations;
        let is_same = frame > 0
            && self.joints.iter().all(|&joint| {
                // Exact equality: lost frames are copies to the bit, and held hands tremble.
                turns(joint)[frame] == turns(joint)[frame - 1]
                    && clip.joint_translation(joint, frame) == clip.joint_translation(joint, frame - 1)
            });
        let is_rest = if is_same {
            // An unchanged frame needs no second comparison with the rest pose.
            self.rest[frame - 1]
        } else {
            // The root turns in the world.
            let inner_joints = self.joints.iter().filter(|&&joint| joint > 0);
            let near = |turn: DQuat, rest: DQuat| turn.angle_between(rest) < LAPSE_REST_TOLERANCE_RADIANS;
            // Programs write lost rotations as zeros or as the rest pose.
            inner_joints
                .clone()
                .all(|&joint| near(turns(joint)[frame], DQuat::IDENTITY))
                || inner_joints
                    .clone()
                    .all(|&joint| near(turns(joint)[frame], skeleton.joint_at(joint).rest))
        };
        self.same.push(is_same);
        self.rest.push(is_rest);
    }

    /// Returns the distance between two frames: that of the place that moves farthest.
    fn limb_frame_distance(&self, a: usize, b: usize) -> f64 {
        let count = self.measured.len();
        let places = |frame: usize| &self.places[frame * count..(frame + 1) * count];
        let far = places(a).iter().zip(places(b)).map(|(a, b)| a.distance(*b));
        far.fold(0.0, f64::max)
    }

    /// Returns a length that four of five steps just before and after these frames do not exceed; the steps into and
    /// out of them do not count, nor do frames that stand still.
    fn usual_step_length(&self, frames: &Range<usize>, rate: f64) -> f64 {
        let near = (LAPSE_JUMP_LIMITS.1 * rate).ceil() as usize;
        // The steps into and out of the frames are the jumps in question and are left out.
        let before = frames.start.saturating_sub(near + 1)..frames.start.saturating_sub(1);
        let after = frames.end..(frames.end + near).min(self.same.len() - 1);
        // Frames that stand still have steps of zero and would lower the usual length.
        let step_frames = before.chain(after).filter(|&frame| !self.same[frame + 1]);
        let mut steps: Vec<f64> = step_frames
            .map(|frame| self.limb_frame_distance(frame, frame + 1))
            .collect();
        steps.sort_by(f64::total_cmp);
        // Four of five steps are no longer than this one.
        let quantile_index = (0.8 * steps.len() as f64) as usize;
        steps.get(quantile_index).copied().unwrap_or(0.0)
    }

    fn limb_path_lapses(&self, rate: f64) -> Vec<MotionLapse> {
        let mut found_lapses: Vec<MotionLapse> = Vec::new();
        let all = self.same.len();
        let lapse = |frames: Range<usize>, what: LostMovement| MotionLapse {
            frames,
            limb: self.limb,
            what,
        };
        // A limb at rest in the whole clip was never captured, which is no lapse.
        for run in true_frame_runs(&self.rest).filter(|run| run.len() < all) {
            let usual = LAPSE_JUMP_LIMITS.0 * self.usual_step_length(&run, rate);
            let inner = [
                (run.start > 0).then(|| self.limb_frame_distance(run.start - 1, run.start)),
                (run.end < all).then(|| self.limb_frame_distance(run.end - 1, run.end)),
            ];
            // Both ends have to jump: a movement may begin or end at rest of its own accord.
            let jumps = inner.iter().flatten();
            if jumps
                .clone()
                .all(|&far| far > usual && far > self.limb.least_rest_jump())
            {
                let most = jumps.copied().fold(0.0, f64::max);
                found_lapses.push(lapse(run, LostMovement::Rest(most)));
            }
        }
        for run in true_frame_runs(&self.same).filter(|run| run.len() >= MIN_STILL_FRAMES && run.end < all) {
            let far = self.limb_frame_distance(run.end - 1, run.end);
            if far > self.limb.least_rest_jump()
                && far > LAPSE_JUMP_LIMITS.0 * self.usual_step_length(&run, rate)
                // A limb at rest stands still as well: it is reported once, by its better reason.
                && !found_lapses.iter().any(|known| has_common_frame(&known.frames, &run))
            {
                found_lapses.push(lapse(run, LostMovement::Still(far)));
            }
        }
        let (least, speed) = self.limb.impossible_jump_limits();
        // At low frame rates even one frame is longer than the limit.
        let longest = ((LIMB_ABSENCE_LIMITS.0 * rate).ceil() as usize).max(1);
        let mut frame = 1;
        while frame < all {
            let far = self.limb_frame_distance(frame - 1, frame);
            if far > least && far * rate > speed {
                // A limb that returns to where it was had not moved; one that stays away has.
                let back = (frame + 1..(frame + longest + 1).min(all))
                    .find(|&back| self.limb_frame_distance(frame - 1, back) < LIMB_ABSENCE_LIMITS.1 * far);
                if let Some(back) = back.filter(|&back| {
                    let run = frame..back;
                    far > LAPSE_JUMP_LIMITS.0 * self.usual_step_length(&run, rate)
                        && !found_lapses.iter().any(|known| has_common_frame(&known.frames, &run))
                }) {
                    found_lapses.push(lapse(frame..back, LostMovement::Away(far)));
                    frame = back;
                }
            }
            frame += 1;
        }
        found_lapses
    }
}

/// Returns whether two ranges of frames have one in common.
fn has_common_frame(a: &Range<usize>, b: &Range<usize>) -> bool {
    a.start < b.end && b.start < a.end
}

/// Returns the runs of frames for which this holds.
fn true_frame_runs(holds: &[bool]) -> impl Iterator<Item = Range<usize>> + '_ {
    let mut start = 0;
    holds.chunk_by(|a, b| a == b).filter_map(move |run| {
        let from = start;
        start += run.len();
        run[0].then_some(from..start)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::tests::fixtures::{PLAIN_BODY_VARIATION, fixture_body, fixture_joint_roles};
    use crate::clip::JointChannel;
    use crate::time::FrameRate;

    /// Returns two seconds of signing at 100 frames a second, with the posture of each frame taken from the frame that
    /// `source` names.
    fn take(source: impl Fn(usize, usize) -> Option<usize>) -> (Clip, BodyAnatomy) {
        let skeleton = std::sync::Arc::new(fixture_body(PLAIN_BODY_VARIATION));
        let anatomy = BodyAnatomy::with_roles(&skeleton, &fixture_joint_roles(&skeleton)).expect("a body");
        let rate = FrameRate::new(100, 1).expect("a rate");
        let turned = |joint: usize, frame: usize| {
            let (own, at) = (joint as f64, frame as f64 / 100.0);
            let size = if joint == 0 { 0.02 } else { 0.4 };
            let axis = DVec3::new(own.sin(), own.cos(), 0.5).normalize();
            DQuat::from_axis_angle(axis, size * (5.0 * at).sin())
        };
        let channels = (0..skeleton.len()).map(|joint| {
            let from = |frame: usize| source(joint, frame);
            let turn = |frame| from(frame).map_or(DQuat::IDENTITY, |at| turned(joint, at));
            let place = |frame| match from(frame) {
                Some(at) => DVec3::new(0.0, 1.0, at as f64 / 500.0),
                None => DVec3::ZERO,
            };
            JointChannel {
                rotations: (0..200).map(turn).collect(),
                translations: (joint == 0).then(|| (0..200).map(place).collect()),
            }
        });
        let channels = channels.collect();
        let clip = Clip::new(skeleton, rate, channels).expect("a clip");
        (clip, anatomy)
    }

    fn found(source: impl Fn(usize, usize) -> Option<usize>) -> ClipLapses {
        let (clip, anatomy) = take(source);
        ClipLapses::find_clip_lapses(&clip, &anatomy)
    }

    fn joints(limb: LapseLimb) -> Vec<usize> {
        let (clip, anatomy) = take(|_, frame| Some(frame));
        match limb {
            LapseLimb::Body => (0..clip.clip_skeleton().len()).collect(),
            LapseLimb::Arm(side) => anatomy
                .arm_chain(side)
                .map(|arm| vec![arm.upper, arm.forearm])
                .unwrap_or_default(),
            LapseLimb::Fingers(side) => anatomy.finger_joints(side),
        }
    }

    #[test]
    fn a_limb_that_stands_still_or_drops_to_rest_is_found_with_its_frames() {
        for limb in LapseLimb::all_lapse_limbs() {
            let own = joints(limb);
            let held = found(|joint, frame| match own.contains(&joint) {
                true if (56..71).contains(&frame) => Some(55),
                _ => Some(frame),
            });
            let [lapse] = held.found.as_slice() else {
                panic!("{limb}: {held:?}");
            };
            assert_eq!((&lapse.frames, lapse.limb), (&(56..71), limb));
            assert!(
                matches!(lapse.what, LostMovement::Still(far) if far > limb.least_rest_jump()),
                "{lapse:?}"
            );
            let rests = found(|joint, frame| match own.contains(&joint) {
                true if (56..71).contains(&frame) => None,
                _ => Some(frame),
            });
            let [lapse] = rests.found.as_slice() else {
                panic!("{limb}: {rests:?}");
            };
            assert_eq!((&lapse.frames, lapse.limb), (&(56..71), limb));
            assert!(matches!(lapse.what, LostMovement::Rest(_)), "{lapse:?}");
        }
    }

    #[test]
    fn an_arm_that_leaves_for_a_moment_is_found() {
        let own = joints(LapseLimb::Arm(BodySide::Left));
        let away = found(|joint, frame| match own.contains(&joint) {
            true if (80..84).contains(&frame) => Some(frame + 60),
            _ => Some(frame),
        });
        assert_eq!(away.found.len(), 1, "{away:?}");
        assert_eq!(away.found[0].frames, 80..84);
        assert!(away.found[0].to_string().contains("the left arm jumps"), "{away:?}");
    }

    #[test]
    fn movement_and_holds_without_jumps_are_no_lapses() {
        assert_eq!(found(|_, frame| Some(frame)).found, []);
        let eased = |frame: usize| match frame {
            80..120 => 80,
            120.. => frame - 39,
            _ => frame,
        };
        assert_eq!(found(|_, frame| Some(eased(frame))).found, []);
        assert_eq!(found(|_, _| Some(7)).found, []);
        assert_eq!(found(|_, _| None).found, []);
    }

    #[test]
    fn frames_that_stand_twice_are_counted() {
        let twice = found(|_, frame| Some(frame / 2 * 2));
        assert_eq!((twice.repeated, twice.moving, twice.found.len()), (100, 200, 0));
        let once = found(|_, frame| Some(frame));
        assert_eq!((once.repeated, once.moving), (0, 200));
        let held = found(|_, frame| Some(frame.min(150)));
        assert_eq!((held.repeated, held.moving), (0, 151));
    }
}
