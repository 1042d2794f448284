//! The panel about a sign without movement, with the possible actions.

use eframe::egui::{Frame, Label, Margin, Panel, RichText, Ui};

use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::panes::recombine::recipe_of;
use crate::words::{fill, library as words};

/// The reason why a sign has no recorded movement.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Bare {
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
const LOW: f32 = 300.0;

/// Shows the state of a sign's movement, and the possible actions.
pub(crate) fn show(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    out: &mut Outbox,
    (token, gloss): (i64, &str),
    bare: &Bare,
) {
    // The panel is below the list, so that the list does not move.
    let frame = Frame::new().inner_margin(Margin::symmetric(0, 6));
    let id = ui.scope_id().with("bare");
    let low = ui.available_height() < LOW;
    Panel::bottom(id).frame(frame).show(ui, |ui| {
        let text = match bare {
            Bare::Coded => words::ONLY_CODED,
            Bare::Making => words::ANIMATING,
            Bare::Failed(_) => words::NOT_ANIMATED,
            Bare::Animated => words::ANIMATED,
        };
        let text = fill(seen.say(text), &[("gloss", &gloss)]);
        let why = match bare {
            Bare::Failed(why) => why.as_str(),
            _ => "",
        };
        if low {
            ui.horizontal(|ui| {
                offers(ui, seen, out, (token, gloss), bare);
                let whole = format!("{text}\n{why}");
                ui.add(Label::new(&text).truncate())
                    .on_hover_text(whole.trim_end());
            });
            return;
        }
        ui.label(text);
        if !why.is_empty() {
            ui.label(RichText::new(why).small().weak());
        }
        ui.horizontal_wrapped(|ui| offers(ui, seen, out, (token, gloss), bare));
    });
}

/// Shows the possible actions.
fn offers(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    out: &mut Outbox,
    (token, gloss): (i64, &str),
    bare: &Bare,
) {
    let (name, recipe) = match bare {
        Bare::Making => return,
        Bare::Animated => {
            let recipe = recipe_of(&seen.snapshot.overview, token, gloss);
            (words::TO_RECIPE, recipe)
        }
        Bare::Coded | Bare::Failed(_) => (words::MAKE, String::new()),
    };
    if ui.button(seen.say(name)).clicked() {
        let gloss = gloss.to_owned();
        out.send(Command::Make { recipe, gloss });
    }
    if *bare != Bare::Animated && ui.button(seen.say(words::ALIKE)).clicked() {
        let query = format!("like token:{token} not origin=lexicon");
        out.send(Command::Find(query));
    }
}
