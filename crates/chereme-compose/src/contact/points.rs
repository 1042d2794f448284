//! Where points of hands and places on the body are, over all frames.

use std::cell::OnceCell;

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{ModelPose, Part, Side};

use crate::work::{Columns, Work};

/// The points of a hand that touch.
pub(super) const POINTS: [&str; 6] = [
    "palm",
    "thumb-tip",
    "index-tip",
    "middle-tip",
    "ring-tip",
    "little-tip",
];
/// The places on the body that are touched.
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

/// How often places that go with several joints are looked for; between, they are interpolated.
const SAMPLES: usize = 24;

/// What carries a point.
#[derive(Clone, Copy)]
struct Anchor {
    joint: usize,
    /// Where the point is in the joint's space; nothing where it moves in it.
    at: Option<DVec3>,
}

/// What carries the points and places of a body.
pub(super) struct Anchors {
    hands: [[Option<Anchor>; POINTS.len()]; 2],
    body: [Option<Anchor>; PLACES.len()],
}

impl Anchors {
    /// Finds for each point the joint in whose space it stays where it is, however the body moves;
    /// for places that depend on several joints of the trunk the uppermost of them.
    pub(super) fn of(work: &Work) -> Self {
        let anatomy = &work.anatomy;
        let twisted = [1.0, 2.0].map(|way| twisted(work, way));
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
    pub(super) fn tracks(&self, work: &Work) -> Tracks {
        let all = self.hands.iter().flatten().chain(&self.body).flatten();
        let columns = Columns::of(work, all.map(|anchor| anchor.joint));
        let carried = |joint: usize, at: &dyn Fn(usize) -> DVec3| -> Vec<DVec3> {
            let turned = columns.rotations(joint).iter().enumerate();
            let path = columns.positions(joint).iter().zip(turned);
            path.map(|(place, (frame, turned))| *place + *turned * at(frame))
                .collect()
        };
        let step = work.frames.div_ceil(SAMPLES).max(1);
        let samples = (0..work.frames + step).step_by(step);
        let models = OnceCell::new();
        let sampled = || -> Vec<ModelPose> {
            let pose = |frame: usize| work.pose(frame.min(work.frames - 1));
            let model = |frame| ModelPose::of(&work.skeleton, &pose(frame));
            samples.clone().map(model).collect()
        };
        let track = |name: &str, anchor: &Option<Anchor>| -> Option<Vec<DVec3>> {
            let Anchor { joint, at } = (*anchor)?;
            if let Some(at) = at {
                return Some(carried(joint, &|_| at));
            }
            let models = models.get_or_init(sampled).iter();
            let at = |model: &ModelPose| {
                let place = work.anatomy.landmark(&work.skeleton, model, name)?;
                Some(local(model, joint, place))
            };
            let places = models.map(at).collect::<Option<Vec<DVec3>>>()?;
            Some(carried(joint, &|frame| {
                let (first, share) = (frame / step, (frame % step) as f64 / step as f64);
                places[first].lerp(places[first + 1], share)
            }))
        };
        let hand = |side: Side| {
            let anchors = &self.hands[usize::from(side == Side::Left)];
            std::array::from_fn(|n| track(&hand_point(side, POINTS[n]), &anchors[n]))
        };
        Tracks {
            hands: Side::BOTH.map(hand),
            body: std::array::from_fn(|n| track(PLACES[n], &self.body[n])),
        }
    }
}

fn hand_point(side: Side, point: &str) -> String {
    format!("{}-{point}", side.name())
}

fn local(model: &ModelPose, joint: usize, at: DVec3) -> DVec3 {
    model.rotation(joint).inverse() * (at - model.position(joint))
}

/// Returns the first posture with every joint turned, each another way.
fn twisted(work: &Work, way: f64) -> ModelPose {
    let mut pose = work.pose(0);
    for (n, rotation) in pose.rotations.iter_mut().enumerate() {
        let n = n as f64;
        let axis = DVec3::new((n * way).sin(), (n + way).cos(), 0.5);
        *rotation *= DQuat::from_axis_angle(axis.normalize(), 0.2 * (1.7 * n + way).sin());
    }
    ModelPose::of(&work.skeleton, &pose)
}

/// Where points of hands and places on the body are at each frame; nothing for what a body lacks.
pub(super) struct Tracks {
    pub(super) hands: [[Option<Vec<DVec3>>; POINTS.len()]; 2],
    pub(super) body: [Option<Vec<DVec3>>; PLACES.len()],
}

impl Tracks {
    /// Returns the points of the hand of `side`.
    pub(super) fn hand(&self, side: Side) -> &[Option<Vec<DVec3>>; POINTS.len()] {
        &self.hands[usize::from(side == Side::Left)]
    }

    /// Returns what a hand touches: the other hand's points, or the body's places.
    pub(super) fn touched(&self, other: Option<Side>) -> &[Option<Vec<DVec3>>] {
        match other {
            Some(side) => self.hand(side),
            None => &self.body,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Shelf;

    #[test]
    fn tracks_are_where_landmarks_are() {
        for gloss in ["ESCARGOT", "LIMACE"] {
            let work = Work::of(&Shelf::new().materials[gloss]);
            let tracks = Anchors::of(&work).tracks(&work);
            for frame in [0, 50, 119] {
                let model = ModelPose::of(&work.skeleton, &work.pose(frame));
                let at = |name: &str| work.anatomy.landmark(&work.skeleton, &model, name);
                let check = |name: &str, track: &Option<Vec<DVec3>>, near: f64| {
                    let (is, want) = (track.as_ref().map(|t| t[frame]), at(name));
                    let far = is.zip(want).map(|(a, b)| a.distance(b));
                    assert!(far.is_some_and(|far| far < near), "{gloss} {name} {far:?}");
                };
                for side in Side::BOTH {
                    for (point, track) in POINTS.iter().zip(tracks.hand(side)) {
                        check(&format!("{}-{point}", side.name()), track, 1e-6);
                    }
                }
                for (place, track) in PLACES.iter().zip(&tracks.body) {
                    check(place, track, 1e-4);
                }
            }
        }
    }
}
