//! The same handshapes, palms and places are read from a capture however its skeleton is written.

#![allow(
    dead_code,
    reason = "the program `dialects` uses the rest of the shared modules"
)]

use std::error::Error;
use std::path::Path;

use chereme_corpus::{Corpus, ImportOptions, Progress, unheard, unpack_starter};

#[path = "../examples/dialects/dialect.rs"]
mod dialect;
#[path = "../examples/dialects/read.rs"]
mod read;
#[path = "../examples/dialects/rig.rs"]
mod rig;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn corpus_of(folder: &Path, name: &str, file: &Path) -> Result<Corpus> {
    let mut corpus = Corpus::create(&folder.join(format!("{name}.chereme")), name)?;
    let mut hear = unheard;
    let options = ImportOptions::default();
    let report = corpus.import(&[file.to_owned()], &options, &mut Progress::new(&mut hear))?;
    if report.has_refusals() {
        return Err(format!("{name} is refused: {:?}", report.files).into());
    }
    Ok(corpus)
}

#[test]
fn handshape_palm_and_place_are_read_alike_from_every_dialect() -> Result<()> {
    let own = tempfile::tempdir()?;
    let files = unpack_starter(&own.path().join("starter"))?;
    let capture = files
        .iter()
        .find(|path| path.file_name().is_some_and(|name| name == "escargot.bvh"))
        .ok_or("the starter corpus has no capture")?;
    let source = read::import(own.path(), "source", capture)?;
    let staged = rig::staged(&source.moving)?;
    let truth = read::readings(&source, &staged.clip, &staged.frames, false)?;
    assert!(truth.len() > 60, "{}", truth.len());
    // The example program `dialects` prints all dialects; these are the three hardest.
    let hard = ["unreal-a", "fist-rest", "shogun-markers"];
    for dialect in dialect::all() {
        if !hard.contains(&dialect.name) {
            continue;
        }
        let path = own.path().join(format!("{}.bvh", dialect.name));
        let prefix = rig::write(&source.moving, &staged, &dialect, &path)?;
        let moving = read::import(own.path(), dialect.name, &path)?;
        let frames: Vec<usize> = staged.frames.iter().map(|frame| frame + prefix).collect();
        let found = read::readings(&moving, &moving.moving.clip, &frames, true)?;
        let score = read::compare(&truth, &found);
        // Up to an eighth of the readings may differ for signers who never close or straighten a hand; none for others.
        let most = if dialect.lax > 0.0 {
            score.all() / 8
        } else {
            0
        };
        assert!(
            score.wrong() <= most,
            "{} of {}: {}",
            score.wrong(),
            score.all(),
            score.row(dialect.name)
        );
    }
    Ok(())
}
