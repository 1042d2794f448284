//! Golden tables of inverse kinematics.

use glam::DVec3;

use super::milli;
use crate::golden::{LITTLE, compare, compare_to, put};
use crate::ik::{FabrikOptions, TwoBoneOptions, solve_fabrik, two_bone};

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
