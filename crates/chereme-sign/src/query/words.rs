//! The words with a meaning in queries, with their synonyms.

use super::attributes;
use super::tree::{Missing, Property, TextField, TimeField};
use crate::component::{Component, HandRef};
use crate::relation::Relation;
use crate::text::{edit_distance, fold};

impl TextField {
    /// The text fields, `Any` first.
    pub const ALL: [Self; 4] = [Self::Any, Self::Gloss, Self::Translation, Self::Comment];

    /// Returns the name in queries.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.names()[0]
    }

    /// Returns every spelling that is understood, the canonical name first.
    #[must_use]
    pub fn names(self) -> &'static [&'static str] {
        match self {
            Self::Any => &["text", "texte"],
            Self::Gloss => &["gloss", "glose"],
            Self::Translation => &["translation", "traduction"],
            Self::Comment => &["comment", "commentaire", "note"],
        }
    }
}

impl Property {
    /// Every property.
    pub const ALL: [Self; 8] = [
        Self::Origin,
        Self::Signer,
        Self::Recording,
        Self::Sign,
        Self::Token,
        Self::Tier,
        Self::Inventory,
        Self::Hand,
    ];

    /// Returns the name in queries.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.names()[0]
    }

    /// Returns every spelling that is understood, the canonical name first.
    #[must_use]
    pub fn names(self) -> &'static [&'static str] {
        match self {
            Self::Origin => &["origin", "origine"],
            Self::Signer => &["signer", "participant", "signeur"],
            Self::Recording => &["recording", "enregistrement"],
            Self::Sign => &["sign", "signe"],
            Self::Token => &["token"],
            Self::Tier => &["tier"],
            Self::Inventory => &["inventory", "inventaire"],
            Self::Hand => &["hand", "main"],
        }
    }

    /// Returns the only possible values, if they are fixed.
    #[must_use]
    pub fn fixed_values(self) -> Option<&'static [&'static str]> {
        match self {
            Self::Origin => Some(&["captured", "made", "lexicon", "generated"]),
            Self::Hand => Some(&["right", "left", "dominant", "weak", "both"]),
            _ => None,
        }
    }
}

impl TimeField {
    /// The three times.
    pub const ALL: [Self; 3] = [Self::Duration, Self::Start, Self::End];

    /// Returns the name in queries.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.names()[0]
    }

    /// Returns every spelling that is understood, the canonical name first.
    #[must_use]
    pub fn names(self) -> &'static [&'static str] {
        match self {
            Self::Duration => &["duration", "durée", "length"],
            Self::Start => &["start", "début", "begin"],
            Self::End => &["end", "fin"],
        }
    }
}

/// Returns the origin that another word means, such as those that tables and pictures write beside signs.
pub(super) fn origin(text: &str) -> Option<&'static str> {
    Some(match &*fold(text) {
        "synthesised" | "synthesized" | "composed" | "compose" => "made",
        "notated" | "notation" | "lexicon entry" | "note" | "entree de lexique" => "lexicon",
        "capte" => "captured",
        "produit" => "generated",
        _ => return None,
    })
}

/// The word that opens a relation with a distance.
pub(super) const WITHIN: &str = "within";
/// The words after the distance of `within`.
pub(super) const WITHIN_KINDS: [&str; 3] = ["around", "of-begin", "of-end"];
/// The word that opens a search by example.
pub(super) const LIKE: &str = "like";
/// The word between an example and the components that count.
pub(super) const ON: &str = "on";
/// Words that people write in place of `on`.
pub(super) const INSTEAD_OF_ON: [&str; 6] = ["in", "by", "with", "of", "for", "sur"];
/// The word before a tier's name in parentheses.
pub(super) const TIER: &str = "tier";

/// The word before the least similarity in a search by example.
pub(super) const ABOVE: &str = "above";

/// French for the parts of a component's name.
const FRENCH: [(&str, &str); 10] = [
    ("emplacement", "placement"),
    ("mouvement", "movement"),
    ("nonmanuel", "nonmanual"),
    ("non-manuel", "nonmanual"),
    ("droite", "right"),
    ("gauche", "left"),
    ("dominante", "dominant"),
    ("faible", "weak"),
    ("initiale", "initial"),
    ("finale", "final"),
];

/// Units of time with their length in microseconds, the plainest spelling of each unit first.
pub(super) const UNITS: [(&str, i64); 9] = [
    ("s", 1_000_000),
    ("sec", 1_000_000),
    ("seconds", 1_000_000),
    ("ms", 1000),
    ("min", 60_000_000),
    ("us", 1),
    ("µs", 1),
    ("μs", 1),
    ("second", 1_000_000),
];

/// A word that joins or negates terms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Joint {
    And,
    Or,
    Not,
}

/// Returns the joint that a word is, if it is one, in any case.
pub(super) fn joint(word: &str) -> Option<Joint> {
    let joints = [("and", Joint::And), ("or", Joint::Or), ("not", Joint::Not)];
    // In capitals they are glosses of French signs.
    let french = [("et", Joint::And), ("ou", Joint::Or), ("non", Joint::Not)];
    let english = joints
        .into_iter()
        .find(|(name, _)| name.eq_ignore_ascii_case(word));
    english
        .or_else(|| french.into_iter().find(|(name, _)| *name == word))
        .map(|(_, joint)| joint)
}

/// French for relations without a distance, understood if a comparison follows.
const FRENCH_RELATIONS: [(&str, &str); 12] = [
    ("chevauche", "overlaps"),
    ("ne-chevauche-pas", "not-overlaps"),
    ("dans", "inside"),
    ("hors-de", "not-inside"),
    ("avant", "before"),
    ("après", "after"),
    ("apres", "after"),
    ("égale", "equals"),
    ("couvre", "covers"),
    ("commence", "starts"),
    ("termine", "finishes"),
    ("rencontre", "meets"),
];

/// Returns the relation that a French word names, in lower case.
pub(super) fn french_relation(word: &str) -> Option<Relation> {
    let found = FRENCH_RELATIONS.iter().find(|(french, _)| *french == word);
    found.and_then(|(_, english)| plain_relation(english))
}

/// French for [`LIKE`] and [`ON`].
pub(super) const FRENCH_LIKE: &str = "comme";
pub(super) const FRENCH_ON: &str = "sur";

/// Parts of components that every corpus may have, with their component.
const PARTS: [(&str, Component); 18] = [
    ("palm", Component::Orientation),
    ("fingers", Component::Orientation),
    ("handedness", Component::Configuration),
    ("change", Component::Configuration),
    ("contact", Component::Placement),
    ("relation", Component::Placement),
    ("direction", Component::Movement),
    ("shape", Component::Movement),
    ("manner", Component::Movement),
    ("repeated", Component::Movement),
    ("alternating", Component::Movement),
    ("brows", Component::NonManual),
    ("gaze", Component::NonManual),
    ("mouth", Component::NonManual),
    ("mouthing", Component::NonManual),
    ("lids", Component::NonManual),
    ("shoulders", Component::NonManual),
    ("phase", Component::Movement),
];

/// Returns the component that has a part of this name.
pub(super) fn component_of_part(name: &str) -> Option<Component> {
    let found = PARTS.iter().find(|(part, _)| *part == name);
    found.map(|(_, component)| *component)
}

/// Returns the relation without a distance that a word names; words in capitals are glosses.
pub(super) fn plain_relation(word: &str) -> Option<Relation> {
    Relation::PLAIN
        .into_iter()
        .find(|(name, _)| *name == word)
        .map(|(_, relation)| relation)
}

/// Returns the reason for a missing value that an unquoted value names.
pub(super) fn missing(word: &str) -> Option<Missing> {
    let word = if word == "N/A" { "n/a" } else { word };
    Missing::ALL
        .into_iter()
        .find(|missing| missing.name() == word)
}

/// Returns whether a bare word is reserved and never searched for.
pub(super) fn is_reserved(word: &str) -> bool {
    joint(word).is_some()
        || plain_relation(word).is_some()
        || [WITHIN, LIKE, ON, TIER, ABOVE, FRENCH_LIKE].contains(&word)
        || french_relation(word).is_some()
        || WITHIN_KINDS.contains(&word)
        || INSTEAD_OF_ON.contains(&word)
}

/// Returns whether an opening parenthesis directly after this word is a parenthesis of the query, and not part of a
/// word.
pub(super) fn opens_group(word: &str) -> bool {
    joint(word).is_some()
        || plain_relation(word).is_some()
        || word == TIER
        || attributes::opens_name(word)
}

/// Returns the relation that a lower-case word nearly names.
pub(super) fn near_relation(word: &str) -> Option<&'static str> {
    let length = word.chars().count();
    let plausible = |c: char| c.is_lowercase() || c == '-' || c == '_';
    if length < 5 || !word.chars().all(plausible) {
        return None;
    }
    let most = if length <= 7 { 1 } else { 2 };
    Relation::PLAIN
        .iter()
        .map(|(name, _)| *name)
        .chain([WITHIN])
        .filter_map(|name| Some((edit_distance(word, name, most)?, name)))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, name)| name)
}

/// Returns the canonical spelling of a part of a field's name: in lower case, French words in English.
pub(super) fn part(text: &str) -> String {
    let text = text.to_lowercase();
    let folded = fold(&text);
    FRENCH
        .iter()
        .find(|(french, _)| *french == folded)
        .map_or(text, |(_, english)| (*english).to_owned())
}

/// The left side of a comparison if its name is one word and no component.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Simple {
    Text(TextField),
    Property(Property),
    Time(TimeField),
}

/// Returns the field of this name that is not a component.
pub(super) fn simple_field(name: &str) -> Option<Simple> {
    let name = fold(name);
    let is = |names: &[&str]| names.iter().any(|known| fold(known) == name);
    let text = TextField::ALL
        .into_iter()
        .find(|f| is(f.names()))
        .map(Simple::Text);
    let property = || {
        Property::ALL
            .into_iter()
            .find(|f| is(f.names()))
            .map(Simple::Property)
    };
    let time = || {
        TimeField::ALL
            .into_iter()
            .find(|f| is(f.names()))
            .map(Simple::Time)
    };
    text.or_else(property).or_else(time)
}

/// Returns the canonical names of the fields that are not components.
pub(super) fn simple_names() -> impl Iterator<Item = &'static str> {
    let texts = [
        TextField::Gloss,
        TextField::Translation,
        TextField::Comment,
        TextField::Any,
    ];
    let texts = texts.into_iter().map(TextField::name);
    let properties = Property::ALL.into_iter().map(Property::name);
    texts
        .chain(properties)
        .chain(TimeField::ALL.into_iter().map(TimeField::name))
}

/// Returns the canonical names of the parts of a component's name: components, hands, phases.
pub(super) fn part_names() -> impl Iterator<Item = &'static str> {
    let components = Component::ALL.into_iter().map(Component::name);
    let hands = HandRef::ALL.into_iter().map(HandRef::name);
    components
        .chain(hands)
        .chain(["initial", "middle", "final"])
}
