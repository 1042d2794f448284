//! The rows of `tier_role`: the roles of tiers that programs wrote this corpus with.
//!
//! The schema has no list of roles. A program adds those that it knows when it opens a corpus, and `tier.role` refers to
//! these rows. A row that a program does not know is one of a newer program, whose tiers and history it cannot read.

use std::collections::BTreeSet;

use chereme_sign::TierRole;
use rusqlite::Connection;

use crate::error::Result;

/// Returns the roles that the corpus lists.
fn listed(connection: &Connection) -> Result<BTreeSet<String>> {
    let mut statement = connection.prepare("SELECT name FROM tier_role")?;
    let names = statement.query_map([], |row| row.get(0))?;
    Ok(names.collect::<rusqlite::Result<_>>()?)
}

/// Returns the roles in the corpus that this program does not know.
pub(super) fn unknown(connection: &Connection) -> Result<Vec<String>> {
    let mut roles = listed(connection)?;
    for known in TierRole::all_words() {
        roles.remove(known.kind());
    }
    Ok(roles.into_iter().collect())
}

/// Adds the roles that this program knows and the corpus does not have yet.
pub(super) fn add_missing(connection: &Connection) -> Result<()> {
    let roles = listed(connection)?;
    for role in TierRole::all_words() {
        if !roles.contains(role.kind()) {
            connection.execute(
                "INSERT OR IGNORE INTO tier_role (name, note) VALUES (?1, ?2)",
                [role.kind(), role.note],
            )?;
        }
    }
    Ok(())
}
