//! One camera for several clips: all signers are drawn equally large, at the same place of the picture.

use chereme_motion::{BodyAnatomy, BodyPart, Clip};
use glam::Vec3;

use super::{ClipFraming, sample_clip_poses};

/// The space of signing around the hips of a signer, in metres to the left, up and forwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SigningReach {
    low: Vec3,
    high: Vec3,
}

impl SigningReach {
    /// Returns the space of the signing of `clip`, as [`ClipFraming::framing_from_clip`] measures it; `None` if the clip has no frames.
    #[must_use]
    pub fn reach_from_clip(clip: &Clip, anatomy: &BodyAnatomy) -> Option<Self> {
        let framing = ClipFraming::framing_from_clip(clip, anatomy)?;
        let hips = mean_hip_position(&framing, clip, anatomy)?;
        Some(Self {
            low: framing.low - hips,
            high: framing.high - hips,
        })
    }

    /// Returns the space that holds both.
    #[must_use]
    pub fn join_signing_reach(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// Returns this space around the hips of the signer of `clip`: framings of one reach give pictures of one size and
    /// scale. `None` if the clip has no frames.
    #[must_use]
    pub fn framing_for_clip(&self, clip: &Clip, anatomy: &BodyAnatomy) -> Option<ClipFraming> {
        let clip_framing = ClipFraming::framing_from_clip(clip, anatomy)?;
        let hips = mean_hip_position(&clip_framing, clip, anatomy)?;
        Some(ClipFraming {
            low: self.low + hips,
            high: self.high + hips,
            ..clip_framing
        })
    }
}

/// Returns the mean place of the hips along the axes of a framing; the middle of its space if the skeleton has none.
fn mean_hip_position(framing: &ClipFraming, clip: &Clip, anatomy: &BodyAnatomy) -> Option<Vec3> {
    let Some(hips) = anatomy.part_joint(BodyPart::Hips) else {
        // Without hips the middle of the space is the best anchor that is left.
        return Some((framing.low + framing.high) * 0.5);
    };
    let poses = sample_clip_poses(clip, anatomy)?;
    let sum: Vec3 = poses
        .iter()
        .map(|pose| framing.relative_joint_position(pose, hips, anatomy))
        .sum();
    Some(sum / poses.len() as f32)
}
