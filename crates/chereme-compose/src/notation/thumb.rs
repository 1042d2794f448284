//! Moves the thumb to its notated position on a given hand: to the fingers that it pinches, in front of the folded
//! fingers, or across the palm.

use chereme_motion::glam::DVec3;
use chereme_motion::{BodySide, HandAngles};
use chereme_sign::hamnosys::angles::selected_fingers;
use chereme_sign::hamnosys::sites::{DigitFace, NotatedHandPoint};
use chereme_sign::hamnosys::{HandClass, HandDigit, Handshape, ThumbPosition};

use super::notation_stage::{FINGER_FLESH, FingerShape, StagedHand, StandingBody};
use super::notation_tuned::tuned;

/// Ranges of a thumb's angles in degrees: radial, palmar, opposition, and both flexions.
const THUMB_RANGES_DEGREES: [[f64; 2]; 5] = [
    [-20.0, 65.0],
    [-10.0, 80.0],
    [-20.0, 90.0],
    [-15.0, 70.0],
    [-15.0, 85.0],
];
/// The number of rounds in which a thumb is brought across the hand.
const THUMB_ROUNDS: usize = 16;
/// The number of steps, each shorter, that are tried in a round.
const THUMB_STEP_TRIALS: usize = 4;
/// Positions of a pad on the middle bone of a finger: the share of the bone from the middle joint, and the angle (rad)
/// about it from its front towards the thumb's side. Each is tried if the one before is out of reach.
const ON_FINGER: [(f64, f64); 6] = [(0.4, 0.0), (0.4, 0.5), (0.2, 0.5), (0.4, 0.9), (0.1, 0.9), (0.3, 1.2)];
/// Distance in metres within which a goal counts as reached.
const THUMB_GOAL_DISTANCE_M: f64 = 1e-3;

/// Returns the shape of the fingers of a handshape on this hand, with the thumb at the fingers that it touches.
pub(crate) fn pose_handshape_thumb(
    stage: &StandingBody,
    side: BodySide,
    handshape: &Handshape,
    angles: &HandAngles,
) -> FingerShape {
    let angles = &super::crossed::crossed_angles(stage, side, handshape, angles);
    let is_plain = handshape.between.is_none()
        && handshape.thumb.is_none()
        && handshape.bends[0].is_none()
        && handshape.form.thumb == Some(ThumbPosition::Across);
    if is_plain && let Some(shape) = pose_thumb_across(stage, side, handshape, angles) {
        return shape;
    }
    pose_pinching_thumb(stage, side, handshape, angles)
}

/// Returns the shape with the thumb across: its pad on the folded finger on which it naturally rests, or on the palm
/// below the ring finger. The last bone is level over the finger or palm that it crosses. A short thumb reaches less
/// far around that finger.
fn pose_thumb_across(
    stage: &StandingBody,
    side: BodySide,
    handshape: &Handshape,
    angles: &HandAngles,
) -> Option<FingerShape> {
    let hand = stage.hand_of_side(side)?;
    let posed = stage.finger_shape(side, angles);
    let point = |at: NotatedHandPoint| stage.hand_point_offset(hand, &posed, at);
    let length = hand.staged_hand_length();
    let goals: Vec<DVec3> = match handshape.form.class {
        HandClass::Flat | HandClass::Finger2345 => {
            if handshape.form.bend.is_some() || !handshape.exempt.is_empty() {
                return None;
            }
            let base = |digit| point(NotatedHandPoint::Base(digit, DigitFace::Middle));
            let (middle, ring) = (base(HandDigit::Middle), base(HandDigit::Ring));
            let thumb_point = middle.lerp(ring, 0.4) - hand.along * (0.11 * length);
            let level = thumb_point - hand.palm * thumb_point.dot(hand.palm);
            vec![level + hand.palm * ((tuned().thumb.skin + FINGER_FLESH) * length)]
        }
        HandClass::Fist | HandClass::Finger2 | HandClass::Finger23 | HandClass::Finger23Spread => {
            let on = rests_on(handshape)?;
            let near = point(NotatedHandPoint::Middle(on, DigitFace::Middle));
            let far = stage.last_joint(hand, &posed, on)?;
            let bone = (far - near).try_normalize()?;
            let out = hand.palm.reject_from_normalized(bone).try_normalize()?;
            let aside = bone.cross(out) * bone.cross(out).dot(hand.radial).signum();
            let round = |&(share, turn): &(f64, f64)| {
                let out = out * turn.cos() + aside * turn.sin();
                near.lerp(far, share) + out * (2.0 * FINGER_FLESH * length)
            };
            ON_FINGER.iter().map(round).collect()
        }
        _ => return None,
    };
    let mut best: Option<(f64, FingerShape)> = None;
    for goal in goals {
        let (missed, shape) = brought(stage, side, hand, angles, goal);
        if best.as_ref().is_none_or(|(least, _)| missed < *least) {
            best = Some((missed, shape));
        }
        if missed < THUMB_GOAL_DISTANCE_M {
            break;
        }
    }
    best.map(|(_, shape)| shape)
}

/// Returns the shape with the thumb's pad as near to a goal as possible, and the remaining distance (m).
fn brought(
    stage: &StandingBody,
    side: BodySide,
    hand: &StagedHand,
    angles: &HandAngles,
    goal: DVec3,
) -> (f64, FingerShape) {
    let length = hand.staged_hand_length();
    let miss = |shape: &FingerShape, level: f64| {
        let tip = stage.hand_point_offset(hand, shape, NotatedHandPoint::Tip(HandDigit::Thumb, DigitFace::Middle));
        let joint = stage.hand_point_offset(
            hand,
            shape,
            NotatedHandPoint::Middle(HandDigit::Thumb, DigitFace::Middle),
        );
        let bone = (tip - joint).normalize_or(hand.along);
        let off = goal - (tip - bone * (FINGER_FLESH * length));
        [off.x, off.y, off.z, level * (goal - joint).dot(hand.palm)]
    };
    let squares = |off: [f64; 4]| off.iter().map(|off| off * off).sum::<f64>();
    let mut now = thumb_angle_values(angles);
    let mut posed = stage.finger_shape(side, &with_thumb_angles(angles, now));
    let mut damping = 0.05 * length;
    for round in 0..THUMB_ROUNDS {
        let level = if round < THUMB_ROUNDS / 2 {
            tuned().thumb.level
        } else {
            0.0
        };
        let off = miss(&posed, level);
        let mut columns = [[0.0; 4]; 5];
        for (n, column) in columns.iter_mut().enumerate() {
            let mut other = now;
            other[n] += 1e-3;
            let moved = miss(&stage.finger_shape(side, &with_thumb_angles(angles, other)), level);
            *column = std::array::from_fn(|row| (off[row] - moved[row]) / 1e-3);
        }
        for _ in 0..THUMB_STEP_TRIALS {
            let step = damped_thumb_step(&columns, off, damping);
            let next: [f64; 5] = std::array::from_fn(|n| {
                let [low, high] = THUMB_RANGES_DEGREES[n].map(f64::to_radians);
                (now[n] + step[n].clamp(-0.5, 0.5)).clamp(low, high)
            });
            let tried = stage.finger_shape(side, &with_thumb_angles(angles, next));
            if squares(miss(&tried, level)) < squares(off) {
                (now, posed) = (next, tried);
                damping *= 0.3;
                break;
            }
            damping *= 5.0;
        }
        let off = miss(&posed, tuned().thumb.level);
        if off[..3].iter().all(|off| off.abs() < 4e-4) && off[3].abs() < tuned().thumb.level * 2e-3 {
            break;
        }
    }
    (squares(miss(&posed, 0.0)).sqrt(), posed)
}

/// Returns the folded finger on which a thumb across rests: the middle finger, else the first folded one.
fn rests_on(handshape: &Handshape) -> Option<HandDigit> {
    let chosen = selected_fingers(handshape.form.class, &handshape.special.0);
    let fist = handshape.form.class == HandClass::Fist;
    let folded = |digit: HandDigit| {
        let n = usize::from(digit.digit_number()) - 2;
        match fist {
            true => !handshape.exempt.contains_digit(digit),
            false => !chosen[n],
        }
    };
    let order = [HandDigit::Middle, HandDigit::Index, HandDigit::Ring, HandDigit::Little];
    order.into_iter().find(|&digit| folded(digit))
}

/// Returns the damped least-squares step for four misses by five angles: `(JᵀJ + λ²)⁻¹ Jᵀ miss`, by
/// elimination.
fn damped_thumb_step(columns: &[[f64; 4]; 5], miss: [f64; 4], damping: f64) -> [f64; 5] {
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

/// Returns the shape of the fingers with the tip of the thumb at the fingers that it pinches. The thumb's five angles
/// take damped least-squares steps from the table's values towards the middle of the tips: the tables suit one hand,
/// and this method suits any.
fn pose_pinching_thumb(
    stage: &StandingBody,
    side: BodySide,
    handshape: &Handshape,
    angles: &HandAngles,
) -> FingerShape {
    let shape = stage.finger_shape(side, angles);
    let pinches = matches!(
        handshape.form.class,
        HandClass::Pinch12 | HandClass::Pinch12Open | HandClass::PinchAll
    );
    let Some(hand) = stage
        .hand_of_side(side)
        .filter(|_| pinches && handshape.between.is_none())
    else {
        return shape;
    };
    let met: Vec<HandDigit> = if handshape.form.class == HandClass::PinchAll {
        vec![HandDigit::Index, HandDigit::Middle]
    } else if let Some(digit) = handshape.opposed {
        vec![digit]
    } else if handshape.special.is_empty() {
        vec![HandDigit::Index]
    } else {
        handshape
            .special
            .0
            .iter()
            .copied()
            .filter(|&digit| digit != HandDigit::Thumb)
            .collect()
    };
    if met.is_empty() {
        return shape;
    }
    let tip = |shape: &FingerShape, digit: HandDigit| {
        stage.hand_point_offset(hand, shape, NotatedHandPoint::Tip(digit, DigitFace::Middle))
    };
    let goal = met.iter().map(|&digit| tip(&shape, digit)).sum::<DVec3>() / met.len() as f64;
    let pads = met
        .iter()
        .map(|&digit| stage.hand_point_normal(hand, &shape, NotatedHandPoint::Tip(digit, DigitFace::Palmar)))
        .sum::<DVec3>()
        .normalize_or(hand.palm);
    let goal = goal + pads * (tuned().thumb.apart * hand.staged_hand_length());
    let start = thumb_angle_values(angles);
    let mut now = start;
    let mut posed = shape;
    for _ in 0..6 {
        let miss = goal - tip(&posed, HandDigit::Thumb);
        if miss.length() < 5e-4 {
            break;
        }
        let mut columns = [DVec3::ZERO; 5];
        for (n, column) in columns.iter_mut().enumerate() {
            let mut other = now;
            other[n] += 1e-3;
            let moved = stage.finger_shape(side, &with_thumb_angles(angles, other));
            *column = (tip(&moved, HandDigit::Thumb) - tip(&posed, HandDigit::Thumb)) / 1e-3;
        }
        let step = damped(&columns, miss, 0.1 * hand.staged_hand_length());
        for n in 0..5 {
            now[n] = (now[n] + step[n]).clamp(start[n] - tuned().thumb.most, start[n] + tuned().thumb.most);
        }
        posed = stage.finger_shape(side, &with_thumb_angles(angles, now));
    }
    posed
}

fn thumb_angle_values(angles: &HandAngles) -> [f64; 5] {
    let thumb = &angles.thumb;
    [
        thumb.radial,
        thumb.palmar,
        thumb.opposition,
        thumb.flexion[0],
        thumb.flexion[1],
    ]
}

fn with_thumb_angles(angles: &HandAngles, values: [f64; 5]) -> HandAngles {
    let mut all = angles.to_array();
    all[..5].copy_from_slice(&values);
    HandAngles::from_array(all)
}

/// Returns `Jᵀ(JJᵀ + λ²)⁻¹ miss`.
fn damped(columns: &[DVec3; 5], miss: DVec3, damping: f64) -> [f64; 5] {
    let mut square = chereme_motion::glam::DMat3::from_diagonal(DVec3::splat(damping * damping * 0.02));
    for column in columns {
        square += chereme_motion::glam::DMat3::from_cols(*column * column.x, *column * column.y, *column * column.z);
    }
    let force = square.inverse() * miss;
    columns.map(|column| column.dot(force))
}
