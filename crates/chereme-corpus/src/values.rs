//! Adding and merging values of inventories.

use chereme_sign::Remedy;
use chereme_sign::text::{did_you_mean, fold, nearest};
use chereme_sign::{Inventory, InventoryValue};
use rusqlite::Connection;
use serde::Serialize;

use crate::Corpus;
use crate::db::inventories as rows;
use crate::error::{Error, Result};
use crate::inventories::{self, StoredInventory};
use crate::tokens;
use crate::words::effect::OperationEffect;

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
    pub fn inventory_key(&self, name: &str) -> Result<String> {
        Ok(named(self.store.read(), name)?.inventory.id)
    }

    /// Adds a value to an inventory, as one operation; tokens whose tiers use the value are derived again.
    ///
    /// # Errors
    /// Fails if the inventory does not exist or has the value already, or if one of the value's spellings means another
    /// value.
    pub fn add_value(&mut self, inventory: &str, value: &InventoryValue) -> Result<()> {
        self.store.operation(|connection| {
            let stored = named(connection, inventory)?;
            let value = InventoryValue {
                id: value.id.trim().to_owned(),
                ..value.clone()
            };
            if value.id.is_empty() {
                return Err(Error::wrong("a value needs a name"));
            }
            if stored.inventory.get(&value.id).is_some() {
                let wrong = format!(
                    "{:?} has the value {:?} already",
                    stored.inventory.id, value.id
                );
                return Err(Error::wrong(wrong).at(&value.id).advise(Remedy::command(
                    "`chereme list CORPUS values` lists the values",
                )));
            }
            let effect = OperationEffect::AddValue {
                value: value.id.clone(),
                inventory: stored.inventory.id.clone(),
            };
            let mut whole = stored.inventory;
            whole.values.push(value);
            whole.check().map_err(|error| {
                Error::wrong(error.to_string())
                    .advise("give the value spellings that no other one has")
            })?;
            inventories::store(connection, &whole)?;
            derive(connection, stored.id)?;
            Ok(((), effect))
        })
    }

    /// Merges two values, as one operation: `into` replaces `from` everywhere, and the spellings of `from` become
    /// further spellings of `into`, so that importing a table again has the same effect.
    ///
    /// # Errors
    /// Fails if the inventory or a value does not exist.
    pub fn merge_values(
        &mut self,
        inventory: &str,
        from: &str,
        into: &str,
    ) -> Result<MergedValues> {
        self.store.operation(|connection| {
            let stored = named(connection, inventory)?;
            let gone = value(&stored.inventory, from)?.clone();
            let left = value(&stored.inventory, into)?.id.clone();
            if gone.id == left {
                let wrong = format!("{from:?} and {into:?} are one value already, {left:?}");
                return Err(Error::wrong(wrong).at(from));
            }
            let mut annotations = 0;
            for text in rows::texts(connection, stored.id)? {
                let meant = stored.inventory.find(text.trim());
                if meant.is_some_and(|value| value.id == gone.id) {
                    annotations += rows::say(connection, stored.id, &text, &left)?;
                }
            }
            let entries = rows::revalue(connection, stored.id, &gone.id, &left)?;
            rows::delete_value(connection, stored.id, &gone.id)?;
            inventories::store(connection, &merged(&stored.inventory, &gone, &left))?;
            derive(connection, stored.id)?;
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
fn merged(inventory: &Inventory, gone: &InventoryValue, left: &str) -> Inventory {
    let mut whole = inventory.clone();
    whole.values.retain(|value| value.id != gone.id);
    for value in &mut whole.values {
        if value.broader.as_deref() == Some(&gone.id) {
            value.broader = match value.id == left {
                true => gone.broader.clone().filter(|broader| broader != left),
                false => Some(left.to_owned()),
            };
        }
        if value.id == left {
            let spelt: Vec<String> = value.spellings().map(str::to_owned).collect();
            let new = gone
                .spellings()
                .filter(|text| !spelt.iter().any(|own| own == text));
            value.aliases.extend(new.map(str::to_owned));
        }
    }
    whole
}

/// Returns the inventory of that name.
pub(crate) fn named(connection: &Connection, name: &str) -> Result<StoredInventory> {
    let all = inventories::load(connection)?;
    let ids: Vec<String> = all
        .iter()
        .map(|stored| stored.inventory.id.clone())
        .collect();
    let name = name.trim();
    let keyed = all.iter().position(|stored| stored.inventory.id == name);
    let called = || {
        let is = |stored: &StoredInventory| {
            let mut names = stored.inventory.names.values();
            names.any(|own| fold(own) == fold(name))
        };
        let mut found = all.iter().enumerate().filter(|(_, it)| is(it));
        let (at, _) = found.next()?;
        found.next().is_none().then_some(at)
    };
    let found = keyed.or_else(called);
    let found = found.and_then(|at| all.into_iter().nth(at));
    found.ok_or_else(|| {
        let meant = did_you_mean(nearest(name, ids.iter().map(String::as_str)));
        Error::wrong(format!("there is no inventory {name:?}{meant}"))
            .at(name)
            .advise(Remedy::command(
                "`chereme list CORPUS inventories` lists them",
            ))
    })
}

fn value<'i>(inventory: &'i Inventory, name: &str) -> Result<&'i InventoryValue> {
    inventory.find(name).ok_or_else(|| {
        let near = inventory.suggest(name);
        let meant = did_you_mean(near.first().copied());
        Error::wrong(format!(
            "the inventory {:?} has no value {name:?}{meant}",
            inventory.id
        ))
        .at(name)
        .advise(Remedy::command(
            "`chereme list CORPUS values` lists the values",
        ))
    })
}

/// Derives the tokens of recordings again whose tiers take their values from an inventory.
fn derive(connection: &Connection, inventory: i64) -> Result<()> {
    for recording in rows::recordings_with(connection, inventory)? {
        let of_tiers = inventories::load_of(connection, recording)?;
        tokens::derive(connection, recording, None, &of_tiers)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::progress::unheard;
    use crate::{
        Address, ExportOptions, ExportWhat, ImportOptions, Name, NewTier, Progress, SearchOptions,
        TierRole,
    };

    fn import(corpus: &mut Corpus, path: &std::path::Path, text: &str) {
        fs::write(path, text).expect("written");
        let mut hear = unheard;
        corpus
            .import(
                &[path.to_owned()],
                &ImportOptions::default(),
                &mut Progress::new(&mut hear),
            )
            .expect("imported");
    }

    #[test]
    fn values_are_added_merged_exported_and_undone() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = Corpus::create(&folder.path().join("c.chereme"), "A").expect("made");
        let table = folder.path().join("lex.tsv");
        let text = "gloss\tHandedness\nA\t2s\nB\t2S\nC\t1\n";
        import(&mut corpus, &table, text);
        let total = |corpus: &mut Corpus, query: &str| {
            corpus
                .search(query, &SearchOptions::default())
                .expect(query)
                .total
        };
        let key = "lex/configuration.handedness";
        let done = corpus.merge_values(key, "2S", "2s").expect("merged");
        assert_eq!((&*done.value, done.entries), ("2s", 1));
        assert_eq!(total(&mut corpus, "configuration.handedness==2s"), 2);
        import(&mut corpus, &table, &format!("{text}D\t2S\n"));
        assert_eq!(
            total(&mut corpus, "configuration.handedness==2s"),
            3,
            "it stays merged"
        );
        for (from, into, message) in [
            ("2s", "2s", "one value already"),
            ("2x", "2s", "has no value \"2x\""),
        ] {
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

        let before = corpus.info().expect("info").counts["values"];
        let bent = InventoryValue {
            id: "bent-Q".into(),
            aliases: vec!["Q-hook".into()],
            broader: Some("B".into()),
            ..InventoryValue::default()
        };
        corpus.add_value("configurations", &bent).expect("added");
        assert_eq!(corpus.info().expect("info").counts["values"], before + 1);
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
            let error = corpus
                .add_value("configurations", &value)
                .expect_err(message);
            assert!(error.to_string().contains(message), "{error}");
        }
        let to = folder.path().join("x.json");
        let mut hear = unheard;
        let what = ExportWhat::Inventory("configurations".into());
        corpus
            .export(
                &what,
                &to,
                &ExportOptions::default(),
                &mut Progress::new(&mut hear),
            )
            .expect("exported");
        let read =
            Inventory::from_json(&fs::read_to_string(&to).expect("read")).expect("an inventory");
        assert_eq!(read.find("Q-hook").map(|value| &*value.id), Some("bent-Q"));
        for (what, name) in [
            (ExportWhat::Inventory("configurations".into()), "x.csv"),
            (ExportWhat::All, "y.json"),
            (ExportWhat::Inventory("none".into()), "z.json"),
        ] {
            let mut hear = unheard;
            let to = folder.path().join(name);
            let refused = corpus.export(
                &what,
                &to,
                &ExportOptions::default(),
                &mut Progress::new(&mut hear),
            );
            assert!(
                refused.is_err_and(|error| error.remedy().is_some()),
                "{name}"
            );
        }
        corpus.undo().expect("undone");
        assert_eq!(corpus.info().expect("info").counts["values"], before);
    }

    #[test]
    fn annotations_and_tokens_follow_a_merge() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = Corpus::create(&folder.path().join("c.chereme"), "A").expect("made");
        let eaf = folder.path().join("take.eaf");
        fs::write(&eaf, include_str!("export/tests.eaf")).expect("written");
        let mut hear = unheard;
        corpus
            .import(
                &[eaf],
                &ImportOptions::default(),
                &mut Progress::new(&mut hear),
            )
            .expect("imported");
        let recording = Name::Number(1);
        let role = TierRole::Component {
            component: chereme_sign::Component::Configuration,
            feature: None,
        };
        let mut tier = NewTier::new(recording.clone(), "mine", role);
        tier.values = crate::Values::Inventory("configurations".into());
        let tier = corpus.add_tier(&tier).expect("added");
        let add = |value: &str, start: i64| crate::AnnotationAction::Add {
            tier: crate::TierName::Number(tier.id),
            start: format!("{start}ms").parse().ok(),
            end: format!("{}ms", start + 10).parse().ok(),
            parent: None,
            order: None,
            value: value.into(),
            confidence: None,
        };
        let changes = [add("U", 0).into(), add("V", 20).into()];
        let mut hear = unheard;
        corpus
            .annotate(&changes, &Default::default(), &mut Progress::new(&mut hear))
            .expect("annotated");
        let done = corpus
            .merge_values("configurations", "V", "U")
            .expect("merged");
        assert_eq!(done.annotations, 1);
        let address = Address::Tier(tier.id);
        let to = folder.path().join("t.csv");
        let mut hear = unheard;
        corpus
            .export(
                &ExportWhat::Address(address),
                &to,
                &ExportOptions::default(),
                &mut Progress::new(&mut hear),
            )
            .expect("exported");
        let text = fs::read_to_string(to).expect("read");
        assert_eq!(text.matches(",U,").count(), 2, "{text}");
    }
}
