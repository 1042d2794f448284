//! Writes the motions of a hand: paths, wrist and finger movement, and changes on the way.

use std::f64::consts::TAU;

use super::super::acts::wrist_name;
use super::*;
use crate::transcribe::transcribe_tuned::tuned;

impl NotationWriter<'_> {
    /// Notates the path of an act: records its kind, direction and size as features, and returns the
    /// motion. An act that is no path gives a motion that stands still.
    pub(super) fn write_act_path(&mut self, track: &HandTrajectory, act: &TranscribedAct) -> NotatedMotion {
        let ActKind::Path(fitted) = &act.kind else {
            return NotatedMotion::new(MotionKind::Still);
        };
        let first = *act.frames.start();
        let scene = self.scene;
        let kind = BestReading {
            best: fitted.path,
            residual: fitted.residual,
            runner_up: fitted.runner_up,
        };
        let written = |path: &PathForm| Some(path_to_notation(scene, path));
        self.record_movement(track, first, &kind, PathForm::path_kind_name, written);
        let round = matches!(fitted.path, PathForm::Circle { .. });
        let nearest_course = aim::nearest_notated_aim(fitted.path.path_direction().normalize_or(DVec3::Z), false);
        self.record_feature(FeatureKind::Course, Some(track), first, &nearest_course, |aim| {
            transcribe_words::describe_movement_course(aim, round)
        });
        self.record_size(track, first, &notated_path_size(scene, &fitted.path));
        NotatedMotion::new(super::tree_motion::path_to_notation(scene, &fitted.path))
    }

    /// Records that a hand changes its posture in place.
    pub(super) fn record_change(&mut self, track: &HandTrajectory, frame: usize) {
        let change_finding = BestReading {
            best: (),
            residual: 0.0,
            runner_up: None,
        };
        self.record_movement(track, frame, &change_finding, |()| "replacement", |()| None);
    }

    /// Writes a movement of wrist or fingers to and fro.
    pub(super) fn write_sway_motion(&mut self, track: &HandTrajectory, sway: &HandSway, first: usize) -> NotatedMotion {
        let l = self.scene.language;
        match sway {
            HandSway::Play { digits, .. } => {
                let fingers = digits.0.len() == 4 && !digits.contains_digit(chereme_sign::hamnosys::HandDigit::Thumb);
                let digits = if fingers { Default::default() } else { digits.clone() };
                let kind = MotionKind::FingerPlay(digits);
                let sway_finding = BestReading {
                    best: (),
                    residual: 0.0,
                    runner_up: None,
                };
                let name = sway.sway_name();
                self.record_movement(track, first, &sway_finding, |()| name, |()| Some(kind.clone()));
                NotatedMotion::new(kind)
            }
            HandSway::Wrist {
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
                let size = nearest_notated_size(angle.to_degrees() / usual, [l.wrist_small, 1.0, l.wrist_big]);
                // The opposite wrist movement is wrong by the whole angle, expressed as the path of the
                // fingertips.
                let motion_finding = BestReading {
                    best: *motion,
                    residual: 0.0,
                    runner_up: runner_up.map(|(motion, of)| (motion, (angle - of) * self.scene.hand)),
                };
                let written = |motion: &WristMotion| MotionKind::Wrist {
                    motion: *motion,
                    size: size.best,
                };
                self.record_movement(
                    track,
                    first,
                    &motion_finding,
                    |motion| wrist_name(*motion),
                    |motion| Some(written(motion)),
                );
                self.record_size(track, first, &size);
                NotatedMotion::new(written(motion))
            }
        }
    }

    /// Writes the changes at the end of an act: shape, direction, palm.
    pub(super) fn write_end_changes(
        &mut self,
        track: &HandTrajectory,
        act: &TranscribedAct,
        first: usize,
        last: usize,
    ) -> NotatedPosture {
        let mut posture = NotatedPosture::default();
        if !act.turned && !act.reshaped {
            return posture;
        }
        let (before, after) = (
            self.sight.read_hand_posture(track, first),
            self.sight.read_hand_posture(track, last),
        );
        let best = |seen: &HandReading| seen.shape.as_ref().map(|found| found.best.clone());
        let mut which = [false; 3];
        if let Some(shape) = best(&after).filter(|_| act.reshaped && best(&before) != best(&after)) {
            posture.shape = EachHand::Shared(shape);
            which[0] = true;
        }
        let palm = |seen: &HandReading| seen.palm.as_ref().map(|found| found.best);
        if act.turned {
            which[1] = before.extended.best != after.extended.best;
            which[2] = palm(&before) != palm(&after);
            if which[1] {
                posture.extended = EachHand::Shared(after.extended.best);
            }
            if let Some(palm) = palm(&after).filter(|_| which[2]) {
                posture.palm = EachHand::Shared(palm);
            }
        }
        self.record_reading(track, last, &after, which);
        posture
    }

    /// Writes the place that a hand newly touches at the end of an act, or else one that it brushes on the
    /// way.
    pub(super) fn write_reached_place(
        &mut self,
        hand: usize,
        act: &TranscribedAct,
        relation: &HandRelation,
        first: usize,
        last: usize,
    ) -> Option<HandPlace> {
        if !matches!(act.kind, ActKind::Path(_)) {
            return None;
        }
        let (before, after) = (self.sight.cached_body_at(first)?, self.sight.cached_body_at(last)?);
        let touching = |body: &PosedBody<'_>| {
            let together = body.nearest_hands_together()?;
            (together.contact == PlaceContact::Touch).then_some(together)
        };
        if relation.kind != RelationKind::Alone
            && hand == 0
            && let Some(together) = touching(&after)
            && touching(&before).is_none_or(|was| was.parts != together.parts)
        {
            let [dominant, other] = together.parts.map(hand_point_site);
            let hands = HandConstellation {
                dominant: Some(dominant),
                other: Some(other),
                contact: Some(together.contact),
                ..HandConstellation::default()
            };
            self.record_contact_of_hands(last, &hands, together.distance);
            return Some(HandPlace::Hands(hands));
        }
        let touched = |body: &PosedBody<'_>| {
            let placed = body.find_hand_place(hand, false)?;
            (placed.place.contact == Some(PlaceContact::Touch)).then_some(placed)
        };
        let was = touched(&before).map(|placed| placed.place.site);
        let Some(placed) = touched(&after) else {
            let middle = first + (last - first) / 2;
            let between = self.sight.cached_body_at(middle)?;
            let mut placed = touched(&between).filter(|_| was.is_none())?;
            placed.place.contact = Some(PlaceContact::Brushing);
            self.record_place(self.scene.hands[hand].as_ref(), middle, &placed);
            return Some(HandPlace::Body(placed.place));
        };
        if was == Some(placed.place.site) {
            return None;
        }
        self.record_place(self.scene.hands[hand].as_ref(), last, &placed);
        Some(HandPlace::Body(placed.place))
    }
}

/// Converts a path to notation.
pub(super) fn path_to_notation(scene: &SignerScene<'_>, path: &PathForm) -> MotionKind {
    let (l, arm) = (scene.language, scene.arm);
    let direction = aim::nearest_notated_aim(path.path_direction().normalize_or(DVec3::Z), false)
        .best
        .first;
    let size = notated_path_size(scene, path).best;
    let mut directed = DirectedPath {
        direction,
        second: None,
        size: SizeAmount {
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
            let mut round = notate_circular_path(direction, size, long, narrow, start, l);
            // An incomplete circle needs its end in notation, and therefore its start as well.
            if turns * TAU < TAU * tuned().path.round {
                let hour = |spoke: DVec3| {
                    let angle = orientation::angle_about(direction.spatial_direction_vector(), spoke.into());
                    CompassDirection::nearest_compass_direction(angle)
                };
                round.clock.start = Some(hour(start));
                round.clock.end = Some(hour(end));
            }
            return MotionKind::Circular(round);
        }
        PathForm::Arc { chord, bow } => {
            let angle = orientation::angle_about(direction.spatial_direction_vector(), bow.into());
            let deep = bow.length() / chord.length().max(1e-9);
            directed.curve = Some(PathCurve {
                to: CompassDirection::nearest_compass_direction(angle),
                size: nearest_notated_size(deep, [l.arc_small, l.arc_normal, l.arc_big]).best,
            });
        }
        PathForm::Wave { width, wavy, .. } => {
            directed.zigzag = Some(PathZigzag {
                wavy,
                size: nearest_notated_size(width / arm, [l.zigzag_small, l.zigzag_normal, l.zigzag_big]).best,
                growth: None,
            });
        }
        PathForm::Straight { .. } => {}
    }
    MotionKind::Directed(directed)
}

/// Returns the size of a path: of its chord, or of a circle's longer radius.
fn notated_path_size(scene: &SignerScene<'_>, path: &PathForm) -> BestReading<Option<MotionSize>> {
    let (l, arm) = (scene.language, scene.arm);
    match path {
        PathForm::Circle { long, .. } => {
            nearest_notated_size(long.length() / arm, [l.circle_small, l.circle_normal, l.circle_big])
        }
        other => nearest_notated_size(
            other.path_chord().length() / arm,
            [l.move_small, l.move_normal, l.move_big],
        ),
    }
}
