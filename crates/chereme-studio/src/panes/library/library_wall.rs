//! The library as a wall: every recording or sign as a looping figure; only visible figures are drawn.

use std::collections::BTreeMap;

use chereme_corpus::SignGlance;
use chereme_motion::TimeSpan;
use eframe::egui::{
    Align2, Rect, Response, RichText, Role, ScrollArea, Sense, Stroke, StrokeKind, TextStyle, TextWrapMode, Ui, Vec2,
    WidgetInfo, WidgetText, pos2, vec2,
};

use super::library_data::SignMovement;
use super::{LibraryList, LibraryPane, row_id};
use crate::context::PaneInput;
use crate::miniatures::{self, MiniatureCell, MiniatureMotion};
use crate::panes::list_keys;

/// The least width of a figure, the gap between two, and the height of the text below one, in points.
const MIN_WALL_FIGURE_WIDTH: f32 = 124.0;
const WALL_FIGURE_GAP: f32 = 6.0;
const WALL_TEXT_HEIGHT: f32 = 36.0;
/// The greatest height of a figure, in points.
const MAX_WALL_FIGURE_HEIGHT: f32 = 200.0;

/// Returns the span of the first sign in each recording, which is a better figure than the recording's rest pose.
pub(super) fn first_signs(signs: &[SignGlance]) -> BTreeMap<i64, TimeSpan> {
    let mut first: BTreeMap<i64, TimeSpan> = BTreeMap::new();
    for (recording, span) in signs.iter().filter_map(|sign| sign.place) {
        let first_span = first.entry(recording).or_insert(span);
        if span.span_start_instant() < first_span.span_start_instant() {
            *first_span = span;
        }
    }
    first
}

/// Returns the number of figures in a row, and the size of each with its text.
fn wall_cell_layout(room: f32) -> (usize, Vec2) {
    let columns = ((room + WALL_FIGURE_GAP) / (MIN_WALL_FIGURE_WIDTH + WALL_FIGURE_GAP))
        .floor()
        .max(1.0);
    let width = (room + WALL_FIGURE_GAP) / columns - WALL_FIGURE_GAP;
    (
        columns as usize,
        vec2(width, width.min(MAX_WALL_FIGURE_HEIGHT) + WALL_TEXT_HEIGHT),
    )
}

impl LibraryPane {
    /// Shows the wall of recordings or signs.
    pub(super) fn show_library_wall(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, list: LibraryList) {
        let total = match list {
            LibraryList::Recordings => self.rows.recordings.len(),
            LibraryList::Signs => self.rows.signs.len(),
            // People have no pictures.
            LibraryList::People => return,
        };
        let (columns, size) = wall_cell_layout(ui.available_width() - 12.0);
        self.wall_keys(ui, columns, total);
        let step = size.y + WALL_FIGURE_GAP;
        let scroll_area = ScrollArea::vertical().auto_shrink(false).id_salt("wall");
        let area = match self.reach {
            Some(at) => {
                let high = ui.available_height();
                let offset = crate::panes::scrolled_to(at / columns, step, self.scrolled, high);
                scroll_area.vertical_scroll_offset(offset)
            }
            None => scroll_area,
        };
        ui.spacing_mut().item_spacing = Vec2::splat(WALL_FIGURE_GAP);
        let shown = area.show_rows(ui, size.y, total.div_ceil(columns), |ui, lines| {
            for line in lines {
                ui.horizontal(|ui| {
                    for at in line * columns..((line + 1) * columns).min(total) {
                        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
                        self.show_wall_cell(ui, seen, list, at, rect);
                    }
                });
            }
        });
        self.scrolled = shown.state.clamped_offset().y;
    }

    fn show_wall_cell(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, list: LibraryList, at: usize, rect: Rect) {
        let picture = rect.with_max_y(rect.bottom() - WALL_TEXT_HEIGHT);
        let visible = ui.is_rect_visible(rect);
        match list {
            LibraryList::Recordings => {
                let Some(row) = self.rows.recordings.get(at).cloned() else {
                    return;
                };
                let chosen = seen.shown.recording == Some(row.id);
                let response = draw_figure_frame(ui, seen, rect, at, chosen, &row.name, &row.about);
                self.focus_library_row(ui, &response, at);
                let span = self.rows.first.get(&row.id).copied().unwrap_or(row.whole);
                let motion = row.moves.then_some(MiniatureMotion::Span(row.id, span));
                show_looped_motion(ui, seen, motion, picture);
                self.on_recording(seen, &row, &response);
            }
            LibraryList::People => {}
            LibraryList::Signs => {
                let Some(row) = self.rows.signs.get(at).cloned() else {
                    return;
                };
                let chosen = self.chosen.as_ref().is_some_and(|chosen_sign| chosen_sign.id == row.id);
                let response = draw_figure_frame(ui, seen, rect, at, chosen, &row.gloss, &row.about);
                self.focus_library_row(ui, &response, at);
                let motion = match (row.moves, row.token) {
                    (SignMovement::Recorded(recording, span), _) => Some(MiniatureMotion::Span(recording, span)),
                    (SignMovement::Notated, Some(token)) if visible => self
                        .notated
                        .notated_clip(token, &row.gloss, seen.out)
                        .map(MiniatureMotion::Made),
                    _ => None,
                };
                show_looped_motion(ui, seen, motion.clone(), picture);
                self.on_sign(seen, &row, motion, &response);
            }
        }
    }

    /// Takes the arrow keys if a figure has the focus.
    fn wall_keys(&mut self, ui: &Ui, columns: usize, total: usize) {
        if total == 0 || ui.memory(|memory| memory.focused()) != Some(row_id(self.at)) {
            return;
        }
        if let Some(to) = list_keys::take_grid_keys(ui, self.at, total, columns, 6) {
            self.at = to;
            self.reach = Some(self.at);
        }
    }
}

/// Draws the background, the text and the state of a figure; the picture is painted over it.
fn draw_figure_frame(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    rect: Rect,
    at: usize,
    chosen: bool,
    name: &str,
    about: &str,
) -> Response {
    let response = ui.interact(rect, row_id(at), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, name));
    if !ui.is_rect_visible(rect) {
        return response;
    }
    let colours = seen.pane_colours();
    let picture = rect.with_max_y(rect.bottom() - WALL_TEXT_HEIGHT);
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    painter.rect_filled(picture, 6.0, ui.visuals().extreme_bg_color);
    let put = |text: &str, style: TextStyle, weak: bool, y: f32| {
        let colour = if weak {
            ui.visuals().weak_text_color()
        } else {
            ui.visuals().text_color()
        };
        let text = RichText::new(text).color(colour);
        let cut = Some(TextWrapMode::Truncate);
        let galley = WidgetText::from(text).into_galley(ui, cut, rect.width() - 8.0, style);
        let text_position = pos2(rect.left() + 4.0, y);
        painter.galley(
            Align2::LEFT_CENTER.anchor_size(text_position, galley.size()).min,
            galley,
            colour,
        );
    };
    put(name, TextStyle::Body, false, picture.bottom() + 10.0);
    put(about, TextStyle::Small, true, picture.bottom() + 26.0);
    let stroke = if response.has_focus() || chosen {
        Stroke::new(2.0, colours.accent)
    } else if response.hovered() {
        Stroke::new(1.5, colours.accent)
    } else {
        Stroke::new(1.0, colours.rule)
    };
    ui.painter()
        .rect_stroke(picture.expand(1.0), 6.0, stroke, StrokeKind::Inside);
    response
}

/// Shows movement in a loop.
fn show_looped_motion(ui: &Ui, seen: &PaneInput<'_>, motion: Option<MiniatureMotion>, rect: Rect) {
    let rect = rect.shrink(1.5);
    match motion {
        Some(motion) => {
            let cell = MiniatureCell::new(motion, rect.size()).with_playing_clock(miniatures::figure_loop_clock(ui));
            seen.little.paint_figure(ui, seen.language, seen.out, &cell, rect);
        }
        None => miniatures::paint_still_placeholder(ui, seen.language, rect),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_fill_the_width_and_are_large_enough() {
        for room in [130.0, 300.0, 330.0, 660.0, 1200.0] {
            let (columns, size) = wall_cell_layout(room);
            assert!(size.x >= MIN_WALL_FIGURE_WIDTH, "{room}: {size:?}");
            let whole = columns as f32 * (size.x + WALL_FIGURE_GAP) - WALL_FIGURE_GAP;
            assert!((whole - room).abs() < 0.1, "{room}: {whole}");
        }
    }

    #[test]
    fn a_recording_is_shown_by_its_first_sign() {
        let span = |start, end| TimeSpan::from_span_micros(start, end);
        let sign = |gloss: &str, place| SignGlance {
            gloss: gloss.into(),
            place,
            ..SignGlance::default()
        };
        let signs = [
            sign("B", Some((7, span(50, 60)))),
            sign("A", Some((7, span(10, 20)))),
            sign("C", None),
        ];
        let first = first_signs(&signs);
        assert_eq!(first.get(&7), Some(&span(10, 20)));
        assert_eq!(first.len(), 1);
    }
}
