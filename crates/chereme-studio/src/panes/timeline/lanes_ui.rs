//! The widgets of lanes: their names with the values at the playhead, and their curves.

use eframe::egui::{
    Align2, Color32, FontId, Mesh, Painter, Rect, Response, Role, ScrollArea, Sense, Shape, Stroke,
    TextStyle, TextWrapMode, Ui, WidgetInfo, WidgetText, pos2, vec2,
};

use super::edit::Scene;
use super::lane_shape::{self, FACE, FOLDED, Wanted};
use super::lanes::{Lane, Run, Source};
use super::ui::Drawing;
use super::{lanes, paint, view_settings};
use crate::context::PaneInput;
use crate::theme;
use crate::words::{fill, timeline as words};

/// Returns the name of a stored curve such as `brows.RB`, from the inventory of its feature.
fn face_name(seen: &PaneInput<'_>, name: &str) -> String {
    let Some((part, code)) = name.split_once('.') else {
        return name.to_owned();
    };
    let all = seen.snapshot.overview.inventories.iter();
    let mut of = all.filter(|it| it.inventory.feature.as_deref() == Some(part));
    let value = of.find_map(|it| it.inventory.find(code));
    value.map_or(name.to_owned(), |it| {
        it.name(seen.language.code()).to_owned()
    })
}

/// Returns the colours of the right hand and of the left, like those of the figure on the stage.
fn hands(seen: &PaneInput<'_>) -> [Color32; 2] {
    theme::hands(seen.dark)
}

impl Drawing<'_, '_> {
    pub(super) fn lanes(&mut self, ui: &mut Ui, scene: &Scene<'_>) {
        let seen = self.seen;
        let settings = &seen.settings.timeline;
        if settings.lanes.is_empty() && !settings.snaps.minima {
            return;
        }
        let source = scene.frames().map(|frames| Source {
            recording: scene.contents.recording.id,
            frames: self.seen.reel.frames(),
            rate: frames.rate,
            offset: frames.offset,
        });
        let whole = self.seen.shown.player.whole;
        let sight = lanes::seen(&self.window, self.timeline.view.width, whole);
        self.timeline
            .curves
            .want(source, sight, scene.playhead(), self.out);
        if settings.lanes.is_empty() {
            return;
        }
        if source.is_none() {
            // Without movement, they would be empty lines.
            ui.small(self.seen.say(words::NO_LANES));
            return;
        }
        let shown = |(lane, ..): &(Lane, _, _)| settings.lanes.contains(lane);
        let all: Vec<_> = Lane::ALL.into_iter().filter(shown).collect();
        let stored: Vec<String> = {
            let all = self.timeline.curves.stored();
            all.into_iter().map(str::to_owned).collect()
        };
        let folded = settings.folded_lanes.clone();
        let face = settings.lanes.contains(&Lane::Face) && !folded.contains(&Lane::Face);
        let is_open = |lane: Lane| lane != Lane::Face && !folded.contains(&lane);
        let open = all.iter().filter(|it| is_open(it.0)).count();
        let wanted = Wanted {
            open,
            folded: all.len() - open,
            face: if face { stored.len() } else { 0 },
        };
        let (height, most) = lane_shape::room(wanted, ui.available_height());
        ScrollArea::vertical()
            .id_salt("lanes")
            .max_height(most)
            .min_scrolled_height(most)
            .show(ui, |ui| {
                for (lane, _, name) in all {
                    let name = self.seen.say(name);
                    if is_open(lane) {
                        self.one_lane(ui, scene, (lane, height), name);
                    } else {
                        self.folded_lane(ui, scene, lane, name);
                    }
                    if lane == Lane::Face && face {
                        for name in &stored {
                            self.one_of_face(ui, scene, name);
                        }
                    }
                }
            });
    }

    /// Shows the fold mark before a lane's name, and folds or unfolds the lane.
    fn fold_of_lane(&mut self, ui: &Ui, lane: Lane, name: &str, rect: Rect) {
        let seen = self.seen;
        let settings = &seen.settings.timeline;
        let folded = settings.folded_lanes.contains(&lane);
        let text = if folded { words::UNFOLD } else { words::FOLD };
        let label = fill(self.seen.say(text), &[("name", &name)]);
        let id = ui.unique_id().with(("fold", lane));
        let response = ui.interact(rect, id, Sense::click());
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
        let mark = Rect::from_min_size(rect.min, vec2(14.0, FOLDED));
        paint::fold(ui, mark, folded, &response);
        if response.clicked() {
            let mut settings = settings.clone();
            view_settings::toggle(&mut settings.folded_lanes, lane);
            view_settings::change(self.seen, self.out, settings);
        }
        response.on_hover_text(label);
    }

    /// Shows a folded lane, or the head of the stored curves, in one low line.
    fn folded_lane(&mut self, ui: &mut Ui, scene: &Scene<'_>, lane: Lane, name: &str) {
        let size = vec2(ui.available_width(), FOLDED);
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let area = rect.with_min_x(rect.left() + self.names);
        let head = rect.with_max_x(area.left() - 4.0);
        self.fold_of_lane(ui, lane, name, head);
        cut(
            ui,
            head.with_min_x(head.left() + 16.0),
            name,
            ui.visuals().text_color(),
        );
        let says = match lane {
            Lane::Face if !self.timeline.curves.stored().is_empty() => String::new(),
            Lane::Face if self.timeline.curves.is_bare() => self.seen.say(words::MEASURING).into(),
            Lane::Face => self.seen.say(words::NO_FACE).to_owned(),
            _ => self.says(scene, lane),
        };
        let font: FontId = TextStyle::Small.resolve(ui.style());
        let painter = ui.painter_at(area);
        let mut x = area.left() + 6.0;
        for (hand, part) in says.split('\n').enumerate() {
            let colour = if lane.curves() == 2 {
                hands(self.seen)[hand.min(1)]
            } else {
                ui.visuals().weak_text_color()
            };
            let at = pos2(x, area.center().y);
            let painted = painter.text(at, Align2::LEFT_CENTER, part, font.clone(), colour);
            x = painted.right() + 10.0;
        }
        let rule = Stroke::new(1.0, self.seen.colours().rule);
        painter.hline(area.x_range(), area.bottom(), rule);
    }

    fn one_of_face(&mut self, ui: &mut Ui, scene: &Scene<'_>, name: &str) {
        let size = vec2(ui.available_width(), FACE);
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let area = rect.with_min_x(rect.left() + self.names);
        let id = ui.unique_id().with(("stored", name));
        let response = ui.interact(area, id, Sense::click_and_drag());
        let curves = &self.timeline.curves;
        let now = curves.stored_at(name, scene.playhead()).unwrap_or(0.0);
        let called = face_name(self.seen, name);
        let says = format!("{called} {:.0} %", now * 100.0);
        response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, &says));
        let (painter, colours) = (ui.painter_at(area), self.seen.colours());
        if let Some(span) = self.seen.shown.span {
            paint::selection(&painter, area, &self.window, span, self.seen);
        }
        let y = |value: f32| area.bottom() - 1.0 - value.clamp(0.0, 1.0) * (area.height() - 4.0);
        let mesh = match curves.stored_runs(name, &self.window, area.width()) {
            Some(runs) => hill(&runs, area, y, colours.good),
            None => {
                let width = area.width().ceil().max(1.0) as usize;
                let columns = curves.stored_columns(name, &self.window, width);
                steps(&columns, area, y, colours.good)
            }
        };
        painter.add(Shape::mesh(mesh));
        let rule = Stroke::new(1.0, colours.rule);
        painter.hline(area.x_range(), area.bottom(), rule);
        let x = area.left() + self.window.x(scene.playhead() as f64);
        painter.vline(x, area.y_range(), Stroke::new(1.5, colours.playhead));
        let colour = if now > 0.0 {
            ui.visuals().strong_text_color()
        } else {
            ui.visuals().text_color()
        };
        let place = Rect::from_x_y_ranges(rect.left() + 16.0..=area.left() - 4.0, rect.y_range());
        cut(ui, place, &called, colour);
        self.seek_in(&response, area);
        response.on_hover_text(says);
    }

    fn seek_in(&mut self, response: &Response, area: Rect) {
        if let Some(at) = response.interact_pointer_pos()
            && (response.dragged() || response.clicked())
        {
            self.out.seek(self.instant(at.x - area.left()));
        }
    }

    fn one_lane(
        &mut self,
        ui: &mut Ui,
        scene: &Scene<'_>,
        (lane, height): (Lane, f32),
        name: &str,
    ) {
        let size = vec2(ui.available_width(), height);
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let area = rect.with_min_x(rect.left() + self.names);
        let id = ui.unique_id().with(("movement", lane));
        let response = ui.interact(area, id, Sense::click_and_drag());
        let says = self.says(scene, lane);
        response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, format!("{name} {says}")));
        let head = rect.with_max_x(area.left() - 4.0);
        self.fold_of_lane(ui, lane, name, head);
        self.lane_name(ui, head, name, &says, lane);
        let painter = ui.painter_at(area);
        let rule = Stroke::new(1.0, self.seen.colours().rule);
        painter.hline(area.x_range(), area.bottom(), rule);
        if let Some(span) = self.seen.shown.span {
            paint::selection(&painter, area, &self.window, span, self.seen);
        }
        self.curves(ui, &painter, area.shrink2(vec2(0.0, 3.0)), lane);
        let x = area.left() + self.window.x(scene.playhead() as f64);
        let stroke = Stroke::new(1.5, self.seen.colours().playhead);
        painter.vline(x, area.y_range(), stroke);
        self.seek_in(&response, area);
        let over = ui.input(|input| input.pointer.hover_pos());
        if let Some(over) = over.filter(|_| response.hovered()) {
            let at = self.instant(over.x - area.left()).micros();
            let there = self.says_at(scene, lane, at).replace('\n', "  ");
            response.on_hover_text_at_pointer(format!("{name}  {there}"));
        }
    }

    /// Shows a lane's name, and its value at the playhead below it if there is room for two lines.
    fn lane_name(&self, ui: &Ui, rect: Rect, name: &str, says: &str, lane: Lane) {
        let line = ui.text_style_height(&TextStyle::Small);
        let left = rect.left() + 16.0;
        let two = rect.height() >= 2.0 * line - 2.0;
        let top = if two {
            rect.top()
        } else {
            rect.center().y - line / 2.0
        };
        let first = Rect::from_min_max(pos2(left, top), pos2(rect.right(), top + line));
        cut(ui, first, name, ui.visuals().text_color());
        if !two {
            return;
        }
        let font: FontId = TextStyle::Small.resolve(ui.style());
        let painter = ui.painter_at(rect);
        let mut x = left;
        for (hand, part) in says.split('\n').enumerate() {
            let colour = if lane.curves() == 2 {
                hands(self.seen)[hand.min(1)]
            } else {
                ui.visuals().weak_text_color()
            };
            let at = pos2(x, rect.bottom());
            let painted = painter.text(at, Align2::LEFT_BOTTOM, part, font.clone(), colour);
            x = painted.right() + 8.0;
        }
    }

    /// Returns the value of a lane at the playhead; the hands are on separate lines.
    fn says(&self, scene: &Scene<'_>, lane: Lane) -> String {
        self.says_at(scene, lane, scene.playhead())
    }

    fn says_at(&self, scene: &Scene<'_>, lane: Lane, at: i64) -> String {
        if scene.frames().is_none() {
            return self.seen.say(words::NO_MOVEMENT).to_owned();
        }
        let curves = &self.timeline.curves;
        let short = [words::RIGHT_SHORT, words::LEFT_SHORT];
        let hand = |hand: usize| {
            let value = curves.at((lane, hand), at)?;
            let text = match lane {
                Lane::Palm => self.seen.say(curves.palm(hand, at)?).to_owned(),
                Lane::Speed => format!("{value:.2} m/s"),
                Lane::Aperture => format!("{:.0} %", value * 100.0),
                Lane::Distance | Lane::Face => return Some(format!("{value:.2} m")),
            };
            Some(format!("{} {text}", self.seen.say(short[hand])))
        };
        let parts: Vec<String> = (0..lane.curves()).filter_map(hand).collect();
        if parts.is_empty() {
            return self.seen.say(words::MEASURING).to_owned();
        }
        parts.join("\n")
    }

    fn curves(&self, ui: &Ui, painter: &Painter, area: Rect, lane: Lane) {
        let curves = &self.timeline.curves;
        let largest = curves.largest(lane);
        let (low, high) = lane_shape::range(lane, largest);
        let y = |value: f32| area.bottom() - (value - low) / (high - low) * area.height();
        let rule = Stroke::new(1.0, self.seen.colours().rule);
        let marks = lane_shape::marks(lane, largest, self.seen.language);
        for (value, _) in &marks {
            painter.hline(area.x_range(), y(*value), rule);
        }
        if lane == Lane::Palm {
            painter.hline(area.x_range(), y(0.0), rule);
        }
        let colours = hands(self.seen);
        for hand in (0..lane.curves()).rev() {
            let colour = if lane.curves() == 2 {
                colours[hand]
            } else {
                ui.visuals().text_color()
            };
            let of = (lane, hand);
            match curves.runs(of, &self.window, area.width()) {
                Some(runs) => {
                    let place = |(x, value)| pos2(area.left() + x, y(value));
                    for run in &runs {
                        let points = lane_shape::smooth(run).into_iter().map(place).collect();
                        painter.add(Shape::line(points, Stroke::new(1.6, colour)));
                    }
                }
                None => {
                    let width = area.width().ceil().max(1.0) as usize;
                    let columns = curves.columns(of, &self.window, width);
                    painter.add(Shape::mesh(curve(&columns, area.left(), y, colour)));
                }
            }
        }
        self.scale(ui, painter, area, &marks, y);
        if lane == Lane::Speed && self.seen.settings.timeline.snaps.minima {
            let whole = self.seen.shown.player.whole;
            let (from, to) = lanes::seen(&self.window, area.width(), whole);
            for at in curves.minima(from, to) {
                let x = area.left() + self.window.x(at as f64);
                let tick = [pos2(x, area.bottom() - 5.0), pos2(x, area.bottom())];
                painter.line_segment(tick, Stroke::new(1.5, self.seen.colours().playhead));
            }
        }
    }

    /// Shows the scale's marks at the right end of a lane; the lower one only if there is room.
    fn scale(
        &self,
        ui: &Ui,
        painter: &Painter,
        area: Rect,
        marks: &[(f32, String); 2],
        y: impl Fn(f32) -> f32,
    ) {
        let font = FontId::proportional(9.5);
        let (ink, ground) = (ui.visuals().weak_text_color(), ui.visuals().panel_fill);
        let room = y(marks[0].0) - y(marks[1].0) >= 18.0;
        let shown = if room { &marks[..] } else { &marks[1..] };
        for (value, text) in shown {
            let galley = painter.layout_no_wrap(text.clone(), font.clone(), ink);
            let size = galley.size();
            let lowest = (area.bottom() + 2.0 - size.y).max(area.top() - 2.0);
            let top = (y(*value) - size.y / 2.0).clamp(area.top() - 2.0, lowest);
            let at = pos2(area.right() - size.x - 4.0, top);
            let back = Rect::from_min_size(at, size).expand2(vec2(2.0, -1.0));
            painter.rect_filled(back, 2.0, ground.gamma_multiply(0.8));
            painter.galley(at, galley, ink);
        }
    }
}

/// Paints a small text into `rect`, with an ellipsis if it is cut.
fn cut(ui: &Ui, rect: Rect, text: &str, colour: Color32) {
    let wrap = Some(TextWrapMode::Truncate);
    let galley = WidgetText::from(text).into_galley(ui, wrap, rect.width(), TextStyle::Small);
    let at = pos2(rect.left(), rect.center().y - galley.size().y / 2.0);
    ui.painter().galley(at, galley, colour);
}

/// Returns the area below a line through frames.
fn hill(runs: &[Run], area: Rect, y: impl Fn(f32) -> f32, colour: Color32) -> Mesh {
    let mut mesh = Mesh::default();
    for run in runs {
        for pair in lane_shape::smooth(run).windows(2) {
            if pair[0].1.max(pair[1].1) <= 0.0 {
                continue;
            }
            let at = mesh.vertices.len() as u32;
            for (x, value) in pair {
                let x = area.left() + x;
                mesh.colored_vertex(pos2(x, y(*value)), colour);
                mesh.colored_vertex(pos2(x, area.bottom() - 1.0), colour);
            }
            mesh.add_triangle(at, at + 1, at + 2);
            mesh.add_triangle(at + 1, at + 2, at + 3);
        }
    }
    mesh
}

/// Returns the same area for frames that are narrower than columns.
fn steps(
    columns: &[Option<(f32, f32)>],
    area: Rect,
    y: impl Fn(f32) -> f32,
    colour: Color32,
) -> Mesh {
    let mut mesh = Mesh::default();
    for (x, column) in columns.iter().enumerate() {
        if let Some((_, high)) = column.filter(|it| it.1 > 0.0) {
            let left = area.left() + x as f32;
            let ends = (pos2(left, y(high)), pos2(left + 1.0, area.bottom() - 1.0));
            mesh.add_colored_rect(Rect::from_min_max(ends.0, ends.1), colour);
        }
    }
    mesh
}

/// Returns a curve as a sequence of vertical bars, each long enough to touch the one before.
fn curve(
    columns: &[Option<(f32, f32)>],
    left: f32,
    y: impl Fn(f32) -> f32,
    colour: Color32,
) -> Mesh {
    let mut mesh = Mesh::default();
    let mut before: Option<(f32, f32)> = None;
    for (x, column) in columns.iter().enumerate() {
        if let Some((low, high)) = *column {
            let (low, high) = match before {
                Some(last) => (low.min(last.1), high.max(last.0)),
                None => (low, high),
            };
            let x = left + x as f32;
            let rect = Rect::from_min_max(pos2(x, y(high) - 0.8), pos2(x + 1.0, y(low) + 0.8));
            mesh.add_colored_rect(rect, colour);
        }
        before = *column;
    }
    mesh
}
