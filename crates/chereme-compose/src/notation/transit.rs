//! Transitions of hands from one state to another.

use std::f64::consts::PI;

use chereme_motion::glam::DVec3;

use super::notation_arm::{ArmBearing, ArmBoneRig};
use super::notation_path::HandPath;
use super::notation_plan::{HandAct, HandEvent, HandState, NotationSigner, PhaseKind, SignPlanner};
use super::notation_tuned::tuned;
use super::pace::MovementPace;

/// Bends of the path (arm lengths) that are tried in turn until the elbow keeps to `transit.behind`.
const TRANSIT_BENDS: [f64; 6] = [0.05, 0.1, 0.15, 0.2, 0.25, 0.3];
/// Shares of the path at which the elbow is compared with `transit.behind`.
const ELBOW_CHECK_SHARES: [f64; 3] = [0.25, 0.5, 0.75];

impl SignPlanner<'_> {
    /// Plans the transition of a hand from its current state to another, within a time span (s).
    pub(crate) fn go_to_hand_goal(&mut self, n: usize, goal: &HandState, from: f64, to: f64, pace: MovementPace) {
        let was = self.state[n].clone();
        let mut act = |act| {
            self.plan.events[n].push(HandEvent { from, to, pace, act });
        };
        if was.offset != goal.offset {
            act(HandAct::Point(goal.offset));
        }
        if was.rotation != goal.rotation {
            act(HandAct::Turn(goal.rotation));
        }
        if was.leaned != goal.leaned {
            act(HandAct::Lean(goal.leaned));
        }
        if was.shape != goal.shape {
            act(HandAct::Shape(goal.shape));
        }
        let displacement = goal.point - was.point;
        if displacement.length() > 1e-9 {
            act(HandAct::Move(HandPath::Line(displacement)));
        }
        self.state[n] = goal.clone();
    }

    /// Plans the way of a hand from one state to another, within a time span (s). From rest, and back to rest, the wrist
    /// follows the path and the hand turns about it: otherwise a hand that is placed by a fingertip would wander, as its
    /// turn moves the wrist. Near the posture of the sign the hand is placed by its own part again, and turns no more.
    pub(super) fn travel_to_goal(&mut self, n: usize, goal: &HandState, from: f64, to: f64, pace: MovementPace) {
        let was = self.state[n].clone();
        if was.used == goal.used {
            return self.go_to_hand_goal(n, goal, from, to, pace);
        }
        let placed = (to - from) * tuned().transit.placed;
        let (leaves, comes) = match was.used {
            true => (from + placed, to),
            false => (from, to - placed),
        };
        let mut plan = |[from, to]: [f64; 2], act| {
            self.plan.events[n].push(HandEvent { from, to, pace, act });
        };
        plan([from, leaves], HandAct::Point(DVec3::ZERO));
        let to_wrist = was.wrist_position() - was.point;
        plan([from, leaves], HandAct::Move(HandPath::Line(to_wrist)));
        if was.rotation != goal.rotation {
            plan([leaves, comes], HandAct::Turn(goal.rotation));
        }
        if was.leaned != goal.leaned {
            plan([leaves, comes], HandAct::Lean(goal.leaned));
        }
        if was.shape != goal.shape {
            plan([from, to], HandAct::Shape(goal.shape));
        }
        let displacement = goal.wrist_position() - was.wrist_position();
        plan([from, to], HandAct::Move(HandPath::Line(displacement)));
        plan([comes, to], HandAct::Point(goal.offset));
        let from_wrist = goal.point - goal.wrist_position();
        plan([comes, to], HandAct::Move(HandPath::Line(from_wrist)));
        self.state[n] = goal.clone();
    }

    /// Bends the path of a transition, where the arm needs that.
    pub(super) fn bend_transition_path(&mut self, n: usize, goal: &HandState, from: f64, to: f64, pace: MovementPace) {
        let Some(hand) = self.signer.stage.hand_of_side(self.signer.sides[n]) else {
            return;
        };
        let state = &self.state[n];
        let ends = [state.wrist_position(), goal.wrist_position()];
        let out = match state.used == goal.used {
            true => self.signer.led_round(&hand.rig, ends),
            false => self.signer.swung(&hand.rig, ends),
        };
        if let Some(out) = out {
            self.plan.events[n].push(HandEvent {
                from,
                to,
                pace,
                act: HandAct::Move(HandPath::Spring(out)),
            });
        }
    }

    /// Plans the return of hands to rest; returns its end.
    pub(super) fn relax_hands_to_rest(&mut self, hands: [bool; 2], from: f64, to: Option<f64>) -> f64 {
        let mut end = from;
        for (n, drops) in hands.into_iter().enumerate() {
            if !drops || !self.state[n].used {
                continue;
            }
            let rest = self.rest[n].clone();
            let length = 1.25 * self.signer.length_between(&self.state[n], &rest, n);
            let to = to.map_or(from + length, |to| to.max(from + length));
            self.bend_transition_path(n, &rest, from, to, MovementPace::Lax);
            self.travel_to_goal(n, &rest, from, to, MovementPace::Lax);
            self.add_hand_phase(n, PhaseKind::Transition, from, to, "");
            self.plan.away[n].push((from, to));
            end = end.max(to);
        }
        end
    }
}

impl NotationSigner<'_> {
    /// Returns the offset from the middle of a straight path from rest, or back, to where the wrist is when upper arm and
    /// elbow have turned half-way, as people turn them; limited by `transit.swung`.
    fn swung(&self, rig: &ArmBoneRig, [start, end]: [DVec3; 2]) -> Option<DVec3> {
        let along = (end - start).try_normalize()?;
        let ends = [start, end].map(|wrist| rig.reach_wrist_position(wrist, ArmBearing::default(), &self.limits));
        let middle = rig.wrist_between(&ends);
        let out = middle - ends[0].wrist.midpoint(ends[1].wrist);
        let outside = self.stage.left * rig.side.side_sign();
        let out = out - outside * ((1.0 - tuned().transit.outwards) * out.dot(outside).max(0.0));
        let most = tuned().transit.swung * start.distance(end);
        Some(out.reject_from_normalized(along).clamp_length_max(most))
    }

    /// Returns the offset from the middle of a straight path that leads it round the own shoulder, if the forearm would
    /// have to fold up, or forward, if the elbow would go behind the trunk; `None` if neither is the case.
    fn led_round(&self, rig: &ArmBoneRig, [start, end]: [DVec3; 2]) -> Option<DVec3> {
        let along = (end - start).try_normalize()?;
        let shoulder = rig.shoulder;
        let share = (shoulder - start).dot(along) / end.distance(start);
        let nearest = start.lerp(end, share.clamp(0.0, 1.0));
        let far = nearest.distance(shoulder);
        let ends = start.distance(shoulder).min(end.distance(shoulder));
        let missing = (tuned().transit.round * self.stage.arm).min(ends) - far;
        if missing <= 0.0 || !(0.0..1.0).contains(&share) {
            return self.needed_path_advance(rig, [start, end], along);
        }
        let outside = self.stage.left * rig.side.side_sign();
        let outward_sum = (nearest - shoulder) / self.stage.arm + self.stage.forward * 0.3 + outside * 0.1;
        let out = outward_sum.reject_from_normalized(along).try_normalize()?;
        // A spring is farthest out half-way.
        let there = (PI * share).sin().max(0.3);
        Some(out * (missing / there))
    }

    /// Returns by how much the middle of a straight path between two wrists must lie farther ahead so that the elbow does
    /// not go behind the trunk; `None` if it does not.
    fn needed_path_advance(&self, rig: &ArmBoneRig, [start, end]: [DVec3; 2], along: DVec3) -> Option<DVec3> {
        let forward = self.stage.forward;
        let out = forward.reject_from_normalized(along).try_normalize()?;
        let back = |wrist: DVec3| {
            let posed = rig.reach_wrist_position(wrist, ArmBearing::default(), &self.limits);
            -(posed.elbow - rig.shoulder).dot(forward) / self.stage.arm
        };
        let most = tuned().transit.behind.max(back(start)).max(back(end));
        let behind = |by: DVec3| {
            ELBOW_CHECK_SHARES
                .map(|share| back(start.lerp(end, share) + by * (PI * share).sin()))
                .into_iter()
                .any(|back| back > most)
        };
        if !behind(DVec3::ZERO) {
            return None;
        }
        let tried = TRANSIT_BENDS.map(|by| out * (by * self.stage.arm));
        let last = tried[TRANSIT_BENDS.len() - 1];
        Some(tried.into_iter().find(|by| !behind(*by)).unwrap_or(last))
    }

    /// Returns the duration of a transition between two states.
    pub(crate) fn length_between(&self, a: &HandState, b: &HandState, _n: usize) -> f64 {
        if a == b {
            return 0.0;
        }
        let l = self.language;
        let far = a.wrist_position().distance(b.wrist_position()) / self.stage.arm;
        let turn = a.rotation.angle_between(b.rotation) / std::f64::consts::FRAC_PI_2;
        l.time_transition + l.time_transition_arm * far + l.time_turn * turn
    }
}

#[cfg(test)]
mod tests {
    use chereme_sign::SignerHandedness;
    use chereme_sign::hamnosys::{BodyLanguage, BodyLocation, HandClass};

    use super::super::notation_stage::StandingBody;
    use super::super::notation_track::follow_hand_events;
    use super::super::pace::PaceTables;
    use super::super::tests::{at, mirrored, posture, stage};
    use super::*;
    use crate::testing::Axes;

    const RATE: f64 = 60.0;

    /// Returns the paths of both wrists from rest to a place before the body, in one second.
    fn raised(place: BodyLocation) -> [Vec<DVec3>; 2] {
        let material = stage(Axes::Plain);
        let body = StandingBody::body_from_material(&material).expect("a body");
        let paces = PaceTables::pace_tables_from_language(BodyLanguage::default_body_language());
        let language = BodyLanguage::default_body_language();
        let mut planner = SignPlanner::new(&body, language, &paces, SignerHandedness::Right, RATE);
        let who = planner.acting_part_hands(mirrored());
        let rest = planner.state.clone();
        let begun = posture(HandClass::Flat, "u", "l", Some(at(place, None)));
        planner.assume_posture(&begun, who, false);
        let goal = planner.state.clone();
        planner.state = rest;
        for (n, goal) in goal.iter().enumerate() {
            planner.bend_transition_path(n, goal, 0.0, 1.0, MovementPace::Lax);
            planner.travel_to_goal(n, goal, 0.0, 1.0, MovementPace::Lax);
        }
        [0, 1].map(|n| {
            let (start, events) = (&planner.plan.start[n], &planner.plan.events[n]);
            let path = follow_hand_events(start, events, RATE, RATE as usize + 2, |_, share| share);
            let path: Vec<DVec3> = path.goal_wrist_positions().collect();
            assert!(path[path.len() - 1].distance(goal[n].wrist_position()) < 1e-9);
            path
        })
    }

    #[test]
    fn hands_rise_from_rest_before_the_body_as_an_elbow_bends() {
        for place in [BodyLocation::Chest, BodyLocation::Chin, BodyLocation::HeadTop] {
            let [right, left] = raised(place);
            let (start, end) = (right[0], right[right.len() - 1]);
            let middle = right[right.len() / 2];
            let off = middle - start.midpoint(end);
            let share = off.length() / start.distance(end);
            assert!(off.z > 0.05, "{place:?}: {off}");
            assert!(share < tuned().transit.swung + 0.01, "{place:?}: {share}");
            for (right, left) in right.iter().zip(&left) {
                let mirror = *right * DVec3::new(-1.0, 1.0, 1.0);
                assert!(mirror.distance(*left) < 1e-9, "{place:?}: {right} {left}");
            }
        }
    }

    #[test]
    fn between_equal_postures_the_wrist_stays() {
        let material = stage(Axes::Plain);
        let body = StandingBody::body_from_material(&material).expect("a body");
        let limits =
            super::super::notation_arm::ArmLimits::arm_limits_from_language(BodyLanguage::default_body_language());
        let hand = body.hand_of_side(chereme_motion::BodySide::Right).expect("a hand");
        for by in [DVec3::new(0.1, -0.2, 0.3), DVec3::new(-0.1, 0.2, 0.25)] {
            let wrist = hand.rig.shoulder + by;
            let posed = hand.rig.reach_wrist_position(wrist, ArmBearing::default(), &limits);
            let middle = hand.rig.wrist_between(&[posed, posed]);
            assert!(middle.distance(posed.wrist) < 1e-9, "{middle} {wrist}");
        }
    }
}
