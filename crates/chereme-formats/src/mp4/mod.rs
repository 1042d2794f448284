//! MP4 and QuickTime films: reads the position of each coded frame in the file and the time at which it is shown, and
//! writes films.
//!
//! The pictures themselves stay coded: a decoder turns a [`CodedFrame`]'s bytes into a picture. Only the boxes of the index
//! are read, so that a film of hours needs no more memory than its index. Every count of the file is bounded by the
//! bytes that hold it; no input makes the reader hang or use unbounded memory. Source: ISO/IEC 14496-12 (boxes),
//! 14496-15 (`avcC`).
//!
//! | module | holds |
//! |---|---|
//! | `boxes` | the boxes of a file, none beyond its parent |
//! | `read` | the tracks of a file and the index of its film |
//! | `table` | the tables of samples: sizes, places, times |
//! | `fragments` | the tables of samples in fragmented files |
//! | `h264` | parameter sets with the coding of colours |
//! | `write` | a writer for films of H.264 pictures |

mod boxes;
mod fragments;
pub mod mp4_h264;
mod mp4_read;
mod mp4_table;
mod mp4_write;
#[cfg(test)]
mod tests;

pub use mp4_read::read_mp4_index;
pub use mp4_write::{FilmProperties, Mp4Muxer};

use serde::Serialize;

/// The most frames of a film: a day at 60 per second.
pub const MAX_FRAMES: usize = 5_184_000;

/// A film as its container describes it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mp4Container {
    /// The four letters of its coding, such as `avc1`, `hvc1`, `av01`.
    pub coding: String,
    /// The data that a decoder needs before the first frame: for H.264 the content of `avcC`, else empty.
    pub configuration: Vec<u8>,
    /// Width of a coded picture in pixels, before rotation.
    pub width: u32,
    /// Height of a coded picture in pixels, before rotation.
    pub height: u32,
    /// The rotation that shows pictures upright.
    pub turn: PictureRotation,
    /// The coding of colours, if the container states it.
    pub colours: Option<PictureColours>,
    /// Ticks per second.
    pub timescale: u32,
    /// The frames in the order in which they are decoded.
    pub frames: Vec<CodedFrame>,
}

/// A coded picture of a film.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CodedFrame {
    /// The byte of the file at which it begins.
    pub offset: u64,
    /// The number of its bytes.
    pub size: u32,
    /// Whether decoding can begin here.
    pub sync: bool,
    /// The time at which it is shown, in ticks from the start of the film, with composition offset and edit list
    /// applied.
    pub shown: i64,
    /// The time for which it is shown, in ticks.
    pub duration: u32,
    /// Whether the edit list hides it; it may still be needed to decode others.
    pub hidden: bool,
}

/// The clockwise rotation that shows a picture upright.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum PictureRotation {
    /// No rotation.
    #[default]
    None,
    /// By 90 degrees.
    Quarter,
    /// By 180 degrees.
    Half,
    /// By 270 degrees.
    ThreeQuarters,
}

impl PictureRotation {
    /// Returns the size of a picture after the rotation.
    #[must_use]
    pub fn rotated_picture_size(self, [width, height]: [usize; 2]) -> [usize; 2] {
        match self {
            Self::None | Self::Half => [width, height],
            Self::Quarter | Self::ThreeQuarters => [height, width],
        }
    }
}

/// The mapping from a picture's numbers to colours (ITU-T H.273).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct PictureColours {
    /// `matrix_coefficients`: 1 is BT.709, 5 and 6 are BT.601, 9 is BT.2020.
    pub matrix: u8,
    /// Whether black is 0 and white 255, instead of 16 and 235.
    pub full_range: bool,
}

/// Why bytes could not be read as a film.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Mp4Error {
    /// The file is of another kind.
    #[error("this is no MP4 or QuickTime file")]
    NoMp4,
    /// The file has no list of its tracks, like a film whose recording was never finished.
    #[error("the file has no movie header (moov); the recording was cut off, or is not finished")]
    NoMovie,
    /// No track holds pictures.
    #[error("the file holds no pictures, only {0}")]
    NoPictures(String),
    /// A box is broken.
    #[error("the box {kind} at byte {at}: {problem}")]
    Box {
        /// The four letters of the box.
        kind: String,
        /// The byte of the file at which its content begins.
        at: u64,
        /// The problem.
        problem: &'static str,
    },
    /// Something in the file exceeds a limit of the reader.
    #[error("{what}: {found} where at most {most} are read")]
    Limit {
        /// The kind of thing that exceeds the limit, in the plural, such as `frames`.
        what: &'static str,
        /// The amount in the file.
        found: u64,
        /// The limit.
        most: u64,
    },
    /// The parameter sets of H.264 are broken.
    #[error("the parameter sets of H.264 are broken: {0}")]
    Parameters(&'static str),
    /// The file could not be read.
    #[error("{0}")]
    Input(String),
}

impl From<std::io::Error> for Mp4Error {
    fn from(error: std::io::Error) -> Self {
        Self::Input(error.to_string())
    }
}

impl Mp4Container {
    /// Returns the length of the film in ticks.
    #[must_use]
    pub fn film_length_ticks(&self) -> i64 {
        let shown = self.frames.iter().filter(|frame| !frame.hidden);
        let ends = shown.map(|frame| frame.shown.saturating_add(i64::from(frame.duration)));
        ends.max().unwrap_or_default().max(0)
    }

    /// Converts a time in ticks to microseconds.
    #[must_use]
    pub fn ticks_to_micros(&self, ticks: i64) -> i64 {
        let scale = i128::from(self.timescale.max(1));
        // To the nearest microsecond, before 0 too.
        let micros = (i128::from(ticks) * 1_000_000 + scale / 2).div_euclid(scale);
        i64::try_from(micros).unwrap_or_default()
    }

    /// Returns the positions in [`frames`](Self::frames) of the frames that are shown, in the order in which they are
    /// shown.
    #[must_use]
    pub fn shown_order(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.frames.len()).filter(|at| !self.frames[*at].hidden).collect();
        order.sort_by_key(|at| self.frames[*at].shown);
        order
    }

    /// Returns the position of the frame at which decoding must begin to reach frame `at`: the last sync frame before
    /// it that is not shown later than it. A sync frame that is shown later does not do: frames decoded after it and
    /// shown before it may need earlier ones.
    #[must_use]
    pub fn sync_before(&self, at: usize) -> usize {
        let shown = self.frames.get(at).map_or(i64::MAX, |frame| frame.shown);
        let mut until = self.frames.iter().take(at.saturating_add(1));
        let begins = |frame: &CodedFrame| frame.sync && frame.shown <= shown;
        until.rposition(begins).unwrap_or_default()
    }

    /// Returns the usual name of the coding, such as `H.264`.
    #[must_use]
    pub fn coding_name(&self) -> &str {
        match self.coding.as_str() {
            "avc1" | "avc3" => "H.264",
            "hvc1" | "hev1" => "H.265 (HEVC)",
            "av01" => "AV1",
            "vp09" => "VP9",
            "vp08" => "VP8",
            "mp4v" => "MPEG-4 Part 2",
            "apch" | "apcn" | "apcs" | "apco" | "ap4h" => "ProRes",
            "jpeg" | "mjpa" | "mjpb" => "Motion JPEG",
            "dvh1" | "dvhe" => "Dolby Vision",
            other => other,
        }
    }
}
