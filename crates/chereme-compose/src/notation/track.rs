//! From events to frames: where each wrist is, how each hand is turned, how fingers are bent.

use std::f64::consts::TAU;
use std::ops::Range;

use chereme_motion::glam::{DQuat, DVec3};

use super::arm::{Held, Limits, Posed, WristAngles};
use super::pace::{Pace, Paces};
use super::plan::{Act, Event, Plan};
use super::stage::{Hand, Stage};

/// How often the arm's plane is weighed, in seconds; between, it goes smoothly.
const WEIGHED: f64 = 1.0 / 30.0;
/// How fast a wrist bends and a forearm turns at most, in radians per second, and the arm's plane.
const BENDING: f64 = 28.0;
const SWIVEL: f64 = 7.0;
/// How fast a wrist goes at most, in arm lengths a second, and the time before and after a faster
/// step over which it is spread, in seconds.
const FASTEST: f64 = 11.0;
const AROUND: f64 = 0.09;
/// How near to the trunk's surface points of a hand come, in metres.
const MARGIN: f64 = 0.004;

/// The movement of one arm and hand, a row a frame.
pub(crate) struct Track {
    /// The local rotations of collar bone, upper arm, forearm and hand.
    pub(crate) arm: [Vec<DQuat>; 4],
    /// The local rotations of the joints below the wrist.
    pub(crate) fingers: Vec<Vec<DQuat>>,
    /// How well it came where it should.
    pub(crate) fit: Fit,
}

/// How well a hand came where it should during signs, transitions left out.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Fit {
    /// The largest distance of its point from where it should be, in metres, and the frame.
    pub(crate) residual: f64,
    pub(crate) frame: usize,
    /// The largest angle by which its orientation gave way to the wrist, in radians.
    pub(crate) turned: f64,
    /// The farthest it was moved out of the trunk, in metres.
    pub(crate) pushed: f64,
}

/// What a hand should do at each frame.
struct Wanted {
    points: Vec<DVec3>,
    turns: Vec<DQuat>,
    offsets: Vec<DVec3>,
    /// The turn about the wrist, and from which frames it is one at all.
    wrist: Vec<Option<DQuat>>,
}

/// The frames that a stretch of time covers: those at or after its start and before its end.
fn frames(event: &Event, rate: f64, total: usize) -> Range<usize> {
    let at = |time: f64| (time * rate - 1e-9).ceil().max(0.0) as usize;
    at(event.from).min(total)..at(event.to).min(total)
}

fn share(event: &Event, frame: usize, rate: f64) -> f64 {
    (frame as f64 / rate - event.from) / (event.to - event.from).max(1e-9)
}

/// How time runs.
pub(crate) struct Timing<'a> {
    pub(crate) paces: &'a Paces,
    /// Frames a second.
    pub(crate) rate: f64,
    /// Frames in all.
    pub(crate) total: usize,
}

/// Makes the frames of one hand.
pub(crate) fn track(
    stage: &Stage,
    hand: &Hand,
    plan: &Plan,
    n: usize,
    limits: &Limits,
    timing: &Timing<'_>,
) -> Track {
    let wanted = wanted(plan, n, timing);
    let fingers = fingers(stage, hand, plan, n, timing);
    let outlines = outlines(plan, n, timing);
    let (arm, fit) = arms(stage, hand, plan, &wanted, &outlines, limits, timing.rate);
    Track { arm, fingers, fit }
}

fn wanted(plan: &Plan, n: usize, timing: &Timing<'_>) -> Wanted {
    let &Timing { paces, rate, total } = timing;
    let start = &plan.start[n];
    let mut order: Vec<&Event> = plan.events[n].iter().collect();
    order.sort_by(|a, b| a.from.total_cmp(&b.from));
    let mut points = vec![DVec3::ZERO; total];
    let mut ends = vec![DVec3::ZERO; total + 1];
    let mut turns = Steps::new(start.rotation, total);
    let mut offsets = Steps::new(start.offset, total);
    let mut wrist = vec![None; total];
    for event in order {
        let span = frames(event, rate, total);
        match &event.act {
            Act::Move(path) => {
                for frame in span.clone() {
                    points[frame] += path.at(paces.share(event.pace, share(event, frame, rate)));
                }
                ends[span.end] += path.end();
            }
            Act::Turn(to) => turns.go(
                span,
                *to,
                |from, to, s| from.slerp(to, s),
                |frame| paces.share(event.pace, share(event, frame, rate)),
            ),
            Act::Point(to) => offsets.go(
                span,
                *to,
                |from, to, s| from.lerp(to, s),
                |frame| paces.share(event.pace, share(event, frame, rate)),
            ),
            Act::Wrist { axes, cycles } => {
                for frame in span {
                    let time = share(event, frame, rate);
                    let turn = TAU * cycles * time;
                    let ends = (time.min(1.0 - time) * cycles * 4.0).clamp(0.0, 1.0);
                    let ends = ends * ends * (3.0 - 2.0 * ends);
                    let about = (axes[0] * turn.sin() + axes[1] * turn.cos()) * ends;
                    wrist[frame] = Some(DQuat::from_scaled_axis(about));
                }
            }
            Act::Shape(_) | Act::Play { .. } => {}
        }
    }
    let mut sum = start.point;
    for (point, end) in points.iter_mut().zip(&ends) {
        sum += *end;
        *point += sum;
    }
    Wanted {
        points,
        turns: turns.done(),
        offsets: offsets.done(),
        wrist,
    }
}

/// A value that goes from one to the next, each from where it is.
struct Steps<T> {
    values: Vec<T>,
    filled: usize,
    now: T,
}

impl<T: Copy> Steps<T> {
    fn new(start: T, total: usize) -> Self {
        Self {
            values: Vec::with_capacity(total),
            filled: total,
            now: start,
        }
    }

    fn go(
        &mut self,
        span: Range<usize>,
        to: T,
        mix: impl Fn(T, T, f64) -> T,
        share: impl Fn(usize) -> f64,
    ) {
        // What runs already is cut off where the next one begins.
        if span.start < self.values.len() {
            self.now = self.values[span.start];
            self.values.truncate(span.start);
        }
        self.values.resize(span.start, self.now);
        let from = self.now;
        self.values
            .extend(span.map(|frame| mix(from, to, share(frame))));
        self.now = to;
    }

    fn done(mut self) -> Vec<T> {
        self.values.resize(self.filled, self.now);
        self.values
    }
}

/// Returns the shapes that a hand has at each frame: one, or the way from one to another.
fn shape_spans(events: &[Event], rate: f64, total: usize) -> Vec<(Range<usize>, usize, &Event)> {
    let mut spans: Vec<(Range<usize>, usize, &Event)> = events
        .iter()
        .filter_map(|event| match event.act {
            Act::Shape(shape) => Some((frames(event, rate, total), shape, event)),
            _ => None,
        })
        .collect();
    spans.sort_by_key(|(span, ..)| span.start);
    spans
}

fn fingers(
    stage: &Stage,
    hand: &Hand,
    plan: &Plan,
    n: usize,
    timing: &Timing<'_>,
) -> Vec<Vec<DQuat>> {
    let &Timing { paces, rate, total } = timing;
    let shapes = &plan.shapes[n];
    let spans = shape_spans(&plan.events[n], rate, total);
    // Hands take their shape in the first part of a way without meaning.
    let early = |event: &Event, frame: usize| {
        let time = share(event, frame, rate);
        let time = if event.pace == Pace::Lax {
            time * 1.4
        } else {
            time
        };
        paces.share(event.pace, time)
    };
    let mut all: Vec<Vec<DQuat>> = (0..hand.fingers.len())
        .map(|joint| {
            let mut steps = Steps::new(shapes[plan.start[n].shape].rotations[joint], total);
            for (span, shape, event) in &spans {
                let to = shapes[*shape].rotations[joint];
                steps.go(span.clone(), to, nlerp, |frame| early(event, frame));
            }
            steps.done()
        })
        .collect();
    for event in &plan.events[n] {
        if let Act::Play {
            digits,
            angle,
            cycles,
        } = event.act
        {
            let span = frames(event, rate, total);
            play(stage, hand, &mut all, span, digits, |frame, digit| {
                let time = share(event, frame, rate);
                let ends = (time.min(1.0 - time) * cycles * 3.0).clamp(0.0, 1.0);
                angle * ends * (TAU * (cycles * time - digit as f64 * 0.17)).sin()
            });
        }
    }
    all
}

fn nlerp(from: DQuat, to: DQuat, share: f64) -> DQuat {
    let to = if from.dot(to) < 0.0 { -to } else { to };
    (from * (1.0 - share) + to * share).normalize()
}

/// Bends base joints of fingers about the axis across the hand.
fn play(
    stage: &Stage,
    hand: &Hand,
    all: &mut [Vec<DQuat>],
    span: Range<usize>,
    digits: [bool; 5],
    angle: impl Fn(usize, usize) -> f64,
) {
    use chereme_motion::{Finger, Part};
    let across = hand.along.cross(hand.palm);
    for (digit, _) in digits.into_iter().enumerate().filter(|(_, plays)| *plays) {
        let part = match digit {
            0 => Part::Thumb(hand.side, 1),
            n => Part::Finger(hand.side, Finger::ALL[n - 1], 1),
        };
        let joint = stage.anatomy.joint(part);
        let Some(row) = hand.fingers.iter().position(|&j| Some(j) == joint) else {
            continue;
        };
        let above = stage
            .skeleton
            .ancestors(hand.fingers[row])
            .skip(1)
            .take_while(|&j| j != hand.joint())
            .fold(DQuat::IDENTITY, |turned, j| {
                stage.base.rotations[j] * turned
            });
        let axis = above.inverse() * across;
        for frame in span.clone() {
            let turn = DQuat::from_axis_angle(axis, angle(frame, digit));
            all[row][frame] = (turn * all[row][frame]).normalize();
        }
    }
}

/// Returns the outlines of a hand, and from which frame on which two hold.
struct Outlines<'a> {
    from: Vec<(usize, &'a [DVec3], &'a [DVec3])>,
}

fn outlines<'a>(plan: &'a Plan, n: usize, timing: &Timing<'_>) -> Outlines<'a> {
    let of = |shape: usize| plan.shapes[n][shape].outline.as_slice();
    let mut now = of(plan.start[n].shape);
    let mut from = vec![(0, now, now)];
    for (span, shape, _) in shape_spans(&plan.events[n], timing.rate, timing.total) {
        let next = of(shape);
        from.push((span.start, now, next));
        from.push((span.end, next, next));
        now = next;
    }
    Outlines { from }
}

impl Outlines<'_> {
    fn at(&self, frame: usize, cursor: &mut usize) -> [&[DVec3]; 2] {
        while self
            .from
            .get(*cursor + 1)
            .is_some_and(|next| next.0 <= frame)
        {
            *cursor += 1;
        }
        let (_, a, b) = self.from[*cursor];
        [a, b]
    }
}

fn arms(
    stage: &Stage,
    hand: &Hand,
    plan: &Plan,
    wanted: &Wanted,
    outlines: &Outlines<'_>,
    limits: &Limits,
    rate: f64,
) -> ([Vec<DQuat>; 4], Fit) {
    let total = wanted.points.len();
    let held = hand.held();
    let mut fit = Fit::default();
    let turns = planes(stage, hand, wanted, limits, rate);
    let mut arm: [Vec<DQuat>; 4] = std::array::from_fn(|_| Vec::with_capacity(total));
    let most = BENDING / rate;
    let mut before: Option<WristAngles> = None;
    let mut cursor = 0;
    let mut rows: Vec<(Posed, DQuat)> = Vec::with_capacity(total);
    let mut hangs: Vec<WristAngles> = Vec::with_capacity(total);
    for (frame, &plane) in turns.iter().enumerate() {
        let overlay = wanted.wrist[frame];
        let aim = Aim {
            stage,
            hand,
            held: &held,
            limits,
            point: wanted.points[frame],
            // The point is placed by the hand as it is without its turns about the wrist.
            offset: match overlay {
                Some(turn) => turn.inverse() * wanted.offsets[frame],
                None => wanted.offsets[frame],
            },
            turned: match overlay {
                Some(turn) => (wanted.turns[frame] * turn).normalize(),
                None => wanted.turns[frame].normalize(),
            },
            plane,
            outlines: outlines.at(frame, &mut cursor),
        };
        let got = aim.reach(before.as_ref(), most);
        before = Some(got.angles);
        if signing(plan, frame as f64 / rate) {
            fit.pushed = fit.pushed.max(got.pushed);
            fit.turned = fit.turned.max(got.rotation.angle_between(aim.turned));
            if got.residual > fit.residual {
                (fit.residual, fit.frame) = (got.residual, frame);
            }
        }
        rows.push((got.posed, got.rotation));
        hangs.push(got.angles);
    }
    let most = FASTEST * hand.rig.length() / rate;
    let mut cursor = 0;
    let bending = BENDING / rate;
    for frame in steady(&mut rows, most, rate) {
        let aim = Aim {
            stage,
            hand,
            held: &held,
            limits,
            point: wanted.points[frame],
            offset: wanted.offsets[frame],
            turned: rows[frame].1,
            plane: turns[frame],
            outlines: outlines.at(frame, &mut cursor),
        };
        let posed = hand.rig.reach(rows[frame].0.wrist, turns[frame], limits);
        let before = frame.checked_sub(1).map(|before| hangs[before]);
        let got = aim.finish(posed, rows[frame].1, before.as_ref(), bending, 0.0);
        rows[frame] = (got.posed, got.rotation);
        hangs[frame] = got.angles;
    }
    for (posed, rotation) in &rows {
        let rotations = hand.rig.rotations(posed, *rotation);
        for (column, rotation) in arm.iter_mut().zip(rotations) {
            column.push(rotation);
        }
    }
    (arm, fit)
}

/// Spreads what goes faster than `most` a frame over the time around it; returns the frames changed.
///
/// Where what a hand gives way to changes at once (the other side of a limit, the edge of the trunk),
/// so would the hand.
fn steady(rows: &mut [(Posed, DQuat)], most: f64, rate: f64) -> Vec<usize> {
    let turned = BENDING * 1.4 / rate;
    let near = ((AROUND * rate).ceil() as usize).max(1);
    let mut changed = Vec::new();
    for _ in 0..4 {
        let jumps = |n: &usize| {
            let (a, b) = (&rows[*n - 1], &rows[*n]);
            a.0.wrist.distance(b.0.wrist) > most || a.1.angle_between(b.1) > turned
        };
        let found: Vec<usize> = (1..rows.len()).filter(jumps).collect();
        if found.is_empty() {
            break;
        }
        for run in found.chunk_by(|a, b| b - a <= near) {
            let first = run[0].saturating_sub(near);
            let last = (run[run.len() - 1] + near).min(rows.len() - 1);
            let (from, to) = (rows[first], rows[last]);
            for (n, row) in rows[first + 1..last].iter_mut().enumerate() {
                let share = smooth((n + 1) as f64 / (last - first) as f64);
                row.0.wrist = from.0.wrist.lerp(to.0.wrist, share);
                row.1 = from.1.slerp(to.1, share).normalize();
                changed.push(first + 1 + n);
            }
        }
    }
    changed.sort_unstable();
    changed.dedup();
    changed
}

/// Tells whether a sign is made at a time, not the way to it.
fn signing(plan: &Plan, time: f64) -> bool {
    plan.signs
        .iter()
        .any(|sign| (sign.from..=sign.to).contains(&time))
}

/// Where a hand should be in one frame.
struct Aim<'a> {
    stage: &'a Stage,
    hand: &'a Hand,
    held: &'a Held,
    limits: &'a Limits,
    point: DVec3,
    offset: DVec3,
    turned: DQuat,
    plane: f64,
    outlines: [&'a [DVec3]; 2],
}

/// Where it came.
struct Got {
    posed: Posed,
    rotation: DQuat,
    angles: WristAngles,
    residual: f64,
    pushed: f64,
}

fn smooth(share: f64) -> f64 {
    let share = share.clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

/// How often a hand that gives way is brought to its place again.
const TRIES: usize = 14;

impl Aim<'_> {
    /// Brings the arm there: the hand's orientation gives way to the wrist, its point stays, and what
    /// would enter the trunk is moved out of it.
    fn reach(&self, before: Option<&WristAngles>, most: f64) -> Got {
        let rig = &self.hand.rig;
        let out = self.stage.torso.forward();
        // A hand that is placed by a fingertip turns about it; one placed by its palm is moved.
        let pivot = smooth((self.offset.length() / self.hand.length() - 0.55) / 0.25);
        let mut turned = self.turned;
        let mut pushed = 0.0;
        let mut wrist = self.point - turned * self.offset;
        let mut posed = rig.reach(wrist, self.plane, self.limits);
        let mut round = 0;
        loop {
            let asked = rig.wrist(&posed, turned, self.held, self.limits);
            let angles = asked.allowed(self.limits, before, most);
            let rotation = if angles == asked {
                turned
            } else {
                rig.hung(&posed, &angles, self.held)
            };
            let deep = self.depth(posed.wrist, rotation).max(0.0);
            let amiss = posed.wrist - wrist + out * deep;
            let mut about = rotation;
            if pivot > 0.0 && amiss.length() > 1e-4 {
                let from = (wrist - self.point).normalize_or(out);
                let to = (wrist + amiss - self.point).normalize_or(from);
                let turn = DQuat::from_rotation_arc(from, to);
                let turn = DQuat::IDENTITY.slerp(turn, pivot);
                turned = (turn * turned).normalize();
                about = turn * rotation;
            }
            pushed += deep * (1.0 - pivot);
            let goal = self.point + out * pushed;
            let step = goal - rotation * self.offset - wrist;
            round += 1;
            let done =
                step.length() < 3e-4 && deep < 1e-4 && (pivot == 0.0 || amiss.length() < 3e-4);
            if done || round == TRIES {
                posed = rig.reach(goal - rotation * self.offset, self.plane, self.limits);
                return self.finish(posed, rotation, before, most, pushed);
            }
            wrist += (goal - about * self.offset - wrist) * 0.8;
            posed = rig.reach(wrist, self.plane, self.limits);
        }
    }

    /// Keeps a posture within the ranges of the wrist and out of the trunk: these two come before
    /// the place of the point.
    fn finish(
        &self,
        mut posed: Posed,
        mut rotation: DQuat,
        before: Option<&WristAngles>,
        most: f64,
        mut pushed: f64,
    ) -> Got {
        let rig = &self.hand.rig;
        let asked = rotation;
        let mut angles = WristAngles::default();
        for round in 0..4 {
            let hangs = rig.wrist(&posed, asked, self.held, self.limits);
            angles = hangs.allowed(self.limits, before, most);
            rotation = if angles == hangs {
                asked
            } else {
                rig.hung(&posed, &angles, self.held)
            };
            let left = self.depth(posed.wrist, rotation).max(0.0);
            if left < 1e-4 || round == 3 {
                break;
            }
            pushed += left;
            let wrist = posed.wrist + self.stage.torso.forward() * left;
            posed = rig.reach(wrist, self.plane, self.limits);
        }
        Got {
            posed,
            rotation,
            angles,
            residual: (posed.wrist + rotation * self.offset).distance(self.point),
            pushed,
        }
    }

    /// Returns how deep the hand's outline is in the trunk.
    fn depth(&self, wrist: DVec3, turned: DQuat) -> f64 {
        let torso = &self.stage.torso;
        if torso.depth(wrist, 1.3 * self.hand.length()) <= 0.0 {
            return 0.0;
        }
        let [a, b] = self.outlines;
        let count = if std::ptr::eq(a, b) { 1 } else { 2 };
        let points = [a, b].into_iter().take(count).flatten();
        points
            .map(|&point| torso.depth(wrist + turned * point, MARGIN))
            .fold(0.0, f64::max)
    }
}

/// Returns the turn of the arm's plane at each frame: weighed now and then, smooth between.
fn planes(stage: &Stage, hand: &Hand, wanted: &Wanted, limits: &Limits, rate: f64) -> Vec<f64> {
    let total = wanted.points.len();
    let step = ((WEIGHED * rate).round() as usize).max(1);
    let held: Held = hand.held();
    let mut last: Option<(DVec3, DQuat, f64)> = None;
    let mut keys: Vec<f64> = (0..total.div_ceil(step) + 1)
        .map(|n| {
            let frame = (n * step).min(total - 1);
            let turned = wanted.turns[frame];
            let wrist = wanted.points[frame] - turned * wanted.offsets[frame];
            let out = stage.torso.depth(wrist, 0.03).max(0.0);
            let wrist = wrist + stage.torso.forward() * out;
            if let Some((at, how, turn)) = last
                && at == wrist
                && how == turned
            {
                return turn;
            }
            let turn = hand.rig.turn(wrist, turned, &held, limits, &stage.torso);
            last = Some((wrist, turned, turn));
            turn
        })
        .collect();
    let most = SWIVEL * step as f64 / rate;
    for n in 1..keys.len() {
        keys[n] = keys[n].clamp(keys[n - 1] - most, keys[n - 1] + most);
    }
    for n in (1..keys.len()).rev() {
        keys[n - 1] = keys[n - 1].clamp(keys[n] - most, keys[n] + most);
    }
    let key = |n: isize| keys[n.clamp(0, keys.len() as isize - 1) as usize];
    (0..total)
        .map(|frame| {
            let n = (frame / step) as isize;
            let t = (frame % step) as f64 / step as f64;
            // A uniform cubic B-spline: smoother than its keys.
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
