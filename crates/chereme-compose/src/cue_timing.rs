//! Computes the times at which the hand and the fingers move for each key, by a rule of phases.

use chereme_sign::cue::HandCueKey;
use serde::{Deserialize, Serialize};

/// The rule that decides when the hand moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PhaseRule {
    /// Gibert et al. (2004): the target is in the middle of a consonant, or at the start of a vowel or consonant alone.
    #[default]
    Paper,
    /// Attina et al. (2003, 2005): shares of the key's length, measured on one cuer in a laboratory.
    Attina,
    /// The revised rules of SPPAS: shares of the mean length of keys.
    Sppas,
    /// Duchnowski et al. (2000): 100 ms before the sound, after a transition of 150 ms.
    Duchnowski,
    /// The medians of the corpus's own captured keys.
    Measured,
}

impl PhaseRule {
    /// Every rule.
    pub const ALL_PHASE_RULES: [Self; 5] = [Self::Paper, Self::Attina, Self::Sppas, Self::Duchnowski, Self::Measured];

    /// Returns the word recipes print.
    #[must_use]
    pub fn phase_rule_name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Attina => "attina",
            Self::Sppas => "sppas",
            Self::Duchnowski => "duchnowski",
            Self::Measured => "measured",
        }
    }

    /// Returns whether this is the default rule.
    #[must_use]
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// Measured phases: the median of (target − start of the sound), by type of key, with their counts.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CuePhases {
    /// For a consonant with a vowel, as a share of the consonant.
    pub pair: f64,
    /// For a vowel alone, in seconds.
    pub vowel: f64,
    /// For a consonant alone, in seconds.
    pub consonant: f64,
    /// The number of measured keys of each type: pairs, vowels, consonants.
    pub counts: [usize; 3],
}

/// The type of a key, by its sounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum KeyType {
    /// A consonant and the vowel after it.
    Pair,
    /// A vowel alone.
    Vowel,
    /// A consonant alone.
    Consonant,
}

/// The times of a key's sounds in seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KeySoundTimes {
    /// The type of the key.
    pub kind: KeyType,
    /// The acoustic start of the key.
    pub a1: f64,
    /// The start of its vowel, if it has one after a consonant.
    pub a2: f64,
    /// Its end.
    pub a3: f64,
}

/// The times at which the hand and the fingers move for a key, in seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KeyTimes {
    /// The hand leaves the place of the previous key.
    pub m1: f64,
    /// The hand is at its target.
    pub m2: f64,
    /// The fingers begin to change.
    pub d1: f64,
    /// The fingers have their new shape.
    pub d2: f64,
}

/// The share of the key's length before its start at which the hand leaves for it (Attina 2005).
const HAND_LEAVE_SHARE: f64 = 0.62;
/// The least time between two targets, in seconds.
const MIN_TARGET_GAP_S: f64 = 0.06;

/// Returns the sounds of keys; `None` if a key has no times.
#[must_use]
pub fn key_sound_times(keys: &[HandCueKey]) -> Option<Vec<KeySoundTimes>> {
    let mut sounds: Vec<KeySoundTimes> = Vec::with_capacity(keys.len());
    for (n, key) in keys.iter().enumerate() {
        let span = key.span?;
        let (mut a1, a3) = (
            span.span_start_instant().instant_seconds(),
            span.span_end_instant().instant_seconds(),
        );
        let glides = n > 0 && key.from.len() == 1 && keys[n - 1].from.last() == key.from.first();
        if glides {
            // The second placement of a diphthong gets the second half of its time.
            a1 = (a1 + a3) / 2.0;
            if let Some(before) = sounds.last_mut() {
                before.a3 = a1;
            }
        }
        let vowel = key.vowel.map(|vowel| vowel.span_start_instant().instant_seconds());
        let (kind, a2) = match vowel {
            Some(start) if key.phones.len() > 1 => (KeyType::Pair, start.max(a1)),
            Some(_) => (KeyType::Vowel, a1),
            None => (KeyType::Consonant, a3),
        };
        sounds.push(KeySoundTimes { kind, a1, a2, a3 });
    }
    Some(sounds)
}

/// Returns the times at which hand and fingers move for each key.
///
/// A movement never begins before the previous one has reached its target. Targets keep the times of the rule, unless
/// the previous target is later or nearly as late.
#[must_use]
pub fn plan_key_times(sounds: &[KeySoundTimes], rule: PhaseRule, measured: &CuePhases) -> Vec<KeyTimes> {
    let mean = sounds.iter().map(|sound| sound.a3 - sound.a1).sum::<f64>() / sounds.len().max(1) as f64;
    let mut all: Vec<KeyTimes> = Vec::with_capacity(sounds.len());
    for (n, sound) in sounds.iter().enumerate() {
        let mut key_times = ideal_key_times(sound, rule, measured, mean);
        if let Some(before) = n.checked_sub(1).and_then(|n| all.get(n)) {
            key_times.m2 = key_times.m2.max(before.m2 + MIN_TARGET_GAP_S);
            key_times.d2 = key_times.d2.max(before.d2 + MIN_TARGET_GAP_S);
            key_times.m1 = key_times.m1.clamp(before.m2, key_times.m2);
            key_times.d1 = key_times.d1.clamp(before.d2, key_times.d2);
        }
        all.push(key_times);
    }
    all
}

/// Returns the times that a rule gives for one key, regardless of other keys; `mean` is the mean length of keys.
fn ideal_key_times(sound: &KeySoundTimes, rule: PhaseRule, measured: &CuePhases, mean: f64) -> KeyTimes {
    let (a1, d) = (sound.a1, sound.a3 - sound.a1);
    let consonant = sound.a2 - a1;
    let together = |target: f64| KeyTimes {
        m1: (a1 - HAND_LEAVE_SHARE * d).min(target - MIN_TARGET_GAP_S),
        m2: target,
        d1: (a1 - HAND_LEAVE_SHARE * d).min(target - MIN_TARGET_GAP_S),
        d2: target,
    };
    let spread = |m1: f64, m2: f64, d1: f64, d2: f64| KeyTimes {
        m1: a1 + m1,
        m2: a1 + m2,
        d1: a1 + d1,
        d2: a1 + d2,
    };
    match (rule, sound.kind) {
        (PhaseRule::Paper, KeyType::Pair) => together(a1 + consonant / 2.0),
        (PhaseRule::Paper, _) => together(a1),
        (PhaseRule::Measured, KeyType::Pair) => together(a1 + measured.pair * consonant),
        (PhaseRule::Measured, KeyType::Vowel) => together(a1 + measured.vowel),
        (PhaseRule::Measured, KeyType::Consonant) => together(a1 + measured.consonant),
        (PhaseRule::Attina, KeyType::Vowel) => spread(-0.46 * d, 0.21 * d, -0.36 * d, 0.0),
        (PhaseRule::Attina, _) => spread(-0.62 * d, 0.10 * d, -0.54 * d, 0.0),
        (PhaseRule::Sppas, KeyType::Pair) => spread(-(0.8 * mean).max(0.35), 0.11 * mean, -0.65 * mean, -0.4 * mean),
        (PhaseRule::Sppas, KeyType::Consonant) => {
            spread(-(1.6 * mean).max(0.5), -0.3 * mean, -1.15 * mean, -0.55 * mean)
        }
        (PhaseRule::Sppas, KeyType::Vowel) => {
            spread(-(2.4 * mean).max(0.6), -0.6 * mean, -(1.8 * mean).max(0.4), -1.2 * mean)
        }
        (PhaseRule::Duchnowski, _) => spread(-0.25, -0.1, -0.25, -0.1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pair, a vowel alone and a consonant alone, 300 ms each.
    fn three() -> Vec<KeySoundTimes> {
        let sound = |kind, a1: f64, a2: f64| KeySoundTimes {
            kind,
            a1,
            a2,
            a3: a1 + 0.3,
        };
        vec![
            sound(KeyType::Pair, 1.0, 1.1),
            sound(KeyType::Vowel, 1.3, 1.3),
            sound(KeyType::Consonant, 1.6, 1.9),
        ]
    }

    #[test]
    fn each_timing_rule_places_targets_as_its_source_states() {
        let measured = CuePhases {
            pair: 0.25,
            vowel: 0.02,
            consonant: -0.03,
            counts: [30; 3],
        };
        let cases = [
            (PhaseRule::Paper, [1.05, 1.3, 1.6]),
            (PhaseRule::Attina, [1.03, 1.363, 1.63]),
            (PhaseRule::Sppas, [1.033, 1.12, 1.51]),
            (PhaseRule::Duchnowski, [0.9, 1.2, 1.5]),
            (PhaseRule::Measured, [1.025, 1.32, 1.57]),
        ];
        for (rule, expected) in cases {
            let found = plan_key_times(&three(), rule, &measured);
            for (key, expected) in found.iter().zip(expected) {
                assert!((key.m2 - expected).abs() < 1e-9, "{rule:?} {key:?}");
            }
        }
    }

    #[test]
    fn cued_movements_never_overlap() {
        for rule in PhaseRule::ALL_PHASE_RULES {
            let found = plan_key_times(&three(), rule, &CuePhases::default());
            for pair in found.windows(2) {
                assert!(pair[1].m1 >= pair[0].m2 && pair[1].d1 >= pair[0].d2, "{rule:?}");
            }
            assert!(found.iter().all(|it| it.m1 <= it.m2 && it.d1 <= it.d2));
        }
    }
}
