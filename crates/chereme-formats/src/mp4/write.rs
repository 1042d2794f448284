//! Writes films of H.264 pictures.

use std::io::Write;

use super::{Colours, Error, h264};

/// Ticks per second in written films; a picture at 25, 30, 50, 60, 100 or 120 per second lasts whole ticks.
const TIMESCALE: u32 = 90_000;
/// Ticks per second in the header of the movie, which holds its length.
const MOVIE: u32 = 1000;
/// The most bytes of coded pictures.
const LARGEST: usize = 2_000_000_000;

/// Properties of a film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Picture {
    /// Width in pixels.
    pub width: u16,
    /// Height in pixels.
    pub height: u16,
    /// A number of pictures, and the seconds in which so many are shown.
    pub rate: (u32, u32),
    /// The mapping from numbers to colours.
    pub colours: Colours,
}

/// A film under construction, picture by picture. Coded pictures stay in memory, so that the file can begin with the
/// index and a film plays while it is being downloaded.
#[derive(Debug)]
pub struct Muxer {
    picture: Picture,
    samples: Vec<u8>,
    sizes: Vec<u32>,
    sync: Vec<u32>,
    sequence: Vec<u8>,
    parameters: Vec<u8>,
}

impl Muxer {
    /// Begins a film.
    #[must_use]
    pub fn new(picture: Picture) -> Self {
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
    pub fn add(&mut self, stream: &[u8]) {
        let before = self.samples.len();
        let mut sync = false;
        for piece in h264::pieces(stream).filter(|piece| !piece.is_empty()) {
            if h264::is_sequence(piece) {
                self.sequence = piece.to_vec();
            } else if h264::is_parameters(piece) {
                self.parameters = piece.to_vec();
            } else {
                sync |= h264::is_refresh(piece);
                let length = (piece.len() as u32).to_be_bytes();
                self.samples.extend_from_slice(&length);
                self.samples.extend_from_slice(piece);
            }
        }
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
    pub fn pictures(&self) -> usize {
        self.sizes.len()
    }

    /// Writes the film.
    ///
    /// # Errors
    /// [`Error::Parameters`] if no picture came with parameter sets, [`Error::Limit`] above two gigabytes,
    /// [`Error::Input`] if `out` cannot be written.
    pub fn write(&self, mut out: impl Write) -> Result<(), Error> {
        if self.sequence.len() < 4 || self.parameters.is_empty() {
            return Err(Error::Parameters("no picture came with parameter sets"));
        }
        if self.samples.len() > LARGEST {
            return Err(Error::Limit {
                what: "bytes of a film",
                found: self.samples.len() as u64,
                most: LARGEST as u64,
            });
        }
        let kind = boxed(b"ftyp", |it| {
            it.extend_from_slice(b"isom\0\0\x02\0isomiso2avc1mp41");
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
    fn ticks(&self) -> u32 {
        let (frames, seconds) = self.picture.rate;
        let ticks = u64::from(TIMESCALE) * u64::from(seconds) / u64::from(frames.max(1));
        u32::try_from(ticks.max(1)).unwrap_or(u32::MAX)
    }

    /// Returns the index of a film whose first picture lies at byte `start`.
    fn movie(&self, start: u32) -> Vec<u8> {
        let Picture { width, height, .. } = self.picture;
        let count = self.sizes.len() as u32;
        let ticks = u64::from(self.ticks()) * u64::from(count);
        let length = (ticks * u64::from(MOVIE)).div_ceil(u64::from(TIMESCALE)) as u32;
        boxed(b"moov", |it| {
            it.extend(boxed(b"mvhd", |it| {
                words(it, &[0, 0, 0, MOVIE, length, 0x1_0000, 0x100_0000, 0, 0]);
                words(it, &STRAIGHT);
                words(it, &[0, 0, 0, 0, 0, 0, 2]);
            }));
            it.extend(boxed(b"trak", |it| {
                it.extend(boxed(b"tkhd", |it| {
                    words(it, &[7, 0, 0, 1, 0, length, 0, 0, 0, 0]);
                    words(it, &STRAIGHT);
                    words(it, &[u32::from(width) << 16, u32::from(height) << 16]);
                }));
                it.extend(boxed(b"mdia", |it| {
                    it.extend(boxed(b"mdhd", |it| {
                        // The language is "undetermined".
                        words(it, &[0, 0, 0, TIMESCALE, ticks as u32, 0x55c4_0000]);
                    }));
                    it.extend(boxed(b"hdlr", |it| {
                        words(it, &[0, 0]);
                        it.extend_from_slice(b"vide");
                        words(it, &[0, 0, 0]);
                        it.extend_from_slice(b"film\0");
                    }));
                    it.extend(boxed(b"minf", |it| {
                        it.extend(boxed(b"vmhd", |it| words(it, &[1, 0, 0])));
                        it.extend(boxed(b"dinf", |it| {
                            it.extend(boxed(b"dref", |it| {
                                words(it, &[0, 1]);
                                it.extend(boxed(b"url ", |it| words(it, &[1])));
                            }));
                        }));
                        it.extend(self.table(count, start));
                    }));
                }));
            }));
        })
    }

    fn table(&self, count: u32, start: u32) -> Vec<u8> {
        boxed(b"stbl", |it| {
            it.extend(boxed(b"stsd", |it| {
                words(it, &[0, 1]);
                it.extend(self.entry());
            }));
            it.extend(boxed(b"stts", |it| words(it, &[0, 1, count, self.ticks()])));
            it.extend(boxed(b"stss", |it| {
                words(it, &[0, self.sync.len() as u32]);
                words(it, &self.sync);
            }));
            it.extend(boxed(b"stsc", |it| words(it, &[0, 1, 1, count, 1])));
            it.extend(boxed(b"stsz", |it| {
                words(it, &[0, 0, count]);
                words(it, &self.sizes);
            }));
            it.extend(boxed(b"stco", |it| words(it, &[0, 1, start])));
        })
    }

    fn entry(&self) -> Vec<u8> {
        let Picture {
            width,
            height,
            colours,
            ..
        } = self.picture;
        boxed(b"avc1", |it| {
            it.extend_from_slice(&[0, 0, 0, 0, 0, 0, 0, 1]);
            words(it, &[0, 0, 0, 0]);
            it.extend_from_slice(&width.to_be_bytes());
            it.extend_from_slice(&height.to_be_bytes());
            // 72 dots per inch, one picture in each sample, a name of 32 bytes, 24 bits.
            words(it, &[0x48_0000, 0x48_0000, 0]);
            it.extend_from_slice(&[0, 1]);
            it.extend_from_slice(&[0; 32]);
            it.extend_from_slice(&[0, 24, 0xff, 0xff]);
            it.extend(boxed(b"avcC", |it| {
                it.push(1);
                it.extend_from_slice(&self.sequence[1..4]);
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
            it.extend(boxed(b"colr", |it| {
                it.extend_from_slice(b"nclx");
                let matrix = u16::from(colours.matrix);
                for value in [matrix, matrix, matrix] {
                    it.extend_from_slice(&value.to_be_bytes());
                }
                it.push(u8::from(colours.full_range) << 7);
            }));
        })
    }
}

/// The matrix without rotation.
const STRAIGHT: [u32; 9] = [0x1_0000, 0, 0, 0, 0x1_0000, 0, 0, 0, 0x4000_0000];

fn words(out: &mut Vec<u8>, words: &[u32]) {
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
