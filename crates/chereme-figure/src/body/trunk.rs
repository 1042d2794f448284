//! The rotations of trunk and arms of a skeleton, whatever its joints' own axes are.

use chereme_motion::{BodyAnatomy, BodySide, ModelPose, Skeleton, anatomy::BodyPart};
use glam::{Mat3, Quat, Vec3};

use super::body_hand::HandAxes;
use super::body_shape::{posed_joint_position, posed_joint_rotation};
use super::skin::{FollowerMotion, twist_angle};

/// The angle of an arm below the horizontal in the bind posture, in radians.
const LOWERED_ARM_RADIANS: f32 = 0.70;
/// Distance of the hips' joint before or behind the thighs, as a share of a body's size in metres, above which the
/// pelvis is at the thighs: some skeletons have their root in front of the belly.
const OFF_THIGHS: f32 = 0.05;

/// Returns the direction of an arm in the bind posture.
pub(super) fn arm_direction(side: BodySide) -> Vec3 {
    let (sine, cosine) = LOWERED_ARM_RADIANS.sin_cos();
    Vec3::new(cosine * side.side_sign() as f32, -sine, 0.0)
}

/// The joints of the trunk, and their positions in bind space.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TrunkRig {
    /// Right and left shoulder.
    shoulders: [usize; 2],
    /// Joints on the right and the left: the line between them rotates with the chest, and with the pelvis.
    lines: [Option<[usize; 2]>; 2],
    /// Right and left thigh.
    thighs: Option<[usize; 2]>,
    /// The joint in the middle of the spine.
    middle: Option<usize>,
    hips: Option<usize>,
    /// The middle of the pelvis in the space of the hips' joint, in metres: zero unless that joint stands before or behind
    /// the thighs. `None` if the skeleton does not stand at rest, so that each posture shows it.
    seat: Option<Vec3>,
    /// The size of the body relative to an adult's.
    size: f32,
    /// A joint, and the upward direction in its space, for skeletons without hips.
    upright: (usize, Vec3),
    /// The joint to which the chest is fixed, and its position in bind space.
    anchor: Option<(usize, Vec3)>,
    hips_at: Vec3,
    /// The joints that rotate with chest and pelvis, each with the rotation from bind space to its own space, if the
    /// skeleton stands at rest.
    turning: Option<[(usize, Quat); 2]>,
}

/// The motions of pelvis and chest.
#[derive(Debug, Clone, Copy)]
pub(super) struct TrunkPosed {
    pub(super) pelvis: FollowerMotion,
    pub(super) chest: FollowerMotion,
}

/// Returns the rotation whose first axis is `left` and whose second is as near to `up` as possible.
fn rotation_from_left_up(left: Vec3, up: Vec3) -> Quat {
    let left = left.normalize_or(Vec3::X);
    let up = (up - left * left.dot(up)).normalize_or(left.any_orthonormal_vector());
    Quat::from_mat3(&Mat3::from_cols(left, up, left.cross(up))).normalize()
}

impl TrunkRig {
    /// Returns the trunk of a skeleton with both shoulders.
    pub(super) fn from_trunk_joints(
        skeleton: &Skeleton,
        anatomy: &BodyAnatomy,
        rest: &ModelPose,
        size: f32,
        trunk: f32,
    ) -> Option<Self> {
        let joint = |part| anatomy.part_joint(part);
        let pair = |part: fn(BodySide) -> BodyPart| match BodySide::BOTH_SIDES.map(|side| joint(part(side))) {
            [Some(right), Some(left)] => Some([right, left]),
            _ => None,
        };
        let shoulders = pair(BodyPart::UpperArm)?;
        let apart =
            |[right, left]: [usize; 2]| posed_joint_position(rest, right).distance(posed_joint_position(rest, left));
        let collars = pair(BodyPart::Clavicle).filter(|&joints| apart(joints) > 0.12 * apart(shoulders));
        let thighs = pair(BodyPart::Thigh);
        let lines = [collars, thighs.filter(|&joints| apart(joints) > 0.03 * size)];
        let mid = (posed_joint_position(rest, shoulders[0]) + posed_joint_position(rest, shoulders[1])) * 0.5;
        let hips = joint(BodyPart::Hips).filter(|&hips| posed_joint_position(rest, hips).distance(mid) > 0.25 * size);
        let top = joint(BodyPart::Neck).or(joint(BodyPart::Head));
        let middle = hips.zip(top).and_then(|(hips, top)| {
            let target = posed_joint_position(rest, hips).lerp(mid, 0.45);
            let far = |joint: usize| posed_joint_position(rest, joint).distance(target);
            let chain = skeleton.joint_ancestors(top).skip(1);
            let nearest = chain
                .take_while(|&joint| joint != hips)
                .min_by(|&a, &b| far(a).total_cmp(&far(b)))?;
            (far(nearest) < 0.15 * size).then_some(nearest)
        });
        let above: Vec<usize> = skeleton.joint_ancestors(shoulders[0]).collect();
        let shared = skeleton
            .joint_ancestors(shoulders[1])
            .find(|ancestor| above.contains(ancestor));
        let carrier = joint(BodyPart::Chest).or(shared).unwrap_or(0);
        let up = anatomy.body_frame(rest).map_or(Vec3::Y, |frame| frame.up.as_vec3());
        let mut rig = Self {
            shoulders,
            lines,
            thighs,
            middle,
            hips,
            seat: None,
            size,
            upright: (carrier, posed_joint_rotation(rest, carrier).inverse() * up),
            anchor: None,
            hips_at: Vec3::new(0.0, -trunk, 0.0),
            turning: None,
        };
        let standing = anatomy.clone().with_reference(skeleton, rest);
        if standing.is_posed() {
            let back = hips.map(|hips| posed_joint_rotation(rest, hips).inverse() * rig.off_hips(rest));
            rig.seat = Some(back.unwrap_or_default());
            let rest_turn = rotation_from_left_up(rig.trunk_left_axis(rest, None), rig.trunk_up_axis(rest));
            rig.turning = Some([carrier, hips.unwrap_or(carrier)].map(|joint| {
                let back = posed_joint_rotation(rest, joint).inverse();
                (joint, (back * rest_turn).normalize())
            }));
            let within = |joint: usize| rest_turn.inverse() * (posed_joint_position(rest, joint) - mid);
            rig.anchor = joint(BodyPart::Neck)
                .map(|neck| (neck, within(neck)))
                .filter(|(_, at)| {
                    let scaled_place = *at / size;
                    scaled_place.x.abs() < 0.05 && (0.0..0.2).contains(&scaled_place.y) && scaled_place.z.abs() < 0.12
                });
            let seat = rig.pelvis(rest).map(|at| rest_turn.inverse() * (at - mid));
            if let Some(at) = seat.filter(|at| at.z.abs() < 0.1 * size) {
                rig.hips_at.z = at.z;
            }
        }
        Some(rig)
    }

    /// Returns the middle of the pelvis in bind space.
    pub(super) fn seat_place(&self) -> Vec3 {
        self.hips_at
    }

    /// Returns the point of bind space about which the chest rotates.
    pub(super) fn chest_place(&self) -> Vec3 {
        self.anchor.map_or(Vec3::ZERO, |(_, at)| at)
    }

    /// Returns whether the skeleton stands at rest, so that positions at rest are meaningful.
    pub(super) fn is_standing_at_rest(&self) -> bool {
        self.turning.is_some()
    }

    fn mid(&self, pose: &ModelPose) -> Vec3 {
        let [right, left] = self.shoulders.map(|joint| posed_joint_position(pose, joint));
        (right + left) * 0.5
    }

    /// Returns the middle of the pelvis, if the skeleton has hips.
    fn pelvis(&self, pose: &ModelPose) -> Option<Vec3> {
        let hips = self.hips?;
        let off = match self.seat {
            Some(seat) => posed_joint_rotation(pose, hips) * seat,
            None => self.off_hips(pose),
        };
        Some(posed_joint_position(pose, hips) + off)
    }

    /// Returns how far the thighs are before or behind the hips' joint; zero below [`OFF_THIGHS`].
    fn off_hips(&self, pose: &ModelPose) -> Vec3 {
        let (Some(hips), Some(thighs)) = (self.hips, self.thighs) else {
            return Vec3::ZERO;
        };
        let between = (posed_joint_position(pose, thighs[0]) + posed_joint_position(pose, thighs[1])) * 0.5;
        let trunk = (self.mid(pose) - between).normalize_or(Vec3::Y);
        let off = (between - posed_joint_position(pose, hips)).reject_from_normalized(trunk);
        let beyond = off.length() / (OFF_THIGHS * self.size).max(1e-6) - 1.0;
        // Rises from nothing to the whole over a fifth of the threshold: nothing jumps from frame to frame.
        off * (5.0 * beyond).clamp(0.0, 1.0)
    }

    fn trunk_left_axis(&self, pose: &ModelPose, line: Option<[usize; 2]>) -> Vec3 {
        let [right, left] = line.or(self.lines[0]).unwrap_or(self.shoulders);
        posed_joint_position(pose, left) - posed_joint_position(pose, right)
    }

    fn trunk_up_axis(&self, pose: &ModelPose) -> Vec3 {
        let (joint, up) = self.upright;
        match self.pelvis(pose) {
            Some(pelvis) => self.mid(pose) - pelvis,
            None => posed_joint_rotation(pose, joint) * up,
        }
    }

    /// Returns the axes of chest and pelvis.
    fn trunk_part_axes(&self, pose: &ModelPose) -> [Quat; 2] {
        let trunk_line = self.trunk_up_axis(pose);
        let chest = self
            .middle
            .map_or(trunk_line, |joint| self.mid(pose) - posed_joint_position(pose, joint));
        let pelvis = match (self.middle, self.pelvis(pose)) {
            (Some(middle), Some(pelvis)) => posed_joint_position(pose, middle) - pelvis,
            _ => trunk_line,
        };
        [
            rotation_from_left_up(self.trunk_left_axis(pose, None), chest),
            rotation_from_left_up(self.trunk_left_axis(pose, self.lines[1]), pelvis),
        ]
    }

    pub(super) fn pose_trunk(&self, pose: &ModelPose) -> TrunkPosed {
        let turns = match self.turning {
            Some(joints) => joints.map(|(joint, own)| (posed_joint_rotation(pose, joint) * own).normalize()),
            None => self.trunk_part_axes(pose),
        };
        let (from, to) = match self.anchor {
            Some((joint, at)) => (at, posed_joint_position(pose, joint)),
            None => (Vec3::ZERO, self.mid(pose)),
        };
        let chest = FollowerMotion::new(turns[0], from, to);
        let pelvis = match self.pelvis(pose) {
            Some(at) => FollowerMotion::new(turns[1], self.hips_at, at),
            None => chest,
        };
        TrunkPosed { pelvis, chest }
    }
}

/// The joints of an arm, and their positions in bind space.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ArmRig {
    joints: [usize; 3],
    /// The direction of the elbow, in the space of the upper arm.
    elbow: Vec3,
    hand: HandAxes,
    along: Vec3,
    /// Shoulder, elbow and wrist in bind space.
    pub(super) places: [Vec3; 3],
    /// The inverse rotations from bind space to the canonical axes of upper arm and hand.
    bind: [Quat; 2],
}

/// The motion of an arm in a posture.
#[derive(Debug, Clone, Copy)]
pub(super) struct ArmPosed {
    pub(super) shoulder: FollowerMotion,
    pub(super) hand: FollowerMotion,
    full: FollowerMotion,
    straight: FollowerMotion,
    along: Vec3,
    forearm: Vec3,
    /// The rotations of upper arm and hand about their lengths, in radians.
    twists: [f32; 2],
}

impl ArmRig {
    /// Returns the arm of `side` with its shoulder at a point of bind space.
    pub(super) fn from_arm_joints(
        anatomy: &BodyAnatomy,
        side: BodySide,
        rest: &ModelPose,
        shoulder: Vec3,
    ) -> Option<Self> {
        let arm = anatomy.arm_chain(side)?;
        let joints = [arm.upper, arm.forearm, arm.hand];
        let [upper, fore, wrist] = joints.map(|joint| posed_joint_position(rest, joint));
        let back = posed_joint_rotation(rest, arm.upper).inverse();
        let bone = (fore - upper).normalize_or(Vec3::X);
        let elbow = anatomy
            .elbow_direction(side)
            .map(|direction| direction.as_vec3())
            .or_else(|| {
                let frame = anatomy.body_frame(rest)?;
                Some(back * -frame.forward.as_vec3())
            });
        let bone_axis = back * bone;
        let elbow_direction = elbow.unwrap_or(bone_axis.any_orthonormal_vector());
        let elbow = (elbow_direction - bone_axis * bone_axis.dot(elbow_direction))
            .normalize_or(bone_axis.any_orthonormal_vector());
        let neutral = -(posed_joint_rotation(rest, arm.upper) * elbow);
        let hand = HandAxes::hand_axes_at_rest(anatomy, side, rest, neutral)?;
        let along = arm_direction(side);
        let lengths = [fore.distance(upper), wrist.distance(fore)].map(|length| length.max(1e-6));
        let places = [
            shoulder,
            shoulder + along * lengths[0],
            shoulder + along * (lengths[0] + lengths[1]),
        ];
        let seat = hand_seat(side);
        Some(Self {
            joints,
            elbow,
            hand,
            along,
            places,
            bind: [
                turned_arm(along, Vec3::NEG_Z).inverse(),
                turned_arm(seat.y_axis, seat.z_axis).inverse(),
            ],
        })
    }

    pub(super) fn hand_joint(&self) -> usize {
        self.joints[2]
    }

    pub(super) fn hand_axes(&self) -> HandAxes {
        self.hand
    }

    pub(super) fn pose_arm_rig(&self, pose: &ModelPose, chest: Quat) -> ArmPosed {
        let [upper, fore, wrist] = self.joints.map(|joint| posed_joint_position(pose, joint));
        let turn = posed_joint_rotation(pose, self.joints[0]);
        let bone = (fore - upper).normalize_or(turn * self.along);
        let full = (turned_arm(bone, turn * self.elbow) * self.bind[0]).normalize();
        let forearm = (wrist - fore).normalize_or(bone);
        let straight = (Quat::from_rotation_arc(bone, forearm) * full).normalize();
        let hand_turn = posed_joint_rotation(pose, self.joints[2]);
        let hand = turned_arm(hand_turn * self.hand.along, hand_turn * self.hand.palm) * self.bind[1];
        let hand = hand.normalize();
        let cuff = Quat::from_rotation_arc((hand * self.along).normalize_or(forearm), forearm) * hand;
        ArmPosed {
            shoulder: FollowerMotion::new(chest, self.places[0], upper),
            hand: FollowerMotion::new(hand, self.places[2], wrist),
            full: FollowerMotion::new(full, self.places[0], upper),
            straight: FollowerMotion::new(straight, self.places[1], fore),
            along: self.along,
            forearm,
            twists: [
                twist_angle((chest.inverse() * full).normalize(), self.along),
                twist_angle((cuff * straight.inverse()).normalize(), forearm),
            ],
        }
    }
}

impl ArmPosed {
    /// Returns the upper arm's motion with a share of its rotation about its length.
    pub(super) fn upper_arm_motion(&self, share: f32) -> FollowerMotion {
        let back = Quat::from_axis_angle(self.along, self.twists[0] * (share - 1.0));
        FollowerMotion {
            turn: (self.full.turn * back).normalize(),
            ..self.full
        }
    }

    /// Returns the forearm's motion with a share of the hand's rotation about its length.
    pub(super) fn forearm_motion(&self, share: f32) -> FollowerMotion {
        let on = Quat::from_axis_angle(self.forearm, self.twists[1] * share);
        FollowerMotion {
            turn: (on * self.straight.turn).normalize(),
            ..self.straight
        }
    }
}

/// Returns the axes of a hand in bind space: towards the thumb, along it, out of the palm.
pub(super) fn hand_seat(side: BodySide) -> Mat3 {
    let along = arm_direction(side);
    let palm = Vec3::Z.cross(along) * -side.side_sign() as f32;
    Mat3::from_cols(Vec3::Z, along, palm)
}

/// Returns the rotation whose first axis is `along` and whose second is near `other`.
fn turned_arm(along: Vec3, other: Vec3) -> Quat {
    rotation_from_left_up(along, other)
}
