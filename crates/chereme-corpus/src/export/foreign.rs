//! Exports movement as glTF and VRMA, markers as C3D and TRC, and tiers as TextGrid and ELAN tables.

use std::io::Write;
use std::ops::Range;

use chereme_formats::gltf::vrma::{self, AvatarFace, Expression};
use chereme_formats::table::annotations;
use chereme_formats::{TooFar, c3d, gltf, textgrid, trc};
use chereme_motion::{Clip, Instant, Space, Span};
use chereme_sign::Remedy;
use rusqlite::Connection;

use crate::address::Stretch;
use crate::db::recordings::RecordingRow;
use crate::db::{tiers, tracks};
use crate::error::{Error, Result};
use crate::movement::{ChannelGroup, MotionTrack};
use crate::track::{self, TrackKind};

/// Writes the movement of a stretch as GLB, in metres, with the annotations in it, and returns their number.
///
/// # Errors
/// Fails if the recording has no movement, or writing fails.
pub(super) fn glb(
    connection: &Connection,
    stretch: &Stretch,
    out: &mut dyn Write,
) -> Result<usize> {
    let track = MotionTrack::of(connection, stretch.recording.id)?;
    let frames = track.frames_of(stretch);
    let clip = track.clip(connection, frames.clone(), &ChannelGroup::ALL)?;
    let span = on_the_clock(&track, &clip, &frames);
    let about = about(connection, stretch, span)?;
    let bytes = gltf::write(&clip, &about).map_err(|error| too_far(&error))?;
    put(out, &bytes)?;
    Ok(about.notes.len())
}

/// Returns the names, the licence and the annotations of a stretch: a sign is named by its gloss, and its scene by the
/// recording and the time.
fn about(connection: &Connection, stretch: &Stretch, span: Span) -> Result<gltf::About> {
    let recording = &stretch.recording;
    let token = stretch.token.as_ref();
    let gloss = token
        .map(|token| &token.gloss)
        .filter(|gloss| !gloss.is_empty());
    Ok(gltf::About {
        name: gloss.unwrap_or(&recording.name).clone(),
        source: token.map(|_| format!("{} {}", recording.name, span.start())),
        licence: recording.licence.clone(),
        notes: notes(connection, recording.id, span)?,
    })
}

/// Returns the error for a place that does not fit into the file.
fn too_far(error: &TooFar) -> Error {
    Error::wrong(error.to_string()).advise(Remedy::command(
        "import it again with the right --unit, or write .bvh, which holds any number",
    ))
}

/// Returns the span of frames of a track on the clock of its recording.
fn on_the_clock(track: &MotionTrack, clip: &Clip, frames: &Range<usize>) -> Span {
    let own = Span::between(
        clip.rate().instant(frames.start),
        clip.rate().instant(frames.end),
    );
    own.shifted(track.row.offset_us)
}

/// Writes the movement of a stretch as VRMA, for avatars. Its face gives the presets of VRM and the gaze; each
/// non-manual is an expression, too.
///
/// # Errors
/// Fails if the recording has no movement of a humanoid, or writing fails.
pub(super) fn vrma(
    connection: &Connection,
    stretch: &Stretch,
    out: &mut dyn Write,
    notes_of_file: &mut Vec<String>,
) -> Result<()> {
    let track = MotionTrack::of(connection, stretch.recording.id)?;
    let frames = track.frames_of(stretch);
    if frames.is_empty() {
        let name = &stretch.recording.name;
        return Err(
            Error::wrong(format!("the movement of {name:?} has no frames"))
                .advise("write .bvh, which holds a skeleton that does not move")
                .lacking(),
        );
    }
    let clip = track.clip(connection, frames.clone(), &ChannelGroup::ALL)?;
    let anatomy = track.anatomy(connection)?;
    let span = on_the_clock(&track, &clip, &frames);
    let curves = crate::curves::of_track(connection, &track, frames)?;
    let mut face = AvatarFace::of(&chereme_compose::faces(&curves));
    let has = |face: &AvatarFace, name: &str| face.expressions.iter().any(|it| it.name == name);
    for curve in curves {
        if !has(&face, &curve.name) {
            face.expressions.push(Expression {
                name: curve.name,
                weights: curve.values,
            });
        }
    }
    let custom = face.expressions.iter().map(|it| it.name.as_str());
    let custom: Vec<&str> = custom
        .filter(|it| !vrma::is_preset(it) && !is_shown_by_presets(it))
        .collect();
    if !custom.is_empty() {
        notes_of_file.push(format!(
            "expressions that VRM does not define move only avatars that have them by name: {}",
            custom.join(", ")
        ));
    }
    let missing = vrma::missing(&anatomy);
    if !missing.is_empty() {
        notes_of_file.push(format!(
            "the body lacks bones that VRM requires, so some programs refuse the file: {}",
            missing.join(", ")
        ));
    }
    let about = about(connection, stretch, span)?;
    let bytes = vrma::write(&clip, &anatomy, &face, &about).map_err(|error| match error {
        vrma::WriteError::TooFar(error) => too_far(&error),
        vrma::WriteError::NoAvatar(reason) => Error::wrong(reason)
            .advise(Remedy::command(
                "say which joint is what with `chereme track`, or write .glb",
            ))
            .lacking(),
    })?;
    put(out, &bytes)
}

/// Returns whether a curve of a face moves eyelids, eyes or lips, which presets of VRM and its gaze show.
fn is_shown_by_presets(curve: &str) -> bool {
    const PARTS: [&str; 3] = ["lids", "gaze", "mouthing"];
    const NUMBERS: [&str; 5] = [
        "eye_close",
        "gaze",
        "jaw_open",
        "lips_part",
        "mouth_stretch",
    ];
    match curve.split_once('.') {
        Some(("face", number)) => NUMBERS.iter().any(|it| number.starts_with(it)),
        Some((part, _)) => PARTS.contains(&part),
        None => false,
    }
}

/// The formats of marker tracks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Points {
    C3d,
    Trc,
}

/// Writes the markers of a stretch as C3D or TRC, on the recording's clock.
///
/// # Errors
/// Fails if the recording has no markers, if these are not positions in a room, or if the file cannot be written.
pub(super) fn points(
    connection: &Connection,
    stretch: &Stretch,
    form: Points,
    out: &mut dyn Write,
    notes: &mut Vec<String>,
) -> Result<()> {
    let row = only(connection, stretch, TrackKind::Markers, notes)?;
    let span = stretch.token.as_ref().map(|_| stretch.span);
    let markers = track::read::markers(connection, &row, span)?;
    let offset = Instant::from_micros(row.offset_us.max(0));
    let is_even = markers.times().rate().is_some() || form == Points::Trc;
    let has_form = is_even && matches!(markers.space(), Space::World(_));
    let fault = |error: String| {
        let remedy = "write .markers.csv, which has its exact numbers";
        let error = Error::wrong(error).advise(remedy);
        match has_form {
            true => error,
            false => error.lacking(),
        }
    };
    if let Points::C3d = form {
        let all = tracks::tracks(connection, stretch.recording.id)?;
        let curves = all.into_iter().filter(|it| it.kind == TrackKind::Curves);
        let names: Vec<String> = curves.map(|it| it.name).collect();
        if !names.is_empty() {
            notes.push(format!(
                "the file holds markers alone, without the curves {}; .curves.csv holds those",
                names.join(", ")
            ));
        }
    }
    let bytes = match form {
        Points::C3d => c3d::write(&markers, offset).map_err(fault)?,
        Points::Trc => trc::write(&row.name, &markers, offset)
            .map_err(fault)?
            .into_bytes(),
    };
    put(out, &bytes)
}

/// Writes the curves or markers of a stretch as a table with one row for each frame.
///
/// # Errors
/// Fails if the recording has neither, or writing fails.
pub(super) fn numbers(
    connection: &Connection,
    stretch: &Stretch,
    kind: TrackKind,
    delimiter: u8,
    out: &mut dyn Write,
    notes: &mut Vec<String>,
) -> Result<()> {
    let row = only(connection, stretch, kind, notes)?;
    let span = stretch.token.as_ref().map(|_| stretch.span);
    let track = track::read::track(connection, &row, span)?;
    track::table::write(&track, delimiter, out)
}

/// Reports whether a recording has a track of that kind.
pub(super) fn has(connection: &Connection, recording: i64, kind: TrackKind) -> Result<bool> {
    Ok(tracks::tracks(connection, recording)?
        .iter()
        .any(|row| row.kind == kind))
}

/// Returns the first track of a kind; adds a note that names the others.
fn only(
    connection: &Connection,
    stretch: &Stretch,
    kind: TrackKind,
    notes: &mut Vec<String>,
) -> Result<tracks::TrackRow> {
    let mut all = tracks::tracks(connection, stretch.recording.id)?;
    all.retain(|row| row.kind == kind);
    let names: Vec<String> = all
        .iter()
        .skip(1)
        .map(|row| format!("{:?}", row.name))
        .collect();
    let first = all.into_iter().next().ok_or_else(|| {
        let name = &stretch.recording.name;
        Error::wrong(format!(
            "the recording {name:?} has no track of {}",
            kind.name()
        ))
        .advise(Remedy::command(
            "`chereme track CORPUS RECORDING` lists its tracks",
        ))
        .lacking()
    })?;
    if !names.is_empty() {
        notes.push(format!(
            "the file holds the track {:?}; not written: {}",
            first.name,
            names.join(", ")
        ));
    }
    Ok(first)
}

/// Writes the tiers of a recording as ELAN's tab-delimited text.
///
/// # Errors
/// Fails if the rows or files of the recording are damaged, or writing fails.
pub(super) fn elan_table(
    connection: &Connection,
    recording: &RecordingRow,
    out: &mut dyn Write,
) -> Result<()> {
    let transcript = super::eaf::tiers_of(connection, recording)?;
    put(out, annotations::write(&transcript).as_bytes())
}

/// Returns the annotations within a span, cut to it, in seconds from its start.
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
/// Fails if the rows or files of the recording are damaged, or writing fails.
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

/// Writes bytes.
pub(super) fn put(out: &mut dyn Write, bytes: &[u8]) -> Result<()> {
    out.write_all(bytes)
        .map_err(|error| Error::wrong(format!("the file cannot be written: {error}")))
}
