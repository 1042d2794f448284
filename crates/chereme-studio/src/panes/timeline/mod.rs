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
//! | `tier_list`, `tier_box`, `go_to_time`, `bar` | boxes that choose a tier, edit a tier, or go to a time; the tools |

mod above;
pub(crate) mod bar;
mod changes;
mod copied;
pub(crate) mod data;
mod drag;
mod dragged;
mod edit;
mod editor;
mod gesture;
mod go_to_time;
mod lane_shape;
pub(crate) mod lanes;
mod lanes_ui;
mod menu;
mod names;
mod neighbours;
mod overview;
mod paint;
mod paste;
mod paste_box;
mod proposals;
mod rows;
mod select;
mod snap;
pub(crate) mod tier_box;
mod tier_list;
mod tiers;
mod ui;
mod value_list;
mod values;
mod view_settings;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use chereme_corpus::{AnnotateOptions, TierContents};
use chereme_motion::Span;
use serde::{Deserialize, Serialize};

use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::model::Opened;
use crate::panes::{Acted, Pane};
use crate::pickers::Picker;
use crate::work::{Ended, Outcome, Work, WorkId};
use chereme_sign::tier::spans::{self, Item};
use data::Window;
use edit::Scene;
use editor::{Editing, Target};
pub(crate) use view_settings::TimelineSettings;

/// Returns a recording with one tier of annotations, each given as id, start and end.
#[cfg(test)]
pub(crate) fn contents_of(annotations: &[(i64, i64, i64)]) -> chereme_corpus::Contents {
    let with_parents = annotations
        .iter()
        .map(|(id, start, end)| (*id, *start, *end, None));
    let all: Vec<_> = with_parents.collect();
    dragged::tests::contents(&[(1, None, "", &all)])
}

/// The pane.
#[derive(Default)]
pub(crate) struct Timeline {
    /// The visible part of the recording; the whole by default.
    window: Option<Window>,
    /// The recording of the window, and the windows of other recordings.
    of: Option<i64>,
    windows: BTreeMap<i64, Option<Window>>,
    /// The width of the annotation area in the last frame, in points.
    width: f32,
    /// The playhead in the last frame, in microseconds.
    playhead: i64,
    /// Whether to bring the selected tier into sight.
    reveal: bool,
    /// Whether the pane was in sight in this frame, or the last.
    drawn: bool,
    /// The running gesture of the mouse, and the playhead at its beginning.
    gesture: Option<gesture::Gesture>,
    mark: i64,
    /// Requested changes that the snapshot does not show yet.
    pending: BTreeMap<WorkId, Then>,
    /// Annotations at their future places, until the snapshot has them.
    ghosts: Vec<Ghost>,
    /// The address of the snapshot that the ghosts complement.
    over: usize,
    /// New annotations to select as soon as they exist.
    to_select: BTreeSet<i64>,
    /// Whether to type the value of an annotation as soon as it is selected.
    to_edit: bool,
    /// An annotation that was begun and not ended.
    begun: Option<Begun>,
    /// The value that is being typed.
    editing: Option<Editing>,
    /// Whether another pane was brought to the front while a value was typed.
    left: bool,
    picker: Picker,
    digits: values::Digits,
    choose: Option<tier_list::Choose>,
    paste_box: Option<paste_box::PasteBox>,
    go_box: Option<go_to_time::GoBox>,
    /// The text to paste.
    clip: Option<String>,
    tier_box: Option<tier_box::TierBox>,
    /// A requested tier, whose box opens again if it is refused.
    tier_asked: Option<(WorkId, tier_box::TierBox)>,
    /// The name of a tier to select as soon as it exists.
    tier_named: Option<String>,
    /// Whether typed text was restored, whose tier must be shown.
    restored: bool,
    /// The tier that is being dragged by its name.
    tier_held: Option<i64>,
    curves: lanes::Curves,
    overview: overview::Overview,
    layout: ui::Layout,
}

/// An annotation that was begun at a time and not ended.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Begun {
    pub(crate) recording: i64,
    pub(crate) tier: i64,
    pub(crate) start: i64,
    pub(crate) value: String,
}

/// An annotation at its future place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Ghost {
    tier: i64,
    /// `None` for a new one.
    id: Option<i64>,
    start: i64,
    end: i64,
}

impl Ghost {
    fn of(tier: i64, item: &Item) -> Self {
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
struct Then {
    /// Select the added annotations.
    select: bool,
    /// Open the value field of the added annotation.
    edit: bool,
    /// The annotations at their future places.
    ghosts: Vec<Ghost>,
    /// The text typed for the change; restored if the change is refused.
    typed: Option<Editing>,
}

impl Then {
    fn added(tier: i64, (start, end): (i64, i64)) -> Self {
        Self {
            select: true,
            ghosts: vec![Ghost {
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
pub(crate) struct Draft {
    pub(crate) editing: Option<Editing>,
    pub(crate) begun: Option<Begun>,
}

impl Timeline {
    /// Returns the visible part of `whole` in `width` points.
    fn window(&self, whole: Span, width: f32) -> Window {
        self.window.unwrap_or_else(|| Window::whole(whole, width))
    }

    /// Switches to a recording; returns whether it is shown for the first time.
    fn turn_to(&mut self, recording: i64) -> bool {
        if self.of == Some(recording) {
            return false;
        }
        match self.of.replace(recording) {
            Some(before) => drop(self.windows.insert(before, self.window)),
            // The scroll offset for the tiers of another corpus is meaningless here.
            None => self.layout.scroll_to = Some(0.0),
        }
        self.gesture = None;
        let known = self.windows.remove(&recording);
        self.window = known.flatten();
        known.is_none()
    }

    fn zoom(&mut self, factor: f64, seen: &PaneInput<'_>) {
        let player = &seen.shown.player;
        let window = self.window(player.whole, self.width);
        let around = player.playhead().micros() as f64;
        self.window = Some(window.zoomed(factor, around, player.whole, self.width));
    }

    /// Scrolls through time by a share of the visible span; the playhead stays.
    fn page(&mut self, share: f32, seen: &PaneInput<'_>) {
        let whole = seen.shown.player.whole;
        let window = self.window(whole, self.width);
        self.window = Some(window.panned(share * self.width, whole, self.width));
    }

    /// Requests changes as one operation.
    fn change(
        &mut self,
        changes: Vec<chereme_corpus::AnnotationChange>,
        then: Then,
        out: &mut Outbox,
    ) -> Acted {
        self.ghosts.extend_from_slice(&then.ghosts);
        let id = out.work(Work::Annotate(changes, AnnotateOptions::default()));
        self.pending.insert(id, then);
        Acted::Yes
    }

    /// Opens the value of annotations for typing.
    fn edit(&mut self, scene: &Scene<'_>, annotations: BTreeSet<i64>) {
        let found = annotations
            .first()
            .and_then(|id| scene.seen.snapshot.annotation(*id));
        let text = found.map(|it| changes::typed(&it.tier.annotations, it.at));
        let recording = scene.contents.recording.id;
        let target = Target::Of(annotations);
        self.editing = Some(Editing::new(recording, target, text.unwrap_or_default()));
    }

    /// Opens the value of the annotation at that index of a tier.
    fn edit_at(&mut self, tier: &TierContents, at: usize) {
        let text = changes::typed(&tier.annotations, at);
        let target = Target::Of(BTreeSet::from([tier.annotations.ids[at]]));
        self.editing = Some(Editing::new(tier.row.recording_id, target, text));
    }

    /// Opens the value of an annotation that does not exist yet.
    fn edit_new(&mut self, scene: &Scene<'_>, tier: i64, (start, end): (i64, i64)) {
        let recording = scene.contents.recording.id;
        let target = Target::New { tier, start, end };
        self.editing = Some(Editing::new(recording, target, String::new()));
    }

    /// Brings the selected tier into sight.
    pub(crate) fn show_tier(&mut self) {
        self.reveal = true;
    }

    /// Returns whether a value is being typed, so that letters are not shortcuts.
    pub(crate) fn is_typing(&self) -> bool {
        self.is_open() && self.drawn
    }

    /// Returns whether a field or a list is open.
    fn is_open(&self) -> bool {
        self.editing.is_some()
            || self.choose.is_some()
            || self.tier_box.is_some()
            || self.paste_box.is_some()
            || self.go_box.is_some()
    }

    /// Takes the text to paste.
    pub(crate) fn hold_clip(&mut self, text: String) {
        self.clip = Some(text);
    }

    /// Returns the visible part of each recording that is not shown as a whole.
    pub(crate) fn windows(&self) -> BTreeMap<i64, Window> {
        let now = self.of.map(|of| (of, self.window));
        let all = self
            .windows
            .iter()
            .map(|(of, window)| (*of, *window))
            .chain(now);
        all.filter_map(|(of, window)| Some((of, window?))).collect()
    }

    /// Sets the visible part of each recording from the settings.
    pub(crate) fn remember(&mut self, windows: &BTreeMap<i64, Window>) {
        let sane = windows
            .iter()
            .filter(|(_, it)| it.start.is_finite() && it.scale >= 1.0);
        self.windows = sane.map(|(of, window)| (*of, Some(*window))).collect();
    }

    /// Begins a frame, in which the pane may or may not be drawn.
    pub(crate) fn next_frame(&mut self) {
        self.drawn = false;
    }

    /// Returns the unfinished work, including typed text that is not stored yet.
    pub(crate) fn draft(&self) -> Option<Draft> {
        let typed = self.pending.values().rev().find_map(|it| it.typed.clone());
        let draft = Draft {
            editing: self.editing.clone().or(typed),
            begun: self.begun.clone(),
        };
        (draft != Draft::default()).then_some(draft)
    }

    /// Returns the recording with unfinished work.
    pub(crate) fn wants(&self) -> Option<i64> {
        let typed = self.editing.as_ref().map(|it| it.recording);
        typed.or(self.begun.as_ref().map(|it| it.recording))
    }

    /// Restores unfinished work.
    pub(crate) fn restore(&mut self, draft: Draft) {
        self.editing = draft.editing.map(Editing::again);
        self.begun = draft.begun;
        self.restored = self.editing.is_some();
    }

    /// Forgets the ghosts once a newer snapshot is there.
    fn settle(&mut self, open: Option<&Arc<Opened>>) {
        let now = open.map_or(0, |open| Arc::as_ptr(open) as usize);
        if self.over != now && self.pending.is_empty() {
            self.over = now;
            self.ghosts.clear();
        }
    }
}

impl Pane for Timeline {
    fn leave(&mut self) {
        self.left = self.editing.is_some();
    }

    fn ui(&mut self, ui: &mut eframe::egui::Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        self.drawn = true;
        ui::show(self, ui, seen, out);
    }

    fn act(&mut self, action: Action, seen: &PaneInput<'_>, out: &mut Outbox) -> Acted {
        match action {
            Action::ZoomIn => self.zoom(0.6, seen),
            Action::ZoomOut => self.zoom(1.0 / 0.6, seen),
            Action::ZoomAll => self.window = None,
            Action::PageBack => self.page(-0.9, seen),
            Action::PageForward => self.page(0.9, seen),
            other => {
                if let Some(ways) = seen.settings.timeline.after(other) {
                    view_settings::change(seen, out, ways);
                    return Acted::Yes;
                }
                let Some(scene) = Scene::of(seen) else {
                    return Acted::No;
                };
                if other == Action::GoToTime {
                    self.go_box = Some(go_to_time::GoBox::default());
                    if !self.drawn {
                        out.send(Command::Do(Action::ShowTimeline));
                    }
                    return Acted::Yes;
                }
                let acted = [
                    proposals::act,
                    select::act,
                    edit::act,
                    tiers::act,
                    paste::act,
                    neighbours::act,
                ]
                .into_iter()
                .map(|act| act(self, other, &scene, out))
                .find(|acted| *acted != Acted::No);
                if self.is_open() && !self.drawn {
                    out.send(Command::Do(Action::ShowTimeline));
                }
                return acted.unwrap_or(Acted::No);
            }
        }
        Acted::Yes
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        self.curves.hear(id, ended);
        if let Some((_, tier)) = self.tier_asked.take_if(|(asked, _)| *asked == id) {
            match ended {
                Ok(_) => self.tier_named = tier.added(),
                Err(_) => self.tier_box = Some(tier),
            }
        }
        let Some(then) = self.pending.remove(&id) else {
            return;
        };
        match ended {
            Ok(Outcome::Annotated(report)) if then.select => {
                self.to_select = report.annotations.iter().copied().collect();
                self.to_edit = then.edit;
            }
            Ok(_) => {}
            Err(_) => {
                self.ghosts.clear();
                if let (Some(typed), None) = (then.typed, &self.editing) {
                    self.editing = Some(typed.again());
                }
            }
        }
    }
}
