//! Writes pictures as a film: H.264 in MP4, which every player supports.

use std::io::Write;

use chereme_figure::{Image, Pictures};
use chereme_formats::mp4::{self, Muxer};
use chereme_sign::Remedy;
use rusty_h264::{Encoder, EncoderConfig, Preset, YuvFrame};

use super::colours::{Planes, usual};
use crate::error::{Error, Result};

/// The quantiser of pictures: 0 is lossless, 51 the coarsest. Lines of drawings stay sharp at 20.
const QUALITY: u8 = 20;
/// The seconds between frames where decoding can begin, so that seeking is fast.
const REFRESH: u32 = 2;
/// Levels of H.264 (annex A, table A-1): a name, and the most macroblocks (16 × 16 pixels) in a picture and in a
/// second.
const LEVELS: [(u8, u64, u64); 8] = [
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
pub(crate) struct Shape {
    /// Pictures per second.
    pub(crate) rate: u32,
}

/// Writes pictures as a film and returns their number; `hear` receives the progress and may stop the work.
pub(crate) fn write_film(
    pictures: &mut impl Pictures,
    shape: Shape,
    out: impl Write,
    hear: &mut dyn FnMut(usize, usize) -> Result<()>,
) -> Result<usize> {
    let [width, height] = pictures.size().map(|side| side.next_multiple_of(2));
    let colours = usual(height);
    let mut coder = coder([width, height], shape.rate)?;
    let picture = mp4::Picture {
        width: width as u16,
        height: height as u16,
        rate: (shape.rate, 1),
        colours,
    };
    let mut film = Muxer::new(picture);
    let total = pictures.frames();
    for frame in 0..total {
        hear(frame, total)?;
        let image: Image = pictures.draw(frame);
        let planes = Planes::of(&image, colours);
        let coded = coder.try_encode(&YuvFrame {
            width,
            height,
            y: planes.y,
            u: planes.u,
            v: planes.v,
        });
        film.add(&coded.map_err(|error| failed(&error))?);
    }
    film.add(&coder.try_flush().map_err(|error| failed(&error))?);
    if film.pictures() != total {
        let found = film.pictures();
        return Err(Error::wrong(format!(
            "of {total} pictures {found} were coded"
        )));
    }
    film.write(out).map_err(|error| match error {
        mp4::Error::Input(reason) => Error::wrong(format!("the film cannot be written: {reason}")),
        other => failed(&other),
    })?;
    Ok(total)
}

/// Returns an encoder for pictures of that size.
fn coder([width, height]: [usize; 2], rate: u32) -> Result<Encoder> {
    let squares = (width.div_ceil(16) * height.div_ceil(16)) as u64;
    let level = LEVELS
        .iter()
        .find(|(_, picture, second)| squares <= *picture && squares * u64::from(rate) <= *second);
    let (level, ..) = level.ok_or_else(|| {
        Error::wrong(format!(
            "a film of {width} by {height} pixels at {rate} pictures a second is too large for players"
        ))
        .advise(Remedy::command("make it lower with --height, draw fewer clips next to each other, or lower --rate"))
    })?;
    let config = EncoderConfig {
        level_idc: *level,
        qp: QUALITY,
        gop_size: rate * REFRESH,
        min_keyint: rate * REFRESH,
        scenecut: 0,
        lookahead: 0,
        mbtree: false,
        framerate: rate as f32,
        num_ref_frames: 1,
        preset: Preset::Fast,
        ..EncoderConfig::new(width, height)
    };
    Encoder::new(config).map_err(|error| failed(&error))
}

fn failed(error: &dyn std::fmt::Display) -> Error {
    Error::wrong(format!("the film cannot be coded: {error}"))
}
