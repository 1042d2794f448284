//! Association of two fields whose values have no order.

use serde::{Deserialize, Serialize};

use super::UndefinedStatistic;
use crate::random::RandomNumbers;

/// The most cells of a table that is counted in one piece; a larger one is counted from sorted pairs.
const MAX_WHOLE_TABLE_CELLS: usize = 1 << 22;
/// The share by which a statistic of a permutation may be smaller and still counts as equal: the order of a sum.
const PERMUTATION_ROUNDING: f64 = 1e-9;

/// How far two fields go together.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ValueAssociation {
    /// The number of things.
    pub n: usize,
    /// The number of different values of the first field.
    pub rows: usize,
    /// The number of different values of the second field.
    pub columns: usize,
    /// The mutual information in bits.
    pub bits: f64,
    /// Pearson's chi-square.
    pub chi_square: f64,
    /// Its degrees of freedom, (rows - 1)(columns - 1).
    pub df: usize,
}

impl ValueAssociation {
    /// Returns the association of two fields, from the values of each thing.
    ///
    /// # Errors
    /// [`UndefinedStatistic::Unequal`]; [`UndefinedStatistic::Empty`] without things.
    pub fn from_field_values(first: &[u32], second: &[u32]) -> Result<Self, UndefinedStatistic> {
        Ok(ValuePairTable::from_value_columns(first, second)?.current_association())
    }

    /// Returns Cramér's V, the root of chi-square divided by its largest value, from 0 to 1.
    ///
    /// # Errors
    /// [`UndefinedStatistic::NoSpread`] if a field has one value.
    pub fn cramers_v(&self) -> Result<f64, UndefinedStatistic> {
        match self.rows.min(self.columns) {
            0 | 1 => Err(UndefinedStatistic::NoSpread),
            least => {
                let most = (self.n * (least - 1)) as f64;
                Ok((self.chi_square / most).max(0.0).sqrt().min(1.0))
            }
        }
    }
}

/// The association of two fields compared with that of shuffled values.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ShuffledAssociation {
    /// The number of shuffles.
    pub samples: usize,
    /// The mean mutual information of shuffled values in bits: how much of it rare values bring about by themselves.
    pub bits: f64,
    /// The mean chi-square of shuffled values.
    pub chi_square: f64,
    /// The share of arrangements, the observed one included, whose mutual information is at least as large.
    pub p_bits: f64,
    /// The share of arrangements, the observed one included, whose chi-square is at least as large.
    pub p_chi_square: f64,
}

impl ShuffledAssociation {
    /// Shuffles the values of the second field `samples` times; the same seed gives the same result.
    ///
    /// `hear` is called before each shuffle with the number of those that are done; its error ends the work. Source of
    /// p: Phipson and Smyth 2010, (b + 1) / (samples + 1).
    ///
    /// # Errors
    /// [`UndefinedStatistic::TooFew`] for 0 samples; [`UndefinedStatistic::NoSpread`] if a field has one value, so that every arrangement
    /// is the same; those of [`ValueAssociation::from_field_values`]; those of `hear`.
    pub fn from_shuffled_values<E: From<UndefinedStatistic>>(
        first: &[u32],
        second: &[u32],
        samples: usize,
        seed: u64,
        mut hear: impl FnMut(usize) -> Result<(), E>,
    ) -> Result<Self, E> {
        let mut table = ValuePairTable::from_value_columns(first, second)?;
        let observed = table.current_association();
        if samples == 0 {
            return Err(UndefinedStatistic::TooFew.into());
        }
        if observed.df == 0 {
            return Err(UndefinedStatistic::NoSpread.into());
        }
        let mut random = RandomNumbers::new(seed);
        let mut sums = [0.0; 2];
        let mut as_large = [0_usize; 2];
        for done in 0..samples {
            hear(done)?;
            // Fisher and Yates: every order is equally likely.
            for at in (1..table.second.len()).rev() {
                table.second.swap(at, random.random_below(at + 1));
            }
            let resampled = table.current_association();
            let both = [
                (resampled.bits, observed.bits),
                (resampled.chi_square, observed.chi_square),
            ];
            for (at, (own, observed)) in both.into_iter().enumerate() {
                sums[at] += own;
                as_large[at] += usize::from(own >= observed * (1.0 - PERMUTATION_ROUNDING));
            }
        }
        let p = as_large.map(|count| (count + 1) as f64 / (samples + 1) as f64);
        Ok(Self {
            samples,
            bits: sums[0] / samples as f64,
            chi_square: sums[1] / samples as f64,
            p_bits: p[0],
            p_chi_square: p[1],
        })
    }
}

/// The values of two fields, as numbers from 0 without gaps, with room to count their pairs.
struct ValuePairTable {
    first: Vec<usize>,
    second: Vec<usize>,
    rows: Vec<usize>,
    columns: Vec<usize>,
    counts: Vec<u32>,
}

impl ValuePairTable {
    fn from_value_columns(first: &[u32], second: &[u32]) -> Result<Self, UndefinedStatistic> {
        if first.len() != second.len() {
            return Err(UndefinedStatistic::Unequal);
        }
        if first.is_empty() {
            return Err(UndefinedStatistic::Empty);
        }
        let (first, rows) = number_distinct_values(first);
        let (second, columns) = number_distinct_values(second);
        let cells = rows.len().saturating_mul(columns.len());
        Ok(Self {
            counts: vec![0; if cells <= MAX_WHOLE_TABLE_CELLS { cells } else { 0 }],
            first,
            second,
            rows,
            columns,
        })
    }

    /// Returns the association of the values as they are now.
    fn current_association(&mut self) -> ValueAssociation {
        let n = self.first.len() as f64;
        // Observed² / (row × column), and observed × log2(observed × n / (row × column)), over the cells that are not 0.
        let (mut squares, mut bits) = (0.0, 0.0);
        let (rows, columns) = (&self.rows, &self.columns);
        let mut add = |row: usize, column: usize, observed: f64| {
            let expected = rows[row] as f64 * columns[column] as f64 / n;
            squares += observed * observed / expected;
            bits += observed * (observed / expected).log2();
        };
        let value_pairs = self.first.iter().zip(&self.second);
        let cells = value_pairs.map(|(row, column)| row * columns.len() + column);
        if self.counts.is_empty() {
            let mut cells: Vec<usize> = cells.collect();
            cells.sort_unstable();
            for same in cells.chunk_by(|a, b| a == b) {
                let shared_cell = same[0];
                add(
                    shared_cell / columns.len(),
                    shared_cell % columns.len(),
                    same.len() as f64,
                );
            }
        } else {
            for cell in cells.clone() {
                self.counts[cell] += 1;
            }
            for cell in cells {
                // The first pair of a cell takes its whole count, and leaves the cell empty for the next
                // shuffle.
                let count = std::mem::take(&mut self.counts[cell]);
                if count > 0 {
                    add(cell / columns.len(), cell % columns.len(), f64::from(count));
                }
            }
        }
        ValueAssociation {
            n: self.first.len(),
            rows: rows.len(),
            columns: columns.len(),
            // Rounding may leave either sum just below 0.
            bits: (bits / n).max(0.0),
            chi_square: (squares - n).max(0.0),
            df: (rows.len() - 1) * (columns.len() - 1),
        }
    }
}

/// Returns values as numbers from 0 without gaps, and how often each occurs.
fn number_distinct_values(values: &[u32]) -> (Vec<usize>, Vec<usize>) {
    let mut distinct_values = values.to_vec();
    distinct_values.sort_unstable();
    distinct_values.dedup();
    let mut counts = vec![0; distinct_values.len()];
    let number = |value: &u32| {
        let number = distinct_values.partition_point(|other| other < value);
        counts[number] += 1;
        number
    };
    (values.iter().map(number).collect(), counts)
}
