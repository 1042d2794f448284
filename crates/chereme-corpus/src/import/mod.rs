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
use crate::error::{Error, Result};
use crate::inventories::{self, StoredInventory};
use crate::notation::Form;
use crate::progress::{Progress, Step, Unit};

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

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Inventory,
    Bvh,
    Lexicon,
    Notation(Form),
    Eaf,
}

/// What every reader of a file needs.
struct Job<'a> {
    connection: &'a Connection,
    options: &'a ImportOptions,
    path: &'a Path,
    /// The file's name without folder and extension.
    stem: String,
    file_name: String,
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
        let files = gather(paths)?;
        let mut report = ImportReport::default();
        let run = |connection: &Connection| {
            import_files(connection, &files, options, &mut report, progress)?;
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

fn import_files(
    connection: &Connection,
    files: &[(PathBuf, Option<Kind>)],
    options: &ImportOptions,
    report: &mut ImportReport,
    progress: &mut Progress<'_>,
) -> Result<()> {
    let mut recordings = BTreeMap::new();
    let mut inventories = None;
    let mut small = 0;
    for (path, kind) in files {
        let Some(kind) = kind else {
            report.files.push(FileReport::skipped(path));
            continue;
        };
        let mut created = report.created.clone();
        if matches!(kind, Kind::Notation(_)) {
            tell_small(&mut small, files, progress)?;
        }
        connection.execute_batch("SAVEPOINT file")?;
        let done = import_file(
            connection,
            path,
            *kind,
            options,
            Known {
                recordings: &mut recordings,
                created: &mut created,
                inventories: &mut inventories,
            },
            progress,
        );
        // Only files of notation add no inventory.
        if !matches!(kind, Kind::Notation(_)) {
            inventories = None;
        }
        match done {
            Ok(file) => {
                connection.execute_batch("RELEASE file")?;
                report.created = created;
                report.files.push(file);
            }
            Err(Error::Stopped) => return Err(Error::Stopped),
            Err(error) => {
                connection.execute_batch("ROLLBACK TO file; RELEASE file")?;
                report.files.push(FileReport::refused(path, &error));
            }
        }
    }
    report.complete = true;
    Ok(())
}

/// Tells how many of many small files are done.
fn tell_small(
    done: &mut u64,
    files: &[(PathBuf, Option<Kind>)],
    progress: &mut Progress<'_>,
) -> Result<()> {
    if done.is_multiple_of(64) {
        let small = files
            .iter()
            .filter(|(_, kind)| matches!(kind, Some(Kind::Notation(_))));
        progress.tell(Step {
            task: "notation",
            done: *done,
            total: Some(small.count() as u64),
            unit: Unit::Items,
        })?;
    }
    *done += 1;
    Ok(())
}

/// What the files of an import share.
struct Known<'a> {
    recordings: &'a mut BTreeMap<PathBuf, i64>,
    created: &'a mut BTreeMap<&'static str, u64>,
    inventories: &'a mut Option<Rc<Vec<StoredInventory>>>,
}

fn import_file(
    connection: &Connection,
    path: &Path,
    kind: Kind,
    options: &ImportOptions,
    known: Known<'_>,
    progress: &mut Progress<'_>,
) -> Result<FileReport> {
    let text = |part: Option<&std::ffi::OsStr>| {
        part.map(|part| part.to_string_lossy().into_owned())
            .unwrap_or_default()
    };
    let inventories = match known.inventories {
        Some(loaded) => loaded.clone(),
        None => known
            .inventories
            .insert(Rc::new(inventories::load(connection)?))
            .clone(),
    };
    let mut job = Job {
        connection,
        options,
        path,
        stem: text(path.file_stem()),
        file_name: text(path.file_name()),
        hash: hash_file(path, progress)?,
        inventories,
        recordings: known.recordings,
        created: known.created,
    };
    match kind {
        Kind::Bvh => bvh::import(&mut job, progress),
        Kind::Eaf => eaf::import(&mut job),
        Kind::Lexicon => lexicon::import(&mut job, progress),
        Kind::Notation(form) => notated::import(&mut job, form),
        Kind::Inventory => inventory::import(&mut job, progress),
    }
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

/// Returns the files to read in the order to read them: inventories, movement, lexicons, notation,
/// annotations.
fn gather(paths: &[PathBuf]) -> Result<Vec<(PathBuf, Option<Kind>)>> {
    let mut files = Vec::new();
    for path in paths {
        let fault = |error| Error::file(path, error);
        if fs::metadata(path).map_err(fault)?.is_dir() {
            walk(path, 0, &mut files)?;
        } else {
            match kind(path) {
                Some(kind) => files.push((path.clone(), Some(kind))),
                None => return Err(unknown_kind(path)),
            }
        }
    }
    files.sort();
    files.dedup();
    files.sort_by_key(|(_, kind)| *kind);
    Ok(files)
}

/// Returns the refusal of a file that was named, with what can be done with one of its kind.
fn unknown_kind(path: &Path) -> Error {
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    let remedy = match extension.to_lowercase().as_str() {
        "txt" => {
            "a .txt holds HamNoSys, a sign a line: the gloss, a tab, and symbols or their names"
        }
        "xml" => "an .xml holds SiGML: its root is <sigml>",
        "textgrid" => "open it in ELAN (File, Import, Praat TextGrid) and save it as .eaf",
        "etf" => {
            "a template holds no annotations; save it in ELAN as .eaf, then: annotate add-tiers --like"
        }
        "pfsx" | "ecv" => "import the .eaf beside it; this file goes with it",
        "fbx" | "c3d" | "trc" | "glb" | "gltf" | "vrm" => {
            "movement is read from .bvh, which Blender, MotionBuilder and most capture software export"
        }
        _ => {
            "files end in .bvh (movement), .eaf (annotations), .csv, .tsv, .json (lexicons, inventories), .sigml, .hns or .txt (notation)"
        }
    };
    Error::wrong("this kind of file is not known")
        .at(path.display().to_string())
        .advise(remedy)
}

fn walk(folder: &Path, depth: usize, files: &mut Vec<(PathBuf, Option<Kind>)>) -> Result<()> {
    let fault = |error| Error::file(folder, error);
    if depth > DEEPEST_FOLDER {
        return Ok(());
    }
    for entry in fs::read_dir(folder).map_err(fault)? {
        let path = entry.map_err(fault)?.path();
        let hidden = path
            .file_name()
            .is_some_and(|name| name.to_string_lossy().starts_with('.'));
        if path.is_dir() {
            if !hidden && !path.is_symlink() {
                walk(&path, depth + 1, files)?;
            }
        } else if !hidden {
            let kind = kind(&path);
            files.push((path, kind));
        }
    }
    Ok(())
}

fn kind(path: &Path) -> Option<Kind> {
    let extension = path.extension()?.to_string_lossy().to_lowercase();
    match extension.as_str() {
        "bvh" => Some(Kind::Bvh),
        "eaf" => Some(Kind::Eaf),
        "csv" | "tsv" => Some(Kind::Lexicon),
        "json" => Some(Kind::Inventory),
        _ => Form::of(path).map(Kind::Notation),
    }
}
