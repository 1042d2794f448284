//! Writes plots, which are drawn as SVG only.

use std::io::Write as _;
use std::path::Path;

use super::write;
use crate::error::{Error, Result};

/// Writes the text of an SVG to a file whose name says so, and returns its size in bytes.
///
/// # Errors
/// Fails if the name does not end in `.svg`, the file cannot be written, or it exists and `force` is false.
pub(crate) fn write_svg(to: &Path, force: bool, text: &str) -> Result<u64> {
    if to
        .extension()
        .is_none_or(|it| !it.eq_ignore_ascii_case("svg"))
    {
        return Err(
            Error::wrong("the name does not end in .svg, but the picture is an SVG")
                .at(to.display().to_string())
                .advise("give a name that ends in .svg"),
        );
    }
    write(to, force, |out| {
        out.write_all(text.as_bytes())
            .map_err(|error| Error::file(to, error))
    })
}
