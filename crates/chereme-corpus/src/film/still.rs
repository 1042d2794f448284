//! A single picture of a recording's film, as lists of recordings and results show it.

use chereme_motion::Instant;

use super::{Film, FilmPicture};
use crate::Corpus;
use crate::address::Name;
use crate::error::Result;

/// A frame so many frames after the last one at which decoding can begin is quickly decoded.
const NEAR: usize = 30;

impl Corpus {
    /// Returns a picture of a recording's first film that plays here, at a moment of the recording's clock or a little
    /// before it, where a picture is quickly decoded; it is no larger than `within`. Nothing if no film is there.
    ///
    /// # Errors
    /// If there is no such recording, or the database fails. A film that cannot be decoded is passed over.
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
