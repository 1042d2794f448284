//! Cells to walk through and to pick, at the rectangles that a picker gives them.

use chereme_sign::ComponentInventory;
use chereme_sign::inventory::InventoryValue;
use eframe::egui::{Align, EventFilter, Id, Rect, Response, Role, Sense, Ui, WidgetInfo};

use super::pickers_data::{self, PickerForm, walk_picker_cells};
use super::pickers_keys::PickerKeys;
use super::{PaneInput, ValuePicker};
use crate::words::{fill_text_braces, pickers as words};

/// A value and its rectangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct PickerCell {
    /// Index of the value in the inventory.
    pub(super) value: usize,
    pub(super) rect: Rect,
}

/// The state of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct CellState {
    /// Index of the cell among the cells.
    pub(super) number: usize,
    /// Whether its value is the current one.
    pub(super) chosen: bool,
    /// Whether the keyboard cursor is at it.
    pub(super) at: bool,
    pub(super) hovered: bool,
}

/// The input that all cells of a picker share.
pub(super) struct PickerCells<'a> {
    pub(super) seen: &'a PaneInput<'a>,
    pub(super) inventory: &'a ComponentInventory,
    pub(super) chosen: Option<&'a str>,
    pub(super) pressed: PickerKeys,
}

/// Returns whether a cell of the picker has the keyboard focus.
pub(super) fn has_focused_cell(ui: &Ui, picker: &ValuePicker) -> bool {
    picker.focus.is_some_and(|id| ui.memory(|memory| memory.has_focus(id)))
}

impl PickerCells<'_> {
    /// Draws cells with `paint`, and returns the id of the value that was picked.
    pub(super) fn show_picker_cells(
        &self,
        ui: &mut Ui,
        picker: &mut ValuePicker,
        cells: &[PickerCell],
        mut paint: impl FnMut(&Ui, &PickerCell, CellState),
    ) -> Option<String> {
        let id_of = |cell: &PickerCell| self.inventory.values[cell.value].id.as_str();
        let mut index = cells.iter().position(|cell| Some(id_of(cell)) == picker.at.as_deref());
        if let Some(direction) = self.pressed.direction {
            let rects: Vec<Rect> = cells.iter().map(|cell| cell.rect).collect();
            index = Some(index.map_or(0, |at| walk_picker_cells(&rects, at, direction)));
        }
        let mut picked = None;
        let focused = has_focused_cell(ui, picker);
        let moved = self.pressed.direction.is_some();
        // The place of a cell is known only after the frame that laid it out, so that it is revealed over several.
        if let Some(at) = index.filter(|_| picker.reveals > 0) {
            picker.reveals -= 1;
            ui.scroll_to_rect(cells[at].rect, Some(Align::Center));
        }
        for (number, cell) in cells.iter().enumerate() {
            let response = self.make_cell_clickable(ui, cell, id_of(cell));
            if response.hovered() && ui.input(|input| input.pointer.delta() != eframe::egui::Vec2::ZERO) {
                index = Some(number);
            }
            if moved && index == Some(number) {
                ui.scroll_to_rect(cell.rect, None);
                if focused {
                    response.request_focus();
                }
            }
            if response.has_focus() {
                hold_arrows(ui, &response);
                picker.focus = Some(response.id);
                if !moved {
                    index = Some(number);
                }
            }
            let ctrl = ui.input(|input| input.modifiers.command);
            if response.secondary_clicked() || (response.clicked() && ctrl) {
                picker.asked = Some((self.inventory.id.clone(), id_of(cell).to_owned()));
            } else if response.clicked() {
                picked = Some(number);
            }
            let state = CellState {
                number,
                chosen: self.chosen == Some(id_of(cell)),
                at: index == Some(number),
                hovered: response.hovered(),
            };
            if ui.is_rect_visible(cell.rect) {
                paint(ui, cell, state);
            }
        }
        if let Some(at) = index {
            picker.at = Some(id_of(&cells[at]).to_owned());
        }
        // Digits stand for the values that they had when the picker opened; without any, for the first ones.
        let of_digit = |digit: usize| match picker.digits.get(digit) {
            Some(value) => cells.iter().position(|cell| id_of(cell) == value),
            None => Some(digit).filter(|_| picker.digits.is_empty()),
        };
        let by_key = if self.pressed.enter {
            index.or(Some(0))
        } else {
            self.pressed.digit.and_then(of_digit)
        };
        let picked = picked.or(by_key).and_then(|number| cells.get(number))?;
        Some(id_of(picked).to_owned())
    }

    /// Makes a circle on a picture clickable.
    pub(super) fn make_zone_clickable(&self, ui: &Ui, rect: Rect, key: Id, value: &InventoryValue) -> Response {
        let response = ui.interact(rect, key, Sense::click());
        let label = pickers_data::inventory_value_label(value, self.seen.language);
        let chosen = self.chosen == Some(value.id.as_str());
        let name = fill_text_braces(self.seen.say_text(words::ZONE), &[("value", &label)]);
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &name));
        response
    }

    fn make_cell_clickable(&self, ui: &Ui, cell: &PickerCell, id: &str) -> Response {
        let key = ui.scope_id().with(("cell", id));
        let response = ui.interact(cell.rect, key, Sense::click());
        let label = pickers_data::inventory_value_label(&self.inventory.values[cell.value], self.seen.language);
        let chosen = self.chosen == Some(id);
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &label));
        // Hands and places show their names at a separate place, so that they cover no neighbour.
        if matches!(
            pickers_data::inventory_picker_form(self.inventory),
            PickerForm::Hands | PickerForm::Body
        ) {
            return response;
        }
        let tip = fill_text_braces(self.seen.say_text(words::TIP), &[("value", &label)]);
        response.on_hover_text(tip)
    }
}

/// Keeps the arrow keys from moving the focus out of the picker.
fn hold_arrows(ui: &Ui, response: &Response) {
    let arrows = EventFilter {
        horizontal_arrows: true,
        vertical_arrows: true,
        ..EventFilter::default()
    };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
}
