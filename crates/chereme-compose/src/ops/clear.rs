//! Keeps placed hands out of head and trunk.

use std::ops::Range;

use chereme_motion::glam::DVec3;
use chereme_motion::{BodySide, ModelPose};

use crate::arm;
use crate::contact::{CONTACT_BLEND_S, blend_shifts};
use crate::notation::notation_stage::TrunkObstacle;
use crate::notation::skull::SkullEllipsoid;
use crate::recipe_settings::ArmSolverMethod;
use crate::work::{JointColumns, JointGroup, WorkingClip};

/// The depth in metres that a joint of a finger may have in a body without skin.
const FINGER_SKIN_DEPTH_M: f64 = 0.01;
/// The largest number of rounds in which hands are moved out of the body; the report describes any remaining depth.
const MAX_CLEARING_ROUNDS: usize = 4;

/// The displacement that kept a hand out of the body.
pub(crate) struct ClearingShift {
    /// The displacement in each frame.
    displacements: Vec<DVec3>,
    /// The remaining depth in the body, in metres.
    deep: f64,
}

impl ClearingShift {
    /// Returns the largest displacement in these frames.
    pub(crate) fn largest_shift_in(&self, frames: &Range<usize>) -> f64 {
        let displacements = self.displacements.get(frames.clone()).unwrap_or_default();
        displacements
            .iter()
            .map(|displacement| displacement.length())
            .fold(0.0, f64::max)
    }

    pub(crate) fn describe_clearing_shift(&self, work: &WorkingClip, side: BodySide, frames: &Range<usize>) -> String {
        let (side, cm) = (side.body_side_name(), |metres: f64| metres * 100.0);
        let moved = self.displacements.iter().map(|displacement| displacement.length());
        let count = moved.clone().filter(|displacement| *displacement > 1e-4).count();
        let most = moved.fold(0.0, f64::max);
        let mut text = format!(
            "the {side} hand is kept out of head and trunk: moved by up to {:.1} cm in {count} {}",
            cm(most),
            if count == 1 { "frame" } else { "frames" }
        );
        if self.largest_shift_in(frames) > FINGER_SKIN_DEPTH_M {
            let start_instant = work.rate.frame_start_instant(frames.start);
            text += &format!(
                ", at {start_instant} {:.1} cm away from its goal, as the hand would enter the body there; turn it with `orient`",
                cm(self.largest_shift_in(frames))
            );
        }
        if self.deep > FINGER_SKIN_DEPTH_M {
            text += &format!(", and still {:.1} cm in the body", cm(self.deep));
        }
        text
    }
}

/// Moves the wrist of `side` out if the hand is deeper in head or trunk than before; returns `None` if the hand
/// stays outside.
pub(crate) fn clear_hand_of_body(
    work: &mut WorkingClip,
    before: &WorkingClip,
    side: BodySide,
    solver: ArmSolverMethod,
) -> Option<ClearingShift> {
    let hand = work.anatomy.arm_chain(side)?.hand;
    let was = HandDepths::measure_hand_depths(before, side);
    let blend = (CONTACT_BLEND_S / work.rate.frame_time()).round() as usize;
    let mut all = vec![DVec3::ZERO; work.frames];
    let mut deep = 0.0;
    for round in 0..=MAX_CLEARING_ROUNDS {
        let now = HandDepths::measure_hand_depths(work, side);
        let displacements: Vec<Option<DVec3>> = now
            .0
            .iter()
            .zip(&was.0)
            .map(|(now, was)| {
                let allowed = was.length().max(FINGER_SKIN_DEPTH_M);
                let over = now.length() - allowed;
                (over > 1e-4).then(|| now.normalize_or_zero() * over)
            })
            .collect();
        deep = now
            .0
            .iter()
            .zip(&was.0)
            .map(|(now, was)| {
                if now.length() > was.length().max(FINGER_SKIN_DEPTH_M) {
                    now.length()
                } else {
                    0.0
                }
            })
            .fold(0.0, f64::max);
        if round == MAX_CLEARING_ROUNDS || displacements.iter().all(Option::is_none) {
            break;
        }
        let displacements = blend_shifts(&displacements, blend);
        let columns = JointColumns::joint_columns_of(work, [hand]);
        let wrists = columns.joint_positions(hand).iter().zip(&displacements);
        let targets: Vec<DVec3> = wrists.map(|(at, displacement)| *at + *displacement).collect();
        arm::move_wrist(work, side, &columns, &targets, None, solver)?;
        for (sum, displacement) in all.iter_mut().zip(displacements) {
            *sum += displacement;
        }
    }
    if all.iter().all(|displacement| *displacement == DVec3::ZERO) {
        return None;
    }
    work.note_changed_groups([JointGroup::Arm(side)], "kept out of the body");
    Some(ClearingShift {
        displacements: all,
        deep,
    })
}

/// For each frame the longest vector by which a joint or tip of a hand would leave the body.
struct HandDepths(Vec<DVec3>);

impl HandDepths {
    fn measure_hand_depths(work: &WorkingClip, side: BodySide) -> Self {
        let mut joints = work.anatomy.finger_joints(side);
        joints.extend(work.anatomy.arm_chain(side).map(|arm| arm.hand));
        let columns = JointColumns::joint_columns_of(work, joints.iter().copied());
        let mut displacements = Vec::with_capacity(work.frames);
        for frame in 0..work.frames {
            let solids = BodySolids::solids_in_frame(work, frame);
            let mut longest = DVec3::ZERO;
            for &joint in &joints {
                let (at, turned) = (
                    columns.joint_positions(joint)[frame],
                    columns.joint_rotations(joint)[frame],
                );
                let tip = work.skeleton.joint_at(joint).tip.map(|tip| at + turned * tip);
                for point in [Some(at), tip].into_iter().flatten() {
                    let offset = solids.offset_out_of_solids(point);
                    if offset.length_squared() > longest.length_squared() {
                        longest = offset;
                    }
                }
            }
            displacements.push(longest);
        }
        Self(displacements)
    }
}

/// Head and trunk in one frame.
struct BodySolids {
    trunk: TrunkObstacle,
    head: Option<SkullEllipsoid>,
}

impl BodySolids {
    fn solids_in_frame(work: &WorkingClip, frame: usize) -> Self {
        let pose = work.local_pose_at(frame);
        let model = ModelPose::from_local_pose(&work.skeleton, &pose);
        let measures = work.anatomy.anatomy_measures();
        let body = work.anatomy.body_frame(&model);
        let trunk = TrunkObstacle::trunk_from_frame(
            body.filter(|_| measures.is_some()),
            measures.map_or(0.5, |measure| measure.trunk),
        );
        Self {
            trunk,
            head: SkullEllipsoid::skull_from_posture(&work.anatomy, &work.skeleton, &model),
        }
    }

    fn offset_out_of_solids(&self, at: DVec3) -> DVec3 {
        let trunk = self.trunk.offset_out_of_trunk(at, 0.0);
        let head = self
            .head
            .as_ref()
            .map_or(DVec3::ZERO, |head| head.offset_out_of_skull(at));
        if head.length_squared() > trunk.length_squared() {
            head
        } else {
            trunk
        }
    }
}
