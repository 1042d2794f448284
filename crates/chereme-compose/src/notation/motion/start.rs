//! Positions at which hands start because of the movement that follows.

use chereme_sign::hamnosys::{Contact, Manual};

use super::*;

impl Planner<'_> {
    /// Starts a second hand that is half a period behind on the other side of its circle.
    pub(crate) fn start_behind(&mut self, part: &Manual, who: Who) {
        let Some(frame) = who[1].filter(|frame| frame.behind) else {
            return;
        };
        let skin = self.outwards(who);
        fn circle(motion: &Motion) -> Option<&Circular> {
            match &motion.kind {
                MotionKind::Circular(circular) => Some(circular),
                MotionKind::Repeated { motion, .. } => circle(motion),
                MotionKind::Parallel(all) | MotionKind::Sequence { motions: all, .. } => {
                    all.iter().find_map(circle)
                }
                MotionKind::Target { motion, .. } => circle(motion.as_deref()?),
                _ => None,
            }
        }
        let Some(circular) = part.actions.first().and_then(circle) else {
            return;
        };
        let l = self.signer.language;
        let radius = amount(
            &circular.size,
            [l.circle_small, l.circle_normal, l.circle_big],
        );
        let (start, _) = self.signer.rim(circular, radius, skin);
        let by = self.signer.stage.direction(start * frame.axes * -2.0);
        self.state[1].point += by;
    }

    /// Starts a hand that is close to the head, and moves to touch it there, towards the side from which its movement leads.
    pub(crate) fn start_against(&mut self, part: &Manual, who: Who) {
        let Some(Place::Body(place)) = &part.posture.place else {
            return;
        };
        let touched = |posture: &Posture| match &posture.place {
            Some(Place::Body(goal)) => {
                goal.contact == Some(Contact::Touch) && goal.site == place.site
            }
            Some(Place::Hands(hands)) => {
                let alone = who[0].is_none() || who[1].is_none();
                alone && hands.at.is_none() && hands.contact == Some(Contact::Touch)
            }
            _ => false,
        };
        let goal = part.actions.first().and_then(goal_of);
        let Some((_, motion, posture)) = goal.filter(|_| place.contact == Some(Contact::Close))
        else {
            return;
        };
        let Some(direction) = leads(motion).filter(|_| touched(posture)) else {
            return;
        };
        let near = self.signer.language.near_face * self.signer.stage.arm;
        for (n, frame) in acting(who) {
            let Some(out) = self.hands().out_of_head(n, place, frame) else {
                continue;
            };
            let from = -self.signer.stage.direction(direction * frame.axes);
            if (-0.3..0.7).contains(&from.dot(out)) {
                // Half-way to that side: from the side itself, a reader would take it for another place.
                self.state[n].point += ((from + out).normalize() - out) * near;
            }
        }
    }

    /// Starts a hand that is close to the other one, and moves to touch it, opposite to the direction of its
    /// movement, if it would come from another side. If both hands are placed (`named`), each gives way by half,
    /// so that they stay at their place.
    pub(crate) fn start_over(&mut self, part: &Manual, who: Who, named: Who) {
        let near = |place: &Option<Place>, contact: Contact| match place {
            Some(Place::Hands(hands)) => hands.contact == Some(contact),
            _ => false,
        };
        let goal = part.actions.first().and_then(goal_of);
        let Some((whole, motion, posture)) = goal else {
            return;
        };
        if !near(&part.posture.place, Contact::Close) || !near(&posture.place, Contact::Touch) {
            return;
        }
        let own = self.signer.own_frame();
        let (n, frame) = match (target::waiting(Some(motion)), who) {
            (Some(still), _) => (1 - still, own),
            (None, [Some(frame), None]) => (0, frame),
            (None, [None, Some(frame)]) => (1, frame),
            _ => return,
        };
        let Some(direction) = leads(motion) else {
            return;
        };
        let direction = self.signer.stage.direction(direction * frame.axes);
        let start = self.state[n].wrist();
        let end = self.unseen(|planner| {
            planner.motion(whole, who, 0.0, &Env::default());
            planner.state[n].wrist()
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
fn goal_of(motion: &Motion) -> Option<(&Motion, &Motion, &Posture)> {
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
fn leads(motion: &Motion) -> Option<DVec3> {
    match &motion.kind {
        MotionKind::Directed(path) => Some(mean(path.direction, path.second)),
        MotionKind::Parallel(all) => all.iter().find_map(leads),
        MotionKind::Split(own, other) => {
            [own, other].into_iter().flatten().find_map(|it| leads(it))
        }
        _ => None,
    }
}
