//! Tests of usable and active frames.

use std::sync::Arc;

use glam::DQuat;

use super::*;
use crate::anatomy::tests::fixtures::{BodyVariation, PLAIN_BODY_VARIATION, fixture_body, fixture_joint_roles};
use crate::clip::JointChannel;
use crate::time::FrameRate;

/// Returns a clip of 100 frames in which a body with hanging arms raises and lowers its right hand.
fn clip(change: impl Fn(usize, usize, &mut Vec<DQuat>, &mut Vec<DVec3>)) -> (Clip, BodyAnatomy) {
    let skeleton = Arc::new(fixture_body(PLAIN_BODY_VARIATION));
    let anatomy = BodyAnatomy::with_roles(&skeleton, &fixture_joint_roles(&skeleton)).expect("a body");
    let (count, rate) = (100, FrameRate::new(25, 1).expect("a rate"));
    let raise = |frame: usize| match frame {
        30..70 => ((frame - 30) as f64 / 39.0 * std::f64::consts::PI).sin() * 1.3,
        _ => 0.0,
    };
    let mut channels: Vec<JointChannel> = Vec::new();
    for (index, joint) in skeleton.skeleton_joints().iter().enumerate() {
        let part = anatomy.part_of(index);
        let turned = |frame: usize| match part {
            Some(BodyPart::UpperArm(BodySide::Right)) => DQuat::from_rotation_z(1.4 - raise(frame)),
            Some(BodyPart::UpperArm(BodySide::Left)) => DQuat::from_rotation_z(-1.4),
            _ => joint.rest,
        };
        let mut rotations: Vec<DQuat> = (0..count).map(turned).collect();
        let mut places = vec![joint.offset; count];
        change(index, count, &mut rotations, &mut places);
        channels.push(JointChannel {
            rotations,
            translations: (index == 0).then_some(places),
        });
    }
    (Clip::new(skeleton, rate, channels).expect("a clip"), anatomy)
}

#[test]
fn odd_first_and_last_frames_are_found_with_their_numbers() {
    type Change = fn(usize, usize, &mut Vec<DQuat>, &mut Vec<DVec3>);
    let cases: [(&str, Change, Range<usize>); 9] = [
        ("", |_, _, _, _| {}, 0..100),
        (
            "frame 0: the skeleton's own posture (bind pose)",
            |_, _, turned, _| turned[0] = DQuat::IDENTITY,
            1..100,
        ),
        (
            "frame 0: the body jumps 5.0 m",
            |joint, _, _, places| {
                if joint == 0 {
                    places[0].x += 5.0;
                }
            },
            1..100,
        ),
        (
            "frame 0: the body turns by 180° at once",
            |joint, _, turned, _| {
                if joint == 0 {
                    turned[0] = DQuat::from_rotation_y(std::f64::consts::PI);
                }
            },
            1..100,
        ),
        (
            "frames 97 to 99: the body jumps 3.0 m",
            |joint, count, _, places| {
                if joint == 0 {
                    for place in &mut places[count - 3..] {
                        place.z -= 3.0;
                    }
                }
            },
            0..97,
        ),
        (
            "frames 0 to 37: the body jumps 5.0 m",
            |joint, _, _, places| {
                if joint == 0 {
                    places[..38].iter_mut().for_each(|place| place.x += 5.0);
                    places[36].x -= 1.6;
                    places[37].x -= 3.2;
                }
            },
            38..100,
        ),
        (
            "",
            |joint, _, _, places| {
                if joint == 0 {
                    places[40..42].iter_mut().for_each(|place| place.x += 5.0);
                }
            },
            0..100,
        ),
        (
            "frames 97 to 99: the body turns by 115° at once",
            |joint, _, turned, _| {
                if joint == 0 {
                    turned[97] = DQuat::from_rotation_y(0.6);
                    turned[98..].fill(DQuat::from_rotation_y(2.0));
                }
            },
            0..97,
        ),
        (
            "frames 0 to 4: a hand jumps",
            |_, _, turned, _| {
                for turned in &mut turned[..5] {
                    *turned = DQuat::from_rotation_y(1e-2);
                }
            },
            5..100,
        ),
    ];
    for (want, change, sound) in cases {
        let (clip, anatomy) = clip(change);
        let ends = ClipEnds::examine_clip_ends(&clip, &anatomy);
        let read = |frames| Ok::<_, std::convert::Infallible>(clip.slice_clip_frames(frames));
        let Ok(in_parts) = ClipEnds::of_long_take(&clip.joint_path(0), 60, &anatomy, read);
        assert_eq!(in_parts, ends, "{want}");
        let texts: Vec<String> = ends.odd.iter().map(ToString::to_string).collect();
        assert_eq!(ends.sound, sound, "{want}: {texts:?}");
        let text = texts.join("; ");
        assert!(text.starts_with(want) && text.is_empty() == want.is_empty(), "{text}");
    }
}

#[test]
fn hands_that_wait_in_front_of_the_belly_are_at_rest() {
    let lap = |joint: usize, anatomy: &BodyAnatomy| match anatomy.part_of(joint) {
        Some(BodyPart::Forearm(side)) => Some(DQuat::from_rotation_y(side.side_sign() * -1.4)),
        _ => None,
    };
    let plain = Arc::new(fixture_body(PLAIN_BODY_VARIATION));
    let of = BodyAnatomy::with_roles(&plain, &fixture_joint_roles(&plain)).expect("a body");
    let (clip, anatomy) = clip(|joint, _, turned, _| {
        if let Some(bent) = lap(joint, &of) {
            turned.fill(bent);
        }
    });
    let lows = TakeSnapshots {
        clip: &clip,
        anatomy: &anatomy,
        first: 0,
    }
    .body_snapshot_at(0)
    .low;
    assert!(
        lows.iter()
            .flatten()
            .all(|low| (HAND_WAIT_LIMITS.0..WRIST_REST_LIMITS.0).contains(low)),
        "{lows:?}"
    );
    let active = activity_frames(&clip, &anatomy).expect("a raised hand");
    assert!(
        (30..=34).contains(&active.start) && (66..=70).contains(&active.end),
        "{active:?}"
    );
}

#[test]
fn a_t_pose_that_is_left_slowly_is_found() {
    let (clip, anatomy) = clip(|joint, _, turned, _| {
        let still = turned[25];
        for (frame, turned) in turned[..25].iter_mut().enumerate() {
            let share = (frame as f64 / 20.0).min(1.0);
            if joint > 0 {
                *turned = DQuat::IDENTITY.slerp(still, share);
            }
        }
    });
    let ends = ClipEnds::examine_clip_ends(&clip, &anatomy);
    assert!(
        matches!(ends.odd.as_slice(), [odd] if odd.what == FrameOddity::Tee),
        "{ends:?}"
    );
    let active = activity_frames(&clip, &anatomy).expect("a raised hand");
    assert!(active.start > 25 && active.start <= 31, "{active:?}");
}

#[test]
fn hands_that_stir_at_rest_are_not_active() {
    let (clip, anatomy) = clip(|joint, count, turned, _| {
        // The right arm swings by some centimetres, after the sign.
        if turned[50].angle_between(turned[0]) > 0.5 && joint > 0 {
            for (frame, turned) in turned[85..count - 5].iter_mut().enumerate() {
                *turned *= DQuat::from_rotation_x(0.3 * (frame as f64 * 0.4).sin());
            }
        }
    });
    let active = activity_frames(&clip, &anatomy).expect("a raised hand");
    assert!(
        (27..=31).contains(&active.start) && (69..=73).contains(&active.end),
        "{active:?}"
    );
}

#[test]
fn activity_is_between_two_rests_and_a_still_body_has_none() {
    let (moving, anatomy) = clip(|_, _, _, _| {});
    let active = activity_frames(&moving, &anatomy).expect("a raised hand");
    assert!(
        (27..=31).contains(&active.start) && (69..=73).contains(&active.end),
        "{active:?}"
    );
    let skeleton = Arc::new(fixture_body(BodyVariation {
        lowered: 1.4,
        ..PLAIN_BODY_VARIATION
    }));
    let anatomy = BodyAnatomy::with_roles(&skeleton, &fixture_joint_roles(&skeleton)).expect("a body");
    let still = Clip::from_rest_pose(skeleton, FrameRate::new(25, 1).expect("a rate"), 50);
    assert_eq!(activity_frames(&still, &anatomy), None);
    assert!(ClipEnds::examine_clip_ends(&still, &anatomy).is_sound());
}
