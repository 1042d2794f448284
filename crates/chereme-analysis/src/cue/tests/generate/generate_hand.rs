//! The generated hand: joint angles of shapes, and the positions of its markers.

use glam::{DQuat, DVec3};

use super::GENERATED_JOINT_COUNT;
use crate::cue::cue_labels::HAND_MARKER_COUNT;

/// The joint angles of a shape in radians.
#[must_use]
pub fn shape_angles(shape: u8) -> [f64; GENERATED_JOINT_COUNT] {
    let straight = |finger: usize| match shape {
        1 | 6 => finger == 0,
        2 | 7 | 8 => finger < 2,
        3 => finger > 0,
        4 | 5 => true,
        _ => false,
    };
    let mut row = [0.0; GENERATED_JOINT_COUNT];
    for n in 0..4 {
        let bent = if straight(n) {
            [4.0, 4.0, 3.0]
        } else {
            [80.0, 100.0, 55.0]
        };
        let spread = match (shape, n) {
            // A V of 25 degrees.
            (8, 0) => 13.0,
            (8, 1) => -12.0,
            _ => 0.0,
        };
        for (k, degrees) in [bent[0], spread, bent[1], bent[2]].into_iter().enumerate() {
            row[4 * n + k] = f64::to_radians(degrees);
        }
    }
    let thumb = match shape {
        5..=7 => [55.0, 10.0, 0.0, 0.0],
        0 => [25.0, 30.0, 45.0, 55.0],
        // Across the palm.
        _ => [10.0, 20.0, 45.0, 60.0],
    };
    for (k, degrees) in thumb.into_iter().enumerate() {
        row[16 + k] = f64::to_radians(degrees);
    }
    row
}

/// Returns the positions of the hand's markers in the space of the forearm, which lies along x and ends at the wrist.
pub(in crate::cue) fn hand_marker_positions(angles: &[f64; GENERATED_JOINT_COUNT], skin: f64) -> Vec<DVec3> {
    let mut points = Vec::with_capacity(HAND_MARKER_COUNT);
    for (x, y, z) in [
        (-200.0, 20.0, 10.0),
        (-150.0, -25.0, 20.0),
        (-110.0, 25.0, 22.0),
        (-60.0, -20.0, 24.0),
        (-30.0, 15.0, 22.0),
    ] {
        points.push(DVec3::new(x, y, z));
    }
    let wrist = DQuat::from_rotation_y(angles[20]) * DQuat::from_rotation_z(angles[21]);
    let mut local = Vec::with_capacity(HAND_MARKER_COUNT);
    const KNUCKLE_SIDEWAYS_MM: [f64; 4] = [26.0, 6.0, -13.0, -31.0];
    const KNUCKLE_FORWARD_MM: [f64; 4] = [90.0, 93.0, 88.0, 80.0];
    const FINGER_BONES_MM: [[f64; 3]; 4] = [
        [45.0, 26.0, 22.0],
        [50.0, 30.0, 23.0],
        [46.0, 28.0, 23.0],
        [36.0, 20.0, 20.0],
    ];
    for n in 0..4 {
        local.push(DVec3::new(KNUCKLE_FORWARD_MM[n], KNUCKLE_SIDEWAYS_MM[n], 14.0));
    }
    for (x, y) in [(50.0, 15.0), (45.0, -15.0), (15.0, 0.0)] {
        local.push(DVec3::new(x, y, 18.0));
    }
    for n in 0..4 {
        let [flex, spread, middle, last] = [0, 1, 2, 3].map(|k| angles[4 * n + k]);
        let side = DQuat::from_rotation_z(spread);
        let mut position = DVec3::new(KNUCKLE_FORWARD_MM[n], KNUCKLE_SIDEWAYS_MM[n], 0.0);
        let mut bent = 0.0;
        for (bone, joint) in [flex, middle, last].into_iter().enumerate() {
            bent += joint;
            let direction = side * DVec3::new(bent.cos(), 0.0, -bent.sin());
            let out = side * DVec3::new(bent.sin(), 0.0, bent.cos());
            let places: &[f64] = if bone == 2 { &[0.35, 1.0] } else { &[0.2, 0.5, 0.85] };
            for f in places {
                let slide = skin * (3.0 * joint.sin() * (1.0 - f) + 1.2 * (1.0 - joint.cos()));
                let lift = 7.0 - 2.0 * bone as f64 + skin * joint.sin() * (1.0 - f);
                local.push(position + direction * (FINGER_BONES_MM[n][bone] * f + slide) + out * lift);
            }
            position += direction * FINGER_BONES_MM[n][bone];
        }
    }
    let [mut around, down, first, second] = [16, 17, 18, 19].map(|k| angles[k]);
    let mut position = DVec3::new(22.0, 26.0, -6.0);
    for (length, joint) in [(42.0, 0.0), (32.0, first), (26.0, second)] {
        around -= joint;
        let direction = DVec3::new(around.cos() * down.cos(), around.sin() * down.cos(), -down.sin());
        for f in [0.3, 1.0] {
            local.push(position + direction * length * f + DVec3::Z * 5.0);
        }
        position += direction * length;
    }
    points.extend(local.into_iter().map(|at| wrist * at));
    points
}
