//! Fits hands to the trunk's surface in contact.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_sign::hamnosys::sites::{DigitFace, NotatedHandPoint};
use chereme_sign::hamnosys::{HandPlace, NotatedPosture, PlaceContact};

use super::notation_plan::{PlannedHands, SignPlanner};
use super::notation_stage::FINGER_FLESH;
use super::notation_tuned::tuned;

/// Offset (m) above which the substitution is reported.
const REPORTED_TOUCH_OFFSET_M: f64 = 2e-3;
/// Step of the search for that offset, in metres.
const TOUCH_SEARCH_STEP_M: f64 = 1e-3;

impl SignPlanner<'_> {
    /// Rotates a hand that touches the trunk with a flat face so that the face lies on the skin, within the tolerance
    /// of its notated orientation.
    pub(super) fn lay_flat_hand(&mut self, n: usize, points: &[NotatedHandPoint], at: DVec3) {
        let flat = |point: &NotatedHandPoint| {
            matches!(
                point,
                NotatedHandPoint::Palm
                    | NotatedHandPoint::Back
                    | NotatedHandPoint::Radial
                    | NotatedHandPoint::Ulnar
                    | NotatedHandPoint::Tip(_, DigitFace::Palmar | DigitFace::Dorsal)
                    | NotatedHandPoint::Middle(_, DigitFace::Palmar | DigitFace::Dorsal)
                    | NotatedHandPoint::Base(_, DigitFace::Palmar | DigitFace::Dorsal)
            )
        };
        let Some(normal) = self
            .signer
            .stage
            .torso
            .trunk_front_normal(at)
            .filter(|_| points.iter().all(flat))
        else {
            return;
        };
        let (_, out) = self.planned_hands().at_hand(n, points);
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
    pub(super) fn touch_with_front_part(&mut self, n: usize, skin: DVec3, points: &[NotatedHandPoint]) {
        let (_, out) = self.planned_hands().at_hand(n, points);
        if out.dot(skin) < tuned().contact.away {
            return;
        }
        let by = self.planned_hands().stands_in(n, skin);
        let turned = self.state[n].rotation;
        self.state[n].offset -= turned.inverse() * (skin * by);
        if by > REPORTED_TOUCH_OFFSET_M {
            let side = self.signer.sides[n].body_side_name();
            self.add_plan_remark(&format!(
                "the {side} hand touches with the part in front of the named one"
            ));
        }
    }

    /// Pushes both hands of a constellation out of the trunk by the same offset.
    pub(super) fn both_out(&mut self) {
        let middle = (self.state[0].point + self.state[1].point) / 2.0;
        let Some(skin) = self.signer.stage.torso.trunk_front_normal(middle) else {
            return;
        };
        let hand_depths = [0, 1].map(|n| self.planned_hands().stands_in(n, skin));
        let by = hand_depths[0].max(hand_depths[1]);
        for state in &mut self.state {
            state.point += skin * by;
        }
    }
}

impl PlannedHands<'_> {
    /// Returns the offset from a face of a hand to the plane of its outermost point, in the hand's space:
    /// the fingers of a fist stand out farther than the palm.
    pub(super) fn stands_out(&self, n: usize, points: &[NotatedHandPoint]) -> DVec3 {
        let (Some(hand), [point]) = (self.signer.stage.hand_of_side(self.signer.sides[n]), points) else {
            return DVec3::ZERO;
        };
        let face = matches!(
            point,
            NotatedHandPoint::Palm | NotatedHandPoint::Back | NotatedHandPoint::Radial | NotatedHandPoint::Ulnar
        );
        if !face {
            return DVec3::ZERO;
        }
        let shape = &self.shapes[n][self.state[n].shape];
        let out = self.signer.stage.hand_point_normal(hand, shape, *point);
        let point_distance = self.signer.stage.hand_point_offset(hand, shape, *point).dot(out);
        let flesh = FINGER_FLESH * hand.staged_hand_length();
        let outline_reach = shape.outline.points.iter().skip(2).map(|at| at.dot(out) + flesh);
        let far = outline_reach.fold(point_distance, f64::max);
        out * (far - point_distance)
    }

    /// Returns the distance (m) along the outward normal `skin` that takes the whole hand out of the
    /// trunk; 0 if that is too far.
    fn stands_in(&self, n: usize, skin: DVec3) -> f64 {
        let Some(hand) = self.signer.stage.hand_of_side(self.signer.sides[n]) else {
            return 0.0;
        };
        let state = &self.state[n];
        let shape = &self.shapes[n][state.shape];
        let torso = &self.signer.stage.torso;
        let inside = |by: f64| {
            let wrist = state.wrist_position() + skin * by;
            let mut points = shape.outline.points.iter();
            points
                .any(|&at| torso.offset_out_of_trunk(wrist + state.rotation * at, tuned().solve.margin) != DVec3::ZERO)
        };
        let most = (tuned().contact.behind * hand.staged_hand_length() / TOUCH_SEARCH_STEP_M) as u32;
        let mut tried = (0..=most).map(|n| TOUCH_SEARCH_STEP_M * f64::from(n));
        tried.find(|by| !inside(*by)).unwrap_or(0.0)
    }
}

/// Returns whether a posture asks for contact with the body or between the hands.
pub(super) fn asks_for_contact(posture: &NotatedPosture) -> bool {
    fn is_touching_place(place: &HandPlace) -> bool {
        match place {
            HandPlace::Body(body) => body.contact == Some(PlaceContact::Touch),
            HandPlace::Hand(_) => true,
            HandPlace::Hands(hands) => hands.contact.is_some_and(|c| c != PlaceContact::Close),
            HandPlace::Split(a, b) => [a, b].into_iter().flatten().any(|place| is_touching_place(place)),
            HandPlace::Named(_) => false,
        }
    }
    posture.place.as_ref().is_some_and(is_touching_place)
}
