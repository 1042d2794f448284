//! Generated markers as recorded by cameras: with noise and gaps.

use glam::DVec3;

use super::{GENERATED_FRAME_RATE, GeneratedTake, RandomNumbers};
use crate::cue::cue_hand::HandMarkerFrame;
use crate::cue::cue_labels::{CHEEK_MARKERS, FIRST_THUMB_MARKER, LIP_MARKERS, first_finger_marker};

/// Adds slow noise of soft tissue and measurement noise.
pub(super) fn add_marker_noise(
    points: &[Vec<DVec3>],
    soft: f64,
    white: f64,
    random: &mut RandomNumbers,
) -> Vec<HandMarkerFrame> {
    let keep = (-1.0 / (0.4 * GENERATED_FRAME_RATE)).exp();
    let markers = points.first().map_or(0, Vec::len);
    let mut slow: Vec<DVec3> = (0..markers).map(|_| random.random_normal_vector(soft)).collect();
    points
        .iter()
        .map(|frame| {
            frame
                .iter()
                .zip(&mut slow)
                .map(|(at, slow)| {
                    *slow = *slow * keep + random.random_normal_vector(soft * (1.0 - keep * keep).sqrt());
                    Some(*at + *slow + random.random_normal_vector(white))
                })
                .collect()
        })
        .collect()
}

/// Hides markers for runs of frames: neighbours on one finger, tips of bent fingers, the face behind the hand, and some
/// at random.
pub(super) fn hide_random_markers(take: &mut GeneratedTake, often: f64, swapped: f64, random: &mut RandomNumbers) {
    let frames = take.hand.len();
    let runs = (frames as f64 / GENERATED_FRAME_RATE * 1.2 * often) as usize;
    for _ in 0..runs {
        let start = random.random_below(frames);
        let length = 6 + (-random.random_share().max(1e-9).ln() * 0.2 * GENERATED_FRAME_RATE) as usize;
        let digit = random.random_below(5);
        let first = if digit == 4 {
            FIRST_THUMB_MARKER
        } else {
            first_finger_marker(digit)
        };
        let count = if digit == 4 { 6 } else { 8 };
        let from = random.random_below(count - 1);
        let many = (2 + random.random_below(3)).min(count - from);
        for frame in take.hand.iter_mut().skip(start).take(length) {
            frame[first + from..first + from + many].fill(None);
        }
    }
    for own in 0..4 {
        let mut gone = false;
        for frame in 0..frames {
            if frame % 24 == 0 {
                gone = random.random_share() < 0.6 * often;
            }
            let points = &take.true_hand[frame];
            let tip = first_finger_marker(own) + 7;
            let bent = points[tip].distance(points[first_finger_marker(own)]) < 45.0;
            if bent && gone {
                take.hand[frame][tip] = None;
            }
        }
    }
    for frame in 0..frames {
        let tip = take.true_hand[frame][first_finger_marker(1) + 7];
        for marker in LIP_MARKERS.chain(CHEEK_MARKERS) {
            let face_point = take.true_face[frame][marker];
            if face_point.x < 0.0 && face_point.distance(tip) < 40.0 {
                take.face[frame][marker] = None;
            }
        }
        for at in take.hand[frame].iter_mut().chain(&mut take.face[frame]) {
            if random.random_share() < 0.02 * often {
                *at = None;
            }
        }
    }
    if often > 0.0 && swapped > 0.0 {
        for frame in &mut take.hand {
            if random.random_share() < swapped {
                let marker_index = first_finger_marker(random.random_below(4)) + random.random_below(7);
                frame.swap(marker_index, marker_index + 1);
            }
        }
    }
}
