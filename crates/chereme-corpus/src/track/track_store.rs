//! Writes tracks into rows and blocks.

use std::collections::BTreeMap;

use chereme_formats::bvh::bvh_convert;
use chereme_formats::bvh::raw::FileNumber;
use chereme_motion::anatomy::BodyAnatomy;
use chereme_motion::column::FrameNumberColumn;
use chereme_motion::markers::PointPictureSize;
use chereme_motion::{CurveTrack, FrameTimes, MarkerSpace, MarkerTrack, SpaceConvention};
use rusqlite::Connection;
use serde::{Deserialize, Serialize};
use serde_json::json;
use sha2::{Digest, Sha256};

use super::{MediaFile, NewTrack, SkeletonTrack, TrackContent, TrackKind, TrackRow};
use crate::codec;
use crate::db::stored_motion::{self, to_hex_text};
use crate::db::stored_recordings::{self, MediaTrackRow, MotionTrackRow};
use crate::db::stored_tracks::{self, ChannelRow, TrackForm};
use crate::error::{CorpusError, CorpusResult};
use crate::movement::{self, BLOCK_FRAMES, TrackColumnLayout};

/// The name of the group of blocks that hold the time of each frame.
pub(super) const TIME_GROUP_NAME: &str = "time";
/// The names of the groups of points and of scalar channels.
const POINTS_GROUP_NAME: &str = "points";
const CURVES_GROUP_NAME: &str = "curves";
/// The largest number of channels in one group, so that a few of many channels can be read alone.
const MAX_GROUP_CHANNELS: usize = 96;

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
pub(crate) fn store_new_track(connection: &Connection, recording: i64, new: &NewTrack) -> CorpusResult<i64> {
    let name = stored_tracks::free_track_name(connection, recording, &new.name)?;
    let track = match &new.track {
        TrackContent::Skeleton(skeleton) => skeleton_track(connection, recording, &name, new, skeleton)?,
        TrackContent::Markers(markers) => markers_track(connection, recording, &name, new, markers)?,
        TrackContent::Curves(curves) => curves_track(connection, recording, &name, new, curves)?,
        TrackContent::Media(file) => media_track(connection, recording, &name, new, file)?,
    };
    if let Some(clock) = new.clock_us {
        stored_tracks::set_clock(connection, track, clock)?;
    }
    let end = stored_tracks::load_track_row(connection, track)?
        .track_clock_span()
        .span_end_instant();
    stored_recordings::lengthen_recording(connection, recording, end.instant_micros())?;
    Ok(track)
}

fn no_frames(name: &str) -> CorpusError {
    CorpusError::from_wrong_message(format!("the track {name:?} has no frames"))
}

fn media_track(
    connection: &Connection,
    recording_id: i64,
    name: &str,
    new: &NewTrack,
    file: &MediaFile,
) -> CorpusResult<i64> {
    let row = MediaTrackRow {
        imported: Vec::new(),
        id: 0,
        recording_id,
        name: name.to_owned(),
        offset_us: new.offset_us,
        url: file.url.clone(),
        media_type: file.media_type.clone(),
    };
    stored_recordings::insert_media_track(connection, &row)?;
    let stored = stored_tracks::find_named_track(connection, recording_id, TrackKind::Media, name)?;
    stored.ok_or_else(|| CorpusError::from_wrong_message("the media track was not stored"))
}

fn markers_track(
    connection: &Connection,
    recording_id: i64,
    name: &str,
    new: &NewTrack,
    markers: &MarkerTrack,
) -> CorpusResult<i64> {
    // Points on a picture are in pixels, which have no unit of length and no axes.
    let (convention, frame): (Option<SpaceConvention>, Option<PointPictureSize>) = match markers.marker_space() {
        MarkerSpace::World(convention) => (Some(*convention), None),
        MarkerSpace::Image(frame) | MarkerSpace::Depth(frame) => (None, Some(*frame)),
    };
    let layout = MarkerLayout {
        space: markers.marker_space().marker_space_name().to_owned(),
        width: frame.map(|frame| frame.width),
        height: frame.map(|frame| frame.height),
        capture: markers.marker_capture().capture_method_name().to_owned(),
        quality: markers
            .marker_quality()
            .map(|quality| quality.quality_meaning_name().to_owned()),
        limbs: markers.marker_limbs().to_vec(),
    };
    let form = TrackForm {
        metres_per_unit: convention.map(|convention| convention.metres_per_unit),
        axes: convention.map(|convention| convention.axes.to_string()),
        layout: Some(json!(layout).to_string()),
    };
    let mut groups = ChannelGroupNamer::default();
    let channels = markers.marker_points().iter().map(|point| {
        let columns: Vec<&FrameNumberColumn> = point.place.iter().chain(&point.quality).collect();
        let row = ChannelRow {
            group: groups.next_group_name(POINTS_GROUP_NAME, &point.group),
            part: point.group.clone(),
            name: point.name.clone(),
            unit: String::new(),
            columns: columns.len(),
        };
        (row, columns)
    });
    let channels = channels.collect();
    let row = new_track_row(
        recording_id,
        TrackKind::Markers,
        name,
        new,
        markers.marker_times(),
        markers.marker_frame_count(),
    );
    store_track_numbers(connection, &row, &form, markers.marker_times(), channels)
}

fn curves_track(
    connection: &Connection,
    recording_id: i64,
    name: &str,
    new: &NewTrack,
    curves: &CurveTrack,
) -> CorpusResult<i64> {
    let form = TrackForm {
        metres_per_unit: None,
        axes: None,
        layout: None,
    };
    let mut groups = ChannelGroupNamer::default();
    let channels = curves.track_curves().iter().map(|curve| {
        let row = ChannelRow {
            group: groups.next_group_name(CURVES_GROUP_NAME, ""),
            part: String::new(),
            name: curve.name.clone(),
            unit: curve.unit.clone(),
            columns: 1,
        };
        (row, vec![&curve.values])
    });
    let channels = channels.collect();
    let row = new_track_row(
        recording_id,
        TrackKind::Curves,
        name,
        new,
        curves.curve_times(),
        curves.curve_frame_count(),
    );
    store_track_numbers(connection, &row, &form, curves.curve_times(), channels)
}

/// Names the groups of channels: one for each part of a file, and another after [`MAX_GROUP_CHANNELS`] channels.
#[derive(Default)]
struct ChannelGroupNamer(BTreeMap<String, usize>);

impl ChannelGroupNamer {
    fn next_group_name(&mut self, kind: &str, part: &str) -> String {
        let name = match part {
            "" => kind.to_owned(),
            part => format!("{kind} {part}"),
        };
        let count = self.0.entry(name.clone()).or_default();
        // The first group has no number, so that small files have groups called as their parts.
        let number = *count / MAX_GROUP_CHANNELS;
        *count += 1;
        match number {
            0 => name,
            number => format!("{name} {}", number + 1),
        }
    }
}

fn new_track_row(
    recording_id: i64,
    kind: TrackKind,
    name: &str,
    new: &NewTrack,
    times: &FrameTimes,
    frames: usize,
) -> TrackRow {
    TrackRow {
        id: 0,
        recording_id,
        kind,
        name: name.to_owned(),
        offset_us: new.offset_us,
        duration_us: Some(
            times
                .frame_times_span(frames)
                .span_end_instant()
                .instant_micros()
                .max(0),
        ),
        frames: Some(frames as u64),
        rate: times.even_times_rate(),
        channels: 0,
        clock_us: None,
    }
}

/// Stores channels with their columns, group by group, and the frame times if they are not at an even rate.
fn store_track_numbers(
    connection: &Connection,
    row: &TrackRow,
    form: &TrackForm,
    times: &FrameTimes,
    channels: Vec<(ChannelRow, Vec<&FrameNumberColumn>)>,
) -> CorpusResult<i64> {
    if row.frames == Some(0) {
        return Err(no_frames(&row.name));
    }
    let track = stored_tracks::insert_track_row(connection, row, form)?;
    let mut groups: BTreeMap<String, Vec<&FrameNumberColumn>> = BTreeMap::new();
    let mut rows = Vec::with_capacity(channels.len());
    for (channel, columns) in channels {
        groups.entry(channel.group.clone()).or_default().extend(columns);
        rows.push(channel);
    }
    stored_tracks::insert_channels(connection, track, &rows)?;
    // Even times follow from the rate, and need no column.
    if let FrameTimes::Listed(listed) = times {
        groups.insert(TIME_GROUP_NAME.to_owned(), vec![listed.listed_seconds()]);
    }
    for (group, columns) in groups {
        store_group_blocks(connection, track, &group, &columns)?;
    }
    Ok(track)
}

/// Stores whole columns as the blocks of a group.
fn store_group_blocks(
    connection: &Connection,
    track: i64,
    group: &str,
    columns: &[&FrameNumberColumn],
) -> CorpusResult<()> {
    let frames = columns.first().map_or(0, |column| column.len());
    for first in (0..frames).step_by(BLOCK_FRAMES) {
        let rows = first..frames.min(first + BLOCK_FRAMES);
        let part: Vec<FrameNumberColumn> = columns.iter().map(|column| column.slice_column(rows.clone())).collect();
        let data = codec::encode_any(rows.len(), &part);
        stored_motion::insert_block(connection, track, group, first, rows.len(), &data)?;
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
) -> CorpusResult<i64> {
    if clip.clip_frame_count() == 0 {
        return Err(no_frames(name));
    }
    // Parts of the body are found in metres and model space, whatever the file's unit and axes.
    let shown = convention.file_clip_to_model(&clip.slice_clip_frames(0..1));
    let given_roles = roles.clone().unwrap_or_default();
    let anatomy = BodyAnatomy::with_roles(shown.clip_skeleton(), &given_roles)
        .map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    let groups = movement::channel_groups(shown.clip_skeleton(), &anatomy);
    // The stored skeleton keeps the unit and axes of the file, like its movement.
    let document = skeleton_document_text(clip.clip_skeleton())?;
    let hash = to_hex_text(&Sha256::digest(document.as_bytes()));
    let joints = clip.clip_skeleton().len();
    let rate = clip.clip_frame_rate();
    let named: BTreeMap<&str, &Vec<usize>> = groups
        .iter()
        .map(|(group, joints)| (group.channel_group_name(), joints))
        .collect();
    let row = MotionTrackRow {
        id: 0,
        recording_id,
        name: name.to_owned(),
        offset_us: new.offset_us,
        skeleton_id: stored_recordings::skeleton_stored(connection, &hash, joints, &document)?,
        frames: clip.clip_frame_count() as i64,
        rate_frames: rate.rate_numerator(),
        rate_seconds: rate.per_seconds(),
        frame_time: None,
        metres_per_unit: convention.metres_per_unit,
        axes: convention.axes.to_string(),
        root_order: None,
        root_scale: None,
        roles: roles.as_ref().and_then(|roles| serde_json::to_string(roles).ok()),
        channel_groups: json!(named).to_string(),
    };
    let track = stored_recordings::insert_motion_track(connection, &row)?;
    let layout = TrackColumnLayout::from_clip_columns(clip);
    stored_tracks::set_layout(connection, track, &json!(layout).to_string())?;
    skeleton_blocks(connection, track, &groups, clip)?;
    Ok(track)
}

/// Stores the numbers of a skeleton's movement, group by group.
pub(crate) fn skeleton_blocks(
    connection: &Connection,
    track: i64,
    groups: &BTreeMap<movement::ChannelGroup, Vec<usize>>,
    clip: &chereme_motion::Clip,
) -> CorpusResult<()> {
    let layout = TrackColumnLayout::from_clip_columns(clip);
    for (group, joints) in groups {
        let joint_columns: Vec<FrameNumberColumn> = joints
            .iter()
            .flat_map(|&joint| layout.joint_columns(clip, joint))
            .collect();
        let columns: Vec<&FrameNumberColumn> = joint_columns.iter().collect();
        store_group_blocks(connection, track, group.channel_group_name(), &columns)?;
    }
    Ok(())
}

/// Returns the document of a skeleton: like that of a BVH file without channels, plus the rest rotations.
fn skeleton_document_text(skeleton: &chereme_motion::Skeleton) -> CorpusResult<String> {
    // The shortest decimal that gives the same float again is exact.
    let exact = |value: f64| {
        value
            .to_string()
            .parse::<FileNumber>()
            .unwrap_or(FileNumber::ZERO_NUMBER)
    };
    let place = |at: chereme_motion::glam::DVec3| at.to_array().map(exact);
    // The decimals do not count, since every offset is replaced by the exact one below.
    let mut hierarchy = bvh_convert::hierarchy_from_skeleton(skeleton, 0);
    for (raw, joint) in hierarchy.joints.iter_mut().zip(skeleton.skeleton_joints()) {
        raw.name.clone_from(&joint.name);
        raw.channels.clear();
        raw.offset = place(joint.offset);
        raw.end_sites = joint.tip.map(place).into_iter().collect();
    }
    let fault = |error: serde_json::Error| CorpusError::from_wrong_message(error.to_string());
    let mut document = serde_json::to_value(&hierarchy).map_err(fault)?;
    // BVH has no rest rotations, so that they are added beside its fields.
    let joints = document["joints"].as_array_mut().into_iter().flatten();
    for (raw, joint) in joints.zip(skeleton.skeleton_joints()) {
        raw["rest"] = json!(joint.rest.to_array());
    }
    Ok(document.to_string())
}
