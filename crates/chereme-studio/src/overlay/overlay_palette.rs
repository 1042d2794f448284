//! The command palette: every action by its name.

use chereme_sign::text::fold_text;
use eframe::egui::{Align2, Button, Context, Id, Key, Modifiers, ScrollArea, TextEdit, Window, vec2};

use crate::action::{ACTIONS, ActionContext as Where, ActionRow};
use crate::command::{CommandOutbox, WindowCommand};
use crate::keys::ActionKeys;
use crate::script::script_edit;
use crate::words::{InterfaceLanguage, shell as words};

/// The palette.
#[derive(Debug, Default)]
pub(crate) struct ActionPalette {
    open: bool,
    fresh: bool,
    text: String,
    chosen: usize,
}

/// Returns the actions whose name contains every word of `text`, ignoring case and accents; those that begin with it
/// come first.
pub(crate) fn matching_action_rows(text: &str, language: InterfaceLanguage, corpus: bool) -> Vec<&'static ActionRow> {
    let wanted = fold_text(text.trim());
    let fits = |row: &&ActionRow| {
        let name = fold_text(row.name.text_in_language(language));
        let counts = corpus || row.context == Where::Everywhere;
        counts && wanted.split_whitespace().all(|word| name.contains(word))
    };
    let mut rows: Vec<&ActionRow> = ACTIONS.iter().filter(fits).collect();
    rows.sort_by_key(|row| !fold_text(row.name.text_in_language(language)).starts_with(&wanted));
    rows
}

impl ActionPalette {
    pub(crate) fn toggle_palette(&mut self) {
        *self = Self {
            open: !self.open,
            fresh: true,
            ..Self::default()
        };
    }

    pub(crate) fn is_palette_open(&self) -> bool {
        self.open
    }

    pub(crate) fn ui(
        &mut self,
        ctx: &Context,
        keys: &ActionKeys,
        language: InterfaceLanguage,
        corpus: bool,
        out: &CommandOutbox,
    ) {
        if !self.open {
            return;
        }
        let pressed = |key| ctx.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let (up, down) = (pressed(Key::ArrowUp), pressed(Key::ArrowDown));
        let (enter, escape) = (pressed(Key::Enter), pressed(Key::Escape));
        let rows = matching_action_rows(&self.text, language, corpus);
        let last = rows.len().saturating_sub(1);
        self.chosen = match (up, down) {
            (true, _) => self.chosen.saturating_sub(1),
            (_, true) => self.chosen + 1,
            _ => self.chosen,
        }
        .min(last);
        let mut done = enter.then(|| rows.get(self.chosen)).flatten().map(|row| row.action);
        let window = Window::new(words_title(language))
            .id(Id::unique("palette"))
            .title_bar(false)
            .resizable(false)
            .anchor(Align2::CENTER_TOP, vec2(0.0, 72.0))
            .min_size(vec2(440.0, 0.0))
            .max_size(vec2(440.0, 380.0));
        window.show(ctx, |ui| {
            let field = TextEdit::singleline(&mut self.text)
                .hint_text(words::PALETTE_HINT.text_in_language(language))
                .desired_width(f32::INFINITY);
            let response = script_edit::draw_with_text_edge(ui, |ui| ui.add(field));
            response.widget_info(|| {
                let role = eframe::egui::Role::TextInput;
                eframe::egui::WidgetInfo::labeled(role, true, words::PALETTE_HINT.text_in_language(language))
            });
            if std::mem::take(&mut self.fresh) {
                response.request_focus();
            }
            if response.changed() {
                self.chosen = 0;
            }
            if rows.is_empty() {
                ui.weak(words::PALETTE_NONE.text_in_language(language));
            }
            // The list is no higher than its contents.
            let area = ScrollArea::vertical().auto_shrink([false, true]);
            area.max_height(320.0).show(ui, |ui| {
                for (at, row) in rows.iter().enumerate() {
                    let button = Button::selectable(at == self.chosen, row.name.text_in_language(language))
                        .shortcut_text(keys.action_keys_text(row.action))
                        .min_size(vec2(ui.available_width(), 0.0));
                    let response = ui.add(button);
                    if at == self.chosen && (up || down) {
                        response.scroll_to_me(None);
                    }
                    if response.clicked() {
                        done = Some(row.action);
                    }
                }
            });
        });
        if let Some(action) = done {
            out.send_command(WindowCommand::Do(action));
        }
        self.open = !(escape || done.is_some());
    }
}

fn words_title(language: InterfaceLanguage) -> &'static str {
    crate::action::Action::Palette
        .action_row()
        .name
        .text_in_language(language)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::action::Action;

    #[test]
    fn actions_are_found_by_any_of_their_words() {
        let found = |text, language| -> Vec<Action> {
            matching_action_rows(text, language, true)
                .iter()
                .map(|row| row.action)
                .collect()
        };
        assert_eq!(found("undo", InterfaceLanguage::English), [Action::Undo]);
        assert_eq!(found("RETABLIR", InterfaceLanguage::French), [Action::Redo]);
        assert_eq!(found("tier next", InterfaceLanguage::English), [Action::NextTier]);
        assert!(matching_action_rows("", InterfaceLanguage::English, true).len() == ACTIONS.len());
        assert!(matching_action_rows("undo", InterfaceLanguage::English, false).is_empty());
    }
}
