//! Tests of files that are imported again with options for another reading.

use super::*;
use crate::db::stored_recordings::{MotionTrackRow, RecordingRow, SignerRow};
use chereme_formats::gltf;

const WHOLE: &str = chereme_data::starter_text("bol.bvh");

/// Returns the movement with its root's positions in metres, and those of its bones in centimetres.
fn root_in_metres() -> String {
    let mut moving = false;
    let line = |line: &str| {
        let mut numbers: Vec<String> = line.split(' ').map(str::to_owned).collect();
        if moving && numbers.len() > 3 {
            for number in &mut numbers[..3] {
                let value: f64 = number.parse().expect("a number");
                *number = format!("{:.6}", value / 100.0);
            }
        }
        moving |= line.starts_with("Frame Time");
        numbers.join(" ") + "\n"
    };
    WHOLE.lines().map(line).collect()
}

fn take(corpus: &mut Corpus, path: &Path, options: &ImportOptions) -> ImportReport {
    let mut hear = ignore_progress_step;
    let report = corpus.import_paths(&[path.to_owned()], options, &mut ProgressReceiver::new(&mut hear));
    report.expect("imported")
}

/// Returns the rows of the only recording, of its body, and of its signer.
fn rows(corpus: &Corpus) -> (RecordingRow, MotionTrackRow, Option<SignerRow>) {
    let connection = corpus.store.read_connection();
    let [id] = recordings_of(corpus)[..] else {
        panic!("one recording");
    };
    let recording = stored_recordings::load_recording_row(connection, id).expect("read");
    let body = stored_recordings::body_track(connection, id).expect("read");
    let signer = recording
        .signer_id
        .map(|id| stored_recordings::find_signer_row(connection, id));
    let signer = signer.and_then(|it| it.expect("read"));
    (recording, body.expect("a body"), signer)
}

/// The options of the tests, and the note about each.
fn options() -> Vec<(ImportOptions, &'static str)> {
    let none = ImportOptions::default;
    let signed = |handedness: Option<&str>| ImportOptions {
        signer: Some("Anna".to_owned()),
        handedness: handedness.map(str::to_owned),
        ..none()
    };
    vec![
        (
            ImportOptions {
                mend_root: true,
                ..none()
            },
            "factor for the root's positions: 100 (before: 1)",
        ),
        (
            ImportOptions {
                metres_per_unit: Some(0.5),
                ..none()
            },
            "unit of length: 0.5 m (before: 0.01 m)",
        ),
        (
            ImportOptions {
                axes: Some("+Z,-X".parse().expect("axes")),
                ..none()
            },
            "axes up,left: +Z,-X (before: +Y,+X)",
        ),
        (
            ImportOptions {
                roles: Some("right wrist = RightForeArm".parse().expect("roles")),
                ..none()
            },
            "the parts of the body are those of the roles file",
        ),
        (signed(None), "signer: Anna (before: –)"),
        (signed(Some("left")), "dominant hand of \"Anna\": left (before: –)"),
        (
            ImportOptions {
                origin: Some(RecordOrigin::Made),
                ..none()
            },
            "origin: made (before: captured)",
        ),
        (
            ImportOptions {
                licence: Some("CC0".to_owned()),
                ..none()
            },
            "licence: CC0 (before: –)",
        ),
    ]
}

#[test]
fn an_unchanged_motion_file_is_read_again_as_the_options_say() {
    let desk = Desk::new();
    let path = desk.file("take.bvh", &root_in_metres());
    let tiers = desk.file("take.eaf", &eaf(&[("Gloss", 0, 200, "BOL")]));
    let mut corpus = desk.corpus("c.chereme");
    for path in [&path, &tiers] {
        take(&mut corpus, path, &ImportOptions::default());
    }
    let mut states = vec![rows(&corpus)];
    for (options, note) in options() {
        let report = take(&mut corpus, &path, &options);
        let file = &report.files[0];
        assert_eq!(file.status, FileStatus::Updated, "{note}: {file:?}");
        let notes: Vec<&str> = file.findings.iter().map(|it| it.message.as_str()).collect();
        assert!(notes.contains(&note), "{note}: {notes:?}");
        assert_eq!(report.changed.values().sum::<u64>(), 1, "{note}: {report:?}");
        assert_eq!(said(&corpus), ["Gloss 0 BOL"]);
        let now = rows(&corpus);
        let before = states.last().expect("a state");
        assert_ne!(now, *before, "{note}");
        assert_eq!((now.0.id, now.1.id), (before.0.id, before.1.id), "{note}");
        assert_eq!(now.1.skeleton_id, before.1.skeleton_id);
        assert_whole(&mut corpus);
        states.push(now);
        // The same once more changes nothing.
        let same = take(&mut corpus, &path, &options);
        assert_eq!(same.files[0].status, FileStatus::Unchanged, "{note}: {same:?}");
        assert_eq!(rows(&corpus), *states.last().expect("a state"), "{note}");
        corpus.undo_operation().expect("undone");
        if corpus_is(&corpus, states.last()) {
            corpus.undo_operation().expect("undone");
        }
        assert!(corpus_is(&corpus, states.iter().rev().nth(1)), "{note}");
        corpus.redo_operation().expect("redone");
    }
    let mut one = desk.corpus("d.chereme");
    let all = ImportOptions {
        mend_root: true,
        metres_per_unit: Some(0.5),
        roles: Some("right wrist = RightForeArm".parse().expect("roles")),
        ..ImportOptions::default()
    };
    take(&mut one, &path, &all);
    let (at_once, later) = (rows(&one).1, &states.last().expect("a state").1);
    let at_once = MotionTrackRow {
        axes: later.axes.clone(),
        ..at_once
    };
    assert_eq!(at_once, *later, "as if the first import had had the options");
    let moves = |corpus: &Corpus| {
        let connection = corpus.store.read_connection();
        let track = crate::movement::MotionTrack::open_motion_track(connection, recordings_of(corpus)[0]);
        let track = track.expect("a track");
        track
            .raw_clip(connection, 0..track.motion_frame_count())
            .expect("a clip")
    };
    assert_eq!(moves(&one), moves(&corpus));
}

fn corpus_is(corpus: &Corpus, state: Option<&(RecordingRow, MotionTrackRow, Option<SignerRow>)>) -> bool {
    Some(&rows(corpus)) == state
}

#[test]
fn an_unchanged_scene_is_read_again_as_the_options_say() {
    let folder = tempfile::tempdir().expect("a folder");
    let (clip, _) = crate::built_in_body().expect("a body");
    let path = folder.path().join("body.glb");
    fs::write(
        &path,
        gltf::write_glb(&clip, &gltf::GlbDescription::default()).expect("in reach"),
    )
    .expect("written");
    let mut corpus = Corpus::create_corpus(&folder.path().join("a.chereme"), "A").expect("made");
    take(&mut corpus, &path, &ImportOptions::default());
    let before = rows(&corpus).1;
    let options = ImportOptions {
        metres_per_unit: Some(0.5),
        roles: Some("right wrist = RightForeArm".parse().expect("roles")),
        ..ImportOptions::default()
    };
    let report = take(&mut corpus, &path, &options);
    assert_eq!(report.files[0].status, FileStatus::Updated, "{report:?}");
    let now = rows(&corpus).1;
    assert_eq!((now.id, now.metres_per_unit), (before.id, 0.5));
    assert_ne!(now.channel_groups, before.channel_groups);
    assert_whole(&mut corpus);
    let again = take(&mut corpus, &path, &options);
    assert_eq!(again.files[0].status, FileStatus::Unchanged, "{again:?}");
}

#[test]
fn an_unchanged_annotation_file_takes_back_edits_if_it_is_to() {
    let desk = Desk::new();
    let path = desk.file(
        "one.eaf",
        &eaf(&[("A", 0, 500, "BOL"), ("B", 0, 500, "CHAT"), ("C", 0, 500, "ROI")]),
    );
    let mut corpus = desk.corpus("c.chereme");
    take(&mut corpus, &path, &ImportOptions::default());
    let original = said(&corpus);
    let done = corpus.store.named_operation("annotate", |connection| {
        use crate::db::stored_tiers;
        for tier in stored_tiers::load_tier_rows(connection, 1)? {
            for mut row in stored_tiers::load_tier_annotation_rows(connection, tier.id)? {
                match row.value.as_str() {
                    "CHAT" => stored_tiers::delete_annotation(connection, row.id)?,
                    "BOL" => {
                        "mine".clone_into(&mut row.value);
                        stored_tiers::update_annotation(connection, &row)?;
                    }
                    _ => {}
                }
            }
        }
        Ok(((), String::new()))
    });
    done.expect("edited");
    let edited = said(&corpus);
    let choose = |own_edits| ImportOptions {
        own_edits,
        ..ImportOptions::default()
    };
    for (choice, status, changes, after) in [
        (OwnEdits::Ask, FileStatus::Unchanged, 0, &edited),
        (OwnEdits::Mine, FileStatus::Unchanged, 0, &edited),
        (OwnEdits::Merge, FileStatus::Unchanged, 0, &edited),
        (OwnEdits::Theirs, FileStatus::Updated, 2, &original),
        (OwnEdits::Theirs, FileStatus::Unchanged, 0, &original),
    ] {
        let report = take(&mut corpus, &path, &choose(choice));
        assert_eq!(report.files[0].status, status, "{choice:?}: {report:?}");
        assert_eq!(said(&corpus), *after, "{choice:?}");
        let rows = [&report.created, &report.changed].map(|it| it.get("annotations").copied());
        assert_eq!(rows.into_iter().flatten().sum::<u64>(), changes, "{report:?}");
        assert_eq!(report.files[0].edits.len() as u64, changes, "{report:?}");
        assert_whole(&mut corpus);
    }
    let signed = ImportOptions {
        signer: Some("Anna".to_owned()),
        offset_us: 5,
        ..ImportOptions::default()
    };
    let report = take(&mut corpus, &path, &signed);
    let said: Vec<&str> = report.files[0].findings.iter().map(|it| it.message.as_str()).collect();
    assert!(said.contains(&"signer: Anna (before: –)"), "{said:?}");
    assert!(said.iter().any(|it| it.contains("--offset has no effect")), "{said:?}");
}
