//! Exports the enriched database as a folder that anyone can read, cite and check; the same corpus always gives the
//! same bytes.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{BufWriter, Read, Write};
use std::path::{Path, PathBuf};

use rusqlite::Connection;
use serde_json::json;
use sha2::{Digest, Sha256};

use super::{bvh, dictionary};
use crate::address::Stretch;
use crate::curves;
use crate::db::motion::{self, hex};
use crate::db::recordings::{self, RecordingRow};
use crate::db::unfinished::{Unfinished, remove_leftovers};
use crate::db::upgrade::NONMANUALS;
use crate::db::{dump, recipes, signs, tiers, tracks};
use crate::error::{Error, Result};
use crate::inventories;
use crate::progress::{Progress, Step, Unit};
use crate::track::{self, TrackKind};

/// The guide to the folder.
const ABOUT: &str = include_str!("enriched.md");

/// Writes the folder, which must not exist yet, and returns its files, with the checksums last.
pub(super) fn write(
    connection: &Connection,
    to: &Path,
    progress: &mut Progress<'_>,
) -> Result<Vec<PathBuf>> {
    if to.exists() {
        return Err(Error::wrong(
            "something of this name is there already, and no folder is replaced",
        )
        .at(to.display().to_string())
        .advise("choose another name, or move the existing one away"));
    }
    super::check_folder(to)?;
    remove_leftovers(to);
    let part = Unfinished::folder(to).map_err(|error| Error::file(to, error))?;
    let folder = Folder {
        root: part.path().to_owned(),
        files: Vec::new(),
    };
    let done = folder.fill(connection, progress);
    match done {
        Ok(files) => {
            part.rename(to).map_err(|error| Error::file(to, error))?;
            Ok(files.into_iter().map(|file| to.join(file)).collect())
        }
        Err(error) => {
            let part = part.path();
            Err(match error {
                // The temporary name says nothing to the caller.
                Error::File { path, source } if path.starts_with(part) => {
                    let inner = path.strip_prefix(part).unwrap_or(&path);
                    Error::file(to.join(inner), source)
                }
                other => other,
            })
        }
    }
}

struct Folder {
    root: PathBuf,
    /// Paths within the folder, separated by `/`.
    files: Vec<String>,
}

impl Folder {
    fn fill(mut self, connection: &Connection, progress: &mut Progress<'_>) -> Result<Vec<String>> {
        self.text("README.md", ABOUT)?;
        self.text("DICTIONARY.md", &dictionary::dictionary())?;
        self.text("queries.sql", &dictionary::queries())?;
        let copy = self.make("corpus.chereme")?;
        dump::copy(connection, &copy)?;
        // The other files are written from the copy, so that the whole folder shows one moment.
        let connection = &dump::read_copy(&copy)?;
        for table in dump::TABLES {
            self.table(connection, table)?;
        }
        self.inventories(connection)?;
        self.recordings(connection, progress)?;
        self.provenance(connection)?;
        self.checksums()?;
        Ok(self.files)
    }

    /// Creates the folders above a file, records it, and returns its path.
    fn make(&mut self, path: &str) -> Result<PathBuf> {
        let full = self.root.join(path);
        let above = full.parent().unwrap_or(&self.root).to_owned();
        fs::create_dir_all(&above).map_err(|error| Error::file(above, error))?;
        self.files.push(path.to_owned());
        Ok(full)
    }

    fn text(&mut self, path: &str, text: &str) -> Result<()> {
        let full = self.make(path)?;
        fs::write(&full, text).map_err(|error| Error::file(full, error))
    }

    fn table(&mut self, connection: &Connection, table: &str) -> Result<()> {
        let path = self.make(&format!("tables/{table}.csv"))?;
        let fault = |error: csv::Error| Error::wrong(format!("{table}.csv: {error}"));
        let mut writer = csv::Writer::from_path(&path).map_err(fault)?;
        dump::table(connection, table, |cells| {
            writer.write_record(cells).map_err(fault)
        })?;
        writer.flush().map_err(|error| Error::file(path, error))
    }

    fn inventories(&mut self, connection: &Connection) -> Result<()> {
        let mut taken = BTreeSet::new();
        for stored in inventories::load(connection)? {
            let name = file_name(&stored.inventory.id, &mut taken);
            self.text(
                &format!("inventories/{name}.json"),
                &stored.inventory.to_json(),
            )?;
        }
        Ok(())
    }

    fn recordings(&mut self, connection: &Connection, progress: &mut Progress<'_>) -> Result<()> {
        let mut taken = BTreeSet::new();
        let all = recordings::recordings(connection)?;
        for (done, recording) in all.iter().enumerate() {
            let name = file_name(&recording.name, &mut taken);
            if recordings::body_track(connection, recording.id)?.is_some() {
                self.movement(connection, recording, &name, progress)?;
            }
            self.tracks(connection, recording, &name, &mut taken)?;
            if !tiers::tiers(connection, recording.id)?.is_empty() {
                let path = self.make(&format!("recordings/{name}.eaf"))?;
                super::eaf::write_file(connection, recording, &path)?;
            }
            let total = Some(all.len() as u64);
            let step = Step {
                task: "recordings",
                done: done as u64 + 1,
                total,
                unit: Unit::Items,
            };
            progress.report(step)?;
        }
        Ok(())
    }

    fn movement(
        &mut self,
        connection: &Connection,
        recording: &RecordingRow,
        name: &str,
        progress: &mut Progress<'_>,
    ) -> Result<()> {
        let path = self.make(&format!("recordings/{name}.bvh"))?;
        let fault = |error| Error::file(&path, error);
        let mut out = BufWriter::new(File::create(&path).map_err(fault)?);
        let span = Default::default();
        let stretch = Stretch {
            recording: recording.clone(),
            span,
            token: None,
        };
        bvh::write(connection, &stretch, &mut out, progress)?;
        out.flush().map_err(fault)?;
        let body = recordings::body_track(connection, recording.id)?;
        let body = body.map(|track| motion::nonmanuals(connection, track.id));
        if body.transpose()?.flatten().is_none() {
            return Ok(());
        }
        let path = self.make(&format!("recordings/{name}.curves.csv"))?;
        let fault = |error| Error::file(&path, error);
        let mut out = BufWriter::new(File::create(&path).map_err(fault)?);
        curves::write_table(connection, &stretch, b',', &mut out)?;
        out.flush().map_err(fault)
    }

    /// Writes every track of markers or curves with its exact numbers.
    fn tracks(
        &mut self,
        connection: &Connection,
        recording: &RecordingRow,
        name: &str,
        taken: &mut BTreeSet<String>,
    ) -> Result<()> {
        let body = recordings::body_track(connection, recording.id)?.is_some();
        for row in tracks::tracks(connection, recording.id)? {
            let beside_body = body && row.name == NONMANUALS;
            if !matches!(row.kind, TrackKind::Markers | TrackKind::Curves) || beside_body {
                continue;
            }
            let file = file_name(&format!("{name}.{}", row.name), taken);
            let path = self.make(&format!("recordings/{file}.csv"))?;
            let fault = |error| Error::file(&path, error);
            let mut out = BufWriter::new(File::create(&path).map_err(fault)?);
            let track = track::read::track(connection, &row, None)?;
            track::table::write(&track, b',', &mut out)?;
            out.flush().map_err(fault)?;
        }
        Ok(())
    }

    /// Writes the signers and licences of recordings, and the sources of generated signs.
    fn provenance(&mut self, connection: &Connection) -> Result<()> {
        let mut list = Vec::new();
        let mut terms = String::from(
            "# Terms of use\n\nrecording | signer | origin | terms\n---|---|---|---\n",
        );
        for recording in recordings::recordings(connection)? {
            let files = recordings::source_files(connection, recording.id)?;
            let recipe = recipes::of_recording(connection, recording.id)?;
            let licence = recording.licence.clone();
            terms.push_str(&format!(
                "{} | {} | {} | {}\n",
                recording.name,
                recording.signer.as_deref().unwrap_or("not named"),
                recording.origin,
                licence
                    .as_deref()
                    .unwrap_or("not stated: ask the owner before use"),
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
        let signs = signs::glosses(connection)?.len();
        let document = json!({
            "made_by": format!("Chereme {}", env!("CARGO_PKG_VERSION")),
            "schema_version": crate::db::SCHEMA_VERSION,
            "signs": signs,
            "recordings": list,
        });
        let text =
            serde_json::to_string_pretty(&document).map_err(|e| Error::wrong(e.to_string()))?;
        self.text("provenance.json", &(text + "\n"))?;
        self.text("LICENCES.md", &terms)
    }

    fn checksums(&mut self) -> Result<()> {
        self.files.sort();
        let mut lines = String::new();
        for file in &self.files {
            lines.push_str(&format!("{}  {file}\n", hash(&self.root.join(file))?));
        }
        self.text("SHA256SUMS", &lines)
    }
}

fn hash(path: &Path) -> Result<String> {
    let fault = |error| Error::file(path, error);
    let mut file = File::open(path).map_err(fault)?;
    let (mut digest, mut buffer) = (Sha256::new(), vec![0; 1 << 20]);
    loop {
        match file.read(&mut buffer).map_err(fault)? {
            0 => return Ok(hex(&digest.finalize())),
            read => digest.update(&buffer[..read]),
        }
    }
}

/// Returns a file name similar to `name` that is valid on every system and not in `taken`.
pub(super) fn file_name(name: &str, taken: &mut BTreeSet<String>) -> String {
    let plain: String = name
        .chars()
        .map(|c| {
            if c.is_control() || "/\\:*?\"<>|".contains(c) {
                '_'
            } else {
                c
            }
        })
        .collect();
    let plain = plain.trim().trim_end_matches('.').to_owned();
    let plain = if plain.is_empty() {
        "unnamed".to_owned()
    } else {
        plain
    };
    let mut free = plain.clone();
    let mut count = 1;
    while !taken.insert(free.to_lowercase()) {
        count += 1;
        free = format!("{plain} ({count})");
    }
    free
}
