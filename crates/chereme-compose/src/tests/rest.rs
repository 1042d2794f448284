//! Signs that come from rest and go back to it: they are joined, repeated and trimmed between their phases.

use super::*;

/// Notated signs: with one hand, with two, and a second one with one hand.
const ONE: &str = "hamnosys \"hamflathand hamextfingeru hampalml hamchin hammoveo\" with quiet";
const TWO: &str = "hamnosys \"hamsymmlr hamflathand hamextfingero hampalmd hamchest hammoved\" with quiet";
const OTHER: &str = "hamnosys \"hamfist hamextfingerui hampalmd hamneutralspace hammoved\" with quiet";

/// Returns the start of the first phase and the end of the last one, in seconds.
fn phases(made: &GeneratedMovement) -> (f64, f64) {
    let about = NoteSubject::Component(SignComponent::Movement, Some("phase".into()));
    let spans = made.notes.iter().filter(|it| it.about == about);
    let ends = spans.map(|it| {
        (
            it.span.span_start_instant().instant_seconds(),
            it.span.span_end_instant().instant_seconds(),
        )
    });
    ends.fold((f64::INFINITY, 0.0), |(from, to), (a, b)| (from.min(a), to.max(b)))
}

/// Returns the longest time between two phases of an utterance, in seconds.
fn pause(made: &GeneratedMovement) -> f64 {
    let about = NoteSubject::Component(SignComponent::Movement, Some("phase".into()));
    let spans = made.notes.iter().filter(|it| it.about == about);
    let mut spans: Vec<(f64, f64)> = spans
        .map(|it| {
            (
                it.span.span_start_instant().instant_seconds(),
                it.span.span_end_instant().instant_seconds(),
            )
        })
        .collect();
    spans.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut end, mut longest) = (spans[0].1, 0.0_f64);
    for (from, to) in spans {
        longest = longest.max(from - end);
        end = end.max(to);
    }
    longest
}

fn apart(a: &chereme_motion::LocalPose, b: &chereme_motion::LocalPose) -> f64 {
    // The second sign turns as a whole to face as the first does.
    let pairs = a.rotations.iter().zip(&b.rotations).skip(1);
    pairs.map(|(a, b)| a.angle_between(*b)).fold(0.0, f64::max)
}

#[test]
fn hands_go_from_the_last_posture_of_a_sign_to_the_first_of_the_next() {
    for (first, second) in [(ONE, OTHER), (TWO, ONE), (ONE, TWO), (TWO, TWO)] {
        let [a, b] = [made(first), made(second)];
        let both = made(&format!("{first} then {second}"));
        let (_, left) = phases(&a);
        let between = pause(&both);
        assert!(between < 1.3, "{first} then {second}: {between} s");
        // The utterance begins and ends as its signs do.
        let last = |it: &GeneratedMovement| it.clip.clip_pose_at(it.clip.clip_frame_count() - 1);
        assert!(
            apart(&both.clip.clip_pose_at(0), &a.clip.clip_pose_at(0)) < 1e-6,
            "{first}"
        );
        assert!(apart(&last(&both), &last(&b)) < 1e-6, "{first} then {second}");
        // No hand that signs falls to its place at rest.
        let from = (left / both.clip.clip_frame_rate().frame_time()) as usize;
        let until = from + (between / both.clip.clip_frame_rate().frame_time()) as usize;
        let path = wrist(&both, BodySide::Right);
        let rest = wrist(&a, BodySide::Right)[0];
        let lowest = path[from..until.min(path.len())]
            .iter()
            .map(|at| at.y)
            .fold(f64::INFINITY, f64::min);
        assert!(lowest > rest.y + 0.1, "{first} then {second}: {lowest} {}", rest.y);
        let report = both.report.to_string();
        for what in ["return to rest is left out", "movement from rest is left out"] {
            assert!(report.contains(what), "{report}");
        }
        let fastest = path.windows(2).map(|it| it[0].distance(it[1])).fold(0.0, f64::max);
        let fastest = fastest * both.clip.clip_frame_rate().per_second();
        assert!(fastest < 3.0, "{first} then {second}: {fastest} m/s");
    }
}

#[test]
fn trimming_cuts_the_movement_from_rest_and_back() {
    for sign in [ONE, TWO, OTHER] {
        let whole = made(sign);
        let (from, to) = phases(&whole);
        let trimmed = made(&format!("{sign} | trim"));
        let step = 2.0 * whole.clip.clip_frame_rate().frame_time();
        let seconds = trimmed.clip.clip_span().span_seconds();
        assert!((seconds - (to - from)).abs() < step, "{sign}: {seconds} {from} {to}");
        let again = made(&format!("{sign} | trim | trim"));
        assert_eq!(again.clip, trimmed.clip, "{sign}");
    }
}

#[test]
fn repetitions_do_not_go_back_to_rest_between() {
    for sign in [ONE, TWO] {
        let (from, to) = phases(&made(sign));
        let twice = made(&format!("{sign} | repeat 3"));
        let whole = made(sign).clip.clip_span().span_seconds();
        let wanted = whole + 2.0 * (to - from + 0.12);
        let seconds = twice.clip.clip_span().span_seconds();
        assert!((seconds - wanted).abs() < 0.1, "{sign}: {seconds} {wanted}");
    }
}

#[test]
fn signs_without_rest_or_phases_are_joined_as_before() {
    for recipe in ["BOL then ESCARGOT", "ESCARGOT | repeat 2", "ESCARGOT | trim"] {
        let report = made(recipe).report.to_string();
        let said = ["left out", "back to rest"];
        assert!(said.iter().all(|it| !report.contains(it)), "{report}");
    }
}
