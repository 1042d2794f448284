//! The measures, and the tables of values, confusions and recordings.

use chereme_corpus::{AnnotatorAgreement, MeasureFigure, USUAL_MEASURES};
use eframe::egui::{CollapsingHeader, Grid, RichText, ScrollArea, Ui};

use super::agreement_data;
use crate::context::PaneInput;
use crate::words::{InterfaceText, agreement as words, fill_text_braces, translate_library_message};

/// The usual measures, those that people know best first.
const USUAL_AGREEMENT_MEASURES: [&str; 5] = ["raw", "kappa_ipf", "alpha_u", "gamma", "matched"];
/// How many rows a table shows at most.
const MAX_AGREEMENT_TABLE_ROWS: usize = 500;

/// The height of a pane that shows measures and the list together, in points; a lower one begins with the list.
const TALL_PANE_HEIGHT: f32 = 420.0;

/// Shows the counts, and below them the usual measures with their intervals, which can be folded away.
pub(super) fn show_agreement_measures(ui: &mut Ui, seen: &PaneInput<'_>, found: &AnnotatorAgreement) {
    let counts = &found.counts;
    let values: [(&str, &dyn std::fmt::Display); 4] = [
        ("a", &counts.units_a),
        ("b", &counts.units_b),
        ("matched", &counts.matched),
        ("equal", &counts.equal),
    ];
    ui.label(fill_text_braces(seen.say_text(words::COUNTS), &values));
    if let Some(delays) = agreement_data::annotator_delays(found, seen.language) {
        ui.weak(delays);
    }
    // A title does not wrap, and a long one would widen the whole pane.
    let header = CollapsingHeader::new(seen.say_text(words::MEASURES))
        .id_salt("measures")
        .default_open(ui.clip_rect().height() > TALL_PANE_HEIGHT);
    header.show(ui, |ui| {
        if !found.counts_only {
            show_usual_measures(ui, seen, found);
        }
    });
    for finding in &found.findings {
        ui.weak(translate_library_message(finding, seen.language));
    }
    if found.counts_only {
        ui.weak(seen.say_text(words::FEW));
    }
}

fn show_usual_measures(ui: &mut Ui, seen: &PaneInput<'_>, found: &AnnotatorAgreement) {
    let usual_names = USUAL_AGREEMENT_MEASURES
        .iter()
        .filter(|name| USUAL_MEASURES.contains(name));
    let usual = usual_names.filter_map(|name| found.measures.iter().find(|measure| measure.0 == *name));
    show_measure_table(ui, seen, "usual measures", usual);
}

/// Shows every measure.
pub(super) fn every_measure(ui: &mut Ui, seen: &PaneInput<'_>, found: &AnnotatorAgreement) {
    if found.counts_only {
        ui.weak(seen.say_text(words::FEW));
    }
    ScrollArea::both()
        .id_salt("measures")
        .auto_shrink(false)
        .show(ui, |ui| {
            show_measure_table(ui, seen, "all measures", found.measures.iter());
        });
}

/// Shows measures as a table; a measure that is undefined has its reason instead of a number.
fn show_measure_table<'a>(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: &str,
    measures: impl Iterator<Item = &'a (&'static str, MeasureFigure)>,
) {
    Grid::new(id).num_columns(3).striped(true).show(ui, |ui| {
        for title in [words::MEASURE, words::VALUE, words::INTERVAL] {
            ui.weak(seen.say_text(title));
        }
        ui.end_row();
        for (name, figure) in measures {
            let label = match agreement_data::usual_measure_title(name) {
                Some(title) => ui.label(seen.say_text(title)),
                None => ui.monospace(*name),
            };
            if let Some(meaning) = agreement_data::measure_meaning(name) {
                label.on_hover_text(seen.say_text(meaning));
            }
            let value = agreement_data::measure_value_text(figure, seen.language);
            match figure.value {
                Some(_) => ui.label(RichText::new(value).strong()),
                None => ui.weak(value),
            };
            if let Some([ends, drawn]) = agreement_data::measure_interval_texts(figure, seen.language) {
                ui.label(ends).on_hover_text(drawn);
            }
            ui.end_row();
        }
    });
}

/// Shows the agreement on each value.
pub(super) fn show_value_agreement(ui: &mut Ui, seen: &PaneInput<'_>, found: &AnnotatorAgreement) {
    let titles = [
        words::VALUE,
        words::COLUMN_A,
        words::COLUMN_B,
        words::BOTH,
        words::OTHER,
        words::ALONE,
        words::KAPPA_IPF,
        words::ALPHA_U,
    ];
    let rows = found.by_value.iter().map(|value_row| {
        let name = match value_row.value.as_str() {
            "" => seen.say_text(words::NO_VALUE).to_owned(),
            value => value.to_owned(),
        };
        vec![
            name,
            value_row.a.to_string(),
            value_row.b.to_string(),
            value_row.both.to_string(),
            value_row.other.to_string(),
            value_row.alone.to_string(),
            agreement_data::measure_value_text(&value_row.kappa, seen.language),
            agreement_data::measure_value_text(&value_row.alpha_u, seen.language),
        ]
    });
    show_agreement_grid(ui, seen, "values", &titles, rows);
}

/// Shows the values that were confused, and the features in which they differ.
pub(super) fn show_value_confusion(ui: &mut Ui, seen: &PaneInput<'_>, found: &AnnotatorAgreement) {
    if found.confusion.is_empty() {
        ui.label(seen.say_text(words::NO_CONFUSION));
        return;
    }
    let titles = [
        words::TIMES,
        words::COLUMN_A,
        words::COLUMN_B,
        words::ONLY_FIRST,
        words::ONLY_SECOND,
    ];
    let rows = found.confusion.iter().map(|cell| {
        vec![
            cell.count.to_string(),
            cell.a.clone(),
            cell.b.clone(),
            cell.only_a.join(" "),
            cell.only_b.join(" "),
        ]
    });
    show_agreement_grid(ui, seen, "confusion", &titles, rows);
}

/// Shows the agreement in each recording.
pub(super) fn show_recording_agreement(ui: &mut Ui, seen: &PaneInput<'_>, found: &AnnotatorAgreement) {
    let titles = [
        words::RECORDING,
        words::FIRST,
        words::SECOND,
        words::COLUMN_A,
        words::COLUMN_B,
        words::MATCHED,
        words::EQUAL,
        words::KAPPA_IPF,
        words::ALPHA_U,
    ];
    let rows = found.pairs.iter().map(|pair| {
        let figure = |name: &str| {
            let measure = pair.measures.iter().find(|(own, _)| *own == name);
            let reliable_measure = measure.filter(|_| !pair.counts.are_few());
            reliable_measure.map_or_else(String::new, |it| {
                agreement_data::measure_value_text(&it.1, seen.language)
            })
        };
        vec![
            pair.recording.clone(),
            pair.tier_a.clone(),
            pair.tier_b.clone(),
            pair.counts.units_a.to_string(),
            pair.counts.units_b.to_string(),
            pair.counts.matched.to_string(),
            pair.counts.equal.to_string(),
            figure("kappa_ipf"),
            figure("alpha_u"),
        ]
    });
    show_agreement_grid(ui, seen, "recordings", &titles, rows);
}

fn show_agreement_grid(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: &str,
    titles: &[InterfaceText],
    rows: impl Iterator<Item = Vec<String>>,
) {
    ScrollArea::both().id_salt(id).auto_shrink(false).show(ui, |ui| {
        Grid::new(id).striped(true).show(ui, |ui| {
            for title in titles {
                ui.weak(seen.say_text(*title));
            }
            ui.end_row();
            for row in rows.take(MAX_AGREEMENT_TABLE_ROWS) {
                for cell in row {
                    ui.label(cell);
                }
                ui.end_row();
            }
        });
    });
}
