//! The effect of a mouse gesture while the button is held, and when it is released.

use std::collections::BTreeSet;

use chereme_corpus::snap::{Catch, Guides};
use chereme_corpus::{Contents, requests};
use chereme_motion::{Instant, Span};
use eframe::egui::{CursorIcon, Key, Modifiers, Pos2, Rect, Ui};

use super::dragged::{self, DraggedAnnotations};
use super::edit::Scene;
use super::gesture::{Dragging, Gesture};
use super::spans::{Grip, Item};
use super::ui::Drawing;
use super::{Ghost, Then, tier_list};
use crate::command::Command;
use crate::words::timeline as words;

/// The distance within which a time snaps, in points.
const REACH: f64 = 8.0;

/// The visible effect of a gesture.
#[derive(Debug, Default)]
pub(super) struct Sight {
    pub(super) ghosts: Vec<Ghost>,
    /// Whether the annotations cannot be there.
    pub(super) refused: bool,
    /// The span whose times are shown beside the pointer.
    pub(super) times: Option<(i64, i64)>,
    /// The time that snapped, and what it snapped to.
    pub(super) caught: Option<(i64, Catch)>,
    pub(super) band: Option<Rect>,
}

impl Drawing<'_, '_> {
    /// Continues a gesture, ends it when the button is released, and returns its visible effect.
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
            self.follow_with(self.timeline.mark);
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

    /// Scrolls through time while the pointer is dragged past the edge.
    fn pan_at_edges(&mut self, ui: &Ui, lane: Rect, pointer: Pos2) {
        let past = (pointer.x - lane.right()).max(0.0) - (lane.left() - pointer.x).max(0.0);
        if past != 0.0 && self.timeline.view.window.is_some() {
            let whole = self.seen.shown.player.whole;
            self.window = self.window.panned(past * 0.2, whole, lane.width());
            self.timeline.view.window = Some(self.window);
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
        // The playhead moves with the drag, so its old place is a mark instead: the moving one would hold the drag
        // back.
        let marks = [self.timeline.mark];
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
            marks: &marks,
            minima: &minima,
            frames: scene.frames(),
            reach,
        };
        guides.settle(time)
    }

    /// Shows the moment of a dragged boundary on the stage, as in ELAN, unless something plays.
    fn follow_with(&mut self, at: i64) {
        let player = &self.seen.shown.player;
        if !player.is_playing() && player.playhead().micros() != at {
            self.out.seek(Instant::from_micros(at));
        }
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
        self.follow_with(to);
        Sight {
            times: span.map(|_| (from.min(to), from.max(to))),
            caught: caught.map(|why| (to, why)),
            ..Sight::default()
        }
    }

    fn create_on(
        &mut self,
        contents: &Contents,
        tier: i64,
        from: i64,
        time: i64,
    ) -> ((i64, i64), Sight) {
        let none = BTreeSet::new();
        let (from, _) = self.settle(contents, &none, from);
        let (to, caught) = self.settle(contents, &none, time);
        let (from, to) = (self.within(from), self.within(to));
        self.follow_with(to);
        let wanted = (from.min(to), from.max(to));
        let found = contents.tiers.iter().find(|it| it.row.id == tier);
        let room = found.and_then(|tier| dragged::room(contents, tier, wanted));
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
            times: Some((start, end)),
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
        // The boundary that is nearest to a mark snaps; the others move along.
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
            let moved = |held: &DraggedAnnotations| -> Vec<Item> {
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
                tier_list::unfit(&scene, tier, &items).is_none()
                    && !requests::has_below(contents, &chosen)
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
        match (own, it.grip) {
            (Some(own), Grip::Start) => self.follow_with(own.start),
            (Some(own), Grip::End) => self.follow_with(own.end),
            _ => {}
        }
        let there = own.is_some_and(|own| own.start == at || own.end == at);
        Sight {
            times: own.map(|own| (own.start, own.end)),
            caught: why.filter(|_| there).map(|why| (at, why)),
            refused: it.to.is_some_and(|(_, fits)| !fits),
            ghosts,
            band: None,
        }
    }

    /// Returns the tier under the pointer, if whole annotations of one other tier are dragged.
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
                if let Some(tier) = scene.tier_of(tier) {
                    self.begin_value(tier, span);
                }
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
                let below = requests::has_below(scene.contents, &chosen);
                let tier = scene.tier_of(to);
                let unfit = tier.and_then(|tier| tier_list::unfit(scene, tier, &items));
                let why = unfit.filter(|_| !below).unwrap_or(words::HAS_BELOW);
                return self.hint(why);
            }
            let asked = requests::to_tier(scene.contents, &items, to, true);
            let ghosts = items.iter().map(|item| Ghost::of(to, item)).collect();
            let then = Then {
                select: items.len() == 1,
                ghosts,
                ..Then::default()
            };
            self.out.send(Command::Tier(Some(to)));
            self.timeline.change(asked, then, self.out);
            return;
        }
        let mut asked = Vec::new();
        let mut ghosts = Vec::new();
        for (held, changed) in it.held.iter().zip(&it.changed) {
            asked.extend(requests::respan(&held.asked(changed)));
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
}
