//! A film on the screen: its current frame, and its place on the recording's clock.

use std::path::Path;
use std::sync::Arc;

use chereme_corpus::{FilmTimes, MediaTrackRow};
use chereme_motion::Instant;
use eframe::egui::{Context, TextureHandle, TextureOptions};

use super::projector::{FilmRequest, Known, News, Projector};

/// A film with its current picture.
pub(super) struct Screen {
    pub(super) track: MediaTrackRow,
    projector: Projector,
    pub(super) news: News,
    pub(super) texture: Option<TextureHandle>,
    /// The serial number of the picture in the texture.
    held: u64,
    wished: Option<FilmRequest>,
    /// The frame that stays while the recording moves, so that the film can be aligned with the recording.
    pub(super) loose: Option<usize>,
    /// The start of the film while the user drags it, in microseconds on the recording's clock.
    pub(super) dragged: Option<i64>,
}

impl Screen {
    pub(super) fn new(track: MediaTrackRow, corpus: &Path, ctx: &Context) -> Self {
        let wake = ctx.clone();
        Self {
            projector: Projector::new(track.clone(), corpus, move || wake.request_repaint()),
            track,
            news: News::default(),
            texture: None,
            held: 0,
            wished: None,
            loose: None,
            dragged: None,
        }
    }

    /// Returns the screen with the track's newest entry in the corpus.
    pub(super) fn moved(self, track: &MediaTrackRow) -> Self {
        Self {
            track: track.clone(),
            dragged: None,
            ..self
        }
    }

    /// Returns the times of the frames, once the film is open.
    pub(super) fn times(&self) -> Option<&Arc<FilmTimes>> {
        match &self.news.known {
            Known::Open(_, times) => Some(times),
            _ => None,
        }
    }

    /// Returns whether the film was not found, or cannot be played.
    pub(super) fn is_missing(&self) -> bool {
        matches!(self.news.known, Known::Gone(_) | Known::Refused(..))
    }

    /// Returns the place of the film's time 0 on the recording's clock, in microseconds.
    pub(super) fn offset(&self) -> i64 {
        self.dragged.unwrap_or(self.track.offset_us)
    }

    /// Returns the end of the film on the recording's clock, in microseconds.
    pub(super) fn end(&self) -> Option<i64> {
        Some(self.times()?.end() + self.track.offset_us)
    }

    /// Returns the frame at a moment of the recording.
    pub(super) fn frame_at(&self, at: Instant) -> Option<usize> {
        match self.loose {
            Some(frame) => Some(frame),
            None => self.times()?.frame_at(at.micros() - self.offset()),
        }
    }

    /// Returns the start of the frame that lies `frames` frames after the one at `at`. Outside of the film, the first
    /// or the last frame counts.
    pub(super) fn step(&self, at: Instant, frames: i64) -> Option<Instant> {
        let times = self.times()?;
        let own = at.micros() - self.offset();
        let last = times.frames().checked_sub(1)?;
        let next = match times.frame_at(own) {
            Some(frame) => frame.saturating_add_signed(frames as isize).min(last),
            None if own < times.start(0) => 0,
            None => last,
        };
        Some(Instant::from_micros(times.start(next) + self.offset()))
    }

    /// Returns the offset at which `frame` begins at the moment `at` of the recording, in microseconds.
    pub(super) fn laid(&self, frame: usize, at: Instant) -> Option<i64> {
        Some(at.micros() - self.times()?.start(frame))
    }

    /// Fetches the latest picture from the projector, and requests the picture of a frame.
    pub(super) fn follow(
        &mut self,
        frame: Option<usize>,
        within: [usize; 2],
        playing: bool,
        ctx: &Context,
    ) {
        self.news = self.projector.news();
        if let Some(shot) = self.news.shot.as_ref().filter(|it| it.number != self.held) {
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
        let wish = frame.map(|frame| FilmRequest {
            frame,
            within,
            playing,
        });
        if self.times().is_some() && wish != self.wished {
            self.wished = wish;
            if let Some(wish) = wish {
                self.projector.wish(wish);
            }
        }
    }

    /// Returns whether the picture is the latest requested one, or that one cannot be decoded.
    pub(super) fn is_pictured(&self) -> bool {
        let Some(wish) = self.wished else {
            return !matches!(self.news.known, Known::Coming);
        };
        let shot = self.news.shot.as_ref();
        shot.is_some_and(|it| it.frame == wish.frame)
            || self
                .news
                .damaged
                .as_ref()
                .is_some_and(|it| it.0 == wish.frame)
    }
}
