//! Cache of a function's performances in the corpus file, column by column, so that choosing among thousands reads one
//! row.
//!
//! The cache is stored with the derived files of the search index, under `faces/FUNCTION/CHANNELS`, and records the
//! operation after which it was written: performances of recordings that later operations touched are read again. It can
//! be deleted at any time.

use chereme_motion::RecordingInstant;
use chereme_sign::milestones::{ExpressionFunction, ExpressionMilestones};
use pco::ChunkConfig;
use pco::data_types::Number;
use pco::standalone::{simple_compress, simple_decompress_into};
use rusqlite::Connection;

use super::expressions::FaceExpression;
use super::performances::{FacePerformance, milestone_frames};
use crate::db::stored_search as files;

/// The first bytes of the cache; the last of them is the version, 2 since numbers can be missing.
const SHELF_FILE_MARK: &[u8; 6] = b"faces\x02";
/// The fewest performances that are cached; fewer are read from their recordings each time.
const MIN_CACHED_PERFORMANCES: usize = 256;
/// The largest number of numbers in a cache.
const MAX_CACHED_NUMBERS: usize = 64 << 20;
/// Marks a missing M3.
const MISSING_MILESTONE_MARK: i64 = i64::MIN;

/// Returns the name under which performances are cached.
fn performance_cache_path(function: &ExpressionFunction, channels: &[usize]) -> String {
    let channels: Vec<String> = channels.iter().map(ToString::to_string).collect();
    format!("faces/{function}/{}", channels.join("-"))
}

/// Returns the cached performances and the operation after which they were read, unless they are missing or damaged.
pub(super) fn read_cached_performances(
    connection: &Connection,
    function: &ExpressionFunction,
    channels: &[usize],
) -> Option<(i64, Vec<FacePerformance>)> {
    let data = files::read_index_file(connection, &performance_cache_path(function, channels)).ok()?;
    decode_performances(&data, function, channels.len())
}

/// Caches performances if there are many; does nothing if the corpus cannot be written.
pub(super) fn write_cached_performances(
    connection: &Connection,
    function: &ExpressionFunction,
    channels: &[usize],
    newest: i64,
    all: &[FacePerformance],
) {
    if all.len() < MIN_CACHED_PERFORMANCES {
        return;
    }
    if let Some(data) = encode_performances(all, channels.len(), newest) {
        // The row is a copy: a corpus that is locked or read-only works without it.
        let _ = files::write_file(connection, &performance_cache_path(function, channels), &data);
    }
}

fn encode_performances(all: &[FacePerformance], channels: usize, newest: i64) -> Option<Vec<u8>> {
    // Performances that are too long have marks but no numbers.
    let shown = |performance: &&FacePerformance| performance.columns.iter().any(Option::is_some);
    let numbers: usize = all.iter().filter(shown).map(|performance| performance.marks[4]).sum();
    if numbers.checked_mul(channels)? > MAX_CACHED_NUMBERS {
        return None;
    }
    let mut bytes = SHELF_FILE_MARK.to_vec();
    bytes.extend(newest.to_le_bytes());
    bytes.extend((all.len() as u64).to_le_bytes());
    let of = |number: &dyn Fn(&FacePerformance) -> i64| all.iter().map(number).collect::<Vec<i64>>();
    let marks = |performance: &FacePerformance| performance.expression.milestones;
    let known_bits = |performance: &FacePerformance| {
        let bits = performance.columns.iter().enumerate();
        bits.fold(0, |bits, (at, column)| bits | i64::from(column.is_some()) << at)
    };
    // Each field of all rows is a column, as equal kinds of numbers compress best together.
    for column in [
        of(&|performance| performance.expression.recording),
        of(&|performance| performance.expression.annotation),
        of(&|performance| marks(performance).m1.instant_micros()),
        of(&|performance| marks(performance).m2.instant_micros()),
        of(&|performance| {
            marks(performance)
                .m3
                .map_or(MISSING_MILESTONE_MARK, RecordingInstant::instant_micros)
        }),
        of(&|performance| marks(performance).m4.instant_micros()),
        of(&|performance| marks(performance).m5.instant_micros()),
        of(&known_bits),
    ] {
        put_compressed_numbers(&mut bytes, &column)?;
    }
    let text = |name: fn(&FacePerformance) -> &str| {
        let all: Vec<&str> = all.iter().map(name).collect();
        all.join("\0")
    };
    for text in [
        text(|performance| &performance.address),
        text(|performance| &performance.name),
    ] {
        bytes.extend((text.len() as u64).to_le_bytes());
        bytes.extend(text.as_bytes());
    }
    for channel in 0..channels {
        let columns = all
            .iter()
            .filter_map(|performance| performance.columns[channel].as_deref());
        let column_values: Vec<f64> = columns.flatten().copied().collect();
        put_compressed_numbers(&mut bytes, &column_values)?;
    }
    Some(bytes)
}

fn put_compressed_numbers<T: Number>(bytes: &mut Vec<u8>, numbers: &[T]) -> Option<()> {
    let code = simple_compress(numbers, &ChunkConfig::default()).ok()?;
    bytes.extend((code.len() as u64).to_le_bytes());
    bytes.extend(code);
    Some(())
}

struct CacheByteReader<'b>(&'b [u8]);

impl<'b> CacheByteReader<'b> {
    fn take_cache_bytes(&mut self, count: usize) -> Option<&'b [u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    fn read_cache_number(&mut self) -> Option<u64> {
        Some(u64::from_le_bytes(self.take_cache_bytes(8)?.try_into().ok()?))
    }

    fn read_cache_part(&mut self) -> Option<&'b [u8]> {
        let length = usize::try_from(self.read_cache_number()?).ok()?;
        self.take_cache_bytes(length)
    }

    fn read_cache_numbers<T: Number>(&mut self, count: usize) -> Option<Vec<T>> {
        let mut numbers = vec![T::default(); count];
        let progress = simple_decompress_into(self.read_cache_part()?, &mut numbers).ok()?;
        (progress.n_processed == count && progress.finished).then_some(numbers)
    }
}

fn decode_performances(
    data: &[u8],
    function: &ExpressionFunction,
    channels: usize,
) -> Option<(i64, Vec<FacePerformance>)> {
    let mut bytes = CacheByteReader(data.strip_prefix(SHELF_FILE_MARK)?);
    let newest = bytes.read_cache_number()?.cast_signed();
    let count = usize::try_from(bytes.read_cache_number()?).ok()?;
    // A damaged count must not reserve memory for more than a cache can hold.
    if count > MAX_CACHED_NUMBERS {
        return None;
    }
    let mut rows: Vec<Vec<i64>> = Vec::with_capacity(8);
    for _ in 0..8 {
        rows.push(bytes.read_cache_numbers(count)?);
    }
    let mut texts = Vec::with_capacity(2);
    for _ in 0..2 {
        let text = std::str::from_utf8(bytes.read_cache_part()?).ok()?;
        let all: Vec<&str> = text.split('\0').collect();
        // Splitting an empty text gives one empty part.
        if all.len() != count.max(1) {
            return None;
        }
        texts.push(all);
    }
    let instant_at = |row: usize, n: usize| RecordingInstant::from_micros(rows[row][n]);
    let mut all = Vec::with_capacity(count);
    for n in 0..count {
        let milestones = ExpressionMilestones {
            m1: instant_at(2, n),
            m2: instant_at(3, n),
            m3: (rows[4][n] != MISSING_MILESTONE_MARK).then(|| instant_at(4, n)),
            m4: instant_at(5, n),
            m5: instant_at(6, n),
        };
        all.push(FacePerformance {
            expression: FaceExpression {
                recording: rows[0][n],
                function: function.clone(),
                milestones,
                annotation: rows[1][n],
                signs: Vec::new(),
                stored: Vec::new(),
                corrected: false,
                odd: Vec::new(),
            },
            address: texts[0][n].to_owned(),
            name: texts[1][n].to_owned(),
            columns: Vec::with_capacity(channels),
            marks: milestone_frames(&milestones)?,
            seconds: milestones.milestone_span().span_seconds(),
        });
    }
    for channel in 0..channels {
        let knows = |n: &usize| rows[7][*n] >> channel & 1 == 1;
        let lengths = (0..count).filter(knows).map(|n| all[n].marks[4]);
        let total = lengths.sum::<usize>();
        if total > MAX_CACHED_NUMBERS {
            return None;
        }
        let column_values: Vec<f64> = bytes.read_cache_numbers(total)?;
        let mut from = 0;
        for (n, it) in all.iter_mut().enumerate() {
            let own_values = knows(&n).then(|| {
                let until = from + it.marks[4];
                let values = column_values[from..until].to_vec();
                from = until;
                values
            });
            it.columns.push(own_values);
        }
    }
    Some((newest, all))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn performance(n: i64) -> FacePerformance {
        let milli = |at: i64| RecordingInstant::from_millis(at + n);
        let milestones = ExpressionMilestones {
            m1: milli(-200),
            m2: milli(0),
            m3: (n % 2 == 0).then(|| milli(600)),
            m4: milli(900),
            m5: milli(1400),
        };
        let marks = milestone_frames(&milestones).expect("frames");
        let column = |start: f64| (0..marks[4]).map(|frame| start + frame as f64 / 7.0).collect();
        FacePerformance {
            expression: FaceExpression {
                recording: n,
                function: ExpressionFunction::from_function_name("wh"),
                milestones,
                annotation: 7 * n,
                signs: Vec::new(),
                stored: Vec::new(),
                corrected: false,
                odd: Vec::new(),
            },
            address: format!("recording:{n}"),
            name: format!("W{n}"),
            columns: vec![Some(column(0.1)), (n != 3).then(|| column(-1.0 / 3.0)), None],
            marks,
            seconds: milestones.milestone_span().span_seconds(),
        }
    }

    #[test]
    fn stored_performances_read_back_bit_for_bit_and_damage_is_detected() {
        let all: Vec<FacePerformance> = (1..6).map(performance).collect();
        let data = encode_performances(&all, 3, 42).expect("bytes");
        let wh = ExpressionFunction::from_function_name("wh");
        let (newest, back) = decode_performances(&data, &wh, 3).expect("performances");
        assert_eq!(format!("{back:?}"), format!("{all:?}"));
        assert_eq!(newest, 42);
        assert!(decode_performances(&data, &wh, 4).is_none(), "other channels");
        for cut in 0..data.len() {
            assert!(decode_performances(&data[..cut], &wh, 3).is_none(), "{cut}");
        }
        for at in 0..data.len() {
            let mut damaged = data.clone();
            damaged[at] ^= 0x55;
            // Damaged data may decode to other numbers, but must not panic.
            let _ = decode_performances(&damaged, &wh, 3);
        }
        let none = encode_performances(&[], 3, 42).expect("bytes");
        assert_eq!(decode_performances(&none, &wh, 3).map(|(_, it)| it.len()), Some(0));
    }
}
