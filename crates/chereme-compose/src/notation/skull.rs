//! The head as an obstacle, and hands that go round it.

use chereme_motion::glam::DVec3;
use chereme_motion::{BodyAnatomy, BodyPart, ModelPose, Skeleton};

use super::hands_apart::PartedMoment;
use super::notation_bulk::PlacedHand;
use super::notation_solve::ease_push_vectors;
use super::notation_stage::StandingBody;
use super::notation_track::HandGoalFrames;
use super::notation_tuned::tuned;

/// Half of the head's breadth, height and depth, as shares of its height from chin to top; a little within the places
/// of the face, which hands touch.
const SKULL_HALF_EXTENTS: [f64; 3] = [0.33, 0.49, 0.42];
/// The height of the head's middle above the chin, as a share of the head's height.
const SKULL_MIDDLE_SHARE: f64 = 0.5;
/// Displacement (m) of a hand above which it is reported.
const REPORTED_SKULL_SHIFT_M: f64 = 0.01;

/// The head in one frame: an ellipsoid.
pub(crate) struct SkullEllipsoid {
    middle: DVec3,
    axes: [DVec3; 3],
    half: [f64; 3],
}

impl SkullEllipsoid {
    /// Returns the head of a body in a posture; `None` if the skeleton has no head.
    pub(crate) fn skull_from_posture(anatomy: &BodyAnatomy, skeleton: &Skeleton, model: &ModelPose) -> Option<Self> {
        anatomy.part_joint(BodyPart::Head)?;
        let size = anatomy.anatomy_measures()?.head;
        let axes = anatomy.head_axes(model)?;
        let top = anatomy.landmark_place_position(skeleton, model, "head-top")?;
        Some(Self {
            middle: top - axes[1] * ((1.0 - SKULL_MIDDLE_SHARE) * size),
            axes,
            half: SKULL_HALF_EXTENTS.map(|share| share * size),
        })
    }

    /// Returns the radius of a ball about the head's middle that holds the head.
    fn skull_ball_radius(&self) -> f64 {
        self.half.into_iter().fold(0.0, f64::max)
    }

    /// Returns the vector by which a point in the head leaves it, straight away from the head's middle.
    pub(crate) fn offset_out_of_skull(&self, at: DVec3) -> DVec3 {
        let offset = at - self.middle;
        let shares: [f64; 3] = std::array::from_fn(|axis| offset.dot(self.axes[axis]) / self.half[axis]);
        let share = shares.iter().map(|part| part * part).sum::<f64>().sqrt();
        if share >= 1.0 {
            return DVec3::ZERO;
        }
        if share < 1e-6 {
            return self.axes[2] * self.half[2];
        }
        offset * (1.0 / share - 1.0)
    }
}

/// Moves the goals of a hand out of the head wherever a bone of its fingers would be inside, except in contact; returns
/// the farthest move, if it is large enough to report.
pub(super) fn go_round(stage: &StandingBody, wanted: &mut HandGoalFrames<'_>, rate: f64) -> Option<PartedMoment> {
    let skull = SkullEllipsoid::skull_from_posture(&stage.anatomy, &stage.skeleton, &stage.model)?;
    let soft = tuned().skull.soft;
    let deepest = |frame: usize| {
        let free = 1.0 - wanted.touch[frame];
        let hand = PlacedHand::posed_hand_at_frame(wanted, frame).filter(|_| free > 0.0)?;
        if !hand.may_touch(skull.middle, skull.skull_ball_radius()) {
            return None;
        }
        let offsets = hand.finger_bone_points().map(|at| skull.offset_out_of_skull(at));
        let most = offsets.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))?;
        let over = most.length() - soft;
        (over > 0.0).then(|| most.normalize() * (over * free))
    };
    let outs: Vec<DVec3> = (0..wanted.points.len())
        .map(|frame| deepest(frame).unwrap_or(DVec3::ZERO))
        .collect();
    if outs.iter().all(|out| *out == DVec3::ZERO) {
        return None;
    }
    let near = ((tuned().skull.around * rate).ceil() as usize).max(1);
    let mut most: Option<PartedMoment> = None;
    for (frame, out) in ease_push_vectors(&outs, near).into_iter().enumerate() {
        let out = out * (1.0 - wanted.touch[frame]);
        wanted.points[frame] += out;
        let by = out.length();
        if by > most.map_or(REPORTED_SKULL_SHIFT_M, |most| most.by) {
            let time = frame as f64 / rate;
            most = Some(PartedMoment { time, by });
        }
    }
    most
}
