//! Begin and end of non-manuals relative to the signs, as a table and a plot.

use chereme_corpus::{NonmanualOnsets, NumberQuartiles, OnsetRow};
use eframe::egui::{
    Align2, Button, CollapsingHeader, FontId, Grid, Rect, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2,
};

use super::FacesPane;
use super::faces_data::OnsetExtent;
use crate::context::PaneInput;
use crate::words::{InterfaceText, faces_words as words, fill_text_braces};
use crate::work::faces_jobs;

/// The height of a row of the plot, in points.
const ONSET_ROW_HEIGHT: f32 = 18.0;
/// The width of the names beside the plot, in points.
const ONSET_NAMES_WIDTH: f32 = 190.0;
/// The space between the halves of the plot, those of the beginnings and of the ends, in points.
const ONSET_HALVES_GAP: f32 = 16.0;

impl FacesPane {
    /// Shows begin and end of every channel in the expressions of the function.
    pub(super) fn show_channel_timing(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let header = CollapsingHeader::new(seen.say_text(words::ONSETS))
            .id_salt("onsets")
            .default_open(false);
        let shown = header.show(ui, |ui| {
            let running = seen.is_running(self.measuring);
            ui.horizontal(|ui| {
                let button = Button::new(seen.say_text(words::MEASURE));
                if ui.add_enabled(!running, button).clicked() {
                    self.measuring = Some(seen.request_work(faces_jobs::measure_onsets_job(self.function.clone())));
                }
                if running {
                    ui.spinner();
                }
            });
            if let Some(onsets) = self.onsets.clone() {
                plot(ui, seen, &onsets);
                show_onset_table(ui, seen, &onsets);
            }
        });
        shown.header_response.on_hover_text(seen.say_text(words::ONSETS_TIP));
    }
}

fn show_onset_table(ui: &mut Ui, seen: &PaneInput<'_>, onsets: &NonmanualOnsets) {
    let range_text =
        |quartiles: &NumberQuartiles| format!("{:+.3} ({:+.3} … {:+.3})", quartiles.median, quartiles.q1, quartiles.q3);
    Grid::new("onset rows").striped(true).show(ui, |ui| {
        for text in [words::FUNCTION, words::CHANNEL, words::COUNT, words::BEGIN, words::END] {
            ui.weak(seen.say_text(text));
        }
        ui.end_row();
        for row in &onsets.rows {
            ui.label(row.function.function_name());
            ui.label(row.channel);
            ui.monospace(row.n.to_string());
            ui.monospace(range_text(&row.onset_s));
            // The number of ends stands in front of them if it is another one.
            let ends = row.offset_s.as_ref().map(range_text).unwrap_or_default();
            ui.monospace(match row.ends == row.n {
                true => ends,
                false => format!("n = {}  {ends}", row.ends),
            });
            ui.end_row();
        }
    });
}

/// Selects the begin or the end of a row.
type OnsetQuartilesOf = fn(&OnsetRow) -> Option<NumberQuartiles>;

/// Paints a box for each channel: the begin on the left and the end on the right.
fn plot(ui: &mut Ui, seen: &PaneInput<'_>, onsets: &NonmanualOnsets) {
    let height = ONSET_ROW_HEIGHT * (onsets.rows.len() as f32 + 2.0);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    let name = fill_text_braces(seen.say_text(words::PLOT), &[("n", &onsets.rows.len())]);
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &name));
    if !ui.is_rect_visible(rect) {
        return;
    }
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let font = FontId::proportional(11.0);
    let (text, weak) = (ui.visuals().text_color(), ui.visuals().weak_text_color());
    let (fill_of, line) = (seen.pane_colours().component, seen.pane_colours().accent);
    let wide = ((rect.width() - ONSET_NAMES_WIDTH - ONSET_HALVES_GAP) / 2.0).max(40.0);
    let sides: [(InterfaceText, OnsetQuartilesOf, f32); 2] = [
        (words::BEGIN, |row| Some(row.onset_s), rect.left() + ONSET_NAMES_WIDTH),
        (
            words::END,
            |row| row.offset_s,
            rect.left() + ONSET_NAMES_WIDTH + wide + ONSET_HALVES_GAP,
        ),
    ];
    for (title, of, left) in sides {
        let extent = OnsetExtent::extent_of_onsets(onsets, of);
        let x = |seconds: f64| left + extent.extent_share(seconds) * (wide - 8.0);
        let top = rect.top() + ONSET_ROW_HEIGHT;
        painter.text(
            pos2(left, rect.top() + 2.0),
            Align2::LEFT_TOP,
            format!("{} [s]", seen.say_text(title)),
            font.clone(),
            weak,
        );
        painter.vline(x(0.0), top..=rect.bottom() - ONSET_ROW_HEIGHT, Stroke::new(1.0, weak));
        for (seconds, side) in [
            (extent.low, Align2::LEFT_BOTTOM),
            (0.0, Align2::CENTER_BOTTOM),
            (extent.high, Align2::RIGHT_BOTTOM),
        ] {
            let label_position = pos2(x(seconds), rect.bottom());
            painter.text(label_position, side, format!("{seconds:.2}"), font.clone(), weak);
        }
        for (n, row) in onsets.rows.iter().enumerate() {
            let Some(it) = of(row) else { continue };
            let y = top + ONSET_ROW_HEIGHT * n as f32 + 2.0;
            let ends = [
                pos2(x(it.q1), y),
                // A box whose quartiles are equal still has a pixel.
                pos2(x(it.q3).max(x(it.q1) + 1.0), y + ONSET_ROW_HEIGHT - 5.0),
            ];
            let box_of = Rect::from_two_pos(ends[0], ends[1]);
            painter.rect_filled(box_of, 0.0, fill_of);
            painter.rect_stroke(box_of, 0.0, Stroke::new(1.0, line), StrokeKind::Inside);
            painter.vline(x(it.median), box_of.y_range(), Stroke::new(2.0, text));
        }
    }
    for (n, row) in onsets.rows.iter().enumerate() {
        let y = rect.top() + ONSET_ROW_HEIGHT * (n as f32 + 1.0) + 1.0;
        let name = format!("{}: {} (n = {})", row.function, row.channel, row.n);
        let label_position = pos2(rect.left(), y);
        painter.text(label_position, Align2::LEFT_TOP, name, font.clone(), text);
    }
}
