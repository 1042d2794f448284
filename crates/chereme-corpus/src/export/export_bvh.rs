//! Exports movement as BVH: captured numbers are written exactly as in the imported file.

use std::collections::BTreeMap;
use std::io::Write;
use std::ops::Range;

use chereme_formats::bvh::bvh_convert;
use chereme_formats::bvh::raw::{BvhWriteError, BvhWriter, Column, ExactDecimal, FileNumber, MotionBlock};
use chereme_motion::Clip;
use chereme_motion::column::ColumnNumbers;
use rusqlite::Connection;

use super::ExportJob;
use super::movement_form::MovementForm;
use crate::address::RecordingStretch;
use crate::error::{CorpusError, CorpusResult};
use crate::movement::{BLOCK_FRAMES, ChannelGroup, MotionTrack};
use crate::progress::ProgressReceiver;

/// Returns a note if the movement of a whole recording does not begin with it: a BVH file begins with its movement.
pub(crate) fn late_start(connection: &Connection, stretch: &RecordingStretch) -> CorpusResult<Option<String>> {
    let offset = MotionTrack::open_motion_track(connection, stretch.recording.id)?
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
pub(crate) fn write_bvh_stretch(
    connection: &Connection,
    stretch: &RecordingStretch,
    out: &mut dyn Write,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<usize> {
    let track = MotionTrack::open_motion_track(connection, stretch.recording.id)?;
    let frames = track.stretch_frames(stretch);
    if !track.is_of_bvh() {
        return write_converted_clip(&track.raw_clip(connection, frames)?, out);
    }
    let time = track.frame_time()?;
    let motion = (time.is_some() || !frames.is_empty()).then_some((time.as_ref(), frames.len() as u64));
    let fault = |error: BvhWriteError| CorpusError::from_wrong_message(format!("the BVH cannot be written: {error}"));
    let mut writer = BvhWriter::new(out, &track.hierarchy, motion).map_err(fault)?;
    // Blocks are stored whole, so that the first one may begin before the stretch.
    let mut first = frames.start - frames.start % BLOCK_FRAMES;
    while first < frames.end {
        let block_frames = first.max(frames.start)..(first + BLOCK_FRAMES).min(frames.end);
        let columns = read_bvh_columns(connection, &track, first, &block_frames)?;
        let first_frame = (block_frames.start - frames.start) as u64;
        writer
            .write_motion_block(&MotionBlock {
                first_frame,
                frames: block_frames.len(),
                columns,
            })
            .map_err(fault)?;
        progress.report_frames(&stretch.recording.name, block_frames.end - frames.start, frames.len())?;
        first += BLOCK_FRAMES;
    }
    writer.finish_bvh_writing().map_err(fault)?;
    Ok(frames.len())
}

/// The number of decimals for numbers that did not come from a BVH file.
const DEFAULT_BVH_DECIMALS: u8 = 6;

/// Writes the movement of a stretch in another form than that of the capture, in centimetres, and returns the number of
/// frames.
///
/// # Errors
/// Fails if the recording has no movement, the body does not fit, or writing fails.
pub(super) fn write_shaped_bvh(
    job: &mut ExportJob<'_, '_>,
    stretch: &RecordingStretch,
    form: &MovementForm,
) -> CorpusResult<usize> {
    let track = MotionTrack::open_motion_track(job.connection, stretch.recording.id)?;
    let movement = form.load_shaped_movement(job.connection, &track, track.stretch_frames(stretch), job.notes)?;
    job.notes
        .push("places are in centimetres, Y up, and the signer faces +Z".to_owned());
    write_converted_clip(&movement.clip_in_centimetres()?, job.out)
}

/// Writes movement from another format, with rotations as Euler angles.
fn write_converted_clip(clip: &Clip, out: &mut dyn Write) -> CorpusResult<usize> {
    // A joint that moves needs channels for its place, which the rest of a skeleton does not have.
    let hierarchy = bvh_convert::widen_hierarchy(
        &bvh_convert::hierarchy_from_skeleton(clip.clip_skeleton(), DEFAULT_BVH_DECIMALS),
        clip,
    );
    let columns = bvh_convert::columns_from_clip(clip, &hierarchy, DEFAULT_BVH_DECIMALS)
        .map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    let fault = |error: BvhWriteError| CorpusError::from_wrong_message(format!("the BVH cannot be written: {error}"));
    let time = ExactDecimal::from_rounded_value(clip.clip_frame_rate().frame_time(), 9).map(FileNumber::from);
    let motion = Some((time.as_ref(), clip.clip_frame_count() as u64));
    let mut writer = BvhWriter::new(out, &hierarchy, motion).map_err(fault)?;
    let block = MotionBlock {
        first_frame: 0,
        frames: clip.clip_frame_count(),
        columns,
    };
    writer.write_motion_block(&block).map_err(fault)?;
    writer.finish_bvh_writing().map_err(fault)?;
    Ok(clip.clip_frame_count())
}

/// Returns the columns of the frames `own` within the block that starts at frame `first`, in the order of the file.
fn read_bvh_columns(
    connection: &Connection,
    track: &MotionTrack,
    first: usize,
    own: &Range<usize>,
) -> CorpusResult<Vec<Column>> {
    let mut all: BTreeMap<usize, Column> = BTreeMap::new();
    track.take_frame_blocks(
        connection,
        &ChannelGroup::ALL_CHANNEL_GROUPS,
        own,
        |numbers, start, columns| {
            if start != first {
                return Err(CorpusError::from_wrong_message(format!("frame {first} is missing")));
            }
            for (number, column) in numbers.iter().zip(columns) {
                let ColumnNumbers::Decimals(column) = column.into_numbers() else {
                    return Err(CorpusError::from_wrong_message("the stored numbers are no decimals"));
                };
                all.insert(*number, column.slice_decimals(own.start - first..own.end - first));
            }
            Ok(())
        },
    )?;
    // The map is ordered by column, so that groups fall back into the order of the file.
    Ok(all.into_values().collect())
}
