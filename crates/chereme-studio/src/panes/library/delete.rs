//! Deletes the recording or sign that is chosen in the list; asks first if others depend on it.

use chereme_corpus::{Address, DeleteOptions, Deleted, Dependents, Name};
use eframe::egui::{Align2, Id, Key, Modifiers, ScrollArea, Ui, Window, vec2};

use super::{Library, List};
use crate::action::Action;
use crate::context::{Outbox, PaneInput};
use crate::panes::Acted;
use crate::words::{fill, library as words, shell};
use crate::work::{Ended, Outcome, WorkId, recordings};

/// The largest height of the list of dependents, in points.
const LIST: f32 = 180.0;

/// A recording or sign on its way out.
#[derive(Debug, Default)]
pub(super) enum Leaving {
    /// Nothing is to be deleted.
    #[default]
    Nothing,
    /// The corpus looks for what depends on it.
    Examined(Doomed, WorkId),
    /// Nothing depends on it.
    Free(Doomed),
    /// The user decides what happens to its dependents.
    Asked(Doomed, Box<Deleted>),
}

/// The recording or sign that is to be deleted.
#[derive(Debug, Clone)]
pub(super) struct Doomed {
    address: Address,
    name: String,
}

impl Library {
    /// Returns the row of the list with the keyboard focus, otherwise the chosen one.
    fn doomed(&self, seen: &PaneInput<'_>) -> Option<Doomed> {
        match self.listed(seen) {
            List::Recordings => {
                let rows = &self.rows.recordings;
                let shown = || rows.iter().find(|row| seen.shown.recording == Some(row.id));
                let row = self.focused.and_then(|at| rows.get(at)).or_else(shown)?;
                Some(recording(row.id, &row.name))
            }
            List::Signs => {
                let rows = &self.rows.signs;
                let chosen = || {
                    let gloss = &self.chosen.as_ref()?.gloss;
                    rows.iter().find(|row| row.gloss == *gloss)
                };
                let row = self.focused.and_then(|at| rows.get(at)).or_else(chosen)?;
                Some(sign(&row.gloss))
            }
        }
    }

    /// Deletes the chosen recording or sign, unless something depends on it.
    pub(super) fn delete_chosen(&mut self, seen: &PaneInput<'_>, out: &mut Outbox) -> Acted {
        match self.doomed(seen) {
            Some(doomed) => {
                self.delete(doomed, out);
                Acted::Yes
            }
            None => Acted::Cannot(words::NONE_CHOSEN),
        }
    }

    pub(super) fn delete(&mut self, doomed: Doomed, out: &mut Outbox) {
        let options = DeleteOptions {
            dry_run: true,
            ..DeleteOptions::default()
        };
        let id = out.work(recordings::delete(vec![doomed.address.clone()], options));
        self.leaving = Leaving::Examined(doomed, id);
    }

    /// Draws the entry of a context menu that deletes a row.
    pub(super) fn delete_entry(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        doomed: impl FnOnce() -> Doomed,
        out: &mut Outbox,
    ) {
        let row = Action::DeleteListed.row();
        let keys = seen.keys.text(row.action);
        let button = eframe::egui::Button::new(seen.say(row.name)).shortcut_text(keys);
        let may = !seen.snapshot.is_read_only();
        if ui.add_enabled(may, button).clicked() {
            self.delete(doomed(), out);
            ui.close();
        }
    }

    pub(super) fn hear_deletion(&mut self, id: WorkId, ended: &Ended) {
        let Leaving::Examined(_, own) = &self.leaving else {
            return;
        };
        if *own != id {
            return;
        }
        let Leaving::Examined(doomed, _) = std::mem::take(&mut self.leaving) else {
            return;
        };
        if let Ok(Outcome::Deleted(report)) = ended {
            self.leaving = match report.dependents.is_empty() {
                true => Leaving::Free(doomed),
                false => Leaving::Asked(doomed, Box::new(report.clone())),
            };
        }
    }

    /// Deletes what nothing depends on; otherwise shows the question what happens to the dependents.
    pub(super) fn deletion(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        match std::mem::take(&mut self.leaving) {
            Leaving::Free(doomed) => {
                out.work(recordings::delete(
                    vec![doomed.address],
                    DeleteOptions::default(),
                ));
            }
            Leaving::Asked(doomed, report) => match ask(ui, seen, &doomed, &report) {
                Answer::Waits => self.leaving = Leaving::Asked(doomed, report),
                Answer::Cancel => {}
                Answer::Do(dependents) => {
                    let options = DeleteOptions {
                        dependents,
                        dry_run: false,
                    };
                    out.work(recordings::delete(vec![doomed.address], options));
                }
            },
            other => self.leaving = other,
        }
    }
}

pub(super) fn recording(id: i64, name: &str) -> Doomed {
    Doomed {
        address: Address::Recording(Name::Number(id)),
        name: name.to_owned(),
    }
}

pub(super) fn sign(gloss: &str) -> Doomed {
    Doomed {
        address: Address::Sign(Name::Text(gloss.to_owned())),
        name: gloss.to_owned(),
    }
}

/// The answer to the question what happens to the dependents.
enum Answer {
    Waits,
    Cancel,
    Do(Dependents),
}

fn ask(ui: &mut Ui, seen: &PaneInput<'_>, doomed: &Doomed, report: &Deleted) -> Answer {
    let mut answer = Answer::Waits;
    if ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
        return Answer::Cancel;
    }
    let annotated = report.dependents.iter().any(|it| it.start_us.is_some());
    let (why, delete) = match annotated {
        true => (words::DELETE_ANNOTATED, words::DELETE_WITH_ANNOTATIONS),
        false => (words::DELETE_SOURCE, words::DELETE_WITH_MADE),
    };
    let title = fill(seen.say(words::DELETE_TITLE), &[("name", &doomed.name)]);
    Window::new(title)
        .id(Id::unique("library delete"))
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, vec2(0.0, 0.0))
        .show(ui.ctx(), |ui| {
            ui.set_max_width(360.0);
            ui.label(fill(seen.say(why), &[("name", &doomed.name)]));
            ScrollArea::vertical().max_height(LIST).show(ui, |ui| {
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
                if ui.button(seen.say(delete)).clicked() {
                    answer = Answer::Do(Dependents::Delete);
                }
                if !annotated && ui.button(seen.say(words::DELETE_KEEPING)).clicked() {
                    answer = Answer::Do(Dependents::Keep);
                }
                if ui.button(seen.say(shell::CANCEL)).clicked() {
                    answer = Answer::Cancel;
                }
            });
        });
    answer
}
