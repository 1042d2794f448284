//! Infers from the movement itself how exactly hands hold the intended directions and handshapes.
//!
//! Human hands are some degrees off any direction that has a symbol; hands that a program moved by notation hold such
//! directions, or such handshapes, exactly. The exporter of the movement need not state which it is: the share of exact
//! frames exceeds chance only in synthesised movement.

use chereme_motion::Side;

use super::acts::signing;
use super::scene::Scene;
use super::tree::Sight;
use crate::transcribe::tuned::tuned;

/// Returns whether the hands keep directions or handshapes as exactly as synthesised ones.
pub(super) fn is_exact(scene: &Scene<'_>, sight: &Sight<'_>) -> bool {
    let (mut exact, mut all) = (0, 0);
    for track in scene.hands.iter().flatten() {
        // Transitions from and to rest have no intended direction.
        let signs: Vec<usize> = signing(scene, track).filter(|&n| !track.rests[n]).collect();
        let step = signs.len().div_ceil(tuned().precision.looked_at).max(1);
        for &frame in signs.iter().step_by(step) {
            all += 1;
            exact += usize::from(keeps(sight, track.side, frame));
        }
    }
    all > 0 && exact as f64 >= tuned().precision.many * all as f64
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
    let turned = seen.extended.residual < tuned().precision.turned[0]
        && seen
            .palm
            .as_ref()
            .is_some_and(|palm| palm.residual < tuned().precision.turned[1]);
    let shaped = seen
        .shape
        .as_ref()
        .is_some_and(|shape| shape.residual < tuned().precision.shaped);
    turned || shaped
}
