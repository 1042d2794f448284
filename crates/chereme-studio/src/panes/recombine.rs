//! Recombination: a recipe, what it makes, and storing it as a new sign.

use chereme_corpus::Recombination;
use eframe::egui::{Button, RichText, ScrollArea, TextEdit, Ui};

use super::Pane;
use crate::context::{Outbox, Seen};
use crate::words::recombine as words;
use crate::work::{Ended, Outcome, Work, WorkId};

/// The pane.
#[derive(Default)]
pub(crate) struct Recombine {
    recipe: String,
    gloss: String,
    asked: Option<WorkId>,
    stored: Option<WorkId>,
    /// How the last preview was made.
    report: Option<String>,
    /// Why it could not be.
    wrong: Option<String>,
    come: bool,
}

impl Pane for Recombine {
    fn ui(&mut self, ui: &mut Ui, seen: &Seen<'_>, out: &mut Outbox) {
        let label = ui.label(RichText::new(seen.say(words::RECIPE)).small());
        let recipe = TextEdit::multiline(&mut self.recipe)
            .hint_text(seen.say(words::HINT))
            .desired_rows(2)
            .desired_width(f32::INFINITY);
        let response = ui.add(recipe).labelled_by(label.id);
        if std::mem::take(&mut self.come) {
            response.request_focus();
        }
        let ready = !self.recipe.trim().is_empty();
        ui.horizontal(|ui| {
            let preview = Button::new(seen.say(words::PREVIEW));
            if ui.add_enabled(ready, preview).clicked() {
                self.asked = Some(out.work(Work::Preview(self.recipe.clone())));
            }
            if seen.is_running(self.asked) || seen.is_running(self.stored) {
                ui.spinner();
            }
        });
        let label = ui.label(RichText::new(seen.say(words::GLOSS)).small());
        let gloss = TextEdit::singleline(&mut self.gloss).desired_width(f32::INFINITY);
        ui.add(gloss).labelled_by(label.id);
        let named = !self.gloss.trim().is_empty();
        let store = Button::new(seen.say(words::STORE));
        let pressed = ui.add_enabled(ready && named, store);
        if pressed
            .on_disabled_hover_text(seen.say(words::NEEDS_GLOSS))
            .clicked()
        {
            let (recipe, gloss) = (self.recipe.clone(), self.gloss.trim().to_owned());
            self.stored = Some(out.work(Work::Recombine { recipe, gloss }));
        }
        if let Some(wrong) = &self.wrong {
            ui.label(RichText::new(wrong).color(seen.colours().trouble));
        }
        if let Some(report) = &self.report {
            ui.separator();
            ui.strong(seen.say(words::REPORT));
            ScrollArea::both()
                .auto_shrink(false)
                .show(ui, |ui| ui.monospace(report));
        }
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        if self.asked != Some(id) && self.stored != Some(id) {
            return;
        }
        self.wrong = None;
        let told = |made: &Recombination| Some(made.explanation.clone());
        match ended {
            Ok(Outcome::Previewed(made) | Outcome::Recombined(made)) => self.report = told(made),
            Err(error) => self.wrong = Some(error.to_string()),
            _ => {}
        }
    }

    fn come(&mut self) {
        self.come = true;
    }
}
