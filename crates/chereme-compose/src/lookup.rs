//! Looks values and letters up in inventories, for a corpus that answers [`RecipeSources`](crate::RecipeSources).

use chereme_motion::glam::DVec3;
use chereme_sign::SignComponent;
use chereme_sign::hamnosys::orientation;
use chereme_sign::inventory::{ComponentInventory, InventoryValue};
use chereme_sign::text::fold_text;

use crate::error::SourceError;
use crate::sources::{AlphabetLetter, ComponentValue, LetterStroke};

/// Returns the value of `component` that `text` names in the first of the inventories that knows it.
///
/// Inventories of a part of the component (`orientation.palm`, the letters of an alphabet) are searched after those of
/// the whole.
///
/// # Errors
/// [`SourceError::UnknownValue`] with the value that was probably meant.
pub fn value_in<'a>(
    inventories: impl IntoIterator<Item = &'a ComponentInventory>,
    component: SignComponent,
    text: &str,
) -> Result<ComponentValue, SourceError> {
    let mut of: Vec<&ComponentInventory> = inventories
        .into_iter()
        .filter(|inventory| inventory.component == component)
        .collect();
    of.sort_by_key(|inventory| inventory.feature.is_some());
    let matching_value = of
        .iter()
        .find_map(|inventory| Some((inventory, inventory.find_inventory_value(text)?)));
    match matching_value {
        Some((inventory, value)) => Ok(with_pose(&of, inventory, value)),
        None => Err(SourceError::UnknownValue {
            component,
            text: text.to_owned(),
            nearest: of
                .iter()
                .find_map(|inventory| inventory.suggest_value_ids(text).first().map(|id| (*id).to_owned())),
        }),
    }
}

/// Returns the letters of `word`, without regard to case and accents; blanks, hyphens and apostrophes are skipped.
/// Without a name the first inventory that has letters is the alphabet.
///
/// # Errors
/// [`SourceError::UnknownAlphabet`], or [`SourceError::UnknownLetter`] with the first letter that the alphabet lacks.
pub fn letters_in<'a>(
    inventories: impl IntoIterator<Item = &'a ComponentInventory>,
    alphabet: Option<&str>,
    word: &str,
) -> Result<Vec<AlphabetLetter>, SourceError> {
    let all: Vec<&ComponentInventory> = inventories.into_iter().collect();
    let alphabets: Vec<&ComponentInventory> = all
        .iter()
        .copied()
        .filter(|inventory| inventory.values.iter().any(|value| value.letter.is_some()))
        .collect();
    let chosen = match alphabet {
        None => alphabets.first(),
        Some(name) => alphabets.iter().find(|inventory| {
            let language = inventory.language.as_deref().map(fold_text);
            fold_text(&inventory.id) == fold_text(name) || language.is_some_and(|l| l == fold_text(name))
        }),
    };
    let Some(chosen) = chosen else {
        return Err(SourceError::UnknownAlphabet {
            name: alphabet.unwrap_or_default().to_owned(),
            known: alphabets.iter().map(|alphabet| alphabet.id.clone()).collect(),
        });
    };
    fold_text(word)
        .chars()
        .filter(|c| !c.is_whitespace() && !"-'".contains(*c))
        .map(|c| {
            let is = |value: &&InventoryValue| {
                value
                    .letter
                    .as_deref()
                    .is_some_and(|letter| fold_text(letter) == c.to_string())
            };
            let value = chosen.values.iter().find(is);
            value
                .map(|value| letter(&all, chosen, value))
                .ok_or_else(|| SourceError::UnknownLetter {
                    letter: c.to_uppercase().to_string(),
                    alphabet: chosen.id.clone(),
                    known: known_letters(chosen),
                })
        })
        .collect()
}

fn known_letters(alphabet: &ComponentInventory) -> String {
    let letters = alphabet.values.iter().filter_map(|value| value.letter.as_deref());
    letters.collect::<Vec<_>>().join(" ")
}

/// Returns a value; if it has no posture of its own, it gets that of the configuration that it names.
fn with_pose(all: &[&ComponentInventory], inventory: &ComponentInventory, value: &InventoryValue) -> ComponentValue {
    let plain_value = ComponentValue::value_from_inventory(inventory, value);
    if plain_value.meaning.is_some() {
        return plain_value;
    }
    let shape = value.configuration.as_deref().and_then(|id| {
        let configurations = all
            .iter()
            .filter(|i| i.component == SignComponent::Configuration && i.feature.is_none());
        configurations
            .into_iter()
            .find_map(|i| Some(ComponentValue::value_from_inventory(i, i.value_by_id(id)?)))
    });
    shape.unwrap_or(plain_value)
}

fn letter(all: &[&ComponentInventory], alphabet: &ComponentInventory, value: &InventoryValue) -> AlphabetLetter {
    let feature = |component: SignComponent, feature: &str, id: &str| {
        let of = all
            .iter()
            .filter(|i| i.component == component && i.feature.as_deref() == Some(feature));
        of.into_iter().find_map(|inventory| inventory.value_by_id(id))
    };
    let fingers = value
        .orientation
        .as_ref()
        .and_then(|orientation| feature(SignComponent::Orientation, "fingers", &orientation.fingers)?.direction);
    let roll = value
        .orientation
        .as_ref()
        .and_then(|orientation| feature(SignComponent::Orientation, "palm", &orientation.palm)?.roll);
    let strokes = value.strokes.iter().map(|stroke| {
        let displacement = stroke
            .direction
            .as_deref()
            .and_then(|id| feature(SignComponent::Movement, "direction", id)?.direction)
            .map_or(DVec3::ZERO, |displacement| DVec3::from(displacement) * stroke.size);
        LetterStroke {
            displacement: displacement.to_array(),
            turn: stroke.turn,
        }
    });
    AlphabetLetter {
        letter: value.letter.clone().unwrap_or_default(),
        value: with_pose(all, alphabet, value),
        fingers,
        palm: roll.map(|roll| lookup_palm_direction(fingers, roll).to_array()),
        strokes: strokes.collect(),
    }
}

/// Returns the direction of the palm as notation writes it for fingers in that direction; without one, they point up.
fn lookup_palm_direction(fingers: Option<[f64; 3]>, roll: f64) -> DVec3 {
    let fingers = fingers.map_or(DVec3::Y, DVec3::from).normalize_or(DVec3::Y);
    DVec3::from(orientation::palm_direction_vector(fingers.to_array(), roll))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::ValueMeaning;
    use chereme_sign::inventory::builtin_inventories;

    #[test]
    fn every_letter_of_the_alphabet_has_a_posture_and_a_direction() {
        let letters = letters_in(builtin_inventories(), None, "abcdefghijklmnopqrstuvwxyz").expect("letters");
        assert_eq!(letters.len(), 26);
        for letter in &letters {
            let name = &letter.letter;
            assert!(matches!(letter.value.meaning, Some(ValueMeaning::Hand(_))), "{name}");
            let fingers = DVec3::from(letter.fingers.expect("a direction"));
            let palm = DVec3::from(letter.palm.expect("a direction"));
            assert!(fingers.dot(palm).abs() < 1e-9 && palm.is_normalized(), "{name}");
        }
        let a = &letters[0];
        assert!(
            DVec3::from(a.palm.expect("a palm")).abs_diff_eq(DVec3::Z, 1e-9),
            "away from the signer"
        );
        assert!(letters[9].strokes.len() > 1 && letters[25].strokes.len() == 3);
        assert_eq!(
            letters_in(builtin_inventories(), Some("lsf"), "week-end É")
                .expect("letters")
                .len(),
            8
        );
    }

    #[test]
    fn palms_of_letters_face_as_notation_writes_them() {
        let half = 0.5_f64.sqrt();
        for (fingers, roll, faces) in [
            (Some([0.0, 1.0, 0.0]), 0.0, DVec3::Z),
            (Some([0.0, -1.0, 0.0]), 0.0, DVec3::NEG_Z),
            (Some([half, half, 0.0]), 0.0, DVec3::new(half, -half, 0.0)),
            (Some([half, half, 0.0]), -std::f64::consts::FRAC_PI_2, DVec3::NEG_Z),
            (None, -std::f64::consts::FRAC_PI_2, DVec3::X),
        ] {
            let palm = lookup_palm_direction(fingers, roll);
            assert!(palm.abs_diff_eq(faces, 1e-9), "{fingers:?} {roll}: {palm}");
        }
    }

    #[test]
    fn unknown_letters_and_alphabets_are_named() {
        for (alphabet, word, want) in [(None, "a1", "\"1\""), (Some("morse"), "a", "\"morse\"")] {
            let error = letters_in(builtin_inventories(), alphabet, word)
                .expect_err(word)
                .to_string();
            assert!(error.contains(want), "{error}");
        }
        let value = value_in(builtin_inventories(), SignComponent::Placement, "chin").expect("chin");
        assert!(matches!(value.meaning, Some(ValueMeaning::Place(_))));
        let error = value_in(builtin_inventories(), SignComponent::Placement, "foreheda").expect_err("misspelt");
        let right = error.source_meant_name().map(|it| it.right);
        assert_eq!(right.as_deref(), Some("forehead"), "{error}");
    }
}
