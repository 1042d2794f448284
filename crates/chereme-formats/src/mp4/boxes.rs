//! Boxes of an MP4 file, one by one; no box reaches beyond its parent.

use std::io::{Read, Seek, SeekFrom};

use super::Mp4Error;

/// The most bytes of a box that is read whole.
const MAX_BOX_BYTES: u64 = 256 << 20;
/// The most boxes of a file at its top level.
const MAX_TOP_LEVEL_BOXES: usize = 400_000;

/// The place of a top-level box in a file; its content is read later.
#[derive(Debug, Clone, Copy)]
pub(super) struct BoxPlace {
    pub(super) kind: [u8; 4],
    /// The byte at which it begins.
    pub(super) at: u64,
    /// The bytes at which its content begins and ends.
    pub(super) from: u64,
    pub(super) to: u64,
}

/// Returns the boxes at the top level of a file, and whether the list ends before the file does: at a broken
/// header, a box that is cut short, left-over bytes, or after [`MAX_TOP_LEVEL_BOXES`] boxes.
pub(super) fn top_level_boxes(input: &mut (impl Read + Seek)) -> Result<(Vec<BoxPlace>, bool), Mp4Error> {
    let end = input.seek(SeekFrom::End(0))?;
    let mut places = Vec::new();
    let mut box_start = 0;
    while end - box_start >= 8 && places.len() < MAX_TOP_LEVEL_BOXES {
        input.seek(SeekFrom::Start(box_start))?;
        let mut head = [0; 16];
        input.read_exact(&mut head[..8])?;
        let size = u64::from(u32::from_be_bytes([head[0], head[1], head[2], head[3]]));
        let kind = [head[4], head[5], head[6], head[7]];
        let (header, size) = match size {
            // A size of 0 means to the end of the file, and 1 that a size of 64 bits follows (ISO 14496-12, 4.2).
            0 => (8, end - box_start),
            1 if end - box_start >= 16 => {
                input.read_exact(&mut head[8..])?;
                let wide: [u8; 8] = head[8..].try_into().unwrap_or_default();
                (16, u64::from_be_bytes(wide))
            }
            size => (8, size),
        };
        let to = box_start.checked_add(size).filter(|to| *to <= end);
        if size < header {
            return Ok((places, true));
        }
        places.push(BoxPlace {
            kind,
            at: box_start,
            from: box_start + header,
            // Of a film that is still being written, the last box is cut short and readable all the same.
            to: to.unwrap_or(end),
        });
        let Some(to) = to else {
            return Ok((places, true));
        };
        box_start = to;
    }
    Ok((places, box_start != end))
}

/// Reads the content of a box.
pub(super) fn read_box_content(input: &mut (impl Read + Seek), place: &BoxPlace) -> Result<Vec<u8>, Mp4Error> {
    let size = place.to - place.from;
    if size > MAX_BOX_BYTES {
        return Err(Mp4Error::Limit {
            what: "bytes of a header of the film",
            found: size,
            most: MAX_BOX_BYTES,
        });
    }
    input.seek(SeekFrom::Start(place.from))?;
    let mut bytes = Vec::new();
    input.take(size).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// A box inside bytes that were read.
#[derive(Debug, Clone, Copy)]
pub(super) struct InnerBox<'a> {
    pub(super) kind: [u8; 4],
    /// The byte of the file at which its content begins.
    pub(super) at: u64,
    pub(super) bytes: &'a [u8],
}

impl<'a> InnerBox<'a> {
    /// Returns an error about this box.
    pub(super) fn inner_box_error(&self, problem: &'static str) -> Mp4Error {
        Mp4Error::Box {
            kind: box_kind_letters(self.kind),
            at: self.at,
            problem,
        }
    }

    /// Returns the boxes in its content after the first `skip` bytes, up to the first broken one.
    pub(super) fn child_boxes(self, skip: usize) -> impl Iterator<Item = InnerBox<'a>> {
        let base = self.at;
        let mut child_start = skip.min(self.bytes.len());
        std::iter::from_fn(move || {
            let rest = self.bytes.get(child_start..)?;
            let size = bytes_u32_at(rest, 0)? as usize;
            let kind: [u8; 4] = rest.get(4..8)?.try_into().ok()?;
            let (header, size) = match size {
                0 => (8, rest.len()),
                1 => (16, usize::try_from(bytes_u64_at(rest, 8)?).ok()?),
                size => (8, size),
            };
            let bytes = rest.get(header..size)?;
            let inner = InnerBox {
                kind,
                at: base + (child_start + header) as u64,
                bytes,
            };
            child_start += size;
            Some(inner)
        })
    }

    /// Returns the first box of a kind inside it.
    pub(super) fn find_child_box(self, kind: &[u8; 4]) -> Option<InnerBox<'a>> {
        self.child_boxes(0).find(|child| child.kind == *kind)
    }

    /// Returns the four bytes at a place as a number.
    pub(super) fn box_u32_at(&self, at: usize) -> Result<u32, Mp4Error> {
        bytes_u32_at(self.bytes, at).ok_or_else(|| self.inner_box_error("it is too short"))
    }

    /// Returns the eight bytes at a place as a number.
    pub(super) fn box_u64_at(&self, at: usize) -> Result<u64, Mp4Error> {
        bytes_u64_at(self.bytes, at).ok_or_else(|| self.inner_box_error("it is too short"))
    }

    /// Returns the two bytes at a place as a number.
    pub(super) fn box_u16_at(&self, at: usize) -> Result<u16, Mp4Error> {
        let byte_slice = self.bytes.get(at..at + 2);
        let bytes = byte_slice.and_then(|slice| slice.try_into().ok());
        bytes
            .map(u16::from_be_bytes)
            .ok_or_else(|| self.inner_box_error("it is too short"))
    }

    /// Returns its version, the byte with which most boxes begin.
    pub(super) fn box_version(&self) -> Result<u8, Mp4Error> {
        let first = self.bytes.first().copied();
        first.ok_or_else(|| self.inner_box_error("it is too short"))
    }

    /// Returns the rows of a table with its count at byte `at`; at most as many as the table's bytes hold.
    pub(super) fn box_table_rows(
        &self,
        at: usize,
        width: usize,
    ) -> Result<impl Iterator<Item = &'a [u8]> + use<'a>, Mp4Error> {
        let count = self.box_u32_at(at)? as usize;
        let rest = self.bytes.get(at + 4..).unwrap_or_default();
        Ok(rest.chunks_exact(width).take(count))
    }
}

pub(super) fn bytes_u32_at(bytes: &[u8], at: usize) -> Option<u32> {
    let four = bytes.get(at..at.checked_add(4)?)?;
    Some(u32::from_be_bytes(four.try_into().ok()?))
}

pub(super) fn bytes_u64_at(bytes: &[u8], at: usize) -> Option<u64> {
    let eight = bytes.get(at..at.checked_add(8)?)?;
    Some(u64::from_be_bytes(eight.try_into().ok()?))
}

/// Returns the four letters of a kind as text.
pub(super) fn box_kind_letters(kind: [u8; 4]) -> String {
    let letters = kind.iter().map(|byte| match byte {
        b' '..=b'~' => char::from(*byte),
        _ => '?',
    });
    letters.collect()
}
