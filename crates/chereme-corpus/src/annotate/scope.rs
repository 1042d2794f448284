//! A recording whose annotations are being changed: its clock, its tiers, and the rows near a change.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::table::annotations::TableMoment;
use chereme_motion::{FrameRate, RecordingInstant, TimeSpan};
use chereme_sign::tier::{AnnotatedHands, AnnotationId, AskedTierChange, Tier, TierAnnotation, TierId, TierSet};
use rusqlite::Connection;

use super::{annotation_handle, annotation_row_id, unsigned};
use crate::db::stored_recordings::{self, RecordingRow};
use crate::db::stored_tiers::{self as tier_rows, AnnotationRow, TierRow};
use crate::error::{CorpusError, CorpusResult};
use crate::inventories::{self, StoredInventory};

/// How far beyond the end of the movement an annotation may end, in microseconds: files have times in milliseconds.
const FILE_TIME_TOLERANCE_US: i64 = 1000;

/// The latest end of an annotation in a recording without movement, unless it is longer already: six hours.
const MAX_ANNOTATION_END_US: i64 = 6 * 3_600_000_000;

/// A recording whose annotations are being changed.
pub(super) struct AnnotationScope {
    pub(super) recording: RecordingRow,
    clock: Option<MovementClock>,
    tiers: Vec<TierRow>,
    /// The inventories of its tiers.
    pub(super) inventories: Vec<StoredInventory>,
    /// The time within which annotations were changed.
    pub(super) touched: Option<TimeSpan>,
}

/// The frames of a recording's movement.
struct MovementClock {
    offset: i64,
    rate: FrameRate,
    frames: usize,
}

/// The rows that are needed to plan a change.
pub(super) struct ChangeNeighbourhood {
    pub(super) set: TierSet,
    pub(super) rows: BTreeMap<i64, AnnotationRow>,
}

impl AnnotationScope {
    pub(super) fn read_annotation_scope(connection: &Connection, recording: i64) -> CorpusResult<Self> {
        let track = stored_recordings::body_track(connection, recording)?;
        let clock = track.and_then(|track| {
            Some(MovementClock {
                offset: track.offset_us,
                rate: FrameRate::new(track.rate_frames, track.rate_seconds).ok()?,
                frames: usize::try_from(track.frames).ok()?,
            })
        });
        Ok(Self {
            recording: stored_recordings::load_recording_row(connection, recording)?,
            clock,
            tiers: tier_rows::load_tier_rows(connection, recording)?,
            inventories: inventories::load_of(connection, recording)?,
            touched: None,
        })
    }

    pub(super) fn extend_touched_span(&mut self, span: Option<TimeSpan>) {
        self.touched = match (self.touched, span) {
            (Some(a), Some(b)) => Some(a.enclosing_span(b)),
            (a, b) => a.or(b),
        };
    }

    /// Returns whether the recording has movement, which limits its annotations.
    pub(super) fn has_scope_movement(&self) -> bool {
        self.clock.is_some()
    }

    /// Makes a recording without movement as long as its annotations.
    pub(super) fn close_annotation_scope(&self, connection: &Connection) -> CorpusResult<()> {
        match (self.touched, &self.clock) {
            (Some(touched), None) => stored_recordings::lengthen_recording(
                connection,
                self.recording.id,
                touched.span_end_instant().instant_micros(),
            ),
            _ => Ok(()),
        }
    }

    /// Returns the time of `moment`; with `snap` the start of the nearest frame.
    pub(super) fn resolve_moment(&self, moment: TableMoment, snap: bool) -> CorpusResult<RecordingInstant> {
        let needs = |what: &str| {
            CorpusError::from_wrong_message(format!(
                "the recording {:?} has no movement, and so no frames {what}",
                self.recording.name
            ))
            .with_advice("give times in seconds")
        };
        match (moment, snap) {
            (TableMoment::Time(instant), false) => Ok(instant),
            (TableMoment::Time(instant), true) => {
                let clock = self.clock.as_ref().ok_or_else(|| needs("to snap to"))?;
                let frame = clock.rate.nearest_frame_at(instant.shifted_instant(-clock.offset));
                // The end of the last frame is a time that annotations may have.
                Ok(clock.movement_frame_start(frame.min(clock.frames)))
            }
            (TableMoment::Frame(frame), _) => {
                let clock = self.clock.as_ref().ok_or_else(|| needs("to count"))?;
                let frame = usize::try_from(frame).unwrap_or(usize::MAX);
                if frame > clock.frames {
                    return Err(CorpusError::from_wrong_message(format!(
                        "frame {frame} is not there: the recording {:?} has {} frames",
                        self.recording.name, clock.frames
                    ))
                    .with_advice(format!("frames are counted from f0; its end is f{}", clock.frames)));
                }
                Ok(clock.movement_frame_start(frame))
            }
        }
    }

    pub(super) fn check_bounds(&self, start: RecordingInstant, end: RecordingInstant) -> CorpusResult<()> {
        let length = RecordingInstant::from_micros(self.recording.duration_us);
        let name = &self.recording.name;
        if end < start {
            return Err(CorpusError::from_wrong_message(format!(
                "it would end at {end}, before its start at {start}"
            )));
        }
        if start < RecordingInstant::RECORDING_START {
            return Err(CorpusError::from_wrong_message(format!(
                "{start} is before the start of the recording {name:?}"
            ))
            .with_advice("times are counted from the start of the recording"));
        }
        // Such a time is most likely a number in another unit.
        if self.clock.is_none() && end.instant_micros() > MAX_ANNOTATION_END_US.max(length.instant_micros()) {
            return Err(CorpusError::from_wrong_message(format!(
                "{end} is later than the recording {name:?} can be long, and it has no movement to say how long it is"
            ))
            .with_advice("a bare number counts in seconds; write 1500ms for milliseconds, or name a column start_ms"));
        }
        if self.clock.is_some() && end > length.shifted_instant(FILE_TIME_TOLERANCE_US) {
            return Err(CorpusError::from_wrong_message(format!(
                "{end} is after the end of the recording {name:?}, which is {length} long"
            ))
            .with_advice("end it with the recording"));
        }
        Ok(())
    }

    /// Loads the rows for [`ChangesetLine::change_window`]: the annotations of the changed tier and its parent near the change, all
    /// descendants of those on the changed tier, and the named annotations with their parents.
    pub(super) fn load_change_neighbourhood(
        &self,
        connection: &Connection,
        tier: i64,
        change: &AskedTierChange,
    ) -> CorpusResult<ChangeNeighbourhood> {
        let mut rows = BTreeMap::new();
        let mut keep = |row: AnnotationRow| rows.insert(row.id, row);
        for id in change.changed_annotations() {
            let row = tier_rows::load_annotation_row(connection, annotation_row_id(id))?;
            if let Some(parent) = row.parent_id {
                keep(tier_rows::load_annotation_row(connection, parent)?);
            }
            keep(row);
        }
        let changed = self.tiers.iter().find(|row| row.id == tier);
        let above = changed.and_then(|row| row.parent_id);
        let named: Vec<TierAnnotation> = rows.values().map(rule_annotation_from_row).collect();
        if let Some(window) = change.change_window(&named.iter().collect::<Vec<_>>()) {
            let (start, end) = window.span_bounds_micros();
            for tier in above.into_iter().chain([tier]) {
                for row in tier_rows::annotations_near(connection, tier, start, end)? {
                    rows.insert(row.id, row);
                }
            }
        }
        let mut open: Vec<i64> = rows
            .values()
            // Without tiers below there are no children to look for, which spares a query for each row.
            .filter(|row| row.tier_id == tier && self.has_tiers_below(tier))
            .map(|row| row.id)
            .collect();
        // In a damaged file annotations may be their own parents.
        let mut seen: BTreeSet<i64> = open.iter().copied().collect();
        while let Some(parent) = open.pop() {
            for child in tier_rows::load_child_annotations(connection, parent)? {
                if self.has_tiers_below(child.tier_id) && seen.insert(child.id) {
                    open.push(child.id);
                }
                rows.insert(child.id, child);
            }
        }
        let tiers = self.tiers.iter().map(sign_tier);
        let set = TierSet::new(tiers, rows.values().map(rule_annotation_from_row));
        Ok(ChangeNeighbourhood { set, rows })
    }

    fn has_tiers_below(&self, tier: i64) -> bool {
        self.tiers.iter().any(|row| row.parent_id == Some(tier))
    }
}

impl MovementClock {
    fn movement_frame_start(&self, frame: usize) -> RecordingInstant {
        self.rate.frame_start_instant(frame).shifted_instant(self.offset)
    }
}

/// Returns a stored tier in the form for the tier rules; values are checked against inventories elsewhere.
pub(super) fn sign_tier(row: &TierRow) -> Tier {
    Tier {
        id: TierId(unsigned(row.id)),
        name: row.name.clone(),
        role: row.role.clone(),
        hand: row.hand.and_then(AnnotatedHands::single_hand),
        parent: row.parent_id.map(|id| TierId(unsigned(id))).zip(row.stereotype),
        vocabulary: None,
    }
}

/// Returns a stored annotation in the form for the tier rules.
pub(super) fn rule_annotation_from_row(row: &AnnotationRow) -> TierAnnotation {
    TierAnnotation {
        id: annotation_handle(row.id),
        tier: TierId(unsigned(row.tier_id)),
        parent: row.parent_id.map(|id| AnnotationId(unsigned(id))),
        order: u32::try_from(row.position).unwrap_or(u32::MAX),
        span: row.annotation_row_span(),
        value: row.annotation_reading(),
    }
}
