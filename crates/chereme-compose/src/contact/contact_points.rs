//! Follows points of hands and places on the body.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodyPart, BodySide, ModelPose};

use crate::work::{JointColumns, WorkingClip};

/// The points of a hand that may touch something; after the first [`SEARCHED_POINTS`], those that only repair a contact.
pub(super) const TOUCHING_HAND_POINTS: [&str; 9] = [
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
pub(super) const TOUCHED_BODY_PLACES: [&str; 12] = [
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
pub(super) fn opposite_place(place: usize) -> usize {
    let name = match TOUCHED_BODY_PLACES[place].split_once('-') {
        Some(("left", what)) => format!("right-{what}"),
        Some(("right", what)) => format!("left-{what}"),
        _ => return place,
    };
    let other = TOUCHED_BODY_PLACES.iter().position(|place| **place == name);
    other.unwrap_or(place)
}

/// The number of frames at which points that depend on several joints are computed; between, they are interpolated.
const POINT_SAMPLE_COUNT: usize = 16;

/// The largest distance of a place from the joint that carries it, in metres.
const MAX_ANCHOR_DISTANCE_M: f64 = 0.35;

/// The joint that carries a point.
#[derive(Debug, Clone, Copy)]
struct PointAnchor {
    joint: usize,
    /// The point in the joint's space; `None` if it moves there.
    at: Option<DVec3>,
}

/// The joints that carry the points and places of a body.
#[derive(Debug, Clone)]
pub(super) struct PointAnchors {
    hands: [[Option<PointAnchor>; TOUCHING_HAND_POINTS.len()]; 2],
    body: [Option<PointAnchor>; TOUCHED_BODY_PLACES.len()],
}

impl PointAnchors {
    /// Finds for each point the joint in whose space it never moves; for places that depend on several joints of the
    /// trunk, the uppermost of these.
    pub(super) fn find_point_anchors(work: &WorkingClip) -> Self {
        let anatomy = &work.anatomy;
        // A point at one place in a joint's space in two unlike postures never moves there.
        let twisted = [1.0, 2.0].map(|variant| twisted(work, variant));
        let anchor = |name: &str, joints: &[usize], loose: Option<usize>| {
            let landmark_point = |model: &ModelPose| anatomy.landmark_place_position(&work.skeleton, model, name);
            let [a, b] = [landmark_point(&twisted[0])?, landmark_point(&twisted[1])?];
            let rigid = joints.iter().find_map(|&joint| {
                let [local, other] = [
                    to_joint_space(&twisted[0], joint, a),
                    to_joint_space(&twisted[1], joint, b),
                ];
                let rigid_place = Some(local);
                local
                    .abs_diff_eq(other, 1e-6)
                    .then_some(PointAnchor { joint, at: rigid_place })
            });
            rigid.or_else(|| {
                Some(PointAnchor {
                    joint: loose?,
                    at: None,
                })
            })
        };
        let hands = BodySide::BOTH_SIDES.map(|side| {
            let mut joints = anatomy.finger_joints(side);
            joints.extend(anatomy.arm_chain(side).map(|arm| arm.hand));
            joints.reverse();
            let hand = anatomy.arm_chain(side).map(|arm| arm.hand);
            TOUCHING_HAND_POINTS.map(|point| anchor(&hand_point(side, point), &joints, hand))
        });
        let trunk = [BodyPart::Head, BodyPart::Chest, BodyPart::Spine, BodyPart::Hips];
        let joints: Vec<usize> = trunk.iter().filter_map(|&part| anatomy.part_joint(part)).collect();
        // Places that no single joint carries, such as a shoulder, do not follow the head.
        let loose = trunk[1..].iter().find_map(|&part| anatomy.part_joint(part));
        Self {
            hands,
            body: TOUCHED_BODY_PLACES.map(|place| anchor(place, &joints, loose)),
        }
    }

    /// Follows the points through the movement.
    pub(super) fn follow_anchored_points<'a>(&'a self, work: &'a WorkingClip) -> PointTracks<'a> {
        let wrists = BodySide::BOTH_SIDES.map(|side| work.anatomy.arm_chain(side).map(|arm| arm.hand));
        let body = self.body.iter().flatten().map(|anchor| anchor.joint);
        let columns = JointColumns::joint_columns_of(work, wrists.into_iter().flatten().chain(body));
        let step = work.frames.div_ceil(POINT_SAMPLE_COUNT).max(1);
        let mut tracks = PointTracks {
            work,
            wrists,
            anchors: self,
            columns,
            step,
            loose: Vec::new(),
        };
        let is_loose = |anchor: &PointAnchor| anchor.at.is_none();
        let mut all = self.hands.iter().flatten().chain(&self.body).flatten();
        if all.any(is_loose) {
            // One sample beyond the end, so that every frame lies between two.
            for frame in (0..work.frames + step).step_by(step) {
                let pose = work.local_pose_at(frame.min(work.frames - 1));
                tracks
                    .loose
                    .push(self.sample_moving_points(work, &ModelPose::from_local_pose(&work.skeleton, &pose)));
            }
        }
        tracks
    }

    /// Returns the points that move in their joint's space, in that space, for one posture; hands first.
    fn sample_moving_points(&self, work: &WorkingClip, model: &ModelPose) -> Vec<Option<DVec3>> {
        let anchor_place = |anchor: &Option<PointAnchor>, name: &dyn Fn() -> String| {
            let anchor = anchor.filter(|anchor| anchor.at.is_none())?;
            let place = work.anatomy.landmark_place_position(&work.skeleton, model, &name())?;
            Some(to_joint_space(model, anchor.joint, place))
        };
        let hands = BodySide::BOTH_SIDES
            .into_iter()
            .zip(&self.hands)
            .flat_map(|(side, hand)| {
                let points = hand.iter().zip(TOUCHING_HAND_POINTS);
                points.map(move |(anchor, point)| anchor_place(anchor, &|| hand_point(side, point)))
            });
        let body = self.body.iter().zip(TOUCHED_BODY_PLACES);
        hands
            .chain(body.map(|(anchor, place)| anchor_place(anchor, &|| place.to_owned())))
            .collect()
    }
}

fn hand_point(side: BodySide, point: &str) -> String {
    format!("{}-{point}", side.body_side_name())
}

fn to_joint_space(model: &ModelPose, joint: usize, at: DVec3) -> DVec3 {
    model.model_joint_rotation(joint).inverse() * (at - model.model_joint_position(joint))
}

/// Returns the first posture with every joint rotated differently; each `variant` gives other rotations.
fn twisted(work: &WorkingClip, variant: f64) -> ModelPose {
    let mut pose = work.local_pose_at(0);
    for (n, rotation) in pose.rotations.iter_mut().enumerate() {
        // The sines of the joint's number give no two joints the same turn.
        let n = n as f64;
        let axis = DVec3::new((n * variant).sin(), (n + variant).cos(), 0.5);
        *rotation *= DQuat::from_axis_angle(axis.normalize(), 0.2 * (1.7 * n + variant).sin());
    }
    ModelPose::from_local_pose(&work.skeleton, &pose)
}

/// The positions of points of hands and places on the body at each frame, computed on demand.
pub(super) struct PointTracks<'a> {
    work: &'a WorkingClip,
    wrists: [Option<usize>; 2],
    anchors: &'a PointAnchors,
    columns: JointColumns,
    /// The interval in frames at which the points in `loose` are sampled.
    step: usize,
    /// The points that move in their joint's space, hands first, one list per sampled frame.
    loose: Vec<Vec<Option<DVec3>>>,
}

impl PointTracks<'_> {
    /// Returns the position of a point of the hand of `side`; `None` if the hand lacks it.
    pub(super) fn hand_point_position(&self, side: BodySide, point: usize, frame: usize) -> Option<DVec3> {
        let hand = usize::from(side == BodySide::Left);
        let anchor = self.anchors.hands[hand][point]?;
        let mut position = self.local_anchor_position(anchor, hand * TOUCHING_HAND_POINTS.len() + point, frame)?;
        let (mut joint, wrist) = (anchor.joint, self.wrists[hand]?);
        while joint != wrist {
            position =
                self.work.joint_translation_at(joint, frame) + self.work.channels[joint].rotations[frame] * position;
            joint = self.work.skeleton.joint_parent(joint)?;
        }
        Some(self.anchored_position(wrist, position, frame))
    }

    /// Returns the position of a place on the body; `None` if the body lacks it.
    pub(super) fn body_place_position(&self, place: usize, frame: usize) -> Option<DVec3> {
        let anchor = self.anchors.body[place]?;
        let local_point = self.local_anchor_position(anchor, 2 * TOUCHING_HAND_POINTS.len() + place, frame)?;
        Some(self.anchored_position(anchor.joint, local_point, frame))
    }

    /// Returns the positions of places on the body, without those that are not within `reach` of a palm.
    pub(super) fn body_near(
        &self,
        palms: &[Option<DVec3>; 2],
        reach: f64,
        frame: usize,
    ) -> [Option<DVec3>; TOUCHED_BODY_PLACES.len()] {
        let near = |joint: usize| {
            let joint_place = self.columns.joint_positions(joint)[frame];
            let within = reach + MAX_ANCHOR_DISTANCE_M;
            let mut known_palms = palms.iter().flatten().peekable();
            known_palms.peek().is_none() || known_palms.any(|palm| palm.distance_squared(joint_place) < within * within)
        };
        // Neighbouring places share a joint, so that one test serves them.
        let mut last: Option<(usize, bool)> = None;
        std::array::from_fn(|place| {
            let joint = self.anchors.body[place]?.joint;
            let last_joint = last.filter(|(same, _)| *same == joint);
            let (_, is_near) = *last.insert(last_joint.unwrap_or_else(|| (joint, near(joint))));
            if is_near {
                self.body_place_position(place, frame)
            } else {
                None
            }
        })
    }

    /// Returns the position of something that a hand may touch: a point of the other hand, or a place on the body.
    pub(super) fn touched_position(&self, other: Option<BodySide>, place: usize, frame: usize) -> Option<DVec3> {
        match other {
            Some(side) => self.hand_point_position(side, place, frame),
            None => self.body_place_position(place, frame),
        }
    }

    fn anchored_position(&self, joint: usize, at: DVec3, frame: usize) -> DVec3 {
        self.columns.joint_positions(joint)[frame] + self.columns.joint_rotations(joint)[frame] * at
    }

    fn local_anchor_position(&self, anchor: PointAnchor, index: usize, frame: usize) -> Option<DVec3> {
        if anchor.at.is_some() {
            return anchor.at;
        }
        let (first, share) = (frame / self.step, (frame % self.step) as f64 / self.step as f64);
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
            let work = WorkingClip::working_clip_from(&Shelf::new().materials[gloss]);
            let anchors = PointAnchors::find_point_anchors(&work);
            let tracks = anchors.follow_anchored_points(&work);
            for frame in [0, 50, 119] {
                let model = ModelPose::from_local_pose(&work.skeleton, &work.local_pose_at(frame));
                let at = |name: &str| work.anatomy.landmark_place_position(&work.skeleton, &model, name);
                let check = |name: &str, is: Option<DVec3>, near: f64| {
                    let far = is.zip(at(name)).map(|(a, b)| a.distance(b));
                    assert!(far.is_some_and(|far| far < near), "{gloss} {name} {far:?}");
                };
                for side in BodySide::BOTH_SIDES {
                    for (n, point) in TOUCHING_HAND_POINTS.into_iter().enumerate() {
                        check(
                            &hand_point(side, point),
                            tracks.hand_point_position(side, n, frame),
                            1e-6,
                        );
                    }
                }
                for (n, place) in TOUCHED_BODY_PLACES.into_iter().enumerate() {
                    check(place, tracks.body_place_position(n, frame), 1e-3);
                }
            }
        }
    }
}
