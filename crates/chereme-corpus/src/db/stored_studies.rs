//! Rows of perceptual studies, their participants and answers.

use rusqlite::{Connection, params};
use sha2::{Digest as _, Sha256};

use super::damaged_row_error;
use super::stored_motion::to_hex_text;
use crate::db::cached_sql::CachedSql;
use crate::error::CorpusResult;

/// A study as stored.
pub(crate) struct StudyRow {
    pub(crate) name: String,
    /// The plan as JSON.
    pub(crate) plan: String,
    pub(crate) plan_sha256: String,
}

impl StudyRow {
    fn is_whole(&self) -> bool {
        to_hex_text(&Sha256::digest(self.plan.as_bytes())) == self.plan_sha256
    }
}

/// A participant as stored, without the answers; the last three are JSON.
pub(crate) struct ParticipantRow {
    pub(crate) code: String,
    pub(crate) started_day: String,
    pub(crate) language: String,
    pub(crate) seed: u32,
    pub(crate) finished: bool,
    pub(crate) profile: String,
    pub(crate) consent: String,
    pub(crate) device: String,
}

/// An answer as stored.
pub(crate) struct StudyAnswerRow {
    pub(crate) n: u32,
    pub(crate) block: u32,
    pub(crate) part: String,
    pub(crate) item: String,
    pub(crate) condition: String,
    pub(crate) role: String,
    pub(crate) question: String,
    pub(crate) low: Option<i64>,
    pub(crate) high: Option<i64>,
    pub(crate) value: Option<i64>,
    pub(crate) choice: Option<String>,
    pub(crate) right: Option<bool>,
    pub(crate) plays: u32,
    pub(crate) ms: u32,
    pub(crate) hidden: u32,
    pub(crate) slow: u32,
}

/// Returns the names of all studies.
pub(crate) fn list_study_names(connection: &Connection) -> CorpusResult<Vec<String>> {
    connection.read_values("SELECT name FROM study ORDER BY name", [])
}

/// Returns the row number of the study of that name, and the study.
pub(crate) fn find_study_row(connection: &Connection, name: &str) -> CorpusResult<Option<(i64, StudyRow)>> {
    let sql = "SELECT id, name, plan, plan_sha256 FROM study WHERE name = ?1";
    let study_row = connection.find_row(sql, [name], |row| {
        let it = StudyRow {
            name: row.get(1)?,
            plan: row.get(2)?,
            plan_sha256: row.get(3)?,
        };
        Ok((row.get(0)?, it))
    })?;
    // A plan that was changed afterwards no longer describes what participants answered to.
    match study_row {
        Some((_, study)) if !study.is_whole() => Err(damaged_row_error(
            format!("the study {name:?}"),
            "its plan does not match the hash that names it",
        )),
        found => Ok(found),
    }
}

/// Returns the row number of a study with that plan.
pub(crate) fn with_plan(connection: &Connection, sha256: &str) -> CorpusResult<Option<i64>> {
    let sql = "SELECT id FROM study WHERE plan_sha256 = ?1 ORDER BY id LIMIT 1";
    let study_id = connection.find_value(sql, [sha256])?;
    Ok(study_id)
}

/// Returns the name, with a number after it if a study has it already.
pub(crate) fn free_study_name(connection: &Connection, name: &str) -> CorpusResult<String> {
    let mut free = name.to_owned();
    let mut count = 1;
    while find_study_row(connection, &free)?.is_some() {
        count += 1;
        free = format!("{name} ({count})");
    }
    Ok(free)
}

/// Returns the code, with a number after it if a participant of the study has it already.
pub(crate) fn free_code(connection: &Connection, study: i64, code: &str) -> CorpusResult<String> {
    let mut free = code.to_owned();
    let mut count = 1;
    while !load_study_participants(connection, study, Some(&free))?.is_empty() {
        count += 1;
        free = format!("{code}-{count}");
    }
    Ok(free)
}

/// Adds a study, and returns its row number.
pub(crate) fn insert_study_row(connection: &Connection, it: &StudyRow) -> CorpusResult<i64> {
    let sql = "INSERT INTO study (name, plan, plan_sha256) VALUES (?1, ?2, ?3)";
    connection.insert_row(sql, params![it.name, it.plan, it.plan_sha256])
}

/// Replaces the plan of a study.
pub(crate) fn replace_study_plan(connection: &Connection, id: i64, it: &StudyRow) -> CorpusResult<()> {
    let sql = "UPDATE study SET plan = ?2, plan_sha256 = ?3 WHERE id = ?1";
    connection.change_rows(sql, params![id, it.plan, it.plan_sha256])
}

/// Removes a study with its participants and their answers.
pub(crate) fn delete_study_row(connection: &Connection, id: i64) -> CorpusResult<()> {
    // Answers refer to participants, and these to the study.
    for sql in [
        "DELETE FROM study_answer WHERE participant_id IN (SELECT id FROM study_participant WHERE study_id = ?1)",
        "DELETE FROM study_participant WHERE study_id = ?1",
        "DELETE FROM study WHERE id = ?1",
    ] {
        connection.change_rows(sql, [id])?;
    }
    Ok(())
}

/// Returns how many participants a study has.
pub(crate) fn participant_count(connection: &Connection, study: i64) -> CorpusResult<u64> {
    let count: i64 = connection.read_value("SELECT count(*) FROM study_participant WHERE study_id = ?1", [study])?;
    Ok(u64::try_from(count).unwrap_or_default())
}

/// Returns how many participants a study has, how many of them finished, and the number of all answers.
pub(crate) fn count_study_participants(connection: &Connection, study: i64) -> CorpusResult<[u64; 3]> {
    let sql = "SELECT count(*), coalesce(sum(finished), 0),
                 (SELECT count(*) FROM study_answer WHERE participant_id IN
                     (SELECT id FROM study_participant WHERE study_id = ?1))
             FROM study_participant WHERE study_id = ?1";
    let counts: [i64; 3] = connection.read_row(sql, [study], |row| Ok([row.get(0)?, row.get(1)?, row.get(2)?]))?;
    Ok(counts.map(|value| u64::try_from(value).unwrap_or_default()))
}

/// Returns the participants of a study with their row numbers, by code; only the one with that code, if one is given.
pub(crate) fn load_study_participants(
    connection: &Connection,
    study: i64,
    code: Option<&str>,
) -> CorpusResult<Vec<(i64, ParticipantRow)>> {
    let sql = "SELECT id, code, started_day, language, seed, finished, profile, consent, device
         FROM study_participant WHERE study_id = ?1 AND (?2 IS NULL OR code = ?2) ORDER BY code";
    connection.read_rows(sql, params![study, code], |row| {
        let it = ParticipantRow {
            code: row.get(1)?,
            started_day: row.get(2)?,
            language: row.get(3)?,
            seed: row.get(4)?,
            finished: row.get(5)?,
            profile: row.get(6)?,
            consent: row.get(7)?,
            device: row.get(8)?,
        };
        Ok((row.get(0)?, it))
    })
}

/// Returns the answers of a participant, in the order in which they were given.
pub(crate) fn load_participant_answers(connection: &Connection, participant: i64) -> CorpusResult<Vec<StudyAnswerRow>> {
    let sql = "SELECT n, block, part, item, condition, role, question, low, high, value, choice, right,
             plays, ms, hidden, slow
         FROM study_answer WHERE participant_id = ?1 ORDER BY id";
    connection.read_rows(sql, [participant], |row| {
        Ok(StudyAnswerRow {
            n: row.get(0)?,
            block: row.get(1)?,
            part: row.get(2)?,
            item: row.get(3)?,
            condition: row.get(4)?,
            role: row.get(5)?,
            question: row.get(6)?,
            low: row.get(7)?,
            high: row.get(8)?,
            value: row.get(9)?,
            choice: row.get(10)?,
            right: row.get(11)?,
            plays: row.get(12)?,
            ms: row.get(13)?,
            hidden: row.get(14)?,
            slow: row.get(15)?,
        })
    })
}

/// Adds a participant, and returns the row number.
pub(crate) fn insert_participant(connection: &Connection, study: i64, it: &ParticipantRow) -> CorpusResult<i64> {
    let sql = "INSERT INTO study_participant
                 (study_id, code, started_day, language, seed, finished, profile, consent, device)
             VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)";
    let values = params![
        study,
        it.code,
        it.started_day,
        it.language,
        it.seed,
        it.finished,
        it.profile,
        it.consent,
        it.device,
    ];
    connection.insert_row(sql, values)
}

/// Adds an answer of a participant.
pub(crate) fn insert_answer(connection: &Connection, participant: i64, it: &StudyAnswerRow) -> CorpusResult<()> {
    let sql = "INSERT INTO study_answer (participant_id, n, block, part, item, condition, role, question,
                 low, high, value, choice, right, plays, ms, hidden, slow)
             VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16, ?17)";
    let values = params![
        participant,
        it.n,
        it.block,
        it.part,
        it.item,
        it.condition,
        it.role,
        it.question,
        it.low,
        it.high,
        it.value,
        it.choice,
        it.right,
        it.plays,
        it.ms,
        it.hidden,
        it.slow,
    ];
    connection.change_rows(sql, values)
}

/// Removes a participant with all answers.
pub(crate) fn delete_participant(connection: &Connection, id: i64) -> CorpusResult<()> {
    for sql in [
        "DELETE FROM study_answer WHERE participant_id = ?1",
        "DELETE FROM study_participant WHERE id = ?1",
    ] {
        connection.change_rows(sql, [id])?;
    }
    Ok(())
}
