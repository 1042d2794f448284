//! One capture in many dialects of skeletons, and what is read of each, as a Markdown table:
//! `cargo run -p chereme-tests --example dialects [-- CAPTURE.bvh [FOLDER]]`.
//!
//! Every handshape of the inventory is put on the right hand of the capture, each in another of its frames. The movement
//! is then written as other people's programs write it: joints called and turned otherwise, other units and axes, rest
//! poses with lowered arms or fists, fingers of three or four joints and with metacarpals, a wrapper above the hips,
//! optical markers beside them, offsets that are wrong, odd first frames, noise. Each file is imported like anybody's,
//! and handshape, palm and place are read from it and compared with what was put there. Without a capture the starter
//! corpus has one; with a FOLDER the files are left there, to be looked at.

#![allow(clippy::print_stdout)]

mod dialect;
mod read;
mod rig;

use std::error::Error;
use std::path::{Path, PathBuf};

use chereme_corpus::{Corpus, ImportOptions, Progress, unheard, unpack_starter};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let own = tempfile::tempdir()?;
    let capture = match arguments.first() {
        Some(path) => PathBuf::from(path),
        None => starter(own.path())?,
    };
    let folder = arguments.get(1).map_or(own.path(), Path::new);
    let source = read::import(own.path(), "source", &capture)?;
    let staged = rig::staged(&source)?;
    let truth = read::readings(&source.anatomy, &staged.clip, &staged.frames)?;
    println!(
        "{} handshapes on the body of {}\n",
        truth.len(),
        capture.display()
    );
    println!("| dialect | handshape | palm | fingers | place | off | first that is wrong |");
    println!("|---|--:|--:|--:|--:|--:|---|");
    let mut worst: Option<(usize, &str)> = None;
    for dialect in dialect::all() {
        let path = folder.join(format!("{}.bvh", dialect.name));
        let prefix = rig::write(&source, &staged, &dialect, &path)?;
        let moving = read::import(own.path(), dialect.name, &path)?;
        let frames: Vec<usize> = staged.frames.iter().map(|frame| frame + prefix).collect();
        let found = read::readings(&moving.anatomy, &moving.clip, &frames)?;
        let score = read::compare(&truth, &found);
        println!("{}", score.row(dialect.name));
        if worst.is_none_or(|(most, _)| score.wrong() > most) {
            worst = Some((score.wrong(), dialect.name));
        }
    }
    match worst {
        Some((0, _)) | None => println!("\nEvery dialect reads right."),
        Some((wrong, name)) => {
            println!("\nThe worst dialect is {name}: {wrong} readings are wrong.")
        }
    }
    Ok(())
}

/// Returns the capture of the starter corpus, unpacked.
fn starter(folder: &Path) -> Result<PathBuf> {
    let files = unpack_starter(&folder.join("starter"))?;
    let is = |path: &&PathBuf| path.file_name().is_some_and(|name| name == "escargot.bvh");
    Ok(files
        .iter()
        .find(is)
        .ok_or("the starter corpus has no capture")?
        .clone())
}

/// Imports a file into a corpus of its own, telling nobody.
fn corpus_of(folder: &Path, name: &str, file: &Path) -> Result<Corpus> {
    let mut corpus = Corpus::create(&folder.join(format!("{name}.chereme")), name)?;
    let mut hear = unheard;
    let report = corpus.import(
        &[file.to_owned()],
        &ImportOptions::default(),
        &mut Progress::new(&mut hear),
    )?;
    if report.has_refusals() {
        return Err(format!("{name} is refused: {:?}", report.files).into());
    }
    Ok(corpus)
}
