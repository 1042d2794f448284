//! Writes pictures as a film: H.264 in MP4, which every player supports.

use std::io::Write;

use chereme_figure::{PictureSequence, RasterImage};
use chereme_formats::mp4::{self, Mp4Muxer};
use rusty_h264::{Encoder, EncoderConfig, Preset, YuvFrame};

use super::colours::{PicturePlanes, default_film_colours};
use crate::error::{CorpusError, CorpusResult};

/// The quantiser of pictures: 0 is lossless, 51 the coarsest. Lines of drawings stay sharp at 20.
const FILM_QUANTISER: u8 = 20;
/// The seconds between frames where decoding can begin, so that seeking is fast.
const KEYFRAME_INTERVAL_SECONDS: u32 = 2;
/// Levels of H.264 (annex A, table A-1): a name, and the most macroblocks (16 × 16 pixels) in a picture and in a
/// second.
const H264_LEVELS: [(u8, u64, u64); 8] = [
    (30, 1620, 40_500),
    (31, 3600, 108_000),
    (32, 5120, 216_000),
    (40, 8192, 245_760),
    (42, 8704, 522_240),
    (50, 22_080, 589_824),
    (51, 36_864, 983_040),
    (52, 36_864, 2_073_600),
];

/// Properties of the film to be written.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WrittenFilmShape {
    /// Pictures per second.
    pub(crate) rate: u32,
}

/// Writes pictures as a film and returns their number; `hear` receives the progress and may stop the work.
pub(crate) fn write_film(
    pictures: &mut impl PictureSequence,
    shape: WrittenFilmShape,
    out: impl Write,
    hear: &mut dyn FnMut(usize, usize) -> CorpusResult<()>,
) -> CorpusResult<usize> {
    let [width, height] = pictures.picture_size().map(|side| side.next_multiple_of(2));
    let colours = default_film_colours(height);
    let mut coder = coder([width, height], shape.rate)?;
    let picture = mp4::FilmProperties {
        width: width as u16,
        height: height as u16,
        rate: (shape.rate, 1),
        colours,
    };
    let mut film = Mp4Muxer::new(picture);
    let total = pictures.picture_count();
    for frame in 0..total {
        hear(frame, total)?;
        let image: RasterImage = pictures.draw_sequence_picture(frame);
        let planes = PicturePlanes::from_drawn_image(&image, colours);
        let coded = coder.try_encode(&YuvFrame {
            width,
            height,
            y: planes.y,
            u: planes.u,
            v: planes.v,
        });
        film.add_coded_picture(&coded.map_err(|error| film_coding_error(&error))?);
    }
    film.add_coded_picture(&coder.try_flush().map_err(|error| film_coding_error(&error))?);
    // A missing picture would shift all later ones in time.
    if film.muxed_picture_count() != total {
        let coded = film.muxed_picture_count();
        return Err(CorpusError::from_wrong_message(format!(
            "of {total} pictures {coded} were coded"
        )));
    }
    film.write_mp4_film(out).map_err(|error| match error {
        mp4::Mp4Error::Input(reason) => {
            CorpusError::from_wrong_message(format!("the film cannot be written: {reason}"))
        }
        other => film_coding_error(&other),
    })?;
    Ok(total)
}

/// Returns an encoder for pictures of that size.
fn coder([width, height]: [usize; 2], rate: u32) -> CorpusResult<Encoder> {
    let squares = (width.div_ceil(16) * height.div_ceil(16)) as u64;
    let level = H264_LEVELS
        .iter()
        // Players refuse films that go beyond the level that they state.
        .find(|(_, picture, second)| squares <= *picture && squares * u64::from(rate) <= *second);
    let (level, ..) = level.ok_or_else(|| {
        CorpusError::from_wrong_message(format!(
            "a film of {width} by {height} pixels at {rate} pictures a second is too large for players"
        ))
        .with_command_advice("make it lower with --height, draw fewer clips next to each other, or lower --rate")
    })?;
    let config = EncoderConfig {
        level_idc: *level,
        qp: FILM_QUANTISER,
        gop_size: rate * KEYFRAME_INTERVAL_SECONDS,
        min_keyint: rate * KEYFRAME_INTERVAL_SECONDS,
        scenecut: 0,
        lookahead: 0,
        mbtree: false,
        framerate: rate as f32,
        num_ref_frames: 1,
        preset: Preset::Fast,
        ..EncoderConfig::new(width, height)
    };
    Encoder::new(config).map_err(|error| film_coding_error(&error))
}

fn film_coding_error(error: &dyn std::fmt::Display) -> CorpusError {
    CorpusError::from_wrong_message(format!("the film cannot be coded: {error}"))
}
