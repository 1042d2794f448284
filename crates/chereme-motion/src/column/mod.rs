//! Columns of numbers exactly as a file gives them: decimals of text, floats, integers with a scale; gaps stay gaps.
//!
//! ```
//! use chereme_motion::column::{FrameNumberColumn, FileNumber};
//!
//! let text = ["1.50", "", "3e-3"].map(|cell| FileNumber::parse_file_number(cell.as_bytes()).ok());
//! let column = FrameNumberColumn::from_decimals(text);
//! assert_eq!([column.column_value_at(0), column.column_value_at(1), column.column_value_at(2)], [Some(1.5), None, Some(0.003)]);
//! assert_eq!(column.column_text_at(0).as_deref(), Some("1.500"));
//!
//! let raw = FrameNumberColumn::from_scaled_integers(vec![-8067, 2868], 0.0, 0.1)?;
//! assert_eq!(raw.column_value_at(1), Some(2868.0 * 0.1));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod decimals;
mod gaps;
mod number;

use std::ops::Range;

pub use decimals::DecimalColumn;
pub use gaps::ColumnGaps;
pub use number::{ExactDecimal, FileNumber, MANTISSA_LIMIT, NotANumber, POWERS_OF_TEN};

/// One number per frame, in the form of the file; some frames may have none.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameNumberColumn {
    numbers: ColumnNumbers,
    gaps: ColumnGaps,
}

/// The numbers of a column; at a gap the number is zero and has no meaning.
#[derive(Clone, Debug, PartialEq)]
pub enum ColumnNumbers {
    /// Decimals of a text file.
    Decimals(DecimalColumn),
    /// Floats of 32 bits, all finite.
    Singles(Vec<f32>),
    /// Floats of 64 bits, all finite.
    Doubles(Vec<f64>),
    /// Integers with a scale, as C3D and analog converters write them.
    Integers(ScaledIntegers),
}

/// Integers that represent `(value - zero) * unit`.
#[derive(Clone, Debug, PartialEq)]
pub struct ScaledIntegers {
    /// The integers of the file, whatever their width there.
    pub values: Vec<i32>,
    /// The integer that represents zero; finite.
    pub zero: f64,
    /// The value of one step; finite and not zero.
    pub unit: f64,
}

/// A reason why numbers are not a column.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ColumnError {
    /// The zero or the unit of integers is not finite, or the unit is zero.
    #[error("integers with the zero {zero} and the unit {unit} stand for no numbers")]
    Scale {
        /// The integer that represents zero.
        zero: f64,
        /// The value of one step.
        unit: f64,
    },
    /// A gap lies after the last number.
    #[error("a gap reaches to frame {end}, and there are {frames} frames")]
    Gap {
        /// The first frame after the gap.
        end: usize,
        /// The column's frames.
        frames: usize,
    },
    /// There are more numbers than a column holds.
    #[error("{0} numbers are more than a column holds")]
    TooLong(usize),
    /// Numbers of another form or scale are to be appended.
    #[error("{0} cannot be appended to numbers of another form or scale")]
    Form(&'static str),
}

impl FrameNumberColumn {
    /// Returns the column of decimals of text; `None` is a gap.
    #[must_use]
    pub fn from_decimals(numbers: impl IntoIterator<Item = Option<FileNumber>>) -> Self {
        let mut gaps = Vec::new();
        let numbers = (0..).zip(numbers).map(|(frame, number)| {
            number.unwrap_or_else(|| {
                gaps.push(frame);
                FileNumber::ZERO_NUMBER
            })
        });
        let numbers = ColumnNumbers::Decimals(DecimalColumn::from_exact_numbers(numbers.collect::<Vec<_>>()));
        Self {
            numbers,
            gaps: ColumnGaps::from_gap_frames(gaps),
        }
    }

    /// Returns the column of 32-bit floats; a float that is not finite is a gap.
    #[must_use]
    pub fn from_single_floats(mut values: Vec<f32>) -> Self {
        let gaps = ColumnGaps::from_gap_frames((0..).zip(&values).filter(|(_, v)| !v.is_finite()).map(|(f, _)| f));
        values.iter_mut().filter(|v| !v.is_finite()).for_each(|v| *v = 0.0);
        Self {
            numbers: ColumnNumbers::Singles(values),
            gaps,
        }
    }

    /// Returns the column of 64-bit floats; a float that is not finite is a gap.
    #[must_use]
    pub fn from_double_floats(mut values: Vec<f64>) -> Self {
        let gaps = ColumnGaps::from_gap_frames((0..).zip(&values).filter(|(_, v)| !v.is_finite()).map(|(f, _)| f));
        values.iter_mut().filter(|v| !v.is_finite()).for_each(|v| *v = 0.0);
        Self {
            numbers: ColumnNumbers::Doubles(values),
            gaps,
        }
    }

    /// Returns the column of integers that represent `(value - zero) * unit`.
    ///
    /// # Errors
    /// [`ColumnError::Scale`] if `zero` or `unit` is not finite, or `unit` is zero.
    pub fn from_scaled_integers(values: Vec<i32>, zero: f64, unit: f64) -> Result<Self, ColumnError> {
        Self::new(
            ColumnNumbers::Integers(ScaledIntegers { values, zero, unit }),
            ColumnGaps::default(),
        )
    }

    /// Returns the column of `numbers` with `gaps`; floats that are not finite are gaps too, and the numbers at gaps
    /// become zero.
    ///
    /// # Errors
    /// [`ColumnError`] if a gap lies after the last number, or the zero or unit of integers is invalid.
    pub fn new(numbers: ColumnNumbers, gaps: ColumnGaps) -> Result<Self, ColumnError> {
        let column = match numbers {
            ColumnNumbers::Singles(values) => Self::from_single_floats(values),
            ColumnNumbers::Doubles(values) => Self::from_double_floats(values),
            ColumnNumbers::Integers(ScaledIntegers { zero, unit, .. })
                if !zero.is_finite() || !unit.is_finite() || unit == 0.0 =>
            {
                return Err(ColumnError::Scale { zero, unit });
            }
            numbers => Self {
                numbers,
                gaps: ColumnGaps::default(),
            },
        };
        if u32::try_from(column.len()).is_err() {
            return Err(ColumnError::TooLong(column.len()));
        }
        column.with_gaps(&gaps)
    }

    /// Returns the column with further `gaps`.
    ///
    /// # Errors
    /// [`ColumnError::Gap`] if a gap lies after the last number.
    pub fn with_gaps(mut self, gaps: &ColumnGaps) -> Result<Self, ColumnError> {
        let (end, frames) = (gaps.gaps_end_frame(), self.len());
        if end > frames {
            return Err(ColumnError::Gap { end, frames });
        }
        for run in gaps.gap_runs() {
            let gap_rows = run.start as usize..run.end as usize;
            match &mut self.numbers {
                ColumnNumbers::Decimals(decimals) => {
                    decimals.mantissas[gap_rows].fill(0);
                    decimals.exceptions.retain(|(frame, _)| !run.contains(frame));
                }
                ColumnNumbers::Singles(values) => values[gap_rows].fill(0.0),
                ColumnNumbers::Doubles(values) => values[gap_rows].fill(0.0),
                ColumnNumbers::Integers(integers) => integers.values[gap_rows].fill(0),
            }
        }
        self.gaps.append_gaps(0, gaps);
        Ok(self)
    }

    /// Returns the numbers in the form of the file; they have no meaning at gaps.
    #[must_use]
    pub fn column_numbers(&self) -> &ColumnNumbers {
        &self.numbers
    }

    /// Returns the numbers in the form of the file; they have no meaning at gaps.
    #[must_use]
    pub fn into_numbers(self) -> ColumnNumbers {
        self.numbers
    }

    /// Returns the frames without a number.
    #[must_use]
    pub fn column_gaps(&self) -> &ColumnGaps {
        &self.gaps
    }

    /// Returns how many frames there are, including gaps.
    #[must_use]
    pub fn len(&self) -> usize {
        match &self.numbers {
            ColumnNumbers::Decimals(decimals) => decimals.len(),
            ColumnNumbers::Singles(values) => values.len(),
            ColumnNumbers::Doubles(values) => values.len(),
            ColumnNumbers::Integers(integers) => integers.values.len(),
        }
    }

    /// Returns whether there are no frames.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the number in a frame as the nearest `f64`, `None` in a gap and after the last frame.
    #[must_use]
    pub fn column_value_at(&self, frame: usize) -> Option<f64> {
        if frame >= self.len() || (!self.gaps.is_empty() && self.gaps.is_gap_frame(frame)) {
            return None;
        }
        Some(match &self.numbers {
            ColumnNumbers::Decimals(decimals) => decimals.decimal_value_at(frame),
            ColumnNumbers::Singles(values) => f64::from(values[frame]),
            ColumnNumbers::Doubles(values) => values[frame],
            ColumnNumbers::Integers(integers) => (f64::from(integers.values[frame]) - integers.zero) * integers.unit,
        })
    }

    /// Returns every frame's number as the nearest `f64`, `None` in gaps.
    pub fn column_values(&self) -> impl Iterator<Item = Option<f64>> + '_ {
        (0..self.len()).map(|frame| self.column_value_at(frame))
    }

    /// Returns the number in a frame as text that reads back as the same number: decimals unchanged, floats with the
    /// fewest digits, integers as their value; `None` in a gap and after the last frame.
    #[must_use]
    pub fn column_text_at(&self, frame: usize) -> Option<String> {
        let value = self.column_value_at(frame)?;
        Some(match &self.numbers {
            ColumnNumbers::Decimals(decimals) => decimals.exact_number_at(frame)?.to_string(),
            ColumnNumbers::Singles(values) => values[frame].to_string(),
            ColumnNumbers::Doubles(_) | ColumnNumbers::Integers(_) => value.to_string(),
        })
    }

    /// Returns the frames `rows`, as far as they exist.
    #[must_use]
    pub fn slice_column(&self, rows: Range<usize>) -> Self {
        let end = rows.end.min(self.len());
        let rows = rows.start.min(end)..end;
        let gaps = self.gaps.slice_gaps(rows.clone());
        let numbers = match &self.numbers {
            ColumnNumbers::Decimals(decimals) => ColumnNumbers::Decimals(decimals.slice_decimals(rows)),
            ColumnNumbers::Singles(values) => ColumnNumbers::Singles(values[rows].to_vec()),
            ColumnNumbers::Doubles(values) => ColumnNumbers::Doubles(values[rows].to_vec()),
            ColumnNumbers::Integers(integers) => ColumnNumbers::Integers(ScaledIntegers {
                values: integers.values[rows].to_vec(),
                ..*integers
            }),
        };
        Self { numbers, gaps }
    }

    /// Appends the frames of `other`.
    ///
    /// # Errors
    /// [`ColumnError::Form`] if its numbers have another form, or integers another zero or unit.
    pub fn append_column(&mut self, other: &Self) -> Result<(), ColumnError> {
        let before = self.len();
        match (&mut self.numbers, &other.numbers) {
            (ColumnNumbers::Decimals(own), ColumnNumbers::Decimals(more)) => own.append_decimals(more),
            (ColumnNumbers::Singles(own), ColumnNumbers::Singles(more)) => own.extend_from_slice(more),
            (ColumnNumbers::Doubles(own), ColumnNumbers::Doubles(more)) => own.extend_from_slice(more),
            (ColumnNumbers::Integers(own), ColumnNumbers::Integers(more))
                if own.zero == more.zero && own.unit == more.unit =>
            {
                own.values.extend_from_slice(&more.values);
            }
            (_, other) => return Err(ColumnError::Form(other.number_form_name())),
        }
        self.gaps.append_gaps(before, &other.gaps);
        Ok(())
    }
}

impl ColumnNumbers {
    /// Returns the name of the form: `decimals`, `f32`, `f64` or `integers`.
    #[must_use]
    pub fn number_form_name(&self) -> &'static str {
        match self {
            Self::Decimals(_) => "decimals",
            Self::Singles(_) => "f32",
            Self::Doubles(_) => "f64",
            Self::Integers(_) => "integers",
        }
    }
}

impl From<DecimalColumn> for FrameNumberColumn {
    fn from(decimals: DecimalColumn) -> Self {
        Self {
            numbers: ColumnNumbers::Decimals(decimals),
            gaps: ColumnGaps::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn forms() -> Vec<FrameNumberColumn> {
        let texts = ["1.50", "", "-2e-3", "7", ""];
        vec![
            FrameNumberColumn::from_decimals(texts.map(|text| text.parse().ok())),
            FrameNumberColumn::from_single_floats(vec![0.1, f32::NAN, -0.0, f32::MAX, f32::INFINITY]),
            FrameNumberColumn::from_double_floats(vec![0.1, f64::NAN, -0.0, f64::MIN_POSITIVE, f64::INFINITY]),
            FrameNumberColumn::from_scaled_integers(vec![-32768, 1, 2, 32767, 5], 2.0, 0.05)
                .and_then(|column| column.with_gaps(&ColumnGaps::from_gap_frames([1, 4])))
                .expect("a column"),
        ]
    }

    #[test]
    fn gaps_have_no_value_or_text_and_numbers_are_unchanged() {
        let values: [[f64; 3]; 4] = [
            [1.5, -0.002, 7.0],
            [f64::from(0.1f32), -0.0, f64::from(f32::MAX)],
            [0.1, -0.0, f64::MIN_POSITIVE],
            [-32770.0 * 0.05, 0.0, 32765.0 * 0.05],
        ];
        for (column, values) in forms().into_iter().zip(values) {
            let form = column.column_numbers().number_form_name();
            let found: Vec<Option<f64>> = column.column_values().collect();
            assert_eq!(
                found,
                [Some(values[0]), None, Some(values[1]), Some(values[2]), None],
                "{form}"
            );
            for frame in 0..7 {
                let text = column.column_text_at(frame);
                assert_eq!(text.is_some(), column.column_value_at(frame).is_some(), "{form}");
                let single = matches!(column.column_numbers(), ColumnNumbers::Singles(_));
                let read = text.map(|text| match single {
                    true => f64::from(text.parse::<f32>().expect("a number")),
                    false => text.parse().expect("a number"),
                });
                assert_eq!(read, column.column_value_at(frame), "{form} {frame}");
            }
        }
    }

    #[test]
    fn joined_parts_equal_the_whole() {
        for whole in forms() {
            for cut in 0..=5 {
                let mut both = whole.slice_column(0..cut);
                both.append_column(&whole.slice_column(cut..9)).expect("one form");
                assert!(both.column_values().eq(whole.column_values()), "{whole:?} cut at {cut}");
                assert_eq!(both.column_gaps(), whole.column_gaps());
            }
        }
    }

    #[test]
    fn numbers_that_cannot_form_a_column_are_refused() {
        assert!(matches!(
            FrameNumberColumn::from_scaled_integers(vec![1], 0.0, 0.0),
            Err(ColumnError::Scale { .. })
        ));
        assert!(matches!(
            FrameNumberColumn::from_scaled_integers(vec![1], f64::NAN, 1.0),
            Err(ColumnError::Scale { .. })
        ));
        let short = FrameNumberColumn::from_single_floats(vec![1.0]).with_gaps(&ColumnGaps::from_gap_frames([1]));
        assert_eq!(short, Err(ColumnError::Gap { end: 2, frames: 1 }));
        let mut floats = FrameNumberColumn::from_single_floats(vec![1.0]);
        assert_eq!(
            floats.append_column(&FrameNumberColumn::from_double_floats(vec![1.0])),
            Err(ColumnError::Form("f64"))
        );
    }
}
