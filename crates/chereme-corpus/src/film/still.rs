//! A single picture of a recording's film, as lists of recordings and results show it.

use chereme_motion::RecordingInstant;

use super::{FilmFile, FilmPicture};
use crate::Corpus;
use crate::address::RowName;
use crate::error::CorpusResult;

/// The most frames that are decoded to reach a moment; beyond, the frame at which decoding begins stands for it.
const MAX_STILL_DECODED_FRAMES: usize = 30;

impl Corpus {
    /// Returns a picture of the first film of a recording that can be decoded, at most as large as `within` (width,
    /// height); `None` without such a film. It shows `at` of the recording's clock, or the last frame before it at which
    /// decoding can begin if that is more than 30 frames earlier.
    ///
    /// # Errors
    /// Fails if the recording does not exist, or the database fails.
    pub fn film_still(
        &self,
        recording: &RowName,
        at: RecordingInstant,
        within: [usize; 2],
    ) -> CorpusResult<Option<FilmPicture>> {
        let media_places = self.recording_media(recording)?.into_iter();
        let films = media_places.filter(|place| place.is_there && place.track.is_film());
        let stills = films.filter_map(|place| {
            // A film that cannot be opened here may be followed by one that can.
            let mut film = FilmFile::open_film(&place.path?).ok()?;
            let times = film.film_times().clone();
            let film_time = at.instant_micros() - place.track.offset_us;
            // A moment before or after the film shows its first or last picture.
            let frame = times.displayed_frame_at(film_time.clamp(0, (times.film_end() - 1).max(0)))?;
            let begins = times.sync_before(frame);
            let frame = if frame - begins > MAX_STILL_DECODED_FRAMES {
                begins
            } else {
                frame
            };
            film.screen_frame_picture(frame, within, &|| false).ok()
        });
        Ok({ stills }.next())
    }
}
