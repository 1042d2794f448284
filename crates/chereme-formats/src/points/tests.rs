//! Tests of tables of points: the programs that write them, spellings of titles, times, gaps, and damaged files.

mod kinds;
mod programs;
mod truth;

use chereme_motion::MarkerSpace;

use super::*;
use crate::tracks::CapturedTracks;

/// Returns a table as read, with its findings.
fn table(text: &str) -> (CapturedTracks, Vec<ImportFinding>) {
    read_point_table(text.as_bytes(), None).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Returns the markers of a table, with its findings.
fn markers(text: &str) -> (MarkerTrack, Vec<ImportFinding>) {
    let (tracks, findings) = table(text);
    let CapturedTrackContent::Markers(markers) = tracks.tracks[0].content.clone() else {
        panic!("markers");
    };
    (markers, findings)
}

/// Returns the groups and names of points.
fn labels(markers: &MarkerTrack) -> Vec<(&str, &str)> {
    let points = markers.marker_points().iter();
    points.map(|it| (it.group.as_str(), it.name.as_str())).collect()
}

fn refused(text: &str) -> String {
    match read_point_table(text.as_bytes(), None) {
        Ok((tracks, _)) => panic!("{tracks:?}"),
        Err(error) => error.to_string(),
    }
}

fn holds(findings: &[ImportFinding], text: &str) -> bool {
    findings.iter().any(|it| it.message.contains(text))
}

/// Two points in two frames; the second point is not seen in the second one.
const PLAIN: &str = "time,wrist_x,wrist_y,wrist_z,elbow_x,elbow_y,elbow_z\n\
0.00,0.10,1.2,0.3,0.4,1.10,0.5\n0.01,0.11,1.25,3e-1,,,\n";

#[test]
fn spellings_of_titles_read_to_equal_points() {
    let (expected, findings) = markers(PLAIN);
    assert_eq!(labels(&expected), [("", "wrist"), ("", "elbow")]);
    assert_eq!(
        expected.marker_points()[0].place[0].column_text_at(0).as_deref(),
        Some("0.10")
    );
    assert_eq!(expected.marker_points()[1].marker_position(1), None);
    assert_eq!(
        expected.marker_times().even_times_rate().map(|it| it.rate_numerator()),
        Some(100)
    );
    assert!(holds(&findings, "so metres are assumed"), "{findings:?}");
    let titles = |spelling: &dyn Fn(&str, &str) -> String| {
        let mut head = "time".to_owned();
        for name in ["wrist", "elbow"] {
            for axis in ["x", "y", "z"] {
                head += &format!(",{}", spelling(name, axis));
            }
        }
        PLAIN.replace(PLAIN.lines().next().unwrap_or_default(), &head)
    };
    let dialects = [
        ("a point", titles(&|name, axis| format!("{name}.{axis}"))),
        (
            "capitals",
            titles(&|name, axis| format!("{name}.{}", axis.to_uppercase())),
        ),
        (
            "before",
            titles(&|name, axis| format!("{}_{name}", axis.to_uppercase())),
        ),
        ("a blank", titles(&|name, axis| format!("\"{name} {axis}\""))),
        ("a colon", titles(&|name, axis| format!("{name}:{axis}"))),
        ("joined", titles(&|name, axis| format!("{name}{}", axis.to_uppercase()))),
        ("a word more", titles(&|name, axis| format!("{name}_position_{axis}"))),
        ("the unit", titles(&|name, axis| format!("{name}_{axis} [m]"))),
        ("the unit behind", titles(&|name, axis| format!("{name}_{axis}_m"))),
        ("semicolons and commas", PLAIN.replace(',', ";").replace('.', ",")),
        ("tabs", PLAIN.replace(',', "\t")),
        ("Windows", format!("\u{feff}{}", PLAIN.replace('\n', "\r\n"))),
        ("Macintosh", PLAIN.replace('\n', "\r")),
        ("a line of Excel", format!("sep=,\n{PLAIN}")),
        ("comments", format!("# made by hand\n\n{PLAIN}")),
        ("words for gaps", PLAIN.replace(",,,", ",NaN,nan,NULL")),
        ("a short row", PLAIN.replace(",,,", "")),
        (
            "long rows of nothing",
            PLAIN.replace(",0.5\n", ",0.5,,,\n").replace(",,,\n", ",,,,,,\n"),
        ),
        (
            "milliseconds",
            PLAIN.replace("time,", "time_ms,").replace("0.01,0.11", "10,0.11"),
        ),
    ];
    for (name, text) in dialects {
        assert_eq!(
            PointFile::detect_point_file(text.as_bytes()),
            Some(PointFile::Plain),
            "{name}"
        );
        let (found, findings) = markers(&text);
        assert_eq!(found, expected, "{name}: {findings:?}\n{text}");
    }
    let wide: Vec<u8> = PLAIN.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let wide = [b"\xff\xfe".to_vec(), wide].concat();
    assert_eq!(PointFile::detect_point_file(&wide), Some(PointFile::Plain));
    let (tracks, _) = read_point_table(&wide, None).expect("read");
    assert_eq!(tracks.tracks[0].content, CapturedTrackContent::Markers(expected));
}

#[test]
fn landmarks_by_number_and_their_visibility_are_shares_of_a_picture() {
    let text = "x0,y0,z0,v0,x1,y1,z1,v1\n0.5,0.25,-0.1,0.9,0.6,0.3,0,1\n0.5,0.26,-0.1,0.8,0.6,0.3,0,1\n";
    let (found, findings) = markers(text);
    assert_eq!(labels(&found), [("", "0"), ("", "1")]);
    assert_eq!(found.marker_space().marker_space_name(), "image-2.5d");
    assert_eq!(found.marker_capture(), CaptureMethod::Estimated);
    assert_eq!(found.marker_quality(), Some(QualityMeaning::Confidence));
    let quality = found.marker_points()[0]
        .quality
        .as_ref()
        .map(|it| it.column_value_at(1));
    assert_eq!(quality, Some(Some(0.8)));
    assert_eq!(
        found.marker_times().even_times_rate().map(|it| it.rate_numerator()),
        Some(25)
    );
    assert!(holds(&findings, "neither a rate nor times; 25 frames"), "{findings:?}");
    let rate = FrameRate::new(50, 1).expect("a rate");
    let (tracks, findings) = read_point_table(text.as_bytes(), Some(rate)).expect("read");
    let CapturedTrackContent::Markers(found) = &tracks.tracks[0].content else {
        panic!("markers");
    };
    assert_eq!(found.marker_times().even_times_rate(), Some(rate));
    assert!(!holds(&findings, "25 frames"), "{findings:?}");
}

#[test]
fn points_on_a_picture_have_two_coordinates_and_are_gaps_where_nothing_was_seen() {
    let text = "frame,nose_x,nose_y,nose_c,eye_x,eye_y,eye_c\n0,320,240.5,0.9,0,0,0\n1,321,240,0.9,310,230,0.5\n";
    let (found, findings) = markers(text);
    assert_eq!(found.marker_space().marker_space_name(), "image-2d");
    assert_eq!(found.marker_points()[1].marker_position(0), None);
    assert!(holds(&findings, "points reach 321 by 241 pixels"), "{findings:?}");
}

#[test]
fn other_columns_of_numbers_become_curves_and_text_is_named() {
    let text = "fnum,p_x,p_y,p_z,p_error,p_ncams,p_score,take\n0,1.5,2,3,0.7,3,0.9,a\n1,1.6,2,3,0.8,2,0.9,a\n";
    let (tracks, findings) = table(text);
    let CapturedTrackContent::Curves(curves) = &tracks.tracks[1].content else {
        panic!("curves");
    };
    let names: Vec<&str> = curves.track_curves().iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["p_error", "p_ncams"]);
    assert!(holds(&findings, "columns of text are left out: take"), "{findings:?}");
}

#[test]
fn units_follow_from_titles_else_from_the_extent() {
    let scaled = |scale: f64| {
        let rows = (0..3).map(|row| {
            let at = [0.1, 1.6, 0.2, -0.4, 0.1 + 0.01 * f64::from(row), 0.3].map(|it| (it * scale).to_string());
            format!("{row},{}\n", at.join(","))
        });
        format!(
            "frame,head_x,head_y,head_z,toe_x,toe_y,toe_z\n{}",
            rows.collect::<String>()
        )
    };
    for (scale, metres) in [(1.0, 1.0), (100.0, 0.01), (1000.0, 0.001)] {
        let (found, findings) = markers(&scaled(scale));
        let MarkerSpace::World(convention) = found.marker_space() else {
            panic!("a room");
        };
        assert_eq!(convention.metres_per_unit, metres, "{findings:?}");
        assert!(holds(&findings, "the table states no unit"), "{findings:?}");
    }
    let text = scaled(1000.0).replace("_x", "_x (mm)");
    let (_, findings) = markers(&text);
    assert!(!holds(&findings, "the table states no unit"), "{findings:?}");
}

#[test]
fn times_are_those_of_the_rows() {
    let rows = |title: &str, times: &[&str]| {
        let rows: Vec<String> = times.iter().map(|time| format!("{time},1,2,3\n")).collect();
        format!("{title},a_x,a_y,a_z\n{}", rows.concat())
    };
    let rate = |text: &str| {
        markers(text)
            .0
            .marker_times()
            .even_times_rate()
            .map(|it| it.per_second())
    };
    assert_eq!(rate(&rows("time", &["0", "0.0083", "0.0167", "0.025"])), Some(120.0));
    assert_eq!(rate(&rows("timestamp", &["0", "40", "80"])), Some(25.0));
    assert_eq!(rate(&rows("frame [50 fps]", &["7", "8", "9"])), Some(50.0));
    assert_eq!(rate(&rows("time", &["0", "0.04", "0.1", "0.11"])), None);
    let (tracks, findings) = table(&rows("time", &["1760000000.00", "1760000000.02", "1760000000.04"]));
    assert_eq!(tracks.tracks[0].offset, RecordingInstant::RECORDING_START);
    assert!(
        holds(&findings, "its first frame has the time 1760000000.000 s"),
        "{findings:?}"
    );
    let late = table(&rows("time", &["2.00", "2.02", "2.04"])).0;
    assert_eq!(late.tracks[0].offset, RecordingInstant::from_seconds(2.0));
    let (found, findings) = markers(&rows("frame", &["1", "2", "14"]));
    assert_eq!(
        found.marker_times().frame_time_instant(2),
        RecordingInstant::from_seconds(13.0 / 25.0)
    );
    assert!(holds(&findings, "frames are missing"), "{findings:?}");
    let (_, findings) = markers(&rows("time", &["0", "", "0.02"]));
    assert!(holds(&findings, "some rows have no time"), "{findings:?}");
    let message = refused(&rows("time", &["0", "0.5", "0.4", "0.9"]));
    assert!(message.starts_with("line 4: its time is not after"), "{message}");
}

#[test]
fn repeated_names_and_cut_rows_are_reported() {
    let text = PLAIN.replace("elbow", "wrist");
    let (found, findings) = markers(&text);
    assert_eq!(labels(&found), [("", "wrist"), ("", "wrist (2)")]);
    assert!(holds(&findings, "the label \"wrist\" occurs again"), "{findings:?}");
    let cut = PLAIN.trim_end().trim_end_matches(',');
    let (found, findings) = markers(cut);
    assert_eq!(found.marker_points()[1].marker_position(1), None);
    assert!(holds(&findings, "may be cut short"), "{findings:?}");
}

#[test]
fn damaged_tables_are_refused_with_the_line() {
    for (text, part) in [
        (PLAIN.replace("1.25", "high"), "line 3: \"high\" is no number"),
        (PLAIN.replace("1.25", "1e999"), "line 3: \"1e999\" is no number"),
        (
            PLAIN.replace("1.25", "1,25"),
            "line 3: the row has 8 cells, and the header has 7",
        ),
        (
            PLAIN.lines().next().unwrap_or_default().to_owned(),
            "the file holds no points",
        ),
        (
            "frame,landmark,x,y,z\n0,NOSE,1,2,3\n0,EYE,1,2,3\n".to_owned(),
            "the column \"landmark\" names",
        ),
        (
            format!("time,a_x,a_y{}\n", ",b_x,b_y".repeat(60_000)),
            "more than 100000 columns",
        ),
    ] {
        let message = refused(&text);
        assert!(message.contains(part), "{message}");
    }
    let head = format!("time{}\n", ",p_x,p_y,p_z".repeat(20_000));
    let message = refused(&(head + &"1\n2\n3\n".repeat(50)));
    assert!(message.contains("the rows up to here lack"), "{message}");
    let text = [PLAIN.as_bytes(), b"\x00\x01"].concat();
    assert_eq!(read_point_table(&text, None), Err(PointTableError::NotText { line: 4 }));
}

#[test]
fn no_bytes_panic() {
    let whole = [
        PLAIN,
        programs::MOTIVE,
        programs::VICON,
        programs::QUALISYS,
        programs::DEEP_LAB_CUT,
    ];
    let mut seed = 1_u64;
    let mut next = move || {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize
    };
    let odd = b",;\t\n\r\"x0.-:_[]\xff\x80N";
    for text in whole {
        for round in 0..1500 {
            let mut bytes = text.as_bytes().to_vec();
            for _ in 0..=round % 5 {
                let at = next() % bytes.len();
                match next() % 3 {
                    0 => bytes[at] = odd[next() % odd.len()],
                    1 => bytes.truncate(at.max(1)),
                    _ => bytes.insert(at, odd[next() % odd.len()]),
                }
            }
            let _ = PointFile::detect_point_file(&bytes);
            let _ = read_point_table(&bytes, None);
        }
    }
}
