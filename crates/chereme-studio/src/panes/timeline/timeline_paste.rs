//! Copying, cutting, pasting and duplicating annotations.

use std::collections::BTreeSet;

use chereme_corpus::annotate_clipboard::{self, ClipboardText, CopiedAnnotation, OddLine, OddReason};
use chereme_corpus::annotate_paste::{PastePlan, PastedAnnotation, inventory_allows_value, plan_paste};
use chereme_corpus::{AnnotationChange, RecordingContents, TierContents, requests};

use super::timeline_data::time_text;
use super::timeline_edit::{self, TimelineScene};
use super::{ChangeFollowUp, GhostAnnotation, TimelinePane, dragged, paste_box, tier_list};
use crate::action::Action;
use crate::command::{CommandOutbox, WindowCommand};
use crate::panes::ActionOutcome;
use crate::words::{InterfaceText, fill_text_braces, shell, timeline as words};

/// Carries out an action of the clipboard.
pub(super) fn carry_out_clipboard_action(
    timeline: &mut TimelinePane,
    action: Action,
    scene: &TimelineScene<'_>,
) -> ActionOutcome {
    match action {
        Action::Copy => copy_chosen_annotations(scene, false),
        Action::CopyWithBelow => copy_chosen_annotations(scene, true),
        Action::Cut => {
            let chosen = chosen_annotation_ids(scene);
            let copied = copy_chosen_annotations(scene, true);
            if copied == ActionOutcome::Yes {
                let gone = requests::remove_annotation_changes(scene.contents, &chosen);
                timeline.request_annotation_changes(gone, ChangeFollowUp::default(), scene.seen.out);
            }
            copied
        }
        Action::CopyTime => {
            let text = time_text(scene.seen.shown.player.player_playhead());
            let message = fill_text_braces(scene.seen.say_text(words::TIME_COPIED), &[("time", &text)]);
            scene.seen.send_command(WindowCommand::Copy(text));
            scene.seen.send_command(WindowCommand::Say(message));
            ActionOutcome::Yes
        }
        Action::Paste | Action::PasteHere => match timeline.boxes.clip.take() {
            Some(text) => paste_clipboard_text(timeline, scene, &text, action == Action::PasteHere),
            None => ActionOutcome::Cannot(words::NOTHING_TO_PASTE),
        },
        Action::Duplicate => duplicate_chosen_annotations(timeline, scene),
        _ => ActionOutcome::No,
    }
}

/// Returns the selected annotations, else the one at the playhead.
fn chosen_annotation_ids(scene: &TimelineScene<'_>) -> BTreeSet<i64> {
    let chosen = &scene.seen.shown.annotations;
    if chosen.is_empty() {
        return timeline_edit::annotation_selected_alone(scene).into_iter().collect();
    }
    chosen.clone()
}

/// Returns annotations as lines of the clipboard's text, tier by tier.
fn copied_rows(contents: &RecordingContents, chosen: &BTreeSet<i64>) -> Vec<CopiedAnnotation> {
    let mut all = Vec::new();
    for tier in &contents.tiers {
        let columns = &tier.annotations;
        all.extend(
            dragged::chosen_annotation_indices(tier, chosen).map(|at| CopiedAnnotation {
                line: 0,
                tier: Some(tier.row.name.clone()),
                start: columns.starts[at],
                end: columns.ends[at],
                value: requests::typed_annotation_value(columns, at),
            }),
        );
    }
    all
}

fn copy_chosen_annotations(scene: &TimelineScene<'_>, with_below: bool) -> ActionOutcome {
    let mut chosen = chosen_annotation_ids(scene);
    if chosen.is_empty() {
        return ActionOutcome::Cannot(shell::NEEDS_ANNOTATION);
    }
    if with_below {
        chosen = dragged::with_below(scene.contents, chosen);
    }
    let all = copied_rows(scene.contents, &chosen);
    let rows = all.iter().map(|copied| {
        let tier = copied.tier.as_deref().unwrap_or_default();
        (tier, copied.start, copied.end, copied.value.clone())
    });
    scene
        .seen
        .send_command(WindowCommand::Copy(annotate_clipboard::write_clipboard_text(rows)));
    let text = scene.seen.say_text(words::COPIED);
    scene
        .seen
        .send_command(WindowCommand::Say(fill_text_braces(text, &[("n", &all.len())])));
    ActionOutcome::Yes
}

fn paste_clipboard_text(
    timeline: &mut TimelinePane,
    scene: &TimelineScene<'_>,
    text: &str,
    here: bool,
) -> ActionOutcome {
    let frames = scene.recording_frame_times();
    let frame = |at: u64| frames.map(|frames| frames.snap_frame_start(at));
    let (rows, odd) = match annotate_clipboard::read_clipboard_text(text, frame) {
        ClipboardText::Rows(rows, odd) => (rows, odd),
        ClipboardText::Values(values) => return assign_spoken_values(timeline, scene, values),
    };
    let Some(tier) = scene.edited_tier() else {
        return ActionOutcome::Cannot(words::NEEDS_TIER);
    };
    let here = here.then(|| scene.scene_playhead_micros());
    let mut plan = scene.plan_annotation_paste(tier, rows, here);
    let mut tiers = plan.adds.iter().filter_map(|pasted| scene.tier_of(pasted.tier));
    if tiers.any(timeline_edit::holds_proposals) {
        return ActionOutcome::Cannot(words::HOLDS_PROPOSALS);
    }
    plan.odd.extend(odd);
    plan.odd.sort_by_key(|odd_row| odd_row.line);
    if plan.odd.is_empty() {
        return add_pasted_annotations(timeline, &plan.adds, scene.seen.out);
    }
    // Text that was copied here and has no free place needs no list of lines.
    let taken = plan.odd.iter().all(|odd_row| odd_row.why == OddReason::Taken);
    if plan.adds.is_empty() && taken {
        let why = if here.is_some() {
            words::NO_ROOM
        } else {
            words::PASTE_TAKEN
        };
        return ActionOutcome::Cannot(why);
    }
    timeline.boxes.paste_box = Some(paste_box::PasteBox { plan });
    ActionOutcome::Yes
}

/// Adds annotations as one operation, and selects the new ones.
pub(super) fn add_pasted_annotations(
    timeline: &mut TimelinePane,
    adds: &[PastedAnnotation],
    out: &CommandOutbox,
) -> ActionOutcome {
    if adds.is_empty() {
        return ActionOutcome::Cannot(words::NOTHING_TO_PASTE);
    }
    let asked: Vec<AnnotationChange> = adds
        .iter()
        .map(|pasted| {
            let (start, end) = pasted.span;
            requests::add_annotation_change(pasted.tier, start, end, &pasted.value)
        })
        .collect();
    let ghosts = adds.iter().map(|pasted| GhostAnnotation {
        tier: pasted.tier,
        id: None,
        start: pasted.span.0,
        end: pasted.span.1,
    });
    let then = ChangeFollowUp {
        select: true,
        ghosts: ghosts.collect(),
        ..ChangeFollowUp::default()
    };
    timeline.request_annotation_changes(asked, then, out)
}

/// Gives values to the selected annotations, one after the other. If only one is selected, the values go to it and
/// those after it; if none is selected, the first value goes to a new annotation on the selected time.
fn assign_spoken_values(
    timeline: &mut TimelinePane,
    scene: &TimelineScene<'_>,
    values: Vec<(usize, String)>,
) -> ActionOutcome {
    let Some(tier) = scene.edited_tier() else {
        return ActionOutcome::Cannot(words::NEEDS_TIER);
    };
    if timeline_edit::holds_proposals(tier) {
        return ActionOutcome::Cannot(words::HOLDS_PROPOSALS);
    }
    let shown = scene.seen.shown;
    let columns = &tier.annotations;
    let chosen_places: Vec<usize> = dragged::chosen_annotation_indices(tier, &shown.annotations).collect();
    let places = match (chosen_places.as_slice(), values.as_slice()) {
        (_, []) => return ActionOutcome::Cannot(words::NOTHING_TO_PASTE),
        ([], [(_, value)]) => {
            let Some(span) = shown.span else {
                return ActionOutcome::Cannot(shell::NEEDS_ANNOTATION);
            };
            let wanted = span.span_bounds_micros();
            return match dragged::room_for_annotation(scene.contents, tier, wanted) {
                Some(span) => {
                    let (tier, value) = (tier.row.id, value.clone());
                    add_pasted_annotations(timeline, &[PastedAnnotation { tier, span, value }], scene.seen.out)
                }
                None => ActionOutcome::Cannot(timeline_edit::no_room(tier)),
            };
        }
        ([], _) => return ActionOutcome::Cannot(shell::NEEDS_ANNOTATION),
        // A table column pasted at one cell goes on below it, in spreadsheets, too.
        ([one], _) => (*one..columns.len()).collect(),
        _ => chosen_places,
    };
    let is_known = |value: &str| scene.is_tier_value_known(tier, value);
    let mut odd = Vec::new();
    let mut asked = Vec::new();
    let mut places = places.into_iter();
    for (line, text) in values {
        let Some(at) = places.next() else {
            let why = OddReason::Left;
            odd.push(OddLine {
                line,
                why,
                text,
                at: None,
            });
            continue;
        };
        if is_known(&text) {
            asked.extend(requests::set_value(&BTreeSet::from([columns.ids[at]]), &text));
        } else {
            let why = OddReason::Value;
            odd.push(OddLine {
                line,
                why,
                text,
                at: None,
            });
        }
    }
    if let Some(first) = odd.first() {
        let text = odd_text(scene, first);
        let what: [(&str, &dyn std::fmt::Display); 2] = [("n", &first.line), ("what", &text)];
        scene.seen.send_command(WindowCommand::Say(fill_text_braces(
            scene.seen.say_text(words::PASTE_LINE),
            &what,
        )));
    }
    if asked.is_empty() {
        return ActionOutcome::Yes;
    }
    timeline.request_annotation_changes(asked, ChangeFollowUp::default(), scene.seen.out)
}

/// Copies selected annotations on other tiers to the selected tier; those on the selected tier are copied behind
/// themselves if there is room.
fn duplicate_chosen_annotations(timeline: &mut TimelinePane, scene: &TimelineScene<'_>) -> ActionOutcome {
    let chosen = chosen_annotation_ids(scene);
    let (Some(tier), false) = (scene.edited_tier(), chosen.is_empty()) else {
        return ActionOutcome::Cannot(shell::NEEDS_ANNOTATION);
    };
    let chosen_indices: Vec<usize> = dragged::chosen_annotation_indices(tier, &chosen).collect();
    let columns = &tier.annotations;
    let Some(last) = chosen_indices.last() else {
        return match tier_list::put_selection_on_tier(timeline, scene, tier.row.id, false) {
            Some(why) => ActionOutcome::Cannot(why),
            None => ActionOutcome::Yes,
        };
    };
    if chosen_indices.len() < chosen.len() {
        return ActionOutcome::Cannot(words::ONE_TIER);
    }
    if timeline_edit::holds_proposals(tier) {
        return ActionOutcome::Cannot(words::HOLDS_PROPOSALS);
    }
    let mut all = copied_rows(scene.contents, &chosen);
    let end = columns.ends[*last];
    if let [one] = all.as_mut_slice() {
        let until = dragged::annotation_time_limits(scene.contents, scene.recording_frame_times().is_some()).to;
        let next = columns.starts.get(last + 1).map_or(until, |next_start| *next_start);
        // A single copy is shortened to the gap behind it; several would lose their rhythm.
        one.end = one.end.min(one.start + (next - end).max(dragged::MIN_ANNOTATION_US));
    }
    let plan = scene.plan_annotation_paste(tier, all, Some(end));
    if plan.odd.is_empty() {
        add_pasted_annotations(timeline, &plan.adds, scene.seen.out)
    } else {
        ActionOutcome::Cannot(words::NO_ROOM_BESIDE)
    }
}

/// Returns the sentence for a line without a place.
pub(super) fn odd_text(scene: &TimelineScene<'_>, odd: &OddLine) -> String {
    let text = odd.at.map_or_else(|| odd.text.clone(), time_text);
    fill_text_braces(scene.seen.say_text(odd_reason_text(odd.why)), &[("text", &text)])
}

/// Returns the sentence for a reason; `{text}` stands for what it concerns.
fn odd_reason_text(why: OddReason) -> InterfaceText {
    match why {
        OddReason::Time => words::ODD_TIME,
        OddReason::Row => words::ODD_ROW,
        OddReason::Ends => words::ODD_ENDS,
        OddReason::Tier => words::ODD_TIER,
        OddReason::Value => words::ODD_VALUE,
        OddReason::Outside => words::ODD_OUTSIDE,
        OddReason::Parent => words::ODD_PARENT,
        OddReason::Taken => words::ODD_TAKEN,
        OddReason::Left => words::ODD_LEFT,
    }
}

impl TimelineScene<'_> {
    /// Returns whether a tier allows a value.
    fn is_tier_value_known(&self, tier: &TierContents, value: &str) -> bool {
        inventory_allows_value(self.scene_tier_inventory(tier), value)
    }

    fn plan_annotation_paste(&self, to: &TierContents, rows: Vec<CopiedAnnotation>, here: Option<i64>) -> PastePlan {
        let until = dragged::annotation_time_limits(self.contents, self.recording_frame_times().is_some()).to;
        let knows = |tier: &TierContents, value: &str| self.is_tier_value_known(tier, value);
        plan_paste(self.contents, Some(to), rows, here, until, knows)
    }
}
