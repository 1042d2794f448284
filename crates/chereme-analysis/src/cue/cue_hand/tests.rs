//! Tests of angles from markers, on hands that are generated from angles.

use super::*;
use crate::cue::generate::generate_hand::{hand_marker_positions, shape_angles};

#[test]
fn an_angle_is_wrapped_to_the_range_of_a_finger_s_bend() {
    for (degrees, wrapped_to) in [
        (0.0, 0.0),
        (-89.0, -89.0),
        (-91.0, 269.0),
        (100.0, 100.0),
        (269.0, 269.0),
        (271.0, -89.0),
        (-260.0, 100.0),
    ] {
        let is = wrap_bend_angle(f64::to_radians(degrees)).to_degrees();
        assert!((is - wrapped_to).abs() < 1e-9, "{degrees}: {is}");
    }
}

#[test]
fn angles_of_a_generated_hand_are_computed_from_its_markers() {
    // The skin does not slide, so that the markers of a phalange lie along its bone.
    let placed = |joints| -> HandMarkerFrame { hand_marker_positions(&joints, 0.0).into_iter().map(Some).collect() };
    let rest = hand_marker_positions(&[0.0; 22], 0.0);
    let straight = compute_hand_angles(&placed([0.0; 22]), &rest[HAND_BACK_MARKERS]);
    for shape in 0..=8 {
        let mut joints = shape_angles(shape);
        let turn = [0.2, -0.3];
        joints[20..].copy_from_slice(&turn);
        let found = compute_hand_angles(&placed(joints), &rest[HAND_BACK_MARKERS]);
        let hand = DQuat::from_rotation_y(turn[0]) * DQuat::from_rotation_z(turn[1]);
        let about = DVec3::from_slice(&found[..3]);
        assert!(about.distance(hand.to_scaled_axis()) < 1e-6, "{about}");
        for n in 0..4 {
            let [flex, spread, middle, last] = [0, 1, 2, 3].map(|k| joints[4 * n + k]);
            let own: Vec<f64> = (3 + 4 * n..7 + 4 * n).map(|at| found[at] - straight[at]).collect();
            // The axes of the palm are not quite those of the bones.
            let off = [own[0] - flex, own[2] - middle, own[3] - last].map(f64::to_degrees);
            let most = off.into_iter().map(f64::abs).fold(0.0, f64::max);
            assert!(most < 4.0, "{shape} {n}: {off:?}");
            if flex < 0.1 {
                let aside = (own[1] - spread).to_degrees();
                assert!(aside.abs() < 1.0, "{shape} {n}: {aside}");
            }
        }
    }
}

#[test]
fn markers_of_a_generated_thumb_lie_along_its_bones() {
    for shape in 0..=8 {
        let at = hand_marker_positions(&shape_angles(shape), 1.0);
        let apart = |a: usize, b: usize| at[FIRST_THUMB_MARKER + a].distance(at[FIRST_THUMB_MARKER + b]);
        for (part, length) in [42.0, 32.0, 26.0].into_iter().enumerate() {
            let is = apart(2 * part, 2 * part + 1);
            assert!((is - 0.7 * length).abs() < 1e-9, "{shape} {part}: {is}");
        }
    }
}

#[test]
fn skin_slides_and_lifts_by_millimetres() {
    for shape in 0..=8 {
        let joints = shape_angles(shape);
        let (bare, skin) = (hand_marker_positions(&joints, 0.0), hand_marker_positions(&joints, 1.0));
        for (marker, (a, b)) in bare.iter().zip(&skin).enumerate() {
            // At most 3 mm and 2.4 mm along the bone, and 1 mm off it.
            let off = a.distance(*b);
            assert!(off < 5.5, "{shape} {marker}: {off}");
            let on_a_finger = (first_finger_marker(0)..FIRST_THUMB_MARKER).contains(&marker);
            assert!(on_a_finger || off == 0.0, "{shape} {marker}: {off}");
        }
        // The tip, at the end of its bone, slides only by the bend of its joint.
        for n in 0..4 {
            let (tip, last) = (first_finger_marker(n) + 7, joints[4 * n + 3]);
            let off = bare[tip].distance(skin[tip]);
            assert!((off - 1.2 * (1.0 - last.cos())).abs() < 1e-9, "{shape} {n}: {off}");
        }
    }
}

#[test]
fn markers_of_a_straight_finger_lie_above_its_bones_at_their_shares() {
    let at = hand_marker_positions(&[0.0; 22], 1.0);
    for (n, bones) in [(0, [45.0, 26.0, 22.0]), (3, [36.0, 20.0, 20.0])] {
        let own = &at[first_finger_marker(n)..first_finger_marker(n) + 8];
        let base = own[0].x - 0.2 * bones[0];
        for (k, (bone, share)) in [
            (0, 0.2),
            (0, 0.5),
            (0, 0.85),
            (1, 0.2),
            (1, 0.5),
            (1, 0.85),
            (2, 0.35),
            (2, 1.0),
        ]
        .into_iter()
        .enumerate()
        {
            let along = bones[..bone].iter().sum::<f64>() + share * bones[bone];
            assert!((own[k].x - base - along).abs() < 1e-9, "{n} {k}: {}", own[k]);
            assert!((own[k].z - [7.0, 5.0, 3.0][bone]).abs() < 1e-9, "{n} {k}: {}", own[k]);
        }
    }
}
