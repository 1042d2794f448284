//! Writes a small corpus of today's schema, so that later versions can show that they still open it.
//!
//! `cargo run -p chereme-tests --bin chereme-store -- tests/stores` writes `NNNN.chereme.zst`, where NNNN
//! is the version of the schema. It is run once for each schema version, before that is released, and
//! never again: the files show that what was written then is still read.

use std::error::Error;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use chereme_corpus::{
    ConsentAudience, ConsentChange, Corpus, CorpusAddress, KeptSearch, NewTrack, RowName, TrackContent,
};
use chereme_motion::column::{ColumnGaps, FrameNumberColumn};
use chereme_motion::{
    CurveTrack, FrameRate, FrameTimes, MarkerSpace, MarkerTrack, MotionMarker, ScalarCurve, SpaceConvention,
};
use chereme_tests::{repository, study, workers};

fn main() -> ExitCode {
    let Some(folder) = std::env::args_os().nth(1).map(PathBuf::from) else {
        let _ = writeln!(io::stderr(), "usage: FOLDER");
        return ExitCode::from(2);
    };
    match write(&folder) {
        Ok(path) => {
            let _ = writeln!(io::stdout(), "{}", path.display());
            ExitCode::SUCCESS
        }
        Err(error) => {
            let _ = writeln!(io::stderr(), "{error}");
            ExitCode::FAILURE
        }
    }
}

/// Returns markers and curves, with numbers of several forms and gaps.
fn tracks() -> Result<Vec<NewTrack>, Box<dyn Error>> {
    let wave = |frame: u16, phase: f32| (f32::from(frame) * 0.05 + phase).sin();
    let floats = |phase| FrameNumberColumn::from_single_floats((0..600).map(|at| wave(at, phase)).collect());
    let whole = (0..600).map(|at| (wave(at, 0.5) * 3000.0) as i32).collect();
    let whole =
        FrameNumberColumn::from_scaled_integers(whole, 0.0, 0.1)?.with_gaps(&ColumnGaps::from_gap_frames(20..40))?;
    let point = |name, phase| MotionMarker::new(name, vec![floats(phase), floats(phase + 1.0), whole.clone()]);
    let points = vec![point("LWRA", 0.0), point("RWRA", 2.0)];
    let markers = MarkerTrack::new(
        FrameTimes::Even(FrameRate::new(120, 1)?),
        MarkerSpace::World(SpaceConvention::MODEL_CONVENTION),
        points,
    )?;
    let seconds = (0..600).map(|at| f64::from(at) * 0.0167 + f64::from(at % 5) * 0.001);
    let times = FrameTimes::from_listed_seconds(FrameNumberColumn::from_double_floats(seconds.collect()))?;
    let curves = CurveTrack::new(times, vec![ScalarCurve::new("JawOpen", floats(0.25))])?;
    Ok(vec![
        NewTrack::new("markers", TrackContent::Markers(markers)),
        NewTrack::new("face", TrackContent::Curves(curves)),
    ])
}

/// Makes the corpus: imports, tracks, a study, a consent, a generated sign, something undone and something done again.
fn write(folder: &Path) -> Result<PathBuf, Box<dyn Error>> {
    let desk = tempfile::tempdir()?;
    let path = workers::small_corpus(desk.path(), "store.chereme")?;
    let mut corpus = Corpus::open_corpus(&path, "maker")?;
    corpus.keep_searches(&[KeptSearch {
        name: "chin".to_owned(),
        query: "right.configuration=S placement=chin".to_owned(),
    }])?;
    corpus.add_tracks(&RowName::Text("bowl and cat".to_owned()), &tracks()?)?;
    study::small_study(&mut corpus, desk.path())?;
    let change = ConsentChange {
        movement: Some(Some(ConsentAudience::Research)),
        ..ConsentChange::default()
    };
    let recording = CorpusAddress::Recording(RowName::Text("bowl and cat".to_owned()));
    corpus.change_consent(&[recording], &change)?;
    corpus.recombine_recipe("BOL | reverse", "LOB")?;
    corpus.undo_operation()?;
    corpus.redo_operation()?;
    corpus.recombine_recipe("CHAT | reverse", "TAHC")?;
    corpus.undo_operation()?;
    drop(corpus);
    let version = repository::schema_steps().len();
    let to = folder.join(format!("{version:04}.chereme.zst"));
    std::fs::create_dir_all(folder)?;
    std::fs::write(&to, zstd::encode_all(std::fs::File::open(&path)?, 19)?)?;
    Ok(to)
}
