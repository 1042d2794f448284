//! Handshapes as joint angles.
//!
//! Bends are in units from 0 to 4 at each of a finger's three joints, as in the tables of animation
//! engines; [`BodyLanguage`] defines the angle of 4. Recognition compares with the same angles. After
//! Kennaway, *Avatar-independent scripting for real-time gesture animation*, section 4.3.

use chereme_motion::{FingerAngles, HandAngles, HandFinger, ThumbAngles};

use super::hamnosys_language::BodyLanguage;
use super::tree::{
    CeeOpening, FingerBend, FingerContact, FingerPart, HandClass, HandDigit, Handshape, HandshapeForm, ThumbExtra,
    ThumbPosition,
};

/// The bends of three joints, in quarters of the largest bend.
type JointBendUnits = [f64; 3];

const STRAIGHT_FINGER_BENDS: JointBendUnits = [0.0, 0.1, 0.1];
const CLOSED_FINGER_BENDS: JointBendUnits = [3.86, 3.85, 3.82];
/// Bends of the open fingers next to a pinch or a cee.
const OPEN_FINGER_BENDS: JointBendUnits = [0.0, 0.25, 0.2];
/// The spread of fingers in degrees towards the thumb, as in the inventory's spread hand.
const FINGER_SPREAD_DEGREES: [f64; 4] = [14.0, 3.0, -9.0, -20.0];
/// The spread of two fingers apart.
const SPREAD_TWO: [f64; 4] = [12.0, -9.0, 0.0, 0.0];
/// The lean of the fingers of a flat hand from the hand's axis, in degrees towards the thumb: fingers taper.
const FLAT_LEAN_DEGREES: [f64; 4] = [-1.5, 0.0, 1.5, 3.0];
/// The lean of the fingers of a fist, in degrees towards the thumb: they point to the root of the thumb.
const FIST_LEAN_DEGREES: [f64; 4] = [-4.0, 0.0, 5.0, 11.0];

/// Returns the finger of a digit; `None` for the thumb.
#[must_use]
pub fn finger_of(digit: HandDigit) -> Option<HandFinger> {
    match digit {
        HandDigit::Thumb => None,
        HandDigit::Index => Some(HandFinger::Index),
        HandDigit::Middle => Some(HandFinger::Middle),
        HandDigit::Ring => Some(HandFinger::Ring),
        HandDigit::Little => Some(HandFinger::Little),
    }
}

/// The further bends of two crossed fingers, the one in front of the palm first: 15 degrees; -4, 26 and 20 degrees, as
/// measured in the movement of another animator.
const CROSSED_FINGER_BENDS: [JointBendUnits; 2] = [[0.68, 0.0, 0.0], [-0.18, 1.0, 1.1]];
/// The spread of two crossed fingers in degrees towards the thumb, from the same measurement.
const CROSSED_SPREAD: [f64; 2] = [-11.0, 8.0];

/// A hand before its units become angles; betweenness averages these values.
#[derive(Debug, Clone, Copy)]
struct HandBendShape {
    bends: [JointBendUnits; 4],
    /// Degrees towards the thumb with the fingers straight.
    spread: [f64; 4],
    /// Radial, palmar, opposition, and two flexions in degrees.
    thumb: [f64; 5],
}

/// Returns the joint angles of a handshape in radians, as [`HandAngles`] counts them.
///
/// Betweenness averages bends, spreads and the thumb before they become rotations. Values that depend on
/// the lengths of a hand's bones (the tip of the thumb on that of a finger) are those of the inventory's
/// hand; an animator may refine it.
#[must_use]
pub fn hand_angles(shape: &Handshape, language: &BodyLanguage) -> HandAngles {
    let mut hand = form_bend_shape(&shape.form, shape);
    if let Some(second) = &shape.between {
        hand = mean_bend_shape(&hand, &form_bend_shape(second, shape));
    }
    for (finger, bend) in hand.bends.iter_mut().zip(&shape.bends[1..]) {
        if let Some(bend) = bend {
            *finger = class_bend_units(*bend, shape.form.class);
        }
    }
    if let Some(splay) = shape.splay {
        let wide = match splay {
            0 => 0.0,
            // Splayed once is as wide as a spread hand, splayed twice wider.
            1 => language.splay,
            _ => language.splay * language.splay_more,
        };
        hand.spread = FINGER_SPREAD_DEGREES.map(|spread| spread * wide);
    } else {
        hand.spread = hand.spread.map(|spread| spread * language.splay);
    }
    for contact in &shape.contacts {
        cross_two_fingers(&mut hand, contact);
    }
    thumb_extra(&mut hand, shape);
    // In a fist all fingers are closed, so that its bend is that of the thumb.
    let fist_bend = shape.form.bend.filter(|_| shape.form.class == HandClass::Fist);
    if let Some(bend) = shape.bends[0].or(fist_bend) {
        let [_, middle, end] = bend_units(bend);
        // Bends are counted in quarters of a closed joint.
        hand.thumb[3] = middle / 4.0 * language.bend_thumb_middle;
        hand.thumb[4] = end / 4.0 * language.bend_thumb_end;
    }
    bend_shape_angles(&hand, language)
}

/// Returns the fingers that a form of a class selects: those that its bend applies to.
#[must_use]
pub fn selected_fingers(class: HandClass, special: &[HandDigit]) -> [bool; 4] {
    let class_fingers = match class {
        HandClass::Fist | HandClass::Flat | HandClass::Finger2345 | HandClass::PinchAll | HandClass::CeeAll => {
            [true; 4]
        }
        HandClass::Finger2 | HandClass::Pinch12 | HandClass::Pinch12Open | HandClass::Cee12 | HandClass::Cee12Open => {
            [true, false, false, false]
        }
        HandClass::Finger23 | HandClass::Finger23Spread => [true, true, false, false],
    };
    let fingers: Vec<HandFinger> = special.iter().copied().filter_map(finger_of).collect();
    if fingers.is_empty() || class_fingers == [true; 4] {
        return class_fingers;
    }
    HandFinger::ALL_FINGERS.map(|finger| fingers.contains(&finger))
}

/// Returns a bend in quarters of the largest one, from the palm outwards.
#[must_use]
pub fn bend_units(bend: FingerBend) -> [f64; 3] {
    match bend {
        FingerBend::Bent => [4.0, 0.0, 0.0],
        FingerBend::Round => [2.0, 2.0, 2.0],
        FingerBend::Hooked => [0.0, 4.0, 4.0],
        FingerBend::DoubleBent => [4.0, 4.0, 0.0],
        FingerBend::DoubleHooked => [4.0, 4.0, 4.0],
        FingerBend::HalfBent => [2.0, 0.0, 0.0],
        FingerBend::Joints(units) => units.map(|unit| unit.clamp(-1.0, 4.0)),
    }
}

/// Returns a bend in the form for a class: in pinches and cees the tips must still meet.
fn class_bend_units(bend: FingerBend, class: HandClass) -> JointBendUnits {
    let pinch = matches!(class, HandClass::Pinch12 | HandClass::Pinch12Open | HandClass::PinchAll);
    let cee = matches!(class, HandClass::Cee12 | HandClass::Cee12Open | HandClass::CeeAll);
    match bend {
        FingerBend::Bent if pinch => [3.4, 0.6, 0.4],
        FingerBend::Round if pinch => [2.3, 2.4, 2.2],
        FingerBend::Hooked if pinch => [3.0, 4.0, 3.0],
        FingerBend::DoubleBent if pinch => [4.0, 3.0, 2.0],
        FingerBend::DoubleHooked if pinch => [4.0, 3.0, 3.0],
        FingerBend::HalfBent if pinch => [3.0, 2.5, 2.5],
        FingerBend::Bent if cee => [3.0, 0.0, 0.0],
        FingerBend::HalfBent if cee => [1.0, 2.5, 2.5],
        FingerBend::Round if cee => [1.0, 3.0, 3.0],
        FingerBend::Hooked if cee => [2.0, 4.0, 4.0],
        FingerBend::DoubleBent if cee => [2.0, 3.0, 2.0],
        FingerBend::DoubleHooked if cee => [2.0, 3.0, 3.0],
        // Fingers bent at two joints meet the palm before the joints reach their limits.
        FingerBend::DoubleBent => [3.3, 3.75, 0.4],
        other => bend_units(other),
    }
}

fn form_bend_shape(form: &HandshapeForm, shape: &Handshape) -> HandBendShape {
    let class = form.class;
    let chosen = selected_fingers(class, &shape.special.0);
    let (own, rest, spread) = match class {
        HandClass::Fist => (CLOSED_FINGER_BENDS, CLOSED_FINGER_BENDS, [0.0; 4]),
        HandClass::Flat => (STRAIGHT_FINGER_BENDS, STRAIGHT_FINGER_BENDS, [0.0; 4]),
        HandClass::Finger2 | HandClass::Finger23 => (STRAIGHT_FINGER_BENDS, CLOSED_FINGER_BENDS, [0.0; 4]),
        HandClass::Finger23Spread => (STRAIGHT_FINGER_BENDS, CLOSED_FINGER_BENDS, two_apart(chosen)),
        HandClass::Finger2345 => (STRAIGHT_FINGER_BENDS, STRAIGHT_FINGER_BENDS, FINGER_SPREAD_DEGREES),
        HandClass::Pinch12 => ([2.4, 1.8, 1.2], CLOSED_FINGER_BENDS, [0.0; 4]),
        HandClass::Pinch12Open => ([2.4, 1.8, 1.2], OPEN_FINGER_BENDS, spread_beside_pinch(chosen)),
        HandClass::PinchAll => ([2.4, 1.8, 1.2], CLOSED_FINGER_BENDS, [0.0; 4]),
        HandClass::Cee12 => ([1.5, 1.8, 1.9], CLOSED_FINGER_BENDS, [0.0; 4]),
        HandClass::Cee12Open => ([1.5, 1.8, 1.9], OPEN_FINGER_BENDS, spread_beside_pinch(chosen)),
        HandClass::CeeAll => ([1.2, 1.8, 1.9], CLOSED_FINGER_BENDS, [0.0; 4]),
    };
    // Bends act on extended fingers: of a fist, on the thumb. A pinch or cee that is straight would not close.
    let extends = matches!(
        class,
        HandClass::Flat | HandClass::Finger2 | HandClass::Finger23 | HandClass::Finger23Spread | HandClass::Finger2345
    );
    let bends = |bend: &FingerBend| extends || (class != HandClass::Fist && bend_units(*bend) != [0.0; 3]);
    let bend = form.bend.filter(bends);
    let mut selected_bend = bend.map_or(own, |bend| class_bend_units(bend, class));
    match form.opening {
        Some(CeeOpening::Tight) => selected_bend[0] += 0.6,
        Some(CeeOpening::Slack) => selected_bend[0] -= 0.8,
        None => {}
    }
    let open = matches!(class, HandClass::Flat | HandClass::Finger2345 | HandClass::Fist);
    let bends = HandFinger::ALL_FINGERS.map(|finger| {
        let digit = HandDigit::ALL_HAND_DIGITS[finger.index() + 1];
        if shape.exempt.contains_digit(digit) {
            return if class == HandClass::Fist {
                STRAIGHT_FINGER_BENDS
            } else if open {
                own
            } else {
                OPEN_FINGER_BENDS
            };
        }
        if chosen[finger.index()] { selected_bend } else { rest }
    });
    HandBendShape {
        bends,
        spread,
        thumb: thumb_form_angles(form, shape, chosen),
    }
}

/// Spreads the first and last of the chosen fingers, and those between evenly.
fn two_apart(chosen: [bool; 4]) -> [f64; 4] {
    if chosen == [true, true, false, false] {
        return SPREAD_TWO;
    }
    let places: Vec<usize> = (0..4).filter(|&n| chosen[n]).collect();
    let mut spread = [0.0; 4];
    let last = places.len().saturating_sub(1).max(1) as f64;
    for (n, &place) in places.iter().enumerate() {
        spread[place] = 13.0 - 26.0 * n as f64 / last;
    }
    spread
}

/// Spreads the fingers next to a pinch.
fn spread_beside_pinch(chosen: [bool; 4]) -> [f64; 4] {
    std::array::from_fn(|n| if chosen[n] { 0.0 } else { FINGER_SPREAD_DEGREES[n] })
}

fn thumb_form_angles(form: &HandshapeForm, shape: &Handshape, chosen: [bool; 4]) -> [f64; 5] {
    use HandClass::{
        Cee12, Cee12Open, CeeAll, Finger2, Finger23, Finger23Spread, Finger2345, Fist, Flat, Pinch12, Pinch12Open,
        PinchAll,
    };
    let thumb_angles = match (form.class, form.thumb) {
        (Pinch12 | Pinch12Open, _) => match form.bend {
            None => [24.0, 58.0, 50.0, 22.0, 36.0],
            Some(FingerBend::Bent | FingerBend::HalfBent) => [14.0, 52.0, 42.0, 0.0, 26.0],
            Some(FingerBend::Hooked | FingerBend::DoubleHooked) => [36.0, 60.0, 45.0, 44.0, 69.0],
            Some(_) => [39.0, 62.0, 36.0, 36.0, 58.0],
        },
        (PinchAll, _) => match form.bend {
            None => [14.0, 52.0, 38.0, 14.0, 28.0],
            Some(FingerBend::Bent | FingerBend::HalfBent) => [1.0, 52.0, 58.0, 4.0, 7.0],
            Some(_) => [30.0, 62.0, 36.0, 36.0, 50.0],
        },
        (Cee12 | Cee12Open | CeeAll, _) => match form.opening {
            None => [32.0, 56.0, 62.0, 8.0, 18.0],
            Some(CeeOpening::Tight) => [28.0, 50.0, 62.0, 14.0, 26.0],
            Some(CeeOpening::Slack) => [38.0, 62.0, 62.0, 2.0, 6.0],
        },
        (Fist, Some(ThumbPosition::Out)) => [62.0, 5.0, 0.0, -5.0, -5.0],
        (Fist, Some(ThumbPosition::Across)) => [18.0, 40.0, -3.0, 49.0, 44.0],
        (Fist, Some(ThumbPosition::Opposed)) => [30.0, 62.0, 55.0, 5.0, 10.0],
        (Fist, None) => [15.0, 8.0, 0.0, 5.0, 10.0],
        (_, Some(ThumbPosition::Out)) => [60.0, 8.0, 0.0, 0.0, 0.0],
        (_, Some(ThumbPosition::Opposed)) => [35.0, 60.0, 60.0, 5.0, 8.0],
        (Flat | Finger2345, Some(ThumbPosition::Across)) if form.bend.is_none() => [8.0, 4.0, -5.0, 67.0, 74.0],
        (Flat | Finger2345, Some(ThumbPosition::Across)) => [15.0, 36.0, 20.0, 56.0, 70.0],
        (Finger2 | Finger23 | Finger23Spread, Some(ThumbPosition::Across)) => thumb_over_fingers(chosen),
        (Finger2 | Finger23 | Finger23Spread, None) if !chosen[0] => [15.0, 8.0, 0.0, 5.0, 10.0],
        (_, None) => [12.0, 2.0, 0.0, 0.0, 0.0],
    };
    opposed(thumb_angles, form.class, shape)
}

/// Returns the thumb across the folded fingers: on the middle finger, else on the first folded one.
fn thumb_over_fingers(chosen: [bool; 4]) -> [f64; 5] {
    match chosen {
        [_, false, ..] => [22.0, 44.0, 0.0, 57.0, 32.0],
        [false, true, ..] => [44.0, 44.0, -5.0, 57.0, 40.0],
        [true, true, false, _] => [3.0, 37.0, 3.0, 58.0, 28.0],
        [true, true, true, _] => [-16.0, 39.0, 23.0, 40.0, 26.0],
    }
}

/// Brings the thumb of a pinch or cee over to the digit it meets.
fn opposed(mut thumb: [f64; 5], class: HandClass, shape: &Handshape) -> [f64; 5] {
    let pinches = matches!(
        class,
        HandClass::Pinch12 | HandClass::Pinch12Open | HandClass::Cee12 | HandClass::Cee12Open
    );
    let met = shape.opposed.or_else(|| shape.special.0.first().copied());
    let over = match met.filter(|_| pinches).and_then(finger_of) {
        Some(HandFinger::Middle) => 1.0,
        Some(HandFinger::Ring) => 2.0,
        Some(HandFinger::Little) => 3.0,
        Some(HandFinger::Index) | None => 0.0,
    };
    thumb[0] -= 9.0 * over;
    thumb[2] += 7.0 * over;
    thumb[4] += 6.0 * over;
    thumb
}

fn mean_bend_shape(a: &HandBendShape, b: &HandBendShape) -> HandBendShape {
    let mean = |x: f64, y: f64| (x + y) / 2.0;
    HandBendShape {
        bends: std::array::from_fn(|f| std::array::from_fn(|j| mean(a.bends[f][j], b.bends[f][j]))),
        spread: std::array::from_fn(|f| mean(a.spread[f], b.spread[f])),
        thumb: std::array::from_fn(|n| mean(a.thumb[n], b.thumb[n])),
    }
}

/// Returns the fingers of a contact that cross, the one nearer to the thumb first; `None` if they only touch, at a base or
/// a side.
#[must_use]
pub fn crossed_fingers(contact: &FingerContact) -> Option<[HandFinger; 2]> {
    let (one, other) = (finger_of(contact.first)?, finger_of(contact.second)?);
    let touches = matches!(contact.part, Some(FingerPart::Base | FingerPart::Side));
    (!touches && one != other).then(|| match one.index() < other.index() {
        true => [one, other],
        false => [other, one],
    })
}

/// Crosses two fingers so that their tips change sides: the finger nearer to the thumb passes in front of the other, which
/// curls about it. Fingers that touch at a base or a side come together.
fn cross_two_fingers(hand: &mut HandBendShape, contact: &FingerContact) {
    let pair = [contact.first.min(contact.second), contact.first.max(contact.second)];
    let [Some(front), Some(back)] = pair.map(finger_of) else {
        return;
    };
    let (front, back) = (front.index(), back.index());
    if crossed_fingers(contact).is_none() {
        (hand.spread[front], hand.spread[back]) = (-1.0, 1.0);
        return;
    }
    (hand.spread[front], hand.spread[back]) = (CROSSED_SPREAD[0], CROSSED_SPREAD[1]);
    for (finger, by) in [front, back].into_iter().zip(CROSSED_FINGER_BENDS) {
        let bends = &mut hand.bends[finger];
        if *bends == CLOSED_FINGER_BENDS {
            *bends = STRAIGHT_FINGER_BENDS;
        }
        for (joint, by) in bends.iter_mut().zip(by) {
            *joint = (*joint + by).min(4.0);
        }
    }
}

fn thumb_extra(hand: &mut HandBendShape, shape: &Handshape) {
    match shape.thumb {
        Some(ThumbExtra::Between(a, b)) => {
            let over = f64::from(a.digit_number().min(b.digit_number())) - 2.0;
            hand.thumb = [14.0 - 5.0 * over, 34.0 + 5.0 * over, 30.0, 12.0, 16.0];
        }
        Some(ThumbExtra::Enclosed) => hand.thumb = [14.0, 50.0, 20.0, 50.0, 55.0],
        Some(ThumbExtra::Contact(_)) => hand.thumb = [21.0, 58.0, 14.0, 42.0, 55.0],
        None => {}
    }
}

fn bend_shape_angles(hand: &HandBendShape, language: &BodyLanguage) -> HandAngles {
    let [radial, palmar, opposition, middle, end] = hand.thumb.map(f64::to_radians);
    HandAngles {
        thumb: ThumbAngles {
            radial,
            palmar,
            opposition,
            flexion: [middle, end],
        },
        fingers: std::array::from_fn(|n| finger_angles(n, hand.bends[n], hand.spread[n], language)),
    }
}

/// Returns a finger's angles by the base joint's formula: with b the bend, s the spread, b' = 2b/π
/// and rotations of the palm's plane σ and across the hand β,
/// `(σ, s(1 - b')) · (β, b) · (σ, flat(1 - b') + fist·b')`.
///
/// The formula's last factor, a twist of some degrees about the finger, is left to the skeleton: the
/// angles here have none. Bend limits spread; both are defined by the direction of the finger's first
/// bone.
fn finger_angles(finger: usize, units: JointBendUnits, spread: f64, language: &BodyLanguage) -> FingerAngles {
    let most = [language.bend_base, language.bend_middle, language.bend_end];
    let bend = |joint: usize| (units[joint] / 4.0 * most[joint]).to_radians();
    let base = bend(0);
    let share = (base / std::f64::consts::FRAC_PI_2).clamp(0.0, 1.0);
    let lean = (FLAT_LEAN_DEGREES[finger] * (1.0 - share) + FIST_LEAN_DEGREES[finger] * share).to_radians();
    let spread = spread.to_radians() * (1.0 - share);
    // Along, towards the thumb, out of the palm.
    let leant = [lean.cos(), lean.sin(), 0.0];
    let bent = [leant[0] * base.cos(), leant[1], leant[0] * base.sin()];
    let along = bent[0] * spread.cos() - bent[1] * spread.sin();
    let radial = bent[0] * spread.sin() + bent[1] * spread.cos();
    FingerAngles {
        spread: radial.clamp(-1.0, 1.0).asin(),
        flexion: [bent[2].atan2(along), bend(1), bend(2)],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hamnosys::tree::DigitList;

    fn of(class: HandClass, change: impl FnOnce(&mut Handshape)) -> HandAngles {
        let mut shape = Handshape::default();
        shape.form.class = class;
        change(&mut shape);
        hand_angles(&shape, BodyLanguage::default_body_language())
    }

    #[test]
    fn classes_and_bends_are_near_the_inventory() {
        let inventory = crate::inventory::builtin_by_id("configurations").expect("built in");
        let pose = |id: &str| inventory.value_by_id(id).and_then(|value| value.pose).expect("a pose");
        let across = |shape: &mut Handshape| shape.form.thumb = Some(ThumbPosition::Across);
        let bend = |bend| move |shape: &mut Handshape| shape.form.bend = Some(bend);
        let cases = [
            ("A", of(HandClass::Fist, |_| {})),
            ("S", of(HandClass::Fist, across)),
            ("flat", of(HandClass::Flat, |_| {})),
            ("B", of(HandClass::Flat, across)),
            ("B-bent", of(HandClass::Flat, bend(FingerBend::Bent))),
            ("B-round", of(HandClass::Flat, bend(FingerBend::Round))),
            ("1", of(HandClass::Finger2, across)),
            (
                "X",
                of(HandClass::Finger2, |shape| {
                    across(shape);
                    shape.form.bend = Some(FingerBend::Hooked);
                }),
            ),
            ("U", of(HandClass::Finger23, across)),
            ("V", of(HandClass::Finger23Spread, across)),
            ("4", of(HandClass::Finger2345, across)),
            ("F", of(HandClass::Pinch12Open, |_| {})),
            ("F-round", of(HandClass::Pinch12Open, bend(FingerBend::Round))),
            ("pinch-bent", of(HandClass::Pinch12, bend(FingerBend::Bent))),
            ("beak", of(HandClass::PinchAll, |_| {})),
            ("C-small", of(HandClass::Cee12, |_| {})),
            ("C", of(HandClass::CeeAll, |_| {})),
            (
                "I",
                of(HandClass::Finger2, |shape| {
                    across(shape);
                    shape.special = DigitList(vec![HandDigit::Little]);
                }),
            ),
        ];
        for (id, hand) in cases {
            let own = pose(id).to_array();
            let hand = hand.to_array();
            let apart = hand.iter().zip(own).map(|(a, b)| (a - b).abs());
            let far = apart.fold(0.0, f64::max).to_degrees();
            assert!(far < 12.5, "{id}: {far:.1}°");
        }
    }

    #[test]
    fn base_joints_follow_the_formula_at_both_ends() {
        let language = BodyLanguage::default_body_language();
        let flat = finger_angles(3, [0.0; 3], -20.0, language);
        assert!((flat.spread.to_degrees() - (FLAT_LEAN_DEGREES[3] - 20.0)).abs() < 1e-9);
        assert!(flat.flexion[0].abs() < 1e-9);
        let mut full = language.clone();
        full.bend_base = 90.0;
        let (wide, none) = (
            finger_angles(3, [4.0; 3], -20.0, &full),
            finger_angles(3, [4.0; 3], 0.0, &full),
        );
        assert!(
            (wide.spread - none.spread).abs() < 1e-9,
            "full bend takes the spread away"
        );
        assert!((wide.spread.to_degrees() - FIST_LEAN_DEGREES[3]).abs() < 1e-9);
        assert!((wide.flexion[0].to_degrees() - 90.0).abs() < 1e-9);
    }

    #[test]
    fn an_in_between_form_is_the_mean_and_single_digits_take_precedence() {
        let between = of(HandClass::Flat, |shape| {
            shape.between = Some(HandshapeForm {
                bend: Some(FingerBend::Bent),
                ..shape.form
            });
        });
        let [base, ..] = between.fingers[1].flexion;
        assert!((base.to_degrees() - 44.0).abs() < 1.0, "{}", base.to_degrees());
        let single = of(HandClass::Flat, |shape| shape.bends[2] = Some(FingerBend::Bent));
        assert!(single.fingers[1].flexion[0] > 1.4 && single.fingers[0].flexion[0].abs() < 0.1);
        let crossed = of(HandClass::Finger23, |shape| {
            shape.contacts = vec![FingerContact {
                first: HandDigit::Middle,
                second: HandDigit::Index,
                part: None,
            }];
        });
        assert!(crossed.fingers[1].spread > 0.1 && crossed.fingers[0].spread < -0.1);
    }
}
