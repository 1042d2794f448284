//! Studies of both sides: answers stay with the plan that was answered.

use serde_json::Value;

use super::MergeWork;
use crate::db::stored_merge::RowImage;
use crate::db::stored_studies;
use crate::error::CorpusResult;

impl MergeWork<'_> {
    /// Returns whether the other side's plan of a study cannot take the place of this side's: people answered this one
    /// here, or both sides changed it.
    pub(super) fn is_other_plan(&self, bases: &[RowImage], mine: &RowImage, theirs: &RowImage) -> CorpusResult<bool> {
        let (own, other) = (mine.get("plan_sha256"), theirs.get("plan_sha256"));
        let changed = |plan| bases.iter().all(|base| base.get("plan_sha256") != plan);
        if own == other || !changed(other) {
            return Ok(false);
        }
        let uid = mine.get("uid").and_then(Value::as_str).unwrap_or_default();
        let id = self.mine.find_row_id("study", uid)?.unwrap_or_default();
        Ok(changed(own) || stored_studies::participant_count(self.connection, id)? > 0)
    }

    /// Returns the study of this side with the other side's plan; it is added under a free name if this side has none.
    pub(super) fn study_with_other_plan(&mut self, theirs: &RowImage) -> CorpusResult<i64> {
        let text = |column: &str| theirs[column].as_str().unwrap_or_default().to_owned();
        let mut study = stored_studies::StudyRow {
            name: text("name"),
            plan: text("plan"),
            plan_sha256: text("plan_sha256"),
        };
        // An earlier participant, or an earlier merge, may have brought that plan here.
        if let Some(known) = stored_studies::with_plan(self.connection, &study.plan_sha256)? {
            return Ok(known);
        }
        study.name = stored_studies::free_study_name(self.connection, &study.name)?;
        self.report.notes.push(format!(
            "both have a study {:?} with another plan: that of {} is {:?} here",
            text("name"),
            self.from,
            study.name
        ));
        *self.report.added.entry("study".to_owned()).or_default() += 1;
        stored_studies::insert_study_row(self.connection, &study)
    }

    /// Moves a participant of the other side to the study whose plan was answered; returns whether that is another one.
    pub(super) fn answered_another(&mut self, uid: &str, local: &mut RowImage) -> CorpusResult<bool> {
        let row = self.theirs.find_row_image("study_participant", uid)?;
        let study_uid = row.and_then(|image| Some(image.get("study_id")?.as_str()?.to_owned()));
        let study = study_uid
            .map(|uid| self.theirs.find_row_image("study", &uid))
            .transpose()?;
        let Some(study) = study.flatten() else {
            return Ok(false);
        };
        let here = local["study_id"].as_i64().unwrap_or_default();
        if !self.differs("study", here, &study, "plan_sha256")? {
            return Ok(false);
        }
        let there = self.study_with_other_plan(&study)?;
        local.insert("study_id".into(), Value::from(there));
        Ok(true)
    }
}
