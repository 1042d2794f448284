//! The effect of actions on annotations: each is one operation of the corpus.

use std::collections::BTreeSet;

use chereme_corpus::snap::RecordingFrameTimes;
use chereme_corpus::tier_values::{self, TierValues};
use chereme_corpus::{AnnotationChange, RecordingContents, StoredInventory, TierContents, is_detector_tier, requests};
use chereme_motion::TimeSpan;

use super::dragged::{self, DraggedAnnotations, TierTiming};
use super::editor::{EditTarget, ValueEditing};
use super::tier_spans::{DragGrip, SpanItem};
use super::{BegunAnnotation, ChangeFollowUp, GhostAnnotation, TimelinePane, proposals};
use crate::action::Action;
use crate::command::CommandOutbox;
use crate::context::PaneInput;
use crate::panes::ActionOutcome;
use crate::pickers;
use crate::words::{shell, timeline as words};

/// Length of one frame step in recordings without movement, in microseconds.
const DEFAULT_FRAME_STEP_MICROS: i64 = 40_000;

/// The actions of the digits 1 to 9.
pub(super) const DIGIT_ACTIONS: [Action; 9] = [
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
pub(super) struct TimelineScene<'a> {
    pub(super) contents: &'a RecordingContents,
    pub(super) seen: &'a PaneInput<'a>,
}

impl<'a> TimelineScene<'a> {
    pub(super) fn new(contents: &'a RecordingContents, seen: &'a PaneInput<'a>) -> Self {
        Self { contents, seen }
    }

    pub(super) fn scene_from_input(seen: &'a PaneInput<'a>) -> Option<Self> {
        let contents = seen.snapshot.recording_contents(seen.shown.recording?)?;
        Some(Self::new(contents, seen))
    }

    /// Returns the tier that edits apply to: the selected one, else the first.
    pub(super) fn edited_tier(&self) -> Option<&'a TierContents> {
        let tiers = &self.contents.tiers;
        let chosen = tiers.iter().find(|tier| Some(tier.row.id) == self.seen.shown.tier);
        chosen.or_else(|| tiers.first())
    }

    pub(super) fn tier_of(&self, id: i64) -> Option<&'a TierContents> {
        self.contents.tiers.iter().find(|tier| tier.row.id == id)
    }

    pub(super) fn scene_playhead_micros(&self) -> i64 {
        self.seen.shown.player.player_playhead().instant_micros()
    }

    /// Returns the time at the playhead for a boundary: that of the nearest frame if boundaries snap to frames.
    fn boundary_at_playhead(&self) -> i64 {
        let snaps = self.seen.settings.timeline.snaps.frames;
        let frames = self.recording_frame_times().filter(|_| snaps);
        frames.map_or(self.scene_playhead_micros(), |frames| {
            frames.nearest_frame_start(self.scene_playhead_micros())
        })
    }

    /// Returns the frame times of the recording's movement, if it has any.
    pub(super) fn recording_frame_times(&self) -> Option<RecordingFrameTimes> {
        let glance = self.seen.snapshot.recording_glance(self.contents.recording.id)?;
        let rate = glance.rate.filter(|_| glance.frames > 0)?;
        Some(RecordingFrameTimes {
            rate,
            offset: glance.offset_us,
        })
    }

    /// Returns the start of the frame `by` frames later, in microseconds.
    pub(super) fn step_by_frames(&self, micros: i64, by: i64) -> i64 {
        match self.recording_frame_times() {
            Some(frames) => frames.stepped_frame_start(micros, by),
            None => micros + by * DEFAULT_FRAME_STEP_MICROS,
        }
    }

    pub(super) fn held_annotations(&self, chosen: &BTreeSet<i64>) -> Vec<DraggedAnnotations> {
        dragged::held_drag_groups(self.contents, chosen, self.recording_frame_times().is_some())
    }

    pub(super) fn scene_tier_inventory(&self, tier: &TierContents) -> Option<&'a StoredInventory> {
        let all = &self.seen.snapshot.overview.inventories;
        all.iter().find(|stored| Some(stored.id) == tier.row.inventory_id)
    }

    pub(super) fn scene_tier_values(&self, tier: &TierContents) -> TierValues {
        let language = self.seen.language.language_code();
        tier_values::collect_tier_values(tier, self.scene_tier_inventory(tier), language)
    }

    fn selected_time_span(&self) -> Option<(i64, i64)> {
        let span = self.seen.shown.span?;
        Some(span.span_bounds_micros())
    }
}

/// Carries out an action that changes annotations.
pub(super) fn carry_out_edit_action(
    timeline: &mut TimelinePane,
    action: Action,
    scene: &TimelineScene<'_>,
) -> ActionOutcome {
    let chosen = &scene.seen.shown.annotations;
    let digit = DIGIT_ACTIONS.iter().position(|digit_action| *digit_action == action);
    match action {
        Action::NewAnnotation => begin_new_annotation(timeline, scene),
        Action::BeginEndAnnotation => begin_or_end(timeline, scene, None),
        Action::SplitAnnotation => split_selected_annotation(timeline, scene),
        Action::MergeAnnotation => merge_selected_annotations(timeline, scene),
        Action::EnterValue | Action::EditValue if chosen.is_empty() => begin_new_annotation(timeline, scene),
        Action::EnterValue | Action::EditValue => {
            timeline.edit_annotation_values(scene, chosen.clone());
            ActionOutcome::Yes
        }
        Action::PictureValue => by_picture(timeline, scene),
        Action::StartHere => move_boundary_to_playhead(timeline, scene, DragGrip::Start),
        Action::EndHere => move_boundary_to_playhead(timeline, scene, DragGrip::End),
        Action::ToSelection => to_selection(timeline, scene),
        Action::StartEarlier => nudge(timeline, scene, DragGrip::Start, -1),
        Action::StartLater => nudge(timeline, scene, DragGrip::Start, 1),
        Action::EndEarlier => nudge(timeline, scene, DragGrip::End, -1),
        Action::EndLater => nudge(timeline, scene, DragGrip::End, 1),
        Action::ShiftEarlier => nudge(timeline, scene, DragGrip::Whole, -1),
        Action::ShiftLater => nudge(timeline, scene, DragGrip::Whole, 1),
        Action::DeleteAnnotation | Action::ClearValue if chosen.is_empty() => {
            ActionOutcome::Cannot(shell::NEEDS_ANNOTATION)
        }
        // A proposal that a person removes is rejected, so that it is not proposed again.
        Action::DeleteAnnotation if proposals::reject_selected_proposals(timeline, scene) => ActionOutcome::Yes,
        Action::DeleteAnnotation => {
            let changes = requests::remove_annotation_changes(scene.contents, chosen);
            timeline.request_annotation_changes(changes, ChangeFollowUp::default(), scene.seen.out)
        }
        Action::ClearValue => timeline.request_annotation_changes(
            requests::set_value(chosen, ""),
            ChangeFollowUp::default(),
            scene.seen.out,
        ),
        Action::CopyToTier | Action::MoveToTier if chosen.is_empty() => ActionOutcome::Cannot(shell::NEEDS_ANNOTATION),
        Action::CopyToTier | Action::MoveToTier => {
            timeline.boxes.choose = Some(super::tier_list::TierChooser::new(action == Action::MoveToTier));
            ActionOutcome::Yes
        }
        _ => match digit {
            Some(digit) => by_digit(timeline, scene, digit),
            None => ActionOutcome::No,
        },
    }
}

/// Opens the value field for a new annotation on the selected time; nothing is stored until the value is kept.
fn begin_new_annotation(timeline: &mut TimelinePane, scene: &TimelineScene<'_>) -> ActionOutcome {
    let (Some(tier), Some(wanted)) = (scene.edited_tier(), scene.selected_time_span()) else {
        return if scene.contents.tiers.is_empty() {
            ActionOutcome::Cannot(words::NEEDS_TIER)
        } else {
            ActionOutcome::Cannot(shell::NEEDS_SELECTION)
        };
    };
    match dragged::room_for_annotation(scene.contents, tier, wanted) {
        Some((start, end)) => timeline.edit_new(tier, start, end),
        None => ActionOutcome::Cannot(no_room(tier)),
    }
}

/// Opens the value field with pictures; if it is open already, switches between pictures and text.
fn by_picture(timeline: &mut TimelinePane, scene: &TimelineScene<'_>) -> ActionOutcome {
    let chosen = &scene.seen.shown.annotations;
    if timeline.entry.editing.is_none() {
        let opened = if chosen.is_empty() {
            begin_new_annotation(timeline, scene)
        } else {
            timeline.edit_annotation_values(scene, chosen.clone());
            ActionOutcome::Yes
        };
        if opened != ActionOutcome::Yes {
            return opened;
        }
    }
    let Some(editing) = &mut timeline.entry.editing else {
        return ActionOutcome::Yes;
    };
    let tier = editing.editing_tier(scene);
    let pictured = tier
        .and_then(|tier| scene.scene_tier_inventory(tier))
        .is_some_and(|stored| has_pictures(&stored.inventory));
    if pictured {
        editing.turn_to_pictures();
        ActionOutcome::Yes
    } else {
        ActionOutcome::Cannot(words::NO_PICTURES)
    }
}

/// Returns whether values of an inventory have pictures.
pub(super) fn has_pictures(inventory: &chereme_sign::ComponentInventory) -> bool {
    pickers::pickers_data::inventory_picker_form(inventory) != pickers::pickers_data::PickerForm::Names
}

/// Returns whether a tier holds proposals, which detectors add and people accept, or such as people rejected.
pub(super) fn holds_proposals(tier: &TierContents) -> bool {
    is_detector_tier(&tier.row.name)
}

/// Returns the reason why a tier has no room for an annotation.
pub(super) fn no_room(tier: &TierContents) -> crate::words::InterfaceText {
    match TierTiming::timing_of_tier(&tier.row) {
        TierTiming::Root => words::NO_ROOM,
        _ => words::NO_ROOM_BELOW,
    }
}

/// Begins an annotation at the playhead, or ends the one that was begun; its value is typed next if it has none and the
/// playhead rests.
fn begin_or_end(timeline: &mut TimelinePane, scene: &TimelineScene<'_>, value: Option<&str>) -> ActionOutcome {
    let Some(tier) = scene.edited_tier() else {
        return ActionOutcome::Cannot(words::NEEDS_TIER);
    };
    if holds_proposals(tier) {
        return ActionOutcome::Cannot(words::HOLDS_PROPOSALS);
    }
    // The boundary is read at the key, not when the value is known.
    let here = scene.boundary_at_playhead();
    let Some(begun) = timeline.entry.begun.take() else {
        timeline.entry.begun = Some(BegunAnnotation {
            recording: scene.contents.recording.id,
            tier: tier.row.id,
            start: here,
            value: value.unwrap_or_default().to_owned(),
        });
        return ActionOutcome::Yes;
    };
    // Another digit during playback ends one annotation and begins the next at the same time.
    let next = value.filter(|value| *value != begun.value);
    if let Some(value) = next {
        timeline.entry.begun = Some(BegunAnnotation {
            start: here,
            value: value.to_owned(),
            ..begun.clone()
        });
    }
    let Some(tier) = scene.tier_of(begun.tier) else {
        return ActionOutcome::Cannot(words::NEEDS_TIER);
    };
    let wanted = (begun.start.min(here), begun.start.max(here));
    match dragged::room_for_annotation(scene.contents, tier, wanted) {
        Some((start, end)) => {
            let add = requests::add_annotation_change(begun.tier, start, end, &begun.value);
            let then = ChangeFollowUp {
                // While it plays, the next annotation may begin before a value could be typed.
                edit: begun.value.is_empty() && !scene.seen.shown.player.plays_on(),
                ..ChangeFollowUp::follow_up_for_addition(begun.tier, start, end)
            };
            timeline.request_annotation_changes(vec![add], then, scene.seen.out)
        }
        None => ActionOutcome::Cannot(no_room(tier)),
    }
}

/// Gives the selected annotations the value of a digit. During playback it begins or ends an annotation with that
/// value; on a selected span it creates one.
fn by_digit(timeline: &mut TimelinePane, scene: &TimelineScene<'_>, digit: usize) -> ActionOutcome {
    let Some(tier) = scene.edited_tier() else {
        return ActionOutcome::Cannot(words::NEEDS_TIER);
    };
    let choices = scene.scene_tier_values(tier);
    let given = timeline.entry.digits.digit_values_of_tier(tier.row.id, &choices);
    let Some(value) = given.get(digit).cloned() else {
        return ActionOutcome::Cannot(words::NO_DIGIT);
    };
    let shown = scene.seen.shown;
    // During playback digits mark times; at rest they set values.
    if shown.player.plays_on() || timeline.entry.begun.is_some() {
        return begin_or_end(timeline, scene, Some(&value));
    }
    if !shown.annotations.is_empty() {
        return timeline.request_annotation_changes(
            requests::set_value(&shown.annotations, &value),
            ChangeFollowUp::default(),
            scene.seen.out,
        );
    }
    let Some(wanted) = scene.selected_time_span() else {
        return ActionOutcome::Cannot(shell::NEEDS_SELECTION);
    };
    if holds_proposals(tier) {
        return ActionOutcome::Cannot(words::HOLDS_PROPOSALS);
    }
    match dragged::room_for_annotation(scene.contents, tier, wanted) {
        Some((start, end)) => {
            let add = requests::add_annotation_change(tier.row.id, start, end, &value);
            timeline.request_annotation_changes(
                vec![add],
                ChangeFollowUp::follow_up_for_addition(tier.row.id, start, end),
                scene.seen.out,
            )
        }
        None => ActionOutcome::Cannot(no_room(tier)),
    }
}

/// Returns the annotation that is selected alone, else the one of the tier at the playhead.
pub(super) fn annotation_selected_alone(scene: &TimelineScene<'_>) -> Option<i64> {
    scene.seen.shown.selected_annotation().or_else(|| {
        let tier = scene.edited_tier()?;
        let index = super::timeline_data::annotation_index_at(&tier.annotations, scene.scene_playhead_micros())?;
        Some(tier.annotations.ids[index])
    })
}

fn split_selected_annotation(timeline: &mut TimelinePane, scene: &TimelineScene<'_>) -> ActionOutcome {
    let Some(annotation) = annotation_selected_alone(scene) else {
        return ActionOutcome::Cannot(shell::NEEDS_ANNOTATION);
    };
    let located = scene.seen.snapshot.find_open_annotation(annotation);
    let inside = located.is_some_and(|place| {
        let span: TimeSpan = place.tier.annotations.annotation_span_at(place.at);
        span.has_instant(scene.seen.shown.player.player_playhead())
            // At its very start there is nothing to split off.
            && span.span_start_instant().instant_micros() != scene.scene_playhead_micros()
    });
    if !inside {
        return ActionOutcome::Cannot(words::SPLIT_INSIDE);
    }
    let change = requests::split_annotation_change(annotation, scene.scene_playhead_micros());
    timeline.request_annotation_changes(vec![change], ChangeFollowUp::default(), scene.seen.out)
}

fn merge_selected_annotations(timeline: &mut TimelinePane, scene: &TimelineScene<'_>) -> ActionOutcome {
    let Some(tier) = scene.edited_tier() else {
        return ActionOutcome::Cannot(words::NEEDS_TIER);
    };
    let mut chosen = scene.seen.shown.annotations.clone();
    if chosen.is_empty() {
        chosen.extend(annotation_selected_alone(scene));
    }
    let closed = scene.scene_tier_inventory(tier).is_some();
    match requests::merge_annotation_changes(tier, &chosen, closed) {
        Some(changes) => timeline.request_annotation_changes(changes, ChangeFollowUp::default(), scene.seen.out),
        None => ActionOutcome::Cannot(words::NO_NEXT),
    }
}

/// Moves a boundary of the selected annotations, or the whole annotations, by frames.
fn nudge(timeline: &mut TimelinePane, scene: &TimelineScene<'_>, grip: DragGrip, frames: i64) -> ActionOutcome {
    let all = scene.held_annotations(&scene.seen.shown.annotations);
    // The first annotation decides the step, since frames need not be equally long in microseconds.
    let first = all.first().and_then(first_of);
    let Some(first) = first else {
        return ActionOutcome::Cannot(shell::NEEDS_ANNOTATION);
    };
    let edge = if grip == DragGrip::End { first.end } else { first.start };
    let by = scene.step_by_frames(edge, frames) - edge;
    move_dragged_annotations(timeline, scene, &all, grip, by)
}

/// Moves a boundary of the selected annotation to the playhead.
fn move_boundary_to_playhead(timeline: &mut TimelinePane, scene: &TimelineScene<'_>, grip: DragGrip) -> ActionOutcome {
    let chosen: BTreeSet<i64> = annotation_selected_alone(scene).into_iter().collect();
    let all = scene.held_annotations(&chosen);
    let Some(first) = all.first().and_then(first_of) else {
        return ActionOutcome::Cannot(shell::NEEDS_ANNOTATION);
    };
    let edge = if grip == DragGrip::End { first.end } else { first.start };
    move_dragged_annotations(timeline, scene, &all, grip, scene.scene_playhead_micros() - edge)
}

fn first_of(held: &DraggedAnnotations) -> Option<SpanItem> {
    let mut items = held.items.iter();
    items.find(|item| held.chosen.contains(&item.id)).copied()
}

fn move_dragged_annotations(
    timeline: &mut TimelinePane,
    scene: &TimelineScene<'_>,
    all: &[DraggedAnnotations],
    grip: DragGrip,
    by: i64,
) -> ActionOutcome {
    if all.iter().all(|held| held.kind == TierTiming::Listed) {
        return ActionOutcome::Cannot(words::NO_TIMES);
    }
    let mode = scene.seen.settings.timeline.mode;
    let mut asked = Vec::new();
    let mut ghosts = Vec::new();
    for held in all {
        let changed = held.drag_annotations(grip, by, mode);
        asked.extend(requests::set_times_changes(&held.requested_drag_changes(&changed)));
        ghosts.extend(
            changed
                .iter()
                .map(|item| GhostAnnotation::ghost_from_item(held.tier, item)),
        );
    }
    // Neighbours or limits let nothing move.
    if asked.is_empty() {
        return ActionOutcome::Cannot(words::BLOCKED);
    }
    timeline.request_annotation_changes(
        asked,
        ChangeFollowUp {
            ghosts,
            ..ChangeFollowUp::default()
        },
        scene.seen.out,
    )
}

/// Sets the selected annotation to the selected time, by dragging its boundaries one after the other.
fn to_selection(timeline: &mut TimelinePane, scene: &TimelineScene<'_>) -> ActionOutcome {
    let Some((start, end)) = scene.selected_time_span() else {
        return ActionOutcome::Cannot(shell::NEEDS_SELECTION);
    };
    let tier = scene.edited_tier();
    let chosen = scene.seen.shown.selected_annotation().or_else(|| {
        let tier = tier?;
        let columns = &tier.annotations;
        let first = columns.ends.partition_point(|other_end| *other_end <= start);
        (first < columns.len() && columns.starts[first] < end).then(|| columns.ids[first])
    });
    let Some(id) = chosen else {
        return ActionOutcome::Cannot(shell::NEEDS_ANNOTATION);
    };
    let mut all = scene.held_annotations(&BTreeSet::from([id]));
    let Some(held) = all.first_mut() else {
        return ActionOutcome::Cannot(shell::NEEDS_ANNOTATION);
    };
    let mode = scene.seen.settings.timeline.mode;
    let mut asked: Vec<AnnotationChange> = Vec::new();
    // If it moves later, the end goes first, or the annotation would cross itself.
    let later = first_of(held).is_some_and(|item| end > item.end);
    let steps = if later {
        [DragGrip::End, DragGrip::Start]
    } else {
        [DragGrip::Start, DragGrip::End]
    };
    for grip in steps {
        let Some(item) = first_of(held) else { break };
        let by = if grip == DragGrip::End {
            end - item.end
        } else {
            start - item.start
        };
        let changed = held.drag_annotations(grip, by, mode);
        asked.extend(requests::set_times_changes(&held.requested_drag_changes(&changed)));
        // The second boundary starts from where the first one is now.
        for new in changed {
            if let Some(old) = held.items.iter_mut().find(|old| old.id == new.id) {
                *old = new;
            }
        }
    }
    if asked.is_empty() {
        return ActionOutcome::Cannot(words::BLOCKED);
    }
    timeline.request_annotation_changes(asked, ChangeFollowUp::default(), scene.seen.out)
}

/// Stores a typed value: requests the change of the annotations, or the new annotation.
pub(super) fn store_typed_value(timeline: &mut TimelinePane, editing: ValueEditing, value: &str, out: &CommandOutbox) {
    let (changes, ghosts, select) = match &editing.target {
        EditTarget::Of(annotations) => (requests::set_value(annotations, value), Vec::new(), false),
        EditTarget::New { tier, start, end } => {
            let ghost = GhostAnnotation {
                tier: *tier,
                id: None,
                start: *start,
                end: *end,
            };
            (
                vec![requests::add_annotation_change(*tier, *start, *end, value)],
                vec![ghost],
                true,
            )
        }
    };
    let then = ChangeFollowUp {
        select,
        ghosts,
        typed: Some(editing),
        ..ChangeFollowUp::default()
    };
    timeline.request_annotation_changes(changes, then, out);
}
