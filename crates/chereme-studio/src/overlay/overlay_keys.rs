//! The window of keys: the keymap, every action with its keys, and changes to them.

use chereme_sign::text::fold_text;
use eframe::egui::{
    Button, ComboBox, Context, Event, Grid, Id, Key, Label, Rect, Response, Role, ScrollArea, Ui, Vec2, WidgetInfo,
    Window, vec2,
};

use crate::action::{ACTIONS, Action, ActionMenu, ActionRow};
use crate::command::{CommandOutbox, WindowCommand};
use crate::key_chord::{DefaultKeymap, KeyChord};
use crate::keys::ActionKeys;
use crate::keys::keys_gestures::GESTURES;
use crate::script::script_edit;
use crate::settings::StudioSettings;
use crate::words::{InterfaceLanguage, InterfaceText, fill_text_braces, gestures_words, shell as words};

/// The room that the window leaves free around it with its edges and title, in points.
const KEYS_WINDOW_MARGINS: Vec2 = vec2(40.0, 80.0);
/// The least width of each of its columns, in points.
const MIN_KEYS_COLUMN_WIDTH: f32 = 120.0;

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
    pub(crate) fn toggle_keys_help(&mut self) {
        self.open = !self.open;
        self.listening = None;
        (self.fresh, self.text) = (true, String::new());
    }

    pub(crate) fn is_listening(&self) -> bool {
        self.open && self.listening.is_some()
    }

    pub(crate) fn ui(&mut self, ctx: &Context, keys: &ActionKeys, settings: &StudioSettings, out: &CommandOutbox) {
        if !self.open {
            return;
        }
        self.listen_for_new_key(ctx, settings, out);
        let mut open = true;
        let language = settings.language;
        // The window begins at a corner: with its centre as its place, it would grow over both edges of a small window.
        let screen = ctx.content_rect();
        let size = vec2(560.0, 480.0).min(screen.size() - KEYS_WINDOW_MARGINS);
        Window::new(words::KEYS_TITLE.text_in_language(language))
            .id(Id::unique("keys"))
            .open(&mut open)
            .default_rect(Rect::from_center_size(screen.center(), size))
            .constrain_to(screen)
            .show(ctx, |ui| {
                keymaps(ui, settings, out);
                self.show_keys_filter(ui, language);
                ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                    for (menu, title) in keys_menu_order() {
                        let fits = |row: &&ActionRow| self.matches_key_search(row, keys, language);
                        let mut rows: Vec<&ActionRow> = rows_of(menu).filter(fits).collect();
                        rows.sort_by_key(|row| keys.action_keys_text(row.action).is_empty());
                        let all = self.text.trim().is_empty();
                        if rows.is_empty() && !all {
                            continue;
                        }
                        ui.add_space(6.0);
                        ui.strong(title.text_in_language(language));
                        self.show_menu_keys_table(ui, menu, &rows, keys, settings);
                        if all {
                            mouse(ui, menu, language);
                        }
                    }
                });
            });
        self.open &= open && (self.is_listening() || !super::take_escape_key(ctx));
    }

    fn show_keys_filter(&mut self, ui: &mut Ui, language: InterfaceLanguage) {
        let label = words::KEY_FIND.text_in_language(language);
        let field = script_edit::draw_text_line(ui, &mut self.text, |field| {
            field.hint_text(label).desired_width(f32::INFINITY)
        });
        let response = field.response.response;
        response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, label));
        if std::mem::take(&mut self.fresh) {
            response.request_focus();
        }
    }

    /// Returns whether the name or the keys of an action contain every searched word.
    fn matches_key_search(&self, row: &ActionRow, keys: &ActionKeys, language: InterfaceLanguage) -> bool {
        let row_text = fold_text(&format!(
            "{} {}",
            row.name.text_in_language(language),
            keys.action_keys_text(row.action)
        ));
        fold_text(&self.text)
            .split_whitespace()
            .all(|word| row_text.contains(word))
    }

    fn show_menu_keys_table(
        &mut self,
        ui: &mut Ui,
        menu: ActionMenu,
        rows: &[&ActionRow],
        keys: &ActionKeys,
        settings: &StudioSettings,
    ) {
        let language = settings.language;
        let wide = half_window_width(ui);
        Grid::new(("keys", menu))
            .num_columns(2)
            .striped(true)
            .min_col_width(wide)
            .show(ui, |ui| {
                for row in rows {
                    let name = row.name.text_in_language(language);
                    show_in_column(ui, wide, |ui| ui.add(Label::new(name).wrap()));
                    let text = match keys.action_keys_text(row.action) {
                        _ if self.listening == Some(row.action) => {
                            words::KEY_PRESS.text_in_language(language).to_owned()
                        }
                        text if text.is_empty() => words::KEY_NONE.text_in_language(language).to_owned(),
                        text => text,
                    };
                    let response = show_in_column(ui, wide, |ui| ui.add(Button::new(text).wrap()));
                    let label = fill_text_braces(words::KEY_CHANGE.text_in_language(language), &[("action", &name)]);
                    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
                    if response.clicked() {
                        self.listening = Some(row.action);
                    }
                    ui.end_row();
                }
            });
    }

    /// Assigns the next pressed key to the waiting action: Escape cancels, Backspace removes the action's keys.
    fn listen_for_new_key(&mut self, ctx: &Context, settings: &StudioSettings, out: &CommandOutbox) {
        let Some(action) = self.listening else { return };
        let pressed = ctx.input_mut(|input| {
            let index = input
                .events
                .iter()
                .position(|event| matches!(event, Event::Key { pressed: true, .. }))?;
            match input.events.remove(index) {
                Event::Key { key, modifiers, .. } => Some(KeyChord::new(key, modifiers)),
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
        settings.keys.insert(action.action_row().id.to_owned(), chords);
        out.send_command(WindowCommand::Settings(Box::new(settings)));
    }
}

/// Returns the menus in the order of the help; those with the most used keys come first.
fn keys_menu_order() -> Vec<(ActionMenu, InterfaceText)> {
    const FIRST_HELP_MENUS: [ActionMenu; 5] = [
        ActionMenu::Play,
        ActionMenu::Annotation,
        ActionMenu::Value,
        ActionMenu::Timing,
        ActionMenu::Tier,
    ];
    let mut all = ActionMenu::ALL_ACTION_MENUS.to_vec();
    let place = |menu: ActionMenu| FIRST_HELP_MENUS.iter().position(|other| *other == menu);
    let last = |menu: ActionMenu| menu == ActionMenu::File;
    all.sort_by_key(|(menu, _)| (place(*menu).unwrap_or(FIRST_HELP_MENUS.len()), last(*menu)));
    all
}

/// Returns the width of each of two columns that fill the window together, in points.
fn half_window_width(ui: &Ui) -> f32 {
    ((ui.available_width() - ui.spacing().item_spacing.x) / 2.0).max(MIN_KEYS_COLUMN_WIDTH)
}

/// Shows a widget in a column of that width, in points.
fn show_in_column(ui: &mut Ui, wide: f32, show: impl FnOnce(&mut Ui) -> Response) -> Response {
    let shown = ui.scope(|ui| {
        ui.set_max_width(wide);
        show(ui)
    });
    shown.inner
}

fn rows_of(menu: ActionMenu) -> impl Iterator<Item = &'static ActionRow> {
    ACTIONS.iter().filter(move |row| row.menu == menu)
}

/// Shows the mouse gestures below the keys of a menu.
fn mouse(ui: &mut Ui, menu: ActionMenu, language: InterfaceLanguage) {
    if !GESTURES.iter().any(|row| row.menu == menu) {
        return;
    }
    ui.add_space(4.0);
    ui.weak(gestures_words::TITLE.text_in_language(language));
    let wide = half_window_width(ui);
    Grid::new(("gestures", menu))
        .num_columns(2)
        .striped(true)
        .min_col_width(wide)
        .show(ui, |ui| {
            for row in GESTURES.iter().filter(|row| row.menu == menu) {
                for text in [row.does.text_in_language(language), &row.gesture_text(language)] {
                    show_in_column(ui, wide, |ui| ui.add(Label::new(text).wrap()));
                }
                ui.end_row();
            }
        });
}

fn keymaps(ui: &mut Ui, settings: &StudioSettings, out: &CommandOutbox) {
    let language = settings.language;
    let called = |keymap: DefaultKeymap| {
        let entry = DefaultKeymap::ALL_KEYMAPS.iter().find(|(other, _)| *other == keymap);
        entry.map_or("", |(_, text)| text.text_in_language(language))
    };
    ui.horizontal(|ui| {
        let label = ui.label(words::KEYMAP.text_in_language(language));
        let mut keymap = settings.keymap;
        let combo = ComboBox::from_id_salt("keymap")
            .selected_text(called(keymap))
            .show_ui(ui, |ui| {
                for (it, text) in DefaultKeymap::ALL_KEYMAPS {
                    ui.selectable_value(&mut keymap, it, text.text_in_language(language));
                }
            });
        combo.response.labelled_by(label.id);
        let mut changed = settings.clone();
        changed.keymap = keymap;
        if ui.button(words::KEY_RESET.text_in_language(language)).clicked() {
            changed.keys.clear();
        }
        if changed != *settings {
            out.send_command(WindowCommand::Settings(Box::new(changed)));
        }
    });
}
