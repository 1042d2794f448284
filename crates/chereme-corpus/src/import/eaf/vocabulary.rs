//! Converts the vocabularies of component tiers in a file to inventories.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::eaf::convert::{Tier, Transcript, Vocabulary, VocabularyEntry};
use chereme_formats::roles::TierGuess;
use chereme_sign::text::fold;
use chereme_sign::{Component, Inventory, InventoryValue, TierRole, inventory};

use super::{FileReport, Job};
use crate::db::columns::ValueState;
use crate::error::Result;
use crate::import::report::ReportFinding;
use crate::inventories::{self, StoredInventory};

/// Returns the inventory of a component tier: its vocabulary, or one of the corpus that has all its values.
pub(in crate::import) fn tier_inventory(
    job: &mut Job<'_>,
    transcript: &Transcript,
    tier: &Tier,
    guess: &TierGuess,
    report: &mut FileReport,
) -> Result<Option<i64>> {
    let Some(TierRole::Component { component, feature }) = &guess.role else {
        return Ok(None);
    };
    let used: BTreeSet<&str> = tier
        .annotations
        .iter()
        .map(|annotation| annotation.value.trim())
        .filter(|value| ValueState::of_file_text(value) == ValueState::Value)
        .collect();
    let fits = |stored: &&StoredInventory| {
        let it = &stored.inventory;
        it.component == *component
            && it.feature == *feature
            && it.distinguishes(used.iter().copied())
    };
    let vocabulary = tier.vocabulary.as_ref().and_then(|id| {
        transcript
            .vocabularies
            .iter()
            .find(|it| it.id == *id && !it.entries.is_empty())
    });
    let builtin =
        |stored: &&StoredInventory| inventory::builtin_by_id(&stored.inventory.id).is_some();
    let listed = |stored: &&StoredInventory| {
        vocabulary.is_none_or(|it| stored.inventory.distinguishes(entry_ids(it)))
    };
    let known = job
        .inventories
        .iter()
        .filter(builtin)
        .find(|it| fits(it) && listed(it));
    if let Some(known) = known.filter(|_| vocabulary.is_some() || !used.is_empty()) {
        return Ok(Some(known.id));
    }
    match vocabulary {
        Some(vocabulary) => {
            let (inventory, dropped) = of_vocabulary(vocabulary, *component, feature.clone());
            for entry in dropped {
                report.findings.push(ReportFinding::note(format!(
                    "the vocabulary {:?} has {entry:?} twice; the second stays text",
                    vocabulary.id
                )));
            }
            let mut stored = job.inventories.iter().map(|it| &it.inventory);
            let before = stored.find(|it| it.id == inventory.id);
            let new = before.is_none();
            let inventory = inventories::joined(before, inventory);
            let id = inventories::store(job.connection, &inventory)?;
            job.count("inventories", usize::from(new));
            job.inventories = inventories::load(job.connection)?.into();
            Ok(Some(id))
        }
        None if used.is_empty() => Ok(None),
        None => Ok(job.inventories.iter().find(fits).map(|stored| stored.id)),
    }
}

fn entry_ids(vocabulary: &Vocabulary) -> Vec<&str> {
    let first =
        |entry: &VocabularyEntry| -> Option<usize> { (!entry.values.is_empty()).then_some(0) };
    vocabulary
        .entries
        .iter()
        .filter_map(|entry| first(entry).map(|at| entry.values[at].value.trim()))
        .filter(|value| !value.is_empty())
        .collect()
}

fn of_vocabulary(
    vocabulary: &Vocabulary,
    component: Component,
    feature: Option<String>,
) -> (Inventory, Vec<String>) {
    let (mut dropped, mut values) = (Vec::new(), Vec::new());
    let (mut ids, mut seen) = (BTreeSet::new(), BTreeSet::new());
    let first =
        |entry: &VocabularyEntry| entry.values.first().map(|value| fold(value.value.trim()));
    let folded: BTreeSet<String> = vocabulary.entries.iter().filter_map(first).collect();
    for entry in &vocabulary.entries {
        let Some(id) = entry
            .values
            .first()
            .map(|value| value.value.trim().to_owned())
        else {
            continue;
        };
        if id.is_empty() || seen.contains(&fold(&id)) || !ids.insert(id.clone()) {
            dropped.push(id);
            continue;
        }
        let mut names = BTreeMap::new();
        for value in &entry.values {
            let text = value.value.trim();
            let own = fold(text) == fold(&id);
            if !text.is_empty()
                && !value.language.is_empty()
                && (own || (!folded.contains(&fold(text)) && seen.insert(fold(text))))
            {
                names.insert(value.language.clone(), text.to_owned());
            }
        }
        let notes = entry
            .values
            .iter()
            .find_map(|value| value.description.clone());
        let notes = notes.filter(|text| !text.trim().is_empty());
        values.push(InventoryValue {
            id,
            names,
            notes,
            ..InventoryValue::default()
        });
    }
    let feature_name = feature
        .as_ref()
        .map_or(String::new(), |feature| format!(".{feature}"));
    let inventory = Inventory {
        id: format!("{}/{component}{feature_name}", vocabulary.id),
        component,
        feature,
        version: 1,
        language: None,
        names: BTreeMap::from([("en".to_owned(), vocabulary.id.clone())]),
        description: vocabulary
            .descriptions
            .iter()
            .map(|(_, text)| text.trim())
            .find(|text| !text.is_empty())
            .unwrap_or_default()
            .to_owned(),
        values,
    };
    (inventory, dropped)
}
