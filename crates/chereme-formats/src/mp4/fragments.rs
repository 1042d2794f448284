//! Samples of fragmented files, which are written piece by piece.

use super::boxes::Inner;
use super::table::Shape;
use super::{Error, Frame, MAX_FRAMES};

/// Default properties of a track's samples, which a fragment may override.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Defaults {
    duration: u32,
    size: u32,
    flags: u32,
}

/// The time of the next sample.
#[derive(Debug, Clone, Copy)]
pub(super) struct Clock(i64);

impl Clock {
    /// Returns the time after `frames`, which are in the order of decoding.
    pub(super) fn after(frames: &[Frame]) -> Self {
        let durations = frames.iter().map(|frame| i64::from(frame.duration));
        Self(durations.sum())
    }
}

/// Bit in the flags of a sample: decoding cannot begin with it.
const NOT_SYNC: u32 = 0x1_0000;

/// Reads the default properties of a track's samples in fragments.
pub(super) fn defaults(moov: Inner<'_>, track: u32) -> Result<Defaults, Error> {
    let Some(mvex) = moov.child(b"mvex") else {
        return Ok(Defaults::default());
    };
    for trex in mvex.children(0).filter(|it| it.kind == *b"trex") {
        if trex.number(4)? == track {
            return Ok(Defaults {
                duration: trex.number(12)?,
                size: trex.number(16)?,
                flags: trex.number(20)?,
            });
        }
    }
    Ok(Defaults::default())
}

/// Adds the frames of a fragment that begins at byte `start` of the file.
pub(super) fn frames(
    moof: Inner<'_>,
    start: u64,
    (track, defaults): (u32, Defaults),
    clock: &mut Clock,
    shape: &mut Shape,
) -> Result<(), Error> {
    for traf in moof.children(0).filter(|it| it.kind == *b"traf") {
        let tfhd = traf.child(b"tfhd");
        let tfhd = tfhd.ok_or_else(|| traf.fault("it has no header (tfhd)"))?;
        if tfhd.number(4)? != track {
            continue;
        }
        let flags = tfhd.number(0)? & 0xff_ffff;
        let mut at = 8;
        let mut base = start;
        if flags & 1 != 0 {
            base = tfhd.long(at)?;
            at += 8;
        }
        if flags & 2 != 0 {
            at += 4;
        }
        let mut own = defaults;
        for (bit, value) in [
            (8, &mut own.duration),
            (16, &mut own.size),
            (32, &mut own.flags),
        ] {
            if flags & bit != 0 {
                *value = tfhd.number(at)?;
                at += 4;
            }
        }
        if let Some(tfdt) = traf.child(b"tfdt") {
            let time = match tfdt.version()? {
                1 => tfdt.long(4)?,
                _ => u64::from(tfdt.number(4)?),
            };
            clock.0 = i64::try_from(time).unwrap_or(i64::MAX);
        }
        let mut next = base;
        for trun in traf.children(0).filter(|it| it.kind == *b"trun") {
            next = run(trun, (base, next), own, clock, shape)?;
        }
    }
    Ok(())
}

/// Adds the frames of a run, and returns the byte at which the next run begins unless it states another one.
fn run(
    trun: Inner<'_>,
    (base, next): (u64, u64),
    own: Defaults,
    clock: &mut Clock,
    shape: &mut Shape,
) -> Result<u64, Error> {
    let flags = trun.number(0)? & 0xff_ffff;
    let count = trun.number(4)? as usize;
    let mut at = 8;
    let mut offset = next;
    if flags & 1 != 0 {
        let shift = i64::from(trun.number(at)?.cast_signed());
        offset = base.saturating_add_signed(shift);
        at += 4;
    }
    let mut first = None;
    if flags & 4 != 0 {
        first = Some(trun.number(at)?);
        at += 4;
    }
    let columns = [0x100, 0x200, 0x400, 0x800];
    let width = 4 * columns.iter().filter(|bit| flags & **bit != 0).count();
    let held = match width {
        // The run describes no single samples: there are never more of them than bytes in the file.
        0 if own.size == 0 => 0,
        0 => (shape.end / u64::from(own.size)) as usize,
        width => trun.bytes.len().saturating_sub(at) / width,
    };
    for index in 0..count.min(held).min(MAX_FRAMES) {
        let mut frame = own;
        let mut shift = 0;
        for (bit, value) in columns.into_iter().zip([
            &mut frame.duration,
            &mut frame.size,
            &mut frame.flags,
            &mut shift,
        ]) {
            if flags & bit != 0 {
                *value = trun.number(at)?;
                at += 4;
            }
        }
        if let Some(first) = first.filter(|_| index == 0 && flags & 0x400 == 0) {
            frame.flags = first;
        }
        shape.add(Frame {
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
