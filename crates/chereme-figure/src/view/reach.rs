//! One camera for several clips: all signers are drawn equally large, at the same place of the picture.

use chereme_motion::{Anatomy, Clip, Part};
use glam::Vec3;

use super::{Framing, looks};

/// The space of signing around the hips of a signer, in metres to the left, up and forwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    low: Vec3,
    high: Vec3,
}

impl Reach {
    /// Returns the space of the signing of `clip`, as [`Framing::of`] measures it; `None` if the clip has no frames.
    #[must_use]
    pub fn of(clip: &Clip, anatomy: &Anatomy) -> Option<Self> {
        let framing = Framing::of(clip, anatomy)?;
        let hips = hips(&framing, clip, anatomy)?;
        Some(Self {
            low: framing.low - hips,
            high: framing.high - hips,
        })
    }

    /// Returns the space that holds both.
    #[must_use]
    pub fn joined(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// Returns this space around the hips of the signer of `clip`: framings of one reach give pictures of one size and
    /// scale. `None` if the clip has no frames.
    #[must_use]
    pub fn framing(&self, clip: &Clip, anatomy: &Anatomy) -> Option<Framing> {
        let own = Framing::of(clip, anatomy)?;
        let hips = hips(&own, clip, anatomy)?;
        Some(Framing {
            low: self.low + hips,
            high: self.high + hips,
            ..own
        })
    }
}

/// Returns the mean place of the hips along the axes of a framing; the middle of its space if the skeleton has none.
fn hips(framing: &Framing, clip: &Clip, anatomy: &Anatomy) -> Option<Vec3> {
    let Some(hips) = anatomy.joint(Part::Hips) else {
        return Some((framing.low + framing.high) * 0.5);
    };
    let poses = looks(clip, anatomy)?;
    let sum: Vec3 = poses
        .iter()
        .map(|pose| framing.against(pose, hips, anatomy))
        .sum();
    Some(sum / poses.len() as f32)
}
