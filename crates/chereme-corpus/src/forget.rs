//! Forgetting a person: the one operation that cannot be undone. It removes the person's recordings, what was made from
//! them, the history and older versions of the file, rewrites the file, and proves that nothing of them is in it.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use chereme_sign::ErrorRemedy;
use chereme_sign::text::fold_text;
use rusqlite::Connection;
use serde::Serialize;

use crate::Corpus;
use crate::address::{self, RowName};
use crate::consent::{self, PublishPermissions};
use crate::db::stored_erase::{self, ErasedTraces};
use crate::db::{consents, edits, stored_recordings};
use crate::error::{CorpusError, CorpusResult};
use crate::merge;
use crate::progress::ProgressReceiver;

/// The most names that a refusal lists.
const MAX_REFUSED_NAMES: usize = 12;

/// A person who was forgotten, and the proof.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ForgottenSigner {
    /// The name.
    pub signer: String,
    /// Whether nothing was written.
    pub dry_run: bool,
    /// The recordings that went, or would go.
    pub recordings: Vec<String>,
    /// Older versions of the file that were removed, or would be.
    pub older_files: Vec<PathBuf>,
    /// The saved searches that named the person and went, or would go.
    pub searches: Vec<String>,
    /// How many hashes, identities, names and texts were searched for in the bytes of the file. None of them was found,
    /// except for those in `still_said`.
    pub searched: usize,
    /// Names and texts that other rows say, too, with the table of the row; they are not of this person.
    pub still_said: Vec<StillSaidText>,
}

/// A text of a forgotten person that a row of somebody else has, too.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct StillSaidText {
    /// The text.
    pub text: String,
    /// The table.
    pub table: String,
}

impl Corpus {
    /// Forgets a signer for good: recordings with tracks, tiers, annotations and recipes, blocks of movement, the whole
    /// history, the search index, and older versions beside the file. Then the file is written again, and its bytes are
    /// searched for everything that was removed. With `dry_run` nothing is written.
    ///
    /// # Errors
    /// Fails if there is no such signer, or if something else needs the recordings: signs of others that were made from
    /// them, recordings of others with the same movement, recordings that show others, too, recordings of others that the person annotated, studies, and decisions that are open after a merge. Fails if another
    /// program uses the file, or if something was found in the bytes afterwards.
    pub fn forget_signer(
        &mut self,
        signer: &RowName,
        dry_run: bool,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<ForgottenSigner> {
        let connection = self.store.read_connection();
        let row = address::find_signer_by_name(connection, signer)?;
        let recordings: BTreeSet<i64> = stored_recordings::load_recording_rows(connection)?
            .into_iter()
            .filter(|recording| recording.signer_id == Some(row.id))
            .map(|recording| recording.id)
            .collect();
        let names = recording_names(connection, &recordings)?;
        // Everything is checked before anything is written, since this cannot be undone.
        refuse_what_is_needed(connection, &row.name, &recordings, progress)?;
        self.refuse_studies_of(&recordings)?;
        let older_files = stored_erase::older_versions(self.corpus_file_path());
        let mut forgotten = ForgottenSigner {
            signer: row.name.clone(),
            dry_run,
            recordings: names,
            older_files,
            searches: stored_erase::searches_that_name(self.store.read_connection(), row.id)?
                .into_iter()
                .collect(),
            searched: 0,
            still_said: Vec::new(),
        };
        if dry_run {
            return Ok(forgotten);
        }
        // Removed things can no longer be listed afterwards.
        let traces = ErasedTraces::collect_traces(self.store.read_connection(), row.id, &recordings)?;
        self.store.erase_signer(row.id, &recordings, progress)?;
        // If erasing fails, the older versions are still needed.
        for path in &forgotten.older_files {
            fs::remove_file(path).map_err(|error| CorpusError::from_file_failure(path, error))?;
        }
        let proof = traces.search_traces(self.store.read_connection(), self.corpus_file_path())?;
        if let Some(left) = proof.left.first() {
            return Err(CorpusError::from_wrong_message(format!(
                "{} was removed, but the bytes of the file still hold {} of {} traces: {left}",
                row.name,
                proof.left.len(),
                proof.searched
            ))
            .with_advice("close every program that has the corpus open, and forget the signer again"));
        }
        forgotten.searched = proof.searched;
        forgotten.still_said = proof
            .said
            .into_iter()
            .map(|(text, table)| StillSaidText { text, table })
            .collect();
        Ok(forgotten)
    }

    /// Fails if a study shows one of the recordings.
    fn refuse_studies_of(&mut self, recordings: &BTreeSet<i64>) -> CorpusResult<()> {
        let mut names = Vec::new();
        for study in crate::db::stored_studies::list_study_names(self.store.read_connection())? {
            let plan = self.study_with_answers(&study)?.plan;
            let clips: BTreeSet<&str> = plan.trials.iter().map(|trial| trial.clip.as_str()).collect();
            for clip in clips {
                let shown = match self.study_clip_recording(clip) {
                    Some(recording) => BTreeSet::from([recording]),
                    None => self.recipe_sources(clip)?,
                };
                if !shown.is_disjoint(recordings) {
                    names.push(study.clone());
                    // One clip is enough to name the study.
                    break;
                }
            }
        }
        refuse(
            &names,
            "studies show the recordings",
            ErrorRemedy::command_remedy("delete the studies first: `chereme study delete CORPUS NAME`"),
        )
    }
}

/// Fails if something that stays needs the recordings, or the name.
fn refuse_what_is_needed(
    connection: &Connection,
    signer: &str,
    recordings: &BTreeSet<i64>,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<()> {
    let permissions = PublishPermissions::read_publish_permissions(connection, None)?;
    let mut made = BTreeSet::new();
    for recording in permissions.all_recordings() {
        if !recordings.contains(&recording) && !permissions.source_recordings(recording).is_disjoint(recordings) {
            made.insert(recording);
        }
    }
    // Once the signs are deleted, nobody would know the recordings that show them.
    let copies = permissions.find_recordings_of_signs(connection, &made, progress)?;
    made.extend(copies.iter().map(|copy| copy.piece));
    refuse(
        &recording_names(connection, &made)?,
        "signs of others were made from the recordings",
        ErrorRemedy::command_remedy("delete them first: `chereme delete CORPUS recording:NAME`"),
    )?;
    refuse(
        &find_same_movement_of_others(connection, recordings, progress)?,
        "recordings of others show the same movement",
        ErrorRemedy::command_remedy(
            "give them this signer, or delete them first: `chereme delete CORPUS recording:NAME`",
        ),
    )?;
    let mut with_others = BTreeSet::new();
    for (recording, participant) in consents::list_tier_participants(connection)? {
        let is_signer = fold_text(&participant) == fold_text(signer.trim());
        // Either the person appears in a recording of others, or others appear in theirs.
        if is_signer != recordings.contains(&recording) {
            with_others.insert(recording);
        }
    }
    refuse(
        &recording_names(connection, &with_others)?,
        "recordings show this person and others",
        "delete these recordings, or the tiers of one of them, first".into(),
    )?;
    let annotated = edits::recordings_of_annotator(connection, signer)?.into_iter();
    let annotated_of_others = annotated.filter(|recording| !recordings.contains(recording)).collect();
    refuse(
        &recording_names(connection, &annotated_of_others)?,
        "the person annotated recordings of others",
        ErrorRemedy::command_remedy(
            "give the annotator another name first: `chereme people CORPUS set NAME --name ANNOTATOR`",
        ),
    )?;
    let undecided = merge::undecided_conflicts(connection)?;
    let open: Vec<String> = undecided.iter().map(|conflict| conflict.number.to_string()).collect();
    refuse(
        &open,
        "a merge left decisions open, which may hold texts of the person",
        ErrorRemedy::command_remedy("decide them first: `chereme conflicts CORPUS` lists them"),
    )
}

/// Returns the other recordings that hold the movement of these, whole or in part, or came from the same captured files, each
/// with its signer: while they stay, the movement is not gone.
fn find_same_movement_of_others(
    connection: &Connection,
    recordings: &BTreeSet<i64>,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<Vec<String>> {
    let rows = stored_recordings::load_recording_rows(connection)?;
    let others = rows
        .iter()
        .map(|row| row.id)
        .filter(|id| !recordings.contains(id))
        .collect();
    let mut found = consent::find_movement_pieces(connection, recordings, &others, progress)?;
    found.extend(consent::find_movement_pieces(
        connection, &others, recordings, progress,
    )?);
    let mut holders: BTreeSet<i64> = found.iter().flat_map(|found| [found.piece, found.take]).collect();
    for &recording in recordings {
        let files = stored_recordings::source_files(connection, recording)?;
        for file in files.iter().filter(|file| file.is_capture()) {
            let copies = stored_recordings::source_files_of_hash(connection, &file.hash)?;
            holders.extend(copies.iter().filter_map(|copy| copy.recording_id));
        }
    }
    holders.retain(|id| others.contains(id));
    let held = rows.iter().filter(|row| holders.contains(&row.id));
    let shown = held.map(|row| format!("{} ({})", row.name, row.signer.as_deref().unwrap_or("-")));
    Ok(shown.collect())
}

fn recording_names(connection: &Connection, recordings: &BTreeSet<i64>) -> CorpusResult<Vec<String>> {
    let rows = recordings
        .iter()
        .map(|id| Ok(stored_recordings::load_recording_row(connection, *id)?.name));
    rows.collect()
}

/// Fails if there are any names.
fn refuse(names: &[String], message: &str, advice: ErrorRemedy) -> CorpusResult<()> {
    if names.is_empty() {
        return Ok(());
    }
    let more = if names.len() > MAX_REFUSED_NAMES { ", …" } else { "" };
    let list = names
        .iter()
        .take(MAX_REFUSED_NAMES)
        .map(String::as_str)
        .collect::<Vec<_>>();
    Err(CorpusError::from_wrong_message(format!("{message}: {}{more}", list.join(", "))).with_advice(advice))
}

#[cfg(test)]
mod tests;
