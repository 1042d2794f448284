//! Pickers that show values: handshapes as pictures, placements on a body, movements as glyphs, orientations around a
//! rose of directions; any other inventory as names.
//!
//! [`pick`] draws the picker that fits an inventory and returns the id of the picked value; [`button`] opens the same
//! picker from a button that shows the current value; [`picture`] draws one value anywhere. Every place that picks has
//! its own [`Picker`], which holds the state.
//!
//! In every picker one types to filter, walks with the arrow keys, and picks with Enter, with the mouse, or with Ctrl
//! and the digit on the cell; the digit alone is enough if no name of a value begins with a digit. Every cell is
//! labelled by [`data::label`].

pub(crate) mod data;
pub(crate) mod hamnosys;

mod areas;
pub(crate) mod board;
mod body;
mod cells;
mod gallery;
mod glyph;
mod keys;
mod paint;

mod places;
mod rose;
mod worn;

use chereme_corpus::value_pictures::Panel;
use chereme_sign::Inventory;
use eframe::egui::{
    Id, Key, Popup, PopupCloseBehavior, Rect, Response, RichText, Role, ScrollArea, Sense,
    StrokeKind, TextStyle, Ui, WidgetInfo, WidgetText, pos2, vec2,
};

use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::panes::inspector::Thing;
use crate::script::edit;
use crate::words::{fill, pickers as words};
use cells::{Cell, Cells};
use data::PickerForm;
use keys::Pressed;
pub(crate) use paint::fitted;

/// A pane narrower than this, in points, has no room for an embedded picker.
const LEAST: f32 = 240.0;

/// The state of a picker.
#[derive(Debug, Default)]
pub(crate) struct Picker {
    filter: String,
    /// The id of the value at the keyboard cursor.
    at: Option<String>,
    /// The cell that has the keyboard focus.
    focus: Option<Id>,
    /// Whether the picker was just opened, so that it takes the keyboard.
    fresh: bool,
    /// Whether its button opens the picker as soon as it is drawn.
    opens: bool,
    /// The ids of the values that the digits pick, from 1 on; the first values by default.
    pub(crate) digits: Vec<String>,
    /// The inventory and the value whose details were requested.
    asked: Option<(String, String)>,
    /// The view of the body whose places are shown.
    panel: Panel,
    /// Whether to switch to the pictures that show the value at the keyboard cursor.
    turns: bool,
    /// For how many more frames to scroll to that value; an opened picker has its final size after the first ones.
    reveals: u8,
    turned: bool,
    depth: usize,
}

impl Picker {
    /// Shows a value in the inspector if its details were requested with Ctrl and a click, or the other mouse button.
    pub(crate) fn inspect(&mut self, seen: &PaneInput<'_>, out: &mut Outbox) {
        if let Some(thing) = self.asked(seen) {
            out.send(Command::Inspect(thing));
        }
    }

    /// Returns that value, and clears the request.
    pub(crate) fn asked(&mut self, seen: &PaneInput<'_>) -> Option<Thing> {
        let (inventory, value) = self.asked.take()?;
        let mut all = seen.snapshot.overview.inventories.iter();
        let stored = all.find(|it| it.inventory.id == inventory)?;
        Some(Thing::Value(stored.id, value))
    }

    /// Returns a picker that its button opens as soon as it is drawn.
    pub(crate) fn opening() -> Self {
        Self {
            opens: true,
            ..Self::fresh()
        }
    }

    /// Returns a picker that takes the keyboard when it is first drawn.
    pub(crate) fn fresh() -> Self {
        Self {
            fresh: true,
            turns: true,
            reveals: 3,
            depth: 1,
            ..Self::default()
        }
    }
}

/// Draws the picker of an inventory, and returns the id of the value that was picked.
///
/// `chosen` is the current value; the picker takes the available width, and the height it needs.
pub(crate) fn pick(
    ui: &mut Ui,
    picker: &mut Picker,
    seen: &PaneInput<'_>,
    inventory: &Inventory,
    chosen: Option<&str>,
) -> Option<String> {
    if picker.at.is_none() {
        picker.at = chosen.map(str::to_owned);
    }
    ui.push_id(("picker", &inventory.id), |ui| {
        let pressed = filter(ui, picker, seen, inventory);
        let shown = data::fitting(inventory, &picker.filter);
        if shown.is_empty() {
            ui.label(fill(seen.say(words::NONE), &[("text", &picker.filter)]));
            return None;
        }
        let cells = Cells {
            seen,
            inventory,
            chosen,
            pressed,
        };
        let picked = match data::kind(inventory) {
            PickerForm::Body => body::show(ui, picker, &cells, &shown),
            PickerForm::Rose => rose::show(ui, picker, &cells, &shown),
            PickerForm::Hands => hands(ui, picker, &cells, &shown),
            kind => grid(ui, picker, &cells, &shown, kind),
        };
        let at = picker.at.as_deref().and_then(|id| inventory.get(id));
        let label = at.map(|value| data::label(value, seen.language));
        let hint = label.map_or(String::new(), |label| {
            fill(seen.say(words::ENTER), &[("value", &label)])
        });
        ui.label(RichText::new(hint).small());
        picked
    })
    .inner
}

/// Draws a button with the current value; a click opens the picker below it. Returns the id of the picked value. `name`
/// is the accessible name of the button.
pub(crate) fn button(
    ui: &mut Ui,
    picker: &mut Picker,
    seen: &PaneInput<'_>,
    inventory: &Inventory,
    chosen: Option<&str>,
    name: &str,
) -> Option<String> {
    let response = face(ui, seen, inventory, chosen, name);
    below(ui, &response, picker, seen, (inventory, chosen, name))
}

/// Opens the picker of an inventory below a clicked widget, and returns the id of the picked value; `chosen` and `name`
/// are those of [`button`].
pub(crate) fn below(
    ui: &mut Ui,
    response: &Response,
    picker: &mut Picker,
    seen: &PaneInput<'_>,
    (inventory, chosen, name): (&Inventory, Option<&str>, &str),
) -> Option<String> {
    if response.clicked() {
        *picker = Picker::fresh();
    }
    let screen = ui.ctx().content_rect().size();
    let popup = Popup::from_toggle_button_response(response)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .accessible_name(name);
    // The picker stays within its pane, so that it does not cover the stage with the picked value.
    let pane = ui.clip_rect();
    let wide = data::width(data::kind(inventory)).min(screen.x - 48.0);
    let room = pane.width() - 24.0;
    let width = if room >= LEAST { wide.min(room) } else { wide };
    let left = response.rect.left().min(pane.right() - width - 20.0);
    let left = left.max(pane.left().max(4.0));
    let below = Rect::from_x_y_ranges(left..=left + width, response.rect.y_range());
    let popup = popup.anchor(below);
    // Above or below the button, whichever has more room, without a margin and the status line.
    let (over, under) = (response.rect.top(), screen.y - response.rect.bottom());
    let room = over.max(under) - 70.0;
    // A narrower picker is higher.
    let height = data::height(data::kind(inventory)) * wide / width;
    let height = height.min(room.max(260.0));
    let id = popup.get_id();
    if std::mem::take(&mut picker.opens) {
        Popup::open_id(ui.ctx(), id);
    }
    let picked = popup.show(|ui| {
        ui.set_width(width);
        ui.set_max_height(height);
        pick(ui, picker, seen, inventory, chosen)
    });
    let away = picked.is_some() && ui.input(|input| input.key_pressed(Key::Escape));
    let picked = picked.and_then(|it| it.inner);
    if picked.is_some() || away {
        Popup::close_id(ui.ctx(), id);
        response.request_focus();
    }
    picked
}

/// Paints the picture of a value if it has one: a hand, a place on the body, a glyph, an arrow. Returns whether there
/// is one.
#[allow(dead_code, reason = "for whoever shows values")]
pub(crate) fn picture(
    ui: &Ui,
    rect: Rect,
    seen: &PaneInput<'_>,
    inventory: &Inventory,
    value: &str,
) -> bool {
    inventory
        .find(value)
        .is_some_and(|value| paint::value(ui, rect, seen, inventory, value))
}

fn filter(
    ui: &mut Ui,
    picker: &mut Picker,
    seen: &PaneInput<'_>,
    inventory: &Inventory,
) -> Pressed {
    let id = ui.scope_id().with("filter");
    let focused = ui.memory(|memory| memory.has_focus(id));
    let here = focused || cells::focused(ui, picker);
    let digits = !data::has_numbers(inventory);
    let pressed = if here {
        keys::take(ui, digits && focused)
    } else {
        Pressed::default()
    };
    let before = picker.filter.clone();
    let hint = seen.say(words::FILTER);
    let field = edit::line(ui, &mut picker.filter, |field| {
        let field = field.id(id).hint_text(hint);
        field.desired_width(f32::INFINITY)
    });
    let response = field.response.response;
    let text = picker.filter.clone();
    response.widget_info(|| WidgetInfo {
        label: Some(hint.to_owned()),
        ..WidgetInfo::text_edit(true, &before, &text, hint)
    });
    if std::mem::take(&mut picker.fresh) {
        response.request_focus();
    }
    if response.changed() {
        picker.at = data::fitting(inventory, &picker.filter)
            .first()
            .map(|at| inventory.values[*at].id.clone());
    }
    pressed
}

/// The width of the preview hand, and the least width of the pictures beside it, in points.
const WORN: f32 = 176.0;
const BESIDE: f32 = 250.0;
/// The width of the preview hand below the pictures, and the least height for both, in points.
const BELOW: f32 = 112.0;
const HIGH: f32 = 350.0;

/// Draws pictures of hands, and beside or below them a preview hand in the handshape under the pointer or the keyboard
/// cursor.
fn hands(ui: &mut Ui, picker: &mut Picker, cells: &Cells<'_>, shown: &[usize]) -> Option<String> {
    let room = ui.available_width();
    let high = ui.available_height();
    if room < WORN + BESIDE {
        if high >= HIGH {
            let left = high - BELOW - 8.0;
            let picked = ui
                .allocate_ui(vec2(room, left), |ui| {
                    ui.set_max_height(left);
                    grid(ui, picker, cells, shown, PickerForm::Hands)
                })
                .inner;
            let (rect, _) = ui.allocate_exact_size(vec2(room, BELOW), Sense::hover());
            let square = Rect::from_min_size(rect.min, vec2(BELOW, BELOW));
            let text = Rect::from_min_max(square.right_top() + vec2(6.0, 4.0), rect.max);
            worn_hand(ui, (square, text), picker, cells, shown);
            return picked;
        }
        return grid(ui, picker, cells, shown, PickerForm::Hands);
    }
    ui.horizontal_top(|ui| {
        let picked = ui
            .allocate_ui(vec2(room - WORN - 8.0, high), |ui| {
                ui.set_width(room - WORN - 8.0);
                grid(ui, picker, cells, shown, PickerForm::Hands)
            })
            .inner;
        let (rect, _) = ui.allocate_exact_size(vec2(WORN, WORN + 64.0), Sense::hover());
        let square = Rect::from_min_size(rect.min, vec2(WORN, WORN));
        let text = Rect::from_min_max(square.left_bottom() + vec2(4.0, 6.0), rect.max);
        worn_hand(ui, (square, text), picker, cells, shown);
        picked
    })
    .inner
}

/// Draws the preview hand in a square, and its name in another rectangle.
fn worn_hand(
    ui: &Ui,
    (square, text): (Rect, Rect),
    picker: &Picker,
    cells: &Cells<'_>,
    shown: &[usize],
) {
    let at = picker.at.as_deref().or(cells.chosen);
    let at = at.and_then(|id| cells.inventory.get(id));
    let first = || shown.first().and_then(|at| cells.inventory.values.get(*at));
    let Some((value, angles)) = at.or_else(first).and_then(|it| Some((it, data::hand(it)?))) else {
        return;
    };
    ui.painter()
        .rect_filled(square, 8.0, paint::paper(cells.seen.dark));
    worn::show(ui, square.shrink(4.0), cells.seen.dark, &angles);
    let font = TextStyle::Body.resolve(ui.style());
    let colour = ui.visuals().strong_text_color();
    let label = data::label(value, cells.seen.language);
    let galley = ui.painter().layout(label, font, colour, text.width());
    ui.painter().galley(text.min, galley, colour);
}

/// Draws values in rows.
fn grid(
    ui: &mut Ui,
    picker: &mut Picker,
    cells: &Cells<'_>,
    shown: &[usize],
    kind: PickerForm,
) -> Option<String> {
    let size = data::cell(kind);
    let gap = 4.0;
    let room = ui.available_width() - 12.0;
    let columns = ((room + gap) / (size.x + gap)).floor().max(1.0) as usize;
    let size = vec2((room + gap) / columns as f32 - gap, size.y);
    let rows = shown.len().div_ceil(columns);
    let height = (ui.available_height() - 28.0).max(2.0 * size.y);
    ScrollArea::vertical()
        .id_salt("values")
        .max_height(height)
        .auto_shrink([false, true])
        .show(ui, |ui| {
            let whole = vec2(room, rows as f32 * (size.y + gap));
            let (area, _) = ui.allocate_exact_size(whole, Sense::hover());
            let at = |n: usize| {
                let place = vec2((n % columns) as f32, (n / columns) as f32);
                Rect::from_min_size(area.min + place * (size + vec2(gap, gap)), size)
            };
            let all: Vec<Cell> = shown
                .iter()
                .enumerate()
                .map(|(n, value)| Cell {
                    value: *value,
                    rect: at(n),
                })
                .collect();
            let (digits, given) = (shown.len() > 1, picker.digits.clone());
            cells.show(ui, picker, &all, |ui, cell, state| {
                let value = &cells.inventory.values[cell.value];
                let number = match &given[..] {
                    [] => Some(state.number).filter(|number| *number < 9),
                    given => given.iter().position(|it| *it == value.id),
                };
                let digit = number.filter(|_| digits).map(|number| number + 1);
                paint::cell(ui, cell.rect, cells, value, &state, digit);
            })
        })
        .inner
}

/// Draws the button of a value.
fn face(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    inventory: &Inventory,
    chosen: Option<&str>,
    name: &str,
) -> Response {
    let value = chosen.and_then(|id| inventory.find(id));
    let text = match (value, chosen) {
        (Some(value), _) => data::short_name(value, seen.language).to_owned(),
        (None, Some(chosen)) => chosen.to_owned(),
        (None, None) => seen.say(words::CHOOSE).to_owned(),
    };
    let value = value.filter(|value| paint::has(inventory, value));
    let galley = WidgetText::from(text.as_str()).into_galley(ui, None, 160.0, TextStyle::Button);
    let height = if value.is_some() {
        36.0
    } else {
        ui.spacing().interact_size.y
    };
    let square = vec2(height - 4.0, height - 4.0);
    let room = if value.is_some() { square.x } else { 0.0 };
    let size = vec2(room + galley.size().x + 18.0, height);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| WidgetInfo {
        current_text_value: Some(text.clone()),
        ..WidgetInfo::labeled(Role::Button, true, name)
    });
    let visuals = *ui.style().interact(&response);
    let (fill, stroke) = (visuals.weak_bg_fill, visuals.bg_stroke);
    ui.painter()
        .rect(rect, 5.0, fill, stroke, StrokeKind::Inside);
    if let Some(value) = value {
        let square = Rect::from_min_size(rect.min + vec2(2.0, 2.0), square);
        paint::value(ui, square, seen, inventory, value);
    }
    let at = pos2(
        rect.left() + room + 9.0,
        rect.center().y - galley.size().y / 2.0,
    );
    ui.painter().galley(at, galley, visuals.text_color());
    response
}
