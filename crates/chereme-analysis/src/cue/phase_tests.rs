//! The arrival of hand and fingers in takes of a hand that is made here, with its own bones, shapes and courses.

use glam::{DQuat, DVec3};

use super::cue_hand::HandMarkerFrame;
use super::cue_targets::GestureQuartiles;
use super::session::{ExpectedCueKey, FollowedTake, KeyGestures, KeySounds, find_key_gestures};
use crate::random::RandomNumbers;

/// The straight fingers of each shape from index to little finger, and whether the thumb is out.
const SHAPES: [([bool; 4], bool); 9] = [
    ([false, false, false, false], false),
    ([true, false, false, false], false),
    ([true, true, false, false], false),
    ([false, true, true, true], false),
    ([true, true, true, true], false),
    ([true, true, true, true], true),
    ([true, false, false, false], true),
    ([true, true, false, false], true),
    ([true, true, false, false], false),
];
/// The places of the pointing fingertip, in millimetres.
const PLACES: [[f64; 3]; 6] = [
    [150.0, -330.0, 180.0],
    [190.0, -130.0, 90.0],
    [110.0, -140.0, 95.0],
    [70.0, -175.0, 100.0],
    [130.0, -95.0, 85.0],
    [75.0, -240.0, 75.0],
];

/// The bends (rad) of a hand: of each finger at the knuckle, its spread, and its two other joints; of the thumb sideways,
/// down, and at its two joints.
type Bends = [[f64; 4]; 5];

fn bends(shape: usize) -> Bends {
    let (straight, is_out) = SHAPES[shape];
    let mut all = [[0.0; 4]; 5];
    for n in 0..4 {
        let spread = match (shape, n) {
            (8, 0) => 0.2,
            (8, 1) => -0.2,
            _ => 0.0,
        };
        all[n] = match straight[n] {
            true => [0.05, spread, 0.08, 0.05],
            false => [1.45, spread, 1.7, 1.0],
        };
    }
    all[4] = match is_out {
        true => [1.0, 0.15, 0.05, 0.05],
        false => [0.3, 0.4, 0.7, 0.9],
    };
    all
}

/// The markers of a hand whose fingers point along x, whose thumb is at y and whose back is at z.
fn markers(bends: &Bends, wrist: DVec3) -> Vec<DVec3> {
    let mut all: Vec<DVec3> = [-220.0, -170.0, -120.0, -80.0, -40.0]
        .iter()
        .zip([18.0, -20.0, 22.0, -18.0, 12.0])
        .map(|(x, y)| DVec3::new(*x, y, 19.0))
        .collect();
    let knuckles = [(86.0, 24.0), (90.0, 3.0), (85.0, -17.0), (76.0, -35.0)];
    all.extend(knuckles.map(|(x, y)| DVec3::new(x, y, 12.0)));
    all.extend([(48.0, 14.0), (42.0, -18.0), (12.0, 2.0)].map(|(x, y)| DVec3::new(x, y, 17.0)));
    for (n, (x, y)) in knuckles.into_iter().enumerate() {
        let [first, spread, second, third] = bends[n];
        let mut turn = DQuat::from_rotation_z(spread) * DQuat::from_rotation_y(first);
        let mut joint = DVec3::new(x, y, 0.0);
        let bones = [(41.0, 0.0), (25.0, second), (19.0, third)];
        for (bone, (length, bend)) in bones.into_iter().enumerate() {
            turn *= DQuat::from_rotation_y(bend);
            let places: &[f64] = if bone == 2 { &[0.3, 0.95] } else { &[0.25, 0.5, 0.8] };
            let on_skin = |part: &f64| joint + turn * DVec3::new(length * part, 0.0, 6.0);
            all.extend(places.iter().map(on_skin));
            joint += turn * DVec3::X * length;
        }
    }
    let [aside, down, second, third] = bends[4];
    let mut turn = DQuat::from_rotation_z(aside) * DQuat::from_rotation_y(down);
    let mut joint = DVec3::new(20.0, 28.0, -5.0);
    for (length, bend) in [(40.0, 0.0), (30.0, second), (24.0, third)] {
        turn *= DQuat::from_rotation_z(-bend);
        all.extend([0.25, 0.95].map(|part| joint + turn * DVec3::new(length * part, 0.0, 5.0)));
        joint += turn * DVec3::X * length;
    }
    let upright = DQuat::from_rotation_z(1.1);
    all.into_iter().map(|at| wrist + upright * at).collect()
}

fn minimum_jerk(share: f64) -> f64 {
    let u = share.clamp(0.0, 1.0);
    6.0 * u.powi(5) - 15.0 * u.powi(4) + 10.0 * u.powi(3)
}

fn half_a_sine(share: f64) -> f64 {
    (std::f64::consts::FRAC_PI_2 * share.clamp(0.0, 1.0)).sin().powi(2)
}

/// The number of keys of a take.
const KEYS: usize = 90;

/// Returns keys at uneven times, and the planted start and end of the movement to each of them.
fn planted() -> (Vec<ExpectedCueKey>, Vec<[f64; 2]>) {
    let mut random = RandomNumbers::new(42);
    let (mut keys, mut moves, mut at) = (Vec::<ExpectedCueKey>::new(), Vec::new(), 1.0);
    for n in 0..KEYS {
        let before = keys.last().map_or((0, 0), |key| (key.placement, key.shape));
        let mut draw = |count: f64, other: u8| loop {
            let own = 1 + (random.random_share() * count) as u8;
            if own != other {
                return own;
            }
        };
        let (placement, shape) = (draw(5.0, before.0), draw(8.0, before.1));
        let (consonant, vowel) = (0.12 + 0.03 * random.random_share(), 0.26 + 0.07 * random.random_share());
        let a2 = at + consonant;
        keys.push(ExpectedCueKey {
            kind: KeySounds::Pair,
            placement,
            shape,
            a1: at,
            a2,
            a3: a2 + vowel,
        });
        let arrives = at + 0.5 * consonant;
        moves.push([arrives - 0.22 - 0.03 * (n % 3) as f64, arrives]);
        at = a2 + vowel;
    }
    (keys, moves)
}

/// Returns the markers of the keys' movements, at `rate` frames a second.
fn filmed(rate: f64, course: fn(f64) -> f64) -> (Vec<HandMarkerFrame>, Vec<ExpectedCueKey>, Vec<[f64; 2]>) {
    let (keys, moves) = planted();
    let mut random = RandomNumbers::new(7);
    let last = keys.last().map_or(0.0, |key| key.a3) + 0.5;
    let frames = (0..(last * rate) as usize).map(|frame| {
        let time = frame as f64 / rate;
        let wrist = |placement: u8, shape: u8| {
            let tip = 12 + 7 + if [1, 6].contains(&shape) { 0 } else { 8 };
            let at = markers(&bends(usize::from(shape)), DVec3::ZERO)[tip];
            DVec3::from(PLACES[usize::from(placement)]) - at
        };
        let (mut now, mut at) = (bends(0), wrist(0, 0));
        for (key, [start, end]) in keys.iter().zip(&moves) {
            let share = course((time - start) / (end - start));
            at = at.lerp(wrist(key.placement, key.shape), share);
            let to = bends(usize::from(key.shape));
            for (own, to) in now.iter_mut().flatten().zip(to.iter().flatten()) {
                *own += (to - *own) * share;
            }
        }
        let mut noise = || DVec3::from([0; 3].map(|_| 0.2 * random.random_normal()));
        let points = markers(&now, at).into_iter();
        points.map(|at| Some(at + noise())).collect()
    });
    let frames = frames.collect();
    (frames, keys, moves)
}

/// The share of a movement that is done at a share of its time.
type MovementCourse = fn(f64) -> f64;
/// The gesture of one part of the hand.
type GestureOf = fn(&KeyGestures) -> super::session::MeasuredGesture;

#[test]
fn hand_and_fingers_arrive_when_they_do_at_every_rate_and_course() {
    let courses: [(&str, MovementCourse); 2] = [("minimum jerk", minimum_jerk), ("half a sine", half_a_sine)];
    for (name, course) in courses {
        for rate in [25.0, 30.0, 60.0, 120.0] {
            let (frames, keys, moves) = filmed(rate, course);
            let take = FollowedTake::of_seen(&frames, &[], None, rate);
            let (_, shown) = find_key_gestures(&[(&take, &keys)]).expect("keys to learn from");
            let parts: [(&str, GestureOf); 2] = [("hand", |key| key.hand), ("fingers", |key| key.fingers)];
            for (part, of) in parts {
                if part == "hand" && name != "minimum jerk" {
                    continue;
                }
                let own = shown[0].iter().map(of).zip(&moves).filter(|pair| pair.0.measured);
                let late: Vec<[f64; 2]> = own
                    .map(|(own, [start, end])| [own.movement.start - start, own.movement.end - end])
                    .collect();
                assert!(late.len() > KEYS * 8 / 10, "{part}: {}", late.len());
                for (n, of) in ["starts", "arrives"].into_iter().enumerate() {
                    let all: Vec<f64> = late.iter().map(|pair| 1000.0 * pair[n]).collect();
                    let q = GestureQuartiles::quartiles_from_numbers(&all).expect("gestures");
                    assert!(q.median.abs() < 5.0, "{name} {rate} {part} {of}: {q:?} ms");
                }
            }
        }
    }
}
