//! The effect of actions on annotations: each is one operation of the corpus.

use std::collections::BTreeSet;

use chereme_corpus::snap::Frames;
use chereme_corpus::tier_values::{self, TierValues};
use chereme_corpus::{
    AnnotationChange, Contents, StoredInventory, TierContents, proposed_for, requests,
};
use chereme_motion::Span;

use super::dragged::{self, DraggedAnnotations, TierTiming};
use super::editor::{Editing, Target};
use super::spans::{Grip, Item};
use super::{Begun, Ghost, Then, Timeline};
use crate::action::Action;
use crate::context::{Outbox, PaneInput};
use crate::panes::Acted;
use crate::pickers;
use crate::words::{shell, timeline as words};

/// Length of one frame step in recordings without movement, in microseconds.
const STEP: i64 = 40_000;

/// The actions of the digits 1 to 9.
pub(super) const DIGITS: [Action; 9] = [
    Action::Value1,
    Action::Value2,
    Action::Value3,
    Action::Value4,
    Action::Value5,
    Action::Value6,
    Action::Value7,
    Action::Value8,
    Action::Value9,
];

/// The displayed recording, with the selection in it.
#[derive(Clone, Copy)]
pub(super) struct Scene<'a> {
    pub(super) contents: &'a Contents,
    pub(super) seen: &'a PaneInput<'a>,
}

impl<'a> Scene<'a> {
    pub(super) fn of(seen: &'a PaneInput<'a>) -> Option<Self> {
        let contents = seen.snapshot.contents(seen.shown.recording?)?;
        Some(Self { contents, seen })
    }

    /// Returns the tier that edits apply to: the selected one, else the first.
    pub(super) fn tier(&self) -> Option<&'a TierContents> {
        let tiers = &self.contents.tiers;
        let chosen = tiers
            .iter()
            .find(|it| Some(it.row.id) == self.seen.shown.tier);
        chosen.or_else(|| tiers.first())
    }

    pub(super) fn tier_of(&self, id: i64) -> Option<&'a TierContents> {
        self.contents.tiers.iter().find(|it| it.row.id == id)
    }

    pub(super) fn playhead(&self) -> i64 {
        self.seen.shown.player.playhead().micros()
    }

    /// Returns the time at the playhead for a boundary: that of the nearest frame if boundaries snap to frames.
    fn boundary(&self) -> i64 {
        let snaps = self.seen.settings.timeline.snaps.frames;
        let frames = self.frames().filter(|_| snaps);
        frames.map_or(self.playhead(), |it| it.nearest(self.playhead()))
    }

    /// Returns the frame times of the recording's movement, if it has any.
    pub(super) fn frames(&self) -> Option<Frames> {
        let glance = self.seen.snapshot.recording(self.contents.recording.id)?;
        let rate = glance.rate.filter(|_| glance.frames > 0)?;
        Some(Frames {
            rate,
            offset: glance.offset_us,
        })
    }

    /// Returns the start of the frame `by` frames later, in microseconds.
    pub(super) fn stepped(&self, micros: i64, by: i64) -> i64 {
        match self.frames() {
            Some(frames) => frames.stepped(micros, by),
            None => micros + by * STEP,
        }
    }

    pub(super) fn held(&self, chosen: &BTreeSet<i64>) -> Vec<DraggedAnnotations> {
        dragged::held(self.contents, chosen, self.frames().is_some())
    }

    pub(super) fn inventory(&self, tier: &TierContents) -> Option<&'a StoredInventory> {
        let all = &self.seen.snapshot.overview.inventories;
        all.iter().find(|it| Some(it.id) == tier.row.inventory_id)
    }

    pub(super) fn choices(&self, tier: &TierContents) -> TierValues {
        let language = self.seen.language.code();
        tier_values::values(tier, self.inventory(tier), language)
    }

    fn selection(&self) -> Option<(i64, i64)> {
        let span = self.seen.shown.span?;
        Some((span.start().micros(), span.end().micros()))
    }
}

/// Carries out an action that changes annotations.
pub(super) fn act(
    timeline: &mut Timeline,
    action: Action,
    scene: &Scene<'_>,
    out: &mut Outbox,
) -> Acted {
    let chosen = &scene.seen.shown.annotations;
    let digit = DIGITS.iter().position(|it| *it == action);
    match action {
        Action::NewAnnotation => create(timeline, scene),
        Action::BeginEndAnnotation => begin_or_end(timeline, scene, None, out),
        Action::SplitAnnotation => split(timeline, scene, out),
        Action::MergeAnnotation => merge(timeline, scene, out),
        Action::EnterValue | Action::EditValue if chosen.is_empty() => create(timeline, scene),
        Action::EnterValue | Action::EditValue => {
            timeline.edit(scene, chosen.clone());
            Acted::Yes
        }
        Action::PictureValue => by_picture(timeline, scene),
        Action::StartHere => reach(timeline, scene, Grip::Start, out),
        Action::EndHere => reach(timeline, scene, Grip::End, out),
        Action::ToSelection => to_selection(timeline, scene, out),
        Action::StartEarlier => nudge(timeline, scene, (Grip::Start, -1), out),
        Action::StartLater => nudge(timeline, scene, (Grip::Start, 1), out),
        Action::EndEarlier => nudge(timeline, scene, (Grip::End, -1), out),
        Action::EndLater => nudge(timeline, scene, (Grip::End, 1), out),
        Action::ShiftEarlier => nudge(timeline, scene, (Grip::Whole, -1), out),
        Action::ShiftLater => nudge(timeline, scene, (Grip::Whole, 1), out),
        Action::DeleteAnnotation | Action::ClearValue if chosen.is_empty() => {
            Acted::Cannot(shell::NEEDS_ANNOTATION)
        }
        Action::DeleteAnnotation => {
            let changes = requests::remove(scene.contents, chosen);
            timeline.change(changes, Then::default(), out)
        }
        Action::ClearValue => {
            timeline.change(requests::set_value(chosen, ""), Then::default(), out)
        }
        Action::CopyToTier | Action::MoveToTier if chosen.is_empty() => {
            Acted::Cannot(shell::NEEDS_ANNOTATION)
        }
        Action::CopyToTier | Action::MoveToTier => {
            timeline.boxes.choose =
                Some(super::tier_list::Choose::new(action == Action::MoveToTier));
            Acted::Yes
        }
        _ => match digit {
            Some(digit) => by_digit(timeline, scene, digit, out),
            None => Acted::No,
        },
    }
}

/// Opens the value field for a new annotation on the selected time; nothing is stored until the value is kept.
fn create(timeline: &mut Timeline, scene: &Scene<'_>) -> Acted {
    let (Some(tier), Some(wanted)) = (scene.tier(), scene.selection()) else {
        return if scene.contents.tiers.is_empty() {
            Acted::Cannot(words::NEEDS_TIER)
        } else {
            Acted::Cannot(shell::NEEDS_SELECTION)
        };
    };
    match dragged::room(scene.contents, tier, wanted) {
        Some(span) => timeline.edit_new(tier, span),
        None => Acted::Cannot(no_room(tier)),
    }
}

/// Opens the value field with pictures; if it is open already, switches between pictures and text.
fn by_picture(timeline: &mut Timeline, scene: &Scene<'_>) -> Acted {
    let chosen = &scene.seen.shown.annotations;
    if timeline.entry.editing.is_none() {
        let opened = if chosen.is_empty() {
            create(timeline, scene)
        } else {
            timeline.edit(scene, chosen.clone());
            Acted::Yes
        };
        if opened != Acted::Yes {
            return opened;
        }
    }
    let Some(editing) = &mut timeline.entry.editing else {
        return Acted::Yes;
    };
    let tier = editing.tier(scene);
    let pictured = tier
        .and_then(|tier| scene.inventory(tier))
        .is_some_and(|stored| has_pictures(&stored.inventory));
    if pictured {
        editing.turn_to_pictures();
        Acted::Yes
    } else {
        Acted::Cannot(words::NO_PICTURES)
    }
}

/// Returns whether values of an inventory have pictures.
pub(super) fn has_pictures(inventory: &chereme_sign::Inventory) -> bool {
    pickers::data::kind(inventory) != pickers::data::PickerForm::Names
}

/// Returns whether a tier holds proposals, which detectors add and people accept.
pub(super) fn holds_proposals(tier: &TierContents) -> bool {
    proposed_for(&tier.row.name).is_some()
}

/// Returns the reason why a tier has no room for an annotation.
pub(super) fn no_room(tier: &TierContents) -> crate::words::Text {
    match TierTiming::of(&tier.row) {
        TierTiming::Root => words::NO_ROOM,
        _ => words::NO_ROOM_BELOW,
    }
}

/// Begins an annotation at the playhead, or ends the one that was begun; its value is typed next if it has none and the
/// playhead rests.
fn begin_or_end(
    timeline: &mut Timeline,
    scene: &Scene<'_>,
    value: Option<&str>,
    out: &mut Outbox,
) -> Acted {
    let Some(tier) = scene.tier() else {
        return Acted::Cannot(words::NEEDS_TIER);
    };
    if holds_proposals(tier) {
        return Acted::Cannot(words::HOLDS_PROPOSALS);
    }
    let here = scene.boundary();
    let Some(begun) = timeline.entry.begun.take() else {
        timeline.entry.begun = Some(Begun {
            recording: scene.contents.recording.id,
            tier: tier.row.id,
            start: here,
            value: value.unwrap_or_default().to_owned(),
        });
        return Acted::Yes;
    };
    let next = value.filter(|value| *value != begun.value);
    if let Some(value) = next {
        timeline.entry.begun = Some(Begun {
            start: here,
            value: value.to_owned(),
            ..begun.clone()
        });
    }
    let Some(tier) = scene.tier_of(begun.tier) else {
        return Acted::Cannot(words::NEEDS_TIER);
    };
    let wanted = (begun.start.min(here), begun.start.max(here));
    match dragged::room(scene.contents, tier, wanted) {
        Some(span) => {
            let add = requests::add(begun.tier, span, &begun.value);
            let then = Then {
                edit: begun.value.is_empty() && !scene.seen.shown.player.plays_on(),
                ..Then::added(begun.tier, span)
            };
            timeline.change(vec![add], then, out)
        }
        None => Acted::Cannot(no_room(tier)),
    }
}

/// Gives the selected annotations the value of a digit. During playback it begins or ends an annotation with that
/// value; on a selected span it creates one.
fn by_digit(timeline: &mut Timeline, scene: &Scene<'_>, digit: usize, out: &mut Outbox) -> Acted {
    let Some(tier) = scene.tier() else {
        return Acted::Cannot(words::NEEDS_TIER);
    };
    let choices = scene.choices(tier);
    let given = timeline.entry.digits.of(tier.row.id, &choices);
    let Some(value) = given.get(digit).cloned() else {
        return Acted::Cannot(words::NO_DIGIT);
    };
    let shown = scene.seen.shown;
    if shown.player.plays_on() || timeline.entry.begun.is_some() {
        return begin_or_end(timeline, scene, Some(&value), out);
    }
    if !shown.annotations.is_empty() {
        return timeline.change(
            requests::set_value(&shown.annotations, &value),
            Then::default(),
            out,
        );
    }
    let Some(wanted) = scene.selection() else {
        return Acted::Cannot(shell::NEEDS_SELECTION);
    };
    if holds_proposals(tier) {
        return Acted::Cannot(words::HOLDS_PROPOSALS);
    }
    match dragged::room(scene.contents, tier, wanted) {
        Some(span) => {
            let add = requests::add(tier.row.id, span, &value);
            timeline.change(vec![add], Then::added(tier.row.id, span), out)
        }
        None => Acted::Cannot(no_room(tier)),
    }
}

/// Returns the annotation that is selected alone, else the one of the tier at the playhead.
pub(super) fn alone(scene: &Scene<'_>) -> Option<i64> {
    scene.seen.shown.annotation().or_else(|| {
        let tier = scene.tier()?;
        let at = super::data::at(&tier.annotations, scene.playhead())?;
        Some(tier.annotations.ids[at])
    })
}

fn split(timeline: &mut Timeline, scene: &Scene<'_>, out: &mut Outbox) -> Acted {
    let Some(annotation) = alone(scene) else {
        return Acted::Cannot(shell::NEEDS_ANNOTATION);
    };
    let found = scene.seen.snapshot.annotation(annotation);
    let inside = found.is_some_and(|it| {
        let span: Span = it.tier.annotations.span(it.at);
        span.contains(scene.seen.shown.player.playhead())
            && span.start().micros() != scene.playhead()
    });
    if !inside {
        return Acted::Cannot(words::SPLIT_INSIDE);
    }
    let change = requests::split(annotation, scene.playhead());
    timeline.change(vec![change], Then::default(), out)
}

fn merge(timeline: &mut Timeline, scene: &Scene<'_>, out: &mut Outbox) -> Acted {
    let Some(tier) = scene.tier() else {
        return Acted::Cannot(words::NEEDS_TIER);
    };
    let mut chosen = scene.seen.shown.annotations.clone();
    if chosen.is_empty() {
        chosen.extend(alone(scene));
    }
    let closed = scene.inventory(tier).is_some();
    match requests::merge(tier, &chosen, closed) {
        Some(changes) => timeline.change(changes, Then::default(), out),
        None => Acted::Cannot(words::NO_NEXT),
    }
}

/// Moves a boundary of the selected annotations, or the whole annotations, by frames.
fn nudge(
    timeline: &mut Timeline,
    scene: &Scene<'_>,
    (grip, frames): (Grip, i64),
    out: &mut Outbox,
) -> Acted {
    let all = scene.held(&scene.seen.shown.annotations);
    let first = all.first().and_then(first_of);
    let Some(first) = first else {
        return Acted::Cannot(shell::NEEDS_ANNOTATION);
    };
    let edge = if grip == Grip::End {
        first.end
    } else {
        first.start
    };
    let by = scene.stepped(edge, frames) - edge;
    drag(timeline, scene, &all, (grip, by), out)
}

/// Moves a boundary of the selected annotation to the playhead.
fn reach(timeline: &mut Timeline, scene: &Scene<'_>, grip: Grip, out: &mut Outbox) -> Acted {
    let chosen: BTreeSet<i64> = alone(scene).into_iter().collect();
    let all = scene.held(&chosen);
    let Some(first) = all.first().and_then(first_of) else {
        return Acted::Cannot(shell::NEEDS_ANNOTATION);
    };
    let edge = if grip == Grip::End {
        first.end
    } else {
        first.start
    };
    drag(timeline, scene, &all, (grip, scene.playhead() - edge), out)
}

fn first_of(held: &DraggedAnnotations) -> Option<Item> {
    let mut items = held.items.iter();
    items.find(|it| held.chosen.contains(&it.id)).copied()
}

fn drag(
    timeline: &mut Timeline,
    scene: &Scene<'_>,
    all: &[DraggedAnnotations],
    (grip, by): (Grip, i64),
    out: &mut Outbox,
) -> Acted {
    if all.iter().all(|held| held.kind == TierTiming::Listed) {
        return Acted::Cannot(words::NO_TIMES);
    }
    let mode = scene.seen.settings.timeline.mode;
    let mut asked = Vec::new();
    let mut ghosts = Vec::new();
    for held in all {
        let changed = held.dragged(grip, by, mode);
        asked.extend(requests::respan(&held.asked(&changed)));
        ghosts.extend(changed.iter().map(|item| Ghost::of(held.tier, item)));
    }
    if asked.is_empty() {
        return Acted::Cannot(words::BLOCKED);
    }
    timeline.change(
        asked,
        Then {
            ghosts,
            ..Then::default()
        },
        out,
    )
}

/// Sets the selected annotation to the selected time, by dragging its boundaries one after the other.
fn to_selection(timeline: &mut Timeline, scene: &Scene<'_>, out: &mut Outbox) -> Acted {
    let Some((start, end)) = scene.selection() else {
        return Acted::Cannot(shell::NEEDS_SELECTION);
    };
    let tier = scene.tier();
    let chosen = scene.seen.shown.annotation().or_else(|| {
        let tier = tier?;
        let columns = &tier.annotations;
        let first = columns.ends.partition_point(|it| *it <= start);
        (first < columns.len() && columns.starts[first] < end).then(|| columns.ids[first])
    });
    let Some(id) = chosen else {
        return Acted::Cannot(shell::NEEDS_ANNOTATION);
    };
    let mut all = scene.held(&BTreeSet::from([id]));
    let Some(held) = all.first_mut() else {
        return Acted::Cannot(shell::NEEDS_ANNOTATION);
    };
    let mode = scene.seen.settings.timeline.mode;
    let mut asked: Vec<AnnotationChange> = Vec::new();
    let later = first_of(held).is_some_and(|item| end > item.end);
    let steps = if later {
        [Grip::End, Grip::Start]
    } else {
        [Grip::Start, Grip::End]
    };
    for grip in steps {
        let Some(item) = first_of(held) else { break };
        let by = if grip == Grip::End {
            end - item.end
        } else {
            start - item.start
        };
        let changed = held.dragged(grip, by, mode);
        asked.extend(requests::respan(&held.asked(&changed)));
        for new in changed {
            if let Some(old) = held.items.iter_mut().find(|old| old.id == new.id) {
                *old = new;
            }
        }
    }
    if asked.is_empty() {
        return Acted::Cannot(words::BLOCKED);
    }
    timeline.change(asked, Then::default(), out)
}

/// Stores a typed value: requests the change of the annotations, or the new annotation.
pub(super) fn keep(timeline: &mut Timeline, editing: Editing, value: &str, out: &mut Outbox) {
    let (changes, ghosts, select) = match &editing.target {
        Target::Of(annotations) => (requests::set_value(annotations, value), Vec::new(), false),
        Target::New { tier, start, end } => {
            let ghost = Ghost {
                tier: *tier,
                id: None,
                start: *start,
                end: *end,
            };
            (
                vec![requests::add(*tier, (*start, *end), value)],
                vec![ghost],
                true,
            )
        }
    };
    let then = Then {
        select,
        ghosts,
        typed: Some(editing),
        ..Then::default()
    };
    timeline.change(changes, then, out);
}
