//! The readings of a recording: handshape, palm, fingers and place in some frames.

use std::path::Path;

use chereme_corpus::{Address, Moving, Name};
use chereme_motion::glam::DVec3;
use chereme_motion::{Anatomy, Clip, HandAngles, Side};
use chereme_sign::hamnosys::Direction;
use chereme_sign::inventory;

use crate::Result;

/// The hand that is read.
pub(crate) const SIDE: Side = Side::Right;

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
    palm: String,
    fingers: String,
    place: &'static str,
    /// Where the palm's middle is, in shoulder widths of the body.
    at: DVec3,
    angles: HandAngles,
}

/// Imports a file and returns its movement as the corpus has it.
pub(crate) fn import(folder: &Path, name: &str, file: &Path) -> Result<Moving> {
    let corpus = crate::corpus_of(folder, name, file)?;
    Ok(corpus.movement(&Address::Recording(Name::Number(1)))?)
}

/// Returns the handshapes of the inventory that differ in their posture, with the first name of each.
pub(crate) fn shapes() -> Vec<(String, HandAngles)> {
    let mut shapes: Vec<(String, HandAngles)> = Vec::new();
    let all = inventory::builtin()
        .iter()
        .find(|it| it.id == "configurations");
    for value in all.map(|it| it.values.as_slice()).unwrap_or_default() {
        if let Some(pose) = value.pose
            && shapes
                .iter()
                .all(|(_, known)| distance(known, &pose) > 0.05)
        {
            shapes.push((value.id.clone(), pose));
        }
    }
    shapes
}

/// Returns how far two postures are apart: the root of the mean square of all angles, in radians.
fn distance(a: &HandAngles, b: &HandAngles) -> f64 {
    let pairs = a.to_array().into_iter().zip(b.to_array());
    let sum: f64 = pairs.map(|(a, b)| (a - b).powi(2)).sum();
    (sum / HandAngles::LEN as f64).sqrt()
}

/// Reads frames of a clip.
pub(crate) fn readings(anatomy: &Anatomy, clip: &Clip, frames: &[usize]) -> Result<Vec<Reading>> {
    let shapes = shapes();
    let read = |frame: usize| {
        let pose = clip.pose(frame);
        let model = clip.model_pose(frame);
        let skeleton = clip.skeleton();
        let body = anatomy.body_frame(&model)?;
        let angles = anatomy.hand_angles(skeleton, SIDE, &pose)?;
        let near = |shape: &&(String, HandAngles)| distance(&shape.1, &angles);
        let shape = shapes.iter().min_by(|a, b| near(a).total_cmp(&near(b)))?;
        let way = |way: DVec3| nearest(body.direction_to_body(way));
        let palm = anatomy.landmark(skeleton, &model, "right-palm")?;
        let far = |name: &&str| {
            let at = anatomy.landmark(skeleton, &model, name);
            at.map_or(f64::MAX, |at| at.distance(palm))
        };
        Some(Reading {
            shape: shape.0.clone(),
            palm: way(anatomy.palm_normal(SIDE, &model)?),
            fingers: way(anatomy.hand_direction(SIDE, &model)?),
            place: PLACES.iter().min_by(|a, b| far(a).total_cmp(&far(b)))?,
            at: body.to_body(palm),
            angles,
        })
    };
    let found: Option<Vec<Reading>> = frames.iter().map(|&frame| read(frame)).collect();
    found.ok_or_else(|| "the hand or the trunk is not found".into())
}

/// Names the nearest of the 26 directions.
fn nearest(way: DVec3) -> String {
    let near = |direction: &Direction| DVec3::from(direction.vector()).dot(way);
    let found = Direction::all().max_by(|a, b| near(a).total_cmp(&near(b)));
    found.map(|it| it.to_string()).unwrap_or_default()
}

/// How many readings are right.
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

/// Compares the readings with the truth. A direction or place at the limit of two is right if it lies within a few
/// degrees or centimetres of the truth.
pub(crate) fn compare(truth: &[Reading], found: &[Reading]) -> Score {
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
        score.palm += usize::from(want.palm == is.palm);
        score.fingers += usize::from(want.fingers == is.fingers);
        score.place += usize::from(want.place == is.place || want.at.distance(is.at) < 0.1);
        score.off = score.off.max(distance(&want.angles, &is.angles));
        if want.shape != is.shape && score.first.is_none() {
            let mut far: Vec<(usize, f64)> = want
                .angles
                .to_array()
                .into_iter()
                .zip(is.angles.to_array())
                .map(|(a, b)| (b - a).to_degrees())
                .enumerate()
                .collect();
            far.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
            let far: Vec<String> = far[..3]
                .iter()
                .map(|(n, by)| format!("{n}:{by:.0}°"))
                .collect();
            score.first = Some(format!(
                "{} as {} ({})",
                want.shape,
                is.shape,
                far.join(" ")
            ));
        }
    }
    score
}

impl Score {
    /// Returns how many readings are wrong.
    pub(crate) fn wrong(&self) -> usize {
        4 * self.all - self.shape - self.palm - self.fingers - self.place
    }

    /// Returns the row of the table.
    pub(crate) fn row(&self, name: &str) -> String {
        let of = |right: usize| format!("{right}/{}", self.all);
        format!(
            "| {name} | {} | {} | {} | {} | {:.1}° | {} |",
            of(self.shape),
            of(self.palm),
            of(self.fingers),
            of(self.place),
            self.off.to_degrees(),
            self.first.as_deref().unwrap_or("")
        )
    }
}
