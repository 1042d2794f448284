//! The parts of the timeline's state, by duty.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::Arc;

use chereme_motion::{RecordingInstant, TimeSpan};
use eframe::egui::{Align2, Id, Window, vec2};

use super::editor::ValueEditing;
use super::{
    AnnotationDraft, BegunAnnotation, ChangeFollowUp, GhostAnnotation, detector_list, go_to_time, paste_box, tier_box,
    tier_list, timeline_values,
};
use crate::context::PaneInput;
use crate::model::OpenedRecording;
use crate::model::time_window::TimeWindow;
use crate::pickers::ValuePicker;
use crate::work::WorkId;

/// Returns the window of a box in the middle of the timeline, which cannot be folded or resized.
pub(super) fn box_window(title: &str, id: &str) -> Window<'static> {
    Window::new(title.to_owned())
        .id(Id::unique(id))
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, vec2(0.0, 0.0))
}

/// The visible part of each recording.
#[derive(Default)]
pub(super) struct TimelineView {
    /// The visible part of the recording; the whole by default.
    pub(super) window: Option<TimeWindow>,
    /// The recording of the window, and the windows of other recordings.
    pub(super) of: Option<i64>,
    windows: BTreeMap<i64, Option<TimeWindow>>,
    /// The width of the annotation area in the last frame, in points.
    pub(super) width: f32,
    /// The playhead in the last frame, in microseconds.
    pub(super) playhead: i64,
    /// Whether to bring the selected tier into sight.
    pub(super) reveal: bool,
    /// A tier to bring into sight instead of it, and for how many more frames: rows and panes that change with it find
    /// their places in several.
    pub(super) other_tier: Option<(i64, u8)>,
    /// Whether the pane was in sight in this frame, or the last.
    pub(super) drawn: bool,
}

impl TimelineView {
    /// Returns the visible part of `whole` in `width` points.
    pub(super) fn visible_time_window(&self, whole: TimeSpan, width: f32) -> TimeWindow {
        self.window.unwrap_or_else(|| TimeWindow::window_of_whole(whole, width))
    }

    /// Switches to another recording; returns whether it is shown for the first time.
    pub(super) fn turn_view_to_recording(&mut self, recording: i64) -> bool {
        if let Some(before) = self.of.replace(recording) {
            self.windows.insert(before, self.window);
        }
        let saved_window = self.windows.remove(&recording);
        self.window = saved_window.flatten();
        saved_window.is_none()
    }

    /// Brings a tier and a moment into sight.
    pub(super) fn bring_into_sight(&mut self, tier: i64, moment: RecordingInstant, whole: TimeSpan) {
        /// As many frames as a changed layout needs to rest, and more.
        const MAX_LAYOUT_REST_FRAMES: u8 = 60;
        self.other_tier = Some((tier, MAX_LAYOUT_REST_FRAMES));
        let (moment, width) = (moment.instant_micros() as f64, self.width);
        let follows = |window: TimeWindow| window.window_following_time(moment, whole, width);
        self.window = self.window.map(follows);
    }

    pub(super) fn zoom_timeline_view(&mut self, factor: f64, seen: &PaneInput<'_>) {
        let player = &seen.shown.player;
        let window = self.visible_time_window(player.whole, self.width);
        let around = player.player_playhead().instant_micros() as f64;
        self.window = Some(window.zoomed_window(factor, around, player.whole, self.width));
    }

    /// Scrolls through time by a share of the visible span; the playhead stays.
    pub(super) fn page_timeline_view(&mut self, share: f32, seen: &PaneInput<'_>) {
        let whole_span = seen.shown.player.whole;
        let window = self.visible_time_window(whole_span, self.width);
        self.window = Some(window.panned_window(share * self.width, whole_span, self.width));
    }

    /// Returns the visible part of each recording that is not shown as a whole.
    pub(super) fn recording_view_windows(&self) -> BTreeMap<i64, TimeWindow> {
        let now = self.of.map(|of| (of, self.window));
        let all = self.windows.iter().map(|(of, window)| (*of, *window)).chain(now);
        all.filter_map(|(of, window)| Some((of, window?))).collect()
    }

    /// Sets the visible part of each recording from the settings.
    pub(super) fn remember_view_windows(&mut self, windows: &BTreeMap<i64, TimeWindow>) {
        let sane = windows.iter().filter(|(_, it)| it.start.is_finite() && it.scale >= 1.0);
        self.windows = sane.map(|(of, window)| (*of, Some(*window))).collect();
    }
}

/// Requested changes, and the steps that follow them.
#[derive(Default)]
pub(super) struct RequestedChanges {
    /// Requested changes that the snapshot does not show yet.
    pub(super) pending: BTreeMap<WorkId, ChangeFollowUp>,
    /// Annotations at their future places, until the snapshot has them.
    pub(super) ghosts: Vec<GhostAnnotation>,
    /// The address of the snapshot that the ghosts complement.
    over: usize,
    /// New annotations to select as soon as they exist.
    pub(super) to_select: BTreeSet<i64>,
    /// Whether to type the value of an annotation as soon as it is selected.
    pub(super) to_edit: bool,
    /// The work that makes proposals, and whether they are there and to be shown.
    pub(super) proposing: Option<WorkId>,
    pub(super) to_propose: bool,
    /// Proposals that were refused when they were accepted, until annotations change.
    pub(super) refused: BTreeSet<i64>,
    /// Whether the last proposal of the recording was just accepted, and its tier is gone: further Enters begin nothing.
    pub(super) all_reviewed: bool,
}

impl RequestedChanges {
    /// Returns the newest typed text that is not stored yet.
    pub(super) fn newest_typed_text(&self) -> Option<ValueEditing> {
        self.pending.values().rev().find_map(|entry| entry.typed.clone())
    }

    /// Forgets the ghosts once a newer snapshot is there.
    pub(super) fn settle_requested_changes(&mut self, open: Option<&Arc<OpenedRecording>>) {
        let now = open.map_or(0, |open| Arc::as_ptr(open) as usize);
        if self.over != now && self.pending.is_empty() {
            self.over = now;
            self.ghosts.clear();
        }
    }
}

/// The entry of values and of new annotations.
#[derive(Default)]
pub(super) struct ValueEntry {
    /// An annotation that was begun and not ended.
    pub(super) begun: Option<BegunAnnotation>,
    /// The value that is being typed.
    pub(super) editing: Option<ValueEditing>,
    /// Values that could not be stored while the next one was typed; each opens again when no field is open.
    pub(super) refused: VecDeque<ValueEditing>,
    /// Whether another pane was brought to the front while a value was typed.
    pub(super) left: bool,
    pub(super) picker: ValuePicker,
    pub(super) digits: timeline_values::DigitAssignments,
    /// Whether typed text was restored, whose tier must be shown.
    pub(super) restored: bool,
}

impl ValueEntry {
    /// Returns the unfinished work; `typed` is text that is not stored yet.
    pub(super) fn entry_draft(&self, typed: Option<ValueEditing>) -> Option<AnnotationDraft> {
        let draft = AnnotationDraft {
            editing: self.editing.clone().or_else(|| self.refused.front().cloned()).or(typed),
            begun: self.begun.clone(),
        };
        (draft != AnnotationDraft::default()).then_some(draft)
    }

    /// Opens the field again with a value that could not be stored; a field in which something was typed comes first.
    pub(super) fn reopen_refused_value(&mut self, typed: ValueEditing) {
        match &self.editing {
            Some(open) if open.text != open.before => self.refused.push_back(typed),
            _ => self.editing = Some(typed.reopened_editing()),
        }
    }

    /// Takes the value whose field is open, or is to be opened.
    pub(super) fn take_open_editing(&mut self) -> Option<ValueEditing> {
        let open = self.editing.take();
        open.or_else(|| self.refused.pop_front().map(ValueEditing::reopened_editing))
    }

    /// Returns the recording with unfinished work.
    pub(super) fn entry_recording_id(&self) -> Option<i64> {
        let typed = self.editing.as_ref().map(|editing| editing.recording);
        typed.or(self.begun.as_ref().map(|begun| begun.recording))
    }

    /// Restores unfinished work.
    pub(super) fn restore_entry_draft(&mut self, draft: AnnotationDraft) {
        self.editing = draft.editing.map(ValueEditing::reopened_editing);
        self.begun = draft.begun;
        self.restored = self.editing.is_some();
    }
}

/// The boxes that open over the timeline.
#[derive(Default)]
pub(super) struct TimelineBoxes {
    pub(super) choose: Option<tier_list::TierChooser>,
    pub(super) detectors: Option<detector_list::ChooseDetector>,
    pub(super) paste_box: Option<paste_box::PasteBox>,
    pub(super) go_box: Option<go_to_time::GoBox>,
    /// The text to paste.
    pub(super) clip: Option<String>,
    pub(super) tier_box: Option<tier_box::TierBox>,
    /// A requested tier, whose box opens again if it is refused.
    pub(super) tier_asked: Option<(WorkId, tier_box::TierBox)>,
    /// The name of a tier to select as soon as it exists.
    pub(super) tier_named: Option<String>,
}

impl TimelineBoxes {
    /// Returns whether a box is open.
    pub(super) fn is_any_open(&self) -> bool {
        self.choose.is_some()
            || self.detectors.is_some()
            || self.tier_box.is_some()
            || self.paste_box.is_some()
            || self.go_box.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::super::editor::EditTarget;
    use super::*;

    fn typed(id: i64, text: &str) -> ValueEditing {
        let mut editing = ValueEditing::new(1, EditTarget::Of(BTreeSet::from([id])), "before".to_owned());
        editing.text = text.to_owned();
        editing
    }

    #[test]
    fn values_that_could_not_be_stored_open_again_one_after_the_other() {
        let mut entry = ValueEntry {
            editing: Some(typed(2, "COQ")),
            ..ValueEntry::default()
        };
        let open = |entry: &ValueEntry| entry.editing.as_ref().map(|it| it.text.clone());
        entry.reopen_refused_value(typed(1, "LIONNE"));
        assert_eq!(open(&entry).as_deref(), Some("COQ"), "it is being typed");
        // The field is closed, and the next one opened, in which nothing was typed yet.
        entry.editing = Some(typed(3, "before"));
        entry.reopen_refused_value(typed(2, "COQ"));
        assert_eq!(open(&entry).as_deref(), Some("COQ"));
        let texts: Vec<String> = std::iter::from_fn(|| entry.take_open_editing())
            .map(|it| it.text)
            .collect();
        assert_eq!(texts, ["COQ", "LIONNE"]);
        entry.reopen_refused_value(typed(1, "LIONNE"));
        let draft = entry.entry_draft(None).and_then(|it| it.editing);
        assert_eq!(draft.map(|it| it.text).as_deref(), Some("LIONNE"));
    }
}
