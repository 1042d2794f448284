//! The pane of films of the displayed recording; while it is in sight, the stage does not show films.

use eframe::egui::{Button, Rect, Sense, Ui, vec2};

use super::{ActionOutcome, PaneInterface, film_screens};
use crate::action::Action;
use crate::command::{ChooserPurpose, WindowCommand};
use crate::context::PaneInput;
use crate::miniatures;
use crate::words::film_words as words;

/// The pane.
#[derive(Default)]
pub(crate) struct FilmPane;

impl PaneInterface for FilmPane {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let (whole, _) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
        if seen.films.are_there() {
            film_screens::show_film_screens(ui, seen, whole);
        } else {
            show_absent_film(ui, seen, whole);
        }
    }

    fn carry_out_pane_action(&mut self, action: Action, seen: &PaneInput<'_>) -> ActionOutcome {
        let frames = match action {
            Action::FilmBack => -1,
            Action::FilmForward => 1,
            _ => return ActionOutcome::No,
        };
        match seen.films.step_first_film(seen.shown.player.player_playhead(), frames) {
            Some(at) => {
                seen.send_seek(at);
                ActionOutcome::Yes
            }
            None => ActionOutcome::Cannot(words::NO_FILM),
        }
    }
}

/// Shows that there is no film, and offers to link one.
fn show_absent_film(ui: &mut Ui, seen: &PaneInput<'_>, whole: Rect) {
    let above = whole.with_max_y(whole.bottom() - 44.0);
    miniatures::paint_text_placeholder(ui, above, seen.say_text(words::NO_FILM));
    let Some(recording) = seen.shown.recording else {
        return;
    };
    let size = vec2(whole.width().min(200.0), 26.0);
    let place = Rect::from_center_size(whole.center_bottom() - vec2(0.0, 28.0), size);
    if ui.put(place, Button::new(seen.say_text(words::LINK))).clicked() {
        seen.send_command(WindowCommand::Choose(ChooserPurpose::Media(recording, None)));
    }
}
