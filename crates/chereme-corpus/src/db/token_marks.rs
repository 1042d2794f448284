//! The fields of tokens whose values do not count, for tables: disputed among annotators, or only proposed by a detector.

use std::collections::BTreeMap;

use rusqlite::Connection;

use super::people::SIGNED_TOKENS_SQL;
use super::signs;
use super::stored_tiers::is_proposal_sql;
use crate::db::cached_sql::CachedSql;
use crate::error::CorpusResult;

/// Selects the fields of the token `t` with opinions of this standing, separated by blanks.
macro_rules! opinion_fields_sql {
    ($standing:literal) => {
        concat!(
            "(SELECT group_concat(field, ' ') FROM (SELECT DISTINCT coalesce(v.phase || '.', '')
                 || coalesce(v.hand || '.', '') || v.component || coalesce('.' || v.feature, '') AS field
              FROM token_value v JOIN annotation a ON a.id = v.annotation_id
              WHERE v.token_id = t.id AND v.state = 'unset' AND coalesce(v.standing, iif(EXISTS
                  (SELECT 1 FROM tier t WHERE t.id = a.tier_id AND ",
            is_proposal_sql!(),
            "), 'proposed', 'disputed')) = '",
            $standing,
            "' ORDER BY 1))"
        )
    };
}

/// The fields on which annotators do not agree.
pub(crate) const DISPUTED_FIELDS_SQL: &str = opinion_fields_sql!("disputed");
/// The fields for which a detector proposes a value.
pub(crate) const PROPOSED_FIELDS_SQL: &str = opinion_fields_sql!("proposed");

/// Returns the disputed and the proposed fields of each of these tokens.
pub(crate) fn load_token_marks(connection: &Connection, tokens: &[i64]) -> CorpusResult<BTreeMap<i64, [String; 2]>> {
    let sql = format!(
        "SELECT t.id, ifnull({DISPUTED_FIELDS_SQL}, ''), ifnull({PROPOSED_FIELDS_SQL}, '') FROM token t
         WHERE t.id IN (SELECT value FROM json_each(?1))"
    );
    connection.read_rows(&sql, [signs::json_list(tokens)], |row| {
        Ok((row.get(0)?, [row.get(1)?, row.get(2)?]))
    })
}

/// Returns the statement that selects all rows of a table, those of tokens with their signers and marks.
pub(crate) fn dumped_rows_sql(table: &str) -> String {
    match table {
        "token" => format!(
            "SELECT t.*, g.name AS signer, {DISPUTED_FIELDS_SQL} AS disputed, {PROPOSED_FIELDS_SQL} AS proposed
             FROM {SIGNED_TOKENS_SQL} LEFT JOIN signer g ON g.id = coalesce(p.id, r.signer_id) ORDER BY 1"
        ),
        _ => format!("SELECT * FROM {table} ORDER BY 1"),
    }
}
