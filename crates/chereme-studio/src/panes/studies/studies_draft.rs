//! The form of a plan: signs, conditions, a table of trials and questions, with the trials that they give.

use chereme_corpus::study::study_plan::{ConditionOrder, ExclusionRule, StudyPlan};
use eframe::egui::{Button, CollapsingHeader, DragValue, Response, Role, ScrollArea, Ui, WidgetInfo, vec2};

use super::drafted::StudyDraft;
use super::{StudiesPane, StudyFault, hypotheses, progress, wording};
use crate::command::{ChooserPurpose, WindowCommand};
use crate::context::PaneInput;
use crate::panes::{carry, combo, recombine};
use crate::script::script_edit;
use crate::words::{fill_text_braces, shell, studies_words as words};
use crate::work::studying;

/// The height of the table of trials in the form, in points.
const TABLE_HEIGHT: f32 = 130.0;

/// Shows the form.
pub(super) fn show_study_draft(pane: &mut StudiesPane, ui: &mut Ui, seen: &PaneInput<'_>) {
    let Some(mut draft) = pane.draft.take() else {
        return;
    };
    let before = draft.clone();
    let back = ui.button(seen.say_text(words::CLOSE_NEW)).clicked();
    show_study_change_notice(ui, seen, &draft);
    let come = std::mem::take(&mut pane.come);
    pane.planned.plan_changed_draft(&draft);
    show_draft_head(ui, seen, &mut draft, come);
    show_draft_conditions(ui, seen, &mut draft);
    show_trial_table(ui, seen, &mut draft);
    show_draft_questions(ui, seen, &mut draft, pane.planned.plan.as_ref());
    design(ui, seen, &mut draft);
    if let Some(plan) = &pane.planned.plan {
        hypotheses::show_draft_hypotheses(ui, seen, &mut draft, plan);
    }
    exclusions(ui, seen, &mut draft);
    let rest = ui.available_rect_before_wrap();
    let drop_area = ui.min_rect().union(rest);
    if let Some(carried) = carry::take_dropped_sign(ui, seen, drop_area) {
        draft.add_item(&token_item_name(seen, carried.token, &carried.gloss));
    }
    ui.separator();
    pane.planned.plan_changed_draft(&draft);
    show_store_plan_button(pane, ui, seen, &draft);
    if draft != before {
        pane.wrong.clear();
    }
    pane.show_study_faults(ui, seen, &pane.wrong);
    for fault in &pane.planned.faults {
        let unfinished = StudyFault::fault_from_error(fault);
        ui.weak(unfinished.report_study_fault(seen.language));
        if let Some(helps) = unfinished.helps(seen.language) {
            ui.weak(helps);
        }
    }
    if let Some(plan) = pane.planned.plan.take() {
        pane.show_plan_trials(ui, seen, &plan);
        pane.planned.plan = Some(plan);
    }
    match back {
        false => pane.draft = Some(draft),
        true => pane.leave_study_draft(draft),
    }
}

/// Shows what a change of a stored study means for its answers.
fn show_study_change_notice(ui: &mut Ui, seen: &PaneInput<'_>, draft: &StudyDraft) {
    let Some(it) = &draft.changes else {
        return;
    };
    let values: [(&str, &dyn std::fmt::Display); 3] =
        [("name", &it.name), ("people", &it.people), ("answers", &it.answers)];
    let renamed = draft.name.trim() != it.name;
    let template = match (it.people > 0, renamed) {
        (true, _) => words::CHANGES_ANSWERED,
        (false, true) => words::CHANGES_NAME,
        (false, false) => words::CHANGES_PLAN,
    };
    let text = fill_text_braces(seen.say_text(template), &values);
    match it.people > 0 {
        true => ui.colored_label(seen.pane_colours().warning, text),
        false => ui.weak(text),
    };
}

/// Shows the button that stores the plan.
fn show_store_plan_button(pane: &mut StudiesPane, ui: &mut Ui, seen: &PaneInput<'_>, draft: &StudyDraft) {
    let named = !draft.name.trim().is_empty();
    let answered = draft.changes.as_ref().filter(|changes| changes.people > 0);
    let free = answered.is_none_or(|changes| changes.name != draft.name.trim());
    let locked = seen.snapshot.is_read_only();
    let is_sound = pane.planned.faultless_plan().is_some();
    ui.horizontal_wrapped(|ui| {
        let idle = !seen.is_running(pane.planning) && !locked;
        let ready = named && free && idle && is_sound;
        let store = ui.add_enabled(ready, Button::new(seen.say_text(words::STORE)));
        let why = match (locked, named, free) {
            (true, ..) => Some(shell::READ_ONLY_WHY),
            (_, false, _) => Some(words::NEEDS_NAME),
            (.., false) => Some(words::NEEDS_OTHER_NAME),
            _ => None,
        };
        let store = match why {
            Some(why) => store.on_disabled_hover_text(seen.say_text(why)),
            None => store,
        };
        if store.clicked()
            && let Some(plan) = pane.planned.faultless_plan()
        {
            let job = studying::store_study_plan_job(plan.clone(), draft.distance_from.clone());
            pane.planning = Some(seen.request_work(job));
            pane.wrong.clear();
        }
        if let Some(why) = why.filter(|_| !locked) {
            ui.weak(seen.say_text(why));
        }
        progress(ui, seen, pane.planning, words::STORING);
    });
}

/// Shows a line of text with its name before it.
pub(super) fn show_draft_text_line(ui: &mut Ui, name: &str, hint: &str, text: &mut String) -> Response {
    let label = ui.weak(name);
    let width = (ui.available_width() - 2.0 * ui.spacing().button_padding.x).min(360.0);
    let shown = script_edit::draw_text_line(ui, text, |field| field.hint_text(hint).desired_width(width));
    let response = shown.response.response;
    response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, name));
    response.labelled_by(label.id)
}

fn show_draft_head(ui: &mut Ui, seen: &PaneInput<'_>, draft: &mut StudyDraft, come: bool) {
    let name = show_draft_text_line(ui, seen.say_text(words::NAME), "", &mut draft.name);
    if come {
        name.request_focus();
    }
    let hint = seen.say_text(words::SHOWN_TITLE_HINT);
    show_draft_text_line(ui, seen.say_text(words::SHOWN_TITLE), hint, &mut draft.title);
    let hint = seen.say_text(words::ITEMS_HINT);
    show_draft_text_line(ui, seen.say_text(words::ITEMS), hint, &mut draft.items);
    let add = ui.button(seen.say_text(words::ADD_CHOSEN));
    if add.on_hover_text(seen.say_text(words::ADD_CHOSEN_TIP)).clicked() {
        let showing = seen.shown.made.as_ref();
        let made = showing.and_then(|it| Some((it.made.token?, it.made.name.clone())));
        if let Some((token, gloss)) = made.or_else(|| recombine::selected_token(seen)) {
            draft.add_item(&token_item_name(seen, token, &gloss));
        }
    }
}

/// Returns a token as an item: by the gloss of its sign if it is the citation form, else by its number.
fn token_item_name(seen: &PaneInput<'_>, token: i64, gloss: &str) -> String {
    let signs = &seen.snapshot.overview.signs;
    let cites = signs
        .iter()
        .any(|sign| sign.citation == Some(token) && sign.gloss == gloss);
    match cites {
        true => gloss.to_owned(),
        false => format!("token:{token}"),
    }
}

fn show_draft_conditions(ui: &mut Ui, seen: &PaneInput<'_>, draft: &mut StudyDraft) {
    ui.weak(seen.say_text(words::CONDITIONS));
    let mut removed = None;
    let several = draft.conditions.len() > 1;
    for (at, [name, recipe]) in draft.conditions.iter_mut().enumerate() {
        ui.horizontal_wrapped(|ui| {
            let n = at + 1;
            let titles = [words::CONDITION, words::RECIPE];
            let widths = [100.0, 220.0];
            for ((text, title), wide) in [name, recipe].into_iter().zip(titles).zip(widths) {
                let title = fill_text_braces(seen.say_text(title), &[("n", &n)]);
                let shown = script_edit::draw_text_line(ui, text, |field| field.desired_width(wide));
                let response = shown.response.response;
                response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, &title));
            }
            if several
                && show_remove_line_button(
                    ui,
                    seen,
                    &fill_text_braces(seen.say_text(words::CONDITION), &[("n", &n)]),
                )
            {
                removed = Some(at);
            }
        });
    }
    if let Some(at) = removed {
        draft.conditions.remove(at);
    }
    if ui.button(seen.say_text(words::ADD_CONDITION)).clicked() {
        let empty = [String::new(), "{} | ".to_owned()];
        draft.conditions.push(empty);
    }
}

/// Shows the table of trials, which is typed, pasted, chosen or dropped.
fn show_trial_table(ui: &mut Ui, seen: &PaneInput<'_>, draft: &mut StudyDraft) {
    if !draft.others.is_empty() {
        ui.horizontal_wrapped(|ui| {
            let kept = fill_text_braces(seen.say_text(words::OTHERS), &[("n", &draft.others.len())]);
            ui.label(&kept);
            if show_remove_line_button(ui, seen, &kept) {
                draft.others.clear();
            }
        });
    }
    let header = CollapsingHeader::new(seen.say_text(words::TABLE_OF_TRIALS)).id_salt("table");
    let open = (!draft.table.trim().is_empty()).then_some(true);
    header.open(open).show(ui, |ui| {
        ui.weak(seen.say_text(words::TABLE_HELP));
        text_block(
            ui,
            seen.say_text(words::TABLE_OF_TRIALS),
            "item,condition,clip",
            &mut draft.table,
        );
        ui.horizontal_wrapped(|ui| {
            if ui.button(seen.say_text(words::CHOOSE_TABLE)).clicked() {
                seen.send_command(WindowCommand::Choose(ChooserPurpose::Trials));
            }
            let filled = !draft.table.is_empty();
            if filled && show_remove_line_button(ui, seen, seen.say_text(words::TABLE_OF_TRIALS)) {
                draft.table.clear();
                draft.file.clear();
            }
            if !draft.file.is_empty() {
                ui.weak(&draft.file);
            }
        });
    });
}

/// Shows a field for several lines, which scrolls.
pub(super) fn text_block(ui: &mut Ui, name: &str, hint: &str, text: &mut String) {
    let area = ScrollArea::vertical()
        .id_salt(name)
        .max_height(TABLE_HEIGHT)
        .min_scrolled_height(TABLE_HEIGHT);
    area.show(ui, |ui| {
        let wide = ui.available_width();
        let field = script_edit::draw_text_block(ui, text, |field| {
            field.hint_text(hint).desired_rows(4).desired_width(wide)
        });
        let response = field.response.response;
        response.widget_info(|| WidgetInfo::labeled(Role::MultilineTextInput, true, name));
    });
}

/// Shows the button that removes a line of the form.
pub(super) fn show_remove_line_button(ui: &mut Ui, seen: &PaneInput<'_>, what: &str) -> bool {
    let button = ui.add(Button::new(seen.say_text(words::REMOVE)).min_size(vec2(0.0, 16.0)));
    let name = fill_text_braces(seen.say_text(words::REMOVE_NTH), &[("what", &what)]);
    button.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    button.clicked()
}

fn show_draft_questions(ui: &mut Ui, seen: &PaneInput<'_>, draft: &mut StudyDraft, plan: Option<&StudyPlan>) {
    ui.weak(seen.say_text(words::QUESTIONS));
    let mut removed = None;
    let several = draft.questions.len() > 1;
    for (at, text) in draft.questions.iter_mut().enumerate() {
        ui.horizontal_wrapped(|ui| {
            let name = fill_text_braces(seen.say_text(words::QUESTION), &[("n", &(at + 1))]);
            let hint = seen.say_text(words::QUESTION_HINT);
            let shown = script_edit::draw_text_line(ui, text, |field| field.hint_text(hint).desired_width(260.0));
            let response = shown.response.response;
            response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, &name));
            if several && show_remove_line_button(ui, seen, &name) {
                removed = Some(at);
            }
        });
    }
    if let Some(at) = removed {
        draft.questions.remove(at);
    }
    ui.horizontal_wrapped(|ui| {
        if ui.button(seen.say_text(words::ADD_QUESTION)).clicked() {
            draft.questions.push(String::new());
        }
        let asked = draft.questions.iter().any(|question| question.starts_with("gloss="));
        let ask = ui.add_enabled(!asked, Button::new(seen.say_text(words::ASK_SIGN)));
        if ask.clicked() {
            draft.questions.push("gloss=items".to_owned());
        }
    });
    if let Some(plan) = plan {
        wording::show_question_wording(ui, seen, draft, plan);
    }
}

fn design(ui: &mut Ui, seen: &PaneInput<'_>, draft: &mut StudyDraft) {
    ui.horizontal_wrapped(|ui| {
        let label = ui.weak(seen.say_text(words::SCALE));
        ui.add(DragValue::new(&mut draft.scale).range(2..=9))
            .labelled_by(label.id);
        let label = ui.weak(seen.say_text(words::BLOCKS));
        ui.add(DragValue::new(&mut draft.blocks).range(1..=20))
            .labelled_by(label.id);
        let label = ui.weak(seen.say_text(words::SEED));
        ui.add(DragValue::new(&mut draft.seed))
            .on_hover_text(seen.say_text(words::SEED_TIP))
            .labelled_by(label.id);
        let orders = [
            (ConditionOrder::Latin, seen.say_text(words::LATIN).to_owned()),
            (ConditionOrder::Random, seen.say_text(words::RANDOM).to_owned()),
        ];
        combo::show_named_combo(ui, seen.say_text(words::ORDER), &mut draft.order, &orders);
        ui.checkbox(&mut draft.between, seen.say_text(words::BETWEEN));
    });
    let condition_names = draft.conditions.iter().map(|condition| condition[0].trim().to_owned());
    let names = condition_names.chain(draft.distance_from.clone());
    let mut all = vec![(None, seen.say_text(words::NO_DISTANCE).to_owned())];
    for name in names.filter(|name| !name.is_empty()) {
        if all.iter().all(|entry| entry.1 != name) {
            all.push((Some(name.clone()), name));
        }
    }
    let name = seen.say_text(words::DISTANCE_FROM);
    combo::show_named_combo(ui, name, &mut draft.distance_from, &all);
    if seen.snapshot.is_read_only() {
        ui.weak(seen.say_text(shell::READ_ONLY_WHY));
    }
}

/// Shows the rules by which participants are left out.
fn exclusions(ui: &mut Ui, seen: &PaneInput<'_>, draft: &mut StudyDraft) {
    let header = CollapsingHeader::new(seen.say_text(words::EXCLUSIONS)).id_salt("exclusions");
    header.show(ui, |ui| {
        for (rule, text) in [
            (ExclusionRule::Unfinished, words::LEAVE_UNFINISHED),
            (ExclusionRule::OneValue, words::LEAVE_ONE_VALUE),
        ] {
            let mut on = draft.exclusions.contains(&rule);
            if ui.checkbox(&mut on, seen.say_text(text)).changed() {
                draft.exclusions.retain(|exclusion| *exclusion != rule);
                draft.exclusions.extend(on.then_some(rule));
            }
        }
        let checks = draft
            .exclusions
            .iter()
            .position(|exclusion| matches!(exclusion, ExclusionRule::ChecksWrong(_)));
        ui.horizontal_wrapped(|ui| {
            let mut on = checks.is_some();
            let text = seen.say_text(words::LEAVE_CHECKS);
            let changed = ui.checkbox(&mut on, text).changed();
            if let Some(ExclusionRule::ChecksWrong(n)) = checks.map(|at| &mut draft.exclusions[at]) {
                let field = ui.add(DragValue::new(n).range(0..=100));
                field.widget_info(|| WidgetInfo::labeled(Role::SpinButton, true, text));
            }
            match (changed, checks) {
                (true, Some(at)) => drop(draft.exclusions.remove(at)),
                (true, None) => draft.exclusions.push(ExclusionRule::ChecksWrong(0)),
                _ => {}
            }
        });
    });
}
