//! Moving wrists: the arm's posture that brings each wrist where it should be.

use chereme_motion::Side;
use chereme_motion::glam::{DQuat, DVec3};

use crate::recipe::Solver;
use crate::work::{Columns, Work};

/// The share of the arm's length beyond which the collar bone helps.
pub(crate) const HELP_FROM: f64 = 0.95;
/// The share of the arm's length from which a target out of reach is approached softly.
const SOFT_FROM: f64 = 0.98;
/// The most that the collar bone turns to help, in radians.
const MOST_HELP: f64 = 0.26;

/// How well wrists came where they should.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Reach {
    /// The largest distance left between a wrist and its target, in metres.
    pub(crate) residual: f64,
    /// The frame of that distance.
    pub(crate) frame: usize,
    /// The largest distance from a shoulder to a target, in metres.
    pub(crate) farthest: f64,
    /// The arm's length in metres.
    pub(crate) arm: f64,
    /// In how many frames the collar bone helped.
    pub(crate) helped: usize,
}

impl Reach {
    /// Returns the worse of both.
    pub(crate) fn worse(self, other: Self) -> Self {
        let worst = if other.residual > self.residual {
            other
        } else {
            self
        };
        Self {
            helped: self.helped + other.helped,
            farthest: self.farthest.max(other.farthest),
            ..worst
        }
    }
}

/// The joints of an arm that the evaluator moves.
struct Arm {
    clavicle: Option<usize>,
    upper: usize,
    forearm: usize,
    hand: usize,
}

/// Brings the wrist of `side` to `targets`, one a frame in model space, the hand turned in the world
/// as `hands` says, or as it was.
///
/// The elbow keeps the turn about the line from shoulder to wrist that it had (the shortest turn of
/// that line carries it along), the forearm's twist follows the hand so that the wrist joint twists
/// as it did; all of it depends on source and target alone and can be taken back exactly.
/// Nothing where the skeleton has no such arm.
pub(crate) fn move_wrist(
    work: &mut Work,
    side: Side,
    targets: &[DVec3],
    hands: Option<&[DQuat]>,
    solver: Solver,
) -> Option<Reach> {
    let chain = work.anatomy.arm(side)?;
    let arm = Arm {
        clavicle: chain
            .clavicle
            .filter(|&c| work.skeleton.parent(c).is_some()),
        upper: chain.upper,
        forearm: chain.forearm,
        hand: chain.hand,
    };
    let columns = Columns::of(work, [arm.hand]);
    let mut reach = Reach::default();
    let mut side_way = DVec3::ZERO;
    for frame in 0..work.frames {
        solve(
            work,
            &columns,
            &arm,
            frame,
            Goal {
                target: targets[frame],
                hand: hands.map(|hands| hands[frame]),
                solver,
            },
            &mut side_way,
            &mut reach,
        );
    }
    Some(reach)
}

struct Goal {
    target: DVec3,
    hand: Option<DQuat>,
    solver: Solver,
}

fn solve(
    work: &mut Work,
    columns: &Columns,
    arm: &Arm,
    frame: usize,
    goal: Goal,
    side_way: &mut DVec3,
    reach: &mut Reach,
) {
    let at = |joint: usize| columns.positions(joint)[frame];
    let turned = |joint: usize| columns.rotations(joint)[frame];
    let (mut shoulder, mut elbow, mut wrist) = (at(arm.upper), at(arm.forearm), at(arm.hand));
    let hand = goal.hand.unwrap_or(turned(arm.hand));
    if wrist == goal.target && goal.hand.is_none() {
        return;
    }
    let (a, b) = ((elbow - shoulder).length(), (wrist - elbow).length());
    let before = (wrist - shoulder).length();
    reach.arm = a + b;
    reach.farthest = reach.farthest.max((goal.target - shoulder).length());

    let mut carried = DQuat::IDENTITY;
    if let Some(clavicle) = arm.clavicle
        && let Some(help) = help(
            at(clavicle),
            shoulder,
            goal.target,
            (HELP_FROM * (a + b)).max(before),
        )
    {
        let root = at(clavicle);
        (shoulder, elbow, wrist) = (
            root + help * (shoulder - root),
            root + help * (elbow - root),
            root + help * (wrist - root),
        );
        carried = help;
        turn_in_model(work, columns, clavicle, frame, help);
        reach.helped += 1;
    }
    let (upper_turn, fore_turn) = match goal.solver {
        Solver::Analytic => two_bones(shoulder, elbow, wrist, goal.target, side_way),
        Solver::Fabrik => fabrik(shoulder, elbow, wrist, goal.target),
    };
    let elbow_now = shoulder + upper_turn * (elbow - shoulder);
    let wrist_now = elbow_now + fore_turn * (wrist - elbow);
    let left = (wrist_now - goal.target).length();
    if left > reach.residual {
        (reach.residual, reach.frame) = (left, frame);
    }

    let upper = (upper_turn * carried * turned(arm.upper)).normalize();
    set_local(
        work,
        arm.upper,
        frame,
        carried * above(work, columns, arm.upper, frame),
        upper,
    );
    let fore_parent =
        upper * (turned(arm.upper).inverse() * above(work, columns, arm.forearm, frame));
    let fore = (fore_turn * carried * turned(arm.forearm)).normalize();
    let bone =
        (turned(arm.forearm).inverse() * (at(arm.hand) - at(arm.forearm))).normalize_or_zero();
    let was = turned(arm.forearm).inverse() * turned(arm.hand);
    let twist = twist_about(bone, fore.inverse() * hand) - twist_about(bone, was);
    let fore = fore * DQuat::from_scaled_axis(bone * wrapped(twist));
    set_local(work, arm.forearm, frame, fore_parent, fore);
    let hand_parent =
        fore * (turned(arm.forearm).inverse() * above(work, columns, arm.hand, frame));
    set_local(work, arm.hand, frame, hand_parent, hand);
}

/// Returns how the parent of `joint` was turned before anything changed.
fn above(work: &Work, columns: &Columns, joint: usize, frame: usize) -> DQuat {
    match work.skeleton.parent(joint) {
        Some(parent) => columns.rotations(parent)[frame],
        None => DQuat::IDENTITY,
    }
}

fn set_local(work: &mut Work, joint: usize, frame: usize, parent: DQuat, model: DQuat) {
    work.channels[joint].rotations[frame] = (parent.inverse() * model).normalize();
}

fn turn_in_model(work: &mut Work, columns: &Columns, joint: usize, frame: usize, turn: DQuat) {
    let parent = above(work, columns, joint, frame);
    set_local(
        work,
        joint,
        frame,
        parent,
        turn * columns.rotations(joint)[frame],
    );
}

/// Returns the turn of the collar bone that brings the shoulder nearer to a target farther than
/// `free` away; it grows smoothly with what is missing and never beyond [`MOST_HELP`].
fn help(root: DVec3, shoulder: DVec3, target: DVec3, free: f64) -> Option<DQuat> {
    let missing = (target - shoulder).length() - free;
    let bone = shoulder - root;
    if missing <= 0.0 || bone.length() < 1e-6 {
        return None;
    }
    let axis = bone.cross(target - shoulder).try_normalize()?;
    let angle = MOST_HELP * (1.0 - (-missing / (bone.length() * MOST_HELP)).exp());
    Some(DQuat::from_axis_angle(axis, angle))
}

/// Returns the turns of upper arm and forearm in model space that bring the wrist to the target, or
/// as near as bones of their lengths go.
///
/// The line from shoulder to wrist is turned the shortest way; then the elbow opens or closes in the
/// plane it was in. `plane` is the normal of the plane in the frame before, for straight arms.
fn two_bones(
    shoulder: DVec3,
    elbow: DVec3,
    wrist: DVec3,
    target: DVec3,
    plane: &mut DVec3,
) -> (DQuat, DQuat) {
    let (a, b) = ((elbow - shoulder).length(), (wrist - elbow).length());
    let (old, new) = (wrist - shoulder, target - shoulder);
    let (Some(from), Some(to)) = (old.try_normalize(), new.try_normalize()) else {
        return (DQuat::IDENTITY, DQuat::IDENTITY);
    };
    if a < 1e-9 || b < 1e-9 {
        let swing = DQuat::from_rotation_arc(from, to);
        return (swing, swing);
    }
    let swing = DQuat::from_rotation_arc(from, to);
    let reach = soft(new.length(), old.length(), a + b).max((a - b).abs());
    let normal = to.cross(swing * (elbow - shoulder));
    let normal = if normal.length() > 1e-6 * a {
        normal.normalize()
    } else if plane.length() > 0.5 {
        plane
            .reject_from(to)
            .normalize_or(to.any_orthonormal_vector())
    } else {
        // A straight arm with no past bends as elbows do: the point of it down and back.
        to.cross(DVec3::new(0.0, -1.0, -0.3))
            .normalize_or(to.any_orthonormal_vector())
    };
    *plane = normal;
    let corner = |near: f64, far: f64, d: f64| {
        ((near * near + d * d - far * far) / (2.0 * near * d))
            .clamp(-1.0, 1.0)
            .acos()
    };
    let was = old.length();
    let open = corner(a, b, reach) - corner(a, b, was);
    let close = corner(b, a, reach) - corner(b, a, was);
    (
        DQuat::from_axis_angle(normal, open) * swing,
        DQuat::from_axis_angle(normal, -close) * swing,
    )
}

/// Returns how far the wrist goes for a target at `distance`: as far as asked up to a limit, which is
/// at least where the source went, then ever less far, never straighter than straight.
fn soft(distance: f64, source: f64, arm: f64) -> f64 {
    let limit = (SOFT_FROM * arm).max(source).min(arm);
    let room = arm - limit;
    if distance <= limit || room < 1e-12 {
        return distance.min(arm);
    }
    limit + room * (1.0 - (-(distance - limit) / room).exp())
}

/// Returns the turns that FABRIK finds (Aristidou & Lasenby 2011): backward and forward passes until
/// the wrist is within a micrometre of the target, at most a hundred times.
fn fabrik(shoulder: DVec3, elbow: DVec3, wrist: DVec3, target: DVec3) -> (DQuat, DQuat) {
    let (a, b) = ((elbow - shoulder).length(), (wrist - elbow).length());
    let to = (target - shoulder).normalize_or_zero();
    let (mut e, mut w) = (elbow, wrist);
    if (target - shoulder).length() >= a + b {
        (e, w) = (shoulder + to * a, shoulder + to * (a + b));
    } else {
        // A chain on the line to its target never bends: set it aside by a hair.
        if (e - shoulder).cross(target - shoulder).length() < 1e-9 {
            e += to.any_orthonormal_vector() * (1e-4 * a);
        }
        for _ in 0..100 {
            if (w - target).length() < 1e-6 {
                break;
            }
            let back = target + (e - target).normalize_or(-to) * b;
            e = shoulder + (back - shoulder).normalize_or(to) * a;
            w = e + (target - e).normalize_or(to) * b;
        }
    }
    let arc = |from: DVec3, onto: DVec3| match (from.try_normalize(), onto.try_normalize()) {
        (Some(from), Some(onto)) => DQuat::from_rotation_arc(from, onto),
        _ => DQuat::IDENTITY,
    };
    (
        arc(elbow - shoulder, e - shoulder),
        arc(wrist - elbow, w - e),
    )
}

/// Returns the angle of the part of `turn` that goes about the unit vector `axis`.
fn twist_about(axis: DVec3, turn: DQuat) -> f64 {
    let along = DVec3::new(turn.x, turn.y, turn.z).dot(axis);
    if along.hypot(turn.w) < 1e-6 {
        return 0.0;
    }
    2.0 * along.atan2(turn.w)
}

fn wrapped(angle: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    angle - turn * (angle / turn).round()
}
