//! Turns and shortens movements for the comfort of the arm.
//!
//! A movement that is notated towards the signer would often end so close to the trunk that the elbow stands behind the
//! back. People end it earlier, or a little to the side. All straight and curved movements of a part are turned and
//! shortened alike, so that their figure keeps its shape and a repetition returns to its start.

use chereme_motion::glam::DQuat;
use chereme_sign::hamnosys::ManualPart;

use super::super::comfort::{HandStance, find_lowest_cost_offset};
use super::super::notation_tuned::tuned;
use super::*;

/// The number of postures to evaluate: those that strain the arm most.
const BEND_POSTURE_COUNT: usize = 4;

/// A turn and a shortening of the movements of a part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MovementBend {
    /// Its turn (left, up, forward).
    turn: DQuat,
    /// The factor on its length.
    length: f64,
}

impl MovementBend {
    /// Returns a bend from its shortening as a share, its turn (rad) about left and that about up.
    fn bend_from_vector(at: DVec3) -> Self {
        Self {
            turn: DQuat::from_scaled_axis(DVec3::new(at.y, at.z, 0.0)),
            length: 1.0 - at.x,
        }
    }

    fn apply_bend(&self, v: DVec3) -> DVec3 {
        self.turn * v * self.length
    }

    /// Returns a remark about it; `None` if it changes movements by less than half a degree and half a per cent.
    fn describe_bend(&self) -> Option<String> {
        let turned = self.turn.angle_between(DQuat::IDENTITY).to_degrees();
        let shortened = (1.0 - self.length) * 100.0;
        let turned = (turned >= 0.5).then(|| format!("turned by {turned:.0}°"));
        let shortened = (shortened >= 0.5).then(|| format!("shortened by {shortened:.0} %"));
        let change_texts: Vec<String> = turned.into_iter().chain(shortened).collect();
        let changed = change_texts.join(" and ");
        let why = "so that the arm stays comfortable";
        (!changed.is_empty()).then(|| format!("movements are {changed}, {why}"))
    }
}

impl SignPlanner<'_> {
    /// Returns a path (left, up, forward) as this part bends its movements.
    pub(super) fn bend_path(&self, path: HandPath) -> HandPath {
        match &self.bend {
            Some(bend) => path.map_path_vectors(|v| bend.apply_bend(v)),
            None => path,
        }
    }

    /// Finds out how to bend the movements of a part from the current state for the comfort of the arms. Hands that touch
    /// something, stand together or turn with their path move as written.
    pub(crate) fn find_comfortable_bend(&mut self, part: &ManualPart, who: ActingHands) {
        let bound = |(n, frame)| self.skin_normal_at_hand(n, frame).is_some() || self.state[n].follows;
        if part.actions.is_empty() || self.together.is_some() || iterate_acting_hands(who).any(bound) {
            return;
        }
        let begun = [0, 1].map(|n| self.state[n].point);
        let strains = [0, 1].map(|n| {
            let stance = self.planned_hands().current_hand_stance(n);
            self.signer.arm_stance_strain(n, &stance, DVec3::ZERO)
        });
        let mut seen = self.strained_stances(who, Some((&part.actions, who)), |n, _| who[n].is_some());
        seen.truncate(BEND_POSTURE_COUNT);
        // The movement does not cause the strain that an arm has at its start.
        let worse = |(n, stance): &(usize, HandStance)| {
            self.signer.arm_stance_strain(*n, stance, DVec3::ZERO) > strains[*n] + tuned().comfort.strained
        };
        if !seen.first().is_some_and(worse) {
            return;
        }
        let stage = self.signer.stage;
        let cost = |at: DVec3, limit: f64| {
            let bend = MovementBend::bend_from_vector(at);
            let l = &tuned().comfort;
            let mut sum = l.shortened * (at.x / l.most_shortened).powi(2);
            sum += l.bent * (at.y.powi(2) + at.z.powi(2)) / l.most_bent.powi(2);
            for (n, stance) in &seen {
                let axes = who[*n].map_or(DVec3::ONE, |frame| frame.axes);
                let displacement = stance.point - begun[*n];
                let went = DVec3::new(
                    displacement.dot(stage.left),
                    displacement.y,
                    displacement.dot(stage.forward),
                ) * axes;
                let bent = HandStance {
                    point: begun[*n] + stage.body_to_model_direction(bend.apply_bend(went) * axes),
                    ..*stance
                };
                sum += self.signer.strain_up_to(limit - sum, *n, &bent, DVec3::ZERO);
                if sum >= limit {
                    return f64::INFINITY;
                }
            }
            sum
        };
        let l = &tuned().comfort;
        let room = [
            DVec3::new(1e-4, l.most_bent, l.most_bent),
            DVec3::new(l.most_shortened, l.most_bent, l.most_bent),
        ];
        let best = find_lowest_cost_offset(cost, room);
        if best != DVec3::ZERO {
            let bend = MovementBend::bend_from_vector(best);
            if let Some(remark) = bend.describe_bend() {
                self.add_plan_remark(&remark);
            }
            self.bend = Some(bend);
        }
    }
}

#[cfg(test)]
mod tests {
    use chereme_sign::SignerHandedness;
    use chereme_sign::hamnosys::{BodyLanguage, BodyLocation, HandClass, HandsUsed, PlaceContact};

    use super::super::super::notation_stage::StandingBody;
    use super::super::super::pace::PaceTables;
    use super::super::super::tests::{at, directed, mirrored, posture, stage};
    use super::*;
    use crate::testing::Axes;

    /// Returns how each hand's movement is bent, as its end without and with the bend, and the strain of its arm there.
    fn bent(
        (along, direction): (&str, &str),
        contact: Option<PlaceContact>,
        hands: HandsUsed,
    ) -> [[(DVec3, f64); 2]; 2] {
        let material = stage(Axes::Plain);
        let body = StandingBody::body_from_material(&material).expect("a body");
        let paces = PaceTables::pace_tables_from_language(BodyLanguage::default_body_language());
        let language = BodyLanguage::default_body_language();
        let mut planner = SignPlanner::new(&body, language, &paces, SignerHandedness::Right, 60.0);
        let who = planner.acting_part_hands(hands);
        let place = at(BodyLocation::Chest, contact);
        let part = ManualPart {
            hands,
            posture: posture(HandClass::Flat, along, "l", Some(place)),
            actions: vec![directed(direction)],
            ..ManualPart::default()
        };
        planner.assume_posture(&part.posture, who, false);
        let begun = planner.state.clone();
        let ends = |planner: &mut SignPlanner<'_>| {
            planner.state = begun.clone();
            planner.plan_motion(&part.actions[0], who, 0.0, &InheritedModifiers::default());
            [0, 1].map(|n| {
                let strain =
                    planner
                        .signer
                        .arm_stance_strain(n, &planner.planned_hands().current_hand_stance(n), DVec3::ZERO);
                (planner.state[n].point - begun[n].point, strain)
            })
        };
        let written = ends(&mut planner);
        planner.state = begun.clone();
        planner.find_comfortable_bend(&part, who);
        let bent = ends(&mut planner);
        [0, 1].map(|n| [written[n], bent[n]])
    }

    #[test]
    fn movements_that_strain_the_arm_are_bent_a_little() {
        let l = &tuned().comfort;
        let mut changed = 0;
        for along in ["o", "ol", "l", "ul", "u"] {
            for direction in ["i", "di", "il", "dil"] {
                let case = (along, direction);
                let [(written, strained), (is, eased)] = bent(case, None, HandsUsed::Dominant)[0];
                if is == written {
                    continue;
                }
                changed += 1;
                assert!(eased < strained, "{case:?}: {strained} {eased}");
                assert!(is.angle_between(written) < l.most_bent + 1e-6, "{case:?}");
                let share = is.length() / written.length();
                let least = 1.0 - l.most_shortened - 1e-6;
                assert!((least..1.0 + 1e-3).contains(&share), "{case:?}: {share}");
            }
        }
        assert!(changed > 4, "{changed}");
    }

    #[test]
    fn a_bend_is_reported_unless_it_is_tiny() {
        let says = |x, y, z| MovementBend::bend_from_vector(DVec3::new(x, y, z)).describe_bend();
        let turn = 10_f64.to_radians();
        for (said, expected) in [
            (says(0.18, 0.0, turn), Some("turned by 10° and shortened by 18 %")),
            (says(-1e-4, turn, 0.0), Some("turned by 10°")),
            (says(0.07, 0.0, 0.0), Some("shortened by 7 %")),
            (says(1e-4, 1e-4, 0.0), None),
        ] {
            let expected =
                expected.map(|changed| format!("movements are {changed}, so that the arm stays comfortable"));
            assert_eq!(said, expected);
        }
    }

    #[test]
    fn movements_from_the_skin_are_as_written() {
        for direction in ["i", "di", "l", "o"] {
            let touch = Some(PlaceContact::Touch);
            let [(written, _), (is, _)] = bent(("ul", direction), touch, HandsUsed::Dominant)[0];
            assert_eq!(written, is, "{direction}");
        }
    }

    #[test]
    fn hands_that_mirror_each_other_are_bent_alike() {
        let [[_, (right, _)], [_, (left, _)]] = bent(("o", "di"), None, mirrored());
        let mirror = right * DVec3::new(-1.0, 1.0, 1.0);
        assert!(mirror.distance(left) < 1e-9, "{right} {left}");
    }
}
