//! The inventories of a corpus: the built-in ones, and those from imported files.

mod equal_values;

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_sign::text::fold_text;
use chereme_sign::{ComponentInventory, InventoryValue, inventory};
use rusqlite::Connection;
use serde_json::Value;

use crate::Corpus;
use crate::db::stored_contents::newest_operation_number;
use crate::db::{damaged_row_error, stored_inventories as rows};
use crate::error::CorpusResult;

pub(crate) use equal_values::StandingWords;
pub use equal_values::{EqualValues, ValueName};

/// An inventory of the corpus with its row.
#[derive(Debug, Clone)]
pub struct StoredInventory {
    /// The row.
    pub id: i64,
    /// The inventory.
    pub inventory: ComponentInventory,
}

impl Corpus {
    /// Returns the inventories, which are read again only if the corpus has changed: previews follow each other fast.
    pub(crate) fn inventories_now(&self) -> CorpusResult<Arc<Vec<StoredInventory>>> {
        let now = newest_operation_number(self.store.read_connection())?;
        let mut kept = self.inventories.borrow_mut();
        if let Some((generation, inventories)) = &*kept
            && *generation == now
        {
            return Ok(inventories.clone());
        }
        let inventories = Arc::new(load_all_inventories(self.store.read_connection())?);
        *kept = Some((now, inventories.clone()));
        Ok(inventories)
    }
}

/// Writes the built-in inventories into a corpus.
pub(crate) fn store_builtin(connection: &Connection) -> CorpusResult<()> {
    for inventory in inventory::builtin_inventories() {
        store_inventory(connection, inventory)?;
    }
    Ok(())
}

/// Writes an inventory, and returns its row; further values of the stored inventory remain.
pub(crate) fn store_inventory(connection: &Connection, inventory: &ComponentInventory) -> CorpusResult<i64> {
    let place = || format!("inventory {:?}", inventory.id);
    let mut document: Value =
        serde_json::from_str(&inventory.to_json()).map_err(|error| damaged_row_error(place(), error.to_string()))?;
    // Values have rows of their own, so that adding one does not write them all again.
    let values = document.as_object_mut().and_then(|map| map.remove("values"));
    let row = rows::InventoryRow {
        id: 0,
        key: inventory.id.clone(),
        component: inventory.component.component_name().to_owned(),
        feature: inventory.feature.clone(),
        document: document.to_string(),
        values: Vec::new(),
    };
    let id = rows::store_inventory_row(connection, &row)?;
    let values = values.and_then(|values| values.as_array().cloned()).unwrap_or_default();
    for (position, (value, document)) in inventory.values.iter().zip(values).enumerate() {
        rows::store_value(connection, id, position, &value.id, &document.to_string())?;
    }
    Ok(id)
}

/// Returns an inventory from a file, joined with the values that the corpus already has in it.
///
/// Ids that differ in case or accents are two values, unless one of them is a further spelling of an existing value. A
/// value or a name that would mean a different existing value is left out.
pub(crate) fn join_stored_inventory(
    before: Option<&ComponentInventory>,
    new: ComponentInventory,
) -> ComponentInventory {
    let mut all = before.map_or_else(Vec::new, |before| before.values.clone());
    let mut value_by_text: BTreeMap<String, String> = BTreeMap::new();
    for value in &all {
        let keyed_id = |text: &str| (fold_text(text.trim()), value.id.clone());
        value_by_text.extend(value.value_spellings().map(keyed_id));
    }
    let mut places: BTreeMap<String, usize> = BTreeMap::new();
    places.extend(all.iter().enumerate().map(|(at, it)| (it.id.clone(), at)));
    for mut value in new.values {
        let free = |text: &str| {
            let other = value_by_text.get(&fold_text(text.trim()));
            other.is_none_or(|other| *other == value.id)
        };
        let spelt =
            |other: &InventoryValue| other.id != value.id && other.value_spellings().any(|text| text == value.id);
        let apart = value_by_text
            .get(&fold_text(value.id.trim()))
            .is_some_and(|other| fold_text(other.trim()) == fold_text(value.id.trim()));
        // Otherwise one text would mean two values.
        if all.iter().any(spelt) || !(apart || free(&value.id)) {
            continue;
        }
        let names = std::mem::take(&mut value.names);
        let aliases = std::mem::take(&mut value.aliases);
        let names = names.into_iter().filter(|(_, name)| free(name)).collect();
        let aliases = aliases.into_iter().filter(|alias| free(alias)).collect();
        (value.names, value.aliases) = (names, aliases);
        let keyed_id = |text: &str| (fold_text(text.trim()), value.id.clone());
        value_by_text.extend(value.value_spellings().map(keyed_id));
        match places.get(&value.id) {
            Some(&at) => all[at] = value,
            None => {
                places.insert(value.id.clone(), all.len());
                all.push(value);
            }
        }
    }
    ComponentInventory { values: all, ..new }
}

/// Returns every inventory of the corpus, oldest first.
pub(crate) fn load_all_inventories(connection: &Connection) -> CorpusResult<Vec<StoredInventory>> {
    rows::load_inventory_rows(connection, None)?
        .into_iter()
        .map(stored_inventory_from_row)
        .collect()
}

/// Returns the inventories of a recording's tiers, oldest first.
pub(crate) fn load_of(connection: &Connection, recording: i64) -> CorpusResult<Vec<StoredInventory>> {
    rows::load_inventory_rows(connection, Some(recording))?
        .into_iter()
        .map(stored_inventory_from_row)
        .collect()
}

pub(crate) fn stored_inventory_from_row(row: rows::InventoryRow) -> CorpusResult<StoredInventory> {
    let place = || format!("inventory {:?}", row.key);
    let parse =
        |text: &str| serde_json::from_str::<Value>(text).map_err(|error| damaged_row_error(place(), error.to_string()));
    let mut document = parse(&row.document)?;
    let values = row
        .values
        .iter()
        .map(|(_, document)| parse(document))
        .collect::<CorpusResult<Vec<_>>>()?;
    let map = document
        .as_object_mut()
        .ok_or_else(|| damaged_row_error(place(), "it is no object"))?;
    map.insert("values".to_owned(), Value::Array(values));
    let inventory = ComponentInventory::from_json(&document.to_string())
        .map_err(|error| damaged_row_error(place(), error.to_string()))?;
    Ok(StoredInventory { id: row.id, inventory })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inventory(values: &[(&str, &str)]) -> ComponentInventory {
        let value = |(id, name): &(&str, &str)| InventoryValue {
            id: (*id).to_owned(),
            names: BTreeMap::from([("en".to_owned(), (*name).to_owned())]),
            ..InventoryValue::default()
        };
        ComponentInventory {
            values: values.iter().map(value).collect(),
            ..inventory::builtin_inventories()[0].clone()
        }
    }

    #[test]
    fn a_merged_inventory_has_one_meaning_for_each_spelling() {
        let before = inventory(&[("B-spread", "open hand"), ("cap", "the cap")]);
        let new = inventory(&[("b-SPREAD", "five"), ("hat", "The Cap"), ("cap", "a cap")]);
        let joined = join_stored_inventory(Some(&before), new);
        let listed: Vec<_> = joined
            .values
            .iter()
            .map(|it| (&*it.id, it.names.values().next().map(String::as_str)))
            .collect();
        assert_eq!(
            listed,
            [
                ("B-spread", Some("open hand")),
                ("cap", Some("a cap")),
                ("b-SPREAD", Some("five")),
                ("hat", None)
            ]
        );
        assert!(ComponentInventory::from_json(&joined.to_json()).is_ok());
    }
}
