//! The stage: the signer in three dimensions, and the transport.
//!
//! | module | holds |
//! |---|---|
//! | `data` | cameras, the division of the stage, comparison with the original |
//! | `scene` | bodies, ghosts, trails, grid and floor |
//! | `gizmo` | the handle of a placement, as geometry |
//! | `handle` | its widget: dragged, moved by keys |
//! | `course` | a path that can be drawn and pulled |
//! | `marks` | landmarks and placement zones over the body |
//! | `insets` | close-ups of both hands and the face in the corners |
//! | `original` | the sources of generated movement |
//! | `points` | optical markers, and points from film |
//! | `preview` | the stroke of a newly opened sign |
//! | `artist` | the thread that draws |
//! | `view_settings` | the stored settings |
//! | `captions` | texts over the pictures |
//! | `tools` | the line of tools above |
//! | `transport` | the bar and the buttons below |
//! | `ui` | the pictures, and the gestures of the mouse on them |

mod artist;
mod captions;
mod course;
pub(crate) mod data;
mod gizmo;
mod handle;
mod insets;
mod marks;
mod original;
mod points;
mod preview;
mod scene;
mod tools;
mod transport;
mod ui;
mod view_settings;

use std::sync::Arc;
use std::time::Duration;

use chereme_corpus::Overview;
use chereme_figure::View;
use chereme_motion::{ModelPose, Side};
use eframe::egui::{Context, Id, Rect, TextureHandle, Ui};

use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::model::generated::GeneratedClip;
use crate::panes::{Acted, Pane};
use crate::work::{Ended, WorkId};
use artist::Artist;
use data::{Compare, Eye, Insets, Look, Shows};
use marks::Zone;
use original::Original;
use points::Points;
use scene::{Movement, Subject};
pub(crate) use view_settings::StageSettings;

/// The step of a key for turning, in shares of the picture's height, and for magnification.
const KEY_STEP: f32 = 0.06;
const KEY_ZOOM: f32 = 1.15;
/// Usual reach of trails, in seconds.
const REACH: f64 = 0.4;

/// The pane.
pub(crate) struct Stage {
    artist: Option<Artist>,
    signer: Option<(Of, Subject)>,
    original: Original,
    points: Points,
    /// The cameras of the panes.
    eyes: Vec<Eye>,
    /// The pane that keyboard actions apply to.
    active: usize,
    compare: Compare,
    shows: Shows,
    /// The reach of trails when they are shown, in seconds.
    reach: f64,
    places: bool,
    insets: Insets,
    /// The stroke of a newly opened recording or sign.
    stroke: Option<preview::Stroke>,
    /// The moment that is shown instead of the playhead's, if any.
    previews: Option<chereme_motion::Instant>,
    zones: Option<(Arc<Overview>, Vec<Zone>)>,
    textures: Vec<TextureHandle>,
    /// The signer's posture in the visible pictures.
    drawn: Option<ModelPose>,
    /// Serial numbers of the latest request for pictures, and of the request of the visible pictures.
    wished: u64,
    shown: u64,
    /// The inputs of the last requested pictures.
    asked: Option<Look>,
    /// Whether the moment at the playhead is still being loaded.
    coming: bool,
    /// How long the last pictures took to draw.
    took: Duration,
    /// The state of a placement's handle.
    holding: handle::Holding,
    /// The point of a path that is being pulled.
    pull: Option<course::Pull>,
    /// Whether the signer belongs to generated movement.
    made: bool,
    /// When generated movement was last replaced by a newer version, in seconds of the window's clock; and whether its
    /// picture should be visible in this frame.
    replaced: Option<f64>,
    at_once: bool,
    /// Whether the stored settings have been applied.
    remembered: bool,
}

impl Default for Stage {
    fn default() -> Self {
        Self {
            artist: None,
            signer: None,
            original: Original::default(),
            points: Points::default(),
            eyes: vec![Eye::default()],
            active: 0,
            compare: Compare::default(),
            shows: Shows {
                trails: None,
                ghosts: false,
                grid: false,
                points: true,
            },
            reach: REACH,
            places: false,
            insets: Insets::default(),
            stroke: None,
            previews: None,
            zones: None,
            textures: Vec::new(),
            drawn: None,
            wished: 0,
            shown: 0,
            asked: None,
            coming: false,
            took: Duration::ZERO,
            holding: handle::Holding::default(),
            pull: None,
            made: false,
            replaced: None,
            at_once: false,
            remembered: false,
        }
    }
}

/// The identity of a subject's movement: its address in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Of(usize);

impl Stage {
    /// Builds the figures of the displayed movement if it changed; `time` is in seconds of the window's clock.
    fn follow(&mut self, seen: &PaneInput<'_>, time: f64, out: &mut Outbox) {
        let made = seen.shown.made.as_ref().map(|showing| &showing.made);
        let sample = seen.reel.sample();
        let now = match (made, sample) {
            (Some(made), _) => Some((
                Of(Arc::as_ptr(made) as usize),
                &made.clip,
                made.anatomy.as_ref(),
            )),
            (None, Some(it)) => Some((Of(Arc::as_ptr(it) as usize), &it.clip, &it.anatomy)),
            (None, None) => None,
        };
        if self.signer.as_ref().map(|it| it.0) != now.map(|it| it.0) {
            // While a hand is being placed, the camera does not move.
            let newer = self.made && made.is_some();
            let steady = newer && seen.shown.handle.is_some();
            self.replaced = newer.then_some(time);
            self.at_once = newer && !seen.shown.on_stage().is_playing();
            self.made = made.is_some();
            self.signer = now.and_then(|(of, clip, anatomy)| {
                // The same body is used again if only its movement changed.
                let before = self.signer.take().map(|it| it.1);
                Some((of, Subject::after(before, clip, anatomy, steady)?))
            });
            self.asked = None;
        }
        if self.original.follow(seen, out) {
            self.asked = None;
        }
        if self.points.follow(seen, out) {
            self.asked = None;
        }
    }

    /// Returns how long the last pictures took to draw.
    pub(crate) fn drawing_time(&self) -> Duration {
        self.took
    }

    /// Returns whether the visible pictures are the last requested ones.
    pub(crate) fn is_drawn(&self) -> bool {
        self.asked.is_some() && self.wished == self.shown
    }

    /// Returns whether that movement is on the stage.
    pub(crate) fn shows(&self, made: &Arc<GeneratedClip>) -> bool {
        let of = Of(Arc::as_ptr(made) as usize);
        self.signer.as_ref().is_some_and(|it| it.0 == of)
    }

    /// Returns how the original is shown, if there is one.
    fn comparing(&self) -> Option<Compare> {
        self.original.is_there().then_some(self.compare)
    }

    /// Returns whether the handle of a placement has the keyboard focus.
    pub(crate) fn is_held(&self, ctx: &Context) -> bool {
        self.holding.has_focus(ctx)
    }

    fn split(&mut self, count: usize) {
        let usual = data::usual_views(count);
        let kept = self.eyes.len().min(count);
        let mut eyes: Vec<Eye> = self.eyes[..kept].to_vec();
        for view in usual {
            if eyes.len() < count && eyes.iter().all(|eye| eye.view != *view) {
                eyes.push(Eye::of(*view));
            }
        }
        eyes.extend(usual.iter().skip(eyes.len()).map(|view| Eye::of(*view)));
        self.eyes = eyes;
        self.active = self.active.min(count - 1);
    }

    fn eye(&mut self) -> &mut Eye {
        let at = self.active.min(self.eyes.len() - 1);
        &mut self.eyes[at]
    }

    fn look_from(&mut self, action: Action) -> bool {
        let view = match action {
            Action::ViewFront => View::Addressee,
            Action::ViewSigner => View::Signer,
            Action::ViewLeft => View::Left,
            Action::ViewRight => View::Right,
            Action::ViewTop => View::Top,
            Action::ViewRightHand => View::Hand(Side::Right),
            Action::ViewLeftHand => View::Hand(Side::Left),
            Action::ViewFace => View::Face,
            _ => return self.move_eye(action),
        };
        *self.eye() = Eye::of(view);
        true
    }

    fn move_eye(&mut self, action: Action) -> bool {
        let eye = self.eye();
        match action {
            Action::OrbitLeft => eye.orbit([-KEY_STEP, 0.0]),
            Action::OrbitRight => eye.orbit([KEY_STEP, 0.0]),
            Action::OrbitUp => eye.orbit([0.0, KEY_STEP]),
            Action::OrbitDown => eye.orbit([0.0, -KEY_STEP]),
            Action::PanLeft => eye.pan([KEY_STEP, 0.0]),
            Action::PanRight => eye.pan([-KEY_STEP, 0.0]),
            Action::PanUp => eye.pan([0.0, KEY_STEP]),
            Action::PanDown => eye.pan([0.0, -KEY_STEP]),
            Action::Nearer => eye.nearer(KEY_ZOOM),
            Action::Farther => eye.nearer(1.0 / KEY_ZOOM),
            Action::StageReset => *eye = Eye::of(eye.view),
            _ => return false,
        }
        true
    }
}

impl Pane for Stage {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        if !std::mem::replace(&mut self.remembered, true) {
            seen.settings.stage.take(self);
        }
        ui::show(self, ui, seen, out);
        let settings = StageSettings::of(self);
        if settings != seen.settings.stage {
            out.send(Command::Stage(Box::new(settings)));
        }
    }

    fn act(&mut self, action: Action, _seen: &PaneInput<'_>, out: &mut Outbox) -> Acted {
        match action {
            Action::StageSplit => self.split(match self.eyes.len() {
                1 => 2,
                2 => 4,
                _ => 1,
            }),
            Action::StageNextPane => self.active = (self.active + 1) % self.eyes.len(),
            Action::StageTrails => {
                self.shows.trails = match self.shows.trails {
                    Some(_) => None,
                    None => Some(self.reach),
                }
            }
            Action::StageGhosts => self.shows.ghosts = !self.shows.ghosts,
            Action::StagePlaces => self.places = !self.places,
            Action::StageHands => self.insets.hands = !self.insets.hands,
            Action::StagePalms => {
                // Turned palms are only visible in close-ups, so these are shown too.
                self.insets.palms = !(self.insets.palms && self.insets.hands);
                self.insets.hands = true;
            }
            Action::StageFace => self.insets.face = !self.insets.face,
            Action::StageGrid => self.shows.grid = !self.shows.grid,
            Action::StageCompare => self.compare = self.compare.next(),
            Action::StageRecording => out.send(Command::Made(None)),
            other if self.look_from(other) => {}
            _ => return Acted::No,
        }
        self.asked = None;
        Acted::Yes
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        if self.original.hear(id, ended) || self.points.hear(id, ended) {
            self.asked = None;
        }
    }
}

/// Key for the rectangle of the pictures, and the frame in which they were there.
const PLACE: &str = "place of the stage";

/// Remembers the rectangle of the pictures.
fn note_place(ui: &Ui, rect: Rect) {
    let frame = ui.ctx().cumulative_frame_nr();
    ui.data_mut(|data| data.insert_temp(Id::unique(PLACE), (frame, rect)));
}

/// Returns the rectangle of the stage's pictures, if it is in sight.
pub(crate) fn place(ctx: &Context) -> Option<Rect> {
    let (frame, rect): (u64, Rect) = ctx.data(|data| data.get_temp(Id::unique(PLACE)))?;
    (frame + 1 >= ctx.cumulative_frame_nr()).then_some(rect)
}

/// Returns the source of the signer's postures.
fn movement<'a>(seen: &PaneInput<'a>) -> Movement<'a> {
    match &seen.shown.made {
        Some(showing) => Movement::Clip(&showing.made.clip, &showing.made.faces),
        None => Movement::Reel(seen.reel),
    }
}
