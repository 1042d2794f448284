//! Cuts a hand's movement: at rest, and at minima of its speed.

use std::ops::RangeInclusive;

use glam::DVec3;

use super::super::transcribe_path::PathForm;
use super::super::transcribe_scene::{HandTrajectory, SignerScene};
use super::{HandPartQueries, MovingHand};
use crate::strokes::{between_minima, gaussian_smoothed_speeds};
use crate::transcribe::transcribe_tuned::tuned;

/// Returns the frames in which a hand signs, without its paths from and to rest.
pub(in crate::transcribe) fn find_signing_frames(
    scene: &SignerScene<'_>,
    track: &HandTrajectory,
) -> RangeInclusive<usize> {
    let last = track.palm.len() - 1;
    let nothing = HandPartQueries {
        parts: &|_, _| Vec::new(),
        others: &|_, _| Vec::new(),
        lets_go: 1,
        loose: scene.loose,
    };
    let mover = MovingHand::new(track, [0, last], nothing, &[]);
    let (stretches, speeds) = find_moving_stretches(scene, &mover, 0, last);
    let on = |a: &RangeInclusive<usize>, b: &RangeInclusive<usize>| {
        slows(scene, [a, b], |n| speeds[n], tuned().cuts.slows) && path_turn_angle(track, [a, b]) < tuned().cuts.turns
    };
    let mut first = 0;
    let mut end = last;
    // Hands in the lap or folded before the belly are at rest if they later rise far from there.
    let lies = |low: usize, high: usize| {
        let (low, high) = (track.palm[low].y, track.palm[high].y);
        low < tuned().cuts.lap * scene.arm && high - low > tuned().cuts.rise * scene.arm
    };
    let rests = |low: usize, high: usize| track.rests[low] || lies(low, high);
    // A hand may stir while it rests, before it rises or after it sinks.
    let stirs = |stretch: &&RangeInclusive<usize>| {
        let mut ends = [*stretch.start(), *stretch.end()].into_iter();
        ends.all(|n| track.rests[n] || track.palm[n].y < tuned().cuts.lap * scene.arm)
    };
    let rises = |n: &usize| {
        stretches
            .get(*n)
            .is_some_and(|range| rests(*range.start(), *range.end()))
    };
    let stirring = stretches.iter().take_while(stirs).count();
    if let Some(mut n) = [stirring, 0].into_iter().find(rises) {
        while n + 1 < stretches.len() && on(&stretches[n], &stretches[n + 1]) {
            n += 1;
        }
        first = stillest(scene, &speeds, *stretches[n].end());
    }
    let sinks = |n: &usize| {
        let stretch = stretches.get(*n);
        stretch.is_some_and(|range| rests(*range.end(), *range.start()) && *range.start() >= first)
    };
    let stirring = stretches.iter().rev().take_while(stirs).count();
    // Without stretches this wraps around to a number at which there is none.
    let from = |stirring: usize| stretches.len().wrapping_sub(stirring + 1);
    if let Some(mut n) = [from(stirring), from(0)].into_iter().find(sinks) {
        while n > 0 && *stretches[n - 1].start() >= first && on(&stretches[n - 1], &stretches[n]) {
            n -= 1;
        }
        end = stillest(scene, &speeds, *stretches[n].start());
    }
    first..=end.max(first)
}

/// Returns the frame in which the hand is slowest, near a minimum of its smoothed speed: smoothing moves the minimum
/// away from the faster of the two paths that meet there.
fn stillest(scene: &SignerScene<'_>, speeds: &[f64], at: usize) -> usize {
    let reach = scene.seconds_to_frames(tuned().cuts.near);
    let near = at.saturating_sub(reach)..(at + reach + 1).min(speeds.len());
    near.min_by(|&a, &b| speeds[a].total_cmp(&speeds[b])).unwrap_or(at)
}

/// Returns the stretches in which the hand moves, cut at minima of its speed, and the speed (m/s) in each
/// frame.
pub(super) fn find_moving_stretches(
    scene: &SignerScene<'_>,
    mover: &MovingHand<'_>,
    first: usize,
    last: usize,
) -> (Vec<RangeInclusive<usize>>, Vec<f64>) {
    let speed = |points: &[DVec3], n: usize| {
        let (a, b) = (n.saturating_sub(1).max(first), (n + 1).min(last));
        points[a].distance(points[b]) / scene.frames_to_seconds((b - a).max(1))
    };
    // A hand that turns about a point of its own does not move from its place.
    let slowest = |n: usize| {
        let speeds = mover.points.iter().map(|points| speed(points, n));
        speeds.fold(f64::MAX, f64::min)
    };
    let speeds: Vec<f64> = (first..=last).map(slowest).collect();
    let mut kept_stretches = cut_at_minima(scene, &speeds, tuned().cuts.least.0 * scene.arm, first);
    kept_stretches.retain(|stretch| mover.shortest(*stretch.start(), *stretch.end()) > tuned().cuts.short * scene.arm);
    (kept_stretches, speeds)
}

/// Cuts at minima of speed; before the first and after the last frame the speed is taken as zero.
pub(super) fn cut_at_minima(
    scene: &SignerScene<'_>,
    speeds: &[f64],
    least: f64,
    first: usize,
) -> Vec<RangeInclusive<usize>> {
    const CUT_PADDING_FRAMES: usize = 2;
    // Stillness on either side lets a movement that fills the stretch begin and end.
    let mut padded = vec![0.0; CUT_PADDING_FRAMES];
    padded.extend(gaussian_smoothed_speeds(speeds, scene.clip));
    padded.extend([0.0; CUT_PADDING_FRAMES]);
    let most = speeds.len() - 1;
    between_minima(&padded, least)
        .into_iter()
        .map(|range| {
            let clip_frame = |n: usize| first + n.saturating_sub(CUT_PADDING_FRAMES).min(most);
            clip_frame(range.start)..=clip_frame(range.end - 1)
        })
        .filter(|range| range.end() > range.start())
        .collect()
}

/// Returns the paths that are long enough to be intended, and shorter ones that alternate back and forth. The least length
/// of an intended path grows with how loosely the hands move ([`SignerScene`]).
pub(super) fn select_intended_paths(
    scene: &SignerScene<'_>,
    mover: &MovingHand<'_>,
    stretches: Vec<RangeInclusive<usize>>,
) -> Vec<RangeInclusive<usize>> {
    let arm = scene.arm;
    let least = (tuned().cuts.short * scene.loose).min(tuned().cuts.faint * scene.language.move_small) * arm;
    let palm = &mover.track.palm;
    let chord = |stretch: &RangeInclusive<usize>| palm[*stretch.end()] - palm[*stretch.start()];
    let back = |a: &RangeInclusive<usize>, b: &RangeInclusive<usize>| {
        let (there, back) = (chord(a), -chord(b));
        let ratio = there.length() / back.length().max(1e-9);
        there.angle_between(back) < tuned().cuts.back.0
            && (1.0 / tuned().cuts.back.1..tuned().cuts.back.1).contains(&ratio)
    };
    let is_sure = |n: usize| {
        let is_returned = |m: usize| stretches.get(m).is_some_and(|other| back(&stretches[n], other));
        mover.shortest(*stretches[n].start(), *stretches[n].end()) >= least
            || is_returned(n + 1)
            || n.checked_sub(1).is_some_and(is_returned)
    };
    let kept: Vec<usize> = (0..stretches.len()).filter(|&n| is_sure(n)).collect();
    kept.into_iter().map(|n| stretches[n].clone()).collect()
}

/// Returns whether a path is too brief and short to be meant: the hand only settles into its posture, or
/// leaves it.
pub(super) fn is_brief(scene: &SignerScene<'_>, mover: &MovingHand<'_>, first: usize, last: usize) -> bool {
    scene.frames_to_seconds(last - first) < tuned().cuts.brief
        && mover.shortest(first, last) < scene.language.move_small * scene.arm
}

/// Joins stretches that together form a circle, a wave or one continued path, and between which the hand
/// does not stop.
pub(super) fn join_continued_stretches(
    scene: &SignerScene<'_>,
    mover: &MovingHand<'_>,
    stretches: &[RangeInclusive<usize>],
    speed: impl Fn(usize) -> f64,
) -> Vec<RangeInclusive<usize>> {
    let mut left = stretches;
    let mut joined_stretches = Vec::new();
    while let Some((first, rest)) = left.split_first() {
        let follow = |stops: f64| {
            let pairs = rest.iter().zip(left);
            let goes_on = pairs.take_while(|(next, it)| slows(scene, [it, next], &speed, stops));
            goes_on.count()
        };
        let (on, round) = (follow(tuned().cuts.stops), follow(tuned().cuts.corners));
        // The longest run that makes one figure comes first.
        let run_length = (1..=round).rev().find(|&more| {
            let path = mover.fit_hand_path(*first.start(), *left[more].end());
            match path.path {
                PathForm::Circle {
                    turns, long, narrow, ..
                } => {
                    let whole_turns = turns.round().max(1.0);
                    let corner = *first.end();
                    let closed = (turns - whole_turns).abs() < tuned().cuts.closed
                        && narrow > tuned().cuts.roundish
                        && mover.track.hand_turn_vector(*first.start(), corner).length() < tuned().acts.turned;
                    let most = if closed { tuned().cuts.flattened } else { 0.15 };
                    (more <= on || closed) && turns / ((more + 1) as f64) < 1.2 && path.residual < most * long.length()
                }
                // Two strokes are there and back, and no wave yet.
                PathForm::Wave { .. } => more >= 2 && more <= on,
                _ => false,
            }
        });
        let onward = || {
            let pairs = rest.iter().zip(left).take(follow(tuned().cuts.slows));
            let goes_on = pairs.take_while(|(next, it)| path_turn_angle(mover.track, [it, next]) < tuned().cuts.onward);
            goes_on.count()
        };
        let joined = run_length.unwrap_or_else(onward);
        joined_stretches.push(*first.start()..=*left[joined].end());
        left = &left[joined + 1..];
    }
    joined_stretches
}

/// Returns whether a hand keeps moving from one path to the next: its speed between them stays above
/// `share` of its top speed on both.
fn slows(
    scene: &SignerScene<'_>,
    [before, next]: [&RangeInclusive<usize>; 2],
    speed: impl Fn(usize) -> f64,
    share: f64,
) -> bool {
    let fastest = |stretch: &RangeInclusive<usize>| stretch.clone().map(&speed).fold(0.0, f64::max);
    let slowest = speed(*before.end()).min(speed(*next.start()));
    next.start() <= &(before.end() + scene.seconds_to_frames(tuned().acts.gap))
        && slowest > share * fastest(before).min(fastest(next))
}

/// Returns the angle (rad) between the directions of two successive paths.
fn path_turn_angle(track: &HandTrajectory, stretches: [&RangeInclusive<usize>; 2]) -> f64 {
    let [before, next] = stretches.map(|stretch| track.palm[*stretch.end()] - track.palm[*stretch.start()]);
    before.angle_between(next)
}
