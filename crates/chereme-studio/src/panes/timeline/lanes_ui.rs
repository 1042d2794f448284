//! The widgets of lanes: their names with the values at the playhead, and their curves.

use eframe::egui::{
    Align2, Color32, FontId, Mesh, Painter, Rect, Response, Role, ScrollArea, Sense, Shape, Stroke, TextStyle,
    TextWrapMode, Ui, WidgetInfo, WidgetText, pos2, vec2,
};

use super::lane_shape::{self, CURVE_LANE_HEIGHT_POINTS, FOLDED_LANE_HEIGHT_POINTS, WantedLanes};
use super::timeline_edit::TimelineScene;
use super::timeline_lanes::{FrameRun, MovementFrames};
use super::timeline_ui::TimelineDrawing;
use super::{timeline_lanes, timeline_paint, timeline_view_settings};
use crate::context::PaneInput;
use crate::settings::timeline_settings::CurveLane;
use crate::theme;
use crate::words::{fill_text_braces, timeline as words};

/// Returns the name of a stored curve such as `brows.RB`, from the inventory of its feature.
fn face_name(seen: &PaneInput<'_>, name: &str) -> String {
    let Some((part, code)) = name.split_once('.') else {
        return name.to_owned();
    };
    let all = seen.snapshot.overview.inventories.iter();
    let mut of = all.filter(|stored| stored.inventory.feature.as_deref() == Some(part));
    let value = of.find_map(|stored| stored.inventory.find_inventory_value(code));
    value.map_or(name.to_owned(), |value| {
        value.value_name_in(seen.language.language_code()).to_owned()
    })
}

/// Returns the colours of the right hand and of the left, like those of the figure on the stage.
fn lane_hand_colours(seen: &PaneInput<'_>) -> [Color32; 2] {
    theme::hand_theme_colours(seen.dark)
}

impl TimelineDrawing<'_, '_> {
    pub(super) fn show_curve_lanes(&mut self, ui: &mut Ui, scene: &TimelineScene<'_>) {
        let seen = self.seen;
        let settings = &seen.settings.timeline;
        // The minima are needed for snapping even if no lane shows them.
        if settings.lanes.is_empty() && !settings.snaps.minima {
            return;
        }
        let source = scene.recording_frame_times().map(|frames| MovementFrames {
            recording: scene.contents.recording.id,
            frames: self.seen.reel.reel_frame_count(),
            rate: frames.rate,
            offset: frames.offset,
        });
        let whole_span = self.seen.shown.player.whole;
        let sight = timeline_lanes::visible_window_span(&self.window, self.timeline.view.width, whole_span);
        self.timeline
            .curves
            .request_curve_pieces(source, sight, scene.scene_playhead_micros(), self.seen.out);
        if settings.lanes.is_empty() {
            return;
        }
        if source.is_none() {
            // Without movement, they would be empty lines.
            ui.small(self.seen.say_text(words::NO_LANES));
            return;
        }
        let shown = |(lane, ..): &(CurveLane, _, _)| settings.lanes.contains(lane);
        let all: Vec<_> = timeline_lanes::CURVE_LANES.into_iter().filter(shown).collect();
        let stored: Vec<String> = {
            let all = self.timeline.curves.nonzero_stored_curves();
            all.into_iter().map(str::to_owned).collect()
        };
        let folded = settings.folded_lanes.clone();
        let face = settings.lanes.contains(&CurveLane::Face) && !folded.contains(&CurveLane::Face);
        let is_open = |lane: CurveLane| lane != CurveLane::Face && !folded.contains(&lane);
        let open = all.iter().filter(|entry| is_open(entry.0)).count();
        let wanted = WantedLanes {
            open,
            folded: all.len() - open,
            face: if face { stored.len() } else { 0 },
        };
        let (height, most) = lane_shape::lane_room_heights(wanted, ui.available_height());
        ScrollArea::vertical()
            .id_salt("lanes")
            .max_height(most)
            .min_scrolled_height(most)
            .show(ui, |ui| {
                for (lane, _, name) in all {
                    let name = self.seen.say_text(name);
                    if is_open(lane) {
                        self.one_lane(ui, scene, lane, height, name);
                    } else {
                        self.folded_lane(ui, scene, lane, name);
                    }
                    if lane == CurveLane::Face && face {
                        for name in &stored {
                            self.one_of_face(ui, scene, name);
                        }
                    }
                }
            });
    }

    /// Shows the fold mark before a lane's name, and folds or unfolds the lane.
    fn fold_of_lane(&mut self, ui: &Ui, lane: CurveLane, name: &str, rect: Rect) {
        let seen = self.seen;
        let settings = &seen.settings.timeline;
        let folded = settings.folded_lanes.contains(&lane);
        let text = if folded { words::UNFOLD } else { words::FOLD };
        let label = fill_text_braces(self.seen.say_text(text), &[("name", &name)]);
        let id = ui.unique_id().with(("fold", lane));
        let response = ui.interact(rect, id, Sense::click());
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
        let mark = Rect::from_min_size(rect.min, vec2(14.0, FOLDED_LANE_HEIGHT_POINTS));
        timeline_paint::paint_fold_mark(ui, mark, folded, &response);
        if response.clicked() {
            let mut settings = settings.clone();
            timeline_view_settings::toggle_in_set(&mut settings.folded_lanes, lane);
            timeline_view_settings::change_timeline_settings(self.seen, settings);
        }
        response.on_hover_text(label);
    }

    /// Shows a folded lane, or the head of the stored curves, in one low line.
    fn folded_lane(&mut self, ui: &mut Ui, scene: &TimelineScene<'_>, lane: CurveLane, name: &str) {
        let size = vec2(ui.available_width(), FOLDED_LANE_HEIGHT_POINTS);
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let area = rect.with_min_x(rect.left() + self.names);
        let head = rect.with_max_x(area.left() - 4.0);
        self.fold_of_lane(ui, lane, name, head);
        paint_elided_text(ui, head.with_min_x(head.left() + 16.0), name, ui.visuals().text_color());
        let says = match lane {
            CurveLane::Face if !self.timeline.curves.nonzero_stored_curves().is_empty() => String::new(),
            CurveLane::Face if self.timeline.curves.is_bare() => self.seen.say_text(words::MEASURING).into(),
            CurveLane::Face => self.seen.say_text(words::NO_FACE).to_owned(),
            _ => self.describe_lane_value(scene, lane),
        };
        let font: FontId = TextStyle::Small.resolve(ui.style());
        let painter = ui.painter_at(area);
        let mut x = area.left() + 6.0;
        for (hand, part) in says.split('\n').enumerate() {
            let colour = if lane.lane_curve_count() == 2 {
                lane_hand_colours(self.seen)[hand.min(1)]
            } else {
                ui.visuals().weak_text_color()
            };
            let text_position = pos2(x, area.center().y);
            let painted = painter.text(text_position, Align2::LEFT_CENTER, part, font.clone(), colour);
            x = painted.right() + 10.0;
        }
        let rule = Stroke::new(1.0, self.seen.pane_colours().rule);
        painter.hline(area.x_range(), area.bottom(), rule);
    }

    fn one_of_face(&mut self, ui: &mut Ui, scene: &TimelineScene<'_>, name: &str) {
        let size = vec2(ui.available_width(), CURVE_LANE_HEIGHT_POINTS);
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let area = rect.with_min_x(rect.left() + self.names);
        let id = ui.unique_id().with(("stored", name));
        let response = ui.interact(area, id, Sense::click_and_drag());
        let curves = &self.timeline.curves;
        let now = curves.stored_at(name, scene.scene_playhead_micros()).unwrap_or(0.0);
        let called = face_name(self.seen, name);
        let says = format!("{called} {:.0} %", now * 100.0);
        response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, &says));
        let (painter, colours) = (ui.painter_at(area), self.seen.pane_colours());
        if let Some(span) = self.seen.shown.span {
            timeline_paint::paint_time_selection(&painter, area, &self.window, span, self.seen);
        }
        let y = |value: f32| area.bottom() - 1.0 - value.clamp(0.0, 1.0) * (area.height() - 4.0);
        // Near by each change is drawn, from afar the range of each pixel.
        let mesh = match curves.stored_runs(name, &self.window, area.width()) {
            Some(runs) => hill(&runs, area, y, colours.good),
            None => {
                let width = area.width().ceil().max(1.0) as usize;
                let columns = curves.stored_columns(name, &self.window, width);
                build_steps_mesh(&columns, area, y, colours.good)
            }
        };
        painter.add(Shape::mesh(mesh));
        let rule = Stroke::new(1.0, colours.rule);
        painter.hline(area.x_range(), area.bottom(), rule);
        let x = area.left() + self.window.time_to_points(scene.scene_playhead_micros() as f64);
        painter.vline(x, area.y_range(), Stroke::new(1.5, colours.playhead));
        let colour = if now > 0.0 {
            ui.visuals().strong_text_color()
        } else {
            ui.visuals().text_color()
        };
        let place = Rect::from_x_y_ranges(rect.left() + 16.0..=area.left() - 4.0, rect.y_range());
        paint_elided_text(ui, place, &called, colour);
        self.seek_in(&response, area);
        response.on_hover_text(says);
    }

    fn seek_in(&mut self, response: &Response, area: Rect) {
        if let Some(at) = response.interact_pointer_pos()
            && (response.dragged() || response.clicked())
        {
            self.seen.send_seek(self.instant_at_x(at.x - area.left()));
        }
    }

    fn one_lane(&mut self, ui: &mut Ui, scene: &TimelineScene<'_>, lane: CurveLane, height: f32, name: &str) {
        let size = vec2(ui.available_width(), height);
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let area = rect.with_min_x(rect.left() + self.names);
        let id = ui.unique_id().with(("movement", lane));
        let response = ui.interact(area, id, Sense::click_and_drag());
        let says = self.describe_lane_value(scene, lane);
        response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, format!("{name} {says}")));
        let head = rect.with_max_x(area.left() - 4.0);
        self.fold_of_lane(ui, lane, name, head);
        self.lane_name(ui, head, name, &says, lane);
        let painter = ui.painter_at(area);
        let rule = Stroke::new(1.0, self.seen.pane_colours().rule);
        painter.hline(area.x_range(), area.bottom(), rule);
        if let Some(span) = self.seen.shown.span {
            timeline_paint::paint_time_selection(&painter, area, &self.window, span, self.seen);
        }
        self.paint_lane_curves(ui, &painter, area.shrink2(vec2(0.0, 3.0)), lane);
        let x = area.left() + self.window.time_to_points(scene.scene_playhead_micros() as f64);
        let stroke = Stroke::new(1.5, self.seen.pane_colours().playhead);
        painter.vline(x, area.y_range(), stroke);
        self.seek_in(&response, area);
        let over = ui.input(|input| input.pointer.hover_pos());
        if let Some(over) = over.filter(|_| response.hovered()) {
            let pointed_time = self.instant_at_x(over.x - area.left()).instant_micros();
            let there = self.says_at(scene, lane, pointed_time).replace('\n', "  ");
            response.on_hover_text_at_pointer(format!("{name}  {there}"));
        }
    }

    /// Shows a lane's name, and its value at the playhead below it if there is room for two lines.
    fn lane_name(&self, ui: &Ui, rect: Rect, name: &str, says: &str, lane: CurveLane) {
        let line = ui.text_style_height(&TextStyle::Small);
        let left = rect.left() + 16.0;
        let two = rect.height() >= 2.0 * line - 2.0;
        let top = if two { rect.top() } else { rect.center().y - line / 2.0 };
        let first = Rect::from_min_max(pos2(left, top), pos2(rect.right(), top + line));
        paint_elided_text(ui, first, name, ui.visuals().text_color());
        if !two {
            return;
        }
        let font: FontId = TextStyle::Small.resolve(ui.style());
        let painter = ui.painter_at(rect);
        let mut x = left;
        for (hand, part) in says.split('\n').enumerate() {
            let colour = if lane.lane_curve_count() == 2 {
                lane_hand_colours(self.seen)[hand.min(1)]
            } else {
                ui.visuals().weak_text_color()
            };
            let text_position = pos2(x, rect.bottom());
            let painted = painter.text(text_position, Align2::LEFT_BOTTOM, part, font.clone(), colour);
            x = painted.right() + 8.0;
        }
    }

    /// Returns the value of a lane at the playhead; the hands are on separate lines.
    fn describe_lane_value(&self, scene: &TimelineScene<'_>, lane: CurveLane) -> String {
        self.says_at(scene, lane, scene.scene_playhead_micros())
    }

    fn says_at(&self, scene: &TimelineScene<'_>, lane: CurveLane, at: i64) -> String {
        if scene.recording_frame_times().is_none() {
            return self.seen.say_text(words::NO_MOVEMENT).to_owned();
        }
        let curves = &self.timeline.curves;
        let short = [words::RIGHT_SHORT, words::LEFT_SHORT];
        let hand = |hand: usize| {
            let value = curves.curve_value_at(lane, hand, at)?;
            let text = match lane {
                CurveLane::Palm => self.seen.say_text(curves.palm_direction_at(hand, at)?).to_owned(),
                CurveLane::Speed => format!("{value:.2} m/s"),
                CurveLane::Aperture => format!("{:.0} %", value * 100.0),
                CurveLane::Distance | CurveLane::Face => return Some(format!("{value:.2} m")),
            };
            Some(format!("{} {text}", self.seen.say_text(short[hand])))
        };
        let parts: Vec<String> = (0..lane.lane_curve_count()).filter_map(hand).collect();
        if parts.is_empty() {
            return self.seen.say_text(words::MEASURING).to_owned();
        }
        parts.join("\n")
    }

    fn paint_lane_curves(&self, ui: &Ui, painter: &Painter, area: Rect, lane: CurveLane) {
        let curves = &self.timeline.curves;
        let largest = curves.largest_lane_value(lane);
        let (low, high) = lane_shape::lane_value_range(lane, largest);
        let y = |value: f32| area.bottom() - (value - low) / (high - low) * area.height();
        let rule = Stroke::new(1.0, self.seen.pane_colours().rule);
        let marks = lane_shape::lane_scale_marks(lane, largest, self.seen.language);
        for (value, _) in &marks {
            painter.hline(area.x_range(), y(*value), rule);
        }
        if lane == CurveLane::Palm {
            painter.hline(area.x_range(), y(0.0), rule);
        }
        let colours = lane_hand_colours(self.seen);
        // The right hand last, so that it lies above the left one.
        for hand in (0..lane.lane_curve_count()).rev() {
            let colour = if lane.lane_curve_count() == 2 {
                colours[hand]
            } else {
                ui.visuals().text_color()
            };
            let of = (lane, hand);
            match curves.visible_frame_runs(of, &self.window, area.width()) {
                Some(runs) => {
                    let place = |(x, value)| pos2(area.left() + x, y(value));
                    for run in &runs {
                        let points = lane_shape::smooth_frame_line(run).into_iter().map(place).collect();
                        painter.add(Shape::line(points, Stroke::new(1.6, colour)));
                    }
                }
                None => {
                    let width = area.width().ceil().max(1.0) as usize;
                    let columns = curves.curve_column_ranges(of, &self.window, width);
                    painter.add(Shape::mesh(build_curve_mesh(&columns, area.left(), y, colour)));
                }
            }
        }
        self.paint_lane_scale(ui, painter, area, &marks, y);
        if lane == CurveLane::Speed && self.seen.settings.timeline.snaps.minima {
            let whole_span = self.seen.shown.player.whole;
            let (from, to) = timeline_lanes::visible_window_span(&self.window, area.width(), whole_span);
            for at in curves.wrist_speed_minima(from, to) {
                let x = area.left() + self.window.time_to_points(at as f64);
                let tick = [pos2(x, area.bottom() - 5.0), pos2(x, area.bottom())];
                painter.line_segment(tick, Stroke::new(1.5, self.seen.pane_colours().playhead));
            }
        }
    }

    /// Shows the scale's marks at the right end of a lane; the lower one only if there is room.
    fn paint_lane_scale(
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
            // The mark stays within its lane, however near the value is to its edge.
            let lowest = (area.bottom() + 2.0 - size.y).max(area.top() - 2.0);
            let top = (y(*value) - size.y / 2.0).clamp(area.top() - 2.0, lowest);
            let text_position = pos2(area.right() - size.x - 4.0, top);
            let back = Rect::from_min_size(text_position, size).expand2(vec2(2.0, -1.0));
            painter.rect_filled(back, 2.0, ground.gamma_multiply(0.8));
            painter.galley(text_position, galley, ink);
        }
    }
}

/// Paints a small text into `rect`, with an ellipsis if it is cut.
fn paint_elided_text(ui: &Ui, rect: Rect, text: &str, colour: Color32) {
    let wrap = Some(TextWrapMode::Truncate);
    let galley = WidgetText::from(text).into_galley(ui, wrap, rect.width(), TextStyle::Small);
    let text_position = pos2(rect.left(), rect.center().y - galley.size().y / 2.0);
    ui.painter().galley(text_position, galley, colour);
}

/// Returns the area below a line through frames.
fn hill(runs: &[FrameRun], area: Rect, y: impl Fn(f32) -> f32, colour: Color32) -> Mesh {
    let mut mesh = Mesh::default();
    for run in runs {
        for pair in lane_shape::smooth_frame_line(run).windows(2) {
            // Below zero and at rest nothing is drawn.
            if pair[0].1.max(pair[1].1) <= 0.0 {
                continue;
            }
            let base_index = mesh.vertices.len() as u32;
            for (x, value) in pair {
                let x = area.left() + x;
                mesh.colored_vertex(pos2(x, y(*value)), colour);
                mesh.colored_vertex(pos2(x, area.bottom() - 1.0), colour);
            }
            mesh.add_triangle(base_index, base_index + 1, base_index + 2);
            mesh.add_triangle(base_index + 1, base_index + 2, base_index + 3);
        }
    }
    mesh
}

/// Returns the same area for frames that are narrower than columns.
fn build_steps_mesh(columns: &[Option<(f32, f32)>], area: Rect, y: impl Fn(f32) -> f32, colour: Color32) -> Mesh {
    let mut mesh = Mesh::default();
    for (x, column) in columns.iter().enumerate() {
        if let Some((_, high)) = column.filter(|range| range.1 > 0.0) {
            let left = area.left() + x as f32;
            let ends = (pos2(left, y(high)), pos2(left + 1.0, area.bottom() - 1.0));
            mesh.add_colored_rect(Rect::from_min_max(ends.0, ends.1), colour);
        }
    }
    mesh
}

/// Returns a curve as a sequence of vertical bars, each long enough to touch the one before.
fn build_curve_mesh(columns: &[Option<(f32, f32)>], left: f32, y: impl Fn(f32) -> f32, colour: Color32) -> Mesh {
    let mut mesh = Mesh::default();
    let mut before: Option<(f32, f32)> = None;
    for (x, column) in columns.iter().enumerate() {
        if let Some((low, high)) = *column {
            // Bars of neighbouring columns overlap, which makes a line without gaps.
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
