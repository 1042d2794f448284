//! Parameter sets of H.264 (ITU-T H.264, 7.3.2.1 and annex E) and pieces of its stream.

use super::{Mp4Error, PictureColours};

/// The content of `avcC`: the width of the lengths of pieces, and the parameter sets.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AvcConfiguration {
    /// The number of bytes that hold the length of a piece: 1, 2 or 4.
    pub length: usize,
    /// Sequence and picture parameter sets, in this order.
    pub sets: Vec<Vec<u8>>,
}

/// Facts of a sequence parameter set that players need.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SequenceParameterSet {
    /// `profile_idc`.
    pub profile: u8,
    /// The coding of colours, if the parameter set states it.
    pub colours: Option<PictureColours>,
    /// Whether pictures may be coded as two fields.
    pub interlaced: bool,
}

const SPS_PIECE_TYPE: u8 = 7;
const PPS_PIECE_TYPE: u8 = 8;

/// Reads the content of an `avcC` box.
///
/// # Errors
/// [`Mp4Error::Parameters`] if it is cut short.
pub fn read_avc_configuration(bytes: &[u8]) -> Result<AvcConfiguration, Mp4Error> {
    let short = || Mp4Error::Parameters("avcC is cut short");
    let length = usize::from(bytes.get(4).ok_or_else(short)? & 3) + 1;
    let mut sets = Vec::new();
    let mut set_start = 5;
    // Five bits count sequence parameter sets, eight count picture parameter sets.
    for mask in [0x1f, 0xff] {
        let count = bytes.get(set_start).ok_or_else(short)? & mask;
        set_start += 1;
        for _ in 0..count {
            let size_bytes = bytes.get(set_start..set_start + 2).ok_or_else(short)?;
            let size = usize::from(size_bytes[0]) << 8 | usize::from(size_bytes[1]);
            sets.push(
                bytes
                    .get(set_start + 2..set_start + 2 + size)
                    .ok_or_else(short)?
                    .to_vec(),
            );
            set_start += 2 + size;
        }
    }
    Ok(AvcConfiguration { length, sets })
}

/// Appends pieces with start codes (Annex B) to `out`: the parameter sets if `sets` is true, and the pieces of a
/// sample, in which each piece follows its length.
///
/// # Errors
/// [`Mp4Error::Parameters`] if a length goes beyond the sample.
pub fn annex_b(configuration: &AvcConfiguration, sample: &[u8], sets: bool, out: &mut Vec<u8>) -> Result<(), Mp4Error> {
    let mut put = |piece: &[u8]| {
        out.extend_from_slice(&[0, 0, 0, 1]);
        out.extend_from_slice(piece);
    };
    if sets {
        configuration.sets.iter().for_each(|set| put(set));
    }
    let mut rest = sample;
    while !rest.is_empty() {
        let broken = || Mp4Error::Parameters("a piece is longer than its sample");
        let head = rest.get(..configuration.length).ok_or_else(broken)?;
        let size = head.iter().fold(0, |sum, byte| sum << 8 | usize::from(*byte));
        let to = configuration.length.saturating_add(size);
        put(rest.get(configuration.length..to).ok_or_else(broken)?);
        rest = &rest[to..];
    }
    Ok(())
}

/// Returns the pieces of a stream with start codes.
pub fn split_stream_pieces(stream: &[u8]) -> impl Iterator<Item = &[u8]> {
    let mut starts = Vec::new();
    let mut search_start = 0;
    while let Some(found) = memchr::memmem::find(stream.get(search_start..).unwrap_or_default(), &[0, 0, 1]) {
        starts.push(search_start + found + 3);
        search_start += found + 3;
    }
    let piece_ends: Vec<usize> = starts.iter().skip(1).map(|start| start - 3).collect();
    let ends = piece_ends.into_iter().chain([stream.len()]);
    starts.into_iter().zip(ends).map(|(start, end)| {
        let piece = &stream[start..end];
        // Zeros before a start code belong to no piece.
        let zeros = piece.iter().rev().take_while(|byte| **byte == 0).count();
        &piece[..piece.len() - zeros]
    })
}

/// Returns whether a piece is a sequence parameter set.
#[must_use]
pub fn is_sequence(piece: &[u8]) -> bool {
    piece.first().is_some_and(|first| first & 31 == SPS_PIECE_TYPE)
}

/// Returns whether a piece is a picture parameter set.
#[must_use]
pub fn is_parameters(piece: &[u8]) -> bool {
    piece.first().is_some_and(|first| first & 31 == PPS_PIECE_TYPE)
}

/// Returns whether a piece is part of a picture with which decoding can begin.
#[must_use]
pub fn is_refresh(piece: &[u8]) -> bool {
    piece.first().is_some_and(|first| first & 31 == 5)
}

/// Reads a sequence parameter set up to its colours.
///
/// # Errors
/// [`Mp4Error::Parameters`] if it is cut short or nonsense.
pub fn read_sequence_parameters(piece: &[u8]) -> Result<SequenceParameterSet, Mp4Error> {
    let mut bits = PieceBits::bits_from_piece(piece.get(1..).unwrap_or_default());
    let profile = bits.read_bit_number(8)? as u8;
    // Flags of constraints and the level; then the number of the set.
    bits.read_bit_number(16)?;
    bits.read_exp_golomb()?;
    // These profiles state their format of colours (ITU-T H.264, 7.3.2.1.1).
    if [100, 110, 122, 244, 44, 83, 86, 118, 128, 138, 139, 134, 135].contains(&profile) {
        let chroma = bits.read_exp_golomb()?;
        if chroma == 3 {
            bits.read_bit_number(1)?;
        }
        bits.read_exp_golomb()?;
        bits.read_exp_golomb()?;
        bits.read_bit_number(1)?;
        if bits.read_bit_number(1)? == 1 {
            for list in 0..if chroma == 3 { 12 } else { 8 } {
                if bits.read_bit_number(1)? == 1 {
                    bits.scaling(if list < 6 { 16 } else { 64 })?;
                }
            }
        }
    }
    bits.read_exp_golomb()?;
    match bits.read_exp_golomb()? {
        0 => {
            bits.read_exp_golomb()?;
        }
        1 => {
            bits.read_bit_number(1)?;
            bits.read_exp_golomb()?;
            bits.read_exp_golomb()?;
            let cycle = bits.read_exp_golomb()?;
            if cycle > 255 {
                return Err(Mp4Error::Parameters("a cycle of more than 255 pictures"));
            }
            for _ in 0..cycle {
                bits.read_exp_golomb()?;
            }
        }
        _ => {}
    }
    bits.read_exp_golomb()?;
    bits.read_bit_number(1)?;
    bits.read_exp_golomb()?;
    bits.read_exp_golomb()?;
    let interlaced = bits.read_bit_number(1)? == 0;
    if interlaced {
        bits.read_bit_number(1)?;
    }
    bits.read_bit_number(1)?;
    if bits.read_bit_number(1)? == 1 {
        for _ in 0..4 {
            bits.read_exp_golomb()?;
        }
    }
    let mut colours = None;
    if bits.read_bit_number(1)? == 1 {
        // Of the shapes of a pixel, 255 is one whose sides follow in full.
        if bits.read_bit_number(1)? == 1 && bits.read_bit_number(8)? == 255 {
            bits.read_bit_number(32)?;
        }
        if bits.read_bit_number(1)? == 1 {
            bits.read_bit_number(1)?;
        }
        if bits.read_bit_number(1)? == 1 {
            bits.read_bit_number(3)?;
            let full_range = bits.read_bit_number(1)? == 1;
            // 2 is "unspecified".
            let mut matrix = 2;
            if bits.read_bit_number(1)? == 1 {
                bits.read_bit_number(16)?;
                matrix = bits.read_bit_number(8)? as u8;
            }
            colours = Some(PictureColours { matrix, full_range });
        }
    }
    Ok(SequenceParameterSet {
        profile,
        colours,
        interlaced,
    })
}

/// The bits of a piece, without the bytes that prevent false start codes.
struct PieceBits {
    bytes: Vec<u8>,
    at: usize,
}

impl PieceBits {
    fn bits_from_piece(piece: &[u8]) -> Self {
        let mut bytes = Vec::with_capacity(piece.len().min(1024));
        let mut zeros = 0;
        for byte in piece.iter().take(1024) {
            // A 3 after two zeros only keeps what follows from looking like a start code.
            if zeros >= 2 && *byte == 3 {
                zeros = 0;
                continue;
            }
            zeros = if *byte == 0 { zeros + 1 } else { 0 };
            bytes.push(*byte);
        }
        Self { bytes, at: 0 }
    }

    fn read_bit_number(&mut self, count: u32) -> Result<u32, Mp4Error> {
        let mut value = 0;
        for _ in 0..count {
            let next_byte = self.bytes.get(self.at / 8);
            let byte = next_byte.ok_or(Mp4Error::Parameters("the sequence is cut short"))?;
            value = value << 1 | u32::from(byte >> (7 - self.at % 8) & 1);
            self.at += 1;
        }
        Ok(value)
    }

    /// Reads an Exp-Golomb code; signed codes have the same length.
    fn read_exp_golomb(&mut self) -> Result<u32, Mp4Error> {
        let mut zeros = 0;
        while self.read_bit_number(1)? == 0 {
            zeros += 1;
            if zeros > 31 {
                return Err(Mp4Error::Parameters("a number of more than 32 bits"));
            }
        }
        Ok((1_u32 << zeros) - 1 + self.read_bit_number(zeros)?)
    }

    /// Skips a scaling list.
    fn scaling(&mut self, size: u32) -> Result<(), Mp4Error> {
        let (mut last, mut next) = (8_i64, 8_i64);
        for _ in 0..size {
            if next != 0 {
                let code = i64::from(self.read_exp_golomb()?);
                let delta = if code % 2 == 1 { (code + 1) / 2 } else { -code / 2 };
                next = (last + delta + 256).rem_euclid(256);
            }
            last = if next == 0 { last } else { next };
        }
        Ok(())
    }
}
