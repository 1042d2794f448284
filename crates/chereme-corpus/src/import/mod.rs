//! Imports files into the corpus: recordings, annotations, lexicons, notation, inventories, and folders of these.
//!
//! One import is one operation, however many files it reads. A file that is refused leaves nothing behind and does not
//! prevent the others from being imported.

mod earlier_entries;
mod elan;
mod import_again;
mod import_bvh;
mod import_captured;
mod import_changes;
mod import_clock;
pub(crate) mod import_eaf;
mod import_film;
mod import_inventory;
mod import_joining;
mod import_lexicons;
mod import_notated;
mod import_notation;
mod import_pieces;
mod import_places;
mod import_points;
mod import_relations;
mod import_report;
mod import_tracks;
mod import_unread;
mod import_whole;
mod lexicon;
pub(crate) mod readers;
#[cfg(test)]
mod tests;
mod understood;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use chereme_formats::roles::TierMapping;
use chereme_motion::anatomy::AssignedJointRoles;
use chereme_motion::{FrameRate, RecordingInstant, SignerAxes};
use rusqlite::Connection;
use sha2::{Digest, Sha256};

use crate::Corpus;
use crate::address::RowName;
use crate::db::stored_columns::RecordOrigin;
use crate::db::stored_motion::to_hex_text;
use crate::db::stored_recordings::{self, SourceFileRow};
use crate::error::{CorpusError, CorpusResult};
use crate::inventories::{self, StoredInventory};
use crate::paths::legible_path_text;
use crate::progress::{ProgressReceiver, ProgressUnit};
use crate::report_finding::ReportFinding;

pub use import_joining::{FileJoin, FileJoining, JoinReason, JoinedFile, JoinedRecording};
use import_places::ImportedFilePlaces;
use import_report::RowChangeCounts;
pub use import_report::{AnnotationSide, EditOutcome, FileReport, FileStatus, ImportReport, OwnEdit, UnreadFileKind};
pub use import_whole::read_stream;
use readers::FILE_READERS;
pub use readers::readable_files;
use understood::EarlierInterpretations;
pub use understood::{
    BodyRead, ConventionRead, FileInterpretation, JointRole, MovementRead, ReimportChanges, RootRead, SharedPart,
    TiersRead, TrackRead,
};

/// Returns the time of day for a timecode such as `12:34:56:07` or `12:34:56:07@25`; the number behind `@` is the
/// frames per second, 30 by default.
#[must_use]
pub fn time_of_day(timecode: &str) -> Option<RecordingInstant> {
    chereme_formats::timecode::time_of_day(timecode, 30.0)
}

/// The greatest depth of folders that an import searches.
const DEEPEST_FOLDER: usize = 32;

/// Information from the caller that overrides the files, and choices for the import.
#[derive(Debug, Clone, Default)]
pub struct ImportOptions {
    /// The name of the signer.
    pub signer: Option<String>,
    /// The signer's dominant hand, `right` or `left`.
    pub handedness: Option<String>,
    /// The length of one unit of the motion files in metres.
    pub metres_per_unit: Option<f64>,
    /// The motion files' axes.
    pub axes: Option<SignerAxes>,
    /// The assignment of joints to parts of the body.
    pub roles: Option<AssignedJointRoles>,
    /// Whether root columns whose order differs from their header are read in their actual order.
    pub mend_root: bool,
    /// The meaning of tiers and columns; it takes precedence over statements in an annotation file.
    pub mapping: TierMapping,
    /// The origin of the recordings.
    pub origin: Option<RecordOrigin>,
    /// The terms under which the recordings may be used.
    pub licence: Option<String>,
    /// The lexicon to which the signs of tables and notation belong, instead of the one that their files indicate.
    pub lexicon: Option<String>,
    /// The sign language of that lexicon, as a code of ISO 639-3.
    pub sign_language: Option<String>,
    /// The treatment of edits in the corpus that an annotation file would revert when it is imported again.
    pub own_edits: OwnEdits,
    /// The recording that all files belong to, instead of the one that their names indicate.
    pub into: Option<RowName>,
    /// The evidence that is enough to join files into one recording.
    pub joining: FileJoining,
    /// The start of the files' tracks on the recording's clock, in microseconds; may be negative.
    pub offset_us: i64,
    /// The time of day at which the tracks start, if the files do not state it; tracks of one recording with known
    /// times of day are aligned by these.
    pub clock: Option<RecordingInstant>,
    /// The frame rate of films whose files do not state it.
    pub rate: Option<FrameRate>,
    /// Work that completes the import within its operation, such as [`GLOSSES_FROM_NAMES`](crate::GLOSSES_FROM_NAMES).
    pub completion: Option<ImportCompletion>,
    /// Whether the import only reports what it would do, and writes nothing.
    pub dry_run: bool,
    /// The temporary file that holds standard input; the corpus and the report know it as `-`.
    pub standard_input: Option<PathBuf>,
}

/// Work on the imported files that rooms above the import do, within its operation.
#[derive(Debug, Clone, Copy)]
pub struct ImportCompletion(pub(crate) CompleteImport);

type CompleteImport = fn(&Connection, &mut ImportReport, &mut ProgressReceiver<'_>) -> CorpusResult<()>;

/// The treatment of edits in the corpus that a file would revert when it is imported again.
///
/// With any choice but the first, a file of the same name in another folder counts as a version of the imported one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum OwnEdits {
    /// The file is refused, and [`FileReport::edits`] lists what would be lost.
    #[default]
    Ask,
    /// The edits in the corpus win.
    Mine,
    /// The file's annotations replace the edits.
    Theirs,
    /// A change that only one side made is taken over; if both changed the same annotation, the edit stays and is
    /// listed.
    Merge,
}

/// The file being imported, and the state that every reader needs.
struct ImportJob<'a> {
    connection: &'a Connection,
    options: &'a ImportOptions,
    path: &'a Path,
    /// The file's name without folder and extension.
    stem: String,
    file_name: String,
    /// The path of the file relative to the folder of the corpus.
    place: String,
    /// The folder of the corpus.
    base: &'a Path,
    /// The kind of the file in `source_file.kind`.
    kind: &'static str,
    hash: String,
    inventories: Rc<Vec<StoredInventory>>,
    /// The files that were imported into the corpus.
    places: &'a mut ImportedFilePlaces,
    counts: RowChangeCounts,
    /// Names and patterns of the mapping that match a tier or column of this import.
    used: &'a mut BTreeSet<String>,
    /// Whether the caller named the file itself rather than a folder that contains it.
    named: bool,
    /// The number of progress reports so far.
    steps: u64,
    /// The recording of the only motion file in this file's folder, if the folder holds one take.
    folder_take: Option<i64>,
    /// The recording that the file became, if the corpus has the same file already.
    again: Option<i64>,
    /// Whether an annotation file of the same folder and name is imported with it.
    has_own_annotations: bool,
    /// The file that it was joined with.
    joined: Option<FileJoin>,
}

impl ImportJob<'_> {
    fn count_created_rows(&mut self, what: &'static str, many: usize) {
        self.counts.count_added_rows(what, many);
    }

    /// Returns the recording of files in the same folder whose names differ only in the ending, also in a second one
    /// such as `.curves`.
    fn find_sibling_recording(&self) -> Option<i64> {
        let folder = self.place.rfind('/').map_or(0, |at| at + 1);
        let named = format!("{}{}.", &self.place[..folder], self.stem);
        let places = &self.places;
        places
            .recording_beside_file(&self.place)
            .or_else(|| places.recording_beside_file(&named))
    }

    /// Reports progress; fails if the caller asks the work to stop.
    fn report_progress(&mut self, progress: &mut ProgressReceiver<'_>) -> CorpusResult<()> {
        self.steps += 1;
        progress.report_amount(ProgressUnit::Items, &self.file_name, self.steps, None)
    }

    /// Returns a report that nothing changed, if a file with the same bytes was imported before, from any path, and no
    /// other bytes from this path since: new versions of a file take the place of earlier ones.
    fn report_unchanged_file(&mut self) -> Option<FileReport> {
        let newest = self.places.find_file_at(&self.place, self.kind);
        let replaced = newest.is_some_and(|row| row.hash != self.hash);
        (!replaced).then(|| self.imported_before()).flatten()
    }

    /// Returns a report that nothing changed, if a file with the same bytes was imported before, from any path; what it
    /// brought stays beside what was imported from its path since, as movement does.
    fn imported_before(&mut self) -> Option<FileReport> {
        let earlier_file = self
            .places
            .files_with_hash(&self.hash)
            .find(|row| row.kind == self.kind)?;
        self.again = earlier_file.recording_id;
        let elsewhere = earlier_file.path.as_deref().filter(|path| *path != self.place);
        Some(FileReport::unchanged_file_report(self.path, elsewhere))
    }

    /// Records the file, with its bytes if they are to be stored, and returns its row.
    fn keep_source_file(&mut self, recording_id: Option<i64>, bytes: Option<&[u8]>) -> CorpusResult<i64> {
        let mut row = SourceFileRow {
            id: 0,
            recording_id,
            kind: self.kind.to_owned(),
            name: self.file_name.clone(),
            path: Some(self.place.clone()),
            hash: self.hash.clone(),
        };
        row.id = stored_recordings::insert_source_file(self.connection, &row, bytes)?;
        let id = row.id;
        self.places.add_file_place(row);
        Ok(id)
    }

    fn read_job_bytes(&self) -> CorpusResult<Vec<u8>> {
        import_whole::read_whole_file(self.path)
    }
}

impl Corpus {
    /// Imports files and folders into the corpus as one operation.
    ///
    /// A motion file and an annotation file of the same folder and stem become one recording; what else joins files,
    /// [`ImportOptions::joining`] says, and [`ImportReport::joined`] what did. A file is identified by its path: files of
    /// one name in two folders are two. Files that were imported before are left alone, unless the
    /// mapping gives their tiers or columns another meaning. A file that is refused is reported, leaves nothing behind,
    /// and does not prevent the others from being imported.
    ///
    /// # Errors
    /// Fails if the only file to read does not exist or has an unknown format, if the work is stopped, or if the
    /// database fails.
    pub fn import_paths(
        &mut self,
        paths: &[PathBuf],
        options: &ImportOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<ImportReport> {
        let mut files = gather_import_candidates(paths);
        if let [only] = files.as_slice()
            && only.named
            && only.reader.is_err()
            && let Some(ImportCandidate { reader: Err(error), .. }) = files.pop()
        {
            return Err(error);
        }
        let base = absolute(self.store.store_path());
        let mut report = ImportReport::default();
        let run = |connection: &Connection, progress: &mut ProgressReceiver<'_>| {
            let mut import = ImportRun {
                connection,
                options,
                base: base.parent().unwrap_or(Path::new("")),
                places: ImportedFilePlaces::load_file_places(connection)?,
                inventories: None,
                used: BTreeSet::new(),
                earlier: EarlierInterpretations::default(),
                one_take: one_take(&files),
                annotated: annotated_stems(&files),
            };
            import.import_candidate_files(&files, &mut report, progress)?;
            if let Some(ImportCompletion(complete)) = options.completion {
                complete(connection, &mut report, progress)?;
            }
            import.warn_of_mapping(&mut report);
            let effect = report.import_effect();
            if options.dry_run {
                Err(CorpusError::Stopped)
            } else {
                Ok(((), effect))
            }
        };
        match self.store.operation_with_progress(progress, run) {
            // A dry run ends as if it was stopped, so that everything is rolled back.
            Err(CorpusError::Stopped) if options.dry_run && report.complete => {}
            other => other?,
        }
        report.dry_run = options.dry_run;
        Ok(report)
    }
}

/// A file to import, or the reason why it is not read.
struct ImportCandidate {
    path: PathBuf,
    /// Its index in [`FILE_READERS`], or the reason why it is not read.
    reader: std::result::Result<usize, CorpusError>,
    /// Whether the caller named it rather than a folder that contains it.
    named: bool,
}

/// State shared by the files of an import.
struct ImportRun<'a> {
    connection: &'a Connection,
    options: &'a ImportOptions,
    /// The folder of the corpus.
    base: &'a Path,
    places: ImportedFilePlaces,
    inventories: Option<Rc<Vec<StoredInventory>>>,
    /// Names and patterns of the mapping that match a tier or column.
    used: BTreeSet<String>,
    /// The interpretations of earlier files, to be held once.
    earlier: EarlierInterpretations,
    /// Files that are the only one of their kind and name beside a single motion file in their folder.
    one_take: BTreeSet<PathBuf>,
    /// The paths of annotation files without their endings.
    annotated: BTreeSet<PathBuf>,
}

/// Returns the paths of the annotation files without their endings.
fn annotated_stems(files: &[ImportCandidate]) -> BTreeSet<PathBuf> {
    let has_annotations = |candidate: &&ImportCandidate| match candidate.reader {
        Ok(reader) => FILE_READERS[reader].holds_annotations(),
        Err(_) => false,
    };
    let annotation_files = files.iter().filter(has_annotations);
    annotation_files
        .map(|candidate| candidate.path.with_extension(""))
        .collect()
}

/// Returns the files of folders that hold one take: each is beside a single motion file, is the only one of its kind,
/// and has a name that no other file in the folder has.
fn one_take(files: &[ImportCandidate]) -> BTreeSet<PathBuf> {
    let readable = |candidate: &&ImportCandidate| candidate.reader.is_ok() && !candidate.named;
    let mut kinds: BTreeMap<(&Path, &str), usize> = BTreeMap::new();
    let mut stems: BTreeMap<(&Path, String), usize> = BTreeMap::new();
    let kind = |candidate: &ImportCandidate| match candidate.reader {
        Ok(reader) if FILE_READERS[reader].is_movement() => "movement",
        Ok(reader) => FILE_READERS[reader].kind,
        Err(_) => "",
    };
    let folder = |candidate: &'_ ImportCandidate| candidate.path.parent().map(Path::to_owned).unwrap_or_default();
    let folders: Vec<PathBuf> = files.iter().map(folder).collect();
    let stem = |path: &Path| legible_path_text(path.file_stem().unwrap_or_default()).to_lowercase();
    for (it, folder) in files.iter().zip(&folders).filter(|pair| readable(&pair.0)) {
        *kinds.entry((folder, kind(it))).or_default() += 1;
        *stems.entry((folder, stem(&it.path))).or_default() += 1;
    }
    let alone = |(candidate, folder): &(&ImportCandidate, &PathBuf)| {
        let one = |kind: &str| kinds.get(&(folder.as_path(), kind)) == Some(&1);
        let own_kind = kind(candidate);
        readable(candidate)
            && own_kind != "movement"
            && one("movement")
            && one(own_kind)
            && stems.get(&(folder.as_path(), stem(&candidate.path))) == Some(&1)
    };
    let lone_files = files.iter().zip(&folders).filter(alone);
    lone_files.map(|(candidate, _)| candidate.path.clone()).collect()
}

impl ImportRun<'_> {
    fn import_candidate_files(
        &mut self,
        files: &[ImportCandidate],
        report: &mut ImportReport,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<()> {
        let connection = self.connection;
        let mut before = vec![0; FILE_READERS.len()];
        let total = |reader| {
            files
                .iter()
                .filter(move |candidate| candidate.reader.as_ref().is_ok_and(|index| *index == reader))
        };
        for ImportCandidate { path, reader, named } in files {
            let reader = match reader {
                Ok(reader) => *reader,
                Err(error) if *named => {
                    report.files.push(FileReport::refused_file_report(path, error));
                    continue;
                }
                Err(error) => {
                    report.files.push(FileReport::skipped_file_report(path, error));
                    continue;
                }
            };
            progress.report_amount(
                ProgressUnit::Items,
                FILE_READERS[reader].holds,
                before[reader],
                Some(total(reader).count() as u64),
            )?;
            before[reader] += 1;
            // A refused file must leave nothing behind, while the others stay.
            connection.execute_batch("SAVEPOINT file")?;
            let place_count = self.places.len();
            let counts = RowChangeCounts {
                created: report.created.clone(),
                changed: report.changed.clone(),
                removed: report.removed.clone(),
            };
            let file = match self.import_single_file(path, reader, *named, counts, progress) {
                Ok((mut file, counts)) if file.status != FileStatus::Refused => {
                    // Many takes of one body would otherwise hold the same names again and again.
                    self.earlier.share_equal_parts(&mut file.understood);
                    connection.execute_batch("RELEASE file")?;
                    let RowChangeCounts {
                        created,
                        changed,
                        removed,
                    } = counts;
                    (report.created, report.changed, report.removed) = (created, changed, removed);
                    report.files.push(file);
                    continue;
                }
                Ok((file, _)) => file,
                Err(CorpusError::Stopped) => return Err(CorpusError::Stopped),
                Err(error) => FileReport::refused_file_report(path, &error),
            };
            connection.execute_batch("ROLLBACK TO file; RELEASE file")?;
            // The rows that the file had added were removed again.
            self.inventories = None;
            self.places.forget_later_files(place_count);
            report.files.push(file);
        }
        if let Some(path) = &self.options.standard_input {
            // The path of the temporary file would mean nothing to the user.
            let stands = legible_path_text(path);
            let shown = report.files.iter_mut().filter(|file| file.path == stands);
            shown.for_each(|file| "-".clone_into(&mut file.path));
        }
        import_pieces::report_known_movement_pieces(connection, &mut report.files, progress)?;
        report.joined = import_joining::joined_recordings(&report.files);
        report.complete = true;
        Ok(())
    }

    fn import_single_file(
        &mut self,
        path: &Path,
        reader: usize,
        named: bool,
        counts: RowChangeCounts,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<(FileReport, RowChangeCounts)> {
        let text = |part: Option<&std::ffi::OsStr>| part.map(legible_path_text).unwrap_or_default();
        check_name(path)?;
        let inventories = match &self.inventories {
            Some(loaded) => loaded.clone(),
            None => inventories::load_all_inventories(self.connection)?.into(),
        };
        let mut job = ImportJob {
            connection: self.connection,
            options: self.options,
            path,
            stem: text(path.file_stem()),
            file_name: text(path.file_name()),
            place: match self.options.standard_input.as_deref() == Some(path) {
                // A temporary file lies elsewhere each time, and would never be known again.
                true => format!("-/{}", text(path.file_name())),
                false => relative_file_path(&absolute(path), self.base),
            },
            kind: FILE_READERS[reader].kind,
            hash: match FILE_READERS[reader].kind {
                import_film::FILM_KIND => import_film::hash(path)?,
                _ => {
                    // A file that is too large is refused before it is read for its hash.
                    if !FILE_READERS[reader].is_streamed() {
                        import_whole::check_whole_file(path)?;
                    }
                    hash_file(path, progress)?
                }
            },
            base: self.base,
            inventories: inventories.clone(),
            places: &mut self.places,
            counts,
            used: &mut self.used,
            named,
            steps: 0,
            folder_take: None,
            again: None,
            has_own_annotations: self.annotated.contains(&path.with_extension("")),
            joined: None,
        };
        // A file that the user names may belong to any take, not only to that of its folder.
        if !named && self.one_take.contains(path) {
            job.folder_take = job.places.movement_beside(&job.place);
        }
        let mut done = FILE_READERS[reader].import_with_reader(&mut job, progress)?;
        if let Some(recording) = job.again.filter(|_| done.status != FileStatus::Refused) {
            import_again::update_recording_description(&mut job, recording, &mut done)?;
        }
        if done.status == FileStatus::Imported {
            job.report_equal_bytes(&mut done)?;
        }
        // A file that was refused or is unchanged joined nothing now.
        if matches!(done.status, FileStatus::Imported | FileStatus::Updated) {
            done.joined = job.joined.take();
        }
        // Files that add inventories make the next file load the inventories again.
        let same = Rc::ptr_eq(&job.inventories, &inventories) && FILE_READERS[reader].keeps_inventories;
        let counts = job.counts;
        self.inventories = same.then_some(inventories);
        Ok((done, counts))
    }

    /// Warns about names in the mapping that match no tier and no column of the files.
    fn warn_of_mapping(&self, report: &mut ImportReport) {
        let all = self.options.mapping.mapping_entry_names();
        let unused: Vec<String> = all
            .filter(|entry| !self.used.contains(*entry))
            .map(|entry| format!("{entry:?}"))
            .collect();
        if !unused.is_empty() {
            report.findings.push(ReportFinding::finding_warning(
                format!(
                    "the mapping names what no tier or column of these files is called: {}",
                    unused.join(", ")
                ),
                "look at the names that the report lists, and correct the mapping",
            ));
        }
    }
}

/// Returns a path from the root, with links and `..` resolved if it exists.
fn absolute(path: &Path) -> PathBuf {
    fs::canonicalize(path)
        .or_else(|_| std::path::absolute(path))
        .unwrap_or_else(|_| path.to_owned())
}

/// Returns the path of a file relative to a folder: `A/x.eaf`, or `../A/x.eaf`, with `/` on every system. On another
/// drive it is the absolute path.
fn relative_file_path(path: &Path, folder: &Path) -> String {
    let (own, base): (Vec<_>, Vec<_>) = (path.components().collect(), folder.components().collect());
    let shared = own.iter().zip(&base).take_while(|(a, b)| a == b).count();
    // Without a common root the path is that of another drive, which no step upwards reaches.
    let up = if shared == 0 { 0 } else { base.len() - shared };
    let names = own[shared..].iter().map(legible_path_text);
    let parts: Vec<_> = std::iter::repeat_n("..".into(), up).chain(names).collect();
    parts.join("/")
}

/// Refuses a path that is not UTF-8 if its text is the path of another file, so that the two are not taken for one.
fn check_name(path: &Path) -> CorpusResult<()> {
    let text = legible_path_text(path);
    match path.to_str().is_none() && Path::new(&text).exists() {
        true => Err(CorpusError::from_wrong_message(format!(
            "the path is not UTF-8, and as text it is that of another file: {text}"
        ))
        .with_error_place(text)
        .with_advice("rename one of the two files")),
        false => Ok(()),
    }
}

fn hash_file(path: &Path, progress: &mut ProgressReceiver<'_>) -> CorpusResult<String> {
    use std::io::Read;
    let fault = |error| CorpusError::from_file_failure(path, error);
    let mut file = fs::File::open(path).map_err(fault)?;
    let total = file.metadata().map_err(fault)?.len();
    let (mut digest, mut buffer, mut done) = (Sha256::new(), vec![0; 1 << 20], 0u64);
    loop {
        let read = file.read(&mut buffer).map_err(fault)?;
        if read == 0 {
            return Ok(to_hex_text(&digest.finalize()));
        }
        digest.update(&buffer[..read]);
        done += read as u64;
        // Smaller files are hashed before a report could be seen.
        if total > 64 << 20 {
            let task = "checking";
            let unit = crate::progress::ProgressUnit::Bytes;
            progress.report_step(crate::progress::ProgressStep {
                task,
                done,
                total: Some(total),
                unit,
            })?;
        }
    }
}

/// Returns the files in the order in which [`FILE_READERS`] reads them, preceded by those that are not read.
fn gather_import_candidates(paths: &[PathBuf]) -> Vec<ImportCandidate> {
    let mut files = Vec::new();
    for path in paths {
        match fs::metadata(path) {
            Ok(found) if found.is_dir() => walk_import_folder(path, 0, &mut files),
            Ok(_) => files.push(ImportCandidate::new(path.clone(), true)),
            Err(error) => files.push(ImportCandidate::broken_candidate(path, error)),
        }
    }
    // Of a file that is named and lies in a folder, too, the named one comes first and stays.
    files.sort_by(|a, b| (&a.path, b.named).cmp(&(&b.path, a.named)));
    files.dedup_by(|a, b| a.path == b.path);
    // If a film has a file for each frame, the first file stands for all.
    let mut films = BTreeSet::new();
    files.retain(|candidate| match import_points::point_file_series(&candidate.path) {
        Some(film) if candidate.reader.is_ok() => films.insert(film),
        _ => true,
    });
    files.sort_by_key(|candidate| candidate.reader.as_ref().ok().copied());
    files
}

impl ImportCandidate {
    /// Returns the candidate for a path. Only regular files are opened: a pipe may never end.
    fn new(path: PathBuf, named: bool) -> Self {
        let reader = match import_whole::check_kind(&path) {
            Ok(()) => readers::find_reader_index(&path).ok_or_else(|| readers::unread_format_error(&path)),
            Err(error) => Err(error),
        };
        Self { path, reader, named }
    }

    /// Returns a candidate for a path that cannot be read at all, so that the import reports it.
    fn broken_candidate(path: &Path, error: std::io::Error) -> Self {
        Self {
            path: path.to_owned(),
            reader: Err(CorpusError::from_file_failure(path, error)),
            named: true,
        }
    }
}

fn walk_import_folder(folder: &Path, depth: usize, files: &mut Vec<ImportCandidate>) {
    if depth > DEEPEST_FOLDER {
        let deep = CorpusError::from_wrong_message(format!("it lies {depth} folders deep"))
            .with_error_place(folder.display().to_string())
            .with_advice("import it by its own name");
        files.push(ImportCandidate {
            path: folder.to_owned(),
            reader: Err(deep),
            named: true,
        });
        return;
    }
    let entries = match fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) => return files.push(ImportCandidate::broken_candidate(folder, error)),
    };
    for entry in entries {
        let path = match entry {
            Ok(entry) => entry.path(),
            Err(error) => return files.push(ImportCandidate::broken_candidate(folder, error)),
        };
        let hidden = path
            .file_name()
            .is_some_and(|name| name.to_string_lossy().starts_with('.'));
        if path.is_dir() {
            // A link may lead back to a folder above, and the walk would not end.
            if !hidden && !path.is_symlink() {
                walk_import_folder(&path, depth + 1, files);
            }
        } else if !hidden {
            files.push(match readers::exported_copy_error(&path) {
                Some(why) => ImportCandidate {
                    path,
                    reader: Err(why),
                    named: false,
                },
                None => ImportCandidate::new(path, false),
            });
        }
    }
}
