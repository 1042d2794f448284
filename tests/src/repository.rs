//! The repository as files, for the tests that read it.

use std::fs;
use std::path::{Path, PathBuf};

/// Returns the folder of the workspace.
#[must_use]
pub fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_owned()
}

/// A text file of the repository.
#[derive(Debug, Clone)]
pub struct TextFile {
    /// The path from the workspace's folder, with `/`.
    pub path: String,
    /// The contents.
    pub text: String,
}

impl TextFile {
    /// Returns whether the file holds tests or code for tests only.
    #[must_use]
    pub fn is_test(&self) -> bool {
        const WORDS: [&str; 7] = [
            "tests",
            "tests.rs",
            "testing.rs",
            "fixtures",
            "fixtures.rs",
            "benches",
            "examples",
        ];
        self.path.split('/').any(|part| WORDS.contains(&part))
    }

    /// Returns the lines before the test module, counted from 1.
    pub fn code(&self) -> impl Iterator<Item = (usize, &str)> {
        self.text
            .lines()
            .take_while(|line| *line != "#[cfg(test)]")
            .enumerate()
            .map(|(at, line)| (at + 1, line))
    }
}

/// Returns the text files written by people, by path: code, documents, data, scripts.
///
/// Build folders, hidden files and folders other than `.ci` (`.git` is a file in a linked work tree), logs, and the
/// lock file are left out.
#[must_use]
pub fn text_files() -> Vec<TextFile> {
    let root = root();
    let mut files = Vec::new();
    walk(&root, &root, &mut files);
    files.sort_by(|a, b| a.path.cmp(&b.path));
    files
}

/// Returns the Rust files.
#[must_use]
pub fn rust_files() -> Vec<TextFile> {
    let mut files = text_files();
    files.retain(|file| file.path.ends_with(".rs"));
    files
}

fn walk(root: &Path, folder: &Path, files: &mut Vec<TextFile>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        let name = entry.file_name().to_string_lossy().into_owned();
        let hidden = name.starts_with('.') && name != ".ci";
        if path.is_dir() {
            if !hidden && name != "target" && !path.is_symlink() {
                walk(root, &path, files);
            }
        } else if !hidden
            && name != "Cargo.lock"
            && !name.ends_with(".log")
            && let Ok(text) = fs::read_to_string(&path)
        {
            let path = path.strip_prefix(root).unwrap_or(&path);
            let parts: Vec<_> = path.iter().map(|part| part.to_string_lossy()).collect();
            let path = parts.join("/");
            files.push(TextFile { path, text });
        }
    }
}

/// Returns the names of the schema's steps in their order.
#[must_use]
pub fn schema_steps() -> Vec<String> {
    let files = fs::read_dir(root().join("schema/sql")).into_iter().flatten();
    let mut names: Vec<String> = files
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .filter(|name| name.ends_with(".sql"))
        .collect();
    names.sort();
    names
}
