//! Tests that tracks of every kind are stored and read back exactly, number for number.

use std::f64::consts::PI;

use chereme_motion::anatomy::Roles;
use chereme_motion::column::{Column, Gaps, Number};
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::markers::Frame;
use chereme_motion::{
    Capture, Clip, Convention, Curve, Curves, Instant, Joint, Marker, Markers, Quality, Rate,
    Skeleton, Space, Span, Times,
};

use super::{MediaFile, NewTrack, Signal, SkeletonTrack, Track, TrackChange, TrackKind};
use crate::address::{Address, Name};
use crate::{
    Corpus, ExportOptions, ExportWhat, ListFilter, ListKind, Progress, unheard, unpack_starter,
};

const FRAMES: usize = 1300;

fn rate(frames: u32) -> Rate {
    Rate::new(frames, 1).expect("a rate")
}

/// Returns a corpus with one captured recording.
fn corpus() -> (tempfile::TempDir, Corpus, Name) {
    let folder = tempfile::tempdir().expect("a folder");
    let paths = unpack_starter(&folder.path().join("files")).expect("unpacked");
    let wanted = |path: &std::path::PathBuf| path.file_stem().is_some_and(|stem| stem == "bol");
    let paths: Vec<_> = paths.into_iter().filter(wanted).collect();
    let mut corpus = Corpus::create(&folder.path().join("c.chereme"), "A").expect("made");
    let mut hear = unheard;
    corpus
        .import(
            &paths,
            &crate::ImportOptions::default(),
            &mut Progress::new(&mut hear),
        )
        .expect("imported");
    (folder, corpus, Name::Number(1))
}

fn wave(frame: usize, phase: f64) -> f64 {
    (frame as f64 * 0.037 + phase).sin() * 700.0 + phase
}

/// Returns a column of each form, each with gaps of its own.
fn columns() -> Vec<Column> {
    let frames = 0..FRAMES;
    let text = |frame: usize| format!("{:.3}", wave(frame, 0.1));
    vec![
        Column::decimals(frames.clone().map(|at| {
            (at % 400 > 3)
                .then(|| Number::parse(text(at).as_bytes()).ok())
                .flatten()
        })),
        Column::singles(
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
        Column::doubles(frames.clone().map(|at| wave(at, 0.3)).collect()),
        Column::integers(frames.map(|at| wave(at, 0.4) as i32).collect(), 16.0, -0.05)
            .and_then(|column| column.with_gaps(&Gaps::of([0..9, 1290..1300])))
            .expect("a column"),
    ]
}

fn markers() -> Markers {
    let [text, single, double, integer] = <[Column; 4]>::try_from(columns()).expect("four");
    let convention = Convention {
        metres_per_unit: 0.001,
        axes: "+Z,+X".parse().expect("axes"),
    };
    let point = |group: &str, name: &str, place: [&Column; 3], quality: Option<&Column>| Marker {
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
    Markers::new(Times::Even(rate(120)), Space::World(convention), points)
        .and_then(|markers| markers.joined(vec![[0, 2]]))
        .expect("markers")
        .rated(Quality::Residual)
}

fn face(times: Times, frames: usize) -> Curves {
    let curve = |at: usize| {
        let values = (0..frames)
            .map(|frame| wave(frame, at as f64) as f32)
            .collect();
        Curve::new(format!("Shape{at}"), Column::singles(values))
    };
    let mut curves: Vec<Curve> = (0..130).map(curve).collect();
    curves[3].unit = "rad".into();
    Curves::new(times, curves).expect("curves")
}

fn skeleton(frames: usize) -> SkeletonTrack {
    let turned = Joint {
        rest: DQuat::from_rotation_z(0.3),
        ..Joint::new("spine {1}", Some(0), DVec3::new(0.0, 11.000_000_1, 0.1))
    };
    let skeleton = Skeleton::new(vec![
        Joint::new("hips", None, DVec3::new(0.0, 95.0, 0.0)),
        turned,
        Joint::new("head", Some(1), DVec3::Y * 40.0).with_tip(DVec3::Y * 20.0),
    ])
    .expect("a skeleton");
    let mut channels = Clip::still(skeleton.clone().into(), rate(30), frames).into_channels();
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
        convention: Convention {
            metres_per_unit: 0.01,
            axes: "+Y,+X".parse().expect("axes"),
        },
        roles: Some("head = head".parse::<Roles>().expect("roles")),
    }
}

fn uneven() -> Times {
    let seconds = (0..FRAMES).map(|at| at as f32 * 0.0333 + if at % 7 == 0 { 0.001 } else { 0.0 });
    Times::listed(Column::singles(seconds.collect())).expect("times")
}

fn every_kind() -> Vec<NewTrack> {
    let mut all = vec![
        NewTrack::new("markers", Track::Markers(markers())),
        NewTrack::new("face", Track::Curves(face(Times::Even(rate(60)), FRAMES))),
        NewTrack::new("keys", Track::Curves(face(uneven(), FRAMES))),
        NewTrack::new("body", Track::Skeleton(skeleton(FRAMES))),
        NewTrack::new(
            "film",
            Track::Media(MediaFile {
                url: "take.mp4".into(),
                media_type: Some("video/mp4".into()),
            }),
        ),
    ];
    all[0].offset_us = 480_000;
    all[1].offset_us = -20_000;
    all
}

fn bits(column: &Column) -> Vec<Option<u64>> {
    column
        .values()
        .map(|value| value.map(f64::to_bits))
        .collect()
}

#[test]
fn every_number_of_every_form_reads_back_with_its_gaps() {
    let (_folder, mut corpus, take) = corpus();
    let new = every_kind();
    let rows = corpus.add_tracks(&take, &new).expect("stored");
    let names: Vec<&str> = rows.iter().map(|row| row.name.as_str()).collect();
    assert_eq!(names, ["markers", "face", "keys", "body 2", "film"]);
    for (new, row) in new.iter().zip(&rows) {
        assert_eq!((new.track.kind(), new.offset_us), (row.kind, row.offset_us));
        let back = corpus.track(row.id, None).expect(&row.name);
        assert_eq!(back, new.track, "{}", row.name);
        if let (Track::Markers(a), Track::Markers(b)) = (&new.track, &back) {
            for (a, b) in a.points().iter().zip(b.points()) {
                let all = a
                    .place
                    .iter()
                    .chain(&a.quality)
                    .zip(b.place.iter().chain(&b.quality));
                for (a, b) in all {
                    assert_eq!((a.numbers().form(), bits(a)), (b.numbers().form(), bits(b)));
                }
            }
        }
    }
    assert_eq!(rows[0].duration_us, Some(10_833_333));
    assert_eq!((rows[2].rate, rows[4].duration_us), (None, None));
    let check = corpus
        .check(false, &mut Progress::new(&mut unheard))
        .expect("checked");
    assert!(check.ok, "{:?}", check.faults);
    assert_eq!(check.checked["tracks"], 5);
}

#[test]
fn a_span_of_a_track_is_read_alone() {
    let (_folder, mut corpus, take) = corpus();
    let rows = corpus.add_tracks(&take, &every_kind()).expect("stored");
    let at = |seconds| Instant::from_seconds(seconds);
    let span = Span::between(at(4.0), at(8.5));
    let Track::Markers(part) = corpus.track(rows[0].id, Some(span)).expect("read") else {
        panic!("markers");
    };
    let first = ((4.0 - 0.48) * 120.0f64).ceil() as usize;
    let whole = markers();
    assert_eq!(part.frames(), 540);
    for frame in [0, 100, 539] {
        assert_eq!(part.shown(frame), whole.shown(first + frame), "{frame}");
    }
    let Track::Curves(part) = corpus.track(rows[2].id, Some(span)).expect("read") else {
        panic!("curves");
    };
    assert!(part.times().instant(0) >= at(4.0) && part.frames() > 130);
    let Track::Skeleton(part) = corpus.track(rows[3].id, Some(span)).expect("read") else {
        panic!("a skeleton");
    };
    assert_eq!(part.clip, skeleton(FRAMES).clip.slice(120..255));
    let none = Span::between(at(900.0), at(901.0));
    let Track::Curves(none) = corpus.track(rows[1].id, Some(none)).expect("read") else {
        panic!("curves");
    };
    assert_eq!((none.frames(), none.curves().len()), (0, 130));
}

#[test]
fn tracks_are_moved_renamed_removed_and_all_of_it_is_undone() {
    let (_folder, mut corpus, take) = corpus();
    let before = corpus.tracks(&take).expect("read");
    let rows = corpus.add_tracks(&take, &every_kind()).expect("stored");
    let with_all = corpus.tracks(&take).expect("read");
    let long = Address::Recording(take.clone());
    let moved = corpus.change_track(&take, "face", &TrackChange::Offset(60_000_000));
    let moved = moved.expect("moved");
    let face = moved.iter().find(|row| row.name == "face").expect("there");
    assert_eq!((face.id, face.offset_us), (rows[1].id, 60_000_000));
    let recording = corpus.overview(0).expect("read").recordings.remove(0).row;
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
    for row in with_all
        .iter()
        .filter(|row| row.kind != TrackKind::Skeleton)
    {
        let name = if row.name == "face" {
            "arkit"
        } else {
            &row.name
        };
        corpus
            .change_track(&take, name, &TrackChange::Remove)
            .expect("removed");
    }
    assert_eq!(corpus.tracks(&take).expect("read").len(), 2);
    assert!(corpus.movement(&long).is_ok(), "the body is still the body");
    for _ in 0..6 {
        corpus.undo().expect("undone");
    }
    assert_eq!(corpus.tracks(&take).expect("read"), with_all);
    for (new, row) in every_kind().iter().zip(&rows) {
        assert_eq!(corpus.track(row.id, None).expect("read"), new.track);
    }
    corpus.undo().expect("undone");
    assert_eq!(corpus.tracks(&take).expect("read"), before);
    corpus.redo().expect("done again");
    assert_eq!(corpus.tracks(&take).expect("read"), with_all);
}

#[test]
fn lists_counts_and_the_folder_of_everything_know_every_kind() {
    let (folder, mut corpus, take) = corpus();
    corpus.add_tracks(&take, &every_kind()).expect("stored");
    let filter = ListFilter::default().with("kind", "markers");
    let listing = corpus.list(ListKind::Tracks, &filter).expect("listed");
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
    let info = corpus.info().expect("info");
    let kinds: Vec<(&str, u64)> = info
        .tracks
        .iter()
        .map(|(kind, n)| (kind.as_str(), *n))
        .collect();
    assert_eq!(
        kinds,
        [("curves", 2), ("markers", 1), ("media", 1), ("skeleton", 2)]
    );
    assert_eq!((info.counts["points"], info.counts["curves"]), (3, 260));
    let to = folder.path().join("all");
    let mut hear = unheard;
    let mut progress = Progress::new(&mut hear);
    corpus
        .export(
            &ExportWhat::All,
            &to,
            &ExportOptions::default(),
            &mut progress,
        )
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
                column.text(frame).unwrap_or_default(),
                **cell,
                "frame {frame}"
            );
        }
    }
    assert!(
        to.join("tables/channel.csv").is_file() && to.join("recordings/bol.keys.csv").is_file()
    );
}

#[test]
fn movement_of_another_format_is_performed_and_written_as_bvh() {
    let (folder, mut corpus, take) = corpus();
    corpus
        .change_track(&take, "body", &TrackChange::Remove)
        .expect("removed");
    let new = [NewTrack::new("body", Track::Skeleton(skeleton(700)))];
    corpus.add_tracks(&take, &new).expect("stored");
    let address = Address::Recording(take);
    let moving = corpus.movement(&address).expect("movement");
    let wanted = skeleton(700);
    let wanted = wanted.convention.clip(&wanted.clip);
    let (a, b) = (moving.clip.model_pose(600), wanted.model_pose(600));
    assert!((a.position(2) - b.position(2)).length() < 1e-12);
    let to = folder.path().join("body.bvh");
    let mut hear = unheard;
    let mut progress = Progress::new(&mut hear);
    let what = ExportWhat::Address(address);
    corpus
        .export(&what, &to, &ExportOptions::default(), &mut progress)
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
    let wrist = |rate: u32, clock: f64, scale: f64, name: &str, space: Space, axes: usize| {
        let places = (0..10 * rate).map(|at| path(f64::from(at) / f64::from(rate) + clock) * scale);
        let places: Vec<DVec3> = places.collect();
        let column = |axis: usize| Column::doubles(places.iter().map(|at| at[axis]).collect());
        let point = Marker::new(name, (0..axes).map(column).collect());
        Markers::new(Times::Even(self::rate(rate)), space, vec![point]).expect("markers")
    };
    let frame = Frame {
        width: 640.0,
        height: 480.0,
    };
    let room = wrist(
        120,
        0.0,
        1000.0,
        "Anna:LWRA",
        Space::World(Convention::MODEL),
        3,
    );
    let film =
        wrist(30, 0.72, 200.0, "LEFT_WRIST", Space::Image(frame), 2).captured(Capture::Estimated);
    let new = [
        NewTrack::new("optical", Track::Markers(room)),
        NewTrack::new("pose", Track::Markers(film)),
    ];
    corpus.add_tracks(&take, &new).expect("stored");
    let found = corpus
        .align_track(
            &take,
            &Signal::of("pose"),
            &Signal::of("optical"),
            5_000_000,
        )
        .expect("aligned");
    assert!((found.offset_us - 720_000).abs() < 20_000, "{found:?}");
    assert!(found.confidence > 0.5, "{found:?}");
    assert_eq!(found.channels, [["LEFT_WRIST"], ["Anna:LWRA"]]);
    let missing = Signal {
        track: "pose".into(),
        channels: vec!["KNEE".into()],
    };
    assert!(
        corpus
            .align_track(&take, &missing, &Signal::of("optical"), 1)
            .is_err()
    );
}

#[test]
fn a_track_without_frames_is_refused_and_nothing_is_left_of_it() {
    let (_folder, mut corpus, take) = corpus();
    let empty = face(Times::Even(rate(30)), 0);
    let new = [
        NewTrack::new("markers", Track::Markers(markers())),
        NewTrack::new("face", Track::Curves(empty)),
    ];
    assert!(corpus.add_tracks(&take, &new).is_err());
    assert_eq!(corpus.tracks(&take).expect("read").len(), 1);
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
            (
                row,
                "DELETE FROM track_block WHERE track_id = ?1 AND first_frame > 0",
            ),
            (row, "UPDATE track SET frames = frames + 7 WHERE id = ?1"),
        ]
    }) {
        let damaged = folder.path().join("damaged.chereme");
        std::fs::copy(&path, &damaged).expect("copied");
        let foreign = rusqlite::Connection::open(&damaged).expect("opened");
        assert!(
            foreign.execute(sql, [row.id]).expect("damaged") > 0,
            "{sql}"
        );
        drop(foreign);
        let mut corpus = Corpus::open(&damaged, "A").expect("opened");
        let check = corpus
            .check(false, &mut Progress::new(&mut unheard))
            .expect("checked");
        let place = format!("track {} of recording:1", row.id);
        let places: Vec<&str> = check.faults.iter().map(|it| it.place.as_str()).collect();
        assert!(
            places.contains(&place.as_str()),
            "{}: {sql}: {places:?}",
            row.name
        );
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
        let new = [NewTrack::new("markers", Track::Markers(track))];
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
    let nowhere = crate::Name::Text("nowhere".into());
    assert!(corpus.marker_people(&nowhere, None).is_err());
}

/// Returns markers on the program's own body at rest, each named `subject:label`.
fn worn(subjects: &[&str], without: &[&str], metres_per_unit: f64) -> Markers {
    let labels = [
        "LFHD", "RFHD", "C7", "LSHO", "RSHO", "LELB", "RELB", "LWRA", "RWRA", "LWRB", "RWRB",
        "LFIN", "RFIN", "LKNE", "RKNE", "LANK", "RANK",
    ];
    let (clip, anatomy) = crate::picture::built_in_body().expect("a body");
    let model = clip.model_pose(0);
    let named = subjects.iter().flat_map(|subject| {
        let labels = labels.iter().filter(|label| !without.contains(label));
        labels.map(move |label| (subject, label))
    });
    let points = named.map(|(subject, label)| {
        let known = chereme_motion::fit::attachment(label).expect("a known label");
        let part = known.near.or(known.towards.map(|(part, _)| part));
        let joint = anatomy.joint(part.unwrap_or(known.on[0])).expect("a joint");
        let at = model.position(joint) + DVec3::Z * known.thumbwards;
        let place = at.to_array().map(|value| Column::doubles(vec![value; 3]));
        Marker::new(format!("{subject}:{label}"), place.to_vec())
    });
    let convention = Convention {
        metres_per_unit,
        ..Convention::MODEL
    };
    let space = Space::World(convention);
    Markers::new(Times::Even(rate(60)), space, points.collect()).expect("markers")
}

#[test]
fn what_a_fit_does_not_show_is_said_in_both_languages() {
    let cases: [(&[&str], f64, &[&str]); 3] = [
        (&[], 1.0, &["no marker is on the fingers"]),
        (
            &["LWRA"],
            1.0,
            &[
                "the turn of the left forearm",
                "no marker is on the fingers",
            ],
        ),
        (
            &[],
            0.001,
            &[
                "the body of the markers is 0.00",
                "no marker is on the fingers",
            ],
        ),
    ];
    let (_folder, mut corpus, take) = corpus();
    let mut fitted = |track: Markers, subject: Option<&str>, dry_run: bool| {
        let new = [NewTrack::new("markers", Track::Markers(track))];
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
        assert_eq!(
            report.findings.len(),
            expected.len(),
            "{:?}",
            report.findings
        );
        for (finding, start) in report.findings.iter().zip(expected) {
            assert!(finding.starts_with(start), "{finding}");
            let french = crate::words::message(finding, crate::words::Language::French);
            assert!(french.is_some_and(|it| it != *finding), "{finding}");
        }
    }
    for (subject, message) in [
        (None, "several people: Anna, Bob"),
        (Some("Cleo"), "is of \"Cleo\"; the people are: Anna, Bob"),
    ] {
        let error =
            fitted(worn(&["Anna", "Bob"], &[], 1.0), subject, true).expect_err("two people");
        let text = error.to_string();
        assert!(text.contains(message), "{text}");
        let remedy = error.remedy().map(|it| it.text().to_owned());
        assert_eq!(
            remedy.as_deref(),
            Some("name one of them: --subject \"Anna\"")
        );
    }
    let report = fitted(worn(&["Anna", "Bob"], &[], 1.0), Some("Bob"), false).expect("a fit");
    assert!(
        report
            .residuals
            .iter()
            .all(|it| it.marker.starts_with("Bob:"))
    );
    let left_out = "markers that are not of \"Bob\" and are left out: 17";
    assert_eq!(
        (report.residuals.len(), report.findings[0].as_str()),
        (17, left_out)
    );
    let deed = &corpus.log(1).expect("read")[0];
    assert!(
        deed.summary.contains("fitted to markers 6 of Bob, "),
        "{}",
        deed.summary
    );
}
