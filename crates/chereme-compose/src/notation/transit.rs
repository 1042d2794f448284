//! Transitions of hands from one state to another.

use chereme_sign::hamnosys::Manual;

use super::comfort::Trail;
use super::motion::Env;
use super::pace::Pace;
use super::path::Path;
use super::plan::{Act, Event, HandState, PhaseKind, Planner, Who};

/// Smallest distance (arm lengths) between a wrist in transition and its shoulder.
const ROUND: f64 = 0.42;

/// Length of an approach as a multiple of the distance, because hands move around obstacles, rotate, and change their
/// pivot.
const ROUNDABOUT: f64 = 1.25;
/// Top speed (m/s) of a movement below which it does not limit the approach to it: the hand rotates or plays with its
/// fingers.
const SLOWEST: f64 = 0.12;

/// Returns the top speed (m/s) of a hand's paths; simultaneous ones add up.
fn fastest(events: &[Event]) -> f64 {
    const STEPS: usize = 8;
    let path = |event: &Event| match &event.act {
        Act::Move(path) => Some((event.from, event.to, event.pace, path.clone())),
        _ => None,
    };
    let paths: Vec<_> = events.iter().filter_map(path).collect();
    let each = paths.iter().map(|(from, to, pace, _)| {
        let same = paths
            .iter()
            .filter(|other| (other.0 - from).abs() + (other.1 - to).abs() < 1e-6);
        let same: Vec<_> = same.collect();
        let at = |n: usize| -> chereme_motion::glam::DVec3 {
            same.iter()
                .map(|(.., path)| path.at(n as f64 / STEPS as f64))
                .sum()
        };
        let length: f64 = (0..STEPS).map(|n| at(n).distance(at(n + 1))).sum();
        pace.peak() * length / (to - from).max(1e-3)
    });
    each.fold(0.0, f64::max)
}

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

    /// Returns the duration (s) of an approach that is no faster than the movements after it; 0 if these do not move
    /// the hands, and at most the body language's longest one.
    pub(super) fn unhurried(
        &mut self,
        part: &Manual,
        who: Who,
        [before, goal]: [&[HandState; 2]; 2],
    ) -> f64 {
        if part.actions.is_empty() || self.trail.is_some() {
            return 0.0;
        }
        let known = [0, 1].map(|n| self.plan.events[n].len());
        self.trail = Some(Trail::default());
        let slower = 1.0 / self.speed();
        let speeds = self.aside(|planner| {
            let mut now = 0.0;
            for action in &part.actions {
                let env = Env {
                    slower,
                    ..Env::default()
                };
                now = planner.motion(action, who, now, &env);
            }
            [0, 1].map(|n| fastest(&planner.plan.events[n][known[n]..]))
        });
        self.trail = None;
        let top = speeds.into_iter().fold(0.0, f64::max);
        if top < SLOWEST {
            return 0.0;
        }
        let far = (0..2).map(|n| before[n].wrist().distance(goal[n].wrist()));
        let far = far.fold(0.0, f64::max);
        (ROUNDABOUT * Pace::Calm.peak() * far / top).min(self.language.time_approach_most)
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
