//! The steps of the first five minutes, in order.

use eframe::egui::{Align2, Context, Id, Label, RichText, ScrollArea, Window};

use crate::action::Action;
use crate::keys::Keys;
use crate::words::{Language, Text, steps as words};

/// The subject of a step, and the instructions: keys are named between braces.
const STEPS: [(Text, Text); 9] = [
    (words::LOOK, words::LOOK_HOW),
    (words::SELECT, words::SELECT_HOW),
    (words::ANNOTATE, words::ANNOTATE_HOW),
    (words::VALUE, words::VALUE_HOW),
    (words::BOUNDS, words::BOUNDS_HOW),
    (words::SEARCH, words::SEARCH_HOW),
    (words::MAKE, words::MAKE_HOW),
    (words::BACK, words::BACK_HOW),
    (words::MORE, words::MORE_HOW),
];

/// The window with the first steps; it stays open beside the work.
#[derive(Debug, Default)]
pub(crate) struct FirstSteps {
    open: bool,
}

impl FirstSteps {
    pub(crate) fn toggle(&mut self) {
        self.open = !self.open;
    }

    pub(crate) fn ui(&mut self, ctx: &Context, keys: &Keys, language: Language) {
        if !self.open {
            return;
        }
        let room = ctx.content_rect().size();
        let width = 380.0_f32.min(room.x - 40.0);
        let mut open = true;
        Window::new(Action::FirstSteps.row().name.of(language))
            .id(Id::unique("first steps"))
            .open(&mut open)
            .pivot(Align2::RIGHT_TOP)
            .default_pos(ctx.content_rect().right_top() + eframe::egui::vec2(-12.0, 40.0))
            .default_width(width)
            .resizable(false)
            .show(ctx, |ui| {
                ui.set_width(width);
                let high = (room.y - 140.0).max(120.0);
                let area = ScrollArea::vertical().max_height(high);
                area.min_scrolled_height(high).show(ui, |ui| {
                    for (at, (what, how)) in STEPS.into_iter().enumerate() {
                        let title = format!("{}. {}", at + 1, what.of(language));
                        ui.label(RichText::new(title).strong());
                        ui.add(Label::new(keys.named(how.of(language))).wrap());
                        ui.add_space(4.0);
                    }
                });
            });
        self.open = open && !super::escaped(ctx);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::{Keymap, Rebound};

    #[test]
    fn every_key_that_is_named_is_an_actions() {
        for (keymap, _) in Keymap::ALL {
            let keys = Keys::new(keymap, &Rebound::default());
            for (_, how) in STEPS {
                for (language, _) in Language::ALL {
                    let told = keys.named(how.of(language));
                    assert!(!told.contains(['{', '}']), "{told}");
                    let bare = told.split_whitespace().any(|word| {
                        crate::action::ACTIONS
                            .iter()
                            .any(|row| word.starts_with(row.id))
                    });
                    assert!(!bare, "an action without a key: {told}");
                }
            }
        }
    }
}
