//! Inventories from JSON.

use chereme_sign::Inventory;

use super::{FileReport, FileStatus, Job};
use crate::db::recordings::{self, SourceFileRow};
use crate::error::{Error, Result};
use crate::inventories;

pub(super) fn import(job: &mut Job<'_>) -> Result<FileReport> {
    if recordings::source_file_hashed(job.connection, &job.hash)?.is_some() {
        return Ok(FileReport::unchanged(job.path));
    }
    let bytes = job.bytes()?;
    let wrong = |message: String| {
        Error::wrong(message).advise(
            "an inventory is an object with id, component, version, names and values; \
             schema/inventory.schema.json describes it",
        )
    };
    let text = std::str::from_utf8(&bytes).map_err(|_| wrong("the file is not UTF-8".into()))?;
    let all = Inventory::all_from_json(text).map_err(|error| wrong(error.to_string()))?;
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    let known: Vec<&str> = job
        .inventories
        .iter()
        .map(|stored| stored.inventory.id.as_str())
        .collect();
    let new = all
        .iter()
        .filter(|inventory| !known.contains(&inventory.id.as_str()))
        .count();
    for inventory in &all {
        inventories::store(job.connection, inventory)?;
    }
    job.count("inventories", new);
    report.understand(
        "inventories",
        all.iter().map(|it| &it.id).collect::<Vec<_>>(),
    );
    let row = SourceFileRow {
        id: 0,
        recording_id: None,
        kind: "inventory".into(),
        name: job.file_name.clone(),
        hash: job.hash.clone(),
    };
    recordings::insert_source_file(job.connection, &row, Some(&bytes))?;
    Ok(report)
}
