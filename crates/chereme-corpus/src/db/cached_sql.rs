//! Statements that are prepared once for each connection and run in one call.

use rusqlite::types::FromSql;
use rusqlite::{CachedStatement, Connection, OptionalExtension, Params, Row};

use crate::error::CorpusResult;

/// A connection whose statements are kept prepared.
pub(crate) trait CachedSql {
    /// Returns the prepared statement of this text.
    fn cached_statement(&self, sql: &str) -> rusqlite::Result<CachedStatement<'_>>;

    /// Returns what `read` makes of each row, in order.
    fn read_rows<T, C: FromIterator<T>>(
        &self,
        sql: &str,
        params: impl Params,
        read: impl FnMut(&Row<'_>) -> rusqlite::Result<T>,
    ) -> CorpusResult<C> {
        let mut statement = self.cached_statement(sql)?;
        let rows = statement.query_map(params, read)?;
        Ok(rows.collect::<rusqlite::Result<_>>()?)
    }

    /// Returns the first column of each row, in order.
    fn read_values<T: FromSql, C: FromIterator<T>>(&self, sql: &str, params: impl Params) -> CorpusResult<C> {
        self.read_rows(sql, params, |row| row.get(0))
    }

    /// Calls `take` with each row, in order.
    fn visit_rows(
        &self,
        sql: &str,
        params: impl Params,
        mut take: impl FnMut(&Row<'_>) -> CorpusResult<()>,
    ) -> CorpusResult<()> {
        let mut statement = self.cached_statement(sql)?;
        let mut rows = statement.query(params)?;
        while let Some(row) = rows.next()? {
            take(row)?;
        }
        Ok(())
    }

    /// Returns what `read` makes of the first row, which must exist.
    fn read_row<T>(
        &self,
        sql: &str,
        params: impl Params,
        read: impl FnOnce(&Row<'_>) -> rusqlite::Result<T>,
    ) -> CorpusResult<T> {
        Ok(self.cached_statement(sql)?.query_row(params, read)?)
    }

    /// Returns the first column of the first row, which must exist.
    fn read_value<T: FromSql>(&self, sql: &str, params: impl Params) -> CorpusResult<T> {
        self.read_row(sql, params, |row| row.get(0))
    }

    /// Returns what `read` makes of the first row; `None` if there is no row.
    fn find_row<T>(
        &self,
        sql: &str,
        params: impl Params,
        read: impl FnOnce(&Row<'_>) -> rusqlite::Result<T>,
    ) -> CorpusResult<Option<T>> {
        Ok(self.cached_statement(sql)?.query_row(params, read).optional()?)
    }

    /// Returns the first column of the first row; `None` if there is no row.
    fn find_value<T: FromSql>(&self, sql: &str, params: impl Params) -> CorpusResult<Option<T>> {
        self.find_row(sql, params, |row| row.get(0))
    }

    /// Returns whether there is any row.
    fn has_rows(&self, sql: &str, params: impl Params) -> CorpusResult<bool> {
        Ok(self.cached_statement(sql)?.exists(params)?)
    }

    /// Inserts, updates or deletes rows.
    fn change_rows(&self, sql: &str, params: impl Params) -> CorpusResult<()> {
        self.count_changes(sql, params).map(|_| ())
    }

    /// Inserts, updates or deletes rows, and returns their number.
    fn count_changes(&self, sql: &str, params: impl Params) -> CorpusResult<usize> {
        Ok(self.cached_statement(sql)?.execute(params)?)
    }

    /// Inserts a row and returns its number.
    fn insert_row(&self, sql: &str, params: impl Params) -> CorpusResult<i64>;
}

impl CachedSql for Connection {
    fn cached_statement(&self, sql: &str) -> rusqlite::Result<CachedStatement<'_>> {
        self.prepare_cached(sql)
    }

    fn insert_row(&self, sql: &str, params: impl Params) -> CorpusResult<i64> {
        self.change_rows(sql, params)?;
        Ok(self.last_insert_rowid())
    }
}
