//! The parts of a face that recipes name, and their values: plain words and codes of SiGML.

use std::sync::LazyLock;

use chereme_motion::FacePosture;
use chereme_sign::ComponentInventory;
use chereme_sign::hamnosys::NonmanualPart;
use chereme_sign::hamnosys::hamnosys_face::FacialExpression;
use chereme_sign::inventory::builtin_by_id;
use serde::{Deserialize, Serialize};

use crate::error::UnknownFaceWord;
use crate::units::RecipeFactor;

/// A part of the face, or the head, as recipes name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FacePart {
    /// The eyebrows.
    Brows,
    /// The eyelids.
    Eyes,
    /// The cheeks.
    Cheeks,
    /// The nose.
    Nose,
    /// The mouth, by a gesture.
    Mouth,
    /// The mouth, by the sounds of a word in SAMPA.
    Mouthing,
    /// The gaze.
    Gaze,
    /// The head.
    Head,
}

/// The word of each part in recipes, and the feature of its values in inventories and annotations.
#[rustfmt::skip]
const PART_NAMES: [(&str, &str); 8] = [
    ("brows", "brows"), ("eyes", "lids"), ("cheeks", "mouth"), ("nose", "nose"),
    ("mouth", "mouth"), ("mouthing", "mouthing"), ("gaze", "gaze"), ("head", "head"),
];
/// The value of a part at rest.
const RESTING_VALUE: &str = "neutral";
/// The code of a head that follows the gaze: the animator does not move it.
const UNMOVED_HEAD_CODE: &str = "LI";
/// The most values that a message lists.
const MOST_LISTED_VALUES: usize = 16;

/// A value of a part of the face, as a recipe shows it.
pub(crate) struct PartValue {
    /// The value as annotations have it.
    pub(crate) id: String,
    /// The name of its curve; `None` for the part at rest.
    pub(crate) curve: Option<String>,
    /// The share of it that is shown, from 0 to 1.
    pub(crate) amount: f64,
}

impl FacePart {
    /// Every part, in the order in which recipes are printed.
    #[rustfmt::skip]
    pub const ALL_FACE_PARTS: [Self; 8] = [
        Self::Brows, Self::Eyes, Self::Cheeks, Self::Nose, Self::Mouth, Self::Mouthing, Self::Gaze, Self::Head,
    ];

    /// Returns the word recipes print.
    #[must_use]
    pub fn face_part_name(self) -> &'static str {
        PART_NAMES[self as usize].0
    }

    /// Returns the feature of its values in inventories and annotations.
    #[must_use]
    pub fn face_part_feature(self) -> &'static str {
        PART_NAMES[self as usize].1
    }

    /// Returns the part that `word` names.
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        let mut parts = Self::ALL_FACE_PARTS.into_iter();
        let named = parts.find(|part| part.face_part_name() == word);
        named.or((word == Self::Eyes.face_part_feature()).then_some(Self::Eyes))
    }

    /// Returns the part that a recipe names.
    pub(crate) fn named_part(word: &str) -> Result<Self, UnknownFaceWord> {
        let names = PART_NAMES.map(|(name, _)| name.to_owned());
        Self::from_word(word).ok_or_else(|| unknown_face_word("face", word, names.to_vec()))
    }

    /// Returns the values that a face can show on the part; none for a mouthing, which is free text.
    ///
    /// # Panics
    /// Panics if the program's own inventories lack the feature.
    #[must_use]
    pub fn face_part_inventory(self) -> &'static ComponentInventory {
        static PART_INVENTORIES: LazyLock<[ComponentInventory; 8]> = LazyLock::new(|| {
            FacePart::ALL_FACE_PARTS.map(|part| {
                let feature_inventory = builtin_by_id(part.face_part_feature()).expect("a test asks for every part");
                let mut inventory = feature_inventory.clone();
                // A mouthing is free text.
                inventory.values.retain(|value| match value.id.as_str() {
                    _ if part == FacePart::Mouthing => false,
                    RESTING_VALUE => part != FacePart::Head,
                    _ => value.value_spellings().any(|spelling| part.is_part_code(spelling)),
                });
                if let Some(value) = feature_inventory.value_by_id(part.face_part_name()) {
                    inventory.names.clone_from(&value.names);
                }
                inventory
            })
        });
        &PART_INVENTORIES[self as usize]
    }

    /// Returns the part that a curve moves; `None` for curves of the trunk, and for unknown ones.
    pub(crate) fn of_curve_name(name: &str) -> Option<Self> {
        let (part, code) = name.split_once('.')?;
        if part == "face" {
            FacePosture::face_number_position(code)?;
            // Numbers begin with the word of a part, such as `nose` or `brow`, but for the many of the mouth.
            let word = code.split('_').next()?;
            let named = Self::from_word(word).or_else(|| Self::from_word(&format!("{word}s")));
            return named.or(Some(Self::Mouth));
        }
        match part {
            "mouth" if builtin_by_id(part)?.is_within_value(code, "cheeks") => Some(Self::Cheeks),
            "mouthing" | "teeth" | "tongue" => Some(Self::Mouth),
            _ => Self::from_word(part),
        }
    }

    /// Returns whether a curve moves the part; a mouthing takes the whole mouth.
    pub(crate) fn is_moved_by_curve(self, name: &str) -> bool {
        let moved = if self == Self::Mouthing { Self::Mouth } else { self };
        Self::of_curve_name(name) == Some(moved)
    }

    /// Returns the value of the part that a text means, by its name or by its code of SiGML, with its share: `raised*0.5`.
    pub(crate) fn find_part_value(self, text: &str) -> Result<PartValue, UnknownFaceWord> {
        let (word, share) = text.split_once('*').unwrap_or((text, "1"));
        let factor = share.parse().ok();
        let Some(RecipeFactor(amount)) = factor.filter(|RecipeFactor(share)| (0.0..=1.0).contains(share)) else {
            let near = format!("a share from 0 to 1, such as {word}*0.5");
            return Err(unknown_face_word(self.face_part_name(), text, vec![near]));
        };
        let found = self.face_part_inventory().find_inventory_value(word);
        let code = match found {
            Some(value) => value.value_spellings().find(|spelling| self.is_part_code(spelling)),
            None if self.is_part_code(word) => Some(word),
            None => {
                return Err(unknown_face_word(
                    self.face_part_name(),
                    word,
                    self.nearest_values(word),
                ));
            }
        };
        let own_id = if self == Self::Mouthing { "word" } else { word };
        Ok(PartValue {
            id: found.map_or(own_id, |value| &value.id).to_owned(),
            curve: code.map(|code| format!("{}.{code}", self.face_part_feature())),
            amount,
        })
    }

    /// Returns whether a face, or the animator's head, has this code of SiGML on the part.
    fn is_part_code(self, code: &str) -> bool {
        let feature = self.face_part_feature();
        let is_shown = |code: &str| FacialExpression::from_nonmanual_code(feature, code).is_some();
        match self {
            Self::Head => NonmanualPart::Head.is_listed(code) && code != UNMOVED_HEAD_CODE,
            // Marks of length and stress are no sounds.
            Self::Mouthing => {
                let mut letters = code.chars().filter(|letter| letter.is_alphanumeric());
                is_shown(code) && letters.all(|letter| is_shown(&letter.to_string()))
            }
            _ => is_shown(code) && self.is_moved_by_curve(&format!("{feature}.{code}")),
        }
    }

    /// Returns what may have been meant: another part with this value, similar values, or all of them.
    fn nearest_values(self, text: &str) -> Vec<String> {
        let has_value = |part: &Self| part.face_part_inventory().find_inventory_value(text).is_some();
        let elsewhere = Self::ALL_FACE_PARTS.into_iter().find(has_value);
        let (inventory, sounds) = (self.face_part_inventory(), "sounds of SAMPA, such as \"bOl\"");
        let suggested = inventory.suggest_value_ids(text);
        let listed = inventory.values.iter().map(|value| value.id.as_str());
        match (elsewhere, suggested.as_slice()) {
            (Some(part), _) => vec![format!("{}={text}", part.face_part_name())],
            (None, []) if self == Self::Mouthing => vec![sounds.to_owned()],
            (None, []) => listed.take(MOST_LISTED_VALUES).map(str::to_owned).collect(),
            (None, near) => near.iter().map(|id| (*id).to_owned()).collect(),
        }
    }
}

fn unknown_face_word(of: &'static str, text: &str, near: Vec<String>) -> UnknownFaceWord {
    let text = text.to_owned();
    UnknownFaceWord { of, text, near }
}
