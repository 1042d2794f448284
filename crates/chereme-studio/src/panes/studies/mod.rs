//! Studies: plans with a preview of each clip, the questionnaire, the answers, and the report.

mod answers;
mod data;
mod draft;
mod questionnaire;
mod report;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use chereme_corpus::remedy::Remedy;
use chereme_corpus::study::plan::Plan;
use chereme_corpus::study::{StudyClip, StudyOverview};
use chereme_sign::Handedness;
use eframe::egui::{Button, Id, ProgressBar, ScrollArea, Ui};

use self::data::Draft;
use super::{Pane, list_row, reach_focus};
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::file_dialogs::Choose;
use crate::model::generated::GeneratedClip;
use crate::overlay::remedy;
use crate::panes::complete::Line;
use crate::panes::import::Paths;
use crate::words::{Text, fill, shell, spoken, studies as words};
use crate::work::{Ended, Outcome, WorkId, studying};

/// The part of the chosen study that is in sight.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum View {
    #[default]
    Plan,
    Questionnaire,
    Answers,
    Report,
}

const VIEWS: [(View, Text); 4] = [
    (View::Plan, words::PLAN),
    (View::Questionnaire, words::QUESTIONNAIRE),
    (View::Answers, words::ANSWERS),
    (View::Report, words::REPORT),
];

/// Why something could not be done.
#[derive(Debug)]
struct Wrong {
    text: String,
    remedy: Option<Remedy>,
}

impl From<&chereme_corpus::Error> for Wrong {
    fn from(error: &chereme_corpus::Error) -> Self {
        Self {
            text: error.to_string(),
            remedy: error.remedy(),
        }
    }
}

/// The pane.
#[derive(Default)]
pub(crate) struct Studies {
    /// The corpus generation of the last request for the studies.
    of: Option<i64>,
    listing: Option<WorkId>,
    all: Option<Arc<Vec<StudyOverview>>>,
    chosen: Option<String>,
    view: View,
    /// The plan that is being written, if its form is open.
    draft: Option<Draft>,
    /// A plan whose form was left before it was stored.
    unfinished: Option<Draft>,
    /// Whether the first widget takes the keyboard focus.
    come: bool,
    planning: Option<WorkId>,
    opening: Option<WorkId>,
    /// Whether the desktop had no program for a page.
    unopened: bool,
    wrong: Option<Wrong>,
    clip: Clip,
    /// The forms of the chosen study, and those of the others by their names: their work goes on.
    forms: Forms,
    others: BTreeMap<String, Forms>,
}

/// The forms, work and results of one study.
#[derive(Default)]
struct Forms {
    questionnaire: questionnaire::Form,
    answers: answers::Form,
    report: report::Shown,
    wrong: Option<Wrong>,
}

impl Forms {
    /// Takes the end of work that was requested from one of the forms; returns whether it was.
    fn hear(&mut self, id: WorkId, ended: &Ended) -> bool {
        let own = [
            &mut self.questionnaire.building,
            &mut self.answers.importing,
            &mut self.report.making,
            &mut self.report.saving,
        ];
        let mut is_own = false;
        for work in own {
            is_own |= work.take_if(|it| *it == id).is_some();
        }
        if !is_own {
            return false;
        }
        match ended {
            Ok(Outcome::QuestionnaireBuilt(done)) => {
                self.questionnaire.built = Some(done.as_ref().clone());
            }
            Ok(Outcome::AnswersImported(report)) => {
                self.answers.report = Some(report.as_ref().clone());
            }
            Ok(Outcome::Reported(report)) => self.report.found = Some(report.clone()),
            Ok(Outcome::ReportWritten(files)) => self.report.saved = files.first().cloned(),
            Ok(_) | Err(chereme_corpus::Error::Stopped) => {}
            Err(error) => self.wrong = Some(Wrong::from(error)),
        }
        true
    }
}

/// The clip of a trial that the stage shows next.
#[derive(Default)]
struct Clip {
    making: Option<WorkId>,
    /// The name and the text of the clip that was asked for last.
    of: Option<(String, String)>,
    made: Option<Arc<StudyClip>>,
}

impl Studies {
    fn follow(&mut self, seen: &PaneInput<'_>, out: &mut Outbox) {
        let generation = seen.snapshot.overview.generation;
        if self.of != Some(generation) && !seen.is_running(self.listing) {
            self.of = Some(generation);
            self.listing = Some(out.work(studying::list()));
        }
    }

    fn chosen(&self) -> Option<StudyOverview> {
        let all = self.all.as_ref()?;
        let chosen = self.chosen.as_deref()?;
        all.iter().find(|it| it.plan.name == chosen).cloned()
    }

    /// Takes files that were dropped on the window while the answers of a study are in sight; returns whether it did.
    pub(crate) fn drop_files(&mut self, paths: &[PathBuf]) -> bool {
        let fits = |path: &PathBuf| {
            let ending = path
                .extension()
                .map(|it| it.to_string_lossy().to_lowercase());
            path.is_dir() || ending.is_some_and(|it| ["json", "csv"].contains(&it.as_str()))
        };
        let takes = self.chosen.is_some()
            && self.draft.is_none()
            && self.view == View::Answers
            && paths.iter().all(fits);
        if takes {
            self.forms.answers.take(paths.to_vec());
        }
        takes
    }

    /// Takes the paths of a file chooser.
    pub(crate) fn take_paths(&mut self, what: Choose, paths: Vec<PathBuf>) {
        let first = paths.first().map(|it| it.display().to_string());
        match (what, first) {
            (Choose::Answers, Some(_)) => self.forms.answers.take(paths),
            (Choose::Questionnaire, Some(path)) => self.forms.questionnaire.to = path,
            (Choose::Report, Some(path)) => self.forms.report.to = path,
            _ => {}
        }
    }

    /// Asks for the clip of a trial, which is then shown on the stage.
    fn show_clip(&mut self, name: &str, text: &str, out: &mut Outbox) {
        if let Some(old) = self.clip.making.take() {
            out.send(Command::Stop(old));
        }
        self.wrong = None;
        self.clip = Clip {
            making: Some(out.work(studying::clip(text.to_owned()))),
            of: Some((name.to_owned(), text.to_owned())),
            made: None,
        };
    }

    /// Shows the clip on the stage once it is made.
    fn give_clip(&mut self, out: &mut Outbox) {
        let Some((made, (name, _))) = self.clip.made.take().zip(self.clip.of.clone()) else {
            return;
        };
        let clip = GeneratedClip {
            name,
            token: None,
            clip: made.clip.clone(),
            faces: made.faces.clone(),
            anatomy: made.anatomy.clone(),
            handedness: Handedness::default(),
            parts: Vec::new(),
        };
        out.send(Command::Made(Some(Arc::new(clip))));
        out.send(Command::Look);
    }

    /// Shows the trials of a plan; a click shows the clip of one on the stage.
    fn trials(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, plan: &Plan, out: &mut Outbox) {
        let rows = data::trials(plan, seen.language);
        ui.weak(fill(seen.say(words::TRIALS), &[("n", &rows.len())]));
        if seen.is_running(self.clip.making) {
            ui.horizontal(|ui| {
                ui.spinner();
                ui.weak(seen.say(words::MAKING));
            });
        }
        let height = ui.spacing().interact_size.y * 1.9;
        let whole = height + ui.spacing().item_spacing.y;
        let room = (whole * rows.len() as f32).min(320.0);
        let mut picked = None;
        ScrollArea::vertical()
            .id_salt("trials")
            .max_height(room)
            .auto_shrink([false, true])
            .show_rows(ui, height, rows.len(), |ui, range| {
                for (name, clip) in &rows[range] {
                    let own = (name, clip);
                    let chosen = self
                        .clip
                        .of
                        .as_ref()
                        .is_some_and(|it| (&it.0, &it.1) == own);
                    if list_row(ui, height, chosen, name, clip).clicked() {
                        picked = Some((name.clone(), clip.clone()));
                    }
                }
            });
        if let Some((name, clip)) = picked {
            self.show_clip(&name, &clip, out);
        }
    }

    /// Shows all studies, and the button that begins a new one.
    fn list(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let all = self.all.clone().unwrap_or_default();
        if all.is_empty() && self.all.is_some() {
            ui.label(seen.say(words::NONE));
        }
        let height = ui.spacing().interact_size.y * 1.9;
        for it in all.iter() {
            let name = &it.plan.name;
            let chosen = self.chosen.as_ref() == Some(name);
            let about = data::about(it, seen.language);
            let row = list_row(ui, height, chosen, name, &about);
            if std::mem::take(&mut self.come) {
                row.request_focus();
            }
            if row.clicked() {
                self.choose(name.clone());
            }
        }
        let open = !seen.snapshot.is_read_only();
        let mut begun = None;
        ui.horizontal_wrapped(|ui| {
            let new = ui.add_enabled(open, Button::new(seen.say(words::NEW)));
            let new = new.on_disabled_hover_text(seen.say(shell::READ_ONLY_WHY));
            if self.all.is_some() && std::mem::take(&mut self.come) {
                new.request_focus();
            }
            if new.clicked() {
                begun = Some(Draft::default());
            }
            if self.unfinished.is_some() && ui.button(seen.say(words::CONTINUE)).clicked() {
                begun = self.unfinished.take();
            }
        });
        if begun.is_some() {
            (self.draft, self.wrong, self.come) = (begun, None, true);
        }
    }

    fn choose(&mut self, name: String) {
        if self.chosen.as_ref() == Some(&name) {
            return;
        }
        let forms = self.others.remove(&name).unwrap_or_default();
        let before = std::mem::replace(&mut self.forms, forms);
        if let Some(old) = self.chosen.replace(name) {
            self.others.insert(old, before);
        }
        self.wrong = None;
    }

    /// Shows the chosen study.
    fn study(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, it: &StudyOverview, out: &mut Outbox) {
        ui.separator();
        ui.horizontal_wrapped(|ui| {
            for (view, name) in VIEWS {
                ui.selectable_value(&mut self.view, view, seen.say(name));
            }
        });
        match self.view {
            View::Plan => self.plan(ui, seen, it, out),
            View::Questionnaire => questionnaire::show(self, ui, seen, it, out),
            View::Answers => answers::show(self, ui, seen, it, out),
            View::Report => report::show(self, ui, seen, it, out),
        }
    }

    fn plan(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, it: &StudyOverview, out: &mut Outbox) {
        for question in &it.plan.questions {
            let answers = data::answers(question);
            let values: [(&str, &dyn std::fmt::Display); 2] =
                [("name", &question.name), ("answers", &answers)];
            ui.label(fill(seen.say(words::ASKED), &values));
        }
        self.trials(ui, seen, &it.plan, out);
        if it.participants == 0 {
            ui.weak(seen.say(words::CAN_CHANGE));
        }
        let open = !seen.snapshot.is_read_only();
        let delete = ui.add_enabled(open, Button::new(seen.say(words::DELETE)));
        let delete = delete
            .on_hover_text(seen.say(words::DELETE_TIP))
            .on_disabled_hover_text(seen.say(shell::READ_ONLY_WHY));
        if delete.clicked() {
            out.work(studying::delete(it.plan.name.clone()));
        }
    }

    /// Removes the results and errors of earlier work.
    fn clear(&mut self) {
        (self.wrong, self.forms.wrong) = (None, None);
    }

    fn trouble(&self, ui: &mut Ui, seen: &PaneInput<'_>, wrong: Option<&Wrong>) {
        if self.unopened {
            ui.colored_label(seen.colours().warning, seen.say(words::NOT_OPENED));
        }
        let Some(wrong) = wrong else { return };
        ui.colored_label(seen.colours().trouble, spoken(&wrong.text, seen.language));
        let helps = wrong.remedy.as_ref();
        if let Some(helps) = helps.and_then(|it| remedy::here(it, seen.language)) {
            ui.weak(helps);
        }
    }
}

/// Shows the progress of running work with a button that stops it; returns whether it runs.
fn progress(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    work: Option<WorkId>,
    task: Text,
    out: &mut Outbox,
) -> bool {
    let Some(id) = work.filter(|id| seen.is_running(Some(*id))) else {
        return false;
    };
    ui.horizontal_wrapped(|ui| {
        match seen.far(id).and_then(crate::work::Far::share) {
            Some(share) => drop(ui.add(ProgressBar::new(share).desired_width(120.0))),
            None => drop(ui.spinner()),
        }
        ui.label(seen.say(task));
        if ui.button(seen.say(shell::CANCEL)).clicked() {
            out.send(Command::Stop(id));
        }
    });
    true
}

/// Shows a field for a path with completions, and a button that opens the file chooser.
fn path_field(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    (name, hint): (Text, &str),
    (paths, text): (&mut Paths, &mut String),
    what: Choose,
    out: &mut Outbox,
) {
    ui.weak(seen.say(name));
    let line = Line {
        name: seen.say(name),
        hint,
        ..Line::default()
    };
    paths.show(ui, Id::unique(("study path", name.en)), line, text);
    if ui.button(seen.say(words::CHOOSE)).clicked() {
        out.send(Command::Choose(what));
    }
}

impl Pane for Studies {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        self.follow(seen, out);
        self.give_clip(out);
        let area = ScrollArea::vertical().id_salt("studies").auto_shrink(false);
        area.show(ui, |ui| {
            if self.draft.is_some() {
                draft::show(self, ui, seen, out);
                reach_focus(ui);
                return;
            }
            self.list(ui, seen);
            if let Some(it) = self.chosen() {
                self.study(ui, seen, &it, out);
            }
            let of_study = self.forms.wrong.as_ref();
            let of_study = of_study.filter(|_| self.chosen().is_some());
            self.trouble(ui, seen, self.wrong.as_ref().or(of_study));
            reach_focus(ui);
        });
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        let mut forms = std::iter::once(&mut self.forms).chain(self.others.values_mut());
        if forms.any(|it| it.hear(id, ended)) {
            return;
        }
        let own = [
            &mut self.listing,
            &mut self.planning,
            &mut self.opening,
            &mut self.clip.making,
        ];
        let mut is_own = false;
        for work in own {
            is_own |= work.take_if(|it| *it == id).is_some();
        }
        if !is_own {
            return;
        }
        match ended {
            Ok(Outcome::Studies(all)) => self.all = Some(all.clone()),
            Ok(Outcome::TrialClip(made)) => self.clip.made = Some(made.clone()),
            Ok(Outcome::Planned(name)) => {
                // Another plan may have been begun since.
                for draft in [&mut self.draft, &mut self.unfinished] {
                    drop(draft.take_if(|it| it.name.trim() == name));
                }
                self.choose(name.clone());
                // Results of the replaced plan are of no use.
                self.forms = Forms::default();
                (self.view, self.come) = (View::Plan, true);
            }
            Ok(Outcome::Opened(opened)) => self.unopened = !opened,
            Ok(_) | Err(chereme_corpus::Error::Stopped) => {}
            Err(error) => self.wrong = Some(Wrong::from(error)),
        }
    }

    fn come(&mut self) {
        self.come = true;
    }
}
