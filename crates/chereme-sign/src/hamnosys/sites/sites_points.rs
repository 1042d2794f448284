//! Points of hands: those that notation names, their positions relative to the bones, and the one that reaches a place
//! first.

use chereme_motion::{BodyPart, BodySide as Half, HandFinger};

use super::{BodyRegion, half_of_side};
use crate::hamnosys::tree::{HandClass, HandDigit, HandLocation, HandSite, Handshape, LocationSide, ThumbPosition};

/// A point of a hand or of its arm.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum NotatedHandPoint {
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
    Wrist(DigitFace),
    /// The end of a digit: its tip, its pad, or its nail.
    Tip(HandDigit, DigitFace),
    /// The middle joint of a digit.
    Middle(HandDigit, DigitFace),
    /// The base of a digit.
    Base(HandDigit, DigitFace),
    /// The elbow.
    Elbow,
    /// The middle of the forearm.
    Forearm,
    /// The middle of the upper arm.
    UpperArm,
}

/// The face of a digit or wrist.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum DigitFace {
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
pub fn hand_points(site: &HandSite, of: Half, mirrored: bool) -> Vec<NotatedHandPoint> {
    let face = digit_face_of_side(site.side, of, mirrored);
    let each = |point: &dyn Fn(HandDigit) -> NotatedHandPoint, usual: HandDigit| -> Vec<NotatedHandPoint> {
        if site.digits.is_empty() {
            vec![point(usual)]
        } else {
            site.digits.0.iter().map(|&digit| point(digit)).collect()
        }
    };
    let Some(at) = site.at else {
        return each(&|digit| NotatedHandPoint::Middle(digit, face), HandDigit::Index);
    };
    match at {
        HandLocation::Palm => vec![NotatedHandPoint::Palm],
        HandLocation::HandBack => vec![NotatedHandPoint::Back],
        HandLocation::ThumbSide => vec![NotatedHandPoint::Radial],
        HandLocation::PinkySide => vec![NotatedHandPoint::Ulnar],
        HandLocation::ThumbBall => vec![NotatedHandPoint::ThumbBall],
        HandLocation::WristBack => vec![NotatedHandPoint::Wrist(match face {
            DigitFace::Middle => DigitFace::Dorsal,
            face => face,
        })],
        HandLocation::Elbow | HandLocation::ElbowInside => vec![NotatedHandPoint::Elbow],
        HandLocation::LowerArm => vec![NotatedHandPoint::Forearm],
        HandLocation::UpperArm => vec![NotatedHandPoint::UpperArm],
        HandLocation::Tip => each(&|digit| NotatedHandPoint::Tip(digit, face), HandDigit::Middle),
        HandLocation::Pad => each(
            &|digit| NotatedHandPoint::Tip(digit, DigitFace::Palmar),
            HandDigit::Middle,
        ),
        HandLocation::Nail => {
            let face = if face == DigitFace::Middle {
                DigitFace::Dorsal
            } else {
                face
            };
            each(&|digit| NotatedHandPoint::Tip(digit, face), HandDigit::Middle)
        }
        HandLocation::MidJoint => each(&|digit| NotatedHandPoint::Middle(digit, face), HandDigit::Middle),
        HandLocation::Base => each(&|digit| NotatedHandPoint::Base(digit, face), HandDigit::Middle),
        HandLocation::Side => {
            let face = if face == DigitFace::Middle {
                DigitFace::Radial
            } else {
                face
            };
            each(&|digit| NotatedHandPoint::Middle(digit, face), HandDigit::Index)
        }
    }
}

fn digit_face_of_side(side: Option<LocationSide>, of: Half, mirrored: bool) -> DigitFace {
    match side {
        None => DigitFace::Middle,
        Some(LocationSide::Palmar | LocationSide::Front) => DigitFace::Palmar,
        Some(LocationSide::Dorsal | LocationSide::Back) => DigitFace::Dorsal,
        Some(LocationSide::Radial) => DigitFace::Radial,
        Some(LocationSide::Ulnar) => DigitFace::Ulnar,
        Some(side) => match half_of_side(Some(side), mirrored) {
            // The thumb of a right hand, palm down, is at its left.
            Some(half) if half == of => DigitFace::Ulnar,
            _ => DigitFace::Radial,
        },
    }
}

/// Returns the offsets of a point of a digit or the wrist from its bone: out of it towards the named face,
/// and back along it, in lengths of the hand from wrist to middle fingertip. Other points, and those
/// without a named face, are on the bone.
#[must_use]
pub fn from_bone(point: NotatedHandPoint) -> [f64; 2] {
    match point {
        NotatedHandPoint::Tip(_, DigitFace::Middle)
        | NotatedHandPoint::Middle(_, DigitFace::Middle)
        | NotatedHandPoint::Base(_, DigitFace::Middle)
        | NotatedHandPoint::Wrist(DigitFace::Middle) => [0.0; 2],
        // A pad or nail is a little before the very end.
        NotatedHandPoint::Tip(..) => [0.042, 0.03],
        NotatedHandPoint::Middle(..) => [0.042, 0.0],
        NotatedHandPoint::Base(..) => [0.06, 0.0],
        NotatedHandPoint::Wrist(_) => [0.14, 0.0],
        _ => [0.0; 2],
    }
}

/// Returns the position of a point of the palm, the back or an edge of the hand: its distance along the
/// line from wrist to middle knuckle, as a share of that; out of the palm, and towards the thumb, in
/// lengths of the hand. Other points are at the wrist.
#[must_use]
pub fn on_palm(point: NotatedHandPoint) -> [f64; 3] {
    match point {
        NotatedHandPoint::Palm => [0.55, 0.08, 0.0],
        NotatedHandPoint::Back => [0.55, -0.08, 0.0],
        NotatedHandPoint::Radial => [0.55, 0.0, 0.22],
        NotatedHandPoint::Ulnar => [0.55, 0.0, -0.22],
        NotatedHandPoint::ThumbBall => [0.3, 0.112, 0.132],
        _ => [0.0; 3],
    }
}

/// Returns the joint of a digit that notation calls its base (1), its middle joint (2), or the joint
/// before its tip (3); the thumb's base is the knuckle and its middle the joint after that.
#[must_use]
pub fn digit_joint(side: Half, digit: HandDigit, which: u8) -> BodyPart {
    match digit {
        HandDigit::Thumb => BodyPart::Thumb(side, which.min(2)),
        HandDigit::Index => BodyPart::Finger(side, HandFinger::Index, which),
        HandDigit::Middle => BodyPart::Finger(side, HandFinger::Middle, which),
        HandDigit::Ring => BodyPart::Finger(side, HandFinger::Ring, which),
        HandDigit::Little => BodyPart::Finger(side, HandFinger::Little, which),
    }
}

/// Returns the point of a hand that notation refers to if it names none: the first one to arrive when the
/// hand moves to a place of this kind (Kennaway, section 4.1).
///
/// `direction` is a unit vector in the hand's own axes: along it, out of its palm, towards its thumb.
#[must_use]
pub fn coming_first(shape: &Handshape, [along, palm, radial]: [f64; 3], region: BodyRegion) -> NotatedHandPoint {
    let digit = leading_digit(shape);
    // At small places a pointing finger is brought, of other hands their middle.
    let small = region != BodyRegion::Trunk && points_with_digit(shape);
    let thumb = shape.form.class == HandClass::Fist && shape.form.thumb == Some(ThumbPosition::Out);
    let pinch = is_pinch(shape.form.class);
    let candidates = [
        (
            along + 0.15,
            match digit {
                Some(digit) => NotatedHandPoint::Tip(digit, DigitFace::Middle),
                None => NotatedHandPoint::Middle(HandDigit::Middle, DigitFace::Dorsal),
            },
        ),
        (
            palm + 0.05,
            match (digit, pinch || small) {
                (Some(digit), true) => NotatedHandPoint::Tip(digit, DigitFace::Palmar),
                (None, _) => NotatedHandPoint::Middle(HandDigit::Middle, DigitFace::Dorsal),
                _ => NotatedHandPoint::Palm,
            },
        ),
        (
            -palm,
            match (digit, small) {
                (Some(digit), true) => NotatedHandPoint::Middle(digit, DigitFace::Dorsal),
                _ => NotatedHandPoint::Back,
            },
        ),
        (
            radial,
            match (thumb, digit, small) {
                (true, ..) => NotatedHandPoint::Tip(HandDigit::Thumb, DigitFace::Middle),
                (false, Some(HandDigit::Index | HandDigit::Middle), true) => {
                    NotatedHandPoint::Middle(HandDigit::Index, DigitFace::Radial)
                }
                _ => NotatedHandPoint::Radial,
            },
        ),
        (-radial, NotatedHandPoint::Ulnar),
        (-along - 0.2, NotatedHandPoint::Wrist(DigitFace::Palmar)),
    ];
    let best = candidates.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
    best.map_or(NotatedHandPoint::Palm, |(_, point)| point)
}

/// Returns whether a hand points or touches with single digits: by its class, or because digits are named.
fn points_with_digit(shape: &Handshape) -> bool {
    use HandClass::{Cee12, Cee12Open, Finger2, Finger23, Finger23Spread, Fist, Pinch12, Pinch12Open};
    let named = !shape.special.0.is_empty() || (shape.form.class == Fist && !shape.exempt.0.is_empty());
    named
        || matches!(
            shape.form.class,
            Finger2 | Finger23 | Finger23Spread | Pinch12 | Pinch12Open | Cee12 | Cee12Open
        )
}

/// Returns the digit that a handshape points or touches with; `None` for a closed fist.
fn leading_digit(shape: &Handshape) -> Option<HandDigit> {
    use HandClass::{Cee12, Cee12Open, Finger2, Finger23, Finger23Spread, Fist, Pinch12, Pinch12Open};
    let first = shape.special.0.iter().copied().find(|&digit| digit != HandDigit::Thumb);
    match shape.form.class {
        Fist => shape.exempt.0.first().copied(),
        Finger2 | Pinch12 | Pinch12Open | Cee12 | Cee12Open => Some(first.unwrap_or(HandDigit::Index)),
        Finger23 | Finger23Spread => Some(first.unwrap_or(HandDigit::Index)),
        _ => Some(HandDigit::Middle),
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
    use crate::hamnosys::tree::HandshapeForm;

    #[test]
    fn sites_of_hands_name_points() {
        let site = HandSite {
            at: Some(HandLocation::Tip),
            digits: crate::hamnosys::DigitList(vec![HandDigit::Index, HandDigit::Middle]),
            ..HandSite::default()
        };
        let points = hand_points(&site, Half::Right, false);
        assert_eq!(
            points,
            [HandDigit::Index, HandDigit::Middle].map(|digit| NotatedHandPoint::Tip(digit, DigitFace::Middle))
        );
        let beside = HandSite {
            at: Some(HandLocation::MidJoint),
            side: Some(LocationSide::RightBeside),
            ..HandSite::default()
        };
        let of = |half, mirrored| hand_points(&beside, half, mirrored)[0];
        assert_eq!(
            of(Half::Right, false),
            NotatedHandPoint::Middle(HandDigit::Middle, DigitFace::Ulnar)
        );
        assert_eq!(
            of(Half::Left, true),
            NotatedHandPoint::Middle(HandDigit::Middle, DigitFace::Ulnar)
        );
    }

    #[test]
    fn the_foremost_point_is_the_one_that_faces_the_direction() {
        let flat = Handshape {
            form: HandshapeForm {
                class: HandClass::Flat,
                ..HandshapeForm::default()
            },
            ..Handshape::default()
        };
        let first = |direction, region| coming_first(&flat, direction, region);
        assert_eq!(
            first([1.0, 0.0, 0.0], BodyRegion::Trunk),
            NotatedHandPoint::Tip(HandDigit::Middle, DigitFace::Middle)
        );
        assert_eq!(first([0.0, 1.0, 0.0], BodyRegion::Trunk), NotatedHandPoint::Palm);
        assert_eq!(
            first([0.0, 1.0, 0.0], BodyRegion::Face),
            NotatedHandPoint::Palm,
            "the middle of a flat hand"
        );
        let mut pointing = flat.clone();
        pointing.form.class = HandClass::Finger2;
        assert_eq!(
            coming_first(&pointing, [0.0, 1.0, 0.0], BodyRegion::Face),
            NotatedHandPoint::Tip(HandDigit::Index, DigitFace::Palmar)
        );
        assert_eq!(first([0.0, 0.0, -1.0], BodyRegion::Face), NotatedHandPoint::Ulnar);
    }

    #[test]
    fn only_surface_points_have_a_distance_from_the_bone() {
        for digit in HandDigit::ALL_HAND_DIGITS {
            assert_eq!(from_bone(NotatedHandPoint::Tip(digit, DigitFace::Middle)), [0.0; 2]);
            assert!(from_bone(NotatedHandPoint::Tip(digit, DigitFace::Palmar))[1] > 0.0);
            assert!(from_bone(NotatedHandPoint::Base(digit, DigitFace::Dorsal))[0] > 0.0);
        }
        assert_eq!(
            digit_joint(Half::Left, HandDigit::Thumb, 3),
            digit_joint(Half::Left, HandDigit::Thumb, 2)
        );
    }
}
