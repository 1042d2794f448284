//! Perceptual studies: questionnaires that show signs to people, their answers, and reports.
//!
//! A study begins with a [plan](plan::Plan): trials, questions, an order. It is built into a questionnaire, a folder that
//! works without a network; the answers that participants send back are imported, and stay with the plan in the corpus.
//!
//! | module | holds |
//! |---|---|
//! | [`plan`], [`answers`] | the plan, and the answers of a participant, as values |
//! | `request`, `trials`, `texts` | a plan from a few words or a table of trials, and its usual texts |
//! | `change` | a stored plan as the request that makes it again |
//! | `check` | the faults of a plan |
//! | `distances` | how far clips are from those of another condition |
//! | [`order`] | the order in which each participant sees the trials |
//! | `build` | the questionnaire |
//! | `import`, `files`, `fits` | answers from files, checked against the plan |
//! | `long`, `wide`, `rows` | answers as a table: one answer a row, or one participant a row |
//! | `listing` | the answers one by one, with those that are missing |
//! | `overview` | all studies at a glance, and the clip of a trial |
//! | `stored` | plans and participants as rows of the database |
//! | [`report`] | people, answers, comparisons and conclusions |

pub mod answers;
mod build;
mod change;
mod check;
mod distances;
mod files;
mod fits;
mod import;
mod listing;
mod long;
pub mod order;
mod overview;
pub mod plan;
pub mod report;
mod request;
mod rows;
mod stored;
mod texts;
mod trials;
mod wide;

use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::Path;
use std::sync::Arc;

use chereme_motion::anatomy::Anatomy;
use chereme_motion::{Clip, Face};
use chereme_sign::Remedy;
use chereme_sign::text::{did_you_mean, nearest};
use rusqlite::Connection;
use serde::Serialize;

use crate::Corpus;
use crate::db::studies as db;
use crate::error::{Error, Result};
use crate::progress::{Progress, Step, Unit};
use crate::words::effect::OperationEffect;
use answers::Participant;
use plan::Plan;
use stored::Stored;

pub use build::{Questionnaire, QuestionnaireOptions};
pub use distances::DISTANCE;
pub use import::{AnswersFile, AnswersOptions, AnswersReport, NamedText};
pub use listing::{AnswerFilter, AnswerList, AnswerRow, AnswerState, ParticipantSummary};
pub use overview::StudyOverview;
pub use request::{StudyRequest, words};
pub use wide::ColumnUse;

/// Returns the error for a code that no participant has.
fn no_participant(code: &str) -> Error {
    let error = Error::wrong(format!("no participant has the code {code:?}")).at(code);
    error.advise(Remedy::command(
        "`chereme study answers CORPUS NAME` lists the codes",
    ))
}

/// A study with everything that was answered.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Study {
    /// The plan.
    pub plan: Plan,
    /// The SHA-256 of the plan, by which answers name it.
    pub plan_sha256: String,
    /// The participants with their answers, by code.
    pub participants: Vec<Participant>,
}

/// A study that was planned.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlannedStudy {
    /// The plan.
    pub plan: Plan,
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
    pub anatomy: Arc<Anatomy>,
    /// The face in each frame; empty if it is at rest.
    pub faces: Vec<Face>,
}

impl Corpus {
    /// Reads a plan from its JSON, and checks it; `place` is the file that errors name.
    ///
    /// # Errors
    /// Fails with all faults of the plan, each with its place.
    pub fn read_plan(text: &str, place: &str) -> Result<Plan> {
        check::read(text, place)
    }

    /// Stores a plan as a study. A plan of that name is replaced if nobody has answered it.
    ///
    /// # Errors
    /// Fails with all faults of the plan; if a clip cannot be found or made; if somebody has answered the study.
    pub fn plan_study(&mut self, plan: &Plan, progress: &mut Progress<'_>) -> Result<PlannedStudy> {
        check::check(plan)?;
        let plan = &plan.clone().with_short_numbers();
        self.study_clips(plan, progress, |_, _| Ok(()))?;
        let replaced = self.store.operation(|connection| {
            let replaced = match stored::study(connection, &plan.name)? {
                Some(old) if db::participant_count(connection, old.id)? > 0 => {
                    let error = Error::wrong(format!(
                        "people have answered the study {:?}, so that its plan cannot change",
                        plan.name
                    ));
                    return Err(error
                        .at(&plan.name)
                        .advise("give the new plan another name"));
                }
                Some(old) if old.plan == *plan => true,
                Some(old) => {
                    db::replace(connection, old.id, &stored::row(plan))?;
                    true
                }
                None => {
                    db::insert(connection, &stored::row(plan))?;
                    false
                }
            };
            let study = plan.name.clone();
            Ok((replaced, OperationEffect::PlanStudy { study }))
        })?;
        Ok(PlannedStudy {
            plan: plan.clone(),
            plan_sha256: plan.sha256(),
            replaced,
        })
    }

    /// Returns a study with its answers.
    ///
    /// # Errors
    /// Fails if there is no study of that name.
    pub fn study(&self, name: &str) -> Result<Study> {
        let connection = self.store.read();
        let found = found(connection, name)?;
        let participants = stored::participants(connection, &found, None)?;
        Ok(Study {
            plan: found.plan,
            plan_sha256: found.sha256,
            participants,
        })
    }

    /// Writes the plan of a study as JSON, which [`read_plan`](Self::read_plan) reads.
    ///
    /// # Errors
    /// Fails if there is no study of that name, or the file exists and `force` is not set.
    pub fn export_plan(&self, name: &str, to: &Path, force: bool) -> Result<()> {
        let plan = found(self.store.read(), name)?.plan;
        // Plans have text keys and finite numbers only.
        let json = serde_json::to_vec_pretty(&plan).unwrap_or_default();
        crate::picture::write(to, force, |out| {
            out.write_all(&json).map_err(|error| Error::file(to, error))
        })?;
        Ok(())
    }

    /// Deletes a study with all its answers.
    ///
    /// # Errors
    /// Fails if there is no study of that name.
    pub fn delete_study(&mut self, name: &str) -> Result<()> {
        self.store.operation(|connection| {
            let Stored { id, plan, .. } = found(connection, name)?;
            db::delete(connection, id)?;
            let study = plan.name;
            Ok(((), OperationEffect::DeleteStudy { study }))
        })
    }

    /// Deletes a participant of a study with all answers. The history keeps them, so that the deletion can be undone.
    ///
    /// # Errors
    /// Fails if there is no such study, or no participant with that code.
    pub fn forget_participant(&mut self, study: &str, code: &str) -> Result<()> {
        self.store.operation(|connection| {
            let Stored { id, plan, .. } = found(connection, study)?;
            let people = db::participants(connection, id, Some(code.trim()))?;
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
        plan: &Plan,
        progress: &mut Progress<'_>,
        mut take: impl FnMut(&[usize], StudyClip) -> Result<()>,
    ) -> Result<()> {
        let mut clips: Vec<(&str, Vec<usize>)> = Vec::new();
        let mut places: BTreeMap<&str, usize> = BTreeMap::new();
        for (at, trial) in plan.trials.iter().enumerate() {
            let place = *places.entry(&trial.clip).or_insert(clips.len());
            if place == clips.len() {
                clips.push((&trial.clip, Vec::new()));
            }
            clips[place].1.push(at);
        }
        let mut errors = Vec::new();
        let total = Some(clips.len() as u64);
        for (done, (text, trials)) in clips.into_iter().enumerate() {
            progress.report(Step {
                task: "making clips",
                done: done as u64,
                total,
                unit: Unit::Items,
            })?;
            match self.trial_clip(text) {
                Ok(clip) => take(&trials, clip)?,
                Err(Error::Stopped) => return Err(Error::Stopped),
                Err(error) => {
                    let trial = &plan.trials[trials[0]];
                    let place = format!(
                        "trial {} ({}, {})",
                        trials[0] + 1,
                        trial.item,
                        trial.condition
                    );
                    let remedy = error.remedy();
                    let mut own = Error::wrong(error.to_string()).at(place);
                    if let Some(remedy) = remedy {
                        own = own.advise(remedy);
                    }
                    errors.push(own);
                }
            }
        }
        match errors.len() {
            0 => Ok(()),
            1 => Err(errors.remove(0)),
            _ => Err(Error::Several { errors }),
        }
    }
}

/// Returns the study of that name.
fn found(connection: &Connection, name: &str) -> Result<Stored> {
    if let Some(found) = stored::study(connection, name.trim())? {
        return Ok(found);
    }
    let names = db::names(connection)?;
    let meant = did_you_mean(nearest(name, names.iter().map(String::as_str)));
    let error = Error::wrong(format!("there is no study {name:?}{meant}")).at(name);
    Err(error.advise(Remedy::command("`chereme list CORPUS studies` lists them")))
}
