//! Real captures, and signs generated from them: findings, frames left out, and results of search.

use std::path::{Path, PathBuf};

use chereme_corpus::{
    Corpus, CorpusAddress, FileReport, ImportOptions, PictureOptions, ProgressReceiver, SearchOptions,
    ignore_progress_step, unpack_starter,
};

fn starter(folder: &Path, stem: &str) -> Vec<PathBuf> {
    let mut files = unpack_starter(&folder.join("files")).expect("unpacked");
    files.retain(|path| path.file_stem().is_some_and(|it| it == stem));
    files
}

fn corpus(folder: &Path, files: &[PathBuf]) -> (Corpus, Vec<FileReport>) {
    let mut corpus = Corpus::create_corpus(&folder.join("a.chereme"), "A").expect("made");
    let mut hear = ignore_progress_step;
    let options = ImportOptions::default();
    let report = corpus.import_paths(files, &options, &mut ProgressReceiver::new(&mut hear));
    (corpus, report.expect("imported").files)
}

fn found(corpus: &mut Corpus, query: &str) -> Vec<String> {
    let answer = corpus.search_tokens(query, &SearchOptions::default()).expect(query);
    answer.hits.iter().map(|hit| hit.gloss.clone()).collect()
}

#[test]
fn generated_signs_are_found_by_the_values_that_operators_set() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = starter(folder.path(), "escargot");
    let (mut corpus, _) = corpus(folder.path(), &files);
    for (recipe, gloss, query) in [
        (
            "ESCARGOT | place right at forehead with index",
            "FRONT",
            "right.placement=forehead",
        ),
        (
            "ESCARGOT | orient right palm down fingers forward",
            "BAS",
            "right.orientation.fingers=out",
        ),
        ("ESCARGOT | repeat 2", "DEUX", "right.movement.repetition=twice"),
        (
            "spell LSF | travel right down 20cm",
            "LIGNE",
            "right.movement.direction=down",
        ),
    ] {
        corpus.recombine_recipe(recipe, gloss).expect(recipe);
        let hits = found(&mut corpus, query);
        assert!(hits.iter().any(|it| it == gloss), "{query}: {hits:?}");
    }
    let chin = found(&mut corpus, "placement=forehead");
    assert!(!chin.iter().any(|it| it == "DEUX"), "{chin:?}");
}

#[test]
fn a_recording_without_a_sign_is_addressed_by_its_bare_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = starter(folder.path(), "escargot");
    let capture = files.iter().find(|path| path.extension().is_some_and(|it| it == "bvh"));
    let take = folder.path().join("take-1.bvh");
    std::fs::copy(capture.expect("a capture"), &take).expect("copied");
    let (mut corpus, _) = corpus(folder.path(), &[take]);
    let made = corpus.recombine_recipe("take-1 | trim", "A").expect("a recording");
    let whole = corpus.preview_recipe("recording:1").expect("the same");
    assert!(made.duration_us <= whole.duration_us);
    let address: CorpusAddress = "take-1".parse().expect("a name");
    corpus.movement_at_address(&address).expect("a recording");
    let picture = folder.path().join("a.png");
    let mut hear = ignore_progress_step;
    let options = PictureOptions::default();
    corpus
        .draw_movement_file(&address, &picture, &options, &mut ProgressReceiver::new(&mut hear))
        .expect("a picture");
    let near = corpus.preview_recipe("take-2").expect_err("no such name");
    let right = near.meant_name().map(|it| it.right.clone());
    assert_eq!(right.as_deref(), Some("take-1"), "{near}");
}

#[test]
fn odd_first_frames_are_reported_with_their_numbers_and_cut_by_trim() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = starter(folder.path(), "escargot");
    let capture = files.iter().find(|path| path.extension().is_some_and(|it| it == "bvh"));
    let text = std::fs::read_to_string(capture.expect("a capture")).expect("text");
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let time = lines
        .iter()
        .position(|line| line.starts_with("Frame Time"))
        .expect("a motion");
    let first = lines[time + 1].clone();
    let mut numbers: Vec<&str> = first.split_whitespace().collect();
    numbers[0] = "900";
    lines[time + 1] = numbers.join(" ");
    let take = folder.path().join("take.bvh");
    std::fs::write(&take, lines.join("\n")).expect("written");
    let (mut corpus, reports) = corpus(folder.path(), &[take]);
    let messages: Vec<&str> = reports[0].findings.iter().map(|it| it.message.as_str()).collect();
    assert!(
        messages.iter().any(|it| it.contains("frame 0: the body jumps")),
        "{messages:?}"
    );
    let made = corpus.preview_recipe("take | trim").expect("made");
    assert!(made.explanation.contains("left out frame 0"), "{}", made.explanation);
    let back = corpus
        .movement_at_address(&"take".parse().expect("a name"))
        .expect("whole");
    assert!(
        back.clip.joint_translation(0, 0).length() > 5.0,
        "the stored numbers stay those of the file"
    );
}

#[test]
fn a_capture_that_cannot_be_read_is_refused_with_a_remedy() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text, says) in [
        ("a.trc", "PathFileType\t4\n", "is missing"),
        ("a.c3d", "", "no C3D file"),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("written");
        let mut corpus = Corpus::create_corpus(&folder.path().join(format!("{name}.chereme")), "A");
        let corpus = corpus.as_mut().expect("made");
        let mut hear = ignore_progress_step;
        let options = ImportOptions::default();
        let report = corpus.import_paths(&[path], &options, &mut ProgressReceiver::new(&mut hear));
        let file = &report.expect("a report").files[0];
        let [finding] = file.findings.as_slice() else {
            panic!("{file:?}");
        };
        assert!(finding.message.contains(says), "{finding:?}");
        let remedy = finding.remedy.clone().unwrap_or_default();
        assert!(remedy.remedy_text().contains("export the take again"), "{finding:?}");
    }
}
