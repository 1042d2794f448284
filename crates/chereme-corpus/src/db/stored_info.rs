//! Counts and sizes of rows.

use std::collections::BTreeMap;

use rusqlite::Connection;
use serde::Serialize;

use crate::db::cached_sql::CachedSql;
use crate::db::people::SIGNER_ROWS_SQL;
use crate::db::stored_rows::{InventoryInfo, SignerInfo};
use crate::error::CorpusResult;

const COUNTED_ROW_KINDS: [(&str, &str); 21] = [
    ("recordings", "recording"),
    ("tracks", "track"),
    (
        "points",
        "channel c JOIN track t ON t.id = c.track_id AND t.kind = 'markers'",
    ),
    (
        "curves",
        "channel c JOIN track t ON t.id = c.track_id AND t.kind = 'curves'",
    ),
    ("skeletons", "skeleton"),
    ("signers", "signer"),
    ("lexicons", "lexicon"),
    ("signs", "sign"),
    ("tokens", "token"),
    ("tiers", "tier"),
    ("annotations", "annotation"),
    ("inventories", "inventory"),
    ("values", "inventory_value"),
    ("notations", "notation"),
    ("attributes", "attribute"),
    ("recipes", "recipe"),
    ("searches", "kept_search"),
    ("studies", "study"),
    ("participants", "study_participant"),
    ("answers", "study_answer"),
    ("operations", "operation"),
];

/// The amount of what was captured or generated in tracks of one kind.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct TrackAmount {
    /// Hours of all tracks together.
    pub hours: f64,
    /// Frames of all tracks together.
    pub frames: u64,
}

/// Returns the number of rows of each kind.
pub(crate) fn count_rows_by_kind(connection: &Connection) -> CorpusResult<BTreeMap<&'static str, u64>> {
    let mut counts = BTreeMap::new();
    for (kind, table) in COUNTED_ROW_KINDS {
        let sql = format!("SELECT count(*) FROM {table}");
        counts.insert(kind, query_row_count(connection, &sql)?);
    }
    Ok(counts)
}

fn query_row_count(connection: &Connection, sql: &str) -> CorpusResult<u64> {
    let number: i64 = connection.read_value(sql, [])?;
    Ok(u64::try_from(number).unwrap_or_default())
}

/// Returns the number of recordings by origin.
pub(crate) fn count_recordings_by_origin(connection: &Connection) -> CorpusResult<BTreeMap<String, u64>> {
    grouped(connection, "SELECT origin, count(*) FROM recording GROUP BY origin")
}

/// Returns the number of tokens by origin.
pub(crate) fn count_tokens_by_origin(connection: &Connection) -> CorpusResult<BTreeMap<String, u64>> {
    grouped(connection, "SELECT origin, count(*) FROM token GROUP BY origin")
}

/// Returns the number of tracks by kind.
pub(crate) fn count_tracks_by_kind(connection: &Connection) -> CorpusResult<BTreeMap<String, u64>> {
    grouped(connection, "SELECT kind, count(*) FROM track GROUP BY kind")
}

/// Returns the number of tiers by role; tiers of components are counted by component.
pub(crate) fn count_tiers_by_role(connection: &Connection) -> CorpusResult<BTreeMap<String, u64>> {
    grouped(
        connection,
        "SELECT coalesce(component, role), count(*) FROM tier GROUP BY 1",
    )
}

fn grouped(connection: &Connection, sql: &str) -> CorpusResult<BTreeMap<String, u64>> {
    connection.read_rows(sql, [], |row| Ok((row.get(0)?, row.get::<_, i64>(1)?.unsigned_abs())))
}

/// Returns the amounts of movement, markers and curves in the corpus, by kind of track.
pub(crate) fn sum_track_amounts(connection: &Connection) -> CorpusResult<BTreeMap<String, TrackAmount>> {
    // Frames with times of their own have no rate: their track lasts from the first to the last.
    let sql = "SELECT kind, sum(coalesce(frames * 1.0 * rate_seconds / rate_frames, duration_us / 1e6, 0.0)),
                sum(frames)
         FROM track WHERE kind <> 'media' AND frames IS NOT NULL GROUP BY kind";
    connection.read_rows(sql, [], |row| {
        let amount = TrackAmount {
            hours: row.get::<_, f64>(1)? / 3600.0,
            frames: row.get::<_, i64>(2)?.unsigned_abs(),
        };
        Ok((row.get(0)?, amount))
    })
}

/// Returns the sizes of the file's contents in bytes, by kind of content.
pub(crate) fn content_sizes_bytes(connection: &Connection) -> CorpusResult<BTreeMap<&'static str, u64>> {
    let total = query_row_count(
        connection,
        "SELECT page_count * page_size FROM pragma_page_count, pragma_page_size",
    )?;
    let mut bytes = BTreeMap::new();
    for (what, sql) in [
        ("motion", "SELECT coalesce(sum(length(data)), 0) FROM block"),
        ("history", "SELECT coalesce(sum(length(data)), 0) FROM changeset"),
        ("search", "SELECT coalesce(sum(length(data)), 0) FROM search_file"),
        ("sources", "SELECT coalesce(sum(length(data)), 0) FROM source_file"),
    ] {
        bytes.insert(what, query_row_count(connection, sql)?);
    }
    // The lengths leave out the pages and indices around the contents, which are the rest.
    let rest = total.saturating_sub(bytes.values().sum());
    bytes.insert("rest", rest);
    Ok(bytes)
}

/// Returns the signers by name.
pub(crate) fn load_signer_infos(connection: &Connection) -> CorpusResult<Vec<SignerInfo>> {
    let sql = format!(
        "SELECT name, handedness, (SELECT count(*) FROM recording r WHERE r.signer_id = g.id
             OR EXISTS (SELECT 1 FROM tier i WHERE i.recording_id = r.id AND i.participant = g.name))
         FROM {SIGNER_ROWS_SQL} ORDER BY name"
    );
    connection.read_rows(&sql, [], |row| {
        Ok(SignerInfo {
            name: row.get(0)?,
            handedness: row.get(1)?,
            recordings: row.get::<_, i64>(2)?.unsigned_abs(),
        })
    })
}

/// Returns the inventories, oldest first.
pub(crate) fn load_inventory_infos(connection: &Connection) -> CorpusResult<Vec<InventoryInfo>> {
    let sql = "SELECT key, component || coalesce('.' || feature, ''),
                (SELECT count(*) FROM inventory_value v WHERE v.inventory_id = i.id),
                (SELECT count(*) FROM tier t WHERE t.inventory_id = i.id)
         FROM inventory i ORDER BY id";
    connection.read_rows(sql, [], |row| {
        Ok(InventoryInfo {
            id: row.get(0)?,
            field: row.get(1)?,
            values: row.get::<_, i64>(2)?.unsigned_abs(),
            tiers: row.get::<_, i64>(3)?.unsigned_abs(),
        })
    })
}
