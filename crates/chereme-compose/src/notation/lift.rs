//! Raises hands that hung at rest: to take part in the sign, or for their arm to be touched.

use chereme_motion::glam::DVec3;
use chereme_sign::hamnosys::sites::{HandPoint, Region, body_site};
use chereme_sign::hamnosys::{BodyLocation, BodyPlace, Contact, Place, Posture, Side as At, Site};

use super::pace::Pace;
use super::plan::{Frame, HandState, PhaseKind, Planner, Signer, Who, acting};

impl Planner<'_> {
    /// Raises a hand from rest to its default place before the body.
    pub(crate) fn raise(&mut self, n: usize) {
        let frame = self.own_side(n);
        let forward = self.signer.language.medium_trunk * self.signer.stage.arm;
        let at = DVec3::new(
            -0.45 * frame.axes.x * self.signer.stage.shoulders,
            -0.85 * self.signer.stage.shoulders,
            forward,
        );
        self.hold(n, frame, at, DVec3::new(0.5, 0.0, 0.87), 0.0);
    }

    /// Raises hanging arms that the posture uses as a location; returns which.
    pub(crate) fn lift(&mut self, posture: &Posture, named: Who) -> [bool; 2] {
        let mut lifted = [false; 2];
        let Some(Place::Body(place)) = &posture.place else {
            return lifted;
        };
        for (n, frame) in acting(named) {
            let other = 1 - n;
            let Some(part) = self.signer.touched(n, place, frame) else {
                continue;
            };
            if named[other].is_some() {
                continue;
            }
            lifted[other] = true;
            if self.state[other].used {
                continue;
            }
            let own = self.own_side(other);
            let (sh, arm) = (self.signer.stage.shoulders, self.signer.stage.arm);
            match part {
                Touched::Inside => {
                    let at = DVec3::new(-0.30 * own.axes.x * sh, -0.46 * arm, 0.66 * arm);
                    let palm_up = std::f64::consts::PI;
                    self.hold(other, own, at, DVec3::new(0.17, -0.17, 0.97), palm_up);
                }
                Touched::Along => {
                    let at = DVec3::new(0.02 * own.axes.x * sh, -0.42 * arm, 0.46 * arm);
                    self.hold(other, own, at, DVec3::new(0.94, 0.0, 0.34), 0.0);
                }
            }
        }
        lifted
    }

    /// Plans the transitions of raised arms.
    pub(crate) fn lifted(
        &mut self,
        lifted: [bool; 2],
        goal: &[HandState; 2],
        [from, to]: [f64; 2],
    ) {
        for n in (0..2).filter(|&n| lifted[n]) {
            if self.state[n] != goal[n] {
                self.go(n, &goal[n], from, to, Pace::Lax);
                self.phase(n, PhaseKind::Transition, from, to, "");
            }
        }
    }

    /// Returns the frame of a hand on its own side.
    fn own_side(&self, n: usize) -> Frame {
        let mut frame = self.signer.own_frame();
        if n == 1 {
            frame.axes.x = -frame.axes.x;
        }
        frame
    }

    /// Puts a hand with its palm at a position relative to the middle of the shoulders (left, up, forward;
    /// m); `direction` and `palm` are in its frame.
    fn hold(&mut self, n: usize, frame: Frame, at: DVec3, direction: DVec3, palm: f64) {
        self.state[n].used = true;
        self.state[n].direction = direction.normalize();
        self.state[n].palm = palm;
        self.state[n].axes = [frame.axes; 2];
        self.turn(n);
        self.state[n].offset = self.hands().offset(n, &[HandPoint::Palm]);
        self.state[n].point = self.signer.stage.middle() + self.signer.stage.direction(at);
    }
}

impl Signer<'_> {
    /// Returns the part of the other arm that a hand touches at a place, if any.
    fn touched(&self, n: usize, place: &BodyPlace, frame: Frame) -> Option<Touched> {
        let near = matches!(
            place.contact,
            Some(Contact::Touch | Contact::Brushing | Contact::Close | Contact::Cross)
        );
        let other = Region::Arm(self.sides[1 - n]);
        let sites = [place.site.as_ref(), place.second.as_ref()];
        let sites = sites.into_iter().flatten();
        let mut sites = sites.filter(|site| {
            let found = body_site(site, self.sides[n], frame.mirrored);
            found.region == other && !matches!(site.at, BodyLocation::UpperArm)
        });
        let first = sites.next().filter(|_| near)?;
        let inside = inside(first) || sites.any(inside);
        Some(if inside {
            Touched::Inside
        } else {
            Touched::Along
        })
    }
}

/// The part of an arm that is touched.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Touched {
    /// The inside of the elbow or of the forearm.
    Inside,
    /// The forearm or the elbow, from above.
    Along,
}

/// Returns whether a place on an arm is on its inside.
pub(crate) fn inside(site: &Site<BodyLocation>) -> bool {
    site.at == BodyLocation::ElbowInside || matches!(site.side, Some(At::Palmar | At::Front))
}
