//! The form of a new plan: signs, conditions and questions, with the trials that they give.

use chereme_corpus::study::plan::Order;
use eframe::egui::{Button, DragValue, Response, Role, Ui, WidgetInfo, vec2};

use super::data::Draft;
use super::{Studies, Wrong, progress};
use crate::context::{Outbox, PaneInput};
use crate::panes::{carry, combo, recombine};
use crate::script::edit;
use crate::words::{fill, shell, studies as words};
use crate::work::studying;

/// Shows the form.
pub(super) fn show(pane: &mut Studies, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
    let Some(mut draft) = pane.draft.take() else {
        return;
    };
    let before = draft.clone();
    let back = ui.button(seen.say(words::CLOSE_NEW)).clicked();
    let come = std::mem::take(&mut pane.come);
    head(ui, seen, &mut draft, come);
    conditions(ui, seen, &mut draft);
    questions(ui, seen, &mut draft);
    design(ui, seen, &mut draft);
    let rest = ui.available_rect_before_wrap();
    let whole = ui.min_rect().union(rest);
    if let Some(carried) = carry::let_go(ui, seen, whole) {
        draft.add_item(&item(seen, carried.token, &carried.gloss));
    }
    ui.separator();
    let planned = draft.request().plan();
    let named = !draft.name.trim().is_empty();
    ui.horizontal_wrapped(|ui| {
        let ready = named && planned.is_ok() && !seen.is_running(pane.planning);
        let store = ui.add_enabled(ready, Button::new(seen.say(words::STORE)));
        let store = match named {
            true => store,
            false => store.on_disabled_hover_text(seen.say(words::NEEDS_NAME)),
        };
        if store.clicked()
            && let Ok(plan) = &planned
        {
            pane.wrong = None;
            pane.planning = Some(out.work(studying::plan(plan.clone())));
        }
        progress(ui, seen, pane.planning, words::STORING, out);
    });
    if draft != before {
        pane.wrong = None;
    }
    pane.trouble(ui, seen, pane.wrong.as_ref());
    match &planned {
        Ok(plan) => pane.trials(ui, seen, plan, out),
        Err(error) => {
            let unfinished = Wrong {
                text: error.to_string(),
                remedy: error.remedy(),
            };
            ui.weak(crate::words::spoken(&unfinished.text, seen.language));
            let helps = unfinished.remedy.as_ref();
            let helps = helps.and_then(|it| crate::overlay::remedy::here(it, seen.language));
            if let Some(helps) = helps {
                ui.weak(helps);
            }
        }
    }
    match back {
        false => pane.draft = Some(draft),
        true => {
            pane.come = true;
            if draft != Draft::default() {
                pane.unfinished = Some(draft);
            }
        }
    }
}

/// Shows a line of text with its name before it.
fn line(ui: &mut Ui, name: &str, hint: &str, text: &mut String) -> Response {
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

/// Shows the button that removes a line of the form.
fn remove(ui: &mut Ui, seen: &PaneInput<'_>, what: &str) -> bool {
    let button = ui.add(Button::new(seen.say(words::REMOVE)).min_size(vec2(0.0, 16.0)));
    let name = fill(seen.say(words::REMOVE_NTH), &[("what", &what)]);
    button.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    button.clicked()
}

fn questions(ui: &mut Ui, seen: &PaneInput<'_>, draft: &mut Draft) {
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
}

fn design(ui: &mut Ui, seen: &PaneInput<'_>, draft: &mut Draft) {
    ui.horizontal_wrapped(|ui| {
        let label = ui.weak(seen.say(words::SCALE));
        ui.add(DragValue::new(&mut draft.scale).range(2..=9))
            .labelled_by(label.id);
        let label = ui.weak(seen.say(words::BLOCKS));
        ui.add(DragValue::new(&mut draft.blocks).range(1..=20))
            .labelled_by(label.id);
        let orders = [
            (Order::Latin, seen.say(words::LATIN).to_owned()),
            (Order::Random, seen.say(words::RANDOM).to_owned()),
        ];
        combo::named(ui, seen.say(words::ORDER), &mut draft.order, &orders);
        ui.checkbox(&mut draft.between, seen.say(words::BETWEEN));
    });
    if seen.snapshot.is_read_only() {
        ui.weak(seen.say(shell::READ_ONLY_WHY));
    }
}
