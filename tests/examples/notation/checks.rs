//! Measures generated movement from its joints alone: lengths, limits, depths, speeds.

use chereme_compose::GeneratedMovement;
use chereme_motion::anatomy::BodyFrame;
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodyAnatomy, BodyPart, BodySide, ModelPose, Skeleton};

/// The worst values in a movement.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Worst {
    /// The number of values that are not numbers.
    pub(crate) nan: usize,
    /// The largest change of a bone's length in metres.
    pub(crate) bone: f64,
    /// The largest bend of a wrist and turn of a forearm, 1 at the limit.
    pub(crate) wrist: f64,
    pub(crate) turn: f64,
    /// The largest depth of a joint of a hand, and of an elbow, in the trunk, in metres.
    pub(crate) hand_depth: f64,
    pub(crate) elbow_depth: f64,
    /// The time of the larger of both, in seconds.
    pub(crate) deepest: f64,
    /// The highest speeds of a wrist and of an elbow, in metres per second.
    pub(crate) speed: f64,
    pub(crate) elbow_speed: f64,
    /// The fastest turn of a joint of the arm in radians per second.
    pub(crate) turning: f64,
    /// The largest height of an elbow above its shoulder, in metres.
    pub(crate) above: f64,
}

/// Measures a movement frame by frame.
pub(crate) fn worst(made: &GeneratedMovement) -> Worst {
    let (clip, anatomy) = (&made.clip, &made.anatomy);
    let skeleton = clip.clip_skeleton();
    let mut worst = Worst::default();
    let mut before: Option<ModelPose> = None;
    let rest = clip.model_pose(0);
    let still = Trunk::of(anatomy, skeleton, &rest);
    let per_second = clip.clip_frame_rate().per_second();
    for frame in 0..clip.clip_frame_count() {
        let model = clip.model_pose(frame);
        for joint in 0..skeleton.len() {
            let (at, turned) = (model.model_joint_position(joint), model.model_joint_rotation(joint));
            worst.nan += usize::from(!at.is_finite() || !turned.is_finite());
            if let Some(parent) = skeleton.joint_parent(joint) {
                let length = |model: &ModelPose| {
                    model
                        .model_joint_position(joint)
                        .distance(model.model_joint_position(parent))
                };
                worst.bone = worst.bone.max((length(&model) - length(&rest)).abs());
            }
        }
        let trunk = still.as_ref().map(|still| still.moved(&rest, &model));
        let depth = |at: DVec3| trunk.as_ref().map_or(0.0, |trunk| trunk.depth(at));
        let known = worst.hand_depth.max(worst.elbow_depth);
        for side in BodySide::BOTH_SIDES {
            let Some(arm) = anatomy.arm_chain(side) else {
                continue;
            };
            let (bend, turn) = wrist(anatomy, &model, side);
            worst.wrist = worst.wrist.max(bend);
            worst.turn = worst.turn.max(turn);
            let mut hand = anatomy.finger_joints(side);
            hand.push(arm.hand);
            for joint in hand {
                worst.hand_depth = worst.hand_depth.max(depth(model.model_joint_position(joint)));
            }
            worst.elbow_depth = worst.elbow_depth.max(depth(model.model_joint_position(arm.forearm)));
            let [shoulder, elbow] = [arm.upper, arm.forearm].map(|joint| model.model_joint_position(joint).y);
            worst.above = worst.above.max(elbow - shoulder);
            if let Some(before) = &before {
                let speed = |joint: usize| {
                    model
                        .model_joint_position(joint)
                        .distance(before.model_joint_position(joint))
                        * per_second
                };
                worst.speed = worst.speed.max(speed(arm.hand));
                worst.elbow_speed = worst.elbow_speed.max(speed(arm.forearm));
                for joint in [arm.upper, arm.forearm, arm.hand] {
                    let turn = model
                        .model_joint_rotation(joint)
                        .angle_between(before.model_joint_rotation(joint));
                    worst.turning = worst.turning.max(turn * per_second);
                }
            }
        }
        if worst.hand_depth.max(worst.elbow_depth) > known {
            worst.deepest = frame as f64 / per_second;
        }
        before = Some(model);
    }
    worst
}

/// Returns the bend of a wrist and the rotation of a forearm, 1 at the limits of the body language.
fn wrist(anatomy: &BodyAnatomy, model: &ModelPose, side: BodySide) -> (f64, f64) {
    let language = chereme_sign::hamnosys::BodyLanguage::default_body_language();
    let (Some(arm), Some(along), Some(palm)) = (
        anatomy.arm_chain(side),
        anatomy.hand_direction(side, model),
        anatomy.palm_normal(side, model),
    ) else {
        return (0.0, 0.0);
    };
    let [shoulder, elbow, wrist] = [arm.upper, arm.forearm, arm.hand].map(|j| model.model_joint_position(j));
    let forearm = (wrist - elbow).normalize();
    let radial = palm.cross(along) * side.side_sign();
    let flexion = (-forearm.dot(palm)).atan2(forearm.dot(along)).to_degrees();
    let deviation = (-forearm.dot(radial)).asin().to_degrees();
    let part = |angle: f64, less: f64, more: f64| angle / if angle > 0.0 { more } else { less };
    let bend = part(flexion, language.limit_extension, language.limit_flexion).hypot(part(
        deviation,
        language.limit_ulnar,
        language.limit_radial,
    ));
    let line = (wrist - shoulder).normalize();
    let across = line.cross((elbow - shoulder).reject_from_normalized(line));
    let out = across.cross(forearm);
    let Some(out) = out
        .try_normalize()
        .filter(|_| forearm.dot((elbow - shoulder).normalize()) < 0.99)
    else {
        return (bend, 0.0);
    };
    let inner = forearm.cross(out) * -side.side_sign();
    let aligned = DQuat::from_rotation_arc(along, forearm) * palm;
    let turn = forearm.dot(inner.cross(aligned)).atan2(inner.dot(aligned)) * -side.side_sign();
    let turn = part(turn.to_degrees(), language.limit_pronation, language.limit_supination);
    (bend, turn)
}

/// The trunk's surface in one frame: an ellipse at each height, through the landmarks of the front. It follows the joint
/// that carries the collar bones.
#[derive(Clone)]
pub(crate) struct Trunk {
    frame: BodyFrame,
    front: Vec<DVec3>,
    joint: Option<usize>,
}

impl Trunk {
    pub(crate) fn of(anatomy: &BodyAnatomy, skeleton: &Skeleton, model: &ModelPose) -> Option<Self> {
        let frame = anatomy.body_frame(model)?;
        let names = ["throat", "upper-chest", "chest", "stomach", "belly", "abdomen"];
        let front = names
            .iter()
            .filter_map(|name| anatomy.landmark_place_position(skeleton, model, name))
            .map(|at| frame.to_body(at))
            .collect();
        let arm = anatomy.arm_chain(BodySide::Right).or(anatomy.arm_chain(BodySide::Left));
        let joint = arm.and_then(|arm| skeleton.joint_parent(arm.clavicle.unwrap_or(arm.upper)));
        Some(Self { frame, front, joint })
    }

    /// Returns the surface in a frame, moved from its state at rest.
    pub(crate) fn moved(&self, rest: &ModelPose, model: &ModelPose) -> Self {
        let Some(joint) = self.joint else {
            return self.clone();
        };
        let turn = model.model_joint_rotation(joint) * rest.model_joint_rotation(joint).inverse();
        let frame = &self.frame;
        Self {
            frame: BodyFrame {
                origin: model.model_joint_position(joint) + turn * (frame.origin - rest.model_joint_position(joint)),
                left: turn * frame.left,
                up: turn * frame.up,
                forward: turn * frame.forward,
                ..*frame
            },
            ..self.clone()
        }
    }

    /// Returns the horizontal distance of a point within the trunk from its front and sides, in metres.
    fn depth(&self, at: DVec3) -> f64 {
        self.depth_with(at, 0.0)
    }

    /// Returns the depth of a ball about the point.
    pub(crate) fn depth_with(&self, at: DVec3, radius: f64) -> f64 {
        let more = radius / self.frame.scale;
        let v = self.frame.to_body(at);
        for (n, pair) in self.front.windows(2).enumerate() {
            let [above, below] = [pair[0], pair[1]];
            if v.y > above.y || v.y < below.y {
                continue;
            }
            let w = (above.y - v.y) / (above.y - below.y);
            // Between throat and chest the shoulders slope.
            let half = 0.42 - 0.17 * (1.0 - w) * f64::from(u8::from(n == 0)) + more;
            let front = above.z + (below.z - above.z) * w + more;
            if v.z < -0.2 || (v.x / half).powi(2) + (v.z.max(0.0) / front).powi(2) >= 1.0 {
                return 0.0;
            }
            let rim = (0..=180).map(|n| {
                let (sin, cos) = f64::from(n).to_radians().sin_cos();
                (v.x - half * cos).hypot(v.z - front * sin)
            });
            let nearest = rim.fold(half - v.x.abs(), f64::min);
            return nearest.max(0.0) * self.frame.scale;
        }
        0.0
    }
}

/// Returns whether the skeleton has a wrist.
#[allow(dead_code, reason = "the test uses it, the example does not")]
pub(crate) fn has_hand(anatomy: &BodyAnatomy) -> bool {
    BodySide::BOTH_SIDES
        .iter()
        .any(|&side| anatomy.part_joint(BodyPart::Hand(side)).is_some())
}
