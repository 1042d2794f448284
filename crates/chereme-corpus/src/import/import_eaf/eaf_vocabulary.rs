//! Converts the vocabularies of component tiers in a file to inventories.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::eaf::eaf_convert::{AnnotationTranscript, ControlledVocabulary, TranscriptTier, VocabularyEntry};
use chereme_formats::roles::TierGuess;
use chereme_sign::text::fold_text;
use chereme_sign::{ComponentInventory, InventoryValue, SignComponent, TierRole, inventory};

use super::{FileReport, ImportJob};
use crate::db::stored_columns::ValueState;
use crate::error::CorpusResult;
use crate::inventories::{self, StoredInventory};
use crate::report_finding::ReportFinding;

/// Returns the inventory of a component tier: its vocabulary, or one of the corpus that has all its values.
pub(in crate::import) fn tier_inventory(
    job: &mut ImportJob<'_>,
    transcript: &AnnotationTranscript,
    tier: &TranscriptTier,
    guess: &TierGuess,
    report: &mut FileReport,
) -> CorpusResult<Option<i64>> {
    let Some(TierRole::Component { component, feature }) = &guess.role else {
        return Ok(None);
    };
    let used: BTreeSet<&str> = tier
        .annotations
        .iter()
        .map(|annotation| annotation.value.trim())
        // Markers for missing values are no values that an inventory must have.
        .filter(|value| ValueState::of_file_text(value) == ValueState::Value)
        .collect();
    let fits = |stored: &&StoredInventory| {
        let it = &stored.inventory;
        it.component == *component && it.feature == *feature && it.distinguishes_texts(used.iter().copied())
    };
    let vocabulary = tier.vocabulary.as_ref().and_then(|id| {
        transcript
            .vocabularies
            .iter()
            .find(|candidate| candidate.id == *id && !candidate.entries.is_empty())
    });
    let builtin = |stored: &&StoredInventory| inventory::builtin_by_id(&stored.inventory.id).is_some();
    let listed = |stored: &&StoredInventory| {
        vocabulary.is_none_or(|vocabulary| stored.inventory.distinguishes_texts(entry_ids(vocabulary)))
    };
    let known_inventory = job
        .inventories
        .iter()
        .filter(builtin)
        .find(|candidate| fits(candidate) && listed(candidate));
    // An empty tier without a vocabulary would fit any inventory.
    if let Some(known) = known_inventory.filter(|_| vocabulary.is_some() || !used.is_empty()) {
        return Ok(Some(known.id));
    }
    match vocabulary {
        Some(vocabulary) => {
            let (inventory, dropped) = of_vocabulary(vocabulary, *component, feature.clone());
            for entry in dropped {
                report.findings.push(ReportFinding::finding_note(format!(
                    "the vocabulary {:?} has {entry:?} twice; the second stays text",
                    vocabulary.id
                )));
            }
            let mut stored = job.inventories.iter().map(|row| &row.inventory);
            let before = stored.find(|candidate| candidate.id == inventory.id);
            let new = before.is_none();
            let inventory = inventories::join_stored_inventory(before, inventory);
            let id = inventories::store_inventory(job.connection, &inventory)?;
            job.count_created_rows("inventories", usize::from(new));
            // The next tiers of the file may use the same vocabulary.
            job.inventories = inventories::load_all_inventories(job.connection)?.into();
            Ok(Some(id))
        }
        None if used.is_empty() => Ok(None),
        None => Ok(job.inventories.iter().find(fits).map(|stored| stored.id)),
    }
}

fn entry_ids(vocabulary: &ControlledVocabulary) -> Vec<&str> {
    let first = |entry: &VocabularyEntry| -> Option<usize> { (!entry.values.is_empty()).then_some(0) };
    vocabulary
        .entries
        .iter()
        .filter_map(|entry| first(entry).map(|at| entry.values[at].value.trim()))
        .filter(|value| !value.is_empty())
        .collect()
}

fn of_vocabulary(
    vocabulary: &ControlledVocabulary,
    component: SignComponent,
    feature: Option<String>,
) -> (ComponentInventory, Vec<String>) {
    let (mut dropped, mut values) = (Vec::new(), Vec::new());
    let (mut ids, mut seen) = (BTreeSet::new(), BTreeSet::new());
    let first = |entry: &VocabularyEntry| entry.values.first().map(|value| fold_text(value.value.trim()));
    let folded: BTreeSet<String> = vocabulary.entries.iter().filter_map(first).collect();
    for entry in &vocabulary.entries {
        let Some(id) = entry.values.first().map(|value| value.value.trim().to_owned()) else {
            continue;
        };
        // A text that means two values could not be distinguished in annotations.
        if id.is_empty() || seen.contains(&fold_text(&id)) || !ids.insert(id.clone()) {
            dropped.push(id);
            continue;
        }
        let mut names = BTreeMap::new();
        for value in &entry.values {
            let text = value.value.trim();
            let is_id = fold_text(text) == fold_text(&id);
            // A name that is the id of another value would make that value ambiguous.
            if !text.is_empty()
                && !value.language.is_empty()
                && (is_id || (!folded.contains(&fold_text(text)) && seen.insert(fold_text(text))))
            {
                names.insert(value.language.clone(), text.to_owned());
            }
        }
        let note_values = entry.values.iter().find_map(|value| value.description.clone());
        let notes = note_values.filter(|text| !text.trim().is_empty());
        values.push(InventoryValue {
            id,
            names,
            notes,
            ..InventoryValue::default()
        });
    }
    let feature_name = feature.as_ref().map_or(String::new(), |feature| format!(".{feature}"));
    let inventory = ComponentInventory {
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
