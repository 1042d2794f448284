//! Proposals for actions of brows, lids, gaze, mouth and head, derived from curves of a face by simple rules.
//!
//! Each rule is a threshold with hysteresis relative to the recording's own median: an action begins when its curve
//! passes the threshold, lasts while the curve stays above seven tenths of it, and counts if it lasts long enough;
//! pauses of less than a tenth of a second do not end it. A blink is a closing of the lids for less than 0.4 s. A shake
//! or nod is a head that turns back and forth at least twice, by three degrees or more, one to six times per second.
//! The confidence is 0.5 at the threshold and 1 at twice the threshold; for shakes and nods it grows with the number of
//! turns.
//!
//! ```
//! use chereme_analysis::nonmanuals::{ObservedFaceCurves, propose_face_actions};
//!
//! let blink: Vec<f64> = (0..60).map(|n| if (30..36).contains(&n) { 1.0 } else { 0.0 }).collect();
//! let curves = ObservedFaceCurves { rate: 30.0, eye_close: [Some(&blink), Some(&blink)], ..ObservedFaceCurves::default() };
//! let found = propose_face_actions(&curves);
//! assert_eq!((found[0].feature, found[0].value, found[0].frames.clone()), ("lids", "blink", 30..36));
//! ```

use std::ops::Range;

use serde::Serialize;

/// The threshold of raised brows. This one and the next five are shares of the usual range.
const RAISED_BROWS_THRESHOLD: f64 = 0.3;
/// The threshold of one raised brow: its height above the other.
const BROW_SIDE_THRESHOLD: f64 = 0.4;
/// The threshold of brows drawn together.
const SQUEEZED_BROWS_THRESHOLD: f64 = 0.35;
/// The threshold of closed eyes.
const CLOSED_EYES_THRESHOLD: f64 = 0.6;
/// The threshold of a gaze to a side, up or down.
const GAZE_THRESHOLD: f64 = 0.35;
/// The threshold of an open mouth.
const OPEN_MOUTH_THRESHOLD: f64 = 0.3;
/// Eyes that are closed for less than this, in seconds, blink.
const MAX_BLINK_SECONDS: f64 = 0.4;
/// The shortest action of brows, gaze or mouth, in seconds.
const MIN_FACE_ACTION_SECONDS: f64 = 0.15;
/// Pauses shorter than this, in seconds, do not end an action.
const MAX_ACTION_PAUSE_SECONDS: f64 = 0.1;
/// The smallest half swing of a head, from one turning point to the next, in degrees.
const MIN_HEAD_SWING_DEGREES: f64 = 3.0;
/// The shortest and the longest half swing of a head, in seconds.
const HALF_SWING: [f64; 2] = [1.0 / 12.0, 0.5];
/// The fewest half swings of a shake or a nod.
const MIN_HALF_SWINGS: usize = 3;
/// The share of the threshold above which a curve must stay for an action to last.
const STAYING_THRESHOLD_SHARE: f64 = 0.7;

/// Curves of one face, with a number for each frame; `None` if unknown.
#[derive(Debug, Clone, Copy, Default)]
pub struct ObservedFaceCurves<'a> {
    /// Frames per second.
    pub rate: f64,
    /// Brows raised, right and left; below 0 lowered.
    pub brow_raise: [Option<&'a [f64]>; 2],
    /// Brows drawn together.
    pub brow_squeeze: Option<&'a [f64]>,
    /// Eyes closed, right and left.
    pub eye_close: [Option<&'a [f64]>; 2],
    /// Gaze to the signer's left.
    pub gaze_left: Option<&'a [f64]>,
    /// Gaze up.
    pub gaze_up: Option<&'a [f64]>,
    /// Jaw open.
    pub jaw_open: Option<&'a [f64]>,
    /// Lips apart.
    pub lips_part: Option<&'a [f64]>,
    /// Head turned down, in degrees.
    pub head_pitch: Option<&'a [f64]>,
    /// Head turned to the signer's left, in degrees.
    pub head_yaw: Option<&'a [f64]>,
}

/// The parts of face and head whose actions are proposed.
pub const PROPOSED_FACE_FEATURES: [&str; 5] = ["brows", "lids", "gaze", "mouth", "head"];

/// A proposed action of a part of the face.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NonmanualProposal {
    /// The part, one of [`PROPOSED_FACE_FEATURES`].
    pub feature: &'static str,
    /// The value of the part's inventory.
    pub value: &'static str,
    /// The frames.
    pub frames: Range<usize>,
    /// The confidence, from 0.5 to 1.
    pub confidence: f64,
    /// The rule that found it, with its numbers.
    pub why: String,
}

/// Returns proposals, part by part in order of time; those of one part do not overlap.
#[must_use]
pub fn propose_face_actions(curves: &ObservedFaceCurves<'_>) -> Vec<NonmanualProposal> {
    if !(curves.rate.is_finite() && curves.rate > 0.0) {
        return Vec::new();
    }
    let mut all = [
        brows(curves),
        lids(curves),
        propose_gaze(curves),
        propose_mouth(curves),
        propose_head(curves),
    ]
    .concat();
    all.sort_by_key(|proposal| (proposal.feature, proposal.frames.start, proposal.frames.end));
    let mut kept: Vec<NonmanualProposal> = Vec::with_capacity(all.len());
    for it in all {
        match kept.last_mut() {
            Some(last) if last.feature == it.feature && last.frames.end > it.frames.start => {
                if it.confidence > last.confidence {
                    *last = it;
                }
            }
            _ => kept.push(it),
        }
    }
    kept
}

/// Returns a curve relative to its own median; empty if unknown.
fn from_median(curve: Option<&[f64]>) -> Vec<f64> {
    let Some(curve) = curve.filter(|curve| !curve.is_empty()) else {
        return Vec::new();
    };
    let mut sorted: Vec<f64> = curve.iter().copied().filter(|value| value.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    // Actions are rarer than the face at rest, which the median therefore shows.
    let median = sorted.get(sorted.len() / 2).copied().unwrap_or_default();
    curve.iter().map(|value| value - median).collect()
}

fn mean_of(both: [Option<&[f64]>; 2]) -> Vec<f64> {
    match both.map(from_median) {
        [a, b] if a.len() == b.len() => a.iter().zip(&b).map(|(a, b)| (a + b) / 2.0).collect(),
        [a, b] if a.is_empty() => b,
        [a, _] => a,
    }
}

fn brows(curves: &ObservedFaceCurves<'_>) -> Vec<NonmanualProposal> {
    let mean = mean_of(curves.brow_raise);
    let squeeze = from_median(curves.brow_squeeze);
    let mut all = find_threshold_runs(
        &mean,
        curves.rate,
        RAISED_BROWS_THRESHOLD,
        MIN_FACE_ACTION_SECONDS,
        "brows",
        "raised",
    );
    all.extend(find_threshold_runs(
        &squeeze,
        curves.rate,
        SQUEEZED_BROWS_THRESHOLD,
        MIN_FACE_ACTION_SECONDS,
        "brows",
        "furrowed",
    ));
    if let [Some(right), Some(left)] = curves.brow_raise {
        let ahead = |a: &[f64], b: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| a - b).collect() };
        let sides = [
            ("raised-right", ahead(right, left)),
            ("raised-left", ahead(left, right)),
        ];
        for (value, more) in sides {
            all.extend(find_threshold_runs(
                &more,
                curves.rate,
                BROW_SIDE_THRESHOLD,
                MIN_FACE_ACTION_SECONDS,
                "brows",
                value,
            ));
        }
    }
    all
}

fn lids(curves: &ObservedFaceCurves<'_>) -> Vec<NonmanualProposal> {
    let mut all = find_threshold_runs(
        &mean_of(curves.eye_close),
        curves.rate,
        CLOSED_EYES_THRESHOLD,
        0.0,
        "lids",
        "closed",
    );
    for it in &mut all {
        let seconds = it.frames.len() as f64 / curves.rate;
        if seconds < MAX_BLINK_SECONDS {
            it.value = "blink";
            it.why = format!("{}, for less than {MAX_BLINK_SECONDS} s", it.why);
        }
    }
    all
}

fn propose_gaze(curves: &ObservedFaceCurves<'_>) -> Vec<NonmanualProposal> {
    let (left, up) = (from_median(curves.gaze_left), from_median(curves.gaze_up));
    let back = |curve: &[f64]| -> Vec<f64> { curve.iter().map(|value| -value).collect() };
    let directions = [
        ("left", left.clone()),
        ("right", back(&left)),
        ("up", up.clone()),
        ("down", back(&up)),
    ];
    let one = |(value, curve): &(&'static str, Vec<f64>)| {
        find_threshold_runs(
            curve,
            curves.rate,
            GAZE_THRESHOLD,
            MIN_FACE_ACTION_SECONDS,
            "gaze",
            value,
        )
    };
    directions.iter().flat_map(one).collect()
}

fn propose_mouth(curves: &ObservedFaceCurves<'_>) -> Vec<NonmanualProposal> {
    let (jaw, lips) = (from_median(curves.jaw_open), from_median(curves.lips_part));
    let most = match (jaw.is_empty(), lips.is_empty()) {
        (false, false) => jaw.iter().zip(&lips).map(|(a, b)| a.max(*b)).collect(),
        (true, _) => lips,
        (_, true) => jaw,
    };
    find_threshold_runs(
        &most,
        curves.rate,
        OPEN_MOUTH_THRESHOLD,
        MIN_FACE_ACTION_SECONDS,
        "mouth",
        "open",
    )
}

fn propose_head(curves: &ObservedFaceCurves<'_>) -> Vec<NonmanualProposal> {
    let mut all = Vec::new();
    for (value, curve) in [("shaking", curves.head_yaw), ("nodding", curves.head_pitch)] {
        all.extend(swings(&from_median(curve), curves.rate, value));
    }
    all
}

/// Returns the runs in which a curve passes a threshold for at least `least` seconds.
fn find_threshold_runs(
    curve: &[f64],
    rate: f64,
    threshold: f64,
    least: f64,
    feature: &'static str,
    value: &'static str,
) -> Vec<NonmanualProposal> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    let mut open: Option<usize> = None;
    for (frame, number) in curve.iter().enumerate() {
        match open {
            None if *number >= threshold => open = Some(frame),
            Some(start) if *number < threshold * STAYING_THRESHOLD_SHARE || number.is_nan() => {
                runs.push(start..frame);
                open = None;
            }
            _ => {}
        }
    }
    runs.extend(open.map(|start| start..curve.len()));
    let mut joined: Vec<Range<usize>> = Vec::new();
    for run in runs {
        match joined.last_mut() {
            Some(last) if (run.start - last.end) as f64 / rate < MAX_ACTION_PAUSE_SECONDS => last.end = run.end,
            _ => joined.push(run),
        }
    }
    let long = joined.into_iter().filter(|run| run.len() as f64 / rate >= least);
    long.map(|frames| {
        let peak = curve[frames.clone()].iter().copied().fold(f64::NEG_INFINITY, f64::max);
        NonmanualProposal {
            feature,
            value,
            confidence: (0.5 + 0.5 * (peak - threshold) / threshold).clamp(0.5, 1.0),
            why: format!("{peak:.2} above the median; {threshold} is enough"),
            frames,
        }
    })
    .collect()
}

/// Returns the stretches in which a head swings back and forth.
fn swings(curve: &[f64], rate: f64, value: &'static str) -> Vec<NonmanualProposal> {
    let turns = turning_points(curve);
    let is_swing = |pair: &[usize]| {
        let seconds = (pair[1] - pair[0]) as f64 / rate;
        (curve[pair[1]] - curve[pair[0]]).abs() >= MIN_HEAD_SWING_DEGREES
            && (HALF_SWING[0]..=HALF_SWING[1]).contains(&seconds)
    };
    let mut all = Vec::new();
    let mut turn_index = 0;
    while turn_index + 1 < turns.len() {
        let mut end = turn_index;
        while end + 1 < turns.len() && is_swing(&turns[end..end + 2]) {
            end += 1;
        }
        let count = end - turn_index;
        if count >= MIN_HALF_SWINGS {
            let frames = turns[turn_index]..turns[end] + 1;
            let sizes = turns[turn_index..=end]
                .windows(2)
                .map(|pair| (curve[pair[1]] - curve[pair[0]]).abs());
            let mean = sizes.sum::<f64>() / count as f64;
            all.push(NonmanualProposal {
                feature: "head",
                value,
                // Each further half swing halves the doubt.
                confidence: 1.0 - 0.5_f64.powi(count as i32 - MIN_HALF_SWINGS as i32 + 1),
                why: format!(
                    "{count} half swings of {mean:.1} degrees; {MIN_HALF_SWINGS} of {MIN_HEAD_SWING_DEGREES} are enough"
                ),
                frames,
            });
        }
        // The last turning point may begin the next run.
        turn_index = end.max(turn_index + 1);
    }
    all
}

/// Returns the frames of alternating maxima and minima; fluctuations smaller than a third of a swing are ignored.
fn turning_points(curve: &[f64]) -> Vec<usize> {
    let mut points: Vec<usize> = Vec::new();
    let Some(_) = curve.first() else {
        return points;
    };
    let (mut low, mut high, mut rising) = (0, 0, None);
    for frame in 1..curve.len() {
        if curve[frame] > curve[high] {
            high = frame;
        }
        if curve[frame] < curve[low] {
            low = frame;
        }
        let (up, down) = (curve[frame] - curve[low], curve[high] - curve[frame]);
        match rising {
            Some(true) | None if down >= MIN_HEAD_SWING_DEGREES / 3.0 => {
                points.push(high);
                (low, high, rising) = (frame, frame, Some(false));
            }
            Some(false) | None if up >= MIN_HEAD_SWING_DEGREES / 3.0 => {
                points.push(low);
                (low, high, rising) = (frame, frame, Some(true));
            }
            _ => {}
        }
    }
    points.extend(match rising {
        Some(true) => Some(high),
        Some(false) => Some(low),
        None => None,
    });
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    const RATE: f64 = 50.0;

    fn curve(seconds: f64, value: impl Fn(f64) -> f64) -> Vec<f64> {
        (0..(seconds * RATE) as usize).map(|n| value(n as f64 / RATE)).collect()
    }

    fn bump(at: f64, from: f64, to: f64) -> f64 {
        if (from..to).contains(&at) { 1.0 } else { 0.0 }
    }

    fn said(found: &[NonmanualProposal]) -> Vec<(&'static str, f64, f64)> {
        let one = |it: &NonmanualProposal| (it.value, it.frames.start as f64 / RATE, it.frames.end as f64 / RATE);
        found.iter().map(one).collect()
    }

    #[test]
    fn raised_brows_are_found_at_any_resting_height() {
        let raised = curve(4.0, |at| 0.2 + 0.8 * bump(at, 1.0, 2.0));
        let squeeze = curve(4.0, |at| 0.9 * bump(at, 3.0, 3.5));
        let curves = ObservedFaceCurves {
            rate: RATE,
            brow_raise: [Some(&raised), Some(&raised)],
            brow_squeeze: Some(&squeeze),
            ..ObservedFaceCurves::default()
        };
        let found = propose_face_actions(&curves);
        assert_eq!(said(&found), [("raised", 1.0, 2.0), ("furrowed", 3.0, 3.5)]);
        assert!(found.iter().all(|it| it.confidence > 0.9), "{found:?}");
        let still = curve(4.0, |_| 0.2);
        let one = ObservedFaceCurves {
            brow_raise: [Some(&raised), Some(&still)],
            brow_squeeze: None,
            ..curves
        };
        assert_eq!(said(&propose_face_actions(&one)), [("raised-right", 1.0, 2.0)]);
    }

    #[test]
    fn blinks_and_closed_eyes_are_distinguished_and_short_pauses_bridged() {
        let eyes = curve(4.0, |at| {
            bump(at, 0.5, 0.6) + bump(at, 1.0, 2.0) + bump(at, 2.06, 2.5) + 0.2 * bump(at, 3.0, 3.5)
        });
        let curves = ObservedFaceCurves {
            rate: RATE,
            eye_close: [Some(&eyes), Some(&eyes)],
            ..ObservedFaceCurves::default()
        };
        let found = propose_face_actions(&curves);
        assert_eq!(said(&found), [("blink", 0.5, 0.6), ("closed", 1.0, 2.5)]);
    }

    #[test]
    fn repeated_swings_are_shakes_and_nods_and_a_single_turn_is_neither() {
        let swing = |at: f64, from: f64, to: f64, size: f64| {
            bump(at, from, to) * size * ((at - from) * 2.0 * std::f64::consts::TAU).sin()
        };
        let yaw = curve(6.0, |at| swing(at, 1.0, 2.5, 6.0) + 20.0 * bump(at, 4.0, 6.0));
        let pitch = curve(6.0, |at| swing(at, 3.0, 4.0, 5.0));
        let curves = ObservedFaceCurves {
            rate: RATE,
            head_yaw: Some(&yaw),
            head_pitch: Some(&pitch),
            ..ObservedFaceCurves::default()
        };
        let found = propose_face_actions(&curves);
        let values: Vec<&str> = found.iter().map(|it| it.value).collect();
        assert_eq!(values, ["shaking", "nodding"], "{found:?}");
        let shake = &found[0].frames;
        let (start, end) = (shake.start as f64 / RATE, shake.end as f64 / RATE);
        assert!(
            (0.9..1.3).contains(&start) && (2.2..2.6).contains(&end),
            "{start} {end}"
        );
        assert!(found[0].confidence > found[1].confidence, "more swings are surer");
    }

    #[test]
    fn gaze_and_mouth_give_values_and_missing_curves_give_none() {
        let gaze = curve(3.0, |at| 0.6 * bump(at, 0.5, 1.0) - 0.7 * bump(at, 2.0, 2.5));
        let jaw = curve(3.0, |at| 0.5 * bump(at, 1.0, 1.4));
        let curves = ObservedFaceCurves {
            rate: RATE,
            gaze_left: Some(&gaze),
            jaw_open: Some(&jaw),
            ..ObservedFaceCurves::default()
        };
        assert_eq!(
            said(&propose_face_actions(&curves)),
            [("left", 0.5, 1.0), ("right", 2.0, 2.5), ("open", 1.0, 1.4)]
        );
        assert_eq!(
            propose_face_actions(&ObservedFaceCurves {
                rate: RATE,
                ..ObservedFaceCurves::default()
            }),
            []
        );
        assert_eq!(
            propose_face_actions(&ObservedFaceCurves {
                rate: f64::NAN,
                ..curves
            }),
            []
        );
        let gaps = vec![f64::NAN; 50];
        assert_eq!(
            propose_face_actions(&ObservedFaceCurves {
                rate: RATE,
                jaw_open: Some(&gaps),
                ..ObservedFaceCurves::default()
            }),
            []
        );
    }
}
