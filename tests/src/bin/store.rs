//! Writes a small corpus of today's schema, so that later versions can show that they still open it.
//!
//! `cargo run -p chereme-tests --bin chereme-store -- tests/stores` writes `NNNN.chereme.zst`, where NNNN
//! is the version of the schema. It is run once for each schema version, before that is released, and
//! never again: the files show that what was written then is still read.

use std::error::Error;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use chereme_corpus::{Corpus, KeptSearch};
use chereme_tests::{repository, workers};

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

/// Makes the corpus: imports, a made sign, something undone and something done again.
fn write(folder: &Path) -> Result<PathBuf, Box<dyn Error>> {
    let desk = tempfile::tempdir()?;
    let path = workers::small_corpus(desk.path(), "store.chereme")?;
    let mut corpus = Corpus::open(&path, "maker")?;
    corpus.keep_searches(&[KeptSearch {
        name: "chin".to_owned(),
        query: "right.configuration=S placement=chin".to_owned(),
    }])?;
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
