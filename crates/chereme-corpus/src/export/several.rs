//! Exports several recordings or tokens at once, with a file for each of them in one folder.

use std::collections::BTreeSet;
use std::fs;
use std::io::Write;
use std::path::Path;

use rusqlite::Connection;

use super::enriched::file_name;
use super::{
    ExportOptions, ExportReport, ExportWhat, Format, LeftOut, Long, Unnamed, subtitles, tokens,
    write_file,
};
use crate::address::{self, Address, Name};
use crate::db::list;
use crate::db::tiers::{self, TierRow};
use crate::db::unfinished::remove_leftovers_in;
use crate::db::{recordings, signs};
use crate::error::{Error, Result};
use crate::progress::{Progress, Step, Unit};

/// The number of names that a note lists.
const SHOWN: usize = 12;

/// The contents of a file of the folder.
struct Part {
    /// The name of the recording, or the gloss of the token.
    name: String,
    content: Content,
}

enum Content {
    /// The same as an export of its own.
    What(ExportWhat),
    /// Tiers of a recording as subtitles.
    Subtitles(i64, Vec<TierRow>),
}

/// Writes a file of `format` for each recording or token into the folder `to`, and creates the folder if it is missing.
///
/// Those that hold nothing for the format are left out and listed. After any other failure the folder is as before.
pub(super) fn write(
    connection: &Connection,
    what: &ExportWhat,
    (format, extension): (Format, &str),
    to: &Path,
    options: &ExportOptions,
    progress: &mut Progress<'_>,
) -> Result<ExportReport> {
    let parts = parts(connection, what, format)?;
    if parts.is_empty() {
        return Err(Error::wrong("there is nothing to write")
            .advise("name recordings or tokens, or a query that finds some"));
    }
    if to.is_file() {
        return Err(Error::file(to, std::io::ErrorKind::AlreadyExists.into()));
    }
    let is_new = !to.exists();
    fs::create_dir_all(to).map_err(|error| Error::file(to, error))?;
    let ending = format!(".{extension}");
    remove_leftovers_in(to, |name| name.ends_with(&ending));
    let done = fill(
        connection,
        &parts,
        (format, extension),
        to,
        options,
        progress,
    );
    if done.is_err() && is_new {
        // Only an empty folder is removed, which a failed export leaves.
        let _ = fs::remove_dir(to);
    }
    done
}

fn fill(
    connection: &Connection,
    parts: &[Part],
    (format, extension): (Format, &str),
    to: &Path,
    options: &ExportOptions,
    progress: &mut Progress<'_>,
) -> Result<ExportReport> {
    let mut taken = BTreeSet::new();
    let mut report = ExportReport::default();
    let mut written = Vec::new();
    let mut first_lack = None;
    for (done, part) in parts.iter().enumerate() {
        let mut notes = Vec::new();
        let mut own = taken.clone();
        let name = file_name(&part.name, &mut own);
        let path = to.join(format!("{name}.{extension}"));
        let file = Unnamed::write(&path, options.force, &mut |out| {
            part.write(connection, format, out, &mut notes, progress)
        });
        match file {
            Ok(file) => {
                taken = own;
                written.push(file);
                for note in notes {
                    if !report.notes.contains(&note) {
                        report.notes.push(note);
                    }
                }
            }
            Err(error) if error.is_lack() => {
                report.left_out.push(LeftOut {
                    name: part.name.clone(),
                    why: error.to_string(),
                });
                first_lack.get_or_insert(error);
            }
            Err(error) => return Err(of_part(&part.name, error)),
        }
        progress.report(Step {
            task: "files",
            done: done as u64 + 1,
            total: Some(parts.len() as u64),
            unit: Unit::Items,
        })?;
    }
    if let Some(error) = first_lack {
        if written.is_empty() {
            return Err(all_lack(error, parts.len(), extension));
        }
        report
            .notes
            .push(left_out(&report.left_out, parts.len(), extension));
    }
    if format == Format::Glb {
        let script = script(&to.join("annotations_to_markers.py"))?;
        written.insert(0, script);
        let note =
            "annotations_to_markers.py turns the annotations into markers of Blender's timeline";
        report.notes.insert(0, note.to_owned());
    }
    for file in written {
        report.files.push(file.name()?);
    }
    Ok(report)
}

/// Writes the script for Blender, whose content is always the same.
fn script(path: &Path) -> Result<Unnamed> {
    Unnamed::write(path, true, &mut |out| {
        let text = include_bytes!("annotations_to_markers.py");
        out.write_all(text)
            .map_err(|error| Error::wrong(format!("the script cannot be written: {error}")))
    })
}

/// Returns the note on those without a file.
fn left_out(all: &[LeftOut], of: usize, extension: &str) -> String {
    let names = all.iter().take(SHOWN).map(|it| format!("{:?}", it.name));
    let names = names.collect::<Vec<_>>().join(", ");
    let more = match all.len().checked_sub(SHOWN) {
        Some(more) if more > 0 => format!(" and {more} more"),
        _ => String::new(),
    };
    format!(
        "without what .{extension} holds, and left out: {} of {of}: {names}{more}",
        all.len()
    )
}

/// Returns the error if nothing can be written, as `first` says of the first of them.
fn all_lack(first: Error, count: usize, extension: &str) -> Error {
    if count == 1 {
        return first;
    }
    let message = format!("none of the {count} can be written as .{extension}; the first: {first}");
    match first.remedy() {
        Some(remedy) => Error::wrong(message).advise(remedy),
        None => Error::wrong(message),
    }
}

/// Returns the error of a recording or token, with its name.
fn of_part(name: &str, error: Error) -> Error {
    match error {
        Error::Wrong { ref message, .. } if !message.contains(name) => {
            let named =
                Error::wrong(format!("the file of {name:?} cannot be written: {message}")).at(name);
            match error.remedy() {
                Some(remedy) => named.advise(remedy),
                None => named,
            }
        }
        Error::Damaged { place, reason } => Error::Damaged {
            place: format!("{place} of {name:?}"),
            reason,
        },
        other => other,
    }
}

impl Part {
    fn of_recording(id: i64, name: &str) -> Self {
        Self {
            name: name.to_owned(),
            content: Content::What(ExportWhat::Address(Address::Recording(Name::Number(id)))),
        }
    }

    fn write(
        &self,
        connection: &Connection,
        format: Format,
        out: &mut dyn Write,
        notes: &mut Vec<String>,
        progress: &mut Progress<'_>,
    ) -> Result<()> {
        match (&self.content, format) {
            (Content::Subtitles(recording, rows), Format::Subtitles(form)) => {
                let recording = recordings::recording(connection, *recording)?;
                subtitles::write(connection, &recording, rows, form, out)
            }
            (Content::Subtitles(..), _) => Ok(()),
            (Content::What(what), format) => {
                self.holds_rows(connection, what, format)?;
                write_file(connection, what, format, out, notes, progress)
            }
        }
    }

    /// Fails if the table of a recording would have no rows.
    fn holds_rows(&self, connection: &Connection, what: &ExportWhat, format: Format) -> Result<()> {
        let ExportWhat::Address(Address::Recording(Name::Number(id))) = what else {
            return Ok(());
        };
        let (holds, what) = match format {
            Format::Table(_) | Format::Parquet(Long::Tokens | Long::Components) => {
                (!tokens(connection, what)?.is_empty(), "tokens")
            }
            Format::Parquet(Long::Annotations) => {
                (!tiers::tiers(connection, *id)?.is_empty(), "tiers")
            }
            Format::Parquet(Long::Frames) => (
                recordings::body_track(connection, *id)?.is_some(),
                "movement",
            ),
            _ => return Ok(()),
        };
        match holds {
            true => Ok(()),
            false => Err(
                Error::wrong(format!("the recording {:?} has no {what}", self.name))
                    .advise("name recordings that have some, or another format")
                    .lacking(),
            ),
        }
    }
}

/// Returns the files of the folder. In formats of tiers a token stands for its recording.
fn parts(connection: &Connection, what: &ExportWhat, format: Format) -> Result<Vec<Part>> {
    let mut all = Vec::new();
    match what {
        ExportWhat::All => {
            for row in recordings::recordings(connection)? {
                all.push(Part::of_recording(row.id, &row.name));
            }
            all.extend(lexicon(connection, format)?);
        }
        ExportWhat::Inventory(_) => {
            return Err(Error::wrong("an inventory is one file").advise("end its name in .json"));
        }
        ExportWhat::Tokens(ids) => {
            for id in ids {
                all.push(of_token(connection, *id, format)?);
            }
        }
        ExportWhat::Address(address) => all.push(named(connection, address, format)?),
        ExportWhat::Several(addresses) => {
            for address in addresses {
                all.push(named(connection, address, format)?);
            }
        }
    }
    let mut seen = BTreeSet::new();
    all.retain(|part| match &part.content {
        Content::What(ExportWhat::Address(address)) => seen.insert(address.to_string()),
        _ => true,
    });
    match format {
        Format::Subtitles(_) => {
            let each = all.into_iter().map(|part| languages(connection, part));
            let each = each.collect::<Result<Vec<_>>>()?;
            Ok(each.into_iter().flatten().collect())
        }
        _ => Ok(all),
    }
}

/// Returns the files of the tokens that are in no recording, in formats that hold those: one table for all, and a
/// notation for each.
fn lexicon(connection: &Connection, format: Format) -> Result<Vec<Part>> {
    let is_table = matches!(
        format,
        Format::Table(_) | Format::Parquet(Long::Tokens | Long::Components)
    );
    if !is_table && !matches!(format, Format::Notation(_)) {
        return Ok(Vec::new());
    }
    let ids = list::token_ids(connection)?;
    let mut entries = Vec::new();
    for ids in ids.chunks(signs::AT_ONCE) {
        let rows = signs::tokens(connection, ids)?;
        let free = ids.iter().filter_map(|id| rows.get(id));
        let free = free.filter(|row| row.recording_id.is_none());
        entries.extend(free.map(|row| (row.id, row.gloss.clone())));
    }
    if entries.is_empty() {
        return Ok(Vec::new());
    }
    if is_table {
        let ids = entries.into_iter().map(|(id, _)| id).collect();
        return Ok(vec![Part {
            name: "lexicon".to_owned(),
            content: Content::What(ExportWhat::Tokens(ids)),
        }]);
    }
    let part = |(id, gloss)| Part {
        name: gloss,
        content: Content::What(ExportWhat::Address(Address::Token(id))),
    };
    Ok(entries.into_iter().map(part).collect())
}

/// Returns a file of subtitles for each language of a recording.
fn languages(connection: &Connection, part: Part) -> Result<Vec<Part>> {
    let Content::What(ExportWhat::Address(Address::Recording(Name::Number(id)))) = part.content
    else {
        return Ok(vec![part]);
    };
    let groups = subtitles::groups(connection, id)?;
    if groups.len() < 2 {
        return Ok(vec![part]);
    }
    let of = |group: Vec<TierRow>| Part {
        name: match group.first() {
            Some(first) => format!("{}.{}", part.name, first.name),
            None => part.name.clone(),
        },
        content: Content::Subtitles(id, group),
    };
    Ok(groups.into_iter().map(of).collect())
}

fn of_token(connection: &Connection, id: i64, format: Format) -> Result<Part> {
    let row = signs::token(connection, id)?;
    if let Some(recording) = row.recording_id.filter(|_| format.is_of_tiers()) {
        let name = row.recording.unwrap_or_default();
        return Ok(Part::of_recording(recording, &name));
    }
    Ok(Part {
        name: row.gloss,
        content: Content::What(ExportWhat::Address(Address::Token(id))),
    })
}

fn named(connection: &Connection, address: &Address, format: Format) -> Result<Part> {
    if let Address::Recording(name) = address {
        let row = address::recording(connection, name)?;
        return Ok(Part::of_recording(row.id, &row.name));
    }
    let row = address::token(connection, address)?;
    of_token(connection, row.id, format)
}
