//! Where hands are: the nearest place on the body or in space, what touches, the two by each other.

use chereme_motion::{Finger, ModelPose, Part, Side as Half};
use chereme_sign::hamnosys::sites::{BodySite, Face, HandPoint, Region, body_site};
use chereme_sign::hamnosys::{
    BodyLocation, BodyPlace, Contact, Digit, Digits, HandLocation, HandSite, Side, Site,
};
use glam::DVec3;

use super::Found;
use super::scene::{Axes, Scene};

/// Places that are told apart; those within them (teeth, eyelids) are said where one is surer.
const PLACES: [BodyLocation; 24] = [
    BodyLocation::Chest,
    BodyLocation::Shoulders,
    BodyLocation::Stomach,
    BodyLocation::BelowStomach,
    BodyLocation::Neck,
    BodyLocation::ShoulderTop,
    BodyLocation::Head,
    BodyLocation::HeadTop,
    BodyLocation::Forehead,
    BodyLocation::Eyebrows,
    BodyLocation::Eyes,
    BodyLocation::Nose,
    BodyLocation::Nostrils,
    BodyLocation::UpperLip,
    BodyLocation::Lips,
    BodyLocation::LowerLip,
    BodyLocation::Chin,
    BodyLocation::UnderChin,
    BodyLocation::Cheek,
    BodyLocation::Ear,
    BodyLocation::EarLobe,
    BodyLocation::UpperArm,
    BodyLocation::Elbow,
    BodyLocation::LowerArm,
];
const SIDES: [Option<Side>; 5] = [
    None,
    Some(Side::RightAt),
    Some(Side::LeftAt),
    Some(Side::RightBeside),
    Some(Side::LeftBeside),
];

/// A hand touches the head or an arm where it is nearer than the first, the trunk where nearer than
/// the second, the other hand where nearer than the third; in arm lengths.
const TOUCH: [f64; 3] = [0.05, 0.07, 0.045];
/// Hands are by each other where parts of them are nearer than this, in arm lengths.
const TOGETHER: f64 = 0.125;
/// How much a metre forward counts against one aside or up: depth varies most between signers.
const DEPTH: f64 = 0.6;
/// What is said costs so much, in arm lengths: half-way between places of the trunk (or touched ones) or
/// before the head; a place that is rarely meant; the shoulder's top without touching it; reaching far;
/// being close to the head without touching it.
const BETWEEN: [f64; 2] = [0.008, 0.028];
const RARE: f64 = 0.015;
const TOP: f64 = 0.004;
const FAR: f64 = 0.04;
const NEAR: f64 = 0.012;
/// A part of the hand counts as so much farther, in metres, for each step that it is less likely meant.
const RANK: f64 = 0.004;
/// Half-way between two places may be meant that are nearer to each other than this, in metres.
const APART: f64 = 0.2;

/// A place that was found, with the distance to it.
#[derive(Debug, Clone)]
pub(super) struct Placed {
    pub(super) place: BodyPlace,
    /// From what a hand would be that is there, in metres.
    pub(super) residual: f64,
    pub(super) runner_up: Option<(BodyPlace, f64)>,
    /// From the hand to the body there, in metres.
    pub(super) distance: f64,
    /// Where the part of the hand is that touches it, or comes nearest to it.
    pub(super) by: Option<DVec3>,
}

/// The body in one posture with the points of both hands.
pub(super) struct Body<'a> {
    scene: &'a Scene<'a>,
    axes: Axes,
    spots: Vec<Spot>,
    /// Of the dominant hand and of the other.
    pub(super) points: [Vec<(HandPoint, DVec3)>; 2],
    palms: [Option<DVec3>; 2],
}

/// A place on the body: where it is, and where a hand is that is before it.
#[derive(Debug, Clone)]
struct Spot {
    site: Site<BodyLocation>,
    found: BodySite,
    /// On the body; and its way out.
    at: DVec3,
    out: DVec3,
}

impl<'a> Body<'a> {
    /// Looks at one frame; nothing where the skeleton tells no trunk there.
    pub(super) fn of(scene: &'a Scene<'a>, frame: usize) -> Option<Self> {
        let model = scene.clip.model_pose(frame);
        let axes = Axes::of(scene.anatomy, scene.alone, &model, scene.dominant)?;
        let mut body = Self {
            scene,
            axes,
            spots: Vec::new(),
            points: [Vec::new(), Vec::new()],
            palms: [0, 1].map(|n| scene.hands[n].as_ref().map(|track| track.palm[frame])),
        };
        for (n, track) in scene.hands.iter().enumerate() {
            if let Some(track) = track {
                body.points[n] = body.hand_points(&model, track.side);
            }
        }
        for at in PLACES {
            for side in SIDES {
                if let Some(spot) = body.spot(&model, at, side) {
                    let same = |old: &Spot| {
                        old.at.distance(spot.at) < 1e-3
                            && old.found.lateral == spot.found.lateral
                            && old.found.region == spot.found.region
                            && old.out.distance(spot.out) < 1e-3
                    };
                    if !body.spots.iter().any(same) {
                        body.spots.push(spot);
                    }
                }
            }
        }
        Some(body)
    }

    fn spot(&self, model: &ModelPose, at: BodyLocation, side: Option<Side>) -> Option<Spot> {
        let scene = self.scene;
        let site = Site {
            at,
            side,
            approx: false,
        };
        let mirrored = scene.dominant == Half::Left;
        let found = body_site(&site, scene.dominant, mirrored);
        let flip = DVec3::new(-scene.dominant.sign(), 1.0, 1.0);
        let root = scene
            .anatomy
            .landmark(scene.clip.skeleton(), model, &found.landmark)?;
        // The top of a shoulder is where that shoulder is.
        let shoulder = found.landmark.ends_with("-shoulder");
        let root = match found.region {
            Region::Trunk if !shoulder => self.axes.on_trunk(root),
            _ => self.axes.place(root),
        };
        let out = (DVec3::from(found.out) * flip).normalize_or(DVec3::Z);
        let flesh = match found.region {
            Region::Arm(_) => out * (0.08 * scene.arm),
            _ => DVec3::ZERO,
        };
        let offset = DVec3::from(found.offset) * flip * scene.shoulders;
        let found = BodySite {
            lateral: found.lateral * flip.x,
            ..found
        };
        Some(Spot {
            site,
            at: root + offset + flesh,
            out,
            found,
        })
    }

    /// Returns where hand `n` is: the nearest place of all; with `symmetric` the hands are taken to be
    /// apart where nothing is said of sides.
    pub(super) fn place(&self, n: usize, symmetric: bool) -> Option<Placed> {
        let palm = self.palms[n]?;
        let singles: Vec<Option<&Spot>> = vec![None];
        let mut all: Vec<(BodyPlace, f64, f64, f64, DVec3)> = Vec::new();
        for (k, first) in self.spots.iter().enumerate() {
            let seconds = self.spots[k + 1..]
                .iter()
                .filter(|second| neighbours(first, second))
                .map(Some);
            for second in singles.iter().copied().chain(seconds) {
                self.weigh(n, palm, (first, second), symmetric, &mut all);
            }
        }
        all.sort_by(|a, b| a.2.total_cmp(&b.2));
        let (place, residual, _, distance, by) = all.first()?.clone();
        let other = all.iter().find(|other| {
            let named = |place: &BodyPlace| [place.site, place.second];
            let of = named(&place);
            !named(&other.0)
                .iter()
                .flatten()
                .any(|site| of.contains(&Some(*site)))
        });
        Some(Placed {
            runner_up: other.map(|other| (other.0.clone(), other.1)),
            place,
            residual,
            distance,
            by: Some(by),
        })
    }

    /// Weighs a place, or half-way between two, for a hand: touched, close, or before it.
    fn weigh(
        &self,
        n: usize,
        palm: DVec3,
        (first, second): (&Spot, Option<&Spot>),
        symmetric: bool,
        all: &mut Vec<(BodyPlace, f64, f64, f64, DVec3)>,
    ) {
        let (scene, l) = (self.scene, self.scene.language);
        let spot = second.map_or_else(|| first.clone(), |second| middle(first, second));
        let trunk = spot.found.region == Region::Trunk;
        let nearest = self.points[n]
            .iter()
            .filter(|(point, _)| touches(*point))
            .min_by(|a, b| {
                let off =
                    |(point, at): &(HandPoint, DVec3)| at.distance(spot.at) + RANK * rank(*point);
                off(a).total_cmp(&off(b))
            });
        let Some(&(by, by_at)) = nearest else { return };
        let distance = by_at.distance(spot.at);
        let touched = distance < TOUCH[usize::from(trunk)] * scene.arm && !spot.found.beside;
        let between = second.map_or(0.0, |_| BETWEEN[usize::from(!trunk && !touched)]);
        let rare = [Some(first), second]
            .into_iter()
            .flatten()
            .filter(|spot| is_rare(spot.site.at))
            .count();
        let cost = between + RARE * rare as f64;
        let mut add = |contact: Option<Contact>, residual: f64, by: Option<HandSite>, at: DVec3| {
            let place = BodyPlace {
                site: Some(first.site),
                second: second.map(|second| second.site),
                contact,
                by,
                ..BodyPlace::default()
            };
            let more = match contact {
                Some(Contact::ArmExtended) => FAR,
                Some(Contact::Close) if !trunk => NEAR,
                None | Some(Contact::Close) if is_top(first.site.at) => TOP,
                _ => 0.0,
            };
            let score = residual + (cost + more) * scene.arm;
            all.push((place, residual, score, distance, at));
        };
        if touched {
            // What touches is told by where it is, not by where a hand before it would be.
            let off = distance + RANK * rank(by);
            add(Some(Contact::Touch), off, Some(named(by)), by_at);
            return;
        }
        if second.is_some_and(|second| [first, second].iter().any(|it| is_top(it.site.at))) {
            return;
        }
        let kinds: &[(Option<Contact>, f64)] = match spot.found.region {
            Region::Trunk => &[
                (Some(Contact::Close), l.near_trunk),
                (None, l.medium_trunk),
                (Some(Contact::ArmExtended), l.far),
            ],
            Region::Face => &[
                (Some(Contact::Close), l.near_face),
                (None, l.medium_face),
                (Some(Contact::ArmExtended), l.far),
            ],
            Region::Arm(_) => &[(Some(Contact::Close), l.near_face)],
        };
        for &(contact, far) in kinds {
            let near = contact == Some(Contact::Close);
            let at = self.before(&spot, far * scene.arm, near, n, symmetric);
            let point = if near && !trunk { by_at } else { palm };
            let away = (point - at) * DVec3::new(1.0, 1.0, DEPTH);
            add(contact, away.length(), None, by_at);
        }
    }

    /// Returns where a hand is that is so far before a place.
    fn before(&self, spot: &Spot, far: f64, near: bool, n: usize, symmetric: bool) -> DVec3 {
        let scene = self.scene;
        let beside = spot.found.beside;
        let lateral = spot.found.lateral;
        let apart = if symmetric && lateral == 0.0 {
            let own = if n == 0 { -1.0 } else { 1.0 };
            own * scene.language.hands_apart * scene.shoulders
        } else {
            0.0
        };
        if spot.found.region == Region::Trunk {
            let far = far * if beside { 0.5 } else { 1.0 };
            return DVec3::new(
                lateral * scene.shoulders + apart,
                spot.at.y,
                0.33 * scene.shoulders + far,
            );
        }
        let aside = if near || beside {
            0.0
        } else {
            0.5 * lateral * scene.shoulders
        };
        spot.at + spot.out * far + DVec3::X * (aside + apart)
    }

    /// Returns where the parts of a hand are that touch the body or the other hand.
    pub(super) fn touching(&self, n: usize) -> Vec<DVec3> {
        let mut found = Vec::new();
        if let Some(together) = self.together()
            && together.contact == Contact::Touch
        {
            let at = self.points[n]
                .iter()
                .find(|(point, _)| *point == together.parts[n]);
            found.extend(at.map(|(_, at)| *at));
        }
        if let Some(placed) = self.place(n, false)
            && placed.place.contact == Some(Contact::Touch)
        {
            found.extend(placed.by);
        }
        found
    }

    /// Returns how the two hands are by each other: the parts nearest to each other, their contact and
    /// their distance in metres; nothing where they are apart.
    pub(super) fn together(&self) -> Option<Together> {
        let mut best: Option<Together> = None;
        let mut least = f64::MAX;
        for &(own, a) in &self.points[0] {
            for &(other, b) in &self.points[1] {
                let distance = a.distance(b);
                // Whole faces of the hand are sooner meant than what lies within them.
                let score = distance + RANK * (rank(own) + rank(other));
                if score < least {
                    least = score;
                    best = Some(Together {
                        parts: [own, other],
                        distance,
                        middle: (a + b) / 2.0,
                        contact: Contact::Close,
                    });
                }
            }
        }
        let mut best = best.filter(|best| best.distance < TOGETHER * self.scene.arm)?;
        if best.distance < TOUCH[2] * self.scene.arm {
            best.contact = Contact::Touch;
        }
        Some(best)
    }

    /// Returns the place nearest to a point that both hands share.
    pub(super) fn shared(&self, at: DVec3) -> Option<Placed> {
        let mut both = Body {
            scene: self.scene,
            axes: self.axes,
            spots: Vec::new(),
            points: [vec![(HandPoint::Palm, at)], Vec::new()],
            palms: [Some(at), None],
        };
        both.spots.clone_from(&self.spots);
        let mut placed = both.place(0, false)?;
        placed.place.by = None;
        Some(placed)
    }

    /// Returns points of a hand's outline.
    fn hand_points(&self, model: &ModelPose, side: Half) -> Vec<(HandPoint, DVec3)> {
        let (anatomy, skeleton) = (self.scene.anatomy, self.scene.clip.skeleton());
        let hand = self.scene.hand;
        let mut points = Vec::new();
        let mut add = |point: HandPoint, at: Option<DVec3>| {
            if let Some(at) = at {
                points.push((point, self.axes.place(at)));
            }
        };
        let landmark =
            |name: &str| anatomy.landmark(skeleton, model, &format!("{}-{name}", side.name()));
        add(HandPoint::Palm, landmark("palm"));
        add(HandPoint::Back, landmark("hand-back"));
        add(HandPoint::Radial, landmark("hand-radial"));
        add(HandPoint::Ulnar, landmark("hand-ulnar"));
        let (Some(along), Some(normal)) = (
            anatomy.hand_direction(side, model),
            anatomy.palm_normal(side, model),
        ) else {
            return points;
        };
        let wrist = landmark("wrist");
        let radial = normal.cross(along) * -side.sign();
        let face = |face: Face, bone: DVec3| match face {
            Face::Middle => DVec3::ZERO,
            Face::Palmar | Face::Dorsal => {
                let out = along.cross(normal).cross(bone).normalize_or(normal);
                if face == Face::Palmar { out } else { -out }
            }
            Face::Radial => radial,
            Face::Ulnar => -radial,
        };
        for side in [Face::Palmar, Face::Dorsal] {
            add(
                HandPoint::Wrist(side),
                wrist.map(|at| at + face(side, along) * (0.14 * hand)),
            );
        }
        for digit in Digit::ALL {
            let name = match digit {
                Digit::Thumb => "thumb-tip",
                Digit::Index => "index-tip",
                Digit::Middle => "middle-tip",
                Digit::Ring => "ring-tip",
                Digit::Little => "little-tip",
            };
            let joint = |n: u8| {
                anatomy
                    .joint(part(side, digit, n))
                    .map(|j| model.position(j))
            };
            let (tip, middle, base) = (landmark(name), joint(2), joint(1));
            let last = joint(3).or(middle);
            let bone = tip
                .zip(last)
                .map(|(tip, last)| (tip - last).normalize_or(along));
            let bone = bone.unwrap_or(along);
            add(HandPoint::Tip(digit, Face::Middle), tip);
            for side in [Face::Palmar, Face::Dorsal] {
                let out = face(side, bone);
                add(
                    HandPoint::Tip(digit, side),
                    tip.map(|tip| tip + (out * 0.042 - bone * 0.03) * hand),
                );
                add(
                    HandPoint::Middle(digit, side),
                    middle.map(|at| at + out * (0.042 * hand)),
                );
                add(
                    HandPoint::Base(digit, side),
                    base.map(|at| at + face(side, along) * (0.06 * hand)),
                );
            }
            add(
                HandPoint::Middle(digit, Face::Radial),
                middle.map(|at| at + radial * (0.042 * hand)),
            );
        }
        points
    }
}

/// The two hands by each other.
#[derive(Debug, Clone)]
pub(super) struct Together {
    /// The part of the dominant hand and of the other.
    pub(super) parts: [HandPoint; 2],
    pub(super) distance: f64,
    /// Half-way between them.
    pub(super) middle: DVec3,
    pub(super) contact: Contact,
}

fn part(side: Half, digit: Digit, joint: u8) -> Part {
    match digit {
        Digit::Thumb => Part::Thumb(side, joint - 1),
        Digit::Index => Part::Finger(side, Finger::Index, joint),
        Digit::Middle => Part::Finger(side, Finger::Middle, joint),
        Digit::Ring => Part::Finger(side, Finger::Ring, joint),
        Digit::Little => Part::Finger(side, Finger::Little, joint),
    }
}

/// Whether a place half-way between two can be meant.
fn neighbours(a: &Spot, b: &Spot) -> bool {
    let apart = a.at.distance(b.at);
    let opposite = a.found.lateral * b.found.lateral < 0.0;
    a.found.region == b.found.region
        && apart > 1e-3
        && apart < APART
        && !opposite
        && !matches!(a.found.region, Region::Arm(_))
}

/// Whether a place is one that hands touch: they are hardly half-way before it.
fn is_top(at: BodyLocation) -> bool {
    matches!(at, BodyLocation::ShoulderTop)
}

/// Whether a place is rarely meant: those beside it say as much.
fn is_rare(at: BodyLocation) -> bool {
    matches!(
        at,
        BodyLocation::Nostrils
            | BodyLocation::UpperLip
            | BodyLocation::LowerLip
            | BodyLocation::EarLobe
            | BodyLocation::Eyebrows
    )
}

fn middle(a: &Spot, b: &Spot) -> Spot {
    Spot {
        site: a.site,
        at: (a.at + b.at) / 2.0,
        out: (a.out + b.out).normalize_or(a.out),
        found: BodySite {
            lateral: (a.found.lateral + b.found.lateral) / 2.0,
            beside: a.found.beside && b.found.beside,
            ..a.found.clone()
        },
    }
}

/// Whether a part of the hand is one that touches the body.
fn touches(point: HandPoint) -> bool {
    !matches!(
        point,
        HandPoint::Base(..) | HandPoint::Elbow | HandPoint::Forearm | HandPoint::UpperArm
    )
}

/// The later, the less likely it is to be meant where another part is as near.
fn rank(point: HandPoint) -> f64 {
    match point {
        HandPoint::Palm | HandPoint::Tip(_, Face::Middle) => 0.0,
        HandPoint::Back | HandPoint::Radial | HandPoint::Ulnar => 0.5,
        HandPoint::Tip(..) | HandPoint::Wrist(_) => 1.0,
        _ => 1.5,
    }
}

/// Returns the site of a hand that is called by a point.
pub(super) fn named(point: HandPoint) -> HandSite {
    let side = |face: Face| match face {
        Face::Middle => None,
        Face::Palmar => Some(Side::Palmar),
        Face::Dorsal => Some(Side::Dorsal),
        Face::Radial => Some(Side::Radial),
        Face::Ulnar => Some(Side::Ulnar),
    };
    let site = |at: HandLocation, digit: Option<Digit>, side: Option<Side>| HandSite {
        at: Some(at),
        digits: Digits(digit.into_iter().collect()),
        side,
        ..HandSite::default()
    };
    match point {
        HandPoint::Palm => site(HandLocation::Palm, None, None),
        HandPoint::Back => site(HandLocation::HandBack, None, None),
        HandPoint::Radial => site(HandLocation::ThumbSide, None, None),
        HandPoint::Ulnar => site(HandLocation::PinkySide, None, None),
        HandPoint::ThumbBall => site(HandLocation::ThumbBall, None, None),
        HandPoint::Wrist(face) => site(
            HandLocation::WristBack,
            None,
            side(face).filter(|side| *side != Side::Dorsal),
        ),
        HandPoint::Tip(digit, Face::Palmar) => site(HandLocation::Pad, Some(digit), None),
        HandPoint::Tip(digit, Face::Dorsal) => site(HandLocation::Nail, Some(digit), None),
        HandPoint::Tip(digit, face) => site(HandLocation::Tip, Some(digit), side(face)),
        HandPoint::Middle(digit, face) => site(HandLocation::MidJoint, Some(digit), side(face)),
        HandPoint::Base(digit, face) => site(HandLocation::Base, Some(digit), side(face)),
        HandPoint::Elbow => site(HandLocation::Elbow, None, None),
        HandPoint::Forearm => site(HandLocation::LowerArm, None, None),
        HandPoint::UpperArm => site(HandLocation::UpperArm, None, None),
    }
}

impl Placed {
    /// Returns the place as a choice among places.
    pub(super) fn found(&self) -> Found<BodyPlace> {
        Found {
            best: self.place.clone(),
            residual: self.residual,
            runner_up: self.runner_up.clone(),
        }
    }
}
