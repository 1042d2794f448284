//! Draws hands, the marks of their shapes, and their parts. A right hand is seen from its back: the thumb
//! is at the left.

use super::super::angles::bend_units;
use super::super::symbol::SymbolKind;
use super::super::tree::{FingerPart, HandClass, HandDigit, HandLocation, LocationSide, ThumbPosition};
use super::{DrawingPoint, SymbolDrawing, arc_points, oval};

/// The width of a hand's box.
const HAND_BOX_WIDTH_EMS: f32 = 0.72;
/// Positions of the four fingers: at the palm, at the tips together, and at the tips spread.
const FINGER_POINTS: [[DrawingPoint; 3]; 4] = [
    [[0.22, 0.5], [0.22, 0.06], [0.1, 0.12]],
    [[0.34, 0.46], [0.34, 0.02], [0.29, 0.02]],
    [[0.46, 0.46], [0.46, 0.04], [0.48, 0.02]],
    [[0.57, 0.52], [0.57, 0.14], [0.66, 0.12]],
];
/// The thumb, from the palm to its tip.
const THUMB_POINTS: [DrawingPoint; 3] = [[0.18, 0.86], [0.06, 0.68], [0.03, 0.5]];

fn palm_outline() -> Vec<DrawingPoint> {
    let corner = |x: f32, y: f32, from: f32| arc_points([x, y], [0.1, 0.1], from, from + 0.25);
    let corners = [
        (0.26, 0.56, 0.5),
        (0.53, 0.56, 0.75),
        (0.5, 0.86, 0.0),
        (0.29, 0.86, 0.25),
    ];
    let mut points: Vec<DrawingPoint> = corners
        .into_iter()
        .flat_map(|(x, y, from)| corner(x, y, from))
        .collect();
    points.push(points[0]);
    points
}

fn drawn_finger_line(number: usize, spread: bool) -> [DrawingPoint; 2] {
    let [base, together, apart] = FINGER_POINTS[number];
    [base, if spread { apart } else { together }]
}

/// Draws a class of handshapes or a mark of one.
pub(super) fn draw_handshape_symbol(kind: SymbolKind) -> SymbolDrawing {
    match kind {
        SymbolKind::Base(class) => draw_hand_class(class),
        SymbolKind::Thumb(position) => draw_thumb_position(position),
        SymbolKind::Bend(bend) => draw_bent_finger(bend_units(bend)),
        _ => SymbolDrawing::default(),
    }
}

fn draw_hand_class(class: HandClass) -> SymbolDrawing {
    let hand = SymbolDrawing::new(HAND_BOX_WIDTH_EMS);
    let with = |fingers: &[usize], spread: bool| {
        let hand = SymbolDrawing::new(HAND_BOX_WIDTH_EMS).with_line(palm_outline());
        fingers
            .iter()
            .fold(hand, |hand, number| hand.with_line(drawn_finger_line(*number, spread)))
    };
    // Thumb and index finger meet, or nearly so, at the left of the others.
    let ring = |hand: SymbolDrawing, open: bool| {
        let (from, to) = if open { (0.62, 1.38) } else { (0.5, 1.5) };
        hand.with_line(arc_points([0.17, 0.38], [0.13, 0.16], from + 0.02, to))
    };
    match class {
        HandClass::Fist => hand
            .with_line(oval([0.38, 0.6], [0.28, 0.3]))
            .with_line([[0.27, 0.38], [0.27, 0.58]])
            .with_line([[0.38, 0.34], [0.38, 0.58]])
            .with_line([[0.49, 0.38], [0.49, 0.58]]),
        HandClass::Flat => hand.with_line([
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
            .with_line([[0.28, 0.46], [0.12, 0.04]])
            .with_line([[0.36, 0.46], [0.52, 0.04]]),
        HandClass::Finger2345 => with(&[0, 1, 2, 3], true),
        HandClass::Pinch12 => ring(with(&[], false), false),
        HandClass::Pinch12Open => ring(with(&[1, 2, 3], true), false),
        HandClass::PinchAll => hand
            .with_line(arc_points([0.38, 0.72], [0.28, 0.26], 0.0, 0.5))
            .with_line([[0.1, 0.72], [0.3, 0.1], [0.38, 0.04], [0.46, 0.1], [0.66, 0.72]])
            .with_line([[0.38, 0.06], [0.38, 0.5]]),
        HandClass::Cee12 => ring(with(&[], false), true),
        HandClass::Cee12Open => ring(with(&[1, 2, 3], true), true),
        HandClass::CeeAll => hand
            .with_line(arc_points([0.42, 0.5], [0.34, 0.44], 0.14, 0.86))
            .with_line(arc_points([0.42, 0.5], [0.2, 0.28], 0.14, 0.86))
            .with_line([[0.64, 0.14], [0.54, 0.28]])
            .with_line([[0.64, 0.86], [0.54, 0.72]]),
    }
}

fn draw_thumb_position(position: ThumbPosition) -> SymbolDrawing {
    let hand = SymbolDrawing::new(0.66).thin(palm_outline());
    match position {
        ThumbPosition::Out => hand.with_line([[0.2, 0.84], [0.06, 0.62], [0.02, 0.4]]),
        ThumbPosition::Across => hand.with_line([[0.18, 0.8], [0.26, 0.68], [0.56, 0.62]]),
        ThumbPosition::Opposed => hand
            .with_line([[0.2, 0.88], [0.1, 0.62], [0.24, 0.3], [0.36, 0.24]])
            .thin([[0.5, 0.46], [0.5, 0.24]]),
    }
}

/// A finger from the side, the palm thin below it; a unit is a quarter of a right angle.
fn draw_bent_finger(units: [f64; 3]) -> SymbolDrawing {
    let mut tip = [0.12, 0.58];
    let mut points = vec![tip];
    let mut turned = 0.0_f32;
    for (unit, length) in units.into_iter().zip([0.3, 0.22, 0.16_f32]) {
        turned += unit as f32 / 4.0 * std::f32::consts::FRAC_PI_2;
        let (sin, cos) = turned.sin_cos();
        tip = [tip[0] + length * sin, tip[1] - length * cos];
        points.push(tip);
    }
    let right = points.iter().map(|[x, _]| *x).fold(0.2, f32::max);
    SymbolDrawing::new(right + 0.1)
        .thin([[0.12, 1.0], [0.12, 0.58]])
        .with_line(points)
        .with_dot([0.12, 0.58])
}

/// Draws a part of the hand, a digit, or a part of a digit.
pub(super) fn draw_hand_part(kind: SymbolKind) -> SymbolDrawing {
    match kind {
        SymbolKind::Digit(digit) => {
            let number = HandDigit::ALL_HAND_DIGITS
                .iter()
                .position(|candidate| *candidate == digit)
                .unwrap_or(0);
            let mut hand = SymbolDrawing::new(HAND_BOX_WIDTH_EMS).thin(palm_outline());
            for other in 0..4 {
                let points = drawn_finger_line(other, true);
                hand = if other + 1 == number {
                    hand.with_line(points)
                } else {
                    hand.thin(points)
                };
            }
            if number == 0 {
                hand.with_line(THUMB_POINTS)
            } else {
                hand.thin(THUMB_POINTS)
            }
        }
        SymbolKind::Part(part) => part_of_finger(part),
        SymbolKind::Hand(place) => part_of_hand(place),
        SymbolKind::WristSide(side) => {
            let hand = draw_wrist_part();
            match side {
                LocationSide::Radial => hand.with_dot([0.24, 0.88]),
                LocationSide::Ulnar => hand.with_dot([0.5, 0.88]),
                LocationSide::Dorsal => knuckles(hand).with_line([[0.26, 0.88], [0.48, 0.88]]),
                _ => hand
                    .with_line([[0.26, 0.88], [0.48, 0.88]])
                    .with_line([[0.26, 0.96], [0.48, 0.96]]),
            }
        }
        _ => SymbolDrawing::default(),
    }
}

/// A thin mitten with its wrist.
fn draw_wrist_part() -> SymbolDrawing {
    SymbolDrawing::new(HAND_BOX_WIDTH_EMS)
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
fn knuckles(hand: SymbolDrawing) -> SymbolDrawing {
    hand.thin(arc_points([0.26, 0.36], [0.05, 0.04], 0.5, 1.0))
        .thin(arc_points([0.37, 0.34], [0.05, 0.04], 0.5, 1.0))
        .thin(arc_points([0.48, 0.36], [0.05, 0.04], 0.5, 1.0))
}

fn part_of_hand(place: HandLocation) -> SymbolDrawing {
    match place {
        HandLocation::Palm => draw_wrist_part().solid(oval([0.37, 0.52], [0.12, 0.14])),
        HandLocation::HandBack => knuckles(draw_wrist_part()).with_line(oval([0.37, 0.58], [0.12, 0.14])),
        HandLocation::ThumbSide => draw_wrist_part().with_line([[0.18, 0.2], [0.18, 0.64]]),
        HandLocation::PinkySide => draw_wrist_part().with_line([[0.56, 0.2], [0.56, 0.64]]),
        HandLocation::ThumbBall => draw_wrist_part().solid(oval([0.25, 0.62], [0.08, 0.1])),
        HandLocation::WristBack => knuckles(draw_wrist_part()).with_line([[0.24, 0.84], [0.5, 0.84]]),
        _ => draw_wrist_part(),
    }
}

/// A finger from the side, its pad to the right.
fn part_of_finger(part: FingerPart) -> SymbolDrawing {
    let finger = SymbolDrawing::new(0.5)
        .thin([[0.12, 0.98], [0.12, 0.2]])
        .thin(arc_points([0.24, 0.2], [0.12, 0.14], 0.5, 1.0))
        .thin([[0.36, 0.2], [0.36, 0.98]]);
    match part {
        FingerPart::Tip => finger.solid(arc_points([0.24, 0.2], [0.12, 0.14], 0.5, 1.0)),
        FingerPart::Nail => finger.with_line([[0.08, 0.12], [0.08, 0.34]]),
        FingerPart::Pad => finger.solid(arc_points([0.36, 0.26], [0.1, 0.14], 0.75, 1.25)),
        FingerPart::MidJoint => finger.with_line([[0.08, 0.58], [0.4, 0.58]]),
        FingerPart::Base => finger.with_line([[0.08, 0.94], [0.4, 0.94]]),
        FingerPart::Side => finger.with_line([[0.24, 0.3], [0.24, 0.9]]),
    }
}
