//! The tables whose changes history records, and the triggers that record them.

use rusqlite::Connection;
use serde_json::Value;

use crate::db::cached_sql::CachedSql;
use crate::error::CorpusResult;

/// The tables whose rows are recorded, and for each the columns that refer to a row with a uid.
pub(in crate::db) const TRACKED_TABLE_REFERENCES: [(&str, &[(&str, &str)]); 28] = [
    ("meta", &[]),
    ("lexicon", &[]),
    ("signer", &[]),
    ("person_alias", &[("signer_id", "signer")]),
    ("person_attribute", &[("signer_id", "signer")]),
    ("skeleton", &[]),
    ("recording", &[("signer_id", "signer"), ("lexicon_id", "lexicon")]),
    (
        "source_file",
        &[("recording_id", "recording"), ("lexicon_id", "lexicon")],
    ),
    ("track", &[("recording_id", "recording"), ("skeleton_id", "skeleton")]),
    ("track_block", &[("track_id", "track")]),
    ("channel", &[("track_id", "track")]),
    ("inventory", &[]),
    ("inventory_value", &[("inventory_id", "inventory")]),
    (
        "tier",
        &[
            ("recording_id", "recording"),
            ("parent_id", "tier"),
            ("inventory_id", "inventory"),
        ],
    ),
    ("annotation", &[("tier_id", "tier"), ("parent_id", "annotation")]),
    ("sign", &[("lexicon_id", "lexicon")]),
    ("sign_text", &[("sign_id", "sign")]),
    ("sign_relation", &[("sign_id", "sign"), ("related_id", "sign")]),
    (
        "token",
        &[
            ("sign_id", "sign"),
            ("recording_id", "recording"),
            ("annotation_id", "annotation"),
        ],
    ),
    (
        "token_value",
        &[
            ("token_id", "token"),
            ("inventory_id", "inventory"),
            ("annotation_id", "annotation"),
        ],
    ),
    ("notation", &[("token_id", "token"), ("source_file_id", "source_file")]),
    ("attribute", &[("token_id", "token")]),
    ("recipe", &[("recording_id", "recording")]),
    (
        "recipe_input",
        &[
            ("recipe_id", "recipe"),
            ("recording_id", "recording"),
            ("token_id", "token"),
        ],
    ),
    ("kept_search", &[]),
    ("study", &[]),
    ("study_participant", &[("study_id", "study")]),
    ("study_answer", &[("participant_id", "study_participant")]),
];

/// Changes that affect what the search index stores about tokens: table, event, and the affected tokens.
const TOKEN_TOUCHING_CHANGES: [(&str, &str, &str); 12] = [
    (
        "lexicon",
        "UPDATE",
        "WHERE t.sign_id IN (SELECT id FROM main.sign WHERE lexicon_id = NEW.id)",
    ),
    ("source_file", "INSERT", "WHERE t.recording_id = NEW.recording_id"),
    ("source_file", "DELETE", "WHERE t.recording_id = OLD.recording_id"),
    ("sign", "UPDATE", "WHERE t.sign_id = NEW.id"),
    ("sign_text", "INSERT", "WHERE t.sign_id = NEW.sign_id"),
    ("sign_text", "UPDATE", "WHERE t.sign_id = NEW.sign_id"),
    ("sign_text", "DELETE", "WHERE t.sign_id = OLD.sign_id"),
    ("recording", "UPDATE", "WHERE t.recording_id = NEW.id"),
    (
        "signer",
        "INSERT",
        "WHERE t.recording_id IN (SELECT recording_id FROM main.tier WHERE participant = NEW.name)",
    ),
    (
        "signer",
        "UPDATE",
        "WHERE t.recording_id IN (SELECT id FROM main.recording WHERE signer_id = NEW.id
         UNION SELECT recording_id FROM main.tier WHERE participant IN (OLD.name, NEW.name))",
    ),
    (
        "signer",
        "DELETE",
        "WHERE t.recording_id IN (SELECT recording_id FROM main.tier WHERE participant = OLD.name)",
    ),
    ("tier", "UPDATE", "WHERE t.recording_id = NEW.recording_id"),
];

/// Changes of annotations affect the index of tokens at the same time: event, row, start and end of the change.
const ANNOTATION_TOUCHING_CHANGES: [(&str, &str, &str, &str); 3] = [
    ("INSERT", "NEW", "NEW.start_us", "NEW.end_us"),
    (
        "UPDATE",
        "NEW",
        "min(OLD.start_us, NEW.start_us)",
        "max(OLD.end_us, NEW.end_us)",
    ),
    ("DELETE", "OLD", "OLD.start_us", "OLD.end_us"),
];

/// Creates this connection's triggers, which record every change of a tracked table.
pub(in crate::db) fn create_change_triggers(connection: &Connection) -> CorpusResult<()> {
    let mut sql = String::from(
        "CREATE TEMP TABLE change (
             seq INTEGER PRIMARY KEY, tbl TEXT NOT NULL, kind TEXT NOT NULL,
             before TEXT, after TEXT, refs TEXT NOT NULL);
         CREATE TEMP TABLE touched (token_id INTEGER PRIMARY KEY);",
    );
    for (table, references) in TRACKED_TABLE_REFERENCES {
        let columns = load_table_columns(connection, table)?;
        for (kind, event) in [("i", "INSERT"), ("u", "UPDATE"), ("d", "DELETE")] {
            let image = |row: &str| row_image(&columns, row);
            let (before, after) = match kind {
                "i" => ("NULL".to_owned(), image("NEW")),
                "u" => (image("OLD"), image("NEW")),
                _ => (image("OLD"), "NULL".to_owned()),
            };
            // A deleted row has only its former references.
            let row = if kind == "d" { "OLD" } else { "NEW" };
            let reference_columns: Vec<String> = references
                .iter()
                .map(|(column, other)| {
                    format!("'{column}',(SELECT hex(uid) FROM main.{other} WHERE id={row}.{column})")
                })
                .collect();
            let refs = reference_columns.join(",");
            sql.push_str(&format!(
                "CREATE TEMP TRIGGER record_{table}_{kind} AFTER {event} ON main.{table} BEGIN
                 INSERT INTO temp.change (tbl, kind, before, after, refs)
                 VALUES ('{table}', '{kind}', {before}, {after}, json_object({refs})); END;"
            ));
        }
    }
    for (table, column) in [("token", "id"), ("token_value", "token_id")] {
        for (event, row) in [("INSERT", "NEW"), ("UPDATE", "NEW"), ("DELETE", "OLD")] {
            sql.push_str(&format!(
                "CREATE TEMP TRIGGER touch_{table}_{event} AFTER {event} ON main.{table} BEGIN
                 INSERT OR IGNORE INTO temp.touched VALUES ({row}.{column}); END;"
            ));
        }
    }
    for (event, row, start, end) in ANNOTATION_TOUCHING_CHANGES {
        sql.push_str(&format!(
            "CREATE TEMP TRIGGER touch_annotation_{event} AFTER {event} ON main.annotation BEGIN
             INSERT OR IGNORE INTO temp.touched SELECT t.id
             FROM main.tier i JOIN main.token t ON t.recording_id = i.recording_id
             WHERE i.id = {row}.tier_id AND i.role IN ('translation', 'comment')
               AND t.end_us > {start} AND t.start_us < {end} AND t.start_us > {start} -
                   (SELECT o.end_us - o.start_us FROM main.token o
                    WHERE o.recording_id = i.recording_id
                    ORDER BY o.end_us - o.start_us DESC LIMIT 1);
             INSERT OR IGNORE INTO temp.touched
             SELECT token_id FROM main.token_value WHERE annotation_id = {row}.id; END;"
        ));
    }
    for (table, event, tokens) in TOKEN_TOUCHING_CHANGES {
        sql.push_str(&format!(
            "CREATE TEMP TRIGGER touch_{table}_{event} AFTER {event} ON main.{table} BEGIN
             INSERT OR IGNORE INTO temp.touched SELECT t.id FROM main.token t {tokens}; END;"
        ));
    }
    connection.execute_batch(&sql)?;
    Ok(())
}

/// A column of a tracked table.
pub(in crate::db) struct TrackedColumn {
    pub(in crate::db) name: String,
    /// Whether it holds bytes, which are hexadecimal in JSON.
    pub(in crate::db) blob: bool,
    /// Whether it holds floating-point numbers, which need 17 digits in JSON.
    real: bool,
}

/// Returns the columns of a table in their order.
pub(in crate::db) fn load_table_columns(connection: &Connection, table: &str) -> CorpusResult<Vec<TrackedColumn>> {
    let sql = "SELECT name, type FROM pragma_table_info(?1) ORDER BY cid";
    connection.read_rows(sql, [table], |row| {
        Ok(TrackedColumn {
            name: row.get(0)?,
            blob: row.get::<_, String>(1)? == "BLOB",
            real: row.get::<_, String>(1)? == "REAL",
        })
    })
}

/// Returns the SQL expression for a row as JSON.
pub(in crate::db) fn row_image(columns: &[TrackedColumn], row: &str) -> String {
    let fields: Vec<String> = columns
        .iter()
        .map(|TrackedColumn { name, blob, real }| match (blob, real) {
            (true, _) => format!("'{name}',hex({row}.{name})"),
            // SQLite writes 15 digits of a number into JSON by itself.
            (_, true) => format!(
                "'{name}',iif(abs({row}.{name}) < 1e300, json(printf('%!.17g', {row}.{name})), \
                 {row}.{name})"
            ),
            _ => format!("'{name}',{row}.{name}"),
        })
        .collect();
    format!("json_object({})", fields.join(","))
}

/// Returns the table that a column of a tracked table refers to.
pub(crate) fn refers_to(table: &str, column: &str) -> Option<&'static str> {
    let (_, references) = TRACKED_TABLE_REFERENCES.iter().find(|tracked| tracked.0 == table)?;
    let (_, other) = references.iter().find(|reference| reference.0 == column)?;
    Some(other)
}

/// Returns the SQL expression for a column's value in the JSON row `?1`.
pub(in crate::db) fn column_from_image_sql(column: &TrackedColumn) -> String {
    let name = &column.name;
    if column.blob {
        // The image of a null is the same as that of no bytes, and no column holds no bytes.
        format!("unhex(nullif(json_extract(?1, '$.{name}'), ''))")
    } else {
        format!("json_extract(?1, '$.{name}')")
    }
}

/// Reports whether two values of row images are equal; earlier versions wrote numbers with 15 digits.
pub(crate) fn are_image_values_equal(a: &Value, b: &Value) -> bool {
    /// The largest relative error of a number with 15 digits.
    const MAX_RELATIVE_NUMBER_ERROR: f64 = 1e-14;
    if a == b {
        return true;
    }
    match (a.as_f64(), b.as_f64()) {
        // Whole numbers are exact in JSON, so only fractions may differ.
        (Some(x), Some(y)) if a.is_f64() || b.is_f64() => {
            (x - y).abs() <= MAX_RELATIVE_NUMBER_ERROR * x.abs().max(y.abs())
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Row = (Option<f64>, Option<Vec<u8>>, Option<String>, Option<i64>);

    #[test]
    fn a_row_restored_from_its_image_is_unchanged() {
        let connection = Connection::open_in_memory().expect("opened");
        let table = "CREATE TABLE t (x REAL, b BLOB, s TEXT, n INTEGER) STRICT";
        connection.execute_batch(table).expect("created");
        let all = load_table_columns(&connection, "t").expect("columns");
        let values: Vec<String> = all.iter().map(column_from_image_sql).collect();
        let image = format!("SELECT {} FROM t AS r", row_image(&all, "r"));
        let insert = format!("INSERT INTO t VALUES ({})", values.join(","));
        let mut state = 1_u64;
        let random = std::iter::repeat_with(|| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        });
        let special = [0.0, -0.1, 1e-300, 1e300, f64::MAX, f64::INFINITY, 1.0 / 3.0, 2e15 + 0.5];
        let numbers = special.into_iter().map(Some).chain([None]);
        for x in numbers.chain(random.take(3000).map(Some)) {
            let row: Row = (x, x.map(|_| vec![0, 255]), x.map(|it| it.to_string()), x.map(|_| 7));
            connection.execute("DELETE FROM t", []).expect("deleted");
            let sql = "INSERT INTO t VALUES (?1, ?2, ?3, ?4)";
            connection
                .execute(sql, (row.0, &row.1, &row.2, row.3))
                .expect("inserted");
            let text: String = connection.query_row(&image, [], |it| it.get(0)).expect("an image");
            connection.execute("DELETE FROM t", []).expect("deleted");
            connection.execute(&insert, [&text]).expect("inserted");
            let again: Row = connection
                .query_row("SELECT * FROM t", [], |it| {
                    Ok((it.get(0)?, it.get(1)?, it.get(2)?, it.get(3)?))
                })
                .expect("a row");
            assert_eq!(again, row, "{text}");
        }
    }

    #[test]
    fn numbers_with_15_digits_are_alike_and_others_are_not() {
        let third = Value::from(1.0 / 3.0);
        assert!(are_image_values_equal(&third, &Value::from(0.333_333_333_333_333)));
        assert!(!are_image_values_equal(&third, &Value::from(0.333_333_333_333)));
        assert!(
            !are_image_values_equal(&Value::from(1), &Value::from(2)) && !are_image_values_equal(&third, &Value::Null)
        );
    }
}
