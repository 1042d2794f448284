//! Fits a body to the markers of the chosen recording; asks first whose they are if they are those of several people.

use chereme_corpus::Name;
use eframe::egui::{Align2, Button, Id, Key, Modifiers, ScrollArea, Ui, Window, vec2};

use super::data::LibraryRow;
use super::{Library, List};
use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::panes::Acted;
use crate::words::{fill, library as words, shell};
use crate::work::{Ended, Outcome, WorkId, recordings};

/// The largest height of the list of people, in points.
const LIST: f32 = 240.0;

/// A recording whose markers get a body.
#[derive(Debug, Clone)]
pub(super) struct Marked {
    id: i64,
    name: String,
}

/// How far the fit of a body has come.
#[derive(Debug, Default)]
pub(super) enum Fitting {
    /// No body is to be fitted.
    #[default]
    Nothing,
    /// The corpus looks for the people of the markers.
    Examined(Marked, WorkId),
    /// The people of the markers; none if they are those of one person.
    Known(Marked, Vec<String>),
}

impl Library {
    /// Fits a body to the markers of the recording with the keyboard focus, otherwise of the one on display.
    pub(super) fn fit_chosen(&mut self, seen: &PaneInput<'_>, out: &mut Outbox) -> Acted {
        let rows = &self.rows.recordings;
        let focused = match self.listed(seen) {
            List::Recordings => self.focused.and_then(|at| rows.get(at)).map(|row| row.id),
            List::Signs => None,
        };
        let all = &seen.snapshot.overview.recordings;
        let wanted = focused.or(seen.shown.recording);
        let glance = all.iter().find(|it| Some(it.row.id) == wanted);
        let Some(glance) = glance.filter(|it| super::data::has_markers(it)) else {
            return Acted::Cannot(words::NO_MARKERS);
        };
        let marked = Marked {
            id: glance.row.id,
            name: glance.row.name.clone(),
        };
        self.fit(marked, out);
        // The question is asked where the recording is listed.
        out.send(Command::Do(Action::ShowLibrary));
        Acted::Yes
    }

    fn fit(&mut self, marked: Marked, out: &mut Outbox) {
        let id = out.work(recordings::marker_people(Name::Number(marked.id)));
        self.fitting = Fitting::Examined(marked, id);
    }

    /// Draws the entry of a context menu that fits a body to the markers of a recording.
    pub(super) fn fit_entry(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        row: &LibraryRow,
        out: &mut Outbox,
    ) {
        let button = Button::new(seen.say(Action::FitMarkers.row().name));
        let may = !seen.snapshot.is_read_only();
        if ui.add_enabled(may, button).clicked() {
            let marked = Marked {
                id: row.id,
                name: row.name.clone(),
            };
            self.fit(marked, out);
            ui.close();
        }
    }

    pub(super) fn hear_people(&mut self, id: WorkId, ended: &Ended) {
        let Fitting::Examined(marked, own) = &self.fitting else {
            return;
        };
        if *own == id {
            self.fitting = match ended {
                Ok(Outcome::People(people)) => Fitting::Known(marked.clone(), people.clone()),
                _ => Fitting::Nothing,
            };
        }
    }

    /// Fits a body to the markers of one person; shows the question whose they are if there are several.
    pub(super) fn fitting(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        match std::mem::take(&mut self.fitting) {
            Fitting::Known(marked, people) => {
                let answer = match people.is_empty() {
                    true => Answer::Fit(None),
                    false => ask(ui, seen, &marked, &people),
                };
                match answer {
                    Answer::Waits => self.fitting = Fitting::Known(marked, people),
                    Answer::Cancel => {}
                    Answer::Fit(subject) => {
                        out.work(recordings::fit_markers(Name::Number(marked.id), subject));
                    }
                }
            }
            other => self.fitting = other,
        }
    }
}

/// The answer to the question whose markers get a body.
enum Answer {
    Waits,
    Cancel,
    Fit(Option<String>),
}

fn ask(ui: &mut Ui, seen: &PaneInput<'_>, marked: &Marked, people: &[String]) -> Answer {
    let mut answer = Answer::Waits;
    if ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
        return Answer::Cancel;
    }
    Window::new(seen.say(words::FIT_TITLE))
        .id(Id::unique("library fit"))
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, vec2(0.0, 0.0))
        .show(ui.ctx(), |ui| {
            ui.set_max_width(360.0);
            ui.label(fill(seen.say(words::FIT_PEOPLE), &[("name", &marked.name)]));
            ScrollArea::vertical().max_height(LIST).show(ui, |ui| {
                for name in people {
                    if ui.button(name).clicked() {
                        answer = Answer::Fit(Some(name.clone()));
                    }
                }
            });
            ui.add_space(8.0);
            if ui.button(seen.say(shell::CANCEL)).clicked() {
                answer = Answer::Cancel;
            }
        });
    answer
}
