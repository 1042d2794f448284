//! Measures the time for a choice among many performances.

use std::path::Path;
use std::time::Instant;

use chereme_corpus::{ChooseOptions, Corpus, Function, ImportOptions, Progress, unheard};

use crate::sentence::{Numbers, Sentence};
use crate::{Failure, address};

/// Imports `count` performances of wh questions and chooses among them twice: first as the corpus lies on disk, then as it
/// is in memory.
pub(crate) fn run(folder: &Path, count: usize) -> Result<(), Failure> {
    let path = folder.join("pool.chereme");
    if path.exists() {
        std::fs::remove_file(&path)?;
    }
    let files = folder.join("pool");
    std::fs::create_dir_all(&files)?;
    let mut numbers = Numbers(10);
    let all: Vec<Sentence> = (0..=count)
        .map(|n| Sentence::new(format!("P{n:05}"), "wh", &mut numbers))
        .collect();
    let mut paths = Vec::new();
    for sentence in &all {
        let path = files.join(format!("{}.fap", sentence.name));
        std::fs::write(&path, sentence.fap())?;
        paths.push(path);
    }
    let mut corpus = Corpus::create(&path, "faces")?;
    let mut hear = unheard;
    let progress = &mut Progress::new(&mut hear);
    let begun = Instant::now();
    corpus.import(&paths, &ImportOptions::default(), progress)?;
    for sentence in &all {
        sentence.annotate(&mut corpus)?;
    }
    let took = begun.elapsed();
    println!(
        "{} performances imported and annotated in {took:.1?}",
        all.len()
    );
    for state in ["from disk", "in memory"] {
        let begun = Instant::now();
        let options = ChooseOptions::default();
        let target = address(&all[0].name);
        let choice = corpus.choose(&Function::of("wh"), &target, &options, progress)?;
        let (first, took) = (&choice.ranking[0], begun.elapsed());
        println!(
            "{state}: {} compared in {took:.3?}; nearest {} ({:.3})",
            choice.compared, first.recording, first.score
        );
    }
    Ok(())
}
