//! Reads handshape, palm, fingers and place in some frames of a recording, and compares them with the truth.

use std::path::Path;

use chereme_corpus::{CorpusAddress, DisplayedMovement, RowName};
use chereme_motion::glam::DVec3;
use chereme_motion::{BodyAnatomy, BodyPart, BodySide, Clip, HandAngles, HandCorrection, HandFinger};
use chereme_sign::hamnosys::SpatialDirection;
use chereme_sign::inventory;

use crate::Result;

/// The hand that is read.
pub(crate) const SIDE: BodySide = BodySide::Right;

/// A direction near the limit between two is right within this angle (rad).
const LIMIT: f64 = 0.09;

/// Places that the table distinguishes.
const PLACES: [&str; 12] = [
    "forehead",
    "nose",
    "mouth",
    "chin",
    "throat",
    "chest",
    "belly",
    "right-shoulder",
    "left-shoulder",
    "right-ear",
    "neutral-space",
    "right-hip",
];

/// The readings of one frame.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Reading {
    pub(crate) shape: String,
    /// The nearest direction, and the vector itself.
    palm: (String, DVec3),
    fingers: (String, DVec3),
    place: &'static str,
    /// The position of the palm's middle, in shoulder widths of the body.
    at: DVec3,
    angles: HandAngles,
    known: [bool; HandAngles::HAND_ANGLE_COUNT],
}

/// A recording as the corpus has it.
pub(crate) struct Imported {
    pub(crate) moving: DisplayedMovement,
    /// The correction of the right hand's angles that its take shows.
    correction: HandCorrection,
}

/// Imports a file and returns its movement as the corpus has it.
pub(crate) fn import(folder: &Path, name: &str, file: &Path) -> Result<Imported> {
    let corpus = crate::corpus_of(folder, name, file)?;
    let [correction, _] = corpus.hand_corrections(&RowName::Number(1))?;
    Ok(Imported {
        moving: corpus.movement_at_address(&CorpusAddress::Recording(RowName::Number(1)))?,
        correction,
    })
}

/// Returns the handshapes of the inventory that differ in their posture, with the first name of each.
pub(crate) fn shapes() -> Vec<(String, HandAngles)> {
    let mut shapes: Vec<(String, HandAngles)> = Vec::new();
    let all = inventory::builtin_inventories()
        .iter()
        .find(|it| it.id == "configurations");
    for value in all.map(|it| it.values.as_slice()).unwrap_or_default() {
        if let Some(pose) = value.pose
            && shapes.iter().all(|(_, known)| distance(known, &pose) > 0.05)
        {
            shapes.push((value.id.clone(), pose));
        }
    }
    shapes
}

/// Returns the distance of two postures: the root mean square difference of all angles, in radians.
fn distance(a: &HandAngles, b: &HandAngles) -> f64 {
    known_distance(a, b, &[true; HandAngles::HAND_ANGLE_COUNT])
}

/// Returns the same distance over the angles that a skeleton shows.
pub(crate) fn known_distance(a: &HandAngles, b: &HandAngles, known: &[bool; HandAngles::HAND_ANGLE_COUNT]) -> f64 {
    let pairs = a.to_array().into_iter().zip(b.to_array());
    let known = pairs.zip(known).filter(|(_, known)| **known);
    let squares: Vec<f64> = known.map(|((a, b), _)| (a - b).powi(2)).collect();
    (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
}

/// Returns which angles the joints of a skeleton show.
pub(crate) fn known(anatomy: &BodyAnatomy, side: BodySide) -> [bool; HandAngles::HAND_ANGLE_COUNT] {
    let has = |part| anatomy.part_joint(part).is_some();
    std::array::from_fn(|n| match n {
        0..=2 => has(BodyPart::Thumb(side, 0)),
        3 | 4 => has(BodyPart::Thumb(side, n as u8 - 2)),
        _ => {
            let finger = HandFinger::ALL_FINGERS[(n - 5) / 4];
            has(BodyPart::Finger(side, finger, ((n - 5) % 4).max(1) as u8))
        }
    })
}

/// Reads frames of a clip, with or without the correction from its take.
pub(crate) fn readings(from: &Imported, clip: &Clip, frames: &[usize], corrected: bool) -> Result<Vec<Reading>> {
    let shapes = shapes();
    let anatomy = &from.moving.anatomy;
    let known = known(anatomy, SIDE);
    let read = |frame: usize| {
        let pose = clip.clip_pose_at(frame);
        let model = clip.model_pose(frame);
        let skeleton = clip.clip_skeleton();
        let body = anatomy.body_frame(&model)?;
        let mut angles = anatomy.hand_angles(skeleton, SIDE, &pose)?;
        if corrected {
            angles = from.correction.correct_hand_angles(&angles);
        }
        let near = |shape: &&(String, HandAngles)| known_distance(&shape.1, &angles, &known);
        let shape = shapes.iter().min_by(|a, b| near(a).total_cmp(&near(b)))?;
        let to_body = |direction: DVec3| {
            let own = body.direction_to_body(direction);
            (nearest(own), own)
        };
        let palm = anatomy.landmark_place_position(skeleton, &model, "right-palm")?;
        let far = |name: &&str| {
            let at = anatomy.landmark_place_position(skeleton, &model, name);
            at.map_or(f64::MAX, |at| at.distance(palm))
        };
        Some(Reading {
            shape: shape.0.clone(),
            palm: to_body(anatomy.palm_normal(SIDE, &model)?),
            fingers: to_body(anatomy.hand_direction(SIDE, &model)?),
            place: PLACES.iter().min_by(|a, b| far(a).total_cmp(&far(b)))?,
            at: body.to_body(palm),
            angles,
            known,
        })
    };
    let found: Option<Vec<Reading>> = frames.iter().map(|&frame| read(frame)).collect();
    found.ok_or_else(|| "the hand or the trunk is not found".into())
}

/// Names the nearest of the 26 directions.
fn nearest(target: DVec3) -> String {
    let near = |direction: &SpatialDirection| DVec3::from(direction.spatial_direction_vector()).dot(target);
    let found = SpatialDirection::all_spatial_directions().max_by(|a, b| near(a).total_cmp(&near(b)));
    found.map(|it| it.to_string()).unwrap_or_default()
}

/// The number of correct readings.
pub(crate) struct Score {
    all: usize,
    shape: usize,
    palm: usize,
    fingers: usize,
    place: usize,
    /// The largest distance of hand postures, in radians, and of places, in shoulder widths.
    off: f64,
    first: Option<String>,
}

/// Compares the readings with the truth. A direction or place near the limit between two is right within a
/// few degrees or centimetres of the truth.
pub(crate) fn compare(truth: &[Reading], found: &[Reading]) -> Score {
    let near = |a: DVec3, b: DVec3| a.angle_between(b) < LIMIT;
    let mut score = Score {
        all: truth.len(),
        shape: 0,
        palm: 0,
        fingers: 0,
        place: 0,
        off: 0.0,
        first: None,
    };
    for (want, is) in truth.iter().zip(found) {
        score.shape += usize::from(want.shape == is.shape);
        score.palm += usize::from(want.palm.0 == is.palm.0 || near(want.palm.1, is.palm.1));
        score.fingers += usize::from(want.fingers.0 == is.fingers.0 || near(want.fingers.1, is.fingers.1));
        score.place += usize::from(want.place == is.place || want.at.distance(is.at) < 0.1);
        let off = known_distance(&want.angles, &is.angles, &is.known);
        score.off = score.off.max(off);
        if want.shape != is.shape && score.first.is_none() {
            let mut far: Vec<(usize, f64)> = want
                .angles
                .to_array()
                .into_iter()
                .zip(is.angles.to_array())
                .map(|(a, b)| (b - a).to_degrees())
                .enumerate()
                .filter(|(n, _)| is.known[*n])
                .collect();
            far.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
            let far: Vec<String> = far[..3].iter().map(|(n, by)| format!("{n}:{by:.0}°")).collect();
            score.first = Some(format!("{} as {} ({})", want.shape, is.shape, far.join(" ")));
        }
    }
    score
}

/// The head of the table.
pub(crate) const HEAD: &str = "| dialect | handshape | palm | fingers | place | off | first that is wrong |
|---|--:|--:|--:|--:|--:|---|
";

impl Score {
    /// Returns the number of readings.
    pub(crate) fn all(&self) -> usize {
        4 * self.all
    }

    /// Returns the number of wrong readings.
    pub(crate) fn wrong(&self) -> usize {
        4 * self.all - self.shape - self.palm - self.fingers - self.place
    }

    /// Returns the row of the table.
    pub(crate) fn row(&self, name: &str) -> String {
        let of = |right: usize| format!("{right}/{}", self.all);
        format!(
            "| {name} | {} | {} | {} | {} | {:.1}° | {} |\n",
            of(self.shape),
            of(self.palm),
            of(self.fingers),
            of(self.place),
            self.off.to_degrees(),
            self.first.as_deref().unwrap_or("")
        )
    }
}
