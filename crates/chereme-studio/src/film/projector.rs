//! The thread of a film, which finds, opens and decodes it, so that the window never waits for a picture.
//!
//! Only the newest request counts. If its picture takes long to decode, a quickly decoded picture nearby is shown
//! first.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

use chereme_corpus::remedy::Remedy;
use chereme_corpus::{Film, FilmFacts, FilmTimes, MediaTrackRow, find_media};
use eframe::egui::{Color32, ColorImage};

/// How many pictures are kept, so that a frame seen before is shown at once.
const KEPT: usize = 48;
/// How many pictures are decoded ahead during playback.
const AHEAD: usize = 3;
/// A frame farther than this from the start of decoding, in frames, gets a quick picture of an earlier frame first.
const FAR: usize = 10;
/// A newer request for a frame within this many frames ahead does not stop the present decoding.
const NEAR: usize = 60;
/// Stack size of the thread in bytes; decoders need more than other work.
const STACK: usize = 16 << 20;

/// A request for a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct FilmRequest {
    pub(super) frame: usize,
    /// The largest size of the picture, in pixels.
    pub(super) within: [usize; 2],
    /// Whether the film plays forwards.
    pub(super) playing: bool,
}

/// The state of the file.
#[derive(Debug, Clone, Default)]
pub(super) enum Known {
    /// The file is being searched and opened.
    #[default]
    Coming,
    /// The film is open.
    Open(Arc<FilmFacts>, Arc<FilmTimes>),
    /// The file is missing; the first path that was tried.
    Gone(Option<PathBuf>),
    /// The film cannot be played: the reason, and a remedy.
    Refused(String, Option<Remedy>),
}

/// A decoded picture.
#[derive(Clone)]
pub(super) struct Shot {
    pub(super) frame: usize,
    pub(super) image: Arc<ColorImage>,
    /// Serial number, counting up from picture to picture.
    pub(super) number: u64,
}

/// The latest state of a film.
#[derive(Clone, Default)]
pub(super) struct News {
    pub(super) known: Known,
    pub(super) shot: Option<Shot>,
    /// The latest frame that could not be decoded, and the reason.
    pub(super) damaged: Option<(usize, String)>,
}

#[derive(Default)]
struct Wished {
    next: Option<FilmRequest>,
    over: bool,
}

#[derive(Default)]
struct Shared {
    wish: Mutex<Wished>,
    wished: Condvar,
    news: Mutex<News>,
}

/// The handle of a film's thread.
pub(super) struct Projector {
    shared: Arc<Shared>,
}

impl Projector {
    /// Starts the thread for the film of a track; the thread calls `wake` when there is something new.
    pub(super) fn new(
        track: MediaTrackRow,
        corpus: &Path,
        wake: impl Fn() + Send + 'static,
    ) -> Self {
        let shared = Arc::<Shared>::default();
        let own = shared.clone();
        let corpus = corpus.to_owned();
        let thread = std::thread::Builder::new().stack_size(STACK);
        let begun = thread.spawn(move || {
            if let Some(film) = open(&own, track, &corpus) {
                wake();
                project(&own, film, &wake);
            }
            wake();
        });
        if let Err(error) = begun {
            held(&shared.news).known = Known::Refused(error.to_string(), None);
        }
        Self { shared }
    }

    /// Requests a picture; an earlier request that has not been started is dropped.
    pub(super) fn wish(&self, wish: FilmRequest) {
        held(&self.shared.wish).next = Some(wish);
        self.shared.wished.notify_one();
    }

    /// Returns the latest state of the film.
    pub(super) fn news(&self) -> News {
        held(&self.shared.news).clone()
    }
}

impl Drop for Projector {
    fn drop(&mut self) {
        // The thread ends after the picture that it is decoding; the window does not wait for that.
        held(&self.shared.wish).over = true;
        self.shared.wished.notify_one();
    }
}

fn open(shared: &Shared, track: MediaTrackRow, corpus: &Path) -> Option<Film> {
    let place = find_media(track, corpus);
    let known = |known: Known| held(&shared.news).known = known;
    let Some(path) = place.path.filter(|_| place.is_there) else {
        known(Known::Gone(find_media(place.track, corpus).path));
        return None;
    };
    match Film::open(&path) {
        Ok(film) => {
            let facts = Arc::new(film.facts().clone());
            known(Known::Open(facts, film.times().clone()));
            Some(film)
        }
        Err(error) => {
            known(Known::Refused(error.to_string(), error.remedy()));
            None
        }
    }
}

/// Recently decoded pictures of a film.
#[derive(Default)]
struct Album(VecDeque<(FilmRequest, Arc<ColorImage>)>);

impl Album {
    fn find(&self, wish: FilmRequest) -> Option<Arc<ColorImage>> {
        let same = |it: &FilmRequest| it.frame == wish.frame && it.within == wish.within;
        let found = self.0.iter().find(|(it, _)| same(it));
        found.map(|(_, image)| image.clone())
    }

    /// Returns the requested picture, decoding it if necessary; `None` if `stop` interrupts the decoding.
    fn picture(
        &mut self,
        film: &mut Film,
        wish: FilmRequest,
        stop: &dyn Fn() -> bool,
    ) -> chereme_corpus::Result<Option<Arc<ColorImage>>> {
        if let Some(image) = self.find(wish) {
            return Ok(Some(image));
        }
        let picture = match film.picture(wish.frame, wish.within, stop) {
            Ok(picture) => picture,
            Err(chereme_corpus::Error::Stopped) => return Ok(None),
            Err(error) => return Err(error),
        };
        let pixels = picture.rgba.chunks_exact(4);
        let pixels = pixels.map(|it| Color32::from_rgb(it[0], it[1], it[2]));
        let size = [picture.width, picture.height];
        let image = Arc::new(ColorImage::new(size, pixels.collect()));
        self.0.push_back((wish, image.clone()));
        if self.0.len() > KEPT {
            self.0.pop_front();
        }
        Ok(Some(image))
    }
}

fn project(shared: &Shared, mut film: Film, wake: &dyn Fn()) {
    let times = film.times().clone();
    let mut album = Album::default();
    let mut number = 0;
    let mut last = 0_usize;
    while let Some(wish) = shared.next() {
        let overtaken = || {
            let wished = held(&shared.wish);
            let other = |next: &FilmRequest| !(wish.frame..wish.frame + NEAR).contains(&next.frame);
            wished.over || wished.next.as_ref().is_some_and(other)
        };
        let mut publish = |frame: usize, image: Arc<ColorImage>| {
            number += 1;
            let mut news = held(&shared.news);
            news.shot = Some(Shot {
                frame,
                image,
                number,
            });
            news.damaged = None;
            drop(news);
            wake();
        };
        let begin = times.sync_before(wish.frame);
        let is_ahead = (begin..=wish.frame).contains(&last);
        let from = if is_ahead { last } else { begin };
        if wish.frame - from > FAR && album.find(wish).is_none() {
            let quick = FilmRequest {
                frame: begin,
                ..wish
            };
            if let Ok(Some(image)) = album.picture(&mut film, quick, &overtaken) {
                publish(begin, image);
                last = begin;
            }
        }
        match album.picture(&mut film, wish, &overtaken) {
            Ok(Some(image)) => {
                publish(wish.frame, image);
                last = wish.frame;
            }
            Ok(None) => {}
            Err(error) => {
                held(&shared.news).damaged = Some((wish.frame, error.to_string()));
                wake();
            }
        }
        if wish.playing {
            let busy = || held(&shared.wish).next.is_some() || held(&shared.wish).over;
            for frame in (wish.frame + 1..times.frames()).take(AHEAD) {
                let ahead = FilmRequest { frame, ..wish };
                if busy() || !matches!(album.picture(&mut film, ahead, &busy), Ok(Some(_))) {
                    break;
                }
                last = frame;
            }
        }
    }
}

impl Shared {
    fn next(&self) -> Option<FilmRequest> {
        let mut wish = held(&self.wish);
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

fn held<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
