//! Golden tables of angles, faces, times and columns.

use glam::{DQuat, DVec3};

use super::{list, milli, turned};
use crate::axes::SpaceAxis;
use crate::column::{ColumnGaps, ColumnNumbers, FileNumber, FrameNumberColumn};
use crate::golden::{compare, put};
use crate::time::{FrameRate, RecordingInstant, TimeSpan};
use crate::{
    FacePosture, FrameTimes, HandAngles, InterpolationKind, RotationOrder, WristAngles, WristLimits, anatomy::HandRange,
};

#[test]
fn golden_angles_of_wrists_and_joints() {
    let mut out = String::new();
    put(&mut out, "## wrists");
    let limits = WristLimits {
        flexion: [1.0, 1.4],
        deviation: [0.6, 0.3],
        turn: [1.2, 1.6],
    };
    let usual = WristAngles {
        flexion: 0.4,
        deviation: -0.1,
        turn: 0.7,
    };
    for flexion in [-1.5, -0.4, 0.9, 2.0] {
        for deviation in [-0.9, -0.1, 0.2, 0.5] {
            let turn = flexion - 3.0 * deviation;
            let asked = WristAngles {
                flexion,
                deviation,
                turn,
            };
            let (low, high) = (
                asked.clamp_to_limits(&limits, false),
                asked.clamp_to_limits(&limits, true),
            );
            put(
                &mut out,
                format!(
                    "{} bend {:?} turned {:?} low {} high {} mix {} apart {:?}",
                    list([flexion, deviation, turn]),
                    asked.wrist_bend_share(&limits),
                    asked.forearm_turn_share(&limits),
                    list([low.flexion, low.deviation, low.turn]),
                    list([high.flexion, high.deviation, high.turn]),
                    list([
                        asked.interpolate_wrist_angles(&usual, 0.3).flexion,
                        asked.interpolate_wrist_angles(&usual, 0.3).turn
                    ]),
                    asked.largest_angle_difference(&usual)
                ),
            );
        }
    }
    put(&mut out, "\n## rotation orders");
    let axes = [SpaceAxis::X, SpaceAxis::Y, SpaceAxis::Z];
    for a in axes {
        for b in axes {
            for c in axes {
                let Some(order) = RotationOrder::new([a, b, c]) else {
                    put(&mut out, format!("{a:?}{b:?}{c:?} is none"));
                    continue;
                };
                for angles in [[0.3, 0.8, -1.1], [2.9, -1.2, 0.4], [0.5, 1.9, 3.0]] {
                    let q = order.to_quat(angles);
                    put(
                        &mut out,
                        format!(
                            "{a:?}{b:?}{c:?} {}: {} near zero {} near itself {} far {}",
                            list(angles),
                            turned(q),
                            list(order.nearest_euler_angles(q, [0.0; 3])),
                            list(order.nearest_euler_angles(q, angles)),
                            list(order.nearest_euler_angles(q, [7.0, -3.0, 5.0]))
                        ),
                    );
                }
                for middle in [1.0, -1.0] {
                    let locked = [0.4, middle * std::f64::consts::FRAC_PI_2, -0.3];
                    let found = order.nearest_euler_angles(order.to_quat(locked), [0.25, 0.0, 6.0]);
                    put(&mut out, format!("  locked {}", list(found)));
                }
            }
        }
    }
    put(&mut out, "\n## interpolation");
    let (from, to) = (
        DQuat::from_rotation_x(0.4),
        DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 2.1),
    );
    for (kind, name) in [
        (InterpolationKind::Slerp, "slerp"),
        (InterpolationKind::Cosine, "cosine"),
        (InterpolationKind::Sigmoid, "sigmoid"),
        (InterpolationKind::MinimumJerk, "minimum-jerk"),
    ] {
        let shares = (-1..=11).map(|n| kind.interpolation_share(f64::from(n) / 10.0));
        put(&mut out, format!("{name} {}", list(shares)));
        for weight in [0.2, 0.6] {
            let there = [to, -to].map(|to| turned(kind.interpolate_rotation(from, to, weight)));
            put(&mut out, format!("  {weight} {}", there.join(", ")));
        }
    }
    compare("angles", &out);
}

#[test]
fn golden_ranges_of_hands() {
    let mut out = String::new();
    // Takes of a hand that opens and closes between two postures, at the steps of a triangle.
    let takes: [(&str, f64, f64, u32); 6] = [
        ("from 0 to 100 degrees", 0.0, 100.0, 900),
        ("from 12 to 80 degrees", 12.0, 80.0, 900),
        ("from -8 to 95 degrees", -8.0, 95.0, 2000),
        ("from 20 to 60 degrees", 20.0, 60.0, 900),
        ("nearly still", 30.0, 34.0, 900),
        ("few", 0.0, 100.0, 60),
    ];
    for (name, from, to, frames) in takes {
        let mut range = HandRange::default();
        for n in 0..frames {
            let share = 1.0 - (f64::from(n % 60) / 30.0 - 1.0).abs();
            let own = |angle: usize| from + (to - from) * share * (0.8 + 0.02 * angle as f64);
            let all: [f64; HandAngles::HAND_ANGLE_COUNT] =
                std::array::from_fn(|angle| (own(angle) + 0.013).to_radians());
            range.add_hand_posture(&HandAngles::from_array(all));
        }
        let correction = range.suggest_hand_correction();
        put(
            &mut out,
            format!(
                "## {name}: {} frames, none {}, largest {:?}",
                range.posture_count(),
                correction.is_none(),
                correction.largest_zero_correction().to_degrees()
            ),
        );
        for degrees in [0.0, 50.0_f64] {
            let asked = HandAngles::from_array([degrees.to_radians(); HandAngles::HAND_ANGLE_COUNT]);
            let found = correction
                .correct_hand_angles(&asked)
                .map_hand_angles(f64::to_degrees)
                .to_array();
            put(&mut out, format!("{degrees}: {}", list(found)));
        }
    }
    let ramp: [f64; HandAngles::HAND_ANGLE_COUNT] = std::array::from_fn(|n| n as f64);
    let halfway = HandAngles::from_array(ramp).interpolate_hand_angles(&HandAngles::default(), 0.25);
    put(&mut out, format!("## a quarter towards rest\n{halfway:?}"));
    compare("hand_ranges", &out);
}

#[test]
fn golden_faces() {
    let mut out = String::new();
    let face = |step: f64| {
        FacePosture::from_numbers(std::array::from_fn(|n| {
            (n as f64 * step).sin() * 1.3 - 0.1 * n as f64 * step
        }))
    };
    let (mut one, two) = (face(0.7), face(-0.4));
    put(&mut out, format!("{one:?}\n{two:?}"));
    put(&mut out, format!("mirrored {:?}", one.mirrored_face()));
    put(
        &mut out,
        format!("towards {}", list(one.interpolate_face(&two, 0.3).face_numbers())),
    );
    for (at, name) in FacePosture::FACE_NUMBER_NAMES.iter().enumerate() {
        let position = FacePosture::face_number_position(name);
        put(
            &mut out,
            format!("{at} {name} {position:?} {}", FacePosture::least_face_number(at)),
        );
    }
    one.add_face_share(&two, 0.6);
    put(&mut out, format!("added {}", list(one.face_numbers())));
    let rate = FrameRate::new(25, 1).expect("a rate");
    for seconds in [-1.0, 0.019, 0.021, 0.058, 0.061, 0.2] {
        let found = FacePosture::face_at_moment(&[face(0.1), face(0.2)], rate, RecordingInstant::from_seconds(seconds));
        let found = found.map(|it| (list(it.face_numbers()), it.is_at_rest()));
        put(&mut out, format!("at {seconds}: {found:?}"));
    }
    put(&mut out, format!("rest {}", FacePosture::default().is_at_rest()));
    compare("faces", &out);
}

#[test]
fn golden_times_and_rates() {
    let mut out = String::new();
    put(&mut out, "## rates");
    let times = [
        ("0.0083333", 7),
        ("0.008333", 6),
        ("0.00833", 5),
        ("0.033333", 6),
        ("0.0333667", 7),
        ("0.033367", 6),
        ("0.04170837", 8),
        ("0.0417", 4),
        ("0.016683", 6),
        ("0.01", 2),
        ("0.04", 2),
        ("0.0123456", 7),
        ("0.3", 1),
        ("7.5", 1),
        ("5000", 0),
        ("0", 0),
        ("90000", 0),
    ];
    for (text, decimals) in times {
        let seconds: f64 = text.parse().expect("a number");
        match FrameRate::from_frame_time(seconds, decimals) {
            Ok(rate) => put(
                &mut out,
                format!(
                    "{text} s: {}/{} = {:?}, frame time {:?} micro",
                    rate.rate_numerator(),
                    rate.per_seconds(),
                    rate.per_second(),
                    rate.frame_time() * 1e6
                ),
            ),
            Err(error) => put(&mut out, format!("{text} s: {error}")),
        }
    }
    put(&mut out, "\n## frames");
    for (frames, seconds) in [(25, 1), (30_000, 1001), (120, 1), (1000, 1), (3, 2)] {
        let rate = FrameRate::new(frames, seconds).expect("a rate");
        let starts: Vec<i64> = [0, 1, 2, 7, 100_003]
            .map(|frame| rate.frame_start_instant(frame).instant_micros())
            .to_vec();
        let at = [-5, 0, 16_683, 19_999, 20_000, 20_001, 500_000, 1_000_000]
            .map(|micros| rate.nearest_frame_at(RecordingInstant::from_micros(micros)));
        let within = [(0, 40_000), (1, 40_001), (39_999, 80_000), (40_000, 40_000)].map(|(start, end)| {
            let span = TimeSpan::from_span_micros(start, end);
            rate.frames_in(span)
        });
        let span = rate.frame_range_span(3..10);
        put(
            &mut out,
            format!(
                "{rate:?}: {starts:?} {at:?} {within:?} {span:?} {:?}",
                span.span_seconds()
            ),
        );
    }
    put(&mut out, "\n## spans");
    let spans = [(0, 10), (5, 10), (10, 20), (3, 3), (-4, 6)].map(|(start, end)| {
        TimeSpan::span_between(RecordingInstant::from_millis(start), RecordingInstant::from_millis(end))
    });
    for a in spans {
        for b in spans {
            put(
                &mut out,
                format!(
                    "{a:?} {b:?}: covers {} overlaps {} both {:?} holds its start {} empty {}",
                    a.has_span_inside(b),
                    a.is_overlapping_span(b),
                    a.span_intersection(b),
                    a.has_instant(b.span_start_instant()),
                    a.is_empty()
                ),
            );
        }
    }
    put(&mut out, "\n## listed times");
    let columns = [
        vec![0.0, 0.1, 0.25, 0.3],
        vec![0.5, 0.54, 0.58, 0.62, 0.66],
        vec![0.5, 0.54, 0.58, 0.63, 0.66],
        vec![0.2],
        vec![0.0, 0.1, 0.1],
        vec![0.0, f64::NAN],
        vec![0.0, 4e9],
    ];
    for column in columns {
        let frames = column.len();
        let times = match FrameTimes::from_listed_seconds(FrameNumberColumn::from_double_floats(column.clone())) {
            Ok(times) => times,
            Err(error) => {
                put(&mut out, format!("{column:?}: {error}"));
                continue;
            }
        };
        let FrameTimes::Listed(listed) = &times else {
            panic!("listed times");
        };
        let even = [1e-9, 0.004, 0.02].map(|tolerance| listed.infer_even_rate(tolerance));
        let at = [-10, 0, 99_999, 100_000, 260_000, 545_000, 900_000]
            .map(|micros| times.shown_frame_at(RecordingInstant::from_micros(micros), frames));
        let within = [(0, 250_001), (100_000, 300_000), (540_000, 620_000)].map(|(start, end)| {
            let span = TimeSpan::from_span_micros(start, end);
            times.frames_in(span, frames)
        });
        let starts: Vec<RecordingInstant> = (0..frames + 2).map(|frame| times.frame_time_instant(frame)).collect();
        put(
            &mut out,
            format!(
                "{column:?}: even {even:?} at {at:?} within {within:?} starts {starts:?} span {:?}, \
                 rate {:?} frames {:?}",
                times.frame_times_span(frames),
                times.even_times_rate(),
                times.timed_frame_count()
            ),
        );
    }
    compare("times", &out);
}

/// Returns everything that a column says of itself.
fn described(column: &FrameNumberColumn) -> String {
    let rows = 0..column.len() + 1;
    let texts: Vec<Option<String>> = rows.map(|frame| column.column_text_at(frame)).collect();
    let inside = match column.column_numbers() {
        ColumnNumbers::Decimals(it) => format!(
            "scale {} {:?} exceptions {:?}",
            it.scale,
            it.mantissas,
            it.exceptions
                .iter()
                .map(|(frame, number)| (*frame, number.to_string()))
                .collect::<Vec<_>>()
        ),
        other => format!("{other:?}"),
    };
    format!(
        "{} {} {inside} gaps {:?} {} {texts:?}",
        column.column_numbers().number_form_name(),
        column.len(),
        column.column_gaps().gap_runs(),
        column.column_gaps().gap_frame_count()
    )
}

#[test]
fn golden_columns_of_numbers() {
    let mut out = String::new();
    let texts: [&[&str]; 6] = [
        &["1.50", "-2", "0", "", "", "12.125"],
        &["123.4", "2.8e-15", "0", "1e-300", "12345678901234567890", "-7"],
        &["", "1e3", "2.5e2", "-4e-1", ""],
        &["999999999999999999", "0.1", "0.01", "100"],
        &["0.000", "-0.5", "+7", ".25", "5."],
        &[],
    ];
    for texts in texts {
        let column = FrameNumberColumn::from_decimals(
            texts
                .iter()
                .map(|text| FileNumber::parse_file_number(text.as_bytes()).ok()),
        );
        put(&mut out, format!("{texts:?}: {}", described(&column)));
        let (mut start, end) = (column.slice_column(0..2), column.slice_column(2..99));
        put(&mut out, format!("  {} | {}", described(&start), described(&end)));
        let joined = start.append_column(&end);
        put(&mut out, format!("  {joined:?} {}", described(&start)));
    }
    let singles = FrameNumberColumn::from_single_floats(vec![1.5, f32::NAN, -0.25, f32::INFINITY]);
    let doubles = FrameNumberColumn::from_double_floats(vec![0.1, f64::NAN, 1e300]);
    let integers = FrameNumberColumn::from_scaled_integers(vec![-8067, 2868, 0], 12.0, 0.1).expect("integers");
    for column in [&singles, &doubles, &integers] {
        put(&mut out, described(column));
        let gapped = column.clone().with_gaps(&ColumnGaps::from_gap_runs([0..1, 2..3]));
        put(&mut out, format!("  {:?}", gapped.map(|it| described(&it))));
        let gapped = column.clone().with_gaps(&ColumnGaps::from_gap_frames([9]));
        put(&mut out, format!("  {:?}", gapped.map_err(|it| it.to_string())));
        for other in [&singles, &doubles, &integers] {
            let mut joined = column.clone();
            let result = joined.append_column(other).map_err(|it| it.to_string());
            put(&mut out, format!("  {result:?} {}", described(&joined)));
        }
    }
    for (zero, unit) in [(0.0, 0.0), (f64::NAN, 1.0), (1.0, f64::INFINITY)] {
        let column = FrameNumberColumn::from_scaled_integers(vec![1], zero, unit).map_err(|it| it.to_string());
        put(&mut out, format!("{column:?}"));
    }
    put(&mut out, "\n## gaps");
    let gaps = ColumnGaps::from_gap_runs([7..9, 2..4, 4..5, 12..15]);
    for start in 0..16 {
        let slices = [0, 1, 3, 8].map(|count| gaps.slice_gaps(start..start + count).gap_runs().to_vec());
        put(&mut out, format!("{start}: {} {slices:?}", gaps.is_gap_frame(start)));
    }
    put(&mut out, "\n## numbers");
    for text in [
        "1.5",
        "-0",
        "1e18",
        "1e19",
        "1e-20",
        "12e-3",
        "999999999999999999",
        "1000000000000000000",
        "123456789012345678.9",
        "0.0e5",
        "1e255",
        "1e-255",
        "1e-256",
        "-1.25E+3",
        "1e308",
        "1e309",
        "00012.50",
        "1,5",
        "1,5,5",
        "nan",
        "1.#QNAN",
        "+inf",
        "5e",
        "e5",
        "1 2",
    ] {
        let parsed = FileNumber::parse_file_number(text.as_bytes());
        let said = parsed.as_ref().map(|it| (it.to_string(), it.to_f64()));
        put(&mut out, format!("{text}: {parsed:?} {said:?}"));
    }
    let point = crate::MotionMarker::new("a", vec![singles, doubles]);
    put(
        &mut out,
        format!(
            "{:?}",
            (0..3).map(|n| point.marker_position(n).map(milli)).collect::<Vec<_>>()
        ),
    );
    compare("columns", &out);
}
