//! Finds the recordings whose faces, milestones or glosses operations changed, so that all others stay prepared.

use std::collections::BTreeSet;

use rusqlite::Connection;
use serde_json::Value;

use crate::db::stored_history::{self, RowChange};
use crate::db::{stored_tiers, stored_tracks};
use crate::error::CorpusResult;

/// The largest number of changed rows that is searched; beyond it reading everything again is as quick.
const MOST_CHANGES: i64 = 20_000;

/// Returns the recordings whose performances the operations after `operation` may have changed; `None` if they may have
/// changed those of all recordings, or if there are too many changes.
pub(super) fn recordings_since(connection: &Connection, operation: i64) -> CorpusResult<Option<BTreeSet<i64>>> {
    let Some(later) = stored_history::operations_since(connection, operation)? else {
        return Ok(None);
    };
    if later.iter().map(|(_, changes)| changes).sum::<i64>() > MOST_CHANGES {
        return Ok(None);
    }
    let mut touched = TouchedRecordings::default();
    for (id, _) in later {
        stored_history::each_change(connection, id, |change| touched.add_row_change(connection, &change))?;
        if touched.all {
            return Ok(None);
        }
    }
    Ok(Some(touched.recordings))
}

#[derive(Default)]
struct TouchedRecordings {
    recordings: BTreeSet<i64>,
    all: bool,
    /// Tiers and tracks that were looked up already.
    known: BTreeSet<(&'static str, i64)>,
}

impl TouchedRecordings {
    fn add_row_change(&mut self, connection: &Connection, change: &RowChange) -> CorpusResult<()> {
        // A row may have moved from one recording to another: both are affected.
        for row in [&change.before, &change.after] {
            if row.is_null() {
                continue;
            }
            match &*change.table {
                "recording" => self.recordings.extend(row_column_number(row, "id")),
                "track" => {
                    self.recordings.extend(row_column_number(row, "recording_id"));
                    // The fit of one take applies to all takes of its signer.
                    let layout = row["layout"].as_str();
                    self.all |= layout.is_some_and(|layout| layout.contains("\"fit\""));
                }
                "tier" => self.recordings.extend(row_column_number(row, "recording_id")),
                "annotation" => self.add_owner(connection, "tier", row_column_number(row, "tier_id"))?,
                "track_block" | "channel" => {
                    self.add_owner(connection, "track", row_column_number(row, "track_id"))?;
                }
                // A new row is used by new recordings only.
                "signer" | "skeleton" => self.all |= !change.before.is_null(),
                _ => {}
            }
        }
        Ok(())
    }

    /// Adds the recording of a tier or track; if the row is gone, its own deletion names the recording.
    fn add_owner(&mut self, connection: &Connection, table: &'static str, id: Option<i64>) -> CorpusResult<()> {
        let Some(id) = id.filter(|id| self.known.insert((table, *id))) else {
            return Ok(());
        };
        self.recordings.extend(match table {
            "tier" => stored_tiers::find_tier_recording(connection, id)?,
            _ => stored_tracks::find_track_recording(connection, id)?,
        });
        Ok(())
    }
}

fn row_column_number(row: &Value, column: &str) -> Option<i64> {
    row[column].as_i64()
}
