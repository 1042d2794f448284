//! Performs a recording that has only a face as movement of the program's own body, whose head turns as in the capture.

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_compose::{GeneratedCurve, MovementMaterial};
use chereme_formats::faces::FaceSystem;
use chereme_motion::glam::DQuat;
use chereme_motion::{BodyPart, Clip, FrameRate, JointChannel, RecordingInstant, TimeSpan};
use chereme_sign::SignerHandedness;
use rusqlite::Connection;
use sha2::{Digest, Sha256};

use super::face_captured::load_captured_face;
use super::face_head;
use crate::address::{CorpusAddress, RecordingStretch, RowName};
use crate::db::stored_contents;
use crate::db::stored_motion;
use crate::db::stored_recordings;
use crate::db::stored_rows::ShownFrames;
use crate::error::{CorpusError, CorpusResult};
use crate::starter::own_body;

/// The rate for a capture whose frames have individual times.
const DEFAULT_STAGE_RATE_FPS: u32 = 60;
/// The most frames that are performed at once.
const MAX_STAGED_FRAMES: usize = 300_000;

/// Returns a stretch of a recording without a skeleton as movement, with the curves of its face; `None` if it has no
/// captured face.
pub(crate) fn load_face_material(
    connection: &Connection,
    stretch: &RecordingStretch,
) -> CorpusResult<Option<MovementMaterial>> {
    let recording = &stretch.recording;
    let Some(face) = load_captured_face(connection, recording.id, None)? else {
        return Ok(None);
    };
    let known_rate = face
        .times
        .even_times_rate()
        .or(FrameRate::new(DEFAULT_STAGE_RATE_FPS, 1).ok());
    let rate = known_rate.ok_or_else(|| CorpusError::from_wrong_message("the face has no rate"))?;
    let mut frames = rate.frames_in(stretch.span.shifted_span(-face.row.offset_us));
    frames.end = frames.end.min(
        rate.nearest_frame_at(
            face.row
                .track_clock_span()
                .span_end_instant()
                .shifted_instant(-face.row.offset_us),
        ) + 1,
    );
    let frames = frames.start.min(frames.end)..frames.end;
    if frames.len() > MAX_STAGED_FRAMES {
        let minutes = frames.len() as f64 / rate.per_second() / 60.0;
        return Err(CorpusError::from_wrong_message(format!(
            "{:?} is a face of {minutes:.0} min, too long to be performed at once",
            recording.name
        ))
        .with_error_place(&recording.name)
        .with_advice("annotate the part on a gloss tier and name its token"));
    }
    let moment = |frame: usize| rate.frame_start_instant(frame).shifted_instant(face.row.offset_us);
    let body = own_body()?;
    let mut channels = body.clip.joint_channels().to_vec();
    for channel in &mut channels {
        // The body stands in its first pose throughout; trunk and head are turned below.
        channel.rotations = vec![channel.rotations[0]; frames.len()];
        if let Some(places) = &mut channel.translations {
            *places = vec![places[0]; frames.len()];
        }
    }
    let trunk = trunk_of(&body);
    let leaning = |frame: usize| trunk.and_then(|_| face.trunk_at(moment(frame)));
    let leans = frames.clone().map(|frame| (leaning(frame), DQuat::IDENTITY));
    turn_body_joint(&mut channels, &body, trunk, leans);
    let turns = frames.clone().map(|frame| {
        // The head turns on a trunk that leans already, so that its own turn is not counted twice.
        let below = leaning(frame).map_or(DQuat::IDENTITY, face_head::rotation_from_angles);
        (face.blended_face_at(moment(frame)).1, below)
    });
    turn_body_joint(&mut channels, &body, body.anatomy.part_joint(BodyPart::Head), turns);
    let clip_result = Clip::new(Arc::clone(body.clip.clip_skeleton()), rate, channels);
    let clip = clip_result.map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    let curves: Vec<GeneratedCurve> = face.sample_capture_curves(frames.clone().map(moment));
    let signer = recording
        .signer_id
        .map(|id| stored_recordings::find_signer_row(connection, id))
        .transpose()?
        .flatten();
    let left = signer
        .as_ref()
        .is_some_and(|row| row.handedness.as_deref() == Some("left"));
    let (address, gloss) = match &stretch.token {
        Some(token) => (format!("token:{}", token.id), token.gloss.clone()),
        None => (format!("recording:{}", recording.id), recording.name.clone()),
    };
    // Whatever the movement depends on is in its hash, so that a new fit or mapping gives another one.
    let name = format!(
        "face {} {frames:?} {} {} {} {:?}",
        stored_motion::track_hash(connection, face.row.id)?,
        face.row.offset_us,
        face.view.system.id,
        face.view.system.version,
        face.fitted
    );
    Ok(Some(MovementMaterial {
        address,
        hash: stored_motion::to_hex_text(&Sha256::digest(name.as_bytes())),
        gloss,
        signer: signer.map(|row| CorpusAddress::Signer(RowName::Text(row.name)).to_string()),
        handedness: if left {
            SignerHandedness::Left
        } else {
            SignerHandedness::Right
        },
        clip,
        anatomy: body.anatomy,
        held: Vec::new(),
        curves,
    }))
}

/// Returns the joint that bends the trunk: the lowest one above the hips.
fn trunk_of(body: &MovementMaterial) -> Option<usize> {
    [BodyPart::Spine, BodyPart::Chest]
        .into_iter()
        .find_map(|part| body.anatomy.part_joint(part))
        .filter(|joint| Some(*joint) != body.anatomy.part_joint(BodyPart::Hips))
}

/// Rotates a joint of the body in model space in each frame, on top of the rotation of a joint below it.
fn turn_body_joint(
    channels: &mut [JointChannel],
    body: &MovementMaterial,
    joint: Option<usize>,
    turns: impl Iterator<Item = (Option<[f64; 3]>, DQuat)>,
) {
    let Some(joint) = joint else { return };
    let pose = body.clip.model_pose(0);
    let parent = body.clip.clip_skeleton().joint_parent(joint);
    let above = parent.map_or(DQuat::IDENTITY, |parent| pose.model_joint_rotation(parent));
    for (rotation, (turned, below)) in channels[joint].rotations.iter_mut().zip(turns) {
        if let Some(turned) = turned {
            let head_rotation = face_head::rotation_from_angles(turned) * pose.model_joint_rotation(joint);
            // A stored rotation is relative to the parent, whose own turn is taken out.
            *rotation = ((below * above).inverse() * head_rotation).normalize();
        }
    }
}

/// Returns the frames of captured faces of recordings without a skeleton, by recording.
pub(crate) fn shown_alone(connection: &Connection) -> CorpusResult<BTreeMap<i64, ShownFrames>> {
    // Many recordings have the same channels.
    let mut faces_by_name: BTreeMap<String, bool> = BTreeMap::new();
    let mut all = BTreeMap::new();
    for row in stored_contents::curves_alone(connection)? {
        let is_face = *faces_by_name
            .entry(row.names)
            .or_insert_with_key(|names| FaceSystem::of_names(names.lines()).is_some_and(|system| !system.expressions));
        let Some(rate) = row
            .rate
            .or(FrameRate::new(DEFAULT_STAGE_RATE_FPS, 1).ok())
            .filter(|_| is_face)
        else {
            continue;
        };
        let lasts = RecordingInstant::from_micros(row.duration_us).shifted_instant(-row.offset_us);
        let frames = match row.rate {
            Some(_) => row.frames,
            None => rate.nearest_frame_at(lasts) as u64,
        };
        if frames > 0 && frames <= MAX_STAGED_FRAMES as u64 {
            all.entry(row.recording).or_insert(ShownFrames {
                frames,
                rows: row.frames,
                rate,
                offset_us: row.offset_us,
            });
        }
    }
    Ok(all)
}

/// Returns the time of the first frame of a recording's movement within `span`, in microseconds on its clock: a frame
/// of its skeleton, otherwise one of its face; 0 if it has neither.
pub(crate) fn first_frame(connection: &Connection, recording: i64, span: TimeSpan) -> CorpusResult<i64> {
    if stored_recordings::body_track(connection, recording)?.is_some() {
        let track = crate::movement::MotionTrack::open_motion_track(connection, recording)?;
        let frames = track.frames_in(span);
        return Ok(track
            .rate
            .frame_start_instant(frames.start)
            .instant_micros()
            .saturating_add(track.row.offset_us));
    }
    let Some(face) = load_captured_face(connection, recording, None)? else {
        return Ok(0);
    };
    let rate = face
        .times
        .even_times_rate()
        .or(FrameRate::new(DEFAULT_STAGE_RATE_FPS, 1).ok());
    Ok(rate.map_or(0, |rate| {
        let frames = rate.frames_in(span.shifted_span(-face.row.offset_us));
        rate.frame_start_instant(frames.start)
            .instant_micros()
            .saturating_add(face.row.offset_us)
    }))
}
