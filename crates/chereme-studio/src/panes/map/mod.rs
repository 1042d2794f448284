//! The map: every coded sign as a point in a plane, with similar signs near each other.

mod data;

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_corpus::SignMap;
use chereme_sign::Component;
use eframe::egui::{
    Align2, Checkbox, FontId, Label, Pos2, Rect, Response, RichText, Role, Sense, Stroke,
    StrokeKind, Ui, UiBuilder, Vec2, WidgetInfo, pos2, vec2,
};

use super::Pane;
use super::library::data::Moves;
use super::notated::Notated;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::miniatures::{self, Cell, Motion};
use crate::panes::inspector::Thing;
use crate::words::{fill, inspector, map as words, spoken};
use crate::work::{Ended, Outcome, WorkId, searching};
use data::{Labels, View};

/// The components that can place the signs, with their names.
const COMPONENTS: [(Component, crate::words::Text); 4] = [
    (Component::Configuration, inspector::CONFIGURATION),
    (Component::Placement, inspector::PLACEMENT),
    (Component::Movement, inspector::MOVEMENT),
    (Component::Orientation, inspector::ORIENTATION),
];

/// The side of a little figure, in points.
const FIGURE: f32 = 84.0;
/// The most little figures at once.
const MOST_FIGURES: usize = 40;
/// Signs with only a notation are animated if no more signs than this are in sight.
const FEW: usize = 160;
/// The number of signs in sight from which their points are small and faint.
const DENSE: usize = 800;
/// The most glosses.
const MOST_NAMES: usize = 120;
/// The distance in points within which the pointer selects a sign.
const REACH: f32 = 14.0;

/// The pane.
pub(crate) struct Map {
    /// For each of [`COMPONENTS`] whether it helps to place the signs.
    by: [bool; 4],
    asked: Option<WorkId>,
    map: Option<Arc<SignMap>>,
    wrong: Option<String>,
    /// The generation of the corpus and the components of the newest request.
    of: Option<(i64, [bool; 4])>,
    view: View,
    /// The view at the end of a flight.
    towards: Option<View>,
    chosen: Option<usize>,
    /// The outline of a selection by dragging, drawn so far.
    lasso: Vec<Pos2>,
    /// The movement of the citation forms, by token, and the address of the overview that it comes from.
    moving: (usize, BTreeMap<i64, Moves>),
    notated: Notated,
    /// Computed maps by their components, each with its corpus generation.
    kept: BTreeMap<[bool; 4], (i64, Arc<SignMap>)>,
    /// The height of the lines below the plane in the frame before; narrow panes need several.
    foot_height: Option<f32>,
}

impl Default for Map {
    fn default() -> Self {
        Self {
            by: [true; 4],
            asked: None,
            map: None,
            wrong: None,
            of: None,
            view: View::default(),
            towards: None,
            chosen: None,
            lasso: Vec::new(),
            moving: (0, BTreeMap::new()),
            notated: Notated::default(),
            kept: BTreeMap::new(),
            foot_height: None,
        }
    }
}

impl Map {
    /// Requests the map again if the corpus or the components changed.
    fn follow(&mut self, seen: &PaneInput<'_>, out: &mut Outbox) {
        let of = Some((seen.snapshot.overview.generation, self.by));
        if self.of == of || seen.is_running(self.asked) {
            return;
        }
        self.of = of;
        let generation = seen.snapshot.overview.generation;
        if let Some((_, map)) = self.kept.get(&self.by).filter(|it| it.0 == generation) {
            (self.map, self.wrong, self.chosen) = (Some(map.clone()), None, None);
            return;
        }
        let wanted = COMPONENTS.iter().zip(self.by).filter(|(_, on)| *on);
        let components = wanted.map(|((component, _), _)| *component).collect();
        self.asked = Some(out.work(searching::map(components)));
    }

    fn tools(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        ui.horizontal_wrapped(|ui| {
            ui.label(seen.say(words::BY));
            for (at, (_, name)) in COMPONENTS.iter().enumerate() {
                let others = self.by.iter().enumerate().any(|(it, on)| it != at && *on);
                let only = self.by[at] && !others;
                let tick = Checkbox::new(&mut self.by[at], seen.say(*name));
                ui.add_enabled(!only, tick);
            }
            if ui.button(seen.say(words::WHOLE)).clicked() {
                self.towards = Some(View::default());
            }
            if seen.is_running(self.asked) {
                ui.spinner();
            } else if let Some(map) = &self.map {
                let text = fill(seen.say(words::COUNT), &[("n", &map.signs.len())]);
                // Whole, in the next line if there is no room in this one.
                let whole = |text: String| Label::new(RichText::new(text).weak()).extend();
                ui.add(whole(text));
                if map.left_out > 0 {
                    let text = fill(seen.say(words::LEFT_OUT), &[("n", &map.left_out)]);
                    ui.add(whole(text));
                }
            }
        });
    }

    fn plane(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, map: &SignMap, out: &mut Outbox) {
        let usual = ui.spacing().interact_size.y * 1.6;
        let foot = self.foot_height.unwrap_or(usual) + ui.spacing().item_spacing.y;
        let size = vec2(
            ui.available_width(),
            (ui.available_height() - foot).max(120.0),
        );
        let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
        let name = fill(seen.say(words::COUNT), &[("n", &map.signs.len())]);
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &name));
        self.look_around(ui, &response, rect);
        self.fly(ui);
        ui.painter()
            .rect_filled(rect, 4.0, ui.visuals().extreme_bg_color);
        let painter = ui.painter().with_clip_rect(rect);
        let overview = Arc::as_ptr(&seen.snapshot.overview) as usize;
        if self.moving.0 != overview {
            let signs = seen.snapshot.overview.signs.iter();
            let moving = signs.filter_map(|it| Some((it.citation?, Moves::of(it))));
            self.moving = (overview, moving.collect());
        }
        let places: Vec<Pos2> = map
            .signs
            .iter()
            .map(|it| self.view.shown(rect, pos2(it.x, it.y)))
            .collect();
        let visible: Vec<usize> = (0..places.len())
            .filter(|&at| rect.contains(places[at]))
            .collect();
        let under = response.hover_pos().and_then(|pointer| {
            let near = visible.iter().map(|&at| (places[at].distance(pointer), at));
            let reach = if visible.len() <= MOST_FIGURES {
                FIGURE / 2.0
            } else {
                REACH
            };
            near.filter(|(far, _)| *far < reach)
                .min_by(|a, b| a.0.total_cmp(&b.0))
                .map(|it| it.1)
        });
        let colours = seen.colours();
        if let Some(at) = under.or(self.chosen) {
            for near in data::near(map, at) {
                painter.line_segment([places[at], places[near]], Stroke::new(1.0, colours.accent));
            }
        }
        let mut marked: Vec<usize> = [self.chosen, under].into_iter().flatten().collect();
        marked.dedup();
        let others = visible.iter().copied().filter(|at| !marked.contains(at));
        let order: Vec<usize> = marked.iter().copied().chain(others).collect();
        let shown = Shown {
            map,
            places: &places,
            order: &order,
            marked: &marked,
        };
        // Figures at the edge are cut off there.
        let mut inside = ui.new_child(UiBuilder::new().max_rect(rect));
        inside.set_clip_rect(painter.clip_rect());
        let figures = self.figures(&inside, seen, out, &shown);
        glosses(&inside, &shown, &figures);
        if visible.is_empty() && !map.signs.is_empty() {
            let text = seen.say(words::NONE_IN_SIGHT);
            let colour = ui.visuals().weak_text_color();
            let font = FontId::proportional(13.0);
            painter.text(rect.center(), Align2::CENTER_CENTER, text, font, colour);
        }
        if self.lasso.len() > 1 {
            let stroke = Stroke::new(1.5, colours.accent);
            painter.line(self.lasso.clone(), stroke);
            let ends = [self.lasso[self.lasso.len() - 1], self.lasso[0]];
            painter.line_segment(ends, Stroke::new(1.0, colours.rule));
            for &at in visible
                .iter()
                .filter(|&&at| data::is_inside(&self.lasso, places[at]))
            {
                painter.circle_stroke(places[at], 7.0, stroke);
            }
        }
        if response.drag_stopped() && !self.lasso.is_empty() {
            let lasso = std::mem::take(&mut self.lasso);
            let inside = visible
                .iter()
                .filter(|&&at| data::is_inside(&lasso, places[at]));
            if let Some(query) = data::query(inside.map(|&at| map.signs[at].gloss.as_str())) {
                out.send(Command::Find(query));
            }
        }
        if response.clicked() {
            self.chosen = under;
            if let Some(at) = under {
                let sign = &map.signs[at];
                let places = map.signs.iter().map(|it| pos2(it.x, it.y));
                let few = MOST_FIGURES / 2;
                let to = self.view.near(rect, pos2(sign.x, sign.y), places, few);
                self.towards = Some(to);
                self.open(seen, map.signs[at].token, out);
            }
        }
    }

    /// Paints the signs as little figures if there is room and movement, else as points; returns the rectangles of the
    /// figures by the indices of their signs.
    fn figures(
        &mut self,
        ui: &Ui,
        seen: &PaneInput<'_>,
        out: &mut Outbox,
        shown: &Shown<'_>,
    ) -> BTreeMap<usize, Rect> {
        let mut rooms: BTreeMap<usize, Rect> = BTreeMap::new();
        let accent = seen.colours().accent;
        let weak = ui.visuals().weak_text_color();
        // Where many signs lie close together, their density is visible.
        let (small, weak) = match shown.order.len() > DENSE {
            true => (1.6, weak.gamma_multiply(0.6)),
            false => (2.5, weak),
        };
        for &at in shown.order {
            let (sign, place) = (&shown.map.signs[at], shown.places[at]);
            let marked = shown.marked.contains(&at);
            let room = Rect::from_center_size(place, Vec2::splat(FIGURE));
            let free = rooms.len() < MOST_FIGURES && rooms.values().all(|it| !it.intersects(room));
            let moves = self.moving.1.get(&sign.token).copied().filter(|_| free);
            // Notated signs are animated one by one, so only if few are in sight.
            let few = shown.order.len() <= FEW || marked;
            let motion = match moves {
                Some(Moves::Recorded(recording, span)) => Some(Motion::Span(recording, span)),
                Some(Moves::Notated) if few => {
                    let made = self.notated.get(sign.token, &sign.gloss, out);
                    made.map(Motion::Made)
                }
                _ => None,
            };
            let Some(motion) = motion else {
                let (radius, colour) = if marked { (4.5, accent) } else { (small, weak) };
                ui.painter().circle_filled(place, radius, colour);
                continue;
            };
            rooms.insert(at, room);
            let cell = Cell::new(motion, room.size()).playing(miniatures::clock(ui));
            seen.little.paint(ui, seen, out, &cell, room);
            if marked {
                let stroke = Stroke::new(2.0, accent);
                let painter = ui.painter();
                painter.rect_stroke(room, 6.0, stroke, StrokeKind::Inside);
            }
        }
        rooms
    }

    /// Moves a step along the flight.
    fn fly(&mut self, ui: &Ui) {
        let Some(to) = self.towards else { return };
        let passed = ui.input(|input| input.stable_dt).min(0.1);
        if self.view.towards(to, passed) {
            self.towards = None;
        }
        ui.ctx().request_repaint();
    }

    /// Moves and zooms by drag, wheel and pinch; a drag with Shift selects the signs that it encloses.
    fn look_around(&mut self, ui: &Ui, response: &Response, rect: Rect) {
        let pointer = response.interact_pointer_pos();
        if response.drag_started() && ui.input(|it| it.modifiers.shift) {
            self.lasso = pointer.into_iter().collect();
        } else if response.dragged()
            && let (Some(at), Some(last)) = (pointer, self.lasso.last())
            && last.distance(at) > 2.0
        {
            self.lasso.push(at);
        }
        if response.dragged() {
            self.towards = None;
        }
        if response.dragged() && self.lasso.is_empty() {
            self.view.moved(rect, response.drag_delta());
        }
        let Some(pointer) = response.hover_pos() else {
            return;
        };
        let (scroll, pinch) = ui.input(|it| (it.smooth_scroll_delta.y, it.zoom_delta()));
        let factor = pinch * (scroll / 200.0).exp();
        if (factor - 1.0).abs() > 1e-3 {
            self.towards = None;
            self.view.zoomed(rect, pointer, factor);
        }
    }

    /// Shows a sign on the stage, animated if it has only a notation; or its coding in the inspector if it has no
    /// movement.
    fn open(&mut self, seen: &PaneInput<'_>, token: i64, out: &mut Outbox) {
        let signs = &seen.snapshot.overview.signs;
        let Some(sign) = signs.iter().find(|it| it.citation == Some(token)) else {
            return out.send(Command::Inspect(Thing::Token(token)));
        };
        self.notated
            .choose(Moves::of(sign), (token, &sign.gloss), out);
    }

    /// Shows the opened notated sign on the stage once it is animated, even if another pane covers this one.
    pub(crate) fn show_made(&mut self, out: &mut Outbox) {
        self.notated.show(out);
    }

    /// Shows the chosen sign and those most similar to it, as buttons.
    fn foot(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, map: &SignMap, out: &mut Outbox) {
        let Some(chosen) = self.chosen.filter(|&at| at < map.signs.len()) else {
            ui.weak(seen.say(words::HINT));
            return;
        };
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(&map.signs[chosen].gloss).strong());
            ui.label(seen.say(words::ALIKE));
            for at in data::near(map, chosen) {
                if ui.link(&map.signs[at].gloss).clicked() {
                    self.chosen = Some(at);
                    self.open(seen, map.signs[at].token, out);
                }
            }
        });
    }
}

/// The signs in sight.
struct Shown<'a> {
    map: &'a SignMap,
    /// The point of every sign of the map in the window.
    places: &'a [Pos2],
    /// The indices of the signs in sight, the marked ones first.
    order: &'a [usize],
    /// The chosen sign, and the one under the pointer.
    marked: &'a [usize],
}

/// Writes glosses below points and figures as far as there is room for them; they cover no figure.
fn glosses(ui: &Ui, shown: &Shown<'_>, figures: &BTreeMap<usize, Rect>) {
    let font = FontId::proportional(11.0);
    let mut labels = Labels::default();
    for room in figures.values() {
        labels.take(room.shrink(data::SQUARE));
    }
    // They stay readable on top of all points.
    let back = ui.visuals().extreme_bg_color.gamma_multiply(0.75);
    let mut written = 0;
    for &at in shown.order {
        let marked = shown.marked.contains(&at);
        if written >= MOST_NAMES && !marked {
            break;
        }
        let below = if figures.contains_key(&at) {
            FIGURE / 2.0
        } else {
            4.0
        };
        let text = if marked {
            ui.visuals().strong_text_color()
        } else {
            ui.visuals().text_color()
        };
        let gloss = shown.map.signs[at].gloss.clone();
        let galley = ui.painter().layout_no_wrap(gloss, font.clone(), text);
        let top = shown.places[at] + vec2(0.0, below);
        let room = Align2::CENTER_TOP.anchor_size(top, galley.size());
        if labels.take(room) || marked {
            let painter = ui.painter();
            painter.rect_filled(room.expand2(vec2(2.0, 0.0)), 2.0, back);
            painter.galley(room.min, galley, text);
            written += 1;
        }
    }
}

impl Pane for Map {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        self.notated.follow(seen.snapshot.overview.generation);
        self.follow(seen, out);
        self.tools(ui, seen);
        if let Some(wrong) = &self.wrong {
            ui.weak(spoken(wrong, seen.language));
        }
        let Some(map) = self.map.clone() else {
            return;
        };
        self.plane(ui, seen, &map, out);
        let top = ui.cursor().top();
        let foot = ui.scope(|ui| self.foot(ui, seen, &map, out));
        let height = foot.response.rect.bottom() - top;
        if self.foot_height.is_none_or(|it| (it - height).abs() > 0.5) {
            self.foot_height = Some(height);
            ui.ctx().request_repaint();
        }
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        self.notated.hear(id, ended);
        if self.asked.take_if(|asked| *asked == id).is_none() {
            return;
        }
        self.chosen = None;
        match ended {
            Ok(Outcome::Mapped(map)) => {
                self.wrong = None;
                self.map = Some(map.clone());
                if let Some((generation, by)) = self.of {
                    self.kept.insert(by, (generation, map.clone()));
                }
            }
            Err(error) => {
                self.map = None;
                self.wrong = Some(error.to_string());
            }
            Ok(_) => {}
        }
    }
}
