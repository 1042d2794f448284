//! Removes the remaining intersections of the solved arm with the trunk.
//!
//! The plane of the arm is chosen at intervals and interpolated, and deviations of the hand are spread
//! over time; either may lead an elbow or a hand into the trunk for a moment. There the arm's plane is
//! turned farther, or the hand pushed farther out, as well as shortly before and after, until the arm is
//! clear.

use std::sync::LazyLock;

use chereme_motion::glam::{DQuat, DVec3};

use super::notation_arm::ArmBearing;
use super::notation_solve::{ArmFrame, ArmSolver, SolvedArmFrame, ease_push_vectors};
use super::notation_stage::HandOutline;
use super::notation_track::HandGoalFrames;
use super::notation_tuned::tuned;
use super::outlines::OutlineTrack;

/// The number of rounds of this correction.
const PUSH_OUT_ROUNDS: usize = 6;
/// Smallest depth in the trunk that is corrected, in metres.
const MIN_TRUNK_DEPTH_M: f64 = 1e-3;
/// Step by which a hand is pushed out in one direction, in metres.
const PUSH_OUT_STEP_M: f64 = 0.005;
/// The largest number of such steps.
const MAX_PUSH_OUT_STEPS: u32 = 60;
/// Candidate turns of the arm's plane (degrees) with their costs, the cheapest first: inwards, before the
/// trunk, costs four times as much.
static PUSH_OUT_TURNS: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| {
    let steps = (1..=30).map(|n| 4.0 * f64::from(n));
    let mut all: Vec<(f64, f64)> = steps.flat_map(|by| [(by, by), (-by, 4.0 * by)]).collect();
    all.sort_by(|a, b| a.1.total_cmp(&b.1));
    all
});

impl ArmSolver<'_> {
    /// Solves the arm for all frames, clear of the trunk: returns the settings and the resulting posture
    /// of each frame.
    pub(crate) fn over_time(&self, wanted: &HandGoalFrames<'_>, rate: f64) -> (Vec<ArmFrame>, Vec<SolvedArmFrame>) {
        let mut bearings = self.arm_bearings(wanted, rate);
        let mut rows = self.lay_arm_frames(wanted, &bearings, rate);
        let mut settled_frames = self.settle_arm_frames(&rows, &wanted.outlines);
        let near = ((tuned().solve.around * rate).ceil() as usize).max(1);
        let mut more = vec![DVec3::ZERO; rows.len()];
        for _ in 0..PUSH_OUT_ROUNDS {
            let settled_rows = settled_frames.iter().zip(&rows);
            let turns: Vec<DVec3> = settled_rows
                .map(|(got, row)| DVec3::X * self.turned_out(got, row.bearing))
                .collect();
            let mut outs: Vec<DVec3> = settled_frames.iter().map(|got| if_deep(got.within)).collect();
            in_one_direction(&mut outs, &self.directions_out(), |frame, by| {
                let SolvedArmFrame { posed, rotation, .. } = settled_frames[frame];
                let out = self.offset_hand_out(posed.wrist + by, rotation, wanted.outlines.outlines_at_frame(frame));
                out.0 == DVec3::ZERO
            });
            for ((out, got), turn) in outs.iter_mut().zip(&settled_frames).zip(&turns) {
                if *out == DVec3::ZERO && *turn == DVec3::ZERO {
                    // Pushes the hand out so that its elbow leaves the trunk.
                    *out = if_deep(self.stage.torso.offset_out_of_trunk(got.posed.elbow, 0.0));
                }
            }
            let [turned, pushed] = [&turns, &outs].map(|all| all.iter().any(|by| *by != DVec3::ZERO));
            if turned {
                for ((bearing, _), by) in bearings.iter_mut().zip(ease_push_vectors(&turns, near)) {
                    bearing.plane += by.x;
                }
                rows = self.lay_arm_frames(wanted, &bearings, rate);
            }
            if !turned && !pushed {
                break;
            }
            let outs = ease_push_vectors(&outs, near);
            for (more, by) in more.iter_mut().zip(&outs) {
                *more += *by;
            }
            // Solving again discards all earlier pushes.
            let pushes = if turned { &more } else { &outs };
            for (row, by) in rows.iter_mut().zip(pushes).filter(|(_, by)| **by != DVec3::ZERO) {
                row.push += *by;
                row.kept = false;
            }
            settled_frames = self.settle_arm_frames(&rows, &wanted.outlines);
        }
        (rows, settled_frames)
    }

    /// Corrects rotations after time was stretched: moves the arm out of the trunk and wrists back within
    /// their limits, frame by frame.
    pub(crate) fn clear_arm_from_trunk<'o>(
        &self,
        frames: &mut [[DQuat; 4]],
        outlines: impl Fn(usize) -> [&'o HandOutline; 2],
        rate: f64,
    ) {
        let rig = self.solver_arm_rig();
        let torso = &self.stage.torso;
        let near = ((tuned().solve.around * rate).ceil() as usize).max(1);
        for _ in 0..PUSH_OUT_ROUNDS {
            let amiss = frames.iter().enumerate().map(|(frame, turned)| {
                let (posed, hand) = rig.posture_from_rotations(*turned);
                let out = if_deep(self.offset_hand_out(posed.wrist, hand, outlines(frame)).0);
                let tried = |by: f64| rig.move_posed_wrist(&posed, posed.wrist, by.to_radians()).elbow;
                let deep = torso.offset_aside(posed.elbow, -0.003).length() > MIN_TRUNK_DEPTH_M;
                let turn_candidates = (1..30).map(|n| 4.0 * f64::from(n)).filter(|_| deep);
                let turn = turn_candidates
                    .into_iter()
                    .find(|by| torso.offset_aside(tried(*by), 0.0) == DVec3::ZERO);
                (out, DVec3::X * turn.unwrap_or(0.0).to_radians())
            });
            let (mut outs, turns): (Vec<DVec3>, Vec<DVec3>) = amiss.unzip();
            if [&outs, &turns]
                .iter()
                .all(|all| all.iter().all(|by| *by == DVec3::ZERO))
            {
                break;
            }
            in_one_direction(&mut outs, &self.directions_out(), |frame, by| {
                let (posed, hand) = rig.posture_from_rotations(frames[frame]);
                self.offset_hand_out(posed.wrist + by, hand, outlines(frame)).0 == DVec3::ZERO
            });
            let (outs, turns) = (ease_push_vectors(&outs, near), ease_push_vectors(&turns, near));
            for ((turned, out), turn) in frames.iter_mut().zip(outs).zip(turns) {
                if out == DVec3::ZERO && turn == DVec3::ZERO {
                    continue;
                }
                let (posed, hand) = rig.posture_from_rotations(*turned);
                let posed = rig.move_posed_wrist(&posed, posed.wrist + out, turn.x);
                *turned = rig.arm_joint_rotations(&posed, self.within_range(&posed, hand));
            }
        }
    }

    /// Returns the directions in which a hand may leave the trunk: forward, to its own side, and between.
    fn directions_out(&self) -> [DVec3; 3] {
        let forward = self.stage.forward;
        let outside = self.stage.left * self.hand.side.side_sign();
        [forward, (forward + outside).normalize(), outside]
    }

    /// Returns the resulting posture of the arm in each frame.
    fn settle_arm_frames(&self, rows: &[ArmFrame], outlines: &OutlineTrack<'_>) -> Vec<SolvedArmFrame> {
        let mut all: Vec<SolvedArmFrame> = Vec::with_capacity(rows.len());
        for (frame, row) in rows.iter().enumerate() {
            let same = frame > 0 && rows[frame - 1] == *row;
            let next = match all.last() {
                Some(&last) if same => last,
                last => self.settle_arm_frame(row, outlines.outlines_at_frame(frame), last),
            };
            all.push(next);
        }
        all
    }

    /// Returns the smallest rotation (rad) of the arm's plane that moves the elbow out of the trunk, preferably
    /// outwards; if none does, the one with the least depth.
    fn turned_out(&self, got: &SolvedArmFrame, bearing: ArmBearing) -> f64 {
        let torso = &self.stage.torso;
        let elbow_depth = torso.offset_aside(got.posed.elbow, -0.003).length();
        if elbow_depth < MIN_TRUNK_DEPTH_M {
            return 0.0;
        }
        let mut best = (elbow_depth + 0.1 * tuned().push_out.near, 0.0);
        for (by, cost) in PUSH_OUT_TURNS.iter() {
            let plane = bearing.plane + by.to_radians();
            let tried = ArmBearing { plane, ..bearing };
            let posed = self
                .solver_arm_rig()
                .reach_wrist_position(got.posed.wrist, tried, self.limits);
            let upper = posed.shoulder.lerp(posed.elbow, 0.6);
            let deep = torso.offset_aside(posed.elbow, tuned().push_out.near).length()
                + torso.offset_out_of_trunk(upper, 0.0).length();
            if deep == 0.0 {
                return by.to_radians();
            }
            if deep + 1e-4 * cost < best.0 {
                best = (deep + 1e-4 * cost, *by);
            }
        }
        best.1.to_radians()
    }
}

/// Returns an offset out of the trunk if it is deep enough to correct, zero otherwise.
fn if_deep(out: DVec3) -> DVec3 {
    if out.length() > MIN_TRUNK_DEPTH_M {
        out
    } else {
        DVec3::ZERO
    }
}

/// Makes successive frames leave the trunk in one direction until they are `clear`: of the given
/// directions and its own, the one with the shortest push for the deepest frame.
fn in_one_direction(outs: &mut [DVec3], directions: &[DVec3], clear: impl Fn(usize, DVec3) -> bool) {
    let mut start = 0;
    while let Some(first) = (start..outs.len()).find(|&n| outs[n] != DVec3::ZERO) {
        let within = outs[first..].iter().take_while(|out| **out != DVec3::ZERO);
        let run = first..first + within.count();
        start = run.end;
        let farthest = run.clone().max_by(|&a, &b| {
            let [a, b] = [a, b].map(|n| outs[n].length_squared());
            a.total_cmp(&b)
        });
        let main_direction = outs[farthest.unwrap_or(first)].normalize_or_zero();
        let mut least = f64::INFINITY;
        let mut best: Option<Vec<DVec3>> = None;
        for direction in directions.iter().copied().chain([main_direction]) {
            let needed = |frame: usize| {
                let mut tried = (1..=MAX_PUSH_OUT_STEPS).map(|n| direction * (PUSH_OUT_STEP_M * f64::from(n)));
                tried.find(|by| clear(frame, *by))
            };
            let Some(all) = run.clone().map(needed).collect::<Option<Vec<_>>>() else {
                continue;
            };
            let most = all.iter().map(|by| by.length()).fold(0.0, f64::max);
            if most < least {
                (least, best) = (most, Some(all));
            }
        }
        if let Some(all) = best {
            outs[run].copy_from_slice(&all);
        }
    }
}
