//! Imports files that ELAN stores beside annotation files: vocabularies, tier templates, and display settings of tiers.

use std::collections::BTreeSet;

use chereme_formats::eaf;
use chereme_formats::eaf::convert::{Tier, Transcript};
use chereme_formats::roles::{self, TierName};
use chereme_sign::{Choice, Remedy};
use serde_json::{Value, json};

use super::eaf as annotations;
use super::report::ReportFinding;
use super::understood::TiersRead;
use super::{FileReport, FileStatus, Job};
use crate::address;
use crate::db::{recordings, tiers};
use crate::error::{Error, Result};
use crate::progress::Progress;

/// Reads an external vocabulary file. Vocabularies of a component become inventories; all are stored for the annotation
/// files that refer to this one.
pub(super) fn import_vocabularies(job: &mut Job<'_>, _: &mut Progress<'_>) -> Result<FileReport> {
    if let Some(report) = job.unchanged() {
        return Ok(report);
    }
    let bytes = job.bytes()?;
    let (vocabularies, findings) =
        eaf::read_vocabularies(&bytes).map_err(|error| Error::wrong(error.to_string()))?;
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    report
        .findings
        .extend(findings.into_iter().map(ReportFinding::from));
    // The name of a vocabulary indicates its component, as for a tier.
    let names: Vec<TierName<'_>> = vocabularies
        .iter()
        .map(|it| TierName {
            name: &it.id,
            ..TierName::default()
        })
        .collect();
    let guesses = roles::guess_roles(&names, &job.options.mapping);
    let transcript = Transcript {
        tiers: vocabularies
            .iter()
            .map(|it| Tier {
                name: it.id.clone(),
                vocabulary: Some(it.id.clone()),
                ..Tier::default()
            })
            .collect(),
        vocabularies,
        ..Transcript::default()
    };
    let mut others = Vec::new();
    for (tier, guess) in transcript.tiers.iter().zip(&guesses) {
        let found = annotations::tier_inventory(job, &transcript, tier, guess, &mut report)?;
        if found.is_none() {
            others.push(format!("{:?}", tier.name));
        }
    }
    if !others.is_empty() {
        report.findings.push(ReportFinding {
            remedy: Some(
                Remedy::choice(Choice::TierRoles, "import the .eaf that uses them, or give their components in a mapping file (--map)"),
            ),
            ..ReportFinding::note(format!(
                "the names of the vocabularies {} name no component: they are kept for the annotation files that use \
                 them",
                others.join(", ")
            ))
        });
    }
    job.keep(None, Some(&bytes))?;
    Ok(report)
}

/// Fills the external vocabularies of an annotation file from the vocabulary files that were imported.
pub(super) fn fill(job: &Job<'_>, transcript: &mut Transcript) -> Result<()> {
    for vocabulary in &mut transcript.vocabularies {
        let Some(place) = vocabulary.external.as_deref() else {
            continue;
        };
        let name = place.rsplit(['/', '\\']).next().unwrap_or(place);
        let mut known = job.places.namesakes(name);
        let Some(row) = known.find(|row| row.kind == "ecv" && row.name == name) else {
            continue;
        };
        let Some(bytes) = recordings::source_bytes(job.connection, row.id)? else {
            continue;
        };
        let read = eaf::read_vocabularies(&bytes).ok();
        let all = read.map(|(all, _)| all).unwrap_or_default();
        if let Some(found) = all.into_iter().find(|it| it.id == vocabulary.id)
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
    job: &mut Job<'_>,
    progress: &mut Progress<'_>,
) -> Result<FileReport> {
    let bytes = job.bytes()?;
    let (mut transcript, findings) =
        eaf::read(&bytes).map_err(|error| Error::wrong(error.to_string()))?;
    fill(job, &mut transcript)?;
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    report
        .findings
        .extend(findings.into_iter().map(ReportFinding::from));
    let named = match &job.options.into {
        Some(into) => Some(address::recording(job.connection, into)?.id),
        None => job.places.beside(&job.place),
    };
    let targets = match named {
        Some(id) => vec![id],
        None => {
            let near = job.places.in_folder(&job.place);
            let mut bare = Vec::with_capacity(near.len());
            for id in near {
                if tiers::tiers(job.connection, id)?.is_empty() {
                    bare.push(id);
                }
            }
            bare
        }
    };
    let (mut given, mut taken) = (Vec::new(), Vec::new());
    for id in targets {
        let name = recordings::recording(job.connection, id)?.name;
        let there: BTreeSet<String> = tiers::tiers(job.connection, id)?
            .into_iter()
            .map(|row| row.name)
            .collect();
        if transcript.tiers.iter().any(|it| there.contains(&it.name)) {
            taken.push(format!("{name:?}"));
        } else if annotations::add(job, id, &transcript, &mut report, progress)? {
            given.push(name);
        }
    }
    if !taken.is_empty() {
        report.findings.push(ReportFinding::warning(
            format!(
                "tiers of these names are there already in {}",
                taken.join(", ")
            ),
            Remedy::choice(Choice::TiersLike, "annotate CORPUS add-tiers --like copies those that are missing from another recording"),
        ));
    }
    if given.is_empty() {
        if job.imported_before().is_some() {
            return Ok(FileReport::unchanged(job.path, None));
        }
        let none =
            Error::wrong("a template of tiers, and no recording next to it is without tiers")
                .advise(Remedy::command(
                    "name the recording: import CORPUS FILE --into RECORDING",
                ));
        return match job.named && taken.is_empty() {
            true => Err(none),
            false => Ok(FileReport::skipped(job.path, &none)),
        };
    }
    let many = given.len();
    report.understood.recordings = Some(given.clone());
    report
        .findings
        .push(ReportFinding::note(match given.as_slice() {
            [one] => format!("the recording {one:?} has its tiers now"),
            _ => format!("{many} recordings without tiers have its tiers now"),
        }));
    report.recording = given.into_iter().next().filter(|_| many == 1);
    job.keep(None, Some(&bytes))?;
    Ok(report)
}

/// Reads ELAN's display settings for the annotation file of the same name: order and colours of its tiers.
pub(super) fn import_settings(job: &mut Job<'_>, _: &mut Progress<'_>) -> Result<FileReport> {
    let bytes = job.bytes()?;
    let (settings, findings) =
        eaf::settings::read(&bytes).map_err(|error| Error::wrong(error.to_string()))?;
    let recording = match &job.options.into {
        Some(into) => Some(address::recording(job.connection, into)?.id),
        None => job.places.beside(&job.place),
    };
    let rows = match recording {
        Some(id) => tiers::tiers(job.connection, id)?,
        None => Vec::new(),
    };
    let (Some(recording), false) = (recording, rows.is_empty()) else {
        let alone = Error::wrong("settings of ELAN for an annotation file that is not there")
            .advise("import the .eaf of the same name with it");
        return Ok(FileReport::skipped(job.path, &alone));
    };
    let mut changed = 0;
    for mut row in rows {
        let order = settings.order.iter().position(|name| *name == row.name);
        let colour = settings.colours.get(&row.name);
        let colour = colour.map(|[r, g, b]| format!("#{r:02x}{g:02x}{b:02x}"));
        let hidden = settings.hidden.contains(&row.name);
        if order.is_none() && colour.is_none() && !hidden {
            continue;
        }
        // A tier that was created here has no properties from a file, and gets none now.
        let Some(Ok(Value::Object(mut source))) =
            row.source.as_deref().map(serde_json::from_str::<Value>)
        else {
            continue;
        };
        source.insert(
            "shown".to_owned(),
            json!({ "order": order, "colour": colour, "hidden": hidden }),
        );
        let source = Some(Value::Object(source).to_string());
        if row.source != source {
            row.source = source;
            tiers::update_tier(job.connection, &row)?;
            changed += 1;
        }
    }
    if changed == 0 && job.unchanged().is_some() {
        return Ok(FileReport::unchanged(job.path, None));
    }
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    report.recording = Some(recordings::recording(job.connection, recording)?.name);
    report
        .findings
        .extend(findings.into_iter().map(ReportFinding::from));
    report.understood.tiers = Some(TiersRead::Shown(settings).into());
    job.counts.changed("tiers", changed);
    let bytes = job.unchanged().is_none().then_some(bytes);
    if let Some(bytes) = bytes {
        job.keep(Some(recording), Some(&bytes))?;
    }
    Ok(report)
}
