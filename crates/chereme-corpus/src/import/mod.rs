//! Files into the corpus: recordings, annotations, lexicons, notation, inventories, and folders of them.
//!
//! One import is one operation, whatever it takes in; a file that is refused leaves nothing behind
//! and does not keep the others out.

mod bvh;
pub(crate) mod eaf;
mod inventory;
mod lexicon;
mod notated;
mod notation;
mod readers;
mod report;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use chereme_formats::roles::Mapping;
use chereme_motion::Axes;
use chereme_motion::anatomy::Roles;
use rusqlite::Connection;
use sha2::{Digest, Sha256};

use crate::Corpus;
use crate::db::motion::hex;
use crate::db::recordings::{self, SourceFileRow};
use crate::error::{Error, Result};
use crate::inventories::{self, StoredInventory};
use crate::progress::{Progress, Step, Unit};

use readers::READERS;
pub use report::{FileReport, FileStatus, ImportReport, ReportFinding};

/// A text file larger than this is no annotation file, lexicon or inventory.
const LARGEST_TEXT: u64 = 512 << 20;
const DEEPEST_FOLDER: usize = 32;

/// What the caller knows better than the files.
#[derive(Debug, Clone, Default)]
pub struct ImportOptions {
    /// Whose movement it is.
    pub signer: Option<String>,
    /// The signer's dominant hand, `right` or `left`.
    pub handedness: Option<String>,
    /// How many metres one unit of the motion files is.
    pub metres_per_unit: Option<f64>,
    /// The motion files' axes.
    pub axes: Option<Axes>,
    /// Which joint is which part of the body.
    pub roles: Option<Roles>,
    /// Whether root columns that lie in another order than their header says are read as they lie.
    pub mend_root: bool,
    /// What tiers and columns mean; it goes before what an annotation file says of its tiers itself.
    pub mapping: Mapping,
    /// `captured`, `made` or `generated`.
    pub origin: Option<String>,
    /// The terms under which the recordings may be used.
    pub licence: Option<String>,
    /// Report what would be done, and write nothing.
    pub dry_run: bool,
}

/// What every reader of a file needs.
struct Job<'a> {
    connection: &'a Connection,
    options: &'a ImportOptions,
    path: &'a Path,
    /// The file's name without folder and extension.
    stem: String,
    file_name: String,
    /// Where the file lies, seen from the folder of the corpus.
    place: String,
    /// The word for its kind in `source_file.kind`.
    kind: &'static str,
    hash: String,
    inventories: Rc<Vec<StoredInventory>>,
    /// Recordings of this import, by folder and stem.
    recordings: &'a mut BTreeMap<PathBuf, i64>,
    created: &'a mut BTreeMap<&'static str, u64>,
}

impl Job<'_> {
    fn count(&mut self, what: &'static str, many: usize) {
        *self.created.entry(what).or_default() += many as u64;
    }

    fn pair_key(&self) -> PathBuf {
        self.path.with_extension("")
    }

    /// Writes down the file, with its bytes where they are kept, and returns its row.
    fn keep(&self, recording_id: Option<i64>, bytes: Option<&[u8]>) -> Result<i64> {
        let row = SourceFileRow {
            id: 0,
            recording_id,
            kind: self.kind.to_owned(),
            name: self.file_name.clone(),
            path: Some(self.place.clone()),
            hash: self.hash.clone(),
        };
        recordings::insert_source_file(self.connection, &row, bytes)
    }

    fn bytes(&self) -> Result<Vec<u8>> {
        let size = fs::metadata(self.path)
            .map_err(|error| Error::file(self.path, error))?
            .len();
        if size > LARGEST_TEXT {
            return Err(Error::wrong(format!("the file has {size} bytes"))
                .at(self.path.display().to_string())
                .advise("an annotation file, lexicon or inventory has at most 512 MiB"));
        }
        fs::read(self.path).map_err(|error| Error::file(self.path, error))
    }
}

impl Corpus {
    /// Takes files and folders into the corpus as one operation.
    ///
    /// A motion file and an annotation file of the same folder and stem become one recording.
    /// Files that were imported before are left alone; a file that is refused is reported and
    /// leaves nothing behind.
    ///
    /// # Errors
    /// Where a path is not there, the work is stopped, or the database fails.
    pub fn import(
        &mut self,
        paths: &[PathBuf],
        options: &ImportOptions,
        progress: &mut Progress<'_>,
    ) -> Result<ImportReport> {
        let files = gather(paths);
        let base = absolute(self.store.path());
        let mut report = ImportReport::default();
        let run = |connection: &Connection| {
            let mut import = Import {
                connection,
                options,
                base: base.parent().unwrap_or(Path::new("")),
                recordings: BTreeMap::new(),
                inventories: None,
            };
            import.files(&files, &mut report, progress)?;
            let summary = report.summary();
            if options.dry_run {
                Err(Error::Stopped)
            } else {
                Ok(((), summary))
            }
        };
        match self.store.operation("import", run) {
            Err(Error::Stopped) if options.dry_run && report.complete => {}
            other => other?,
        }
        report.dry_run = options.dry_run;
        Ok(report)
    }
}

/// A file to take in, or the reason why it is none.
struct Candidate {
    path: PathBuf,
    /// Its place in [`READERS`], or why it is not read.
    reader: std::result::Result<usize, Error>,
    /// Whether the caller named it, instead of a folder that it lies in.
    named: bool,
}

/// What the files of an import share.
struct Import<'a> {
    connection: &'a Connection,
    options: &'a ImportOptions,
    /// The folder of the corpus.
    base: &'a Path,
    recordings: BTreeMap<PathBuf, i64>,
    inventories: Option<Rc<Vec<StoredInventory>>>,
}

impl Import<'_> {
    fn files(
        &mut self,
        files: &[Candidate],
        report: &mut ImportReport,
        progress: &mut Progress<'_>,
    ) -> Result<()> {
        let connection = self.connection;
        let mut before = [0; READERS.len()];
        let total = |reader| {
            files
                .iter()
                .filter(move |it| it.reader.as_ref().is_ok_and(|it| *it == reader))
        };
        for Candidate {
            path,
            reader,
            named,
        } in files
        {
            let reader = match reader {
                Ok(reader) => *reader,
                Err(error) if *named => {
                    report.files.push(FileReport::refused(path, error));
                    continue;
                }
                Err(error) => {
                    report.files.push(FileReport::skipped(path, error));
                    continue;
                }
            };
            progress.tell(Step {
                task: READERS[reader].holds,
                done: before[reader],
                total: Some(total(reader).count() as u64),
                unit: Unit::Items,
            })?;
            before[reader] += 1;
            let mut created = report.created.clone();
            connection.execute_batch("SAVEPOINT file")?;
            match self.file(path, reader, &mut created, progress) {
                Ok(file) => {
                    connection.execute_batch("RELEASE file")?;
                    report.created = created;
                    report.files.push(file);
                }
                Err(Error::Stopped) => return Err(Error::Stopped),
                Err(error) => {
                    connection.execute_batch("ROLLBACK TO file; RELEASE file")?;
                    // What it had loaded or added is no more.
                    self.inventories = None;
                    report.files.push(FileReport::refused(path, &error));
                }
            }
        }
        report.complete = true;
        Ok(())
    }

    fn file(
        &mut self,
        path: &Path,
        reader: usize,
        created: &mut BTreeMap<&'static str, u64>,
        progress: &mut Progress<'_>,
    ) -> Result<FileReport> {
        let text = |part: Option<&std::ffi::OsStr>| {
            part.map(|part| part.to_string_lossy().into_owned())
                .unwrap_or_default()
        };
        let inventories = match &self.inventories {
            Some(loaded) => loaded.clone(),
            None => inventories::load(self.connection)?.into(),
        };
        let mut job = Job {
            connection: self.connection,
            options: self.options,
            path,
            stem: text(path.file_stem()),
            file_name: text(path.file_name()),
            place: place(&absolute(path), self.base),
            kind: READERS[reader].kind,
            hash: hash_file(path, progress)?,
            inventories: inventories.clone(),
            recordings: &mut self.recordings,
            created,
        };
        let done = (READERS[reader].read)(&mut job, progress)?;
        // Files that add inventories make the next one load them again.
        let same = Rc::ptr_eq(&job.inventories, &inventories) && READERS[reader].keeps_inventories;
        self.inventories = same.then_some(inventories);
        Ok(done)
    }
}

/// Returns a path from the root, links and `..` resolved, where it is there.
fn absolute(path: &Path) -> PathBuf {
    fs::canonicalize(path)
        .or_else(|_| std::path::absolute(path))
        .unwrap_or_else(|_| path.to_owned())
}

/// Returns where a file lies, seen from a folder: `A/x.eaf`, or `../A/x.eaf`, with `/` on every system.
/// On another drive it is the whole path.
fn place(path: &Path, folder: &Path) -> String {
    let (own, base): (Vec<_>, Vec<_>) =
        (path.components().collect(), folder.components().collect());
    let shared = own.iter().zip(&base).take_while(|(a, b)| a == b).count();
    let up = if shared == 0 { 0 } else { base.len() - shared };
    let names = own[shared..]
        .iter()
        .map(|it| it.as_os_str().to_string_lossy());
    let parts: Vec<_> = std::iter::repeat_n("..".into(), up).chain(names).collect();
    parts.join("/")
}

fn hash_file(path: &Path, progress: &mut Progress<'_>) -> Result<String> {
    use std::io::Read;
    let fault = |error| Error::file(path, error);
    let mut file = fs::File::open(path).map_err(fault)?;
    let total = file.metadata().map_err(fault)?.len();
    let (mut digest, mut buffer, mut done) = (Sha256::new(), vec![0; 1 << 20], 0u64);
    loop {
        let read = file.read(&mut buffer).map_err(fault)?;
        if read == 0 {
            return Ok(hex(&digest.finalize()));
        }
        digest.update(&buffer[..read]);
        done += read as u64;
        if total > 64 << 20 {
            let task = "checking";
            let unit = crate::progress::Unit::Bytes;
            progress.tell(crate::progress::Step {
                task,
                done,
                total: Some(total),
                unit,
            })?;
        }
    }
}

/// Returns the files in the order in which [`READERS`] reads them, those that are not read first.
fn gather(paths: &[PathBuf]) -> Vec<Candidate> {
    let mut files = Vec::new();
    for path in paths {
        match fs::metadata(path) {
            Ok(found) if found.is_dir() => walk(path, 0, &mut files),
            Ok(_) => files.push(Candidate {
                path: path.clone(),
                reader: readers::reader(path).ok_or_else(|| readers::unread(path)),
                named: true,
            }),
            Err(error) => files.push(Candidate::broken(path, error)),
        }
    }
    files.sort_by(|a, b| (&a.path, b.named).cmp(&(&b.path, a.named)));
    files.dedup_by(|a, b| a.path == b.path);
    files.sort_by_key(|it| it.reader.as_ref().ok().copied());
    files
}

impl Candidate {
    /// Returns what cannot be read at all, which the import does not pass over in silence.
    fn broken(path: &Path, error: std::io::Error) -> Self {
        Self {
            path: path.to_owned(),
            reader: Err(Error::file(path, error)),
            named: true,
        }
    }
}

fn walk(folder: &Path, depth: usize, files: &mut Vec<Candidate>) {
    if depth > DEEPEST_FOLDER {
        let deep = Error::wrong(format!("it lies {depth} folders deep"))
            .at(folder.display().to_string())
            .advise("import it by its own name");
        files.push(Candidate {
            path: folder.to_owned(),
            reader: Err(deep),
            named: true,
        });
        return;
    }
    let entries = match fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) => return files.push(Candidate::broken(folder, error)),
    };
    for entry in entries {
        let path = match entry {
            Ok(entry) => entry.path(),
            Err(error) => return files.push(Candidate::broken(folder, error)),
        };
        let hidden = path
            .file_name()
            .is_some_and(|name| name.to_string_lossy().starts_with('.'));
        if path.is_dir() {
            if !hidden && !path.is_symlink() {
                walk(&path, depth + 1, files);
            }
        } else if !hidden {
            let reader = readers::reader(&path).ok_or_else(|| readers::unread(&path));
            files.push(Candidate {
                path,
                reader,
                named: false,
            });
        }
    }
}
