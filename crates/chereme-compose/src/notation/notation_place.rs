//! Places hands: on the body, in space, at the other hand, and in constellations.
//!
//! The reference point of the hand follows Kennaway's discussion in section 4.1: the middle of the palm in
//! free space; at a place on the body, the point that meets it first in the hand's orientation.

use chereme_motion::BodySide;
use chereme_motion::glam::DVec3;
use chereme_sign::hamnosys::sites::{
    BodyRegion, BodySite, DigitFace, FLESH_DEPTH_ARM_LENGTHS, HandAt, NotatedHandPoint, TRUNK_FRONT_SHOULDER_WIDTHS,
    coming_first, hand_points, hands_apart_share, is_place_of_first_point, resolve_body_site,
};
use chereme_sign::hamnosys::{
    BodyLocation, BodyPlace, HandConstellation, HandDigit, HandPlace, HandSite, PlaceContact, SidedLocation,
};

use super::lift::is_inner_arm_place;
use super::notation_plan::{ActingFrame, ActingHands, NotationSigner, PlannedHands, SignPlanner, iterate_acting_hands};
use super::notation_solve::ArmSolver;
use super::notation_stage::FINGER_FLESH;
use super::notation_tuned::tuned;

/// Returns whether a place is at the other hand.
pub(super) fn is_at_hand(place: &HandPlace) -> bool {
    matches!(place, HandPlace::Hand(_))
}

/// The goal of a hand's reference point.
#[derive(Debug, Clone)]
pub(super) struct PlaceGoal {
    pub(super) at: DVec3,
    pub(super) points: Vec<NotatedHandPoint>,
    /// Whether the touching face of the hand is moved out to the plane of its outermost point.
    pub(super) flat: bool,
    /// Outward normal of the skin at the contact.
    pub(super) skin: Option<DVec3>,
}

impl SignPlanner<'_> {
    /// Puts hands at their place in the plan.
    pub(crate) fn place_hands(&mut self, place: &HandPlace, named: ActingHands) {
        match place {
            HandPlace::Body(body) if let Some(near) = self.still_near(body, named) => {
                self.place_hands_together(&near, named);
            }
            HandPlace::Body(body) => {
                self.near = None;
                // Two hands at one place would be in each other.
                let apart = self.symmetric || named.iter().all(Option::is_some);
                for (n, frame) in iterate_acting_hands(named) {
                    let goal = self.goal_at_body_place(n, body, frame, apart);
                    self.settle_hand_points(n, &goal);
                    self.define_numbered_place(body.define, n);
                    self.at_body[n] = Some(body.clone());
                }
            }
            HandPlace::Hand(site) => match named {
                [Some(a), Some(b)] if a.is_mirrored_by(&b) => {
                    let hands = meeting_constellation(site);
                    self.place_hands_together(&hands, named);
                }
                _ => self.place_hand_at_other_hand(site, named),
            },
            HandPlace::Hands(hands) if self.is_lone(hands, named) => self.place_lone_hand(hands, named),
            HandPlace::Hands(constellation) => self.place_hands_together(constellation, named),
            HandPlace::Split(a, b) => {
                let mut each = [(0, a), (1, b)];
                // A hand that is placed at the other one follows it.
                each.sort_by_key(|(_, place)| place.as_deref().is_some_and(is_at_hand));
                for (n, place) in each {
                    let Some(place) = place else { continue };
                    let mut only: ActingHands = [None, None];
                    let mut frame = named[n].unwrap_or_else(|| self.signer.own_frame());
                    // Sides in words of its own are the signer's.
                    frame.mirrored = self.signer.own_frame().mirrored;
                    only[n] = Some(frame);
                    self.place_hands(place, only);
                }
            }
            HandPlace::Named(number) => {
                let named_points = self.named.get(number).copied().unwrap_or_default();
                for (n, _) in iterate_acting_hands(named) {
                    if let Some(at) = named_points[n] {
                        self.state[n].point = at;
                    }
                }
            }
        }
    }

    /// Returns the constellation that two hands written close to each other keep at a place in the middle of the body.
    fn still_near(&self, body: &BodyPlace, named: ActingHands) -> Option<HandConstellation> {
        let [Some(own), Some(other)] = named else {
            return None;
        };
        let touches = matches!(body.contact, Some(PlaceContact::Touch | PlaceContact::Brushing));
        let near = self.near.as_ref().filter(|_| own.is_mirrored_by(&other) && !touches)?;
        (self.planned_hands().body_place_site(0, body, own).site.lateral == 0.0).then(|| HandConstellation {
            at: Some(body.clone()),
            ..near.clone()
        })
    }

    fn define_numbered_place(&mut self, number: Option<u8>, n: usize) {
        if let Some(number) = number {
            self.named.entry(number).or_default()[n] = Some(self.state[n].point);
        }
    }

    /// Puts the mean of a hand's points at its goal.
    fn settle_hand_points(&mut self, n: usize, goal: &PlaceGoal) {
        self.state[n].offset = self.planned_hands().mean_hand_point(n, &goal.points);
        if goal.flat {
            self.state[n].offset += self.planned_hands().stands_out(n, &goal.points);
        }
        self.state[n].point = goal.at;
        if let Some(skin) = goal.skin {
            self.touch_with_front_part(n, skin, &goal.points);
        }
    }

    /// Returns the goal of a hand for a place on the body or in space; `apart` if the other hand goes there too.
    fn goal_at_body_place(&mut self, n: usize, place: &BodyPlace, frame: ActingFrame, apart: bool) -> PlaceGoal {
        let side = self.signer.sides[n];
        let site = self.planned_hands().body_place_site(n, place, frame);
        let contact = place.contact;
        let touching = matches!(
            contact,
            Some(PlaceContact::Touch | PlaceContact::Interlock | PlaceContact::Cross | PlaceContact::Brushing)
        ) && !site.site.beside;
        let aside = contact == Some(PlaceContact::Touch) && site.site.beside;
        let region = site.site.region_for(contact);
        let first = touching || aside || (is_place_of_first_point(region, contact) && region != BodyRegion::Trunk);
        let facing = site.out * if place.behind { -1.0 } else { 1.0 };
        let points = match &place.by {
            Some(by) => hand_points(by, side, frame.mirrored),
            None if first => {
                vec![self.planned_hands().leading_hand_point(n, -facing, region)]
            }
            None => vec![NotatedHandPoint::Palm],
        };
        let ahead = match points.as_slice() {
            [NotatedHandPoint::Palm] => self.planned_hands().palm_ahead_distance(n),
            _ => 0.0,
        };
        let site_point = match (place.behind, touching) {
            (true, _) => self.signer.position_behind_body(&site),
            (false, true) => site.at,
            (false, false) => self.signer.position_before_place(&site, contact, ahead),
        };
        let skin = match site.site.region {
            _ if !touching || place.behind => None,
            BodyRegion::Trunk => self.signer.stage.torso.trunk_front_normal(site_point),
            // A contact below the chin or at the neck faces forward.
            BodyRegion::Face => Some(self.signer.stage.forward),
            BodyRegion::Arm(_) => None,
        };
        if site.site.region == BodyRegion::Trunk && skin.is_some() {
            self.lay_flat_hand(n, &points, site_point);
        }
        let placed_point = match apart {
            true if !touching && site.site.lateral == 0.0 => self.signer.move_to_own_shoulder(n, site_point, contact),
            true if touching
                && site.site.region == BodyRegion::Trunk
                && site.site.lateral * side.side_sign() >= 0.0 =>
            {
                self.planned_hands().place_beside_hand(n, &points, site_point)
            }
            _ => site_point,
        };
        PlaceGoal {
            at: placed_point,
            points,
            flat: touching,
            skin,
        }
    }

    /// Returns the outward unit normal of the body at a hand's current contact (left, up, forward in the
    /// hand's frame).
    pub(crate) fn skin_normal_at_hand(&self, n: usize, frame: ActingFrame) -> Option<DVec3> {
        let touching = |place: &&BodyPlace| place.contact == Some(PlaceContact::Touch) && !place.behind;
        let place = self.at_body[n].as_ref().filter(touching)?;
        let placed = self.planned_hands().body_place_site(n, place, frame);
        if placed.site.beside || placed.at.distance(self.state[n].point) > 2e-3 {
            return None;
        }
        let stage = self.signer.stage;
        let out = match placed.site.region {
            BodyRegion::Trunk => stage.torso.trunk_front_normal(placed.at).unwrap_or(placed.out),
            _ => placed.out,
        };
        let local = DVec3::new(out.dot(stage.left), out.y, out.dot(stage.forward));
        Some(local * frame.axes)
    }

    /// Moves an acting hand to a site of the other hand.
    fn place_hand_at_other_hand(&mut self, site: &HandSite, named: ActingHands) {
        let acting = usize::from(named[0].is_none());
        let other = 1 - acting;
        let frame = named[acting].unwrap_or_else(|| self.signer.own_frame());
        if !self.state[other].used {
            self.raise_resting_hand(other);
        }
        let touched = self.signer.site_points(other, site, frame);
        let (at, out) = self.planned_hands().at_hand(other, &touched);
        let points = match &site.by {
            Some(by) => self.signer.site_points(acting, by, frame),
            None => {
                vec![
                    self.planned_hands()
                        .leading_hand_point(acting, -out, BodyRegion::Arm(self.signer.sides[other])),
                ]
            }
        };
        if matches!(site.contact, Some(PlaceContact::Interlock | PlaceContact::Cross)) {
            self.plan.laced = true;
        }
        let far = match site.contact {
            Some(PlaceContact::Close) => self.signer.language.hands_near * self.signer.stage.arm,
            _ => 0.0,
        };
        let goal = PlaceGoal {
            at: at + out * far,
            points,
            flat: false,
            skin: None,
        };
        self.settle_hand_points(acting, &goal);
        self.define_numbered_place(site.define, acting);
    }

    /// Moves a hand that signs alone to its last place at the body, or to the named place.
    fn place_lone_hand(&mut self, hands: &HandConstellation, named: ActingHands) {
        for (n, frame) in iterate_acting_hands(named) {
            let known_place = self.at_body[n].clone();
            let Some(mut place) = hands.at.clone().or_else(|| known_place.clone()) else {
                continue;
            };
            place.contact = hands.contact.or(place.contact);
            let by = known_place.and_then(|known| known.by);
            place.by = hands.dominant.clone().or(place.by).or(by);
            let goal = self.goal_at_body_place(n, &place, frame, self.symmetric);
            self.settle_hand_points(n, &goal);
            self.define_numbered_place(hands.define, n);
            self.at_body[n] = Some(place);
        }
    }

    /// Moves the hands together, and both to a place.
    fn place_hands_together(&mut self, hands: &HandConstellation, named: ActingHands) {
        let hands = &self.remember_constellation(hands);
        self.near = (hands.contact == Some(PlaceContact::Close)).then(|| hands.clone());
        if matches!(hands.contact, Some(PlaceContact::Interlock | PlaceContact::Cross)) {
            self.plan.laced = true;
        }
        for n in 0..2 {
            if !self.state[n].used {
                self.raise_resting_hand(n);
            }
        }
        let frames = named.map(|frame| frame.unwrap_or_else(|| self.signer.own_frame()));
        let across = self.signer.stage.left * self.signer.sides[0].side_sign();
        let mirrored = frames[0].is_mirrored_by(&frames[1]);
        let far = self.signer.language.hands_near * self.signer.stage.arm;
        let apart = match hands.contact {
            Some(PlaceContact::Touch | PlaceContact::Interlock | PlaceContact::Cross) => 0.0,
            Some(PlaceContact::Brushing) => 0.0,
            Some(PlaceContact::Close) => far,
            _ => 2.0 * far,
        };
        let unlike = hands.other.is_some() && hands.other != hands.dominant;
        let (points, direction) = if mirrored && !unlike {
            let point = |n: usize, site: &Option<HandSite>, direction: DVec3| match site {
                Some(site) => self.signer.site_points(n, site, frames[n]),
                None if hands.contact == Some(PlaceContact::Cross) => {
                    vec![NotatedHandPoint::Wrist(DigitFace::Palmar)]
                }
                // Interlocked fingers: their first bones meet.
                None if hands.contact == Some(PlaceContact::Interlock) => vec![
                    NotatedHandPoint::Base(HandDigit::Middle, DigitFace::Palmar),
                    NotatedHandPoint::Middle(HandDigit::Middle, DigitFace::Palmar),
                ],
                None => {
                    vec![self.planned_hands().leading_hand_point(n, direction, BodyRegion::Trunk)]
                }
            };
            let other = hands.other.as_ref().or(hands.dominant.as_ref()).cloned();
            ([point(0, &hands.dominant, -across), point(1, &other, across)], across)
        } else {
            self.planned_hands().unlike(hands, frames, across)
        };
        let centre = self.centre(hands, frames[0], &points);
        let goals = points.map(|points| PlaceGoal {
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
            let by = self.planned_hands().at_hand(fixed, &points).0 - [first.at, second.at][fixed];
            first.at += by;
            second.at += by;
        }
        self.settle_hand_points(0, &first);
        self.settle_hand_points(1, &second);
        if hands.at.as_ref().is_some_and(|at| !at.behind) {
            self.both_out();
        }
        for n in 0..2 {
            self.define_numbered_place(hands.define, n);
        }
    }

    /// Returns a constellation; sites that it leaves out are those of the last one in this sign.
    fn remember_constellation(&mut self, hands: &HandConstellation) -> HandConstellation {
        let mut completed_hands = hands.clone();
        if completed_hands.dominant.is_none() && completed_hands.other.is_none() {
            if let Some(before) = &self.together {
                completed_hands.dominant.clone_from(&before.dominant);
                completed_hands.other.clone_from(&before.other);
            }
        } else {
            self.together = Some(completed_hands.clone());
        }
        completed_hands
    }

    /// Returns the position of two hands in a constellation: at their place if named, else half-way between the points
    /// that meet, else before the chest.
    fn centre(&mut self, hands: &HandConstellation, frame: ActingFrame, points: &[Vec<NotatedHandPoint>; 2]) -> DVec3 {
        if let Some(place) = &hands.at {
            return self.goal_at_body_place(0, place, frame, false).at;
        }
        if self.begun {
            let [own, other] = [0, 1].map(|n| self.planned_hands().at_hand(n, &points[n]).0);
            return (own + other) / 2.0;
        }
        self.goal_at_body_place(0, &BodyPlace::default(), frame, false).at
    }
}

impl NotationSigner<'_> {
    /// Moves a place in the middle to the front of the hand's own shoulder.
    fn move_to_own_shoulder(&self, n: usize, at: DVec3, contact: Option<PlaceContact>) -> DVec3 {
        let stage = self.stage;
        let apart = self.language.hands_apart * hands_apart_share(contact);
        let by = self.sides[n].side_sign() * apart * stage.shoulders;
        at + stage.left * by
    }

    /// Returns the position of a hand behind the body, at the height of a place.
    fn position_behind_body(&self, site: &PlacedSite) -> DVec3 {
        let stage = self.stage;
        let by = -stage.forward * (0.5 * stage.shoulders);
        site.at + by + site.out * (0.05 * stage.shoulders)
    }

    /// Returns the position of a hand before a place, if its point is this far ahead of its wrist (m).
    fn position_before_place(&self, site: &PlacedSite, contact: Option<PlaceContact>, ahead: f64) -> DVec3 {
        let (stage, l) = (self.stage, self.language);
        let (region, lateral, beside) = (site.site.region_for(contact), site.site.lateral, site.site.beside);
        let lengths = [stage.arm, stage.shoulders];
        match HandAt::hand_at_place(region, lateral, beside, contact, l, lengths, ahead) {
            HandAt::Place => site.at,
            HandAt::Off { out, left } => site.at + site.out * out + stage.left * left,
            HandAt::Front { left, forward } => {
                let middle = stage.shoulder_middle();
                let level = DVec3::Y * (site.at - middle).y;
                middle + level + stage.left * left + stage.forward * forward
            }
        }
    }

    fn site_points(&self, n: usize, site: &HandSite, frame: ActingFrame) -> Vec<NotatedHandPoint> {
        let side = self.sides[n];
        let mut points = hand_points(site, side, frame.mirrored);
        if let Some(second) = &site.second {
            points.extend(hand_points(second, side, frame.mirrored));
        }
        points
    }
}

impl PlannedHands<'_> {
    /// Returns the distance (m) of the middle of a palm before its wrist; negative behind it.
    fn palm_ahead_distance(&self, n: usize) -> f64 {
        let palm = self.mean_hand_point(n, &[NotatedHandPoint::Palm]);
        (self.state[n].rotation * palm).dot(self.signer.stage.forward)
    }

    /// Returns the direction out of the head at a place on it.
    pub(crate) fn out_of_head(&self, n: usize, place: &BodyPlace, frame: ActingFrame) -> Option<DVec3> {
        let placed = self.body_place_site(n, place, frame);
        let face = placed.site.region_for(place.contact) == BodyRegion::Face;
        (face && !place.behind).then_some(placed.out)
    }

    /// Returns the position of a place on the body, or half-way between two.
    fn body_place_site(&self, n: usize, place: &BodyPlace, frame: ActingFrame) -> PlacedSite {
        let neutral = SidedLocation {
            at: BodyLocation::NeutralSpace,
            side: None,
            approx: false,
        };
        let site = self.body_site_position(n, &place.site.unwrap_or(neutral), frame);
        match &place.second {
            Some(second) => middle_of_sites(&site, &self.body_site_position(n, second, frame)),
            None => site,
        }
    }

    /// Moves a place on the skin to the hand's own side, so far that the other hand finds room beside it.
    fn place_beside_hand(&self, n: usize, points: &[NotatedHandPoint], at: DVec3) -> DVec3 {
        let Some(hand) = self.signer.stage.hand_of_side(self.signer.sides[n]) else {
            return at;
        };
        let state = &self.state[n];
        let outwards = self.signer.stage.left * hand.side.side_sign();
        let local_direction = state.rotation.inverse() * -outwards;
        let offset = self.mean_hand_point(n, points);
        let outline = &self.shapes[n][state.shape].outline.points;
        let part_reaches = outline.iter().map(|part| (*part - offset).dot(local_direction));
        let reach = part_reaches.fold(0.0, f64::max) + FINGER_FLESH * hand.staged_hand_length();
        let room = (at - self.signer.stage.shoulder_middle()).dot(outwards);
        let missing = (reach - room).max(0.0);
        at + outwards * missing.min(tuned().contact.beside * hand.staged_hand_length())
    }

    fn body_site_position(&self, n: usize, site: &SidedLocation<BodyLocation>, frame: ActingFrame) -> PlacedSite {
        let stage = self.signer.stage;
        let body_spot = resolve_body_site(site, self.signer.sides[n], frame.mirrored);
        let arm_place = match body_spot.region {
            BodyRegion::Arm(side) => self.arm_part(side, &body_spot.landmark),
            _ => None,
        };
        let arm_root = arm_place.map(|(at, _)| at);
        let root = arm_root.or_else(|| stage.body_landmark_position(&body_spot.landmark));
        let root = root.unwrap_or_else(|| {
            stage.shoulder_middle() + stage.forward * (TRUNK_FRONT_SHOULDER_WIDTHS * stage.shoulders)
        });
        let raw_out = stage
            .body_to_model_direction(DVec3::from(body_spot.out))
            .normalize_or(stage.forward);
        // The inside of an arm is known only if the arm is bent.
        let out = match arm_place {
            Some((_, inner)) if is_inner_arm_place(site) => inner.unwrap_or(raw_out),
            _ => raw_out,
        };
        let flesh = match body_spot.region {
            BodyRegion::Arm(_) => out * (FLESH_DEPTH_ARM_LENGTHS * stage.arm),
            _ => DVec3::ZERO,
        };
        let moved = self.signer.language.places.get(&body_spot.landmark);
        let raw_offset = DVec3::from(body_spot.offset) + moved.map_or(DVec3::ZERO, |by| DVec3::from(*by));
        let offset = stage.body_to_model_direction(raw_offset * stage.shoulders);
        PlacedSite {
            at: root + offset + flesh,
            out,
            site: body_spot,
        }
    }

    /// Returns the position of a landmark on the planned arm and, if the arm is bent, the outward unit
    /// normal of the inside of its elbow.
    fn arm_part(&self, side: BodySide, landmark: &str) -> Option<(DVec3, Option<DVec3>)> {
        let hand = self.signer.stage.hand_of_side(side)?;
        let n = usize::from(self.signer.sides[1] == side);
        let state = &self.state[n];
        let arm = ArmSolver::solver_for_hand(self.signer.stage, hand, &self.signer.limits);
        let bearing = arm.cheapest_still_bearing(state.wrist_position(), state.rotation);
        let posed = hand
            .rig
            .reach_wrist_position(state.wrist_position(), bearing, &self.signer.limits);
        let arm_point = match landmark.rsplit_once('-')?.1 {
            "elbow" => posed.elbow,
            "forearm" => posed.elbow.lerp(posed.wrist, 0.5),
            _ => posed.shoulder.lerp(posed.elbow, 0.55),
        };
        let chord = (posed.wrist - posed.shoulder).normalize_or(DVec3::NEG_Y);
        let inner = -(posed.elbow - posed.shoulder).reject_from_normalized(chord);
        let bent = inner.length() > 0.05 * self.signer.stage.arm;
        Some((arm_point, inner.try_normalize().filter(|_| bent)))
    }

    /// Returns the point of a hand that comes first when the hand moves along `direction` (model space).
    fn leading_hand_point(&self, n: usize, direction: DVec3, region: BodyRegion) -> NotatedHandPoint {
        let Some(hand) = self.signer.stage.hand_of_side(self.signer.sides[n]) else {
            return NotatedHandPoint::Palm;
        };
        let state = &self.state[n];
        let v = state.rotation.inverse() * direction;
        let [along, palm, radial] = [hand.along, hand.palm, hand.radial].map(|axis| v.dot(axis));
        coming_first(&state.handshape, [along, palm, radial], region)
    }

    /// Returns the mean position of a hand's points in the plan, and the hand's outward unit normal there.
    pub(super) fn at_hand(&self, n: usize, points: &[NotatedHandPoint]) -> (DVec3, DVec3) {
        let state = &self.state[n];
        let offset = self.mean_hand_point(n, points);
        let hand_point = state.wrist_position() + state.rotation * offset;
        let Some(hand) = self.signer.stage.hand_of_side(self.signer.sides[n]) else {
            return (hand_point, DVec3::Y);
        };
        let shape = &self.shapes[n][state.shape];
        let out: DVec3 = points
            .iter()
            .map(|&point| self.signer.stage.hand_point_normal(hand, shape, point))
            .sum();
        (hand_point, (state.rotation * out).normalize_or(DVec3::Y))
    }

    /// Returns the points of hands that do not mirror each other, and the direction from the other hand's
    /// point to the dominant hand's: the outward normal of the touched part.
    fn unlike(
        &self,
        hands: &HandConstellation,
        frames: [ActingFrame; 2],
        across: DVec3,
    ) -> ([Vec<NotatedHandPoint>; 2], DVec3) {
        let region = BodyRegion::Arm(self.signer.sides[1]);
        let dominant_points = hands
            .dominant
            .as_ref()
            .map(|site| self.signer.site_points(0, site, frames[0]));
        let other = match &hands.other {
            Some(site) => self.signer.site_points(1, site, frames[1]),
            None => {
                let direction = match &dominant_points {
                    Some(points) => -self.at_hand(0, points).1,
                    None => (DVec3::Y + across * 0.6 + self.signer.stage.forward * 0.3).normalize(),
                };
                vec![self.leading_hand_point(1, direction, BodyRegion::Trunk)]
            }
        };
        let out = self.at_hand(1, &other).1;
        let own_points = dominant_points.unwrap_or_else(|| vec![self.leading_hand_point(0, -out, region)]);
        let facing = self.at_hand(0, &own_points).1;
        let direction = (out - facing).try_normalize().unwrap_or(across);
        ([own_points, other], direction)
    }
}

/// Returns the constellation of mirrored hands that meet at the same site.
fn meeting_constellation(site: &HandSite) -> HandConstellation {
    let plain = HandSite {
        by: None,
        contact: None,
        define: None,
        ..site.clone()
    };
    let own_part = site.by.as_deref().cloned();
    HandConstellation {
        dominant: own_part.or_else(|| Some(plain.clone())),
        other: Some(plain),
        contact: site.contact.or(Some(PlaceContact::Touch)),
        define: site.define,
        ..HandConstellation::default()
    }
}

/// A place on the body with its position.
#[derive(Debug, Clone)]
struct PlacedSite {
    at: DVec3,
    out: DVec3,
    site: BodySite,
}

fn middle_of_sites(a: &PlacedSite, b: &PlacedSite) -> PlacedSite {
    PlacedSite {
        at: (a.at + b.at) / 2.0,
        out: (a.out + b.out).normalize_or(a.out),
        site: BodySite {
            lateral: (a.site.lateral + b.site.lateral) / 2.0,
            beside: a.site.beside && b.site.beside,
            ..a.site.clone()
        },
    }
}
