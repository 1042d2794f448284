//! Shared parts of the tests that drive the pane of studies.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use chereme_corpus::study::study_answers::{
    ANSWERS_FORMAT, ANSWERS_VERSION, ParticipantDevice, StudyAnswer, StudyParticipant,
};
use chereme_corpus::study::study_plan::TrialRole;
use chereme_corpus::study::{AnswersOptions, StudyRequest};
use chereme_corpus::{
    ConsentAudience, ConsentChange, Corpus, CorpusAddress, ProgressReceiver, RowName, ignore_progress_step,
};
use chereme_studio::InterfaceLanguage;
use eframe::egui::{DroppedFile, DroppedFileHandle, Key};
use egui_kittest::kittest::Queryable;

use super::tiers::{ALT, CTRL};
use super::{Window, click, contains, idle, options, small_corpus, until, window};

/// Opens a window whose corpus is made first by `prepare`, with the pane of studies large.
pub fn opened_with<'a>(folder: &Path, language: InterfaceLanguage, prepare: impl FnOnce(&mut Corpus)) -> Window<'a> {
    let path = small_corpus(folder);
    let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
    agree_to_films(&mut corpus);
    prepare(&mut corpus);
    drop(corpus);
    let mut window = window(chereme_studio::StudioOptions {
        corpus: Some(path),
        language,
        ..options(folder)
    });
    until(&mut window, "the corpus", |it| contains(it, "escargot"));
    idle(&mut window);
    window.key_press_modifiers(CTRL, Key::F2);
    window.run_steps(2);
    window.key_press_modifiers(CTRL | ALT, Key::O);
    window.run_steps(3);
    idle(&mut window);
    window
}

/// States that everybody may see the films of all signers.
fn agree_to_films(corpus: &mut Corpus) {
    let everybody = Some(Some(ConsentAudience::Public));
    let agreed = ConsentChange {
        movement: everybody,
        derived: everybody,
        ..ConsentChange::default()
    };
    let signers = corpus.list_consents().expect("read");
    let numbered = signers.iter().map(|row| CorpusAddress::Signer(RowName::Number(row.id)));
    let signers: Vec<CorpusAddress> = numbered.collect();
    corpus.change_consent(&signers, &agreed).expect("stated");
}

pub fn opened<'a>(folder: &Path, language: InterfaceLanguage) -> Window<'a> {
    opened_with(folder, language, |_| {})
}

/// Returns the corpus of a window.
pub fn corpus(window: &Window<'_>) -> Corpus {
    let path = window.state().shown_corpus_path().expect("open").clone();
    Corpus::open_corpus(&path, "reader").expect("opened")
}

pub fn type_into(window: &mut Window<'_>, label: &str, text: &str) {
    window.get_by_label(label).focus();
    window.run_steps(2);
    window.get_by_label(label).type_text(text);
    window.run_steps(3);
}

/// Scrolls to a part of a long form, and clicks on it.
pub fn click_in_sight(window: &mut Window<'_>, label: &str) {
    window.get_by_label(label).scroll_to_me();
    window.run_steps(40);
    click(window, label);
}

/// Returns the request of a study of one sign in two conditions.
pub fn places(name: &str) -> StudyRequest {
    StudyRequest {
        name: name.to_owned(),
        items: vec!["ESCARGOT".to_owned()],
        conditions: vec![
            ("captured".to_owned(), "{}".to_owned()),
            ("higher".to_owned(), "{} | place both by up 10cm".to_owned()),
        ],
        questions: vec!["realism".to_owned()],
        scale: 5,
        ..StudyRequest::default()
    }
}

/// Stores a study.
pub fn plan(corpus: &mut Corpus, request: &StudyRequest) {
    let plan = request.make_study_plan().expect("a plan");
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    corpus.plan_study(&plan, progress).expect("stored");
}

/// Writes the answers of a participant who saw some trials: the condition and the number of each.
pub fn write_answers(folder: &Path, sha256: &str, code: &str, values: &[(&str, i64)]) -> PathBuf {
    let answer = |(n, (condition, value)): (u32, &(&str, i64))| StudyAnswer {
        n,
        block: 1,
        part: String::new(),
        item: "ESCARGOT".into(),
        condition: (*condition).into(),
        role: TrialRole::Main,
        question: "realism".into(),
        scale: Some([1, 5]),
        value: Some(*value),
        choice: None,
        right: None,
        plays: 1,
        ms: 900,
        hidden: 0,
        slow: 0,
    };
    let participant = StudyParticipant {
        format: ANSWERS_FORMAT.into(),
        version: ANSWERS_VERSION,
        study: "places".into(),
        plan_sha256: sha256.into(),
        code: code.into(),
        seed: 1,
        started_day: "2026-11-27".into(),
        language: "en".into(),
        device: ParticipantDevice::default(),
        consent: [("analysis".to_owned(), true)].into(),
        profile: [].into(),
        finished: true,
        skipped: Vec::default(),
        answers: (1..).zip(values).map(answer).collect(),
    };
    let path = folder.join(format!("{code}.json"));
    let text = serde_json::to_string(&participant).expect("text");
    std::fs::write(&path, text).expect("written");
    path
}

/// Stores the study `places` with the answers of two participants; the second one passed over a trial.
pub fn answered(corpus: &mut Corpus, folder: &Path) {
    plan(corpus, &places("places"));
    let sha256 = corpus.study_with_answers("places").expect("stored").plan_sha256;
    let both = [("captured", 5), ("higher", 2)];
    let files = [
        write_answers(folder, &sha256, "p1", &both),
        write_answers(folder, &sha256, "p2", &both[..1]),
    ];
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let report = corpus.import_answers("places", &files, &AnswersOptions::default(), progress);
    assert_eq!(report.expect("imported").added, 2);
}

/// A file that is dropped on the window.
#[derive(Debug)]
struct Dropped(PathBuf);

impl DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

pub fn drop_file(window: &mut Window<'_>, path: &Path) {
    let handle: DroppedFileHandle = Arc::new(Dropped(path.to_owned()));
    window.input_mut().dropped_files.push(handle);
    window.run_steps(3);
}
