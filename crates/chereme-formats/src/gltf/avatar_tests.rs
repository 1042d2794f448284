//! Tests of VRMA: avatars stand in the T-pose, move as the clip does, and have its face.

use std::sync::Arc;

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Clip, FrameRate, JointChannel, Skeleton, SkeletonJoint};

use super::tests::parse;
use super::*;

/// A figure with hips, arms, legs and hands in a pose that is no T-pose.
pub(super) fn figure() -> Skeleton {
    let side = |name: &str, sign: f64| {
        let joint = move |part: &str, parent: usize, offset: DVec3| {
            SkeletonJoint::new(format!("{name}{part}"), Some(parent), offset)
        };
        [
            joint("Arm", 2, DVec3::new(0.2 * sign, 0.1, 0.0)),
            joint("ForeArm", 0, DVec3::new(0.0, -0.3, 0.0)),
            joint("Hand", 0, DVec3::new(0.0, -0.25, 0.05)).with_tip(DVec3::new(0.01, -0.1, 0.0)),
            joint("UpLeg", 0, DVec3::new(0.1 * sign, -0.1, 0.0)),
            joint("Leg", 0, DVec3::new(0.0, -0.4, 0.05)),
            joint("Foot", 0, DVec3::new(0.0, -0.4, 0.0)),
        ]
    };
    let mut joints = vec![
        SkeletonJoint::new("Hips", None, DVec3::ZERO),
        SkeletonJoint::new("Spine", Some(0), DVec3::Y * 0.2),
        SkeletonJoint::new("Spine1", Some(1), DVec3::Y * 0.2),
        SkeletonJoint::new("Neck", Some(2), DVec3::Y * 0.2),
        SkeletonJoint::new("Head", Some(3), DVec3::Y * 0.1),
    ];
    for (name, sign) in [("Left", 1.0), ("Right", -1.0)] {
        let first = joints.len();
        for (at, mut joint) in side(name, sign).into_iter().enumerate() {
            if [1, 2, 4, 5].contains(&at) {
                joint.parent = Some(first + at - 1);
            }
            joints.push(joint);
        }
    }
    Skeleton::new(joints).expect("a skeleton")
}

#[test]
fn an_avatar_rests_in_the_t_pose_and_moves_as_the_clip_does() {
    let skeleton = Arc::new(figure());
    let anatomy = chereme_motion::BodyAnatomy::detect_anatomy(&skeleton);
    let at = |name: &str| skeleton.find_joint(name).expect("a joint");
    let rest = anatomy.t_pose(&skeleton);
    for (name, direction) in [("Left", DVec3::X), ("Right", -DVec3::X)] {
        for (from, to, want) in [
            ("Arm", "ForeArm", direction),
            ("ForeArm", "Hand", direction),
            ("UpLeg", "Leg", -DVec3::Y),
        ] {
            let [from, to] = [from, to].map(|part| rest.model_joint_position(at(&format!("{name}{part}"))));
            assert!((to - from).normalize().distance(want) < 1e-6, "{name} {from} {to}");
        }
    }
    let mut channels: Vec<JointChannel> = (0..skeleton.len())
        .map(|joint| JointChannel {
            rotations: (0..10)
                .map(|frame| DQuat::from_rotation_x(0.05 * frame as f64 * (joint % 3) as f64))
                .collect(),
            translations: None,
        })
        .collect();
    channels[0].translations = Some((0..10).map(|frame| DVec3::new(0.0, 0.9, 0.01 * frame as f64)).collect());
    let clip = Clip::new(Arc::clone(&skeleton), FrameRate::new(30, 1).expect("a rate"), channels).expect("a clip");
    let smile = vrma::ExpressionTrack {
        name: "happy".into(),
        weights: vec![0.5; 10],
    };
    let lids = vrma::ExpressionTrack {
        name: "lids.CB".into(),
        weights: (0..10).map(|frame| 0.1 * f64::from(frame)).collect(),
    };
    let face = vrma::AvatarFace {
        expressions: vec![smile, lids],
        gaze: (0..10).map(|frame| [f64::from(frame), -3.0]).collect(),
    };
    let bytes = vrma::write_vrma(&clip, &anatomy, &face, &GlbDescription::default()).expect("written");
    let length = u32::from_le_bytes(bytes[12..16].try_into().expect("four bytes")) as usize;
    let document: serde_json::Value = serde_json::from_slice(&bytes[20..20 + length]).expect("JSON");
    let extension = &document["extensions"]["VRMC_vrm_animation"];
    assert!(extension["humanoid"]["humanBones"]["leftLowerLeg"]["node"].is_number());
    assert!(extension["expressions"]["preset"]["happy"]["node"].is_number());
    for node in document["nodes"].as_array().expect("nodes") {
        assert!(node.get("rotation").is_none() && node.get("scale").is_none());
    }
    // Bones with known joints rotate as in the clip: their world rotations are the clip's, counted from the T-pose.
    let (scene, findings) = parse(&bytes).expect("a GLB");
    assert_eq!(findings, []);
    let again = scene.clip;
    // Movement of the face is read back as curves, not as joints.
    assert!(
        again
            .clip_skeleton()
            .skeleton_joints()
            .iter()
            .all(|it| skeleton.find_joint(&it.name).is_some())
    );
    let curves = scene.morphs.expect("a face");
    let last = curves.track_curves().iter().map(|curve| {
        let last = curve.values.column_values().last().flatten().expect("a number");
        (curve.name.as_str(), (last * 1e3).round() / 1e3)
    });
    let want = [
        ("happy", 0.5),
        ("lids.CB", 0.9),
        ("gaze_left_degrees", 9.0),
        ("gaze_up_degrees", -3.0),
    ];
    assert_eq!(last.collect::<Vec<_>>(), want);
    let hand = at("LeftHand");
    let own = again.clip_skeleton().find_joint("LeftHand").expect("a hand");
    for frame in 0..10 {
        let want = clip.model_pose(frame).model_joint_rotation(hand) * rest.model_joint_rotation(hand).inverse();
        let got = again.model_pose(frame).model_joint_rotation(own);
        assert!(want.angle_between(got) < 1e-3, "{frame}");
    }
    // Seen from the hand, its end has the same place as in the clip.
    let end = |clip: &Clip, hand: usize| {
        let joint = &clip.clip_skeleton().skeleton_joints()[hand];
        let pose = clip.model_pose(3);
        pose.model_joint_rotation(hand) * joint.tip.expect("the end of a hand")
    };
    assert!(end(&clip, hand).distance(end(&again, own)) < 1e-6);
}

/// Returns a figure whose bones all lie along +Z at rest, as some programs write them, standing in its only frame.
fn along_one_axis(standing: &Skeleton) -> Clip {
    let mut joints: Vec<SkeletonJoint> = Vec::new();
    let mut turns: Vec<DQuat> = Vec::new();
    for joint in standing.skeleton_joints() {
        // Joint n of the figure comes behind its pivot, at 2 n + 1.
        let above = joint.parent.map(|it| 2 * it + 1);
        let direction = joint.offset.normalize_or(DVec3::Z);
        let turn = DQuat::from_rotation_arc(DVec3::Z, direction);
        joints.push(SkeletonJoint::new(format!("p{}", joints.len()), above, DVec3::ZERO));
        let offset = DVec3::Z * joint.offset.length();
        joints.push(SkeletonJoint::new(joint.name.clone(), Some(joints.len() - 1), offset));
        turns.extend([turn, turn.inverse()]);
    }
    let skeleton = Arc::new(Skeleton::new(joints).expect("a skeleton"));
    let channels = turns.into_iter().map(|turn| JointChannel {
        rotations: vec![turn],
        translations: None,
    });
    let rate = FrameRate::new(30, 1).expect("a rate");
    Clip::new(skeleton, rate, channels.collect()).expect("a clip")
}

#[test]
fn an_avatar_stands_in_the_t_pose_however_its_body_rests() {
    let turned = |turn: DQuat| {
        let mut joints = figure().skeleton_joints().to_vec();
        joints[0].rest = turn;
        let skeleton = Arc::new(Skeleton::new(joints).expect("a skeleton"));
        Clip::from_rest_pose(skeleton, FrameRate::new(30, 1).expect("a rate"), 1)
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    for (rests, clip) in [
        ("standing", turned(DQuat::IDENTITY)),
        ("on its back", turned(DQuat::from_rotation_x(-quarter))),
        ("on its side", turned(DQuat::from_rotation_z(quarter))),
        ("facing -Z", turned(DQuat::from_rotation_y(2.0 * quarter))),
        ("as a line", along_one_axis(&figure())),
    ] {
        let anatomy = chereme_motion::BodyAnatomy::detect_anatomy(clip.clip_skeleton()).with_clip(&clip);
        let rest = anatomy.t_pose(clip.clip_skeleton());
        let at = |name: &str| rest.model_joint_position(clip.clip_skeleton().find_joint(name).expect("a joint"));
        for (from, to, want) in [
            ("Hips", "Neck", DVec3::Y),
            ("Neck", "Head", DVec3::Y),
            ("LeftArm", "LeftForeArm", DVec3::X),
            ("RightForeArm", "RightHand", -DVec3::X),
            ("LeftUpLeg", "LeftLeg", -DVec3::Y),
            ("RightLeg", "RightFoot", -DVec3::Y),
        ] {
            let is = (at(to) - at(from)).normalize();
            assert!(is.distance(want) < 1e-6, "{rests}: {from} to {to} is {is}");
        }
        // A neck may lean forward below a head that looks ahead.
        if rests == "as a line" {
            let mut leaning = figure().skeleton_joints().to_vec();
            leaning[4].offset = DVec3::new(0.0, 0.08, 0.06);
            let clip = along_one_axis(&Skeleton::new(leaning).expect("a skeleton"));
            let anatomy = chereme_motion::BodyAnatomy::detect_anatomy(clip.clip_skeleton()).with_clip(&clip);
            let head = clip.clip_skeleton().find_joint("Head").expect("a head");
            let turned = anatomy.t_pose(clip.clip_skeleton()).model_joint_rotation(head);
            assert!(turned.angle_between(DQuat::IDENTITY) < 1e-6, "{turned}");
        }
        let forward = anatomy.body_frame(&rest).expect("a trunk").forward;
        assert!(forward.distance(DVec3::Z) < 1e-6, "{rests}: faces {forward}");
    }
}

#[test]
fn bones_that_vrm_requires_are_counted() {
    let without = |parts: &[&str]| {
        let (mut joints, mut places): (Vec<SkeletonJoint>, Vec<Option<usize>>) = (Vec::new(), Vec::new());
        for joint in figure().skeleton_joints() {
            let kept = !parts.iter().any(|part| joint.name.ends_with(part));
            places.push(kept.then_some(joints.len()));
            if kept {
                let mut joint = joint.clone();
                joint.parent = joint.parent.and_then(|it| places[it]);
                joints.push(joint);
            }
        }
        let skeleton = Skeleton::new(joints).expect("a skeleton");
        vrma::missing_vrm_bones(&chereme_motion::BodyAnatomy::detect_anatomy(&skeleton))
    };
    assert_eq!(without(&[]), Vec::<&str>::new());
    let legs = ["leftUpperLeg", "leftLowerLeg", "leftFoot"].map(str::to_owned);
    let right = legs.clone().map(|it| it.replace("left", "right"));
    assert_eq!(without(&["Leg", "Foot"]), [legs, right].concat());
}
