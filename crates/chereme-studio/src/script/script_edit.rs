//! Editing of right-to-left text: it is displayed in its visual order, and the cursor follows it.
//!
//! The text itself stays in reading order.

use std::sync::Arc;

use chereme_figure::letters::any_from_right;
use eframe::egui::epaint::text::{PlacedRow, Row};
use eframe::egui::text::{CCursor, CCursorRange, CharIndex, LayoutJob};
use eframe::egui::text_edit::TextEditOutput;
use eframe::egui::{Color32, FontId, Galley, Pos2, Stroke, TextBuffer, TextEdit, TextStyle, Ui, pos2};

use super::visual::{self, VisualPiece};
use crate::theme::{self, ThemeColours};

/// A row height that marks a layout whose letters are in visual order already; it has no effect of its own.
const IN_ORDER: f32 = f32::MIN_POSITIVE;

/// Returns whether a text was laid out by this module.
pub(super) fn is_in_order(galley: &Galley) -> bool {
    galley.job.first_row_min_height == IN_ORDER
}

/// Draws a single-line text field; `more` sets its appearance.
pub(crate) fn draw_text_line(
    ui: &mut Ui,
    text: &mut String,
    more: impl for<'a> FnOnce(TextEdit<'a>) -> TextEdit<'a>,
) -> TextEditOutput {
    let mut layouter = |ui: &Ui, text: &dyn TextBuffer, _wrap: f32| {
        let (font, colour) = default_font_and_colour(ui);
        let job = LayoutJob::simple_singleline(text.as_str().to_owned(), font, colour);
        lay_out_edited_text(ui, job)
    };
    let field = more(TextEdit::singleline(text).layouter(&mut layouter));
    let mut edit = draw_with_text_edge(ui, |ui| field.show(ui));
    settle_text_cursor(ui, &mut edit);
    edit
}

/// Draws a multi-line text field; `more` sets its appearance.
pub(crate) fn draw_text_block(
    ui: &mut Ui,
    text: &mut String,
    more: impl for<'a> FnOnce(TextEdit<'a>) -> TextEdit<'a>,
) -> TextEditOutput {
    let mut layouter = |ui: &Ui, text: &dyn TextBuffer, wrap: f32| {
        let (font, colour) = default_font_and_colour(ui);
        let job = LayoutJob::simple(text.as_str().to_owned(), font, colour, wrap);
        lay_out_edited_text(ui, job)
    };
    let field = more(TextEdit::multiline(text).layouter(&mut layouter));
    let mut edit = draw_with_text_edge(ui, |ui| field.show(ui));
    settle_text_cursor(ui, &mut edit);
    edit
}

/// Draws fields for text with an edge, without which they are hardly visible in light panes.
pub(crate) fn draw_with_text_edge<R>(ui: &mut Ui, show: impl FnOnce(&mut Ui) -> R) -> R {
    let edge = ThemeColours::colours_for_theme(theme::is_dark(ui.ctx())).field_edge;
    let before = ui.visuals().widgets.inactive.bg_stroke;
    ui.visuals_mut().widgets.inactive.bg_stroke = Stroke::new(1.0, edge);
    let shown = show(ui);
    ui.visuals_mut().widgets.inactive.bg_stroke = before;
    shown
}

fn default_font_and_colour(ui: &Ui) -> (FontId, Color32) {
    let font = TextStyle::Body.resolve(ui.style());
    (font, ui.visuals().widgets.inactive.text_color())
}

/// Lays out edited text in visual order, with one glyph for each character.
pub(crate) fn lay_out_edited_text(ui: &Ui, job: LayoutJob) -> Arc<Galley> {
    let plain = ui.fonts_mut(|fonts| fonts.layout_job(job.clone()));
    if !any_from_right(&job.text) {
        return plain;
    }
    let (drawn, lines) = visual::in_order_by_line(ui.ctx(), &plain);
    if drawn.rows.len() != lines.len() {
        return plain;
    }
    let mut galley = Galley::clone(&drawn);
    let starts: Vec<usize> = lines.iter().skip(1).map(|range| range.start).collect();
    for (nth, (placed, range)) in galley.rows.iter_mut().zip(lines).enumerate() {
        // A line break for lack of room has no character.
        placed.ends_with_newline = starts.get(nth).is_some_and(|next| *next > range.end);
        let Some(line) = job.text.get(range) else {
            return plain;
        };
        if any_from_right(line) {
            place_row_glyphs(ui, &job, line, Arc::make_mut(&mut placed.row));
        }
    }
    galley.job = Arc::new(LayoutJob {
        first_row_min_height: IN_ORDER,
        ..job
    });
    Arc::new(galley)
}

/// Gives a row one glyph for each character of its line, at the position of the cursor before that character.
fn place_row_glyphs(ui: &Ui, job: &LayoutJob, line: &str, row: &mut Row) {
    let pieces = visual::visual_line_pieces(line, &|_| usize::MAX);
    let (places, end) = cursor_positions(ui, job, line, &pieces);
    let Some(glyph) = row.glyphs.first().copied() else {
        return;
    };
    let after = row.visuals.glyph_vertex_range.end as u32;
    row.glyphs = line
        .chars()
        .zip(&places)
        .map(|(chr, [x, width])| {
            let mut glyph = glyph;
            (glyph.chr, glyph.pos) = (chr, pos2(*x, glyph.pos.y));
            (glyph.advance_width, glyph.first_vertex) = (*width, after);
            glyph
        })
        .collect();
    // egui places the cursor after the last letter at the end of the row.
    row.size.x = end;
}

/// Returns for each character the position of the cursor before it, and its width if it is read from the left (else 0);
/// and the position of the cursor after all of them.
fn cursor_positions(ui: &Ui, job: &LayoutJob, line: &str, pieces: &[VisualPiece]) -> (Vec<[f32; 2]>, f32) {
    let look = job
        .sections
        .first()
        .map(|section| section.format.clone())
        .unwrap_or_default();
    let wide = |text: &str| {
        let (font, colour) = (look.font_id.clone(), look.color);
        ui.fonts_mut(|fonts| fonts.layout_no_wrap(text.to_owned(), font, colour).size().x)
    };
    let mut places: Vec<(usize, [f32; 2])> = Vec::new();
    let (mut left, mut end) = (0.0, (0, 0.0));
    for piece in pieces {
        let part = &line[piece.range.clone()];
        let width = wide(&piece.text);
        let mut before = 0.0;
        for (at, letter) in part.char_indices() {
            let end = at + letter.len_utf8();
            let width_after = match piece.from_right && end < part.len() {
                // A letter looks different at the end than before another: the joiner gives it the look before another.
                true => wide(&format!("{}\u{200d}", &part[..end])),
                false => wide(&part[..end]),
            };
            let after = width_after.min(width).max(before);
            let place = match piece.from_right {
                true => [left + width - before, 0.0],
                false => [left + before, after - before],
            };
            places.push((piece.range.start + at, place));
            before = after;
        }
        let last = match piece.from_right {
            true => left,
            false => left + width,
        };
        if piece.range.end > end.0 {
            end = (piece.range.end, last);
        }
        left += width;
    }
    places.sort_by_key(|(at, _)| *at);
    (places.into_iter().map(|(_, place)| place).collect(), end.1)
}

/// Puts the cursor where a click or a drag points, if some of a line is read from the right.
pub(crate) fn settle_text_cursor(ui: &Ui, edit: &mut TextEditOutput) {
    let response = &edit.response.response;
    let (clicked, dragged) = (response.clicked(), response.dragged());
    if !is_in_order(&edit.galley) || response.double_clicked() || !(clicked || dragged) {
        return;
    }
    let Some(at) = response.interact_pointer_pos() else {
        return;
    };
    let text_index = nearest_character_index(&edit.galley, at - edit.galley_pos.to_vec2());
    let cursor = CCursor::new(CharIndex(text_index));
    let before = edit.state.cursor.char_range().filter(|_| dragged);
    let range = match before {
        Some(before) if !response.drag_started() => CCursorRange {
            primary: cursor,
            ..before
        },
        _ => CCursorRange::one(cursor),
    };
    edit.state.cursor.set_char_range(Some(range));
    edit.state.clone().store(ui.ctx(), response.id);
}

/// Returns the index of the character whose cursor position is nearest to a point of a text.
fn nearest_character_index(galley: &Galley, point: Pos2) -> usize {
    let above = |placed: &&PlacedRow| placed.pos.y <= point.y;
    let row_count = galley.rows.iter().take_while(above).count();
    let row_index = row_count.saturating_sub(1);
    let Some(placed) = galley.rows.get(row_index) else {
        return 0;
    };
    let long = |placed_row: &PlacedRow| placed_row.row.glyphs.len() + usize::from(placed_row.ends_with_newline);
    let before: usize = galley.rows[..row_index].iter().map(long).sum();
    let row = &placed.row;
    let count = row.glyphs.len();
    let far = |at: &usize| (placed.pos.x + row.x_offset(CharIndex(*at)) - point.x).abs();
    let all = 0..=count;
    let within = all.min_by(|a, b| far(a).total_cmp(&far(b)));
    before + within.unwrap_or(count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::{Key, vec2};
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable;

    fn typed<'a>(text: &str) -> Harness<'a, (String, Option<TextEditOutput>)> {
        let draw = |ui: &mut Ui, state: &mut (String, Option<TextEditOutput>)| {
            if ui.ctx().cumulative_pass_nr() == 0 {
                crate::theme::install_studio_theme(ui.ctx());
                crate::script::install_script_support(ui.ctx());
            }
            let (text, output) = state;
            let shown = draw_text_line(ui, text, |edit| edit.desired_width(300.0));
            let response = &shown.response.response;
            response.widget_info(|| eframe::egui::WidgetInfo::labeled(eframe::egui::Role::TextInput, true, "gloss"));
            *output = Some(shown);
        };
        Harness::builder()
            .with_size(vec2(340.0, 60.0))
            .build_ui_state(draw, (text.to_owned(), None))
    }

    fn x(window: &Harness<'_, (String, Option<TextEditOutput>)>, at: usize) -> f32 {
        let output = window.state().1.as_ref().expect("it was drawn");
        output.galley.rows[0].row.x_offset(CharIndex(at))
    }

    #[test]
    fn the_cursor_moves_right_to_left_and_the_text_keeps_its_reading_order() {
        let mut window = typed("");
        window.run();
        window.get_by_label("gloss").focus();
        window.run();
        window.get_by_label("gloss").type_text("كتاب");
        window.run();
        assert_eq!(window.state().0, "كتاب");
        let all: Vec<f32> = (0..=4).map(|at| x(&window, at)).collect();
        assert!(all.is_sorted_by(|a, b| a >= b), "{all:?}");
        assert!(all[0] > 4.0 && all[4].abs() < 0.5, "{all:?}");
        window.key_press(Key::Backspace);
        window.run();
        assert_eq!(window.state().0, "كتا");
    }

    #[test]
    fn each_line_of_a_text_has_its_own_direction() {
        let text = "ab كتاب\nשלום עולם אב\nend";
        let draw = move |ui: &mut Ui, seen: &mut Option<(Arc<Galley>, usize)>| {
            if ui.ctx().cumulative_pass_nr() == 0 {
                crate::theme::install_studio_theme(ui.ctx());
                crate::script::install_script_support(ui.ctx());
            }
            let mut own = text.to_owned();
            let shown = draw_text_block(ui, &mut own, |edit| edit.desired_width(60.0));
            let galley = shown.galley;
            // Every character has its place, on the line where it stands.
            let mut at = 0;
            for placed in &galley.rows {
                let own: String = placed.row.glyphs.iter().map(|it| it.chr).collect();
                assert!(text.chars().skip(at).collect::<String>().starts_with(&own));
                let middle = placed.pos.y + 2.0;
                let xs: Vec<f32> = (0..=own.chars().count())
                    .map(|n| placed.pos.x + placed.row.x_offset(CharIndex(n)))
                    .collect();
                for (n, x) in xs.iter().enumerate() {
                    let found = nearest_character_index(&galley, pos2(*x, middle)) - at;
                    assert!((xs[found] - x).abs() < 0.5, "{own} {n} {found}");
                }
                at += own.chars().count() + usize::from(placed.ends_with_newline);
            }
            *seen = Some((galley, at));
        };
        let mut window = Harness::builder()
            .with_accessibility_check(false)
            .with_size(vec2(100.0, 200.0))
            .build_ui_state(draw, None);
        window.run();
        let (galley, all) = window.state().clone().expect("it was drawn");
        assert!(galley.rows.len() > 3, "the second line has no room on one row");
        assert_eq!(all, text.chars().count());
        let hebrew = &galley.rows[1].row;
        assert!(hebrew.x_offset(CharIndex(0)) > hebrew.x_offset(CharIndex(2)));
    }

    #[test]
    fn a_click_puts_the_cursor_between_the_letters_it_points_at() {
        let mut window = typed("AB كتاب");
        window.run();
        let (place, at) = {
            let output = window.state().1.as_ref().expect("it was drawn");
            (output.galley_pos, x(&window, 5))
        };
        let point = place + vec2(at, 6.0);
        window.hover_at(point);
        window.run();
        window.drag_at(point);
        window.step();
        window.drop_at(point);
        window.run();
        window.get_by_label("gloss").type_text("X");
        window.run();
        assert_eq!(window.state().0, "AB كتXاب");
    }
}
