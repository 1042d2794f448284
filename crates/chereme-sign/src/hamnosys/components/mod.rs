//! Maps a notated sign to component values, in the words of a corpus's inventories.
//!
//! Notation is finer than inventories in some things and coarser in others. A value is *exact* if the
//! inventory's value means the same; otherwise it is the nearest one, and the differences are listed as
//! lost. Successive values of a component are its initial, middle and final ones; a hand that follows the
//! other by a symmetry has values of its own.
//!
//! ```
//! use chereme_sign::hamnosys::components::Mapper;
//! use chereme_sign::hamnosys::{BodyLocation, BodyPlace, Contact, Each, Form, HandClass, Handshape};
//! use chereme_sign::hamnosys::{Manual, Notated, Place, Posture, Sign, Site};
//!
//! let shape = Handshape { form: Form { class: HandClass::Flat, ..Form::default() }, ..Handshape::default() };
//! let chin = Site { at: BodyLocation::Chin, side: None, approx: false };
//! let place = BodyPlace { site: Some(chin), contact: Some(Contact::Touch), ..BodyPlace::default() };
//! let posture = Posture { shape: Each::Shared(shape), place: Some(Place::Body(place)), ..Posture::default() };
//! let sign = Sign { parts: vec![Manual { posture, ..Manual::default() }] };
//! let mapped = Mapper::new(chereme_sign::inventory::builtin()).map(&Notated { sign, ..Notated::default() });
//! let said: Vec<String> = mapped.values.iter().map(|it| format!("{}={}", it.field, it.value)).collect();
//! assert_eq!(said, ["dominant.configuration=flat", "dominant.placement=chin", "dominant.movement=hold"]);
//! ```

mod hands;
mod motion;
mod place;
mod shape;

use std::collections::BTreeMap;

use self::hands::Hands;
use self::shape::Shapes;
use super::direction::{Compass, Direction};
use super::nonmanual::{Nonmanual, NonmanualPart};
use super::notated::Notated;
use crate::component::{Component, Field, HandRef, Phase};
use crate::inventory::Inventory;

/// The component values of a notated sign.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mapped {
    /// The values, in this order: of the dominant hand, of the weak hand, of face and body.
    pub values: Vec<MappedValue>,
    /// The parts of the notation that the values do not express, without duplicates.
    pub lost: Vec<String>,
}

/// One value of a component.
#[derive(Debug, Clone, PartialEq)]
pub struct MappedValue {
    /// The component, with its hand and phase.
    pub field: Field,
    /// The id of a value of the field's inventory.
    pub value: String,
    /// Whether it means everything in the notation.
    pub exact: bool,
}

/// Maps notated signs to component values.
#[derive(Debug)]
pub struct Mapper<'i> {
    /// The values of each component and feature, by id and alias.
    words: BTreeMap<(Component, Option<&'i str>), BTreeMap<&'i str, &'i str>>,
    shapes: Shapes<'i>,
    left_handed: bool,
}

impl<'i> Mapper<'i> {
    /// Prepares for these inventories; for each component or feature the first one counts.
    pub fn new(inventories: impl IntoIterator<Item = &'i Inventory>) -> Self {
        let mut words = BTreeMap::new();
        let mut shapes = Shapes::default();
        for inventory in inventories {
            let key = (inventory.component, inventory.feature.as_deref());
            if words.contains_key(&key) {
                continue;
            }
            if key == (Component::Configuration, None) {
                shapes = Shapes::of(inventory);
            }
            let mut own: BTreeMap<&str, &str> = BTreeMap::new();
            for value in &inventory.values {
                for alias in &value.aliases {
                    own.entry(alias).or_insert(&value.id);
                }
            }
            own.extend(
                inventory
                    .values
                    .iter()
                    .map(|value| (&*value.id, &*value.id)),
            );
            words.insert(key, own);
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
    pub fn map(&self, notated: &Notated) -> Mapped {
        let mut lost = Lost::default();
        let mut hands = Hands::new(&self.shapes);
        for part in &notated.sign.parts {
            hands.part(part, &mut lost);
        }
        let mut mapped = Mapped::default();
        for (hand, course) in [HandRef::Dominant, HandRef::Weak]
            .into_iter()
            .zip(hands.courses())
        {
            for (component, feature, steps) in course {
                self.write(
                    Some(hand),
                    component,
                    feature,
                    &steps,
                    &mut mapped,
                    &mut lost,
                );
            }
        }
        for (feature, steps) in nonmanual(&notated.nonmanual, &mut lost) {
            let component = Component::NonManual;
            self.write(
                None,
                component,
                Some(feature),
                &steps,
                &mut mapped,
                &mut lost,
            );
        }
        mapped.lost = lost.0;
        mapped
    }

    /// Writes successive values of one field, each with its phase.
    fn write(
        &self,
        hand: Option<HandRef>,
        component: Component,
        feature: Option<&'static str>,
        steps: &[Vec<Value>],
        mapped: &mut Mapped,
        lost: &mut Lost,
    ) {
        let known = self.words.get(&(component, feature));
        let mut written: Vec<Vec<(&str, bool)>> = Vec::new();
        for step in steps {
            let mut own = Vec::new();
            for value in step {
                let word = if self.left_handed && hand.is_some() {
                    mirrored(component, feature, &value.word)
                } else {
                    value.word.clone()
                };
                match known.and_then(|known| known.get(word.as_str())) {
                    Some(id) if own.iter().all(|(other, _)| other != id) => {
                        own.push((*id, value.exact));
                    }
                    Some(_) => {}
                    None => lost.add(format!("{} has no {word}", name(component, feature))),
                }
            }
            let same = |before: &Vec<(&str, bool)>| {
                let ids = |(a, b): (&(&str, bool), &(&str, bool))| a.0 == b.0;
                before.len() == own.len() && before.iter().zip(&own).all(ids)
            };
            if !own.is_empty() && !written.last().is_some_and(same) {
                written.push(own);
            }
        }
        let last = written.len().saturating_sub(1);
        for (at, step) in written.iter().enumerate() {
            let phase = match at {
                _ if last == 0 => None,
                0 => Some(Phase::Initial),
                at if at == last => Some(Phase::Final),
                at => Some(Phase::Middle(u8::try_from(at).unwrap_or(u8::MAX))),
            };
            mapped
                .values
                .extend(step.iter().map(|(id, exact)| MappedValue {
                    field: Field {
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

fn name(component: Component, feature: Option<&str>) -> String {
    feature.map_or_else(
        || component.to_string(),
        |feature| format!("{component}.{feature}"),
    )
}

/// Returns the value for the mirror image across the signer's middle.
fn mirrored(component: Component, feature: Option<&str>, word: &str) -> String {
    let other = match (component, feature) {
        (Component::Orientation, Some("palm")) => word
            .parse()
            .ok()
            .map(|it: Compass| it.mirrored().to_string()),
        (Component::Orientation, Some("fingers")) | (Component::Movement, Some("direction")) => {
            word.parse()
                .ok()
                .map(|it: Direction| it.mirrored().to_string())
        }
        (Component::Placement, None) => {
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
struct Value {
    word: String,
    exact: bool,
}

impl Value {
    fn exact(word: impl Into<String>) -> Self {
        let word = word.into();
        Self { word, exact: true }
    }

    fn near(word: impl Into<String>) -> Self {
        let word = word.into();
        Self { word, exact: false }
    }
}

/// The parts of the notation that the values do not express, without duplicates.
#[derive(Debug, Default)]
struct Lost(Vec<String>);

impl Lost {
    fn add(&mut self, what: impl Into<String>) {
        let what = what.into();
        if !self.0.contains(&what) {
            self.0.push(what);
        }
    }
}

/// Returns the successive values of each feature of face and body; simultaneous acts of one feature follow each other, and a
/// mouth picture becomes `word`, without its sounds.
fn nonmanual(notated: &Nonmanual, lost: &mut Lost) -> BTreeMap<&'static str, Vec<Vec<Value>>> {
    let mut features: BTreeMap<&'static str, Vec<Vec<Value>>> = BTreeMap::new();
    for (_, act) in notated.acts() {
        let (feature, value) = match act.part {
            NonmanualPart::Shoulders => ("shoulders", act.code()),
            NonmanualPart::Body => ("body", act.code()),
            NonmanualPart::Head => ("head", act.code()),
            NonmanualPart::Gaze => ("gaze", act.code()),
            NonmanualPart::Brows => ("brows", act.code()),
            NonmanualPart::Lids => ("lids", act.code()),
            NonmanualPart::Nose => ("nose", act.code()),
            NonmanualPart::MouthGesture => ("mouth", act.code()),
            NonmanualPart::MouthPicture => ("mouthing", "word"),
            NonmanualPart::MouthMeta => ("mouthing", act.code()),
            NonmanualPart::Neutral => continue,
            NonmanualPart::Extra => {
                lost.add(format!("nonmanual has no {}", act.code()));
                continue;
            }
        };
        let steps = features.entry(feature).or_default();
        steps.push(vec![Value::exact(value)]);
    }
    features
}

#[cfg(test)]
mod tests;
