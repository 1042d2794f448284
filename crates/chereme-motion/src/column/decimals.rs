//! Columns of exact decimals, as text files write them.

use std::ops::Range;

use super::number::{ExactDecimal, FileNumber};

/// Exact decimals in one column: value = mantissa / 10^scale, except for the exceptions.
///
/// The scale is the largest number of digits after the point if all numbers fit it in eighteen digits;
/// otherwise (as for `123.4` next to `2e-16`) the scale fits most of them and the others are exceptions.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DecimalColumn {
    /// How many digits of the mantissas are after the point.
    pub scale: u8,
    /// The digits without the point, |mantissa| < 10^18; 0 for an exception.
    pub mantissas: Vec<i64>,
    /// Numbers that do not fit, with their frame in the column, in order.
    pub exceptions: Vec<(u32, FileNumber)>,
}

impl DecimalColumn {
    /// Returns the exact number in a frame, `None` beyond the last.
    #[must_use]
    pub fn exact_number_at(&self, frame: usize) -> Option<FileNumber> {
        let mantissa = *self.mantissas.get(frame)?;
        Some(match self.decimal_exception_at(frame) {
            Some(number) => number.clone(),
            None => FileNumber::Decimal(ExactDecimal {
                mantissa,
                scale: self.scale,
            }),
        })
    }

    /// Returns the correctly rounded `f64` of the number in a frame; NaN beyond the last.
    #[must_use]
    pub fn decimal_value_at(&self, frame: usize) -> f64 {
        match (self.decimal_exception_at(frame), self.mantissas.get(frame)) {
            (Some(number), _) => number.to_f64(),
            (None, Some(&mantissa)) => ExactDecimal {
                mantissa,
                scale: self.scale,
            }
            .to_f64(),
            (None, None) => f64::NAN,
        }
    }

    /// Returns the exception in a frame, if there is one.
    #[must_use]
    pub fn decimal_exception_at(&self, frame: usize) -> Option<&FileNumber> {
        if self.exceptions.is_empty() {
            return None;
        }
        let exception_index = self
            .exceptions
            .binary_search_by_key(&frame, |(at, _)| *at as usize)
            .ok()?;
        self.exceptions.get(exception_index).map(|(_, number)| number)
    }

    /// Returns a column of values rounded to `decimals` digits after the point.
    ///
    /// Returns `None` if any value is not finite, or has more than eighteen digits.
    #[must_use]
    pub fn from_rounded_values(values: impl IntoIterator<Item = f64>, decimals: u8) -> Option<Self> {
        let round = |value| ExactDecimal::from_rounded_value(value, decimals).map(|decimal| decimal.mantissa);
        let mantissas = values.into_iter().map(round).collect::<Option<Vec<_>>>()?;
        Some(Self {
            scale: decimals,
            mantissas,
            exceptions: Vec::new(),
        })
    }

    /// Chooses the scale that fits the most numbers; the smallest of equally good ones.
    pub fn fit_most(&mut self) {
        let numbers: Vec<FileNumber> = (0..self.mantissas.len())
            .filter_map(|frame| self.exact_number_at(frame))
            .collect();
        let decimals = || {
            numbers.iter().filter_map(|number| match number {
                FileNumber::Decimal(decimal) => Some(decimal.trim_trailing_zeros()),
                FileNumber::Text(_) => None,
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
                FileNumber::Decimal(decimal) => decimal.at_scale(self.scale),
                FileNumber::Text(_) => None,
            };
            *slot = fitted.unwrap_or(0);
            if fitted.is_none() {
                self.exceptions.push((frame as u32, number));
            }
        }
    }

    /// Returns the column of `numbers`, each exactly.
    #[must_use]
    pub fn from_exact_numbers(numbers: impl IntoIterator<Item = FileNumber>) -> Self {
        let mut scale = 0;
        let exceptions: Vec<(u32, FileNumber)> = (0..)
            .zip(numbers)
            .inspect(|(_, number)| {
                if let FileNumber::Decimal(decimal) = number {
                    scale = scale.max(decimal.scale);
                }
            })
            .collect();
        let at_scale = |number: &FileNumber| match number {
            FileNumber::Decimal(decimal) => decimal.at_scale(scale),
            FileNumber::Text(_) => None,
        };
        let all: Option<Vec<i64>> = exceptions.iter().map(|(_, number)| at_scale(number)).collect();
        if let Some(mantissas) = all {
            return Self {
                scale,
                mantissas,
                exceptions: Vec::new(),
            };
        }
        let mut column = Self {
            scale: 0,
            mantissas: vec![0; exceptions.len()],
            exceptions,
        };
        column.fit_most();
        column
    }

    /// Returns how many numbers there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.mantissas.len()
    }

    /// Returns whether there are no numbers.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.mantissas.is_empty()
    }

    /// Returns the numbers of the frames `rows`, as far as they exist.
    #[must_use]
    pub fn slice_decimals(&self, rows: Range<usize>) -> Self {
        let end = rows.end.min(self.mantissas.len());
        let start = rows.start.min(end);
        let row_exceptions = self.exceptions.iter().filter_map(|(frame, number)| {
            let frame = *frame as usize;
            (start..end)
                .contains(&frame)
                .then(|| ((frame - start) as u32, number.clone()))
        });
        Self {
            scale: self.scale,
            mantissas: self.mantissas[start..end].to_vec(),
            exceptions: row_exceptions.collect(),
        }
    }

    /// Appends the numbers of `other`; the scale becomes one that fits both.
    pub fn append_decimals(&mut self, other: &Self) {
        if self.is_empty() {
            self.clone_from(other);
            return;
        }
        if self.scale == other.scale {
            let before = self.mantissas.len() as u32;
            self.mantissas.extend_from_slice(&other.mantissas);
            let moved = other.exceptions.iter();
            self.exceptions
                .extend(moved.map(|(frame, number)| (before + frame, number.clone())));
            return;
        }
        let numbers = |column: &Self| {
            (0..column.len())
                .filter_map(|frame| column.exact_number_at(frame))
                .collect::<Vec<_>>()
        };
        *self = Self::from_exact_numbers(numbers(self).into_iter().chain(numbers(other)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(texts: &[&str]) -> DecimalColumn {
        DecimalColumn::from_exact_numbers(texts.iter().map(|text| text.parse().expect("a number")))
    }

    #[test]
    fn every_number_is_kept_whatever_its_size() {
        for texts in [
            &["1.50", "-2", "0"][..],
            &["123.4", "2.8e-15", "0", "1e-300", "12345678901234567890", "-7"],
            &[],
        ] {
            let column = column(texts);
            assert_eq!(column.len(), texts.len());
            for (frame, text) in texts.iter().enumerate() {
                assert_eq!(column.exact_number_at(frame), text.parse().ok(), "{text}");
                assert_eq!(Some(column.decimal_value_at(frame)), text.parse().ok(), "{text}");
            }
        }
        assert_eq!(
            column(&["1.50", "2.5"]).exact_number_at(0).expect("one").to_string(),
            "1.50"
        );
    }

    #[test]
    fn joined_parts_equal_the_whole() {
        let texts = ["1.5", "2", "1e-300", "0.25", "12345678901234567890", "3.125"];
        let whole = column(&texts);
        for cut in 0..=texts.len() {
            let mut both = whole.slice_decimals(0..cut);
            both.append_decimals(&whole.slice_decimals(cut..99));
            let mut apart = column(&texts[..cut]);
            apart.append_decimals(&column(&texts[cut..]));
            for frame in 0..texts.len() {
                assert_eq!(
                    both.exact_number_at(frame),
                    whole.exact_number_at(frame),
                    "{cut} {frame}"
                );
                assert_eq!(
                    apart.exact_number_at(frame),
                    whole.exact_number_at(frame),
                    "{cut} {frame}"
                );
            }
        }
    }
}
