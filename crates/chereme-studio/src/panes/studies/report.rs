//! The main figures of a study's report, and the whole of it as a page.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use chereme_corpus::study::StudyOverview;
use chereme_corpus::study::report::{Report, numbers};
use eframe::egui::{Button, Grid, ScrollArea, Ui};

use super::{Studies, data, path_field, progress};
use crate::context::{Outbox, PaneInput};
use crate::file_dialogs::Choose;
use crate::panes::import::Paths;
use crate::words::{Text, fill, studies as words};
use crate::work::{WorkId, studying};

/// The report of the chosen study, and the file that it is written to.
#[derive(Default)]
pub(super) struct Shown {
    /// The corpus generation of the last request.
    of: Option<i64>,
    pub(super) making: Option<WorkId>,
    pub(super) found: Option<Arc<Report>>,
    pub(super) to: String,
    /// Whether a file was proposed; a path that is emptied stays empty.
    proposed: bool,
    paths: Paths,
    pub(super) saving: Option<WorkId>,
    /// Whether the file is opened once it is written.
    opens: bool,
    pub(super) saved: Option<PathBuf>,
    /// The file that was written before, which may be written again.
    own: Option<PathBuf>,
}

/// Shows the figures, and the buttons that write and open the page.
pub(super) fn show(
    pane: &mut Studies,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    it: &StudyOverview,
    out: &mut Outbox,
) {
    let shown = &mut pane.forms.report;
    let generation = seen.snapshot.overview.generation;
    if shown.of != Some(generation) && !seen.is_running(shown.making) {
        shown.of = Some(generation);
        shown.making = Some(out.work(studying::report(it.plan.name.clone())));
    }
    progress(ui, seen, shown.making, words::TASK_REPORT, out);
    let Some(report) = shown.found.clone() else {
        return;
    };
    figures(ui, seen, &report);
    ui.separator();
    if shown.to.is_empty() && !std::mem::replace(&mut shown.proposed, true) {
        let name = format!("{}-report.html", data::file_stem(&it.plan.name));
        shown.to = seen.beside(&name).display().to_string();
    }
    path_field(
        ui,
        seen,
        (words::REPORT_PATH, ""),
        (&mut shown.paths, &mut shown.to),
        Choose::Report,
        out,
    );
    let mut wanted = None;
    ui.horizontal_wrapped(|ui| {
        let ready = !shown.to.trim().is_empty() && !seen.is_running(shown.saving);
        for (opens, text) in [(true, words::OPEN_REPORT), (false, words::SAVE_REPORT)] {
            let button = ui.add_enabled(ready, Button::new(seen.say(text)));
            let button = button.on_disabled_hover_text(seen.say(words::NEEDS_FILE));
            let button = match opens {
                true => button.on_hover_text(seen.say(words::OPEN_REPORT_TIP)),
                false => button,
            };
            if button.clicked() {
                wanted = Some(opens);
            }
        }
    });
    if let Some(opens) = wanted {
        let to = with_ending(shown.to.trim());
        let force = shown.own.as_ref() == Some(&to);
        let job = studying::write_report(report, to, force, seen.language);
        (shown.saving, shown.opens) = (Some(out.work(job)), opens);
        pane.clear();
        return;
    }
    if let Some(path) = shown.saved.take() {
        if std::mem::take(&mut shown.opens) {
            pane.opening = Some(out.work(studying::open(path.clone())));
        }
        shown.own = Some(path);
    }
    if let Some(path) = &shown.own {
        ui.label(fill(seen.say(words::SAVED), &[("path", &path.display())]));
    }
}

/// Returns the path with the ending of a page, unless it has it.
fn with_ending(text: &str) -> PathBuf {
    let path = Path::new(text);
    match path.extension() {
        Some(ending) if ending.eq_ignore_ascii_case("html") => path.to_owned(),
        _ => PathBuf::from(format!("{text}.html")),
    }
}

fn figures(ui: &mut Ui, seen: &PaneInput<'_>, report: &Report) {
    let people = &report.people;
    if people.recruited == 0 {
        ui.label(seen.say(words::NOBODY));
    }
    let values: [(&str, &dyn std::fmt::Display); 2] = [
        ("recruited", &people.recruited),
        ("analysed", &people.analysed),
    ];
    ui.label(fill(seen.say(words::ANALYSED), &values));
    for it in &people.excluded {
        let reason = numbers::reason(&it.reason, seen.language);
        let values: [(&str, &dyn std::fmt::Display); 2] = [("n", &it.count), ("reason", &reason)];
        ui.weak(fill(seen.say(words::LEFT_OUT), &values));
    }
    let titles = [
        words::COLUMN_QUESTION,
        words::COLUMN_PART,
        words::COLUMN_CONDITION,
        words::COLUMN_ANSWERS,
        words::COLUMN_MEAN,
        words::COLUMN_SD,
        words::COLUMN_MEDIAN,
        words::COLUMN_RIGHT,
    ];
    table(
        ui,
        seen,
        "groups",
        &titles,
        data::groups(report, seen.language),
    );
    let rows = data::comparisons(report, seen.language);
    if !rows.is_empty() {
        ui.strong(seen.say(words::COMPARED));
        let titles = [
            words::COLUMN_QUESTION,
            words::COLUMN_FIRST,
            words::COLUMN_SECOND,
            words::COLUMN_DELTA,
            words::COLUMN_INTERVAL,
            words::COLUMN_POOLED,
            words::COLUMN_PEOPLE,
        ];
        table(ui, seen, "comparisons", &titles, rows);
    }
    for text in data::conclusions(report, seen.language) {
        ui.label(text);
    }
}

fn table(ui: &mut Ui, seen: &PaneInput<'_>, id: &str, titles: &[Text], rows: Vec<Vec<String>>) {
    if rows.is_empty() {
        return;
    }
    ScrollArea::horizontal().id_salt(id).show(ui, |ui| {
        Grid::new(id).striped(true).show(ui, |ui| {
            for title in titles {
                ui.weak(seen.say(*title));
            }
            ui.end_row();
            for row in rows {
                for cell in row {
                    ui.label(cell);
                }
                ui.end_row();
            }
        });
    });
}
