//! Deletes the recording or sign that is chosen in the list; asks first if others depend on it.

use chereme_corpus::{CorpusAddress, DeleteOptions, DeletionReport, DependentsPolicy, RowName};
use eframe::egui::{Align2, Id, Key, Modifiers, ScrollArea, Ui, Window, vec2};

use super::library_data::LibrarySignRow;
use super::{LibraryList, LibraryPane};
use crate::action::Action;
use crate::command::CommandOutbox;
use crate::context::PaneInput;
use crate::panes::ActionOutcome;
use crate::words::{fill_text_braces, library as words, shell};
use crate::work::{WorkId, WorkOutcome, WorkResult, recordings_jobs};

/// The largest height of the list of dependents, in points.
const DEPENDENTS_LIST_HEIGHT: f32 = 180.0;

/// A recording or sign on its way out.
#[derive(Debug, Default)]
pub(super) enum DeletionState {
    /// Nothing is to be deleted.
    #[default]
    Nothing,
    /// The corpus looks for what depends on it.
    Examined(DeletionTarget, WorkId),
    /// Nothing depends on it.
    Free(DeletionTarget),
    /// The user decides what happens to its dependents.
    Asked(DeletionTarget, Box<DeletionReport>),
}

/// The recording or sign that is to be deleted.
#[derive(Debug, Clone)]
pub(super) struct DeletionTarget {
    address: CorpusAddress,
    name: String,
}

impl LibraryPane {
    /// Returns the row of the list with the keyboard focus, otherwise the chosen one.
    fn doomed(&self, seen: &PaneInput<'_>) -> Option<DeletionTarget> {
        match self.listed_library(seen) {
            LibraryList::Recordings => {
                let rows = &self.rows.recordings;
                let shown = || rows.iter().find(|row| seen.shown.recording == Some(row.id));
                let row = self.focused.and_then(|at| rows.get(at)).or_else(shown)?;
                Some(recording_deletion_target(row.id, &row.name))
            }
            LibraryList::Signs => {
                let rows = &self.rows.signs;
                let chosen = || {
                    let chosen = self.chosen.as_ref()?.id;
                    rows.iter().find(|row| row.id == chosen)
                };
                let row = self.focused.and_then(|at| rows.get(at)).or_else(chosen)?;
                Some(sign_deletion_target(row))
            }
            LibraryList::People => None,
        }
    }

    /// Deletes the chosen recording or sign, unless something depends on it.
    pub(super) fn delete_chosen(&mut self, seen: &PaneInput<'_>) -> ActionOutcome {
        match self.doomed(seen) {
            Some(doomed) => {
                self.request_deletion(doomed, seen.out);
                ActionOutcome::Yes
            }
            None => ActionOutcome::Cannot(words::NONE_CHOSEN),
        }
    }

    pub(super) fn request_deletion(&mut self, doomed: DeletionTarget, out: &CommandOutbox) {
        let options = DeleteOptions {
            dry_run: true,
            ..DeleteOptions::default()
        };
        let id = out.request_work(recordings_jobs::delete_recordings_job(
            vec![doomed.address.clone()],
            options,
        ));
        self.leaving = DeletionState::Examined(doomed, id);
    }

    /// Draws the entry of a context menu that deletes a row.
    pub(super) fn delete_entry(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, doomed: impl FnOnce() -> DeletionTarget) {
        let row = Action::DeleteListed.action_row();
        let keys = seen.keys.action_keys_text(row.action);
        let button = eframe::egui::Button::new(seen.say_text(row.name)).shortcut_text(keys);
        let may = !seen.snapshot.is_read_only();
        if ui.add_enabled(may, button).clicked() {
            self.request_deletion(doomed(), seen.out);
            ui.close();
        }
    }

    pub(super) fn hear_deletion(&mut self, id: WorkId, ended: &WorkResult) {
        let DeletionState::Examined(_, own) = &self.leaving else {
            return;
        };
        if *own != id {
            return;
        }
        let DeletionState::Examined(doomed, _) = std::mem::take(&mut self.leaving) else {
            return;
        };
        if let Ok(WorkOutcome::Deleted(report)) = ended {
            self.leaving = match report.dependents.is_empty() {
                true => DeletionState::Free(doomed),
                false => DeletionState::Asked(doomed, Box::new(report.clone())),
            };
        }
    }

    /// Deletes what nothing depends on; otherwise shows the question what happens to the dependents.
    pub(super) fn show_deletion(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        match std::mem::take(&mut self.leaving) {
            DeletionState::Free(doomed) => {
                seen.request_work(recordings_jobs::delete_recordings_job(
                    vec![doomed.address],
                    DeleteOptions::default(),
                ));
            }
            DeletionState::Asked(doomed, report) => match ask_about_deletion(ui, seen, &doomed, &report) {
                DeletionAnswer::Waits => self.leaving = DeletionState::Asked(doomed, report),
                DeletionAnswer::Cancel => {}
                DeletionAnswer::Do(dependents) => {
                    let options = DeleteOptions {
                        dependents,
                        dry_run: false,
                    };
                    seen.request_work(recordings_jobs::delete_recordings_job(vec![doomed.address], options));
                }
            },
            other => self.leaving = other,
        }
    }
}

pub(super) fn recording_deletion_target(id: i64, name: &str) -> DeletionTarget {
    DeletionTarget {
        address: CorpusAddress::Recording(RowName::Number(id)),
        name: name.to_owned(),
    }
}

pub(super) fn sign_deletion_target(row: &LibrarySignRow) -> DeletionTarget {
    DeletionTarget {
        // Several lexicons may have the gloss.
        address: CorpusAddress::Sign(RowName::Number(row.id)),
        name: row.gloss.clone(),
    }
}

/// The answer to the question what happens to the dependents.
enum DeletionAnswer {
    Waits,
    Cancel,
    Do(DependentsPolicy),
}

fn ask_about_deletion(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    doomed: &DeletionTarget,
    report: &DeletionReport,
) -> DeletionAnswer {
    let mut answer = DeletionAnswer::Waits;
    if ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
        return DeletionAnswer::Cancel;
    }
    let annotated = report.dependents.iter().any(|dependent| dependent.start_us.is_some());
    let (why, delete) = match annotated {
        true => (words::DELETE_ANNOTATED, words::DELETE_WITH_ANNOTATIONS),
        false => (words::DELETE_SOURCE, words::DELETE_WITH_MADE),
    };
    let title = fill_text_braces(seen.say_text(words::DELETE_TITLE), &[("name", &doomed.name)]);
    Window::new(title)
        .id(Id::unique("library delete"))
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, vec2(0.0, 0.0))
        .show(ui.ctx(), |ui| {
            ui.set_max_width(360.0);
            ui.label(fill_text_braces(seen.say_text(why), &[("name", &doomed.name)]));
            ScrollArea::vertical()
                .max_height(DEPENDENTS_LIST_HEIGHT)
                .show(ui, |ui| {
                    let mut last = None;
                    for it in &report.dependents {
                        if last != Some(&it.recording) {
                            ui.label(format!("• {}", it.recording));
                        }
                        last = Some(&it.recording);
                    }
                });
            ui.add_space(8.0);
            ui.horizontal_wrapped(|ui| {
                if ui.button(seen.say_text(delete)).clicked() {
                    answer = DeletionAnswer::Do(DependentsPolicy::Delete);
                }
                // Annotations cannot stay without their recording; generated signs can.
                if !annotated && ui.button(seen.say_text(words::DELETE_KEEPING)).clicked() {
                    answer = DeletionAnswer::Do(DependentsPolicy::Keep);
                }
                if ui.button(seen.say_text(shell::CANCEL)).clicked() {
                    answer = DeletionAnswer::Cancel;
                }
            });
        });
    answer
}
