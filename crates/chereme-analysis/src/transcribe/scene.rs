//! Trajectories of the hands in the signer's own space, frame by frame.

use chereme_motion::{Anatomy, Clip, HandAngles, ModelPose, Part, Side};
use chereme_sign::hamnosys::BodyLanguage;
use glam::{DMat3, DQuat, DVec3};

use super::shape::Known;
use super::{Options, TranscribeError};
use crate::transcribe::tuned::tuned;

/// The signer, with the dominant hand first.
///
/// Vectors are to the signer's left, up and forward, level with the ground, in metres from the middle of
/// the shoulders. For a left-handed signer left and right are exchanged, so that the dominant hand is
/// always a right hand.
pub(super) struct Scene<'a> {
    pub(super) clip: &'a Clip,
    pub(super) anatomy: &'a Anatomy,
    pub(super) language: &'a BodyLanguage,
    pub(super) dominant: Side,
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
    pub(super) alone: Option<Side>,
    pub(super) hands: [Option<HandTrajectory>; 2],
}

/// The trajectory of one hand.
pub(super) struct HandTrajectory {
    pub(super) side: Side,
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
    pub(super) known: Known,
    pub(super) missing: Vec<Part>,
    /// Whether the hand hangs at rest, or both arms stick out as in a reference posture.
    pub(super) rests: Vec<bool>,
    /// Whether the arm sticks out sideways.
    sticks: Vec<bool>,
}

/// The signer's level axes in one posture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Axes {
    origin: DVec3,
    /// The measured middle of the shoulders: the origin for landmarks of the trunk.
    shoulders: DVec3,
    left: DVec3,
    forward: DVec3,
}

impl Axes {
    /// Reads the axes from a posture. A hanging arm pulls its shoulder down: if only the arm `alone`
    /// signs, its shoulder alone gives the height.
    pub(super) fn of(
        anatomy: &Anatomy,
        alone: Option<Side>,
        model: &ModelPose,
        dominant: Side,
    ) -> Option<Self> {
        let body = anatomy.body_frame(model)?;
        let level = DVec3::new(body.forward.x, 0.0, body.forward.z);
        let forward = level.try_normalize()?;
        let left = DVec3::Y.cross(forward);
        let own = alone.and_then(|side| {
            let shoulder = model.position(anatomy.arm(side)?.upper);
            let middle = anatomy.joint(Part::Neck).or(anatomy.joint(Part::Chest))?;
            let aside = left.dot(shoulder - model.position(middle));
            Some(shoulder - left * aside)
        });
        Some(Self {
            origin: own.unwrap_or(body.origin),
            shoulders: body.origin,
            left: left * -dominant.sign(),
            forward,
        })
    }

    /// Converts a direction of model space to left, up and forward.
    pub(super) fn direction(&self, v: DVec3) -> DVec3 {
        DVec3::new(v.dot(self.left), v.y, v.dot(self.forward))
    }

    /// Converts a landmark of the trunk to left, up and forward of the shoulders' middle.
    pub(super) fn on_trunk(&self, at: DVec3) -> DVec3 {
        self.direction(at - self.shoulders)
    }

    /// Converts a position of model space to left, up and forward of the shoulders' middle.
    pub(super) fn place(&self, at: DVec3) -> DVec3 {
        self.direction(at - self.origin)
    }
}

impl<'a> Scene<'a> {
    pub(super) fn of(
        clip: &'a Clip,
        anatomy: &'a Anatomy,
        options: &'a Options,
    ) -> Result<Self, TranscribeError> {
        let seconds = clip.span().seconds();
        if clip.frames() == 0 {
            return Err(TranscribeError::Empty);
        }
        if seconds > options.longest {
            let most = options.longest;
            return Err(TranscribeError::TooLong { seconds, most });
        }
        let measures = anatomy.measures().ok_or(TranscribeError::NoBody)?;
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
        let mut tracks = [options.dominant, options.dominant.other()].map(|side| {
            anatomy
                .arm(side)
                .map(|_| HandTrajectory::new(anatomy, side))
        });
        let mut model = clip.model_pose(0);
        for frame in 0..clip.frames() {
            let pose = clip.pose(frame);
            model.set(clip.skeleton(), &pose);
            let axes = Axes::of(anatomy, scene.alone, &model, options.dominant)
                .ok_or(TranscribeError::NoBody)?;
            for track in tracks.iter_mut().flatten() {
                let angles = anatomy.hand_angles(clip.skeleton(), track.side, &pose);
                let correction = &options.hands[usize::from(track.side == Side::Left)];
                let angles = angles.map(|angles| correction.of(&angles));
                track.angles.push(angles.unwrap_or_default());
                scene.add(track, &model, &axes);
            }
        }
        if tracks.iter().all(Option::is_none) {
            return Err(TranscribeError::NoBody);
        }
        for frame in 0..clip.frames() {
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
    fn lone_arm(&self) -> Option<Side> {
        let step = self.clip.frames().div_ceil(tuned().scene.looked_at);
        let (mut signing, mut both) = ([0, 0], 0);
        for frame in (0..self.clip.frames()).step_by(step) {
            let model = self.clip.model_pose(frame);
            let axes = Axes::of(self.anatomy, None, &model, self.dominant)?;
            let mut hangs = [false; 2];
            for (hangs, side) in hangs.iter_mut().zip(Side::BOTH) {
                let arm = self.anatomy.arm(side)?;
                let reach = model.position(arm.hand) - model.position(arm.upper);
                *hangs = self.hangs(axes.direction(reach));
            }
            match hangs {
                [true, true] => {}
                [false, false] => both += 1,
                [right, _] => signing[usize::from(right)] += 1,
            }
        }
        let [right, left] = signing;
        if right > 2 * (both + left) {
            Some(Side::Right)
        } else if left > 2 * (both + right) {
            Some(Side::Left)
        } else {
            None
        }
    }

    fn add(&self, track: &mut HandTrajectory, model: &ModelPose, axes: &Axes) {
        let (anatomy, side) = (self.anatomy, track.side);
        let Some(arm) = anatomy.arm(side) else {
            return;
        };
        let wrist = model.position(arm.hand);
        let along = anatomy.hand_direction(side, model);
        let along = along.unwrap_or(DVec3::NEG_Y);
        let normal = anatomy.palm_normal(side, model).unwrap_or_else(|| {
            // Without fingers, take an axis of the hand's joint that lies across the hand, the same one in
            // every frame.
            let turned = model.rotation(arm.hand);
            let own = (turned.inverse() * along).abs();
            let across = if own.min_element() == own.x {
                DVec3::X
            } else if own.min_element() == own.y {
                DVec3::Y
            } else {
                DVec3::Z
            };
            (turned * across)
                .reject_from_normalized(along)
                .normalize_or(along.any_orthonormal_vector())
        });
        let shoulder = model.position(arm.upper);
        let (a, n) = (axes.direction(along), axes.direction(normal));
        track.wrist.push(axes.place(wrist));
        let upper = [shoulder, model.position(arm.forearm)];
        track.arm.push(upper.map(|at| axes.place(at)));
        let palm = anatomy.landmark(self.clip.skeleton(), model, palm_name(side));
        track.palm.push(axes.place(palm.unwrap_or(wrist)));
        track.along.push(a);
        track.normal.push(n);
        track.turned.push(rotation(a, n));
        let reach = axes.direction(wrist - shoulder);
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
    pub(super) fn frames(&self, seconds: f64) -> usize {
        (seconds * self.clip.rate().per_second()).round().max(1.0) as usize
    }

    /// Converts a number of frames to seconds.
    pub(super) fn seconds(&self, frames: usize) -> f64 {
        frames as f64 * self.clip.rate().frame_time()
    }
}

impl HandTrajectory {
    fn new(anatomy: &Anatomy, side: Side) -> Self {
        let (known, missing) = Known::of(anatomy, side);
        Self {
            side,
            wrist: Vec::new(),
            arm: Vec::new(),
            palm: Vec::new(),
            along: Vec::new(),
            normal: Vec::new(),
            faces: anatomy
                .joint(Part::Hand(side))
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
    pub(super) fn carried(&self, at: DVec3, frame: usize) -> Vec<DVec3> {
        let own = self.turned[frame].inverse() * (at - self.wrist[frame]);
        self.wrist
            .iter()
            .zip(&self.turned)
            .map(|(wrist, turned)| *wrist + *turned * own)
            .collect()
    }

    /// Returns the rotation vector (rad) of the hand between two frames, in its own space.
    pub(super) fn turn(&self, first: usize, last: usize) -> DVec3 {
        let turn = self.turned[first].inverse() * self.turned[last];
        scaled(turn)
    }

    /// Returns the difference of the finger angles between two frames: the root of the mean square over
    /// the known angles, in radians.
    pub(super) fn reshaped(&self, first: usize, last: usize) -> f64 {
        self.known.apart(&self.angles[first], &self.angles[last])
    }
}

fn palm_name(side: Side) -> &'static str {
    match side {
        Side::Right => "right-palm",
        Side::Left => "left-palm",
    }
}

/// Returns the rotation vector: the axis scaled by the angle in radians.
pub(super) fn scaled(turn: DQuat) -> DVec3 {
    let turn = if turn.w < 0.0 { -turn } else { turn };
    turn.to_scaled_axis()
}

/// Returns the rotation that takes the first axis to `along` and the second to `normal`, as far as that is across.
pub(super) fn rotation(along: DVec3, normal: DVec3) -> DQuat {
    let normal = normal
        .reject_from(along)
        .normalize_or(along.any_orthonormal_vector());
    DQuat::from_mat3(&DMat3::from_cols(along, normal, along.cross(normal))).normalize()
}

/// Returns the length of a polyline.
pub(super) fn length(points: &[DVec3]) -> f64 {
    points
        .windows(2)
        .map(|pair| pair[0].distance(pair[1]))
        .sum()
}
