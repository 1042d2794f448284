//! The form of a plan: signs, conditions, a table of trials and questions, with the trials that they give.

use chereme_corpus::study::plan::{Exclusion, Order, Plan};
use eframe::egui::{
    Button, CollapsingHeader, DragValue, Response, Role, ScrollArea, Ui, WidgetInfo, vec2,
};

use super::drafted::Draft;
use super::{Studies, Wrong, hypotheses, progress, wording};
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::file_dialogs::Choose;
use crate::panes::{carry, combo, recombine};
use crate::script::edit;
use crate::words::{fill, shell, studies as words};
use crate::work::studying;

/// The height of the table of trials in the form, in points.
const TABLE_HEIGHT: f32 = 130.0;

/// Shows the form.
pub(super) fn show(pane: &mut Studies, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
    let Some(mut draft) = pane.draft.take() else {
        return;
    };
    let before = draft.clone();
    let back = ui.button(seen.say(words::CLOSE_NEW)).clicked();
    changed(ui, seen, &draft);
    let come = std::mem::take(&mut pane.come);
    pane.planned.follow(&draft);
    head(ui, seen, &mut draft, come);
    conditions(ui, seen, &mut draft);
    table(ui, seen, &mut draft, out);
    questions(ui, seen, &mut draft, pane.planned.plan.as_ref());
    design(ui, seen, &mut draft);
    if let Some(plan) = &pane.planned.plan {
        hypotheses::show(ui, seen, &mut draft, plan);
    }
    exclusions(ui, seen, &mut draft);
    let rest = ui.available_rect_before_wrap();
    let whole = ui.min_rect().union(rest);
    if let Some(carried) = carry::let_go(ui, seen, whole) {
        draft.add_item(&item(seen, carried.token, &carried.gloss));
    }
    ui.separator();
    pane.planned.follow(&draft);
    store(pane, ui, seen, &draft, out);
    if draft != before {
        pane.wrong.clear();
    }
    pane.trouble(ui, seen, &pane.wrong);
    for fault in &pane.planned.faults {
        let unfinished = Wrong::of(fault);
        ui.weak(unfinished.said(seen.language));
        if let Some(helps) = unfinished.helps(seen.language) {
            ui.weak(helps);
        }
    }
    if let Some(plan) = pane.planned.plan.take() {
        pane.trials(ui, seen, &plan, out);
        pane.planned.plan = Some(plan);
    }
    match back {
        false => pane.draft = Some(draft),
        true => pane.leave(draft),
    }
}

/// Shows what a change of a stored study means for its answers.
fn changed(ui: &mut Ui, seen: &PaneInput<'_>, draft: &Draft) {
    let Some(it) = &draft.changes else {
        return;
    };
    let values: [(&str, &dyn std::fmt::Display); 3] = [
        ("name", &it.name),
        ("people", &it.people),
        ("answers", &it.answers),
    ];
    let renamed = draft.name.trim() != it.name;
    let text = match (it.people > 0, renamed) {
        (true, _) => words::CHANGES_ANSWERED,
        (false, true) => words::CHANGES_NAME,
        (false, false) => words::CHANGES_PLAN,
    };
    let text = fill(seen.say(text), &values);
    match it.people > 0 {
        true => ui.colored_label(seen.colours().warning, text),
        false => ui.weak(text),
    };
}

/// Shows the button that stores the plan.
fn store(pane: &mut Studies, ui: &mut Ui, seen: &PaneInput<'_>, draft: &Draft, out: &mut Outbox) {
    let named = !draft.name.trim().is_empty();
    let answered = draft.changes.as_ref().filter(|it| it.people > 0);
    let free = answered.is_none_or(|it| it.name != draft.name.trim());
    let locked = seen.snapshot.is_read_only();
    let is_sound = pane.planned.sound().is_some();
    ui.horizontal_wrapped(|ui| {
        let idle = !seen.is_running(pane.planning) && !locked;
        let ready = named && free && idle && is_sound;
        let store = ui.add_enabled(ready, Button::new(seen.say(words::STORE)));
        let why = match (locked, named, free) {
            (true, ..) => Some(shell::READ_ONLY_WHY),
            (_, false, _) => Some(words::NEEDS_NAME),
            (.., false) => Some(words::NEEDS_OTHER_NAME),
            _ => None,
        };
        let store = match why {
            Some(why) => store.on_disabled_hover_text(seen.say(why)),
            None => store,
        };
        if store.clicked()
            && let Some(plan) = pane.planned.sound()
        {
            let job = studying::plan(plan.clone(), draft.distance_from.clone());
            pane.planning = Some(out.work(job));
            pane.wrong.clear();
        }
        if let Some(why) = why.filter(|_| !locked) {
            ui.weak(seen.say(why));
        }
        progress(ui, seen, pane.planning, words::STORING, out);
    });
}

/// Shows a line of text with its name before it.
pub(super) fn line(ui: &mut Ui, name: &str, hint: &str, text: &mut String) -> Response {
    let label = ui.weak(name);
    let width = (ui.available_width() - 2.0 * ui.spacing().button_padding.x).min(360.0);
    let shown = edit::line(ui, text, |field| field.hint_text(hint).desired_width(width));
    let response = shown.response.response;
    response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, name));
    response.labelled_by(label.id)
}

fn head(ui: &mut Ui, seen: &PaneInput<'_>, draft: &mut Draft, come: bool) {
    let name = line(ui, seen.say(words::NAME), "", &mut draft.name);
    if come {
        name.request_focus();
    }
    let hint = seen.say(words::SHOWN_TITLE_HINT);
    line(ui, seen.say(words::SHOWN_TITLE), hint, &mut draft.title);
    let hint = seen.say(words::ITEMS_HINT);
    line(ui, seen.say(words::ITEMS), hint, &mut draft.items);
    let add = ui.button(seen.say(words::ADD_CHOSEN));
    if add.on_hover_text(seen.say(words::ADD_CHOSEN_TIP)).clicked() {
        let made = seen.shown.made.as_ref();
        let made = made.and_then(|it| Some((it.made.token?, it.made.name.clone())));
        if let Some((token, gloss)) = made.or_else(|| recombine::selected_token(seen)) {
            draft.add_item(&item(seen, token, &gloss));
        }
    }
}

/// Returns a token as an item: by the gloss of its sign if it is the citation form, else by its number.
fn item(seen: &PaneInput<'_>, token: i64, gloss: &str) -> String {
    let signs = &seen.snapshot.overview.signs;
    let cites = signs
        .iter()
        .any(|it| it.citation == Some(token) && it.gloss == gloss);
    match cites {
        true => gloss.to_owned(),
        false => format!("token:{token}"),
    }
}

fn conditions(ui: &mut Ui, seen: &PaneInput<'_>, draft: &mut Draft) {
    ui.weak(seen.say(words::CONDITIONS));
    let mut removed = None;
    let several = draft.conditions.len() > 1;
    for (at, [name, recipe]) in draft.conditions.iter_mut().enumerate() {
        ui.horizontal_wrapped(|ui| {
            let n = at + 1;
            let titles = [words::CONDITION, words::RECIPE];
            let widths = [100.0, 220.0];
            for ((text, title), wide) in [name, recipe].into_iter().zip(titles).zip(widths) {
                let title = fill(seen.say(title), &[("n", &n)]);
                let shown = edit::line(ui, text, |field| field.desired_width(wide));
                let response = shown.response.response;
                response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, &title));
            }
            if several && remove(ui, seen, &fill(seen.say(words::CONDITION), &[("n", &n)])) {
                removed = Some(at);
            }
        });
    }
    if let Some(at) = removed {
        draft.conditions.remove(at);
    }
    if ui.button(seen.say(words::ADD_CONDITION)).clicked() {
        let empty = [String::new(), "{} | ".to_owned()];
        draft.conditions.push(empty);
    }
}

/// Shows the table of trials, which is typed, pasted, chosen or dropped.
fn table(ui: &mut Ui, seen: &PaneInput<'_>, draft: &mut Draft, out: &mut Outbox) {
    if !draft.others.is_empty() {
        ui.horizontal_wrapped(|ui| {
            let kept = fill(seen.say(words::OTHERS), &[("n", &draft.others.len())]);
            ui.label(&kept);
            if remove(ui, seen, &kept) {
                draft.others.clear();
            }
        });
    }
    let header = CollapsingHeader::new(seen.say(words::TABLE_OF_TRIALS)).id_salt("table");
    let open = (!draft.table.trim().is_empty()).then_some(true);
    header.open(open).show(ui, |ui| {
        ui.weak(seen.say(words::TABLE_HELP));
        text_block(
            ui,
            seen.say(words::TABLE_OF_TRIALS),
            "item,condition,clip",
            &mut draft.table,
        );
        ui.horizontal_wrapped(|ui| {
            if ui.button(seen.say(words::CHOOSE_TABLE)).clicked() {
                out.send(Command::Choose(Choose::Trials));
            }
            let filled = !draft.table.is_empty();
            if filled && remove(ui, seen, seen.say(words::TABLE_OF_TRIALS)) {
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
        let field = edit::block(ui, text, |field| {
            field.hint_text(hint).desired_rows(4).desired_width(wide)
        });
        let response = field.response.response;
        response.widget_info(|| WidgetInfo::labeled(Role::MultilineTextInput, true, name));
    });
}

/// Shows the button that removes a line of the form.
pub(super) fn remove(ui: &mut Ui, seen: &PaneInput<'_>, what: &str) -> bool {
    let button = ui.add(Button::new(seen.say(words::REMOVE)).min_size(vec2(0.0, 16.0)));
    let name = fill(seen.say(words::REMOVE_NTH), &[("what", &what)]);
    button.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    button.clicked()
}

fn questions(ui: &mut Ui, seen: &PaneInput<'_>, draft: &mut Draft, plan: Option<&Plan>) {
    ui.weak(seen.say(words::QUESTIONS));
    let mut removed = None;
    let several = draft.questions.len() > 1;
    for (at, text) in draft.questions.iter_mut().enumerate() {
        ui.horizontal_wrapped(|ui| {
            let name = fill(seen.say(words::QUESTION), &[("n", &(at + 1))]);
            let hint = seen.say(words::QUESTION_HINT);
            let shown = edit::line(ui, text, |field| field.hint_text(hint).desired_width(260.0));
            let response = shown.response.response;
            response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, &name));
            if several && remove(ui, seen, &name) {
                removed = Some(at);
            }
        });
    }
    if let Some(at) = removed {
        draft.questions.remove(at);
    }
    ui.horizontal_wrapped(|ui| {
        if ui.button(seen.say(words::ADD_QUESTION)).clicked() {
            draft.questions.push(String::new());
        }
        let asked = draft.questions.iter().any(|it| it.starts_with("gloss="));
        let ask = ui.add_enabled(!asked, Button::new(seen.say(words::ASK_SIGN)));
        if ask.clicked() {
            draft.questions.push("gloss=items".to_owned());
        }
    });
    if let Some(plan) = plan {
        wording::show(ui, seen, draft, plan);
    }
}

fn design(ui: &mut Ui, seen: &PaneInput<'_>, draft: &mut Draft) {
    ui.horizontal_wrapped(|ui| {
        let label = ui.weak(seen.say(words::SCALE));
        ui.add(DragValue::new(&mut draft.scale).range(2..=9))
            .labelled_by(label.id);
        let label = ui.weak(seen.say(words::BLOCKS));
        ui.add(DragValue::new(&mut draft.blocks).range(1..=20))
            .labelled_by(label.id);
        let label = ui.weak(seen.say(words::SEED));
        ui.add(DragValue::new(&mut draft.seed))
            .on_hover_text(seen.say(words::SEED_TIP))
            .labelled_by(label.id);
        let orders = [
            (Order::Latin, seen.say(words::LATIN).to_owned()),
            (Order::Random, seen.say(words::RANDOM).to_owned()),
        ];
        combo::named(ui, seen.say(words::ORDER), &mut draft.order, &orders);
        ui.checkbox(&mut draft.between, seen.say(words::BETWEEN));
    });
    let names = draft.conditions.iter().map(|it| it[0].trim().to_owned());
    let names = names.chain(draft.distance_from.clone());
    let mut all = vec![(None, seen.say(words::NO_DISTANCE).to_owned())];
    for name in names.filter(|it| !it.is_empty()) {
        if all.iter().all(|it| it.1 != name) {
            all.push((Some(name.clone()), name));
        }
    }
    let name = seen.say(words::DISTANCE_FROM);
    combo::named(ui, name, &mut draft.distance_from, &all);
    if seen.snapshot.is_read_only() {
        ui.weak(seen.say(shell::READ_ONLY_WHY));
    }
}

/// Shows the rules by which participants are left out.
fn exclusions(ui: &mut Ui, seen: &PaneInput<'_>, draft: &mut Draft) {
    let header = CollapsingHeader::new(seen.say(words::EXCLUSIONS)).id_salt("exclusions");
    header.show(ui, |ui| {
        for (rule, text) in [
            (Exclusion::Unfinished, words::LEAVE_UNFINISHED),
            (Exclusion::OneValue, words::LEAVE_ONE_VALUE),
        ] {
            let mut on = draft.exclusions.contains(&rule);
            if ui.checkbox(&mut on, seen.say(text)).changed() {
                draft.exclusions.retain(|it| *it != rule);
                draft.exclusions.extend(on.then_some(rule));
            }
        }
        let checks = draft
            .exclusions
            .iter()
            .position(|it| matches!(it, Exclusion::ChecksWrong(_)));
        ui.horizontal_wrapped(|ui| {
            let mut on = checks.is_some();
            let text = seen.say(words::LEAVE_CHECKS);
            let changed = ui.checkbox(&mut on, text).changed();
            if let Some(Exclusion::ChecksWrong(n)) = checks.map(|at| &mut draft.exclusions[at]) {
                let field = ui.add(DragValue::new(n).range(0..=100));
                field.widget_info(|| WidgetInfo::labeled(Role::SpinButton, true, text));
            }
            match (changed, checks) {
                (true, Some(at)) => drop(draft.exclusions.remove(at)),
                (true, None) => draft.exclusions.push(Exclusion::ChecksWrong(0)),
                _ => {}
            }
        });
    });
}
