//! Finds the inventory's handshape nearest to a notated one.

use super::super::tree::{
    CeeOpening, DigitList, FingerBend, FingerContact, HandClass, HandDigit, Handshape, HandshapeForm, ThumbPosition,
};
use super::{ComponentWord, NotationLosses};
use crate::inventory::ComponentInventory;

/// The handshapes of an inventory, each by its own notation.
#[derive(Debug, Default)]
pub(super) struct InventoryHandshapes<'i>(Vec<(&'i str, Handshape)>);

impl<'i> InventoryHandshapes<'i> {
    /// Reads the notation of each value that has one.
    pub(super) fn from_inventory_notation(inventory: &'i ComponentInventory) -> Self {
        let shapes = inventory.values.iter().filter_map(|value| {
            let shape = read_symbol_handshape(value.hamnosys.as_deref()?)?;
            Some((&*value.id, shape))
        });
        Self(shapes.collect())
    }

    /// Returns the nearest handshape, and records the differences in `lost`.
    pub(super) fn nearest_handshape_value(
        &self,
        shape: &Handshape,
        lost: &mut NotationLosses,
    ) -> Option<ComponentWord> {
        let cost = |known: &Handshape| {
            let first = form_cost(&shape.form, &known.form);
            let between = match &shape.between {
                // The first form weighs a little more, so that the middle of two forms maps to it.
                Some(second) => 0.45 * form_cost(second, &known.form) + 0.55 * first,
                None => first,
            };
            between + finger_cost(shape, known)
        };
        let least = |a: &(f64, &str), b: &(f64, &str)| a.0.total_cmp(&b.0);
        let costs = self.0.iter().map(|(id, known)| (cost(known), *id));
        let (cost, id) = costs.min_by(least)?;
        if shape.between.is_some() {
            lost.add_notation_loss("configuration: half-way between two");
        }
        if cost == 0.0 && !shape.approx && shape.splay.is_none() {
            return Some(ComponentWord::exact_value(id));
        }
        if shape.between.is_none() {
            lost.add_notation_loss(format!("configuration: the difference from {id}"));
        }
        Some(ComponentWord::approximate_value(id))
    }
}

/// Reads a handshape of symbol names separated by blanks.
fn read_symbol_handshape(names: &str) -> Option<Handshape> {
    let mut shape = Handshape::default();
    let mut classed = false;
    let mut digits: Vec<HandDigit> = Vec::new();
    let mut crossing = false;
    for name in names.split(' ') {
        let name = name.strip_prefix("ham").unwrap_or(name);
        if let Some(class) = parse_class_symbol(name) {
            shape.form.class = class;
            classed = true;
        } else if let Some(bend) = parse_bend_symbol(name) {
            // A bend after a digit is that of this digit, and without one that of all stretched fingers.
            match digits.pop() {
                Some(digit) => shape.bends[digit as usize] = Some(bend),
                None => shape.form.bend = Some(bend),
            }
        } else if let Some(digit) = parse_digit_symbol(name) {
            match digits.pop().filter(|_| crossing) {
                Some(first) => shape.contacts.push(FingerContact {
                    first,
                    second: digit,
                    part: None,
                }),
                None => digits.push(digit),
            }
            crossing = false;
        } else {
            match name {
                "thumboutmod" => shape.form.thumb = Some(ThumbPosition::Out),
                "thumbacrossmod" => shape.form.thumb = Some(ThumbPosition::Across),
                "thumbopenmod" => shape.form.thumb = Some(ThumbPosition::Opposed),
                "cross" => crossing = true,
                _ => return None,
            }
        }
    }
    shape.special = DigitList(digits);
    classed.then_some(shape)
}

fn parse_class_symbol(name: &str) -> Option<HandClass> {
    Some(match name {
        "fist" => HandClass::Fist,
        "flathand" => HandClass::Flat,
        "finger2" => HandClass::Finger2,
        "finger23" => HandClass::Finger23,
        "finger23spread" => HandClass::Finger23Spread,
        "finger2345" => HandClass::Finger2345,
        "pinch12" => HandClass::Pinch12,
        "pinch12open" => HandClass::Pinch12Open,
        "pinchall" => HandClass::PinchAll,
        "cee12" => HandClass::Cee12,
        "ceeopen" => HandClass::Cee12Open,
        "ceeall" => HandClass::CeeAll,
        _ => return None,
    })
}

fn parse_bend_symbol(name: &str) -> Option<FingerBend> {
    Some(match name {
        "fingerstraightmod" => FingerBend::Bent,
        "fingerbendmod" => FingerBend::Round,
        "fingerhookmod" => FingerBend::Hooked,
        "doublebent" => FingerBend::DoubleBent,
        "doublehooked" => FingerBend::DoubleHooked,
        _ => return None,
    })
}

fn parse_digit_symbol(name: &str) -> Option<HandDigit> {
    Some(match name {
        "thumb" => HandDigit::Thumb,
        "indexfinger" => HandDigit::Index,
        "middlefinger" => HandDigit::Middle,
        "ringfinger" => HandDigit::Ring,
        "pinky" => HandDigit::Little,
        _ => return None,
    })
}

/// Returns the bends of three joints, 0 to 4.
pub(super) fn joint_bend_amounts(bend: Option<FingerBend>) -> [f64; 3] {
    match bend {
        None => [0.0; 3],
        Some(FingerBend::Bent) => [4.0, 0.0, 0.0],
        Some(FingerBend::Round) => [2.0; 3],
        Some(FingerBend::Hooked) => [0.0, 4.0, 4.0],
        Some(FingerBend::DoubleBent) => [4.0, 4.0, 0.0],
        Some(FingerBend::DoubleHooked) => [4.0; 3],
        Some(FingerBend::HalfBent) => [2.0, 0.0, 0.0],
        Some(FingerBend::Joints(joints)) => joints,
    }
}

fn bend_cost(a: Option<FingerBend>, b: Option<FingerBend>) -> f64 {
    let (a, b) = (joint_bend_amounts(a), joint_bend_amounts(b));
    a.iter().zip(b).map(|(a, b)| (a - b).abs() / 4.0).sum()
}

fn form_cost(notated: &HandshapeForm, known: &HandshapeForm) -> f64 {
    let class = if notated.class == known.class {
        0.0
    } else if similar_class_group(notated.class) == similar_class_group(known.class) {
        6.0
    } else {
        20.0
    };
    let thumb = if relevant_thumb_position(notated) == relevant_thumb_position(known) {
        0.0
    } else {
        1.2
    };
    class + thumb + bend_cost(notated.bend, known.bend)
}

/// Returns the thumb's position if it matters for the class: a cee has an opening instead, and a pinch has
/// neither.
fn relevant_thumb_position(form: &HandshapeForm) -> (Option<ThumbPosition>, Option<CeeOpening>) {
    match form.class {
        HandClass::Pinch12 | HandClass::Pinch12Open | HandClass::PinchAll => (None, None),
        HandClass::Cee12 | HandClass::Cee12Open | HandClass::CeeAll => {
            let by_thumb = match form.thumb {
                Some(ThumbPosition::Across) => Some(CeeOpening::Tight),
                Some(ThumbPosition::Opposed) => Some(CeeOpening::Slack),
                Some(ThumbPosition::Out) | None => None,
            };
            (None, form.opening.or(by_thumb))
        }
        _ => (form.thumb, None),
    }
}

/// Classes that look alike.
fn similar_class_group(class: HandClass) -> u8 {
    match class {
        HandClass::Fist => 0,
        HandClass::Flat | HandClass::Finger2345 => 1,
        HandClass::Finger2 | HandClass::Finger23 | HandClass::Finger23Spread => 2,
        HandClass::Pinch12 | HandClass::PinchAll | HandClass::Pinch12Open => 3,
        HandClass::Cee12 | HandClass::CeeAll | HandClass::Cee12Open => 4,
    }
}

/// Returns the penalty for different selected, bent and crossed fingers.
fn finger_cost(notated: &Handshape, known: &Handshape) -> f64 {
    let both = |digit: &HandDigit| notated.special.contains_digit(*digit) != known.special.contains_digit(*digit);
    let special = HandDigit::ALL_HAND_DIGITS.iter().filter(|digit| both(digit)).count() as f64;
    let bends: f64 = notated
        .bends
        .iter()
        .zip(&known.bends)
        .map(|(notated, known)| bend_cost(*notated, *known))
        .sum();
    let crossed = |shape: &Handshape| {
        let pair = shape.contacts.first()?;
        let (a, b) = (pair.first.min(pair.second), pair.first.max(pair.second));
        Some((a, b))
    };
    let contacts = if crossed(notated) == crossed(known) { 0.0 } else { 2.5 };
    let unknown = notated.exempt.0.len() as f64 * 0.3
        + if notated.opposed.is_some() { 0.3 } else { 0.0 }
        + if notated.thumb.is_some() { 0.3 } else { 0.0 };
    special * 1.5 + bends * 0.6 + contacts + unknown
}

/// Returns how open a hand is, as a number to compare with another's.
pub(super) fn handshape_openness(shape: &Handshape) -> f64 {
    let class = match shape.form.class {
        HandClass::Fist => 0.0,
        HandClass::PinchAll | HandClass::Pinch12 => 1.0,
        HandClass::Finger2 | HandClass::Cee12 => 2.0,
        HandClass::Finger23 | HandClass::Finger23Spread | HandClass::Pinch12Open => 3.0,
        HandClass::CeeAll | HandClass::Cee12Open => 3.5,
        HandClass::Flat => 4.0,
        HandClass::Finger2345 => 4.5,
    };
    class - joint_bend_amounts(shape.form.bend).iter().sum::<f64>() / 12.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inventory::builtin_by_id;

    #[test]
    fn every_built_in_handshape_is_its_own_nearest_value() {
        let inventory = builtin_by_id("configurations").expect("built in");
        let shapes = InventoryHandshapes::from_inventory_notation(inventory);
        assert_eq!(shapes.0.len(), inventory.values.len());
        for (id, shape) in &shapes.0 {
            let mut lost = NotationLosses::default();
            let own = shapes.0.iter().find(|(_, other)| other == shape);
            let found = shapes.nearest_handshape_value(shape, &mut lost).expect("there is one");
            assert_eq!(own.map(|(id, _)| ComponentWord::exact_value(*id)), Some(found), "{id}");
            assert!(lost.0.is_empty());
        }
    }
}
