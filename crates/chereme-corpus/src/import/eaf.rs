//! Imports tiers, annotations and vocabularies from ELAN's annotation files into a recording.

mod remap;
mod renames;
mod settle;
mod target;
mod update;
mod vocabulary;

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::eaf::convert::{Annotation, AnnotationAddress, Timing, Transcript};
use chereme_formats::roles::{self, Mapping, TierGuess};
use chereme_motion::Instant;
use chereme_sign::TierRole;
use chereme_sign::{Choice, Remedy};
use serde_json::json;

use super::again::set_hand;
use super::readers::Parse;
use super::report::{Outcome, ReportFinding};
use super::understood::TiersRead;
use super::{FileReport, FileStatus, Job, OwnEdits};
use crate::db::columns::{AnnotationOrigin, Origin, ValueState};
use crate::db::edits;
use crate::db::recordings::{self, MediaTrackRow, RecordingRow};
use crate::db::tiers::{self, AnnotationRow, TierRow};
use crate::error::{Error, Result};
use crate::media::is_same_film;
use crate::progress::Progress;
use crate::tokens;
use remap::{remap, set_role};
use renames::Rename;
pub(super) use vocabulary::tier_inventory;

/// The properties in which a file describes its recording.
pub(crate) const ORIGIN: &str = "chereme.origin";
pub(crate) const LICENCE: &str = "chereme.licence";
pub(crate) const SIGNER: &str = "chereme.signer";
pub(crate) const HANDEDNESS: &str = "chereme.handedness";
/// The property in which a file states the roles of its tiers: the `tiers` of a [`Mapping`], as JSON.
pub(crate) const TIERS: &str = "chereme.tiers";

/// How far annotations may extend beyond the end of the movement without a warning, in microseconds.
pub(super) const BEYOND: i64 = 1_000_000;

/// Adds tiers to a recording that has none of their names; returns whether it added them.
pub(super) fn add(
    job: &mut Job<'_>,
    recording: i64,
    transcript: &Transcript,
    report: &mut FileReport,
    progress: &mut Progress<'_>,
) -> Result<bool> {
    let there = standing_tiers(job, recording, (transcript, None), &[], report)?;
    if !there.is_empty() {
        return Ok(false);
    }
    let guesses = guess(job, transcript, report)?;
    let tiers = write_tiers(job, (recording, &there), transcript, &guesses, report)?;
    write_annotations(job, transcript, &guesses, &tiers, progress)?;
    recordings::lengthen(job.connection, recording, transcript.end().micros())?;
    Ok(true)
}

/// Imports tiers of any format; `read` converts the file's bytes to a transcript.
pub(super) fn import_as(
    job: &mut Job<'_>,
    progress: &mut Progress<'_>,
    read: Parse<Transcript>,
) -> Result<FileReport> {
    let maps = job.options.mapping.entries().next().is_some();
    let here = job.places.at(&job.place, job.kind).cloned();
    let takes = job.options.own_edits == OwnEdits::Theirs;
    if let Some(here) = here.filter(|row| row.hash == job.hash && !maps && !takes)
        && let Some(report) = target::unchanged(job, &here)?
    {
        job.again = here.recording_id;
        return Ok(report);
    }
    let bytes = job.bytes()?;
    job.report_progress(progress)?;
    let (mut transcript, findings) = read(&bytes).map_err(Error::wrong)?;
    super::elan::fill(job, &mut transcript)?;
    job.report_progress(progress)?;
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    report
        .findings
        .extend(findings.into_iter().map(ReportFinding::from));
    let guesses = guess(job, &transcript, &mut report)?;
    report.understood.tiers = Some(TiersRead::Guessed(guesses.clone()).into());
    let target = target::find(job, read, &transcript, &mut report)?;
    let same = target.base.as_ref().is_some_and(|it| it.hash == job.hash);
    job.again = target.recording.filter(|_| same);
    let recording = match job.again {
        Some(again) => again,
        None => {
            let recording = recording(job, &transcript, target.recording, &mut report)?;
            know_participants(job, &transcript)?;
            recording
        }
    };
    report.recording = Some(recordings::recording(job.connection, recording)?.name);
    let mut base = target.transcript(job, read)?;
    let renames = match &mut base {
        Some(base) => renames::take_names(job, recording, base, &transcript)?,
        None => Vec::new(),
    };
    let there = standing_tiers(
        job,
        recording,
        (&transcript, base.as_ref()),
        &renames,
        &mut report,
    )?;
    if let Some(base) = target.base.as_ref().filter(|_| same && !takes) {
        if remap(job, &there, &transcript, &guesses, &mut report)? == 0 {
            let mut same = FileReport::unchanged(job.path, target.elsewhere(job));
            same.recording = report.recording;
            return Ok(same);
        }
        report.status = FileStatus::Updated;
        report.findings.insert(
            0,
            ReportFinding::note(format!(
                "it is the recording {:?} already (from {}); its tiers now have the roles of the mapping",
                report.recording.as_deref().unwrap_or_default(),
                base.path.as_ref().unwrap_or(&base.name)
            )),
        );
        tokens::derive_with_progress(job.connection, recording, None, &job.inventories, progress)?;
        return Ok(report);
    }
    warn_of_length(job, recording, &transcript, &mut report)?;
    let counted = job.counts.total();
    let before = crate::db::signs::tokens_of_recording(job.connection, recording)?.len();
    if there.is_empty() {
        let tiers = write_tiers(job, (recording, &there), &transcript, &guesses, &mut report)?;
        write_annotations(job, &transcript, &guesses, &tiers, progress)?;
    } else {
        let sides = (&transcript, base.as_ref());
        update(
            job,
            (recording, there),
            (sides, &renames),
            &guesses,
            &mut report,
            progress,
        )?;
        if report.status == FileStatus::Refused {
            return Ok(report);
        }
    }
    recordings::lengthen(job.connection, recording, transcript.end().micros())?;
    tokens::derive_with_progress(job.connection, recording, None, &job.inventories, progress)?;
    let derived = crate::db::signs::tokens_of_recording(job.connection, recording)?.len();
    job.count("tokens", derived.saturating_sub(before));
    if same && job.counts.total() == counted {
        let mut unchanged = FileReport::unchanged(job.path, target.elsewhere(job));
        unchanged.recording = report.recording;
        return Ok(unchanged);
    }
    if same {
        report.status = FileStatus::Updated;
    } else {
        job.keep(Some(recording), Some(&bytes))?;
    }
    if !guesses
        .iter()
        .any(|guess| guess.role == Some(TierRole::Gloss))
    {
        report.findings.push(ReportFinding::warning(
            "no tier was recognised as one of glosses, so no tokens were made",
            Remedy::choice(
                Choice::TierRoles,
                "give tiers their roles in a mapping file (--map), or with `chereme annotate`",
            ),
        ));
    }
    Ok(report)
}

/// Updates a recording from an edited file. Fails if edits of the corpus would be lost, unless the options decide about
/// them.
fn update(
    job: &mut Job<'_>,
    (recording, mut there): (i64, BTreeMap<String, TierRow>),
    ((transcript, base), renames): ((&Transcript, Option<&Transcript>), &[Rename]),
    guesses: &[TierGuess],
    report: &mut FileReport,
    progress: &mut Progress<'_>,
) -> Result<()> {
    let own_edits = job.options.own_edits;
    let merge = own_edits == OwnEdits::Merge;
    let before = settle::Before::of(job.connection, recording)?;
    let (counts, inventories) = (job.counts.clone(), job.inventories.clone());
    // A token refers to its annotation until tokens are derived again.
    edits::defer_references(job.connection)?;
    job.connection.execute_batch("SAVEPOINT edits")?;
    let mut notes = renames::write(job.connection, renames, &mut there)?;
    let tier_rows = write_tiers(job, (recording, &there), transcript, guesses, report)?;
    renames::write_parents(
        job.connection,
        (transcript, base.filter(|_| merge)),
        &mut there,
        &tier_rows,
    )?;
    let there = &there;
    let sides = update::Sides {
        transcript,
        guesses,
        base,
        known: there,
        tier_rows: &tier_rows,
        merge,
    };
    let updated = update::annotations(job, &sides, progress)?;
    notes.extend(before.settle(job.connection, &updated.written)?);
    report.status = FileStatus::Updated;
    let lost = updated
        .edits
        .iter()
        .filter(|it| it.outcome == Outcome::Lost);
    let lost: Vec<String> = lost.map(ToString::to_string).collect();
    if lost.is_empty() || matches!(own_edits, OwnEdits::Theirs | OwnEdits::Merge) {
        job.connection.execute_batch("RELEASE edits")?;
        let ours = updated.written.clone();
        report
            .findings
            .extend(notes.into_iter().map(ReportFinding::note));
        remap(job, there, transcript, guesses, report)?;
        job.count("annotations", updated.changes.added);
        job.counts.changed("annotations", updated.changes.changed);
        job.counts.removed("annotations", updated.changes.removed);
        if merge {
            for (mine, theirs) in &updated.conflicts {
                let from = job.file_name.as_str();
                crate::merge::keep_annotation(job.connection, from, *mine, theirs.as_ref())?;
            }
        }
        updated.report(&sides, report);
        return before.check(job.connection, &ours, merge);
    }
    job.connection
        .execute_batch("ROLLBACK TO edits; RELEASE edits")?;
    (job.counts, job.inventories) = (counts, inventories);
    let many = match lost.len() {
        1 => "an edit".to_owned(),
        many => format!("{many} edits"),
    };
    report.edits = updated.edits;
    let mut lines: Vec<ReportFinding> = Vec::new();
    if own_edits == OwnEdits::Mine {
        report.status = FileStatus::Unchanged;
        lines.push(ReportFinding::note(format!(
            "it would take back {many} of yours: the recording stays as it is"
        )));
        for edit in &mut report.edits {
            edit.outcome = Outcome::Conflict;
        }
    } else {
        report.status = FileStatus::Refused;
        lines.push(ReportFinding::error(
            format!("it was changed since it was imported, and would take back {many} of yours"),
            Remedy::choice(Choice::Side, "import it again with --merge (your edits and the file's changes; yours where both changed \
             the same annotation), --theirs (the file), or --mine (your edits)"),
        ));
        update::some(&lost, &mut |line| lines.push(ReportFinding::note(line)));
    }
    report.findings.splice(0..0, lines);
    Ok(())
}

/// Guesses the roles of tiers from the caller's mapping, then the file, then the names. A tier whose name says nothing
/// gets the role that tiers of that name have elsewhere in the corpus.
fn guess(
    job: &mut Job<'_>,
    transcript: &Transcript,
    report: &mut FileReport,
) -> Result<Vec<TierGuess>> {
    let property = transcript.properties.iter().find(|(key, _)| key == TIERS);
    let own = property.map(|(_, text)| Mapping::from_json(&format!("{{\"tiers\": {text}}}")));
    let mapping = match own {
        Some(Ok(own)) => job.options.mapping.completed_by(&own),
        Some(Err(error)) => {
            report.findings.push(ReportFinding::warning(
                format!("its property {TIERS:?} is not understood: {error}"),
                "the roles of tiers are inferred from their names",
            ));
            job.options.mapping.clone()
        }
        None => job.options.mapping.clone(),
    };
    for tier in &transcript.tiers {
        if let Some((entry, _)) = job.options.mapping.tier(&tier.name) {
            job.used.insert(entry.to_owned());
        }
    }
    let mut guesses = roles::guess_tiers(transcript, &mapping);
    for guess in guesses.iter_mut().filter(|guess| guess.role.is_none()) {
        let known = tiers::roles_named(job.connection, &guess.tier)?;
        let [one] = known.as_slice() else { continue };
        guess.role = Some(one.role.clone());
        guess.hand = one.hand;
        guess.confidence = 0.5;
        guess.why = "tiers of this name in the corpus are".to_owned();
    }
    Ok(guesses)
}

/// Warns if the annotations extend long past the end of the movement.
fn warn_of_length(
    job: &Job<'_>,
    recording: i64,
    transcript: &Transcript,
    report: &mut FileReport,
) -> Result<()> {
    if recordings::body_track(job.connection, recording)?.is_none() {
        return Ok(());
    }
    let row = recordings::recording(job.connection, recording)?;
    let spans = transcript.tiers.iter().flat_map(|tier| &tier.annotations);
    let end = spans.map(|annotation| annotation.span.end()).max();
    let end = end.unwrap_or(Instant::ZERO);
    if end.micros() > row.duration_us.saturating_add(BEYOND) {
        let length = Instant::from_micros(row.duration_us);
        report.findings.push(ReportFinding::warning(
            format!(
                "its annotations end at {end}, but the movement of the recording {:?} at {length}",
                row.name
            ),
            Remedy::command("see whether both are of the same take; `chereme undo`, and another name for the file, \
             keeps them apart"),
        ));
    }
    Ok(())
}

/// Returns the recording that the annotations belong to, or a new one without movement.
fn recording(
    job: &mut Job<'_>,
    transcript: &Transcript,
    paired: Option<i64>,
    report: &mut FileReport,
) -> Result<i64> {
    let property = |key: &str| {
        let found = transcript.properties.iter().find(|(name, _)| name == key);
        found.map(|(_, value)| value.clone())
    };
    let options = job.options;
    let signer = match options
        .signer
        .clone()
        .or_else(|| property(SIGNER))
        .or(participant(transcript))
    {
        Some(name) => {
            let hand = options.handedness.clone().or_else(|| property(HANDEDNESS));
            let hand = hand.filter(|hand| ["right", "left"].contains(&hand.as_str()));
            let new = recordings::find_signer(job.connection, &name)?.is_none();
            job.count("signers", usize::from(new));
            let signer = recordings::signer_named(job.connection, &name, hand.as_deref())?;
            set_hand(job, signer, report)?;
            Some(signer)
        }
        None => None,
    };
    let origin = property(ORIGIN).and_then(|origin| Origin::of_recording(&origin).ok());
    let origin = options.origin.or(origin);
    let licence = options.licence.clone().or_else(|| property(LICENCE));
    let paired = match &options.into {
        Some(into) => Some(crate::address::recording(job.connection, into)?.id),
        None => paired,
    };
    if let Some(id) = paired {
        recordings::describe(job.connection, id, signer, origin, licence.as_deref())?;
        media(job, id, transcript)?;
        return Ok(id);
    }
    let (name, note) = job.own_name()?;
    report.findings.extend(note);
    let id = recordings::insert_recording(
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
    job.count("recordings", 1);
    media(job, id, transcript)?;
    Ok(id)
}

/// Stores the media files that a recording does not have yet.
fn media(job: &mut Job<'_>, recording: i64, transcript: &Transcript) -> Result<()> {
    let there = recordings::media_tracks(job.connection, recording)?;
    for (place, media) in transcript.media.iter().enumerate() {
        let name = format!("media {}", place + 1);
        if there.iter().any(|it| it.name == name) {
            continue;
        }
        let url = media.relative_url.as_ref().unwrap_or(&media.url);
        // If the film was imported before the annotation file, it is the one that the annotation file names.
        let film = there.iter().find(|it| {
            it.name.starts_with("film ") && is_same_film(it, &crate::media::file_name(url))
        });
        let mut offset = -media.time_origin.unwrap_or_default().saturating_mul(1000);
        if let Some(film) = film {
            recordings::remove_media_track(job.connection, film.id)?;
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
        recordings::insert_media_track(job.connection, &row)?;
        job.count("tracks", 1);
    }
    Ok(())
}

/// Returns the participant of the tiers, if all tiers have the same one.
fn participant(transcript: &Transcript) -> Option<String> {
    let all = participants(transcript);
    let mut all = all.into_iter();
    all.next()
        .filter(|_| all.next().is_none())
        .map(str::to_owned)
}

fn participants(transcript: &Transcript) -> BTreeSet<&str> {
    let tiers = transcript.tiers.iter();
    let named = tiers.filter_map(|tier| tier.participant.as_deref());
    named.filter(|name| !name.trim().is_empty()).collect()
}

/// Adds the participants as signers if a file has several; a single participant is the recording's signer.
fn know_participants(job: &mut Job<'_>, transcript: &Transcript) -> Result<()> {
    let all = participants(transcript);
    if all.len() < 2 {
        return Ok(());
    }
    for name in all {
        let new = recordings::find_signer(job.connection, name)?.is_none();
        job.count("signers", usize::from(new));
        recordings::signer_named(job.connection, name, None)?;
    }
    Ok(())
}

/// Returns the tiers of the recording by their names in the file, if the file is a version of the one that they came
/// from and shares some of them.
fn standing_tiers(
    job: &Job<'_>,
    recording: i64,
    (transcript, base): (&Transcript, Option<&Transcript>),
    renames: &[Rename],
    report: &mut FileReport,
) -> Result<BTreeMap<String, TierRow>> {
    let mut there: BTreeMap<String, TierRow> = tiers::tiers(job.connection, recording)?
        .into_iter()
        .map(|row| (row.name.clone(), row))
        .collect();
    if let Some(base) = base {
        for (theirs, mine) in update::renamed(job, transcript, base, &there)? {
            let Some(row) = there.remove(&mine) else {
                continue;
            };
            // A tier that only the file renamed gets its new name here.
            if !renames.iter().any(|it| it.from == mine && it.to == theirs) {
                report.findings.push(ReportFinding::note(format!(
                    "the tier {theirs:?} of the file is {mine:?} in the corpus"
                )));
            }
            there.insert(theirs, row);
        }
    }
    let double = transcript
        .tiers
        .iter()
        .find(|tier| there.contains_key(&tier.name));
    match double {
        None => Ok(BTreeMap::new()),
        Some(_) if update::is_edited(job, transcript, &there)? => Ok(there),
        Some(tier) => Err(Error::wrong(format!(
            "the recording {:?} has a tier {:?} already, and this file would bring another",
            recordings::recording(job.connection, recording)?.name,
            tier.name
        ))
        .advise("undo the earlier import first, or rename the file or the tier")),
    }
}

fn write_tiers(
    job: &mut Job<'_>,
    (recording, there): (i64, &BTreeMap<String, TierRow>),
    transcript: &Transcript,
    guesses: &[TierGuess],
    report: &mut FileReport,
) -> Result<Vec<i64>> {
    let first = tiers::tiers(job.connection, recording)?.len();
    let mut rows = vec![0; transcript.tiers.len()];
    let mut new = 0;
    for place in parents_first(transcript) {
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
            position: (first + place) as i64,
            parent_id: tier.parent.map(|parent| rows[parent]),
            stereotype: tier.stereotype,
            participant: tier.participant.clone(),
            annotator: tier.annotator.clone(),
            language: tier.language.clone(),
            inventory_id: inventory,
            source: Some(
                json!({ "type": tier.kind, "locale": tier.locale, "vocabulary": tier.vocabulary })
                    .to_string(),
            ),
            ..TierRow::default()
        };
        set_role(&mut row, guess);
        rows[place] = tiers::insert_tier(job.connection, &row)?;
    }
    job.count("tiers", new);
    Ok(rows)
}

fn parents_first(transcript: &Transcript) -> Vec<usize> {
    let depth = |place: usize| {
        std::iter::successors(Some(place), |&at| transcript.tiers[at].parent)
            .take(transcript.tiers.len() + 1)
            .count()
    };
    let mut order: Vec<usize> = (0..transcript.tiers.len()).collect();
    order.sort_by_key(|&place| (depth(place), place));
    order
}

fn write_annotations(
    job: &mut Job<'_>,
    transcript: &Transcript,
    guesses: &[TierGuess],
    tier_rows: &[i64],
    progress: &mut Progress<'_>,
) -> Result<()> {
    let mut rows: BTreeMap<AnnotationAddress, i64> = BTreeMap::new();
    let mut count = 0;
    for tier in parents_first(transcript) {
        for (index, annotation) in transcript.tiers[tier].annotations.iter().enumerate() {
            if count % 256 == 255 {
                job.report_progress(progress)?;
            }
            let parent = annotation
                .parent
                .and_then(|parent| rows.get(&parent).copied());
            let row = annotation_row(annotation, tier_rows[tier], parent);
            let row = coded(row, &guesses[tier]);
            rows.insert(
                AnnotationAddress { tier, index },
                tiers::insert_annotation(job.connection, &row)?,
            );
            count += 1;
        }
    }
    job.count("annotations", count);
    Ok(())
}

/// Sets the state of a row without a value, on tiers of glosses and components.
fn coded(mut row: AnnotationRow, guess: &TierGuess) -> AnnotationRow {
    let coded = guess.role.as_ref().is_some_and(TierRole::is_coded);
    let state = ValueState::of_file_text(&row.value);
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

fn annotation_row(annotation: &Annotation, tier_id: i64, parent_id: Option<i64>) -> AnnotationRow {
    let source = (annotation.entry.is_some()
        || annotation.language.is_some()
        || annotation.external_ref.is_some()
        || annotation.timing != Timing::Own)
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
        start_us: annotation.span.start().micros(),
        end_us: annotation.span.end().micros(),
        state: plain_state(&annotation.value),
        value: annotation.value.clone(),
        parent_id,
        position: i64::from(annotation.order),
        origin: AnnotationOrigin::File,
        confidence: None,
        external_id: Some(annotation.id.clone()),
        file_start_ms: annotation.millis.map(|[start, _]| start),
        file_end_ms: annotation.millis.map(|[_, end]| end),
        source,
    }
}
