//! Rows of inventories and their values.

use rusqlite::{Connection, params};

use crate::db::cached_sql::CachedSql;
use crate::error::CorpusResult;

/// An inventory as stored: its own document, without its values.
pub(crate) struct InventoryRow {
    pub(crate) id: i64,
    pub(crate) key: String,
    pub(crate) component: String,
    pub(crate) feature: Option<String>,
    pub(crate) document: String,
    /// Key and document of each value, in order.
    pub(crate) values: Vec<(String, String)>,
}

/// Returns all inventories with their values, or those of the tiers of a recording, oldest first.
pub(crate) fn load_inventory_rows(connection: &Connection, recording: Option<i64>) -> CorpusResult<Vec<InventoryRow>> {
    let mut statement = connection.prepare_cached(
        "SELECT id, key, component, feature, document FROM inventory
         WHERE ?1 IS NULL OR id IN (SELECT inventory_id FROM tier WHERE recording_id = ?1)
         ORDER BY id",
    )?;
    let mut inventories = statement
        .query_map([recording], |row| {
            Ok(InventoryRow {
                id: row.get(0)?,
                key: row.get(1)?,
                component: row.get(2)?,
                feature: row.get(3)?,
                document: row.get(4)?,
                values: Vec::new(),
            })
        })?
        .collect::<rusqlite::Result<Vec<_>>>()?;
    let mut statement = connection
        .prepare_cached("SELECT key, document FROM inventory_value WHERE inventory_id = ?1 ORDER BY position, id")?;
    for inventory in &mut inventories {
        inventory.values = statement
            .query_map([inventory.id], |row| Ok((row.get(0)?, row.get(1)?)))?
            .collect::<rusqlite::Result<_>>()?;
    }
    Ok(inventories)
}

/// Returns the row of the inventory with this key.
pub(crate) fn find_inventory_row(connection: &Connection, key: &str) -> CorpusResult<Option<i64>> {
    connection.find_value("SELECT id FROM inventory WHERE key = ?1", [key])
}

/// Writes an inventory or a new version of its document, and returns its row; `id` and `values` are not used.
pub(crate) fn store_inventory_row(connection: &Connection, row: &InventoryRow) -> CorpusResult<i64> {
    let sql = "INSERT INTO inventory (key, component, feature, document) VALUES (?1, ?2, ?3, ?4)
             ON CONFLICT (key) DO UPDATE SET document = excluded.document
             WHERE document <> excluded.document";
    connection.change_rows(sql, params![row.key, row.component, row.feature, row.document])?;
    Ok(find_inventory_row(connection, &row.key)?.unwrap_or_default())
}

/// Writes a value of an inventory, or a new version of its document.
pub(crate) fn store_value(
    connection: &Connection,
    inventory: i64,
    position: usize,
    key: &str,
    document: &str,
) -> CorpusResult<()> {
    let sql = "INSERT INTO inventory_value (inventory_id, key, position, document)
             VALUES (?1, ?2, ?3, ?4)
             ON CONFLICT (inventory_id, key) DO UPDATE SET document = excluded.document
             WHERE document <> excluded.document";
    connection.change_rows(sql, params![inventory, key, position as i64, document])
}

/// Returns inventory, value and the other value that it is the same as, of each value that is one with others.
pub(crate) fn load_joined_values(connection: &Connection) -> CorpusResult<Vec<[Option<String>; 3]>> {
    let sql = "SELECT i.key, v.key, v.same_as FROM inventory_value v JOIN inventory i ON i.id = v.inventory_id
         WHERE v.same_as IS NOT NULL
            OR i.key || '/' || v.key IN (SELECT same_as FROM inventory_value WHERE same_as IS NOT NULL)
         ORDER BY i.id, v.position, v.id";
    connection.read_rows(sql, [], |row| Ok([row.get(0)?, row.get(1)?, row.get(2)?]))
}

/// Says that a value, by inventory and key, is the same as another one, written `INVENTORY/VALUE`, or as none.
pub(crate) fn set_same_as(connection: &Connection, value: [&str; 2], same_as: Option<&str>) -> CorpusResult<()> {
    let sql = "UPDATE inventory_value SET same_as = ?3 WHERE key = ?2 AND same_as IS NOT ?3
                AND inventory_id = (SELECT id FROM inventory WHERE key = ?1)";
    connection.change_rows(sql, params![value[0], value[1], same_as])
}

/// Makes another value of an inventory one with those that a value is one with.
pub(crate) fn pass_same_as(connection: &Connection, inventory: &str, [from, into]: [&str; 2]) -> CorpusResult<()> {
    connection.change_rows(
        "UPDATE inventory_value SET same_as = ?1 || '/' || ?3 WHERE same_as = ?1 || '/' || ?2",
        [inventory, from, into],
    )?;
    let sql = "UPDATE inventory_value AS v SET same_as = o.same_as FROM inventory_value o
             WHERE o.inventory_id = v.inventory_id AND o.key = ?2 AND o.same_as IS NOT NULL AND v.key = ?3
                AND v.same_as IS NULL AND v.inventory_id = (SELECT id FROM inventory WHERE key = ?1)";
    connection.change_rows(sql, [inventory, from, into])
}

/// Deletes a value of an inventory.
pub(crate) fn delete_value(connection: &Connection, inventory: i64, key: &str) -> CorpusResult<()> {
    let sql = "DELETE FROM inventory_value WHERE inventory_id = ?1 AND key = ?2";
    connection.change_rows(sql, params![inventory, key])
}

/// Replaces a value of an inventory by another one in the entries of lexicons, and returns the number of changes.
pub(crate) fn replace_lexicon_value(
    connection: &Connection,
    inventory: i64,
    from: &str,
    into: &str,
) -> CorpusResult<u64> {
    let sql = "UPDATE token_value SET value = ?3
             WHERE inventory_id = ?1 AND value = ?2 AND annotation_id IS NULL";
    let changed = connection.count_changes(sql, params![inventory, from, into])?;
    Ok(changed as u64)
}

/// Returns the distinct values of the annotations on tiers whose values come from an inventory.
pub(crate) fn list_inventory_tier_values(connection: &Connection, inventory: i64) -> CorpusResult<Vec<String>> {
    let sql = "SELECT DISTINCT a.value FROM annotation a JOIN tier t ON t.id = a.tier_id
         WHERE t.inventory_id = ?1 AND a.state = 'value' ORDER BY a.value";
    connection.read_values(sql, [inventory])
}

/// Replaces a value by another one on the tiers of an inventory, and returns the number of changed annotations.
pub(crate) fn replace_inventory_tier_value(
    connection: &Connection,
    inventory: i64,
    old: &str,
    new: &str,
) -> CorpusResult<u64> {
    let sql = "UPDATE annotation SET value = ?3 WHERE state = 'value' AND value = ?2
             AND tier_id IN (SELECT id FROM tier WHERE inventory_id = ?1)";
    let changed = connection.count_changes(sql, params![inventory, old, new])?;
    Ok(changed as u64)
}

/// Returns the recordings with tiers whose values come from an inventory.
pub(crate) fn recordings_with(connection: &Connection, inventory: i64) -> CorpusResult<Vec<i64>> {
    let sql = "SELECT DISTINCT recording_id FROM tier WHERE inventory_id = ?1 ORDER BY 1";
    connection.read_values(sql, [inventory])
}
