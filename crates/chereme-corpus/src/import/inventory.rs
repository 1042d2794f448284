//! Imports inventories from JSON; JSON that holds signs is imported as a lexicon.

use chereme_formats::table::TableError;
use chereme_formats::{hns, lexicon};
use chereme_sign::Inventory;
use serde_json::Value;

use super::{FileReport, FileStatus, Job};
use crate::error::{Error, Result};
use crate::inventories;
use crate::progress::Progress;

pub(super) fn import(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    if let Some(report) = job.unchanged() {
        return Ok(report);
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
        Err(error) => {
            let signs = holds_signs(job, text);
            if let Ok(true) = signs {
                job.kind = "lexicon";
                return super::lexicon::import(job, progress);
            }
            let wrong = match signs {
                Err(lines @ TableError::JsonLines { .. }) => Error::wrong(lines.to_string())
                    .advise(
                        "write an object with a gloss on each line, or one array of such objects",
                    ),
                _ => wrong(error.to_string()),
            };
            return if !job.named && is_other(text) {
                let other = Error::wrong("it holds no inventory and no signs")
                    .advise(wrong.remedy().unwrap_or_default());
                Ok(FileReport::skipped(job.path, &other))
            } else {
                Err(wrong)
            };
        }
    };
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    let before = |inventory: &Inventory| {
        let mut stored = job.inventories.iter().map(|stored| &stored.inventory);
        stored.find(|it| it.id == inventory.id).cloned()
    };
    let earlier: Vec<Option<Inventory>> = all.iter().map(before).collect();
    let new = earlier.iter().filter(|it| it.is_none()).count();
    for inventory in &all {
        inventories::store(job.connection, inventory)?;
    }
    // Existing values remain, so the old and new values together may be refused.
    let now = inventories::load(job.connection).map_err(|error| match error {
        Error::Damaged { reason, .. } => Error::wrong(format!(
            "with the values that the corpus has of it already: {reason}"
        ))
        .advise("keep the ids of values, or give the inventory an id of its own"),
        other => other,
    })?;
    let now = |old: &Inventory| now.iter().any(|stored| stored.inventory == *old);
    let changed = earlier.iter().flatten().filter(|old| !now(old)).count();
    job.count("inventories", new);
    job.counts.changed("inventories", changed);
    report.understood.inventories = Some(all.iter().map(|it| it.id.clone()).collect());
    job.keep(None, Some(&bytes))?;
    Ok(report)
}

/// Reports whether a text holds signs with notation or codings; one that begins as JSON is never read as a table.
fn holds_signs(job: &Job<'_>, text: &str) -> std::result::Result<bool, TableError> {
    let notated = |text: &String| hns::holds_some(text.as_bytes());
    let (bytes, mapping) = (text.as_bytes(), &job.options.mapping);
    let plain = text.trim_start_matches('\u{feff}').trim_start();
    let read = match plain.starts_with(['{', '[']) {
        true => lexicon::read_json(bytes, mapping)?,
        false => Some(lexicon::read(bytes, mapping)?),
    };
    Ok(read.is_some_and(|(lexicon, _)| {
        let mut signs = lexicon.entries.iter();
        signs.any(|sign| sign.notation.as_ref().is_some_and(notated) || !sign.codings.is_empty())
    }))
}

/// Reports whether a text is valid JSON, or JSON Lines, without signs of being meant as an inventory.
fn is_other(text: &str) -> bool {
    let inventory =
        |value: &Value| value.get("values").is_some() || value.get("component").is_some();
    let mut values = serde_json::Deserializer::from_str(text).into_iter::<Value>();
    values.all(|value| match value {
        Ok(Value::Array(all)) => !all.iter().any(inventory),
        Ok(other) => !inventory(&other),
        Err(_) => false,
    })
}
