//! Tests of files that are unusual as files: names that are not UTF-8, pipes, sizes.

use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt as _;

use super::*;

/// Imports paths and returns the complete report.
fn take(corpus: &mut Corpus, paths: &[PathBuf]) -> ImportReport {
    let mut hear = ignore_progress_step;
    let options = ImportOptions::default();
    let report = corpus.import_paths(paths, &options, &mut ProgressReceiver::new(&mut hear));
    report.expect("imported")
}

/// Creates a folder on the desk with files of these names.
fn folder(desk: &Desk, name: &[u8], files: &[(&[u8], String)]) -> PathBuf {
    let folder = desk.folder.path().join(OsStr::from_bytes(name));
    fs::create_dir(&folder).expect("made");
    for (name, text) in files {
        fs::write(folder.join(OsStr::from_bytes(name)), text).expect("written");
    }
    folder
}

fn names(corpus: &Corpus) -> Vec<String> {
    let all = crate::db::stored_recordings::load_recording_rows(corpus.store.read_connection()).expect("recordings");
    all.into_iter().map(|row| row.name).collect()
}

#[test]
fn files_whose_names_are_not_utf8_stay_recordings_of_their_own() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let first = eaf(&[("Gloss", 0, 500, "FIRST")]);
    let second = eaf(&[("Gloss", 0, 500, "SECOND")]);
    let files: [(&[u8], _); 2] = [(b"take\xff.eaf", first.clone()), (b"take\xfe.eaf", second)];
    let report = take(&mut corpus, &[folder(&desk, b"in", &files)]);
    let shown = |it: &FileReport| it.path.rsplit('/').next().unwrap_or_default().to_owned();
    let paths: Vec<String> = report.files.iter().map(shown).collect();
    assert_eq!(paths, ["take%FE.eaf", "take%FF.eaf"]);
    assert_eq!(names(&corpus), ["take%FE", "take%FF"]);
    assert_whole(&mut corpus);

    // A folder's name distinguishes files as well, and a file is found again.
    let other: [(&[u8], _); 1] = [(b"take.eaf", first)];
    let folders = [b"in\xff", b"in\xfe"].map(|name| folder(&desk, name, &other));
    fs::write(folders[1].join("take.eaf"), eaf(&[("Gloss", 0, 400, "THIRD")])).expect("written");
    take(&mut corpus, &folders);
    assert_eq!(names(&corpus).len(), 4, "{:?}", names(&corpus));
    let again = take(&mut corpus, &folders);
    let unchanged = |it: &FileReport| it.status == FileStatus::Unchanged;
    assert!(again.files.iter().all(unchanged), "{:?}", again.files);
}

#[test]
fn a_name_that_is_as_text_that_of_another_file_is_refused() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let files: [(&[u8], _); 2] = [
        (b"take\xff.eaf", eaf(&[("Gloss", 0, 500, "FIRST")])),
        (b"take%FF.eaf", eaf(&[("Gloss", 0, 500, "SECOND")])),
    ];
    let report = take(&mut corpus, &[folder(&desk, b"in", &files)]);
    let count = |status| report.files.iter().filter(|it| it.status == status).count();
    assert_eq!(count(FileStatus::Imported), 1);
    let refused = report.files.iter().find(|it| it.status == FileStatus::Refused);
    let finding = &refused.expect("refused").findings[0];
    assert!(finding.message.contains("not UTF-8"), "{}", finding.message);
    assert!(finding.remedy.is_some());
    assert_eq!(names(&corpus), ["take%FF"]);
}

#[test]
fn pipes_are_left_out_of_folders_and_refused_by_name_without_a_wait() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let files: [(&[u8], _); 1] = [(b"take.bvh", MOVEMENT.to_owned())];
    let folder = folder(&desk, b"in", &files);
    let pipes = ["take.srt", "take.txt", "film_000000000000_keypoints.json"];
    let pipes = pipes.map(|name| folder.join(name));
    let made = std::process::Command::new("mkfifo").args(&pipes).status();
    assert!(made.expect("run").success());
    let report = take(&mut corpus, &[folder]);
    assert!(!report.has_refusals());
    let skipped = report.files.iter().filter(|it| it.status == FileStatus::Skipped);
    let skipped: Vec<&ReportFinding> = skipped.flat_map(|it| &it.findings).collect();
    assert_eq!(skipped.len(), 3);
    for finding in skipped {
        assert!(finding.message.contains("no regular file"), "{}", finding.message);
        assert!(finding.remedy.is_some());
    }
    assert_eq!(names(&corpus), ["take"]);
    let mut hear = ignore_progress_step;
    let options = ImportOptions::default();
    let alone = corpus.import_paths(&pipes[..1], &options, &mut ProgressReceiver::new(&mut hear));
    let error = alone.expect_err("refused");
    assert!(error.to_string().contains("no regular file") && error.error_remedy().is_some());
}

#[test]
fn files_too_large_to_be_read_whole_are_refused_before_any_of_it_is_read() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    for name in ["a.eaf", "a.csv", "a.json", "a.glb", "a.trc"] {
        let path = desk.file(name, "");
        let file = fs::File::options().write(true).open(&path).expect("open");
        file.set_len(12 << 30).expect("set");
        // A file that is read after all reports its bytes.
        let mut stop = |step: ProgressStep<'_>| match step.unit {
            ProgressUnit::Bytes => std::ops::ControlFlow::Break(()),
            _ => std::ops::ControlFlow::Continue(()),
        };
        let options = ImportOptions::default();
        let report = corpus.import_paths(
            std::slice::from_ref(&path),
            &options,
            &mut ProgressReceiver::new(&mut stop),
        );
        let refused = report.expect(name).files.remove(0);
        assert_eq!(refused.status, FileStatus::Refused, "{name}");
        assert_eq!(refused.findings[0].message, "the file has 12884901888 bytes");
        fs::remove_file(path).expect("removed");
    }
}

/// Returns a starter capture in which every channel of some joints is written by `change` from its frame and its number.
fn changed_capture(name: &str, joints: &[&str], change: impl Fn(usize, &str) -> String) -> String {
    let (_, bytes) = crate::starter_files()
        .find(|(file, _)| file.ends_with(format!("{name}.bvh")))
        .expect("a starter capture");
    let text = String::from_utf8(bytes.to_vec()).expect("text");
    let (mut joint, mut lost, mut frame) = (String::new(), Vec::new(), None);
    let lines = text.lines().map(|line| {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words.as_slice() {
            ["ROOT" | "JOINT", name] => joint = (*name).to_owned(),
            ["CHANNELS", _, channels @ ..] => {
                let is_lost = joints.contains(&joint.as_str());
                lost.extend(channels.iter().map(|_| is_lost));
            }
            ["Frame", "Time:", _] => frame = Some(0),
            numbers => {
                if let Some(now) = frame {
                    frame = Some(now + 1);
                    let numbers = numbers.iter().zip(&lost);
                    let numbers = numbers.map(|(number, is_lost)| match is_lost {
                        true => change(now, number),
                        false => (*number).to_owned(),
                    });
                    return numbers.collect::<Vec<_>>().join(" ") + "\n";
                }
            }
        }
        format!("{line}\n")
    });
    lines.collect()
}

#[test]
fn movement_that_was_lost_for_a_while_is_reported_in_both_languages() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let arm = ["RightArm", "RightForeArm"];
    let zeros = |frame: usize, number: &str| match frame {
        180..192 => "0".to_owned(),
        _ => number.to_owned(),
    };
    let lost = desk.file("lost.bvh", &changed_capture("chat", &arm, zeros));
    let sound = desk.file("sound.bvh", &changed_capture("chat", &[], zeros));
    let report = take(&mut corpus, &[lost, sound]);
    let [lost, sound] = report.files.as_slice() else {
        panic!("{report:?}");
    };
    assert_eq!(sound.understood.lapses.as_deref(), Some(&[][..]));
    let found = lost.understood.lapses.clone().unwrap_or_default();
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(
        found[0].starts_with("frames 180 to 191: the right arm jumps"),
        "{found:?}"
    );
    let said: Vec<&ReportFinding> = lost
        .findings
        .iter()
        .filter(|it| it.message.contains("lost here"))
        .collect();
    assert_eq!((said.len(), said[0].severity), (1, "warning"));
    let french = crate::words::localized_message(&said[0].message, crate::words::InterfaceLanguage::French)
        .expect("a French form");
    let is_french = french.contains("perdu ici : images 180 à 191 : le bras droit saute");
    assert!(is_french, "{french}");
}

#[test]
fn annotations_whose_tier_became_a_root_tier_lose_their_parents() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let whole = eaf(&[("Gloss", 0, 500, "BOL")]);
    let below = |name: &str, above: &str, place: usize| {
        format!(
            "<TIER TIER_ID=\"{name}\" LINGUISTIC_TYPE_REF=\"a\" PARENT_REF=\"{above}\"><ANNOTATION><REF_ANNOTATION \
             ANNOTATION_ID=\"b{place}\" ANNOTATION_REF=\"{}\"><ANNOTATION_VALUE>x</ANNOTATION_VALUE></REF_ANNOTATION>\
             </ANNOTATION></TIER>",
            if place == 0 {
                "a0".to_owned()
            } else {
                format!("b{}", place - 1)
            }
        )
    };
    let kind =
        "<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"a\" TIME_ALIGNABLE=\"false\" CONSTRAINTS=\"Symbolic_Association\"/>";
    let with = |tiers: String| {
        let text = whole.replacen("<LINGUISTIC_TYPE ", &format!("{tiers}<LINGUISTIC_TYPE "), 1);
        text.replace("</ANNOTATION_DOCUMENT>", &format!("{kind}</ANNOTATION_DOCUMENT>"))
    };
    let deep = (0..200).map(|place| match place {
        0 => below("t0", "Gloss", 0),
        place => below(&format!("t{place}"), &format!("t{}", place - 1), place),
    });
    for (name, text, wanted) in [
        (
            "orphan.eaf",
            with(below("Gone", "Missing", 0)),
            "is not in the file; it becomes a root tier",
        ),
        (
            "deep.eaf",
            with(deep.collect()),
            "hangs below more than 64 others; it becomes a root tier",
        ),
    ] {
        let report = import(&mut corpus, &desk.file(name, &text), "{}");
        let has_text = |it: &ReportFinding| it.message.contains(wanted);
        assert!(report.findings.iter().any(has_text), "{:?}", report.findings);
        let mut hear = ignore_progress_step;
        let checked = corpus
            .check_corpus(false, &mut ProgressReceiver::new(&mut hear))
            .expect("checked");
        assert_eq!((checked.faults, checked.questions), (vec![], vec![]), "{name}");
    }
}

#[test]
fn a_value_that_no_person_wrote_is_refused_with_its_place() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let longest = "x".repeat(1 << 20);
    for (value, fits) in [(longest.clone(), true), (longest + "x", false)] {
        let file = desk.file("long.eaf", &eaf(&[("Gloss", 0, 500, &value)]));
        let (mut hear, options) = (ignore_progress_step, ImportOptions::default());
        let report = corpus.import_paths(&[file], &options, &mut ProgressReceiver::new(&mut hear));
        let report = report.expect("a report").files.remove(0);
        assert_eq!(report.status == FileStatus::Refused, !fits, "{report:?}");
        let has_text = |it: &ReportFinding| it.message.contains("a value has at most 1048576");
        assert_eq!(report.findings.iter().any(has_text), !fits);
    }
}

/// Returns the findings of a report whose messages contain a text, each with a French form.
fn findings<'a>(report: &'a FileReport, text: &str) -> Vec<&'a ReportFinding> {
    let found = report.findings.iter().filter(|it| it.message.contains(text));
    let found: Vec<&ReportFinding> = found.collect();
    for finding in &found {
        let texts = [
            Some(finding.message.clone()),
            finding.remedy.as_ref().map(ToString::to_string),
        ];
        for text in texts.into_iter().flatten() {
            let french = crate::words::localized_message(&text, crate::words::InterfaceLanguage::French);
            assert!(french.is_some(), "no French for {text}");
        }
    }
    found
}

#[test]
fn a_take_in_which_no_joint_turns_is_a_warning_and_gets_no_proposals() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let capture = changed_capture("chat", &[], |_, number| number.to_owned());
    let names = capture.lines().filter_map(|line| line.trim().strip_prefix("JOINT "));
    let joints: Vec<&str> = names.collect();
    let still = changed_capture("chat", &joints, |_, _| "1".to_owned());
    let still = desk.file("still.bvh", &still);
    let moving = desk.file("moving.bvh", &capture);
    let tiers = ["still.eaf", "moving.eaf"].map(|name| desk.file(name, &eaf(&[("Gloss", 300, 900, "CHAT")])));
    let [a, b] = tiers;
    let report = take(&mut corpus, &[still, moving, a, b]);
    let warned = |name: &str| {
        let report = report.files.iter().find(|it| it.path.ends_with(name)).expect(name);
        let found = findings(report, "no joint of the body turns");
        found.iter().filter(|it| it.severity == "warning").count()
    };
    assert_eq!((warned("still.bvh"), warned("moving.bvh")), (1, 0));
    let options = crate::ProposeOptions {
        components: crate::ProposalResult::READABLE_COMPONENTS.to_vec(),
        scope: crate::ProposeScope::All,
    };
    let mut hear = ignore_progress_step;
    let proposed = corpus.propose_components(&options, &mut ProgressReceiver::new(&mut hear));
    let proposed = proposed.expect("proposals");
    assert_eq!(proposed.recordings, ["moving"], "{proposed:?}");
    let finding = "nothing is proposed for takes in which no joint of the body turns: still";
    assert!(proposed.findings.iter().any(|it| it == finding), "{proposed:?}");
    assert!(crate::words::localized_message(finding, crate::words::InterfaceLanguage::French).is_some());
}

#[test]
fn frames_that_are_left_out_are_neither_transcribed_nor_played() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let capture = changed_capture("chat", &[], |_, number| number.to_owned());
    let frames = frame_count(&capture);
    // The body leaps away before the last frames.
    let cut = frames - 20;
    let leaping = changed_capture("chat", &["Hips"], |frame, number| match frame >= cut {
        true => (number.parse::<f64>().expect("a number") + 500.0).to_string(),
        false => number.to_owned(),
    });
    let leaping = desk.file("leaping.bvh", &leaping);
    // From frame 18, at 60 frames a second, to the last one.
    let tiers = desk.file("leaping.eaf", &eaf(&[("Gloss", 300, 4100, "CHAT")]));
    let report = take(&mut corpus, &[leaping, tiers]);
    let found = findings(&report.files[0], "no part of the movement");
    assert_eq!(found.len(), 1, "{:?}", report.files[0].findings);
    let address = |text: &str| text.parse::<crate::CorpusAddress>().expect("an address");
    let used = corpus.usable_movement(&address("recording:1")).expect("movement");
    assert_eq!(used.clip.clip_frame_count(), cut);
    let token = corpus.usable_movement(&address("token:1")).expect("movement").clip;
    let last = used.clip.clip_frame_rate().frame_start_instant(cut);
    assert_eq!(token.clip_frame_count(), cut - 18);
    for named in ["recording:1", "token:1"] {
        let mut hear = ignore_progress_step;
        let read = corpus.transcribe_movement(&address(named), &mut ProgressReceiver::new(&mut hear));
        let read = read.expect("a transcription");
        assert!(read.end_us <= last.instant_micros(), "{named}: {}", read.end_us);
    }
}

#[test]
fn a_leap_in_the_middle_of_a_long_take_cuts_its_usable_frames() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    // The take is played ten times over; the body leaps away in the middle of the third time.
    let sound = changed_capture("chat", &[], |_, number| number.to_owned());
    let leaping = changed_capture("chat", &["Hips"], |frame, number| match frame >= 100 {
        true => (number.parse::<f64>().expect("a number") + 500.0).to_string(),
        false => number.to_owned(),
    });
    let away = changed_capture("chat", &["Hips"], |_, number| {
        (number.parse::<f64>().expect("a number") + 500.0).to_string()
    });
    let frames = frame_count(&sound);
    let (header, _) = sound.split_once("Frame Time:").expect("frames");
    let header = header.replace(&format!("Frames: {frames}"), &format!("Frames: {}", 10 * frames));
    let moving = |text: &str| {
        let (_, frames) = text.split_once("Frame Time:").expect("frames");
        let (time, frames) = frames.split_once('\n').expect("a time");
        (time.to_owned(), frames.to_owned())
    };
    let (time, whole) = moving(&sound);
    let parts = [whole.repeat(2), moving(&leaping).1, moving(&away).1.repeat(7)];
    let long = format!("{header}Frame Time:{time}\n{}", parts.concat());
    let report = take(&mut corpus, &[desk.file("long.bvh", &long)]);
    let found = findings(&report.files[0], "no part of the movement");
    let cut = 2 * frames + 100;
    assert!(
        found[0].message.contains(&format!("frames 0 to {}", cut - 1)),
        "{found:?}"
    );
    let address = "recording:1".parse::<crate::CorpusAddress>().expect("an address");
    let used = corpus.usable_movement(&address).expect("movement");
    assert_eq!(used.clip.clip_frame_count(), 10 * frames - cut);
    let early = chereme_motion::TimeSpan::span_between(
        chereme_motion::RecordingInstant::RECORDING_START,
        used.clip.clip_frame_rate().frame_start_instant(cut + 5),
    );
    let part = corpus.usable_part(&address, Some(early)).expect("a span");
    assert_eq!(used.clip.clip_frame_rate().frames_in(part), cut..cut + 5);
}

#[test]
fn finger_bones_over_twice_as_long_as_usual_are_drawn_and_measured_at_the_usual_length() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let sound = changed_capture("chat", &[], |_, number| number.to_owned());
    let mut is_next = false;
    let lines = sound.lines().map(|line| {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words.as_slice() {
            ["JOINT", name] => is_next = *name == "RightHandRing2",
            ["OFFSET", numbers @ ..] if std::mem::take(&mut is_next) => {
                let longer = numbers.iter().map(|number| {
                    let number: f64 = number.parse().expect("a number");
                    (8.0 * number).to_string()
                });
                return format!("OFFSET {}\n", longer.collect::<Vec<_>>().join(" "));
            }
            _ => {}
        }
        format!("{line}\n")
    });
    let long = lines.collect::<String>();
    let files = [desk.file("long.bvh", &long), desk.file("sound.bvh", &sound)];
    let report = take(&mut corpus, &files);
    let found = findings(&report.files[0], "these finger bones are over twice as long");
    assert!(found[0].message.ends_with("RightHandRing2"), "{found:?}");
    let [long_clip, sound_clip] = ["long", "sound"].map(|name| {
        let address = format!("recording:{name}").parse::<crate::CorpusAddress>();
        let moving = corpus.movement_at_address(&address.expect("an address"));
        moving.expect("movement").clip
    });
    for (joint, of_long) in long_clip.clip_skeleton().skeleton_joints().iter().enumerate() {
        let own = sound_clip.clip_skeleton().joint_at(joint).offset;
        let off = of_long.offset.distance(own) / own.length().max(0.01);
        assert!(off < 0.3, "{}: {} for {own}", of_long.name, of_long.offset);
    }
    // The file comes back with its own numbers.
    let back = desk.folder.path().join("back.bvh");
    let mut hear = ignore_progress_step;
    let what = crate::ExportWhat::Address("recording:long".parse().expect("an address"));
    corpus
        .export_corpus(
            &what,
            &back,
            &crate::ExportOptions::default(),
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("exported");
    let back = fs::read_to_string(&back).expect("read");
    let offsets = |text: &str| {
        let words = text.split_whitespace().map(str::to_owned);
        words.take_while(|word| word != "MOTION").collect::<Vec<_>>()
    };
    assert_eq!(offsets(&back), offsets(&long));
}

/// Returns the number of frames of a BVH file.
fn frame_count(text: &str) -> usize {
    let count = text.lines().find_map(|line| line.trim().strip_prefix("Frames:"));
    count
        .and_then(|count| count.trim().parse().ok())
        .expect("a number of frames")
}
