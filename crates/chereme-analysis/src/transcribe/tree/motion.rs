//! Writes the motions of a hand: paths, wrist and finger movement, and changes on the way.

use std::f64::consts::TAU;

use super::super::acts::wrist_name;
use super::*;
use crate::transcribe::tuned::tuned;

impl Writer<'_> {
    /// Notates the path of an act: records its kind, direction and size as features, and returns the
    /// motion. An act that is no path gives a motion that stands still.
    pub(super) fn path(&mut self, track: &HandTrajectory, act: &Act) -> Motion {
        let ActKind::Path(fitted) = &act.kind else {
            return Motion::new(MotionKind::Still);
        };
        let first = *act.frames.start();
        let scene = self.scene;
        let kind = Found {
            best: fitted.path,
            residual: fitted.residual,
            runner_up: fitted.runner_up,
        };
        let written = |path: &PathForm| Some(written(scene, path));
        self.record_movement(track, first, &kind, PathForm::kind, written);
        let round = matches!(fitted.path, PathForm::Circle { .. });
        let found = aim::nearest(fitted.path.line().normalize_or(DVec3::Z), false);
        self.record(FeatureKind::Course, Some(track), first, &found, |aim| {
            words::course(aim, round)
        });
        self.record_size(track, first, &size(scene, &fitted.path));
        Motion::new(super::motion::written(scene, &fitted.path))
    }

    /// Records that a hand changes its posture in place.
    pub(super) fn record_change(&mut self, track: &HandTrajectory, frame: usize) {
        let found = Found {
            best: (),
            residual: 0.0,
            runner_up: None,
        };
        self.record_movement(track, frame, &found, |()| "replacement", |()| None);
    }

    /// Writes a movement of wrist or fingers to and fro.
    pub(super) fn sway(&mut self, track: &HandTrajectory, sway: &Sway, first: usize) -> Motion {
        let l = self.scene.language;
        match sway {
            Sway::Play { digits, .. } => {
                let fingers =
                    digits.0.len() == 4 && !digits.contains(chereme_sign::hamnosys::Digit::Thumb);
                let digits = if fingers {
                    Default::default()
                } else {
                    digits.clone()
                };
                let kind = MotionKind::FingerPlay(digits);
                let found = Found {
                    best: (),
                    residual: 0.0,
                    runner_up: None,
                };
                let name = sway.name();
                self.record_movement(track, first, &found, |()| name, |()| Some(kind.clone()));
                Motion::new(kind)
            }
            Sway::Wrist {
                motion,
                angle,
                cycles: _,
                runner_up,
            } => {
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
                // The opposite wrist movement is wrong by the whole angle, expressed as the path of the
                // fingertips.
                let found = Found {
                    best: *motion,
                    residual: 0.0,
                    runner_up: runner_up
                        .map(|(motion, of)| (motion, (angle - of) * self.scene.hand)),
                };
                let written = |motion: &WristMotion| MotionKind::Wrist {
                    motion: *motion,
                    size: size.best,
                };
                self.record_movement(
                    track,
                    first,
                    &found,
                    |motion| wrist_name(*motion),
                    |motion| Some(written(motion)),
                );
                self.record_size(track, first, &size);
                Motion::new(written(motion))
            }
        }
    }

    /// Writes the changes at the end of an act: shape, direction, palm.
    pub(super) fn changed(
        &mut self,
        track: &HandTrajectory,
        act: &Act,
        first: usize,
        last: usize,
    ) -> Posture {
        let mut posture = Posture::default();
        if !act.turned && !act.reshaped {
            return posture;
        }
        let (before, after) = (self.sight.see(track, first), self.sight.see(track, last));
        let best = |seen: &HandReading| seen.shape.as_ref().map(|found| found.best.clone());
        let mut which = [false; 3];
        if let Some(shape) = best(&after).filter(|_| act.reshaped && best(&before) != best(&after))
        {
            posture.shape = Each::Shared(shape);
            which[0] = true;
        }
        let palm = |seen: &HandReading| seen.palm.as_ref().map(|found| found.best);
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
        self.record_reading(track, last, &after, which);
        posture
    }

    /// Writes the place that a hand newly touches at the end of an act, or else one that it brushes on the
    /// way.
    pub(super) fn reached(
        &mut self,
        hand: usize,
        act: &Act,
        relation: &Relation,
        first: usize,
        last: usize,
    ) -> Option<Place> {
        if !matches!(act.kind, ActKind::Path(_)) {
            return None;
        }
        let (before, after) = (self.sight.body(first)?, self.sight.body(last)?);
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
            let hands = Constellation {
                dominant: Some(dominant),
                other: Some(other),
                contact: Some(together.contact),
                ..Constellation::default()
            };
            self.record_contact_of_hands(last, &hands, together.distance);
            return Some(Place::Hands(hands));
        }
        let touched = |body: &Body<'_>| {
            let placed = body.place(hand, false)?;
            (placed.place.contact == Some(Contact::Touch)).then_some(placed)
        };
        let was = touched(&before).map(|placed| placed.place.site);
        let Some(placed) = touched(&after) else {
            let middle = first + (last - first) / 2;
            let between = self.sight.body(middle)?;
            let mut placed = touched(&between).filter(|_| was.is_none())?;
            placed.place.contact = Some(Contact::Brushing);
            self.record_place(self.scene.hands[hand].as_ref(), middle, &placed);
            return Some(Place::Body(placed.place));
        };
        if was == Some(placed.place.site) {
            return None;
        }
        self.record_place(self.scene.hands[hand].as_ref(), last, &placed);
        Some(Place::Body(placed.place))
    }
}

/// Converts a path to notation.
pub(super) fn written(scene: &Scene<'_>, path: &PathForm) -> MotionKind {
    let (l, arm) = (scene.language, scene.arm);
    let direction = aim::nearest(path.line().normalize_or(DVec3::Z), false)
        .best
        .first;
    let size = size(scene, path).best;
    let mut directed = Directed {
        direction,
        second: None,
        size: Amount {
            first: size,
            second: None,
        },
        curve: None,
        zigzag: None,
        ellipse: None,
    };
    match *path {
        PathForm::Circle {
            turns,
            long,
            narrow,
            start,
            end,
            ..
        } => {
            let mut round = circular(direction, size, long, narrow, start, l);
            // An incomplete circle needs its end in notation, and therefore its start as well.
            if turns * TAU < TAU * tuned().path.round {
                let hour = |spoke: DVec3| {
                    let angle = orientation::angle_about(direction.vector(), spoke.into());
                    Compass::nearest(angle)
                };
                round.clock.start = Some(hour(start));
                round.clock.end = Some(hour(end));
            }
            return MotionKind::Circular(round);
        }
        PathForm::Arc { chord, bow } => {
            let angle = orientation::angle_about(direction.vector(), bow.into());
            let deep = bow.length() / chord.length().max(1e-9);
            directed.curve = Some(Curve {
                to: Compass::nearest(angle),
                size: sized(deep, [l.arc_small, l.arc_normal, l.arc_big]).best,
            });
        }
        PathForm::Wave { width, wavy, .. } => {
            directed.zigzag = Some(Zigzag {
                wavy,
                size: sized(width / arm, [l.zigzag_small, l.zigzag_normal, l.zigzag_big]).best,
                growth: None,
            });
        }
        PathForm::Straight { .. } => {}
    }
    MotionKind::Directed(directed)
}

/// Returns the size of a path: of its chord, or of a circle's longer radius.
fn size(scene: &Scene<'_>, path: &PathForm) -> Found<Option<Size>> {
    let (l, arm) = (scene.language, scene.arm);
    match path {
        PathForm::Circle { long, .. } => sized(
            long.length() / arm,
            [l.circle_small, l.circle_normal, l.circle_big],
        ),
        other => sized(
            other.chord().length() / arm,
            [l.move_small, l.move_normal, l.move_big],
        ),
    }
}
