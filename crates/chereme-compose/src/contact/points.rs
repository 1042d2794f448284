//! Follows points of hands and places on the body.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{ModelPose, Part, Side};

use crate::work::{Columns, Work};

/// The points of a hand that may touch something; after the first [`SEARCHED_POINTS`], those that only repair a contact.
pub(super) const POINTS: [&str; 9] = [
    "palm",
    "thumb-tip",
    "index-tip",
    "middle-tip",
    "ring-tip",
    "little-tip",
    "hand-radial",
    "hand-ulnar",
    "hand-back",
];
/// The number of points with which hands touch; the sides and the back of a fist come near the body in many signs.
pub(super) const SEARCHED_POINTS: usize = 6;
/// The places on the body that may be touched.
pub(super) const PLACES: [&str; 12] = [
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

/// Returns the place on the other side of the body.
pub(super) fn across(place: usize) -> usize {
    let name = match PLACES[place].split_once('-') {
        Some(("left", what)) => format!("right-{what}"),
        Some(("right", what)) => format!("left-{what}"),
        _ => return place,
    };
    let other = PLACES.iter().position(|place| **place == name);
    other.unwrap_or(place)
}

/// The number of frames at which points that depend on several joints are computed; between, they are interpolated.
const SAMPLES: usize = 16;

/// The largest distance of a place from the joint that carries it, in metres.
const SPREAD: f64 = 0.35;

/// The joint that carries a point.
#[derive(Debug, Clone, Copy)]
struct Anchor {
    joint: usize,
    /// The point in the joint's space; `None` if it moves there.
    at: Option<DVec3>,
}

/// The joints that carry the points and places of a body.
#[derive(Debug, Clone)]
pub(super) struct Anchors {
    hands: [[Option<Anchor>; POINTS.len()]; 2],
    body: [Option<Anchor>; PLACES.len()],
}

impl Anchors {
    /// Finds for each point the joint in whose space it never moves; for places that depend on several joints of the
    /// trunk, the uppermost of these.
    pub(super) fn of(work: &Work) -> Self {
        let anatomy = &work.anatomy;
        let twisted = [1.0, 2.0].map(|variant| twisted(work, variant));
        let anchor = |name: &str, joints: &[usize], loose: Option<usize>| {
            let at = |model: &ModelPose| anatomy.landmark(&work.skeleton, model, name);
            let [a, b] = [at(&twisted[0])?, at(&twisted[1])?];
            let rigid = joints.iter().find_map(|&joint| {
                let [local, other] = [local(&twisted[0], joint, a), local(&twisted[1], joint, b)];
                let at = Some(local);
                local
                    .abs_diff_eq(other, 1e-6)
                    .then_some(Anchor { joint, at })
            });
            rigid.or_else(|| {
                Some(Anchor {
                    joint: loose?,
                    at: None,
                })
            })
        };
        let hands = Side::BOTH.map(|side| {
            let mut joints = anatomy.fingers(side);
            joints.extend(anatomy.arm(side).map(|arm| arm.hand));
            joints.reverse();
            let hand = anatomy.arm(side).map(|arm| arm.hand);
            POINTS.map(|point| anchor(&hand_point(side, point), &joints, hand))
        });
        let trunk = [Part::Head, Part::Chest, Part::Spine, Part::Hips];
        let joints: Vec<usize> = trunk
            .iter()
            .filter_map(|&part| anatomy.joint(part))
            .collect();
        let loose = trunk[1..].iter().find_map(|&part| anatomy.joint(part));
        Self {
            hands,
            body: PLACES.map(|place| anchor(place, &joints, loose)),
        }
    }

    /// Follows the points through the movement.
    pub(super) fn tracks<'a>(&'a self, work: &'a Work) -> Tracks<'a> {
        let wrists = Side::BOTH.map(|side| work.anatomy.arm(side).map(|arm| arm.hand));
        let body = self.body.iter().flatten().map(|anchor| anchor.joint);
        let columns = Columns::of(work, wrists.into_iter().flatten().chain(body));
        let step = work.frames.div_ceil(SAMPLES).max(1);
        let mut tracks = Tracks {
            work,
            wrists,
            anchors: self,
            columns,
            step,
            loose: Vec::new(),
        };
        let is_loose = |anchor: &Anchor| anchor.at.is_none();
        let mut all = self.hands.iter().flatten().chain(&self.body).flatten();
        if all.any(is_loose) {
            for frame in (0..work.frames + step).step_by(step) {
                let pose = work.pose(frame.min(work.frames - 1));
                tracks
                    .loose
                    .push(self.sampled(work, &ModelPose::of(&work.skeleton, &pose)));
            }
        }
        tracks
    }

    /// Returns the points that move in their joint's space, in that space, for one posture; hands first.
    fn sampled(&self, work: &Work, model: &ModelPose) -> Vec<Option<DVec3>> {
        let at = |anchor: &Option<Anchor>, name: &dyn Fn() -> String| {
            let anchor = anchor.filter(|anchor| anchor.at.is_none())?;
            let place = work.anatomy.landmark(&work.skeleton, model, &name())?;
            Some(local(model, anchor.joint, place))
        };
        let hands = Side::BOTH
            .into_iter()
            .zip(&self.hands)
            .flat_map(|(side, hand)| {
                let points = hand.iter().zip(POINTS);
                points.map(move |(anchor, point)| at(anchor, &|| hand_point(side, point)))
            });
        let body = self.body.iter().zip(PLACES);
        hands
            .chain(body.map(|(anchor, place)| at(anchor, &|| place.to_owned())))
            .collect()
    }
}

fn hand_point(side: Side, point: &str) -> String {
    format!("{}-{point}", side.name())
}

fn local(model: &ModelPose, joint: usize, at: DVec3) -> DVec3 {
    model.rotation(joint).inverse() * (at - model.position(joint))
}

/// Returns the first posture with every joint rotated differently; each `variant` gives other rotations.
fn twisted(work: &Work, variant: f64) -> ModelPose {
    let mut pose = work.pose(0);
    for (n, rotation) in pose.rotations.iter_mut().enumerate() {
        let n = n as f64;
        let axis = DVec3::new((n * variant).sin(), (n + variant).cos(), 0.5);
        *rotation *= DQuat::from_axis_angle(axis.normalize(), 0.2 * (1.7 * n + variant).sin());
    }
    ModelPose::of(&work.skeleton, &pose)
}

/// The positions of points of hands and places on the body at each frame, computed on demand.
pub(super) struct Tracks<'a> {
    work: &'a Work,
    wrists: [Option<usize>; 2],
    anchors: &'a Anchors,
    columns: Columns,
    /// The interval in frames at which the points in `loose` are sampled.
    step: usize,
    /// The points that move in their joint's space, hands first, one list per sampled frame.
    loose: Vec<Vec<Option<DVec3>>>,
}

impl Tracks<'_> {
    /// Returns the position of a point of the hand of `side`; `None` if the hand lacks it.
    pub(super) fn hand(&self, side: Side, point: usize, frame: usize) -> Option<DVec3> {
        let hand = usize::from(side == Side::Left);
        let anchor = self.anchors.hands[hand][point]?;
        let mut at = self.local(anchor, hand * POINTS.len() + point, frame)?;
        let (mut joint, wrist) = (anchor.joint, self.wrists[hand]?);
        while joint != wrist {
            at = self.work.translation(joint, frame)
                + self.work.channels[joint].rotations[frame] * at;
            joint = self.work.skeleton.parent(joint)?;
        }
        Some(self.placed(wrist, at, frame))
    }

    /// Returns the position of a place on the body; `None` if the body lacks it.
    pub(super) fn body(&self, place: usize, frame: usize) -> Option<DVec3> {
        let anchor = self.anchors.body[place]?;
        let at = self.local(anchor, 2 * POINTS.len() + place, frame)?;
        Some(self.placed(anchor.joint, at, frame))
    }

    /// Returns the positions of places on the body, without those that are not within `reach` of a palm.
    pub(super) fn body_near(
        &self,
        palms: &[Option<DVec3>; 2],
        reach: f64,
        frame: usize,
    ) -> [Option<DVec3>; PLACES.len()] {
        let near = |joint: usize| {
            let at = self.columns.positions(joint)[frame];
            let within = reach + SPREAD;
            let mut known = palms.iter().flatten().peekable();
            known.peek().is_none() || known.any(|palm| palm.distance_squared(at) < within * within)
        };
        let mut last: Option<(usize, bool)> = None;
        std::array::from_fn(|place| {
            let joint = self.anchors.body[place]?.joint;
            let known = last.filter(|(same, _)| *same == joint);
            let (_, is_near) = *last.insert(known.unwrap_or_else(|| (joint, near(joint))));
            if is_near {
                self.body(place, frame)
            } else {
                None
            }
        })
    }

    /// Returns the position of something that a hand may touch: a point of the other hand, or a place on the body.
    pub(super) fn touched(&self, other: Option<Side>, place: usize, frame: usize) -> Option<DVec3> {
        match other {
            Some(side) => self.hand(side, place, frame),
            None => self.body(place, frame),
        }
    }

    fn placed(&self, joint: usize, at: DVec3, frame: usize) -> DVec3 {
        self.columns.positions(joint)[frame] + self.columns.rotations(joint)[frame] * at
    }

    fn local(&self, anchor: Anchor, index: usize, frame: usize) -> Option<DVec3> {
        if anchor.at.is_some() {
            return anchor.at;
        }
        let (first, share) = (
            frame / self.step,
            (frame % self.step) as f64 / self.step as f64,
        );
        Some(self.loose[first][index]?.lerp(self.loose[first + 1][index]?, share))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Shelf;

    #[test]
    fn contact_tracks_follow_the_landmarks() {
        for gloss in ["ESCARGOT", "LIMACE"] {
            let work = Work::of(&Shelf::new().materials[gloss]);
            let anchors = Anchors::of(&work);
            let tracks = anchors.tracks(&work);
            for frame in [0, 50, 119] {
                let model = ModelPose::of(&work.skeleton, &work.pose(frame));
                let at = |name: &str| work.anatomy.landmark(&work.skeleton, &model, name);
                let check = |name: &str, is: Option<DVec3>, near: f64| {
                    let far = is.zip(at(name)).map(|(a, b)| a.distance(b));
                    assert!(far.is_some_and(|far| far < near), "{gloss} {name} {far:?}");
                };
                for side in Side::BOTH {
                    for (n, point) in POINTS.into_iter().enumerate() {
                        check(&hand_point(side, point), tracks.hand(side, n, frame), 1e-6);
                    }
                }
                for (n, place) in PLACES.into_iter().enumerate() {
                    check(place, tracks.body(n, frame), 1e-3);
                }
            }
        }
    }
}
