//! Geometry and timing of articulated movement, as pure functions on values.
//!
//! Lengths are metres, angles radians, rotations unit quaternions. *Model space* is right-handed,
//! Y up, the signer facing +Z with the left side at +X; *local space* is that of a joint's parent.
//! No function reads files, depends on sign language, or uses unseeded randomness.
//!
//! ```
//! use chereme_motion::{Clip, SkeletonJoint, FrameRate, Skeleton, glam::DVec3};
//!
//! let skeleton = Skeleton::new(vec![
//!     SkeletonJoint::new("hips", None, DVec3::ZERO),
//!     SkeletonJoint::new("chest", Some(0), DVec3::new(0.0, 0.4, 0.0)),
//! ])?;
//! let clip = Clip::from_rest_pose(skeleton.into(), FrameRate::new(120, 1)?, 240);
//! assert_eq!(clip.clip_span().span_seconds(), 2.0);
//! assert_eq!(clip.model_pose(0).model_joint_position(1), DVec3::new(0.0, 0.4, 0.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | module | holds |
//! |---|---|
//! | [`time`] | instants, spans, frame rates |
//! | [`skeleton`] | joints, parents first, checked once |
//! | [`pose`] | local and model-space postures, forward kinematics |
//! | [`clip`] | movement: a skeleton's rotations over frames; slicing, sampling, resampling |
//! | [`markers`] | named points: optical markers, points estimated from film |
//! | [`curves`] | named scalar channels: face parameters, analog signals |
//! | [`column`](mod@column) | the numbers of a channel exactly as a file gives them, gaps as gaps |
//! | [`times`] | the times of a track's frames: at an even rate, or each with its own time |
//! | [`ends`] | odd first and last frames, and the movement between two rests |
//! | [`lapses`] | frames within a take whose movement was lost |
//! | [`euler`] | rotation orders and angles, as files write them |
//! | [`axes`] | units and axes of a file, and the conversion to model space and back |
//! | [`interpolation`] | the transitions from one posture to another |
//! | [`anatomy`] | the part of each joint, whatever its name; landmarks, measures, finger angles |
//! | [`hand`] | the posture of a hand as joint angles |
//! | [`wrist`] | angles of a hand on its forearm, and their limits |
//! | [`face`] | the posture of a face as a few numbers |
//! | [`fit`] | a skeleton that follows optical markers |
//! | [`ik`] | the position of the elbow when the wrist is moved |

pub use glam;

pub mod anatomy;
pub mod axes;
pub mod clip;
pub mod column;
pub mod curves;
pub mod ends;
pub mod euler;
pub mod face;
pub mod fit;
pub mod hand;
pub mod ik;
pub mod interpolation;
mod kept_text;
pub mod lapses;
pub mod markers;
pub mod pose;
pub mod skeleton;
pub mod time;
pub mod times;
pub mod wrist;

#[cfg(test)]
#[path = "../../../tests/shared/golden.rs"]
mod golden;
#[cfg(test)]
mod tests;

pub use anatomy::{
    ArmChain, AssignedJointRoles, BodyAnatomy, BodyPart, HandCorrection, HandRange, PartEvidence, RolesError,
};
pub use axes::{AxisDirection, SignerAxes, SpaceAxis, SpaceConvention};
pub use clip::{Clip, ClipError, JointChannel};
pub use column::FrameNumberColumn;
pub use curves::{CurveTrack, ScalarCurve, TrackError};
pub use euler::RotationOrder;
pub use face::FacePosture;
pub use hand::{BodySide, FingerAngles, HandAngles, HandFinger, ThumbAngles};
pub use interpolation::InterpolationKind;
pub use markers::{CaptureMethod, MarkerSpace, MarkerTrack, MotionMarker, QualityMeaning};
pub use pose::{LocalPose, ModelPose};
pub use skeleton::{Skeleton, SkeletonError, SkeletonJoint};
pub use time::{FrameRate, RateError, RecordingInstant, SpanError, TimeSpan};
pub use times::{FrameTimes, TimesError};
pub use wrist::{WristAngles, WristLimits};
