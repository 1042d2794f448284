//! A film on the screen: its current frame, and its place on the recording's clock.

use std::path::Path;
use std::sync::Arc;

use chereme_corpus::{FilmTimes, MediaTrackRow};
use chereme_motion::RecordingInstant;
use eframe::egui::{Context, TextureHandle, TextureOptions};

use super::projector::{FilmFileState, FilmNews, FilmProjector, FilmRequest};

/// A film with its current picture.
pub(crate) struct FilmScreen {
    pub(crate) track: MediaTrackRow,
    projector: FilmProjector,
    pub(crate) news: FilmNews,
    pub(crate) texture: Option<TextureHandle>,
    /// The serial number of the picture in the texture.
    held: u64,
    wished: Option<FilmRequest>,
    /// The frame that stays while the recording moves, so that the film can be aligned with the recording.
    pub(crate) loose: Option<usize>,
    /// The start of the film while the user drags it, in microseconds on the recording's clock.
    pub(crate) dragged: Option<i64>,
}

impl FilmScreen {
    pub(crate) fn new(track: MediaTrackRow, corpus: &Path, ctx: &Context) -> Self {
        let wake = ctx.clone();
        Self {
            projector: FilmProjector::new(track.clone(), corpus, move || wake.request_repaint()),
            track,
            news: FilmNews::default(),
            texture: None,
            held: 0,
            wished: None,
            loose: None,
            dragged: None,
        }
    }

    /// Returns the screen with the track's newest entry in the corpus.
    pub(crate) fn with_moved_track(self, track: &MediaTrackRow) -> Self {
        Self {
            track: track.clone(),
            dragged: None,
            ..self
        }
    }

    /// Returns the times of the frames, once the film is open.
    pub(crate) fn frame_times(&self) -> Option<&Arc<FilmTimes>> {
        match &self.news.known {
            FilmFileState::Open(_, times) => Some(times),
            _ => None,
        }
    }

    /// Returns whether the film was not found, or cannot be played.
    pub(crate) fn is_missing(&self) -> bool {
        matches!(self.news.known, FilmFileState::Gone(_) | FilmFileState::Refused(..))
    }

    /// Returns the place of the film's time 0 on the recording's clock, in microseconds.
    pub(crate) fn film_offset_micros(&self) -> i64 {
        self.dragged.unwrap_or(self.track.offset_us)
    }

    /// Returns the end of the film on the recording's clock, in microseconds.
    pub(crate) fn film_end_micros(&self) -> Option<i64> {
        Some(self.frame_times()?.film_end() + self.track.offset_us)
    }

    /// Returns the frame at a moment of the recording.
    pub(crate) fn screen_frame_at(&self, at: RecordingInstant) -> Option<usize> {
        match self.loose {
            Some(frame) => Some(frame),
            None => self
                .frame_times()?
                .displayed_frame_at(at.instant_micros() - self.film_offset_micros()),
        }
    }

    /// Returns the start of the frame that lies `frames` frames after the one at `at`. Outside of the film, the first
    /// or the last frame counts.
    pub(crate) fn step_film_frame(&self, at: RecordingInstant, frames: i64) -> Option<RecordingInstant> {
        let times = self.frame_times()?;
        let film_time = at.instant_micros() - self.film_offset_micros();
        let last = times.film_frame_count().checked_sub(1)?;
        let next = match times.displayed_frame_at(film_time) {
            Some(frame) => frame.saturating_add_signed(frames as isize).min(last),
            None if film_time < times.film_frame_start(0) => 0,
            None => last,
        };
        Some(RecordingInstant::from_micros(
            times.film_frame_start(next) + self.film_offset_micros(),
        ))
    }

    /// Returns the offset at which `frame` begins at the moment `at` of the recording, in microseconds.
    pub(crate) fn offset_for_frame(&self, frame: usize, at: RecordingInstant) -> Option<i64> {
        Some(at.instant_micros() - self.frame_times()?.film_frame_start(frame))
    }

    /// Fetches the latest picture from the projector, and requests the picture of a frame.
    pub(crate) fn fetch_projected_picture(
        &mut self,
        frame: Option<usize>,
        within: [usize; 2],
        playing: bool,
        ctx: &Context,
    ) {
        self.news = self.projector.latest_film_news();
        if let Some(shot) = self.news.shot.as_ref().filter(|shot| shot.number != self.held) {
            self.held = shot.number;
            match &mut self.texture {
                Some(texture) => texture.set(shot.image.clone(), TextureOptions::LINEAR),
                None => {
                    let name = format!("film {}", self.track.id);
                    let image = shot.image.clone();
                    self.texture = Some(ctx.load_texture(name, image, TextureOptions::LINEAR));
                }
            }
        }
        let wish = frame.map(|frame| FilmRequest { frame, within, playing });
        if self.frame_times().is_some() && wish != self.wished {
            self.wished = wish;
            if let Some(wish) = wish {
                self.projector.wish_picture(wish);
            }
        }
    }

    /// Returns whether the picture is the latest requested one, or that one cannot be decoded.
    pub(crate) fn is_pictured(&self) -> bool {
        let Some(wish) = self.wished else {
            return !matches!(self.news.known, FilmFileState::Coming);
        };
        let shot = self.news.shot.as_ref();
        // A damaged frame is never shown, and waiting for it would never end.
        shot.is_some_and(|shot| shot.frame == wish.frame)
            || self.news.damaged.as_ref().is_some_and(|damage| damage.0 == wish.frame)
    }
}
