//! Annotations created, merged and stretched beside the selected one, and created below it.

use chereme_corpus::{
    AnnotationAction, AnnotationChange, AnnotationName, TierContents, TierName, paste, requests,
};

use super::dragged::{self, TierTiming};
use super::edit::{self, Scene};
use super::spans::{Grip, Item};
use super::{Ghost, Then, Timeline};
use crate::action::Action;
use crate::context::Outbox;
use crate::panes::Acted;
use crate::words::{shell, timeline as words};

/// Carries out an action that concerns the annotations beside or below the selected one.
pub(super) fn act(
    timeline: &mut Timeline,
    action: Action,
    scene: &Scene<'_>,
    out: &mut Outbox,
) -> Acted {
    match action {
        Action::NewBefore => new(timeline, scene, false, out),
        Action::NewAfter => new(timeline, scene, true, out),
        Action::NewBelow => new_below(timeline, scene, out),
        Action::MergePrevious => merge_previous(timeline, scene, out),
        Action::StartToNeighbour => stretch(timeline, scene, Grip::Start, out),
        Action::EndToNeighbour => stretch(timeline, scene, Grip::End, out),
        _ => Acted::No,
    }
}

/// Returns the annotation that is selected alone, else the one of the tier at the playhead.
fn found<'a>(scene: &Scene<'a>) -> Option<(&'a TierContents, usize)> {
    let it = scene.seen.snapshot.annotation(edit::alone(scene)?)?;
    Some((it.tier, it.at))
}

/// Begins a new annotation in the gap before or after the selected one, of the same length if there is room. On a tier
/// without gaps it takes half of the selected one; on a tier of lists it is inserted beside it.
fn new(timeline: &mut Timeline, scene: &Scene<'_>, after: bool, out: &mut Outbox) -> Acted {
    let Some((tier, at)) = found(scene) else {
        return Acted::Cannot(shell::NEEDS_ANNOTATION);
    };
    let columns = &tier.annotations;
    let parent = columns.parents[at];
    let kind = TierTiming::of(&tier.row);
    match kind {
        TierTiming::Listed if paste::is_association(tier) => Acted::Cannot(words::ONLY_ONE),
        TierTiming::Listed => {
            let family = columns.parents[..at].iter().filter(|it| **it == parent);
            let place = family.count() + usize::from(after);
            let add = AnnotationAction::Add {
                tier: TierName::Number(tier.row.id),
                start: None,
                end: None,
                parent: parent.map(AnnotationName::Number),
                order: u32::try_from(place).ok(),
                value: String::new(),
                confidence: None,
            };
            let then = Then {
                select: true,
                edit: true,
                ..Then::default()
            };
            timeline.change(vec![add.into()], then, out)
        }
        _ => {
            let here = (columns.starts[at], columns.ends[at]);
            let span = if kind == TierTiming::Tiled {
                let middle = scene.stepped((here.0 + here.1) / 2, 0);
                let half = if after {
                    (middle, here.1)
                } else {
                    (here.0, middle)
                };
                Some(half).filter(|half| half.0 < half.1 && *half != here)
            } else {
                let gap = gap(scene, tier, at, after);
                let length = here.1 - here.0;
                Some(if after {
                    (gap.0, gap.1.min(gap.0 + length))
                } else {
                    (gap.0.max(gap.1 - length), gap.1)
                })
                .filter(|it| it.1 - it.0 >= dragged::LEAST)
            };
            let Some(span) = span else {
                return Acted::Cannot(words::NO_ROOM_BESIDE);
            };
            timeline.edit_new(tier, span)
        }
    }
}

/// Returns the free span before or after an annotation, in microseconds: up to its neighbour, the end of the parent
/// annotation, or the end of the recording.
fn gap(scene: &Scene<'_>, tier: &TierContents, at: usize, after: bool) -> (i64, i64) {
    let columns = &tier.annotations;
    let mut limits = dragged::limits(scene.contents, scene.frames().is_some());
    if limits.to > scene.contents.recording.duration_us {
        limits.to = scene.contents.recording.duration_us.max(columns.ends[at]);
    }
    let above = columns.parents[at].and_then(|id| scene.seen.snapshot.annotation(id));
    let above = above.map(|it| {
        (
            it.tier.annotations.starts[it.at],
            it.tier.annotations.ends[it.at],
        )
    });
    let (from, to) = above.unwrap_or((limits.from, limits.to));
    if after {
        let next = columns.starts.get(at + 1).map_or(to, |it| (*it).min(to));
        (columns.ends[at], next)
    } else {
        let previous = at
            .checked_sub(1)
            .map_or(from, |it| columns.ends[it].max(from));
        (previous, columns.starts[at])
    }
}

/// Adds an empty annotation on every tier below the selected annotations that has none there, down to the deepest
/// tiers.
fn new_below(timeline: &mut Timeline, scene: &Scene<'_>, out: &mut Outbox) -> Acted {
    let mut chosen = scene.seen.shown.annotations.clone();
    if chosen.is_empty() {
        chosen.extend(edit::alone(scene));
    }
    if chosen.is_empty() {
        return Acted::Cannot(shell::NEEDS_ANNOTATION);
    }
    let adds = requests::missing_below(&scene.contents.tiers, &chosen);
    if adds.is_empty() {
        return Acted::Cannot(words::NOTHING_BELOW);
    }
    let ghosts = adds.iter().map(|(tier, span)| Ghost {
        tier: *tier,
        id: None,
        start: span.0,
        end: span.1,
    });
    let then = Then {
        ghosts: ghosts.collect(),
        ..Then::default()
    };
    let asked = adds
        .iter()
        .map(|(tier, span)| requests::add(*tier, *span, ""));
    timeline.change(asked.collect(), then, out)
}

fn merge_previous(timeline: &mut Timeline, scene: &Scene<'_>, out: &mut Outbox) -> Acted {
    let chosen = &scene.seen.shown.annotations;
    let first = match scene.tier() {
        Some(tier) if chosen.len() > 1 => dragged::places(tier, chosen).next().map(|at| (tier, at)),
        _ => found(scene),
    };
    let Some((tier, at)) = first else {
        return Acted::Cannot(shell::NEEDS_ANNOTATION);
    };
    let Some(before) = at.checked_sub(1) else {
        return Acted::Cannot(words::NO_PREVIOUS);
    };
    let ids = &tier.annotations.ids;
    let mut both = chosen.clone();
    both.extend([ids[before], ids[at]]);
    let closed = scene.inventory(tier).is_some();
    let then = Then {
        select: true,
        ..Then::default()
    };
    match requests::merge(tier, &both, closed) {
        Some(changes) => timeline.change(changes, then, out),
        None => Acted::Cannot(words::NO_PREVIOUS),
    }
}

/// Moves the starts or ends of the selected annotations to their neighbours, or to the ends of their parents.
fn stretch(timeline: &mut Timeline, scene: &Scene<'_>, grip: Grip, out: &mut Outbox) -> Acted {
    let mut chosen = scene.seen.shown.annotations.clone();
    if chosen.is_empty() {
        chosen.extend(edit::alone(scene));
    }
    if chosen.is_empty() {
        return Acted::Cannot(shell::NEEDS_ANNOTATION);
    }
    let mut changed: Vec<AnnotationChange> = Vec::new();
    let mut ghosts = Vec::new();
    for tier in &scene.contents.tiers {
        let kind = TierTiming::of(&tier.row);
        let columns = &tier.annotations;
        for at in dragged::places(tier, &chosen) {
            let last = if grip == Grip::End {
                columns.len() - 1
            } else {
                0
            };
            if !matches!(kind, TierTiming::Root | TierTiming::Inside)
                || (kind == TierTiming::Root && at == last)
            {
                continue;
            }
            let gap = gap(scene, tier, at, grip == Grip::End);
            if gap.0 >= gap.1 {
                continue;
            }
            let (start, end) = (columns.starts[at], columns.ends[at]);
            let item = Item {
                id: columns.ids[at],
                start: start.min(gap.0),
                end: end.max(gap.1),
            };
            changed.extend(requests::respan(&[item]));
            ghosts.push(Ghost::of(tier.row.id, &item));
        }
    }
    if changed.is_empty() {
        return Acted::Cannot(words::NO_NEIGHBOUR);
    }
    let then = Then {
        ghosts,
        ..Then::default()
    };
    timeline.change(changed, then, out)
}
