//! Files that are written completely or not at all.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use crate::db::unfinished::{UnfinishedFile, remove_leftovers};
use crate::error::{CorpusError, CorpusResult};

/// Writes a file under a temporary name beside its path, and renames it when it is complete.
pub(crate) fn write_atomically(
    to: &Path,
    force: bool,
    fill: impl FnOnce(&mut BufWriter<File>) -> CorpusResult<()>,
) -> CorpusResult<u64> {
    if !force && to.exists() {
        return Err(CorpusError::from_file_failure(
            to,
            std::io::ErrorKind::AlreadyExists.into(),
        ));
    }
    crate::export::check_folder(to)?;
    remove_leftovers(to);
    let fault = |error| CorpusError::from_file_failure(to, error);
    let part = UnfinishedFile::create_unfinished_file(to).map_err(fault)?;
    let file = File::options().write(true).open(part.unfinished_path());
    let mut out = BufWriter::new(file.map_err(fault)?);
    fill(&mut out).and_then(|()| out.flush().map_err(fault))?;
    drop(out);
    part.rename_unfinished(to).map_err(fault)?;
    Ok(std::fs::metadata(to).map_err(fault)?.len())
}

/// Returns the ending of a file's name in lower case.
pub(super) fn lowercase_extension(path: &Path) -> String {
    path.extension()
        .map(|ending| ending.to_string_lossy().to_lowercase())
        .unwrap_or_default()
}
