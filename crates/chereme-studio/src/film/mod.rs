//! Films of the displayed recording, in step with its playhead; the stage and the film pane show the same films.
//!
//! | module | holds |
//! |---|---|
//! | `projector` | the thread of a film, which finds, opens and decodes it |
//! | `screen` | a film on the screen: its current frame, and its place on the recording's clock |

pub(crate) mod projector;
pub(crate) mod screen;

use std::cell::{RefCell, RefMut};
use std::path::{Path, PathBuf};

use chereme_corpus::MediaTrackRow;
use chereme_motion::RecordingInstant;
use eframe::egui::Context;

use crate::model::CorpusSnapshot;
use screen::FilmScreen;

/// The films of the displayed recording.
#[derive(Default)]
pub(crate) struct RecordingFilms {
    corpus: PathBuf,
    screens: RefCell<Vec<FilmScreen>>,
}

impl RecordingFilms {
    /// Returns an empty set of films for the corpus in that file.
    pub(crate) fn films_of_corpus(corpus: &Path) -> Self {
        Self {
            corpus: corpus.to_owned(),
            screens: RefCell::default(),
        }
    }

    /// Switches to the films of a recording; films that are shown already stay.
    pub(crate) fn follow_recording(&self, snapshot: &CorpusSnapshot, recording: Option<i64>, ctx: &Context) {
        let contents = recording.and_then(|id| snapshot.recording_contents(id));
        let media = contents.map_or(&[][..], |contents| &contents.media);
        let wanted: Vec<&MediaTrackRow> = media.iter().filter(|track| track.is_film()).collect();
        let mut screens = self.screens.borrow_mut();
        let same = screens.len() == wanted.len() && screens.iter().zip(&wanted).all(|(a, b)| a.track == **b);
        if contents.is_none() && recording.is_some() || same {
            // Nothing changed, or the recording is still being read.
            return;
        }
        let mut before = std::mem::take(&mut *screens);
        *screens = wanted
            .into_iter()
            .map(|track| {
                let is_same_film = |screen: &FilmScreen| {
                    screen.track.id == track.id
                        && screen.track.url == track.url
                        && screen.track.imported == track.imported
                };
                // A film that moved on the clock keeps its open file.
                match before.iter().position(is_same_film) {
                    Some(at) => before.swap_remove(at).with_moved_track(track),
                    None => FilmScreen::new(track.clone(), &self.corpus, ctx),
                }
            })
            .collect();
    }

    /// Returns whether there are any films.
    pub(crate) fn are_there(&self) -> bool {
        !self.screens.borrow().is_empty()
    }

    /// Returns the end of a recording's last film on its clock, as far as it is known.
    pub(crate) fn last_film_end(&self, recording: i64) -> RecordingInstant {
        let screens = self.screens.borrow();
        // The films of the recording before stay until the next one has been read.
        let recording_screens = screens.iter().filter(|screen| screen.track.recording_id == recording);
        let ends = recording_screens.filter_map(FilmScreen::film_end_micros);
        RecordingInstant::from_micros(ends.max().unwrap_or_default())
    }

    /// Returns the start of the frame that lies `frames` frames after the one at `at`, in the first opened film.
    pub(crate) fn step_first_film(&self, at: RecordingInstant, frames: i64) -> Option<RecordingInstant> {
        let screens = self.screens.borrow();
        screens.iter().find_map(|screen| screen.step_film_frame(at, frames))
    }

    /// Returns whether every film shows exactly the picture of the playhead, or has none there.
    pub(crate) fn are_pictured(&self) -> bool {
        self.screens.borrow().iter().all(FilmScreen::is_pictured)
    }

    /// Borrows the films, to be drawn.
    pub(crate) fn borrow_screens(&self) -> RefMut<'_, Vec<FilmScreen>> {
        self.screens.borrow_mut()
    }
}
