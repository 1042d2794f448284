//! Tests of reading and writing TRC: dialects, gaps, wrong counts, damaged files, and other people's files.

use super::*;

const PLAIN: &str = "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n\
100\t100\t2\t2\tmm\t100\t1\t2\nFrame#\tTime\tLSHO\t\t\tRSHO\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n\
1\t0.000000\t1.50\t-2\t3e2\t4\t5\t6\n2\t0.010000\t1.6\t\t3\t4\t5\t6\n";

fn markers(text: &str) -> (MarkerTrack, Vec<ImportFinding>) {
    let (tracks, findings) = read_trc_file(text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let CapturedTrackContent::Markers(markers) = tracks.tracks[0].content.clone() else {
        panic!("markers");
    };
    (markers, findings)
}

#[test]
fn the_plain_form_is_read_with_its_exact_numbers_and_gaps() {
    let (markers, findings) = markers(PLAIN);
    assert_eq!(findings.len(), 1, "no feet show which axis is up: {findings:?}");
    let left = &markers.marker_points()[0];
    assert_eq!(left.name, "LSHO");
    assert_eq!(left.place[0].column_text_at(0).as_deref(), Some("1.50"));
    assert_eq!(left.marker_position(1), None, "an empty cell is a gap");
    assert_eq!(markers.marker_points()[1].marker_position(1).map(|at| at.z), Some(6.0));
    assert_eq!(
        markers
            .marker_times()
            .even_times_rate()
            .map(|rate| rate.rate_numerator()),
        Some(100)
    );
}

#[test]
fn dialects_read_to_equal_data() {
    let shifted = PLAIN
        .replace("Frame#\tTime\tLSHO", "Frame#\tTime\t\tLSHO")
        .replace("\t\tX1", "\t\t\tX1");
    let no_axes = PLAIN.replace("\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n", "");
    let windows = PLAIN.replace('\n', "\r\n");
    let padded = PLAIN
        .replace("PathFileType\t4", "PathFileType  4\t")
        .replace("6\n", "6\t\n");
    let spelled = PLAIN.replace("1.6\t\t3", "1.6\t       NaN\t3");
    let tabs = PLAIN.replace("Z2\n\n", "Z2\n\t\t\t\t\n");
    let (expected, _) = markers(PLAIN);
    for dialect in [shifted, no_axes, windows, padded, spelled, tabs] {
        assert_eq!(markers(&dialect).0, expected, "{dialect}");
    }
}

#[test]
fn labels_and_rows_of_other_programs_read_to_equal_places() {
    let (expected, _) = markers(PLAIN);
    let timed = |title: &str| PLAIN.replace("\tTime\t", &format!("\t{title}\t"));
    let labelled = |line: &str| PLAIN.replace("Frame#\tTime\tLSHO\t\t\tRSHO\t\t", line);
    let columnless = PLAIN
        .replace("\tTime\t", "\t")
        .replace("\t\tX1", "\tX1")
        .replace("\t0.000000", "")
        .replace("\t0.010000", "");
    let dialects = [
        ("a unit of times", timed("Time (s)")),
        ("a unit of times in brackets", timed("time[s]")),
        (
            "a label for each coordinate",
            labelled("Frame#\tTime\tLSHO\tLSHO\tLSHO\tRSHO\tRSHO\tRSHO"),
        ),
        (
            "labels with the coordinate",
            labelled("Frame#\tTime\tLSHO.X\tLSHO.Y\tLSHO.Z\tRSHO_x\tRSHO_y\tRSHO_z"),
        ),
        ("no times", columnless),
        ("ends of lines of the Macintosh", PLAIN.replace('\n', "\r")),
        ("a blank line above", format!("\n\n{PLAIN}")),
        (
            "blanks instead of tabs",
            PLAIN.replace("1.6\t\t3", "1.6\tnan\t3").replace('\t', " "),
        ),
        ("decimal commas", PLAIN.replace('.', ",").replace("a,trc", "a.trc")),
        ("another word for a gap", PLAIN.replace("1.6\t\t3", "1.6\t-1.#IND\t3")),
        (
            "a header without the number of frames",
            PLAIN.replace("100\t100\t2\t2\tmm", "100\t100\t\t2\tmm"),
        ),
    ];
    for (name, dialect) in dialects {
        let (found, findings) = markers(&dialect);
        assert_eq!(found, expected, "{name}: {findings:?}\n{dialect}");
    }
}

#[test]
fn a_marker_without_a_label_keeps_its_place_among_the_others() {
    for (from, to, names) in [
        ("LSHO\t\t\tRSHO", "\t\t\tRSHO", ["marker 1", "RSHO"]),
        ("LSHO\t\t\tRSHO", "LSHO\t\t\t", ["LSHO", "marker 2"]),
    ] {
        let text = PLAIN.replace(from, to);
        let (found, findings) = markers(&text);
        let given: Vec<&str> = found.marker_points().iter().map(|it| it.name.as_str()).collect();
        assert_eq!(given, names);
        assert!(findings[0].message.contains("a marker has no label"), "{findings:?}");
    }
    let middle = PLAIN
        .replace("RSHO", "\t\t\tRSHO")
        .replace("\tZ2\n", "\tZ2\tX3\tY3\tZ3\n")
        .replace("\t2\tmm", "\t3\tmm")
        .replace("4\t5\t6\n", "7\t8\t9\t4\t5\t6\n");
    let (found, _) = markers(&middle);
    let given: Vec<&str> = found.marker_points().iter().map(|it| it.name.as_str()).collect();
    assert_eq!(given, ["LSHO", "marker 2", "RSHO"]);
    assert_eq!(found.marker_points()[2].marker_position(1).map(|at| at.z), Some(6.0));
}

#[test]
fn labels_that_the_rows_do_not_hold_are_refused() {
    let text = PLAIN.replace("LSHO\t", "Trial\t\t\tLSHO\t");
    let error = read_trc_file(text.as_bytes())
        .expect_err("a label too many")
        .to_string();
    assert!(error.contains("3 markers need 11"), "{error}");
}

#[test]
fn times_with_few_decimals_or_in_milliseconds_or_missing_show_the_rate() {
    let rows = |times: &[&str], frames: &[u32]| {
        let head = PLAIN.split("1\t0.000000").next().unwrap_or_default();
        let head = head.replace("\n100\t", "\n120\t");
        let rows = times.iter().zip(frames);
        let rows = rows.map(|(time, frame)| format!("{frame}\t{time}\t1\t2\t3\t4\t5\t6\n"));
        head + &rows.collect::<String>()
    };
    /// A name, times and numbers of frames, the rate and a finding.
    type Case = (
        &'static str,
        &'static [&'static str],
        &'static [u32],
        Option<u32>,
        &'static str,
    );
    let cases: [Case; 4] = [
        (
            "few decimals",
            &["0.00", "0.01", "0.02", "0.02", "0.03", "0.04"],
            &[1, 2, 3, 4, 5, 6],
            Some(120),
            "",
        ),
        (
            "milliseconds",
            &["0", "8.3", "16.7", "25"],
            &[1, 2, 3, 4],
            Some(120),
            "the times are milliseconds",
        ),
        (
            "no times",
            &["", "", ""],
            &[1, 2, 3],
            Some(120),
            "frames are taken to be even",
        ),
        (
            "no times and frames left out",
            &["", "", ""],
            &[1, 2, 14],
            None,
            "the numbers of the frames",
        ),
    ];
    for (name, times, frames, rate, finding) in cases {
        let (found, findings) = markers(&rows(times, frames));
        assert_eq!(
            found.marker_times().even_times_rate().map(|it| it.rate_numerator()),
            rate,
            "{name}"
        );
        assert!(
            finding.is_empty() || findings.iter().any(|it| it.message.contains(finding)),
            "{name}: {findings:?}"
        );
        if rate.is_none() {
            let last = found.marker_times().frame_time_instant(2).instant_seconds();
            assert!((last - 13.0 / 120.0).abs() < 1e-5, "{last}");
        }
    }
}

#[test]
fn units_are_known_by_their_words_and_a_row_that_is_cut_is_reported() {
    for (unit, metres) in [
        ("centimeters", 0.01),
        ("(cm)", 0.01),
        ("Inches", 0.0254),
        ("Metre", 1.0),
        ("ft", 0.3048),
        ("millimeters", 0.001),
    ] {
        let (found, _) = markers(&PLAIN.replace("mm", unit));
        let MarkerSpace::World(convention) = found.marker_space() else {
            panic!("a room");
        };
        assert_eq!(convention.metres_per_unit, metres, "{unit}");
        let text = write_trc_file("a.trc", &found, RecordingInstant::RECORDING_START).expect("TRC");
        assert_eq!(markers(&text).0.marker_space(), found.marker_space(), "{unit}");
    }
    for (cut, is_reported) in [(1, false), (3, true)] {
        let (_, findings) = markers(&PLAIN[..PLAIN.len() - cut]);
        let found = findings.iter().any(|it| it.message.contains("may be cut short"));
        assert_eq!(found, is_reported, "{findings:?}");
    }
}

#[test]
fn places_at_nought_are_gaps_of_markers_that_are_elsewhere_else() {
    /// Places of LSHO and of RSHO, the gaps that they become, and the warnings.
    type Case = (
        [&'static str; 3],
        [&'static str; 3],
        [usize; 2],
        &'static [&'static str],
    );
    let cases: [Case; 6] = [
        (
            ["70 1620 70", "0.0000 0.0000 0.0000", "70 1621 70"],
            ["-70 1620 70", "-70 1620 71", "-70 1620 72"],
            [1, 0],
            &["1 places of 1 markers are exactly 0 0 0 and become gaps"],
        ),
        (
            ["0 0 0", "0 -0 0", "70 1621 70"],
            ["-70 1620 70", "-70 1620 71", "0 0 0"],
            [2, 1],
            &["3 places of 2 markers are exactly 0 0 0 and become gaps"],
        ),
        (
            ["0 0 0", "0 0 0", "0 0 0"],
            ["-70 1620 70", "-70 1620 71", "-70 1620 71"],
            [3, 0],
            &["3 places of 1 markers are exactly 0 0 0 and become gaps"],
        ),
        (
            ["70 1620 70", "0 0 5", "70 1621 70"],
            ["-70 0 0", "-70 1620 71", "0 1620 0"],
            [0, 0],
            &[],
        ),
        (
            ["0 0 0", "1 0 0", "200 0 0"],
            ["-70 1620 70", "-70 1620 71", "-70 1620 72"],
            [0, 0],
            &["1 places are exactly 0 0 0 though the file calls them seen"],
        ),
        (
            ["0 0 0", "0 0 0", "0 0 0"],
            ["0 0 0", "0 0 0", "0 0 0"],
            [0, 0],
            &["6 places are exactly 0 0 0 though the file calls them seen"],
        ),
    ];
    for (left, right, gaps, warnings) in cases {
        let mut text = PLAIN.split("1\t0.000000").next().unwrap_or(PLAIN).to_owned();
        for (frame, (a, b)) in left.iter().zip(right).enumerate() {
            let cells = format!("{a} {b}").replace(' ', "\t");
            text += &format!("{}\t{}\t{cells}\n", frame + 1, frame as f64 / 100.0);
        }
        let (markers, findings) = markers(&text);
        let found = [0, 1].map(|point| {
            let point = &markers.marker_points()[point];
            (0..3).filter(|frame| point.marker_position(*frame).is_none()).count()
        });
        assert_eq!(found, gaps, "{left:?} {right:?}");
        let noughts = findings.iter().filter(|it| it.message.contains("0 0 0"));
        let noughts: Vec<&str> = noughts.map(|it| it.message.as_str()).collect();
        assert_eq!(noughts.len(), warnings.len(), "{noughts:?}");
        for (found, expected) in noughts.iter().zip(warnings) {
            assert!(found.starts_with(expected), "{found}");
        }
    }
}

#[test]
fn wrong_counts_and_uneven_times_are_reported() {
    let (_, findings) = markers(&PLAIN.replace("\t2\t2\tmm", "\t9\t2\tmm"));
    assert_eq!(findings[0].message, "NumFrames says 9, and the file holds 2");
    let (uneven, findings) = markers(&PLAIN.replace("0.010000", "0.5"));
    assert_eq!(uneven.marker_times().frame_time_instant(1).instant_seconds(), 0.5);
    assert!(findings[0].message.contains("do not follow DataRate"));
}

#[test]
fn without_a_rate_in_the_header_the_times_decide() {
    let (first, _) = markers(PLAIN);
    for other in ["0", "fast", "-5"] {
        let text = PLAIN.replacen("\n100\t", &format!("\n{other}\t"), 1);
        let (again, findings) = markers(&text);
        assert_eq!(again.marker_times(), first.marker_times(), "{other}");
        assert_eq!(findings[0].line, Some(3));
        let timeless = text.replace("0.010000", "").replace("0.000000", "");
        let error = read_trc_file(timeless.as_bytes()).expect_err("no rate").to_string();
        assert!(error.starts_with("line 3: DataRate is"), "{error}");
    }
}

#[test]
fn damaged_files_are_refused_with_the_line() {
    let cases = [
        (String::new(), "no TRC file"),
        ("PathFileType\t4\n".to_owned(), "missing"),
        (PLAIN.replace("LSHO\t\t\tRSHO", ""), "no markers"),
        (
            PLAIN.replace("3\t4\t5\t6\n", "3\t4\t5\t6\t7\n"),
            "line 8: the row has 9 cells",
        ),
        (PLAIN.replace("1.50", "x"), "line 7: \"x\" is no number"),
        (PLAIN.replace("1.50", "inf"), "no number"),
    ];
    for (text, expected) in cases {
        let error = read_trc_file(text.as_bytes()).expect_err(expected).to_string();
        assert!(error.contains(expected), "{error}");
    }
    for end in 0..PLAIN.len() {
        let _ = read_trc_file(&PLAIN.as_bytes()[..end]);
    }
}

#[test]
fn markers_read_back_unchanged() {
    let (expected, _) = markers(PLAIN);
    let text = write_trc_file("a.trc", &expected, RecordingInstant::RECORDING_START).expect("TRC");
    assert_eq!(markers(&text).0, expected);
    let mut lines = text.lines();
    assert_eq!(lines.nth(5), Some(""));
    assert_eq!(lines.nth(1), Some("2\t0.010000\t1.60\t\t3\t4\t5\t6"));
}

#[test]
fn frames_without_an_even_rate_read_back_with_their_times() {
    let rows = (2..9).fold(String::new(), |rows, frame| {
        let time = f64::from(frame * frame) / 100.0;
        rows + &format!("{}\t{time:.7}\t1\t2\t3\t4\t5\t6\n", frame + 1)
    });
    let (expected, _) = markers(&(PLAIN.replace("\t2\t2\tmm", "\t9\t2\tmm") + &rows));
    assert_eq!(expected.marker_times().even_times_rate(), None, "uneven");
    let text = write_trc_file("a.trc", &expected, RecordingInstant::RECORDING_START).expect("TRC");
    let (again, _) = markers(&text);
    let times = |it: &MarkerTrack| {
        (0..9)
            .map(|frame| it.marker_times().frame_time_instant(frame))
            .collect::<Vec<_>>()
    };
    assert_eq!(times(&again), times(&expected));
    assert_eq!(again.marker_points(), expected.marker_points());
}

#[test]
fn files_of_others_are_read_whole() {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return;
    };
    let folder = std::path::Path::new(&folder).join("motion/trc");
    let expected = [
        ("dataWithBlanks", 40, 464),
        ("dataWithEformat", 14, 5),
        ("init100", 22, 120),
        ("subject01_static", 49, 300),
        ("markers_walk", 41, 238),
    ];
    let (mut folders, mut seen) = (vec![folder], 0);
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let bytes = std::fs::read(&path).expect("a file");
            let (tracks, _) = read_trc_file(&bytes).unwrap_or_else(|error| panic!("{path:?}: {error}"));
            let CapturedTrackContent::Markers(markers) = &tracks.tracks[0].content else {
                panic!("markers");
            };
            let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            for (name, points, frames) in expected {
                if stem == name {
                    assert_eq!(
                        (markers.marker_points().len(), markers.marker_frame_count()),
                        (points, frames),
                        "{stem}"
                    );
                }
            }
            if stem == "init100" {
                let first = markers.marker_points()[0].marker_position(0).expect("a place");
                assert_eq!(first.to_array(), [273.71817, 56.52052, 1296.20374]);
            }
            seen += 1;
        }
    }
    assert_eq!(seen, 13);
}

#[test]
fn golden_points_of_trc() {
    use crate::golden::{compare, put};
    use crate::tests::{findings, tracks};
    let mut out = String::new();
    for (name, text) in [
        ("plain", PLAIN.to_owned()),
        ("metres", PLAIN.replace("mm", "m")),
        ("an odd unit", PLAIN.replace("mm", "ell")),
        ("feet", PLAIN.replace("LSHO", "LTOE").replace("RSHO", "HEAD")),
        ("wrong count", PLAIN.replace("\t2\t2\tmm", "\t9\t2\tmm")),
        ("uneven", PLAIN.replace("0.010000", "0.5")),
        ("no times", PLAIN.replace("0.010000", "").replace("0.000000", "")),
        (
            "late",
            PLAIN.replace("0.010000", "5.010000").replace("0.000000", "5.000000"),
        ),
        ("other rate", PLAIN.replace("100\t100\t2", "60\t60\t2")),
        ("broken off", PLAIN[..PLAIN.len() - 4].to_owned()),
        ("no rows", PLAIN.split("1\t0.0").next().unwrap_or_default().to_owned()),
        ("not one", "a\tb\n".to_owned()),
    ] {
        put(&mut out, format!("## {name}"));
        match read_trc_file(text.as_bytes()) {
            Ok((read, found)) => {
                tracks(&mut out, &read);
                findings(&mut out, &found);
                if let CapturedTrackContent::Markers(markers) = &read.tracks[0].content {
                    let written = write_trc_file("a", markers, read.tracks[0].offset);
                    put(&mut out, written.unwrap_or_else(|error| error));
                }
            }
            Err(error) => put(&mut out, format!("refused: {error}")),
        }
    }
    compare("trc", &out);
}
