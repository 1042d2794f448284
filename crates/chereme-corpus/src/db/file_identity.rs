//! The file of an open corpus, which may be deleted or moved meanwhile.

use std::fs::Metadata;
use std::path::{Path, PathBuf};

/// Identity of the file at a path, at one moment.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileIdentity {
    path: PathBuf,
    /// The system's own id of the file, if it has one.
    id: Option<(u64, u64)>,
}

impl FileIdentity {
    /// Returns the identity of the file that is at `path` now.
    #[must_use]
    pub fn from_file_path(path: &Path) -> Self {
        Self {
            path: path.to_owned(),
            id: path.metadata().ok().as_ref().and_then(device_file_number),
        }
    }

    pub(crate) fn identity_path(&self) -> &Path {
        &self.path
    }

    /// Returns whether that file is still at its path: not deleted, moved or replaced.
    #[must_use]
    pub fn is_same_file_present(&self) -> bool {
        match self.path.metadata() {
            // A system without numbers of files cannot recognise a replaced file, so that any file at the path
            // counts.
            Ok(now) => self.id.is_none() || device_file_number(&now) == self.id,
            Err(error) => error.kind() != std::io::ErrorKind::NotFound,
        }
    }
}

/// Returns the device and the number of a file.
#[cfg(unix)]
fn device_file_number(file: &Metadata) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt as _;
    Some((file.dev(), file.ino()))
}

/// Returns nothing: other systems do not let an open file be replaced.
#[cfg(not(unix))]
fn device_file_number(_: &Metadata) -> Option<(u64, u64)> {
    None
}

#[cfg(all(test, unix))]
mod tests;
