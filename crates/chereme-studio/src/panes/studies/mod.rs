//! Studies: plans with a preview of each clip, the questionnaire, the answers, and the report.

mod answer_list;
mod drafted;
mod hypotheses;
mod questionnaire;
mod studies_answers;
mod studies_data;
mod studies_draft;
mod studies_figures;
mod studies_report;
mod studies_trials;
mod wording;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use chereme_corpus::remedy::ErrorRemedy;
use chereme_corpus::study::{NamedText, StudyOverview};
use chereme_corpus::{Corpus, CorpusError};
use eframe::egui::{Button, CollapsingHeader, ScrollArea, Ui};

use self::drafted::{DraftedPlan, StudyDraft};
use self::studies_trials::RequestedTrialClip;
use super::saved_pane::{PathField, SavedFile, SavedTo};
use super::{PaneInterface, list_row, reach_focus, show_running_work};
use crate::command::{ChooserPurpose, CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::window_remedy;
use crate::words::{
    InterfaceLanguage, InterfaceText, fill_text_braces, shell, studies_words as words, translate_library_message,
};
use crate::work::{WorkId, WorkOutcome, WorkResult, studying};

/// The part of the chosen study that is in sight.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum StudyView {
    #[default]
    Plan,
    Questionnaire,
    Answers,
    Report,
}

const STUDY_VIEWS: [(StudyView, InterfaceText); 4] = [
    (StudyView::Plan, words::PLAN),
    (StudyView::Questionnaire, words::QUESTIONNAIRE),
    (StudyView::Answers, words::ANSWERS),
    (StudyView::Report, words::REPORT),
];

/// How many faults are shown at once.
const MAX_SHOWN_FAULTS: usize = 20;

/// Why something could not be done.
#[derive(Debug, Clone)]
struct StudyFault {
    text: String,
    place: Option<String>,
    remedy: Option<ErrorRemedy>,
}

impl StudyFault {
    fn fault_from_error(error: &CorpusError) -> Self {
        Self {
            text: error.to_string(),
            place: error.error_place(),
            remedy: error.error_remedy(),
        }
    }

    /// Returns each part of an error.
    fn faults_from_error(error: &CorpusError) -> Vec<Self> {
        match error {
            CorpusError::Several { errors, .. } => errors.iter().map(Self::fault_from_error).collect(),
            one => vec![Self::fault_from_error(one)],
        }
    }

    /// Returns the place, if it says more than the message, and the message.
    fn report_study_fault(&self, language: InterfaceLanguage) -> String {
        let text = translate_library_message(&self.text, language);
        let place = self.place.as_deref();
        match place.and_then(|location| studies_data::describe_error_place(location, language)) {
            Some(place) => {
                let values: [(&str, &dyn std::fmt::Display); 2] = [("name", &place), ("answers", &text)];
                fill_text_braces(words::ASKED.text_in_language(language), &values)
            }
            None => text,
        }
    }

    /// Returns the remedy, if the window has one.
    fn helps(&self, language: InterfaceLanguage) -> Option<String> {
        let remedy = self.remedy.as_ref()?;
        window_remedy::window_remedy_text(remedy, language)
    }
}

/// The pane.
#[derive(Default)]
pub(crate) struct StudiesPane {
    /// The corpus generation of the last request for the studies.
    of: Option<i64>,
    listing: Option<WorkId>,
    all: Option<Arc<Vec<StudyOverview>>>,
    chosen: Option<String>,
    view: StudyView,
    /// The plan that is being written, if its form is open.
    draft: Option<StudyDraft>,
    /// The plan of the form, and its faults.
    planned: DraftedPlan,
    /// The form as it was opened; nothing for a plan that was left before.
    opened: Option<StudyDraft>,
    /// Plans whose forms were left before they were stored, the last one last.
    unfinished: Vec<StudyDraft>,
    /// A file for the form that was chosen or dropped, and then the work that reads it.
    file: Option<(ChooserPurpose, PathBuf)>,
    reading: Option<(ChooserPurpose, WorkId)>,
    /// Whether the first widget takes the keyboard focus.
    come: bool,
    planning: Option<WorkId>,
    opening: Option<WorkId>,
    /// Whether the desktop had no program for a page.
    unopened: bool,
    wrong: Vec<StudyFault>,
    clip: RequestedTrialClip,
    /// The forms of the chosen study, and those of the others by their names: their work goes on.
    forms: StudyForms,
    others: BTreeMap<String, StudyForms>,
}

/// The forms, work and results of one study.
#[derive(Default)]
struct StudyForms {
    questionnaire: questionnaire::QuestionnaireForm,
    answers: studies_answers::AnswerImportForm,
    list: answer_list::StudyAnswersView,
    report: studies_report::ShownStudyReport,
    /// The file of the plan.
    plan: SavedTo,
    wrong: Vec<StudyFault>,
}

impl StudyForms {
    /// Takes the end of work that was requested from one of the forms; returns whether it was.
    fn receive_study_form_result(&mut self, id: WorkId, ended: &WorkResult) -> bool {
        let running_work = [
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
        for work in running_work {
            is_own |= work.take_if(|running| *running == id).is_some();
        }
        if !is_own {
            return false;
        }
        match ended {
            Ok(WorkOutcome::QuestionnaireBuilt(done)) => {
                self.questionnaire.built = Some(done.as_ref().clone());
            }
            Ok(WorkOutcome::AnswersImported(report)) => {
                self.answers.report = Some(report.as_ref().clone());
            }
            Ok(WorkOutcome::AnswersListed(list)) => self.list.found = Some(list.clone()),
            Ok(WorkOutcome::AnswersWritten) => self.list.saved.mark_file_written(),
            Ok(WorkOutcome::PlanWritten) => self.plan.mark_file_written(),
            Ok(WorkOutcome::Reported(report)) => self.report.found = Some(report.clone()),
            Ok(WorkOutcome::ReportWritten(files)) => self.report.saved = files.first().cloned(),
            Ok(_) | Err(CorpusError::Stopped) => {}
            Err(error) => self.wrong = StudyFault::faults_from_error(error),
        }
        true
    }
}

impl StudiesPane {
    fn follow_study_list(&mut self, seen: &PaneInput<'_>) {
        let generation = seen.snapshot.overview.generation;
        if self.of != Some(generation) && !seen.is_running(self.listing) {
            self.of = Some(generation);
            self.listing = Some(seen.request_work(studying::list_studies_job()));
        }
    }

    fn chosen_study(&self) -> Option<StudyOverview> {
        let all = self.all.as_ref()?;
        let chosen = self.chosen.as_deref()?;
        all.iter().find(|study| study.plan.name == chosen).cloned()
    }

    /// Takes files that were dropped on the window while the answers of a study or the form of a plan are in sight; returns
    /// whether it did.
    pub(crate) fn drop_files(&mut self, paths: &[PathBuf]) -> bool {
        let fits = |path: &PathBuf| {
            let ending = path
                .extension()
                .map(|extension| extension.to_string_lossy().to_lowercase());
            path.is_dir() || ending.is_some_and(|ending| ["json", "csv"].contains(&ending.as_str()))
        };
        if self.draft.is_some()
            && let [path] = paths
            && path
                .extension()
                .is_some_and(|extension| !extension.eq_ignore_ascii_case("chereme"))
            && fits(path)
        {
            self.file = Some((ChooserPurpose::Trials, path.clone()));
            return true;
        }
        let takes =
            self.chosen.is_some() && self.draft.is_none() && self.view == StudyView::Answers && paths.iter().all(fits);
        if takes {
            self.forms.answers.take_answer_files(paths.to_vec());
        }
        takes
    }

    /// Takes the paths of a file chooser.
    pub(crate) fn take_paths(&mut self, what: ChooserPurpose, paths: Vec<PathBuf>) {
        let first = paths.first().map(|path| path.display().to_string());
        match (what, first) {
            (ChooserPurpose::Answers, Some(_)) => self.forms.answers.take_answer_files(paths),
            (ChooserPurpose::Questionnaire, Some(path)) => self.forms.questionnaire.to = path,
            (ChooserPurpose::Report, Some(path)) => self.forms.report.to = path,
            (ChooserPurpose::AnswersTable, Some(path)) => self.forms.list.saved.to = path,
            (ChooserPurpose::SavePlan, Some(path)) => self.forms.plan.to = path,
            (ChooserPurpose::Trials | ChooserPurpose::Columns | ChooserPurpose::Plan, Some(path)) => {
                self.file = Some((what, path.into()));
            }
            _ => {}
        }
    }

    /// Reads the file that was chosen or dropped for a form.
    fn read_file(&mut self, out: &CommandOutbox) {
        if let Some((what, path)) = self.file.take() {
            self.wrong.clear();
            self.reading = Some((what, out.request_work(studying::read_study_file_job(path))));
        }
    }

    /// Takes a file that was read.
    fn take_text(&mut self, what: ChooserPurpose, it: &NamedText) {
        match what {
            ChooserPurpose::Trials => {
                if let Some(draft) = &mut self.draft {
                    let raw_name = Path::new(&it.file).file_name();
                    let name = raw_name.map(|name| name.to_string_lossy().into_owned());
                    draft.file = name.unwrap_or_else(|| it.file.clone());
                    draft.table = it.text.trim_start_matches('\u{feff}').to_owned();
                }
            }
            ChooserPurpose::Columns => self.forms.answers.take_map(it),
            _ => match Corpus::read_plan(&it.text, &it.file) {
                Ok(plan) => {
                    self.open_study_draft(StudyDraft::of_plan(&plan));
                }
                Err(error) => self.wrong = StudyFault::faults_from_error(&error),
            },
        }
    }

    /// Shows all studies, and the button that begins a new one.
    fn show_study_list(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let all = self.all.clone().unwrap_or_default();
        if all.is_empty() && self.all.is_some() {
            ui.label(seen.say_text(words::NONE));
        }
        let height = ui.spacing().interact_size.y * 1.9;
        for it in all.iter() {
            let name = &it.plan.name;
            let chosen = self.chosen.as_ref() == Some(name);
            let about = studies_data::describe_study_overview(it, seen.language);
            let row = list_row(ui, height, chosen, name, &about);
            if std::mem::take(&mut self.come) {
                row.request_focus();
            }
            if row.clicked() {
                self.choose_study(name.clone());
            }
        }
        let open = !seen.snapshot.is_read_only();
        ui.horizontal_wrapped(|ui| {
            let new_button = ui.add_enabled(open, Button::new(seen.say_text(words::NEW)));
            let new = new_button.on_disabled_hover_text(seen.say_text(shell::READ_ONLY_WHY));
            if self.all.is_some() && std::mem::take(&mut self.come) {
                new.request_focus();
            }
            if new.clicked() {
                self.open_study_draft(StudyDraft::default());
            }
            let left = !self.unfinished.is_empty();
            if left
                && ui.button(seen.say_text(words::CONTINUE)).clicked()
                && let Some(draft) = self.unfinished.pop()
            {
                self.open_study_draft(draft);
                self.opened = None;
            }
            let file = ui.add_enabled(open, Button::new(seen.say_text(words::PLAN_OF_FILE)));
            if file.on_hover_text(seen.say_text(words::PLAN_OF_FILE_TIP)).clicked() {
                seen.send_command(WindowCommand::Choose(ChooserPurpose::Plan));
            }
        });
    }

    /// Opens the form of a plan. A plan whose form is open is kept as one that was left.
    fn open_study_draft(&mut self, draft: StudyDraft) {
        self.unfinished.extend(self.draft.take());
        self.opened = Some(draft.clone());
        (self.draft, self.come) = (Some(draft), true);
        self.wrong.clear();
    }

    /// Leaves the form of a plan, which is kept if it was changed.
    fn leave_study_draft(&mut self, draft: StudyDraft) {
        (self.come, self.reading) = (true, None);
        if self.opened.take().as_ref() != Some(&draft) {
            self.unfinished.push(draft);
        }
    }

    fn choose_study(&mut self, name: String) {
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
    fn show_chosen_study(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, it: &StudyOverview) {
        ui.separator();
        ui.horizontal_wrapped(|ui| {
            for (view, name) in STUDY_VIEWS {
                ui.selectable_value(&mut self.view, view, seen.say_text(name));
            }
        });
        match self.view {
            StudyView::Plan => self.show_study_plan(ui, seen, it),
            StudyView::Questionnaire => questionnaire::show_questionnaire_form(self, ui, seen, it),
            StudyView::Answers => studies_answers::show_answer_import(self, ui, seen, it),
            StudyView::Report => studies_report::show_study_report(self, ui, seen, it),
        }
    }

    fn show_study_plan(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, it: &StudyOverview) {
        for question in &it.plan.questions {
            let answers = studies_data::describe_possible_answers(question);
            let values: [(&str, &dyn std::fmt::Display); 2] = [("name", &question.name), ("answers", &answers)];
            ui.label(fill_text_braces(seen.say_text(words::ASKED), &values));
        }
        for it in &it.plan.hypotheses {
            ui.label(studies_data::hypothesis_sentence(it, seen.language));
        }
        let open = !seen.snapshot.is_read_only();
        ui.horizontal_wrapped(|ui| {
            let change_button = ui.add_enabled(open, Button::new(seen.say_text(words::CHANGE)));
            let change = change_button.on_disabled_hover_text(seen.say_text(shell::READ_ONLY_WHY));
            if change.clicked() {
                let all = self.all.clone().unwrap_or_default();
                let taken: Vec<&str> = all.iter().map(|study| study.plan.name.as_str()).collect();
                self.open_study_draft(StudyDraft::draft_from_study(it, &taken));
            }
            let delete_button = ui.add_enabled(open, Button::new(seen.say_text(words::DELETE)));
            let delete = delete_button
                .on_hover_text(seen.say_text(words::DELETE_TIP))
                .on_disabled_hover_text(seen.say_text(shell::READ_ONLY_WHY));
            if delete.clicked() {
                seen.request_work(studying::delete_study_job(it.plan.name.clone()));
            }
        });
        let about = match it.participants {
            0 => words::CAN_CHANGE,
            _ => words::CHANGE_ANSWERED,
        };
        ui.weak(seen.say_text(about));
        self.show_plan_trials(ui, seen, &it.plan);
        let header = CollapsingHeader::new(seen.say_text(words::SAVE_PLAN)).id_salt("plan file");
        header.show(ui, |ui| {
            let proposed = format!("{}-plan.json", studies_data::file_stem(&it.plan.name));
            let file = SavedFile {
                name: words::PLAN_FILE,
                button: words::WRITE_PLAN,
                chooser: ChooserPurpose::SavePlan,
            };
            let form = &mut self.forms.plan;
            if let Some((to, force)) = form.show_save_path(ui, seen, file, &proposed) {
                let job = studying::write_plan(it.plan.name.clone(), to, force);
                form.saving = Some(seen.request_work(job));
                self.clear_study_results();
            }
        });
    }

    /// Removes the results and errors of earlier work.
    fn clear_study_results(&mut self) {
        self.wrong.clear();
        self.forms.wrong.clear();
    }

    fn show_study_faults(&self, ui: &mut Ui, seen: &PaneInput<'_>, wrong: &[StudyFault]) {
        if self.unopened {
            ui.colored_label(seen.pane_colours().warning, seen.say_text(words::NOT_OPENED));
        }
        let mut before = None;
        for wrong in wrong.iter().take(MAX_SHOWN_FAULTS) {
            ui.colored_label(seen.pane_colours().trouble, wrong.report_study_fault(seen.language));
            let helps = wrong.helps(seen.language);
            // Several faults may have one remedy.
            if let Some(helps) = helps.filter(|text| before.as_ref() != Some(text)) {
                ui.weak(&helps);
                before = Some(helps);
            }
        }
        if wrong.len() > MAX_SHOWN_FAULTS {
            let more = wrong.len() - MAX_SHOWN_FAULTS;
            ui.weak(fill_text_braces(seen.say_text(words::MORE), &[("n", &more)]));
        }
    }
}

/// Shows the progress of running work with a button that stops it; returns whether it runs.
fn progress(ui: &mut Ui, seen: &PaneInput<'_>, work: Option<WorkId>, task: InterfaceText) -> bool {
    if !seen.is_running(work) {
        return false;
    }
    ui.horizontal_wrapped(|ui| {
        ui.label(seen.say_text(task));
        show_running_work(ui, seen, work);
    });
    true
}

impl PaneInterface for StudiesPane {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        self.follow_study_list(seen);
        self.give_clip(seen.out);
        self.read_file(seen.out);
        let area = ScrollArea::vertical().id_salt("studies").auto_shrink(false);
        area.show(ui, |ui| {
            if self.draft.is_some() {
                studies_draft::show_study_draft(self, ui, seen);
                reach_focus(ui);
                return;
            }
            self.show_study_list(ui, seen);
            if let Some(it) = self.chosen_study() {
                self.show_chosen_study(ui, seen, &it);
            }
            let of_study = self.chosen_study().is_some() && self.wrong.is_empty();
            self.show_study_faults(
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

    fn receive_work_result(&mut self, id: WorkId, ended: &WorkResult) {
        let mut forms = std::iter::once(&mut self.forms).chain(self.others.values_mut());
        if forms.any(|form| form.receive_study_form_result(id, ended)) {
            return;
        }
        if let Some((what, _)) = self.reading.take_if(|reading| reading.1 == id) {
            match ended {
                Ok(WorkOutcome::StudyText(text)) => self.take_text(what, text),
                Ok(_) | Err(CorpusError::Stopped) => {}
                Err(error) => self.wrong = StudyFault::faults_from_error(error),
            }
            return;
        }
        let running_work = [
            &mut self.listing,
            &mut self.planning,
            &mut self.opening,
            &mut self.clip.making,
        ];
        let mut is_own = false;
        for work in running_work {
            is_own |= work.take_if(|running| *running == id).is_some();
        }
        if !is_own {
            return;
        }
        match ended {
            Ok(WorkOutcome::Studies(all)) => self.all = Some(all.clone()),
            Ok(WorkOutcome::TrialClip(made)) => self.clip.made = Some(made.clone()),
            Ok(WorkOutcome::Planned(name)) => {
                // Another plan may have been begun since.
                let stored = |draft: &StudyDraft| draft.name.trim() == name;
                drop(self.draft.take_if(|draft| stored(draft)));
                self.unfinished.retain(|draft| !stored(draft));
                self.choose_study(name.clone());
                // Results of the replaced plan are of no use.
                self.forms = StudyForms::default();
                (self.view, self.come) = (StudyView::Plan, true);
            }
            Ok(WorkOutcome::Opened(opened)) => self.unopened = !opened,
            Ok(_) | Err(CorpusError::Stopped) => {}
            Err(error) => self.wrong = StudyFault::faults_from_error(error),
        }
    }

    fn come(&mut self) {
        self.come = true;
    }
}
