//! The timeline: tiers with their annotations, the selected time, and the playhead.
//!
//! | module | holds |
//! |---|---|
//! | `data` | positions of times, ticks, bars |
//! | `rows` | the tier of each row |
//! | `dragged`, `snap` | times of annotations in a drag |
//! | `changes` | requests to the corpus |
//! | `values` | the possible values of a tier, and the digits |
//! | `proposals` | values proposed from movement, until a person accepts them |
//! | `lanes`, `lane_shape`, `lanes_ui` | movement as lanes |
//! | `overview` | the whole recording in a strip |
//! | `view_settings` | stored modes and switches |
//! | `edit`, `select`, `tiers`, `neighbours` | effects of actions |
//! | `copied`, `paste`, `paste_box` | the clipboard: its text, places for pasted annotations, lines without a place |
//! | `ui`, `names`, `above`, `paint` | rows, the names of tiers, the layer above them, painting |
//! | `gesture`, `drag`, `menu` | mouse gestures: their begin, their course, the context menu |
//! | `editor`, `value_list` | the field for values, and the list of matching values below it |
//! | `tier_list`, `detector_list`, `tier_box`, `go_to_time` | boxes that choose a tier or a detector, edit a tier, or go to a time |
//! | `bar` | the tools |

mod above;
pub(crate) mod bar;
mod detector_list;
pub(crate) mod draft_file;
mod drag;
mod dragged;
mod editor;
mod gesture;
mod go_to_time;
mod lane_shape;
mod lanes_ui;
mod menu;
mod neighbours;
mod paste_box;
mod proposals;
mod select;
pub(crate) mod tier_box;
mod tier_list;
pub(crate) mod timeline_data;
mod timeline_edit;
pub(crate) mod timeline_lanes;
mod timeline_names;
mod timeline_overview;
pub(crate) mod timeline_paint;
mod timeline_parts;
mod timeline_paste;
mod timeline_rows;
mod timeline_tiers;
mod timeline_ui;
mod timeline_values;
mod timeline_view_settings;
mod value_list;

use std::collections::{BTreeMap, BTreeSet};

use chereme_corpus::{TierContents, TierRole, requests};
use eframe::egui::{Context, Id};
use serde::{Deserialize, Serialize};

use crate::action::Action;
use crate::command::{CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::model::time_window::TimeWindow;
use crate::panes::{ActionOutcome, PaneInterface};
use crate::player::StagePlayer;
use crate::words::timeline as words;
use crate::work::{WorkId, WorkOutcome, WorkResult, editing};
use chereme_sign::tier::tier_spans::{self, SpanItem};
use editor::{EditTarget, ValueEditing};
use timeline_edit::TimelineScene;
use timeline_parts::{RequestedChanges, TimelineBoxes, TimelineView, ValueEntry};

/// Returns a recording with one tier of annotations, each given as id, start and end.
#[cfg(test)]
pub(crate) fn contents_of(annotations: &[(i64, i64, i64)]) -> chereme_corpus::RecordingContents {
    let with_parents = annotations.iter().map(|(id, start, end)| (*id, *start, *end, None));
    let all: Vec<_> = with_parents.collect();
    dragged::tests::contents(&[(1, None, "", &all)])
}

/// The pane.
#[derive(Default)]
pub(crate) struct TimelinePane {
    view: TimelineView,
    asked: RequestedChanges,
    entry: ValueEntry,
    boxes: TimelineBoxes,
    /// The running gesture of the mouse, and the playhead at its beginning.
    gesture: Option<gesture::TimelineGesture>,
    mark: i64,
    /// The tier that is being dragged by its name.
    tier_held: Option<i64>,
    curves: timeline_lanes::MeasuredCurves,
    overview: timeline_overview::TimelineOverview,
    layout: timeline_ui::TimelineLayout,
}

/// An annotation that was begun at a time and not ended.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct BegunAnnotation {
    pub(crate) recording: i64,
    pub(crate) tier: i64,
    pub(crate) start: i64,
    pub(crate) value: String,
}

/// An annotation at its future place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct GhostAnnotation {
    tier: i64,
    /// `None` for a new one.
    id: Option<i64>,
    start: i64,
    end: i64,
}

impl GhostAnnotation {
    fn ghost_from_item(tier: i64, item: &SpanItem) -> Self {
        Self {
            tier,
            id: Some(item.id),
            start: item.start,
            end: item.end,
        }
    }
}

/// Steps that follow a requested change.
#[derive(Debug, Clone, Default)]
struct ChangeFollowUp {
    /// Select the added annotations.
    select: bool,
    /// Open the value field of the added annotation.
    edit: bool,
    /// The annotations at their future places.
    ghosts: Vec<GhostAnnotation>,
    /// The proposals that it accepts.
    proposals: BTreeSet<i64>,
    /// The text typed for the change; restored if the change is refused.
    typed: Option<ValueEditing>,
}

impl ChangeFollowUp {
    fn follow_up_for_addition(tier: i64, start: i64, end: i64) -> Self {
        Self {
            select: true,
            ghosts: vec![GhostAnnotation {
                tier,
                id: None,
                start,
                end,
            }],
            ..Self::default()
        }
    }
}

/// Unfinished work, which is restored when the corpus is opened again.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct AnnotationDraft {
    pub(crate) editing: Option<ValueEditing>,
    pub(crate) begun: Option<BegunAnnotation>,
}

impl TimelinePane {
    /// Switches to a recording; returns whether it is shown for the first time.
    fn turn_timeline_to_recording(&mut self, recording: i64) -> bool {
        if self.view.of == Some(recording) {
            return false;
        }
        if self.view.of.is_none() {
            // The scroll offset for the tiers of another corpus is meaningless here.
            self.layout.scroll_to = Some(0.0);
        }
        self.gesture = None;
        self.view.turn_view_to_recording(recording)
    }

    /// Requests changes as one operation.
    fn request_annotation_changes(
        &mut self,
        changes: Vec<chereme_corpus::AnnotationChange>,
        then: ChangeFollowUp,
        out: &CommandOutbox,
    ) -> ActionOutcome {
        // The annotations are drawn at their future places until the snapshot shows them.
        self.asked.ghosts.extend_from_slice(&then.ghosts);
        let id = out.request_work(editing::annotate_corpus_job(changes));
        self.asked.pending.insert(id, then);
        ActionOutcome::Yes
    }

    /// Opens the value of annotations for typing.
    fn edit_annotation_values(&mut self, scene: &TimelineScene<'_>, annotations: BTreeSet<i64>) {
        let first_annotation = annotations
            .first()
            .and_then(|id| scene.seen.snapshot.find_open_annotation(*id));
        let text = first_annotation
            .map(|annotation| requests::typed_annotation_value(&annotation.tier.annotations, annotation.at));
        let recording = scene.contents.recording.id;
        let target = EditTarget::Of(annotations);
        self.open_field(ValueEditing::new(recording, target, text.unwrap_or_default()));
    }

    /// Opens the value of the annotation at that index of a tier.
    fn edit_at(&mut self, tier: &TierContents, at: usize) {
        let text = requests::typed_annotation_value(&tier.annotations, at);
        let target = EditTarget::Of(BTreeSet::from([tier.annotations.ids[at]]));
        self.open_field(ValueEditing::new(tier.row.recording_id, target, text));
    }

    /// Opens the value of an annotation that does not exist yet.
    fn edit_new(&mut self, tier: &TierContents, start: i64, end: i64) -> ActionOutcome {
        if timeline_edit::holds_proposals(tier) {
            return ActionOutcome::Cannot(words::HOLDS_PROPOSALS);
        }
        let recording = tier.row.recording_id;
        let tier = tier.row.id;
        let target = EditTarget::New { tier, start, end };
        self.open_field(ValueEditing::new(recording, target, String::new()));
        ActionOutcome::Yes
    }

    /// Opens the field for a value, with its tier in sight.
    fn open_field(&mut self, editing: ValueEditing) {
        self.entry.editing = Some(editing);
        self.show_tier();
    }

    /// Brings the selected tier into sight.
    pub(crate) fn show_tier(&mut self) {
        self.view.reveal = true;
    }

    /// Returns whether the work is a change of annotations that was requested here.
    pub(crate) fn awaits_change(&self, work: WorkId) -> bool {
        self.asked.pending.contains_key(&work)
    }

    /// Returns whether a new annotation is about to be selected, so that keys for it wait.
    pub(crate) fn awaits_selection(&self) -> bool {
        !self.asked.to_select.is_empty() && self.view.drawn
    }

    /// Returns whether a widget is an annotation or the name of a tier, in the rows.
    pub(crate) fn has_row_widget(&self, ctx: &Context, widget: Id) -> bool {
        let widget = ctx.read_response(widget).map(|response| response.interact_rect);
        let rows = self.layout.area.zip(widget);
        rows.is_some_and(|(rows, widget)| rows.contains_rect(widget))
    }

    /// Returns whether a value is being typed, so that letters are not shortcuts.
    pub(crate) fn is_typing(&self) -> bool {
        self.is_timeline_box_open() && self.view.drawn
    }

    /// Takes the text to paste.
    pub(crate) fn hold_clip(&mut self, text: String) {
        self.boxes.clip = Some(text);
    }

    /// Begins a frame, in which the pane may or may not be drawn.
    pub(crate) fn next_frame(&mut self) {
        self.view.drawn = false;
    }

    /// Returns the visible part of each recording that is not shown as a whole.
    pub(crate) fn timeline_windows(&self) -> BTreeMap<i64, TimeWindow> {
        self.view.recording_view_windows()
    }

    /// Sets the visible part of each recording from the settings.
    pub(crate) fn remember_timeline_windows(&mut self, windows: &BTreeMap<i64, TimeWindow>) {
        self.view.remember_view_windows(windows);
    }

    /// Returns whether a field or a list is open.
    fn is_timeline_box_open(&self) -> bool {
        self.entry.editing.is_some() || self.boxes.is_any_open()
    }

    /// Returns the unfinished work, including typed text that is not stored yet.
    pub(crate) fn timeline_draft(&self) -> Option<AnnotationDraft> {
        self.entry.entry_draft(self.asked.newest_typed_text())
    }

    /// Returns the recording with unfinished work.
    pub(crate) fn draft_recording_id(&self) -> Option<i64> {
        self.entry.entry_recording_id()
    }

    /// Restores unfinished work.
    pub(crate) fn restore_timeline_draft(&mut self, draft: AnnotationDraft) {
        self.entry.restore_entry_draft(draft);
    }
}

/// Returns whether the tier that edits apply to holds glosses.
pub(crate) fn is_on_gloss(seen: &PaneInput<'_>) -> bool {
    let tier = TimelineScene::scene_from_input(seen).and_then(|scene| scene.edited_tier());
    tier.is_some_and(|tier| tier.row.role == TierRole::Gloss)
}

/// Returns whether an action takes the time of the playhead while it moves.
pub(crate) fn is_timed(action: Action, player: &StagePlayer) -> bool {
    let marks = action == Action::BeginEndAnnotation || timeline_edit::DIGIT_ACTIONS.contains(&action);
    marks && player.plays_on()
}

impl PaneInterface for TimelinePane {
    fn release_pane_keyboard(&mut self) {
        self.entry.left = self.entry.editing.is_some();
    }

    fn ui(&mut self, ui: &mut eframe::egui::Ui, seen: &PaneInput<'_>) {
        self.view.drawn = true;
        timeline_ui::show_timeline_pane(self, ui, seen);
    }

    fn carry_out_pane_action(&mut self, action: Action, seen: &PaneInput<'_>) -> ActionOutcome {
        match action {
            Action::ZoomIn => self.view.zoom_timeline_view(0.6, seen),
            Action::ZoomOut => self.view.zoom_timeline_view(1.0 / 0.6, seen),
            Action::ZoomAll => self.view.window = None,
            Action::PageBack => self.view.page_timeline_view(-0.9, seen),
            Action::PageForward => self.view.page_timeline_view(0.9, seen),
            other => {
                if let Some(settings) = seen.settings.timeline.settings_after_action(other) {
                    timeline_view_settings::change_timeline_settings(seen, settings);
                    return ActionOutcome::Yes;
                }
                let Some(scene) = TimelineScene::scene_from_input(seen) else {
                    return ActionOutcome::No;
                };
                if other == Action::GoToTime {
                    self.boxes.go_box = Some(go_to_time::GoBox::default());
                    if !self.view.drawn {
                        seen.send_command(WindowCommand::Do(Action::ShowTimeline));
                    }
                    return ActionOutcome::Yes;
                }
                let acted = [
                    proposals::carry_out_proposal_action,
                    select::carry_out_selection_action,
                    timeline_edit::carry_out_edit_action,
                    timeline_tiers::carry_out_tier_action,
                    timeline_paste::carry_out_clipboard_action,
                    neighbours::carry_out_neighbour_action,
                ]
                .into_iter()
                .map(|act| act(self, other, &scene))
                .find(|acted| *acted != ActionOutcome::No);
                if self.is_timeline_box_open() && !self.view.drawn {
                    seen.send_command(WindowCommand::Do(Action::ShowTimeline));
                }
                return acted.unwrap_or(ActionOutcome::No);
            }
        }
        ActionOutcome::Yes
    }

    fn receive_work_result(&mut self, id: WorkId, ended: &WorkResult) {
        self.curves.receive_curve_piece(id, ended);
        if let Some((_, tier)) = self.boxes.tier_asked.take_if(|(asked, _)| *asked == id) {
            match ended {
                Ok(_) => self.boxes.tier_named = tier.added_tier_name(),
                Err(_) => self.boxes.tier_box = Some(tier),
            }
        }
        if self.asked.proposing.take_if(|asked| *asked == id).is_some() {
            self.asked.to_propose = ended.is_ok();
        }
        let Some(then) = self.asked.pending.remove(&id) else {
            return;
        };
        match ended {
            Ok(WorkOutcome::Annotated(report)) if then.select => {
                self.asked.to_select = report.annotations.iter().copied().collect();
                self.asked.to_edit = then.edit;
            }
            // Refused proposals stay marked while others are accepted.
            Ok(_) if then.proposals.is_empty() => self.asked.refused.clear(),
            Ok(_) => {}
            Err(_) => {
                self.asked.ghosts.clear();
                self.asked.refused.extend(then.proposals);
                if let Some(typed) = then.typed {
                    // Refused text is offered again, so that nobody has to type it twice.
                    self.entry.reopen_refused_value(typed);
                }
            }
        }
    }
}
