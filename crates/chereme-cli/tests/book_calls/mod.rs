//! The commands of a chapter, and what they print.

#[cfg(unix)]
use std::fs;
use std::path::Path;
use std::process::Command;

/// The beginning of a line about a call whose program is missing on this machine.
#[cfg(unix)]
pub(crate) const SKIPPED: &str = "skipped: ";

/// A fenced block.
pub(crate) struct FencedBlock {
    /// The line of the page on which its contents begin, counted from 1.
    pub(crate) line: usize,
    /// The word after the fence.
    pub(crate) kind: String,
    lines: Vec<String>,
}

/// A command or a script, with the output that the chapter shows.
pub(crate) struct BookCall {
    /// Its line on the page, counted from 1.
    pub(crate) line: usize,
    /// What a shell runs.
    pub(crate) script: String,
    /// The code with which it must end.
    pub(crate) exit_code: i32,
    shown: Vec<String>,
}

/// Returns the fenced blocks of a page.
pub(crate) fn fenced_blocks(text: &str) -> Vec<FencedBlock> {
    let mut blocks: Vec<FencedBlock> = Vec::new();
    let mut open = false;
    for (at, line) in text.lines().enumerate() {
        match line.strip_prefix("```") {
            Some(_) if open => open = false,
            Some(kind) => {
                open = true;
                let (line, kind) = (at + 2, kind.trim().to_owned());
                let lines = Vec::new();
                blocks.push(FencedBlock { line, kind, lines });
            }
            None if open => blocks.last_mut().expect("an open block").lines.push(line.to_owned()),
            None => {}
        }
    }
    assert!(!open, "a block does not end");
    blocks
}

/// Returns the commands and scripts of a page in their order.
pub(crate) fn chapter_calls(text: &str) -> Vec<BookCall> {
    let mut calls = Vec::new();
    for block in fenced_blocks(text) {
        match block.kind.as_str() {
            "sh" => calls.push(BookCall::of_script(block.line, block.lines.join("\n"))),
            "console" => calls.extend(console_calls(&block)),
            _ => {}
        }
    }
    calls
}

fn console_calls(block: &FencedBlock) -> Vec<BookCall> {
    let mut calls: Vec<BookCall> = Vec::new();
    for (at, line) in block.lines.iter().enumerate() {
        if let Some(command) = line.strip_prefix("$ ") {
            calls.push(BookCall::of_script(block.line + at, command.to_owned()));
            continue;
        }
        let call = calls
            .last_mut()
            .expect("a block of the kind console begins with a command");
        match line.strip_prefix("> ") {
            Some(more) if call.shown.is_empty() => call.script = format!("{}\n{more}", call.script),
            _ => call.shown.push(line.trim_end().to_owned()),
        }
    }
    calls
}

impl BookCall {
    fn of_script(line: usize, script: String) -> Self {
        let code = script.rsplit_once("# exit code ");
        let exit_code = code.map_or(0, |(_, code)| code.trim().parse().expect("a code"));
        let shown = Vec::new();
        Self {
            line,
            script,
            exit_code,
            shown,
        }
    }

    /// Returns whether the output is the one that the chapter shows, if it shows any.
    pub(crate) fn fits(&self, output: &str) -> bool {
        let lines: Vec<&str> = output.lines().map(str::trim_end).collect();
        let shown: Vec<&str> = self.shown.iter().map(String::as_str).collect();
        shown.is_empty() || lines_fit(&shown, &lines)
    }
}

/// Returns whether lines fit a pattern, in which a line `…` stands for any lines.
fn lines_fit(pattern: &[&str], lines: &[&str]) -> bool {
    match pattern.split_first() {
        None => lines.is_empty(),
        Some((&"…", rest)) => (0..=lines.len()).any(|skipped| lines_fit(rest, &lines[skipped..])),
        Some((first, rest)) => {
            lines.first().is_some_and(|line| letters_fit(first, line)) && lines_fit(rest, &lines[1..])
        }
    }
}

/// Returns whether a line fits a pattern, in which `…` stands for any letters.
fn letters_fit(pattern: &str, line: &str) -> bool {
    let mut parts = pattern.split('…');
    let Some(mut left) = line.strip_prefix(parts.next().unwrap_or_default()) else {
        return false;
    };
    let parts: Vec<&str> = parts.collect();
    let Some((last, middle)) = parts.split_last() else {
        return left.is_empty();
    };
    for part in middle {
        let Some(at) = left.find(part) else { return false };
        left = &left[at + part.len()..];
    }
    left.ends_with(last)
}

/// Returns a program that finds `chereme` on its path, knows English, and writes into `folder`.
pub(crate) fn program_command(program: &str, folder: &Path) -> Command {
    let own = Path::new(env!("CARGO_BIN_EXE_chereme"));
    let mut path = own.parent().expect("a folder").as_os_str().to_owned();
    path.push(if cfg!(windows) { ";" } else { ":" });
    path.push(std::env::var_os("PATH").unwrap_or_default());
    let program = if program == "chereme" { own } else { Path::new(program) };
    let mut command = Command::new(program);
    command
        .current_dir(folder)
        .env("PATH", path)
        .env("LC_ALL", "C.UTF-8")
        .env("CHEREME_AUTHOR", "anna")
        .env_remove("CHEREME_WORDS");
    command
}

/// Returns the position of the call that makes the folder of the demo, if there is one.
#[cfg(unix)]
pub(crate) fn demo_call(calls: &[BookCall]) -> Option<usize> {
    calls.iter().position(|call| call.script == "chereme demo")
}

/// Runs the calls of a chapter in a fresh folder, with the demo's corpus and files if the chapter names them.
#[cfg(unix)]
pub(crate) fn run_chapter(name: &str, calls: &[BookCall], demo: &Path) -> Vec<String> {
    let folder = tempfile::tempdir().expect("a folder");
    if calls.iter().any(|call| call.script.contains("chereme-demo")) {
        let (from, to) = (demo.join("chereme-demo"), folder.path().join("chereme-demo"));
        fs::create_dir_all(to.join("starter")).expect("a folder");
        fs::copy(from.join("starter.chereme"), to.join("starter.chereme")).expect("copied");
        for file in fs::read_dir(from.join("starter")).expect("the starter files").flatten() {
            fs::copy(file.path(), to.join("starter").join(file.file_name())).expect("copied");
        }
    }
    run_calls(name, calls, folder.path())
}

/// Runs the calls of a chapter one after another in the folder, and returns what differs from the page, and those that
/// were skipped.
#[cfg(unix)]
pub(crate) fn run_calls(name: &str, calls: &[BookCall], folder: &Path) -> Vec<String> {
    let mut faults = Vec::new();
    for call in calls {
        let mut command = program_command("sh", folder);
        let script = format!("exec 2>&1\nset -e\n{}", call.script);
        let output = command.args(["-c", &script]).output().expect("a shell");
        let text = String::from_utf8_lossy(&output.stdout);
        let code = output.status.code().unwrap_or(-1);
        // Python and other programs that a chapter shows are not part of Chereme, and may be missing.
        let is_missing = code == 127 && !call.script.starts_with("chereme ");
        if is_missing {
            faults.push(format!("{SKIPPED}{name}:{}: {text}", call.line));
        } else if code != call.exit_code || !call.fits(&text) {
            let script = &call.script;
            faults.push(format!(
                "{name}:{}: {script}\nexit code {code}, printed:\n{text}",
                call.line
            ));
        }
    }
    faults
}
