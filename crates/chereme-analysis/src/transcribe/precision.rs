//! Infers from the movement itself how exactly hands hold the intended directions and handshapes.
//!
//! Human hands are some degrees off any direction that has a symbol; hands that a program moved by notation hold such
//! directions, or such handshapes, exactly, and only a little off them where their movement was disturbed later. The
//! exporter of the movement need not state which it is: the share of exact frames exceeds chance only in synthesised
//! movement.

use super::acts::find_signing_frames;
use super::transcribe_scene::{HandTrajectory, SignerScene};
use super::transcribe_tree::SceneReadings;
use crate::transcribe::transcribe_tuned::tuned;

/// Returns the expected distance (m) between the hands and their places: that of synthesised movement, and as much more as
/// the hands are off directions or handshapes, at most that of the options. Captured hands keep these so exactly by
/// chance only.
pub(super) fn expected_place_slack(scene: &SignerScene<'_>, sight: &SceneReadings<'_>) -> f64 {
    let mut errors = Vec::new();
    for track in scene.hands.iter().flatten() {
        // Transitions from and to rest have no intended direction.
        let signs: Vec<usize> = find_signing_frames(scene, track).filter(|&n| !track.rests[n]).collect();
        let step = signs.len().div_ceil(tuned().precision.looked_at).max(1);
        let frames = signs.iter().step_by(step);
        errors.extend(frames.map(|&frame| hand_reading_error(sight, track, frame)));
    }
    errors.sort_by(f64::total_cmp);
    // Many hands are at least as exact as this.
    let many = (tuned().precision.many * errors.len() as f64).ceil() as usize;
    let error = many.checked_sub(1).map_or(f64::INFINITY, |n| errors[n]);
    let off = (tuned().precision.turned[0] * error).to_radians() * tuned().precision.lever;
    tuned().reading.made.hypot(off).min(sight.options.slack)
}

/// Returns the error of a hand's direction and palm, or of its handshape, in a frame, as a multiple of the error with which
/// synthesised hands hold them.
fn hand_reading_error(sight: &SceneReadings<'_>, track: &HandTrajectory, frame: usize) -> f64 {
    let seen = sight.read_hand_posture(track, frame);
    let [along, about] = tuned().precision.turned;
    let turned = seen.palm.as_ref().map_or(f64::INFINITY, |palm| {
        (seen.extended.residual / along).max(palm.residual / about)
    });
    let shaped = seen
        .shape
        .as_ref()
        .map_or(f64::INFINITY, |shape| shape.residual / tuned().precision.shaped);
    turned.min(shaped)
}
