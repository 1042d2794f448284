//! A recording whose annotations are being changed: its clock, its tiers, and the rows near a change.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::table::annotations::Moment;
use chereme_motion::{Instant, Rate, Span};
use chereme_sign::tier::{Annotation, AnnotationId, Change, Hands, Tier, TierId, TierSet};
use rusqlite::Connection;

use super::{handle, signed, span_of, unsigned};
use crate::db::recordings::{self, RecordingRow};
use crate::db::tiers::{self as tier_rows, AnnotationRow, TierRow};
use crate::error::{Error, Result};
use crate::inventories::{self, StoredInventory};

/// How far beyond the end of the movement an annotation may end, in microseconds: files have times in milliseconds.
const LENIENCE: i64 = 1000;

/// The latest end of an annotation in a recording without movement, unless it is longer already: six hours.
const LONGEST: i64 = 6 * 3_600_000_000;

/// A recording whose annotations are being changed.
pub(super) struct Scope {
    pub(super) recording: RecordingRow,
    clock: Option<Clock>,
    tiers: Vec<TierRow>,
    /// The inventories of its tiers.
    pub(super) inventories: Vec<StoredInventory>,
    /// The time within which annotations were changed.
    pub(super) touched: Option<Span>,
}

/// The frames of a recording's movement.
struct Clock {
    offset: i64,
    rate: Rate,
    frames: usize,
}

/// The rows that are needed to plan a change.
pub(super) struct Neighbourhood {
    pub(super) set: TierSet,
    pub(super) rows: BTreeMap<i64, AnnotationRow>,
}

impl Scope {
    pub(super) fn read(connection: &Connection, recording: i64) -> Result<Self> {
        let track = recordings::body_track(connection, recording)?;
        let clock = track.and_then(|track| {
            Some(Clock {
                offset: track.offset_us,
                rate: Rate::new(track.rate_frames, track.rate_seconds).ok()?,
                frames: usize::try_from(track.frames).ok()?,
            })
        });
        Ok(Self {
            recording: recordings::recording(connection, recording)?,
            clock,
            tiers: tier_rows::tiers(connection, recording)?,
            inventories: inventories::load_of(connection, recording)?,
            touched: None,
        })
    }

    pub(super) fn touch(&mut self, span: Option<Span>) {
        self.touched = match (self.touched, span) {
            (Some(a), Some(b)) => Some(hull(a, b)),
            (a, b) => a.or(b),
        };
    }

    /// Returns whether the recording has movement, which limits its annotations.
    pub(super) fn moves(&self) -> bool {
        self.clock.is_some()
    }

    /// Makes a recording without movement as long as its annotations.
    pub(super) fn close(&self, connection: &Connection) -> Result<()> {
        match (self.touched, &self.clock) {
            (Some(touched), None) => {
                recordings::lengthen(connection, self.recording.id, touched.end().micros())
            }
            _ => Ok(()),
        }
    }

    /// Returns the time of `moment`; with `snap` the start of the nearest frame.
    pub(super) fn instant(&self, moment: Moment, snap: bool) -> Result<Instant> {
        let needs = |what: &str| {
            Error::wrong(format!(
                "the recording {:?} has no movement, and so no frames {what}",
                self.recording.name
            ))
            .advise("give times in seconds")
        };
        match (moment, snap) {
            (Moment::Time(instant), false) => Ok(instant),
            (Moment::Time(instant), true) => {
                let clock = self.clock.as_ref().ok_or_else(|| needs("to snap to"))?;
                let frame = clock.rate.frame_at(instant.shifted(-clock.offset));
                Ok(clock.start(frame.min(clock.frames)))
            }
            (Moment::Frame(frame), _) => {
                let clock = self.clock.as_ref().ok_or_else(|| needs("to count"))?;
                let frame = usize::try_from(frame).unwrap_or(usize::MAX);
                if frame > clock.frames {
                    return Err(Error::wrong(format!(
                        "frame {frame} is not there: the recording {:?} has {} frames",
                        self.recording.name, clock.frames
                    ))
                    .advise(format!(
                        "frames are counted from f0; its end is f{}",
                        clock.frames
                    )));
                }
                Ok(clock.start(frame))
            }
        }
    }

    pub(super) fn check_bounds(&self, start: Instant, end: Instant) -> Result<()> {
        let length = Instant::from_micros(self.recording.duration_us);
        let name = &self.recording.name;
        if end < start {
            return Err(Error::wrong(format!(
                "it would end at {end}, before its start at {start}"
            )));
        }
        if start < Instant::ZERO {
            return Err(Error::wrong(format!(
                "{start} is before the start of the recording {name:?}"
            ))
            .advise("times are counted from the start of the recording"));
        }
        if self.clock.is_none() && end.micros() > LONGEST.max(length.micros()) {
            return Err(Error::wrong(format!(
                "{end} is later than the recording {name:?} can be long, and it has no movement to say how long it is"
            ))
            .advise("a bare number counts in seconds; write 1500ms for milliseconds, or name a column start_ms"));
        }
        if self.clock.is_some() && end > length.shifted(LENIENCE) {
            return Err(Error::wrong(format!(
                "{end} is after the end of the recording {name:?}, which is {length} long"
            ))
            .advise("end it with the recording"));
        }
        Ok(())
    }

    /// Loads the rows for [`Change::window`]: the annotations of the changed tier and its parent near the change, all
    /// descendants of those on the changed tier, and the named annotations with their parents.
    pub(super) fn neighbourhood(
        &self,
        connection: &Connection,
        tier: i64,
        change: &Change,
    ) -> Result<Neighbourhood> {
        let mut rows = BTreeMap::new();
        let mut keep = |row: AnnotationRow| rows.insert(row.id, row);
        for id in change.annotations() {
            let row = tier_rows::annotation(connection, signed(id))?;
            if let Some(parent) = row.parent_id {
                keep(tier_rows::annotation(connection, parent)?);
            }
            keep(row);
        }
        let changed = self.tiers.iter().find(|row| row.id == tier);
        let above = changed.and_then(|row| row.parent_id);
        let named: Vec<Annotation> = rows.values().map(annotation).collect();
        if let Some(window) = change.window(&named.iter().collect::<Vec<_>>()) {
            let (start, end) = (window.start().micros(), window.end().micros());
            for tier in above.into_iter().chain([tier]) {
                for row in tier_rows::annotations_near(connection, tier, start, end)? {
                    rows.insert(row.id, row);
                }
            }
        }
        let mut open: Vec<i64> = rows
            .values()
            .filter(|row| row.tier_id == tier && self.has_tiers_below(tier))
            .map(|row| row.id)
            .collect();
        // In a damaged file annotations may be their own parents.
        let mut seen: BTreeSet<i64> = open.iter().copied().collect();
        while let Some(parent) = open.pop() {
            for child in tier_rows::children(connection, parent)? {
                if self.has_tiers_below(child.tier_id) && seen.insert(child.id) {
                    open.push(child.id);
                }
                rows.insert(child.id, child);
            }
        }
        let tiers = self.tiers.iter().map(sign_tier);
        let set = TierSet::new(tiers, rows.values().map(annotation));
        Ok(Neighbourhood { set, rows })
    }

    fn has_tiers_below(&self, tier: i64) -> bool {
        self.tiers.iter().any(|row| row.parent_id == Some(tier))
    }
}

impl Clock {
    fn start(&self, frame: usize) -> Instant {
        self.rate.instant(frame).shifted(self.offset)
    }
}

pub(super) fn hull(a: Span, b: Span) -> Span {
    Span::between(a.start().min(b.start()), a.end().max(b.end()))
}

/// Returns a stored tier in the form for the tier rules; values are checked against inventories elsewhere.
pub(super) fn sign_tier(row: &TierRow) -> Tier {
    Tier {
        id: TierId(unsigned(row.id)),
        name: row.name.clone(),
        role: row.role.clone(),
        hand: row.hand.and_then(Hands::one),
        parent: row
            .parent_id
            .map(|id| TierId(unsigned(id)))
            .zip(row.stereotype),
        vocabulary: None,
    }
}

/// Returns a stored annotation in the form for the tier rules.
pub(super) fn annotation(row: &AnnotationRow) -> Annotation {
    Annotation {
        id: handle(row.id),
        tier: TierId(unsigned(row.tier_id)),
        parent: row.parent_id.map(|id| AnnotationId(unsigned(id))),
        order: u32::try_from(row.position).unwrap_or(u32::MAX),
        span: span_of(row),
        value: row.reading(),
    }
}
