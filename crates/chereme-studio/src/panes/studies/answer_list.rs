//! The answers to a study one by one: filtered, with the missing ones; a participant is deleted, and all are exported.

use std::sync::Arc;

use chereme_corpus::study::{
    AnswerFilter, AnswerList, AnswerRow, ParticipantSummary, StudyOverview,
};
use eframe::egui::{Button, ScrollArea, Ui};

use super::draft::line;
use super::{SavedTo, Studies, data};
use crate::context::{Outbox, PaneInput};
use crate::file_dialogs::Choose;
use crate::panes::{combo, list_row};
use crate::words::{fill, shell, studies as words};
use crate::work::{WorkId, studying};

/// The height of the list, in points.
const HEIGHT: f32 = 320.0;

/// The answers, and what is shown of them.
#[derive(Default)]
pub(super) struct List {
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

impl List {
    fn refresh(&mut self, list: &Arc<AnswerList>) {
        let same = self.rows_of.as_ref();
        if same.is_some_and(|it| Arc::ptr_eq(&it.0, list) && it.1 == self.filter) {
            return;
        }
        let held = |it: &(usize, &AnswerRow)| self.filter.holds(it.1);
        let rows = list.rows.iter().enumerate().filter(held);
        self.rows = rows.map(|it| it.0).collect();
        self.rows_of = Some((list.clone(), self.filter.clone()));
    }
}

/// Shows the answers, what can be done with them, and the table they are written to.
pub(super) fn show(
    pane: &mut Studies,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    it: &StudyOverview,
    out: &mut Outbox,
) {
    let list = &mut pane.forms.list;
    let generation = seen.snapshot.overview.generation;
    if list.of != Some(generation) && !seen.is_running(list.asking) {
        list.of = Some(generation);
        list.asking = Some(out.work(studying::answers(it.plan.name.clone())));
    }
    let Some(found) = list.found.clone().filter(|it| !it.participants.is_empty()) else {
        return;
    };
    ui.separator();
    let everybody = seen.say(words::EVERYBODY).to_owned();
    let mut people = vec![(None, everybody)];
    people.extend(
        found
            .participants
            .iter()
            .map(|it| (Some(it.code.clone()), it.code.clone())),
    );
    let gone = |code: &String| !people.iter().any(|it| it.0.as_ref() == Some(code));
    list.filter.participant.take_if(|it| gone(it));
    list.forget.take_if(|it| gone(it));
    ui.horizontal_wrapped(|ui| {
        let name = seen.say(words::PARTICIPANT);
        combo::named(ui, name, &mut list.filter.participant, &people);
        ui.checkbox(&mut list.filter.missing, seen.say(words::ONLY_MISSING));
    });
    let hint = seen.say(words::FILTER_HINT);
    line(ui, seen.say(words::FILTER), hint, &mut list.filter.text);
    list.refresh(&found);
    let chosen = list.filter.participant.clone();
    let person = found
        .participants
        .iter()
        .find(|it| Some(&it.code) == chosen.as_ref());
    if let Some(person) = person {
        about(pane, ui, seen, person, &found.study, out);
    }
    let list = &pane.forms.list;
    let values: [(&str, &dyn std::fmt::Display); 2] =
        [("n", &list.rows.len()), ("of", &found.rows.len())];
    ui.weak(fill(seen.say(words::ANSWERS_SHOWN), &values));
    pane.making(ui, seen);
    rows(pane, ui, seen, (it, &found), out);
    let proposed = format!("{}-answers.csv", data::file_stem(&it.plan.name));
    let named = (
        words::ANSWERS_TABLE,
        words::SAVE_ANSWERS,
        Choose::AnswersTable,
    );
    let saved = &mut pane.forms.list.saved;
    if let Some((to, force)) = saved.show(ui, seen, named, &proposed, out) {
        let job = studying::write_answers(it.plan.name.clone(), to, force);
        saved.saving = Some(out.work(job));
        pane.clear();
    }
}

/// Shows a participant, and the buttons that delete the answers.
fn about(
    pane: &mut Studies,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    it: &ParticipantSummary,
    study: &str,
    out: &mut Outbox,
) {
    let mut texts = Vec::new();
    let values: [(&str, &dyn std::fmt::Display); 3] = [
        ("answers", &it.answers),
        ("skipped", &it.skipped),
        ("not_reached", &it.not_reached),
    ];
    texts.push(fill(seen.say(words::PERSON), &values));
    texts.extend((!it.started_day.is_empty()).then(|| it.started_day.clone()));
    let finished = match it.finished {
        true => words::FINISHED,
        false => words::NOT_FINISHED,
    };
    texts.push(seen.say(finished).to_owned());
    for (name, option) in &it.profile {
        let values: [(&str, &dyn std::fmt::Display); 2] = [("name", name), ("answers", option)];
        texts.push(fill(seen.say(words::ASKED), &values));
    }
    ui.label(texts.join(" · "));
    let list = &mut pane.forms.list;
    let locked = seen.snapshot.is_read_only();
    if list.forget.as_ref() != Some(&it.code) {
        let text = fill(seen.say(words::FORGET), &[("code", &it.code)]);
        let forget = ui.add_enabled(!locked, Button::new(text));
        let forget = forget.on_disabled_hover_text(seen.say(shell::READ_ONLY_WHY));
        if forget.clicked() {
            list.forget = Some(it.code.clone());
        }
        return;
    }
    let values: [(&str, &dyn std::fmt::Display); 2] =
        [("code", &it.code), ("answers", &it.answers)];
    let text = fill(seen.say(words::FORGET_WHAT), &values);
    ui.colored_label(seen.colours().warning, text);
    ui.horizontal_wrapped(|ui| {
        if ui.button(seen.say(words::FORGET_NOW)).clicked() {
            let job = studying::forget(study.to_owned(), it.code.clone());
            (list.forgetting, list.forget) = (Some(out.work(job)), None);
        }
        if ui.button(seen.say(shell::CANCEL)).clicked() {
            list.forget = None;
        }
    });
}

/// Shows the rows; a click shows the clip of a trial on the stage.
fn rows(
    pane: &mut Studies,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    (study, found): (&StudyOverview, &AnswerList),
    out: &mut Outbox,
) {
    let height = ui.spacing().interact_size.y * 1.9;
    let whole = height + ui.spacing().item_spacing.y;
    let held = &pane.forms.list.rows;
    let mut picked = None;
    ScrollArea::vertical()
        .id_salt("answers")
        .max_height((whole * held.len() as f32).min(HEIGHT))
        .auto_shrink([false, true])
        .show_rows(ui, height, held.len(), |ui, range| {
            for it in held[range].iter().filter_map(|at| found.rows.get(*at)) {
                let (name, about) = data::answer(it, seen.language);
                let trial = study.plan.trial(&it.part, &it.item, &it.condition, it.role);
                let clip = trial.map(|it| it.clip.as_str()).unwrap_or_default();
                if list_row(ui, height, pane.clip.is(&name, clip), &name, &about).clicked() {
                    picked = Some((name, clip.to_owned()));
                }
            }
        });
    if let Some((name, clip)) = picked.filter(|it| !it.1.is_empty()) {
        pane.show_clip(&name, &clip, out);
    }
}
