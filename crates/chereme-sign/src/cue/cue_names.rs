//! The names of keys on tiers and in queries.
//!
//! A key is a gloss such as `cue:mouth-4`: the placement and the number of the shape. The founding paper writes the
//! same key with two digits, the placement's number before the shape's: 24.

/// The placements by the numbers of the paper, 0 is rest; then those that only English codes have.
const PLACEMENT_NUMBERS: [&str; 8] = [
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
const CUE_GLOSS_PREFIX: &str = "cue:";

/// Returns the gloss of a key, such as `cue:mouth-4`.
#[must_use]
pub fn gloss_cue_key(placement: &str, shape: u8) -> String {
    format!("{CUE_GLOSS_PREFIX}{placement}-{shape}")
}

/// Returns the placement and the shape that a gloss names; `None` if it is not the gloss of a key.
///
/// ```
/// use chereme_sign::cue::{gloss_cue_key, of_gloss};
/// assert_eq!(of_gloss(&gloss_cue_key("side-down", 5)), Some(("side-down", 5)));
/// assert_eq!(of_gloss("CHAT-5"), None);
/// ```
#[must_use]
pub fn of_gloss(text: &str) -> Option<(&str, u8)> {
    let (placement, shape) = text.trim().strip_prefix(CUE_GLOSS_PREFIX)?.rsplit_once('-')?;
    let shape = shape.parse().ok().filter(|shape| *shape <= 8)?;
    (!placement.is_empty()).then_some((placement, shape))
}

/// The letters of placements in the annotation of SPPAS, which writes the shape first.
const SPPAS_PLACEMENT_LETTERS: [(&str, &str); 6] = [
    ("n", "rest"),
    ("s", "side"),
    ("m", "mouth"),
    ("c", "chin"),
    ("b", "cheek"),
    ("t", "throat"),
];

/// Returns the placement and the shape of a key on a tier or in a query; `None` if the text is none.
///
/// A key is a gloss, the same without its prefix, SPPAS's shape and letter with a hyphen, a blank or an end of line
/// between them, or the two digits of the paper.
///
/// ```
/// use chereme_sign::cue::key_of_label;
/// for text in ["cue:mouth-4", "mouth-4", "4-m", "4-mouth", "4 m", "4\nm", "24"] {
///     assert_eq!(key_of_label(text), Some(("mouth", 4)));
/// }
/// assert_eq!(key_of_label("papa"), None);
/// ```
#[must_use]
pub fn key_of_label(text: &str) -> Option<(&str, u8)> {
    let text = text.trim();
    if text.starts_with(CUE_GLOSS_PREFIX) {
        return of_gloss(text);
    }
    let is_digit = |part: &str| part.len() == 1 && part.bytes().all(|byte| byte.is_ascii_digit());
    let (placement, shape) = match text.split_once(['-', ' ', '\n']) {
        Some((shape, placement)) if is_digit(shape) => {
            let letter = SPPAS_PLACEMENT_LETTERS.iter().find(|(letter, _)| *letter == placement);
            (letter.map_or(placement, |(_, name)| *name), shape)
        }
        Some(_) => text.rsplit_once('-')?,
        None => {
            let (number, shape) = text.split_at_checked(1).filter(|parts| is_digit(parts.0))?;
            (placement_of_number(number.parse().ok()?)?, shape)
        }
    };
    let shape = shape.parse().ok().filter(|_| is_digit(shape))?;
    (shape <= 8 && PLACEMENT_NUMBERS.contains(&placement)).then_some((placement, shape))
}

/// Returns a key as the two labels that SPPAS gives it: the shape, and the letter of the placement.
#[must_use]
pub fn sppas_key_labels(placement: &str, shape: u8) -> Option<[String; 2]> {
    let (letter, _) = SPPAS_PLACEMENT_LETTERS.iter().find(|(_, name)| *name == placement)?;
    Some([shape.to_string(), (*letter).to_owned()])
}

/// Returns the placement of a number of the paper, such as 2 for `mouth`.
#[must_use]
pub fn placement_of_number(number: usize) -> Option<&'static str> {
    PLACEMENT_NUMBERS.get(number).copied()
}

/// Returns the number of a placement in the paper; 9 if the paper does not number it.
#[must_use]
pub fn placement_number(placement: &str) -> usize {
    PLACEMENT_NUMBERS
        .iter()
        .position(|known| *known == placement)
        .unwrap_or(9)
}
