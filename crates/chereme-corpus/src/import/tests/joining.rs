//! Tests of what joins files into one recording, of the questions instead of other joins, and of equal bytes.

use super::again::{has, take};
use super::*;

const GRID: &str = "\"ooTextFile\" \"TextGrid\" 0 0.2 <exists> 1 \"IntervalTier\" \"Words\" 0 0.2 1 0 0.2 \"cat\"";
const SUBTITLES: &str = "1\n00:00:00,000 --> 00:00:00,200\na cat\n";

fn joining(joining: FileJoining) -> ImportOptions {
    ImportOptions {
        joining,
        ..ImportOptions::default()
    }
}

/// Writes files into folders of their own, and returns the folder of all.
fn folder(desk: &Desk, files: &[(&str, &str)]) -> PathBuf {
    let inbox = desk.folder.path().join("in");
    for (name, text) in files {
        let path = inbox.join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        fs::write(path, text).expect("written");
    }
    inbox
}

fn names(corpus: &Corpus) -> Vec<String> {
    let rows = stored_recordings::load_recording_rows(corpus.store.read_connection()).expect("rows");
    rows.into_iter().map(|row| row.name).collect()
}

/// Returns the recordings that files joined, as `recording: file, file`.
fn joined(report: &ImportReport) -> Vec<String> {
    let line = |recording: &JoinedRecording| {
        let files: Vec<String> = recording
            .files
            .iter()
            .map(|file| format!("{} ({:?})", file.path.rsplit('/').next().unwrap_or_default(), file.by))
            .collect();
        format!("{}: {}", recording.recording, files.join(", "))
    };
    report.joined.iter().map(line).collect()
}

/// A table of a face of 60 frames a second.
fn face(hour: &str, jaw: &str) -> String {
    let rows = (0..30).map(|frame| format!("{hour}:00:00:{frame:02}.0,61,{jaw}{frame}\n"));
    "Timecode,BlendShapeCount,JawOpen\n".to_owned() + &rows.collect::<String>()
}

#[test]
fn annotations_of_one_name_in_different_folders_stay_apart_and_are_asked_about() {
    let desk = Desk::new();
    let tiers = eaf(&[("Gloss", 0, 200, "CHAT")]);
    let inbox = folder(
        &desk,
        &[
            ("S1/take01.TextGrid", GRID),
            ("S2/take01.eaf", &tiers),
            ("S3/take01.srt", SUBTITLES),
        ],
    );
    let paths = [inbox];
    let mut corpus = desk.corpus("c.chereme");
    let report = take(&mut corpus, &paths, &ImportOptions::default());
    assert_eq!(names(&corpus).len(), 3, "{report:?}");
    assert!(joined(&report).is_empty());
    let questions = report.files.iter().flat_map(|file| &file.findings);
    let questions: Vec<_> = questions
        .filter(|finding| finding.message.contains("in other folders"))
        .collect();
    assert_eq!(questions.len(), 1, "the last of three may belong to two: {report:?}");
    assert!(questions[0].remedy.is_some());
    // With the name as evidence, two candidates are still a question.
    let mut apart = desk.corpus("d.chereme");
    let folders = ["S2", "S1", "S3"].map(|name| desk.folder.path().join("in").join(name));
    take(&mut apart, &folders[..1], &joining(FileJoining::Name));
    let second = take(&mut apart, &folders[1..2], &joining(FileJoining::Certain));
    assert!(
        has(
            &second.files[0].findings,
            "the recording \"take01\" (in/S2/take01.eaf) has its name in another folder"
        ),
        "{second:?}"
    );
    let third = take(&mut apart, &folders[2..], &joining(FileJoining::Name));
    assert!(has(&third.files[0].findings, "it was joined with none"), "{third:?}");
    assert_eq!(names(&apart).len(), 3);
}

#[test]
fn the_report_says_which_files_are_one_recording_and_why() {
    let desk = Desk::new();
    let tiers = eaf(&[("Gloss", 0, 200, "CHAT")]);
    let inbox = folder(
        &desk,
        &[
            ("A/take.bvh", MOVEMENT),
            ("A/take.eaf", &tiers),
            ("B/take.TextGrid", GRID),
        ],
    );
    let mut corpus = desk.corpus("c.chereme");
    let report = take(&mut corpus, std::slice::from_ref(&inbox), &joining(FileJoining::Name));
    assert_eq!(
        joined(&report),
        ["take: take.TextGrid (NameElsewhere), take.eaf (FolderAndName)"]
    );
    assert!(report.joined[0].with.ends_with("A/take.bvh"));
    let json = serde_json::to_value(&report).expect("JSON");
    assert_eq!(json["joined"][0]["files"][0]["by"], "name-elsewhere");
    let eaf_report = report
        .files
        .iter()
        .find(|file| file.path.ends_with(".eaf"))
        .expect("its report");
    assert!(eaf_report.joined.is_some());
    let again = take(&mut corpus, &[inbox], &ImportOptions::default());
    assert!(again.joined.is_empty(), "{again:?}");
}

#[test]
fn faces_that_begin_as_programs_without_a_clock_are_takes_of_their_own() {
    let desk = Desk::new();
    let tiers = eaf(&[("Gloss", 0, 200, "CHAT")]);
    let mut files = Vec::new();
    for name in ["N1", "N2", "Y1"] {
        files.push((format!("{name}.csv"), face("00", &format!("0.{}", files.len()))));
        files.push((format!("{name}.eaf"), tiers.clone()));
    }
    let files: Vec<(&str, &str)> = files
        .iter()
        .map(|(name, text)| (name.as_str(), text.as_str()))
        .collect();
    let inbox = folder(&desk, &files);
    let mut corpus = desk.corpus("c.chereme");
    let report = take(&mut corpus, &[inbox], &ImportOptions::default());
    assert!(!report.has_refusals(), "{report:?}");
    assert_eq!(names(&corpus), ["N1", "N2", "Y1"]);
}

#[test]
fn a_timecode_joins_only_what_one_person_did_in_one_folder() {
    for (hour, other_signer, wanted) in [("14", false, 1), ("14", true, 2), ("00", false, 2), ("10", false, 2)] {
        let desk = Desk::new();
        let long = MOVEMENT
            .replace("Frames: 2", "Frames: 5")
            .replace("0 0 0\n0 0 1\n", &"0 0 1\n".repeat(5));
        let inbox = folder(&desk, &[("body.bvh", &long), ("phone.csv", &face(hour, "0.5"))]);
        let mut corpus = desk.corpus("c.chereme");
        let clock = ImportOptions {
            clock: time_of_day(&format!("{hour}:00:00:00")),
            signer: Some("S1".to_owned()),
            ..ImportOptions::default()
        };
        take(&mut corpus, &[inbox.join("body.bvh")], &clock);
        let options = ImportOptions {
            signer: Some(if other_signer { "S2" } else { "S1" }.to_owned()),
            ..ImportOptions::default()
        };
        let report = take(&mut corpus, &[inbox.join("phone.csv")], &options);
        assert_eq!(names(&corpus).len(), wanted, "{hour} {other_signer} {report:?}");
        let asked = has(&report.files[0].findings, "it was not joined with that");
        assert_eq!(asked, wanted == 2 && !other_signer, "{report:?}");
        if other_signer {
            let signers = stored_recordings::find_signer(corpus.store.read_connection(), "S2");
            assert!(signers.expect("read").is_some(), "the signer is not lost");
        }
    }
}

#[test]
fn copies_with_equal_bytes_are_named_whatever_their_kind() {
    let desk = Desk::new();
    let tiers = eaf(&[("Gloss", 0, 200, "CHAT")]);
    let inbox = folder(
        &desk,
        &[
            ("take.eaf", &tiers),
            ("take (1).eaf", &tiers),
            ("backup/take.eaf", &tiers),
            ("words.TextGrid", GRID),
            ("words copy.TextGrid", GRID),
            ("body.bvh", MOVEMENT),
            ("body copy.bvh", MOVEMENT),
        ],
    );
    let mut corpus = desk.corpus("c.chereme");
    let report = take(&mut corpus, &[inbox], &ImportOptions::default());
    let is_named = |file: &&FileReport| has(&file.findings, "its bytes are the same as those of");
    assert_eq!(report.files.iter().filter(is_named).count(), 4, "{report:?}");
}

#[test]
fn annotations_join_the_film_that_they_name_in_another_folder() {
    let desk = Desk::new();
    let film = super::film::film(&desk, "films/front.mp4");
    let text = super::film::naming("front.mp4").replace("file:///D:/gone", "../films");
    let inbox = folder(&desk, &[("take.eaf", &text)]);
    let mut corpus = desk.corpus("c.chereme");
    take(&mut corpus, &[film], &ImportOptions::default());
    let report = take(&mut corpus, &[inbox], &ImportOptions::default());
    assert_eq!(joined(&report), ["front: take.eaf (NamedFilm)"], "{report:?}");
    assert_eq!(names(&corpus), ["front"]);
}
