//! The studies of a corpus at a glance, and the clip of a trial.

use std::sync::Arc;

use serde::Serialize;

use super::study_plan::StudyPlan;
use super::{StudyClip, stored};
use crate::Corpus;
use crate::address::CorpusAddress;
use crate::db::stored_search::begin_reading;
use crate::db::stored_studies as db;
use crate::error::CorpusResult;

/// A study with the numbers of its people and answers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StudyOverview {
    /// The plan.
    pub plan: StudyPlan,
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
    pub fn study_overviews(&self) -> CorpusResult<Vec<StudyOverview>> {
        let reading = begin_reading(self.store.read_connection())?;
        let mut all = Vec::new();
        for name in db::list_study_names(&reading)? {
            let Some(it) = stored::load_stored_study(&reading, &name)? else {
                continue;
            };
            let [participants, finished, answers] = db::count_study_participants(&reading, it.id)?;
            all.push(StudyOverview {
                plan: it.plan,
                participants,
                finished,
                answers,
            });
        }
        Ok(all)
    }

    /// Returns the recording whose movement a clip is, if it is no recipe.
    pub(crate) fn study_clip_recording(&self, text: &str) -> Option<i64> {
        let address = text.parse::<CorpusAddress>().ok()?;
        let moving = self.movement_at_address(&address).ok()?;
        Some(moving.stretch.recording.id)
    }

    /// Returns the movement that a trial shows, from its address or recipe.
    ///
    /// # Errors
    /// Fails if nothing has that address, or the recipe cannot be carried out.
    pub fn trial_clip(&mut self, text: &str) -> CorpusResult<StudyClip> {
        if let Ok(address) = text.parse::<CorpusAddress>()
            && let Ok(moving) = self.movement_at_address(&address)
        {
            return Ok(StudyClip {
                clip: moving.clip,
                anatomy: Arc::new(moving.anatomy),
                faces: moving.faces,
            });
        }
        let made = self.preview_recipe(text)?;
        Ok(StudyClip {
            clip: made.clip,
            anatomy: made.anatomy,
            faces: made.faces,
        })
    }
}
