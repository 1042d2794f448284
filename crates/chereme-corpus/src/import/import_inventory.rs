//! Imports inventories from JSON; JSON that holds signs is imported as a lexicon.

use chereme_formats::table::TableError;
use chereme_formats::{hns, lexicon};
use chereme_sign::ComponentInventory;
use serde_json::Value;

use super::{FileReport, FileStatus, ImportJob};
use crate::error::{CorpusError, CorpusResult};
use crate::inventories;
use crate::progress::ProgressReceiver;

pub(super) fn import_inventory(
    job: &mut ImportJob<'_>,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<FileReport> {
    if let Some(report) = job.report_unchanged_file() {
        return Ok(report);
    }
    let bytes = job.read_job_bytes()?;
    let wrong = |message: String| {
        CorpusError::from_wrong_message(message).with_advice(
            "an inventory is an object with id, component, version, names and values; \
             schema/inventory.schema.json describes it; a lexicon is an array of objects with gloss and hamnosys",
        )
    };
    let text = std::str::from_utf8(&bytes).map_err(|_| wrong("the file is not UTF-8".into()))?;
    // JSON is also a form of lexicons, so what is no inventory may still hold signs.
    let all = match ComponentInventory::all_from_json(text) {
        Ok(all) => all,
        Err(error) => {
            let signs = holds_signs(job, text);
            if let Ok(true) = signs {
                job.kind = "lexicon";
                return super::lexicon::import_lexicon(job, progress);
            }
            let wrong = match signs {
                // A wrong line of JSON Lines is reported as such, not as a faulty inventory.
                Err(lines @ TableError::JsonLines { .. }) => CorpusError::from_wrong_message(lines.to_string())
                    .with_advice("write an object with a gloss on each line, or one array of such objects"),
                _ => wrong(error.to_string()),
            };
            // Folders often hold JSON of other programs, which is no fault unless the user named the file.
            return if !job.named && is_other(text) {
                let other = CorpusError::from_wrong_message("it holds no inventory and no signs")
                    .with_advice(wrong.error_remedy().unwrap_or_default());
                Ok(FileReport::skipped_file_report(job.path, &other))
            } else {
                Err(wrong)
            };
        }
    };
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    let before = |inventory: &ComponentInventory| {
        let mut stored = job.inventories.iter().map(|stored| &stored.inventory);
        stored.find(|candidate| candidate.id == inventory.id).cloned()
    };
    // Storing joins them with the new values, so the old ones are read before.
    let earlier: Vec<Option<ComponentInventory>> = all.iter().map(before).collect();
    let new = earlier.iter().filter(|inventory| inventory.is_none()).count();
    for inventory in &all {
        inventories::store_inventory(job.connection, inventory)?;
    }
    // Existing values remain, so the old and new values together may be refused.
    let loaded = inventories::load_all_inventories(job.connection).map_err(|error| match error {
        CorpusError::Damaged { reason, .. } => {
            CorpusError::from_wrong_message(format!("with the values that the corpus has of it already: {reason}"))
                .with_advice("keep the ids of values, or give the inventory an id of its own")
        }
        other => other,
    })?;
    let now = |old: &ComponentInventory| loaded.iter().any(|stored| stored.inventory == *old);
    let changed = earlier.iter().flatten().filter(|old| !now(old)).count();
    job.count_created_rows("inventories", new);
    job.counts.count_changed_rows("inventories", changed);
    report.understood.inventories = Some(all.iter().map(|inventory| inventory.id.clone()).collect());
    job.keep_source_file(None, Some(&bytes))?;
    Ok(report)
}

/// Reports whether a text holds signs with notation or codings; one that begins as JSON is never read as a table.
fn holds_signs(job: &ImportJob<'_>, text: &str) -> std::result::Result<bool, TableError> {
    let notated = |text: &String| hns::holds_some(text.as_bytes());
    let (bytes, mapping) = (text.as_bytes(), &job.options.mapping);
    // Some editors put a byte order mark before the first bracket.
    let plain = text.trim_start_matches('\u{feff}').trim_start();
    let read = match plain.starts_with(['{', '[']) {
        true => lexicon::read_json(bytes, mapping)?,
        false => Some(lexicon::read_lexicon(bytes, mapping)?),
    };
    Ok(read.is_some_and(|(lexicon, _)| {
        let mut signs = lexicon.entries.iter();
        signs.any(|sign| sign.notation.as_ref().is_some_and(notated) || !sign.codings.is_empty())
    }))
}

/// Reports whether a text is valid JSON, or JSON Lines, without signs of being meant as an inventory.
fn is_other(text: &str) -> bool {
    let inventory = |value: &Value| value.get("values").is_some() || value.get("component").is_some();
    let mut values = serde_json::Deserializer::from_str(text).into_iter::<Value>();
    values.all(|value| match value {
        Ok(Value::Array(all)) => !all.iter().any(inventory),
        Ok(other) => !inventory(&other),
        Err(_) => false,
    })
}
