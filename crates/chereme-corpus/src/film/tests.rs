//! Tests of films: written ones are decoded exactly, damaged ones are refused or shown in part, and long work can be
//! stopped.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use chereme_figure::{PaperTheme, PictureSequence, RasterImage};
use chereme_formats::mp4::{PictureColours, PictureRotation};
use sha2::{Digest, Sha256};

use super::colours::PicturePlanes;
use super::*;

/// Squares that wander over a gradient, so that pictures differ from each other and move.
struct Squares {
    size: [usize; 2],
    frames: usize,
}

impl PictureSequence for Squares {
    fn picture_count(&self) -> usize {
        self.frames
    }

    fn picture_size(&self) -> [usize; 2] {
        self.size
    }

    fn centiseconds(&self) -> u16 {
        4
    }

    fn draw_sequence_picture(&mut self, frame: usize) -> RasterImage {
        painted(self.size, |x, y| {
            let inside = |left: usize, top: usize| (left..left + 20).contains(&x) && (top..top + 20).contains(&y);
            if inside(frame * 3, frame * 2) {
                [220, 40, 30]
            } else if inside(90 - frame.min(80), 40) {
                [20, 60, 200]
            } else {
                [60 + x as u8, 200 - y as u8, 90]
            }
        })
    }
}

/// Returns a picture of these colours.
fn painted([width, height]: [usize; 2], colour: impl Fn(usize, usize) -> [u8; 3]) -> RasterImage {
    let mut image = RasterImage::new(width, height, PaperTheme::Light.theme_paper_colour());
    for y in 0..height {
        for x in 0..width {
            image.set_colour([x, y], chereme_figure::RgbColour(colour(x, y)));
        }
    }
    image
}

/// Writes a film of squares, and returns its path.
pub(crate) fn film(folder: &Path, size: [usize; 2], frames: usize) -> PathBuf {
    let path = folder.join(format!("{}x{}.mp4", size[0], size[1]));
    let out = std::fs::File::create(&path).expect("made");
    let mut squares = Squares { size, frames };
    let shape = WrittenFilmShape { rate: 25 };
    let written = write_film(&mut squares, shape, out, &mut |_, _| Ok(()));
    assert_eq!(written.expect("written"), frames);
    path
}

fn never() -> bool {
    false
}

/// Returns the hash of all numbers of a film, frame by frame: luma, then both colour differences.
fn hash(film: &mut FilmFile) -> String {
    let mut hash = Sha256::new();
    for frame in 0..film.film_times().film_frame_count() {
        let planes = film.decoded_frame_planes(frame, &never).expect("a frame");
        hash.update(&planes.y);
        hash.update(&planes.u);
        hash.update(&planes.v);
    }
    hash.finalize().iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

#[test]
fn a_film_that_is_written_is_decoded_to_what_ffmpeg_decodes() {
    let folder = tempfile::tempdir().expect("a folder");
    // FFmpeg decodes these films to numbers with this hash.
    for (size, frames, known) in [([128, 96], 60, HASHES[0]), ([161, 91], 30, HASHES[1])] {
        let mut film = FilmFile::open_film(&film(folder.path(), size, frames)).expect("opened");
        let facts = film.film_facts().clone();
        assert_eq!(facts.frames, frames);
        assert_eq!((facts.coding.as_str(), facts.decoder), ("H.264", "chereme"));
        assert_eq!(facts.rate, 25.0);
        assert_eq!(facts.width, size[0].next_multiple_of(2));
        assert_eq!(hash(&mut film), known, "{size:?}");
    }
}

const HASHES: [&str; 2] = [
    "c007502cf41c4f2891f423f52d6ac533ef1aea4e1f08de808a317c141b191b65",
    "ef523f5078e934fbef7914d3fe98f9c96a30dd8e7b9ec1c7128b148f94001f77",
];

#[test]
fn frames_are_the_same_in_whatever_order_they_are_asked_for() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = film(folder.path(), [128, 96], 120);
    let mut one = FilmFile::open_film(&path).expect("opened");
    let all: Vec<_> = (0..120)
        .map(|frame| one.decoded_frame_planes(frame, &never).expect("a frame"))
        .collect();
    for order in [[119, 0, 77, 76, 75, 51, 50, 49], [3, 99, 100, 98, 10, 118, 0, 60]] {
        let mut other = FilmFile::open_film(&path).expect("opened");
        for frame in order {
            let planes = other.decoded_frame_planes(frame, &never).expect("a frame");
            assert_eq!(planes, all[frame], "{frame}");
        }
    }
    let times = one.film_times();
    assert_eq!(times.sync_before(60), 50);
    assert_eq!(times.displayed_frame_at(-1), None);
    assert_eq!(times.displayed_frame_at(0), Some(0));
    assert_eq!(times.displayed_frame_at(39_999), Some(0));
    assert_eq!(times.displayed_frame_at(40_000), Some(1));
    assert_eq!(times.displayed_frame_at(119 * 40_000), Some(119));
    assert_eq!(times.displayed_frame_at(120 * 40_000), None);
    assert!(one.decoded_frame_planes(120, &never).is_err());
}

#[test]
fn decoding_stops_on_request_and_continues() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = film(folder.path(), [128, 96], 60);
    let mut film = FilmFile::open_film(&path).expect("opened");
    let stopped = film.decoded_frame_planes(40, &|| true);
    assert!(matches!(stopped, Err(CorpusError::Stopped)));
    assert!(film.decoded_frame_planes(40, &never).is_ok());
}

#[test]
fn a_film_looks_like_what_was_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = film(folder.path(), [128, 96], 30);
    let mut film = FilmFile::open_film(&path).expect("opened");
    let mut squares = Squares {
        size: [128, 96],
        frames: 30,
    };
    let drawn = squares.draw_sequence_picture(12).to_rgb();
    let seen = film.screen_frame_picture(12, [1000, 1000], &never).expect("a picture");
    assert_eq!((seen.width, seen.height), (128, 96));
    let pairs = drawn.chunks(3).zip(seen.rgba.chunks(4));
    let off: u64 = pairs
        .flat_map(|(a, b)| [0, 1, 2].map(|at| u64::from(a[at].abs_diff(b[at]))))
        .sum();
    let mean = off as f64 / (128.0 * 96.0 * 3.0);
    assert!(mean < 6.0, "colours are off by {mean}");
    let small = film.screen_frame_picture(12, [64, 1000], &never).expect("a picture");
    assert_eq!((small.width, small.height, small.rgba.len()), (64, 48, 64 * 48 * 4));
}

#[test]
fn pictures_are_rotated_as_the_film_of_a_phone_states() {
    let colours = PictureColours {
        matrix: 1,
        full_range: true,
    };
    // White at the top left, black elsewhere.
    let image = painted([8, 4], |x, y| if x < 2 && y < 2 { [255; 3] } else { [0; 3] });
    let planes = PicturePlanes::from_drawn_image(&image, colours);
    for (turn, size, corner) in [
        (PictureRotation::None, [8, 4], [0, 0]),
        (PictureRotation::Quarter, [4, 8], [3, 0]),
        (PictureRotation::Half, [8, 4], [7, 3]),
        (PictureRotation::ThreeQuarters, [4, 8], [0, 7]),
    ] {
        let picture = planes.to_screen_picture(turn, [100, 100]);
        assert_eq!([picture.width, picture.height], size, "{turn:?}");
        for y in 0..size[1] {
            for x in 0..size[0] {
                let white = x.abs_diff(corner[0]) < 2 && y.abs_diff(corner[1]) < 2;
                let red = picture.rgba[(y * size[0] + x) * 4];
                assert_eq!(red > 128, white, "{turn:?} {x} {y}");
            }
        }
    }
}

#[test]
fn colours_survive_every_colour_matrix() {
    for matrix in [1, 6, 9] {
        for colour in [[0, 0, 0], [255, 255, 255], [200, 30, 40], [10, 90, 220], [120; 3]] {
            let colours = PictureColours {
                matrix,
                full_range: false,
            };
            let planes = PicturePlanes::from_drawn_image(&painted([2, 2], |_, _| colour), colours);
            let picture = planes.to_screen_picture(PictureRotation::None, [2, 2]);
            for (a, b) in colour.iter().zip(&picture.rgba) {
                assert!(a.abs_diff(*b) <= 3, "{matrix} {colour:?} {:?}", picture.rgba);
            }
        }
    }
}

#[test]
fn damaged_films_are_refused_or_shown_in_part_without_a_hang() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = film(folder.path(), [64, 48], 60);
    let whole = std::fs::read(&path).expect("read");
    let broken = folder.path().join("broken.mp4");
    let mut seed = 7_u64;
    let mut random = move |below: usize| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (seed >> 33) as usize % below
    };
    let mut refused = 0;
    for round in 0..60 {
        let mut bytes = whole.clone();
        for _ in 0..1 + random(12) {
            let at = random(bytes.len());
            bytes[at] = random(256) as u8;
        }
        if round % 3 == 0 {
            bytes.truncate(1 + random(whole.len()));
        }
        std::fs::write(&broken, &bytes).expect("written");
        match FilmFile::open_film(&broken) {
            Ok(mut film) => {
                for frame in [0, 59, 30, 31] {
                    let frame = frame.min(film.film_times().film_frame_count() - 1);
                    refused += usize::from(film.screen_frame_picture(frame, [32, 32], &never).is_err());
                }
            }
            Err(error) => {
                refused += 1;
                assert!(error.error_remedy().is_some(), "{error}");
            }
        }
    }
    assert!(refused > 0, "some are refused");
    std::fs::write(&broken, b"no film at all").expect("written");
    let error = FilmFile::open_film(&broken).map(|_| ()).expect_err("refused");
    assert!(error.error_remedy().is_some_and(|it| !it.is_empty()), "{error}");
    let missing = FilmFile::open_film(&folder.path().join("none.mp4"));
    assert!(missing.is_err());
}

#[test]
fn a_film_that_players_cannot_show_is_not_written() {
    let mut squares = Squares {
        size: [6000, 5000],
        frames: 1,
    };
    let shape = WrittenFilmShape { rate: 25 };
    let error = write_film(&mut squares, shape, Vec::new(), &mut |_, _| Ok(()));
    let error = error.expect_err("refused");
    assert!(
        error
            .error_remedy()
            .is_some_and(|it| it.remedy_text().contains("--height"))
    );
}

#[test]
fn a_film_that_is_stopped_is_not_written() {
    let mut squares = Squares {
        size: [64, 48],
        frames: 50,
    };
    let mut heard = 0;
    let shape = WrittenFilmShape { rate: 25 };
    let mut out = Vec::new();
    let stopped = write_film(&mut squares, shape, &mut out, &mut |done, total| {
        heard = done;
        assert_eq!(total, 50);
        if done == 10 { Err(CorpusError::Stopped) } else { Ok(()) }
    });
    assert!(matches!(stopped, Err(CorpusError::Stopped)));
    assert_eq!((heard, out.len()), (10, 0));
}
