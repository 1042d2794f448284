//! Infers from the movement itself how exactly hands keep what they mean.
//!
//! Hands of people are some degrees off any direction that has a symbol; hands that a program moved by
//! notation keep such directions, or such handshapes, exactly. Whoever exported the movement need not say
//! which it is: a share of frames that chance does not explain shows it.

use chereme_motion::Side;

use super::acts::signing;
use super::scene::Scene;
use super::tree::Sight;

/// A direction and a palm are kept exactly if they are off by less than these degrees: one frame in a
/// thousand is, by chance.
const TURNED: [f64; 2] = [1.2, 1.8];
/// A handshape is kept exactly if its angles are off by less than this, in degrees.
const SHAPED: f64 = 0.5;
/// Share of the frames of a signing hand in which it keeps something exactly.
const MANY: f64 = 0.2;
/// The number of frames of each hand that are looked at.
const LOOKED_AT: usize = 24;

/// Returns whether the hands keep directions or handshapes as exactly as synthesised ones.
pub(super) fn is_exact(scene: &Scene<'_>, sight: &Sight<'_>) -> bool {
    let (mut exact, mut all) = (0, 0);
    for track in scene.hands.iter().flatten() {
        // Ways from and to rest show nothing: nothing is meant on them.
        let signs: Vec<usize> = signing(scene, track).filter(|&n| !track.rests[n]).collect();
        let step = signs.len().div_ceil(LOOKED_AT).max(1);
        for &frame in signs.iter().step_by(step) {
            all += 1;
            exact += usize::from(keeps(sight, track.side, frame));
        }
    }
    all > 0 && exact as f64 >= MANY * all as f64
}

/// Returns whether a hand keeps its direction and palm, or its handshape, exactly in a frame.
fn keeps(sight: &Sight<'_>, side: Side, frame: usize) -> bool {
    let Some(track) = sight
        .scene
        .hands
        .iter()
        .flatten()
        .find(|track| track.side == side)
    else {
        return false;
    };
    let seen = sight.see(track, frame);
    let turned = seen.extended.residual < TURNED[0]
        && seen
            .palm
            .as_ref()
            .is_some_and(|palm| palm.residual < TURNED[1]);
    let shaped = seen
        .shape
        .as_ref()
        .is_some_and(|shape| shape.residual < SHAPED);
    turned || shaped
}
