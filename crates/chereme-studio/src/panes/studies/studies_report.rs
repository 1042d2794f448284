//! The main figures of a study's report, and the whole of it as a page.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use chereme_corpus::study::StudyOverview;
use chereme_corpus::study::report::StudyReport;
use eframe::egui::{Button, Ui};

use super::{PathField, StudiesPane, progress, studies_data, studies_figures};
use crate::command::ChooserPurpose;
use crate::context::PaneInput;
use crate::panes::import::PathCompletions;
use crate::words::{fill_text_braces, studies_words as words};
use crate::work::{WorkId, studying};

/// The report of the chosen study, and the file that it is written to.
#[derive(Default)]
pub(super) struct ShownStudyReport {
    /// The corpus generation of the last request.
    of: Option<i64>,
    pub(super) making: Option<WorkId>,
    pub(super) found: Option<Arc<StudyReport>>,
    pub(super) to: String,
    /// Whether a file was proposed; a path that is emptied stays empty.
    proposed: bool,
    paths: PathCompletions,
    pub(super) saving: Option<WorkId>,
    /// Whether the file is opened once it is written.
    opens: bool,
    pub(super) saved: Option<PathBuf>,
    /// The file that was written before, which may be written again.
    own: Option<PathBuf>,
}

/// Shows the figures, and the buttons that write and open the page.
pub(super) fn show_study_report(pane: &mut StudiesPane, ui: &mut Ui, seen: &PaneInput<'_>, it: &StudyOverview) {
    let shown = &mut pane.forms.report;
    let generation = seen.snapshot.overview.generation;
    if shown.of != Some(generation) && !seen.is_running(shown.making) {
        shown.of = Some(generation);
        shown.making = Some(seen.request_work(studying::study_report_job(it.plan.name.clone())));
    }
    progress(ui, seen, shown.making, words::TASK_REPORT);
    let Some(report) = shown.found.clone() else {
        return;
    };
    studies_figures::show_study_figures(ui, seen, &report);
    ui.separator();
    if shown.to.is_empty() && !std::mem::replace(&mut shown.proposed, true) {
        let name = format!("{}-report.html", studies_data::file_stem(&it.plan.name));
        shown.to = seen.path_beside_corpus(&name).display().to_string();
    }
    let field = PathField {
        name: words::REPORT_PATH,
        hint: seen.say_text(words::REPORT_HINT),
        chooser: ChooserPurpose::Report,
    };
    field.show_path_line(ui, seen, &mut shown.paths, &mut shown.to);
    let mut wanted = None;
    ui.horizontal_wrapped(|ui| {
        let ready = !shown.to.trim().is_empty() && !seen.is_running(shown.saving);
        for (opens, text) in [(true, words::OPEN_REPORT), (false, words::SAVE_REPORT)] {
            let plain_button = ui.add_enabled(ready, Button::new(seen.say_text(text)));
            let button = plain_button.on_disabled_hover_text(seen.say_text(words::NEEDS_FILE));
            let button = match opens {
                true => button.on_hover_text(seen.say_text(words::OPEN_REPORT_TIP)),
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
        (shown.saving, shown.opens) = (Some(seen.request_work(job)), opens);
        pane.clear_study_results();
        return;
    }
    if let Some(path) = shown.saved.take() {
        if std::mem::take(&mut shown.opens) {
            pane.opening = Some(seen.request_work(studying::open_page_job(path.clone())));
        }
        shown.own = Some(path);
    }
    if let Some(path) = &shown.own {
        ui.label(fill_text_braces(
            seen.say_text(words::SAVED),
            &[("path", &path.display())],
        ));
    }
}

/// Returns the path with the ending of a page, unless it has that of a page or of JSON, or names a folder.
fn with_ending(text: &str) -> PathBuf {
    let path = Path::new(text);
    let is_known = |ending: &std::ffi::OsStr| {
        let endings = ["html", "htm", "json"];
        endings
            .iter()
            .any(|known_ending| ending.eq_ignore_ascii_case(known_ending))
    };
    match path.extension() {
        Some(ending) if is_known(ending) => path.to_owned(),
        _ if text.ends_with(['/', std::path::MAIN_SEPARATOR]) || path.is_dir() => path.to_owned(),
        _ => PathBuf::from(format!("{text}.html")),
    }
}
