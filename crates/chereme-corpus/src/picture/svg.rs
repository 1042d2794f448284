//! Writes plots, which are drawn as SVG only.

use std::io::Write as _;
use std::path::Path;

use super::write_atomically;
use crate::error::{CorpusError, CorpusResult};

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
