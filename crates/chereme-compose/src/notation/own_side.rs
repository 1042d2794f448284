//! Keeps each hand of a mirrored movement on its own side of the signer's middle.
//!
//! Two mirrored hands that would pass through each other move outwards as a whole, so that both stay mirrored. Hands
//! that a sign crosses on purpose are left alone.

use chereme_motion::glam::DVec3;

use super::hands_apart::PartedMoment;
use super::notation_bulk::{PlacedHand, REPORTED_HAND_SHIFT_M};
use super::notation_plan::SignPlan;
use super::notation_solve::ease_push_vectors;
use super::notation_stage::{FINGER_FLESH, StagedHand, StandingBody};
use super::notation_track::HandGoalFrames;
use super::notation_tuned::tuned;

/// Moves the goals of mirrored hands outwards, wherever a hand reaches beyond the middle and neither touches anything;
/// returns the farthest move of each, if it is large enough to report.
pub(crate) fn keep_hands_own_side(
    stage: &StandingBody,
    plan: &SignPlan,
    hands: [&StagedHand; 2],
    wanted: [&mut HandGoalFrames<'_>; 2],
    rate: f64,
) -> Option<PartedMoment> {
    let total = wanted[0].points.len();
    let middle = stage.shoulder_middle();
    let length = hands[0].staged_hand_length();
    let outwards = [0, 1].map(|n| stage.left * plan.sides[n].side_sign());
    // Moves of the first hand; the other one makes the mirror image of each.
    let mut moves = vec![DVec3::ZERO; total];
    for (from, to) in &plan.mirrored {
        let [first, last] = [from, to].map(|time| ((time * rate) as usize).min(total));
        let frame_range = first..last;
        let touch = |frame: usize| {
            let both = wanted.iter().map(|one| one.touch[frame]);
            both.fold(0.0, f64::max)
        };
        let deep = |frame: usize| {
            let [a, b] = [0, 1].map(|n| wanted[n].points[frame] - middle);
            if (a - b).reject_from_normalized(stage.left).length() > tuned().own_side.like
                || (a + b).dot(stage.left).abs() > tuned().own_side.like
            {
                return 0.0;
            }
            let both = [0, 1].map(|n| {
                let hand = PlacedHand::posed_hand_at_frame(wanted[n], frame);
                let reach = hand.map(|hand| hand.least_plane_distance(middle, outwards[n]));
                reach.map_or(0.0, |least| FINGER_FLESH * length - least)
            });
            both[0].max(both[1]).max(0.0)
        };
        let depths: Vec<f64> = frame_range.clone().map(deep).collect();
        let most = depths.iter().copied().fold(0.0, f64::max);
        // Hands that touch each other may stay as deep as they are then.
        let frame_depths = frame_range.clone().zip(&depths);
        let touching_depths = frame_depths.filter(|(frame, _)| touch(*frame) > 0.5);
        let left = touching_depths
            .map(|(_, depth)| *depth)
            .fold(tuned().own_side.soft, f64::max);
        if !(left..tuned().own_side.crosses * length).contains(&most) {
            continue;
        }
        for (frame, depth) in frame_range.zip(depths) {
            moves[frame] = outwards[0] * ((depth - left).max(0.0) * (1.0 - touch(frame)));
        }
    }
    if moves.iter().all(|by| *by == DVec3::ZERO) {
        return None;
    }
    let near = ((tuned().own_side.around * rate).ceil() as usize).max(1);
    let mut most: Option<PartedMoment> = None;
    let [first, second] = wanted;
    for (frame, by) in ease_push_vectors(&moves, near).into_iter().enumerate() {
        first.points[frame] += by * (1.0 - first.touch[frame]);
        second.points[frame] -= by * (1.0 - second.touch[frame]);
        let by = by.length();
        if by > most.map_or(REPORTED_HAND_SHIFT_M, |most| most.by) {
            let time = frame as f64 / rate;
            most = Some(PartedMoment { time, by });
        }
    }
    most
}
