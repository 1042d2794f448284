//! Generated markers as recorded by cameras: with noise and gaps.

use glam::DVec3;

use super::{RATE, Random, Take};
use crate::cue::hand::Frame;
use crate::cue::labels::{CHEEKS, LIPS, THUMB, finger};

/// Adds slow noise of soft tissue and measurement noise.
pub(super) fn seen(
    points: &[Vec<DVec3>],
    soft: f64,
    white: f64,
    random: &mut Random,
) -> Vec<Frame> {
    let keep = (-1.0 / (0.4 * RATE)).exp();
    let markers = points.first().map_or(0, Vec::len);
    let mut slow: Vec<DVec3> = (0..markers).map(|_| random.vector(soft)).collect();
    points
        .iter()
        .map(|frame| {
            frame
                .iter()
                .zip(&mut slow)
                .map(|(at, slow)| {
                    *slow = *slow * keep + random.vector(soft * (1.0 - keep * keep).sqrt());
                    Some(*at + *slow + random.vector(white))
                })
                .collect()
        })
        .collect()
}

/// Hides markers for runs of frames: neighbours on one finger, tips of bent fingers, the face behind the hand, and some
/// at random.
pub(super) fn hide(take: &mut Take, (often, swapped): (f64, f64), random: &mut Random) {
    let frames = take.hand.len();
    let runs = (frames as f64 / RATE * 1.2 * often) as usize;
    for _ in 0..runs {
        let start = random.below(frames);
        let length = 6 + (-random.share().max(1e-9).ln() * 0.2 * RATE) as usize;
        let own = random.below(5);
        let first = if own == 4 { THUMB } else { finger(own) };
        let count = if own == 4 { 6 } else { 8 };
        let from = random.below(count - 1);
        let many = (2 + random.below(3)).min(count - from);
        for frame in take.hand.iter_mut().skip(start).take(length) {
            frame[first + from..first + from + many].fill(None);
        }
    }
    for own in 0..4 {
        let mut gone = false;
        for frame in 0..frames {
            if frame % 24 == 0 {
                gone = random.share() < 0.6 * often;
            }
            let points = &take.true_hand[frame];
            let tip = finger(own) + 7;
            let bent = points[tip].distance(points[finger(own)]) < 45.0;
            if bent && gone {
                take.hand[frame][tip] = None;
            }
        }
    }
    for frame in 0..frames {
        let tip = take.true_hand[frame][finger(1) + 7];
        for marker in LIPS.chain(CHEEKS) {
            let at = take.true_face[frame][marker];
            if at.x < 0.0 && at.distance(tip) < 40.0 {
                take.face[frame][marker] = None;
            }
        }
        for at in take.hand[frame].iter_mut().chain(&mut take.face[frame]) {
            if random.share() < 0.02 * often {
                *at = None;
            }
        }
    }
    if often > 0.0 && swapped > 0.0 {
        for frame in &mut take.hand {
            if random.share() < swapped {
                let own = finger(random.below(4)) + random.below(7);
                frame.swap(own, own + 1);
            }
        }
    }
}
