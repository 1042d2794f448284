//! The words with a meaning in queries, with their synonyms.

use super::query_attributes;
use super::query_tree::{MissingReason, TextField, TimeField, WholeTokenProperty};
use crate::component::{HandRef, SignComponent};
use crate::relation::TimeRelation;
use crate::text::{edit_distance, fold_text};

impl TextField {
    /// The text fields, `Any` first.
    pub const ALL_TEXT_FIELDS: [Self; 4] = [Self::Any, Self::Gloss, Self::Translation, Self::Comment];

    /// Returns the name in queries.
    #[must_use]
    pub fn text_field_name(self) -> &'static str {
        self.text_field_spellings()[0]
    }

    /// Returns every spelling that is understood, the canonical name first.
    #[must_use]
    pub fn text_field_spellings(self) -> &'static [&'static str] {
        match self {
            Self::Any => &["text", "texte"],
            Self::Gloss => &["gloss", "glose"],
            Self::Translation => &["translation", "traduction"],
            Self::Comment => &["comment", "commentaire", "note"],
        }
    }
}

impl WholeTokenProperty {
    /// Every property.
    pub const ALL_TOKEN_PROPERTIES: [Self; 14] = [
        Self::Origin,
        Self::Signer,
        Self::Recording,
        Self::Sign,
        Self::Token,
        Self::Tier,
        Self::Inventory,
        Self::Lexicon,
        Self::Language,
        Self::File,
        Self::Hand,
        Self::Proposed,
        Self::Disputed,
        Self::By,
    ];

    /// Returns the name in queries.
    #[must_use]
    pub fn property_name(self) -> &'static str {
        self.property_spellings()[0]
    }

    /// Returns every spelling that is understood, the canonical name first.
    #[must_use]
    pub fn property_spellings(self) -> &'static [&'static str] {
        match self {
            Self::Origin => &["origin", "origine"],
            Self::Signer => &["signer", "participant", "signeur"],
            Self::Recording => &["recording", "enregistrement"],
            Self::Sign => &["sign", "signe"],
            Self::Token => &["token"],
            Self::Tier => &["tier"],
            Self::Inventory => &["inventory", "inventaire"],
            Self::Lexicon => &["lexicon", "lexique"],
            Self::Language => &["language", "langue"],
            Self::File => &["file", "fichier"],
            Self::Hand => &["hand", "main"],
            Self::Proposed => &["proposed", "proposé"],
            Self::Disputed => &["disputed", "contesté"],
            Self::By => &["by", "annotator", "par", "annotateur"],
        }
    }

    /// Returns the only possible values, if they are fixed.
    #[must_use]
    pub fn fixed_values(self) -> Option<&'static [&'static str]> {
        match self {
            Self::Origin => Some(&["captured", "made", "lexicon", "generated"]),
            Self::Hand => Some(&["right", "left", "dominant", "weak", "both"]),
            Self::Proposed | Self::Disputed => Some(&["yes", "no"]),
            _ => None,
        }
    }
}

impl TimeField {
    /// The three times.
    pub const ALL_TIME_FIELDS: [Self; 3] = [Self::Duration, Self::Start, Self::End];

    /// Returns the name in queries.
    #[must_use]
    pub fn time_field_name(self) -> &'static str {
        self.time_field_spellings()[0]
    }

    /// Returns every spelling that is understood, the canonical name first.
    #[must_use]
    pub fn time_field_spellings(self) -> &'static [&'static str] {
        match self {
            Self::Duration => &["duration", "durée", "length"],
            Self::Start => &["start", "début", "begin"],
            Self::End => &["end", "fin"],
        }
    }
}

/// Returns the origin that another word means, such as those that tables and pictures write beside signs.
pub(super) fn origin_from_word(text: &str) -> Option<&'static str> {
    Some(match &*fold_text(text) {
        "synthesised" | "synthesized" | "composed" | "compose" => "made",
        "notated" | "notation" | "lexicon entry" | "note" | "entree de lexique" => "lexicon",
        "capte" => "captured",
        "produit" => "generated",
        _ => return None,
    })
}

/// Returns the answer that a French word means.
pub(super) fn answer_from_word(text: &str) -> Option<&'static str> {
    match text {
        "oui" => Some("yes"),
        "non" => Some("no"),
        _ => None,
    }
}

/// The word that opens a relation with a distance.
pub(super) const WITHIN_WORD: &str = "within";
/// The words after the distance of `within`.
pub(super) const WITHIN_KINDS: [&str; 3] = ["around", "of-begin", "of-end"];
/// The word that opens a search by example.
pub(super) const LIKE_WORD: &str = "like";
/// The word between an example and the components that count.
pub(super) const ON_WORD: &str = "on";
/// Words that people write in place of `on`.
pub(super) const INSTEAD_OF_ON: [&str; 6] = ["in", "by", "with", "of", "for", "sur"];
/// The word before a tier's name in parentheses.
pub(super) const TIER_WORD: &str = "tier";

/// The word before the least similarity in a search by example.
pub(super) const ABOVE_WORD: &str = "above";

/// French for the parts of a component's name.
const FRENCH_COMPONENT_PARTS: [(&str, &str); 10] = [
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
pub(super) const TIME_UNITS: [(&str, i64); 9] = [
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
pub(super) enum JoiningWord {
    And,
    Or,
    Not,
}

/// Returns the joint that a word is, if it is one, in any case.
pub(super) fn find_joining_word(word: &str) -> Option<JoiningWord> {
    let joints = [
        ("and", JoiningWord::And),
        ("or", JoiningWord::Or),
        ("not", JoiningWord::Not),
    ];
    // In capitals they are glosses of French signs.
    let french = [
        ("et", JoiningWord::And),
        ("ou", JoiningWord::Or),
        ("non", JoiningWord::Not),
    ];
    let english = joints.into_iter().find(|(name, _)| name.eq_ignore_ascii_case(word));
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
pub(super) fn french_relation(word: &str) -> Option<TimeRelation> {
    let entry = FRENCH_RELATIONS.iter().find(|(french, _)| *french == word);
    entry.and_then(|(_, english)| plain_relation(english))
}

/// French for [`LIKE_WORD`] and [`ON_WORD`].
pub(super) const FRENCH_LIKE: &str = "comme";
pub(super) const FRENCH_ON: &str = "sur";

/// Parts of components that every corpus may have, with their component.
const COMPONENT_PARTS: [(&str, SignComponent); 18] = [
    ("palm", SignComponent::Orientation),
    ("fingers", SignComponent::Orientation),
    ("handedness", SignComponent::Configuration),
    ("change", SignComponent::Configuration),
    ("contact", SignComponent::Placement),
    ("relation", SignComponent::Placement),
    ("direction", SignComponent::Movement),
    ("shape", SignComponent::Movement),
    ("manner", SignComponent::Movement),
    ("repeated", SignComponent::Movement),
    ("alternating", SignComponent::Movement),
    ("brows", SignComponent::NonManual),
    ("gaze", SignComponent::NonManual),
    ("mouth", SignComponent::NonManual),
    ("mouthing", SignComponent::NonManual),
    ("lids", SignComponent::NonManual),
    ("shoulders", SignComponent::NonManual),
    ("phase", SignComponent::Movement),
];

/// Returns the component that has a part of this name.
pub(super) fn component_of_part(name: &str) -> Option<SignComponent> {
    let entry = COMPONENT_PARTS.iter().find(|(part, _)| *part == name);
    entry.map(|(_, component)| *component)
}

/// Returns the relation without a distance that a word names; words in capitals are glosses.
pub(super) fn plain_relation(word: &str) -> Option<TimeRelation> {
    TimeRelation::PLAIN_RELATIONS
        .into_iter()
        .find(|(name, _)| *name == word)
        .map(|(_, relation)| relation)
}

/// Returns the reason for a missing value that an unquoted value names.
pub(super) fn missing_reason_of(word: &str) -> Option<MissingReason> {
    let word = if word == "N/A" { "n/a" } else { word };
    MissingReason::ALL_MISSING_REASONS
        .into_iter()
        .find(|missing| missing.missing_reason_name() == word)
}

/// Returns whether a bare word is reserved and never searched for.
pub(super) fn is_reserved(word: &str) -> bool {
    find_joining_word(word).is_some()
        || plain_relation(word).is_some()
        || [WITHIN_WORD, LIKE_WORD, ON_WORD, TIER_WORD, ABOVE_WORD, FRENCH_LIKE].contains(&word)
        || french_relation(word).is_some()
        || WITHIN_KINDS.contains(&word)
        || INSTEAD_OF_ON.contains(&word)
}

/// Returns whether an opening parenthesis directly after this word is a parenthesis of the query, and not part of a
/// word.
pub(super) fn opens_group(word: &str) -> bool {
    find_joining_word(word).is_some()
        || plain_relation(word).is_some()
        || word == TIER_WORD
        || query_attributes::opens_name(word)
}

/// Returns the relation that a lower-case word nearly names.
pub(super) fn near_relation(word: &str) -> Option<&'static str> {
    let length = word.chars().count();
    let plausible = |c: char| c.is_lowercase() || c == '-' || c == '_';
    if length < 5 || !word.chars().all(plausible) {
        return None;
    }
    let most = if length <= 7 { 1 } else { 2 };
    TimeRelation::PLAIN_RELATIONS
        .iter()
        .map(|(name, _)| *name)
        .chain([WITHIN_WORD])
        .filter_map(|name| Some((edit_distance(word, name, most)?, name)))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, name)| name)
}

/// Returns the canonical spelling of a part of a field's name: in lower case, French words in English.
pub(super) fn canonical_part_name(text: &str) -> String {
    let text = text.to_lowercase();
    let folded = fold_text(&text);
    FRENCH_COMPONENT_PARTS
        .iter()
        .find(|(french, _)| *french == folded)
        .map_or(text, |(_, english)| (*english).to_owned())
}

/// The left side of a comparison if its name is one word and no component.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SimpleField {
    Text(TextField),
    Property(WholeTokenProperty),
    Time(TimeField),
}

/// Returns the field of this name that is not a component.
pub(super) fn simple_field(name: &str) -> Option<SimpleField> {
    let name = fold_text(name);
    let is = |names: &[&str]| names.iter().any(|known| fold_text(known) == name);
    let text = TextField::ALL_TEXT_FIELDS
        .into_iter()
        .find(|f| is(f.text_field_spellings()))
        .map(SimpleField::Text);
    let property = || {
        WholeTokenProperty::ALL_TOKEN_PROPERTIES
            .into_iter()
            .find(|f| is(f.property_spellings()))
            .map(SimpleField::Property)
    };
    let time = || {
        TimeField::ALL_TIME_FIELDS
            .into_iter()
            .find(|f| is(f.time_field_spellings()))
            .map(SimpleField::Time)
    };
    text.or_else(property).or_else(time)
}

/// Returns the canonical names of the fields that are not components.
pub(super) fn simple_names() -> impl Iterator<Item = &'static str> {
    let text_fields = [
        TextField::Gloss,
        TextField::Translation,
        TextField::Comment,
        TextField::Any,
    ];
    let texts = text_fields.into_iter().map(TextField::text_field_name);
    let properties = WholeTokenProperty::ALL_TOKEN_PROPERTIES
        .into_iter()
        .map(WholeTokenProperty::property_name);
    texts
        .chain(properties)
        .chain(TimeField::ALL_TIME_FIELDS.into_iter().map(TimeField::time_field_name))
        .chain([super::query_notation::NOTATION_FIELD])
}

/// Returns the canonical names of the parts of a component's name: components, hands, phases.
pub(super) fn part_names() -> impl Iterator<Item = &'static str> {
    let components = SignComponent::ALL_COMPONENTS
        .into_iter()
        .map(SignComponent::component_name);
    let hands = HandRef::ALL_HAND_REFS.into_iter().map(HandRef::hand_ref_name);
    components.chain(hands).chain(["initial", "middle", "final"])
}
