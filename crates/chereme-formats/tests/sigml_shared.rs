//! SiGML of other people, read, written and read again.
//!
//! The files are not part of the repository: their folder is named by `CHEREME_SHARED_DATA`.

#![allow(clippy::print_stderr, reason = "a test may speak")]

use chereme_formats::{FindingSeverity, ImportFinding, sigml};
use std::path::PathBuf;

fn files() -> Vec<PathBuf> {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA is not set");
        return Vec::new();
    };
    let folder = PathBuf::from(folder).join("notation/sigml");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .expect("the folder is there")
        .map(|entry| entry.expect("it can be listed").path())
        .collect();
    files.sort();
    files
}

#[test]
fn real_files_read_write_and_read_again_equal() {
    for path in files() {
        let bytes = std::fs::read(&path).expect("the file can be read");
        let (signs, findings) = sigml::read_sigml_signs(&bytes).unwrap_or_else(|e| panic!("{path:?}: {e}"));
        assert!(!signs.is_empty(), "{path:?}");
        let lines = bytes.iter().filter(|byte| **byte == b'\n').count() as u64 + 1;
        for finding in &findings {
            let line = finding.line.unwrap_or_else(|| panic!("{path:?}: {finding:?}"));
            assert!((1..=lines).contains(&line), "{path:?}: {finding:?}");
        }
        let written = sigml::write_gestural(signs.iter().map(|entry| &entry.sign));
        let (again, left) = sigml::read_sigml_signs(&written).unwrap_or_else(|e| panic!("{path:?}: {e}"));
        assert_eq!(again, signs, "{path:?}");
        let lost = |finding: &&ImportFinding| finding.severity == FindingSeverity::Warning;
        assert_eq!(left.iter().find(lost), None, "{path:?}");
        for entry in &signs {
            let json = serde_json::to_string(&entry.sign).expect("plain data");
            let back: chereme_sign::hamnosys::NotatedSign = serde_json::from_str(&json).expect("as written");
            assert_eq!(back, entry.sign, "{path:?}");
        }
    }
}
