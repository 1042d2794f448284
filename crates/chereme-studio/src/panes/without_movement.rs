//! The panel about a sign without movement, with the possible actions.

use eframe::egui::{Frame, Label, Margin, Panel, RichText, Ui};

use crate::command::WindowCommand;
use crate::context::PaneInput;
use crate::panes::recombine::recipe_of;
use crate::words::{fill_text_braces, library as words};

/// The reason why a sign has no recorded movement.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum MovementAbsence {
    /// It is coded, or only named.
    Coded,
    /// It is notated and is being animated.
    Making,
    /// Its notation could not be animated, for this reason.
    Failed(String),
    /// The movement on the stage was animated from its notation, and is stored nowhere.
    Animated,
}

/// In a list lower than this, in points, the panel has only one line.
const LOW_LIST_HEIGHT_POINTS: f32 = 300.0;

/// Shows the state of a sign's movement, and the possible actions.
pub(crate) fn show_movement_absence(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    token: i64,
    gloss: &str,
    bare: &MovementAbsence,
) {
    // The panel is below the list, so that the list does not move.
    let frame = Frame::new().inner_margin(Margin::symmetric(0, 6));
    let id = ui.scope_id().with("bare");
    let low = ui.available_height() < LOW_LIST_HEIGHT_POINTS;
    Panel::bottom(id).frame(frame).show(ui, |ui| {
        let bare_text = match bare {
            MovementAbsence::Coded => words::ONLY_CODED,
            MovementAbsence::Making => words::ANIMATING,
            MovementAbsence::Failed(_) => words::NOT_ANIMATED,
            MovementAbsence::Animated => words::ANIMATED,
        };
        let text = fill_text_braces(seen.say_text(bare_text), &[("gloss", &gloss)]);
        let why = match bare {
            MovementAbsence::Failed(why) => why.as_str(),
            _ => "",
        };
        if low {
            ui.horizontal(|ui| {
                show_absence_actions(ui, seen, token, gloss, bare);
                let full_text = format!("{text}\n{why}");
                ui.add(Label::new(&text).truncate()).on_hover_text(full_text.trim_end());
            });
            return;
        }
        ui.label(text);
        if !why.is_empty() {
            ui.label(RichText::new(why).small().weak());
        }
        ui.horizontal_wrapped(|ui| show_absence_actions(ui, seen, token, gloss, bare));
    });
}

/// Shows the possible actions.
fn show_absence_actions(ui: &mut Ui, seen: &PaneInput<'_>, token: i64, gloss: &str, bare: &MovementAbsence) {
    let (name, recipe) = match bare {
        MovementAbsence::Making => return,
        MovementAbsence::Animated => {
            let recipe = recipe_of(&seen.snapshot.overview, token, gloss);
            (words::TO_RECIPE, recipe)
        }
        MovementAbsence::Coded | MovementAbsence::Failed(_) => (words::MAKE, String::new()),
    };
    if ui.button(seen.say_text(name)).clicked() {
        let gloss = gloss.to_owned();
        seen.send_command(WindowCommand::Make { recipe, gloss });
    }
    if *bare != MovementAbsence::Animated && ui.button(seen.say_text(words::ALIKE)).clicked() {
        let query = format!("like token:{token} not origin=lexicon");
        seen.send_command(WindowCommand::Find(query));
    }
}
