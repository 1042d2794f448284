//! Deletes recordings and signs, each with everything that belongs to it.

use std::collections::{BTreeMap, BTreeSet};

use chereme_motion::RecordingInstant;
use chereme_sign::ErrorRemedy;
use rusqlite::Connection;
use serde::Serialize;

use crate::Corpus;
use crate::address::{self, CorpusAddress, RowName};
use crate::annotate;
use crate::db::edits;
use crate::db::recipes;
use crate::db::signs::{self, TokenRow};
use crate::db::stored_check::run_and_roll_back;
use crate::db::stored_delete::{self as rows, RecordingBelongings};
use crate::db::stored_recordings;
use crate::db::stored_tiers;
use crate::error::{CorpusError, CorpusResult};
use crate::progress::ProgressReceiver;
use crate::words;
use crate::words::effect::OperationEffect;

/// What happens to things that depend on a deleted one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DependentsPolicy {
    /// Nothing is deleted if there are any.
    #[default]
    Refuse,
    /// They are deleted, too.
    Delete,
    /// Generated signs keep their movement; their recipes have lost a source and cannot be evaluated again.
    Keep,
}

/// How to delete.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct DeleteOptions {
    /// What happens to generated signs whose recipes take movement from something deleted, and to annotations of a
    /// deleted sign in recordings that stay.
    pub dependents: DependentsPolicy,
    /// Whether to report what would be deleted, and write nothing.
    pub dry_run: bool,
}

/// A deleted recording.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct DeletedRecording {
    /// Its row.
    pub recording: i64,
    /// Its name.
    pub name: String,
    /// The rows that went with it.
    #[serde(flatten)]
    pub belongings: RecordingBelongings,
}

/// Something that depends on a deleted recording or sign.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct DeletionDependent {
    /// Its address: a generated recording, or an annotation of the sign in a recording that stays.
    pub address: String,
    /// The name of the recording.
    pub recording: String,
    /// The time of the annotation; `None` for a generated recording.
    pub start_us: Option<i64>,
}

/// The result of a deletion.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct DeletionReport {
    /// Whether nothing was written.
    pub dry_run: bool,
    /// The recordings, in the order of their rows.
    pub recordings: Vec<DeletedRecording>,
    /// The signs: those that were named, and those without token, translation and remark afterwards.
    pub signs: Vec<String>,
    /// How many annotations were removed from recordings that stay.
    pub annotations: u64,
    /// Things that depend on deleted ones: deleted or kept, as asked for, or in the way.
    pub dependents: Vec<DeletionDependent>,
    /// The names of the recordings and of the named signs, as in the history.
    pub summary: String,
}

impl Corpus {
    /// Deletes recordings and signs as one operation.
    ///
    /// A recording goes with its tracks, tiers, annotations, tokens and recipe. The blocks of its movement stay in the
    /// file, because undo restores the recording with them; so do media files next to the corpus. A sign goes with its
    /// lexicon entries, translations and remarks, and with recordings that were generated for it alone. A sign that
    /// loses its last token goes as well, unless it has a translation or a remark.
    ///
    /// # Errors
    /// Fails if there is no such recording or sign, or if something depends on it and `options` does not say what
    /// happens to that.
    pub fn delete_objects(
        &mut self,
        what: &[CorpusAddress],
        options: DeleteOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<DeletionReport> {
        if options.dry_run {
            let connection = self.store.read_connection();
            let plan = DeletionPlan::plan_deletion(connection, what, options.dependents)?;
            let mut done = match plan.is_refused(options.dependents) {
                true => plan.foreseen(connection)?,
                // Only carrying it out shows which signs lose their last token.
                false => run_and_roll_back(connection, || plan.carry_out_deletion(connection, progress))?,
            };
            done.dry_run = true;
            return Ok(done);
        }
        self.store.operation_with_progress(progress, |connection, progress| {
            // Rows are deleted one after the other, so references break for a while.
            edits::defer_references(connection)?;
            let plan = DeletionPlan::plan_deletion(connection, what, options.dependents)?;
            if plan.is_refused(options.dependents) {
                return Err(plan.refusal(connection)?);
            }
            // Afterwards the names are gone.
            let names = plan.deleted_object_names(connection)?;
            let done = plan.carry_out_deletion(connection, progress)?;
            Ok((done, OperationEffect::Delete { names }))
        })
    }
}

/// The rows that a deletion removes, and those that depend on them.
#[derive(Default)]
struct DeletionPlan {
    recordings: BTreeSet<i64>,
    signs: BTreeSet<i64>,
    /// Entries of the signs in the lexicon.
    entries: Vec<i64>,
    /// Tokens of the signs in recordings that stay.
    annotated: Vec<TokenRow>,
    /// The names of generated recordings that take movement from something deleted, by row.
    made: BTreeMap<i64, String>,
}

impl DeletionPlan {
    fn plan_deletion(
        connection: &Connection,
        what: &[CorpusAddress],
        dependents: DependentsPolicy,
    ) -> CorpusResult<Self> {
        let mut plan = Self::default();
        for address in what {
            match address {
                CorpusAddress::Recording(name) => {
                    plan.recordings
                        .insert(address::find_recording_by_name(connection, name)?.id);
                }
                CorpusAddress::Sign(name) => {
                    plan.signs.insert(address::find_sign_by_name(connection, name)?);
                }
                CorpusAddress::Gloss(name) => {
                    plan.recordings.insert(bare_recording(connection, name)?);
                }
                other => return Err(not_here(other)),
            }
        }
        // All recordings must be known before tokens are sorted, as they may go anyway.
        for sign in plan.signs.clone() {
            plan.tokens_of(connection, sign)?;
        }
        plan.follow_generated_recordings(connection, dependents)?;
        Ok(plan)
    }

    /// Sorts the tokens of a sign: recordings that were generated for it alone go with it.
    fn tokens_of(&mut self, connection: &Connection, sign: i64) -> CorpusResult<()> {
        for token in signs::tokens_of_sign(connection, sign)? {
            let Some(recording) = token.recording_id else {
                self.entries.push(token.id);
                continue;
            };
            // These tokens go with their recording.
            if self.recordings.contains(&recording) {
                continue;
            }
            let generated = recipes::find_recording_recipe(connection, recording)?.is_some();
            let all = signs::tokens_of_recording(connection, recording)?;
            if generated && all.iter().all(|other| self.signs.contains(&other.sign_id)) {
                self.recordings.insert(recording);
            } else {
                self.annotated.push(token);
            }
        }
        Ok(())
    }

    /// Finds the generated recordings that take movement from something that goes; if they go too, also those that
    /// take movement from them.
    fn follow_generated_recordings(
        &mut self,
        connection: &Connection,
        dependents: DependentsPolicy,
    ) -> CorpusResult<()> {
        let mut next: Vec<i64> = self.recordings.iter().copied().collect();
        let mut users = Vec::new();
        for entry in &self.entries {
            users.extend(recipes::made_from(connection, *entry)?);
        }
        loop {
            for recording in std::mem::take(&mut next) {
                users.extend(recipes::made_from_recording(connection, recording)?);
            }
            if users.is_empty() {
                break;
            }
            for (recording, name) in std::mem::take(&mut users) {
                // A recording that is deleted anyway depends on nothing.
                if self.recordings.contains(&recording) {
                    continue;
                }
                self.made.insert(recording, name);
                // Only what is deleted itself takes away the source of others.
                if dependents == DependentsPolicy::Delete {
                    self.recordings.insert(recording);
                    next.push(recording);
                }
            }
        }
        let gone = &self.recordings;
        // More recordings may have been added since the tokens were sorted.
        self.annotated
            .retain(|token| token.recording_id.is_none_or(|recording| !gone.contains(&recording)));
        Ok(())
    }

    /// Returns whether something is in the way. Generated signs can be kept, but no annotation of a sign that goes.
    fn is_refused(&self, dependents: DependentsPolicy) -> bool {
        match dependents {
            DependentsPolicy::Refuse => !self.made.is_empty() || !self.annotated.is_empty(),
            DependentsPolicy::Keep => !self.annotated.is_empty(),
            DependentsPolicy::Delete => false,
        }
    }

    fn refusal(&self, connection: &Connection) -> CorpusResult<CorpusError> {
        let gone = self.deleted_object_names(connection)?.join(", ");
        if let Some(token) = self.annotated.first() {
            let place = token_place_text(token);
            let count = words::format_noun_count(self.annotated.len() as u64, "tokens");
            return Ok(CorpusError::from_wrong_message(format!(
                "{} has {count} in recordings that stay, the first in {place}",
                token.gloss
            ))
            .with_error_place(place)
            .with_command_advice(
                "delete its annotations as well with --with-dependents, or name the recordings, too",
            ));
        }
        let made: Vec<&str> = self.made.values().map(String::as_str).collect();
        Ok(CorpusError::from_wrong_message(format!(
            "generated signs take movement from {gone}: {}",
            made.join(", ")
        ))
        .with_error_place(gone)
        .with_command_advice(
            "delete them as well with --with-dependents, or keep them with --keep-dependents: they keep their own \
             movement, and their recipes cannot be evaluated again",
        ))
    }

    /// Returns the names of the recordings and the glosses of the signs that go.
    fn deleted_object_names(&self, connection: &Connection) -> CorpusResult<Vec<String>> {
        let mut names = BTreeSet::new();
        for recording in &self.recordings {
            names.insert(stored_recordings::load_recording_row(connection, *recording)?.name);
        }
        for sign in &self.signs {
            names.insert(signs::sign_label(connection, *sign)?);
        }
        Ok(names.into_iter().collect())
    }

    /// Returns what is to be deleted, without trying it.
    fn foreseen(&self, connection: &Connection) -> CorpusResult<DeletionReport> {
        let mut done = DeletionReport {
            summary: self.deleted_object_names(connection)?.join(", "),
            dependents: self.dependents(),
            ..DeletionReport::default()
        };
        for recording in &self.recordings {
            done.recordings.push(count_deleted_recording(connection, *recording)?);
        }
        for sign in &self.signs {
            done.signs.push(signs::sign_label(connection, *sign)?);
        }
        Ok(done)
    }

    fn dependents(&self) -> Vec<DeletionDependent> {
        let made = self.made.iter().map(|(recording, name)| DeletionDependent {
            address: format!("recording:{recording}"),
            recording: name.clone(),
            start_us: None,
        });
        let annotated = self.annotated.iter().map(|token| DeletionDependent {
            address: format!("annotation:{}", token.annotation_id.unwrap_or_default()),
            recording: token.recording.clone().unwrap_or_default(),
            start_us: token.start_us,
        });
        made.chain(annotated).collect()
    }

    fn carry_out_deletion(
        &self,
        connection: &Connection,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<DeletionReport> {
        // Counts and names can be read only as long as the rows are there.
        let mut done = self.foreseen(connection)?;
        let mut affected: BTreeMap<i64, String> = BTreeMap::new();
        for (count, recording) in self.recordings.iter().enumerate() {
            progress.report_items("deleting", count, self.recordings.len())?;
            for token in signs::tokens_of_recording(connection, *recording)? {
                affected.insert(token.sign_id, token.gloss);
            }
            rows::delete_recording(connection, *recording)?;
        }
        done.annotations = self.remove_annotations(connection, progress)?;
        for entry in &self.entries {
            signs::delete_token(connection, *entry)?;
        }
        for sign in &self.signs {
            // A sign that was named goes in any case, even with translations and remarks.
            affected.remove(sign);
            rows::delete_sign(connection, *sign)?;
        }
        for (sign, gloss) in affected {
            // The citation form may have been in a deleted recording.
            rows::cite_another(connection, sign)?;
            signs::delete_empty_sign(connection, sign)?;
            // A sign with a translation or a remark stays although it has no token.
            if address::find_sign_by_name(connection, &RowName::Number(sign)).is_err() {
                done.signs.push(gloss);
            }
        }
        done.signs.sort();
        Ok(done)
    }

    /// Removes the annotations of the signs from recordings that stay, with all below them.
    fn remove_annotations(&self, connection: &Connection, progress: &mut ProgressReceiver<'_>) -> CorpusResult<u64> {
        let annotation_ids: BTreeSet<i64> = self.annotated.iter().filter_map(|token| token.annotation_id).collect();
        let mut roots = Vec::new();
        for id in &annotation_ids {
            let mut above = stored_tiers::load_annotation_row(connection, *id)?.parent_id;
            while let Some(parent) = above.filter(|parent| !annotation_ids.contains(parent)) {
                above = stored_tiers::load_annotation_row(connection, parent)?.parent_id;
            }
            // An annotation below another one is removed together with it.
            if above.is_none() {
                roots.push(*id);
            }
        }
        annotate::remove_all(connection, &roots, progress)
    }
}

fn count_deleted_recording(connection: &Connection, recording: i64) -> CorpusResult<DeletedRecording> {
    Ok(DeletedRecording {
        recording,
        name: stored_recordings::load_recording_row(connection, recording)?.name,
        belongings: rows::count_recording_belongings(connection, recording)?,
    })
}

fn token_place_text(token: &TokenRow) -> String {
    let start = RecordingInstant::from_micros(token.start_us.unwrap_or_default());
    let recording = token.recording.as_deref().unwrap_or_default();
    format!("{recording:?} at {start}")
}

/// Returns the recording with a bare name. A sign must be named as one: it takes all its tokens with it.
fn bare_recording(connection: &Connection, name: &str) -> CorpusResult<i64> {
    let recording = stored_recordings::recording_named(connection, name)?;
    match (address::find_sign_by_gloss(connection, name), recording) {
        (Err(_), Some(recording)) => Ok(recording.id),
        (Ok(_), None) => Err(
            CorpusError::from_wrong_message(format!("{name:?} is a sign with all its tokens"))
                .with_error_place(name)
                .with_advice(format!("write sign:{name:?} to delete them all")),
        ),
        (Ok(_), Some(_)) => {
            let text = format!("{name:?} is both a sign and a recording");
            Err(CorpusError::from_wrong_message(text)
                .with_error_place(name)
                .with_advice(format!("write sign:{name:?} or recording:{name:?}")))
        }
        (Err(error), None) => Err(error),
    }
}

/// Returns the error for something that is removed in another way.
fn not_here(address: &CorpusAddress) -> CorpusError {
    let remedy = match address {
        CorpusAddress::Annotation(_) | CorpusAddress::Token(_) => {
            ErrorRemedy::command_remedy("a token goes with its annotation: `chereme annotate CORPUS remove ANNOTATION`")
        }
        CorpusAddress::Tier(_) => {
            ErrorRemedy::command_remedy("remove a tier with `chereme annotate CORPUS remove-tier TIER`")
        }
        _ => "write recording:3, recording:NAME or sign:GLOSS".into(),
    };
    CorpusError::from_wrong_message(format!("{address} is neither a recording nor a sign"))
        .with_error_place(address.to_string())
        .with_advice(remedy)
}

#[cfg(test)]
#[path = "delete/tests.rs"]
mod tests;
