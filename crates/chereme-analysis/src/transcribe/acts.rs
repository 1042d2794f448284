//! Segments and classifies the movement of one hand: cuts it at minima of speed, names each act and folds
//! repetitions.

mod cuts;
mod fold;
mod sway;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_1_SQRT_2, TAU};
use std::ops::RangeInclusive;

use chereme_sign::hamnosys::RepeatKind;
use glam::DVec3;

use super::aim;
use super::transcribe_path::{FittedPath, PathForm, fit_path_form};
use super::transcribe_scene::{HandTrajectory, SignerScene, polyline_length};
use crate::transcribe::transcribe_tuned::tuned;
use cuts::{cut_at_minima, find_moving_stretches, is_brief, join_continued_stretches, select_intended_paths};
use fold::fold_repeated_acts;
use sway::{find_finger_play, find_wrist_sway};

pub(super) use cuts::find_signing_frames;
pub(super) use sway::{HandSway, wrist_name};

/// One act of a hand: a path, a movement of wrist or fingers, or a change of posture.
#[derive(Debug, Clone)]
pub(super) struct TranscribedAct {
    /// First and last frame of its first execution.
    pub(super) frames: RangeInclusive<usize>,
    pub(super) kind: ActKind,
    /// The movement of wrist or fingers that goes on during the path.
    pub(super) with: Option<HandSway>,
    /// Whether the hand ends in another orientation.
    pub(super) turned: bool,
    /// Whether the hand ends in another handshape.
    pub(super) reshaped: bool,
    /// How the act is repeated.
    pub(super) repeat: Option<RepeatKind>,
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
    Path(Box<FittedPath>),
    /// Wrist or fingers move to and fro while the hand stays in place.
    Sway(HandSway),
    /// The hand changes orientation or handshape while it stays in place.
    Change,
}

impl TranscribedAct {
    fn first_act_frame(&self) -> usize {
        *self.frames.start()
    }

    fn last_act_frame(&self) -> usize {
        *self.frames.end()
    }
}

/// Queries about the parts of a hand whose path notation may describe, and tolerances.
pub(super) struct HandPartQueries<'a> {
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
pub(super) struct MovingHand<'a> {
    pub(super) track: &'a HandTrajectory,
    points: Vec<Vec<DVec3>>,
    /// The number of leading `points` that notation may refer to.
    meant: usize,
    seen: HandPartQueries<'a>,
    /// Cache of `seen.parts`, by contact frame and frame: positions in the hand's own space.
    known: RefCell<BTreeMap<(usize, usize), Vec<DVec3>>>,
}

impl<'a> MovingHand<'a> {
    /// Tracks the parts that are in contact where the sign begins or ends, and the palm; also possible
    /// pivots: the wrist and `pivots`, each a position and its frame.
    pub(super) fn new(
        track: &'a HandTrajectory,
        ends: [usize; 2],
        seen: HandPartQueries<'a>,
        pivots: &[(DVec3, usize)],
    ) -> Self {
        let carried = |&(at, frame): &(DVec3, usize)| track.carried_point_trajectory(at, frame);
        let mut known_parts = BTreeMap::new();
        let mut points = Vec::new();
        for frame in ends {
            let end_parts = (seen.parts)(frame, frame);
            points.extend(end_parts.iter().map(|&at| track.carried_point_trajectory(at, frame)));
            known_parts.insert((frame, frame), to_hand_space(track, &end_parts, frame));
        }
        points.push(track.palm.clone());
        let part_count = points.len();
        points.push(track.wrist.clone());
        points.extend(pivots.iter().map(carried));
        Self {
            track,
            points,
            meant: part_count,
            seen,
            known: RefCell::new(known_parts),
        }
    }

    /// Fits a path to the trajectory of each point that notation may refer to, from frame `first` to
    /// `last`, and returns the one with the lowest [`fitted_path_score`](Self::fitted_path_score).
    fn fit_hand_path(&self, first: usize, last: usize) -> FittedPath {
        let fits = self.points[..self.meant]
            .iter()
            .map(|trajectory| fit_path_form(&trajectory[first..=last], self.preferred_path_error()));
        fits.min_by(|a, b| self.fitted_path_score(a).total_cmp(&self.fitted_path_score(b)))
            .unwrap_or_else(|| fit_path_form(&self.track.palm[first..=last], self.preferred_path_error()))
    }

    /// Like [`fit_hand_path`](Self::fit_hand_path), but if the hand turns or changes its shape on the way, the path may begin
    /// at one part of the hand and end at another. The reference point then passes from the one to the
    /// other in step with the turn, or within the first `acts.lets_go` seconds.
    fn fit_passing(&self, first: usize, last: usize) -> FittedPath {
        let plain = self.fit_hand_path(first, last);
        let track = self.track;
        let turns = track.hand_turn_vector(first, last).length();
        let changes = track.finger_angle_change(first, last);
        let reshaped = tuned().acts.reshaped * self.seen.loose;
        // A straight path cannot become simpler, and a hand that neither turns nor reshapes keeps its part.
        if matches!(plain.path, PathForm::Straight { .. }) || (turns < tuned().acts.turned && changes < reshaped) {
            return plain;
        }
        let done = |n: usize| {
            let share = if turns < tuned().acts.turned {
                track.finger_angle_change(first, n) / changes
            } else {
                track.hand_turn_vector(first, n).length() / turns
            };
            share.min(1.0)
        };
        let by_turn: Vec<f64> = (first..=last).map(done).collect();
        let soon = |n: usize| ((n - first) as f64 / self.seen.lets_go as f64).min(1.0);
        let by_time: Vec<f64> = (first..=last).map(soon).collect();
        let from = self.own_parts(first, first);
        let mut to: Vec<(DVec3, f64)> = Vec::new();
        to.extend(self.own_parts(last, last).into_iter().map(|at| (at, 0.0)));
        // A part of the first posture may stand elsewhere in the new handshape.
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
                // One part from beginning to end is the plain path.
                if a.distance(*b) < 1e-3 {
                    continue;
                }
                let weight = (less / tuned().acts.per).exp();
                let mut take = |trajectory: Vec<DVec3>| {
                    let best_fit = fit_path_form(&trajectory, self.preferred_path_error());
                    // No signer draws a circle with one part after the other; and less likely parts count
                    // only if they make the path straight.
                    let taken = match best_fit.path {
                        PathForm::Straight { .. } => true,
                        PathForm::Circle { .. } => false,
                        _ => n < likely,
                    };
                    if taken && weight * self.fitted_path_score(&best_fit) < self.fitted_path_score(&best) {
                        best = best_fit;
                    }
                };
                let passes = |done: &[f64], let_go: bool| {
                    let frames = (first..=last).zip(done);
                    let part_points = frames.map(|(n, &share)| {
                        let part = a.lerp(*b, share);
                        let carried_point = track.wrist[n] + track.turned[n] * part;
                        carried_point
                            - if let_go {
                                track.turned[first] * (part - *a)
                            } else {
                                DVec3::ZERO
                            }
                    });
                    part_points.collect::<Vec<_>>()
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
    fn preferred_path_error(&self) -> f64 {
        tuned().path.exact * self.seen.loose * self.seen.loose
    }

    /// Returns the score of a path: its error (m), multiplied by a factor for the notation that it takes;
    /// lower is better.
    fn fitted_path_score(&self, fitted: &FittedPath) -> f64 {
        let aside = tuned().acts.aside * notated_direction_distance(&fitted.path) / self.seen.loose.powi(4);
        (fitted.residual.hypot(aside) + self.preferred_path_error()) * path_notation_factor(&fitted.path)
    }

    /// Returns the less likely parts of frame `meant`, as positions in frame `frame` in the hand's own
    /// space, each with its penalty in nepers.
    fn other_parts(&self, meant: usize, frame: usize) -> Vec<(DVec3, f64)> {
        let (at, less): (Vec<_>, Vec<_>) = (self.seen.others)(meant, frame).into_iter().unzip();
        to_hand_space(self.track, &at, frame).into_iter().zip(less).collect()
    }

    /// Returns the palm, then the parts in contact in frame `meant`, as positions in frame `frame` in the
    /// hand's own space.
    fn own_parts(&self, meant: usize, frame: usize) -> Vec<DVec3> {
        let track = self.track;
        let mut all = to_hand_space(track, &[track.palm[frame]], frame);
        let mut part_cache = self.known.borrow_mut();
        let parts = part_cache
            .entry((meant, frame))
            .or_insert_with(|| to_hand_space(track, &(self.seen.parts)(meant, frame), frame));
        all.extend(parts.iter());
        all
    }

    /// Returns the length of the shortest trajectory among the points, in metres.
    fn shortest(&self, first: usize, last: usize) -> f64 {
        let lengths = self
            .points
            .iter()
            .map(|trajectory| polyline_length(&trajectory[first..=last]));
        lengths.fold(f64::MAX, f64::min)
    }
}

/// Converts positions of a frame to the hand's own space.
pub(super) fn to_hand_space(track: &HandTrajectory, at: &[DVec3], frame: usize) -> Vec<DVec3> {
    let back = track.turned[frame].inverse();
    let from = track.wrist[frame];
    at.iter().map(|at| back * (*at - from)).collect()
}

/// Returns the distance between a path and the same one along the nearest direction that notation has: the
/// root of the mean square over the path, in metres.
fn notated_direction_distance(path: &PathForm) -> f64 {
    let course = path.path_direction().normalize_or(DVec3::Z);
    let off = aim::nearest_notated_aim(course, false).residual.to_radians().sin();
    match path {
        // The mean square of a sine over whole turns is one half.
        PathForm::Circle { long, .. } => off * long.length() * FRAC_1_SQRT_2,
        // The mean square of a distance that grows evenly is a third of its greatest.
        _ => off * path.path_chord().length() / 3f64.sqrt(),
    }
}

/// Factor on the error of a path for the notation it takes; 1 for a straight path.
fn path_notation_factor(path: &PathForm) -> f64 {
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
pub(super) fn find_hand_acts(
    scene: &SignerScene<'_>,
    mover: &MovingHand<'_>,
    frames: &RangeInclusive<usize>,
) -> (Vec<TranscribedAct>, Option<usize>) {
    let (first, last) = (*frames.start(), *frames.end());
    if last <= first {
        return (Vec::new(), None);
    }
    let track = mover.track;
    let plays = find_finger_play(scene, track, first, last);
    let mut found_acts = Vec::new();
    let mut from = first;
    let (mut stretches, speeds) = find_moving_stretches(scene, mover, first, last);
    // A hand that only turns about its wrist has no path, though its points move.
    if sways(scene, mover, first, last) {
        stretches.clear();
    }
    let joined_stretches = join_continued_stretches(scene, mover, &stretches, |n| speeds[n - first]);
    let stretches = select_intended_paths(scene, mover, joined_stretches);
    let left = stretches.first().map(|stretch| *stretch.start());
    let several = stretches.len() > 1;
    let mut begun = None;
    for stretch in stretches {
        let (start, end) = (*stretch.start(), *stretch.end());
        // A single brief path may be all that the sign has.
        if several && is_brief(scene, mover, start, end) {
            from = end;
            continue;
        }
        let before = on_the_spot(scene, track, from, start, plays.as_ref());
        let goes = going(scene, mover, start, end, plays.as_ref());
        if lulls(scene, &goes, &before, start - from) {
            begun = begun.or(before.first().map(TranscribedAct::first_act_frame));
        } else {
            found_acts.extend(before);
        }
        found_acts.push(goes);
        from = end;
    }
    let after = on_the_spot(scene, track, from, last, plays.as_ref());
    let with = found_acts.last();
    if !with.is_some_and(|with| lulls(scene, with, &after, last - from)) {
        found_acts.extend(after);
    }
    let folded_acts = fold_repeated_acts(scene, track, found_acts);
    let first = folded_acts.first().map(TranscribedAct::first_act_frame);
    let start = first.into_iter().chain(left).chain(begun).min();
    (folded_acts, start.filter(|_| first.is_some()))
}

/// Returns whether the acts in the `frames` before or after a path only continue the movement of wrist or
/// fingers during that path.
fn lulls(scene: &SignerScene<'_>, path: &TranscribedAct, beside: &[TranscribedAct], frames: usize) -> bool {
    let same = |act: &TranscribedAct| match (&act.kind, &path.with) {
        (ActKind::Sway(HandSway::Play { .. }), Some(HandSway::Play { .. })) => true,
        (ActKind::Sway(HandSway::Wrist { .. }) | ActKind::Change, Some(HandSway::Wrist { .. })) => !act.reshaped,
        _ => false,
    };
    scene.frames_to_seconds(frames) < tuned().acts.lull && beside.iter().all(same)
}

/// Returns whether the hand does nothing but turn to and fro about the wrist, or about a point near it.
fn sways(scene: &SignerScene<'_>, mover: &MovingHand<'_>, first: usize, last: usize) -> bool {
    let Some(HandSway::Wrist { angle, cycles, .. }) = find_wrist_sway(scene, mover.track, first, last) else {
        return false;
    };
    let extent = |trajectory: &Vec<DVec3>| {
        let far = trajectory[first..=last].iter().map(|at| at.distance(trajectory[first]));
        far.fold(0.0, f64::max)
    };
    let least = mover.points.iter().map(extent).fold(f64::MAX, f64::min);
    cycles >= 1.4 && least < (tuned().acts.lever * angle).min(tuned().acts.sways)
}

fn going(
    scene: &SignerScene<'_>,
    mover: &MovingHand<'_>,
    first: usize,
    last: usize,
    plays: Option<&HandSway>,
) -> TranscribedAct {
    let track = mover.track;
    let often = |sway: &HandSway| matches!(sway, HandSway::Wrist { cycles, .. } if *cycles >= 1.4);
    let wrist = find_wrist_sway(scene, track, first, last).filter(often);
    // The wrist carries a hand that moves to and fro on its path.
    let fitted = match &wrist {
        Some(_) => fit_path_form(&track.wrist[first..=last], mover.preferred_path_error()),
        None => mover.fit_passing(first, last),
    };
    let with = plays.cloned().or(wrist);
    // Such a hand ends in another orientation only if it ends farther off than the movement itself takes
    // it.
    let least = match &with {
        Some(HandSway::Wrist { angle, .. }) => tuned().acts.turned.max(1.3 * angle),
        _ => tuned().acts.turned,
    };
    TranscribedAct {
        frames: first..=last,
        turned: track.hand_turn_vector(first, last).length() > least,
        reshaped: plays.is_none() && track.finger_angle_change(first, last) > tuned().acts.reshaped * scene.loose,
        kind: ActKind::Path(Box::new(fitted)),
        with,
        repeat: None,
        times: 1,
        grows: None,
        until: last.min(scene.clip.clip_frame_count() - 1),
    }
}

/// Returns the acts of a hand that stays in place.
fn on_the_spot(
    scene: &SignerScene<'_>,
    track: &HandTrajectory,
    first: usize,
    last: usize,
    plays: Option<&HandSway>,
) -> Vec<TranscribedAct> {
    // The hand only pauses between two paths.
    if last < first + scene.seconds_to_frames(tuned().acts.gap) {
        return Vec::new();
    }
    let act = |frames: RangeInclusive<usize>, kind: ActKind| {
        let (first, last) = (*frames.start(), *frames.end());
        let change = matches!(kind, ActKind::Change);
        TranscribedAct {
            turned: change && track.hand_turn_vector(first, last).length() > tuned().acts.turned,
            reshaped: change && track.finger_angle_change(first, last) > tuned().acts.reshaped * scene.loose,
            until: last,
            frames,
            kind,
            with: None,
            repeat: None,
            times: 1,
            grows: None,
        }
    };
    // Fingers that play over the whole stretch explain every change of their shape.
    if let Some(plays) = plays {
        return vec![act(first..=last, ActKind::Sway(plays.clone()))];
    }
    let speeds: Vec<f64> = (first..=last)
        .map(|n| {
            let (a, b) = (n.saturating_sub(1).max(first), (n + 1).min(last));
            let turn = track.hand_turn_vector(a, b).length();
            turn.hypot(track.finger_angle_change(a, b)) / scene.frames_to_seconds((b - a).max(1))
        })
        .collect();
    let often = |sway: &HandSway| matches!(sway, HandSway::Wrist { cycles, .. } if *cycles >= 1.0);
    if let Some(sway) = find_wrist_sway(scene, track, first, last).filter(often) {
        return vec![act(first..=last, ActKind::Sway(sway))];
    }
    let changes = cut_at_minima(scene, &speeds, tuned().cuts.least.1, first);
    let change_acts: Vec<TranscribedAct> = changes
        .into_iter()
        .map(|frames| act(frames, ActKind::Change))
        .filter(|act| act.turned || act.reshaped)
        .collect();
    if change_acts.is_empty() {
        return to_and_fro(scene, track, first, last, act);
    }
    change_acts
}

/// Returns small changes of a hand that stays in place, if at least three of them alternate. A single one
/// would be too small to count.
fn to_and_fro(
    scene: &SignerScene<'_>,
    track: &HandTrajectory,
    first: usize,
    last: usize,
    act: impl Fn(RangeInclusive<usize>, ActKind) -> TranscribedAct,
) -> Vec<TranscribedAct> {
    let changed = |a: usize, b: usize| [track.hand_turn_vector(a, b).length(), track.finger_angle_change(a, b)];
    let speeds: Vec<f64> = (first..=last)
        .map(|n| {
            let (a, b) = (n.saturating_sub(1).max(first), (n + 1).min(last));
            let [turn, shape] = changed(a, b);
            turn.hypot(shape) / scene.frames_to_seconds((b - a).max(1))
        })
        .collect();
    let cut_acts: Vec<TranscribedAct> =
        cut_at_minima(scene, &speeds, tuned().cuts.least.1 * (1.0 / tuned().acts.again), first)
            .into_iter()
            .map(|frames| {
                let [turn, shape] = changed(*frames.start(), *frames.end());
                TranscribedAct {
                    turned: turn > tuned().acts.turned * (1.0 / tuned().acts.again),
                    reshaped: shape > tuned().acts.reshaped * scene.loose * (1.0 / tuned().acts.again),
                    ..act(frames, ActKind::Change)
                }
            })
            .filter(|act| act.turned || act.reshaped)
            .collect();
    let back = |pair: &[TranscribedAct]| {
        let [a, b] = [&pair[0], &pair[1]];
        let [turn, shape] = changed(a.first_act_frame(), b.last_act_frame());
        let [there, reshaped] = changed(a.first_act_frame(), a.last_act_frame());
        // The second act undoes more than half of the first.
        turn.hypot(shape) < 0.5 * there.hypot(reshaped)
    };
    if cut_acts.len() >= 3 && cut_acts.windows(2).all(back) {
        return cut_acts;
    }
    Vec::new()
}
