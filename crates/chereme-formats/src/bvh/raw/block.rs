//! A block of frames, column by column.

use super::Number;
use super::digits::ColumnState;
use super::number::{Decimal, MANTISSA_LIMIT, POW10};

/// Some frames of the motion, one column per channel.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Block {
    /// The number of the first frame, counted from 0.
    pub first_frame: u64,
    /// How many frames there are.
    pub frames: usize,
    /// The columns in the order of the file's channels, each of `frames` rows.
    pub columns: Vec<Column>,
}

/// The numbers of one channel: value = mantissa / 10^scale, exceptions aside.
///
/// The scale is the largest number of digits after the point in the block, where all its numbers fit it in eighteen
/// digits; where they do not (as with `123.4` beside `2e-16`), the scale fits most of them and the others are exceptions.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Column {
    /// How many of the mantissas' digits stand after the point.
    pub scale: u8,
    /// The digits without the point, |mantissa| < 10^18; 0 for an exception.
    pub mantissas: Vec<i64>,
    /// Numbers that do not fit, with their frame in the block, in order.
    pub exceptions: Vec<(u32, Number)>,
}

impl Column {
    /// Returns the exact number in a frame of the block, `None` beyond the last.
    #[must_use]
    pub fn number(&self, frame: usize) -> Option<Number> {
        let mantissa = *self.mantissas.get(frame)?;
        Some(match self.exception(frame) {
            Some(number) => number.clone(),
            None => Number::Decimal(Decimal {
                mantissa,
                scale: self.scale,
            }),
        })
    }

    /// Returns the correctly rounded `f64` of the number in a frame of the block; NaN beyond the last.
    #[must_use]
    pub fn value(&self, frame: usize) -> f64 {
        match (self.exception(frame), self.mantissas.get(frame)) {
            (Some(number), _) => number.to_f64(),
            (None, Some(&mantissa)) => Decimal {
                mantissa,
                scale: self.scale,
            }
            .to_f64(),
            (None, None) => f64::NAN,
        }
    }

    /// Returns the exception in a frame of the block, if there is one.
    pub(super) fn exception(&self, frame: usize) -> Option<&Number> {
        if self.exceptions.is_empty() {
            return None;
        }
        let found = self
            .exceptions
            .binary_search_by_key(&frame, |(at, _)| *at as usize)
            .ok()?;
        self.exceptions.get(found).map(|(_, number)| number)
    }

    /// Returns a column of values rounded to `decimals` digits after the point.
    ///
    /// A value that is not finite, or has more than eighteen digits, is `None` of the whole.
    #[must_use]
    pub fn rounded(values: impl IntoIterator<Item = f64>, decimals: u8) -> Option<Self> {
        let round = |value| Decimal::rounded(value, decimals).map(|decimal| decimal.mantissa);
        let mantissas = values.into_iter().map(round).collect::<Option<Vec<_>>>()?;
        Some(Self {
            scale: decimals,
            mantissas,
            exceptions: Vec::new(),
        })
    }

    /// Brings the column to a larger scale; false, and nothing changed, where a number would not fit it.
    pub(super) fn raise(&mut self, scale: u8, pending: &mut [i64]) -> bool {
        let steps = usize::from(scale - self.scale);
        let largest = self
            .mantissas
            .iter()
            .chain(&*pending)
            .map(|m| m.unsigned_abs())
            .max();
        let largest = largest.unwrap_or(0);
        if largest > 0 {
            let Some(&factor) = POW10
                .get(steps)
                .filter(|&&f| largest < (MANTISSA_LIMIT / f) as u64)
            else {
                return false;
            };
            self.mantissas
                .iter_mut()
                .chain(pending)
                .for_each(|m| *m *= factor);
        }
        self.scale = scale;
        true
    }

    /// Brings a finished column to the scale that its own numbers ask for, and returns what the next block starts with.
    pub(super) fn settle(&mut self, state: ColumnState) -> u8 {
        if self
            .exceptions
            .iter()
            .any(|(_, number)| matches!(number, Number::Decimal(_)))
        {
            self.fit_most();
            return 0;
        }
        let rows = self.mantissas.len();
        let lower = self.scale - state.most;
        if state.fewer as usize + self.exceptions.len() == rows && lower > 0 {
            let divisor = POW10
                .get(usize::from(lower))
                .copied()
                .unwrap_or(MANTISSA_LIMIT);
            self.mantissas.iter_mut().for_each(|m| *m /= divisor);
            self.scale = state.most;
        }
        self.scale
    }

    /// Chooses the scale at which the most numbers fit, the smallest of equals.
    fn fit_most(&mut self) {
        let numbers: Vec<Number> = (0..self.mantissas.len())
            .filter_map(|frame| self.number(frame))
            .collect();
        let decimals = || {
            numbers.iter().filter_map(|number| match number {
                Number::Decimal(decimal) => Some(decimal.trimmed()),
                Number::Text(_) => None,
            })
        };
        let mut begin_less_end = [0i64; 512];
        for decimal in decimals() {
            let digits = decimal
                .mantissa
                .unsigned_abs()
                .checked_ilog10()
                .map_or(0, |log| log + 1) as usize;
            let first = usize::from(decimal.scale);
            begin_less_end[first] += 1;
            begin_less_end[first + 19 - digits] -= 1;
        }
        let mut best = (0, 0);
        let mut fitting = 0;
        for (scale, change) in begin_less_end.iter().take(256).enumerate() {
            fitting += change;
            if fitting > best.0 {
                best = (fitting, scale);
            }
        }
        self.scale = u8::try_from(best.1).unwrap_or(u8::MAX);
        self.exceptions.clear();
        for ((frame, number), slot) in numbers.into_iter().enumerate().zip(&mut self.mantissas) {
            let fitted = match &number {
                Number::Decimal(decimal) => decimal.at_scale(self.scale),
                Number::Text(_) => None,
            };
            *slot = fitted.unwrap_or(0);
            if fitted.is_none() {
                self.exceptions.push((frame as u32, number));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn most_numbers_fit_and_none_is_lost() {
        let texts = [
            "123.4",
            "2.82958e-15",
            "0",
            "16.25",
            "1e-300",
            "12345678901234567890",
            "-7",
        ];
        let numbers: Vec<Number> = texts.iter().map(|text| text.parse().unwrap()).collect();
        let exceptions = numbers
            .iter()
            .cloned()
            .enumerate()
            .map(|(i, n)| (i as u32, n))
            .collect();
        let mut column = Column {
            scale: 0,
            mantissas: vec![0; texts.len()],
            exceptions,
        };
        column.settle(ColumnState::default());
        assert_eq!(column.scale, 2);
        assert_eq!(
            column
                .exceptions
                .iter()
                .map(|(frame, _)| *frame)
                .collect::<Vec<_>>(),
            [1, 4, 5]
        );
        for (frame, number) in numbers.iter().enumerate() {
            assert_eq!(column.number(frame).as_ref(), Some(number));
            assert_eq!(column.value(frame), number.to_f64());
        }
    }
}
