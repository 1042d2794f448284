//! Writes the posture that a sign begins with: shape, direction, palm and place of the hands.

use super::*;
use crate::transcribe::tuned::tuned;

impl Writer<'_> {
    /// Writes the posture that the sign begins with.
    pub(super) fn posture(
        &mut self,
        frame: usize,
        relation: &Relation,
        body: Option<&Body<'_>>,
    ) -> Posture {
        let scene = self.scene;
        let seen = [0, 1].map(|n| {
            let track = scene.hands[n].as_ref()?;
            let seen = self.sight.see(track, frame);
            Some(match &self.picked.turned[n] {
                Some(turned) => seen.turned(turned.clone()),
                None => seen,
            })
        });
        let acts = [
            self.lead == 0,
            self.lead == 1 || relation.kind != RelationKind::Alone,
        ];
        let alike = self.alike(frame, relation, &seen);
        for (n, seen) in seen.iter().enumerate() {
            let (Some(track), Some(seen)) = (&scene.hands[n], seen) else {
                continue;
            };
            let own = if n == 0 {
                [true; 3]
            } else {
                alike.map(|alike| !alike)
            };
            if acts[n] {
                self.record_reading(track, frame, seen, own);
            }
        }
        let posture = Posture {
            shape: each(&seen, acts, alike[0], |seen| {
                seen.shape.as_ref().map(|found| found.best.clone())
            }),
            extended: each(&seen, acts, alike[1], |seen| Some(seen.extended.best)),
            palm: each(&seen, acts, alike[2], |seen| {
                seen.palm.as_ref().map(|found| found.best)
            }),
            place: None,
        };
        let own = body.and_then(|body| self.stand(relation, body));
        let stand = match (self.picked.stand.clone(), own) {
            (Some(picked), Some(own)) => Some(picked.rather_than(&own)),
            (picked, own) => picked.or(own),
        };
        if let Some(stand) = &stand {
            self.record_stand(frame, stand);
        }
        let place = stand.as_ref().and_then(Stand::place);
        self.begun = stand.map(|stand| Begun {
            frame,
            first: self.first,
            stand,
            symmetric: matches!(relation.kind, RelationKind::Alike(_)),
            alone: relation.kind == RelationKind::Alone,
            behind: self.behind,
        });
        Posture { place, ..posture }
    }

    /// Returns which of shape, direction and palm the other hand shares with the dominant one.
    fn alike(
        &self,
        frame: usize,
        relation: &Relation,
        seen: &[Option<HandReading>; 2],
    ) -> [bool; 3] {
        let RelationKind::Alike(symmetry) = relation.kind else {
            return [false; 3];
        };
        let ([Some(a), Some(b)], [Some(one), Some(other)]) = (&self.scene.hands, seen) else {
            return [true; 3];
        };
        let signs = signs(&symmetry);
        let angle = |x: &[DVec3], y: &[DVec3]| (x[frame] * signs).angle_between(y[frame]);
        let turned = angle(&a.along, &b.along) < 0.45 && angle(&a.normal, &b.normal) < 0.6;
        let turned = turned && !otherwise(one, other, signs);
        let shaped = match (&one.shape, &other.shape) {
            (Some(x), Some(y)) if x.best != y.best => {
                let sure = x.residual.max(y.residual) < tuned().tree.sure;
                !sure
                    && !self.picked.mirrored
                    && a.known.apart(&a.angles[frame], &b.angles[frame]) < 0.22
            }
            _ => true,
        };
        [shaped, turned, turned]
    }

    /// Chooses the likeliest form of notation for the hands' places.
    fn stand(&self, relation: &Relation, body: &Body<'_>) -> Option<Stand> {
        let alone = match relation.kind {
            RelationKind::Alone => {
                return Some(Stand::One(self.lead, body.place(self.lead, false)?));
            }
            RelationKind::Alike(_) => false,
            RelationKind::Unlike { .. } => true,
        };
        let placed = [0, 1].map(|n| body.place(n, !alone));
        let apart = if alone {
            let each = placed.iter().flatten();
            each.map(|placed| placed.score.min(tuned().tree.most_apart))
                .sum()
        } else {
            // A symmetric place applies to both hands.
            let [own, other] = &placed;
            let own = own.as_ref().map_or(f64::INFINITY, |it| it.score);
            own + other.as_ref().map_or(0.0, |it| it.unlikely)
        };
        if let Some((together, at)) = body.constellation(apart) {
            return Some(Stand::Together(together, at));
        }
        let [own, other] = placed;
        match alone {
            true => Some(Stand::Each([own, other])),
            false => Some(Stand::One(0, own?)),
        }
    }

    /// Records the places of the hands as features.
    fn record_stand(&mut self, frame: usize, stand: &Stand) {
        let scene = self.scene;
        match stand {
            Stand::Unsaid => {}
            Stand::One(n, placed) => self.record_place(scene.hands[*n].as_ref(), frame, placed),
            Stand::Each(both) => {
                for (n, placed) in both.iter().enumerate() {
                    if let Some(placed) = placed {
                        self.record_place(scene.hands[n].as_ref(), frame, placed);
                    }
                }
            }
            Stand::Together(together, at) => {
                let location = FeatureKind::Location;
                self.record(location, None, frame, &at.found(), words::place);
                let hands = constellation(together, at);
                self.record_contact_of_hands(frame, &hands, together.distance);
            }
        }
    }
}

/// The form of notation for the hands' places.
#[derive(Debug, Clone)]
pub(in crate::transcribe) enum Stand {
    /// One hand, or both alike, at a place.
    One(usize, Placed),
    /// Each hand at its own place.
    Each([Option<Placed>; 2]),
    /// A constellation of the two hands, at a place.
    Together(Together, Placed),
    /// No place: the hands are relaxed in front of the signer.
    Unsaid,
}

impl Stand {
    /// Records the likelier place as the runner-up.
    fn rather_than(mut self, likelier: &Self) -> Self {
        let next = |placed: &mut Placed, other: &Placed| {
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

    pub(in crate::transcribe) fn place(&self) -> Option<Place> {
        Some(match self {
            Self::Unsaid => return None,
            Self::One(_, placed) => Place::Body(placed.place.clone()),
            Self::Each(both) => {
                let [a, b] = both.each_ref().map(|placed| {
                    let place = placed.as_ref()?.place.clone();
                    Some(Box::new(Place::Body(place)))
                });
                Place::Split(a, b)
            }
            Self::Together(together, at) => Place::Hands(constellation(together, at)),
        })
    }
}

/// Converts a constellation to notation.
fn constellation(together: &Together, at: &Placed) -> Constellation {
    Constellation {
        at: at.place.site.is_some().then_some(at.place.clone()),
        ..meeting(together)
    }
}

/// Converts a constellation to notation that says nothing of its place.
pub(in crate::transcribe) fn meeting(together: &Together) -> Constellation {
    let [dominant, other] = together
        .parts
        .map(|part| together.named.then(|| named(part)));
    Constellation {
        dominant,
        other,
        contact: Some(together.contact),
        ..Constellation::default()
    }
}

/// Returns the offset of a hand that circles half a turn behind the other: its place is written as if both
/// began together.
pub(super) fn behind(relation: &Relation, first: Option<&Act>) -> Option<DVec3> {
    let RelationKind::Alike(symmetry) = relation.kind else {
        return None;
    };
    let ActKind::Path(fitted) = &first?.kind else {
        return None;
    };
    match fitted.path {
        PathForm::Circle { long, start, .. } if symmetry.out_of_phase => {
            Some(start * (2.0 * long.length()) * signs(&symmetry))
        }
        _ => None,
    }
}

/// Returns whether a hand is surely not turned like the mirror image of the other.
fn otherwise(one: &HandReading, other: &HandReading, signs: DVec3) -> bool {
    let directions = |seen: &HandReading| {
        let along = aim::vector(&seen.extended.best);
        let palm = seen.palm.as_ref()?;
        let sure = seen.extended.residual.max(palm.residual) < tuned().tree.sure;
        let angle = palm.best.angle();
        let normal = orientation::palm(along.to_array(), angle);
        sure.then_some([along, normal.into()])
    };
    let (Some(one), Some(other)) = (directions(one), directions(other)) else {
        return false;
    };
    one.iter()
        .zip(other)
        .any(|(own, other): (&DVec3, DVec3)| (*own * signs).angle_between(other) > 0.1)
}

fn each<T: Clone + PartialEq>(
    seen: &[Option<HandReading>; 2],
    acts: [bool; 2],
    alike: bool,
    pick: impl Fn(&HandReading) -> Option<T>,
) -> Each<T> {
    let [a, b] = [0, 1].map(|n| seen[n].as_ref().filter(|_| acts[n]).and_then(&pick));
    match (a, b) {
        (None, None) => Each::Unset,
        (Some(a), None) => Each::Shared(a),
        (Some(a), Some(_)) if alike => Each::Shared(a),
        (None, Some(b)) if !acts[0] => Each::Shared(b),
        (a, b) => Each::Split(a, b),
    }
}
