//! Fits hands to the trunk's surface in contact.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_sign::hamnosys::sites::{Face, HandPoint};
use chereme_sign::hamnosys::{Contact, Place, Posture};

use super::plan::{Hands, Planner};
use super::stage::FINGER_FLESH;
use super::tuned::tuned;

/// Offset (m) above which the substitution is reported.
const REPORTED: f64 = 2e-3;
/// Step of the search for that offset, in metres.
const STEP: f64 = 1e-3;

impl Planner<'_> {
    /// Rotates a hand that touches the trunk with a flat face so that the face lies on the skin, within the tolerance
    /// of its notated orientation.
    pub(super) fn lay(&mut self, n: usize, points: &[HandPoint], at: DVec3) {
        let flat = |point: &HandPoint| {
            matches!(
                point,
                HandPoint::Palm
                    | HandPoint::Back
                    | HandPoint::Radial
                    | HandPoint::Ulnar
                    | HandPoint::Tip(_, Face::Palmar | Face::Dorsal)
                    | HandPoint::Middle(_, Face::Palmar | Face::Dorsal)
                    | HandPoint::Base(_, Face::Palmar | Face::Dorsal)
            )
        };
        let Some(normal) = self
            .signer
            .stage
            .torso
            .normal(at)
            .filter(|_| points.iter().all(flat))
        else {
            return;
        };
        let (_, out) = self.hands().at_hand(n, points);
        let turn = DQuat::from_rotation_arc(out, -normal);
        let angle = turn.angle_between(DQuat::IDENTITY);
        if !(1e-6..1.2).contains(&angle) {
            return;
        }
        let share = (tuned().contact.laid / angle).min(1.0);
        let turn = DQuat::IDENTITY.slerp(turn, share);
        self.state[n].rotation = (turn * self.state[n].rotation).normalize();
    }

    /// Lets the part of a hand in front of the named one touch instead, if the named one faces away from
    /// the skin or along it and would be inside the trunk. The hand keeps its place and its notated
    /// orientation.
    pub(super) fn lie(&mut self, n: usize, skin: DVec3, points: &[HandPoint]) {
        let (_, out) = self.hands().at_hand(n, points);
        if out.dot(skin) < tuned().contact.away {
            return;
        }
        let by = self.hands().stands_in(n, skin);
        let turned = self.state[n].rotation;
        self.state[n].offset -= turned.inverse() * (skin * by);
        if by > REPORTED {
            let side = self.signer.sides[n].name();
            self.remark(&format!(
                "the {side} hand touches with the part in front of the named one"
            ));
        }
    }

    /// Pushes both hands of a constellation out of the trunk by the same offset.
    pub(super) fn both_out(&mut self) {
        let middle = (self.state[0].point + self.state[1].point) / 2.0;
        let Some(skin) = self.signer.stage.torso.normal(middle) else {
            return;
        };
        let by = [0, 1].map(|n| self.hands().stands_in(n, skin));
        let by = by[0].max(by[1]);
        for state in &mut self.state {
            state.point += skin * by;
        }
    }
}

impl Hands<'_> {
    /// Returns the offset from a face of a hand to the plane of its outermost point, in the hand's space:
    /// the fingers of a fist stand out farther than the palm.
    pub(super) fn stands_out(&self, n: usize, points: &[HandPoint]) -> DVec3 {
        let (Some(hand), [point]) = (self.signer.stage.hand(self.signer.sides[n]), points) else {
            return DVec3::ZERO;
        };
        let face = matches!(
            point,
            HandPoint::Palm | HandPoint::Back | HandPoint::Radial | HandPoint::Ulnar
        );
        if !face {
            return DVec3::ZERO;
        }
        let shape = &self.shapes[n][self.state[n].shape];
        let out = self.signer.stage.outward(hand, shape, *point);
        let own = self.signer.stage.point(hand, shape, *point).dot(out);
        let flesh = FINGER_FLESH * hand.length();
        let far = shape
            .outline
            .points
            .iter()
            .skip(2)
            .map(|at| at.dot(out) + flesh);
        let far = far.fold(own, f64::max);
        out * (far - own)
    }

    /// Returns the distance (m) along the outward normal `skin` that takes the whole hand out of the
    /// trunk; 0 if that is too far.
    fn stands_in(&self, n: usize, skin: DVec3) -> f64 {
        let Some(hand) = self.signer.stage.hand(self.signer.sides[n]) else {
            return 0.0;
        };
        let state = &self.state[n];
        let shape = &self.shapes[n][state.shape];
        let torso = &self.signer.stage.torso;
        let inside = |by: f64| {
            let wrist = state.wrist() + skin * by;
            let mut points = shape.outline.points.iter();
            points.any(|&at| {
                torso.offset_out(wrist + state.rotation * at, tuned().solve.margin) != DVec3::ZERO
            })
        };
        let most = (tuned().contact.behind * hand.length() / STEP) as u32;
        let mut tried = (0..=most).map(|n| STEP * f64::from(n));
        tried.find(|by| !inside(*by)).unwrap_or(0.0)
    }
}

/// Returns whether a posture asks for contact with the body or between the hands.
pub(super) fn touches(posture: &Posture) -> bool {
    fn touching(place: &Place) -> bool {
        match place {
            Place::Body(body) => body.contact == Some(Contact::Touch),
            Place::Hand(_) => true,
            Place::Hands(hands) => hands.contact.is_some_and(|c| c != Contact::Close),
            Place::Split(a, b) => [a, b].into_iter().flatten().any(|place| touching(place)),
            Place::Named(_) => false,
        }
    }
    posture.place.as_ref().is_some_and(touching)
}
