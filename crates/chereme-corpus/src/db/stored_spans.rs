//! Annotations of captured movement by time, for measurements.

use chereme_sign::tier::AnnotatedHands;
use rusqlite::{Connection, params};

use super::stored_columns::word_or_null;
use crate::db::cached_sql::CachedSql;
use crate::error::CorpusResult;

/// An annotation about the movement of a hand in a captured recording.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct MovementSpan {
    pub(crate) recording_id: i64,
    pub(crate) hand: Option<AnnotatedHands>,
    pub(crate) feature: Option<String>,
    pub(crate) start_us: i64,
    pub(crate) end_us: i64,
    pub(crate) value: String,
    pub(crate) inventory_id: Option<i64>,
}

/// The movement that a lexicon entry states for a captured token of the same sign.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct LexiconMovement {
    pub(crate) token: i64,
    /// The entry's token.
    pub(crate) entry: i64,
    pub(crate) recording_id: i64,
    pub(crate) start_us: i64,
    pub(crate) end_us: i64,
    pub(crate) feature: Option<String>,
    pub(crate) value: String,
}

/// A translation that was annotated while a token is signed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct AnnotatedTranslation {
    /// The language of its tier; empty if the tier states none.
    pub(crate) language: String,
    pub(crate) text: String,
    /// The number of other signs during it: with any, it is a sentence and no word.
    pub(crate) other_signs: usize,
}

/// Returns the translations of the signer of a token that hold for at least half of it, by tier and time.
pub(crate) fn translations_over_token(connection: &Connection, token: i64) -> CorpusResult<Vec<AnnotatedTranslation>> {
    let sql = "SELECT ifnull(i.language, ''), a.value,
                (SELECT count(*) FROM token o WHERE o.recording_id = t.recording_id AND o.sign_id <> t.sign_id
                   AND o.start_us < a.end_us AND o.end_us > a.start_us)
         FROM token t LEFT JOIN annotation own ON own.id = t.annotation_id LEFT JOIN tier g ON g.id = own.tier_id
         JOIN tier i ON i.recording_id = t.recording_id AND i.role = 'translation'
           AND ifnull(i.participant, '') IN ('', ifnull(g.participant, ''))
         JOIN annotation a ON a.tier_id = i.id AND a.state = 'value' AND a.value <> ''
         WHERE t.id = ?1
           AND 2 * (min(a.end_us, t.end_us) - max(a.start_us, t.start_us)) >= t.end_us - t.start_us
         ORDER BY i.position, a.start_us, a.id";
    connection.read_rows(sql, [token], |row| {
        Ok(AnnotatedTranslation {
            language: row.get(0)?,
            text: row.get(1)?,
            other_signs: row.get::<_, i64>(2)?.unsigned_abs() as usize,
        })
    })
}

/// Returns up to `most` annotated movements with their size, manner and phases, in captured recordings,
/// by recording and time.
///
/// Annotations by the program itself (a detector, a recipe) are left out.
pub(crate) fn movement_spans(connection: &Connection, most: usize) -> CorpusResult<Vec<MovementSpan>> {
    // The program's own findings must not become the measure by which it is tuned.
    let sql = "SELECT t.recording_id, t.hand, t.feature, a.start_us, a.end_us, a.value, t.inventory_id
         FROM tier t JOIN recording r ON r.id = t.recording_id JOIN annotation a ON a.tier_id = t.id
         WHERE t.component = 'movement' AND r.origin = 'captured' AND a.state = 'value'
           AND (t.feature IS NULL OR t.feature IN ('size', 'manner', 'phase'))
           AND a.origin IN ('file', 'human')
         ORDER BY t.recording_id, a.start_us, t.position, a.id LIMIT ?1";
    connection.read_rows(sql, [i64::try_from(most).unwrap_or(i64::MAX)], |row| {
        Ok(MovementSpan {
            recording_id: row.get(0)?,
            hand: word_or_null(row, 1)?,
            feature: row.get(2)?,
            start_us: row.get(3)?,
            end_us: row.get(4)?,
            value: row.get(5)?,
            inventory_id: row.get(6)?,
        })
    })
}

/// Returns up to `most` values of movement that lexicon entries state for captured tokens of the same sign that have no
/// value of their own; by token, entry and place in the entry.
pub(crate) fn lexicon_movements(connection: &Connection, most: usize) -> CorpusResult<Vec<LexiconMovement>> {
    // A value of the token's own says what was performed; the entry only what is usual.
    let mut statement = connection.prepare_cached(
        "SELECT t.id, l.id, t.recording_id, t.start_us, t.end_us, v.feature, v.value
         FROM token t JOIN token l ON l.sign_id = t.sign_id AND l.origin = 'lexicon'
              JOIN token_value v ON v.token_id = l.id
         WHERE t.origin = 'captured' AND t.recording_id IS NOT NULL
           AND v.component = 'movement' AND v.state = 'value'
           AND (v.hand IS NULL OR v.hand IN ('dominant', 'right', 'both'))
           AND NOT EXISTS (SELECT 1 FROM token_value o
                           WHERE o.token_id = t.id AND o.component = 'movement' AND o.state <> 'unset')
         ORDER BY t.id, l.id, v.id LIMIT ?1",
    )?;
    let most = i64::try_from(most).unwrap_or(i64::MAX);
    let rows = statement
        .query_map(params![most], |row| {
            Ok(LexiconMovement {
                token: row.get(0)?,
                entry: row.get(1)?,
                recording_id: row.get(2)?,
                start_us: row.get(3)?,
                end_us: row.get(4)?,
                feature: row.get(5)?,
                value: row.get(6)?,
            })
        })?
        .collect::<rusqlite::Result<_>>()?;
    Ok(rows)
}
