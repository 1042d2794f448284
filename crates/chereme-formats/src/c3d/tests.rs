//! Tests of reading and writing C3D: all layouts of numbers, events, damaged files, and other people's files.

use super::*;

/// A small file: two points, one channel of two samples, three frames at 50 a second.
fn file(kind: u8, is_real: bool) -> Vec<u8> {
    file_with(kind, is_real, ["LSHO", "RSHO", "MORE"], &[])
}

/// The small file with other labels and more parameters: the number of their group, 0 for a new one, name and body.
fn file_with(kind: u8, is_real: bool, labels: [&str; 3], more: &[(i8, &str, Vec<u8>)]) -> Vec<u8> {
    let u16s = |value: u16| {
        if kind == 86 {
            value.to_be_bytes()
        } else {
            value.to_le_bytes()
        }
    };
    let f32s = |value: f32| match kind {
        86 => value.to_be_bytes(),
        85 => {
            let [a, b, c, d] = (value * 4.0).to_le_bytes();
            [c, d, a, b]
        }
        _ => value.to_le_bytes(),
    };
    let scale = if is_real { -0.5 } else { 0.5 };
    let mut header = vec![0; 512];
    let put = |header: &mut Vec<u8>, word: usize, bytes: &[u8]| {
        header[2 * (word - 1)..2 * (word - 1) + bytes.len()].copy_from_slice(bytes);
    };
    header[0] = 2;
    header[1] = 0x50;
    for (word, value) in [(2, 2), (3, 2), (4, 1), (5, 3), (9, 3), (10, 2), (150, 12345), (151, 1)] {
        put(&mut header, word, &u16s(value));
    }
    put(&mut header, 7, &f32s(scale));
    put(&mut header, 11, &f32s(50.0));
    put(&mut header, 153, &f32s(0.02));
    put(&mut header, 199, b"CLAP");
    let mut section = vec![1, 0x50, 1, kind];
    let mut add = |id: i8, name: &str, body: &[u8]| {
        section.push(name.len() as u8);
        section.push(id as u8);
        section.extend(name.bytes());
        section.extend(u16s(2 + body.len() as u16));
        section.extend(body);
    };
    add(-1, "POINT", &[0]);
    add(-2, "ANALOG", &[0]);
    let texts = |texts: &[&str]| {
        let mut body = vec![0xff, 2, 4, texts.len() as u8];
        body.extend(texts.iter().flat_map(|text| format!("{text:<4}").into_bytes()));
        body.push(0);
        body
    };
    add(1, "LABELS", &texts(&labels));
    add(1, "UNITS", &[0xff, 1, 2, b'm', b'm', 0]);
    add(2, "LABELS", &texts(&["Fz"]));
    let real = |value: f32| [&[4, 1, 1][..], &f32s(value), &[0]].concat();
    add(2, "SCALE", &real(0.25));
    add(2, "GEN_SCALE", &real(2.0));
    add(2, "OFFSET", &[&[2, 1, 1][..], &u16s(4), &[0]].concat());
    for (group, name, body) in more {
        add(*group, name, body);
    }
    section.resize(512, 0);
    let mut bytes = [header, section].concat();
    let number = |bytes: &mut Vec<u8>, value: i16| {
        if is_real {
            bytes.extend(f32s(f32::from(value)));
        } else {
            bytes.extend(u16s(value as u16));
        }
    };
    for frame in 0..3i16 {
        for value in [1000 + frame, 0, 2800, 0x0203] {
            number(&mut bytes, value);
        }
        let seen = if frame == 1 { -1 } else { 0 };
        for value in [-1000, 0, 2800, seen] {
            number(&mut bytes, value);
        }
        for sample in 0..2 {
            number(&mut bytes, 4 + 2 * frame + sample);
        }
    }
    bytes
}

fn both(bytes: &[u8]) -> (MarkerTrack, CurveTrack) {
    let (tracks, _) = read_c3d(bytes).unwrap_or_else(|error| panic!("{error}"));
    match &tracks.tracks[..] {
        [
            FileTrack {
                content: CapturedTrackContent::Markers(markers),
                ..
            },
            FileTrack {
                content: CapturedTrackContent::Curves(curves),
                ..
            },
        ] => (markers.clone(), curves.clone()),
        other => panic!("markers and analog, not {other:?}"),
    }
}

#[test]
fn six_byte_layouts_read_to_equal_data() {
    for kind in [84, 85, 86] {
        for is_real in [false, true] {
            let (markers, analog) = both(&file(kind, is_real));
            let [left, right] = markers.marker_points() else {
                panic!("two points");
            };
            assert_eq!((left.name.as_str(), right.name.as_str()), ("LSHO", "RSHO"));
            let scale = if is_real { 1.0 } else { 0.5 };
            assert_eq!(left.marker_position(2).map(|at| at.x), Some(1002.0 * scale));
            let residual = left.quality.as_ref().and_then(|column| column.column_value_at(0));
            assert_eq!(residual, Some(1.5), "the low byte times the scale");
            assert_eq!(right.marker_position(1), None, "no camera saw it");
            assert_eq!(
                right.quality.as_ref().and_then(|column| column.column_value_at(1)),
                None
            );
            assert_eq!(analog.track_curves()[0].name, "Fz");
            let values: Vec<f64> = analog.track_curves()[0].values.column_values().flatten().collect();
            assert_eq!(values, [0.0, 0.5, 1.0, 1.5, 2.0, 2.5]);
            assert_eq!(
                analog.curve_times().even_times_rate().map(|rate| rate.rate_numerator()),
                Some(100)
            );
            let up = markers.displayed_markers(0)[0].expect("a place");
            assert!(up.y > 1.0 && up.x > 0.0, "up is Z, and the left shoulder is left: {up}");
        }
    }
}

/// Returns the body of a parameter of texts, or of floats, of a file of Intel processors.
fn text(text: &str) -> Vec<u8> {
    [&[0xff, 1, text.len() as u8], text.as_bytes(), &[0]].concat()
}

fn reals(values: &[f32]) -> Vec<u8> {
    let bytes: Vec<u8> = values.iter().flat_map(|it| it.to_le_bytes()).collect();
    [&[4, 1, values.len() as u8], &bytes[..], &[0]].concat()
}

#[test]
fn all_frames_of_the_data_are_read_or_counted() {
    /// The last frame of the header, POINT:FRAMES, the frames of the data, and what is read and left out.
    type Case = (u16, Option<f32>, usize, usize, usize);
    let cases: [Case; 6] = [
        (3, None, 3, 3, 0),
        (3, None, 103, 3, 100),
        (3, Some(103.0), 103, 103, 0),
        (u16::MAX, None, 70_000, 70_000, 0),
        ((70_000 % 65_536) as u16, None, 70_000, 70_000, 0),
        (u16::MAX, Some(70_000.0), 70_000, 70_000, 0),
    ];
    for (last, named, held, frames, unread) in cases {
        let named: Vec<_> = named.iter().map(|it| (1, "FRAMES", reals(&[*it]))).collect();
        let mut bytes = file_with(84, false, ["LSHO", "RSHO", "MORE"], &named);
        bytes[8..10].copy_from_slice(&last.to_le_bytes());
        let frame = bytes[1024..1044].to_vec();
        bytes.truncate(1024);
        bytes.extend(frame.repeat(held));
        bytes.resize(bytes.len().next_multiple_of(512), 0);
        let document = c3d_raw::read_c3d_document(&bytes).expect("C3D");
        let found = (document.frames, document.unread_frames);
        assert_eq!(found, (frames, unread), "{last} {held}");
        let (_, findings) = read_c3d(&bytes).expect("C3D");
        let said = findings.iter().any(|it| it.message.contains("room for 100 more"));
        assert_eq!(said, unread > 0, "{findings:?}");
    }
}

#[test]
fn a_header_without_samples_a_frame_does_not_move_the_points() {
    let whole = file(84, true);
    let (expected, _) = both(&whole);
    let mut without = whole;
    without[18..20].fill(0);
    let (markers, analog) = both(&without);
    assert_eq!(markers, expected);
    assert_eq!(analog.track_curves().len(), 2);
}

#[test]
fn the_axis_that_is_up_is_that_of_head_and_feet_then_that_of_the_screen() {
    // The first point is at +X of the second.
    let body = ["LFHD", "LTOE", "MORE"];
    let hands = ["LSHO", "RSHO", "MORE"];
    let cases = [
        (hands, None, "+Z", "show which axis is up; +Z is taken"),
        (hands, Some("+Y"), "+Y", ""),
        (hands, Some("Y-"), "-Y", ""),
        (hands, Some("y"), "+Y", ""),
        (body, None, "+X", ""),
        (body, Some("X"), "+X", ""),
        (body, Some("+Z"), "+X", "Y_SCREEN says that +Z is up"),
    ];
    for (labels, screen, up, finding) in cases {
        let more: Vec<_> = screen.iter().map(|it| (1, "Y_SCREEN", text(it))).collect();
        let bytes = file_with(84, true, labels, &more);
        let (tracks, findings) = read_c3d(&bytes).expect("C3D");
        let CapturedTrackContent::Markers(markers) = &tracks.tracks[0].content else {
            panic!("markers");
        };
        let MarkerSpace::World(convention) = markers.marker_space() else {
            panic!("a room");
        };
        assert_eq!(convention.axes.up_direction().to_string(), up, "{labels:?} {screen:?}");
        let axis = |it: &&ImportFinding| it.message.contains(" up");
        let said: Vec<&str> = findings.iter().filter(axis).map(|it| it.message.as_str()).collect();
        assert_eq!(said.is_empty(), finding.is_empty(), "{said:?}");
        assert!(said.iter().all(|it| it.contains(finding)), "{said:?}");
    }
}

#[test]
fn continued_numbers_other_rates_and_outputs_with_a_subject_are_read() {
    let document = c3d_raw::read_c3d_document(&file_with(
        84,
        true,
        ["LSHO", "RSHO", "MORE"],
        &[(2, "SCALE2", reals(&[7.0, 8.0]))],
    ));
    let parameters = document.expect("C3D").parameters;
    assert_eq!(parameters.unsigned_parameter_numbers("ANALOG:SCALE"), [0.25, 7.0, 8.0]);
    let labels = ["LSHO", "A:LA", "MORE"];
    let more = [(1, "ANGLES", text("LA")), (1, "RATE", reals(&[100.0]))];
    let (tracks, findings) = read_c3d(&file_with(84, true, labels, &more)).expect("C3D");
    let names: Vec<&str> = tracks.tracks.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["markers", "model outputs", "analog"]);
    let text = "the header states 50 frames a second and POINT:RATE 100, which are taken";
    assert!(findings.iter().any(|it| it.message == text), "{findings:?}");
}

#[test]
fn events_are_moments_of_a_tier() {
    let (tracks, _) = read_c3d(&file(84, false)).expect("C3D");
    let tier = &tracks.events.expect("events").tiers[0];
    assert_eq!(tier.name, "events");
    assert_eq!(tier.annotations[0].value, "CLAP");
    assert_eq!(tier.annotations[0].span.span_start_instant().instant_micros(), 20_000);
}

#[test]
fn damaged_files_are_refused_or_read_up_to_the_damage() {
    let whole = file(84, false);
    assert_eq!(read_c3d(b""), Err(C3dError::NoC3d));
    assert_eq!(read_c3d(&whole[..600]), Err(C3dError::Short("data")));
    let (tracks, findings) = read_c3d(&whole[..whole.len() - 1]).expect("two frames");
    assert!(
        findings
            .iter()
            .any(|it| it.message.contains("promises 3 frames and holds 2"))
    );
    assert_eq!(tracks.tracks.len(), 2);
    for at in 0..whole.len() {
        let _ = read_c3d(&whole[..at]);
        for flip in [0xff, 0x80, 0x01] {
            let mut changed = whole.clone();
            changed[at] ^= flip;
            let _ = read_c3d(&changed);
        }
    }
}

#[test]
fn files_of_others_hold_the_known_values() {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return;
    };
    let (mut folders, mut files) = (vec![std::path::Path::new(&folder).join("motion/c3d")], Vec::new());
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                files.push(path);
            }
        }
    }
    assert_eq!(files.len(), 15);
    let sizes = [
        ("EB015PI", 450, 26),
        ("Eb015vi", 450, 26),
        ("Eb015pr", 450, 26),
        ("TESTDPI", 450, 26),
        ("pc_real", 89, 36),
        ("dec_int", 89, 36),
        ("02_01", 343, 41),
        ("walking2", 1249, 44),
        ("my-looped-motion", 900, 26),
    ];
    let values: [(&str, &str, usize, [f64; 3]); 4] = [
        ("02_01", "RELB", 100, [-806.7002, 286.8432, 1055.4526]),
        ("walking2", "C7", 600, [-107.4673, 538.7004, 1528.9711]),
        ("Eb015vi", "RFT3", 300, [231.0833, 1441.8334, 34.5833]),
        ("pc_real", "RTH1", 40, [440.3308, 977.9506, 677.3671]),
    ];
    let mut same = Vec::new();
    for path in files {
        let bytes = std::fs::read(&path).expect("a file");
        let (tracks, _) = read_c3d(&bytes).unwrap_or_else(|error| panic!("{path:?}: {error}"));
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let CapturedTrackContent::Markers(markers) = &tracks.tracks[0].content else {
            panic!("markers");
        };
        for (name, frames, points) in sizes {
            if stem == name {
                let outputs = match tracks.tracks.get(1) {
                    Some(FileTrack {
                        name,
                        content: CapturedTrackContent::Curves(curves),
                        ..
                    }) if name == "model outputs" => curves.track_curves().len() / 3,
                    _ => 0,
                };
                assert_eq!(
                    (markers.marker_frame_count(), markers.marker_points().len() + outputs),
                    (frames, points),
                    "{stem}"
                );
            }
        }
        for (name, label, frame, expected) in values {
            if stem == name {
                let point = markers
                    .marker_points()
                    .iter()
                    .find(|point| point.name == label)
                    .expect(label);
                let at = point.marker_position(frame).expect("a place").to_array();
                for (found, expected) in at.iter().zip(expected) {
                    assert!((found - expected).abs() < 1e-3, "{stem} {label}: {at:?}");
                }
            }
        }
        if stem == "02_01" {
            let first = markers
                .marker_points()
                .iter()
                .find(|point| point.name == "LBWT")
                .expect("LBWT");
            let residual = first
                .quality
                .as_ref()
                .and_then(|column| column.column_value_at(0))
                .expect("a residual");
            assert!((residual - 8.5).abs() < 1e-3, "{residual}");
        }
        if ["EB015PI", "Eb015vi", "Eb015pr"].contains(&stem.as_str()) {
            let point = &markers.marker_points()[3];
            let at = (0..450)
                .find_map(|frame| point.marker_position(frame))
                .expect("a place");
            same.push(at);
        }
    }
    for at in &same {
        assert!((*at - same[0]).length() < 0.1, "one capture in three layouts: {same:?}");
    }
}

#[test]
fn markers_read_back_unchanged_from_c3d() {
    let places = |shift: f32| -> Vec<FrameNumberColumn> {
        (0..3)
            .map(|axis| {
                FrameNumberColumn::from_single_floats(
                    (0..5).map(|frame| frame as f32 + shift + axis as f32 * 10.0).collect(),
                )
            })
            .collect()
    };
    let gaps = ColumnGaps::from_gap_frames([2u32]);
    let marker = |name: &str, group: &str, shift: f32| MotionMarker {
        group: group.into(),
        name: name.into(),
        place: places(shift)
            .into_iter()
            .map(|column| column.with_gaps(&gaps).expect("as long"))
            .collect(),
        quality: Some(
            FrameNumberColumn::from_double_floats(vec![0.5, 1.0, 0.0, 2.0, 4.0])
                .with_gaps(&gaps)
                .expect("as long"),
        ),
    };
    let many: Vec<MotionMarker> = (0..300).map(|n| marker(&format!("M{n}"), "", n as f32)).collect();
    let some = vec![marker("LFIN", "Anna", 7.5), marker("RFIN", "Anna", 0.25)];
    for (points, metres_per_unit) in [(some, 0.001), (many, 1.0)] {
        let space = MarkerSpace::World(SpaceConvention {
            metres_per_unit,
            axes: "+Z,+X".parse().expect("axes"),
        });
        let times = FrameTimes::Even(crate::tracks::rate_of(120.0).expect("a rate"));
        let markers = MarkerTrack::new(times, space, points)
            .expect("markers")
            .with_quality_meaning(QualityMeaning::Residual);
        let bytes = super::write_c3d(&markers, RecordingInstant::from_millis(500)).expect("written");
        let (tracks, _) = read_c3d(&bytes).expect("read");
        let CapturedTrackContent::Markers(again) = &tracks.tracks[0].content else {
            panic!("markers");
        };
        assert_eq!(
            (again.marker_frame_count(), again.marker_points().len()),
            (5, markers.marker_points().len())
        );
        assert_eq!(again.marker_space(), markers.marker_space());
        for (x, y) in markers.marker_points().iter().zip(again.marker_points()) {
            assert!(y.name.ends_with(&x.name), "{} {}", x.name, y.name);
            for frame in 0..5 {
                assert_eq!(x.marker_position(frame), y.marker_position(frame));
                let both = [x, y].map(|it| it.quality.as_ref().and_then(|it| it.column_value_at(frame)));
                if let [Some(a), Some(b)] = both {
                    assert!((a - b).abs() < 0.01, "{a} {b}");
                }
            }
        }
    }
}

#[test]
fn places_beyond_32_bits_are_refused_by_marker_and_frame() {
    for (place, residual, metres_per_unit, fits) in [
        (1.5, 0.5, 0.001, true),
        (1e8, 0.5, 0.001, true),
        (1e308, 0.5, 0.001, false),
        (-1e39, 0.5, 1.0, false),
        (1.5, 1e60, 0.001, false),
        // The numbers are written in millimetres.
        (1e6, 0.5, 7.0, false),
    ] {
        let column = |numbers: [f64; 3]| FrameNumberColumn::from_double_floats(numbers.to_vec());
        let marker = |name: &str, place: f64, residual: f64| MotionMarker {
            group: String::new(),
            name: name.into(),
            place: vec![column([0.0; 3]), column([0.0, place, 0.0]), column([0.0; 3])],
            quality: Some(column([0.0, residual, 0.0])),
        };
        let points = vec![marker("LFIN", 1.0, 0.5), marker("RFIN", place, residual)];
        let space = MarkerSpace::World(SpaceConvention {
            metres_per_unit,
            axes: "+Z,+X".parse().expect("axes"),
        });
        let times = FrameTimes::Even(crate::tracks::rate_of(120.0).expect("a rate"));
        let markers = MarkerTrack::new(times, space, points)
            .expect("markers")
            .with_quality_meaning(QualityMeaning::Residual);
        let written = super::write_c3d(&markers, RecordingInstant::RECORDING_START);
        let want = "marker \"RFIN\" is too far away to be written in frame 1";
        assert_eq!(written.err().as_deref(), (!fits).then_some(want), "{place} {residual}");
    }
}

#[test]
fn golden_points_and_numbers_of_c3d() {
    use crate::golden::{compare, put};
    use crate::tests::{bytes, findings, tracks};
    let mut out = String::new();
    for kind in [84, 85, 86] {
        for is_real in [false, true] {
            let plain = file(kind, is_real);
            // The label of the unit's parameter becomes that of a model's outputs.
            let at = memchr::memmem::find(&plain, b"UNITS").expect("units");
            let mut angles = plain.clone();
            angles[at..at + 5].copy_from_slice(b"POWER");
            // A second list of labels names one of the points as an output of a model.
            let label = memchr::memmem::find(&plain, b"LABELS").expect("labels") - 2;
            let mut list = plain[label..label + 27].to_vec();
            list[2..8].copy_from_slice(b"ANGLES");
            let first = memchr::memmem::find(&list, b"LSHO").expect("a label");
            list[first..first + 4].copy_from_slice(b"NONE");
            let mut modelled = plain.clone();
            modelled.drain(1024 - list.len()..1024);
            modelled.splice(label..label, list);
            for (name, file) in [("plain", plain), ("no unit", angles), ("a model's", modelled)] {
                put(&mut out, format!("## {name} {kind} {is_real}"));
                match read_c3d(&file) {
                    Ok((read, found)) => {
                        tracks(&mut out, &read);
                        findings(&mut out, &found);
                        if let (CapturedTrackContent::Markers(markers), true) = (&read.tracks[0].content, kind == 84) {
                            let written = write_c3d(markers, RecordingInstant::from_millis(40));
                            match written {
                                Ok(written) => bytes(&mut out, &written),
                                Err(error) => put(&mut out, error),
                            }
                        }
                    }
                    Err(error) => put(&mut out, format!("refused: {error}")),
                }
            }
        }
    }
    compare("c3d", &out);
}
