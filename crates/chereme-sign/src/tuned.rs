//! Documents of tuned numbers: each number stands with its unit and its meaning.
//!
//! ```
//! use serde::Deserialize;
//!
//! #[derive(Deserialize)]
//! struct Steps {
//!     #[serde(deserialize_with = "chereme_sign::tuned::read_tuned_number")]
//!     length: f64,
//! }
//!
//! let steps: Steps = chereme_sign::tuned::read_tuned_document(r#"{"length": [0.7, "m", "usual step of a person"]}"#)?;
//! assert_eq!(steps.length, 0.7);
//! # Ok::<(), serde_json::Error>(())
//! ```

use serde::de::{Deserialize, DeserializeOwned, Deserializer};

#[doc(hidden)]
pub use chereme_data::schema_text;

/// Reads a document of tuned numbers.
///
/// # Errors
/// Fails if the text is not JSON, or a number is missing or of another kind.
pub fn read_tuned_document<T: DeserializeOwned>(text: &str) -> Result<T, serde_json::Error> {
    serde_json::from_str(text)
}

/// Reads one tuned number, an array of its value, its unit and its meaning; for serde's `deserialize_with`.
///
/// # Errors
/// Fails if there is no such array.
pub fn read_tuned_number<'de, D: Deserializer<'de>, T: Deserialize<'de>>(from: D) -> Result<T, D::Error> {
    let (value, _unit, _meaning): (T, String, String) = Deserialize::deserialize(from)?;
    Ok(value)
}

/// Declares structs for groups of tuned numbers, `Tuned`, which holds every group, and `tuned()`, which returns the numbers
/// of the data file at `$path` in the folder `schema`. The data file documents each number.
#[macro_export]
macro_rules! tuned_numbers {
    ($path:literal; $($(#[$doc:meta])* $group:ident: $numbers:ident { $($name:ident: $kind:ty,)* })*) => {
        $(
            $(#[$doc])*
            #[derive(Debug, ::serde::Deserialize)]
            #[serde(deny_unknown_fields)]
            pub(crate) struct $numbers {
                $(#[serde(deserialize_with = "chereme_sign::tuned::read_tuned_number")] pub(crate) $name: $kind,)*
            }
        )*
        /// The tuned numbers, by group.
        #[derive(Debug, ::serde::Deserialize)]
        pub(crate) struct Tuned {
            $($(#[$doc])* pub(crate) $group: $numbers,)*
        }

        const DOCUMENT: &str = $crate::tuned::schema_text($path);

        /// Returns the tuned numbers.
        #[inline]
        pub(crate) fn tuned() -> &'static Tuned {
            static TUNED: ::std::sync::LazyLock<Tuned> = ::std::sync::LazyLock::new(|| {
                $crate::tuned::read_tuned_document(DOCUMENT).expect("the program's own file has every number")
            });
            &TUNED
        }
    };
}

pub use tuned_numbers;

#[cfg(test)]
mod tests {
    use crate::tuned_faults::tuned_document_faults;

    #[test]
    fn numbers_without_a_known_unit_or_a_meaning_are_listed() {
        let document = |unit: &str, meaning: &str| {
            format!(r#"{{"version": 1, "description": "Units: m metres.", "a": {{"b": [1, "{unit}", "{meaning}"]}}}}"#)
        };
        assert!(tuned_document_faults(&document("m", "Length of a usual step")).is_empty());
        assert_eq!(
            tuned_document_faults(&document("km", "Length of a usual step")),
            ["a.b: the unit km"]
        );
        assert_eq!(
            tuned_document_faults(&document("m", "Length")),
            ["a.b: the meaning Length"]
        );
        assert_eq!(tuned_document_faults(r#"{"description": ""}"#), ["no version"]);
        assert_eq!(tuned_document_faults("{").len(), 1);
    }
}
