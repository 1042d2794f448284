//! Scores of performances whose similarity is known.

use chereme_analysis::dtw::{self, AlignmentWindow, StepPattern};
use chereme_analysis::score::{PerformedClip, UncomparedComponent, score_as};
use chereme_analysis::{ClipSimilarityScore, ScoreError, ScoreOptions, score_clips};
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{
    BodyAnatomy, BodyPart, BodySide, Clip, FrameRate, LocalPose, RecordingInstant, Skeleton, SkeletonJoint,
};
use chereme_sign::SignComponent;

const FINGERS: [&str; 4] = ["Index", "Middle", "Ring", "Pinky"];

/// Returns a standing signer in a T-pose, scaled by `size`; with `fingers` the hands have joints for handshapes.
fn signer(size: f64, prefix: &str, fingers: bool) -> Skeleton {
    let mut joints: Vec<SkeletonJoint> = Vec::new();
    let mut add = |name: &str, parent: Option<usize>, offset: [f64; 3]| {
        let joint = SkeletonJoint::new(format!("{prefix}{name}"), parent, DVec3::from(offset) * size);
        joints.push(joint);
        joints.len() - 1
    };
    let hips = add("Hips", None, [0.0, 0.95, 0.0]);
    let spine = add("Spine", Some(hips), [0.0, 0.15, 0.0]);
    let chest = add("Spine1", Some(spine), [0.0, 0.25, 0.0]);
    let neck = add("Neck", Some(chest), [0.0, 0.15, 0.0]);
    add("Head", Some(neck), [0.0, 0.1, 0.02]);
    for side in BodySide::BOTH_SIDES {
        let (x, s) = (side.side_sign(), if side == BodySide::Right { "Right" } else { "Left" });
        let clavicle = add(&format!("{s}Shoulder"), Some(chest), [0.03 * x, 0.1, 0.0]);
        let upper = add(&format!("{s}Arm"), Some(clavicle), [0.15 * x, 0.0, 0.0]);
        let forearm = add(&format!("{s}ForeArm"), Some(upper), [0.28 * x, 0.0, -0.01]);
        let hand = add(&format!("{s}Hand"), Some(forearm), [0.25 * x, 0.0, 0.01]);
        if !fingers {
            continue;
        }
        let mut at = add(&format!("{s}HandThumb1"), Some(hand), [0.03 * x, -0.01, 0.03]);
        for n in 2..=3 {
            at = add(&format!("{s}HandThumb{n}"), Some(at), [0.03 * x, 0.0, 0.02]);
        }
        for (k, finger) in (0..4).zip(FINGERS) {
            let base = [0.09 * x, 0.0, 0.03 - 0.02 * f64::from(k)];
            let mut at = add(&format!("{s}Hand{finger}1"), Some(hand), base);
            for n in 2..=3 {
                at = add(&format!("{s}Hand{finger}{n}"), Some(at), [0.03 * x, 0.0, 0.0]);
            }
        }
    }
    Skeleton::new(joints).expect("a tree")
}

/// Both arms swing and the fingers close over a second and a half.
fn performance(skeleton: Skeleton, frames: usize) -> Clip {
    let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
    let poses: Vec<LocalPose> = (0..frames)
        .map(|frame| {
            let t = frame as f64 / (frames - 1).max(1) as f64 * 1.5;
            let mut pose = skeleton.rest_pose();
            let mut turn = |part, axis: DVec3, angle: f64| {
                if let Some(joint) = anatomy.part_joint(part) {
                    pose.rotations[joint] *= DQuat::from_axis_angle(axis, angle);
                }
            };
            for side in BodySide::BOTH_SIDES {
                let x = side.side_sign();
                turn(BodyPart::UpperArm(side), DVec3::Z, x * (-0.9 + 0.5 * (3.0 * t).sin()));
                turn(BodyPart::Forearm(side), DVec3::Y, -x * (1.2 + 0.7 * (4.0 * t).sin()));
                turn(BodyPart::Hand(side), DVec3::X, 0.8 * (2.0 * t).sin());
                for finger in chereme_motion::HandFinger::ALL_FINGERS {
                    turn(BodyPart::Finger(side, finger, 1), DVec3::Z, -x * t);
                    turn(BodyPart::Finger(side, finger, 2), DVec3::Z, -x * 0.8 * t);
                }
            }
            pose
        })
        .collect();
    Clip::from_poses(skeleton.into(), FrameRate::new(120, 1).expect("a rate"), &poses).expect("a clip")
}

fn scored(a: &Clip, b: &Clip) -> ClipSimilarityScore {
    score_clips(a, b, &ScoreOptions::default()).expect("comparable clips")
}

#[test]
fn a_clip_has_distance_zero_to_itself() {
    let clip = performance(signer(1.0, "", true), 180);
    let found = scored(&clip, &clip);
    assert_eq!(
        (found.distance, found.normalized, found.max_joint_error_m),
        (0.0, Some(0.0), Some(0.0))
    );
    assert_eq!(found.alignment, (0..180).map(|i| (i, i)).collect::<Vec<_>>());
    let components: Vec<_> = found.components.iter().map(|(c, part)| (*c, *part)).collect();
    use SignComponent::{Configuration, Movement, Orientation, Placement};
    assert_eq!(
        components,
        [Configuration, Placement, Movement, Orientation].map(|c| (c, 0.0))
    );
    assert!(found.left_out.is_empty() && found.only_in_first.is_empty());
}

#[test]
fn another_tempo_scores_as_nearly_equal_and_another_movement_does_not() {
    let clip = performance(signer(1.0, "", true), 180);
    let end = clip.clip_frame_rate().frame_start_instant(179).instant_seconds();
    let warped = clip.retime_clip(clip.clip_frame_rate(), 180, |frame| {
        let t = frame as f64 / 179.0;
        RecordingInstant::from_seconds(end * (t + 0.12 * (std::f64::consts::TAU * t).sin() / 2.0))
    });
    let still = Clip::from_rest_pose(clip.clip_skeleton().clone(), clip.clip_frame_rate(), 180);
    let (near, far) = (scored(&clip, &warped), scored(&clip, &still));
    let of = |score: &ClipSimilarityScore, component| score.components[&component];
    for component in [
        SignComponent::Placement,
        SignComponent::Orientation,
        SignComponent::Configuration,
    ] {
        assert!(of(&near, component) < 0.1, "{near:?}");
        assert!(of(&far, component) > 1.0, "{:?}", far.components);
    }
    assert!(near.normalized < far.normalized.map(|far| far / 10.0));
    assert!(near.max_joint_error_m > Some(0.02), "frame by frame the tempo shows");
    let slower = clip.retime_clip(clip.clip_frame_rate(), 270, |frame| {
        clip.clip_frame_rate().frame_start_instant(frame * 2 / 3)
    });
    assert!(
        scored(&clip, &slower).max_joint_error_m < Some(0.02),
        "aligned it does not"
    );
}

#[test]
fn no_part_exceeds_the_whole_at_unequal_rates() {
    let clip = performance(signer(1.0, "", true), 180);
    let half = FrameRate::new(60, 1).expect("a rate");
    let thinned = clip.retime_clip(half, 90, |frame| clip.clip_frame_rate().frame_start_instant(frame * 2));
    for score in [scored(&clip, &thinned), scored(&thinned, &clip)] {
        let whole = score.normalized.expect("a norm");
        let most = score.components.values().copied().fold(0.0, f64::max);
        assert!(most <= whole, "{most} of {whole}: {:?}", score.components);
        // Two of three pairs would have to share it if pairs were counted.
        assert!(most > 0.7 * whole, "{most} of {whole}");
    }
}

#[test]
fn the_ends_of_fingers_in_other_files_are_no_movement() {
    let ended = |tip: &dyn Fn(DVec3) -> Option<DVec3>| {
        let skeleton = signer(1.0, "", true);
        let last = |n: usize| skeleton.joint_at(n).name.ends_with('3');
        let joints = skeleton.skeleton_joints().iter().enumerate();
        let joints = joints.map(|(n, joint)| SkeletonJoint {
            tip: match last(n) {
                true => tip(joint.offset.normalize() * 0.02),
                false => joint.tip,
            },
            ..joint.clone()
        });
        performance(Skeleton::new(joints.collect()).expect("a tree"), 60)
    };
    let clip = ended(&Some);
    for (tip, most) in [
        (&Some as &dyn Fn(DVec3) -> Option<DVec3>, 0.0),
        (&|tip: DVec3| Some(DVec3::Y * tip.length()), 1e-9),
        (&|_: DVec3| Some(DVec3::ZERO), 0.0),
        (&|_: DVec3| None, 0.0),
    ] {
        let other = ended(tip);
        for found in [scored(&clip, &other), scored(&other, &clip)] {
            let error = found.max_joint_error_m.expect("joints");
            assert!(error <= most && found.distance < 1e-6, "{error} {}", found.distance);
        }
    }
}

#[test]
fn a_translated_copy_differs_only_by_its_translation() {
    let clip = performance(signer(1.0, "", true), 60);
    let by = DVec3::new(0.3, 0.0, -0.4);
    let poses: Vec<LocalPose> = (0..60)
        .map(|frame| {
            let mut pose = clip.clip_pose_at(frame);
            pose.translations[0] += by;
            pose
        })
        .collect();
    let moved = Clip::from_poses(clip.clip_skeleton().clone(), clip.clip_frame_rate(), &poses).expect("a clip");
    let found = scored(&clip, &moved);
    assert!(found.distance < 1e-9);
    assert!(found.max_joint_error_m.is_some_and(|error| (error - 0.5).abs() < 1e-12));
}

#[test]
fn only_the_changed_component_differs() {
    let clip = performance(signer(1.0, "", true), 60);
    let anatomy = BodyAnatomy::detect_anatomy(clip.clip_skeleton());
    let mut channels = clip.clone().into_channels();
    for joint in anatomy.finger_joints(BodySide::Right) {
        channels[joint].rotations.fill(DQuat::IDENTITY);
    }
    let open = Clip::new(clip.clip_skeleton().clone(), clip.clip_frame_rate(), channels).expect("a clip");
    let options = ScoreOptions {
        dtw: dtw::DtwOptions {
            window: AlignmentWindow::SakoeChiba(0),
            ..dtw::DtwOptions::default()
        },
        ..ScoreOptions::default()
    };
    let found = score_clips(&clip, &open, &options).expect("comparable");
    for (component, part) in &found.components {
        assert_eq!(*part > 1e-9, *component == SignComponent::Configuration, "{found:?}");
    }
    // Each part is in its own unit: half the unit doubles the part.
    let mut twice = options;
    twice.scales.configuration /= 2.0;
    let doubled = score_clips(&clip, &open, &twice).expect("comparable");
    let part = |score: &ClipSimilarityScore| score.components[&SignComponent::Configuration];
    assert!((part(&doubled) - 2.0 * part(&found)).abs() < 1e-9);
}

#[test]
fn two_bodies_are_compared_by_the_parts_that_both_have() {
    let clip = performance(signer(1.0, "", true), 90);
    let child = performance(signer(0.7, "child:", true), 90);
    let found = scored(&clip, &child);
    assert!(found.normalized < Some(1e-6), "{:?}", found.components);
    assert!(found.max_joint_error_m > Some(0.2) && found.only_in_first.is_empty());

    let mittens = performance(signer(1.0, "", false), 90);
    let found = scored(&clip, &mittens);
    let left_out: Vec<(SignComponent, BodySide, (bool, bool))> = found
        .left_out
        .iter()
        .map(
            |UncomparedComponent {
                 component, side, shown, ..
             }| (*component, *side, *shown),
        )
        .collect();
    for side in BodySide::BOTH_SIDES {
        for component in [SignComponent::Configuration, SignComponent::Orientation] {
            assert!(left_out.contains(&(component, side, (true, false))), "{left_out:?}");
        }
    }
    assert!(
        found
            .components
            .keys()
            .eq([&SignComponent::Placement, &SignComponent::Movement])
    );
    assert!(found.normalized < Some(1e-6) && found.max_joint_error_m < Some(1e-9));
    assert_eq!(found.only_in_first.len(), 30, "{:?}", found.only_in_first);
    assert!(found.only_in_second.is_empty());
    let other = scored(&mittens, &clip);
    assert_eq!(other.only_in_second, found.only_in_first);
    assert!(other.only_in_first.is_empty());
}

#[test]
fn symmetric_patterns_give_the_same_score_in_both_directions() {
    let clip = performance(signer(1.0, "", true), 70);
    let other = clip.slice_clip_frames(5..60);
    for pattern in [
        StepPattern::Symmetric1,
        StepPattern::Symmetric2,
        StepPattern::SymmetricP1,
    ] {
        let options = ScoreOptions {
            dtw: dtw::DtwOptions {
                pattern,
                ..dtw::DtwOptions::default()
            },
            ..ScoreOptions::default()
        };
        let there = score_clips(&clip, &other, &options).expect("a score");
        let back = score_clips(&other, &clip, &options).expect("a score");
        assert!((there.distance - back.distance).abs() < 1e-9 * there.distance);
    }
}

#[test]
fn clips_that_cannot_be_compared_are_an_error() {
    let clip = performance(signer(1.0, "", true), 10);
    let options = ScoreOptions::default();
    let empty = score_clips(&clip, &clip.slice_clip_frames(0..0), &options);
    assert_eq!(empty, Err(ScoreError::Empty { which: "second" }));
    let stick = Skeleton::new(vec![SkeletonJoint::new("stick", None, DVec3::ZERO)]).expect("a joint");
    let stick = Clip::from_rest_pose(stick.into(), clip.clip_frame_rate(), 10);
    assert_eq!(score_clips(&clip, &stick, &options), Err(ScoreError::NothingInCommon));
    let narrow = ScoreOptions {
        dtw: dtw::DtwOptions {
            window: AlignmentWindow::SakoeChiba(2),
            ..dtw::DtwOptions::default()
        },
        ..options
    };
    assert!(matches!(
        score_clips(&clip, &clip.slice_clip_frames(0..4), &narrow),
        Err(ScoreError::Dtw(_))
    ));
    assert_eq!(
        scored(&clip.slice_clip_frames(3..4), &clip.slice_clip_frames(3..4)).distance,
        0.0
    );
}

#[test]
fn a_score_is_written_under_the_keys_that_scripts_rely_on() {
    let clip = performance(signer(1.0, "", true), 3);
    let json = serde_json::to_value(scored(&clip, &clip)).expect("JSON");
    for key in ["distance", "normalized", "components", "max_joint_error_m", "alignment"] {
        assert!(json.get(key).is_some(), "{key}");
    }
    assert_eq!(json["components"]["configuration"], 0.0);
    assert_eq!(json["alignment"], serde_json::json!([[0, 0], [1, 1], [2, 2]]));
}

#[test]
fn handshapes_that_nobody_captured_are_not_compared() {
    let clip = performance(signer(1.0, "", true), 60);
    let anatomy = BodyAnatomy::detect_anatomy(clip.clip_skeleton());
    let fingers = BodySide::BOTH_SIDES.map(|side| anatomy.finger_joints(side)).concat();
    let resting = |frame| {
        let mut pose = clip.clip_pose_at(frame);
        for &joint in &fingers {
            pose.rotations[joint] = clip.clip_skeleton().joint_at(joint).rest;
        }
        pose
    };
    let poses: Vec<LocalPose> = (0..clip.clip_frame_count()).map(resting).collect();
    let skeleton = signer(1.0, "", true).into();
    let still = Clip::from_poses(skeleton, clip.clip_frame_rate(), &poses).expect("a clip");
    let both = BodySide::BOTH_SIDES.as_slice();
    let cases: [(&[BodySide], &[BodySide]); 4] = [
        (&[], &[]),
        (&[], &[BodySide::Left]),
        (&[BodySide::Right], &[BodySide::Right]),
        (both, both),
    ];
    for (first, second) in cases {
        let performed = |clip, uncaptured| PerformedClip {
            clip,
            anatomy: &anatomy,
            uncaptured,
        };
        let (a, b) = (performed(&clip, first), performed(&still, second));
        let found = score_as(a, b, &ScoreOptions::default()).expect("comparable");
        let out = found.left_out.iter().map(|it| (it.side, it.uncaptured));
        let out: Vec<_> = out.collect();
        let want: Vec<_> = BodySide::BOTH_SIDES
            .into_iter()
            .map(|side| (side, (first.contains(&side), second.contains(&side))))
            .filter(|(_, uncaptured)| *uncaptured != (false, false))
            .collect();
        assert_eq!(out, want);
        let handshapes = found.components.get(&SignComponent::Configuration);
        assert_eq!(handshapes.is_some(), want.len() < 2, "{want:?}");
        // All but the fingers is the same movement.
        assert_eq!(
            found.normalized < Some(1e-9) && found.max_joint_error_m < Some(1e-9),
            want.len() == 2,
            "{want:?} {:?} {:?}",
            found.normalized,
            found.max_joint_error_m
        );
    }
}
