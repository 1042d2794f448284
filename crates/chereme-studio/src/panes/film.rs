//! The pane of films of the displayed recording; while it is in sight, the stage does not show films.

use eframe::egui::{Button, Rect, Sense, Ui, vec2};

use super::{Acted, Pane};
use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::file_dialogs::Choose;
use crate::film::Films;
use crate::miniatures;
use crate::words::film as words;

/// The pane.
#[derive(Default)]
pub(crate) struct FilmPane;

impl Pane for FilmPane {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        Films::pane_is_seen(ui.ctx());
        let (whole, _) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
        if seen.films.are_there() {
            seen.films.show(ui, seen, out, whole);
        } else {
            none(ui, seen, out, whole);
        }
    }

    fn act(&mut self, action: Action, seen: &PaneInput<'_>, out: &mut Outbox) -> Acted {
        let frames = match action {
            Action::FilmBack => -1,
            Action::FilmForward => 1,
            _ => return Acted::No,
        };
        match seen.films.step(seen.shown.player.playhead(), frames) {
            Some(at) => {
                out.seek(at);
                Acted::Yes
            }
            None => Acted::Cannot(words::NO_FILM),
        }
    }
}

/// Shows that there is no film, and offers to link one.
fn none(ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox, whole: Rect) {
    let above = whole.with_max_y(whole.bottom() - 44.0);
    miniatures::empty(ui, above, seen.say(words::NO_FILM));
    let Some(recording) = seen.shown.recording else {
        return;
    };
    let size = vec2(whole.width().min(200.0), 26.0);
    let place = Rect::from_center_size(whole.center_bottom() - vec2(0.0, 28.0), size);
    if ui.put(place, Button::new(seen.say(words::LINK))).clicked() {
        out.send(Command::Choose(Choose::Media(recording, None)));
    }
}
