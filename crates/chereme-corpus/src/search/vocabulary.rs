//! The values that queries may name: those of the corpus's inventories.

use std::collections::BTreeSet;

use chereme_sign::query::{Feature, Operator, Wanted};
use chereme_sign::text::fold;
use chereme_sign::{Component, Inventory, InventoryValue};
use rusqlite::Connection;

use super::texts::Glob;
use crate::error::Result;
use crate::inventories;

/// The inventories of a corpus, as queries use them.
///
/// A name means every value that has it as its id, alias or name, in whichever inventory of the
/// component: values of the same name are one value to a query.
pub(crate) struct Vocabulary(Vec<Known>);

/// An inventory, and the folded spellings of each of its values.
struct Known {
    inventory: Inventory,
    folded: Vec<Vec<String>>,
}

impl Known {
    fn new(inventory: Inventory) -> Self {
        let values = inventory.values.iter();
        let folded = values.map(|value| value.spellings().map(fold).collect());
        Self {
            folded: folded.collect(),
            inventory,
        }
    }

    /// Returns the values with their folded spellings.
    fn values(&self) -> impl Iterator<Item = (&InventoryValue, &[String])> {
        let folded = self.folded.iter().map(Vec::as_slice);
        self.inventory.values.iter().zip(folded)
    }
}

/// The stored values that pass for one wanted value.
pub(crate) struct Accepted {
    folded: BTreeSet<String>,
    exact: BTreeSet<String>,
    folded_glob: Option<Glob>,
    exact_glob: Option<Glob>,
    /// Whether a value of an inventory is among them.
    pub(crate) known: bool,
}

impl Accepted {
    /// Tells whether a stored value is among them.
    pub(crate) fn fits(&self, value: &str, folded: &str) -> bool {
        self.folded.contains(folded)
            || self.exact.contains(value)
            || self
                .folded_glob
                .as_ref()
                .is_some_and(|glob| glob.matches(folded))
            || self
                .exact_glob
                .as_ref()
                .is_some_and(|glob| glob.matches(value))
    }

    /// Returns all of them, folded, where they can be listed.
    pub(crate) fn listed(&self) -> Option<&BTreeSet<String>> {
        let plain =
            self.exact.is_empty() && self.folded_glob.is_none() && self.exact_glob.is_none();
        plain.then_some(&self.folded)
    }
}

impl Vocabulary {
    /// Reads the inventories of a corpus.
    pub(crate) fn load(connection: &Connection) -> Result<Self> {
        let stored = inventories::load(connection)?;
        let known = stored.into_iter().map(|one| Known::new(one.inventory));
        Ok(Self(known.collect()))
    }

    /// Returns the inventories of a part of a component.
    pub(crate) fn of<'a>(
        &'a self,
        component: Component,
        part: Option<&'a str>,
    ) -> impl Iterator<Item = &'a Inventory> {
        self.known(component, part).map(|known| &known.inventory)
    }

    fn known<'a>(
        &'a self,
        component: Component,
        part: Option<&'a str>,
    ) -> impl Iterator<Item = &'a Known> {
        self.0.iter().filter(move |known| {
            known.inventory.component == component && known.inventory.feature.as_deref() == part
        })
    }

    fn all(&self) -> impl Iterator<Item = &Inventory> {
        self.0.iter().map(|known| &known.inventory)
    }

    /// Returns the parts of a component that there are inventories for.
    pub(crate) fn parts(&self, component: Component) -> BTreeSet<Option<String>> {
        let own = self.all().filter(|one| one.component == component);
        own.map(|one| one.feature.clone()).collect()
    }

    /// Returns the ids of all inventories.
    pub(crate) fn ids(&self) -> impl Iterator<Item = &str> {
        self.all().map(|inventory| inventory.id.as_str())
    }

    /// Returns the names of the features that values of a component have.
    pub(crate) fn features(&self, component: Component, part: Option<&str>) -> BTreeSet<&str> {
        self.all()
            .filter(|one| one.component == component)
            .filter(|one| part.is_none() || one.feature.as_deref() == part)
            .flat_map(Inventory::features)
            .collect()
    }

    /// Returns what passes for a wanted value in a part of a component.
    pub(crate) fn accepted(
        &self,
        component: Component,
        part: Option<&str>,
        operator: Operator,
        wanted: &Wanted,
    ) -> Accepted {
        let exactly = operator == Operator::Exactly;
        let mut accepted = Accepted {
            folded: BTreeSet::new(),
            exact: BTreeSet::new(),
            folded_glob: None,
            exact_glob: None,
            known: false,
        };
        match wanted {
            Wanted::Named(pattern) if exactly => {
                let glob = Glob::exact(pattern);
                self.add(
                    &mut accepted,
                    (component, part),
                    Reach::Letters,
                    |value, _| value.spellings().any(|text| glob.matches(text)),
                );
                accepted.exact_glob = Some(glob);
            }
            Wanted::Named(pattern) => {
                let glob = Glob::whole(pattern);
                self.add(
                    &mut accepted,
                    (component, part),
                    Reach::Narrower,
                    |_, folded| folded.iter().any(|text| glob.matches(text)),
                );
                match glob.literal() {
                    Some(text) => _ = accepted.folded.insert(text.to_owned()),
                    None => accepted.folded_glob = Some(glob),
                }
            }
            Wanted::Features(features) => {
                self.add(&mut accepted, (component, part), Reach::Own, |value, _| {
                    has(value, features, exactly)
                });
            }
            Wanted::Present | Wanted::Missing(_) => {}
        }
        accepted
    }

    fn add(
        &self,
        accepted: &mut Accepted,
        (component, part): (Component, Option<&str>),
        reach: Reach,
        meant: impl Fn(&InventoryValue, &[String]) -> bool,
    ) {
        let mut within: BTreeSet<String> = BTreeSet::new();
        let mut beside: Vec<&[String]> = Vec::new();
        for known in self.known(component, part) {
            let meant: BTreeSet<&str> = known
                .values()
                .filter(|(value, folded)| meant(value, folded))
                .map(|(value, _)| value.id.as_str())
                .collect();
            if meant.is_empty() {
                continue;
            }
            accepted.known = true;
            let is_meant = |value: &InventoryValue| meant.contains(value.id.as_str());
            for (value, folded) in known.values() {
                match reach {
                    Reach::Letters if is_meant(value) => {
                        accepted.exact.extend(value.spellings().map(str::to_owned));
                    }
                    Reach::Own | Reach::Narrower if is_meant(value) => {
                        accepted.folded.extend(folded.iter().cloned());
                    }
                    Reach::Narrower if known.inventory.chain(&value.id).any(is_meant) => {
                        within.extend(folded.iter().cloned());
                    }
                    Reach::Narrower => beside.push(folded),
                    _ => {}
                }
            }
        }
        if !within.is_empty() {
            let beside: BTreeSet<&String> = beside.into_iter().flatten().collect();
            within.retain(|text| !beside.contains(text));
            accepted.folded.append(&mut within);
        }
    }
}

/// What counts beside the values that are meant.
#[derive(Clone, Copy)]
enum Reach {
    /// Nothing, and case and accents tell.
    Letters,
    /// Nothing.
    Own,
    /// The values within them, but for those that another inventory has side by side with what is
    /// meant: a table that codes `head` and `chin` apart does not mean its chin by `head`.
    Narrower,
}

fn has(value: &InventoryValue, features: &[Feature], exactly: bool) -> bool {
    let own: BTreeSet<String> = value.features.iter().map(|name| fold(name)).collect();
    let all = features
        .iter()
        .all(|feature| own.contains(&fold(&feature.name)) != feature.absent);
    let named = features.iter().filter(|feature| !feature.absent);
    let named: BTreeSet<String> = named.map(|feature| fold(&feature.name)).collect();
    all && (!exactly || named == own)
}
