//! Values of two inventories made one: proposed by what they are, confirmed by a person.

use std::cmp::{Ordering, Reverse};
use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::text::fold_text;
use chereme_sign::{ComponentField, ComponentInventory, InventoryValue, SignComponent};
use serde::Serialize;

use super::require_inventory_value;
use crate::Corpus;
use crate::db::stored_inventories as rows;
use crate::error::{CorpusError, CorpusResult};
use crate::inventories::{self, EqualValues, StoredInventory, ValueName};
use crate::words::effect::OperationEffect;

/// Two values of different inventories that may be one.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct EqualProposal {
    /// The value of the later inventory.
    pub value: ValueName,
    /// The value that would stand for both.
    pub other: ValueName,
    /// In what they are equal: `name`, `symbols`, `posture`, `place`, `direction`, `orientation`, `features`.
    pub reasons: Vec<&'static str>,
}

/// The most pairs of values of two inventories that are compared.
const MAX_COMPARED_PAIRS: usize = 1 << 20;
/// The largest difference between two joint angles of one handshape, in degrees.
const MAX_POSTURE_DEGREES: f64 = 10.0;
/// The largest distance of two places that are one, in shoulder widths.
const MAX_PLACE_DISTANCE: f64 = 0.1;

impl Corpus {
    /// Returns the values of different inventories that are one.
    ///
    /// # Errors
    /// Fails if the corpus cannot be read.
    pub fn list_equal_values(&self) -> CorpusResult<EqualValues> {
        EqualValues::load_equal_values(self.store.read_connection())
    }

    /// Makes two values one, named as `INVENTORY/VALUE`, and returns all that are one with them; the second stands for the
    /// first. Each coding keeps its own word, and a search by either finds both.
    ///
    /// # Errors
    /// Fails if there is no such value, they belong to different components, or an inventory keeps both apart.
    pub fn equate_values(&mut self, value: &str, other: &str) -> CorpusResult<Vec<ValueName>> {
        self.store.run_store_operation(|connection| {
            let all = inventories::load_all_inventories(connection)?;
            let [one, two] = [find_named_value(&all, value)?, find_named_value(&all, other)?];
            if one.0.inventory_field() != two.0.inventory_field() {
                let text = format!(
                    "{value} is a value of {}, {other} one of {}",
                    one.0.inventory_field(),
                    two.0.inventory_field()
                );
                return Err(CorpusError::from_wrong_message(text)
                    .with_error_place(value)
                    .with_advice("name two values of one component"));
            }
            let known = EqualValues::load_equal_values(connection)?;
            let [first, second] = [&one, &two].map(|named| group_with(&known, named));
            let mut joined = second.clone();
            joined.extend(first.iter().filter(|name| !second.contains(name)).cloned());
            refuse_kept_apart(&all, &one.0.inventory_field(), &joined)?;
            for name in first.iter().filter(|name| !second.contains(name)) {
                rows::set_same_as(connection, [&name.inventory, &name.value], Some(&second[0].to_string()))?;
            }
            let effect = OperationEffect::EquateValues {
                value: value_name(&one).to_string(),
                other: value_name(&two).to_string(),
            };
            Ok((joined, effect))
        })
    }

    /// Takes a value out of those that it is one with, and returns it.
    ///
    /// # Errors
    /// Fails if there is no such value, or it is one with no other.
    pub fn part_equal_value(&mut self, value: &str) -> CorpusResult<ValueName> {
        self.store.run_store_operation(|connection| {
            let all = inventories::load_all_inventories(connection)?;
            let name = value_name(&find_named_value(&all, value)?);
            let known = EqualValues::load_equal_values(connection)?;
            let Some(group) = known.find_equal_group(&name.inventory, &name.value) else {
                return Err(
                    CorpusError::from_wrong_message(format!("{name} is one with no other value"))
                        .with_error_place(value)
                        .with_command_advice("`chereme inventory CORPUS equate` lists the values that are one"),
                );
            };
            let left: Vec<&ValueName> = group.iter().filter(|member| **member != name).collect();
            rows::set_same_as(connection, [&name.inventory, &name.value], None)?;
            for member in &left {
                let standing = (*member != left[0]).then(|| left[0].to_string());
                rows::set_same_as(connection, [&member.inventory, &member.value], standing.as_deref())?;
            }
            let effect = OperationEffect::PartValue {
                value: name.to_string(),
            };
            Ok((name, effect))
        })
    }

    /// Returns values of different inventories that seem to be one, those that are equal in most first. A value is proposed
    /// for one value of another inventory at most, and not if several would do.
    ///
    /// # Errors
    /// Fails if the corpus cannot be read.
    pub fn propose_equal_values(&self) -> CorpusResult<Vec<EqualProposal>> {
        let connection = self.store.read_connection();
        let all = inventories::load_all_inventories(connection)?;
        let known = EqualValues::load_equal_values(connection)?;
        let mut proposals = Vec::new();
        for (number, later) in all.iter().enumerate() {
            for earlier in &all[..number] {
                if later.inventory.inventory_field() == earlier.inventory.inventory_field() {
                    proposals.extend(propose_between(&all, &known, [&later.inventory, &earlier.inventory]));
                }
            }
        }
        proposals.sort_by_key(|proposal: &EqualProposal| Reverse(proposal.reasons.len()));
        Ok(proposals)
    }
}

/// A value with its inventory.
type NamedValue<'i> = (&'i ComponentInventory, &'i InventoryValue);

fn value_name((inventory, value): &NamedValue<'_>) -> ValueName {
    ValueName {
        inventory: inventory.id.clone(),
        value: value.id.clone(),
    }
}

/// Returns a value and those that are one with it.
fn group_with(known: &EqualValues, named: &NamedValue<'_>) -> Vec<ValueName> {
    let group = known.find_equal_group(&named.0.id, &named.1.id);
    group.map_or_else(|| vec![value_name(named)], <[ValueName]>::to_vec)
}

/// Returns the value that `INVENTORY/VALUE` names; the key of an inventory may hold a stroke itself.
fn find_named_value<'i>(all: &'i [StoredInventory], text: &str) -> CorpusResult<NamedValue<'i>> {
    let value_text = |inventory: &ComponentInventory| {
        let rest = text.trim().strip_prefix(inventory.id.as_str())?;
        rest.strip_prefix('/').map(str::to_owned)
    };
    let named = all
        .iter()
        .filter_map(|stored| Some((&stored.inventory, value_text(&stored.inventory)?)));
    let Some((inventory, value)) = named.max_by_key(|(inventory, _)| inventory.id.len()) else {
        return Err(
            CorpusError::from_wrong_message(format!("{text:?} names no inventory of the corpus"))
                .with_error_place(text)
                .with_command_advice("write INVENTORY/VALUE; `chereme list CORPUS inventories` lists them"),
        );
    };
    Ok((inventory, require_inventory_value(inventory, &value)?))
}

/// Fails if an inventory of a field distinguishes two of the values that would be one: a search could not.
fn refuse_kept_apart(all: &[StoredInventory], field: &ComponentField, joined: &[ValueName]) -> CorpusResult<()> {
    let texts: BTreeSet<String> = joined.iter().map(|name| fold_text(&name.value)).collect();
    for stored in all.iter().filter(|stored| stored.inventory.inventory_field() == *field) {
        let values = stored.inventory.values.iter();
        let apart: Vec<&str> = values
            .filter(|value| texts.contains(&fold_text(&value.id)))
            .map(|value| value.id.as_str())
            .collect();
        if apart.len() > 1 {
            let text = format!(
                "the inventory {:?} keeps these values apart: {}",
                stored.inventory.id,
                apart.join(", ")
            );
            return Err(CorpusError::from_wrong_message(text)
                .with_error_place(&stored.inventory.id)
                .with_command_advice("if they are one there, too, merge them first: `chereme inventory CORPUS merge-value INVENTORY VALUE OTHER`"));
        }
    }
    Ok(())
}

/// Returns the values of two inventories that seem to be one.
fn propose_between(
    all: &[StoredInventory],
    known: &EqualValues,
    [later, earlier]: [&ComponentInventory; 2],
) -> Vec<EqualProposal> {
    if later.values.len().saturating_mul(earlier.values.len()) > MAX_COMPARED_PAIRS {
        return Vec::new();
    }
    let mut alike = Vec::new();
    // For each value of either side, the most reasons for a partner, and how many partners have so many.
    let mut best: BTreeMap<(bool, &str), (usize, usize)> = BTreeMap::new();
    for value in &later.values {
        for other in &earlier.values {
            let reasons = equal_reasons(all, value, other);
            for side in [(true, value.id.as_str()), (false, other.id.as_str())] {
                let most = best.entry(side).or_default();
                *most = match reasons.len().cmp(&most.0) {
                    Ordering::Greater => (reasons.len(), 1),
                    Ordering::Equal => (most.0, most.1 + 1),
                    Ordering::Less => *most,
                };
            }
            if !reasons.is_empty() {
                alike.push((value, other, reasons));
            }
        }
    }
    let is_best = |side: (bool, &str), reasons: usize| best.get(&side) == Some(&(reasons, 1));
    let proposal = |(value, other, reasons): (&InventoryValue, &InventoryValue, Vec<&'static str>)| {
        let named = [(later, value), (earlier, other)];
        let [group, other_group] = named.map(|named| group_with(known, &named));
        let is_new = !group.contains(&value_name(&named[1]));
        let joined = [group, other_group].concat();
        (is_new
            && is_best((true, &value.id), reasons.len())
            && is_best((false, &other.id), reasons.len())
            && refuse_kept_apart(all, &later.inventory_field(), &joined).is_ok())
        .then(|| EqualProposal {
            value: value_name(&named[0]),
            other: value_name(&named[1]),
            reasons,
        })
    };
    alike.into_iter().filter_map(proposal).collect()
}

/// Returns in what two values are equal.
fn equal_reasons(all: &[StoredInventory], value: &InventoryValue, other: &InventoryValue) -> Vec<&'static str> {
    let spellings = |value: &InventoryValue| value.value_spellings().map(fold_text).collect::<BTreeSet<_>>();
    let posture = |value: &InventoryValue| {
        let handshapes = all.iter().map(|stored| &stored.inventory);
        let mut handshapes = handshapes.filter(|inventory| inventory.component == SignComponent::Configuration);
        handshapes.find_map(|inventory| value.hand_pose(inventory))
    };
    let is_posture = posture(value).zip(posture(other)).is_some_and(|(own, other)| {
        let mut angles = own.to_array().into_iter().zip(other.to_array());
        angles.all(|(own, other)| (own - other).abs().to_degrees() <= MAX_POSTURE_DEGREES)
    });
    let distance = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    let is_place = value
        .landmark
        .as_ref()
        .zip(other.landmark.as_ref())
        .is_some_and(|(own, other)| {
            own.name == other.name && distance(&own.offset, &other.offset) <= MAX_PLACE_DISTANCE
        });
    let is_direction = value.direction.as_ref().zip(other.direction.as_ref());
    let is_direction = is_direction.is_some_and(|(own, other)| distance(own, other) <= MAX_PLACE_DISTANCE);
    [
        ("name", !spellings(value).is_disjoint(&spellings(other))),
        ("symbols", value.hamnosys.is_some() && value.hamnosys == other.hamnosys),
        ("posture", is_posture),
        ("place", is_place),
        ("direction", is_direction),
        (
            "orientation",
            value.orientation.is_some() && value.orientation == other.orientation,
        ),
        (
            "features",
            !value.features.is_empty() && value.features == other.features,
        ),
    ]
    .into_iter()
    .filter_map(|(reason, is_equal)| is_equal.then_some(reason))
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lexicon::LexiconScope;
    use crate::{ImportOptions, PairOptions, ProgressReceiver, SearchOptions};

    /// Makes a corpus with two tables that name one handshape in two ways; one keeps two more apart.
    fn corpus_of_words(folder: &std::path::Path) -> Corpus {
        let one = "Gloss,Handshape\nA,palm-hand\nC,palm-hand\nD,claw-hand\n";
        corpus_of_tables(folder, [one, "Gloss,Handshape\nE,surface\nF,hook\nG,hook\n"])
    }

    fn corpus_of_tables(folder: &std::path::Path, tables: [&str; 2]) -> Corpus {
        let mut corpus = Corpus::create_corpus(&folder.join("c.chereme"), "test").expect("made");
        for (name, table) in ["one.csv", "two.csv"].into_iter().zip(tables) {
            let path = folder.join(name);
            std::fs::write(&path, table).expect("written");
            let imported = corpus.import_paths(
                &[path],
                &ImportOptions::default(),
                &mut ProgressReceiver::silent_progress(),
            );
            imported.expect("imported");
        }
        corpus
    }

    fn count(corpus: &mut Corpus, query: &str) -> usize {
        let answer = corpus.search_tokens(query, &SearchOptions::default());
        answer.expect(query).total
    }

    fn facets(corpus: &mut Corpus) -> Vec<(String, usize)> {
        let options = SearchOptions {
            facets: true,
            ..SearchOptions::default()
        };
        let answer = corpus.search_tokens("", &options).expect("an answer");
        let handshapes = answer
            .facets
            .into_iter()
            .find(|(field, _)| field.ends_with("configuration"));
        let mut counts = handshapes.expect("handshapes").1;
        counts.sort();
        counts
    }

    #[test]
    fn values_that_are_one_are_found_by_either_word_and_counted_once() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = corpus_of_words(folder.path());
        let one = |value: &str| format!("one/configuration/{value}");
        let two = |value: &str| format!("two/configuration/{value}");
        let all = inventories::load_all_inventories(corpus.store.read_connection()).expect("inventories");
        let keys: Vec<&str> = all.iter().map(|stored| stored.inventory.id.as_str()).collect();
        assert!(
            keys.contains(&"one/configuration") && keys.contains(&"two/configuration"),
            "{keys:?}"
        );
        assert_eq!(count(&mut corpus, "configuration=surface"), 1);
        let joined = corpus.equate_values(&two("surface"), &one("palm-hand")).expect("one");
        let texts: Vec<String> = joined.iter().map(ToString::to_string).collect();
        assert_eq!(texts, [one("palm-hand"), two("surface")]);
        for (query, wanted) in [
            ("configuration=surface", 3),
            ("configuration=palm-hand", 3),
            ("configuration==surface", 3),
            ("configuration!=surface", 3),
            ("configuration=surface inventory=two/configuration", 1),
            ("configuration=hook", 2),
        ] {
            assert_eq!(count(&mut corpus, query), wanted, "{query}");
        }
        let counted = [("claw-hand", 1), ("hook", 2), ("palm-hand", 3)].map(|(value, n)| (value.to_owned(), n));
        assert_eq!(facets(&mut corpus), counted);
        let progress = &mut ProgressReceiver::silent_progress();
        let tally = corpus
            .tally_values("", &["configuration".to_owned()], progress)
            .expect("counted");
        let mut rows: Vec<(String, usize)> = tally.rows.into_iter().map(|row| (row.value, row.total)).collect();
        rows.sort();
        assert_eq!(rows, counted);
        // An answer says that it took another word for the one that was asked for.
        let answer = corpus
            .search_tokens("configuration=surface", &SearchOptions::default())
            .expect("an answer");
        let said = answer
            .findings
            .iter()
            .map(|one| one.finding_message())
            .collect::<Vec<_>>()
            .join("; ");
        assert!(said.contains("are one with it, too: palm-hand (2)"), "{said}");
        let refused = corpus
            .equate_values(&two("surface"), &one("claw-hand"))
            .expect_err("two of one table");
        assert!(refused.to_string().contains("keeps these values apart"), "{refused}");
        assert!(corpus.equate_values(&two("surface"), "placements/chin").is_err());
        assert!(corpus.equate_values("nowhere/at-all", &two("surface")).is_err());
        let listed = corpus.list_equal_values().expect("a list");
        assert!(listed.has_stand_in(
            all.iter().map(|stored| &stored.inventory),
            "two/configuration",
            "surface"
        ));
        assert_eq!(
            corpus.part_equal_value(&one("palm-hand")).expect("parted").to_string(),
            one("palm-hand")
        );
        assert_eq!(count(&mut corpus, "configuration=surface"), 1);
        assert!(corpus.part_equal_value(&one("palm-hand")).is_err());
        corpus.undo_operation().expect("undone");
        assert_eq!(count(&mut corpus, "configuration=surface"), 3);
    }

    #[test]
    fn signs_are_compared_by_the_words_that_stand_for_theirs() {
        let folder = tempfile::tempdir().expect("a folder");
        let header = "Gloss,Handshape,Location,Movement direction\n";
        let one = format!("{header}A,palm-hand,chin,up\nC,claw-hand,chin,up\n");
        let two = format!("{header}E,surface,nose,up\nF,hook,ear,down\n");
        let mut corpus = corpus_of_tables(folder.path(), [&one, &two]);
        let compared = |corpus: &mut Corpus| {
            let options = PairOptions {
                fields: ["dominant.configuration", "placement", "movement.direction"]
                    .map(str::to_owned)
                    .to_vec(),
                scope: LexiconScope::Across,
                ..PairOptions::default()
            };
            let pairs = corpus
                .minimal_pairs(&options, &mut ProgressReceiver::silent_progress())
                .expect("pairs");
            let pairs: Vec<String> = pairs
                .list
                .iter()
                .map(|pair| format!("{} {} {}", pair.a, pair.b, pair.field))
                .collect();
            let suggested = corpus
                .suggest_new_signs(&"sign:A".parse().expect("an address"), true)
                .expect("suggestions");
            let partners: Vec<[String; 3]> = suggested
                .partners
                .into_iter()
                .map(|partner| [partner.gloss, partner.from, partner.to])
                .collect();
            (pairs, partners, suggested.coding["dominant.configuration"].clone())
        };
        let (pairs, partners, _) = compared(&mut corpus);
        assert_eq!(pairs, ["A C dominant.configuration"]);
        assert_eq!(partners, [["C", "palm-hand", "claw-hand"].map(str::to_owned)]);
        corpus
            .equate_values("one/configuration/palm-hand", "two/configuration/surface")
            .expect("one");
        let (pairs, partners, coding) = compared(&mut corpus);
        assert_eq!(pairs, ["A C dominant.configuration", "A E placement"]);
        assert_eq!(
            partners,
            [["C", "palm-hand", "claw-hand"], ["E", "chin", "nose"]].map(|row| row.map(str::to_owned))
        );
        assert_eq!(coding, "palm-hand", "a coding keeps its own word");
    }

    #[test]
    fn a_group_stays_one_when_values_are_merged_or_the_first_is_taken_out() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = corpus_of_words(folder.path());
        let (palm, surface, flat) = (
            "one/configuration/palm-hand",
            "two/configuration/surface",
            "configurations/flat",
        );
        corpus.equate_values(surface, palm).expect("one");
        corpus.equate_values(palm, flat).expect("one");
        let groups = |corpus: &Corpus| {
            let listed = corpus.list_equal_values().expect("a list");
            let named = |group: &Vec<ValueName>| group.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ");
            listed.equal_groups().iter().map(named).collect::<Vec<_>>()
        };
        assert_eq!(groups(&corpus), [format!("{flat} {palm} {surface}")]);
        corpus.part_equal_value(flat).expect("parted");
        assert_eq!(groups(&corpus), [format!("{palm} {surface}")]);
        corpus
            .merge_values("one/configuration", "palm-hand", "claw-hand")
            .expect("merged");
        assert_eq!(groups(&corpus), [format!("one/configuration/claw-hand {surface}")]);
        // A ring, as a merge of two corpora may leave, is one group as well.
        let connection = corpus.store.read_connection();
        rows::set_same_as(connection, ["one/configuration", "claw-hand"], Some(surface)).expect("written");
        assert_eq!(groups(&corpus), [format!("one/configuration/claw-hand {surface}")]);
    }

    #[test]
    fn values_are_proposed_by_what_they_are() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = corpus_of_words(folder.path());
        let proposed = |corpus: &Corpus| {
            let all = corpus.propose_equal_values().expect("proposals").into_iter();
            all.map(|one| (one.value.to_string(), one.other.to_string(), one.reasons.join(" ")))
                .collect::<Vec<_>>()
        };
        assert_eq!(proposed(&corpus), []);
        let builtin = chereme_sign::inventory::builtin_by_id("configurations").expect("handshapes");
        let bare = |id: &str, like: &str| InventoryValue {
            id: id.to_owned(),
            names: BTreeMap::new(),
            aliases: Vec::new(),
            broader: None,
            ..builtin.value_by_id(like).expect(like).clone()
        };
        corpus
            .add_value("one/configuration", &bare("wide", "5"))
            .expect("added");
        let named = InventoryValue {
            aliases: vec!["wide".to_owned()],
            ..InventoryValue {
                id: "broad".to_owned(),
                ..InventoryValue::default()
            }
        };
        corpus.add_value("two/configuration", &named).expect("added");
        let [wide, broad] = ["one/configuration/wide", "two/configuration/broad"].map(str::to_owned);
        let reasons = "symbols posture features".to_owned();
        assert_eq!(
            proposed(&corpus),
            [
                (wide.clone(), "configurations/5".to_owned(), reasons),
                (broad.clone(), wide.clone(), "name".to_owned())
            ]
        );
        corpus.equate_values(&wide, "configurations/5").expect("one");
        assert_eq!(proposed(&corpus).len(), 1);
        // With two that are as like, none is proposed.
        corpus.part_equal_value(&wide).expect("parted");
        corpus
            .add_value("one/configuration", &bare("wider", "5"))
            .expect("added");
        assert_eq!(proposed(&corpus).len(), 1);
    }
}
