//! Completion of typed paths.

use std::fs;
use std::path::{MAIN_SEPARATOR, Path};

/// In folders with more entries only this many are considered.
const MOST: usize = 5000;

/// Returns the files and folders whose paths begin with a typed one, folders first and with a final separator; hidden
/// ones only after a dot. An unreadable folder gives an empty list.
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
    for entry in entries.take(MOST).flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let hidden = name.starts_with('.') && !start.starts_with('.');
        if hidden || !name.to_lowercase().starts_with(&wanted) {
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

#[cfg(test)]
mod tests {
    use super::*;

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
        assert_eq!(names("").len(), 4);
        assert!(names("nowhere/").is_empty() && paths_like("plain").is_empty());
    }
}
