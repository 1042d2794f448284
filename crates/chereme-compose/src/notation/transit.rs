//! Transitions of hands from one state to another.

use std::f64::consts::PI;

use chereme_motion::glam::DVec3;

use super::arm::{Bearing, Rig};
use super::pace::Pace;
use super::path::Path;
use super::plan::{Act, Event, HandState, PhaseKind, Planner, Signer};
use super::tuned::tuned;

/// Bends of the path (arm lengths) that are tried in turn until the elbow keeps to `transit.behind`.
const BENT: [f64; 6] = [0.05, 0.1, 0.15, 0.2, 0.25, 0.3];
/// Shares of the path at which the elbow is compared with `transit.behind`.
const LOOKED_AT: [f64; 3] = [0.25, 0.5, 0.75];

impl Planner<'_> {
    /// Plans the transition of a hand from its current state to another, within a time span (s).
    pub(crate) fn go(&mut self, n: usize, goal: &HandState, from: f64, to: f64, pace: Pace) {
        let was = self.state[n].clone();
        let mut act = |act| {
            self.plan.events[n].push(Event {
                from,
                to,
                pace,
                act,
            });
        };
        if was.offset != goal.offset {
            act(Act::Point(goal.offset));
        }
        if was.rotation != goal.rotation {
            act(Act::Turn(goal.rotation));
        }
        if was.leaned != goal.leaned {
            act(Act::Lean(goal.leaned));
        }
        if was.shape != goal.shape {
            act(Act::Shape(goal.shape));
        }
        let displacement = goal.point - was.point;
        if displacement.length() > 1e-9 {
            act(Act::Move(Path::Line(displacement)));
        }
        self.state[n] = goal.clone();
    }

    /// Plans the way of a hand from one state to another, within a time span (s). From rest, and back to rest, the wrist
    /// follows the path and the hand turns about it: otherwise a hand that is placed by a fingertip would wander, as its
    /// turn moves the wrist. Near the posture of the sign the hand is placed by its own part again, and turns no more.
    pub(super) fn travel(&mut self, n: usize, goal: &HandState, from: f64, to: f64, pace: Pace) {
        let was = self.state[n].clone();
        if was.used == goal.used {
            return self.go(n, goal, from, to, pace);
        }
        let placed = (to - from) * tuned().transit.placed;
        let (leaves, comes) = match was.used {
            true => (from + placed, to),
            false => (from, to - placed),
        };
        let mut plan = |[from, to]: [f64; 2], act| {
            self.plan.events[n].push(Event {
                from,
                to,
                pace,
                act,
            });
        };
        plan([from, leaves], Act::Point(DVec3::ZERO));
        let to_wrist = was.wrist() - was.point;
        plan([from, leaves], Act::Move(Path::Line(to_wrist)));
        if was.rotation != goal.rotation {
            plan([leaves, comes], Act::Turn(goal.rotation));
        }
        if was.leaned != goal.leaned {
            plan([leaves, comes], Act::Lean(goal.leaned));
        }
        if was.shape != goal.shape {
            plan([from, to], Act::Shape(goal.shape));
        }
        let displacement = goal.wrist() - was.wrist();
        plan([from, to], Act::Move(Path::Line(displacement)));
        plan([comes, to], Act::Point(goal.offset));
        let from_wrist = goal.point - goal.wrist();
        plan([comes, to], Act::Move(Path::Line(from_wrist)));
        self.state[n] = goal.clone();
    }

    /// Bends the path of a transition, where the arm needs that.
    pub(super) fn swing(&mut self, n: usize, goal: &HandState, from: f64, to: f64, pace: Pace) {
        let Some(hand) = self.signer.stage.hand(self.signer.sides[n]) else {
            return;
        };
        let state = &self.state[n];
        let ends = [state.wrist(), goal.wrist()];
        let out = match state.used == goal.used {
            true => self.signer.led_round(&hand.rig, ends),
            false => self.signer.swung(&hand.rig, ends),
        };
        if let Some(out) = out {
            self.plan.events[n].push(Event {
                from,
                to,
                pace,
                act: Act::Move(Path::Spring(out)),
            });
        }
    }

    /// Plans the return of hands to rest; returns its end.
    pub(super) fn relax(&mut self, hands: [bool; 2], from: f64, to: Option<f64>) -> f64 {
        let mut end = from;
        for (n, drops) in hands.into_iter().enumerate() {
            if !drops || !self.state[n].used {
                continue;
            }
            let rest = self.rest[n].clone();
            let length = 1.25 * self.signer.length_between(&self.state[n], &rest, n);
            let to = to.map_or(from + length, |to| to.max(from + length));
            self.swing(n, &rest, from, to, Pace::Lax);
            self.travel(n, &rest, from, to, Pace::Lax);
            self.phase(n, PhaseKind::Transition, from, to, "");
            self.plan.away[n].push((from, to));
            end = end.max(to);
        }
        end
    }
}

impl Signer<'_> {
    /// Returns the offset from the middle of a straight path from rest, or back, to where the wrist is when upper arm and
    /// elbow have turned half-way, as people turn them; limited by `transit.swung`.
    fn swung(&self, rig: &Rig, [start, end]: [DVec3; 2]) -> Option<DVec3> {
        let along = (end - start).try_normalize()?;
        let ends = [start, end].map(|wrist| rig.reach(wrist, Bearing::default(), &self.limits));
        let middle = rig.wrist_between(&ends);
        let out = middle - ends[0].wrist.midpoint(ends[1].wrist);
        let outside = self.stage.left * rig.side.sign();
        let out = out - outside * ((1.0 - tuned().transit.outwards) * out.dot(outside).max(0.0));
        let most = tuned().transit.swung * start.distance(end);
        Some(out.reject_from_normalized(along).clamp_length_max(most))
    }

    /// Returns the offset from the middle of a straight path that leads it round the own shoulder, if the forearm would
    /// have to fold up, or forward, if the elbow would go behind the trunk; `None` if neither is the case.
    fn led_round(&self, rig: &Rig, [start, end]: [DVec3; 2]) -> Option<DVec3> {
        let along = (end - start).try_normalize()?;
        let shoulder = rig.shoulder;
        let share = (shoulder - start).dot(along) / end.distance(start);
        let nearest = start.lerp(end, share.clamp(0.0, 1.0));
        let far = nearest.distance(shoulder);
        let ends = start.distance(shoulder).min(end.distance(shoulder));
        let missing = (tuned().transit.round * self.stage.arm).min(ends) - far;
        if missing <= 0.0 || !(0.0..1.0).contains(&share) {
            return self.ahead(rig, [start, end], along);
        }
        let outside = self.stage.left * rig.side.sign();
        let out = (nearest - shoulder) / self.stage.arm + self.stage.forward * 0.3 + outside * 0.1;
        let out = out.reject_from_normalized(along).try_normalize()?;
        // A spring is farthest out half-way.
        let there = (PI * share).sin().max(0.3);
        Some(out * (missing / there))
    }

    /// Returns by how much the middle of a straight path between two wrists must lie farther ahead so that the elbow does
    /// not go behind the trunk; `None` if it does not.
    fn ahead(&self, rig: &Rig, [start, end]: [DVec3; 2], along: DVec3) -> Option<DVec3> {
        let forward = self.stage.forward;
        let out = forward.reject_from_normalized(along).try_normalize()?;
        let back = |wrist: DVec3| {
            let posed = rig.reach(wrist, Bearing::default(), &self.limits);
            -(posed.elbow - rig.shoulder).dot(forward) / self.stage.arm
        };
        let most = tuned().transit.behind.max(back(start)).max(back(end));
        let behind = |by: DVec3| {
            LOOKED_AT
                .map(|share| back(start.lerp(end, share) + by * (PI * share).sin()))
                .into_iter()
                .any(|back| back > most)
        };
        if !behind(DVec3::ZERO) {
            return None;
        }
        let tried = BENT.map(|by| out * (by * self.stage.arm));
        let last = tried[BENT.len() - 1];
        Some(tried.into_iter().find(|by| !behind(*by)).unwrap_or(last))
    }

    /// Returns the duration of a transition between two states.
    pub(crate) fn length_between(&self, a: &HandState, b: &HandState, _n: usize) -> f64 {
        if a == b {
            return 0.0;
        }
        let l = self.language;
        let far = a.wrist().distance(b.wrist()) / self.stage.arm;
        let turn = a.rotation.angle_between(b.rotation) / std::f64::consts::FRAC_PI_2;
        l.time_transition + l.time_transition_arm * far + l.time_turn * turn
    }
}

#[cfg(test)]
mod tests {
    use chereme_sign::Handedness;
    use chereme_sign::hamnosys::{BodyLanguage, BodyLocation, HandClass};

    use super::super::pace::Paces;
    use super::super::stage::Stage;
    use super::super::tests::{at, mirrored, posture, stage};
    use super::super::track::goals;
    use super::*;
    use crate::testing::Axes;

    const RATE: f64 = 60.0;

    /// Returns the paths of both wrists from rest to a place before the body, in one second.
    fn raised(place: BodyLocation) -> [Vec<DVec3>; 2] {
        let material = stage(Axes::Plain);
        let body = Stage::of(&material).expect("a body");
        let paces = Paces::of(BodyLanguage::usual());
        let language = (BodyLanguage::usual(), &paces);
        let mut planner = Planner::new(&body, language, Handedness::Right, RATE);
        let who = planner.who(mirrored());
        let rest = planner.state.clone();
        let begun = posture(HandClass::Flat, "u", "l", Some(at(place, None)));
        planner.assume(&begun, who, false);
        let goal = planner.state.clone();
        planner.state = rest;
        for (n, goal) in goal.iter().enumerate() {
            planner.swing(n, goal, 0.0, 1.0, Pace::Lax);
            planner.travel(n, goal, 0.0, 1.0, Pace::Lax);
        }
        [0, 1].map(|n| {
            let (start, events) = (&planner.plan.start[n], &planner.plan.events[n]);
            let path = goals(start, events, RATE, RATE as usize + 2, |_, share| share);
            let path: Vec<DVec3> = path.wrists().collect();
            assert!(path[path.len() - 1].distance(goal[n].wrist()) < 1e-9);
            path
        })
    }

    #[test]
    fn hands_rise_from_rest_before_the_body_as_an_elbow_bends() {
        for place in [
            BodyLocation::Chest,
            BodyLocation::Chin,
            BodyLocation::HeadTop,
        ] {
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
        let body = Stage::of(&material).expect("a body");
        let limits = super::super::arm::Limits::of(BodyLanguage::usual());
        let hand = body.hand(chereme_motion::Side::Right).expect("a hand");
        for by in [DVec3::new(0.1, -0.2, 0.3), DVec3::new(-0.1, 0.2, 0.25)] {
            let wrist = hand.rig.shoulder + by;
            let posed = hand.rig.reach(wrist, Bearing::default(), &limits);
            let middle = hand.rig.wrist_between(&[posed, posed]);
            assert!(middle.distance(posed.wrist) < 1e-9, "{middle} {wrist}");
        }
    }
}
