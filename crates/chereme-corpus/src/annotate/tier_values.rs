//! The possible values on a tier: those of its inventory and those in use, filtered while typing.

use std::collections::BTreeMap;

use chereme_sign::text::fold_text;

use crate::contents::TierContents;
use crate::db::stored_columns::ValueState;
use crate::inventories::StoredInventory;

/// A possible value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TierValue {
    /// The stored text.
    pub value: String,
    /// Its name in the requested language, if it differs from the value.
    pub name: Option<String>,
    /// How often the tier has it.
    pub used: usize,
    /// Its other names, folded, for filtering.
    known: Vec<String>,
}

/// The values of a tier, the most used first, then in the inventory's order.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct TierValues {
    /// The values in their order.
    pub all: Vec<TierValue>,
    /// Whether other values are forbidden.
    pub closed: bool,
}

/// Special values of coded tiers for a missing value, as they are typed.
pub const SPECIAL_TIER_VALUES: [&str; 2] = ["n/a", "unclear"];

/// Returns the names of a special value in a language other than English: the usual one first.
fn names_of(missing: &str, language: &str) -> &'static [&'static str] {
    match (missing, language) {
        ("n/a", "fr") => &["sans objet", "non applicable"],
        ("unclear", "fr") => &["incertain"],
        _ => &[],
    }
}

/// Returns the possible values of a tier.
#[must_use]
pub fn collect_tier_values(tier: &TierContents, inventory: Option<&StoredInventory>, language: &str) -> TierValues {
    let columns = &tier.annotations;
    let mut used: BTreeMap<&str, usize> = BTreeMap::new();
    for (value, state) in columns.values.iter().zip(&columns.states) {
        if *state == ValueState::Value && !value.trim().is_empty() {
            *used.entry(value).or_default() += 1;
        }
    }
    let mut all: Vec<TierValue> = Vec::new();
    for value in inventory.iter().flat_map(|stored| &stored.inventory.values) {
        let names = value.names.values().chain(&value.aliases);
        all.push(TierValue {
            value: value.id.clone(),
            name: value.names.get(language).filter(|name| **name != value.id).cloned(),
            // The others are values in use that the inventory does not have.
            used: used.remove(value.id.as_str()).unwrap_or_default(),
            known: names.chain([&value.id]).map(|name| fold_text(name)).collect(),
        });
    }
    all.extend(used.into_iter().map(|(value, used)| TierValue {
        value: value.to_owned(),
        name: None,
        used,
        known: vec![fold_text(value)],
    }));
    // The sort is stable, so equally frequent values keep the order of the inventory.
    all.sort_by_key(|choice| std::cmp::Reverse(choice.used));
    let coded = inventory.is_some() || tier.row.role.is_coded();
    all.extend(SPECIAL_TIER_VALUES.iter().filter(|_| coded).map(|value| {
        let names = names_of(value, language);
        let folded_names = names.iter().chain([value]).map(|name| fold_text(name));
        TierValue {
            value: (*value).to_owned(),
            name: names.first().map(|name| (*name).to_owned()),
            used: 0,
            known: folded_names.collect(),
        }
    }));
    TierValues {
        all,
        closed: inventory.is_some(),
    }
}

impl TierValues {
    /// Returns the indices of the values that match the typed text: equal ones first, then those that begin with it,
    /// then those that contain it.
    #[must_use]
    pub fn matching_value_indices(&self, text: &str) -> Vec<usize> {
        let wanted = fold_text(text.trim());
        let rank = |choice: &TierValue| {
            // Case distinguishes some values, so the text as typed goes before the folded one.
            let exact = choice.value == text.trim();
            let ranks = choice.known.iter().filter_map(|known| {
                if exact || *known == wanted {
                    Some(u8::from(!exact))
                } else if known.starts_with(&wanted) {
                    Some(2)
                } else {
                    known.contains(&wanted).then_some(3)
                }
            });
            ranks.min()
        };
        let numbered_choices = self.all.iter().enumerate();
        let mut ranked: Vec<(u8, usize)> = numbered_choices
            .filter_map(|(at, choice)| Some((rank(choice)?, at)))
            .collect();
        ranked.sort_unstable();
        ranked.into_iter().map(|(_, at)| at).collect()
    }

    /// Returns the value that Enter stores: the marked one; else the typed text, if it is allowed; else, on a closed
    /// tier, the best match. Returns `None` if nothing matches.
    #[must_use]
    pub fn value_to_store(&self, text: &str, marked: Option<usize>) -> Option<String> {
        let text = text.trim();
        if let Some(choice) = marked.and_then(|at| self.all.get(at)) {
            return Some(choice.value.clone());
        }
        if !self.closed || text.is_empty() || text == "unset" {
            let is_missing = |choice: &&TierValue| {
                SPECIAL_TIER_VALUES.contains(&choice.value.as_str()) && choice.known.iter().any(|name| name == text)
            };
            let missing = self.all.iter().find(is_missing);
            return Some(missing.map_or_else(|| text.to_owned(), |choice| choice.value.clone()));
        }
        let best = self.matching_value_indices(text).first().copied()?;
        Some(self.all[best].value.clone())
    }

    /// Returns whether a value begins with that digit, so that the digit is typed and does not pick.
    #[must_use]
    pub fn types_digit(&self, digit: char) -> bool {
        !self.closed || self.all.iter().any(|choice| choice.value.starts_with(digit))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_sign::inventory::builtin_inventories;

    use crate::contents::AnnotationColumns;
    use crate::db::stored_tiers::TierRow;

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

    fn shapes() -> StoredInventory {
        let found = builtin_inventories().iter().find(|it| it.id == "configurations");
        StoredInventory {
            id: 1,
            inventory: found.expect("built in").clone(),
        }
    }

    #[test]
    fn special_values_are_typed_in_the_language_of_the_window() {
        let shapes = shapes();
        for (inventory, language, typed, kept) in [
            (None, "fr", "incertain", "unclear"),
            (None, "fr", "non applicable", "n/a"),
            (None, "fr", "INCERTAIN", "INCERTAIN"),
            (None, "en", "incertain", "incertain"),
            (Some(&shapes), "fr", "sans objet", "n/a"),
            (Some(&shapes), "fr", "incertain", "unclear"),
            (Some(&shapes), "fr", "unclear", "unclear"),
        ] {
            let choices = collect_tier_values(&tier("gloss", &["BOL"]), inventory, language);
            assert_eq!(choices.value_to_store(typed, None).as_deref(), Some(kept), "{typed}");
        }
        let french = collect_tier_values(&tier("gloss", &[]), None, "fr");
        let names: Vec<Option<&str>> = french.all.iter().map(|it| it.name.as_deref()).collect();
        assert_eq!(names, [Some("sans objet"), Some("incertain")]);
    }

    fn fitting(choices: &TierValues, text: &str) -> Vec<String> {
        let places = choices.matching_value_indices(text);
        places.iter().map(|at| choices.all[*at].value.clone()).collect()
    }

    #[test]
    fn most_used_values_come_first_and_typing_filters_them() {
        let free = collect_tier_values(&tier("gloss", &["BOL", "CHAT", "CHAT", "ÉCOLE"]), None, "en");
        let all: Vec<&str> = free.all.iter().map(|it| it.value.as_str()).collect();
        assert_eq!(all, ["CHAT", "BOL", "ÉCOLE", "n/a", "unclear"]);
        assert_eq!(fitting(&free, "eco"), ["ÉCOLE"]);
        assert_eq!(free.value_to_store("NEW", None).as_deref(), Some("NEW"));
        assert_eq!(free.value_to_store("c", Some(0)).as_deref(), Some("CHAT"));
        let inventory = shapes();
        let coded = collect_tier_values(&tier("configuration", &["U", "U", "B"]), Some(&inventory), "fr");
        assert_eq!((coded.all[0].value.as_str(), coded.all[0].used), ("U", 2));
        assert_eq!(coded.all[1].value, "B");
        assert_eq!(fitting(&coded, "u")[0], "U");
        assert_eq!(coded.value_to_store("u", None).as_deref(), Some("U"));
        assert_eq!(coded.value_to_store("no such shape", None), None);
        assert_eq!(coded.value_to_store("", None).as_deref(), Some(""));
        assert!(coded.types_digit('5') && !coded.types_digit('9'));
    }
}
