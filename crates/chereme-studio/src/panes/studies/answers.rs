//! The answers to a study, imported from files.

use std::path::PathBuf;

use chereme_corpus::FileStatus;
use chereme_corpus::study::{AnswersReport, StudyOverview};
use eframe::egui::{Button, Ui};

use super::{Studies, path_field, progress};
use crate::context::{Outbox, PaneInput};
use crate::file_dialogs::Choose;
use crate::panes::import::Paths;
use crate::words::{fill, shell, spoken, studies as words};
use crate::work::{WorkId, studying};

/// How many findings of a file are shown.
const MOST: usize = 20;

/// The files, and the report of their import.
#[derive(Default)]
pub(super) struct Form {
    path: String,
    paths: Paths,
    /// Files that were chosen or dropped together.
    several: Vec<PathBuf>,
    pub(super) importing: Option<WorkId>,
    pub(super) report: Option<AnswersReport>,
}

impl Form {
    /// Takes files or folders that were chosen or dropped.
    pub(super) fn take(&mut self, paths: Vec<PathBuf>) {
        self.report = None;
        match paths.as_slice() {
            [one] => (self.path, self.several) = (one.display().to_string(), Vec::new()),
            _ => (self.path, self.several) = (String::new(), paths),
        }
    }

    fn files(&self) -> Vec<PathBuf> {
        match self.path.trim() {
            "" => self.several.clone(),
            path => vec![PathBuf::from(path)],
        }
    }
}

/// Shows the files, the button that imports them, and the report.
pub(super) fn show(
    pane: &mut Studies,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    it: &StudyOverview,
    out: &mut Outbox,
) {
    let values: [(&str, &dyn std::fmt::Display); 3] = [
        ("people", &it.participants),
        ("finished", &it.finished),
        ("answers", &it.answers),
    ];
    ui.label(fill(seen.say(words::PEOPLE), &values));
    let form = &mut pane.forms.answers;
    path_field(
        ui,
        seen,
        (words::ANSWERS_PATH, seen.say(words::ANSWERS_HINT)),
        (&mut form.paths, &mut form.path),
        Choose::Answers,
        out,
    );
    if form.path.trim().is_empty() {
        for path in form.several.iter().take(8) {
            ui.small(path.display().to_string());
        }
    }
    if !progress(ui, seen, form.importing, words::TASK_ANSWERS, out) {
        let files = form.files();
        let locked = seen.snapshot.is_read_only();
        let ready = !files.is_empty() && !locked;
        let why = match locked {
            true => shell::READ_ONLY_WHY,
            false => words::NEEDS_FILES,
        };
        let import = ui.add_enabled(ready, Button::new(seen.say(words::IMPORT)));
        if import.on_disabled_hover_text(seen.say(why)).clicked() {
            let job = studying::import(it.plan.name.clone(), files);
            (form.importing, form.report) = (Some(out.work(job)), None);
            pane.clear();
        }
    }
    if let Some(report) = &pane.forms.answers.report {
        imported(ui, seen, report);
    }
}

fn imported(ui: &mut Ui, seen: &PaneInput<'_>, report: &AnswersReport) {
    let values: [(&str, &dyn std::fmt::Display); 5] = [
        ("files", &report.files.len()),
        ("added", &report.added),
        ("replaced", &report.replaced),
        ("unchanged", &report.unchanged),
        ("answers", &report.answers),
    ];
    ui.label(fill(seen.say(words::IMPORTED), &values));
    for file in &report.files {
        let refused = file.status == FileStatus::Refused;
        if refused {
            let text = fill(seen.say(words::REFUSED), &[("path", &file.path)]);
            ui.colored_label(seen.colours().trouble, text);
        } else if !file.findings.is_empty() {
            ui.label(&file.path);
        }
        for finding in file.findings.iter().take(MOST) {
            let message = spoken(&finding.message, seen.language);
            let text = match finding.line {
                Some(line) => {
                    let values: [(&str, &dyn std::fmt::Display); 2] =
                        [("line", &line), ("message", &message)];
                    fill(seen.say(words::LINE), &values)
                }
                None => message,
            };
            ui.weak(text);
        }
    }
}
