//! Rows of signs, their texts, tokens and token values.

use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::text::{compose_accents, decompose_accents};
use chereme_sign::tier::AnnotatedHands;
use chereme_sign::{ComponentField, ComponentReading, SignComponent, SignPhase};
use rusqlite::{Connection, OptionalExtension, Row, params};
use serde::Serialize;

use super::stored_columns::{
    NamedColumn, OpinionStanding, RecordOrigin, ValueState, phase_name, phase_place, read_phase_columns,
    read_word_column, word_or_null,
};
use super::stored_tiers;
use crate::db::cached_sql::CachedSql;
use crate::error::{CorpusError, CorpusResult};

/// A token: one realisation of a sign.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct TokenRow {
    /// The row.
    pub id: i64,
    /// The sign's row.
    pub sign_id: i64,
    /// The sign's gloss; that of a further entry of one gloss has its number behind it: `BANK#2`.
    pub gloss: String,
    /// The number of a further entry of one gloss; the first or only one has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub homonym: Option<i64>,
    /// The name of the lexicon to which the sign belongs, if it belongs to one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lexicon: Option<String>,
    /// The recording's row; a lexicon entry has none.
    pub recording_id: Option<i64>,
    /// The recording's name.
    pub recording: Option<String>,
    /// Its annotation on a gloss tier.
    pub annotation_id: Option<i64>,
    /// Where it starts, in microseconds.
    pub start_us: Option<i64>,
    /// The first microsecond after it.
    pub end_us: Option<i64>,
    /// The hand or hands that make it.
    pub hand: Option<AnnotatedHands>,
    /// Its origin.
    pub origin: RecordOrigin,
    /// Whether it is the sign's citation form.
    pub citation: bool,
    /// Properties from its file that have no column, as JSON.
    pub source: Option<String>,
}

impl TokenRow {
    /// Returns the sign's gloss without the number of a further entry.
    pub(crate) fn plain_gloss(&self) -> &str {
        let numbered = self.homonym.and_then(|_| split_entry_label(&self.gloss));
        numbered.map_or(&*self.gloss, |(gloss, _)| gloss)
    }
}

/// The value of a token's component.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct TokenValueRow {
    /// The hand or hands; nothing if the component belongs to no hand or to the whole sign.
    pub hand: Option<AnnotatedHands>,
    /// The component.
    pub component: SignComponent,
    /// The feature of the component.
    pub feature: Option<String>,
    /// Its phase, if the sign has several successive values.
    pub phase: Option<SignPhase>,
    /// Whether there is a value.
    pub state: ValueState,
    /// The value.
    pub value: Option<String>,
    /// The inventory it comes from.
    pub inventory_id: Option<i64>,
    /// The annotation that gives the value.
    pub annotation_id: Option<i64>,
    /// Why the value of the annotation does not count, unless it does, or is [as usual](OpinionStanding::is_usual).
    pub standing: Option<OpinionStanding>,
}

impl TokenValueRow {
    /// Returns the row for a reading of `field`, without inventory and annotation.
    pub(crate) fn from_field_reading(field: &ComponentField, reading: &ComponentReading) -> Self {
        Self {
            hand: field.hand.map(AnnotatedHands::One),
            component: field.component,
            feature: field.feature.clone(),
            phase: field.phase,
            state: ValueState::state_of_reading(reading),
            value: reading.reading_value().map(str::to_owned),
            inventory_id: None,
            annotation_id: None,
            standing: None,
        }
    }
}

/// Returns the sign that an annotation with this gloss realises: the entry of the recording's lexicon, otherwise the sign
/// that belongs to no lexicon; inserts that one if it is missing.
pub(crate) fn sign_of_annotation(connection: &Connection, lexicon: Option<i64>, gloss: &str) -> CorpusResult<i64> {
    if lexicon.is_some()
        && let Some(id) = find_sign(connection, lexicon, gloss)?
    {
        return Ok(id);
    }
    match find_sign(connection, None, gloss)? {
        Some(id) => Ok(id),
        None => insert_sign(connection, None, gloss, None),
    }
}

/// A sign to which an import adds an entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct EnteredSign {
    /// The row.
    pub id: i64,
    /// Whether neither the lexicon nor an annotation had it.
    pub is_new: bool,
}

/// Returns the entry of a lexicon with this gloss, or without a lexicon the sign that belongs to none; inserts it if it
/// is missing.
///
/// Tokens that were annotated before the lexicon had the entry become its tokens, as far as their recordings are linked
/// to the lexicon.
pub(crate) fn enter_sign(connection: &Connection, lexicon: Option<i64>, gloss: &str) -> CorpusResult<EnteredSign> {
    match find_sign(connection, lexicon, gloss)? {
        Some(id) => Ok(EnteredSign { id, is_new: false }),
        None => enter_homonym(connection, lexicon, gloss, 1),
    }
}

/// Returns the entry of a lexicon with this gloss and number as [`enter_sign()`] does.
pub(crate) fn enter_homonym(
    connection: &Connection,
    lexicon: Option<i64>,
    gloss: &str,
    number: i64,
) -> CorpusResult<EnteredSign> {
    if let Some(id) = find_entry(connection, lexicon, gloss, Some(number))? {
        return Ok(EnteredSign { id, is_new: false });
    }
    let homonym = Some(number).filter(|number| *number > 1);
    let loose = match (lexicon, homonym) {
        (None, _) => None,
        (_, None) => find_sign(connection, None, gloss)?,
        // Annotations may have named the entry before the lexicon had it.
        (_, Some(number)) => find_sign(connection, None, &format!("{gloss}#{number}"))?,
    };
    let Some((lexicon, loose)) = lexicon.zip(loose) else {
        let id = insert_sign(connection, lexicon, gloss, homonym)?;
        return Ok(EnteredSign { id, is_new: true });
    };
    // A token without a recording, or without a linked one, belongs to a lexicon if that is the only one.
    let is_linked = "coalesce((SELECT r.lexicon_id FROM recording r WHERE r.id = t.recording_id),
        (SELECT CASE count(*) WHEN 1 THEN min(id) END FROM lexicon)) IS ?2";
    let sql = format!("SELECT EXISTS (SELECT 1 FROM token t WHERE t.sign_id = ?1 AND NOT ({is_linked}))");
    let others: bool = connection.read_value(&sql, [loose, lexicon])?;
    // The sign keeps its number and its uid if all of its tokens go with it.
    if !others {
        connection.change_rows(
            "UPDATE sign SET lexicon_id = ?2, homonym = ?3, gloss = iif(?3 IS NULL, gloss, ?4) WHERE id = ?1",
            params![loose, lexicon, homonym, gloss],
        )?;
        return Ok(EnteredSign {
            id: loose,
            is_new: false,
        });
    }
    let id = insert_sign(connection, Some(lexicon), gloss, homonym)?;
    let moved = connection.count_changes(
        &format!("UPDATE token AS t SET sign_id = ?3 WHERE t.sign_id = ?1 AND {is_linked}"),
        [loose, lexicon, id],
    )?;
    // The citation form may have been among the tokens that moved.
    if moved > 0 {
        super::stored_delete::cite_another(connection, loose)?;
        super::stored_delete::cite_another(connection, id)?;
    }
    Ok(EnteredSign { id, is_new: true })
}

fn insert_sign(connection: &Connection, lexicon: Option<i64>, gloss: &str, homonym: Option<i64>) -> CorpusResult<i64> {
    let place = || format!("sign {:?}", gloss.chars().take(40).collect::<String>());
    stored_tiers::check_text(place, gloss)?;
    let sql = "INSERT INTO sign (lexicon_id, gloss, homonym) VALUES (?1, ?2, ?3)";
    connection.insert_row(sql, params![lexicon, gloss, homonym])
}

/// Returns the entry of a lexicon, or without one the sign that belongs to none, with exactly this gloss, or with a gloss
/// that differs only by the characters in which a program stores accents. Of several entries of one gloss it is the first,
/// unless the number of another follows: `BANK#2`.
pub(crate) fn find_sign(connection: &Connection, lexicon: Option<i64>, gloss: &str) -> CorpusResult<Option<i64>> {
    if let Some(id) = find_entry(connection, lexicon, gloss, None)? {
        return Ok(Some(id));
    }
    match split_entry_label(gloss) {
        Some((gloss, number)) => find_entry(connection, lexicon, gloss, Some(number)),
        None => Ok(None),
    }
}

/// Returns the entry of a lexicon with this gloss and number, which is 1 for the first or only one; without a number the
/// first that there is.
pub(crate) fn find_entry(
    connection: &Connection,
    lexicon: Option<i64>,
    gloss: &str,
    number: Option<i64>,
) -> CorpusResult<Option<i64>> {
    let mut statement = connection.prepare_cached(
        "SELECT id FROM sign WHERE gloss = ?1 AND ifnull(lexicon_id, 0) = ?2 AND (?3 IS NULL OR ifnull(homonym, 1) = ?3)
         ORDER BY ifnull(homonym, 1) LIMIT 1",
    )?;
    for spelling in accent_spellings(gloss) {
        let key = params![spelling, lexicon.unwrap_or_default(), number];
        if let Some(id) = statement.query_row(key, |row| row.get(0)).optional()? {
            return Ok(Some(id));
        }
    }
    Ok(None)
}

/// Returns the gloss and the number of an entry that a text names as `BANK#2`.
pub(crate) fn split_entry_label(label: &str) -> Option<(&str, i64)> {
    let (gloss, number) = label.rsplit_once('#')?;
    let number = number.parse().ok().filter(|number| *number > 0)?;
    (!gloss.is_empty()).then_some((gloss, number))
}

/// Returns the gloss of a sign, with the number of a further entry behind it.
pub(crate) fn sign_label(connection: &Connection, sign: i64) -> CorpusResult<String> {
    let sql = "SELECT label FROM sign WHERE id = ?1";
    connection.read_value(sql, [sign])
}

/// A sign by the lexicon that it belongs to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct SignByLexicon {
    /// The row.
    pub id: i64,
    /// The name of its lexicon, if it belongs to one.
    pub lexicon: Option<String>,
    /// Its number among the entries of the gloss.
    pub number: i64,
}

/// Returns the signs of all lexicons with this gloss, or with the number behind it, spelled as for [`find_sign()`].
pub(crate) fn find_signs_of_gloss(connection: &Connection, gloss: &str) -> CorpusResult<Vec<SignByLexicon>> {
    let mut statement = connection.prepare_cached(
        "SELECT s.id, l.name, ifnull(s.homonym, 1) FROM sign s LEFT JOIN lexicon l ON l.id = s.lexicon_id
         WHERE s.gloss = ?1 AND (?2 IS NULL OR ifnull(s.homonym, 1) = ?2) ORDER BY l.name IS NULL, l.name, 3",
    )?;
    let numbered = split_entry_label(gloss).map(|(gloss, number)| (gloss, Some(number)));
    for (gloss, number) in [(gloss, None)].into_iter().chain(numbered) {
        for spelling in accent_spellings(gloss) {
            let rows = statement.query_map(params![spelling, number], |row| {
                Ok(SignByLexicon {
                    id: row.get(0)?,
                    lexicon: row.get(1)?,
                    number: row.get(2)?,
                })
            })?;
            let signs = rows.collect::<rusqlite::Result<Vec<_>>>()?;
            if !signs.is_empty() {
                return Ok(signs);
            }
        }
    }
    Ok(Vec::new())
}

/// Returns a gloss as written, then with its accents in one character each, then in characters of their own.
fn accent_spellings(gloss: &str) -> Vec<String> {
    let mut spellings = vec![gloss.to_owned()];
    for other in [compose_accents(gloss), decompose_accents(gloss)] {
        if other != gloss {
            spellings.push(other.into_owned());
        }
    }
    spellings
}

/// Returns every gloss, in order.
pub(crate) fn list_all_glosses(connection: &Connection) -> CorpusResult<Vec<String>> {
    connection.read_values("SELECT DISTINCT gloss FROM sign ORDER BY gloss", [])
}

/// Returns the lexicon of each sign that belongs to one.
pub(crate) fn lexicons_of_signs(connection: &Connection) -> CorpusResult<BTreeMap<i64, i64>> {
    let sql = "SELECT id, lexicon_id FROM sign WHERE lexicon_id IS NOT NULL";
    connection.read_rows(sql, [], |row| Ok((row.get(0)?, row.get(1)?)))
}

/// Returns the glosses of a lexicon, in order.
pub(crate) fn glosses_of_lexicon(connection: &Connection, lexicon: i64) -> CorpusResult<Vec<String>> {
    connection.read_values("SELECT gloss FROM sign WHERE lexicon_id = ?1 ORDER BY gloss", [lexicon])
}

/// Returns the signs of a lexicon by gloss and number.
pub(crate) fn entries_of_lexicon(connection: &Connection, lexicon: i64) -> CorpusResult<Vec<i64>> {
    let sql = "SELECT id FROM sign WHERE lexicon_id = ?1 ORDER BY gloss, homonym";
    connection.read_values(sql, [lexicon])
}

/// Returns the entries of a lexicon with a gloss, or without one the signs of none, each with its number.
pub(crate) fn entries_of_gloss(
    connection: &Connection,
    lexicon: Option<i64>,
    gloss: &str,
) -> CorpusResult<Vec<(i64, i64)>> {
    let mut statement = connection.prepare_cached(
        "SELECT id, ifnull(homonym, 1) FROM sign WHERE gloss = ?1 AND ifnull(lexicon_id, 0) = ?2 ORDER BY 2",
    )?;
    let mut entries = Vec::new();
    for spelling in accent_spellings(gloss) {
        let key = params![spelling, lexicon.unwrap_or_default()];
        let rows = statement.query_map(key, |row| Ok((row.get(0)?, row.get(1)?)))?;
        entries.extend(rows.collect::<rusqlite::Result<Vec<_>>>()?);
    }
    Ok(entries)
}

/// Returns the number of a sign among the entries of its gloss.
pub(crate) fn entry_number(connection: &Connection, sign: i64) -> CorpusResult<i64> {
    let sql = "SELECT ifnull(homonym, 1) FROM sign WHERE id = ?1";
    connection.read_value(sql, [sign])
}

/// Makes a sign an entry of a lexicon under a number that is free there.
pub(crate) fn move_entry(connection: &Connection, sign: i64, lexicon: i64, number: i64) -> CorpusResult<()> {
    let sql = "UPDATE sign SET lexicon_id = ?2, homonym = nullif(?3, 1) WHERE id = ?1";
    connection.change_rows(sql, [sign, lexicon, number])
}

/// Gives the tokens of a sign to another one, whose citation form stays as it is.
pub(crate) fn move_tokens(connection: &Connection, from: i64, into: i64) -> CorpusResult<()> {
    let is_citation = has_citation(connection, into)?;
    let sql = "UPDATE token SET sign_id = ?2, citation = citation AND NOT ?3 WHERE sign_id = ?1";
    connection.change_rows(sql, params![from, into, is_citation])
}

/// Returns the translations of a sign as language and text.
pub(crate) fn list_sign_translations(connection: &Connection, sign: i64) -> CorpusResult<Vec<(String, String)>> {
    let sql = "SELECT language, text FROM sign_text WHERE sign_id = ?1 ORDER BY id";
    connection.read_rows(sql, [sign], |row| Ok((row.get(0)?, row.get(1)?)))
}

/// Adds a translation of a sign unless it exists.
pub(crate) fn add_text(connection: &Connection, sign: i64, language: &str, text: &str) -> CorpusResult<()> {
    let sql = "INSERT OR IGNORE INTO sign_text (sign_id, language, text) VALUES (?1, ?2, ?3)";
    connection.change_rows(sql, params![sign, language, text])
}

/// Writes a token and returns its row; its `id`, `gloss` and `recording` are not used.
pub(crate) fn insert_token(connection: &Connection, row: &TokenRow) -> CorpusResult<i64> {
    let sql = "INSERT INTO token (sign_id, recording_id, annotation_id, start_us, end_us, hand, origin,
                 citation, source) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)";
    let values = params![
        row.sign_id,
        row.recording_id,
        row.annotation_id,
        row.start_us,
        row.end_us,
        row.hand.map(NamedColumn),
        NamedColumn(row.origin),
        row.citation,
        row.source
    ];
    connection.insert_row(sql, values)
}

/// Writes a token's row again.
pub(crate) fn update_token(connection: &Connection, row: &TokenRow) -> CorpusResult<()> {
    let sql = "UPDATE token SET sign_id = ?2, start_us = ?3, end_us = ?4, hand = ?5, origin = ?6,
                 citation = ?7, source = ?8 WHERE id = ?1";
    let values = params![
        row.id,
        row.sign_id,
        row.start_us,
        row.end_us,
        row.hand.map(NamedColumn),
        NamedColumn(row.origin),
        row.citation,
        row.source
    ];
    connection.change_rows(sql, values)
}

/// Deletes a token with its values, its attributes and its notation.
pub(crate) fn delete_token(connection: &Connection, id: i64) -> CorpusResult<()> {
    super::notations::delete_token_notation(connection, id)?;
    super::stored_attributes::set_token_attributes(connection, id, &[])?;
    connection.change_rows("DELETE FROM token_value WHERE token_id = ?1", [id])?;
    connection.change_rows("DELETE FROM token WHERE id = ?1", [id])
}

/// Deletes a sign that has no token, translation and relation any more, and returns whether it did.
pub(crate) fn delete_empty_sign(connection: &Connection, sign: i64) -> CorpusResult<bool> {
    // Remarks are work of a person, and keep a sign that nothing else needs.
    let sql = "DELETE FROM sign WHERE id = ?1 AND notes IS NULL
                AND NOT EXISTS (SELECT 1 FROM token WHERE sign_id = ?1)
                AND NOT EXISTS (SELECT 1 FROM sign_text WHERE sign_id = ?1)
                AND NOT EXISTS (SELECT 1 FROM sign_relation WHERE ?1 IN (sign_id, related_id))";
    let deleted = connection.count_changes(sql, [sign])?;
    Ok(deleted > 0)
}

/// Sets the values of a token; leaves unchanged rows untouched.
pub(crate) fn set_values(connection: &Connection, token: i64, rows: &[TokenValueRow]) -> CorpusResult<()> {
    // Writing equal rows again would fill the history, and give them new numbers.
    if load_values_and_opinions(connection, token)? == rows {
        return Ok(());
    }
    connection.change_rows("DELETE FROM token_value WHERE token_id = ?1", [token])?;
    let mut statement = connection.prepare_cached(
        "INSERT INTO token_value (token_id, hand, component, feature, phase, position, state, value,
             inventory_id, annotation_id, standing) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11)",
    )?;
    for row in rows {
        statement.execute(params![
            token,
            row.hand.map(NamedColumn),
            NamedColumn(row.component),
            row.feature,
            row.phase.map(phase_name),
            phase_place(row.phase),
            NamedColumn(row.state),
            row.value,
            row.inventory_id,
            row.annotation_id,
            row.standing.map(NamedColumn)
        ])?;
    }
    Ok(())
}

/// Returns the values of several tokens by token, in the order in which they were written.
pub(crate) fn values_of(connection: &Connection, tokens: &[i64]) -> CorpusResult<BTreeMap<i64, Vec<TokenValueRow>>> {
    let mut statement = connection.prepare_cached(&format!(
        "{SELECT_TOKEN_VALUES_SQL}, token_id FROM token_value
         WHERE token_id IN (SELECT value FROM json_each(?1)) AND NOT ({IS_OPINION_SQL}) ORDER BY token_id, id"
    ))?;
    let mut values: BTreeMap<i64, Vec<TokenValueRow>> = BTreeMap::new();
    let mut rows = statement.query([json_list(tokens)])?;
    while let Some(row) = rows.next()? {
        values.entry(row.get(10)?).or_default().push(value_row(row)?);
    }
    Ok(values)
}

/// Distinguishes values that count from opinions: an opinion is *unset*, and its annotation holds what does not count.
pub(crate) const IS_OPINION_SQL: &str = "state = 'unset' AND annotation_id IS NOT NULL";

/// Returns the values of a token that count, in the order in which they were written.
pub(crate) fn load_token_values(connection: &Connection, token: i64) -> CorpusResult<Vec<TokenValueRow>> {
    let mut rows = load_values_and_opinions(connection, token)?;
    rows.retain(|row| row.state != ValueState::Unset || row.annotation_id.is_none());
    Ok(rows)
}

/// Returns whether an annotation says something that does not count.
pub(crate) fn is_opinion(connection: &Connection, annotation: i64) -> CorpusResult<bool> {
    let sql = format!("SELECT 1 FROM token_value WHERE annotation_id = ?1 AND {IS_OPINION_SQL}");
    connection.has_rows(&sql, [annotation])
}

/// Returns the standings of annotations that say something of a token which does not count, as far as they are not usual.
#[cfg(feature = "parquet")]
pub(crate) fn opinion_standings(connection: &Connection) -> CorpusResult<BTreeMap<i64, Option<OpinionStanding>>> {
    let sql = format!("SELECT annotation_id, standing FROM token_value WHERE {IS_OPINION_SQL}");
    connection.read_rows(&sql, [], |row| Ok((row.get(0)?, word_or_null(row, 1)?)))
}

/// Returns the tokens with an opinion about a component.
pub(crate) fn tokens_with_opinion(connection: &Connection, component: &str) -> CorpusResult<BTreeSet<i64>> {
    let sql = format!("SELECT token_id FROM token_value WHERE component = ?1 AND value IS NULL AND {IS_OPINION_SQL}");
    connection.read_values(&sql, [component])
}

/// Returns the values of a token and the opinions about it, in the order in which they were written.
pub(crate) fn load_values_and_opinions(connection: &Connection, token: i64) -> CorpusResult<Vec<TokenValueRow>> {
    let sql = format!("{SELECT_TOKEN_VALUES_SQL} FROM token_value WHERE token_id = ?1 ORDER BY id");
    connection.read_rows(&sql, [token], value_row)
}

/// Returns the opinions about a token, in the order in which they were written.
pub(crate) fn load_token_opinions(connection: &Connection, token: i64) -> CorpusResult<Vec<TokenValueRow>> {
    let sql =
        format!("{SELECT_TOKEN_VALUES_SQL} FROM token_value WHERE token_id = ?1 AND {IS_OPINION_SQL} ORDER BY id");
    connection.read_rows(&sql, [token], value_row)
}

const SELECT_TOKEN_VALUES_SQL: &str = "SELECT hand, component, feature, phase, position, state, value, inventory_id,
    annotation_id, standing";

fn value_row(row: &Row<'_>) -> rusqlite::Result<TokenValueRow> {
    Ok(TokenValueRow {
        hand: word_or_null(row, 0)?,
        component: read_word_column(row, 1)?,
        feature: row.get(2)?,
        phase: read_phase_columns(row, 3)?,
        state: read_word_column(row, 5)?,
        value: row.get(6)?,
        inventory_id: row.get(7)?,
        annotation_id: row.get(8)?,
        standing: word_or_null(row, 9)?,
    })
}

const SELECT_TOKEN_SQL: &str = "
    SELECT t.id, t.sign_id, s.label, t.recording_id, r.name, t.annotation_id, t.start_us, t.end_us,
           t.hand, t.origin, t.citation, t.source, l.name, s.homonym
    FROM token t JOIN sign s ON s.id = t.sign_id LEFT JOIN recording r ON r.id = t.recording_id
    LEFT JOIN lexicon l ON l.id = s.lexicon_id";

fn token_row(row: &Row<'_>) -> rusqlite::Result<TokenRow> {
    Ok(TokenRow {
        id: row.get(0)?,
        sign_id: row.get(1)?,
        gloss: row.get(2)?,
        recording_id: row.get(3)?,
        recording: row.get(4)?,
        annotation_id: row.get(5)?,
        start_us: row.get(6)?,
        end_us: row.get(7)?,
        hand: word_or_null(row, 8)?,
        origin: read_word_column(row, 9)?,
        citation: row.get(10)?,
        source: row.get(11)?,
        lexicon: row.get(12)?,
        homonym: row.get(13)?,
    })
}

/// Returns the token of that row.
pub(crate) fn load_token_row(connection: &Connection, id: i64) -> CorpusResult<TokenRow> {
    connection
        .find_row(&format!("{SELECT_TOKEN_SQL} WHERE t.id = ?1"), [id], token_row)?
        .ok_or_else(|| {
            CorpusError::from_wrong_message(format!("there is no token:{id}"))
                .with_error_place(format!("token:{id}"))
                .with_command_advice("`chereme list CORPUS tokens` lists them")
        })
}

/// The number of rows that one query asks for when a list of rows is read.
pub(crate) const MAX_ROWS_PER_QUERY: usize = 512;

/// Returns the existing tokens among these rows, by row.
pub(crate) fn load_token_rows(connection: &Connection, ids: &[i64]) -> CorpusResult<BTreeMap<i64, TokenRow>> {
    let sql = format!("{SELECT_TOKEN_SQL} WHERE t.id IN (SELECT value FROM json_each(?1))");
    connection.read_rows(&sql, [json_list(ids)], |row| Ok((row.get(0)?, token_row(row)?)))
}

/// Returns row numbers as a JSON list, for a single query.
pub(super) fn json_list(ids: &[i64]) -> String {
    let ids: Vec<String> = ids.iter().map(i64::to_string).collect();
    format!("[{}]", ids.join(","))
}

/// Returns the tokens of a recording by time.
pub(crate) fn tokens_of_recording(connection: &Connection, recording: i64) -> CorpusResult<Vec<TokenRow>> {
    let sql = format!("{SELECT_TOKEN_SQL} WHERE t.recording_id = ?1 ORDER BY t.start_us, t.id");
    connection.read_rows(&sql, [recording], token_row)
}

/// Returns the tokens of a recording that overlap or touch a span, by time.
pub(crate) fn tokens_near(
    connection: &Connection,
    recording: i64,
    start_us: i64,
    end_us: i64,
) -> CorpusResult<Vec<TokenRow>> {
    let sql = format!(
        "{SELECT_TOKEN_SQL} WHERE t.recording_id = ?1 AND t.end_us >= ?2 AND t.start_us <= ?3
             AND t.start_us >= ?2 - (SELECT o.end_us - o.start_us FROM token o
                                     WHERE o.recording_id = ?1
                                     ORDER BY o.end_us - o.start_us DESC LIMIT 1)
         ORDER BY t.start_us, t.id"
    );
    connection.read_rows(&sql, [recording, start_us, end_us], token_row)
}

/// Returns the tokens of a sign, citation forms first.
pub(crate) fn tokens_of_sign(connection: &Connection, sign: i64) -> CorpusResult<Vec<TokenRow>> {
    let sql = format!("{SELECT_TOKEN_SQL} WHERE t.sign_id = ?1 ORDER BY t.citation DESC, t.id");
    connection.read_rows(&sql, [sign], token_row)
}

/// Returns whether a sign has a citation form.
pub(crate) fn has_citation(connection: &Connection, sign: i64) -> CorpusResult<bool> {
    connection.has_rows("SELECT 1 FROM token WHERE sign_id = ?1 AND citation = 1", [sign])
}

/// Returns whether a sign has a citation form that moves.
pub(crate) fn is_cited(connection: &Connection, sign: i64) -> CorpusResult<bool> {
    let sql = "SELECT 1 FROM token WHERE sign_id = ?1 AND citation = 1 AND recording_id IS NOT NULL";
    connection.has_rows(sql, [sign])
}

/// A token of a recording that holds a value.
pub(crate) struct HoldingRow {
    pub(crate) token: i64,
    pub(crate) hand: Option<AnnotatedHands>,
    pub(crate) left_handed: bool,
    /// The annotation that gives the value, within the token.
    pub(crate) span_us: Option<(i64, i64)>,
    /// The annotator, if known.
    pub(crate) by: Option<String>,
    /// The confidence of an accepted proposal.
    pub(crate) confidence: Option<f64>,
}

/// Returns the tokens of recordings that have a value of a component, captured ones first. Generated tokens are left
/// out: they show nothing beyond their sources, and would be compared with themselves.
pub(crate) fn tokens_holding(connection: &Connection, component: &str, value: &str) -> CorpusResult<Vec<HoldingRow>> {
    // Tokens of people come first, and 200 are more than a recipe ever tries.
    let sql = "SELECT t.id, v.hand, coalesce(g.handedness = 'left', 0),
                max(a.start_us, t.start_us), min(a.end_us, t.end_us), i.annotator, a.confidence
         FROM token_value v JOIN token t ON t.id = v.token_id
         JOIN recording r ON r.id = t.recording_id
         LEFT JOIN signer g ON g.id = r.signer_id
         LEFT JOIN annotation a ON a.id = v.annotation_id LEFT JOIN tier i ON i.id = a.tier_id
         WHERE v.component = ?1 AND v.feature IS NULL AND v.value = ?2 AND r.origin <> 'made'
         ORDER BY r.origin <> 'captured', t.id, v.id
         LIMIT 200";
    connection.read_rows(sql, params![component, value], |row| {
        let start: Option<i64> = row.get(3)?;
        let end: Option<i64> = row.get(4)?;
        Ok(HoldingRow {
            token: row.get(0)?,
            hand: word_or_null(row, 1)?,
            left_handed: row.get(2)?,
            // An annotation may only touch its token, and has no time in common with it.
            span_us: start.zip(end).filter(|(start, end)| start < end),
            by: row.get(5)?,
            confidence: row.get(6)?,
        })
    })
}

/// Returns how many tokens have a value of the inventory of that row.
pub(crate) fn tokens_with(connection: &Connection, inventory: i64, value: &str) -> CorpusResult<u64> {
    let sql = "SELECT count(DISTINCT token_id) FROM token_value
             WHERE inventory_id = ?1 AND value = ?2";
    let count: i64 = connection.read_value(sql, params![inventory, value])?;
    Ok(count.unsigned_abs())
}

/// Returns the entries of lexicons, of all signs.
pub(crate) fn lexicon_entries(connection: &Connection) -> CorpusResult<Vec<TokenRow>> {
    let sql = format!("{SELECT_TOKEN_SQL} WHERE t.origin = ?1 ORDER BY t.id");
    connection.read_rows(&sql, [NamedColumn(RecordOrigin::Lexicon)], token_row)
}

/// Returns one citation form of each sign. A sign that has one in a lexicon and one with movement is represented by the
/// one that is coded for more components, else by the one with movement.
pub(crate) fn load_citation_tokens(connection: &Connection) -> CorpusResult<Vec<TokenRow>> {
    load_ranked_citation_tokens(connection, "")
}

/// Returns one citation form of each sign, whose coding stands for the sign: one of a lexicon or an annotated one before
/// one that was made, since that has the values of its recipe or notation.
pub(crate) fn load_coded_citation_tokens(connection: &Connection) -> CorpusResult<Vec<TokenRow>> {
    load_ranked_citation_tokens(connection, "c.origin IN ('made', 'generated'),")
}

fn load_ranked_citation_tokens(connection: &Connection, first_rank: &str) -> CorpusResult<Vec<TokenRow>> {
    // A form that is coded more fully stands for its sign; of equal ones the one that can be seen moving.
    let sql = format!(
        "{SELECT_TOKEN_SQL} WHERE t.citation = 1 AND t.id =
                (SELECT c.id FROM token c WHERE c.sign_id = t.sign_id AND c.citation = 1
                 ORDER BY {first_rank} (SELECT count(DISTINCT v.component) FROM token_value v
                           WHERE v.token_id = c.id AND v.state <> 'unset') DESC,
                          c.recording_id IS NULL, c.id
                 LIMIT 1)
         ORDER BY t.id"
    );
    connection.read_rows(&sql, [], token_row)
}

/// Returns the citation forms of signs that have several, by sign.
pub(crate) fn load_several_citations(connection: &Connection) -> CorpusResult<BTreeMap<i64, Vec<TokenRow>>> {
    let sql = format!(
        "{SELECT_TOKEN_SQL} WHERE t.citation = 1 AND t.sign_id IN
             (SELECT sign_id FROM token WHERE citation = 1 GROUP BY sign_id HAVING count(*) > 1)
         ORDER BY t.origin IN ('made', 'generated'), t.id"
    );
    let mut several: BTreeMap<i64, Vec<TokenRow>> = BTreeMap::new();
    connection.visit_rows(&sql, [], |row| {
        let token = token_row(row)?;
        several.entry(token.sign_id).or_default().push(token);
        Ok(())
    })?;
    Ok(several)
}
