//! Keyboard use of drop-down lists, open or closed: arrows go through the list, and a letter goes to the next
//! entry that begins with it.

use eframe::egui::{ComboBox, Event, EventFilter, InnerResponse, Key, Modifiers, Role, TextStyle, Ui, WidgetInfo};

/// Shows a drop-down list with its name before it.
pub(super) fn show_named_combo<T: PartialEq + Clone>(ui: &mut Ui, name: &str, value: &mut T, all: &[(T, String)]) {
    let entry = all.iter().find(|(other, _)| other == value);
    let shown = entry.map_or("", |(_, text)| text.as_str()).to_owned();
    // A list does not break: one that has no room left begins the next row, and is shortened in a narrow pane.
    let wide = |text: &str| {
        let font = TextStyle::Button.resolve(ui.style());
        let colour = ui.visuals().text_color();
        ui.painter().layout_no_wrap(text.to_owned(), font, colour).size().x
    };
    let spacing = ui.spacing();
    let around = 2.0 * spacing.button_padding.x + spacing.icon_width + 2.0 * spacing.item_spacing.x;
    let (title, row) = (wide(name) + spacing.item_spacing.x, ui.max_rect().width());
    let list = (wide(&shown) + around).min(row - title).max(60.0);
    if ui.available_size_before_wrap().x < title + list {
        ui.end_row();
    }
    ui.horizontal(|ui| {
        ui.weak(name);
        let combo = ComboBox::from_id_salt(name)
            .selected_text(&shown)
            .truncate()
            .width(list);
        let inner = combo.show_ui(ui, |ui| {
            for (it, text) in all {
                ui.selectable_value(value, it.clone(), text);
            }
        });
        let names: Vec<&str> = all.iter().map(|(_, text)| text.as_str()).collect();
        let now = all.iter().position(|(other, _)| other == value);
        if let Some(at) = step_combo_choice(ui, &inner, &names, now) {
            *value = all[at].0.clone();
        }
        inner
            .response
            .widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, format!("{name}: {shown}")));
    });
}

/// Returns the index in `names` that a key chose, if the list has the focus.
pub(crate) fn step_combo_choice<R>(
    ui: &Ui,
    list: &InnerResponse<Option<R>>,
    names: &[&str],
    now: Option<usize>,
) -> Option<usize> {
    let id = list.response.id;
    if !list.response.has_focus() || names.is_empty() {
        return None;
    }
    ui.memory_mut(|memory| {
        let filter = EventFilter {
            vertical_arrows: true,
            ..EventFilter::default()
        };
        memory.set_focus_lock_filter(id, filter);
    });
    let (by, typed) = ui.input_mut(|input| {
        let mut key = |key, by| {
            if input.consume_key(Modifiers::NONE, key) { by } else { 0 }
        };
        let by: isize = key(Key::ArrowDown, 1) + key(Key::ArrowUp, -1);
        let letter = input.events.iter().find_map(|event| match event {
            Event::Text(text) => text.chars().find(|character| character.is_alphanumeric()),
            _ => None,
        });
        (by, letter)
    });
    let index = match typed {
        Some(letter) => next_with(names, now, letter)?,
        // Neither a letter nor an arrow.
        None if by == 0 => return None,
        None => match now {
            Some(now) => now.saturating_add_signed(by).min(names.len() - 1),
            None => 0,
        },
    };
    (Some(index) != now).then_some(index)
}

/// Returns the index of the next name after `now`, cyclically, that begins with a letter.
fn next_with(names: &[&str], now: Option<usize>, letter: char) -> Option<usize> {
    let first = |name: &str| name.chars().next().into_iter().flat_map(char::to_lowercase).next();
    let wanted = letter.to_lowercase().next();
    let from = now.map_or(0, |now| now + 1);
    let places = (0..names.len()).map(|by| (from + by) % names.len());
    places.into_iter().find(|at| first(names[*at]) == wanted)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_letter_selects_the_next_entry_that_begins_with_it() {
        let names = ["anything", "Éventail", "eyes", "Ears"];
        assert_eq!(next_with(&names, None, 'e'), Some(2));
        assert_eq!(next_with(&names, Some(2), 'E'), Some(3));
        assert_eq!(next_with(&names, Some(3), 'e'), Some(2));
        assert_eq!(next_with(&names, Some(0), 'é'), Some(1));
        assert_eq!(next_with(&names, None, 'z'), None);
    }
}
