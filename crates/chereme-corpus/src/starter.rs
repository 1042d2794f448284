//! The starter corpus: recordings and annotation files made by a program, held in the binary.

use std::fs;
use std::path::{Path, PathBuf};

use include_dir::{Dir, include_dir};

use crate::error::{Error, Result};

static FILES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/../../corpus");

/// Returns the names and bytes of the starter corpus's files.
pub fn starter_files() -> impl Iterator<Item = (&'static Path, &'static [u8])> {
    FILES.files().map(|file| (file.path(), file.contents()))
}

/// Writes the starter corpus's files into `folder`, which is made, and returns their paths.
///
/// # Errors
/// [`Error::File`] where a file cannot be written, or is there already with other bytes.
pub fn unpack_starter(folder: &Path) -> Result<Vec<PathBuf>> {
    fs::create_dir_all(folder).map_err(|error| Error::file(folder, error))?;
    let mut paths = Vec::new();
    for (name, bytes) in starter_files() {
        let path = folder.join(name);
        let same = fs::read(&path).is_ok_and(|there| there == bytes);
        if path.exists() && !same {
            return Err(Error::file(path, std::io::ErrorKind::AlreadyExists.into()));
        }
        fs::write(&path, bytes).map_err(|error| Error::file(&path, error))?;
        paths.push(path);
    }
    paths.sort();
    Ok(paths)
}
