//! The strip that shows the whole recording: the density of annotations, and a box around the visible part, which can
//! be dragged.

use std::sync::Arc;

use chereme_corpus::TierContents;
use chereme_motion::{RecordingInstant, TimeSpan};
use eframe::egui::{
    Color32, CursorIcon, EventFilter, Key, Mesh, Modifiers, Rect, Response, Role, Sense, Shape, Stroke, StrokeKind, Ui,
    WidgetInfo, pos2, vec2,
};

use super::timeline_data::time_text;
use super::timeline_edit::TimelineScene;
use super::timeline_ui::TimelineDrawing;
use crate::model::time_window::TimeWindow;
use crate::words::{fill_text_braces, timeline as words};

const OVERVIEW_HEIGHT_POINTS: f32 = 26.0;
/// The distance from an edge of the box within which the edge is grabbed, in points.
const OVERVIEW_EDGE_REACH_POINTS: f32 = 5.0;
/// The least width of the box, in points.
const MIN_OVERVIEW_BOX_POINTS: f32 = 12.0;

/// The density of annotations, column by column.
#[derive(Debug, Default)]
pub(super) struct TimelineOverview {
    /// The snapshot, the width and the tier it was built for.
    of: Option<(usize, usize, Option<i64>)>,
    /// Density over all tiers, from 0 to 1.
    all: Vec<f32>,
    /// Whether the selected tier has an annotation.
    own: Vec<bool>,
    /// How the box is being dragged.
    held: Option<OverviewHold>,
}

/// The dragged part of the box.
#[derive(Debug, Clone, Copy, PartialEq)]
enum OverviewHold {
    /// The left edge; the time of the right one in microseconds.
    Start(f64),
    /// The right edge; the time of the left one in microseconds.
    End(f64),
    /// The whole box; the distance from its start to the pointer, in microseconds.
    Whole(f64),
}

/// Returns how many annotations lie in each of `width` columns of a recording.
fn annotation_density<'a>(tiers: impl Iterator<Item = &'a TierContents>, whole: TimeSpan, width: usize) -> Vec<u32> {
    let start = whole.span_start_instant().instant_micros();
    let scale = width as f64 / whole.span_micros().max(1) as f64;
    let column = |at: i64| (((at - start) as f64 * scale).max(0.0) as usize).min(width);
    // Annotations that begin minus those that end at each column; the sum from the left is the number of annotations.
    let mut change = vec![0_i64; width + 1];
    for tier in tiers {
        let columns = &tier.annotations;
        for (from, to) in columns.starts.iter().zip(&columns.ends) {
            // An annotation at the very end belongs to the last column.
            let from = column(*from).min(width.saturating_sub(1));
            change[from] += 1;
            // Every annotation takes one column at least, however short it is.
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

impl TimelineOverview {
    fn update_annotation_density(&mut self, scene: &TimelineScene<'_>, width: usize) {
        let open = scene.seen.snapshot.open.as_ref();
        let snapshot = open.map_or(0, |open| Arc::as_ptr(open) as usize);
        let tier = scene.edited_tier();
        // The address distinguishes snapshots without comparing them.
        let now = Some((snapshot, width, tier.map(|tier| tier.row.id)));
        if self.of == now {
            return;
        }
        let whole_span = scene.seen.shown.player.whole;
        let all = annotation_density(scene.contents.tiers.iter(), whole_span, width);
        let most = all.iter().copied().max().unwrap_or(0).max(1) as f32;
        self.all = all.iter().map(|count| *count as f32 / most).collect();
        let tier_density = annotation_density(tier.into_iter(), whole_span, width);
        self.own = tier_density.iter().map(|count| *count > 0).collect();
        self.of = now;
    }
}

impl TimelineDrawing<'_, '_> {
    /// Shows the strip if only a part of the recording is visible.
    pub(super) fn show_timeline_overview(&mut self, ui: &mut Ui, scene: &TimelineScene<'_>) {
        let whole_span = self.seen.shown.player.whole;
        if self.timeline.view.window.is_none() || whole_span.is_empty() || !self.seen.settings.timeline.overview {
            self.timeline.overview.held = None;
            return;
        }
        let size = vec2(ui.available_width(), OVERVIEW_HEIGHT_POINTS);
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let strip = rect.with_min_x(rect.left() + self.names).shrink2(vec2(0.0, 2.0));
        let id = ui.unique_id().with("overview");
        let response = ui.interact(strip, id, Sense::click_and_drag());
        let seen_to = self.window.points_to_micros(self.timeline.view.width);
        let text = |micros: f64| {
            let time = RecordingInstant::from_micros(micros as i64);
            time_text(
                time.max(whole_span.span_start_instant())
                    .min(whole_span.span_end_instant()),
            )
        };
        let label = fill_text_braces(
            self.seen.say_text(words::OVERVIEW),
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
            x(self.window.points_to_micros(self.timeline.view.width)),
        );
        let (left, right) = (left.max(strip.left()), right.min(strip.right()));
        // A box of a few points could not be grabbed.
        let more = ((MIN_OVERVIEW_BOX_POINTS - (right - left)) / 2.0).max(0.0);
        // A strip may be narrower than the box.
        let left = (left - more)
            .min(strip.right() - MIN_OVERVIEW_BOX_POINTS)
            .max(strip.left());
        Rect::from_x_y_ranges(
            left..=(right + more).max(left + MIN_OVERVIEW_BOX_POINTS),
            strip.y_range(),
        )
    }

    fn overview_x(&self, strip: Rect) -> impl Fn(f64) -> f32 + use<> {
        let whole_span = self.seen.shown.player.whole;
        let (start, length) = (
            whole_span.span_start_instant().instant_micros() as f64,
            whole_span.span_micros().max(1) as f64,
        );
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
            self.timeline.view.page_timeline_view(share, self.seen);
        }
    }

    fn overview_mouse(&mut self, ui: &Ui, response: &Response, strip: Rect) {
        let whole_span = self.seen.shown.player.whole;
        let bar = self.overview_box(strip);
        let (from, to) = (
            self.window.start,
            self.window.points_to_micros(self.timeline.view.width),
        );
        let near = |x: f32| {
            // At most a quarter of the box, so that its middle can always be grabbed.
            let edge = OVERVIEW_EDGE_REACH_POINTS.min(bar.width() / 4.0);
            if (x - bar.left()).abs() <= edge {
                Some(OverviewHold::Start(to))
            } else if (x - bar.right()).abs() <= edge {
                Some(OverviewHold::End(from))
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
        let pointed_micros =
            whole_span.span_start_instant().instant_micros() as f64 + whole_span.span_micros() as f64 * share;
        let pressed = ui.input(|input| input.pointer.press_origin());
        let hold = *self.timeline.overview.held.get_or_insert_with(|| {
            let origin = pressed.map_or(pointer.x, |position| position.x);
            // A click beside the box moves its middle there.
            let middle = || OverviewHold::Whole((to - from) / 2.0);
            match near(origin) {
                Some(edge) => edge,
                None if bar.x_range().contains(origin) => {
                    let share = f64::from((origin - strip.left()) / strip.width().max(1.0));
                    let origin = whole_span.span_start_instant().instant_micros() as f64
                        + whole_span.span_micros() as f64 * share;
                    OverviewHold::Whole(origin - from)
                }
                None => middle(),
            }
        });
        if !response.dragged() && !response.clicked() && !response.is_pointer_button_down_on() {
            return;
        }
        let width = self.timeline.view.width;
        let (start, end) = match hold {
            OverviewHold::Whole(before) => (pointed_micros - before, pointed_micros - before + (to - from)),
            // The box never turns over, nor gets shorter than ten milliseconds.
            OverviewHold::Start(end) => (pointed_micros.min(end - 1e4), end),
            OverviewHold::End(start) => (start, pointed_micros.max(start + 1e4)),
        };
        self.timeline.view.window = Some(TimeWindow::window_of_range(start, end, whole_span, width));
    }

    fn paint_overview(&mut self, ui: &Ui, scene: &TimelineScene<'_>, strip: Rect, response: &Response) {
        let width = strip.width().ceil().max(1.0) as usize;
        self.timeline.overview.update_annotation_density(scene, width);
        let overview = &self.timeline.overview;
        let (colours, painter) = (self.seen.pane_colours(), ui.painter_at(strip));
        painter.rect_filled(strip, 3.0, colours.stripe);
        let mut mesh = Mesh::default();
        let mut column = |x: usize, top: f32, colour: Color32| {
            let left = strip.left() + x as f32;
            let rect = Rect::from_min_max(pos2(left, top), pos2(left + 1.0, strip.bottom() - 4.0));
            mesh.add_colored_rect(rect, colour);
        };
        let weak = ui.visuals().weak_text_color();
        let room = strip.height() - 6.0;
        for (x, share) in overview.all.iter().enumerate().filter(|entry| *entry.1 > 0.0) {
            // A single annotation is visible beside a crowd.
            column(
                x,
                strip.bottom() - 4.0 - room * share.max(0.15),
                weak.gamma_multiply(0.6),
            );
        }
        painter.add(Shape::mesh(mesh));
        let mut tier_mesh = Mesh::default();
        for x in (0..overview.own.len()).filter(|x| overview.own[*x]) {
            let mark_position = pos2(strip.left() + x as f32, strip.bottom() - 3.0);
            tier_mesh.add_colored_rect(Rect::from_min_size(mark_position, vec2(1.0, 3.0)), colours.accent);
        }
        painter.add(Shape::mesh(tier_mesh));
        let x = self.overview_x(strip);
        if let Some(span) = self.seen.shown.span {
            let (from, to) = (
                span.span_start_instant().instant_micros() as f64,
                span.span_end_instant().instant_micros() as f64,
            );
            let area = Rect::from_x_y_ranges(x(from)..=x(to).max(x(from) + 1.5), strip.y_range());
            painter.rect_filled(area, 0.0, colours.selection.gamma_multiply(0.7));
        }
        let bar = self.overview_box(strip);
        let strong = response.hovered() || response.has_focus();
        let stroke = Stroke::new(if strong { 2.0 } else { 1.5 }, colours.accent);
        let light = ui.visuals().text_color().gamma_multiply(0.10);
        painter.rect(bar, 3.0, light, stroke, StrokeKind::Inside);
        let playhead_x = x(scene.scene_playhead_micros() as f64);
        painter.vline(playhead_x, strip.y_range(), Stroke::new(1.5, colours.playhead));
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
        let whole = TimeSpan::span_between(RecordingInstant::RECORDING_START, RecordingInstant::from_micros(1000));
        let of = |tiers: &[TierContents], width| annotation_density(tiers.iter(), whole, width);
        assert_eq!(of(&all.tiers, 10), [1, 1, 2, 0, 0, 0, 0, 0, 0, 1]);
        assert_eq!(of(&all.tiers[..1], 2), [2, 0]);
        // An annotation shorter than a column is shown too; one beyond the end is shown at the end.
        let odd = contents(&[(1, None, "", &[(1, 500, 501, None), (2, 5000, 6000, None)])]);
        assert_eq!(of(&odd.tiers, 4), [0, 0, 1, 1]);
        assert_eq!(of(&[], 0), [] as [u32; 0]);
    }
}
