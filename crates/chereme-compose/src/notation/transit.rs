//! Transitions of hands from one state to another.

use super::pace::Pace;
use super::path::Path;
use super::plan::{Act, Event, HandState, PhaseKind, Planner};

/// Smallest distance (arm lengths) between a wrist in transition and its shoulder.
const ROUND: f64 = 0.42;

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
        if was.shape != goal.shape {
            act(Act::Shape(goal.shape));
        }
        let way = goal.point - was.point;
        if way.length() > 1e-9 {
            act(Act::Move(Path::Line(way)));
        }
        self.state[n] = goal.clone();
    }

    /// Leads a transition round the own shoulder if the forearm would have to fold up.
    pub(super) fn swing(&mut self, n: usize, goal: &HandState, from: f64, to: f64, pace: Pace) {
        let Some(hand) = self.stage.hand(self.sides[n]) else {
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
        let missing = (ROUND * self.stage.arm).min(ends) - far;
        if missing <= 0.0 || !(0.0..1.0).contains(&share) {
            return;
        }
        let outside = self.stage.left * self.sides[n].sign();
        let out = (nearest - shoulder) / self.stage.arm + self.stage.forward * 0.3 + outside * 0.1;
        let Some(out) = out.reject_from_normalized(along).try_normalize() else {
            return;
        };
        // A spring is farthest out half-way.
        let there = (std::f64::consts::PI * share).sin().max(0.3);
        self.plan.events[n].push(Event {
            from,
            to,
            pace,
            act: Act::Move(Path::Spring(out * (missing / there))),
        });
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

    /// Plans the return of hands to rest; returns its end.
    pub(super) fn relax(&mut self, hands: [bool; 2], from: f64, to: Option<f64>) -> f64 {
        let mut end = from;
        for (n, drops) in hands.into_iter().enumerate() {
            if !drops || !self.state[n].used {
                continue;
            }
            let rest = self.rest[n].clone();
            let length = 1.25 * self.length_between(&self.state[n], &rest, n);
            let to = to.map_or(from + length, |to| to.max(from + length));
            self.swing(n, &rest, from, to, Pace::Lax);
            self.go(n, &rest, from, to, Pace::Lax);
            self.phase(n, PhaseKind::Transition, from, to, "");
            end = end.max(to);
        }
        end
    }
}
