//! Turns hands to their notated direction and palm.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_sign::hamnosys::orientation;

use super::notation_plan::{HandState, SignPlanner};
use super::notation_tuned::tuned;

impl SignPlanner<'_> {
    /// Rotates a hand to its notated direction and palm.
    pub(crate) fn turn_hand_to_notation(&mut self, n: usize) {
        let state = &self.state[n];
        let [pointing, facing] = state.axes;
        // The palm's letter applies to a hand that points in this direction in its own frame.
        let direction = state.direction * pointing * facing;
        let [direction, palm] =
            oriented(direction, state.palm).map(|v| self.signer.stage.body_to_model_direction(v * facing));
        if let Some(rotation) = self
            .signer
            .stage
            .hand_joint_rotation(self.signer.sides[n], direction, palm)
        {
            self.state[n].rotation = rotation;
            self.state[n].leaned = DQuat::IDENTITY;
        }
    }

    /// Keeps the palm on its side if the hand's direction changes a little and the palm's letter does not: upright hands
    /// that lean to either side of the vertical read one letter in opposite ways.
    pub(crate) fn keep_side(&mut self, n: usize, before: &HandState) {
        let state = &self.state[n];
        let same = state.palm == before.palm && state.axes[1] == before.axes[1];
        let Some(hand) = self.signer.stage.hand_of_side(self.signer.sides[n]).filter(|_| same) else {
            return;
        };
        let [from, to] = [before.rotation, state.rotation].map(|turned| turned * hand.along);
        let led = (DQuat::from_rotation_arc(from, to) * before.rotation).normalize();
        if from.angle_between(to) < tuned().orient.leans
            && led.angle_between(state.rotation) > tuned().orient.turned_over
        {
            self.state[n].rotation = led;
        }
    }
}

/// Returns the directions of a hand's axis and palm (left, up, forward).
fn oriented(direction: DVec3, palm: f64) -> [DVec3; 2] {
    let faces = orientation::palm_direction_vector(direction.to_array(), palm);
    [direction, DVec3::from(faces)]
}
