//! Tests that tracks of every kind are stored and read back exactly, number for number.

use std::f64::consts::PI;

use chereme_motion::anatomy::AssignedJointRoles;
use chereme_motion::column::{ColumnGaps, FileNumber, FrameNumberColumn};
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::markers::PointPictureSize;
use chereme_motion::{
    CaptureMethod, Clip, CurveTrack, FrameRate, FrameTimes, MarkerSpace, MarkerTrack, MotionMarker, QualityMeaning,
    RecordingInstant, ScalarCurve, Skeleton, SkeletonJoint, SpaceConvention, TimeSpan,
};

use super::{AlignmentSignal, MediaFile, NewTrack, SkeletonTrack, TrackChange, TrackContent, TrackKind};
use crate::address::{CorpusAddress, RowName};
use crate::{
    Corpus, ExportOptions, ExportWhat, ListFilter, ListKind, ProgressReceiver, ignore_progress_step, unpack_starter,
};

const FRAMES: usize = 1300;

fn rate(frames: u32) -> FrameRate {
    FrameRate::new(frames, 1).expect("a rate")
}

/// Returns a corpus with one captured recording.
fn corpus() -> (tempfile::TempDir, Corpus, RowName) {
    let folder = tempfile::tempdir().expect("a folder");
    let paths = unpack_starter(&folder.path().join("files")).expect("unpacked");
    let wanted = |path: &std::path::PathBuf| path.file_stem().is_some_and(|stem| stem == "bol");
    let paths: Vec<_> = paths.into_iter().filter(wanted).collect();
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    let mut hear = ignore_progress_step;
    corpus
        .import_paths(
            &paths,
            &crate::ImportOptions::default(),
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("imported");
    (folder, corpus, RowName::Number(1))
}

fn wave(frame: usize, phase: f64) -> f64 {
    (frame as f64 * 0.037 + phase).sin() * 700.0 + phase
}

/// Returns a column of each form, each with gaps of its own.
fn columns() -> Vec<FrameNumberColumn> {
    let frames = 0..FRAMES;
    let text = |frame: usize| format!("{:.3}", wave(frame, 0.1));
    vec![
        FrameNumberColumn::from_decimals(frames.clone().map(|at| {
            (at % 400 > 3)
                .then(|| FileNumber::parse_file_number(text(at).as_bytes()).ok())
                .flatten()
        })),
        FrameNumberColumn::from_single_floats(
            frames
                .clone()
                .map(|at| {
                    if (600..640).contains(&at) {
                        f32::NAN
                    } else {
                        wave(at, 0.2) as f32
                    }
                })
                .collect(),
        ),
        FrameNumberColumn::from_double_floats(frames.clone().map(|at| wave(at, 0.3)).collect()),
        FrameNumberColumn::from_scaled_integers(frames.map(|at| wave(at, 0.4) as i32).collect(), 16.0, -0.05)
            .and_then(|column| column.with_gaps(&ColumnGaps::from_gap_runs([0..9, 1290..1300])))
            .expect("a column"),
    ]
}

fn markers() -> MarkerTrack {
    let [text, single, double, integer] = <[FrameNumberColumn; 4]>::try_from(columns()).expect("four");
    let convention = SpaceConvention {
        metres_per_unit: 0.001,
        axes: "+Z,+X".parse().expect("axes"),
    };
    let point =
        |group: &str, name: &str, place: [&FrameNumberColumn; 3], quality: Option<&FrameNumberColumn>| MotionMarker {
            group: group.into(),
            name: name.into(),
            place: place.map(Clone::clone).to_vec(),
            quality: quality.cloned(),
        };
    let points = vec![
        point("", "LWRA", [&text, &single, &double], Some(&integer)),
        point("Anna", "LWRA", [&integer, &integer, &integer], None),
        point("", "LELB", [&double, &text, &single], Some(&single)),
    ];
    MarkerTrack::new(FrameTimes::Even(rate(120)), MarkerSpace::World(convention), points)
        .and_then(|markers| markers.with_marker_limbs(vec![[0, 2]]))
        .expect("markers")
        .with_quality_meaning(QualityMeaning::Residual)
}

fn face(times: FrameTimes, frames: usize) -> CurveTrack {
    let curve = |at: usize| {
        let values = (0..frames).map(|frame| wave(frame, at as f64) as f32).collect();
        ScalarCurve::new(format!("Shape{at}"), FrameNumberColumn::from_single_floats(values))
    };
    let mut curves: Vec<ScalarCurve> = (0..130).map(curve).collect();
    curves[3].unit = "rad".into();
    CurveTrack::new(times, curves).expect("curves")
}

fn skeleton(frames: usize) -> SkeletonTrack {
    let turned = SkeletonJoint {
        rest: DQuat::from_rotation_z(0.3),
        ..SkeletonJoint::new("spine {1}", Some(0), DVec3::new(0.0, 11.000_000_1, 0.1))
    };
    let skeleton = Skeleton::new(vec![
        SkeletonJoint::new("hips", None, DVec3::new(0.0, 95.0, 0.0)),
        turned,
        SkeletonJoint::new("head", Some(1), DVec3::Y * 40.0).with_tip(DVec3::Y * 20.0),
    ])
    .expect("a skeleton");
    let mut channels = Clip::from_rest_pose(skeleton.clone().into(), rate(30), frames).into_channels();
    for (joint, channel) in channels.iter_mut().enumerate() {
        for (frame, rotation) in channel.rotations.iter_mut().enumerate() {
            // Rounded to 32-bit numbers, as in files that store those.
            let q = DQuat::from_rotation_x((frame as f64 * 0.01 + joint as f64) % PI).as_quat();
            *rotation = q.as_dquat();
        }
    }
    channels[0].translations = Some(
        (0..frames)
            .map(|at| DVec3::new(wave(at, 1.0), 95.0, 1.0 / 3.0))
            .collect(),
    );
    SkeletonTrack {
        clip: Clip::new(skeleton.into(), rate(30), channels).expect("a clip"),
        convention: SpaceConvention {
            metres_per_unit: 0.01,
            axes: "+Y,+X".parse().expect("axes"),
        },
        roles: Some("head = head".parse::<AssignedJointRoles>().expect("roles")),
    }
}

fn uneven() -> FrameTimes {
    let seconds = (0..FRAMES).map(|at| at as f32 * 0.0333 + if at % 7 == 0 { 0.001 } else { 0.0 });
    FrameTimes::from_listed_seconds(FrameNumberColumn::from_single_floats(seconds.collect())).expect("times")
}

fn every_kind() -> Vec<NewTrack> {
    let mut all = vec![
        NewTrack::new("markers", TrackContent::Markers(markers())),
        NewTrack::new("face", TrackContent::Curves(face(FrameTimes::Even(rate(60)), FRAMES))),
        NewTrack::new("keys", TrackContent::Curves(face(uneven(), FRAMES))),
        NewTrack::new("body", TrackContent::Skeleton(skeleton(FRAMES))),
        NewTrack::new(
            "film",
            TrackContent::Media(MediaFile {
                url: "take.mp4".into(),
                media_type: Some("video/mp4".into()),
            }),
        ),
    ];
    all[0].offset_us = 480_000;
    all[1].offset_us = -20_000;
    all
}

fn bits(column: &FrameNumberColumn) -> Vec<Option<u64>> {
    column.column_values().map(|value| value.map(f64::to_bits)).collect()
}

fn wrists_of_track(name: &str) -> AlignmentSignal {
    AlignmentSignal {
        track: name.to_owned(),
        channels: Vec::new(),
    }
}

#[test]
fn every_number_of_every_form_reads_back_with_its_gaps() {
    let (_folder, mut corpus, take) = corpus();
    let new = every_kind();
    let rows = corpus.add_tracks(&take, &new).expect("stored");
    let names: Vec<&str> = rows.iter().map(|row| row.name.as_str()).collect();
    assert_eq!(names, ["markers", "face", "keys", "body 2", "film"]);
    for (new, row) in new.iter().zip(&rows) {
        assert_eq!((new.track.track_kind(), new.offset_us), (row.kind, row.offset_us));
        let back = corpus.read_track_content(row.id, None).expect(&row.name);
        assert_eq!(back, new.track, "{}", row.name);
        if let (TrackContent::Markers(a), TrackContent::Markers(b)) = (&new.track, &back) {
            for (a, b) in a.marker_points().iter().zip(b.marker_points()) {
                let all = a.place.iter().chain(&a.quality).zip(b.place.iter().chain(&b.quality));
                for (a, b) in all {
                    assert_eq!(
                        (a.column_numbers().number_form_name(), bits(a)),
                        (b.column_numbers().number_form_name(), bits(b))
                    );
                }
            }
        }
    }
    assert_eq!(rows[0].duration_us, Some(10_833_333));
    assert_eq!((rows[2].rate, rows[4].duration_us), (None, None));
    let check = corpus
        .check_corpus(false, &mut ProgressReceiver::new(&mut ignore_progress_step))
        .expect("checked");
    assert!(check.ok, "{:?}", check.faults);
    assert_eq!(check.checked["tracks"], 5);
}

#[test]
fn a_span_of_a_track_is_read_alone() {
    let (_folder, mut corpus, take) = corpus();
    let rows = corpus.add_tracks(&take, &every_kind()).expect("stored");
    let at = |seconds| RecordingInstant::from_seconds(seconds);
    let span = TimeSpan::span_between(at(4.0), at(8.5));
    let TrackContent::Markers(part) = corpus.read_track_content(rows[0].id, Some(span)).expect("read") else {
        panic!("markers");
    };
    let first = ((4.0 - 0.48) * 120.0f64).ceil() as usize;
    let whole = markers();
    assert_eq!(part.marker_frame_count(), 540);
    for frame in [0, 100, 539] {
        assert_eq!(
            part.displayed_markers(frame),
            whole.displayed_markers(first + frame),
            "{frame}"
        );
    }
    let TrackContent::Curves(part) = corpus.read_track_content(rows[2].id, Some(span)).expect("read") else {
        panic!("curves");
    };
    assert!(part.curve_times().frame_time_instant(0) >= at(4.0) && part.curve_frame_count() > 130);
    let TrackContent::Skeleton(part) = corpus.read_track_content(rows[3].id, Some(span)).expect("read") else {
        panic!("a skeleton");
    };
    assert_eq!(part.clip, skeleton(FRAMES).clip.slice_clip_frames(120..255));
    let none = TimeSpan::span_between(at(900.0), at(901.0));
    let TrackContent::Curves(none) = corpus.read_track_content(rows[1].id, Some(none)).expect("read") else {
        panic!("curves");
    };
    assert_eq!((none.curve_frame_count(), none.track_curves().len()), (0, 130));
}

#[test]
fn tracks_are_moved_renamed_removed_and_all_of_it_is_undone() {
    let (_folder, mut corpus, take) = corpus();
    let before = corpus.recording_tracks(&take).expect("read");
    let rows = corpus.add_tracks(&take, &every_kind()).expect("stored");
    let with_all = corpus.recording_tracks(&take).expect("read");
    let long = CorpusAddress::Recording(take.clone());
    let moved = corpus.change_track(&take, "face", &TrackChange::Offset(60_000_000));
    let moved = moved.expect("moved");
    let face = moved.iter().find(|row| row.name == "face").expect("there");
    assert_eq!((face.id, face.offset_us), (rows[1].id, 60_000_000));
    let recording = corpus.load_corpus_overview(0).expect("read").recordings.remove(0).row;
    assert!(
        recording.duration_us >= 60_000_000,
        "the recording lasts as long as its tracks"
    );
    for (name, change) in [
        ("face", TrackChange::Name("markers".into())),
        ("face", TrackChange::Name(" ".into())),
        ("feet", TrackChange::Remove),
    ] {
        let refused = corpus.change_track(&take, name, &change);
        assert!(refused.is_err(), "{name} {change:?}");
    }
    corpus
        .change_track(&take, "face", &TrackChange::Name("arkit".into()))
        .expect("renamed");
    for row in with_all.iter().filter(|row| row.kind != TrackKind::Skeleton) {
        let name = if row.name == "face" { "arkit" } else { &row.name };
        corpus.change_track(&take, name, &TrackChange::Remove).expect("removed");
    }
    assert_eq!(corpus.recording_tracks(&take).expect("read").len(), 2);
    assert!(corpus.movement_at_address(&long).is_ok(), "the body is still the body");
    for _ in 0..6 {
        corpus.undo_operation().expect("undone");
    }
    assert_eq!(corpus.recording_tracks(&take).expect("read"), with_all);
    for (new, row) in every_kind().iter().zip(&rows) {
        assert_eq!(corpus.read_track_content(row.id, None).expect("read"), new.track);
    }
    corpus.undo_operation().expect("undone");
    assert_eq!(corpus.recording_tracks(&take).expect("read"), before);
    corpus.redo_operation().expect("done again");
    assert_eq!(corpus.recording_tracks(&take).expect("read"), with_all);
}

#[test]
fn lists_counts_and_the_folder_of_everything_know_every_kind() {
    let (folder, mut corpus, take) = corpus();
    corpus.add_tracks(&take, &every_kind()).expect("stored");
    let filter = ListFilter {
        columns: vec![("kind".to_owned(), "markers".to_owned())],
        ..ListFilter::default()
    };
    let listing = corpus.list_rows(ListKind::Tracks, &filter).expect("listed");
    let row = serde_json::to_value(&listing.rows[0]).expect("JSON");
    for (column, value) in [
        ("recording", serde_json::json!("bol")),
        ("kind", "markers".into()),
        ("name", "markers".into()),
        ("rate", 120.0.into()),
        ("offset_us", 480_000.into()),
        ("duration_us", 10_833_333.into()),
        ("channels", 3.into()),
    ] {
        assert_eq!(row[column], value, "{column}");
    }
    let info = corpus.load_corpus_info().expect("info");
    let kinds: Vec<(&str, u64)> = info.tracks.iter().map(|(kind, n)| (kind.as_str(), *n)).collect();
    assert_eq!(kinds, [("curves", 2), ("markers", 1), ("media", 1), ("skeleton", 2)]);
    assert_eq!((info.counts["points"], info.counts["curves"]), (3, 260));
    let to = folder.path().join("all");
    let mut hear = ignore_progress_step;
    let mut progress = ProgressReceiver::new(&mut hear);
    corpus
        .export_corpus(&ExportWhat::All, &to, &ExportOptions::default(), &mut progress)
        .expect("exported");
    let table = std::fs::read_to_string(to.join("recordings/bol.markers.csv")).expect("a table");
    let mut lines = table.lines();
    let titles = lines.next().expect("titles");
    assert!(titles.starts_with("frame,time_s,LWRA.x,LWRA.y,LWRA.z,LWRA.residual,Anna:LWRA.x"));
    let whole = columns();
    for (frame, line) in lines.enumerate() {
        let cells: Vec<&str> = line.split(',').collect();
        for (column, cell) in whole.iter().zip(&cells[2..6]) {
            assert_eq!(
                column.column_text_at(frame).unwrap_or_default(),
                **cell,
                "frame {frame}"
            );
        }
    }
    assert!(to.join("tables/channel.csv").is_file() && to.join("recordings/bol.keys.csv").is_file());
}

#[test]
fn movement_of_another_format_is_performed_and_written_as_bvh() {
    let (folder, mut corpus, take) = corpus();
    corpus
        .change_track(&take, "body", &TrackChange::Remove)
        .expect("removed");
    let new = [NewTrack::new("body", TrackContent::Skeleton(skeleton(700)))];
    corpus.add_tracks(&take, &new).expect("stored");
    let address = CorpusAddress::Recording(take);
    let moving = corpus.movement_at_address(&address).expect("movement");
    let wanted = skeleton(700);
    let wanted = wanted.convention.file_clip_to_model(&wanted.clip);
    let (a, b) = (moving.clip.model_pose(600), wanted.model_pose(600));
    assert!((a.model_joint_position(2) - b.model_joint_position(2)).length() < 1e-12);
    let to = folder.path().join("body.bvh");
    let mut hear = ignore_progress_step;
    let mut progress = ProgressReceiver::new(&mut hear);
    let what = ExportWhat::Address(address);
    corpus
        .export_corpus(&what, &to, &ExportOptions::default(), &mut progress)
        .expect("exported");
    let text = std::fs::read_to_string(&to).expect("a file");
    assert!(
        text.contains("Frames: 700") && text.contains("spine _1_"),
        "{text:.300}"
    );
}

#[test]
fn the_offset_of_a_track_is_found_from_what_moves_in_both() {
    let (_folder, mut corpus, take) = corpus();
    let path = |time: f64| {
        let bump = |at: f64, width: f64| (-((time - at) / width).powi(2)).exp();
        DVec3::new(
            bump(2.0, 0.3) + bump(6.1, 0.2),
            bump(3.1, 0.15) + bump(7.7, 0.4),
            bump(5.0, 0.25),
        )
    };
    let wrist = |rate: u32, clock: f64, scale: f64, name: &str, space: MarkerSpace, axes: usize| {
        let places = (0..10 * rate).map(|at| path(f64::from(at) / f64::from(rate) + clock) * scale);
        let places: Vec<DVec3> = places.collect();
        let column = |axis: usize| FrameNumberColumn::from_double_floats(places.iter().map(|at| at[axis]).collect());
        let point = MotionMarker::new(name, (0..axes).map(column).collect());
        MarkerTrack::new(FrameTimes::Even(self::rate(rate)), space, vec![point]).expect("markers")
    };
    let frame = PointPictureSize {
        width: 640.0,
        height: 480.0,
    };
    let room = wrist(
        120,
        0.0,
        1000.0,
        "Anna:LWRA",
        MarkerSpace::World(SpaceConvention::MODEL_CONVENTION),
        3,
    );
    let film = wrist(30, 0.72, 200.0, "LEFT_WRIST", MarkerSpace::Image(frame), 2)
        .with_capture_method(CaptureMethod::Estimated);
    let new = [
        NewTrack::new("optical", TrackContent::Markers(room)),
        NewTrack::new("pose", TrackContent::Markers(film)),
    ];
    corpus.add_tracks(&take, &new).expect("stored");
    let found = corpus
        .align_track(&take, &wrists_of_track("pose"), &wrists_of_track("optical"), 5_000_000)
        .expect("aligned");
    assert!((found.offset_us - 720_000).abs() < 20_000, "{found:?}");
    assert!(found.confidence > 0.5, "{found:?}");
    assert_eq!(found.channels, [["LEFT_WRIST"], ["Anna:LWRA"]]);
    let missing = AlignmentSignal {
        track: "pose".into(),
        channels: vec!["KNEE".into()],
    };
    assert!(
        corpus
            .align_track(&take, &missing, &wrists_of_track("optical"), 1)
            .is_err()
    );
}

#[test]
fn a_track_without_frames_is_refused_and_nothing_is_left_of_it() {
    let (_folder, mut corpus, take) = corpus();
    let empty = face(FrameTimes::Even(rate(30)), 0);
    let new = [
        NewTrack::new("markers", TrackContent::Markers(markers())),
        NewTrack::new("face", TrackContent::Curves(empty)),
    ];
    assert!(corpus.add_tracks(&take, &new).is_err());
    assert_eq!(corpus.recording_tracks(&take).expect("read").len(), 1);
}

#[test]
fn a_check_names_the_track_of_any_kind_whose_numbers_are_damaged() {
    let (folder, mut corpus, take) = corpus();
    let rows = corpus.add_tracks(&take, &every_kind()).expect("stored");
    drop(corpus);
    let path = folder.path().join("c.chereme");
    let with_numbers = rows.iter().filter(|row| row.kind != TrackKind::Media);
    for (row, sql) in with_numbers.flat_map(|row| {
        [
            (row, "DELETE FROM track_block WHERE track_id = ?1 AND first_frame > 0"),
            (row, "UPDATE track SET frames = frames + 7 WHERE id = ?1"),
        ]
    }) {
        let damaged = folder.path().join("damaged.chereme");
        std::fs::copy(&path, &damaged).expect("copied");
        let foreign = rusqlite::Connection::open(&damaged).expect("opened");
        assert!(foreign.execute(sql, [row.id]).expect("damaged") > 0, "{sql}");
        drop(foreign);
        let mut corpus = Corpus::open_corpus(&damaged, "A").expect("opened");
        let check = corpus
            .check_corpus(false, &mut ProgressReceiver::new(&mut ignore_progress_step))
            .expect("checked");
        let place = format!("track {} of recording:1", row.id);
        let places: Vec<&str> = check.faults.iter().map(|it| it.place.as_str()).collect();
        assert!(places.contains(&place.as_str()), "{}: {sql}: {places:?}", row.name);
    }
}

#[test]
fn the_people_of_markers_are_listed_if_there_are_several() {
    let (_folder, mut corpus, take) = corpus();
    let cases: [(&[&str], &[&str]); 4] = [
        (&[""], &[]),
        (&["Anna"], &[]),
        (&["Anna", "Bob"], &["Anna", "Bob"]),
        (&["", "Bob"], &["(no name)", "Bob"]),
    ];
    for (subjects, want) in cases {
        let track = worn(subjects, &[], 1.0);
        let new = [NewTrack::new("markers", TrackContent::Markers(track))];
        let rows = corpus.add_tracks(&take, &new).expect("stored");
        let people = corpus.marker_people(&take, Some(&rows[0].name));
        assert_eq!(people.expect("read"), want, "{subjects:?}");
        for name in want {
            let options = crate::FitOptions {
                track: Some(&rows[0].name),
                subject: Some(name),
                dry_run: true,
                ..crate::FitOptions::default()
            };
            assert!(corpus.fit_markers(&take, &options).is_ok(), "{name}");
        }
    }
    let nowhere = crate::RowName::Text("nowhere".into());
    assert!(corpus.marker_people(&nowhere, None).is_err());
}

/// Returns markers on the program's own body at rest, each named `subject:label`.
fn worn(subjects: &[&str], without: &[&str], metres_per_unit: f64) -> MarkerTrack {
    let labels = [
        "LFHD", "RFHD", "C7", "LSHO", "RSHO", "LELB", "RELB", "LWRA", "RWRA", "LWRB", "RWRB", "LFIN", "RFIN", "LKNE",
        "RKNE", "LANK", "RANK",
    ];
    let (clip, anatomy) = crate::starter::built_in_body().expect("a body");
    let model = clip.model_pose(0);
    let named = subjects.iter().flat_map(|subject| {
        let labels = labels.iter().filter(|label| !without.contains(label));
        labels.map(move |label| (subject, label))
    });
    let points = named.map(|(subject, label)| {
        let known = chereme_motion::fit::find_marker_attachment(label).expect("a known label");
        let part = known.near.or(known.towards.map(|(part, _)| part));
        let joint = anatomy.part_joint(part.unwrap_or(known.on[0])).expect("a joint");
        let at = model.model_joint_position(joint) + DVec3::Z * known.thumbwards;
        let place = at
            .to_array()
            .map(|value| FrameNumberColumn::from_double_floats(vec![value; 3]));
        MotionMarker::new(format!("{subject}:{label}"), place.to_vec())
    });
    let convention = SpaceConvention {
        metres_per_unit,
        ..SpaceConvention::MODEL_CONVENTION
    };
    let space = MarkerSpace::World(convention);
    MarkerTrack::new(FrameTimes::Even(rate(60)), space, points.collect()).expect("markers")
}

#[test]
fn what_a_fit_does_not_show_is_said_in_both_languages() {
    let cases: [(&[&str], f64, &[&str]); 3] = [
        (&[], 1.0, &["no marker is on the fingers"]),
        (
            &["LWRA"],
            1.0,
            &["the turn of the left forearm", "no marker is on the fingers"],
        ),
        (
            &[],
            0.001,
            &["the body of the markers is 0.00", "no marker is on the fingers"],
        ),
    ];
    let (_folder, mut corpus, take) = corpus();
    let mut fitted = |track: MarkerTrack, subject: Option<&str>, dry_run: bool| {
        let new = [NewTrack::new("markers", TrackContent::Markers(track))];
        let rows = corpus.add_tracks(&take, &new).expect("stored");
        let options = crate::FitOptions {
            track: Some(&rows[0].name),
            subject,
            dry_run,
            ..crate::FitOptions::default()
        };
        corpus.fit_markers(&take, &options)
    };
    for (without, unit, expected) in cases {
        let report = fitted(worn(&["Anna"], without, unit), None, true).expect("a fit");
        let expected = expected.iter().chain(&["the recording has a body already"]);
        let expected: Vec<&str> = expected.copied().collect();
        assert_eq!(report.findings.len(), expected.len(), "{:?}", report.findings);
        for (finding, start) in report.findings.iter().zip(expected) {
            assert!(finding.starts_with(start), "{finding}");
            let french = crate::words::localized_message(finding, crate::words::InterfaceLanguage::French);
            assert!(french.is_some_and(|it| it != *finding), "{finding}");
        }
    }
    for (subject, message) in [
        (None, "several people: Anna, Bob"),
        (Some("Cleo"), "is of \"Cleo\"; the people are: Anna, Bob"),
    ] {
        let error = fitted(worn(&["Anna", "Bob"], &[], 1.0), subject, true).expect_err("two people");
        let text = error.to_string();
        assert!(text.contains(message), "{text}");
        let remedy = error.error_remedy().map(|it| it.remedy_text().to_owned());
        assert_eq!(remedy.as_deref(), Some("name one of them: --subject \"Anna\""));
    }
    let report = fitted(worn(&["Anna", "Bob"], &[], 1.0), Some("Bob"), false).expect("a fit");
    assert!(report.residuals.iter().all(|it| it.marker.starts_with("Bob:")));
    let left_out = "markers that are not of \"Bob\" and are left out: 17";
    assert_eq!((report.residuals.len(), report.findings[0].as_str()), (17, left_out));
    let deed = &corpus.operation_log(1).expect("read")[0];
    assert!(
        deed.summary.contains("fitted to markers 6 of Bob, "),
        "{}",
        deed.summary
    );
}
