//! Writes the posture that a sign begins with: shape, direction, palm and place of the hands.

use super::*;
use crate::transcribe::transcribe_tuned::tuned;

impl NotationWriter<'_> {
    /// Writes the posture that the sign begins with.
    pub(super) fn write_first_posture(
        &mut self,
        frame: usize,
        relation: &HandRelation,
        body: Option<&PosedBody<'_>>,
    ) -> NotatedPosture {
        let scene = self.scene;
        let hand_readings = [0, 1].map(|n| {
            let track = scene.hands[n].as_ref()?;
            let seen = self.sight.read_hand_posture(track, frame);
            Some(match &self.picked.turned[n] {
                Some(turned) => seen.with_orientation_reading(turned.clone()),
                None => seen,
            })
        });
        let acts = [self.lead == 0, self.lead == 1 || relation.kind != RelationKind::Alone];
        let alike = self.shared_hand_properties(frame, relation, &hand_readings);
        for (n, seen) in hand_readings.iter().enumerate() {
            let (Some(track), Some(seen)) = (&scene.hands[n], seen) else {
                continue;
            };
            let own_flags = if n == 0 { [true; 3] } else { alike.map(|alike| !alike) };
            if acts[n] {
                self.record_reading(track, frame, seen, own_flags);
            }
        }
        let posture = NotatedPosture {
            shape: share_or_split(&hand_readings, acts, alike[0], |seen| {
                seen.shape.as_ref().map(|found| found.best.clone())
            }),
            extended: share_or_split(&hand_readings, acts, alike[1], |seen| Some(seen.extended.best)),
            palm: share_or_split(&hand_readings, acts, alike[2], |seen| {
                seen.palm.as_ref().map(|found| found.best)
            }),
            place: None,
        };
        let inferred_stand = body.and_then(|body| self.choose_place_notation(relation, body));
        let stand = match (self.picked.stand.clone(), inferred_stand) {
            (Some(picked), Some(own)) => Some(picked.rather_than(&own)),
            (picked, own) => picked.or(own),
        };
        if let Some(stand) = &stand {
            self.record_stand(frame, stand);
        }
        let place = stand.as_ref().and_then(PlaceNotation::notated_place);
        self.begun = stand.map(|stand| BegunPosture {
            frame,
            first: self.first,
            stand,
            symmetric: matches!(relation.kind, RelationKind::Alike(_)),
            alone: relation.kind == RelationKind::Alone,
            behind: self.behind,
        });
        NotatedPosture { place, ..posture }
    }

    /// Returns which of shape, direction and palm the other hand shares with the dominant one.
    fn shared_hand_properties(
        &self,
        frame: usize,
        relation: &HandRelation,
        seen: &[Option<HandReading>; 2],
    ) -> [bool; 3] {
        let RelationKind::Alike(symmetry) = relation.kind else {
            return [false; 3];
        };
        let ([Some(a), Some(b)], [Some(one), Some(other)]) = (&self.scene.hands, seen) else {
            return [true; 3];
        };
        let written = aim::notated_aim_vector(&one.extended.best);
        let expected = symmetric_hand_orientation(written, [a.along[frame], a.normal[frame]], &symmetry);
        let is_turned_alike =
            expected[0].angle_between(b.along[frame]) < 0.45 && expected[1].angle_between(b.normal[frame]) < 0.6;
        let turned = is_turned_alike && !is_turned_otherwise(one, other, &symmetry);
        let shaped = match (&one.shape, &other.shape) {
            (Some(x), Some(y)) if x.best != y.best => {
                let sure = x.residual.max(y.residual) < tuned().tree.sure;
                !sure
                    && !self.picked.mirrored
                    && a.known.known_angle_difference(&a.angles[frame], &b.angles[frame]) < 0.22
            }
            _ => true,
        };
        [shaped, turned, turned]
    }

    /// Chooses the likeliest form of notation for the hands' places.
    fn choose_place_notation(&self, relation: &HandRelation, body: &PosedBody<'_>) -> Option<PlaceNotation> {
        let alone = match relation.kind {
            RelationKind::Alone => {
                return Some(PlaceNotation::One(self.lead, body.find_hand_place(self.lead, false)?));
            }
            RelationKind::Alike(_) => false,
            RelationKind::Unlike { .. } => true,
        };
        let placed = [0, 1].map(|n| body.find_hand_place(n, !alone));
        let apart = if alone {
            let each = placed.iter().flatten();
            each.map(|placed| placed.score.min(tuned().tree.most_apart)).sum()
        } else {
            // A symmetric place applies to both hands.
            let [own, other] = &placed;
            let own_score = own.as_ref().map_or(f64::INFINITY, |placed| placed.score);
            own_score + other.as_ref().map_or(0.0, |placed| placed.unlikely)
        };
        if let Some((together, at)) = body.likeliest_constellation(apart) {
            return Some(PlaceNotation::Together(together, at));
        }
        let [own, other] = placed;
        match alone {
            true => Some(PlaceNotation::Each([own, other])),
            false => Some(PlaceNotation::One(0, own?)),
        }
    }

    /// Records the places of the hands as features.
    fn record_stand(&mut self, frame: usize, stand: &PlaceNotation) {
        let scene = self.scene;
        match stand {
            PlaceNotation::Unsaid => {}
            PlaceNotation::One(n, placed) => self.record_place(scene.hands[*n].as_ref(), frame, placed),
            PlaceNotation::Each(both) => {
                for (n, placed) in both.iter().enumerate() {
                    if let Some(placed) = placed {
                        self.record_place(scene.hands[n].as_ref(), frame, placed);
                    }
                }
            }
            PlaceNotation::Together(together, at) => {
                let location = FeatureKind::Location;
                self.record_feature(
                    location,
                    None,
                    frame,
                    &at.to_place_reading(),
                    transcribe_words::describe_body_place,
                );
                let hands = constellation_at_place(together, at);
                self.record_contact_of_hands(frame, &hands, together.distance);
            }
        }
    }
}

/// The form of notation for the hands' places.
#[derive(Debug, Clone)]
pub(in crate::transcribe) enum PlaceNotation {
    /// One hand, or both alike, at a place.
    One(usize, LikelyHandPlace),
    /// Each hand at its own place.
    Each([Option<LikelyHandPlace>; 2]),
    /// A constellation of the two hands, at a place.
    Together(HandsTogether, LikelyHandPlace),
    /// No place: the hands are relaxed in front of the signer.
    Unsaid,
}

impl PlaceNotation {
    /// Records the likelier place as the runner-up.
    fn rather_than(mut self, likelier: &Self) -> Self {
        let next = |placed: &mut LikelyHandPlace, other: &LikelyHandPlace| {
            if placed.place != other.place {
                placed.runner_up = Some((other.place.clone(), other.residual));
            }
        };
        match (&mut self, likelier) {
            (Self::One(_, own), Self::One(_, other)) => next(own, other),
            (Self::Together(_, own), Self::Together(_, other)) => next(own, other),
            (Self::Each(own), Self::Each(other)) => {
                for (own, other) in own.iter_mut().flatten().zip(other.iter().flatten()) {
                    next(own, other);
                }
            }
            _ => {}
        }
        self
    }

    pub(in crate::transcribe) fn notated_place(&self) -> Option<HandPlace> {
        Some(match self {
            Self::Unsaid => return None,
            Self::One(_, placed) => HandPlace::Body(placed.place.clone()),
            Self::Each(both) => {
                let [a, b] = both.each_ref().map(|placed| {
                    let place = placed.as_ref()?.place.clone();
                    Some(Box::new(HandPlace::Body(place)))
                });
                HandPlace::Split(a, b)
            }
            Self::Together(together, at) => HandPlace::Hands(constellation_at_place(together, at)),
        })
    }
}

/// Converts a constellation to notation.
fn constellation_at_place(together: &HandsTogether, at: &LikelyHandPlace) -> HandConstellation {
    HandConstellation {
        at: at.place.site.is_some().then_some(at.place.clone()),
        ..placeless_constellation(together)
    }
}

/// Converts a constellation to notation that says nothing of its place.
pub(in crate::transcribe) fn placeless_constellation(together: &HandsTogether) -> HandConstellation {
    let [dominant, other] = together.parts.map(|part| together.named.then(|| hand_point_site(part)));
    HandConstellation {
        dominant,
        other,
        contact: Some(together.contact),
        ..HandConstellation::default()
    }
}

/// Returns the offset of a hand that circles half a turn behind the other: its place is written as if both
/// began together.
pub(super) fn circling_lag_offset(relation: &HandRelation, first: Option<&TranscribedAct>) -> Option<DVec3> {
    let RelationKind::Alike(symmetry) = relation.kind else {
        return None;
    };
    let ActKind::Path(fitted) = &first?.kind else {
        return None;
    };
    match fitted.path {
        PathForm::Circle { long, start, .. } if symmetry.out_of_phase => {
            Some(start * (2.0 * long.length()) * symmetry_axis_signs(&symmetry))
        }
        _ => None,
    }
}

/// Returns whether a hand is surely not turned like the mirror image of the other.
fn is_turned_otherwise(one: &HandReading, other: &HandReading, symmetry: &HandSymmetry) -> bool {
    let directions = |seen: &HandReading| {
        let along = aim::notated_aim_vector(&seen.extended.best);
        let palm = seen.palm.as_ref()?;
        let sure = seen.extended.residual.max(palm.residual) < tuned().tree.sure;
        let angle = palm.best.aim_angle();
        let normal = orientation::palm_direction_vector(along.to_array(), angle);
        sure.then_some([along, normal.into()])
    };
    let (Some(one), Some(other)) = (directions(one), directions(other)) else {
        return false;
    };
    let expected = symmetric_hand_orientation(one[0], one, symmetry);
    let mut both = expected.iter().zip(other);
    both.any(|(expected, other): (&DVec3, DVec3)| expected.angle_between(other) > 0.1)
}

fn share_or_split<T: Clone + PartialEq>(
    seen: &[Option<HandReading>; 2],
    acts: [bool; 2],
    alike: bool,
    pick: impl Fn(&HandReading) -> Option<T>,
) -> EachHand<T> {
    let [a, b] = [0, 1].map(|n| seen[n].as_ref().filter(|_| acts[n]).and_then(&pick));
    match (a, b) {
        (None, None) => EachHand::Unset,
        (Some(a), None) => EachHand::Shared(a),
        (Some(a), Some(_)) if alike => EachHand::Shared(a),
        (None, Some(b)) if !acts[0] => EachHand::Shared(b),
        (a, b) => EachHand::Split(a, b),
    }
}
