//! Postures as the goals of motions: reached during the motion, reached at its end, or brushed in passing.

use chereme_sign::hamnosys::EachHand;

use super::super::notation_tuned::tuned;
use super::*;

impl SignPlanner<'_> {
    pub(super) fn plan_target_motion(
        &mut self,
        motion: Option<&NotatedMotion>,
        posture: &NotatedPosture,
        manner: &MotionManner,
        who: ActingHands,
        time: f64,
        env: &InheritedModifiers,
    ) -> f64 {
        let mut named = self.addressed_hands(posture, who);
        if let (Some(still), Some(HandPlace::Body(_))) = (waiting_hand_index(motion), &posture.place) {
            named[still] = None;
        }
        let posture = &self.of_acting(posture, who);
        let start = self.state.clone();
        let raised = [0, 1].map(|n| named[n].is_some() && !start[n].used);
        for n in (0..2).filter(|&n| raised[n]) {
            self.raise_resting_hand(n);
        }
        let before = self.state.clone();
        let planned = motion.map(|motion| self.plan_motion(motion, who, time, env));
        let mut now = self.state.clone();
        for n in (0..2).filter(|&n| raised[n]) {
            now[n] = rested(&now[n], &before[n], &start[n]);
        }
        self.fixed = staying(motion, who);
        let lifted = self.lift_touched_arms(posture, named);
        self.assume_posture(posture, named, true);
        if let Some(place) = &posture.place {
            self.note_placed_hands();
            if self.fixed.is_none() {
                self.ease_hand_places(place, named, None);
            }
        }
        self.fixed = None;
        self.lean_strained_hands(named, None);
        if motion.is_none() && posture.place.is_none() && !env.goes {
            self.about_wrist(&before, named);
        }
        let goal = self.state.clone();
        let contact = posture.place.as_ref().is_some_and(meets_other_hand);
        let usual = if posture.place.is_some() {
            let wrist_distances = (0..2).map(|n| before[n].wrist_position().distance(goal[n].wrist_position()));
            let far = wrist_distances.fold(0.0, f64::max);
            self.signer
                .limit_path_duration(self.signer.language.time_straight, far, env)
        } else {
            self.signer.language.time_replace * env.slower
        };
        let planned_end = planned.unwrap_or(time + usual).max(time + 1e-3);
        let end = match planned {
            Some(_) => planned_end,
            None => planned_end.max(time + 0.6 * self.signer.longest(&before, &goal) * env.slower.min(1.0)),
        };
        let turn_angles = iterate_acting_hands(named).map(|(n, _)| before[n].rotation.angle_between(goal[n].rotation));
        let turned = turn_angles.fold(0.0, f64::max);
        let steep = if contact { tuned().motion.hit } else { 1.0 };
        let end = end.max(time + tuned().motion.turning * steep * turned * env.slower);
        let pace = MovementPace::pace_from_manner(
            manner,
            if contact {
                MovementPace::Contact
            } else {
                MovementPace::Targetted
            },
        );
        if contact {
            self.hasten(time, pace, who);
        }
        let bent = posture.place.is_some() && self.signer.bends([&before, &now, &goal], motion, who);
        let end = match bent {
            true => {
                let far = (0..2).map(|n| before[n].wrist_position().distance(goal[n].wrist_position()));
                end.max(time + self.signer.limit_path_duration(0.0, far.fold(0.0, f64::max), env))
            }
            false => end,
        };
        if posture.place.is_some() {
            self.straighten(time, end, pace, who);
        }
        self.state = now;
        self.plan_lifted_arms(lifted, &goal, [time, end]);
        if posture.place.as_ref().is_some_and(brushes) {
            for (n, _) in iterate_acting_hands(named) {
                self.brush_place(n, &before[n], &goal[n], [time, end]);
            }
            return end;
        }
        for (n, _) in iterate_acting_hands(named) {
            self.go_to_hand_goal(n, &goal[n], time, end, pace);
            if bent {
                self.delay_last_path(n, time);
            }
            if posture.place.is_some() {
                self.plan.arrivals[n].push((time, end));
            }
            if motion.is_none() {
                self.add_hand_phase(n, PhaseKind::Stroke, time, end, "to a posture");
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
    fn about_wrist(&mut self, before: &[HandState; 2], named: ActingHands) {
        if self.together.is_some() {
            return;
        }
        for (n, frame) in iterate_acting_hands(named) {
            if self.skin_normal_at_hand(n, frame).is_none() {
                let state = &mut self.state[n];
                state.point = before[n].wrist_position() + state.rotation * state.offset;
            }
        }
    }

    /// Returns a posture that only the acting hand of two takes, if the other one signs already: it may be the goal, but
    /// keeps its own shape and orientation.
    fn of_acting(&self, posture: &NotatedPosture, who: ActingHands) -> NotatedPosture {
        let (own, other) = match who {
            [Some(_), None] => (0, 1),
            [None, Some(_)] => (1, 0),
            _ => return posture.clone(),
        };
        if !self.state[other].used {
            return posture.clone();
        }
        NotatedPosture {
            shape: only_hand_value(&posture.shape, own),
            extended: only_hand_value(&posture.extended, own),
            palm: only_hand_value(&posture.palm, own),
            place: posture.place.clone(),
        }
    }

    /// Makes the last straight path of a hand, from `time` on, accelerate: the hand leaves in the direction of the
    /// paths to which this one is added.
    fn delay_last_path(&mut self, n: usize, time: f64) {
        let mut events = self.plan.events[n].iter_mut().rev();
        let last = events.find(|event| matches!(event.act, HandAct::Move(_)));
        if let Some(event) = last.filter(|event| (event.from - time).abs() < 1e-9)
            && let HandAct::Move(HandPath::Line(displacement)) = event.act
        {
            event.act = HandAct::Move(HandPath::Late(displacement));
        }
    }

    /// Makes a hand brush a place in the middle of its path, whether the path is already planned or
    /// continues.
    fn brush_place(&mut self, n: usize, before: &HandState, met: &HandState, [time, end]: [f64; 2]) {
        let planned = self.state[n].point - before.point;
        let come = met.point - before.point;
        let mut over = met.clone();
        let touched = if planned.length() > 1e-3 {
            let middle = (time + end) / 2.0;
            over.point = met.point + planned / 2.0;
            self.go_to_hand_goal(n, &over, time, middle, MovementPace::Lax);
            middle
        } else {
            let most = self.signer.language.move_small * self.signer.stage.arm;
            let onward = come.clamp_length_max(most);
            over.point = met.point + onward;
            self.go_to_hand_goal(n, &over, time, end, MovementPace::Linear);
            let share = come.length() / (come.length() + onward.length()).max(1e-9);
            time + (end - time) * share
        };
        self.add_hand_phase(n, PhaseKind::Stroke, time, end, "brushing");
        self.plan.arrivals[n].push((time, touched));
        self.plan.contacts[n].push((touched, touched));
    }

    /// Extends straight paths that began at `time` until `end`: together with the rest of the distance to
    /// their goal they form one straight path, which stops only at its end.
    fn straighten(&mut self, time: f64, end: f64, pace: MovementPace, who: ActingHands) {
        for (n, _) in iterate_acting_hands(who) {
            for event in self.plan.events[n].iter_mut().rev() {
                if event.from < time - 1e-9 {
                    break;
                }
                let straight = matches!(event.act, HandAct::Move(HandPath::Line(_)));
                if straight && event.from <= time + 1e-9 {
                    (event.to, event.pace) = (end, pace);
                }
            }
        }
    }

    /// Gives the paths that began at `time` the pace of the movement after them.
    fn hasten(&mut self, time: f64, pace: MovementPace, who: ActingHands) {
        for (n, _) in iterate_acting_hands(who) {
            for event in self.plan.events[n].iter_mut().rev() {
                if event.from < time - 1e-9 {
                    break;
                }
                if event.pace == MovementPace::Targetted {
                    event.pace = pace;
                }
            }
        }
    }
}

impl NotationSigner<'_> {
    /// Returns whether the rest of the path to the goal differs from the written direction, so that the hand starts in
    /// that direction and then turns to its goal.
    fn bends(
        &self,
        [before, planned, goal]: [&[HandState; 2]; 3],
        motion: Option<&NotatedMotion>,
        who: ActingHands,
    ) -> bool {
        let straight = |motion: &NotatedMotion| match &motion.kind {
            MotionKind::Directed(path) => path.curve.is_none() && path.zigzag.is_none(),
            _ => false,
        };
        let least = 0.5 * self.language.move_small * self.stage.arm;
        motion.is_some_and(straight)
            && iterate_acting_hands(who).any(|(n, _)| {
                let written = planned[n].point - before[n].point;
                let displacement = goal[n].point - before[n].point;
                displacement.length() > least
                    && written.length() > 1e-6
                    && written.angle_between(displacement) > tuned().motion.bends
            })
    }

    fn longest(&self, a: &[HandState; 2], b: &[HandState; 2]) -> f64 {
        (0..2).map(|n| self.length_between(&a[n], &b[n], n)).fold(0.0, f64::max)
    }
}

/// Returns a value that both hands share as that of one hand alone.
fn only_hand_value<T: Clone>(each: &EachHand<T>, n: usize) -> EachHand<T> {
    match each {
        EachHand::Shared(value) if n == 0 => EachHand::Split(Some(value.clone()), None),
        EachHand::Shared(value) => EachHand::Split(None, Some(value.clone())),
        other => other.clone(),
    }
}

/// Returns the planned state of a hand that was raised in a trial, but hangs at rest.
fn rested(now: &HandState, raised: &HandState, start: &HandState) -> HandState {
    let mut rested_state = now.clone();
    rested_state.point += start.point - raised.point;
    if now.rotation == raised.rotation {
        (rested_state.rotation, rested_state.leaned) = (start.rotation, start.leaned);
    }
    if now.offset == raised.offset {
        rested_state.offset = start.offset;
    }
    rested_state
}

/// Returns the hand that stays in place in a motion that brings both together.
fn staying(motion: Option<&NotatedMotion>, who: ActingHands) -> Option<usize> {
    waiting_hand_index(motion).or_else(|| (0..2).find(|&n| who[n].is_none()))
}

/// Returns the hand for which a motion of both writes no movement, if there is one.
pub(super) fn waiting_hand_index(motion: Option<&NotatedMotion>) -> Option<usize> {
    let still = |half: &Option<Box<NotatedMotion>>| match half {
        Some(half) => matches!(half.kind, MotionKind::Still),
        None => true,
    };
    match motion.map(|motion| &motion.kind) {
        Some(MotionKind::Split(own, other)) if still(own) != still(other) => Some(usize::from(still(other))),
        _ => None,
    }
}

fn brushes(place: &HandPlace) -> bool {
    use chereme_sign::hamnosys::PlaceContact::Brushing;
    match place {
        HandPlace::Body(body) => body.contact == Some(Brushing),
        HandPlace::Hand(site) => site.contact == Some(Brushing),
        HandPlace::Hands(hands) => hands.contact == Some(Brushing),
        HandPlace::Split(..) | HandPlace::Named(_) => false,
    }
}

fn meets_other_hand(place: &HandPlace) -> bool {
    use chereme_sign::hamnosys::PlaceContact::{Cross, Interlock, Touch};
    match place {
        HandPlace::Body(body) => body.contact == Some(Touch),
        HandPlace::Hand(site) => matches!(site.contact, Some(Touch | Cross | Interlock) | None),
        HandPlace::Hands(hands) => matches!(hands.contact, Some(Touch | Cross | Interlock)),
        HandPlace::Split(a, b) => [a, b].into_iter().flatten().any(|place| meets_other_hand(place)),
        HandPlace::Named(_) => false,
    }
}
