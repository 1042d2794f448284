//! The body language for animating notation: the numbers that differ from the default ones, and their sources.

use std::collections::BTreeMap;

use chereme_sign::hamnosys::{BodyLanguage, BodyLanguageError};
use serde::{Deserialize, Serialize};

/// Numbers of body language that replace the default ones; see [`BodyLanguage`].
///
/// It is stored with a recipe, so that later measurements do not change signs that were generated before.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyLanguageChanges {
    /// `measured` in the corpus, `quiet`, or the file; empty if all numbers are the default ones.
    #[serde(default)]
    pub from: String,
    /// Numbers by the names of [`BodyLanguage::LANGUAGE_VALUE_NAMES`].
    #[serde(default)]
    pub values: BTreeMap<String, LanguageValue>,
    /// Offsets of places, as in [`BodyLanguage::places`].
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub places: BTreeMap<String, [f64; 3]>,
}

/// A number of body language with its source.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LanguageValue {
    /// The number: the median of the measurements, in the unit in [`BodyLanguage::LANGUAGE_VALUE_NAMES`].
    pub value: f64,
    /// The quartiles of the measurements: half of them lie between these; `None` for a number that was not measured
    /// itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub quartiles: Option<[f64; 2]>,
    /// The number of measured movements.
    #[serde(default)]
    pub count: usize,
    /// The signers of those movements, or the number from which this one follows.
    pub of: String,
}

impl BodyLanguageChanges {
    /// Returns the default numbers without sway, blinks and the help of head, eyes and shoulders.
    #[must_use]
    pub fn quiet_body_language() -> Self {
        let (usual, still) = (
            BodyLanguage::default_body_language(),
            BodyLanguage::default_body_language().without_life(),
        );
        let names = BodyLanguage::LANGUAGE_VALUE_NAMES.iter().map(|(name, _)| *name);
        let changed = names.filter_map(|name| {
            let value = still.value(name).filter(|value| usual.value(name) != Some(*value))?;
            let of = "a quiet body".to_owned();
            let value = LanguageValue {
                value,
                quartiles: None,
                count: 0,
                of,
            };
            Some((name.to_owned(), value))
        });
        Self {
            from: "quiet".to_owned(),
            values: changed.collect(),
            places: BTreeMap::new(),
        }
    }

    /// Returns whether every number is the default one.
    #[must_use]
    pub fn is_usual(&self) -> bool {
        self.values.is_empty() && self.places.is_empty()
    }

    /// Returns the whole body language: the default one with these numbers and places.
    ///
    /// # Errors
    /// [`BodyLanguageError`] if a name is unknown or a number out of range.
    pub fn whole_body_language(&self) -> Result<BodyLanguage, BodyLanguageError> {
        let value_entries = self.values.iter();
        let values = value_entries.map(|(name, value)| (name.as_str(), value.value));
        let mut complete_language = BodyLanguage::default_body_language().with_measured(values)?;
        complete_language.places.clone_from(&self.places);
        Ok(complete_language)
    }

    /// Describes each number and place for people; empty if all are the default ones.
    #[must_use]
    pub fn describe_body_language(&self) -> Vec<String> {
        let unit = |name: &str| {
            let unit_entry = BodyLanguage::LANGUAGE_VALUE_NAMES.iter().find(|(own, _)| *own == name);
            unit_entry.map_or("", |(_, unit)| *unit)
        };
        let number = |(name, it): (&String, &LanguageValue)| {
            let usual = BodyLanguage::default_body_language().value(name).unwrap_or_default();
            let spread = match it.quartiles {
                Some([low, high]) => {
                    format!(", half of {} from {low:.3} to {high:.3}", it.count)
                }
                None => String::new(),
            };
            format!(
                "body language: {name} {:.3} {}{spread} ({}; usually {usual:.3})",
                it.value,
                unit(name),
                it.of
            )
        };
        let place = |(name, [left, up, forward]): (&String, &[f64; 3])| {
            format!(
                "body language: {name} moved {left} left, {up} up, {forward} forward in shoulder widths ({})",
                self.from
            )
        };
        let numbers = self.values.iter().map(number);
        numbers.chain(self.places.iter().map(place)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quiet_body_language_is_the_usual_one_without_sway_and_blinks() {
        let quiet = BodyLanguageChanges::quiet_body_language();
        let whole = quiet.whole_body_language().expect("known names");
        assert_eq!(whole, BodyLanguage::default_body_language().without_life());
        assert!(!quiet.is_usual() && quiet.describe_body_language()[0].contains("a quiet body"));
    }

    #[test]
    fn measured_values_are_reported_with_their_spread_and_replace_the_usual_ones() {
        let mut language = BodyLanguageChanges {
            from: "measured".into(),
            ..BodyLanguageChanges::default()
        };
        assert!(language.is_usual() && language.describe_body_language().is_empty());
        assert_eq!(
            &language.whole_body_language().expect("usual"),
            BodyLanguage::default_body_language()
        );
        let value = LanguageValue {
            value: 0.31,
            quartiles: Some([0.25, 0.4]),
            count: 12,
            of: "signer:Anna".into(),
        };
        language.values.insert("move.normal".into(), value);
        language.places.insert("chin".into(), [0.0, 0.1, 0.0]);
        let whole = language.whole_body_language().expect("in range");
        assert_eq!(whole.move_normal, 0.31);
        assert_eq!(whole.places["chin"], [0.0, 0.1, 0.0]);
        let lines = language.describe_body_language();
        assert!(
            lines[0].contains("0.310 arm, half of 12 from 0.250 to 0.400 (signer:Anna"),
            "{lines:?}"
        );
        assert!(lines[1].contains("chin moved 0 left, 0.1 up"));
        let text = serde_json::to_string(&language).expect("JSON");
        let back: BodyLanguageChanges = serde_json::from_str(&text).expect("the same");
        assert_eq!(back, language);
        let odd = text.replace("move.normal", "move.odd");
        let odd: BodyLanguageChanges = serde_json::from_str(&odd).expect("JSON");
        assert!(odd.whole_body_language().is_err());
    }
}
