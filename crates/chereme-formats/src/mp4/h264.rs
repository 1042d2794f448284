//! Parameter sets of H.264 (ITU-T H.264, 7.3.2.1 and annex E) and pieces of its stream.

use super::{Colours, Error};

/// The content of `avcC`: the width of the lengths of pieces, and the parameter sets.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Configuration {
    /// The number of bytes that hold the length of a piece: 1, 2 or 4.
    pub length: usize,
    /// Sequence and picture parameter sets, in this order.
    pub sets: Vec<Vec<u8>>,
}

/// Facts of a sequence parameter set that players need.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sequence {
    /// `profile_idc`.
    pub profile: u8,
    /// The coding of colours, if the parameter set states it.
    pub colours: Option<Colours>,
    /// Whether pictures may be coded as two fields.
    pub interlaced: bool,
}

const SPS: u8 = 7;
const PPS: u8 = 8;

/// Reads the content of an `avcC` box.
///
/// # Errors
/// [`Error::Parameters`] if it is cut short.
pub fn configuration(bytes: &[u8]) -> Result<Configuration, Error> {
    let short = || Error::Parameters("avcC is cut short");
    let length = usize::from(bytes.get(4).ok_or_else(short)? & 3) + 1;
    let mut sets = Vec::new();
    let mut at = 5;
    for mask in [0x1f, 0xff] {
        let count = bytes.get(at).ok_or_else(short)? & mask;
        at += 1;
        for _ in 0..count {
            let size = bytes.get(at..at + 2).ok_or_else(short)?;
            let size = usize::from(size[0]) << 8 | usize::from(size[1]);
            sets.push(bytes.get(at + 2..at + 2 + size).ok_or_else(short)?.to_vec());
            at += 2 + size;
        }
    }
    Ok(Configuration { length, sets })
}

/// Appends pieces with start codes (Annex B) to `out`: the parameter sets if `sets` is true, and the pieces of a
/// sample, in which each piece follows its length.
///
/// # Errors
/// [`Error::Parameters`] if a length goes beyond the sample.
pub fn annex_b(
    configuration: &Configuration,
    sample: &[u8],
    sets: bool,
    out: &mut Vec<u8>,
) -> Result<(), Error> {
    let mut put = |piece: &[u8]| {
        out.extend_from_slice(&[0, 0, 0, 1]);
        out.extend_from_slice(piece);
    };
    if sets {
        configuration.sets.iter().for_each(|set| put(set));
    }
    let mut rest = sample;
    while !rest.is_empty() {
        let broken = || Error::Parameters("a piece is longer than its sample");
        let head = rest.get(..configuration.length).ok_or_else(broken)?;
        let size = head
            .iter()
            .fold(0, |sum, byte| sum << 8 | usize::from(*byte));
        let to = configuration.length.saturating_add(size);
        put(rest.get(configuration.length..to).ok_or_else(broken)?);
        rest = &rest[to..];
    }
    Ok(())
}

/// Returns the pieces of a stream with start codes.
pub fn pieces(stream: &[u8]) -> impl Iterator<Item = &[u8]> {
    let mut starts = Vec::new();
    let mut at = 0;
    while let Some(found) = memchr::memmem::find(stream.get(at..).unwrap_or_default(), &[0, 0, 1]) {
        starts.push(at + found + 3);
        at += found + 3;
    }
    let ends: Vec<usize> = starts.iter().skip(1).map(|start| start - 3).collect();
    let ends = ends.into_iter().chain([stream.len()]);
    starts.into_iter().zip(ends).map(|(start, end)| {
        let piece = &stream[start..end];
        let zeros = piece.iter().rev().take_while(|byte| **byte == 0).count();
        &piece[..piece.len() - zeros]
    })
}

/// Returns whether a piece is a sequence parameter set.
#[must_use]
pub fn is_sequence(piece: &[u8]) -> bool {
    piece.first().is_some_and(|first| first & 31 == SPS)
}

/// Returns whether a piece is a picture parameter set.
#[must_use]
pub fn is_parameters(piece: &[u8]) -> bool {
    piece.first().is_some_and(|first| first & 31 == PPS)
}

/// Returns whether a piece is part of a picture with which decoding can begin.
#[must_use]
pub fn is_refresh(piece: &[u8]) -> bool {
    piece.first().is_some_and(|first| first & 31 == 5)
}

/// Reads a sequence parameter set up to its colours.
///
/// # Errors
/// [`Error::Parameters`] if it is cut short or nonsense.
pub fn sequence(piece: &[u8]) -> Result<Sequence, Error> {
    let mut bits = Bits::of(piece.get(1..).unwrap_or_default());
    let profile = bits.number(8)? as u8;
    bits.number(16)?;
    bits.code()?;
    if [100, 110, 122, 244, 44, 83, 86, 118, 128, 138, 139, 134, 135].contains(&profile) {
        let chroma = bits.code()?;
        if chroma == 3 {
            bits.number(1)?;
        }
        bits.code()?;
        bits.code()?;
        bits.number(1)?;
        if bits.number(1)? == 1 {
            for list in 0..if chroma == 3 { 12 } else { 8 } {
                if bits.number(1)? == 1 {
                    bits.scaling(if list < 6 { 16 } else { 64 })?;
                }
            }
        }
    }
    bits.code()?;
    match bits.code()? {
        0 => {
            bits.code()?;
        }
        1 => {
            bits.number(1)?;
            bits.code()?;
            bits.code()?;
            let cycle = bits.code()?;
            if cycle > 255 {
                return Err(Error::Parameters("a cycle of more than 255 pictures"));
            }
            for _ in 0..cycle {
                bits.code()?;
            }
        }
        _ => {}
    }
    bits.code()?;
    bits.number(1)?;
    bits.code()?;
    bits.code()?;
    let interlaced = bits.number(1)? == 0;
    if interlaced {
        bits.number(1)?;
    }
    bits.number(1)?;
    if bits.number(1)? == 1 {
        for _ in 0..4 {
            bits.code()?;
        }
    }
    let mut colours = None;
    if bits.number(1)? == 1 {
        if bits.number(1)? == 1 && bits.number(8)? == 255 {
            bits.number(32)?;
        }
        if bits.number(1)? == 1 {
            bits.number(1)?;
        }
        if bits.number(1)? == 1 {
            bits.number(3)?;
            let full_range = bits.number(1)? == 1;
            // 2 is "unspecified".
            let mut matrix = 2;
            if bits.number(1)? == 1 {
                bits.number(16)?;
                matrix = bits.number(8)? as u8;
            }
            colours = Some(Colours { matrix, full_range });
        }
    }
    Ok(Sequence {
        profile,
        colours,
        interlaced,
    })
}

/// The bits of a piece, without the bytes that prevent false start codes.
struct Bits {
    bytes: Vec<u8>,
    at: usize,
}

impl Bits {
    fn of(piece: &[u8]) -> Self {
        let mut bytes = Vec::with_capacity(piece.len().min(1024));
        let mut zeros = 0;
        for byte in piece.iter().take(1024) {
            if zeros >= 2 && *byte == 3 {
                zeros = 0;
                continue;
            }
            zeros = if *byte == 0 { zeros + 1 } else { 0 };
            bytes.push(*byte);
        }
        Self { bytes, at: 0 }
    }

    fn number(&mut self, count: u32) -> Result<u32, Error> {
        let mut value = 0;
        for _ in 0..count {
            let byte = self.bytes.get(self.at / 8);
            let byte = byte.ok_or(Error::Parameters("the sequence is cut short"))?;
            value = value << 1 | u32::from(byte >> (7 - self.at % 8) & 1);
            self.at += 1;
        }
        Ok(value)
    }

    /// Reads an Exp-Golomb code; signed codes have the same length.
    fn code(&mut self) -> Result<u32, Error> {
        let mut zeros = 0;
        while self.number(1)? == 0 {
            zeros += 1;
            if zeros > 31 {
                return Err(Error::Parameters("a number of more than 32 bits"));
            }
        }
        Ok((1_u32 << zeros) - 1 + self.number(zeros)?)
    }

    /// Skips a scaling list.
    fn scaling(&mut self, size: u32) -> Result<(), Error> {
        let (mut last, mut next) = (8_i64, 8_i64);
        for _ in 0..size {
            if next != 0 {
                let code = i64::from(self.code()?);
                let delta = if code % 2 == 1 {
                    (code + 1) / 2
                } else {
                    -code / 2
                };
                next = (last + delta + 256).rem_euclid(256);
            }
            last = if next == 0 { last } else { next };
        }
        Ok(())
    }
}
