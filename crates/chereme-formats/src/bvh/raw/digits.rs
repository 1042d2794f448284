//! The fast road for numbers such as `-12.345678`: eight digits at a time.

use super::number::{MANTISSA_LIMIT, POW10};

/// How many bytes from the start of a token must be there; the last tokens of a piece take the slow road.
const REACH: usize = 48;

/// What is known of a column while a block is read.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ColumnState {
    /// The digits after the point that the column's mantissas have.
    pub(super) scale: u8,
    /// The most digits after the point among the numbers counted in `fewer`.
    pub(super) most: u8,
    /// How many numbers of the block have fewer digits after the point than `scale`.
    pub(super) fewer: u32,
}

impl ColumnState {
    /// Returns the mantissa at the column's scale; `None` if it would have more than eighteen digits or lose one.
    #[inline]
    pub(super) fn fit(&mut self, mantissa: i64, scale: u8) -> Option<i64> {
        if scale == self.scale {
            return Some(mantissa);
        }
        let factor = *POW10.get(usize::from(self.scale.checked_sub(scale)?))?;
        let fitted = mantissa.checked_mul(factor)?;
        if fitted.unsigned_abs() >= MANTISSA_LIMIT as u64 {
            return None;
        }
        self.fewer += 1;
        self.most = self.most.max(scale);
        Some(fitted)
    }
}

/// Reads numbers from `at` into the slots, one per column, on one line.
///
/// Returns how many were read and the place after the last: all, or those before the first token that needs the
/// slow road (a line end, an exponent, many digits, anything odd).
pub(super) fn read_numbers(
    text: &[u8],
    mut at: usize,
    slots: &mut [i64],
    columns: &mut [ColumnState],
) -> (usize, usize) {
    let mut done = 0;
    for (slot, column) in slots.iter_mut().zip(columns) {
        let mut start = at;
        while let Some(b' ' | b'\t') = text.get(start) {
            start += 1;
        }
        let Some((mantissa, scale, length)) = number_at(text, start) else {
            break;
        };
        let Some(fitted) = column.fit(mantissa, scale) else {
            break;
        };
        *slot = fitted;
        at = start + length;
        done += 1;
    }
    (done, at)
}

/// Returns mantissa, scale and length of a plain number that a blank follows: at most seven digits before the point
/// and fifteen after it, eighteen in all.
#[inline(always)]
fn number_at(text: &[u8], at: usize) -> Option<(i64, u8, usize)> {
    let window: &[u8; REACH] = text.get(at..)?.first_chunk()?;
    let negative = window[0] == b'-';
    let sign = usize::from(negative);
    let (whole_word, whole_digits) = digits(load(window, sign));
    if whole_digits == 8 {
        return None;
    }
    let whole = eight((whole_word << (56 - 8 * whole_digits)) << 8);
    let point = sign + whole_digits;
    if window[point & 15] != b'.' {
        let good = whole_digits > 0 && is_end(window[point & 15]);
        return good.then(|| (signed(whole, negative), 0, point));
    }
    let (word, count) = digits(load(window, point + 1));
    if count == 8 {
        return long_fraction(window, whole, negative, point);
    }
    let end = point + 1 + count;
    if !is_end(window[end & 31]) || whole_digits + count == 0 {
        return None;
    }
    let fraction = eight((word << (56 - 8 * count)) << 8);
    Some((
        signed(whole * POW10[count & 7] + fraction, negative),
        count as u8,
        end,
    ))
}

#[inline(never)]
fn long_fraction(
    window: &[u8; REACH],
    whole: i64,
    negative: bool,
    point: usize,
) -> Option<(i64, u8, usize)> {
    let first = eight(digits(load(window, point + 1)).0);
    let (word, count) = digits(load(window, point + 9));
    let end = point + 9 + count;
    if count == 8 || !is_end(window[end & 31]) {
        return None;
    }
    let second = eight((word << (56 - 8 * count)) << 8);
    let head = whole * POW10[8] + first;
    let mantissa = head.checked_mul(POW10[count & 7])? + second;
    (mantissa < MANTISSA_LIMIT).then(|| (signed(mantissa, negative), 8 + count as u8, end))
}

#[inline(always)]
fn load(window: &[u8; REACH], at: usize) -> u64 {
    let at = at & 31;
    let mut word = [0; 8];
    word.copy_from_slice(&window[at..at + 8]);
    u64::from_le_bytes(word)
}

/// Returns the bytes less `'0'`, and how many of the first are digits.
#[inline(always)]
fn digits(word: u64) -> (u64, usize) {
    let values = word ^ 0x3030_3030_3030_3030;
    let others = (values.wrapping_add(0x7676_7676_7676_7676) | values) & 0x8080_8080_8080_8080;
    (values, (others.trailing_zeros() / 8) as usize)
}

/// Returns the number that eight digit values make, the first in the lowest byte.
#[inline(always)]
fn eight(values: u64) -> i64 {
    let pairs = values.wrapping_mul(10).wrapping_add(values >> 8);
    let low = (pairs & 0x0000_00ff_0000_00ff).wrapping_mul(0x000f_4240_0000_0064);
    let high = ((pairs >> 16) & 0x0000_00ff_0000_00ff).wrapping_mul(0x0000_2710_0000_0001);
    (low.wrapping_add(high) >> 32) as i64
}

#[inline(always)]
fn signed(value: i64, negative: bool) -> i64 {
    if negative { -value } else { value }
}

#[inline(always)]
fn is_end(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | b'\r')
}

#[cfg(test)]
mod tests {
    use super::super::number::{Decimal, Number, parse_number};
    use super::*;
    use proptest::prelude::*;

    fn padded(token: &str) -> Vec<u8> {
        let mut text = token.as_bytes().to_vec();
        text.extend([b'\n'; REACH]);
        text
    }

    #[test]
    fn odd_tokens_take_the_slow_road() {
        for token in [
            "", "-", ".", "-.", "+1", "1e3", "1.5e3", "12345678", "1..2", "1.2.3", "1,5", "nan",
            "1x", "1.5x",
        ] {
            assert_eq!(number_at(&padded(token), 0), None, "{token:?}");
        }
    }

    #[test]
    fn plain_tokens_take_the_fast_road() {
        for token in [
            "0",
            "-0",
            "5.",
            ".5",
            "-.0083333",
            "1234567.1234567",
            "0.016666666666666",
            "0.12345678",
            "-1.123456789",
        ] {
            let (mantissa, scale, length) = number_at(&padded(token), 0).expect(token);
            assert_eq!(length, token.len());
            let fast = Number::Decimal(Decimal { mantissa, scale });
            assert_eq!(Ok(fast), parse_number(token.as_bytes()), "{token:?}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn both_roads_agree(token in "-?[0-9]{0,9}(\\.[0-9]{0,18})?([eEx,.-][0-9]?)?") {
            let fast = number_at(&padded(&token), 0).map(|(mantissa, scale, _)| Number::from(Decimal { mantissa, scale }));
            if let Some(fast) = fast {
                prop_assert_eq!(Ok(fast), parse_number(token.as_bytes()));
            }
        }
    }
}
