//! The timeline's widgets: the ruler and the rows, and what the mouse does on them.

use chereme_corpus::Contents;
use chereme_motion::{Instant, Span};
use eframe::egui::{
    Align2, Color32, FontId, Id, Rect, Response, Role, ScrollArea, Sense, TextStyle, Ui,
    WidgetInfo, pos2, vec2,
};

use super::data::{self, Window, time_text};
use super::{Timeline, edit, paint};
use crate::command::Command;
use crate::context::{Outbox, Seen};
use crate::words::{fill, timeline as words};

/// The least width of the names of tiers; at most they take this share of the pane.
const NAMES: f32 = 96.0;
const NAMES_SHARE: f32 = 0.35;
const INDENT: f32 = 12.0;
const ROW: f32 = 26.0;
const RULER: f32 = 22.0;
/// How many annotations of a row are widgets of their own, for the keyboard and for assistive tools.
const NAMED: usize = 200;

pub(super) fn show(timeline: &mut Timeline, ui: &mut Ui, seen: &Seen<'_>, out: &mut Outbox) {
    let Some(recording) = seen.shown.recording else {
        ui.label(seen.say(words::NO_RECORDING));
        return;
    };
    let Some(contents) = seen.snapshot.contents(recording) else {
        ui.spinner();
        return;
    };
    if timeline.of != Some(recording) {
        (timeline.of, timeline.window) = (Some(recording), None);
    }
    let names = names_width(ui, contents);
    let width = (ui.available_width() - names).max(40.0);
    timeline.width = width;
    let player = &seen.shown.player;
    let mut window = timeline.window(player.whole, width);
    if player.is_playing() && timeline.window.is_some() {
        window = window.following(player.playhead().micros() as f64, player.whole, width);
        timeline.window = Some(window);
    }
    ui.spacing_mut().item_spacing.y = 0.0;
    let mut frame = Drawing {
        timeline,
        window,
        names,
        seen,
        out,
    };
    frame.ruler(ui);
    if contents.tiers.is_empty() {
        ui.add_space(8.0);
        ui.label(seen.say(words::EMPTY));
        return;
    }
    frame.rows(ui, contents);
}

/// Returns how wide the column of names is: as wide as the widest, within bounds.
fn names_width(ui: &Ui, contents: &Contents) -> f32 {
    let font = TextStyle::Body.resolve(ui.style());
    let depths = data::depths(&contents.tiers);
    let widths = contents.tiers.iter().zip(&depths).map(|(tier, depth)| {
        let name = tier.row.name.clone();
        let text = ui
            .painter()
            .layout_no_wrap(name, font.clone(), Color32::WHITE);
        text.size().x + 20.0 + INDENT * *depth as f32
    });
    let most = (ui.available_width() * NAMES_SHARE).max(NAMES);
    widths.fold(NAMES, f32::max).min(most)
}

struct Drawing<'a, 'b> {
    timeline: &'a mut Timeline,
    window: Window,
    names: f32,
    seen: &'a Seen<'b>,
    out: &'a mut Outbox,
}

impl Drawing<'_, '_> {
    fn ruler(&mut self, ui: &mut Ui) {
        let size = vec2(ui.available_width(), RULER);
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let lane = rect.with_min_x(rect.left() + self.names);
        let response = ui.interact(lane, ui.unique_id().with("ruler"), Sense::click_and_drag());
        response
            .widget_info(|| WidgetInfo::labeled(Role::Slider, true, self.seen.say(words::RULER)));
        let painter = ui.painter_at(lane);
        let font = TextStyle::Small.resolve(ui.style());
        paint::ruler(&painter, lane, &self.window, self.seen, &font);
        if let Some(span) = self.seen.shown.span {
            paint::selection(&painter, lane, &self.window, span, self.seen);
            let text = fill(
                self.seen.say(words::SELECTED),
                &[
                    ("start", &time_text(span.start())),
                    ("end", &time_text(span.end())),
                ],
            );
            response.clone().on_hover_text(text);
        }
        paint::playhead(&painter, lane, &self.window, self.seen);
        if let Some(at) = response.interact_pointer_pos()
            && (response.dragged() || response.clicked())
        {
            self.out.seek(self.instant(at.x - lane.left()));
        }
        self.wheel(ui, lane);
    }

    fn rows(&mut self, ui: &mut Ui, contents: &Contents) {
        let depths = data::depths(&contents.tiers);
        let area = ui.available_rect_before_wrap();
        let count = contents.tiers.len();
        ScrollArea::vertical()
            .auto_shrink(false)
            .show_rows(ui, ROW, count, |ui, range| {
                for at in range {
                    self.row(ui, contents, at, depths[at]);
                }
            });
        let lane = area.with_min_x(area.left() + self.names);
        let painter = ui.painter_at(lane);
        let x = lane.left()
            + self
                .window
                .x(self.seen.shown.player.playhead().micros() as f64);
        let stroke = eframe::egui::Stroke::new(1.5, self.seen.colours().playhead);
        painter.vline(x, lane.y_range(), stroke);
        self.wheel(ui, lane);
    }

    fn row(&mut self, ui: &mut Ui, contents: &Contents, at: usize, depth: usize) {
        let tier = &contents.tiers[at];
        let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::hover());
        let chosen = edit::tier(contents, self.seen).is_some_and(|it| it.row.id == tier.row.id);
        let colours = self.seen.colours();
        if at % 2 == 1 {
            ui.painter().rect_filled(rect, 0.0, colours.stripe);
        }
        let name = rect.with_max_x(rect.left() + self.names - 4.0);
        let label = fill(self.seen.say(words::TIER), &[("name", &tier.row.name)]);
        let response = ui.interact(name, Id::unique(("tier", tier.row.id)), Sense::click());
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &label));
        if response.clicked() {
            self.out.send(Command::Tier(Some(tier.row.id)));
        }
        if chosen {
            let mark = name.with_max_x(name.left() + 3.0);
            ui.painter().rect_filled(mark, 0.0, colours.accent);
        }
        let visuals = ui.style().interact_selectable(&response, chosen);
        let text = if chosen {
            ui.visuals().strong_text_color()
        } else {
            visuals.text_color()
        };
        let from = pos2(name.left() + 8.0 + INDENT * depth as f32, name.center().y);
        let font = TextStyle::Body.resolve(ui.style());
        ui.painter_at(name)
            .text(from, Align2::LEFT_CENTER, &tier.row.name, font, text);
        let lane = rect.with_min_x(rect.left() + self.names);
        self.lane(ui, contents, at, lane);
    }

    fn lane(&mut self, ui: &mut Ui, contents: &Contents, at: usize, lane: Rect) {
        let tier = &contents.tiers[at];
        let response = ui.interact(
            lane,
            Id::unique(("lane", tier.row.id)),
            Sense::click_and_drag(),
        );
        let painter = ui.painter_at(lane);
        if let Some(span) = self.seen.shown.span {
            paint::selection(&painter, lane, &self.window, span, self.seen);
        }
        let font: FontId = TextStyle::Body.resolve(ui.style());
        let (from, to) = (
            self.window.start as i64,
            self.window.micros(lane.width()) as i64 + 1,
        );
        let narrow = (self.window.scale * 1.5) as i64;
        let bars = data::bars(&tier.annotations, from, to, narrow.max(1));
        let named = bars.iter().filter(|bar| bar.count == 1).count() <= NAMED;
        for bar in &bars {
            let rect = paint::bar_rect(lane, &self.window, bar);
            paint::bar(&painter, rect, (tier, bar), self.seen, &font);
            if bar.count == 1 && named {
                let id = tier.annotations.ids[bar.at];
                let here = rect.intersect(lane);
                let own = ui.interact(here, Id::unique(("annotation", id)), Sense::click());
                let chosen = self.seen.shown.annotations.contains(&id);
                let says = paint::bar_text(tier, bar, self.seen);
                let label = format!("{}: {says}", tier.row.name);
                own.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &label));
                if own.clicked() {
                    edit::select(tier, bar.at, self.out);
                }
            }
        }
        self.drag(&response, contents, at, lane);
    }

    /// A click puts the playhead and selects the tier; dragging selects time.
    fn drag(&mut self, response: &Response, contents: &Contents, at: usize, lane: Rect) {
        let Some(pointer) = response.interact_pointer_pos() else {
            return;
        };
        let tier = &contents.tiers[at];
        let here = self.instant(pointer.x - lane.left());
        if response.drag_started() {
            let from = response.ctx.input(|input| input.pointer.press_origin());
            let from = from.map_or(here, |from| self.instant(from.x - lane.left()));
            self.timeline.dragged_from = Some(from.micros());
            self.out.send(Command::Tier(Some(tier.row.id)));
            self.out.send(Command::Annotations(Default::default()));
        }
        if let Some(from) = self.timeline.dragged_from.filter(|_| response.dragged()) {
            let span = Span::between(Instant::from_micros(from), here);
            self.out
                .send(Command::Span(Some(span).filter(|span| !span.is_empty())));
        }
        if response.drag_stopped() {
            self.timeline.dragged_from = None;
        }
        if response.clicked() {
            match data::at(&tier.annotations, here.micros()) {
                Some(under) => edit::select(tier, under, self.out),
                None => {
                    self.out.send(Command::Tier(Some(tier.row.id)));
                    self.out.send(Command::Annotations(Default::default()));
                }
            }
            self.out.seek(here);
        }
    }

    /// Ctrl and wheel zoom around the pointer; Shift and wheel, or a wheel sideways, pan.
    fn wheel(&mut self, ui: &Ui, lane: Rect) {
        let Some(pointer) = ui.input(|input| input.pointer.hover_pos()) else {
            return;
        };
        if !lane.contains(pointer) || !ui.rect_contains_pointer(lane) {
            return;
        }
        let (zoom, pan) = ui.input(|input| (input.zoom_delta(), input.smooth_scroll_delta().x));
        let (whole, width) = (self.seen.shown.player.whole, lane.width());
        if zoom != 1.0 {
            let around = self.window.micros(pointer.x - lane.left());
            let window = self
                .window
                .zoomed(1.0 / f64::from(zoom), around, whole, width);
            self.timeline.window = Some(window);
        } else if pan != 0.0 {
            self.timeline.window = Some(self.window.panned(-pan, whole, width));
        }
    }

    fn instant(&self, x: f32) -> Instant {
        let whole = self.seen.shown.player.whole;
        let micros = self.window.micros(x).round() as i64;
        let last = whole.end().micros();
        Instant::from_micros(micros.clamp(whole.start().micros(), last))
    }
}
