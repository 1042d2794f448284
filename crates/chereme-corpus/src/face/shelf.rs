//! Cache of a function's performances in the corpus file, column by column, so that choosing among thousands reads one
//! row.
//!
//! The cache is stored with the derived files of the search index, under `faces/FUNCTION/CHANNELS`, and records the
//! operation after which it was written: performances of recordings that later operations touched are read again. It can
//! be deleted at any time.

use chereme_motion::Instant;
use chereme_sign::milestones::{Function, Milestones};
use pco::ChunkConfig;
use pco::data_types::Number;
use pco::standalone::{simple_compress, simple_decompress_into};
use rusqlite::Connection;

use super::expressions::Expression;
use super::performances::{Performance, cut};
use crate::db::search as files;

/// The first bytes of the cache; the last of them is the version, 2 since numbers can be missing.
const MARK: &[u8; 6] = b"faces\x02";
/// The fewest performances that are cached; fewer are read from their recordings each time.
const MANY: usize = 256;
/// The largest number of numbers in a cache.
const MOST: usize = 64 << 20;
/// Marks a missing M3.
const NONE: i64 = i64::MIN;

/// Returns the name under which performances are cached.
fn path(function: &Function, channels: &[usize]) -> String {
    let channels: Vec<String> = channels.iter().map(ToString::to_string).collect();
    format!("faces/{function}/{}", channels.join("-"))
}

/// Returns the cached performances and the operation after which they were read, unless they are missing or damaged.
pub(super) fn read(
    connection: &Connection,
    function: &Function,
    channels: &[usize],
) -> Option<(i64, Vec<Performance>)> {
    let data = files::file(connection, &path(function, channels)).ok()?;
    decode(&data, function, channels.len())
}

/// Caches performances if there are many; does nothing if the corpus cannot be written.
pub(super) fn write(
    connection: &Connection,
    function: &Function,
    channels: &[usize],
    (newest, all): (i64, &[Performance]),
) {
    if all.len() < MANY {
        return;
    }
    if let Some(data) = encode(all, channels.len(), newest) {
        // The row is a copy: a corpus that is locked or read-only works without it.
        let _ = files::write_file(connection, &path(function, channels), &data);
    }
}

fn encode(all: &[Performance], channels: usize, newest: i64) -> Option<Vec<u8>> {
    let shown = |it: &&Performance| it.columns.iter().any(Option::is_some);
    let numbers: usize = all.iter().filter(shown).map(|it| it.marks[4]).sum();
    if numbers.checked_mul(channels)? > MOST {
        return None;
    }
    let mut bytes = MARK.to_vec();
    bytes.extend(newest.to_le_bytes());
    bytes.extend((all.len() as u64).to_le_bytes());
    let of = |number: &dyn Fn(&Performance) -> i64| all.iter().map(number).collect::<Vec<i64>>();
    let marks = |it: &Performance| it.expression.milestones;
    let known = |it: &Performance| {
        let bits = it.columns.iter().enumerate();
        bits.fold(0, |bits, (at, column)| {
            bits | i64::from(column.is_some()) << at
        })
    };
    for column in [
        of(&|it| it.expression.recording),
        of(&|it| it.expression.annotation),
        of(&|it| marks(it).m1.micros()),
        of(&|it| marks(it).m2.micros()),
        of(&|it| marks(it).m3.map_or(NONE, Instant::micros)),
        of(&|it| marks(it).m4.micros()),
        of(&|it| marks(it).m5.micros()),
        of(&known),
    ] {
        put(&mut bytes, &column)?;
    }
    let text = |name: fn(&Performance) -> &str| {
        let all: Vec<&str> = all.iter().map(name).collect();
        all.join("\0")
    };
    for text in [text(|it| &it.address), text(|it| &it.name)] {
        bytes.extend((text.len() as u64).to_le_bytes());
        bytes.extend(text.as_bytes());
    }
    for channel in 0..channels {
        let columns = all.iter().filter_map(|it| it.columns[channel].as_deref());
        let whole: Vec<f64> = columns.flatten().copied().collect();
        put(&mut bytes, &whole)?;
    }
    Some(bytes)
}

fn put<T: Number>(bytes: &mut Vec<u8>, numbers: &[T]) -> Option<()> {
    let code = simple_compress(numbers, &ChunkConfig::default()).ok()?;
    bytes.extend((code.len() as u64).to_le_bytes());
    bytes.extend(code);
    Some(())
}

struct Bytes<'b>(&'b [u8]);

impl<'b> Bytes<'b> {
    fn take(&mut self, count: usize) -> Option<&'b [u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    fn number(&mut self) -> Option<u64> {
        Some(u64::from_le_bytes(self.take(8)?.try_into().ok()?))
    }

    fn part(&mut self) -> Option<&'b [u8]> {
        let length = usize::try_from(self.number()?).ok()?;
        self.take(length)
    }

    fn numbers<T: Number>(&mut self, count: usize) -> Option<Vec<T>> {
        let mut numbers = vec![T::default(); count];
        let progress = simple_decompress_into(self.part()?, &mut numbers).ok()?;
        (progress.n_processed == count && progress.finished).then_some(numbers)
    }
}

fn decode(data: &[u8], function: &Function, channels: usize) -> Option<(i64, Vec<Performance>)> {
    let mut bytes = Bytes(data.strip_prefix(MARK)?);
    let newest = bytes.number()?.cast_signed();
    let count = usize::try_from(bytes.number()?).ok()?;
    if count > MOST {
        return None;
    }
    let mut rows: Vec<Vec<i64>> = Vec::with_capacity(8);
    for _ in 0..8 {
        rows.push(bytes.numbers(count)?);
    }
    let mut texts = Vec::with_capacity(2);
    for _ in 0..2 {
        let text = std::str::from_utf8(bytes.part()?).ok()?;
        let all: Vec<&str> = text.split('\0').collect();
        if all.len() != count.max(1) {
            return None;
        }
        texts.push(all);
    }
    let at = |row: usize, n: usize| Instant::from_micros(rows[row][n]);
    let mut all = Vec::with_capacity(count);
    for n in 0..count {
        let milestones = Milestones {
            m1: at(2, n),
            m2: at(3, n),
            m3: (rows[4][n] != NONE).then(|| at(4, n)),
            m4: at(5, n),
            m5: at(6, n),
        };
        all.push(Performance {
            expression: Expression {
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
            marks: cut(&milestones)?,
            seconds: milestones.span().seconds(),
        });
    }
    for channel in 0..channels {
        let knows = |n: &usize| rows[7][*n] >> channel & 1 == 1;
        let lengths = (0..count).filter(knows).map(|n| all[n].marks[4]);
        let total = lengths.sum::<usize>();
        if total > MOST {
            return None;
        }
        let whole: Vec<f64> = bytes.numbers(total)?;
        let mut from = 0;
        for (n, it) in all.iter_mut().enumerate() {
            let own = knows(&n).then(|| {
                let until = from + it.marks[4];
                let own = whole[from..until].to_vec();
                from = until;
                own
            });
            it.columns.push(own);
        }
    }
    Some((newest, all))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn performance(n: i64) -> Performance {
        let milli = |at: i64| Instant::from_millis(at + n);
        let milestones = Milestones {
            m1: milli(-200),
            m2: milli(0),
            m3: (n % 2 == 0).then(|| milli(600)),
            m4: milli(900),
            m5: milli(1400),
        };
        let marks = cut(&milestones).expect("frames");
        let column = |start: f64| {
            (0..marks[4])
                .map(|frame| start + frame as f64 / 7.0)
                .collect()
        };
        Performance {
            expression: Expression {
                recording: n,
                function: Function::of("wh"),
                milestones,
                annotation: 7 * n,
                signs: Vec::new(),
                stored: Vec::new(),
                corrected: false,
                odd: Vec::new(),
            },
            address: format!("recording:{n}"),
            name: format!("W{n}"),
            columns: vec![
                Some(column(0.1)),
                (n != 3).then(|| column(-1.0 / 3.0)),
                None,
            ],
            marks,
            seconds: milestones.span().seconds(),
        }
    }

    #[test]
    fn stored_performances_read_back_bit_for_bit_and_damage_is_detected() {
        let all: Vec<Performance> = (1..6).map(performance).collect();
        let data = encode(&all, 3, 42).expect("bytes");
        let wh = Function::of("wh");
        let (newest, back) = decode(&data, &wh, 3).expect("performances");
        assert_eq!(format!("{back:?}"), format!("{all:?}"));
        assert_eq!(newest, 42);
        assert!(decode(&data, &wh, 4).is_none(), "other channels");
        for cut in 0..data.len() {
            assert!(decode(&data[..cut], &wh, 3).is_none(), "{cut}");
        }
        for at in 0..data.len() {
            let mut damaged = data.clone();
            damaged[at] ^= 0x55;
            // Damaged data may decode to other numbers, but must not panic.
            let _ = decode(&damaged, &wh, 3);
        }
        let none = encode(&[], 3, 42).expect("bytes");
        assert_eq!(decode(&none, &wh, 3).map(|(_, it)| it.len()), Some(0));
    }
}
