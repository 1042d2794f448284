//! Finds the inventory's handshape nearest to a notated one.

use super::super::tree::{
    Bend, Digit, Digits, FingerContact, Form, HandClass, Handshape, Opening, ThumbPosition,
};
use super::{Lost, Value};
use crate::inventory::Inventory;

/// The handshapes of an inventory, each by its own notation.
#[derive(Debug, Default)]
pub(super) struct Shapes<'i>(Vec<(&'i str, Handshape)>);

impl<'i> Shapes<'i> {
    /// Reads the notation of each value that has one.
    pub(super) fn of(inventory: &'i Inventory) -> Self {
        let shapes = inventory.values.iter().filter_map(|value| {
            let shape = read(value.hamnosys.as_deref()?)?;
            Some((&*value.id, shape))
        });
        Self(shapes.collect())
    }

    /// Returns the nearest handshape, and records the differences in `lost`.
    pub(super) fn nearest(&self, shape: &Handshape, lost: &mut Lost) -> Option<Value> {
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
            lost.add("configuration: half-way between two");
        }
        if cost == 0.0 && !shape.approx && shape.splay.is_none() {
            return Some(Value::exact(id));
        }
        if shape.between.is_none() {
            lost.add(format!("configuration: the difference from {id}"));
        }
        Some(Value::near(id))
    }
}

/// Reads a handshape of symbol names separated by blanks.
fn read(names: &str) -> Option<Handshape> {
    let mut shape = Handshape::default();
    let mut classed = false;
    let mut digits: Vec<Digit> = Vec::new();
    let mut crossing = false;
    for name in names.split(' ') {
        let name = name.strip_prefix("ham").unwrap_or(name);
        if let Some(class) = class(name) {
            shape.form.class = class;
            classed = true;
        } else if let Some(bend) = bend(name) {
            match digits.pop() {
                Some(digit) => shape.bends[digit as usize] = Some(bend),
                None => shape.form.bend = Some(bend),
            }
        } else if let Some(digit) = digit(name) {
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
    shape.special = Digits(digits);
    classed.then_some(shape)
}

fn class(name: &str) -> Option<HandClass> {
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

fn bend(name: &str) -> Option<Bend> {
    Some(match name {
        "fingerstraightmod" => Bend::Bent,
        "fingerbendmod" => Bend::Round,
        "fingerhookmod" => Bend::Hooked,
        "doublebent" => Bend::DoubleBent,
        "doublehooked" => Bend::DoubleHooked,
        _ => return None,
    })
}

fn digit(name: &str) -> Option<Digit> {
    Some(match name {
        "thumb" => Digit::Thumb,
        "indexfinger" => Digit::Index,
        "middlefinger" => Digit::Middle,
        "ringfinger" => Digit::Ring,
        "pinky" => Digit::Little,
        _ => return None,
    })
}

/// Returns the bends of three joints, 0 to 4.
pub(super) fn joints(bend: Option<Bend>) -> [f64; 3] {
    match bend {
        None => [0.0; 3],
        Some(Bend::Bent) => [4.0, 0.0, 0.0],
        Some(Bend::Round) => [2.0; 3],
        Some(Bend::Hooked) => [0.0, 4.0, 4.0],
        Some(Bend::DoubleBent) => [4.0, 4.0, 0.0],
        Some(Bend::DoubleHooked) => [4.0; 3],
        Some(Bend::HalfBent) => [2.0, 0.0, 0.0],
        Some(Bend::Joints(joints)) => joints,
    }
}

fn bend_cost(a: Option<Bend>, b: Option<Bend>) -> f64 {
    let (a, b) = (joints(a), joints(b));
    a.iter().zip(b).map(|(a, b)| (a - b).abs() / 4.0).sum()
}

fn form_cost(notated: &Form, known: &Form) -> f64 {
    let class = if notated.class == known.class {
        0.0
    } else if group(notated.class) == group(known.class) {
        6.0
    } else {
        20.0
    };
    let thumb = if thumb(notated) == thumb(known) {
        0.0
    } else {
        1.2
    };
    class + thumb + bend_cost(notated.bend, known.bend)
}

/// Returns the thumb's position if it matters for the class: a cee has an opening instead, and a pinch has
/// neither.
fn thumb(form: &Form) -> (Option<ThumbPosition>, Option<Opening>) {
    match form.class {
        HandClass::Pinch12 | HandClass::Pinch12Open | HandClass::PinchAll => (None, None),
        HandClass::Cee12 | HandClass::Cee12Open | HandClass::CeeAll => {
            let by_thumb = match form.thumb {
                Some(ThumbPosition::Across) => Some(Opening::Tight),
                Some(ThumbPosition::Opposed) => Some(Opening::Slack),
                Some(ThumbPosition::Out) | None => None,
            };
            (None, form.opening.or(by_thumb))
        }
        _ => (form.thumb, None),
    }
}

/// Classes that look alike.
fn group(class: HandClass) -> u8 {
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
    let both = |digit: &Digit| notated.special.contains(*digit) != known.special.contains(*digit);
    let special = Digit::ALL.iter().filter(|digit| both(digit)).count() as f64;
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
    let contacts = if crossed(notated) == crossed(known) {
        0.0
    } else {
        2.5
    };
    let unknown = notated.exempt.0.len() as f64 * 0.3
        + if notated.opposed.is_some() { 0.3 } else { 0.0 }
        + if notated.thumb.is_some() { 0.3 } else { 0.0 };
    special * 1.5 + bends * 0.6 + contacts + unknown
}

/// Returns how open a hand is, as a number to compare with another's.
pub(super) fn openness(shape: &Handshape) -> f64 {
    let class = match shape.form.class {
        HandClass::Fist => 0.0,
        HandClass::PinchAll | HandClass::Pinch12 => 1.0,
        HandClass::Finger2 | HandClass::Cee12 => 2.0,
        HandClass::Finger23 | HandClass::Finger23Spread | HandClass::Pinch12Open => 3.0,
        HandClass::CeeAll | HandClass::Cee12Open => 3.5,
        HandClass::Flat => 4.0,
        HandClass::Finger2345 => 4.5,
    };
    class - joints(shape.form.bend).iter().sum::<f64>() / 12.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inventory::builtin_by_id;

    #[test]
    fn every_built_in_handshape_is_its_own_nearest_value() {
        let inventory = builtin_by_id("configurations").expect("built in");
        let shapes = Shapes::of(inventory);
        assert_eq!(shapes.0.len(), inventory.values.len());
        for (id, shape) in &shapes.0 {
            let mut lost = Lost::default();
            let own = shapes.0.iter().find(|(_, other)| other == shape);
            let found = shapes.nearest(shape, &mut lost).expect("there is one");
            assert_eq!(own.map(|(id, _)| Value::exact(*id)), Some(found), "{id}");
            assert!(lost.0.is_empty());
        }
    }
}
