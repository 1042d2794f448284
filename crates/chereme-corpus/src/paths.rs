//! Completion of typed paths, and names of files as text.

use std::ffi::OsStr;
use std::fmt::Write as _;
use std::fs;
use std::path::{MAIN_SEPARATOR, Path};

/// In folders with more entries only this many are considered.
const MAX_FOLDER_ENTRIES: usize = 5000;

/// Returns the files and folders whose paths begin with a typed one, folders first and with a final separator; hidden
/// ones only after a dot, and no files that the database of an open corpus keeps beside it. An unreadable folder gives
/// an empty list.
#[must_use]
pub fn paths_like(typed: &str) -> Vec<String> {
    let (folder, start) = match typed.rfind(['/', MAIN_SEPARATOR]) {
        Some(at) => typed.split_at(at + 1),
        None => return Vec::new(),
    };
    let Ok(entries) = fs::read_dir(Path::new(folder)) else {
        return Vec::new();
    };
    let wanted = start.to_lowercase();
    let (mut folders, mut files) = (Vec::new(), Vec::new());
    // Completion must answer at once, also in a folder with very many files.
    for entry in entries.take(MAX_FOLDER_ENTRIES).flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let hidden = name.starts_with('.') && !start.starts_with('.');
        if hidden || !name.to_lowercase().starts_with(&wanted) {
            continue;
        }
        if is_companion(&entry.path()) {
            continue;
        }
        if entry.path().is_dir() {
            folders.push(format!("{folder}{name}{MAIN_SEPARATOR}"));
        } else {
            files.push(format!("{folder}{name}"));
        }
    }
    folders.sort();
    files.sort();
    folders.append(&mut files);
    folders
}

/// Returns whether a file is kept by a database beside its own file while it is open.
fn is_companion(path: &Path) -> bool {
    let Some(name) = path.file_name().and_then(OsStr::to_str) else {
        return false;
    };
    let of = ["-shm", "-wal", "-journal"]
        .into_iter()
        .find_map(|ending| name.strip_suffix(ending));
    // The ending alone may belong to a file of the user.
    of.is_some_and(|name| path.with_file_name(name).is_file())
}

/// Returns a path or a name of a file as text, for storage and reports.
///
/// Bytes that are not UTF-8 become `%FF`, so that the texts of two such names differ too.
pub(crate) fn legible_path_text(name: impl AsRef<OsStr>) -> String {
    let mut text = String::new();
    for chunk in name.as_ref().as_encoded_bytes().utf8_chunks() {
        text.push_str(chunk.valid());
        for byte in chunk.invalid() {
            // Writing to a text never fails.
            let _ = write!(text, "%{byte:02X}");
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(target_os = "linux")]
    #[test]
    fn names_that_are_not_utf8_stay_apart_as_text() {
        use std::os::unix::ffi::OsStrExt as _;
        for (name, text) in [
            (&b"take\xff.eaf"[..], "take%FF.eaf"),
            (b"take\xfe.eaf", "take%FE.eaf"),
            (b"a\xc3/b\xe9\xe8", "a%C3/b%E9%E8"),
            ("caf\u{e9} 100%20.eaf".as_bytes(), "caf\u{e9} 100%20.eaf"),
        ] {
            assert_eq!(legible_path_text(OsStr::from_bytes(name)), text);
        }
    }

    #[test]
    fn a_path_is_completed_from_existing_names_folders_first() {
        let folder = tempfile::tempdir().expect("a folder");
        for name in ["bol.bvh", "Bol.eaf", "cat.bvh", ".bolt"] {
            fs::write(folder.path().join(name), "").expect("written");
        }
        fs::create_dir(folder.path().join("bolero")).expect("made");
        let base = format!("{}/", folder.path().display());
        let names = |typed: &str| -> Vec<String> {
            let all = paths_like(&format!("{base}{typed}"));
            all.iter().map(|it| it[base.len()..].to_owned()).collect()
        };
        let bolero = format!("bolero{MAIN_SEPARATOR}");
        assert_eq!(names("bol"), [bolero.as_str(), "Bol.eaf", "bol.bvh"]);
        assert_eq!(names(".b"), [".bolt"]);
        for (name, is_offered) in [
            ("mine.chereme", true),
            ("mine.chereme-shm", false),
            ("mine.chereme-wal", false),
            ("mine.chereme-journal", false),
            ("my-wal", true),
            ("-shm", true),
        ] {
            fs::write(folder.path().join(name), "").expect("written");
            assert_eq!(names(name).contains(&name.to_owned()), is_offered, "{name}");
            if is_offered && name != "mine.chereme" {
                fs::remove_file(folder.path().join(name)).expect("removed");
            }
        }
        for name in ["", "-shm", "-wal", "-journal"] {
            fs::remove_file(folder.path().join(format!("mine.chereme{name}"))).expect("removed");
        }
        assert_eq!(names("").len(), 4);
        assert!(names("nowhere/").is_empty() && paths_like("plain").is_empty());
    }
}
