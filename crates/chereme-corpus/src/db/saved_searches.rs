//! Rows of saved searches.

use rusqlite::{Connection, params};

use crate::db::cached_sql::CachedSql;
use crate::db::stored_rows::KeptSearch;
use crate::error::CorpusResult;

/// Returns the saved searches with their rows, by name.
pub(crate) fn load_saved_searches(connection: &Connection) -> CorpusResult<Vec<(i64, KeptSearch)>> {
    connection.read_rows("SELECT id, name, query FROM kept_search ORDER BY name, id", [], |row| {
        let (name, query) = (row.get(1)?, row.get(2)?);
        Ok((row.get(0)?, KeptSearch { name, query }))
    })
}

/// Adds a search under a name that is not in use.
pub(crate) fn insert_saved_search(connection: &Connection, search: &KeptSearch) -> CorpusResult<()> {
    let sql = "INSERT INTO kept_search (name, query) VALUES (?1, ?2)";
    connection.change_rows(sql, params![search.name, search.query])
}

/// Changes the name and query of a search.
pub(crate) fn update_saved_search(connection: &Connection, id: i64, search: &KeptSearch) -> CorpusResult<()> {
    let sql = "UPDATE kept_search SET name = ?2, query = ?3 WHERE id = ?1";
    connection.change_rows(sql, params![id, search.name, search.query])
}

/// Removes a search.
pub(crate) fn delete_saved_search(connection: &Connection, id: i64) -> CorpusResult<()> {
    connection.change_rows("DELETE FROM kept_search WHERE id = ?1", [id])
}
