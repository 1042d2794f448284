//! The values that queries may name: the values in the corpus's inventories.

use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::inventory::builtin_by_id;
use chereme_sign::query::{Feature, Operator, Wanted};
use chereme_sign::text::{composed, fold};
use chereme_sign::{Component, Inventory, InventoryValue};
use rusqlite::Connection;

use super::known::Values;
use super::texts::Glob;
use crate::error::Result;
use crate::inventories;

/// The inventories of a corpus in the form for queries.
///
/// A name stands for every value that has it as id, alias or name, in any inventory of the component: values of the
/// same name are one value to a query.
pub(crate) struct Vocabulary(Vec<Known>);

/// An inventory, and the folded spellings of each of its values.
struct Known {
    inventory: Inventory,
    /// Whether it comes with the program.
    is_builtin: bool,
    folded: Vec<Vec<String>>,
}

impl Known {
    fn new(inventory: Inventory) -> Self {
        let values = inventory.values.iter();
        let folded = values.map(|value| value.spellings().map(fold).collect());
        Self {
            folded: folded.collect(),
            is_builtin: builtin_by_id(&inventory.id).is_some(),
            inventory,
        }
    }

    /// Returns the values with their folded spellings.
    fn values(&self) -> impl Iterator<Item = (&InventoryValue, &[String])> {
        let folded = self.folded.iter().map(Vec::as_slice);
        self.inventory.values.iter().zip(folded)
    }
}

/// The stored values that are accepted for one wanted value.
pub(crate) struct Accepted {
    /// Spellings of the wanted values, folded.
    folded: BTreeSet<String>,
    /// The spellings among them that are accepted only because of an alias, folded.
    aliases: BTreeSet<String>,
    /// Spellings of narrower values, folded.
    narrower: BTreeSet<String>,
    exact: BTreeSet<String>,
    folded_glob: Option<Glob>,
    exact_glob: Option<Glob>,
    /// Whether a value of an inventory is among them.
    pub(crate) known: bool,
}

impl Accepted {
    /// Returns whether a stored value is accepted.
    pub(crate) fn fits(&self, value: &str, folded: &str) -> bool {
        self.means(value, folded) || self.narrower.contains(folded)
    }

    /// Returns whether a stored value is accepted as the wanted value itself, not as a narrower one.
    pub(crate) fn means(&self, value: &str, folded: &str) -> bool {
        self.folded.contains(folded)
            || self.exact.contains(value)
            || self
                .folded_glob
                .as_ref()
                .is_some_and(|glob| glob.fits(value, folded))
            || self
                .exact_glob
                .as_ref()
                .is_some_and(|glob| glob.matches(value))
    }

    /// Adds the spellings of a wanted value that are not its names; all of them if it is asked for by an alias.
    fn add_aliases(&mut self, value: &InventoryValue, folded: &[String], asked: Option<&str>) {
        let aliases: BTreeSet<String> = value.aliases.iter().map(|text| fold(text)).collect();
        let Some(asked) = asked else { return };
        let by_alias = aliases.contains(asked);
        let others = folded.iter().filter(|it| by_alias || aliases.contains(*it));
        self.aliases
            .extend(others.filter(|it| *it != asked).cloned());
    }

    /// Returns whether a stored value is accepted as the wanted value only because of an alias.
    pub(crate) fn is_alias(&self, folded: &str) -> bool {
        self.aliases.contains(folded)
    }

    /// Returns all accepted values, folded, if they can be listed.
    pub(crate) fn listed(&self) -> Option<impl Iterator<Item = &String>> {
        let plain =
            self.exact.is_empty() && self.folded_glob.is_none() && self.exact_glob.is_none();
        plain.then(|| self.folded.union(&self.narrower))
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

    /// Returns the parts of a component that have inventories.
    pub(crate) fn parts(&self, component: Component) -> BTreeSet<Option<String>> {
        let own = self.all().filter(|one| one.component == component);
        own.map(|one| one.feature.clone()).collect()
    }

    /// Returns the ids of all inventories.
    pub(crate) fn ids(&self) -> impl Iterator<Item = &str> {
        self.all().map(|inventory| inventory.id.as_str())
    }

    /// Returns the feature names in the values of a component.
    pub(crate) fn features(&self, component: Component, part: Option<&str>) -> BTreeSet<&str> {
        self.all()
            .filter(|one| one.component == component)
            .filter(|one| part.is_none() || one.feature.as_deref() == part)
            .flat_map(Inventory::features)
            .collect()
    }

    /// Returns the accepted values for a wanted value in a part of a component; `stored` are the values in use.
    ///
    /// If a value in use has exactly the wanted name, aliases do not make it equal to other values of its inventory.
    pub(crate) fn accepted(
        &self,
        (component, part): (Component, Option<&str>),
        operator: Operator,
        wanted: &Wanted,
        stored: Option<&Values>,
    ) -> Accepted {
        let exactly = operator == Operator::Exactly;
        let mut accepted = Accepted {
            folded: BTreeSet::new(),
            aliases: BTreeSet::new(),
            narrower: BTreeSet::new(),
            exact: BTreeSet::new(),
            folded_glob: None,
            exact_glob: None,
            known: false,
        };
        match wanted {
            Wanted::Named(pattern) if exactly => {
                let glob = Glob::exact(pattern);
                let literal = glob.literal().is_some();
                let in_use = glob.literal().is_some_and(|text| {
                    let alike = stored.and_then(|stored| stored.get(&fold(text)));
                    let mut alike = alike.into_iter().flatten();
                    alike.any(|known| known.reading.value().is_some_and(|it| composed(it) == text))
                });
                let text = glob.literal().map(fold);
                let reach = match in_use {
                    true => Reach::Name,
                    false => Reach::Letters(text.as_deref()),
                };
                self.add(
                    &mut accepted,
                    (component, part),
                    reach,
                    |value, _| match literal {
                        true => value.spellings().any(|text| glob.matches(text)),
                        false => glob.matches(&value.id),
                    },
                );
                accepted.exact_glob = Some(glob);
            }
            Wanted::Named(pattern) => {
                let glob = Glob::whole(pattern);
                let literal = glob.literal().is_some();
                // A pattern applies to the names of a value, not to its other spellings.
                let named = |value: &InventoryValue| {
                    let names = value.names.values().chain([&value.id]);
                    names.into_iter().any(|text| glob.fits(text, &fold(text)))
                };
                let reach = Reach::Narrower(glob.literal().map(|text| Wording {
                    text,
                    in_use: stored.is_some_and(|stored| stored.contains_key(text)),
                }));
                let fits = |value: &InventoryValue, folded: &[String]| match literal {
                    true => folded.iter().any(|text| glob.matches(text)),
                    false => named(value),
                };
                self.add(&mut accepted, (component, part), reach, fits);
                match glob.literal() {
                    Some(text) => {
                        accepted.folded.insert(text.to_owned());
                    }
                    None => accepted.folded_glob = Some(glob),
                }
            }
            Wanted::Features(features) => {
                self.add(&mut accepted, (component, part), Reach::Own, |value, _| {
                    has(value, features, exactly)
                });
            }
            Wanted::Present | Wanted::Missing(_) | Wanted::Steps(_) => {}
        }
        accepted
    }

    fn add(
        &self,
        accepted: &mut Accepted,
        (component, part): (Component, Option<&str>),
        reach: Reach<'_>,
        meant: impl Fn(&InventoryValue, &[String]) -> bool,
    ) {
        let mut beside: BTreeSet<&str> = BTreeSet::new();
        let mut all_meant: BTreeSet<(usize, &str)> = BTreeSet::new();
        let wording = match reach {
            Reach::Narrower(wording) => wording,
            _ => None,
        };
        let holds = |known: &Known| {
            let in_use = wording.filter(|it| it.in_use);
            in_use.is_some_and(|it| known.folded.iter().any(|own| own[0] == it.text))
        };
        // Values that an inventory with the wanted name distinguishes from it.
        let mut apart: BTreeSet<&str> = BTreeSet::new();
        for known in self.known(component, part).filter(|known| holds(known)) {
            let others = known.values().filter(|(value, own)| !meant(value, own));
            apart.extend(others.filter_map(|(_, own)| own.first().map(String::as_str)));
        }
        for (number, known) in self.known(component, part).enumerate() {
            // If a table has both names, an alias of the program does not make them one.
            let is_other = |own: &[String]| {
                known.is_builtin && !holds(known) && apart.contains(own[0].as_str())
            };
            let own = known
                .values()
                .filter(|(value, own)| meant(value, own) && !is_other(own))
                .map(|(value, _)| value.id.as_str());
            let meant: BTreeSet<&str> = own.collect();
            if meant.is_empty() {
                continue;
            }
            accepted.known = true;
            let is_meant = |value: &InventoryValue| meant.contains(value.id.as_str());
            for (value, folded) in known.values() {
                match reach {
                    Reach::Letters(text) if is_meant(value) => {
                        accepted.exact.extend(value.spellings().map(str::to_owned));
                        accepted.add_aliases(value, folded, text);
                    }
                    Reach::Letters(_) => beside.extend(value.spellings()),
                    Reach::Own if is_meant(value) => {
                        accepted.folded.extend(folded.iter().cloned());
                    }
                    Reach::Narrower(Some(wording)) if is_meant(value) => {
                        accepted.folded.extend(folded.iter().cloned());
                        accepted.add_aliases(value, folded, Some(wording.text));
                    }
                    Reach::Narrower(None) if is_meant(value) => {
                        accepted.folded.insert(fold(&value.id));
                    }
                    Reach::Narrower(_) if known.inventory.chain(&value.id).any(is_meant) => {
                        accepted.narrower.extend(folded.iter().cloned());
                    }
                    _ => {}
                }
            }
            all_meant.extend(meant.into_iter().map(|id| (number, id)));
        }
        // If a table codes lip and mouth separately, exactly mouth does not include its lip.
        accepted
            .exact
            .retain(|text| !beside.contains(text.as_str()));
        accepted
            .folded
            .retain(|text| !apart.contains(text.as_str()));
        if matches!(reach, Reach::Narrower(_)) && !all_meant.is_empty() {
            self.add_places_of_tables(accepted, (component, part), &all_meant, &apart);
        }
        let Accepted {
            folded, narrower, ..
        } = accepted;
        narrower.retain(|text| !folded.contains(text));
    }

    /// Adds values of inventories without a hierarchy of their own that another inventory places below the wanted ones,
    /// in everyday spellings: `under chin`, `side of head`, `chin ipsi`. Values that are `apart` are not equal to the
    /// wanted ones, but may be below them.
    fn add_places_of_tables(
        &self,
        accepted: &mut Accepted,
        (component, part): (Component, Option<&str>),
        meant: &BTreeSet<(usize, &str)>,
        apart: &BTreeSet<&str>,
    ) {
        let known: Vec<&Known> = self.known(component, part).collect();
        let ordered = |known: &Known| known.inventory.values.iter().any(|it| it.broader.is_some());
        for (number, order) in known.iter().enumerate().filter(|(_, it)| ordered(it)) {
            let mut places: BTreeMap<String, &InventoryValue> = BTreeMap::new();
            for (value, folded) in order.values() {
                for text in folded {
                    places.entry(loose(text)).or_insert(value);
                }
            }
            let is = |it: &InventoryValue| meant.contains(&(number, it.id.as_str()));
            let under = |place: &InventoryValue| order.inventory.chain(&place.id).skip(1).any(is);
            for table in known.iter().filter(|it| !ordered(it)) {
                for (_, folded) in table.values() {
                    for text in folded {
                        let written = loose(text);
                        let whole = || places.get(whole_of(&written)?);
                        let found = match places.get(&written) {
                            Some(same) => under(same) || is(same) && !apart.contains(text.as_str()),
                            None => whole().is_some_and(|whole| is(whole) || under(whole)),
                        };
                        if found {
                            accepted.narrower.insert(text.clone());
                        }
                    }
                }
            }
        }
    }
}

/// Returns a folded spelling in the form for comparisons between inventories: hyphens become blanks, and articles are
/// removed.
fn loose(text: &str) -> String {
    let text = text.replace(['-', '_'], " ");
    let words = text.split_whitespace();
    let words: Vec<&str> = words.filter(|word| *word != "the").collect();
    words.join(" ")
}

/// Returns the larger place if a place is a part or a side of one: `head` for `side of head`, `chin` for `chin ipsi`,
/// `weak hand` for `weak hand: palm`, `leg` for `upper leg`.
fn whole_of(place: &str) -> Option<&str> {
    const SIDES: [&str; 4] = [" ipsi", " contra", " ipsilateral", " contralateral"];
    let sided = SIDES.iter().find_map(|side| place.strip_suffix(side));
    let part = || Some(place.split_once(':')?.0.trim_end());
    let within = |word: &str| Some(place.rsplit_once(word)?.1);
    let half = || {
        ["upper ", "lower "]
            .iter()
            .find_map(|it| place.strip_prefix(it))
    };
    sided
        .or_else(part)
        .or_else(|| within(" of "))
        .or_else(|| within(" in "))
        .or_else(half)
}

/// The spellings that are accepted for the wanted values.
#[derive(Clone, Copy)]
enum Reach<'a> {
    /// The name alone.
    Name,
    /// Spellings of the wanted values only, with case and accents; with the folded name that is asked for.
    Letters(Option<&'a str>),
    /// Spellings of the wanted values only, ignoring case and accents.
    Own,
    /// Narrower values, in the hierarchy of any inventory; of a wanted name also the other spellings.
    Narrower(Option<Wording<'a>>),
}

/// The name by which a query asks for a value.
#[derive(Clone, Copy)]
struct Wording<'a> {
    /// The name, folded.
    text: &'a str,
    /// Whether a value in use has exactly this name.
    in_use: bool,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_and_sides_of_places_name_the_larger_place() {
        for (place, whole) in [
            ("chin ipsi", Some("chin")),
            ("side of head", Some("head")),
            ("weak hand: palm", Some("weak hand")),
            ("neutral space: high", Some("neutral space")),
            ("low in neutral space", Some("neutral space")),
            ("upper leg", Some("leg")),
            ("chest", None),
        ] {
            assert_eq!(whole_of(place), whole, "{place}");
        }
    }
}
