//! Lossless coding of blocks of numbers as bytes: the columns of one channel group over some frames.
//!
//! Two layouts exist. Version 1 holds decimals without gaps, as movement in text files has them: the byte 1, the number
//! of frames and of columns (u32 each, little-endian), then each column: its decimals (u8), its coding (0 all equal, 1
//! pco), the length of its code (u32), the code, and its exceptions (u32 their number; each a frame u32, a length u32
//! and the number's own text). The code holds the mantissas: the number is mantissa / 10^decimals.
//!
//! Version 2 holds numbers of any form, with gaps. Each column begins with its form (u8): 0 decimals (then u8
//! decimals), 1 f32, 2 f64, 3 integers (then zero and unit, f64 each), 4 f64 numbers that can all be stored exactly as
//! f32. Coding, length and code follow as in version 1, for decimals the exceptions, and then the gaps (u32 their
//! number; each the first frame u32 and the first frame after it u32).

use std::ops::Range;

use chereme_motion::FrameNumberColumn;
use chereme_motion::column::{ColumnGaps, ColumnNumbers, DecimalColumn, FileNumber, ScaledIntegers};
use pco::ChunkConfig;
use pco::data_types::Number as Coded;
use pco::standalone::{simple_compress, simple_decompress_into};

const DECIMALS_ONLY: u8 = 1;
const ANY_FORM: u8 = 2;

const CONSTANT_COLUMN_CODE: u8 = 0;
const PCO_COLUMN_CODE: u8 = 1;

/// The forms of columns in version 2.
mod form {
    pub(super) const DECIMAL_COLUMN_KIND: u8 = 0;
    pub(super) const SINGLE_COLUMN_KIND: u8 = 1;
    pub(super) const DOUBLE_COLUMN_KIND: u8 = 2;
    pub(super) const INTEGER_COLUMN_KIND: u8 = 3;
    pub(super) const SHORT_DOUBLES: u8 = 4;
}

/// Returns the bytes of columns of decimals without gaps, of `frames` numbers each.
///
/// # Panics
/// Panics if a column is longer or shorter.
pub(crate) fn encode_decimal_columns(frames: usize, columns: &[&DecimalColumn]) -> Vec<u8> {
    let mut bytes = begin_block_bytes(DECIMALS_ONLY, frames, columns.len());
    for column in columns {
        check_length(column.mantissas.len(), frames);
        put_decimals(&mut bytes, column);
    }
    bytes
}

/// Returns the bytes of columns of any form, of `frames` numbers each; decimals without gaps get the bytes that
/// [`encode_decimal_columns`] gives them.
///
/// # Panics
/// Panics if a column is longer or shorter.
pub(crate) fn encode_any(frames: usize, columns: &[FrameNumberColumn]) -> Vec<u8> {
    let plain = columns.iter().map(|column| match column.column_numbers() {
        ColumnNumbers::Decimals(decimals) if column.column_gaps().is_empty() => Some(decimals),
        _ => None,
    });
    // Blocks of text files keep the bytes that earlier versions gave them, and so their names.
    if let Some(decimals) = plain.collect::<Option<Vec<&DecimalColumn>>>() {
        return encode_decimal_columns(frames, &decimals);
    }
    let mut bytes = begin_block_bytes(ANY_FORM, frames, columns.len());
    for column in columns {
        check_length(column.len(), frames);
        match column.column_numbers() {
            ColumnNumbers::Decimals(decimals) => {
                bytes.push(form::DECIMAL_COLUMN_KIND);
                put_decimals(&mut bytes, decimals);
            }
            ColumnNumbers::Singles(values) => {
                bytes.push(form::SINGLE_COLUMN_KIND);
                put_code(&mut bytes, values);
            }
            ColumnNumbers::Doubles(values) => put_doubles(&mut bytes, values),
            ColumnNumbers::Integers(ScaledIntegers { values, zero, unit }) => {
                bytes.push(form::INTEGER_COLUMN_KIND);
                bytes.extend_from_slice(&zero.to_le_bytes());
                bytes.extend_from_slice(&unit.to_le_bytes());
                put_code(&mut bytes, values);
            }
        }
        put_block_count(&mut bytes, column.column_gaps().gap_runs().len());
        for run in column.column_gaps().gap_runs() {
            bytes.extend_from_slice(&run.start.to_le_bytes());
            bytes.extend_from_slice(&run.end.to_le_bytes());
        }
    }
    bytes
}

fn begin_block_bytes(version: u8, frames: usize, columns: usize) -> Vec<u8> {
    let mut bytes = vec![version];
    put_block_count(&mut bytes, frames);
    put_block_count(&mut bytes, columns);
    bytes
}

fn check_length(length: usize, frames: usize) {
    assert_eq!(length, frames, "a block's columns are equally long");
}

fn put_block_count(bytes: &mut Vec<u8>, number: usize) {
    let number = u32::try_from(number).expect("a block is far smaller than 4 GiB");
    bytes.extend_from_slice(&number.to_le_bytes());
}

fn put_decimals(bytes: &mut Vec<u8>, column: &DecimalColumn) {
    bytes.push(column.scale);
    put_code(bytes, &column.mantissas);
    put_block_count(bytes, column.exceptions.len());
    for (frame, number) in &column.exceptions {
        let text = number.to_string();
        bytes.extend_from_slice(&frame.to_le_bytes());
        put_block_count(bytes, text.len());
        bytes.extend_from_slice(text.as_bytes());
    }
}

fn put_doubles(bytes: &mut Vec<u8>, values: &[f64]) {
    let short: Vec<f32> = values.iter().map(|value| *value as f32).collect();
    // Bits are compared, as -0 equals 0 and no number equals itself.
    let same = |(long, short): (&f64, &f32)| f64::from(*short).to_bits() == long.to_bits();
    if values.iter().zip(&short).all(same) {
        bytes.push(form::SHORT_DOUBLES);
        put_code(bytes, &short);
    } else {
        bytes.push(form::DOUBLE_COLUMN_KIND);
        put_code(bytes, values);
    }
}

/// A number that can be coded: its bytes distinguish it from every other, so that a zero keeps its sign.
trait PlainNumber: Coded + Default {
    fn to_plain_bytes(self) -> Vec<u8>;
    fn from_plain_bytes(bytes: &[u8]) -> Option<Self>;
}

macro_rules! plain {
    ($($kind:ty),*) => {$(
        impl PlainNumber for $kind {
            fn to_plain_bytes(self) -> Vec<u8> {
                self.to_le_bytes().to_vec()
            }
            fn from_plain_bytes(bytes: &[u8]) -> Option<Self> {
                Some(Self::from_le_bytes(bytes.try_into().ok()?))
            }
        }
    )*};
}

plain!(i64, i32, f32, f64);

fn put_code<T: PlainNumber>(bytes: &mut Vec<u8>, values: &[T]) {
    let first = values.first().copied().unwrap_or_default().to_plain_bytes();
    // A joint that never turns is common, and one number stands for its column.
    let (coding, code) = if values.iter().all(|value| value.to_plain_bytes() == first) {
        (CONSTANT_COLUMN_CODE, first)
    } else {
        let code = simple_compress(values, &ChunkConfig::default());
        (
            PCO_COLUMN_CODE,
            code.expect("the default configuration codes any numbers"),
        )
    };
    bytes.push(coding);
    put_block_count(bytes, code.len());
    bytes.extend_from_slice(&code);
}

/// Decodes `bytes` as `count` columns of `frames` numbers.
pub(crate) fn decode_block_columns(
    bytes: &[u8],
    frames: usize,
    count: usize,
) -> Result<Vec<FrameNumberColumn>, String> {
    let mut rest = bytes;
    match read_block_start(&mut rest, frames, count)? {
        DECIMALS_ONLY => read_all_columns(rest, count, |rest| {
            take_decimals(rest, frames).map(FrameNumberColumn::from)
        }),
        _ => read_all_columns(rest, count, |rest| take_column(rest, frames)),
    }
}

/// Reads the beginning of a block, and returns its version.
fn read_block_start(rest: &mut &[u8], frames: usize, count: usize) -> Result<u8, String> {
    let [version] = take_byte_array::<1>(rest)?;
    if ![DECIMALS_ONLY, ANY_FORM].contains(&version) {
        return Err(format!(
            "its version is {version}, and this program reads {DECIMALS_ONLY} and {ANY_FORM}"
        ));
    }
    let (found_frames, found_count) = (take_u32(rest)?, take_u32(rest)?);
    if (found_frames, found_count) != (frames, count) {
        return Err(format!(
            "it holds {found_count} columns of {found_frames} frames, not {count} of {frames}"
        ));
    }
    Ok(version)
}

fn read_all_columns<T>(
    mut rest: &[u8],
    count: usize,
    column: impl Fn(&mut &[u8]) -> Result<T, String>,
) -> Result<Vec<T>, String> {
    // A damaged count must not reserve more memory than the block has bytes.
    let mut columns = Vec::with_capacity(count.min(rest.len()));
    for _ in 0..count {
        columns.push(column(&mut rest)?);
    }
    if rest.is_empty() {
        Ok(columns)
    } else {
        Err("bytes follow its last column".into())
    }
}

fn take_column(rest: &mut &[u8], frames: usize) -> Result<FrameNumberColumn, String> {
    let [form] = take_byte_array::<1>(rest)?;
    let numbers = match form {
        form::DECIMAL_COLUMN_KIND => ColumnNumbers::Decimals(take_decimals(rest, frames)?),
        form::SINGLE_COLUMN_KIND => ColumnNumbers::Singles(take_code(rest, frames)?),
        form::DOUBLE_COLUMN_KIND => ColumnNumbers::Doubles(take_code(rest, frames)?),
        form::SHORT_DOUBLES => {
            let short: Vec<f32> = take_code(rest, frames)?;
            ColumnNumbers::Doubles(short.into_iter().map(f64::from).collect())
        }
        form::INTEGER_COLUMN_KIND => {
            let (zero, unit) = (take_byte_array::<8>(rest)?, take_byte_array::<8>(rest)?);
            ColumnNumbers::Integers(ScaledIntegers {
                zero: f64::from_le_bytes(zero),
                unit: f64::from_le_bytes(unit),
                values: take_code(rest, frames)?,
            })
        }
        other => return Err(format!("the form {other} of numbers is unknown")),
    };
    let mut runs: Vec<Range<u32>> = Vec::new();
    for _ in 0..take_u32(rest)? {
        let run = u32::from_le_bytes(take_byte_array(rest)?)..u32::from_le_bytes(take_byte_array(rest)?);
        // Runs that touch would be one run, so that each column has one form only.
        if run.is_empty() || runs.last().is_some_and(|last| run.start <= last.end) {
            return Err("its gaps are out of order".into());
        }
        runs.push(run);
    }
    let gaps = ColumnGaps::from_gap_runs(runs);
    let column = FrameNumberColumn::new(numbers, gaps.clone()).map_err(|error| error.to_string())?;
    // A number that is not finite becomes a gap when the column is built.
    if *column.column_gaps() != gaps {
        return Err("a number is not finite".into());
    }
    Ok(column)
}

fn take_decimals(rest: &mut &[u8], frames: usize) -> Result<DecimalColumn, String> {
    let [scale] = take_byte_array::<1>(rest)?;
    let mantissas = take_code(rest, frames)?;
    let mut exceptions: Vec<(u32, FileNumber)> = Vec::new();
    for _ in 0..take_u32(rest)? {
        let frame = u32::from_le_bytes(take_byte_array::<4>(rest)?);
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
    Ok(DecimalColumn {
        scale,
        mantissas,
        exceptions,
    })
}

fn take_code<T: PlainNumber>(rest: &mut &[u8], frames: usize) -> Result<Vec<T>, String> {
    let [coding] = take_byte_array::<1>(rest)?;
    let length = take_u32(rest)?;
    let code = take_slice(rest, length)?;
    match coding {
        CONSTANT_COLUMN_CODE => {
            let value = T::from_plain_bytes(code).ok_or("a constant is not as long as its numbers")?;
            Ok(vec![value; frames])
        }
        PCO_COLUMN_CODE => {
            let mut values = vec![T::default(); frames];
            let progress = simple_decompress_into(code, &mut values).map_err(|error| error.to_string())?;
            if progress.n_processed != frames {
                return Err(format!("a column has {} numbers", progress.n_processed));
            }
            Ok(values)
        }
        other => Err(format!("the coding {other} is unknown")),
    }
}

fn take_slice<'a>(rest: &mut &'a [u8], length: usize) -> Result<&'a [u8], String> {
    let (slice, after) = rest.split_at_checked(length).ok_or("it is cut short")?;
    *rest = after;
    Ok(slice)
}

fn take_byte_array<const BYTE_COUNT: usize>(rest: &mut &[u8]) -> Result<[u8; BYTE_COUNT], String> {
    take_slice(rest, BYTE_COUNT)?
        .try_into()
        .map_err(|_| "it is cut short".to_owned())
}

fn take_u32(rest: &mut &[u8]) -> Result<usize, String> {
    Ok(u32::from_le_bytes(take_byte_array::<4>(rest)?) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn columns() -> Vec<DecimalColumn> {
        vec![
            DecimalColumn {
                scale: 6,
                mantissas: (0..100).map(|i| i * i * 37 - 999_999).collect(),
                exceptions: vec![],
            },
            DecimalColumn {
                scale: 0,
                mantissas: vec![-7; 100],
                exceptions: vec![(3, "1e300".parse().expect("a number"))],
            },
            DecimalColumn {
                scale: 18,
                mantissas: (0..100).map(|i| if i % 2 == 0 { i64::MIN } else { i64::MAX }).collect(),
                exceptions: vec![],
            },
        ]
    }

    #[test]
    fn blocks_read_back_unchanged_and_damage_is_named() {
        let columns = columns();
        let bytes = encode_decimal_columns(100, &columns.iter().collect::<Vec<_>>());
        let back = decode_block_columns(&bytes, 100, 3).expect("whole");
        for (a, b) in columns.iter().zip(back) {
            let ColumnNumbers::Decimals(b) = b.into_numbers() else {
                panic!("decimals are decimals");
            };
            assert_eq!(
                (a.scale, &a.mantissas, &a.exceptions),
                (b.scale, &b.mantissas, &b.exceptions)
            );
        }
        assert!(decode_block_columns(&bytes, 99, 3).is_err_and(|e| e.contains("3 columns of 100 frames")));
        damage(&bytes, 100, 3);
    }

    /// Truncates at every byte and changes every byte: nothing may panic, and truncation must be detected.
    fn damage(bytes: &[u8], frames: usize, count: usize) {
        for length in 0..bytes.len() {
            assert!(
                decode_block_columns(&bytes[..length], frames, count).is_err(),
                "{length} bytes"
            );
        }
        for at in 0..bytes.len() {
            for flip in [0x55, 0xff] {
                let mut broken = bytes.to_vec();
                broken[at] ^= flip;
                let _ = decode_block_columns(&broken, frames, count);
            }
        }
    }

    #[test]
    fn a_block_of_no_frames_or_no_columns_is_a_block() {
        assert!(decode_block_columns(&encode_decimal_columns(0, &[]), 0, 0).is_ok_and(|columns| columns.is_empty()));
        let none = [FrameNumberColumn::from_single_floats(Vec::new())];
        let back = decode_block_columns(&encode_any(0, &none), 0, 1).expect("whole");
        assert_eq!(back, none);
    }

    /// Columns of every form, with gaps and without.
    fn of_every_form() -> Vec<FrameNumberColumn> {
        let wave = |i: i32| f64::from(i).sin() * 1000.0;
        let gaps = ColumnGaps::from_gap_runs([3..7, 99..100]);
        let integers = (0..100).map(|i| i * 317 - 30_000).collect();
        let decimals = (0..100).map(|i| {
            (i % 9 != 4)
                .then(|| FileNumber::parse_file_number(b"1.250").ok())
                .flatten()
        });
        vec![
            FrameNumberColumn::from_single_floats((0..100).map(|i| wave(i) as f32).collect()),
            FrameNumberColumn::from_double_floats((0..100).map(wave).collect()),
            FrameNumberColumn::from_double_floats((0..100).map(|i| f64::from(wave(i) as f32)).collect()),
            FrameNumberColumn::from_double_floats(vec![-0.0; 100]),
            FrameNumberColumn::from_single_floats((0..100).map(|i| if i < 40 { f32::NAN } else { -0.0 }).collect()),
            FrameNumberColumn::from_scaled_integers(integers, 12.5, 0.083_333)
                .and_then(|it| it.with_gaps(&gaps))
                .expect("a column"),
            FrameNumberColumn::from_decimals(decimals),
        ]
    }

    fn bits(column: &FrameNumberColumn) -> Vec<Option<u64>> {
        column.column_values().map(|value| value.map(f64::to_bits)).collect()
    }

    #[test]
    fn every_form_reads_back_bit_for_bit_with_its_gaps() {
        let columns = of_every_form();
        let bytes = encode_any(100, &columns);
        let back = decode_block_columns(&bytes, 100, columns.len()).expect("whole");
        assert_eq!(back, columns);
        for (a, b) in columns.iter().zip(&back) {
            assert_eq!(
                (bits(a), a.column_numbers().number_form_name()),
                (bits(b), b.column_numbers().number_form_name())
            );
        }
        let short = encode_any(100, &columns[2..3]).len();
        assert!(
            short < encode_any(100, &columns[1..2]).len(),
            "f32 in f64 takes the room of f32"
        );
    }

    #[test]
    fn damaged_columns_of_any_form_are_refused_without_a_panic() {
        let columns: Vec<FrameNumberColumn> = of_every_form()
            .iter()
            .map(|column| column.slice_column(0..12))
            .collect();
        damage(&encode_any(12, &columns), 12, columns.len());
    }

    #[test]
    fn decimals_without_gaps_keep_the_bytes_that_they_always_had() {
        let columns = columns();
        let plain = encode_decimal_columns(100, &columns.iter().collect::<Vec<_>>());
        let any: Vec<FrameNumberColumn> = columns.into_iter().map(FrameNumberColumn::from).collect();
        assert_eq!(encode_any(100, &any), plain);
        assert_eq!(decode_block_columns(&plain, 100, 3).expect("whole"), any);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn any_floats_and_integers_read_back_unchanged(
            bits in proptest::collection::vec(any::<u64>(), 0..80),
            zero in -1e6..1e6f64,
            unit in 1e-6..10f64,
        ) {
            let frames = bits.len();
            let columns = vec![
                FrameNumberColumn::from_double_floats(bits.iter().map(|bits| f64::from_bits(*bits)).collect()),
                FrameNumberColumn::from_single_floats(bits.iter().map(|bits| f32::from_bits(*bits as u32)).collect()),
                FrameNumberColumn::from_scaled_integers(bits.iter().map(|bits| *bits as i32).collect(), zero, unit)
                    .expect("a column"),
            ];
            let back = decode_block_columns(&encode_any(frames, &columns), frames, 3).expect("whole");
            for (column, back) in columns.iter().zip(&back) {
                prop_assert_eq!(self::bits(column), self::bits(back));
                prop_assert_eq!(column.column_gaps(), back.column_gaps());
            }
        }
    }
}
