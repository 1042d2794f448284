//! What the mouse does on the lanes: select time, move and resize, create, select several.
//!
//! | mouse | does |
//! |---|---|
//! | drag | selects time on the tier, as in ELAN |
//! | drag a selected annotation, or any with Alt | moves it, or its edge |
//! | Alt and drag where nothing is | makes an annotation |
//! | Shift and drag | selects what is in the frame |
//! | Ctrl and click, Shift and click | adds to the selection; selects up to there |
//! | double click | types the value, or makes an annotation on the selection |

use std::collections::BTreeSet;

use chereme_corpus::Contents;
use chereme_motion::{Instant, Span};
use eframe::egui::{CursorIcon, Key, Modifiers, Pos2, Rect, Response, Ui};

use super::edit::Scene;
use super::hold::{self, Held, Kind};
use super::snap::{Catch, Guides};
use super::spans::{Grip, Item};
use super::ui::Drawing;
use super::{Ghost, Then, changes, choose, data, edit, select};
use crate::command::Command;
use crate::words::{Text, timeline as words};

/// How far around an edge it is taken hold of, in points.
const EDGE: f32 = 5.0;
/// From how far a boundary catches, in points.
const REACH: f64 = 8.0;

/// What the mouse is doing.
#[derive(Debug)]
pub(super) enum Gesture {
    /// Selecting time from there on.
    Select { from: i64 },
    /// Making an annotation from there on.
    Create {
        from: i64,
        tier: i64,
        span: (i64, i64),
    },
    /// Dragging annotations.
    Drag(Box<Dragging>),
    /// Selecting what is in a frame that began there.
    Band { from: Pos2, time: i64 },
    /// Nothing any more, until the button is let go.
    Off,
}

impl Gesture {
    /// Returns the annotations that are drawn elsewhere meanwhile.
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
    held: Vec<Held>,
    grip: Grip,
    /// The boundaries that settle on others: one, or both of a whole one.
    edges: Vec<i64>,
    /// The time where the mouse was pressed.
    from: i64,
    /// The tier of the annotation under the mouse.
    tier: i64,
    /// The tier they are moved to, and whether they fit there.
    to: Option<(i64, bool)>,
    /// What changes, for each of `held`.
    changed: Vec<Vec<Item>>,
    /// The annotation under the mouse.
    id: i64,
    /// What is dragged and all below it: none of it catches.
    except: BTreeSet<i64>,
}

/// What of a gesture is to be seen.
#[derive(Debug, Default)]
pub(super) struct Sight {
    pub(super) ghosts: Vec<Ghost>,
    /// Whether they cannot be there.
    pub(super) refused: bool,
    /// The ghost whose times are told.
    pub(super) told: Option<(i64, i64)>,
    /// Where a time settled.
    pub(super) caught: Option<(i64, Catch)>,
    pub(super) band: Option<Rect>,
}

/// Returns by what an annotation drawn from `left` to `right` is held at `x`.
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
    /// Begins what the mouse begins on a lane, and does what a click there does.
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
        // An edge of a selected one can be taken hold of from just outside it.
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
        if held.iter().all(|held| held.kind == Kind::Listed) {
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
            except: hold::with_below(contents, chosen),
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
            Some(under) if modifiers.command => {
                let mut chosen = chosen.clone();
                super::ways::toggle(&mut chosen, tier.annotations.ids[under]);
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
        if let Some(under) = data::at(&tier.annotations, here.micros()) {
            self.timeline
                .edit(&scene, BTreeSet::from([tier.annotations.ids[under]]));
            return;
        }
        let Some(span) = self.seen.shown.span.filter(|span| span.contains(here)) else {
            return;
        };
        let wanted = (span.start().micros(), span.end().micros());
        match hold::room(contents, tier, wanted) {
            Some(room) => self.timeline.edit_new(&scene, tier.row.id, room),
            None => self.hint(edit::no_room(tier)),
        }
    }

    /// Carries a gesture on, ends it when the button is let go, and returns what of it is to be seen.
    pub(super) fn gesture(&mut self, ui: &Ui, contents: &Contents, area: Rect) -> Sight {
        let Some(mut gesture) = self.timeline.gesture.take() else {
            return Sight::default();
        };
        let (pointer, down) = ui.input(|input| {
            let pointer = &input.pointer;
            (pointer.latest_pos(), pointer.primary_down())
        });
        if ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            if let Gesture::Select { .. } = gesture {
                self.out.send(Command::Span(None));
            }
            gesture = Gesture::Off;
        }
        let Some(pointer) = pointer else {
            return Sight::default();
        };
        let lane = area.with_min_x(area.left() + self.names);
        self.pan_at_edges(ui, lane, pointer);
        let time = self.window.micros(pointer.x - lane.left()).round() as i64;
        let sight = match &mut gesture {
            Gesture::Off => Sight::default(),
            Gesture::Select { from } => self.select_on(contents, *from, time),
            Gesture::Create { from, tier, span } => {
                let (found, sight) = self.create_on(contents, *tier, *from, time);
                *span = found;
                sight
            }
            Gesture::Drag(dragging) => {
                ui.set_cursor_icon(match dragging.grip {
                    Grip::Whole => CursorIcon::Grabbing,
                    _ => CursorIcon::ResizeHorizontal,
                });
                self.drag_on(contents, dragging, time, pointer)
            }
            Gesture::Band { from, time: origin } => {
                self.band_on(contents, *from, *origin, pointer, time)
            }
        };
        if down {
            self.timeline.gesture = Some(gesture);
        } else {
            self.let_go(contents, gesture);
        }
        sight
    }

    /// Moves time under a pointer that is dragged past the edge.
    fn pan_at_edges(&mut self, ui: &Ui, lane: Rect, pointer: Pos2) {
        let past = (pointer.x - lane.right()).max(0.0) - (lane.left() - pointer.x).max(0.0);
        if past != 0.0 && self.timeline.window.is_some() {
            let whole = self.seen.shown.player.whole;
            self.window = self.window.panned(past * 0.2, whole, lane.width());
            self.timeline.window = Some(self.window);
            ui.ctx().request_repaint();
        }
    }

    fn settle(
        &self,
        contents: &Contents,
        except: &BTreeSet<i64>,
        time: i64,
    ) -> (i64, Option<Catch>) {
        let scene = Scene {
            contents,
            seen: self.seen,
        };
        let snaps = self.seen.settings.timeline.snaps;
        let reach = (REACH * self.window.scale) as i64;
        let minima = if snaps.minima {
            self.timeline
                .curves
                .minima(time - 4 * reach, time + 4 * reach)
        } else {
            Vec::new()
        };
        let guides = Guides {
            snaps,
            tiers: &contents.tiers,
            except,
            marks: &[scene.playhead()],
            minima: &minima,
            frames: scene.frames(),
            reach,
        };
        guides.settle(time)
    }

    fn within(&self, time: i64) -> i64 {
        let whole = self.seen.shown.player.whole;
        time.clamp(whole.start().micros(), whole.end().micros())
    }

    fn select_on(&mut self, contents: &Contents, from: i64, time: i64) -> Sight {
        let none = BTreeSet::new();
        let (from, _) = self.settle(contents, &none, from);
        let (to, caught) = self.settle(contents, &none, time);
        let (from, to) = (self.within(from), self.within(to));
        let micros = Instant::from_micros;
        let span = Some(Span::between(micros(from), micros(to))).filter(|it| !it.is_empty());
        self.out.send(Command::Span(span));
        Sight {
            told: span.map(|_| (from.min(to), from.max(to))),
            caught: caught.map(|why| (to, why)),
            ..Sight::default()
        }
    }

    fn create_on(
        &self,
        contents: &Contents,
        tier: i64,
        from: i64,
        time: i64,
    ) -> ((i64, i64), Sight) {
        let none = BTreeSet::new();
        let (from, _) = self.settle(contents, &none, from);
        let (to, caught) = self.settle(contents, &none, time);
        let (from, to) = (self.within(from), self.within(to));
        let wanted = (from.min(to), from.max(to));
        let found = contents.tiers.iter().find(|it| it.row.id == tier);
        let room = found.and_then(|tier| hold::room(contents, tier, wanted));
        let (start, end) = room.unwrap_or(wanted);
        let ghost = Ghost {
            tier,
            id: None,
            start,
            end,
        };
        let sight = Sight {
            ghosts: vec![ghost],
            refused: room.is_none(),
            told: Some((start, end)),
            caught: caught.map(|why| (to, why)),
            band: None,
        };
        (room.unwrap_or((from, from)), sight)
    }

    fn drag_on(
        &mut self,
        contents: &Contents,
        it: &mut Dragging,
        time: i64,
        pointer: Pos2,
    ) -> Sight {
        let wanted = time - it.from;
        // The boundary nearest to something settles, the others go along.
        let settled = it.edges.iter().map(|edge| {
            let (at, why) = self.settle(contents, &it.except, edge + wanted);
            (at - edge, at, why)
        });
        let best = settled.min_by_key(|(by, _, why)| (why.is_none(), *why, (by - wanted).abs()));
        let (by, at, why) = best.unwrap_or((wanted, time, None));
        let mode = self.seen.settings.timeline.mode;
        it.changed = it
            .held
            .iter()
            .map(|held| held.dragged(it.grip, by, mode))
            .collect();
        it.to = self.other_tier(contents, it, pointer);
        if let Some((to, _)) = it.to {
            let moved = |held: &Held| -> Vec<Item> {
                let chosen = held
                    .items
                    .iter()
                    .filter(|item| held.chosen.contains(&item.id));
                chosen
                    .map(|item| Item {
                        start: item.start + by,
                        end: item.end + by,
                        ..*item
                    })
                    .collect()
            };
            it.changed = it.held.iter().map(moved).collect();
            let scene = Scene {
                contents,
                seen: self.seen,
            };
            let items: Vec<Item> = it.changed.iter().flatten().copied().collect();
            let chosen = items.iter().map(|item| item.id).collect();
            let fits = scene.tier_of(to).is_some_and(|tier| {
                choose::unfit(&scene, tier, &items).is_none()
                    && !changes::has_below(contents, &chosen)
            });
            it.to = Some((to, fits));
        }
        let pairs = it.held.iter().zip(&it.changed);
        let ghosts: Vec<Ghost> = pairs
            .flat_map(|(held, changed)| {
                let tier = it.to.map_or(held.tier, |(to, _)| to);
                changed.iter().map(move |item| Ghost::of(tier, item))
            })
            .collect();
        let own = ghosts.iter().find(|ghost| ghost.id == Some(it.id));
        let there = own.is_some_and(|own| own.start == at || own.end == at);
        Sight {
            told: own.map(|own| (own.start, own.end)),
            caught: why.filter(|_| there).map(|why| (at, why)),
            refused: it.to.is_some_and(|(_, fits)| !fits),
            ghosts,
            band: None,
        }
    }

    /// Returns the other tier that the pointer is on, where whole annotations of one tier are dragged.
    fn other_tier(&self, contents: &Contents, it: &Dragging, pointer: Pos2) -> Option<(i64, bool)> {
        if it.grip != Grip::Whole || it.held.iter().any(|held| held.tier != it.tier) {
            return None;
        }
        let at = self.timeline.layout.tier_at(pointer.y)?;
        let tier = contents.tiers.get(at)?.row.id;
        (tier != it.tier).then_some((tier, true))
    }

    fn band_on(
        &mut self,
        contents: &Contents,
        from: Pos2,
        time: i64,
        pointer: Pos2,
        now: i64,
    ) -> Sight {
        let band = Rect::from_two_pos(from, pointer);
        let (start, end) = (time.min(now), time.max(now));
        let mut all = BTreeSet::new();
        for (at, y) in &self.timeline.layout.rows {
            if y.max < band.top() || y.min > band.bottom() {
                continue;
            }
            let Some(tier) = contents.tiers.get(*at) else {
                continue;
            };
            let columns = &tier.annotations;
            let first = columns.ends.partition_point(|it| *it <= start);
            let last = columns.starts.partition_point(|it| *it < end).max(first);
            all.extend(columns.ids[first..last].iter().copied());
        }
        self.out.send(Command::Annotations(all));
        Sight {
            band: Some(band),
            ..Sight::default()
        }
    }

    fn let_go(&mut self, contents: &Contents, gesture: Gesture) {
        let scene = Scene {
            contents,
            seen: self.seen,
        };
        match gesture {
            Gesture::Create { tier, span, .. } if span.1 > span.0 => {
                self.timeline.edit_new(&scene, tier, span);
            }
            Gesture::Drag(it) => self.drop_at(&scene, &it),
            _ => {}
        }
    }

    fn drop_at(&mut self, scene: &Scene<'_>, it: &Dragging) {
        if let Some((to, fits)) = it.to {
            let items: Vec<Item> = it.changed.iter().flatten().copied().collect();
            if !fits {
                let chosen = items.iter().map(|item| item.id).collect();
                let below = changes::has_below(scene.contents, &chosen);
                self.hint(if below {
                    words::HAS_BELOW
                } else {
                    words::NO_ROOM
                });
                return;
            }
            let asked = changes::to_tier(scene.contents, &items, to, true);
            let ghosts = items.iter().map(|item| Ghost::of(to, item)).collect();
            let then = Then {
                select: items.len() == 1,
                ghosts,
                typed: None,
            };
            self.out.send(Command::Tier(Some(to)));
            self.timeline.change(asked, then, self.out);
            return;
        }
        let mut asked = Vec::new();
        let mut ghosts = Vec::new();
        for (held, changed) in it.held.iter().zip(&it.changed) {
            asked.extend(changes::respan(&held.asked(changed)));
            ghosts.extend(changed.iter().map(|item| Ghost::of(held.tier, item)));
        }
        if asked.is_empty() {
            return;
        }
        let own = ghosts.iter().find(|ghost| ghost.id == Some(it.id));
        if let Some(own) = own {
            let micros = Instant::from_micros;
            let span = Span::between(micros(own.start), micros(own.end));
            self.out.send(Command::Span(Some(span)));
        }
        let then = Then {
            ghosts,
            ..Then::default()
        };
        self.timeline.change(asked, then, self.out);
    }

    fn hint(&mut self, text: Text) {
        self.out.send(Command::Hint(text));
    }
}

/// Returns a span with the side nearer to a time brought there.
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
    fn edges_are_held_where_there_is_room_for_a_middle() {
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
    fn shift_and_a_click_bring_the_nearer_side() {
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
