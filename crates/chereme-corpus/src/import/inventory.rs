//! Inventories from JSON; JSON of signs is a lexicon.

use chereme_formats::lexicon;
use chereme_sign::Inventory;

use super::{FileReport, FileStatus, Job};
use crate::db::recordings;
use crate::error::{Error, Result};
use crate::inventories;
use crate::progress::Progress;

pub(super) fn import(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    if recordings::source_file_hashed(job.connection, &job.hash)?.is_some() {
        return Ok(FileReport::unchanged(job.path));
    }
    let bytes = job.bytes()?;
    let wrong = |message: String| {
        Error::wrong(message).advise(
            "an inventory is an object with id, component, version, names and values; \
             schema/inventory.schema.json describes it; a lexicon is an array of objects with gloss and hamnosys",
        )
    };
    let text = std::str::from_utf8(&bytes).map_err(|_| wrong("the file is not UTF-8".into()))?;
    let all = match Inventory::all_from_json(text) {
        Ok(all) => all,
        Err(_) if holds_signs(job, &bytes) => {
            job.kind = "lexicon";
            return super::lexicon::import(job, progress);
        }
        Err(error) => return Err(wrong(error.to_string())),
    };
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
    // Values that were there before stay, so that both together may be none.
    inventories::load(job.connection).map_err(|error| match error {
        Error::Damaged { reason, .. } => Error::wrong(format!(
            "with the values that the corpus has of it already: {reason}"
        ))
        .advise("keep the ids of values, or give the inventory an id of its own"),
        other => other,
    })?;
    job.count("inventories", new);
    report.understand(
        "inventories",
        all.iter().map(|it| &it.id).collect::<Vec<_>>(),
    );
    job.keep(None, Some(&bytes))?;
    Ok(report)
}

/// Tells whether JSON holds signs with notation or codings.
fn holds_signs(job: &Job<'_>, bytes: &[u8]) -> bool {
    let read = lexicon::read(bytes, &job.options.mapping);
    read.is_ok_and(|(lexicon, _)| {
        let mut signs = lexicon.entries.iter();
        signs.any(|sign| sign.notation.is_some() || !sign.codings.is_empty())
    })
}
