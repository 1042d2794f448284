//! Golden tables of inverse kinematics.

use glam::{DQuat, DVec3};

use super::{dressed, milli, signing, turned};
use crate::anatomy::tests::fixtures::{BodyVariation, PLAIN_BODY_VARIATION, any_turn};
use crate::golden::{LITTLE, compare, compare_to, put};
use crate::ik::{
    ElbowSolver, FabrikOptions, ReachOptions, TwoBoneOptions, WristTarget, reach_wrist, solve_fabrik, two_bone,
};
use crate::{BodyPart, BodySide, ModelPose};

/// Targets at many distances from the origin, in metres: near, usual, at the reach of half a metre, and beyond.
fn targets() -> Vec<DVec3> {
    let directions = [
        DVec3::new(0.3, 0.5, 0.8),
        DVec3::new(-0.7, 0.1, 0.2),
        DVec3::new(0.1, -0.9, -0.1),
    ];
    let far = [0.01, 0.2, 0.4, 0.495, 0.499, 0.51, 0.8];
    let all = directions
        .into_iter()
        .flat_map(|direction| far.map(|far| direction.normalize() * far));
    all.collect()
}

#[test]
fn golden_reach_of_chains() {
    let mut out = String::new();
    let sources = [
        (
            "bent",
            [DVec3::ZERO, DVec3::new(0.0, -0.28, 0.05), DVec3::new(0.1, -0.2, 0.25)],
        ),
        (
            "straight",
            [DVec3::ZERO, DVec3::new(0.28, 0.0, 0.0), DVec3::new(0.5, 0.0, 0.0)],
        ),
        (
            "nearly straight",
            [DVec3::ZERO, DVec3::new(0.28, 0.005, 0.0), DVec3::new(0.5, 0.0, 0.0)],
        ),
        (
            "folded",
            [DVec3::ZERO, DVec3::new(0.0, 0.0, 0.25), DVec3::new(0.0, 0.001, 0.01)],
        ),
    ];
    for (name, source) in sources {
        for (soft, pole) in [
            (0.004, None),
            (0.0, Some(DVec3::new(0.0, -1.0, -1.0))),
            (0.05, Some(DVec3::new(0.3, 0.2, -0.4))),
        ] {
            put(&mut out, format!("## {name}, soft {soft}, pole {:?}", pole.map(milli)));
            for target in targets() {
                let found = two_bone(source, target, &TwoBoneOptions { soft, pole });
                let found = found.expect("a reach");
                put(
                    &mut out,
                    format!(
                        "{}: {} | {} extension {:?} soft {} clamped {}",
                        milli(target),
                        milli(found.middle),
                        milli(found.end),
                        found.extension,
                        found.soft,
                        found.clamped
                    ),
                );
            }
        }
    }
    put(&mut out, "## refused");
    let [_, (_, straight), ..] = sources;
    let usual = TwoBoneOptions::default();
    let odd = [
        two_bone([DVec3::NAN; 3], DVec3::X, &usual),
        two_bone(straight, DVec3::INFINITY, &usual),
        two_bone([DVec3::ZERO, DVec3::ZERO, DVec3::X], DVec3::X, &usual),
        two_bone([DVec3::ZERO, DVec3::X, DVec3::X], DVec3::X, &usual),
        two_bone(
            straight,
            DVec3::X,
            &TwoBoneOptions {
                soft: f64::NAN,
                ..usual
            },
        ),
        two_bone(
            straight,
            DVec3::X,
            &TwoBoneOptions {
                pole: Some(DVec3::NAN),
                ..usual
            },
        ),
    ];
    for odd in odd {
        put(&mut out, odd.expect_err("no reach").to_string());
    }
    compare("two_bones", &out);
}

#[test]
fn golden_chains_that_reach_step_by_step() {
    let mut out = String::new();
    let chains: [(&str, Vec<DVec3>); 3] = [
        (
            "arm",
            vec![DVec3::ZERO, DVec3::new(0.0, -0.28, 0.05), DVec3::new(0.1, -0.2, 0.25)],
        ),
        (
            "five bones",
            (0..6)
                .map(|n| DVec3::new(0.1 * f64::from(n), 0.02 * f64::from(n % 2), 0.0))
                .collect(),
        ),
        ("line", (0..4).map(|n| DVec3::X * 0.15 * f64::from(n)).collect()),
    ];
    for (name, chain) in &chains {
        for (passes, tolerance, pole) in [
            (200, 1e-6, None),
            (3, 1e-6, Some(DVec3::new(0.0, 0.0, 1.0))),
            (200, 0.01, Some(DVec3::new(1.0, 1.0, 0.2))),
        ] {
            put(&mut out, format!("## {name}, {passes} passes, near {tolerance}"));
            let options = FabrikOptions {
                tolerance,
                passes,
                pole,
            };
            for target in targets().into_iter().chain([DVec3::X * 0.3]) {
                let found = solve_fabrik(chain, target, &options).expect("a chain");
                let points: Vec<String> = found.points.iter().copied().map(milli).collect();
                put(
                    &mut out,
                    format!("{}: {} off {:?}", milli(target), points.join(" | "), found.residual),
                );
                // Slow convergence may take another pass on another machine.
                if found.passes < 20 {
                    put(&mut out, format!("  passes {}", found.passes));
                }
            }
        }
    }
    put(&mut out, "## refused");
    let usual = FabrikOptions::default();
    let bad = FabrikOptions {
        tolerance: f64::NAN,
        ..usual
    };
    let [(_, arm), ..] = &chains;
    for odd in [
        solve_fabrik(&[DVec3::ZERO], DVec3::X, &usual),
        solve_fabrik(&[DVec3::ZERO, DVec3::ZERO], DVec3::X, &usual),
        solve_fabrik(&[DVec3::NAN, DVec3::ZERO], DVec3::X, &usual),
        solve_fabrik(arm, DVec3::NAN, &usual),
        solve_fabrik(arm, DVec3::X, &bad),
    ] {
        put(&mut out, odd.expect_err("no chain").to_string());
    }
    compare_to("chains", &out, LITTLE);
}

#[test]
fn golden_wrists_that_reach() {
    let mut out = String::new();
    let bodies = [
        ("plain", PLAIN_BODY_VARIATION),
        (
            "odd frames",
            BodyVariation {
                frames: any_turn,
                lowered: 0.6,
                ..PLAIN_BODY_VARIATION
            },
        ),
    ];
    let usual = ReachOptions::default();
    let options = [
        ("usual", usual),
        (
            "fabrik",
            ReachOptions {
                solver: ElbowSolver::Fabrik,
                ..usual
            },
        ),
        (
            "collar",
            ReachOptions {
                clavicle: Some(0.9),
                ..usual
            },
        ),
        (
            "little collar, soft",
            ReachOptions {
                clavicle: Some(0.7),
                clavicle_limit: 0.1,
                soft: 0.05,
                ..usual
            },
        ),
        (
            "stiff collar",
            ReachOptions {
                clavicle: Some(0.7),
                clavicle_limit: 0.0,
                ..usual
            },
        ),
    ];
    for (body, wear) in bodies {
        let (skeleton, anatomy) = dressed(wear);
        for (name, options) in options {
            put(&mut out, format!("## {body}, {name}"));
            for (n, side) in [BodySide::Right, BodySide::Left]
                .into_iter()
                .cycle()
                .take(8)
                .enumerate()
            {
                let at = n as f64;
                let mut pose = signing(&skeleton, &anatomy, 0.5 * at);
                let shoulder = DVec3::new(side.side_sign() * 0.18, 1.43, 0.0);
                let direction = DVec3::new(-side.side_sign() * (0.4 - 0.2 * at), 0.6 - 0.15 * at, 0.7);
                let target = WristTarget {
                    position: shoulder + direction.normalize() * (0.2 + 0.06 * at),
                    rotation: DQuat::from_rotation_y(0.3 * at) * DQuat::from_rotation_x(0.7),
                };
                let reach = reach_wrist(&anatomy, &skeleton, side, &target, &options, &mut pose).expect("a reach");
                let model = ModelPose::from_local_pose(&skeleton, &pose);
                put(
                    &mut out,
                    format!(
                        "{} {}: off {:?} extension {:?} soft {} clamped {} collar {:?}",
                        side.body_side_name(),
                        milli(target.position),
                        reach.residual_m,
                        reach.extension,
                        reach.soft,
                        reach.clamped,
                        reach.clavicle_turn
                    ),
                );
                let parts = [
                    BodyPart::Clavicle(side),
                    BodyPart::UpperArm(side),
                    BodyPart::Forearm(side),
                    BodyPart::Hand(side),
                ];
                for part in parts {
                    let joint = anatomy.part_joint(part).expect("a joint");
                    put(
                        &mut out,
                        format!(
                            "  {part} at {} turned {}",
                            milli(model.model_joint_position(joint)),
                            turned(model.model_joint_rotation(joint))
                        ),
                    );
                }
            }
        }
    }
    compare_to("wrists", &out, LITTLE);
}
