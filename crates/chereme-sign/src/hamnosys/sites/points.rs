//! Points of hands: those that notation names, their positions relative to the bones, and the one that reaches a place
//! first.

use chereme_motion::{Finger, Part, Side as Half};

use super::{Region, said};
use crate::hamnosys::tree::{
    Digit, FingerPart, HandClass, HandLocation, HandSite, Handshape, Side, ThumbPosition,
};

/// A point of a hand or of its arm.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum HandPoint {
    /// The middle of the palm.
    Palm,
    /// The middle of the back of the hand.
    Back,
    /// The edge on the thumb's side.
    Radial,
    /// The edge on the little finger's side.
    Ulnar,
    /// The ball of the thumb.
    ThumbBall,
    /// The wrist: at its palmar side, at its back, or in its middle.
    Wrist(Face),
    /// The end of a digit: its tip, its pad, or its nail.
    Tip(Digit, Face),
    /// The middle joint of a digit.
    Middle(Digit, Face),
    /// The base of a digit.
    Base(Digit, Face),
    /// The elbow.
    Elbow,
    /// The middle of the forearm.
    Forearm,
    /// The middle of the upper arm.
    UpperArm,
}

/// The face of a digit or wrist.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Face {
    /// No specific face: the middle, or the very tip.
    Middle,
    /// The palm's face.
    Palmar,
    /// The back's face.
    Dorsal,
    /// The face towards the thumb.
    Radial,
    /// The face towards the little finger.
    Ulnar,
}

/// Returns the points that a site of a hand names: one for each digit, all together.
///
/// `of` is the hand; left and right are the sides of a hand whose palm faces down.
#[must_use]
pub fn hand_points(site: &HandSite, of: Half, mirrored: bool) -> Vec<HandPoint> {
    let face = face(site.side, of, mirrored);
    let each = |point: &dyn Fn(Digit) -> HandPoint, usual: Digit| -> Vec<HandPoint> {
        if site.digits.is_empty() {
            vec![point(usual)]
        } else {
            site.digits.0.iter().map(|&digit| point(digit)).collect()
        }
    };
    let Some(at) = site.at else {
        return each(&|digit| HandPoint::Middle(digit, face), Digit::Index);
    };
    match at {
        HandLocation::Palm => vec![HandPoint::Palm],
        HandLocation::HandBack => vec![HandPoint::Back],
        HandLocation::ThumbSide => vec![HandPoint::Radial],
        HandLocation::PinkySide => vec![HandPoint::Ulnar],
        HandLocation::ThumbBall => vec![HandPoint::ThumbBall],
        HandLocation::WristBack => vec![HandPoint::Wrist(match face {
            Face::Middle => Face::Dorsal,
            face => face,
        })],
        HandLocation::Elbow | HandLocation::ElbowInside => vec![HandPoint::Elbow],
        HandLocation::LowerArm => vec![HandPoint::Forearm],
        HandLocation::UpperArm => vec![HandPoint::UpperArm],
        HandLocation::Tip => each(&|digit| HandPoint::Tip(digit, face), Digit::Middle),
        HandLocation::Pad => each(&|digit| HandPoint::Tip(digit, Face::Palmar), Digit::Middle),
        HandLocation::Nail => {
            let face = if face == Face::Middle {
                Face::Dorsal
            } else {
                face
            };
            each(&|digit| HandPoint::Tip(digit, face), Digit::Middle)
        }
        HandLocation::MidJoint => each(&|digit| HandPoint::Middle(digit, face), Digit::Middle),
        HandLocation::Base => each(&|digit| HandPoint::Base(digit, face), Digit::Middle),
        HandLocation::Side => {
            let face = if face == Face::Middle {
                Face::Radial
            } else {
                face
            };
            each(&|digit| HandPoint::Middle(digit, face), Digit::Index)
        }
    }
}

/// Returns the part of a finger that a contact of fingers names.
#[must_use]
pub fn finger_point(digit: Digit, part: FingerPart) -> HandPoint {
    match part {
        FingerPart::Tip => HandPoint::Tip(digit, Face::Middle),
        FingerPart::Nail => HandPoint::Tip(digit, Face::Dorsal),
        FingerPart::Pad => HandPoint::Tip(digit, Face::Palmar),
        FingerPart::MidJoint => HandPoint::Middle(digit, Face::Middle),
        FingerPart::Base => HandPoint::Base(digit, Face::Middle),
        FingerPart::Side => HandPoint::Middle(digit, Face::Radial),
    }
}

fn face(side: Option<Side>, of: Half, mirrored: bool) -> Face {
    match side {
        None => Face::Middle,
        Some(Side::Palmar | Side::Front) => Face::Palmar,
        Some(Side::Dorsal | Side::Back) => Face::Dorsal,
        Some(Side::Radial) => Face::Radial,
        Some(Side::Ulnar) => Face::Ulnar,
        Some(side) => match said(Some(side), mirrored) {
            // The thumb of a right hand, palm down, is at its left.
            Some(half) if half == of => Face::Ulnar,
            _ => Face::Radial,
        },
    }
}

/// Returns the offsets of a point of a digit or the wrist from its bone: out of it towards the named face,
/// and back along it, in lengths of the hand from wrist to middle fingertip. Other points, and those
/// without a named face, are on the bone.
#[must_use]
pub fn from_bone(point: HandPoint) -> [f64; 2] {
    match point {
        HandPoint::Tip(_, Face::Middle)
        | HandPoint::Middle(_, Face::Middle)
        | HandPoint::Base(_, Face::Middle)
        | HandPoint::Wrist(Face::Middle) => [0.0; 2],
        // A pad or nail is a little before the very end.
        HandPoint::Tip(..) => [0.042, 0.03],
        HandPoint::Middle(..) => [0.042, 0.0],
        HandPoint::Base(..) => [0.06, 0.0],
        HandPoint::Wrist(_) => [0.14, 0.0],
        _ => [0.0; 2],
    }
}

/// Returns the position of a point of the palm, the back or an edge of the hand: its distance along the
/// line from wrist to middle knuckle, as a share of that; out of the palm, and towards the thumb, in
/// lengths of the hand. Other points are at the wrist.
#[must_use]
pub fn on_palm(point: HandPoint) -> [f64; 3] {
    match point {
        HandPoint::Palm => [0.55, 0.08, 0.0],
        HandPoint::Back => [0.55, -0.08, 0.0],
        HandPoint::Radial => [0.55, 0.0, 0.22],
        HandPoint::Ulnar => [0.55, 0.0, -0.22],
        HandPoint::ThumbBall => [0.3, 0.112, 0.132],
        _ => [0.0; 3],
    }
}

/// Returns the joint of a digit that notation calls its base (1), its middle joint (2), or the joint
/// before its tip (3); the thumb's base is the knuckle and its middle the joint after that.
#[must_use]
pub fn digit_joint(side: Half, digit: Digit, which: u8) -> Part {
    match digit {
        Digit::Thumb => Part::Thumb(side, which.min(2)),
        Digit::Index => Part::Finger(side, Finger::Index, which),
        Digit::Middle => Part::Finger(side, Finger::Middle, which),
        Digit::Ring => Part::Finger(side, Finger::Ring, which),
        Digit::Little => Part::Finger(side, Finger::Little, which),
    }
}

/// Returns the point of a hand that notation refers to if it names none: the first one to arrive when the
/// hand moves to a place of this kind (Kennaway, section 4.1).
///
/// `direction` is a unit vector in the hand's own axes: along it, out of its palm, towards its thumb.
#[must_use]
pub fn coming_first(
    shape: &Handshape,
    [along, palm, radial]: [f64; 3],
    region: Region,
) -> HandPoint {
    let digit = leading(shape);
    let small = region != Region::Trunk;
    let thumb = shape.form.class == HandClass::Fist && shape.form.thumb == Some(ThumbPosition::Out);
    let pinch = is_pinch(shape.form.class);
    let candidates = [
        (
            along + 0.15,
            match digit {
                Some(digit) => HandPoint::Tip(digit, Face::Middle),
                None => HandPoint::Middle(Digit::Middle, Face::Dorsal),
            },
        ),
        (
            palm + 0.05,
            match (digit, pinch || small) {
                (Some(digit), true) => HandPoint::Tip(digit, Face::Palmar),
                (None, _) => HandPoint::Middle(Digit::Middle, Face::Dorsal),
                _ => HandPoint::Palm,
            },
        ),
        (
            -palm,
            match (digit, small) {
                (Some(digit), true) => HandPoint::Middle(digit, Face::Dorsal),
                _ => HandPoint::Back,
            },
        ),
        (
            radial,
            match (thumb, digit, small) {
                (true, ..) => HandPoint::Tip(Digit::Thumb, Face::Middle),
                (false, Some(Digit::Index | Digit::Middle), true) => {
                    HandPoint::Middle(Digit::Index, Face::Radial)
                }
                _ => HandPoint::Radial,
            },
        ),
        (-radial, HandPoint::Ulnar),
        (-along - 0.2, HandPoint::Wrist(Face::Palmar)),
    ];
    let best = candidates.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
    best.map_or(HandPoint::Palm, |(_, point)| point)
}

/// Returns the digit that a handshape points or touches with; `None` for a closed fist.
fn leading(shape: &Handshape) -> Option<Digit> {
    use HandClass::{
        Cee12, Cee12Open, Finger2, Finger23, Finger23Spread, Fist, Pinch12, Pinch12Open,
    };
    let first = shape
        .special
        .0
        .iter()
        .copied()
        .find(|&digit| digit != Digit::Thumb);
    match shape.form.class {
        Fist => shape.exempt.0.first().copied(),
        Finger2 | Pinch12 | Pinch12Open | Cee12 | Cee12Open => Some(first.unwrap_or(Digit::Index)),
        Finger23 | Finger23Spread => Some(first.unwrap_or(Digit::Index)),
        _ => Some(Digit::Middle),
    }
}

fn is_pinch(class: HandClass) -> bool {
    matches!(
        class,
        HandClass::Pinch12
            | HandClass::Pinch12Open
            | HandClass::PinchAll
            | HandClass::Cee12
            | HandClass::Cee12Open
            | HandClass::CeeAll
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hamnosys::tree::Form;

    #[test]
    fn sites_of_hands_name_points() {
        let site = HandSite {
            at: Some(HandLocation::Tip),
            digits: crate::hamnosys::Digits(vec![Digit::Index, Digit::Middle]),
            ..HandSite::default()
        };
        let points = hand_points(&site, Half::Right, false);
        assert_eq!(
            points,
            [Digit::Index, Digit::Middle].map(|digit| HandPoint::Tip(digit, Face::Middle))
        );
        let beside = HandSite {
            at: Some(HandLocation::MidJoint),
            side: Some(Side::RightBeside),
            ..HandSite::default()
        };
        let of = |half, mirrored| hand_points(&beside, half, mirrored)[0];
        assert_eq!(
            of(Half::Right, false),
            HandPoint::Middle(Digit::Middle, Face::Ulnar)
        );
        assert_eq!(
            of(Half::Left, true),
            HandPoint::Middle(Digit::Middle, Face::Ulnar)
        );
    }

    #[test]
    fn the_foremost_point_is_the_one_that_faces_the_direction() {
        let flat = Handshape {
            form: Form {
                class: HandClass::Flat,
                ..Form::default()
            },
            ..Handshape::default()
        };
        let first = |direction, region| coming_first(&flat, direction, region);
        assert_eq!(
            first([1.0, 0.0, 0.0], Region::Trunk),
            HandPoint::Tip(Digit::Middle, Face::Middle)
        );
        assert_eq!(first([0.0, 1.0, 0.0], Region::Trunk), HandPoint::Palm);
        assert_eq!(
            first([0.0, 1.0, 0.0], Region::Face),
            HandPoint::Tip(Digit::Middle, Face::Palmar)
        );
        assert_eq!(first([0.0, 0.0, -1.0], Region::Face), HandPoint::Ulnar);
    }

    #[test]
    fn only_surface_points_have_a_distance_from_the_bone() {
        for digit in Digit::ALL {
            assert_eq!(from_bone(HandPoint::Tip(digit, Face::Middle)), [0.0; 2]);
            assert!(from_bone(HandPoint::Tip(digit, Face::Palmar))[1] > 0.0);
            assert!(from_bone(HandPoint::Base(digit, Face::Dorsal))[0] > 0.0);
        }
        assert_eq!(
            digit_joint(Half::Left, Digit::Thumb, 3),
            digit_joint(Half::Left, Digit::Thumb, 2)
        );
    }
}
