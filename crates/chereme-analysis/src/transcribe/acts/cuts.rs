//! Where a hand's movement is cut: at rest, and at minima of its speed.

use std::ops::RangeInclusive;

use glam::DVec3;

use super::super::scene::{Scene, Track};
use super::super::way::Way;
use super::{GAP, Mover, Seeing, TURNED};
use crate::strokes::{between_minima, smoothed};

/// The least peak of speed of a way in arm lengths a second, and of a turn in radians a second.
pub(super) const LEAST: (f64, f64) = (0.12, 0.35);
/// The least length of a way in arm lengths: a third of a small movement.
const SHORT: f64 = 0.035;
/// A small way that takes less time than this is none, in seconds: the fastest ones take twice as long.
const BRIEF: f64 = 0.11;
/// A hand stops where it is slower than this share of its speed before and after.
const STOPS: f64 = 0.2;
/// It goes on round a corner above this share, where it comes back to where it began by another way: a circle
/// that the body flattens. So near to whole turns, and so wide against its length, that is a loop.
const CORNERS: f64 = 0.12;
const CLOSED: f64 = 0.08;
const ROUNDISH: f64 = 0.5;
const FLATTENED: f64 = 0.22;
/// A hand that only slows down goes on, above this share of its speed before and after, where it goes on within so
/// many radians: as it signs, and from and to rest.
const SLOWS: f64 = 0.35;
const ONWARD: f64 = 0.6;
const TURNS: f64 = 1.05;
/// What loose hands do once must be as long as this share of a small movement.
const FAINT: f64 = 0.5;
/// A way back goes back within so many radians, and its length differs by no more than this factor.
const BACK: (f64, f64) = (0.8, 2.0);
/// The height of hands that rest before the belly against the shoulders, and how far they come up from
/// there, in arm lengths.
pub(in crate::transcribe) const LAP: f64 = -0.65;
const RISE: f64 = 0.4;

/// The frames in which a hand signs, ways from and to rest cut off.
pub(in crate::transcribe) fn signing(scene: &Scene<'_>, track: &Track) -> RangeInclusive<usize> {
    let last = track.palm.len() - 1;
    let nothing = Seeing {
        parts: &|_, _| Vec::new(),
        others: &|_, _| Vec::new(),
        lets_go: 1,
        loose: scene.loose,
    };
    let mover = Mover::new(track, [0, last], nothing, &[]);
    let (ways, speeds) = ways(scene, &mover, 0, last);
    let on = |a: &RangeInclusive<usize>, b: &RangeInclusive<usize>| {
        slows(scene, [a, b], |n| speeds[n], SLOWS) && turn(track, [a, b]) < TURNS
    };
    let mut first = 0;
    let mut end = last;
    // Hands that lie in the lap or are folded before the belly rest, if they come up far from there.
    let lies = |low: usize, high: usize| {
        let (low, high) = (track.palm[low].y, track.palm[high].y);
        low < LAP * scene.arm && high - low > RISE * scene.arm
    };
    let rests = |low: usize, high: usize| track.rests[low] || lies(low, high);
    // A hand may stir while it rests, before it comes up or after it went down.
    let stirs = |way: &&RangeInclusive<usize>| {
        let mut ends = [*way.start(), *way.end()].into_iter();
        ends.all(|n| track.rests[n] || track.palm[n].y < LAP * scene.arm)
    };
    let rises = |n: &usize| ways.get(*n).is_some_and(|it| rests(*it.start(), *it.end()));
    let stirring = ways.iter().take_while(stirs).count();
    if let Some(mut n) = [stirring, 0].into_iter().find(rises) {
        while n + 1 < ways.len() && on(&ways[n], &ways[n + 1]) {
            n += 1;
        }
        first = *ways[n].end();
    }
    let sinks = |n: &usize| {
        let way = ways.get(*n);
        way.is_some_and(|it| rests(*it.end(), *it.start()) && *it.start() >= first)
    };
    let stirring = ways.iter().rev().take_while(stirs).count();
    let from = |stirring: usize| ways.len().wrapping_sub(stirring + 1);
    if let Some(mut n) = [from(stirring), from(0)].into_iter().find(sinks) {
        while n > 0 && *ways[n - 1].start() >= first && on(&ways[n - 1], &ways[n]) {
            n -= 1;
        }
        end = *ways[n].start();
    }
    first..=end.max(first)
}

/// Returns the stretches in which the hand goes somewhere, between minima of its speed, and the speeds.
pub(super) fn ways(
    scene: &Scene<'_>,
    mover: &Mover<'_>,
    first: usize,
    last: usize,
) -> (Vec<RangeInclusive<usize>>, Vec<f64>) {
    let speed = |points: &[DVec3], n: usize| {
        let (a, b) = (n.saturating_sub(1).max(first), (n + 1).min(last));
        points[a].distance(points[b]) / scene.seconds((b - a).max(1))
    };
    let slowest = |n: usize| {
        let speeds = mover.points.iter().map(|points| speed(points, n));
        speeds.fold(f64::MAX, f64::min)
    };
    let speeds: Vec<f64> = (first..=last).map(slowest).collect();
    let mut found = cut(scene, &speeds, LEAST.0 * scene.arm, first);
    found.retain(|way| mover.shortest(*way.start(), *way.end()) > SHORT * scene.arm);
    (found, speeds)
}

/// Cuts at minima of speed; speeds before and after are taken for zero.
pub(super) fn cut(
    scene: &Scene<'_>,
    speeds: &[f64],
    least: f64,
    first: usize,
) -> Vec<RangeInclusive<usize>> {
    const PAD: usize = 2;
    let mut padded = vec![0.0; PAD];
    padded.extend(smoothed(speeds, scene.clip));
    padded.extend([0.0; PAD]);
    let most = speeds.len() - 1;
    between_minima(&padded, least)
        .into_iter()
        .map(|range| {
            let at = |n: usize| first + n.saturating_sub(PAD).min(most);
            at(range.start)..=at(range.end - 1)
        })
        .filter(|range| range.end() > range.start())
        .collect()
}

/// Returns the ways that are long enough to be meant by hands as loose as these, or that are gone back and forth.
pub(super) fn sure(
    scene: &Scene<'_>,
    mover: &Mover<'_>,
    ways: Vec<RangeInclusive<usize>>,
) -> Vec<RangeInclusive<usize>> {
    let arm = scene.arm;
    let least = (SHORT * scene.loose).min(FAINT * scene.language.move_small) * arm;
    let palm = &mover.track.palm;
    let chord = |way: &RangeInclusive<usize>| palm[*way.end()] - palm[*way.start()];
    let back = |a: &RangeInclusive<usize>, b: &RangeInclusive<usize>| {
        let (there, back) = (chord(a), -chord(b));
        let ratio = there.length() / back.length().max(1e-9);
        there.angle_between(back) < BACK.0 && (1.0 / BACK.1..BACK.1).contains(&ratio)
    };
    let is_sure = |n: usize| {
        let beside = |m: usize| ways.get(m).is_some_and(|other| back(&ways[n], other));
        mover.shortest(*ways[n].start(), *ways[n].end()) >= least
            || beside(n + 1)
            || n.checked_sub(1).is_some_and(beside)
    };
    let kept: Vec<usize> = (0..ways.len()).filter(|&n| is_sure(n)).collect();
    kept.into_iter().map(|n| ways[n].clone()).collect()
}

/// Tells whether a way is too brief and short to be meant: the hand comes into its posture, or leaves it.
pub(super) fn is_brief(scene: &Scene<'_>, mover: &Mover<'_>, first: usize, last: usize) -> bool {
    scene.seconds(last - first) < BRIEF
        && mover.shortest(first, last) < scene.language.move_small * scene.arm
}

/// Joins stretches that together are a circle or a wave, and between which the hand does not stop.
pub(super) fn joined(
    scene: &Scene<'_>,
    mover: &Mover<'_>,
    ways: &[RangeInclusive<usize>],
    speed: impl Fn(usize) -> f64,
) -> Vec<RangeInclusive<usize>> {
    let mut left = ways;
    let mut found = Vec::new();
    while let Some((first, rest)) = left.split_first() {
        let follow = |stops: f64| {
            let pairs = rest.iter().zip(left);
            let goes_on = pairs.take_while(|(next, it)| slows(scene, [it, next], &speed, stops));
            goes_on.count()
        };
        let (on, round) = (follow(STOPS), follow(CORNERS));
        let whole = (1..=round).rev().find(|&more| {
            let way = mover.fit(*first.start(), *left[more].end());
            match way.way {
                Way::Circle {
                    turns,
                    long,
                    narrow,
                    ..
                } => {
                    let whole = turns.round().max(1.0);
                    let corner = *first.end();
                    let closed = (turns - whole).abs() < CLOSED
                        && narrow > ROUNDISH
                        && mover.track.turn(*first.start(), corner).length() < TURNED;
                    let most = if closed { FLATTENED } else { 0.15 };
                    (more <= on || closed)
                        && turns / ((more + 1) as f64) < 1.2
                        && way.residual < most * long.length()
                }
                Way::Wave { .. } => more >= 2 && more <= on,
                _ => false,
            }
        });
        let onward = || {
            let pairs = rest.iter().zip(left).take(follow(SLOWS));
            let goes_on = pairs.take_while(|(next, it)| turn(mover.track, [it, next]) < ONWARD);
            goes_on.count()
        };
        let joined = whole.unwrap_or_else(onward);
        found.push(*first.start()..=*left[joined].end());
        left = &left[joined + 1..];
    }
    found
}

/// Tells whether a hand goes on from one way to the next, without being slower between them than a share of its
/// speed on them.
fn slows(
    scene: &Scene<'_>,
    [before, next]: [&RangeInclusive<usize>; 2],
    speed: impl Fn(usize) -> f64,
    share: f64,
) -> bool {
    let fastest = |way: &RangeInclusive<usize>| way.clone().map(&speed).fold(0.0, f64::max);
    let slowest = speed(*before.end()).min(speed(*next.start()));
    next.start() <= &(before.end() + scene.frames(GAP))
        && slowest > share * fastest(before).min(fastest(next))
}

/// Returns by what angle a hand goes on otherwise than before.
fn turn(track: &Track, ways: [&RangeInclusive<usize>; 2]) -> f64 {
    let [before, next] = ways.map(|way| track.palm[*way.end()] - track.palm[*way.start()]);
    before.angle_between(next)
}
