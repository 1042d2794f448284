//! Files and folders that are made under a temporary name beside their place, and the removal of those that a killed
//! program left there.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use uuid::Uuid;

/// A leftover is at least this old: a younger one may be about to be locked.
const LEAST_AGE: Duration = Duration::from_secs(if cfg!(unix) { 2 } else { 24 * 60 * 60 });
/// The endings of the files that a database has beside it.
const DATABASE_COMPANION_ENDINGS: [&str; 3] = ["-wal", "-shm", "-journal"];

/// A file or folder under a temporary name; it is removed when it is dropped, unless it got its final name.
pub(crate) struct UnfinishedFile {
    path: PathBuf,
    /// Locked, so that other processes see that somebody works on it.
    _held: Option<File>,
}

impl UnfinishedFile {
    /// Creates an empty file beside `to`.
    pub(crate) fn create_unfinished_file(to: &Path) -> io::Result<Self> {
        let path = temporary_name(to);
        let lock = hold_file_lock(File::create_new(&path)?);
        Ok(Self { path, _held: lock })
    }

    /// Creates an empty folder beside `to`.
    pub(crate) fn create_unfinished_folder(to: &Path) -> io::Result<Self> {
        let path = temporary_name(to);
        fs::create_dir(&path)?;
        let lock = File::open(&path).ok().and_then(hold_file_lock);
        Ok(Self { path, _held: lock })
    }

    pub(crate) fn unfinished_path(&self) -> &Path {
        &self.path
    }

    /// Gives it its final name.
    pub(crate) fn rename_unfinished(&self, to: &Path) -> io::Result<()> {
        fs::rename(&self.path, to)
    }
}

impl Drop for UnfinishedFile {
    fn drop(&mut self) {
        remove_unfinished_path(&self.path);
    }
}

/// Removes what killed programs left under temporary names for the place `to`.
pub(crate) fn remove_leftovers(to: &Path) {
    let name = to.file_name().unwrap_or_default().to_string_lossy();
    // A path without a folder has an empty parent, which cannot be read.
    let folder = to.parent().filter(|folder| !folder.as_os_str().is_empty());
    remove_leftovers_in(folder.unwrap_or(Path::new(".")), |own| own == name);
}

/// Removes what killed programs left in a folder under temporary names for the names that `is_own` accepts.
pub(crate) fn remove_leftovers_in(folder: &Path, is_own: impl Fn(&str) -> bool) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let Some(main) = name.to_str().and_then(main_name) else {
            continue;
        };
        let is_wanted = final_name(main).is_some_and(&is_own);
        let path = folder.join(main);
        // Companions go with their file, or alone if it is gone.
        if is_wanted && (name.to_str() == Some(main) || !path.exists()) && is_abandoned(&entry.path()) {
            remove_unfinished_path(&path);
        }
    }
}

/// Returns the name of the file to which a file belongs: that of the database for its companions.
fn main_name(name: &str) -> Option<&str> {
    let ending = DATABASE_COMPANION_ENDINGS
        .iter()
        .find_map(|ending| name.strip_suffix(ending));
    Some(ending.unwrap_or(name)).filter(|main| main.starts_with('.'))
}

/// Returns the final name of a file under a temporary name of this program.
fn final_name(temporary: &str) -> Option<&str> {
    let (name, id) = temporary.strip_prefix('.')?.rsplit_once('.')?;
    // Other programs use hidden names, too; 32 letters of version 7 are those of this program's own.
    let id = Uuid::parse_str(id).ok().filter(|_| id.len() == 32)?;
    (id.get_version_num() == 7).then_some(name)
}

fn temporary_name(to: &Path) -> PathBuf {
    let name = to.file_name().unwrap_or_default().to_string_lossy();
    to.with_file_name(format!(".{name}.{}", Uuid::now_v7().simple()))
}

/// Returns whether a file or folder is old and no process holds it.
fn is_abandoned(path: &Path) -> bool {
    let modified = fs::symlink_metadata(path).and_then(|found| found.modified());
    let is_old = modified.is_ok_and(|then| then.elapsed().is_ok_and(|age| age > LEAST_AGE));
    is_old && is_free(path)
}

#[cfg(unix)]
fn hold_file_lock(file: File) -> Option<File> {
    file.try_lock().is_ok().then_some(file)
}

#[cfg(unix)]
fn is_free(path: &Path) -> bool {
    File::open(path).is_ok_and(|file| file.try_lock().is_ok())
}

/// Returns nothing: a lock of other systems would keep the database from its own file.
#[cfg(not(unix))]
fn hold_file_lock(_: File) -> Option<File> {
    None
}

#[cfg(not(unix))]
fn is_free(_: &Path) -> bool {
    true
}

/// Removes a file with its companions, or a folder; what is not there needs no removal.
fn remove_unfinished_path(path: &Path) {
    // A link is judged as such, so that nothing behind it is removed.
    if fs::symlink_metadata(path).is_ok_and(|found| found.is_dir()) {
        drop(fs::remove_dir_all(path));
        return;
    }
    drop(fs::remove_file(path));
    for ending in DATABASE_COMPANION_ENDINGS {
        let mut name = path.as_os_str().to_owned();
        name.push(ending);
        drop(fs::remove_file(name));
    }
}

#[cfg(all(test, unix))]
mod tests;
