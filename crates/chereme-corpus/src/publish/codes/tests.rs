use proptest::prelude::*;

use super::*;

/// Reads the numbers back, as the page does.
pub(in crate::publish) struct CodeReader<'a>(pub(in crate::publish) &'a [u8]);

impl CodeReader<'_> {
    pub(in crate::publish) fn decode_next_number(&mut self) -> i64 {
        let (mut rest, mut shift) = (0_u64, 0);
        loop {
            let byte = self.0[0];
            self.0 = &self.0[1..];
            rest |= u64::from(byte & 0x7F) << shift;
            shift += 7;
            if byte < 0x80 {
                return (rest >> 1) as i64 ^ -((rest & 1) as i64);
            }
        }
    }

    pub(in crate::publish) fn decode_number_row(&mut self, length: usize) -> Vec<i64> {
        let order = self.0[0];
        self.0 = &self.0[1..];
        if order == 0 {
            return vec![self.decode_next_number(); length];
        }
        if order == CORNER_ROW_ORDER {
            let mut row = vec![self.decode_next_number()];
            while row.len() < length {
                let (from, distance) = (row[row.len() - 1] as f64, self.decode_next_number());
                let rise = self.decode_next_number() as f64;
                row.extend((1..=distance).map(|at| (from + rise * at as f64 / distance as f64).round() as i64));
            }
            return row;
        }
        let mut row: Vec<i64> = (0..length).map(|_| self.decode_next_number()).collect();
        for _ in 0..order {
            for at in 1..length {
                row[at] += row[at - 1];
            }
        }
        row
    }
}

proptest! {
    #[test]
    fn rows_are_read_back(row in prop::collection::vec(-40_000_i64..40_000, 1..60)) {
        let mut bytes = Vec::new();
        push_row(&mut bytes, &row);
        let mut reader = CodeReader(&bytes);
        prop_assert_eq!(reader.decode_number_row(row.len()), row);
        prop_assert!(reader.0.is_empty());
    }

    #[test]
    fn close_rows_are_close_and_take_no_more_bytes(
        row in prop::collection::vec(-400_i64..400, 1..200),
        tolerance in 0_i64..40,
    ) {
        let (mut bytes, mut exact) = (Vec::new(), Vec::new());
        push_close_row(&mut bytes, &row, tolerance);
        push_row(&mut exact, &row);
        prop_assert!(bytes.len() <= exact.len());
        let mut reader = CodeReader(&bytes);
        let read = reader.decode_number_row(row.len());
        prop_assert!(reader.0.is_empty());
        prop_assert!(row.iter().zip(&read).all(|(a, b)| (a - b).abs() <= tolerance + 1), "{row:?} {read:?}");
    }
}
