//! Moves annotations out of the way of one that is added or moved, as the timeline of the window does.

use std::collections::BTreeSet;

use chereme_motion::{Instant, Span};
use chereme_sign::tier::Change;
use chereme_sign::tier::spans::{self, Grip, Item, Limits, Mode};

use super::drag_limits::{self, TierTiming};
use super::replace::item;
use super::{Work, handle, span_of};
use crate::db::tiers::{self as rows, AnnotationRow, TierRow};
use crate::error::{Error, Result};

impl Work<'_> {
    /// Moves an annotation and those in its way, and returns whether it did so; it does not in normal mode and on tiers
    /// whose annotations lie end to end.
    pub(super) fn moved_with_others(
        &mut self,
        row: &AnnotationRow,
        tier: &TierRow,
        span: Span,
    ) -> Result<bool> {
        let mode = self.options.mode;
        if mode == Mode::Normal
            || !matches!(TierTiming::of(tier), TierTiming::Root | TierTiming::Inside)
        {
            return Ok(false);
        }
        let limits = self.limits(tier, row.parent_id)?;
        let wanted = item(row.id, span);
        let by = (wanted.start - row.start_us, wanted.end - row.end_us);
        let steps = match by {
            (start, end) if start == end => vec![(Grip::Whole, start)],
            (0, end) => vec![(Grip::End, end)],
            (start, 0) => vec![(Grip::Start, start)],
            // The end that moves inwards goes first, so that the other one has room.
            (start, end) if end < 0 => vec![(Grip::End, end), (Grip::Start, start)],
            (start, end) => vec![(Grip::Start, start), (Grip::End, end)],
        };
        for (grip, by) in steps {
            let items = self.siblings(tier, row.parent_id)?;
            let chosen = BTreeSet::from([row.id]);
            let changed = spans::dragged(&items, &chosen, (grip, by), mode, limits);
            self.respan(tier, &spans::in_order(&items, &changed))?;
        }
        let now = rows::annotation(self.connection, row.id)?;
        if span_of(&now) == span {
            return Ok(true);
        }
        let (start, end) = (now.start_us, now.end_us);
        let micros = Instant::from_micros;
        Err(Error::wrong(format!(
            "{} cannot go from {} to {}: there is no room for the others",
            super::messages::quoted_value(row),
            span.start(),
            span.end()
        ))
        .at(format!("{:?}", tier.name))
        .advise(format!(
            "the furthest is from {} to {}",
            micros(start),
            micros(end)
        )))
    }

    /// Moves annotations out of the time of a new one, as the mode requires.
    pub(super) fn make_room(&mut self, tier: &TierRow, span: Span) -> Result<()> {
        let mode = self.options.mode;
        if mode == Mode::Normal
            || !matches!(TierTiming::of(tier), TierTiming::Root | TierTiming::Inside)
        {
            return Ok(());
        }
        let parent = match tier.parent_id {
            Some(_) => Some(self.above(tier, span)?),
            None => None,
        };
        let limits = self.limits(tier, parent)?;
        let items = self.siblings(tier, parent)?;
        let wanted = (span.start().micros(), span.end().micros());
        match spans::opened(&items, wanted, mode, limits) {
            Some(changed) => self.respan(tier, &spans::in_order(&items, &changed)),
            // The tier rules report the obstacle.
            None => Ok(()),
        }
    }

    fn respan(&mut self, tier: &TierRow, items: &[Item]) -> Result<()> {
        for item in items {
            let span = Span::between(
                Instant::from_micros(item.start),
                Instant::from_micros(item.end),
            );
            let annotation = handle(item.id);
            self.carry_out(tier.id, &Change::Move { annotation, span }, None)?;
        }
        Ok(())
    }

    fn siblings(&self, tier: &TierRow, parent: Option<i64>) -> Result<Vec<Item>> {
        let all = rows::annotations(self.connection, tier.id)?;
        let own = all
            .iter()
            .filter(|row| tier.parent_id.is_none() || row.parent_id == parent);
        Ok(own.map(|row| item(row.id, span_of(row))).collect())
    }

    fn limits(&mut self, tier: &TierRow, parent: Option<i64>) -> Result<Limits> {
        let least = drag_limits::LEAST;
        if let Some(parent) = parent.filter(|_| tier.parent_id.is_some()) {
            let span = span_of(&rows::annotation(self.connection, parent)?);
            return Ok(Limits {
                from: span.start().micros(),
                to: span.end().micros(),
                least,
            });
        }
        let scope = self.scope_of(tier.id)?;
        let to = if scope.moves() {
            scope.recording.duration_us
        } else {
            drag_limits::FAR
        };
        Ok(Limits { from: 0, to, least })
    }
}
