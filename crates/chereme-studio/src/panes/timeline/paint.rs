//! The parts of the timeline that are painted: ruler, bars, selection, playhead.

use chereme_corpus::{TierContents, ValueState};
use chereme_motion::Span;
use eframe::egui::{Align2, FontId, Painter, Pos2, Rect, Rgba, Stroke, StrokeKind, pos2, vec2};

use super::data::{self, Bar, Window};
use crate::context::Seen;
use crate::words::timeline as words;

/// Narrower bars hold no text.
const TEXT: f32 = 14.0;

/// Paints the ruler into `rect`.
pub(super) fn ruler(
    painter: &Painter,
    rect: Rect,
    window: &Window,
    seen: &Seen<'_>,
    font: &FontId,
) {
    let colours = seen.colours();
    let text = painter.ctx().global_style().visuals.weak_text_color();
    for tick in data::ticks(window, rect.width()) {
        let x = rect.left() + window.x(tick.micros as f64);
        let height = if tick.text.is_some() { 8.0 } else { 4.0 };
        let points = [pos2(x, rect.bottom() - height), pos2(x, rect.bottom())];
        painter.line_segment(points, Stroke::new(1.0, colours.rule));
        if let Some(label) = tick.text {
            painter.text(
                pos2(x + 3.0, rect.top()),
                Align2::LEFT_TOP,
                label,
                font.clone(),
                text,
            );
        }
    }
}

/// Returns where a bar is in the row `row`.
pub(super) fn bar_rect(row: Rect, window: &Window, bar: &Bar) -> Rect {
    let left = row.left() + window.x(bar.start as f64);
    let right = (row.left() + window.x(bar.end as f64)).max(left + 1.5);
    let rect = Rect::from_x_y_ranges(left..=right, row.top() + 2.0..=row.bottom() - 2.0);
    rect.intersect(row.expand2(vec2(8.0, 0.0)))
}

/// Returns what a bar says.
pub(super) fn bar_text(tier: &TierContents, bar: &Bar, seen: &Seen<'_>) -> String {
    if bar.count > 1 {
        return format!("×{}", bar.count);
    }
    let missing = |state| match state {
        ValueState::NotApplicable => seen.say(words::NOT_APPLICABLE),
        ValueState::Unclear => seen.say(words::UNCLEAR),
        _ => "",
    };
    data::value_text(&tier.annotations, bar.at, missing).to_owned()
}

/// Paints a bar into `rect`.
pub(super) fn bar(
    painter: &Painter,
    rect: Rect,
    (tier, bar): (&TierContents, &Bar),
    seen: &Seen<'_>,
    font: &FontId,
) {
    let colours = seen.colours();
    let id = tier.annotations.ids[bar.at];
    let chosen = bar.count == 1 && seen.shown.annotations.contains(&id);
    let missing = bar.count == 1 && tier.annotations.states[bar.at] != ValueState::Value;
    let colour = colours.role(&tier.row.role);
    let fill = if missing {
        colour.gamma_multiply(0.35)
    } else {
        colour
    };
    let (width, edge) = if chosen {
        (2.5, colours.playhead)
    } else {
        (1.0, darker(colour))
    };
    if rect.width() < 4.0 && !chosen {
        painter.rect_filled(rect, 0.0, fill);
        return;
    }
    painter.rect(
        rect,
        3.0,
        fill,
        Stroke::new(width, edge),
        StrokeKind::Inside,
    );
    let text = bar_text(tier, bar, seen);
    if rect.width() >= TEXT && !text.is_empty() {
        let ink = if missing {
            painter.ctx().global_style().visuals.text_color()
        } else {
            colours.on_annotation
        };
        let clip = rect.shrink2(vec2(2.0, 0.0)).intersect(painter.clip_rect());
        let at: Pos2 = pos2(
            rect.left().max(painter.clip_rect().left()) + 4.0,
            rect.center().y,
        );
        let painter = painter.with_clip_rect(clip);
        painter.text(at, Align2::LEFT_CENTER, text, font.clone(), ink);
    }
}

fn darker(colour: eframe::egui::Color32) -> eframe::egui::Color32 {
    (Rgba::from(colour) * 0.55).into()
}

/// Paints the selected time over `rect`.
pub(super) fn selection(
    painter: &Painter,
    rect: Rect,
    window: &Window,
    span: Span,
    seen: &Seen<'_>,
) {
    let x = |micros: i64| rect.left() + window.x(micros as f64);
    let (left, right) = (x(span.start().micros()), x(span.end().micros()));
    let area = Rect::from_x_y_ranges(left..=right, rect.y_range());
    let colour = seen.colours().selection;
    painter.rect_filled(area, 0.0, colour.gamma_multiply(0.55));
    for side in [left, right] {
        painter.vline(
            side,
            rect.y_range(),
            Stroke::new(1.0, seen.colours().accent),
        );
    }
}

/// Paints the playhead over `rect`.
pub(super) fn playhead(painter: &Painter, rect: Rect, window: &Window, seen: &Seen<'_>) {
    let x = rect.left() + window.x(seen.shown.player.playhead().micros() as f64);
    let colour = seen.colours().playhead;
    painter.vline(x, rect.y_range(), Stroke::new(1.5, colour));
    let top = rect.top();
    let head = vec![pos2(x - 5.0, top), pos2(x + 5.0, top), pos2(x, top + 7.0)];
    painter.add(eframe::egui::Shape::convex_polygon(
        head,
        colour,
        Stroke::NONE,
    ));
}
