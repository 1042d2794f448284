//! A small perceptual study with the answers of one participant.

use std::error::Error;
use std::path::Path;

use chereme_corpus::study::{AnswersOptions, StudyRequest};
use chereme_corpus::{Corpus, ProgressReceiver, ignore_progress_step};

/// The answers, without the hash of the plan.
const ANSWERS: &str = r#"{
    "format": "chereme-answers", "version": 1, "study": "bowls", "plan_sha256": "HASH",
    "participant": "heron", "seed": 3, "started_day": "2026-11-27", "language": "fr",
    "device": {"w": 1280, "h": 720, "dpr": 1.5}, "consent": {"analysis": true},
    "profile": {"level": "native"}, "finished": true,
    "answers": [
        {"n": 1, "block": 1, "item": "BOL", "condition": "captured", "question": "realism", "value": 4, "plays": 1},
        {"n": 1, "block": 1, "item": "BOL", "condition": "captured", "question": "gloss", "choice": "BOL", "plays": 2}
    ]
}"#;

/// Plans the study `bowls` on a corpus with BOL, and imports the answers: two operations. `desk` is a folder for the file.
///
/// # Errors
/// Fails if the corpus has no BOL, or the folder cannot be written.
pub fn small_study(corpus: &mut Corpus, desk: &Path) -> Result<(), Box<dyn Error>> {
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let condition = |name: &str, recipe: &str| (name.to_owned(), recipe.to_owned());
    let request = StudyRequest {
        name: "bowls".to_owned(),
        items: vec!["BOL".to_owned()],
        conditions: vec![condition("captured", "{}"), condition("backwards", "{} | reverse")],
        questions: vec!["realism".to_owned(), "gloss=items CHAT".to_owned()],
        scale: 5,
        ..StudyRequest::default()
    };
    let planned = corpus.plan_study(&request.make_study_plan()?, progress)?;
    let file = desk.join("heron.json");
    std::fs::write(&file, ANSWERS.replace("HASH", &planned.plan_sha256))?;
    corpus.import_answers("bowls", &[file], &AnswersOptions::default(), progress)?;
    Ok(())
}
