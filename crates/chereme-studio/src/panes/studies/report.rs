//! The main figures of a study's report, and the whole of it as a page.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use chereme_corpus::study::StudyOverview;
use chereme_corpus::study::report::Report;
use eframe::egui::{Button, Ui};

use super::{Studies, data, figures, path_field, progress};
use crate::context::{Outbox, PaneInput};
use crate::file_dialogs::Choose;
use crate::panes::import::Paths;
use crate::words::{fill, studies as words};
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
    figures::show(ui, seen, &report);
    ui.separator();
    if shown.to.is_empty() && !std::mem::replace(&mut shown.proposed, true) {
        let name = format!("{}-report.html", data::file_stem(&it.plan.name));
        shown.to = seen.beside(&name).display().to_string();
    }
    path_field(
        ui,
        seen,
        (words::REPORT_PATH, seen.say(words::REPORT_HINT)),
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

/// Returns the path with the ending of a page, unless it has that of a page or of JSON, or names a folder.
fn with_ending(text: &str) -> PathBuf {
    let path = Path::new(text);
    let known = |ending: &std::ffi::OsStr| {
        let known = ["html", "htm", "json"];
        known.iter().any(|it| ending.eq_ignore_ascii_case(it))
    };
    match path.extension() {
        Some(ending) if known(ending) => path.to_owned(),
        _ if text.ends_with(['/', std::path::MAIN_SEPARATOR]) || path.is_dir() => path.to_owned(),
        _ => PathBuf::from(format!("{text}.html")),
    }
}
