//! The curves of both hands from which a take is cut, at 50 Hz in the space of the signer's trunk.

use chereme_motion::{BodyAnatomy, BodyPart, BodySide, Clip, ModelPose};
use glam::{DMat3, DQuat, DVec3};

use super::cut_tuned::tuned;
use super::peel::WristCurve;

/// The rate of the curves in Hz.
pub(super) const CURVE_RATE: f64 = 50.0;
/// The height of a hand that the body does not have: it hangs.
const HANGING_HEIGHT: f64 = -0.2;
/// The reach of the smoothing bell, in standard deviations.
const BELL_REACH: f64 = 3.0;

/// The curves of both hands, the right hand first.
#[derive(Debug, Clone, Default)]
pub(super) struct TakeCurves {
    pub(super) hands: [HandCurve; 2],
}

/// The curves of one hand; each has a number for every 20 ms.
#[derive(Debug, Clone, Default)]
pub(super) struct HandCurve {
    /// The place of the wrist left, up and forward of the shoulders' middle, in arm lengths.
    pub(super) places: Vec<DVec3>,
    /// The rotation of the hand in the space of the trunk.
    pub(super) palms: Vec<DQuat>,
    /// The rotations of the finger joints, frame by frame.
    pub(super) fingers: Vec<DQuat>,
    /// The number of finger joints.
    pub(super) finger_joints: usize,
    /// The height of the wrist: 0 at the hips, 1 at the shoulders.
    pub(super) height: Vec<f64>,
    /// The speed of the wrist in arm lengths a second.
    pub(super) speed: Vec<f64>,
    /// The speed of the palm in degrees a second.
    pub(super) palm_speed: Vec<f64>,
    /// The speed of the finger joints in degrees a second: the root of the mean square.
    pub(super) finger_speed: Vec<f64>,
    /// The speed of the elbow in arm lengths a second.
    pub(super) elbow_speed: Vec<f64>,
    /// The speed of the whole posture.
    pub(super) posture_speed: Vec<f64>,
}

/// The posture of one hand in a frame of the clip.
#[derive(Clone)]
struct HandSample {
    place: DVec3,
    elbow: DVec3,
    palm: DQuat,
    fingers: Vec<DQuat>,
}

/// The joints and sizes by which one arm is measured.
struct MeasuredArm {
    hand: usize,
    elbow: usize,
    fingers: Vec<usize>,
}

impl TakeCurves {
    /// Returns the curves of a movement; `None` if the body has no arm of measurable length, or no trunk.
    pub(super) fn measure_clip(clip: &Clip, anatomy: &BodyAnatomy) -> Option<Self> {
        let size = anatomy.anatomy_measures()?;
        let is_length = |length: f64| length.is_finite() && length > 1e-6;
        if !is_length(size.arm) || !is_length(size.trunk) || clip.clip_frame_count() == 0 {
            return None;
        }
        let arms = BodySide::BOTH_SIDES.map(|side| {
            let chain = anatomy.arm_chain(side)?;
            Some(MeasuredArm {
                hand: chain.hand,
                elbow: chain.forearm,
                fingers: anatomy.finger_joints(side),
            })
        });
        if arms.iter().all(Option::is_none) {
            return None;
        }
        let rate = clip.clip_frame_rate().per_second();
        // The smoothing bell needs no more frames than the curves have samples.
        let stride = ((rate / CURVE_RATE).floor() as usize).max(1);
        let mut times = Vec::new();
        let mut samples: [Vec<HandSample>; 2] = Default::default();
        for frame in (0..clip.clip_frame_count()).step_by(stride) {
            let pose = clip.model_pose(frame);
            let Some(trunk) = trunk_frame(anatomy, &pose) else {
                continue;
            };
            let measured = arms.each_ref().map(|arm| {
                arm.as_ref()
                    .map(|arm| HandSample::measure_hand(clip, frame, &pose, &trunk, arm, size.arm))
            });
            // A frame with gaps is left to the smoothing, for both hands at once so that times stay common.
            if measured.iter().flatten().any(|sample| !sample.is_finite()) {
                continue;
            }
            times.push(frame as f64 / rate);
            for (all, sample) in samples.iter_mut().zip(measured) {
                all.extend(sample);
            }
        }
        let last = *times.last()?;
        // Rounding must not lose the sample at the last time.
        let count = (last * CURVE_RATE + 1e-6).floor() as usize + 1;
        let trunk_share = size.trunk / size.arm;
        let hands = samples.map(|samples| match samples.is_empty() {
            true => HandCurve::hanging_hand(count),
            false => HandCurve::from_samples(&times, &samples, count, trunk_share),
        });
        Some(Self { hands })
    }

    /// Returns the number of samples.
    pub(super) fn sample_count(&self) -> usize {
        self.hands[0].height.len()
    }

    /// Returns the heights and speeds of both wrists.
    pub(super) fn wrist_curves(&self) -> [WristCurve<'_>; 2] {
        self.hands.each_ref().map(|hand| WristCurve {
            height: &hand.height,
            speed: &hand.speed,
        })
    }
}

/// The frame of the trunk: the shoulders' middle, and the rotation from left, up and forward to model space.
struct TrunkFrame {
    origin: DVec3,
    rotation: DQuat,
}

/// Returns the frame of the trunk: up from the hips to the shoulders, left from the right to the left upper arm.
fn trunk_frame(anatomy: &BodyAnatomy, pose: &ModelPose) -> Option<TrunkFrame> {
    let joint = |part| anatomy.part_joint(part).map(|joint| pose.model_joint_position(joint));
    let shoulders = BodySide::BOTH_SIDES.map(|side| joint(BodyPart::UpperArm(side)));
    if let ([Some(right), Some(left)], Some(hips)) = (shoulders, joint(BodyPart::Hips)) {
        let origin = (right + left) / 2.0;
        let up = (origin - hips).try_normalize()?;
        let left = (left - right).reject_from_normalized(up).try_normalize()?;
        // Left, up and forward: a right-handed frame.
        let axes = DMat3::from_cols(left, up, left.cross(up));
        return Some(TrunkFrame {
            origin,
            rotation: DQuat::from_mat3(&axes).normalize(),
        });
    }
    // A body without one of these joints is measured by its general frame.
    let body = anatomy.body_frame(pose)?;
    Some(TrunkFrame {
        origin: body.origin,
        rotation: body.body_frame_rotation(),
    })
}

impl HandSample {
    fn measure_hand(
        clip: &Clip,
        frame: usize,
        pose: &ModelPose,
        trunk: &TrunkFrame,
        arm: &MeasuredArm,
        length: f64,
    ) -> Self {
        let to_trunk = trunk.rotation.inverse();
        let place = |joint: usize| to_trunk * (pose.model_joint_position(joint) - trunk.origin) / length;
        let turn = |joint: &usize| clip.joint_channel(*joint).rotations[frame];
        Self {
            place: place(arm.hand),
            elbow: place(arm.elbow),
            palm: to_trunk * pose.model_joint_rotation(arm.hand),
            fingers: arm.fingers.iter().map(turn).collect(),
        }
    }

    fn is_finite(&self) -> bool {
        let mut turns = self.fingers.iter().chain([&self.palm]);
        self.place.is_finite() && self.elbow.is_finite() && turns.all(|turn| turn.is_finite())
    }
}

impl HandCurve {
    /// Returns the curves of a hand that the body does not have.
    fn hanging_hand(count: usize) -> Self {
        let still = vec![0.0; count];
        Self {
            places: vec![DVec3::NEG_Y; count],
            palms: vec![DQuat::IDENTITY; count],
            height: vec![HANGING_HEIGHT; count],
            speed: still.clone(),
            palm_speed: still.clone(),
            finger_speed: still.clone(),
            elbow_speed: still.clone(),
            posture_speed: still,
            ..Self::default()
        }
    }

    /// Returns the curves of samples at these times: smoothed, and then differentiated.
    fn from_samples(times: &[f64], samples: &[HandSample], count: usize, trunk_share: f64) -> Self {
        let mut curve = Self {
            finger_joints: samples[0].fingers.len(),
            ..Self::default()
        };
        let mut elbows = Vec::with_capacity(count);
        let mut mean = samples[0].clone();
        let deviation = tuned().scales.smoothing;
        let (mut first, mut weights) = (0, Vec::new());
        for number in 0..count {
            let time = number as f64 / CURVE_RATE;
            let reach = BELL_REACH * deviation + 1e-9;
            // Times rise, so that the bell's first frame only moves on.
            while first + 1 < times.len() && times[first] < time - reach {
                first += 1;
            }
            weights.clear();
            let near = times[first..].iter().take_while(|sample| **sample <= time + reach);
            weights.extend(near.map(|sample| (-0.5 * ((sample - time) / deviation).powi(2)).exp()));
            if weights.is_empty() {
                // Frames are missing here: the next posture stands for them.
                weights.push(1.0);
            }
            mean.set_weighted_mean(&samples[first..first + weights.len()], &weights);
            curve.places.push(mean.place);
            elbows.push(mean.elbow);
            curve.palms.push(mean.palm);
            curve.fingers.extend_from_slice(&mean.fingers);
        }
        // Places count from the shoulders, heights from the hips.
        curve.height = curve.places.iter().map(|place| 1.0 + place.y / trunk_share).collect();
        curve.speed = central_differences(count, |a, b| curve.places[a].distance(curve.places[b]));
        curve.elbow_speed = central_differences(count, |a, b| elbows[a].distance(elbows[b]));
        curve.palm_speed = central_differences(count, |a, b| curve.palm_change(a, b));
        curve.finger_speed = central_differences(count, |a, b| curve.finger_change(a, b));
        let all = curve.speed.iter().zip(&curve.palm_speed).zip(&curve.finger_speed);
        curve.posture_speed = all.map(|((v, w), f)| posture_measure(*v, *w, *f)).collect();
        curve
    }

    /// Returns the angle in degrees between the palms of two samples.
    pub(super) fn palm_change(&self, a: usize, b: usize) -> f64 {
        angle_between_turns(self.palms[a], self.palms[b])
    }

    /// Returns the root of the mean square of the angles in degrees between the finger joints of two samples.
    pub(super) fn finger_change(&self, a: usize, b: usize) -> f64 {
        if self.finger_joints == 0 {
            return 0.0;
        }
        let shape = |sample: usize| &self.fingers[sample * self.finger_joints..][..self.finger_joints];
        let pairs = shape(a).iter().zip(shape(b));
        let squares: f64 = pairs
            .map(|(one, other)| angle_between_turns(*one, *other).powi(2))
            .sum();
        (squares / self.finger_joints as f64).sqrt()
    }

    /// Returns the distance of the postures of two samples.
    pub(super) fn posture_distance(&self, a: usize, b: usize) -> f64 {
        let place = self.places[a].distance(self.places[b]);
        posture_measure(place, self.palm_change(a, b), self.finger_change(a, b))
    }
}

impl HandSample {
    /// Sets the sample to the mean of samples with weights; rotations are turned into one half-space first.
    fn set_weighted_mean(&mut self, samples: &[Self], weights: &[f64]) {
        let total: f64 = weights.iter().sum();
        let mean_place = |of: fn(&Self) -> DVec3| -> DVec3 {
            let all = samples.iter().zip(weights);
            all.map(|(sample, weight)| of(sample) * *weight).sum::<DVec3>() / total
        };
        self.place = mean_place(|sample| sample.place);
        self.elbow = mean_place(|sample| sample.elbow);
        self.palm = mean_rotation(samples.iter().map(|sample| sample.palm), weights);
        for (joint, mean) in self.fingers.iter_mut().enumerate() {
            *mean = mean_rotation(samples.iter().map(|sample| sample.fingers[joint]), weights);
        }
    }
}

fn mean_rotation(rotations: impl Iterator<Item = DQuat>, weights: &[f64]) -> DQuat {
    let mut sum: Option<DQuat> = None;
    for (rotation, weight) in rotations.zip(weights) {
        sum = Some(match sum {
            None => rotation * *weight,
            // A rotation and its negative are the same; opposite signs would cancel out.
            Some(sum) if sum.dot(rotation) < 0.0 => sum - rotation * *weight,
            Some(sum) => sum + rotation * *weight,
        });
    }
    let sum = sum.unwrap_or(DQuat::IDENTITY);
    if sum.length_squared() > 1e-12 {
        sum.normalize()
    } else {
        DQuat::IDENTITY
    }
}

/// Returns the angle between two rotations in degrees; exact for small angles, too.
fn angle_between_turns(one: DQuat, other: DQuat) -> f64 {
    let turn = one.inverse() * other;
    2.0 * turn.xyz().length().atan2(turn.w.abs()).to_degrees()
}

/// Returns the measure of a change, or a speed, of place, palm and fingers.
fn posture_measure(place: f64, palm: f64, fingers: f64) -> f64 {
    let scales = &tuned().scales;
    let squares = (place / scales.place).powi(2) + (palm / scales.palm).powi(2) + (fingers / scales.fingers).powi(2);
    squares.sqrt()
}

/// Returns speeds by central differences, given the distance between two samples.
fn central_differences(count: usize, distance: impl Fn(usize, usize) -> f64) -> Vec<f64> {
    let last = count.saturating_sub(1);
    let speed = |sample: usize| {
        let (before, after) = (sample.saturating_sub(1), (sample + 1).min(last));
        distance(before, after) * CURVE_RATE / (after - before).max(1) as f64
    };
    (0..count).map(speed).collect()
}
