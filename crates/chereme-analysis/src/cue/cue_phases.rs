//! Phases of keys: when hand and fingers begin to move and arrive, against the sounds.

use super::cue_targets::GestureQuartiles;
use super::session::{ExpectedCueKey, KeyGestures, KeySounds};

/// The phases of keys of one kind: begin and arrival of the hand or the fingers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KeyPhases {
    /// The sounds of the keys.
    pub kind: KeySounds,
    /// Whether the movements are those of the fingers; otherwise those of the hand.
    pub of_fingers: bool,
    /// The begin of the movement minus the start of the key's sound, in seconds.
    pub begins: GestureQuartiles,
    /// The end of the movement minus the start of the key's sound, in seconds.
    pub arrives: GestureQuartiles,
    /// The arrival as a share of the consonant for pairs, and of the key for others.
    pub share: GestureQuartiles,
}

/// Returns the phases of measured keys by kind, for the hand and the fingers; a key with the same placement, or the
/// same shape, as the one before does not count.
#[must_use]
pub fn measure_key_phases<'a>(
    takes: impl Iterator<Item = (&'a [ExpectedCueKey], &'a [KeyGestures])> + Clone,
) -> Vec<KeyPhases> {
    let mut phase_rows = Vec::new();
    for of_fingers in [false, true] {
        for kind in KeySounds::ALL_KEY_SOUNDS {
            let (mut begins, mut arrives, mut shares) = (Vec::new(), Vec::new(), Vec::new());
            for (keys, shown) in takes.clone() {
                for (key, shown) in keys.iter().zip(shown) {
                    let shown_gesture = if of_fingers { shown.fingers } else { shown.hand };
                    if key.kind != kind || !shown_gesture.measured {
                        continue;
                    }
                    let end = if kind == KeySounds::Pair { key.a2 } else { key.a3 };
                    begins.push(shown_gesture.movement.start - key.a1);
                    arrives.push(shown_gesture.movement.end - key.a1);
                    shares.push((shown_gesture.movement.end - key.a1) / (end - key.a1).max(0.01));
                }
            }
            if let (Some(begins), Some(arrives), Some(share)) = (
                GestureQuartiles::quartiles_from_numbers(&begins),
                GestureQuartiles::quartiles_from_numbers(&arrives),
                GestureQuartiles::quartiles_from_numbers(&shares),
            ) {
                phase_rows.push(KeyPhases {
                    kind,
                    of_fingers,
                    begins,
                    arrives,
                    share,
                });
            }
        }
    }
    phase_rows
}
