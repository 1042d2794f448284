//! Places of the hands: the nearest place on the body or in space, contacts, and constellations of the two
//! hands.

mod choice;
mod hand;
mod spread;
mod together;

use std::cell::OnceCell;

use chereme_motion::{ModelPose, Side as Half};
use chereme_sign::hamnosys::sites::{
    FLESH, Face, HandAt, HandPoint, Region, body_site, hand_points,
};
use chereme_sign::hamnosys::{BodyLocation, BodyPlace, Contact, Digit, Handshape, Site};
use glam::DVec3;

use super::Found;
use super::scene::{Axes, Scene};
use crate::transcribe::tuned::tuned;
use choice::{Choice, Spot, contacts, middle};
use hand::{Hand, named_all};
use spread::{Free, Spread};

pub(super) use hand::named;
pub(super) use together::Together;

/// The place found for a hand, with its errors.
#[derive(Debug, Clone)]
pub(super) struct Placed {
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
    parts: Vec<HandPoint>,
}

/// The body in one posture with both hands.
#[derive(Clone)]
pub(super) struct Body<'a> {
    scene: &'a Scene<'a>,
    axes: Axes,
    model: ModelPose,
    /// The dominant hand, then the other.
    hands: [Option<Hand>; 2],
    spread: Spread,
    choices: [OnceCell<Vec<Choice>>; 2],
}

/// A candidate place for a hand, with the hand's distance from it.
struct Candidate<'c> {
    choice: &'c Choice,
    contact: Option<Contact>,
    /// The parts of the hand that the notation must name.
    named_parts: Option<&'c [HandPoint]>,
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
    meant: HandPoint,
}

/// Whether to consider rare places too, and places that a hand was pushed out of, by any of its parts.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Wide {
    No,
    Yes,
}

impl Candidate<'_> {
    fn placed(&self) -> Placed {
        Placed {
            place: self.place(),
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

    fn sites(&self) -> [Option<Site<BodyLocation>>; 2] {
        [Some(self.choice.spot.site), self.choice.second]
    }

    fn place(&self) -> BodyPlace {
        let [site, second] = self.sites();
        BodyPlace {
            site,
            second,
            contact: self.contact,
            by: self.named_parts.map(named_all),
            ..BodyPlace::default()
        }
    }
}

impl<'a> Body<'a> {
    /// Reads one frame; `None` if the skeleton shows no trunk there. `shapes` are the handshapes of the
    /// dominant hand and of the other.
    pub(super) fn of(
        scene: &'a Scene<'a>,
        frame: usize,
        shapes: [Option<&Handshape>; 2],
    ) -> Option<Self> {
        let model = scene.clip.model_pose(frame);
        let axes = Axes::of(scene.anatomy, scene.alone, &model, scene.dominant)?;
        let hands = [0, 1].map(|n| Hand::of(scene, &axes, &model, (n, frame), shapes[n]));
        Some(Self {
            scene,
            axes,
            model,
            hands,
            spread: Spread::of(scene),
            choices: Default::default(),
        })
    }

    /// Returns the body with each hand moved by an offset, in metres.
    pub(super) fn shifted(&self, by: [DVec3; 2]) -> Self {
        let mut body = self.clone();
        for (n, by) in by.into_iter().enumerate() {
            body.shift(n, by);
        }
        body
    }

    /// Moves hand `n` by an offset, in metres.
    pub(super) fn shift(&mut self, n: usize, by: DVec3) {
        if let Some(hand) = &mut self.hands[n] {
            hand.shift(by);
        }
    }

    /// Returns every candidate place, as goals of hand `n`.
    fn choices(&self, n: usize) -> &[Choice] {
        self.choices[n].get_or_init(|| choice::all(|site| self.spot(n, site)))
    }

    fn spot(&self, n: usize, site: &Site<BodyLocation>) -> Option<Spot> {
        let scene = self.scene;
        let acting = [scene.dominant, scene.dominant.other()][n];
        let found = body_site(site, acting, scene.dominant == Half::Left);
        // A hand is always near its own arm.
        if found.region == Region::Arm(acting) {
            return None;
        }
        let flip = DVec3::new(-scene.dominant.sign(), 1.0, 1.0);
        let root = scene
            .anatomy
            .landmark(scene.clip.skeleton(), &self.model, &found.landmark)?;
        // The top of a shoulder is a point of that shoulder's joint.
        let shoulder = found.landmark.ends_with("-shoulder");
        let root = match found.region {
            Region::Trunk if !shoulder => self.axes.on_trunk(root),
            _ => self.axes.place(root),
        };
        let out = (DVec3::from(found.out) * flip).normalize_or(DVec3::Z);
        let flesh = match found.region {
            Region::Arm(_) => out * (FLESH * scene.arm),
            _ => DVec3::ZERO,
        };
        let offset = DVec3::from(found.offset) * flip * scene.shoulders;
        Some(Spot {
            site: *site,
            at: root + offset + flesh,
            out,
            region: found.region,
            lateral: found.lateral * flip.x,
            beside: found.beside,
            level: found.level,
        })
    }

    /// Returns the likeliest place of hand `n`. With `symmetric`, places without a side keep the hands
    /// apart.
    pub(super) fn place(&self, n: usize, symmetric: bool) -> Option<Placed> {
        let hand = self.hands[n].as_ref()?;
        self.placed(n, hand, symmetric)
    }

    fn placed(&self, n: usize, hand: &Hand, symmetric: bool) -> Option<Placed> {
        let all = self.candidates(n, hand, symmetric, Wide::No);
        let lower = |a: &&Candidate<'_>, b: &&Candidate<'_>| a.score.total_cmp(&b.score);
        let best = all.iter().min_by(lower)?;
        let of = best.sites();
        let others = all.iter().filter(|other| {
            let sites = other.sites();
            !sites.iter().flatten().any(|site| of.contains(&Some(*site)))
        });
        Some(Placed {
            runner_up: others
                .min_by(lower)
                .map(|other| (other.place(), other.residual)),
            ..best.placed()
        })
    }

    /// Returns the likeliest places of hand `n`, at most `most` of them, the likeliest first. Includes
    /// places that the hand was pushed out of, by any of its parts.
    pub(super) fn likeliest(&self, n: usize, symmetric: bool, most: usize) -> Vec<Placed> {
        let hand = self.hands[n].as_ref();
        hand.map_or_else(Vec::new, |hand| self.likeliest_of(n, hand, symmetric, most))
    }

    fn likeliest_of(&self, n: usize, hand: &Hand, symmetric: bool, most: usize) -> Vec<Placed> {
        let all = self.candidates(n, hand, symmetric, Wide::Yes);
        let mut order: Vec<(f64, usize)> = (0..all.len()).map(|k| (all[k].score, k)).collect();
        let lower = |a: &(f64, usize), b: &(f64, usize)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
        if most < order.len() {
            order.select_nth_unstable_by(most, lower);
            order.truncate(most);
        }
        order.sort_unstable_by(lower);
        order.into_iter().map(|(_, k)| all[k].placed()).collect()
    }

    fn candidates<'c>(
        &'c self,
        n: usize,
        hand: &'c Hand,
        symmetric: bool,
        wide: Wide,
    ) -> Vec<Candidate<'c>> {
        let mut all = Vec::new();
        let choices = self.choices(n).iter();
        for choice in choices.filter(|it| wide == Wide::Yes || !it.far) {
            self.weigh(n, hand, (choice, wide), symmetric, &mut all);
        }
        all
    }

    /// Scores a place for a hand, at each possible nearness.
    fn weigh<'c>(
        &self,
        n: usize,
        hand: &'c Hand,
        (choice, wide): (&'c Choice, Wide),
        symmetric: bool,
        all: &mut Vec<Candidate<'c>>,
    ) {
        let scene = self.scene;
        let spot = &choice.spot;
        for &contact in contacts(choice) {
            let region = spot.region_for(contact);
            let trunk = region == Region::Trunk;
            let meant = hand.meant(spot.out, region);
            let touching = contact == Some(Contact::Touch);
            let near = contact == Some(Contact::Close);
            let small = touching || (near && !trunk);
            let ahead = if small { 0.0 } else { hand.ahead };
            let goal = self.goal(spot, contact, (n, ahead), symmetric);
            let within = goal.distance(hand.palm) < 1.2 * scene.hand;
            if touching && !within {
                continue;
            }
            let nearness = tuned().place.nearness[usize::from(!trunk)];
            let cost = choice.cost
                + match contact {
                    Some(Contact::Close) => nearness[0],
                    Some(Contact::ArmExtended) => nearness[2],
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
            let own = if small { meant } else { hand.middle() };
            // A named part of the hand is at the place itself.
            let part = self.goal(spot, contact, (n, 0.0), symmetric);
            let mut add = |at: DVec3, named_parts: Option<&'c [HandPoint]>, cost: f64| {
                let distance = at.distance(spot.at);
                let far = distance > tuned().place.touch[usize::from(trunk)] * scene.arm;
                if touching && far && wide == Wide::No {
                    return;
                }
                let off = at - named_parts.map_or(goal, |_| part);
                let unlikely = if touching {
                    self.spread.touching(off, spot.out, trunk)
                } else {
                    let of = match (hand.between, trunk) {
                        (true, _) => Free::Between,
                        (_, true) => Free::Trunk,
                        (_, false) => Free::Head,
                    };
                    self.spread
                        .free(off, of, contact == Some(Contact::ArmExtended))
                };
                all.push(Candidate {
                    choice,
                    contact,
                    named_parts,
                    residual: if touching { distance } else { off.length() },
                    aside: off,
                    score: unlikely + cost,
                    unlikely,
                    distance,
                    small: named_parts.is_some() || small,
                    meant: own.point,
                });
            };
            add(
                own.at,
                None,
                cost + if touching { tuned().place.unsaid } else { 0.0 },
            );
            if (small || near) && within {
                let pushed = (touching && trunk).then_some(spot.out);
                let penalty = tuned().place.said[if touching { 2 } else { usize::from(!trunk) }];
                if wide == Wide::Yes {
                    for (at, parts, steps) in hand.nameable() {
                        add(
                            *at,
                            Some(parts),
                            cost + penalty + tuned().place.step * steps,
                        );
                    }
                } else if let Some((at, parts, steps)) = hand.nearest(part, pushed) {
                    add(at, Some(parts), cost + penalty + tuned().place.step * steps);
                }
            }
        }
    }

    /// Returns the distance (m) between the part of hand `n` that a place refers to and its goal; `None`
    /// if the skeleton lacks the joints.
    pub(super) fn off(&self, n: usize, place: &BodyPlace, symmetric: bool) -> Option<f64> {
        let hand = self.hands[n].as_ref()?;
        let spot = self.named_spot(n, place)?;
        let goal = self.goal_of(n, place, symmetric)?;
        let region = spot.region_for(place.contact);
        let near = place.contact == Some(Contact::Close) && region != Region::Trunk;
        let at = match &place.by {
            Some(by) => {
                let own = [self.scene.dominant, self.scene.dominant.other()][n];
                let points = hand_points(by, own, self.scene.dominant == Half::Left);
                hand.mean(&points)
            }
            None if near || place.contact == Some(Contact::Touch) => {
                hand.meant(spot.out, region).at
            }
            None => hand.palm,
        };
        Some(at.distance(goal))
    }

    fn named_spot(&self, n: usize, place: &BodyPlace) -> Option<Spot> {
        let first = self.spot(n, &place.site?)?;
        Some(match &place.second {
            Some(second) => middle(&first, &self.spot(n, second)?),
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
        Some(self.goal(&spot, place.contact, (n, ahead), symmetric))
    }

    /// Returns the goal of a point of hand `n` that is this far ahead of its wrist (m).
    fn goal(
        &self,
        spot: &Spot,
        contact: Option<Contact>,
        (n, ahead): (usize, f64),
        symmetric: bool,
    ) -> DVec3 {
        let scene = self.scene;
        let found = (spot.region_for(contact), spot.lateral, spot.beside);
        let lengths = [scene.arm, scene.shoulders];
        let hand = HandAt::of(found, contact, scene.language, lengths, ahead);
        let apart = if symmetric && spot.lateral == 0.0 {
            let own = if n == 0 { -1.0 } else { 1.0 };
            own * scene.language.hands_apart * scene.shoulders
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
    pub(super) fn meant_parts(&self, n: usize) -> Vec<Vec<HandPoint>> {
        let mut found: Vec<Vec<HandPoint>> = Vec::new();
        found.extend(self.together().map(|together| vec![together.parts[n]]));
        let placed = self.place(n, false).filter(|placed| placed.small);
        found.extend(placed.map(|placed| placed.parts));
        found
    }

    /// Returns less likely parts of a hand, each with its penalty in nepers against the likeliest one:
    /// those of other places and other pairs of parts.
    pub(super) fn other_parts(&self, n: usize) -> Vec<(Vec<HandPoint>, f64)> {
        let Some(hand) = self.hands[n].as_ref() else {
            return Vec::new();
        };
        let mut found: Vec<(Vec<HandPoint>, f64)> = Vec::new();
        let mut add = |parts: Vec<HandPoint>, less: f64| match found
            .iter_mut()
            .find(|(known, _)| *known == parts)
        {
            Some((_, known)) => *known = known.min(less),
            None => found.push((parts, less)),
        };
        let all = self.candidates(n, hand, false, Wide::No);
        let best = all.iter().map(|it| it.score).fold(f64::INFINITY, f64::min);
        let near = all.iter().filter(|it| it.small);
        for it in near.filter(|it| it.score < best + tuned().place.rather_not) {
            let parts = it.named_parts.map_or_else(|| vec![it.meant], <[_]>::to_vec);
            add(parts, it.score - best);
        }
        for (part, less) in self.other_pairs(n, tuned().place.rather_not) {
            add(vec![part], less);
        }
        found
    }

    /// Returns the positions of parts of a hand.
    pub(super) fn where_are(&self, n: usize, parts: &[Vec<HandPoint>]) -> Vec<DVec3> {
        let hand = self.hands[n].iter();
        hand.flat_map(|hand| parts.iter().map(|points| hand.mean(points)))
            .collect()
    }

    /// Returns the positions of the fingertips that the hand may turn about.
    pub(super) fn tips(&self, n: usize) -> Vec<DVec3> {
        let tips = [Digit::Thumb, Digit::Index, Digit::Middle];
        let tips = tips.map(|digit| HandPoint::Tip(digit, Face::Middle));
        let points = self.hands[n].iter().flat_map(|hand| &hand.points);
        points
            .filter(|spotted| tips.contains(&spotted.point))
            .map(|spotted| spotted.at)
            .collect()
    }
}

impl Placed {
    /// Returns the place with its residual and runner-up.
    pub(super) fn found(&self) -> Found<BodyPlace> {
        Found {
            best: self.place.clone(),
            residual: self.residual,
            runner_up: self.runner_up.clone(),
        }
    }
}
