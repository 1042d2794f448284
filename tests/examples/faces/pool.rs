//! Measures the time for a choice among many performances.

use std::path::Path;
use std::time::Instant;

use chereme_corpus::{
    ChooseOptions, Corpus, ExpressionFunction, ImportOptions, NewTier, ProgressReceiver, RowName, ignore_progress_step,
};
use chereme_sign::TierRole;

use crate::sentence::{Numbers, Sentence};
use crate::{Failure, address};

/// The mean number of frames of a performance, from M1 to M5.
const FRAMES: f64 = 200.0;
/// The number of times each case is measured.
const TIMES: usize = 5;

/// Imports `count` performances of wh questions with their annotation files and chooses among them: first from the
/// recordings, then in a corpus opened again, then in one that chose before. Returns a section of tables.
pub(crate) fn run(folder: &Path, count: usize) -> Result<String, Failure> {
    let path = folder.join("pool.chereme");
    if path.exists() {
        std::fs::remove_file(&path)?;
    }
    let files = folder.join("pool");
    std::fs::create_dir_all(&files)?;
    let mut numbers = Numbers(10);
    let mut paths = Vec::new();
    let mut frames = 0.0;
    for n in 0..=count {
        let seconds = FRAMES / 30.0 * (0.85 + 0.3 * numbers.next());
        let sentence = Sentence::new(format!("P{n:05}"), "wh", &mut numbers).lasting(seconds);
        frames += sentence.frames();
        let path = files.join(format!("{}.fap", sentence.name));
        std::fs::write(&path, sentence.fap())?;
        std::fs::write(path.with_extension("TextGrid"), sentence.text_grid())?;
        paths.push(path.with_extension("TextGrid"));
        paths.push(path);
    }
    let frames = frames / (count + 1) as f64;
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let mut corpus = Corpus::create_corpus(&path, "faces")?;
    let begun = Instant::now();
    corpus.import_paths(&paths, &ImportOptions::default(), progress)?;
    let imported = begun.elapsed();
    let target = address("P00000");
    let mut choose = |corpus: &Corpus| -> Result<(f64, String), Failure> {
        let begun = Instant::now();
        let options = ChooseOptions::default();
        let choice = corpus.choose_performances(
            &ExpressionFunction::from_function_name("wh"),
            &target,
            &options,
            progress,
        )?;
        let took = begun.elapsed().as_secs_f64();
        let first = &choice.ranking[0];
        let found = format!(
            "{} compared, nearest {} ({:.3})",
            choice.compared, first.recording, first.score
        );
        Ok((took, found))
    };
    let (first, found) = choose(&corpus)?;
    let (mut opened, mut again) = (Vec::new(), Vec::new());
    for _ in 0..TIMES {
        corpus = Corpus::open_corpus(&path, "faces")?;
        for times in [&mut opened, &mut again] {
            let (took, same) = choose(&corpus)?;
            if same != found {
                return Err(format!("{same} instead of {found}").into());
            }
            times.push(took);
        }
    }
    // Each change touches one recording, and changes none of its performances.
    let (mut changed, mut held) = (Vec::new(), Vec::new());
    for n in 0..TIMES {
        corpus = Corpus::open_corpus(&path, "faces")?;
        for (step, times) in [&mut changed, &mut held].into_iter().enumerate() {
            let recording = RowName::Text(format!("P{:05}", 2 * n + step + 1));
            corpus.add_tier(&NewTier::new(recording, "topics", TierRole::Free))?;
            let (took, same) = choose(&corpus)?;
            if same != found {
                return Err(format!("{same} instead of {found}").into());
            }
            times.push(took);
        }
    }
    let median = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[TIMES / 2]
    };
    let (opened, again) = (median(&mut opened), median(&mut again));
    let (changed, held) = (median(&mut changed), median(&mut held));
    Ok(format!(
        "## Speed: choosing among {count} performances of {frames:.0} frames\n\n\
         | state of the corpus | seconds |\n| --- | --- |\n\
         | all files imported, with their annotations | {:.1} |\n\
         | first choice of all: every recording is read | {first:.2} |\n\
         | corpus opened, nothing changed since (median of {TIMES}) | {opened:.2} |\n\
         | next choice (median of {TIMES}) | {again:.2} |\n\
         | corpus opened, one recording changed since (median of {TIMES}) | {changed:.2} |\n\
         | next choice, one more recording changed (median of {TIMES}) | {held:.2} |\n\n\
         {found}. The wanted time is one second.\n",
        imported.as_secs_f64()
    ))
}
