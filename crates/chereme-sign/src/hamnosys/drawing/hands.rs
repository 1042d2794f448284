//! Draws hands, the marks of their shapes, and their parts. A right hand is seen from its back: the thumb
//! is at the left.

use super::super::angles::bend_units;
use super::super::symbol::Kind;
use super::super::tree::{Digit, FingerPart, HandClass, HandLocation, Side, ThumbPosition};
use super::{Drawing, Point, arc, oval};

/// The width of a hand's box.
const HAND: f32 = 0.72;
/// Positions of the four fingers: at the palm, at the tips together, and at the tips spread.
const FINGERS: [[Point; 3]; 4] = [
    [[0.22, 0.5], [0.22, 0.06], [0.1, 0.12]],
    [[0.34, 0.46], [0.34, 0.02], [0.29, 0.02]],
    [[0.46, 0.46], [0.46, 0.04], [0.48, 0.02]],
    [[0.57, 0.52], [0.57, 0.14], [0.66, 0.12]],
];
/// The thumb, from the palm to its tip.
const THUMB: [Point; 3] = [[0.18, 0.86], [0.06, 0.68], [0.03, 0.5]];

fn palm() -> Vec<Point> {
    let corner = |x: f32, y: f32, from: f32| arc([x, y], [0.1, 0.1], from, from + 0.25);
    let corners = [
        (0.26, 0.56, 0.5),
        (0.53, 0.56, 0.75),
        (0.5, 0.86, 0.0),
        (0.29, 0.86, 0.25),
    ];
    let mut points: Vec<Point> = corners
        .into_iter()
        .flat_map(|(x, y, from)| corner(x, y, from))
        .collect();
    points.push(points[0]);
    points
}

fn finger(number: usize, spread: bool) -> [Point; 2] {
    let [base, together, apart] = FINGERS[number];
    [base, if spread { apart } else { together }]
}

/// Draws a class of handshapes or a mark of one.
pub(super) fn shape(kind: Kind) -> Drawing {
    match kind {
        Kind::Base(class) => base(class),
        Kind::Thumb(position) => thumb(position),
        Kind::Bend(bend) => bent(bend_units(bend)),
        _ => Drawing::default(),
    }
}

fn base(class: HandClass) -> Drawing {
    let hand = Drawing::new(HAND);
    let with = |fingers: &[usize], spread: bool| {
        let hand = Drawing::new(HAND).line(palm());
        fingers
            .iter()
            .fold(hand, |hand, number| hand.line(finger(*number, spread)))
    };
    // Thumb and index finger meet, or nearly so, at the left of the others.
    let ring = |hand: Drawing, open: bool| {
        let (from, to) = if open { (0.62, 1.38) } else { (0.5, 1.5) };
        hand.line(arc([0.17, 0.38], [0.13, 0.16], from + 0.02, to))
    };
    match class {
        HandClass::Fist => hand
            .line(oval([0.38, 0.6], [0.28, 0.3]))
            .line([[0.27, 0.38], [0.27, 0.58]])
            .line([[0.38, 0.34], [0.38, 0.58]])
            .line([[0.49, 0.38], [0.49, 0.58]]),
        HandClass::Flat => hand.line([
            [0.2, 0.96],
            [0.2, 0.16],
            [0.29, 0.04],
            [0.47, 0.04],
            [0.56, 0.16],
            [0.56, 0.96],
            [0.2, 0.96],
        ]),
        HandClass::Finger2 => with(&[0], false),
        HandClass::Finger23 => with(&[0, 1], false),
        HandClass::Finger23Spread => with(&[], false)
            .line([[0.28, 0.46], [0.12, 0.04]])
            .line([[0.36, 0.46], [0.52, 0.04]]),
        HandClass::Finger2345 => with(&[0, 1, 2, 3], true),
        HandClass::Pinch12 => ring(with(&[], false), false),
        HandClass::Pinch12Open => ring(with(&[1, 2, 3], true), false),
        HandClass::PinchAll => hand
            .line(arc([0.38, 0.72], [0.28, 0.26], 0.0, 0.5))
            .line([
                [0.1, 0.72],
                [0.3, 0.1],
                [0.38, 0.04],
                [0.46, 0.1],
                [0.66, 0.72],
            ])
            .line([[0.38, 0.06], [0.38, 0.5]]),
        HandClass::Cee12 => ring(with(&[], false), true),
        HandClass::Cee12Open => ring(with(&[1, 2, 3], true), true),
        HandClass::CeeAll => hand
            .line(arc([0.42, 0.5], [0.34, 0.44], 0.14, 0.86))
            .line(arc([0.42, 0.5], [0.2, 0.28], 0.14, 0.86))
            .line([[0.64, 0.14], [0.54, 0.28]])
            .line([[0.64, 0.86], [0.54, 0.72]]),
    }
}

fn thumb(position: ThumbPosition) -> Drawing {
    let hand = Drawing::new(0.66).thin(palm());
    match position {
        ThumbPosition::Out => hand.line([[0.2, 0.84], [0.06, 0.62], [0.02, 0.4]]),
        ThumbPosition::Across => hand.line([[0.18, 0.8], [0.26, 0.68], [0.56, 0.62]]),
        ThumbPosition::Opposed => hand
            .line([[0.2, 0.88], [0.1, 0.62], [0.24, 0.3], [0.36, 0.24]])
            .thin([[0.5, 0.46], [0.5, 0.24]]),
    }
}

/// A finger from the side, the palm thin below it; a unit is a quarter of a right angle.
fn bent(units: [f64; 3]) -> Drawing {
    let mut at = [0.12, 0.58];
    let mut points = vec![at];
    let mut turned = 0.0_f32;
    for (unit, length) in units.into_iter().zip([0.3, 0.22, 0.16_f32]) {
        turned += unit as f32 / 4.0 * std::f32::consts::FRAC_PI_2;
        let (sin, cos) = turned.sin_cos();
        at = [at[0] + length * sin, at[1] - length * cos];
        points.push(at);
    }
    let right = points.iter().map(|[x, _]| *x).fold(0.2, f32::max);
    Drawing::new(right + 0.1)
        .thin([[0.12, 1.0], [0.12, 0.58]])
        .line(points)
        .dot([0.12, 0.58])
}

/// Draws a part of the hand, a digit, or a part of a digit.
pub(super) fn part(kind: Kind) -> Drawing {
    match kind {
        Kind::Digit(digit) => {
            let number = Digit::ALL.iter().position(|it| *it == digit).unwrap_or(0);
            let mut hand = Drawing::new(HAND).thin(palm());
            for other in 0..4 {
                let points = finger(other, true);
                hand = if other + 1 == number {
                    hand.line(points)
                } else {
                    hand.thin(points)
                };
            }
            if number == 0 {
                hand.line(THUMB)
            } else {
                hand.thin(THUMB)
            }
        }
        Kind::Part(part) => part_of_finger(part),
        Kind::Hand(place) => part_of_hand(place),
        Kind::WristSide(side) => {
            let hand = wrist();
            match side {
                Side::Radial => hand.dot([0.24, 0.88]),
                Side::Ulnar => hand.dot([0.5, 0.88]),
                Side::Dorsal => knuckles(hand).line([[0.26, 0.88], [0.48, 0.88]]),
                _ => hand
                    .line([[0.26, 0.88], [0.48, 0.88]])
                    .line([[0.26, 0.96], [0.48, 0.96]]),
            }
        }
        _ => Drawing::default(),
    }
}

/// A thin mitten with its wrist.
fn wrist() -> Drawing {
    Drawing::new(HAND)
        .thin([
            [0.26, 0.98],
            [0.26, 0.8],
            [0.18, 0.64],
            [0.18, 0.2],
            [0.28, 0.06],
            [0.46, 0.06],
            [0.56, 0.2],
            [0.56, 0.64],
            [0.48, 0.8],
            [0.48, 0.98],
        ])
        .thin([[0.18, 0.66], [0.06, 0.5], [0.05, 0.36]])
}

/// Draws the knuckles, which distinguish the back of the hand from its palm.
fn knuckles(hand: Drawing) -> Drawing {
    hand.thin(arc([0.26, 0.36], [0.05, 0.04], 0.5, 1.0))
        .thin(arc([0.37, 0.34], [0.05, 0.04], 0.5, 1.0))
        .thin(arc([0.48, 0.36], [0.05, 0.04], 0.5, 1.0))
}

fn part_of_hand(place: HandLocation) -> Drawing {
    match place {
        HandLocation::Palm => wrist().solid(oval([0.37, 0.52], [0.12, 0.14])),
        HandLocation::HandBack => knuckles(wrist()).line(oval([0.37, 0.58], [0.12, 0.14])),
        HandLocation::ThumbSide => wrist().line([[0.18, 0.2], [0.18, 0.64]]),
        HandLocation::PinkySide => wrist().line([[0.56, 0.2], [0.56, 0.64]]),
        HandLocation::ThumbBall => wrist().solid(oval([0.25, 0.62], [0.08, 0.1])),
        HandLocation::WristBack => knuckles(wrist()).line([[0.24, 0.84], [0.5, 0.84]]),
        _ => wrist(),
    }
}

/// A finger from the side, its pad to the right.
fn part_of_finger(part: FingerPart) -> Drawing {
    let finger = Drawing::new(0.5)
        .thin([[0.12, 0.98], [0.12, 0.2]])
        .thin(arc([0.24, 0.2], [0.12, 0.14], 0.5, 1.0))
        .thin([[0.36, 0.2], [0.36, 0.98]]);
    match part {
        FingerPart::Tip => finger.solid(arc([0.24, 0.2], [0.12, 0.14], 0.5, 1.0)),
        FingerPart::Nail => finger.line([[0.08, 0.12], [0.08, 0.34]]),
        FingerPart::Pad => finger.solid(arc([0.36, 0.26], [0.1, 0.14], 0.75, 1.25)),
        FingerPart::MidJoint => finger.line([[0.08, 0.58], [0.4, 0.58]]),
        FingerPart::Base => finger.line([[0.08, 0.94], [0.4, 0.94]]),
        FingerPart::Side => finger.line([[0.24, 0.3], [0.24, 0.9]]),
    }
}
