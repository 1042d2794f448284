//! Synthesises signs from the tables that the animator uses, and transcribes them.

use std::f64::consts::TAU;
use std::sync::Arc;

use chereme_motion::{BodySide, Clip, FrameRate, HandFinger, JointChannel, Skeleton, SkeletonJoint};
use chereme_sign::hamnosys::angles::hand_angles;
use chereme_sign::hamnosys::{
    BodyLocation, CompassDirection, DirectedPath, DirectionAim, HandClass, HandPlace, HandsUsed, Handshape, ManualPart,
    MotionKind, MotionSize, PlaceContact, RepeatKind, SpatialDirection, ThumbPosition, WristMotion, orientation,
    to_names,
};
use glam::{DQuat, DVec3};

use super::*;

mod goldens;
pub(crate) mod movements;
mod restated;

/// A hand's place in the signer's space, the directions of its axis and palm, and its shape.
#[derive(Clone)]
pub(crate) struct Held {
    pub(crate) at: DVec3,
    pub(super) along: DVec3,
    pub(super) palm: DVec3,
    pub(super) shape: Handshape,
}

impl Held {
    pub(crate) fn new(at: [f64; 3], along: &str, palm: &str, class: HandClass) -> Self {
        let along: SpatialDirection = along.parse().expect("a direction");
        let palm: CompassDirection = palm.parse().expect("a palm");
        let mut shape = Handshape::default();
        shape.form.class = class;
        Self {
            at: at.into(),
            along: along.spatial_direction_vector().into(),
            palm: orientation::palm_direction_vector(along.spatial_direction_vector(), palm.compass_angle()).into(),
            shape,
        }
    }

    pub(crate) fn moved(&self, by: DVec3) -> Self {
        Self {
            at: self.at + by,
            ..self.clone()
        }
    }

    pub(super) fn turned(&self, turn: DQuat) -> Self {
        Self {
            along: turn * self.along,
            palm: turn * self.palm,
            ..self.clone()
        }
    }

    pub(crate) fn mirrored(&self) -> Self {
        let flip = |v: DVec3| DVec3::new(-v.x, v.y, v.z);
        Self {
            at: flip(self.at),
            along: flip(self.along),
            palm: flip(self.palm),
            shape: self.shape.clone(),
        }
    }
}

/// A body with two arms of 52 cm and hands with all their fingers.
fn body() -> Skeleton {
    let mut joints = vec![SkeletonJoint::new("Hips", None, DVec3::Y)];
    for (name, up) in [("Spine", 0.2), ("Neck", 0.3), ("Head", 0.1)] {
        let parent = joints.len() - 1;
        joints.push(SkeletonJoint::new(name, Some(parent), DVec3::Y * up));
    }
    for side in BodySide::BOTH_SIDES {
        let x = side.side_sign();
        let name = if side == BodySide::Left { "Left" } else { "Right" };
        let mut add = |name: String, parent: usize, at: DVec3| {
            joints.push(SkeletonJoint::new(name, Some(parent), at));
            joints.len() - 1
        };
        let collar = add(format!("{name}Shoulder"), 1, DVec3::new(0.04 * x, 0.25, 0.0));
        let arm = add(format!("{name}Arm"), collar, DVec3::new(0.13 * x, 0.0, 0.0));
        let fore = add(format!("{name}ForeArm"), arm, DVec3::new(0.28 * x, 0.0, 0.0));
        let hand = add(format!("{name}Hand"), fore, DVec3::new(0.24 * x, 0.0, 0.0));
        let digits = [
            ("Thumb", 0.03, 0.04),
            ("Index", 0.09, 0.025),
            ("Middle", 0.09, 0.005),
            ("Ring", 0.085, -0.015),
            ("Pinky", 0.08, -0.035),
        ];
        for (digit, out, front) in digits {
            let mut parent = hand;
            for (n, long) in [out, 0.04, 0.025, 0.02].into_iter().enumerate() {
                let at = DVec3::new(long * x, 0.0, if n == 0 { front } else { 0.0 });
                parent = add(format!("{name}Hand{digit}{}", n + 1), parent, at);
            }
        }
    }
    Skeleton::new(joints).expect("a tree")
}

/// Builds a clip: a hold of half a second, `seconds` of movement, and a hold. A hand that `at` leaves out
/// hangs at rest.
pub(crate) fn clip(seconds: f64, at: impl Fn(f64) -> [Option<Held>; 2]) -> (Clip, BodyAnatomy) {
    let skeleton = Arc::new(body());
    let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
    let rate = FrameRate::new(60, 1).expect("a rate");
    let hold = 10;
    let frames = (seconds * 60.0) as usize + 2 * hold;
    let mut poses = Vec::new();
    for frame in 0..frames {
        let time = (frame as f64 - hold as f64) / (frames - 2 * hold) as f64;
        let mut pose = skeleton.rest_pose();
        for (side, held) in BodySide::BOTH_SIDES.into_iter().zip(at(time.clamp(0.0, 1.0))) {
            let arm = anatomy.arm_chain(side).expect("an arm");
            let model = chereme_motion::ModelPose::from_local_pose(&skeleton, &pose);
            let frame = anatomy.body_frame(&model).expect("a trunk");
            let Some(held) = held else {
                let down = DQuat::from_rotation_arc(DVec3::X * side.side_sign(), DVec3::NEG_Y);
                pose.rotations[arm.upper] = down;
                continue;
            };
            let angles = hand_angles(&held.shape, BodyLanguage::default_body_language());
            anatomy.set_hand_angles(&skeleton, side, &angles, &mut pose);
            let turn = anatomy.hand_rotation(side, held.along, held.palm);
            pose.rotations[arm.hand] = turn.expect("fingers");
            // The wrist follows the palm; nothing here reads the bones of the arm.
            let wrist = frame.origin + held.at - held.along * 0.05;
            pose.translations[arm.hand] = wrist - model.model_joint_position(arm.forearm);
        }
        poses.push(pose);
    }
    let clip = Clip::from_poses(skeleton, rate, &poses).expect("a clip");
    (clip, anatomy)
}

pub(super) fn read(seconds: f64, at: impl Fn(f64) -> [Option<Held>; 2]) -> ManualPart {
    let (clip, anatomy) = clip(seconds, at);
    let written = transcribe_clip(&clip, &anatomy, &TranscribeOptions::synthesised_options()).expect("a sign");
    written.sign.parts.into_iter().next().expect("one part")
}

pub(crate) fn ease(time: f64) -> f64 {
    time * time * (3.0 - 2.0 * time)
}

pub(super) const ARM: f64 = 0.52;

pub(super) fn before_chest(class: HandClass) -> Held {
    Held::new([-0.15, -0.12, 0.30], "u", "l", class)
}

#[test]
fn a_downward_movement_is_transcribed_with_its_posture() {
    let own = before_chest(HandClass::Flat);
    let part = read(0.3, |time| {
        [Some(own.moved(DVec3::NEG_Y * (0.25 * ARM * ease(time)))), None]
    });
    assert_eq!(part.hands, HandsUsed::Dominant);
    let shape = part.posture.shape.dominant_value().expect("a shape");
    assert_eq!(shape.form.class, HandClass::Flat);
    assert_eq!(
        part.posture.extended.dominant_value(),
        Some(&DirectionAim::aim_at(SpatialDirection::UP_DIRECTION))
    );
    assert_eq!(
        part.posture.palm.dominant_value(),
        Some(&DirectionAim::aim_at(CompassDirection::L))
    );
    let [motion] = part.actions.as_slice() else {
        panic!("{:?}", part.actions);
    };
    let MotionKind::Directed(DirectedPath { direction, size, .. }) = &motion.kind else {
        panic!("{motion:?}");
    };
    assert_eq!((*direction, size.first), (SpatialDirection::DOWN_DIRECTION, None));
}

#[test]
fn repeated_strokes_become_one_repeated_movement() {
    let own = before_chest(HandClass::Fist);
    let there = |time: f64| -> f64 {
        // Out, back, and out again, each with its stop.
        let third = (time * 3.0).min(2.999);
        let share = ease(third.fract());
        if third as usize == 1 { 1.0 - share } else { share }
    };
    let part = read(0.9, |time| {
        [Some(own.moved(DVec3::Z * (0.13 * ARM * there(time)))), None]
    });
    let [motion] = part.actions.as_slice() else {
        panic!("{:?}", part.actions);
    };
    let MotionKind::Repeated { motion, repetition } = &motion.kind else {
        panic!("{motion:?}");
    };
    assert_eq!(repetition.repeat, RepeatKind::FromStart);
    let MotionKind::Directed(directed) = &motion.kind else {
        panic!("{motion:?}");
    };
    assert_eq!(directed.direction, SpatialDirection::OUT_DIRECTION);
    assert_eq!(directed.size.first, Some(MotionSize::Small));

    let part = read(1.1, |time| {
        let (sin, cos) = (TAU * 2.0 * ease(time)).sin_cos();
        let at = DVec3::new(cos - 1.0, sin, 0.0) * (0.14 * ARM);
        [Some(own.moved(at)), None]
    });
    let MotionKind::Repeated { motion, .. } = &part.actions[0].kind else {
        panic!("{:?}", part.actions);
    };
    let MotionKind::Circular(circle) = &motion.kind else {
        panic!("{motion:?}");
    };
    assert_eq!(
        (circle.axis, circle.size.first),
        (SpatialDirection::OUT_DIRECTION, None)
    );
}

#[test]
fn wrist_motions_and_handshape_changes_are_distinguished_from_paths() {
    let own = before_chest(HandClass::Fist);
    let part = read(0.56, |time| {
        let nod = 0.5 * (TAU * 2.0 * time).sin();
        [Some(own.turned(DQuat::from_rotation_z(nod))), None]
    });
    let MotionKind::Wrist { motion, size } = &part.actions[0].kind else {
        panic!("{:?}", part.actions);
    };
    assert_eq!((*motion, *size), (WristMotion::Nodding, None));

    let flat = before_chest(HandClass::Flat);
    let (a, b) = (own.clone(), flat);
    let part = read(0.3, |time| [Some(if time < 0.5 { a.clone() } else { b.clone() }), None]);
    let MotionKind::Target { motion: None, posture } = &part.actions[0].kind else {
        panic!("{:?}", part.actions);
    };
    let shape = posture.shape.dominant_value().expect("a shape");
    assert_eq!(shape.form.class, HandClass::Flat);
}

#[test]
fn mirrored_hands_are_transcribed_once() {
    let own = before_chest(HandClass::Flat);
    let part = read(0.3, |time| {
        let now = own.moved(DVec3::new(-0.1, 0.08, 0.0) * ease(time));
        let other = now.mirrored();
        [Some(now), Some(other)]
    });
    let HandsUsed::Both(symmetry) = part.hands else {
        panic!("{:?}", part.hands);
    };
    assert!(symmetry.left_right && !symmetry.up_down && !symmetry.out_of_phase);
    assert!(part.posture.palm.other_value().is_none());
    assert_eq!(part.actions.len(), 1);
}

#[test]
fn the_left_handed_sign_is_written_as_the_right_handed_one() {
    let own = Held::new([-0.15, -0.12, 0.30], "ol", "dl", HandClass::Finger2);
    let course = |time: f64| own.moved(DVec3::new(-0.1, 0.02, 0.03) * ease(time));
    let right = read(0.3, |time| [Some(course(time)), None]);
    let (clip, anatomy) = clip(0.3, |time| [None, Some(course(time).mirrored())]);
    let options = TranscribeOptions {
        dominant: BodySide::Left,
        ..TranscribeOptions::synthesised_options()
    };
    let left = transcribe_clip(&clip, &anatomy, &options).expect("a sign");
    assert_eq!(left.sign.parts, vec![right]);
}

#[test]
fn the_nondominant_hand_alone_is_recognised_even_with_its_arm_stretched_out() {
    let own = Held::new([0.15, -0.12, 0.30], "or", "dr", HandClass::Finger2);
    let sideways = DVec3::new(0.50, 0.08, -0.27);
    let found = read(0.5, |time| [None, Some(own.moved(sideways * ease(time / 0.5)))]);
    assert_eq!(found.hands, HandsUsed::Nondominant);
    let shape = found.posture.shape.dominant_value().expect("a shape");
    assert_eq!(shape.form.class, HandClass::Finger2);
    let direction = found.posture.extended.dominant_value().expect("a direction");
    assert_eq!(direction.first.to_string(), "or");
    assert!(!found.actions.is_empty());
}

#[test]
fn a_finger_at_the_chin_touches_it() {
    let (clip, anatomy) = clip(0.3, |_| [None, None]);
    let model = clip.model_pose(0);
    let chin = anatomy
        .landmark_place_position(clip.clip_skeleton(), &model, "chin")
        .expect("a chin");
    let origin = anatomy.body_frame(&model).expect("a trunk").origin;
    // The tip of a straight index finger is 17.5 cm from the wrist and 2.5 cm to the thumb's side.
    let mut own = Held::new([0.0; 3], "u", "l", HandClass::Finger2);
    own.shape.form.thumb = Some(ThumbPosition::Across);
    let tip = DVec3::Y * 0.125 - DVec3::Z * 0.025;
    let part = read(0.3, |_| [Some(own.moved(chin - origin - tip)), None]);
    let Some(HandPlace::Body(place)) = &part.posture.place else {
        panic!("{:?}", part.posture.place);
    };
    assert_eq!(place.site.map(|site| site.at), Some(BodyLocation::Chin));
    assert_eq!(place.contact, Some(PlaceContact::Touch));
    assert!(place.by.is_some());
    assert!(part.actions.is_empty(), "{:?}", part.actions);
}

#[test]
fn a_place_touched_only_in_passing_is_brushed() {
    let (clip, anatomy) = clip(0.3, |_| [None, None]);
    let model = clip.model_pose(0);
    let chin = anatomy
        .landmark_place_position(clip.clip_skeleton(), &model, "chin")
        .expect("a chin");
    let origin = anatomy.body_frame(&model).expect("a trunk").origin;
    let mut own = Held::new([0.0; 3], "u", "l", HandClass::Finger2);
    own.shape.form.thumb = Some(ThumbPosition::Across);
    let tip = DVec3::Y * 0.125 - DVec3::Z * 0.025;
    let part = read(0.4, |time| {
        let across = 2.0 * ease(time) - 1.0;
        let by = DVec3::new(-0.14 * across, 0.0, 0.12 * across * across);
        [Some(own.moved(chin - origin - tip + by)), None]
    });
    let MotionKind::Target { posture, .. } = &part.actions[0].kind else {
        panic!("{:?}", part.actions);
    };
    let Some(HandPlace::Body(place)) = &posture.place else {
        panic!("{posture:?}");
    };
    assert_eq!(place.contact, Some(PlaceContact::Brushing));
    assert_eq!(place.site.map(|site| site.at), Some(BodyLocation::Chin));
}

#[test]
fn a_repetition_that_grows_each_time_is_increasing() {
    let own = before_chest(HandClass::Fist);
    let growth = |by: f64| {
        let part = read(1.5, |time| {
            // Out and back and out, and so on, each with its stop.
            let fifth = (time * 5.0).min(4.999);
            let stroke = fifth as usize;
            let far = by.powi(stroke.div_ceil(2) as i32);
            let share = ease(fifth.fract());
            let there = if stroke % 2 == 1 { 1.0 - share } else { share };
            let size = if stroke % 2 == 1 { far / by } else { far };
            [Some(own.moved(DVec3::Z * (0.13 * ARM * size * there))), None]
        });
        match &part.actions[0].kind {
            MotionKind::Repeated { repetition, .. } => repetition.growth.map(|it| it.increasing),
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(growth(1.0), None);
    assert_eq!(growth(1.35), Some(true));
    assert_eq!(growth(1.0 / 1.35), Some(false));
}

#[test]
fn every_feature_and_stage_is_reported_in_symbols_with_its_frames() {
    let own = before_chest(HandClass::Flat);
    let (clip, anatomy) = clip(0.3, |time| {
        [Some(own.moved(DVec3::NEG_Y * (0.13 * ARM * ease(time)))), None]
    });
    let written = transcribe_clip(&clip, &anatomy, &TranscribeOptions::synthesised_options()).expect("a sign");
    let names = |text: &str| to_names(text).expect("symbols").join(" ");
    let reading = |kind: FeatureKind| {
        let feature = written.features.iter().find(|it| it.kind == kind);
        let feature = feature.expect("told");
        let next = feature.runner_up.as_ref();
        let next = next.map(|next| names(&next.text)).unwrap_or_default();
        (names(&feature.text), next)
    };
    assert_eq!(reading(FeatureKind::Handshape).0, "hamflathand");
    assert_eq!(reading(FeatureKind::Direction).0, "hamextfingeru");
    assert_eq!(reading(FeatureKind::Palm).0, "hampalml");
    assert_eq!(reading(FeatureKind::Course).0, "hammoved");
    assert_eq!(reading(FeatureKind::Movement).0, "hammoved hamsmallmod");
    assert!(reading(FeatureKind::Movement).1.contains("hamarc"));
    assert_eq!(reading(FeatureKind::Size), ("hamsmallmod".into(), String::new()));
    let [posture, action] = written.stages.as_slice() else {
        panic!("{:?}", written.stages);
    };
    assert_eq!((posture.action, action.action), (None, Some(1)));
    assert!(posture.frames.0 < posture.frames.1 && posture.frames.1 <= action.frames.0 + 1);
    assert!(action.frames.1 <= clip.clip_frame_count() && names(&action.text).starts_with("hammoved"));
    let of = |feature: &NotationFeature| match feature.action {
        None => posture.frames,
        Some(_) => action.frames,
    };
    assert!(written.features.iter().all(|it| it.frames == of(it)));
}

#[test]
fn transitions_from_and_to_rest_are_left_out() {
    let (sign, anatomy) = clip(0.3, |time| {
        let own = before_chest(HandClass::Flat);
        [Some(own.moved(DVec3::X * (0.13 * ease(time)))), None]
    });
    let (rest, _) = clip(0.1, |_| [None, None]);
    let transition = |a: &Clip, b: &Clip| -> Vec<_> {
        let (from, to) = (a.clip_pose_at(a.clip_frame_count() - 1), b.clip_pose_at(0));
        (1..24)
            .map(|n| {
                let share = ease(f64::from(n) / 24.0);
                let mut pose = from.clone();
                for joint in 0..pose.rotations.len() {
                    pose.rotations[joint] = from.rotations[joint].slerp(to.rotations[joint], share);
                    pose.translations[joint] = from.translations[joint].lerp(to.translations[joint], share);
                }
                pose
            })
            .collect()
    };
    let all = |clip: &Clip| {
        (0..clip.clip_frame_count())
            .map(|n| clip.clip_pose_at(n))
            .collect::<Vec<_>>()
    };
    let poses = [
        all(&rest),
        transition(&rest, &sign),
        all(&sign),
        transition(&sign, &rest),
        all(&rest),
    ]
    .concat();
    let long = Clip::from_poses(Arc::clone(sign.clip_skeleton()), sign.clip_frame_rate(), &poses).expect("a clip");
    let short = transcribe_clip(&sign, &anatomy, &TranscribeOptions::synthesised_options()).expect("a sign");
    let long = transcribe_clip(&long, &anatomy, &TranscribeOptions::synthesised_options()).expect("a sign");
    assert_eq!(long.sign.parts[0].actions, short.sign.parts[0].actions);
    assert!(long.frames.0 > 20, "{:?}", long.frames);
}

#[test]
fn drift_and_small_bends_of_captured_hands_are_no_separate_movement() {
    let own = before_chest(HandClass::Flat);
    let actions = |by: &dyn Fn(f64) -> DVec3| {
        let (made, anatomy) = clip(0.9, |time| [Some(own.moved(by(time))), None]);
        let found = transcribe_clip(&made, &anatomy, &TranscribeOptions::default()).expect("a sign");
        let mut parts = found.sign.parts.into_iter();
        parts.next().expect("one part").actions
    };
    // A drift of 2.5 cm during a hold.
    assert!(actions(&|time| DVec3::Y * (0.025 * ease(time))).is_empty());
    // The movement slows down half-way, and its path is bent by 7 mm.
    let slowing = actions(&|time| {
        let gone = time - 0.03 * (2.0 * TAU * time).sin();
        DVec3::new(0.3 * gone, 0.007 * (TAU / 2.0 * gone).sin(), 0.0)
    });
    let [motion] = slowing.as_slice() else {
        panic!("{slowing:?}");
    };
    assert!(matches!(
        motion.kind,
        MotionKind::Directed(DirectedPath { curve: None, .. })
    ));
}

#[test]
fn resting_hands_are_reported_as_a_finding() {
    let (clip, anatomy) = clip(0.4, |_| [None, None]);
    for clip in [clip.slice_clip_frames(0..1), clip] {
        let found = transcribe_clip(&clip, &anatomy, &TranscribeOptions::default()).expect("a posture");
        assert!(found.findings.iter().any(|it| it.contains("rest")));
        assert!(found.sign.parts[0].actions.is_empty());
        // A hand is never placed at its own arm.
        let Some(HandPlace::Body(place)) = &found.sign.parts[0].posture.place else {
            panic!("{:?}", found.sign);
        };
        assert_ne!(place.site.map(|it| it.at), Some(BodyLocation::LowerArm));
    }
}

#[test]
fn a_hand_that_trembles_in_the_lap_is_not_transcribed() {
    let lap = Held::new([0.05, -0.42, 0.2], "r", "d", HandClass::Flat);
    let found = read(1.0, |time| {
        let tremble = DVec3::X * 0.002 * (TAU * 14.0 * time).sin();
        let right = before_chest(HandClass::Flat).moved(DVec3::X * 0.15 * ease(time));
        [Some(right), Some(lap.moved(tremble))]
    });
    assert!(matches!(found.hands, HandsUsed::Dominant));
    assert!(found.posture.shape.other_value().is_none(), "{:?}", found.posture);
}

#[test]
fn clips_that_are_no_token_are_refused_and_missing_joints_reported() {
    let (whole, anatomy) = clip(0.3, |_| [Some(before_chest(HandClass::Flat)), None]);
    let empty = whole.slice_clip_frames(0..0);
    let outcome = |clip: &Clip, options: &TranscribeOptions| transcribe_clip(clip, &anatomy, options).map(|_| ());
    assert_eq!(
        outcome(&empty, &TranscribeOptions::synthesised_options()),
        Err(TranscribeError::Empty)
    );
    let short = TranscribeOptions {
        longest: 0.2,
        ..TranscribeOptions::synthesised_options()
    };
    assert!(matches!(outcome(&whole, &short), Err(TranscribeError::TooLong { .. })));

    let bone = Skeleton::new(vec![SkeletonJoint::new("bone", None, DVec3::ZERO)]).expect("a tree");
    let nothing = BodyAnatomy::detect_anatomy(&bone);
    let clip = Clip::from_rest_pose(Arc::new(bone), whole.clip_frame_rate(), 9);
    let error = transcribe_clip(&clip, &nothing, &TranscribeOptions::synthesised_options());
    assert_eq!(error.map(|_| ()), Err(TranscribeError::NoBody));

    // Fingers without their outer joints: the inner ones suffice, and the lack is reported.
    let keep = |joint: &SkeletonJoint| !(joint.name.contains("Hand") && joint.name.ends_with(['3', '4']));
    let joints: Vec<SkeletonJoint> = body().skeleton_joints().to_vec();
    let kept: Vec<usize> = (0..joints.len()).filter(|&n| keep(&joints[n])).collect();
    let place = |old: usize| kept.iter().position(|&n| n == old).expect("kept");
    let fewer: Vec<SkeletonJoint> = kept
        .iter()
        .map(|&n| SkeletonJoint {
            parent: joints[n].parent.map(place),
            ..joints[n].clone()
        })
        .collect();
    let channels: Vec<JointChannel> = kept.iter().map(|&n| whole.joint_channel(n).clone()).collect();
    let skeleton = Arc::new(Skeleton::new(fewer).expect("a tree"));
    let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
    let clip = Clip::new(skeleton, whole.clip_frame_rate(), channels).expect("a clip");
    let written = transcribe_clip(&clip, &anatomy, &TranscribeOptions::synthesised_options()).expect("a sign");
    let part = &written.sign.parts[0];
    let shape = part.posture.shape.dominant_value().expect("a shape");
    assert_eq!(shape.form.class, HandClass::Flat);
    let missing = format!("{} end", HandFinger::Index.finger_name());
    assert!(
        written.findings.iter().any(|finding| finding.contains(&missing)),
        "{:?}",
        written.findings
    );
}

#[test]
fn manners_are_recognised_by_duration_and_speed_profile() {
    let own = before_chest(HandClass::Fist);
    // A deliberate movement reaches its highest speed late.
    let late = |time: f64| ease(time.powf(1.25));
    let even = |time: f64| time;
    let manner = |seconds: f64, course: &dyn Fn(f64) -> f64| {
        let part = read(seconds, |time| {
            let by = DVec3::NEG_Y * (0.25 * ARM * course(time));
            [Some(own.moved(by)), None]
        });
        part.actions[0].manner
    };
    let usual = manner(0.27, &late);
    assert!(!usual.fast && !usual.slow && !usual.tense && !usual.halt, "{usual:?}");
    assert!(manner(0.16, &late).fast);
    assert!(manner(0.54, &late).slow);
    assert!(manner(0.56, &even).tense);
    let rested = manner(0.60, &|time: f64| late(((time - 0.5) / 0.5).max(0.0)));
    assert!(rested.rest && !rested.fast && !rested.slow, "{rested:?}");
    assert!(!usual.rest);
}

#[test]
fn the_residual_of_a_location_is_the_distance_of_the_hand_from_it() {
    let own = before_chest(HandClass::Flat);
    let (clip, anatomy) = clip(0.5, |_| [Some(own.clone()), None]);
    let options = TranscribeOptions::synthesised_options();
    let found = transcribe_clip(&clip, &anatomy, &options).expect("transcribed");
    let Some(HandPlace::Body(place)) = &found.sign.parts[0].posture.place else {
        panic!("{:?}", found.sign);
    };
    let location = found.features.iter().find(|it| it.kind == FeatureKind::Location);
    let location = location.expect("a location");
    let (off, apart) = off_place(&clip, &anatomy, &options, location.frame, place, Some(place), false)
        .expect("it has a body")
        .expect("it has the place");
    assert!(
        apart < 1e-12 && off * 100.0 + 1e-9 >= location.residual,
        "{off} {}",
        location.residual
    );
}

#[test]
fn noise_in_every_joint_adds_no_movement() {
    let own = before_chest(HandClass::Flat);
    let (made, anatomy) = clip(0.4, |time| {
        let down = DVec3::NEG_Y * (0.25 * ARM * ease(time));
        [Some(own.moved(down)), None]
    });
    let plain = transcribe_clip(&made, &anatomy, &TranscribeOptions::default()).expect("a sign");
    let mut seed = 3_u64;
    let mut next = || {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as f64 / 2f64.powi(31) - 0.5
    };
    let channels = made.joint_channels().iter().map(|channel| {
        let shaken = channel.rotations.iter().map(|rotation| {
            let by = DVec3::new(next(), next(), next()) * 0.07;
            (*rotation * DQuat::from_scaled_axis(by)).normalize()
        });
        JointChannel {
            rotations: shaken.collect(),
            translations: channel.translations.clone(),
        }
    });
    let channels = channels.collect();
    let shaken = Clip::new(made.clip_skeleton().clone(), made.clip_frame_rate(), channels).expect("a clip");
    let found = transcribe_clip(&shaken, &anatomy, &TranscribeOptions::default()).expect("a sign");
    assert_eq!(found.stages.len(), plain.stages.len(), "{:?}", found.stages);
    assert!(found.findings.iter().any(|it| it.contains("tremble")));
    assert!(!plain.findings.iter().any(|it| it.contains("tremble")));
}

#[test]
fn places_are_expected_as_exactly_as_hands_hold_their_directions_or_shapes() {
    use chereme_sign::hamnosys::FingerBend;
    let options = TranscribeOptions::default();
    let slack = |turned: f64, bend: Option<FingerBend>| {
        let mut held = Held::new([-0.15, -0.25, 0.35], "ol", "l", HandClass::Flat);
        held.shape.bends = [None, bend, bend, None, bend];
        let held = held.turned(DQuat::from_rotation_y(turned.to_radians()));
        let (clip, anatomy) = clip(0.5, |_| [Some(held.clone()), None]);
        let scene = transcribe_scene::SignerScene::read_signer_scene(&clip, &anatomy, &options).expect("a scene");
        precision::expected_place_slack(&scene, &transcribe_tree::SceneReadings::new(&scene, &options))
    };
    let odd = Some(FingerBend::Joints([0.9, 0.5, 0.3]));
    let made = tuned().reading.made;
    assert!(slack(0.0, None) < 1.01 * made);
    assert!(slack(0.0, odd) < 1.01 * made, "by its direction");
    assert!(slack(7.0, None) < 1.01 * made, "by its shape");
    assert_eq!(slack(7.0, odd), options.slack);
    let rising = [0.0, 0.4, 0.8, 1.2, 1.6].map(|turned| slack(turned, odd));
    for pair in rising.windows(2) {
        assert!(pair[0] < pair[1] && pair[1] < pair[0] + 0.006, "{rising:?}");
    }
}
