//! Turns hands within their notated orientation for the comfort of the arm.
//!
//! A notated direction is a region, too: 45 degrees lie between two directions. People turn a hand by a few degrees
//! rather than lift the elbow or fold the wrist. A hand whose arm is strained is turned about its reference point, as
//! long as it keeps this orientation.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_sign::hamnosys::NotatedMotion;
use chereme_sign::hamnosys::sites::NotatedHandPoint;

use super::comfort::{HandStance, find_lowest_cost_offset};
use super::notation_plan::{ActingFrame, ActingHands, SignPlanner, iterate_acting_hands};
use super::notation_tuned::tuned;

/// The number of postures to evaluate: those that strain the arm most.
const LEAN_POSTURE_COUNT: usize = 3;

impl SignPlanner<'_> {
    /// Turns hands by a few degrees to where their arms are comfortable, now and during `follows`, while they keep
    /// their orientation. Only hands that strain their arm now turn. Hands that mirror each other turn alike; if they
    /// also meet, they only nod together.
    pub(crate) fn lean_strained_hands(&mut self, named: ActingHands, follows: Option<(&[NotatedMotion], ActingHands)>) {
        if self.trail.is_some() || self.trials > 0 {
            return;
        }
        let meet = self.together.is_some();
        // Palms on each other or on the skin stay as they are: they would part at their fingertips.
        let flat = |n: usize, frame: ActingFrame| {
            let palm = self.planned_hands().mean_hand_point(n, &[NotatedHandPoint::Palm]);
            let on_palm = self.state[n].offset.distance(palm) < 1e-9;
            on_palm && (meet || self.skin_normal_at_hand(n, frame).is_some())
        };
        let mut free: ActingHands = [None, None];
        for (n, frame) in iterate_acting_hands(named) {
            let written = self.state[n].leaned == DQuat::IDENTITY;
            free[n] = Some(frame).filter(|frame| written && !flat(n, *frame));
        }
        match free {
            [Some(own), Some(other)] if own.is_mirrored_by(&other) => self.lean_by(free, follows, meet),
            _ if meet => {}
            _ => {
                for (n, frame) in iterate_acting_hands(free) {
                    let mut only: ActingHands = [None, None];
                    only[n] = Some(frame);
                    self.lean_by(only, follows, false);
                }
            }
        }
    }

    /// Takes back the turn by which a hand leans: it has its written orientation again.
    pub(crate) fn restore_upright_hand(&mut self, n: usize) {
        let state = &mut self.state[n];
        state.rotation = (state.rotation * state.leaned.inverse()).normalize();
        state.leaned = DQuat::IDENTITY;
    }

    fn lean_by(&mut self, named: ActingHands, follows: Option<(&[NotatedMotion], ActingHands)>, nods: bool) {
        let strains = |n: usize| {
            let stance = self.planned_hands().current_hand_stance(n);
            self.signer.arm_stance_strain(n, &stance, DVec3::ZERO) > tuned().comfort.strained
        };
        if !iterate_acting_hands(named).any(|(n, _)| strains(n)) {
            return;
        }
        let begun = [0, 1].map(|n| self.state[n].rotation);
        let same = |n: usize, stance: &HandStance| named[n].is_some() && stance.rotation.angle_between(begun[n]) < 0.05;
        let mut seen = self.strained_stances(named, follows, same);
        seen.truncate(LEAN_POSTURE_COUNT);
        let stage = self.signer.stage;
        let turn = |local: DVec3, n: usize| {
            let axes = named[n].map_or(DVec3::ONE, |frame| frame.axes);
            // An axis of rotation keeps its sign where a direction changes it.
            let axis = stage.body_to_model_direction(local * axes * axes.element_product());
            DQuat::from_scaled_axis(axis)
        };
        let most = tuned().comfort.most_leaned;
        let across = if nods { 1e-4 } else { most };
        let room = [DVec3::new(most, across, across); 2];
        let cost = |local: DVec3, limit: f64| {
            let mut sum = tuned().comfort.leaned * (local.length() / most).powi(2);
            for (n, stance) in &seen {
                let turned = HandStance {
                    rotation: turn(local, *n) * stance.rotation,
                    ..*stance
                };
                sum += self.signer.strain_up_to(limit - sum, *n, &turned, DVec3::ZERO);
                if sum >= limit {
                    return f64::INFINITY;
                }
            }
            sum
        };
        let best = find_lowest_cost_offset(cost, room);
        if best == DVec3::ZERO {
            return;
        }
        for (n, _) in iterate_acting_hands(named) {
            let state = &mut self.state[n];
            let written = state.rotation;
            state.rotation = (turn(best, n) * written).normalize();
            state.leaned = (written.inverse() * state.rotation).normalize();
        }
    }
}

#[cfg(test)]
mod tests {
    use chereme_sign::SignerHandedness;
    use chereme_sign::hamnosys::{BodyLanguage, BodyLocation, HandClass, NotatedPosture};

    use super::super::notation_stage::StandingBody;
    use super::super::notation_track::follow_hand_events;
    use super::super::pace::{MovementPace, PaceTables};
    use super::super::tests::{at, mirrored, posture, stage};
    use super::*;
    use crate::testing::Axes;

    /// Plans a posture, and returns for each hand its rotation before and after it leans, and its strain before and
    /// after.
    fn leaned(along: &str, palm: &str, both: bool) -> [([DQuat; 2], [f64; 2]); 2] {
        let material = stage(Axes::Plain);
        let body = StandingBody::body_from_material(&material).expect("a body");
        let paces = PaceTables::pace_tables_from_language(BodyLanguage::default_body_language());
        let language = BodyLanguage::default_body_language();
        let mut planner = SignPlanner::new(&body, language, &paces, SignerHandedness::Right, 60.0);
        let who = match both {
            true => planner.acting_part_hands(mirrored()),
            false => [Some(planner.signer.own_frame()), None],
        };
        let place = at(BodyLocation::Chest, None);
        let begun = posture(HandClass::Flat, along, palm, Some(place));
        planner.assume_posture(&begun, who, false);
        let seen = |planner: &SignPlanner<'_>| {
            [0, 1].map(|n| {
                let stance = planner.planned_hands().current_hand_stance(n);
                let strain = planner.signer.arm_stance_strain(n, &stance, DVec3::ZERO);
                (stance.rotation, strain)
            })
        };
        let before = seen(&planner);
        planner.lean_strained_hands(who, None);
        let after = seen(&planner);
        [0, 1].map(|n| {
            let [(was, strained), (is, eased)] = [before[n], after[n]];
            ([was, is], [strained, eased])
        })
    }

    #[test]
    fn a_strained_hand_turns_a_little_where_that_relieves_its_arm() {
        let ([was, is], [strained, eased]) = leaned("d", "l", false)[0];
        assert!(strained > tuned().comfort.strained, "{strained}");
        assert!(eased < 0.9 * strained, "{strained} {eased}");
        let angle = was.angle_between(is);
        assert!(angle > 0.02 && angle <= tuned().comfort.most_leaned + 1e-6, "{angle}");
    }

    #[test]
    fn turns_do_not_add_up_from_one_place_to_the_next() {
        let material = stage(Axes::Plain);
        let body = StandingBody::body_from_material(&material).expect("a body");
        let paces = PaceTables::pace_tables_from_language(BodyLanguage::default_body_language());
        let language = BodyLanguage::default_body_language();
        let mut planner = SignPlanner::new(&body, language, &paces, SignerHandedness::Right, 60.0);
        let who = [Some(planner.signer.own_frame()), None];
        let chest = Some(at(BodyLocation::Chest, None));
        planner.assume_posture(&posture(HandClass::Flat, "d", "l", chest), who, false);
        let written = planner.state[0].rotation;
        let mut leans = 0;
        for place in [BodyLocation::Shoulders, BodyLocation::Chest].repeat(3) {
            planner.lean_strained_hands(who, None);
            planner.lean_strained_hands(who, None);
            let angle = planner.state[0].rotation.angle_between(written);
            assert!(angle <= tuned().comfort.most_leaned + 1e-6, "{angle}");
            leans += usize::from(angle > 0.02);
            let onwards = NotatedPosture {
                place: Some(at(place, None)),
                ..NotatedPosture::default()
            };
            planner.assume_posture(&onwards, who, true);
            assert!(planner.state[0].rotation.angle_between(written) < 1e-6);
        }
        assert!(leans > 2, "{leans}");
    }

    #[test]
    fn the_written_orientation_is_known_in_every_frame() {
        let material = stage(Axes::Plain);
        let body = StandingBody::body_from_material(&material).expect("a body");
        let paces = PaceTables::pace_tables_from_language(BodyLanguage::default_body_language());
        let language = BodyLanguage::default_body_language();
        let mut planner = SignPlanner::new(&body, language, &paces, SignerHandedness::Right, 60.0);
        let who = [Some(planner.signer.own_frame()), None];
        let before = planner.state.clone();
        let chest = Some(at(BodyLocation::Chest, None));
        planner.assume_posture(&posture(HandClass::Flat, "d", "l", chest), who, false);
        let written = planner.state[0].rotation;
        planner.lean_strained_hands(who, None);
        let goal = planner.state[0].clone();
        assert!(goal.rotation.angle_between(written) > 0.02);
        planner.state = before;
        planner.travel_to_goal(0, &goal, 0.0, 1.0, MovementPace::Linear);
        let (start, events) = (&planner.plan.start[0], &planner.plan.events[0]);
        let goals = follow_hand_events(start, events, 60.0, 90, |_, share| share);
        let known = goals.turns[80] * goals.leans[80].inverse();
        assert!(known.angle_between(written) < 1e-6);
        assert!(goals.turns[0].angle_between(start.rotation) < 1e-6);
        assert_eq!(goals.leans[0], DQuat::IDENTITY);
    }

    #[test]
    fn a_hand_without_strain_keeps_the_written_orientation() {
        let ([was, is], [strained, _]) = leaned("l", "d", false)[0];
        assert!(strained < tuned().comfort.strained, "{strained}");
        assert_eq!(was, is);
    }

    #[test]
    fn hands_that_mirror_each_other_turn_alike() {
        let both = leaned("d", "l", true);
        let turns = both.map(|([was, is], _)| (is * was.inverse()).to_scaled_axis());
        assert!(turns[0].length() > 0.02, "{turns:?}");
        // A mirror to the left and right keeps the part of an axis of rotation across it and reverses the rest.
        let mirror = turns[0] * DVec3::new(1.0, -1.0, -1.0);
        assert!(mirror.distance(turns[1]) < 1e-6, "{turns:?}");
    }
}
