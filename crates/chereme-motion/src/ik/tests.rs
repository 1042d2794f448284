//! Tests of the limits of reaching and of the joints that it keeps.

use glam::{DQuat, DVec3};
use proptest::prelude::*;

use super::*;

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
