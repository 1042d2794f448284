//! Rows of two corpora that have diverged: their changes since then, with references by uid instead of row number.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, HashMap};

use rusqlite::{Connection, OptionalExtension, params};
use serde_json::{Map, Value};
use sha2::{Digest as _, Sha256};

use super::stored_history;
use super::stored_history::tracked::{
    TRACKED_TABLE_REFERENCES, column_from_image_sql, load_table_columns, refers_to, row_image,
};
use crate::db::cached_sql::CachedSql;
use crate::db::people::ADJUDICATION_ANNOTATOR;
use crate::db::stored_motion::to_hex_text;
use crate::error::CorpusResult;

/// A row as JSON; columns that refer to other rows hold their uids.
pub(crate) type RowImage = Map<String, Value>;

/// The table and uid of a row.
pub(crate) type TableRowKey = (String, String);

/// The uids that row numbers stood for at an earlier time; nothing if the row did not exist then.
type EarlierRowUids = BTreeMap<(String, i64), Option<String>>;

/// A row of one of the two corpora of a merge.
#[derive(Clone, Copy)]
pub(crate) struct StoredRowPlace<'c> {
    /// The corpus.
    pub(crate) connection: &'c Connection,
    /// The number of the row.
    pub(crate) id: i64,
}

/// One side of a merge: a corpus and its changes since the common state.
pub(crate) struct MergeSide<'c> {
    pub(crate) connection: &'c Connection,
    /// The changed rows in their earlier state; nothing if they did not exist then.
    pub(crate) touched: BTreeMap<TableRowKey, Option<RowImage>>,
    /// Row numbers by table and uid; each table is read when it is first used.
    ids: RefCell<HashMap<String, HashMap<String, i64>>>,
}

/// Returns the last operation that two corpora have in common, by its number in each; nothing if they share no
/// beginning.
pub(crate) fn find_common_operation(mine: &Connection, other: &Connection) -> CorpusResult<Option<(i64, i64)>> {
    let read = |connection: &Connection| -> CorpusResult<Vec<(i64, String)>> {
        let mut statement = connection.prepare("SELECT id, hex(uid) FROM operation ORDER BY id")?;
        let rows = statement.query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?;
        Ok(rows.collect::<rusqlite::Result<_>>()?)
    };
    let (a, b) = (read(mine)?, read(other)?);
    // Histories are equal from their beginning up to the moment at which one file was copied.
    let shared = a.iter().zip(&b).take_while(|(x, y)| x.1 == y.1).last();
    if let Some((x, y)) = shared {
        return Ok(Some((x.0, y.0)));
    }
    // Copies of a corpus without any operation still share the inventories of a new corpus.
    let first = |connection: &Connection| -> CorpusResult<Option<String>> {
        let sql = "SELECT hex(uid) FROM inventory ORDER BY id LIMIT 1";
        Ok(connection.query_row(sql, [], |row| row.get(0)).optional()?)
    };
    let (a, b) = (first(mine)?, first(other)?);
    Ok((a.is_some() && a == b).then_some((0, 0)))
}

/// Returns the newest operation later than `after` that the other corpus has recorded as merged.
pub(crate) fn merged_before(connection: &Connection, after: i64, other: &Connection) -> CorpusResult<Option<i64>> {
    let mut newest: Option<i64> = None;
    for (key, _) in list_corpus_notes(other, MERGED_OPERATION_PREFIX)? {
        let sql = "SELECT id FROM operation WHERE uid = unhex(?1) AND id > ?2";
        let merged_operation: Option<i64> =
            connection.find_value(sql, params![&key[MERGED_OPERATION_PREFIX.len()..], after])?;
        // `None` is less than any number.
        newest = newest.max(merged_operation);
    }
    Ok(newest)
}

/// Records that all operations of another corpus were merged.
pub(crate) fn note_merged(connection: &Connection, other: &Connection) -> CorpusResult<()> {
    let sql = "SELECT hex(uid) FROM operation ORDER BY id DESC LIMIT 1";
    let newest: Option<String> = other.query_row(sql, [], |row| row.get(0)).optional()?;
    match newest {
        Some(uid) => set_note(connection, &format!("{MERGED_OPERATION_PREFIX}{uid}"), "1"),
        None => Ok(()),
    }
}

/// The prefix of the keys under which merged operations are recorded.
const MERGED_OPERATION_PREFIX: &str = "merged:";

impl<'c> MergeSide<'c> {
    /// Returns a side without changes: the corpus in its present state.
    pub(crate) fn present_merge_side(connection: &'c Connection) -> Self {
        Self {
            connection,
            touched: BTreeMap::new(),
            ids: RefCell::default(),
        }
    }

    /// Returns a side with the changes of the operations later than `after`.
    pub(crate) fn merge_side_since(connection: &'c Connection, after: i64) -> CorpusResult<Self> {
        let mut gone: EarlierRowUids = BTreeMap::new();
        let mut first: BTreeMap<TableRowKey, Option<RowImage>> = BTreeMap::new();
        let sql = "SELECT id FROM operation WHERE id > ?1 ORDER BY id";
        let operations: Vec<i64> = connection
            .prepare(sql)?
            .query_map([after], |row| row.get(0))?
            .collect::<rusqlite::Result<_>>()?;
        for operation in operations {
            stored_history::each_change(connection, operation, |change| {
                let any = if change.after.is_null() {
                    &change.before
                } else {
                    &change.after
                };
                let uid = any.get("uid").and_then(Value::as_str);
                if let Some(uid) = uid.map(str::to_owned) {
                    let before = change.before.as_object().cloned();
                    // Row numbers are reused: the first change of a row number shows which row had it before.
                    if let Some(id) = any.get("id").and_then(Value::as_i64) {
                        let gone_uid = before.is_some().then(|| uid.clone());
                        gone.entry((change.table.clone(), id)).or_insert(gone_uid);
                    }
                    // Only the state before the first change counts; later ones happened within this side.
                    first.entry((change.table, uid)).or_insert(before);
                }
                Ok(())
            })?;
        }
        let mut side = Self {
            connection,
            touched: BTreeMap::new(),
            ids: RefCell::default(),
        };
        for ((table, uid), image) in first {
            let image = match image {
                Some(image) => Some(side.by_uid(&table, image, &gone)?),
                None => None,
            };
            side.touched.insert((table, uid), image);
        }
        Ok(side)
    }

    /// Returns a side with the differences from another corpus, which is the earlier state.
    pub(crate) fn merge_side_against(connection: &'c Connection, base: &Connection) -> CorpusResult<Self> {
        let mut side = Self {
            connection,
            touched: BTreeMap::new(),
            ids: RefCell::default(),
        };
        let before = MergeSide {
            connection: base,
            touched: BTreeMap::new(),
            ids: RefCell::default(),
        };
        for (table, _) in TRACKED_TABLE_REFERENCES {
            if !has_uid(connection, table)? {
                continue;
            }
            let (old, new) = (before.load_all_row_images(table)?, side.load_all_row_images(table)?);
            for (uid, image) in &old {
                if new.get(uid) != Some(image) {
                    let key = (table.to_owned(), uid.clone());
                    side.touched.insert(key, Some(image.clone()));
                }
            }
            for uid in new.keys().filter(|uid| !old.contains_key(*uid)) {
                side.touched.insert((table.to_owned(), uid.clone()), None);
            }
        }
        Ok(side)
    }

    /// Returns a row in its present state.
    pub(crate) fn find_row_image(&self, table: &str, uid: &str) -> CorpusResult<Option<RowImage>> {
        let Some(id) = self.find_row_id(table, uid)? else {
            return Ok(None);
        };
        let image = row_image(&load_table_columns(self.connection, table)?, "r");
        let sql = format!("SELECT {image} FROM main.{table} AS r WHERE id = ?1");
        let text: Option<String> = self.connection.find_value(&sql, [id])?;
        match text.and_then(|text| serde_json::from_str(&text).ok()) {
            Some(image) => Ok(Some(self.by_uid(table, image, &BTreeMap::new())?)),
            None => Ok(None),
        }
    }

    /// Returns the number of a row.
    pub(crate) fn find_row_id(&self, table: &str, uid: &str) -> CorpusResult<Option<i64>> {
        let mut ids = self.ids.borrow_mut();
        if let Some(known) = ids.get(table) {
            return Ok(known.get(uid).copied());
        }
        let sql = format!("SELECT hex(uid), id FROM main.{table}");
        let mut statement = self.connection.prepare(&sql)?;
        let rows = statement.query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?;
        let all: HashMap<String, i64> = rows.collect::<rusqlite::Result<_>>()?;
        let matching_id = all.get(uid).copied();
        ids.insert(table.to_owned(), all);
        Ok(matching_id)
    }

    /// Associates a uid with a row from now on; nothing means that the row was removed.
    pub(crate) fn remember_row_uid(&self, table: &str, uid: &str, id: Option<i64>) -> CorpusResult<()> {
        // The table is read into memory first, or the new entry would stand for the whole of it.
        self.find_row_id(table, uid)?;
        if let Some(all) = self.ids.borrow_mut().get_mut(table) {
            match id {
                Some(id) => all.insert(uid.to_owned(), id),
                None => all.remove(uid),
            };
        }
        Ok(())
    }

    fn load_all_row_images(&self, table: &str) -> CorpusResult<BTreeMap<String, RowImage>> {
        let image = row_image(&load_table_columns(self.connection, table)?, "r");
        let sql = format!("SELECT hex(uid), {image} FROM main.{table} AS r");
        let mut statement = self.connection.prepare(&sql)?;
        let mut rows = statement.query([])?;
        let mut all = BTreeMap::new();
        while let Some(row) = rows.next()? {
            let text: String = row.get(1)?;
            if let Ok(image) = serde_json::from_str(&text) {
                all.insert(row.get(0)?, self.by_uid(table, image, &BTreeMap::new())?);
            }
        }
        Ok(all)
    }

    /// Returns a row with its references as uids instead of row numbers.
    pub(crate) fn image_with_uid_references(&self, table: &str, image: RowImage) -> CorpusResult<RowImage> {
        self.by_uid(table, image, &BTreeMap::new())
    }

    /// Replaces row numbers by uids; `gone` holds the uids of row numbers that stood for other rows earlier.
    fn by_uid(&self, table: &str, mut image: RowImage, gone: &EarlierRowUids) -> CorpusResult<RowImage> {
        // Row numbers differ between copies of a corpus.
        image.remove("id");
        for (column, value) in &mut image {
            let Some(other) = refers_to(table, column) else {
                continue;
            };
            let Some(id) = value.as_i64() else { continue };
            let uid = match gone.get(&(other.to_owned(), id)) {
                Some(own) => own.clone(),
                None => uid_of(self.connection, other, id)?,
            };
            *value = uid.map_or(Value::Null, Value::String);
        }
        Ok(image)
    }
}

/// Reports whether rows of a table have uids.
pub(crate) fn has_uid(connection: &Connection, table: &str) -> CorpusResult<bool> {
    Ok(load_table_columns(connection, table)?
        .iter()
        .any(|column| column.name == "uid"))
}

/// Returns the uid of a row.
pub(crate) fn uid_of(connection: &Connection, table: &str, id: i64) -> CorpusResult<Option<String>> {
    let sql = format!("SELECT hex(uid) FROM main.{table} WHERE id = ?1");
    let mut statement = connection.prepare_cached(&sql)?;
    Ok(statement.query_row([id], |row| row.get(0)).optional()?)
}

/// Inserts a row whose references are row numbers, and returns its number.
pub(crate) fn insert_row_image(connection: &Connection, table: &str, image: &RowImage) -> CorpusResult<i64> {
    let all = load_table_columns(connection, table)?;
    // A new row gets a number of its own, which the other corpus does not know.
    let image_columns: Vec<_> = all
        .iter()
        .filter(|column| image.contains_key(&column.name) && column.name != "id")
        .collect();
    let names: Vec<&str> = image_columns.iter().map(|column| column.name.as_str()).collect();
    let values: Vec<String> = image_columns
        .iter()
        .map(|column| column_from_image_sql(column))
        .collect();
    let sql = format!(
        "INSERT INTO main.{table} ({}) VALUES ({})",
        names.join(","),
        values.join(",")
    );
    let text = Value::Object(image.clone()).to_string();
    connection.insert_row(&sql, [text])
}

/// Updates some columns of a row; references are row numbers.
pub(crate) fn update_row_image(connection: &Connection, table: &str, id: i64, image: &RowImage) -> CorpusResult<()> {
    let all = load_table_columns(connection, table)?;
    let settings: Vec<String> = all
        .iter()
        .filter(|column| image.contains_key(&column.name) && column.name != "id")
        .map(|column| format!("{} = {}", column.name, column_from_image_sql(column)))
        .collect();
    if settings.is_empty() {
        return Ok(());
    }
    let sql = format!("UPDATE main.{table} SET {} WHERE id = ?2", settings.join(","));
    let text = Value::Object(image.clone()).to_string();
    connection.change_rows(&sql, params![text, id])
}

/// Deletes a row.
pub(crate) fn delete_table_row(connection: &Connection, table: &str, id: i64) -> CorpusResult<()> {
    let sql = format!("DELETE FROM main.{table} WHERE id = ?1");
    connection.change_rows(&sql, [id])
}

/// Returns the existing row with the same unique name as another one, if there is one.
pub(crate) fn find_namesake_row(connection: &Connection, table: &str, image: &RowImage) -> CorpusResult<Option<i64>> {
    let keys: &[&str] = match table {
        "lexicon" | "signer" | "kept_search" | "recording" | "study" => &["name"],
        "skeleton" => &["hash"],
        "inventory" => &["key"],
        "inventory_value" => &["inventory_id", "key"],
        "sign" => &["lexicon_id", "gloss", "homonym"],
        "tier" | "track" => &["recording_id", "name"],
        "attribute" => &["token_id", "name"],
        "person_alias" => &["name"],
        "sign_relation" => &["sign_id", "kind", "related_id", "position"],
        "person_attribute" => &["signer_id", "name"],
        "notation" => &["token_id"],
        "recipe" => &["recording_id"],
        "channel" => &["track_id", "position"],
        "study_participant" => &["study_id", "code"],
        "study_answer" => &["participant_id", "n", "question"],
        _ => return Ok(None),
    };
    let conditions: Vec<String> = keys
        .iter()
        // `IS` also compares missing values, as of a sign without a lexicon.
        .map(|key| format!("{key} IS json_extract(?1, '$.{key}')"))
        .collect();
    let sql = format!("SELECT id FROM main.{table} WHERE {}", conditions.join(" AND "));
    let text = Value::Object(image.clone()).to_string();
    let mut statement = connection.prepare_cached(&sql)?;
    Ok(statement.query_row([text], |row| row.get(0)).optional()?)
}

/// Returns the track of a recording here that has the name, kind and blocks of one of another corpus, whose row resolved
/// for this one is `local`.
pub(crate) fn find_equal_track(
    other: StoredRowPlace<'_>,
    connection: &Connection,
    local: &RowImage,
) -> CorpusResult<Option<i64>> {
    let content = |connection: &Connection,
                   condition: &str,
                   value: &dyn rusqlite::ToSql|
     -> CorpusResult<Option<(i64, String)>> {
        let sql = format!(
            "SELECT id, kind || (SELECT coalesce(group_concat(part), '') FROM
                 (SELECT channel_group || ' ' || first_frame || ' ' || hex(hash) AS part FROM track_block
                  WHERE track_id = track.id ORDER BY channel_group, first_frame))
             FROM track WHERE {condition}"
        );
        let row = connection.query_row(&sql, [value], |row| Ok((row.get(0)?, row.get(1)?)));
        Ok(row.optional()?)
    };
    let theirs = content(other.connection, "id = ?1", &other.id)?;
    let named = "recording_id = json_extract(?1, '$.recording_id') AND name = json_extract(?1, '$.name')";
    let mine = content(connection, named, &Value::Object(local.clone()).to_string())?;
    let both = mine.zip(theirs);
    Ok(both.filter(|(mine, theirs)| mine.1 == theirs.1).map(|(mine, _)| mine.0))
}

/// Returns the file of a recording here with the kind and bytes of a row.
pub(crate) fn find_equal_file(connection: &Connection, local: &RowImage) -> CorpusResult<Option<i64>> {
    let sql = "SELECT id FROM source_file WHERE recording_id = json_extract(?1, '$.recording_id')
               AND kind = json_extract(?1, '$.kind') AND hash = json_extract(?1, '$.hash') ORDER BY id";
    let text = Value::Object(local.clone()).to_string();
    let mut statement = connection.prepare_cached(sql)?;
    Ok(statement.query_row([text], |row| row.get(0)).optional()?)
}

/// Copies the parts of a row that have no uid, such as the blocks of a track, from another corpus.
pub(crate) fn copy_parts(original: StoredRowPlace<'_>, copy: StoredRowPlace<'_>, table: &str) -> CorpusResult<()> {
    let (from, into) = (original.connection, copy.connection);
    let (old, new) = (original.id, copy.id);
    match table {
        "track" => {
            let sql = "SELECT channel_group, first_frame, frames, b.hash, b.data FROM track_block t
                       JOIN block b ON b.hash = t.hash WHERE track_id = ?1";
            from.visit_rows(sql, [old], |row| {
                let (group, first, frames): (String, i64, i64) = (row.get(0)?, row.get(1)?, row.get(2)?);
                let (hash, data): (Vec<u8>, Vec<u8>) = (row.get(3)?, row.get(4)?);
                super::stored_tracks::ensure_group(into, &group)?;
                into.change_rows(
                    "INSERT OR IGNORE INTO block (hash, data) VALUES (?1, ?2)",
                    params![hash, data],
                )?;
                into.change_rows(
                    "INSERT INTO track_block (track_id, channel_group, first_frame, frames, hash)
                     VALUES (?1, ?2, ?3, ?4, ?5)",
                    params![new, group, first, frames, hash],
                )?;
                Ok(())
            })?;
        }
        "token" => copy_rows(original, copy, "token_value", "token_id")?,
        "recipe" => copy_rows(original, copy, "recipe_input", "recipe_id")?,
        "sign" => {
            let sql = "SELECT language, text FROM sign_text WHERE sign_id = ?1";
            from.visit_rows(sql, [old], |row| {
                let (language, text): (String, String) = (row.get(0)?, row.get(1)?);
                into.change_rows(
                    "INSERT OR IGNORE INTO sign_text (sign_id, language, text) VALUES (?1, ?2, ?3)",
                    params![new, language, text],
                )?;
                Ok(())
            })?;
        }
        _ => {}
    }
    Ok(())
}

/// Copies the rows of a part table; references to rows that both corpora have are matched by uid.
fn copy_rows(original: StoredRowPlace<'_>, copy: StoredRowPlace<'_>, part: &str, owner: &str) -> CorpusResult<()> {
    let (from, into) = (original.connection, copy.connection);
    let (old, new) = (original.id, copy.id);
    let row_count: i64 = into.query_row(
        &format!("SELECT count(*) FROM main.{part} WHERE {owner} = ?1"),
        [new],
        |row| row.get(0),
    )?;
    // Parts without uids cannot be matched one by one, so that those of this side stay as they are.
    if row_count > 0 {
        return Ok(());
    }
    let image = row_image(&load_table_columns(from, part)?, "r");
    let sql = format!("SELECT {image} FROM main.{part} AS r WHERE {owner} = ?1 ORDER BY id");
    let mut statement = from.prepare(&sql)?;
    let rows: Vec<String> = statement
        .query_map([old], |row| row.get(0))?
        .collect::<rusqlite::Result<_>>()?;
    for text in rows {
        let Ok(mut image) = serde_json::from_str::<RowImage>(&text) else {
            continue;
        };
        for (column, value) in &mut image {
            let Some(other) = refers_to(part, column) else {
                continue;
            };
            let Some(id) = value.as_i64() else { continue };
            let uid = uid_of(from, other, id)?;
            let sql = format!("SELECT id FROM main.{other} WHERE uid = unhex(?1)");
            let here: Option<i64> = match uid {
                Some(uid) => into.find_value(&sql, [uid])?,
                None => None,
            };
            *value = here.map_or(Value::Null, Value::from);
        }
        image.insert(owner.to_owned(), Value::from(new));
        insert_row_image(into, part, &image)?;
    }
    Ok(())
}

/// Returns the token of an annotation.
pub(crate) fn token_of(connection: &Connection, annotation: i64) -> CorpusResult<Option<i64>> {
    let sql = "SELECT id FROM token WHERE annotation_id = ?1";
    let mut statement = connection.prepare_cached(sql)?;
    Ok(statement.query_row([annotation], |row| row.get(0)).optional()?)
}

/// Returns the entries of the corpus's own notes whose keys begin with `prefix`, by key.
pub(crate) fn list_corpus_notes(connection: &Connection, prefix: &str) -> CorpusResult<Vec<(String, String)>> {
    // A prefix of letters such as `_` would be a wildcard of LIKE.
    let sql = "SELECT key, value FROM meta WHERE substr(key, 1, length(?1)) = ?1 ORDER BY key";
    connection.read_rows(sql, [prefix], |row| Ok((row.get(0)?, row.get(1)?)))
}

/// Returns the annotations of a recording's adjudicated tiers between whose two candidates nobody has decided.
pub(crate) fn undecided_adjudications(connection: &Connection, recording: i64) -> CorpusResult<BTreeSet<i64>> {
    let sql = "SELECT a.id FROM tier t JOIN annotation a ON a.tier_id = t.id
         WHERE t.recording_id = ?1 AND t.annotator = ?2 AND hex(a.uid) IN (
             SELECT json_extract(value, '$.uid') FROM meta
             WHERE key >= 'conflict:' AND key < 'conflict;' AND json_extract(value, '$.decided') IS NULL)";
    connection.read_values(sql, params![recording, ADJUDICATION_ANNOTATOR])
}

/// Writes an entry of the corpus's own notes.
pub(crate) fn set_note(connection: &Connection, key: &str, value: &str) -> CorpusResult<()> {
    let stored_value: Option<String> = connection.find_value("SELECT value FROM meta WHERE key = ?1", [key])?;
    // An update that changes nothing would still be recorded as a change.
    let sql = match stored_value {
        Some(known) if known == value => return Ok(()),
        Some(_) => "UPDATE meta SET value = ?2 WHERE key = ?1",
        None => "INSERT INTO meta (key, value) VALUES (?1, ?2)",
    };
    connection.change_rows(sql, [key, value])
}

/// The beginning of the notes that keep a forgotten person from coming back with a copy that knows the person. What follows
/// is a hash of a random identity, by which nobody can be found.
const FORGOTTEN_ROW_PREFIX: &str = "forgotten:";

/// Returns the note for a signer or recording that is forgotten.
pub(crate) fn forgotten_row_note(uid: &str) -> String {
    let hash = Sha256::digest(uid.to_uppercase().as_bytes());
    format!("{FORGOTTEN_ROW_PREFIX}{}", to_hex_text(&hash))
}

/// Returns the notes of all signers and recordings that were forgotten.
pub(crate) fn list_forgotten_rows(connection: &Connection) -> CorpusResult<BTreeSet<String>> {
    let notes = list_corpus_notes(connection, FORGOTTEN_ROW_PREFIX)?;
    Ok(notes.into_iter().map(|(key, _)| key).collect())
}

/// Reports whether anything refers to a sign.
pub(crate) fn sign_is_used(connection: &Connection, sign: i64) -> CorpusResult<bool> {
    let sql = "SELECT EXISTS (SELECT 1 FROM token WHERE sign_id = ?1)
        OR EXISTS (SELECT 1 FROM sign_relation WHERE ?1 IN (sign_id, related_id))";
    connection.read_value(sql, [sign])
}

/// Reports whether a track has numbers.
pub(crate) fn has_blocks(connection: &Connection, track: i64) -> CorpusResult<bool> {
    let sql = "SELECT EXISTS (SELECT 1 FROM track_block WHERE track_id = ?1)";
    connection.read_value(sql, [track])
}

/// Reports whether other rows refer to a row; its own parts and derived tokens do not count.
pub(crate) fn is_referred_to(connection: &Connection, table: &str, id: i64) -> CorpusResult<bool> {
    for (other, references) in TRACKED_TABLE_REFERENCES {
        let follows = table == "annotation" && ["token", "token_value"].contains(&other);
        if follows || PART_TABLES_BY_OWNER.contains(&(table, other)) {
            continue;
        }
        for (column, _) in references.iter().filter(|reference| reference.1 == table) {
            let sql = format!("SELECT EXISTS (SELECT 1 FROM main.{other} WHERE {column} = ?1)");
            if connection.read_value(&sql, [id])? {
                return Ok(true);
            }
        }
    }
    Ok(false)
}

/// The tables of rows that are a part of another row: the table, its column for the other row, and that row's table.
const OWNED_TABLE_COLUMNS: [(&str, &str, &str); 15] = [
    ("source_file", "recording_id", "recording"),
    ("track", "recording_id", "recording"),
    ("channel", "track_id", "track"),
    ("tier", "recording_id", "recording"),
    ("tier", "parent_id", "tier"),
    ("annotation", "tier_id", "tier"),
    ("annotation", "parent_id", "annotation"),
    ("token", "recording_id", "recording"),
    ("token", "annotation_id", "annotation"),
    ("token", "sign_id", "sign"),
    ("attribute", "token_id", "token"),
    ("notation", "token_id", "token"),
    ("recipe", "recording_id", "recording"),
    ("study_participant", "study_id", "study"),
    ("study_answer", "participant_id", "study_participant"),
];

/// Returns the owners of a row, with references by uid: the rows that it is a part of.
pub(crate) fn image_owner_keys(table: &str, image: &RowImage) -> Vec<TableRowKey> {
    let owner_rules = OWNED_TABLE_COLUMNS.iter().filter(|rule| rule.0 == table);
    owner_rules
        .filter_map(|(_, column, owner)| {
            let uid = image.get(*column)?.as_str()?;
            Some(((*owner).to_owned(), uid.to_owned()))
        })
        .collect()
}

/// Returns the rows to which a row, with references by uid, refers without being a part of them.
pub(crate) fn image_needed_keys(table: &str, image: &RowImage) -> Vec<TableRowKey> {
    let is_owner = |column: &str| {
        OWNED_TABLE_COLUMNS
            .iter()
            .any(|rule| (rule.0, rule.1) == (table, column))
    };
    image
        .iter()
        .filter(|(column, _)| !is_owner(column))
        .filter_map(|(column, value)| {
            let other = refers_to(table, column)?;
            Some((other.to_owned(), value.as_str()?.to_owned()))
        })
        .collect()
}

/// Returns the rows that are a part of a row: their tables, uids and numbers.
pub(crate) fn find_owned_rows(
    connection: &Connection,
    table: &str,
    id: i64,
) -> CorpusResult<Vec<(&'static str, String, i64)>> {
    let mut all = Vec::new();
    for (part, column, _) in OWNED_TABLE_COLUMNS.iter().filter(|rule| rule.2 == table) {
        let sql = format!("SELECT hex(uid), id FROM main.{part} WHERE {column} = ?1 ORDER BY id");
        let mut statement = connection.prepare_cached(&sql)?;
        let rows = statement.query_map([id], |row| Ok((*part, row.get(0)?, row.get(1)?)))?;
        for row in rows {
            all.push(row?);
        }
    }
    Ok(all)
}

/// Tables whose rows are parts of a row of another table.
const PART_TABLES_BY_OWNER: [(&str, &str); 6] = [
    ("track", "track_block"),
    ("sign", "sign_text"),
    ("token", "token_value"),
    ("token", "notation"),
    ("token", "attribute"),
    ("recipe", "recipe_input"),
];

/// Deletes the parts of a row.
pub(crate) fn delete_parts(connection: &Connection, table: &str, id: i64) -> CorpusResult<()> {
    for (_, part) in PART_TABLES_BY_OWNER.iter().filter(|entry| entry.0 == table) {
        let sql = format!("DELETE FROM main.{part} WHERE {table}_id = ?1");
        connection.change_rows(&sql, [id])?;
    }
    Ok(())
}
