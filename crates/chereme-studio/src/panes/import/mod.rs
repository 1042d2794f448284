//! Import: shows the interpretation of files before anything is written, takes corrections, and then writes.

mod body;
mod data;
mod files;
mod known;
mod paths;
pub(super) mod people;
mod together;

use std::path::PathBuf;

use chereme_corpus::remedy::Remedy;
use chereme_corpus::{FileStatus, ImportReport, MergeReport};
use eframe::egui::{Align, Button, Id, Layout, ProgressBar, RichText, ScrollArea, Ui};

use super::Pane;
use super::complete::Line;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::file_dialogs::Choose;
use crate::overlay::remedy;
use crate::words::{fill, import as words, shell, spoken};
use crate::work::{Ended, Outcome, WorkId, exchange};
use known::ImportCorrections;
pub(crate) use paths::Paths;

/// The pane.
#[derive(Default)]
pub(crate) struct Import {
    path: String,
    /// The dropped or chosen files, if there are several.
    dropped: Vec<PathBuf>,
    paths: Paths,
    corrections: ImportCorrections,
    /// The corrections at the last examination of the files.
    looked: ImportCorrections,
    asked: Option<WorkId>,
    report: Option<ImportReport>,
    /// The outcome of a merge.
    merged: Option<MergeReport>,
    /// Why nothing could be examined: a message and a remedy.
    wrong: Option<(String, Option<Remedy>)>,
    /// Whether the work was stopped.
    stopped: bool,
    /// Whether files were just given, which must be examined.
    fresh: bool,
    come: bool,
}

impl Import {
    /// Sets the paths to examine.
    pub(crate) fn propose(&mut self, paths: &[PathBuf]) {
        self.path = match paths {
            [one] => one.display().to_string(),
            _ => String::new(),
        };
        self.dropped = paths.to_vec();
        (self.report, self.merged, self.wrong) = (None, None, None);
        self.fresh = !paths.is_empty();
    }

    fn files(&self) -> Vec<PathBuf> {
        match self.path.trim() {
            "" => self.dropped.clone(),
            path => vec![PathBuf::from(path)],
        }
    }

    /// Returns the path if it names a corpus, which is merged rather than imported.
    fn other(&self) -> Option<PathBuf> {
        match self.files().as_slice() {
            [one] if together::is_corpus(one) => Some(one.clone()),
            _ => None,
        }
    }

    fn ask(&mut self, dry_run: bool, out: &mut Outbox) {
        if let Some(old) = self.asked.take() {
            out.send(Command::Stop(old));
        }
        let options = self.corrections.options(dry_run);
        self.looked = self.corrections.clone();
        (self.wrong, self.stopped) = (None, false);
        self.asked = Some(out.work(exchange::import(self.files(), options)));
    }

    fn choosing(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let label = ui.label(RichText::new(seen.say(words::PATH)).small());
        let id = Id::unique("import path");
        let line = Line {
            hint: seen.say(words::PATH_HINT),
            ..Line::default()
        };
        if std::mem::take(&mut self.come) {
            ui.memory_mut(|memory| memory.request_focus(id));
        }
        let typed = self.paths.show(ui, id, line, &mut self.path);
        let (entered, changed) = (typed.entered, typed.changed);
        typed.response.labelled_by(label.id);
        if changed {
            (self.report, self.merged) = (None, None);
        }
        // After a folder is taken from the list, its contents are offered next.
        let whole = !changed || !self.path.ends_with('/');
        if entered && whole && !self.files().is_empty() && self.other().is_none() {
            self.ask(true, out);
        }
        ui.horizontal_wrapped(|ui| {
            if ui.button(seen.say(words::CHOOSE_FILES)).clicked() {
                out.send(Command::Choose(Choose::Files));
            }
            if ui.button(seen.say(words::CHOOSE_FOLDER)).clicked() {
                out.send(Command::Choose(Choose::Folder));
            }
        });
        if self.path.trim().is_empty() {
            for path in self.dropped.iter().take(8) {
                ui.small(path.display().to_string());
            }
            if self.dropped.len() > 8 {
                let more = self.dropped.len() - 8;
                ui.small(fill(seen.say(words::MORE_FILES), &[("n", &more)]));
            }
        }
    }

    fn buttons(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let running = self.asked.and_then(|id| seen.running.get(&id));
        if let (Some(running), Some(id)) = (running, self.asked) {
            // At the other end from the buttons that are clicked before and after this one.
            ui.horizontal(|ui| {
                match running.far.share() {
                    Some(share) => {
                        let bar = ProgressBar::new(share).desired_width(120.0);
                        ui.add(bar.show_percentage());
                    }
                    None => drop(ui.spinner()),
                }
                let cancel = Button::new(seen.say(shell::CANCEL));
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    if ui.add(cancel).clicked() {
                        out.send(Command::Stop(id));
                    }
                    let task = eframe::egui::Label::new(&running.far.task);
                    ui.add(task.truncate());
                });
            });
            return;
        }
        let ready = !self.files().is_empty();
        let looked = self.report.as_ref().is_some_and(|report| report.dry_run);
        let changed = looked && self.looked != self.corrections;
        ui.horizontal_wrapped(|ui| {
            let text = if looked {
                words::LOOK_AGAIN
            } else {
                words::LOOK
            };
            if !looked || changed {
                let look = Button::new(seen.say(text));
                if ui.add_enabled(ready, look).clicked() {
                    self.ask(true, out);
                }
            }
            let any = self.report.as_ref().is_some_and(|report| {
                report
                    .files
                    .iter()
                    .any(|file| matches!(file.status, FileStatus::Imported | FileStatus::Updated))
            });
            let take = Button::new(RichText::new(seen.say(words::TAKE)).strong());
            let take = ui.add_enabled(ready && looked && !changed && any, take);
            let tip = if looked && !changed {
                words::NOTHING_NEW
            } else {
                words::LOOK_FIRST
            };
            if take.on_disabled_hover_text(seen.say(tip)).clicked() {
                self.ask(false, out);
            }
        });
    }

    fn report(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let Some(report) = self.report.take() else {
            if self.wrong.is_none() && !seen.is_running(self.asked) {
                ui.weak(seen.say(words::NOTHING));
            }
            return;
        };
        ui.separator();
        let text = if report.dry_run {
            words::DRY
        } else {
            words::DONE
        };
        ui.strong(seen.say(text));
        let created: Vec<String> = data::created(&report)
            .iter()
            .map(|(text, count)| fill(seen.say(*text), &[("n", count)]))
            .collect();
        ui.label(created.join(" · "));
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let open = report.files.len() <= 2;
            for file in data::in_order(&report) {
                files::show(
                    &mut self.corrections,
                    ui,
                    seen,
                    file,
                    (open, report.dry_run),
                    out,
                );
            }
        });
        self.report = Some(report);
    }
}

impl Pane for Import {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        self.choosing(ui, seen, out);
        let other = self.other();
        if std::mem::take(&mut self.fresh) && other.is_none() {
            self.ask(true, out);
        }
        if let Some(other) = &other {
            let state = (self.asked, self.merged.as_ref());
            if let Some(begun) = together::show(ui, seen, out, other, state) {
                self.asked = Some(begun);
                (self.merged, self.wrong, self.stopped) = (None, None, false);
            }
        } else {
            known::show(&mut self.corrections, ui, seen);
            self.buttons(ui, seen, out);
        }
        if let Some((wrong, remedy)) = &self.wrong {
            let message = spoken(wrong, seen.language);
            ui.label(RichText::new(message).color(seen.colours().trouble));
            let remedy = remedy
                .as_ref()
                .and_then(|it| remedy::here(it, seen.language));
            if let Some(remedy) = remedy {
                ui.label(fill(seen.say(shell::REMEDY), &[("remedy", &remedy)]));
            }
        }
        if self.stopped {
            ui.label(seen.say(shell::STOPPED));
        }
        if other.is_none() {
            self.report(ui, seen, out);
        }
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        if self.asked.take_if(|asked| *asked == id).is_none() {
            return;
        }
        match ended {
            Ok(Outcome::Imported(report)) => self.report = Some(report.clone()),
            Ok(Outcome::Merged(report)) => self.merged = Some(report.clone()),
            Err(chereme_corpus::Error::Stopped) => self.stopped = true,
            Ok(_) => {}
            Err(error) => {
                self.wrong = Some((error.to_string(), error.remedy()));
            }
        }
    }

    fn come(&mut self) {
        // Given files are examined; the keyboard is not given to the path, whose list would cover the next button.
        self.come = self.files().is_empty();
    }
}
