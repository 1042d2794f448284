//! The report of a study in the window: who answered, bars and tables for each question, comparisons and conclusions.

use chereme_corpus::study::report::report_words as reporting;
use chereme_corpus::study::report::{
    AnswerGroup, ChartShade, ConfusionTable, ProfileTable, QuestionReport, StudyReport, report_numbers,
};
use chereme_corpus::study::study_plan::{QuestionKind, text_in};
use eframe::egui::{
    Align2, CollapsingHeader, Color32, Grid, Pos2, Rect, RichText, Role, ScrollArea, Sense, Stroke, TextStyle,
    TextWrapMode, Ui, WidgetInfo, WidgetText, pos2, vec2,
};

use super::studies_data;
use crate::context::PaneInput;
use crate::words::{InterfaceText, fill_text_braces, studies_words as words};

/// The widest bars, in points.
const MAX_BAR_WIDTH_POINTS: f32 = 520.0;
/// The largest table of chosen and right options that is shown.
const MOST_OPTIONS: usize = 24;

/// Shows the report.
pub(super) fn show_study_figures(ui: &mut Ui, seen: &PaneInput<'_>, report: &StudyReport) {
    let people = &report.people;
    if people.recruited == 0 {
        ui.label(seen.say_text(words::NOBODY));
    }
    for text in studies_data::conclusion_sentences(report, seen.language) {
        ui.label(text);
    }
    let values: [(&str, &dyn std::fmt::Display); 2] =
        [("recruited", &people.recruited), ("analysed", &people.analysed)];
    ui.label(fill_text_braces(seen.say_text(words::ANALYSED), &values));
    for it in &people.excluded {
        let reason = report_numbers::exclusion_reason_words(&it.reason, seen.language);
        let values: [(&str, &dyn std::fmt::Display); 2] = [("n", &it.count), ("reason", &reason)];
        ui.weak(fill_text_braces(seen.say_text(words::LEFT_OUT), &values));
    }
    if people.recruited > 0 && !people.profile.is_empty() {
        let header = CollapsingHeader::new(seen.say_text(words::WHO)).id_salt("who");
        header.show(ui, |ui| show_participant_profiles(ui, seen, &people.profile));
    }
    for it in &report.questions {
        if it.conditions.iter().any(|group| group.answers + group.cannot_say > 0) {
            show_question_figures(ui, seen, it);
        }
    }
    show_pair_comparisons(ui, seen, report);
}

/// Shows how many participants gave each answer about themselves.
fn show_participant_profiles(ui: &mut Ui, seen: &PaneInput<'_>, tables: &[ProfileTable]) {
    let titles = [
        words::COLUMN_QUESTION,
        words::COLUMN_ANSWER,
        words::COLUMN_RECRUITED,
        words::COLUMN_ANALYSED,
    ];
    let language = seen.language.language_code();
    let rows = tables.iter().flat_map(|profile| {
        let given = profile.rows.iter().filter(|row| row.recruited > 0);
        given.map(|row| {
            let none = reporting::NO_ANSWER.text_in_language(seen.language);
            let text = text_in(&row.text, language).or(row.option.as_deref());
            vec![
                profile.question.clone(),
                text.unwrap_or(none).to_owned(),
                row.recruited.to_string(),
                row.analysed.to_string(),
            ]
        })
    });
    show_figures_table(ui, seen, "people", &titles, rows.collect());
}

fn show_question_figures(ui: &mut Ui, seen: &PaneInput<'_>, it: &QuestionReport) {
    ui.separator();
    let text = text_in(&it.text, seen.language.language_code()).unwrap_or_default();
    ui.horizontal_wrapped(|ui| {
        ui.strong(&it.name);
        if text != it.name {
            ui.label(text);
        }
    });
    let given: Vec<&AnswerGroup> = it.conditions.iter().filter(|group| group.answers > 0).collect();
    if let QuestionKind::Scale { low, high, .. } = it.kind {
        legend(ui, low, high);
        for group in &given {
            let name = group_name(group);
            show_stacked_scale_bar(ui, seen, &name, group, low);
        }
    }
    if given.iter().any(|group| group.recognition.is_some()) {
        ui.weak(reporting::SHARES.text_in_language(seen.language));
        let chance = match &it.kind {
            QuestionKind::Choice { options } => Some(1.0 / options.len().max(1) as f64),
            QuestionKind::Scale { .. } => None,
        };
        for group in &given {
            show_right_answer_share(ui, seen, &group_name(group), group, chance);
        }
    }
    show_answer_groups(ui, seen, &it.name, &it.conditions);
    let items = it.items.iter().any(|group| group.answers > 0);
    if items {
        let header = CollapsingHeader::new(reporting::EACH_ITEM.text_in_language(seen.language));
        header.id_salt(("items", &it.name)).show(ui, |ui| {
            show_answer_groups(ui, seen, &format!("{} items", it.name), &it.items);
        });
    }
    for (at, confusion) in it.confusions.iter().enumerate() {
        let fits = confusion.columns.len() <= MOST_OPTIONS && confusion.rows.len() <= MOST_OPTIONS;
        if fits && confusion.condition.is_none() {
            confused(ui, seen, &it.name, at, confusion);
        }
    }
}

/// Returns the condition of a group, with its part and item if it has them.
fn group_name(group: &AnswerGroup) -> String {
    let group_words = [
        group.part.as_str(),
        group.item.as_deref().unwrap_or_default(),
        &group.condition,
    ];
    let words: Vec<&str> = group_words.into_iter().filter(|word| !word.is_empty()).collect();
    words.join(", ")
}

/// Shows the numbers of a scale with their colours.
fn legend(ui: &mut Ui, low: i64, high: i64) {
    ui.horizontal_wrapped(|ui| {
        for at in low..=high {
            let shade = ChartShade::of_scale((at - low) as f64 / (high - low).max(1) as f64);
            let label = format!(" {at} ");
            let text = RichText::new(label).color(bar_letter_colour(shade));
            ui.label(text.background_color(fill_of(shade)));
        }
    });
}

fn fill_of(shade: ChartShade) -> Color32 {
    let [red, green, blue] = shade.rgb;
    Color32::from_rgb(red, green, blue)
}

fn bar_letter_colour(shade: ChartShade) -> Color32 {
    match shade.is_dark {
        true => Color32::WHITE,
        false => Color32::BLACK,
    }
}

/// The places of a row of a figure: the rectangle of its bars; its name is left of it, and a number right of it.
fn show_figure_row(ui: &mut Ui, name: &str, about: String, number: &str) -> Rect {
    let width = ui.available_width().min(MAX_BAR_WIDTH_POINTS);
    let height = ui.spacing().interact_size.y;
    let (rect, response) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &about));
    response.on_hover_text(&about);
    let colour = ui.visuals().text_color();
    let left = rect.left() + (rect.width() * 0.3).min(160.0);
    let right = rect.right() - 56.0;
    let put = |text: &str, at: Pos2, width: f32, align: Align2| {
        let cut = Some(TextWrapMode::Truncate);
        let text = WidgetText::from(RichText::new(text).color(colour));
        let galley = text.into_galley(ui, cut, width, TextStyle::Small);
        let text_rect = align.anchor_size(at, galley.size());
        ui.painter().galley(text_rect.min, galley, colour);
    };
    let middle = rect.center().y;
    let room = left - rect.left() - 6.0;
    put(name, pos2(left - 6.0, middle), room, Align2::RIGHT_CENTER);
    put(number, pos2(right + 6.0, middle), 50.0, Align2::LEFT_CENTER);
    Rect::from_min_max(pos2(left, rect.top() + 2.0), pos2(right, rect.bottom() - 2.0))
}

/// Shows how often each number of a scale was given, as one bar.
fn show_stacked_scale_bar(ui: &mut Ui, seen: &PaneInput<'_>, name: &str, group: &AnswerGroup, low: i64) {
    let all = group.counts.iter().sum::<usize>().max(1) as f32;
    let counts = (low..).zip(&group.counts);
    let count_texts: Vec<String> = counts.map(|(at, count)| format!("{at}: {count}")).collect();
    let about = format!("{name}: {}", count_texts.join(", "));
    let number = format!("n = {}", group.answers);
    let bars = show_figure_row(ui, name, about, &number);
    let points = group.counts.len().max(2) - 1;
    let painter = ui.painter();
    let mut x = bars.left();
    for (at, count) in group.counts.iter().enumerate() {
        let wide = bars.width() * *count as f32 / all;
        let piece = Rect::from_min_size(pos2(x, bars.top()), vec2(wide, bars.height()));
        let shade = ChartShade::of_scale(at as f64 / points as f64);
        painter.rect_filled(piece, 0.0, fill_of(shade));
        let percent = format!("{:.0}", 100.0 * *count as f32 / all);
        if wide > 10.0 + 7.0 * percent.len() as f32 {
            let font = TextStyle::Small.resolve(ui.style());
            let align = Align2::CENTER_CENTER;
            painter.text(piece.center(), align, percent, font, bar_letter_colour(shade));
        }
        x += wide;
    }
    let edge = Stroke::new(1.0, seen.pane_colours().field_edge);
    painter.rect_stroke(bars, 0.0, edge, eframe::egui::StrokeKind::Inside);
}

/// Shows the share of right answers with its interval, and the share of guesses.
fn show_right_answer_share(ui: &mut Ui, seen: &PaneInput<'_>, name: &str, group: &AnswerGroup, chance: Option<f64>) {
    let Some(it) = group.recognition else { return };
    let percent = |value| report_numbers::format_percent(value, seen.language);
    let [low, high] = it.interval;
    let about = format!("{name}: {} [{}; {}]", percent(it.share), percent(low), percent(high));
    let bars = show_figure_row(ui, name, about, &percent(it.share));
    let x = |value: f64| bars.left() + bars.width() * value as f32;
    let painter = ui.painter();
    painter.rect_filled(bars, 0.0, seen.pane_colours().stripe);
    let bar = Rect::from_min_max(bars.min, pos2(x(it.share), bars.bottom()));
    painter.rect_filled(bar, 0.0, fill_of(ChartShade::of_table(0.5)));
    let stroke = Stroke::new(1.5, ui.visuals().strong_text_color());
    let middle = bars.center().y;
    painter.hline(x(low)..=x(high), middle, stroke);
    for end in [low, high] {
        painter.vline(x(end), middle - 4.0..=middle + 4.0, stroke);
    }
    if let Some(chance) = chance {
        let stroke = Stroke::new(1.0, seen.pane_colours().trouble);
        painter.vline(x(chance), bars.y_range(), stroke);
    }
}

/// Shows the options that were chosen for each right option.
fn confused(ui: &mut Ui, seen: &PaneInput<'_>, name: &str, at: usize, it: &ConfusionTable) {
    ui.weak(reporting::CONFUSION.text_in_language(seen.language));
    let id = ("confusion", name, at);
    ScrollArea::horizontal().id_salt(id).show(ui, |ui| {
        Grid::new(id).show(ui, |ui| {
            ui.label("");
            for column in &it.columns {
                ui.weak(column);
            }
            ui.end_row();
            for (row, counts) in it.rows.iter().zip(&it.counts) {
                ui.weak(row);
                let all = counts.iter().sum::<usize>().max(1) as f64;
                for (column, count) in it.columns.iter().zip(counts) {
                    let shade = ChartShade::of_table(*count as f64 / all);
                    let count_text = RichText::new(format!(" {count} ")).color(bar_letter_colour(shade));
                    let text = count_text.background_color(fill_of(shade));
                    ui.label(if row == column { text.strong().underline() } else { text });
                }
                ui.end_row();
            }
        });
    });
}

/// Shows groups of answers as a table.
fn show_answer_groups(ui: &mut Ui, seen: &PaneInput<'_>, id: &str, groups: &[AnswerGroup]) {
    let titles = [
        words::COLUMN_CONDITION,
        words::COLUMN_ANSWERS,
        words::COLUMN_CANNOT_SAY,
        words::COLUMN_MEAN,
        words::COLUMN_SD,
        words::COLUMN_MEDIAN,
        words::COLUMN_RIGHT,
    ];
    let answered_groups = groups.iter().filter(|group| group.answers + group.cannot_say > 0);
    let rows = answered_groups
        .map(|answered_group| studies_data::group_table_row(group_name(answered_group), answered_group, seen.language));
    show_figures_table(ui, seen, id, &titles, rows.collect());
}

/// Shows the comparisons of pairs, and the correlations with measures.
fn show_pair_comparisons(ui: &mut Ui, seen: &PaneInput<'_>, report: &StudyReport) {
    let rows = studies_data::comparison_table_rows(report, seen.language);
    let measures = studies_data::correlation_sentences(report, seen.language);
    if rows.is_empty() && measures.is_empty() {
        return;
    }
    ui.separator();
    ui.strong(seen.say_text(words::COMPARED));
    let titles = [
        words::COLUMN_HYPOTHESIS,
        words::COLUMN_QUESTION,
        words::COLUMN_FIRST,
        words::COLUMN_SECOND,
        words::COLUMN_DELTA,
        words::COLUMN_INTERVAL,
        words::COLUMN_POOLED,
        words::COLUMN_PEOPLE,
    ];
    show_figures_table(ui, seen, "comparisons", &titles, rows);
    for text in measures {
        ui.label(text);
    }
}

fn show_figures_table(ui: &mut Ui, seen: &PaneInput<'_>, id: &str, titles: &[InterfaceText], rows: Vec<Vec<String>>) {
    if rows.is_empty() {
        return;
    }
    // A column without any number says nothing.
    let filled = |column: &usize| {
        rows.iter()
            .any(|row| row.get(*column).is_some_and(|cell| !cell.is_empty()))
    };
    let columns: Vec<usize> = (0..titles.len()).filter(filled).collect();
    ScrollArea::horizontal().id_salt(id).show(ui, |ui| {
        Grid::new(id).striped(true).show(ui, |ui| {
            for column in &columns {
                ui.weak(seen.say_text(titles[*column]));
            }
            ui.end_row();
            for row in &rows {
                for column in &columns {
                    ui.label(&row[*column]);
                }
                ui.end_row();
            }
        });
    });
}
