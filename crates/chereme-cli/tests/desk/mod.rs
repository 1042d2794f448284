//! A desk to try commands on: a corpus, the files that it was made of, and the program.

pub(crate) mod cases;

use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use chereme_tests::files;
use serde_json::Value;

use cases::{Case, ERROR};

/// A folder with a corpus and files to try commands on.
pub(super) struct Desk {
    pub(super) folder: tempfile::TempDir,
}

impl Desk {
    pub(super) fn new() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let desk = Self { folder };
        let inbox = desk.inbox();
        fs::create_dir_all(&inbox).expect("a folder");
        fs::create_dir_all(desk.more()).expect("a folder");
        for (name, text) in [
            ("bowl.bvh", files::bvh(200, 1)),
            ("bowl.eaf", files::two_signs()),
            ("words.tsv", files::lexicon().to_owned()),
            ("notated.sigml", files::sigml().to_owned()),
            ("notes.txt", "no joint is named here\n".to_owned()),
        ] {
            fs::write(inbox.join(name), text).expect("written");
        }
        let made = desk.folder.path().join("template");
        let line = format!("import {} {} --author maker", made.display(), inbox.display());
        let done = desk.run(&line);
        assert!(done.status.success(), "{}", text(&done.stderr));
        for (name, text) in [
            ("broken.bvh", "a skeleton should be here\n".to_owned()),
            ("broken.sigml", "<sigml>\n<hns_sign>\n".to_owned()),
            ("other.bvh", files::bvh(40, 2)),
            (
                "language.json",
                r#"{"version": 1, "values": {"move.normal": [0.3, "arm", "mine"]}}"#.to_owned(),
            ),
            (
                "changes.csv",
                "recording,tier,start,end,value\nbowl,Gloss,1.6,1.8,JOUR\n".to_owned(),
            ),
        ] {
            fs::write(desk.more().join(name), text).expect("written");
        }
        desk
    }

    pub(super) fn inbox(&self) -> PathBuf {
        self.folder.path().join("inbox")
    }

    pub(super) fn more(&self) -> PathBuf {
        self.folder.path().join("more")
    }

    /// Returns a fresh copy of the corpus.
    pub(super) fn corpus(&self) -> PathBuf {
        let path = self.folder.path().join("small.chereme");
        for end in ["-wal", "-shm"] {
            let _ = fs::remove_file(self.folder.path().join(format!("small.chereme{end}")));
        }
        fs::copy(self.folder.path().join("template"), &path).expect("copied");
        path
    }

    /// Writes the words of a case out, with a fresh corpus and a fresh folder.
    pub(super) fn words(&self, line: &str) -> String {
        let empty = self.folder.path().join("empty");
        let _ = fs::remove_dir_all(&empty);
        fs::create_dir(&empty).expect("a folder");
        line.replace("@c", &self.corpus().display().to_string())
            .replace("@in", &self.inbox().display().to_string())
            .replace("@more", &self.more().display().to_string())
            .replace("@d", &empty.display().to_string())
    }

    /// Runs the program with words parted by blanks; words with blanks stand in single quotes.
    pub(super) fn run(&self, line: &str) -> Output {
        self.pipe(line, b"")
    }

    /// Does the same, with `input` on standard input.
    pub(super) fn pipe(&self, line: &str, input: &[u8]) -> Output {
        let mut words = Vec::new();
        for (at, part) in line.split('\'').enumerate() {
            if at % 2 == 1 {
                words.push(part);
            } else {
                words.extend(part.split_whitespace());
            }
        }
        let mut child = Command::new(env!("CARGO_BIN_EXE_chereme"))
            .args(words)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .env_remove("CHEREME_AUTHOR")
            .env("LC_ALL", "C")
            .current_dir(self.folder.path())
            .spawn()
            .expect("the program runs");
        let mut stdin = child.stdin.take().expect("a pipe");
        // A program that reads nothing may be gone by now.
        let _ = stdin.write_all(input);
        drop(stdin);
        child.wait_with_output().expect("the program ends")
    }

    pub(super) fn json(&self, line: &str) -> Value {
        let done = self.run(&format!("{line} --json"));
        serde_json::from_slice(&done.stdout).expect("JSON")
    }

    pub(super) fn try_json(&self, (line, code, keys): &Case) -> Result<(), String> {
        let done = self.run(&format!("{} --json", self.words(line)));
        expect_code(&done, *code)?;
        let out = text(&done.stdout);
        let document: Value =
            serde_json::from_str(&out).map_err(|error| format!("not one JSON document ({error}): {out}"))?;
        for key in *keys {
            if document.pointer(key).is_none() {
                return Err(format!("lacks {key}: {document}"));
            }
        }
        if *keys == ERROR {
            let error = &document["error"];
            let message = error["message"].as_str().unwrap_or_default();
            if message.is_empty() || (*code == 1 && message.ends_with('.')) {
                return Err(format!("the message is no phrase: {message:?}"));
            }
            let advises = message.contains("; ") || message.contains("did you mean");
            if error["remedy"].is_null() && !advises {
                return Err(format!("no word of what would be right: {document}"));
            }
        } else if document.get("error").is_some() {
            return Err(format!("an error that none should be: {document}"));
        }
        Ok(())
    }

    pub(super) fn try_text(&self, (line, code, keys): &Case) -> Result<(), String> {
        let done = self.run(&self.words(line));
        expect_code(&done, *code)?;
        let (out, err) = (text(&done.stdout), text(&done.stderr));
        if *keys == ERROR {
            if out.contains("error") {
                return Err(format!("an error is told on standard output: {out}"));
            }
            if !err.starts_with("error: ") {
                return Err(format!("the error does not say so: {err}"));
            }
        } else if out.trim().is_empty() || out.trim_start().starts_with('{') {
            return Err(format!("no words for people: {out}"));
        }
        if err.contains("panicked") {
            return Err(err);
        }
        Ok(())
    }
}

fn expect_code(done: &Output, code: i32) -> Result<(), String> {
    match done.status.code() {
        Some(found) if found == code => Ok(()),
        found => Err(format!(
            "exit code {found:?} and not {code}: {}{}",
            text(&done.stdout),
            text(&done.stderr)
        )),
    }
}

pub(super) fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}
