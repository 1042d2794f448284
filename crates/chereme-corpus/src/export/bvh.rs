//! Exports movement as BVH: captured numbers are written exactly as in the imported file.

use std::collections::BTreeMap;
use std::io::Write;
use std::ops::Range;

use chereme_formats::bvh::convert;
use chereme_formats::bvh::raw::{Block, Column, Decimal, Number, WriteError, Writer};
use chereme_motion::column::Numbers;
use rusqlite::Connection;

use crate::address::Stretch;
use crate::error::{Error, Result};
use crate::movement::{BLOCK_FRAMES, ChannelGroup, MotionTrack};
use crate::progress::{Progress, Step, Unit};

/// Returns a note if the movement of a whole recording does not begin with it: a BVH file begins with its movement.
pub(crate) fn late_start(connection: &Connection, stretch: &Stretch) -> Result<Option<String>> {
    let offset = MotionTrack::of(connection, stretch.recording.id)?
        .row
        .offset_us;
    if stretch.token.is_some() || offset == 0 {
        return Ok(None);
    }
    Ok(Some(format!(
        "a BVH file does not say that its movement begins {} s after its recording; state that offset when you import it, or the annotations are beside it",
        offset as f64 / 1e6
    )))
}

/// Writes the movement of a stretch of a recording, and returns the number of frames.
///
/// # Errors
/// Fails if the recording has no movement, or if writing fails.
pub(crate) fn write(
    connection: &Connection,
    stretch: &Stretch,
    out: &mut dyn Write,
    progress: &mut Progress<'_>,
) -> Result<usize> {
    let track = MotionTrack::of(connection, stretch.recording.id)?;
    let frames = track.frames_of(stretch);
    if !track.is_of_bvh() {
        return write_converted(connection, &track, frames, out);
    }
    let time = track.frame_time()?;
    let motion =
        (time.is_some() || !frames.is_empty()).then_some((time.as_ref(), frames.len() as u64));
    let fault = |error: WriteError| Error::wrong(format!("the BVH cannot be written: {error}"));
    let mut writer = Writer::new(out, &track.hierarchy, motion).map_err(fault)?;
    let mut first = frames.start - frames.start % BLOCK_FRAMES;
    while first < frames.end {
        let own = first.max(frames.start)..(first + BLOCK_FRAMES).min(frames.end);
        let columns = columns(connection, &track, first, &own)?;
        let first_frame = (own.start - frames.start) as u64;
        writer
            .block(&Block {
                first_frame,
                frames: own.len(),
                columns,
            })
            .map_err(fault)?;
        progress.report(Step {
            task: &stretch.recording.name,
            done: (own.end - frames.start) as u64,
            total: Some(frames.len() as u64),
            unit: Unit::Frames,
        })?;
        first += BLOCK_FRAMES;
    }
    writer.finish().map_err(fault)?;
    Ok(frames.len())
}

/// The number of decimals for numbers that did not come from a BVH file.
const DECIMALS: u8 = 6;

/// Writes movement from another format, with rotations as Euler angles.
fn write_converted(
    connection: &Connection,
    track: &MotionTrack,
    frames: Range<usize>,
    out: &mut dyn Write,
) -> Result<usize> {
    let clip = track.raw_clip(connection, frames)?;
    let hierarchy = convert::widened(&convert::hierarchy(clip.skeleton(), DECIMALS), &clip);
    let columns = convert::columns(&clip, &hierarchy, DECIMALS)
        .map_err(|error| Error::wrong(error.to_string()))?;
    let fault = |error: WriteError| Error::wrong(format!("the BVH cannot be written: {error}"));
    let time = Decimal::rounded(clip.rate().frame_time(), 9).map(Number::from);
    let motion = Some((time.as_ref(), clip.frames() as u64));
    let mut writer = Writer::new(out, &hierarchy, motion).map_err(fault)?;
    let block = Block {
        first_frame: 0,
        frames: clip.frames(),
        columns,
    };
    writer.block(&block).map_err(fault)?;
    writer.finish().map_err(fault)?;
    Ok(clip.frames())
}

/// Returns the columns of the frames `own` within the block that starts at frame `first`, in the order of the file.
fn columns(
    connection: &Connection,
    track: &MotionTrack,
    first: usize,
    own: &Range<usize>,
) -> Result<Vec<Column>> {
    let mut all: BTreeMap<usize, Column> = BTreeMap::new();
    track.blocks(
        connection,
        &ChannelGroup::ALL,
        own,
        |numbers, start, columns| {
            if start != first {
                return Err(Error::wrong(format!("frame {first} is missing")));
            }
            for (number, column) in numbers.iter().zip(columns) {
                let Numbers::Decimals(column) = column.into_numbers() else {
                    return Err(Error::wrong("the stored numbers are no decimals"));
                };
                all.insert(*number, column.slice(own.start - first..own.end - first));
            }
            Ok(())
        },
    )?;
    Ok(all.into_values().collect())
}
