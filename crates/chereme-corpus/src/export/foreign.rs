//! Movement as glTF, tiers as TextGrid and subtitles.

use std::io::Write;

use chereme_formats::eaf::Transcript;
use chereme_formats::{gltf, subtitles, textgrid};
use chereme_motion::{Instant, Span};
use chereme_sign::TierRole;
use rusqlite::Connection;

use crate::address::Stretch;
use crate::db::recordings::RecordingRow;
use crate::db::tiers;
use crate::error::{Error, Result};
use crate::movement::{ChannelGroup, Track};

/// Writes the movement of a stretch as GLB, in metres, with the annotations that lie in it.
///
/// # Errors
/// If the recording has no movement, or writing fails.
pub(super) fn glb(connection: &Connection, stretch: &Stretch, out: &mut dyn Write) -> Result<()> {
    let track = Track::of(connection, stretch.recording.id)?;
    let frames = match stretch.token {
        Some(_) => track.frames_in(stretch.span),
        None => 0..track.frames(),
    };
    let clip = track.clip(connection, frames.clone(), &ChannelGroup::ALL)?;
    let first = clip.rate().instant(frames.start);
    let last = clip.rate().instant(frames.end);
    let name = match stretch.token {
        Some(_) => format!("{} {first}", stretch.recording.name),
        None => stretch.recording.name.clone(),
    };
    let about = gltf::About {
        name,
        licence: stretch.recording.licence.clone(),
        notes: notes(connection, stretch.recording.id, Span::between(first, last))?,
    };
    put(out, &gltf::write(&clip, &about))
}

/// Returns the annotations that lie in a span, cut to it, in seconds from its start.
fn notes(connection: &Connection, recording: i64, span: Span) -> Result<Vec<gltf::Note>> {
    let mut notes = Vec::new();
    for tier in tiers::tiers(connection, recording)? {
        for row in tiers::annotations(connection, tier.id)? {
            let own = Span::between(
                Instant::from_micros(row.start_us),
                Instant::from_micros(row.end_us),
            );
            let Some(inside) = own.intersection(span).filter(|inside| !inside.is_empty()) else {
                continue;
            };
            let seconds = |at: Instant| at.seconds() - span.start().seconds();
            notes.push(gltf::Note {
                tier: tier.name.clone(),
                begin: seconds(inside.start()),
                end: seconds(inside.end()),
                value: row.value,
            });
        }
    }
    Ok(notes)
}

/// Writes the tiers of a recording as a TextGrid in its long form.
///
/// # Errors
/// If the rows or files of the recording are damaged, or writing fails.
pub(super) fn text_grid(
    connection: &Connection,
    recording: &RecordingRow,
    out: &mut dyn Write,
    notes: &mut Vec<String>,
) -> Result<()> {
    let transcript = super::eaf::tiers_of(connection, recording)?;
    let end = Instant::from_micros(recording.duration_us);
    let (text, findings) = textgrid::write(&transcript, textgrid::Form::Long, end);
    notes.extend(findings.into_iter().map(|finding| finding.message));
    put(out, text.as_bytes())
}

/// Writes translations, or glosses if there are none, as subtitles.
///
/// # Errors
/// If the recording has neither, its rows are damaged, or writing fails.
pub(super) fn subtitles(
    connection: &Connection,
    recording: &RecordingRow,
    form: subtitles::Form,
    out: &mut dyn Write,
) -> Result<()> {
    let transcript = super::eaf::tiers_of(connection, recording)?;
    let rows = tiers::tiers(connection, recording.id)?;
    let of = |role: TierRole| {
        let names: Vec<&str> = rows
            .iter()
            .filter(|row| row.role() == role)
            .map(|row| row.name.as_str())
            .collect();
        let tiers = transcript.tiers.iter();
        let tiers = tiers.filter(|tier| names.contains(&tier.name.as_str()));
        let tiers: Vec<_> = tiers
            .cloned()
            .map(|tier| chereme_formats::eaf::convert::Tier {
                parent: None,
                ..tier
            })
            .collect();
        Some(tiers).filter(|tiers| tiers.iter().any(|tier| !tier.annotations.is_empty()))
    };
    let tiers = of(TierRole::Translation).or_else(|| of(TierRole::Gloss));
    let tiers = tiers.ok_or_else(|| {
        Error::wrong(format!(
            "the recording {:?} has neither glosses nor translations",
            recording.name
        ))
        .advise("annotate one of the two, or export .eaf or .TextGrid")
    })?;
    let shown = Transcript {
        tiers,
        ..Transcript::default()
    };
    put(out, subtitles::write(&shown, form).as_bytes())
}

fn put(out: &mut dyn Write, bytes: &[u8]) -> Result<()> {
    out.write_all(bytes)
        .map_err(|error| Error::wrong(format!("the file cannot be written: {error}")))
}
