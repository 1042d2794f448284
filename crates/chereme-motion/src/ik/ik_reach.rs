//! Moving the wrist of a posture.

use glam::{DQuat, DVec3};

use super::two_bone::{least_turn, source_line};
use super::{FabrikOptions, IkError, TwoBone, TwoBoneOptions, finite, solve_fabrik, two_bone};
use crate::anatomy::{ArmChain, BodyAnatomy};
use crate::hand::BodySide;
use crate::pose::{LocalPose, ModelPose};
use crate::skeleton::Skeleton;

/// The target of a hand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WristTarget {
    /// The position of the wrist in model space, in metres.
    pub position: DVec3,
    /// The rotation of the hand's joint in model space, a unit quaternion.
    pub rotation: DQuat,
}

/// The method that finds the elbow's position.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ElbowSolver {
    /// [`two_bone`]: exact, and keeps the source's swivel.
    #[default]
    Analytic,
    /// [`solve_fabrik`], as in Naert, Larboulette & Gibet 2021; without a soft end.
    Fabrik,
}

/// Settings of a reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReachOptions {
    /// The method that finds the elbow's position.
    pub solver: ElbowSolver,
    /// The soft end of the reach, as in [`TwoBoneOptions::soft`]. The default keeps the wrist within a millimetre
    /// wherever it can be reached; if a movement leaves the reach anyway, 0.05 lets the elbow open more calmly, at the
    /// price of 1.8 % of the arm's length at full extension.
    pub soft: f64,
    /// The share of the arm's length beyond which the collar bone helps; without it the collar bone stays still. It
    /// turns the shoulder towards the target, just enough to keep this share if possible. 0.9 suits people.
    pub clavicle: Option<f64>,
    /// The limit of the collar bone's rotation in radians, which is approached but never reached.
    pub clavicle_limit: f64,
}

impl Default for ReachOptions {
    fn default() -> Self {
        Self {
            solver: ElbowSolver::Analytic,
            soft: TwoBoneOptions::default().soft,
            clavicle: None,
            clavicle_limit: 0.5,
        }
    }
}

/// The result of a reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArmReach {
    /// The distance of the wrist from its target, in metres.
    pub residual_m: f64,
    /// The distance from shoulder to target as a share of the arm's length, after the collar bone
    /// helped; above 1 the target is out of reach.
    pub extension: f64,
    /// Whether the wrist was held back by the soft end near full extension.
    pub soft: bool,
    /// Whether the target lies outside the arm's reach, too far or too near.
    pub clamped: bool,
    /// The rotation of the collar bone, in radians.
    pub clavicle_turn: f64,
}

/// Rotates the arm of `side` in `pose` so that wrist and hand have the target's position and rotation.
///
/// Only the local rotations of upper arm, forearm and hand change, and that of the collar bone if the options ask for
/// it. Bone lengths stay exactly as they are in `pose`. The elbow keeps its swivel; the hand's rotation in model space
/// is exactly the target's, and the forearm takes all of the rotation about its own length, so that the wrist is
/// twisted no more than before. Along a continuous path of postures and targets the result is continuous.
///
/// # Errors
/// [`IkError`] if the skeleton has no such arm, a number is not finite, or a bone has no length; `pose` is unchanged
/// then.
///
/// # Panics
/// Panics if `pose` has fewer joints than `skeleton`.
pub fn reach_wrist(
    anatomy: &BodyAnatomy,
    skeleton: &Skeleton,
    side: BodySide,
    target: &WristTarget,
    options: &ReachOptions,
    pose: &mut LocalPose,
) -> Result<ArmReach, IkError> {
    let arm = anatomy.arm_chain(side).ok_or(IkError::NoArm(side))?;
    finite("target", &[target.position])?;
    if !target.rotation.is_normalized() {
        return Err(IkError::NotFinite("target's rotation"));
    }
    let place = |pose: &LocalPose, joint| joint_model_placement(skeleton, pose, joint);
    let (shoulder, upper) = place(pose, arm.upper);
    let (elbow, forearm) = place(pose, arm.forearm);
    let (wrist, hand) = place(pose, arm.hand);
    if ![upper, forearm, hand].iter().all(|q| q.is_finite()) {
        return Err(IkError::NotFinite("source"));
    }
    let source = [shoulder, elbow, wrist];
    finite("source", &source)?;
    let pole = anatomy
        .elbow_direction(side)
        .map(|out| upper * out)
        .or_else(|| back_and_down(anatomy, skeleton, pose));
    let help = collar(skeleton, pose, &arm, source, target.position, options);
    // The collar bone moves the whole arm before the arm itself is solved.
    let shift = help.map_or(DVec3::ZERO, |help| help.shoulder - shoulder);
    let start = source.map(|at| at + shift);
    let solved = solve_arm_chain(start, target.position, options, pole)?;

    let line = source_line(source);
    let towards = source_line([start[0], solved.middle, solved.end]);
    let line_turn = least_turn(line, towards);
    // First with the whole arm, then the least turn onto the new bone: so the swivel stays.
    let turned = |from: DVec3, to: DVec3| least_turn((line_turn * from).normalize(), to.normalize()) * line_turn;
    let upper = turned(elbow - shoulder, solved.middle - start[0]) * upper;
    let straight = turned(wrist - elbow, solved.end - solved.middle) * forearm;
    let bone = (forearm.inverse() * (wrist - elbow)).normalize();
    let twist_was = rotation_twist(forearm.inverse() * hand, bone);
    let twist_now = rotation_twist(straight.inverse() * target.rotation, bone);
    // The forearm takes the change of twist, so that the wrist is twisted as before.
    let forearm = straight * twist_now * twist_was.inverse();

    // Parents first: each local rotation is computed from the joints above, which are final then.
    if let (Some(help), Some(clavicle)) = (help, arm.clavicle) {
        turn_joint_to(skeleton, pose, clavicle, help.rotation);
    }
    turn_joint_to(skeleton, pose, arm.upper, upper);
    turn_joint_to(skeleton, pose, arm.forearm, forearm);
    turn_joint_to(skeleton, pose, arm.hand, target.rotation);
    Ok(ArmReach {
        residual_m: place(pose, arm.hand).0.distance(target.position),
        extension: solved.extension,
        soft: solved.soft,
        clamped: solved.clamped,
        clavicle_turn: help.map_or(0.0, |help| help.angle),
    })
}

fn solve_arm_chain(
    start: [DVec3; 3],
    target: DVec3,
    options: &ReachOptions,
    pole: Option<DVec3>,
) -> Result<TwoBone, IkError> {
    let soft = options.soft;
    let analytic = two_bone(start, target, &TwoBoneOptions { soft, pole })?;
    if options.solver == ElbowSolver::Analytic {
        return Ok(analytic);
    }
    let chain = solve_fabrik(
        &start,
        target,
        &FabrikOptions {
            pole,
            ..FabrikOptions::default()
        },
    )?;
    Ok(TwoBone {
        middle: chain.points[1],
        end: chain.points[2],
        soft: false,
        ..analytic
    })
}

/// Returns the direction in which an elbow points in a posture that does not show it.
fn back_and_down(anatomy: &BodyAnatomy, skeleton: &Skeleton, pose: &LocalPose) -> Option<DVec3> {
    let frame = anatomy.body_frame(&ModelPose::from_local_pose(skeleton, pose))?;
    Some(-frame.forward - frame.up)
}

#[derive(Debug, Clone, Copy)]
struct ClavicleTurn {
    rotation: DQuat,
    shoulder: DVec3,
    angle: f64,
}

/// Returns the rotation of the collar bone that brings the target within the stated share of the arm's length from the
/// shoulder (or within the source's distance from shoulder to wrist), if possible.
fn collar(
    skeleton: &Skeleton,
    pose: &LocalPose,
    arm: &ArmChain,
    [shoulder, elbow, wrist]: [DVec3; 3],
    target: DVec3,
    options: &ReachOptions,
) -> Option<ClavicleTurn> {
    let share = options.clavicle.filter(|share| share.is_finite())?;
    let (root, turned) = joint_model_placement(skeleton, pose, arm.clavicle?);
    let length = shoulder.distance(elbow) + elbow.distance(wrist);
    // A source that reaches further than the share is not pulled back.
    let enough = (share.max(0.0) * length).max(shoulder.distance(wrist));
    let (bone, to_target) = (shoulder - root, target - root);
    if shoulder.distance(target) <= enough || bone.length() <= 1e-9 * length {
        return None;
    }
    // A target in line with the collar bone cannot be brought nearer by turning.
    let axis = bone.cross(to_target).try_normalize()?;
    let (b, w) = (bone.length(), to_target.length());
    // Law of cosines: the angle at which shoulder and target are `enough` apart.
    let cosine = (b * b + w * w - enough * enough) / (2.0 * b * w);
    let wanted = bone.angle_between(to_target) - cosine.clamp(-1.0, 1.0).acos();
    let limit = options.clavicle_limit.clamp(0.0, std::f64::consts::FRAC_PI_2);
    let angle = if limit > 0.0 {
        // The hyperbolic tangent approaches the limit without a kink and never reaches it.
        limit * (wanted.max(0.0) / limit).tanh()
    } else {
        0.0
    };
    let turn = DQuat::from_axis_angle(axis, angle);
    Some(ClavicleTurn {
        rotation: turn * turned,
        shoulder: root + turn * bone,
        angle,
    })
}

/// Returns the position and the rotation of `joint` in model space.
fn joint_model_placement(skeleton: &Skeleton, pose: &LocalPose, joint: usize) -> (DVec3, DQuat) {
    let (mut at, mut turned) = (DVec3::ZERO, DQuat::IDENTITY);
    for j in skeleton.joint_ancestors(joint) {
        at = pose.translations[j] + pose.rotations[j] * at;
        turned = pose.rotations[j] * turned;
    }
    (at, turned.normalize())
}

/// Sets the local rotation of `joint` so that its rotation in model space is `rotation`.
fn turn_joint_to(skeleton: &Skeleton, pose: &mut LocalPose, joint: usize, rotation: DQuat) {
    let above = skeleton.joint_parent(joint).map_or(DQuat::IDENTITY, |parent| {
        joint_model_placement(skeleton, pose, parent).1
    });
    pose.rotations[joint] = (above.inverse() * rotation).normalize();
}

/// Returns the twist of `q` about the unit vector `axis` (swing-twist decomposition); the identity if `q` is a half
/// turn about a perpendicular axis.
fn rotation_twist(q: DQuat, axis: DVec3) -> DQuat {
    let along = axis * DVec3::new(q.x, q.y, q.z).dot(axis);
    let twist = DQuat::from_xyzw(along.x, along.y, along.z, q.w);
    if twist.length() > 1e-9 {
        twist.normalize()
    } else {
        DQuat::IDENTITY
    }
}
