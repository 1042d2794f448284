//! Looping little figures: movement at a glance, for results, cards and pickers.
//!
//! Any pane paints one with [`MiniatureFigures::paint_figure`], through the `little` of what it sees:
//!
//! ```text
//! let motion = MiniatureMotion::Span(recording, span);
//! let cell = MiniatureCell::new(motion, size).with_playing_clock(miniatures::figure_loop_clock(ui));
//! seen.little.paint_figure(ui, seen.language, &cell, rect);
//! ```
//!
//! Movement is loaded on its own lane and drawn by its own thread, the middle picture first, then ever finer steps;
//! pictures are kept until there are too many of them. The window only shows finished pictures.
//! [`MiniatureFigures::paint_hand`] paints a posture of one hand alone, the picture of a handshape.

mod draw;
mod miniatures_data;
mod miniatures_ui;

pub(crate) use miniatures_ui::{paint_still_placeholder, paint_text_placeholder};

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::thread::JoinHandle;

use chereme_corpus::CorpusOverview;
use chereme_motion::{BodySide, HandAngles, TimeSpan};
use eframe::egui::{TextureHandle, Ui, Vec2};

use crate::model::generated::GeneratedClip;
use crate::work::{WorkId, WorkOutcome, WorkResult};
use draw::{DrawingBoard, MiniatureFilm, MiniatureMovement};

/// Movement that a little figure shows.
#[derive(Debug, Clone)]
pub(crate) enum MiniatureMotion {
    /// A span of a recording; a very short one is a single posture.
    Span(i64, TimeSpan),
    /// Generated movement outside of recordings.
    Made(Arc<GeneratedClip>),
}

/// The part of the signer in the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(crate) enum MiniatureFocus {
    /// Head, shoulders, and the hands wherever they go.
    #[default]
    Signing,
    /// A close view of one hand that follows it.
    Hand(BodySide),
    /// A close view of the face that follows it.
    Face,
}

/// The contents and the size of one little figure.
#[derive(Debug, Clone)]
pub(crate) struct MiniatureCell {
    pub(crate) motion: MiniatureMotion,
    pub(crate) focus: MiniatureFocus,
    pub(crate) size: Vec2,
    /// Time in seconds of the clock shared by all playing figures; `None` if the figure stands still.
    pub(crate) clock: Option<f64>,
}

impl MiniatureCell {
    /// Returns a cell with a still figure, in the middle of its movement.
    pub(crate) fn new(motion: MiniatureMotion, size: Vec2) -> Self {
        Self {
            motion,
            focus: MiniatureFocus::default(),
            size,
            clock: None,
        }
    }

    /// Returns the cell with a looping figure, played by that [`clock`].
    pub(crate) fn with_playing_clock(self, clock: f64) -> Self {
        Self {
            clock: Some(clock),
            ..self
        }
    }

    /// Returns the cell with another focus.
    pub(crate) fn with_picture_focus(self, focus: MiniatureFocus) -> Self {
        Self { focus, ..self }
    }
}

/// Returns the shared clock of looping figures, in seconds.
pub(crate) fn figure_loop_clock(ui: &Ui) -> f64 {
    ui.input(|input| input.time)
}

/// The source of a movement, as a map key.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum MiniatureSource {
    /// The row id of a recording, and the first and the end microsecond of a span.
    Span(i64, i64, i64),
    /// The address of generated movement in memory, which stays allocated as long as its entry exists.
    Made(usize),
    /// Whether it is the left hand, and the bit patterns of its angles.
    Hand(bool, [u64; HandAngles::HAND_ANGLE_COUNT]),
}

impl MiniatureSource {
    fn from_miniature_motion(motion: &MiniatureMotion) -> Self {
        match motion {
            MiniatureMotion::Span(recording, span) => Self::Span(
                *recording,
                span.span_start_instant().instant_micros(),
                span.span_end_instant().instant_micros(),
            ),
            MiniatureMotion::Made(made) => Self::Made(Arc::as_ptr(made) as usize),
        }
    }
}

/// The identity of a strip of pictures, as a map key.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct PictureStripKey {
    source: MiniatureSource,
    focus: MiniatureFocus,
    size: [u16; 2],
    dark: bool,
}

/// All little figures of the open corpus.
#[derive(Default)]
pub(crate) struct MiniatureFigures {
    board: Arc<DrawingBoard>,
    own: RefCell<WindowThreadState>,
}

/// State of the window's thread alone.
#[derive(Default)]
struct WindowThreadState {
    thread: Option<JoinHandle<()>>,
    asked: BTreeMap<WorkId, MiniatureSource>,
    textures: BTreeMap<PictureStripKey, MiniatureTexture>,
    /// Generated movement that is kept in memory as long as its pictures are, so that its address stays unique.
    made: BTreeMap<MiniatureSource, Arc<GeneratedClip>>,
    /// The frame in which unused textures were last removed.
    swept: u64,
}

struct MiniatureTexture {
    handle: TextureHandle,
    picture: usize,
    wanted: u64,
}

impl MiniatureFigures {
    /// Returns whether it is known that nothing can be shown of some movement.
    pub(crate) fn is_nothing(&self, motion: &MiniatureMotion) -> bool {
        let state = self.board.lock_board_state();
        matches!(
            state.films.get(&MiniatureSource::from_miniature_motion(motion)),
            Some(MiniatureFilm::Nothing)
        )
    }

    /// Handles the result of work; returns whether this module requested it.
    pub(crate) fn handle_miniature_result(&self, id: WorkId, ended: &WorkResult) -> bool {
        let Some(source) = self.own.borrow_mut().asked.remove(&id) else {
            return false;
        };
        let film = match ended {
            Ok(WorkOutcome::Stretch(Some(moving))) => {
                MiniatureFilm::Loaded(MiniatureMovement::Recorded(moving.clone()))
            }
            Ok(WorkOutcome::Still(image)) => MiniatureFilm::Still(image.clone(), self.board.lock_board_state().now),
            _ => MiniatureFilm::Nothing,
        };
        self.board.lock_board_state().films.insert(source, film);
        self.board.wake_drawing_thread();
        true
    }

    /// Forgets pictures of recordings whose movement changed.
    pub(crate) fn forget_changed_movement(&self, before: &CorpusOverview, now: &CorpusOverview) {
        let kept = |recording: i64| {
            let find = |all: &CorpusOverview| {
                let glance = all.recordings.iter().find(|it| it.row.id == recording);
                glance.map(|it| (it.row.name.clone(), it.frames, it.rate, it.recipe.clone()))
            };
            find(before) == find(now)
        };
        // Each recording is judged once, however many spans of it are shown.
        let mut judged: BTreeMap<i64, bool> = BTreeMap::new();
        let mut stays = |source: &MiniatureSource| match source {
            MiniatureSource::Span(recording, ..) => *judged.entry(*recording).or_insert_with(|| kept(*recording)),
            _ => true,
        };
        let mut state = self.board.lock_board_state();
        state.films.retain(|source, _| stays(source));
        state.strips.retain(|key, _| stays(&key.source));
        self.own.borrow_mut().textures.retain(|key, _| stays(&key.source));
    }
}

impl Drop for MiniatureFigures {
    fn drop(&mut self) {
        self.board.lock_board_state().over = true;
        self.board.wake_drawing_thread();
        if let Some(thread) = self.own.get_mut().thread.take() {
            // A thread that panicked has nothing left to do.
            let _ = thread.join();
        }
    }
}
