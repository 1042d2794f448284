//! A log of changes (`-wal`) that another file has left beside a corpus, such as one that was replaced by a backup after
//! its program was killed. SQLite would write its pages into the file that is there now.

use std::fs::{self, Metadata};
use std::path::{Path, PathBuf};
#[cfg(unix)]
use std::time::Duration;
use std::time::SystemTime;

use rusqlite::config::DbConfig;
use rusqlite::{Connection, OpenFlags};

use crate::error::{CorpusError, CorpusResult};

/// Moves a log aside that does not belong to the file at `path`: the file came there after the log was written, is
/// whole without it, and broken with it. `unchanging` is the URI of the file without its log.
pub(super) fn set_aside(path: &Path, unchanging: &str) -> CorpusResult<()> {
    let log = companion_path(path, "-wal");
    // The log of a killed program is the file's own if the file is whole with it, whatever the times say.
    if !came_later(path, &log) || is_whole(path.as_os_str()) || !is_whole(unchanging) {
        return Ok(());
    }
    let fault = |error| CorpusError::from_file_failure(&log, error);
    fs::rename(&log, companion_path(path, "-wal.stale")).map_err(fault)?;
    // The index of the log is made again from the log.
    drop(fs::remove_file(companion_path(path, "-shm")));
    Ok(())
}

/// Returns the path of a companion of the file.
pub(super) fn companion_path(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(ending);
    name.into()
}

/// Returns whether a file was written or put at its path after a log that holds something.
fn came_later(path: &Path, log: &Path) -> bool {
    let (Ok(file), Ok(log)) = (path.metadata(), log.metadata()) else {
        return false;
    };
    log.len() > 0 && log.modified().is_ok_and(|written| written < file_placed_time(&file))
}

/// Returns when a file was written or put at its path.
#[cfg(unix)]
fn file_placed_time(file: &Metadata) -> SystemTime {
    use std::os::unix::fs::MetadataExt as _;
    // The time of change, unlike that of modification, also moves when a file is copied or renamed into
    // place.
    let nanos = u32::try_from(file.ctime_nsec()).unwrap_or_default();
    let changed = Duration::new(file.ctime().max(0).cast_unsigned(), nanos);
    SystemTime::UNIX_EPOCH + changed
}

/// Returns when a file was written; other systems do not tell when it was put at its path.
#[cfg(not(unix))]
fn file_placed_time(file: &Metadata) -> SystemTime {
    file.modified().unwrap_or(SystemTime::UNIX_EPOCH)
}

/// Returns whether the pages of a database fit each other; a reader never writes the log into the file.
fn is_whole(name: impl AsRef<Path>) -> bool {
    let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX | OpenFlags::SQLITE_OPEN_URI;
    let answer = Connection::open_with_flags(name, flags).and_then(|reader| {
        // Closing would otherwise write the log into the file that is being tested.
        reader.set_db_config(DbConfig::SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, true)?;
        reader.query_row("PRAGMA quick_check(1)", [], |row| row.get::<_, String>(0))
    });
    answer.is_ok_and(|line| line == "ok")
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use crate::{Corpus, KeptSearch, ignore_progress_step};

    fn keep_many_searches(corpus: &mut Corpus, name: &str) {
        for at in 0..40 {
            let query = KeptSearch {
                name: format!("{name} {at} {}", "x".repeat(2000)),
                query: "configuration=S".into(),
            };
            corpus.keep_searches(&[query]).expect("kept");
        }
    }

    fn count_saved_searches(path: &Path) -> usize {
        let corpus = Corpus::open_corpus(path, "A").expect("opened");
        corpus.load_corpus_overview(1).expect("read").searches.len()
    }

    #[test]
    fn a_log_is_used_with_its_own_file_only() {
        let folder = tempfile::tempdir().expect("a folder");
        let place = |name: &str| folder.path().join(name);
        let path = place("c.chereme");
        let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
        keep_many_searches(&mut corpus, "first");
        drop(corpus);
        fs::copy(&path, place("backup")).expect("copied");
        let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
        keep_many_searches(&mut corpus, "second");
        let checkpoint = "PRAGMA wal_checkpoint(TRUNCATE)";
        let read = |corpus: &Corpus| corpus.store.read_connection().query_row(checkpoint, [], |_| Ok(()));
        read(&corpus).expect("written");
        keep_many_searches(&mut corpus, "third");
        // What a killed program leaves.
        fs::copy(&path, place("killed")).expect("copied");
        fs::copy(companion_path(&path, "-wal"), place("log")).expect("copied");
        drop(corpus);
        for (file, searches, stale) in [("killed", 120, false), ("backup", 40, true)] {
            let path = place(&format!("{file}.chereme"));
            fs::copy(place("log"), companion_path(&path, "-wal")).expect("copied");
            fs::copy(place(file), &path).expect("copied");
            assert_eq!(count_saved_searches(&path), searches, "{file}");
            assert_eq!(companion_path(&path, "-wal.stale").exists(), stale, "{file}");
            let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
            let mut hear = ignore_progress_step;
            let report = corpus.check_corpus(false, &mut crate::ProgressReceiver::new(&mut hear));
            assert_eq!(report.expect("checked").faults, [], "{file}");
        }
    }
}
