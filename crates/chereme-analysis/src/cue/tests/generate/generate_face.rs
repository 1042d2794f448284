//! The generated face: true parameters of sounds, and the positions of its markers.

use chereme_motion::InterpolationKind;
use glam::DVec3;

use crate::cue::cue_face::share_of;
use crate::cue::cue_labels::{CHEEK_MARKERS, FACE_MARKER_COUNT, JAW_MARKERS, LIP_MARKERS, THROAT_MARKERS};
use crate::cue::rigid::RigidMotion;

/// Returns the share of the head's motion that each marker of the throat follows in generated takes; estimates are
/// compared with these weights.
#[must_use]
pub fn throat_weights() -> Vec<f64> {
    (0..THROAT_MARKERS.len())
        .map(|n| 0.3 + 0.5 * (n as f64) / 17.0)
        .collect()
}

/// Returns the change of a marker of the face by one unit of a true parameter, in millimetres.
fn face_direction(parameter: usize, marker: usize) -> DVec3 {
    let lower = (LIP_MARKERS.start + 9..LIP_MARKERS.end).contains(&marker);
    let upper = (LIP_MARKERS.start + 1..LIP_MARKERS.start + 8).contains(&marker);
    let corner = marker == LIP_MARKERS.start || marker == LIP_MARKERS.start + 8;
    let side = face_mean(marker).x.signum();
    match parameter {
        0 if JAW_MARKERS.contains(&marker) => DVec3::new(0.0, -6.0, -2.0),
        0 if lower => DVec3::new(0.0, -5.0, -1.0),
        0 if CHEEK_MARKERS.contains(&marker) => DVec3::new(0.0, -1.0, 0.0),
        1 if LIP_MARKERS.contains(&marker) => DVec3::new(-3.0 * face_mean(marker).x / 25.0, 0.0, 3.0),
        2 if upper => DVec3::new(0.0, 2.0, 0.3),
        3 if lower => DVec3::new(0.0, 2.0, 0.4),
        4 if corner => DVec3::new(0.5 * side, 2.0, 0.0),
        5 if THROAT_MARKERS.contains(&marker) => DVec3::new(0.0, 3.0, 1.0),
        6 if CHEEK_MARKERS.contains(&marker) => DVec3::new(side, 0.5, 1.0),
        _ => DVec3::ZERO,
    }
}

/// Returns the position of a marker on a face at rest.
fn face_mean(marker: usize) -> DVec3 {
    let ring = |n: usize, count: usize| std::f64::consts::TAU * n as f64 / count as f64;
    match marker {
        0..=4 => DVec3::new(25.0 * (marker as f64 - 2.0), 140.0 + 4.0 * (marker % 2) as f64, 90.0),
        5 => DVec3::new(0.0, 105.0, 105.0),
        6 => DVec3::new(0.0, 92.0, 112.0),
        7 | 8 => DVec3::new(if marker == 7 { -75.0 } else { 75.0 }, 95.0, 0.0),
        9..=24 => {
            let angle = ring(marker - 9, 16);
            DVec3::new(
                -25.0 * angle.cos(),
                45.0 + 10.0 * angle.sin(),
                100.0 - 6.0 * angle.cos().powi(2),
            )
        }
        25..=36 => {
            let n = marker - 25;
            let side = if n < 6 { -1.0 } else { 1.0 };
            let n = (n % 6) as f64;
            DVec3::new(side * (35.0 + 6.0 * n), 70.0 - 7.0 * n, 88.0 - 5.0 * n)
        }
        37..=44 => {
            let n = marker as f64 - 40.5;
            DVec3::new(16.0 * n, 6.0 + 1.2 * n * n, 98.0 - 2.5 * n * n)
        }
        _ => {
            let n = marker - 45;
            DVec3::new(14.0 * ((n % 6) as f64 - 2.5), -30.0 - 14.0 * (n / 6) as f64, 65.0)
        }
    }
}

pub(super) fn place_face(motion: &RigidMotion, parameters: &[f64; 7]) -> Vec<DVec3> {
    let weights = throat_weights();
    (0..FACE_MARKER_COUNT)
        .map(|marker| {
            let mut point = face_mean(marker);
            for (k, parameter) in parameters.iter().enumerate() {
                point += face_direction(k, marker) * *parameter;
            }
            let weight = marker.checked_sub(THROAT_MARKERS.start).map_or(1.0, |n| weights[n]);
            share_of(motion, weight).apply_rigid_motion(point)
        })
        .collect()
}

/// Returns the true parameters of the face at a time: those of the sound, 60 ms early.
pub(super) fn mouth_parameters_at(phones: &[(String, f64, f64)], time: f64) -> [f64; 7] {
    let lookup_time = time + 0.06;
    let n = phones.partition_point(|phone| phone.1 <= lookup_time);
    let of = |n: Option<usize>| n.map_or([0.0; 7], |n| viseme(&phones[n].0));
    let (before, own) = (of(n.checked_sub(2)), of(n.checked_sub(1)));
    let start = n.checked_sub(1).map_or(0.0, |n| phones[n].1);
    let share = InterpolationKind::MinimumJerk.interpolation_share(((lookup_time - start) / 0.09).clamp(0.0, 1.0));
    std::array::from_fn(|k| before[k] + (own[k] - before[k]) * share)
}

fn viseme(label: &str) -> [f64; 7] {
    match label {
        "a" => [2.0, -0.5, 0.8, -0.8, 0.0, -0.6, 0.0],
        "A~" => [1.6, 0.2, 0.6, -0.5, -0.3, -1.0, 0.2],
        "E" | "E~" => [1.2, -0.8, 0.5, -0.6, 0.5, 0.3, 0.4],
        "e" => [0.6, -1.0, 0.3, -0.4, 0.8, 0.8, 0.5],
        "i" => [0.2, -1.2, 0.2, -0.2, 1.2, 1.2, 0.6],
        "o" | "O~" => [0.8, 1.4, 0.0, -0.2, -0.5, -0.4, -0.3],
        "u" => [0.2, 2.0, -0.2, 0.2, -0.8, 0.2, -0.6],
        "y" => [0.2, 2.1, -0.1, 0.1, -0.4, 1.0, -0.5],
        "2" => [0.6, 1.6, 0.1, -0.1, -0.3, 0.4, -0.2],
        "@" => [0.6, 0.6, 0.1, -0.1, 0.0, 0.0, 0.0],
        "p" | "b" | "m" => [-0.4, 0.2, -1.0, 1.2, 0.1, 0.0, 0.7],
        "f" | "v" => [-0.1, -0.2, 0.6, 1.4, 0.2, 0.1, -0.2],
        "S" | "Z" => [0.1, 1.5, 0.6, -0.6, 0.0, 0.5, -0.1],
        "s" | "t" | "d" | "n" | "l" => [0.1, -0.4, 0.2, -0.3, 0.4, 0.7, 0.1],
        "k" | "g" | "R" | "N" => [0.5, -0.1, 0.0, -0.3, 0.0, -1.2, -0.2],
        "j" => [0.1, -1.0, 0.1, -0.2, 1.0, 1.1, 0.9],
        _ => [0.0; 7],
    }
}
