//! Moving wrists: the arm's posture that brings each wrist where it should be.

use chereme_motion::Side;
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::ik::{self, ReachOptions, WristTarget, reach_wrist};

use crate::recipe::Solver;
use crate::work::{Columns, Work};

/// The share of the arm's length beyond which the collar bone helps.
pub(crate) const HELP_FROM: f64 = 0.9;

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
        let worst = if self.arm == 0.0 || other.residual > self.residual {
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

/// Brings the wrist of `side` to `targets`, one a frame in model space, the hand turned in the world
/// as `hands` says, or as it was.
///
/// What is where it should be is not touched. Nothing where the skeleton has no such arm, or one of
/// its bones has no length.
pub(crate) fn move_wrist(
    work: &mut Work,
    side: Side,
    targets: &[DVec3],
    hands: Option<&[DQuat]>,
    solver: Solver,
) -> Option<Reach> {
    let arm = work.anatomy.arm(side)?;
    let (skeleton, anatomy) = (work.skeleton.clone(), work.anatomy.clone());
    let columns = Columns::of(work, [arm.hand]);
    let (places, turned) = (columns.positions(arm.hand), columns.rotations(arm.hand));
    let (shoulders, elbows) = (columns.positions(arm.upper), columns.positions(arm.forearm));
    let chain: Vec<usize> = skeleton.ancestors(arm.hand).collect();
    let top = arm.clavicle.unwrap_or(arm.upper);
    let moving: Vec<usize> = chain
        .iter()
        .copied()
        .take_while(|&j| j != top)
        .chain([top])
        .collect();
    let options = ReachOptions {
        solver: match solver {
            Solver::Analytic => ik::Solver::Analytic,
            Solver::Fabrik => ik::Solver::Fabrik,
        },
        clavicle: Some(HELP_FROM),
        ..ReachOptions::default()
    };
    let mut reach = Reach::default();
    let mut pose = work.pose(0);
    for frame in 0..work.frames {
        let (wrist, shoulder, elbow) = (places[frame], shoulders[frame], elbows[frame]);
        let target = WristTarget {
            position: targets[frame],
            rotation: hands
                .map_or(turned[frame], |hands| hands[frame])
                .normalize(),
        };
        reach.arm = shoulder.distance(elbow) + elbow.distance(wrist);
        reach.farthest = reach.farthest.max(shoulder.distance(target.position));
        if wrist == target.position && hands.is_none() {
            continue;
        }
        for &joint in &chain {
            pose.rotations[joint] = work.channels[joint].rotations[frame];
            pose.translations[joint] = work.translation(joint, frame);
        }
        let done = reach_wrist(&anatomy, &skeleton, side, &target, &options, &mut pose).ok()?;
        reach.helped += usize::from(done.clavicle_turn > 0.0);
        if done.residual_m > reach.residual {
            (reach.residual, reach.frame) = (done.residual_m, frame);
        }
        for &joint in &moving {
            work.channels[joint].rotations[frame] = pose.rotations[joint];
        }
    }
    Some(reach)
}

/// Brings wrist and hand of an arm that does nothing yet to where they should be, with the elbow
/// hanging: down, and a little to the arm's own side.
pub(crate) fn raise_arm(
    work: &mut Work,
    side: Side,
    targets: &[DVec3],
    hands: &[DQuat],
    outside: DVec3,
) -> Option<Reach> {
    move_wrist(work, side, targets, Some(hands), Solver::Analytic)?;
    let arm = work.anatomy.arm(side)?;
    let columns = Columns::of(work, [arm.hand]);
    let [shoulders, elbows, wrists] =
        [arm.upper, arm.forearm, arm.hand].map(|j| columns.positions(j));
    let wanted = DVec3::NEG_Y + outside * 0.35;
    for frame in 0..work.frames {
        let Some(line) = (wrists[frame] - shoulders[frame]).try_normalize() else {
            continue;
        };
        let now = (elbows[frame] - shoulders[frame]).reject_from_normalized(line);
        let then = wanted.reject_from_normalized(line);
        if now.length() < 1e-4 || then.length() < 1e-2 {
            continue;
        }
        let angle = line.dot(now.cross(then)).atan2(now.dot(then));
        let model = DQuat::from_axis_angle(line, angle) * columns.rotations(arm.upper)[frame];
        let above = match work.skeleton.parent(arm.upper) {
            Some(parent) => columns.rotations(parent)[frame],
            None => DQuat::IDENTITY,
        };
        work.channels[arm.upper].rotations[frame] = (above.inverse() * model).normalize();
    }
    move_wrist(work, side, targets, Some(hands), Solver::Analytic)
}
