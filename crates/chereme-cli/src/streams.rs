//! Standard input and output instead of files, for arguments written `-`.

use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::Result;
use chereme_corpus::CorpusError;
use tempfile::TempDir;

/// Returns whether a path is `-`, which stands for standard input or output.
pub(crate) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Reads all of standard input; it may be as large as a file that is read whole.
pub(crate) fn read_stdin_bytes() -> Result<Vec<u8>> {
    Ok(chereme_corpus::read_stream(io::stdin().lock(), Path::new("-"))?)
}

/// Reads all of a file, or of standard input for `-`.
pub(crate) fn read_file_or_stdin(path: &Path) -> Result<Vec<u8>> {
    if is_standard(path) {
        return read_stdin_bytes();
    }
    Ok(std::fs::read(path).map_err(|error| CorpusError::from_file_failure(path, error))?)
}

/// Reads all of standard input as text.
pub(crate) fn read_stdin_text() -> Result<String> {
    let text = String::from_utf8(read_stdin_bytes()?);
    text.map_err(|_| {
        let advice = "write it in UTF-8, or name a file";
        CorpusError::from_wrong_message("standard input is no text")
            .with_error_place("-")
            .with_advice(advice)
            .into()
    })
}

/// A temporary file that replaces standard input or output while a command works.
pub(crate) struct StandInFile {
    /// Keeps the folder until the file is no longer needed.
    _folder: TempDir,
    /// The file.
    pub(crate) path: PathBuf,
}

/// Writes standard input to a temporary file `NAME.FORMAT`, for readers that need a file.
pub(crate) fn stdin_stand_in(name: &str, format: &str) -> Result<StandInFile> {
    let stand = stdout_stand_in(name, format)?;
    // Some readers choose by the name's ending and read from a file only.
    std::fs::write(&stand.path, read_stdin_bytes()?)
        .map_err(|error| CorpusError::from_file_failure(&stand.path, error))?;
    Ok(stand)
}

/// Returns the path for a temporary file `NAME.FORMAT`, which [`copy_to_stdout`] later writes to standard output.
pub(crate) fn stdout_stand_in(name: &str, format: &str) -> Result<StandInFile> {
    let folder = tempfile::tempdir()?;
    let format = format.trim_start_matches('.');
    let path = folder.path().join(format!("{name}.{format}"));
    Ok(StandInFile { _folder: folder, path })
}

/// Standard output for a document. If its reader stops before the end, as `head` does, the rest is dropped.
pub(crate) struct StdoutDocument {
    out: BufWriter<io::StdoutLock<'static>>,
    is_read: bool,
}

impl StdoutDocument {
    /// Returns standard output.
    pub(crate) fn new() -> Self {
        Self {
            out: BufWriter::new(io::stdout().lock()),
            is_read: true,
        }
    }

    /// Returns the result of an attempt to write, or `dropped` if the reader has stopped.
    fn heard<T>(&mut self, attempt: io::Result<T>, dropped: T) -> io::Result<T> {
        match attempt {
            // After the pipe broke, everything is taken and dropped, so that the command ends well.
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => {
                self.is_read = false;
                Ok(dropped)
            }
            other => other,
        }
    }
}

impl Write for StdoutDocument {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if !self.is_read {
            return Ok(bytes.len());
        }
        let attempt = self.out.write(bytes);
        self.heard(attempt, bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        if !self.is_read {
            return Ok(());
        }
        let attempt = self.out.flush();
        self.heard(attempt, ())
    }
}

/// Writes a file to standard output.
pub(crate) fn copy_to_stdout(stand: &StandInFile) -> Result<()> {
    let bytes = std::fs::read(&stand.path).map_err(|error| CorpusError::from_file_failure(&stand.path, error))?;
    let mut out = StdoutDocument::new();
    out.write_all(&bytes)?;
    Ok(out.flush()?)
}

/// Fails if `--json` is given although a file is written to standard output.
pub(crate) fn not_with_json(json: bool) -> Result<()> {
    if json {
        return Err(
            CorpusError::from_wrong_message("--json and --to - both want standard output")
                .with_error_place("-")
                .with_advice("leave --json out, or name a file")
                .into(),
        );
    }
    Ok(())
}
