//! The program of the window: its help, wrong usage, and a system without a display.

use std::process::{Command, Output, Stdio};

use serde_json::Value;

fn run(words: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_chereme-studio"))
        .args(words)
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .env("LC_ALL", "C")
        .stdin(Stdio::null())
        .output()
        .expect("the program runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn help_and_version_go_to_standard_output() {
    for (words, beginning) in [
        (&["--help"] as &[_], "Open the workbench"),
        (&["-h", "--language", "fr"], "Ouvrir l’atelier"),
        (&["--version"], "chereme-studio "),
    ] {
        let done = run(words);
        assert_eq!(done.status.code(), Some(0), "{words:?}");
        assert!(text(&done.stdout).starts_with(beginning), "{words:?}");
    }
}

#[test]
fn wrong_usage_names_the_word_and_the_remedy() {
    let done = run(&["--thme", "dark"]);
    assert_eq!(done.status.code(), Some(2));
    assert_eq!(text(&done.stdout), "");
    let said = "error: unknown option --thme\n  what to do: chereme-studio --help lists the options\n";
    assert_eq!(text(&done.stderr), said);
    let done = run(&["--language=fr", "a", "b"]);
    let said = text(&done.stderr);
    assert!(
        said.starts_with("erreur : un seul corpus") && said.contains("que faire"),
        "{said}"
    );
    let done = run(&["--json", "--language=fr", "--folder"]);
    assert_eq!(done.status.code(), Some(2));
    let said: Value = serde_json::from_slice(&done.stdout).expect("JSON");
    assert_eq!(said["error"]["message"], "--folder needs a value");
    assert_eq!(said["error"]["remedy"], "chereme-studio --help lists the options");
}

#[cfg(target_os = "linux")]
#[test]
fn without_a_display_the_error_says_what_is_needed() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path().to_str().expect("a name");
    let done = run(&["--folder", folder]);
    assert_eq!(done.status.code(), Some(1));
    let said = text(&done.stderr);
    assert!(said.contains("error: no window can be opened"), "{said}");
    assert!(said.contains("what to do: a display"), "{said}");
    let done = run(&["--folder", folder, "--json", "--language", "fr"]);
    assert_eq!(done.status.code(), Some(1));
    let said: Value = serde_json::from_slice(&done.stdout).expect("JSON");
    let message = said["error"]["message"].as_str().unwrap_or_default();
    assert!(message.starts_with("no window can be opened"), "{said}");
    let done = run(&["--folder", folder, "--language", "fr"]);
    let said = text(&done.stderr);
    assert!(said.contains("aucune fenêtre ne peut s’ouvrir"), "{said}");
    assert!(said.contains("il faut un affichage"), "{said}");
}
