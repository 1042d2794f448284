//! The motions of a hand: ways, swaying, and what changes on the way.

use super::*;

impl Writer<'_> {
    /// Writes a way through space.
    pub(super) fn way(&mut self, track: &Track, act: &Act) -> Motion {
        let Kind::Way(fitted) = &act.kind else {
            return Motion::new(MotionKind::Still);
        };
        self.told_movement(track, act, fitted.residual, fitted.runner_up);
        let first = *act.frames.start();
        let l = self.scene.language;
        let arm = self.scene.arm;
        let course = |writer: &mut Self, v: DVec3| {
            let found = aim::nearest(v.normalize_or(DVec3::Z), false);
            writer.told(FeatureKind::Course, Some(track), first, &found, aimed);
            found.best.first
        };
        if let Way::Circle {
            axis,
            long,
            narrow,
            start,
            ..
        } = fitted.way
        {
            let axis = course(self, axis);
            let size = sized(
                long.length() / arm,
                [l.circle_small, l.circle_normal, l.circle_big],
            );
            self.told_size(track, first, &size);
            return Motion::new(MotionKind::Circular(circular(
                axis, size.best, long, narrow, start, l,
            )));
        }
        let chord = fitted.way.chord();
        let direction = course(self, chord);
        let size = sized(
            chord.length() / arm,
            [l.move_small, l.move_normal, l.move_big],
        );
        self.told_size(track, first, &size);
        let mut directed = Directed {
            direction,
            second: None,
            size: Amount {
                first: size.best,
                second: None,
            },
            curve: None,
            zigzag: None,
            ellipse: None,
        };
        match fitted.way {
            Way::Arc { chord, bow } => {
                let back = aim::from_out(DVec3::from(direction.vector())).inverse();
                let flat = back * bow;
                let deep = bow.length() / chord.length().max(1e-9);
                directed.curve = Some(Curve {
                    to: Compass::nearest((-flat.x).atan2(-flat.y)),
                    size: sized(deep, [l.arc_small, l.arc_normal, l.arc_big]).best,
                });
            }
            Way::Wave { width, wavy, .. } => {
                directed.zigzag = Some(Zigzag {
                    wavy,
                    size: sized(width / arm, [l.zigzag_small, l.zigzag_normal, l.zigzag_big]).best,
                    growth: None,
                });
            }
            _ => {}
        }
        Motion::new(MotionKind::Directed(directed))
    }

    /// Writes a wrist or fingers going to and fro.
    pub(super) fn sway(&mut self, track: &Track, sway: &Sway, first: usize) -> Motion {
        let l = self.scene.language;
        let told = |writer: &mut Self, runner_up| {
            let found = Found {
                best: sway.name(),
                residual: 0.0,
                runner_up,
            };
            writer.told(
                FeatureKind::Movement,
                Some(track),
                first,
                &found,
                |name: &&str| (*name).to_owned(),
            );
        };
        match sway {
            Sway::Play { digits } => {
                told(self, None);
                let fingers =
                    digits.0.len() == 4 && !digits.contains(chereme_sign::hamnosys::Digit::Thumb);
                let digits = if fingers {
                    Default::default()
                } else {
                    digits.clone()
                };
                Motion::new(MotionKind::FingerPlay(digits))
            }
            Sway::Wrist {
                motion,
                angle,
                cycles: _,
                ..
            } => {
                told(self, None);
                let usual = match motion {
                    WristMotion::Nodding => l.wrist_nodding,
                    WristMotion::Swinging => l.wrist_swinging,
                    WristMotion::Twisting => l.wrist_twisting,
                    WristMotion::StirCw | WristMotion::StirCcw => l.wrist_stirring,
                };
                let size = sized(
                    angle.to_degrees() / usual,
                    [l.wrist_small, 1.0, l.wrist_big],
                );
                self.told_size(track, first, &size);
                Motion::new(MotionKind::Wrist {
                    motion: *motion,
                    size: size.best,
                })
            }
        }
    }

    /// Writes what is otherwise at the end of an act: shape, direction, palm.
    pub(super) fn changed(
        &mut self,
        track: &Track,
        act: &Act,
        first: usize,
        last: usize,
    ) -> Posture {
        let mut posture = Posture::default();
        if !act.turned && !act.reshaped {
            return posture;
        }
        let (before, after) = (self.see(track, first), self.see(track, last));
        let best = |seen: &Seen| seen.shape.as_ref().map(|found| found.best.clone());
        let mut which = [false; 3];
        if let Some(shape) = best(&after).filter(|_| act.reshaped && best(&before) != best(&after))
        {
            posture.shape = Each::Shared(shape);
            which[0] = true;
        }
        let palm = |seen: &Seen| seen.palm.as_ref().map(|found| found.best);
        if act.turned {
            which[1] = before.extended.best != after.extended.best;
            which[2] = palm(&before) != palm(&after);
            if which[1] {
                posture.extended = Each::Shared(after.extended.best);
            }
            if let Some(palm) = palm(&after).filter(|_| which[2]) {
                posture.palm = Each::Shared(palm);
            }
        }
        self.told_seen(track, last, &after, which);
        posture
    }

    /// Tells what is touched at the end of an act that was not at its beginning.
    pub(super) fn reached(
        &mut self,
        hand: usize,
        act: &Act,
        relation: &Relation,
        first: usize,
        last: usize,
    ) -> Option<Place> {
        if !matches!(act.kind, Kind::Way(_)) {
            return None;
        }
        let (before, after) = (self.body(first)?, self.body(last)?);
        let touching = |body: &Body<'_>| {
            let together = body.together()?;
            (together.contact == Contact::Touch).then_some(together)
        };
        if relation.kind != RelationKind::Alone
            && hand == 0
            && let Some(together) = touching(&after)
            && touching(&before).is_none_or(|was| was.parts != together.parts)
        {
            let [dominant, other] = together.parts.map(named);
            let contact = Found {
                best: (),
                residual: together.distance,
                runner_up: None,
            };
            let value = format!(
                "{} by {}: {}",
                words::hand_site(&dominant),
                words::hand_site(&other),
                words::contact(Some(together.contact))
            );
            self.told(FeatureKind::Contact, None, last, &contact, |()| {
                value.clone()
            });
            return Some(Place::Hands(Constellation {
                dominant: Some(dominant),
                other: Some(other),
                contact: Some(together.contact),
                ..Constellation::default()
            }));
        }
        let touched = |body: &Body<'_>| {
            let placed = body.place(hand, false)?;
            (placed.place.contact == Some(Contact::Touch)).then_some(placed)
        };
        let placed = touched(&after)?;
        let was = touched(&before).map(|placed| placed.place.site);
        if was == Some(placed.place.site) {
            return None;
        }
        self.told_place(self.scene.hands[hand].as_ref(), last, &placed);
        Some(Place::Body(placed.place))
    }
}
