//! Crosses fingers on a given hand: the tables suit one hand, and this method suits any.

use chereme_motion::glam::DVec3;
use chereme_motion::{BodySide, HandAngles, HandFinger};
use chereme_sign::hamnosys::angles::crossed_fingers;
use chereme_sign::hamnosys::sites::{DigitFace, NotatedHandPoint};
use chereme_sign::hamnosys::{HandDigit, Handshape};

use super::notation_stage::{FINGER_FLESH, FingerShape, StagedHand, StandingBody};

/// The number of rounds in which two fingers are brought to their places.
const CROSSED_FINGER_ROUNDS: usize = 16;
/// The share of a miss that a round corrects.
const CROSSED_MISS_SHARE: f64 = 0.6;
/// The distance of the tips to the side, and of the fingers where they cross, in thicknesses of a finger: flesh gives way.
const CROSSED_TIP_DISTANCE: f64 = 0.85;
/// The ranges of the angles (rad): the spread, the base joint, and the middle joint of the finger behind.
const CROSSED_ANGLE_RANGES_RAD: [(f64, f64); 3] = [(-0.5, 0.5), (-0.5, 1.6), (0.0, 1.3)];

/// Returns the angles of a hand whose crossed fingers touch where they cross, with tips side by side that have changed
/// sides.
pub(super) fn crossed_angles(
    stage: &StandingBody,
    side: BodySide,
    handshape: &Handshape,
    angles: &HandAngles,
) -> HandAngles {
    let mut angles = *angles;
    let Some(hand) = stage.hand_of_side(side) else {
        return angles;
    };
    for [front, back] in handshape.contacts.iter().filter_map(crossed_fingers) {
        for _ in 0..CROSSED_FINGER_ROUNDS {
            let shape = stage.finger_shape(side, &angles);
            let lines = [front, back].map(|finger| finger_line(stage, hand, &shape, finger));
            let [Some(before), Some(behind)] = lines else {
                break;
            };
            approach_places(hand, [&before, &behind], &mut angles, [front, back]);
        }
    }
    angles
}

/// The joints of a finger and its tip, from the base.
type FingerLine = [DVec3; 4];

fn finger_line(stage: &StandingBody, hand: &StagedHand, shape: &FingerShape, finger: HandFinger) -> Option<FingerLine> {
    let digit = HandDigit::ALL_HAND_DIGITS[finger.index() + 1];
    let point = |at| stage.hand_point_offset(hand, shape, at);
    Some([
        point(NotatedHandPoint::Base(digit, DigitFace::Middle)),
        point(NotatedHandPoint::Middle(digit, DigitFace::Middle)),
        stage.last_joint(hand, shape, digit)?,
        point(NotatedHandPoint::Tip(digit, DigitFace::Middle)),
    ])
}

/// Changes the angles of two crossed fingers by a part of what their places miss.
fn approach_places(
    hand: &StagedHand,
    [before, behind]: [&FingerLine; 2],
    angles: &mut HandAngles,
    [front, back]: [HandFinger; 2],
) {
    let apart = CROSSED_TIP_DISTANCE * 2.0 * FINGER_FLESH * hand.staged_hand_length();
    let tips = behind[3] - before[3];
    let aside = CROSSED_MISS_SHARE * (apart - tips.dot(hand.radial)) / 2.0;
    let ahead = CROSSED_MISS_SHARE * tips.dot(hand.palm);
    let [one, other] = crossing_points(hand, before, behind);
    let between = CROSSED_MISS_SHARE * (apart - (one - other).dot(hand.palm)) / 2.0;
    let arm = |from: DVec3, to: DVec3| from.distance(to).max(0.1 * hand.staged_hand_length());
    let fingers = &mut angles.fingers;
    let changes = [
        (front, 0, -aside / arm(before[0], before[3])),
        (back, 0, aside / arm(behind[0], behind[3])),
        (front, 1, between / arm(before[0], one)),
        (back, 1, -between / arm(behind[0], other)),
        (back, 2, -ahead / arm(behind[1], behind[3])),
    ];
    for (finger, n, by) in changes {
        let finger = &mut fingers[finger.index()];
        let angle = match n {
            0 => &mut finger.spread,
            n => &mut finger.flexion[n - 1],
        };
        *angle = (*angle + by).clamp(CROSSED_ANGLE_RANGES_RAD[n].0, CROSSED_ANGLE_RANGES_RAD[n].1);
    }
}

/// Returns the points of two fingers that lie on each other, as seen from the palm.
fn crossing_points(hand: &StagedHand, before: &FingerLine, behind: &FingerLine) -> [DVec3; 2] {
    const CROSSED_BONE_POINTS: u32 = 10;
    let along = |line: &FingerLine| -> Vec<DVec3> {
        let bones = line.windows(2);
        let points = |bone: &[DVec3]| {
            let [from, to] = [bone[0], bone[1]];
            (1..=CROSSED_BONE_POINTS).map(move |n| from.lerp(to, f64::from(n) / f64::from(CROSSED_BONE_POINTS)))
        };
        bones.flat_map(points).collect()
    };
    let (ours, theirs) = (along(before), along(behind));
    let mut best = (f64::INFINITY, [before[3], behind[3]]);
    for one in &ours {
        for other in &theirs {
            let seen = (*one - *other).reject_from_normalized(hand.palm).length_squared();
            if seen < best.0 {
                best = (seen, [*one, *other]);
            }
        }
    }
    best.1
}
