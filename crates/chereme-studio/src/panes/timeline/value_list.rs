//! The list below the field for values: matching values, with pictures if values have them, and digits.

use chereme_corpus::StoredInventory;
use chereme_corpus::tier_values::{TierValue, TierValues};
use eframe::egui::{
    Align, Align2, Button, Layout, Rect, Response, Role, ScrollArea, TextStyle, Ui, Vec2, WidgetInfo, vec2,
};

use super::editor::ValueEditing;
use super::timeline_edit::{self, TimelineScene};
use crate::panes::list_row_after;
use crate::pickers;
use crate::words::{fill_text_braces, timeline as words};

/// Greatest height of the list, of names and of pictures, in points.
const VALUE_LIST_HEIGHT_POINTS: f32 = 196.0;
const PICTURE_LIST_HEIGHT_POINTS: f32 = 252.0;
/// Height of a row with a picture, in points.
const PICTURE_ROW_HEIGHT_POINTS: f32 = 42.0;

/// The values that a tier offers: its inventory if it has one, its values, and those that a digit chooses.
#[derive(Clone, Copy)]
pub(super) struct OfferedValues<'a> {
    pub(super) stored: Option<&'a StoredInventory>,
    pub(super) choices: &'a TierValues,
    pub(super) digits: &'a [String],
}

/// Returns the approximate height of the field with the list below it, in points.
pub(super) fn value_list_height(ui: &Ui, fitting: usize, pictured: bool) -> f32 {
    let row = ui.spacing().interact_size.y;
    let (each, room) = match pictured {
        true => (PICTURE_ROW_HEIGHT_POINTS, PICTURE_LIST_HEIGHT_POINTS + row),
        false => (row, VALUE_LIST_HEIGHT_POINTS),
    };
    // The field, and the frame with its margins.
    row + 32.0 + (fitting.max(1) as f32 * each).min(room)
}

/// Shows the matching values; returns the one that was clicked.
pub(super) fn show_matching_values(
    ui: &mut Ui,
    scene: &TimelineScene<'_>,
    editing: &ValueEditing,
    fitting: &[usize],
    offered: OfferedValues<'_>,
    moved: bool,
) -> Option<String> {
    let OfferedValues {
        stored,
        choices,
        digits,
    } = offered;
    let mut clicked = None;
    if fitting.is_empty() {
        let text = if choices.closed {
            words::NO_SUCH_VALUE
        } else {
            words::NEW_VALUE
        };
        ui.weak(scene.seen.say_text(text));
    }
    let marked = editing.marked.or_else(|| {
        let typed = !editing.text.trim().is_empty() && editing.text != editing.before;
        fitting.first().copied().filter(|_| choices.closed && typed)
    });
    let pictured = stored.filter(|stored| timeline_edit::has_pictures(&stored.inventory));
    let (height, room) = match pictured {
        Some(_) => (PICTURE_ROW_HEIGHT_POINTS, PICTURE_LIST_HEIGHT_POINTS),
        None => (ui.spacing().interact_size.y, VALUE_LIST_HEIGHT_POINTS),
    };
    ui.spacing_mut().item_spacing.y = 0.0;
    // The area remembers the height of the last list, which may have been a short one.
    let mut scroll = ScrollArea::vertical().max_height(room).min_scrolled_height(room);
    let here = fitting.iter().position(|at| Some(*at) == marked);
    if let Some(here) = here.filter(|_| moved) {
        let top = (here as f32 + 0.5) * height - room / 2.0;
        scroll = scroll.vertical_scroll_offset(top.max(0.0));
    }
    scroll.show_rows(ui, height, fitting.len(), |ui, range| {
        for at in &fitting[range] {
            let choice = &choices.all[*at];
            let digit_index = digits.iter().position(|value| *value == choice.value);
            let digit = digit_index.map_or(String::new(), |digit| (digit + 1).to_string());
            let chosen = marked == Some(*at);
            let response = match pictured {
                Some(stored) => by_picture(ui, scene, stored, choice, &digit, chosen),
                None => by_name(ui, choice, digit, chosen, height),
            };
            let label = fill_text_braces(scene.seen.say_text(words::VALUE), &[("value", &choice.value)]);
            response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &label));
            if response.clicked() {
                clicked = Some(choice.value.clone());
            }
        }
    });
    clicked
}

fn by_name(ui: &mut Ui, choice: &TierValue, digit: String, chosen: bool, height: f32) -> Response {
    let text = match &choice.name {
        Some(name) => format!("{}  {name}", choice.value),
        None => choice.value.clone(),
    };
    let size = vec2(ui.available_width(), height);
    let layout = Layout::left_to_right(Align::Center);
    let row = ui.allocate_ui_with_layout(size, layout, |ui| {
        let button = Button::selectable(chosen, text)
            .shortcut_text(digit)
            .truncate()
            .min_size(size);
        ui.add(button)
    });
    row.inner
}

/// Shows a value with its picture before it and its digit at the end.
fn by_picture(
    ui: &mut Ui,
    scene: &TimelineScene<'_>,
    stored: &StoredInventory,
    choice: &TierValue,
    digit: &str,
    chosen: bool,
) -> Response {
    let about = choice.name.as_deref().unwrap_or_default();
    let response = list_row_after(
        ui,
        PICTURE_ROW_HEIGHT_POINTS,
        PICTURE_ROW_HEIGHT_POINTS,
        chosen,
        &choice.value,
        about,
    );
    if !ui.is_rect_visible(response.rect) {
        return response;
    }
    let square = Rect::from_min_size(response.rect.min, Vec2::splat(PICTURE_ROW_HEIGHT_POINTS)).shrink(2.0);
    let inventory = &stored.inventory;
    pickers::paint_inventory_value(
        ui,
        square.translate(vec2(3.0, 0.0)),
        scene.seen,
        inventory,
        &choice.value,
    );
    let end = response.rect.right_center() - vec2(8.0, 0.0);
    let font = TextStyle::Button.resolve(ui.style());
    let weak = ui.visuals().weak_text_color();
    let number = ui.painter().layout_no_wrap(digit.to_owned(), font, weak);
    let number_rect = Align2::RIGHT_CENTER.anchor_size(end, number.size());
    // A long value may reach below the digit.
    let back = ui.visuals().window_fill;
    if !digit.is_empty() {
        ui.painter().rect_filled(number_rect.expand(2.0), 3.0, back);
    }
    ui.painter().galley(number_rect.min, number, weak);
    response
}

/// Returns the value of a digit that was typed into the empty field, if digits pick values there.
pub(super) fn value_of_typed_digit<'a>(
    before: &str,
    typed: &str,
    choices: &TierValues,
    digits: &'a [String],
) -> Option<&'a String> {
    let mut letters = typed.chars();
    let digit = letters
        .next()
        .filter(|_| before.is_empty() && letters.next().is_none())?;
    let number = digit.to_digit(10).filter(|number| *number > 0)? as usize;
    digits.get(number - 1).filter(|_| !choices.types_digit(digit))
}

/// Moves the mark among the matching values.
pub(super) fn step_value_mark(editing: &mut ValueEditing, fitting: &[usize], up: bool, down: bool) {
    let here = fitting.iter().position(|at| Some(*at) == editing.marked);
    let next = match (up, down, here) {
        (true, _, here) => here.and_then(|here| here.checked_sub(1)),
        (_, true, None) => Some(0),
        (_, true, Some(here)) => Some((here + 1).min(fitting.len().saturating_sub(1))),
        _ => here,
    };
    editing.marked = next.and_then(|next| fitting.get(next).copied());
}
