//! The invariants of operators, and their inverses.

use super::*;

#[test]
fn a_recipe_of_one_sign_returns_it_unchanged() {
    for gloss in ["ESCARGOT", "LIMACE"] {
        assert_eq!(made(gloss).clip, source(gloss));
    }
}

#[test]
fn involutions_applied_twice_change_nothing() {
    for gloss in ["ESCARGOT", "LIMACE"] {
        for twice in ["reverse | reverse", "swap | swap", "reverse | swap | reverse | swap"] {
            let back = made(&format!("{gloss} | {twice}")).clip;
            let far = farthest(&back, &source(gloss));
            assert!(far < 1e-5, "{gloss} | {twice}: {far}");
        }
        let reversed = made(&format!("{gloss} | reverse | reverse"));
        assert_eq!(reversed.clip, source(gloss));
        let one = made(&format!("{gloss} | mirror right"));
        for again in [
            "mirror right | mirror right",
            "mirror right | mirror left",
            "mirror right | swap",
        ] {
            let far = farthest(&made(&format!("{gloss} | {again}")).clip, &one.clip);
            assert!(far < 1e-5, "{gloss} | {again}: {far}");
        }
        bones_keep_their_lengths(&one.clip);
    }
}

#[test]
fn inverse_operators_restore_each_movement() {
    use crate::ops::{mirror, place_operator, reverse};
    use crate::recipe::ArmSolverMethod;
    use crate::work::WorkingClip;
    for gloss in ["ESCARGOT", "LIMACE"] {
        let material = &Shelf::new().materials[gloss];
        let by = DVec3::new(0.06, 0.05, -0.04);
        let solver = ArmSolverMethod::Analytic;
        type Once = fn(&mut WorkingClip, f64, DVec3, ArmSolverMethod);
        let operators: [(&str, Once); 3] = [
            ("reverse", |work, _, _, _| drop(reverse::reverse_movement(work))),
            ("swap", |work, _, _, _| {
                drop(mirror::swap_arm_movements(work).expect("two arms"))
            }),
            ("place", |work, sign, by, solver| {
                let stroke = crate::stroke::SignStroke::of_work(work).expect("a clip");
                let by = by * sign;
                let moved =
                    place_operator::move_wrists_to(work, &BodySide::BOTH_SIDES, solver, &stroke, |_, _, at| at + by);
                let reach = moved.expect("two arms");
                assert!(reach.residual < 1e-9 && reach.helped == 0);
            }),
        ];
        for (name, operator) in operators {
            let mut work = WorkingClip::working_clip_from(material);
            operator(&mut work, 1.0, by, solver);
            operator(&mut work, -1.0, by, solver);
            let far = farthest(&work.into_clip().expect("a clip"), &material.clip);
            assert!(far < 1e-5, "{gloss} {name}: {far}");
        }
    }
}

#[test]
fn a_swap_shows_the_mirror_image_whatever_the_axes() {
    for gloss in ["ESCARGOT", "LIMACE"] {
        let (before, swapped) = (source(gloss), made(&format!("{gloss} | swap")));
        let anatomy = &swapped.anatomy;
        let joint = |part| anatomy.part_joint(part).expect("a full body");
        for frame in [0, 37, 119] {
            let (a, b) = (model(&before, frame), model(&swapped.clip, frame));
            let chest = joint(BodyPart::Chest);
            // In the chest's own posture at rest the plane is x = 0.
            let rest = before.clip_skeleton().rest_model_pose();
            let home = |m: &chereme_motion::ModelPose, at: DVec3| {
                let carried = m.model_joint_rotation(chest) * rest.model_joint_rotation(chest).inverse();
                carried.inverse() * (at - m.model_joint_position(chest))
            };
            for part in [
                BodyPart::Hand(BodySide::Right),
                BodyPart::Forearm(BodySide::Left),
                BodyPart::Finger(BodySide::Right, chereme_motion::HandFinger::Little, 3),
            ] {
                let was = home(&a, a.model_joint_position(joint(part)));
                let is = home(&b, b.model_joint_position(joint(part.mirrored_part())));
                assert!(
                    is.abs_diff_eq(DVec3::new(-was.x, was.y, was.z), 1e-9),
                    "{gloss} {part} {was} {is}"
                );
            }
        }
    }
}

#[test]
fn each_operator_moves_the_joints_it_must_and_no_others() {
    use BodySide::{Left, Right};
    use JointGroup::{Arm, Fingers};
    for (step, want) in [
        ("configure right U", vec![Fingers(Right)]),
        ("configure both S", vec![Fingers(Right), Fingers(Left)]),
        ("configure right from BOL", vec![Fingers(Right)]),
        ("place right by up 5cm", vec![Arm(Right)]),
        ("place both by left 5cm", vec![Arm(Right), Arm(Left)]),
        ("place right at chin", vec![Arm(Right)]),
        ("place left near LIMACE by up 2cm", vec![Arm(Left)]),
        ("place both by left 0cm", vec![]),
        ("repeat 1", vec![]),
        ("mirror left", vec![Fingers(Right), Arm(Right)]),
        ("swap", vec![Fingers(Right), Fingers(Left), Arm(Right), Arm(Left)]),
    ] {
        let made = match step {
            "configure right from BOL" => make("ESCARGOT | configure right from BOL"),
            _ => make(&format!("ESCARGOT | {step}")),
        };
        match made {
            Ok(made) => {
                let found = differing(&made, &source("ESCARGOT"));
                let mut want = want;
                want.sort_unstable();
                assert_eq!(found, want, "{step}");
                let reported: Vec<String> = made
                    .report
                    .channels
                    .iter()
                    .filter(|c| c.from.len() > 1)
                    .map(|c| c.channel.clone())
                    .collect();
                let said: Vec<String> = JointGroup::ALL_JOINT_GROUPS
                    .into_iter()
                    .filter(|g| want.contains(g))
                    .map(JointGroup::joint_group_name)
                    .collect();
                assert_eq!(reported, said, "{step}");
            }
            Err(error) => panic!("{step}: {error}"),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn placing_there_and_back_changes_nothing(
        left in -8i32..8, up in -8i32..8, forward in -8i32..4, odd in any::<bool>()
    ) {
        let gloss = if odd { "LIMACE" } else { "ESCARGOT" };
        let by = |sign: i32| format!("place both by left {}cm up {}cm forward {}cm", left * sign, up * sign, forward * sign);
        let there = made(&format!("{gloss} | {}", by(1)));
        let before = source(gloss);
        let reached = there.report.steps.iter().all(|s| s.residual.unwrap_or(0.0) < 1e-3);
        for side in BodySide::BOTH_SIDES {
            let hand = there.anatomy.part_joint(BodyPart::Hand(side)).expect("a hand");
            for frame in 0..before.clip_frame_count() {
                let (a, b) = (model(&before, frame), model(&there.clip, frame));
                prop_assert!(a.model_joint_rotation(hand).angle_between(b.model_joint_rotation(hand)) < 0.1f64.to_radians());
                if reached {
                    let displacement = b.model_joint_position(hand) - a.model_joint_position(hand);
                    let length = DVec3::new(f64::from(left), f64::from(up), f64::from(forward)).length() / 100.0;
                    prop_assert!((displacement.length() - length).abs() < 1e-3);
                }
            }
        }
        bones_keep_their_lengths(&there.clip);
        let helped = there.report.steps.iter().any(|s| s.did.iter().any(|d| d.contains("collar bone")));
        prop_assume!(reached && !helped);
        let back = made(&format!("{gloss} | {} | {}", by(1), by(-1)));
        let far = farthest(&back.clip, &before);
        prop_assert!(far < 1e-5, "{far}");
    }
}
