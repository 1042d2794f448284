//! Plans and participants as rows, and rows as plans and participants.

use rusqlite::Connection;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::answers::{ANSWERS_FORMAT, ANSWERS_VERSION, Answer, Participant};
use super::plan::{Plan, Role};
use crate::db::studies::{self as db, AnswerRow, ParticipantRow, StudyRow};
use crate::error::{Error, Result};

/// A study as stored.
pub(super) struct Stored {
    pub(super) id: i64,
    pub(super) plan: Plan,
    /// The hash of the plan when it was stored: a later version may write the plan's JSON in another form.
    pub(super) sha256: String,
}

/// Returns the study of that name.
pub(super) fn study(connection: &Connection, name: &str) -> Result<Option<Stored>> {
    let found = db::study(connection, name)?;
    let stored = found.map(|(id, it)| {
        let mut plan: Plan = read(&it.plan, || format!("study {name:?}"))?;
        // A merge gives another name to a study whose name is taken.
        plan.name = it.name;
        let sha256 = it.plan_sha256;
        Ok(Stored { id, plan, sha256 })
    });
    stored.transpose()
}

/// Returns a plan as a row.
pub(super) fn row(plan: &Plan) -> StudyRow {
    StudyRow {
        name: plan.name.clone(),
        plan: json(plan),
        plan_sha256: plan.sha256(),
    }
}

/// Returns the participants of a study with their answers, by code; only the one with that code, if one is given.
pub(super) fn participants(
    connection: &Connection,
    study: &Stored,
    code: Option<&str>,
) -> Result<Vec<Participant>> {
    let name = &study.plan.name;
    let mut all = Vec::new();
    for (id, it) in db::participants(connection, study.id, code)? {
        let place = || format!("participant {:?} of study {name:?}", it.code);
        let answers = db::answers(connection, id)?;
        all.push(Participant {
            format: ANSWERS_FORMAT.to_owned(),
            version: ANSWERS_VERSION,
            study: name.clone(),
            plan_sha256: study.sha256.clone(),
            profile: read(&it.profile, place)?,
            consent: read(&it.consent, place)?,
            device: read(&it.device, place)?,
            answers: answers.into_iter().map(answer).collect(),
            code: it.code,
            started_day: it.started_day,
            language: it.language,
            seed: it.seed,
            finished: it.finished,
            skipped: Vec::new(),
        });
    }
    Ok(all)
}

/// Stores a participant with all answers.
pub(super) fn insert(connection: &Connection, study: i64, it: &Participant) -> Result<()> {
    let row = ParticipantRow {
        code: it.code.clone(),
        started_day: it.started_day.clone(),
        language: it.language.clone(),
        seed: it.seed,
        finished: it.finished,
        profile: json(&it.profile),
        consent: json(&it.consent),
        device: json(&it.device),
    };
    let participant = db::insert_participant(connection, study, &row)?;
    for it in &it.answers {
        let row = AnswerRow {
            n: it.n,
            block: it.block,
            part: it.part.clone(),
            item: it.item.clone(),
            condition: it.condition.clone(),
            role: it.role.name().to_owned(),
            question: it.question.clone(),
            low: it.scale.map(|ends| ends[0]),
            high: it.scale.map(|ends| ends[1]),
            value: it.value,
            choice: it.choice.clone(),
            right: it.right,
            plays: it.plays,
            ms: it.ms,
            hidden: it.hidden,
            slow: it.slow,
        };
        db::insert_answer(connection, participant, &row)?;
    }
    Ok(())
}

fn answer(it: AnswerRow) -> Answer {
    Answer {
        n: it.n,
        block: it.block,
        part: it.part,
        item: it.item,
        condition: it.condition,
        role: Role::named(&it.role).unwrap_or_default(),
        question: it.question,
        scale: it.low.zip(it.high).map(|(low, high)| [low, high]),
        value: it.value,
        choice: it.choice,
        right: it.right,
        plays: it.plays,
        ms: it.ms,
        hidden: it.hidden,
        slow: it.slow,
    }
}

fn json(value: &impl Serialize) -> String {
    // Plans and participants have text keys and finite numbers only.
    serde_json::to_string(value).unwrap_or_else(|_| "{}".to_owned())
}

fn read<T: DeserializeOwned>(json: &str, place: impl Fn() -> String) -> Result<T> {
    serde_json::from_str(json).map_err(|error| Error::Damaged {
        place: place(),
        reason: error.to_string(),
    })
}
