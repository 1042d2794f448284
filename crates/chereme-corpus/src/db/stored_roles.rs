//! The rows of `tier_role`: the roles of tiers that programs wrote this corpus with.
//!
//! The schema has no list of roles. A program adds those that it knows when it opens a corpus, and `tier.role` refers to
//! these rows. A row that a program does not know is one of a newer program, whose tiers and history it cannot read.

use std::collections::BTreeSet;

use chereme_sign::TierRole;
use rusqlite::Connection;

use crate::error::CorpusResult;

/// Returns the roles that the corpus lists.
fn list_corpus_roles(connection: &Connection) -> CorpusResult<BTreeSet<String>> {
    let mut statement = connection.prepare("SELECT name FROM tier_role")?;
    let names = statement.query_map([], |row| row.get(0))?;
    Ok(names.collect::<rusqlite::Result<_>>()?)
}

/// Returns the roles in the corpus that this program does not know.
pub(super) fn find_unknown_roles(connection: &Connection) -> CorpusResult<Vec<String>> {
    let mut roles = list_corpus_roles(connection)?;
    for known in TierRole::all_words() {
        roles.remove(known.usual_kind_name());
    }
    Ok(roles.into_iter().collect())
}

/// Adds the roles that this program knows and the corpus does not have yet.
pub(super) fn add_missing(connection: &Connection) -> CorpusResult<()> {
    let roles = list_corpus_roles(connection)?;
    for role in TierRole::all_words() {
        if !roles.contains(role.usual_kind_name()) {
            connection.execute(
                "INSERT OR IGNORE INTO tier_role (name, note) VALUES (?1, ?2)",
                [role.usual_kind_name(), role.note],
            )?;
        }
    }
    Ok(())
}
