//! Trajectories of the hands in the signer's own space, frame by frame.

use chereme_motion::{BodyAnatomy, BodyPart, BodySide, Clip, HandAngles, ModelPose};
use chereme_sign::hamnosys::BodyLanguage;
use glam::{DMat3, DQuat, DVec3};

use super::transcribe_shape::KnownHandAngles;
use super::{TranscribeError, TranscribeOptions};
use crate::transcribe::transcribe_tuned::tuned;

/// The signer, with the dominant hand first.
///
/// Vectors are to the signer's left, up and forward, level with the ground, in metres from the middle of
/// the shoulders. For a left-handed signer left and right are exchanged, so that the dominant hand is
/// always a right hand.
pub(super) struct SignerScene<'a> {
    pub(super) clip: &'a Clip,
    pub(super) anatomy: &'a BodyAnatomy,
    pub(super) language: &'a BodyLanguage,
    pub(super) dominant: BodySide,
    /// Expected distance (m) between a hand and its goal.
    pub(super) slack: f64,
    /// How loosely the hands follow the notated goals: the square root of the slack relative to that of
    /// synthesised movement; 1 for synthesised movement.
    pub(super) loose: f64,
    /// The arm's length in metres.
    pub(super) arm: f64,
    /// The width of the shoulders in metres.
    pub(super) shoulders: f64,
    /// The hand's length in metres.
    pub(super) hand: f64,
    /// The side of the only arm that signs, if the other rests.
    pub(super) alone: Option<BodySide>,
    pub(super) hands: [Option<HandTrajectory>; 2],
}

/// The trajectory of one hand.
pub(super) struct HandTrajectory {
    pub(super) side: BodySide,
    pub(super) wrist: Vec<DVec3>,
    /// Positions of the shoulder and the elbow.
    pub(super) arm: Vec<[DVec3; 2]>,
    /// Position of the middle of the palm.
    pub(super) palm: Vec<DVec3>,
    /// Unit vector from the wrist to the middle knuckle.
    pub(super) along: Vec<DVec3>,
    /// Unit vector out of the palm.
    pub(super) normal: Vec<DVec3>,
    /// Whether the skeleton shows where the palm faces.
    pub(super) faces: bool,
    /// The hand's own axes, as a rotation.
    pub(super) turned: Vec<DQuat>,
    pub(super) angles: Vec<HandAngles>,
    pub(super) known: KnownHandAngles,
    pub(super) missing: Vec<BodyPart>,
    /// Whether the hand hangs at rest, or both arms stick out as in a reference posture.
    pub(super) rests: Vec<bool>,
    /// Whether the arm sticks out sideways.
    sticks: Vec<bool>,
}

/// The signer's level axes in one posture.
#[derive(Debug, Clone, Copy)]
pub(super) struct LevelSignerAxes {
    origin: DVec3,
    /// The measured middle of the shoulders: the origin for landmarks of the trunk.
    shoulders: DVec3,
    left: DVec3,
    forward: DVec3,
}

impl LevelSignerAxes {
    /// Reads the axes from a posture. A hanging arm pulls its shoulder down: if only the arm `alone`
    /// signs, its shoulder alone gives the height.
    pub(super) fn read_signer_axes(
        anatomy: &BodyAnatomy,
        alone: Option<BodySide>,
        model: &ModelPose,
        dominant: BodySide,
    ) -> Option<Self> {
        let body = anatomy.body_frame(model)?;
        let level = DVec3::new(body.forward.x, 0.0, body.forward.z);
        let forward = level.try_normalize()?;
        let left = DVec3::Y.cross(forward);
        let shoulder_offset = alone.and_then(|side| {
            let shoulder = model.model_joint_position(anatomy.arm_chain(side)?.upper);
            let middle = anatomy
                .part_joint(BodyPart::Neck)
                .or(anatomy.part_joint(BodyPart::Chest))?;
            let aside = left.dot(shoulder - model.model_joint_position(middle));
            Some(shoulder - left * aside)
        });
        Some(Self {
            origin: shoulder_offset.unwrap_or(body.origin),
            shoulders: body.origin,
            left: left * -dominant.side_sign(),
            forward,
        })
    }

    /// Converts a direction of model space to left, up and forward.
    pub(super) fn signer_direction_of(&self, v: DVec3) -> DVec3 {
        DVec3::new(v.dot(self.left), v.y, v.dot(self.forward))
    }

    /// Converts a landmark of the trunk to left, up and forward of the shoulders' middle.
    pub(super) fn on_trunk(&self, at: DVec3) -> DVec3 {
        self.signer_direction_of(at - self.shoulders)
    }

    /// Converts a position of model space to left, up and forward of the shoulders' middle.
    pub(super) fn signer_place_of(&self, at: DVec3) -> DVec3 {
        self.signer_direction_of(at - self.origin)
    }
}

impl<'a> SignerScene<'a> {
    pub(super) fn read_signer_scene(
        clip: &'a Clip,
        anatomy: &'a BodyAnatomy,
        options: &'a TranscribeOptions,
    ) -> Result<Self, TranscribeError> {
        let seconds = clip.clip_span().span_seconds();
        if clip.clip_frame_count() == 0 {
            return Err(TranscribeError::Empty);
        }
        if seconds > options.longest {
            let most = options.longest;
            return Err(TranscribeError::TooLong { seconds, most });
        }
        let measures = anatomy.anatomy_measures().ok_or(TranscribeError::NoBody)?;
        let mut scene = Self {
            clip,
            anatomy,
            language: &options.language,
            dominant: options.dominant,
            slack: options.slack.max(1e-4),
            loose: (options.slack.max(1e-4) / tuned().reading.made).sqrt(),
            arm: measures.arm,
            shoulders: measures.shoulder_width,
            hand: measures.hand,
            alone: None,
            hands: [None, None],
        };
        scene.alone = scene.lone_arm();
        let mut tracks = [options.dominant, options.dominant.opposite_side()]
            .map(|side| anatomy.arm_chain(side).map(|_| HandTrajectory::new(anatomy, side)));
        let mut model = clip.model_pose(0);
        for frame in 0..clip.clip_frame_count() {
            let pose = clip.clip_pose_at(frame);
            model.set_local_pose(clip.clip_skeleton(), &pose);
            let axes = LevelSignerAxes::read_signer_axes(anatomy, scene.alone, &model, options.dominant)
                .ok_or(TranscribeError::NoBody)?;
            for track in tracks.iter_mut().flatten() {
                let angles = anatomy.hand_angles(clip.clip_skeleton(), track.side, &pose);
                let correction = &options.hands[usize::from(track.side == BodySide::Left)];
                let angles = angles.map(|angles| correction.correct_hand_angles(&angles));
                track.angles.push(angles.unwrap_or_default());
                scene.add_trajectory_posture(track, &model, &axes);
            }
        }
        if tracks.iter().all(Option::is_none) {
            return Err(TranscribeError::NoBody);
        }
        for frame in 0..clip.clip_frame_count() {
            if tracks.iter().flatten().all(|track| track.sticks[frame]) {
                for track in tracks.iter_mut().flatten() {
                    track.rests[frame] = true;
                }
            }
        }
        scene.hands = tracks;
        Ok(scene)
    }

    /// Returns the side of the only arm that signs: the other rests in most of the frames in which an arm does not.
    fn lone_arm(&self) -> Option<BodySide> {
        let step = self.clip.clip_frame_count().div_ceil(tuned().scene.looked_at);
        let (mut signing, mut both) = ([0, 0], 0);
        for frame in (0..self.clip.clip_frame_count()).step_by(step) {
            let model = self.clip.model_pose(frame);
            let axes = LevelSignerAxes::read_signer_axes(self.anatomy, None, &model, self.dominant)?;
            let mut hangs = [false; 2];
            for (hangs, side) in hangs.iter_mut().zip(BodySide::BOTH_SIDES) {
                let arm = self.anatomy.arm_chain(side)?;
                let reach = model.model_joint_position(arm.hand) - model.model_joint_position(arm.upper);
                *hangs = self.hangs(axes.signer_direction_of(reach));
            }
            match hangs {
                [true, true] => {}
                [false, false] => both += 1,
                [right, _] => signing[usize::from(right)] += 1,
            }
        }
        let [right, left] = signing;
        if right > 2 * (both + left) {
            Some(BodySide::Right)
        } else if left > 2 * (both + right) {
            Some(BodySide::Left)
        } else {
            None
        }
    }

    fn add_trajectory_posture(&self, track: &mut HandTrajectory, model: &ModelPose, axes: &LevelSignerAxes) {
        let (anatomy, side) = (self.anatomy, track.side);
        let Some(arm) = anatomy.arm_chain(side) else {
            return;
        };
        let wrist = model.model_joint_position(arm.hand);
        let bone_direction = anatomy.hand_direction(side, model);
        let along = bone_direction.unwrap_or(DVec3::NEG_Y);
        let normal = anatomy.palm_normal(side, model).unwrap_or_else(|| {
            // Without fingers, take an axis of the hand's joint that lies across the hand, the same one in
            // every frame.
            let turned = model.model_joint_rotation(arm.hand);
            let local_direction = (turned.inverse() * along).abs();
            let across = if local_direction.min_element() == local_direction.x {
                DVec3::X
            } else if local_direction.min_element() == local_direction.y {
                DVec3::Y
            } else {
                DVec3::Z
            };
            (turned * across)
                .reject_from_normalized(along)
                .normalize_or(along.any_orthonormal_vector())
        });
        let shoulder = model.model_joint_position(arm.upper);
        let (a, n) = (axes.signer_direction_of(along), axes.signer_direction_of(normal));
        track.wrist.push(axes.signer_place_of(wrist));
        let upper = [shoulder, model.model_joint_position(arm.forearm)];
        track.arm.push(upper.map(|at| axes.signer_place_of(at)));
        let palm = anatomy.landmark_place_position(self.clip.clip_skeleton(), model, palm_name(side));
        track.palm.push(axes.signer_place_of(palm.unwrap_or(wrist)));
        track.along.push(a);
        track.normal.push(n);
        track.turned.push(rotation_from_axes(a, n));
        let reach = axes.signer_direction_of(wrist - shoulder);
        track.rests.push(self.hangs(reach));
        track.sticks.push(self.sticks(reach));
    }

    /// Returns whether an arm hangs down.
    fn hangs(&self, reach: DVec3) -> bool {
        let direction = reach.normalize_or(DVec3::NEG_Y);
        direction.y < -0.78 && reach.length() > 0.8 * self.arm && reach.z < 0.35 * self.arm
    }

    /// Returns whether an arm sticks out sideways, as both do in a reference posture.
    fn sticks(&self, reach: DVec3) -> bool {
        let direction = reach.normalize_or(DVec3::NEG_Y);
        direction.x.abs() > 0.85 && reach.length() > 0.93 * self.arm && direction.z.abs() < 0.4
    }

    /// Converts a time in seconds to frames; at least one.
    pub(super) fn seconds_to_frames(&self, seconds: f64) -> usize {
        (seconds * self.clip.clip_frame_rate().per_second()).round().max(1.0) as usize
    }

    /// Converts a number of frames to seconds.
    pub(super) fn frames_to_seconds(&self, frames: usize) -> f64 {
        frames as f64 * self.clip.clip_frame_rate().frame_time()
    }
}

impl HandTrajectory {
    fn new(anatomy: &BodyAnatomy, side: BodySide) -> Self {
        let (known, missing) = KnownHandAngles::known_angle_weights(anatomy, side);
        Self {
            side,
            wrist: Vec::new(),
            arm: Vec::new(),
            palm: Vec::new(),
            along: Vec::new(),
            normal: Vec::new(),
            faces: anatomy
                .part_joint(BodyPart::Hand(side))
                .is_some_and(|_| anatomy.hand_rotation(side, DVec3::Z, DVec3::Y).is_some()),
            turned: Vec::new(),
            angles: Vec::new(),
            known,
            missing,
            rests: Vec::new(),
            sticks: Vec::new(),
        }
    }

    /// Returns the trajectory of the hand point that is at `at` in a frame, as if the fingers did not
    /// move.
    pub(super) fn carried_point_trajectory(&self, at: DVec3, frame: usize) -> Vec<DVec3> {
        let local_point = self.turned[frame].inverse() * (at - self.wrist[frame]);
        self.wrist
            .iter()
            .zip(&self.turned)
            .map(|(wrist, turned)| *wrist + *turned * local_point)
            .collect()
    }

    /// Returns the rotation vector (rad) of the hand between two frames, in its own space.
    pub(super) fn hand_turn_vector(&self, first: usize, last: usize) -> DVec3 {
        let turn = self.turned[first].inverse() * self.turned[last];
        to_rotation_vector(turn)
    }

    /// Returns the difference of the finger angles between two frames: the root of the mean square over
    /// the known angles, in radians.
    pub(super) fn finger_angle_change(&self, first: usize, last: usize) -> f64 {
        self.known
            .known_angle_difference(&self.angles[first], &self.angles[last])
    }
}

fn palm_name(side: BodySide) -> &'static str {
    match side {
        BodySide::Right => "right-palm",
        BodySide::Left => "left-palm",
    }
}

/// Returns the rotation vector: the axis scaled by the angle in radians.
pub(super) fn to_rotation_vector(turn: DQuat) -> DVec3 {
    let turn = if turn.w < 0.0 { -turn } else { turn };
    turn.to_scaled_axis()
}

/// Returns the rotation that takes the first axis to `along` and the second to `normal`, as far as that is across.
pub(super) fn rotation_from_axes(along: DVec3, normal: DVec3) -> DQuat {
    let normal = normal.reject_from(along).normalize_or(along.any_orthonormal_vector());
    DQuat::from_mat3(&DMat3::from_cols(along, normal, along.cross(normal))).normalize()
}

/// Returns the length of a polyline.
pub(super) fn polyline_length(points: &[DVec3]) -> f64 {
    points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}
