//! The HIERARCHY section as values.

use std::fmt;
use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::FileNumber;

/// The joints of a file in its own order, parents before their children.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct BvhHierarchy {
    /// The joints; the first is the root.
    pub joints: Vec<RawJoint>,
}

impl BvhHierarchy {
    /// Returns the number of channels of all joints: the columns of the motion.
    #[must_use]
    pub fn channel_count(&self) -> usize {
        self.joints.iter().map(|joint| joint.channels.len()).sum()
    }

    /// Returns the columns of the motion that are each joint's channels.
    #[must_use]
    pub fn joint_channel_columns(&self) -> Vec<Range<usize>> {
        let mut next = 0;
        let ranges = self.joints.iter().map(|joint| {
            let first = next;
            next += joint.channels.len();
            first..next
        });
        ranges.collect()
    }

    /// Returns the joint and the channel that a column of the motion belongs to.
    #[must_use]
    pub fn channel_at(&self, column: usize) -> Option<(&RawJoint, BvhChannel)> {
        let mut rest = column;
        for joint in &self.joints {
            match joint.channels.get(rest) {
                Some(&channel) => return Some((joint, channel)),
                None => rest -= joint.channels.len(),
            }
        }
        None
    }
}

/// One joint as the file writes it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct RawJoint {
    /// The name: the rest of the line after `ROOT` or `JOINT`, blanks inside kept.
    pub name: String,
    /// The index of the parent; `None` for the root.
    pub parent: Option<usize>,
    /// The position in the parent's frame, in the file's unit and axes.
    pub offset: [FileNumber; 3],
    /// The channels in the order written, which is the order of the columns and of the rotations.
    pub channels: Vec<BvhChannel>,
    /// The offsets of the End Sites: usually one on a leaf, but files may lack them, or have them next to
    /// children.
    pub end_sites: Vec<[FileNumber; 3]>,
    /// The position of the joint in its parent's frame according to the position channels (the median over
    /// the movement), if it differs from the offset. No file states it. See
    /// [`BonePositions`](crate::bvh::bones::BonePositions).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub placed: Option<[FileNumber; 3]>,
}

/// The quantity in a column of the motion: positions in the file's unit, rotations in degrees, scales as
/// factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum BvhChannel {
    /// Translation along X.
    Xposition,
    /// Translation along Y.
    Yposition,
    /// Translation along Z.
    Zposition,
    /// Rotation about X.
    Xrotation,
    /// Rotation about Y.
    Yrotation,
    /// Rotation about Z.
    Zrotation,
    /// Scale along X: an extension of some exporters.
    Xscale,
    /// Scale along Y: an extension of some exporters.
    Yscale,
    /// Scale along Z: an extension of some exporters.
    Zscale,
}

impl BvhChannel {
    /// Every channel with its word in files.
    pub const CHANNEL_WORDS: [(Self, &'static str); 9] = [
        (Self::Xposition, "Xposition"),
        (Self::Yposition, "Yposition"),
        (Self::Zposition, "Zposition"),
        (Self::Xrotation, "Xrotation"),
        (Self::Yrotation, "Yrotation"),
        (Self::Zrotation, "Zrotation"),
        (Self::Xscale, "Xscale"),
        (Self::Yscale, "Yscale"),
        (Self::Zscale, "Zscale"),
    ];

    /// Returns the channel that a word names, ignoring case.
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        Self::CHANNEL_WORDS
            .iter()
            .find(|(_, known)| known.eq_ignore_ascii_case(word))
            .map(|&(channel, _)| channel)
    }

    /// Returns the channel's word in files.
    #[must_use]
    pub fn channel_word(self) -> &'static str {
        Self::CHANNEL_WORDS[self as usize].1
    }

    /// Returns the axis: 0 for X, 1 for Y, 2 for Z.
    #[must_use]
    pub fn channel_axis(self) -> usize {
        self as usize % 3
    }

    /// Returns whether the channel is a translation.
    #[must_use]
    pub fn is_position(self) -> bool {
        matches!(self, Self::Xposition | Self::Yposition | Self::Zposition)
    }

    /// Returns whether the channel is a rotation.
    #[must_use]
    pub fn is_rotation(self) -> bool {
        matches!(self, Self::Xrotation | Self::Yrotation | Self::Zrotation)
    }
}

impl fmt::Display for BvhChannel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.channel_word())
    }
}
