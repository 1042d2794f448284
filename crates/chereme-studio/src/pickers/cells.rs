//! Cells to walk through and to pick, at the rectangles that a picker gives them.

use chereme_sign::Inventory;
use chereme_sign::inventory::InventoryValue;
use eframe::egui::{Align, EventFilter, Id, Rect, Response, Role, Sense, Ui, WidgetInfo};

use super::data::{self, PickerForm, walk};
use super::keys::Pressed;
use super::{PaneInput, Picker};
use crate::words::{fill, pickers as words};

/// A value and its rectangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    /// Index of the value in the inventory.
    pub(super) value: usize,
    pub(super) rect: Rect,
}

/// The state of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct State {
    /// Index of the cell among the cells.
    pub(super) number: usize,
    /// Whether its value is the current one.
    pub(super) chosen: bool,
    /// Whether the keyboard cursor is at it.
    pub(super) at: bool,
    pub(super) hovered: bool,
}

/// The input that all cells of a picker share.
pub(super) struct Cells<'a> {
    pub(super) seen: &'a PaneInput<'a>,
    pub(super) inventory: &'a Inventory,
    pub(super) chosen: Option<&'a str>,
    pub(super) pressed: Pressed,
}

/// Returns whether a cell of the picker has the keyboard focus.
pub(super) fn focused(ui: &Ui, picker: &Picker) -> bool {
    picker
        .focus
        .is_some_and(|id| ui.memory(|memory| memory.has_focus(id)))
}

impl Cells<'_> {
    /// Draws cells with `paint`, and returns the id of the value that was picked.
    pub(super) fn show(
        &self,
        ui: &mut Ui,
        picker: &mut Picker,
        cells: &[Cell],
        mut paint: impl FnMut(&Ui, &Cell, State),
    ) -> Option<String> {
        let id_of = |cell: &Cell| self.inventory.values[cell.value].id.as_str();
        let mut at = cells
            .iter()
            .position(|cell| Some(id_of(cell)) == picker.at.as_deref());
        if let Some(direction) = self.pressed.direction {
            let rects: Vec<Rect> = cells.iter().map(|cell| cell.rect).collect();
            at = Some(at.map_or(0, |at| walk(&rects, at, direction)));
        }
        let mut picked = None;
        let focused = focused(ui, picker);
        let moved = self.pressed.direction.is_some();
        if let Some(at) = at.filter(|_| picker.reveals > 0) {
            picker.reveals -= 1;
            ui.scroll_to_rect(cells[at].rect, Some(Align::Center));
        }
        for (number, cell) in cells.iter().enumerate() {
            let response = self.cell(ui, cell, id_of(cell));
            if response.hovered()
                && ui.input(|input| input.pointer.delta() != eframe::egui::Vec2::ZERO)
            {
                at = Some(number);
            }
            if moved && at == Some(number) {
                ui.scroll_to_rect(cell.rect, None);
                if focused {
                    response.request_focus();
                }
            }
            if response.has_focus() {
                hold_arrows(ui, &response);
                picker.focus = Some(response.id);
                if !moved {
                    at = Some(number);
                }
            }
            let ctrl = ui.input(|input| input.modifiers.command);
            if response.secondary_clicked() || (response.clicked() && ctrl) {
                picker.asked = Some((self.inventory.id.clone(), id_of(cell).to_owned()));
            } else if response.clicked() {
                picked = Some(number);
            }
            let state = State {
                number,
                chosen: self.chosen == Some(id_of(cell)),
                at: at == Some(number),
                hovered: response.hovered(),
            };
            if ui.is_rect_visible(cell.rect) {
                paint(ui, cell, state);
            }
        }
        if let Some(at) = at {
            picker.at = Some(id_of(&cells[at]).to_owned());
        }
        let of_digit = |digit: usize| match picker.digits.get(digit) {
            Some(value) => cells.iter().position(|cell| id_of(cell) == value),
            None => Some(digit).filter(|_| picker.digits.is_empty()),
        };
        let by_key = if self.pressed.enter {
            at.or(Some(0))
        } else {
            self.pressed.digit.and_then(of_digit)
        };
        let picked = picked.or(by_key).and_then(|number| cells.get(number))?;
        Some(id_of(picked).to_owned())
    }

    /// Makes a circle on a picture clickable.
    pub(super) fn zone(&self, ui: &Ui, rect: Rect, key: Id, value: &InventoryValue) -> Response {
        let response = ui.interact(rect, key, Sense::click());
        let label = data::label(value, self.seen.language);
        let chosen = self.chosen == Some(value.id.as_str());
        let name = fill(self.seen.say(words::ZONE), &[("value", &label)]);
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &name));
        response
    }

    fn cell(&self, ui: &Ui, cell: &Cell, id: &str) -> Response {
        let key = ui.scope_id().with(("cell", id));
        let response = ui.interact(cell.rect, key, Sense::click());
        let label = data::label(&self.inventory.values[cell.value], self.seen.language);
        let chosen = self.chosen == Some(id);
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &label));
        // Hands and places show their names at a separate place, so that they cover no neighbour.
        if matches!(
            data::kind(self.inventory),
            PickerForm::Hands | PickerForm::Body
        ) {
            return response;
        }
        let tip = fill(self.seen.say(words::TIP), &[("value", &label)]);
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
