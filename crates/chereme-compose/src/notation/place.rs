//! Places hands: on the body, in space, at the other hand, and in constellations.
//!
//! The reference point of the hand follows Kennaway's discussion in section 4.1: the middle of the palm in
//! free space; at a place on the body, the point that meets it first in the hand's orientation.

use chereme_motion::Side;
use chereme_motion::glam::DVec3;
use chereme_sign::hamnosys::sites::{
    BodySite, FLESH, FRONT, Face, HandAt, HandPoint, Region, body_site, coming_first, hand_points,
};
use chereme_sign::hamnosys::{
    BodyLocation, BodyPlace, Constellation, Contact, Digit, HandSite, Place, Site,
};

use super::lift::inside;
use super::plan::{Frame, Hands, Planner, Signer, Who, acting};
use super::solve::Arm;
use super::stage::FINGER_FLESH;
use super::tuned::tuned;

/// Returns whether a place is at the other hand.
pub(super) fn is_at_hand(place: &Place) -> bool {
    matches!(place, Place::Hand(_))
}

/// The goal of a hand's reference point.
#[derive(Debug, Clone)]
pub(super) struct Goal {
    pub(super) at: DVec3,
    pub(super) points: Vec<HandPoint>,
    /// Whether the touching face of the hand is moved out to the plane of its outermost point.
    pub(super) flat: bool,
    /// Outward normal of the skin at the contact.
    pub(super) skin: Option<DVec3>,
}

impl Planner<'_> {
    /// Puts hands at their place in the plan.
    pub(crate) fn place(&mut self, place: &Place, named: Who) {
        match place {
            Place::Body(body) if let Some(near) = self.still_near(body, named) => {
                self.by_each_other(&near, named);
            }
            Place::Body(body) => {
                self.near = None;
                // Two hands at one place would be in each other.
                let apart = self.symmetric || named.iter().all(Option::is_some);
                for (n, frame) in acting(named) {
                    let goal = self.on_body(n, body, frame, apart);
                    self.settle(n, &goal);
                    self.define(body.define, n);
                    self.at_body[n] = Some(body.clone());
                }
            }
            Place::Hand(site) => match named {
                [Some(a), Some(b)] if a.mirrors(&b) => {
                    let hands = met(site);
                    self.by_each_other(&hands, named);
                }
                _ => self.on_hand(site, named),
            },
            Place::Hands(hands) if self.is_lone(hands, named) => self.alone(hands, named),
            Place::Hands(constellation) => self.by_each_other(constellation, named),
            Place::Split(a, b) => {
                let mut each = [(0, a), (1, b)];
                // A hand that is placed at the other one follows it.
                each.sort_by_key(|(_, place)| place.as_deref().is_some_and(is_at_hand));
                for (n, place) in each {
                    let Some(place) = place else { continue };
                    let mut only: Who = [None, None];
                    let mut frame = named[n].unwrap_or_else(|| self.signer.own_frame());
                    // Sides in words of its own are the signer's.
                    frame.mirrored = self.signer.own_frame().mirrored;
                    only[n] = Some(frame);
                    self.place(place, only);
                }
            }
            Place::Named(number) => {
                let at = self.named.get(number).copied().unwrap_or_default();
                for (n, _) in acting(named) {
                    if let Some(at) = at[n] {
                        self.state[n].point = at;
                    }
                }
            }
        }
    }

    /// Returns the constellation that two hands written close to each other keep at a place in the middle of the body.
    fn still_near(&self, body: &BodyPlace, named: Who) -> Option<Constellation> {
        let [Some(own), Some(other)] = named else {
            return None;
        };
        let touches = matches!(body.contact, Some(Contact::Touch | Contact::Brushing));
        let near = self
            .near
            .as_ref()
            .filter(|_| own.mirrors(&other) && !touches)?;
        (self.hands().sites(0, body, own).site.lateral == 0.0).then(|| Constellation {
            at: Some(body.clone()),
            ..near.clone()
        })
    }

    fn define(&mut self, number: Option<u8>, n: usize) {
        if let Some(number) = number {
            self.named.entry(number).or_default()[n] = Some(self.state[n].point);
        }
    }

    /// Puts the mean of a hand's points at its goal.
    fn settle(&mut self, n: usize, goal: &Goal) {
        self.state[n].offset = self.hands().offset(n, &goal.points);
        if goal.flat {
            self.state[n].offset += self.hands().stands_out(n, &goal.points);
        }
        self.state[n].point = goal.at;
        if let Some(skin) = goal.skin {
            self.lie(n, skin, &goal.points);
        }
    }

    /// Returns the goal of a hand for a place on the body or in space; `apart` if the other hand goes there too.
    fn on_body(&mut self, n: usize, place: &BodyPlace, frame: Frame, apart: bool) -> Goal {
        let side = self.signer.sides[n];
        let site = self.hands().sites(n, place, frame);
        let contact = place.contact;
        let touching = matches!(
            contact,
            Some(Contact::Touch | Contact::Interlock | Contact::Cross | Contact::Brushing)
        ) && !site.site.beside;
        let aside = contact == Some(Contact::Touch) && site.site.region == Region::Face;
        let near = touching || aside || contact == Some(Contact::Close);
        let region = site.site.region_for(contact);
        let facing = site.out * if place.behind { -1.0 } else { 1.0 };
        let points = match &place.by {
            Some(by) => hand_points(by, side, frame.mirrored),
            None if touching || (near && region != Region::Trunk) => {
                vec![self.hands().facing(n, -facing, region)]
            }
            None => vec![HandPoint::Palm],
        };
        let ahead = match points.as_slice() {
            [HandPoint::Palm] => self.hands().ahead(n),
            _ => 0.0,
        };
        let at = match (place.behind, touching) {
            (true, _) => self.signer.behind(&site),
            (false, true) => site.at,
            (false, false) => self.signer.before(&site, contact, ahead),
        };
        let skin = match site.site.region {
            _ if !touching || place.behind => None,
            Region::Trunk => self.signer.stage.torso.normal(at),
            // A contact below the chin or at the neck faces forward.
            Region::Face => Some(self.signer.stage.forward),
            Region::Arm(_) => None,
        };
        if site.site.region == Region::Trunk && skin.is_some() {
            self.lay(n, &points, at);
        }
        let at = match apart {
            true if !touching && site.site.lateral == 0.0 => self.signer.apart(n, at),
            true if touching
                && site.site.region == Region::Trunk
                && site.site.lateral * side.sign() >= 0.0 =>
            {
                self.hands().beside(n, &points, at)
            }
            _ => at,
        };
        Goal {
            at,
            points,
            flat: touching,
            skin,
        }
    }

    /// Returns the outward unit normal of the body at a hand's current contact (left, up, forward in the
    /// hand's frame).
    pub(crate) fn skin(&self, n: usize, frame: Frame) -> Option<DVec3> {
        let touching = |place: &&BodyPlace| place.contact == Some(Contact::Touch) && !place.behind;
        let place = self.at_body[n].as_ref().filter(touching)?;
        let placed = self.hands().sites(n, place, frame);
        if placed.site.beside || placed.at.distance(self.state[n].point) > 2e-3 {
            return None;
        }
        let stage = self.signer.stage;
        let out = match placed.site.region {
            Region::Trunk => stage.torso.normal(placed.at).unwrap_or(placed.out),
            _ => placed.out,
        };
        let local = DVec3::new(out.dot(stage.left), out.y, out.dot(stage.forward));
        Some(local * frame.axes)
    }

    /// Moves an acting hand to a site of the other hand.
    fn on_hand(&mut self, site: &HandSite, named: Who) {
        let acting = usize::from(named[0].is_none());
        let other = 1 - acting;
        let frame = named[acting].unwrap_or_else(|| self.signer.own_frame());
        if !self.state[other].used {
            self.raise(other);
        }
        let touched = self.signer.site_points(other, site, frame);
        let (at, out) = self.hands().at_hand(other, &touched);
        let points = match &site.by {
            Some(by) => self.signer.site_points(acting, by, frame),
            None => vec![
                self.hands()
                    .facing(acting, -out, Region::Arm(self.signer.sides[other])),
            ],
        };
        if matches!(site.contact, Some(Contact::Interlock | Contact::Cross)) {
            self.plan.laced = true;
        }
        let far = match site.contact {
            Some(Contact::Close) => self.signer.language.hands_near * self.signer.stage.arm,
            _ => 0.0,
        };
        let goal = Goal {
            at: at + out * far,
            points,
            flat: false,
            skin: None,
        };
        self.settle(acting, &goal);
        self.define(site.define, acting);
    }

    /// Moves a hand that signs alone to its last place at the body, or to the named place.
    fn alone(&mut self, hands: &Constellation, named: Who) {
        for (n, frame) in acting(named) {
            let known = self.at_body[n].clone();
            let Some(mut place) = hands.at.clone().or_else(|| known.clone()) else {
                continue;
            };
            place.contact = hands.contact.or(place.contact);
            let by = known.and_then(|known| known.by);
            place.by = hands.dominant.clone().or(place.by).or(by);
            let goal = self.on_body(n, &place, frame, self.symmetric);
            self.settle(n, &goal);
            self.define(hands.define, n);
            self.at_body[n] = Some(place);
        }
    }

    /// Moves the hands together, and both to a place.
    fn by_each_other(&mut self, hands: &Constellation, named: Who) {
        let hands = &self.remembered(hands);
        self.near = (hands.contact == Some(Contact::Close)).then(|| hands.clone());
        if matches!(hands.contact, Some(Contact::Interlock | Contact::Cross)) {
            self.plan.laced = true;
        }
        for n in 0..2 {
            if !self.state[n].used {
                self.raise(n);
            }
        }
        let frames = named.map(|frame| frame.unwrap_or_else(|| self.signer.own_frame()));
        let across = self.signer.stage.left * self.signer.sides[0].sign();
        let mirrored = frames[0].mirrors(&frames[1]);
        let far = self.signer.language.hands_near * self.signer.stage.arm;
        let apart = match hands.contact {
            Some(Contact::Touch | Contact::Interlock | Contact::Cross) => 0.0,
            Some(Contact::Brushing) => 0.0,
            Some(Contact::Close) => far,
            _ => 2.0 * far,
        };
        let unlike = hands.other.is_some() && hands.other != hands.dominant;
        let (points, direction) = if mirrored && !unlike {
            let point = |n: usize, site: &Option<HandSite>, direction: DVec3| match site {
                Some(site) => self.signer.site_points(n, site, frames[n]),
                None if hands.contact == Some(Contact::Cross) => {
                    vec![HandPoint::Wrist(Face::Palmar)]
                }
                // Interlocked fingers: their first bones meet.
                None if hands.contact == Some(Contact::Interlock) => vec![
                    HandPoint::Base(Digit::Middle, Face::Palmar),
                    HandPoint::Middle(Digit::Middle, Face::Palmar),
                ],
                None => vec![self.hands().facing(n, direction, Region::Trunk)],
            };
            let other = hands.other.as_ref().or(hands.dominant.as_ref()).cloned();
            (
                [point(0, &hands.dominant, -across), point(1, &other, across)],
                across,
            )
        } else {
            self.hands().unlike(hands, frames, across)
        };
        let centre = self.centre(hands, frames[0], &points);
        let goals = points.map(|points| Goal {
            at: centre,
            points,
            flat: false,
            skin: None,
        });
        let [mut first, mut second] = goals;
        first.at += direction * (apart / 2.0);
        second.at -= direction * (apart / 2.0);
        if let (Some(fixed), None) = (self.fixed.filter(|_| self.begun), &hands.at) {
            let points = [&first.points, &second.points][fixed].clone();
            let by = self.hands().at_hand(fixed, &points).0 - [first.at, second.at][fixed];
            first.at += by;
            second.at += by;
        }
        self.settle(0, &first);
        self.settle(1, &second);
        if hands.at.as_ref().is_some_and(|at| !at.behind) {
            self.both_out();
        }
        for n in 0..2 {
            self.define(hands.define, n);
        }
    }

    /// Returns a constellation; sites that it leaves out are those of the last one in this sign.
    fn remembered(&mut self, hands: &Constellation) -> Constellation {
        let mut known = hands.clone();
        if known.dominant.is_none() && known.other.is_none() {
            if let Some(before) = &self.together {
                known.dominant.clone_from(&before.dominant);
                known.other.clone_from(&before.other);
            }
        } else {
            self.together = Some(known.clone());
        }
        known
    }

    /// Returns the position of two hands in a constellation: at their place if named, else half-way between the points
    /// that meet, else before the chest.
    fn centre(
        &mut self,
        hands: &Constellation,
        frame: Frame,
        points: &[Vec<HandPoint>; 2],
    ) -> DVec3 {
        if let Some(place) = &hands.at {
            return self.on_body(0, place, frame, false).at;
        }
        if self.begun {
            let [own, other] = [0, 1].map(|n| self.hands().at_hand(n, &points[n]).0);
            return (own + other) / 2.0;
        }
        self.on_body(0, &BodyPlace::default(), frame, false).at
    }
}

impl Signer<'_> {
    /// Moves a place in the middle to the front of the hand's own shoulder.
    fn apart(&self, n: usize, at: DVec3) -> DVec3 {
        let stage = self.stage;
        let by = self.sides[n].sign() * self.language.hands_apart * stage.shoulders;
        at + stage.left * by
    }

    /// Returns the position of a hand behind the body, at the height of a place.
    fn behind(&self, site: &Placed) -> DVec3 {
        let stage = self.stage;
        let by = -stage.forward * (0.5 * stage.shoulders);
        site.at + by + site.out * (0.05 * stage.shoulders)
    }

    /// Returns the position of a hand before a place, if its point is this far ahead of its wrist (m).
    fn before(&self, site: &Placed, contact: Option<Contact>, ahead: f64) -> DVec3 {
        let (stage, l) = (self.stage, self.language);
        let found = (
            site.site.region_for(contact),
            site.site.lateral,
            site.site.beside,
        );
        match HandAt::of(found, contact, l, [stage.arm, stage.shoulders], ahead) {
            HandAt::Place => site.at,
            HandAt::Off { out, left } => site.at + site.out * out + stage.left * left,
            HandAt::Front { left, forward } => {
                let middle = stage.middle();
                let level = DVec3::Y * (site.at - middle).y;
                middle + level + stage.left * left + stage.forward * forward
            }
        }
    }

    fn site_points(&self, n: usize, site: &HandSite, frame: Frame) -> Vec<HandPoint> {
        let side = self.sides[n];
        let mut points = hand_points(site, side, frame.mirrored);
        if let Some(second) = &site.second {
            points.extend(hand_points(second, side, frame.mirrored));
        }
        points
    }
}

impl Hands<'_> {
    /// Returns the distance (m) of the middle of a palm before its wrist; negative behind it.
    fn ahead(&self, n: usize) -> f64 {
        let palm = self.offset(n, &[HandPoint::Palm]);
        (self.state[n].rotation * palm).dot(self.signer.stage.forward)
    }

    /// Returns the direction out of the head at a place on it.
    pub(crate) fn out_of_head(&self, n: usize, place: &BodyPlace, frame: Frame) -> Option<DVec3> {
        let placed = self.sites(n, place, frame);
        let face = placed.site.region_for(place.contact) == Region::Face;
        (face && !place.behind).then_some(placed.out)
    }

    /// Returns the position of a place on the body, or half-way between two.
    fn sites(&self, n: usize, place: &BodyPlace, frame: Frame) -> Placed {
        let neutral = Site {
            at: BodyLocation::NeutralSpace,
            side: None,
            approx: false,
        };
        let site = self.site(n, &place.site.unwrap_or(neutral), frame);
        match &place.second {
            Some(second) => middle(&site, &self.site(n, second, frame)),
            None => site,
        }
    }

    /// Moves a place on the skin to the hand's own side, so far that the other hand finds room beside it.
    fn beside(&self, n: usize, points: &[HandPoint], at: DVec3) -> DVec3 {
        let Some(hand) = self.signer.stage.hand(self.signer.sides[n]) else {
            return at;
        };
        let state = &self.state[n];
        let outwards = self.signer.stage.left * hand.side.sign();
        let own = state.rotation.inverse() * -outwards;
        let offset = self.offset(n, points);
        let outline = &self.shapes[n][state.shape].outline.points;
        let reach = outline.iter().map(|part| (*part - offset).dot(own));
        let reach = reach.fold(0.0, f64::max) + FINGER_FLESH * hand.length();
        let room = (at - self.signer.stage.middle()).dot(outwards);
        let missing = (reach - room).max(0.0);
        at + outwards * missing.min(tuned().contact.beside * hand.length())
    }

    fn site(&self, n: usize, site: &Site<BodyLocation>, frame: Frame) -> Placed {
        let stage = self.signer.stage;
        let found = body_site(site, self.signer.sides[n], frame.mirrored);
        let own = match found.region {
            Region::Arm(side) => self.arm_part(side, &found.landmark),
            _ => None,
        };
        let root = own.map(|(at, _)| at);
        let root = root.or_else(|| stage.landmark(&found.landmark));
        let root =
            root.unwrap_or_else(|| stage.middle() + stage.forward * (FRONT * stage.shoulders));
        let out = stage
            .direction(DVec3::from(found.out))
            .normalize_or(stage.forward);
        // The inside of an arm is known only if the arm is bent.
        let out = match own {
            Some((_, inner)) if inside(site) => inner.unwrap_or(out),
            _ => out,
        };
        let flesh = match found.region {
            Region::Arm(_) => out * (FLESH * stage.arm),
            _ => DVec3::ZERO,
        };
        let moved = self.signer.language.places.get(&found.landmark);
        let offset = DVec3::from(found.offset) + moved.map_or(DVec3::ZERO, |by| DVec3::from(*by));
        let offset = stage.direction(offset * stage.shoulders);
        Placed {
            at: root + offset + flesh,
            out,
            site: found,
        }
    }

    /// Returns the position of a landmark on the planned arm and, if the arm is bent, the outward unit
    /// normal of the inside of its elbow.
    fn arm_part(&self, side: Side, landmark: &str) -> Option<(DVec3, Option<DVec3>)> {
        let hand = self.signer.stage.hand(side)?;
        let n = usize::from(self.signer.sides[1] == side);
        let state = &self.state[n];
        let arm = Arm::of(self.signer.stage, hand, &self.signer.limits);
        let bearing = arm.bearing(state.wrist(), state.rotation);
        let posed = hand.rig.reach(state.wrist(), bearing, &self.signer.limits);
        let at = match landmark.rsplit_once('-')?.1 {
            "elbow" => posed.elbow,
            "forearm" => posed.elbow.lerp(posed.wrist, 0.5),
            _ => posed.shoulder.lerp(posed.elbow, 0.55),
        };
        let chord = (posed.wrist - posed.shoulder).normalize_or(DVec3::NEG_Y);
        let inner = -(posed.elbow - posed.shoulder).reject_from_normalized(chord);
        let bent = inner.length() > 0.05 * self.signer.stage.arm;
        Some((at, inner.try_normalize().filter(|_| bent)))
    }

    /// Returns the point of a hand that comes first when the hand moves along `direction` (model space).
    fn facing(&self, n: usize, direction: DVec3, region: Region) -> HandPoint {
        let Some(hand) = self.signer.stage.hand(self.signer.sides[n]) else {
            return HandPoint::Palm;
        };
        let state = &self.state[n];
        let v = state.rotation.inverse() * direction;
        let [along, palm, radial] = [hand.along, hand.palm, hand.radial].map(|axis| v.dot(axis));
        coming_first(&state.handshape, [along, palm, radial], region)
    }

    /// Returns the mean position of a hand's points in the plan, and the hand's outward unit normal there.
    pub(super) fn at_hand(&self, n: usize, points: &[HandPoint]) -> (DVec3, DVec3) {
        let state = &self.state[n];
        let offset = self.offset(n, points);
        let at = state.wrist() + state.rotation * offset;
        let Some(hand) = self.signer.stage.hand(self.signer.sides[n]) else {
            return (at, DVec3::Y);
        };
        let shape = &self.shapes[n][state.shape];
        let out: DVec3 = points
            .iter()
            .map(|&point| self.signer.stage.outward(hand, shape, point))
            .sum();
        (at, (state.rotation * out).normalize_or(DVec3::Y))
    }

    /// Returns the points of hands that do not mirror each other, and the direction from the other hand's
    /// point to the dominant hand's: the outward normal of the touched part.
    fn unlike(
        &self,
        hands: &Constellation,
        frames: [Frame; 2],
        across: DVec3,
    ) -> ([Vec<HandPoint>; 2], DVec3) {
        let region = Region::Arm(self.signer.sides[1]);
        let own = hands
            .dominant
            .as_ref()
            .map(|site| self.signer.site_points(0, site, frames[0]));
        let other = match &hands.other {
            Some(site) => self.signer.site_points(1, site, frames[1]),
            None => {
                let direction = match &own {
                    Some(points) => -self.at_hand(0, points).1,
                    None => (DVec3::Y + across * 0.6 + self.signer.stage.forward * 0.3).normalize(),
                };
                vec![self.facing(1, direction, Region::Trunk)]
            }
        };
        let out = self.at_hand(1, &other).1;
        let own = own.unwrap_or_else(|| vec![self.facing(0, -out, region)]);
        let facing = self.at_hand(0, &own).1;
        let direction = (out - facing).try_normalize().unwrap_or(across);
        ([own, other], direction)
    }
}

/// Returns the constellation of mirrored hands that meet at the same site.
fn met(site: &HandSite) -> Constellation {
    let plain = HandSite {
        by: None,
        contact: None,
        define: None,
        ..site.clone()
    };
    let own = site.by.as_deref().cloned();
    Constellation {
        dominant: own.or_else(|| Some(plain.clone())),
        other: Some(plain),
        contact: site.contact.or(Some(Contact::Touch)),
        define: site.define,
        ..Constellation::default()
    }
}

/// A place on the body with its position.
#[derive(Debug, Clone)]
struct Placed {
    at: DVec3,
    out: DVec3,
    site: BodySite,
}

fn middle(a: &Placed, b: &Placed) -> Placed {
    Placed {
        at: (a.at + b.at) / 2.0,
        out: (a.out + b.out).normalize_or(a.out),
        site: BodySite {
            lateral: (a.site.lateral + b.site.lateral) / 2.0,
            beside: a.site.beside && b.site.beside,
            ..a.site.clone()
        },
    }
}
