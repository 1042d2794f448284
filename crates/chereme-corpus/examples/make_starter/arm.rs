//! Where elbow and collar bone go when the wrist is somewhere, and how forearm and hand share a turn.

use chereme_motion::glam::{DMat3, DQuat, DVec3};
use chereme_motion::{ArmChain, ModelPose, Pose, Side, Skeleton};

/// How a hand hangs on its forearm: the turn of the forearm about its length, and the bend of the
/// wrist, which has no such turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wrist {
    /// In radians, nought with the thumb on the side to which the elbow bends; growing, the palm
    /// turns down.
    pub(crate) twist: f64,
    /// The rotation of the hand's joint.
    pub(crate) bend: DQuat,
}

/// Turns the collar bone, upper arm and forearm of `pose` so that the wrist is at `wrist`.
///
/// `raise` lifts the elbow from hanging (0) to shoulder height (1). Bends of the forearm are about
/// the hinge of the elbow alone; its turn about its length is left for [`hang`]. Returns the rotation
/// of the forearm in model space and the distance by which the wrist is missed, in metres.
pub(crate) fn reach(
    skeleton: &Skeleton,
    pose: &mut Pose,
    arm: &ArmChain,
    side: Side,
    wrist: DVec3,
    raise: f64,
) -> (DQuat, f64) {
    let sign = side.sign();
    let model = ModelPose::of(skeleton, pose);
    let chest = arm.clavicle.and_then(|joint| skeleton.parent(joint));
    let trunk = chest.map_or(DQuat::IDENTITY, |joint| model.rotation(joint));
    if let Some(collar) = arm.clavicle {
        let from = trunk.inverse() * (wrist - model.position(arm.upper));
        pose.rotations[collar] = collar_turn(from, sign);
    }
    let model = ModelPose::of(skeleton, pose);
    let shoulder = model.position(arm.upper);
    let pole = trunk * elbow_pole(sign, raise);
    let lengths = [arm.forearm, arm.hand].map(|joint| skeleton.joint(joint).offset.length());
    let (elbow, end) = bent(shoulder, wrist, pole, lengths);
    let upper = (elbow - shoulder).normalize();
    let lower = (end - elbow).normalize();
    let flex = lower.reject_from_normalized(upper).normalize();
    let turned = |along: DVec3, flex: DVec3| {
        let x = along * sign;
        DQuat::from_mat3(&DMat3::from_cols(x, flex.cross(x), flex)).normalize()
    };
    let lower_flex = -upper.reject_from_normalized(lower).normalize();
    let above = turned(upper, flex);
    let below = turned(lower, lower_flex);
    let parent = skeleton
        .parent(arm.upper)
        .map_or(DQuat::IDENTITY, |joint| model.rotation(joint));
    pose.rotations[arm.upper] = (parent.inverse() * above).normalize();
    pose.rotations[arm.forearm] = (above.inverse() * below).normalize();
    (below, end.distance(wrist))
}

/// Returns how a hand turned as `hand` in model space hangs on the forearm that [`reach`] gave.
pub(crate) fn hang(forearm: DQuat, hand: DQuat) -> Wrist {
    let between = (forearm.inverse() * hand).normalize();
    let turn = DQuat::from_xyzw(between.x, 0.0, 0.0, between.w).normalize();
    let twist = 2.0 * turn.x.atan2(turn.w);
    let whole = std::f64::consts::TAU;
    Wrist {
        twist: twist - (twist / whole).round() * whole,
        bend: (turn.inverse() * between).normalize(),
    }
}

/// Gives forearm and hand of `pose` the turn and bend of `wrist`; the forearm has been through [`reach`].
pub(crate) fn set_wrist(pose: &mut Pose, arm: &ArmChain, wrist: &Wrist) {
    pose.rotations[arm.forearm] *= DQuat::from_rotation_x(wrist.twist);
    pose.rotations[arm.hand] = wrist.bend;
}

/// The elbow hangs down, a little outwards and back, unless it is raised outwards.
fn elbow_pole(sign: f64, raise: f64) -> DVec3 {
    let hanging = DVec3::new(0.45 * sign, -0.80, -0.45);
    let raised = DVec3::new(0.98 * sign, -0.05, -0.25);
    hanging.lerp(raised, raise).normalize()
}

/// The collar bone rises and comes forward with a hand that is high, far or across the body.
fn collar_turn(from: DVec3, sign: f64) -> DQuat {
    let smooth = |x: f64| {
        let x = x.clamp(0.0, 1.0);
        x * x * (3.0 - 2.0 * x)
    };
    let up = 13.0 * smooth((from.y + 0.30) / 0.65) + 2.0;
    let across = -from.x * sign;
    let forward = 9.0 * smooth((from.z - 0.15) / 0.40) + 8.0 * smooth((across + 0.05) / 0.45);
    DQuat::from_rotation_z(sign * up.to_radians())
        * DQuat::from_rotation_y(-sign * forward.to_radians())
}

/// Returns elbow and wrist of two bones that reach for `target`, the elbow on the side of `pole`.
fn bent(shoulder: DVec3, target: DVec3, pole: DVec3, [first, second]: [f64; 2]) -> (DVec3, DVec3) {
    let way = target - shoulder;
    let towards = way.normalize();
    let far = 0.995 * (first + second);
    let near = (first - second).abs() + 0.02;
    let reach = way.length().clamp(near, far);
    let along = (first * first - second * second + reach * reach) / (2.0 * reach);
    let beside = (first * first - along * along).max(0.0).sqrt();
    let out = pole.reject_from_normalized(towards).normalize();
    (
        shoulder + towards * along + out * beside,
        shoulder + towards * reach,
    )
}
