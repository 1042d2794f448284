//! Computes the new spans of a tier's annotations when some are moved or one is resized: plain functions over spans.
//!
//! Annotations never overlap or get lost: in normal mode a dragged annotation stops at its neighbours, bulldozer mode
//! pushes them as far as necessary, and shift mode moves all later ones, too.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

/// An annotation as a span in microseconds; those of a tier do not overlap and are in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SpanItem {
    /// Its number.
    pub id: i64,
    /// Its start.
    pub start: i64,
    /// Its end: the first microsecond after it.
    pub end: i64,
}

/// The effect of a change on the neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum NeighbourMode {
    /// They stay: a moved annotation takes the nearest free place, a resized one stops at them.
    #[default]
    Normal,
    /// They are pushed along as far as necessary.
    Bulldozer,
    /// All later annotations move too; all earlier ones if the start is resized.
    Shift,
}

/// The part of an annotation that is dragged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DragGrip {
    /// Its start.
    Start,
    /// Its end.
    End,
    /// The whole annotation.
    Whole,
}

/// The limits of every annotation: its earliest start, its latest end, and its shortest length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SpanLimits {
    /// The earliest start, in microseconds.
    pub from: i64,
    /// The latest end, in microseconds.
    pub to: i64,
    /// The least length of an annotation, in microseconds.
    pub least: i64,
}

/// Returns the changed annotations, with their new spans, when the `chosen` ones are moved by `by` microseconds, or a
/// boundary of the first chosen one.
#[must_use]
pub fn drag_spans(
    items: &[SpanItem],
    chosen: &BTreeSet<i64>,
    grip: DragGrip,
    by: i64,
    mode: NeighbourMode,
    limits: SpanLimits,
) -> Vec<SpanItem> {
    let (Some(first), Some(last)) = (items.first(), items.last()) else {
        return Vec::new();
    };
    // Annotations that already lie beyond the limits must not be squeezed.
    let limits = SpanLimits {
        from: limits.from.min(first.start),
        to: limits.to.max(last.end),
        ..limits
    };
    let Some(at) = items.iter().position(|item| chosen.contains(&item.id)) else {
        return Vec::new();
    };
    let new = match grip {
        DragGrip::End => resized(items, at, by, mode, limits),
        DragGrip::Start => {
            let mirrored_index = items.len() - 1 - at;
            mirror_items(&resized(
                &mirror_items(items),
                mirrored_index,
                -by,
                mode,
                limits.mirror_limits(),
            ))
        }
        DragGrip::Whole => move_chosen_items(items, chosen, at, by, mode, limits),
    };
    let changed = items.iter().zip(new).filter(|(old, new)| *old != new);
    changed.map(|(_, new)| new).collect()
}

/// Returns the changed annotations on a tier whose annotations tile their parent: the neighbour's boundary moves too.
/// Empty if the outermost start or end, or a whole annotation, is dragged.
#[must_use]
pub fn drag_tiled_spans(
    items: &[SpanItem],
    chosen: &BTreeSet<i64>,
    grip: DragGrip,
    by: i64,
    limits: SpanLimits,
) -> Vec<SpanItem> {
    let chosen_index = items.iter().position(|item| chosen.contains(&item.id));
    let index_pair = match (grip, chosen_index) {
        (DragGrip::End, Some(at)) => Some((at, at + 1)),
        (DragGrip::Start, Some(at)) => at.checked_sub(1).map(|before| (before, at)),
        _ => None,
    };
    let pair = index_pair.and_then(|(a, b)| Some((*items.get(a)?, *items.get(b)?)));
    let Some((left, right)) = pair else {
        return Vec::new();
    };
    // An annotation that is already shorter than the least length may stay so.
    let least = limits
        .least
        .min(left.end - left.start)
        .min(right.end - right.start)
        .max(1);
    let end = (left.end + by).clamp(left.start + least, right.end - least);
    if end == left.end {
        return Vec::new();
    }
    vec![SpanItem { end, ..left }, SpanItem { start: end, ..right }]
}

/// Returns the annotations that make room for a new one at `wanted`, with their new spans: those that start at or after
/// its start, each as far as it must in bulldozer mode, all by the same time in shift mode. `None` if an annotation
/// that begins earlier is in the way, if there is no room at the end, or in normal mode.
#[must_use]
pub fn open_span_room(
    items: &[SpanItem],
    wanted: (i64, i64),
    mode: NeighbourMode,
    limits: SpanLimits,
) -> Option<Vec<SpanItem>> {
    let index = items.partition_point(|item| item.start < wanted.0);
    let reaches_in = index > 0 && items[index - 1].end > wanted.0;
    if mode == NeighbourMode::Normal || reaches_in || wanted.1 > limits.to.max(wanted.0) {
        return None;
    }
    let mut new = items[index..].to_vec();
    let mut edge = wanted.1;
    // All move as far as the first one must.
    let all_by = new.first().map_or(0, |next| (wanted.1 - next.start).max(0));
    for item in &mut new {
        let by = match mode {
            NeighbourMode::Shift => all_by,
            _ => (edge - item.start).max(0),
        };
        *item = shift_item(*item, by);
        edge = item.end;
    }
    if edge > limits.to {
        return None;
    }
    let changed = items[index..].iter().zip(new).filter(|(old, new)| *old != new);
    Some(changed.map(|(_, new)| new).collect())
}

/// Returns changed annotations in an order in which no two overlap at any step: first those that move right, from the
/// last on, then those that move left, from the first on.
#[must_use]
pub fn order_span_changes(items: &[SpanItem], changed: &[SpanItem]) -> Vec<SpanItem> {
    let right = |new: &SpanItem| {
        let old = items.iter().find(|old| old.id == new.id);
        old.is_some_and(|old| new.start > old.start || new.end > old.end)
    };
    let (mut later, mut earlier): (Vec<SpanItem>, Vec<SpanItem>) = changed.iter().partition(|new| right(new));
    later.sort_by_key(|item| -item.start);
    earlier.sort_by_key(|item| item.start);
    later.extend(earlier);
    later
}

/// Returns the longest part of `from..to` without annotations.
#[must_use]
pub fn longest_free_span(items: &[SpanItem], from: i64, to: i64) -> Option<(i64, i64)> {
    let first = items.partition_point(|item| item.end <= from);
    let inside = items[first..].iter().take_while(|item| item.start < to);
    let mut begin = from;
    let mut best: Option<(i64, i64)> = None;
    let mut take = |start: i64, end: i64| {
        if end > start && best.is_none_or(|(a, b)| end - start > b - a) {
            best = Some((start, end));
        }
    };
    for item in inside {
        take(begin, item.start);
        begin = begin.max(item.end);
    }
    take(begin, to);
    best
}

impl SpanLimits {
    fn mirror_limits(self) -> Self {
        Self {
            from: -self.to,
            to: -self.from,
            ..self
        }
    }
}

/// Reverses time, so that a rule for ends can be applied to starts.
fn mirror_items(items: &[SpanItem]) -> Vec<SpanItem> {
    let turned = items.iter().rev().map(|item| SpanItem {
        start: -item.end,
        end: -item.start,
        ..*item
    });
    turned.collect()
}

fn shift_item(item: SpanItem, by: i64) -> SpanItem {
    SpanItem {
        start: item.start + by,
        end: item.end + by,
        ..item
    }
}

/// Moves the end of the annotation at `at`.
fn resized(items: &[SpanItem], at: usize, by: i64, mode: NeighbourMode, limits: SpanLimits) -> Vec<SpanItem> {
    let item = items[at];
    let least = limits.least.min(item.end - item.start).max(1);
    let end = (item.end + by).max(item.start + least);
    let mut new = items.to_vec();
    match mode {
        NeighbourMode::Normal => {
            let wall = items.get(at + 1).map_or(limits.to, |next| next.start);
            new[at].end = end.min(wall);
        }
        NeighbourMode::Bulldozer => {
            // All later annotations must still fit behind it.
            let inside = items[at + 1..].iter().map(|item| item.end - item.start);
            new[at].end = end.min(limits.to - inside.sum::<i64>());
            push_items_along(&mut new, at);
        }
        NeighbourMode::Shift => {
            let by = (end - item.end).min(limits.to - items[items.len() - 1].end);
            new[at].end += by;
            for other in &mut new[at + 1..] {
                *other = shift_item(*other, by);
            }
        }
    }
    new
}

/// Pushes the annotations after `at` along as far as necessary.
fn push_items_along(items: &mut [SpanItem], at: usize) {
    for next in at + 1..items.len() {
        let by = items[next - 1].end - items[next].start;
        if by > 0 {
            items[next] = shift_item(items[next], by);
        }
    }
}

/// Moves the chosen annotations, the first of them at `at`.
fn move_chosen_items(
    items: &[SpanItem],
    chosen: &BTreeSet<i64>,
    at: usize,
    by: i64,
    mode: NeighbourMode,
    limits: SpanLimits,
) -> Vec<SpanItem> {
    if mode == NeighbourMode::Shift {
        let before = at.checked_sub(1).map_or(limits.from, |at| items[at].end);
        let last = items[items.len() - 1].end;
        let by = by.clamp(before - items[at].start, limits.to - last);
        let moved = |(n, item): (usize, &SpanItem)| if n < at { *item } else { shift_item(*item, by) };
        return items.iter().enumerate().map(moved).collect();
    }
    if by < 0 {
        return mirror_items(&right(&mirror_items(items), chosen, -by, mode, limits.mirror_limits()));
    }
    right(items, chosen, by, mode, limits)
}

fn right(
    items: &[SpanItem],
    chosen: &BTreeSet<i64>,
    by: i64,
    mode: NeighbourMode,
    limits: SpanLimits,
) -> Vec<SpanItem> {
    let is = |item: &SpanItem| chosen.contains(&item.id);
    let mut new = items.to_vec();
    if mode == NeighbourMode::Bulldozer {
        let moved = |by: i64| {
            let mut new = items.to_vec();
            for item in new.iter_mut().filter(|item| is(item)) {
                *item = shift_item(*item, by);
            }
            push_items_along(&mut new, 0);
            new
        };
        new = moved(by);
        // The part beyond the limit is taken back from the whole move.
        let over = new.last().map_or(0, |last| last.end - limits.to);
        return if over > 0 { moved((by - over).max(0)) } else { new };
    }
    let mut count = items.iter().enumerate().filter(|(_, item)| is(item));
    if let (Some((at, item)), None) = (count.next(), count.next()) {
        new[at] = nearest_room(items, at, item.start + by, limits);
        return new;
    }
    // Chosen neighbours move together and are no walls to each other.
    let walls = items
        .iter()
        .enumerate()
        .filter(|(_, item)| is(item))
        .filter_map(|(at, item)| match items.get(at + 1) {
            Some(next) if is(next) => None,
            Some(next) => Some(next.start - item.end),
            None => Some(limits.to - item.end),
        });
    let by = walls.fold(by, i64::min).max(0);
    for item in new.iter_mut().filter(|item| chosen.contains(&item.id)) {
        *item = shift_item(*item, by);
    }
    new
}

/// Puts one annotation into the free place nearest to `start`.
fn nearest_room(items: &[SpanItem], at: usize, start: i64, limits: SpanLimits) -> SpanItem {
    let item = items[at];
    let length = item.end - item.start;
    let mut best = item.start;
    let mut from = limits.from;
    let others = items.iter().enumerate().filter(|(n, _)| *n != at);
    let walls = others.map(|(_, other)| (other.start, other.end));
    for (to, next) in walls.chain([(limits.to, limits.to)]) {
        if to - from >= length {
            let there = start.clamp(from, to - length);
            if (there - start).abs() < (best - start).abs() {
                best = there;
            }
        }
        from = next;
    }
    shift_item(item, best - item.start)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const LIMITS: SpanLimits = SpanLimits {
        from: 0,
        to: 1000,
        least: 10,
    };

    fn items(spans: &[(i64, i64)]) -> Vec<SpanItem> {
        let numbered = (1..).zip(spans);
        numbered
            .map(|(id, &(start, end))| SpanItem { id, start, end })
            .collect()
    }

    #[test]
    fn neighbours_limit_are_pushed_or_shift_by_mode() {
        use DragGrip::{End, Start, Whole};
        use NeighbourMode::{Bulldozer, Normal, Shift};
        let all = items(&[(0, 100), (150, 250), (300, 400)]);
        type Case<'a> = (i64, DragGrip, i64, NeighbourMode, &'a [(i64, i64, i64)]);
        let cases: [Case<'_>; 16] = [
            (2, End, 30, Normal, &[(2, 150, 280)]),
            (2, End, 90, Normal, &[(2, 150, 300)]),
            (2, End, -500, Normal, &[(2, 150, 160)]),
            (2, End, 90, Bulldozer, &[(2, 150, 340), (3, 340, 440)]),
            (2, End, 9000, Bulldozer, &[(2, 150, 900), (3, 900, 1000)]),
            (2, End, 90, Shift, &[(2, 150, 340), (3, 390, 490)]),
            (2, End, -40, Shift, &[(2, 150, 210), (3, 260, 360)]),
            (2, Start, -90, Normal, &[(2, 100, 250)]),
            (2, Start, -90, Bulldozer, &[(2, 100, 250)]),
            (2, Start, 40, Shift, &[(1, 40, 140), (2, 190, 250)]),
            (2, Whole, 500, Normal, &[(2, 650, 750)]),
            (2, Whole, 90, Normal, &[(2, 200, 300)]),
            (2, Whole, 220, Normal, &[(2, 400, 500)]),
            (2, Whole, 90, Bulldozer, &[(2, 240, 340), (3, 340, 440)]),
            (2, Whole, -90, Bulldozer, &[(2, 100, 200)]),
            (2, Whole, -90, Shift, &[(2, 100, 200), (3, 250, 350)]),
        ];
        for (id, grip, by, mode, want) in cases {
            let found = drag_spans(&all, &BTreeSet::from([id]), grip, by, mode, LIMITS);
            let found: Vec<_> = found.iter().map(|it| (it.id, it.start, it.end)).collect();
            assert_eq!(found, want, "{id} {grip:?} {by} {mode:?}");
        }
        let both = BTreeSet::from([1, 2]);
        let found = drag_spans(&all, &both, Whole, 90, Normal, LIMITS);
        assert_eq!(found, items(&[(50, 150), (200, 300)]));
    }

    #[test]
    fn a_new_annotation_gets_the_longest_free_part() {
        let all = items(&[(0, 100), (150, 250), (300, 400)]);
        for (wanted, want) in [
            ((110, 140), Some((110, 140))),
            ((50, 320), Some((100, 150))),
            ((160, 240), None),
            ((260, 900), Some((400, 900))),
            ((500, 500), None),
        ] {
            assert_eq!(longest_free_span(&all, wanted.0, wanted.1), want, "{wanted:?}");
        }
    }

    #[test]
    fn annotations_after_a_new_one_make_room_for_it() {
        let all = items(&[(0, 100), (150, 250), (300, 400)]);
        for (wanted, mode, want) in [
            ((120, 200), NeighbourMode::Normal, None),
            ((120, 200), NeighbourMode::Bulldozer, Some(items(&[(0, 0), (200, 300)]))),
            (
                (120, 260),
                NeighbourMode::Bulldozer,
                Some(items(&[(0, 0), (260, 360), (360, 460)])),
            ),
            (
                (120, 200),
                NeighbourMode::Shift,
                Some(items(&[(0, 0), (200, 300), (350, 450)])),
            ),
            ((110, 140), NeighbourMode::Shift, Some(Vec::new())),
            ((50, 140), NeighbourMode::Bulldozer, None),
            ((120, 900), NeighbourMode::Shift, None),
        ] {
            let want = want.map(|all| all.into_iter().filter(|item| item.end > 0).collect());
            assert_eq!(open_span_room(&all, wanted, mode, LIMITS), want, "{wanted:?} {mode:?}");
        }
    }

    fn any_items() -> impl Strategy<Value = Vec<SpanItem>> {
        prop::collection::vec((0..80_i64, 1..120_i64), 1..9).prop_map(|all| {
            let mut end = 0;
            let mut spans = Vec::new();
            for (gap, length) in all {
                spans.push((end + gap, end + gap + length));
                end += gap + length;
            }
            items(&spans)
        })
    }

    fn overlap(items: &[SpanItem]) -> bool {
        let mut sorted = items.to_vec();
        sorted.sort_by_key(|item| item.start);
        sorted.windows(2).any(|pair| pair[0].end > pair[1].start)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn nothing_overlaps_or_is_lost_at_any_step(
            all in any_items(),
            picked in prop::collection::btree_set(1..9_i64, 1..4),
            grip in prop::sample::select(vec![DragGrip::Start, DragGrip::End, DragGrip::Whole]),
            mode in prop::sample::select(vec![NeighbourMode::Normal, NeighbourMode::Bulldozer, NeighbourMode::Shift]),
            by in -2000..2000_i64,
        ) {
            let changed = drag_spans(&all, &picked, grip, by, mode, LIMITS);
            let mut now = all.clone();
            let to = LIMITS.to.max(all[all.len() - 1].end);
            for new in order_span_changes(&all, &changed) {
                let old = now.iter_mut().find(|old| old.id == new.id).expect("it was there");
                *old = new;
                prop_assert!(!overlap(&now), "{changed:?}");
            }
            for (old, new) in all.iter().zip(&now) {
                prop_assert!(new.start >= 0 && new.end <= to && new.end > new.start);
                let length = |item: &SpanItem| item.end - item.start;
                let resized = grip != DragGrip::Whole && picked.contains(&new.id);
                prop_assert!(resized || length(old) == length(new));
            }
        }

        #[test]
        fn an_annotation_shifted_there_and_back_is_unchanged(all in any_items(), by in 0..200_i64) {
            let picked = BTreeSet::from([1]);
            let limits = SpanLimits { to: 100_000, ..LIMITS };
            let gone = drag_spans(&all, &picked, DragGrip::Whole, by, NeighbourMode::Shift, limits);
            let back = drag_spans(&gone, &picked, DragGrip::Whole, -by, NeighbourMode::Shift, limits);
            prop_assert!(by == 0 || back == all);
        }
    }
}
