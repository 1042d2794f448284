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
pub(crate) mod data;
mod detector_list;
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
mod parts;
mod paste;
mod paste_box;
mod proposals;
mod rows;
mod select;
pub(crate) mod tier_box;
mod tier_list;
mod tiers;
mod ui;
mod value_list;
mod values;
mod view_settings;

use std::collections::{BTreeMap, BTreeSet};

use chereme_corpus::{TierContents, TierRole, requests};
use eframe::egui::{Context, Id};
use serde::{Deserialize, Serialize};

use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::panes::{Acted, Pane};
use crate::player::Player;
use crate::words::timeline as words;
use crate::work::{Ended, Outcome, WorkId, editing};
use chereme_sign::tier::spans::{self, Item};
use data::Window;
use edit::Scene;
use editor::{Editing, Target};
use parts::{Asked, Boxes, Entry, View};
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
    view: View,
    asked: Asked,
    entry: Entry,
    boxes: Boxes,
    /// The running gesture of the mouse, and the playhead at its beginning.
    gesture: Option<gesture::Gesture>,
    mark: i64,
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
    /// The proposals that it accepts.
    proposals: BTreeSet<i64>,
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
    /// Switches to a recording; returns whether it is shown for the first time.
    fn turn_to(&mut self, recording: i64) -> bool {
        if self.view.of == Some(recording) {
            return false;
        }
        if self.view.of.is_none() {
            // The scroll offset for the tiers of another corpus is meaningless here.
            self.layout.scroll_to = Some(0.0);
        }
        self.gesture = None;
        self.view.turn_to(recording)
    }

    /// Requests changes as one operation.
    fn change(
        &mut self,
        changes: Vec<chereme_corpus::AnnotationChange>,
        then: Then,
        out: &mut Outbox,
    ) -> Acted {
        self.asked.ghosts.extend_from_slice(&then.ghosts);
        let id = out.work(editing::annotate(changes));
        self.asked.pending.insert(id, then);
        Acted::Yes
    }

    /// Opens the value of annotations for typing.
    fn edit(&mut self, scene: &Scene<'_>, annotations: BTreeSet<i64>) {
        let found = annotations
            .first()
            .and_then(|id| scene.seen.snapshot.annotation(*id));
        let text = found.map(|it| requests::typed(&it.tier.annotations, it.at));
        let recording = scene.contents.recording.id;
        let target = Target::Of(annotations);
        self.open_field(Editing::new(recording, target, text.unwrap_or_default()));
    }

    /// Opens the value of the annotation at that index of a tier.
    fn edit_at(&mut self, tier: &TierContents, at: usize) {
        let text = requests::typed(&tier.annotations, at);
        let target = Target::Of(BTreeSet::from([tier.annotations.ids[at]]));
        self.open_field(Editing::new(tier.row.recording_id, target, text));
    }

    /// Opens the value of an annotation that does not exist yet.
    fn edit_new(&mut self, tier: &TierContents, (start, end): (i64, i64)) -> Acted {
        if edit::holds_proposals(tier) {
            return Acted::Cannot(words::HOLDS_PROPOSALS);
        }
        let recording = tier.row.recording_id;
        let tier = tier.row.id;
        let target = Target::New { tier, start, end };
        self.open_field(Editing::new(recording, target, String::new()));
        Acted::Yes
    }

    /// Opens the field for a value, with its tier in sight.
    fn open_field(&mut self, editing: Editing) {
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
        let widget = ctx.read_response(widget).map(|it| it.interact_rect);
        let rows = self.layout.area.zip(widget);
        rows.is_some_and(|(rows, widget)| rows.contains_rect(widget))
    }

    /// Returns whether a value is being typed, so that letters are not shortcuts.
    pub(crate) fn is_typing(&self) -> bool {
        self.is_open() && self.view.drawn
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
    pub(crate) fn windows(&self) -> BTreeMap<i64, Window> {
        self.view.windows()
    }

    /// Sets the visible part of each recording from the settings.
    pub(crate) fn remember(&mut self, windows: &BTreeMap<i64, Window>) {
        self.view.remember(windows);
    }

    /// Returns whether a field or a list is open.
    fn is_open(&self) -> bool {
        self.entry.editing.is_some() || self.boxes.is_any_open()
    }

    /// Returns the unfinished work, including typed text that is not stored yet.
    pub(crate) fn draft(&self) -> Option<Draft> {
        self.entry.draft(self.asked.typed())
    }

    /// Returns the recording with unfinished work.
    pub(crate) fn wants(&self) -> Option<i64> {
        self.entry.recording()
    }

    /// Restores unfinished work.
    pub(crate) fn restore(&mut self, draft: Draft) {
        self.entry.restore(draft);
    }
}

/// Returns whether the tier that edits apply to holds glosses.
pub(crate) fn is_on_gloss(seen: &PaneInput<'_>) -> bool {
    let tier = Scene::of(seen).and_then(|scene| scene.tier());
    tier.is_some_and(|tier| tier.row.role == TierRole::Gloss)
}

/// Returns whether an action takes the time of the playhead while it moves.
pub(crate) fn is_timed(action: Action, player: &Player) -> bool {
    let marks = action == Action::BeginEndAnnotation || edit::DIGITS.contains(&action);
    marks && player.plays_on()
}

impl Pane for Timeline {
    fn leave(&mut self) {
        self.entry.left = self.entry.editing.is_some();
    }

    fn ui(&mut self, ui: &mut eframe::egui::Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        self.view.drawn = true;
        ui::show(self, ui, seen, out);
    }

    fn act(&mut self, action: Action, seen: &PaneInput<'_>, out: &mut Outbox) -> Acted {
        match action {
            Action::ZoomIn => self.view.zoom(0.6, seen),
            Action::ZoomOut => self.view.zoom(1.0 / 0.6, seen),
            Action::ZoomAll => self.view.window = None,
            Action::PageBack => self.view.page(-0.9, seen),
            Action::PageForward => self.view.page(0.9, seen),
            other => {
                if let Some(settings) = seen.settings.timeline.after(other) {
                    view_settings::change(seen, out, settings);
                    return Acted::Yes;
                }
                let Some(scene) = Scene::of(seen) else {
                    return Acted::No;
                };
                if other == Action::GoToTime {
                    self.boxes.go_box = Some(go_to_time::GoBox::default());
                    if !self.view.drawn {
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
                if self.is_open() && !self.view.drawn {
                    out.send(Command::Do(Action::ShowTimeline));
                }
                return acted.unwrap_or(Acted::No);
            }
        }
        Acted::Yes
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        self.curves.hear(id, ended);
        if let Some((_, tier)) = self.boxes.tier_asked.take_if(|(asked, _)| *asked == id) {
            match ended {
                Ok(_) => self.boxes.tier_named = tier.added(),
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
            Ok(Outcome::Annotated(report)) if then.select => {
                self.asked.to_select = report.annotations.iter().copied().collect();
                self.asked.to_edit = then.edit;
            }
            Ok(_) if then.proposals.is_empty() => self.asked.refused.clear(),
            Ok(_) => {}
            Err(_) => {
                self.asked.ghosts.clear();
                self.asked.refused.extend(then.proposals);
                if let Some(typed) = then.typed {
                    self.entry.refuse(typed);
                }
            }
        }
    }
}
