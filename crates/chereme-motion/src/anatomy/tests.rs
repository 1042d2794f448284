//! Tests of the parts and landmarks that anatomy finds, on generated bodies and on real files.

pub(crate) mod fixtures;

use glam::{DQuat, DVec3};
use proptest::prelude::*;

use super::*;
use crate::hand::HandAngles;
use crate::skeleton::SkeletonJoint;
use fixtures::conventions::{conventional_joint_name, naming_conventions};
use fixtures::real::{read_bvh, shared_bvh_files};
use fixtures::{
    BodyVariation, PLAIN_BODY_VARIATION, any_turn, body_variations, fixture_body, fixture_joint_roles, rename_joints,
};

fn worn(wear: BodyVariation) -> (Skeleton, BodyAnatomy) {
    let skeleton = fixture_body(wear);
    let anatomy = BodyAnatomy::with_roles(&skeleton, &fixture_joint_roles(&skeleton)).expect("its own names");
    (skeleton, anatomy)
}

/// Returns angles that hands can have, from weights between 0 and 1.
fn plausible(weights: [f64; HandAngles::HAND_ANGLE_COUNT]) -> HandAngles {
    let mut all = [0.0; HandAngles::HAND_ANGLE_COUNT];
    let thumb = [(-0.2, 1.6), (-0.3, 1.2), (-0.3, 1.5), (-0.3, 1.2), (-0.4, 1.4)];
    let finger = [(-0.4, 0.4), (-0.5, 1.7), (-0.1, 2.0), (-0.1, 1.6)];
    for (n, (angle, weight)) in all.iter_mut().zip(weights).enumerate() {
        let (low, high) = if n < 5 { thumb[n] } else { finger[(n - 5) % 4] };
        *angle = low + (high - low) * weight;
    }
    HandAngles::from_array(all)
}

fn without_end_joints(mut angles: HandAngles) -> HandAngles {
    for finger in &mut angles.fingers {
        finger.flexion[2] = 0.0;
    }
    angles
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn hand_angles_read_back_as_set(weights in proptest::array::uniform21(0.0f64..1.0)) {
        for (name, wear) in body_variations() {
            let (skeleton, anatomy) = worn(wear);
            for side in BodySide::BOTH_SIDES {
                let mut want = plausible(weights);
                if wear.joints == 2 {
                    want = without_end_joints(want);
                }
                let mut pose = skeleton.rest_pose();
                prop_assert!(anatomy.set_hand_angles(&skeleton, side, &want, &mut pose));
                let got = anatomy.hand_angles(&skeleton, side, &pose).expect("a hand");
                for (a, b) in want.to_array().into_iter().zip(got.to_array()) {
                    prop_assert!((a - b).abs() < 1e-6, "{name} {side:?}\n{want:?}\n{got:?}");
                }
            }
        }
    }

    #[test]
    fn equal_angles_give_equal_finger_directions_on_every_body(weights in proptest::array::uniform21(0.0f64..1.0)) {
        let angles = without_end_joints(plausible(weights));
        let bones = |wear: BodyVariation, side: BodySide| {
            let (skeleton, anatomy) = worn(wear);
            let mut pose = skeleton.rest_pose();
            anatomy.set_hand_angles(&skeleton, side, &angles, &mut pose);
            let model = ModelPose::from_local_pose(&skeleton, &pose);
            let along = anatomy.hand_direction(side, &model).expect("a hand");
            let palm = anatomy.palm_normal(side, &model).expect("a palm");
            let radial = palm.cross(along) * side.side_sign();
            let bone = |a, b| {
                let [a, b] = [a, b].map(|part| anatomy.part_joint(part).expect("a finger"));
                let bone = (model.model_joint_position(b) - model.model_joint_position(a)).normalize();
                DVec3::new(bone.dot(along), bone.dot(radial), bone.dot(palm))
            };
            let mut all: Vec<DVec3> = HandFinger::ALL_FINGERS
                .iter()
                .map(|&f| bone(BodyPart::Finger(side, f, 1), BodyPart::Finger(side, f, 2)))
                .collect();
            all.extend((0..2).map(|n| bone(BodyPart::Thumb(side, n), BodyPart::Thumb(side, n + 1))));
            all
        };
        let want = bones(PLAIN_BODY_VARIATION, BodySide::Right);
        for (name, wear) in body_variations() {
            for side in BodySide::BOTH_SIDES {
                for (a, b) in want.iter().zip(bones(wear, side)) {
                    prop_assert!(a.angle_between(b) < 0.02, "{name} {side:?}: {a} {b}");
                }
            }
        }
    }
}

#[test]
fn angles_have_the_signs_documented_in_the_hand_module() {
    let (skeleton, anatomy) = worn(BodyVariation {
        frames: any_turn,
        bent: 0.1,
        ..PLAIN_BODY_VARIATION
    });
    for side in BodySide::BOTH_SIDES {
        let show = |change: fn(&mut HandAngles)| {
            let mut angles = HandAngles::default();
            change(&mut angles);
            let mut pose = skeleton.rest_pose();
            anatomy.set_hand_angles(&skeleton, side, &angles, &mut pose);
            ModelPose::from_local_pose(&skeleton, &pose)
        };
        let (out, palm, front) = (DVec3::X * side.side_sign(), DVec3::NEG_Y, DVec3::Z);
        let bone = |model: &ModelPose, a, b| {
            let [a, b] = [a, b].map(|part| anatomy.part_joint(part).expect("a finger"));
            (model.model_joint_position(b) - model.model_joint_position(a)).normalize()
        };
        let index = |n| BodyPart::Finger(side, HandFinger::Index, n);
        let straight = show(|_| {});
        let along = anatomy.hand_direction(side, &straight).expect("a hand");
        assert!(along.dot(out) > 0.99);
        assert!(anatomy.palm_normal(side, &straight).expect("a palm").dot(palm) > 0.99);
        for n in 1..3 {
            assert!(bone(&straight, index(n), index(n + 1)).dot(along) > 1.0 - 1e-9);
        }
        assert!(bone(&straight, BodyPart::Thumb(side, 0), BodyPart::Thumb(side, 1)).dot(along) > 1.0 - 1e-9);
        let bent = show(|angles| angles.fingers[0].flexion = [1.5, 0.0, 0.0]);
        assert!(bone(&bent, index(1), index(2)).dot(palm) > 0.98);
        let spread = show(|angles| angles.fingers[0].spread = 0.5);
        assert!(bone(&spread, index(1), index(2)).dot(front) > 0.4);
        let thumb = |model: &ModelPose, n| bone(model, BodyPart::Thumb(side, n), BodyPart::Thumb(side, n + 1));
        let radial = show(|angles| angles.thumb.radial = 1.5);
        assert!(thumb(&radial, 0).dot(front) > 0.98);
        let palmar = show(|angles| angles.thumb.palmar = 1.0);
        assert!(thumb(&palmar, 0).dot(palm) > 0.8);
        let crossed = show(|angles| angles.thumb.flexion = [0.8, 0.0]);
        assert!(thumb(&crossed, 1).dot(-front) > 0.6);
        let opposed = show(|angles| {
            angles.thumb.palmar = 1.5;
            angles.thumb.opposition = 0.7;
            angles.thumb.flexion = [0.8, 0.0];
        });
        assert!(thumb(&opposed, 1).dot(along) > 0.3, "towards the little finger's base");
        assert!(thumb(&opposed, 1).dot(-front) > 0.3);
    }
}

#[test]
fn setting_hand_angles_changes_only_fingers_and_refuses_a_hand_without_any() {
    let (skeleton, anatomy) = worn(PLAIN_BODY_VARIATION);
    let rest = skeleton.rest_pose();
    let mut pose = rest.clone();
    let angles = plausible([0.7; HandAngles::HAND_ANGLE_COUNT]);
    assert!(anatomy.set_hand_angles(&skeleton, BodySide::Left, &angles, &mut pose));
    let channel = anatomy.finger_joints(BodySide::Left);
    assert_eq!(channel.len(), 15);
    for joint in 0..skeleton.len() {
        let changed = pose.rotations[joint] != rest.rotations[joint];
        assert_eq!(changed, channel.contains(&joint), "{}", skeleton.joint_at(joint).name);
    }
    let bare = Skeleton::new(vec![SkeletonJoint::new("LeftHand", None, DVec3::ZERO)]).expect("a tree");
    let anatomy = BodyAnatomy::detect_anatomy(&bare);
    let mut pose = bare.rest_pose();
    assert!(!anatomy.set_hand_angles(&bare, BodySide::Left, &angles, &mut pose));
    assert_eq!(anatomy.hand_angles(&bare, BodySide::Left, &pose), None);
}

#[test]
fn a_hand_around_a_ball_has_an_arch_inside_the_palm() {
    let wear = BodyVariation {
        frames: any_turn,
        metacarpals: true,
        ..PLAIN_BODY_VARIATION
    };
    let (skeleton, anatomy) = worn(wear);
    // The distance by which the fingers' bases are carried towards the palm, in metres.
    let arched = |side: BodySide, bend: f64, spread: f64| {
        let mut angles = HandAngles::default();
        for (finger, outwards) in angles.fingers.iter_mut().zip([0.5, 0.0, -0.5, -1.0]) {
            finger.flexion = [bend, bend, 0.5 * bend];
            finger.spread = spread * outwards;
        }
        let rest = skeleton.rest_pose();
        let mut pose = rest.clone();
        assert!(anatomy.set_hand_angles(&skeleton, side, &angles, &mut pose));
        let back = anatomy.hand_angles(&skeleton, side, &pose).expect("fingers");
        let off = back.to_array().into_iter().zip(angles.to_array());
        assert!(off.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < 1e-6);
        let [before, after] = [&rest, &pose].map(|pose| ModelPose::from_local_pose(&skeleton, pose));
        let palm = anatomy.palm_normal(side, &before).expect("a palm");
        HandFinger::ALL_FINGERS.map(|finger| {
            let base = anatomy.part_joint(BodyPart::Finger(side, finger, 1)).expect("a base");
            (after.model_joint_position(base) - before.model_joint_position(base)).dot(palm)
        })
    };
    for side in BodySide::BOTH_SIDES {
        for (bend, spread) in [(1.0, 0.0), (0.0, 0.35), (-0.2, 0.35), (1.2, -0.2)] {
            assert_eq!(arched(side, bend, spread), [0.0; 4], "{bend} {spread}");
        }
        let [index, middle, ring, little] = arched(side, 0.9, 0.35);
        assert_eq!([index, middle], [0.0; 2]);
        assert!(ring > 0.001 && little > 2.0 * ring && little < 0.03, "{ring} {little}");
    }
}

#[test]
fn every_part_is_found_in_every_convention_without_doubt() {
    let plain = fixture_body(PLAIN_BODY_VARIATION);
    let mut all = naming_conventions();
    let motion_builder = all[0].2.clone();
    for prefix in [
        "mixamorig:",
        "mixamorig_",
        "mixamorig",
        "mixamorig7:",
        "Anna_",
        "Character1_",
    ] {
        let mut names = motion_builder.clone();
        for (_, name) in &mut names {
            *name = String::leak(format!("{prefix}{name}"));
        }
        all.push((prefix, ["Right", "Left"], names));
    }
    for (convention, sides, names) in all {
        let skeleton = rename_joints(&plain, |_, name| {
            conventional_joint_name(name.parse().expect("a part"), sides, &names)
        });
        let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
        for joint in 0..skeleton.len() {
            let part: BodyPart = plain.joint_at(joint).name.parse().expect("a part");
            let name = &skeleton.joint_at(joint).name;
            assert_eq!(anatomy.part_joint(part), Some(joint), "{convention}: {part} {name}");
        }
        assert_eq!(anatomy.ambiguous_parts(), [], "{convention}");
        assert_eq!(anatomy.missing_parts(), [], "{convention}");
    }
}

#[test]
fn joints_with_meaningless_names_are_identified_by_topology_and_side() {
    for (wear_name, wear) in body_variations() {
        let plain = fixture_body(wear);
        let skeleton = rename_joints(&plain, |n, _| format!("joint_{n}"));
        let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
        for joint in 0..skeleton.len() {
            let part: BodyPart = plain.joint_at(joint).name.parse().expect("a part");
            assert_eq!(anatomy.part_joint(part), Some(joint), "{wear_name}: {part}");
            assert_eq!(
                anatomy.part_evidence(part),
                Some(PartEvidence::Topology),
                "{wear_name}: {part}"
            );
        }
    }
}

#[test]
fn doubled_and_missing_parts_are_reported() {
    let skeleton = Skeleton::new(vec![
        SkeletonJoint::new("Hips", None, DVec3::ZERO),
        SkeletonJoint::new("LeftHand", Some(0), DVec3::X),
        SkeletonJoint::new("left_hand", Some(0), DVec3::Y),
    ])
    .expect("a tree");
    let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
    let hand = BodyPart::Hand(BodySide::Left);
    let [ambiguity] = anatomy.ambiguous_parts() else {
        panic!("{:?}", anatomy.ambiguous_parts());
    };
    assert_eq!((ambiguity.part, ambiguity.taken), (hand, 1));
    assert_eq!(ambiguity.others, [2]);
    assert!(anatomy.missing_parts().contains(&BodyPart::Hand(BodySide::Right)));
    assert!(!anatomy.missing_parts().contains(&hand) && !anatomy.missing_parts().contains(&BodyPart::Jaw));
}

#[test]
fn mirrored_joints_are_found_even_if_they_are_no_known_part() {
    let skeleton = Skeleton::new(vec![
        SkeletonJoint::new("Hips", None, DVec3::ZERO),
        SkeletonJoint::new("LHipJoint", Some(0), DVec3::X),
        SkeletonJoint::new("LeftUpLeg", Some(1), DVec3::X),
        SkeletonJoint::new("RHipJoint", Some(0), DVec3::NEG_X),
        SkeletonJoint::new("RightUpLeg", Some(3), DVec3::NEG_X),
        SkeletonJoint::new("LeftHand", Some(0), DVec3::X),
        SkeletonJoint::new("strap", Some(5), DVec3::X),
        SkeletonJoint::new("belt", Some(0), DVec3::Z),
    ])
    .expect("a tree");
    let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
    let map = anatomy.mirror_map(&skeleton);
    let want = [Some(0), Some(3), Some(4), Some(1), Some(2), None, None, Some(7)];
    assert_eq!(map, want);
    let (skeleton, anatomy) = worn(PLAIN_BODY_VARIATION);
    let map = anatomy.mirror_map(&skeleton);
    for (joint, other) in map.iter().enumerate() {
        let other = other.expect("both sides are there");
        assert_eq!(map[other], Some(joint));
        let at = |j| skeleton.rest_model_pose().model_joint_position(j);
        assert!(at(joint).abs_diff_eq(at(other) * DVec3::new(-1.0, 1.0, 1.0), 1e-9));
    }
}

#[test]
fn units_and_axes_are_detected_in_every_orientation() {
    for up in ["+X", "-X", "+Y", "-Y", "+Z", "-Z"] {
        for left in ["+X", "-X", "+Y", "-Y", "+Z", "-Z"] {
            let Ok(axes) = format!("{up},{left}").parse::<crate::SignerAxes>() else {
                continue;
            };
            for (name, metres) in [
                ("m", 1.0),
                ("cm", 0.01),
                ("mm", 0.001),
                ("inch", 0.0254),
                ("acclaim", 0.0254 / 0.45),
            ] {
                let wear = BodyVariation {
                    axes: axes.to_model().inverse(),
                    unit: 1.0 / metres,
                    ..PLAIN_BODY_VARIATION
                };
                let (skeleton, anatomy) = worn(wear);
                let guess = anatomy.guess_convention(&skeleton, None);
                assert_eq!(guess.unit_name, name);
                assert!((guess.convention.metres_per_unit - metres).abs() < 1e-12);
                assert_eq!(guess.convention.axes, axes);
                assert!(guess.confidence > 0.9, "{guess:?}");
            }
        }
    }
    let (_, plain) = worn(PLAIN_BODY_VARIATION);
    let stature = plain.anatomy_measures().expect("measures").stature;
    for (name, units, metres) in [
        ("cm", 100.0, 0.01),
        ("cm", 230.0, 0.01),
        ("inch", 48.0, 0.0254),
        ("mm", 1000.0, 0.001),
        ("m", 1.0, 1.0),
    ] {
        let (skeleton, anatomy) = worn(BodyVariation {
            unit: units / stature,
            ..PLAIN_BODY_VARIATION
        });
        let guess = anatomy.guess_convention(&skeleton, None);
        assert_eq!(guess.unit_name, name, "{units} {guess:?}");
        assert!((guess.convention.metres_per_unit - metres).abs() < 1e-12);
    }
    for metres in [0.3048, 0.0027] {
        let (skeleton, anatomy) = worn(BodyVariation {
            unit: 1.0 / metres,
            ..PLAIN_BODY_VARIATION
        });
        let guess = anatomy.guess_convention(&skeleton, None);
        assert_eq!(guess.unit_name, "unknown");
        let off = guess.convention.metres_per_unit / metres;
        assert!((0.9..1.1).contains(&off), "{guess:?}");
    }
    let chain = Skeleton::new(vec![
        SkeletonJoint::new("base", None, DVec3::ZERO),
        SkeletonJoint::new("child", Some(0), DVec3::Y * 8.0),
    ])
    .expect("a tree");
    let guess = BodyAnatomy::detect_anatomy(&chain).guess_convention(&chain, None);
    assert_eq!((guess.unit_name, guess.confidence), ("unknown", 0.0));
    assert!(guess.reasons.iter().any(|reason| reason.contains("say the unit")));
}

#[test]
fn body_measures_equal_the_built_body_and_are_those_of_a_person() {
    let (_, anatomy) = worn(PLAIN_BODY_VARIATION);
    let m = anatomy.anatomy_measures().expect("measures");
    let near = |a: f64, b: f64, by: f64| assert!((a - b).abs() < by, "{a} {b}");
    near(m.stature, 1.75, 0.05);
    near(m.arm, 0.53, 1e-9);
    near(m.shoulder_width, 0.36, 1e-9);
    near(m.hand, 0.182, 0.005);
    near(m.head, 0.226, 0.02);
    near(m.trunk, 0.48, 1e-6);
}

#[test]
fn the_tip_of_a_hand_without_fingers_is_its_end_only_if_a_hand_can_be_that_long() {
    let (whole, anatomy) = worn(PLAIN_BODY_VARIATION);
    let usual = anatomy.anatomy_measures().expect("measures").hand;
    let hands = BodySide::BOTH_SIDES.map(|side| anatomy.part_joint(BodyPart::Hand(side)).expect("a hand"));
    let with_tip = |far: f64| {
        let mut joints = whole.skeleton_joints().to_vec();
        let below = |n: &usize| {
            hands
                .iter()
                .any(|&hand| whole.joint_ancestors(*n).skip(1).any(|it| it == hand))
        };
        let fingers: Vec<usize> = (0..joints.len()).filter(below).collect();
        for hand in hands {
            joints[hand].tip = Some(DVec3::X * far);
        }
        let kept: Vec<usize> = (0..joints.len()).filter(|n| !fingers.contains(n)).collect();
        let joints = kept.iter().map(|&n| SkeletonJoint {
            parent: joints[n].parent.and_then(|up| kept.iter().position(|&it| it == up)),
            ..joints[n].clone()
        });
        let skeleton = Skeleton::new(joints.collect()).expect("a tree");
        let anatomy = BodyAnatomy::with_roles(&skeleton, &fixture_joint_roles(&skeleton)).expect("its own names");
        anatomy.anatomy_measures().expect("measures").hand
    };
    assert!((with_tip(0.17) - 0.17).abs() < 1e-9, "a plausible tip");
    for far in [0.07, 0.4] {
        let hand = with_tip(far);
        assert!((hand / usual - 1.0).abs() < 0.15, "tip at {far}: {hand}");
    }
}

#[test]
fn every_landmark_is_plausibly_placed_and_turns_with_body_and_head() {
    for (wear_name, wear) in body_variations() {
        let (skeleton, anatomy) = worn(wear);
        let turn = DQuat::from_rotation_z(0.4) * any_turn(5);
        let mut pose = skeleton.rest_pose();
        pose.rotations[0] = turn * pose.rotations[0];
        pose.translations[0] += DVec3::new(3.0, -1.0, 2.0);
        let (rest, moved) = (skeleton.rest_model_pose(), ModelPose::from_local_pose(&skeleton, &pose));
        for name in BodyAnatomy::landmark_names() {
            let at = anatomy
                .landmark_place_position(&skeleton, &rest, &name)
                .unwrap_or_else(|| panic!("{name}"));
            let there = anatomy
                .landmark_place_position(&skeleton, &moved, &name)
                .expect("placed at rest");
            let want = moved.model_joint_position(0) + turn * (at - rest.model_joint_position(0));
            assert!(there.abs_diff_eq(want, 1e-6 * wear.unit), "{wear_name} {name}");
        }
    }
    let (skeleton, anatomy) = worn(PLAIN_BODY_VARIATION);
    let rest = skeleton.rest_model_pose();
    for (name, want) in [
        ("nose", [0.0, 1.61, 0.13]),
        ("chin", [0.0, 1.54, 0.10]),
        ("left-eye", [0.03, 1.64, 0.09]),
        ("right ear", [-0.08, 1.63, 0.0]),
        ("forehead", [0.0, 1.69, 0.1]),
        ("chest", [0.0, 1.30, 0.12]),
        ("belly", [0.0, 1.08, 0.12]),
        ("left-shoulder", [0.18, 1.47, 0.0]),
        ("index tip left", [0.89, 1.43, 0.03]),
        ("left-palm", [0.76, 1.415, 0.0]),
        ("neutral-space", [0.0, 1.19, 0.36]),
    ] {
        let at = anatomy.landmark_place_position(&skeleton, &rest, name).expect(name);
        assert!(at.distance(want.into()) < 0.03, "{name}: {at}");
    }
    let mut nod = skeleton.rest_pose();
    let head = anatomy.part_joint(BodyPart::Head).expect("a head");
    nod.rotations[head] = DQuat::from_rotation_y(1.0);
    let nose = anatomy
        .landmark_place_position(&skeleton, &ModelPose::from_local_pose(&skeleton, &nod), "nose")
        .expect("nose");
    assert!(nose.x > 0.09);
    assert_eq!(anatomy.landmark_place_position(&skeleton, &rest, "left-antler"), None);
    assert_eq!(anatomy.landmark_place_position(&skeleton, &rest, "ear"), None);
}

#[test]
fn body_space_converts_in_both_directions_and_distinguishes_left_from_right() {
    let (skeleton, anatomy) = worn(PLAIN_BODY_VARIATION);
    let mut pose = skeleton.rest_pose();
    pose.rotations[0] = DQuat::from_rotation_y(std::f64::consts::PI);
    let model = ModelPose::from_local_pose(&skeleton, &pose);
    let frame = anatomy.body_frame(&model).expect("a trunk");
    assert!(frame.left.abs_diff_eq(DVec3::NEG_X, 1e-9));
    assert!(frame.forward.abs_diff_eq(DVec3::NEG_Z, 1e-9));
    let at = DVec3::new(0.3, 1.2, -0.4);
    assert!(frame.to_model(frame.to_body(at)).abs_diff_eq(at, 1e-12));
    assert!((frame.body_frame_rotation() * DVec3::Z).abs_diff_eq(frame.forward, 1e-9));
}

#[test]
fn a_hand_turned_to_a_direction_and_palm_reads_back_both() {
    let (skeleton, anatomy) = worn(BodyVariation {
        frames: any_turn,
        ..PLAIN_BODY_VARIATION
    });
    for side in BodySide::BOTH_SIDES {
        let turn = anatomy.hand_rotation(side, DVec3::Y, DVec3::Z).expect("a hand");
        let hand = anatomy.part_joint(BodyPart::Hand(side)).expect("a hand");
        let mut pose = skeleton.rest_pose();
        let above = skeleton.joint_parent(hand).expect("a forearm");
        pose.rotations[hand] = ModelPose::from_local_pose(&skeleton, &pose)
            .model_joint_rotation(above)
            .inverse()
            * turn;
        let model = ModelPose::from_local_pose(&skeleton, &pose);
        let along = anatomy.hand_direction(side, &model).expect("a hand");
        let palm = anatomy.palm_normal(side, &model).expect("a palm");
        assert!(along.abs_diff_eq(DVec3::Y, 1e-9) && palm.abs_diff_eq(DVec3::Z, 1e-9));
    }
}

#[test]
fn thousands_of_joints_are_processed_under_any_names() {
    for name in ["x", "LeftHand", "Hand", "LeftHandIndex1", "Spine", "A_x"] {
        for parent in [
            |n: usize| n - 1,
            |_| 0,
            |n: usize| (n - 1) / 2,
            |n: usize| n.saturating_sub(3),
        ] {
            let joint = |n: usize| SkeletonJoint::new(name, (n > 0).then(|| parent(n)), DVec3::Y);
            let skeleton = Skeleton::new((0..4_000).map(joint).collect()).expect("a tree");
            let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
            assert_eq!(anatomy.mirror_map(&skeleton).len(), 4_000);
        }
    }
}

/// The real files: end of the path, unit, axes, usual parts that are missing besides digits, and whether both hands
/// have fingers.
const REAL: [(&str, &str, &str, &str, bool); 19] = [
    ("test_freebvh.bvh", "cm", "+Y,+X", "", true),
    ("test_mocapbank.bvh", "cm", "+Y,+X", "right toes, left toes", false),
    ("rest.bvh", "acclaim", "+Y,+X", "", false),
    ("01_01.bvh", "acclaim", "+Y,+X", "", false),
    ("cmu_12_01_walk.bvh", "acclaim", "+Y,+X", "", false),
    ("pfnn_hierarchy.bvh", "m", "+Y,+X", "", false),
    ("walk01.bvh", "cm", "+Y,+X", "right toes, left toes", false),
    ("bvh_example.bvh", "inch", "+Z,-X", "", false),
    ("bvh_test2.bvh", "cm", "+Y,-X", "", false),
    ("Boxing_Toes.bvh", "cm", "+Y,-X", "", false),
    ("bvhio/example.bvh", "inch", "+Y,-X", "right toes, left toes", false),
    ("Rep1.bvh", "inch", "+Y,+X", "neck", false),
    ("abroad.bvh", "cm", "-Y,+X", "right toes, left toes", false),
    ("animics/test.bvh", "m", "-Y,+X", "right toes, left toes", false),
    ("victor.bvh", "cm", "-Y,+X", "right toes, left toes", false),
    ("create_db_m.bvh", "m", "-Z,+X", "", true),
    ("kateBVH.bvh", "cm", "+Y,+X", "", true),
    ("pirouette.bvh", "cm", "+Y,+X", "right toes, left toes", true),
    ("NGT Thanks.bvh", "cm", "+Y,+X", "", true),
];

#[test]
fn bodies_are_detected_in_shared_files() {
    for path in shared_bvh_files("motion/bvh") {
        let shown = path.display();
        let (skeleton, poses, _) = read_bvh(&path, 1).unwrap_or_else(|| panic!("{shown}"));
        let first = poses.first().map(|pose| ModelPose::from_local_pose(&skeleton, pose));
        let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
        assert_eq!(anatomy.ambiguous_parts(), [], "{shown}");
        let guess = anatomy.guess_convention(&skeleton, first.as_ref());
        let Some(&(_, unit, axes, missing, fingers)) = REAL.iter().find(|(end, ..)| shown.to_string().ends_with(end))
        else {
            continue;
        };
        assert_eq!(guess.unit_name, unit, "{shown} {guess:?}");
        assert_eq!(guess.convention.axes.to_string(), axes, "{shown} {guess:?}");
        assert!(guess.confidence > 0.9, "{shown} {guess:?}");
        let lacks: Vec<String> = anatomy
            .missing_parts()
            .iter()
            .filter(|part| !matches!(part, BodyPart::Finger(..) | BodyPart::Thumb(..)))
            .map(BodyPart::to_string)
            .collect();
        assert_eq!(lacks.join(", "), missing, "{shown}");
        let found = BodySide::BOTH_SIDES.map(|side| anatomy.has_fingers(side));
        assert_eq!(found, [fingers; 2], "{shown}");
    }
}

#[test]
fn real_hands_give_plausible_angles_that_set_them_again() {
    for path in shared_bvh_files("motion/bvh") {
        let shown = path.display();
        let (skeleton, poses, _) = read_bvh(&path, 1).unwrap_or_else(|| panic!("{shown}"));
        let Some(first) = poses.first() else {
            continue;
        };
        let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
        for side in BodySide::BOTH_SIDES
            .into_iter()
            .filter(|&side| anatomy.has_fingers(side))
        {
            let angles = anatomy.hand_angles(&skeleton, side, first).expect("fingers");
            let mut pose = first.clone();
            anatomy.set_hand_angles(&skeleton, side, &angles, &mut pose);
            let again = anatomy.hand_angles(&skeleton, side, &pose).expect("fingers");
            for (a, b) in angles.to_array().into_iter().zip(again.to_array()) {
                assert!((a - b).abs() < 1e-6, "{shown} {side:?}");
            }
            for finger in angles.fingers {
                assert!(
                    finger.flexion.iter().all(|f| (-0.8..2.2).contains(f)),
                    "{shown} {angles:?}"
                );
                assert!(finger.spread.abs() < 0.8, "{shown} {angles:?}");
            }
        }
    }
}

#[test]
fn the_thumb_is_at_the_radial_edge() {
    for (name, wear) in body_variations() {
        let (skeleton, anatomy) = worn(wear);
        let model = ModelPose::from_local_pose(&skeleton, &skeleton.rest_pose());
        for side in BodySide::BOTH_SIDES {
            let at = |landmark: &str| {
                let landmark = format!("{}-{landmark}", side.body_side_name());
                anatomy
                    .landmark_place_position(&skeleton, &model, &landmark)
                    .expect("a landmark")
            };
            let thumb = anatomy.part_joint(BodyPart::Thumb(side, 1)).expect("a thumb");
            let little = anatomy
                .part_joint(BodyPart::Finger(side, HandFinger::Little, 1))
                .expect("a finger");
            let [thumb, little] = [thumb, little].map(|joint| model.model_joint_position(joint));
            let out = at("hand-radial") - at("hand-ulnar");
            assert!(out.dot(thumb - little) > 0.0, "{name} {side:?}");
        }
    }
}
