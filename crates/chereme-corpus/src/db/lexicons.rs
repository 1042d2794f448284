//! Rows of lexicons: the collections of entries to which signs belong.

use chereme_sign::text::fold_text;
use rusqlite::{Connection, Row, params};
use serde::Serialize;

use super::stored_tiers;
use crate::db::cached_sql::CachedSql;
use crate::error::CorpusResult;

/// A lexicon: the signs of one language as somebody published them.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct LexiconRow {
    /// The row.
    pub id: i64,
    /// Its name, which no other lexicon of the corpus has.
    pub name: String,
    /// Its sign language, as a code of ISO 639-3 such as `dse`.
    pub language: Option<String>,
    /// Its version.
    pub version: Option<String>,
    /// The terms under which it may be used.
    pub terms: Option<String>,
    /// How to cite it.
    pub citation: Option<String>,
    /// Remarks.
    pub notes: Option<String>,
}

const SELECT_LEXICON_SQL: &str = "SELECT id, name, language, version, terms, citation, notes FROM lexicon";

fn lexicon_row(row: &Row<'_>) -> rusqlite::Result<LexiconRow> {
    Ok(LexiconRow {
        id: row.get(0)?,
        name: row.get(1)?,
        language: row.get(2)?,
        version: row.get(3)?,
        terms: row.get(4)?,
        citation: row.get(5)?,
        notes: row.get(6)?,
    })
}

/// Returns all lexicons by name.
pub(crate) fn load_lexicon_rows(connection: &Connection) -> CorpusResult<Vec<LexiconRow>> {
    connection.read_rows(&format!("{SELECT_LEXICON_SQL} ORDER BY name"), [], lexicon_row)
}

/// Returns the lexicon of this name, otherwise the only one whose name differs from it in case and accents alone.
pub(crate) fn find_lexicon(connection: &Connection, name: &str) -> CorpusResult<Option<LexiconRow>> {
    let lexicons = load_lexicon_rows(connection)?;
    if let Some(exact) = lexicons.iter().find(|lexicon| lexicon.name == name) {
        return Ok(Some(exact.clone()));
    }
    let folded = fold_text(name);
    let mut alike = lexicons
        .into_iter()
        .filter(|lexicon| fold_text(&lexicon.name) == folded);
    // Of two names that are equal apart from case and accents neither is meant more than the other.
    Ok(alike.next().filter(|_| alike.next().is_none()))
}

/// Writes a lexicon of this name, which no other has, and returns its row. The recordings of a corpus without a lexicon
/// are linked to its first one.
pub(crate) fn insert_lexicon(connection: &Connection, name: &str) -> CorpusResult<i64> {
    stored_tiers::check_text(
        || format!("lexicon {:?}", name.chars().take(40).collect::<String>()),
        name,
    )?;
    connection.change_rows("INSERT INTO lexicon (name) VALUES (?1)", [name])?;
    let id = connection.last_insert_rowid();
    // Before its first lexicon, a corpus has nothing to which a recording can be linked.
    let sql = "UPDATE recording SET lexicon_id = ?1
             WHERE lexicon_id IS NULL AND (SELECT count(*) FROM lexicon) = 1";
    connection.change_rows(sql, [id])?;
    Ok(id)
}

/// Returns `name`, or with a number behind it if a lexicon has that name already.
pub(crate) fn free_lexicon_name(connection: &Connection, name: &str) -> CorpusResult<String> {
    let name = if name.trim().is_empty() { "lexicon" } else { name.trim() };
    let mut free_name = name.to_owned();
    // The one without a number counts as the first.
    let mut number = 2;
    while find_lexicon(connection, &free_name)?.is_some() {
        free_name = format!("{name} ({number})");
        number += 1;
    }
    Ok(free_name)
}

/// Writes the fields of a lexicon.
pub(crate) fn update_lexicon(connection: &Connection, row: &LexiconRow) -> CorpusResult<()> {
    let sql = "UPDATE lexicon SET name = ?2, language = ?3, version = ?4, terms = ?5, citation = ?6, notes = ?7
             WHERE id = ?1";
    let values = params![
        row.id,
        row.name,
        row.language,
        row.version,
        row.terms,
        row.citation,
        row.notes
    ];
    connection.change_rows(sql, values)
}

/// Deletes a lexicon without signs, and the links of recordings and files to it.
pub(crate) fn delete_lexicon(connection: &Connection, id: i64) -> CorpusResult<()> {
    for sql in [
        "UPDATE recording SET lexicon_id = NULL WHERE lexicon_id = ?1",
        "UPDATE source_file SET lexicon_id = NULL WHERE lexicon_id = ?1",
        "DELETE FROM lexicon WHERE id = ?1",
    ] {
        connection.change_rows(sql, [id])?;
    }
    Ok(())
}

/// Deletes a lexicon whose signs belong to another one already; recordings and files are linked to that one.
pub(crate) fn replace_lexicon(connection: &Connection, gone: i64, kept: i64) -> CorpusResult<()> {
    for sql in [
        "UPDATE recording SET lexicon_id = ?2 WHERE lexicon_id = ?1",
        "UPDATE source_file SET lexicon_id = ?2 WHERE lexicon_id = ?1",
    ] {
        connection.change_rows(sql, [gone, kept])?;
    }
    delete_lexicon(connection, gone)
}

/// Returns the recordings that are linked to a lexicon.
pub(crate) fn recordings_of_lexicon(connection: &Connection, lexicon: i64) -> CorpusResult<Vec<i64>> {
    connection.read_values("SELECT id FROM recording WHERE lexicon_id = ?1 ORDER BY id", [lexicon])
}

/// Returns the lexicon of a corpus that has only one.
pub(crate) fn find_sole_lexicon(connection: &Connection) -> CorpusResult<Option<i64>> {
    // Of several lexicons none is more likely than another, which SQL says as NULL.
    let sql = "SELECT CASE count(*) WHEN 1 THEN min(id) END FROM lexicon";
    connection.read_value(sql, [])
}

/// Returns the lexicon in which the glosses of a recording's tiers are looked up.
pub(crate) fn lexicon_of_recording(connection: &Connection, recording: i64) -> CorpusResult<Option<i64>> {
    let sql = "SELECT lexicon_id FROM recording WHERE id = ?1";
    let lexicon = connection.find_value(sql, [recording])?;
    Ok(lexicon.flatten())
}

/// Returns the name of the lexicon to which a recording is linked.
pub(crate) fn lexicon_name_of_recording(connection: &Connection, recording: i64) -> CorpusResult<Option<String>> {
    let sql = "SELECT l.name FROM recording r JOIN lexicon l ON l.id = r.lexicon_id WHERE r.id = ?1";
    connection.find_value(sql, [recording])
}

/// Links a recording to a lexicon, or to none, and returns whether it was not before.
pub(crate) fn link_recording(connection: &Connection, recording: i64, lexicon: Option<i64>) -> CorpusResult<bool> {
    let sql = "UPDATE recording SET lexicon_id = ?2 WHERE id = ?1 AND lexicon_id IS NOT ?2";
    Ok(connection.count_changes(sql, params![recording, lexicon])? > 0)
}

/// Returns the lexicon of a sign.
pub(crate) fn lexicon_of_sign(connection: &Connection, sign: i64) -> CorpusResult<Option<i64>> {
    let sql = "SELECT lexicon_id FROM sign WHERE id = ?1";
    let lexicon = connection.find_value(sql, [sign])?;
    Ok(lexicon.flatten())
}

/// Returns the name of the lexicon of a sign.
pub(crate) fn lexicon_name_of_sign(connection: &Connection, sign: i64) -> CorpusResult<Option<String>> {
    let sql = "SELECT l.name FROM sign s JOIN lexicon l ON l.id = s.lexicon_id WHERE s.id = ?1";
    connection.find_value(sql, [sign])
}

/// Notes that the signs of an imported file are entries of a lexicon.
pub(crate) fn set_file_lexicon(connection: &Connection, file: i64, lexicon: i64) -> CorpusResult<()> {
    let sql = "UPDATE source_file SET lexicon_id = ?2 WHERE id = ?1 AND lexicon_id IS NOT ?2";
    connection.change_rows(sql, [file, lexicon])
}

/// Returns the lexicon of an imported file.
pub(crate) fn lexicon_of_file(connection: &Connection, file: i64) -> CorpusResult<Option<i64>> {
    let sql = "SELECT lexicon_id FROM source_file WHERE id = ?1";
    let lexicon = connection.find_value(sql, [file])?;
    Ok(lexicon.flatten())
}

/// A lexicon with the amount of its contents.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct LexiconContents {
    /// The lexicon.
    #[serde(flatten)]
    pub lexicon: LexiconRow,
    /// The number of its entries.
    pub signs: i64,
    /// The number of entries whose gloss another entry had first.
    pub homonyms: i64,
    /// The names of the files that it was imported from.
    pub files: Vec<String>,
    /// The number of recordings whose glosses are looked up in it.
    pub recordings: i64,
    /// The number of tokens of its entries.
    pub tokens: i64,
    /// The number of tokens that belong to the first entry of their gloss since their annotation names no other.
    pub guessed_tokens: i64,
}

/// The tokens `t` of signs `s` and annotations `a` whose annotation has the bare gloss of several entries.
const HAS_BARE_GLOSS_SQL: &str =
    "FROM token t JOIN sign s ON s.id = t.sign_id JOIN annotation a ON a.id = t.annotation_id
    WHERE trim(a.value) = s.gloss
      AND EXISTS (SELECT 1 FROM sign o WHERE o.gloss = s.gloss AND o.lexicon_id IS s.lexicon_id AND o.id <> s.id)";

/// Returns the glosses of a recording that several entries have and whose annotations do not say which is meant.
pub(crate) fn bare_glosses_of_recording(connection: &Connection, recording: i64) -> CorpusResult<Vec<String>> {
    let sql = format!("SELECT DISTINCT s.gloss {HAS_BARE_GLOSS_SQL} AND t.recording_id = ?1 ORDER BY 1");
    connection.read_values(&sql, [recording])
}

/// Returns what each lexicon holds, by name.
pub(crate) fn load_lexicon_contents(connection: &Connection) -> CorpusResult<Vec<LexiconContents>> {
    let mut counted = connection.prepare_cached(&format!(
        "SELECT (SELECT count(*) FROM sign WHERE lexicon_id = ?1), (SELECT count(homonym) FROM sign WHERE lexicon_id = ?1),
                (SELECT count(*) FROM recording WHERE lexicon_id = ?1),
                (SELECT count(*) FROM token t JOIN sign s ON s.id = t.sign_id WHERE s.lexicon_id = ?1),
                (SELECT count(*) {HAS_BARE_GLOSS_SQL} AND s.lexicon_id = ?1)"
    ))?;
    let mut named =
        connection.prepare_cached("SELECT DISTINCT name FROM source_file WHERE lexicon_id = ?1 ORDER BY name")?;
    let mut contents = Vec::new();
    for lexicon in load_lexicon_rows(connection)? {
        let counts = counted.query_row([lexicon.id], |row| {
            let counts: rusqlite::Result<Vec<i64>> = (0..5).map(|column| row.get(column)).collect();
            counts
        })?;
        let [signs, homonyms, recordings, tokens, guessed_tokens] = counts[..] else {
            continue;
        };
        let files = named.query_map([lexicon.id], |row| row.get(0))?;
        contents.push(LexiconContents {
            files: files.collect::<rusqlite::Result<_>>()?,
            lexicon,
            signs,
            homonyms,
            recordings,
            tokens,
            guessed_tokens,
        });
    }
    Ok(contents)
}
