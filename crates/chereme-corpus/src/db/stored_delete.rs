//! Rows that go with a recording or a sign.

use rusqlite::Connection;
use serde::Serialize;

use crate::db::cached_sql::CachedSql;
use crate::error::CorpusResult;

/// The number of rows that belong to a recording.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct RecordingBelongings {
    /// Its tracks of every kind.
    pub tracks: u64,
    /// Its tiers.
    pub tiers: u64,
    /// The annotations on its tiers.
    pub annotations: u64,
    /// Its tokens.
    pub tokens: u64,
}

/// Counts the rows that belong to a recording.
pub(crate) fn count_recording_belongings(connection: &Connection, recording: i64) -> CorpusResult<RecordingBelongings> {
    let sql = "SELECT (SELECT count(*) FROM track WHERE recording_id = ?1),
                 (SELECT count(*) FROM tier WHERE recording_id = ?1),
                 (SELECT count(*) FROM annotation a JOIN tier t ON t.id = a.tier_id
                  WHERE t.recording_id = ?1),
                 (SELECT count(*) FROM token WHERE recording_id = ?1)";
    let row = connection.read_row(sql, [recording], |row| {
        let count = |at: usize| row.get::<_, u32>(at).map(u64::from);
        Ok(RecordingBelongings {
            tracks: count(0)?,
            tiers: count(1)?,
            annotations: count(2)?,
            tokens: count(3)?,
        })
    })?;
    Ok(row)
}

/// Deletes a recording with everything that belongs to it; the blocks of its movement stay, for undo.
///
/// Other recipes lose the reference to it. A file that a notation elsewhere came from stays, without a recording, and
/// a skeleton goes with the last track that has it.
pub(crate) fn delete_recording(connection: &Connection, recording: i64) -> CorpusResult<()> {
    const RECORDING_TRACKS_SQL: &str = "(SELECT id FROM track WHERE recording_id = ?1)";
    const RECORDING_TOKENS_SQL: &str = "(SELECT id FROM token WHERE recording_id = ?1)";
    const RECORDING_TIERS_SQL: &str = "(SELECT id FROM tier WHERE recording_id = ?1)";
    const RECORDING_RECIPES_SQL: &str = "(SELECT id FROM recipe WHERE recording_id = ?1)";
    // They are noted before their tracks go, which alone name them.
    let skeletons: Vec<i64> = connection.read_values(
        "SELECT DISTINCT skeleton_id FROM track
             WHERE recording_id = ?1 AND skeleton_id IS NOT NULL ORDER BY skeleton_id",
        [recording],
    )?;
    // Tokens go first: each deleted annotation would otherwise look for the tokens that it says something about.
    for sql in [
        format!("DELETE FROM recipe_input WHERE recipe_id IN {RECORDING_RECIPES_SQL}"),
        "DELETE FROM recipe WHERE recording_id = ?1".to_owned(),
        "UPDATE recipe_input SET recording_id = NULL WHERE recording_id = ?1".to_owned(),
        format!("DELETE FROM notation WHERE token_id IN {RECORDING_TOKENS_SQL}"),
        format!("DELETE FROM attribute WHERE token_id IN {RECORDING_TOKENS_SQL}"),
        format!("DELETE FROM token_value WHERE token_id IN {RECORDING_TOKENS_SQL}"),
        "DELETE FROM token WHERE recording_id = ?1".to_owned(),
        format!("DELETE FROM annotation WHERE tier_id IN {RECORDING_TIERS_SQL}"),
        "DELETE FROM tier WHERE recording_id = ?1".to_owned(),
        format!("DELETE FROM track_block WHERE track_id IN {RECORDING_TRACKS_SQL}"),
        format!("DELETE FROM channel WHERE track_id IN {RECORDING_TRACKS_SQL}"),
        "DELETE FROM track WHERE recording_id = ?1".to_owned(),
        "UPDATE source_file SET recording_id = NULL WHERE recording_id = ?1
             AND id IN (SELECT source_file_id FROM notation)"
            .to_owned(),
        "DELETE FROM source_file WHERE recording_id = ?1".to_owned(),
        "DELETE FROM recording WHERE id = ?1".to_owned(),
    ] {
        connection.change_rows(&sql, [recording])?;
    }
    for skeleton in skeletons {
        connection.change_rows(
            "DELETE FROM skeleton WHERE id = ?1
                 AND NOT EXISTS (SELECT 1 FROM track WHERE skeleton_id = ?1)",
            [skeleton],
        )?;
    }
    Ok(())
}

/// Deletes a sign that has no token any more, with its translations, relations and remarks.
pub(crate) fn delete_sign(connection: &Connection, sign: i64) -> CorpusResult<()> {
    for sql in [
        "DELETE FROM sign_text WHERE sign_id = ?1",
        "DELETE FROM sign_relation WHERE ?1 IN (sign_id, related_id)",
        "DELETE FROM sign WHERE id = ?1",
    ] {
        connection.change_rows(sql, [sign])?;
    }
    Ok(())
}

/// Makes the oldest moving token of a sign its citation form if no moving token is.
pub(crate) fn cite_another(connection: &Connection, sign: i64) -> CorpusResult<()> {
    let sql = "UPDATE token SET citation = 1
             WHERE id = (SELECT min(id) FROM token WHERE sign_id = ?1 AND recording_id IS NOT NULL)
               AND NOT EXISTS (SELECT 1 FROM token
                               WHERE sign_id = ?1 AND recording_id IS NOT NULL AND citation = 1)";
    connection.change_rows(sql, [sign])
}
