//! The bar below the cards: the result, its gloss, and the button to store it.

use chereme_corpus::RecombinationResult;
use eframe::egui::{Button, RichText, Ui};

use super::RecombinePane;
use crate::command::{CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::model::CorpusSnapshot;
use crate::panes::button_width;
use crate::words::{fill_text_braces, recombine_words as words};
use crate::work::recombining;

/// A sign that was stored.
#[derive(Debug, Clone)]
pub(super) struct StoredSign {
    gloss: String,
    recording: i64,
    /// The recipe as the corpus spells it.
    recipe: String,
}

impl StoredSign {
    /// Returns the sign that a recombination stored; `None` if it stored nothing.
    pub(super) fn stored_from_recombination(made: &RecombinationResult) -> Option<Self> {
        made.recording.map(|recording| Self {
            gloss: made.gloss.clone(),
            recording,
            recipe: made.recipe.clone(),
        })
    }

    /// Returns whether the corpus has the sign, made from this recipe.
    fn is_in_snapshot(&self, snapshot: &CorpusSnapshot) -> bool {
        let glance = snapshot.recording_glance(self.recording);
        glance.is_some_and(|glance| glance.recipe.as_ref() == Some(&self.recipe))
    }
}

impl RecombinePane {
    /// Shows the bar with the gloss and the button that stores the sign.
    pub(super) fn show_store_bar(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let made = self.live.made.is_some() && self.live.trouble.is_none() && self.wrong.is_none();
        if let Some(made) = &self.live.made {
            let time = format!("{:.2}", made.duration_us as f64 / 1e6);
            let took = format!("{:.0}", self.live.took * 1000.0);
            let values: [(&str, &dyn std::fmt::Display); 2] = [("time", &time), ("took", &took)];
            let lasts = fill_text_braces(seen.say_text(words::MADE_LASTS), &values);
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 4.0;
                let all = [(false, words::SHOW_ORIGINAL), (true, words::SHOW_MADE)];
                for (made, text) in all {
                    ui.selectable_value(&mut self.on_stage, made, seen.say_text(text));
                }
                let lasts = RichText::new(lasts).small().weak();
                ui.add(eframe::egui::Label::new(lasts).truncate());
            });
        }
        ui.horizontal(|ui| {
            let text = if self.opened.is_some() {
                words::STORE_AGAIN
            } else {
                words::STORE
            };
            let button = button_width(ui, seen.say_text(text));
            let gap = 2.0 * ui.spacing().item_spacing.x;
            let width = (ui.available_width() - button - gap).max(70.0);
            let shown = crate::script::script_edit::draw_text_line(ui, &mut self.gloss, |field| {
                let hint = seen.say_text(words::GLOSS);
                field.hint_text(hint).desired_width(width)
            });
            let response = shown.response.response;
            if self.naming {
                response.request_focus();
            }
            response.widget_info(|| {
                eframe::egui::WidgetInfo::labeled(eframe::egui::Role::TextInput, true, seen.say_text(words::GLOSS))
            });
            let entered = response.lost_focus() && ui.input(|input| input.key_pressed(eframe::egui::Key::Enter));
            let named = !self.gloss.trim().is_empty();
            let locked = seen.snapshot.is_read_only();
            let ready = made && named && !locked && !seen.is_running(self.storing);
            let why = if locked {
                crate::words::shell::READ_ONLY_WHY
            } else if named {
                words::NEEDS_RECIPE
            } else {
                words::NEEDS_GLOSS
            };
            let button = ui.add_enabled(ready, Button::new(seen.say_text(text)));
            let pressed = button.on_disabled_hover_text(seen.say_text(why)).clicked();
            if pressed || (entered && ready) {
                self.store_recipe_sign(seen.out);
            }
        });
        self.storing_again(ui, seen, made);
        // After an undo the stored sign does not exist any more, or has its former recipe again.
        let stored = self.stored.as_ref();
        if let Some(stored) = stored.filter(|stored| stored.is_in_snapshot(seen.snapshot)) {
            ui.horizontal_wrapped(|ui| {
                let text = fill_text_braces(
                    seen.say_text(crate::words::shell::NOTICE_STORED),
                    &[("gloss", &stored.gloss)],
                );
                ui.label(RichText::new(text).color(seen.pane_colours().good));
                if ui.small_button(seen.say_text(words::SHOW_STORED)).clicked() {
                    seen.send_command(WindowCommand::Recording(stored.recording));
                    seen.send_command(WindowCommand::Look);
                }
            });
        }
    }

    /// Shows the button that replaces the sign whose recipe was opened.
    fn storing_again(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, made: bool) {
        let opened_name = self.opened.as_deref();
        let opened = opened_name.and_then(|name| seen.snapshot.recording_named(name));
        let Some(glance) = opened.filter(|glance| glance.recipe.is_some()) else {
            return;
        };
        let text = fill_text_braces(seen.say_text(words::REPLACE), &[("name", &glance.row.name)]);
        let recipe = self.stack.used_recipe_text();
        let same = glance.recipe.as_ref() == Some(&recipe);
        let locked = seen.snapshot.is_read_only();
        let ready = made && !same && !locked && !seen.is_running(self.storing);
        let why = if locked {
            crate::words::shell::READ_ONLY_WHY
        } else if same {
            words::REPLACE_SAME
        } else {
            words::NEEDS_RECIPE
        };
        let replace_button = ui.add_enabled(ready, Button::new(text).truncate());
        let button = replace_button.on_hover_text(seen.say_text(words::REPLACE_TIP));
        if button.on_disabled_hover_text(seen.say_text(why)).clicked() {
            self.stored = None;
            let recording = glance.row.id;
            self.storing = Some(seen.request_work(recombining::store_again(recipe, recording)));
        }
    }

    fn store_recipe_sign(&mut self, out: &CommandOutbox) {
        let (recipe, gloss) = (self.stack.used_recipe_text(), self.gloss.trim().to_owned());
        self.stored = None;
        self.storing = Some(out.request_work(recombining::store_recipe_job(recipe, gloss)));
    }
}
