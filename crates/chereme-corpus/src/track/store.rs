//! Writes tracks into rows and blocks.

use std::collections::BTreeMap;

use chereme_formats::bvh::convert;
use chereme_formats::bvh::raw::Number;
use chereme_motion::anatomy::Anatomy;
use chereme_motion::column::Column;
use chereme_motion::markers::Frame;
use chereme_motion::{Convention, Curves, Markers, Space, Times};
use rusqlite::Connection;
use serde::{Deserialize, Serialize};
use serde_json::json;
use sha2::{Digest, Sha256};

use super::{MediaFile, NewTrack, SkeletonTrack, Track, TrackKind, TrackRow};
use crate::codec;
use crate::db::motion::{self, hex};
use crate::db::recordings::{self, MediaTrackRow, MotionTrackRow};
use crate::db::tracks::{self, ChannelRow, TrackForm};
use crate::error::{Error, Result};
use crate::movement::{self, BLOCK_FRAMES, Layout};

/// The name of the group of blocks that hold the time of each frame.
pub(super) const TIME: &str = "time";
/// The names of the groups of points and of scalar channels.
const POINTS: &str = "points";
const CURVES: &str = "curves";
/// The largest number of channels in one group, so that a few of many channels can be read alone.
const TOGETHER: usize = 96;

/// The properties of markers besides their numbers.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct MarkerLayout {
    pub(super) space: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) width: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) height: Option<f64>,
    pub(super) capture: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) quality: Option<String>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) limbs: Vec<[usize; 2]>,
}

/// Stores a track of a recording, makes the recording long enough, and returns the track's row.
///
/// # Errors
/// Fails if the track has no frames, or the database fails.
pub(crate) fn store(connection: &Connection, recording: i64, new: &NewTrack) -> Result<i64> {
    let name = tracks::free_name(connection, recording, &new.name)?;
    let track = match &new.track {
        Track::Skeleton(skeleton) => skeleton_track(connection, recording, &name, new, skeleton)?,
        Track::Markers(markers) => markers_track(connection, recording, &name, new, markers)?,
        Track::Curves(curves) => curves_track(connection, recording, &name, new, curves)?,
        Track::Media(file) => media_track(connection, recording, &name, new, file)?,
    };
    if let Some(clock) = new.clock_us {
        tracks::set_clock(connection, track, clock)?;
    }
    let end = tracks::track(connection, track)?.span().end();
    recordings::lengthen(connection, recording, end.micros())?;
    Ok(track)
}

fn no_frames(name: &str) -> Error {
    Error::wrong(format!("the track {name:?} has no frames"))
}

fn media_track(
    connection: &Connection,
    recording_id: i64,
    name: &str,
    new: &NewTrack,
    file: &MediaFile,
) -> Result<i64> {
    let row = MediaTrackRow {
        imported: Vec::new(),
        id: 0,
        recording_id,
        name: name.to_owned(),
        offset_us: new.offset_us,
        url: file.url.clone(),
        media_type: file.media_type.clone(),
    };
    recordings::insert_media_track(connection, &row)?;
    let stored = tracks::named(connection, recording_id, TrackKind::Media, name)?;
    stored.ok_or_else(|| Error::wrong("the media track was not stored"))
}

fn markers_track(
    connection: &Connection,
    recording_id: i64,
    name: &str,
    new: &NewTrack,
    markers: &Markers,
) -> Result<i64> {
    let (convention, frame): (Option<Convention>, Option<Frame>) = match markers.space() {
        Space::World(convention) => (Some(*convention), None),
        Space::Image(frame) | Space::Depth(frame) => (None, Some(*frame)),
    };
    let layout = MarkerLayout {
        space: markers.space().name().to_owned(),
        width: frame.map(|frame| frame.width),
        height: frame.map(|frame| frame.height),
        capture: markers.capture().name().to_owned(),
        quality: markers.quality().map(|quality| quality.name().to_owned()),
        limbs: markers.limbs().to_vec(),
    };
    let form = TrackForm {
        metres_per_unit: convention.map(|it| it.metres_per_unit),
        axes: convention.map(|it| it.axes.to_string()),
        layout: Some(json!(layout).to_string()),
    };
    let mut groups = Groups::default();
    let channels = markers.points().iter().map(|point| {
        let columns: Vec<&Column> = point.place.iter().chain(&point.quality).collect();
        let row = ChannelRow {
            group: groups.of(POINTS, &point.group),
            part: point.group.clone(),
            name: point.name.clone(),
            unit: String::new(),
            columns: columns.len(),
        };
        (row, columns)
    });
    let channels = channels.collect();
    let row = row(
        recording_id,
        TrackKind::Markers,
        name,
        new,
        markers.times(),
        markers.frames(),
    );
    numbers(connection, &row, &form, markers.times(), channels)
}

fn curves_track(
    connection: &Connection,
    recording_id: i64,
    name: &str,
    new: &NewTrack,
    curves: &Curves,
) -> Result<i64> {
    let form = TrackForm {
        metres_per_unit: None,
        axes: None,
        layout: None,
    };
    let mut groups = Groups::default();
    let channels = curves.curves().iter().map(|curve| {
        let row = ChannelRow {
            group: groups.of(CURVES, ""),
            part: String::new(),
            name: curve.name.clone(),
            unit: curve.unit.clone(),
            columns: 1,
        };
        (row, vec![&curve.values])
    });
    let channels = channels.collect();
    let row = row(
        recording_id,
        TrackKind::Curves,
        name,
        new,
        curves.times(),
        curves.frames(),
    );
    numbers(connection, &row, &form, curves.times(), channels)
}

/// Names the groups of channels: one for each part of a file, and another after [`TOGETHER`] channels.
#[derive(Default)]
struct Groups(BTreeMap<String, usize>);

impl Groups {
    fn of(&mut self, kind: &str, part: &str) -> String {
        let name = match part {
            "" => kind.to_owned(),
            part => format!("{kind} {part}"),
        };
        let count = self.0.entry(name.clone()).or_default();
        let number = *count / TOGETHER;
        *count += 1;
        match number {
            0 => name,
            number => format!("{name} {}", number + 1),
        }
    }
}

fn row(
    recording_id: i64,
    kind: TrackKind,
    name: &str,
    new: &NewTrack,
    times: &Times,
    frames: usize,
) -> TrackRow {
    TrackRow {
        id: 0,
        recording_id,
        kind,
        name: name.to_owned(),
        offset_us: new.offset_us,
        duration_us: Some(times.span(frames).end().micros().max(0)),
        frames: Some(frames as u64),
        rate: times.rate(),
        channels: 0,
        clock_us: None,
    }
}

/// Stores channels with their columns, group by group, and the frame times if they are not at an even rate.
fn numbers(
    connection: &Connection,
    row: &TrackRow,
    form: &TrackForm,
    times: &Times,
    channels: Vec<(ChannelRow, Vec<&Column>)>,
) -> Result<i64> {
    if row.frames == Some(0) {
        return Err(no_frames(&row.name));
    }
    let track = tracks::insert(connection, row, form)?;
    let mut groups: BTreeMap<String, Vec<&Column>> = BTreeMap::new();
    let mut rows = Vec::with_capacity(channels.len());
    for (channel, columns) in channels {
        groups
            .entry(channel.group.clone())
            .or_default()
            .extend(columns);
        rows.push(channel);
    }
    tracks::insert_channels(connection, track, &rows)?;
    if let Times::Listed(listed) = times {
        groups.insert(TIME.to_owned(), vec![listed.seconds()]);
    }
    for (group, columns) in groups {
        blocks(connection, track, &group, &columns)?;
    }
    Ok(track)
}

/// Stores whole columns as the blocks of a group.
fn blocks(connection: &Connection, track: i64, group: &str, columns: &[&Column]) -> Result<()> {
    let frames = columns.first().map_or(0, |column| column.len());
    for first in (0..frames).step_by(BLOCK_FRAMES) {
        let rows = first..frames.min(first + BLOCK_FRAMES);
        let part: Vec<Column> = columns.iter().map(|it| it.slice(rows.clone())).collect();
        let data = codec::encode_any(rows.len(), &part);
        motion::insert_block(connection, track, group, first, rows.len(), &data)?;
    }
    Ok(())
}

/// Stores a skeleton's movement exactly, as unit quaternions and positions of joints.
fn skeleton_track(
    connection: &Connection,
    recording_id: i64,
    name: &str,
    new: &NewTrack,
    SkeletonTrack {
        clip,
        convention,
        roles,
    }: &SkeletonTrack,
) -> Result<i64> {
    if clip.frames() == 0 {
        return Err(no_frames(name));
    }
    let shown = convention.clip(&clip.slice(0..1));
    let found = roles.clone().unwrap_or_default();
    let anatomy = Anatomy::with_roles(shown.skeleton(), &found)
        .map_err(|error| Error::wrong(error.to_string()))?;
    let groups = movement::channel_groups(shown.skeleton(), &anatomy);
    let document = document(clip.skeleton())?;
    let hash = hex(&Sha256::digest(document.as_bytes()));
    let joints = clip.skeleton().len();
    let rate = clip.rate();
    let named: BTreeMap<&str, &Vec<usize>> = groups
        .iter()
        .map(|(group, joints)| (group.name(), joints))
        .collect();
    let row = MotionTrackRow {
        id: 0,
        recording_id,
        name: name.to_owned(),
        offset_us: new.offset_us,
        skeleton_id: recordings::skeleton_stored(connection, &hash, joints, &document)?,
        frames: clip.frames() as i64,
        rate_frames: rate.frames(),
        rate_seconds: rate.per_seconds(),
        frame_time: None,
        metres_per_unit: convention.metres_per_unit,
        axes: convention.axes.to_string(),
        root_order: None,
        root_scale: None,
        roles: roles.as_ref().and_then(|it| serde_json::to_string(it).ok()),
        channel_groups: json!(named).to_string(),
    };
    let track = recordings::insert_motion_track(connection, &row)?;
    let layout = Layout::of(clip);
    tracks::set_layout(connection, track, &json!(layout).to_string())?;
    skeleton_blocks(connection, track, &groups, clip)?;
    Ok(track)
}

/// Stores the numbers of a skeleton's movement, group by group.
pub(crate) fn skeleton_blocks(
    connection: &Connection,
    track: i64,
    groups: &BTreeMap<movement::ChannelGroup, Vec<usize>>,
    clip: &chereme_motion::Clip,
) -> Result<()> {
    let layout = Layout::of(clip);
    for (group, joints) in groups {
        let columns: Vec<Column> = joints
            .iter()
            .flat_map(|&joint| layout.columns(clip, joint))
            .collect();
        let columns: Vec<&Column> = columns.iter().collect();
        blocks(connection, track, group.name(), &columns)?;
    }
    Ok(())
}

/// Returns the document of a skeleton: like that of a BVH file without channels, plus the rest rotations.
fn document(skeleton: &chereme_motion::Skeleton) -> Result<String> {
    let exact = |value: f64| value.to_string().parse::<Number>().unwrap_or(Number::ZERO);
    let place = |at: chereme_motion::glam::DVec3| at.to_array().map(exact);
    let mut hierarchy = convert::hierarchy(skeleton, 0);
    for (raw, joint) in hierarchy.joints.iter_mut().zip(skeleton.joints()) {
        raw.name.clone_from(&joint.name);
        raw.channels.clear();
        raw.offset = place(joint.offset);
        raw.end_sites = joint.tip.map(place).into_iter().collect();
    }
    let fault = |error: serde_json::Error| Error::wrong(error.to_string());
    let mut document = serde_json::to_value(&hierarchy).map_err(fault)?;
    let joints = document["joints"].as_array_mut().into_iter().flatten();
    for (raw, joint) in joints.zip(skeleton.joints()) {
        raw["rest"] = json!(joint.rest.to_array());
    }
    Ok(document.to_string())
}
