//! The measures, and the tables of values, confusions and recordings.

use chereme_corpus::{Agreement, Figure, USUAL_MEASURES};
use eframe::egui::{CollapsingHeader, Grid, RichText, ScrollArea, Ui};

use super::data;
use crate::context::PaneInput;
use crate::words::{Text, agreement as words, fill, spoken};

/// The usual measures, those that people know best first.
const FIRST: [&str; 5] = ["raw", "kappa_ipf", "alpha_u", "gamma", "matched"];
/// How many rows a table shows at most.
const MOST: usize = 500;

/// The height of a pane that shows measures and the list together, in points; a lower one begins with the list.
const TALL: f32 = 420.0;

/// Shows the counts, and below them the usual measures with their intervals, which can be folded away.
pub(super) fn measures(ui: &mut Ui, seen: &PaneInput<'_>, found: &Agreement) {
    let counts = &found.counts;
    let values: [(&str, &dyn std::fmt::Display); 4] = [
        ("a", &counts.units_a),
        ("b", &counts.units_b),
        ("matched", &counts.matched),
        ("equal", &counts.equal),
    ];
    ui.label(fill(seen.say(words::COUNTS), &values));
    if let Some(delays) = data::delays(found, seen.language) {
        ui.weak(delays);
    }
    // A title does not wrap, and a long one would widen the whole pane.
    let header = CollapsingHeader::new(seen.say(words::MEASURES))
        .id_salt("measures")
        .default_open(ui.clip_rect().height() > TALL);
    header.show(ui, |ui| {
        if !found.counts_only {
            usual(ui, seen, found);
        }
    });
    for finding in &found.findings {
        ui.weak(spoken(finding, seen.language));
    }
    if found.counts_only {
        ui.weak(seen.say(words::FEW));
    }
}

fn usual(ui: &mut Ui, seen: &PaneInput<'_>, found: &Agreement) {
    let usual = FIRST.iter().filter(|it| USUAL_MEASURES.contains(it));
    let usual = usual.filter_map(|name| found.measures.iter().find(|it| it.0 == *name));
    table(ui, seen, "usual measures", usual);
}

/// Shows every measure.
pub(super) fn every_measure(ui: &mut Ui, seen: &PaneInput<'_>, found: &Agreement) {
    if found.counts_only {
        ui.weak(seen.say(words::FEW));
    }
    ScrollArea::both()
        .id_salt("measures")
        .auto_shrink(false)
        .show(ui, |ui| {
            table(ui, seen, "all measures", found.measures.iter());
        });
}

/// Shows measures as a table; a measure that is undefined has its reason instead of a number.
fn table<'a>(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: &str,
    measures: impl Iterator<Item = &'a (&'static str, Figure)>,
) {
    Grid::new(id).num_columns(3).striped(true).show(ui, |ui| {
        for title in [words::MEASURE, words::VALUE, words::INTERVAL] {
            ui.weak(seen.say(title));
        }
        ui.end_row();
        for (name, figure) in measures {
            let label = match data::title(name) {
                Some(title) => ui.label(seen.say(title)),
                None => ui.monospace(*name),
            };
            if let Some(meaning) = data::meaning(name) {
                label.on_hover_text(seen.say(meaning));
            }
            let value = data::value(figure, seen.language);
            match figure.value {
                Some(_) => ui.label(RichText::new(value).strong()),
                None => ui.weak(value),
            };
            if let Some([ends, drawn]) = data::interval(figure, seen.language) {
                ui.label(ends).on_hover_text(drawn);
            }
            ui.end_row();
        }
    });
}

/// Shows the agreement on each value.
pub(super) fn values(ui: &mut Ui, seen: &PaneInput<'_>, found: &Agreement) {
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
    let rows = found.by_value.iter().map(|it| {
        let name = match it.value.as_str() {
            "" => seen.say(words::NO_VALUE).to_owned(),
            value => value.to_owned(),
        };
        vec![
            name,
            it.a.to_string(),
            it.b.to_string(),
            it.both.to_string(),
            it.other.to_string(),
            it.alone.to_string(),
            data::value(&it.kappa, seen.language),
            data::value(&it.alpha_u, seen.language),
        ]
    });
    grid(ui, seen, "values", &titles, rows);
}

/// Shows the values that were confused, and the features in which they differ.
pub(super) fn confusion(ui: &mut Ui, seen: &PaneInput<'_>, found: &Agreement) {
    if found.confusion.is_empty() {
        ui.label(seen.say(words::NO_CONFUSION));
        return;
    }
    let titles = [
        words::TIMES,
        words::COLUMN_A,
        words::COLUMN_B,
        words::ONLY_FIRST,
        words::ONLY_SECOND,
    ];
    let rows = found.confusion.iter().map(|it| {
        vec![
            it.count.to_string(),
            it.a.clone(),
            it.b.clone(),
            it.only_a.join(" "),
            it.only_b.join(" "),
        ]
    });
    grid(ui, seen, "confusion", &titles, rows);
}

/// Shows the agreement in each recording.
pub(super) fn recordings(ui: &mut Ui, seen: &PaneInput<'_>, found: &Agreement) {
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
    let rows = found.pairs.iter().map(|it| {
        let figure = |name: &str| {
            let found = it.measures.iter().find(|(own, _)| *own == name);
            let found = found.filter(|_| !it.counts.are_few());
            found.map_or_else(String::new, |it| data::value(&it.1, seen.language))
        };
        vec![
            it.recording.clone(),
            it.tier_a.clone(),
            it.tier_b.clone(),
            it.counts.units_a.to_string(),
            it.counts.units_b.to_string(),
            it.counts.matched.to_string(),
            it.counts.equal.to_string(),
            figure("kappa_ipf"),
            figure("alpha_u"),
        ]
    });
    grid(ui, seen, "recordings", &titles, rows);
}

fn grid(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: &str,
    titles: &[Text],
    rows: impl Iterator<Item = Vec<String>>,
) {
    ScrollArea::both()
        .id_salt(id)
        .auto_shrink(false)
        .show(ui, |ui| {
            Grid::new(id).striped(true).show(ui, |ui| {
                for title in titles {
                    ui.weak(seen.say(*title));
                }
                ui.end_row();
                for row in rows.take(MOST) {
                    for cell in row {
                        ui.label(cell);
                    }
                    ui.end_row();
                }
            });
        });
}
