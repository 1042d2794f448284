//! Brings the thumb to where its notation has it, on the given hand: to the fingers that it pinches, in
//! front of the folded fingers, or across the palm.

use chereme_motion::glam::DVec3;
use chereme_motion::{HandAngles, Side};
use chereme_sign::hamnosys::angles::selected;
use chereme_sign::hamnosys::sites::{Face, HandPoint};
use chereme_sign::hamnosys::{Digit, HandClass, Handshape, ThumbPosition};

use super::stage::{Shape, Stage};

/// Distance between the middles of two tips that meet, in hand lengths.
const APART: f64 = 0.045;
/// Largest change of an angle from the table's, in radians.
const MOST: f64 = 0.45;

/// Half the thickness of a finger, in hand lengths.
const FLESH: f64 = 0.042;
/// Height of the palm's skin over the bones, in hand lengths.
const SKIN: f64 = 0.07;
/// Ranges of a thumb's angles in degrees: radial, palmar, opposition, and both flexions.
const RANGE: [[f64; 2]; 5] = [
    [-20.0, 65.0],
    [-10.0, 80.0],
    [-20.0, 90.0],
    [-15.0, 70.0],
    [-15.0, 85.0],
];
/// The number of rounds in which a thumb is brought across the hand.
const ROUNDS: usize = 12;

/// Returns the shape of the fingers of a handshape on this hand, with the thumb where it meets others.
pub(crate) fn posed(
    stage: &Stage,
    side: Side,
    handshape: &Handshape,
    angles: &HandAngles,
) -> Shape {
    let own = handshape.between.is_none()
        && handshape.thumb.is_none()
        && handshape.bends[0].is_none()
        && handshape.form.thumb == Some(ThumbPosition::Across);
    if own && let Some(shape) = across(stage, side, handshape, angles) {
        return shape;
    }
    met(stage, side, handshape, angles)
}

/// Returns the shape with the thumb across: its pad on the folded finger where it rests by nature, or on
/// the palm below the ring finger. The last bone lies level over what it crosses.
fn across(stage: &Stage, side: Side, handshape: &Handshape, angles: &HandAngles) -> Option<Shape> {
    let hand = stage.hand(side)?;
    let mut posed = stage.shape(side, angles);
    let point = |shape: &Shape, at: HandPoint| stage.point(hand, shape, at);
    let mid = |digit: Digit| HandPoint::Middle(digit, Face::Middle);
    let length = hand.length();
    let class = handshape.form.class;
    let (goal, over) = match class {
        HandClass::Flat | HandClass::Finger2345 => {
            if handshape.form.bend.is_some() || !handshape.exempt.is_empty() {
                return None;
            }
            let base = |digit| point(&posed, HandPoint::Base(digit, Face::Middle));
            let (middle, ring) = (base(Digit::Middle), base(Digit::Ring));
            let at = middle.lerp(ring, 0.4) - hand.along * (0.11 * length);
            let level = at - hand.palm * at.dot(hand.palm);
            (level + hand.palm * ((SKIN + FLESH) * length), hand.palm)
        }
        HandClass::Fist | HandClass::Finger2 | HandClass::Finger23 | HandClass::Finger23Spread => {
            let on = rests_on(handshape)?;
            let (near, far) = (point(&posed, mid(on)), stage.last_joint(hand, &posed, on)?);
            let bone = (far - near).try_normalize()?;
            let out = hand.palm.reject_from_normalized(bone).try_normalize()?;
            (
                near.lerp(far, 0.4) + out * (2.0 * FLESH * length),
                hand.palm,
            )
        }
        _ => return None,
    };
    let miss = |shape: &Shape| {
        let tip = point(shape, HandPoint::Tip(Digit::Thumb, Face::Middle));
        let joint = point(shape, mid(Digit::Thumb));
        let bone = (tip - joint).normalize_or(hand.along);
        let off = goal - (tip - bone * (FLESH * length));
        [off.x, off.y, off.z, (goal - joint).dot(over)]
    };
    let start = values(angles);
    let mut now = start;
    for _ in 0..ROUNDS {
        let off = miss(&posed);
        if off.iter().all(|off| off.abs() < 4e-4) {
            break;
        }
        let mut columns = [[0.0; 4]; 5];
        for (n, column) in columns.iter_mut().enumerate() {
            let mut other = now;
            other[n] += 1e-3;
            let moved = miss(&stage.shape(side, &with(angles, other)));
            *column = std::array::from_fn(|row| (off[row] - moved[row]) / 1e-3);
        }
        let step = least(&columns, off, 0.05 * length);
        for n in 0..5 {
            let [low, high] = RANGE[n].map(f64::to_radians);
            now[n] = (now[n] + step[n].clamp(-0.35, 0.35)).clamp(low, high);
        }
        posed = stage.shape(side, &with(angles, now));
    }
    Some(posed)
}

/// Returns the folded finger on which a thumb across rests: the middle finger, else the first folded one.
fn rests_on(handshape: &Handshape) -> Option<Digit> {
    let chosen = selected(handshape.form.class, &handshape.special.0);
    let fist = handshape.form.class == HandClass::Fist;
    let folded = |digit: Digit| {
        let n = usize::from(digit.number()) - 2;
        match fist {
            true => !handshape.exempt.contains(digit),
            false => !chosen[n],
        }
    };
    let order = [Digit::Middle, Digit::Index, Digit::Ring, Digit::Little];
    order.into_iter().find(|&digit| folded(digit))
}

/// Returns the damped least-squares step for four misses by five angles: `(JᵀJ + λ²)⁻¹ Jᵀ miss`, by
/// elimination.
fn least(columns: &[[f64; 4]; 5], miss: [f64; 4], damping: f64) -> [f64; 5] {
    let dot = |a: &[f64; 4], b: &[f64; 4]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut rows: [[f64; 6]; 5] = std::array::from_fn(|a| {
        std::array::from_fn(|b| match b {
            5 => dot(&columns[a], &miss),
            _ if a == b => dot(&columns[a], &columns[b]) + damping * damping * 0.05,
            _ => dot(&columns[a], &columns[b]),
        })
    });
    // The matrix is symmetric and positive: no pivots are needed.
    for n in 0..5 {
        let row = rows[n];
        for (_, own) in rows.iter_mut().enumerate().filter(|(other, _)| *other != n) {
            let share = own[n] / row[n];
            for (own, row) in own.iter_mut().zip(row) {
                *own -= share * row;
            }
        }
    }
    std::array::from_fn(|n| rows[n][5] / rows[n][n])
}

/// Returns the shape of the fingers with the tip of the thumb at those it pinches. The thumb's five angles
/// take damped least-squares steps from the table's values towards the middle of the tips: the tables suit
/// one hand, this any.
fn met(stage: &Stage, side: Side, handshape: &Handshape, angles: &HandAngles) -> Shape {
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
