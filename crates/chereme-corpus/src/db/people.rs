//! Rows of people: who signs, who takes part and who annotates, under which names, and what is said of them.

use std::collections::BTreeMap;

use rusqlite::{Connection, OptionalExtension as _, params};
use serde::Serialize;

use super::consents::ConsentAudience;
use super::stored_recordings::{find_signer, signer_named};
use crate::db::cached_sql::CachedSql;
use crate::error::{CorpusError, CorpusResult};

/// The beginning of the name under which queries and tables know what is said of a signer: `signer.region`.
pub(crate) const SIGNER_ATTRIBUTE_PREFIX: &str = "signer.";

/// The annotator of tiers that settle what others disagree about; nobody has that name.
pub(crate) const ADJUDICATION_ANNOTATOR: &str = "adjudication";

/// The people `g` who sign or take part, or at least do not only annotate.
pub(crate) const SIGNER_ROWS_SQL: &str = "(SELECT * FROM signer s
    WHERE EXISTS (SELECT 1 FROM recording WHERE signer_id = s.id)
        OR EXISTS (SELECT 1 FROM tier WHERE participant = s.name)
        OR NOT EXISTS (SELECT 1 FROM tier WHERE annotator = s.name)) g";

/// The tokens `t` with their signer: the participant `p` of their tier if the corpus knows that person, otherwise the signer
/// of the recording `r`.
pub(crate) const SIGNED_TOKENS_SQL: &str = "token t LEFT JOIN recording r ON r.id = t.recording_id
    LEFT JOIN annotation a ON a.id = t.annotation_id
    LEFT JOIN tier i ON i.id = a.tier_id LEFT JOIN signer p ON p.name = i.participant";

/// A person, with all that the corpus knows of them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PersonContents {
    /// The row.
    pub id: i64,
    /// The name that the corpus uses.
    pub name: String,
    /// Other names under which files know the person.
    pub aliases: Vec<String>,
    /// `right`, `left`, or unknown.
    pub handedness: Option<String>,
    /// Remarks.
    pub notes: Option<String>,
    /// What is said of the person, by name.
    pub attributes: Vec<PersonAttribute>,
    /// The recordings whose signer the person is.
    pub recordings: u64,
    /// The tiers whose participant the person is.
    pub participant_tiers: u64,
    /// The tiers whose annotator the person is.
    pub annotator_tiers: u64,
}

/// Something that is said of a person: a region, an age group, a school.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PersonAttribute {
    /// Its name.
    pub name: String,
    /// Its content.
    pub text: String,
    /// The number that the content is, if it is one.
    pub number: Option<f64>,
    /// Who may see it.
    pub audience: ConsentAudience,
}

/// Returns all people by name.
pub(crate) fn load_people(connection: &Connection) -> CorpusResult<Vec<PersonContents>> {
    select_people(connection, "ORDER BY g.name", [])
}

/// Returns the person of a row.
pub(crate) fn load_person(connection: &Connection, id: i64) -> CorpusResult<PersonContents> {
    let person = select_people(connection, "WHERE g.id = ?1", [id])?.pop();
    person.ok_or_else(|| CorpusError::from_wrong_message(format!("there is no signer:{id}")))
}

fn select_people(
    connection: &Connection,
    which: &str,
    parameters: impl rusqlite::Params,
) -> CorpusResult<Vec<PersonContents>> {
    let sql = format!(
        "SELECT g.id, g.name, g.handedness, g.notes,
             (SELECT count(*) FROM recording WHERE signer_id = g.id),
             (SELECT count(*) FROM tier WHERE participant = g.name),
             (SELECT count(*) FROM tier WHERE annotator = g.name)
         FROM signer g {which}"
    );
    let mut people: Vec<PersonContents> = connection.read_rows(&sql, parameters, |row| {
        let count = |at| Ok::<_, rusqlite::Error>(row.get::<_, i64>(at)?.unsigned_abs());
        Ok(PersonContents {
            id: row.get(0)?,
            name: row.get(1)?,
            aliases: Vec::new(),
            handedness: row.get(2)?,
            notes: row.get(3)?,
            attributes: Vec::new(),
            recordings: count(4)?,
            participant_tiers: count(5)?,
            annotator_tiers: count(6)?,
        })
    })?;
    for person in &mut people {
        person.aliases = load_person_aliases(connection, person.id)?;
        person.attributes = load_person_attributes(connection, person.id)?;
    }
    Ok(people)
}

/// Returns the other names of a person, by name.
pub(crate) fn load_person_aliases(connection: &Connection, person: i64) -> CorpusResult<Vec<String>> {
    let sql = "SELECT name FROM person_alias WHERE signer_id = ?1 ORDER BY name";
    connection.read_values(sql, [person])
}

/// Returns what is said of a person, by name.
pub(crate) fn load_person_attributes(connection: &Connection, person: i64) -> CorpusResult<Vec<PersonAttribute>> {
    let sql = "SELECT name, text, number, audience FROM person_attribute WHERE signer_id = ?1 ORDER BY name";
    connection.read_rows(sql, [person], |row| {
        let audience = row.get::<_, String>(3)?;
        Ok(PersonAttribute {
            name: row.get(0)?,
            text: row.get(1)?,
            number: row.get(2)?,
            // A word that nobody knows must not open a door.
            audience: audience.parse().unwrap_or(ConsentAudience::Nobody),
        })
    })
}

/// Says something of a person, or something else than before.
pub(crate) fn set_person_attribute(
    connection: &Connection,
    person: i64,
    attribute: &PersonAttribute,
) -> CorpusResult<()> {
    let sql = "INSERT INTO person_attribute (signer_id, name, text, number, audience) VALUES (?1, ?2, ?3, ?4, ?5)
             ON CONFLICT (signer_id, name) DO UPDATE SET text = ?3, number = ?4, audience = ?5
             WHERE text <> ?3 OR audience <> ?5";
    let values = params![
        person,
        attribute.name,
        attribute.text,
        attribute.number,
        attribute.audience.audience_name()
    ];
    connection.change_rows(sql, values)
}

/// Removes what is said of a person under a name, and returns whether it was there.
pub(crate) fn remove_person_attribute(connection: &Connection, person: i64, name: &str) -> CorpusResult<bool> {
    let sql = "DELETE FROM person_attribute WHERE signer_id = ?1 AND name = ?2";
    let removed = connection.count_changes(sql, params![person, name])?;
    Ok(removed > 0)
}

/// Returns the person whose other name this is.
pub(crate) fn find_person_by_alias(connection: &Connection, name: &str) -> CorpusResult<Option<i64>> {
    let sql = "SELECT signer_id FROM person_alias WHERE name = ?1";
    let person = connection.prepare_cached(sql)?.query_row([name], |row| row.get(0));
    Ok(person.optional()?)
}

/// Gives a person another name, which no person has.
pub(crate) fn insert_person_alias(connection: &Connection, person: i64, name: &str) -> CorpusResult<()> {
    let sql = "INSERT INTO person_alias (signer_id, name) VALUES (?1, ?2)";
    connection.change_rows(sql, params![person, name])
}

/// Takes another name from a person, and returns whether it was there.
pub(crate) fn remove_person_alias(connection: &Connection, person: i64, name: &str) -> CorpusResult<bool> {
    let sql = "DELETE FROM person_alias WHERE signer_id = ?1 AND name = ?2";
    let removed = connection.count_changes(sql, params![person, name])?;
    Ok(removed > 0)
}

/// Makes all that one person has and did another's: recordings, other names and what is said of them. What the other has
/// of that name already stays; the person's row goes.
pub(crate) fn move_person_rows(connection: &Connection, from: i64, into: i64) -> CorpusResult<()> {
    for sql in [
        "UPDATE recording SET signer_id = ?2 WHERE signer_id = ?1",
        "UPDATE person_alias SET signer_id = ?2 WHERE signer_id = ?1",
        "DELETE FROM person_attribute WHERE signer_id = ?1
         AND name IN (SELECT name FROM person_attribute WHERE signer_id = ?2)",
        "UPDATE person_attribute SET signer_id = ?2 WHERE signer_id = ?1",
    ] {
        connection.change_rows(sql, [from, into])?;
    }
    connection.change_rows("DELETE FROM signer WHERE id = ?1", [from])
}

/// Removes a person of whom the corpus has nothing else, with their other names and what is said of them.
pub(crate) fn delete_person(connection: &Connection, person: i64) -> CorpusResult<()> {
    for sql in [
        "DELETE FROM person_alias WHERE signer_id = ?1",
        "DELETE FROM person_attribute WHERE signer_id = ?1",
        "DELETE FROM signer WHERE id = ?1",
    ] {
        connection.change_rows(sql, [person])?;
    }
    Ok(())
}

/// Returns the name that the corpus uses for somebody whom a file names, and adds that person if nobody has the name. An
/// empty name and the adjudication are nobody.
pub(crate) fn known_person_name(connection: &Connection, name: Option<&str>) -> CorpusResult<Option<String>> {
    let Some(name) = name else { return Ok(None) };
    if name.trim().is_empty() || name == ADJUDICATION_ANNOTATOR {
        return Ok(Some(name.to_owned()));
    }
    if let Some(person) = find_signer(connection, name)? {
        return Ok(Some(person.name));
    }
    signer_named(connection, name, None)?;
    Ok(Some(name.to_owned()))
}

/// Returns the name of the signer of each of these tokens that has one.
pub(crate) fn signers_of_tokens(connection: &Connection, tokens: &[i64]) -> CorpusResult<BTreeMap<i64, (i64, String)>> {
    let sql = format!(
        "SELECT t.id, g.id, g.name FROM {SIGNED_TOKENS_SQL} JOIN signer g ON g.id = coalesce(p.id, r.signer_id)
         WHERE t.id IN (SELECT value FROM json_each(?1))"
    );
    connection.read_rows(&sql, [super::signs::json_list(tokens)], |row| {
        Ok((row.get(0)?, (row.get(1)?, row.get(2)?)))
    })
}
