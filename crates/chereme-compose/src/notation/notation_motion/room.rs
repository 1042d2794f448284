//! Moves circles that would lead into the trunk out of it, as a whole.

use super::super::notation_tuned::tuned;
use super::*;

/// The number of points of a circle that are tried.
const CIRCLE_TRIAL_POINTS: usize = 16;
/// Step by which a circle is moved, in metres.
const CIRCLE_MOVE_STEP_M: f64 = 0.01;
/// The largest number of such steps.
const MAX_CIRCLE_MOVE_STEPS: usize = 30;

impl SignPlanner<'_> {
    /// Moves the circle that acting hands have just been given forward or to their own side, until it is clear of the
    /// trunk. A circle on the skin stays there.
    pub(super) fn make_circle_room(&mut self, path: &HandPath, who: ActingHands, [from, to]: [f64; 2]) {
        for (n, frame) in iterate_acting_hands(who) {
            let Some(hand) = self.signer.stage.hand_of_side(self.signer.sides[n]) else {
                continue;
            };
            if self.skin_normal_at_hand(n, frame).is_some() {
                continue;
            }
            let stage = self.signer.stage;
            let sign = if frame.behind { -1.0 } else { 1.0 };
            let hand_path = path.map_path_vectors(|v| stage.body_to_model_direction(v * frame.axes * sign));
            let state = &self.state[n];
            let start = state.wrist_position() - hand_path.path_end();
            let outline = &self.plan.shapes[n][state.shape].outline.points;
            let deep = |by: DVec3| {
                let points = (0..=CIRCLE_TRIAL_POINTS).map(|at| {
                    let wrist = start + hand_path.path_point_at(at as f64 / CIRCLE_TRIAL_POINTS as f64) + by;
                    let part_points = outline.iter().map(|part| wrist + state.rotation * *part);
                    let parts = part_points.chain([wrist]);
                    let out = parts.map(|part| stage.torso.offset_out_of_trunk(part, tuned().solve.margin).length());
                    out.fold(0.0, f64::max)
                });
                points.fold(0.0, f64::max)
            };
            if deep(DVec3::ZERO) < tuned().motion.shallow {
                continue;
            }
            let outside = stage.left * hand.side.side_sign();
            let directions = [stage.forward, (stage.forward + outside).normalize()];
            let steps = (1..=MAX_CIRCLE_MOVE_STEPS)
                .flat_map(|step| directions.map(|direction| direction * (CIRCLE_MOVE_STEP_M * step as f64)));
            let Some(by) = steps.into_iter().find(|by| deep(*by) < tuned().motion.shallow) else {
                continue;
            };
            self.add_plan_remark(&format!(
                "the {} hand's circle is moved {:.0} cm, so that it stays out of the trunk",
                hand.side.body_side_name(),
                by.length() * 100.0
            ));
            self.state[n].point += by;
            self.plan.events[n].push(HandEvent {
                from,
                to: from + tuned().motion.soon * (to - from),
                pace: MovementPace::Linear,
                act: HandAct::Move(HandPath::Line(by)),
            });
        }
    }
}
