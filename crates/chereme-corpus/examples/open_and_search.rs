//! Makes a corpus of the starter files and finds signs in it: `cargo run -p chereme-corpus --example open_and_search`.

#![allow(clippy::print_stdout, reason = "a program prints its answer")]

use std::error::Error;

use chereme_corpus::{Corpus, ImportOptions, ProgressReceiver, SearchOptions, ignore_progress_step, unpack_starter};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let files = unpack_starter(&folder.path().join("files"))?;

    // Each change is one operation under a person's name; a listener hears how far it is.
    let path = folder.path().join("starter.chereme");
    let mut corpus = Corpus::create_corpus(&path, "Ada")?;
    let mut listener = ignore_progress_step;
    corpus.import_paths(
        &files,
        &ImportOptions::default(),
        &mut ProgressReceiver::new(&mut listener),
    )?;

    // A corpus is a file: it is opened again wherever it lies.
    let mut corpus = Corpus::open_corpus(&path, "Ada")?;
    let answer = corpus.search_tokens("right.configuration=U", &SearchOptions::default())?;
    println!("{}: {} signs", answer.query, answer.total);
    for hit in &answer.hits {
        let place = hit.recording.as_deref().unwrap_or("the lexicon");
        println!("  {} in {place}", hit.gloss);
    }
    Ok(())
}
