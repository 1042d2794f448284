//! The values that queries may name: the values in the corpus's inventories.

use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::inventory::builtin_by_id;
use chereme_sign::query::{ComparisonOperator, ValueFeature, WantedValue};
use chereme_sign::text::{compose_accents, fold_text};
use chereme_sign::{ComponentField, ComponentInventory, InventoryValue, SignComponent};
use rusqlite::Connection;

use super::search_known::ReadingsByValue;
use super::search_texts::TextGlob;
use crate::error::CorpusResult;
use crate::inventories::{self, EqualValues};

/// The inventories of a corpus in the form for queries.
///
/// A name stands for every value that has it as id, alias or name, in any inventory of the component: values of the
/// same name are one value to a query.
pub(crate) struct QueryVocabulary {
    inventories: Vec<KnownInventory>,
    equal: Vec<EqualTexts>,
}

/// Texts of values that are one, as a person says.
struct EqualTexts {
    field: ComponentField,
    /// The texts, that of the value that stands for the others first.
    texts: Vec<String>,
}

/// An inventory, and the folded spellings of each of its values.
struct KnownInventory {
    inventory: ComponentInventory,
    /// Whether it comes with the program.
    is_builtin: bool,
    folded: Vec<Vec<String>>,
}

impl KnownInventory {
    fn new(inventory: ComponentInventory) -> Self {
        let values = inventory.values.iter();
        let folded = values.map(|value| value.value_spellings().map(fold_text).collect());
        Self {
            folded: folded.collect(),
            is_builtin: builtin_by_id(&inventory.id).is_some(),
            inventory,
        }
    }

    /// Returns the values with their folded spellings.
    fn values_with_spellings(&self) -> impl Iterator<Item = (&InventoryValue, &[String])> {
        let folded = self.folded.iter().map(Vec::as_slice);
        self.inventory.values.iter().zip(folded)
    }
}

/// The stored values that are accepted for one wanted value.
pub(crate) struct AcceptedValues {
    /// Spellings of the wanted values, folded.
    folded: BTreeSet<String>,
    /// The spellings among them that are accepted only because of an alias, folded.
    aliases: BTreeSet<String>,
    /// Spellings of narrower values, folded.
    narrower: BTreeSet<String>,
    exact: BTreeSet<String>,
    folded_glob: Option<TextGlob>,
    exact_glob: Option<TextGlob>,
    /// Whether a value of an inventory is among them.
    pub(crate) known: bool,
}

impl AcceptedValues {
    /// Returns whether a stored value is accepted.
    pub(crate) fn accepts_stored_value(&self, value: &str, folded: &str) -> bool {
        self.means_stored_value(value, folded) || self.narrower.contains(folded)
    }

    /// Returns whether a stored value is accepted as the wanted value itself, not as a narrower one.
    pub(crate) fn means_stored_value(&self, value: &str, folded: &str) -> bool {
        self.folded.contains(folded)
            || self.exact.contains(value)
            || self
                .folded_glob
                .as_ref()
                .is_some_and(|glob| glob.fits_either_text(value, folded))
            || self
                .exact_glob
                .as_ref()
                .is_some_and(|glob| glob.matches_whole_text(value))
    }

    /// Adds the spellings of a wanted value that are not its names; all of them if it is asked for by an alias.
    fn add_aliases(&mut self, value: &InventoryValue, folded: &[String], asked: Option<&str>) {
        let aliases: BTreeSet<String> = value.aliases.iter().map(|text| fold_text(text)).collect();
        let Some(asked) = asked else { return };
        // Asked for by an alias, the value's own name is what surprises.
        let by_alias = aliases.contains(asked);
        let others = folded.iter().filter(|alias| by_alias || aliases.contains(*alias));
        self.aliases.extend(others.filter(|alias| *alias != asked).cloned());
    }

    /// Returns whether a stored value is accepted as the wanted value only because of an alias.
    pub(crate) fn is_alias(&self, folded: &str) -> bool {
        self.aliases.contains(folded)
    }

    /// Returns all accepted values, folded, if they can be listed.
    pub(crate) fn listed_accepted_values(&self) -> Option<impl Iterator<Item = &String>> {
        let plain = self.exact.is_empty() && self.folded_glob.is_none() && self.exact_glob.is_none();
        plain.then(|| self.folded.union(&self.narrower))
    }
}

impl QueryVocabulary {
    /// Reads the inventories of a corpus.
    pub(crate) fn load_vocabulary(connection: &Connection) -> CorpusResult<Self> {
        let stored = inventories::load_all_inventories(connection)?;
        let equal_values = EqualValues::load_equal_values(connection)?;
        let mut equal = Vec::new();
        for group in equal_values.equal_groups() {
            let mut texts: Vec<String> = group.iter().map(|name| name.value.clone()).collect();
            texts.dedup();
            let first = stored.iter().find(|one| one.inventory.id == group[0].inventory);
            equal.extend(first.map(|one| EqualTexts {
                field: one.inventory.inventory_field(),
                texts,
            }));
        }
        let inventories = stored.into_iter().map(|mut one| {
            for value in &mut one.inventory.values {
                let group = equal_values
                    .find_equal_group(&one.inventory.id, &value.id)
                    .unwrap_or_default();
                let others = group.iter().filter(|name| name.value != value.id);
                // To a query, the words of the others are further spellings of the value.
                value.aliases.extend(others.map(|name| name.value.clone()));
            }
            KnownInventory::new(one.inventory)
        });
        Ok(Self {
            inventories: inventories.collect(),
            equal,
        })
    }

    /// Returns the texts of values of a part of a component that are one, in groups.
    pub(crate) fn equal_text_groups<'a>(
        &'a self,
        component: SignComponent,
        part: Option<&'a str>,
    ) -> impl Iterator<Item = &'a [String]> {
        let of_part =
            move |group: &&EqualTexts| group.field.component == component && group.field.feature.as_deref() == part;
        self.equal.iter().filter(of_part).map(|group| group.texts.as_slice())
    }

    /// Returns the inventories of a part of a component.
    pub(crate) fn part_inventories<'a>(
        &'a self,
        component: SignComponent,
        part: Option<&'a str>,
    ) -> impl Iterator<Item = &'a ComponentInventory> {
        self.known_part_inventories(component, part)
            .map(|known| &known.inventory)
    }

    fn known_part_inventories<'a>(
        &'a self,
        component: SignComponent,
        part: Option<&'a str>,
    ) -> impl Iterator<Item = &'a KnownInventory> {
        self.inventories
            .iter()
            .filter(move |known| known.inventory.component == component && known.inventory.feature.as_deref() == part)
    }

    fn all_vocabulary_inventories(&self) -> impl Iterator<Item = &ComponentInventory> {
        self.inventories.iter().map(|known| &known.inventory)
    }

    /// Returns the parts of a component that have inventories.
    pub(crate) fn component_inventory_parts(&self, component: SignComponent) -> BTreeSet<Option<String>> {
        let component_inventories = self
            .all_vocabulary_inventories()
            .filter(|one| one.component == component);
        component_inventories.map(|one| one.feature.clone()).collect()
    }

    /// Returns the ids of all inventories.
    pub(crate) fn inventory_ids(&self) -> impl Iterator<Item = &str> {
        self.all_vocabulary_inventories().map(|inventory| inventory.id.as_str())
    }

    /// Returns the feature names in the values of a component.
    pub(crate) fn component_feature_names(&self, component: SignComponent, part: Option<&str>) -> BTreeSet<&str> {
        self.all_vocabulary_inventories()
            .filter(|one| one.component == component)
            .filter(|one| part.is_none() || one.feature.as_deref() == part)
            .flat_map(ComponentInventory::feature_names)
            .collect()
    }

    /// Returns the accepted values for a wanted value in a part of a component; `stored` are the values in use.
    ///
    /// If a value in use has exactly the wanted name, aliases do not make it equal to other values of its inventory.
    pub(crate) fn find_accepted_values(
        &self,
        (component, part): (SignComponent, Option<&str>),
        operator: ComparisonOperator,
        wanted: &WantedValue,
        stored: Option<&ReadingsByValue>,
    ) -> AcceptedValues {
        let exactly = operator == ComparisonOperator::Exactly;
        let mut accepted = AcceptedValues {
            folded: BTreeSet::new(),
            aliases: BTreeSet::new(),
            narrower: BTreeSet::new(),
            exact: BTreeSet::new(),
            folded_glob: None,
            exact_glob: None,
            known: false,
        };
        match wanted {
            WantedValue::Named(pattern) if exactly => {
                let glob = TextGlob::from_exact_pattern(pattern);
                let literal = glob.literal_text().is_some();
                // A table may use the alias of a value as a name of its own, which then means only itself.
                let in_use = glob.literal_text().is_some_and(|text| {
                    let same_text = stored.and_then(|stored| stored.get(&fold_text(text)));
                    let mut alike = same_text.into_iter().flatten();
                    alike.any(|known| {
                        known
                            .reading
                            .reading_value()
                            .is_some_and(|value| compose_accents(value) == text)
                    })
                });
                let text = glob.literal_text().map(fold_text);
                let reach = match in_use {
                    true => SpellingReach::Name,
                    false => SpellingReach::Letters(text.as_deref()),
                };
                self.add_accepted_values(&mut accepted, (component, part), reach, |value, _| match literal {
                    true => value.value_spellings().any(|text| glob.matches_whole_text(text)),
                    false => glob.matches_whole_text(&value.id),
                });
                for texts in self.equal_text_groups(component, part) {
                    if literal && texts.iter().any(|text| glob.matches_whole_text(text)) {
                        let others = texts.iter().filter(|text| !glob.matches_whole_text(text));
                        accepted.aliases.extend(others.map(|text| fold_text(text)));
                        accepted.exact.extend(texts.iter().cloned());
                    }
                }
                accepted.exact_glob = Some(glob);
            }
            WantedValue::Named(pattern) => {
                let glob = TextGlob::from_whole_pattern(pattern);
                let literal = glob.literal_text().is_some();
                // A pattern applies to the names of a value, not to its other spellings.
                let named = |value: &InventoryValue| {
                    let names = value.names.values().chain([&value.id]);
                    names
                        .into_iter()
                        .any(|text| glob.fits_either_text(text, &fold_text(text)))
                };
                let reach = SpellingReach::Narrower(glob.literal_text().map(|text| QueryWording {
                    text,
                    in_use: stored.is_some_and(|stored| stored.contains_key(text)),
                }));
                let fits = |value: &InventoryValue, folded: &[String]| match literal {
                    true => folded.iter().any(|text| glob.matches_whole_text(text)),
                    false => named(value),
                };
                self.add_accepted_values(&mut accepted, (component, part), reach, fits);
                match glob.literal_text() {
                    Some(text) => {
                        accepted.folded.insert(text.to_owned());
                    }
                    None => accepted.folded_glob = Some(glob),
                }
            }
            WantedValue::Features(features) => {
                self.add_accepted_values(&mut accepted, (component, part), SpellingReach::Own, |value, _| {
                    has_wanted_features(value, features, exactly)
                });
            }
            WantedValue::Present | WantedValue::Missing(_) | WantedValue::Steps(_) => {}
        }
        accepted
    }

    fn add_accepted_values(
        &self,
        accepted: &mut AcceptedValues,
        (component, part): (SignComponent, Option<&str>),
        reach: SpellingReach<'_>,
        meant: impl Fn(&InventoryValue, &[String]) -> bool,
    ) {
        let mut distinguished: BTreeSet<&str> = BTreeSet::new();
        let mut all_meant: BTreeSet<(usize, &str)> = BTreeSet::new();
        let wording = match reach {
            SpellingReach::Narrower(wording) => wording,
            _ => None,
        };
        let holds = |known: &KnownInventory| {
            let in_use = wording.filter(|candidate| candidate.in_use);
            in_use.is_some_and(|used| known.folded.iter().any(|own| own[0] == used.text))
        };
        // Values that an inventory with the wanted name distinguishes from it.
        let mut apart: BTreeSet<&str> = BTreeSet::new();
        for known in self
            .known_part_inventories(component, part)
            .filter(|known| holds(known))
        {
            let others = known.values_with_spellings().filter(|(value, own)| !meant(value, own));
            apart.extend(others.filter_map(|(_, own)| own.first().map(String::as_str)));
        }
        for (number, known) in self.known_part_inventories(component, part).enumerate() {
            // If a table has both names, an alias of the program does not make them one.
            let is_other = |own: &[String]| known.is_builtin && !holds(known) && apart.contains(own[0].as_str());
            let fitting_ids = known
                .values_with_spellings()
                .filter(|(value, own)| meant(value, own) && !is_other(own))
                .map(|(value, _)| value.id.as_str());
            let meant_ids: BTreeSet<&str> = fitting_ids.collect();
            if meant_ids.is_empty() {
                continue;
            }
            accepted.known = true;
            let is_meant = |value: &InventoryValue| meant_ids.contains(value.id.as_str());
            for (value, folded) in known.values_with_spellings() {
                match reach {
                    SpellingReach::Letters(text) if is_meant(value) => {
                        accepted.exact.extend(value.value_spellings().map(str::to_owned));
                        accepted.add_aliases(value, folded, text);
                    }
                    SpellingReach::Letters(_) => distinguished.extend(value.value_spellings()),
                    SpellingReach::Own if is_meant(value) => {
                        accepted.folded.extend(folded.iter().cloned());
                    }
                    SpellingReach::Narrower(Some(wording)) if is_meant(value) => {
                        accepted.folded.extend(folded.iter().cloned());
                        accepted.add_aliases(value, folded, Some(wording.text));
                    }
                    SpellingReach::Narrower(None) if is_meant(value) => {
                        accepted.folded.insert(fold_text(&value.id));
                    }
                    SpellingReach::Narrower(_) if known.inventory.broader_value_chain(&value.id).any(is_meant) => {
                        accepted.narrower.extend(folded.iter().cloned());
                    }
                    _ => {}
                }
            }
            all_meant.extend(meant_ids.into_iter().map(|id| (number, id)));
        }
        // If a table codes lip and mouth separately, exactly mouth does not include its lip.
        accepted.exact.retain(|text| !distinguished.contains(text.as_str()));
        accepted.folded.retain(|text| !apart.contains(text.as_str()));
        if matches!(reach, SpellingReach::Narrower(_)) && !all_meant.is_empty() {
            self.add_places_of_tables(accepted, (component, part), &all_meant, &apart);
        }
        let AcceptedValues { folded, narrower, .. } = accepted;
        narrower.retain(|text| !folded.contains(text));
    }

    /// Adds values of inventories without a hierarchy of their own that another inventory places below the wanted ones,
    /// in everyday spellings: `under chin`, `side of head`, `chin ipsi`. Values that are `apart` are not equal to the
    /// wanted ones, but may be below them.
    fn add_places_of_tables(
        &self,
        accepted: &mut AcceptedValues,
        (component, part): (SignComponent, Option<&str>),
        meant: &BTreeSet<(usize, &str)>,
        apart: &BTreeSet<&str>,
    ) {
        let known_inventories: Vec<&KnownInventory> = self.known_part_inventories(component, part).collect();
        let ordered = |known: &KnownInventory| known.inventory.values.iter().any(|value| value.broader.is_some());
        for (number, order) in known_inventories.iter().enumerate().filter(|(_, it)| ordered(it)) {
            let mut places: BTreeMap<String, &InventoryValue> = BTreeMap::new();
            for (value, folded) in order.values_with_spellings() {
                for text in folded {
                    places.entry(loose_spelling(text)).or_insert(value);
                }
            }
            let is = |value: &InventoryValue| meant.contains(&(number, value.id.as_str()));
            // The chain begins with the place itself, which is no place below.
            let under = |place: &InventoryValue| order.inventory.broader_value_chain(&place.id).skip(1).any(is);
            for table in known_inventories.iter().filter(|candidate| !ordered(candidate)) {
                for (_, folded) in table.values_with_spellings() {
                    for text in folded {
                        let written = loose_spelling(text);
                        let whole_place = || places.get(whole_of(&written)?);
                        let is_meant = match places.get(&written) {
                            Some(same) => under(same) || is(same) && !apart.contains(text.as_str()),
                            None => whole_place().is_some_and(|whole| is(whole) || under(whole)),
                        };
                        if is_meant {
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
fn loose_spelling(text: &str) -> String {
    let text = text.replace(['-', '_'], " ");
    let all_words = text.split_whitespace();
    let words: Vec<&str> = all_words.filter(|word| *word != "the").collect();
    words.join(" ")
}

/// Returns the larger place if a place is a part or a side of one: `head` for `side of head`, `chin` for `chin ipsi`,
/// `weak hand` for `weak hand: palm`, `leg` for `upper leg`.
fn whole_of(place: &str) -> Option<&str> {
    const PLACE_SIDE_SUFFIXES: [&str; 4] = [" ipsi", " contra", " ipsilateral", " contralateral"];
    let sided = PLACE_SIDE_SUFFIXES.iter().find_map(|side| place.strip_suffix(side));
    let part = || Some(place.split_once(':')?.0.trim_end());
    let within = |word: &str| Some(place.rsplit_once(word)?.1);
    let half = || {
        ["upper ", "lower "]
            .iter()
            .find_map(|prefix| place.strip_prefix(prefix))
    };
    sided
        .or_else(part)
        .or_else(|| within(" of "))
        .or_else(|| within(" in "))
        .or_else(half)
}

/// The spellings that are accepted for the wanted values.
#[derive(Clone, Copy)]
enum SpellingReach<'a> {
    /// The name alone.
    Name,
    /// Spellings of the wanted values only, with case and accents; with the folded name that is asked for.
    Letters(Option<&'a str>),
    /// Spellings of the wanted values only, ignoring case and accents.
    Own,
    /// Narrower values, in the hierarchy of any inventory; of a wanted name also the other spellings.
    Narrower(Option<QueryWording<'a>>),
}

/// The name by which a query asks for a value.
#[derive(Clone, Copy)]
struct QueryWording<'a> {
    /// The name, folded.
    text: &'a str,
    /// Whether a value in use has exactly this name.
    in_use: bool,
}

fn has_wanted_features(value: &InventoryValue, features: &[ValueFeature], exactly: bool) -> bool {
    let own_features: BTreeSet<String> = value.features.iter().map(|name| fold_text(name)).collect();
    let all = features
        .iter()
        .all(|feature| own_features.contains(&fold_text(&feature.name)) != feature.absent);
    let wanted_features = features.iter().filter(|feature| !feature.absent);
    let named: BTreeSet<String> = wanted_features.map(|feature| fold_text(&feature.name)).collect();
    all && (!exactly || named == own_features)
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
