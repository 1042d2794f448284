//! Import: shows the interpretation of files before anything is written, takes corrections, and then writes.

mod import_body;
mod import_data;
mod import_files;
mod import_known;
mod import_paths;
pub(super) mod import_people;
mod import_together;

use std::path::PathBuf;

use chereme_corpus::remedy::ErrorRemedy;
use chereme_corpus::{FileStatus, ImportReport, MergeReport};
use eframe::egui::{Align, Button, Id, Layout, ProgressBar, RichText, ScrollArea, Ui};

use super::PaneInterface;
use super::complete_pane::CompletionLine;
use crate::command::{ChooserPurpose, CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::window_remedy;
use crate::words::{fill_text_braces, import_words as words, shell, translate_library_message};
use crate::work::{WorkId, WorkOutcome, WorkResult, exchange};
use import_known::ImportCorrections;
pub(crate) use import_paths::PathCompletions;

/// The pane.
#[derive(Default)]
pub(crate) struct ImportPane {
    path: String,
    /// The dropped or chosen files, if there are several.
    dropped: Vec<PathBuf>,
    paths: PathCompletions,
    corrections: ImportCorrections,
    /// The corrections at the last examination of the files.
    looked: ImportCorrections,
    asked: Option<WorkId>,
    report: Option<ImportReport>,
    /// The outcome of a merge.
    merged: Option<MergeReport>,
    /// Why nothing could be examined: a message and a remedy.
    wrong: Option<(String, Option<ErrorRemedy>)>,
    /// Whether the work was stopped.
    stopped: bool,
    /// Whether files were just given, which must be examined.
    fresh: bool,
    come: bool,
}

impl ImportPane {
    /// Sets the paths to examine.
    pub(crate) fn propose_import_paths(&mut self, paths: &[PathBuf]) {
        self.path = match paths {
            [one] => one.display().to_string(),
            _ => String::new(),
        };
        self.dropped = paths.to_vec();
        (self.report, self.merged, self.wrong) = (None, None, None);
        self.fresh = !paths.is_empty();
    }

    fn paths_to_examine(&self) -> Vec<PathBuf> {
        match self.path.trim() {
            "" => self.dropped.clone(),
            path => vec![PathBuf::from(path)],
        }
    }

    /// Returns the path if it names a corpus, which is merged rather than imported.
    fn corpus_to_merge(&self) -> Option<PathBuf> {
        match self.paths_to_examine().as_slice() {
            [one] if import_together::is_corpus(one) => Some(one.clone()),
            _ => None,
        }
    }

    fn request_import(&mut self, dry_run: bool, out: &CommandOutbox) {
        if let Some(old) = self.asked.take() {
            out.send_command(WindowCommand::Stop(old));
        }
        let options = self.corrections.corrected_import_options(dry_run);
        self.looked = self.corrections.clone();
        (self.wrong, self.stopped) = (None, false);
        self.asked = Some(out.request_work(exchange::import_files_job(self.paths_to_examine(), options)));
    }

    fn choosing(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let label = ui.label(RichText::new(seen.say_text(words::PATH)).small());
        let id = Id::unique("import path");
        let line = CompletionLine {
            hint: seen.say_text(words::PATH_HINT),
            ..CompletionLine::default()
        };
        if std::mem::take(&mut self.come) {
            ui.memory_mut(|memory| memory.request_focus(id));
        }
        let typed = self.paths.show_path_field(ui, id, line, &mut self.path);
        let (entered, changed) = (typed.entered, typed.changed);
        typed.response.labelled_by(label.id);
        if changed {
            (self.report, self.merged) = (None, None);
        }
        // After a folder is taken from the list, its contents are offered next.
        let is_whole_path = !changed || !self.path.ends_with('/');
        if entered && is_whole_path && !self.paths_to_examine().is_empty() && self.corpus_to_merge().is_none() {
            self.request_import(true, seen.out);
        }
        ui.horizontal_wrapped(|ui| {
            if ui.button(seen.say_text(words::CHOOSE_FILES)).clicked() {
                seen.send_command(WindowCommand::Choose(ChooserPurpose::Files));
            }
            if ui.button(seen.say_text(words::CHOOSE_FOLDER)).clicked() {
                seen.send_command(WindowCommand::Choose(ChooserPurpose::Folder));
            }
        });
        if self.path.trim().is_empty() {
            for path in self.dropped.iter().take(8) {
                ui.small(path.display().to_string());
            }
            if self.dropped.len() > 8 {
                let more = self.dropped.len() - 8;
                ui.small(fill_text_braces(seen.say_text(words::MORE_FILES), &[("n", &more)]));
            }
        }
    }

    fn show_import_buttons(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let running = self.asked.and_then(|id| seen.running.get(&id));
        if let (Some(running), Some(id)) = (running, self.asked) {
            // At the other end from the buttons that are clicked before and after this one.
            ui.horizontal(|ui| {
                match running.far.finished_share() {
                    Some(share) => {
                        let bar = ProgressBar::new(share).desired_width(120.0);
                        ui.add(bar.show_percentage());
                    }
                    None => drop(ui.spinner()),
                }
                let cancel = Button::new(seen.say_text(shell::CANCEL));
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    if ui.add(cancel).clicked() {
                        seen.send_command(WindowCommand::Stop(id));
                    }
                    let task = eframe::egui::Label::new(&running.far.task);
                    ui.add(task.truncate());
                });
            });
            return;
        }
        let ready = !self.paths_to_examine().is_empty();
        let looked = self.report.as_ref().is_some_and(|report| report.dry_run);
        let changed = looked && self.looked != self.corrections;
        ui.horizontal_wrapped(|ui| {
            let text = if looked { words::LOOK_AGAIN } else { words::LOOK };
            if !looked || changed {
                let look = Button::new(seen.say_text(text));
                if ui.add_enabled(ready, look).clicked() {
                    self.request_import(true, seen.out);
                }
            }
            let any = self.report.as_ref().is_some_and(|report| {
                report
                    .files
                    .iter()
                    .any(|file| matches!(file.status, FileStatus::Imported | FileStatus::Updated))
            });
            let take_button = Button::new(RichText::new(seen.say_text(words::TAKE)).strong());
            let take = ui.add_enabled(ready && looked && !changed && any, take_button);
            let tip = if looked && !changed {
                words::NOTHING_NEW
            } else {
                words::LOOK_FIRST
            };
            if take.on_disabled_hover_text(seen.say_text(tip)).clicked() {
                self.request_import(false, seen.out);
            }
        });
    }

    fn show_import_report(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let Some(report) = self.report.take() else {
            if self.wrong.is_none() && !seen.is_running(self.asked) {
                ui.weak(seen.say_text(words::NOTHING));
            }
            return;
        };
        ui.separator();
        let text = if report.dry_run { words::DRY } else { words::DONE };
        ui.strong(seen.say_text(text));
        let created: Vec<String> = import_data::created_row_counts(&report)
            .iter()
            .map(|(text, count)| fill_text_braces(seen.say_text(*text), &[("n", count)]))
            .collect();
        ui.label(created.join(" · "));
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let open = report.files.len() <= 2;
            for file in import_data::files_by_attention(&report) {
                import_files::show_file_report(&mut self.corrections, ui, seen, file, open, report.dry_run);
            }
        });
        self.report = Some(report);
    }
}

impl PaneInterface for ImportPane {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        self.choosing(ui, seen);
        let other = self.corpus_to_merge();
        if std::mem::take(&mut self.fresh) && other.is_none() {
            self.request_import(true, seen.out);
        }
        if let Some(other) = &other {
            let report = self.merged.as_ref();
            if let Some(begun) = import_together::show_corpus_merge(ui, seen, other, self.asked, report) {
                self.asked = Some(begun);
                (self.merged, self.wrong, self.stopped) = (None, None, false);
            }
        } else {
            import_known::show_import_corrections(&mut self.corrections, ui, seen);
            self.show_import_buttons(ui, seen);
        }
        if let Some((wrong, remedy)) = &self.wrong {
            let message = translate_library_message(wrong, seen.language);
            ui.label(RichText::new(message).color(seen.pane_colours().trouble));
            let remedy = remedy
                .as_ref()
                .and_then(|remedy| window_remedy::window_remedy_text(remedy, seen.language));
            if let Some(remedy) = remedy {
                ui.label(fill_text_braces(seen.say_text(shell::REMEDY), &[("remedy", &remedy)]));
            }
        }
        if self.stopped {
            ui.label(seen.say_text(shell::STOPPED));
        }
        if other.is_none() {
            self.show_import_report(ui, seen);
        }
    }

    fn receive_work_result(&mut self, id: WorkId, ended: &WorkResult) {
        if self.asked.take_if(|asked| *asked == id).is_none() {
            return;
        }
        match ended {
            Ok(WorkOutcome::Imported(report)) => self.report = Some(report.clone()),
            Ok(WorkOutcome::Merged(report)) => self.merged = Some(report.clone()),
            Err(chereme_corpus::CorpusError::Stopped) => self.stopped = true,
            Ok(_) => {}
            Err(error) => {
                self.wrong = Some((error.to_string(), error.error_remedy()));
            }
        }
    }

    fn come(&mut self) {
        // Given files are examined; the keyboard is not given to the path, whose list would cover the next button.
        self.come = self.paths_to_examine().is_empty();
    }
}
