//! The rules for every file of the repository: documented, short, whole, and of no one machine.

use std::fs;

use chereme_tests::repository::{self, TextFile};

const LONGEST: usize = 1200;
const GUIDE: usize = 250;

/// This file writes the words that it looks for.
const OWN: &str = "tests/tests/tidy.rs";

fn rust() -> Vec<TextFile> {
    let mut files = repository::rust_files();
    files.retain(|file| file.path != OWN);
    files
}

fn expect_none(what: &str, faults: &[String]) {
    assert!(faults.is_empty(), "{what}:\n  {}", faults.join("\n  "));
}

/// Lists the lines for which `wrong` returns true, as `path:line: text`.
fn lines_that<'a>(files: impl IntoIterator<Item = &'a TextFile>, wrong: impl Fn(&str) -> bool) -> Vec<String> {
    let mut faults = Vec::new();
    for file in files {
        for (at, line) in file.text.lines().enumerate() {
            if wrong(line) {
                let start: String = line.trim().chars().take(80).collect();
                faults.push(format!("{}:{}: {start}", file.path, at + 1));
            }
        }
    }
    faults
}

#[test]
fn every_rust_file_begins_with_a_module_comment() {
    let faults: Vec<String> = rust()
        .iter()
        .filter(|file| !file.text.starts_with("//!") && !file.is_test())
        .map(|file| file.path.clone())
        .collect();
    expect_none("files that do not begin with //!", &faults);
}

#[test]
fn no_file_is_too_long() {
    let files = rust();
    let lengths = files.iter().map(|file| (file, file.text.lines().count()));
    let faults: Vec<String> = lengths
        .filter(|(_, lines)| *lines > LONGEST)
        .map(|(file, lines)| format!("{} has {lines} lines: split it", file.path))
        .collect();
    expect_none("length", &faults);
}

#[test]
fn guides_are_short() {
    let mut files = repository::text_files();
    files.retain(|file| {
        file.path == "README.md" || (file.path.starts_with("crates/") && file.path.ends_with("/README.md"))
    });
    assert!(files.len() > 9, "{} guides", files.len());
    let lengths = files.iter().map(|file| (file, file.text.lines().count()));
    let faults: Vec<String> = lengths
        .filter(|(_, lines)| *lines > GUIDE)
        .map(|(file, lines)| format!("{} has {lines} lines", file.path))
        .collect();
    expect_none("guides that are too long", &faults);
}

#[test]
fn no_code_is_unfinished_or_disabled() {
    let words = ["#[ignore", "todo!(", "unimplemented!(", "dbg!("];
    let files = rust();
    let faults = lines_that(&files, |line| words.iter().any(|word| line.contains(word)));
    expect_none("unfinished", &faults);
}

#[test]
fn no_file_names_a_machine_or_a_ticket() {
    let paths = ["/home/", "/root/", "/work/", "/Users/", "C:\\Users"];
    let mut files = repository::text_files();
    files.retain(|file| file.path != OWN);
    let faults = lines_that(&files, |line| {
        paths.iter().any(|path| line.contains(path)) || names_a_ticket(line)
    });
    expect_none("paths of a machine, or tickets", &faults);
}

/// Returns whether a line says `issue 7` or `issue #7`.
fn names_a_ticket(line: &str) -> bool {
    let line = line.to_lowercase();
    line.match_indices("issue ").any(|(at, word)| {
        let rest = &line[at + word.len()..];
        rest.trim_start_matches('#')
            .starts_with(|first: char| first.is_ascii_digit())
    })
}

#[test]
fn every_crate_inherits_the_lints_of_the_workspace() {
    let root = repository::root();
    let mut manifests = vec![root.join("tests/Cargo.toml")];
    for entry in fs::read_dir(root.join("crates")).into_iter().flatten().flatten() {
        manifests.push(entry.path().join("Cargo.toml"));
    }
    assert!(manifests.len() > 7, "the crates are found");
    for path in manifests {
        let text = fs::read_to_string(&path).expect("a manifest");
        let inherits = text.contains("[lints]\nworkspace = true");
        assert!(inherits, "{} lacks [lints] workspace = true", path.display());
        for key in ["version", "edition", "rust-version", "license"] {
            let inherits = text.contains(&format!("{key}.workspace = true"));
            assert!(inherits, "{} lacks {key}.workspace = true", path.display());
        }
    }
}

#[test]
fn lints_are_silenced_only_with_a_reason() {
    let files = rust();
    let code = files.iter().filter(|file| !file.is_test());
    let faults = lines_that(code, |line| {
        let line = line.trim_start();
        (line.starts_with("#[allow(") || line.starts_with("#![allow(")) && !line.contains("reason")
    });
    expect_none("use #[expect(…, reason = …)] or give a reason", &faults);
}

#[test]
fn sql_stands_only_in_the_database_module() {
    let words = [
        "SELECT ",
        "INSERT INTO",
        "INSERT OR ",
        "DELETE FROM",
        "CREATE TABLE",
        "CREATE TEMP",
        "PRAGMA ",
    ];
    let files = rust();
    let outside = files.iter().filter(|file| {
        !file.is_test() && !file.path.starts_with("tests/") && !file.path.starts_with("crates/chereme-corpus/src/db/")
    });
    let mut faults = Vec::new();
    for file in outside {
        for (at, line) in file.code() {
            let update = line.contains("UPDATE ") && line.contains(" SET ");
            if update || words.iter().any(|word| line.contains(word)) {
                faults.push(format!("{}:{at}: {}", file.path, line.trim()));
            }
        }
    }
    expect_none("SQL outside crates/chereme-corpus/src/db", &faults);
}

#[test]
fn models_and_drawing_use_no_clock_files_or_network() {
    let words = [
        "std::fs",
        "std::env",
        "std::net",
        "std::process",
        "SystemTime",
        "Instant::now",
        "rand::",
        "thread_rng",
        "File::open",
    ];
    let pure = ["motion", "sign", "formats", "analysis", "compose", "figure"];
    let mut faults = Vec::new();
    for file in rust() {
        let library = pure
            .iter()
            .any(|name| file.path.starts_with(&format!("crates/chereme-{name}/src/")));
        if library && !file.is_test() {
            for (at, line) in file.code() {
                if words.iter().any(|word| line.contains(word)) {
                    faults.push(format!("{}:{at}: {}", file.path, line.trim()));
                }
            }
        }
    }
    expect_none("a library that reads the machine", &faults);
}

#[test]
fn the_corpus_reads_no_environment_and_prints_nothing() {
    let words = ["std::env", "env::var", "stdin()", "stdout()", "stderr()"];
    let mut faults = Vec::new();
    for file in rust() {
        if file.path.starts_with("crates/chereme-corpus/src/") && !file.is_test() {
            for (at, line) in file.code() {
                if words.iter().any(|word| line.contains(word)) {
                    faults.push(format!("{}:{at}: {}", file.path, line.trim()));
                }
            }
        }
    }
    expect_none("the corpus is a library", &faults);
}
