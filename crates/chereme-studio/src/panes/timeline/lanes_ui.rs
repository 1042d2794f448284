//! The lanes of movement: their names with what they say at the playhead, and their curves.

use eframe::egui::{
    Align2, Color32, FontId, Mesh, Painter, Rect, Role, ScrollArea, Sense, Shape, Stroke,
    TextStyle, Ui, WidgetInfo, pos2, vec2,
};

use super::edit::Scene;
use super::lanes::{Lane, Source};
use super::ui::Drawing;
use super::{lanes, paint};
use crate::context::Seen;
use crate::words::timeline as words;

const HEIGHT: f32 = 36.0;

/// How high the lane of a stored curve is, and the share of the pane that they take at most.
const FACE: f32 = 20.0;
const FACE_SHARE: f32 = 0.4;

/// Returns what a stored curve such as `brows.RB` is called: as the inventory of its feature says.
fn face_name(seen: &Seen<'_>, name: &str) -> String {
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

/// Returns the colours of the right hand and of the left.
fn hands(seen: &Seen<'_>) -> [Color32; 2] {
    [seen.colours().accent, seen.colours().good]
}

impl Drawing<'_, '_> {
    pub(super) fn lanes(&mut self, ui: &mut Ui, scene: &Scene<'_>) {
        let ways = &self.seen.settings.timeline;
        if ways.lanes.is_empty() && !ways.snaps.minima {
            return;
        }
        let source = scene.frames().map(|frames| Source {
            recording: scene.contents.recording.id,
            frames: self.seen.reel.frames(),
            rate: frames.rate,
            offset: frames.offset,
        });
        let whole = self.seen.shown.player.whole;
        let sight = lanes::seen(&self.window, self.timeline.width, whole);
        self.timeline
            .curves
            .want(source, sight, scene.playhead(), self.out);
        let shown = ways.lanes.clone();
        for (lane, _, name) in Lane::ALL
            .into_iter()
            .filter(|(lane, ..)| shown.contains(lane))
        {
            if lane == Lane::Face {
                self.face(ui, scene);
            } else {
                self.one_lane(ui, scene, lane, self.seen.say(name));
            }
        }
    }

    /// Shows the stored curves, one below the other.
    fn face(&mut self, ui: &mut Ui, scene: &Scene<'_>) {
        let names: Vec<String> = {
            let all = self.timeline.curves.stored();
            all.into_iter().map(str::to_owned).collect()
        };
        if names.is_empty() {
            let text = match scene.frames() {
                Some(_) if self.timeline.curves.is_bare() => words::MEASURING,
                _ => words::NO_FACE,
            };
            ui.weak(self.seen.say(text));
            return;
        }
        let most = (ui.available_height() * FACE_SHARE).max(FACE);
        ScrollArea::vertical()
            .id_salt("face")
            .max_height(most)
            .show(ui, |ui| {
                for name in &names {
                    self.one_of_face(ui, scene, name);
                }
            });
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
        let width = area.width().ceil().max(1.0) as usize;
        let columns = curves.stored_columns(name, &self.window, width);
        let y = |value: f32| area.bottom() - 1.0 - value.clamp(0.0, 1.0) * (area.height() - 4.0);
        let mut mesh = Mesh::default();
        for (x, column) in columns.iter().enumerate() {
            if let Some((_, high)) = column.filter(|it| it.1 > 0.0) {
                let left = area.left() + x as f32;
                let ends = (pos2(left, y(high)), pos2(left + 1.0, area.bottom() - 1.0));
                mesh.add_colored_rect(Rect::from_min_max(ends.0, ends.1), colours.good);
            }
        }
        painter.add(Shape::mesh(mesh));
        painter.hline(
            area.x_range(),
            area.bottom(),
            Stroke::new(1.0, colours.rule),
        );
        let x = area.left() + self.window.x(scene.playhead() as f64);
        painter.vline(x, area.y_range(), Stroke::new(1.5, colours.playhead));
        let strong = now > 0.0;
        let colour = if strong {
            ui.visuals().strong_text_color()
        } else {
            ui.visuals().text_color()
        };
        let place = rect.with_max_x(area.left() - 4.0);
        ui.painter_at(place).text(
            pos2(place.left() + 8.0, place.center().y),
            Align2::LEFT_CENTER,
            &called,
            TextStyle::Small.resolve(ui.style()),
            colour,
        );
        if let Some(at) = response.interact_pointer_pos()
            && (response.dragged() || response.clicked())
        {
            self.out.seek(self.instant(at.x - area.left()));
        }
        response.on_hover_text(says);
    }

    fn one_lane(&mut self, ui: &mut Ui, scene: &Scene<'_>, lane: Lane, name: &str) {
        let size = vec2(ui.available_width(), HEIGHT);
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let area = rect.with_min_x(rect.left() + self.names);
        let id = ui.unique_id().with(("movement", lane));
        let response = ui.interact(area, id, Sense::click_and_drag());
        let says = self.says(scene, lane);
        response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, format!("{name} {says}")));
        self.lane_name(ui, rect.with_max_x(area.left() - 4.0), name, &says, lane);
        let painter = ui.painter_at(area);
        painter.hline(
            area.x_range(),
            area.bottom(),
            Stroke::new(1.0, self.seen.colours().rule),
        );
        if let Some(span) = self.seen.shown.span {
            paint::selection(&painter, area, &self.window, span, self.seen);
        }
        self.curves(ui, &painter, area.shrink2(vec2(0.0, 2.0)), lane);
        let x = area.left() + self.window.x(scene.playhead() as f64);
        painter.vline(
            x,
            area.y_range(),
            Stroke::new(1.5, self.seen.colours().playhead),
        );
        if let Some(at) = response.interact_pointer_pos()
            && (response.dragged() || response.clicked())
        {
            self.out.seek(self.instant(at.x - area.left()));
        }
    }

    fn lane_name(&self, ui: &Ui, rect: Rect, name: &str, says: &str, lane: Lane) {
        let font: FontId = TextStyle::Small.resolve(ui.style());
        let painter = ui.painter_at(rect);
        let (left, weak) = (rect.left() + 8.0, ui.visuals().weak_text_color());
        let colour = ui.visuals().text_color();
        painter.text(
            pos2(left, rect.top() + 2.0),
            Align2::LEFT_TOP,
            name,
            font.clone(),
            colour,
        );
        let mut x = left;
        let parts: Vec<&str> = says.split('\n').collect();
        for (hand, part) in parts.iter().enumerate() {
            let colour = if lane.curves() == 2 {
                hands(self.seen)[hand.min(1)]
            } else {
                weak
            };
            let at = pos2(x, rect.bottom() - 3.0);
            x = painter
                .text(at, Align2::LEFT_BOTTOM, part, font.clone(), colour)
                .right()
                + 8.0;
        }
    }

    /// Returns what a lane says at the playhead, the hands on lines of their own.
    fn says(&self, scene: &Scene<'_>, lane: Lane) -> String {
        if scene.frames().is_none() {
            return self.seen.say(words::NO_MOVEMENT).to_owned();
        }
        let (curves, at) = (&self.timeline.curves, scene.playhead());
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
        let (low, high) = lane.range(self.timeline.curves.largest(lane));
        let y = |value: f32| area.bottom() - (value - low) / (high - low) * area.height();
        if lane == Lane::Palm {
            painter.hline(
                area.x_range(),
                y(0.0),
                Stroke::new(1.0, self.seen.colours().rule),
            );
        }
        let width = area.width().ceil().max(1.0) as usize;
        let colours = hands(self.seen);
        for hand in (0..lane.curves()).rev() {
            let colour = if lane.curves() == 2 {
                colours[hand]
            } else {
                ui.visuals().text_color()
            };
            let columns = self
                .timeline
                .curves
                .columns((lane, hand), &self.window, width);
            painter.add(Shape::mesh(curve(&columns, area.left(), y, colour)));
        }
        if lane == Lane::Speed && self.seen.settings.timeline.snaps.minima {
            let whole = self.seen.shown.player.whole;
            let (from, to) = lanes::seen(&self.window, area.width(), whole);
            for at in self.timeline.curves.minima(from, to) {
                let x = area.left() + self.window.x(at as f64);
                let tick = [pos2(x, area.bottom() - 5.0), pos2(x, area.bottom())];
                painter.line_segment(tick, Stroke::new(1.5, self.seen.colours().playhead));
            }
        }
    }
}

/// Returns a curve as one column of colour beside the other, each reaching the one before.
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
