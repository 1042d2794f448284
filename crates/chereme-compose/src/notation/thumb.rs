//! Brings the thumb of a pinch to the fingers that it meets, on the given hand.

use chereme_motion::glam::DVec3;
use chereme_motion::{HandAngles, Side};
use chereme_sign::hamnosys::sites::{Face, HandPoint};
use chereme_sign::hamnosys::{Digit, HandClass, Handshape};

use super::stage::{Shape, Stage};

/// Distance between the middles of two tips that meet, in hand lengths.
const APART: f64 = 0.045;
/// Largest change of an angle from the table's, in radians.
const MOST: f64 = 0.45;

/// Returns the shape of the fingers with the tip of the thumb at those it pinches. The thumb's five angles
/// take damped least-squares steps from the table's values towards the middle of the tips: the tables suit
/// one hand, this any.
pub(crate) fn met(stage: &Stage, side: Side, handshape: &Handshape, angles: &HandAngles) -> Shape {
    let shape = stage.shape(side, angles);
    let pinches = matches!(
        handshape.form.class,
        HandClass::Pinch12 | HandClass::Pinch12Open | HandClass::PinchAll
    );
    let Some(hand) = stage
        .hand(side)
        .filter(|_| pinches && handshape.between.is_none())
    else {
        return shape;
    };
    let met: Vec<Digit> = if handshape.form.class == HandClass::PinchAll {
        vec![Digit::Index, Digit::Middle]
    } else if let Some(digit) = handshape.opposed {
        vec![digit]
    } else if handshape.special.is_empty() {
        vec![Digit::Index]
    } else {
        handshape
            .special
            .0
            .iter()
            .copied()
            .filter(|&digit| digit != Digit::Thumb)
            .collect()
    };
    if met.is_empty() {
        return shape;
    }
    let tip =
        |shape: &Shape, digit: Digit| stage.point(hand, shape, HandPoint::Tip(digit, Face::Middle));
    let goal = met.iter().map(|&digit| tip(&shape, digit)).sum::<DVec3>() / met.len() as f64;
    let pads = met
        .iter()
        .map(|&digit| stage.outward(hand, &shape, HandPoint::Tip(digit, Face::Palmar)))
        .sum::<DVec3>()
        .normalize_or(hand.palm);
    let goal = goal + pads * (APART * hand.length());
    let start = values(angles);
    let mut now = start;
    let mut posed = shape;
    for _ in 0..6 {
        let miss = goal - tip(&posed, Digit::Thumb);
        if miss.length() < 5e-4 {
            break;
        }
        let mut columns = [DVec3::ZERO; 5];
        for (n, column) in columns.iter_mut().enumerate() {
            let mut other = now;
            other[n] += 1e-3;
            let moved = stage.shape(side, &with(angles, other));
            *column = (tip(&moved, Digit::Thumb) - tip(&posed, Digit::Thumb)) / 1e-3;
        }
        let step = damped(&columns, miss, 0.1 * hand.length());
        for n in 0..5 {
            now[n] = (now[n] + step[n]).clamp(start[n] - MOST, start[n] + MOST);
        }
        posed = stage.shape(side, &with(angles, now));
    }
    posed
}

fn values(angles: &HandAngles) -> [f64; 5] {
    let thumb = &angles.thumb;
    [
        thumb.radial,
        thumb.palmar,
        thumb.opposition,
        thumb.flexion[0],
        thumb.flexion[1],
    ]
}

fn with(angles: &HandAngles, values: [f64; 5]) -> HandAngles {
    let mut all = angles.to_array();
    all[..5].copy_from_slice(&values);
    HandAngles::from_array(all)
}

/// Returns `Jᵀ(JJᵀ + λ²)⁻¹ miss`.
fn damped(columns: &[DVec3; 5], miss: DVec3, damping: f64) -> [f64; 5] {
    let mut square =
        chereme_motion::glam::DMat3::from_diagonal(DVec3::splat(damping * damping * 0.02));
    for column in columns {
        square += chereme_motion::glam::DMat3::from_cols(
            *column * column.x,
            *column * column.y,
            *column * column.z,
        );
    }
    let force = square.inverse() * miss;
    columns.map(|column| column.dot(force))
}
