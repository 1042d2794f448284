//! The fast path for numbers such as `-12.345678`: eight digits at a time.

use chereme_motion::column::{MANTISSA_LIMIT, POWERS_OF_TEN};

/// Bytes that must be available from the start of a token; the last tokens of a chunk take the slow path.
const TOKEN_REACH_BYTES: usize = 48;

/// Rows gathered before they are spread over the columns: eight make a cache line of each column.
pub(super) const TILE_ROW_COUNT: usize = 8;

/// Eight zeros in ASCII.
const ASCII_ZERO_BYTES: u64 = 0x3030_3030_3030_3030;
/// The high bit of each of eight bytes.
const BYTE_HIGH_BITS: u64 = 0x8080_8080_8080_8080;

/// The state of a column while a block is read.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ColumnState {
    /// The digits after the point that the column's mantissas have.
    scale: u8,
    /// The scale if the fast path supports it (one to eight); otherwise 0, which no number matches.
    quick: u8,
    /// The shift to the left, in bits, that aligns `quick` digits in a word of eight.
    shift: u8,
    /// The most digits after the point among the numbers counted in `fewer`.
    pub(super) most: u8,
    /// The number of numbers in the block that have fewer digits after the point than `scale`.
    pub(super) fewer: u32,
}

impl ColumnState {
    /// Returns the initial state of a column of this scale.
    pub(super) fn new(scale: u8) -> Self {
        let mut state = Self::default();
        state.set_scale(scale);
        state
    }

    /// Returns the digits after the point that the column's mantissas have.
    pub(super) fn column_decimal_scale(&self) -> u8 {
        self.scale
    }

    /// Changes the scale; the caller converts the numbers already read.
    pub(super) fn set_scale(&mut self, scale: u8) {
        self.scale = scale;
        self.quick = if scale <= 8 { scale } else { 0 };
        self.shift = 64 - 8 * self.quick;
    }

    /// Returns the mantissa at the column's scale; `None` if it would have more than eighteen digits or lose one.
    #[inline]
    pub(super) fn fit_column_mantissa(&mut self, mantissa: i64, scale: u8) -> Option<i64> {
        if scale == self.scale {
            return Some(mantissa);
        }
        let factor = *POWERS_OF_TEN.get(usize::from(self.scale.checked_sub(scale)?))?;
        let fitted = mantissa.checked_mul(factor)?;
        if fitted.unsigned_abs() >= MANTISSA_LIMIT as u64 {
            return None;
        }
        self.fewer += 1;
        self.most = self.most.max(scale);
        Some(fitted)
    }
}

/// Reads numbers from the start of the text into a row of the tile, one per column, on one line.
///
/// Returns the number of values and of bytes read: all, or those before the first token that needs the
/// slow path (a line end, an exponent, many digits, anything odd).
pub(super) fn read_numbers(
    text: &[u8],
    row: usize,
    slots: &mut [[i64; TILE_ROW_COUNT]],
    columns: &mut [ColumnState],
) -> (usize, usize) {
    let mut done = 0;
    let mut rest = text;
    for (slot, column) in slots.iter_mut().zip(columns) {
        if let [b' ' | b'\t', ..] = rest {
            rest = &rest[leading_blanks(rest)..];
        }
        let expected = rest.first_chunk().and_then(|window| expected_at(window, *column));
        if let Some((mantissa, end)) = expected {
            slot[row % TILE_ROW_COUNT] = mantissa;
            rest = &rest[end + 1..];
        } else if let Some((mantissa, after)) = any_at(rest, column) {
            slot[row % TILE_ROW_COUNT] = mantissa;
            rest = after;
        } else {
            break;
        }
        done += 1;
    }
    (done, text.len() - rest.len())
}

/// Returns the mantissa of a plain number at the column's scale, and the text after it.
#[inline(never)]
fn any_at<'a>(text: &'a [u8], column: &mut ColumnState) -> Option<(i64, &'a [u8])> {
    let (mantissa, scale, length) = number_at(text)?;
    Some((column.fit_column_mantissa(mantissa, scale)?, &text[length..]))
}

fn leading_blanks(text: &[u8]) -> usize {
    text.iter().take_while(|b| matches!(b, b' ' | b'\t')).count()
}

/// Returns the mantissa and the length of a number written as the column expects it: up to four characters
/// of sign and digits, a point, exactly as many digits as the column's scale (one to eight; no number
/// matches 0), a space.
///
/// The end follows from the position of the point alone, so that the processor can begin the next number
/// early.
#[inline(always)]
fn expected_at(window: &[u8; TOKEN_REACH_BYTES], column: ColumnState) -> Option<(i64, usize)> {
    let word = load_window_word(window, 0);
    let point = first_point(word);
    if point.wrapping_sub(1) >= 4 {
        return None;
    }
    let end = point + 1 + usize::from(column.quick & 15);
    let minus = minus_one_if(word as u8 == b'-');
    let sign_to_zero = minus as u32 & u32::from(b'-' ^ b'0');
    let whole_number = ((word ^ ASCII_ZERO_BYTES) as u32 ^ sign_to_zero) << (32 - 8 * point);
    let fraction = (load_window_word(window, point + 1) ^ ASCII_ZERO_BYTES).wrapping_shl(column.shift.into());
    if window[end] != b' '
        || (high_unless_digits(fraction) | high_unless_digits(whole_number.into())) & BYTE_HIGH_BITS != 0
    {
        return None;
    }
    let size = four_digit_value(whole_number) * POWERS_OF_TEN[usize::from(column.quick & 15)] + eight(fraction);
    Some((apply_number_sign(size, minus), end))
}

/// Returns mantissa, scale and length of a plain number that a blank follows: at most seven digits before the point
/// and fifteen after it, eighteen in all.
#[inline(always)]
fn number_at(text: &[u8]) -> Option<(i64, u8, usize)> {
    let window: &[u8; TOKEN_REACH_BYTES] = text.first_chunk()?;
    let sign = usize::from(window[0] == b'-');
    let minus = minus_one_if(sign == 1);
    let (whole_word, whole_digits) = count_leading_digits(load_window_word(window, sign));
    // Eight bytes were all digits: the number may go on beyond them, and the slow reader takes it.
    if whole_digits == 8 {
        return None;
    }
    let whole_number = eight((whole_word << (56 - 8 * whole_digits)) << 8);
    let point = sign + whole_digits;
    // The mask spares a check of bounds; the point lies within the first nine bytes.
    if window[point & 15] != b'.' {
        let good = whole_digits > 0 && is_end(window[point & 15]);
        return good.then(|| (apply_number_sign(whole_number, minus), 0, point));
    }
    let (word, count) = count_leading_digits(load_window_word(window, point + 1));
    if count == 8 {
        return long_fraction(window, whole_number, minus, point);
    }
    let end = point + 1 + count;
    if !is_end(window[end & 31]) || whole_digits + count == 0 {
        return None;
    }
    let fraction = eight((word << (56 - 8 * count)) << 8);
    Some((
        apply_number_sign(whole_number * POWERS_OF_TEN[count & 7] + fraction, minus),
        count as u8,
        end,
    ))
}

#[inline(never)]
fn long_fraction(window: &[u8; TOKEN_REACH_BYTES], whole: i64, minus: i64, point: usize) -> Option<(i64, u8, usize)> {
    let first = eight(count_leading_digits(load_window_word(window, point + 1)).0);
    let (word, count) = count_leading_digits(load_window_word(window, point + 9));
    let end = point + 9 + count;
    if count == 8 || !is_end(window[end & 31]) {
        return None;
    }
    let second = eight((word << (56 - 8 * count)) << 8);
    let head = whole * POWERS_OF_TEN[8] + first;
    let mantissa = head.checked_mul(POWERS_OF_TEN[count & 7])? + second;
    (mantissa < MANTISSA_LIMIT).then(|| (apply_number_sign(mantissa, minus), 8 + count as u8, end))
}

#[inline(always)]
fn load_window_word(window: &[u8; TOKEN_REACH_BYTES], at: usize) -> u64 {
    let start = at & 31;
    let mut word = [0; 8];
    word.copy_from_slice(&window[start..start + 8]);
    u64::from_le_bytes(word)
}

/// Returns the bytes less `'0'`, and the number of leading digits.
#[inline(always)]
fn count_leading_digits(word: u64) -> (u64, usize) {
    let values = word ^ ASCII_ZERO_BYTES;
    let others = high_unless_digits(values) & BYTE_HIGH_BITS;
    (values, (others.trailing_zeros() / 8) as usize)
}

/// Returns a word whose high bits, up to the first that is set, mark the bytes that are not digits.
#[inline(always)]
fn high_unless_digits(values: u64) -> u64 {
    values.wrapping_add(0x7676_7676_7676_7676) | values
}

/// Returns the index of the first point in eight bytes, 8 if there is no point.
#[inline(always)]
fn first_point(word: u64) -> usize {
    let zero_at_points = word ^ 0x2e2e_2e2e_2e2e_2e2e;
    let point_bits = zero_at_points.wrapping_sub(0x0101_0101_0101_0101) & !zero_at_points & BYTE_HIGH_BITS;
    (point_bits.trailing_zeros() / 8) as usize
}

/// Returns the number that four digit values make, the first in the lowest byte.
#[inline(always)]
fn four_digit_value(values: u32) -> i64 {
    let pairs = values.wrapping_mul(10).wrapping_add(values >> 8) & 0x00ff_00ff;
    i64::from(pairs.wrapping_mul((100 << 16) + 1) >> 16)
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
fn minus_one_if(negative: bool) -> i64 {
    -i64::from(negative)
}

/// Returns `size` with its sign: `minus` is -1 for a negative number, otherwise 0.
#[inline(always)]
fn apply_number_sign(size: i64, minus: i64) -> i64 {
    (size ^ minus) - minus
}

#[inline(always)]
fn is_end(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | b'\r')
}

#[cfg(test)]
mod tests {
    use super::super::{ExactDecimal, FileNumber};
    use super::*;
    use proptest::prelude::*;

    fn padded(token: &str) -> Vec<u8> {
        let mut text = token.as_bytes().to_vec();
        text.extend([b'\n'; TOKEN_REACH_BYTES]);
        text
    }

    #[test]
    fn odd_tokens_take_the_slow_path() {
        for token in [
            "", "-", ".", "-.", "+1", "1e3", "1.5e3", "12345678", "1..2", "1.2.3", "1,5", "nan", "1x", "1.5x",
        ] {
            assert_eq!(number_at(&padded(token)), None, "{token:?}");
        }
    }

    #[test]
    fn plain_tokens_take_the_fast_path() {
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
            let (mantissa, scale, length) = number_at(&padded(token)).expect(token);
            assert_eq!(length, token.len());
            let fast = FileNumber::Decimal(ExactDecimal { mantissa, scale });
            assert_eq!(Ok(fast), FileNumber::parse_file_number(token.as_bytes()), "{token:?}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn fast_and_slow_path_agree(token in "-?[0-9]{0,9}(\\.[0-9]{0,18})?([eEx,.-][0-9]?)?") {
            let fast = number_at(&padded(&token)).map(|(mantissa, scale, _)| FileNumber::from(ExactDecimal { mantissa, scale }));
            if let Some(fast) = fast {
                prop_assert_eq!(Ok(fast), FileNumber::parse_file_number(token.as_bytes()));
            }
        }
    }
}
