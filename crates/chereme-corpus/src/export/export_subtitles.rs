//! Exports translations or glosses as subtitles: one language a file.

use chereme_formats::eaf::AnnotationTranscript;
use chereme_formats::eaf::eaf_convert::TranscriptTier;
use chereme_formats::subtitles::{self, SubtitleFormat};
use chereme_sign::TierRole;
use rusqlite::Connection;

use super::ExportJob;
use super::foreign::write_export_bytes;
use crate::db::stored_recordings::RecordingRow;
use crate::db::stored_tiers::{self, TierRow};
use crate::error::{CorpusError, CorpusResult};

/// Returns the tiers of a recording that become subtitles: its translations, or its glosses if no translation has an
/// annotation. Each group is a file of its own: in a group no two tiers are of the same person and hand, or of different
/// languages.
pub(super) fn subtitle_tier_groups(connection: &Connection, recording: i64) -> CorpusResult<Vec<Vec<TierRow>>> {
    let rows = stored_tiers::load_tier_rows(connection, recording)?;
    let mut groups: Vec<Vec<TierRow>> = Vec::new();
    let roles: [&dyn Fn(&TierRow) -> bool; 3] = [
        &|row| row.role == TierRole::Translation,
        &TierRow::holds_glosses,
        // Imported subtitles, whose file does not say whether they translate.
        &|row| row.name == subtitles::VOICELESS_TIER_NAME,
    ];
    for is_shown in roles {
        for row in rows.iter().filter(|row| is_shown(row)) {
            if stored_tiers::load_tier_annotation_rows(connection, row.id)?.is_empty() {
                continue;
            }
            let fits = |group: &&mut Vec<TierRow>| group.iter().all(|tier| go_together(tier, row));
            match groups.iter_mut().find(fits) {
                Some(group) => group.push(row.clone()),
                None => groups.push(vec![row.clone()]),
            }
        }
        if !groups.is_empty() {
            break;
        }
    }
    Ok(groups)
}

fn go_together(one: &TierRow, other: &TierRow) -> bool {
    let same_language = match (&one.language, &other.language) {
        (Some(one), Some(other)) => one == other,
        _ => true,
    };
    same_language && (&one.participant, one.hand) != (&other.participant, other.hand)
}

/// Writes the first group of tiers, and adds a note that names the others.
///
/// # Errors
/// Fails if the recording has neither translations nor glosses, its rows are damaged, or writing fails.
pub(super) fn first_group(
    job: &mut ExportJob<'_, '_>,
    recording: &RecordingRow,
    form: SubtitleFormat,
) -> CorpusResult<()> {
    let groups = subtitle_tier_groups(job.connection, recording.id)?;
    let name = &recording.name;
    let Some((first, others)) = groups.split_first() else {
        return Err(CorpusError::from_wrong_message(format!(
            "the recording {name:?} has neither glosses nor translations"
        ))
        .with_advice("annotate one of the two, or export .eaf or .TextGrid")
        .into_lacking_content());
    };
    if !others.is_empty() {
        let listed = |row: &TierRow| format!("{:?} (tier:{})", row.name, row.id);
        let list = |rows: &mut dyn Iterator<Item = &TierRow>| rows.map(listed).collect::<Vec<_>>().join(", ");
        job.notes.push(format!(
            "the subtitles hold the tier {}; not written: {}, each of which can be exported by its number",
            list(&mut first.iter()),
            list(&mut others.iter().flatten())
        ));
    }
    write_recording_subtitles(job, recording, first, form)
}

/// Writes one tier of any role.
///
/// # Errors
/// Fails if there is no such tier, it has no annotations, its rows are damaged, or writing fails.
pub(super) fn write_tier_subtitles(job: &mut ExportJob<'_, '_>, tier: i64, form: SubtitleFormat) -> CorpusResult<()> {
    let connection = job.connection;
    let row = stored_tiers::load_tier_row(connection, tier)?;
    if stored_tiers::load_tier_annotation_rows(connection, row.id)?.is_empty() {
        return Err(
            CorpusError::from_wrong_message(format!("the tier {:?} has no annotations", row.name))
                .with_command_advice("`chereme list CORPUS tiers` counts them")
                .into_lacking_content(),
        );
    }
    let recording = crate::db::stored_recordings::load_recording_row(connection, row.recording_id)?;
    write_recording_subtitles(job, &recording, &[row], form)
}

/// Writes tiers of a recording.
pub(super) fn write_recording_subtitles(
    job: &mut ExportJob<'_, '_>,
    recording: &RecordingRow,
    rows: &[TierRow],
    form: SubtitleFormat,
) -> CorpusResult<()> {
    let transcript = super::export_eaf::tiers_of(job.connection, recording)?;
    let is_chosen = |tier: &TranscriptTier| rows.iter().any(|row| row.name == tier.name);
    let tiers = transcript.tiers.into_iter().filter(is_chosen);
    let shown = AnnotationTranscript {
        // The parents may not be among the chosen tiers, and subtitles do not need them.
        tiers: tiers.map(|tier| TranscriptTier { parent: None, ..tier }).collect(),
        ..AnnotationTranscript::default()
    };
    write_export_bytes(job.out, subtitles::write_subtitles(&shown, form).as_bytes())
}
