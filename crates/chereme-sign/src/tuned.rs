//! Documents of tuned numbers: each number stands with its unit and its meaning.
//!
//! ```
//! use serde::Deserialize;
//!
//! #[derive(Deserialize)]
//! struct Steps {
//!     #[serde(deserialize_with = "chereme_sign::tuned::number")]
//!     length: f64,
//! }
//!
//! let steps: Steps = chereme_sign::tuned::read(r#"{"length": [0.7, "m", "usual step of a person"]}"#)?;
//! assert_eq!(steps.length, 0.7);
//! # Ok::<(), serde_json::Error>(())
//! ```

use serde::de::{Deserialize, DeserializeOwned, Deserializer};

/// Reads a document of tuned numbers.
///
/// # Errors
/// Fails if the text is not JSON, or a number is missing or of another kind.
pub fn read<T: DeserializeOwned>(text: &str) -> Result<T, serde_json::Error> {
    serde_json::from_str(text)
}

/// Reads one tuned number, an array of its value, its unit and its meaning; for serde's `deserialize_with`.
///
/// # Errors
/// Fails if there is no such array.
pub fn number<'de, D: Deserializer<'de>, T: Deserialize<'de>>(from: D) -> Result<T, D::Error> {
    let (value, _unit, _meaning): (T, String, String) = Deserialize::deserialize(from)?;
    Ok(value)
}
