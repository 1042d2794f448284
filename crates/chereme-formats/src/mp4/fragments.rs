//! Samples of fragmented files, which are written piece by piece.

use super::boxes::InnerBox;
use super::mp4_table::FrameListBuilder;
use super::{CodedFrame, MAX_FRAMES, Mp4Error};

/// Default properties of a track's samples, which a fragment may override.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct SampleDefaults {
    duration: u32,
    size: u32,
    flags: u32,
}

/// The time of the next sample.
#[derive(Debug, Clone, Copy)]
pub(super) struct FragmentClock(i64);

impl FragmentClock {
    /// Returns the time after `frames`, which are in the order of decoding.
    pub(super) fn clock_after_frames(frames: &[CodedFrame]) -> Self {
        let durations = frames.iter().map(|frame| i64::from(frame.duration));
        Self(durations.sum())
    }
}

/// Bit in the flags of a sample: decoding cannot begin with it.
const NOT_SYNC: u32 = 0x1_0000;

/// Reads the default properties of a track's samples in fragments.
pub(super) fn read_sample_defaults(moov: InnerBox<'_>, track: u32) -> Result<SampleDefaults, Mp4Error> {
    let Some(mvex) = moov.find_child_box(b"mvex") else {
        return Ok(SampleDefaults::default());
    };
    for trex in mvex.child_boxes(0).filter(|child| child.kind == *b"trex") {
        if trex.box_u32_at(4)? == track {
            return Ok(SampleDefaults {
                duration: trex.box_u32_at(12)?,
                size: trex.box_u32_at(16)?,
                flags: trex.box_u32_at(20)?,
            });
        }
    }
    Ok(SampleDefaults::default())
}

/// Adds the frames of a fragment that begins at byte `start` of the file.
pub(super) fn add_fragment_frames(
    moof: InnerBox<'_>,
    start: u64,
    track: u32,
    defaults: SampleDefaults,
    clock: &mut FragmentClock,
    shape: &mut FrameListBuilder,
) -> Result<(), Mp4Error> {
    for traf in moof.child_boxes(0).filter(|child| child.kind == *b"traf") {
        let header_box = traf.find_child_box(b"tfhd");
        let tfhd = header_box.ok_or_else(|| traf.inner_box_error("it has no header (tfhd)"))?;
        if tfhd.box_u32_at(4)? != track {
            continue;
        }
        let flags = tfhd.box_u32_at(0)? & 0xff_ffff;
        let mut field_start = 8;
        let mut base = start;
        if flags & 1 != 0 {
            base = tfhd.box_u64_at(field_start)?;
            field_start += 8;
        }
        if flags & 2 != 0 {
            field_start += 4;
        }
        let mut fragment_defaults = defaults;
        for (bit, value) in [
            (8, &mut fragment_defaults.duration),
            (16, &mut fragment_defaults.size),
            (32, &mut fragment_defaults.flags),
        ] {
            if flags & bit != 0 {
                *value = tfhd.box_u32_at(field_start)?;
                field_start += 4;
            }
        }
        if let Some(tfdt) = traf.find_child_box(b"tfdt") {
            let time = match tfdt.box_version()? {
                1 => tfdt.box_u64_at(4)?,
                _ => u64::from(tfdt.box_u32_at(4)?),
            };
            // Without it the fragment goes on where the one before ended.
            clock.0 = i64::try_from(time).unwrap_or(i64::MAX);
        }
        let mut next = base;
        for trun in traf.child_boxes(0).filter(|child| child.kind == *b"trun") {
            next = run(trun, base, next, fragment_defaults, clock, shape)?;
        }
    }
    Ok(())
}

/// Adds the frames of a run, and returns the byte at which the next run begins unless it states another one.
fn run(
    trun: InnerBox<'_>,
    base: u64,
    next: u64,
    own: SampleDefaults,
    clock: &mut FragmentClock,
    shape: &mut FrameListBuilder,
) -> Result<u64, Mp4Error> {
    let flags = trun.box_u32_at(0)? & 0xff_ffff;
    let count = trun.box_u32_at(4)? as usize;
    let mut field_start = 8;
    let mut offset = next;
    if flags & 1 != 0 {
        let shift = i64::from(trun.box_u32_at(field_start)?.cast_signed());
        offset = base.saturating_add_signed(shift);
        field_start += 4;
    }
    let mut first = None;
    if flags & 4 != 0 {
        first = Some(trun.box_u32_at(field_start)?);
        field_start += 4;
    }
    let columns = [0x100, 0x200, 0x400, 0x800];
    let width = 4 * columns.iter().filter(|bit| flags & **bit != 0).count();
    let sample_limit = match width {
        // The run describes no single samples: there are never more of them than bytes in the file.
        0 if own.size == 0 => 0,
        0 => (shape.end / u64::from(own.size)) as usize,
        width => trun.bytes.len().saturating_sub(field_start) / width,
    };
    for index in 0..count.min(sample_limit).min(MAX_FRAMES) {
        let mut frame = own;
        let mut shift = 0;
        for (bit, value) in
            columns
                .into_iter()
                .zip([&mut frame.duration, &mut frame.size, &mut frame.flags, &mut shift])
        {
            if flags & bit != 0 {
                *value = trun.box_u32_at(field_start)?;
                field_start += 4;
            }
        }
        if let Some(first) = first.filter(|_| index == 0 && flags & 0x400 == 0) {
            frame.flags = first;
        }
        shape.add_coded_frame(CodedFrame {
            offset,
            size: frame.size,
            sync: frame.flags & NOT_SYNC == 0,
            shown: clock.0.saturating_add(i64::from(shift.cast_signed())),
            duration: frame.duration,
            hidden: false,
        });
        offset = offset.saturating_add(u64::from(frame.size));
        clock.0 = clock.0.saturating_add(i64::from(frame.duration));
        if shape.frames.len() > MAX_FRAMES {
            break;
        }
    }
    Ok(offset)
}
