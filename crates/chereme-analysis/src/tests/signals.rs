//! Golden tables of alignments, shifts, maps, curves of faces, phases, and of what is measured in movement.

use std::ops::Range;

use chereme_motion::{BodyAnatomy, BodySide, Clip};

use crate::align::{TimedSignal, find_signal_shift};
use crate::dtw::{self, AlignmentWindow, ChannelSeries, DtwPathPolicy, LocalDistance, StepPattern};
use crate::golden::{compare, put};
use crate::kinematics::find_speed_minima;
use crate::map::{WeightedFeatures, find_feature_neighbours, lay_out_map};
use crate::measure::MeasuredKind;
use crate::nonmanuals::{ObservedFaceCurves, propose_face_actions};
use crate::phases::{self, PhasedPerformance};
use crate::strokes::{MovingPart, find_transition_strokes};
use crate::transcribe::tests::movements::{Case, one_hand, two_hands};
use crate::{ScoreOptions, compute_kinematic_curves, measure_hand_movement, score_clips};

/// Returns an irregular series of three channels.
fn series(frames: usize, tempo: f64, shift: f64) -> ChannelSeries {
    let column = |channel: usize| -> Vec<f64> {
        let own = 1.0 + 0.37 * channel as f64;
        (0..frames)
            .map(|n| tempo * n as f64 + shift)
            .map(|at| (at * own).sin() + 0.3 * (at * 2.3 + own).cos())
            .collect()
    };
    ChannelSeries::from_columns(&[column(0), column(1), column(2)]).expect("a series")
}

fn aligned(out: &mut String, pair: [&ChannelSeries; 2], options: &dtw::DtwOptions) {
    let name = format!(
        "{:?} {:?} {:?} open {} {} {:?}",
        options.pattern, options.window, options.local, options.open_begin, options.open_end, options.policy
    );
    match dtw::align_series(pair[0], pair[1], options) {
        Ok(found) => {
            put(out, format!("{name}: {:?}", found.cost));
            put(out, format!("  path {:?}", found.path));
        }
        Err(error) => put(out, format!("{name}: {error}")),
    }
}

#[test]
fn golden_alignments_of_series() {
    let mut out = String::new();
    let (query, reference) = (series(13, 0.31, 0.0), series(17, 0.25, 0.15));
    put(&mut out, "## alignments");
    for pattern in StepPattern::ALL_STEP_PATTERNS {
        for window in [
            AlignmentWindow::None,
            AlignmentWindow::SakoeChiba(5),
            AlignmentWindow::SlantedBand(2),
        ] {
            let options = dtw::DtwOptions {
                pattern,
                window,
                ..dtw::DtwOptions::default()
            };
            aligned(&mut out, [&query, &reference], &options);
        }
        for (open_begin, open_end) in [(true, false), (false, true), (true, true)] {
            let options = dtw::DtwOptions {
                pattern,
                open_begin,
                open_end,
                ..dtw::DtwOptions::default()
            };
            aligned(&mut out, [&query, &reference], &options);
        }
        for policy in [DtwPathPolicy::Resample, DtwPathPolicy::SlantedBand] {
            let options = dtw::DtwOptions {
                pattern,
                policy,
                local: LocalDistance::SquaredEuclidean,
                window: AlignmentWindow::SakoeChiba(2),
                ..dtw::DtwOptions::default()
            };
            aligned(&mut out, [&reference, &query], &options);
        }
    }
    put(&mut out, "\n## nearest");
    let all: Vec<ChannelSeries> = (0..40_u32)
        .map(|n| series(40 + n as usize % 7, 0.2 + 0.004 * f64::from(n), 0.11 * f64::from(n)))
        .collect();
    for pattern in StepPattern::ALL_STEP_PATTERNS {
        for window in [AlignmentWindow::None, AlignmentWindow::SlantedBand(4)] {
            let options = dtw::DtwOptions {
                pattern,
                window,
                ..dtw::DtwOptions::default()
            };
            let found = dtw::find_nearest_candidates(&series(42, 0.26, 1.7), &all, 3, &options);
            put(&mut out, format!("{pattern:?} {window:?}: {found:?}"));
        }
    }
    put(&mut out, "\n## series");
    let scaled = query
        .scale_channels(&[0.5, 2.0, 3.0])
        .expect("scales")
        .resample_series_frames(7);
    for channel in 0..scaled.series_channel_count() {
        put(&mut out, format!("{:?}", scaled.channel_values(channel)));
    }
    compare("alignments", &out);
}

#[test]
fn golden_shifts_maps_and_phases() {
    let mut out = String::new();
    put(&mut out, "## shifts");
    let signal = |from: f64, count: u32, step: f64, hole: Range<u32>| TimedSignal {
        points: (0..count)
            .filter(|n| !hole.contains(n))
            .map(|n| from + f64::from(n) * step)
            .map(|at| (at, (at * 1.7).sin() + 0.6 * (at * at * 0.31).cos()))
            .collect(),
    };
    let first = signal(0.0, 300, 0.04, 90..110);
    for (by, count, step) in [
        (0.0, 280, 0.04),
        (0.37, 400, 0.025),
        (-1.2, 200, 0.05),
        (2.9, 90, 0.033),
    ] {
        let mut second = signal(1.1, count, step, 50..52);
        for point in &mut second.points {
            point.0 -= by;
        }
        for limit in [1.0, 4.0] {
            let found = find_signal_shift(&first, &second, limit);
            let confidence = found.map(|it| it.shift_confidence());
            put(
                &mut out,
                format!("by {by} within {limit}: {found:?} confidence {confidence:?}"),
            );
        }
    }
    // The end of the first signal, under a clock that began much later.
    let mut end = signal(9.0, 70, 0.04, 30..31);
    for point in &mut end.points {
        point.0 -= 11.4;
    }
    put(
        &mut out,
        format!("the end by itself: {:?}", find_signal_shift(&first, &end, 40.0)),
    );
    put(&mut out, "\n## neighbours on the map");
    let things: Vec<WeightedFeatures> = (0..12_u32)
        .map(|n| {
            (0..6)
                .filter(|k| (n * 7 + k * 5) % 4 != 1)
                .map(|k| ((n / 3 + k) % 9, 1.0 + (n * k % 5) as f32))
                .collect()
        })
        .collect();
    let near = find_feature_neighbours(&things, 4, |_| true).expect("neighbours");
    for (n, near) in near.iter().enumerate() {
        put(&mut out, format!("{n}: {near:?}"));
    }
    let places = lay_out_map(&near, |_| true).expect("a map");
    assert_eq!(places.len(), things.len());
    put(&mut out, "\n## phases");
    let wave = |frames: usize, tempo: f64| -> Vec<Vec<f64>> {
        let value = |channel: usize, n: usize| (tempo * n as f64 + channel as f64).sin();
        (0..3)
            .map(|channel| (0..frames).map(|n| value(channel, n)).collect())
            .collect()
    };
    let own = PhasedPerformance::new(&wave(48, 0.21), [0, 9, 25, 36, 48], 1.6).expect("phases");
    for (marks, tempo) in [
        ([0, 9, 25, 36, 48], 0.25),
        ([2, 14, 30, 41, 50], 0.17),
        ([0, 9, 9, 30, 50], 0.3),
    ] {
        let other = PhasedPerformance::new(&wave(50, tempo), marks, 1.9).expect("phases");
        for window in [2, 10] {
            let options = phases::PhasedScoreOptions {
                window,
                weights: [1.0, 0.5, 2.0, 1.5],
                ..phases::PhasedScoreOptions::default()
            };
            match phases::explain_phased_score(&own, &other, 1.4, &options) {
                Ok(found) => {
                    put(
                        &mut out,
                        format!(
                            "{marks:?} window {window}: {:?} {:?} {:?} {:?} {}",
                            found.score, found.unstretched, found.stretch, found.log_stretch, found.partial
                        ),
                    );
                    for phase in found.phases {
                        put(&mut out, format!("  {phase:?}"));
                    }
                }
                Err(error) => put(&mut out, format!("{marks:?} window {window}: {error}")),
            }
        }
    }
    compare("shifts_maps_phases", &out);
}

#[test]
fn golden_proposals_of_nonmanuals() {
    let rate = 50.0;
    let curve = |value: &dyn Fn(f64) -> f64| -> Vec<f64> { (0..400).map(|n| value(f64::from(n) / rate)).collect() };
    let bump = |at: f64, from: f64, to: f64| {
        let rise = ((at - from) / 0.12).clamp(0.0, 1.0);
        rise * ((to - at) / 0.16).clamp(0.0, 1.0)
    };
    let hum = |at: f64| 0.015 * (at * 9.1).sin() + 0.01 * (at * 23.7).cos();
    let swing =
        |at: f64, from: f64, to: f64, times: f64| bump(at, from, to) * (at * times * std::f64::consts::TAU).sin();
    // Too short for any value.
    let spike = |at: f64, from: f64| f64::from(u8::from((from..from + 0.03).contains(&at)));
    let right = curve(&|at| 0.2 + hum(at) + 0.7 * bump(at, 1.0, 2.2) + 0.3 * bump(at, 4.0, 4.6));
    let left = curve(&|at| 0.25 + hum(at + 1.0) + 0.6 * bump(at, 1.1, 2.0));
    let squeeze = curve(&|at| 0.1 + spike(at, 6.5) + hum(at) + 0.8 * bump(at, 3.0, 3.6));
    let lids = curve(&|at| {
        0.1 + spike(at, 3.0) + hum(at) + 0.9 * bump(at, 0.5, 0.8) + 0.85 * bump(at, 5.0, 6.2) + 0.4 * bump(at, 7.0, 7.5)
    });
    let gaze = curve(&|at| spike(at, 5.0) + hum(at) + 0.6 * bump(at, 2.0, 2.9) - 0.7 * bump(at, 6.0, 6.6));
    let up = curve(&|at| hum(at + 2.0) + 0.5 * bump(at, 4.0, 4.9) - 0.4 * bump(at, 7.0, 7.6));
    let jaw = curve(&|at| 0.05 + spike(at, 7.0) + hum(at) + 0.5 * bump(at, 1.0, 1.5) + 0.2 * bump(at, 3.0, 3.4));
    let lips = curve(&|at| 0.05 + hum(at) + 0.6 * bump(at, 1.0, 1.6) + 0.5 * bump(at, 5.0, 5.5));
    let pitch = curve(&|at| 3.0 + 5.0 * swing(at, 1.0, 3.0, 2.0) + 9.0 * bump(at, 6.0, 7.4) + hum(at));
    let yaw = curve(&|at| 1.0 + 7.0 * swing(at, 3.5, 5.5, 1.7) + 12.0 * bump(at, 6.5, 7.5) + hum(at));
    let curves = ObservedFaceCurves {
        rate,
        brow_raise: [Some(&right), Some(&left)],
        brow_squeeze: Some(&squeeze),
        eye_close: [Some(&lids), Some(&lids)],
        gaze_left: Some(&gaze),
        gaze_up: Some(&up),
        jaw_open: Some(&jaw),
        lips_part: Some(&lips),
        head_pitch: Some(&pitch),
        head_yaw: Some(&yaw),
    };
    let mut out = String::new();
    for (name, curves) in [
        ("all curves", curves),
        (
            "the right brow alone",
            ObservedFaceCurves {
                brow_raise: [Some(&right), None],
                brow_squeeze: None,
                ..curves
            },
        ),
        ("another rate", ObservedFaceCurves { rate: 120.0, ..curves }),
    ] {
        put(&mut out, format!("## {name}"));
        for it in propose_face_actions(&curves) {
            put(
                &mut out,
                format!(
                    "{} {} {:?} confidence {:?}: {}",
                    it.feature, it.value, it.frames, it.confidence, it.why
                ),
            );
        }
    }
    compare("nonmanuals", &out);
}

/// Returns one of seven frames of a curve.
fn sampled(curve: &[f64]) -> Vec<f64> {
    curve.iter().copied().step_by(7).collect()
}

fn measured(out: &mut String, clip: &Clip, anatomy: &BodyAnatomy) {
    let found = compute_kinematic_curves(clip, anatomy);
    for (hand, side) in found.hands.iter().zip([BodySide::Right, BodySide::Left]) {
        put(
            out,
            format!(
                "{side:?} speed {:?} minima {:?}",
                sampled(&hand.speed),
                find_speed_minima(&hand.speed)
            ),
        );
        let palms: Vec<_> = hand.palm.iter().step_by(17).collect();
        put(out, format!("  aperture {:?} palm {palms:?}", sampled(&hand.aperture)));
        for mover in [MovingPart::Wrist, MovingPart::Fingers] {
            put(
                out,
                format!(
                    "  strokes {mover:?} {:?}",
                    find_transition_strokes(clip, anatomy, side, mover)
                ),
            );
        }
        for kind in [
            MeasuredKind::Stroke,
            MeasuredKind::Round,
            MeasuredKind::Wave,
            MeasuredKind::Shape,
            MeasuredKind::Transition,
        ] {
            let within = 5..clip.clip_frame_count() - 4;
            if let Some(it) = measure_hand_movement(clip, anatomy, side, within, kind) {
                put(out, format!("  {kind:?} {it:?}"));
            }
        }
    }
    put(out, format!("distance {:?}", sampled(&found.distance)));
}

#[test]
fn golden_measurements_and_scores_of_movements() {
    let cases: Vec<Case> = one_hand()
        .into_iter()
        .step_by(4)
        .chain(two_hands().into_iter().step_by(3))
        .collect();
    let mut out = String::new();
    for case in &cases {
        put(&mut out, format!("## {}", case.name));
        measured(&mut out, &case.clip, &case.anatomy);
    }
    for pair in cases.windows(2) {
        put(&mut out, format!("## {}, and {}", pair[0].name, pair[1].name));
        let slanted = ScoreOptions {
            dtw: dtw::DtwOptions {
                window: AlignmentWindow::SlantedBand(8),
                pattern: StepPattern::Symmetric1,
                ..dtw::DtwOptions::default()
            },
            ..ScoreOptions::default()
        };
        for options in [ScoreOptions::default(), slanted] {
            let found = score_clips(&pair[0].clip, &pair[1].clip, &options).expect("a score");
            put(
                &mut out,
                format!(
                    "{:?} {:?} {:?} joint {:?} {:?} left out {:?}",
                    found.distance,
                    found.normalized,
                    found.components,
                    found.max_joint_error_m,
                    found.worst,
                    found.left_out
                ),
            );
            let path: Vec<_> = found.alignment.iter().step_by(5).collect();
            put(&mut out, format!("  path {path:?}"));
        }
    }
    compare("movements", &out);
}
