//! Files whose root columns are in another order than CHANNELS.

use serde::{Deserialize, Serialize};

use super::{BvhChannel, BvhHierarchy, MotionBlock};

/// The actual order of the root's columns, if it differs from the order in CHANNELS.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ChannelFix {
    /// The three rotations come before the three positions.
    RotationBeforePosition,
}

impl ChannelFix {
    /// Returns the root's channels in the actual order of the columns.
    ///
    /// The order among the rotations, and among the positions, is that of the file.
    #[must_use]
    pub fn apply_channel_fix(self, channels: &[BvhChannel]) -> Vec<BvhChannel> {
        match self {
            Self::RotationBeforePosition => {
                let mut fixed = channels.to_vec();
                fixed.sort_by_key(|channel| channel.is_position());
                fixed
            }
        }
    }
}

/// Observes whether the columns that should be the root's rotation stay at the root's OFFSET.
#[derive(Debug)]
pub(super) struct RootOrder {
    /// The OFFSET in the order of the position channels.
    offset: [f64; 3],
    tolerance: f64,
    suspect: bool,
    frames: u64,
}

impl RootOrder {
    pub(super) fn new(hierarchy: &BvhHierarchy) -> Self {
        let mut offset = [0.0; 3];
        let mut suspect = false;
        if let Some(root) = hierarchy.joints.first().filter(|root| root.channels.len() == 6) {
            let (first, last) = root.channels.split_at(3);
            suspect = first.iter().all(|c| c.is_position()) && last.iter().all(|c| c.is_rotation());
            // CHANNELS may name the axes in any order.
            for (value, channel) in offset.iter_mut().zip(first) {
                *value = root.offset[channel.channel_axis()].to_f64();
            }
        }
        let length = offset.iter().map(|v| v * v).sum::<f64>().sqrt();
        Self {
            offset,
            tolerance: 0.1 * length,
            // An OFFSET of zero is what a body at rest has for rotations, too.
            suspect: suspect && length > 0.0,
            frames: 0,
        }
    }

    pub(super) fn watch_motion_block(&mut self, block: &MotionBlock) {
        if !self.suspect {
            return;
        }
        self.frames += block.frames as u64;
        let near = |first: usize, frame: usize| {
            let place = self.offset.iter().zip(block.columns.iter().skip(first));
            let far = place
                .map(|(offset, column)| (column.decimal_value_at(frame) - offset).powi(2))
                .sum::<f64>()
                .sqrt();
            far <= self.tolerance
        };
        self.suspect = (0..block.frames).all(|frame| near(3, frame) && !near(0, frame));
    }

    /// Returns the correction, if all frames agree with it.
    pub(super) fn root_channel_fix(&self) -> Option<ChannelFix> {
        (self.suspect && self.frames > 0).then_some(ChannelFix::RotationBeforePosition)
    }
}
