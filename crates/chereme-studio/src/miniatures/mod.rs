//! Looping little figures: movement at a glance, for results, cards and pickers.
//!
//! Any pane shows one with [`Figures::show`], through [`PaneInput::little`](crate::context::PaneInput::little):
//!
//! ```text
//! let motion = Motion::Span(recording, span);
//! let cell = Cell::new(motion, vec2(150.0, 150.0)).playing(miniatures::clock(ui));
//! if seen.little.show(ui, seen, out, &cell, "BOL").clicked() { … }
//! ```
//!
//! Movement is loaded on its own lane and drawn by its own thread, the middle picture first, then ever finer steps;
//! pictures are kept until there are too many of them. The window only shows finished pictures. [`Figures::hand`] shows
//! a posture of one hand alone, the picture of a handshape.

mod data;
mod draw;
mod ui;

pub(crate) use data::shown;
pub(crate) use ui::{empty, still};

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::thread::JoinHandle;

use chereme_corpus::Overview;
use chereme_motion::{HandAngles, Side, Span};
use eframe::egui::{TextureHandle, Ui, Vec2};

use crate::model::generated::GeneratedClip;
use crate::work::{Ended, Outcome, WorkId};
use draw::{Board, Film, Movement};

/// Movement that a little figure shows.
#[derive(Debug, Clone)]
pub(crate) enum Motion {
    /// A span of a recording; a very short one is a single posture.
    Span(i64, Span),
    /// Generated movement outside of recordings.
    #[allow(dead_code, reason = "for cards of recipes")]
    Made(Arc<GeneratedClip>),
}

/// The part of the signer in the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(crate) enum Focus {
    /// Head, shoulders, and the hands wherever they go.
    #[default]
    Signing,
    /// A close view of one hand that follows it.
    #[allow(dead_code, reason = "for results found by their handshape")]
    Hand(Side),
    /// A close view of the face that follows it.
    Face,
}

/// The contents and the size of one little figure.
#[derive(Debug, Clone)]
pub(crate) struct Cell {
    pub(crate) motion: Motion,
    pub(crate) focus: Focus,
    pub(crate) size: Vec2,
    /// Time in seconds of the clock shared by all playing figures; `None` if the figure stands still.
    pub(crate) clock: Option<f64>,
}

impl Cell {
    /// Returns a cell with a still figure, in the middle of its movement.
    pub(crate) fn new(motion: Motion, size: Vec2) -> Self {
        Self {
            motion,
            focus: Focus::default(),
            size,
            clock: None,
        }
    }

    /// Returns the cell with a looping figure, played by that [`clock`].
    pub(crate) fn playing(self, clock: f64) -> Self {
        Self {
            clock: Some(clock),
            ..self
        }
    }

    /// Returns the cell with another focus.
    #[allow(dead_code, reason = "for results found by their handshape")]
    pub(crate) fn focused(self, focus: Focus) -> Self {
        Self { focus, ..self }
    }
}

/// Returns the shared clock of looping figures, in seconds.
pub(crate) fn clock(ui: &Ui) -> f64 {
    ui.input(|input| input.time)
}

/// The source of a movement, as a map key.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Source {
    /// The row id of a recording, and the first and the end microsecond of a span.
    Span(i64, i64, i64),
    /// The address of generated movement in memory, which stays allocated as long as its entry exists.
    Made(usize),
    /// Whether it is the left hand, and the bit patterns of its angles.
    Hand(bool, [u64; HandAngles::LEN]),
}

impl Source {
    fn of(motion: &Motion) -> Self {
        match motion {
            Motion::Span(recording, span) => {
                Self::Span(*recording, span.start().micros(), span.end().micros())
            }
            Motion::Made(made) => Self::Made(Arc::as_ptr(made) as usize),
        }
    }
}

/// The identity of a strip of pictures, as a map key.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Key {
    source: Source,
    focus: Focus,
    size: [u16; 2],
    dark: bool,
}

/// All little figures of the open corpus.
#[derive(Default)]
pub(crate) struct Figures {
    board: Arc<Board>,
    own: RefCell<Own>,
}

/// State of the window's thread alone.
#[derive(Default)]
struct Own {
    thread: Option<JoinHandle<()>>,
    asked: BTreeMap<WorkId, Source>,
    textures: BTreeMap<Key, Texture>,
    /// Generated movement that is kept in memory as long as its pictures are, so that its address stays unique.
    made: BTreeMap<Source, Arc<GeneratedClip>>,
    /// The frame in which unused textures were last removed.
    swept: u64,
}

struct Texture {
    handle: TextureHandle,
    picture: usize,
    wanted: u64,
}

impl Figures {
    /// Returns whether it is known that nothing can be shown of some movement.
    pub(crate) fn is_nothing(&self, motion: &Motion) -> bool {
        let state = self.board.state();
        matches!(state.films.get(&Source::of(motion)), Some(Film::Nothing))
    }

    /// Handles the result of work; returns whether this module requested it.
    pub(crate) fn hear(&self, id: WorkId, ended: &Ended) -> bool {
        let Some(source) = self.own.borrow_mut().asked.remove(&id) else {
            return false;
        };
        let film = match ended {
            Ok(Outcome::Stretch(Some(moving))) => Film::Loaded(Movement::Recorded(moving.clone())),
            Ok(Outcome::Still(image)) => Film::Still(image.clone(), self.board.state().now),
            _ => Film::Nothing,
        };
        self.board.state().films.insert(source, film);
        self.board.wake();
        true
    }

    /// Forgets pictures of recordings whose movement changed.
    pub(crate) fn follow(&self, before: &Overview, now: &Overview) {
        let kept = |recording: i64| {
            let find = |all: &Overview| {
                let found = all.recordings.iter().find(|it| it.row.id == recording);
                found.map(|it| (it.row.name.clone(), it.frames, it.rate, it.recipe.clone()))
            };
            find(before) == find(now)
        };
        let mut judged: BTreeMap<i64, bool> = BTreeMap::new();
        let mut stays = |source: &Source| match source {
            Source::Span(recording, ..) => {
                *judged.entry(*recording).or_insert_with(|| kept(*recording))
            }
            _ => true,
        };
        let mut state = self.board.state();
        state.films.retain(|source, _| stays(source));
        state.strips.retain(|key, _| stays(&key.source));
        self.own
            .borrow_mut()
            .textures
            .retain(|key, _| stays(&key.source));
    }
}

impl Drop for Figures {
    fn drop(&mut self) {
        self.board.state().over = true;
        self.board.wake();
        if let Some(thread) = self.own.get_mut().thread.take() {
            // A thread that panicked has nothing left to do.
            let _ = thread.join();
        }
    }
}
