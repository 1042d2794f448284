//! The same handshapes, palms and places are read from a capture however its skeleton is written.

#![allow(dead_code, reason = "the program `dialects` uses the rest of the shared modules")]

use std::error::Error;
use std::path::{Path, PathBuf};

use chereme_corpus::{Corpus, ImportOptions, ProgressReceiver, ignore_progress_step, unpack_starter};

#[path = "../examples/dialects/dialect.rs"]
mod dialect;
#[path = "../examples/dialects/joins.rs"]
mod joins;
#[path = "../examples/dialects/read.rs"]
mod read;
#[path = "../examples/dialects/rig.rs"]
mod rig;

use joins::JoinMeasure;

/// The largest distance of the hips from the straight line between two pieces, in metres.
const HIPS_LIMIT: f64 = 0.02;
/// The largest distance of a standing foot from the floor of the first piece, in metres.
const FLOOR_LIMIT: f64 = 0.01;
/// The largest angle between a bone and its counterpart on another body, in degrees.
const BONE_LIMIT: f64 = 5.0;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn corpus_of(folder: &Path, name: &str, file: &Path) -> Result<Corpus> {
    let mut corpus = Corpus::create_corpus(&folder.join(format!("{name}.chereme")), name)?;
    let mut hear = ignore_progress_step;
    let options = ImportOptions::default();
    let report = corpus.import_paths(&[file.to_owned()], &options, &mut ProgressReceiver::new(&mut hear))?;
    if report.has_refusals() {
        return Err(format!("{name} is refused: {:?}", report.files).into());
    }
    Ok(corpus)
}

/// Returns recordings of the starter corpus, unpacked.
fn starters(folder: &Path, names: &[&str]) -> Result<Vec<PathBuf>> {
    let mut files = unpack_starter(&folder.join("starter"))?;
    files.retain(|path| {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        path.extension().is_some_and(|ending| ending == "bvh") && names.contains(&stem.as_ref())
    });
    Ok(files)
}

#[test]
fn joined_pieces_stand_still_whatever_the_dialect_of_either() -> Result<()> {
    let own = tempfile::tempdir()?;
    // The example program joins more recordings.
    let captures = starters(own.path(), &["chat", "escargot"])?;
    for (dialect, worst) in joins::worst_joins(&captures, &dialect::all(), own.path())? {
        let JoinMeasure { hips, floor, refused } = worst;
        assert_eq!(refused, 0, "{dialect}");
        assert!(hips < HIPS_LIMIT, "{dialect}: hips {hips} m off their line");
        assert!(floor < FLOOR_LIMIT, "{dialect}: feet {floor} m off the floor");
    }
    Ok(())
}

#[test]
fn feet_and_thumbs_point_alike_on_the_bodies_of_all_dialects() -> Result<()> {
    let own = tempfile::tempdir()?;
    let capture = &starters(own.path(), &["escargot"])?[0];
    for (from, onto, angle, part) in joins::turned_bones(capture, own.path())? {
        let angle = angle.to_degrees();
        assert!(angle < BONE_LIMIT, "{part} of {from} on {onto} is turned by {angle}°");
    }
    Ok(())
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
        let most = if dialect.lax > 0.0 { score.all() / 8 } else { 0 };
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
