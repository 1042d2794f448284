//! Seeded sessions of a cuer with known truth: to prove that estimators recover it, and nothing about people.
//!
//! Millimetres; x to the cuer's left, y up from the tip of the chin, z forward; a right-handed cuer. Sentences are
//! random syllables. Nothing of a session was captured: whoever writes one to a file says so in it.

use chereme_motion::Interpolation;
use glam::{DMat3, DQuat, DVec3};

use super::face::share_of;
use super::hand::Frame;
use super::labels::{CHEEKS, FACE, HAND, JAW, LIPS, THROAT, THUMB, finger};
use super::rigid::Rigid;

/// Frames a second.
pub const RATE: f64 = 120.0;
/// How many joint angles the generated hand has: 4 of each finger, 4 of the thumb, 2 of the wrist.
pub const JOINTS: usize = 22;

/// Random numbers that are the same on every machine (SplitMix64).
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    /// Returns the numbers of a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Returns a number from 0 to 1.
    pub fn share(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns a number of the normal distribution.
    pub fn normal(&mut self) -> f64 {
        let (a, b) = (self.share().max(1e-300), self.share());
        (-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos()
    }

    /// Returns a whole number below `end`, which is not 0.
    pub fn below(&mut self, end: usize) -> usize {
        ((self.share() * end as f64) as usize).min(end.saturating_sub(1))
    }

    fn vector(&mut self, sd: f64) -> DVec3 {
        DVec3::new(self.normal(), self.normal(), self.normal()) * sd
    }
}

/// The settings of a session.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// The seed; the same gives the same session.
    pub seed: u64,
    /// The scatter of joint angles at targets, in degrees.
    pub scatter: f64,
    /// How far the skin slides over the bones: 1 as measured, 0 not at all.
    pub skin: f64,
    /// Slow noise of soft parts, of hand and face, in millimetres.
    pub soft: [f64; 2],
    /// Noise of measurement, of hand and face, in millimetres.
    pub white: [f64; 2],
    /// Target − start of the sound: of pairs as a share of the consonant, of vowels and of consonants alone as a
    /// share of the key.
    pub phase: [f64; 3],
    /// The spread of phases in seconds: of pairs, and of vowels and consonants alone.
    pub phase_sd: [f64; 2],
    /// How often markers are hidden: 1 as usual, 0 never.
    pub hidden: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            seed: 1,
            scatter: 8.0,
            skin: 1.0,
            soft: [0.5, 0.3],
            white: [0.3, 0.2],
            phase: [0.5, 0.0, 0.0],
            phase_sd: [0.045, 0.06],
            hidden: 1.0,
        }
    }
}

/// A key with what is true of it.
#[derive(Debug, Clone, PartialEq)]
pub struct TrueKey {
    /// 0 a pair, 1 a vowel alone, 2 a consonant alone.
    pub kind: usize,
    /// 1 side, 2 mouth, 3 chin, 4 cheek, 5 throat.
    pub placement: u8,
    /// The shape.
    pub shape: u8,
    /// The acoustic start, the start of the vowel and the end, in seconds.
    pub sound: [f64; 3],
    /// The hand's way, and the fingers', in seconds.
    pub times: [f64; 4],
}

/// A generated take.
#[derive(Debug, Clone)]
pub struct Take {
    /// The hand's markers as a camera system would see them.
    pub hand: Vec<Frame>,
    /// Where they are.
    pub true_hand: Vec<Vec<DVec3>>,
    /// The face's markers as seen.
    pub face: Vec<Frame>,
    /// Where they are.
    pub true_face: Vec<Vec<DVec3>>,
    /// The head's motion in each frame.
    pub head: Vec<Rigid>,
    /// The phones with their start and end in seconds.
    pub phones: Vec<(String, f64, f64)>,
    /// The keys.
    pub keys: Vec<TrueKey>,
}

/// Names of placements by their numbers.
pub const PLACES: [&str; 6] = ["rest", "side", "mouth", "chin", "cheek", "throat"];
/// Where each placement is, to the cuer's right, up and forward, and its spread for one cuer.
const SPOTS: [([f64; 3], [f64; 3], f64); 6] = [
    ([95.0, -130.0, 190.0], [10.0, 10.0, 8.0], 45.0),
    ([115.0, 46.0, 95.0], [17.0, 21.0, 8.0], 68.0),
    ([34.0, 40.0, 92.0], [7.0, 5.0, 8.0], 63.0),
    ([10.0, 14.0, 104.0], [9.0, 6.0, 8.0], 61.0),
    ([50.0, 75.0, 82.0], [9.0, 4.0, 8.0], 64.0),
    ([9.0, -52.0, 70.0], [11.0, 15.0, 8.0], 54.0),
];

/// The vowels and consonants of syllables with their keys, weights and milliseconds.
const VOWELS: [(&str, u8, f64, f64); 12] = [
    ("a", 1, 8.0, 177.0),
    ("@", 1, 6.0, 131.0),
    ("o", 1, 2.0, 182.0),
    ("i", 2, 6.0, 152.0),
    ("O~", 2, 2.0, 166.0),
    ("A~", 2, 3.0, 174.0),
    ("E", 3, 5.0, 134.0),
    ("u", 3, 2.0, 178.0),
    ("E~", 4, 2.0, 170.0),
    ("2", 4, 2.0, 210.0),
    ("e", 5, 5.0, 171.0),
    ("y", 5, 2.0, 138.0),
];
const CONSONANTS: [(&str, u8, f64, f64); 16] = [
    ("p", 1, 3.0, 80.0),
    ("d", 1, 4.0, 61.0),
    ("Z", 1, 1.5, 94.0),
    ("k", 2, 3.0, 80.0),
    ("v", 2, 2.0, 75.0),
    ("s", 3, 4.0, 108.0),
    ("R", 3, 5.0, 74.0),
    ("b", 4, 2.0, 60.0),
    ("n", 4, 2.5, 109.0),
    ("t", 5, 4.0, 80.0),
    ("m", 5, 3.0, 109.0),
    ("l", 6, 4.5, 87.0),
    ("S", 6, 1.0, 135.0),
    ("g", 7, 1.5, 101.0),
    ("j", 8, 2.0, 124.0),
    ("N", 8, 0.8, 110.0),
];

/// Returns a sentence of so many syllables; `number` counts the sentences of a session.
#[must_use]
pub fn sentence(settings: &Settings, number: u64, syllables: usize) -> Take {
    let mut random = Random::new(settings.seed.wrapping_mul(0x5851_F42D_4C95_7F2D) ^ number);
    let (phones, mut keys) = spoken(&mut random, syllables);
    let mut late: f64 = 0.0;
    for key in &mut keys {
        let [a1, a2, a3] = key.sound;
        let length = if key.kind == 0 { a2 - a1 } else { a3 - a1 };
        let sd = settings.phase_sd[usize::from(key.kind > 0)];
        let m2 = a1 + settings.phase[key.kind] * length + sd * random.normal();
        let m2 = m2.max(late + 0.08);
        let m1 = (a1 - 0.62 * (a3 - a1)).clamp(late, m2 - 0.07);
        let lead = 0.03 * random.share();
        key.times = [m1, m2, (m1 - lead).max(late), m2 - lead];
        late = m2;
    }
    moved(settings, &mut random, phones, keys, false)
}

/// Returns all ordered pairs of the nine shapes in free space, `times` times: the hand alone.
#[must_use]
pub fn transitions(settings: &Settings, times: usize) -> Take {
    let mut random = Random::new(settings.seed ^ 0xC0FF_EE00);
    let mut keys = Vec::new();
    let mut at = 0.5;
    for _ in 0..times {
        for (from, to) in (0..9u8).flat_map(|a| (0..9u8).map(move |b| (a, b))) {
            for shape in [from, to] {
                if from != to {
                    keys.push(TrueKey {
                        kind: 0,
                        placement: 1,
                        shape,
                        sound: [at, at + 0.1, at + 0.28],
                        times: [at - 0.2, at, at - 0.2, at],
                    });
                    at += 0.28;
                }
            }
        }
    }
    moved(settings, &mut random, Vec::new(), keys, true)
}

/// Phones with their start and end, and the keys of them.
type Spoken = (Vec<(String, f64, f64)>, Vec<TrueKey>);

fn spoken(random: &mut Random, syllables: usize) -> Spoken {
    let (mut phones, mut keys) = (Vec::new(), Vec::new());
    let mut at = 0.8;
    let mut say = |random: &mut Random, label: &str, ms: f64| {
        let length = ms / 1000.0 * 1.6 * (0.2 * random.normal()).exp();
        phones.push((label.to_owned(), at, at + length));
        at += length;
        (at - length, at)
    };
    for _ in 0..syllables {
        let onset = (random.share() < 0.85).then(|| pick(random, &CONSONANTS));
        let vowel = pick(random, &VOWELS);
        let coda = (random.share() < 0.25).then(|| pick(random, &CONSONANTS));
        let first = onset.map(|c| say(random, c.0, c.3));
        let (start, end) = say(random, vowel.0, vowel.3);
        let a1 = first.map_or(start, |first| first.0);
        keys.push(TrueKey {
            kind: usize::from(onset.is_none()),
            placement: vowel.1,
            shape: onset.map_or(5, |c| c.1),
            sound: [a1, start, end],
            times: [0.0; 4],
        });
        if let Some(coda) = coda {
            let (start, end) = say(random, coda.0, coda.3);
            keys.push(TrueKey {
                kind: 2,
                placement: 1,
                shape: coda.1,
                sound: [start, end, end],
                times: [0.0; 4],
            });
        }
    }
    // A coda and the vowel of a syllable without an onset are one key.
    let mut merged: Vec<TrueKey> = Vec::with_capacity(keys.len());
    for key in keys {
        match merged.last_mut() {
            Some(before) if before.kind == 2 && key.kind == 1 => {
                before.kind = 0;
                before.placement = key.placement;
                before.sound = [before.sound[0], key.sound[0], key.sound[2]];
            }
            _ => merged.push(key),
        }
    }
    (phones, merged)
}

fn pick<'a>(random: &mut Random, of: &'a [(&'a str, u8, f64, f64)]) -> (&'a str, u8, f64, f64) {
    let all: f64 = of.iter().map(|it| it.2).sum();
    let mut left = random.share() * all;
    for it in of {
        left -= it.2;
        if left <= 0.0 {
            return *it;
        }
    }
    of[of.len() - 1]
}

/// The joint angles of a shape in radians.
#[must_use]
pub fn shape_angles(shape: u8) -> [f64; JOINTS] {
    let straight = |finger: usize| match shape {
        1 | 6 => finger == 0,
        2 | 7 | 8 => finger < 2,
        3 => finger > 0,
        4 | 5 => true,
        _ => false,
    };
    let mut row = [0.0; JOINTS];
    for n in 0..4 {
        let bent = if straight(n) {
            [4.0, 4.0, 3.0]
        } else {
            [80.0, 100.0, 55.0]
        };
        let spread = match (shape, n) {
            (8, 0) => 11.0,
            (8, 1) => -9.0,
            _ => 0.0,
        };
        for (k, degrees) in [bent[0], spread, bent[1], bent[2]].into_iter().enumerate() {
            row[4 * n + k] = f64::to_radians(degrees);
        }
    }
    let thumb = match shape {
        5..=7 => [55.0, 10.0, 0.0, 0.0],
        0 => [30.0, 40.0, 35.0, 40.0],
        _ => [12.0, 50.0, 30.0, 45.0],
    };
    for (k, degrees) in thumb.into_iter().enumerate() {
        row[16 + k] = f64::to_radians(degrees);
    }
    row
}

/// Returns where the hand's markers are in the space of the forearm, which lies along x and ends at the wrist.
fn place_hand(angles: &[f64; JOINTS], skin: f64) -> Vec<DVec3> {
    let mut points = Vec::with_capacity(HAND);
    for (x, y, z) in [
        (-200.0, 20.0, 10.0),
        (-150.0, -25.0, 20.0),
        (-110.0, 25.0, 22.0),
        (-60.0, -20.0, 24.0),
        (-30.0, 15.0, 22.0),
    ] {
        points.push(DVec3::new(x, y, z));
    }
    let wrist = DQuat::from_rotation_y(angles[20]) * DQuat::from_rotation_z(angles[21]);
    let mut local = Vec::with_capacity(HAND);
    const KNUCKLES: [f64; 4] = [26.0, 6.0, -13.0, -31.0];
    const FORWARD: [f64; 4] = [90.0, 93.0, 88.0, 80.0];
    const BONES: [[f64; 3]; 4] = [
        [45.0, 26.0, 22.0],
        [50.0, 30.0, 23.0],
        [46.0, 28.0, 23.0],
        [36.0, 20.0, 20.0],
    ];
    for n in 0..4 {
        local.push(DVec3::new(FORWARD[n], KNUCKLES[n], 14.0));
    }
    for (x, y) in [(50.0, 15.0), (45.0, -15.0), (15.0, 0.0)] {
        local.push(DVec3::new(x, y, 18.0));
    }
    for n in 0..4 {
        let [flex, spread, middle, last] = [0, 1, 2, 3].map(|k| angles[4 * n + k]);
        let side = DQuat::from_rotation_z(spread);
        let mut at = DVec3::new(FORWARD[n], KNUCKLES[n], 0.0);
        let mut bent = 0.0;
        for (bone, joint) in [flex, middle, last].into_iter().enumerate() {
            bent += joint;
            let way = side * DVec3::new(bent.cos(), 0.0, -bent.sin());
            let out = side * DVec3::new(bent.sin(), 0.0, bent.cos());
            let places: &[f64] = if bone == 2 {
                &[0.35, 1.0]
            } else {
                &[0.2, 0.5, 0.85]
            };
            for f in places {
                let slide = skin * (3.0 * joint.sin() * (1.0 - f) + 1.2 * (1.0 - joint.cos()));
                let lift = 7.0 - 2.0 * bone as f64 + skin * joint.sin() * (1.0 - f);
                local.push(at + way * (BONES[n][bone] * f + slide) + out * lift);
            }
            at += way * BONES[n][bone];
        }
    }
    let [mut around, down, first, second] = [16, 17, 18, 19].map(|k| angles[k]);
    let mut at = DVec3::new(22.0, 26.0, -6.0);
    for (length, joint) in [(42.0, 0.0), (32.0, first), (26.0, second)] {
        around -= joint;
        let way = DVec3::new(
            around.cos() * down.cos(),
            around.sin() * down.cos(),
            -down.sin(),
        );
        for f in [0.3, 1.0] {
            local.push(at + way * length * f + DVec3::Z * 5.0);
        }
        at += way * length;
    }
    points.extend(local.into_iter().map(|at| wrist * at));
    points
}

fn moved(
    settings: &Settings,
    random: &mut Random,
    phones: Vec<(String, f64, f64)>,
    keys: Vec<TrueKey>,
    free: bool,
) -> Take {
    let last = keys
        .last()
        .map_or(1.0, |key| key.sound[2].max(key.times[1]) + 0.5);
    let frames = (last * RATE).ceil() as usize;
    let scatter = settings.scatter.to_radians();
    let rest = ([0.0; JOINTS], spot(0, random), angle_of(0, random));
    let mut postures = vec![(shape_angles(0), rest.1, rest.2)];
    for key in &keys {
        let mut angles = shape_angles(key.shape);
        for (n, angle) in angles.iter_mut().enumerate() {
            *angle += if n < 20 { scatter } else { 0.07 } * random.normal();
        }
        postures.push((
            angles,
            spot(key.placement, random),
            angle_of(key.placement, random),
        ));
    }
    let lags: Vec<f64> = (0..JOINTS).map(|_| 0.05 * random.normal()).collect();
    let mut true_hand = Vec::with_capacity(frames);
    let (mut head, mut true_face) = (Vec::new(), Vec::new());
    let mut sway = [DVec3::ZERO; 2];
    let keep = (-1.0 / RATE).exp();
    for frame in 0..frames {
        let time = frame as f64 / RATE;
        let n = keys.partition_point(|key| key.times[0] <= time);
        let d = keys.partition_point(|key| key.times[2] <= time);
        let share = |from: f64, to: f64, lag: f64| {
            let own = (time - from) / (to - from).max(1e-3);
            Interpolation::MinimumJerk.share((own - lag * own * (1.0 - own)).clamp(0.0, 1.0))
        };
        let mut angles = postures[d].0;
        if let Some(key) = d.checked_sub(1).map(|d| &keys[d]) {
            for (k, angle) in angles.iter_mut().enumerate() {
                let from = postures[d - 1].0[k];
                *angle = from + (*angle - from) * share(key.times[2], key.times[3], lags[k]);
            }
        }
        let (mut at, mut level) = (postures[n].1, postures[n].2);
        let mut shape = n.checked_sub(1).map_or(0, |n| keys[n].shape);
        if let Some(key) = n.checked_sub(1).map(|n| &keys[n]) {
            let share = share(key.times[0], key.times[1], 0.0);
            at = postures[n - 1].1.lerp(at, share);
            level = postures[n - 1].2 + (level - postures[n - 1].2) * share;
            shape = key.shape;
        }
        if free {
            at = DVec3::new(-150.0, 0.0, 250.0);
        }
        let local = place_hand(&angles, settings.skin);
        let tip = super::hand::HandModel::tip(&local, shape).unwrap_or(DVec3::ZERO);
        let before = n.checked_sub(2).map_or(0, |n| keys[n].shape);
        let other = super::hand::HandModel::tip(&local, before).unwrap_or(tip);
        let blend = n
            .checked_sub(1)
            .map_or(1.0, |n| share(keys[n].times[0], keys[n].times[1], 0.0));
        let turn = hand_turn(level);
        sway = sway.map(|own| own * keep + random.vector((1.0 - keep * keep).sqrt()));
        let motion = Rigid {
            rotation: DQuat::from_scaled_axis(sway[0] * 0.035),
            translation: sway[1] * 5.0,
        };
        let target = motion.apply(at);
        let shift = target - turn * other.lerp(tip, blend);
        true_hand.push(
            local
                .iter()
                .map(|at| turn * *at + shift)
                .collect::<Vec<DVec3>>(),
        );
        true_face.push(place_face(&motion, &mouth(&phones, time)));
        head.push(motion);
    }
    let hand = seen(&true_hand, settings.soft[0], settings.white[0], random);
    let face = seen(&true_face, settings.soft[1], settings.white[1], random);
    let mut take = Take {
        hand,
        true_hand,
        face,
        true_face,
        head,
        phones,
        keys,
    };
    if settings.hidden > 0.0 {
        hide(&mut take, settings.hidden, random);
    }
    take
}

fn spot(placement: u8, random: &mut Random) -> DVec3 {
    let (at, sd, _) = SPOTS[usize::from(placement).min(5)];
    let place = [0, 1, 2].map(|k| at[k] + sd[k] * random.normal());
    DVec3::new(-place[0], place[1], place[2])
}

fn angle_of(placement: u8, random: &mut Random) -> f64 {
    (SPOTS[usize::from(placement).min(5)].2 + 3.0 * random.normal()).to_radians()
}

/// Returns how the forearm is turned: fingers up and to the left, the back of the hand to the front.
fn hand_turn(level: f64) -> DQuat {
    let along = DVec3::new(level.cos(), level.sin(), -0.25).normalize();
    let back = DVec3::Z.reject_from_normalized(along).normalize();
    DQuat::from_mat3(&DMat3::from_cols(along, back.cross(along), back)).normalize()
}

/// The true weights with which the throat follows the head.
#[must_use]
pub fn throat_weights() -> Vec<f64> {
    (0..THROAT.len())
        .map(|n| 0.3 + 0.5 * (n as f64) / 17.0)
        .collect()
}

/// Returns the change of a marker of the face by one unit of a true parameter, in millimetres.
fn face_direction(parameter: usize, marker: usize) -> DVec3 {
    let lower = (LIPS.start + 9..LIPS.end).contains(&marker);
    let upper = (LIPS.start + 1..LIPS.start + 8).contains(&marker);
    let corner = marker == LIPS.start || marker == LIPS.start + 8;
    let side = face_mean(marker).x.signum();
    match parameter {
        0 if JAW.contains(&marker) => DVec3::new(0.0, -6.0, -2.0),
        0 if lower => DVec3::new(0.0, -5.0, -1.0),
        0 if CHEEKS.contains(&marker) => DVec3::new(0.0, -1.0, 0.0),
        1 if LIPS.contains(&marker) => DVec3::new(-3.0 * face_mean(marker).x / 25.0, 0.0, 3.0),
        2 if upper => DVec3::new(0.0, 2.0, 0.3),
        3 if lower => DVec3::new(0.0, 2.0, 0.4),
        4 if corner => DVec3::new(0.5 * side, 2.0, 0.0),
        5 if THROAT.contains(&marker) => DVec3::new(0.0, 3.0, 1.0),
        6 if CHEEKS.contains(&marker) => DVec3::new(side, 0.5, 1.0),
        _ => DVec3::ZERO,
    }
}

/// Returns where a marker of a face at rest is.
fn face_mean(marker: usize) -> DVec3 {
    let ring = |n: usize, count: usize| std::f64::consts::TAU * n as f64 / count as f64;
    match marker {
        0..=4 => DVec3::new(
            25.0 * (marker as f64 - 2.0),
            140.0 + 4.0 * (marker % 2) as f64,
            90.0,
        ),
        5 => DVec3::new(0.0, 105.0, 105.0),
        6 => DVec3::new(0.0, 92.0, 112.0),
        7 | 8 => DVec3::new(if marker == 7 { -75.0 } else { 75.0 }, 95.0, 0.0),
        9..=24 => {
            let angle = ring(marker - 9, 16);
            DVec3::new(
                -25.0 * angle.cos(),
                45.0 + 10.0 * angle.sin(),
                100.0 - 6.0 * angle.cos().powi(2),
            )
        }
        25..=36 => {
            let n = marker - 25;
            let side = if n < 6 { -1.0 } else { 1.0 };
            let n = (n % 6) as f64;
            DVec3::new(side * (35.0 + 6.0 * n), 70.0 - 7.0 * n, 88.0 - 5.0 * n)
        }
        37..=44 => {
            let n = marker as f64 - 40.5;
            DVec3::new(16.0 * n, 6.0 + 1.2 * n * n, 98.0 - 2.5 * n * n)
        }
        _ => {
            let n = marker - 45;
            DVec3::new(
                14.0 * ((n % 6) as f64 - 2.5),
                -30.0 - 14.0 * (n / 6) as f64,
                65.0,
            )
        }
    }
}

fn place_face(motion: &Rigid, parameters: &[f64; 7]) -> Vec<DVec3> {
    let weights = throat_weights();
    (0..FACE)
        .map(|marker| {
            let mut at = face_mean(marker);
            for (k, parameter) in parameters.iter().enumerate() {
                at += face_direction(k, marker) * *parameter;
            }
            let weight = marker.checked_sub(THROAT.start).map_or(1.0, |n| weights[n]);
            share_of(motion, weight).apply(at)
        })
        .collect()
}

/// Returns the true parameters of the face at a time: those of the sound, early by 60 ms.
fn mouth(phones: &[(String, f64, f64)], time: f64) -> [f64; 7] {
    let at = time + 0.06;
    let n = phones.partition_point(|phone| phone.1 <= at);
    let of = |n: Option<usize>| n.map_or([0.0; 7], |n| viseme(&phones[n].0));
    let (before, own) = (of(n.checked_sub(2)), of(n.checked_sub(1)));
    let start = n.checked_sub(1).map_or(0.0, |n| phones[n].1);
    let share = Interpolation::MinimumJerk.share(((at - start) / 0.09).clamp(0.0, 1.0));
    std::array::from_fn(|k| before[k] + (own[k] - before[k]) * share)
}

fn viseme(label: &str) -> [f64; 7] {
    match label {
        "a" => [2.0, -0.5, 0.8, -0.8, 0.0, -0.6, 0.0],
        "A~" => [1.6, 0.2, 0.6, -0.5, -0.3, -1.0, 0.2],
        "E" | "E~" => [1.2, -0.8, 0.5, -0.6, 0.5, 0.3, 0.4],
        "e" => [0.6, -1.0, 0.3, -0.4, 0.8, 0.8, 0.5],
        "i" => [0.2, -1.2, 0.2, -0.2, 1.2, 1.2, 0.6],
        "o" | "O~" => [0.8, 1.4, 0.0, -0.2, -0.5, -0.4, -0.3],
        "u" => [0.2, 2.0, -0.2, 0.2, -0.8, 0.2, -0.6],
        "y" => [0.2, 2.1, -0.1, 0.1, -0.4, 1.0, -0.5],
        "2" => [0.6, 1.6, 0.1, -0.1, -0.3, 0.4, -0.2],
        "@" => [0.6, 0.6, 0.1, -0.1, 0.0, 0.0, 0.0],
        "p" | "b" | "m" => [-0.4, 0.2, -1.0, 1.2, 0.1, 0.0, 0.7],
        "f" | "v" => [-0.1, -0.2, 0.6, 1.4, 0.2, 0.1, -0.2],
        "S" | "Z" => [0.1, 1.5, 0.6, -0.6, 0.0, 0.5, -0.1],
        "s" | "t" | "d" | "n" | "l" => [0.1, -0.4, 0.2, -0.3, 0.4, 0.7, 0.1],
        "k" | "g" | "R" | "N" => [0.5, -0.1, 0.0, -0.3, 0.0, -1.2, -0.2],
        "j" => [0.1, -1.0, 0.1, -0.2, 1.0, 1.1, 0.9],
        _ => [0.0; 7],
    }
}

/// Adds slow noise of soft parts and noise of measurement.
fn seen(points: &[Vec<DVec3>], soft: f64, white: f64, random: &mut Random) -> Vec<Frame> {
    let keep = (-1.0 / (0.4 * RATE)).exp();
    let markers = points.first().map_or(0, Vec::len);
    let mut slow: Vec<DVec3> = (0..markers).map(|_| random.vector(soft)).collect();
    points
        .iter()
        .map(|frame| {
            frame
                .iter()
                .zip(&mut slow)
                .map(|(at, slow)| {
                    *slow = *slow * keep + random.vector(soft * (1.0 - keep * keep).sqrt());
                    Some(*at + *slow + random.vector(white))
                })
                .collect()
        })
        .collect()
}

/// Hides markers in runs: neighbours of one finger, tips of bent fingers, the face behind the hand, and some at random.
fn hide(take: &mut Take, often: f64, random: &mut Random) {
    let frames = take.hand.len();
    let runs = (frames as f64 / RATE * 1.2 * often) as usize;
    for _ in 0..runs {
        let start = random.below(frames);
        let length = 6 + (-random.share().max(1e-9).ln() * 0.2 * RATE) as usize;
        let own = random.below(5);
        let first = if own == 4 { THUMB } else { finger(own) };
        let count = if own == 4 { 6 } else { 8 };
        let from = random.below(count - 1);
        let many = (2 + random.below(3)).min(count - from);
        for frame in take.hand.iter_mut().skip(start).take(length) {
            frame[first + from..first + from + many].fill(None);
        }
    }
    for own in 0..4 {
        let mut gone = false;
        for frame in 0..frames {
            if frame % 24 == 0 {
                gone = random.share() < 0.6 * often;
            }
            let points = &take.true_hand[frame];
            let tip = finger(own) + 7;
            let bent = points[tip].distance(points[finger(own)]) < 45.0;
            if bent && gone {
                take.hand[frame][tip] = None;
            }
        }
    }
    for frame in 0..frames {
        let tip = take.true_hand[frame][finger(1) + 7];
        for marker in LIPS.chain(CHEEKS) {
            let at = take.true_face[frame][marker];
            if at.x < 0.0 && at.distance(tip) < 40.0 {
                take.face[frame][marker] = None;
            }
        }
        for at in take.hand[frame].iter_mut().chain(&mut take.face[frame]) {
            if random.share() < 0.02 * often {
                *at = None;
            }
        }
    }
}
