//! The mouse on the lanes: select time, move and resize, create, select several.
//!
//! | mouse | does |
//! |---|---|
//! | drag | selects time on the tier, as in ELAN |
//! | drag a selected annotation, or any with Alt | moves it, or its edge |
//! | Alt and drag on a free place | creates an annotation |
//! | Shift and drag | selects the annotations in the frame |
//! | Ctrl and click, or Alt and click | adds to the selection, or removes from it |
//! | Shift and click | selects up to the clicked annotation |
//! | double click | types the value, or creates an annotation on the selection |

use std::collections::BTreeSet;

use chereme_corpus::{Contents, TierContents};
use chereme_motion::{Instant, Span};
use eframe::egui::{CursorIcon, Modifiers, Pos2, Rect, Response, Ui};

use super::dragged::{self, DraggedAnnotations, TierTiming};
use super::edit::Scene;
use super::spans::{Grip, Item};
use super::ui::Drawing;
use super::{data, edit, select};
use crate::command::Command;
use crate::panes::Acted;
use crate::words::{Text, timeline as words};

/// The distance from an edge within which the edge is grabbed, in points.
const EDGE: f32 = 5.0;

/// The running gesture of the mouse.
#[derive(Debug)]
pub(super) enum Gesture {
    /// Selecting time, from this time.
    Select { from: i64 },
    /// Creating an annotation, from this time.
    Create {
        from: i64,
        tier: i64,
        span: (i64, i64),
    },
    /// Dragging annotations.
    Drag(Box<Dragging>),
    /// Selecting the annotations in a frame that began at this point and time.
    Band { from: Pos2, time: i64 },
    /// Nothing until the button is released.
    Off,
}

impl Gesture {
    /// Returns the annotations that are drawn at another place meanwhile.
    pub(super) fn moving(&self) -> Vec<i64> {
        match self {
            Self::Drag(it) => it.changed.iter().flatten().map(|item| item.id).collect(),
            _ => Vec::new(),
        }
    }
}

/// Annotations while they are dragged.
#[derive(Debug)]
pub(super) struct Dragging {
    pub(super) held: Vec<DraggedAnnotations>,
    pub(super) grip: Grip,
    /// The boundaries that snap: one, or both of a whole annotation.
    pub(super) edges: Vec<i64>,
    /// The time where the mouse was pressed.
    pub(super) from: i64,
    /// The tier of the annotation under the mouse.
    pub(super) tier: i64,
    /// The tier that they would move to, and whether they fit there.
    pub(super) to: Option<(i64, bool)>,
    /// The changed annotations, for each of `held`.
    pub(super) changed: Vec<Vec<Item>>,
    /// The annotation under the mouse.
    pub(super) id: i64,
    /// The dragged annotations and their descendants, which are no snapping targets.
    pub(super) except: BTreeSet<i64>,
}

/// Returns the part of an annotation, drawn from `left` to `right`, that is grabbed at `x`.
pub(super) fn grip_at(left: f32, right: f32, x: f32) -> Grip {
    let edge = EDGE.min((right - left) / 4.0);
    if x < left + edge {
        Grip::Start
    } else if x > right - edge {
        Grip::End
    } else {
        Grip::Whole
    }
}

impl Drawing<'_, '_> {
    /// Begins the mouse gestures of a lane, and handles its clicks.
    pub(super) fn lane_mouse(
        &mut self,
        ui: &Ui,
        response: &Response,
        contents: &Contents,
        at: usize,
        lane: Rect,
    ) {
        let modifiers = ui.input(|input| input.modifiers);
        if response.drag_started() {
            let origin = ui.input(|input| input.pointer.press_origin());
            if let Some(origin) = origin {
                self.begin(contents, at, lane, origin, modifiers);
            }
        }
        if response.hovered() && self.timeline.gesture.is_none() {
            self.hover(ui, contents, at, lane, modifiers);
        }
        let Some(pointer) = response.interact_pointer_pos() else {
            return;
        };
        if response.double_clicked() {
            self.double_click(contents, at, pointer, lane);
        } else if response.clicked() {
            self.click(contents, at, pointer, lane, modifiers);
        }
    }

    fn under(&self, contents: &Contents, at: usize, lane: Rect, x: f32) -> Option<(usize, Grip)> {
        let columns = &contents.tiers[at].annotations;
        let chosen = &self.seen.shown.annotations;
        let time = |x: f32| self.window.micros(x - lane.left()) as i64;
        // An edge of a selected annotation can be grabbed from just outside it.
        let near = [x, x - EDGE * 0.6, x + EDGE * 0.6]
            .into_iter()
            .find_map(|near| {
                let found = data::at(columns, time(near))?;
                (near == x || chosen.contains(&columns.ids[found])).then_some(found)
            })?;
        let left = lane.left() + self.window.x(columns.starts[near] as f64);
        let right = lane.left() + self.window.x(columns.ends[near] as f64);
        Some((near, grip_at(left, right, x)))
    }

    fn hover(&self, ui: &Ui, contents: &Contents, at: usize, lane: Rect, modifiers: Modifiers) {
        let Some(pointer) = ui.input(|input| input.pointer.hover_pos()) else {
            return;
        };
        let found = self.under(contents, at, lane, pointer.x);
        let ids = &contents.tiers[at].annotations.ids;
        let held = found.filter(|(found, _)| {
            modifiers.alt || self.seen.shown.annotations.contains(&ids[*found])
        });
        match held {
            Some((_, Grip::Whole)) => ui.set_cursor_icon(CursorIcon::Grab),
            Some(_) => ui.set_cursor_icon(CursorIcon::ResizeHorizontal),
            None if modifiers.alt => ui.set_cursor_icon(CursorIcon::Crosshair),
            None => {}
        }
    }

    fn begin(
        &mut self,
        contents: &Contents,
        at: usize,
        lane: Rect,
        origin: Pos2,
        modifiers: Modifiers,
    ) {
        let tier = &contents.tiers[at];
        let from = self.instant(origin.x - lane.left()).micros();
        self.timeline.mark = self.seen.shown.player.playhead().micros();
        let found = self.under(contents, at, lane, origin.x);
        let id = found.map(|(found, _)| tier.annotations.ids[found]);
        let is_chosen = id.is_some_and(|id| self.seen.shown.annotations.contains(&id));
        self.out.send(Command::Tier(Some(tier.row.id)));
        if modifiers.shift {
            self.timeline.gesture = Some(Gesture::Band {
                from: origin,
                time: from,
            });
            return;
        }
        let tier = tier.row.id;
        let changes = modifiers.alt || (found.is_some() && is_chosen);
        if changes && self.seen.snapshot.is_read_only() {
            self.hint(crate::words::shell::READ_ONLY_WHY);
            self.timeline.gesture = Some(Gesture::Off);
            return;
        }
        match (found, id) {
            (Some((found, grip)), Some(id)) if is_chosen || modifiers.alt => {
                self.take_hold(contents, at, found, (id, grip, from));
            }
            (None, _) if modifiers.alt => {
                self.out.send(Command::Annotations(BTreeSet::new()));
                let span = (from, from);
                self.timeline.gesture = Some(Gesture::Create { from, tier, span });
            }
            _ => {
                self.out.send(Command::Annotations(BTreeSet::new()));
                self.timeline.gesture = Some(Gesture::Select { from });
            }
        }
    }

    fn take_hold(
        &mut self,
        contents: &Contents,
        at: usize,
        found: usize,
        (id, grip, from): (i64, Grip, i64),
    ) {
        let columns = &contents.tiers[at].annotations;
        let mut chosen = self.seen.shown.annotations.clone();
        if !chosen.contains(&id) || grip != Grip::Whole {
            chosen = BTreeSet::from([id]);
            self.out.send(Command::Annotations(chosen.clone()));
        }
        let scene = Scene {
            contents,
            seen: self.seen,
        };
        let held = scene.held(&chosen);
        if held.iter().all(|held| held.kind == TierTiming::Listed) {
            self.hint(words::NO_TIMES);
            self.timeline.gesture = Some(Gesture::Off);
            return;
        }
        let (start, end) = (columns.starts[found], columns.ends[found]);
        let edges = match grip {
            Grip::Start => vec![start],
            Grip::End => vec![end],
            Grip::Whole => vec![start, end],
        };
        self.timeline.gesture = Some(Gesture::Drag(Box::new(Dragging {
            changed: vec![Vec::new(); held.len()],
            held,
            grip,
            edges,
            from,
            tier: contents.tiers[at].row.id,
            to: None,
            id,
            except: dragged::with_below(contents, chosen),
        })));
    }

    fn click(
        &mut self,
        contents: &Contents,
        at: usize,
        pointer: Pos2,
        lane: Rect,
        modifiers: Modifiers,
    ) {
        let tier = &contents.tiers[at];
        let here = self.instant(pointer.x - lane.left());
        let under = data::at(&tier.annotations, here.micros());
        let chosen = &self.seen.shown.annotations;
        match under {
            Some(under) if modifiers.command || modifiers.alt => {
                let mut chosen = chosen.clone();
                super::view_settings::toggle(&mut chosen, tier.annotations.ids[under]);
                self.out.send(Command::Tier(Some(tier.row.id)));
                self.out.send(Command::Annotations(chosen));
            }
            Some(under) if modifiers.shift => {
                let all = select::range(tier, chosen, under);
                self.out.send(Command::Tier(Some(tier.row.id)));
                self.out.send(Command::Annotations(all));
            }
            None if modifiers.shift => {
                let from = self.seen.shown.player.playhead();
                let span = self
                    .seen
                    .shown
                    .span
                    .map_or(Span::between(from, here), |span| nearest_side(span, here));
                self.out.send(Command::Annotations(BTreeSet::new()));
                self.out
                    .send(Command::Span(Some(span).filter(|it| !it.is_empty())));
            }
            Some(under) => {
                select::select(tier, under, self.out);
                self.out.seek(here);
            }
            None => {
                self.out.send(Command::Tier(Some(tier.row.id)));
                self.out.send(Command::Annotations(BTreeSet::new()));
                self.out.seek(here);
            }
        }
    }

    fn double_click(&mut self, contents: &Contents, at: usize, pointer: Pos2, lane: Rect) {
        let tier = &contents.tiers[at];
        let here = self.instant(pointer.x - lane.left());
        let scene = Scene {
            contents,
            seen: self.seen,
        };
        if self.seen.snapshot.is_read_only() {
            return self.hint(crate::words::shell::READ_ONLY_WHY);
        }
        if let Some(under) = data::at(&tier.annotations, here.micros()) {
            self.timeline
                .edit(&scene, BTreeSet::from([tier.annotations.ids[under]]));
            return;
        }
        let Some(span) = self.seen.shown.span.filter(|span| span.contains(here)) else {
            return self.hint(crate::words::shell::NEEDS_SELECTION);
        };
        let wanted = (span.start().micros(), span.end().micros());
        match dragged::room(contents, tier, wanted) {
            Some(room) => self.begin_value(tier, room),
            None => self.hint(edit::no_room(tier)),
        }
    }

    /// Opens the field for the value of a new annotation, or says why there can be none.
    pub(super) fn begin_value(&mut self, tier: &TierContents, span: (i64, i64)) {
        if let Acted::Cannot(text) = self.timeline.edit_new(tier, span) {
            self.hint(text);
        }
    }

    pub(super) fn hint(&mut self, text: Text) {
        self.out.send(Command::Cannot(text));
    }
}

/// Returns the span with its nearer side moved to a time.
fn nearest_side(span: Span, at: Instant) -> Span {
    let (start, end) = (span.start(), span.end());
    let to = |it: Instant| (it.micros() - at.micros()).abs();
    if to(start) < to(end) {
        Span::between(at, end)
    } else {
        Span::between(start, at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_can_be_grabbed_if_the_bar_has_room_for_a_middle() {
        for (right, x, want) in [
            (100.0, 2.0, Grip::Start),
            (100.0, 98.0, Grip::End),
            (100.0, 50.0, Grip::Whole),
            (8.0, 4.0, Grip::Whole),
            (8.0, 1.0, Grip::Start),
            (8.0, 7.5, Grip::End),
        ] {
            assert_eq!(grip_at(0.0, right, x), want, "{right} {x}");
        }
    }

    #[test]
    fn shift_click_moves_the_nearer_edge() {
        let micros = Instant::from_micros;
        let span = Span::between(micros(10), micros(20));
        assert_eq!(
            nearest_side(span, micros(5)),
            Span::between(micros(5), micros(20))
        );
        assert_eq!(
            nearest_side(span, micros(18)),
            Span::between(micros(10), micros(18))
        );
    }
}
