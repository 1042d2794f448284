//! Times that are written as decimal numbers.

/// The largest time that is read, in microseconds: 1e9 seconds.
const MAX_MARKUP_MICROS: i128 = 1_000_000_000_000_000;

/// Returns a decimal number of seconds in microseconds, halves rounded away from 0; nothing if it is no number or
/// beyond 1e9 seconds. A comma may stand for the point.
pub(crate) fn parse_decimal_seconds(text: &str) -> Option<i64> {
    parse_scaled_decimal(text, 6)
}

/// Returns a decimal number of milliseconds in microseconds, as [`parse_decimal_seconds`] does.
pub(crate) fn parse_decimal_millis(text: &str) -> Option<i64> {
    parse_scaled_decimal(text, 3)
}

/// Returns `text` times ten to the power of `places`, rounded.
fn parse_scaled_decimal(text: &str, places: i32) -> Option<i64> {
    let text = text.trim();
    let (number, exponent) = match text.split_once(['e', 'E']) {
        Some((number, exponent)) => (number, exponent.parse::<i32>().ok()?),
        None => (text, 0),
    };
    let (negative, digits) = match number.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, number.strip_prefix('+').unwrap_or(number)),
    };
    let (whole, fraction) = digits.split_once(['.', ',']).unwrap_or((digits, ""));
    let plain = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
    if !plain(whole) || !plain(fraction) || whole.len() + fraction.len() == 0 {
        return None;
    }
    let mut scale = exponent.checked_add(places)?;
    let mut value: i128 = 0;
    for (at, digit) in whole.bytes().chain(fraction.bytes()).enumerate() {
        // 30 digits hold every time; further ones of the fraction do not count.
        if value < 10_i128.pow(30) {
            value = value * 10 + i128::from(digit - b'0');
            scale = scale.checked_sub(i32::from(at >= whole.len()))?;
        } else {
            scale = scale.checked_add(i32::from(at < whole.len()))?;
        }
    }
    let scaled = match u32::try_from(scale) {
        _ if value == 0 => 0,
        Ok(up) => value.checked_mul(10_i128.checked_pow(up)?)?,
        Err(_) => match 10_i128.checked_pow(scale.unsigned_abs()) {
            Some(unit) => (value + unit / 2) / unit,
            None => 0,
        },
    };
    let signed = if negative { -scaled } else { scaled };
    (signed.abs() <= MAX_MARKUP_MICROS)
        .then(|| i64::try_from(signed).ok())
        .flatten()
}

#[cfg(test)]
mod tests {
    use super::parse_decimal_seconds;

    #[test]
    fn decimals_are_exact() {
        for (text, expected) in [
            ("0", Some(0)),
            ("1.2", Some(1_200_000)),
            ("1,2", Some(1_200_000)),
            (" -0.25 ", Some(-250_000)),
            ("+.5", Some(500_000)),
            ("7.", Some(7_000_000)),
            ("1.2E-4", Some(120)),
            ("1.2345E3", Some(1_234_500_000)),
            ("0.0000005", Some(1)),
            ("-0.0000005", Some(-1)),
            ("1.2000000476837158", Some(1_200_000)),
            ("0.1234564999999999999999999999999999999999", Some(123_456)),
            ("1000000000", Some(1_000_000_000_000_000)),
            ("1000000000.1", None),
            ("1e400", None),
            ("1e-400", Some(0)),
            ("0e400", Some(0)),
            ("1e99999999999", None),
            ("99999999999999999999999999999999999999999999", None),
            ("", None),
            (".", None),
            ("NaN", None),
            ("1:30", None),
            ("0x10", None),
        ] {
            assert_eq!(parse_decimal_seconds(text), expected, "{text}");
        }
    }
}
