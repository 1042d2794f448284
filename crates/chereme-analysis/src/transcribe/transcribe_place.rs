//! Places of the hands: the nearest place on the body or in space, contacts, and constellations of the two
//! hands.

mod place_choice;
mod place_hand;
mod place_together;
mod spread;

use std::cell::OnceCell;

use chereme_motion::{BodySide as Half, ModelPose};
use chereme_sign::hamnosys::sites::{
    BodyRegion, DigitFace, FLESH_DEPTH_ARM_LENGTHS, HandAt, NotatedHandPoint, hand_points, hands_apart_share,
    is_place_of_first_point, resolve_body_site,
};
use chereme_sign::hamnosys::{BodyLocation, BodyPlace, HandDigit, Handshape, PlaceContact, SidedLocation};
use glam::DVec3;

use super::BestReading;
use super::transcribe_scene::{LevelSignerAxes, SignerScene};
use crate::transcribe::transcribe_tuned::tuned;
use place_choice::{BodySpot, PlaceChoice, middle_spot, possible_place_contacts};
use place_hand::{PosedHand, named_all};
use spread::{FreeHandKind, HandOffsetSpread};

pub(super) use place_hand::hand_point_site;
pub(super) use place_together::HandsTogether;

/// The place found for a hand, with its errors.
#[derive(Debug, Clone)]
pub(super) struct LikelyHandPlace {
    pub(super) place: BodyPlace,
    /// Distance between the hand and the goal that the place gives it, in metres.
    pub(super) residual: f64,
    /// The hand's position, less that goal, in metres.
    pub(super) aside: DVec3,
    pub(super) runner_up: Option<(BodyPlace, f64)>,
    /// Its penalty against the simplest and exact reading, in nepers.
    pub(super) score: f64,
    /// The part of `score` that comes from the hand's position.
    pub(super) unlikely: f64,
    /// Distance between the hand and the body at that place, in metres.
    pub(super) distance: f64,
    /// Whether the place refers to a part of the hand rather than the whole hand.
    pub(super) small: bool,
    /// The parts of the hand that touch the place, or come nearest to it.
    parts: Vec<NotatedHandPoint>,
}

/// The body in one posture with both hands.
#[derive(Clone)]
pub(super) struct PosedBody<'a> {
    scene: &'a SignerScene<'a>,
    axes: LevelSignerAxes,
    model: ModelPose,
    /// The dominant hand, then the other.
    hands: [Option<PosedHand>; 2],
    spread: HandOffsetSpread,
    choices: [OnceCell<Vec<PlaceChoice>>; 2],
}

/// A candidate place for a hand, with the hand's distance from it.
struct PlaceCandidate<'c> {
    choice: &'c PlaceChoice,
    contact: Option<PlaceContact>,
    /// The parts of the hand that the notation must name.
    named_parts: Option<&'c [NotatedHandPoint]>,
    residual: f64,
    aside: DVec3,
    /// Its penalty against the simplest and exact reading, in nepers.
    score: f64,
    /// The part of `score` that comes from the hand's position.
    unlikely: f64,
    distance: f64,
    /// Whether it refers to a part of the hand rather than the whole hand.
    small: bool,
    /// The part of the hand that notation refers to if it names no part.
    meant: NotatedHandPoint,
}

/// Whether to consider rare places too, and places that a hand was pushed out of, by any of its parts.
#[derive(Debug, Clone, Copy, PartialEq)]
enum PlaceScope {
    No,
    Yes,
}

impl PlaceCandidate<'_> {
    fn to_likely_place(&self) -> LikelyHandPlace {
        LikelyHandPlace {
            place: self.candidate_body_place(),
            residual: self.residual,
            aside: self.aside,
            runner_up: None,
            score: self.score,
            unlikely: self.unlikely,
            distance: self.distance,
            small: self.small,
            parts: match self.named_parts {
                Some(parts) => parts.to_vec(),
                None => vec![self.meant],
            },
        }
    }

    fn candidate_sites(&self) -> [Option<SidedLocation<BodyLocation>>; 2] {
        [Some(self.choice.spot.site), self.choice.second]
    }

    fn candidate_body_place(&self) -> BodyPlace {
        let [site, second] = self.candidate_sites();
        BodyPlace {
            site,
            second,
            contact: self.contact,
            by: self.named_parts.map(named_all),
            ..BodyPlace::default()
        }
    }
}

impl<'a> PosedBody<'a> {
    /// Reads one frame; `None` if the skeleton shows no trunk there. `shapes` are the handshapes of the
    /// dominant hand and of the other.
    pub(super) fn read_posed_body(
        scene: &'a SignerScene<'a>,
        frame: usize,
        shapes: [Option<&Handshape>; 2],
    ) -> Option<Self> {
        let model = scene.clip.model_pose(frame);
        let axes = LevelSignerAxes::read_signer_axes(scene.anatomy, scene.alone, &model, scene.dominant)?;
        let hands = [0, 1].map(|n| PosedHand::read_posed_hand(scene, &axes, &model, n, frame, shapes[n]));
        Some(Self {
            scene,
            axes,
            model,
            hands,
            spread: HandOffsetSpread::spread_from_scene(scene),
            choices: Default::default(),
        })
    }

    /// Returns the body with each hand moved by an offset, in metres.
    pub(super) fn with_shifted_hands(&self, by: [DVec3; 2]) -> Self {
        let mut body = self.clone();
        for (n, by) in by.into_iter().enumerate() {
            body.shift_body_hand(n, by);
        }
        body
    }

    /// Moves hand `n` by an offset, in metres.
    pub(super) fn shift_body_hand(&mut self, n: usize, by: DVec3) {
        if let Some(hand) = &mut self.hands[n] {
            hand.shift_posed_hand(by);
        }
    }

    /// Returns every candidate place, as goals of hand `n`.
    fn place_choices(&self, n: usize) -> &[PlaceChoice] {
        self.choices[n].get_or_init(|| place_choice::all_place_choices(|site| self.body_spot_at(n, site)))
    }

    fn body_spot_at(&self, n: usize, site: &SidedLocation<BodyLocation>) -> Option<BodySpot> {
        let scene = self.scene;
        let acting = [scene.dominant, scene.dominant.opposite_side()][n];
        let body_spot = resolve_body_site(site, acting, scene.dominant == Half::Left);
        // A hand is always near its own arm.
        if body_spot.region == BodyRegion::Arm(acting) {
            return None;
        }
        let flip = DVec3::new(-scene.dominant.side_sign(), 1.0, 1.0);
        let root =
            scene
                .anatomy
                .landmark_place_position(scene.clip.clip_skeleton(), &self.model, &body_spot.landmark)?;
        // The top of a shoulder is a point of that shoulder's joint.
        let shoulder = body_spot.landmark.ends_with("-shoulder");
        let root = match body_spot.region {
            BodyRegion::Trunk if !shoulder => self.axes.on_trunk(root),
            _ => self.axes.signer_place_of(root),
        };
        let out = (DVec3::from(body_spot.out) * flip).normalize_or(DVec3::Z);
        let flesh = match body_spot.region {
            BodyRegion::Arm(_) => out * (FLESH_DEPTH_ARM_LENGTHS * scene.arm),
            _ => DVec3::ZERO,
        };
        let offset = DVec3::from(body_spot.offset) * flip * scene.shoulders;
        Some(BodySpot {
            site: *site,
            at: root + offset + flesh,
            out,
            region: body_spot.region,
            lateral: body_spot.lateral * flip.x,
            beside: body_spot.beside,
            level: body_spot.level,
        })
    }

    /// Returns the likeliest place of hand `n`. With `symmetric`, places without a side keep the hands
    /// apart.
    pub(super) fn find_hand_place(&self, n: usize, symmetric: bool) -> Option<LikelyHandPlace> {
        let hand = self.hands[n].as_ref()?;
        self.find_given_hand_place(n, hand, symmetric)
    }

    fn find_given_hand_place(&self, n: usize, hand: &PosedHand, symmetric: bool) -> Option<LikelyHandPlace> {
        let all = self.candidate_hand_places(n, hand, symmetric, PlaceScope::No);
        let lower = |a: &&PlaceCandidate<'_>, b: &&PlaceCandidate<'_>| a.score.total_cmp(&b.score);
        let best = all.iter().min_by(lower)?;
        let of = best.candidate_sites();
        let others = all.iter().filter(|other| {
            let sites = other.candidate_sites();
            !sites.iter().flatten().any(|site| of.contains(&Some(*site)))
        });
        Some(LikelyHandPlace {
            runner_up: others
                .min_by(lower)
                .map(|other| (other.candidate_body_place(), other.residual)),
            ..best.to_likely_place()
        })
    }

    /// Returns the likeliest places of hand `n`, at most `most` of them, the likeliest first. Includes
    /// places that the hand was pushed out of, by any of its parts.
    pub(super) fn rank_hand_places(&self, n: usize, symmetric: bool, most: usize) -> Vec<LikelyHandPlace> {
        let hand = self.hands[n].as_ref();
        hand.map_or_else(Vec::new, |hand| self.likeliest_of(n, hand, symmetric, most))
    }

    fn likeliest_of(&self, n: usize, hand: &PosedHand, symmetric: bool, most: usize) -> Vec<LikelyHandPlace> {
        let all = self.candidate_hand_places(n, hand, symmetric, PlaceScope::Yes);
        let mut order: Vec<(f64, usize)> = (0..all.len()).map(|k| (all[k].score, k)).collect();
        let lower = |a: &(f64, usize), b: &(f64, usize)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
        if most < order.len() {
            order.select_nth_unstable_by(most, lower);
            order.truncate(most);
        }
        order.sort_unstable_by(lower);
        order.into_iter().map(|(_, k)| all[k].to_likely_place()).collect()
    }

    fn candidate_hand_places<'c>(
        &'c self,
        n: usize,
        hand: &'c PosedHand,
        symmetric: bool,
        wide: PlaceScope,
    ) -> Vec<PlaceCandidate<'c>> {
        let mut all = Vec::new();
        let choices = self.place_choices(n).iter();
        for choice in choices.filter(|choice| wide == PlaceScope::Yes || !choice.far) {
            self.weigh_place_choice(n, hand, choice, wide, symmetric, &mut all);
        }
        all
    }

    /// Scores a place for a hand, at each possible nearness.
    fn weigh_place_choice<'c>(
        &self,
        n: usize,
        hand: &'c PosedHand,
        choice: &'c PlaceChoice,
        wide: PlaceScope,
        symmetric: bool,
        all: &mut Vec<PlaceCandidate<'c>>,
    ) {
        let scene = self.scene;
        let spot = &choice.spot;
        for &contact in possible_place_contacts(choice) {
            let region = spot.region_for(contact);
            let trunk = region == BodyRegion::Trunk;
            let meant_spot = hand.meant_hand_spot(spot.out, region);
            let touching = contact == Some(PlaceContact::Touch);
            let near = contact == Some(PlaceContact::Close);
            let small = touching || (near && !trunk);
            let first_point = small || is_place_of_first_point(region, contact);
            let ahead = if first_point { 0.0 } else { hand.ahead };
            let goal = self.hand_point_goal(spot, contact, n, ahead, symmetric);
            let within = goal.distance(hand.palm) < 1.2 * scene.hand;
            // A hand that touches has a part there, and no part is farther from the palm than this.
            if touching && !within {
                continue;
            }
            let nearness = tuned().place.nearness[usize::from(!trunk)];
            let cost = choice.cost
                + match contact {
                    Some(PlaceContact::Close) => nearness[0],
                    Some(PlaceContact::ArmExtended) => nearness[2],
                    Some(_) => nearness[3],
                    None => nearness[1],
                }
                + match (choice.half_top, choice.top) {
                    _ if touching => 0.0,
                    (true, _) => tuned().choice.top,
                    (_, true) => tuned().choice.top_alone[usize::from(!near)],
                    _ => 0.0,
                }
                + if symmetric && !spot.beside && spot.lateral != 0.0 {
                    tuned().place.own_sides
                } else {
                    0.0
                };
            let hand_spot = if first_point {
                meant_spot
            } else {
                hand.palm_middle_spot()
            };
            // A named part of the hand is at the place itself.
            let part = self.hand_point_goal(spot, contact, n, 0.0, symmetric);
            let mut add = |at: DVec3, named_parts: Option<&'c [NotatedHandPoint]>, cost: f64| {
                let distance = at.distance(spot.at);
                let far = distance > tuned().place.touch[usize::from(trunk)] * scene.arm;
                if touching && far && wide == PlaceScope::No {
                    return;
                }
                let off = at - named_parts.map_or(goal, |_| part);
                let unlikely = if touching {
                    self.spread.touching_hand_penalty(off, spot.out, trunk)
                } else {
                    let of = match (hand.between, trunk) {
                        (true, _) => FreeHandKind::Between,
                        (_, true) => FreeHandKind::Trunk,
                        (_, false) => FreeHandKind::Head,
                    };
                    self.spread
                        .free_hand_penalty(off, of, contact == Some(PlaceContact::ArmExtended))
                };
                all.push(PlaceCandidate {
                    choice,
                    contact,
                    named_parts,
                    residual: if touching { distance } else { off.length() },
                    aside: off,
                    score: unlikely + cost,
                    unlikely,
                    distance,
                    small: named_parts.is_some() || small,
                    meant: hand_spot.point,
                });
            };
            add(
                hand_spot.at,
                None,
                cost + if touching { tuned().place.unsaid } else { 0.0 },
            );
            if (small || near) && within {
                let pushed = (touching && trunk).then_some(spot.out);
                let penalty = tuned().place.said[if touching { 2 } else { usize::from(!trunk) }];
                if wide == PlaceScope::Yes {
                    for (at, parts, steps) in hand.nameable_hand_parts() {
                        add(*at, Some(parts), cost + penalty + tuned().place.step * steps);
                    }
                } else if let Some((at, parts, steps)) = hand.nearest_nameable_part(part, pushed) {
                    add(at, Some(parts), cost + penalty + tuned().place.step * steps);
                }
            }
        }
    }

    /// Returns the distance (m) between the part of hand `n` that a place refers to and its goal; `None`
    /// if the skeleton lacks the joints.
    pub(super) fn hand_place_distance(&self, n: usize, place: &BodyPlace, symmetric: bool) -> Option<f64> {
        let hand = self.hands[n].as_ref()?;
        let spot = self.named_spot(n, place)?;
        let goal = self.goal_of(n, place, symmetric)?;
        let region = spot.region_for(place.contact);
        let hand_position = match &place.by {
            Some(by) => {
                let acting_half = [self.scene.dominant, self.scene.dominant.opposite_side()][n];
                let points = hand_points(by, acting_half, self.scene.dominant == Half::Left);
                hand.mean_point_position(&points)
            }
            None if is_place_of_first_point(region, place.contact) => hand.meant_hand_spot(spot.out, region).at,
            None => hand.palm,
        };
        Some(hand_position.distance(goal))
    }

    fn named_spot(&self, n: usize, place: &BodyPlace) -> Option<BodySpot> {
        let first = self.body_spot_at(n, &place.site?)?;
        Some(match &place.second {
            Some(second) => middle_spot(&first, &self.body_spot_at(n, second)?),
            None => first,
        })
    }

    /// Returns the goal that a place gives to the part of the hand that it refers to.
    pub(super) fn goal_of(&self, n: usize, place: &BodyPlace, symmetric: bool) -> Option<DVec3> {
        let spot = self.named_spot(n, place)?;
        let ahead = match (&place.by, &self.hands[n]) {
            (None, Some(hand)) => hand.ahead,
            _ => 0.0,
        };
        Some(self.hand_point_goal(&spot, place.contact, n, ahead, symmetric))
    }

    /// Returns the goal of a point of hand `n` that is this far ahead of its wrist (m).
    fn hand_point_goal(
        &self,
        spot: &BodySpot,
        contact: Option<PlaceContact>,
        n: usize,
        ahead: f64,
        symmetric: bool,
    ) -> DVec3 {
        let scene = self.scene;
        let region = spot.region_for(contact);
        let lengths = [scene.arm, scene.shoulders];
        let hand = HandAt::hand_at_place(
            region,
            spot.lateral,
            spot.beside,
            contact,
            scene.language,
            lengths,
            ahead,
        );
        let apart = if symmetric && spot.lateral == 0.0 {
            let side_sign = if n == 0 { -1.0 } else { 1.0 };
            side_sign * scene.language.hands_apart * hands_apart_share(contact) * scene.shoulders
        } else {
            0.0
        };
        match hand {
            HandAt::Place => spot.at,
            HandAt::Off { out, .. } if out < 0.0 => spot.at + spot.out * out,
            HandAt::Off { out, left } => spot.at + spot.out * out + DVec3::X * (left + apart),
            HandAt::Front { left, forward } => DVec3::new(left + apart, spot.at.y, forward),
        }
    }

    /// Returns the parts of a hand that are at the other hand and at the body.
    pub(super) fn meant_parts(&self, n: usize) -> Vec<Vec<NotatedHandPoint>> {
        let mut part_groups: Vec<Vec<NotatedHandPoint>> = Vec::new();
        part_groups.extend(self.nearest_hands_together().map(|together| vec![together.parts[n]]));
        let placed = self.find_hand_place(n, false).filter(|placed| placed.small);
        part_groups.extend(placed.map(|placed| placed.parts));
        part_groups
    }

    /// Returns less likely parts of a hand, each with its penalty in nepers against the likeliest one:
    /// those of other places and other pairs of parts.
    pub(super) fn other_parts(&self, n: usize) -> Vec<(Vec<NotatedHandPoint>, f64)> {
        let Some(hand) = self.hands[n].as_ref() else {
            return Vec::new();
        };
        let mut part_groups: Vec<(Vec<NotatedHandPoint>, f64)> = Vec::new();
        let mut add =
            |parts: Vec<NotatedHandPoint>, less: f64| match part_groups.iter_mut().find(|(known, _)| *known == parts) {
                Some((_, known)) => *known = known.min(less),
                None => part_groups.push((parts, less)),
            };
        let all = self.candidate_hand_places(n, hand, false, PlaceScope::No);
        let best = all
            .iter()
            .map(|candidate| candidate.score)
            .fold(f64::INFINITY, f64::min);
        let near = all.iter().filter(|candidate| candidate.small);
        for it in near.filter(|candidate| candidate.score < best + tuned().place.rather_not) {
            let parts = it.named_parts.map_or_else(|| vec![it.meant], <[_]>::to_vec);
            add(parts, it.score - best);
        }
        for (part, less) in self.other_pairs(n, tuned().place.rather_not) {
            add(vec![part], less);
        }
        part_groups
    }

    /// Returns the positions of parts of a hand.
    pub(super) fn where_are(&self, n: usize, parts: &[Vec<NotatedHandPoint>]) -> Vec<DVec3> {
        let hand = self.hands[n].iter();
        hand.flat_map(|hand| parts.iter().map(|points| hand.mean_point_position(points)))
            .collect()
    }

    /// Returns the positions of the fingertips that the hand may turn about.
    pub(super) fn turning_fingertips(&self, n: usize) -> Vec<DVec3> {
        let tip_digits = [HandDigit::Thumb, HandDigit::Index, HandDigit::Middle];
        let tips = tip_digits.map(|digit| NotatedHandPoint::Tip(digit, DigitFace::Middle));
        let points = self.hands[n].iter().flat_map(|hand| &hand.points);
        points
            .filter(|spotted| tips.contains(&spotted.point))
            .map(|spotted| spotted.at)
            .collect()
    }
}

impl LikelyHandPlace {
    /// Returns the place with its residual and runner-up.
    pub(super) fn to_place_reading(&self) -> BestReading<BodyPlace> {
        BestReading {
            best: self.place.clone(),
            residual: self.residual,
            runner_up: self.runner_up.clone(),
        }
    }
}
