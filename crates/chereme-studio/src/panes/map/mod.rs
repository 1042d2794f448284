//! The map: every coded sign as a point in a plane, with similar signs near each other.

mod map_data;

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_corpus::SignMap;
use chereme_sign::SignComponent;
use eframe::egui::{
    Align2, Checkbox, FontId, Label, Pos2, Rect, Response, RichText, Role, Sense, Stroke, StrokeKind, Ui, UiBuilder,
    Vec2, WidgetInfo, pos2, vec2,
};

use super::PaneInterface;
use super::library::library_data::SignMovement;
use super::notated_pane::AnimatedNotations;
use crate::command::{CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::miniatures::{self, MiniatureCell, MiniatureMotion};
use crate::words::{fill_text_braces, inspector, map_words as words, translate_library_message};
use crate::work::{WorkId, WorkOutcome, WorkResult, searching};
use map_data::{MapView, OccupiedLabels};

/// The components that can place the signs, with their names.
const PLACING_COMPONENTS: [(SignComponent, crate::words::InterfaceText); 4] = [
    (SignComponent::Configuration, inspector::CONFIGURATION),
    (SignComponent::Placement, inspector::PLACEMENT),
    (SignComponent::Movement, inspector::MOVEMENT),
    (SignComponent::Orientation, inspector::ORIENTATION),
];

/// The side of a little figure, in points.
const MAP_FIGURE_SIZE_POINTS: f32 = 84.0;
/// The most little figures at once.
const MOST_FIGURES: usize = 40;
/// Signs with only a notation are animated if no more signs than this are in sight.
const MAX_ANIMATED_NOTATIONS: usize = 160;
/// The number of signs in sight from which their points are small and faint.
const DENSE_MAP_SIGN_COUNT: usize = 800;
/// The most glosses.
const MOST_NAMES: usize = 120;
/// The distance in points within which the pointer selects a sign.
const MAP_POINTER_REACH_POINTS: f32 = 14.0;

/// The pane.
pub(crate) struct MapPane {
    /// For each of [`PLACING_COMPONENTS`] whether it helps to place the signs.
    by: [bool; 4],
    asked: Option<WorkId>,
    map: Option<Arc<SignMap>>,
    wrong: Option<String>,
    /// The generation of the corpus and the components of the newest request.
    of: Option<(i64, [bool; 4])>,
    view: MapView,
    /// The view at the end of a flight.
    towards: Option<MapView>,
    chosen: Option<usize>,
    /// The outline of a selection by dragging, drawn so far.
    lasso: Vec<Pos2>,
    /// The movement of the citation forms, by token, and the address of the overview that it comes from.
    moving: (usize, BTreeMap<i64, SignMovement>),
    notated: AnimatedNotations,
    /// Computed maps by their components, each with its corpus generation.
    kept: BTreeMap<[bool; 4], (i64, Arc<SignMap>)>,
    /// The height of the lines below the plane in the frame before; narrow panes need several.
    foot_height: Option<f32>,
}

impl Default for MapPane {
    fn default() -> Self {
        Self {
            by: [true; 4],
            asked: None,
            map: None,
            wrong: None,
            of: None,
            view: MapView::default(),
            towards: None,
            chosen: None,
            lasso: Vec::new(),
            moving: (0, BTreeMap::new()),
            notated: AnimatedNotations::default(),
            kept: BTreeMap::new(),
            foot_height: None,
        }
    }
}

impl MapPane {
    /// Requests the map again if the corpus or the components changed.
    fn request_changed_map(&mut self, seen: &PaneInput<'_>) {
        let of = Some((seen.snapshot.overview.generation, self.by));
        if self.of == of || seen.is_running(self.asked) {
            return;
        }
        self.of = of;
        let generation = seen.snapshot.overview.generation;
        if let Some((_, map)) = self.kept.get(&self.by).filter(|entry| entry.0 == generation) {
            (self.map, self.wrong, self.chosen) = (Some(map.clone()), None, None);
            return;
        }
        let wanted = PLACING_COMPONENTS.iter().zip(self.by).filter(|(_, on)| *on);
        let components = wanted.map(|((component, _), _)| *component).collect();
        self.asked = Some(seen.request_work(searching::map_signs_job(components)));
    }

    fn show_map_tools(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        ui.horizontal_wrapped(|ui| {
            ui.label(seen.say_text(words::BY));
            for (at, (_, name)) in PLACING_COMPONENTS.iter().enumerate() {
                let others = self.by.iter().enumerate().any(|(index, on)| index != at && *on);
                let only = self.by[at] && !others;
                let tick = Checkbox::new(&mut self.by[at], seen.say_text(*name));
                ui.add_enabled(!only, tick);
            }
            if ui.button(seen.say_text(words::WHOLE)).clicked() {
                self.towards = Some(MapView::default());
            }
            if seen.is_running(self.asked) {
                ui.spinner();
            } else if let Some(map) = &self.map {
                let text = fill_text_braces(seen.say_text(words::COUNT), &[("n", &map.signs.len())]);
                // Whole, in the next line if there is no room in this one.
                let unbroken_label = |text: String| Label::new(RichText::new(text).weak()).extend();
                ui.add(unbroken_label(text));
                if map.left_out > 0 {
                    let text = fill_text_braces(seen.say_text(words::LEFT_OUT), &[("n", &map.left_out)]);
                    ui.add(unbroken_label(text));
                }
            }
        });
    }

    fn show_map_plane(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, map: &SignMap) {
        let usual = ui.spacing().interact_size.y * 1.6;
        let foot = self.foot_height.unwrap_or(usual) + ui.spacing().item_spacing.y;
        let size = vec2(ui.available_width(), (ui.available_height() - foot).max(120.0));
        let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
        let name = fill_text_braces(seen.say_text(words::COUNT), &[("n", &map.signs.len())]);
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &name));
        self.look_around(ui, &response, rect);
        self.fly(ui);
        ui.painter().rect_filled(rect, 4.0, ui.visuals().extreme_bg_color);
        let painter = ui.painter().with_clip_rect(rect);
        let overview = Arc::as_ptr(&seen.snapshot.overview) as usize;
        if self.moving.0 != overview {
            let signs = seen.snapshot.overview.signs.iter();
            let moving = signs.filter_map(|sign| Some((sign.citation?, SignMovement::movement_of_sign(sign))));
            self.moving = (overview, moving.collect());
        }
        let places: Vec<Pos2> = map
            .signs
            .iter()
            .map(|sign| self.view.window_point_of(rect, pos2(sign.x, sign.y)))
            .collect();
        let visible: Vec<usize> = (0..places.len()).filter(|&at| rect.contains(places[at])).collect();
        let under = response.hover_pos().and_then(|pointer| {
            let near = visible.iter().map(|&at| (places[at].distance(pointer), at));
            let reach = if visible.len() <= MOST_FIGURES {
                MAP_FIGURE_SIZE_POINTS / 2.0
            } else {
                MAP_POINTER_REACH_POINTS
            };
            near.filter(|(far, _)| *far < reach)
                .min_by(|a, b| a.0.total_cmp(&b.0))
                .map(|pair| pair.1)
        });
        let colours = seen.pane_colours();
        if let Some(at) = under.or(self.chosen) {
            for near in map_data::most_similar_signs(map, at) {
                painter.line_segment([places[at], places[near]], Stroke::new(1.0, colours.accent));
            }
        }
        let mut marked: Vec<usize> = [self.chosen, under].into_iter().flatten().collect();
        marked.dedup();
        let others = visible.iter().copied().filter(|at| !marked.contains(at));
        let order: Vec<usize> = marked.iter().copied().chain(others).collect();
        let shown = VisibleSigns {
            map,
            places: &places,
            order: &order,
            marked: &marked,
        };
        // Figures at the edge are cut off there.
        let mut inside = ui.new_child(UiBuilder::new().max_rect(rect));
        inside.set_clip_rect(painter.clip_rect());
        let figures = self.figures(&inside, seen, &shown);
        draw_map_glosses(&inside, &shown, &figures);
        if visible.is_empty() && !map.signs.is_empty() {
            let text = seen.say_text(words::NONE_IN_SIGHT);
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
                .filter(|&&at| map_data::is_inside_outline(&self.lasso, places[at]))
            {
                painter.circle_stroke(places[at], 7.0, stroke);
            }
        }
        if response.drag_stopped() && !self.lasso.is_empty() {
            let lasso = std::mem::take(&mut self.lasso);
            let inside = visible
                .iter()
                .filter(|&&at| map_data::is_inside_outline(&lasso, places[at]));
            if let Some(query) = map_data::glosses_query(inside.map(|&at| map.signs[at].gloss.as_str())) {
                seen.send_command(WindowCommand::Find(query));
            }
        }
        if response.clicked() {
            self.chosen = under;
            if let Some(at) = under {
                let sign = &map.signs[at];
                let places = map.signs.iter().map(|other| pos2(other.x, other.y));
                let few = MOST_FIGURES / 2;
                let to = self.view.view_near_place(rect, pos2(sign.x, sign.y), places, few);
                self.towards = Some(to);
                self.notated.choose_citation_sign(seen, map.signs[at].token);
            }
        }
    }

    /// Paints the signs as little figures if there is room and movement, else as points; returns the rectangles of the
    /// figures by the indices of their signs.
    fn figures(&mut self, ui: &Ui, seen: &PaneInput<'_>, shown: &VisibleSigns<'_>) -> BTreeMap<usize, Rect> {
        let mut rooms: BTreeMap<usize, Rect> = BTreeMap::new();
        let accent = seen.pane_colours().accent;
        let weak = ui.visuals().weak_text_color();
        // Where many signs lie close together, their density is visible.
        let (small, weak) = match shown.order.len() > DENSE_MAP_SIGN_COUNT {
            true => (1.6, weak.gamma_multiply(0.6)),
            false => (2.5, weak),
        };
        for &at in shown.order {
            let (sign, place) = (&shown.map.signs[at], shown.places[at]);
            let marked = shown.marked.contains(&at);
            let room = Rect::from_center_size(place, Vec2::splat(MAP_FIGURE_SIZE_POINTS));
            let free = rooms.len() < MOST_FIGURES && rooms.values().all(|other_room| !other_room.intersects(room));
            let moves = self.moving.1.get(&sign.token).copied().filter(|_| free);
            // Notated signs are animated one by one, so only if few are in sight.
            let few = shown.order.len() <= MAX_ANIMATED_NOTATIONS || marked;
            let motion = match moves {
                Some(SignMovement::Recorded(recording, span)) => Some(MiniatureMotion::Span(recording, span)),
                Some(SignMovement::Notated) if few => {
                    let made = self.notated.notated_clip(sign.token, &sign.gloss, seen.out);
                    made.map(MiniatureMotion::Made)
                }
                _ => None,
            };
            let Some(motion) = motion else {
                let (radius, colour) = if marked { (4.5, accent) } else { (small, weak) };
                ui.painter().circle_filled(place, radius, colour);
                continue;
            };
            rooms.insert(at, room);
            let cell = MiniatureCell::new(motion, room.size()).with_playing_clock(miniatures::figure_loop_clock(ui));
            seen.little.paint_figure(ui, seen.language, seen.out, &cell, room);
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
        if self.view.move_towards_view(to, passed) {
            self.towards = None;
        }
        ui.ctx().request_repaint();
    }

    /// Moves and zooms by drag, wheel and pinch; a drag with Shift selects the signs that it encloses.
    fn look_around(&mut self, ui: &Ui, response: &Response, rect: Rect) {
        let pointer = response.interact_pointer_pos();
        if response.drag_started() && ui.input(|input| input.modifiers.shift) {
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
            self.view.move_map_by(rect, response.drag_delta());
        }
        let Some(pointer) = response.hover_pos() else {
            return;
        };
        let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta.y, input.zoom_delta()));
        let factor = pinch * (scroll / 200.0).exp();
        if (factor - 1.0).abs() > 1e-3 {
            self.towards = None;
            self.view.zoom_map_at(rect, pointer, factor);
        }
    }

    /// Shows the opened notated sign on the stage once it is animated, even if another pane covers this one.
    pub(crate) fn show_animated_map_sign(&mut self, out: &CommandOutbox) {
        self.notated.show_opened_notation(out);
    }

    /// Shows the chosen sign and those most similar to it, as buttons.
    fn foot(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, map: &SignMap) {
        let Some(chosen) = self.chosen.filter(|&at| at < map.signs.len()) else {
            ui.weak(seen.say_text(words::HINT));
            return;
        };
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(&map.signs[chosen].gloss).strong());
            ui.label(seen.say_text(words::ALIKE));
            for at in map_data::most_similar_signs(map, chosen) {
                if ui.link(&map.signs[at].gloss).clicked() {
                    self.chosen = Some(at);
                    self.notated.choose_citation_sign(seen, map.signs[at].token);
                }
            }
        });
    }
}

/// The signs in sight.
struct VisibleSigns<'a> {
    map: &'a SignMap,
    /// The point of every sign of the map in the window.
    places: &'a [Pos2],
    /// The indices of the signs in sight, the marked ones first.
    order: &'a [usize],
    /// The chosen sign, and the one under the pointer.
    marked: &'a [usize],
}

/// Writes glosses below points and figures as far as there is room for them; they cover no figure.
fn draw_map_glosses(ui: &Ui, shown: &VisibleSigns<'_>, figures: &BTreeMap<usize, Rect>) {
    let font = FontId::proportional(11.0);
    let mut labels = OccupiedLabels::default();
    for room in figures.values() {
        labels.take_label_room(room.shrink(map_data::LABEL_SQUARE_SIDE));
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
            MAP_FIGURE_SIZE_POINTS / 2.0
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
        if labels.take_label_room(room) || marked {
            let painter = ui.painter();
            painter.rect_filled(room.expand2(vec2(2.0, 0.0)), 2.0, back);
            painter.galley(room.min, galley, text);
            written += 1;
        }
    }
}

impl PaneInterface for MapPane {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        self.notated
            .forget_animation_failures(seen.snapshot.overview.generation);
        self.request_changed_map(seen);
        self.show_map_tools(ui, seen);
        if let Some(wrong) = &self.wrong {
            ui.weak(translate_library_message(wrong, seen.language));
        }
        let Some(map) = self.map.clone() else {
            return;
        };
        self.show_map_plane(ui, seen, &map);
        let top = ui.cursor().top();
        let foot = ui.scope(|ui| self.foot(ui, seen, &map));
        let height = foot.response.rect.bottom() - top;
        if self
            .foot_height
            .is_none_or(|old_height| (old_height - height).abs() > 0.5)
        {
            self.foot_height = Some(height);
            ui.ctx().request_repaint();
        }
    }

    fn receive_work_result(&mut self, id: WorkId, ended: &WorkResult) {
        self.notated.receive_animation_result(id, ended);
        if self.asked.take_if(|asked| *asked == id).is_none() {
            return;
        }
        self.chosen = None;
        match ended {
            Ok(WorkOutcome::Mapped(map)) => {
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
