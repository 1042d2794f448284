//! Which entry of a lexicon corresponds to an entry of another one: by the ids of their rows, then by gloss and number.

use std::collections::BTreeSet;

use chereme_sign::text::fold_text;
use rusqlite::Connection;
use serde_json::{Map, Value};

use crate::db::signs::{self, TokenRow, TokenValueRow};
use crate::db::stored_columns::RecordOrigin;
use crate::error::CorpusResult;

/// Titles of columns that may identify rows.
const ROW_ID_TITLES: [&str; 12] = [
    "id",
    "row id",
    "sign id",
    "signbank id",
    "entry id",
    "gloss id",
    "lexeme id",
    "uid",
    "uuid",
    "identifier",
    "identifiant",
    "signbank",
];

/// Returns whether the title of a column says that it identifies rows.
pub(crate) fn is_row_id_title(title: &str) -> bool {
    let title = fold_text(&title.replace(['_', '-'], " "));
    ROW_ID_TITLES.contains(&title.trim())
}

/// The ids of an entry's rows: title of the column and cell.
pub(crate) type EntryRowIds = BTreeSet<(String, String)>;

/// Returns the ids of the row that an entry was imported from.
pub(crate) fn token_row_ids(token: &TokenRow) -> EntryRowIds {
    let source = token.source.as_deref().unwrap_or_default();
    let cells = serde_json::from_str::<Value>(source).map(|mut origin| origin["cells"].take());
    let cells: Map<String, Value> = cells
        .ok()
        .and_then(|cells| cells.as_object().cloned())
        .unwrap_or_default();
    let named = cells.into_iter().filter(|(title, _)| is_row_id_title(title));
    named
        .filter_map(|(title, cell)| Some((title, cell.as_str()?.trim().to_owned())))
        .collect()
}

/// Returns whether two entries come from equal rows of one file, wherever that lay.
pub(crate) fn are_rows_equal(own: &TokenRow, other: &TokenRow) -> bool {
    let row = |token: &TokenRow| {
        let mut origin: Value = serde_json::from_str(token.source.as_deref()?).ok()?;
        origin.as_object_mut()?.remove("path");
        Some(origin)
    };
    row(own).is_some_and(|origin| row(other) == Some(origin))
}

/// Returns the ids of the rows that the entries of a sign were imported from.
pub(crate) fn sign_row_ids(connection: &Connection, sign: i64) -> CorpusResult<EntryRowIds> {
    let tokens = lexicon_tokens(connection, sign)?;
    Ok(tokens.iter().flat_map(token_row_ids).collect())
}

/// Returns the tokens of a sign that were imported from lexicons.
pub(crate) fn lexicon_tokens(connection: &Connection, sign: i64) -> CorpusResult<Vec<TokenRow>> {
    let mut tokens = signs::tokens_of_sign(connection, sign)?;
    tokens.retain(|token| token.origin == RecordOrigin::Lexicon);
    Ok(tokens)
}

/// Returns whether two ids of one column say that their rows are different ones.
pub(crate) fn are_other_rows(own: &EntryRowIds, other: &EntryRowIds) -> bool {
    let titles: BTreeSet<&String> = own.iter().map(|(title, _)| title).collect();
    own.is_disjoint(other) && other.iter().any(|(title, _)| titles.contains(title))
}

/// The place of an entry among those of its gloss in another lexicon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EntryPlace {
    /// It is this sign there.
    Same(i64),
    /// No sign there corresponds to it, and this number is free for it.
    Free(i64),
}

/// Returns the place of an entry in a lexicon, or without one among the signs of none; `is_candidate` says which signs may
/// be the same.
pub(crate) fn find_entry_place(
    connection: &Connection,
    lexicon: Option<i64>,
    entry: (&str, i64),
    ids: &EntryRowIds,
    is_candidate: impl Fn(i64) -> CorpusResult<bool>,
) -> CorpusResult<EntryPlace> {
    let (gloss, number) = entry;
    let signs = signs::entries_of_gloss(connection, lexicon, gloss)?;
    let mut same = None;
    for (sign, own_number) in &signs {
        if !is_candidate(*sign)? {
            continue;
        }
        let own = sign_row_ids(connection, *sign)?;
        if !own.is_disjoint(ids) {
            return Ok(EntryPlace::Same(*sign));
        }
        if *own_number == number && !are_other_rows(&own, ids) {
            same = Some(*sign);
        }
    }
    let is_taken = signs.iter().any(|(_, own)| *own == number);
    let last = signs.iter().map(|(_, own)| *own).max().unwrap_or_default();
    let free = EntryPlace::Free(if is_taken { last + 1 } else { number });
    Ok(same.map_or(free, EntryPlace::Same))
}

/// Returns whether two tokens are coded alike, whatever inventories and annotations the values come from.
pub(crate) fn are_codings_alike(own: &[TokenValueRow], other: &[TokenValueRow]) -> bool {
    let content = |rows: &[TokenValueRow]| -> Vec<TokenValueRow> {
        let bare = rows.iter().map(|row| TokenValueRow {
            inventory_id: None,
            annotation_id: None,
            ..row.clone()
        });
        bare.collect()
    };
    content(own) == content(other)
}
