//! Tests how well one capture is read from many dialects of skeletons, as a Markdown table:
//! `cargo run -p chereme-tests --example dialects [-- CAPTURE.bvh [FOLDER]]`.
//!
//! The right hand of the capture takes every handshape of the inventory, each in another frame. Then the movement is
//! written in the form of other people's programs: other names and axes of joints, other units, rest poses with lowered
//! arms or fists, fingers of three or four joints and with metacarpals, a wrapper above the hips, optical markers beside
//! the joints, wrong offsets, odd first frames, noise. Each file is imported, and handshape, palm and place are read from
//! it and compared with the truth. Without CAPTURE a recording of the starter corpus is used, and the tables are written
//! to RESULTS.md; the files stay in FOLDER, if one is given.

#![allow(clippy::print_stdout, reason = "a program prints its table")]

mod dialect;
mod joins;
mod others;
mod read;
mod rig;

use std::error::Error;
use std::path::{Path, PathBuf};

use chereme_corpus::{Corpus, ImportOptions, ProgressReceiver, ignore_progress_step, unpack_starter};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let own = tempfile::tempdir()?;
    match arguments.as_slice() {
        [] => {
            let mut text = HEAD.to_owned();
            for capture in captures(own.path())? {
                text += &table(&capture, own.path())?;
            }
            text += &joins_table(own.path())?;
            if let Some(data) = std::env::var_os("CHEREME_SHARED_DATA") {
                text += others::HEAD;
                text += &others::rows(Path::new(&data))?;
            }
            print!("{text}");
            let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/dialects/RESULTS.md");
            std::fs::write(file, text)?;
        }
        [capture] => print!("{}", table(Path::new(capture), own.path())?),
        [capture, folder, ..] => print!("{}", table(Path::new(capture), Path::new(folder))?),
    }
    Ok(())
}

/// The text before the tables in the file of results.
const HEAD: &str = "# The same handshapes in many dialects of skeletons

Written by `cargo run -p chereme-tests --example dialects`; with `CHEREME_SHARED_DATA` other people's captures are used too.
Every handshape of the inventory is put on the right hand of a capture, which is then written as other programs write it,
imported, and read again. A column counts the readings that are right: the nearest handshape of the inventory, the nearest
of 26 directions of palm and fingers, and the nearest of 12 places. *Off* is the largest error of a hand's posture.
";

/// Returns the table of a capture; its files stay in the folder.
fn table(capture: &Path, folder: &Path) -> Result<String> {
    let own = tempfile::tempdir()?;
    let source = read::import(own.path(), "source", capture)?;
    let staged = rig::staged(&source.moving)?;
    let truth = read::readings(&source, &staged.clip, &staged.frames, false)?;
    let name = capture.file_stem().unwrap_or_default().to_string_lossy();
    let mut text = format!(
        "\n## {} handshapes on the body of `{name}`\n\n{}",
        truth.len(),
        read::HEAD
    );
    let mut worst: Option<(usize, &str)> = None;
    let (mut right, mut all) = (0, 0);
    for dialect in dialect::all() {
        let path = folder.join(format!("{}.bvh", dialect.name));
        let prefix = rig::write(&source.moving, &staged, &dialect, &path)?;
        let moving = read::import(own.path(), dialect.name, &path)?;
        let frames: Vec<usize> = staged.frames.iter().map(|frame| frame + prefix).collect();
        let found = read::readings(&moving, &moving.moving.clip, &frames, true)?;
        let score = read::compare(&truth, &found);
        text += &score.row(dialect.name);
        right += score.all() - score.wrong();
        all += score.all();
        if worst.is_none_or(|(most, _)| score.wrong() > most) {
            worst = Some((score.wrong(), dialect.name));
        }
    }
    text += &match worst {
        Some((0, _)) | None => format!("\n{right} of {all} readings are right.\n"),
        Some((wrong, name)) => {
            format!("\n{right} of {all} readings are right. The worst dialect is {name}: {wrong} readings are wrong.\n")
        }
    };
    Ok(text)
}

/// The head of the table of joins.
const JOINS_HEAD: &str = "
## Joined pieces, and movement on another body

Every recording of the starter corpus is joined to the next one and the one before, and in the dialect `plain` to every other
one: within a dialect, and between the dialect and the file as it is. *Refused* counts the joins that would add too much
speed. *Hips* is the largest distance from the straight line between the two pieces, *floor* that of the lower foot from
its height in the first piece. Then movement of each dialect is put on the bodies of all: *turned* is the largest angle between a
bone of foot or thumb and its counterpart.

| dialect | refused | hips | floor | turned | bone |
|---|--:|--:|--:|--:|---|
";

/// Returns the table of joins for the starter corpus.
fn joins_table(folder: &Path) -> Result<String> {
    let joined = joins::worst_joins(&starters(folder, &[])?, &dialect::all(), folder)?;
    let turned = joins::turned_bones(&starter(folder)?, folder)?;
    let mut text = JOINS_HEAD.to_owned();
    for (name, worst) in joined {
        let own = turned.iter().filter(|row| row.0 == name);
        let most = own.max_by(|a, b| a.2.total_cmp(&b.2));
        let (angle, bone) = most.map_or((0.0, ""), |row| (row.2, row.3.as_str()));
        text += &format!(
            "| {name} | {} | {:.1} mm | {:.1} mm | {:.1}° | {bone} |\n",
            worst.refused,
            worst.hips * 1000.0,
            worst.floor * 1000.0,
            angle.to_degrees()
        );
    }
    Ok(text)
}

/// Returns the capture of the starter corpus, and those of other people if the shared data are there.
fn captures(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut all = vec![starter(folder)?];
    if let Some(data) = std::env::var_os("CHEREME_SHARED_DATA") {
        let names = ["upf-gti-performs/NGT Thanks.bvh", "upf-gti-animics/create_db_m.bvh"];
        all.extend(names.map(|name| Path::new(&data).join("motion/bvh").join(name)));
    }
    Ok(all)
}

/// Returns the capture of the starter corpus, unpacked.
fn starter(folder: &Path) -> Result<PathBuf> {
    let mut found = starters(folder, &["escargot"])?;
    found.pop().ok_or_else(|| "the starter corpus has no capture".into())
}

/// Returns recordings of the starter corpus, unpacked; all of them if no names are given.
fn starters(folder: &Path, names: &[&str]) -> Result<Vec<PathBuf>> {
    let mut files = unpack_starter(&folder.join("starter"))?;
    files.retain(|path| {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let is_capture = path.extension().is_some_and(|ending| ending == "bvh");
        is_capture && (names.is_empty() || names.contains(&stem.as_ref()))
    });
    Ok(files)
}

/// Imports a file into a new corpus, without progress.
fn corpus_of(folder: &Path, name: &str, file: &Path) -> Result<Corpus> {
    let mut corpus = Corpus::create_corpus(&folder.join(format!("{name}.chereme")), name)?;
    let mut hear = ignore_progress_step;
    let report = corpus.import_paths(
        &[file.to_owned()],
        &ImportOptions::default(),
        &mut ProgressReceiver::new(&mut hear),
    )?;
    if report.has_refusals() {
        return Err(format!("{name} is refused: {:?}", report.files).into());
    }
    Ok(corpus)
}
