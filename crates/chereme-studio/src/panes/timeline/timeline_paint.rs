//! Painting of the timeline: ruler, bars, selection, playhead.

use chereme_corpus::snap::SnapTarget;
use chereme_corpus::{TierContents, ValueState, is_detector_tier};
use chereme_motion::{RecordingInstant, TimeSpan};
use eframe::egui::text::{LayoutJob, TextWrapping};
use eframe::egui::{
    Align2, Color32, FontId, Painter, Pos2, Rect, Response, Rgba, Shape, Stroke, StrokeKind, Ui, pos2, vec2,
};

use super::drag::GestureSight;
use super::timeline_data;
use super::timeline_data::AnnotationBar;
use crate::context::PaneInput;
use crate::model::time_window::TimeWindow;
use crate::pickers::pickers_data as pickers;
use crate::words::{InterfaceLanguage, timeline as words};

/// The least width of a bar with text, in points.
const TEXT_BAR_WIDTH_POINTS: f32 = 14.0;

/// Paints the ruler into `rect`.
pub(super) fn paint_time_ruler(
    painter: &Painter,
    rect: Rect,
    window: &TimeWindow,
    seen: &PaneInput<'_>,
    font: &FontId,
) {
    let colours = seen.pane_colours();
    let text = painter.ctx().global_style().visuals.weak_text_color();
    for tick in timeline_data::ruler_ticks(window, rect.width()) {
        let x = rect.left() + window.time_to_points(tick.micros as f64);
        let height = if tick.text.is_some() { 8.0 } else { 4.0 };
        let points = [pos2(x, rect.bottom() - height), pos2(x, rect.bottom())];
        painter.line_segment(points, Stroke::new(1.0, colours.rule));
        if let Some(label) = tick.text {
            painter.text(pos2(x + 3.0, rect.top()), Align2::LEFT_TOP, label, font.clone(), text);
        }
    }
}

/// Returns the rectangle of a bar in the row `row`.
pub(super) fn bar_rect(row: Rect, window: &TimeWindow, bar: &AnnotationBar) -> Rect {
    let left = row.left() + window.time_to_points(bar.start as f64);
    // An annotation of no length is a thin line.
    let right = (row.left() + window.time_to_points(bar.end as f64)).max(left + 1.5);
    let rect = Rect::from_x_y_ranges(left..=right, row.top() + 2.0..=row.bottom() - 2.0);
    // Long annotations reach far beyond the window, which painting does not need.
    rect.intersect(row.expand2(vec2(8.0, 0.0)))
}

/// Returns the text on a bar.
pub(super) fn bar_text(tier: &TierContents, bar: &AnnotationBar, seen: &PaneInput<'_>) -> String {
    if bar.count > 1 {
        return format!("×{}", bar.count);
    }
    let missing = |state| match state {
        ValueState::NotApplicable => seen.say_text(words::NOT_APPLICABLE),
        ValueState::Unclear => seen.say_text(words::UNCLEAR),
        _ => "",
    };
    let text = timeline_data::value_text(&tier.annotations, bar.at, missing);
    if seen.language == InterfaceLanguage::English {
        return text.to_owned();
    }
    let mut all = seen.snapshot.overview.inventories.iter();
    let stored = all.find(|stored| Some(stored.id) == tier.row.inventory_id);
    let value = stored.and_then(|stored| stored.inventory.value_by_id(text));
    value
        .map_or(text, |value| pickers::short_name(value, seen.language))
        .to_owned()
}

/// Paints a bar into `rect`, faintly while it is dragged.
pub(super) fn paint_annotation_bar(
    painter: &Painter,
    rect: Rect,
    tier: &TierContents,
    bar: &AnnotationBar,
    seen: &PaneInput<'_>,
    font: &FontId,
    faint: bool,
) {
    let colours = seen.pane_colours();
    let id = tier.annotations.ids[bar.at];
    let chosen = bar.count == 1 && seen.shown.annotations.contains(&id);
    let missing = bar.count == 1 && tier.annotations.states[bar.at] != ValueState::Value;
    let proposed = is_detector_tier(&tier.row.name);
    let colour = colours.tier_role_colour(&tier.row.role);
    let (fill, ink) = match (faint, chosen) {
        (true, _) => (colour.gamma_multiply(0.15), colours.on_annotation),
        (_, true) => (colours.chosen, colours.on_chosen),
        _ if missing || proposed => (
            colour.gamma_multiply(0.35),
            painter.ctx().global_style().visuals.text_color(),
        ),
        _ => (colour, colours.on_annotation),
    };
    let (width, edge) = match (faint, chosen) {
        (true, _) => (1.0, colours.rule),
        (_, true) => (2.5, colours.playhead),
        _ => (1.0, darker(colour)),
    };
    // Edges would fill a bar of this width.
    if rect.width() < 4.0 && !chosen {
        painter.rect_filled(rect, 0.0, fill);
        return;
    }
    painter.rect(rect, 3.0, fill, Stroke::new(width, edge), StrokeKind::Inside);
    if proposed && !faint {
        hatch_proposal(painter, rect, edge.gamma_multiply(0.55));
    }
    if chosen && !faint && rect.width() > 16.0 {
        grips(painter, rect, edge);
    }
    let text = bar_text(tier, bar, seen);
    if rect.width() >= TEXT_BAR_WIDTH_POINTS && !text.is_empty() && !faint {
        paint_bar_text(painter, rect, text, font, ink);
    }
}

/// Paints text into a bar, at its start or at the edge of the view; text without room ends in an ellipsis.
fn paint_bar_text(painter: &Painter, rect: Rect, text: String, font: &FontId, ink: Color32) {
    let room = rect.shrink2(vec2(2.0, 0.0)).intersect(painter.clip_rect());
    let left = rect.left().max(painter.clip_rect().left()) + 5.0;
    let mut job = LayoutJob::simple_singleline(text, font.clone(), ink);
    job.wrap = TextWrapping::truncate_at_width((room.right() - left).max(0.0));
    let galley = painter.layout_job(job);
    let text_position = pos2(left, rect.center().y - galley.size().y / 2.0);
    // Clipped text is cut and drawn separately.
    if left + galley.size().x <= room.right() {
        painter.galley(text_position, galley, ink);
    } else {
        painter.with_clip_rect(room).galley(text_position, galley, ink);
    }
}

/// Paints slanting lines over proposals that nobody has accepted yet.
pub(crate) fn hatch_proposal(painter: &Painter, rect: Rect, colour: Color32) {
    const HATCH_STEP_POINTS: f32 = 7.0;
    let seen = rect.shrink(1.0).intersect(painter.clip_rect());
    if !seen.is_positive() {
        return;
    }
    let painter = painter.with_clip_rect(seen);
    let high = rect.height();
    let first = ((seen.left() - high - rect.left()) / HATCH_STEP_POINTS)
        .floor()
        .max(-high / HATCH_STEP_POINTS) as i32;
    let last = ((seen.right() - rect.left()) / HATCH_STEP_POINTS).ceil() as i32;
    for line in first..=last {
        let x = rect.left() + line as f32 * HATCH_STEP_POINTS;
        let ends = [pos2(x, rect.bottom()), pos2(x + high, rect.top())];
        painter.line_segment(ends, Stroke::new(1.0, colour));
    }
}

/// Paints handles on the edges of a selected annotation.
fn grips(painter: &Painter, rect: Rect, colour: Color32) {
    for side in [rect.left() + 1.5, rect.right() - 4.5] {
        let grip = Rect::from_x_y_ranges(side..=side + 3.0, rect.top() + 5.0..=rect.bottom() - 5.0);
        painter.rect_filled(grip, 1.5, colour);
    }
}

/// Paints a frame around the annotation with the keyboard focus.
pub(super) fn paint_annotation_focus(painter: &Painter, rect: Rect, seen: &PaneInput<'_>) {
    let stroke = Stroke::new(2.0, seen.pane_colours().accent);
    painter.rect_stroke(rect.expand(1.0), 3.0, stroke, StrokeKind::Outside);
}

/// An annotation at its future place: its times in microseconds, its tier, its value, and whether it is refused there.
pub(super) struct PaintedGhost<'a> {
    pub(super) start: i64,
    pub(super) end: i64,
    pub(super) tier: &'a TierContents,
    pub(super) text: String,
    pub(super) refused: bool,
}

/// Paints an annotation at its future place in the row `row`.
pub(super) fn paint_ghost_annotation(
    painter: &Painter,
    row: Rect,
    window: &TimeWindow,
    ghost: PaintedGhost<'_>,
    seen: &PaneInput<'_>,
    font: &FontId,
) {
    let PaintedGhost {
        start,
        end,
        tier,
        text,
        refused,
    } = ghost;
    let bar = AnnotationBar {
        at: 0,
        count: 1,
        start,
        end,
    };
    let rect = bar_rect(row, window, &bar);
    let colours = seen.pane_colours();
    let (fill, edge) = if refused {
        (colours.trouble.gamma_multiply(0.25), colours.trouble)
    } else {
        (
            colours.tier_role_colour(&tier.row.role).gamma_multiply(0.8),
            colours.playhead,
        )
    };
    painter.rect(rect, 3.0, fill, Stroke::new(2.0, edge), StrokeKind::Inside);
    if rect.width() >= TEXT_BAR_WIDTH_POINTS && !text.is_empty() {
        paint_bar_text(painter, rect, text, font, colours.on_annotation);
    }
}

/// Paints the frame of a selection, the snapping line, and the times of a drag.
pub(super) fn paint_gesture_sight(
    painter: &Painter,
    lane: Rect,
    window: &TimeWindow,
    sight: &GestureSight,
    at: Option<Pos2>,
    seen: &PaneInput<'_>,
) {
    let colours = seen.pane_colours();
    if let Some(band) = sight.band {
        let fill = colours.selection.gamma_multiply(0.35);
        painter.rect(band, 0.0, fill, Stroke::new(1.0, colours.accent), StrokeKind::Inside);
    }
    if let Some((time, catch)) = sight.caught.filter(|(_, catch)| *catch != SnapTarget::Frame) {
        let x = lane.left() + window.time_to_points(time as f64);
        let colour = if catch == SnapTarget::Minimum {
            colours.good
        } else {
            colours.accent
        };
        let line = [pos2(x, lane.top()), pos2(x, lane.bottom())];
        let dashes = Shape::dashed_line(&line, Stroke::new(1.5, colour), 5.0, 3.0);
        painter.extend(dashes);
    }
    if let (Some((start, end)), Some(at)) = (sight.times, at) {
        paint_drag_times(painter, lane, start, end, at, seen);
    }
}

/// Paints start, end and duration of a drag above the pointer.
fn paint_drag_times(painter: &Painter, lane: Rect, start: i64, end: i64, at: Pos2, seen: &PaneInput<'_>) {
    let visuals = painter.ctx().global_style().visuals.clone();
    let time = |micros| timeline_data::time_text(RecordingInstant::from_micros(micros));
    let text = format!(
        "{} – {}  ·  {}",
        time(start),
        time(end),
        timeline_data::length_text(end - start)
    );
    let font = FontId::proportional(12.5);
    let galley = painter.layout_no_wrap(text, font, visuals.text_color());
    let size = galley.size() + vec2(12.0, 6.0);
    let most = (lane.right() - size.x).max(lane.left());
    let left = (at.x + 12.0).clamp(lane.left(), most);
    let above = at.y - size.y - 14.0;
    let top = if above < lane.top() { at.y + 20.0 } else { above };
    let rect = Rect::from_min_size(pos2(left, top), size);
    painter.rect(
        rect,
        4.0,
        visuals.window_fill,
        Stroke::new(1.0, seen.pane_colours().rule),
        StrokeKind::Outside,
    );
    painter.galley(rect.min + vec2(6.0, 3.0), galley, visuals.text_color());
}

/// Paints the fold mark of a tier with children.
pub(super) fn paint_fold_mark(ui: &Ui, rect: Rect, folded: bool, response: &Response) {
    let colour = ui.style().interact(response).fg_stroke.color;
    let (centre, r) = (rect.center(), 3.5);
    let offsets = if folded {
        vec![vec2(-r * 0.7, -r), vec2(r, 0.0), vec2(-r * 0.7, r)]
    } else {
        vec![vec2(-r, -r * 0.7), vec2(r, -r * 0.7), vec2(0.0, r)]
    };
    let points = offsets.into_iter().map(|by| centre + by).collect();
    ui.painter().add(Shape::convex_polygon(points, colour, Stroke::NONE));
}

fn darker(colour: Color32) -> Color32 {
    (Rgba::from(colour) * 0.55).into()
}

/// Paints the selected time over `rect`.
pub(super) fn paint_time_selection(
    painter: &Painter,
    rect: Rect,
    window: &TimeWindow,
    span: TimeSpan,
    seen: &PaneInput<'_>,
) {
    let x = |micros: i64| rect.left() + window.time_to_points(micros as f64);
    let (left, right) = (
        x(span.span_start_instant().instant_micros()),
        x(span.span_end_instant().instant_micros()),
    );
    let area = Rect::from_x_y_ranges(left..=right, rect.y_range());
    let colour = seen.pane_colours().selection;
    painter.rect_filled(area, 0.0, colour.gamma_multiply(0.55));
    for side in [left, right] {
        painter.vline(side, rect.y_range(), Stroke::new(1.0, seen.pane_colours().accent));
    }
}

/// Paints the playhead over `rect`.
pub(super) fn paint_timeline_playhead(painter: &Painter, rect: Rect, window: &TimeWindow, seen: &PaneInput<'_>) {
    let x = rect.left() + window.time_to_points(seen.shown.player.player_playhead().instant_micros() as f64);
    let colour = seen.pane_colours().playhead;
    painter.vline(x, rect.y_range(), Stroke::new(1.5, colour));
    let top = rect.top();
    let head = vec![pos2(x - 5.0, top), pos2(x + 5.0, top), pos2(x, top + 7.0)];
    painter.add(Shape::convex_polygon(head, colour, Stroke::NONE));
}
