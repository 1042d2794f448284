//! Plans and participants as rows, and rows as plans and participants.

use rusqlite::Connection;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::study_answers::{ANSWERS_FORMAT, ANSWERS_VERSION, StudyAnswer, StudyParticipant};
use super::study_plan::{StudyPlan, TrialRole};
use crate::db::stored_studies::{self as db, ParticipantRow, StudyAnswerRow, StudyRow};
use crate::error::{CorpusError, CorpusResult};

/// A study as stored.
pub(super) struct StoredStudy {
    pub(super) id: i64,
    pub(super) plan: StudyPlan,
    /// The hash of the plan when it was stored: a later version may write the plan's JSON in another form.
    pub(super) sha256: String,
}

/// Returns the study of that name.
pub(super) fn load_stored_study(connection: &Connection, name: &str) -> CorpusResult<Option<StoredStudy>> {
    let study_row = db::find_study_row(connection, name)?;
    let stored = study_row.map(|(id, it)| {
        let mut plan: StudyPlan = read_stored_json(&it.plan, || format!("study {name:?}"))?;
        // A merge gives another name to a study whose name is taken.
        plan.name = it.name;
        let sha256 = it.plan_sha256;
        Ok(StoredStudy { id, plan, sha256 })
    });
    stored.transpose()
}

/// Returns a plan as a row.
pub(super) fn study_plan_row(plan: &StudyPlan) -> StudyRow {
    StudyRow {
        name: plan.name.clone(),
        plan: study_json_text(plan),
        plan_sha256: plan.plan_sha256(),
    }
}

/// Returns the participants of a study with their answers, by code; only the one with that code, if one is given.
pub(super) fn stored_participants(
    connection: &Connection,
    study: &StoredStudy,
    code: Option<&str>,
) -> CorpusResult<Vec<StudyParticipant>> {
    let name = &study.plan.name;
    let mut all = Vec::new();
    for (id, it) in db::load_study_participants(connection, study.id, code)? {
        let place = || format!("participant {:?} of study {name:?}", it.code);
        let answers = db::load_participant_answers(connection, id)?;
        all.push(StudyParticipant {
            format: ANSWERS_FORMAT.to_owned(),
            version: ANSWERS_VERSION,
            study: name.clone(),
            plan_sha256: study.sha256.clone(),
            profile: read_stored_json(&it.profile, place)?,
            consent: read_stored_json(&it.consent, place)?,
            device: read_stored_json(&it.device, place)?,
            answers: answers.into_iter().map(answer_from_database_row).collect(),
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
pub(super) fn store_study_participant(connection: &Connection, study: i64, it: &StudyParticipant) -> CorpusResult<()> {
    let row = ParticipantRow {
        code: it.code.clone(),
        started_day: it.started_day.clone(),
        language: it.language.clone(),
        seed: it.seed,
        finished: it.finished,
        profile: study_json_text(&it.profile),
        consent: study_json_text(&it.consent),
        device: study_json_text(&it.device),
    };
    let participant = db::insert_participant(connection, study, &row)?;
    for it in &it.answers {
        let row = StudyAnswerRow {
            n: it.n,
            block: it.block,
            part: it.part.clone(),
            item: it.item.clone(),
            condition: it.condition.clone(),
            role: it.role.trial_role_name().to_owned(),
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

fn answer_from_database_row(it: StudyAnswerRow) -> StudyAnswer {
    StudyAnswer {
        n: it.n,
        block: it.block,
        part: it.part,
        item: it.item,
        condition: it.condition,
        role: TrialRole::trial_role_named(&it.role).unwrap_or_default(),
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

fn study_json_text(value: &impl Serialize) -> String {
    // Plans and participants have text keys and finite numbers only.
    serde_json::to_string(value).unwrap_or_else(|_| "{}".to_owned())
}

fn read_stored_json<T: DeserializeOwned>(json: &str, place: impl Fn() -> String) -> CorpusResult<T> {
    serde_json::from_str(json).map_err(|error| CorpusError::Damaged {
        place: place(),
        reason: error.to_string(),
    })
}
