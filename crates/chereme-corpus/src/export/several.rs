//! Exports several recordings or tokens at once, with a file for each of them in one folder.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use rusqlite::Connection;

use super::ExportJob;
use super::enriched::file_name;
use super::{
    ExportGate, ExportOptions, ExportReport, ExportWhat, LeftOutExport, LongTable, SingleFileFormat, UnnamedExportFile,
    export_subtitles, selected_export_tokens, write_file,
};
use crate::address::{self, CorpusAddress, RowName};
use crate::consent::{WithheldOutput, nothing_passes_error};
use crate::db::stored_list;
use crate::db::stored_tiers::{self, TierRow};
use crate::db::unfinished::remove_leftovers_in;
use crate::db::{signs, stored_recordings};
use crate::error::{CorpusError, CorpusResult};
use crate::progress::ProgressReceiver;

/// The number of names that a note lists.
const MAX_LISTED_EXPORT_NAMES: usize = 12;

/// The contents of a file of the folder.
struct FolderPart {
    /// The name of the recording, or the gloss of the token.
    name: String,
    content: FolderPartContent,
}

enum FolderPartContent {
    /// The same as an export of its own.
    What(ExportWhat),
    /// Tiers of a recording as subtitles.
    Subtitles(i64, Vec<TierRow>),
}

/// The kind of the files that are written into a folder.
#[derive(Clone, Copy)]
pub(super) struct FolderFileKind<'a> {
    /// The format.
    pub(super) format: SingleFileFormat<'a>,
    /// The ending of their names.
    pub(super) extension: &'a str,
}

/// Writes a file of `format` for each recording or token into the folder `to`, and creates the folder if it is missing.
///
/// Those that hold nothing for the format are left out and listed. After any other failure the folder is as before.
pub(super) fn write_export_folder(
    connection: &Connection,
    what: &ExportWhat,
    kind: FolderFileKind<'_>,
    to: &Path,
    options: &ExportOptions,
    gate: &ExportGate,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<ExportReport> {
    let FolderFileKind { format, extension } = kind;
    let mut withheld = BTreeSet::new();
    let mut parts = Vec::new();
    for part in list_folder_parts(connection, what, format)? {
        let shown = part.shown_recording(connection)?;
        // The name of its file is one of the corpus, so that it shows an annotation.
        match shown.and_then(|recording| gate.withheld_from(recording, format, true)) {
            Some(one) => drop(withheld.insert(one)),
            None => parts.push(part),
        }
    }
    let withheld: Vec<WithheldOutput> = withheld.into_iter().collect();
    if parts.is_empty() && !withheld.is_empty() {
        return Err(nothing_passes_error(&withheld, gate.export_audience()));
    }
    if parts.is_empty() {
        return Err(CorpusError::from_wrong_message("there is nothing to write")
            .with_advice("name recordings or tokens, or a query that finds some"));
    }
    if to.is_file() {
        return Err(CorpusError::from_existing_file(to));
    }
    // A folder that was there before belongs to the user, also if the export fails.
    let is_new = !to.exists();
    fs::create_dir_all(to).map_err(|error| CorpusError::from_file_failure(to, error))?;
    let ending = format!(".{extension}");
    remove_leftovers_in(to, |name| name.ends_with(&ending));
    let done = fill_export_folder(connection, &parts, kind, to, options, gate, progress);
    if done.is_err() && is_new {
        // Only an empty folder is removed, which a failed export leaves.
        let _ = fs::remove_dir(to);
    }
    done.map(|report| ExportReport { withheld, ..report })
}

fn fill_export_folder(
    connection: &Connection,
    parts: &[FolderPart],
    kind: FolderFileKind<'_>,
    to: &Path,
    options: &ExportOptions,
    gate: &ExportGate,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<ExportReport> {
    let FolderFileKind { format, extension } = kind;
    let mut taken = BTreeSet::new();
    let mut report = ExportReport::default();
    let mut written = Vec::new();
    let mut first_lack = None;
    for (done, part) in parts.iter().enumerate() {
        let mut notes = Vec::new();
        // A part that is left out must not take a name from another one.
        let mut taken_names = taken.clone();
        let name = file_name(&part.name, &mut taken_names);
        let path = to.join(format!("{name}.{extension}"));
        let file = UnnamedExportFile::write_unnamed_file(&path, options.force, &mut |out| {
            let mut job = ExportJob {
                connection,
                gate,
                out,
                notes: &mut notes,
                progress,
            };
            part.write_folder_part(&mut job, format)
        });
        match file {
            Ok(file) => {
                taken = taken_names;
                written.push(file);
                for note in notes {
                    // The same note holds for many files, and is given once.
                    if !report.notes.contains(&note) {
                        report.notes.push(note);
                    }
                }
            }
            // One recording without content must not stop the export of all others.
            Err(error) if error.is_lack() => {
                report.left_out.push(LeftOutExport {
                    name: part.name.clone(),
                    why: error.to_string(),
                });
                first_lack.get_or_insert(error);
            }
            Err(error) => return Err(of_part(&part.name, error)),
        }
        progress.report_items("files", done + 1, parts.len())?;
    }
    if let Some(error) = first_lack {
        if written.is_empty() {
            return Err(all_lack(error, parts.len(), extension));
        }
        report.notes.push(left_out(&report.left_out, parts.len(), extension));
    }
    if matches!(format, SingleFileFormat::Glb(..)) {
        let script = script(&to.join("annotations_to_markers.py"))?;
        written.insert(0, script);
        let note = "annotations_to_markers.py turns the annotations into markers of Blender's timeline";
        report.notes.insert(0, note.to_owned());
    }
    // Files get their names only when all are complete, so that a failure leaves none.
    for file in written {
        report.files.push(file.name_exported_file()?);
    }
    Ok(report)
}

/// Writes the script for Blender, whose content is always the same.
fn script(path: &Path) -> CorpusResult<UnnamedExportFile> {
    UnnamedExportFile::write_unnamed_file(path, true, &mut |out| {
        let text = include_bytes!("annotations_to_markers.py");
        out.write_all(text)
            .map_err(|error| CorpusError::from_wrong_message(format!("the script cannot be written: {error}")))
    })
}

/// Returns the note on those without a file.
fn left_out(all: &[LeftOutExport], of: usize, extension: &str) -> String {
    let quoted_names = all
        .iter()
        .take(MAX_LISTED_EXPORT_NAMES)
        .map(|part| format!("{:?}", part.name));
    let names = quoted_names.collect::<Vec<_>>().join(", ");
    let more = match all.len().checked_sub(MAX_LISTED_EXPORT_NAMES) {
        Some(more) if more > 0 => format!(" and {more} more"),
        _ => String::new(),
    };
    format!(
        "without what .{extension} holds, and left out: {} of {of}: {names}{more}",
        all.len()
    )
}

/// Returns the error if nothing can be written, as `first` says of the first of them.
fn all_lack(first: CorpusError, count: usize, extension: &str) -> CorpusError {
    if count == 1 {
        return first;
    }
    let message = format!("none of the {count} can be written as .{extension}; the first: {first}");
    match first.error_remedy() {
        Some(remedy) => CorpusError::from_wrong_message(message).with_advice(remedy),
        None => CorpusError::from_wrong_message(message),
    }
}

/// Returns the error of a recording or token, with its name.
fn of_part(name: &str, error: CorpusError) -> CorpusError {
    match error {
        // A message that names the thing already needs no second name.
        CorpusError::Wrong { ref message, .. } if !message.contains(name) => {
            let named = CorpusError::from_wrong_message(format!("the file of {name:?} cannot be written: {message}"))
                .with_error_place(name);
            match error.error_remedy() {
                Some(remedy) => named.with_advice(remedy),
                None => named,
            }
        }
        CorpusError::Damaged { place, reason } => CorpusError::Damaged {
            place: format!("{place} of {name:?}"),
            reason,
        },
        other => other,
    }
}

impl FolderPart {
    fn folder_part_of_recording(id: i64, name: &str) -> Self {
        Self {
            name: name.to_owned(),
            content: FolderPartContent::What(ExportWhat::Address(CorpusAddress::Recording(RowName::Number(id)))),
        }
    }

    /// Returns the recording that the part shows; nothing if it shows no recording.
    fn shown_recording(&self, connection: &Connection) -> CorpusResult<Option<i64>> {
        Ok(match &self.content {
            FolderPartContent::Subtitles(recording, _) => Some(*recording),
            FolderPartContent::What(ExportWhat::Address(CorpusAddress::Recording(name))) => {
                Some(address::find_recording_by_name(connection, name)?.id)
            }
            FolderPartContent::What(ExportWhat::Address(address)) => {
                address::find_addressed_token(connection, address)?.recording_id
            }
            // These are entries of a lexicon, which are in no recording.
            FolderPartContent::What(_) => None,
        })
    }

    fn write_folder_part(&self, job: &mut ExportJob<'_, '_>, format: SingleFileFormat<'_>) -> CorpusResult<()> {
        match (&self.content, format) {
            (FolderPartContent::Subtitles(recording, rows), SingleFileFormat::Subtitles(form)) => {
                let recording = stored_recordings::load_recording_row(job.connection, *recording)?;
                export_subtitles::write_recording_subtitles(job, &recording, rows, form)
            }
            (FolderPartContent::Subtitles(..), _) => Ok(()),
            (FolderPartContent::What(what), format) => {
                self.holds_rows(job.connection, what, format)?;
                write_file(job, what, format)
            }
        }
    }

    /// Fails if the table of a recording would have no rows.
    fn holds_rows(&self, connection: &Connection, what: &ExportWhat, format: SingleFileFormat<'_>) -> CorpusResult<()> {
        let ExportWhat::Address(CorpusAddress::Recording(RowName::Number(id))) = what else {
            return Ok(());
        };
        let (holds, what) = match format {
            SingleFileFormat::Table(_) | SingleFileFormat::Parquet(LongTable::Tokens | LongTable::Components) => {
                (!selected_export_tokens(connection, what)?.is_empty(), "tokens")
            }
            SingleFileFormat::Parquet(LongTable::Annotations) => {
                (!stored_tiers::load_tier_rows(connection, *id)?.is_empty(), "tiers")
            }
            SingleFileFormat::Parquet(LongTable::Frames) => {
                (stored_recordings::body_track(connection, *id)?.is_some(), "movement")
            }
            _ => return Ok(()),
        };
        match holds {
            true => Ok(()),
            false => Err(
                CorpusError::from_wrong_message(format!("the recording {:?} has no {what}", self.name))
                    .with_advice("name recordings that have some, or another format")
                    .into_lacking_content(),
            ),
        }
    }
}

/// Returns the files of the folder. In formats of tiers a token stands for its recording.
fn list_folder_parts(
    connection: &Connection,
    what: &ExportWhat,
    format: SingleFileFormat<'_>,
) -> CorpusResult<Vec<FolderPart>> {
    let mut all = Vec::new();
    match what {
        ExportWhat::All => {
            for row in stored_recordings::load_recording_rows(connection)? {
                all.push(FolderPart::folder_part_of_recording(row.id, &row.name));
            }
            all.extend(list_lexicon_parts(connection, format)?);
        }
        ExportWhat::Inventory(_) => {
            return Err(
                CorpusError::from_wrong_message("an inventory is one file").with_advice("end its name in .json")
            );
        }
        ExportWhat::Tokens(ids) => {
            for id in ids {
                all.push(folder_part_of_token(connection, *id, format)?);
            }
        }
        ExportWhat::Address(address) => all.push(folder_part_at_address(connection, address, format)?),
        ExportWhat::Several(addresses) => {
            for address in addresses {
                all.push(folder_part_at_address(connection, address, format)?);
            }
        }
    }
    // Several tokens may stand for the same recording.
    let mut seen = BTreeSet::new();
    all.retain(|part| match &part.content {
        FolderPartContent::What(ExportWhat::Address(address)) => seen.insert(address.to_string()),
        _ => true,
    });
    match format {
        SingleFileFormat::Subtitles(_) => {
            let part_results = all.into_iter().map(|part| languages(connection, part));
            let each = part_results.collect::<CorpusResult<Vec<_>>>()?;
            Ok(each.into_iter().flatten().collect())
        }
        _ => Ok(all),
    }
}

/// Returns the files of the tokens that are in no recording, in formats that hold those: one table for all, and a
/// notation for each.
fn list_lexicon_parts(connection: &Connection, format: SingleFileFormat<'_>) -> CorpusResult<Vec<FolderPart>> {
    let is_table = matches!(
        format,
        SingleFileFormat::Table(_) | SingleFileFormat::Parquet(LongTable::Tokens | LongTable::Components)
    );
    if !is_table && !matches!(format, SingleFileFormat::Notation(_)) {
        return Ok(Vec::new());
    }
    let ids = stored_list::token_ids(connection)?;
    let mut entries = Vec::new();
    for ids in ids.chunks(signs::MAX_ROWS_PER_QUERY) {
        let rows = signs::load_token_rows(connection, ids)?;
        let entry_rows = ids.iter().filter_map(|id| rows.get(id));
        let free = entry_rows.filter(|row| row.recording_id.is_none());
        entries.extend(free.map(|row| (row.id, row.gloss.clone())));
    }
    if entries.is_empty() {
        return Ok(Vec::new());
    }
    if is_table {
        let ids = entries.into_iter().map(|(id, _)| id).collect();
        return Ok(vec![FolderPart {
            name: "lexicon".to_owned(),
            content: FolderPartContent::What(ExportWhat::Tokens(ids)),
        }]);
    }
    let part = |(id, gloss)| FolderPart {
        name: gloss,
        content: FolderPartContent::What(ExportWhat::Address(CorpusAddress::Token(id))),
    };
    Ok(entries.into_iter().map(part).collect())
}

/// Returns a file of subtitles for each language of a recording.
fn languages(connection: &Connection, part: FolderPart) -> CorpusResult<Vec<FolderPart>> {
    let FolderPartContent::What(ExportWhat::Address(CorpusAddress::Recording(RowName::Number(id)))) = part.content
    else {
        return Ok(vec![part]);
    };
    let groups = export_subtitles::subtitle_tier_groups(connection, id)?;
    // A single group needs no language in its name.
    if groups.len() < 2 {
        return Ok(vec![part]);
    }
    let of = |group: Vec<TierRow>| FolderPart {
        name: match group.first() {
            Some(first) => format!("{}.{}", part.name, first.name),
            None => part.name.clone(),
        },
        content: FolderPartContent::Subtitles(id, group),
    };
    Ok(groups.into_iter().map(of).collect())
}

fn folder_part_of_token(connection: &Connection, id: i64, format: SingleFileFormat<'_>) -> CorpusResult<FolderPart> {
    let row = signs::load_token_row(connection, id)?;
    if let Some(recording) = row.recording_id.filter(|_| format.is_of_tiers()) {
        let name = row.recording.unwrap_or_default();
        return Ok(FolderPart::folder_part_of_recording(recording, &name));
    }
    Ok(FolderPart {
        name: row.gloss,
        content: FolderPartContent::What(ExportWhat::Address(CorpusAddress::Token(id))),
    })
}

fn folder_part_at_address(
    connection: &Connection,
    address: &CorpusAddress,
    format: SingleFileFormat<'_>,
) -> CorpusResult<FolderPart> {
    if let CorpusAddress::Recording(name) = address {
        let row = address::find_recording_by_name(connection, name)?;
        return Ok(FolderPart::folder_part_of_recording(row.id, &row.name));
    }
    let row = address::find_addressed_token(connection, address)?;
    folder_part_of_token(connection, row.id, format)
}
