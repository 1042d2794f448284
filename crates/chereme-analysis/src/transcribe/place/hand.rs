//! Points of a hand in one posture, and their names as sites.

use chereme_motion::{ModelPose, Side as Half};
use chereme_sign::hamnosys::sites::{
    Face, HandPoint, Region, coming_first, digit_joint, from_bone, on_palm,
};
use chereme_sign::hamnosys::{Digit, Digits, HandLocation, HandSite, Handshape, Side};
use glam::DVec3;

use super::super::scene::{Axes, Scene};
use crate::transcribe::tuned::tuned;

/// A point of a hand with its position and its outward normal.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spotted {
    pub(super) point: HandPoint,
    pub(super) at: DVec3,
    pub(super) out: DVec3,
}

/// A hand in one posture, in the signer's level axes (left, up, forward; metres).
#[derive(Clone)]
pub(super) struct Hand {
    pub(super) palm: DVec3,
    /// Unit vectors: along the hand, out of its palm, towards its thumb.
    axes: [DVec3; 3],
    shape: Handshape,
    pub(super) points: Vec<Spotted>,
    /// The parts that notation may name, single or of two digits together, with their positions and ranks.
    named: Vec<(DVec3, Vec<HandPoint>, f64)>,
    /// The expected distance between the hand and its goal, in metres.
    slack: f64,
    /// Distance of the palm before the wrist, in metres; negative behind it.
    pub(super) ahead: f64,
    /// Whether it is the point between two hands.
    pub(super) between: bool,
}

impl Hand {
    /// Reads hand `n` (0 is the dominant hand) in one frame; `shape` is its transcribed handshape.
    pub(super) fn of(
        scene: &Scene<'_>,
        axes: &Axes,
        model: &ModelPose,
        (n, frame): (usize, usize),
        shape: Option<&Handshape>,
    ) -> Option<Self> {
        let track = scene.hands[n].as_ref()?;
        let (along, normal) = (track.along[frame], track.normal[frame]);
        // The scene treats the dominant hand as a right one.
        let radial = along.cross(normal) * if n == 0 { 1.0 } else { -1.0 };
        let points = points(scene, axes, model, track.side);
        Some(Self {
            palm: track.palm[frame],
            axes: [along, normal, radial],
            shape: shape.cloned().unwrap_or_default(),
            named: nameable(&points),
            points,
            slack: scene.slack,
            ahead: (track.palm[frame] - track.wrist[frame]).z,
            between: false,
        })
    }

    /// Moves the hand by an offset, in metres.
    pub(super) fn shift(&mut self, by: DVec3) {
        self.palm += by;
        for spotted in &mut self.points {
            spotted.at += by;
        }
        for (at, ..) in &mut self.named {
            *at += by;
        }
    }

    /// Creates the point between two hands, this far before the wrist (m).
    pub(super) fn between(palm: DVec3, ahead: f64) -> Self {
        Self {
            palm,
            axes: [DVec3::Z, DVec3::NEG_Y, DVec3::X],
            shape: Handshape::default(),
            points: Vec::new(),
            named: Vec::new(),
            slack: 0.0,
            ahead,
            between: true,
        }
    }

    /// Returns the middle of the palm.
    pub(super) fn middle(&self) -> Spotted {
        Spotted {
            point: HandPoint::Palm,
            at: self.palm,
            out: self.axes[1],
        }
    }

    /// Returns the point that notation refers to if it names none, for a place with the outward normal
    /// `out`.
    pub(super) fn meant(&self, out: DVec3, region: Region) -> Spotted {
        if self.points.is_empty() {
            return self.middle();
        }
        let direction = self.axes.map(|axis| -out.dot(axis));
        let point = coming_first(&self.shape, direction, region);
        let at = self.points.iter().find(|other| other.point == point);
        at.copied().unwrap_or_else(|| self.middle())
    }

    /// Returns the nameable part nearest to a place: its position, its points and its rank. A part of a
    /// higher [`rank`] must be nearer. An offset along `pushed`, the direction in which the trunk pushes
    /// hands out, counts less.
    pub(super) fn nearest(
        &self,
        to: DVec3,
        pushed: Option<DVec3>,
    ) -> Option<(DVec3, &[HandPoint], f64)> {
        let off = |(at, _, steps): &&(DVec3, Vec<HandPoint>, f64)| {
            let off = *at - to;
            let before = pushed.map_or(DVec3::ZERO, |direction| {
                direction * off.dot(direction).max(0.0)
            });
            (off - before * tuned().part.before).length() + tuned().part.rank * self.slack * steps
        };
        let nearest = self.named.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
        nearest.map(|(at, parts, steps)| (*at, parts.as_slice(), *steps))
    }

    /// Returns the parts that notation may name: positions, points and ranks.
    pub(super) fn nameable(&self) -> &[(DVec3, Vec<HandPoint>, f64)] {
        &self.named
    }

    /// Returns the mean position of several points.
    pub(super) fn mean(&self, points: &[HandPoint]) -> DVec3 {
        let known: Vec<DVec3> = self
            .points
            .iter()
            .filter(|spotted| points.contains(&spotted.point))
            .map(|spotted| spotted.at)
            .collect();
        match known.len() {
            0 => self.palm,
            count => known.iter().sum::<DVec3>() / count as f64,
        }
    }
}

/// Returns the parts of a hand that notation names, tips and pads of two digits together included.
fn nameable(points: &[Spotted]) -> Vec<(DVec3, Vec<HandPoint>, f64)> {
    let mut all: Vec<_> = points
        .iter()
        .map(|it| (it.at, vec![it.point], rank(it.point)))
        .collect();
    let at = |point: HandPoint| Some(points.iter().find(|it| it.point == point)?.at);
    for face in [Face::Middle, Face::Palmar] {
        let pairs = [
            [Digit::Thumb, Digit::Index],
            [Digit::Thumb, Digit::Middle],
            [Digit::Index, Digit::Middle],
        ];
        for pair in pairs {
            let both = pair.map(|digit| HandPoint::Tip(digit, face));
            if let [Some(a), Some(b)] = both.map(at)
                && a.distance(b) < tuned().part.pinched
            {
                all.push((a.midpoint(b), both.to_vec(), tuned().part.two));
            }
        }
    }
    all
}

/// Returns points on the outline of a hand.
fn points(scene: &Scene<'_>, axes: &Axes, model: &ModelPose, side: Half) -> Vec<Spotted> {
    const FACES: [Face; 5] = [
        Face::Middle,
        Face::Palmar,
        Face::Dorsal,
        Face::Radial,
        Face::Ulnar,
    ];
    let (anatomy, skeleton) = (scene.anatomy, scene.clip.skeleton());
    let mut points = Vec::new();
    let (Some(along), Some(normal)) = (
        anatomy.hand_direction(side, model),
        anatomy.palm_normal(side, model),
    ) else {
        return points;
    };
    let landmark =
        |name: &str| anatomy.landmark(skeleton, model, &format!("{}-{name}", side.name()));
    let radial = normal.cross(along) * side.sign();
    let mut add = |point: HandPoint, at: Option<DVec3>, out: DVec3| {
        points.extend(at.map(|at| Spotted {
            point,
            at: axes.place(at),
            out: axes.direction(out),
        }));
    };
    let (wrist, palm) = (landmark("wrist"), landmark("palm"));
    add(HandPoint::Palm, palm, normal);
    add(HandPoint::Back, landmark("hand-back"), -normal);
    add(HandPoint::Radial, landmark("hand-radial"), radial);
    add(HandPoint::Ulnar, landmark("hand-ulnar"), -radial);
    let (Some(wrist), Some(palm)) = (wrist, palm) else {
        return points;
    };
    // The distance from the wrist to the middle knuckle.
    let knuckle = (palm - wrist).dot(along) / on_palm(HandPoint::Palm)[0];
    let [up, out, aside] = on_palm(HandPoint::ThumbBall);
    let ball = wrist + along * (up * knuckle) + (normal * out + radial * aside) * scene.hand;
    add(HandPoint::ThumbBall, Some(ball), normal);
    let mut about = |point: HandPoint, face: Face, from: Option<DVec3>, bone: DVec3| {
        let [out, back] = from_bone(point);
        let direction = facing(face, [along, normal, radial], bone);
        let at = from.map(|from| from + (direction * out - bone * back) * scene.hand);
        let out = match (face, point) {
            (Face::Middle, HandPoint::Tip(..)) => bone,
            (Face::Middle, _) => -normal,
            _ => direction,
        };
        add(point, at, out);
    };
    for face in [Face::Palmar, Face::Dorsal, Face::Radial, Face::Ulnar] {
        about(HandPoint::Wrist(face), face, Some(wrist), along);
    }
    for digit in Digit::ALL {
        let name = match digit {
            Digit::Thumb => "thumb-tip",
            Digit::Index => "index-tip",
            Digit::Middle => "middle-tip",
            Digit::Ring => "ring-tip",
            Digit::Little => "little-tip",
        };
        let joint = |which: u8| {
            let joint = anatomy.joint(digit_joint(side, digit, which));
            joint.map(|joint| model.position(joint))
        };
        let (tip, middle, base) = (landmark(name), joint(2), joint(1));
        let bone = tip
            .zip(middle)
            .map_or(along, |(tip, middle)| (tip - middle).normalize_or(along));
        for face in FACES {
            about(HandPoint::Tip(digit, face), face, tip, bone);
            about(HandPoint::Middle(digit, face), face, middle, bone);
        }
        for face in [Face::Palmar, Face::Dorsal] {
            about(HandPoint::Base(digit, face), face, base, along);
        }
    }
    points
}

/// Returns the outward normal of a face of the hand, or of a digit whose bone points along `bone`.
fn facing(face: Face, [along, normal, radial]: [DVec3; 3], bone: DVec3) -> DVec3 {
    let out = along.cross(normal).cross(bone).normalize_or(normal);
    match face {
        Face::Middle => DVec3::ZERO,
        Face::Palmar => out,
        Face::Dorsal => -out,
        Face::Radial => radial,
        Face::Ulnar => -radial,
    }
}

/// Returns the rank of a hand point: higher ones are less often named if another point is equally near.
/// Tips of the first fingers and whole faces of the hand are named most, the pad of the thumb hardly.
pub(super) fn rank(point: HandPoint) -> f64 {
    let digit = |digit: Digit| match digit {
        Digit::Thumb | Digit::Index | Digit::Middle => 0.0,
        Digit::Ring | Digit::Little => 1.0,
    };
    match point {
        HandPoint::Palm | HandPoint::Radial => 0.0,
        HandPoint::Tip(of, Face::Middle) => digit(of),
        HandPoint::Back | HandPoint::Ulnar => 0.5,
        HandPoint::Tip(Digit::Thumb, Face::Palmar) => 1.0,
        HandPoint::Tip(of, Face::Palmar | Face::Dorsal) => 0.5 + digit(of),
        HandPoint::Tip(of, _) => 1.0 + digit(of),
        HandPoint::Wrist(_) | HandPoint::ThumbBall => 2.5,
        HandPoint::Middle(Digit::Index | Digit::Middle, Face::Middle) => 0.7,
        HandPoint::Middle(of, _) => 1.2 + digit(of),
        HandPoint::Base(Digit::Thumb, _) => 2.5,
        HandPoint::Base(of, _) => 1.5 + digit(of),
        _ => 3.0,
    }
}

/// Returns the site that names a point, or the same point of several digits.
pub(super) fn named_all(points: &[HandPoint]) -> HandSite {
    let mut sites = points.iter().map(|point| named(*point));
    let mut first = sites.next().unwrap_or_default();
    for other in sites {
        first.digits.0.extend(other.digits.0);
    }
    first
}

/// Returns the site that names a point.
pub(in crate::transcribe) fn named(point: HandPoint) -> HandSite {
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
