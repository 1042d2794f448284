//! Tests of the readers of face captures and curves: each format, hostile bytes, and other people's files.

use std::fmt::Write as _;

use super::*;

/// Writes a track of curves as CSV: a column of seconds, then one for each curve, `name [unit]`.
pub(crate) fn write_curves_csv(curves: &CurveTrack, offset: RecordingInstant) -> String {
    let quoted = |name: &str| match name.contains([',', '"', '\n']) {
        true => format!("\"{}\"", name.replace('"', "\"\"")),
        false => name.to_owned(),
    };
    let mut out = String::from("time [s]");
    for curve in curves.track_curves() {
        let unit = if curve.unit.is_empty() {
            String::new()
        } else {
            format!(" [{}]", curve.unit)
        };
        let _ = write!(out, ",{}", quoted(&format!("{}{unit}", curve.name)));
    }
    out.push('\n');
    for frame in 0..curves.curve_frame_count() {
        let seconds = curves.curve_times().frame_time_instant(frame).instant_seconds() + offset.instant_seconds();
        let _ = write!(out, "{seconds:.6}");
        for curve in curves.track_curves() {
            let _ = write!(out, ",{}", curve.values.column_text_at(frame).unwrap_or_default());
        }
        out.push('\n');
    }
    out
}

fn curves(text: &str) -> (CurveTrack, RecordingInstant, Vec<ImportFinding>) {
    let (tracks, findings) = read_curves(text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let CapturedTrackContent::Curves(curves) = tracks.tracks[0].content.clone() else {
        panic!("curves");
    };
    (curves, tracks.tracks[0].offset, findings)
}

fn find_curve<'t>(track: &'t CurveTrack, name: &str) -> Option<&'t ScalarCurve> {
    let mut curves = track.track_curves().iter();
    curves.find(|curve| curve.name.eq_ignore_ascii_case(name))
}

fn values(curves: &CurveTrack, name: &str) -> Vec<Option<f64>> {
    find_curve(curves, name)
        .unwrap_or_else(|| panic!("{name}"))
        .values
        .column_values()
        .collect()
}

#[test]
fn live_link_has_the_times_of_its_timecodes() {
    let text = "Timecode,BlendShapeCount,JawOpen,HeadYaw\n\
                23:59:59:58.500,61,0.25,-0.1473\n23:59:59:59.500,61,0.5,0.1\n00:00:00:00.500,61,,0.2\n";
    let (curves, offset, _) = curves(text);
    assert_eq!(values(&curves, "jawopen"), [Some(0.25), Some(0.5), None]);
    assert_eq!(
        curves.curve_times().even_times_rate().map(|rate| rate.rate_numerator()),
        Some(60)
    );
    assert_eq!(offset, RecordingInstant::RECORDING_START);
    let yaw = find_curve(&curves, "HeadYaw").expect("a curve");
    assert_eq!(
        (yaw.unit.as_str(), yaw.values.column_text_at(0).as_deref()),
        ("rad", Some("-0.1473"))
    );
    let uneven = text.replace("00:00:00:00.500", "00:00:00:30.0");
    let (tracks, _) = read_curves(uneven.as_bytes()).expect("curves");
    let CapturedTrackContent::Curves(curves) = &tracks.tracks[0].content else {
        panic!("curves");
    };
    assert_eq!(
        curves.curve_times().even_times_rate(),
        None,
        "rows have their own times"
    );
}

#[test]
fn rows_without_a_face_and_the_decimals_of_other_countries_are_read() {
    let plain = "Timecode,BlendShapeCount,JawOpen,HeadYaw\n00:00:00:59.0,2,0.25,0.1\n00:00:01:00.0,2,0.5,0.1\n00:00:01:01.0,2,,\n";
    let (expected, _, _) = curves(plain);
    let empty = plain.replace("01.0,2,,", "01.0,2");
    assert!(read_curves(empty.as_bytes()).is_err(), "a row that is cut");
    let dialects = [
        plain.replace(',', ";").replace('.', ","),
        plain.replace(',', ";"),
        plain.replace('\n', ",\n"),
        format!("\n{plain}"),
        plain.replace("2,,", "2,nan,-nan(ind)"),
    ];
    for dialect in dialects {
        assert_eq!(curves(&dialect).0, expected, "{dialect}");
    }
    for row in ["0", "0,,", "0,0.0,0.0"] {
        let (found, _, findings) = curves(&plain.replace("2,,", row));
        assert_eq!(found.curve_frame_count(), 3, "{row}");
        let said = |it: &ImportFinding| it.message.ends_with("mean nothing: 1");
        assert!(findings.iter().any(said), "{row}: {findings:?}");
    }
}

#[test]
fn a_column_of_frame_numbers_before_the_times_is_no_curve() {
    let rows = |step: f64| {
        (0..60_u32).fold(String::new(), |text, row| {
            text + &format!("{row},{},0.5,1\n", f64::from(row) * step)
        })
    };
    for title in ["frame", "Frame [30 fps]"] {
        let text = format!("{title},time_s,JawOpen,MouthClose\n{}", rows(1000.0 / 29988.0));
        let (curves, offset, findings) = curves(&text);
        let names: Vec<&str> = curves.track_curves().iter().map(|it| it.name.as_str()).collect();
        assert_eq!(names, ["JawOpen", "MouthClose"], "{title}");
        let expected = FrameRate::new(29988, 1000).expect("a rate");
        assert_eq!(curves.curve_times().even_times_rate(), Some(expected), "{title}");
        assert_eq!(
            (offset, findings.len()),
            (RecordingInstant::RECORDING_START, 0),
            "{title}"
        );
    }
    let alone = b"frame,time_s\n0,0\n";
    assert_eq!(CurveFile::detect_curve_file(alone), None, "there is no curve");
}

#[test]
fn times_of_open_face_and_of_tables_show_the_rate_of_the_film() {
    let open_face = |rate: f64, rows: u32| {
        let mut text = "frame, timestamp, confidence, success, AU01_r\n".to_owned();
        for row in 0..rows {
            text += &format!("{}, {:.3}, 0.98, 1, 0.5\n", row + 1, f64::from(row) / rate);
        }
        text
    };
    for (rate, rows) in [
        (30.0, 60),
        (29.97, 300),
        (59.94, 600),
        (60.0, 300),
        (25.0, 7),
        (23.976, 99),
    ] {
        let (found, _, _) = curves(&open_face(rate, rows));
        let found = found.curve_times().even_times_rate().expect("a rate").per_second();
        assert!((found / rate - 1.0).abs() < 3e-6, "{rate}: {found}");
    }
    let timeless = "frame, confidence, success, AU01_r\n1, 0.98, 1, 0.5\n2, 0.98, 1, 0.5\n";
    let (found, _, findings) = curves(timeless);
    assert_eq!(
        found.curve_times().even_times_rate().map(|rate| rate.rate_numerator()),
        Some(30)
    );
    assert!(
        findings[0]
            .message
            .contains("its frames have no times; 30 a second are taken")
    );
    for (title, rate, is_said) in [
        ("timestamp", 25.0, true),
        ("time [s]", 0.025, false),
        ("time_ms", 25.0, false),
    ] {
        let text = format!("{title},jawOpen\n0,0.1\n40,0.2\n80,0.3\n");
        let (found, _, findings) = curves(&text);
        let found = found.curve_times().even_times_rate().expect("a rate").per_second();
        assert!((found - rate).abs() < 1e-6, "{title} {found}");
        let said = |it: &ImportFinding| it.message.contains("read as milliseconds");
        assert_eq!(findings.iter().any(said), is_said, "{title}");
    }
}

#[test]
fn every_face_of_open_face_is_a_track() {
    let head = "frame, face_id, timestamp, confidence, success, AU01_r\n";
    let rows = "1, 0, 0.000, 0.9, 1, 0.1\n1, 1, 0.000, 0.9, 1, 0.5\n2, 0, 0.040, 0.9, 1, 0.2\n\
                3, 1, 0.080, 0.9, 1, 0.6\n3, 0, 0.080, 0.9, 1, 0.3\n4, 1, 0.120, 0.9, 1, 0.7\n";
    let (tracks, findings) = read_curves(format!("{head}{rows}").as_bytes()).expect("two faces");
    let found = tracks.tracks.iter().map(|track| {
        let CapturedTrackContent::Curves(curves) = &track.content else {
            panic!("curves");
        };
        let last = curves.curve_times().frame_time_instant(2).instant_millis();
        (track.name.as_str(), values(curves, "AU01_r"), last)
    });
    let expected = [
        ("face", vec![Some(0.1), Some(0.2), Some(0.3)], 80),
        ("face 2", vec![Some(0.5), Some(0.6), Some(0.7)], 120),
    ];
    assert_eq!(found.collect::<Vec<_>>(), expected);
    assert!(
        findings[0].message.ends_with("is a track of its own: 0, 1"),
        "{findings:?}"
    );
    let crowd: String = (0..17).map(|face| format!("1, {face}, 0, 0.9, 1, 0.1\n")).collect();
    let error = read_curves(format!("{head}{crowd}").as_bytes()).expect_err("a crowd");
    assert!(error.to_string().contains("more than 16 faces"), "{error}");
}

#[test]
fn landmarks_beside_scores_are_counted_and_hands_are_no_scores() {
    let text = r#"[{"timestampMs": 0, "faceLandmarks": [[{"x": 0.1, "y": 0.2}]], "faceBlendshapes": [{"categories": [{"categoryName": "jawOpen", "score": 0.5}]}]},
        {"timestampMs": 40, "faceBlendshapes": [{"categories": [{"categoryName": "jawOpen", "score": 0.5}]}]}]"#;
    let (_, _, findings) = curves(text);
    assert_eq!(
        findings[0].message,
        "landmarks beside the scores are left out: 1 frames have them"
    );
    let hands = br#"{"landmarks": [], "handedness": [[{"categoryName": "Left", "score": 0.9}]]}"#;
    assert_eq!(CurveFile::detect_curve_file(hands), None);
    assert!(keypoints::is_keypoints(hands));
}

#[test]
fn degrees_and_radians_are_distinguished_by_their_size() {
    let text = "Timecode,BlendshapeCount,HeadRoll\n00:00:00:00.0,52,12.5\n00:00:00:01.0,52,1\n";
    assert_eq!(curves(text).0.track_curves()[1].unit, "deg");
}

#[test]
fn units_of_faces_that_are_converted_or_guessed_are_reported_at_import() {
    // The title of the turns with their largest value, the shapes' largest value, the yaw (rad), and what is said.
    let cases = [
        ("HeadYaw", 20.0, 0.9, 0.349, "degrees"),
        ("HeadYaw [deg]", 20.0, 0.9, 0.349, "are degrees"),
        ("HeadYaw_deg", 1.0, 0.9, 0.0175, "are degrees"),
        ("HeadYaw (degrees)", 1.0, 0.9, 0.0175, "are degrees"),
        ("HeadYaw", 1.0, 0.9, 1.0, ""),
        ("HeadYaw [rad]", 2.5, 0.9, 2.5, ""),
        ("HeadYaw", 2.5, 0.9, 2.5, "too far for radians"),
        ("HeadYaw", 1.0, 90.0, 1.0, "percent"),
        ("HeadYaw", 1.0, 3.0, 1.0, "percent"),
    ];
    for head in ["time [s]", "Timecode,BlendshapeCount"] {
        for (title, turn, shape, yaw, said) in cases {
            let pitch = title.replace("Yaw", "Pitch");
            let roll = title.replace("Yaw", "Roll");
            let first = ["0", "00:00:00:00.0,52"][usize::from(head.starts_with('T'))];
            let next = ["0.1", "00:00:00:01.0,52"][usize::from(head.starts_with('T'))];
            let text = format!(
                "{head},JawOpen,BrowInnerUp,EyeBlinkLeft,{title},{pitch},{roll}\n{first},0,0,0,0,0,0\n{next},{shape},0,0,{turn},0,0\n"
            );
            let (found, _, findings) = curves(&text);
            let view = FaceSystem::system_of_curves(&found)
                .expect("a face")
                .derive_face_view(&found);
            let turned = view.head.expect("turns")[1][1];
            assert!((turned - yaw).abs() < 1e-3, "{title} {turn}: {turned}");
            let unit = |it: &&ImportFinding| {
                let says = |part| it.message.contains(part);
                says("turns of the head") || says("percent")
            };
            let units: Vec<&ImportFinding> = findings.iter().filter(unit).collect();
            assert_eq!(units.len(), usize::from(!said.is_empty()), "{title}: {units:?}");
            assert!(
                units.iter().all(|unit| unit.message.contains(said)),
                "{title}: {units:?}"
            );
        }
    }
}

#[test]
fn open_face_keeps_every_column_and_reports_lost_faces() {
    let text =
        "frame, timestamp, confidence, success, pose_Tx, AU01_r\n1, 0, 0.9, 1, 3.5, 0.1\n2, 0.04, 0.1, 0, 0, 0\n";
    let (curves, _, findings) = curves(text);
    assert_eq!(curves.track_curves().len(), 6);
    assert_eq!(
        curves.curve_times().even_times_rate().map(|rate| rate.rate_numerator()),
        Some(25)
    );
    assert_eq!(
        find_curve(&curves, "pose_Tx").map(|curve| curve.unit.as_str()),
        Some("mm")
    );
    assert!(
        findings[0]
            .message
            .contains("whose numbers are kept and mean nothing: 1"),
        "{findings:?}"
    );
}

#[test]
fn media_pipe_scores_become_curves_with_gaps() {
    let text = r#"[{"timestampMs": 0, "faceBlendshapes": [{"categories": [{"categoryName": "_neutral", "score": 1e-6}, {"categoryName": "jawOpen", "score": 0.5}]}]},
        {"timestampMs": 40, "faceBlendshapes": []},
        {"timestampMs": 80, "faceBlendshapes": [{"categories": [{"categoryName": "jawOpen", "score": 0.25}]}]}]"#;
    let (curves, _, findings) = curves(text);
    assert_eq!(findings, []);
    assert_eq!(values(&curves, "jawOpen"), [Some(0.5), None, Some(0.25)]);
    assert_eq!(values(&curves, "_neutral"), [Some(1e-6), None, None]);
    assert_eq!(
        curves.curve_times().even_times_rate().map(|rate| rate.rate_numerator()),
        Some(25)
    );
}

#[test]
fn numbers_of_json_are_kept_to_the_last_digit() {
    let scores = ["0.9452706955539223", "0.38120423768821243", "0.21659939713061338"];
    for score in scores {
        let frame = format!(
            "{{\"timestampMs\": 0, \"faceBlendshapes\": [{{\"categories\": [{{\"categoryName\": \"jawOpen\", \"score\": {score}}}]}}]}}"
        );
        let (found, ..) = curves(&format!("[{frame}, {}]", frame.replace(": 0,", ": 40,")));
        let exact = score.parse::<f64>().ok();
        assert_eq!(values(&found, "jawOpen"), [exact, exact], "{score}");
    }
}

#[test]
fn fap_text_holds_what_its_masks_name() {
    let masks = |on: &[usize]| {
        let bits = (1..=68).map(|at| if on.contains(&at) { "1" } else { "0" });
        bits.collect::<Vec<_>>().join(" ")
    };
    let text = format!("2.1 face 25 2\n{}\n0 120\n{}\n1 100 -7\n", masks(&[3]), masks(&[3, 31]));
    let (curves, _, _) = curves(&text);
    assert_eq!(values(&curves, "FAP3"), [Some(120.0), Some(100.0)]);
    assert_eq!(values(&curves, "FAP31"), [None, Some(-7.0)]);
    assert_eq!(curves.track_curves().len(), 2);
    let viseme = format!("2.1 face 25 1\n{}\n0 1 2 3\n", masks(&[1]));
    assert!(
        read_curves(viseme.as_bytes())
            .expect_err("a viseme")
            .to_string()
            .contains("visemes")
    );
}

#[test]
fn plain_tables_read_back_unchanged() {
    let text = "time [s],force [N],\"a,b\"\n0.500000,1.50,\n0.510000,,2e-3\n";
    let (curves, offset, _) = curves(text);
    assert_eq!(offset.instant_millis(), 500);
    assert_eq!(
        curves.curve_times().even_times_rate().map(|rate| rate.rate_numerator()),
        Some(100)
    );
    assert_eq!(write_curves_csv(&curves, offset), text.replace("2e-3", "0.002"));
}

#[test]
fn scores_of_one_frame_are_read_from_their_text_form() {
    let text = "# proto-message: ClassificationList\nclassification {\n  index: 0\n  score: 2.9e-05\n  label: \"_neutral\"\n}\n\
                classification {\n  index: 1\n  score: 0.79\n  label: \"browDownLeft\"\n}\n";
    assert_eq!(
        CurveFile::detect_curve_file(text.as_bytes()),
        Some(CurveFile::MediaPipe)
    );
    let (curves, _, findings) = curves(text);
    assert_eq!((curves.curve_frame_count(), curves.track_curves().len()), (1, 2));
    let down = find_curve(&curves, "browDownLeft").expect("a score");
    assert_eq!(down.values.column_text_at(0).as_deref(), Some("0.79"));
    assert!(findings.iter().any(|it| it.message.contains("one frame")));
    assert!(read_curves(b"classification {\n score: high\n}\n").is_err());
    assert!(read_curves(b"classification {\n}\n").is_err());
}

#[test]
fn tables_that_mean_nothing_are_refused_with_the_line() {
    let cases = [
        ("gloss,handshape\nCHAT,U\n", "no table of channels"),
        ("time,a\n", "no numbers"),
        ("time,a\n0,1,2\n", "line 2: the row has 3 cells"),
        ("time,a\n0,x\n", "line 2: \"x\" is no number"),
        ("time,a\n1,0\n0,0\n", "is not later"),
        ("Timecode,BlendShapeCount,A\nnoon,1,2\n", "is no timecode"),
        ("2.1 face 25 1\n0 1\n", "68 masks"),
        ("{\"faceBlendshapes\": 3}", "no frame holds"),
    ];
    for (text, expected) in cases {
        let error = read_curves(text.as_bytes()).expect_err(expected).to_string();
        assert!(error.contains(expected), "{text}: {error}");
    }
}

#[test]
fn faces_of_others_are_read_whole() {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return;
    };
    let folder = std::path::Path::new(&folder).join("face");
    let open = |path: &str| {
        let bytes = std::fs::read(folder.join(path)).expect("a file");
        let (tracks, _) = read_curves(&bytes).unwrap_or_else(|error| panic!("{path}: {error}"));
        match tracks.tracks[0].content.clone() {
            CapturedTrackContent::Curves(curves) => curves,
            CapturedTrackContent::Markers(_) => panic!("curves"),
        }
    };
    let link = open("alexdjulin-LiveLinkFace/alex_rom_4.csv");
    assert!(
        (link.curve_track_span().span_seconds() - 127.0).abs() < 1.0,
        "{}",
        link.curve_track_span().span_seconds()
    );
    assert_eq!(link.track_curves().len(), 62);
    let decoded = open("think-biq-LLV/dao_decoded.csv");
    assert!((decoded.curve_track_span().span_seconds() - 3.0).abs() < 1.0);
    let open_face = open("cosanlab-py-feat/OpenFace_Test.csv");
    assert_eq!(
        (open_face.track_curves().len(), open_face.curve_frame_count()),
        (431, 100)
    );
    let rate = open_face
        .curve_times()
        .even_times_rate()
        .map(|rate| rate.rate_numerator());
    assert_eq!(rate, Some(30), "it is a series of pictures, 1 ms apart");
}

#[test]
fn timestamps_that_count_pictures_are_no_times() {
    // Timestamps, numbers of frames, and the rate and duration of what is read.
    for (times, numbers, rate, last) in [
        (["0", "0.001", "0.002"], [1, 2, 3], Some(30), 2.0 / 30.0),
        (["0", "0", "0"], [1, 2, 3], Some(30), 2.0 / 30.0),
        (["0", "0.001", "0.002"], [1, 2, 9], None, 8.0 / 30.0),
        (["0", "0.001", "0.002"], [1, 1, 1], Some(30), 2.0 / 30.0),
        (["0", "0.002", "0.004"], [1, 2, 3], Some(500), 0.004),
    ] {
        let mut text = "frame, timestamp, confidence, success, AU01_r\n".to_owned();
        for (time, number) in times.iter().zip(numbers) {
            text.push_str(&format!("{number}, {time}, 0.9, 1, 0.1\n"));
        }
        let (curves, _, findings) = curves(&text);
        let found = curves.curve_times().even_times_rate().map(|rate| rate.rate_numerator());
        assert_eq!(found, rate, "{times:?} {numbers:?}");
        let end = curves.curve_times().frame_time_instant(2).instant_seconds();
        assert!((end - last).abs() < 2e-6, "{times:?} {numbers:?}: {end}");
        let warned = findings.iter().any(|it| it.message.contains("a series of pictures"));
        assert_eq!(warned, rate != Some(500), "{findings:?}");
    }
}

/// Returns packets of Live Link Face as the program LLV records them.
fn packets(frames: &[(u32, [f32; 3])]) -> Vec<u8> {
    let mut bytes = vec![6];
    bytes.extend((frames.len() as u32).to_be_bytes());
    for (frame, values) in frames {
        let mut packet = vec![6];
        for name in ["DEVICE", "subject"] {
            packet.extend((name.len() as u32).to_be_bytes());
            packet.extend(name.as_bytes());
        }
        packet.extend(frame.to_be_bytes());
        packet.extend(0.5_f32.to_be_bytes());
        packet.extend(60_u32.to_be_bytes());
        packet.extend(1_u32.to_be_bytes());
        packet.push(values.len() as u8);
        values.iter().for_each(|it| packet.extend(it.to_be_bytes()));
        bytes.extend((packet.len() as u32).to_be_bytes());
        bytes.extend(packet);
    }
    bytes
}

fn frames(tracks: &CapturedTracks) -> usize {
    match &tracks.tracks[0].content {
        CapturedTrackContent::Curves(curves) => curves.curve_frame_count(),
        CapturedTrackContent::Markers(markers) => markers.marker_frame_count(),
    }
}

#[test]
fn packets_are_read_with_the_names_and_the_times_that_they_stand_for() {
    let bytes = packets(&[(100, [0.25, 0.1, 0.0]), (101, [0.5, 0.2, 1.0]), (103, [0.75, 0.3, 0.5])]);
    assert_eq!(CurveFile::detect_curve_file(&bytes), Some(CurveFile::Packets));
    let (tracks, _) = read_curves(&bytes).expect("packets");
    let CapturedTrackContent::Curves(curves) = &tracks.tracks[0].content else {
        panic!("curves");
    };
    assert_eq!(values(curves, "EyeBlinkLeft"), [Some(0.25), Some(0.5), Some(0.75)]);
    assert_eq!(curves.curve_times().even_times_rate(), None, "a packet is missing");
    assert!((curves.curve_times().frame_time_instant(2).instant_seconds() - 0.05).abs() < 1e-6);
    let text = curves.track_curves()[1].values.column_text_at(0);
    assert_eq!(text.as_deref(), Some("0.1"), "the shortest decimal of a single");
    let (cut, _) = read_curves(&bytes[..bytes.len() - 5]).expect("what is whole");
    assert_eq!(frames(&cut), 2);
}

#[test]
fn hostile_faces_are_refused_or_read_and_fill_no_memory() {
    let masks = ["1"; 68].join(" ");
    let rows = "0.5,".repeat(70);
    let deep = "[".repeat(20_000);
    let texts = [
        format!("2.1 a face with blanks 25 1\n{masks}\n0 {}\n", "9".repeat(5_000)),
        "2.1 x 1e308 99999999999999999999\n".to_owned(),
        "2.1 x NaN 1\n0\n".to_owned(),
        format!("Timecode,BlendShapeCount,JawOpen\n99:99:99:99.999,61,{}\n", "1".repeat(9_000)),
        "Timecode,BlendShapeCount,JawOpen\n00:00:00:00.0,61,1e999\n".to_owned(),
        format!("Timecode,BlendShapeCount\n{rows}\n"),
        "frame,timestamp,confidence,success\n1,1e300,1,1\n2,-1e300,1,1\n".to_owned(),
        "frame,timestamp,confidence,success,face_id\n1,0,1,1,0\n2,0,1,1,7\n".to_owned(),
        format!("{{\"faceBlendshapes\": {deep}"),
        "[{\"categoryName\": \"a\", \"faceBlendshapes\": [{\"categories\": [{\"categoryName\": \"x\", \"score\": 1e400}]}]}]".to_owned(),
        format!("classification {{\n score: {}\n label: x\n}}\n", "7".repeat(9_000)),
    ];
    for text in &texts {
        let _ = read_curves(text.as_bytes());
    }
    let whole = packets(&[(1, [0.0, f32::NAN, f32::INFINITY]), (0, [1.0; 3])]);
    for cut in 0..whole.len() {
        let _ = read_curves(&whole[..cut]);
    }
    for at in 0..whole.len() {
        for flip in [0xff, 0x80, 0x01] {
            let mut damaged = whole.clone();
            damaged[at] ^= flip;
            let _ = read_curves(&damaged);
        }
    }
    let mut announced = whole.clone();
    announced[1..5].fill(0xff);
    let (tracks, _) = read_curves(&announced).expect("as many packets as there are");
    assert_eq!(frames(&tracks), 1, "the second is not later");
    let gzip = [0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, 3, 0xff, 0xff];
    assert!(read_curves(&gzip).is_err());
}

#[test]
fn names_with_blanks_are_read_and_an_unknown_parameter_is_refused() {
    let masks = |on: usize| {
        let bits = (1..=69).map(|at| if at == on { "1" } else { "0" });
        bits.collect::<Vec<_>>().join(" ")
    };
    let text = format!("2.1 my own face 25 1\n{} \n0 120 \n", masks(31));
    assert_eq!(values(&curves(&text).0, "FAP31"), [Some(120.0)]);
    let odd = format!("2.1 face 25 1\n{}\n0 120\n", masks(69));
    assert!(read_curves(odd.as_bytes()).is_err(), "parameter 69 does not exist");
}

/// Tests every face file by other people: each number of the file is the same in the program's own table.
#[test]
fn faces_of_others_keep_every_number() {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return;
    };
    let folder = std::path::Path::new(&folder).join("face");
    let files = [
        "alexdjulin-LiveLinkFace/alex_rom_4.csv",
        "think-biq-LLV/dao_decoded.csv",
        "think-biq-LLV/dao.gesichter",
        "cosanlab-py-feat/OpenFace_Test.csv",
        "google-ai-edge-mediapipe/portrait_expected_blendshapes.pbtxt",
    ];
    let open = |path: &str| {
        let bytes = std::fs::read(folder.join(path)).expect("a file");
        let (tracks, _) = read_curves(&bytes).unwrap_or_else(|error| panic!("{path}: {error}"));
        match tracks.tracks[0].content.clone() {
            CapturedTrackContent::Curves(curves) => curves,
            CapturedTrackContent::Markers(_) => panic!("curves"),
        }
    };
    for path in files {
        let before = open(path);
        let text = write_curves_csv(&before, RecordingInstant::RECORDING_START);
        let (back, _, _) = curves(&text);
        assert_eq!(back.track_curves().len(), before.track_curves().len(), "{path}");
        for (a, b) in before.track_curves().iter().zip(back.track_curves()) {
            let same =
                (0..before.curve_frame_count()).all(|at| a.values.column_text_at(at) == b.values.column_text_at(at));
            assert!(same, "{path}: {}", a.name);
        }
    }
    // Others decoded the same numbers from the packets.
    let (own, theirs) = (
        open("think-biq-LLV/dao.gesichter"),
        open("think-biq-LLV/dao_decoded.csv"),
    );
    assert_eq!((own.curve_frame_count(), own.track_curves().len()), (180, 61));
    for curve in own.track_curves() {
        let other = find_curve(&theirs, &curve.name).expect("the same channel");
        for at in 0..own.curve_frame_count() {
            let (a, b) = (curve.values.column_value_at(at), other.values.column_value_at(at));
            let off = (a.expect("a number") - b.expect("a number")).abs();
            assert!(off < 1e-6, "{} at {at}: {a:?} {b:?}", curve.name);
        }
    }
    let yaw = find_curve(&own, "HeadYaw").expect("a head");
    let of = |choose: fn(f64, f64) -> f64| yaw.values.column_values().flatten().reduce(choose);
    let (least, most) = (of(f64::min).expect("yaw"), of(f64::max).expect("yaw"));
    assert!(
        (least + 0.189).abs() < 1e-3 && (most - 0.310).abs() < 1e-3,
        "{least} {most}"
    );
}

#[test]
fn a_take_of_live_link_is_written_number_by_number() {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return;
    };
    let folder = std::path::Path::new(&folder).join("face");
    for path in [
        "alexdjulin-LiveLinkFace/alex_rom_4.csv",
        "think-biq-LLV/dao_decoded.csv",
    ] {
        let file_text = std::fs::read_to_string(folder.join(path)).expect("a file");
        let (tracks, _) = read_curves(file_text.as_bytes()).expect("curves");
        let (track, day) = (&tracks.tracks[0], tracks.tracks[0].clock.expect("a time of day"));
        let CapturedTrackContent::Curves(curves) = &track.content else {
            panic!("curves");
        };
        let (written, findings) = write_live_link_csv(curves, day).expect("shapes of ARKit");
        assert!(findings.is_empty(), "{findings:?}");
        let cells = |line: &str| line.trim().split(',').map(str::to_owned).collect::<Vec<_>>();
        assert_eq!(written.lines().count(), file_text.lines().count(), "{path}");
        for (number, (expected, found)) in file_text.lines().map(cells).zip(written.lines().map(cells)).enumerate() {
            assert_eq!(found.len(), 63);
            for (expected, found) in expected.iter().zip(&found) {
                let same_number = expected.parse::<f64>().is_ok_and(|one| found.parse() == Ok(one));
                assert!(expected == found || same_number, "{path}:{number}: {expected} {found}");
            }
        }
    }
}

#[test]
fn faces_of_other_systems_get_the_columns_of_live_link() {
    let (curves, _, _) =
        curves("time,jawOpen,browInnerUp,eyeBlink_L,HeadYaw [deg],joy\n86399.99,50,0,100,90,7\n86400.01,,,,,\n");
    let begin = RecordingInstant::from_seconds(86399.99);
    let (text, findings) = write_live_link_csv(&curves, begin).expect("shapes of ARKit");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    let cell = |row: usize, title: &str| {
        let at = rows[0].iter().position(|other| *other == title).expect("a column");
        rows[row][at]
    };
    assert_eq!(
        [cell(1, "Timecode"), cell(2, "Timecode")],
        ["23:59:59:59.400", "00:00:00:00.600"]
    );
    assert_eq!(
        [cell(1, "BlendShapeCount"), cell(1, "TongueOut"), cell(2, "JawOpen")],
        ["61", "0", ""]
    );
    assert_eq!(
        [cell(1, "JawOpen"), cell(1, "EyeBlinkLeft")],
        ["0.5000000000", "1.0000000000"]
    );
    assert_eq!(cell(1, "HeadYaw"), "1.5707963268");
    for said in [
        "does not have are 0: EyeLookDownLeft",
        "left out: joy",
        "converted to the units",
    ] {
        assert!(
            findings.iter().any(|finding| finding.message.contains(said)),
            "{said}: {findings:?}"
        );
    }
    let (others, _, _) = self::curves("time,Fx,Fy\n0,1,2\n0.01,1,2\n");
    assert_eq!(write_live_link_csv(&others, begin), None);
}

#[test]
fn frames_of_a_face_need_their_rate() {
    let table = |first: &str| format!("{first},jawOpen,browInnerUp,eyeBlinkLeft\n0,0,0,0\n1,0.5,0,0\n");
    let error = read_curves(table("frame").as_bytes()).expect_err("no rate");
    assert!(error.to_string().contains("frame [30 fps]"), "{error}");
    assert!(read_curves(table("frame [30 fps]").as_bytes()).is_ok());
    assert_eq!(CurveFile::detect_curve_file(b"frame,gloss,handshape\n1,BOL,B\n"), None);
}

#[test]
fn shapes_by_name_and_rows_of_weights_are_read_from_json() {
    let list = r#"[{"time":0,"blendShapes":{"jawOpen":0,"browInnerUp":0.5}},
        {"time":0.04,"blendShapes":{"jawOpen":0.6,"browInnerUp":0.5}}]"#;
    let frames = r#"{"fps":25,"frames":[{"jawOpen":0,"browInnerUp":0.5},{"jawOpen":0.6,"browInnerUp":0.5}]}"#;
    let rows = r#"{"exportFps":25.0,"numFrames":2,"facsNames":["jawOpen","browInnerUp"],
        "weightMat":[[0,0.5],[0.6,0.5]]}"#;
    for text in [list, frames, rows] {
        let (curves, _, findings) = curves(text);
        assert_eq!(values(&curves, "jawOpen"), [Some(0.0), Some(0.6)], "{text}");
        assert_eq!(curves.track_curves().len(), 2, "{text}");
        assert_eq!(
            curves.curve_times().frame_time_instant(1).instant_micros(),
            40_000,
            "{text}"
        );
        assert!(findings.is_empty(), "{findings:?}");
    }
    let short = r#"{"names":["jawOpen","browInnerUp"],"weights":[[0,0.5],[1]]}"#;
    let error = read_curves(short.as_bytes()).expect_err("a short row");
    assert!(
        error.to_string().contains("frame 1 has 1 weights for 2 names"),
        "{error}"
    );
}
