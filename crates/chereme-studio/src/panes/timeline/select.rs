//! Keyboard selection of tiers, annotations and time.

use std::collections::BTreeSet;

use chereme_corpus::{RecordingContents, TierContents};
use chereme_motion::{RecordingInstant, TimeSpan};

use super::timeline_edit::TimelineScene;
use super::timeline_rows::{TimelineRow, build_timeline_rows};
use super::{TimelinePane, dragged, timeline_data};
use crate::action::Action;
use crate::command::{CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::panes::ActionOutcome;
use crate::words::timeline as words;

const SECOND_IN_MICROS: i64 = 1_000_000;

/// Carries out an action that only changes the selection.
pub(super) fn carry_out_selection_action(
    timeline: &mut TimelinePane,
    action: Action,
    scene: &TimelineScene<'_>,
) -> ActionOutcome {
    match action {
        Action::NextAnnotation | Action::PreviousAnnotation => {
            if !walk_tier_annotations(scene, action == Action::NextAnnotation) {
                return ActionOutcome::Cannot(words::LAST_OF_TIER);
            }
        }
        Action::FirstAnnotation | Action::LastAnnotation => {
            let Some(tier) = scene.edited_tier() else {
                return ActionOutcome::Cannot(words::NEEDS_TIER);
            };
            let last = tier.annotations.len().checked_sub(1);
            let target_index = last.map(|last| if action == Action::LastAnnotation { last } else { 0 });
            match target_index {
                Some(at) => select_tier_annotation(tier, at, scene.seen.out),
                None => return ActionOutcome::Cannot(words::LAST_OF_TIER),
            }
        }
        Action::AnnotationBelow => climb(scene, 1),
        Action::AnnotationAbove => climb(scene, -1),
        Action::NextTier => step_tier(scene, 1),
        Action::PreviousTier => step_tier(scene, -1),
        Action::AlsoNext => also(scene, true),
        Action::AlsoPrevious => also(scene, false),
        Action::SelectOnTier => {
            if let Some(tier) = scene.edited_tier() {
                let all = tier.annotations.ids.iter().copied().collect();
                scene.seen.send_command(WindowCommand::Annotations(all));
            }
        }
        Action::SelectFromHere => select_to(scene, true),
        Action::SelectToHere => select_to(scene, false),
        Action::ExtendFrameBack => extend_selection_to(scene, scene.step_by_frames(scene.scene_playhead_micros(), -1)),
        Action::ExtendFrameForward => {
            extend_selection_to(scene, scene.step_by_frames(scene.scene_playhead_micros(), 1))
        }
        Action::ExtendSecondBack => extend_selection_to(scene, scene.scene_playhead_micros() - SECOND_IN_MICROS),
        Action::ExtendSecondForward => extend_selection_to(scene, scene.scene_playhead_micros() + SECOND_IN_MICROS),
        _ => return ActionOutcome::No,
    }
    timeline.view.reveal = true;
    ActionOutcome::Yes
}

/// Selects an annotation with its tier and span, and moves the playhead to its start, as ELAN does.
pub(super) fn select_tier_annotation(tier: &TierContents, at: usize, out: &CommandOutbox) {
    let span = tier.annotations.annotation_span_at(at);
    out.send_command(WindowCommand::Tier(Some(tier.row.id)));
    out.send_command(WindowCommand::Annotations(BTreeSet::from([tier.annotations.ids[at]])));
    out.send_command(WindowCommand::Span(Some(span)));
    out.send_seek(span.span_start_instant());
}

/// Returns the visible rows.
pub(super) fn shown_rows(contents: &RecordingContents, seen: &PaneInput<'_>) -> Vec<TimelineRow> {
    let settings = &seen.settings.timeline;
    build_timeline_rows(&contents.tiers, &settings.folded, &settings.hidden)
}

/// Selects the annotation after or before the selected one, or after or before the playhead, on the selected tier;
/// while looping, goes on from the last to the first. Returns whether there is one.
fn walk_tier_annotations(scene: &TimelineScene<'_>, forwards: bool) -> bool {
    let Some(tier) = scene.edited_tier() else {
        return false;
    };
    let columns = &tier.annotations;
    let mut chosen = dragged::chosen_annotation_indices(tier, &scene.seen.shown.annotations);
    let selected = if forwards { chosen.last() } else { chosen.next() };
    // The annotation at the playhead itself is the next one.
    let after = columns
        .starts
        .partition_point(|start| *start < scene.scene_playhead_micros());
    let next = match (selected, forwards) {
        (Some(at), true) => Some(at + 1),
        (Some(at), false) => at.checked_sub(1),
        (None, true) => Some(after),
        (None, false) => after.checked_sub(1),
    };
    let round = scene
        .seen
        .shown
        .player
        .looping
        // An empty tier wraps to an index beyond every one and is filtered scene.out below.
        .then_some(if forwards { 0 } else { columns.len().wrapping_sub(1) });
    let inside = |at: &usize| *at < columns.len();
    let next_index = next.filter(inside).or(round.filter(inside));
    if let Some(at) = next_index {
        select_tier_annotation(tier, at, scene.seen.out);
    }
    next_index.is_some()
}

/// Adds the annotation after or before the selected ones to the selection.
fn also(scene: &TimelineScene<'_>, forwards: bool) {
    let chosen = &scene.seen.shown.annotations;
    let Some(tier) = scene.edited_tier() else {
        return;
    };
    let mut places = dragged::chosen_annotation_indices(tier, chosen);
    let next = if forwards {
        places.last().map(|at| at + 1)
    } else {
        places.next().and_then(|at| at.checked_sub(1))
    };
    match next {
        Some(at) if at < tier.annotations.len() => {
            let mut all = chosen.clone();
            all.insert(tier.annotations.ids[at]);
            scene.seen.send_command(WindowCommand::Annotations(all));
        }
        Some(_) => {}
        // With nothing selected, extending begins with the next annotation.
        None if chosen.is_empty() => drop(walk_tier_annotations(scene, forwards)),
        None => {}
    }
}

/// Returns the tier `by` rows below the selected one.
fn neighbour<'a>(scene: &TimelineScene<'a>, by: isize) -> Option<&'a TierContents> {
    let rows = shown_rows(scene.contents, scene.seen);
    let tier = |row: &TimelineRow| &scene.contents.tiers[row.tier];
    let current = scene.edited_tier().map(|tier| tier.row.id);
    let here = rows.iter().position(|row| Some(tier(row).row.id) == current);
    let next = here.map_or(Some(0), |here| here.checked_add_signed(by))?;
    rows.get(next).map(tier)
}

/// Selects the tier below or above, and its annotation at the playhead.
fn step_tier(scene: &TimelineScene<'_>, by: isize) {
    let Some(tier) = neighbour(scene, by) else {
        return;
    };
    scene.seen.send_command(WindowCommand::Tier(Some(tier.row.id)));
    let under_index = timeline_data::annotation_index_at(&tier.annotations, scene.scene_playhead_micros());
    let under = under_index.map(|at| tier.annotations.ids[at]);
    scene
        .seen
        .send_command(WindowCommand::Annotations(under.into_iter().collect()));
}

/// Selects the annotation of the tier below or above that lies at the same time, with its span; only the tier if
/// there is no such annotation.
fn climb(scene: &TimelineScene<'_>, by: isize) {
    let Some(tier) = neighbour(scene, by) else {
        return;
    };
    let selection = scene
        .seen
        .shown
        .selected_annotation()
        .and_then(|id| scene.seen.snapshot.find_open_annotation(id));
    let from = selection.map_or(scene.scene_playhead_micros(), |annotation| {
        annotation.tier.annotations.starts[annotation.at]
    });
    // Without a selection the playhead stands for a span of one microsecond.
    let to = selection.map_or(from + 1, |annotation| annotation.tier.annotations.ends[annotation.at]);
    let columns = &tier.annotations;
    let first = columns.ends.partition_point(|end| *end <= from);
    match (first < columns.len()).then(|| columns.starts[first]) {
        Some(start) if start < to => select_tier_annotation(tier, first, scene.seen.out),
        _ => step_tier(scene, by),
    }
}

/// With `starts`, selects from the playhead to the end of the selection or the recording; otherwise from the start of
/// the selection or the recording to the playhead.
fn select_to(scene: &TimelineScene<'_>, starts: bool) {
    let (at, whole) = (scene.scene_playhead_micros(), scene.seen.shown.player.whole);
    let old = scene.seen.shown.span;
    let new = if starts {
        let end = old
            .map(|span| span.span_end_instant().instant_micros())
            .filter(|end| *end > at);
        (at, end.unwrap_or(whole.span_end_instant().instant_micros()))
    } else {
        let start = old
            .map(|span| span.span_start_instant().instant_micros())
            .filter(|start| *start < at);
        (start.unwrap_or(whole.span_start_instant().instant_micros()), at)
    };
    scene.seen.send_command(WindowCommand::Annotations(BTreeSet::new()));
    let new = TimeSpan::from_span_micros(new.0, new.1);
    scene
        .seen
        .send_command(WindowCommand::Span(Some(new).filter(|span| !span.is_empty())));
}

/// Returns the selection after the playhead moves to `to`. The end of the selection at the playhead moves along; if
/// neither end is there, a new selection begins at the playhead.
pub(super) fn extended_time_selection(old: Option<TimeSpan>, playhead: i64, to: i64) -> Option<TimeSpan> {
    // The end that the playhead stands at moves, and the other one stays.
    let anchor = match old.map(|span| span.span_bounds_micros()) {
        Some((start, end)) if playhead == end => start,
        Some((start, end)) if playhead == start => end,
        _ => playhead,
    };
    Some(TimeSpan::from_span_micros(anchor, to)).filter(|span| !span.is_empty())
}

fn extend_selection_to(scene: &TimelineScene<'_>, to: i64) {
    let whole_span = scene.seen.shown.player.whole;
    // The end of a recording is not an instant in it.
    let last =
        (whole_span.span_end_instant().instant_micros() - 1).max(whole_span.span_start_instant().instant_micros());
    let to = to.clamp(whole_span.span_start_instant().instant_micros(), last);
    scene.seen.send_command(WindowCommand::Annotations(BTreeSet::new()));
    let new = extended_time_selection(scene.seen.shown.span, scene.scene_playhead_micros(), to);
    scene.seen.send_command(WindowCommand::Span(new));
    scene.seen.send_seek(RecordingInstant::from_micros(to));
}

/// Returns the annotations from the first selected one to index `at` on a tier, as Shift and a click select them.
pub(super) fn annotation_range_to(tier: &TierContents, chosen: &BTreeSet<i64>, at: usize) -> BTreeSet<i64> {
    let mut places = dragged::chosen_annotation_indices(tier, chosen);
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
            extended_time_selection(old.map(|it| TimeSpan::from_span_micros(it.0, it.1)), playhead, to)
                .map(|it| it.span_bounds_micros())
        };
        assert_eq!(at(None, 5, 9), Some((5, 9)));
        assert_eq!(at(Some((5, 9)), 9, 12), Some((5, 12)));
        assert_eq!(at(Some((5, 9)), 5, 2), Some((2, 9)));
        assert_eq!(at(Some((5, 9)), 9, 5), None);
        assert_eq!(at(Some((5, 9)), 7, 8), Some((7, 8)));
    }

    #[test]
    fn a_range_extends_from_the_first_selected_annotation() {
        let all = contents(&[(1, None, "", &[(1, 0, 9, None), (2, 9, 12, None), (3, 20, 30, None)])]);
        let found = annotation_range_to(&all.tiers[0], &BTreeSet::from([1]), 2);
        assert_eq!(found, BTreeSet::from([1, 2, 3]));
        assert_eq!(
            annotation_range_to(&all.tiers[0], &BTreeSet::new(), 1),
            BTreeSet::from([2])
        );
        assert_eq!(annotation_range_to(&all.tiers[0], &BTreeSet::from([3]), 0).len(), 3);
    }
}
