//! Turns events into frames: goals of each hand's position and rotation, and the fingers' rotations.

use std::f64::consts::TAU;
use std::ops::Range;

use chereme_motion::glam::{DQuat, DVec3};

use super::notation_arm::{ArmLimits, ArmPosture};
use super::notation_bulk::PlacedHand;
use super::notation_plan::{HandAct, HandEvent, HandState, SignPlan};
use super::notation_solve::{ArmFrame, ArmSolver, HandHindrance, SolvedArmFrame};
use super::notation_stage::{StagedHand, StandingBody};
use super::notation_tuned::tuned;
use super::outlines::OutlineTrack;
use super::pace::{MovementPace, PaceTables};
use super::stretch_time::{MovingArm, TimeWarp};

/// The movement of one arm and hand, frame by frame.
pub(crate) struct ArmTrack {
    /// Local rotations of collar bone, upper arm, forearm and hand.
    pub(crate) arm: [Vec<DQuat>; 4],
    /// Local rotations of the joints below the wrist.
    pub(crate) fingers: Vec<Vec<DQuat>>,
    /// Deviations from the goals.
    pub(crate) fit: HandGoalFit,
}

impl ArmTrack {
    /// Returns the moving parts of the arm in each frame.
    pub(crate) fn moving_arm_frames(&self, hand: &StagedHand) -> Vec<MovingArm> {
        let total = self.arm[0].len();
        let mut all: Vec<MovingArm> = Vec::with_capacity(total);
        for n in 0..total {
            let local = [0, 1, 2, 3].map(|joint| self.arm[joint][n]);
            if let Some(&same) = all.last().filter(|last| last.local == local) {
                all.push(same);
                continue;
            }
            let (posed, turned) = hand.rig.posture_from_rotations(local);
            all.push(MovingArm {
                wrist: posed.wrist,
                elbow: posed.elbow,
                turned: hand.rig.arm_model_rotations(&posed, turned),
                local,
            });
        }
        all
    }

    /// Returns the track in stretched time; each joint is interpolated on its own.
    pub(crate) fn stretch_arm_track(self, warp: &TimeWarp) -> Self {
        let frames = warp.stretched_frames();
        Self {
            arm: self.arm.map(|column| stretch_rotations(&column, &frames)),
            fingers: all_stretched(&self.fingers, &frames),
            fit: self.fit,
        }
    }
}

fn all_stretched(columns: &[Vec<DQuat>], frames: &[(usize, f64)]) -> Vec<Vec<DQuat>> {
    let each = columns.iter().map(|column| stretch_rotations(column, frames));
    each.collect()
}

/// Interpolates rotations at fractional frames.
fn stretch_rotations(column: &[DQuat], frames: &[(usize, f64)]) -> Vec<DQuat> {
    let frame_rotation = |&(n, share): &(usize, f64)| {
        let next = column[(n + 1).min(column.len() - 1)];
        if share == 0.0 || next == column[n] {
            column[n]
        } else {
            column[n].slerp(next, share).normalize()
        }
    };
    frames.iter().map(frame_rotation).collect()
}

/// Orientation error (rad) above which a warning is issued.
pub(crate) const REPORTED_ORIENTATION_ERROR_RAD: f64 = 10.0 * std::f64::consts::PI / 180.0;

/// Rotation of a joint between two frames (rad) above which the frames in between are solved by the hand
/// instead of joint by joint.
const LONG_JOINT_ROTATION_RAD: f64 = 0.04;

/// Largest deviations of a hand from its goals during signs, without transitions.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct HandGoalFit {
    /// Largest distance of its reference point from the goal, in metres.
    pub(crate) residual: f64,
    /// The same during contacts, in metres.
    pub(crate) parted: f64,
    /// Largest deviation from a notated orientation, in radians; between two notated orientations the hand
    /// is free.
    pub(crate) turned: f64,
    /// The obstacle at that moment, if the deviation is reported.
    pub(crate) hindered: Option<HandHindrance>,
    /// Largest distance by which it was pushed out of the trunk, in metres.
    pub(crate) pushed: f64,
}

/// The goals of a hand in each frame.
pub(crate) struct HandGoalFrames<'a> {
    pub(crate) points: Vec<DVec3>,
    pub(crate) turns: Vec<DQuat>,
    /// The turns, in the hand's space, by which those rotations lean off the written ones.
    pub(crate) leans: Vec<DQuat>,
    pub(crate) offsets: Vec<DVec3>,
    /// Rotation of a movement about the wrist, if any.
    pub(crate) wrist: Vec<Option<DQuat>>,
    pub(crate) outlines: OutlineTrack<'a>,
    /// Degree of contact, from 0 to 1.
    pub(crate) touch: Vec<f64>,
    /// Whether the hand is outside of signs: on its way from rest or back.
    pub(crate) away: Vec<bool>,
    /// Rotations between two orientations: the frames, and the completed share in each.
    pub(crate) transitions: Vec<(Range<usize>, Vec<f64>)>,
}

impl HandGoalFrames<'_> {
    /// Keeps a range of frames.
    pub(crate) fn cut_goal_frames(mut self, span: Range<usize>) -> Self {
        fn kept_column_span<T>(column: Vec<T>, span: &Range<usize>) -> Vec<T> {
            let some = column.into_iter().skip(span.start);
            some.take(span.len()).collect()
        }
        let within = |frame: usize| frame.clamp(span.start, span.end) - span.start;
        let transitions = self.transitions.into_iter().map(|(range, shares)| {
            let cut = within(range.start)..within(range.end);
            let skipped = span.start.saturating_sub(range.start).min(shares.len());
            let shares = shares.into_iter().skip(skipped).take(cut.len()).collect();
            (cut, shares)
        });
        self.outlines.first = span.start;
        Self {
            transitions: transitions.filter(|(range, _)| !range.is_empty()).collect(),
            points: kept_column_span(self.points, &span),
            turns: kept_column_span(self.turns, &span),
            leans: kept_column_span(self.leans, &span),
            offsets: kept_column_span(self.offsets, &span),
            wrist: kept_column_span(self.wrist, &span),
            touch: kept_column_span(self.touch, &span),
            away: kept_column_span(self.away, &span),
            outlines: self.outlines,
        }
    }

    /// Returns for each frame whether the hand is between two notated orientations that are far from each other; the
    /// first frame of a rotation still counts as notated.
    pub(crate) fn free_orientation_frames(&self) -> Vec<bool> {
        let mut free = vec![false; self.points.len()];
        let last = self.turns.len().saturating_sub(1);
        let turned = |span: &Range<usize>| {
            let [from, to] = [span.start, span.end].map(|frame| self.turns[frame.min(last)]);
            from.angle_between(to)
        };
        let far = |span: &Range<usize>| turned(span) > tuned().solve.free_from;
        for (span, _) in self.transitions.iter().filter(|(span, _)| far(span)) {
            let first = (span.start + 1).min(span.end);
            free[first..span.end].fill(true);
        }
        free
    }
}

/// Returns the frames of an event: those at or after its start and before its end.
fn event_frame_range(event: &HandEvent, rate: f64, total: usize) -> Range<usize> {
    let frame_number = |time: f64| (time * rate - 1e-9).ceil().max(0.0) as usize;
    frame_number(event.from).min(total)..frame_number(event.to).min(total)
}

fn event_time_share(event: &HandEvent, frame: usize, rate: f64) -> f64 {
    (frame as f64 / rate - event.from) / (event.to - event.from).max(1e-9)
}

/// Frame rate, length and paces of an animation.
pub(crate) struct AnimationTiming<'a> {
    pub(crate) paces: &'a PaceTables,
    /// Frames per second.
    pub(crate) rate: f64,
    /// Total number of frames.
    pub(crate) total: usize,
}

/// The solved frames of one hand before time is stretched.
pub(crate) struct SolvedFrames<'a> {
    solver: ArmSolver<'a>,
    outlines: OutlineTrack<'a>,
    rows: Vec<ArmFrame>,
    moved: Vec<MovingArm>,
    fingers: Vec<Vec<DQuat>>,
    got: Vec<SolvedArmFrame>,
    fit: HandGoalFit,
}

impl<'a> SolvedFrames<'a> {
    pub(crate) fn solve_hand_frames(
        stage: &'a StandingBody,
        hand: &'a StagedHand,
        plan: &'a SignPlan,
        n: usize,
        wanted: HandGoalFrames<'a>,
        limits: &'a ArmLimits,
        timing: &AnimationTiming<'_>,
    ) -> Self {
        let solver = ArmSolver::solver_for_hand(stage, hand, limits);
        let (rows, got) = solver.over_time(&wanted, timing.rate);
        let mut moved: Vec<MovingArm> = Vec::with_capacity(rows.len());
        let mut before: Option<(ArmPosture, DQuat)> = None;
        for &SolvedArmFrame { posed, rotation, .. } in &got {
            let stays = before.replace((posed, rotation)) == Some((posed, rotation));
            if let Some(&same) = moved.last().filter(|_| stays) {
                moved.push(same);
                continue;
            }
            let turned = hand.rig.arm_model_rotations(&posed, rotation);
            moved.push(MovingArm {
                wrist: posed.wrist,
                elbow: posed.elbow,
                turned,
                local: hand.rig.local_arm_rotations(&posed, turned),
            });
        }
        let free = wanted.free_orientation_frames();
        let mut fit = HandGoalFit::default();
        for (frame, (got, row)) in got.iter().zip(&rows).enumerate() {
            let time = frame as f64 / timing.rate;
            let turned = fit.turned;
            if !wanted.away[frame] {
                let notated = (!free[frame]).then(|| row.turned * wanted.leans[frame].inverse());
                fit.include_sign_frame(got, notated);
            }
            fit.include_contact_frame(got, &plan.contacts[n], [time, 1.0 / timing.rate]);
            if fit.turned > turned.max(REPORTED_ORIENTATION_ERROR_RAD) {
                fit.hindered = Some(solver.hand_hindrance(row, got));
            }
        }
        Self {
            moved,
            fingers: finger_rotation_frames(stage, hand, plan, n, timing),
            solver,
            outlines: wanted.outlines,
            rows,
            got,
            fit,
        }
    }

    /// Returns the moving parts of the arm in each frame.
    pub(crate) fn solved_arm_movement(&self) -> &[MovingArm] {
        &self.moved
    }

    /// Returns the number of frames.
    pub(crate) fn solved_frame_total(&self) -> usize {
        self.got.len()
    }

    /// Returns the ends of the forearm's thick part in a frame: the elbow, and a point before the wrist.
    pub(crate) fn forearm_ends_at(&self, frame: usize) -> [DVec3; 2] {
        let posed = &self.got[frame].posed;
        [posed.elbow, posed.elbow.lerp(posed.wrist, 0.85)]
    }

    /// Returns whether the hand is the same in two frames.
    pub(crate) fn is_hand_unchanged(&self, a: usize, b: usize) -> bool {
        let [one, other] = [&self.got[a], &self.got[b]];
        one.posed == other.posed
            && one.rotation == other.rotation
            && std::ptr::eq(
                self.outlines.outlines_at_frame(a)[1],
                self.outlines.outlines_at_frame(b)[1],
            )
    }

    /// Returns the hand in a frame; `None` if its skeleton has no fingers.
    pub(crate) fn placed_hand_at(&self, frame: usize) -> Option<PlacedHand<'_>> {
        let solved_frame = &self.got[frame];
        PlacedHand::at_wrist(solved_frame.posed.wrist, solved_frame.rotation, &self.outlines, frame)
    }

    /// Returns the frames in stretched time.
    pub(crate) fn into_stretched_track(self, warp: &TimeWarp) -> ArmTrack {
        if warp.is_none() {
            return ArmTrack {
                arm: [0, 1, 2, 3].map(|joint| self.moved.iter().map(|at| at.local[joint]).collect()),
                fingers: self.fingers,
                fit: self.fit,
            };
        }
        let frames = warp.stretched_frames();
        let mut solved: Option<(usize, bool)> = None;
        let arm = frames.iter().map(|&(n, share)| {
            let carried = match solved {
                Some((known, carried)) if known == n => carried,
                _ => self.is_carried(n, warp),
            };
            solved = Some((n, carried));
            self.interpolate_arm_joints(n, share, carried)
        });
        let mut arm: Vec<[DQuat; 4]> = arm.collect();
        let outlines = |frame: usize| self.outlines.outlines_at_frame(frames[frame].0);
        self.solver
            .clear_arm_from_trunk(&mut arm, outlines, warp.warp_frame_rate());
        ArmTrack {
            arm: [0, 1, 2, 3].map(|joint| arm.iter().map(|turned| turned[joint]).collect()),
            fingers: all_stretched(&self.fingers, &frames),
            fit: self.fit,
        }
    }

    /// Interpolates the arm's joints between a planned frame and the next: each on its own, or with the
    /// hand `carried`, so that the wrist stays within its limits.
    fn interpolate_arm_joints(&self, n: usize, share: f64, carried: bool) -> [DQuat; 4] {
        let here = self.moved[n].local;
        let Some(next) = self.rows.get(n + 1).filter(|_| share > 0.0) else {
            return here;
        };
        if carried {
            let ends = [&self.got[n], &self.got[n + 1]];
            let bearing = self.rows[n].bearing.mix_bearings(&next.bearing, share);
            let (posed, rotation) = self.solver.carry_hand_between(ends, bearing, share);
            return self.solver.solver_arm_rig().arm_joint_rotations(&posed, rotation);
        }
        [0, 1, 2, 3].map(|joint| {
            let (from, to) = (here[joint], self.moved[n + 1].local[joint]);
            match from == to {
                true => from,
                false => from.slerp(to, share).normalize(),
            }
        })
    }

    /// Returns the rotation (rad) of a joint and the distance (m) of the wrist between a planned frame and
    /// the next, extrapolated from the fastest part of the step, with the hand carried.
    pub(crate) fn fastest_step_motion(&self, n: usize) -> [f64; 2] {
        const STEP_PART_COUNT: usize = 8;
        let Some(next) = self.rows.get(n + 1) else {
            return [0.0; 2];
        };
        let rig = self.solver.solver_arm_rig();
        let ends = [&self.got[n], &self.got[n + 1]];
        let part_posture = |part: usize| {
            let share = part as f64 / STEP_PART_COUNT as f64;
            let bearing = self.rows[n].bearing.mix_bearings(&next.bearing, share);
            let (posed, rotation) = self.solver.carry_hand_between(ends, bearing, share);
            (posed.wrist, rig.arm_model_rotations(&posed, rotation))
        };
        let [mut before, last] = [n, n + 1].map(|n| (self.moved[n].wrist, self.moved[n].turned));
        let mut most = [0.0_f64; 2];
        for part in 1..=STEP_PART_COUNT {
            let here = if part < STEP_PART_COUNT {
                part_posture(part)
            } else {
                last
            };
            let turns = before.1.iter().zip(&here.1);
            let turn = turns.map(|(a, b)| a.angle_between(*b)).fold(0.0, f64::max);
            most[0] = most[0].max(turn * STEP_PART_COUNT as f64);
            most[1] = most[1].max(before.0.distance(here.0) * STEP_PART_COUNT as f64);
            before = here;
        }
        most
    }

    /// Returns whether a step between planned frames is long enough to carry the hand, and not too fast
    /// for it.
    fn is_carried(&self, n: usize, warp: &TimeWarp) -> bool {
        if n + 1 >= self.rows.len() {
            return false;
        }
        let [here, next] = [n, n + 1].map(|n| self.moved[n].local);
        let turns = here.into_iter().zip(next).map(|(a, b)| a.angle_between(b));
        turns.fold(0.0, f64::max) > LONG_JOINT_ROTATION_RAD && warp.allows_step_duration(n, self.fastest_step_motion(n))
    }
}

impl HandGoalFit {
    /// Includes a frame of a sign, with the hand's orientation if it is notated for it.
    fn include_sign_frame(&mut self, got: &SolvedArmFrame, notated: Option<DQuat>) {
        self.pushed = self.pushed.max(got.pushed);
        self.residual = self.residual.max(got.residual);
        if let Some(notated) = notated {
            self.turned = self.turned.max(got.rotation.angle_between(notated));
        }
    }

    /// Includes a frame at a time of `step` seconds, if the hand touches something in it.
    fn include_contact_frame(&mut self, got: &SolvedArmFrame, contacts: &[(f64, f64)], [time, step]: [f64; 2]) {
        let touches = |&(from, to): &(f64, f64)| (from - 1e-9..=to.max(from + step) - 1e-9).contains(&time);
        if contacts.iter().any(touches) {
            self.parted = self.parted.max(got.residual);
        }
    }
}

/// Returns whether a time is within a sign rather than a transition.
fn is_within_sign(plan: &SignPlan, time: f64) -> bool {
    plan.signs.iter().any(|sign| (sign.from..=sign.to).contains(&time))
}

/// Returns for each frame whether it is outside of signs, or the hand moves from rest or back.
fn away(plan: &SignPlan, n: usize, timing: &AnimationTiming<'_>) -> Vec<bool> {
    let away = |frame: usize| {
        let time = frame as f64 / timing.rate;
        let mut spans = plan.away[n].iter();
        !is_within_sign(plan, time) || spans.any(|&(from, to)| (from..to).contains(&time))
    };
    (0..timing.total).map(away).collect()
}

/// Returns the goals of a hand in each frame.
pub(crate) fn goal_frames_from_plan<'a>(
    stage: &StandingBody,
    plan: &'a SignPlan,
    n: usize,
    timing: &AnimationTiming<'_>,
) -> HandGoalFrames<'a> {
    let &AnimationTiming { paces, rate, total } = timing;
    let course_point = |event: &HandEvent, time: f64| {
        let share = paces.pace_path_share(event.pace, time);
        let course = plan.event_course(n, event);
        course.map_or(share, |course| course.completed_act_share(share))
    };
    let goals = follow_hand_events(&plan.start[n], &plan.events[n], rate, total, course_point);
    HandGoalFrames {
        points: goals.points,
        turns: goals.turns,
        leans: goals.leans,
        offsets: goals.offsets,
        wrist: goals.wrist,
        outlines: OutlineTrack::outlines_from_plan(stage, plan, n, timing),
        touch: contact_degree_frames(&plan.contacts[n], timing),
        away: away(plan, n, timing),
        transitions: goals.transitions,
    }
}

/// Where a hand's events lead it, frame by frame.
pub(crate) struct EventGoalColumns {
    pub(crate) points: Vec<DVec3>,
    pub(crate) turns: Vec<DQuat>,
    /// The turns, in the hand's space, by which those rotations lean off the written ones.
    pub(crate) leans: Vec<DQuat>,
    pub(crate) offsets: Vec<DVec3>,
    /// Rotation of a movement about the wrist, if any.
    pub(crate) wrist: Vec<Option<DQuat>>,
    /// Rotations between two orientations: the frames, and the completed share in each.
    pub(crate) transitions: Vec<(Range<usize>, Vec<f64>)>,
}

impl EventGoalColumns {
    /// Returns the positions of the wrist.
    pub(crate) fn goal_wrist_positions(&self) -> impl Iterator<Item = DVec3> {
        let hands = self.turns.iter().zip(&self.offsets);
        let each = self.points.iter().zip(hands);
        each.map(|(point, (turned, offset))| *point - *turned * *offset)
    }
}

/// Returns where events lead a hand from its start in each of `total` frames; `course` returns the completed share of an
/// event after a share of its time.
pub(crate) fn follow_hand_events(
    start: &HandState,
    events: &[HandEvent],
    rate: f64,
    total: usize,
    course: impl Fn(&HandEvent, f64) -> f64,
) -> EventGoalColumns {
    let mut order: Vec<&HandEvent> = events.iter().collect();
    order.sort_by(|a, b| a.from.total_cmp(&b.from));
    let mut points = vec![DVec3::ZERO; total];
    let mut ends = vec![DVec3::ZERO; total + 1];
    let mut turns = SteppedValues::new(start.rotation, total);
    let mut leans = SteppedValues::new(start.leaned, total);
    let mut offsets = SteppedValues::new(start.offset, total);
    let mut wrist = vec![None; total];
    let mut transitions: Vec<(Range<usize>, Vec<f64>)> = Vec::new();
    for event in order {
        let span = event_frame_range(event, rate, total);
        let done = |frame: usize| course(event, event_time_share(event, frame, rate));
        match &event.act {
            HandAct::Move(path) => {
                for frame in span.clone() {
                    points[frame] += path.path_point_at(done(frame));
                }
                ends[span.end] += path.path_end();
            }
            HandAct::Turn(to) => {
                transitions.push((span.clone(), span.clone().map(done).collect()));
                turns.change_value_over(span, *to, |from, to, s| from.slerp(to, s), done);
            }
            HandAct::Lean(to) => leans.change_value_over(span, *to, |from, to, s| from.slerp(to, s), done),
            HandAct::Follow { path, corner, to } => turns.change_value_over(
                span,
                *to,
                |from, _, s| {
                    let round = DQuat::IDENTITY.slerp(*corner, (4.0 * s).min(1.0));
                    (path.path_rotation_at(s) * round * from).normalize()
                },
                done,
            ),
            HandAct::Point(to) => offsets.change_value_over(span, *to, |from, to, s| from.lerp(to, s), done),
            HandAct::Wrist(cycle) => {
                for frame in span {
                    wrist[frame] = Some(cycle.wrist_cycle_rotation(event_time_share(event, frame, rate)));
                }
            }
            HandAct::Shape(_) | HandAct::Play { .. } => {}
        }
    }
    let mut sum = start.point;
    for (point, end) in points.iter_mut().zip(&ends) {
        sum += *end;
        *point += sum;
    }
    EventGoalColumns {
        points,
        turns: turns.finish_stepped_values(),
        leans: leans.finish_stepped_values(),
        offsets: offsets.finish_stepped_values(),
        wrist,
        transitions,
    }
}

/// Returns the degree of contact in each frame; it rises and falls within a fifth of a second.
fn contact_degree_frames(contacts: &[(f64, f64)], timing: &AnimationTiming<'_>) -> Vec<f64> {
    let mut touch = vec![0.0_f64; timing.total];
    for &(from, to) in contacts {
        let frames = ((from - 0.2) * timing.rate).max(0.0) as usize
            ..((to + 0.2) * timing.rate).ceil().min(timing.total as f64) as usize;
        for frame in frames {
            let time = frame as f64 / timing.rate;
            let far = (from - time).max(time - to).max(0.0) / 0.2;
            touch[frame] = touch[frame].max(1.0 - far.min(1.0));
        }
    }
    touch
}

/// A value that changes step by step, each from its current value.
struct SteppedValues<T> {
    values: Vec<T>,
    filled: usize,
    now: T,
}

impl<T: Copy> SteppedValues<T> {
    fn new(start: T, total: usize) -> Self {
        Self {
            values: Vec::with_capacity(total),
            filled: total,
            now: start,
        }
    }

    fn change_value_over(
        &mut self,
        span: Range<usize>,
        to: T,
        mix: impl Fn(T, T, f64) -> T,
        share: impl Fn(usize) -> f64,
    ) {
        // The next step cuts off the current one.
        if span.start < self.values.len() {
            self.now = self.values[span.start];
            self.values.truncate(span.start);
        }
        self.values.resize(span.start, self.now);
        let from = self.now;
        self.values.extend(span.map(|frame| mix(from, to, share(frame))));
        self.now = to;
    }

    fn finish_stepped_values(mut self) -> Vec<T> {
        self.values.resize(self.filled, self.now);
        self.values
    }
}

/// Returns the frames, shape and event of each change of shape, in order of time.
pub(super) fn shape_spans(events: &[HandEvent], rate: f64, total: usize) -> Vec<(Range<usize>, usize, &HandEvent)> {
    let mut spans: Vec<(Range<usize>, usize, &HandEvent)> = events
        .iter()
        .filter_map(|event| match event.act {
            HandAct::Shape(shape) => Some((event_frame_range(event, rate, total), shape, event)),
            _ => None,
        })
        .collect();
    spans.sort_by_key(|(span, ..)| span.start);
    spans
}

/// Returns the completed share of a change of shape: hands take their shape in the first part of a
/// transition.
pub(super) fn early_shape_share(event: &HandEvent, frame: usize, timing: &AnimationTiming<'_>) -> f64 {
    let time = event_time_share(event, frame, timing.rate);
    let lax = matches!(event.pace, MovementPace::Lax | MovementPace::Calm);
    let time = if lax { time * 1.4 } else { time };
    timing.paces.pace_path_share(event.pace, time)
}

pub(crate) fn finger_rotation_frames(
    stage: &StandingBody,
    hand: &StagedHand,
    plan: &SignPlan,
    n: usize,
    timing: &AnimationTiming<'_>,
) -> Vec<Vec<DQuat>> {
    let &AnimationTiming { rate, total, .. } = timing;
    let shapes = &plan.shapes[n];
    let spans = shape_spans(&plan.events[n], rate, total);
    let mut all: Vec<Vec<DQuat>> = (0..hand.fingers.len())
        .map(|joint| {
            let mut steps = SteppedValues::new(shapes[plan.start[n].shape].rotations[joint], total);
            for (span, shape, event) in &spans {
                let to = shapes[*shape].rotations[joint];
                steps.change_value_over(span.clone(), to, lerp_rotations_normalized, |frame| {
                    early_shape_share(event, frame, timing)
                });
            }
            steps.finish_stepped_values()
        })
        .collect();
    for event in &plan.events[n] {
        if let HandAct::Play { digits, angle, cycles } = event.act {
            let span = event_frame_range(event, rate, total);
            play_finger_bases(stage, hand, &mut all, span, digits, |frame, digit| {
                let time = event_time_share(event, frame, rate);
                let ends = (time.min(1.0 - time) * cycles * 3.0).clamp(0.0, 1.0);
                angle * ends * (TAU * (cycles * time - digit as f64 * 0.17)).sin()
            });
        }
    }
    all
}

pub(super) fn lerp_rotations_normalized(from: DQuat, to: DQuat, share: f64) -> DQuat {
    let to = if from.dot(to) < 0.0 { -to } else { to };
    (from * (1.0 - share) + to * share).normalize()
}

/// Bends the base joints of fingers about the axis across the hand.
fn play_finger_bases(
    stage: &StandingBody,
    hand: &StagedHand,
    all: &mut [Vec<DQuat>],
    span: Range<usize>,
    digits: [bool; 5],
    angle: impl Fn(usize, usize) -> f64,
) {
    use chereme_motion::{BodyPart, HandFinger};
    let across = hand.along.cross(hand.palm);
    for (digit, _) in digits.into_iter().enumerate().filter(|(_, plays)| *plays) {
        let part = match digit {
            0 => BodyPart::Thumb(hand.side, 1),
            n => BodyPart::Finger(hand.side, HandFinger::ALL_FINGERS[n - 1], 1),
        };
        let joint = stage.anatomy.part_joint(part);
        let Some(row) = hand.fingers.iter().position(|&j| Some(j) == joint) else {
            continue;
        };
        let above = stage
            .skeleton
            .joint_ancestors(hand.fingers[row])
            .skip(1)
            .take_while(|&j| j != hand.hand_joint_index())
            .fold(DQuat::IDENTITY, |turned, j| stage.base.rotations[j] * turned);
        let axis = above.inverse() * across;
        for frame in span.clone() {
            let turn = DQuat::from_axis_angle(axis, angle(frame, digit));
            all[row][frame] = (turn * all[row][frame]).normalize();
        }
    }
}
