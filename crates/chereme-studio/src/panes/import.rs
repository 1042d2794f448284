//! Import: what was understood of files before anything is written, and then the writing.

use std::path::PathBuf;

use chereme_corpus::{FileReport, FileStatus, ImportOptions, ImportReport};
use eframe::egui::{Button, RichText, ScrollArea, TextEdit, Ui};

use super::Pane;
use crate::context::{Outbox, Seen};
use crate::words::{Text, fill, import as words};
use crate::work::{Ended, Outcome, Work, WorkId};

/// Returns what became of a file, in words.
pub(crate) fn status_text(status: FileStatus) -> Text {
    match status {
        FileStatus::Imported => words::IMPORTED,
        FileStatus::Unchanged => words::UNCHANGED,
        FileStatus::Skipped => words::SKIPPED,
        FileStatus::Refused => words::REFUSED,
    }
}

/// Returns the lines that tell how a file was understood and what is odd about it.
pub(crate) fn lines(file: &FileReport, line: impl Fn(u64) -> String) -> Vec<String> {
    let understood = file
        .understood
        .iter()
        .map(|(key, value)| format!("{key}: {}", chereme_corpus::cell_text(value)));
    let findings = file.findings.iter().map(|it| {
        let place = it
            .line
            .map(|number| format!("{}: ", line(number)))
            .unwrap_or_default();
        let remedy = it
            .remedy
            .as_ref()
            .map(|it| format!(" — {it}"))
            .unwrap_or_default();
        format!("{place}{}{remedy}", it.message)
    });
    understood.chain(findings).collect()
}

/// The pane.
#[derive(Default)]
pub(crate) struct Import {
    path: String,
    /// Files that were dropped on the window, where they are several.
    dropped: Vec<PathBuf>,
    asked: Option<WorkId>,
    report: Option<ImportReport>,
    come: bool,
}

impl Import {
    /// Takes paths to be looked at.
    pub(crate) fn propose(&mut self, paths: &[PathBuf]) {
        self.path = match paths {
            [one] => one.display().to_string(),
            _ => String::new(),
        };
        self.dropped = paths.to_vec();
        self.report = None;
    }

    fn paths(&self) -> Vec<PathBuf> {
        match self.path.trim() {
            "" => self.dropped.clone(),
            path => vec![PathBuf::from(path)],
        }
    }

    fn ask(&mut self, dry_run: bool, out: &mut Outbox) {
        let options = ImportOptions {
            dry_run,
            ..ImportOptions::default()
        };
        self.asked = Some(out.work(Work::Import(self.paths(), Box::new(options))));
    }

    fn report(&self, ui: &mut Ui, seen: &Seen<'_>) {
        let Some(report) = &self.report else { return };
        ui.separator();
        ui.label(seen.say(if report.dry_run {
            words::DRY
        } else {
            words::DONE
        }));
        let counts = report
            .created
            .iter()
            .map(|(what, count)| format!("{count} {what}"));
        ui.label(counts.collect::<Vec<_>>().join(", "));
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            for file in &report.files {
                let name = PathBuf::from(&file.path);
                let name = name
                    .file_name()
                    .unwrap_or_default()
                    .to_string_lossy()
                    .into_owned();
                let colour = match file.status {
                    FileStatus::Refused => seen.colours().trouble,
                    FileStatus::Imported => seen.colours().good,
                    _ => ui.visuals().weak_text_color(),
                };
                let title = format!("{name} · {}", seen.say(status_text(file.status)));
                let line = |number: u64| fill(seen.say(words::LINE), &[("n", &number)]);
                let header =
                    eframe::egui::CollapsingHeader::new(RichText::new(title).color(colour));
                header.id_salt(&file.path).show(ui, |ui| {
                    for line in lines(file, line) {
                        ui.label(line);
                    }
                });
            }
        });
    }
}

impl Pane for Import {
    fn ui(&mut self, ui: &mut Ui, seen: &Seen<'_>, out: &mut Outbox) {
        let label = ui.label(RichText::new(seen.say(words::PATH)).small());
        let path = TextEdit::singleline(&mut self.path).desired_width(f32::INFINITY);
        let response = ui.add(path).labelled_by(label.id);
        if std::mem::take(&mut self.come) {
            response.request_focus();
        }
        for path in self.dropped.iter().filter(|_| self.path.trim().is_empty()) {
            ui.small(path.display().to_string());
        }
        let ready = !self.paths().is_empty() && !seen.is_running(self.asked);
        ui.horizontal(|ui| {
            if ui
                .add_enabled(ready, Button::new(seen.say(words::LOOK)))
                .clicked()
            {
                self.ask(true, out);
            }
            if ui
                .add_enabled(ready, Button::new(seen.say(words::TAKE)))
                .clicked()
            {
                self.ask(false, out);
            }
            if seen.is_running(self.asked) {
                ui.spinner();
            }
        });
        if self.report.is_none() {
            ui.weak(seen.say(words::NOTHING));
        }
        self.report(ui, seen);
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        if let (true, Ok(Outcome::Imported(report))) = (self.asked == Some(id), ended) {
            self.report = Some(report.clone());
        }
    }

    fn come(&mut self) {
        self.come = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::ReportFinding;

    #[test]
    fn findings_say_their_line_and_what_would_be_right() {
        let file = FileReport {
            path: "a.bvh".into(),
            status: FileStatus::Imported,
            recording: None,
            understood: [("unit", serde_json::json!("cm"))].into(),
            findings: vec![ReportFinding {
                severity: "warning",
                line: Some(3),
                message: "odd".into(),
                remedy: Some("mend it".into()),
            }],
        };
        let lines = lines(&file, |number| format!("line {number}"));
        assert_eq!(lines, ["unit: cm", "line 3: odd — mend it"]);
    }
}
