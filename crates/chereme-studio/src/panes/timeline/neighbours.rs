//! Annotations created, merged and stretched beside the selected one, and created below it.

use chereme_corpus::{
    AnnotationAction, AnnotationChange, AnnotationName, TierContents, TierRequestName, annotate_paste, requests,
};

use super::dragged::{self, TierTiming};
use super::tier_spans::{DragGrip, SpanItem};
use super::timeline_edit::{self, TimelineScene};
use super::{ChangeFollowUp, GhostAnnotation, TimelinePane};
use crate::action::Action;
use crate::panes::ActionOutcome;
use crate::words::{shell, timeline as words};

/// Carries out an action that concerns the annotations beside or below the selected one.
pub(super) fn carry_out_neighbour_action(
    timeline: &mut TimelinePane,
    action: Action,
    scene: &TimelineScene<'_>,
) -> ActionOutcome {
    match action {
        Action::NewBefore => new(timeline, scene, false),
        Action::NewAfter => new(timeline, scene, true),
        Action::NewBelow => new_below(timeline, scene),
        Action::MergePrevious => merge_previous(timeline, scene),
        Action::StartToNeighbour => stretch_to_neighbours(timeline, scene, DragGrip::Start),
        Action::EndToNeighbour => stretch_to_neighbours(timeline, scene, DragGrip::End),
        _ => ActionOutcome::No,
    }
}

/// Returns the annotation that is selected alone, else the one of the tier at the playhead.
fn find_lone_annotation<'a>(scene: &TimelineScene<'a>) -> Option<(&'a TierContents, usize)> {
    let it = scene
        .seen
        .snapshot
        .find_open_annotation(timeline_edit::annotation_selected_alone(scene)?)?;
    Some((it.tier, it.at))
}

/// Begins a new annotation in the gap before or after the selected one, of the same length if there is room. On a tier
/// without gaps it takes half of the selected one; on a tier of lists it is inserted beside it.
fn new(timeline: &mut TimelinePane, scene: &TimelineScene<'_>, after: bool) -> ActionOutcome {
    let Some((tier, at)) = find_lone_annotation(scene) else {
        return ActionOutcome::Cannot(shell::NEEDS_ANNOTATION);
    };
    let columns = &tier.annotations;
    let parent = columns.parents[at];
    let kind = TierTiming::timing_of_tier(&tier.row);
    match kind {
        TierTiming::Listed if annotate_paste::is_association(tier) => ActionOutcome::Cannot(words::ONLY_ONE),
        TierTiming::Listed => {
            let family = columns.parents[..at].iter().filter(|other| **other == parent);
            let place = family.count() + usize::from(after);
            let add = AnnotationAction::Add {
                tier: TierRequestName::Number(tier.row.id),
                start: None,
                end: None,
                parent: parent.map(AnnotationName::Number),
                order: u32::try_from(place).ok(),
                value: String::new(),
                confidence: None,
            };
            let then = ChangeFollowUp {
                select: true,
                edit: true,
                ..ChangeFollowUp::default()
            };
            timeline.request_annotation_changes(vec![add.into()], then, scene.seen.out)
        }
        _ => {
            let here = (columns.starts[at], columns.ends[at]);
            let span = if kind == TierTiming::Tiled {
                // Half of the annotation, at a frame's start.
                let middle = scene.step_by_frames((here.0 + here.1) / 2, 0);
                let half = if after { (middle, here.1) } else { (here.0, middle) };
                Some(half).filter(|half| half.0 < half.1 && *half != here)
            } else {
                let gap = free_span_beside(scene, tier, at, after);
                let length = here.1 - here.0;
                Some(if after {
                    (gap.0, gap.1.min(gap.0 + length))
                } else {
                    (gap.0.max(gap.1 - length), gap.1)
                })
                .filter(|range| range.1 - range.0 >= dragged::MIN_ANNOTATION_US)
            };
            let Some((start, end)) = span else {
                return ActionOutcome::Cannot(words::NO_ROOM_BESIDE);
            };
            timeline.edit_new(tier, start, end)
        }
    }
}

/// Returns the free span before or after an annotation, in microseconds: up to its neighbour, the end of the parent
/// annotation, or the end of the recording.
fn free_span_beside(scene: &TimelineScene<'_>, tier: &TierContents, at: usize, after: bool) -> (i64, i64) {
    let columns = &tier.annotations;
    let mut limits = dragged::annotation_time_limits(scene.contents, scene.recording_frame_times().is_some());
    // Annotations may stand beyond the recording's end; the gap ends at the recording or at them.
    if limits.to > scene.contents.recording.duration_us {
        limits.to = scene.contents.recording.duration_us.max(columns.ends[at]);
    }
    let parent_annotation = columns.parents[at].and_then(|id| scene.seen.snapshot.find_open_annotation(id));
    let above = parent_annotation.map(|annotation| {
        (
            annotation.tier.annotations.starts[annotation.at],
            annotation.tier.annotations.ends[annotation.at],
        )
    });
    let (from, to) = above.unwrap_or((limits.from, limits.to));
    if after {
        let next = columns
            .starts
            .get(at + 1)
            .map_or(to, |next_start| (*next_start).min(to));
        (columns.ends[at], next)
    } else {
        let previous = at.checked_sub(1).map_or(from, |index| columns.ends[index].max(from));
        (previous, columns.starts[at])
    }
}

/// Adds an empty annotation on every tier below the selected annotations that has none there, down to the deepest
/// tiers.
fn new_below(timeline: &mut TimelinePane, scene: &TimelineScene<'_>) -> ActionOutcome {
    let mut chosen = scene.seen.shown.annotations.clone();
    if chosen.is_empty() {
        chosen.extend(timeline_edit::annotation_selected_alone(scene));
    }
    if chosen.is_empty() {
        return ActionOutcome::Cannot(shell::NEEDS_ANNOTATION);
    }
    let adds = requests::missing_below(&scene.contents.tiers, &chosen);
    if adds.is_empty() {
        return ActionOutcome::Cannot(words::NOTHING_BELOW);
    }
    let ghosts = adds.iter().map(|(tier, span)| GhostAnnotation {
        tier: *tier,
        id: None,
        start: span.0,
        end: span.1,
    });
    let then = ChangeFollowUp {
        ghosts: ghosts.collect(),
        ..ChangeFollowUp::default()
    };
    let asked = adds
        .iter()
        .map(|(tier, (start, end))| requests::add_annotation_change(*tier, *start, *end, ""));
    timeline.request_annotation_changes(asked.collect(), then, scene.seen.out)
}

fn merge_previous(timeline: &mut TimelinePane, scene: &TimelineScene<'_>) -> ActionOutcome {
    let chosen = &scene.seen.shown.annotations;
    let first = match scene.edited_tier() {
        Some(tier) if chosen.len() > 1 => dragged::chosen_annotation_indices(tier, chosen)
            .next()
            .map(|at| (tier, at)),
        _ => find_lone_annotation(scene),
    };
    let Some((tier, at)) = first else {
        return ActionOutcome::Cannot(shell::NEEDS_ANNOTATION);
    };
    let Some(before) = at.checked_sub(1) else {
        return ActionOutcome::Cannot(words::NO_PREVIOUS);
    };
    let ids = &tier.annotations.ids;
    let mut both = chosen.clone();
    both.extend([ids[before], ids[at]]);
    // Values of a closed list cannot be joined to a new text.
    let closed = scene.scene_tier_inventory(tier).is_some();
    let then = ChangeFollowUp {
        select: true,
        ..ChangeFollowUp::default()
    };
    match requests::merge_annotation_changes(tier, &both, closed) {
        Some(changes) => timeline.request_annotation_changes(changes, then, scene.seen.out),
        None => ActionOutcome::Cannot(words::NO_PREVIOUS),
    }
}

/// Moves the starts or ends of the selected annotations to their neighbours, or to the ends of their parents.
fn stretch_to_neighbours(timeline: &mut TimelinePane, scene: &TimelineScene<'_>, grip: DragGrip) -> ActionOutcome {
    let mut chosen = scene.seen.shown.annotations.clone();
    if chosen.is_empty() {
        chosen.extend(timeline_edit::annotation_selected_alone(scene));
    }
    if chosen.is_empty() {
        return ActionOutcome::Cannot(shell::NEEDS_ANNOTATION);
    }
    let mut changed: Vec<AnnotationChange> = Vec::new();
    let mut ghosts = Vec::new();
    for tier in &scene.contents.tiers {
        let kind = TierTiming::timing_of_tier(&tier.row);
        let columns = &tier.annotations;
        for at in dragged::chosen_annotation_indices(tier, &chosen) {
            // The last annotation of a root tier has no neighbour, only the recording's end.
            let last = if grip == DragGrip::End { columns.len() - 1 } else { 0 };
            if !matches!(kind, TierTiming::Root | TierTiming::Inside) || (kind == TierTiming::Root && at == last) {
                continue;
            }
            let gap = free_span_beside(scene, tier, at, grip == DragGrip::End);
            if gap.0 >= gap.1 {
                continue;
            }
            let (start, end) = (columns.starts[at], columns.ends[at]);
            let item = SpanItem {
                id: columns.ids[at],
                start: start.min(gap.0),
                end: end.max(gap.1),
            };
            changed.extend(requests::set_times_changes(&[item]));
            ghosts.push(GhostAnnotation::ghost_from_item(tier.row.id, &item));
        }
    }
    if changed.is_empty() {
        return ActionOutcome::Cannot(words::NO_NEIGHBOUR);
    }
    let then = ChangeFollowUp {
        ghosts,
        ..ChangeFollowUp::default()
    };
    timeline.request_annotation_changes(changed, then, scene.seen.out)
}
