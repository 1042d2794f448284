//! Numbers for the page: varying lengths of bytes, and differences.

/// Appends a number: seven bits a byte, the lowest first, the sign in the lowest bit.
pub(super) fn push_coded_number(out: &mut Vec<u8>, number: i64) {
    // Small negative numbers then take as few bytes as small positive ones.
    let mut rest = ((number << 1) ^ (number >> 63)) as u64;
    while rest >= 0x80 {
        out.push(rest as u8 | 0x80);
        rest >>= 7;
    }
    out.push(rest as u8);
}

/// Appends a row of numbers: its order of differences, 0 to 2, then the numbers. Order 0 is a row of equal numbers, and
/// has one number.
pub(super) fn push_row(out: &mut Vec<u8>, row: &[i64]) {
    let Some(&first) = row.first() else { return };
    if row.iter().all(|value| *value == first) {
        out.push(0);
        push_coded_number(out, first);
        return;
    }
    let once = row_differences(row);
    let twice = row_differences(&once);
    let cost = |row: &[i64]| row.iter().map(|value| value.unsigned_abs()).sum::<u64>();
    // Smooth movement has small second differences, noisy movement small first ones.
    let (order, row) = match cost(&twice[1..]) < cost(&once[1..]) {
        true => (2, twice),
        false => (1, once),
    };
    out.push(order);
    row.iter().for_each(|value| push_coded_number(out, *value));
}

/// Returns the differences of each number to the one before; the first is kept.
fn row_differences(row: &[i64]) -> Vec<i64> {
    let before = std::iter::once(0).chain(row.iter().copied());
    row.iter().zip(before).map(|(value, before)| value - before).collect()
}

/// Reads the numbers back, as the page does.
#[cfg(test)]
pub(super) struct CodeReader<'a>(pub(super) &'a [u8]);

#[cfg(test)]
impl CodeReader<'_> {
    pub(super) fn decode_next_number(&mut self) -> i64 {
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

    pub(super) fn decode_number_row(&mut self, length: usize) -> Vec<i64> {
        let order = self.0[0];
        self.0 = &self.0[1..];
        if order == 0 {
            return vec![self.decode_next_number(); length];
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

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn rows_are_read_back(row in prop::collection::vec(-40_000_i64..40_000, 1..60)) {
            let mut bytes = Vec::new();
            push_row(&mut bytes, &row);
            let mut reader = CodeReader(&bytes);
            prop_assert_eq!(reader.decode_number_row(row.len()), row);
            prop_assert!(reader.0.is_empty());
        }
    }
}
