//! The contract with scripts: exit codes, one JSON document, errors with a place and a remedy, help.
//!
//! A command is tried by a line in a table: its words, its exit code, and the keys of its JSON. In the
//! words `@c` is a corpus of two signs and a small lexicon, `@in` the folder of files that it
//! was made of, `@more` a folder with another recording and one that is none, and `@d` an empty folder.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

/// Words, exit code, and pointers into the JSON document that must lead somewhere.
type Case = (&'static str, i32, &'static [&'static str]);

const ERROR: &[&str] = &["/error/message", "/error/where", "/error/remedy"];
const LOG: &[&str] = &["/total", "/rows"];
const IMPORT: &[&str] = &["/created", "/files", "/dry_run"];
const FILE: &[&str] = &[
    "/created",
    "/files/0/path",
    "/files/0/status",
    "/files/0/findings",
];
const REFUSED: &[&str] = &[
    "/files/0/status",
    "/files/0/findings/0/severity",
    "/files/0/findings/0/line",
    "/files/0/findings/0/message",
    "/files/0/findings/0/remedy",
];

const CASES: &[Case] = &[
    ("new @d/a.chereme", 0, &["/corpus"]),
    ("new @c", 1, ERROR),
    ("new @d/no/such/folder.chereme", 1, ERROR),
    ("new", 2, ERROR),
    ("import @d/a.chereme @in", 0, IMPORT),
    (
        "import @d/a.chereme @in/bowl.bvh --signer Ben --handedness left",
        0,
        FILE,
    ),
    ("import @c @in", 0, FILE),
    ("import @d/a.chereme @in --dry-run", 0, IMPORT),
    ("import @c @in/none.bvh", 1, ERROR),
    ("import @c @in/notes.txt", 1, ERROR),
    ("import @c @more/broken.bvh", 1, REFUSED),
    ("import @c @in/bowl.bvh --map @in/none.json", 1, ERROR),
    ("import @c @in/bowl.bvh --roles @in/notes.txt", 1, ERROR),
    ("import @c", 2, ERROR),
    ("import @c @in --unit furlong", 2, ERROR),
    ("import @c @in --axes sideways", 2, ERROR),
    ("import @c @in --handedness third", 2, ERROR),
    (
        "undo @c",
        0,
        &[
            "/operations/0/id",
            "/operations/0/kind",
            "/operations/0/target",
        ],
    ),
    ("undo @c --times 2", 1, ERROR),
    ("undo @d/none.chereme", 1, ERROR),
    ("undo @in/notes.txt", 1, ERROR),
    ("redo @c", 1, ERROR),
    (
        "log @c",
        0,
        &[
            "/total",
            "/rows/0/id",
            "/rows/0/at",
            "/rows/0/author",
            "/rows/0/stands",
        ],
    ),
    ("log @c --limit 0", 0, LOG),
    ("log @c --limit many", 2, ERROR),
    ("log @d/none.chereme", 1, ERROR),
    ("log @in", 1, ERROR),
    ("dance @c", 2, ERROR),
    ("log @c --no-such-option", 2, ERROR),
];

#[test]
fn each_command_keeps_to_its_exit_code_and_its_json() {
    let desk = Desk::new();
    let mut faults = Vec::new();
    for case in CASES {
        if let Err(fault) = desk.try_json(case) {
            faults.push(format!("{} --json: {fault}", case.0));
        }
        if let Err(fault) = desk.try_text(case) {
            faults.push(format!("{}: {fault}", case.0));
        }
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn every_command_has_a_help_that_says_what_it_does() {
    let desk = Desk::new();
    let help = desk.run("--help");
    assert_eq!(help.status.code(), Some(0));
    let commands = commands(&text(&help.stdout));
    for known in ["new", "import", "undo", "redo", "log"] {
        assert!(commands.iter().any(|(name, _)| name == known), "{known}");
    }
    for (name, about) in &commands {
        assert!(!about.is_empty(), "{name} is not described");
        let help = desk.run(&format!("{name} --help"));
        assert_eq!(help.status.code(), Some(0), "{name}");
        let help = text(&help.stdout);
        assert!(help.contains("Usage: chereme"), "{name}: {help}");
        assert!(help.contains("--json"), "{name}: {help}");
    }
    let nothing = desk.run("");
    assert_eq!(nothing.status.code(), Some(2));
    assert!(text(&nothing.stderr).contains("Usage: chereme"));
    let version = desk.run("--version");
    assert_eq!(version.status.code(), Some(0));
    assert!(text(&version.stdout).contains(env!("CARGO_PKG_VERSION")));
}

#[test]
fn what_was_done_can_be_undone_and_is_signed() {
    let desk = Desk::new();
    let corpus = desk.corpus();
    let path = corpus.display();
    let author = format!("undo {path} --author Ben");
    assert!(desk.run(&author).status.success());
    let log = desk.json(&format!("log {path}"));
    assert_eq!(log["rows"][0]["author"], "Ben");
    assert_eq!(log["rows"][0]["kind"], "undo");
    assert_eq!(log["rows"][1]["stands"], false);
    assert!(desk.run(&format!("redo {path}")).status.success());
    assert_eq!(desk.json(&format!("log {path}"))["rows"][2]["stands"], true);
}

#[test]
fn a_dry_run_leaves_nothing_behind() {
    let desk = Desk::new();
    let (corpus, inbox) = (desk.corpus(), desk.inbox());
    let line = format!(
        "import {} {} --dry-run",
        corpus.display(),
        desk.more().join("other.bvh").display()
    );
    assert_eq!(desk.json(&line)["created"]["recordings"], 1);
    let log = desk.json(&format!("log {}", corpus.display()));
    assert_eq!(log["total"], 1, "only that of the maker: {log}");
    let absent = desk.folder.path().join("absent.chereme");
    let line = format!("import {} {} --dry-run", absent.display(), inbox.display());
    let report = desk.json(&line);
    assert_eq!(report["dry_run"], true);
    assert_eq!(report["created"]["recordings"], 1);
    assert!(!absent.exists());
}

/// A folder with a corpus and files to try commands on.
struct Desk {
    folder: tempfile::TempDir,
}

impl Desk {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let desk = Self { folder };
        let inbox = desk.inbox();
        fs::create_dir_all(&inbox).expect("a folder");
        fs::create_dir_all(desk.more()).expect("a folder");
        for (name, text) in [
            ("bowl.bvh", BVH),
            ("bowl.eaf", EAF),
            ("words.tsv", LEXICON),
            ("notes.txt", "no joint is named here\n"),
        ] {
            fs::write(inbox.join(name), text).expect("written");
        }
        let made = desk.folder.path().join("template");
        let line = format!(
            "import {} {} --author maker",
            made.display(),
            inbox.display()
        );
        let done = desk.run(&line);
        assert!(done.status.success(), "{}", text(&done.stderr));
        for (name, text) in [
            ("broken.bvh", "a skeleton should be here\n".to_owned()),
            ("other.bvh", BVH.replace("20.50", "30")),
        ] {
            fs::write(desk.more().join(name), text).expect("written");
        }
        desk
    }

    fn inbox(&self) -> PathBuf {
        self.folder.path().join("inbox")
    }

    fn more(&self) -> PathBuf {
        self.folder.path().join("more")
    }

    /// Returns a fresh copy of the corpus.
    fn corpus(&self) -> PathBuf {
        let path = self.folder.path().join("small.chereme");
        for end in ["-wal", "-shm"] {
            let _ = fs::remove_file(self.folder.path().join(format!("small.chereme{end}")));
        }
        fs::copy(self.folder.path().join("template"), &path).expect("copied");
        path
    }

    /// Writes the words of a case out, with a fresh corpus and a fresh folder.
    fn words(&self, line: &str) -> String {
        let empty = self.folder.path().join("empty");
        let _ = fs::remove_dir_all(&empty);
        fs::create_dir(&empty).expect("a folder");
        line.replace("@c", &self.corpus().display().to_string())
            .replace("@in", &self.inbox().display().to_string())
            .replace("@more", &self.more().display().to_string())
            .replace("@d", &empty.display().to_string())
    }

    /// Runs the program with words parted by blanks; words with blanks stand in single quotes.
    fn run(&self, line: &str) -> Output {
        let mut words = Vec::new();
        for (at, part) in line.split('\'').enumerate() {
            if at % 2 == 1 {
                words.push(part);
            } else {
                words.extend(part.split_whitespace());
            }
        }
        Command::new(env!("CARGO_BIN_EXE_chereme"))
            .args(words)
            .stdin(Stdio::null())
            .env_remove("CHEREME_AUTHOR")
            .current_dir(self.folder.path())
            .output()
            .expect("the program runs")
    }

    fn json(&self, line: &str) -> Value {
        let done = self.run(&format!("{line} --json"));
        serde_json::from_slice(&done.stdout).expect("JSON")
    }

    fn try_json(&self, (line, code, keys): &Case) -> Result<(), String> {
        let done = self.run(&format!("{} --json", self.words(line)));
        expect_code(&done, *code)?;
        let out = text(&done.stdout);
        let document: Value = serde_json::from_str(&out)
            .map_err(|error| format!("not one JSON document ({error}): {out}"))?;
        for key in *keys {
            if document.pointer(key).is_none() {
                return Err(format!("lacks {key}: {document}"));
            }
        }
        if *keys == ERROR {
            let message = document["error"]["message"].as_str().unwrap_or_default();
            let lines = message.lines().count();
            if message.is_empty() || (*code == 1 && (lines != 1 || message.ends_with('.'))) {
                return Err(format!("the message is no phrase: {message:?}"));
            }
            if document["error"]["remedy"]
                .as_str()
                .unwrap_or_default()
                .is_empty()
            {
                return Err(format!("no remedy: {document}"));
            }
        } else if document.get("error").is_some() {
            return Err(format!("an error that none should be: {document}"));
        }
        Ok(())
    }

    fn try_text(&self, (line, code, keys): &Case) -> Result<(), String> {
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

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Returns the commands that the help lists, with what it says of them.
fn commands(help: &str) -> Vec<(String, String)> {
    let lines = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    lines
        .take_while(|line| !line.trim().is_empty())
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "))
        .filter_map(|line| line.trim().split_once(' '))
        .filter(|(name, _)| *name != "help")
        .map(|(name, about)| (name.to_owned(), about.trim().to_owned()))
        .collect()
}

#[test]
fn a_reader_that_leaves_early_is_no_fault() {
    let desk = Desk::new();
    let mut child = Command::new(env!("CARGO_BIN_EXE_chereme"))
        .args([Path::new("log"), &desk.corpus()])
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program runs");
    drop(child.stdout.take());
    let done = child.wait_with_output().expect("it ends");
    assert_eq!(text(&done.stderr), "");
    assert_eq!(done.status.code(), Some(0));
}

const BVH: &str = "HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT RightHand
  {
    OFFSET -40 20 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET -10 0 0
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.5
0 95 0 0 0 0 10 0 0
0 95 0 0 0 0 20.50 0 0
";

const EAF: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<ANNOTATION_DOCUMENT AUTHOR="" DATE="2024-01-01T00:00:00Z" FORMAT="3.0" VERSION="3.0">
<HEADER MEDIA_FILE="" TIME_UNITS="milliseconds"/>
<TIME_ORDER>
<TIME_SLOT TIME_SLOT_ID="ts1" TIME_VALUE="100"/>
<TIME_SLOT TIME_SLOT_ID="ts2" TIME_VALUE="400"/>
<TIME_SLOT TIME_SLOT_ID="ts3" TIME_VALUE="500"/>
<TIME_SLOT TIME_SLOT_ID="ts4" TIME_VALUE="900"/>
</TIME_ORDER>
<TIER TIER_ID="Gloss" LINGUISTIC_TYPE_REF="free">
<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a1" TIME_SLOT_REF1="ts1" TIME_SLOT_REF2="ts2"><ANNOTATION_VALUE>BOL</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a2" TIME_SLOT_REF1="ts3" TIME_SLOT_REF2="ts4"><ANNOTATION_VALUE>CHAT</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
</TIER>
<TIER TIER_ID="Handshape RH" LINGUISTIC_TYPE_REF="free">
<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a3" TIME_SLOT_REF1="ts1" TIME_SLOT_REF2="ts2"><ANNOTATION_VALUE>5</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
</TIER>
<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="free" TIME_ALIGNABLE="true"/>
</ANNOTATION_DOCUMENT>
"#;

const LEXICON: &str = "gloss\tEN gloss\tHandshape strong\tLocation
CHAT\tcat\tS\tchin
LIMACE\tslug\tU\tweak hand
";
