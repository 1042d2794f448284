//! Postures as the goals of motions: reached during the motion, reached at its end, or brushed in passing.

use chereme_sign::hamnosys::Each;

use super::super::tuned::tuned;
use super::*;

impl Planner<'_> {
    pub(super) fn target(
        &mut self,
        motion: Option<&Motion>,
        posture: &Posture,
        manner: &Manner,
        who: Who,
        time: f64,
        env: &Env,
    ) -> f64 {
        let mut named = self.addressed(posture, who);
        if let (Some(still), Some(Place::Body(_))) = (waiting(motion), &posture.place) {
            named[still] = None;
        }
        let posture = &self.of_acting(posture, who);
        let start = self.state.clone();
        let raised = [0, 1].map(|n| named[n].is_some() && !start[n].used);
        for n in (0..2).filter(|&n| raised[n]) {
            self.raise(n);
        }
        let before = self.state.clone();
        let planned = motion.map(|motion| self.motion(motion, who, time, env));
        let mut now = self.state.clone();
        for n in (0..2).filter(|&n| raised[n]) {
            now[n] = rested(&now[n], &before[n], &start[n]);
        }
        self.fixed = staying(motion, who);
        let lifted = self.lift(posture, named);
        self.assume(posture, named, true);
        if let Some(place) = &posture.place {
            self.placed();
            if self.fixed.is_none() {
                self.ease(place, named, None);
            }
        }
        self.fixed = None;
        self.lean(named, None);
        if motion.is_none() && posture.place.is_none() && !env.goes {
            self.about_wrist(&before, named);
        }
        let goal = self.state.clone();
        let contact = posture.place.as_ref().is_some_and(meets);
        let usual = if posture.place.is_some() {
            let far = (0..2).map(|n| before[n].wrist().distance(goal[n].wrist()));
            let far = far.fold(0.0, f64::max);
            self.signer
                .timed(self.signer.language.time_straight, far, env)
        } else {
            self.signer.language.time_replace * env.slower
        };
        let end = planned.unwrap_or(time + usual).max(time + 1e-3);
        let end = match planned {
            Some(_) => end,
            None => end.max(time + 0.6 * self.signer.longest(&before, &goal) * env.slower.min(1.0)),
        };
        let turned = acting(named).map(|(n, _)| before[n].rotation.angle_between(goal[n].rotation));
        let turned = turned.fold(0.0, f64::max);
        let steep = if contact { tuned().motion.hit } else { 1.0 };
        let end = end.max(time + tuned().motion.turning * steep * turned * env.slower);
        let pace = Pace::of(
            manner,
            if contact {
                Pace::Contact
            } else {
                Pace::Targetted
            },
        );
        if contact {
            self.hasten(time, pace, who);
        }
        let bent =
            posture.place.is_some() && self.signer.bends([&before, &now, &goal], motion, who);
        let end = match bent {
            true => {
                let far = (0..2).map(|n| before[n].wrist().distance(goal[n].wrist()));
                end.max(time + self.signer.timed(0.0, far.fold(0.0, f64::max), env))
            }
            false => end,
        };
        if posture.place.is_some() {
            self.straighten(time, end, pace, who);
        }
        self.state = now;
        self.lifted(lifted, &goal, [time, end]);
        if posture.place.as_ref().is_some_and(brushes) {
            for (n, _) in acting(named) {
                self.brush(n, &before[n], &goal[n], [time, end]);
            }
            return end;
        }
        for (n, _) in acting(named) {
            self.go(n, &goal[n], time, end, pace);
            if bent {
                self.late(n, time);
            }
            if posture.place.is_some() {
                self.plan.arrivals[n].push((time, end));
            }
            if motion.is_none() {
                self.phase(n, PhaseKind::Stroke, time, end, "to a posture");
            }
            if contact {
                let dwell = end + self.signer.language.time_contact;
                self.plan.contacts[n].push((end, dwell));
            }
        }
        if contact {
            end + self.signer.language.time_contact
        } else {
            end
        }
    }

    /// Makes hands that only turn, and touch nothing, turn about their wrists: people keep the arm still.
    fn about_wrist(&mut self, before: &[HandState; 2], named: Who) {
        if self.together.is_some() {
            return;
        }
        for (n, frame) in acting(named) {
            if self.skin(n, frame).is_none() {
                let state = &mut self.state[n];
                state.point = before[n].wrist() + state.rotation * state.offset;
            }
        }
    }

    /// Returns a posture that only the acting hand of two takes, if the other one signs already: it may be the goal, but
    /// keeps its own shape and orientation.
    fn of_acting(&self, posture: &Posture, who: Who) -> Posture {
        let (own, other) = match who {
            [Some(_), None] => (0, 1),
            [None, Some(_)] => (1, 0),
            _ => return posture.clone(),
        };
        if !self.state[other].used {
            return posture.clone();
        }
        Posture {
            shape: only(&posture.shape, own),
            extended: only(&posture.extended, own),
            palm: only(&posture.palm, own),
            place: posture.place.clone(),
        }
    }

    /// Makes the last straight path of a hand, from `time` on, accelerate: the hand leaves in the direction of the
    /// paths to which this one is added.
    fn late(&mut self, n: usize, time: f64) {
        let mut events = self.plan.events[n].iter_mut().rev();
        let last = events.find(|event| matches!(event.act, Act::Move(_)));
        if let Some(event) = last.filter(|event| (event.from - time).abs() < 1e-9)
            && let Act::Move(Path::Line(displacement)) = event.act
        {
            event.act = Act::Move(Path::Late(displacement));
        }
    }

    /// Makes a hand brush a place in the middle of its path, whether the path is already planned or
    /// continues.
    fn brush(&mut self, n: usize, before: &HandState, met: &HandState, [time, end]: [f64; 2]) {
        let planned = self.state[n].point - before.point;
        let come = met.point - before.point;
        let mut over = met.clone();
        let touched = if planned.length() > 1e-3 {
            let middle = (time + end) / 2.0;
            over.point = met.point + planned / 2.0;
            self.go(n, &over, time, middle, Pace::Lax);
            middle
        } else {
            let most = self.signer.language.move_small * self.signer.stage.arm;
            let onward = come.clamp_length_max(most);
            over.point = met.point + onward;
            self.go(n, &over, time, end, Pace::Linear);
            let share = come.length() / (come.length() + onward.length()).max(1e-9);
            time + (end - time) * share
        };
        self.phase(n, PhaseKind::Stroke, time, end, "brushing");
        self.plan.arrivals[n].push((time, touched));
        self.plan.contacts[n].push((touched, touched));
    }

    /// Extends straight paths that began at `time` until `end`: together with the rest of the distance to
    /// their goal they form one straight path, which stops only at its end.
    fn straighten(&mut self, time: f64, end: f64, pace: Pace, who: Who) {
        for (n, _) in acting(who) {
            for event in self.plan.events[n].iter_mut().rev() {
                if event.from < time - 1e-9 {
                    break;
                }
                let straight = matches!(event.act, Act::Move(Path::Line(_)));
                if straight && event.from <= time + 1e-9 {
                    (event.to, event.pace) = (end, pace);
                }
            }
        }
    }

    /// Gives the paths that began at `time` the pace of the movement after them.
    fn hasten(&mut self, time: f64, pace: Pace, who: Who) {
        for (n, _) in acting(who) {
            for event in self.plan.events[n].iter_mut().rev() {
                if event.from < time - 1e-9 {
                    break;
                }
                if event.pace == Pace::Targetted {
                    event.pace = pace;
                }
            }
        }
    }
}

impl Signer<'_> {
    /// Returns whether the rest of the path to the goal differs from the written direction, so that the hand starts in
    /// that direction and then turns to its goal.
    fn bends(
        &self,
        [before, planned, goal]: [&[HandState; 2]; 3],
        motion: Option<&Motion>,
        who: Who,
    ) -> bool {
        let straight = |motion: &Motion| match &motion.kind {
            MotionKind::Directed(path) => path.curve.is_none() && path.zigzag.is_none(),
            _ => false,
        };
        let least = 0.5 * self.language.move_small * self.stage.arm;
        motion.is_some_and(straight)
            && acting(who).any(|(n, _)| {
                let written = planned[n].point - before[n].point;
                let whole = goal[n].point - before[n].point;
                whole.length() > least
                    && written.length() > 1e-6
                    && written.angle_between(whole) > tuned().motion.bends
            })
    }

    fn longest(&self, a: &[HandState; 2], b: &[HandState; 2]) -> f64 {
        (0..2)
            .map(|n| self.length_between(&a[n], &b[n], n))
            .fold(0.0, f64::max)
    }
}

/// Returns a value that both hands share as that of one hand alone.
fn only<T: Clone>(each: &Each<T>, n: usize) -> Each<T> {
    match each {
        Each::Shared(value) if n == 0 => Each::Split(Some(value.clone()), None),
        Each::Shared(value) => Each::Split(None, Some(value.clone())),
        other => other.clone(),
    }
}

/// Returns the planned state of a hand that was raised in a trial, but hangs at rest.
fn rested(now: &HandState, raised: &HandState, start: &HandState) -> HandState {
    let mut own = now.clone();
    own.point += start.point - raised.point;
    if now.rotation == raised.rotation {
        (own.rotation, own.leaned) = (start.rotation, start.leaned);
    }
    if now.offset == raised.offset {
        own.offset = start.offset;
    }
    own
}

/// Returns the hand that stays in place in a motion that brings both together.
fn staying(motion: Option<&Motion>, who: Who) -> Option<usize> {
    waiting(motion).or_else(|| (0..2).find(|&n| who[n].is_none()))
}

/// Returns the hand for which a motion of both writes no movement, if there is one.
pub(super) fn waiting(motion: Option<&Motion>) -> Option<usize> {
    let still = |half: &Option<Box<Motion>>| match half {
        Some(half) => matches!(half.kind, MotionKind::Still),
        None => true,
    };
    match motion.map(|motion| &motion.kind) {
        Some(MotionKind::Split(own, other)) if still(own) != still(other) => {
            Some(usize::from(still(other)))
        }
        _ => None,
    }
}

fn brushes(place: &Place) -> bool {
    use chereme_sign::hamnosys::Contact::Brushing;
    match place {
        Place::Body(body) => body.contact == Some(Brushing),
        Place::Hand(site) => site.contact == Some(Brushing),
        Place::Hands(hands) => hands.contact == Some(Brushing),
        Place::Split(..) | Place::Named(_) => false,
    }
}

fn meets(place: &Place) -> bool {
    use chereme_sign::hamnosys::Contact::{Cross, Interlock, Touch};
    match place {
        Place::Body(body) => body.contact == Some(Touch),
        Place::Hand(site) => matches!(site.contact, Some(Touch | Cross | Interlock) | None),
        Place::Hands(hands) => matches!(hands.contact, Some(Touch | Cross | Interlock)),
        Place::Split(a, b) => [a, b].into_iter().flatten().any(|place| meets(place)),
        Place::Named(_) => false,
    }
}
