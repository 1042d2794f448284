//! Segments and classifies the movement of one hand: cuts it at minima of speed, names each act and folds
//! repetitions.

mod cuts;
mod fold;
mod sway;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_1_SQRT_2, TAU};
use std::ops::RangeInclusive;

use chereme_sign::hamnosys::Repeat;
use glam::DVec3;

use super::aim;
use super::path::{Fitted, PathForm, fit};
use super::scene::{HandTrajectory, Scene, length};
use crate::transcribe::tuned::tuned;
use cuts::{cut, is_brief, joined, stretches, sure};
use fold::folded;
use sway::{play, wrist};

pub(super) use cuts::signing;
pub(super) use sway::{Sway, wrist_name};

/// One act of a hand: a path, a movement of wrist or fingers, or a change of posture.
#[derive(Debug, Clone)]
pub(super) struct Act {
    /// First and last frame of its first execution.
    pub(super) frames: RangeInclusive<usize>,
    pub(super) kind: ActKind,
    /// The movement of wrist or fingers that goes on during the path.
    pub(super) with: Option<Sway>,
    /// Whether the hand ends in another orientation.
    pub(super) turned: bool,
    /// Whether the hand ends in another handshape.
    pub(super) reshaped: bool,
    /// How the act is repeated.
    pub(super) repeat: Option<Repeat>,
    /// The number of executions.
    pub(super) times: usize,
    /// Whether its size grows (true) or shrinks (false) from each execution to the next.
    pub(super) grows: Option<bool>,
    /// Last frame of the last execution.
    pub(super) until: usize,
}

/// The kinds of acts.
#[derive(Debug, Clone)]
pub(super) enum ActKind {
    /// The hand moves along a path.
    Path(Box<Fitted>),
    /// Wrist or fingers move to and fro while the hand stays in place.
    Sway(Sway),
    /// The hand changes orientation or handshape while it stays in place.
    Change,
}

impl Act {
    fn first(&self) -> usize {
        *self.frames.start()
    }

    fn last(&self) -> usize {
        *self.frames.end()
    }
}

/// Queries about the parts of a hand whose path notation may describe, and tolerances.
pub(super) struct Seeing<'a> {
    /// `parts(contact, at)` returns the positions in frame `at` of the parts that touch the body or the
    /// other hand in frame `contact`.
    pub(super) parts: &'a dyn Fn(usize, usize) -> Vec<DVec3>,
    /// `others(contact, at)` returns positions in the same way for parts that are less likely to be the
    /// ones in contact, each with its penalty in nepers.
    pub(super) others: &'a dyn Fn(usize, usize) -> Vec<(DVec3, f64)>,
    /// The number of frames in which a part of the hand lets go of its contact.
    pub(super) lets_go: usize,
    /// How loosely the hands follow the notated goals: 1 for synthesised movement, more for captured
    /// hands.
    pub(super) loose: f64,
}

/// A hand with the trajectories of some of its points: those that notation may refer to, and others that
/// the hand may turn about.
pub(super) struct Mover<'a> {
    pub(super) track: &'a HandTrajectory,
    points: Vec<Vec<DVec3>>,
    /// The number of leading `points` that notation may refer to.
    meant: usize,
    seen: Seeing<'a>,
    /// Cache of `seen.parts`, by contact frame and frame: positions in the hand's own space.
    known: RefCell<BTreeMap<(usize, usize), Vec<DVec3>>>,
}

impl<'a> Mover<'a> {
    /// Tracks the parts that are in contact where the sign begins or ends, and the palm; also possible
    /// pivots: the wrist and `pivots`, each a position and its frame.
    pub(super) fn new(
        track: &'a HandTrajectory,
        ends: [usize; 2],
        seen: Seeing<'a>,
        pivots: &[(DVec3, usize)],
    ) -> Self {
        let carried = |&(at, frame): &(DVec3, usize)| track.carried(at, frame);
        let mut known = BTreeMap::new();
        let mut points = Vec::new();
        for frame in ends {
            let at = (seen.parts)(frame, frame);
            points.extend(at.iter().map(|&at| track.carried(at, frame)));
            known.insert((frame, frame), own(track, &at, frame));
        }
        points.push(track.palm.clone());
        let meant = points.len();
        points.push(track.wrist.clone());
        points.extend(pivots.iter().map(carried));
        Self {
            track,
            points,
            meant,
            seen,
            known: RefCell::new(known),
        }
    }

    /// Fits a path to the trajectory of each point that notation may refer to, from frame `first` to
    /// `last`, and returns the one with the lowest [`score`](Self::score).
    fn fit(&self, first: usize, last: usize) -> Fitted {
        let fits = self.points[..self.meant]
            .iter()
            .map(|trajectory| fit(&trajectory[first..=last], self.exact()));
        fits.min_by(|a, b| self.score(a).total_cmp(&self.score(b)))
            .unwrap_or_else(|| fit(&self.track.palm[first..=last], self.exact()))
    }

    /// Like [`fit`](Self::fit), but if the hand turns or changes its shape on the way, the path may begin
    /// at one part of the hand and end at another. The reference point then passes from the one to the
    /// other in step with the turn, or within the first `acts.lets_go` seconds.
    fn fit_passing(&self, first: usize, last: usize) -> Fitted {
        let plain = self.fit(first, last);
        let track = self.track;
        let turns = track.turn(first, last).length();
        let changes = track.reshaped(first, last);
        let reshaped = tuned().acts.reshaped * self.seen.loose;
        if matches!(plain.path, PathForm::Straight { .. })
            || (turns < tuned().acts.turned && changes < reshaped)
        {
            return plain;
        }
        let done = |n: usize| {
            let share = if turns < tuned().acts.turned {
                track.reshaped(first, n) / changes
            } else {
                track.turn(first, n).length() / turns
            };
            share.min(1.0)
        };
        let by_turn: Vec<f64> = (first..=last).map(done).collect();
        let soon = |n: usize| ((n - first) as f64 / self.seen.lets_go as f64).min(1.0);
        let by_time: Vec<f64> = (first..=last).map(soon).collect();
        let from = self.own_parts(first, first);
        let mut to: Vec<(DVec3, f64)> = Vec::new();
        to.extend(self.own_parts(last, last).into_iter().map(|at| (at, 0.0)));
        if changes > reshaped {
            to.extend(self.own_parts(first, last).into_iter().map(|at| (at, 0.0)));
        }
        let likely = to.len();
        to.extend(self.other_parts(last, last));
        if changes > reshaped {
            to.extend(self.other_parts(last, first));
        }
        let mut best = plain;
        for a in &from {
            for (n, (b, less)) in to.iter().enumerate() {
                if a.distance(*b) < 1e-3 {
                    continue;
                }
                let weight = (less / tuned().acts.per).exp();
                let mut take = |trajectory: Vec<DVec3>| {
                    let found = fit(&trajectory, self.exact());
                    // No signer draws a circle with one part after the other; and less likely parts count
                    // only if they make the path straight.
                    let taken = match found.path {
                        PathForm::Straight { .. } => true,
                        PathForm::Circle { .. } => false,
                        _ => n < likely,
                    };
                    if taken && weight * self.score(&found) < self.score(&best) {
                        best = found;
                    }
                };
                let passes = |done: &[f64], let_go: bool| {
                    let frames = (first..=last).zip(done);
                    let at = frames.map(|(n, &share)| {
                        let part = a.lerp(*b, share);
                        let at = track.wrist[n] + track.turned[n] * part;
                        at - if let_go {
                            track.turned[first] * (part - *a)
                        } else {
                            DVec3::ZERO
                        }
                    });
                    at.collect::<Vec<_>>()
                };
                take(passes(&by_turn, false));
                take(passes(&by_time, false));
                // A hand that leaves a contact moves on as a whole: the palm's path counts from there.
                if *b == to[0].0 {
                    take(passes(&by_time, true));
                }
            }
        }
        best
    }

    /// Returns the error of a path (m) below which simpler kinds are preferred.
    fn exact(&self) -> f64 {
        tuned().path.exact * self.seen.loose * self.seen.loose
    }

    /// Returns the score of a path: its error (m), multiplied by a factor for the notation that it takes;
    /// lower is better.
    fn score(&self, fitted: &Fitted) -> f64 {
        let aside = tuned().acts.aside * aside(&fitted.path) / self.seen.loose.powi(4);
        (fitted.residual.hypot(aside) + self.exact()) * plain(&fitted.path)
    }

    /// Returns the less likely parts of frame `meant`, as positions in frame `frame` in the hand's own
    /// space, each with its penalty in nepers.
    fn other_parts(&self, meant: usize, frame: usize) -> Vec<(DVec3, f64)> {
        let (at, less): (Vec<_>, Vec<_>) = (self.seen.others)(meant, frame).into_iter().unzip();
        own(self.track, &at, frame).into_iter().zip(less).collect()
    }

    /// Returns the palm, then the parts in contact in frame `meant`, as positions in frame `frame` in the
    /// hand's own space.
    fn own_parts(&self, meant: usize, frame: usize) -> Vec<DVec3> {
        let track = self.track;
        let mut all = own(track, &[track.palm[frame]], frame);
        let mut known = self.known.borrow_mut();
        let parts = known
            .entry((meant, frame))
            .or_insert_with(|| own(track, &(self.seen.parts)(meant, frame), frame));
        all.extend(parts.iter());
        all
    }

    /// Returns the length of the shortest trajectory among the points, in metres.
    fn shortest(&self, first: usize, last: usize) -> f64 {
        let lengths = self
            .points
            .iter()
            .map(|trajectory| length(&trajectory[first..=last]));
        lengths.fold(f64::MAX, f64::min)
    }
}

/// Converts positions of a frame to the hand's own space.
pub(super) fn own(track: &HandTrajectory, at: &[DVec3], frame: usize) -> Vec<DVec3> {
    let back = track.turned[frame].inverse();
    let from = track.wrist[frame];
    at.iter().map(|at| back * (*at - from)).collect()
}

/// Returns the distance between a path and the same one along the nearest direction that notation has: the
/// root of the mean square over the path, in metres.
fn aside(path: &PathForm) -> f64 {
    let course = path.line().normalize_or(DVec3::Z);
    let off = aim::nearest(course, false).residual.to_radians().sin();
    match path {
        PathForm::Circle { long, .. } => off * long.length() * FRAC_1_SQRT_2,
        _ => off * path.chord().length() / 3f64.sqrt(),
    }
}

/// Factor on the error of a path for the notation it takes; 1 for a straight path.
fn plain(path: &PathForm) -> f64 {
    match path {
        PathForm::Straight { .. } => 1.0,
        PathForm::Arc { .. } => 1.4,
        PathForm::Circle { turns, .. } if turns * TAU < TAU * tuned().path.round => 1.6,
        PathForm::Circle { .. } => 1.2,
        PathForm::Wave { .. } => 1.8,
    }
}

/// Returns what a hand does in a stretch of frames, in order of time.
///
/// The frame is the one in which the hand leaves its first posture.
pub(super) fn acts(
    scene: &Scene<'_>,
    mover: &Mover<'_>,
    frames: &RangeInclusive<usize>,
) -> (Vec<Act>, Option<usize>) {
    let (first, last) = (*frames.start(), *frames.end());
    if last <= first {
        return (Vec::new(), None);
    }
    let track = mover.track;
    let plays = play(scene, track, first, last);
    let mut found = Vec::new();
    let mut from = first;
    let (mut stretches, speeds) = stretches(scene, mover, first, last);
    if sways(scene, mover, first, last) {
        stretches.clear();
    }
    let stretches = joined(scene, mover, &stretches, |n| speeds[n - first]);
    let stretches = sure(scene, mover, stretches);
    let left = stretches.first().map(|stretch| *stretch.start());
    let several = stretches.len() > 1;
    let mut begun = None;
    for stretch in stretches {
        let (start, end) = (*stretch.start(), *stretch.end());
        if several && is_brief(scene, mover, start, end) {
            from = end;
            continue;
        }
        let before = on_the_spot(scene, track, from, start, plays.as_ref());
        let goes = going(scene, mover, start, end, plays.as_ref());
        if lulls(scene, &goes, &before, start - from) {
            begun = begun.or(before.first().map(Act::first));
        } else {
            found.extend(before);
        }
        found.push(goes);
        from = end;
    }
    let after = on_the_spot(scene, track, from, last, plays.as_ref());
    let with = found.last();
    if !with.is_some_and(|with| lulls(scene, with, &after, last - from)) {
        found.extend(after);
    }
    let found = folded(scene, track, found);
    let first = found.first().map(Act::first);
    let start = first.into_iter().chain(left).chain(begun).min();
    (found, start.filter(|_| first.is_some()))
}

/// Returns whether the acts in the `frames` before or after a path only continue the movement of wrist or
/// fingers during that path.
fn lulls(scene: &Scene<'_>, path: &Act, beside: &[Act], frames: usize) -> bool {
    let same = |act: &Act| match (&act.kind, &path.with) {
        (ActKind::Sway(Sway::Play { .. }), Some(Sway::Play { .. })) => true,
        (ActKind::Sway(Sway::Wrist { .. }) | ActKind::Change, Some(Sway::Wrist { .. })) => {
            !act.reshaped
        }
        _ => false,
    };
    scene.seconds(frames) < tuned().acts.lull && beside.iter().all(same)
}

/// Returns whether the hand does nothing but turn to and fro about the wrist, or about a point near it.
fn sways(scene: &Scene<'_>, mover: &Mover<'_>, first: usize, last: usize) -> bool {
    let Some(Sway::Wrist { angle, cycles, .. }) = wrist(scene, mover.track, first, last) else {
        return false;
    };
    let extent = |trajectory: &Vec<DVec3>| {
        let far = trajectory[first..=last]
            .iter()
            .map(|at| at.distance(trajectory[first]));
        far.fold(0.0, f64::max)
    };
    let least = mover.points.iter().map(extent).fold(f64::MAX, f64::min);
    cycles >= 1.4 && least < (tuned().acts.lever * angle).min(tuned().acts.sways)
}

fn going(
    scene: &Scene<'_>,
    mover: &Mover<'_>,
    first: usize,
    last: usize,
    plays: Option<&Sway>,
) -> Act {
    let track = mover.track;
    let often = |sway: &Sway| matches!(sway, Sway::Wrist { cycles, .. } if *cycles >= 1.4);
    let wrist = wrist(scene, track, first, last).filter(often);
    // The wrist carries a hand that moves to and fro on its path.
    let fitted = match &wrist {
        Some(_) => fit(&track.wrist[first..=last], mover.exact()),
        None => mover.fit_passing(first, last),
    };
    let with = plays.cloned().or(wrist);
    // Such a hand ends in another orientation only if it ends farther off than the movement itself takes
    // it.
    let least = match &with {
        Some(Sway::Wrist { angle, .. }) => tuned().acts.turned.max(1.3 * angle),
        _ => tuned().acts.turned,
    };
    Act {
        frames: first..=last,
        turned: track.turn(first, last).length() > least,
        reshaped: plays.is_none()
            && track.reshaped(first, last) > tuned().acts.reshaped * scene.loose,
        kind: ActKind::Path(Box::new(fitted)),
        with,
        repeat: None,
        times: 1,
        grows: None,
        until: last.min(scene.clip.frames() - 1),
    }
}

/// Returns the acts of a hand that stays in place.
fn on_the_spot(
    scene: &Scene<'_>,
    track: &HandTrajectory,
    first: usize,
    last: usize,
    plays: Option<&Sway>,
) -> Vec<Act> {
    if last < first + scene.frames(tuned().acts.gap) {
        return Vec::new();
    }
    let act = |frames: RangeInclusive<usize>, kind: ActKind| {
        let (first, last) = (*frames.start(), *frames.end());
        let change = matches!(kind, ActKind::Change);
        Act {
            turned: change && track.turn(first, last).length() > tuned().acts.turned,
            reshaped: change && track.reshaped(first, last) > tuned().acts.reshaped * scene.loose,
            until: last,
            frames,
            kind,
            with: None,
            repeat: None,
            times: 1,
            grows: None,
        }
    };
    if let Some(plays) = plays {
        return vec![act(first..=last, ActKind::Sway(plays.clone()))];
    }
    let speeds: Vec<f64> = (first..=last)
        .map(|n| {
            let (a, b) = (n.saturating_sub(1).max(first), (n + 1).min(last));
            let turn = track.turn(a, b).length();
            turn.hypot(track.reshaped(a, b)) / scene.seconds((b - a).max(1))
        })
        .collect();
    let often = |sway: &Sway| matches!(sway, Sway::Wrist { cycles, .. } if *cycles >= 1.0);
    if let Some(sway) = wrist(scene, track, first, last).filter(often) {
        return vec![act(first..=last, ActKind::Sway(sway))];
    }
    let changes = cut(scene, &speeds, tuned().cuts.least.1, first);
    let found: Vec<Act> = changes
        .into_iter()
        .map(|frames| act(frames, ActKind::Change))
        .filter(|act| act.turned || act.reshaped)
        .collect();
    if found.is_empty() {
        return to_and_fro(scene, track, first, last, act);
    }
    found
}

/// Returns small changes of a hand that stays in place, if at least three of them alternate. A single one
/// would be too small to count.
fn to_and_fro(
    scene: &Scene<'_>,
    track: &HandTrajectory,
    first: usize,
    last: usize,
    act: impl Fn(RangeInclusive<usize>, ActKind) -> Act,
) -> Vec<Act> {
    let changed = |a: usize, b: usize| [track.turn(a, b).length(), track.reshaped(a, b)];
    let speeds: Vec<f64> = (first..=last)
        .map(|n| {
            let (a, b) = (n.saturating_sub(1).max(first), (n + 1).min(last));
            let [turn, shape] = changed(a, b);
            turn.hypot(shape) / scene.seconds((b - a).max(1))
        })
        .collect();
    let found: Vec<Act> = cut(
        scene,
        &speeds,
        tuned().cuts.least.1 * (1.0 / tuned().acts.again),
        first,
    )
    .into_iter()
    .map(|frames| {
        let [turn, shape] = changed(*frames.start(), *frames.end());
        Act {
            turned: turn > tuned().acts.turned * (1.0 / tuned().acts.again),
            reshaped: shape > tuned().acts.reshaped * scene.loose * (1.0 / tuned().acts.again),
            ..act(frames, ActKind::Change)
        }
    })
    .filter(|act| act.turned || act.reshaped)
    .collect();
    let back = |pair: &[Act]| {
        let [a, b] = [&pair[0], &pair[1]];
        let [turn, shape] = changed(a.first(), b.last());
        let [there, reshaped] = changed(a.first(), a.last());
        turn.hypot(shape) < 0.5 * there.hypot(reshaped)
    };
    if found.len() >= 3 && found.windows(2).all(back) {
        return found;
    }
    Vec::new()
}
