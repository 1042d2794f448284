//! The parts of a signer's body, and their names.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::hand::{BodySide, HandFinger};

/// A part of the body; its joint is the one about which the part turns.
///
/// A joint is named after what moves when it turns: the shoulder joint is the upper arm's, the
/// elbow the forearm's, the wrist the hand's, the hip the thigh's, the knee the shin's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum BodyPart {
    /// The pelvis.
    Hips,
    /// The lowest joint of the spine above the hips.
    Spine,
    /// The uppermost joint of the spine, the one that carries the shoulders.
    Chest,
    /// The lowest joint of the neck.
    Neck,
    /// The head, which turns on the uppermost joint of the neck.
    Head,
    /// The lower jaw.
    Jaw,
    /// An eyeball.
    Eye(BodySide),
    /// The collar bone.
    Clavicle(BodySide),
    /// The upper arm, which turns at the shoulder.
    UpperArm(BodySide),
    /// The forearm, which turns at the elbow.
    Forearm(BodySide),
    /// The hand, which turns at the wrist.
    Hand(BodySide),
    /// A joint of the thumb: 0 at the wrist (CMC), 1 in the middle (MCP), 2 at the end (IP).
    Thumb(BodySide, u8),
    /// A joint of a finger: 0 the metacarpal's, if there is one, 1 the base (MCP), 2 the middle (PIP), 3 the end (DIP).
    Finger(BodySide, HandFinger, u8),
    /// The thigh, which turns at the hip.
    Thigh(BodySide),
    /// The shin, which turns at the knee.
    Shin(BodySide),
    /// The foot, which turns at the ankle.
    Foot(BodySide),
    /// The toes, which turn at the ball of the foot.
    Toes(BodySide),
}

const THUMB_PART_SEGMENTS: [&str; 3] = ["base", "middle", "end"];
const FINGER_PART_SEGMENTS: [&str; 4] = ["metacarpal", "base", "middle", "end"];

impl BodyPart {
    /// Returns every part, in order.
    #[must_use]
    pub fn all_body_parts() -> Vec<Self> {
        let mut all = vec![Self::Hips, Self::Spine, Self::Chest, Self::Neck, Self::Head, Self::Jaw];
        for side in BodySide::BOTH_SIDES {
            all.extend([
                Self::Eye(side),
                Self::Clavicle(side),
                Self::UpperArm(side),
                Self::Forearm(side),
                Self::Hand(side),
                Self::Thigh(side),
                Self::Shin(side),
                Self::Foot(side),
                Self::Toes(side),
            ]);
            all.extend((0..3).map(|n| Self::Thumb(side, n)));
            for finger in HandFinger::ALL_FINGERS {
                all.extend((0..4).map(|n| Self::Finger(side, finger, n)));
            }
        }
        all.sort_unstable();
        all
    }

    /// Returns the side; `None` for a part in the middle.
    #[must_use]
    pub fn part_side(self) -> Option<BodySide> {
        match self {
            Self::Hips | Self::Spine | Self::Chest | Self::Neck | Self::Head | Self::Jaw => None,
            Self::Eye(side)
            | Self::Clavicle(side)
            | Self::UpperArm(side)
            | Self::Forearm(side)
            | Self::Hand(side)
            | Self::Thumb(side, _)
            | Self::Finger(side, _, _)
            | Self::Thigh(side)
            | Self::Shin(side)
            | Self::Foot(side)
            | Self::Toes(side) => Some(side),
        }
    }

    /// Returns the same part on the other side; a part in the middle is returned unchanged.
    #[must_use]
    pub fn mirrored_part(self) -> Self {
        match self {
            Self::Eye(side) => Self::Eye(side.opposite_side()),
            Self::Clavicle(side) => Self::Clavicle(side.opposite_side()),
            Self::UpperArm(side) => Self::UpperArm(side.opposite_side()),
            Self::Forearm(side) => Self::Forearm(side.opposite_side()),
            Self::Hand(side) => Self::Hand(side.opposite_side()),
            Self::Thumb(side, n) => Self::Thumb(side.opposite_side(), n),
            Self::Finger(side, finger, n) => Self::Finger(side.opposite_side(), finger, n),
            Self::Thigh(side) => Self::Thigh(side.opposite_side()),
            Self::Shin(side) => Self::Shin(side.opposite_side()),
            Self::Foot(side) => Self::Foot(side.opposite_side()),
            Self::Toes(side) => Self::Toes(side.opposite_side()),
            middle => middle,
        }
    }

    /// Returns whether signing bodies usually have the part; eyes, jaw and metacarpals are extras.
    #[must_use]
    pub fn is_usual(self) -> bool {
        !matches!(self, Self::Jaw | Self::Eye(_) | Self::Finger(_, _, 0))
    }
}

impl fmt::Display for BodyPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = match self {
            Self::Hips => "hips",
            Self::Spine => "spine",
            Self::Chest => "chest",
            Self::Neck => "neck",
            Self::Head => "head",
            Self::Jaw => "jaw",
            Self::Eye(_) => "eye",
            Self::Clavicle(_) => "clavicle",
            Self::UpperArm(_) => "upper arm",
            Self::Forearm(_) => "forearm",
            Self::Hand(_) => "hand",
            Self::Thumb(..) => "thumb",
            Self::Finger(_, finger, _) => finger.finger_name(),
            Self::Thigh(_) => "thigh",
            Self::Shin(_) => "shin",
            Self::Foot(_) => "foot",
            Self::Toes(_) => "toes",
        };
        if let Some(side) = self.part_side() {
            write!(f, "{} ", side.body_side_name())?;
        }
        f.write_str(name)?;
        match *self {
            Self::Thumb(_, n) => write!(f, " {}", THUMB_PART_SEGMENTS[usize::from(n.min(2))]),
            Self::Finger(_, _, n) => write!(f, " {}", FINGER_PART_SEGMENTS[usize::from(n.min(3))]),
            _ => Ok(()),
        }
    }
}

/// A text that is not the name of a part.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{text:?} is no part of the body; did you mean {suggestion:?}?")]
pub struct PartError {
    /// The text.
    pub text: String,
    /// The name of a part with the most similar spelling.
    pub suggestion: String,
}

/// Common synonyms for parts.
const PART_SYNONYMS: [(&str, &str); 15] = [
    ("pelvis", "hips"),
    ("pinky", "little"),
    ("shoulder", "upper arm"),
    ("upperarm", "upper arm"),
    ("elbow", "forearm"),
    ("lower arm", "forearm"),
    ("fore arm", "forearm"),
    ("wrist", "hand"),
    ("collar", "clavicle"),
    ("upper leg", "thigh"),
    ("hip", "thigh"),
    ("lower leg", "shin"),
    ("knee", "shin"),
    ("ankle", "foot"),
    ("toe", "toes"),
];

impl FromStr for BodyPart {
    type Err = PartError;
    /// Reads a part's name, ignoring case and separators, so that `right-hand` is `right hand`; common synonyms (`left
    /// elbow`, `right pinky base`) are understood.
    fn from_str(text: &str) -> Result<Self, PartError> {
        let name = text.to_lowercase().replace(['-', '_', '.'], " ");
        let words: Vec<&str> = name.split_whitespace().collect();
        let mut name = words.join(" ");
        let find = |name: &str| Self::all_body_parts().into_iter().find(|part| part.to_string() == name);
        if let Some(part) = find(&name) {
            return Ok(part);
        }
        for (word, meant) in PART_SYNONYMS {
            let padded = format!(" {name} ").replace(&format!(" {word} "), &format!(" {meant} "));
            if let Some(part) = find(padded.trim()) {
                return Ok(part);
            }
            if meant == "little" {
                name = padded.trim().to_owned();
            }
        }
        let all_parts = Self::all_body_parts();
        let names: Vec<String> = all_parts.iter().map(Self::to_string).collect();
        Err(PartError {
            text: text.to_owned(),
            suggestion: nearest_spelling(&name, names.iter().map(String::as_str)).to_owned(),
        })
    }
}

crate::keep_as_text!(BodyPart);

/// Returns the candidate with the spelling most similar to `text`, ignoring case; the first of equal ones.
pub(super) fn nearest_spelling<'a>(text: &str, candidates: impl Iterator<Item = &'a str>) -> &'a str {
    let text: String = text.to_lowercase().chars().take(100).collect();
    candidates
        .min_by_key(|name| spelling_edit_distance(&text, &name.to_lowercase()))
        .unwrap_or_default()
}

/// Returns the number of letters to add, drop or change to turn `a` into `b` (Levenshtein distance).
fn spelling_edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, &y) in b.iter().enumerate() {
            let changed = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_reads_back_as_its_part_and_twice_mirrored_is_the_same() {
        for part in BodyPart::all_body_parts() {
            assert_eq!(part.to_string().parse(), Ok(part));
            assert_eq!(part.mirrored_part().mirrored_part(), part);
            assert_eq!(part.mirrored_part() == part, part.part_side().is_none());
        }
        assert_eq!(BodyPart::all_body_parts().len(), 6 + 2 * (9 + 3 + 16));
    }

    #[test]
    fn common_spellings_are_understood_and_errors_suggest_a_correction() {
        for (text, want) in [
            ("Right-Hand", "right hand"),
            ("left_index_base", "left index base"),
            ("right wrist", "right hand"),
            ("left elbow", "left forearm"),
            ("left pinky end", "left little end"),
            ("right shoulder", "right upper arm"),
        ] {
            let part: BodyPart = text.parse().expect(text);
            assert_eq!(part.to_string(), want);
        }
        let error = "rigt hand".parse::<BodyPart>().expect_err("misspelt");
        assert_eq!(error.suggestion, "right hand");
    }
}
