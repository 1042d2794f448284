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
mod gizmo;
mod insets;
mod original;
mod preview;
mod stage_course;
pub(crate) mod stage_data;
mod stage_handle;
mod stage_marks;
mod stage_points;
mod stage_scene;
mod stage_ui;
mod stage_view_settings;
mod tools;
mod transport;

use std::sync::Arc;
use std::time::Duration;

use chereme_corpus::CorpusOverview;
use chereme_figure::FigureView;
use chereme_motion::{BodySide, ModelPose};
use eframe::egui::{Context, Id, Rect, TextureHandle, Ui};

use crate::action::Action;
use crate::command::WindowCommand;
use crate::context::PaneInput;
use crate::model::generated::GeneratedClip;
use crate::panes::{ActionOutcome, PaneInterface};
use crate::settings::stage_settings::{DEFAULT_TRAIL_REACH_SECONDS, OriginalComparison, WantedInsets};
use crate::work::{WorkId, WorkResult};
use artist::StageArtist;
use original::OriginalMovements;
use stage_data::{StageExtras, StageEye, StageLook};
use stage_marks::PlacementZone;
use stage_points::RecordingPoints;
use stage_scene::{PostureSource, StageSubject};

/// The step of a key for turning, in shares of the picture's height, and for magnification.
const KEY_STEP: f32 = 0.06;
const KEY_ZOOM: f32 = 1.15;

/// The pane.
pub(crate) struct StagePane {
    artist: Option<StageArtist>,
    signer: Option<(MovementIdentity, StageSubject)>,
    original: OriginalMovements,
    points: RecordingPoints,
    /// The cameras of the panes.
    eyes: Vec<StageEye>,
    /// The pane that keyboard actions apply to.
    active: usize,
    compare: OriginalComparison,
    shows: StageExtras,
    /// The reach of trails when they are shown, in seconds.
    reach: f64,
    places: bool,
    insets: WantedInsets,
    /// The stroke of a newly opened recording or sign.
    stroke: Option<preview::PreviewStroke>,
    /// The moment that is shown instead of the playhead's, if any.
    previews: Option<chereme_motion::RecordingInstant>,
    zones: Option<(Arc<CorpusOverview>, Vec<PlacementZone>)>,
    textures: Vec<TextureHandle>,
    /// The signer's posture in the visible pictures.
    drawn: Option<ModelPose>,
    /// Serial numbers of the latest request for pictures, and of the request of the visible pictures.
    wished: u64,
    shown: u64,
    /// The inputs of the last requested pictures.
    asked: Option<StageLook>,
    /// Whether the moment at the playhead is still being loaded.
    coming: bool,
    /// How long the last pictures took to draw.
    took: Duration,
    /// The state of a placement's handle.
    holding: stage_handle::HandleState,
    /// The point of a path that is being pulled.
    pull: Option<stage_course::PathPull>,
    /// Whether the signer belongs to generated movement.
    made: bool,
    /// When generated movement was last replaced by a newer version, in seconds of the window's clock; and whether its
    /// picture should be visible in this frame.
    replaced: Option<f64>,
    at_once: bool,
    /// Whether the stored settings have been applied.
    remembered: bool,
}

impl Default for StagePane {
    fn default() -> Self {
        Self {
            artist: None,
            signer: None,
            original: OriginalMovements::default(),
            points: RecordingPoints::default(),
            eyes: vec![StageEye::default()],
            active: 0,
            compare: OriginalComparison::default(),
            shows: StageExtras {
                trails: None,
                ghosts: false,
                grid: false,
                points: true,
            },
            reach: DEFAULT_TRAIL_REACH_SECONDS,
            places: false,
            insets: WantedInsets::default(),
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
            holding: stage_handle::HandleState::default(),
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
struct MovementIdentity(usize);

impl StagePane {
    /// Builds the figures of the displayed movement if it changed; `time` is in seconds of the window's clock.
    fn rebuild_stage_figures(&mut self, seen: &PaneInput<'_>, time: f64) {
        let made = seen.shown.made.as_ref().map(|showing| &showing.made);
        let sample = seen.reel.sample_piece();
        let now = match (made, sample) {
            (Some(made), _) => Some((
                MovementIdentity(Arc::as_ptr(made) as usize),
                &made.clip,
                made.anatomy.as_ref(),
            )),
            (None, Some(it)) => Some((MovementIdentity(Arc::as_ptr(it) as usize), &it.clip, &it.anatomy)),
            (None, None) => None,
        };
        // Addresses distinguish movements without comparing all their frames.
        if self.signer.as_ref().map(|signer| signer.0) != now.map(|entry| entry.0) {
            // While a hand is being placed, the camera does not move.
            let newer = self.made && made.is_some();
            let steady = newer && seen.shown.handle.is_some();
            self.replaced = newer.then_some(time);
            // While something plays the next picture comes anyway.
            self.at_once = newer && !seen.shown.on_stage().is_playing();
            self.made = made.is_some();
            self.signer = now.and_then(|(of, clip, anatomy)| {
                // The same body is used again if only its movement changed.
                let before = self.signer.take().map(|signer| signer.1);
                Some((of, StageSubject::succeed_stage_subject(before, clip, anatomy, steady)?))
            });
            self.asked = None;
        }
        if self.original.request_original_movements(seen) {
            self.asked = None;
        }
        if self.points.request_recording_points(seen) {
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
    pub(crate) fn is_clip_on_stage(&self, made: &Arc<GeneratedClip>) -> bool {
        let of = MovementIdentity(Arc::as_ptr(made) as usize);
        self.signer.as_ref().is_some_and(|signer| signer.0 == of)
    }

    /// Returns how the original is shown, if there is one.
    fn comparing(&self) -> Option<OriginalComparison> {
        self.original.is_there().then_some(self.compare)
    }

    /// Returns whether the handle of a placement has the keyboard focus.
    pub(crate) fn is_held(&self, ctx: &Context) -> bool {
        self.holding.has_focus(ctx)
    }

    fn split_stage_views(&mut self, count: usize) {
        let usual = stage_data::usual_views(count);
        let kept = self.eyes.len().min(count);
        let mut eyes: Vec<StageEye> = self.eyes[..kept].to_vec();
        for view in usual {
            // A view is shown once, as long as there are usual ones left.
            if eyes.len() < count && eyes.iter().all(|eye| eye.view != *view) {
                eyes.push(StageEye::from_preset_view(*view));
            }
        }
        eyes.extend(
            usual
                .iter()
                .skip(eyes.len())
                .map(|view| StageEye::from_preset_view(*view)),
        );
        self.eyes = eyes;
        self.active = self.active.min(count - 1);
    }

    fn current_stage_eye(&mut self) -> &mut StageEye {
        let index = self.active.min(self.eyes.len() - 1);
        &mut self.eyes[index]
    }

    fn look_from(&mut self, action: Action) -> bool {
        let view = match action {
            Action::ViewFront => FigureView::Addressee,
            Action::ViewSigner => FigureView::Signer,
            Action::ViewLeft => FigureView::Left,
            Action::ViewRight => FigureView::Right,
            Action::ViewTop => FigureView::Top,
            Action::ViewRightHand => FigureView::Hand(BodySide::Right),
            Action::ViewLeftHand => FigureView::Hand(BodySide::Left),
            Action::ViewFace => FigureView::Face,
            _ => return self.move_eye(action),
        };
        *self.current_stage_eye() = StageEye::from_preset_view(view);
        true
    }

    fn move_eye(&mut self, action: Action) -> bool {
        let eye = self.current_stage_eye();
        match action {
            Action::OrbitLeft => eye.orbit_eye([-KEY_STEP, 0.0]),
            Action::OrbitRight => eye.orbit_eye([KEY_STEP, 0.0]),
            Action::OrbitUp => eye.orbit_eye([0.0, KEY_STEP]),
            Action::OrbitDown => eye.orbit_eye([0.0, -KEY_STEP]),
            Action::PanLeft => eye.pan_eye([KEY_STEP, 0.0]),
            Action::PanRight => eye.pan_eye([-KEY_STEP, 0.0]),
            Action::PanUp => eye.pan_eye([0.0, KEY_STEP]),
            Action::PanDown => eye.pan_eye([0.0, -KEY_STEP]),
            Action::Nearer => eye.magnify_eye(KEY_ZOOM),
            Action::Farther => eye.magnify_eye(1.0 / KEY_ZOOM),
            Action::StageReset => *eye = StageEye::from_preset_view(eye.view),
            _ => return false,
        }
        true
    }
}

impl PaneInterface for StagePane {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        if !std::mem::replace(&mut self.remembered, true) {
            self.apply_stage_settings(&seen.settings.stage);
        }
        stage_ui::show_stage_pane(self, ui, seen);
        let settings = self.stage_settings();
        if settings != seen.settings.stage {
            seen.send_command(WindowCommand::Stage(Box::new(settings)));
        }
    }

    fn carry_out_pane_action(&mut self, action: Action, _seen: &PaneInput<'_>) -> ActionOutcome {
        match action {
            Action::StageSplit => self.split_stage_views(match self.eyes.len() {
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
            Action::StageRecording => _seen.out.send_command(WindowCommand::Made(None)),
            other if self.look_from(other) => {}
            _ => return ActionOutcome::No,
        }
        self.asked = None;
        ActionOutcome::Yes
    }

    fn receive_work_result(&mut self, id: WorkId, ended: &WorkResult) {
        if self.original.receive_original_movements(id, ended) || self.points.receive_recording_points(id, ended) {
            self.asked = None;
        }
    }
}

/// Key for the rectangle of the pictures, and the frame in which they were there.
const STAGE_PLACE_KEY: &str = "place of the stage";

/// Remembers the rectangle of the pictures.
fn note_place(ui: &Ui, rect: Rect) {
    let frame = ui.ctx().cumulative_frame_nr();
    ui.data_mut(|data| data.insert_temp(Id::unique(STAGE_PLACE_KEY), (frame, rect)));
}

/// Returns the rectangle of the stage's pictures, if it is in sight.
pub(crate) fn visible_stage_rect(ctx: &Context) -> Option<Rect> {
    let (frame, rect): (u64, Rect) = ctx.data(|data| data.get_temp(Id::unique(STAGE_PLACE_KEY)))?;
    // The rectangle of the frame before counts too: other panes may be drawn earlier.
    (frame + 1 >= ctx.cumulative_frame_nr()).then_some(rect)
}

/// Returns the source of the signer's postures.
fn stage_movement_source<'a>(seen: &PaneInput<'a>) -> PostureSource<'a> {
    match &seen.shown.made {
        Some(showing) => PostureSource::Clip(&showing.made.clip, &showing.made.faces),
        None => PostureSource::Reel(seen.reel),
    }
}
