//! Infers from the movement itself how exactly hands hold the intended directions and handshapes.
//!
//! Human hands are some degrees off any direction that has a symbol; hands that a program moved by notation hold such
//! directions, or such handshapes, exactly. The exporter of the movement need not state which it is: the share of exact
//! frames exceeds chance only in synthesised movement.

use chereme_motion::Side;

use super::acts::signing;
use super::scene::Scene;
use super::tree::Sight;

/// The largest error of a direction and of a palm that are held exactly, in degrees: by chance, one frame in a thousand
/// is this exact.
const TURNED: [f64; 2] = [1.2, 1.8];
/// The largest error of a handshape's angles that is held exactly, in degrees.
const SHAPED: f64 = 0.5;
/// The share of a signing hand's frames in which it must hold something exactly.
const MANY: f64 = 0.2;
/// The number of frames of each hand that are examined.
const LOOKED_AT: usize = 24;

/// Returns whether the hands keep directions or handshapes as exactly as synthesised ones.
pub(super) fn is_exact(scene: &Scene<'_>, sight: &Sight<'_>) -> bool {
    let (mut exact, mut all) = (0, 0);
    for track in scene.hands.iter().flatten() {
        // Transitions from and to rest have no intended direction.
        let signs: Vec<usize> = signing(scene, track).filter(|&n| !track.rests[n]).collect();
        let step = signs.len().div_ceil(LOOKED_AT).max(1);
        for &frame in signs.iter().step_by(step) {
            all += 1;
            exact += usize::from(keeps(sight, track.side, frame));
        }
    }
    all > 0 && exact as f64 >= MANY * all as f64
}

/// Returns whether a hand holds its direction and palm, or its handshape, exactly in a frame.
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
