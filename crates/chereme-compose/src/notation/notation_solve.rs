//! Solves one arm over time: from the goals of its hand to postures without jumps.
//!
//! Twenty times a second `freedom` selects the arm's plane and shoulder. In between, the hand of each frame
//! gives way to the wrist's limits and to the trunk. Remaining sudden changes are spread over the time
//! around them, as angles of the wrist, so that the wrist stays within its limits. Finally the wrist moves
//! so that the hand's reference point is at its goal.

use chereme_motion::WristAngles;
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::interpolation::smooth_step;

use super::freedom::{ArmPostureChoice, HandLeeway};
use super::notation_arm::{ArmBearing, ArmBoneRig, ArmLimits, ArmPosture, HeldDirections};
use super::notation_stage::{HandOutline, StagedHand, StandingBody};
use super::notation_track::HandGoalFrames;
use super::notation_tuned::tuned;

/// Largest number of iterations for a hand that is adapted to its limits.
const MAX_HAND_ADAPTATIONS: usize = 14;
/// If the last iterate misses the target by this much (m) more than the best one, use the best.
const LOST_TARGET_DISTANCE_M: f64 = 0.02;

/// The settings of an arm in one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ArmFrame {
    /// The goal of the hand's reference point.
    pub(crate) point: DVec3,
    /// The reference point in the hand's space.
    pub(crate) offset: DVec3,
    /// The goal of the hand's rotation.
    pub(crate) turned: DQuat,
    pub(super) bearing: ArmBearing,
    pub(super) angles: WristAngles,
    pub(super) push: DVec3,
    /// Whether the hand reaches its goal without adaptation to limits or trunk.
    pub(super) kept: bool,
}

/// The resulting posture of an arm in one frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SolvedArmFrame {
    pub(crate) posed: ArmPosture,
    pub(crate) rotation: DQuat,
    /// Distance of the reference point from its goal, in metres.
    pub(crate) residual: f64,
    /// Distance by which the hand was pushed out of the trunk, in metres.
    pub(crate) pushed: f64,
    /// The offset that would take the rest of the hand out of the trunk.
    pub(crate) within: DVec3,
}

/// An arm with its body and limits.
pub(crate) struct ArmSolver<'a> {
    pub(crate) stage: &'a StandingBody,
    pub(crate) hand: &'a StagedHand,
    pub(crate) held: HeldDirections,
    pub(crate) limits: &'a ArmLimits,
}

/// The obstacle that keeps a hand from its notated orientation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum HandHindrance {
    Wrist,
    Forearm,
    Reach,
    Trunk,
    Haste,
}

impl HandHindrance {
    /// Returns a description.
    pub(crate) fn describe_hindrance(self) -> &'static str {
        match self {
            Self::Wrist => "the wrist bends no farther",
            Self::Forearm => "the forearm turns no farther",
            Self::Reach => "the arm does not reach",
            Self::Trunk => "the trunk is in the way",
            Self::Haste => "there is no time for it",
        }
    }
}

/// The goal of a hand at one moment.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct WantedHand<'a> {
    pub(crate) point: DVec3,
    pub(crate) offset: DVec3,
    pub(crate) turned: DQuat,
    pub(crate) outlines: [&'a HandOutline; 2],
    /// Degree of contact, from 0 to 1: in contact, the hand turns about its reference point to leave the
    /// trunk instead of moving.
    pub(crate) touch: f64,
}

impl WantedHand<'_> {
    /// Returns the position of the wrist that the goal asks for.
    pub(crate) fn wanted_wrist_position(&self) -> DVec3 {
        self.point - self.turned * self.offset
    }
}

/// A hand after its adaptation to limits and trunk.
#[derive(Clone, Copy)]
pub(crate) struct AdaptedHand {
    pub(crate) angles: WristAngles,
    pub(crate) rotation: DQuat,
    pub(crate) posed: ArmPosture,
    push: DVec3,
    pub(crate) residual: f64,
}

impl<'a> ArmSolver<'a> {
    pub(crate) fn solver_for_hand(stage: &'a StandingBody, hand: &'a StagedHand, limits: &'a ArmLimits) -> Self {
        Self {
            stage,
            hand,
            held: hand.held_hand_directions(),
            limits,
        }
    }

    pub(crate) fn solver_arm_rig(&self) -> &ArmBoneRig {
        &self.hand.rig
    }

    /// Returns the bearing of the arm in each frame, and the limit at which its forearm stops.
    pub(super) fn arm_bearings(&self, wanted: &HandGoalFrames<'_>, rate: f64) -> Vec<(ArmBearing, bool)> {
        let total = wanted.points.len();
        let step = ((tuned().solve.chosen * rate) as usize).max(1);
        let free = settled_free_frames(
            &wanted.free_orientation_frames(),
            (tuned().solve.lead * rate).round() as usize,
        );
        // A moment with a notated orientation counts even between two keys.
        let near = |frame: usize| {
            let around = frame.saturating_sub(step / 2)..(frame + step.div_ceil(2)).min(total);
            let given = around.filter(|&near| !free[near]);
            given.min_by_key(|near| near.abs_diff(frame)).unwrap_or(frame)
        };
        let key_frames = (0..total.div_ceil(step) + 1).map(|n| near((n * step).min(total - 1)));
        let keys = key_frames.map(|frame| {
            let leeway = HandLeeway {
                free: free[frame],
                away: wanted.away[frame],
            };
            (self.wanted_hand_at(wanted, frame), leeway)
        });
        let keys = self.choose_arm_postures(keys, step as f64 / rate);
        let planes = spline(&keys, step, total, |bearing| bearing.plane);
        let shrugs = spline(&keys, step, total, |bearing| bearing.shrug);
        let high = |frame: usize| keys[(frame + step / 2) / step].high;
        let bearings = planes.into_iter().zip(shrugs).enumerate();
        bearings
            .map(|(frame, (plane, shrug))| (ArmBearing { plane, shrug }, high(frame)))
            .collect()
    }

    /// Returns the settings of the arm in each frame for these bearings.
    pub(super) fn lay_arm_frames(
        &self,
        wanted: &HandGoalFrames<'_>,
        bearings: &[(ArmBearing, bool)],
        rate: f64,
    ) -> Vec<ArmFrame> {
        let mut rows: Vec<ArmFrame> = Vec::with_capacity(bearings.len());
        let mut before: Option<(WantedHand<'_>, (ArmBearing, bool))> = None;
        for (frame, &setting) in bearings.iter().enumerate() {
            let frame_target = self.wanted_hand_at(wanted, frame);
            let same = before.replace((frame_target, setting)) == before;
            if let (true, Some(&row)) = (same && before.is_some(), rows.last()) {
                rows.push(row);
                continue;
            }
            let (bearing, high) = setting;
            let hung_hand = self.adapt_hand_to_limits(&frame_target, bearing, high, MAX_HAND_ADAPTATIONS);
            rows.push(ArmFrame {
                point: frame_target.point,
                offset: frame_target.offset,
                turned: frame_target.turned,
                bearing,
                angles: hung_hand.angles,
                push: hung_hand.push,
                kept: hung_hand.rotation == frame_target.turned && hung_hand.push == DVec3::ZERO,
            });
        }
        self.lead_hand_turns(&mut rows, wanted);
        calm(&mut rows, &wanted.free_orientation_frames(), rate);
        self.spread_sudden_pushes(&mut rows, &wanted.touch, rate);
        rows
    }

    /// Leads hands from one orientation to the next within the wrist's limits, if the shortest rotation
    /// exceeds them.
    fn lead_hand_turns(&self, rows: &mut [ArmFrame], wanted: &HandGoalFrames<'_>) {
        for (span, shares) in &wanted.transitions {
            let Some(last) = rows.get(span.end).map(|row| row.angles) else {
                continue;
            };
            let Some(first) = span.start.checked_sub(1).map(|n| rows[n].angles) else {
                continue;
            };
            let ends = |angles: &WristAngles| angles.forearm_turn_share(&self.limits.wrist) > 0.999;
            if !span.clone().any(|n| ends(&rows[n].angles)) {
                continue;
            }
            for (n, &share) in span.clone().zip(shares) {
                rows[n].angles = first.interpolate_wrist_angles(&last, share);
                rows[n].kept = false;
            }
        }
    }

    fn wanted_hand_at<'w>(&self, wanted: &'w HandGoalFrames<'_>, frame: usize) -> WantedHand<'w> {
        // The reference point is placed without the hand's movement about the wrist.
        let (offset, turned) = (wanted.offsets[frame], wanted.turns[frame]);
        let (offset, turned) = match wanted.wrist[frame] {
            Some(turn) => (turn.inverse() * offset, turned * turn),
            None => (offset, turned),
        };
        WantedHand {
            point: wanted.points[frame],
            offset,
            turned: turned.normalize(),
            outlines: wanted.outlines.outlines_at_frame(frame),
            touch: wanted.touch[frame],
        }
    }

    /// Finds the nearest possible pose of a hand: the orientation is adapted to the wrist's limits, and the hand
    /// rotates about its reference point or moves to leave the trunk.
    pub(crate) fn adapt_hand_to_limits(
        &self,
        want: &WantedHand<'_>,
        bearing: ArmBearing,
        high: bool,
        tries: usize,
    ) -> AdaptedHand {
        let posed = self
            .solver_arm_rig()
            .reach_wrist_position(want.wanted_wrist_position(), bearing, self.limits);
        self.hang_from(posed, want, bearing, high, tries)
    }

    /// Does the same from the arm's posture for the wrist that the goal asks for.
    pub(crate) fn hang_from(
        &self,
        mut posed: ArmPosture,
        want: &WantedHand<'_>,
        bearing: ArmBearing,
        high: bool,
        tries: usize,
    ) -> AdaptedHand {
        let rig = self.solver_arm_rig();
        // A hand placed by a fingertip turns about it; one placed by its palm moves.
        let pivot = smooth_step((want.offset.length() / self.hand.staged_hand_length() - 0.55) / 0.25);
        let turns = pivot.max(want.touch);
        let most = tuned().solve.near_turned + (tuned().solve.most_turned - tuned().solve.near_turned) * want.touch;
        let mut turned = want.turned;
        let mut push = DVec3::ZERO;
        let mut wrist = want.point - turned * want.offset;
        let mut round = 0;
        // With a folded forearm a small step of the wrist turns the hand far, and the iteration may not
        // converge.
        let mut best: Option<(f64, AdaptedHand)> = None;
        loop {
            let asked = rig.wrist_angles(&posed, turned, &self.held);
            let angles = asked.clamp_to_limits(&self.limits.wrist, high);
            let rotation = if angles == asked {
                turned
            } else {
                rig.hand_rotation_from_angles(&posed, &angles, &self.held)
            };
            let (out, deepest) = self.offset_hand_out(posed.wrist, rotation, want.outlines);
            let amiss = posed.wrist - wrist;
            let mut about = rotation;
            let mut turn = |at: DVec3, by: DVec3, share: f64| {
                if share <= 0.0 || by.length() <= 1e-4 {
                    return false;
                }
                let lever = at - want.point;
                let far = lever.length();
                let across = by - lever * (by.dot(lever) / (far * far).max(1e-9));
                // Turning does not help points behind the reference point.
                let helps = across.length() > 0.5 * by.length() && far > 0.2 * self.hand.staged_hand_length();
                if !helps || turned.angle_between(want.turned) >= most {
                    return false;
                }
                let axis = lever.cross(across).normalize_or(self.stage.forward);
                let angle = share * (across.length() / far).min(0.3);
                let turn = DQuat::from_axis_angle(axis, angle);
                turned = (turn * turned).normalize();
                about = turn * about;
                true
            };
            turn(wrist, amiss, pivot);
            let by_turning = turn(deepest, out, turns);
            let pushed = out * if by_turning { 1.0 - turns } else { 1.0 };
            push += pushed;
            let goal = want.point + push;
            let step = goal - about * want.offset - wrist;
            round += 1;
            let done = step.length() < 3e-4 && out.length() < 1e-4 && amiss.length() < 3e-4;
            let reached_point = posed.wrist + rotation * want.offset;
            let hung_hand = AdaptedHand {
                angles,
                rotation,
                posed,
                push,
                residual: reached_point.distance(want.point),
            };
            if done {
                return hung_hand;
            }
            let missed = reached_point.distance(goal) + 2.0 * out.length();
            let best = match best.filter(|(least, _)| *least < missed) {
                Some(known) => best.insert(known),
                None => best.insert((missed, hung_hand)),
            };
            if round == tries {
                let lost = missed > 3.0 * best.0 + LOST_TARGET_DISTANCE_M;
                return if lost { best.1 } else { hung_hand };
            }
            wrist += pushed + (step - pushed) * 0.8;
            posed = rig.reach_wrist_position(wrist, bearing, self.limits);
        }
    }

    /// Returns the obstacle that keeps a hand from its notated orientation.
    pub(crate) fn hand_hindrance(&self, row: &ArmFrame, got: &SolvedArmFrame) -> HandHindrance {
        let wrist = row.point + row.push - row.turned * row.offset;
        let posed = self
            .solver_arm_rig()
            .reach_wrist_position(wrist, row.bearing, self.limits);
        let asked = self.solver_arm_rig().wrist_angles(&posed, row.turned, &self.held);
        if asked.forearm_turn_share(&self.limits.wrist) > 1.01 {
            HandHindrance::Forearm
        } else if asked.wrist_bend_share(&self.limits.wrist) > 1.01 {
            HandHindrance::Wrist
        } else if got.pushed > 1e-3 {
            HandHindrance::Trunk
        } else if posed.wrist.distance(wrist) > 5e-3 {
            HandHindrance::Reach
        } else {
            HandHindrance::Haste
        }
    }

    /// Returns the offset by which the deepest point of a hand leaves the trunk, and that point.
    pub(super) fn offset_hand_out(&self, wrist: DVec3, turned: DQuat, outlines: [&HandOutline; 2]) -> (DVec3, DVec3) {
        let (torso, margin) = (&self.stage.torso, tuned().solve.margin);
        let mut most = (torso.offset_out_of_trunk(wrist, margin), wrist);
        let [a, b] = outlines;
        let count = if std::ptr::eq(a, b) { 1 } else { 2 };
        if [a, b].iter().all(|outline| outline.points.is_empty()) {
            return most;
        }
        let Some(seen) = torso.seen_from(wrist, turned) else {
            return most;
        };
        for outline in [a, b].into_iter().take(count) {
            if seen.is_clear(outline.middle, outline.radius + margin) {
                continue;
            }
            for &point in &outline.points {
                if seen.is_clear(point, margin) {
                    continue;
                }
                let outline_point = wrist + turned * point;
                let out = torso.offset_out_of_trunk(outline_point, margin);
                if out.length_squared() > most.0.length_squared() {
                    most = (out, outline_point);
                }
            }
        }
        most
    }

    /// Spreads sudden pushes over the time before and after, except in contact.
    fn spread_sudden_pushes(&self, rows: &mut [ArmFrame], touch: &[f64], rate: f64) {
        let near = ((tuned().solve.around * rate).ceil() as usize).max(1);
        let most = tuned().solve.pushing * self.solver_arm_rig().rig_arm_length() / rate;
        let mut start = 0;
        while let Some(first) = (start..rows.len()).find(|&n| rows[n].push != DVec3::ZERO) {
            let last = first + rows[first..].iter().take_while(|row| row.push != DVec3::ZERO).count();
            let around = first.saturating_sub(2 * near)..(last + 2 * near).min(rows.len());
            start = last;
            let fast = |n: usize| rows[n].push.distance(rows[n - 1].push) > most;
            if !(around.start + 1..around.end).any(fast) {
                continue;
            }
            let pushes: Vec<DVec3> = rows[around.clone()].iter().map(|row| row.push).collect();
            let eased = ease_push_vectors(&pushes, near);
            let touch = &touch[around.clone()];
            for ((row, push), &touch) in rows[around].iter_mut().zip(eased).zip(touch) {
                row.push = push.lerp(row.push, touch);
                row.kept = false;
            }
        }
    }
}

/// Returns the running maximum of the vectors by length, averaged: nowhere shorter than the original; both
/// ends stay unchanged.
pub(super) fn ease_push_vectors(own: &[DVec3], near: usize) -> Vec<DVec3> {
    let window = |n: usize| n.saturating_sub(near)..(n + near + 1).min(own.len());
    let longest: Vec<DVec3> = (0..own.len())
        .map(|n| {
            own[window(n)].iter().fold(DVec3::ZERO, |most, by| {
                if by.length_squared() > most.length_squared() {
                    *by
                } else {
                    most
                }
            })
        })
        .collect();
    (0..own.len())
        .map(|n| {
            let near = near.min(n).min(own.len() - 1 - n);
            let part = &longest[n - near..=n + near];
            if near == 0 {
                return own[n];
            }
            part.iter().sum::<DVec3>() / part.len() as f64
        })
        .collect()
}

/// Spreads wrist movements that are too fast over the time before and after; if possible, over frames in
/// which the hand is `free` to turn.
fn calm(rows: &mut [ArmFrame], free: &[bool], rate: f64) {
    let most = tuned().solve.bending / rate;
    let near = ((tuned().solve.around * rate).ceil() as usize).max(1);
    for _ in 0..4 {
        let jumps = |n: &usize| rows[*n].angles.largest_angle_difference(&rows[*n - 1].angles) > most;
        let jump_frames: Vec<usize> = (1..rows.len()).filter(jumps).collect();
        if jump_frames.is_empty() {
            break;
        }
        for run in jump_frames.chunk_by(|a, b| b - a <= near) {
            let (begins, ends) = (run[0], run[run.len() - 1]);
            let free_before = free[..begins].iter().rev().take_while(|free| **free);
            let before = free_before.take(2 * near).count();
            let free_after = free[ends..].iter().take_while(|free| **free);
            let after = free_after.take(2 * near).count();
            let (before, after) = if before + after >= near {
                (before + 1, after)
            } else {
                (near, near)
            };
            let first = begins.saturating_sub(before);
            let last = (ends + after).min(rows.len() - 1);
            let (from, to) = (rows[first].angles, rows[last].angles);
            for (n, row) in rows[first + 1..last].iter_mut().enumerate() {
                let share = smooth_step((n + 1) as f64 / (last - first) as f64);
                row.angles = from.interpolate_wrist_angles(&to, share);
                row.kept = false;
            }
        }
    }
}

/// Returns the `free` frames that are more than `near` frames from one that is not.
fn settled_free_frames(free: &[bool], near: usize) -> Vec<bool> {
    let around = |n: usize| n.saturating_sub(near)..(n + near + 1).min(free.len());
    (0..free.len())
        .map(|n| free[around(n)].iter().all(|free| *free))
        .collect()
}

/// Interpolates one property of the choices over all frames by a uniform cubic B-spline, which is smoother
/// than its keys.
fn spline(keys: &[ArmPostureChoice], step: usize, total: usize, of: impl Fn(&ArmBearing) -> f64) -> Vec<f64> {
    let key = |n: isize| of(&keys[n.clamp(0, keys.len() as isize - 1) as usize].bearing);
    (0..total)
        .map(|frame| {
            let n = (frame / step) as isize;
            let t = (frame % step) as f64 / step as f64;
            let [a, b, c, d] = [n - 1, n, n + 1, n + 2].map(key);
            let u = 1.0 - t;
            (u * u * u * a
                + (3.0 * t * t * t - 6.0 * t * t + 4.0) * b
                + (3.0 * u * u * u - 6.0 * u * u + 4.0) * c
                + t * t * t * d)
                / 6.0
        })
        .collect()
}
