//! Inventories: the values that a component may have, as data.
//!
//! An [`ComponentInventory`] belongs to one component, or to one feature of it (the palm's direction, the brows). This project's
//! own are in `schema/inventories`, described by `schema/inventory.schema.json`, and come with the program:
//! [`builtin_inventories`]. Others are read with [`ComponentInventory::from_json`], in the same form.
//!
//! Directions and offsets are `[left, up, forward]` as the signer sees them, the axes of model
//! space; angles are radians here and degrees in the files.

mod inventory_json;
#[cfg(test)]
mod tests;

pub use inventory_json::{FilePosition, InventoryError};

use crate::component::{ComponentField, SignComponent};
use crate::text::{edit_distance, fold_text};
use chereme_motion::{BodySide, HandAngles};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

/// The values that one component, or one feature of it, may have.
#[derive(Debug, Clone, PartialEq)]
pub struct ComponentInventory {
    /// The name in files and queries, such as `configurations`.
    pub id: String,
    /// The component.
    pub component: SignComponent,
    /// The feature of the component, such as `palm`; `None` for the whole.
    pub feature: Option<String>,
    /// The version, raised whenever a value changes its meaning.
    pub version: u32,
    /// The sign language that it was made for, as people write it (`LSF`); `None` for any.
    pub language: Option<String>,
    /// Its names, by the code of the spoken language (`en`, `fr`).
    pub names: BTreeMap<String, String>,
    /// Its purpose and its source.
    pub description: String,
    /// The values, in the order in which they are offered.
    pub values: Vec<InventoryValue>,
}

/// One value of an inventory.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct InventoryValue {
    /// The name in files and queries, short as linguists write it: `U`, `chin`.
    pub id: String,
    /// Its names, by the code of the spoken language.
    pub names: BTreeMap<String, String>,
    /// Other spellings that mean the same.
    pub aliases: Vec<String>,
    /// The id of the broader value that includes this one: `chin` is part of `head`.
    pub broader: Option<String>,
    /// Its features, such as `index`, `spread` or `thumb-across`.
    pub features: BTreeSet<String>,
    /// The HamNoSys symbol names, in the order of the notation, separated by blanks.
    pub hamnosys: Option<String>,
    /// The value of the inventory `configurations` with the same handshape.
    pub configuration: Option<String>,
    /// The joint angles of the handshape.
    pub pose: Option<HandAngles>,
    /// The letter of the alphabet that the value spells.
    pub letter: Option<String>,
    /// The directions of palm and fingers.
    pub orientation: Option<HandOrientation>,
    /// The strokes of the hand, one after another.
    pub strokes: Vec<LetterSignStroke>,
    /// The place on the body or in space.
    pub landmark: Option<BodyLandmark>,
    /// A direction as a unit vector.
    pub direction: Option<[f64; 3]>,
    /// The rotation of the palm about the hand's length in radians, as HamNoSys counts it: 0 is palm down when the hand
    /// points out; with growing angles the palm faces right, up, and left.
    pub roll: Option<f64>,
    /// The size in shoulder widths.
    pub size: Option<f64>,
    /// The number of times.
    pub times: Option<u32>,
    /// Anything else worth knowing.
    pub notes: Option<String>,
}

/// The directions of palm and fingers, as ids of the two orientation inventories.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct HandOrientation {
    /// A value of `orientation.palm`.
    pub palm: String,
    /// A value of `orientation.fingers`.
    pub fingers: String,
}

/// One stroke of a letter whose sign has movement.
#[derive(Debug, Clone, PartialEq)]
pub struct LetterSignStroke {
    /// A value of `movement.direction`; `None` for a stroke that stays in place.
    pub direction: Option<String>,
    /// The length in shoulder widths.
    pub size: f64,
    /// The rotation of the forearm during the stroke in radians, positive when the palm turns to face up.
    pub turn: f64,
}

/// A place by a landmark of the signer's body and an offset from it.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyLandmark {
    /// The landmark's name, such as `chin`; `ipsi-` and `contra-` at its start stand for the
    /// acting hand's own and other side.
    pub name: String,
    /// The offset of the place from the landmark in shoulder widths: left, up, forward; with `ipsi-` and `contra-`
    /// names the first counts away from the body's middle.
    pub offset: [f64; 3],
}

impl BodyLandmark {
    /// Returns the landmark's name and the offset `[left, up, forward]` for an acting hand.
    #[must_use]
    pub fn resolve_landmark(&self, hand: BodySide) -> (String, [f64; 3]) {
        let (side, rest) = match self.name.split_once('-') {
            Some(("ipsi", rest)) => (hand, rest),
            Some(("contra", rest)) => (hand.opposite_side(), rest),
            _ => return (self.name.clone(), self.offset),
        };
        let [out, up, forward] = self.offset;
        (
            format!("{}-{rest}", side.body_side_name()),
            [out * side.side_sign(), up, forward],
        )
    }
}

impl ComponentInventory {
    /// Returns the field that the values belong to.
    #[must_use]
    pub fn inventory_field(&self) -> ComponentField {
        let field = ComponentField::new(self.component);
        self.feature
            .iter()
            .fold(field, |field, feature| field.with_field_feature(feature))
    }

    /// Returns the value with this id, exactly as written.
    #[must_use]
    pub fn value_by_id(&self, id: &str) -> Option<&InventoryValue> {
        self.values.iter().find(|value| value.id == id)
    }

    /// Returns the value that `text` means: by its id, or else by id, alias or name in any
    /// language without regard to case and accents.
    #[must_use]
    pub fn find_inventory_value(&self, text: &str) -> Option<&InventoryValue> {
        self.value_by_id(text).or_else(|| {
            let wanted = spelling_key(text);
            let ids = self.values.iter().find(|value| spelling_key(&value.id) == wanted);
            ids.or_else(|| {
                self.values
                    .iter()
                    .find(|value| value.value_spellings().any(|s| spelling_key(s) == wanted))
            })
        })
    }

    /// Returns whether every text names a value, and texts that differ only in case or accents name different values.
    #[must_use]
    pub fn distinguishes_texts<'t>(&self, texts: impl IntoIterator<Item = &'t str>) -> bool {
        let mut first_texts: BTreeMap<(String, &str), &str> = BTreeMap::new();
        texts.into_iter().all(|text| {
            let found_value = self.find_inventory_value(text);
            found_value.is_some_and(|value| {
                let other = first_texts.insert((spelling_key(text), &value.id), text.trim());
                other.is_none_or(|other| other == text.trim())
            })
        })
    }

    /// Returns whether every text names a value, and no two of them the same one: aliases such as `upper lip` and
    /// `lower lip` of `mouth` are not kept apart.
    #[must_use]
    pub fn keeps_apart<'t>(&self, texts: impl IntoIterator<Item = &'t str>) -> bool {
        let mut first_texts: BTreeMap<&str, &str> = BTreeMap::new();
        texts.into_iter().all(|text| {
            let found_value = self.find_inventory_value(text);
            found_value.is_some_and(|value| {
                let other = first_texts.insert(&value.id, text.trim());
                other.is_none_or(|other| other == text.trim())
            })
        })
    }

    /// Returns the ids of up to five values that somebody who wrote `text` may have meant, the
    /// likeliest first.
    #[must_use]
    pub fn suggest_value_ids(&self, text: &str) -> Vec<&str> {
        let wanted = spelling_key(text);
        let most = (wanted.chars().count() / 3).max(1);
        let mut near: Vec<(usize, &str)> = Vec::new();
        for value in &self.values {
            let slips = |spelling: &str| {
                let spelling = spelling_key(spelling);
                let part = wanted.len() >= 3 && spelling.contains(&wanted);
                if part {
                    Some(1)
                } else {
                    edit_distance(&wanted, &spelling, most)
                }
            };
            if let Some(least) = value.value_spellings().filter_map(slips).min() {
                near.push((least, &value.id));
            }
        }
        near.sort_by_key(|(slips, _)| *slips);
        near.into_iter().take(5).map(|(_, id)| id).collect()
    }

    /// Returns whether the value `id` is `broader` or lies within it at any depth.
    #[must_use]
    pub fn is_within_value(&self, id: &str, broader: &str) -> bool {
        self.broader_value_chain(id).any(|value| value.id == broader)
    }

    /// Returns the value `id` and its broader values, the narrowest first.
    pub fn broader_value_chain<'a>(&'a self, id: &str) -> impl Iterator<Item = &'a InventoryValue> {
        let up = |value: &&'a InventoryValue| value.broader.as_deref().and_then(|broader| self.value_by_id(broader));
        std::iter::successors(self.value_by_id(id), up).take(self.values.len() + 1)
    }

    /// Returns every feature that any value has, in alphabetical order.
    #[must_use]
    pub fn feature_names(&self) -> BTreeSet<&str> {
        self.values
            .iter()
            .flat_map(|value| &value.features)
            .map(String::as_str)
            .collect()
    }
}

impl InventoryValue {
    /// Returns the name in `language`, or else in English, or else the id.
    #[must_use]
    pub fn value_name_in(&self, language: &str) -> &str {
        let named = self.names.get(language).or_else(|| self.names.get("en"));
        named.map_or(&self.id, String::as_str)
    }

    /// Returns the shape of the hand: the value's own, or that of the value that it names in the inventory
    /// `configurations`.
    #[must_use]
    pub fn hand_pose(&self, configurations: &ComponentInventory) -> Option<HandAngles> {
        let named = || configurations.value_by_id(self.configuration.as_deref()?)?.pose;
        self.pose.or_else(named)
    }

    /// Returns every spelling of the value: its id, its aliases, its names.
    pub fn value_spellings(&self) -> impl Iterator<Item = &str> {
        let others = self.aliases.iter().chain(self.names.values());
        std::iter::once(&self.id).chain(others).map(String::as_str)
    }
}

fn spelling_key(text: &str) -> String {
    fold_text(text.trim())
}

/// The files of `schema/inventories` by name, as they come with the program.
pub const BUILTIN_FILES: [(&str, &str); 6] = [
    (
        "configurations.json",
        chereme_data::schema_text("inventories/configurations.json"),
    ),
    (
        "lsf-alphabet.json",
        chereme_data::schema_text("inventories/lsf-alphabet.json"),
    ),
    (
        "placements.json",
        chereme_data::schema_text("inventories/placements.json"),
    ),
    (
        "movements.json",
        chereme_data::schema_text("inventories/movements.json"),
    ),
    (
        "orientations.json",
        chereme_data::schema_text("inventories/orientations.json"),
    ),
    (
        "nonmanuals.json",
        chereme_data::schema_text("inventories/nonmanuals.json"),
    ),
];

/// Returns the inventories that come with the program, in the order of their files.
#[must_use]
pub fn builtin_inventories() -> &'static [ComponentInventory] {
    static ALL_BUILTIN_INVENTORIES: LazyLock<Vec<ComponentInventory>> = LazyLock::new(|| {
        let read = |(_, text): &(&str, &str)| ComponentInventory::all_from_json(text);
        let all: Result<Vec<_>, _> = BUILTIN_FILES.iter().map(read).collect();
        all.expect("a test reads the built-in inventories")
            .into_iter()
            .flatten()
            .collect()
    });
    &ALL_BUILTIN_INVENTORIES
}

/// Returns the built-in inventory `id`, such as `configurations`.
#[must_use]
pub fn builtin_by_id(id: &str) -> Option<&'static ComponentInventory> {
    builtin_inventories().iter().find(|inventory| inventory.id == id)
}

/// Returns the first built-in inventory of the component and feature that `field` names,
/// whatever its hand and phase.
#[must_use]
pub fn builtin_for(field: &ComponentField) -> Option<&'static ComponentInventory> {
    builtin_inventories()
        .iter()
        .find(|inventory| inventory.component == field.component && inventory.feature == field.feature)
}
