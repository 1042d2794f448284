//! Pickers that show values: handshapes as pictures, placements on a body, movements as glyphs, orientations around a
//! rose of directions; any other inventory as names.
//!
//! [`show_inventory_picker`] draws the picker that fits an inventory and returns the id of the picked value; [`show_picker_button`] opens the same
//! picker from a button that shows the current value; [`paint_inventory_value`] draws one value anywhere. Every place that picks has
//! its own [`ValuePicker`], which holds the state.
//!
//! In every picker one types to filter, walks with the arrow keys, and picks with Enter, with the mouse, or with Ctrl
//! and the digit on the cell; the digit alone is enough if no name of a value begins with a digit. Every cell is
//! labelled by [`data::label`].

pub(crate) mod pickers_data;
pub(crate) mod pickers_hamnosys;

mod areas;
pub(crate) mod board;
mod gallery;
mod glyph;
mod pickers_body;
mod pickers_cells;
mod pickers_keys;
mod pickers_paint;

mod pickers_places;
mod rose;
mod worn;

use chereme_corpus::value_pictures::PlacePanel;
use chereme_sign::ComponentInventory;
use eframe::egui::{
    Id, Key, Popup, PopupCloseBehavior, Rect, Response, RichText, Role, ScrollArea, Sense, StrokeKind, TextStyle, Ui,
    WidgetInfo, WidgetText, pos2, vec2,
};

use crate::command::WindowCommand;
use crate::context::PaneInput;
use crate::model::InspectedThing;
use crate::script::script_edit;
use crate::words::{fill_text_braces, pickers as words};
use pickers_cells::{PickerCell, PickerCells};
use pickers_data::PickerForm;
use pickers_keys::PickerKeys;
pub(crate) use pickers_paint::shorten_text_to_width;

/// A pane narrower than this, in points, has no room for an embedded picker.
const MIN_EMBEDDED_PICKER_POINTS: f32 = 240.0;

/// The state of a picker.
#[derive(Debug, Default)]
pub(crate) struct ValuePicker {
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
    panel: PlacePanel,
    /// Whether to switch to the pictures that show the value at the keyboard cursor.
    turns: bool,
    /// For how many more frames to scroll to that value; an opened picker has its final size after the first ones.
    reveals: u8,
    turned: bool,
    depth: usize,
}

impl ValuePicker {
    /// Shows a value in the inspector if its details were requested with Ctrl and a click, or the other mouse button.
    pub(crate) fn inspect_requested_value(&mut self, seen: &PaneInput<'_>) {
        if let Some(thing) = self.take_requested_value(seen) {
            seen.send_command(WindowCommand::Inspect(thing));
        }
    }

    /// Returns that value, and clears the request.
    pub(crate) fn take_requested_value(&mut self, seen: &PaneInput<'_>) -> Option<InspectedThing> {
        let (inventory, value) = self.asked.take()?;
        let mut all = seen.snapshot.overview.inventories.iter();
        let stored = all.find(|stored| stored.inventory.id == inventory)?;
        Some(InspectedThing::Value(stored.id, value))
    }

    /// Returns a picker that its button opens as soon as it is drawn.
    pub(crate) fn new_opening_picker() -> Self {
        Self {
            opens: true,
            ..Self::new_focused_picker()
        }
    }

    /// Returns a picker that takes the keyboard when it is first drawn.
    pub(crate) fn new_focused_picker() -> Self {
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
pub(crate) fn show_inventory_picker(
    ui: &mut Ui,
    picker: &mut ValuePicker,
    seen: &PaneInput<'_>,
    inventory: &ComponentInventory,
    chosen: Option<&str>,
) -> Option<String> {
    if picker.at.is_none() {
        picker.at = chosen.map(str::to_owned);
    }
    ui.push_id(("picker", &inventory.id), |ui| {
        let pressed = show_picker_filter(ui, picker, seen, inventory);
        let shown = pickers_data::filtered_value_indices(inventory, &picker.filter);
        if shown.is_empty() {
            ui.label(fill_text_braces(
                seen.say_text(words::NONE),
                &[("text", &picker.filter)],
            ));
            return None;
        }
        let cells = PickerCells {
            seen,
            inventory,
            chosen,
            pressed,
        };
        let picked = match pickers_data::inventory_picker_form(inventory) {
            PickerForm::Body => pickers_body::show_body_picker(ui, picker, &cells, &shown),
            PickerForm::Rose => rose::show_direction_roses(ui, picker, &cells, &shown),
            PickerForm::Hands => draw_hand_pictures(ui, picker, &cells, &shown),
            kind => draw_value_grid(ui, picker, &cells, &shown, kind),
        };
        let marked_value = picker.at.as_deref().and_then(|id| inventory.value_by_id(id));
        let label = marked_value.map(|value| pickers_data::inventory_value_label(value, seen.language));
        let hint = label.map_or(String::new(), |label| {
            fill_text_braces(seen.say_text(words::ENTER), &[("value", &label)])
        });
        ui.label(RichText::new(hint).small());
        picked
    })
    .inner
}

/// Draws a button with the current value; a click opens the picker below it. Returns the id of the picked value. `name`
/// is the accessible name of the button.
pub(crate) fn show_picker_button(
    ui: &mut Ui,
    picker: &mut ValuePicker,
    seen: &PaneInput<'_>,
    inventory: &ComponentInventory,
    chosen: Option<&str>,
    name: &str,
) -> Option<String> {
    let response = draw_value_button(ui, seen, inventory, chosen, name);
    show_picker_below(ui, &response, picker, seen, inventory, chosen, name)
}

/// Opens the picker of an inventory below a clicked widget, and returns the id of the picked value; `chosen` and `name`
/// are those of [`show_picker_button`].
pub(crate) fn show_picker_below(
    ui: &mut Ui,
    response: &Response,
    picker: &mut ValuePicker,
    seen: &PaneInput<'_>,
    inventory: &ComponentInventory,
    chosen: Option<&str>,
    name: &str,
) -> Option<String> {
    if response.clicked() {
        *picker = ValuePicker::new_focused_picker();
    }
    let screen = ui.ctx().content_rect().size();
    let popup = Popup::from_toggle_button_response(response)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .accessible_name(name);
    // The picker stays within its pane, so that it does not cover the stage with the picked value.
    let pane = ui.clip_rect();
    let wide = pickers_data::picker_width_points(pickers_data::inventory_picker_form(inventory)).min(screen.x - 48.0);
    let room = pane.width() - 24.0;
    let width = if room >= MIN_EMBEDDED_PICKER_POINTS {
        wide.min(room)
    } else {
        wide
    };
    let preferred_left = response.rect.left().min(pane.right() - width - 20.0);
    let left = preferred_left.max(pane.left().max(4.0));
    let below = Rect::from_x_y_ranges(left..=left + width, response.rect.y_range());
    let popup = popup.anchor(below);
    // Above or below the button, whichever has more room, without a margin and the status line.
    let (over, under) = (response.rect.top(), screen.y - response.rect.bottom());
    let room = over.max(under) - 70.0;
    // A narrower picker is higher.
    let full_height = pickers_data::picker_height_points(pickers_data::inventory_picker_form(inventory)) * wide / width;
    let height = full_height.min(room.max(260.0));
    let id = popup.get_id();
    if std::mem::take(&mut picker.opens) {
        Popup::open_id(ui.ctx(), id);
    }
    let picked = popup.show(|ui| {
        ui.set_width(width);
        ui.set_max_height(height);
        show_inventory_picker(ui, picker, seen, inventory, chosen)
    });
    let away = picked.is_some() && ui.input(|input| input.key_pressed(Key::Escape));
    let picked = picked.and_then(|inner_response| inner_response.inner);
    if picked.is_some() || away {
        Popup::close_id(ui.ctx(), id);
        response.request_focus();
    }
    picked
}

/// Paints the picture of a value if it has one: a hand, a place on the body, a glyph, an arrow. Returns whether there
/// is one.
pub(crate) fn paint_inventory_value(
    ui: &Ui,
    rect: Rect,
    seen: &PaneInput<'_>,
    inventory: &ComponentInventory,
    value: &str,
) -> bool {
    inventory
        .find_inventory_value(value)
        .is_some_and(|value| pickers_paint::paint_value_picture(ui, rect, seen, inventory, value))
}

fn show_picker_filter(
    ui: &mut Ui,
    picker: &mut ValuePicker,
    seen: &PaneInput<'_>,
    inventory: &ComponentInventory,
) -> PickerKeys {
    let id = ui.scope_id().with("filter");
    let focused = ui.memory(|memory| memory.has_focus(id));
    let here = focused || pickers_cells::has_focused_cell(ui, picker);
    let digits = !pickers_data::has_numbers(inventory);
    let pressed = if here {
        pickers_keys::take_picker_keys(ui, digits && focused)
    } else {
        PickerKeys::default()
    };
    let before = picker.filter.clone();
    let hint = seen.say_text(words::FILTER);
    let field = script_edit::draw_text_line(ui, &mut picker.filter, |field| {
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
        picker.at = pickers_data::filtered_value_indices(inventory, &picker.filter)
            .first()
            .map(|at| inventory.values[*at].id.clone());
    }
    pressed
}

/// The width of the preview hand, and the least width of the pictures beside it, in points.
const PREVIEW_HAND_WIDTH_POINTS: f32 = 176.0;
const MIN_PICTURES_BESIDE_POINTS: f32 = 250.0;
/// The width of the preview hand below the pictures, and the least height for both, in points.
const PREVIEW_BELOW_WIDTH_POINTS: f32 = 112.0;
const MIN_PREVIEW_HEIGHT_POINTS: f32 = 350.0;

/// Draws pictures of hands, and beside or below them a preview hand in the handshape under the pointer or the keyboard
/// cursor.
fn draw_hand_pictures(
    ui: &mut Ui,
    picker: &mut ValuePicker,
    cells: &PickerCells<'_>,
    shown: &[usize],
) -> Option<String> {
    let room = ui.available_width();
    let high = ui.available_height();
    if room < PREVIEW_HAND_WIDTH_POINTS + MIN_PICTURES_BESIDE_POINTS {
        if high >= MIN_PREVIEW_HEIGHT_POINTS {
            let left = high - PREVIEW_BELOW_WIDTH_POINTS - 8.0;
            let picked = ui
                .allocate_ui(vec2(room, left), |ui| {
                    ui.set_max_height(left);
                    draw_value_grid(ui, picker, cells, shown, PickerForm::Hands)
                })
                .inner;
            let (rect, _) = ui.allocate_exact_size(vec2(room, PREVIEW_BELOW_WIDTH_POINTS), Sense::hover());
            let square = Rect::from_min_size(rect.min, vec2(PREVIEW_BELOW_WIDTH_POINTS, PREVIEW_BELOW_WIDTH_POINTS));
            let text = Rect::from_min_max(square.right_top() + vec2(6.0, 4.0), rect.max);
            worn_hand(ui, square, text, picker, cells, shown);
            return picked;
        }
        return draw_value_grid(ui, picker, cells, shown, PickerForm::Hands);
    }
    ui.horizontal_top(|ui| {
        let picked = ui
            .allocate_ui(vec2(room - PREVIEW_HAND_WIDTH_POINTS - 8.0, high), |ui| {
                ui.set_width(room - PREVIEW_HAND_WIDTH_POINTS - 8.0);
                draw_value_grid(ui, picker, cells, shown, PickerForm::Hands)
            })
            .inner;
        let (rect, _) = ui.allocate_exact_size(
            vec2(PREVIEW_HAND_WIDTH_POINTS, PREVIEW_HAND_WIDTH_POINTS + 64.0),
            Sense::hover(),
        );
        let square = Rect::from_min_size(rect.min, vec2(PREVIEW_HAND_WIDTH_POINTS, PREVIEW_HAND_WIDTH_POINTS));
        let text = Rect::from_min_max(square.left_bottom() + vec2(4.0, 6.0), rect.max);
        worn_hand(ui, square, text, picker, cells, shown);
        picked
    })
    .inner
}

/// Draws the preview hand in a square, and its name in another rectangle.
fn worn_hand(ui: &Ui, square: Rect, text: Rect, picker: &ValuePicker, cells: &PickerCells<'_>, shown: &[usize]) {
    let value_id = picker.at.as_deref().or(cells.chosen);
    let marked_value = value_id.and_then(|id| cells.inventory.value_by_id(id));
    let first = || shown.first().and_then(|at| cells.inventory.values.get(*at));
    let Some((value, angles)) = marked_value
        .or_else(first)
        .and_then(|value| Some((value, pickers_data::value_hand_angles(value)?)))
    else {
        return;
    };
    ui.painter()
        .rect_filled(square, 8.0, pickers_paint::picture_background_colour(cells.seen.dark));
    worn::show_preview_hand(ui, square.shrink(4.0), cells.seen.dark, &angles);
    let font = TextStyle::Body.resolve(ui.style());
    let colour = ui.visuals().strong_text_color();
    let label = pickers_data::inventory_value_label(value, cells.seen.language);
    let galley = ui.painter().layout(label, font, colour, text.width());
    ui.painter().galley(text.min, galley, colour);
}

/// Draws values in rows.
fn draw_value_grid(
    ui: &mut Ui,
    picker: &mut ValuePicker,
    cells: &PickerCells<'_>,
    shown: &[usize],
    kind: PickerForm,
) -> Option<String> {
    let size = pickers_data::picker_cell_size(kind);
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
            let grid_size = vec2(room, rows as f32 * (size.y + gap));
            let (area, _) = ui.allocate_exact_size(grid_size, Sense::hover());
            let cell_rect = |n: usize| {
                let place = vec2((n % columns) as f32, (n / columns) as f32);
                Rect::from_min_size(area.min + place * (size + vec2(gap, gap)), size)
            };
            let all: Vec<PickerCell> = shown
                .iter()
                .enumerate()
                .map(|(n, value)| PickerCell {
                    value: *value,
                    rect: cell_rect(n),
                })
                .collect();
            let (digits, given) = (shown.len() > 1, picker.digits.clone());
            cells.show_picker_cells(ui, picker, &all, |ui, cell, state| {
                let value = &cells.inventory.values[cell.value];
                let number = match &given[..] {
                    [] => Some(state.number).filter(|number| *number < 9),
                    given => given.iter().position(|shown_id| *shown_id == value.id),
                };
                let digit = number.filter(|_| digits).map(|number| number + 1);
                pickers_paint::paint_table_cell(ui, cell.rect, cells, value, &state, digit);
            })
        })
        .inner
}

/// Draws the button of a value.
fn draw_value_button(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    inventory: &ComponentInventory,
    chosen: Option<&str>,
    name: &str,
) -> Response {
    let value = chosen.and_then(|id| inventory.find_inventory_value(id));
    let text = match (value, chosen) {
        (Some(value), _) => pickers_data::short_name(value, seen.language).to_owned(),
        (None, Some(chosen)) => chosen.to_owned(),
        (None, None) => seen.say_text(words::CHOOSE).to_owned(),
    };
    let value = value.filter(|value| pickers_paint::has_value_picture(inventory, value));
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
    ui.painter().rect(rect, 5.0, fill, stroke, StrokeKind::Inside);
    if let Some(value) = value {
        let square = Rect::from_min_size(rect.min + vec2(2.0, 2.0), square);
        pickers_paint::paint_value_picture(ui, square, seen, inventory, value);
    }
    let text_position = pos2(rect.left() + room + 9.0, rect.center().y - galley.size().y / 2.0);
    ui.painter().galley(text_position, galley, visuals.text_color());
    response
}
