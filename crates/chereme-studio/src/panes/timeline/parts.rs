//! The parts of the timeline's state, by duty.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::Arc;

use chereme_motion::{Instant, Span};

use super::data::Window;
use super::editor::Editing;
use super::{
    Begun, Draft, Ghost, Then, detector_list, go_to_time, paste_box, tier_box, tier_list, values,
};
use crate::context::PaneInput;
use crate::model::Opened;
use crate::pickers::Picker;
use crate::work::WorkId;

/// The visible part of each recording.
#[derive(Default)]
pub(super) struct View {
    /// The visible part of the recording; the whole by default.
    pub(super) window: Option<Window>,
    /// The recording of the window, and the windows of other recordings.
    pub(super) of: Option<i64>,
    windows: BTreeMap<i64, Option<Window>>,
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

impl View {
    /// Returns the visible part of `whole` in `width` points.
    pub(super) fn window(&self, whole: Span, width: f32) -> Window {
        self.window.unwrap_or_else(|| Window::whole(whole, width))
    }

    /// Switches to another recording; returns whether it is shown for the first time.
    pub(super) fn turn_to(&mut self, recording: i64) -> bool {
        if let Some(before) = self.of.replace(recording) {
            self.windows.insert(before, self.window);
        }
        let known = self.windows.remove(&recording);
        self.window = known.flatten();
        known.is_none()
    }

    /// Brings a tier and a moment into sight.
    pub(super) fn bring_into_sight(&mut self, tier: i64, moment: Instant, whole: Span) {
        /// As many frames as a changed layout needs to rest, and more.
        const FRAMES: u8 = 60;
        self.other_tier = Some((tier, FRAMES));
        let (moment, width) = (moment.micros() as f64, self.width);
        let follows = |window: Window| window.following(moment, whole, width);
        self.window = self.window.map(follows);
    }

    pub(super) fn zoom(&mut self, factor: f64, seen: &PaneInput<'_>) {
        let player = &seen.shown.player;
        let window = self.window(player.whole, self.width);
        let around = player.playhead().micros() as f64;
        self.window = Some(window.zoomed(factor, around, player.whole, self.width));
    }

    /// Scrolls through time by a share of the visible span; the playhead stays.
    pub(super) fn page(&mut self, share: f32, seen: &PaneInput<'_>) {
        let whole = seen.shown.player.whole;
        let window = self.window(whole, self.width);
        self.window = Some(window.panned(share * self.width, whole, self.width));
    }

    /// Returns the visible part of each recording that is not shown as a whole.
    pub(super) fn windows(&self) -> BTreeMap<i64, Window> {
        let now = self.of.map(|of| (of, self.window));
        let all = self
            .windows
            .iter()
            .map(|(of, window)| (*of, *window))
            .chain(now);
        all.filter_map(|(of, window)| Some((of, window?))).collect()
    }

    /// Sets the visible part of each recording from the settings.
    pub(super) fn remember(&mut self, windows: &BTreeMap<i64, Window>) {
        let sane = windows
            .iter()
            .filter(|(_, it)| it.start.is_finite() && it.scale >= 1.0);
        self.windows = sane.map(|(of, window)| (*of, Some(*window))).collect();
    }
}

/// Requested changes, and the steps that follow them.
#[derive(Default)]
pub(super) struct Asked {
    /// Requested changes that the snapshot does not show yet.
    pub(super) pending: BTreeMap<WorkId, Then>,
    /// Annotations at their future places, until the snapshot has them.
    pub(super) ghosts: Vec<Ghost>,
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
}

impl Asked {
    /// Returns the newest typed text that is not stored yet.
    pub(super) fn typed(&self) -> Option<Editing> {
        self.pending.values().rev().find_map(|it| it.typed.clone())
    }

    /// Forgets the ghosts once a newer snapshot is there.
    pub(super) fn settle(&mut self, open: Option<&Arc<Opened>>) {
        let now = open.map_or(0, |open| Arc::as_ptr(open) as usize);
        if self.over != now && self.pending.is_empty() {
            self.over = now;
            self.ghosts.clear();
        }
    }
}

/// The entry of values and of new annotations.
#[derive(Default)]
pub(super) struct Entry {
    /// An annotation that was begun and not ended.
    pub(super) begun: Option<Begun>,
    /// The value that is being typed.
    pub(super) editing: Option<Editing>,
    /// Values that could not be stored while the next one was typed; each opens again when no field is open.
    pub(super) refused: VecDeque<Editing>,
    /// Whether another pane was brought to the front while a value was typed.
    pub(super) left: bool,
    pub(super) picker: Picker,
    pub(super) digits: values::Digits,
    /// Whether typed text was restored, whose tier must be shown.
    pub(super) restored: bool,
}

impl Entry {
    /// Returns the unfinished work; `typed` is text that is not stored yet.
    pub(super) fn draft(&self, typed: Option<Editing>) -> Option<Draft> {
        let draft = Draft {
            editing: self
                .editing
                .clone()
                .or_else(|| self.refused.front().cloned())
                .or(typed),
            begun: self.begun.clone(),
        };
        (draft != Draft::default()).then_some(draft)
    }

    /// Opens the field again with a value that could not be stored; a field in which something was typed comes first.
    pub(super) fn refuse(&mut self, typed: Editing) {
        match &self.editing {
            Some(open) if open.text != open.before => self.refused.push_back(typed),
            _ => self.editing = Some(typed.again()),
        }
    }

    /// Takes the value whose field is open, or is to be opened.
    pub(super) fn take(&mut self) -> Option<Editing> {
        let open = self.editing.take();
        open.or_else(|| self.refused.pop_front().map(Editing::again))
    }

    /// Returns the recording with unfinished work.
    pub(super) fn recording(&self) -> Option<i64> {
        let typed = self.editing.as_ref().map(|it| it.recording);
        typed.or(self.begun.as_ref().map(|it| it.recording))
    }

    /// Restores unfinished work.
    pub(super) fn restore(&mut self, draft: Draft) {
        self.editing = draft.editing.map(Editing::again);
        self.begun = draft.begun;
        self.restored = self.editing.is_some();
    }
}

/// The boxes that open over the timeline.
#[derive(Default)]
pub(super) struct Boxes {
    pub(super) choose: Option<tier_list::Choose>,
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

impl Boxes {
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
    use super::super::editor::Target;
    use super::*;

    fn typed(id: i64, text: &str) -> Editing {
        let mut editing = Editing::new(1, Target::Of(BTreeSet::from([id])), "before".to_owned());
        editing.text = text.to_owned();
        editing
    }

    #[test]
    fn values_that_could_not_be_stored_open_again_one_after_the_other() {
        let mut entry = Entry {
            editing: Some(typed(2, "COQ")),
            ..Entry::default()
        };
        let open = |entry: &Entry| entry.editing.as_ref().map(|it| it.text.clone());
        entry.refuse(typed(1, "LIONNE"));
        assert_eq!(open(&entry).as_deref(), Some("COQ"), "it is being typed");
        // The field is closed, and the next one opened, in which nothing was typed yet.
        entry.editing = Some(typed(3, "before"));
        entry.refuse(typed(2, "COQ"));
        assert_eq!(open(&entry).as_deref(), Some("COQ"));
        let texts: Vec<String> = std::iter::from_fn(|| entry.take())
            .map(|it| it.text)
            .collect();
        assert_eq!(texts, ["COQ", "LIONNE"]);
        entry.refuse(typed(1, "LIONNE"));
        let draft = entry.draft(None).and_then(|it| it.editing);
        assert_eq!(draft.map(|it| it.text).as_deref(), Some("LIONNE"));
    }
}
