//! The arrow keys of lists and grids.

use eframe::egui::{EventFilter, Id, Key, Modifiers, Ui};

use super::search::walk_hit_grid;

/// Keeps the arrow keys in a list or grid while its row with this id has the focus; those to the sides only in a grid.
pub(crate) fn keep_arrow_keys(ui: &Ui, row: Id, is_grid: bool) {
    let arrows = EventFilter {
        horizontal_arrows: is_grid,
        vertical_arrows: true,
        ..EventFilter::default()
    };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(row, arrows));
}

/// Returns the row that a pressed key moves to in a list, from the row `at`; a page has eight rows.
pub(crate) fn take_list_keys(ui: &Ui, at: usize, total: usize) -> Option<usize> {
    let last = total.checked_sub(1)?;
    let keys = [
        (Key::ArrowUp, -1),
        (Key::ArrowDown, 1),
        (Key::PageUp, -8),
        (Key::PageDown, 8),
        (Key::Home, isize::MIN / 2),
        (Key::End, isize::MAX / 2),
    ];
    let by = take_last_key(ui, &keys)?;
    Some(at.saturating_add_signed(by).min(last))
}

/// Returns the cell that a pressed key moves to in a grid, from the cell `at`; a page has `page` rows.
pub(crate) fn take_grid_keys(ui: &Ui, at: usize, total: usize, columns: usize, page: isize) -> Option<usize> {
    let last = total.checked_sub(1)?;
    let keys = [
        (Key::ArrowLeft, [-1, 0]),
        (Key::ArrowRight, [1, 0]),
        (Key::ArrowUp, [0, -1]),
        (Key::ArrowDown, [0, 1]),
        (Key::PageUp, [0, -page]),
        (Key::PageDown, [0, page]),
        (Key::Home, [-(at as isize), 0]),
        (Key::End, [last as isize - at as isize, 0]),
    ];
    let step = take_last_key(ui, &keys)?;
    Some(walk_hit_grid(at, total, columns, step))
}

/// Takes these keys out of the input, and returns what the last pressed one of the list stands for.
fn take_last_key<T: Copy>(ui: &Ui, keys: &[(Key, T)]) -> Option<T> {
    let pressed = |key: &Key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, *key));
    keys.iter()
        .filter(|(key, _)| pressed(key))
        .last()
        .map(|(_, step)| *step)
}
