//! Blocks of motion as bytes: the columns of one channel group over some frames, without loss.
//!
//! A block is the byte 1, the frames and the columns (u32 each, little-endian), then each column:
//! its decimals (u8), its coding (0 all equal, 1 pco), the length of its code (u32), the code, and
//! its exceptions (u32 how many; each a frame u32, a length u32 and the number's own text). Coded
//! are the mantissas: the number is mantissa / 10^decimals.

use chereme_formats::bvh::raw::Column;
use pco::ChunkConfig;
use pco::standalone::{simple_compress, simple_decompress_into};

const VERSION: u8 = 1;
const CONSTANT: u8 = 0;
const PCO: u8 = 1;

/// Returns the bytes of columns of `frames` numbers each.
///
/// # Panics
/// Where a column is longer or shorter.
pub(crate) fn encode(frames: usize, columns: &[&Column]) -> Vec<u8> {
    let config = ChunkConfig::default();
    let mut bytes = vec![VERSION];
    put(&mut bytes, frames);
    put(&mut bytes, columns.len());
    for column in columns {
        assert_eq!(
            column.mantissas.len(),
            frames,
            "a block's columns are equally long"
        );
        bytes.push(column.scale);
        let first = column.mantissas.first().copied().unwrap_or_default();
        let (coding, code) = if column.mantissas.iter().all(|&mantissa| mantissa == first) {
            (CONSTANT, first.to_le_bytes().to_vec())
        } else {
            let code = simple_compress(&column.mantissas, &config);
            (
                PCO,
                code.expect("the default configuration codes any integers"),
            )
        };
        bytes.push(coding);
        put(&mut bytes, code.len());
        bytes.extend_from_slice(&code);
        put(&mut bytes, column.exceptions.len());
        for (frame, number) in &column.exceptions {
            let text = number.to_string();
            bytes.extend_from_slice(&frame.to_le_bytes());
            put(&mut bytes, text.len());
            bytes.extend_from_slice(text.as_bytes());
        }
    }
    bytes
}

fn put(bytes: &mut Vec<u8>, number: usize) {
    let number = u32::try_from(number).expect("a block is far smaller than 4 GiB");
    bytes.extend_from_slice(&number.to_le_bytes());
}

/// Returns the columns that `bytes` hold, if they are `count` columns of `frames` numbers.
pub(crate) fn decode(bytes: &[u8], frames: usize, count: usize) -> Result<Vec<Column>, String> {
    let mut rest = bytes;
    let [version] = take::<1>(&mut rest)?;
    if version != VERSION {
        return Err(format!(
            "its version is {version}, and this program reads {VERSION}"
        ));
    }
    let (found_frames, found_count) = (take_u32(&mut rest)?, take_u32(&mut rest)?);
    if (found_frames, found_count) != (frames, count) {
        return Err(format!(
            "it holds {found_count} columns of {found_frames} frames, not {count} of {frames}"
        ));
    }
    let mut columns = Vec::with_capacity(count.min(bytes.len()));
    for _ in 0..count {
        columns.push(decode_column(&mut rest, frames)?);
    }
    if rest.is_empty() {
        Ok(columns)
    } else {
        Err("bytes follow its last column".into())
    }
}

fn decode_column(rest: &mut &[u8], frames: usize) -> Result<Column, String> {
    let [scale, coding] = take::<2>(rest)?;
    let length = take_u32(rest)?;
    let code = take_slice(rest, length)?;
    let mantissas = match coding {
        CONSTANT => {
            let value = code.try_into().map_err(|_| "a constant is eight bytes")?;
            vec![i64::from_le_bytes(value); frames]
        }
        PCO => {
            let mut mantissas = vec![0i64; frames];
            let progress =
                simple_decompress_into(code, &mut mantissas).map_err(|error| error.to_string())?;
            if progress.n_processed != frames {
                return Err(format!("a column has {} numbers", progress.n_processed));
            }
            mantissas
        }
        other => return Err(format!("the coding {other} is unknown")),
    };
    let mut exceptions = Vec::new();
    for _ in 0..take_u32(rest)? {
        let frame = u32::from_le_bytes(take::<4>(rest)?);
        let length = take_u32(rest)?;
        let text = std::str::from_utf8(take_slice(rest, length)?).map_err(|e| e.to_string())?;
        if frame as usize >= frames {
            return Err(format!("an exception is about frame {frame}"));
        }
        let number = text
            .parse()
            .map_err(|_| format!("the exception {text:?} is no number"))?;
        exceptions.push((frame, number));
    }
    Ok(Column {
        scale,
        mantissas,
        exceptions,
    })
}

fn take_slice<'a>(rest: &mut &'a [u8], length: usize) -> Result<&'a [u8], String> {
    let (slice, after) = rest.split_at_checked(length).ok_or("it is cut short")?;
    *rest = after;
    Ok(slice)
}

fn take<const N: usize>(rest: &mut &[u8]) -> Result<[u8; N], String> {
    take_slice(rest, N)?
        .try_into()
        .map_err(|_| "it is cut short".to_owned())
}

fn take_u32(rest: &mut &[u8]) -> Result<usize, String> {
    Ok(u32::from_le_bytes(take::<4>(rest)?) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns() -> Vec<Column> {
        vec![
            Column {
                scale: 6,
                mantissas: (0..100).map(|i| i * i * 37 - 999_999).collect(),
                exceptions: vec![],
            },
            Column {
                scale: 0,
                mantissas: vec![-7; 100],
                exceptions: vec![(3, "1e300".parse().expect("a number"))],
            },
            Column {
                scale: 18,
                mantissas: (0..100)
                    .map(|i| if i % 2 == 0 { i64::MIN } else { i64::MAX })
                    .collect(),
                exceptions: vec![],
            },
        ]
    }

    #[test]
    fn blocks_come_back_as_they_were_and_damage_is_named() {
        let columns = columns();
        let bytes = encode(100, &columns.iter().collect::<Vec<_>>());
        let back = decode(&bytes, 100, 3).expect("whole");
        for (a, b) in columns.iter().zip(&back) {
            assert_eq!(
                (a.scale, &a.mantissas, &a.exceptions),
                (b.scale, &b.mantissas, &b.exceptions)
            );
        }
        assert!(decode(&bytes, 99, 3).is_err_and(|e| e.contains("3 columns of 100 frames")));
        for length in 0..bytes.len() {
            assert!(decode(&bytes[..length], 100, 3).is_err(), "{length} bytes");
        }
        for at in 0..bytes.len() {
            let mut broken = bytes.clone();
            broken[at] ^= 0x55;
            let _ = decode(&broken, 100, 3);
        }
    }

    #[test]
    fn a_block_of_no_frames_or_no_columns_is_a_block() {
        assert!(decode(&encode(0, &[]), 0, 0).is_ok_and(|columns| columns.is_empty()));
    }
}
