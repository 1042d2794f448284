//! The start of the window, which is a program of its own: the words that it gets, and the message if it is missing.
//!
//! All of it is one test, because a program cannot be started while another thread holds its file open.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

/// Puts the program into a folder in which nothing else is.
fn alone(folder: &Path) -> PathBuf {
    let own = Path::new(env!("CARGO_BIN_EXE_chereme"));
    let program = folder.join(own.file_name().expect("a name"));
    if fs::hard_link(own, &program).is_err() {
        fs::copy(own, &program).expect("a copy");
    }
    program
}

fn run(program: &Path, words: &[&str]) -> Output {
    Command::new(program)
        .args(words)
        .env("PATH", "")
        .env("LC_ALL", "C")
        .stdin(Stdio::null())
        .output()
        .expect("the program runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn says_what_is_missing(program: &Path) {
    let done = run(program, &["studio"]);
    assert_eq!(done.status.code(), Some(1));
    assert_eq!(text(&done.stdout), "");
    let said = text(&done.stderr);
    for part in [
        "error: the window is a program of its own, chereme-studio",
        "what to do: in a checkout, build it with `cargo build --release`",
    ] {
        assert!(said.contains(part), "{said}");
    }
    let done = run(program, &["studio", "--language", "fr"]);
    let said = text(&done.stderr);
    for part in [
        "erreur : la fenêtre est un programme à part, chereme-studio",
        "que faire : dans un dépôt",
    ] {
        assert!(said.contains(part), "{said}");
    }
    let done = run(program, &["studio", "--json"]);
    assert_eq!(done.status.code(), Some(1));
    let said: Value = serde_json::from_slice(&done.stdout).expect("JSON");
    let error = &said["error"];
    let folder = program.parent().and_then(|it| it.canonicalize().ok());
    let folder = folder.map(|it| it.display().to_string());
    assert_eq!(error["where"].as_str(), folder.as_deref());
    assert!(error["remedy"].is_string(), "{said}");
}

/// Puts a program beside that prints its process and its words, and ends with code 7.
#[cfg(unix)]
fn passes_all_of_it_on(program: &Path) {
    use std::os::unix::fs::PermissionsExt as _;

    let folder = program.parent().expect("a folder");
    let other = folder.join("chereme-studio");
    fs::write(&other, "#!/bin/sh\nprintf '%s\\n' $$ \"$@\"\nexit 7\n").expect("a script");
    fs::set_permissions(&other, fs::Permissions::from_mode(0o755)).expect("rights");
    let corpus = folder.join("-mine.chereme");
    fs::write(&corpus, "").expect("a file");
    let corpus = corpus.display().to_string();
    let words = [
        "studio",
        "--json",
        "--author",
        "Anne Marie",
        "--language",
        "fr",
        "--folder",
        "rooms",
        &corpus,
    ];
    let child = Command::new(program)
        .args(words)
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program runs");
    let process = child.id().to_string();
    let done = child.wait_with_output().expect("it ends");
    assert_eq!(done.status.code(), Some(7));
    let said = text(&done.stdout);
    let passed = [
        &process,
        "--json",
        "--author",
        "Anne Marie",
        "--language",
        "fr",
        "--folder",
        "rooms",
        "--",
        &corpus,
    ];
    assert_eq!(said.lines().collect::<Vec<_>>(), passed);
    assert_eq!(run(program, &["studio"]).status.code(), Some(7));

    let done = run(program, &["studio", "none.chereme"]);
    assert_eq!(done.status.code(), Some(1), "a missing corpus");
    assert!(text(&done.stderr).contains("none.chereme"));
}

#[test]
fn the_window_is_a_program_of_its_own() {
    let folder = tempfile::tempdir().expect("a folder");
    let program = alone(folder.path());
    says_what_is_missing(&program);
    #[cfg(unix)]
    passes_all_of_it_on(&program);
}
