//! Generated sessions of a cuer with known truth, from a seed: they test whether estimators recover the truth, and show
//! nothing about people.
//!
//! Millimetres; x to the cuer's left, y up from the tip of the chin, z forward; a right-handed cuer. Sentences are
//! random syllables. No part of a session was captured: a program that writes one to a file must state this in the
//! file.

mod generate_face;
pub(super) mod generate_hand;
mod noise;

use chereme_motion::InterpolationKind;
use glam::{DMat3, DQuat, DVec3};

use chereme_sign::cue::{self, CuedUtterance};

use super::cue_hand::HandMarkerFrame;
use super::rigid::RigidMotion;
use generate_hand::hand_marker_positions;

pub use crate::random::RandomNumbers;
pub use generate_face::throat_weights;
pub use generate_hand::shape_angles;

/// Frames per second.
pub const GENERATED_FRAME_RATE: f64 = 120.0;
/// The number of joint angles of the generated hand: 4 of each finger, 4 of the thumb, 2 of the wrist.
pub const GENERATED_JOINT_COUNT: usize = 22;

/// The settings of a session.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CueGeneratorSettings {
    /// The seed; the same seed gives the same session.
    pub seed: u64,
    /// The scatter of joint angles at targets, in degrees.
    pub scatter: f64,
    /// How much the skin slides over the bones: 1 as measured, 0 not at all.
    pub skin: f64,
    /// Slow noise of soft tissue, for hand and face, in millimetres.
    pub soft: [f64; 2],
    /// Measurement noise, for hand and face, in millimetres.
    pub white: [f64; 2],
    /// The target minus the start of the sound: for pairs as a share of the consonant, for single vowels and for single
    /// consonants as a share of the key.
    pub phase: [f64; 3],
    /// The spread of phases in seconds: for pairs, and for single vowels and consonants.
    pub phase_sd: [f64; 2],
    /// The frequency of hidden markers: 1 as usual, 0 never.
    pub hidden: f64,
    /// The share of frames in which the labels of two neighbouring hand markers are swapped.
    pub swapped: f64,
}

impl Default for CueGeneratorSettings {
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
            swapped: 0.0,
        }
    }
}

/// A key with its true properties.
#[derive(Debug, Clone, PartialEq)]
pub struct TrueKey {
    /// The sounds: 0 a pair, 1 a single vowel, 2 a single consonant.
    pub kind: usize,
    /// The placement: 1 side, 2 mouth, 3 chin, 4 cheek, 5 throat.
    pub placement: u8,
    /// The number of the handshape.
    pub shape: u8,
    /// The acoustic start, the start of the vowel and the end, in seconds.
    pub sound: [f64; 3],
    /// The start and end of the hand's movement, and of the fingers' movement, in seconds.
    pub times: [f64; 4],
}

/// A generated take.
#[derive(Debug, Clone)]
pub struct GeneratedTake {
    /// The hand's markers as a camera system would record them.
    pub hand: Vec<HandMarkerFrame>,
    /// The true positions of the hand's markers.
    pub true_hand: Vec<Vec<DVec3>>,
    /// The face's markers as recorded.
    pub face: Vec<HandMarkerFrame>,
    /// The true positions of the face's markers.
    pub true_face: Vec<Vec<DVec3>>,
    /// The seven true parameters of the face in each frame.
    pub true_parameters: Vec<[f64; 7]>,
    /// The true joint angles of the hand in radians.
    pub true_angles: Vec<[f64; GENERATED_JOINT_COUNT]>,
    /// The head's motion in each frame.
    pub head: Vec<RigidMotion>,
    /// The phones with their start and end in seconds.
    pub phones: Vec<(String, f64, f64)>,
    /// The keys with their true properties.
    pub keys: Vec<TrueKey>,
}

/// Names of placements by their numbers.
pub const PLACEMENT_NAMES: [&str; 6] = ["rest", "side", "mouth", "chin", "cheek", "throat"];
/// The position of each placement (to the cuer's right, up and forward) and its spread for one cuer, in millimetres; and
/// the angle of the forearm in degrees.
const PLACEMENT_SPOTS_MM: [([f64; 3], [f64; 3], f64); 6] = [
    ([95.0, -130.0, 190.0], [10.0, 10.0, 8.0], 45.0),
    ([115.0, 46.0, 95.0], [17.0, 21.0, 8.0], 68.0),
    ([34.0, 40.0, 92.0], [7.0, 5.0, 8.0], 63.0),
    ([10.0, 14.0, 104.0], [9.0, 6.0, 8.0], 61.0),
    ([50.0, 75.0, 82.0], [9.0, 4.0, 8.0], 64.0),
    ([9.0, -52.0, 70.0], [11.0, 15.0, 8.0], 54.0),
];

/// The vowels and consonants of syllables with their keys, weights and milliseconds.
const SYLLABLE_VOWELS: [(&str, u8, f64, f64); 12] = [
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
const SYLLABLE_CONSONANTS: [(&str, u8, f64, f64); 16] = [
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

/// Returns a generated take of `syllables` random syllables; `number`, the sentence's place in the session, makes its
/// random numbers differ from those of the other sentences.
#[must_use]
pub fn generate_random_sentence(settings: &CueGeneratorSettings, number: u64, syllables: usize) -> GeneratedTake {
    let mut random = RandomNumbers::new(settings.seed.wrapping_mul(0x5851_F42D_4C95_7F2D) ^ number);
    let (phones, mut keys) = generate_random_syllables(&mut random, syllables);
    set_times(settings, &mut random, &mut keys);
    animate_generated_take(settings, &mut random, phones, keys, false)
}

/// Returns a generated take of a French text, which is pronounced by spelling rules; `None` if the text gives no key.
#[must_use]
pub fn generate_text_take(settings: &CueGeneratorSettings, number: u64, text: &str) -> Option<GeneratedTake> {
    let mut random = RandomNumbers::new(settings.seed.wrapping_mul(0x5851_F42D_4C95_7F2D) ^ number);
    let reading = cue::UtteranceReading {
        pace: Some(1.6),
        ..cue::UtteranceReading::default()
    };
    let read = CuedUtterance::read_cued_utterance(text, &reading).ok()?;
    let mut clock = 0.8;
    let mut phones = Vec::with_capacity(read.phones.len());
    for phone in &read.phones {
        let usual = phone.span?.span_micros() as f64 / 1e6;
        let length = usual * (0.2 * random.random_normal()).exp();
        phones.push((phone.label.clone(), clock, clock + length));
        clock += length;
    }
    let mut keys = Vec::with_capacity(read.keys.len());
    for key in &read.keys {
        let (first, last) = (phones.get(*key.from.first()?)?, phones.get(*key.from.last()?)?);
        let is_vowel = key.vowel.is_some();
        keys.push(TrueKey {
            kind: match (key.from.len(), is_vowel) {
                (2.., _) => 0,
                (_, true) => 1,
                (_, false) => 2,
            },
            placement: u8::try_from(cue::placement_number(&key.placement)).ok()?,
            shape: key.shape,
            sound: [first.1, if is_vowel { last.1 } else { last.2 }, last.2],
            times: [0.0; 4],
        });
    }
    if keys.is_empty() {
        return None;
    }
    phones.retain(|phone| !read.code.is_pause(&phone.0));
    set_times(settings, &mut random, &mut keys);
    Some(animate_generated_take(settings, &mut random, phones, keys, false))
}

/// Returns a take of the face alone: isolated vowels, and each consonant between two equal vowels a, i and u.
#[must_use]
pub fn generate_face_sounds(settings: &CueGeneratorSettings) -> GeneratedTake {
    let mut random = RandomNumbers::new(settings.seed ^ 0xFACE);
    let mut clock = 0.5;
    let mut phones = Vec::new();
    let mut say = |label: &str, seconds: f64| {
        phones.push((label.to_owned(), clock, clock + seconds));
        clock += seconds;
    };
    for vowel in SYLLABLE_VOWELS {
        say(vowel.0, 0.35);
        say("#", 0.25);
    }
    for consonant in SYLLABLE_CONSONANTS {
        for vowel in ["a", "i", "u"] {
            say(vowel, 0.2);
            say(consonant.0, 0.15);
            say(vowel, 0.2);
            say("#", 0.15);
        }
    }
    let mut take = animate_generated_take(settings, &mut random, phones, Vec::new(), true);
    take.hand.iter_mut().for_each(|frame| frame.fill(None));
    take
}

/// Draws the times of the hand's and the fingers' movement for each key.
fn set_times(settings: &CueGeneratorSettings, random: &mut RandomNumbers, keys: &mut [TrueKey]) {
    let mut late: f64 = 0.0;
    for key in keys {
        let [a1, a2, a3] = key.sound;
        let length = if key.kind == 0 { a2 - a1 } else { a3 - a1 };
        let sd = settings.phase_sd[usize::from(key.kind > 0)];
        let raw_m2 = a1 + settings.phase[key.kind] * length + sd * random.random_normal();
        let m2 = raw_m2.max(late + 0.08);
        let m1 = (a1 - 0.62 * (a3 - a1)).clamp(late, m2 - 0.07);
        let lead = 0.03 * random.random_share();
        key.times = [m1, m2, (m1 - lead).max(late), m2 - lead];
        late = m2;
    }
}

/// Returns a take of the hand alone in free space: all ordered pairs of the nine shapes, `times` times.
#[must_use]
pub fn generate_shape_transitions(settings: &CueGeneratorSettings, times: usize) -> GeneratedTake {
    // The face is not recorded, and nothing hides the hand.
    let mut random = RandomNumbers::new(settings.seed ^ 0xC0FF_EE00);
    let mut keys = Vec::new();
    let mut clock = 0.5;
    for _ in 0..times {
        for (from, to) in (0..9u8).flat_map(|a| (0..9u8).map(move |b| (a, b))) {
            for shape in [from, to] {
                if from != to {
                    keys.push(TrueKey {
                        kind: 0,
                        placement: 1,
                        shape,
                        sound: [clock, clock + 0.1, clock + 0.28],
                        times: [clock - 0.2, clock, clock - 0.2, clock],
                    });
                    clock += 0.28;
                }
            }
        }
    }
    let mut take = animate_generated_take(settings, &mut random, Vec::new(), keys, true);
    take.face.iter_mut().for_each(|frame| frame.fill(None));
    take
}

/// Phones with their start and end, and their keys.
type PhonesWithKeys = (Vec<(String, f64, f64)>, Vec<TrueKey>);

fn generate_random_syllables(random: &mut RandomNumbers, syllables: usize) -> PhonesWithKeys {
    let (mut phones, mut keys) = (Vec::new(), Vec::new());
    let mut clock = 0.8;
    let mut say = |random: &mut RandomNumbers, label: &str, ms: f64| {
        let length = ms / 1000.0 * 1.6 * (0.2 * random.random_normal()).exp();
        phones.push((label.to_owned(), clock, clock + length));
        clock += length;
        (clock - length, clock)
    };
    for _ in 0..syllables {
        let onset = (random.random_share() < 0.85).then(|| pick_weighted_sound(random, &SYLLABLE_CONSONANTS));
        let vowel = pick_weighted_sound(random, &SYLLABLE_VOWELS);
        let coda = (random.random_share() < 0.25).then(|| pick_weighted_sound(random, &SYLLABLE_CONSONANTS));
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
    // A coda and the vowel of a following syllable without onset form one key.
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

fn pick_weighted_sound<'a>(random: &mut RandomNumbers, of: &'a [(&'a str, u8, f64, f64)]) -> (&'a str, u8, f64, f64) {
    let all: f64 = of.iter().map(|entry| entry.2).sum();
    let mut left = random.random_share() * all;
    for it in of {
        left -= it.2;
        if left <= 0.0 {
            return *it;
        }
    }
    of[of.len() - 1]
}

fn animate_generated_take(
    settings: &CueGeneratorSettings,
    random: &mut RandomNumbers,
    phones: Vec<(String, f64, f64)>,
    keys: Vec<TrueKey>,
    free: bool,
) -> GeneratedTake {
    let spoken = phones.last().map_or(0.5, |phone| phone.2);
    let last = keys.last().map_or(spoken, |key| key.sound[2].max(key.times[1])) + 0.5;
    let frames = (last * GENERATED_FRAME_RATE).ceil() as usize;
    let scatter = settings.scatter.to_radians();
    let rest = (
        [0.0; GENERATED_JOINT_COUNT],
        draw_placement_spot(0, random),
        angle_of(0, random),
    );
    let mut postures = vec![(shape_angles(0), rest.1, rest.2)];
    for key in &keys {
        let mut angles = shape_angles(key.shape);
        for (n, angle) in angles.iter_mut().enumerate() {
            *angle += if n < 20 { scatter } else { 0.07 } * random.random_normal();
        }
        postures.push((
            angles,
            draw_placement_spot(key.placement, random),
            angle_of(key.placement, random),
        ));
    }
    let lags: Vec<f64> = (0..GENERATED_JOINT_COUNT)
        .map(|_| 0.05 * random.random_normal())
        .collect();
    let mut true_hand = Vec::with_capacity(frames);
    let (mut head, mut true_face) = (Vec::new(), Vec::new());
    let (mut true_parameters, mut true_angles) = (Vec::new(), Vec::new());
    let mut sway = [DVec3::ZERO; 2];
    let keep = (-1.0 / GENERATED_FRAME_RATE).exp();
    for frame in 0..frames {
        let time = frame as f64 / GENERATED_FRAME_RATE;
        let n = keys.partition_point(|key| key.times[0] <= time);
        let d = keys.partition_point(|key| key.times[2] <= time);
        let share = |from: f64, to: f64, lag: f64| {
            let progress = (time - from) / (to - from).max(1e-3);
            InterpolationKind::MinimumJerk
                .interpolation_share((progress - lag * progress * (1.0 - progress)).clamp(0.0, 1.0))
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
        let local = hand_marker_positions(&angles, settings.skin);
        let tip = super::cue_hand::HandModel::pointing_fingertip(&local, shape).unwrap_or(DVec3::ZERO);
        let before = n.checked_sub(2).map_or(0, |n| keys[n].shape);
        let other = super::cue_hand::HandModel::pointing_fingertip(&local, before).unwrap_or(tip);
        let blend = n
            .checked_sub(1)
            .map_or(1.0, |n| share(keys[n].times[0], keys[n].times[1], 0.0));
        let turn = hand_turn(level);
        sway = sway.map(|own| own * keep + random.random_normal_vector((1.0 - keep * keep).sqrt()));
        let motion = RigidMotion {
            rotation: DQuat::from_scaled_axis(sway[0] * 0.035),
            translation: sway[1] * 5.0,
        };
        let target = motion.apply_rigid_motion(at);
        let shift = target - turn * other.lerp(tip, blend);
        true_hand.push(local.iter().map(|at| turn * *at + shift).collect::<Vec<DVec3>>());
        let mouth_parameters = generate_face::mouth_parameters_at(&phones, time);
        true_face.push(generate_face::place_face(&motion, &mouth_parameters));
        head.push(motion);
        true_parameters.push(mouth_parameters);
        true_angles.push(angles);
    }
    let hand = noise::add_marker_noise(&true_hand, settings.soft[0], settings.white[0], random);
    let face = noise::add_marker_noise(&true_face, settings.soft[1], settings.white[1], random);
    let mut take = GeneratedTake {
        hand,
        true_hand,
        face,
        true_face,
        true_parameters,
        true_angles,
        head,
        phones,
        keys,
    };
    if settings.hidden > 0.0 {
        noise::hide_random_markers(&mut take, settings.hidden, settings.swapped, random);
    }
    take
}

fn draw_placement_spot(placement: u8, random: &mut RandomNumbers) -> DVec3 {
    let (at, sd, _) = PLACEMENT_SPOTS_MM[usize::from(placement).min(5)];
    let place = [0, 1, 2].map(|k| at[k] + sd[k] * random.random_normal());
    DVec3::new(-place[0], place[1], place[2])
}

fn angle_of(placement: u8, random: &mut RandomNumbers) -> f64 {
    (PLACEMENT_SPOTS_MM[usize::from(placement).min(5)].2 + 3.0 * random.random_normal()).to_radians()
}

/// Returns the rotation of the forearm: fingers up and to the left, the back of the hand to the front.
fn hand_turn(level: f64) -> DQuat {
    let along = DVec3::new(level.cos(), level.sin(), -0.25).normalize();
    let back = DVec3::Z.reject_from_normalized(along).normalize();
    DQuat::from_mat3(&DMat3::from_cols(along, back.cross(along), back)).normalize()
}
