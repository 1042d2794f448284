//! Moves annotations out of the way of one that is added or moved, as the timeline of the window does.

use std::collections::BTreeSet;

use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::tier::AskedTierChange;
use chereme_sign::tier::tier_spans::{self, DragGrip, NeighbourMode, SpanItem, SpanLimits};

use super::drag_limits::{self, TierTiming};
use super::replace::annotation_item;
use super::{AnnotationChangeRun, annotation_handle};
use crate::db::stored_tiers::{self as rows, AnnotationRow, TierRow};
use crate::error::{CorpusError, CorpusResult};

impl AnnotationChangeRun<'_> {
    /// Moves an annotation and those in its way, and returns whether it did so; it does not in normal mode and on tiers
    /// whose annotations lie end to end.
    pub(super) fn moved_with_others(
        &mut self,
        row: &AnnotationRow,
        tier: &TierRow,
        span: TimeSpan,
    ) -> CorpusResult<bool> {
        let mode = self.options.mode;
        // In normal mode nothing else moves, and annotations that lie end to end have no room between them.
        if mode == NeighbourMode::Normal
            || !matches!(TierTiming::timing_of_tier(tier), TierTiming::Root | TierTiming::Inside)
        {
            return Ok(false);
        }
        let limits = self.sibling_time_limits(tier, row.parent_id)?;
        let wanted = annotation_item(row.id, span);
        let by = (wanted.start - row.start_us, wanted.end - row.end_us);
        // The rules for neighbours know only a move of the whole and of either end.
        let steps = match by {
            (start, end) if start == end => vec![(DragGrip::Whole, start)],
            (0, end) => vec![(DragGrip::End, end)],
            (start, 0) => vec![(DragGrip::Start, start)],
            // The end that moves inwards goes first, so that the other one has room.
            (start, end) if end < 0 => vec![(DragGrip::End, end), (DragGrip::Start, start)],
            (start, end) => vec![(DragGrip::Start, start), (DragGrip::End, end)],
        };
        for (grip, by) in steps {
            // The first step may have moved neighbours, so they are read again.
            let items = self.sibling_annotations(tier, row.parent_id)?;
            let chosen = BTreeSet::from([row.id]);
            let changed = tier_spans::drag_spans(&items, &chosen, grip, by, mode, limits);
            self.respan_annotations(tier, &tier_spans::order_span_changes(&items, &changed))?;
        }
        let now = rows::load_annotation_row(self.connection, row.id)?;
        // The neighbours may have stopped the annotation before its goal.
        if now.annotation_row_span() == span {
            return Ok(true);
        }
        let (start, end) = (now.start_us, now.end_us);
        let micros = RecordingInstant::from_micros;
        Err(CorpusError::from_wrong_message(format!(
            "{} cannot go from {} to {}: there is no room for the others",
            crate::address::message_names::quoted_value(row),
            span.span_start_instant(),
            span.span_end_instant()
        ))
        .with_error_place(format!("{:?}", tier.name))
        .with_advice(format!("the furthest is from {} to {}", micros(start), micros(end))))
    }

    /// Moves annotations out of the time of a new one, as the mode requires.
    pub(super) fn make_annotation_room(&mut self, tier: &TierRow, span: TimeSpan) -> CorpusResult<()> {
        let mode = self.options.mode;
        if mode == NeighbourMode::Normal
            || !matches!(TierTiming::timing_of_tier(tier), TierTiming::Root | TierTiming::Inside)
        {
            return Ok(());
        }
        let parent = match tier.parent_id {
            Some(_) => Some(self.find_parent_annotation(tier, span)?),
            None => None,
        };
        let limits = self.sibling_time_limits(tier, parent)?;
        let items = self.sibling_annotations(tier, parent)?;
        let wanted = span.span_bounds_micros();
        match tier_spans::open_span_room(&items, wanted, mode, limits) {
            Some(changed) => self.respan_annotations(tier, &tier_spans::order_span_changes(&items, &changed)),
            // The tier rules report the obstacle.
            None => Ok(()),
        }
    }

    fn respan_annotations(&mut self, tier: &TierRow, items: &[SpanItem]) -> CorpusResult<()> {
        for item in items {
            let span = TimeSpan::from_span_micros(item.start, item.end);
            let annotation = annotation_handle(item.id);
            self.carry_out_edit(tier.id, &AskedTierChange::Move { annotation, span }, None)?;
        }
        Ok(())
    }

    fn sibling_annotations(&self, tier: &TierRow, parent: Option<i64>) -> CorpusResult<Vec<SpanItem>> {
        let all = rows::load_tier_annotation_rows(self.connection, tier.id)?;
        let sibling_rows = all
            .iter()
            // Below a parent, only its own children can be in the way.
            .filter(|row| tier.parent_id.is_none() || row.parent_id == parent);
        Ok(sibling_rows
            .map(|row| annotation_item(row.id, row.annotation_row_span()))
            .collect())
    }

    fn sibling_time_limits(&mut self, tier: &TierRow, parent: Option<i64>) -> CorpusResult<SpanLimits> {
        let least = drag_limits::MIN_ANNOTATION_US;
        if let Some(parent) = parent.filter(|_| tier.parent_id.is_some()) {
            let span = rows::load_annotation_row(self.connection, parent)?.annotation_row_span();
            return Ok(SpanLimits {
                from: span.span_start_instant().instant_micros(),
                to: span.span_end_instant().instant_micros(),
                least,
            });
        }
        let scope = self.scope_of(tier.id)?;
        // A recording without movement grows with its annotations.
        let to = if scope.has_scope_movement() {
            scope.recording.duration_us
        } else {
            drag_limits::OPEN_RECORDING_END_US
        };
        Ok(SpanLimits { from: 0, to, least })
    }
}
