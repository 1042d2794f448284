//! What the search index needs of the rows, and where its files lie among them.

use std::collections::BTreeSet;

use chereme_sign::text::fold;
use rusqlite::{Connection, OptionalExtension, Row, Transaction, TransactionBehavior, params};

use crate::error::Result;
use crate::search::terms::{reading_term, special};

/// A token as the index holds it.
pub(crate) struct TokenDocument {
    pub(crate) id: i64,
    pub(crate) sign: i64,
    pub(crate) recording: Option<i64>,
    pub(crate) signer: Option<i64>,
    pub(crate) gloss: String,
    pub(crate) words: String,
    pub(crate) translations: Vec<String>,
    pub(crate) comments: Vec<String>,
    pub(crate) readings: BTreeSet<String>,
    pub(crate) facets: BTreeSet<String>,
    pub(crate) origin: String,
    pub(crate) time: Option<(i64, i64)>,
}

/// Returns the tokens that the running operation touched.
pub(crate) fn touched(connection: &Connection) -> Result<Vec<i64>> {
    let mut statement =
        connection.prepare_cached("SELECT token_id FROM temp.touched ORDER BY token_id")?;
    let tokens = statement
        .query_map([], |row| row.get(0))?
        .collect::<rusqlite::Result<_>>()?;
    Ok(tokens)
}

/// Returns how many row changes of the running operation the schema's counter has counted.
pub(crate) fn touches(connection: &Connection) -> Result<i64> {
    let count = connection
        .prepare_cached(
            "SELECT count(*) FROM temp.change
             WHERE tbl IN ('token', 'token_value', 'sign_text', 'annotation')
                OR (kind = 'u' AND tbl IN ('sign', 'tier', 'recording', 'signer'))",
        )?
        .query_row([], |row| row.get(0))?;
    Ok(count)
}

const TOKEN: &str = "
    SELECT t.id, t.sign_id, t.recording_id, r.signer_id, s.gloss, s.notes, t.origin,
           t.start_us, t.end_us, g.handedness
    FROM token t JOIN sign s ON s.id = t.sign_id
    LEFT JOIN recording r ON r.id = t.recording_id
    LEFT JOIN signer g ON g.id = r.signer_id";

/// Calls `take` with each of the tokens in `only`, or with all of them.
pub(crate) fn each(
    connection: &Connection,
    only: Option<&[i64]>,
    mut take: impl FnMut(TokenDocument) -> Result<()>,
) -> Result<()> {
    match only {
        Some(tokens) => {
            let mut statement = connection.prepare_cached(&format!("{TOKEN} WHERE t.id = ?1"))?;
            for token in tokens {
                let found = statement
                    .query_row([token], |row| read(connection, row))
                    .optional()?;
                found.map_or(Ok(()), &mut take)?;
            }
        }
        None => {
            let mut statement = connection.prepare(&format!("{TOKEN} ORDER BY t.id"))?;
            let mut rows = statement.query([])?;
            while let Some(row) = rows.next()? {
                take(read(connection, row)?)?;
            }
        }
    }
    Ok(())
}

fn read(connection: &Connection, row: &Row<'_>) -> rusqlite::Result<TokenDocument> {
    let gloss: String = row.get(4)?;
    let start: Option<i64> = row.get(7)?;
    let end: Option<i64> = row.get(8)?;
    let mut document = TokenDocument {
        id: row.get(0)?,
        sign: row.get(1)?,
        recording: row.get(2)?,
        signer: row.get(3)?,
        words: gloss.clone(),
        translations: Vec::new(),
        comments: Vec::new(),
        gloss: fold(&gloss),
        readings: BTreeSet::new(),
        facets: BTreeSet::new(),
        origin: row.get(6)?,
        time: start.zip(end).map(|(start, end)| (start, end - start)),
    };
    document.comments.extend(row.get::<_, Option<String>>(5)?);
    let left_handed = row.get::<_, Option<String>>(9)?.as_deref() == Some("left");
    add_texts(connection, &mut document)?;
    add_readings(connection, &mut document, left_handed)?;
    Ok(document)
}

fn add_texts(connection: &Connection, document: &mut TokenDocument) -> rusqlite::Result<()> {
    let mut statement =
        connection.prepare_cached("SELECT text FROM sign_text WHERE sign_id = ?1 ORDER BY id")?;
    let mut rows = statement.query([document.sign])?;
    while let Some(row) = rows.next()? {
        document.translations.push(row.get(0)?);
    }
    let Some(recording) = document.recording else {
        return Ok(());
    };
    let Some((start, duration)) = document.time else {
        return Ok(());
    };
    let mut statement = connection.prepare_cached(
        "SELECT a.value, i.role FROM tier i JOIN annotation a ON a.tier_id = i.id
         WHERE i.recording_id = ?1 AND i.role IN ('translation', 'comment')
           AND a.start_us < ?3 AND a.end_us > ?2 ORDER BY i.position, a.start_us",
    )?;
    let mut rows = statement.query([recording, start, start + duration])?;
    while let Some(row) = rows.next()? {
        let translation = row.get_ref(1)?.as_str()? == "translation";
        let texts = if translation {
            &mut document.translations
        } else {
            &mut document.comments
        };
        texts.push(row.get(0)?);
    }
    Ok(())
}

fn add_readings(
    connection: &Connection,
    document: &mut TokenDocument,
    left_handed: bool,
) -> rusqlite::Result<()> {
    let mut statement = connection.prepare_cached(
        "SELECT hand, component, feature, phase, state, value FROM token_value
         WHERE token_id = ?1 ORDER BY id",
    )?;
    let mut rows = statement.query([document.id])?;
    while let Some(row) = rows.next()? {
        let hand = row.get_ref(0)?.as_str_or_null()?;
        let component = row.get_ref(1)?.as_str()?;
        let feature = row.get_ref(2)?.as_str_or_null()?;
        let phase = row.get_ref(3)?.as_str_or_null()?;
        let state = row.get_ref(4)?.as_str()?;
        let value = row.get_ref(5)?.as_str_or_null()?;
        let terms: Vec<String> = match (state, value) {
            ("value", Some(value)) => vec![fold(value), special::ANY.to_owned()],
            ("not-applicable", _) => vec![special::NOT_APPLICABLE.to_owned()],
            ("unclear", _) => vec![special::UNCLEAR.to_owned()],
            _ => continue,
        };
        let code = phase_code(phase);
        for hand in hand_codes(hand, left_handed) {
            for term in &terms {
                document
                    .readings
                    .insert(reading_term(hand, code, component, feature, term));
            }
        }
        if let Some(value) = value {
            let place = hand.map_or(String::new(), |hand| format!("{hand}."));
            let part = feature.map_or(String::new(), |feature| format!(".{feature}"));
            document
                .facets
                .insert(format!("{place}{component}{part}={value}"));
        }
    }
    Ok(())
}

fn phase_code(phase: Option<&str>) -> &'static str {
    match phase {
        Some("initial") => "i",
        Some("middle") => "m",
        Some("final") => "f",
        _ => "o",
    }
}

/// A side and a part in signing for every hand; of both hands all four, and of no hand its own.
fn hand_codes(hand: Option<&str>, left_handed: bool) -> &'static [&'static str] {
    match (hand, left_handed) {
        (Some("right"), false) | (Some("dominant"), false) => &["r", "d"],
        (Some("left"), false) | (Some("weak"), false) => &["l", "w"],
        (Some("right"), true) | (Some("weak"), true) => &["r", "w"],
        (Some("left"), true) | (Some("dominant"), true) => &["l", "d"],
        (Some("both"), _) => &["r", "l", "d", "w"],
        _ => &["n"],
    }
}

/// The two counters that tell whether the index follows the rows, and the format it was made in.
pub(crate) struct State {
    pub(crate) content: i64,
    pub(crate) indexed: i64,
    pub(crate) format: i64,
}

impl State {
    pub(crate) fn read(connection: &Connection) -> Result<Self> {
        Ok(connection
            .prepare_cached("SELECT content, indexed, format FROM search_state WHERE id = 1")?
            .query_row([], |row| {
                Ok(Self {
                    content: row.get(0)?,
                    indexed: row.get(1)?,
                    format: row.get(2)?,
                })
            })?)
    }

    /// Writes down that an index of `format` has seen the first `indexed` changes.
    pub(crate) fn seen(connection: &Connection, indexed: i64, format: i64) -> Result<()> {
        connection.execute(
            "UPDATE search_state SET indexed = ?1, format = ?2 WHERE id = 1",
            [indexed, format],
        )?;
        Ok(())
    }
}

/// Begins a transaction that may write, on a connection that is only borrowed.
pub(crate) fn begin(connection: &Connection) -> Result<Transaction<'_>> {
    Ok(Transaction::new_unchecked(
        connection,
        TransactionBehavior::Immediate,
    )?)
}

/// Returns the index's files.
pub(crate) fn files(connection: &Connection) -> Result<Vec<(String, Vec<u8>)>> {
    let mut statement = connection.prepare_cached("SELECT path, data FROM search_file")?;
    let files = statement
        .query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?
        .collect::<rusqlite::Result<_>>()?;
    Ok(files)
}

/// Writes a file of the index.
pub(crate) fn write_file(connection: &Connection, path: &str, data: &[u8]) -> Result<()> {
    connection
        .prepare_cached(
            "INSERT INTO search_file (path, data) VALUES (?1, ?2)
             ON CONFLICT (path) DO UPDATE SET data = excluded.data",
        )?
        .execute(params![path, data])?;
    Ok(())
}

/// Deletes a file of the index.
pub(crate) fn delete_file(connection: &Connection, path: &str) -> Result<()> {
    connection
        .prepare_cached("DELETE FROM search_file WHERE path = ?1")?
        .execute([path])?;
    Ok(())
}

/// Deletes all files of the index.
pub(crate) fn delete_files(connection: &Connection) -> Result<()> {
    connection.execute("DELETE FROM search_file", [])?;
    Ok(())
}
