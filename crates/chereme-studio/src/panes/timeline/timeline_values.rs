//! The values of the digits on each tier.

use std::collections::BTreeMap;

use chereme_corpus::tier_values::{SPECIAL_TIER_VALUES, TierValues};

/// The values of the digits, tier by tier. An assignment stays for the session, so that users can learn it.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct DigitAssignments {
    given: BTreeMap<i64, Vec<String>>,
}

impl DigitAssignments {
    /// Returns the values of the digits 1 to 9 on a tier; newly used ones get the free digits.
    pub(crate) fn digit_values_of_tier(&mut self, tier: i64, choices: &TierValues) -> &[String] {
        let given = self.given.entry(tier).or_default();
        for choice in &choices.all {
            if given.len() >= 9 {
                break;
            }
            let says = (choices.closed || choice.used > 0) && !SPECIAL_TIER_VALUES.contains(&choice.value.as_str());
            if says && !given.contains(&choice.value) {
                given.push(choice.value.clone());
            }
        }
        given
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::{AnnotationColumns, TierContents, TierRow, ValueState, tier_values};

    fn tier(role: &str, values: &[&str]) -> TierContents {
        TierContents {
            row: TierRow {
                id: 7,
                role: role.parse().expect("a role"),
                ..TierRow::default()
            },
            annotations: AnnotationColumns {
                states: vec![ValueState::Value; values.len()],
                values: values.iter().map(|value| (*value).into()).collect(),
                ..AnnotationColumns::default()
            },
        }
    }

    #[test]
    fn a_digit_keeps_its_value_during_an_editing_session() {
        let mut digits = DigitAssignments::default();
        let at = |digits: &mut DigitAssignments, values: &[&str]| {
            digits
                .digit_values_of_tier(7, &tier_values::collect_tier_values(&tier("gloss", values), None, "en"))
                .to_vec()
        };
        assert_eq!(at(&mut digits, &["BOL", "CHAT", "CHAT"]), ["CHAT", "BOL"]);
        assert_eq!(
            at(&mut digits, &["BOL", "BOL", "BOL", "CHAT", "AMI"]),
            ["CHAT", "BOL", "AMI"]
        );
    }
}
