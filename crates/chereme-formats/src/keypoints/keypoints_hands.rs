//! The sides of hands that MediaPipe lists beside their landmarks.

use serde_json::{Map, Value};

use super::cloud::{self, KeypointSample};
use crate::finding::ImportFinding;
use crate::tally::FindingTally;

/// Returns whether a text in small letters lists the sides of hands.
pub(crate) fn has_sides(lower: &str) -> bool {
    lower.contains("handedness\"") || lower.contains("handednesses\"")
}

/// Returns the sides of the hands of a frame, in the order of their landmarks; `None` for one that is not known.
pub(super) fn hand_landmark_sides(frame: &Map<String, Value>) -> Vec<Option<&'static str>> {
    let list = frame.iter().find_map(|(key, value)| {
        let lower = key.to_ascii_lowercase();
        let is_list = lower.ends_with("handedness") || lower.ends_with("handednesses");
        value.as_array().filter(|_| is_list)
    });
    let side = |entry: &Value| {
        let first = match entry {
            Value::Array(all) => all.first()?,
            other => other,
        };
        let name = ["categoryName", "category_name", "label"]
            .into_iter()
            .find_map(|key| first.get(key)?.as_str())
            .or_else(|| first.as_str())?;
        match name.to_ascii_lowercase().as_str() {
            "left" => Some("left"),
            "right" => Some("right"),
            _ => None,
        }
    };
    list.map_or_else(Vec::new, |all| all.iter().map(side).collect())
}

/// Adds the landmarks of hands under the names of their sides; returns false if `value` is no list of several hands, or
/// their sides are not known.
pub(super) fn add_hand_landmarks(
    key: &str,
    value: &Value,
    sides: &[Option<&'static str>],
    points: &mut Vec<KeypointSample>,
    findings: &mut FindingTally,
) -> bool {
    const OF_HAND: usize = 21;
    let Value::Array(hands) = value else {
        return false;
    };
    let is_hand = |hand: &Value| hand.as_array().is_some_and(|landmarks| landmarks.len() == OF_HAND);
    if hands.is_empty() || !hands.iter().all(is_hand) {
        return false;
    }
    if hands.len() != sides.len() || sides.iter().any(Option::is_none) {
        // A single hand without a side cannot change places with another.
        if hands.len() > 1 {
            findings.add_limited_finding("hands without a side", || {
                ImportFinding::new_warning_finding(
                    None,
                    format!("{key:?} does not state the sides of its hands; they are in the order of each frame, and may change places"),
                )
                .with_remedy("write \"handedness\" into each frame")
            });
        }
        return false;
    }
    findings.add_unique_finding(|| {
        let text = "left and right hands are those that MediaPipe names; it takes the film for mirrored";
        ImportFinding::new_note_finding(None, text)
    });
    let world = if key.to_ascii_lowercase().contains("world") {
        "World"
    } else {
        ""
    };
    let mut before: Vec<&str> = Vec::new();
    for (hand, side) in hands.iter().zip(sides.iter().flatten()) {
        let count = 1 + before.iter().filter(|other| *other == side).count();
        let group = match count {
            1 => format!("{side}Hand{world}Landmarks"),
            count => format!("{side}Hand{world}Landmarks {count}"),
        };
        cloud::add_mediapipe_landmarks(&group, hand, points);
        before.push(side);
    }
    true
}
