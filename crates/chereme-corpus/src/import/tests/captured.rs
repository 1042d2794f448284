//! Tests of captures in other formats, with tiers of other programs beside them.

use chereme_formats::gltf;

use super::*;
use crate::track::TrackKind;

const TRC: &str = "PathFileType\t4\t(X/Y/Z)\ttake.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n\
100\t100\t2\t1\tmm\t100\t1\t2\nFrame#\tTime\tLWRA\n\t\tX1\tY1\tZ1\n\n1\t0.00\t1.50\t900\t3\n2\t0.01\t1.60\t\t3\n";
const FACE: &str = "Timecode,BlendShapeCount,JawOpen\n00:00:00:00.0,61,0.25\n00:00:00:01.0,61,0.5\n";
const GRID: &str = "\"ooTextFile\" \"TextGrid\" 0 1 <exists> 1 \"IntervalTier\" \"Gloss\" 0 1 1 0 1 \"CHAT\"";

#[test]
fn points_that_were_imported_before_report_that_they_keep_their_rate() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let numbers = vec!["100,200,0.9"; 25].join(",");
    let frame = format!("{{\"version\":1.3,\"people\":[{{\"pose_keypoints_2d\":[{numbers}]}}]}}");
    let first = desk.file("take_000000000000_keypoints.json", &frame);
    desk.file("take_000000000001_keypoints.json", &frame);
    let message = "it was imported before with 25 fps, and its points keep that rate";
    for (rate, expected) in [(None, 0), (None, 0), (Some(25), 0), (Some(50), 1)] {
        let options = ImportOptions {
            rate: rate.map(|rate| chereme_motion::FrameRate::new(rate, 1).expect("a rate")),
            ..ImportOptions::default()
        };
        let mut hear = ignore_progress_step;
        let paths = std::slice::from_ref(&first);
        let report = corpus.import_paths(paths, &options, &mut ProgressReceiver::new(&mut hear));
        let report = report.expect("imported").files.remove(0);
        let found = report.findings.iter().filter(|it| it.message == message);
        assert_eq!(found.count(), expected, "{rate:?} {:?}", report.findings);
    }
}

#[test]
fn measured_markers_take_the_unit_and_the_axes_that_are_asked_for() {
    let desk = Desk::new();
    let take = desk.file("take.trc", TRC);
    let axes = "+Z,-X".parse().expect("axes");
    let message = "it was imported before, and its points keep their unit and axes";
    let cases = [
        ("plain", None, None, 0.001, "+Y,+X"),
        ("unit", Some(0.01), None, 0.01, "+Y,+X"),
        ("both", Some(0.01), Some(axes), 0.01, "+Z,-X"),
    ];
    for (name, metres_per_unit, axes, unit, expected) in cases {
        let mut corpus = desk.corpus(&format!("{name}.chereme"));
        let options = ImportOptions {
            metres_per_unit,
            axes,
            ..ImportOptions::default()
        };
        for other in [options.clone(), options, ImportOptions::default()] {
            let mut hear = ignore_progress_step;
            let paths = std::slice::from_ref(&take);
            let report = corpus.import_paths(paths, &other, &mut ProgressReceiver::new(&mut hear));
            let report = report.expect("imported").files.remove(0);
            assert!(report.findings.iter().all(|it| it.message != message));
        }
        let form = crate::db::stored_tracks::load_track_form(corpus.store.read_connection(), 1).expect("a track");
        assert_eq!(form.metres_per_unit, Some(unit), "{name}");
        assert_eq!(form.axes.as_deref(), Some(expected), "{name}");
        let feet = ImportOptions {
            metres_per_unit: Some(0.3048),
            ..ImportOptions::default()
        };
        let mut hear = ignore_progress_step;
        let paths = std::slice::from_ref(&take);
        let again = corpus.import_paths(paths, &feet, &mut ProgressReceiver::new(&mut hear));
        let again = again.expect("imported").files.remove(0);
        let found = again.findings.iter().filter(|it| it.message == message);
        assert_eq!(found.count(), 1, "{name}: {:?}", again.findings);
    }
}

#[test]
fn markers_faces_and_tiers_of_one_take_share_a_recording() {
    let folder = tempfile::tempdir().expect("a folder");
    let inbox = folder.path().join("in");
    fs::create_dir_all(&inbox).expect("a folder");
    for (name, text) in [
        ("take.trc", TRC),
        ("take.csv", FACE),
        ("take.TextGrid", GRID),
        ("words.csv", "gloss,handshape\nBOL,U\n"),
    ] {
        fs::write(inbox.join(name), text).expect("written");
    }
    let (clip, _) = crate::built_in_body().expect("a body");
    let glb = gltf::write_glb(&clip, &gltf::GlbDescription::default()).expect("a GLB");
    fs::write(inbox.join("body.glb"), glb).expect("written");
    let path = folder.path().join("a.chereme");
    let mut corpus = Corpus::create_corpus(&path, "tester").expect("a corpus");
    let mut hear = ignore_progress_step;
    let inbox = [inbox];
    let report = corpus
        .import_paths(&inbox, &ImportOptions::default(), &mut ProgressReceiver::new(&mut hear))
        .expect("an import");
    let refused: Vec<_> = report
        .files
        .iter()
        .filter(|file| file.status == FileStatus::Refused)
        .collect();
    assert!(refused.is_empty(), "{refused:?}");
    let connection = corpus.store.read_connection();
    let take = crate::db::stored_recordings::recording_named(connection, "take")
        .expect("rows")
        .expect("the take");
    let rows = crate::db::stored_tracks::load_track_rows(connection, take.id).expect("rows");
    let kinds: Vec<TrackKind> = rows.iter().map(|row| row.kind).collect();
    assert!(kinds.contains(&TrackKind::Markers), "{kinds:?}");
    assert!(kinds.contains(&TrackKind::Curves), "{kinds:?}");
    let body = crate::db::stored_recordings::recording_named(connection, "body")
        .expect("rows")
        .expect("the body");
    let rows = crate::db::stored_tracks::load_track_rows(connection, body.id).expect("rows");
    assert_eq!(rows[0].kind, TrackKind::Skeleton);
    let found = corpus
        .search_tokens("CHAT", &SearchOptions::default())
        .expect("an answer");
    assert_eq!(found.total, 1);
    let again = corpus
        .import_paths(&inbox, &ImportOptions::default(), &mut ProgressReceiver::new(&mut hear))
        .expect("an import");
    assert_eq!(again.created.get("tracks"), None, "nothing comes twice");
}

#[test]
fn a_body_in_a_unit_that_makes_it_a_giant_is_a_person_with_a_finding() {
    let folder = tempfile::tempdir().expect("a folder");
    let (clip, _) = crate::built_in_body().expect("a body");
    let stature = |clip: &chereme_motion::Clip| {
        let measures = chereme_motion::BodyAnatomy::detect_anatomy(clip.clip_skeleton()).anatomy_measures();
        measures.expect("measures").stature
    };
    let imported = |scale: f64, unit: Option<f64>| {
        let name = format!("body{scale}{}", unit.is_some());
        let path = folder.path().join(format!("{name}.glb"));
        let larger = chereme_motion::SpaceConvention {
            metres_per_unit: scale,
            ..chereme_motion::SpaceConvention::MODEL_CONVENTION
        };
        let glb = gltf::write_glb(&larger.file_clip_to_model(&clip), &gltf::GlbDescription::default()).expect("a GLB");
        fs::write(&path, glb).expect("written");
        let mut corpus = Corpus::create_corpus(&folder.path().join(format!("{name}.chereme")), "A").expect("a corpus");
        let options = ImportOptions {
            metres_per_unit: unit,
            ..ImportOptions::default()
        };
        let mut hear = ignore_progress_step;
        let report = corpus
            .import_paths(&[path], &options, &mut ProgressReceiver::new(&mut hear))
            .expect("an import");
        let reported = report.files[0].findings.iter();
        let reported = reported.filter(|it| it.message.contains("m tall")).count();
        let take = crate::CorpusAddress::Recording(crate::RowName::Number(1));
        let moving = corpus.movement_at_address(&take).expect("movement");
        (stature(&moving.clip), reported)
    };
    let (person, reported) = imported(1.0, None);
    assert!((1.5..1.9).contains(&person) && reported == 0, "{person}");
    for (scale, unit, tall, reported) in [
        (100.0, None, 1.0, 1),
        (0.01, None, 1.0, 1),
        (0.8, None, 0.8, 0),
        (100.0, Some(1.0), 100.0, 0),
    ] {
        let (found, said) = imported(scale, unit);
        assert!((found - person * tall).abs() < 1e-3 * tall, "{scale}: {found}");
        assert_eq!(said, reported, "{scale}");
    }
}

#[test]
fn captures_of_one_name_in_two_folders_are_two_recordings() {
    let desk = Desk::new();
    let folders = ["A", "B"].map(|folder| desk.folder.path().join(folder));
    for (folder, height) in [("A", "900"), ("B", "800")] {
        fs::create_dir(desk.folder.path().join(folder)).expect("made");
        desk.file(&format!("{folder}/take.trc"), &TRC.replace("900", height));
    }
    let mut corpus = desk.corpus("c.chereme");
    let mut hear = ignore_progress_step;
    let report = corpus.import_paths(
        &folders,
        &ImportOptions::default(),
        &mut ProgressReceiver::new(&mut hear),
    );
    let report = report.expect("imported");
    let names: Vec<_> = report.files.iter().map(|it| it.recording.clone()).collect();
    let wanted = ["take", "take (B)"].map(|it| Some(it.to_owned()));
    assert_eq!(names, wanted);
}

#[test]
fn an_import_of_tracks_of_every_kind_is_undone_and_done_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let inbox = folder.path().join("in");
    fs::create_dir_all(&inbox).expect("a folder");
    let (clip, _) = crate::built_in_body().expect("a body");
    fs::write(
        inbox.join("take.glb"),
        gltf::write_glb(&clip, &gltf::GlbDescription::default()).expect("a GLB"),
    )
    .expect("written");
    for (name, text) in [("take.trc", TRC), ("take.csv", FACE), ("take.TextGrid", GRID)] {
        fs::write(inbox.join(name), text).expect("written");
    }
    let drawn = crate::film::tests::film(folder.path(), [64, 48], 25);
    fs::copy(drawn, inbox.join("take.mp4")).expect("copied");
    let mut corpus = Corpus::create_corpus(&folder.path().join("a.chereme"), "A").expect("a corpus");
    let empty = corpus.load_corpus_info().expect("info").counts;
    let mut hear = ignore_progress_step;
    let report = corpus
        .import_paths(
            &[inbox],
            &ImportOptions::default(),
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("an import");
    assert!(!report.has_refusals(), "{report:?}");
    let whole = corpus.load_corpus_info().expect("info");
    let kinds: Vec<&str> = whole.tracks.keys().map(String::as_str).collect();
    assert_eq!(kinds, ["curves", "markers", "media", "skeleton"]);
    assert_eq!(whole.counts["recordings"], 1, "one take");
    corpus.undo_operation().expect("undone");
    let without = |counts: &std::collections::BTreeMap<_, u64>| {
        let mut counts = counts.clone();
        counts.remove("operations");
        counts
    };
    let undone = corpus.load_corpus_info().expect("info");
    assert_eq!(without(&undone.counts), without(&empty));
    assert!(undone.tracks.is_empty(), "{:?}", undone.tracks);
    corpus.redo_operation().expect("done again");
    let again = corpus.load_corpus_info().expect("info");
    assert_eq!(without(&again.counts), without(&whole.counts));
    assert_eq!(again.tracks, whole.tracks);
    let check = corpus
        .check_corpus(false, &mut ProgressReceiver::new(&mut hear))
        .expect("checked");
    assert!(check.ok, "{:?}", check.faults);
}

/// Imports files into a new corpus; returns it with the report.
fn imported(folder: &Path, files: &[PathBuf], options: &ImportOptions) -> (Corpus, ImportReport) {
    let count = fs::read_dir(folder).expect("a folder").count();
    let mut corpus = Corpus::create_corpus(&folder.join(format!("{count}.chereme")), "A").expect("a corpus");
    let report = corpus
        .import_paths(files, options, &mut ProgressReceiver::new(&mut ignore_progress_step))
        .expect("an import");
    (corpus, report)
}

const EXPORT: &str = "Gloss\t\t0.0\t0.1\t0.1\tCHAT\nGloss\t\t0.12\t0.2\t0.08\tCHIEN\n";

#[test]
fn a_table_that_elan_exported_becomes_the_tiers_of_its_take() {
    let folder = tempfile::tempdir().expect("a folder");
    let inbox = folder.path().join("in");
    fs::create_dir_all(&inbox).expect("a folder");
    for (name, text) in [
        ("take.bvh", MOVEMENT),
        ("take.elan.txt", EXPORT),
        ("alone.tsv", EXPORT),
        ("signs.csv", "gloss,handshape\nBOL,U\n"),
    ] {
        fs::write(inbox.join(name), text).expect("written");
    }
    let options = ImportOptions::default();
    let (mut corpus, report) = imported(folder.path(), std::slice::from_ref(&inbox), &options);
    assert!(!report.has_refusals(), "{report:?}");
    assert_eq!(report.created.get("recordings"), Some(&2));
    assert_eq!(report.created.get("annotations"), Some(&4));
    let found = corpus.search_tokens("CHAT", &SearchOptions::default());
    assert_eq!(found.expect("an answer").total, 2);
    let again = corpus
        .import_paths(
            &[inbox],
            &options,
            &mut ProgressReceiver::new(&mut ignore_progress_step),
        )
        .expect("an import");
    assert_eq!(again.created.get("annotations"), None, "nothing comes twice");
    assert_whole(&mut corpus);
}

#[test]
fn the_export_of_an_annotation_file_beside_it_is_left_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let inbox = folder.path().join("in");
    fs::create_dir_all(&inbox).expect("a folder");
    let whole = eaf(&[("Gloss", 0, 100, "CHAT")]);
    for (name, text) in [("take.eaf", &*whole), ("take.eaf.tsv", EXPORT)] {
        fs::write(inbox.join(name), text).expect("written");
    }
    let (_, report) = imported(folder.path(), &[inbox], &ImportOptions::default());
    assert_eq!(report.created.get("recordings"), Some(&1));
    assert_eq!(report.created.get("annotations"), Some(&1));
    let table = report.files.iter().find(|it| it.path.ends_with("tsv"));
    let table = table.expect("its report");
    let reported = |it: &ReportFinding| it.message.contains("an export of take.eaf");
    assert!(table.findings.iter().any(reported), "{table:?}");
}

#[test]
fn annotations_go_to_a_take_of_their_name_elsewhere_only_by_name_and_if_they_fit() {
    for (end, joining, recordings) in [
        (200, FileJoining::Name, 1),
        (200, FileJoining::Certain, 2),
        (9000, FileJoining::Name, 2),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        for (name, text) in [
            ("bvh/take.bvh", MOVEMENT.to_owned()),
            ("eaf/take.eaf", eaf(&[("Gloss", 0, end, "CHAT")])),
        ] {
            let path = folder.path().join("in").join(name);
            fs::create_dir_all(path.parent().expect("a folder")).expect("made");
            fs::write(path, text).expect("written");
        }
        let inbox = [folder.path().join("in")];
        let options = ImportOptions {
            joining,
            ..ImportOptions::default()
        };
        let (_, report) = imported(folder.path(), &inbox, &options);
        assert_eq!(report.created.get("recordings"), Some(&recordings), "{end}");
        let reported = report.files.iter().flat_map(|it| &it.findings);
        let reported = reported.filter(|finding| finding.message.contains("in another folder"));
        assert_eq!(reported.count() as u64, recordings - 1);
        let reasons: Vec<JoinReason> = report
            .joined
            .iter()
            .flat_map(|joined| &joined.files)
            .map(|file| file.by)
            .collect();
        let wanted: &[JoinReason] = if recordings == 1 {
            &[JoinReason::NameElsewhere]
        } else {
            &[]
        };
        assert_eq!(reasons, wanted);
    }
}

#[test]
fn standard_input_has_no_path_of_this_machine() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("take.eaf");
    fs::write(&path, eaf(&[("Gloss", 0, 100, "CHAT")])).expect("written");
    let options = ImportOptions {
        standard_input: Some(path.clone()),
        ..ImportOptions::default()
    };
    let (corpus, report) = imported(folder.path(), &[path], &options);
    assert_eq!(report.files[0].path, "-");
    let files = stored_recordings::source_files(corpus.store.read_connection(), 1).expect("files");
    assert_eq!(files[0].path.as_deref(), Some("-/take.eaf"));
}

#[test]
fn points_and_curves_are_described_in_a_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = [("take.trc", TRC), ("face.csv", FACE)].map(|(name, text)| {
        let path = folder.path().join(name);
        fs::write(&path, text).expect("written");
        path
    });
    let (_, report) = imported(folder.path(), &files, &ImportOptions::default());
    let tracks = report.files.iter().flat_map(|it| it.understood.tracks.iter().flatten());
    let lines: Vec<String> = tracks.filter_map(|it| it.track_description_line()).collect();
    assert!(lines[0].starts_with("track markers: 1 points, 2 frames"), "{lines:?}");
    assert!(lines[0].contains("unit mm, axes up,left = "), "{lines:?}");
    assert!(lines[1].starts_with("track face: 2 curves, 2 frames"), "{lines:?}");
}

#[test]
fn a_body_that_lies_or_hangs_in_its_file_is_righted() {
    use chereme_motion::glam::DQuat;
    use chereme_motion::{BodyPart, Clip, Skeleton};
    use std::f64::consts::{FRAC_PI_2, PI};

    let desk = Desk::new();
    let (clip, anatomy) = crate::built_in_body().expect("a body");
    let [hips, head] = [BodyPart::Hips, BodyPart::Head].map(|part| anatomy.part_joint(part).expect("a joint"));
    for (name, turn, is_odd) in [
        ("standing", DQuat::IDENTITY, false),
        ("turned", DQuat::from_rotation_y(FRAC_PI_2), false),
        ("lying", DQuat::from_rotation_x(-FRAC_PI_2), true),
        ("hanging", DQuat::from_rotation_z(PI), true),
    ] {
        let mut joints = clip.clip_skeleton().skeleton_joints().to_vec();
        joints[0].rest = (turn * joints[0].rest).normalize();
        joints[0].offset = turn * joints[0].offset;
        let mut channels = clip.clone().into_channels();
        for rotation in &mut channels[0].rotations {
            *rotation = (turn * *rotation).normalize();
        }
        for place in channels[0].translations.iter_mut().flatten() {
            *place = turn * *place;
        }
        let skeleton = Skeleton::new(joints).expect("a tree").into();
        let turned = Clip::new(skeleton, clip.clip_frame_rate(), channels).expect("a clip");
        let glb = gltf::write_glb(&turned, &gltf::GlbDescription::default()).expect("a GLB");
        let file = desk.folder.path().join(format!("{name}.glb"));
        fs::write(&file, glb).expect("written");
        for axes in [None, Some("+Y,+X".parse().expect("axes"))] {
            let mut corpus = desk.corpus(&format!("{name}-{}.chereme", axes.is_some()));
            let options = ImportOptions {
                axes,
                ..ImportOptions::default()
            };
            let mut hear = ignore_progress_step;
            let paths = std::slice::from_ref(&file);
            let report = corpus.import_paths(paths, &options, &mut ProgressReceiver::new(&mut hear));
            let report = report.expect("imported").files.remove(0);
            let said = report.findings.iter().any(|it| it.message.contains("is righted"));
            let moving = corpus.movement_at_address(&"recording:1".parse().expect("an address"));
            let pose = moving.expect("a body").clip.model_pose(0);
            let up = pose.model_joint_position(head).y - pose.model_joint_position(hips).y;
            let case = format!("{name} {axes:?}: {up} {:?}", report.findings);
            assert_eq!(said, is_odd && axes.is_none(), "{case}");
            assert_eq!(up > 0.4, !is_odd || axes.is_none(), "{case}");
        }
    }
}
