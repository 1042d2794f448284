//! Rows of perceptual studies, their participants and answers.

use rusqlite::types::Type;
use rusqlite::{Connection, OptionalExtension, Row, params};
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::damaged;
use crate::error::Result;
use crate::study::answers::{ANSWERS_FORMAT, ANSWERS_VERSION, Answer, Participant};
use crate::study::plan::{Plan, Role};

/// Returns the names of all studies.
pub(crate) fn names(connection: &Connection) -> Result<Vec<String>> {
    let mut statement = connection.prepare_cached("SELECT name FROM study ORDER BY name")?;
    let names = statement.query_map([], |row| row.get(0))?;
    Ok(names.collect::<rusqlite::Result<_>>()?)
}

/// Returns the row and plan of the study of that name.
pub(crate) fn plan(connection: &Connection, name: &str) -> Result<Option<(i64, Plan)>> {
    let found: Option<(i64, String)> = connection
        .prepare_cached("SELECT id, plan FROM study WHERE name = ?1")?
        .query_row([name], |row| Ok((row.get(0)?, row.get(1)?)))
        .optional()?;
    let Some((id, json)) = found else {
        return Ok(None);
    };
    let plan = serde_json::from_str(&json)
        .map_err(|error| damaged(format!("study {name}"), error.to_string()))?;
    Ok(Some((id, plan)))
}

/// Adds a study, and returns its row.
pub(crate) fn insert(connection: &Connection, plan: &Plan) -> Result<i64> {
    connection
        .prepare_cached("INSERT INTO study (name, plan, plan_sha256) VALUES (?1, ?2, ?3)")?
        .execute(params![plan.name, json(plan), plan.sha256()])?;
    Ok(connection.last_insert_rowid())
}

/// Replaces the plan of a study.
pub(crate) fn replace(connection: &Connection, id: i64, plan: &Plan) -> Result<()> {
    connection
        .prepare_cached("UPDATE study SET plan = ?2, plan_sha256 = ?3 WHERE id = ?1")?
        .execute(params![id, json(plan), plan.sha256()])?;
    Ok(())
}

/// Removes a study with its participants and their answers.
pub(crate) fn delete(connection: &Connection, id: i64) -> Result<()> {
    for sql in [
        "DELETE FROM study_answer WHERE participant_id IN (SELECT id FROM study_participant WHERE study_id = ?1)",
        "DELETE FROM study_participant WHERE study_id = ?1",
        "DELETE FROM study WHERE id = ?1",
    ] {
        connection.prepare_cached(sql)?.execute([id])?;
    }
    Ok(())
}

/// Returns how many participants a study has.
pub(crate) fn participant_count(connection: &Connection, study: i64) -> Result<u64> {
    let count: i64 = connection
        .prepare_cached("SELECT count(*) FROM study_participant WHERE study_id = ?1")?
        .query_row([study], |row| row.get(0))?;
    Ok(u64::try_from(count).unwrap_or_default())
}

/// Returns the participants of a study with their answers, by code; only the one with that code, if one is given.
pub(crate) fn participants(
    connection: &Connection,
    study: i64,
    plan: &Plan,
    code: Option<&str>,
) -> Result<Vec<Participant>> {
    let mut statement = connection.prepare_cached(
        "SELECT id, code, started_day, language, seed, finished, profile, consent, device
         FROM study_participant WHERE study_id = ?1 AND (?2 IS NULL OR code = ?2) ORDER BY code",
    )?;
    let sha256 = plan.sha256();
    let rows = statement.query_map(params![study, code], |row| {
        let head = Participant {
            format: ANSWERS_FORMAT.to_owned(),
            version: ANSWERS_VERSION,
            study: plan.name.clone(),
            plan_sha256: sha256.clone(),
            code: row.get(1)?,
            started_day: row.get(2)?,
            language: row.get(3)?,
            seed: row.get(4)?,
            finished: row.get(5)?,
            profile: parsed(row, 6)?,
            consent: parsed(row, 7)?,
            device: parsed(row, 8)?,
            answers: Vec::new(),
        };
        Ok((row.get::<_, i64>(0)?, head))
    })?;
    let mut found = rows.collect::<rusqlite::Result<Vec<_>>>()?;
    for (id, head) in &mut found {
        head.answers = answers(connection, *id)?;
    }
    Ok(found.into_iter().map(|(_, head)| head).collect())
}

/// Returns the answers of a participant, in the order in which they were given.
fn answers(connection: &Connection, participant: i64) -> Result<Vec<Answer>> {
    let mut statement = connection.prepare_cached(
        "SELECT n, block, part, item, condition, role, question, low, high, value, choice, right, plays, ms, hidden, slow
         FROM study_answer WHERE participant_id = ?1 ORDER BY id",
    )?;
    let rows = statement.query_map([participant], |row| {
        let (low, high): (Option<i64>, Option<i64>) = (row.get(7)?, row.get(8)?);
        let role: String = row.get(5)?;
        Ok(Answer {
            n: row.get(0)?,
            block: row.get(1)?,
            part: row.get(2)?,
            item: row.get(3)?,
            condition: row.get(4)?,
            role: Role::named(&role).unwrap_or_default(),
            question: row.get(6)?,
            scale: low.zip(high).map(|(low, high)| [low, high]),
            value: row.get(9)?,
            choice: row.get(10)?,
            right: row.get(11)?,
            plays: row.get(12)?,
            ms: row.get(13)?,
            hidden: row.get(14)?,
            slow: row.get(15)?,
        })
    })?;
    Ok(rows.collect::<rusqlite::Result<_>>()?)
}

/// Returns the row of a participant, and whether the questionnaire was finished.
pub(crate) fn participant(
    connection: &Connection,
    study: i64,
    code: &str,
) -> Result<Option<(i64, bool)>> {
    let sql = "SELECT id, finished FROM study_participant WHERE study_id = ?1 AND code = ?2";
    let mut statement = connection.prepare_cached(sql)?;
    let found = statement.query_row(params![study, code], |row| Ok((row.get(0)?, row.get(1)?)));
    Ok(found.optional()?)
}

/// Adds a participant with all answers.
pub(crate) fn insert_participant(
    connection: &Connection,
    study: i64,
    it: &Participant,
) -> Result<()> {
    connection
        .prepare_cached(
            "INSERT INTO study_participant
                 (study_id, code, started_day, language, seed, finished, profile, consent, device)
             VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)",
        )?
        .execute(params![
            study,
            it.code,
            it.started_day,
            it.language,
            it.seed,
            it.finished,
            json(&it.profile),
            json(&it.consent),
            json(&it.device),
        ])?;
    let participant = connection.last_insert_rowid();
    let mut statement = connection.prepare_cached(
        "INSERT INTO study_answer (participant_id, n, block, part, item, condition, role, question,
             low, high, value, choice, right, plays, ms, hidden, slow)
         VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16, ?17)",
    )?;
    for answer in &it.answers {
        statement.execute(params![
            participant,
            answer.n,
            answer.block,
            answer.part,
            answer.item,
            answer.condition,
            answer.role.name(),
            answer.question,
            answer.scale.map(|it| it[0]),
            answer.scale.map(|it| it[1]),
            answer.value,
            answer.choice,
            answer.right,
            answer.plays,
            answer.ms,
            answer.hidden,
            answer.slow,
        ])?;
    }
    Ok(())
}

/// Removes a participant with all answers.
pub(crate) fn delete_participant(connection: &Connection, id: i64) -> Result<()> {
    for sql in [
        "DELETE FROM study_answer WHERE participant_id = ?1",
        "DELETE FROM study_participant WHERE id = ?1",
    ] {
        connection.prepare_cached(sql)?.execute([id])?;
    }
    Ok(())
}

/// Returns a value as JSON.
fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_else(|_| "{}".to_owned())
}

/// Reads a column with JSON.
fn parsed<T: DeserializeOwned>(row: &Row<'_>, column: usize) -> rusqlite::Result<T> {
    let text: String = row.get(column)?;
    serde_json::from_str(&text).map_err(|error| {
        rusqlite::Error::FromSqlConversionFailure(column, Type::Text, Box::new(error))
    })
}
