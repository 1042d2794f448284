//! Imports files that ELAN stores beside annotation files: vocabularies, tier templates, and display settings of tiers.

use std::collections::BTreeSet;

use chereme_formats::eaf;
use chereme_formats::eaf::eaf_convert::{AnnotationTranscript, TranscriptTier};
use chereme_formats::roles::{self, TierRoleEvidence};
use chereme_sign::{ErrorRemedy, RemedyChoice};
use serde_json::{Value, json};

use super::import_eaf as annotations;
use super::understood::TiersRead;
use super::{FileReport, FileStatus, ImportJob};
use crate::address;
use crate::db::{stored_recordings, stored_tiers};
use crate::error::{CorpusError, CorpusResult};
use crate::progress::ProgressReceiver;
use crate::report_finding::ReportFinding;

/// Reads an external vocabulary file. Vocabularies of a component become inventories; all are stored for the annotation
/// files that refer to this one.
pub(super) fn import_vocabularies(job: &mut ImportJob<'_>, _: &mut ProgressReceiver<'_>) -> CorpusResult<FileReport> {
    if let Some(report) = job.report_unchanged_file() {
        return Ok(report);
    }
    let bytes = job.read_job_bytes()?;
    let (vocabularies, findings) =
        eaf::read_vocabularies(&bytes).map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    report.findings.extend(findings.into_iter().map(ReportFinding::from));
    // The name of a vocabulary indicates its component, as for a tier.
    let names: Vec<TierRoleEvidence<'_>> = vocabularies
        .iter()
        .map(|vocabulary| TierRoleEvidence {
            name: &vocabulary.id,
            ..TierRoleEvidence::default()
        })
        .collect();
    let guesses = roles::guess_roles(&names, &job.options.mapping);
    let transcript = AnnotationTranscript {
        tiers: vocabularies
            .iter()
            .map(|vocabulary| TranscriptTier {
                name: vocabulary.id.clone(),
                vocabulary: Some(vocabulary.id.clone()),
                ..TranscriptTier::default()
            })
            .collect(),
        vocabularies,
        ..AnnotationTranscript::default()
    };
    let mut others = Vec::new();
    for (tier, guess) in transcript.tiers.iter().zip(&guesses) {
        let inventory_id = annotations::tier_inventory(job, &transcript, tier, guess, &mut report)?;
        if inventory_id.is_none() {
            others.push(format!("{:?}", tier.name));
        }
    }
    if !others.is_empty() {
        report.findings.push(ReportFinding {
            remedy: Some(ErrorRemedy::choice_remedy(
                RemedyChoice::TierRoles,
                "import the .eaf that uses them, or give their components in a mapping file (--map)",
            )),
            ..ReportFinding::finding_note(format!(
                "the names of the vocabularies {} name no component: they are kept for the annotation files that use \
                 them",
                others.join(", ")
            ))
        });
    }
    job.keep_source_file(None, Some(&bytes))?;
    Ok(report)
}

/// Fills the external vocabularies of an annotation file from the vocabulary files that were imported.
pub(super) fn fill_external_vocabularies(
    job: &ImportJob<'_>,
    transcript: &mut AnnotationTranscript,
) -> CorpusResult<()> {
    for vocabulary in &mut transcript.vocabularies {
        let Some(place) = vocabulary.external.as_deref() else {
            continue;
        };
        // The file refers to it by a URL or by a path of any system, which the folder here need not match.
        let name = place.rsplit(['/', '\\']).next().unwrap_or(place);
        let mut earlier_files = job.places.files_of_same_name(name);
        let Some(row) = earlier_files.find(|row| row.kind == "ecv" && row.name == name) else {
            continue;
        };
        let Some(bytes) = stored_recordings::source_bytes(job.connection, row.id)? else {
            continue;
        };
        let read = eaf::read_vocabularies(&bytes).ok();
        let all = read.map(|(all, _)| all).unwrap_or_default();
        if let Some(found) = all.into_iter().find(|candidate| candidate.id == vocabulary.id)
            && vocabulary.entries.is_empty()
        {
            vocabulary.entries = found.entries;
        }
    }
    Ok(())
}

/// Reads a template. Its tiers are added to the recording that the caller names, otherwise to the one of the same name
/// in this folder, otherwise to all recordings of the folder that have no tiers.
pub(super) fn import_template(
    job: &mut ImportJob<'_>,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<FileReport> {
    let bytes = job.read_job_bytes()?;
    let (mut transcript, findings) =
        eaf::read_eaf(&bytes).map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    fill_external_vocabularies(job, &mut transcript)?;
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    report.findings.extend(findings.into_iter().map(ReportFinding::from));
    let named = match &job.options.into {
        Some(into) => Some(address::find_recording_by_name(job.connection, into)?.id),
        None => job.places.recording_beside_file(&job.place),
    };
    let targets = match named {
        Some(id) => vec![id],
        None => {
            let near = job.places.in_folder(&job.place);
            let mut bare = Vec::with_capacity(near.len());
            for id in near {
                if stored_tiers::load_tier_rows(job.connection, id)?.is_empty() {
                    bare.push(id);
                }
            }
            bare
        }
    };
    let (mut given, mut taken) = (Vec::new(), Vec::new());
    for id in targets {
        let name = stored_recordings::load_recording_row(job.connection, id)?.name;
        let there: BTreeSet<String> = stored_tiers::load_tier_rows(job.connection, id)?
            .into_iter()
            .map(|row| row.name)
            .collect();
        if transcript.tiers.iter().any(|tier| there.contains(&tier.name)) {
            taken.push(format!("{name:?}"));
        } else if annotations::add_transcript_tiers(job, id, &transcript, &mut report, progress)? {
            given.push(name);
        }
    }
    if !taken.is_empty() {
        report.findings.push(ReportFinding::finding_warning(
            format!("tiers of these names are there already in {}", taken.join(", ")),
            ErrorRemedy::choice_remedy(
                RemedyChoice::TiersLike,
                "annotate CORPUS add-tiers --like copies those that are missing from another recording",
            ),
        ));
    }
    if given.is_empty() {
        if job.imported_before().is_some() {
            return Ok(FileReport::unchanged_file_report(job.path, None));
        }
        let none = CorpusError::from_wrong_message("a template of tiers, and no recording next to it is without tiers")
            .with_command_advice("name the recording: import CORPUS FILE --into RECORDING");
        // A template in a folder of others may be meant for none of them; one that is named is meant.
        return match job.named && taken.is_empty() {
            true => Err(none),
            false => Ok(FileReport::skipped_file_report(job.path, &none)),
        };
    }
    let many = given.len();
    report.understood.recordings = Some(given.clone());
    report
        .findings
        .push(ReportFinding::finding_note(match given.as_slice() {
            [one] => format!("the recording {one:?} has its tiers now"),
            _ => format!("{many} recordings without tiers have its tiers now"),
        }));
    report.recording = given.into_iter().next().filter(|_| many == 1);
    job.keep_source_file(None, Some(&bytes))?;
    Ok(report)
}

/// Reads ELAN's display settings for the annotation file of the same name: order and colours of its tiers.
pub(super) fn import_settings(job: &mut ImportJob<'_>, _: &mut ProgressReceiver<'_>) -> CorpusResult<FileReport> {
    let bytes = job.read_job_bytes()?;
    let (settings, findings) = eaf::eaf_settings::read_display_settings(&bytes)
        .map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    let recording = match &job.options.into {
        Some(into) => Some(address::find_recording_by_name(job.connection, into)?.id),
        None => job.places.recording_beside_file(&job.place),
    };
    let rows = match recording {
        Some(id) => stored_tiers::load_tier_rows(job.connection, id)?,
        None => Vec::new(),
    };
    let (Some(recording), false) = (recording, rows.is_empty()) else {
        let alone = CorpusError::from_wrong_message("settings of ELAN for an annotation file that is not there")
            .with_advice("import the .eaf of the same name with it");
        return Ok(FileReport::skipped_file_report(job.path, &alone));
    };
    let mut changed = 0;
    for mut row in rows {
        let order = settings.order.iter().position(|name| *name == row.name);
        let rgb = settings.colours.get(&row.name);
        let colour = rgb.map(|[r, g, b]| format!("#{r:02x}{g:02x}{b:02x}"));
        let hidden = settings.hidden.contains(&row.name);
        if order.is_none() && colour.is_none() && !hidden {
            continue;
        }
        // A tier that was created here has no properties from a file, and gets none now.
        let Some(Ok(Value::Object(mut source))) = row.source.as_deref().map(serde_json::from_str::<Value>) else {
            continue;
        };
        source.insert(
            "shown".to_owned(),
            json!({ "order": order, "colour": colour, "hidden": hidden }),
        );
        let source = Some(Value::Object(source).to_string());
        if row.source != source {
            row.source = source;
            stored_tiers::update_tier(job.connection, &row)?;
            changed += 1;
        }
    }
    if changed == 0 && job.report_unchanged_file().is_some() {
        return Ok(FileReport::unchanged_file_report(job.path, None));
    }
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    report.recording = Some(stored_recordings::load_recording_row(job.connection, recording)?.name);
    report.findings.extend(findings.into_iter().map(ReportFinding::from));
    report.understood.tiers = Some(TiersRead::Shown(settings).into());
    job.counts.count_changed_rows("tiers", changed);
    let bytes = job.report_unchanged_file().is_none().then_some(bytes);
    if let Some(bytes) = bytes {
        job.keep_source_file(Some(recording), Some(&bytes))?;
    }
    Ok(report)
}
