//! Exports the enriched database as a folder that anyone can read, cite and check; the same corpus always gives the
//! same bytes.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{BufWriter, Read, Write};
use std::path::{Path, PathBuf};

use rusqlite::Connection;
use serde_json::json;
use sha2::{Digest, Sha256};

use super::{ExportGate, export_bvh, export_dictionary};
use crate::address::RecordingStretch;
use crate::consent::{OutputAudience, WithheldOutput};
use crate::curves;
use crate::db::stored_motion::{self, to_hex_text};
use crate::db::stored_recordings::{self, RecordingRow};
use crate::db::unfinished::{UnfinishedFile, remove_leftovers};
use crate::db::upgrade::NONMANUALS_TRACK_NAME;
use crate::db::{dump, recipes, signs, stored_tiers, stored_tracks};
use crate::error::{CorpusError, CorpusResult};
use crate::inventories;
use crate::progress::{ProgressReceiver, ProgressStep, ProgressUnit};
use crate::track::{self, TrackKind};

/// The guide to the folder.
const ENRICHED_FOLDER_GUIDE: &str = include_str!("enriched.md");

/// Writes the folder, which must not exist yet, and returns its files, with the checksums last.
pub(super) fn write_enriched_folder(
    connection: &Connection,
    to: &Path,
    gate: &ExportGate,
    with_history: bool,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<WrittenEnrichedFolder> {
    if to.exists() {
        return Err(CorpusError::from_wrong_message(
            "something of this name is there already, and no folder is replaced",
        )
        .with_error_place(to.display().to_string())
        .with_advice("choose another name, or move the existing one away"));
    }
    crate::atomic_write::check_folder(to)?;
    remove_leftovers(to);
    let part =
        UnfinishedFile::create_unfinished_folder(to).map_err(|error| CorpusError::from_file_failure(to, error))?;
    let folder = EnrichedFolder {
        root: part.unfinished_path().to_owned(),
        files: Vec::new(),
        gate,
        with_history,
    };
    let mut withheld_ids = BTreeSet::new();
    let mut withheld = Vec::new();
    for (recording, one) in gate.withheld_recordings() {
        withheld_ids.insert(recording);
        withheld.push(one);
    }
    let done = folder.fill_enriched_folder(connection, &withheld_ids, progress);
    match done {
        Ok(files) => {
            part.rename_unfinished(to)
                .map_err(|error| CorpusError::from_file_failure(to, error))?;
            let mut notes = Vec::new();
            if !with_history {
                notes.push("the copy has no history: nothing that was deleted or changed before is in it".to_owned());
            }
            if gate.export_audience() != OutputAudience::Me {
                notes.push("studies and saved searches are left out of a copy for others".to_owned());
            }
            Ok(WrittenEnrichedFolder {
                files: files.into_iter().map(|file| to.join(file)).collect(),
                withheld,
                notes,
            })
        }
        Err(error) => {
            let part = part.unfinished_path();
            Err(match error {
                // The temporary name says nothing to the caller.
                CorpusError::File { path, source } if path.starts_with(part) => {
                    let inner = path.strip_prefix(part).unwrap_or(&path);
                    CorpusError::from_file_failure(to.join(inner), source)
                }
                other => other,
            })
        }
    }
}

/// A folder of everything that was written.
pub(super) struct WrittenEnrichedFolder {
    /// Its files, with the checksums last.
    pub(super) files: Vec<PathBuf>,
    /// What was left out of it, because somebody did not agree that this audience sees it.
    pub(super) withheld: Vec<WithheldOutput>,
    /// Notes for its reader.
    pub(super) notes: Vec<String>,
}

struct EnrichedFolder<'a> {
    root: PathBuf,
    gate: &'a ExportGate,
    with_history: bool,
    /// Paths within the folder, separated by `/`.
    files: Vec<String>,
}

impl EnrichedFolder<'_> {
    fn fill_enriched_folder(
        mut self,
        connection: &Connection,
        withheld: &BTreeSet<i64>,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<Vec<String>> {
        self.write_folder_text("README.md", ENRICHED_FOLDER_GUIDE)?;
        self.write_folder_text("DICTIONARY.md", &export_dictionary::data_dictionary_text())?;
        self.write_folder_text("queries.sql", &export_dictionary::example_queries_text())?;
        let copy = self.prepare_folder_file("corpus.chereme")?;
        let for_others = self.gate.export_audience() != OutputAudience::Me;
        match self.with_history && !for_others {
            true => dump::copy_database_compactly(connection, &copy)?,
            false => dump::copy_without(
                connection,
                &copy,
                dump::OmittedRows {
                    recordings: withheld,
                    history: !self.with_history || for_others,
                    audience: self.gate.export_audience().consent_audience(),
                },
            )?,
        }
        // The other files are written from the copy, so that the whole folder shows one moment.
        let connection = &dump::read_copy(&copy)?;
        for table in dump::DUMPED_TABLES {
            self.write_folder_table(connection, table)?;
        }
        self.write_folder_inventories(connection)?;
        self.write_folder_recordings(connection, progress)?;
        self.provenance(connection)?;
        self.checksums()?;
        Ok(self.files)
    }

    /// Creates the folders above a file, records it, and returns its path.
    fn prepare_folder_file(&mut self, path: &str) -> CorpusResult<PathBuf> {
        let full = self.root.join(path);
        let above = full.parent().unwrap_or(&self.root).to_owned();
        fs::create_dir_all(&above).map_err(|error| CorpusError::from_file_failure(above, error))?;
        self.files.push(path.to_owned());
        Ok(full)
    }

    fn write_folder_text(&mut self, path: &str, text: &str) -> CorpusResult<()> {
        let full = self.prepare_folder_file(path)?;
        fs::write(&full, text).map_err(|error| CorpusError::from_file_failure(full, error))
    }

    fn write_folder_table(&mut self, connection: &Connection, table: &str) -> CorpusResult<()> {
        let path = self.prepare_folder_file(&format!("tables/{table}.csv"))?;
        let fault = |error: csv::Error| CorpusError::from_wrong_message(format!("{table}.csv: {error}"));
        let mut writer = csv::Writer::from_path(&path).map_err(fault)?;
        dump::dump_table_rows(connection, table, |cells| writer.write_record(cells).map_err(fault))?;
        writer
            .flush()
            .map_err(|error| CorpusError::from_file_failure(path, error))
    }

    fn write_folder_inventories(&mut self, connection: &Connection) -> CorpusResult<()> {
        let mut taken = BTreeSet::new();
        for stored in inventories::load_all_inventories(connection)? {
            let name = file_name(&stored.inventory.id, &mut taken);
            self.write_folder_text(&format!("inventories/{name}.json"), &stored.inventory.to_json())?;
        }
        Ok(())
    }

    fn write_folder_recordings(
        &mut self,
        connection: &Connection,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<()> {
        let mut taken = BTreeSet::new();
        let all = stored_recordings::load_recording_rows(connection)?;
        for (done, recording) in all.iter().enumerate() {
            let name = file_name(&recording.name, &mut taken);
            if stored_recordings::body_track(connection, recording.id)?.is_some() {
                self.write_folder_movement(connection, recording, &name, progress)?;
            }
            self.write_folder_tracks(connection, recording, &name, &mut taken)?;
            if !stored_tiers::load_tier_rows(connection, recording.id)?.is_empty() {
                let path = self.prepare_folder_file(&format!("recordings/{name}.eaf"))?;
                super::export_eaf::write_file(connection, recording, &path)?;
            }
            let total = Some(all.len() as u64);
            let step = ProgressStep {
                task: "recordings",
                done: done as u64 + 1,
                total,
                unit: ProgressUnit::Items,
            };
            progress.report_step(step)?;
        }
        Ok(())
    }

    fn write_folder_movement(
        &mut self,
        connection: &Connection,
        recording: &RecordingRow,
        name: &str,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<()> {
        let path = self.prepare_folder_file(&format!("recordings/{name}.bvh"))?;
        let fault = |error| CorpusError::from_file_failure(&path, error);
        let mut out = BufWriter::new(File::create(&path).map_err(fault)?);
        // A whole recording is written, for which the span does not count.
        let span = Default::default();
        let stretch = RecordingStretch {
            recording: recording.clone(),
            span,
            token: None,
        };
        export_bvh::write_bvh_stretch(connection, &stretch, &mut out, progress)?;
        out.flush().map_err(fault)?;
        let body_row = stored_recordings::body_track(connection, recording.id)?;
        let body = body_row.map(|track| stored_motion::find_nonmanual_track(connection, track.id));
        if body.transpose()?.flatten().is_none() {
            return Ok(());
        }
        let path = self.prepare_folder_file(&format!("recordings/{name}.curves.csv"))?;
        let fault = |error| CorpusError::from_file_failure(&path, error);
        let mut out = BufWriter::new(File::create(&path).map_err(fault)?);
        curves::write_table(connection, &stretch, b',', &mut out)?;
        out.flush().map_err(fault)
    }

    /// Writes every track of markers or curves with its exact numbers.
    fn write_folder_tracks(
        &mut self,
        connection: &Connection,
        recording: &RecordingRow,
        name: &str,
        taken: &mut BTreeSet<String>,
    ) -> CorpusResult<()> {
        let body = stored_recordings::body_track(connection, recording.id)?.is_some();
        for row in stored_tracks::load_track_rows(connection, recording.id)? {
            // These curves are written beside the movement, frame by frame.
            let beside_body = body && row.name == NONMANUALS_TRACK_NAME;
            if !matches!(row.kind, TrackKind::Markers | TrackKind::Curves) || beside_body {
                continue;
            }
            let file = file_name(&format!("{name}.{}", row.name), taken);
            let path = self.prepare_folder_file(&format!("recordings/{file}.csv"))?;
            let fault = |error| CorpusError::from_file_failure(&path, error);
            let mut out = BufWriter::new(File::create(&path).map_err(fault)?);
            let track = track::track_read::read_stored_track(connection, &row, None)?;
            track::track_table::write_track_table(&track, b',', &mut out)?;
            out.flush().map_err(fault)?;
        }
        Ok(())
    }

    /// Writes the signers and licences of recordings, and the sources of generated signs.
    fn provenance(&mut self, connection: &Connection) -> CorpusResult<()> {
        let mut list = Vec::new();
        let audience = self.gate.export_audience();
        let mut terms = format!(
            "# Terms of use\n\nThis copy is for: {audience}\n\nrecording | signer | origin | terms\n---|---|---|---\n"
        );
        for recording in stored_recordings::load_recording_rows(connection)? {
            let files = stored_recordings::source_files(connection, recording.id)?;
            let recipe = recipes::find_recording_recipe(connection, recording.id)?;
            let licence = self.gate.listed_terms(&recording);
            terms.push_str(&format!(
                "{} | {} | {} | {}\n",
                recording.name,
                recording.signer.as_deref().unwrap_or("not named"),
                recording.origin,
                licence,
            ));
            list.push(json!({
                "recording": recording.name,
                "signer": recording.signer,
                "origin": recording.origin,
                "licence": licence,
                "files": files.iter().map(|file| json!({ "name": file.name, "kind": file.kind, "sha256": file.hash })).collect::<Vec<_>>(),
                "recipe": recipe.as_ref().map(|recipe| &recipe.text),
                "engine": recipe.as_ref().map(|recipe| &recipe.engine),
            }));
        }
        let signs = signs::list_all_glosses(connection)?.len();
        let document = json!({
            "made_by": format!("Chereme {}", env!("CARGO_PKG_VERSION")),
            "schema_version": crate::db::SCHEMA_VERSION,
            "signs": signs,
            "audience": audience,
            "recordings": list,
        });
        let text =
            serde_json::to_string_pretty(&document).map_err(|e| CorpusError::from_wrong_message(e.to_string()))?;
        self.write_folder_text("provenance.json", &(text + "\n"))?;
        self.write_folder_text("LICENCES.md", &terms)
    }

    fn checksums(&mut self) -> CorpusResult<()> {
        // The same corpus gives the same list, whatever the order of writing.
        self.files.sort();
        let mut lines = String::new();
        for file in &self.files {
            lines.push_str(&format!("{}  {file}\n", hash(&self.root.join(file))?));
        }
        self.write_folder_text("SHA256SUMS", &lines)
    }
}

fn hash(path: &Path) -> CorpusResult<String> {
    let fault = |error| CorpusError::from_file_failure(path, error);
    let mut file = File::open(path).map_err(fault)?;
    let (mut digest, mut buffer) = (Sha256::new(), vec![0; 1 << 20]);
    loop {
        match file.read(&mut buffer).map_err(fault)? {
            0 => return Ok(to_hex_text(&digest.finalize())),
            read => digest.update(&buffer[..read]),
        }
    }
}

/// Returns a file name similar to `name` that is valid on every system and not in `taken`.
pub(super) fn file_name(name: &str, taken: &mut BTreeSet<String>) -> String {
    let safe_text: String = name
        .chars()
        .map(|c| {
            if c.is_control() || "/\\:*?\"<>|".contains(c) {
                '_'
            } else {
                c
            }
        })
        .collect();
    let plain = safe_text.trim().trim_end_matches('.').to_owned();
    let plain = if plain.is_empty() { "unnamed".to_owned() } else { plain };
    let mut free = plain.clone();
    let mut count = 1;
    // Some systems take names for equal that differ in case alone.
    while !taken.insert(free.to_lowercase()) {
        count += 1;
        free = format!("{plain} ({count})");
    }
    free
}
