//! Values of several inventories that are one: which, and the one of each group that stands for it.

use std::collections::{BTreeMap, HashMap};
use std::fmt;

use chereme_sign::{ComponentInventory, InventoryValue, SignComponent};
use rusqlite::Connection;
use serde::{Serialize, Serializer};

use super::{StoredInventory, load_all_inventories};
use crate::db::stored_inventories as rows;
use crate::error::CorpusResult;

/// A value by the inventory that has it, written `INVENTORY/VALUE`.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct ValueName {
    /// The inventory's key.
    pub inventory: String,
    /// The value's id.
    pub value: String,
}

impl fmt::Display for ValueName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.inventory, self.value)
    }
}

impl Serialize for ValueName {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// The values of inventories that a person says are one, in groups; the first of a group stands for it.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct EqualValues(Vec<Vec<ValueName>>);

/// The most values that are followed from one to the value that stands for its group.
const MAX_FOLLOWED_VALUES: usize = 64;

impl EqualValues {
    /// Reads the groups of a corpus.
    pub(crate) fn load_equal_values(connection: &Connection) -> CorpusResult<Self> {
        let all: BTreeMap<String, (ValueName, Option<String>)> = rows::load_joined_values(connection)?
            .into_iter()
            .map(|[inventory, value, same_as]| {
                let name = ValueName {
                    inventory: inventory.unwrap_or_default(),
                    value: value.unwrap_or_default(),
                };
                (name.to_string(), (name, same_as))
            })
            .collect();
        let next = |at: &String| {
            all.get(at)
                .and_then(|(_, same_as)| all.get_key_value(same_as.as_ref()?))
        };
        let mut groups: BTreeMap<&String, Vec<ValueName>> = BTreeMap::new();
        for (text, (name, _)) in &all {
            let mut chain: Vec<&String> = vec![text];
            // A merge of two corpora may have closed a ring, of which the first in order then stands for all.
            while chain.len() < MAX_FOLLOWED_VALUES
                && let Some((further, _)) = chain.last().and_then(|last| next(last))
                && !chain.contains(&further)
            {
                chain.push(further);
            }
            let last = chain.last().copied().unwrap_or(text);
            let ring = next(last).and_then(|(first, _)| chain.iter().position(|at| *at == first));
            let standing = ring
                .and_then(|first| chain[first..].iter().min().copied())
                .unwrap_or(last);
            groups.entry(standing).or_default().push(name.clone());
        }
        let ordered = groups.into_iter().map(|(standing, mut names)| {
            names.sort_by_key(|name| name.to_string() != *standing);
            names
        });
        Ok(Self(ordered.filter(|names| names.len() > 1).collect()))
    }

    /// Returns the groups, each with the value that stands for it first.
    #[must_use]
    pub fn equal_groups(&self) -> &[Vec<ValueName>] {
        &self.0
    }

    /// Returns the group of a value, if it is one with others.
    #[must_use]
    pub fn find_equal_group(&self, inventory: &str, value: &str) -> Option<&[ValueName]> {
        let is_member = |name: &ValueName| name.inventory == inventory && name.value == value;
        let group = self.0.iter().find(|group| group.iter().any(is_member));
        group.map(Vec::as_slice)
    }

    /// Returns whether another value of these inventories stands for a value, which then needs no place of its own in a list.
    pub fn has_stand_in<'i>(
        &self,
        inventories: impl IntoIterator<Item = &'i ComponentInventory>,
        inventory: &str,
        value: &str,
    ) -> bool {
        let Some(group) = self.find_equal_group(inventory, value) else {
            return false;
        };
        let listed: Vec<&str> = inventories.into_iter().map(|listed| listed.id.as_str()).collect();
        let first = group.iter().find(|name| listed.contains(&name.inventory.as_str()));
        first.is_some_and(|name| name.inventory != inventory || name.value != value)
    }

    /// Returns the value that stands for one of an inventory, which is as a rule itself.
    pub(crate) fn standing_value<'i>(
        &self,
        inventories: &'i [StoredInventory],
        (inventory, value): (&'i ComponentInventory, &'i InventoryValue),
    ) -> (&'i ComponentInventory, &'i InventoryValue) {
        let group = self.find_equal_group(&inventory.id, &value.id);
        let standing = group.and_then(<[ValueName]>::first).and_then(|name| {
            let stored = inventories
                .iter()
                .find(|stored| stored.inventory.id == name.inventory)?;
            Some((&stored.inventory, stored.inventory.value_by_id(&name.value)?))
        });
        standing.unwrap_or((inventory, value))
    }
}

/// The words of values that a person says are one, each with the word of the value that stands for it.
#[derive(Debug, Clone, Default)]
pub(crate) struct StandingWords(HashMap<(SignComponent, Option<String>), HashMap<String, String>>);

impl StandingWords {
    /// Reads the words of a corpus. An inventory with two of them as values of its own keeps them apart, so that a word
    /// alone names its group.
    pub(crate) fn load_standing_words(connection: &Connection) -> CorpusResult<Self> {
        let equal = EqualValues::load_equal_values(connection)?;
        let mut words = Self::default();
        if equal.0.is_empty() {
            return Ok(words);
        }
        for stored in load_all_inventories(connection)? {
            let part = (stored.inventory.component, stored.inventory.feature.clone());
            let names = equal
                .0
                .iter()
                .flat_map(|group| group.iter().map(move |name| (name, &group[0])));
            let own =
                names.filter(|(name, standing)| name.inventory == stored.inventory.id && name.value != standing.value);
            let own = own.map(|(name, standing)| (name.value.clone(), standing.value.clone()));
            words.0.entry(part).or_default().extend(own);
        }
        Ok(words)
    }

    /// Returns the word that stands for a word of a component or of one of its features; as a rule itself.
    pub(crate) fn standing_word<'w>(&'w self, part: &(SignComponent, Option<String>), word: &'w str) -> &'w str {
        self.0
            .get(part)
            .and_then(|words| words.get(word))
            .map_or(word, String::as_str)
    }
}
