//! Perceptual studies: questionnaires that show signs to people, their answers, and reports.
//!
//! A study begins with a [plan](study_plan::StudyPlan): trials, questions, an order. It is built into a questionnaire, a folder that
//! works without a network; the answers that participants send back are imported, and stay with the plan in the corpus.
//!
//! | module | holds |
//! |---|---|
//! | [`study_plan`], [`study_answers`] | the plan, and the answers of a participant, as values |
//! | `request`, `trials`, `texts` | a plan from a few words or a table of trials, and its usual texts |
//! | `change` | a stored plan as the request that makes it again |
//! | `check` | the faults of a plan |
//! | `distances` | how far clips are from those of another condition |
//! | [`study_order`] | the study_order in which each participant sees the trials |
//! | `build` | the questionnaire |
//! | `import`, `files`, `fits` | answers from files, checked against the plan |
//! | `long`, `wide`, `rows` | answers as a table: one answer a row, or one participant a row |
//! | `listing` | the answers one by one, with those that are missing |
//! | `overview` | all studies at a glance, and the clip of a trial |
//! | `stored` | plans and participants as rows of the database |
//! | [`report`] | people, answers, comparisons and conclusions |

mod build;
mod distances;
mod fits;
mod listing;
pub mod report;
mod request;
mod stored;
pub mod study_answers;
mod study_change;
mod study_check;
mod study_files;
mod study_import;
mod study_long;
pub mod study_order;
mod study_overview;
pub mod study_plan;
mod study_rows;
mod study_texts;
mod study_trials;
mod wide;

use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::Path;
use std::sync::Arc;

use chereme_motion::anatomy::BodyAnatomy;
use chereme_motion::{Clip, FacePosture};
use chereme_sign::text::{did_you_mean, nearest_candidate};
use rusqlite::Connection;
use serde::Serialize;

use crate::Corpus;
use crate::db::stored_studies as db;
use crate::error::{CorpusError, CorpusResult};
use crate::progress::{ProgressReceiver, ProgressUnit};
use crate::words::effect::OperationEffect;
use stored::StoredStudy;
use study_answers::StudyParticipant;
use study_plan::StudyPlan;

pub use build::{BuiltQuestionnaire, QuestionnaireOptions};
pub use distances::DISTANCE_MEASURE_NAME;
pub use listing::{AnswerFilter, AnswerList, AnswerListRow, AnswerState, ParticipantSummary};
pub use request::{StudyRequest, split_quoted_words};
pub use study_import::{AnswersFile, AnswersOptions, AnswersReport, NamedText};
pub use study_overview::StudyOverview;
pub use wide::ColumnUse;

/// Returns the error for a code that no participant has.
fn no_participant(code: &str) -> CorpusError {
    let error = CorpusError::from_wrong_message(format!("no participant has the code {code:?}")).with_error_place(code);
    error.with_command_advice("`chereme study answers CORPUS NAME` lists the codes")
}

/// A study with everything that was answered.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StudyWithAnswers {
    /// The plan.
    pub plan: StudyPlan,
    /// The SHA-256 of the plan, by which answers name it.
    pub plan_sha256: String,
    /// The participants with their answers, by code.
    pub participants: Vec<StudyParticipant>,
}

/// A study that was planned.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlannedStudy {
    /// The plan.
    pub plan: StudyPlan,
    /// The SHA-256 of the plan, by which answers name it.
    pub plan_sha256: String,
    /// Whether it replaced an earlier plan of that name, which nobody had answered.
    pub replaced: bool,
}

/// The movement of a trial.
#[derive(Debug, Clone)]
pub struct StudyClip {
    /// The movement.
    pub clip: Clip,
    /// What the joints are.
    pub anatomy: Arc<BodyAnatomy>,
    /// The face in each frame; empty if it is at rest.
    pub faces: Vec<FacePosture>,
}

impl Corpus {
    /// Reads a plan from its JSON, and checks it; `place` is the file that errors name.
    ///
    /// # Errors
    /// Fails with all faults of the plan, each with its place.
    pub fn read_plan(text: &str, place: &str) -> CorpusResult<StudyPlan> {
        study_check::read_study_plan(text, place)
    }

    /// Stores a plan as a study. A plan of that name is replaced if nobody has answered it.
    ///
    /// # Errors
    /// Fails with all faults of the plan; if a clip cannot be found or made; if somebody has answered the study.
    pub fn plan_study(&mut self, plan: &StudyPlan, progress: &mut ProgressReceiver<'_>) -> CorpusResult<PlannedStudy> {
        study_check::check_study_plan(plan)?;
        // Numbers must come back from the stored JSON exactly, so that the hash stays the same.
        let plan = &plan.clone().with_short_numbers();
        // A plan whose clips cannot be made is refused now, and not when the questionnaire is built.
        self.study_clips(plan, progress, |_, _| Ok(()))?;
        let replaced = self.store.run_store_operation(|connection| {
            let replaced = match stored::load_stored_study(connection, &plan.name)? {
                // Answers are only valid for the plan that people saw.
                Some(old) if db::participant_count(connection, old.id)? > 0 => {
                    let error = CorpusError::from_wrong_message(format!(
                        "people have answered the study {:?}, so that its plan cannot change",
                        plan.name
                    ));
                    return Err(error
                        .with_error_place(&plan.name)
                        .with_advice("give the new plan another name"));
                }
                Some(old) if old.plan == *plan => true,
                Some(old) => {
                    db::replace_study_plan(connection, old.id, &stored::study_plan_row(plan))?;
                    true
                }
                None => {
                    db::insert_study_row(connection, &stored::study_plan_row(plan))?;
                    false
                }
            };
            let study = plan.name.clone();
            Ok((replaced, OperationEffect::PlanStudy { study }))
        })?;
        Ok(PlannedStudy {
            plan: plan.clone(),
            plan_sha256: plan.plan_sha256(),
            replaced,
        })
    }

    /// Returns a study with its answers.
    ///
    /// # Errors
    /// Fails if there is no study of that name.
    pub fn study_with_answers(&self, name: &str) -> CorpusResult<StudyWithAnswers> {
        let connection = self.store.read_connection();
        let stored_study = find_stored_study(connection, name)?;
        let participants = stored::stored_participants(connection, &stored_study, None)?;
        Ok(StudyWithAnswers {
            plan: stored_study.plan,
            plan_sha256: stored_study.sha256,
            participants,
        })
    }

    /// Writes the plan of a study as JSON, which [`read_plan`](Self::read_plan) reads.
    ///
    /// # Errors
    /// Fails if there is no study of that name, or the file exists and `force` is not set.
    pub fn export_plan(&self, name: &str, to: &Path, force: bool) -> CorpusResult<()> {
        let plan = find_stored_study(self.store.read_connection(), name)?.plan;
        // Plans have text keys and finite numbers only.
        let json = serde_json::to_vec_pretty(&plan).unwrap_or_default();
        crate::atomic_write::write_atomically(to, force, |out| {
            out.write_all(&json)
                .map_err(|error| CorpusError::from_file_failure(to, error))
        })?;
        Ok(())
    }

    /// Deletes a study with all its answers.
    ///
    /// # Errors
    /// Fails if there is no study of that name.
    pub fn delete_study(&mut self, name: &str) -> CorpusResult<()> {
        self.store.run_store_operation(|connection| {
            let StoredStudy { id, plan, .. } = find_stored_study(connection, name)?;
            db::delete_study_row(connection, id)?;
            let study = plan.name;
            Ok(((), OperationEffect::DeleteStudy { study }))
        })
    }

    /// Deletes a participant of a study with all answers. The history keeps them, so that the deletion can be undone.
    ///
    /// # Errors
    /// Fails if there is no such study, or no participant with that code.
    pub fn forget_participant(&mut self, study: &str, code: &str) -> CorpusResult<()> {
        self.store.run_store_operation(|connection| {
            let StoredStudy { id, plan, .. } = find_stored_study(connection, study)?;
            let people = db::load_study_participants(connection, id, Some(code.trim()))?;
            let Some((row, _)) = people.first() else {
                return Err(no_participant(code));
            };
            db::delete_participant(connection, *row)?;
            let study = plan.name;
            Ok(((), OperationEffect::ForgetParticipant { study }))
        })
    }

    /// Makes the movement of every trial, each clip once, and calls `take` with the positions of its trials.
    pub(crate) fn study_clips(
        &mut self,
        plan: &StudyPlan,
        progress: &mut ProgressReceiver<'_>,
        mut take: impl FnMut(&[usize], StudyClip) -> CorpusResult<()>,
    ) -> CorpusResult<()> {
        let mut clips: Vec<(&str, Vec<usize>)> = Vec::new();
        let mut places: BTreeMap<&str, usize> = BTreeMap::new();
        for (at, trial) in plan.trials.iter().enumerate() {
            // A clip that several trials show is made only once.
            let place = *places.entry(&trial.clip).or_insert(clips.len());
            if place == clips.len() {
                clips.push((&trial.clip, Vec::new()));
            }
            clips[place].1.push(at);
        }
        let mut errors = Vec::new();
        let total = Some(clips.len() as u64);
        for (done, (text, trials)) in clips.into_iter().enumerate() {
            progress.report_amount(ProgressUnit::Items, "making clips", done as u64, total)?;
            match self.trial_clip(text) {
                Ok(clip) => take(&trials, clip)?,
                Err(CorpusError::Stopped) => return Err(CorpusError::Stopped),
                Err(error) => {
                    let trial = &plan.trials[trials[0]];
                    let place = format!("trial {} ({}, {})", trials[0] + 1, trial.item, trial.condition);
                    let remedy = error.error_remedy();
                    let mut place_error = CorpusError::from_wrong_message(error.to_string()).with_error_place(place);
                    if let Some(remedy) = remedy {
                        place_error = place_error.with_advice(remedy);
                    }
                    // All faults are reported at once, so that the user need not find them one by one.
                    errors.push(place_error);
                }
            }
        }
        match errors.len() {
            0 => Ok(()),
            1 => Err(errors.remove(0)),
            _ => Err(CorpusError::from_error_list(errors)),
        }
    }
}

/// Returns the study of that name.
fn find_stored_study(connection: &Connection, name: &str) -> CorpusResult<StoredStudy> {
    if let Some(found) = stored::load_stored_study(connection, name.trim())? {
        return Ok(found);
    }
    let names = db::list_study_names(connection)?;
    let suggestion = did_you_mean(nearest_candidate(name, names.iter().map(String::as_str)));
    let error =
        CorpusError::from_wrong_message(format!("there is no study {name:?}{suggestion}")).with_error_place(name);
    Err(error.with_command_advice("`chereme list CORPUS studies` lists them"))
}
