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
mod tests;
