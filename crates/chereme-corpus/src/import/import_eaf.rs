//! Imports tiers, annotations and vocabularies from ELAN's annotation files into a recording.

mod annotators;
mod eaf_target;
mod eaf_vocabulary;
mod remap;
mod renames;
mod settle;
mod update;

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::eaf::eaf_convert::{
    AnnotationAddress, AnnotationTiming, AnnotationTranscript, TranscriptAnnotation, TranscriptTier,
};
use chereme_formats::roles::{self, TierGuess, TierMapping};
use chereme_motion::RecordingInstant;
use chereme_sign::{ErrorRemedy, RemedyChoice, SignComponent, TierRole};
use serde_json::json;

use super::import_again::set_hand;
use super::import_joining::JoinReason;
use super::import_lexicons::unlinked_glosses_finding;
use super::import_report::EditOutcome;
use super::readers::ParseFunction;
use super::understood::TiersRead;
use super::{FileReport, FileStatus, ImportJob, OwnEdit, OwnEdits};
use crate::db::edits;
use crate::db::people;
use crate::db::stored_columns::{AnnotationOrigin, RecordOrigin, ValueState};
use crate::db::stored_recordings::{self, MediaTrackRow, RecordingRow};
use crate::db::stored_tiers::{self, AnnotationRow, TierRow};
use crate::error::{CorpusError, CorpusResult};
use crate::media::is_same_film;
use crate::progress::ProgressReceiver;
use crate::report_finding::ReportFinding;
use crate::tokens;
pub(super) use eaf_vocabulary::tier_inventory;
use remap::{remap_tier_roles, set_role};
use renames::TierRename;

/// The properties in which a file describes its recording.
pub(crate) const ORIGIN_PROPERTY: &str = "chereme.origin";
pub(crate) const LICENCE_PROPERTY: &str = "chereme.licence";
pub(crate) const SIGNER_PROPERTY: &str = "chereme.signer";
pub(crate) const HANDEDNESS_PROPERTY: &str = "chereme.handedness";
/// The property in which a file states the roles of its tiers: the `tiers` of a [`TierMapping`], as JSON.
pub(crate) const TIER_ROLES_PROPERTY: &str = "chereme.tiers";

/// How far annotations may extend beyond the end of the movement without a warning, in microseconds.
pub(super) const MAX_OVERHANG_US: i64 = 1_000_000;

/// Adds tiers to a recording that has none of their names; returns whether it added them.
pub(super) fn add_transcript_tiers(
    job: &mut ImportJob<'_>,
    recording: i64,
    transcript: &AnnotationTranscript,
    report: &mut FileReport,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<bool> {
    let there = standing_tiers(job, recording, transcript, None, &[], report)?;
    if !there.is_empty() {
        return Ok(false);
    }
    let guesses = guess_tier_roles(job, transcript, report)?;
    let tiers = write_tiers(job, recording, &there, transcript, &guesses, report)?;
    write_annotations(job, transcript, &guesses, &tiers, progress)?;
    stored_recordings::lengthen_recording(job.connection, recording, transcript.transcript_end().instant_micros())?;
    Ok(true)
}

/// Imports tiers of any format; `read` converts the file's bytes to a transcript.
pub(super) fn import_as(
    job: &mut ImportJob<'_>,
    progress: &mut ProgressReceiver<'_>,
    read: ParseFunction<AnnotationTranscript>,
) -> CorpusResult<FileReport> {
    if let Some(report) = report_untouched_file(job)? {
        return Ok(report);
    }
    let bytes = job.read_job_bytes()?;
    job.report_progress(progress)?;
    let (mut transcript, findings) = read(&bytes).map_err(CorpusError::from_wrong_message)?;
    super::elan::fill_external_vocabularies(job, &mut transcript)?;
    job.report_progress(progress)?;
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    report.findings.extend(findings.into_iter().map(ReportFinding::from));
    let guesses = guess_tier_roles(job, &transcript, &mut report)?;
    report.understood.tiers = Some(TiersRead::Guessed(guesses.clone()).into());
    let target = eaf_target::find_import_target(job, read, &transcript, &mut report)?;
    let same = target.base.as_ref().is_some_and(|base| base.hash == job.hash);
    job.again = target.recording.filter(|_| same);
    let recording = match job.again {
        Some(again) => again,
        None => {
            let recording = find_or_add_recording(job, &transcript, target.recording, &mut report)?;
            know_participants(job, &transcript)?;
            recording
        }
    };
    report.recording = Some(stored_recordings::load_recording_row(job.connection, recording)?.name);
    let mut base = target.read_earlier_transcript(job, read)?;
    let is_version_of_file = target
        .base
        .as_ref()
        .is_some_and(|base| base.path.as_ref() == Some(&job.place));
    let own_base = base.as_mut().filter(|_| is_version_of_file);
    let apart = annotators::keep_annotators_apart(job, recording, &mut transcript, own_base, &guesses)?;
    if !apart.is_empty() {
        // The file of another annotator takes nothing away.
        base = None;
        report.findings.extend(apart);
    }
    let renames = match &mut base {
        Some(base) => renames::take_names(job, recording, base, &transcript)?,
        None => Vec::new(),
    };
    let there = standing_tiers(job, recording, &transcript, base.as_ref(), &renames, &mut report)?;
    let edited = EditedTranscript {
        transcript: &transcript,
        base: base.as_ref(),
        renames: &renames,
        guesses: &guesses,
    };
    // Of the same file, only the mapping can bring something new.
    if same && job.options.own_edits != OwnEdits::Theirs {
        return match remap_tier_roles(job, &there, &transcript, &guesses, &mut report)? {
            0 => Ok(target.unchanged_report(job, report)),
            _ => finish_remapped_file(job, recording, &target, report, progress),
        };
    }
    warn_of_length(job, recording, &transcript, &mut report)?;
    let counted = job.counts.total_row_changes();
    if !write_transcript(job, recording, there, &edited, &mut report, progress)? {
        return Ok(report);
    }
    // Taking the same file again may restore removed annotations, which is a change although the bytes are
    // the same.
    if same && job.counts.total_row_changes() == counted {
        return Ok(target.unchanged_report(job, report));
    }
    if same {
        report.status = FileStatus::Updated;
    } else {
        job.keep_source_file(Some(recording), Some(&bytes))?;
    }
    if !guesses.iter().any(|guess| guess.role == Some(TierRole::Gloss)) {
        report.findings.push(ReportFinding::finding_warning(
            "no tier was recognised as one of glosses, so no tokens were made",
            ErrorRemedy::choice_remedy(
                RemedyChoice::TierRoles,
                "give tiers their roles in a mapping file (--map), or with `chereme annotate`",
            ),
        ));
    }
    Ok(report)
}

/// Returns the report on a file that was imported before, if no option could change what the same bytes become.
fn report_untouched_file(job: &mut ImportJob<'_>) -> CorpusResult<Option<FileReport>> {
    let maps = job.options.mapping.mapping_entry_names().next().is_some();
    let takes = job.options.own_edits == OwnEdits::Theirs;
    let here = job.places.find_file_at(&job.place, job.kind).cloned();
    let Some(here) = here.filter(|row| row.hash == job.hash && !maps && !takes) else {
        return Ok(None);
    };
    let report = eaf_target::report_unchanged_target(job, &here)?;
    if report.is_some() {
        job.again = here.recording_id;
    }
    Ok(report)
}

/// Reports that the tiers of a file that was imported before have the roles of a new mapping, and derives their tokens.
fn finish_remapped_file(
    job: &mut ImportJob<'_>,
    recording: i64,
    target: &eaf_target::EafImportTarget,
    mut report: FileReport,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<FileReport> {
    report.status = FileStatus::Updated;
    let from = target
        .base
        .as_ref()
        .map(|base| base.path.as_ref().unwrap_or(&base.name));
    report.findings.insert(
        0,
        ReportFinding::finding_note(format!(
            "it is the recording {:?} already (from {}); its tiers now have the roles of the mapping",
            report.recording.as_deref().unwrap_or_default(),
            from.map(String::as_str).unwrap_or_default()
        )),
    );
    // The roles decide which annotations are glosses, so the tokens depend on the mapping.
    tokens::derive_with_progress(job.connection, recording, None, &job.inventories, progress)?;
    Ok(report)
}

/// Writes the tiers of a file, or updates those that it edits, and derives the tokens; returns whether the file was not
/// refused.
fn write_transcript(
    job: &mut ImportJob<'_>,
    recording: i64,
    there: BTreeMap<String, TierRow>,
    edited: &EditedTranscript<'_>,
    report: &mut FileReport,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<bool> {
    let transcript = edited.transcript;
    // The report counts only tokens that this file adds to those that were there.
    let before = crate::db::signs::tokens_of_recording(job.connection, recording)?.len();
    if there.is_empty() {
        let tiers = write_tiers(job, recording, &there, transcript, edited.guesses, report)?;
        write_annotations(job, transcript, edited.guesses, &tiers, progress)?;
    } else {
        update_from_transcript(job, recording, there, edited, report, progress)?;
        // A refused file leaves neither a length nor tokens behind.
        if report.status == FileStatus::Refused {
            return Ok(false);
        }
    }
    stored_recordings::lengthen_recording(job.connection, recording, transcript.transcript_end().instant_micros())?;
    tokens::derive_with_progress(job.connection, recording, None, &job.inventories, progress)?;
    let derived = crate::db::signs::tokens_of_recording(job.connection, recording)?.len();
    if derived > 0 {
        let unlinked = unlinked_glosses_finding(job, recording)?;
        report.findings.extend(unlinked);
    }
    job.count_created_rows("tokens", derived.saturating_sub(before));
    Ok(true)
}

/// An edited file from which a recording is updated.
struct EditedTranscript<'a> {
    /// The tiers of the file.
    transcript: &'a AnnotationTranscript,
    /// The tiers of the version that was read before, if it is known.
    base: Option<&'a AnnotationTranscript>,
    /// The tiers that only the file renamed.
    renames: &'a [TierRename],
    /// The roles of the file's tiers.
    guesses: &'a [TierGuess],
}

/// Updates a recording from an edited file. Fails if edits of the corpus would be lost, unless the options decide about
/// them.
fn update_from_transcript(
    job: &mut ImportJob<'_>,
    recording: i64,
    mut there: BTreeMap<String, TierRow>,
    edited: &EditedTranscript<'_>,
    report: &mut FileReport,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<()> {
    let EditedTranscript {
        transcript,
        base,
        renames,
        guesses,
    } = *edited;
    let own_edits = job.options.own_edits;
    let merge = own_edits == OwnEdits::Merge;
    let before = settle::RecordingBeforeUpdate::read_before_update(job.connection, recording)?;
    // They lie outside of the database, so the savepoint does not restore them.
    let (counts, inventories) = (job.counts.clone(), job.inventories.clone());
    // A token refers to its annotation until tokens are derived again.
    edits::defer_references(job.connection)?;
    // Which edits would be lost is known only after the update, which must then be taken back.
    job.connection.execute_batch("SAVEPOINT edits")?;
    let mut notes = renames::write_tier_renames(job.connection, renames, &mut there)?;
    let tier_rows = write_tiers(job, recording, &there, transcript, guesses, report)?;
    // Without a merge the file decides, so its parents hold whatever the earlier version says.
    renames::write_parents(
        job.connection,
        transcript,
        base.filter(|_| merge),
        &mut there,
        &tier_rows,
    )?;
    let there = &there;
    let sides = update::UpdateSides {
        transcript,
        guesses,
        base,
        known: there,
        tier_rows: &tier_rows,
        merge,
    };
    let updated = update::update_annotations(job, &sides, progress)?;
    notes.extend(before.settle_moved_annotations(job.connection, &updated.written)?);
    report.status = FileStatus::Updated;
    let is_lost = |edit: &OwnEdit| edit.outcome == EditOutcome::Lost;
    // With either of these options the user has decided about lost edits before.
    if !updated.edits.iter().any(is_lost) || matches!(own_edits, OwnEdits::Theirs | OwnEdits::Merge) {
        job.connection.execute_batch("RELEASE edits")?;
        let ours = updated.written.clone();
        report
            .findings
            .extend(notes.into_iter().map(ReportFinding::finding_note));
        remap_tier_roles(job, there, transcript, guesses, report)?;
        job.count_created_rows("annotations", updated.changes.added);
        job.counts.count_changed_rows("annotations", updated.changes.changed);
        job.counts.count_removed_rows("annotations", updated.changes.removed);
        if merge {
            for (mine, theirs) in &updated.conflicts {
                let from = job.file_name.as_str();
                crate::merge::keep_annotation(job.connection, from, *mine, theirs.as_ref())?;
            }
        }
        updated.report_update_changes(&sides, report);
        return before.check_broken_tier_rules(job.connection, &ours, merge);
    }
    // Rolling back alone would leave the savepoint open.
    job.connection.execute_batch("ROLLBACK TO edits; RELEASE edits")?;
    (job.counts, job.inventories) = (counts, inventories);
    report.refuse_own_edits(own_edits, updated.edits);
    Ok(())
}

/// Guesses the roles of tiers from the caller's mapping, then the file, then the names. A tier whose name says nothing
/// gets the role that tiers of that name have elsewhere in the corpus.
fn guess_tier_roles(
    job: &mut ImportJob<'_>,
    transcript: &AnnotationTranscript,
    report: &mut FileReport,
) -> CorpusResult<Vec<TierGuess>> {
    let property = transcript.properties.iter().find(|(key, _)| key == TIER_ROLES_PROPERTY);
    let file_mapping = property.map(|(_, text)| TierMapping::from_json(&format!("{{\"tiers\": {text}}}")));
    let mapping = match file_mapping {
        // The caller knows better than the file, whose statement fills in only what the caller leaves out.
        Some(Ok(own)) => job.options.mapping.completed_by(&own),
        Some(Err(error)) => {
            report.findings.push(ReportFinding::finding_warning(
                format!("its property {TIER_ROLES_PROPERTY:?} is not understood: {error}"),
                "the roles of tiers are inferred from their names",
            ));
            job.options.mapping.clone()
        }
        None => job.options.mapping.clone(),
    };
    for tier in &transcript.tiers {
        if let Some((entry, _)) = job.options.mapping.tier_mapping_entry(&tier.name) {
            job.used.insert(entry.to_owned());
        }
    }
    let mut guesses = roles::guess_tiers(transcript, &mapping);
    for (tier, guess) in transcript.tiers.iter().zip(&mut guesses) {
        // A person was asked about a doubted role when the first tier of the name came.
        if guess.role.is_some() && !guess.is_doubted_guess() {
            continue;
        }
        let named_roles = stored_tiers::roles_named(job.connection, &guess.tier)?;
        // Tiers of one name with different roles say nothing about another tier of that name.
        if let [one] = named_roles.as_slice() {
            guess.role = Some(one.role.clone());
            guess.hand = one.hand;
            guess.confidence = 0.6;
            guess.why = "tiers of this name in the corpus are".to_owned();
        } else if guess.role.is_none() && guess.hand.is_some() && holds_handshapes(job, tier) {
            (guess.role, guess.confidence) = ("configuration".parse().ok(), 0.5);
            guess.why = format!("{}, and its values are handshapes", guess.why);
        }
    }
    report.findings.extend(doubted_roles_finding(transcript, &guesses));
    Ok(guesses)
}

/// Returns whether all values of a tier are handshapes of one inventory.
fn holds_handshapes(job: &ImportJob<'_>, tier: &TranscriptTier) -> bool {
    let texts = tier.annotations.iter().map(|annotation| annotation.value.trim());
    let values: Vec<&str> = texts
        .filter(|text| ValueState::of_file_text(text) == ValueState::Value)
        .collect();
    let inventories = job.inventories.iter().map(|stored| &stored.inventory);
    let mut of_handshapes =
        inventories.filter(|it| it.component == SignComponent::Configuration && it.feature.is_none());
    !values.is_empty() && of_handshapes.any(|it| it.distinguishes_texts(values.iter().copied()))
}

/// Returns a finding that names the tiers whose roles are guesses, and the mapping that states them.
fn doubted_roles_finding(transcript: &AnnotationTranscript, guesses: &[TierGuess]) -> Option<ReportFinding> {
    let is_asked = |(tier, guess): &(&TranscriptTier, &TierGuess)| {
        let is_unknown = guess.role.is_none() && guess.hand.is_some();
        !tier.annotations.is_empty() && (is_unknown || guess.is_doubted_guess())
    };
    let asked = transcript.tiers.iter().zip(guesses).filter(is_asked);
    let topics = asked.map(|(_, guess)| (&guess.tier, guess.guessed_tier_topic().unwrap_or_default().to_string()));
    let roles: BTreeMap<&String, String> = topics.collect();
    let names: Vec<String> = roles.iter().map(|(name, role)| format!("{name:?} ({role})")).collect();
    let message = format!(
        "the names of these tiers do not state their roles, so that these are guesses: {}",
        names.join(", ")
    );
    let remedy = ErrorRemedy::choice_remedy(
        RemedyChoice::TierRoles,
        format!("say in a mapping (--map) what each is: {}", json!({ "tiers": roles })),
    );
    (!roles.is_empty()).then(|| ReportFinding::finding_warning(message, remedy))
}

/// Warns if the annotations extend long past the end of the movement.
fn warn_of_length(
    job: &ImportJob<'_>,
    recording: i64,
    transcript: &AnnotationTranscript,
    report: &mut FileReport,
) -> CorpusResult<()> {
    if stored_recordings::body_track(job.connection, recording)?.is_none() {
        return Ok(());
    }
    let row = stored_recordings::load_recording_row(job.connection, recording)?;
    let spans = transcript.tiers.iter().flat_map(|tier| &tier.annotations);
    let last_end = spans.map(|annotation| annotation.span.span_end_instant()).max();
    let end = last_end.unwrap_or(RecordingInstant::RECORDING_START);
    // A small overhang is usual, since annotators often mark beyond the last frame.
    if end.instant_micros() > row.duration_us.saturating_add(MAX_OVERHANG_US) {
        let length = RecordingInstant::from_micros(row.duration_us);
        report.findings.push(ReportFinding::finding_warning(
            format!(
                "its annotations end at {end}, but the movement of the recording {:?} at {length}",
                row.name
            ),
            ErrorRemedy::command_remedy(
                "see whether both are of the same take; `chereme undo`, and another name for the file, \
             keeps them apart",
            ),
        ));
    }
    Ok(())
}

/// Returns the recording that the annotations belong to, or a new one without movement.
fn find_or_add_recording(
    job: &mut ImportJob<'_>,
    transcript: &AnnotationTranscript,
    paired: Option<i64>,
    report: &mut FileReport,
) -> CorpusResult<i64> {
    let property = |key: &str| {
        let entry = transcript.properties.iter().find(|(name, _)| name == key);
        entry.map(|(_, value)| value.clone())
    };
    let options = job.options;
    let signer = match options
        .signer
        .clone()
        .or_else(|| property(SIGNER_PROPERTY))
        .or(participant(transcript))
    {
        Some(name) => {
            let stated_hand = options.handedness.clone().or_else(|| property(HANDEDNESS_PROPERTY));
            // A file of another program may have any text in this property.
            let hand = stated_hand.filter(|hand| ["right", "left"].contains(&hand.as_str()));
            let new = stored_recordings::find_signer(job.connection, &name)?.is_none();
            job.count_created_rows("signers", usize::from(new));
            let signer = stored_recordings::signer_named(job.connection, &name, hand.as_deref())?;
            set_hand(job, signer, report)?;
            Some(signer)
        }
        None => None,
    };
    // An origin that is not understood counts as not stated, so that the annotations are still imported.
    let file_origin = property(ORIGIN_PROPERTY).and_then(|origin| RecordOrigin::parse_recording_origin(&origin).ok());
    let origin = options.origin.or(file_origin);
    let licence = options.licence.clone().or_else(|| property(LICENCE_PROPERTY));
    // The caller's statement counts more than a file found beside this one.
    let paired = match &options.into {
        Some(into) => {
            let id = crate::address::find_recording_by_name(job.connection, into)?.id;
            job.note_file_join(id, JoinReason::Stated);
            Some(id)
        }
        None => paired,
    };
    if let Some(id) = paired {
        stored_recordings::set_recording_description(job.connection, id, signer, origin, licence.as_deref())?;
        store_transcript_media(job, id, transcript)?;
        return Ok(id);
    }
    let (name, note) = job.own_name()?;
    report.findings.extend(note);
    let id = stored_recordings::insert_recording(
        job.connection,
        &RecordingRow {
            id: 0,
            name,
            signer_id: signer,
            signer: None,
            origin: origin.unwrap_or_default(),
            duration_us: 0,
            licence,
            notes: None,
        },
    )?;
    job.count_created_rows("recordings", 1);
    store_transcript_media(job, id, transcript)?;
    Ok(id)
}

/// Stores the media files that a recording does not have yet.
fn store_transcript_media(
    job: &mut ImportJob<'_>,
    recording: i64,
    transcript: &AnnotationTranscript,
) -> CorpusResult<()> {
    let there = stored_recordings::media_tracks(job.connection, recording)?;
    for (place, media) in transcript.media.iter().enumerate() {
        let name = format!("media {}", place + 1);
        // An earlier version of the file has stored its media under the same names.
        if there.iter().any(|track| track.name == name) {
            continue;
        }
        let url = media.relative_url.as_ref().unwrap_or(&media.url);
        // If the film was imported before the annotation file, it is the one that the annotation file names.
        let film = there
            .iter()
            .find(|track| track.name.starts_with("film ") && is_same_film(track, &crate::media::file_name(url)));
        // The time origin is the place in the film where the annotations begin, so the film starts that much
        // earlier.
        let mut offset = -media.time_origin.unwrap_or_default().saturating_mul(1000);
        if let Some(film) = film {
            // It would otherwise stand twice in the recording, under both names.
            stored_recordings::remove_media_track(job.connection, film.id)?;
            // A file that states no origin must not undo an offset that was set for the film.
            if media.time_origin.is_none() {
                offset = film.offset_us;
            }
        }
        let row = MediaTrackRow {
            id: 0,
            recording_id: recording,
            name,
            offset_us: offset,
            url: url.clone(),
            media_type: Some(media.mime_type.clone()).filter(|text| !text.is_empty()),
            imported: Vec::new(),
        };
        stored_recordings::insert_media_track(job.connection, &row)?;
        job.count_created_rows("tracks", 1);
    }
    Ok(())
}

/// Returns the participant of the tiers, if all tiers have the same one.
fn participant(transcript: &AnnotationTranscript) -> Option<String> {
    let names = transcript_participants(transcript);
    let mut all = names.into_iter();
    all.next().filter(|_| all.next().is_none()).map(str::to_owned)
}

fn transcript_participants(transcript: &AnnotationTranscript) -> BTreeSet<&str> {
    let tiers = transcript.tiers.iter();
    let named = tiers.filter_map(|tier| tier.participant.as_deref());
    named.filter(|name| !name.trim().is_empty()).collect()
}

/// Adds the participants as signers if a file has several; a single participant is the recording's signer.
fn know_participants(job: &mut ImportJob<'_>, transcript: &AnnotationTranscript) -> CorpusResult<()> {
    let all = transcript_participants(transcript);
    // The only participant is already the signer of the recording.
    if all.len() < 2 {
        return Ok(());
    }
    for name in all {
        let new = stored_recordings::find_signer(job.connection, name)?.is_none();
        job.count_created_rows("signers", usize::from(new));
        stored_recordings::signer_named(job.connection, name, None)?;
    }
    Ok(())
}

/// Returns the tiers of the recording by their names in the file, if the file is a version of the one that they came
/// from and shares some of them.
fn standing_tiers(
    job: &ImportJob<'_>,
    recording: i64,
    transcript: &AnnotationTranscript,
    base: Option<&AnnotationTranscript>,
    renames: &[TierRename],
    report: &mut FileReport,
) -> CorpusResult<BTreeMap<String, TierRow>> {
    let mut there: BTreeMap<String, TierRow> = stored_tiers::load_tier_rows(job.connection, recording)?
        .into_iter()
        .map(|row| (row.name.clone(), row))
        .collect();
    if let Some(base) = base {
        for (theirs, mine) in update::find_renamed_tiers(job, transcript, base, &there)? {
            let Some(row) = there.remove(&mine) else {
                continue;
            };
            // A tier that only the file renamed gets its new name here.
            if !renames.iter().any(|rename| rename.from == mine && rename.to == theirs) {
                report.findings.push(ReportFinding::finding_note(format!(
                    "the tier {theirs:?} of the file is {mine:?} in the corpus"
                )));
            }
            there.insert(theirs, row);
        }
    }
    let double = transcript.tiers.iter().find(|tier| there.contains_key(&tier.name));
    // A file without any tier name of the recording only adds tiers to it.
    match double {
        None => Ok(BTreeMap::new()),
        Some(_) if update::is_edited(job, transcript, &there)? => Ok(there),
        Some(tier) => Err(CorpusError::from_wrong_message(format!(
            "the recording {:?} has a tier {:?} already, and this file would bring another",
            stored_recordings::load_recording_row(job.connection, recording)?.name,
            tier.name
        ))
        .with_advice("undo the earlier import first, or rename the file or the tier")),
    }
}

fn write_tiers(
    job: &mut ImportJob<'_>,
    recording: i64,
    there: &BTreeMap<String, TierRow>,
    transcript: &AnnotationTranscript,
    guesses: &[TierGuess],
    report: &mut FileReport,
) -> CorpusResult<Vec<i64>> {
    let first = stored_tiers::load_tier_rows(job.connection, recording)?.len();
    let mut rows = vec![0; transcript.tiers.len()];
    let mut new = 0;
    for place in transcript.tiers_parents_first() {
        let (tier, guess) = (&transcript.tiers[place], &guesses[place]);
        if let Some(row) = there.get(&tier.name) {
            rows[place] = row.id;
            continue;
        }
        new += 1;
        let inventory = tier_inventory(job, transcript, tier, guess, report)?;
        let mut row = TierRow {
            recording_id: recording,
            name: tier.name.clone(),
            // The new tiers follow those that stand there, in the order of the file.
            position: (first + place) as i64,
            parent_id: tier.parent.map(|parent| rows[parent]),
            stereotype: tier.stereotype,
            participant: people::known_person_name(job.connection, tier.participant.as_deref())?,
            annotator: people::known_person_name(job.connection, tier.annotator.as_deref())?,
            language: tier.language.clone(),
            inventory_id: inventory,
            source: Some(
                json!({ "type": tier.kind, "locale": tier.locale, "vocabulary": tier.vocabulary }).to_string(),
            ),
            ..TierRow::default()
        };
        set_role(&mut row, guess);
        rows[place] = stored_tiers::insert_tier(job.connection, &row)?;
    }
    job.count_created_rows("tiers", new);
    Ok(rows)
}

fn write_annotations(
    job: &mut ImportJob<'_>,
    transcript: &AnnotationTranscript,
    guesses: &[TierGuess],
    tier_rows: &[i64],
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<()> {
    let mut rows: BTreeMap<AnnotationAddress, i64> = BTreeMap::new();
    let mut count = 0;
    for tier in transcript.tiers_parents_first() {
        for (index, annotation) in transcript.tiers[tier].annotations.iter().enumerate() {
            // The progress also answers whether the user stopped the import, so it is asked within long
            // tiers.
            if count % 256 == 255 {
                job.report_progress(progress)?;
            }
            let parent = annotation.parent.and_then(|parent| rows.get(&parent).copied());
            let plain_row = annotation_row(annotation, tier_rows[tier], parent);
            let row = with_coded_state(plain_row, &guesses[tier]);
            rows.insert(
                AnnotationAddress { tier, index },
                stored_tiers::insert_annotation(job.connection, &row)?,
            );
            count += 1;
        }
    }
    job.count_created_rows("annotations", count);
    Ok(())
}

/// Sets the state of a row without a value, on tiers of glosses and components.
fn with_coded_state(mut row: AnnotationRow, guess: &TierGuess) -> AnnotationRow {
    let coded = guess.role.as_ref().is_some_and(TierRole::is_coded);
    let state = ValueState::of_file_text(&row.value);
    // In a free text the same words may be meant literally.
    if coded && matches!(state, ValueState::NotApplicable | ValueState::Unclear) {
        row.state = state;
        row.value.clear();
    }
    row
}

/// Returns the state of a text: a value, or nothing coded.
fn plain_state(text: &str) -> ValueState {
    match text {
        "" => ValueState::Unset,
        _ => ValueState::Value,
    }
}

fn annotation_row(annotation: &TranscriptAnnotation, tier_id: i64, parent_id: Option<i64>) -> AnnotationRow {
    // Most annotations have nothing of this, and their rows then need no document.
    let source = (annotation.entry.is_some()
        || annotation.language.is_some()
        || annotation.external_ref.is_some()
        || annotation.timing != AnnotationTiming::Own)
        .then(|| {
            json!({
                "entry": annotation.entry,
                "language": annotation.language,
                "external_ref": annotation.external_ref,
                "timing": annotation.timing,
            })
            .to_string()
        });
    AnnotationRow {
        id: 0,
        tier_id,
        start_us: annotation.span.span_start_instant().instant_micros(),
        end_us: annotation.span.span_end_instant().instant_micros(),
        state: plain_state(&annotation.value),
        value: annotation.value.clone(),
        parent_id,
        position: i64::from(annotation.order),
        origin: AnnotationOrigin::File,
        confidence: None,
        external_id: Some(annotation.id.clone()),
        // The times of the file are kept, since sharing them out in microseconds may round differently.
        file_start_ms: annotation.millis.map(|[start, _]| start),
        file_end_ms: annotation.millis.map(|[_, end]| end),
        source,
    }
}
