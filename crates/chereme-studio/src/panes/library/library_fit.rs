//! Fits a body to the markers of the chosen recording; asks first whose they are if they are those of several people.

use chereme_corpus::RowName;
use eframe::egui::{Align2, Button, Id, Key, Modifiers, ScrollArea, Ui, Window, vec2};

use super::library_data::LibraryRow;
use super::{LibraryList, LibraryPane};
use crate::action::Action;
use crate::command::{CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::panes::ActionOutcome;
use crate::words::{fill_text_braces, library as words, shell};
use crate::work::{WorkId, WorkOutcome, WorkResult, recordings_jobs};

/// The largest height of the list of people, in points.
const PEOPLE_LIST_HEIGHT: f32 = 240.0;

/// A recording whose markers get a body.
#[derive(Debug, Clone)]
pub(super) struct MarkedRecording {
    id: i64,
    name: String,
}

/// How far the fit of a body has come.
#[derive(Debug, Default)]
pub(super) enum BodyFitState {
    /// No body is to be fitted.
    #[default]
    Nothing,
    /// The corpus looks for the people of the markers.
    Examined(MarkedRecording, WorkId),
    /// The people of the markers; none if they are those of one person.
    Known(MarkedRecording, Vec<String>),
}

impl LibraryPane {
    /// Fits a body to the markers of the recording with the keyboard focus, otherwise of the one on display.
    pub(super) fn fit_chosen(&mut self, seen: &PaneInput<'_>) -> ActionOutcome {
        let rows = &self.rows.recordings;
        let focused = match self.listed_library(seen) {
            LibraryList::Recordings => self.focused.and_then(|at| rows.get(at)).map(|row| row.id),
            LibraryList::Signs | LibraryList::People => None,
        };
        let all = &seen.snapshot.overview.recordings;
        let wanted = focused.or(seen.shown.recording);
        let glance = all.iter().find(|glance| Some(glance.row.id) == wanted);
        let Some(glance) = glance.filter(|glance| super::library_data::has_markers(glance)) else {
            return ActionOutcome::Cannot(words::NO_MARKERS);
        };
        let marked = MarkedRecording {
            id: glance.row.id,
            name: glance.row.name.clone(),
        };
        self.request_body_fit(marked, seen.out);
        // The question is asked where the recording is listed.
        seen.send_command(WindowCommand::Do(Action::ShowLibrary));
        ActionOutcome::Yes
    }

    fn request_body_fit(&mut self, marked: MarkedRecording, out: &CommandOutbox) {
        let id = out.request_work(recordings_jobs::marker_people(RowName::Number(marked.id)));
        self.fitting = BodyFitState::Examined(marked, id);
    }

    /// Draws the entry of a context menu that fits a body to the markers of a recording.
    pub(super) fn fit_entry(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, row: &LibraryRow) {
        let button = Button::new(seen.say_text(Action::FitMarkers.action_row().name));
        let may = !seen.snapshot.is_read_only();
        if ui.add_enabled(may, button).clicked() {
            let marked = MarkedRecording {
                id: row.id,
                name: row.name.clone(),
            };
            self.request_body_fit(marked, seen.out);
            ui.close();
        }
    }

    pub(super) fn hear_people(&mut self, id: WorkId, ended: &WorkResult) {
        let BodyFitState::Examined(marked, own) = &self.fitting else {
            return;
        };
        if *own == id {
            self.fitting = match ended {
                Ok(WorkOutcome::People(people)) => BodyFitState::Known(marked.clone(), people.clone()),
                _ => BodyFitState::Nothing,
            };
        }
    }

    /// Fits a body to the markers of one person; shows the question whose they are if there are several.
    pub(super) fn show_body_fit(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        match std::mem::take(&mut self.fitting) {
            BodyFitState::Known(marked, people) => {
                let answer = match people.is_empty() {
                    true => BodyFitAnswer::Fit(None),
                    false => ask_whose_markers(ui, seen, &marked, &people),
                };
                match answer {
                    BodyFitAnswer::Waits => self.fitting = BodyFitState::Known(marked, people),
                    BodyFitAnswer::Cancel => {}
                    BodyFitAnswer::Fit(subject) => {
                        seen.request_work(recordings_jobs::fit_markers(RowName::Number(marked.id), subject));
                    }
                }
            }
            other => self.fitting = other,
        }
    }
}

/// The answer to the question whose markers get a body.
enum BodyFitAnswer {
    Waits,
    Cancel,
    Fit(Option<String>),
}

fn ask_whose_markers(ui: &mut Ui, seen: &PaneInput<'_>, marked: &MarkedRecording, people: &[String]) -> BodyFitAnswer {
    let mut answer = BodyFitAnswer::Waits;
    if ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
        return BodyFitAnswer::Cancel;
    }
    Window::new(seen.say_text(words::FIT_TITLE))
        .id(Id::unique("library fit"))
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, vec2(0.0, 0.0))
        .show(ui.ctx(), |ui| {
            ui.set_max_width(360.0);
            ui.label(fill_text_braces(
                seen.say_text(words::FIT_PEOPLE),
                &[("name", &marked.name)],
            ));
            ScrollArea::vertical().max_height(PEOPLE_LIST_HEIGHT).show(ui, |ui| {
                for name in people {
                    if ui.button(name).clicked() {
                        answer = BodyFitAnswer::Fit(Some(name.clone()));
                    }
                }
            });
            ui.add_space(8.0);
            if ui.button(seen.say_text(shell::CANCEL)).clicked() {
                answer = BodyFitAnswer::Cancel;
            }
        });
    answer
}
