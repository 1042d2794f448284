//! Exports movement as glTF and VRMA, markers as C3D and TRC, and tiers as TextGrid and ELAN tables.

use std::io::Write;
use std::ops::Range;

use chereme_formats::curves::write_live_link_csv;
use chereme_formats::faces::FaceSystem;
use chereme_formats::gltf::vrma::{self, AvatarFace, ExpressionTrack};
use chereme_formats::table::annotations;
use chereme_formats::{TooFar, c3d, gltf, textgrid, trc, xra};
use chereme_motion::{MarkerSpace, RecordingInstant, TimeSpan};
use rusqlite::Connection;

use super::ExportJob;
use super::glb_figure;
use super::movement_form::{MovementForm, ShapedMovement};
use crate::address::RecordingStretch;
use crate::curves::face_captured;
use crate::db::stored_recordings::RecordingRow;
use crate::db::{stored_tiers, stored_tracks};
use crate::error::{CorpusError, CorpusResult};
use crate::movement::MotionTrack;
use crate::track::{self, TrackKind};

/// The look of the movement in a GLB.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum GlbLook {
    /// The person that pictures draw; bones if the skeleton is no person.
    Person,
    Bones,
}

/// Writes the movement of a stretch as GLB, in metres, with the annotations in it, and returns their number.
///
/// # Errors
/// Fails if the recording has no movement, or writing fails.
pub(super) fn write_glb_stretch(
    job: &mut ExportJob<'_, '_>,
    stretch: &RecordingStretch,
    (look, form): (GlbLook, &MovementForm),
) -> CorpusResult<usize> {
    let track = MotionTrack::open_motion_track(job.connection, stretch.recording.id)?;
    let frames = track.stretch_frames(stretch);
    let movement = form.load_shaped_movement(job.connection, &track, frames.clone(), job.notes)?;
    let about = describe_gltf_stretch(job, stretch, on_the_clock(&track, &frames))?;
    let ShapedMovement { clip, anatomy, curves } = &movement;
    let figure = match look {
        GlbLook::Person => glb_figure::visible_figure(clip, anatomy, curves),
        GlbLook::Bones => None,
    };
    let bytes = gltf::write_glb_with_figure(clip, &about, figure.as_ref()).map_err(|error| too_far(&error))?;
    write_export_bytes(job.out, &bytes)?;
    Ok(about.notes.len())
}

/// Returns the names, the licence and the annotations of a stretch: a sign is named by its gloss, and its scene by the
/// recording and the time.
fn describe_gltf_stretch(
    job: &ExportJob<'_, '_>,
    stretch: &RecordingStretch,
    span: TimeSpan,
) -> CorpusResult<gltf::GlbDescription> {
    let recording = &stretch.recording;
    let token = stretch.token.as_ref();
    let gloss = token.map(|token| &token.gloss).filter(|gloss| !gloss.is_empty());
    Ok(gltf::GlbDescription {
        name: gloss.unwrap_or(&recording.name).clone(),
        source: token.map(|_| format!("{} {}", recording.name, span.span_start_instant())),
        licence: job.gate.terms_in_file(recording),
        notes: gltf_notes_in_span(job.connection, recording.id, span)?,
    })
}

/// Returns the error for a place that does not fit into the file.
pub(super) fn too_far(error: &TooFar) -> CorpusError {
    CorpusError::from_wrong_message(error.to_string())
        .with_command_advice("import it again with the right --unit, or write .bvh, which holds any number")
}

/// Returns the span of frames of a track on the clock of its recording.
fn on_the_clock(track: &MotionTrack, frames: &Range<usize>) -> TimeSpan {
    track
        .rate
        .frame_range_span(frames.clone())
        .shifted_span(track.row.offset_us)
}

/// Writes the movement of a stretch as VRMA, for avatars. Its face gives the presets of VRM and the gaze; each
/// non-manual is an expression, too.
///
/// # Errors
/// Fails if the recording has no movement of a humanoid, or writing fails.
pub(super) fn write_vrma_stretch(
    job: &mut ExportJob<'_, '_>,
    stretch: &RecordingStretch,
    form: &MovementForm,
) -> CorpusResult<()> {
    let track = MotionTrack::open_motion_track(job.connection, stretch.recording.id)?;
    let frames = track.stretch_frames(stretch);
    // An animation without frames is no valid file.
    if frames.is_empty() {
        let name = &stretch.recording.name;
        return Err(
            CorpusError::from_wrong_message(format!("the movement of {name:?} has no frames"))
                .with_advice("write .bvh, which holds a skeleton that does not move")
                .into_lacking_content(),
        );
    }
    let span = on_the_clock(&track, &frames);
    let movement = form.load_shaped_movement(job.connection, &track, frames, job.notes)?;
    let ShapedMovement { clip, anatomy, curves } = movement;
    let mut face = AvatarFace::avatar_face_from_faces(&chereme_compose::faces_from_curves(&curves));
    let has = |face: &AvatarFace, name: &str| face.expressions.iter().any(|expression| expression.name == name);
    for curve in curves {
        // The presets already hold what some curves show, and a name may stand only once.
        if !has(&face, &curve.name) {
            face.expressions.push(ExpressionTrack {
                name: curve.name,
                weights: curve.values,
            });
        }
    }
    let expression_names = face.expressions.iter().map(|expression| expression.name.as_str());
    let custom: Vec<&str> = expression_names
        .filter(|name| !vrma::is_preset(name) && !is_shown_by_presets(name))
        .collect();
    if !custom.is_empty() {
        job.notes.push(format!(
            "expressions that VRM does not define move only avatars that have them by name: {}",
            custom.join(", ")
        ));
    }
    let missing = vrma::missing_vrm_bones(&anatomy);
    if !missing.is_empty() {
        job.notes.push(format!(
            "the body lacks bones that VRM requires, so some programs refuse the file: {}",
            missing.join(", ")
        ));
    }
    let about = describe_gltf_stretch(job, stretch, span)?;
    let bytes = vrma::write_vrma(&clip, &anatomy, &face, &about).map_err(|error| match error {
        vrma::VrmaWriteError::TooFar(error) => too_far(&error),
        vrma::VrmaWriteError::NoAvatar(reason) => CorpusError::from_wrong_message(reason)
            .with_command_advice("say which joint is what with `chereme track`, or write .glb")
            .into_lacking_content(),
    })?;
    write_export_bytes(job.out, &bytes)
}

/// Returns whether a curve of a face moves eyelids, eyes or lips, which presets of VRM and its gaze show.
fn is_shown_by_presets(curve: &str) -> bool {
    const PRESET_FACE_PARTS: [&str; 3] = ["lids", "gaze", "mouthing"];
    const PRESET_FACE_NUMBERS: [&str; 5] = ["eye_close", "gaze", "jaw_open", "lips_part", "mouth_stretch"];
    match curve.split_once('.') {
        Some(("face", number)) => PRESET_FACE_NUMBERS.iter().any(|prefix| number.starts_with(prefix)),
        Some((part, _)) => PRESET_FACE_PARTS.contains(&part),
        None => false,
    }
}

/// The formats of marker tracks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MarkerFileFormat {
    C3d,
    Trc,
}

/// Writes the markers of a stretch as C3D or TRC, on the recording's clock.
///
/// # Errors
/// Fails if the recording has no markers, if these are not positions in a room, or if the file cannot be written.
pub(super) fn write_marker_file(
    job: &mut ExportJob<'_, '_>,
    stretch: &RecordingStretch,
    form: MarkerFileFormat,
) -> CorpusResult<()> {
    let row = first_track_of_kind(job, stretch, TrackKind::Markers)?;
    let span = stretch.token.as_ref().map(|_| stretch.span);
    let markers = track::track_read::read_track_markers(job.connection, &row, span)?;
    // These formats cannot begin before the first frame of their clock.
    let offset = RecordingInstant::from_micros(row.offset_us.max(0));
    // A C3D file has one rate for all frames, while TRC has a time for each.
    let is_even = markers.marker_times().even_times_rate().is_some() || form == MarkerFileFormat::Trc;
    let has_form = is_even && matches!(markers.marker_space(), MarkerSpace::World(_));
    let fault = |error: String| {
        let remedy = "write .markers.csv, which has its exact numbers";
        let error = CorpusError::from_wrong_message(error).with_advice(remedy);
        match has_form {
            true => error,
            false => error.into_lacking_content(),
        }
    };
    if let MarkerFileFormat::C3d = form {
        let all = stored_tracks::load_track_rows(job.connection, stretch.recording.id)?;
        let curves = all.into_iter().filter(|track| track.kind == TrackKind::Curves);
        let names: Vec<String> = curves.map(|track| track.name).collect();
        if !names.is_empty() {
            job.notes.push(format!(
                "the file holds markers alone, without the curves {}; .curves.csv holds those",
                names.join(", ")
            ));
        }
    }
    let bytes = match form {
        MarkerFileFormat::C3d => c3d::write_c3d(&markers, offset).map_err(fault)?,
        MarkerFileFormat::Trc => trc::write_trc_file(&row.name, &markers, offset)
            .map_err(fault)?
            .into_bytes(),
    };
    write_export_bytes(job.out, &bytes)
}

/// Writes the curves or markers of a stretch as a table with one row for each frame.
///
/// # Errors
/// Fails if the recording has neither, or writing fails.
pub(super) fn write_number_table(
    job: &mut ExportJob<'_, '_>,
    stretch: &RecordingStretch,
    kind: TrackKind,
    delimiter: u8,
) -> CorpusResult<()> {
    let row = first_track_of_kind(job, stretch, kind)?;
    let span = stretch.token.as_ref().map(|_| stretch.span);
    let track = track::track_read::read_stored_track(job.connection, &row, span)?;
    track::track_table::write_track_table(&track, delimiter, job.out)
}

/// Writes the captured face of a stretch as Live Link Face does, with the time of day of its frames.
///
/// # Errors
/// Fails if the recording has no face in ARKit's shapes, or writing fails.
pub(super) fn write_live_link_file(job: &mut ExportJob<'_, '_>, stretch: &RecordingStretch) -> CorpusResult<()> {
    let span = stretch.token.as_ref().map(|_| stretch.span);
    let has_shapes = FaceSystem::has_live_link_shapes;
    let channels = face_captured::load_face_channels(job.connection, stretch.recording.id, span, has_shapes)?;
    let written = channels.and_then(|channels| {
        let time_of_day = channels.row.clock_us;
        let begin = RecordingInstant::from_micros(time_of_day.unwrap_or(channels.row.offset_us));
        let (text, findings) = write_live_link_csv(&channels.curves, begin)?;
        Some((text, findings, time_of_day.is_some()))
    });
    let Some((text, findings, has_time_of_day)) = written else {
        let name = &stretch.recording.name;
        return Err(CorpusError::from_wrong_message(format!(
            "the recording {name:?} has no face in the shapes of ARKit, which Live Link Face has columns for"
        ))
        .with_advice("write .curves.csv, which holds the numbers of any face")
        .into_lacking_content());
    };
    if !has_time_of_day {
        job.notes
            .push("the time of day is not known: timecodes count from the start of the recording".to_owned());
    }
    job.notes.extend(findings.into_iter().map(|finding| finding.message));
    write_export_bytes(job.out, text.as_bytes())
}

/// Reports whether a recording has a track of that kind.
pub(super) fn has_track_kind(connection: &Connection, recording: i64, kind: TrackKind) -> CorpusResult<bool> {
    Ok(stored_tracks::load_track_rows(connection, recording)?
        .iter()
        .any(|row| row.kind == kind))
}

/// Returns the first track of a kind; adds a note that names the others.
fn first_track_of_kind(
    job: &mut ExportJob<'_, '_>,
    stretch: &RecordingStretch,
    kind: TrackKind,
) -> CorpusResult<stored_tracks::TrackRow> {
    let mut all = stored_tracks::load_track_rows(job.connection, stretch.recording.id)?;
    all.retain(|row| row.kind == kind);
    let names: Vec<String> = all.iter().skip(1).map(|row| format!("{:?}", row.name)).collect();
    let first = all.into_iter().next().ok_or_else(|| {
        let name = &stretch.recording.name;
        CorpusError::from_wrong_message(format!(
            "the recording {name:?} has no track of {}",
            kind.track_kind_name()
        ))
        .with_command_advice("`chereme track CORPUS RECORDING` lists its tracks")
        .into_lacking_content()
    })?;
    if !names.is_empty() {
        job.notes.push(format!(
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
pub(super) fn elan_table(job: &mut ExportJob<'_, '_>, recording: &RecordingRow) -> CorpusResult<()> {
    let transcript = super::export_eaf::tiers_of(job.connection, recording)?;
    write_export_bytes(job.out, annotations::write_elan_table(&transcript).as_bytes())
}

/// Returns the annotations within a span, cut to it, in seconds from its start.
fn gltf_notes_in_span(
    connection: &Connection,
    recording: i64,
    span: TimeSpan,
) -> CorpusResult<Vec<gltf::MovementNote>> {
    let mut notes = Vec::new();
    for tier in stored_tiers::load_tier_rows(connection, recording)? {
        for row in stored_tiers::load_tier_annotation_rows(connection, tier.id)? {
            let row_span = row.annotation_row_span();
            let Some(inside) = row_span.span_intersection(span).filter(|inside| !inside.is_empty()) else {
                continue;
            };
            let seconds = |at: RecordingInstant| at.instant_seconds() - span.span_start_instant().instant_seconds();
            notes.push(gltf::MovementNote {
                tier: tier.name.clone(),
                begin: seconds(inside.span_start_instant()),
                end: seconds(inside.span_end_instant()),
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
pub(super) fn text_grid(job: &mut ExportJob<'_, '_>, recording: &RecordingRow) -> CorpusResult<()> {
    let transcript = super::export_eaf::tiers_of(job.connection, recording)?;
    let end = RecordingInstant::from_micros(recording.duration_us);
    let (text, findings) = textgrid::write_textgrid(&transcript, textgrid::TextGridForm::Long, end);
    job.notes.extend(findings.into_iter().map(|finding| finding.message));
    write_export_bytes(job.out, text.as_bytes())
}

/// Writes the tiers of a recording as SPPAS reads them.
///
/// # Errors
/// Fails if the rows or files of the recording are damaged, or writing fails.
pub(super) fn write_xra_file(job: &mut ExportJob<'_, '_>, recording: &RecordingRow) -> CorpusResult<()> {
    let transcript = super::export_eaf::tiers_of(job.connection, recording)?;
    write_export_bytes(job.out, xra::write_xra(&transcript, &recording.name).as_bytes())
}

/// Writes bytes.
pub(super) fn write_export_bytes(out: &mut dyn Write, bytes: &[u8]) -> CorpusResult<()> {
    out.write_all(bytes)
        .map_err(|error| CorpusError::from_wrong_message(format!("the file cannot be written: {error}")))
}
