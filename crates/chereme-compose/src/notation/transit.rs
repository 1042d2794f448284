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

    /// Leads a transition round the own shoulder if the forearm would have to fold up, and bends its path forward if the
    /// elbow would go behind the trunk.
    pub(super) fn swing(&mut self, n: usize, goal: &HandState, from: f64, to: f64, pace: Pace) {
        let Some(hand) = self.signer.stage.hand(self.signer.sides[n]) else {
            return;
        };
        let (start, end) = (self.state[n].wrist(), goal.wrist());
        let shoulder = hand.rig.shoulder;
        let Some(along) = (end - start).try_normalize() else {
            return;
        };
        let share = (shoulder - start).dot(along) / end.distance(start);
        let nearest = start.lerp(end, share.clamp(0.0, 1.0));
        let far = nearest.distance(shoulder);
        let ends = start.distance(shoulder).min(end.distance(shoulder));
        let missing = (tuned().transit.round * self.signer.stage.arm).min(ends) - far;
        if missing <= 0.0 || !(0.0..1.0).contains(&share) {
            if let Some(out) = self.signer.ahead(&hand.rig, [start, end], along) {
                self.plan.events[n].push(Event {
                    from,
                    to,
                    pace,
                    act: Act::Move(Path::Spring(out)),
                });
            }
            return;
        }
        let outside = self.signer.stage.left * self.signer.sides[n].sign();
        let out = (nearest - shoulder) / self.signer.stage.arm
            + self.signer.stage.forward * 0.3
            + outside * 0.1;
        let Some(out) = out.reject_from_normalized(along).try_normalize() else {
            return;
        };
        // A spring is farthest out half-way.
        let there = (PI * share).sin().max(0.3);
        self.plan.events[n].push(Event {
            from,
            to,
            pace,
            act: Act::Move(Path::Spring(out * (missing / there))),
        });
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
            end = end.max(to);
        }
        end
    }
}

impl Signer<'_> {
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
