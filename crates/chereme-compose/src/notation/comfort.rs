//! Shifts hands within their place for the comfort of the arm.
//!
//! A notated place in space is a region, and the position within it decides how well the wrist can hold
//! the notated orientation. A hand that touches nothing is shifted by a few centimetres, with all of the
//! movement that begins there, so that the arm can keep that orientation and stay out of the trunk. The
//! body language limits the shift (`room`) to the distance at which another place would be read.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_sign::hamnosys::{BodyLocation, BodyPlace, HandPlace, NotatedMotion, PlaceContact};

use super::notation_motion::InheritedModifiers;
use super::notation_path::HandPath;
use super::notation_place::is_at_hand;
use super::notation_plan::{ActingHands, NotationSigner, PlannedHands, SignPlanner, iterate_acting_hands};
use super::notation_solve::ArmSolver;
use super::notation_tuned::tuned;

/// The number of postures to evaluate: those that strain the arm most.
const COMFORT_POSTURE_COUNT: usize = 6;

/// Position and orientation of a hand at one moment of a sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HandStance {
    pub(crate) point: DVec3,
    pub(crate) rotation: DQuat,
    pub(crate) offset: DVec3,
}

/// Collects the stances of the hands during a trial plan.
#[derive(Debug, Default)]
pub(crate) struct StanceTrail {
    /// Depth of nested simultaneous motions, whose intermediate stances do not count.
    pub(crate) within: usize,
    /// Whether the hands went to a place of their own: later stances do not move with the shift.
    over: bool,
    seen: Vec<(usize, HandStance)>,
}

impl SignPlanner<'_> {
    /// Begins a part of a motion whose intermediate stances do not count.
    pub(crate) fn enter_trail_part(&mut self) {
        if let Some(trail) = &mut self.trail {
            trail.within += 1;
        }
    }

    /// Records the stances of a hand on a path from its current state, at these shares of the path.
    pub(crate) fn pass_along_path(&mut self, n: usize, path: &HandPath, shares: impl Iterator<Item = f64>) {
        let Some(mut trail) = self.trail.take() else {
            return;
        };
        if trail.within == 0 && !trail.over {
            for share in shares {
                let mut stance = self.planned_hands().current_hand_stance(n);
                stance.point += path.path_point_at(share);
                trail.note_hand_stance(n, stance);
            }
        }
        self.trail = Some(trail);
    }

    /// Ends such a part, or any motion of the acting hands, and records their stances.
    pub(crate) fn leave_trail_part(&mut self, who: ActingHands, entered: bool) {
        let Some(mut trail) = self.trail.take() else {
            return;
        };
        trail.within -= usize::from(entered);
        if trail.within == 0 && !trail.over {
            for (n, _) in iterate_acting_hands(who) {
                trail.note_hand_stance(n, self.planned_hands().current_hand_stance(n));
            }
        }
        self.trail = Some(trail);
    }

    /// Records that the hands go to a place of their own.
    pub(crate) fn note_placed_hands(&mut self) {
        if let Some(trail) = &mut self.trail {
            trail.over = true;
        }
    }

    /// Shifts hands within their place to where their arms are comfortable, now and during `follows`. At
    /// the start of a part that names no place, the whole space before the trunk is allowed.
    pub(crate) fn ease_hand_places(
        &mut self,
        place: &HandPlace,
        named: ActingHands,
        follows: Option<(&[NotatedMotion], ActingHands)>,
    ) {
        if self.trail.is_some() {
            return;
        }
        match place {
            HandPlace::Body(body) => {
                let axes = named.map(|frame| frame.map(|frame| frame.axes));
                let free = body
                    .site
                    .is_none_or(|site| site.at == BodyLocation::NeutralSpace && site.side.is_none());
                let room = match (body.contact, follows) {
                    (None, Some(_)) if free => Some(self.signer.anywhere(1.0)),
                    _ => self.signer.place_room_share(self.signer.body_place_room(body)),
                };
                self.shift_strained_hands(room, axes, named, follows);
            }
            // A hand at the other one would not shift with it.
            HandPlace::Split(a, b) if [a, b].into_iter().flatten().any(|place| is_at_hand(place)) => {}
            HandPlace::Split(a, b) => {
                for (n, place) in [a, b].into_iter().enumerate() {
                    let mut only: ActingHands = [None, None];
                    only[n] = named[n].or(Some(self.signer.own_frame()));
                    if let Some(place) = place {
                        self.ease_hand_places(place, only, follows);
                    }
                }
            }
            HandPlace::Hands(hands) => {
                let room = match (&hands.at, follows) {
                    (None, Some(_)) => Some(self.signer.anywhere(tuned().comfort.taken)),
                    (at, _) => self
                        .signer
                        .place_room_share(at.as_ref().map_or(1.0, |at| self.signer.body_place_room(at))),
                };
                // Hands that are placed relative to each other shift together.
                let one = Some(DVec3::ONE);
                self.shift_strained_hands(room, [one; 2], named, follows);
            }
            HandPlace::Hand(_) if follows.is_some() => {
                let [Some(a), Some(b)] = named else { return };
                if a.is_mirrored_by(&b) {
                    let one = Some(DVec3::ONE);
                    let room = self.signer.anywhere(tuned().comfort.taken);
                    self.shift_strained_hands(Some(room), [one; 2], named, follows);
                }
            }
            HandPlace::Hand(_) | HandPlace::Named(_) => {}
        }
    }

    /// Returns the stances of hands that count, now and during `follows`, those that strain the arm most first; empty if
    /// none strains it.
    pub(crate) fn strained_stances(
        &mut self,
        named: ActingHands,
        follows: Option<(&[NotatedMotion], ActingHands)>,
        counts: impl Fn(usize, &HandStance) -> bool,
    ) -> Vec<(usize, HandStance)> {
        let mut trail = StanceTrail::default();
        for (n, _) in iterate_acting_hands(named) {
            trail.note_hand_stance(n, self.planned_hands().current_hand_stance(n));
        }
        if let Some((motions, who)) = follows {
            self.trail = Some(trail);
            self.run_trial_plan(|planner| {
                let mut now = 0.0;
                for motion in motions {
                    now = planner.plan_motion(motion, who, now, &InheritedModifiers::default());
                }
            });
            trail = self.trail.take().unwrap_or_default();
        }
        let seen_stances = trail.seen.into_iter();
        let all = seen_stances.filter(|(n, stance)| counts(*n, stance));
        let mut all: Vec<(f64, (usize, HandStance))> = all
            .map(|(n, stance)| (self.signer.arm_stance_strain(n, &stance, DVec3::ZERO), (n, stance)))
            .collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        let most = all.first().map_or(0.0, |(most, _)| *most);
        if most < tuned().comfort.strained {
            return Vec::new();
        }
        all.into_iter().map(|(_, stance)| stance).collect()
    }

    /// Shifts hands within a room (arm lengths) to reduce the strain of their arms.
    fn shift_strained_hands(
        &mut self,
        room: Option<[DVec3; 2]>,
        axes: [Option<DVec3>; 2],
        named: ActingHands,
        follows: Option<(&[NotatedMotion], ActingHands)>,
    ) {
        let Some(room) = room.map(|ends| ends.map(|ends| ends * self.signer.stage.arm)) else {
            return;
        };
        let mut strained = self.strained_stances(named, follows, |n, _| axes[n].is_some());
        strained.truncate(COMFORT_POSTURE_COUNT);
        if strained.is_empty() {
            return;
        }
        let by = |local: DVec3, n: usize| {
            let axes = axes[n].unwrap_or(DVec3::ONE);
            self.signer.stage.body_to_model_direction(local * axes)
        };
        // Sums above `most` need not be exact.
        let cost = |local: DVec3, most: f64| {
            let shifted = tuned().comfort.shifted * room_distance_share(local, room).powi(2);
            let mut sum = 0.0;
            for (n, stance) in &strained {
                let left = most - shifted - sum;
                sum += self.signer.strain_up_to(left, *n, stance, by(local, *n));
                if sum + shifted >= most {
                    return f64::INFINITY;
                }
            }
            sum + shifted
        };
        let best = find_lowest_cost_offset(cost, room);
        let shifts = [0, 1].map(|n| by(best, n));
        for (n, _) in iterate_acting_hands(named) {
            let was = self.state[n].point;
            self.state[n].point += shifts[n];
            let now = self.state[n].point;
            for at in self.named.values_mut() {
                at[n] = at[n].map(|at| if at == was { now } else { at });
            }
        }
    }
}

impl NotationSigner<'_> {
    /// Returns a share of the room at a place, as its lower and upper ends (left, up, forward) in arm
    /// lengths.
    fn place_room_share(&self, share: f64) -> Option<[DVec3; 2]> {
        let l = self.language;
        let ends = [
            DVec3::new(l.room_side, l.room_down, l.room_back),
            DVec3::new(l.room_side, l.room_up, l.room_forward),
        ];
        let taken = share * tuned().comfort.taken;
        (share > 0.0).then(|| ends.map(|ends| ends.max(DVec3::splat(1e-4)) * taken))
    }

    /// Returns a share of the room of a hand without a notated place, as its lower and upper ends in arm lengths.
    fn anywhere(&self, share: f64) -> [DVec3; 2] {
        let l = self.language;
        [
            DVec3::new(l.room_free_out, l.room_free_down, l.room_free_back),
            DVec3::new(l.room_free_in, l.room_free_up, l.room_free_forward),
        ]
        .map(|ends| ends.max(DVec3::splat(1e-4)) * share)
    }

    /// Returns the strain of an arm whose hand is shifted by an offset (m).
    pub(crate) fn arm_stance_strain(&self, n: usize, stance: &HandStance, by: DVec3) -> f64 {
        self.strain_up_to(f64::INFINITY, n, stance, by)
    }

    /// Returns the same; infinite if the strain is at least `most`.
    pub(crate) fn strain_up_to(&self, most: f64, n: usize, stance: &HandStance, by: DVec3) -> f64 {
        let Some(hand) = self.stage.hand_of_side(self.sides[n]) else {
            return 0.0;
        };
        let point = stance.point + by;
        let raw_depth = self
            .stage
            .torso
            .offset_out_of_trunk(point, tuned().comfort.near)
            .length()
            / self.stage.arm;
        let deep = 1.2e4 * raw_depth * raw_depth;
        if deep >= most {
            return f64::INFINITY;
        }
        let wrist = point - stance.rotation * stance.offset;
        let arm = ArmSolver::solver_for_hand(self.stage, hand, &self.limits);
        match arm.best_posture_cost(wrist, stance.rotation, most - deep) {
            strain if strain < most - deep => deep + strain,
            _ => f64::INFINITY,
        }
    }
}

impl PlannedHands<'_> {
    pub(crate) fn current_hand_stance(&self, n: usize) -> HandStance {
        let state = &self.state[n];
        HandStance {
            point: state.point,
            rotation: state.rotation,
            offset: state.offset,
        }
    }
}

impl NotationSigner<'_> {
    /// Returns the share of the room that a hand has at a place: zero in contact.
    fn body_place_room(&self, place: &BodyPlace) -> f64 {
        let l = self.language;
        let trunk = place.site.is_none_or(|site| before_trunk(site.at));
        match (place.contact, trunk) {
            _ if place.behind => 0.0,
            (None | Some(PlaceContact::ArmExtended), true) => 1.0,
            (Some(PlaceContact::ArmExtended), false) | (Some(PlaceContact::Close), true) => l.room_close,
            (None | Some(PlaceContact::Close), false) => l.room_face,
            _ => 0.0,
        }
    }
}

impl StanceTrail {
    fn note_hand_stance(&mut self, n: usize, stance: HandStance) {
        let near = |(other, known): &(usize, HandStance)| {
            *other == n
                && known.point.distance(stance.point) < 5e-3
                && known.rotation.angle_between(stance.rotation) < 0.05
        };
        if !self.seen.iter().any(near) {
            self.seen.push((n, stance));
        }
    }
}

/// Returns whether a place lies before the trunk.
fn before_trunk(at: BodyLocation) -> bool {
    use BodyLocation as B;
    matches!(
        at,
        B::NeutralSpace | B::Shoulders | B::ShoulderTop | B::Chest | B::Stomach | B::BelowStomach | B::Neck | B::Head
    )
}

/// Returns the distance of an offset from the middle of a room, as a share: 1 at its end, which may differ between
/// directions.
fn room_distance_share(at: DVec3, [less, more]: [DVec3; 2]) -> f64 {
    let end = |at: f64, less: f64, more: f64| if at < 0.0 { at / less } else { at / more };
    let [x, y, z] = [0, 1, 2].map(|n| end(at[n], less[n], more[n]));
    DVec3::new(x, y, z).length()
}

/// Returns an offset with a low cost, by a search along the axes from the origin. `cost(offset, limit)`
/// may return any number above the limit instead of the exact cost.
pub(crate) fn find_lowest_cost_offset(cost: impl Fn(DVec3, f64) -> f64, room: [DVec3; 2]) -> DVec3 {
    let (mut best, mut step) = (DVec3::ZERO, 0.7);
    let mut least = cost(best, f64::INFINITY);
    for _ in 0..7 {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let near = axes
            .into_iter()
            .flat_map(|axis| [best - axis * room[0] * step, best + axis * room[1] * step]);
        let mut next = (best, least - 1e-3);
        for at in near.filter(|at| room_distance_share(*at, room) <= 1.0) {
            let cost = cost(at, next.1);
            if cost < next.1 {
                next = (at, cost);
            }
        }
        match next {
            (at, lower) if at != best => (best, least) = (at, lower),
            _ if step < 0.2 => break,
            _ => step *= 0.5,
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use chereme_sign::SignerHandedness;
    use chereme_sign::hamnosys::{BodyLanguage, HandClass};

    use super::super::notation_stage::StandingBody;
    use super::super::pace::PaceTables;
    use super::super::tests::{at, posture, stage};
    use super::*;
    use crate::testing::Axes;

    #[test]
    fn hands_move_to_the_least_cost_within_their_tolerance() {
        let room = [DVec3::new(0.03, 0.01, 0.03); 2];
        let at = DVec3::new(0.012, 0.0, -0.006);
        let near = find_lowest_cost_offset(|by, _| by.distance_squared(at) * 1e4, room);
        assert!(near.distance(at) < 6e-3, "{near}");
        let far = find_lowest_cost_offset(|by, _| 10.0 * by.distance(DVec3::new(0.5, 0.0, 0.0)), room);
        assert!(far.x > 0.02 && room_distance_share(far, room) <= 1.0, "{far}");
        assert_eq!(find_lowest_cost_offset(|by, _| by.length_squared(), room), DVec3::ZERO);
    }

    #[test]
    fn a_strained_hand_is_shifted_only_as_far_as_that_helps() {
        let material = stage(Axes::Plain);
        let body = StandingBody::body_from_material(&material).expect("a body");
        let paces = PaceTables::pace_tables_from_language(BodyLanguage::default_body_language());
        let language = BodyLanguage::default_body_language();
        let shifted = |room: f64, along: &str, palm: &str| {
            let mut planner = SignPlanner::new(&body, language, &paces, SignerHandedness::Right, 60.0);
            let who = [Some(planner.signer.own_frame()), None];
            let place = at(BodyLocation::Chest, None);
            let begun = posture(HandClass::Flat, along, palm, Some(place));
            planner.assume_posture(&begun, who, false);
            let before = planner.planned_hands().current_hand_stance(0);
            let axes = [Some(DVec3::ONE), None];
            planner.shift_strained_hands(Some([DVec3::splat(room); 2]), axes, who, None);
            let after = planner.planned_hands().current_hand_stance(0);
            let strain = |stance| planner.signer.arm_stance_strain(0, stance, DVec3::ZERO);
            let ends = [DVec3::splat(room * body.arm); 2];
            let by = after.point - before.point;
            (room_distance_share(by, ends), [strain(&before), strain(&after)])
        };
        let (share, strain) = shifted(0.135, "d", "l");
        assert!(
            strain[0] > tuned().comfort.strained && share > 0.0,
            "{share} {strain:?}"
        );
        assert!(
            strain[1] + tuned().comfort.shifted * share * share < strain[0],
            "{strain:?}"
        );
        let (share, strain) = shifted(4.5e-4, "d", "l");
        assert!(strain[0] > tuned().comfort.strained, "{strain:?}");
        assert_eq!(share, 0.0, "no place so near relieves the arm");
        let (share, strain) = shifted(0.135, "l", "d");
        assert!(
            strain[0] < tuned().comfort.strained && share == 0.0,
            "{share} {strain:?}"
        );
    }

    #[test]
    fn each_of_two_places_eases_its_hand_unless_one_hand_is_at_the_other() {
        use chereme_sign::hamnosys::{HandLocation, HandSite};
        let material = stage(Axes::Plain);
        let body = StandingBody::body_from_material(&material).expect("a body");
        let paces = PaceTables::pace_tables_from_language(BodyLanguage::default_body_language());
        let language = BodyLanguage::default_body_language();
        let at_hand = HandPlace::Hand(HandSite {
            at: Some(HandLocation::Palm),
            ..HandSite::default()
        });
        let chest = || Some(Box::new(at(BodyLocation::Chest, None)));
        for (other, moves) in [(chest(), true), (Some(Box::new(at_hand)), false), (None, true)] {
            let mut planner = SignPlanner::new(&body, language, &paces, SignerHandedness::Right, 60.0);
            let who = [Some(planner.signer.own_frame()), None];
            let place = at(BodyLocation::Chest, None);
            let begun = posture(HandClass::Flat, "d", "l", Some(place));
            planner.assume_posture(&begun, who, false);
            let before = planner.planned_hands().current_hand_stance(0);
            planner.ease_hand_places(&HandPlace::Split(chest(), other.clone()), who, None);
            let shifted = planner
                .planned_hands()
                .current_hand_stance(0)
                .point
                .distance(before.point);
            assert_eq!(shifted > 1e-3, moves, "{other:?}: {shifted}");
        }
    }
}
