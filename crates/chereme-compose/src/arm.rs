//! Moves wrists: finds arm postures that bring each wrist to its target, over all frames at once, so that elbows move
//! steadily.
//!
//! Notation has a solver of its own (`notation::freedom`, `notation::solve`), because the two have different givens.
//! Here a posture exists for every frame, and the elbow stays as near to it as the new wrist allows: a captured elbow is
//! worth more than any rule. There no posture exists: a rule proposes the arm's plane, and the elbow is chosen by what
//! it costs the wrist, the hand's orientation and the trunk. Either one in the place of the other loses what its givens
//! hold: elbows of captured takes would follow a rule, or generated elbows a rest posture.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::ik::{FabrikOptions, TwoBoneOptions, solve_fabrik, two_bone};
use chereme_motion::interpolation::smooth_step;
use chereme_motion::{ArmChain, BodySide};

use crate::body::SignerFrame;
use crate::recipe_settings::ArmSolverMethod;
use crate::work::{JointColumns, WorkingClip};

mod free_angle;
mod smooth;
mod swivel;

/// The share of the arm's length beyond which the collar bone helps to reach a target.
pub(crate) const HELP_FROM: f64 = 0.9;
/// The limit of the collar bone's rotation in radians, which is approached but not reached.
const HELP_MOST: f64 = 0.5;
/// The least and the greatest length of the soft end of the reach, as shares of the arm's length. At the least, the
/// wrist comes within a millimetre of every reachable target.
const SOFT_REACH_SHARES: (f64, f64) = (0.004, 0.08);
/// The distance of an elbow from the line from shoulder to wrist at which its swivel counts in full, as a share of the
/// arm's length.
const STRAIGHT_ELBOW_SHARE: f64 = 0.12;
/// The distance of the wrist from the shoulder at which the swivel counts in full, as a share of the arm's length.
const FOLDED_ARM_SHARE: f64 = 0.35;
/// The time before and after a fast exit from the reach during which the soft end is longer, in seconds.
const FAST_EXIT_SECONDS: f64 = 0.3;
/// The opening speed of an elbow that the soft end allows, in radians per second.
const MAX_ELBOW_OPENING_SPEED: f64 = 9.6;

/// The accuracy with which wrists reach their targets.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct WristReach {
    /// The largest distance left between a wrist and its target, in metres.
    pub(crate) residual: f64,
    /// The frame of that distance.
    pub(crate) frame: usize,
    /// The largest distance from a shoulder to a target, in metres.
    pub(crate) farthest: f64,
    /// The arm's length in metres.
    pub(crate) arm: f64,
    /// The number of frames in which the collar bone helped.
    pub(crate) helped: usize,
    /// The length of the soft end as a share of the arm's length: an arm extended further lags behind its target.
    pub(crate) soft: f64,
}

impl WristReach {
    /// Returns the worse of two results.
    pub(crate) fn worse_reach(self, other: Self) -> Self {
        // A default has no arm yet, so that any measured result is worse.
        let worst = if self.arm == 0.0 || other.residual > self.residual {
            other
        } else {
            self
        };
        Self {
            helped: self.helped + other.helped,
            farthest: self.farthest.max(other.farthest),
            soft: self.soft.max(other.soft),
            ..worst
        }
    }

    /// Returns whether the soft end was lengthened, so that reachable targets may be missed.
    pub(crate) fn is_softened(&self) -> bool {
        self.soft > SOFT_REACH_SHARES.0
    }
}

/// Moves the wrist of `side` to `targets`, one per frame in model space. `hands` are the hand's rotations in model
/// space; `None` keeps them. `columns` hold the present state of the hand and the joints above it.
///
/// Frames that are already right stay unchanged. The elbow keeps the source's swivel; if that is undefined (a source
/// arm that is straight, or points away from the arm's new direction) or changes faster than the source's, the elbow
/// moves steadily from the frame before to the frame after. If the wrist leaves the arm's reach fast, the soft end is
/// longer, so that the elbow does not snap. If elbow or bones would still jump though the source's do not, the frames
/// before and after are changed, too. Returns `None` if the skeleton has no such arm, or one of its bones has no
/// length.
pub(crate) fn move_wrist(
    work: &mut WorkingClip,
    side: BodySide,
    columns: &JointColumns,
    targets: &[DVec3],
    hands: Option<&[DQuat]>,
    solver: ArmSolverMethod,
) -> Option<WristReach> {
    let source = ArmSource::read_arm_source(work, side, columns)?;
    let helps: Vec<Option<CollarBoneHelp>> = (0..work.frames)
        .map(|frame| source.help(frame, targets[frame]))
        .collect();
    let [soft, near] = source.soft(targets, &helps, work.rate.frame_time());
    let mut steps = Vec::with_capacity(work.frames);
    for (frame, help) in helps.into_iter().enumerate() {
        // A hand that turns needs its arm solved even where the wrist stays.
        let moves = hands.is_some() || source.source_wrists()[frame] != targets[frame];
        let target = source.kept_off(frame, targets[frame], help, near[frame]);
        steps.push(source.solve_arm_step(frame, target, help, moves, soft[frame], solver)?);
    }
    // Only the analytic solution leaves the swivel of the elbow open.
    if solver == ArmSolverMethod::Analytic {
        swivel::swivel_arm_steps(&mut steps, work.rate.frame_time());
        swivel::ease_elbow_jumps(&source, &mut steps, work.rate.frame_time());
    }
    let mut turns: Vec<ArmJointTurns> = steps
        .iter()
        .enumerate()
        .map(|(frame, step)| source.arm_joint_turns(frame, step, hands.map(|hands| hands[frame])))
        .collect();
    swivel::twist_arm_bones(&source, &steps, &mut turns, work.rate.frame_time());
    for (frame, (step, turns)) in steps.iter().zip(&turns).enumerate() {
        if step.moves {
            source.write_arm_rotations(work, frame, step, turns);
        }
    }
    let softest = soft.into_iter().fold(0.0, f64::max);
    Some(source.measure_wrist_reach(targets, &steps, softest))
}

/// An arm before the change, over all frames in model space.
struct ArmSource<'a> {
    arm: ArmChain,
    columns: &'a JointColumns,
    /// The joints above collar bone, upper arm, forearm and hand.
    above: [Option<usize>; 4],
    pole: ElbowPole,
}

/// The direction of an elbow if nothing else determines it.
enum ElbowPole {
    /// In the space of the upper arm.
    Arm(DVec3),
    /// In model space.
    Model(DVec3),
}

/// The collar bone's help for a target.
#[derive(Clone, Copy)]
struct CollarBoneHelp {
    rotation: DQuat,
    shoulder: DVec3,
}

/// The new position of the arm in one frame.
struct ArmStep {
    moves: bool,
    help: Option<CollarBoneHelp>,
    /// Shoulder, elbow and wrist before the change.
    was: [DVec3; 3],
    /// Shoulder, elbow and wrist after the change.
    is: [DVec3; 3],
    /// The direction in which the elbow naturally bends, at a right angle to the source's line from shoulder to wrist.
    pole: DVec3,
    /// The direction of this elbow from the source's line.
    stands: DVec3,
    /// The direction in which the elbow bends as the arm bends more.
    bends: DVec3,
    /// The rotation from the source's line to the new one.
    carry: DQuat,
    /// The reliability of the source's swivel at the new line, from 0 to 1; 2 for a frame that must not change.
    trust: f64,
}

/// The rotations of the arm's joints in model space in one frame.
struct ArmJointTurns {
    /// The rotations of upper arm and forearm before the change.
    old: [DQuat; 2],
    upper: DQuat,
    forearm: DQuat,
    hand: DQuat,
    /// The direction of the forearm in the space of its joint.
    bone: DVec3,
    /// The rotation of the forearm about its length, in addition to that of its bone, in radians.
    twist: f64,
    /// The reliability of that angle, from 0 to 1.
    reliability: f64,
}

impl<'a> ArmSource<'a> {
    fn read_arm_source(work: &WorkingClip, side: BodySide, columns: &'a JointColumns) -> Option<Self> {
        let arm = work.anatomy.arm_chain(side)?;
        let pole = match work.anatomy.elbow_direction(side) {
            Some(out) => ElbowPole::Arm(out),
            None => {
                // Elbows bend backwards and down if nothing else says where.
                ElbowPole::Model(SignerFrame::from_mean_posture(work).map_or(DVec3::NEG_Y, |f| -f.forward - DVec3::Y))
            }
        };
        let above = |joint| work.skeleton.joint_parent(joint);
        Some(Self {
            columns,
            above: [
                arm.clavicle.and_then(above),
                above(arm.upper),
                above(arm.forearm),
                above(arm.hand),
            ],
            pole,
            arm,
        })
    }

    fn source_wrists(&self) -> &[DVec3] {
        self.columns.joint_positions(self.arm.hand)
    }

    fn arm_points_at(&self, frame: usize) -> [DVec3; 3] {
        [self.arm.upper, self.arm.forearm, self.arm.hand].map(|joint| self.columns.joint_positions(joint)[frame])
    }

    fn joint_rotation_at(&self, joint: usize, frame: usize) -> DQuat {
        self.columns.joint_rotations(joint)[frame]
    }

    /// Returns the rotations from model space to the space of the joint above the arm or its collar bone.
    fn trunks(&self, frames: usize) -> Vec<DQuat> {
        let above = self.arm.clavicle.map_or(self.above[1], |_| self.above[0]);
        let turned = |frame| above.map_or(DQuat::IDENTITY, |joint| self.joint_rotation_at(joint, frame));
        (0..frames).map(|frame| turned(frame).inverse()).collect()
    }

    /// Returns the collar bone's rotation that brings the shoulder to within [`HELP_FROM`] of the arm's length from the
    /// target, or as near as it was to the wrist, if possible; `None` if no help is needed or possible.
    ///
    /// The angle is at most the missing distance divided by the bone's length, even if that is of little use: a collar
    /// bone that points at the target cannot bring the shoulder nearer.
    fn help(&self, frame: usize, target: DVec3) -> Option<CollarBoneHelp> {
        let [shoulder, elbow, wrist] = self.arm_points_at(frame);
        let length = full_arm_length([shoulder, elbow, wrist]);
        // A source that stretches its arm farther than that needs no help to do so.
        let enough = (HELP_FROM * length).max(shoulder.distance(wrist));
        let missing = shoulder.distance(target) - enough;
        if missing <= 0.0 {
            return None;
        }
        let clavicle = self.arm.clavicle?;
        let root = self.columns.joint_positions(clavicle)[frame];
        let (bone, to_target) = (shoulder - root, target - root);
        let (b, w) = (bone.length(), to_target.length());
        // A collar bone without length cannot move the shoulder.
        if b <= 1e-9 * length {
            return None;
        }
        let axis = bone.cross(to_target).try_normalize()?;
        // The law of cosines: at this angle from the target the shoulder is `enough` away from it.
        let cosine = (b * b + w * w - enough * enough) / (2.0 * b * w);
        let missing_angle = bone.angle_between(to_target) - cosine.clamp(-1.0, 1.0).acos();
        let wanted = missing_angle.clamp(0.0, missing / b);
        // The hyperbolic tangent nears the limit smoothly, so that the help never stops with a jerk.
        let turn = DQuat::from_axis_angle(axis, HELP_MOST * (wanted / HELP_MOST).tanh());
        Some(CollarBoneHelp {
            rotation: turn * self.joint_rotation_at(clavicle, frame),
            shoulder: root + turn * bone,
        })
    }

    /// Returns the soft ends at the far and the near limit of the reach for each frame: the least length if no target
    /// leaves the reach; around frames that leave it, the length that keeps the elbow from opening too fast.
    fn soft(&self, targets: &[DVec3], helps: &[Option<CollarBoneHelp>], frame_time: f64) -> [Vec<f64>; 2] {
        let extension = |frame: usize| {
            let points = self.arm_points_at(frame);
            let shoulder = helps[frame].map_or(points[0], |help| help.shoulder);
            shoulder.distance(targets[frame]) / full_arm_length(points)
        };
        let far: Vec<f64> = (0..targets.len()).map(extension).collect();
        let near = far.iter().enumerate().map(|(frame, extension)| {
            let points = self.arm_points_at(frame);
            // Mirrored, so that the near limit is 1 as well and one rule serves both.
            1.0 + folded_arm_length(points) / full_arm_length(points) - extension
        });
        let near: Vec<f64> = near.collect();
        [&far, &near].map(|extensions| softened(extensions, frame_time))
    }

    /// Returns the target; if it is nearer to the shoulder than the wrist of the folded arm plus `soft`, returns a
    /// place in the same direction at a soft distance. `soft` is a share of the arm's length.
    fn kept_off(&self, frame: usize, target: DVec3, help: Option<CollarBoneHelp>, soft: f64) -> DVec3 {
        let points = self.arm_points_at(frame);
        let shoulder = help.map_or(points[0], |help| help.shoulder);
        let soft = soft * full_arm_length(points);
        let (to_target, edge) = (target - shoulder, folded_arm_length(points) + soft);
        let distance = to_target.length();
        if distance >= edge {
            return target;
        }
        // The exponential meets the unchanged distances at the edge, with the same slope.
        let kept = edge - soft + soft * ((distance - edge) / soft).exp();
        shoulder + to_target.normalize_or(shoulder_wrist_direction(points)) * kept
    }

    fn solve_arm_step(
        &self,
        frame: usize,
        target: DVec3,
        help: Option<CollarBoneHelp>,
        moves: bool,
        soft: f64,
        solver: ArmSolverMethod,
    ) -> Option<ArmStep> {
        let was = self.arm_points_at(frame);
        let pole = match self.pole {
            ElbowPole::Arm(out) => self.joint_rotation_at(self.arm.upper, frame) * out,
            ElbowPole::Model(direction) => direction,
        };
        let old = shoulder_wrist_direction(was);
        let pole_across = pole.reject_from_normalized(old).try_normalize();
        let across = pole_across.unwrap_or_else(|| old.any_orthonormal_vector());
        let stands = elbow_bend_direction(was, across, 1.0);
        // A frame that is already right keeps its posture, and its neighbours' angles follow it.
        if !moves {
            return Some(ArmStep {
                moves,
                help: None,
                was,
                is: was,
                pole: across,
                stands,
                bends: stands,
                carry: DQuat::IDENTITY,
                trust: 2.0,
            });
        }
        let shift = help.map_or(DVec3::ZERO, |help| help.shoulder - was[0]);
        let start = was.map(|at| at + shift);
        let pole = Some(pole);
        let solved = two_bone(start, target, &TwoBoneOptions { soft, pole }).ok()?;
        let is = match solver {
            ArmSolverMethod::Analytic => [start[0], solved.middle, solved.end],
            ArmSolverMethod::Fabrik => {
                let options = FabrikOptions {
                    pole,
                    ..FabrikOptions::default()
                };
                let points = solve_fabrik(&start, target, &options).ok()?.points;
                [start[0], points[1], points[2]]
            }
        };
        // The natural bend counts only as far as the elbow stands out more than in the source.
        let grown = (off_line(is) - off_line(was)) / (STRAIGHT_ELBOW_SHARE * full_arm_length(was));
        // A pole in model space is a guess, so that a straight source arm says little about the swivel.
        let pole_trust = match self.pole {
            ElbowPole::Arm(_) => 1.0,
            ElbowPole::Model(_) => smooth_step(off_line(was) / (STRAIGHT_ELBOW_SHARE * full_arm_length(was))),
        };
        Some(ArmStep {
            moves,
            help,
            was,
            is,
            pole: across,
            stands,
            bends: elbow_bend_direction(was, across, grown.clamp(0.0, 1.0)),
            carry: least_turn(old, shoulder_wrist_direction(is)),
            trust: pole_trust * swivel_weight(was, is),
        })
    }

    /// Returns the rotations of the arm's joints that put its bones in the positions of the step.
    fn arm_joint_turns(&self, frame: usize, step: &ArmStep, hand: Option<DQuat>) -> ArmJointTurns {
        let [upper, forearm, held] =
            [self.arm.upper, self.arm.forearm, self.arm.hand].map(|joint| self.joint_rotation_at(joint, frame));
        let hand = hand.unwrap_or(held).normalize();
        let carry_turn = step.carry;
        let bones = |points: [DVec3; 3]| [points[1] - points[0], points[2] - points[1]];
        let ([first, second], [to, on]) = (bones(step.was), bones(step.is));
        // `carry` brings the bone near its new direction with the swivel; the shortest turn does the rest.
        let turned = |from: DVec3, to: DVec3| least_turn((carry_turn * from).normalize(), to.normalize()) * carry_turn;
        let straight = (turned(second, on) * forearm).normalize();
        let bone = (forearm.inverse() * second).normalize();
        // The forearm takes up any change of the hand's twist, so that the wrist keeps the source's.
        let (was, _) = twist_about(forearm.inverse() * held, bone);
        let (now, reliability) = twist_about(straight.inverse() * hand, bone);
        ArmJointTurns {
            old: [upper, forearm],
            upper: (turned(first, to) * upper).normalize(),
            forearm: straight,
            hand,
            bone,
            twist: now - was,
            reliability,
        }
    }

    /// Sets the local rotations of the arm's joints, so that they have the given rotations in model space.
    fn write_arm_rotations(&self, work: &mut WorkingClip, frame: usize, step: &ArmStep, turns: &ArmJointTurns) {
        let above = |n: usize| self.above[n].map_or(DQuat::IDENTITY, |joint| self.joint_rotation_at(joint, frame));
        let change = |joint: usize, now: DQuat| now * self.joint_rotation_at(joint, frame).inverse();
        let mut set = |joint: usize, above: DQuat, now: DQuat| {
            work.channels[joint].rotations[frame] = (above.inverse() * now).normalize();
        };
        // The columns hold the old rotation of the joint above; `carried` is what has changed there.
        let mut carried = DQuat::IDENTITY;
        if let (Some(help), Some(clavicle)) = (step.help, self.arm.clavicle) {
            set(clavicle, above(0), help.rotation);
            carried = change(clavicle, help.rotation);
        }
        set(self.arm.upper, carried * above(1), turns.upper);
        let carried = change(self.arm.upper, turns.upper);
        let forearm = turns.forearm * DQuat::from_axis_angle(turns.bone, turns.twist);
        set(self.arm.forearm, carried * above(2), forearm);
        let carried = change(self.arm.forearm, forearm);
        set(self.arm.hand, carried * above(3), turns.hand);
    }

    fn measure_wrist_reach(&self, targets: &[DVec3], steps: &[ArmStep], soft: f64) -> WristReach {
        let mut reach = WristReach {
            soft,
            ..WristReach::default()
        };
        for (frame, (target, step)) in targets.iter().zip(steps).enumerate() {
            reach.arm = full_arm_length(step.was);
            reach.farthest = reach.farthest.max(step.was[0].distance(*target));
            reach.helped += usize::from(step.help.is_some());
            let residual = step.is[2].distance(*target);
            if residual > reach.residual {
                (reach.residual, reach.frame) = (residual, frame);
            }
        }
        reach
    }
}

/// Returns the soft end at each frame for arms with these extensions; both are shares of the arm's length.
///
/// The elbow of an arm that is extended to `1 - s` opens by `√(2/s)` radians for each arm length that the wrist moves
/// outwards.
fn softened(extensions: &[f64], frame_time: f64) -> Vec<f64> {
    let mut soft = vec![SOFT_REACH_SHARES.0; extensions.len()];
    if extensions
        .iter()
        .all(|&extension| extension <= 1.0 - SOFT_REACH_SHARES.0)
    {
        return soft;
    }
    let near = (FAST_EXIT_SECONDS / frame_time).round() as usize;
    for frame in 1..extensions.len() {
        let [before, now] = [extensions[frame - 1], extensions[frame]];
        // Only a step near the limit or across it can snap the elbow.
        if before.max(now) < 1.0 - SOFT_REACH_SHARES.1 || before.min(now) > 1.0 + SOFT_REACH_SHARES.1 {
            continue;
        }
        let speed = (now - before).abs() / frame_time;
        // The elbow's speed of `√(2/s)` times the wrist's, solved for `s`.
        let wanted = (2.0 * (speed / MAX_ELBOW_OPENING_SPEED).powi(2)).clamp(SOFT_REACH_SHARES.0, SOFT_REACH_SHARES.1);
        for at in frame.saturating_sub(near)..(frame + near).min(soft.len()) {
            let away = at.abs_diff(frame) as f64 / near.max(1) as f64;
            // In full for the first half of the time, then smoothly down to the least.
            let share = smooth_step(2.0 - 2.0 * away);
            soft[at] = soft[at].max(SOFT_REACH_SHARES.0 + (wanted - SOFT_REACH_SHARES.0) * share);
        }
    }
    soft
}

/// Returns the distance from shoulder to wrist of the folded arm.
fn folded_arm_length([shoulder, elbow, wrist]: [DVec3; 3]) -> f64 {
    (shoulder.distance(elbow) - elbow.distance(wrist)).abs()
}

fn full_arm_length([shoulder, elbow, wrist]: [DVec3; 3]) -> f64 {
    shoulder.distance(elbow) + elbow.distance(wrist)
}

/// Returns the unit vector from shoulder to wrist; along the upper arm if the two coincide.
fn shoulder_wrist_direction([shoulder, elbow, wrist]: [DVec3; 3]) -> DVec3 {
    let line = wrist - shoulder;
    if line.length() > 1e-9 * full_arm_length([shoulder, elbow, wrist]) {
        line.normalize()
    } else {
        (elbow - shoulder).normalize_or(DVec3::X)
    }
}

/// Returns the shortest rotation from one unit vector to another.
fn least_turn(from: DVec3, to: DVec3) -> DQuat {
    DQuat::from_rotation_arc(from, to).normalize()
}

/// Returns the angle of the rotation `q` about the unit vector `axis` (swing-twist), and its reliability: 0 for a half
/// turn about an axis at a right angle to it.
fn twist_about(q: DQuat, axis: DVec3) -> (f64, f64) {
    let along = axis.dot(q.xyz());
    (2.0 * along.atan2(q.w), along * along + q.w * q.w)
}

/// Returns the direction of the elbow from the line from shoulder to wrist. As the arm becomes straight, so that this
/// direction becomes undefined, the share `grown` of the natural bend `pole` counts more and more.
fn elbow_bend_direction(arm: [DVec3; 3], pole: DVec3, grown: f64) -> DVec3 {
    let clear = STRAIGHT_ELBOW_SHARE * full_arm_length(arm);
    let elbow_offset = (arm[1] - arm[0]).reject_from_normalized(shoulder_wrist_direction(arm));
    let mixed = elbow_offset + pole * (clear * (1.0 - smooth_step(elbow_offset.length() / clear)) * grown);
    mixed
        .try_normalize()
        .filter(|_| mixed.length() > 1e-9 * clear)
        .unwrap_or(pole)
}

/// Returns the distance of the elbow from the line from shoulder to wrist.
fn off_line(arm: [DVec3; 3]) -> f64 {
    (arm[1] - arm[0])
        .reject_from_normalized(shoulder_wrist_direction(arm))
        .length()
}

/// Returns the weight of the source's swivel in the arm's new direction: 0 for an arm that is folded on the shoulder,
/// or whose old direction is opposite to the new one.
fn swivel_weight(was: [DVec3; 3], is: [DVec3; 3]) -> f64 {
    let folded = smooth_step(was[0].distance(was[2]) / (FOLDED_ARM_SHARE * full_arm_length(was)));
    // In full up to 120 degrees between the two lines, nothing at 180.
    folded * smooth_step((1.0 + shoulder_wrist_direction(was).dot(shoulder_wrist_direction(is))) / 0.5)
}

/// Moves wrist and hand of an idle arm to their targets, with a hanging elbow: down, and a little to the arm's own
/// side.
pub(crate) fn raise_arm(
    work: &mut WorkingClip,
    side: BodySide,
    targets: &[DVec3],
    hands: &[DQuat],
    outside: DVec3,
) -> Option<WristReach> {
    let arm = work.anatomy.arm_chain(side)?;
    let columns = JointColumns::joint_columns_of(work, [arm.hand]);
    // The line about which the elbow swings is known only with the wrist in its place.
    move_wrist(work, side, &columns, targets, Some(hands), ArmSolverMethod::Analytic)?;
    let columns = JointColumns::joint_columns_of(work, [arm.hand]);
    let [shoulders, elbows, wrists] = [arm.upper, arm.forearm, arm.hand].map(|j| columns.joint_positions(j));
    let wanted = DVec3::NEG_Y + outside * 0.35;
    for frame in 0..work.frames {
        let Some(line) = (wrists[frame] - shoulders[frame]).try_normalize() else {
            continue;
        };
        let now = (elbows[frame] - shoulders[frame]).reject_from_normalized(line);
        let then = wanted.reject_from_normalized(line);
        // An elbow on the line, or a line that hangs itself, leaves no angle to correct.
        if now.length() < 1e-4 || then.length() < 1e-2 {
            continue;
        }
        let angle = line.dot(now.cross(then)).atan2(now.dot(then));
        let model = DQuat::from_axis_angle(line, angle) * columns.joint_rotations(arm.upper)[frame];
        let above = match work.skeleton.joint_parent(arm.upper) {
            Some(parent) => columns.joint_rotations(parent)[frame],
            None => DQuat::IDENTITY,
        };
        work.channels[arm.upper].rotations[frame] = (above.inverse() * model).normalize();
    }
    // The swing of the upper arm has taken the wrist along; a second pass brings it back.
    let columns = JointColumns::joint_columns_of(work, [arm.hand]);
    move_wrist(work, side, &columns, targets, Some(hands), ArmSolverMethod::Analytic)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_soft_zone_is_longer_if_the_wrist_leaves_the_reach_fast() {
        let within = softened(&[0.5; 50], 1.0 / 120.0);
        assert_eq!(within, vec![SOFT_REACH_SHARES.0; 50]);
        let leaving = |per_frame: f64| {
            let distances = (0..300).map(|n| 1.0 + per_frame * (f64::from(n) - 150.0));
            softened(&distances.collect::<Vec<f64>>(), 1.0 / 120.0)
        };
        let (slow, fast) = (leaving(1e-4), leaving(0.02));
        assert!(slow.iter().all(|soft| (soft - SOFT_REACH_SHARES.0).abs() < 1e-9));
        assert_eq!((fast[0], fast[299]), (SOFT_REACH_SHARES.0, SOFT_REACH_SHARES.0));
        assert!((fast[150] - SOFT_REACH_SHARES.1).abs() < 1e-9);
    }
}
