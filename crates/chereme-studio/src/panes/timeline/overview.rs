//! The strip that shows the whole recording: the density of annotations, and a box around the visible part, which can
//! be dragged.

use std::sync::Arc;

use chereme_corpus::TierContents;
use chereme_motion::{Instant, Span};
use eframe::egui::{
    Color32, CursorIcon, EventFilter, Key, Mesh, Modifiers, Rect, Response, Role, Sense, Shape,
    Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2,
};

use super::data::{Window, time_text};
use super::edit::Scene;
use super::ui::Drawing;
use crate::words::{fill, timeline as words};

const HEIGHT: f32 = 26.0;
/// The distance from an edge of the box within which the edge is grabbed, in points.
const EDGE: f32 = 5.0;
/// The least width of the box, in points.
const LEAST: f32 = 12.0;

/// The density of annotations, column by column.
#[derive(Debug, Default)]
pub(super) struct Overview {
    /// The snapshot, the width and the tier it was built for.
    of: Option<(usize, usize, Option<i64>)>,
    /// Density over all tiers, from 0 to 1.
    all: Vec<f32>,
    /// Whether the selected tier has an annotation.
    own: Vec<bool>,
    /// How the box is being dragged.
    held: Option<Hold>,
}

/// The dragged part of the box.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Hold {
    /// The left edge; the time of the right one in microseconds.
    Start(f64),
    /// The right edge; the time of the left one in microseconds.
    End(f64),
    /// The whole box; the distance from its start to the pointer, in microseconds.
    Whole(f64),
}

/// Returns how many annotations lie in each of `width` columns of a recording.
fn density<'a>(
    tiers: impl Iterator<Item = &'a TierContents>,
    whole: Span,
    width: usize,
) -> Vec<u32> {
    let start = whole.start().micros();
    let scale = width as f64 / whole.micros().max(1) as f64;
    let column = |at: i64| (((at - start) as f64 * scale).max(0.0) as usize).min(width);
    // Annotations that begin minus those that end at each column; the sum from the left is the number of annotations.
    let mut change = vec![0_i64; width + 1];
    for tier in tiers {
        let columns = &tier.annotations;
        for (from, to) in columns.starts.iter().zip(&columns.ends) {
            let from = column(*from).min(width.saturating_sub(1));
            change[from] += 1;
            change[column(*to).max(from + 1).min(width)] -= 1;
        }
    }
    let mut count = 0_i64;
    change.truncate(width);
    let counts = change.iter().map(|by| {
        count += by;
        u32::try_from(count).unwrap_or_default()
    });
    counts.collect()
}

impl Overview {
    fn update(&mut self, scene: &Scene<'_>, width: usize) {
        let open = scene.seen.snapshot.open.as_ref();
        let snapshot = open.map_or(0, |open| Arc::as_ptr(open) as usize);
        let tier = scene.tier();
        let now = Some((snapshot, width, tier.map(|it| it.row.id)));
        if self.of == now {
            return;
        }
        let whole = scene.seen.shown.player.whole;
        let all = density(scene.contents.tiers.iter(), whole, width);
        let most = all.iter().copied().max().unwrap_or(0).max(1) as f32;
        self.all = all.iter().map(|it| *it as f32 / most).collect();
        let own = density(tier.into_iter(), whole, width);
        self.own = own.iter().map(|it| *it > 0).collect();
        self.of = now;
    }
}

impl Drawing<'_, '_> {
    /// Shows the strip if only a part of the recording is visible.
    pub(super) fn overview(&mut self, ui: &mut Ui, scene: &Scene<'_>) {
        let whole = self.seen.shown.player.whole;
        if self.timeline.view.window.is_none()
            || whole.is_empty()
            || !self.seen.settings.timeline.overview
        {
            self.timeline.overview.held = None;
            return;
        }
        let size = vec2(ui.available_width(), HEIGHT);
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let strip = rect
            .with_min_x(rect.left() + self.names)
            .shrink2(vec2(0.0, 2.0));
        let id = ui.unique_id().with("overview");
        let response = ui.interact(strip, id, Sense::click_and_drag());
        let seen_to = self.window.micros(self.timeline.view.width);
        let text = |micros: f64| {
            let at = Instant::from_micros(micros as i64);
            time_text(at.max(whole.start()).min(whole.end()))
        };
        let label = fill(
            self.seen.say(words::OVERVIEW),
            &[("start", &text(self.window.start)), ("end", &text(seen_to))],
        );
        response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, &label));
        self.overview_keys(ui, &response);
        self.overview_mouse(ui, &response, strip);
        self.paint_overview(ui, scene, strip, &response);
        response.on_hover_text(label);
    }

    /// Returns the box of the visible part in the strip.
    fn overview_box(&self, strip: Rect) -> Rect {
        let x = self.overview_x(strip);
        let (left, right) = (
            x(self.window.start),
            x(self.window.micros(self.timeline.view.width)),
        );
        let (left, right) = (left.max(strip.left()), right.min(strip.right()));
        let more = ((LEAST - (right - left)) / 2.0).max(0.0);
        // A strip may be narrower than the box.
        let left = (left - more).min(strip.right() - LEAST).max(strip.left());
        Rect::from_x_y_ranges(left..=(right + more).max(left + LEAST), strip.y_range())
    }

    fn overview_x(&self, strip: Rect) -> impl Fn(f64) -> f32 + use<> {
        let whole = self.seen.shown.player.whole;
        let (start, length) = (whole.start().micros() as f64, whole.micros().max(1) as f64);
        move |micros| strip.left() + ((micros - start) / length) as f32 * strip.width()
    }

    fn overview_keys(&mut self, ui: &Ui, response: &Response) {
        if !response.has_focus() {
            return;
        }
        let arrows = EventFilter {
            horizontal_arrows: true,
            ..EventFilter::default()
        };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
        let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let by = [(Key::ArrowLeft, -0.25), (Key::ArrowRight, 0.25)];
        for (_, share) in by.into_iter().filter(|(key, _)| pressed(*key)) {
            self.timeline.view.page(share, self.seen);
        }
    }

    fn overview_mouse(&mut self, ui: &Ui, response: &Response, strip: Rect) {
        let whole = self.seen.shown.player.whole;
        let bar = self.overview_box(strip);
        let (from, to) = (
            self.window.start,
            self.window.micros(self.timeline.view.width),
        );
        let near = |x: f32| {
            let edge = EDGE.min(bar.width() / 4.0);
            if (x - bar.left()).abs() <= edge {
                Some(Hold::Start(to))
            } else if (x - bar.right()).abs() <= edge {
                Some(Hold::End(from))
            } else {
                None
            }
        };
        if let Some(at) = response.hover_pos() {
            ui.set_cursor_icon(match near(at.x) {
                Some(_) => CursorIcon::ResizeHorizontal,
                None if bar.contains(at) => CursorIcon::Grab,
                None => CursorIcon::PointingHand,
            });
        }
        let Some(pointer) = response.interact_pointer_pos() else {
            self.timeline.overview.held = None;
            return;
        };
        let share = f64::from((pointer.x - strip.left()) / strip.width().max(1.0));
        let at = whole.start().micros() as f64 + whole.micros() as f64 * share;
        let pressed = ui.input(|input| input.pointer.press_origin());
        let held = *self.timeline.overview.held.get_or_insert_with(|| {
            let origin = pressed.map_or(pointer.x, |it| it.x);
            // A click beside the box moves its middle there.
            let middle = || Hold::Whole((to - from) / 2.0);
            match near(origin) {
                Some(edge) => edge,
                None if bar.x_range().contains(origin) => {
                    let share = f64::from((origin - strip.left()) / strip.width().max(1.0));
                    let origin = whole.start().micros() as f64 + whole.micros() as f64 * share;
                    Hold::Whole(origin - from)
                }
                None => middle(),
            }
        });
        if !response.dragged() && !response.clicked() && !response.is_pointer_button_down_on() {
            return;
        }
        let width = self.timeline.view.width;
        let (start, end) = match held {
            Hold::Whole(before) => (at - before, at - before + (to - from)),
            Hold::Start(end) => (at.min(end - 1e4), end),
            Hold::End(start) => (start, at.max(start + 1e4)),
        };
        self.timeline.view.window = Some(Window::showing(start, end, whole, width));
    }

    fn paint_overview(&mut self, ui: &Ui, scene: &Scene<'_>, strip: Rect, response: &Response) {
        let width = strip.width().ceil().max(1.0) as usize;
        self.timeline.overview.update(scene, width);
        let overview = &self.timeline.overview;
        let (colours, painter) = (self.seen.colours(), ui.painter_at(strip));
        painter.rect_filled(strip, 3.0, colours.stripe);
        let mut mesh = Mesh::default();
        let mut column = |x: usize, top: f32, colour: Color32| {
            let left = strip.left() + x as f32;
            let rect = Rect::from_min_max(pos2(left, top), pos2(left + 1.0, strip.bottom() - 4.0));
            mesh.add_colored_rect(rect, colour);
        };
        let weak = ui.visuals().weak_text_color();
        let room = strip.height() - 6.0;
        for (x, share) in overview.all.iter().enumerate().filter(|it| *it.1 > 0.0) {
            column(
                x,
                strip.bottom() - 4.0 - room * share.max(0.15),
                weak.gamma_multiply(0.6),
            );
        }
        painter.add(Shape::mesh(mesh));
        let mut own = Mesh::default();
        for x in (0..overview.own.len()).filter(|x| overview.own[*x]) {
            let at = pos2(strip.left() + x as f32, strip.bottom() - 3.0);
            own.add_colored_rect(Rect::from_min_size(at, vec2(1.0, 3.0)), colours.accent);
        }
        painter.add(Shape::mesh(own));
        let x = self.overview_x(strip);
        if let Some(span) = self.seen.shown.span {
            let (from, to) = (span.start().micros() as f64, span.end().micros() as f64);
            let area = Rect::from_x_y_ranges(x(from)..=x(to).max(x(from) + 1.5), strip.y_range());
            painter.rect_filled(area, 0.0, colours.selection.gamma_multiply(0.7));
        }
        let bar = self.overview_box(strip);
        let strong = response.hovered() || response.has_focus();
        let stroke = Stroke::new(if strong { 2.0 } else { 1.5 }, colours.accent);
        let light = ui.visuals().text_color().gamma_multiply(0.10);
        painter.rect(bar, 3.0, light, stroke, StrokeKind::Inside);
        let at = x(scene.playhead() as f64);
        painter.vline(at, strip.y_range(), Stroke::new(1.5, colours.playhead));
    }
}

#[cfg(test)]
mod tests {
    use super::super::dragged::tests::contents;
    use super::*;

    #[test]
    fn columns_count_the_annotations_inside_them() {
        let all = contents(&[
            (1, None, "", &[(1, 0, 100, None), (2, 100, 300, None)]),
            (2, None, "", &[(3, 250, 260, None), (4, 900, 1000, None)]),
        ]);
        let whole = Span::between(Instant::ZERO, Instant::from_micros(1000));
        let of = |tiers: &[TierContents], width| density(tiers.iter(), whole, width);
        assert_eq!(of(&all.tiers, 10), [1, 1, 2, 0, 0, 0, 0, 0, 0, 1]);
        assert_eq!(of(&all.tiers[..1], 2), [2, 0]);
        // An annotation shorter than a column is shown too; one beyond the end is shown at the end.
        let odd = contents(&[(1, None, "", &[(1, 500, 501, None), (2, 5000, 6000, None)])]);
        assert_eq!(of(&odd.tiers, 4), [0, 0, 1, 1]);
        assert_eq!(of(&[], 0), [] as [u32; 0]);
    }
}
