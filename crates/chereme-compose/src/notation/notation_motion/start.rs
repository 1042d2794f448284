//! Positions at which hands start because of the movement that follows.

use chereme_sign::hamnosys::{ManualPart, PlaceContact};

use super::*;

impl SignPlanner<'_> {
    /// Starts a second hand that is half a period behind on the other side of its circle.
    pub(crate) fn start_behind(&mut self, part: &ManualPart, who: ActingHands) {
        let Some(frame) = who[1].filter(|frame| frame.behind) else {
            return;
        };
        let skin = self.circle_outward_direction(who);
        fn find_starting_circle(motion: &NotatedMotion) -> Option<&CircularPath> {
            match &motion.kind {
                MotionKind::Circular(circular) => Some(circular),
                MotionKind::Repeated { motion, .. } => find_starting_circle(motion),
                MotionKind::Parallel(all) | MotionKind::Sequence { motions: all, .. } => {
                    all.iter().find_map(find_starting_circle)
                }
                MotionKind::Target { motion, .. } => find_starting_circle(motion.as_deref()?),
                _ => None,
            }
        }
        let Some(circular) = part.actions.first().and_then(find_starting_circle) else {
            return;
        };
        let l = self.signer.language;
        let radius = amount_from_sizes(&circular.size, [l.circle_small, l.circle_normal, l.circle_big]);
        let (start, _) = self.signer.rim(circular, radius, skin);
        let by = self.signer.stage.body_to_model_direction(start * frame.axes * -2.0);
        self.state[1].point += by;
    }

    /// Starts a hand that is close to the head, and moves to touch it there, towards the side from which its movement leads.
    pub(crate) fn start_against(&mut self, part: &ManualPart, who: ActingHands) {
        let Some(HandPlace::Body(place)) = &part.posture.place else {
            return;
        };
        let touched = |posture: &NotatedPosture| match &posture.place {
            Some(HandPlace::Body(goal)) => goal.contact == Some(PlaceContact::Touch) && goal.site == place.site,
            Some(HandPlace::Hands(hands)) => {
                let alone = who[0].is_none() || who[1].is_none();
                alone && hands.at.is_none() && hands.contact == Some(PlaceContact::Touch)
            }
            _ => false,
        };
        let goal = part.actions.first().and_then(goal_of);
        let Some((_, motion, posture)) = goal.filter(|_| place.contact == Some(PlaceContact::Close)) else {
            return;
        };
        let Some(direction) = leads(motion).filter(|_| touched(posture)) else {
            return;
        };
        let near = self.signer.language.near_face * self.signer.stage.arm;
        for (n, frame) in iterate_acting_hands(who) {
            let Some(out) = self.planned_hands().out_of_head(n, place, frame) else {
                continue;
            };
            let from = -self.signer.stage.body_to_model_direction(direction * frame.axes);
            if (-0.3..0.7).contains(&from.dot(out)) {
                // Half-way to that side: from the side itself, a reader would take it for another place.
                self.state[n].point += ((from + out).normalize() - out) * near;
            }
        }
    }

    /// Starts a hand that is close to the other one, and moves to touch it, opposite to the direction of its
    /// movement, if it would come from another side. If both hands are placed (`named`), each gives way by half,
    /// so that they stay at their place.
    pub(crate) fn start_over(&mut self, part: &ManualPart, who: ActingHands, named: ActingHands) {
        let near = |place: &Option<HandPlace>, contact: PlaceContact| match place {
            Some(HandPlace::Hands(hands)) => hands.contact == Some(contact),
            _ => false,
        };
        let goal = part.actions.first().and_then(goal_of);
        let Some((whole, motion, posture)) = goal else {
            return;
        };
        if !near(&part.posture.place, PlaceContact::Close) || !near(&posture.place, PlaceContact::Touch) {
            return;
        }
        let signer_frame = self.signer.own_frame();
        let (n, frame) = match (motion_target::waiting_hand_index(Some(motion)), who) {
            (Some(still), _) => (1 - still, signer_frame),
            (None, [Some(frame), None]) => (0, frame),
            (None, [None, Some(frame)]) => (1, frame),
            _ => return,
        };
        let Some(direction) = leads(motion) else {
            return;
        };
        let direction = self.signer.stage.body_to_model_direction(direction * frame.axes);
        let start = self.state[n].wrist_position();
        let end = self.unseen(|planner| {
            planner.plan_motion(whole, who, 0.0, &InheritedModifiers::default());
            planner.state[n].wrist_position()
        });
        if (end - start).angle_between(direction) > tuned().motion.bends {
            let far = self.signer.language.hands_near * self.signer.stage.arm;
            let by = end - direction * far - start;
            let share = if named[1 - n].is_some() { 0.5 } else { 0.0 };
            self.state[n].point += by * (1.0 - share);
            self.state[1 - n].point -= by * share;
        }
    }
}

/// Returns a motion with a goal, its path, and the posture at its end; of a repeated motion, those of one repetition.
fn goal_of(motion: &NotatedMotion) -> Option<(&NotatedMotion, &NotatedMotion, &NotatedPosture)> {
    match &motion.kind {
        MotionKind::Target {
            motion: Some(path),
            posture,
        } => Some((motion, path, posture)),
        MotionKind::Repeated { motion, .. } => goal_of(motion),
        _ => None,
    }
}

/// Returns the direction in which a motion is written to lead (left, up, forward in the hand's frame).
fn leads(motion: &NotatedMotion) -> Option<DVec3> {
    match &motion.kind {
        MotionKind::Directed(path) => Some(mean_direction_vector(path.direction, path.second)),
        MotionKind::Parallel(all) => all.iter().find_map(leads),
        MotionKind::Split(own, other) => [own, other].into_iter().flatten().find_map(|part| leads(part)),
        _ => None,
    }
}
