//! Corrections of a signer's finger angles, relative to the straightest and most bent postures in the signer's takes.

use std::cell::RefCell;
use std::collections::BTreeMap;

use chereme_motion::{HandCorrection, HandRange, Side};
use rusqlite::Connection;

use crate::Corpus;
use crate::address::{self, Name};
use crate::db::columns::Origin;
use crate::db::contents::generation;
use crate::db::recordings::{self, RecordingRow};
use crate::error::Result;
use crate::movement::{BLOCK_FRAMES, ChannelGroup, Track};

/// The largest number of a signer's takes that are read.
const TAKES: usize = 12;
/// The number of blocks of frames that are read from a take, evenly spaced over it.
const BLOCKS: usize = 8;
/// The frames per second that are read.
const RATE: f64 = 30.0;

/// Cache of the corrections, with the generation of the corpus for which they are valid.
#[derive(Debug, Default)]
pub(crate) struct Kept {
    generation: i64,
    found: BTreeMap<i64, [HandCorrection; 2]>,
}

impl Corpus {
    /// Returns the corrections for the angles of the right and left fingers of a recording, which are applied before
    /// handshapes are read from them. They follow from the straightest and the most bent posture of each finger over
    /// the captured takes of the same signer on the same skeleton, or over the take alone if its signer is unknown.
    /// Generated movement is not corrected.
    ///
    /// # Errors
    /// Fails if there is no such recording, or rows or blocks are damaged.
    pub fn hand_corrections(&self, recording: &Name) -> Result<[HandCorrection; 2]> {
        let connection = self.store.read();
        let row = address::recording(connection, recording)?;
        corrections(connection, &self.hands, &row)
    }
}

/// Returns the corrections of a recording; they are cached until the corpus changes.
pub(crate) fn corrections(
    connection: &Connection,
    kept: &RefCell<Kept>,
    row: &RecordingRow,
) -> Result<[HandCorrection; 2]> {
    if row.origin == Origin::Made {
        return Ok([HandCorrection::default(); 2]);
    }
    let now = generation(connection)?;
    let mut kept = kept.borrow_mut();
    if kept.generation != now {
        *kept = Kept {
            generation: now,
            found: BTreeMap::new(),
        };
    }
    if let Some(found) = kept.found.get(&row.id) {
        return Ok(*found);
    }
    let own = Track::of(connection, row.id)?;
    let mut ranges = [HandRange::default(), HandRange::default()];
    observe(connection, &own, &mut ranges)?;
    let mut takes = 1;
    if row.signer_id.is_some() {
        for other in recordings::recordings(connection)? {
            let same = other.signer_id == row.signer_id && other.origin != Origin::Made;
            if takes == TAKES || other.id == row.id || !same {
                continue;
            }
            if recordings::body_track(connection, other.id)?
                .is_some_and(|track| track.skeleton_id == own.row.skeleton_id)
            {
                observe(connection, &Track::of(connection, other.id)?, &mut ranges)?;
                takes += 1;
            }
        }
    }
    let found = ranges.map(|range| range.correction());
    kept.found.insert(row.id, found);
    Ok(found)
}

/// Adds a take to the ranges, without odd frames at its ends.
fn observe(connection: &Connection, track: &Track, ranges: &mut [HandRange; 2]) -> Result<()> {
    let anatomy = track.anatomy(connection)?;
    if Side::BOTH.iter().all(|&side| !anatomy.has_fingers(side)) {
        return Ok(());
    }
    let mut sound = 0..track.frames();
    for odd in track.odd_frames(connection, &anatomy)? {
        if odd.frames.start <= sound.start {
            sound.start = sound.start.max(odd.frames.end);
        } else {
            sound.end = sound.end.min(odd.frames.start);
        }
    }
    let step = (track.rate.per_second() / RATE).round().max(1.0) as usize;
    let parts = sound.len().div_ceil(BLOCK_FRAMES).min(BLOCKS);
    for part in 0..parts {
        let room = sound.len().saturating_sub(BLOCK_FRAMES);
        let start = sound.start + room * part / (parts - 1).max(1);
        let frames = start..(start + BLOCK_FRAMES).min(sound.end);
        let groups = [ChannelGroup::RightHand, ChannelGroup::LeftHand];
        let clip = track.clip(connection, frames, &groups)?;
        for (side, range) in Side::BOTH.into_iter().zip(ranges.iter_mut()) {
            range.observe(&clip, &anatomy, side, step);
        }
    }
    Ok(())
}
