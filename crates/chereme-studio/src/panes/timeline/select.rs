//! Keyboard selection of tiers, annotations and time.

use std::collections::BTreeSet;

use chereme_corpus::{Contents, TierContents};
use chereme_motion::{Instant, Span};

use super::edit::Scene;
use super::rows::{TimelineRow, rows};
use super::{Timeline, data, dragged};
use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::panes::Acted;
use crate::words::timeline as words;

const SECOND: i64 = 1_000_000;

/// Carries out an action that only changes the selection.
pub(super) fn act(
    timeline: &mut Timeline,
    action: Action,
    scene: &Scene<'_>,
    out: &mut Outbox,
) -> Acted {
    match action {
        Action::NextAnnotation | Action::PreviousAnnotation => {
            if !walk(scene, out, action == Action::NextAnnotation) {
                return Acted::Cannot(words::LAST_OF_TIER);
            }
        }
        Action::FirstAnnotation | Action::LastAnnotation => {
            let Some(tier) = scene.tier() else {
                return Acted::Cannot(words::NEEDS_TIER);
            };
            let last = tier.annotations.len().checked_sub(1);
            let at = last.map(|last| {
                if action == Action::LastAnnotation {
                    last
                } else {
                    0
                }
            });
            match at {
                Some(at) => select(tier, at, out),
                None => return Acted::Cannot(words::LAST_OF_TIER),
            }
        }
        Action::AnnotationBelow => climb(scene, out, 1),
        Action::AnnotationAbove => climb(scene, out, -1),
        Action::NextTier => step_tier(scene, out, 1),
        Action::PreviousTier => step_tier(scene, out, -1),
        Action::AlsoNext => also(scene, out, true),
        Action::AlsoPrevious => also(scene, out, false),
        Action::SelectOnTier => {
            if let Some(tier) = scene.tier() {
                let all = tier.annotations.ids.iter().copied().collect();
                out.send(Command::Annotations(all));
            }
        }
        Action::SelectFromHere => select_to(scene, out, true),
        Action::SelectToHere => select_to(scene, out, false),
        Action::ExtendFrameBack => extend(scene, out, scene.stepped(scene.playhead(), -1)),
        Action::ExtendFrameForward => extend(scene, out, scene.stepped(scene.playhead(), 1)),
        Action::ExtendSecondBack => extend(scene, out, scene.playhead() - SECOND),
        Action::ExtendSecondForward => extend(scene, out, scene.playhead() + SECOND),
        _ => return Acted::No,
    }
    timeline.view.reveal = true;
    Acted::Yes
}

/// Selects an annotation with its tier and span, and moves the playhead to its start, as ELAN does.
pub(super) fn select(tier: &TierContents, at: usize, out: &mut Outbox) {
    let span = tier.annotations.span(at);
    out.send(Command::Tier(Some(tier.row.id)));
    out.send(Command::Annotations(BTreeSet::from([
        tier.annotations.ids[at]
    ])));
    out.send(Command::Span(Some(span)));
    out.seek(span.start());
}

/// Returns the visible rows.
pub(super) fn shown_rows(contents: &Contents, seen: &PaneInput<'_>) -> Vec<TimelineRow> {
    let settings = &seen.settings.timeline;
    rows(&contents.tiers, &settings.folded, &settings.hidden)
}

/// Selects the annotation after or before the selected one, or after or before the playhead, on the selected tier;
/// while looping, goes on from the last to the first. Returns whether there is one.
fn walk(scene: &Scene<'_>, out: &mut Outbox, forwards: bool) -> bool {
    let Some(tier) = scene.tier() else {
        return false;
    };
    let columns = &tier.annotations;
    let mut chosen = dragged::places(tier, &scene.seen.shown.annotations);
    let selected = if forwards {
        chosen.last()
    } else {
        chosen.next()
    };
    let after = columns
        .starts
        .partition_point(|start| *start < scene.playhead());
    let next = match (selected, forwards) {
        (Some(at), true) => Some(at + 1),
        (Some(at), false) => at.checked_sub(1),
        (None, true) => Some(after),
        (None, false) => after.checked_sub(1),
    };
    let round = scene.seen.shown.player.looping.then_some(if forwards {
        0
    } else {
        columns.len().wrapping_sub(1)
    });
    let inside = |at: &usize| *at < columns.len();
    let found = next.filter(inside).or(round.filter(inside));
    if let Some(at) = found {
        select(tier, at, out);
    }
    found.is_some()
}

/// Adds the annotation after or before the selected ones to the selection.
fn also(scene: &Scene<'_>, out: &mut Outbox, forwards: bool) {
    let chosen = &scene.seen.shown.annotations;
    let Some(tier) = scene.tier() else { return };
    let mut places = dragged::places(tier, chosen);
    let next = if forwards {
        places.last().map(|at| at + 1)
    } else {
        places.next().and_then(|at| at.checked_sub(1))
    };
    match next {
        Some(at) if at < tier.annotations.len() => {
            let mut all = chosen.clone();
            all.insert(tier.annotations.ids[at]);
            out.send(Command::Annotations(all));
        }
        Some(_) => {}
        None if chosen.is_empty() => drop(walk(scene, out, forwards)),
        None => {}
    }
}

/// Returns the tier `by` rows below the selected one.
fn neighbour<'a>(scene: &Scene<'a>, by: isize) -> Option<&'a TierContents> {
    let rows = shown_rows(scene.contents, scene.seen);
    let tier = |row: &TimelineRow| &scene.contents.tiers[row.tier];
    let current = scene.tier().map(|it| it.row.id);
    let here = rows
        .iter()
        .position(|row| Some(tier(row).row.id) == current);
    let next = here.map_or(Some(0), |here| here.checked_add_signed(by))?;
    rows.get(next).map(tier)
}

/// Selects the tier below or above, and its annotation at the playhead.
fn step_tier(scene: &Scene<'_>, out: &mut Outbox, by: isize) {
    let Some(tier) = neighbour(scene, by) else {
        return;
    };
    out.send(Command::Tier(Some(tier.row.id)));
    let under = data::at(&tier.annotations, scene.playhead());
    let under = under.map(|at| tier.annotations.ids[at]);
    out.send(Command::Annotations(under.into_iter().collect()));
}

/// Selects the annotation of the tier below or above that lies at the same time, with its span; only the tier if
/// there is no such annotation.
fn climb(scene: &Scene<'_>, out: &mut Outbox, by: isize) {
    let Some(tier) = neighbour(scene, by) else {
        return;
    };
    let found = scene
        .seen
        .shown
        .annotation()
        .and_then(|id| scene.seen.snapshot.annotation(id));
    let from = found.map_or(scene.playhead(), |it| it.tier.annotations.starts[it.at]);
    let to = found.map_or(from + 1, |it| it.tier.annotations.ends[it.at]);
    let columns = &tier.annotations;
    let first = columns.ends.partition_point(|end| *end <= from);
    match (first < columns.len()).then(|| columns.starts[first]) {
        Some(start) if start < to => select(tier, first, out),
        _ => step_tier(scene, out, by),
    }
}

fn span(from: i64, to: i64) -> Span {
    Span::between(Instant::from_micros(from), Instant::from_micros(to))
}

/// With `starts`, selects from the playhead to the end of the selection or the recording; otherwise from the start of
/// the selection or the recording to the playhead.
fn select_to(scene: &Scene<'_>, out: &mut Outbox, starts: bool) {
    let (at, whole) = (scene.playhead(), scene.seen.shown.player.whole);
    let old = scene.seen.shown.span;
    let new = if starts {
        let end = old.map(|it| it.end().micros()).filter(|end| *end > at);
        (at, end.unwrap_or(whole.end().micros()))
    } else {
        let start = old
            .map(|it| it.start().micros())
            .filter(|start| *start < at);
        (start.unwrap_or(whole.start().micros()), at)
    };
    out.send(Command::Annotations(BTreeSet::new()));
    let new = span(new.0, new.1);
    out.send(Command::Span(Some(new).filter(|it| !it.is_empty())));
}

/// Returns the selection after the playhead moves to `to`. The end of the selection at the playhead moves along; if
/// neither end is there, a new selection begins at the playhead.
pub(super) fn extended(old: Option<Span>, playhead: i64, to: i64) -> Option<Span> {
    let anchor = match old.map(|it| (it.start().micros(), it.end().micros())) {
        Some((start, end)) if playhead == end => start,
        Some((start, end)) if playhead == start => end,
        _ => playhead,
    };
    Some(span(anchor, to)).filter(|span| !span.is_empty())
}

fn extend(scene: &Scene<'_>, out: &mut Outbox, to: i64) {
    let whole = scene.seen.shown.player.whole;
    let last = (whole.end().micros() - 1).max(whole.start().micros());
    let to = to.clamp(whole.start().micros(), last);
    out.send(Command::Annotations(BTreeSet::new()));
    let new = extended(scene.seen.shown.span, scene.playhead(), to);
    out.send(Command::Span(new));
    out.seek(Instant::from_micros(to));
}

/// Returns the annotations from the first selected one to index `at` on a tier, as Shift and a click select them.
pub(super) fn range(tier: &TierContents, chosen: &BTreeSet<i64>, at: usize) -> BTreeSet<i64> {
    let mut places = dragged::places(tier, chosen);
    let anchor = places.next().unwrap_or(at);
    let (from, to) = (anchor.min(at), anchor.max(at));
    tier.annotations.ids[from..=to].iter().copied().collect()
}

#[cfg(test)]
mod tests {
    use super::super::dragged::tests::contents;
    use super::*;

    #[test]
    fn the_selection_end_at_the_playhead_moves_with_it() {
        let at = |old: Option<(i64, i64)>, playhead, to| {
            extended(old.map(|it| span(it.0, it.1)), playhead, to)
                .map(|it| (it.start().micros(), it.end().micros()))
        };
        assert_eq!(at(None, 5, 9), Some((5, 9)));
        assert_eq!(at(Some((5, 9)), 9, 12), Some((5, 12)));
        assert_eq!(at(Some((5, 9)), 5, 2), Some((2, 9)));
        assert_eq!(at(Some((5, 9)), 9, 5), None);
        assert_eq!(at(Some((5, 9)), 7, 8), Some((7, 8)));
    }

    #[test]
    fn a_range_extends_from_the_first_selected_annotation() {
        let all = contents(&[(
            1,
            None,
            "",
            &[(1, 0, 9, None), (2, 9, 12, None), (3, 20, 30, None)],
        )]);
        let found = range(&all.tiers[0], &BTreeSet::from([1]), 2);
        assert_eq!(found, BTreeSet::from([1, 2, 3]));
        assert_eq!(
            range(&all.tiers[0], &BTreeSet::new(), 1),
            BTreeSet::from([2])
        );
        assert_eq!(range(&all.tiers[0], &BTreeSet::from([3]), 0).len(), 3);
    }
}
