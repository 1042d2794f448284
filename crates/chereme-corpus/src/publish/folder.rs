//! The published folder: written completely beside its place, and exchanged for the old one at the end.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;
use std::fs;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};

use chereme_sign::text::compose_accents;

use super::offline::short_hash;
use crate::error::{CorpusError, CorpusResult};

/// The list of the files that were written; the next publication replaces these and no others.
pub(super) const PUBLISHED_FILE_LIST: &str = "files.txt";
/// The deepest folder of a publication that is looked into for files of others.
const MAX_PUBLISHED_FOLDER_DEPTH: usize = 32;

/// A file that was written.
pub(super) struct PublishedFile {
    /// The beginning of its SHA-256 hash.
    pub(super) hash: String,
    /// Its size in bytes.
    pub(super) size: usize,
}

/// A folder under construction.
pub(super) struct PublicationFolder {
    to: PathBuf,
    part: PathBuf,
    old: PathBuf,
    written: BTreeMap<String, PublishedFile>,
    bytes: u64,
    done: bool,
}

impl PublicationFolder {
    /// Begins a folder that will be at `to`.
    ///
    /// # Errors
    /// Fails if `to` has no name, is a file, or cannot be written beside.
    pub(super) fn begin_publication(to: &Path) -> CorpusResult<Self> {
        // A folder without a name is refused by the name that the user gave, before links are followed.
        hidden_sibling_path(to, "part")?;
        // A link to a folder stays: the folder that it leads to is replaced.
        let to = &fs::canonicalize(to).unwrap_or_else(|_| to.to_owned());
        let (part, old) = (hidden_sibling_path(to, "part")?, hidden_sibling_path(to, "old")?);
        let fault = |error| CorpusError::from_file_failure(to, error);
        // A publication that was killed between its two last steps left the old folder beside its place.
        if !to.exists() && old.is_dir() {
            fs::rename(&old, to).map_err(fault)?;
        }
        if to.exists() && !to.is_dir() {
            return Err(fault(ErrorKind::NotADirectory.into()));
        }
        // A publication that was stopped may have left half of its files.
        for left in [&part, &old] {
            if left.exists() {
                fs::remove_dir_all(left).map_err(|error| CorpusError::from_file_failure(left, error))?;
            }
        }
        fs::create_dir_all(&part).map_err(fault)?;
        Ok(Self {
            to: to.to_owned(),
            part,
            old,
            written: BTreeMap::new(),
            bytes: 0,
            done: false,
        })
    }

    /// Writes a file; `name` has `/` between its folders.
    pub(super) fn write_published_file(&mut self, name: &str, bytes: &[u8]) -> CorpusResult<()> {
        let path = self.part.join(name);
        let fault = |error| CorpusError::from_file_failure(&path, error);
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder).map_err(fault)?;
        }
        fs::write(&path, bytes).map_err(fault)?;
        let stored = PublishedFile {
            hash: short_hash(bytes),
            size: bytes.len(),
        };
        self.written.insert(name.to_owned(), stored);
        self.bytes += bytes.len() as u64;
        Ok(())
    }

    /// Reports whether a file was written.
    pub(super) fn has_published_file(&self, name: &str) -> bool {
        self.written.contains_key(name)
    }

    /// Returns the files that were written, by name.
    pub(super) fn published_files(&self) -> &BTreeMap<String, PublishedFile> {
        &self.written
    }

    /// Puts the folder in its place, and returns the number of files and their bytes. Files that no publication wrote
    /// stay.
    pub(super) fn finish_publication(mut self) -> CorpusResult<(usize, u64)> {
        let listed_names = self.written.keys().map(String::as_str).chain([PUBLISHED_FILE_LIST]);
        // The list names itself, so that the next publication replaces it as well.
        let names: BTreeSet<&str> = listed_names.collect();
        let list: String = names.iter().map(|name| format!("{name}\n")).collect();
        self.write_published_file(PUBLISHED_FILE_LIST, list.as_bytes())?;
        let fault = |error| CorpusError::from_file_failure(&self.to, error);
        if !self.to.exists() {
            fs::rename(&self.part, &self.to).map_err(fault)?;
            self.done = true;
            return Ok((self.written.len(), self.bytes));
        }
        // Files of the user must not vanish with the old pages.
        let others = self.unpublished_files()?;
        let mut moved: Vec<&String> = Vec::new();
        let result = others.iter().try_for_each(|name| {
            let (from, to) = (self.to.join(name), self.part.join(name));
            if let Some(folder) = to.parent() {
                fs::create_dir_all(folder)?;
            }
            fs::rename(from, to)?;
            moved.push(name);
            Ok(())
        });
        let result = result.and_then(|()| fs::rename(&self.to, &self.old)).and_then(|()| {
            fs::rename(&self.part, &self.to).inspect_err(|_| {
                // The old pages are better than none, and the error of the exchange is the one to report.
                drop(fs::rename(&self.old, &self.to));
            })
        });
        if let Err(error) = result {
            // The user's files go back to where they were before the exchange failed.
            for name in moved {
                drop(fs::rename(self.part.join(name), self.to.join(name)));
            }
            return Err(fault(error));
        }
        self.done = true;
        if fs::remove_dir_all(&self.old).is_err() {
            // It may hold signs that were withdrawn.
            return Err(CorpusError::from_wrong_message(
                "the new pages are in place, but the old ones could not be removed",
            )
            .with_error_place(self.old.display().to_string())
            .with_advice("remove this folder: signs that were withdrawn may be in it"));
        }
        Ok((self.written.len(), self.bytes))
    }

    /// Returns the files and whole folders in the old folder that no publication wrote.
    fn unpublished_files(&self) -> CorpusResult<Vec<String>> {
        let list = fs::read_to_string(self.to.join(PUBLISHED_FILE_LIST)).unwrap_or_default();
        let listed_lines = list.lines().filter(|line| is_path_inside(line));
        let known_names: BTreeSet<String> = listed_lines.map(|line| compose_accents(line).into_owned()).collect();
        let mut others = Vec::new();
        self.walk_old_folder("", 0, &known_names, &mut others)?;
        Ok(others)
    }

    fn walk_old_folder(
        &self,
        prefix: &str,
        depth: usize,
        known: &BTreeSet<String>,
        others: &mut Vec<String>,
    ) -> CorpusResult<()> {
        let folder = self.to.join(prefix);
        let fault = |error| CorpusError::from_file_failure(&folder, error);
        // Each level of folders is a call of this function, and takes room on the stack.
        if depth > MAX_PUBLISHED_FOLDER_DEPTH {
            let text = "folders lie too deep inside each other";
            return Err(CorpusError::from_wrong_message(text).with_error_place(folder.display().to_string()));
        }
        for entry in fs::read_dir(&folder).map_err(fault)? {
            let entry = entry.map_err(fault)?;
            let Ok(name) = entry.file_name().into_string() else {
                return Err(CorpusError::from_wrong_message("a file's name is no text")
                    .with_error_place(entry.path().display().to_string())
                    .with_advice("move it out of the folder"));
            };
            let full_name = format!("{prefix}{name}");
            // Some disks write accents as letters of their own.
            let plain = compose_accents(&full_name).into_owned();
            // A link is moved as one, whatever it leads to.
            let is_folder = entry.file_type().map_err(fault)?.is_dir();
            let inside = format!("{plain}/");
            let of_old = first_from(known.range(inside.clone()..), &inside);
            let of_new = first_from(self.written.range(inside.clone()..).map(|entry| entry.0), &inside);
            if is_folder && (of_old || of_new) {
                self.walk_old_folder(&format!("{full_name}/"), depth + 1, known, others)?;
            } else if !is_folder && known.contains(&plain) {
                continue;
            } else if self.written.contains_key(&plain) || of_new {
                return Err(
                    CorpusError::from_wrong_message(format!("{full_name:?} was not written by a publication"))
                        .with_error_place(entry.path().display().to_string())
                        .with_advice("name an empty folder, or move the file away"),
                );
            } else {
                others.push(full_name);
            }
        }
        others.sort();
        Ok(())
    }
}

/// Reports whether a folder has an older publication, or one that was killed left it beside its place.
pub(super) fn is_published(to: &Path) -> bool {
    let old = hidden_sibling_path(to, "old");
    to.join(PUBLISHED_FILE_LIST).is_file() || old.is_ok_and(|target| target.join(PUBLISHED_FILE_LIST).is_file())
}

/// Reports whether the first of some names begins with a text.
fn first_from<'n>(mut names: impl Iterator<Item = &'n String>, start: &str) -> bool {
    names.next().is_some_and(|name| name.starts_with(start))
}

impl Drop for PublicationFolder {
    fn drop(&mut self) {
        // An unfinished publication leaves nothing behind.
        if !self.done {
            drop(fs::remove_dir_all(&self.part));
        }
    }
}

/// Reports whether a name leads to a file inside its folder.
fn is_path_inside(name: &str) -> bool {
    let mut parts = Path::new(name).components();
    // The list may have been edited, and must not lead to files outside of the folder.
    !name.is_empty() && parts.all(|part| matches!(part, Component::Normal(_)))
}

/// Returns a hidden path beside another one.
fn hidden_sibling_path(to: &Path, ending: &str) -> CorpusResult<PathBuf> {
    let Some(name) = to.file_name() else {
        return Err(CorpusError::from_wrong_message("this folder has no name of its own")
            .with_error_place(to.display().to_string())
            .with_advice("name a folder that can be replaced, such as dictionary/"));
    };
    let mut hidden = OsString::from(".");
    hidden.push(name);
    // Beside its place, the folder lies on the same disk and can be renamed at once.
    hidden.push(format!(".chereme-{ending}"));
    Ok(to.with_file_name(hidden))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn published(to: &Path, files: &[(&str, &str)]) -> CorpusResult<(usize, u64)> {
        let mut folder = PublicationFolder::begin_publication(to)?;
        for (name, text) in files {
            folder.write_published_file(name, text.as_bytes())?;
        }
        folder.finish_publication()
    }

    fn listed(to: &Path) -> Vec<String> {
        fn walk(folder: &Path, prefix: &str, files: &mut Vec<String>) {
            for entry in fs::read_dir(folder).expect("read").flatten() {
                let name = entry.file_name().into_string().expect("text");
                let own = format!("{prefix}{name}");
                match entry.path().is_dir() {
                    true => walk(&entry.path(), &format!("{own}/"), files),
                    false => files.push(own),
                }
            }
        }
        let mut files = Vec::new();
        walk(to, "", &mut files);
        files.sort();
        files
    }

    #[test]
    fn folders_of_others_stay_as_they_are_and_accents_may_be_letters_of_their_own() {
        let desk = tempfile::tempdir().expect("a folder");
        let to = desk.path().join("site");
        published(&to, &[("index.html", "1"), ("sign/\u{c9}T\u{c9}/index.html", "a")]).expect("written");
        // The repository that a site is kept in has folders without files.
        fs::create_dir_all(to.join(".git/refs/heads")).expect("made");
        fs::rename(to.join("sign/\u{c9}T\u{c9}"), to.join("sign/E\u{301}TE\u{301}")).expect("renamed");
        published(&to, &[("index.html", "2")]).expect("replaced");
        assert!(to.join(".git/refs/heads").is_dir());
        assert_eq!(listed(&to), ["files.txt", "index.html"]);
        assert!(!to.join("sign").exists());
        fs::create_dir(to.join("sign")).expect("made");
        fs::create_dir(to.join("app.js")).expect("made");
        let clash = published(&to, &[("app.js", "2")]).expect_err("a clash");
        assert!(clash.to_string().contains("app.js"), "{clash}");
        assert!(to.join("app.js").is_dir() && to.join("sign").is_dir());
    }

    #[test]
    fn a_publication_replaces_its_own_files_and_no_others() {
        let desk = tempfile::tempdir().expect("a folder");
        let to = desk.path().join("site");
        published(&to, &[("index.html", "1"), ("sign/A/index.html", "a")]).expect("written");
        fs::write(to.join("own.txt"), "mine").expect("written");
        fs::create_dir(to.join("sign/B")).expect("made");
        fs::write(to.join("sign/B/note.txt"), "mine").expect("written");
        let done = published(&to, &[("index.html", "2")]).expect("replaced");
        assert_eq!(done.0, 2);
        let all = ["files.txt", "index.html", "own.txt", "sign/B/note.txt"];
        assert_eq!(listed(&to), all);
        assert_eq!(fs::read_to_string(to.join("index.html")).expect("read"), "2");
        assert_eq!(listed(desk.path()).len(), all.len(), "nothing lies beside it");
    }

    #[test]
    fn a_publication_that_fails_changes_nothing() {
        let desk = tempfile::tempdir().expect("a folder");
        let to = desk.path().join("site");
        fs::create_dir(&to).expect("made");
        fs::write(to.join("index.html"), "of somebody").expect("written");
        let clash = published(&to, &[("index.html", "2")]).expect_err("a clash");
        assert!(clash.to_string().contains("index.html"), "{clash}");
        let mut folder = PublicationFolder::begin_publication(&to).expect("begun");
        folder.write_published_file("a.txt", b"a").expect("written");
        drop(folder);
        assert_eq!(listed(desk.path()), ["site/index.html"]);
        // A list that leads out of the folder names nothing.
        fs::write(
            to.join(PUBLISHED_FILE_LIST),
            "../outside\n/etc/passwd\nindex.html\nfiles.txt\n",
        )
        .expect("written");
        fs::write(desk.path().join("outside"), "x").expect("written");
        published(&to, &[("index.html", "2")]).expect("replaced");
        assert_eq!(listed(desk.path()), ["outside", "site/files.txt", "site/index.html"]);
    }

    #[test]
    fn a_publication_that_was_killed_is_mended_by_the_next_one() {
        let desk = tempfile::tempdir().expect("a folder");
        let to = desk.path().join("site");
        published(&to, &[("index.html", "1")]).expect("written");
        fs::write(to.join("own.txt"), "mine").expect("written");
        fs::rename(&to, hidden_sibling_path(&to, "old").expect("a name")).expect("moved");
        published(&to, &[("index.html", "2")]).expect("written");
        assert_eq!(
            listed(desk.path()),
            ["site/files.txt", "site/index.html", "site/own.txt"]
        );
    }
}
