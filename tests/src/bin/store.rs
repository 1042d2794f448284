//! Writes a small corpus of today's schema, so that later versions can show that they still open it.
//!
//! `cargo run -p chereme-tests --bin chereme-store -- tests/stores` writes `NNNN.chereme.zst`, where NNNN
//! is the version of the schema. It is run once for each schema version, before that is released, and
//! never again: the files show that what was written then is still read.

use std::error::Error;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use chereme_corpus::{Address, Audience, ConsentChange, Corpus, KeptSearch, Name, NewTrack, Track};
use chereme_motion::column::{Column, Gaps};
use chereme_motion::{Convention, Curve, Curves, Marker, Markers, Rate, Space, Times};
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
    let floats = |phase| Column::singles((0..600).map(|at| wave(at, phase)).collect());
    let whole = (0..600).map(|at| (wave(at, 0.5) * 3000.0) as i32).collect();
    let whole = Column::integers(whole, 0.0, 0.1)?.with_gaps(&Gaps::at(20..40))?;
    let point = |name, phase| {
        Marker::new(
            name,
            vec![floats(phase), floats(phase + 1.0), whole.clone()],
        )
    };
    let points = vec![point("LWRA", 0.0), point("RWRA", 2.0)];
    let markers = Markers::new(
        Times::Even(Rate::new(120, 1)?),
        Space::World(Convention::MODEL),
        points,
    )?;
    let seconds = (0..600).map(|at| f64::from(at) * 0.0167 + f64::from(at % 5) * 0.001);
    let times = Times::listed(Column::doubles(seconds.collect()))?;
    let curves = Curves::new(times, vec![Curve::new("JawOpen", floats(0.25))])?;
    Ok(vec![
        NewTrack::new("markers", Track::Markers(markers)),
        NewTrack::new("face", Track::Curves(curves)),
    ])
}

/// Makes the corpus: imports, tracks, a study, a consent, a generated sign, something undone and something done again.
fn write(folder: &Path) -> Result<PathBuf, Box<dyn Error>> {
    let desk = tempfile::tempdir()?;
    let path = workers::small_corpus(desk.path(), "store.chereme")?;
    let mut corpus = Corpus::open(&path, "maker")?;
    corpus.keep_searches(&[KeptSearch {
        name: "chin".to_owned(),
        query: "right.configuration=S placement=chin".to_owned(),
    }])?;
    corpus.add_tracks(&Name::Text("bowl and cat".to_owned()), &tracks()?)?;
    study::small_study(&mut corpus, desk.path())?;
    let change = ConsentChange {
        movement: Some(Some(Audience::Research)),
        ..ConsentChange::default()
    };
    let recording = Address::Recording(Name::Text("bowl and cat".to_owned()));
    corpus.change_consent(&[recording], &change)?;
    corpus.recombine("BOL | reverse", "LOB")?;
    corpus.undo()?;
    corpus.redo()?;
    corpus.recombine("CHAT | reverse", "TAHC")?;
    corpus.undo()?;
    drop(corpus);
    let version = repository::schema_steps().len();
    let to = folder.join(format!("{version:04}.chereme.zst"));
    std::fs::create_dir_all(folder)?;
    std::fs::write(&to, zstd::encode_all(std::fs::File::open(&path)?, 19)?)?;
    Ok(to)
}
