//! Body language measured in captured signs: known sizes and times are recovered, replace the usual numbers, and are
//! reported.

use std::fs;
use std::path::Path;

use chereme_corpus::{
    Corpus, ExportOptions, ExportWhat, ImportOptions, NotationStaging, ProgressReceiver, RecombinationResult,
    ignore_progress_step,
};
use chereme_motion::{BodyPart, BodySide};

/// Two signs as a transcriber would write them, with their measurements in this signer's body language.
const SIGNS: &str = r#"<sigml>
  <hamgestural_sign gloss="AWAY"><sign_manual>
    <handconfig handshape="flat" extfidir="o" palmor="d"/>
    <location_bodyarm location="chest" contact="close"/>
    <directedmotion direction="o"/>
  </sign_manual></hamgestural_sign>
  <hamgestural_sign gloss="ROUND"><sign_manual>
    <handconfig handshape="finger2" extfidir="o" palmor="d"/>
    <location_bodyarm location="chest"/>
    <circularmotion axis="o"/>
  </sign_manual></hamgestural_sign>
</sigml>"#;

const SPOKEN: &str = r#"{"version": 1, "values": {
    "move.normal": [0.36, "arm", "known"], "time.straight": [0.5, "s", "known"],
    "circle.normal": [0.21, "arm", "known"], "time.circle": [0.9, "s", "known"]}}"#;

fn import(corpus: &mut Corpus, path: &Path, options: &ImportOptions) {
    let mut hear = ignore_progress_step;
    let done = corpus.import_paths(&[path.to_owned()], options, &mut ProgressReceiver::new(&mut hear));
    let done = done.expect("imported");
    assert!(
        done.files
            .iter()
            .all(|file| !format!("{:?}", file.status).contains("Failed"))
    );
}

/// Returns a corpus in which a signer performs each sign nine times, stored as if captured.
fn captured(folder: &Path, origin: &str) -> Corpus {
    let (signs, spoken) = (folder.join("signs.sigml"), folder.join("spoken.json"));
    fs::write(&signs, SIGNS).expect("written");
    fs::write(&spoken, SPOKEN).expect("written");
    let mut studio = Corpus::create_corpus(&folder.join("studio.chereme"), "A").expect("made");
    import(&mut studio, &signs, &ImportOptions::default());
    let spoken = spoken.display().to_string();
    let staging = NotationStaging {
        signer: None,
        language: Some(&spoken),
    };
    for gloss in ["AWAY", "ROUND"] {
        let done = studio.animate_notation(&[gloss; 9], &staging, Some(&format!("NINE-{gloss}")));
        let done = done.expect("made");
        assert!(done.report.steps[0].language.is_some());
    }
    let out = folder.join("takes");
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    studio
        .export_corpus(&ExportWhat::All, &out, &ExportOptions::default(), progress)
        .expect("exported");
    let mut corpus = Corpus::create_corpus(&folder.join("corpus.chereme"), "A").expect("made");
    import(&mut corpus, &signs, &ImportOptions::default());
    let options = ImportOptions {
        origin: chereme_corpus::RecordOrigin::of_name(origin),
        signer: Some("Anna".to_owned()),
        ..ImportOptions::default()
    };
    import(&mut corpus, &out.join("recordings"), &options);
    corpus
}

fn animate(corpus: &mut Corpus, language: Option<&str>) -> RecombinationResult {
    let staging = NotationStaging {
        signer: Some("signer:Anna"),
        language,
    };
    corpus.animate_notation(&["AWAY"], &staging, None).expect("made")
}

#[test]
fn sizes_and_times_of_captured_signs_replace_the_default_ones() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = captured(folder.path(), "captured");
    let measured = animate(&mut corpus, None);
    let language = measured.report.steps[0].language.clone();
    let values = language.expect("enough of it").values;
    for (name, known, tolerance) in [
        ("move.normal", 0.36, 0.02),
        ("time.straight", 0.5, 0.1),
        ("circle.normal", 0.21, 0.02),
        ("time.circle", 0.9, 0.1),
    ] {
        let value = &values[name];
        assert!(
            (value.value - known).abs() < tolerance,
            "{name} is {known}, measured {value:?}"
        );
        assert_eq!((value.count, value.of.as_str()), (9, "signer:\"Anna\""), "{name}");
        let [low, high] = value.quartiles.expect("a spread");
        assert!(low <= value.value && value.value <= high);
    }
    assert!(values["move.big"].value > 0.5 && values["move.big"].count == 0);
    assert!(!values.contains_key("arc.normal"), "there is no arc");
    assert!(
        measured.explanation.contains("move.normal") && measured.explanation.contains("of 9"),
        "{}",
        measured.explanation
    );

    let usual = animate(&mut corpus, Some("default"));
    assert!(usual.report.steps[0].language.is_none());
    assert!(usual.duration_us < measured.duration_us);
    assert!(usual.recipe.contains("with default"), "{}", usual.recipe);
    let stored = corpus.preview_recipe(&measured.recipe).expect("made again");
    assert_eq!(stored.duration_us, measured.duration_us);
}

#[test]
fn generated_signs_are_not_measured() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = captured(folder.path(), "generated");
    assert!(
        animate(&mut corpus, Some("measured")).report.steps[0]
            .language
            .is_none()
    );
}

#[test]
fn a_language_file_moves_places() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    let file = folder.path().join("mine.json");
    fs::write(&file, r#"{"version": 1, "places": {"chin": [0, 0.4, 0]}}"#).expect("written");
    let file = file.display().to_string();
    let text = "hamfinger2 hamextfingeru hampalml hamchin hamtouch";
    let mut highest = |language: Option<&str>| {
        let staging = NotationStaging { signer: None, language };
        let done = corpus.animate_notation(&[text], &staging, None).expect("made");
        let hand = done
            .anatomy
            .part_joint(BodyPart::Hand(BodySide::Right))
            .expect("a hand");
        let heights = (0..done.clip.clip_frame_count()).map(|n| done.clip.model_pose(n).model_joint_position(hand).y);
        heights.fold(0.0, f64::max)
    };
    let (usual, moved) = (highest(None), highest(Some(&file)));
    assert!(moved > usual + 0.08, "{usual} {moved}");
    for (language, said) in [("mesured", "measured"), ("no such.json", "no such file")] {
        let staging = NotationStaging {
            signer: None,
            language: Some(language),
        };
        let error = corpus
            .animate_notation(&[text], &staging, None)
            .map(|_| ())
            .expect_err(language);
        assert!(error.to_string().contains(said), "{error}");
    }
}
