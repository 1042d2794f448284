//! The bar below the cards: the result, its gloss, and the button to store it.

use chereme_corpus::Recombination;
use eframe::egui::{Button, RichText, Ui};

use super::Recombine;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::model::Snapshot;
use crate::panes::button_width;
use crate::words::{fill, recombine as words};
use crate::work::recombining;

/// A sign that was stored.
#[derive(Debug, Clone)]
pub(super) struct Stored {
    gloss: String,
    recording: i64,
    /// The recipe as the corpus spells it.
    recipe: String,
}

impl Stored {
    /// Returns the sign that a recombination stored; `None` if it stored nothing.
    pub(super) fn of(made: &Recombination) -> Option<Self> {
        made.recording.map(|recording| Self {
            gloss: made.gloss.clone(),
            recording,
            recipe: made.recipe.clone(),
        })
    }

    /// Returns whether the corpus has the sign, made from this recipe.
    fn stands(&self, snapshot: &Snapshot) -> bool {
        let glance = snapshot.recording(self.recording);
        glance.is_some_and(|it| it.recipe.as_ref() == Some(&self.recipe))
    }
}

impl Recombine {
    /// Shows the bar with the gloss and the button that stores the sign.
    pub(super) fn storing(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let made = self.live.made.is_some() && self.live.trouble.is_none() && self.wrong.is_none();
        if let Some(made) = &self.live.made {
            let time = format!("{:.2}", made.duration_us as f64 / 1e6);
            let took = format!("{:.0}", self.live.took * 1000.0);
            let values: [(&str, &dyn std::fmt::Display); 2] = [("time", &time), ("took", &took)];
            let lasts = fill(seen.say(words::MADE_LASTS), &values);
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 4.0;
                let all = [(false, words::SHOW_ORIGINAL), (true, words::SHOW_MADE)];
                for (made, text) in all {
                    ui.selectable_value(&mut self.on_stage, made, seen.say(text));
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
            let button = button_width(ui, seen.say(text));
            let gap = 2.0 * ui.spacing().item_spacing.x;
            let width = (ui.available_width() - button - gap).max(70.0);
            let shown = crate::script::edit::line(ui, &mut self.gloss, |field| {
                let hint = seen.say(words::GLOSS);
                field.hint_text(hint).desired_width(width)
            });
            let response = shown.response.response;
            if self.naming {
                response.request_focus();
            }
            response.widget_info(|| {
                eframe::egui::WidgetInfo::labeled(
                    eframe::egui::Role::TextInput,
                    true,
                    seen.say(words::GLOSS),
                )
            });
            let entered = response.lost_focus()
                && ui.input(|input| input.key_pressed(eframe::egui::Key::Enter));
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
            let button = ui.add_enabled(ready, Button::new(seen.say(text)));
            let pressed = button.on_disabled_hover_text(seen.say(why)).clicked();
            if pressed || (entered && ready) {
                self.store(out);
            }
        });
        self.storing_again(ui, seen, out, made);
        // After an undo the stored sign does not exist any more, or has its former recipe again.
        let stored = self.stored.as_ref();
        if let Some(stored) = stored.filter(|it| it.stands(seen.snapshot)) {
            ui.horizontal_wrapped(|ui| {
                let text = fill(
                    seen.say(crate::words::shell::NOTICE_STORED),
                    &[("gloss", &stored.gloss)],
                );
                ui.label(RichText::new(text).color(seen.colours().good));
                if ui.small_button(seen.say(words::SHOW_STORED)).clicked() {
                    out.send(Command::Recording(stored.recording));
                    out.send(Command::Look);
                }
            });
        }
    }

    /// Shows the button that replaces the sign whose recipe was opened.
    fn storing_again(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox, made: bool) {
        let opened = self.opened.as_deref();
        let opened = opened.and_then(|name| seen.snapshot.recording_named(name));
        let Some(glance) = opened.filter(|it| it.recipe.is_some()) else {
            return;
        };
        let text = fill(seen.say(words::REPLACE), &[("name", &glance.row.name)]);
        let recipe = self.stack.text();
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
        let button = ui.add_enabled(ready, Button::new(text).truncate());
        let button = button.on_hover_text(seen.say(words::REPLACE_TIP));
        if button.on_disabled_hover_text(seen.say(why)).clicked() {
            self.stored = None;
            let recording = glance.row.id;
            self.storing = Some(out.work(recombining::store_again(recipe, recording)));
        }
    }

    fn store(&mut self, out: &mut Outbox) {
        let (recipe, gloss) = (self.stack.text(), self.gloss.trim().to_owned());
        self.stored = None;
        self.storing = Some(out.work(recombining::store(recipe, gloss)));
    }
}
