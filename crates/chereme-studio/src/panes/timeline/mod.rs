//! The timeline: tiers with their annotations, the selected time, and the playhead.

pub(crate) mod data;
mod edit;
mod paint;
mod ui;

use chereme_motion::Span;

use crate::action::Action;
use crate::context::{Outbox, Seen};
use crate::panes::{Acted, Pane};
use data::Window;

/// The pane.
#[derive(Default)]
pub(crate) struct Timeline {
    /// What of the recording is to be seen; the whole where nothing is said.
    window: Option<Window>,
    /// The recording the window is of.
    of: Option<i64>,
    /// Where dragging a selection began, in microseconds.
    dragged_from: Option<i64>,
    /// How wide the part with annotations was last, in points.
    width: f32,
}

impl Timeline {
    /// Returns what is to be seen of `whole` in `width` points.
    fn window(&self, whole: Span, width: f32) -> Window {
        self.window.unwrap_or_else(|| Window::whole(whole, width))
    }

    fn zoom(&mut self, factor: f64, seen: &Seen<'_>) {
        let player = &seen.shown.player;
        let window = self.window(player.whole, self.width);
        let around = player.playhead().micros() as f64;
        self.window = Some(window.zoomed(factor, around, player.whole, self.width));
    }
}

impl Pane for Timeline {
    fn ui(&mut self, ui: &mut eframe::egui::Ui, seen: &Seen<'_>, out: &mut Outbox) {
        ui::show(self, ui, seen, out);
    }

    fn act(&mut self, action: Action, seen: &Seen<'_>, out: &mut Outbox) -> Acted {
        match action {
            Action::ZoomIn => self.zoom(0.6, seen),
            Action::ZoomOut => self.zoom(1.0 / 0.6, seen),
            Action::ZoomAll => self.window = None,
            other => return edit::act(other, seen, out),
        }
        Acted::Yes
    }
}
