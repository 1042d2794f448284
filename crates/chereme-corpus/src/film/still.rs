//! A single picture of a recording's film, as lists of recordings and results show it.

use chereme_motion::Instant;

use super::{Film, FilmPicture};
use crate::Corpus;
use crate::address::Name;
use crate::error::Result;

/// The most frames that are decoded to reach a moment; beyond, the frame at which decoding begins stands for it.
const NEAR: usize = 30;

impl Corpus {
    /// Returns a picture of the first film of a recording that can be decoded, at most as large as `within` (width,
    /// height); `None` without such a film. It shows `at` of the recording's clock, or the last frame before it at which
    /// decoding can begin if that is more than 30 frames earlier.
    ///
    /// # Errors
    /// Fails if the recording does not exist, or the database fails.
    pub fn film_still(
        &self,
        recording: &Name,
        at: Instant,
        within: [usize; 2],
    ) -> Result<Option<FilmPicture>> {
        let films = self.media(recording)?.into_iter();
        let films = films.filter(|it| it.is_there && it.track.is_film());
        let stills = films.filter_map(|place| {
            let mut film = Film::open(&place.path?).ok()?;
            let times = film.times().clone();
            let own = at.micros() - place.track.offset_us;
            let frame = times.frame_at(own.clamp(0, (times.end() - 1).max(0)))?;
            let begins = times.sync_before(frame);
            let frame = if frame - begins > NEAR { begins } else { frame };
            film.picture(frame, within, &|| false).ok()
        });
        Ok({ stills }.next())
    }
}
