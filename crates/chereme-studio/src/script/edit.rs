//! Text that is read from the right while it is typed: it looks as in other places, and the cursor follows it.
//!
//! The text itself stays in the order in which it is read, as everywhere.

use std::sync::Arc;

use eframe::egui::text::{CCursor, CCursorRange, CharIndex, LayoutJob};
use eframe::egui::text_edit::TextEditOutput;
use eframe::egui::{Galley, Pos2, TextBuffer, TextEdit, TextStyle, Ui, pos2};

use super::visual::{self, Piece};

/// Marks a text whose letters are in order already; it has no height of its own.
const IN_ORDER: f32 = f32::MIN_POSITIVE;

/// Returns whether a text was laid out here.
pub(super) fn is_in_order(galley: &Galley) -> bool {
    galley.job.first_row_min_height == IN_ORDER
}

/// Draws a line that is edited; `more` says how it looks.
pub(crate) fn line(
    ui: &mut Ui,
    text: &mut String,
    more: impl for<'a> FnOnce(TextEdit<'a>) -> TextEdit<'a>,
) -> TextEditOutput {
    let mut layouter = |ui: &Ui, text: &dyn TextBuffer, _wrap: f32| {
        let font = TextStyle::Body.resolve(ui.style());
        let colour = ui.visuals().widgets.inactive.text_color();
        let job = LayoutJob::simple_singleline(text.as_str().to_owned(), font, colour);
        lay_out(ui, job)
    };
    let mut edit = more(TextEdit::singleline(text).layouter(&mut layouter)).show(ui);
    settle(ui, &mut edit);
    edit
}

/// Lays a line that is edited out, its letters where they stand and one for each character.
pub(crate) fn lay_out(ui: &Ui, job: LayoutJob) -> Arc<Galley> {
    let plain = ui.fonts_mut(|fonts| fonts.layout_job(job.clone()));
    if !chereme_figure::letters::any_from_right(&job.text) || job.text.contains('\n') {
        return plain;
    }
    let pieces = visual::pieces(&job.text, &|_| usize::MAX);
    let drawn = visual::in_order(ui.ctx(), &plain);
    let (places, end) = places(ui, &job, &pieces);
    let mut galley = Galley::clone(&drawn);
    let Some(first) = galley.rows.first_mut() else {
        return plain;
    };
    let row = Arc::make_mut(&mut first.row);
    let Some(glyph) = row.glyphs.first().copied() else {
        return plain;
    };
    let after = row.visuals.glyph_vertex_range.end as u32;
    row.glyphs = job
        .text
        .chars()
        .zip(&places)
        .map(|(chr, [x, width])| {
            let mut glyph = glyph;
            (glyph.chr, glyph.pos) = (chr, pos2(*x, glyph.pos.y));
            (glyph.advance_width, glyph.first_vertex) = (*width, after);
            glyph
        })
        .collect();
    // The cursor after the last letter stands at the end of the row as egui knows it.
    row.size.x = end;
    galley.job = Arc::new(LayoutJob {
        first_row_min_height: IN_ORDER,
        ..job
    });
    Arc::new(galley)
}

/// Returns for each character the place of the cursor before it, and its width if it is read from the left; and the
/// place of the cursor after all of them.
fn places(ui: &Ui, job: &LayoutJob, pieces: &[Piece]) -> (Vec<[f32; 2]>, f32) {
    let look = job
        .sections
        .first()
        .map(|it| it.format.clone())
        .unwrap_or_default();
    let wide = |text: &str| {
        let (font, colour) = (look.font_id.clone(), look.color);
        ui.fonts_mut(|fonts| fonts.layout_no_wrap(text.to_owned(), font, colour).size().x)
    };
    let mut places: Vec<(usize, [f32; 2])> = Vec::new();
    let (mut left, mut end) = (0.0, (0, 0.0));
    for piece in pieces {
        let part = &job.text[piece.range.clone()];
        let width = wide(&piece.text);
        let mut before = 0.0;
        for (at, letter) in part.char_indices() {
            let end = at + letter.len_utf8();
            let after = match piece.from_right && end < part.len() {
                // A letter looks otherwise at the end than before another: this has it look as before one.
                true => wide(&format!("{}\u{200d}", &part[..end])),
                false => wide(&part[..end]),
            };
            let after = after.min(width).max(before);
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

/// Puts the cursor where a click or a drag points, where some of a line is read from the right.
pub(crate) fn settle(ui: &Ui, edit: &mut TextEditOutput) {
    let response = &edit.response.response;
    let (clicked, dragged) = (response.clicked(), response.dragged());
    if !is_in_order(&edit.galley) || response.double_clicked() || !(clicked || dragged) {
        return;
    }
    let Some(at) = response.interact_pointer_pos() else {
        return;
    };
    let at = nearest(&edit.galley, at - edit.galley_pos.to_vec2());
    let cursor = CCursor::new(CharIndex(at));
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

/// Returns the character before which the cursor stands nearest to a point of a line.
fn nearest(galley: &Galley, point: Pos2) -> usize {
    let Some(row) = galley.rows.first() else {
        return 0;
    };
    let count = row.row.glyphs.len();
    let far = |at: &usize| (row.row.x_offset(CharIndex(*at)) - point.x).abs();
    let all = 0..=count;
    all.min_by(|a, b| far(a).total_cmp(&far(b)))
        .unwrap_or(count)
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
                crate::theme::install(ui.ctx());
            }
            let (text, output) = state;
            let shown = line(ui, text, |edit| edit.desired_width(300.0));
            let response = &shown.response.response;
            response.widget_info(|| {
                eframe::egui::WidgetInfo::labeled(eframe::egui::Role::TextInput, true, "gloss")
            });
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
    fn the_cursor_goes_from_right_to_left_and_text_stays_as_it_is_read() {
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
