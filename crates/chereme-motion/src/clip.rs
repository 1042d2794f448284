//! Movement as values: the rotations of a skeleton's joints over frames, joint by joint.

use std::ops::Range;
use std::sync::Arc;

use glam::{DQuat, DVec3};

use crate::pose::{LocalPose, ModelPose};
use crate::skeleton::Skeleton;
use crate::time::{FrameRate, RecordingInstant, TimeSpan};

/// The movement of one joint in its parent's space.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct JointChannel {
    /// One unit quaternion per frame.
    pub rotations: Vec<DQuat>,
    /// One position per frame in metres if the joint also moves; otherwise it stays at its offset.
    pub translations: Option<Vec<DVec3>>,
}

/// A movement: one [`JointChannel`] per joint, all of the same length.
#[derive(Debug, Clone, PartialEq)]
pub struct Clip {
    skeleton: Arc<Skeleton>,
    rate: FrameRate,
    frames: usize,
    channels: Vec<JointChannel>,
}

/// Why channels do not form a clip.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ClipError {
    /// There is not one channel per joint.
    #[error("{channels} channels were given for a skeleton of {joints} joints")]
    Joints {
        /// The channels given.
        channels: usize,
        /// The skeleton's joints.
        joints: usize,
    },
    /// A channel is longer or shorter than the first.
    #[error("the channel of joint {joint:?} has {found} frames where {expected} were expected")]
    Length {
        /// The joint's name.
        joint: String,
        /// Its frames.
        found: usize,
        /// The frames of the first channel.
        expected: usize,
    },
    /// A rotation or position is not finite, or a rotation is not of length one.
    #[error("joint {joint:?} has a value that is no rotation or place at frame {frame}")]
    Value {
        /// The joint's name.
        joint: String,
        /// The frame, from 0.
        frame: usize,
    },
}

impl Clip {
    /// Returns the clip with one channel per joint.
    ///
    /// # Errors
    /// [`ClipError`] if channels are missing, differ in length, or contain invalid values.
    pub fn new(skeleton: Arc<Skeleton>, rate: FrameRate, channels: Vec<JointChannel>) -> Result<Self, ClipError> {
        if channels.len() != skeleton.len() {
            return Err(ClipError::Joints {
                channels: channels.len(),
                joints: skeleton.len(),
            });
        }
        let frames = channels[0].rotations.len();
        for (joint, channel) in skeleton.skeleton_joints().iter().zip(&channels) {
            let name = || joint.name.clone();
            let moved = channel.translations.as_ref().map_or(frames, Vec::len);
            for found in [channel.rotations.len(), moved] {
                if found != frames {
                    return Err(ClipError::Length {
                        joint: name(),
                        found,
                        expected: frames,
                    });
                }
            }
            let turned = channel.rotations.iter().position(|q| !q.is_normalized());
            let moved = channel
                .translations
                .iter()
                .flatten()
                .position(|t: &DVec3| !t.is_finite());
            if let Some(frame) = turned.or(moved) {
                return Err(ClipError::Value { joint: name(), frame });
            }
        }
        Ok(Self {
            skeleton,
            rate,
            frames,
            channels,
        })
    }

    /// Returns `frames` frames of the skeleton at rest.
    #[must_use]
    pub fn from_rest_pose(skeleton: Arc<Skeleton>, rate: FrameRate, frames: usize) -> Self {
        let channels = skeleton
            .skeleton_joints()
            .iter()
            .map(|joint| JointChannel {
                rotations: vec![joint.rest; frames],
                translations: None,
            })
            .collect();
        Self {
            skeleton,
            rate,
            frames,
            channels,
        }
    }

    /// Returns the clip with one of `poses` per frame; joints that never leave their offset get no translations.
    ///
    /// # Errors
    /// [`ClipError`] if a pose has another number of joints, or contains invalid values.
    pub fn from_poses(skeleton: Arc<Skeleton>, rate: FrameRate, poses: &[LocalPose]) -> Result<Self, ClipError> {
        let joints = skeleton.len();
        if let Some(pose) = poses
            .iter()
            .find(|pose| pose.rotations.len() != joints || pose.translations.len() != joints)
        {
            let channels = pose.rotations.len().min(pose.translations.len());
            return Err(ClipError::Joints { channels, joints });
        }
        let channels = (0..joints)
            .map(|j| {
                let offset = skeleton.joint_at(j).offset;
                let moves = poses.iter().any(|pose| pose.translations[j] != offset);
                JointChannel {
                    rotations: poses.iter().map(|pose| pose.rotations[j]).collect(),
                    translations: moves.then(|| poses.iter().map(|pose| pose.translations[j]).collect()),
                }
            })
            .collect();
        Self::new(skeleton, rate, channels)
    }

    /// Returns the skeleton that moves.
    #[must_use]
    pub fn clip_skeleton(&self) -> &Arc<Skeleton> {
        &self.skeleton
    }

    /// Returns the frame rate.
    #[must_use]
    pub fn clip_frame_rate(&self) -> FrameRate {
        self.rate
    }

    /// Returns how many frames there are; a clip may be empty.
    #[must_use]
    pub fn clip_frame_count(&self) -> usize {
        self.frames
    }

    /// Returns the time of the clip, which starts at zero.
    #[must_use]
    pub fn clip_span(&self) -> TimeSpan {
        self.rate.frame_range_span(0..self.frames)
    }

    /// Returns the movement of `joint`.
    #[must_use]
    pub fn joint_channel(&self, joint: usize) -> &JointChannel {
        &self.channels[joint]
    }

    /// Returns the movement of every joint.
    #[must_use]
    pub fn joint_channels(&self) -> &[JointChannel] {
        &self.channels
    }

    /// Returns the channels, to build another clip from them.
    #[must_use]
    pub fn into_channels(self) -> Vec<JointChannel> {
        self.channels
    }

    /// Returns the position of `joint` in its parent's space at `frame`, in metres.
    #[must_use]
    pub fn joint_translation(&self, joint: usize, frame: usize) -> DVec3 {
        match &self.channels[joint].translations {
            Some(places) => places[frame],
            None => self.skeleton.joint_at(joint).offset,
        }
    }

    /// Returns the posture at `frame`, in local space.
    ///
    /// # Panics
    /// Panics if `frame` is not below [`Clip::clip_frame_count`].
    #[must_use]
    pub fn clip_pose_at(&self, frame: usize) -> LocalPose {
        LocalPose {
            rotations: self.channels.iter().map(|channel| channel.rotations[frame]).collect(),
            translations: (0..self.channels.len())
                .map(|j| self.joint_translation(j, frame))
                .collect(),
        }
    }

    /// Returns the posture at `frame`, in model space.
    ///
    /// # Panics
    /// Panics if `frame` is not below [`Clip::clip_frame_count`].
    #[must_use]
    pub fn model_pose(&self, frame: usize) -> ModelPose {
        ModelPose::from_local_pose(&self.skeleton, &self.clip_pose_at(frame))
    }

    /// Returns the posture at `instant`: between two frames, rotations are interpolated by slerp and positions
    /// linearly; outside the clip it is that of the nearest frame. An empty clip is at rest.
    #[must_use]
    pub fn sample_pose(&self, instant: RecordingInstant) -> LocalPose {
        if self.frames == 0 {
            return self.skeleton.rest_pose();
        }
        let frame_position = (instant.instant_seconds() * self.rate.per_second()).clamp(0.0, (self.frames - 1) as f64);
        let (first, share) = (frame_position.floor() as usize, frame_position.fract());
        if share == 0.0 {
            return self.clip_pose_at(first);
        }
        let second = first + 1;
        let rotations = self.channels.iter().map(|channel| {
            let (a, b) = (channel.rotations[first], channel.rotations[second]);
            a.slerp(b, share)
        });
        let translations = (0..self.channels.len()).map(|j| {
            self.joint_translation(j, first)
                .lerp(self.joint_translation(j, second), share)
        });
        LocalPose {
            rotations: rotations.collect(),
            translations: translations.collect(),
        }
    }

    /// Returns the position of `joint` in model space at every frame, in metres.
    ///
    /// Computes only the joints between it and the root.
    #[must_use]
    pub fn joint_path(&self, joint: usize) -> Vec<DVec3> {
        let mut up: Vec<usize> = self.skeleton.joint_ancestors(joint).collect();
        up.reverse();
        (0..self.frames)
            .map(|frame| {
                let (mut position, mut rotation) = (DVec3::ZERO, DQuat::IDENTITY);
                for &j in &up {
                    position += rotation * self.joint_translation(j, frame);
                    rotation *= self.channels[j].rotations[frame];
                }
                position
            })
            .collect()
    }

    /// Returns the part of the clip in `frames`, as far as it exists.
    #[must_use]
    pub fn slice_clip_frames(&self, frames: Range<usize>) -> Self {
        let end = frames.end.min(self.frames);
        let range = frames.start.min(end)..end;
        let channels = self
            .channels
            .iter()
            .map(|channel| JointChannel {
                rotations: channel.rotations[range.clone()].to_vec(),
                translations: channel.translations.as_ref().map(|t| t[range.clone()].to_vec()),
            })
            .collect();
        Self {
            skeleton: Arc::clone(&self.skeleton),
            rate: self.rate,
            frames: range.len(),
            channels,
        }
    }

    /// Returns the same movement at another frame rate; the first frame stays, and no frame lies after the last one of
    /// this clip.
    #[must_use]
    pub fn resample_clip(&self, rate: FrameRate) -> Self {
        if rate == self.rate || self.frames == 0 {
            return Self { rate, ..self.clone() };
        }
        let last = self.rate.frame_start_instant(self.frames - 1);
        let frames =
            rate.nearest_frame_at(last) + usize::from(rate.frame_start_instant(rate.nearest_frame_at(last)) <= last);
        self.retime_clip(rate, frames, |frame| rate.frame_start_instant(frame))
    }

    /// Returns `frames` frames at `rate`, each sampled at the instant that `source` returns for it.
    #[must_use]
    pub fn retime_clip(&self, rate: FrameRate, frames: usize, source: impl Fn(usize) -> RecordingInstant) -> Self {
        let poses: Vec<LocalPose> = (0..frames).map(|frame| self.sample_pose(source(frame))).collect();
        Self::from_poses(Arc::clone(&self.skeleton), rate, &poses)
            .expect("sampled poses are of this skeleton and slerp keeps unit length")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::skeleton::SkeletonJoint;

    fn turning(frames: usize) -> Clip {
        let skeleton = Skeleton::new(vec![
            SkeletonJoint::new("root", None, DVec3::ZERO),
            SkeletonJoint::new("arm", Some(0), DVec3::X),
        ])
        .expect("a tree");
        let mut channels =
            Clip::from_rest_pose(skeleton.clone().into(), FrameRate::new(10, 1).expect("rate"), frames).into_channels();
        for (i, q) in channels[0].rotations.iter_mut().enumerate() {
            *q = DQuat::from_rotation_y(i as f64 * 0.1);
        }
        Clip::new(skeleton.into(), FrameRate::new(10, 1).expect("rate"), channels).expect("a clip")
    }

    #[test]
    fn a_joint_path_equals_forward_kinematics_on_a_circle() {
        let clip = turning(20);
        for (frame, at) in clip.joint_path(1).into_iter().enumerate() {
            let angle = frame as f64 * 0.1;
            assert!(at.abs_diff_eq(DVec3::new(angle.cos(), 0.0, -angle.sin()), 1e-12));
            assert!(at.abs_diff_eq(clip.model_pose(frame).model_joint_position(1), 1e-12));
        }
    }

    #[test]
    fn sampling_interpolates_between_frames_and_holds_the_ends() {
        let clip = turning(5);
        let half = clip.sample_pose(RecordingInstant::from_seconds(0.15)).rotations[0];
        assert!(half.angle_between(DQuat::from_rotation_y(0.15)) < 1e-7);
        assert_eq!(
            clip.sample_pose(RecordingInstant::from_seconds(9.0)),
            clip.clip_pose_at(4)
        );
        assert_eq!(
            clip.sample_pose(RecordingInstant::from_seconds(-1.0)),
            clip.clip_pose_at(0)
        );
    }

    #[test]
    fn resampling_up_and_down_again_gives_the_frames_back() {
        let clip = turning(7);
        let fine = clip.resample_clip(FrameRate::new(40, 1).expect("rate"));
        assert_eq!(fine.clip_frame_count(), 25);
        let back = fine.resample_clip(clip.clip_frame_rate());
        assert_eq!(back.clip_frame_count(), 7);
        for frame in 0..7 {
            let (a, b) = (clip.clip_pose_at(frame), back.clip_pose_at(frame));
            assert!(a.rotations[0].angle_between(b.rotations[0]) < 1e-7);
        }
    }

    #[test]
    fn slices_compose_to_the_intersection() {
        let clip = turning(10);
        assert_eq!(
            clip.slice_clip_frames(2..9).slice_clip_frames(1..4),
            clip.slice_clip_frames(3..6)
        );
        assert_eq!(clip.slice_clip_frames(8..30).clip_frame_count(), 2);
        assert_eq!(clip.slice_clip_frames(20..30).clip_frame_count(), 0);
    }

    #[test]
    fn an_invalid_clip_is_refused_with_joint_and_frame() {
        let clip = turning(3);
        let mut channels = clip.clone().into_channels();
        channels[1].rotations[2] = DQuat::from_xyzw(0.0, 0.0, 0.0, 2.0);
        let error = Clip::new(clip.clip_skeleton().clone(), clip.clip_frame_rate(), channels).expect_err("no unit");
        assert_eq!(
            error,
            ClipError::Value {
                joint: "arm".into(),
                frame: 2
            }
        );
        let mut channels = clip.clone().into_channels();
        channels[1].rotations.pop();
        let error = Clip::new(clip.clip_skeleton().clone(), clip.clip_frame_rate(), channels).expect_err("short");
        assert_eq!(
            error,
            ClipError::Length {
                joint: "arm".into(),
                found: 2,
                expected: 3
            }
        );
    }
}
