//! A generated session of cued speech, taken in by the commands: restored, recognised, measured, cut into a dictionary.

#![allow(dead_code, reason = "the program `cued` uses the rest of the shared module")]

use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;

use chereme_analysis::cue::cue_labels;
use chereme_analysis::cue::generate::{CueGeneratorSettings, GENERATED_FRAME_RATE, generate_text_take};
use chereme_corpus::{
    Corpus, CueCosts, CueOptions, CuedOptions, DictionaryCueOptions, ImportOptions, ProgressReceiver, RestoreOptions,
    RowName, SearchOptions, TrackContent, ignore_progress_step,
};
use chereme_motion::glam::DVec3;

#[path = "../examples/cued/session.rs"]
mod session;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

const SENTENCES: u64 = 20;
const WORDS: usize = 3;

fn plan() -> session::Plan {
    session::Plan {
        sentences: SENTENCES,
        words: WORDS,
        times: 1,
        settings: CueGeneratorSettings {
            seed: 4,
            ..CueGeneratorSettings::default()
        },
    }
}

fn corpus_of(folder: &Path) -> Result<Corpus> {
    session::write(folder, &plan())?;
    let mut corpus = Corpus::create_corpus(&folder.join("c.chereme"), "A")?;
    let mut hear = ignore_progress_step;
    let options = ImportOptions::default();
    let report = corpus.import_paths(&[folder.join("c3d")], &options, &mut ProgressReceiver::new(&mut hear))?;
    assert!(!report.has_refusals(), "{:?}", report.files);
    Ok(corpus)
}

fn sentence(number: u64) -> RowName {
    RowName::Text(format!("sentence-{number:03}"))
}

/// Returns each marker's places in a track, in millimetres, as frames have them.
fn places(corpus: &Corpus, recording: &RowName, track: &str) -> Result<BTreeMap<String, Vec<Option<DVec3>>>> {
    let rows = corpus.recording_tracks(recording)?;
    let row = rows.iter().find(|row| row.name == track).ok_or(format!("no {track}"))?;
    let TrackContent::Markers(markers) = corpus.read_track_content(row.id, None)? else {
        return Err("no markers".into());
    };
    let place = |at: DVec3| markers.marker_space().displayed_position(at) * 1000.0;
    let points = markers.marker_points().iter().map(|point| {
        let own = (0..markers.marker_frame_count()).map(|frame| point.marker_position(frame).map(place));
        (point.name.clone(), own.collect())
    });
    Ok(points.collect())
}

#[test]
fn a_session_is_restored_recognised_measured_and_synthesised_again() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let mut corpus = corpus_of(folder.path())?;
    let options = CuedOptions::default();
    let mut hear = ignore_progress_step;
    let known = corpus.cued_markers(&sentence(3), &options)?;
    assert_eq!((known.hand.found, known.face.found), (50, 63));
    assert!(known.hand.seen < 0.97 && known.restored == 0, "{known:?}");
    let before = corpus.recording_tracks(&sentence(3))?;
    let captured = before[0].name.clone();
    let seen = places(&corpus, &sentence(3), &captured)?;

    let read = corpus.recognise_cues(&[], &[], &options)?;
    let hidden = read.findings.first().ok_or("no word on hidden markers")?;
    assert!(
        hidden.starts_with("markers are hidden at the targets: ") && hidden.contains("restore"),
        "{hidden}"
    );
    let how = RestoreOptions::default();
    let sentences: Vec<RowName> = (0..SENTENCES).map(sentence).collect();
    let done = corpus.restore_markers(&sentences, &how, &mut ProgressReceiver::new(&mut hear))?;
    let own = done
        .iter()
        .find(|it| it.recording == "sentence-003")
        .ok_or("no sentence")?;
    assert_eq!(own.hand_from, ["shapes"]);
    assert_eq!(own.face_from, ["sounds"]);
    assert!(own.hand_mm.is_some_and(|mm| mm < 3.0), "{:?}", own.hand_mm);
    assert!(own.face_mm.is_some_and(|mm| mm < 1.2), "{:?}", own.face_mm);
    assert_eq!(own.restored, own.hidden);
    assert_eq!(places(&corpus, &sentence(3), &captured)?, seen, "captured numbers stay");
    let restored = places(&corpus, &sentence(3), "restored")?;
    let text = session::text(4, 3, WORDS);
    let truth = generate_text_take(&plan().settings, 3, &text).ok_or("no take")?;
    let (mut sum, mut count) = (0.0, 0.0);
    for (n, label) in cue_labels::hand_marker_names().iter().enumerate() {
        for (frame, truth) in truth.true_hand.iter().enumerate() {
            let place = restored.get(label).and_then(|own| own[frame]);
            assert!(
                place.is_none() || seen[label][frame].is_none(),
                "only hidden places are restored"
            );
            if let Some(place) = place {
                sum += place.distance(truth[n]);
                count += 1.0;
            }
        }
    }
    assert!(count > 100.0 && sum / count < 5.0, "{:.2} mm of {count}", sum / count);

    let read = corpus.recognise_cues(&[], &[], &options)?;
    assert!(!read.same && read.left_out.is_empty());
    assert_eq!(read.findings, Vec::<String>::new());
    assert!(
        read.shapes.rate > 0.85 && read.placements.rate > 0.9,
        "{} {}",
        read.shapes.rate,
        read.placements.rate
    );

    let found = corpus.find_cue_targets(&[], true, &options)?;
    let own = found
        .iter()
        .find(|it| it.recording == "sentence-003")
        .ok_or("no sentence")?;
    assert_eq!(own.tiers[0], "Hand M1 M2 (found)", "the truth in the file stays");
    let mut off = Vec::new();
    for (number, found) in (0..SENTENCES).zip(&found) {
        let text = session::text(4, number, WORDS);
        let truth = generate_text_take(&plan().settings, number, &text).ok_or("no take")?;
        for (found, truth) in found.keys.iter().zip(&truth.keys) {
            off.extend(
                found
                    .hand_us
                    .map(|movement| (movement[1] as f64 / 1e6 - truth.times[1]).abs()),
            );
        }
    }
    off.sort_by(f64::total_cmp);
    let middle = off[off.len() / 2];
    assert!(
        off.len() > 40 && middle < 1.5 / GENERATED_FRAME_RATE,
        "{middle} s of {}",
        off.len()
    );
    corpus.find_cue_targets(&[], true, &options)?;
    corpus.undo_operation()?;

    let phases = corpus.cue_phases(&[], &options)?;
    assert!(
        phases
            .rows
            .iter()
            .any(|row| row.part == "hand" && row.kind == "pair" && row.n > 20)
    );
    assert_eq!(phases.findings, Vec::<String>::new());
    // Ends of fingers alone do not show how they bend.
    let bending = cue_labels::hand_marker_names()
        .into_iter()
        .filter(|label| label.starts_with(['I', 'M', 'R', 'L']) && !label.ends_with(['1', '8']));
    let plain = CuedOptions {
        labels: bending.map(|label| (label, "none".to_owned())).collect(),
        ..CuedOptions::default()
    };
    let guessed = corpus.cue_phases(&[], &plain)?;
    assert!(
        guessed.findings.len() == 1 && guessed.findings[0].contains(" is a guess "),
        "{:?}",
        guessed.findings
    );
    let found = corpus.find_cue_targets(&[sentence(3)], false, &plain)?;
    assert!(
        found[0].findings[0].contains(": 1 (sentence-003);"),
        "{:?}",
        found[0].findings
    );
    phases.draw_cue_phases(&folder.path().join("phases.svg"), false)?;

    let script = "le chat dort\n\nla vache mange du pain";
    let mut progress = ProgressReceiver::new(&mut hear);
    let book = corpus.cue_dictionary(&[], Some(script), &options, &mut progress)?;
    assert!(
        book.kinds > 60 && book.missed_mm < 1.0,
        "{} {}",
        book.kinds,
        book.missed_mm
    );
    let script = book.script.ok_or("no script")?;
    assert_eq!(script.sentences, 2);
    assert!(script.covered < 1.0 && !script.worth.is_empty());

    // A sentence from which the dictionary was cut is reproduced from it.
    let request = DictionaryCueOptions {
        cue: &CueOptions::default(),
        cued: &options,
        costs: CueCosts::default(),
        recordings: &[],
    };
    let again = corpus.cue_from_dictionary(&text, &request, Some("AGAIN"), &mut progress)?;
    assert!(
        again.shapes_read.is_some_and(|share| share > 0.8),
        "{:?}",
        again.misread
    );
    assert!(
        again.placements_read.is_some_and(|share| share > 0.8),
        "{:?}",
        again.misread
    );
    assert!(again.exact > again.backed_off + again.synthetic, "{again:?}");
    assert_eq!(again.recording.as_deref(), Some("AGAIN"));
    let keys = corpus.search_tokens("cue=* origin=made", &SearchOptions::default())?;
    assert_eq!(keys.total as u64, again.keys);
    let report = corpus.check_corpus(false, &mut ProgressReceiver::new(&mut hear))?;
    assert!(report.faults.is_empty(), "{:?}", report.faults);

    let slips = corpus.cue_slips(&sentence(3), None, false, &options)?;
    assert_eq!((slips.right, slips.slips.len()), (slips.predicted, 0));
    let other = corpus.cue_slips(&sentence(3), Some(&format!("papa {text}")), false, &options)?;
    assert!(!other.slips.is_empty() && other.right > 0);
    let read = corpus.cue_slips(&sentence(3), None, true, &options)?;
    assert_eq!(read.produced_by, "recognised");
    assert!(read.right * 10 > read.predicted * 6, "{read:?}");
    // The keys of another text are compared with those that are recognised.
    let other = corpus.cue_slips(&sentence(3), Some("papa"), true, &options)?;
    assert_eq!((other.predicted, other.produced), (2, read.produced));
    assert!(other.right <= 2 && other.slips.len() as u64 >= read.produced - 2);
    Ok(())
}

#[test]
fn a_recording_without_a_cuer_is_refused_with_a_remedy() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A")?;
    let options = CuedOptions::default();
    let mut hear = ignore_progress_step;
    let mut progress = ProgressReceiver::new(&mut hear);
    let restored = corpus.restore_markers(&[], &RestoreOptions::default(), &mut progress);
    assert!(restored.is_err_and(|error| {
        error
            .error_remedy()
            .is_some_and(|it| it.remedy_text().contains("--labels"))
    }));
    assert!(corpus.recognise_cues(&[], &[], &options).is_err());
    assert!(corpus.find_cue_targets(&[], true, &options).is_err());
    let wrong = CuedOptions {
        code: "klingon".to_owned(),
        ..CuedOptions::default()
    };
    assert!(
        corpus
            .cue_phases(&[], &wrong)
            .is_err_and(|error| error.to_string().contains("klingon"))
    );
    // Without captured takes, movement that the program generates replaces the dictionary, with a finding.
    let request = DictionaryCueOptions {
        cue: &CueOptions::default(),
        cued: &options,
        costs: CueCosts::default(),
        recordings: &[],
    };
    let done = corpus.cue_from_dictionary("le chat", &request, None, &mut progress)?;
    assert!(done.without_dictionary && done.keys == 2, "{done:?}");
    let long = corpus.cue_from_dictionary(&"le chat ".repeat(20_000), &request, None, &mut progress);
    let error = long.expect_err("hours").to_string();
    assert!(error.starts_with("the text takes"), "{error}");
    let request = DictionaryCueOptions {
        costs: CueCosts {
            join: f64::NAN,
            ..request.costs
        },
        ..request
    };
    assert!(
        corpus
            .cue_from_dictionary("le chat", &request, None, &mut progress)
            .is_err()
    );
    Ok(())
}

#[test]
fn odd_markers_and_tiers_give_findings_or_errors() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let trc = |markers: usize, cell: &str| {
        let names: Vec<String> = cue_labels::hand_marker_names().into_iter().take(markers).collect();
        let mut text = format!(
            "PathFileType\t4\t(X/Y/Z)\tx.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n120\t120\t40\t{markers}\tmm\t120\t1\t40\nFrame#\tTime"
        );
        for name in &names {
            text += &format!("\t{name}\t\t");
        }
        text += "\n\t";
        for n in 1..=markers {
            text += &format!("\tX{n}\tY{n}\tZ{n}");
        }
        text += "\n\n";
        for frame in 1..=40 {
            text += &format!("{frame}\t{:.5}", f64::from(frame - 1) / 120.0);
            text += &format!("\t{cell}").repeat(3 * markers);
            text += "\n";
        }
        text
    };
    let grid = |phones: &str| {
        format!(
            "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n0\n1\n<exists>\n1\n\"IntervalTier\"\n\"Phones\"\n0\n1\n{phones}"
        )
    };
    let overlapping = "2\n0\n0.6\n\"p\"\n0.2\n1\n\"a\"\n";
    for (n, (markers, cell, phones)) in [
        (2, "1.0", "0\n"),
        (50, "", overlapping),
        (50, "NaN", "0\n"),
        (50, "5.0", overlapping),
        (50, "1e300", overlapping),
    ]
    .into_iter()
    .enumerate()
    {
        let own = folder.path().join(format!("{n}"));
        std::fs::create_dir_all(&own)?;
        std::fs::write(own.join("take.trc"), trc(markers, cell))?;
        std::fs::write(own.join("take.TextGrid"), grid(phones))?;
        let mut corpus = Corpus::create_corpus(&own.join("c.chereme"), "A")?;
        let mut hear = ignore_progress_step;
        let mut progress = ProgressReceiver::new(&mut hear);
        let _ = corpus.import_paths(std::slice::from_ref(&own), &ImportOptions::default(), &mut progress)?;
        let options = CuedOptions::default();
        let none: &[RowName] = &[];
        assert!(
            corpus
                .restore_markers(none, &RestoreOptions::default(), &mut progress)
                .is_err(),
            "{n}"
        );
        assert!(corpus.recognise_cues(none, none, &options).is_err(), "{n}");
        assert!(corpus.cue_phases(none, &options).is_err(), "{n}");
        assert!(
            corpus.cue_dictionary(none, None, &options, &mut progress).is_err(),
            "{n}"
        );
    }
    Ok(())
}
