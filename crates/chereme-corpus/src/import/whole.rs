//! Reads files whole, if they are files that can be.

use std::fs;
use std::path::Path;

use crate::error::{Error, Result};

/// Refuses what is no regular file, such as a pipe, which may never end; a path that leads nowhere passes.
pub(super) fn check_kind(path: &Path) -> Result<()> {
    match fs::metadata(path) {
        Ok(found) if !found.is_file() => Err(Error::wrong(
            "it is no regular file, but a pipe, a socket or a device",
        )
        .at(path.display().to_string())
        .advise("save what comes from it as a file, and import that")),
        _ => Ok(()),
    }
}

/// Returns the bytes of a file, if it is a regular one.
pub(super) fn read(path: &Path) -> Result<Vec<u8>> {
    check_kind(path)?;
    fs::read(path).map_err(|error| Error::file(path, error))
}
