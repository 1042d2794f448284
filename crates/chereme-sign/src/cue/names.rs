//! The names of keys on tiers and in queries.
//!
//! A key is a gloss such as `cue:mouth-4`: the placement and the number of the shape. The founding paper writes the
//! same key with two digits, the placement's number before the shape's: 24.

/// The placements by the numbers of the paper, 0 is rest; then those that only English codes have.
const NUMBERS: [&str; 8] = [
    "rest",
    "side",
    "mouth",
    "chin",
    "cheek",
    "throat",
    "side-forward",
    "side-down",
];
/// The prefix of the gloss of every key.
const PREFIX: &str = "cue:";

/// Returns the gloss of a key, such as `cue:mouth-4`.
#[must_use]
pub fn gloss(placement: &str, shape: u8) -> String {
    format!("{PREFIX}{placement}-{shape}")
}

/// Returns the placement and the shape that a gloss names; `None` if it is not the gloss of a key.
///
/// ```
/// use chereme_sign::cue::{gloss, of_gloss};
/// assert_eq!(of_gloss(&gloss("side-down", 5)), Some(("side-down", 5)));
/// assert_eq!(of_gloss("CHAT-5"), None);
/// ```
#[must_use]
pub fn of_gloss(text: &str) -> Option<(&str, u8)> {
    let (placement, shape) = text.trim().strip_prefix(PREFIX)?.rsplit_once('-')?;
    let shape = shape.parse().ok().filter(|shape| *shape <= 8)?;
    (!placement.is_empty()).then_some((placement, shape))
}

/// Returns the placement of a number of the paper, such as 2 for `mouth`.
#[must_use]
pub fn placement_of_number(number: usize) -> Option<&'static str> {
    NUMBERS.get(number).copied()
}

/// Returns the number of a placement in the paper; 9 if the paper does not number it.
#[must_use]
pub fn placement_number(placement: &str) -> usize {
    NUMBERS
        .iter()
        .position(|known| *known == placement)
        .unwrap_or(9)
}
