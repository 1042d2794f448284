//! Maps a notated sign to component values, in the words of a corpus's inventories.
//!
//! Notation is finer than inventories in some things and coarser in others. A value is *exact* if the
//! inventory's value means the same; otherwise it is the nearest one, and the differences are listed as
//! lost. Successive values of a component are its initial, middle and final ones; a hand that follows the
//! other by a symmetry has values of its own.
//!
//! ```
//! use chereme_sign::hamnosys::components::SignMapper;
//! use chereme_sign::hamnosys::{BodyLocation, BodyPlace, PlaceContact, EachHand, HandshapeForm, HandClass, Handshape};
//! use chereme_sign::hamnosys::{ManualPart, NotatedSign, HandPlace, NotatedPosture, HamnosysSign, SidedLocation};
//!
//! let shape = Handshape { form: HandshapeForm { class: HandClass::Flat, ..HandshapeForm::default() }, ..Handshape::default() };
//! let chin = SidedLocation { at: BodyLocation::Chin, side: None, approx: false };
//! let place = BodyPlace { site: Some(chin), contact: Some(PlaceContact::Touch), ..BodyPlace::default() };
//! let posture = NotatedPosture { shape: EachHand::Shared(shape), place: Some(HandPlace::Body(place)), ..NotatedPosture::default() };
//! let sign = HamnosysSign { parts: vec![ManualPart { posture, ..ManualPart::default() }] };
//! let mapped = SignMapper::new(chereme_sign::inventory::builtin_inventories()).map_sign_components(&NotatedSign { sign, ..NotatedSign::default() });
//! let said: Vec<String> = mapped.values.iter().map(|it| format!("{}={}", it.field, it.value)).collect();
//! assert_eq!(said, ["dominant.configuration=flat", "dominant.placement=chin", "dominant.movement=hold"]);
//! ```

mod components_hands;
mod components_motion;
mod components_place;
mod components_shape;

use std::collections::BTreeMap;

use self::components_hands::HandActions;
use self::components_shape::InventoryHandshapes;
use super::direction::{CompassDirection, SpatialDirection};
use super::hamnosys_nonmanual::{NonmanualActs, NonmanualPart};
use super::hamnosys_notated::NotatedSign;
use crate::component::{ComponentField, HandRef, SignComponent, SignPhase};
use crate::inventory::ComponentInventory;

/// The component values of a notated sign.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MappedSign {
    /// The values, in this order: of the dominant hand, of the weak hand, of face and body.
    pub values: Vec<MappedValue>,
    /// The parts of the notation that the values do not express, without duplicates.
    pub lost: Vec<String>,
}

/// One value of a component.
#[derive(Debug, Clone, PartialEq)]
pub struct MappedValue {
    /// The component, with its hand and phase.
    pub field: ComponentField,
    /// The id of a value of the field's inventory.
    pub value: String,
    /// Whether it means everything in the notation.
    pub exact: bool,
}

/// Maps notated signs to component values.
#[derive(Debug)]
pub struct SignMapper<'i> {
    /// The values of each component and feature, by id and alias.
    words: BTreeMap<(SignComponent, Option<&'i str>), BTreeMap<&'i str, &'i str>>,
    shapes: InventoryHandshapes<'i>,
    left_handed: bool,
}

impl<'i> SignMapper<'i> {
    /// Prepares for these inventories; for each component or feature the first one counts.
    pub fn new(inventories: impl IntoIterator<Item = &'i ComponentInventory>) -> Self {
        let mut words = BTreeMap::new();
        let mut shapes = InventoryHandshapes::default();
        for inventory in inventories {
            let key = (inventory.component, inventory.feature.as_deref());
            if words.contains_key(&key) {
                continue;
            }
            if key == (SignComponent::Configuration, None) {
                shapes = InventoryHandshapes::from_inventory_notation(inventory);
            }
            let mut ids_by_word: BTreeMap<&str, &str> = BTreeMap::new();
            for value in &inventory.values {
                for alias in &value.aliases {
                    ids_by_word.entry(alias).or_insert(&value.id);
                }
            }
            ids_by_word.extend(inventory.values.iter().map(|value| (&*value.id, &*value.id)));
            words.insert(key, ids_by_word);
        }
        Self {
            words,
            shapes,
            left_handed: false,
        }
    }

    /// Maps what the hands of a left-handed signer do, if `left_handed`. Their notation is that of a right-handed
    /// signer, so left and right are exchanged in values, which are the signer's own sides; sides that count from
    /// the acting hand stay.
    #[must_use]
    pub fn of_left_handed(mut self, left_handed: bool) -> Self {
        self.left_handed = left_handed;
        self
    }

    /// Returns the component values of a sign.
    #[must_use]
    pub fn map_sign_components(&self, notated: &NotatedSign) -> MappedSign {
        let mut lost = NotationLosses::default();
        let mut hands = HandActions::new(&self.shapes);
        for part in &notated.sign.parts {
            hands.process_manual_part(part, &mut lost);
        }
        let mut mapped = MappedSign::default();
        for (hand, course) in [HandRef::Dominant, HandRef::Weak]
            .into_iter()
            .zip(hands.both_hand_courses())
        {
            for (component, feature, steps) in course {
                self.write_field_values(Some(hand), component, feature, &steps, &mut mapped, &mut lost);
            }
        }
        for (feature, steps) in map_nonmanual_features(&notated.nonmanual, &mut lost) {
            let component = SignComponent::NonManual;
            self.write_field_values(None, component, Some(feature), &steps, &mut mapped, &mut lost);
        }
        mapped.lost = lost.0;
        mapped
    }

    /// Writes successive values of one field, each with its phase.
    fn write_field_values(
        &self,
        hand: Option<HandRef>,
        component: SignComponent,
        feature: Option<&'static str>,
        steps: &[Vec<ComponentWord>],
        mapped: &mut MappedSign,
        lost: &mut NotationLosses,
    ) {
        let word_ids = self.words.get(&(component, feature));
        let mut written: Vec<Vec<(&str, bool)>> = Vec::new();
        for step in steps {
            let mut step_values = Vec::new();
            for value in step {
                // Directions are written for a right-handed signer; a left-handed one has them the other way round.
                let word = if self.left_handed && hand.is_some() {
                    mirrored_component_value(component, feature, &value.word)
                } else {
                    value.word.clone()
                };
                match word_ids.and_then(|known| known.get(word.as_str())) {
                    Some(id) if step_values.iter().all(|(other, _)| other != id) => {
                        step_values.push((*id, value.exact));
                    }
                    Some(_) => {}
                    None => {
                        lost.add_notation_loss(format!("{} has no {word}", component_field_name(component, feature)))
                    }
                }
            }
            // Two steps may differ in what the inventory cannot say, and are one value then.
            let same = |before: &Vec<(&str, bool)>| {
                let ids = |(a, b): (&(&str, bool), &(&str, bool))| a.0 == b.0;
                before.len() == step_values.len() && before.iter().zip(&step_values).all(ids)
            };
            if !step_values.is_empty() && !written.last().is_some_and(same) {
                written.push(step_values);
            }
        }
        let last = written.len().saturating_sub(1);
        for (at, step) in written.iter().enumerate() {
            let phase = match at {
                // A value of the whole sign has no phase.
                _ if last == 0 => None,
                0 => Some(SignPhase::Initial),
                at if at == last => Some(SignPhase::Final),
                at => Some(SignPhase::Middle(u8::try_from(at).unwrap_or(u8::MAX))),
            };
            mapped.values.extend(step.iter().map(|(id, exact)| MappedValue {
                field: ComponentField {
                    hand,
                    component,
                    feature: feature.map(str::to_owned),
                    phase,
                },
                value: (*id).to_owned(),
                exact: *exact,
            }));
        }
    }
}

fn component_field_name(component: SignComponent, feature: Option<&str>) -> String {
    feature.map_or_else(|| component.to_string(), |feature| format!("{component}.{feature}"))
}

/// Returns the value for the mirror image across the signer's middle.
fn mirrored_component_value(component: SignComponent, feature: Option<&str>, word: &str) -> String {
    let other = match (component, feature) {
        (SignComponent::Orientation, Some("palm")) => word
            .parse()
            .ok()
            .map(|compass: CompassDirection| compass.mirrored_compass_direction().to_string()),
        (SignComponent::Orientation, Some("fingers")) | (SignComponent::Movement, Some("direction")) => word
            .parse()
            .ok()
            .map(|direction: SpatialDirection| direction.mirrored_spatial_direction().to_string()),
        (SignComponent::Placement, None) => {
            let parts = word.split('-').map(|part| match part {
                "left" => "right",
                "right" => "left",
                part => part,
            });
            Some(parts.collect::<Vec<_>>().join("-"))
        }
        _ => None,
    };
    other.unwrap_or_else(|| word.to_owned())
}

/// A value as an inventory spells it, and whether it means the same as the notation.
#[derive(Debug, Clone, PartialEq)]
struct ComponentWord {
    word: String,
    exact: bool,
}

impl ComponentWord {
    fn exact_value(word: impl Into<String>) -> Self {
        let word = word.into();
        Self { word, exact: true }
    }

    fn approximate_value(word: impl Into<String>) -> Self {
        let word = word.into();
        Self { word, exact: false }
    }
}

/// The parts of the notation that the values do not express, without duplicates.
#[derive(Debug, Default)]
struct NotationLosses(Vec<String>);

impl NotationLosses {
    fn add_notation_loss(&mut self, what: impl Into<String>) {
        let what = what.into();
        if !self.0.contains(&what) {
            self.0.push(what);
        }
    }
}

/// Returns the successive values of each feature of face and body; simultaneous acts of one feature follow each other, and a
/// mouth picture becomes `word`, without its sounds.
fn map_nonmanual_features(
    notated: &NonmanualActs,
    lost: &mut NotationLosses,
) -> BTreeMap<&'static str, Vec<Vec<ComponentWord>>> {
    let mut features: BTreeMap<&'static str, Vec<Vec<ComponentWord>>> = BTreeMap::new();
    for (_, act) in notated.acts_by_tier() {
        let (feature, value) = match act.part {
            NonmanualPart::Shoulders => ("shoulders", act.act_code()),
            NonmanualPart::Body => ("body", act.act_code()),
            NonmanualPart::Head => ("head", act.act_code()),
            NonmanualPart::Gaze => ("gaze", act.act_code()),
            NonmanualPart::Brows => ("brows", act.act_code()),
            NonmanualPart::Lids => ("lids", act.act_code()),
            NonmanualPart::Nose => ("nose", act.act_code()),
            NonmanualPart::MouthGesture => ("mouth", act.act_code()),
            NonmanualPart::MouthPicture => ("mouthing", "word"),
            NonmanualPart::MouthMeta => ("mouthing", act.act_code()),
            NonmanualPart::Neutral => continue,
            NonmanualPart::Extra => {
                lost.add_notation_loss(format!("nonmanual has no {}", act.act_code()));
                continue;
            }
        };
        let steps = features.entry(feature).or_default();
        steps.push(vec![ComponentWord::exact_value(value)]);
    }
    features
}

#[cfg(test)]
mod tests;
