//! Performs a recording that has only a face as movement of the program's own body, whose head turns as in the capture.

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_compose::{Curve, Material};
use chereme_formats::faces::System as FaceSystem;
use chereme_motion::glam::DQuat;
use chereme_motion::{Channel, Clip, Instant, Part, Rate, Span};
use chereme_sign::Handedness;
use rusqlite::Connection;
use sha2::{Digest, Sha256};

use super::{captured, head};
use crate::address::{Address, Name, Stretch};
use crate::db::contents;
use crate::db::motion;
use crate::db::recordings;
use crate::db::rows::ShownFrames;
use crate::error::{Error, Result};
use crate::picture::Moving;
use crate::sources::notation::own_body;

/// The rate for a capture whose frames have individual times.
const USUAL: u32 = 60;
/// The most frames that are performed at once.
const LONGEST: usize = 300_000;

/// Returns a stretch of a recording without a skeleton as movement, with the curves of its face; `None` if it has no
/// captured face.
pub(crate) fn material(connection: &Connection, stretch: &Stretch) -> Result<Option<Material>> {
    let recording = &stretch.recording;
    let Some(face) = captured(connection, recording.id, None)? else {
        return Ok(None);
    };
    let rate = face.times.rate().or(Rate::new(USUAL, 1).ok());
    let rate = rate.ok_or_else(|| Error::wrong("the face has no rate"))?;
    let mut frames = rate.frames_in(stretch.span.shifted(-face.row.offset_us));
    frames.end = frames
        .end
        .min(rate.frame_at(face.row.span().end().shifted(-face.row.offset_us)) + 1);
    let frames = frames.start.min(frames.end)..frames.end;
    if frames.len() > LONGEST {
        let minutes = frames.len() as f64 / rate.per_second() / 60.0;
        return Err(Error::wrong(format!(
            "{:?} is a face of {minutes:.0} min, too long to be performed at once",
            recording.name
        ))
        .at(&recording.name)
        .advise("annotate the part on a gloss tier and name its token"));
    }
    let moment = |frame: usize| rate.instant(frame).shifted(face.row.offset_us);
    let body = own_body()?;
    let mut channels = body.clip.channels().to_vec();
    for channel in &mut channels {
        channel.rotations = vec![channel.rotations[0]; frames.len()];
        if let Some(places) = &mut channel.translations {
            *places = vec![places[0]; frames.len()];
        }
    }
    let trunk = trunk_of(&body);
    let leaning = |frame: usize| trunk.and_then(|_| face.trunk_at(moment(frame)));
    let leans = frames
        .clone()
        .map(|frame| (leaning(frame), DQuat::IDENTITY));
    turn(&mut channels, &body, trunk, leans);
    let turns = frames.clone().map(|frame| {
        let below = leaning(frame).map_or(DQuat::IDENTITY, head::rotation);
        (face.at(moment(frame)).1, below)
    });
    turn(&mut channels, &body, body.anatomy.joint(Part::Head), turns);
    let clip = Clip::new(Arc::clone(body.clip.skeleton()), rate, channels);
    let clip = clip.map_err(|error| Error::wrong(error.to_string()))?;
    let curves: Vec<Curve> = face.curves(frames.clone().map(moment));
    let signer = recording
        .signer_id
        .map(|id| recordings::signer(connection, id))
        .transpose()?
        .flatten();
    let left = signer
        .as_ref()
        .is_some_and(|it| it.handedness.as_deref() == Some("left"));
    let (address, gloss) = match &stretch.token {
        Some(token) => (format!("token:{}", token.id), token.gloss.clone()),
        None => (
            format!("recording:{}", recording.id),
            recording.name.clone(),
        ),
    };
    let name = format!(
        "face {} {frames:?} {} {} {} {:?}",
        motion::track_hash(connection, face.row.id)?,
        face.row.offset_us,
        face.view.system.id,
        face.view.system.version,
        face.fitted
    );
    Ok(Some(Material {
        address,
        hash: motion::hex(&Sha256::digest(name.as_bytes())),
        gloss,
        signer: signer.map(|it| Address::Signer(Name::Text(it.name)).to_string()),
        handedness: if left {
            Handedness::Left
        } else {
            Handedness::Right
        },
        clip,
        anatomy: body.anatomy,
        held: Vec::new(),
        curves,
    }))
}

/// Returns the joint that bends the trunk: the lowest one above the hips.
fn trunk_of(body: &Material) -> Option<usize> {
    [Part::Spine, Part::Chest]
        .into_iter()
        .find_map(|part| body.anatomy.joint(part))
        .filter(|joint| Some(*joint) != body.anatomy.joint(Part::Hips))
}

/// Rotates a joint of the body in model space in each frame, on top of the rotation of a joint below it.
fn turn(
    channels: &mut [Channel],
    body: &Material,
    joint: Option<usize>,
    turns: impl Iterator<Item = (Option<[f64; 3]>, DQuat)>,
) {
    let Some(joint) = joint else { return };
    let pose = body.clip.model_pose(0);
    let parent = body.clip.skeleton().parent(joint);
    let above = parent.map_or(DQuat::IDENTITY, |parent| pose.rotation(parent));
    for (rotation, (turned, below)) in channels[joint].rotations.iter_mut().zip(turns) {
        if let Some(turned) = turned {
            let own = head::rotation(turned) * pose.rotation(joint);
            *rotation = ((below * above).inverse() * own).normalize();
        }
    }
}

/// Returns a stretch of a recording that has only a face as movement for display; `None` if the recording has a
/// skeleton, or no captured face.
pub(crate) fn moving(connection: &Connection, stretch: &Stretch) -> Result<Option<Moving>> {
    if recordings::body_track(connection, stretch.recording.id)?.is_some() {
        return Ok(None);
    }
    Ok(material(connection, stretch)?.map(|face| Moving {
        faces: chereme_compose::faces(&face.curves),
        clip: face.clip,
        anatomy: (*face.anatomy).clone(),
        stretch: stretch.clone(),
    }))
}

/// Returns the frames of captured faces of recordings without a skeleton, by recording.
pub(crate) fn shown_alone(connection: &Connection) -> Result<BTreeMap<i64, ShownFrames>> {
    // Many recordings have the same channels.
    let mut known: BTreeMap<String, bool> = BTreeMap::new();
    let mut all = BTreeMap::new();
    for row in contents::curves_alone(connection)? {
        let is_face = *known.entry(row.names).or_insert_with_key(|names| {
            FaceSystem::of_names(names.lines()).is_some_and(|system| !system.expressions)
        });
        let Some(rate) = row.rate.or(Rate::new(USUAL, 1).ok()).filter(|_| is_face) else {
            continue;
        };
        let lasts = Instant::from_micros(row.duration_us).shifted(-row.offset_us);
        let frames = match row.rate {
            Some(_) => row.frames,
            None => rate.frame_at(lasts) as u64,
        };
        if frames > 0 && frames <= LONGEST as u64 {
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
pub(crate) fn first_frame(connection: &Connection, recording: i64, span: Span) -> Result<i64> {
    if recordings::body_track(connection, recording)?.is_some() {
        let track = crate::movement::MotionTrack::of(connection, recording)?;
        let frames = track.frames_in(span);
        return Ok(track
            .rate
            .instant(frames.start)
            .micros()
            .saturating_add(track.row.offset_us));
    }
    let Some(face) = captured(connection, recording, None)? else {
        return Ok(0);
    };
    let rate = face.times.rate().or(Rate::new(USUAL, 1).ok());
    Ok(rate.map_or(0, |rate| {
        let frames = rate.frames_in(span.shifted(-face.row.offset_us));
        rate.instant(frames.start)
            .micros()
            .saturating_add(face.row.offset_us)
    }))
}
