//! SQL statements that only edits of annotations, tiers, recordings and signs need.

use rusqlite::{Connection, params};

use super::stored_recordings::{RecordingRow, SignerRow};
use crate::db::cached_sql::CachedSql;
use crate::db::stored_columns::NamedColumn;
use crate::error::CorpusResult;

/// Allows references to missing rows until the transaction ends, so that rows can be written in any order.
pub(crate) fn defer_references(connection: &Connection) -> CorpusResult<()> {
    connection.execute_batch("PRAGMA defer_foreign_keys = ON;")?;
    Ok(())
}

/// Returns the annotations with the id `id` in their file, of one recording or of all.
pub(crate) fn find_annotations_by_id(
    connection: &Connection,
    recording: Option<i64>,
    id: &str,
) -> CorpusResult<Vec<i64>> {
    let sql = "SELECT a.id FROM annotation a JOIN tier t ON t.id = a.tier_id
         WHERE a.external_id = ?1 AND t.recording_id = coalesce(?2, t.recording_id) ORDER BY a.id";
    connection.read_values(sql, params![id, recording])
}

/// Returns the values of a tier's annotations, and the number of annotations that have each.
pub(crate) fn values_of_tier(connection: &Connection, tier: i64) -> CorpusResult<Vec<(String, i64)>> {
    let sql = "SELECT value, count(*) FROM annotation WHERE tier_id = ?1 AND state = 'value'
         GROUP BY value ORDER BY value";
    connection.read_rows(sql, [tier], |row| Ok((row.get(0)?, row.get(1)?)))
}

/// Deletes the annotations of a tier, and returns their number.
pub(crate) fn delete_annotations(connection: &Connection, tier: i64) -> CorpusResult<usize> {
    let deleted = connection.count_changes("DELETE FROM annotation WHERE tier_id = ?1", [tier])?;
    Ok(deleted)
}

/// Replaces the value `old` by `new` in the annotations that realise a sign, and returns the number of changed
/// annotations.
pub(crate) fn replace_gloss_values(connection: &Connection, sign: i64, old: &str, new: &str) -> CorpusResult<usize> {
    let sql = "UPDATE annotation SET value = ?2, origin = 'human', confidence = NULL,
                 source = json_set(source, '$.entry', NULL)
             WHERE state = 'value' AND trim(value) IN (?1, ?1 || '#1')
               AND id IN (SELECT annotation_id FROM token WHERE sign_id = ?3)";
    let changed = connection.count_changes(sql, params![old, new, sign])?;
    Ok(changed)
}

/// Writes a recording's row again; its `signer` is not used.
pub(crate) fn update_recording(connection: &Connection, row: &RecordingRow) -> CorpusResult<()> {
    let sql = "UPDATE recording SET name = ?2, signer_id = ?3, origin = ?4, licence = ?5, notes = ?6
             WHERE id = ?1";
    let values = params![
        row.id,
        row.name,
        row.signer_id,
        NamedColumn(row.origin),
        row.licence,
        row.notes
    ];
    connection.change_rows(sql, values)?;
    // A token repeats the origin of its recording, and would contradict it otherwise.
    connection.change_rows(
        "UPDATE token SET origin = ?2 WHERE recording_id = ?1 AND origin <> ?2",
        params![row.id, NamedColumn(row.origin)],
    )
}

/// Writes a signer's row again.
pub(crate) fn update_signer(connection: &Connection, row: &SignerRow) -> CorpusResult<()> {
    let sql = "UPDATE signer SET name = ?2, handedness = ?3, notes = ?4 WHERE id = ?1";
    connection.change_rows(sql, params![row.id, row.name, row.handedness, row.notes])
}

/// Renames a participant on all tiers, and returns their number.
pub(crate) fn rename_participant(connection: &Connection, old: &str, new: &str) -> CorpusResult<usize> {
    connection.count_changes("UPDATE tier SET participant = ?2 WHERE participant = ?1", [old, new])
}

/// Renames an annotator on all tiers, and returns their number.
pub(crate) fn rename_annotator(connection: &Connection, old: &str, new: &str) -> CorpusResult<usize> {
    connection.count_changes("UPDATE tier SET annotator = ?2 WHERE annotator = ?1", [old, new])
}

/// Returns the recordings with a tier of an annotator.
pub(crate) fn recordings_of_annotator(connection: &Connection, name: &str) -> CorpusResult<Vec<i64>> {
    let sql = "SELECT DISTINCT recording_id FROM tier WHERE annotator = ?1 ORDER BY 1";
    connection.read_values(sql, [name])
}

/// Returns the recordings that show a signer: the signer's own, and those with tiers for that participant.
pub(crate) fn recordings_of_signer(connection: &Connection, signer: i64) -> CorpusResult<Vec<i64>> {
    // A participant of a tier is linked to a signer by name alone, without a row.
    let sql = "SELECT id FROM recording WHERE signer_id = ?1
         UNION SELECT i.recording_id FROM tier i JOIN signer g ON g.name = i.participant
         WHERE g.id = ?1 ORDER BY 1";
    connection.read_values(sql, [signer])
}

/// Replaces a sign's gloss with the number of the entry, and its notes.
pub(crate) fn update_sign(
    connection: &Connection,
    sign: i64,
    entry: (&str, i64),
    notes: Option<&str>,
) -> CorpusResult<()> {
    let sql = "UPDATE sign SET gloss = ?2, homonym = nullif(?3, 1), notes = ?4
             WHERE id = ?1 AND (gloss <> ?2 OR ifnull(homonym, 1) <> ?3 OR notes IS NOT ?4)";
    connection.change_rows(sql, params![sign, entry.0, entry.1, notes])
}

/// Returns the gloss and the notes of a sign.
pub(crate) fn sign_gloss_and_notes(connection: &Connection, sign: i64) -> CorpusResult<(String, Option<String>)> {
    connection.read_row("SELECT gloss, notes FROM sign WHERE id = ?1", [sign], |row| {
        Ok((row.get(0)?, row.get(1)?))
    })
}

/// Removes a translation of a sign, and returns whether it existed.
pub(crate) fn remove_text(connection: &Connection, sign: i64, language: &str, text: &str) -> CorpusResult<bool> {
    let sql = "DELETE FROM sign_text WHERE sign_id = ?1 AND language = ?2 AND text = ?3";
    let removed = connection.count_changes(sql, params![sign, language, text])?;
    Ok(removed > 0)
}

/// Makes a token the only citation form of its sign.
pub(crate) fn set_citation_token(connection: &Connection, sign: i64, token: i64) -> CorpusResult<()> {
    let sql = "UPDATE token SET citation = (id = ?2) WHERE sign_id = ?1 AND citation <> (id = ?2)";
    connection.change_rows(sql, [sign, token])
}
