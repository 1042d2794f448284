//! Exports translations or glosses as subtitles: one language a file.

use std::io::Write;

use chereme_formats::eaf::Transcript;
use chereme_formats::eaf::convert::Tier;
use chereme_formats::subtitles::{self, Form};
use chereme_sign::{Remedy, TierRole};
use rusqlite::Connection;

use super::foreign::put;
use crate::db::recordings::RecordingRow;
use crate::db::tiers::{self, TierRow};
use crate::error::{Error, Result};

/// Returns the tiers of a recording that become subtitles: its translations, or its glosses if no translation has an
/// annotation. Each group is a file of its own: in a group no two tiers are of the same person and hand, or of different
/// languages.
pub(super) fn groups(connection: &Connection, recording: i64) -> Result<Vec<Vec<TierRow>>> {
    let rows = tiers::tiers(connection, recording)?;
    let mut groups: Vec<Vec<TierRow>> = Vec::new();
    let roles: [&dyn Fn(&TierRow) -> bool; 3] = [
        &|row| row.role == TierRole::Translation,
        &|row| row.role == TierRole::Gloss,
        // Imported subtitles, whose file does not say whether they translate.
        &|row| row.name == subtitles::TIER,
    ];
    for is_shown in roles {
        for row in rows.iter().filter(|row| is_shown(row)) {
            if tiers::annotations(connection, row.id)?.is_empty() {
                continue;
            }
            let fits = |group: &&mut Vec<TierRow>| group.iter().all(|it| go_together(it, row));
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
    connection: &Connection,
    recording: &RecordingRow,
    form: Form,
    out: &mut dyn Write,
    notes: &mut Vec<String>,
) -> Result<()> {
    let groups = groups(connection, recording.id)?;
    let name = &recording.name;
    let Some((first, others)) = groups.split_first() else {
        return Err(Error::wrong(format!(
            "the recording {name:?} has neither glosses nor translations"
        ))
        .advise("annotate one of the two, or export .eaf or .TextGrid")
        .lacking());
    };
    if !others.is_empty() {
        let listed = |row: &TierRow| format!("{:?} (tier:{})", row.name, row.id);
        let list = |rows: &mut dyn Iterator<Item = &TierRow>| {
            rows.map(listed).collect::<Vec<_>>().join(", ")
        };
        notes.push(format!(
            "the subtitles hold the tier {}; not written: {}, each of which can be exported by its number",
            list(&mut first.iter()),
            list(&mut others.iter().flatten())
        ));
    }
    write(connection, recording, first, form, out)
}

/// Writes one tier of any role.
///
/// # Errors
/// Fails if there is no such tier, it has no annotations, its rows are damaged, or writing fails.
pub(super) fn tier(
    connection: &Connection,
    tier: i64,
    form: Form,
    out: &mut dyn Write,
) -> Result<()> {
    let row = tiers::tier(connection, tier)?;
    if tiers::annotations(connection, row.id)?.is_empty() {
        return Err(
            Error::wrong(format!("the tier {:?} has no annotations", row.name))
                .advise(Remedy::command("`chereme list CORPUS tiers` counts them"))
                .lacking(),
        );
    }
    let recording = crate::db::recordings::recording(connection, row.recording_id)?;
    write(connection, &recording, &[row], form, out)
}

/// Writes tiers of a recording.
pub(super) fn write(
    connection: &Connection,
    recording: &RecordingRow,
    rows: &[TierRow],
    form: Form,
    out: &mut dyn Write,
) -> Result<()> {
    let transcript = super::eaf::tiers_of(connection, recording)?;
    let is_chosen = |tier: &Tier| rows.iter().any(|row| row.name == tier.name);
    let tiers = transcript.tiers.into_iter().filter(is_chosen);
    let shown = Transcript {
        tiers: tiers
            .map(|tier| Tier {
                parent: None,
                ..tier
            })
            .collect(),
        ..Transcript::default()
    };
    put(out, subtitles::write(&shown, form).as_bytes())
}
