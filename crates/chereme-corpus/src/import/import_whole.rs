//! Reads files whole, if they are files that can be.

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use crate::error::{CorpusError, CorpusResult};

/// The size of the largest file that is read whole, in bytes.
const MAX_WHOLE_FILE_BYTES: u64 = 512 << 20;

/// Refuses what is no regular file, such as a pipe, which may never end; a path that leads nowhere passes.
pub(super) fn check_kind(path: &Path) -> CorpusResult<()> {
    match fs::metadata(path) {
        Ok(found) if !found.is_file() => Err(CorpusError::from_wrong_message(
            "it is no regular file, but a pipe, a socket or a device",
        )
        .with_error_place(path.display().to_string())
        .with_advice("save what comes from it as a file, and import that")),
        _ => Ok(()),
    }
}

/// Refuses what is no regular file, and files that are too large to be read whole.
pub(super) fn check_whole_file(path: &Path) -> CorpusResult<()> {
    check_kind(path)?;
    let file_info = fs::metadata(path).map_err(|error| CorpusError::from_file_failure(path, error))?;
    match file_info.len() {
        size if size > MAX_WHOLE_FILE_BYTES => Err(too_large(path, format!("the file has {size} bytes"))),
        _ => Ok(()),
    }
}

/// Returns the bytes of a file that can be read whole.
pub(super) fn read_whole_file(path: &Path) -> CorpusResult<Vec<u8>> {
    check_whole_file(path)?;
    let file = File::open(path).map_err(|error| CorpusError::from_file_failure(path, error))?;
    read_stream(file, path)
}

/// Returns the bytes of a stream, such as standard input, which the error calls `path`.
///
/// # Errors
/// Fails if the stream cannot be read, or has more bytes than a file that is read whole may have; the rest is not
/// read then.
pub fn read_stream(stream: impl Read, path: &Path) -> CorpusResult<Vec<u8>> {
    read_stream_within(MAX_WHOLE_FILE_BYTES, stream, path)
}

fn read_stream_within(largest: u64, stream: impl Read, path: &Path) -> CorpusResult<Vec<u8>> {
    let mut bytes = Vec::new();
    stream
        // One byte more than allowed shows that the stream goes on.
        .take(largest + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| CorpusError::from_file_failure(path, error))?;
    if bytes.len() as u64 > largest {
        let message = format!("the file has more than {largest} bytes");
        return Err(too_large(path, message));
    }
    Ok(bytes)
}

fn too_large(path: &Path, message: String) -> CorpusError {
    CorpusError::from_wrong_message(message)
        .with_error_place(path.display().to_string())
        .with_advice("a file that is read whole has at most 512 MiB; a BVH file that is named may be larger")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stream_is_read_up_to_the_limit_and_no_further() {
        let path = Path::new("-");
        assert_eq!(read_stream_within(3, &b"abc"[..], path).expect("read"), b"abc");
        let mut rest = &b"abcdef"[..];
        let error = read_stream_within(3, &mut rest, path).expect_err("too large");
        assert_eq!(error.to_string(), "the file has more than 3 bytes");
        assert!(error.error_remedy().is_some());
        assert_eq!(rest, b"ef", "one byte shows that it is too large");
        assert!(read_stream_within(1 << 16, std::io::repeat(0), path).is_err());
    }

    #[test]
    fn a_file_that_is_too_large_is_refused_by_its_size() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.eaf");
        let file = File::create(&path).expect("made");
        file.set_len(MAX_WHOLE_FILE_BYTES).expect("set");
        assert!(check_whole_file(&path).is_ok());
        file.set_len(12 << 30).expect("set");
        let error = read_whole_file(&path).expect_err("too large");
        assert_eq!(error.to_string(), "the file has 12884901888 bytes");
    }
}
