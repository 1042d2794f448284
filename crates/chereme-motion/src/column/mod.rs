//! Columns of numbers exactly as a file gives them: decimals of text, floats, integers with a scale; gaps stay gaps.
//!
//! ```
//! use chereme_motion::column::{Column, Number};
//!
//! let text = ["1.50", "", "3e-3"].map(|cell| Number::parse(cell.as_bytes()).ok());
//! let column = Column::decimals(text);
//! assert_eq!([column.value(0), column.value(1), column.value(2)], [Some(1.5), None, Some(0.003)]);
//! assert_eq!(column.text(0).as_deref(), Some("1.500"));
//!
//! let raw = Column::integers(vec![-8067, 2868], 0.0, 0.1)?;
//! assert_eq!(raw.value(1), Some(2868.0 * 0.1));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod decimals;
mod gaps;
mod number;

use std::ops::Range;

pub use decimals::Decimals;
pub use gaps::Gaps;
pub use number::{Decimal, MANTISSA_LIMIT, NotANumber, Number, POW10};

/// One number per frame, in the form of the file; some frames may have none.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    numbers: Numbers,
    gaps: Gaps,
}

/// The numbers of a column; at a gap the number is zero and has no meaning.
#[derive(Clone, Debug, PartialEq)]
pub enum Numbers {
    /// Decimals of a text file.
    Decimals(Decimals),
    /// Floats of 32 bits, all finite.
    Singles(Vec<f32>),
    /// Floats of 64 bits, all finite.
    Doubles(Vec<f64>),
    /// Integers with a scale, as C3D and analog converters write them.
    Integers(Integers),
}

/// Integers that represent `(value - zero) * unit`.
#[derive(Clone, Debug, PartialEq)]
pub struct Integers {
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

impl Column {
    /// Returns the column of decimals of text; `None` is a gap.
    #[must_use]
    pub fn decimals(numbers: impl IntoIterator<Item = Option<Number>>) -> Self {
        let mut gaps = Vec::new();
        let numbers = (0..).zip(numbers).map(|(frame, number)| {
            number.unwrap_or_else(|| {
                gaps.push(frame);
                Number::ZERO
            })
        });
        let numbers = Numbers::Decimals(Decimals::of(numbers.collect::<Vec<_>>()));
        Self {
            numbers,
            gaps: Gaps::at(gaps),
        }
    }

    /// Returns the column of 32-bit floats; a float that is not finite is a gap.
    #[must_use]
    pub fn singles(mut values: Vec<f32>) -> Self {
        let gaps = Gaps::at(
            (0..)
                .zip(&values)
                .filter(|(_, v)| !v.is_finite())
                .map(|(f, _)| f),
        );
        values
            .iter_mut()
            .filter(|v| !v.is_finite())
            .for_each(|v| *v = 0.0);
        Self {
            numbers: Numbers::Singles(values),
            gaps,
        }
    }

    /// Returns the column of 64-bit floats; a float that is not finite is a gap.
    #[must_use]
    pub fn doubles(mut values: Vec<f64>) -> Self {
        let gaps = Gaps::at(
            (0..)
                .zip(&values)
                .filter(|(_, v)| !v.is_finite())
                .map(|(f, _)| f),
        );
        values
            .iter_mut()
            .filter(|v| !v.is_finite())
            .for_each(|v| *v = 0.0);
        Self {
            numbers: Numbers::Doubles(values),
            gaps,
        }
    }

    /// Returns the column of integers that represent `(value - zero) * unit`.
    ///
    /// # Errors
    /// [`ColumnError::Scale`] if `zero` or `unit` is not finite, or `unit` is zero.
    pub fn integers(values: Vec<i32>, zero: f64, unit: f64) -> Result<Self, ColumnError> {
        Self::new(
            Numbers::Integers(Integers { values, zero, unit }),
            Gaps::default(),
        )
    }

    /// Returns the column of `numbers` with `gaps`; floats that are not finite are gaps too, and the numbers at gaps
    /// become zero.
    ///
    /// # Errors
    /// [`ColumnError`] if a gap lies after the last number, or the zero or unit of integers is invalid.
    pub fn new(numbers: Numbers, gaps: Gaps) -> Result<Self, ColumnError> {
        let column = match numbers {
            Numbers::Singles(values) => Self::singles(values),
            Numbers::Doubles(values) => Self::doubles(values),
            Numbers::Integers(Integers { zero, unit, .. })
                if !zero.is_finite() || !unit.is_finite() || unit == 0.0 =>
            {
                return Err(ColumnError::Scale { zero, unit });
            }
            numbers => Self {
                numbers,
                gaps: Gaps::default(),
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
    pub fn with_gaps(mut self, gaps: &Gaps) -> Result<Self, ColumnError> {
        let (end, frames) = (gaps.end(), self.len());
        if end > frames {
            return Err(ColumnError::Gap { end, frames });
        }
        for run in gaps.runs() {
            let own = run.start as usize..run.end as usize;
            match &mut self.numbers {
                Numbers::Decimals(decimals) => {
                    decimals.mantissas[own].fill(0);
                    decimals
                        .exceptions
                        .retain(|(frame, _)| !run.contains(frame));
                }
                Numbers::Singles(values) => values[own].fill(0.0),
                Numbers::Doubles(values) => values[own].fill(0.0),
                Numbers::Integers(integers) => integers.values[own].fill(0),
            }
        }
        self.gaps.append(0, gaps);
        Ok(self)
    }

    /// Returns the numbers in the form of the file; they have no meaning at gaps.
    #[must_use]
    pub fn numbers(&self) -> &Numbers {
        &self.numbers
    }

    /// Returns the numbers in the form of the file; they have no meaning at gaps.
    #[must_use]
    pub fn into_numbers(self) -> Numbers {
        self.numbers
    }

    /// Returns the frames without a number.
    #[must_use]
    pub fn gaps(&self) -> &Gaps {
        &self.gaps
    }

    /// Returns how many frames there are, including gaps.
    #[must_use]
    pub fn len(&self) -> usize {
        match &self.numbers {
            Numbers::Decimals(decimals) => decimals.len(),
            Numbers::Singles(values) => values.len(),
            Numbers::Doubles(values) => values.len(),
            Numbers::Integers(integers) => integers.values.len(),
        }
    }

    /// Returns whether there are no frames.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the number in a frame as the nearest `f64`, `None` in a gap and after the last frame.
    #[must_use]
    pub fn value(&self, frame: usize) -> Option<f64> {
        if frame >= self.len() || (!self.gaps.is_empty() && self.gaps.holds(frame)) {
            return None;
        }
        Some(match &self.numbers {
            Numbers::Decimals(decimals) => decimals.value(frame),
            Numbers::Singles(values) => f64::from(values[frame]),
            Numbers::Doubles(values) => values[frame],
            Numbers::Integers(integers) => {
                (f64::from(integers.values[frame]) - integers.zero) * integers.unit
            }
        })
    }

    /// Returns every frame's number as the nearest `f64`, `None` in gaps.
    pub fn values(&self) -> impl Iterator<Item = Option<f64>> + '_ {
        (0..self.len()).map(|frame| self.value(frame))
    }

    /// Returns the number in a frame as text that reads back as the same number: decimals unchanged, floats with the
    /// fewest digits, integers as their value; `None` in a gap and after the last frame.
    #[must_use]
    pub fn text(&self, frame: usize) -> Option<String> {
        let value = self.value(frame)?;
        Some(match &self.numbers {
            Numbers::Decimals(decimals) => decimals.number(frame)?.to_string(),
            Numbers::Singles(values) => values[frame].to_string(),
            Numbers::Doubles(_) | Numbers::Integers(_) => value.to_string(),
        })
    }

    /// Returns the frames `rows`, as far as they exist.
    #[must_use]
    pub fn slice(&self, rows: Range<usize>) -> Self {
        let end = rows.end.min(self.len());
        let rows = rows.start.min(end)..end;
        let gaps = self.gaps.slice(rows.clone());
        let numbers = match &self.numbers {
            Numbers::Decimals(decimals) => Numbers::Decimals(decimals.slice(rows)),
            Numbers::Singles(values) => Numbers::Singles(values[rows].to_vec()),
            Numbers::Doubles(values) => Numbers::Doubles(values[rows].to_vec()),
            Numbers::Integers(integers) => Numbers::Integers(Integers {
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
    pub fn append(&mut self, other: &Self) -> Result<(), ColumnError> {
        let before = self.len();
        match (&mut self.numbers, &other.numbers) {
            (Numbers::Decimals(own), Numbers::Decimals(more)) => own.append(more),
            (Numbers::Singles(own), Numbers::Singles(more)) => own.extend_from_slice(more),
            (Numbers::Doubles(own), Numbers::Doubles(more)) => own.extend_from_slice(more),
            (Numbers::Integers(own), Numbers::Integers(more))
                if own.zero == more.zero && own.unit == more.unit =>
            {
                own.values.extend_from_slice(&more.values);
            }
            (_, other) => return Err(ColumnError::Form(other.form())),
        }
        self.gaps.append(before, &other.gaps);
        Ok(())
    }
}

impl Numbers {
    /// Returns the name of the form: `decimals`, `f32`, `f64` or `integers`.
    #[must_use]
    pub fn form(&self) -> &'static str {
        match self {
            Self::Decimals(_) => "decimals",
            Self::Singles(_) => "f32",
            Self::Doubles(_) => "f64",
            Self::Integers(_) => "integers",
        }
    }
}

impl From<Decimals> for Column {
    fn from(decimals: Decimals) -> Self {
        Self {
            numbers: Numbers::Decimals(decimals),
            gaps: Gaps::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn forms() -> Vec<Column> {
        let texts = ["1.50", "", "-2e-3", "7", ""];
        vec![
            Column::decimals(texts.map(|text| text.parse().ok())),
            Column::singles(vec![0.1, f32::NAN, -0.0, f32::MAX, f32::INFINITY]),
            Column::doubles(vec![0.1, f64::NAN, -0.0, f64::MIN_POSITIVE, f64::INFINITY]),
            Column::integers(vec![-32768, 1, 2, 32767, 5], 2.0, 0.05)
                .and_then(|column| column.with_gaps(&Gaps::at([1, 4])))
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
            let form = column.numbers().form();
            let found: Vec<Option<f64>> = column.values().collect();
            assert_eq!(
                found,
                [
                    Some(values[0]),
                    None,
                    Some(values[1]),
                    Some(values[2]),
                    None
                ],
                "{form}"
            );
            for frame in 0..7 {
                let text = column.text(frame);
                assert_eq!(text.is_some(), column.value(frame).is_some(), "{form}");
                let single = matches!(column.numbers(), Numbers::Singles(_));
                let read = text.map(|text| match single {
                    true => f64::from(text.parse::<f32>().expect("a number")),
                    false => text.parse().expect("a number"),
                });
                assert_eq!(read, column.value(frame), "{form} {frame}");
            }
        }
    }

    #[test]
    fn joined_parts_equal_the_whole() {
        for whole in forms() {
            for cut in 0..=5 {
                let mut both = whole.slice(0..cut);
                both.append(&whole.slice(cut..9)).expect("one form");
                assert!(both.values().eq(whole.values()), "{whole:?} cut at {cut}");
                assert_eq!(both.gaps(), whole.gaps());
            }
        }
    }

    #[test]
    fn numbers_that_cannot_form_a_column_are_refused() {
        assert!(matches!(
            Column::integers(vec![1], 0.0, 0.0),
            Err(ColumnError::Scale { .. })
        ));
        assert!(matches!(
            Column::integers(vec![1], f64::NAN, 1.0),
            Err(ColumnError::Scale { .. })
        ));
        let short = Column::singles(vec![1.0]).with_gaps(&Gaps::at([1]));
        assert_eq!(short, Err(ColumnError::Gap { end: 2, frames: 1 }));
        let mut floats = Column::singles(vec![1.0]);
        assert_eq!(
            floats.append(&Column::doubles(vec![1.0])),
            Err(ColumnError::Form("f64"))
        );
    }
}
