//! Films of the displayed recording, in step with its playhead; the stage and the film pane show the same films.
//!
//! | module | holds |
//! |---|---|
//! | `projector` | the thread of a film, which finds, opens and decodes it |
//! | `screen` | a film on the screen: its current frame, and its place on the recording's clock |
//! | `ui` | the widgets |

mod projector;
mod screen;
mod ui;

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use chereme_corpus::MediaTrackRow;
use chereme_motion::Instant;
use eframe::egui::{Context, Id, Rect, Ui};

use crate::context::{Outbox, PaneInput};
use crate::model::Snapshot;
use screen::Screen;

/// The films of the displayed recording.
#[derive(Default)]
pub(crate) struct Films {
    corpus: PathBuf,
    screens: RefCell<Vec<Screen>>,
}

impl Films {
    /// Returns an empty set of films for the corpus in that file.
    pub(crate) fn of(corpus: &Path) -> Self {
        Self {
            corpus: corpus.to_owned(),
            screens: RefCell::default(),
        }
    }

    /// Switches to the films of a recording; films that are shown already stay.
    pub(crate) fn follow(&self, snapshot: &Snapshot, recording: Option<i64>, ctx: &Context) {
        let contents = recording.and_then(|id| snapshot.contents(id));
        let media = contents.map_or(&[][..], |it| &it.media);
        let wanted: Vec<&MediaTrackRow> = media.iter().filter(|it| it.is_film()).collect();
        let mut screens = self.screens.borrow_mut();
        let same = screens.len() == wanted.len()
            && screens.iter().zip(&wanted).all(|(a, b)| a.track == **b);
        if contents.is_none() && recording.is_some() || same {
            // Nothing changed, or the recording is still being read.
            return;
        }
        let mut before = std::mem::take(&mut *screens);
        *screens = wanted
            .into_iter()
            .map(|track| {
                let own = |it: &Screen| {
                    it.track.id == track.id
                        && it.track.url == track.url
                        && it.track.imported == track.imported
                };
                match before.iter().position(own) {
                    Some(at) => before.swap_remove(at).moved(track),
                    None => Screen::new(track.clone(), &self.corpus, ctx),
                }
            })
            .collect();
    }

    /// Returns whether there are any films.
    pub(crate) fn are_there(&self) -> bool {
        !self.screens.borrow().is_empty()
    }

    /// Returns the end of a recording's last film on its clock, as far as it is known.
    pub(crate) fn end(&self, recording: i64) -> Instant {
        let screens = self.screens.borrow();
        // The films of the recording before stay until the next one has been read.
        let own = screens
            .iter()
            .filter(|it| it.track.recording_id == recording);
        let ends = own.filter_map(Screen::end);
        Instant::from_micros(ends.max().unwrap_or_default())
    }

    /// Returns the start of the frame that lies `frames` frames after the one at `at`, in the first opened film.
    pub(crate) fn step(&self, at: Instant, frames: i64) -> Option<Instant> {
        let screens = self.screens.borrow();
        screens.iter().find_map(|it| it.step(at, frames))
    }

    /// Returns whether every film shows exactly the picture of the playhead, or has none there.
    pub(crate) fn are_pictured(&self) -> bool {
        self.screens.borrow().iter().all(Screen::is_pictured)
    }

    /// Shows the films next to each other.
    pub(crate) fn show(&self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox, rect: Rect) {
        ui::show(&mut self.screens.borrow_mut(), ui, seen, out, rect);
    }

    /// Notes that the film pane is in sight, so that the stage does not show the films too.
    pub(crate) fn pane_is_seen(ctx: &Context) {
        let pass = ctx.cumulative_pass_nr();
        ctx.data_mut(|data| data.insert_temp(Id::unique(PANE), pass));
    }

    /// Returns whether the film pane is in sight.
    pub(crate) fn is_pane_seen(ctx: &Context) -> bool {
        let pass = ctx.cumulative_pass_nr();
        let last: Option<u64> = ctx.data(|data| data.get_temp(Id::unique(PANE)));
        last.is_some_and(|last| last + 1 >= pass)
    }
}

const PANE: &str = "film pane";
