//! Reads tracks from rows and blocks, whole or in part.

use std::collections::BTreeMap;
use std::ops::Range;

use chereme_motion::column::FrameNumberColumn;
use chereme_motion::markers::PointPictureSize;
use chereme_motion::{
    CaptureMethod, CurveTrack, FrameTimes, MarkerSpace, MarkerTrack, MotionMarker, QualityMeaning, ScalarCurve,
    SpaceConvention, TimeSpan,
};
use rusqlite::Connection;

use super::track_store::{MarkerLayout, TIME_GROUP_NAME};
use super::{MediaFile, SkeletonTrack, TrackContent, TrackKind, TrackRow};
use crate::codec;
use crate::db::damaged_row_error;
use crate::db::stored_motion::{self, to_hex_text};
use crate::db::stored_recordings;
use crate::db::stored_tracks::{self, ChannelRow};
use crate::error::CorpusResult;
use crate::movement::{self, BLOCK_FRAMES};

/// Returns a track: all of it, or the frames within a span of the recording's clock.
///
/// # Errors
/// Fails if rows or blocks are damaged.
pub(crate) fn read_stored_track(
    connection: &Connection,
    row: &TrackRow,
    span: Option<TimeSpan>,
) -> CorpusResult<TrackContent> {
    Ok(match row.kind {
        TrackKind::Skeleton => {
            let track = movement::MotionTrack::of_row(connection, row.id)?;
            let frames = span.map_or(0..track.motion_frame_count(), |span| track.frames_in(span));
            let roles = track.row.roles.as_deref().and_then(|text| text.parse().ok());
            TrackContent::Skeleton(SkeletonTrack {
                clip: track.raw_clip(connection, frames)?,
                convention: track.convention,
                roles,
            })
        }
        TrackKind::Markers => TrackContent::Markers(read_track_markers(connection, row, span)?),
        TrackKind::Curves => TrackContent::Curves(read_track_curves(connection, row, span)?),
        TrackKind::Media => {
            let all = stored_recordings::media_tracks(connection, row.recording_id)?;
            let stored_media = all.into_iter().find(|media| media.id == row.id);
            let media =
                stored_media.ok_or_else(|| damaged_row_error(track_place_text(row), "its file has no place"))?;
            TrackContent::Media(MediaFile {
                url: media.url,
                media_type: media.media_type,
            })
        }
    })
}

fn track_place_text(row: &TrackRow) -> String {
    format!("track {}", row.id)
}

/// The numbers of a track by channel, and the times of its frames.
struct TrackNumbers {
    times: FrameTimes,
    channels: Vec<(ChannelRow, Vec<FrameNumberColumn>)>,
}

/// Returns the curves of a track.
pub(crate) fn read_track_curves(
    connection: &Connection,
    row: &TrackRow,
    span: Option<TimeSpan>,
) -> CorpusResult<CurveTrack> {
    let numbers = read_track_numbers(connection, row, span)?;
    let curve = |(channel, columns): (ChannelRow, Vec<FrameNumberColumn>)| {
        let [values] = <[FrameNumberColumn; 1]>::try_from(columns)
            .map_err(|_| damaged_row_error(track_place_text(row), "a scalar channel has several columns"))?;
        Ok(ScalarCurve {
            name: channel.name,
            unit: channel.unit,
            values,
        })
    };
    let all = numbers.channels.into_iter().map(curve).collect::<CorpusResult<_>>()?;
    CurveTrack::new(numbers.times, all).map_err(|error| damaged_row_error(track_place_text(row), error.to_string()))
}

/// Returns the points of a track.
pub(crate) fn read_track_markers(
    connection: &Connection,
    row: &TrackRow,
    span: Option<TimeSpan>,
) -> CorpusResult<MarkerTrack> {
    let bad = |what: &str| damaged_row_error(track_place_text(row), format!("its {what} cannot be read"));
    let form = stored_tracks::load_track_form(connection, row.id)?;
    let stored_layout = form.layout.as_deref().map(serde_json::from_str::<MarkerLayout>);
    let layout = stored_layout
        .and_then(|result| result.ok())
        .ok_or_else(|| bad("layout"))?;
    let frame_size = layout.width.zip(layout.height);
    let frame = frame_size.map(|(width, height)| PointPictureSize { width, height });
    let space = match layout.space.as_str() {
        "world-3d" => MarkerSpace::World(SpaceConvention {
            metres_per_unit: form.metres_per_unit.ok_or_else(|| bad("unit"))?,
            axes: form
                .axes
                .and_then(|text| text.parse().ok())
                .ok_or_else(|| bad("axes"))?,
        }),
        "image-2d" => MarkerSpace::Image(frame.ok_or_else(|| bad("picture's size"))?),
        "image-2.5d" => MarkerSpace::Depth(frame.ok_or_else(|| bad("picture's size"))?),
        _ => return Err(bad("space")),
    };
    let captures = [CaptureMethod::Measured, CaptureMethod::Estimated];
    let capture = captures
        .into_iter()
        .find(|candidate| candidate.capture_method_name() == layout.capture);
    let qualities = [QualityMeaning::Residual, QualityMeaning::Confidence];
    let quality = layout
        .quality
        .map(|name| {
            qualities
                .into_iter()
                .find(|candidate| candidate.quality_meaning_name() == name)
                .ok_or_else(|| bad("quality"))
        })
        .transpose()?;
    let numbers = read_track_numbers(connection, row, span)?;
    let point = |(channel, mut place): (ChannelRow, Vec<FrameNumberColumn>)| MotionMarker {
        group: channel.part,
        name: channel.name,
        quality: (place.len() > space.space_coordinate_count())
            .then(|| place.pop())
            .flatten(),
        place,
    };
    let points = numbers.channels.into_iter().map(point).collect();
    let fault = |error: chereme_motion::TrackError| damaged_row_error(track_place_text(row), error.to_string());
    let markers = MarkerTrack::new(numbers.times, space, points)
        .and_then(|markers| markers.with_marker_limbs(layout.limbs))
        .map_err(fault)?
        .with_capture_method(capture.ok_or_else(|| bad("origin"))?);
    Ok(match quality {
        Some(quality) => markers.with_quality_meaning(quality),
        None => markers,
    })
}

/// Returns the times of a track's frames.
fn read_track_times(connection: &Connection, row: &TrackRow) -> CorpusResult<FrameTimes> {
    if let Some(rate) = row.rate {
        return Ok(FrameTimes::Even(rate));
    }
    let frames = 0..frame_count(row);
    let time_column = read_channel_group(connection, row, TIME_GROUP_NAME, 1, &frames)?.pop();
    let seconds = time_column.ok_or_else(|| damaged_row_error(track_place_text(row), "its times are missing"))?;
    FrameTimes::from_listed_seconds(seconds)
        .map_err(|error| damaged_row_error(track_place_text(row), error.to_string()))
}

fn frame_count(row: &TrackRow) -> usize {
    usize::try_from(row.frames.unwrap_or_default()).unwrap_or(usize::MAX)
}

fn read_track_numbers(connection: &Connection, row: &TrackRow, span: Option<TimeSpan>) -> CorpusResult<TrackNumbers> {
    let all = read_track_times(connection, row)?;
    let frames = match span {
        // The times of frames are counted from the start of the track, and not from that of the recording.
        Some(span) => all.frames_in(span.shifted_span(-row.offset_us), frame_count(row)),
        None => 0..frame_count(row),
    };
    let times = match &all {
        FrameTimes::Listed(listed) if frames != (0..frame_count(row)) => {
            FrameTimes::from_listed_seconds(listed.listed_seconds().slice_column(frames.clone()))
                .map_err(|error| damaged_row_error(track_place_text(row), error.to_string()))?
        }
        _ => all,
    };
    let rows = stored_tracks::load_channel_rows(connection, row.id)?;
    // The channels of a group lie beside each other in its blocks.
    let mut widths: BTreeMap<&str, usize> = BTreeMap::new();
    for channel in &rows {
        *widths.entry(&channel.group).or_default() += channel.columns;
    }
    let mut read = BTreeMap::new();
    for (name, width) in widths {
        let columns = read_channel_group(connection, row, name, width, &frames)?;
        read.insert(name.to_owned(), columns.into_iter());
    }
    let channels = rows.into_iter().map(|channel| {
        let group_columns = read.get_mut(&channel.group).into_iter().flatten();
        let columns: Vec<FrameNumberColumn> = group_columns.take(channel.columns).collect();
        (channel, columns)
    });
    Ok(TrackNumbers {
        times,
        channels: channels.collect(),
    })
}

/// Returns the columns of a group of channels at `frames`, decoding only the blocks that hold them.
fn read_channel_group(
    connection: &Connection,
    row: &TrackRow,
    name: &str,
    width: usize,
    frames: &Range<usize>,
) -> CorpusResult<Vec<FrameNumberColumn>> {
    let mut columns: Vec<FrameNumberColumn> = Vec::new();
    let mut next = frames.start;
    stored_motion::visit_track_blocks(connection, row.id, name, frames, |block| {
        let fault = |reason: String| damaged_row_error(format!("block {}", to_hex_text(&block.hash)), reason);
        // A damaged number would otherwise ask for any amount of memory.
        if block.frames > BLOCK_FRAMES {
            return Err(fault("it is too long".into()));
        }
        let decoded = codec::decode_block_columns(&block.data, block.frames, width).map_err(fault)?;
        let end = frames.end.min(block.first_frame.saturating_add(block.frames));
        // A gap between blocks would shift all later frames.
        if block.first_frame > next || end < next {
            return Err(damaged_row_error(
                track_place_text(row),
                format!("frame {next} of {name:?} is missing"),
            ));
        }
        let block_range = next - block.first_frame..end - block.first_frame;
        if columns.is_empty() {
            columns = decoded
                .iter()
                .map(|column| column.slice_column(block_range.clone()))
                .collect();
        } else {
            for (column, more) in columns.iter_mut().zip(&decoded) {
                column
                    .append_column(&more.slice_column(block_range.clone()))
                    .map_err(|error| fault(error.to_string()))?;
            }
        }
        next = end;
        Ok(())
    })?;
    if next < frames.end {
        return Err(damaged_row_error(
            track_place_text(row),
            format!("frame {next} of {name:?} is missing"),
        ));
    }
    // No block means no frames, but each channel still has its columns.
    if columns.is_empty() {
        columns = vec![FrameNumberColumn::from_double_floats(Vec::new()); width];
    }
    Ok(columns)
}
