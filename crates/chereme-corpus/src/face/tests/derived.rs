//! Tests of derived faces: weights fitted to a signer, leaning trunks, points on film.

use std::fmt::Write as _;
use std::path::Path;

use chereme_formats::table::annotations::TableMoment;
use chereme_motion::{BodyPart, RecordingInstant};
use chereme_sign::TierRole;

use crate::address::{CorpusAddress, RowName};
use crate::annotate::{AnnotateOptions, AnnotationAction, NewTier, TierRequestName};
use crate::edit::RecordingChange;
use crate::{
    ChooseOptions, Corpus, ImportOptions, PictureOptions, ProgressReceiver, SearchOptions, ignore_progress_step,
};

fn import(corpus: &mut Corpus, path: &Path) {
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let report = corpus.import_paths(&[path.to_path_buf()], &ImportOptions::default(), progress);
    let report = report.expect("imported");
    assert!(report.files[0].recording.is_some(), "{report:?}");
}

fn recording(name: &str) -> CorpusAddress {
    CorpusAddress::Recording(RowName::Text(name.to_owned()))
}

fn add(corpus: &mut Corpus, name: &str, tier: &str, role: TierRole, spans: &[(&str, i64, i64)]) {
    let of = RowName::Text(name.to_owned());
    corpus.add_tier(&NewTier::new(of.clone(), tier, role)).expect("a tier");
    let time = |millis| Some(TableMoment::Time(RecordingInstant::from_millis(millis)));
    let add = |(value, start, end): &(&str, i64, i64)| {
        AnnotationAction::Add {
            tier: TierRequestName::Of {
                recording: of.clone(),
                tier: tier.to_owned(),
            },
            start: time(*start),
            end: time(*end),
            parent: None,
            order: None,
            value: (*value).to_owned(),
            confidence: None,
        }
        .into()
    };
    let changes: Vec<_> = spans.iter().map(add).collect();
    let mut hear = ignore_progress_step;
    corpus
        .annotate_corpus(
            &changes,
            &AnnotateOptions::default(),
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("annotated");
}

/// Writes a face whose brows rise to `most` and whose eyes do not move.
fn write_brows(path: &Path, most: f64) {
    let mut text = String::from("time [s],brow_raise_right,brow_raise_left,jaw_open,head_yaw\n");
    for frame in 0..120 {
        let up = if (40..70).contains(&frame) { most } else { 0.0 };
        let at = f64::from(frame) / 60.0;
        writeln!(text, "{at:.6},{up},{up},0,0").expect("text");
    }
    std::fs::write(path, text).expect("written");
}

#[test]
fn weights_fitted_on_one_take_are_those_of_all_faces_of_the_signer_and_undo_takes_them_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("a.chereme"), "A").expect("made");
    for (name, most) in [("rom", 0.4), ("W1", 0.2), ("other", 0.3)] {
        let path = folder.path().join(format!("{name}.csv"));
        write_brows(&path, most);
        import(&mut corpus, &path);
        if name != "other" {
            let change = RecordingChange {
                signer: Some(Some("Zoé".to_owned())),
                ..RecordingChange::default()
            };
            corpus
                .change_recording(&RowName::Text(name.into()), &change)
                .expect("a signer");
        }
    }
    let brows = |corpus: &Corpus, name: &str| {
        let face = corpus.report_captured_face(&recording(name)).expect("a face");
        let number = face.numbers.iter().find(|it| it.name == "brow_raise_left");
        (number.and_then(|it| it.most).expect("known"), face.fitted_on)
    };
    let tried = corpus.fit_face(&recording("rom"), false).expect("fitted");
    assert!(!tried.stored && tried.findings.iter().any(|it| it.message.contains("jaw_open")));
    assert_eq!(brows(&corpus, "W1"), (0.2, None));
    let fit = corpus.fit_face(&recording("rom"), true).expect("fitted");
    assert_eq!((fit.signer.as_deref(), fit.stored), (Some("Zoé"), true));
    let brow = fit.numbers.iter().find(|it| it.name == "brow_raise_left");
    assert_eq!(brow.map(|it| (it.rest, it.up, it.down)), Some((0.0, 2.5, 1.0)));
    assert_eq!(brows(&corpus, "W1"), (0.5, Some("rom".to_owned())));
    assert_eq!(brows(&corpus, "rom").0, 1.0);
    assert_eq!(brows(&corpus, "other"), (0.3, None), "of no signer");
    let mut hear = ignore_progress_step;
    let report = corpus
        .check_corpus(false, &mut ProgressReceiver::new(&mut hear))
        .expect("checked");
    assert!(report.faults.is_empty(), "{report:?}");
    corpus.undo_operation().expect("undone");
    assert_eq!(brows(&corpus, "W1"), (0.2, None));
}

/// Writes an OpenFace capture in which the head moves forward by 0.2 m in the middle, with one frame without a face.
fn write_open_face(path: &Path) {
    let mut text = String::from(
        "frame,timestamp,confidence,success,gaze_angle_x,gaze_angle_y,pose_Tx,pose_Ty,pose_Tz,pose_Rx,pose_Ry,pose_Rz,\
         AU01_r,AU02_r,AU04_r,AU05_r,AU07_r,AU12_r,AU15_r,AU45_r\n",
    );
    for frame in 0..90 {
        let near = if (30..60).contains(&frame) { 500 } else { 700 };
        let (sure, found, up) = if frame == 5 { (0.1, 0, 5.0) } else { (0.98, 1, 0.0) };
        let at = f64::from(frame) / 30.0;
        writeln!(
            text,
            "{frame},{at:.3},{sure},{found},0,0,0,0,{near},0.05,0,0,{up},{up},0,0,0,0,0,0"
        )
        .expect("text");
    }
    std::fs::write(path, text).expect("written");
}

#[test]
fn a_head_that_comes_forward_leans_the_trunk_and_lost_faces_count_as_gaps() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("a.chereme"), "A").expect("made");
    let path = folder.path().join("lean.csv");
    write_open_face(&path);
    import(&mut corpus, &path);
    add(
        &mut corpus,
        "lean",
        "gloss",
        TierRole::Gloss,
        &[("VOR", 1_200, 1_800), ("HINTEN", 2_200, 2_900)],
    );
    let face = corpus.report_captured_face(&recording("lean")).expect("a face");
    assert_eq!((face.system.as_str(), face.bridged), ("openface", 1));
    let brow = face.numbers.iter().find(|it| it.name == "brow_raise_left");
    assert_eq!(brow.and_then(|it| it.most), Some(0.0), "the lost frame does not count");
    let answer = corpus.search_tokens("nonmanual.trunk_pitch>5", &SearchOptions::default());
    let hits = answer.expect("answered").hits;
    assert_eq!(hits.iter().map(|it| it.gloss.as_str()).collect::<Vec<_>>(), ["VOR"]);
    let moving = corpus.movement_at_address(&recording("lean")).expect("movement");
    let head = moving.anatomy.part_joint(BodyPart::Head).expect("a head");
    let at = |frame: usize| moving.clip.model_pose(frame);
    let forward = at(45).model_joint_position(head).z - at(80).model_joint_position(head).z;
    assert!(forward > 0.05, "the head comes forward by {forward} m");
    let turned = at(45)
        .model_joint_rotation(head)
        .angle_between(at(80).model_joint_rotation(head));
    assert!(turned < 1e-3, "and does not nod with the trunk: {turned}");
}

/// Points on film from other programs are faces: they can be displayed, proposed from, cut by milestones and scored.
#[test]
fn points_on_film_are_faces_for_every_use() {
    let Some(data) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return;
    };
    let data = Path::new(&data).join("motion/pose/sign-language-processing-pose");
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("a.chereme"), "A").expect("made");
    let names = ["mediapipe", "84322c38ff23406f222641da30d0a49b"];
    for name in names {
        import(&mut corpus, &data.join(format!("{name}.pose")));
        add(
            &mut corpus,
            name,
            "gloss",
            TierRole::Gloss,
            &[("A", 300, 700), ("B", 800, 1_200)],
        );
        add(&mut corpus, name, "function", TierRole::Free, &[("wh", 300, 1_200)]);
    }
    let face = corpus.report_captured_face(&recording(names[0])).expect("a face");
    assert_eq!((face.system.as_str(), face.frames), ("mesh", 170));
    assert!(
        face.findings
            .iter()
            .any(|it| it.message.contains("estimated from points"))
    );
    let moving = corpus.movement_at_address(&recording(names[0])).expect("movement");
    assert!(moving.faces.iter().any(|face| face.jaw > 0.3), "the mouth opens");
    let options = ChooseOptions::default();
    let of = |a: &str, b: &str| {
        let both = [&recording(a), &recording(b)];
        corpus.score_faces(both, None, &options).expect("scored")
    };
    assert_eq!(of(names[0], names[0]).stretched, 0.0);
    assert!(of(names[0], names[1]).stretched > 0.1);
    let fault = corpus.fit_face(&recording(names[0]), true).expect_err("points");
    assert!(fault.to_string().contains("points on film"), "{fault}");
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    for name in names {
        let found = corpus.propose_nonmanuals(&recording(name), false, progress);
        let found = found.expect("looked at").proposals;
        assert!(!found.is_empty(), "{name}");
        eprintln!("{name}: {:?}", found.iter().map(|it| &it.value).collect::<Vec<_>>());
    }
}

#[test]
fn the_face_stands_next_to_the_signer_in_sheets_and_animations_by_option() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("a.chereme"), "A").expect("made");
    let path = folder.path().join("W1.csv");
    write_brows(&path, 0.8);
    import(&mut corpus, &path);
    let mut draw = |name: &str, face: bool| {
        let to = folder.path().join(name);
        let options = PictureOptions {
            frames: 2,
            hands: false,
            face,
            height: Some(64),
            speed: 10.0,
            force: true,
            ..PictureOptions::default()
        };
        let mut hear = ignore_progress_step;
        let progress = &mut ProgressReceiver::new(&mut hear);
        corpus
            .draw_movement_file(&recording("W1"), &to, &options, progress)
            .expect("drawn");
        std::fs::read(&to).expect("read")
    };
    let height = |png: &[u8]| u32::from_be_bytes(png[20..24].try_into().expect("four bytes"));
    let width = |gif: &[u8]| u16::from_le_bytes(gif[6..8].try_into().expect("two bytes"));
    assert!(height(&draw("b.png", true)) >= height(&draw("a.png", false)) + 60);
    assert!(width(&draw("b.gif", true)) >= width(&draw("a.gif", false)) + 55);
    assert_ne!(draw("b.mp4", true), draw("a.mp4", false));
}

/// Writes a capture at 60 rows a second of `seconds`, without rows in `gap`, whose jaw is open by 0.9 in `open`.
fn write_jaw(path: &Path, seconds: f64, gap: (f64, f64), open: (f64, f64)) {
    let mut text = String::from("time [s],jaw_open,brow_raise_right\n");
    for frame in 0..(seconds * 60.0) as usize {
        let at = frame as f64 / 60.0;
        if at > gap.0 && at < gap.1 {
            continue;
        }
        let jaw = if at > open.0 && at < open.1 { 0.9 } else { 0.0 };
        writeln!(text, "{at:.6},{jaw},0").expect("text");
    }
    std::fs::write(path, text).expect("written");
}

#[test]
fn gaps_and_the_time_after_a_capture_show_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    let path = folder.path().join("F.csv");
    write_jaw(&path, 4.0, (1.05, 1.995), (0.98, 2.04));
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let report = corpus
        .import_paths(&[path], &ImportOptions::default(), progress)
        .expect("imported");
    let findings = &report.files[0].findings;
    let warned = |it: &str| it.starts_with("gaps in its rows: 1, 0.950 s in all, the longest after 1.050 s");
    assert!(findings.iter().any(|it| warned(&it.message)), "{findings:?}");
    let signs = [
        ("BEFORE", 500, 1_020),
        ("INGAP", 1_300, 1_700),
        ("AROUND", 900, 2_200),
        ("LATER", 3_000, 3_500),
    ];
    for (n, sign) in signs.into_iter().enumerate() {
        add(&mut corpus, "F", &format!("Gloss {n}"), TierRole::Gloss, &[sign]);
    }
    let mut found = |query: &str| -> Vec<String> {
        let answer = corpus.search_tokens(query, &SearchOptions::default());
        let hits = answer.expect("an answer").hits;
        let mut names: Vec<String> = hits.into_iter().map(|hit| hit.gloss).collect();
        names.sort();
        names
    };
    assert_eq!(found("nonmanual.jaw_open>0.5"), ["AROUND", "BEFORE"]);
    assert_eq!(found("nonmanual.jaw_open>0.5 for 0.2s"), [""; 0]);
    assert_eq!(found("nonmanual.jaw_open<0.5"), ["AROUND", "BEFORE", "LATER"]);
    assert_eq!(found("not nonmanual.jaw_open<2"), ["INGAP"]);
    let found = corpus.propose_nonmanuals(&recording("F"), false, progress);
    let proposals = found.expect("looked at").proposals;
    let inside = |it: &&crate::ProposedAnnotation| it.start_us < 1_900_000 && it.end_us > 1_100_000;
    assert_eq!(proposals.iter().find(inside), None);
}

#[test]
fn peaks_of_one_row_and_late_ones_are_found_and_runs_count_within_the_token() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    // A row every 10 s of three hours, and one peak between two points of a grid of 50 a second.
    let path = folder.path().join("L.csv");
    let mut text = String::from("time [s],jaw_open,brow_raise_right\n");
    for row in 0..1_080 {
        let jaw = if row % 100 == 50 { 0.9 } else { 0.0 };
        writeln!(text, "{},{jaw},0", row * 10).expect("text");
    }
    std::fs::write(&path, text).expect("written");
    import(&mut corpus, &path);
    let path = folder.path().join("P.csv");
    write_jaw(&path, 4.0, (9.0, 9.0), (0.51, 0.52));
    import(&mut corpus, &path);
    let path = folder.path().join("R.csv");
    write_jaw(&path, 4.0, (9.0, 9.0), (0.99, 1.99));
    import(&mut corpus, &path);
    for (name, sign) in [
        ("L", ("EARLY", 499_000, 501_000)),
        ("L", ("LATE", 10_499_000, 10_501_000)),
        ("P", ("PEAK", 400, 600)),
        ("R", ("EDGE", 1_900, 2_900)),
    ] {
        add(
            &mut corpus,
            name,
            &format!("Gloss {}", sign.0),
            TierRole::Gloss,
            &[sign],
        );
    }
    let mut found = |query: &str| -> Vec<String> {
        let answer = corpus.search_tokens(query, &SearchOptions::default());
        let hits = answer.expect("an answer").hits;
        let mut names: Vec<String> = hits.into_iter().map(|hit| hit.gloss).collect();
        names.sort();
        names
    };
    assert_eq!(found("nonmanual.jaw_open>0.8"), ["EARLY", "EDGE", "LATE", "PEAK"]);
    assert_eq!(found("nonmanual.jaw_open>0.7 for 0.08s recording=R"), ["EDGE"]);
    assert_eq!(found("nonmanual.jaw_open>0.7 for 0.5s recording=R"), [""; 0]);
}

/// Writes a face of 12 s at 60 frames a second, whose brows rise again and again.
fn write_long_face(path: &Path) {
    let mut text = String::from("time [s],brow_raise_right,brow_raise_left,jaw_open\n");
    for frame in 0..720 {
        let seconds = f64::from(frame) / 60.0;
        let up = (seconds * 2.0).sin().max(0.0);
        writeln!(text, "{seconds:.6},{up:.6},{up:.6},0.1").expect("text");
    }
    std::fs::write(path, text).expect("written");
}

#[test]
fn a_skeletons_head_is_not_held_where_the_face_lasts_longer() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("a.chereme"), "A").expect("made");
    let (_, bytes) = crate::starter_files()
        .find(|(file, _)| file.ends_with("phrase.bvh"))
        .expect("a starter capture");
    let movement = folder.path().join("phrase.bvh");
    std::fs::write(&movement, bytes).expect("written");
    let face = folder.path().join("phrase.csv");
    write_long_face(&face);
    let mut hear = ignore_progress_step;
    let options = ImportOptions::default();
    corpus
        .import_paths(&[movement, face], &options, &mut ProgressReceiver::new(&mut hear))
        .expect("imported");
    let connection = corpus.store.read_connection();
    let fits = crate::curves::face_fits::CorpusFits::load_corpus_fits(connection).expect("fits");
    // The capture of the body ends after 6.37 s, that of the face after 12 s.
    let moments: Vec<RecordingInstant> = [1000, 6000, 6360, 6500, 9000, 13_000]
        .map(RecordingInstant::from_millis)
        .to_vec();
    let found = super::performances::sample_channel_numbers(connection, 1, &moments, &[0, 3], &fits);
    let found = found.expect("read").expect("a face");
    let known = |channel: usize| -> Vec<bool> {
        let numbers = found[channel].as_ref().expect("a channel");
        numbers.iter().map(|it| it.is_finite()).collect()
    };
    assert_eq!(known(0), [true, true, true, false, false, false]);
    assert_eq!(known(1), [true, true, true, true, true, false]);
}

#[test]
fn curves_that_are_read_in_pieces_are_those_of_the_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("a.chereme"), "A").expect("made");
    let face = folder.path().join("long.csv");
    write_long_face(&face);
    import(&mut corpus, &face);
    let connection = corpus.store.read_connection();
    let row = crate::address::find_recording_by_name(connection, &RowName::Number(1)).expect("a recording");
    let read = |piece: usize| {
        let curves = crate::detect::detect_faces::FaceCurves::in_pieces(connection, &row, piece);
        let curves = curves.expect("read").expect("a face");
        let brow = curves.detector_curves().brow_raise[0].expect("a brow").to_vec();
        (brow, curves.detector_curves().head_yaw.is_some())
    };
    let whole = read(432_000);
    assert_eq!(whole.0.len(), 720);
    for piece in [1, 100, 719, 720] {
        assert_eq!(read(piece), whole, "{piece}");
    }
}
