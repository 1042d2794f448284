//! The table of measured signs: titles that sort, rows that open signs.

use chereme_corpus::{MeasuredSign, SignMeasures};
use eframe::egui::{
    Align2, FontId, Id, Rect, Response, RichText, Role, ScrollArea, Sense, Stroke, StrokeKind, TextStyle, TextWrapMode,
    Ui, WidgetInfo, WidgetText, pos2, vec2,
};

use super::MeasuresPane;
use super::measures_table::MeasureColumn;
use crate::context::PaneInput;
use crate::panes::search::facet_name;
use crate::panes::{list_keys, scrolled_to};
use crate::words::{fill_text_braces, measures_words as words, search_words};

/// The height of a row, in points.
const MEASURE_ROW_HEIGHT_POINTS: f32 = 22.0;
/// The least width of the table, in points; a narrower pane scrolls it to the side.
const MIN_TABLE_WIDTH_POINTS: f32 = 600.0;
/// The room of the bar that scrolls, in points.
const SCROLL_BAR_ROOM_POINTS: f32 = 12.0;

fn row_id(at: usize) -> Id {
    Id::unique("measured sign").with(at)
}

impl MeasuresPane {
    /// Shows the table.
    pub(super) fn show_measure_table(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, found: &SignMeasures) {
        ScrollArea::horizontal().id_salt("measure columns").show(ui, |ui| {
            let width = (ui.available_width() - SCROLL_BAR_ROOM_POINTS).max(MIN_TABLE_WIDTH_POINTS);
            ui.set_min_width(width + SCROLL_BAR_ROOM_POINTS);
            self.show_column_titles(ui, seen, width);
            self.show_sign_rows(ui, seen, found, width);
        });
    }

    fn show_column_titles(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, width: f32) {
        let (line, _) = ui.allocate_exact_size(vec2(width, MEASURE_ROW_HEIGHT_POINTS), Sense::hover());
        for ((column, title, _), place) in MeasureColumn::ALL_MEASURE_COLUMNS.into_iter().zip(column_rects(line)) {
            let is_chosen = self.order.column == column;
            let key = ui.scope_id().with(("measure column", column as usize));
            let response = ui.interact(place, key, Sense::click());
            let title = seen.say_text(title);
            let name = fill_text_braces(seen.say_text(search_words::SORT), &[("column", &title)]);
            response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_chosen, &name));
            let text = match (is_chosen, self.order.descending) {
                (false, _) => title.to_owned(),
                (true, true) => format!("{title} ↓"),
                (true, false) => format!("{title} ↑"),
            };
            let colour = match is_chosen {
                true => seen.pane_colours().accent,
                false => ui.visuals().weak_text_color(),
            };
            let font = TextStyle::Small.resolve(ui.style());
            paint_cell(ui, place, RichText::new(text).color(colour), font, column);
            if response.has_focus() {
                let stroke = Stroke::new(1.5, seen.pane_colours().accent);
                ui.painter().rect_stroke(place, 3.0, stroke, StrokeKind::Inside);
            }
            if response.on_hover_text(name).clicked() {
                self.order = self.order.order_after_press(column);
                self.sort_rows();
            }
        }
    }

    fn show_sign_rows(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, found: &SignMeasures, width: f32) {
        let rows = std::mem::take(&mut self.rows);
        let is_focused = ui.memory(|memory| memory.focused()) == Some(row_id(self.at));
        if is_focused && let Some(to) = list_keys::take_list_keys(ui, self.at, rows.len()) {
            (self.at, self.reach) = (to, Some(to));
        }
        ui.spacing_mut().item_spacing.y = 0.0;
        let mut area = ScrollArea::vertical().id_salt("measured signs").auto_shrink(false);
        if let Some(at) = self.reach {
            let room = ui.available_height();
            area = area.vertical_scroll_offset(scrolled_to(at, MEASURE_ROW_HEIGHT_POINTS, self.scrolled, room));
        }
        let shown = area.show_rows(ui, MEASURE_ROW_HEIGHT_POINTS, rows.len(), |ui, range| {
            for at in range {
                let (rect, _) = ui.allocate_exact_size(vec2(width, MEASURE_ROW_HEIGHT_POINTS), Sense::hover());
                let sign = &found.signs[rows[at]];
                if self.show_sign_row(ui, seen, rect, at, sign).clicked() {
                    self.at = at;
                    self.notated.choose_citation_sign(seen, sign.token);
                }
            }
        });
        self.scrolled = shown.state.clamped_offset().y;
        self.rows = rows;
    }

    fn show_sign_row(&mut self, ui: &Ui, seen: &PaneInput<'_>, rect: Rect, at: usize, sign: &MeasuredSign) -> Response {
        if at % 2 == 1 {
            ui.painter().rect_filled(rect, 0.0, seen.pane_colours().stripe);
        }
        let response = ui.interact(rect, row_id(at), Sense::click());
        let name = fill_text_braces(
            seen.say_text(words::ROW),
            &[("gloss", &sign.gloss), ("n", &sign.density)],
        );
        let is_chosen = self.at == at;
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_chosen, &name));
        if self.reach == Some(at) {
            self.reach = None;
            response.request_focus();
        }
        if response.has_focus() {
            self.at = at;
            list_keys::keep_arrow_keys(ui, row_id(at), false);
        }
        let font = TextStyle::Body.resolve(ui.style());
        for ((column, ..), place) in MeasureColumn::ALL_MEASURE_COLUMNS.into_iter().zip(column_rects(rect)) {
            let text = RichText::new(column.measure_cell_text(sign)).color(ui.visuals().text_color());
            paint_cell(ui, place, text, font.clone(), column);
        }
        if response.has_focus() || response.hovered() {
            let stroke = Stroke::new(1.0, seen.pane_colours().accent);
            ui.painter().rect_stroke(rect, 3.0, stroke, StrokeKind::Inside);
        }
        match sign_tip(sign, seen) {
            tip if tip.is_empty() => response,
            tip => response.on_hover_text(tip),
        }
    }
}

/// Returns what the numbers of a sign consist of: its minimal pairs by field, its homonyms, its family.
fn sign_tip(sign: &MeasuredSign, seen: &PaneInput<'_>) -> String {
    let filled = |text, name, value: String| {
        let shown = fill_text_braces(seen.say_text(text), &[(name, &value)]);
        (!value.is_empty()).then_some(shown)
    };
    let by_field = sign.pairs_by_field.iter().filter(|(_, count)| **count > 0);
    let pairs: Vec<String> = by_field
        .map(|(field, count)| format!("{} {count}", facet_name(field, seen)))
        .collect();
    let lines = [
        filled(words::PAIRS_TIP, "pairs", pairs.join(", ")),
        filled(words::HOMONYMS_TIP, "glosses", sign.homonyms.join(", ")),
        filled(words::FAMILY_TIP, "gloss", sign.family.clone().unwrap_or_default()),
    ];
    lines.into_iter().flatten().collect::<Vec<String>>().join("\n")
}

/// Returns the places of the columns in a row.
fn column_rects(row: Rect) -> impl Iterator<Item = Rect> {
    let mut left = row.left();
    MeasureColumn::ALL_MEASURE_COLUMNS
        .into_iter()
        .map(move |(_, _, share)| {
            let place = Rect::from_min_size(pos2(left, row.top()), vec2(row.width() * share, row.height()));
            left = place.right();
            place
        })
}

/// Paints a text into a cell: glosses at its left, numbers at its right, below each other.
fn paint_cell(ui: &Ui, place: Rect, text: RichText, font: FontId, column: MeasureColumn) {
    let inside = place.shrink2(vec2(3.0, 0.0));
    let colour = ui.visuals().text_color();
    let galley = WidgetText::from(text).into_galley(ui, Some(TextWrapMode::Truncate), inside.width(), font);
    let (align, at) = match column {
        MeasureColumn::Gloss => (Align2::LEFT_CENTER, inside.left_center()),
        _ => (Align2::RIGHT_CENTER, inside.right_center()),
    };
    let text_rect = align.anchor_size(at, galley.size());
    ui.painter().galley(text_rect.min, galley, colour);
}
