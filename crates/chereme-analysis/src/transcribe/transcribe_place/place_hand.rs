//! Points of a hand in one posture, and their names as sites.

use chereme_motion::{BodySide as Half, ModelPose};
use chereme_sign::hamnosys::sites::{
    BodyRegion, DigitFace, NotatedHandPoint, coming_first, digit_joint, from_bone, on_palm,
};
use chereme_sign::hamnosys::{DigitList, HandDigit, HandLocation, HandSite, Handshape, LocationSide};
use glam::DVec3;

use super::super::transcribe_scene::{LevelSignerAxes, SignerScene};
use crate::transcribe::transcribe_tuned::tuned;

/// A point of a hand with its position and its outward normal.
#[derive(Debug, Clone, Copy)]
pub(super) struct HandSpot {
    pub(super) point: NotatedHandPoint,
    pub(super) at: DVec3,
    pub(super) out: DVec3,
}

/// A hand in one posture, in the signer's level axes (left, up, forward; metres).
#[derive(Clone)]
pub(super) struct PosedHand {
    pub(super) palm: DVec3,
    /// Unit vectors: along the hand, out of its palm, towards its thumb.
    axes: [DVec3; 3],
    shape: Handshape,
    pub(super) points: Vec<HandSpot>,
    /// The parts that notation may name, single or of two digits together, with their positions and ranks.
    named: Vec<(DVec3, Vec<NotatedHandPoint>, f64)>,
    /// The expected distance between the hand and its goal, in metres.
    slack: f64,
    /// Distance of the palm before the wrist, in metres; negative behind it.
    pub(super) ahead: f64,
    /// Whether it is the point between two hands.
    pub(super) between: bool,
}

impl PosedHand {
    /// Reads hand `n` (0 is the dominant hand) in one frame; `shape` is its transcribed handshape.
    pub(super) fn read_posed_hand(
        scene: &SignerScene<'_>,
        axes: &LevelSignerAxes,
        model: &ModelPose,
        n: usize,
        frame: usize,
        shape: Option<&Handshape>,
    ) -> Option<Self> {
        let track = scene.hands[n].as_ref()?;
        let (along, normal) = (track.along[frame], track.normal[frame]);
        // The scene treats the dominant hand as a right one.
        let radial = along.cross(normal) * if n == 0 { 1.0 } else { -1.0 };
        let points = hand_outline_points(scene, axes, model, track.side);
        Some(Self {
            palm: track.palm[frame],
            axes: [along, normal, radial],
            shape: shape.cloned().unwrap_or_default(),
            named: collect_nameable_parts(&points),
            points,
            slack: scene.slack,
            ahead: (track.palm[frame] - track.wrist[frame]).z,
            between: false,
        })
    }

    /// Moves the hand by an offset, in metres.
    pub(super) fn shift_posed_hand(&mut self, by: DVec3) {
        self.palm += by;
        for spotted in &mut self.points {
            spotted.at += by;
        }
        for (at, ..) in &mut self.named {
            *at += by;
        }
    }

    /// Creates the point between two hands, this far before the wrist (m).
    pub(super) fn spot_between_hands(palm: DVec3, ahead: f64) -> Self {
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
    pub(super) fn palm_middle_spot(&self) -> HandSpot {
        HandSpot {
            point: NotatedHandPoint::Palm,
            at: self.palm,
            out: self.axes[1],
        }
    }

    /// Returns the point that notation refers to if it names none, for a place with the outward normal
    /// `out`.
    pub(super) fn meant_hand_spot(&self, out: DVec3, region: BodyRegion) -> HandSpot {
        if self.points.is_empty() {
            return self.palm_middle_spot();
        }
        let direction = self.axes.map(|axis| -out.dot(axis));
        let point = coming_first(&self.shape, direction, region);
        let matching_point = self.points.iter().find(|other| other.point == point);
        matching_point.copied().unwrap_or_else(|| self.palm_middle_spot())
    }

    /// Returns the nameable part nearest to a place: its position, its points and its rank. A part of a
    /// higher [`rank`] must be nearer. An offset along `pushed`, the direction in which the trunk pushes
    /// hands out, counts less.
    pub(super) fn nearest_nameable_part(
        &self,
        to: DVec3,
        pushed: Option<DVec3>,
    ) -> Option<(DVec3, &[NotatedHandPoint], f64)> {
        let off = |(at, _, steps): &&(DVec3, Vec<NotatedHandPoint>, f64)| {
            let off = *at - to;
            let before = pushed.map_or(DVec3::ZERO, |direction| direction * off.dot(direction).max(0.0));
            (off - before * tuned().part.before).length() + tuned().part.rank * self.slack * steps
        };
        let nearest = self.named.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
        nearest.map(|(at, parts, steps)| (*at, parts.as_slice(), *steps))
    }

    /// Returns the parts that notation may name: positions, points and ranks.
    pub(super) fn nameable_hand_parts(&self) -> &[(DVec3, Vec<NotatedHandPoint>, f64)] {
        &self.named
    }

    /// Returns the mean position of several points.
    pub(super) fn mean_point_position(&self, points: &[NotatedHandPoint]) -> DVec3 {
        let known_points: Vec<DVec3> = self
            .points
            .iter()
            .filter(|spotted| points.contains(&spotted.point))
            .map(|spotted| spotted.at)
            .collect();
        match known_points.len() {
            0 => self.palm,
            count => known_points.iter().sum::<DVec3>() / count as f64,
        }
    }
}

/// Returns the parts of a hand that notation names, tips and pads of two digits together included.
fn collect_nameable_parts(points: &[HandSpot]) -> Vec<(DVec3, Vec<NotatedHandPoint>, f64)> {
    let mut all: Vec<_> = points
        .iter()
        .map(|spot| (spot.at, vec![spot.point], hand_point_rank(spot.point)))
        .collect();
    let point_position = |point: NotatedHandPoint| Some(points.iter().find(|spot| spot.point == point)?.at);
    for face in [DigitFace::Middle, DigitFace::Palmar] {
        let pairs = [
            [HandDigit::Thumb, HandDigit::Index],
            [HandDigit::Thumb, HandDigit::Middle],
            [HandDigit::Index, HandDigit::Middle],
        ];
        for pair in pairs {
            let both = pair.map(|digit| NotatedHandPoint::Tip(digit, face));
            if let [Some(a), Some(b)] = both.map(point_position)
                && a.distance(b) < tuned().part.pinched
            {
                all.push((a.midpoint(b), both.to_vec(), tuned().part.two));
            }
        }
    }
    all
}

/// Returns points on the outline of a hand.
fn hand_outline_points(
    scene: &SignerScene<'_>,
    axes: &LevelSignerAxes,
    model: &ModelPose,
    side: Half,
) -> Vec<HandSpot> {
    const OUTLINE_FACES: [DigitFace; 5] = [
        DigitFace::Middle,
        DigitFace::Palmar,
        DigitFace::Dorsal,
        DigitFace::Radial,
        DigitFace::Ulnar,
    ];
    let (anatomy, skeleton) = (scene.anatomy, scene.clip.clip_skeleton());
    let mut points = Vec::new();
    let (Some(along), Some(normal)) = (anatomy.hand_direction(side, model), anatomy.palm_normal(side, model)) else {
        return points;
    };
    let landmark =
        |name: &str| anatomy.landmark_place_position(skeleton, model, &format!("{}-{name}", side.body_side_name()));
    let radial = normal.cross(along) * side.side_sign();
    let mut add = |point: NotatedHandPoint, at: Option<DVec3>, out: DVec3| {
        points.extend(at.map(|at| HandSpot {
            point,
            at: axes.signer_place_of(at),
            out: axes.signer_direction_of(out),
        }));
    };
    let (wrist, palm) = (landmark("wrist"), landmark("palm"));
    add(NotatedHandPoint::Palm, palm, normal);
    add(NotatedHandPoint::Back, landmark("hand-back"), -normal);
    add(NotatedHandPoint::Radial, landmark("hand-radial"), radial);
    add(NotatedHandPoint::Ulnar, landmark("hand-ulnar"), -radial);
    let (Some(wrist), Some(palm)) = (wrist, palm) else {
        return points;
    };
    // The distance from the wrist to the middle knuckle.
    let knuckle = (palm - wrist).dot(along) / on_palm(NotatedHandPoint::Palm)[0];
    let [up, out, aside] = on_palm(NotatedHandPoint::ThumbBall);
    let ball = wrist + along * (up * knuckle) + (normal * out + radial * aside) * scene.hand;
    add(NotatedHandPoint::ThumbBall, Some(ball), normal);
    let mut about = |point: NotatedHandPoint, face: DigitFace, from: Option<DVec3>, bone: DVec3| {
        let [out, back] = from_bone(point);
        let direction = face_outward_normal(face, [along, normal, radial], bone);
        let shifted_point = from.map(|from| from + (direction * out - bone * back) * scene.hand);
        let out = match (face, point) {
            (DigitFace::Middle, NotatedHandPoint::Tip(..)) => bone,
            (DigitFace::Middle, _) => -normal,
            _ => direction,
        };
        add(point, shifted_point, out);
    };
    for face in [
        DigitFace::Palmar,
        DigitFace::Dorsal,
        DigitFace::Radial,
        DigitFace::Ulnar,
    ] {
        about(NotatedHandPoint::Wrist(face), face, Some(wrist), along);
    }
    for digit in HandDigit::ALL_HAND_DIGITS {
        let name = match digit {
            HandDigit::Thumb => "thumb-tip",
            HandDigit::Index => "index-tip",
            HandDigit::Middle => "middle-tip",
            HandDigit::Ring => "ring-tip",
            HandDigit::Little => "little-tip",
        };
        let joint = |which: u8| {
            let joint = anatomy.part_joint(digit_joint(side, digit, which));
            joint.map(|joint| model.model_joint_position(joint))
        };
        let (tip, middle, base) = (landmark(name), joint(2), joint(1));
        let bone = tip
            .zip(middle)
            .map_or(along, |(tip, middle)| (tip - middle).normalize_or(along));
        for face in OUTLINE_FACES {
            about(NotatedHandPoint::Tip(digit, face), face, tip, bone);
            about(NotatedHandPoint::Middle(digit, face), face, middle, bone);
        }
        for face in [DigitFace::Palmar, DigitFace::Dorsal] {
            about(NotatedHandPoint::Base(digit, face), face, base, along);
        }
    }
    points
}

/// Returns the outward normal of a face of the hand, or of a digit whose bone points along `bone`.
fn face_outward_normal(face: DigitFace, [along, normal, radial]: [DVec3; 3], bone: DVec3) -> DVec3 {
    let out = along.cross(normal).cross(bone).normalize_or(normal);
    match face {
        DigitFace::Middle => DVec3::ZERO,
        DigitFace::Palmar => out,
        DigitFace::Dorsal => -out,
        DigitFace::Radial => radial,
        DigitFace::Ulnar => -radial,
    }
}

/// Returns the rank of a hand point: higher ones are less often named if another point is equally near.
/// Tips of the first fingers and whole faces of the hand are named most, the pad of the thumb hardly.
pub(super) fn hand_point_rank(point: NotatedHandPoint) -> f64 {
    let digit = |digit: HandDigit| match digit {
        HandDigit::Thumb | HandDigit::Index | HandDigit::Middle => 0.0,
        HandDigit::Ring | HandDigit::Little => 1.0,
    };
    match point {
        NotatedHandPoint::Palm | NotatedHandPoint::Radial => 0.0,
        NotatedHandPoint::Tip(of, DigitFace::Middle) => digit(of),
        NotatedHandPoint::Back | NotatedHandPoint::Ulnar => 0.5,
        NotatedHandPoint::Tip(HandDigit::Thumb, DigitFace::Palmar) => 1.0,
        NotatedHandPoint::Tip(of, DigitFace::Palmar | DigitFace::Dorsal) => 0.5 + digit(of),
        NotatedHandPoint::Tip(of, _) => 1.0 + digit(of),
        NotatedHandPoint::Wrist(_) | NotatedHandPoint::ThumbBall => 2.5,
        NotatedHandPoint::Middle(HandDigit::Index | HandDigit::Middle, DigitFace::Middle) => 0.7,
        NotatedHandPoint::Middle(of, _) => 1.2 + digit(of),
        NotatedHandPoint::Base(HandDigit::Thumb, _) => 2.5,
        NotatedHandPoint::Base(of, _) => 1.5 + digit(of),
        _ => 3.0,
    }
}

/// Returns the site that names a point, or the same point of several digits.
pub(super) fn named_all(points: &[NotatedHandPoint]) -> HandSite {
    let mut sites = points.iter().map(|point| hand_point_site(*point));
    let mut first = sites.next().unwrap_or_default();
    for other in sites {
        first.digits.0.extend(other.digits.0);
    }
    first
}

/// Returns the site that names a point.
pub(in crate::transcribe) fn hand_point_site(point: NotatedHandPoint) -> HandSite {
    let side = |face: DigitFace| match face {
        DigitFace::Middle => None,
        DigitFace::Palmar => Some(LocationSide::Palmar),
        DigitFace::Dorsal => Some(LocationSide::Dorsal),
        DigitFace::Radial => Some(LocationSide::Radial),
        DigitFace::Ulnar => Some(LocationSide::Ulnar),
    };
    let site = |at: HandLocation, digit: Option<HandDigit>, side: Option<LocationSide>| HandSite {
        at: Some(at),
        digits: DigitList(digit.into_iter().collect()),
        side,
        ..HandSite::default()
    };
    match point {
        NotatedHandPoint::Palm => site(HandLocation::Palm, None, None),
        NotatedHandPoint::Back => site(HandLocation::HandBack, None, None),
        NotatedHandPoint::Radial => site(HandLocation::ThumbSide, None, None),
        NotatedHandPoint::Ulnar => site(HandLocation::PinkySide, None, None),
        NotatedHandPoint::ThumbBall => site(HandLocation::ThumbBall, None, None),
        NotatedHandPoint::Wrist(face) => site(
            HandLocation::WristBack,
            None,
            side(face).filter(|side| *side != LocationSide::Dorsal),
        ),
        NotatedHandPoint::Tip(digit, DigitFace::Palmar) => site(HandLocation::Pad, Some(digit), None),
        NotatedHandPoint::Tip(digit, DigitFace::Dorsal) => site(HandLocation::Nail, Some(digit), None),
        NotatedHandPoint::Tip(digit, face) => site(HandLocation::Tip, Some(digit), side(face)),
        NotatedHandPoint::Middle(digit, face) => site(HandLocation::MidJoint, Some(digit), side(face)),
        NotatedHandPoint::Base(digit, face) => site(HandLocation::Base, Some(digit), side(face)),
        NotatedHandPoint::Elbow => site(HandLocation::Elbow, None, None),
        NotatedHandPoint::Forearm => site(HandLocation::LowerArm, None, None),
        NotatedHandPoint::UpperArm => site(HandLocation::UpperArm, None, None),
    }
}
