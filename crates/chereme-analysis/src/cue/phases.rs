//! Phases of keys: when hand and fingers begin to move and arrive, against the sounds.

use super::session::{Key, KeyGestures, KeySounds};
use super::targets::Quartiles;

/// The phases of keys of one kind: begin and arrival of the hand or the fingers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Phases {
    /// The sounds of the keys.
    pub kind: KeySounds,
    /// Whether the movements are those of the fingers; otherwise those of the hand.
    pub of_fingers: bool,
    /// The begin of the movement minus the start of the key's sound, in seconds.
    pub begins: Quartiles,
    /// The end of the movement minus the start of the key's sound, in seconds.
    pub arrives: Quartiles,
    /// The arrival as a share of the consonant for pairs, and of the key for others.
    pub share: Quartiles,
}

/// Returns the phases of measured keys by kind, for the hand and the fingers; a key with the same placement, or the
/// same shape, as the one before does not count.
#[must_use]
pub fn phases<'a>(
    takes: impl Iterator<Item = (&'a [Key], &'a [KeyGestures])> + Clone,
) -> Vec<Phases> {
    let mut found = Vec::new();
    for of_fingers in [false, true] {
        for kind in KeySounds::ALL {
            let (mut begins, mut arrives, mut shares) = (Vec::new(), Vec::new(), Vec::new());
            for (keys, shown) in takes.clone() {
                for (key, shown) in keys.iter().zip(shown) {
                    let own = if of_fingers {
                        shown.fingers
                    } else {
                        shown.hand
                    };
                    if key.kind != kind || !own.measured {
                        continue;
                    }
                    let end = if kind == KeySounds::Pair {
                        key.a2
                    } else {
                        key.a3
                    };
                    begins.push(own.movement.start - key.a1);
                    arrives.push(own.movement.end - key.a1);
                    shares.push((own.movement.end - key.a1) / (end - key.a1).max(0.01));
                }
            }
            if let (Some(begins), Some(arrives), Some(share)) = (
                Quartiles::of(&begins),
                Quartiles::of(&arrives),
                Quartiles::of(&shares),
            ) {
                found.push(Phases {
                    kind,
                    of_fingers,
                    begins,
                    arrives,
                    share,
                });
            }
        }
    }
    found
}
