//! The window of keys: the keymap, every action with its keys, and changes to them.

use chereme_sign::text::fold;
use eframe::egui::{
    Button, ComboBox, Context, Event, Grid, Id, Key, Label, Rect, Response, Role, ScrollArea, Ui,
    Vec2, WidgetInfo, Window, vec2,
};

use crate::action::{ACTIONS, Action, ActionRow, Menu};
use crate::command::Command;
use crate::context::Outbox;
use crate::keys::chord::Chord;
use crate::keys::gestures::GESTURES;
use crate::keys::{Keymap, Keys};
use crate::script::edit;
use crate::settings::Settings;
use crate::words::{Language, Text, fill, gestures, shell as words};

/// The room that the window leaves free around it with its edges and title, in points.
const MARGINS: Vec2 = vec2(40.0, 80.0);
/// The least width of each of its columns, in points.
const COLUMN: f32 = 120.0;

/// The window that shows and changes keys.
#[derive(Debug, Default)]
pub(crate) struct KeysHelp {
    open: bool,
    /// The text to search for, and whether its field takes the keyboard.
    text: String,
    fresh: bool,
    /// The action that waits for its new key.
    listening: Option<Action>,
}

impl KeysHelp {
    pub(crate) fn toggle(&mut self) {
        self.open = !self.open;
        self.listening = None;
        (self.fresh, self.text) = (true, String::new());
    }

    pub(crate) fn is_listening(&self) -> bool {
        self.open && self.listening.is_some()
    }

    pub(crate) fn ui(&mut self, ctx: &Context, keys: &Keys, settings: &Settings, out: &mut Outbox) {
        if !self.open {
            return;
        }
        self.listen(ctx, settings, out);
        let mut open = true;
        let language = settings.language;
        // The window begins at a corner: with its centre as its place, it would grow over both edges of a small window.
        let whole = ctx.content_rect();
        let size = vec2(560.0, 480.0).min(whole.size() - MARGINS);
        Window::new(words::KEYS_TITLE.of(language))
            .id(Id::unique("keys"))
            .open(&mut open)
            .default_rect(Rect::from_center_size(whole.center(), size))
            .constrain_to(whole)
            .show(ctx, |ui| {
                keymaps(ui, settings, out);
                self.filter(ui, language);
                ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                    for (menu, title) in order() {
                        let fits = |row: &&ActionRow| self.fits(row, keys, language);
                        let mut rows: Vec<&ActionRow> = rows_of(menu).filter(fits).collect();
                        rows.sort_by_key(|row| keys.text(row.action).is_empty());
                        let all = self.text.trim().is_empty();
                        if rows.is_empty() && !all {
                            continue;
                        }
                        ui.add_space(6.0);
                        ui.strong(title.of(language));
                        self.table(ui, (menu, &rows), keys, settings);
                        if all {
                            mouse(ui, menu, language);
                        }
                    }
                });
            });
        self.open &= open && (self.is_listening() || !super::escaped(ctx));
    }

    fn filter(&mut self, ui: &mut Ui, language: Language) {
        let label = words::KEY_FIND.of(language);
        let field = edit::line(ui, &mut self.text, |field| {
            field.hint_text(label).desired_width(f32::INFINITY)
        });
        let response = field.response.response;
        response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, label));
        if std::mem::take(&mut self.fresh) {
            response.request_focus();
        }
    }

    /// Returns whether the name or the keys of an action contain every searched word.
    fn fits(&self, row: &ActionRow, keys: &Keys, language: Language) -> bool {
        let said = fold(&format!(
            "{} {}",
            row.name.of(language),
            keys.text(row.action)
        ));
        fold(&self.text)
            .split_whitespace()
            .all(|word| said.contains(word))
    }

    fn table(
        &mut self,
        ui: &mut Ui,
        (menu, rows): (Menu, &[&ActionRow]),
        keys: &Keys,
        settings: &Settings,
    ) {
        let language = settings.language;
        let wide = half(ui);
        Grid::new(("keys", menu))
            .num_columns(2)
            .striped(true)
            .min_col_width(wide)
            .show(ui, |ui| {
                for row in rows {
                    let name = row.name.of(language);
                    within(ui, wide, |ui| ui.add(Label::new(name).wrap()));
                    let text = match keys.text(row.action) {
                        _ if self.listening == Some(row.action) => {
                            words::KEY_PRESS.of(language).to_owned()
                        }
                        text if text.is_empty() => words::KEY_NONE.of(language).to_owned(),
                        text => text,
                    };
                    let response = within(ui, wide, |ui| ui.add(Button::new(text).wrap()));
                    let label = fill(words::KEY_CHANGE.of(language), &[("action", &name)]);
                    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
                    if response.clicked() {
                        self.listening = Some(row.action);
                    }
                    ui.end_row();
                }
            });
    }

    /// Assigns the next pressed key to the waiting action: Escape cancels, Backspace removes the action's keys.
    fn listen(&mut self, ctx: &Context, settings: &Settings, out: &mut Outbox) {
        let Some(action) = self.listening else { return };
        let pressed = ctx.input_mut(|input| {
            let at = input
                .events
                .iter()
                .position(|it| matches!(it, Event::Key { pressed: true, .. }))?;
            match input.events.remove(at) {
                Event::Key { key, modifiers, .. } => Some(Chord::new(key, modifiers)),
                _ => None,
            }
        });
        let Some(chord) = pressed else { return };
        self.listening = None;
        let chords = match chord.key {
            Key::Escape => return,
            Key::Backspace if !chord.ctrl && !chord.alt => Vec::new(),
            _ => vec![chord],
        };
        let mut settings = settings.clone();
        settings.keys.insert(action.row().id.to_owned(), chords);
        out.send(Command::Settings(Box::new(settings)));
    }
}

/// Returns the menus in the order of the help; those with the most used keys come first.
fn order() -> Vec<(Menu, Text)> {
    const FIRST: [Menu; 5] = [
        Menu::Play,
        Menu::Annotation,
        Menu::Value,
        Menu::Timing,
        Menu::Tier,
    ];
    let mut all = Menu::ALL.to_vec();
    let place = |menu: Menu| FIRST.iter().position(|it| *it == menu);
    let last = |menu: Menu| menu == Menu::File;
    all.sort_by_key(|(menu, _)| (place(*menu).unwrap_or(FIRST.len()), last(*menu)));
    all
}

/// Returns the width of each of two columns that fill the window together, in points.
fn half(ui: &Ui) -> f32 {
    ((ui.available_width() - ui.spacing().item_spacing.x) / 2.0).max(COLUMN)
}

/// Shows a widget in a column of that width, in points.
fn within(ui: &mut Ui, wide: f32, show: impl FnOnce(&mut Ui) -> Response) -> Response {
    let shown = ui.scope(|ui| {
        ui.set_max_width(wide);
        show(ui)
    });
    shown.inner
}

fn rows_of(menu: Menu) -> impl Iterator<Item = &'static ActionRow> {
    ACTIONS.iter().filter(move |row| row.menu == menu)
}

/// Shows the mouse gestures below the keys of a menu.
fn mouse(ui: &mut Ui, menu: Menu, language: Language) {
    if !GESTURES.iter().any(|row| row.menu == menu) {
        return;
    }
    ui.add_space(4.0);
    ui.weak(gestures::TITLE.of(language));
    let wide = half(ui);
    Grid::new(("gestures", menu))
        .num_columns(2)
        .striped(true)
        .min_col_width(wide)
        .show(ui, |ui| {
            for row in GESTURES.iter().filter(|row| row.menu == menu) {
                for text in [row.does.of(language), &row.text(language)] {
                    within(ui, wide, |ui| ui.add(Label::new(text).wrap()));
                }
                ui.end_row();
            }
        });
}

fn keymaps(ui: &mut Ui, settings: &Settings, out: &mut Outbox) {
    let language = settings.language;
    let called = |keymap: Keymap| {
        let found = Keymap::ALL.iter().find(|(it, _)| *it == keymap);
        found.map_or("", |(_, text)| text.of(language))
    };
    ui.horizontal(|ui| {
        let label = ui.label(words::KEYMAP.of(language));
        let mut keymap = settings.keymap;
        let combo = ComboBox::from_id_salt("keymap")
            .selected_text(called(keymap))
            .show_ui(ui, |ui| {
                for (it, text) in Keymap::ALL {
                    ui.selectable_value(&mut keymap, it, text.of(language));
                }
            });
        combo.response.labelled_by(label.id);
        let mut changed = settings.clone();
        changed.keymap = keymap;
        if ui.button(words::KEY_RESET.of(language)).clicked() {
            changed.keys.clear();
        }
        if changed != *settings {
            out.send(Command::Settings(Box::new(changed)));
        }
    });
}
