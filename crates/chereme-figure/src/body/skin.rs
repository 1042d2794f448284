//! A skin whose vertices follow several joints, with extra joints halfway between that keep it full at bends.

use chereme_motion::ModelPose;
use glam::{Mat3, Quat, Vec3};

use super::body_shape::{posed_joint_position, posed_joint_rotation};
use super::trunk::{ArmRig, TrunkRig};

/// Something that moves vertices of a skin. Rotations are relative to the bind posture, in which the skin was fitted,
/// in its own space: the signer's left, up and forwards from the middle of the shoulders.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum SkinFollower {
    /// A joint; `turn` rotates bind space to the joint's space, `at` is its position in bind space.
    Joint {
        joint: usize,
        turn: Quat,
        at: Vec3,
    },
    /// The same as another follower.
    Same(usize),
    /// A joint halfway between two followers, about a point of bind space; it becomes thicker across a bend.
    Half {
        parent: usize,
        child: usize,
        at: Vec3,
        along: Vec3,
        swell: f32,
    },
    /// The pelvis, or the chest.
    Pelvis,
    Chest,
    /// The skin over a shoulder: rotates with the chest, moves with the shoulder's joint.
    Shoulder(usize),
    /// The upper arm with a share of its rotation about its length.
    Upper(usize, f32),
    /// The forearm with a share of the hand's rotation about its length.
    Fore(usize, f32),
    /// The hand.
    Hand(usize),
}

/// The motion of a follower: it rotates by `turn` about `from`, and moves that point to `to`.
#[derive(Debug, Clone, Copy)]
pub(super) struct FollowerMotion {
    pub(super) turn: Quat,
    pub(super) from: Vec3,
    pub(super) to: Vec3,
    pub(super) stretch: Option<(Vec3, f32)>,
}

impl FollowerMotion {
    pub(super) fn new(turn: Quat, from: Vec3, to: Vec3) -> Self {
        Self {
            turn,
            from,
            to,
            stretch: None,
        }
    }

    /// Returns the rotated axes and the offset of this motion.
    pub(super) fn motion_matrix(&self) -> (Mat3, Vec3) {
        let mut turn = Mat3::from_quat(self.turn);
        if let Some((direction, factor)) = self.stretch {
            let outer = Mat3::from_cols(
                direction * direction.x,
                direction * direction.y,
                direction * direction.z,
            );
            turn *= Mat3::IDENTITY + outer * (factor - 1.0);
        }
        (turn, self.to - turn * self.from)
    }
}

/// A vertex of a skin: its position in bind space, and the followers that move it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BoundSkinVertex {
    pub(super) at: Vec3,
    pub(super) followers: [u16; 4],
    pub(super) weights: [f32; 4],
}

impl BoundSkinVertex {
    /// Returns a vertex that is moved by the four strongest of its weighted followers.
    pub(super) fn new(at: Vec3, shares: &[(usize, f32)]) -> Self {
        let mut sorted: Vec<(usize, f32)> = Vec::with_capacity(shares.len());
        for &(follower, share) in shares {
            match sorted.iter_mut().find(|(known, _)| *known == follower) {
                Some((_, sum)) => *sum += share,
                None => sorted.push((follower, share)),
            }
        }
        sorted.sort_by(|a, b| b.1.total_cmp(&a.1));
        sorted.truncate(4);
        let sum: f32 = sorted.iter().map(|share| share.1).sum();
        let mut bound = Self {
            at,
            followers: [0; 4],
            weights: [0.0; 4],
        };
        for (k, (follower, share)) in sorted.into_iter().enumerate() {
            bound.followers[k] = follower as u16;
            bound.weights[k] = share / sum.max(1e-6);
        }
        bound
    }
}

/// The followers of a body, with the joints that move them.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct SkinRig {
    pub(super) followers: Vec<SkinFollower>,
    pub(super) trunk: Option<TrunkRig>,
    pub(super) arms: [Option<ArmRig>; 2],
}

impl SkinRig {
    /// Adds a follower and returns its index.
    pub(super) fn add_follower(&mut self, follower: SkinFollower) -> usize {
        self.followers.push(follower);
        self.followers.len() - 1
    }

    /// Returns the axes and the offset of each follower in `pose`.
    pub(super) fn follower_matrices(&self, pose: &ModelPose) -> Vec<(Mat3, Vec3)> {
        self.follower_motions(pose)
            .iter()
            .map(FollowerMotion::motion_matrix)
            .collect()
    }

    /// Returns the motion of each follower in `pose`.
    pub(super) fn follower_motions(&self, pose: &ModelPose) -> Vec<FollowerMotion> {
        let trunk = self.trunk.as_ref().map(|trunk| trunk.pose_trunk(pose));
        let chest = trunk.map_or(Quat::IDENTITY, |trunk| trunk.chest.turn);
        let arms = [0, 1].map(|side| self.arms[side].as_ref().map(|arm| arm.pose_arm_rig(pose, chest)));
        let rest = FollowerMotion::new(Quat::IDENTITY, Vec3::ZERO, Vec3::ZERO);
        let mut motions: Vec<FollowerMotion> = Vec::with_capacity(self.followers.len());
        for follower in &self.followers {
            let motion = match *follower {
                SkinFollower::Joint { joint, turn, at } => FollowerMotion::new(
                    posed_joint_rotation(pose, joint) * turn,
                    at,
                    posed_joint_position(pose, joint),
                ),
                SkinFollower::Same(other) => motions[other],
                SkinFollower::Half {
                    parent,
                    child,
                    at,
                    along,
                    swell,
                } => halfway_motion([motions[parent], motions[child]], at, along, swell),
                SkinFollower::Pelvis => trunk.map_or(rest, |trunk| trunk.pelvis),
                SkinFollower::Chest => trunk.map_or(rest, |trunk| trunk.chest),
                SkinFollower::Shoulder(side) => arms[side].map_or(rest, |arm| arm.shoulder),
                SkinFollower::Upper(side, share) => arms[side].map_or(rest, |arm| arm.upper_arm_motion(share)),
                SkinFollower::Fore(side, share) => arms[side].map_or(rest, |arm| arm.forearm_motion(share)),
                SkinFollower::Hand(side) => arms[side].map_or(rest, |arm| arm.hand),
            };
            motions.push(motion);
        }
        motions
    }
}

/// Returns the motion halfway between two, about a point of the child.
pub(super) fn halfway_motion(
    [parent, child]: [FollowerMotion; 2],
    at: Vec3,
    along: Vec3,
    swell: f32,
) -> FollowerMotion {
    let other = if parent.turn.dot(child.turn) < 0.0 {
        -child.turn
    } else {
        child.turn
    };
    let sum = parent.turn + other;
    let turn = if sum.length_squared() > 1e-6 {
        sum.normalize()
    } else {
        child.turn
    };
    let (axis, angle) = (parent.turn.inverse() * other).normalize().to_axis_angle();
    let across = axis.cross(along);
    let stretch = (angle > 0.02 && across.length_squared() > 0.04).then(|| {
        let much = (1.0 - (angle.min(2.4) / 2.0).cos()) / (1.0 - std::f32::consts::FRAC_PI_4.cos());
        (across.normalize(), 1.0 + swell * much)
    });
    let (turned, offset) = child.motion_matrix();
    FollowerMotion {
        turn,
        from: at,
        to: turned * at + offset,
        stretch,
    }
}

/// Returns the angle by which `turn` rotates about `axis`, in radians.
pub(super) fn twist_angle(turn: Quat, axis: Vec3) -> f32 {
    let sine = Vec3::new(turn.x, turn.y, turn.z).dot(axis);
    let angle = 2.0 * sine.atan2(turn.w);
    let full = std::f32::consts::TAU;
    angle - full * (angle / full).round()
}
