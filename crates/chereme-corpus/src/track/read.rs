//! Reads tracks from rows and blocks, whole or in part.

use std::collections::BTreeMap;
use std::ops::Range;

use chereme_motion::column::Column;
use chereme_motion::markers::Frame;
use chereme_motion::{
    Capture, Convention, Curve, Curves, Marker, Markers, Quality, Space, Span, Times,
};
use rusqlite::Connection;

use super::store::{MarkerLayout, TIME};
use super::{MediaFile, SkeletonTrack, Track, TrackKind, TrackRow};
use crate::codec;
use crate::db::damaged;
use crate::db::motion::{self, hex};
use crate::db::recordings;
use crate::db::tracks::{self, ChannelRow};
use crate::error::Result;
use crate::movement::{self, BLOCK_FRAMES};

/// Returns a track: all of it, or the frames within a span of the recording's clock.
///
/// # Errors
/// Fails if rows or blocks are damaged.
pub(crate) fn track(connection: &Connection, row: &TrackRow, span: Option<Span>) -> Result<Track> {
    Ok(match row.kind {
        TrackKind::Skeleton => {
            let track = movement::MotionTrack::of_row(connection, row.id)?;
            let frames = span.map_or(0..track.frames(), |span| track.frames_in(span));
            let roles = track
                .row
                .roles
                .as_deref()
                .and_then(|text| text.parse().ok());
            Track::Skeleton(SkeletonTrack {
                clip: track.raw_clip(connection, frames)?,
                convention: track.convention,
                roles,
            })
        }
        TrackKind::Markers => Track::Markers(markers(connection, row, span)?),
        TrackKind::Curves => Track::Curves(curves(connection, row, span)?),
        TrackKind::Media => {
            let all = recordings::media_tracks(connection, row.recording_id)?;
            let found = all.into_iter().find(|media| media.id == row.id);
            let media = found.ok_or_else(|| damaged(place(row), "its file has no place"))?;
            Track::Media(MediaFile {
                url: media.url,
                media_type: media.media_type,
            })
        }
    })
}

fn place(row: &TrackRow) -> String {
    format!("track {}", row.id)
}

/// The numbers of a track by channel, and the times of its frames.
struct Numbers {
    times: Times,
    channels: Vec<(ChannelRow, Vec<Column>)>,
}

/// Returns the curves of a track.
pub(crate) fn curves(
    connection: &Connection,
    row: &TrackRow,
    span: Option<Span>,
) -> Result<Curves> {
    let numbers = numbers(connection, row, span)?;
    let curve = |(channel, columns): (ChannelRow, Vec<Column>)| {
        let [values] = <[Column; 1]>::try_from(columns)
            .map_err(|_| damaged(place(row), "a scalar channel has several columns"))?;
        Ok(Curve {
            name: channel.name,
            unit: channel.unit,
            values,
        })
    };
    let all = numbers
        .channels
        .into_iter()
        .map(curve)
        .collect::<Result<_>>()?;
    Curves::new(numbers.times, all).map_err(|error| damaged(place(row), error.to_string()))
}

/// Returns the points of a track.
pub(crate) fn markers(
    connection: &Connection,
    row: &TrackRow,
    span: Option<Span>,
) -> Result<Markers> {
    let bad = |what: &str| damaged(place(row), format!("its {what} cannot be read"));
    let form = tracks::form(connection, row.id)?;
    let layout = form
        .layout
        .as_deref()
        .map(serde_json::from_str::<MarkerLayout>);
    let layout = layout.and_then(|it| it.ok()).ok_or_else(|| bad("layout"))?;
    let frame = layout.width.zip(layout.height);
    let frame = frame.map(|(width, height)| Frame { width, height });
    let space = match layout.space.as_str() {
        "world-3d" => Space::World(Convention {
            metres_per_unit: form.metres_per_unit.ok_or_else(|| bad("unit"))?,
            axes: form
                .axes
                .and_then(|text| text.parse().ok())
                .ok_or_else(|| bad("axes"))?,
        }),
        "image-2d" => Space::Image(frame.ok_or_else(|| bad("picture's size"))?),
        "image-2.5d" => Space::Depth(frame.ok_or_else(|| bad("picture's size"))?),
        _ => return Err(bad("space")),
    };
    let capture = [Capture::Measured, Capture::Estimated];
    let capture = capture.into_iter().find(|it| it.name() == layout.capture);
    let quality = [Quality::Residual, Quality::Confidence];
    let quality = layout
        .quality
        .map(|name| {
            quality
                .into_iter()
                .find(|it| it.name() == name)
                .ok_or_else(|| bad("quality"))
        })
        .transpose()?;
    let numbers = numbers(connection, row, span)?;
    let point = |(channel, mut place): (ChannelRow, Vec<Column>)| Marker {
        group: channel.part,
        name: channel.name,
        quality: (place.len() > space.coordinates())
            .then(|| place.pop())
            .flatten(),
        place,
    };
    let points = numbers.channels.into_iter().map(point).collect();
    let fault = |error: chereme_motion::TrackError| damaged(place(row), error.to_string());
    let markers = Markers::new(numbers.times, space, points)
        .and_then(|markers| markers.joined(layout.limbs))
        .map_err(fault)?
        .captured(capture.ok_or_else(|| bad("origin"))?);
    Ok(match quality {
        Some(quality) => markers.rated(quality),
        None => markers,
    })
}

/// Returns the times of a track's frames.
fn times(connection: &Connection, row: &TrackRow) -> Result<Times> {
    if let Some(rate) = row.rate {
        return Ok(Times::Even(rate));
    }
    let frames = 0..frame_count(row);
    let seconds = group(connection, row, TIME, 1, &frames)?.pop();
    let seconds = seconds.ok_or_else(|| damaged(place(row), "its times are missing"))?;
    Times::listed(seconds).map_err(|error| damaged(place(row), error.to_string()))
}

fn frame_count(row: &TrackRow) -> usize {
    usize::try_from(row.frames.unwrap_or_default()).unwrap_or(usize::MAX)
}

fn numbers(connection: &Connection, row: &TrackRow, span: Option<Span>) -> Result<Numbers> {
    let all = times(connection, row)?;
    let frames = match span {
        Some(span) => all.frames_in(span.shifted(-row.offset_us), frame_count(row)),
        None => 0..frame_count(row),
    };
    let times = match &all {
        Times::Listed(listed) if frames != (0..frame_count(row)) => {
            Times::listed(listed.seconds().slice(frames.clone()))
                .map_err(|error| damaged(place(row), error.to_string()))?
        }
        _ => all,
    };
    let rows = tracks::channels(connection, row.id)?;
    let mut widths: BTreeMap<&str, usize> = BTreeMap::new();
    for channel in &rows {
        *widths.entry(&channel.group).or_default() += channel.columns;
    }
    let mut read = BTreeMap::new();
    for (name, width) in widths {
        let columns = group(connection, row, name, width, &frames)?;
        read.insert(name.to_owned(), columns.into_iter());
    }
    let channels = rows.into_iter().map(|channel| {
        let columns = read.get_mut(&channel.group).into_iter().flatten();
        let columns: Vec<Column> = columns.take(channel.columns).collect();
        (channel, columns)
    });
    Ok(Numbers {
        times,
        channels: channels.collect(),
    })
}

/// Returns the columns of a group of channels at `frames`, decoding only the blocks that hold them.
fn group(
    connection: &Connection,
    row: &TrackRow,
    name: &str,
    width: usize,
    frames: &Range<usize>,
) -> Result<Vec<Column>> {
    let mut columns: Vec<Column> = Vec::new();
    let mut next = frames.start;
    motion::blocks(connection, row.id, name, frames, |block| {
        let fault = |reason: String| damaged(format!("block {}", hex(&block.hash)), reason);
        if block.frames > BLOCK_FRAMES {
            return Err(fault("it is too long".into()));
        }
        let decoded = codec::decode(&block.data, block.frames, width).map_err(fault)?;
        let end = frames
            .end
            .min(block.first_frame.saturating_add(block.frames));
        if block.first_frame > next || end < next {
            return Err(damaged(
                place(row),
                format!("frame {next} of {name:?} is missing"),
            ));
        }
        let own = next - block.first_frame..end - block.first_frame;
        if columns.is_empty() {
            columns = decoded
                .iter()
                .map(|column| column.slice(own.clone()))
                .collect();
        } else {
            for (column, more) in columns.iter_mut().zip(&decoded) {
                column
                    .append(&more.slice(own.clone()))
                    .map_err(|error| fault(error.to_string()))?;
            }
        }
        next = end;
        Ok(())
    })?;
    if next < frames.end {
        return Err(damaged(
            place(row),
            format!("frame {next} of {name:?} is missing"),
        ));
    }
    if columns.is_empty() {
        columns = vec![Column::doubles(Vec::new()); width];
    }
    Ok(columns)
}
