//! Films beside a corpus: decoding them frame by frame, and writing films.
//!
//! | module | holds |
//! |---|---|
//! | `h264` | H.264, decoded by the program itself |
//! | `helper` | all other formats, through the `ffmpeg` of the computer |
//! | `colours` | conversion between film colours and screen colours |
//! | `still` | one picture of a recording's film |
//! | `write` | writing pictures as a film |

mod colours;
mod film_h264;
mod film_write;
mod helper;
mod still;
#[cfg(test)]
pub(crate) mod tests;

use std::collections::VecDeque;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use chereme_formats::mp4::{self, PictureRotation};
use serde::Serialize;

pub use colours::PicturePlanes;
pub(crate) use film_write::{WrittenFilmShape, write_film};

use crate::error::{CorpusError, CorpusResult};

/// The bytes of decoded pictures that an open film caches, so that steps back are immediate.
const MAX_KEPT_PICTURE_BYTES: usize = 96 << 20;

/// The times of a film's frames, in microseconds from its start.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct FilmTimes {
    /// The starts of frames in display order; never descending.
    starts: Vec<i64>,
    /// The end of the last frame.
    end: i64,
    /// For each frame whether decoding can begin there.
    sync: Vec<bool>,
}

impl FilmTimes {
    /// Returns how many frames there are.
    #[must_use]
    pub fn film_frame_count(&self) -> usize {
        self.starts.len()
    }

    /// Returns the start of a frame; for a frame beyond the last, the end of the film.
    #[must_use]
    pub fn film_frame_start(&self, frame: usize) -> i64 {
        self.starts.get(frame).copied().unwrap_or(self.end)
    }

    /// Returns the end of the film.
    #[must_use]
    pub fn film_end(&self) -> i64 {
        self.end
    }

    /// Returns the frame that is displayed at a time; nothing before the first and after the last.
    #[must_use]
    pub fn displayed_frame_at(&self, micros: i64) -> Option<usize> {
        let after = self.starts.partition_point(|start| *start <= micros);
        (micros < self.end).then(|| after.checked_sub(1)).flatten()
    }

    /// Returns the last frame at or before `frame` where decoding can begin.
    #[must_use]
    pub fn sync_before(&self, frame: usize) -> usize {
        let until = self.sync.get(..=frame).unwrap_or(&self.sync);
        until.iter().rposition(|sync| *sync).unwrap_or_default()
    }

    /// Returns pictures per second, on average.
    #[must_use]
    pub fn mean_picture_rate(&self) -> f64 {
        let first = self.starts.first().copied().unwrap_or_default();
        let seconds = (self.end - first) as f64 / 1e6;
        if seconds > 0.0 {
            self.film_frame_count() as f64 / seconds
        } else {
            0.0
        }
    }
}

/// Facts of a film.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FilmFacts {
    /// The coding, such as `H.264`.
    pub coding: String,
    /// Width in pixels, as displayed.
    pub width: usize,
    /// Height in pixels, as displayed.
    pub height: usize,
    /// The number of frames.
    pub frames: usize,
    /// Pictures per second, on average.
    pub rate: f64,
    /// The length in microseconds.
    pub duration_us: i64,
    /// The rotation of coded pictures for display.
    pub turn: PictureRotation,
    /// The decoder: `chereme` or `ffmpeg`.
    pub decoder: &'static str,
    /// Oddities of the file.
    pub findings: Vec<String>,
}

/// A picture of a film in screen colours.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FilmPicture {
    /// Width in pixels.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
    /// Red, green, blue and opacity of each pixel, row by row.
    pub rgba: Vec<u8>,
}

/// Decodes the frames of a film, which are counted in display order.
trait FrameDecoder: Send {
    /// Decodes frames until `frame` was passed to `keep`, together with all others on the way.
    ///
    /// # Errors
    /// Fails if that frame cannot be decoded; [`Error::Stopped`] if `stop` returns true in between.
    fn decode_film_frames(
        &mut self,
        frame: usize,
        stop: &dyn Fn() -> bool,
        keep: &mut dyn FnMut(usize, PicturePlanes),
    ) -> CorpusResult<()>;
}

/// An open film.
pub struct FilmFile {
    path: PathBuf,
    facts: FilmFacts,
    times: Arc<FilmTimes>,
    decoder: Box<dyn FrameDecoder>,
    kept: VecDeque<(usize, Arc<PicturePlanes>)>,
}

impl FilmFile {
    /// Opens a film: the program decodes H.264 in MP4 or QuickTime itself, and everything else through `ffmpeg` if that
    /// is installed.
    ///
    /// # Errors
    /// Fails if the file is damaged, or no decoder is available; the remedy describes a conversion.
    pub fn open_film(path: &Path) -> CorpusResult<Self> {
        let mut file = File::open(path).map_err(|error| CorpusError::from_file_failure(path, error))?;
        let read = mp4::read_mp4_index(&mut file);
        let (container, findings) = match read {
            Ok(read) => read,
            Err(mp4::Mp4Error::NoMp4) => {
                return Self::helped(path, None, "no MP4 or QuickTime film");
            }
            Err(error) => {
                return Err(
                    CorpusError::from_wrong_message(format!("the film cannot be read: {error}"))
                        .with_error_place(path.display().to_string())
                        .with_advice("export or copy it again from where it was recorded"),
                );
            }
        };
        let findings = findings.into_iter().map(|finding| finding.message).collect();
        let times = Arc::new(container_film_times(&container));
        let coding = container.coding_name().to_owned();
        if !matches!(container.coding.as_str(), "avc1" | "avc3") {
            return Self::helped(path, Some((container, findings)), &coding);
        }
        let mut decoder = match film_h264::H264Film::new(file, path, container.clone()) {
            Ok(decoder) => decoder,
            Err(reason) => return Self::helped(path, Some((container, findings)), &reason),
        };
        let mut first = None;
        let decoded = decoder.decode_film_frames(0, &|| false, &mut |at, planes| {
            if at == 0 {
                first = Some(planes);
            }
        });
        let Some(first) = first else {
            let reason = match decoded {
                Err(error) => error.to_string(),
                Ok(()) => coding,
            };
            return Self::helped(path, Some((container, findings)), &reason);
        };
        let [width, height] = container.turn.rotated_picture_size([first.width, first.height]);
        let facts = FilmFacts {
            coding,
            width,
            height,
            frames: times.film_frame_count(),
            rate: times.mean_picture_rate(),
            duration_us: times.film_end(),
            turn: container.turn,
            decoder: "chereme",
            findings,
        };
        Ok(Self {
            path: path.to_owned(),
            facts,
            times,
            decoder: Box::new(decoder),
            kept: VecDeque::from([(0, Arc::new(first))]),
        })
    }

    /// Opens a film through `ffmpeg`; if that is not installed, fails with `reason`.
    fn helped(path: &Path, known: Option<(mp4::Mp4Container, Vec<String>)>, reason: &str) -> CorpusResult<Self> {
        let shown_path = path.display();
        if !helper::is_there() {
            return Err(CorpusError::from_wrong_message(format!(
                "the film cannot be played: {reason}; the program itself plays H.264 (8 bits, 4:2:0, not interlaced) \
                 in MP4 or MOV files"
            ))
            .with_error_place(shown_path.to_string())
            .with_advice(format!(
                "install ffmpeg, which is used then; or convert the film once, where ffmpeg is: ffmpeg -i {shown_path:?} \
                 -c:v libx264 -pix_fmt yuv420p NEW.mp4"
            )));
        }
        let (facts, times, decoder) = helper::open_ffmpeg_film(path, known)?;
        Ok(Self {
            path: path.to_owned(),
            facts,
            times: Arc::new(times),
            decoder: Box::new(decoder),
            kept: VecDeque::new(),
        })
    }

    /// Returns the film's facts.
    #[must_use]
    pub fn film_facts(&self) -> &FilmFacts {
        &self.facts
    }

    /// Returns the times of its frames.
    #[must_use]
    pub fn film_times(&self) -> &Arc<FilmTimes> {
        &self.times
    }

    /// Returns a frame in the decoded form.
    ///
    /// # Errors
    /// Fails if there is no such frame or it is damaged; [`CorpusError::Stopped`] if `stop` returns true, after which another
    /// frame can be requested.
    pub fn decoded_frame_planes(&mut self, frame: usize, stop: &dyn Fn() -> bool) -> CorpusResult<Arc<PicturePlanes>> {
        if let Some((_, planes)) = self.kept.iter().find(|entry| entry.0 == frame) {
            return Ok(Arc::clone(planes));
        }
        if frame >= self.times.film_frame_count() {
            let last = self.times.film_frame_count().saturating_sub(1);
            return Err(CorpusError::from_wrong_message(format!(
                "the film has no frame {frame}; its frames are 0 to {last}"
            ))
            .with_error_place(self.path.display().to_string()));
        }
        let kept = &mut self.kept;
        let mut wanted_planes = None;
        self.decoder.decode_film_frames(frame, stop, &mut |at, planes| {
            let planes = Arc::new(planes);
            if at == frame {
                wanted_planes = Some(Arc::clone(&planes));
            }
            kept.retain(|entry| entry.0 != at);
            kept.push_back((at, planes));
            while kept.iter().map(|entry| entry.1.plane_byte_count()).sum::<usize>() > MAX_KEPT_PICTURE_BYTES
                && kept.len() > 1
            {
                kept.pop_front();
            }
        })?;
        wanted_planes.ok_or_else(|| {
            CorpusError::from_wrong_message(format!("frame {frame} of the film was not found"))
                .with_error_place(self.path.display().to_string())
        })
    }

    /// Returns a frame in screen colours, rotated for display and no larger than `within` or the film.
    ///
    /// # Errors
    /// As [`planes`](Self::decoded_frame_planes).
    pub fn screen_frame_picture(
        &mut self,
        frame: usize,
        within: [usize; 2],
        stop: &dyn Fn() -> bool,
    ) -> CorpusResult<FilmPicture> {
        let planes = self.decoded_frame_planes(frame, stop)?;
        Ok(planes.to_screen_picture(self.facts.turn, within))
    }
}

/// Returns the times of a film's frames.
fn container_film_times(container: &mp4::Mp4Container) -> FilmTimes {
    let order = container.shown_order();
    let frame = |at: &usize| &container.frames[*at];
    FilmTimes {
        starts: order
            .iter()
            .map(|at| container.ticks_to_micros(frame(at).shown))
            .collect(),
        end: container.ticks_to_micros(container.film_length_ticks()),
        sync: order.iter().map(|at| frame(at).sync).collect(),
    }
}
