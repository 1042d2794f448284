//! Editable lines: Enter or a move to another field stores the text, Escape restores it.

use eframe::egui::{ComboBox, Grid, Id, Key, RichText, Role, Ui, WidgetInfo};

use crate::context::PaneInput;
use crate::panes::complete_pane::{CompletionLine, show_completion_line};
use crate::script::script_edit;
use crate::words::{InterfaceText, inspector as words};

/// Returns a change of the properties that `set` sets.
pub(super) fn new_change<T: Default>(set: impl FnOnce(&mut T)) -> T {
    let mut change = T::default();
    set(&mut change);
    change
}

/// Shows a name and a value.
pub(super) fn name_and_value(ui: &mut Ui, seen: &PaneInput<'_>, text: InterfaceText, value: &str) {
    let name = RichText::new(seen.say_text(text)).weak();
    ui.add(eframe::egui::Label::new(name).extend());
    ui.add(eframe::egui::Label::new(value).wrap());
    ui.end_row();
}

/// Shows lines in two columns.
pub(super) fn show_inspector_grid(ui: &mut Ui, id: &str, content: impl FnOnce(&mut Ui)) {
    let names = (ui.available_width() * 0.3).clamp(56.0, 170.0);
    Grid::new(id).num_columns(2).min_col_width(names).show(ui, content);
}

/// Shows an editable line; returns the new text if it changed.
pub(super) fn show_editable_line(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: Id,
    text: InterfaceText,
    value: &str,
) -> Option<String> {
    let none = |_: &str| Vec::new();
    show_line_with_completion(ui, seen, id, text, value, &none)
}

/// Shows an editable line with completion.
pub(super) fn show_line_with_completion(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: Id,
    caption: InterfaceText,
    value: &str,
    candidates: &dyn Fn(&str) -> Vec<String>,
) -> Option<String> {
    let label = ui.weak(seen.say_text(caption)).id;
    let changed = show_editable_field(ui, seen, id, label, value, candidates);
    ui.end_row();
    changed
}

/// Shows the field of an editable line, named by a label beside it; returns the new text if it changed.
pub(super) fn show_editable_field(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: Id,
    label: Id,
    value: &str,
    candidates: &dyn Fn(&str) -> Vec<String>,
) -> Option<String> {
    let kept: Option<String> = ui.data(|data| data.get_temp(id));
    let mut text = kept.clone().unwrap_or_else(|| value.to_owned());
    let focused = ui.memory(|memory| memory.has_focus(id));
    let away = focused && ui.input(|input| input.key_pressed(Key::Escape));
    let line = CompletionLine {
        width: (ui.available_width() - 4.0).max(60.0),
        ..CompletionLine::default()
    };
    let typed = show_completion_line(ui, id, line, &mut text, candidates);
    let labelled_response = typed.response.labelled_by(label);
    let response = labelled_response.on_hover_text(seen.say_text(words::EDIT_TIP));
    if away {
        ui.data_mut(|data| data.remove::<String>(id));
        return None;
    }
    let done = response.lost_focus() || (typed.entered && typed.changed);
    if done || (kept.is_some() && !response.has_focus() && !focused) {
        ui.data_mut(|data| data.remove::<String>(id));
        return (text != value).then_some(text);
    }
    if typed.changed {
        ui.data_mut(|data| data.insert_temp(id, text));
    }
    None
}

/// Shows an editable text of several lines; returns the new text if it changed.
pub(super) fn show_editable_notes(ui: &mut Ui, seen: &PaneInput<'_>, id: Id, value: &str) -> Option<String> {
    let label = ui.weak(seen.say_text(words::NOTES)).id;
    let kept: Option<String> = ui.data(|data| data.get_temp(id));
    let mut text = kept.clone().unwrap_or_else(|| value.to_owned());
    let width = (ui.available_width() - 4.0).max(60.0);
    let field = script_edit::draw_text_block(ui, &mut text, |field| field.id(id).desired_rows(1).desired_width(width));
    let response = field.response.response.labelled_by(label);
    ui.end_row();
    if response.changed() {
        ui.data_mut(|data| data.insert_temp(id, text));
    } else if kept.is_some() && !response.has_focus() {
        ui.data_mut(|data| data.remove::<String>(id));
        return (text != value).then_some(text);
    }
    None
}

/// Shows a list to choose from; returns the choice, if it is new.
pub(super) fn show_inspector_choice<T: PartialEq + Clone>(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    text: InterfaceText,
    now: &T,
    all: &[(T, String)],
) -> Option<T> {
    ui.weak(seen.say_text(text));
    let shown = all.iter().find(|(other, _)| other == now).map_or("", |(_, name)| name);
    let mut value = now.clone();
    let combo = ComboBox::from_id_salt(text.text_id()).selected_text(shown).width(0.0);
    let inner = combo.show_ui(ui, |ui| {
        for (it, name) in all {
            ui.selectable_value(&mut value, it.clone(), name);
        }
    });
    let name = format!("{}: {shown}", seen.say_text(text));
    inner
        .response
        .widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, &name));
    ui.end_row();
    (value != *now).then_some(value)
}

/// Shows the title of a part.
pub(super) fn show_part_title(ui: &mut Ui, text: &str, what: &str) {
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(text).small().weak());
        ui.strong(what);
    });
}
