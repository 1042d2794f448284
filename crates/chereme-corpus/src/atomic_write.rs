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
        return Err(CorpusError::from_existing_file(to));
    }
    check_folder(to)?;
    remove_leftovers(to);
    let fault = |error| CorpusError::from_file_failure(to, error);
    let part = UnfinishedFile::create_unfinished_file(to).map_err(fault)?;
    let file = File::options().write(true).open(part.unfinished_path());
    let mut out = BufWriter::new(file.map_err(fault)?);
    // The rest of the buffer may fail to be written, and then the old file must stay.
    fill(&mut out).and_then(|()| out.flush().map_err(fault))?;
    // Some systems do not rename a file that is open.
    drop(out);
    part.rename_unfinished(to).map_err(fault)?;
    Ok(std::fs::metadata(to).map_err(fault)?.len())
}

/// Returns the ending of a file's name in lower case.
pub(crate) fn lowercase_extension(path: &Path) -> String {
    path.extension()
        .map(|ending| ending.to_string_lossy().to_lowercase())
        .unwrap_or_default()
}

/// Writes the text of an SVG to a file whose name says so, and returns its size in bytes.
///
/// # Errors
/// Fails if the name does not end in `.svg`, the file cannot be written, or it exists and `force` is false.
pub(crate) fn write_svg(to: &Path, force: bool, text: &str) -> CorpusResult<u64> {
    if to.extension().is_none_or(|ending| !ending.eq_ignore_ascii_case("svg")) {
        return Err(
            CorpusError::from_wrong_message("the name does not end in .svg, but the picture is an SVG")
                .with_error_place(to.display().to_string())
                .with_advice("give a name that ends in .svg"),
        );
    }
    write_atomically(to, force, |out| {
        out.write_all(text.as_bytes())
            .map_err(|error| CorpusError::from_file_failure(to, error))
    })
}

/// Fails if the folder of the path does not exist.
pub(crate) fn check_folder(to: &Path) -> CorpusResult<()> {
    let folder = to.parent().unwrap_or(to);
    if folder.as_os_str().is_empty() || folder.is_dir() {
        return Ok(());
    }
    let message = format!("the folder {} is not there", folder.display());
    Err(CorpusError::from_wrong_message(message).with_advice("make it first, or choose another place"))
}
