//! The stage: the signer in three dimensions, and the transport.

mod artist;
pub(crate) mod data;
mod ui;

use std::sync::Arc;

use chereme_corpus::Moving;
use chereme_figure::{Body, Framing, View};
use chereme_motion::Side;
use eframe::egui::{TextureHandle, Ui};

use crate::action::Action;
use crate::context::{Outbox, Seen};
use crate::panes::{Acted, Pane};
use artist::Artist;
use data::{Eye, Look};

/// The pane.
#[derive(Default)]
pub(crate) struct Stage {
    artist: Option<Artist>,
    figure: Option<Figure>,
    eye: Eye,
    texture: Option<TextureHandle>,
    /// What the picture that was asked for last shows.
    asked: Option<Look>,
    /// How long the last picture took to draw, in milliseconds.
    took: f32,
}

/// The signer of the recording that is shown.
struct Figure {
    /// The movement it was made for.
    of: Arc<Moving>,
    body: Arc<Body>,
    framing: Framing,
}

impl Figure {
    fn new(moving: &Arc<Moving>) -> Option<Self> {
        let framing = Framing::of(&moving.clip, &moving.anatomy)?;
        let body = Arc::new(Body::new(moving.clip.skeleton(), &moving.anatomy));
        Some(Self {
            of: moving.clone(),
            body,
            framing,
        })
    }
}

impl Stage {
    /// Makes the figure of the movement that is shown, where it is another.
    fn follow(&mut self, seen: &Seen<'_>) {
        let Some(moving) = seen.reel.sample() else {
            self.figure = None;
            return;
        };
        if self
            .figure
            .as_ref()
            .is_none_or(|figure| !Arc::ptr_eq(&figure.of, moving))
        {
            self.figure = Figure::new(moving);
            self.asked = None;
        }
    }
}

impl Pane for Stage {
    fn ui(&mut self, ui: &mut Ui, seen: &Seen<'_>, out: &mut Outbox) {
        ui::show(self, ui, seen, out);
    }

    fn act(&mut self, action: Action, _seen: &Seen<'_>, _out: &mut Outbox) -> Acted {
        let view = match action {
            Action::ViewFront => View::Addressee,
            Action::ViewSigner => View::Signer,
            Action::ViewLeft => View::Left,
            Action::ViewRight => View::Right,
            Action::ViewTop => View::Top,
            Action::ViewRightHand => View::Hand(Side::Right),
            Action::ViewLeftHand => View::Hand(Side::Left),
            _ => return Acted::No,
        };
        self.eye = Eye::of(view);
        Acted::Yes
    }
}
