//! The studies of a corpus at a glance, and the clip of a trial.

use std::sync::Arc;

use serde::Serialize;

use super::plan::Plan;
use super::{StudyClip, stored};
use crate::Corpus;
use crate::address::Address;
use crate::db::search::begin_reading;
use crate::db::studies as db;
use crate::error::Result;

/// A study with the numbers of its people and answers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StudyOverview {
    /// The plan.
    pub plan: Plan,
    /// How many people answered.
    pub participants: u64,
    /// How many of them answered to the end.
    pub finished: u64,
    /// The number of answers.
    pub answers: u64,
}

impl Corpus {
    /// Returns all studies by name.
    ///
    /// # Errors
    /// Fails if the database fails or holds an invalid plan.
    pub fn studies(&self) -> Result<Vec<StudyOverview>> {
        let reading = begin_reading(self.store.read())?;
        let mut all = Vec::new();
        for name in db::names(&reading)? {
            let Some(it) = stored::study(&reading, &name)? else {
                continue;
            };
            let [participants, finished, answers] = db::counts(&reading, it.id)?;
            all.push(StudyOverview {
                plan: it.plan,
                participants,
                finished,
                answers,
            });
        }
        Ok(all)
    }

    /// Returns the movement that a trial shows, from its address or recipe.
    ///
    /// # Errors
    /// Fails if nothing has that address, or the recipe cannot be carried out.
    pub fn trial_clip(&mut self, text: &str) -> Result<StudyClip> {
        if let Ok(address) = text.parse::<Address>()
            && let Ok(moving) = self.movement(&address)
        {
            return Ok(StudyClip {
                clip: moving.clip,
                anatomy: Arc::new(moving.anatomy),
                faces: moving.faces,
            });
        }
        let made = self.preview(text)?;
        Ok(StudyClip {
            clip: made.clip,
            anatomy: made.anatomy,
            faces: made.faces,
        })
    }
}
