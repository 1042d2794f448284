//! Tests of the limits of reaching and of the joints that it keeps.

use glam::{DQuat, DVec3};
use proptest::prelude::*;

use super::*;
use crate::anatomy::tests::fixtures::real::{read_bvh, shared_bvh_files};
use crate::anatomy::tests::fixtures::{
    BodyVariation, PLAIN_BODY_VARIATION, any_turn, body_variations, fixture_body, fixture_joint_roles,
};
use crate::anatomy::{BodyAnatomy, BodyPart};
use crate::pose::{LocalPose, ModelPose};
use crate::skeleton::Skeleton;

const ARM: [DVec3; 3] = [DVec3::ZERO, DVec3::new(0.2, -0.2, -0.05), DVec3::new(0.3, -0.05, 0.2)];

fn lengths([root, middle, end]: [DVec3; 3]) -> [f64; 2] {
    [root.distance(middle), middle.distance(end)]
}

fn solve(source: [DVec3; 3], target: DVec3) -> TwoBone {
    two_bone(source, target, &TwoBoneOptions::default()).expect("finite")
}

fn keeps_lengths(source: [DVec3; 3], solved: &TwoBone) {
    let now = lengths([source[0], solved.middle, solved.end]);
    for (a, b) in lengths(source).into_iter().zip(now) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
}

#[test]
fn odd_targets_are_solved_with_unchanged_bone_lengths() {
    let [first, second] = lengths(ARM);
    let straight = [DVec3::ZERO, DVec3::X * 0.3, DVec3::X * 0.55];
    let folded = [DVec3::ZERO, DVec3::X * 0.3, DVec3::ZERO];
    for (name, source, target, clamped) in [
        ("far away", ARM, DVec3::new(9.0, 3.0, -2.0), true),
        (
            "too near",
            ARM,
            DVec3::X * ((first - second).abs() * 0.5),
            first != second,
        ),
        ("at the root", straight, DVec3::ZERO, true),
        ("at the end", ARM, ARM[2], false),
        ("on the line of a straight arm", straight, DVec3::X * 0.4, false),
        ("behind a straight arm", straight, DVec3::NEG_X * 0.4, false),
        ("from a folded arm", folded, DVec3::Y * 0.4, false),
        ("folded on the root", folded, DVec3::ZERO, false),
    ] {
        let solved = solve(source, target);
        keeps_lengths(source, &solved);
        assert_eq!(solved.clamped, clamped, "{name}");
        let residual = solved.end.distance(target);
        assert!(clamped || residual < 1e-9, "{name}: {residual}");
    }
    let still = solve(ARM, ARM[2]);
    assert!(still.middle.abs_diff_eq(ARM[1], 1e-12) && still.end.abs_diff_eq(ARM[2], 1e-12));
    let poled = TwoBoneOptions {
        pole: Some(DVec3::X),
        ..TwoBoneOptions::default()
    };
    let solved = two_bone(straight, DVec3::X * 0.4, &poled).expect("a pole along the line");
    keeps_lengths(straight, &solved);
}

#[test]
fn non_finite_numbers_and_zero_length_bones_are_errors() {
    let nan = DVec3::new(0.1, f64::NAN, 0.0);
    let options = TwoBoneOptions::default();
    let bad = |source, target| two_bone(source, target, &options).expect_err("bad");
    assert_eq!(bad(ARM, nan), IkError::NotFinite("target"));
    assert_eq!(bad(ARM, DVec3::INFINITY), IkError::NotFinite("target"));
    assert_eq!(bad([nan, ARM[1], ARM[2]], ARM[2]), IkError::NotFinite("source"));
    let zero = bad([ARM[1], ARM[1], ARM[2]], ARM[0]);
    assert_eq!(zero, IkError::ZeroBone("first bone"));
    assert_eq!(bad([ARM[1]; 3], ARM[0]), IkError::ZeroBone("first bone"));
    assert_eq!(bad([ARM[0], ARM[2], ARM[2]], ARM[0]), IkError::ZeroBone("second bone"));
    let fab = |points: &[DVec3], target| solve_fabrik(points, target, &FabrikOptions::default()).expect_err("bad");
    assert_eq!(fab(&ARM, nan), IkError::NotFinite("target"));
    assert_eq!(fab(&[ARM[0], ARM[0], ARM[1]], ARM[2]), IkError::ZeroBone("bone"));
    assert_eq!(fab(&ARM[..1], ARM[2]), IkError::Short(1));
}

#[test]
fn the_end_lags_smoothly_behind_a_target_out_of_reach() {
    let [first, second] = lengths(ARM);
    let length = first + second;
    let direction = DVec3::new(0.6, 0.1, 0.3).normalize();
    let mut before = 0.0;
    for n in 0..2000 {
        let wanted = length * (0.95 + 0.0001 * f64::from(n));
        let solved = solve(ARM, direction * wanted);
        keeps_lengths(ARM, &solved);
        let reached = solved.end.length();
        assert!(reached + 1e-12 >= before && reached <= length * (1.0 + 1e-12));
        assert!(wanted > length || wanted - reached < 0.001, "{}", wanted - reached);
        assert_eq!(solved.soft, wanted > length * 0.996 + 1e-12, "{wanted}");
        before = reached;
    }
}

/// Generates vectors with components from -1 to 1.
fn vector() -> impl Strategy<Value = DVec3> {
    proptest::array::uniform3(-1.0f64..1.0).prop_map(DVec3::from)
}

/// Generates arms with bones of 10 to 50 cm that are bent by at least some degrees.
fn arms() -> impl Strategy<Value = [DVec3; 3]> {
    (vector(), vector(), vector(), 0.1f64..0.5, 0.1f64..0.5)
        .prop_map(|(root, a, b, first, second)| {
            let middle = root + a.normalize_or(DVec3::X) * first;
            [root, middle, middle + b.normalize_or(DVec3::Y) * second]
        })
        .prop_filter("bent", |[root, middle, end]| {
            let angle = (*middle - *root).angle_between(*end - *middle);
            (0.3..2.8).contains(&angle)
        })
}

fn reachable(source: [DVec3; 3], direction: DVec3, share: f64) -> DVec3 {
    let [first, second] = lengths(source);
    let (near, far) = ((first - second).abs(), (first + second) * 0.99);
    source[0] + direction.normalize_or(DVec3::Z) * (near + (far - near) * share)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn the_end_meets_reachable_targets_and_lengths_and_swivel_are_kept(
        source in arms(), direction in vector(), share in 0.02f64..1.0
    ) {
        let target = reachable(source, direction, share);
        let solved = solve(source, target);
        prop_assert!(solved.end.abs_diff_eq(target, 1e-9));
        keeps_lengths(source, &solved);
        let [root, middle, end] = source;
        let (line, new) = ((end - root).normalize(), (target - root).normalize());
        prop_assume!(line.dot(new) > -0.99);
        let was = DQuat::from_rotation_arc(line, new) * (middle - root).reject_from_normalized(line);
        let now = (solved.middle - root).reject_from_normalized(new);
        prop_assume!(now.length() > 1e-4 && was.length() > 0.05 * (root.distance(middle) + middle.distance(end)));
        prop_assert!(was.angle_between(now) < 1e-6, "{}", was.angle_between(now));
    }

    #[test]
    fn rotated_mirrored_and_scaled_arms_are_solved_alike(
        source in arms(), direction in vector(), share in 0.02f64..1.2, axis in vector(), pole in vector()
    ) {
        let target = reachable(source, direction, share);
        let solve = |map: &dyn Fn(DVec3) -> DVec3, pole: DVec3| {
            let options = TwoBoneOptions { pole: Some(pole), ..TwoBoneOptions::default() };
            two_bone(source.map(map), map(target), &options).expect("finite")
        };
        let plain = solve(&|p| p, pole);
        let turn = DQuat::from_axis_angle(axis.normalize_or(DVec3::X), 2.0);
        let mirror = DVec3::new(-1.0, 1.0, 1.0);
        let cases: [(&dyn Fn(DVec3) -> DVec3, DVec3); 3] = [
            (&|p| turn * p + axis, turn * pole),
            (&|p| p * mirror, pole * mirror),
            (&|p| p * 7.5, pole),
        ];
        for (map, pole) in cases {
            let mapped = solve(map, pole);
            prop_assert!(mapped.middle.abs_diff_eq(map(plain.middle), 1e-7));
            prop_assert!(mapped.end.abs_diff_eq(map(plain.end), 1e-7));
        }
    }

    #[test]
    fn small_steps_of_the_target_are_small_steps_of_the_elbow(
        source in arms(), a in vector(), b in vector()
    ) {
        let [first, second] = lengths(source);
        let (near, far) = ((first - second).abs(), first + second);
        let line = (source[2] - source[0]).normalize();
        let at = |w: f64| {
            let direction = (a + (b - a) * w).normalize_or(line);
            source[0] + direction * (near + (far - near) * (0.2 + 0.6 * w))
        };
        let mut before: Option<(DVec3, DVec3)> = None;
        for n in 0..=400 {
            let target = at(f64::from(n) / 400.0);
            let away = (target - source[0]).normalize().dot(line);
            let solved = solve(source, target);
            if let Some((was, middle)) = before.filter(|_| away > -0.8) {
                let step = target.distance(was);
                prop_assert!(solved.middle.distance(middle) < 12.0 * step + 1e-9);
            }
            before = Some((target, solved.middle));
        }
    }

    #[test]
    fn iterative_and_analytic_solutions_agree_in_the_plane(
        source in arms(), share in 0.15f64..0.95, turn in -0.8f64..0.8
    ) {
        let [root, middle, end] = source;
        let normal = (middle - root).cross(end - root).normalize();
        let direction = DQuat::from_axis_angle(normal, turn) * (end - root);
        let target = reachable(source, direction, share);
        let exact = solve(source, target);
        let options = FabrikOptions { tolerance: 1e-10, passes: 20_000, pole: None };
        let chain = solve_fabrik(&source, target, &options).expect("finite");
        prop_assert!(chain.residual < 1e-8, "{}", chain.residual);
        let side = |middle: DVec3| (middle - root).cross(target - root).dot(normal).signum();
        prop_assume!(side(chain.points[1]) == side(exact.middle));
        prop_assert!(chain.points[1].abs_diff_eq(exact.middle, 1e-5));
    }
}

#[test]
fn a_wavering_straight_source_does_not_flip_the_elbow() {
    let mut before: Option<DVec3> = None;
    for n in -50..=50 {
        let off = f64::from(n) * 2e-4;
        let source = [DVec3::ZERO, DVec3::new(0.28, off, 0.0), DVec3::X * 0.53];
        let pole = Some(DVec3::Y);
        let options = TwoBoneOptions {
            pole,
            ..TwoBoneOptions::default()
        };
        let solved = two_bone(source, DVec3::X * 0.35, &options).expect("finite");
        assert!(solved.middle.y > 0.1);
        if let Some(before) = before {
            assert!(before.distance(solved.middle) < 0.01);
        }
        before = Some(solved.middle);
    }
}

#[test]
fn fabrik_bends_a_straight_chain_and_stretches_towards_far_targets() {
    let line: Vec<DVec3> = (0..5).map(|n| DVec3::X * f64::from(n)).collect();
    let bent = solve_fabrik(&line, DVec3::X * 2.0, &FabrikOptions::default()).expect("finite");
    assert!(bent.residual < 1e-5, "{bent:?}");
    let far = solve_fabrik(&line, DVec3::Y * 9.0, &FabrikOptions::default()).expect("finite");
    assert!(far.points[4].abs_diff_eq(DVec3::Y * 4.0, 1e-12) && far.residual == 5.0);
    for chain in [&bent, &far] {
        for pair in chain.points.windows(2) {
            assert!((pair[0].distance(pair[1]) - 1.0).abs() < 1e-9);
        }
    }
}

fn worn(wear: BodyVariation) -> (Skeleton, BodyAnatomy) {
    let skeleton = fixture_body(wear);
    let anatomy = BodyAnatomy::with_roles(&skeleton, &fixture_joint_roles(&skeleton)).expect("its own names");
    (skeleton, anatomy)
}

/// Returns a posture with both arms bent in front of the body.
fn posture(skeleton: &Skeleton, anatomy: &BodyAnatomy, sway: f64) -> LocalPose {
    let mut pose = skeleton.rest_pose();
    for side in BodySide::BOTH_SIDES {
        let arm = anatomy.arm_chain(side).expect("an arm");
        for (joint, turn) in [
            (
                arm.upper,
                DQuat::from_rotation_y(-side.side_sign() * (0.6 + 0.1 * sway)),
            ),
            (arm.upper, DQuat::from_rotation_z(-side.side_sign() * 0.9)),
            (
                arm.forearm,
                DQuat::from_rotation_y(-side.side_sign() * (1.2 + 0.3 * sway)),
            ),
            (arm.hand, DQuat::from_rotation_x(0.4 + 0.2 * sway)),
        ] {
            let world = turn * ModelPose::from_local_pose(skeleton, &pose).model_joint_rotation(joint);
            let above = skeleton.joint_parent(joint).expect("no root");
            let above = ModelPose::from_local_pose(skeleton, &pose).model_joint_rotation(above);
            pose.rotations[joint] = (above.inverse() * world).normalize();
        }
    }
    pose
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_moved_wrist_reaches_its_target_and_only_the_arm_changes(by in vector(), spin in vector(), help in proptest::bool::ANY) {
        for (name, wear) in body_variations().into_iter().filter(|(_, wear)| wear.unit == 1.0) {
            let (skeleton, anatomy) = worn(wear);
            let source = posture(&skeleton, &anatomy, 0.0);
            let before = ModelPose::from_local_pose(&skeleton, &source);
            for side in BodySide::BOTH_SIDES {
                let arm = anatomy.arm_chain(side).expect("an arm");
                let spin = DQuat::from_scaled_axis(spin);
                let target = WristTarget {
                    position: before.model_joint_position(arm.hand) + by * 0.25,
                    rotation: spin * before.model_joint_rotation(arm.hand),
                };
                let options = ReachOptions {
                    clavicle: help.then_some(0.9),
                    ..ReachOptions::default()
                };
                let mut pose = source.clone();
                let reach = reach_wrist(&anatomy, &skeleton, side, &target, &options, &mut pose)
                    .expect("an arm");
                let after = ModelPose::from_local_pose(&skeleton, &pose);
                let residual = after.model_joint_position(arm.hand).distance(target.position);
                prop_assert!((residual - reach.residual_m).abs() < 1e-12);
                prop_assert!(reach.clamped || residual < 1e-3, "{name} {reach:?}");
                prop_assert!(reach.clamped || reach.soft || residual < 1e-8, "{name} {reach:?}");
                prop_assert!(after.model_joint_rotation(arm.hand).angle_between(target.rotation) < 1e-7);
                let moved = [Some(arm.upper), Some(arm.forearm), Some(arm.hand), arm.clavicle.filter(|_| help)];
                for joint in 0..skeleton.len() {
                    let same = pose.rotations[joint] == source.rotations[joint];
                    prop_assert!(same || moved.contains(&Some(joint)), "{}", skeleton.joint_at(joint).name);
                }
                prop_assert_eq!(&pose.translations, &source.translations);
                for (a, b) in [(arm.upper, arm.forearm), (arm.forearm, arm.hand)] {
                    let length = |model: &ModelPose| model.model_joint_position(a).distance(model.model_joint_position(b));
                    prop_assert!((length(&before) - length(&after)).abs() < 1e-9);
                }
            }
        }
    }

    #[test]
    fn moving_a_wrist_there_and_back_restores_the_arm(by in vector()) {
        let (skeleton, anatomy) = worn(BodyVariation { frames: any_turn, ..PLAIN_BODY_VARIATION });
        let source = posture(&skeleton, &anatomy, 0.0);
        let hand = anatomy.part_joint(BodyPart::Hand(BodySide::Left)).expect("a hand");
        let at = |pose: &LocalPose| {
            let model = ModelPose::from_local_pose(&skeleton, pose);
            WristTarget { position: model.model_joint_position(hand), rotation: model.model_joint_rotation(hand) }
        };
        let mut pose = source.clone();
        let mut away = at(&source);
        away.position += by * 0.12;
        let mut farthest = 0.0f64;
        for target in [away, at(&source)] {
            let options = ReachOptions::default();
            let reach = reach_wrist(&anatomy, &skeleton, BodySide::Left, &target, &options, &mut pose);
            let reach = reach.expect("an arm");
            prop_assume!(!reach.soft && !reach.clamped);
            prop_assert!(reach.residual_m < 1e-6);
            farthest = farthest.max(reach.extension);
        }
        let (before, after) = (ModelPose::from_local_pose(&skeleton, &source), ModelPose::from_local_pose(&skeleton, &pose));
        let fingers = anatomy.finger_joints(BodySide::Left);
        for joint in 0..skeleton.len() {
            if farthest > 0.99 && !fingers.contains(&joint) {
                continue;
            }
            prop_assert!(before.model_joint_position(joint).abs_diff_eq(after.model_joint_position(joint), 1e-6));
            prop_assert!(before.model_joint_rotation(joint).angle_between(after.model_joint_rotation(joint)) < 1e-5);
        }
    }
}

#[test]
fn a_displaced_moving_arm_stays_as_smooth_as_before() {
    let (skeleton, anatomy) = worn(BodyVariation {
        frames: any_turn,
        ..PLAIN_BODY_VARIATION
    });
    for solver in [ElbowSolver::Analytic, ElbowSolver::Fabrik] {
        for by in [
            DVec3::ZERO,
            DVec3::new(0.1, 0.2, 0.05),
            DVec3::new(-0.2, -0.1, 0.1),
            DVec3::Z * 0.3,
        ] {
            let options = ReachOptions {
                solver,
                clavicle: Some(0.9),
                ..ReachOptions::default()
            };
            let arm = anatomy.arm_chain(BodySide::Right).expect("an arm");
            let mut before: Option<(ModelPose, ModelPose)> = None;
            for frame in 0..120 {
                let source = posture(&skeleton, &anatomy, (f64::from(frame) / 20.0).sin());
                let was = ModelPose::from_local_pose(&skeleton, &source);
                let target = WristTarget {
                    position: was.model_joint_position(arm.hand) + by,
                    rotation: was.model_joint_rotation(arm.hand),
                };
                let mut pose = source.clone();
                reach_wrist(&anatomy, &skeleton, BodySide::Right, &target, &options, &mut pose).expect("an arm");
                let now = ModelPose::from_local_pose(&skeleton, &pose);
                if let Some((old_was, old_now)) = before {
                    for joint in [arm.upper, arm.forearm] {
                        let had = old_was
                            .model_joint_rotation(joint)
                            .angle_between(was.model_joint_rotation(joint));
                        let has = old_now
                            .model_joint_rotation(joint)
                            .angle_between(now.model_joint_rotation(joint));
                        assert!(has < had + 5.0f64.to_radians(), "{solver:?} {by} {frame}: {has}");
                    }
                }
                before = Some((was, now));
            }
        }
    }
}

#[test]
fn the_collar_bone_helps_past_the_stated_reach_and_no_further_than_it_may() {
    let (skeleton, anatomy) = worn(PLAIN_BODY_VARIATION);
    let side = BodySide::Left;
    let source = posture(&skeleton, &anatomy, 0.0);
    let model = ModelPose::from_local_pose(&skeleton, &source);
    let arm = anatomy.arm_chain(side).expect("an arm");
    let mut last = 0.0;
    for n in 0..100 {
        let target = WristTarget {
            position: model.model_joint_position(arm.upper)
                + DVec3::new(0.1, 0.2, 1.0).normalize() * (0.3 + 0.004 * f64::from(n)),
            rotation: model.model_joint_rotation(arm.hand),
        };
        let reach = |clavicle| {
            let options = ReachOptions {
                clavicle,
                ..ReachOptions::default()
            };
            let mut pose = source.clone();
            reach_wrist(&anatomy, &skeleton, side, &target, &options, &mut pose).expect("an arm")
        };
        let (alone, helped) = (reach(None), reach(Some(0.9)));
        assert!(helped.clavicle_turn >= last && helped.clavicle_turn < 0.5);
        assert!(helped.residual_m <= alone.residual_m + 1e-12);
        if alone.extension < 0.9 {
            assert_eq!(helped, alone);
        }
        last = helped.clavicle_turn;
    }
    assert!(last > 0.2);
}

#[test]
fn a_skeleton_without_the_arm_and_an_invalid_target_are_refused() {
    let (skeleton, anatomy) = worn(PLAIN_BODY_VARIATION);
    let mut pose = skeleton.rest_pose();
    let before = pose.clone();
    let options = ReachOptions::default();
    let nan = WristTarget {
        position: DVec3::NAN,
        rotation: DQuat::IDENTITY,
    };
    let error = reach_wrist(&anatomy, &skeleton, BodySide::Left, &nan, &options, &mut pose);
    assert_eq!(error, Err(IkError::NotFinite("target")));
    let turned = WristTarget {
        position: DVec3::ONE,
        rotation: DQuat::from_xyzw(0.0, 0.0, 0.0, 3.0),
    };
    let error = reach_wrist(&anatomy, &skeleton, BodySide::Left, &turned, &options, &mut pose);
    assert_eq!(error, Err(IkError::NotFinite("target's rotation")));
    assert_eq!(pose, before);
    let roles = "left hand =".parse().expect("roles");
    let bare = BodyAnatomy::with_roles(&skeleton, &roles).expect("roles");
    let bare_again = bare.arm_chain(BodySide::Left);
    assert!(bare_again.is_none(), "the user's word holds");
    let error = reach_wrist(&bare, &skeleton, BodySide::Left, &nan, &options, &mut pose);
    assert_eq!(error, Err(IkError::NoArm(BodySide::Left)));
}

/// Moves every captured arm aside: the wrist reaches its target if possible, the hand keeps its rotation, and if the
/// source moves calmly, no joint of a signer's arm jumps by five degrees more than in the source at 120 Hz. Blows, and
/// arms that pass through full extension, jump more.
#[test]
fn captured_arms_displaced_aside_stay_smooth() {
    for path in shared_bvh_files("motion/bvh") {
        let shown = path.display();
        let (skeleton, poses, frame_time) = read_bvh(&path, 400).unwrap_or_else(|| panic!("{shown}"));
        let Some(first) = poses.first() else { continue };
        let first = ModelPose::from_local_pose(&skeleton, first);
        let anatomy = BodyAnatomy::detect_anatomy(&skeleton).with_reference(&skeleton, &first);
        let Some(length) = anatomy.anatomy_measures().map(|m| m.arm) else {
            continue;
        };
        for (side, direction) in [
            (BodySide::Right, DVec3::new(0.3, 0.2, 0.2)),
            (BodySide::Left, DVec3::new(0.1, -0.2, 0.3)),
        ] {
            let Some(arm) = anatomy.arm_chain(side) else {
                continue;
            };
            let mut before: Option<(ModelPose, ModelPose)> = None;
            let (mut jump, mut reached, mut worst) = (0.0f64, 0, 0.0f64);
            for source in &poses {
                let was = ModelPose::from_local_pose(&skeleton, source);
                let Some(body) = anatomy.body_frame(&was) else {
                    continue;
                };
                let target = WristTarget {
                    position: was.model_joint_position(arm.hand) + body.direction_to_model(direction * length),
                    rotation: was.model_joint_rotation(arm.hand),
                };
                let mut pose = source.clone();
                let options = ReachOptions::default();
                let reach = reach_wrist(&anatomy, &skeleton, side, &target, &options, &mut pose).expect("an arm");
                let now = ModelPose::from_local_pose(&skeleton, &pose);
                assert!(
                    now.model_joint_rotation(arm.hand).angle_between(target.rotation) < 1e-6,
                    "{shown}"
                );
                if !reach.clamped {
                    reached += 1;
                    worst = worst.max(reach.residual_m / length);
                }
                if let Some((old_was, old_now)) = before {
                    for joint in [arm.upper, arm.forearm] {
                        let had = old_was
                            .model_joint_rotation(joint)
                            .angle_between(was.model_joint_rotation(joint));
                        let has = old_now
                            .model_joint_rotation(joint)
                            .angle_between(now.model_joint_rotation(joint));
                        if had.to_degrees() < 5.0 {
                            let frames = (120.0 * frame_time).max(1.0);
                            jump = jump.max((has - had).to_degrees() / frames);
                        }
                    }
                }
                before = Some((was, now));
            }
            eprintln!(
                "{shown} {side:?}: {reached} of {} reached, worst {worst:.5} of the arm, jump {jump:.1}",
                poses.len()
            );
            assert!(worst < 0.0016, "{shown}");
            let signing = shown.to_string().ends_with("NGT Thanks.bvh");
            assert!(jump < if signing { 5.0 } else { 12.0 }, "{shown} {jump}");
        }
    }
}
