//! The tables of samples: sizes, places, times.

use super::boxes::{self, InnerBox};
use super::{CodedFrame, MAX_FRAMES, Mp4Error};

/// The effect of the edit list of a track on its clock.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct TrackEdit {
    /// The delay before the film begins, in ticks.
    pub(super) delay: i64,
    /// The time in the track at which the film begins.
    pub(super) from: i64,
    /// The time in the track at which the film ends.
    pub(super) until: Option<i64>,
}

/// Frames under construction.
#[derive(Debug)]
pub(super) struct FrameListBuilder {
    /// The length of the file in bytes.
    pub(super) end: u64,
    pub(super) edit: TrackEdit,
    /// The frames, with times in the track.
    pub(super) frames: Vec<CodedFrame>,
    /// The number of frames that lie beyond the end of the file.
    pub(super) beyond: usize,
}

impl FrameListBuilder {
    /// Adds a frame if it lies inside the file, and counts it otherwise.
    pub(super) fn add_coded_frame(&mut self, frame: CodedFrame) {
        let to = frame.offset.checked_add(u64::from(frame.size));
        if to.is_some_and(|to| to <= self.end) && frame.size > 0 {
            self.frames.push(frame);
        } else {
            self.beyond += 1;
        }
    }
}

/// Returns the frames with times from the start of the film, after the edit list.
pub(super) fn frames_after_edit(shape: FrameListBuilder) -> Vec<CodedFrame> {
    let TrackEdit { delay, from, until } = shape.edit;
    let mut frames = shape.frames;
    for frame in &mut frames {
        let before = frame.shown.saturating_add(i64::from(frame.duration)) <= from;
        frame.hidden = before || until.is_some_and(|until| frame.shown >= until);
        frame.shown = frame.shown.saturating_sub(from).saturating_add(delay);
    }
    // Without any sync frame decoding begins at the first.
    if !frames.iter().any(|frame| frame.sync)
        && let Some(first) = frames.first_mut()
    {
        first.sync = true;
    }
    frames
}

/// A table that holds a value for each run of frames.
struct RunLengthTable<'a> {
    rows: Vec<&'a [u8]>,
    row: usize,
    used: u32,
}

impl<'a> RunLengthTable<'a> {
    fn from_run_table(table: Option<InnerBox<'a>>) -> Result<Self, Mp4Error> {
        let rows = match table {
            Some(table) => table.box_table_rows(4, 8)?.collect(),
            None => Vec::new(),
        };
        Ok(Self { rows, row: 0, used: 0 })
    }

    /// Returns the value of the next frame.
    fn next(&mut self) -> Option<u32> {
        loop {
            let row = self.rows.get(self.row)?;
            let count = boxes::bytes_u32_at(row, 0)?;
            if self.used < count {
                self.used += 1;
                return boxes::bytes_u32_at(row, 4);
            }
            self.row += 1;
            self.used = 0;
        }
    }
}

/// Adds the frames that a table of samples lists.
pub(super) fn add_sample_frames(stbl: InnerBox<'_>, shape: &mut FrameListBuilder) -> Result<(), Mp4Error> {
    let sizes = match stbl.find_child_box(b"stsz") {
        Some(stsz) => {
            let (each, count) = (stsz.box_u32_at(4)?, stsz.box_u32_at(8)? as usize);
            if count > MAX_FRAMES {
                return Err(Mp4Error::Limit {
                    what: "frames",
                    found: count as u64,
                    most: MAX_FRAMES as u64,
                });
            }
            match each {
                0 => stsz
                    .box_table_rows(8, 4)?
                    .filter_map(|row| boxes::bytes_u32_at(row, 0))
                    .collect(),
                // One size for all frames: there are never more of them than bytes in the file.
                each => vec![each; count.min((shape.end / u64::from(each)) as usize + 1)],
            }
        }
        None => small_sizes(stbl)?,
    };
    if sizes.is_empty() {
        return Ok(());
    }
    let offsets = offsets(stbl, &sizes)?;
    let mut durations = RunLengthTable::from_run_table(stbl.find_child_box(b"stts"))?;
    let mut shifts = RunLengthTable::from_run_table(stbl.find_child_box(b"ctts"))?;
    let sync: Option<Vec<u32>> = match stbl.find_child_box(b"stss") {
        Some(stss) => {
            let rows = stss.box_table_rows(4, 4)?;
            Some(rows.filter_map(|row| boxes::bytes_u32_at(row, 0)).collect())
        }
        None => None,
    };
    shape.beyond += sizes.len().saturating_sub(offsets.len());
    let (mut time, mut last) = (0_i64, 0);
    for (at, (size, offset)) in sizes.iter().zip(offsets).enumerate() {
        // A table that is too short goes on with its last value.
        let duration = durations.next().unwrap_or(last);
        last = duration;
        // In version 0 shifts are positive, but cameras write negative ones all the same.
        let shift = shifts.next().unwrap_or_default().cast_signed();
        let number = at as u32 + 1;
        let is_sync = |sync: &Vec<u32>| sync.binary_search(&number).is_ok();
        shape.add_coded_frame(CodedFrame {
            offset,
            size: *size,
            sync: sync.as_ref().is_none_or(is_sync),
            shown: time.saturating_add(i64::from(shift)),
            duration,
            hidden: false,
        });
        time = time.saturating_add(i64::from(duration));
    }
    Ok(())
}

/// Reads sizes of 4, 8 or 16 bits (`stz2`).
fn small_sizes(stbl: InnerBox<'_>) -> Result<Vec<u32>, Mp4Error> {
    let Some(stz2) = stbl.find_child_box(b"stz2") else {
        return Ok(Vec::new());
    };
    let (bits, count) = (stz2.box_u32_at(4)? & 0xff, stz2.box_u32_at(8)? as usize);
    let bytes = stz2.bytes.get(12..).unwrap_or_default();
    Ok(match bits {
        4 => {
            let pairs = bytes.iter().flat_map(|byte| [byte >> 4, byte & 15]);
            pairs.map(u32::from).take(count).collect()
        }
        8 => bytes.iter().map(|byte| u32::from(*byte)).take(count).collect(),
        16 => {
            let pairs = bytes.chunks_exact(2);
            let sizes = pairs.map(|pair| u32::from(pair[0]) << 8 | u32::from(pair[1]));
            sizes.take(count).collect()
        }
        _ => return Err(stz2.inner_box_error("sizes have neither 4 nor 8 nor 16 bits")),
    })
}

/// Returns the byte at which each sample begins.
fn offsets(stbl: InnerBox<'_>, sizes: &[u32]) -> Result<Vec<u64>, Mp4Error> {
    let chunks: Vec<u64> = match (stbl.find_child_box(b"stco"), stbl.find_child_box(b"co64")) {
        (Some(stco), _) => {
            let rows = stco.box_table_rows(4, 4)?;
            rows.filter_map(|row| boxes::bytes_u32_at(row, 0).map(u64::from))
                .collect()
        }
        (None, Some(co64)) => {
            let rows = co64.box_table_rows(4, 8)?;
            rows.filter_map(|row| boxes::bytes_u64_at(row, 0)).collect()
        }
        (None, None) => {
            return Err(stbl.inner_box_error("it does not say where samples lie (stco)"));
        }
    };
    let chunk_table = stbl.find_child_box(b"stsc");
    let stsc = chunk_table.ok_or_else(|| stbl.inner_box_error("it does not say how samples lie together (stsc)"))?;
    let rows: Vec<(u32, u32)> = stsc
        .box_table_rows(4, 12)?
        .filter_map(|row| Some((boxes::bytes_u32_at(row, 0)?, boxes::bytes_u32_at(row, 4)?)))
        .collect();
    let mut offsets = Vec::with_capacity(sizes.len());
    let mut row = 0;
    for (index, chunk) in chunks.iter().enumerate() {
        let number = index as u64 + 1;
        // A row names the first chunk for which it holds.
        while rows.get(row + 1).is_some_and(|next| u64::from(next.0) <= number) {
            row += 1;
        }
        let sample_count = rows.get(row).map_or(0, |entry| entry.1) as usize;
        let mut sample_start = *chunk;
        for _ in 0..sample_count {
            let Some(size) = sizes.get(offsets.len()) else {
                return Ok(offsets);
            };
            offsets.push(sample_start);
            sample_start = sample_start.saturating_add(u64::from(*size));
        }
    }
    Ok(offsets)
}
