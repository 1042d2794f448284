//! Numbers as a text file writes them: exact decimals.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// The bound of a [`ExactDecimal`]'s mantissa, which has at most eighteen digits: |mantissa| < 10^18.
pub const MANTISSA_LIMIT: i64 = 1_000_000_000_000_000_000;

/// Powers of ten that an `i64` holds.
pub const POWERS_OF_TEN: [i64; 19] = {
    let mut table = [1i64; 19];
    let mut i = 1;
    while i < 19 {
        table[i] = table[i - 1] * 10;
        i += 1;
    }
    table
};

/// Powers of ten that an `f64` holds exactly.
const POW10_F64: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];

/// An exact decimal of at most eighteen digits: `mantissa / 10^scale`.
///
/// The scale is the number of digits after the point as written, so that `1.50` is written back unchanged; equality
/// compares values: `1.50 == 1.5`, `-0 == 0`.
#[derive(Clone, Copy, Debug, Default)]
pub struct ExactDecimal {
    /// The digits without the point, |mantissa| < 10^18.
    pub mantissa: i64,
    /// How many of the digits are after the point.
    pub scale: u8,
}

impl ExactDecimal {
    /// Returns the correctly rounded `f64` of the decimal.
    #[must_use]
    pub fn to_f64(self) -> f64 {
        // Up to 2⁵³ and 10²² both operands are exact, so that one division rounds correctly.
        let exact_in_f64 = self.mantissa.unsigned_abs() <= 1 << 53;
        match POW10_F64.get(usize::from(self.scale)) {
            Some(power) if exact_in_f64 => self.mantissa as f64 / power,
            _ => format!("{}e-{}", self.mantissa, self.scale).parse().unwrap_or(f64::NAN),
        }
    }

    /// Returns the `f64` rounded to `decimals` digits after the point.
    ///
    /// Returns `None` if the value is not finite or needs more than eighteen digits.
    #[must_use]
    pub fn from_rounded_value(value: f64, decimals: u8) -> Option<Self> {
        let scaled = (value * POW10_F64.get(usize::from(decimals))?).round();
        (scaled.abs() < MANTISSA_LIMIT as f64).then_some(Self {
            mantissa: scaled as i64,
            scale: decimals,
        })
    }

    /// Returns the mantissa of the same value with another scale; `None` if digits would be lost, or more than eighteen
    /// were needed.
    #[must_use]
    pub fn at_scale(self, scale: u8) -> Option<i64> {
        if scale >= self.scale {
            let factor = *POWERS_OF_TEN.get(usize::from(scale - self.scale))?;
            // Digits lost would make another number of it.
            self.mantissa.checked_mul(factor).filter(|m| m.abs() < MANTISSA_LIMIT)
        } else {
            let divisor = *POWERS_OF_TEN.get(usize::from(self.scale - scale))?;
            (self.mantissa % divisor == 0).then(|| self.mantissa / divisor)
        }
    }

    /// Returns the same value without zeros at the end.
    #[must_use]
    pub fn trim_trailing_zeros(mut self) -> Self {
        while self.scale > 0 && self.mantissa % 10 == 0 {
            self.mantissa /= 10;
            self.scale -= 1;
        }
        self
    }

    /// Appends the decimal to the text, with exactly `scale` digits after the point.
    pub fn push_to(self, text: &mut Vec<u8>) {
        push_decimal(text, self);
    }
}

impl PartialEq for ExactDecimal {
    fn eq(&self, other: &Self) -> bool {
        let (a, b) = (self.trim_trailing_zeros(), other.trim_trailing_zeros());
        (a.mantissa, a.scale) == (b.mantissa, b.scale)
    }
}

impl Eq for ExactDecimal {}

impl fmt::Display for ExactDecimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = Vec::with_capacity(24);
        push_decimal(&mut text, *self);
        f.write_str(&String::from_utf8_lossy(&text))
    }
}

/// Appends the decimal to the text, with exactly `scale` digits after the point.
fn push_decimal(text: &mut Vec<u8>, ExactDecimal { mantissa, scale }: ExactDecimal) {
    const DIGIT_PAIRS: &[u8; 200] = b"0001020304050607080910111213141516171819\
2021222324252627282930313233343536373839\
4041424344454647484950515253545556575859\
6061626364656667686970717273747576777879\
8081828384858687888990919293949596979899";
    // Twenty digits hold any u64.
    let mut digits = [b'0'; 20];
    let mut start = digits.len();
    let mut rest = mantissa.unsigned_abs();
    while rest >= 10 {
        let pair = (rest % 100) as usize * 2;
        rest /= 100;
        start -= 2;
        digits[start..start + 2].copy_from_slice(&DIGIT_PAIRS[pair..pair + 2]);
    }
    // A zero leaves no digit here and is written below.
    if rest > 0 {
        start -= 1;
        digits[start] = b'0' + rest as u8;
    }
    if mantissa < 0 {
        text.push(b'-');
    }
    let (scale, count) = (usize::from(scale), digits.len() - start);
    if count > scale {
        // A value below one has no digits before the point; files write a zero there.
        text.extend_from_slice(&digits[start..digits.len() - scale]);
    } else {
        text.push(b'0');
    }
    if scale > 0 {
        text.push(b'.');
        text.extend(std::iter::repeat_n(b'0', scale.saturating_sub(count)));
        text.extend_from_slice(&digits[digits.len() - scale.min(count)..]);
    }
}

/// A number as a file gives it: a [`ExactDecimal`], or the original text if it has too many digits.
///
/// Equality compares values whatever the form: `1e-3 == 0.001`, `-0 == 0`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum FileNumber {
    /// A number of at most eighteen digits.
    Decimal(ExactDecimal),
    /// The original text of a number with more digits than a [`ExactDecimal`] holds; it parses and is finite.
    Text(Box<str>),
}

impl FileNumber {
    /// The number zero.
    pub const ZERO_NUMBER: Self = Self::Decimal(ExactDecimal { mantissa: 0, scale: 0 });

    /// Reads a number from a token of a file, such as `-1.50` or `3e-3`.
    ///
    /// # Errors
    /// [`NotANumber`] for text that is not a finite decimal number.
    pub fn parse_file_number(token: &[u8]) -> Result<Self, NotANumber> {
        parse_number(token)
    }

    /// Returns the correctly rounded `f64` of the number.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        match self {
            Self::Decimal(decimal) => decimal.to_f64(),
            Self::Text(text) => text.parse().unwrap_or(f64::NAN),
        }
    }

    /// Appends the number's text.
    pub fn push_to(&self, text: &mut Vec<u8>) {
        match self {
            Self::Decimal(decimal) => decimal.push_to(text),
            Self::Text(original) => text.extend_from_slice(original.as_bytes()),
        }
    }

    /// Returns the sign, the digits without zeros at either end, and the power of ten of the last digit.
    fn canonical(&self) -> (bool, String, i64) {
        let text = self.to_string();
        let parts = NumberParts::parse_number_parts(text.as_bytes()).unwrap_or_default();
        let digits: String = parts
            .whole
            .iter()
            .chain(parts.fraction)
            .map(|&b| char::from(b))
            .collect();
        let trimmed = digits.trim_end_matches('0');
        let dropped = (digits.len() - trimmed.len()) as i64;
        let significant = trimmed.trim_start_matches('0').to_owned();
        // Zero has no sign and no exponent, or -0 would differ from 0.
        if significant.is_empty() {
            return (false, significant, 0);
        }
        let exponent = parts
            .exponent
            .saturating_sub(parts.fraction.len() as i64)
            .saturating_add(dropped);
        (parts.negative, significant, exponent)
    }
}

impl Default for FileNumber {
    fn default() -> Self {
        Self::ZERO_NUMBER
    }
}

impl PartialEq for FileNumber {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Decimal(a), Self::Decimal(b)) => a == b,
            (a, b) => a.canonical() == b.canonical(),
        }
    }
}

impl Eq for FileNumber {}

impl From<ExactDecimal> for FileNumber {
    fn from(decimal: ExactDecimal) -> Self {
        Self::Decimal(decimal)
    }
}

impl fmt::Display for FileNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Decimal(decimal) => decimal.fmt(f),
            Self::Text(text) => f.write_str(text),
        }
    }
}

crate::keep_as_text!(FileNumber);

impl FromStr for FileNumber {
    type Err = NotANumber;

    fn from_str(text: &str) -> Result<Self, NotANumber> {
        parse_number(text.as_bytes())
    }
}

/// Why a token is not a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotANumber {
    /// `nan`, `inf` and their like.
    #[error("is not a finite number")]
    NotFinite,
    /// A number with a comma in place of the point.
    #[error("has a decimal comma")]
    Comma,
    /// A number beyond the largest `f64`.
    #[error("is larger than any number a program can hold")]
    TooLarge,
    /// Any other text.
    #[error("is not a number")]
    Garbage,
}

/// Reads a number from a token.
fn parse_number(token: &[u8]) -> Result<FileNumber, NotANumber> {
    let parts = NumberParts::parse_number_parts(token).ok_or_else(|| why_not(token))?;
    if let Some(decimal) = parts.to_exact_decimal() {
        return Ok(FileNumber::Decimal(decimal));
    }
    let text = std::str::from_utf8(token).map_err(|_| NotANumber::Garbage)?;
    // No f64 overflows below 10³⁰⁰, so that the slow parse is left to larger ones.
    let surely_finite = parts.exponent.saturating_add(parts.whole.len() as i64) <= 300;
    if surely_finite || text.parse().is_ok_and(f64::is_finite) {
        return Ok(FileNumber::Text(text.into()));
    }
    Err(NotANumber::TooLarge)
}

fn why_not(token: &[u8]) -> NotANumber {
    let bare = token
        .strip_prefix(b"-")
        .or(token.strip_prefix(b"+"))
        .unwrap_or(token)
        .to_ascii_lowercase();
    // Only a number with a comma instead of the point is reported so; lists of numbers are not.
    let dotted: Vec<u8> = token.iter().map(|&b| if b == b',' { b'.' } else { b }).collect();
    // Windows prints infinities and undefined numbers as 1.#INF and 1.#IND.
    let not_finite = [&b"nan"[..], b"inf", b"1.#", b"-1.#"]
        .iter()
        .any(|word| bare.starts_with(word));
    if not_finite {
        NotANumber::NotFinite
    } else if token.contains(&b',') && NumberParts::parse_number_parts(&dotted).is_some() {
        NotANumber::Comma
    } else {
        NotANumber::Garbage
    }
}

/// The parts of a number's text.
#[derive(Default)]
struct NumberParts<'a> {
    negative: bool,
    whole: &'a [u8],
    fraction: &'a [u8],
    exponent: i64,
}

impl<'a> NumberParts<'a> {
    /// Returns the parts of `[+-]digits[.digits][e[+-]digits]`, `None` for anything else.
    fn parse_number_parts(token: &'a [u8]) -> Option<Self> {
        let (negative, rest) = split_number_sign(token);
        let (whole, rest) = rest.split_at(leading_digits(rest));
        let (fraction, rest) = match rest.strip_prefix(b".") {
            Some(after) => after.split_at(leading_digits(after)),
            None => (&rest[..0], rest),
        };
        if whole.is_empty() && fraction.is_empty() {
            return None;
        }
        let exponent = match rest {
            [] => 0,
            [b'e' | b'E', digits @ ..] => exponent(digits)?,
            _ => return None,
        };
        Some(Self {
            negative,
            whole,
            fraction,
            exponent,
        })
    }

    fn to_exact_decimal(&self) -> Option<ExactDecimal> {
        let mut mantissa = 0i64;
        for &digit in self.whole.iter().chain(self.fraction) {
            mantissa = mantissa
                .checked_mul(10)?
                .checked_add(i64::from(digit - b'0'))
                .filter(|&longer| longer < MANTISSA_LIMIT)?;
        }
        let mut scale = (self.fraction.len() as i64).saturating_sub(self.exponent);
        // An exponent beyond the digits: 3e3 is 3000 without a fraction.
        if scale < 0 && mantissa != 0 {
            let factor = POWERS_OF_TEN.get(usize::try_from(-scale).ok()?)?;
            mantissa = mantissa.checked_mul(*factor).filter(|&m| m < MANTISSA_LIMIT)?;
        }
        if mantissa == 0 {
            // Zero with a huge exponent is still zero, and its scale is only a way of writing it.
            scale = scale.clamp(0, 18);
        }
        let signed = if self.negative { -mantissa } else { mantissa };
        Some(ExactDecimal {
            mantissa: signed,
            scale: u8::try_from(scale.max(0)).ok()?,
        })
    }
}

fn split_number_sign(token: &[u8]) -> (bool, &[u8]) {
    match token {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        rest => (false, rest),
    }
}

fn leading_digits(text: &[u8]) -> usize {
    text.iter().take_while(|b| b.is_ascii_digit()).count()
}

/// Returns the exponent, clamped to a thousand million, since no number needs more.
fn exponent(text: &[u8]) -> Option<i64> {
    let (negative, digits) = split_number_sign(text);
    if digits.is_empty() || leading_digits(digits) < digits.len() {
        return None;
    }
    let size = digits
        .iter()
        .fold(0i64, |size, &b| (size * 10 + i64::from(b - b'0')).min(1_000_000_000));
    Some(if negative { -size } else { size })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn number(text: &str) -> FileNumber {
        text.parse().unwrap_or_else(|why| panic!("{text:?} {why}"))
    }

    #[test]
    fn numbers_are_compared_as_decimals() {
        let equal = [
            ("1.50", "1.5"),
            ("-0", "0"),
            ("-0.000", "0"),
            ("1e-3", "0.001"),
            ("1.5E+2", "150"),
            (".5", "0.5"),
            ("5.", "5"),
            ("+5", "5"),
            ("0e-400", "0"),
            ("12345678901234567890.5", "12345678901234567890.50"),
            ("0.99999999999999988898", "0.999999999999999888980"),
            ("1e18", "1000000000000000000.0"),
            ("0.1490116119384765625", "1490116119384765625e-19"),
            ("1e-300", "0.1e-299"),
        ];
        for (a, b) in equal {
            assert_eq!(number(a), number(b), "{a} {b}");
        }
        for (a, b) in [("1.5", "1.50001"), ("1", "-1"), ("1e-300", "1e-301"), ("1e-300", "0")] {
            assert_ne!(number(a), number(b), "{a} {b}");
        }
    }

    #[test]
    fn numbers_of_twenty_digits_are_exact() {
        for text in [
            "0.99999999999999988898",
            "-0.92233720368547758079",
            "999999999999999999",
            "9999999999999999999",
            "922337203685477580.7",
            "0.0000000000000000000099999999999999999999",
        ] {
            assert_eq!(number(text).to_f64(), text.parse::<f64>().expect(text), "{text}");
        }
    }

    #[test]
    fn the_text_of_a_number_is_kept() {
        for text in [
            "1.50",
            "0",
            "0.000001",
            "-0.5",
            "10",
            "100.00",
            "7",
            "-123456789.012345678",
            "99",
            "1000000",
        ] {
            assert_eq!(number(text).to_string(), text);
        }
        assert_eq!(number("-9.23872e-007").to_string(), "-0.000000923872");
    }

    #[test]
    fn refusals_name_the_reason() {
        let cases = [
            ("nan", NotANumber::NotFinite),
            ("-NaN", NotANumber::NotFinite),
            ("Infinity", NotANumber::NotFinite),
            ("-1.#IND", NotANumber::NotFinite),
            ("1,5", NotANumber::Comma),
            ("1e400", NotANumber::TooLarge),
            ("1e99999999999999999999", NotANumber::TooLarge),
            ("--1", NotANumber::Garbage),
            ("1.2.3", NotANumber::Garbage),
            (".", NotANumber::Garbage),
            ("-", NotANumber::Garbage),
            ("1e", NotANumber::Garbage),
            ("0x1F", NotANumber::Garbage),
            ("", NotANumber::Garbage),
        ];
        for (text, why) in cases {
            assert_eq!(text.parse::<FileNumber>(), Err(why), "{text:?}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn the_value_equals_that_of_the_standard_library(mantissa in -MANTISSA_LIMIT + 1..MANTISSA_LIMIT, scale in 0u8..40) {
            let text = format!("{mantissa}e-{scale}");
            let decimal = ExactDecimal { mantissa, scale };
            prop_assert_eq!(decimal.to_f64(), text.parse::<f64>().unwrap());
            prop_assert_eq!(number(&decimal.to_string()), number(&text));
            prop_assert_eq!(number(&text), FileNumber::from(decimal));
        }
    }
}
