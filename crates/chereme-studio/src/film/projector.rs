//! The thread of a film, which finds, opens and decodes it, so that the window never waits for a picture.
//!
//! Only the newest request counts. If its picture takes long to decode, a quickly decoded picture nearby is shown
//! first.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

use chereme_corpus::remedy::ErrorRemedy;
use chereme_corpus::{FilmFacts, FilmFile, FilmTimes, MediaTrackRow, find_media};
use eframe::egui::{Color32, ColorImage};

/// How many pictures are kept, so that a frame seen before is shown at once.
const MAX_KEPT_PICTURES: usize = 48;
/// How many pictures are decoded ahead during playback.
const DECODED_AHEAD_PICTURES: usize = 3;
/// A frame farther than this from the start of decoding, in frames, gets a quick picture of an earlier frame first.
const FAR_DECODE_FRAMES: usize = 10;
/// A newer request for a frame within this many frames ahead does not stop the present decoding.
const NEAR_REQUEST_FRAMES: usize = 60;
/// Stack size of the thread in bytes; decoders need more than other work.
const PROJECTOR_STACK_BYTES: usize = 16 << 20;

/// A request for a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct FilmRequest {
    pub(crate) frame: usize,
    /// The largest size of the picture, in pixels.
    pub(crate) within: [usize; 2],
    /// Whether the film plays forwards.
    pub(crate) playing: bool,
}

/// The state of the file.
#[derive(Debug, Clone, Default)]
pub(crate) enum FilmFileState {
    /// The file is being searched and opened.
    #[default]
    Coming,
    /// The film is open.
    Open(Arc<FilmFacts>, Arc<FilmTimes>),
    /// The file is missing; the first path that was tried.
    Gone(Option<PathBuf>),
    /// The film cannot be played: the reason, and a remedy.
    Refused(String, Option<ErrorRemedy>),
}

/// A decoded picture.
#[derive(Clone)]
pub(crate) struct DecodedPicture {
    pub(crate) frame: usize,
    pub(crate) image: Arc<ColorImage>,
    /// Serial number, counting up from picture to picture.
    pub(crate) number: u64,
}

/// The latest state of a film.
#[derive(Clone, Default)]
pub(crate) struct FilmNews {
    pub(crate) known: FilmFileState,
    pub(crate) shot: Option<DecodedPicture>,
    /// The latest frame that could not be decoded, and the reason.
    pub(crate) damaged: Option<(usize, String)>,
}

#[derive(Default)]
struct WishedPicture {
    next: Option<FilmRequest>,
    over: bool,
}

#[derive(Default)]
struct ProjectorShared {
    wish: Mutex<WishedPicture>,
    wished: Condvar,
    news: Mutex<FilmNews>,
}

/// The handle of a film's thread.
pub(crate) struct FilmProjector {
    shared: Arc<ProjectorShared>,
}

impl FilmProjector {
    /// Starts the thread for the film of a track; the thread calls `wake` when there is something new.
    pub(crate) fn new(track: MediaTrackRow, corpus: &Path, wake: impl Fn() + Send + 'static) -> Self {
        let shared = Arc::<ProjectorShared>::default();
        let thread_shared = shared.clone();
        let corpus = corpus.to_owned();
        let thread = std::thread::Builder::new().stack_size(PROJECTOR_STACK_BYTES);
        let begun = thread.spawn(move || {
            if let Some(film) = open_film_track(&thread_shared, track, &corpus) {
                wake();
                project_film(&thread_shared, film, &wake);
            }
            wake();
        });
        if let Err(error) = begun {
            lock_held_mutex(&shared.news).known = FilmFileState::Refused(error.to_string(), None);
        }
        Self { shared }
    }

    /// Requests a picture; an earlier request that has not been started is dropped.
    pub(crate) fn wish_picture(&self, wish: FilmRequest) {
        lock_held_mutex(&self.shared.wish).next = Some(wish);
        self.shared.wished.notify_one();
    }

    /// Returns the latest state of the film.
    pub(crate) fn latest_film_news(&self) -> FilmNews {
        lock_held_mutex(&self.shared.news).clone()
    }
}

impl Drop for FilmProjector {
    fn drop(&mut self) {
        // The thread ends after the picture that it is decoding; the window does not wait for that.
        lock_held_mutex(&self.shared.wish).over = true;
        self.shared.wished.notify_one();
    }
}

fn open_film_track(shared: &ProjectorShared, track: MediaTrackRow, corpus: &Path) -> Option<FilmFile> {
    let place = find_media(track, corpus);
    let known_setter = |known: FilmFileState| lock_held_mutex(&shared.news).known = known;
    let Some(path) = place.path.filter(|_| place.is_there) else {
        known_setter(FilmFileState::Gone(find_media(place.track, corpus).path));
        return None;
    };
    match FilmFile::open_film(&path) {
        Ok(film) => {
            let facts = Arc::new(film.film_facts().clone());
            known_setter(FilmFileState::Open(facts, film.film_times().clone()));
            Some(film)
        }
        Err(error) => {
            known_setter(FilmFileState::Refused(error.to_string(), error.error_remedy()));
            None
        }
    }
}

/// Recently decoded pictures of a film.
#[derive(Default)]
struct PictureAlbum(VecDeque<(FilmRequest, Arc<ColorImage>)>);

impl PictureAlbum {
    fn find_kept_picture(&self, wish: FilmRequest) -> Option<Arc<ColorImage>> {
        let same = |request: &FilmRequest| request.frame == wish.frame && request.within == wish.within;
        let entry = self.0.iter().find(|(request, _)| same(request));
        entry.map(|(_, image)| image.clone())
    }

    /// Returns the requested picture, decoding it if necessary; `None` if `stop` interrupts the decoding.
    fn decode_picture(
        &mut self,
        film: &mut FilmFile,
        wish: FilmRequest,
        stop: &dyn Fn() -> bool,
    ) -> chereme_corpus::CorpusResult<Option<Arc<ColorImage>>> {
        if let Some(image) = self.find_kept_picture(wish) {
            return Ok(Some(image));
        }
        let picture = match film.screen_frame_picture(wish.frame, wish.within, stop) {
            Ok(picture) => picture,
            // Not an error: another picture is wanted by now.
            Err(chereme_corpus::CorpusError::Stopped) => return Ok(None),
            Err(error) => return Err(error),
        };
        let rgba_chunks = picture.rgba.chunks_exact(4);
        let pixels = rgba_chunks.map(|rgba| Color32::from_rgb(rgba[0], rgba[1], rgba[2]));
        let size = [picture.width, picture.height];
        let image = Arc::new(ColorImage::new(size, pixels.collect()));
        self.0.push_back((wish, image.clone()));
        if self.0.len() > MAX_KEPT_PICTURES {
            self.0.pop_front();
        }
        Ok(Some(image))
    }
}

fn project_film(shared: &ProjectorShared, mut film: FilmFile, wake: &dyn Fn()) {
    let times = film.film_times().clone();
    let mut album = PictureAlbum::default();
    let mut number = 0;
    let mut last = 0_usize;
    while let Some(wish) = shared.next() {
        let overtaken = || {
            let wished = lock_held_mutex(&shared.wish);
            // A picture a little ahead is decoded on the way to it.
            let other = |next: &FilmRequest| !(wish.frame..wish.frame + NEAR_REQUEST_FRAMES).contains(&next.frame);
            wished.over || wished.next.as_ref().is_some_and(other)
        };
        let mut publish = |frame: usize, image: Arc<ColorImage>| {
            number += 1;
            let mut news = lock_held_mutex(&shared.news);
            news.shot = Some(DecodedPicture { frame, image, number });
            news.damaged = None;
            drop(news);
            wake();
        };
        let begin = times.sync_before(wish.frame);
        // Decoding goes on from the last picture if no nearer start lies between.
        let is_ahead = (begin..=wish.frame).contains(&last);
        let from = if is_ahead { last } else { begin };
        if wish.frame - from > FAR_DECODE_FRAMES && album.find_kept_picture(wish).is_none() {
            let quick = FilmRequest { frame: begin, ..wish };
            if let Ok(Some(image)) = album.decode_picture(&mut film, quick, &overtaken) {
                publish(begin, image);
                last = begin;
            }
        }
        match album.decode_picture(&mut film, wish, &overtaken) {
            Ok(Some(image)) => {
                publish(wish.frame, image);
                last = wish.frame;
            }
            Ok(None) => {}
            Err(error) => {
                lock_held_mutex(&shared.news).damaged = Some((wish.frame, error.to_string()));
                wake();
            }
        }
        if wish.playing {
            // Ahead only as long as nobody waits.
            let busy = || lock_held_mutex(&shared.wish).next.is_some() || lock_held_mutex(&shared.wish).over;
            for frame in (wish.frame + 1..times.film_frame_count()).take(DECODED_AHEAD_PICTURES) {
                let ahead = FilmRequest { frame, ..wish };
                if busy() || !matches!(album.decode_picture(&mut film, ahead, &busy), Ok(Some(_))) {
                    break;
                }
                last = frame;
            }
        }
    }
}

impl ProjectorShared {
    fn next(&self) -> Option<FilmRequest> {
        let mut wish = lock_held_mutex(&self.wish);
        loop {
            if wish.over {
                return None;
            }
            if let Some(next) = wish.next.take() {
                return Some(next);
            }
            let waited = self.wished.wait(wish);
            wish = waited.unwrap_or_else(PoisonError::into_inner);
        }
    }
}

fn lock_held_mutex<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
