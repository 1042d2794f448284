//! ELAN's annotation files: tiers, annotations and vocabularies onto a recording.

mod update;

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::eaf;
use chereme_formats::eaf::convert::{Annotation, Place, Tier, Timing, Transcript, Vocabulary};
use chereme_formats::roles::{self, Hands, Mapping, TierGuess};
use chereme_motion::Instant;
use chereme_sign::text::fold;
use chereme_sign::{Component, Inventory, InventoryValue, TierRole, inventory};
use serde_json::json;

use super::report::ReportFinding;
use super::{FileReport, FileStatus, Job};
use crate::db::recordings::{self, MediaTrackRow, RecordingRow};
use crate::db::tiers::{self, AnnotationRow, TierRow};
use crate::error::{Error, Result};
use crate::inventories::{self, StoredInventory};
use crate::progress::Progress;
use crate::tokens;

/// The properties by which a file says what its recording is.
pub(crate) const ORIGIN: &str = "chereme.origin";
pub(crate) const LICENCE: &str = "chereme.licence";
pub(crate) const SIGNER: &str = "chereme.signer";
pub(crate) const HANDEDNESS: &str = "chereme.handedness";
/// The property by which a file says what its tiers are: the `tiers` of a [`Mapping`], as JSON.
pub(crate) const TIERS: &str = "chereme.tiers";

/// How long after the end of the movement annotations may end without a word.
const BEYOND: i64 = 1_000_000;

pub(super) fn import(job: &mut Job<'_>, _progress: &mut Progress<'_>) -> Result<FileReport> {
    if is_newest(job)? {
        return Ok(FileReport::unchanged(job.path));
    }
    let bytes = job.bytes()?;
    let (transcript, findings) =
        eaf::read(&bytes).map_err(|error| Error::wrong(error.to_string()))?;
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    report
        .findings
        .extend(findings.into_iter().map(ReportFinding::from));
    let guesses = guess(job, &transcript, &mut report)?;
    report.understand("tiers", &guesses);
    let recording = recording(job, &transcript)?;
    warn_of_length(job, recording, &transcript, &mut report)?;
    report.recording = Some(recordings::recording(job.connection, recording)?.name);
    let there = standing_tiers(job, recording, &transcript)?;
    let tier_rows = write_tiers(job, (recording, &there), &transcript, &guesses, &mut report)?;
    if there.is_empty() {
        write_annotations(job, &transcript, &guesses, &tier_rows)?;
    } else {
        report.status = FileStatus::Updated;
        let tiers = (tier_rows.as_slice(), &there);
        update::annotations(job, &transcript, &guesses, tiers, &mut report)?;
    }
    let before = crate::db::signs::tokens_of_recording(job.connection, recording)?.len();
    recordings::lengthen(job.connection, recording, transcript.end().micros())?;
    tokens::derive(job.connection, recording, None, &job.inventories)?;
    let derived = crate::db::signs::tokens_of_recording(job.connection, recording)?.len();
    job.count("tokens", derived.saturating_sub(before));
    job.keep(Some(recording), Some(&bytes))?;
    if !guesses
        .iter()
        .any(|guess| guess.role == Some(TierRole::Gloss))
    {
        report.findings.push(ReportFinding::warning(
            "no tier was recognised as one of glosses, so no tokens were made",
            "say which tier is what in a mapping file (--map), or with `chereme annotate`",
        ));
    }
    Ok(report)
}

/// Tells whether the corpus has the file, and no later one of its name for the same recording.
fn is_newest(job: &Job<'_>) -> Result<bool> {
    let Some(known) = recordings::source_file_hashed(job.connection, &job.hash)? else {
        return Ok(false);
    };
    let Some(recording) = known.recording_id else {
        return Ok(true);
    };
    let files = recordings::source_files(job.connection, recording)?;
    let newest = files
        .iter()
        .rfind(|file| file.kind == known.kind && file.name == known.name);
    Ok(newest.is_none_or(|file| file.hash == job.hash))
}

/// What the tiers are: as the caller says, else the file, else by their names; those whose names say
/// nothing are what tiers of that name are elsewhere in the corpus.
fn guess(
    job: &Job<'_>,
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
                "tiers are taken for what their names say",
            ));
            job.options.mapping.clone()
        }
        None => job.options.mapping.clone(),
    };
    let mut guesses = roles::guess_tiers(transcript, &mapping);
    for guess in guesses.iter_mut().filter(|guess| guess.role.is_none()) {
        let known = tiers::roles_named(job.connection, &guess.tier)?;
        let [one] = known.as_slice() else { continue };
        guess.role = Some(one.role());
        guess.hand = one.hand.as_deref().and_then(Hands::of);
        guess.confidence = 0.5;
        guess.why = "tiers of this name in the corpus are".to_owned();
    }
    Ok(guesses)
}

/// Warns where the annotations go on long after the movement.
fn warn_of_length(
    job: &Job<'_>,
    recording: i64,
    transcript: &Transcript,
    report: &mut FileReport,
) -> Result<()> {
    if recordings::motion_track(job.connection, recording)?.is_none() {
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
            "see whether both are of the same take; `chereme undo`, and another name for the file, \
             keeps them apart",
        ));
    }
    Ok(())
}

/// The recording that the annotations are about: that of the same stem, or a new one without movement.
fn recording(job: &mut Job<'_>, transcript: &Transcript) -> Result<i64> {
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
            Some(recordings::signer_named(
                job.connection,
                &name,
                hand.as_deref(),
            )?)
        }
        None => None,
    };
    let origin = property(ORIGIN)
        .filter(|origin| ["captured", "made", "generated"].contains(&origin.as_str()));
    let origin = options.origin.clone().or(origin);
    let licence = options.licence.clone().or_else(|| property(LICENCE));
    let paired = match job.recordings.get(&job.pair_key()) {
        Some(&id) => Some(id),
        None => recordings::recording_named(job.connection, &job.stem)?.map(|row| row.id),
    };
    if let Some(id) = paired {
        recordings::describe(
            job.connection,
            id,
            signer,
            origin.as_deref(),
            licence.as_deref(),
        )?;
        media(job, id, transcript)?;
        return Ok(id);
    }
    let id = recordings::insert_recording(
        job.connection,
        &RecordingRow {
            id: 0,
            name: job.stem.clone(),
            signer_id: signer,
            signer: None,
            origin: origin.unwrap_or_else(|| "captured".to_owned()),
            duration_us: 0,
            licence,
            notes: None,
        },
    )?;
    job.count("recordings", 1);
    media(job, id, transcript)?;
    job.recordings.insert(job.pair_key(), id);
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
        let row = MediaTrackRow {
            id: 0,
            recording_id: recording,
            name,
            offset_us: -media.time_origin.unwrap_or_default().saturating_mul(1000),
            url: media
                .relative_url
                .clone()
                .unwrap_or_else(|| media.url.clone()),
            media_type: Some(media.mime_type.clone()).filter(|text| !text.is_empty()),
        };
        recordings::insert_media_track(job.connection, &row)?;
        job.count("tracks", 1);
    }
    Ok(())
}

/// The one participant of all tiers, where there is one.
fn participant(transcript: &Transcript) -> Option<String> {
    let all: BTreeSet<&str> = transcript
        .tiers
        .iter()
        .filter_map(|tier| tier.participant.as_deref())
        .filter(|name| !name.trim().is_empty())
        .collect();
    let mut all = all.into_iter();
    all.next()
        .filter(|_| all.next().is_none())
        .map(str::to_owned)
}

/// The tiers of the recording, where the file is one that they came from and some of them are in it.
fn standing_tiers(
    job: &Job<'_>,
    recording: i64,
    transcript: &Transcript,
) -> Result<BTreeMap<String, TierRow>> {
    let there: BTreeMap<String, TierRow> = tiers::tiers(job.connection, recording)?
        .into_iter()
        .map(|row| (row.name.clone(), row))
        .collect();
    let double = transcript
        .tiers
        .iter()
        .find(|tier| there.contains_key(&tier.name));
    match double {
        None => Ok(BTreeMap::new()),
        Some(_) if update::is_edited(job, transcript, &there)? => Ok(there),
        Some(tier) => Err(Error::wrong(format!(
            "the recording {:?} has a tier {:?} already, and this file would bring another",
            job.stem, tier.name
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
        let role = guess.role.clone().unwrap_or_default();
        let (component, feature) = match &role {
            TierRole::Component { component, feature } => (Some(*component), feature.clone()),
            _ => (None, None),
        };
        let row = TierRow {
            id: 0,
            recording_id: recording,
            name: tier.name.clone(),
            position: (first + place) as i64,
            parent_id: tier.parent.map(|parent| rows[parent]),
            stereotype: tier.stereotype.map(|it| it.elan_name().to_owned()),
            role: match role {
                TierRole::Component { .. } => "component".to_owned(),
                other => other.name(),
            },
            component: component.map(|it| it.name().to_owned()),
            feature,
            hand: guess.hand.map(|hand| hand.name().to_owned()),
            participant: tier.participant.clone(),
            annotator: tier.annotator.clone(),
            language: tier.language.clone(),
            inventory_id: inventory,
            source: Some(
                json!({ "type": tier.kind, "locale": tier.locale, "vocabulary": tier.vocabulary })
                    .to_string(),
            ),
        };
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

/// The inventory of a component tier: its vocabulary, or one of the corpus that has all its values.
fn tier_inventory(
    job: &mut Job<'_>,
    transcript: &Transcript,
    tier: &Tier,
    guess: &TierGuess,
    report: &mut FileReport,
) -> Result<Option<i64>> {
    let Some(TierRole::Component { component, feature }) = &guess.role else {
        return Ok(None);
    };
    let said: BTreeSet<&str> = tier
        .annotations
        .iter()
        .map(|annotation| annotation.value.trim())
        .filter(|value| !value.is_empty() && missing(value).is_none())
        .collect();
    let fits = |stored: &&StoredInventory| {
        let it = &stored.inventory;
        it.component == *component
            && it.feature == *feature
            && said.iter().all(|value| it.find(value).is_some())
    };
    let vocabulary = tier.vocabulary.as_ref().and_then(|id| {
        transcript
            .vocabularies
            .iter()
            .find(|it| it.id == *id && !it.entries.is_empty())
    });
    let builtin =
        |stored: &&StoredInventory| inventory::builtin_by_id(&stored.inventory.id).is_some();
    let listed = |stored: &&StoredInventory| {
        vocabulary.is_none_or(|it| {
            entry_ids(it)
                .iter()
                .all(|id| stored.inventory.find(id).is_some())
        })
    };
    let known = job
        .inventories
        .iter()
        .filter(builtin)
        .find(|it| fits(it) && listed(it));
    if let Some(known) = known.filter(|_| vocabulary.is_some() || !said.is_empty()) {
        return Ok(Some(known.id));
    }
    match vocabulary {
        Some(vocabulary) => {
            let (inventory, dropped) = of_vocabulary(vocabulary, *component, feature.clone());
            for entry in dropped {
                report.findings.push(ReportFinding::note(format!(
                    "the vocabulary {:?} has {entry:?} twice; the second stays text",
                    vocabulary.id
                )));
            }
            let mut stored = job.inventories.iter().map(|it| &it.inventory);
            let before = stored.find(|it| it.id == inventory.id);
            let new = before.is_none();
            let inventory = inventories::joined(before, inventory);
            let id = inventories::store(job.connection, &inventory)?;
            job.count("inventories", usize::from(new));
            job.inventories = inventories::load(job.connection)?.into();
            Ok(Some(id))
        }
        None if said.is_empty() => Ok(None),
        None => Ok(job.inventories.iter().find(fits).map(|stored| stored.id)),
    }
}

fn entry_ids(vocabulary: &Vocabulary) -> Vec<&str> {
    let first = |entry: &'_ chereme_formats::eaf::convert::Entry| -> Option<usize> {
        (!entry.values.is_empty()).then_some(0)
    };
    vocabulary
        .entries
        .iter()
        .filter_map(|entry| first(entry).map(|at| entry.values[at].value.trim()))
        .filter(|value| !value.is_empty())
        .collect()
}

fn of_vocabulary(
    vocabulary: &Vocabulary,
    component: Component,
    feature: Option<String>,
) -> (Inventory, Vec<String>) {
    let (mut seen, mut dropped, mut values) = (BTreeSet::new(), Vec::new(), Vec::new());
    for entry in &vocabulary.entries {
        let Some(id) = entry
            .values
            .first()
            .map(|value| value.value.trim().to_owned())
        else {
            continue;
        };
        if id.is_empty() || !seen.insert(fold(&id)) {
            dropped.push(id);
            continue;
        }
        let mut names = BTreeMap::new();
        for value in &entry.values {
            let text = value.value.trim();
            let own = fold(text) == fold(&id);
            if !text.is_empty() && !value.language.is_empty() && (own || seen.insert(fold(text))) {
                names.insert(value.language.clone(), text.to_owned());
            }
        }
        let notes = entry
            .values
            .iter()
            .find_map(|value| value.description.clone());
        let notes = notes.filter(|text| !text.trim().is_empty());
        values.push(InventoryValue {
            id,
            names,
            notes,
            ..InventoryValue::default()
        });
    }
    let feature_name = feature
        .as_ref()
        .map_or(String::new(), |feature| format!(".{feature}"));
    let inventory = Inventory {
        id: format!("{}/{component}{feature_name}", vocabulary.id),
        component,
        feature,
        version: 1,
        language: None,
        names: BTreeMap::from([("en".to_owned(), vocabulary.id.clone())]),
        description: vocabulary
            .descriptions
            .iter()
            .map(|(_, text)| text.trim())
            .find(|text| !text.is_empty())
            .unwrap_or_default()
            .to_owned(),
        values,
    };
    (inventory, dropped)
}

fn write_annotations(
    job: &mut Job<'_>,
    transcript: &Transcript,
    guesses: &[TierGuess],
    tier_rows: &[i64],
) -> Result<()> {
    let mut rows: BTreeMap<Place, i64> = BTreeMap::new();
    let mut count = 0;
    for tier in parents_first(transcript) {
        for (index, annotation) in transcript.tiers[tier].annotations.iter().enumerate() {
            let parent = annotation
                .parent
                .and_then(|parent| rows.get(&parent).copied());
            let row = annotation_row(annotation, tier_rows[tier], parent);
            let row = coded(row, &guesses[tier]);
            rows.insert(
                Place { tier, index },
                tiers::insert_annotation(job.connection, &row)?,
            );
            count += 1;
        }
    }
    job.count("annotations", count);
    Ok(())
}

/// Tells by a row's state how its value is missing, on tiers of glosses and components.
fn coded(mut row: AnnotationRow, guess: &TierGuess) -> AnnotationRow {
    let coded = matches!(
        guess.role,
        Some(TierRole::Gloss | TierRole::Component { .. })
    );
    if let Some(state) = missing(&row.value).filter(|_| coded) {
        state.clone_into(&mut row.state);
        row.value.clear();
    }
    row
}

/// How a value is missing, in the words that exported files say it with.
fn missing(value: &str) -> Option<&'static str> {
    match value {
        "n/a" => Some("not-applicable"),
        "unclear" => Some("unclear"),
        _ => None,
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
        state: if annotation.value.is_empty() {
            "unset"
        } else {
            "value"
        }
        .to_owned(),
        value: annotation.value.clone(),
        parent_id,
        position: i64::from(annotation.order),
        origin: "file".to_owned(),
        confidence: None,
        external_id: Some(annotation.id.clone()),
        file_start_ms: annotation.millis.map(|[start, _]| start),
        file_end_ms: annotation.millis.map(|[_, end]| end),
        source,
    }
}
