//! Studies: plans with a preview of each clip, the questionnaire, the answers, and the report.

mod answer_list;
mod answers;
mod data;
mod draft;
mod drafted;
mod figures;
mod hypotheses;
mod questionnaire;
mod report;
mod trials;
mod wording;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use chereme_corpus::remedy::Remedy;
use chereme_corpus::study::{NamedText, StudyOverview};
use chereme_corpus::{Corpus, Error};
use eframe::egui::{Button, CollapsingHeader, ProgressBar, ScrollArea, Ui};

use self::drafted::{Draft, Planned};
use self::trials::Clip;
use super::saved::{SavedTo, path_field};
use super::{Pane, list_row, reach_focus};
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::file_dialogs::Choose;
use crate::overlay::remedy;
use crate::words::{Language, Text, fill, shell, spoken, studies as words};
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

/// How many faults are shown at once.
const MOST_WRONG: usize = 20;

/// Why something could not be done.
#[derive(Debug, Clone)]
struct Wrong {
    text: String,
    place: Option<String>,
    remedy: Option<Remedy>,
}

impl Wrong {
    fn of(error: &Error) -> Self {
        Self {
            text: error.to_string(),
            place: error.place(),
            remedy: error.remedy(),
        }
    }

    /// Returns each part of an error.
    fn each(error: &Error) -> Vec<Self> {
        match error {
            Error::Several { errors } => errors.iter().map(Self::of).collect(),
            one => vec![Self::of(one)],
        }
    }

    /// Returns the place, if it says more than the message, and the message.
    fn said(&self, language: Language) -> String {
        let text = spoken(&self.text, language);
        let place = self.place.as_deref();
        match place.and_then(|it| data::place(it, language)) {
            Some(place) => {
                let values: [(&str, &dyn std::fmt::Display); 2] =
                    [("name", &place), ("answers", &text)];
                fill(words::ASKED.of(language), &values)
            }
            None => text,
        }
    }

    /// Returns the remedy, if the window has one.
    fn helps(&self, language: Language) -> Option<String> {
        let remedy = self.remedy.as_ref()?;
        remedy::here(remedy, language)
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
    /// The plan of the form, and its faults.
    planned: Planned,
    /// The form as it was opened; nothing for a plan that was left before.
    opened: Option<Draft>,
    /// Plans whose forms were left before they were stored, the last one last.
    unfinished: Vec<Draft>,
    /// A file for the form that was chosen or dropped, and then the work that reads it.
    file: Option<(Choose, PathBuf)>,
    reading: Option<(Choose, WorkId)>,
    /// Whether the first widget takes the keyboard focus.
    come: bool,
    planning: Option<WorkId>,
    opening: Option<WorkId>,
    /// Whether the desktop had no program for a page.
    unopened: bool,
    wrong: Vec<Wrong>,
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
    list: answer_list::List,
    report: report::Shown,
    /// The file of the plan.
    plan: SavedTo,
    wrong: Vec<Wrong>,
}

impl Forms {
    /// Takes the end of work that was requested from one of the forms; returns whether it was.
    fn hear(&mut self, id: WorkId, ended: &Ended) -> bool {
        let own = [
            &mut self.questionnaire.building,
            &mut self.answers.importing,
            &mut self.list.asking,
            &mut self.list.forgetting,
            &mut self.list.saved.saving,
            &mut self.plan.saving,
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
            Ok(Outcome::AnswersListed(list)) => self.list.found = Some(list.clone()),
            Ok(Outcome::AnswersWritten) => self.list.saved.written(),
            Ok(Outcome::PlanWritten) => self.plan.written(),
            Ok(Outcome::Reported(report)) => self.report.found = Some(report.clone()),
            Ok(Outcome::ReportWritten(files)) => self.report.saved = files.first().cloned(),
            Ok(_) | Err(Error::Stopped) => {}
            Err(error) => self.wrong = Wrong::each(error),
        }
        true
    }
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

    /// Takes files that were dropped on the window while the answers of a study or the form of a plan are in sight; returns
    /// whether it did.
    pub(crate) fn drop_files(&mut self, paths: &[PathBuf]) -> bool {
        let fits = |path: &PathBuf| {
            let ending = path
                .extension()
                .map(|it| it.to_string_lossy().to_lowercase());
            path.is_dir() || ending.is_some_and(|it| ["json", "csv"].contains(&it.as_str()))
        };
        if self.draft.is_some()
            && let [path] = paths
            && path
                .extension()
                .is_some_and(|it| !it.eq_ignore_ascii_case("chereme"))
            && fits(path)
        {
            self.file = Some((Choose::Trials, path.clone()));
            return true;
        }
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
            (Choose::AnswersTable, Some(path)) => self.forms.list.saved.to = path,
            (Choose::SavePlan, Some(path)) => self.forms.plan.to = path,
            (Choose::Trials | Choose::Columns | Choose::Plan, Some(path)) => {
                self.file = Some((what, path.into()));
            }
            _ => {}
        }
    }

    /// Reads the file that was chosen or dropped for a form.
    fn read_file(&mut self, out: &mut Outbox) {
        if let Some((what, path)) = self.file.take() {
            self.wrong.clear();
            self.reading = Some((what, out.work(studying::read(path))));
        }
    }

    /// Takes a file that was read.
    fn take_text(&mut self, what: Choose, it: &NamedText) {
        match what {
            Choose::Trials => {
                if let Some(draft) = &mut self.draft {
                    let name = Path::new(&it.file).file_name();
                    let name = name.map(|it| it.to_string_lossy().into_owned());
                    draft.file = name.unwrap_or_else(|| it.file.clone());
                    draft.table = it.text.trim_start_matches('\u{feff}').to_owned();
                }
            }
            Choose::Columns => self.forms.answers.take_map(it),
            _ => match Corpus::read_plan(&it.text, &it.file) {
                Ok(plan) => {
                    self.open(Draft::of_plan(&plan));
                }
                Err(error) => self.wrong = Wrong::each(&error),
            },
        }
    }

    /// Shows all studies, and the button that begins a new one.
    fn list(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
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
        ui.horizontal_wrapped(|ui| {
            let new = ui.add_enabled(open, Button::new(seen.say(words::NEW)));
            let new = new.on_disabled_hover_text(seen.say(shell::READ_ONLY_WHY));
            if self.all.is_some() && std::mem::take(&mut self.come) {
                new.request_focus();
            }
            if new.clicked() {
                self.open(Draft::default());
            }
            let left = !self.unfinished.is_empty();
            if left
                && ui.button(seen.say(words::CONTINUE)).clicked()
                && let Some(draft) = self.unfinished.pop()
            {
                self.open(draft);
                self.opened = None;
            }
            let file = ui.add_enabled(open, Button::new(seen.say(words::PLAN_OF_FILE)));
            if file
                .on_hover_text(seen.say(words::PLAN_OF_FILE_TIP))
                .clicked()
            {
                out.send(Command::Choose(Choose::Plan));
            }
        });
    }

    /// Opens the form of a plan. A plan whose form is open is kept as one that was left.
    fn open(&mut self, draft: Draft) {
        self.unfinished.extend(self.draft.take());
        self.opened = Some(draft.clone());
        (self.draft, self.come) = (Some(draft), true);
        self.wrong.clear();
    }

    /// Leaves the form of a plan, which is kept if it was changed.
    fn leave(&mut self, draft: Draft) {
        (self.come, self.reading) = (true, None);
        if self.opened.take().as_ref() != Some(&draft) {
            self.unfinished.push(draft);
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
        self.wrong.clear();
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
        for it in &it.plan.hypotheses {
            ui.label(data::hypothesis(it, seen.language));
        }
        let open = !seen.snapshot.is_read_only();
        ui.horizontal_wrapped(|ui| {
            let change = ui.add_enabled(open, Button::new(seen.say(words::CHANGE)));
            let change = change.on_disabled_hover_text(seen.say(shell::READ_ONLY_WHY));
            if change.clicked() {
                let all = self.all.clone().unwrap_or_default();
                let taken: Vec<&str> = all.iter().map(|it| it.plan.name.as_str()).collect();
                self.open(Draft::of(it, &taken));
            }
            let delete = ui.add_enabled(open, Button::new(seen.say(words::DELETE)));
            let delete = delete
                .on_hover_text(seen.say(words::DELETE_TIP))
                .on_disabled_hover_text(seen.say(shell::READ_ONLY_WHY));
            if delete.clicked() {
                out.work(studying::delete(it.plan.name.clone()));
            }
        });
        let about = match it.participants {
            0 => words::CAN_CHANGE,
            _ => words::CHANGE_ANSWERED,
        };
        ui.weak(seen.say(about));
        self.trials(ui, seen, &it.plan, out);
        let header = CollapsingHeader::new(seen.say(words::SAVE_PLAN)).id_salt("plan file");
        header.show(ui, |ui| {
            let proposed = format!("{}-plan.json", data::file_stem(&it.plan.name));
            let named = (words::PLAN_FILE, words::WRITE_PLAN, Choose::SavePlan);
            let form = &mut self.forms.plan;
            if let Some((to, force)) = form.show(ui, seen, named, &proposed, out) {
                let job = studying::write_plan(it.plan.name.clone(), to, force);
                form.saving = Some(out.work(job));
                self.clear();
            }
        });
    }

    /// Removes the results and errors of earlier work.
    fn clear(&mut self) {
        self.wrong.clear();
        self.forms.wrong.clear();
    }

    fn trouble(&self, ui: &mut Ui, seen: &PaneInput<'_>, wrong: &[Wrong]) {
        if self.unopened {
            ui.colored_label(seen.colours().warning, seen.say(words::NOT_OPENED));
        }
        let mut before = None;
        for wrong in wrong.iter().take(MOST_WRONG) {
            ui.colored_label(seen.colours().trouble, wrong.said(seen.language));
            let helps = wrong.helps(seen.language);
            // Several faults may have one remedy.
            if let Some(helps) = helps.filter(|it| before.as_ref() != Some(it)) {
                ui.weak(&helps);
                before = Some(helps);
            }
        }
        if wrong.len() > MOST_WRONG {
            let more = wrong.len() - MOST_WRONG;
            ui.weak(fill(seen.say(words::MORE), &[("n", &more)]));
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

impl Pane for Studies {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        self.follow(seen, out);
        self.give_clip(out);
        self.read_file(out);
        let area = ScrollArea::vertical().id_salt("studies").auto_shrink(false);
        area.show(ui, |ui| {
            if self.draft.is_some() {
                draft::show(self, ui, seen, out);
                reach_focus(ui);
                return;
            }
            self.list(ui, seen, out);
            if let Some(it) = self.chosen() {
                self.study(ui, seen, &it, out);
            }
            let of_study = self.chosen().is_some() && self.wrong.is_empty();
            self.trouble(
                ui,
                seen,
                match of_study {
                    true => &self.forms.wrong,
                    false => &self.wrong,
                },
            );
            reach_focus(ui);
        });
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        let mut forms = std::iter::once(&mut self.forms).chain(self.others.values_mut());
        if forms.any(|it| it.hear(id, ended)) {
            return;
        }
        if let Some((what, _)) = self.reading.take_if(|it| it.1 == id) {
            match ended {
                Ok(Outcome::StudyText(text)) => self.take_text(what, text),
                Ok(_) | Err(Error::Stopped) => {}
                Err(error) => self.wrong = Wrong::each(error),
            }
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
                let stored = |it: &Draft| it.name.trim() == name;
                drop(self.draft.take_if(|it| stored(it)));
                self.unfinished.retain(|it| !stored(it));
                self.choose(name.clone());
                // Results of the replaced plan are of no use.
                self.forms = Forms::default();
                (self.view, self.come) = (View::Plan, true);
            }
            Ok(Outcome::Opened(opened)) => self.unopened = !opened,
            Ok(_) | Err(Error::Stopped) => {}
            Err(error) => self.wrong = Wrong::each(error),
        }
    }

    fn come(&mut self) {
        self.come = true;
    }
}
