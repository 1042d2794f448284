//! What actions do to the annotations that are selected.

use std::collections::BTreeSet;

use chereme_corpus::{
    AnnotateOptions, AnnotationAction, AnnotationName, Contents, Moment, TierContents, TierName,
};

use super::data;
use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, Seen};
use crate::panes::Acted;
use crate::words::shell;
use crate::work::Work;

/// Does an action that is about tiers and annotations.
pub(super) fn act(action: Action, seen: &Seen<'_>, out: &mut Outbox) -> Acted {
    let mine = matches!(
        action,
        Action::NewAnnotation
            | Action::SplitAnnotation
            | Action::DeleteAnnotation
            | Action::NextAnnotation
            | Action::PreviousAnnotation
            | Action::NextTier
            | Action::PreviousTier
    );
    let contents = seen
        .shown
        .recording
        .and_then(|id| seen.snapshot.contents(id));
    let Some(contents) = contents.filter(|_| mine) else {
        return Acted::No;
    };
    match action {
        Action::NewAnnotation => add(contents, seen, out),
        Action::SplitAnnotation => split(seen, out),
        Action::DeleteAnnotation => delete(seen, out),
        Action::NextAnnotation => walk(contents, seen, out, true),
        Action::PreviousAnnotation => walk(contents, seen, out, false),
        Action::NextTier => step_tier(contents, seen, out, 1),
        _ => step_tier(contents, seen, out, -1),
    }
}

/// Returns the tier that edits are about: the selected one, else the first.
pub(super) fn tier<'a>(contents: &'a Contents, seen: &Seen<'_>) -> Option<&'a TierContents> {
    let chosen = contents
        .tiers
        .iter()
        .find(|it| Some(it.row.id) == seen.shown.tier);
    chosen.or_else(|| contents.tiers.first())
}

fn change(action: AnnotationAction, out: &mut Outbox) -> Acted {
    out.work(Work::Annotate(
        vec![action.into()],
        AnnotateOptions::default(),
    ));
    Acted::Yes
}

fn add(contents: &Contents, seen: &Seen<'_>, out: &mut Outbox) -> Acted {
    let (Some(tier), Some(span)) = (tier(contents, seen), seen.shown.span) else {
        return Acted::Cannot(shell::NEEDS_SELECTION);
    };
    let action = AnnotationAction::Add {
        tier: TierName::Number(tier.row.id),
        start: Some(Moment::Time(span.start())),
        end: Some(Moment::Time(span.end())),
        parent: None,
        order: None,
        value: String::new(),
        confidence: None,
    };
    change(action, out)
}

fn split(seen: &Seen<'_>, out: &mut Outbox) -> Acted {
    let Some(annotation) = seen.shown.annotation() else {
        return Acted::Cannot(shell::NEEDS_ANNOTATION);
    };
    let at = Moment::Time(seen.shown.player.playhead());
    change(
        AnnotationAction::Split {
            annotation: AnnotationName::Number(annotation),
            at,
        },
        out,
    )
}

fn delete(seen: &Seen<'_>, out: &mut Outbox) -> Acted {
    if seen.shown.annotations.is_empty() {
        return Acted::Cannot(shell::NEEDS_ANNOTATION);
    }
    let remove = |id: &i64| {
        AnnotationAction::Remove {
            annotation: AnnotationName::Number(*id),
        }
        .into()
    };
    let changes = seen.shown.annotations.iter().map(remove).collect();
    out.work(Work::Annotate(changes, AnnotateOptions::default()));
    Acted::Yes
}

/// Selects the annotation after or before the selected one, or the playhead, on the selected tier.
fn walk(contents: &Contents, seen: &Seen<'_>, out: &mut Outbox, forwards: bool) -> Acted {
    let Some(tier) = tier(contents, seen) else {
        return Acted::Yes;
    };
    let columns = &tier.annotations;
    let selected = seen
        .shown
        .annotation()
        .and_then(|id| columns.ids.iter().position(|it| *it == id));
    let playhead = seen.shown.player.playhead().micros();
    let next = match (selected, forwards) {
        (Some(at), true) => Some(at + 1),
        (Some(at), false) => at.checked_sub(1),
        (None, true) => Some(columns.starts.partition_point(|start| *start < playhead)),
        (None, false) => columns
            .starts
            .partition_point(|start| *start < playhead)
            .checked_sub(1),
    };
    if let Some(at) = next.filter(|at| *at < columns.len()) {
        select(tier, at, out);
    }
    Acted::Yes
}

/// Selects an annotation with its tier and span, and goes to its start, as ELAN does.
pub(super) fn select(tier: &TierContents, at: usize, out: &mut Outbox) {
    let span = tier.annotations.span(at);
    out.send(Command::Tier(Some(tier.row.id)));
    out.send(Command::Annotations(BTreeSet::from([
        tier.annotations.ids[at]
    ])));
    out.send(Command::Span(Some(span)));
    out.seek(span.start());
}

/// Selects the tier below or above, and what it has at the playhead.
fn step_tier(contents: &Contents, seen: &Seen<'_>, out: &mut Outbox, by: isize) -> Acted {
    let here = contents
        .tiers
        .iter()
        .position(|it| Some(it.row.id) == seen.shown.tier);
    let next = here.map_or(Some(0), |here| here.checked_add_signed(by));
    if let Some(tier) = next.and_then(|next| contents.tiers.get(next)) {
        out.send(Command::Tier(Some(tier.row.id)));
        let playhead = seen.shown.player.playhead().micros();
        let under = data::at(&tier.annotations, playhead).map(|at| tier.annotations.ids[at]);
        out.send(Command::Annotations(under.into_iter().collect()));
    }
    Acted::Yes
}
