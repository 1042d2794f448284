//! Rows of saved searches.

use rusqlite::{Connection, params};

use crate::db::stored_rows::KeptSearch;
use crate::error::CorpusResult;

/// Returns the saved searches with their rows, by name.
pub(crate) fn load_saved_searches(connection: &Connection) -> CorpusResult<Vec<(i64, KeptSearch)>> {
    let mut statement = connection.prepare_cached("SELECT id, name, query FROM kept_search ORDER BY name, id")?;
    let rows = statement
        .query_map([], |row| {
            let (name, query) = (row.get(1)?, row.get(2)?);
            Ok((row.get(0)?, KeptSearch { name, query }))
        })?
        .collect::<rusqlite::Result<_>>()?;
    Ok(rows)
}

/// Adds a search under a name that is not in use.
pub(crate) fn insert_saved_search(connection: &Connection, search: &KeptSearch) -> CorpusResult<()> {
    connection
        .prepare_cached("INSERT INTO kept_search (name, query) VALUES (?1, ?2)")?
        .execute(params![search.name, search.query])?;
    Ok(())
}

/// Changes the name and query of a search.
pub(crate) fn update_saved_search(connection: &Connection, id: i64, search: &KeptSearch) -> CorpusResult<()> {
    connection
        .prepare_cached("UPDATE kept_search SET name = ?2, query = ?3 WHERE id = ?1")?
        .execute(params![id, search.name, search.query])?;
    Ok(())
}

/// Removes a search.
pub(crate) fn delete_saved_search(connection: &Connection, id: i64) -> CorpusResult<()> {
    connection
        .prepare_cached("DELETE FROM kept_search WHERE id = ?1")?
        .execute([id])?;
    Ok(())
}
