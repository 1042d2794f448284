//! The answers to a study one by one: filtered, with the missing ones; a participant is deleted, and all are exported.

use std::sync::Arc;

use chereme_corpus::study::{AnswerFilter, AnswerList, AnswerListRow, ParticipantSummary, StudyOverview};
use eframe::egui::{Button, ScrollArea, Ui};

use super::studies_draft::show_draft_text_line;
use super::{SavedFile, SavedTo, StudiesPane, studies_data};
use crate::command::ChooserPurpose;
use crate::context::PaneInput;
use crate::panes::{combo, list_row};
use crate::words::{fill_text_braces, shell, studies_words as words};
use crate::work::{WorkId, studying};

/// The height of the list, in points.
const ANSWER_LIST_HEIGHT_POINTS: f32 = 320.0;

/// The answers, and what is shown of them.
#[derive(Default)]
pub(super) struct StudyAnswersView {
    /// The corpus generation of the last request.
    of: Option<i64>,
    pub(super) asking: Option<WorkId>,
    pub(super) found: Option<Arc<AnswerList>>,
    filter: AnswerFilter,
    /// The rows that the filter holds, and what they were computed from.
    rows: Vec<usize>,
    rows_of: Option<(Arc<AnswerList>, AnswerFilter)>,
    /// The participant who is to be deleted, until that is confirmed.
    forget: Option<String>,
    pub(super) forgetting: Option<WorkId>,
    pub(super) saved: SavedTo,
}

impl StudyAnswersView {
    fn refresh_answer_list(&mut self, list: &Arc<AnswerList>) {
        let same = self.rows_of.as_ref();
        if same.is_some_and(|source| Arc::ptr_eq(&source.0, list) && source.1 == self.filter) {
            return;
        }
        let is_listed = |entry: &(usize, &AnswerListRow)| self.filter.holds_answer_row(entry.1);
        let rows = list.rows.iter().enumerate().filter(is_listed);
        self.rows = rows.map(|entry| entry.0).collect();
        self.rows_of = Some((list.clone(), self.filter.clone()));
    }
}

/// Shows the answers, what can be done with them, and the table they are written to.
pub(super) fn show_study_answers(pane: &mut StudiesPane, ui: &mut Ui, seen: &PaneInput<'_>, it: &StudyOverview) {
    let list = &mut pane.forms.list;
    let generation = seen.snapshot.overview.generation;
    if list.of != Some(generation) && !seen.is_running(list.asking) {
        list.of = Some(generation);
        list.asking = Some(seen.request_work(studying::list_answers_job(it.plan.name.clone())));
    }
    let Some(found) = list.found.clone().filter(|answers| !answers.participants.is_empty()) else {
        return;
    };
    ui.separator();
    let everybody = seen.say_text(words::EVERYBODY).to_owned();
    let mut people = vec![(None, everybody)];
    people.extend(
        found
            .participants
            .iter()
            .map(|participant| (Some(participant.code.clone()), participant.code.clone())),
    );
    let gone = |code: &String| !people.iter().any(|person| person.0.as_ref() == Some(code));
    list.filter.participant.take_if(|code| gone(code));
    list.forget.take_if(|code| gone(code));
    ui.horizontal_wrapped(|ui| {
        let name = seen.say_text(words::PARTICIPANT);
        combo::show_named_combo(ui, name, &mut list.filter.participant, &people);
        ui.checkbox(&mut list.filter.missing, seen.say_text(words::ONLY_MISSING));
    });
    let hint = seen.say_text(words::FILTER_HINT);
    show_draft_text_line(ui, seen.say_text(words::FILTER), hint, &mut list.filter.text);
    list.refresh_answer_list(&found);
    let chosen = list.filter.participant.clone();
    let person = found
        .participants
        .iter()
        .find(|participant| Some(&participant.code) == chosen.as_ref());
    if let Some(person) = person {
        show_participant_summary(pane, ui, seen, person, &found.study);
    }
    let list = &pane.forms.list;
    let values: [(&str, &dyn std::fmt::Display); 2] = [("n", &list.rows.len()), ("of", &found.rows.len())];
    ui.weak(fill_text_braces(seen.say_text(words::ANSWERS_SHOWN), &values));
    pane.show_clip_progress(ui, seen);
    show_answer_rows(pane, ui, seen, it, &found);
    let proposed = format!("{}-answers.csv", studies_data::file_stem(&it.plan.name));
    let file = SavedFile {
        name: words::ANSWERS_TABLE,
        button: words::SAVE_ANSWERS,
        chooser: ChooserPurpose::AnswersTable,
    };
    let saved = &mut pane.forms.list.saved;
    if let Some((to, force)) = saved.show_save_path(ui, seen, file, &proposed) {
        let job = studying::write_answers(it.plan.name.clone(), to, force);
        saved.saving = Some(seen.request_work(job));
        pane.clear_study_results();
    }
}

/// Shows a participant, and the buttons that delete the answers.
fn show_participant_summary(
    pane: &mut StudiesPane,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    it: &ParticipantSummary,
    study: &str,
) {
    let mut texts = Vec::new();
    let values: [(&str, &dyn std::fmt::Display); 3] = [
        ("answers", &it.answers),
        ("skipped", &it.skipped),
        ("not_reached", &it.not_reached),
    ];
    texts.push(fill_text_braces(seen.say_text(words::PERSON), &values));
    texts.extend((!it.started_day.is_empty()).then(|| it.started_day.clone()));
    let finished = match it.finished {
        true => words::FINISHED,
        false => words::NOT_FINISHED,
    };
    texts.push(seen.say_text(finished).to_owned());
    for (name, option) in &it.profile {
        let values: [(&str, &dyn std::fmt::Display); 2] = [("name", name), ("answers", option)];
        texts.push(fill_text_braces(seen.say_text(words::ASKED), &values));
    }
    ui.label(texts.join(" · "));
    let list = &mut pane.forms.list;
    let locked = seen.snapshot.is_read_only();
    if list.forget.as_ref() != Some(&it.code) {
        let text = fill_text_braces(seen.say_text(words::FORGET), &[("code", &it.code)]);
        let forget_button = ui.add_enabled(!locked, Button::new(text));
        let forget = forget_button.on_disabled_hover_text(seen.say_text(shell::READ_ONLY_WHY));
        if forget.clicked() {
            list.forget = Some(it.code.clone());
        }
        return;
    }
    let values: [(&str, &dyn std::fmt::Display); 2] = [("code", &it.code), ("answers", &it.answers)];
    let text = fill_text_braces(seen.say_text(words::FORGET_WHAT), &values);
    ui.colored_label(seen.pane_colours().warning, text);
    ui.horizontal_wrapped(|ui| {
        if ui.button(seen.say_text(words::FORGET_NOW)).clicked() {
            let job = studying::forget_participant_job(study.to_owned(), it.code.clone());
            (list.forgetting, list.forget) = (Some(seen.request_work(job)), None);
        }
        if ui.button(seen.say_text(shell::CANCEL)).clicked() {
            list.forget = None;
        }
    });
}

/// Shows the rows; a click shows the clip of a trial on the stage.
fn show_answer_rows(
    pane: &mut StudiesPane,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    study: &StudyOverview,
    found: &AnswerList,
) {
    let height = ui.spacing().interact_size.y * 1.9;
    let row_pitch = height + ui.spacing().item_spacing.y;
    let listed_rows = &pane.forms.list.rows;
    let mut picked = None;
    ScrollArea::vertical()
        .id_salt("answers")
        .max_height((row_pitch * listed_rows.len() as f32).min(ANSWER_LIST_HEIGHT_POINTS))
        .auto_shrink([false, true])
        .show_rows(ui, height, listed_rows.len(), |ui, range| {
            for it in listed_rows[range].iter().filter_map(|at| found.rows.get(*at)) {
                let (name, about) = studies_data::answer_row_texts(it, seen.language);
                let trial = study.plan.find_plan_trial(&it.part, &it.item, &it.condition, it.role);
                let clip = trial.map(|trial| trial.clip.as_str()).unwrap_or_default();
                if list_row(ui, height, pane.clip.is_requested_clip(&name, clip), &name, &about).clicked() {
                    picked = Some((name, clip.to_owned()));
                }
            }
        });
    if let Some((name, clip)) = picked.filter(|pick| !pick.1.is_empty()) {
        pane.show_clip(&name, &clip, seen.out);
    }
}
