//! Raises hands that hung at rest: to take part in the sign, or for their arm to be touched.

use chereme_motion::glam::DVec3;
use chereme_sign::hamnosys::sites::{BodyRegion, NotatedHandPoint, resolve_body_site};
use chereme_sign::hamnosys::{
    BodyLocation, BodyPlace, HandPlace, LocationSide as At, NotatedPosture, PlaceContact, SidedLocation,
};

use super::notation_plan::{
    ActingFrame, ActingHands, HandState, NotationSigner, PhaseKind, SignPlanner, iterate_acting_hands,
};
use super::pace::MovementPace;

impl SignPlanner<'_> {
    /// Raises a hand from rest to its default place before the body.
    pub(crate) fn raise_resting_hand(&mut self, n: usize) {
        let frame = self.own_side(n);
        let forward = self.signer.language.medium_trunk * self.signer.stage.arm;
        let raised_point = DVec3::new(
            -0.45 * frame.axes.x * self.signer.stage.shoulders,
            -0.85 * self.signer.stage.shoulders,
            forward,
        );
        self.hold_palm_at(n, frame, raised_point, DVec3::new(0.5, 0.0, 0.87), 0.0);
    }

    /// Raises hanging arms that the posture uses as a location; returns which.
    pub(crate) fn lift_touched_arms(&mut self, posture: &NotatedPosture, named: ActingHands) -> [bool; 2] {
        let mut lifted = [false; 2];
        let Some(HandPlace::Body(place)) = &posture.place else {
            return lifted;
        };
        for (n, frame) in iterate_acting_hands(named) {
            let other = 1 - n;
            let Some(part) = self.signer.touched_arm_part(n, place, frame) else {
                continue;
            };
            if named[other].is_some() {
                continue;
            }
            lifted[other] = true;
            if self.state[other].used {
                continue;
            }
            let side_frame = self.own_side(other);
            let (sh, arm) = (self.signer.stage.shoulders, self.signer.stage.arm);
            match part {
                TouchedArmPart::Inside => {
                    let hold_point = DVec3::new(-0.30 * side_frame.axes.x * sh, -0.46 * arm, 0.66 * arm);
                    let palm_up = std::f64::consts::PI;
                    self.hold_palm_at(other, side_frame, hold_point, DVec3::new(0.17, -0.17, 0.97), palm_up);
                }
                TouchedArmPart::Along => {
                    let hold_point = DVec3::new(0.02 * side_frame.axes.x * sh, -0.42 * arm, 0.46 * arm);
                    self.hold_palm_at(other, side_frame, hold_point, DVec3::new(0.94, 0.0, 0.34), 0.0);
                }
            }
        }
        lifted
    }

    /// Plans the transitions of raised arms.
    pub(crate) fn plan_lifted_arms(&mut self, lifted: [bool; 2], goal: &[HandState; 2], [from, to]: [f64; 2]) {
        for n in (0..2).filter(|&n| lifted[n]) {
            if self.state[n] != goal[n] {
                self.go_to_hand_goal(n, &goal[n], from, to, MovementPace::Lax);
                self.add_hand_phase(n, PhaseKind::Transition, from, to, "");
            }
        }
    }

    /// Returns the frame of a hand on its own side.
    fn own_side(&self, n: usize) -> ActingFrame {
        let mut frame = self.signer.own_frame();
        if n == 1 {
            frame.axes.x = -frame.axes.x;
        }
        frame
    }

    /// Puts a hand with its palm at a position relative to the middle of the shoulders (left, up, forward;
    /// m); `direction` and `palm` are in its frame.
    fn hold_palm_at(&mut self, n: usize, frame: ActingFrame, at: DVec3, direction: DVec3, palm: f64) {
        self.state[n].used = true;
        self.state[n].direction = direction.normalize();
        self.state[n].palm = palm;
        self.state[n].axes = [frame.axes; 2];
        self.turn_hand_to_notation(n);
        self.state[n].offset = self.planned_hands().mean_hand_point(n, &[NotatedHandPoint::Palm]);
        self.state[n].point = self.signer.stage.shoulder_middle() + self.signer.stage.body_to_model_direction(at);
    }
}

impl NotationSigner<'_> {
    /// Returns the part of the other arm that a hand touches at a place, if any.
    fn touched_arm_part(&self, n: usize, place: &BodyPlace, frame: ActingFrame) -> Option<TouchedArmPart> {
        let near = matches!(
            place.contact,
            Some(PlaceContact::Touch | PlaceContact::Brushing | PlaceContact::Close | PlaceContact::Cross)
        );
        let other = BodyRegion::Arm(self.sides[1 - n]);
        let site_options = [place.site.as_ref(), place.second.as_ref()];
        let sites = site_options.into_iter().flatten();
        let mut sites = sites.filter(|site| {
            let body_spot = resolve_body_site(site, self.sides[n], frame.mirrored);
            body_spot.region == other && !matches!(site.at, BodyLocation::UpperArm)
        });
        let first = sites.next().filter(|_| near)?;
        let inside = is_inner_arm_place(first) || sites.any(is_inner_arm_place);
        Some(if inside {
            TouchedArmPart::Inside
        } else {
            TouchedArmPart::Along
        })
    }
}

/// The part of an arm that is touched.
#[derive(Debug, Clone, Copy, PartialEq)]
enum TouchedArmPart {
    /// The inside of the elbow or of the forearm.
    Inside,
    /// The forearm or the elbow, from above.
    Along,
}

/// Returns whether a place on an arm is on its inside.
pub(crate) fn is_inner_arm_place(site: &SidedLocation<BodyLocation>) -> bool {
    site.at == BodyLocation::ElbowInside || matches!(site.side, Some(At::Palmar | At::Front))
}
