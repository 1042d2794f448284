//! Exports several recordings or tokens at once, with a file for each of them in one folder.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use rusqlite::Connection;

use super::enriched::file_name;
use super::{ExportOptions, ExportReport, ExportWhat, Format, whole, write_file};
use crate::address::{self, Address, Name};
use crate::db::{recordings, signs};
use crate::error::{Error, Result};
use crate::progress::{Progress, Step, Unit};

/// Writes a file of `format` for each recording or token into the folder `to`, and creates the folder if it is missing.
pub(super) fn write(
    connection: &Connection,
    what: &ExportWhat,
    (format, extension): (Format, &str),
    to: &Path,
    options: &ExportOptions,
    progress: &mut Progress<'_>,
) -> Result<ExportReport> {
    let each = each(connection, what, format)?;
    if each.is_empty() {
        return Err(Error::wrong("there is nothing to write")
            .advise("name recordings or tokens, or a query that finds some"));
    }
    if to.is_file() {
        return Err(Error::file(to, std::io::ErrorKind::AlreadyExists.into()));
    }
    fs::create_dir_all(to).map_err(|error| Error::file(to, error))?;
    let mut taken = BTreeSet::new();
    let mut report = ExportReport::default();
    if format == Format::Glb {
        let path = to.join("annotations_to_markers.py");
        // The content of the script is always the same.
        let file = whole(&path, true, &mut |out| {
            let text = include_bytes!("annotations_to_markers.py");
            out.write_all(text)
                .map_err(|error| Error::wrong(format!("the script cannot be written: {error}")))
        })?;
        report.files.push(file);
        report.notes.push(
            "annotations_to_markers.py turns the annotations into markers of Blender's timeline"
                .to_owned(),
        );
    }
    for (done, (name, address)) in each.iter().enumerate() {
        let name = file_name(name, &mut taken);
        let path = to.join(format!("{name}.{extension}"));
        let one = ExportWhat::Address(address.clone());
        let mut notes = Vec::new();
        let file = whole(&path, options.force, &mut |out| {
            write_file(connection, &one, format, out, &mut notes, progress)
        })?;
        report.files.push(file);
        for note in notes {
            if !report.notes.contains(&note) {
                report.notes.push(note);
            }
        }
        progress.report(Step {
            task: "files",
            done: done as u64 + 1,
            total: Some(each.len() as u64),
            unit: Unit::Items,
        })?;
    }
    Ok(report)
}

/// Returns the recordings and tokens that get a file, with its name. In formats of tiers a token stands for its
/// recording.
fn each(
    connection: &Connection,
    what: &ExportWhat,
    format: Format,
) -> Result<Vec<(String, Address)>> {
    let recording = |id: i64, name: &str| (name.to_owned(), Address::Recording(Name::Number(id)));
    let token = |id: i64| -> Result<Option<(String, Address)>> {
        let row = signs::token(connection, id)?;
        Ok(match (format, row.recording_id) {
            (format, Some(id)) if format.is_of_tiers() => {
                let name = row.recording.unwrap_or_default();
                Some(recording(id, &name))
            }
            (Format::Notation(_) | Format::Table(_), None) | (_, Some(_)) => {
                Some((row.gloss, Address::Token(id)))
            }
            (_, None) => None,
        })
    };
    let mut all = Vec::new();
    match what {
        ExportWhat::All => {
            for row in recordings::recordings(connection)? {
                if recordings::body_track(connection, row.id)?.is_some() || format.is_of_tiers() {
                    all.push(recording(row.id, &row.name));
                }
            }
        }
        ExportWhat::Inventory(_) => {
            return Err(Error::wrong("an inventory is one file").advise("end its name in .json"));
        }
        ExportWhat::Tokens(ids) => {
            for id in ids {
                all.extend(token(*id)?);
            }
        }
        ExportWhat::Address(address) => all.push(named(connection, address, &token)?),
        ExportWhat::Several(addresses) => {
            for address in addresses {
                all.push(named(connection, address, &token)?);
            }
        }
    }
    let mut seen = BTreeSet::new();
    all.retain(|(_, address)| seen.insert(address.to_string()));
    Ok(all)
}

fn named(
    connection: &Connection,
    address: &Address,
    token: &dyn Fn(i64) -> Result<Option<(String, Address)>>,
) -> Result<(String, Address)> {
    if let Address::Recording(name) = address {
        let row = address::recording(connection, name)?;
        return Ok((row.name, Address::Recording(Name::Number(row.id))));
    }
    let row = address::token(connection, address)?;
    let found = token(row.id)?;
    found.ok_or_else(|| {
        Error::wrong(format!("{address} is without movement"))
            .at(address.to_string())
            .advise("name recordings, or tokens that were recorded")
    })
}
