//! Where hands touch each other and the body, before and after an operator.

use std::collections::BTreeMap;

use chereme_motion::glam::DVec3;
use chereme_motion::{ModelPose, Side};

use crate::work::Work;

/// How near points of hands are that touch, and a hand's point and a place on the body, in metres;
/// a finger is about as thick as the one, and places on the body are areas.
const HANDS: f64 = 0.02;
const BODY: f64 = 0.04;
/// How many frames are looked at.
const SAMPLES: usize = 24;

const POINTS: [&str; 6] = [
    "palm",
    "thumb-tip",
    "index-tip",
    "middle-tip",
    "ring-tip",
    "little-tip",
];
const PLACES: [&str; 12] = [
    "forehead",
    "left-temple",
    "right-temple",
    "nose",
    "left-cheek",
    "right-cheek",
    "mouth",
    "chin",
    "throat",
    "chest",
    "left-shoulder",
    "right-shoulder",
];

/// Two things that touch: a point of a hand, and one of the other hand or a place on the body.
type Pair = (Side, &'static str, Option<Side>, &'static str);

/// The nearest that touching things come, and when.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Touch {
    frame: usize,
    distance: f64,
    /// From the first thing to the second.
    way: DVec3,
}

/// Returns what touches in the movement.
pub(crate) fn touches(work: &Work) -> BTreeMap<Pair, Touch> {
    let mut found: BTreeMap<Pair, Touch> = BTreeMap::new();
    let step = work.frames.div_ceil(SAMPLES).max(1);
    for frame in (0..work.frames).step_by(step) {
        let points = Points::of(work, frame);
        for pair in pairs() {
            let near = if pair.2.is_some() { HANDS } else { BODY };
            let Some(way) = points.way(pair).filter(|way| way.length() < near) else {
                continue;
            };
            let distance = way.length();
            let touch = Touch {
                frame,
                distance,
                way,
            };
            let known = found.entry(pair).or_insert(touch);
            if distance < known.distance {
                *known = touch;
            }
        }
    }
    found
}

/// Says which contacts of before are gone, and by how far; of those that share a hand and what it
/// touched, only the nearest is told.
pub(crate) fn lost(before: &BTreeMap<Pair, Touch>, work: &Work) -> Vec<String> {
    let mut told: BTreeMap<(Side, Option<Side>), (f64, String)> = BTreeMap::new();
    for (&pair, touch) in before {
        let Some(way) = Points::of(work, touch.frame).way(pair) else {
            continue;
        };
        let moved = way.distance(touch.way);
        if moved < 0.005 {
            continue;
        }
        let (side, point, other, place) = pair;
        let place = other.map_or(place.to_owned(), |other| {
            format!("{}-{place}", other.name())
        });
        let text = format!(
            "{}-{point} touched {place} at {}; it is now {:.1} cm away, having moved {:.1} cm against it",
            side.name(),
            work.rate.instant(touch.frame),
            way.length() * 100.0,
            moved * 100.0
        );
        let nearest = told
            .entry((side, other))
            .or_insert((touch.distance, text.clone()));
        if touch.distance < nearest.0 {
            *nearest = (touch.distance, text);
        }
    }
    told.into_values().map(|(_, text)| text).collect()
}

fn pairs() -> impl Iterator<Item = Pair> {
    let hands = POINTS.into_iter().flat_map(|a| {
        let other = Some(Side::Left);
        POINTS.into_iter().map(move |b| (Side::Right, a, other, b))
    });
    let body = Side::BOTH.into_iter().flat_map(|side| {
        let points = POINTS.into_iter();
        points.flat_map(move |a| PLACES.into_iter().map(move |b| (side, a, None, b)))
    });
    hands.chain(body)
}

/// Where points of hands and places on the body are in one frame.
struct Points {
    hands: [[Option<DVec3>; POINTS.len()]; 2],
    body: [Option<DVec3>; PLACES.len()],
}

impl Points {
    fn of(work: &Work, frame: usize) -> Self {
        let model = ModelPose::of(&work.skeleton, &work.pose(frame));
        let at = |name: &str| work.anatomy.landmark(&work.skeleton, &model, name);
        Self {
            hands: Side::BOTH
                .map(|side| POINTS.map(|point| at(&format!("{}-{point}", side.name())))),
            body: PLACES.map(at),
        }
    }

    fn way(&self, (side, point, other, place): Pair) -> Option<DVec3> {
        let index = |names: &[&str], name: &str| names.iter().position(|n| *n == name);
        let hand = |side: Side, point: &str| {
            self.hands[usize::from(side == Side::Left)][index(&POINTS, point)?]
        };
        let to = match other {
            Some(other) => hand(other, place)?,
            None => self.body[index(&PLACES, place)?]?,
        };
        Some(to - hand(side, point)?)
    }
}
