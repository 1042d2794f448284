//! Writes films of H.264 pictures.

use std::io::Write;

use super::{Mp4Error, PictureColours, mp4_h264};

/// Ticks per second in written films; a picture at 25, 30, 50, 60, 100 or 120 per second lasts whole ticks.
const FILM_TICKS_PER_SECOND: u32 = 90_000;
/// Ticks per second in the header of the movie, which holds its length.
const MOVIE_TICKS_PER_SECOND: u32 = 1000;
/// The most bytes of coded pictures.
const MAX_FILM_BYTES: usize = 2_000_000_000;

/// Properties of a film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmProperties {
    /// Width in pixels.
    pub width: u16,
    /// Height in pixels.
    pub height: u16,
    /// A number of pictures, and the seconds in which so many are shown.
    pub rate: (u32, u32),
    /// The mapping from numbers to colours.
    pub colours: PictureColours,
}

/// A film under construction, picture by picture. Coded pictures stay in memory, so that the file can begin with the
/// index and a film plays while it is being downloaded.
#[derive(Debug)]
pub struct Mp4Muxer {
    picture: FilmProperties,
    samples: Vec<u8>,
    sizes: Vec<u32>,
    sync: Vec<u32>,
    sequence: Vec<u8>,
    parameters: Vec<u8>,
}

impl Mp4Muxer {
    /// Begins a film.
    #[must_use]
    pub fn new(picture: FilmProperties) -> Self {
        Self {
            picture,
            samples: Vec::new(),
            sizes: Vec::new(),
            sync: Vec::new(),
            sequence: Vec::new(),
            parameters: Vec::new(),
        }
    }

    /// Adds a coded picture, as a stream with start codes; pictures come in the order in which they are shown.
    pub fn add_coded_picture(&mut self, stream: &[u8]) {
        let before = self.samples.len();
        let mut sync = false;
        for piece in mp4_h264::split_stream_pieces(stream).filter(|piece| !piece.is_empty()) {
            if mp4_h264::is_sequence(piece) {
                self.sequence = piece.to_vec();
            } else if mp4_h264::is_parameters(piece) {
                self.parameters = piece.to_vec();
            } else {
                sync |= mp4_h264::is_refresh(piece);
                let length = (piece.len() as u32).to_be_bytes();
                self.samples.extend_from_slice(&length);
                self.samples.extend_from_slice(piece);
            }
        }
        // Parameter sets alone are no picture.
        if self.samples.len() == before {
            return;
        }
        self.sizes.push((self.samples.len() - before) as u32);
        if sync {
            self.sync.push(self.sizes.len() as u32);
        }
    }

    /// Returns the number of pictures added.
    #[must_use]
    pub fn muxed_picture_count(&self) -> usize {
        self.sizes.len()
    }

    /// Writes the film.
    ///
    /// # Errors
    /// [`Mp4Error::Parameters`] if no picture came with parameter sets, [`Mp4Error::Limit`] above two gigabytes,
    /// [`Mp4Error::Input`] if `out` cannot be written.
    pub fn write_mp4_film(&self, mut out: impl Write) -> Result<(), Mp4Error> {
        if self.sequence.len() < 4 || self.parameters.is_empty() {
            return Err(Mp4Error::Parameters("no picture came with parameter sets"));
        }
        if self.samples.len() > MAX_FILM_BYTES {
            return Err(Mp4Error::Limit {
                what: "bytes of a film",
                found: self.samples.len() as u64,
                most: MAX_FILM_BYTES as u64,
            });
        }
        let kind = boxed(b"ftyp", |bytes| {
            bytes.extend_from_slice(b"isom\0\0\x02\0isomiso2avc1mp41");
        });
        // The length of the index does not depend on the offsets in it.
        let start = kind.len() + self.movie(0).len() + 8;
        out.write_all(&kind)?;
        out.write_all(&self.movie(start as u32))?;
        out.write_all(&(self.samples.len() as u32 + 8).to_be_bytes())?;
        out.write_all(b"mdat")?;
        out.write_all(&self.samples)?;
        out.flush()?;
        Ok(())
    }

    /// Returns the ticks for which a picture is shown.
    fn ticks_per_picture(&self) -> u32 {
        let (frames, seconds) = self.picture.rate;
        let ticks = u64::from(FILM_TICKS_PER_SECOND) * u64::from(seconds) / u64::from(frames.max(1));
        u32::try_from(ticks.max(1)).unwrap_or(u32::MAX)
    }

    /// Returns the index of a film whose first picture lies at byte `start`.
    fn movie(&self, start: u32) -> Vec<u8> {
        let FilmProperties { width, height, .. } = self.picture;
        let count = self.sizes.len() as u32;
        let ticks = u64::from(self.ticks_per_picture()) * u64::from(count);
        let length = (ticks * u64::from(MOVIE_TICKS_PER_SECOND)).div_ceil(u64::from(FILM_TICKS_PER_SECOND)) as u32;
        boxed(b"moov", |bytes| {
            bytes.extend(boxed(b"mvhd", |it| {
                append_box_words(
                    it,
                    &[0, 0, 0, MOVIE_TICKS_PER_SECOND, length, 0x1_0000, 0x100_0000, 0, 0],
                );
                append_box_words(it, &UNROTATED_MATRIX);
                append_box_words(it, &[0, 0, 0, 0, 0, 0, 2]);
            }));
            bytes.extend(boxed(b"trak", |it| {
                it.extend(boxed(b"tkhd", |it| {
                    append_box_words(it, &[7, 0, 0, 1, 0, length, 0, 0, 0, 0]);
                    append_box_words(it, &UNROTATED_MATRIX);
                    append_box_words(it, &[u32::from(width) << 16, u32::from(height) << 16]);
                }));
                it.extend(boxed(b"mdia", |it| {
                    it.extend(boxed(b"mdhd", |it| {
                        // A film of more than 13 hours has a length of 64 bits (version 1). The language is "undetermined".
                        match u32::try_from(ticks) {
                            Ok(ticks) => append_box_words(it, &[0, 0, 0, FILM_TICKS_PER_SECOND, ticks, 0x55c4_0000]),
                            Err(_) => {
                                append_box_words(it, &[1 << 24, 0, 0, 0, 0, FILM_TICKS_PER_SECOND]);
                                append_box_words(it, &[(ticks >> 32) as u32, ticks as u32, 0x55c4_0000]);
                            }
                        }
                    }));
                    it.extend(boxed(b"hdlr", |it| {
                        append_box_words(it, &[0, 0]);
                        it.extend_from_slice(b"vide");
                        append_box_words(it, &[0, 0, 0]);
                        it.extend_from_slice(b"film\0");
                    }));
                    it.extend(boxed(b"minf", |it| {
                        it.extend(boxed(b"vmhd", |it| append_box_words(it, &[1, 0, 0])));
                        it.extend(boxed(b"dinf", |it| {
                            it.extend(boxed(b"dref", |it| {
                                append_box_words(it, &[0, 1]);
                                it.extend(boxed(b"url ", |it| append_box_words(it, &[1])));
                            }));
                        }));
                        it.extend(self.encode_sample_table(count, start));
                    }));
                }));
            }));
        })
    }

    fn encode_sample_table(&self, count: u32, start: u32) -> Vec<u8> {
        boxed(b"stbl", |bytes| {
            bytes.extend(boxed(b"stsd", |it| {
                append_box_words(it, &[0, 1]);
                it.extend(self.encode_sample_entry());
            }));
            bytes.extend(boxed(b"stts", |it| {
                append_box_words(it, &[0, 1, count, self.ticks_per_picture()])
            }));
            bytes.extend(boxed(b"stss", |it| {
                append_box_words(it, &[0, self.sync.len() as u32]);
                append_box_words(it, &self.sync);
            }));
            bytes.extend(boxed(b"stsc", |it| append_box_words(it, &[0, 1, 1, count, 1])));
            bytes.extend(boxed(b"stsz", |it| {
                append_box_words(it, &[0, 0, count]);
                append_box_words(it, &self.sizes);
            }));
            bytes.extend(boxed(b"stco", |it| append_box_words(it, &[0, 1, start])));
        })
    }

    fn encode_sample_entry(&self) -> Vec<u8> {
        let FilmProperties {
            width, height, colours, ..
        } = self.picture;
        boxed(b"avc1", |bytes| {
            bytes.extend_from_slice(&[0, 0, 0, 0, 0, 0, 0, 1]);
            append_box_words(bytes, &[0, 0, 0, 0]);
            bytes.extend_from_slice(&width.to_be_bytes());
            bytes.extend_from_slice(&height.to_be_bytes());
            // 72 dots per inch, one picture in each sample, a name of 32 bytes, 24 bits.
            append_box_words(bytes, &[0x48_0000, 0x48_0000, 0]);
            bytes.extend_from_slice(&[0, 1]);
            bytes.extend_from_slice(&[0; 32]);
            bytes.extend_from_slice(&[0, 24, 0xff, 0xff]);
            bytes.extend(boxed(b"avcC", |it| {
                it.push(1);
                it.extend_from_slice(&self.sequence[1..4]);
                // Lengths of four bytes, and one sequence parameter set.
                it.extend_from_slice(&[0xff, 0xe1]);
                it.extend_from_slice(&(self.sequence.len() as u16).to_be_bytes());
                it.extend_from_slice(&self.sequence);
                it.push(1);
                it.extend_from_slice(&(self.parameters.len() as u16).to_be_bytes());
                it.extend_from_slice(&self.parameters);
                if self.sequence[1] >= 100 {
                    // 4:2:0 in eight bits, no further parameter sets.
                    it.extend_from_slice(&[0xfd, 0xf8, 0xf8, 0]);
                }
            }));
            bytes.extend(boxed(b"colr", |it| {
                it.extend_from_slice(b"nclx");
                let matrix = u16::from(colours.matrix);
                // Primaries and transfer get the number of the matrix.
                for value in [matrix, matrix, matrix] {
                    it.extend_from_slice(&value.to_be_bytes());
                }
                it.push(u8::from(colours.full_range) << 7);
            }));
        })
    }
}

/// The matrix without rotation.
const UNROTATED_MATRIX: [u32; 9] = [0x1_0000, 0, 0, 0, 0x1_0000, 0, 0, 0, 0x4000_0000];

fn append_box_words(out: &mut Vec<u8>, words: &[u32]) {
    for word in words {
        out.extend_from_slice(&word.to_be_bytes());
    }
}

/// Returns a box with its content.
fn boxed(kind: &[u8; 4], fill: impl FnOnce(&mut Vec<u8>)) -> Vec<u8> {
    let mut bytes = vec![0; 4];
    bytes.extend_from_slice(kind);
    fill(&mut bytes);
    let size = bytes.len() as u32;
    bytes[..4].copy_from_slice(&size.to_be_bytes());
    bytes
}
