//! Laws of `travel`: the whole path is travelled in a human time, or the recipe is refused.

use super::*;

/// Paths, their lengths and ends in metres (left, up, forward), and the least time of the movement in seconds.
const PATHS: [(&str, f64, [f64; 3], f64); 9] = [
    ("down 12cm then up 12cm in 0.8s", 0.24, [0.0, 0.0, 0.0], 0.9),
    ("down 12cm then up 12cm in 0.4s", 0.24, [0.0, 0.0, 0.0], 0.5),
    ("down 12cm in 0.2s then up 6cm in 0.3s", 0.18, [0.0, -0.06, 0.0], 0.5),
    (
        "down 8cm then left 8cm then up 8cm then right 8cm",
        0.32,
        [0.0; 3],
        0.26,
    ),
    ("up 10cm in 2s then down 10cm in 1.5s", 0.2, [0.0; 3], 3.5),
    ("down 10cm", 0.1, [0.0, -0.1, 0.0], 0.08),
    (
        "through 0cm,-6cm,0cm then 0cm,-12cm,0cm in 1s",
        0.12,
        [0.0, -0.12, 0.0],
        1.0,
    ),
    ("through 0cm,-6cm,0cm then 0cm,-12cm,0cm", 0.12, [0.0, -0.12, 0.0], 0.1),
    (
        "through 6cm,0cm,0cm then 6cm,-6cm,0cm in 0.3s",
        0.0,
        [0.06, -0.06, 0.0],
        0.3,
    ),
];

/// Returns the displacement of the right wrist by a path, compared with the same movement in the same time.
fn gone(of: &str, path: &str) -> (GeneratedMovement, Vec<DVec3>) {
    let carried = made(&format!("{of} | travel right {path}"));
    let seconds = carried.clip.clip_span().span_seconds();
    let plain = made(&format!("{of} | retime to {seconds}s"));
    assert_eq!(
        plain.clip.clip_frame_count(),
        carried.clip.clip_frame_count(),
        "{of} {path}"
    );
    let [a, b] = [&carried, &plain].map(|it| wrist(it, BodySide::Right));
    let gone = a.iter().zip(&b).map(|(a, b)| *a - *b).collect();
    (carried, gone)
}

#[test]
fn a_path_is_travelled_as_a_whole_however_short_the_sign_is() {
    for part in ["", " | span 0.2s..0.667s", " | span 0.2s..0.3s", " | span 0.2s..0.205s"] {
        let of = format!("(ESCARGOT{part})");
        let before = made(&of).clip.clip_frame_count();
        for (path, length, end, least) in PATHS {
            let (carried, gone) = gone(&of, path);
            let step = &carried.report.steps[carried.report.steps.len() - 1];
            assert!(step.residual < Some(1e-3), "{of} {path}: out of reach");
            let steps = gone.windows(2).map(|it| it[0].distance(it[1]));
            let went: f64 = steps.clone().sum();
            let known = length > 0.0;
            assert!(!known || (went / length - 1.0).abs() < 0.01, "{of} {path}: {went}");
            let last = gone[gone.len() - 1];
            let wanted = DVec3::from_array(end);
            let far = (last.length() - wanted.length()).abs();
            // The signer does not face exactly forward.
            assert!(
                far < 2e-3 && last.distance(wanted) < 0.1 * wanted.length() + 2e-3,
                "{of} {path}: {last}"
            );
            assert!(gone[0].length() < 1e-3, "{of} {path}: {}", gone[0]);
            let rate = carried.clip.clip_frame_rate().per_second();
            let fastest = steps.fold(0.0, f64::max) * rate;
            assert!(fastest < 3.0, "{of} {path}: {fastest} m/s");
            let seconds = carried.clip.clip_span().span_seconds();
            assert!(seconds >= least, "{of} {path}: {seconds} s");
            let longer = step.did.iter().any(|did| did.contains("so that the path has its time"));
            assert_eq!(
                longer,
                carried.clip.clip_frame_count() != before,
                "{of} {path}: {:?}",
                step.did
            );
        }
    }
}

#[test]
fn a_sign_with_time_enough_keeps_its_own() {
    for path in [
        "left 10cm in 0.3s",
        "down 12cm then up 15cm",
        "down 12cm then up 12cm in 0.4s",
    ] {
        let made = made(&format!("ESCARGOT | travel right {path}"));
        assert_eq!(made.clip.clip_frame_count(), 120, "{path}");
    }
}

#[test]
fn contacts_are_kept_where_the_sign_became_longer() {
    let made = made("BOL | place right at chin | travel left up 4cm in 2s");
    assert!(made.clip.clip_span().span_seconds() > 2.0);
    assert!(made.report.contacts.is_empty(), "{:?}", made.report.contacts);
}

#[test]
fn a_time_that_no_arm_can_keep_is_refused_and_a_hasty_one_is_reported() {
    for path in ["up 50cm in 0.02s", "up 10cm in 0s", "through 0cm,30cm,0cm in 0.01s"] {
        let error = make(&format!("ESCARGOT | travel right {path}")).expect_err(path);
        assert!(matches!(error.cause, StepError::TooFast { .. }), "{error}");
        assert!(error.to_string().contains("or more"), "{error}");
    }
    let hasty = made("ESCARGOT | travel right down 12cm in 0.05s");
    assert!(
        hasty
            .report
            .warnings
            .iter()
            .any(|it| it.contains("faster than people sign")),
        "{:?}",
        hasty.report.warnings
    );
}
