//! Adding and merging values of inventories.

mod equate;

use chereme_sign::text::{did_you_mean, fold_text, nearest_candidate};
use chereme_sign::{ComponentInventory, InventoryValue};
use rusqlite::Connection;
use serde::Serialize;

use crate::Corpus;
use crate::db::stored_inventories as rows;
use crate::error::{CorpusError, CorpusResult};
use crate::inventories::{self, StoredInventory};
use crate::tokens;
use crate::words::effect::OperationEffect;

pub use equate::EqualProposal;

/// The result of a merge of values.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct MergedValues {
    /// The remaining value.
    pub value: String,
    /// The number of annotations that had the other value.
    pub annotations: u64,
    /// The number of lexicon entries that had the other value.
    pub entries: u64,
}

impl Corpus {
    /// Returns the key of the inventory with this key, or with this name in any language.
    ///
    /// # Errors
    /// Fails if there is no such inventory, or several have this name and none the key.
    pub fn inventory_key(&self, name: &str) -> CorpusResult<String> {
        Ok(find_stored_inventory(self.store.read_connection(), name)?.inventory.id)
    }

    /// Adds a value to an inventory, as one operation; tokens whose tiers use the value are derived again.
    ///
    /// # Errors
    /// Fails if the inventory does not exist or has the value already, or if one of the value's spellings means another
    /// value.
    pub fn add_value(&mut self, inventory: &str, value: &InventoryValue) -> CorpusResult<()> {
        self.store.run_store_operation(|connection| {
            let stored = find_stored_inventory(connection, inventory)?;
            let value = InventoryValue {
                id: value.id.trim().to_owned(),
                ..value.clone()
            };
            if value.id.is_empty() {
                return Err(CorpusError::from_wrong_message("a value needs a name"));
            }
            if stored.inventory.value_by_id(&value.id).is_some() {
                let wrong = format!("{:?} has the value {:?} already", stored.inventory.id, value.id);
                return Err(CorpusError::from_wrong_message(wrong)
                    .with_error_place(&value.id)
                    .with_command_advice("`chereme list CORPUS values` lists the values"));
            }
            let effect = OperationEffect::AddValue {
                value: value.id.clone(),
                inventory: stored.inventory.id.clone(),
            };
            let mut changed_inventory = stored.inventory;
            changed_inventory.values.push(value);
            // Two values that share a spelling could not be distinguished in annotations.
            changed_inventory.check_inventory().map_err(|error| {
                CorpusError::from_wrong_message(error.to_string())
                    .with_advice("give the value spellings that no other one has")
            })?;
            inventories::store_inventory(connection, &changed_inventory)?;
            rederive_inventory_tokens(connection, stored.id)?;
            Ok(((), effect))
        })
    }

    /// Merges two values, as one operation: `into` replaces `from` everywhere, and the spellings of `from` become
    /// further spellings of `into`, so that importing a table again has the same effect.
    ///
    /// # Errors
    /// Fails if the inventory or a value does not exist.
    pub fn merge_values(&mut self, inventory: &str, from: &str, into: &str) -> CorpusResult<MergedValues> {
        self.store.run_store_operation(|connection| {
            let stored = find_stored_inventory(connection, inventory)?;
            let gone = require_inventory_value(&stored.inventory, from)?.clone();
            let left = require_inventory_value(&stored.inventory, into)?.id.clone();
            if gone.id == left {
                let wrong = format!("{from:?} and {into:?} are one value already, {left:?}");
                return Err(CorpusError::from_wrong_message(wrong).with_error_place(from));
            }
            let mut annotations = 0;
            for text in rows::list_inventory_tier_values(connection, stored.id)? {
                // Annotations may have the value in any of its spellings.
                let matched_value = stored.inventory.find_inventory_value(text.trim());
                if matched_value.is_some_and(|value| value.id == gone.id) {
                    annotations += rows::replace_inventory_tier_value(connection, stored.id, &text, &left)?;
                }
            }
            let entries = rows::replace_lexicon_value(connection, stored.id, &gone.id, &left)?;
            rows::pass_same_as(connection, &stored.inventory.id, [&gone.id, &left])?;
            rows::delete_value(connection, stored.id, &gone.id)?;
            inventories::store_inventory(connection, &merge_inventory_value(&stored.inventory, &gone, &left))?;
            rederive_inventory_tokens(connection, stored.id)?;
            let effect = OperationEffect::MergeValues {
                value: gone.id,
                into: left.clone(),
                inventory: stored.inventory.id,
            };
            let done = MergedValues {
                value: left,
                annotations,
                entries,
            };
            Ok((done, effect))
        })
    }
}

/// Returns an inventory without the value `gone`; its spellings and narrower values pass to the value `left`.
fn merge_inventory_value(inventory: &ComponentInventory, gone: &InventoryValue, left: &str) -> ComponentInventory {
    let mut merged_inventory = inventory.clone();
    merged_inventory.values.retain(|value| value.id != gone.id);
    for value in &mut merged_inventory.values {
        if value.broader.as_deref() == Some(&gone.id) {
            value.broader = match value.id == left {
                // A value cannot lie below itself, so it takes the place of the one that goes.
                true => gone.broader.clone().filter(|broader| broader != left),
                false => Some(left.to_owned()),
            };
        }
        if value.id == left {
            let spelt: Vec<String> = value.value_spellings().map(str::to_owned).collect();
            let new = gone
                .value_spellings()
                .filter(|text| !spelt.iter().any(|own| own == text));
            value.aliases.extend(new.map(str::to_owned));
        }
    }
    merged_inventory
}

/// Returns the inventory of that name.
pub(crate) fn find_stored_inventory(connection: &Connection, name: &str) -> CorpusResult<StoredInventory> {
    let all = inventories::load_all_inventories(connection)?;
    let ids: Vec<String> = all.iter().map(|stored| stored.inventory.id.clone()).collect();
    let name = name.trim();
    let keyed = all.iter().position(|stored| stored.inventory.id == name);
    let called = || {
        let is = |stored: &StoredInventory| {
            let mut names = stored.inventory.names.values();
            names.any(|own| fold_text(own) == fold_text(name))
        };
        let mut matching = all.iter().enumerate().filter(|(_, it)| is(it));
        let (at, _) = matching.next()?;
        // A name that two inventories have says nothing about which one is meant.
        matching.next().is_none().then_some(at)
    };
    let inventory_index = keyed.or_else(called);
    let matched_inventory = inventory_index.and_then(|at| all.into_iter().nth(at));
    matched_inventory.ok_or_else(|| {
        let suggestion = did_you_mean(nearest_candidate(name, ids.iter().map(String::as_str)));
        CorpusError::from_wrong_message(format!("there is no inventory {name:?}{suggestion}"))
            .with_error_place(name)
            .with_command_advice("`chereme list CORPUS inventories` lists them")
    })
}

fn require_inventory_value<'i>(inventory: &'i ComponentInventory, name: &str) -> CorpusResult<&'i InventoryValue> {
    inventory.find_inventory_value(name).ok_or_else(|| {
        let near = inventory.suggest_value_ids(name);
        let suggestion = did_you_mean(near.first().copied());
        CorpusError::from_wrong_message(format!(
            "the inventory {:?} has no value {name:?}{suggestion}",
            inventory.id
        ))
        .with_error_place(name)
        .with_command_advice("`chereme list CORPUS values` lists the values")
    })
}

/// Derives the tokens of recordings again whose tiers take their values from an inventory.
fn rederive_inventory_tokens(connection: &Connection, inventory: i64) -> CorpusResult<()> {
    for recording in rows::recordings_with(connection, inventory)? {
        let of_tiers = inventories::load_of(connection, recording)?;
        tokens::update_recording_tokens(connection, recording, None, &of_tiers)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::progress::ignore_progress_step;
    use crate::{
        CorpusAddress, ExportOptions, ExportWhat, ImportOptions, NewTier, ProgressReceiver, RowName, SearchOptions,
        TierRole,
    };

    fn import(corpus: &mut Corpus, path: &std::path::Path, text: &str) {
        fs::write(path, text).expect("written");
        let mut hear = ignore_progress_step;
        corpus
            .import_paths(
                &[path.to_owned()],
                &ImportOptions::default(),
                &mut ProgressReceiver::new(&mut hear),
            )
            .expect("imported");
    }

    #[test]
    fn values_are_added_merged_exported_and_undone() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
        let table = folder.path().join("lex.tsv");
        let text = "gloss\tHandedness\nA\t2s\nB\t2S\nC\t1\n";
        import(&mut corpus, &table, text);
        let total = |corpus: &mut Corpus, query: &str| {
            corpus
                .search_tokens(query, &SearchOptions::default())
                .expect(query)
                .total
        };
        let key = "lex/configuration.handedness";
        let done = corpus.merge_values(key, "2S", "2s").expect("merged");
        assert_eq!((&*done.value, done.entries), ("2s", 1));
        assert_eq!(total(&mut corpus, "configuration.handedness==2s"), 2);
        import(&mut corpus, &table, &format!("{text}D\t2S\n"));
        assert_eq!(total(&mut corpus, "configuration.handedness==2s"), 3, "it stays merged");
        for (from, into, message) in [("2s", "2s", "one value already"), ("2x", "2s", "has no value \"2x\"")] {
            let error = corpus.merge_values(key, from, into).expect_err(from);
            assert!(error.to_string().contains(message), "{error}");
        }
        let error = corpus
            .merge_values("lex/handedness", "1", "2s")
            .expect_err("no inventory");
        assert!(error.to_string().contains("no inventory"), "{error}");

        for (name, found) in [
            ("configurations", Some("configurations")),
            ("Hand Configurations", Some("configurations")),
            (key, Some(key)),
            ("hand", None),
        ] {
            let key = corpus.inventory_key(name).ok();
            assert_eq!(key.as_deref(), found, "{name}");
        }

        let before = corpus.load_corpus_info().expect("info").counts["values"];
        let bent = InventoryValue {
            id: "bent-Q".into(),
            aliases: vec!["Q-hook".into()],
            broader: Some("B".into()),
            ..InventoryValue::default()
        };
        corpus.add_value("configurations", &bent).expect("added");
        assert_eq!(corpus.load_corpus_info().expect("info").counts["values"], before + 1);
        for (value, message) in [
            (bent.clone(), "has the value"),
            (
                InventoryValue {
                    id: "other".into(),
                    aliases: vec!["q-hook".into()],
                    ..InventoryValue::default()
                },
                "bent-Q",
            ),
        ] {
            let error = corpus.add_value("configurations", &value).expect_err(message);
            assert!(error.to_string().contains(message), "{error}");
        }
        let to = folder.path().join("x.json");
        let mut hear = ignore_progress_step;
        let what = ExportWhat::Inventory("configurations".into());
        corpus
            .export_corpus(
                &what,
                &to,
                &ExportOptions::default(),
                &mut ProgressReceiver::new(&mut hear),
            )
            .expect("exported");
        let read = ComponentInventory::from_json(&fs::read_to_string(&to).expect("read")).expect("an inventory");
        assert_eq!(
            read.find_inventory_value("Q-hook").map(|value| &*value.id),
            Some("bent-Q")
        );
        for (what, name) in [
            (ExportWhat::Inventory("configurations".into()), "x.csv"),
            (ExportWhat::All, "y.json"),
            (ExportWhat::Inventory("none".into()), "z.json"),
        ] {
            let mut hear = ignore_progress_step;
            let to = folder.path().join(name);
            let refused = corpus.export_corpus(
                &what,
                &to,
                &ExportOptions::default(),
                &mut ProgressReceiver::new(&mut hear),
            );
            assert!(refused.is_err_and(|error| error.error_remedy().is_some()), "{name}");
        }
        corpus.undo_operation().expect("undone");
        assert_eq!(corpus.load_corpus_info().expect("info").counts["values"], before);
    }

    #[test]
    fn annotations_and_tokens_follow_a_merge() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
        let eaf = folder.path().join("take.eaf");
        fs::write(&eaf, include_str!("export/tests.eaf")).expect("written");
        let mut hear = ignore_progress_step;
        corpus
            .import_paths(&[eaf], &ImportOptions::default(), &mut ProgressReceiver::new(&mut hear))
            .expect("imported");
        let recording = RowName::Number(1);
        let role = TierRole::Component {
            component: chereme_sign::SignComponent::Configuration,
            feature: None,
        };
        let mut tier = NewTier::new(recording.clone(), "mine", role);
        tier.values = crate::TierValueSource::Inventory("configurations".into());
        let tier = corpus.add_tier(&tier).expect("added");
        let add = |value: &str, start: i64| crate::AnnotationAction::Add {
            tier: crate::TierRequestName::Number(tier.id),
            start: format!("{start}ms").parse().ok(),
            end: format!("{}ms", start + 10).parse().ok(),
            parent: None,
            order: None,
            value: value.into(),
            confidence: None,
        };
        let changes = [add("U", 0).into(), add("V", 20).into()];
        let mut hear = ignore_progress_step;
        corpus
            .annotate_corpus(&changes, &Default::default(), &mut ProgressReceiver::new(&mut hear))
            .expect("annotated");
        let done = corpus.merge_values("configurations", "V", "U").expect("merged");
        assert_eq!(done.annotations, 1);
        let address = CorpusAddress::Tier(tier.id);
        let to = folder.path().join("t.csv");
        let mut hear = ignore_progress_step;
        corpus
            .export_corpus(
                &ExportWhat::Address(address),
                &to,
                &ExportOptions::default(),
                &mut ProgressReceiver::new(&mut hear),
            )
            .expect("exported");
        let text = fs::read_to_string(to).expect("read");
        assert_eq!(text.matches(",U,").count(), 2, "{text}");
    }
}
