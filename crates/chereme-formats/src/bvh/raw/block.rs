//! A block of frames, column by column.

use chereme_motion::column::{MANTISSA_LIMIT, POWERS_OF_TEN};

use super::digits::ColumnState;
use super::{Column, FileNumber};

/// Some frames of the motion, one column per channel.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MotionBlock {
    /// The number of the first frame, counted from 0.
    pub first_frame: u64,
    /// The number of frames.
    pub frames: usize,
    /// The columns in the order of the file's channels, each of `frames` rows.
    pub columns: Vec<Column>,
}

/// Converts the column to a larger scale; returns false and changes nothing if a number would not fit.
pub(super) fn raise_column_scale(column: &mut Column, scale: u8, pending: &mut [i64]) -> bool {
    let steps = usize::from(scale - column.scale);
    let largest_mantissa = column.mantissas.iter().chain(&*pending).map(|m| m.unsigned_abs()).max();
    let largest = largest_mantissa.unwrap_or(0);
    if largest > 0 {
        let Some(&factor) = POWERS_OF_TEN
            .get(steps)
            .filter(|&&f| largest < (MANTISSA_LIMIT / f) as u64)
        else {
            return false;
        };
        column.mantissas.iter_mut().chain(pending).for_each(|m| *m *= factor);
    }
    column.scale = scale;
    true
}

/// Converts a finished column to the scale that its own numbers need, and returns the scale at which the
/// next block starts.
pub(super) fn settle_column_scale(column: &mut Column, state: ColumnState) -> u8 {
    if column
        .exceptions
        .iter()
        .any(|(_, number)| matches!(number, FileNumber::Decimal(_)))
    {
        column.fit_most();
        return 0;
    }
    let rows = column.mantissas.len();
    let lower = column.scale - state.most;
    if state.fewer as usize + column.exceptions.len() == rows && lower > 0 {
        let divisor = POWERS_OF_TEN.get(usize::from(lower)).copied().unwrap_or(MANTISSA_LIMIT);
        column.mantissas.iter_mut().for_each(|m| *m /= divisor);
        column.scale = state.most;
    }
    column.scale
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_do_not_fit_the_compact_form_are_kept_exactly() {
        let texts = [
            "123.4",
            "2.82958e-15",
            "0",
            "16.25",
            "1e-300",
            "12345678901234567890",
            "-7",
        ];
        let numbers: Vec<FileNumber> = texts.iter().map(|text| text.parse().unwrap()).collect();
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
        settle_column_scale(&mut column, ColumnState::default());
        assert_eq!(column.scale, 2);
        assert_eq!(
            column.exceptions.iter().map(|(frame, _)| *frame).collect::<Vec<_>>(),
            [1, 4, 5]
        );
        for (frame, number) in numbers.iter().enumerate() {
            assert_eq!(column.exact_number_at(frame).as_ref(), Some(number));
            assert_eq!(column.decimal_value_at(frame), number.to_f64());
        }
    }
}
