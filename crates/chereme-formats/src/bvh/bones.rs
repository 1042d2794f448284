//! Infers bones from the movement: the positions that position channels give a joint, however wrong its
//! offset is.
//!
//! Capture programs write position channels for every joint, and some write wrong offsets that nobody
//! notices: fingertips 60 cm from their fingers. The movement is right all the same, as position channels
//! replace the offset; but lengths and rest postures come from offsets.

use chereme_motion::glam::DVec3;

use super::bvh_convert::number_with_decimals;
use super::raw::{BvhHierarchy, MotionBlock};
use crate::scene;

/// The most frames from which a median is taken.
const MAX_BONE_SAMPLE_FRAMES: usize = 2048;
/// Decimals of numbers in the file's unit.
const BONE_POSITION_DECIMALS: u8 = 6;

/// Collects the positions of joints with position channels while a file is read.
#[derive(Debug, Clone)]
pub struct BonePositions {
    joints: Vec<PositionedJoint>,
    /// One frame out of this many is sampled.
    step: u64,
}

/// A joint that is not the root and has position channels.
#[derive(Debug, Clone)]
struct PositionedJoint {
    joint: usize,
    offset: DVec3,
    columns: Vec<(usize, usize)>,
    found: Vec<DVec3>,
}

impl BonePositions {
    /// Returns an estimator for a hierarchy, without frames yet. It leaves out joints that carry most of the body: their
    /// positions are in the room, not relative to a parent's bone.
    #[must_use]
    pub fn new(hierarchy: &BvhHierarchy) -> Self {
        let count = hierarchy.joints.len();
        let mut below = vec![1_usize; count];
        // Parents come first in the file, so that going back, each joint is complete when its parent counts it.
        for joint in (0..count).rev() {
            if let Some(parent) = hierarchy.joints[joint].parent {
                below[parent] += below[joint];
            }
        }
        let indexed_joints = hierarchy
            .joints
            .iter()
            .zip(hierarchy.joint_channel_columns())
            .enumerate();
        let joints = indexed_joints.filter(|(joint, _)| *joint > 0 && below[*joint] * 2 <= count);
        let joints = joints.filter_map(|(joint, (raw, columns))| {
            let channel_columns = raw.channels.iter().zip(columns);
            let columns: Vec<(usize, usize)> = channel_columns
                .filter(|(channel, _)| channel.is_position())
                .map(|(channel, column)| (channel.channel_axis(), column))
                .collect();
            (!columns.is_empty()).then(|| PositionedJoint {
                joint,
                offset: DVec3::from_array([0, 1, 2].map(|axis| raw.offset[axis].to_f64())),
                columns,
                found: Vec::new(),
            })
        });
        Self {
            joints: joints.collect(),
            step: 1,
        }
    }

    /// Samples a block of frames; blocks come in order.
    pub fn sample_motion_block(&mut self, block: &MotionBlock) {
        for row in 0..block.frames {
            let frame = block.first_frame + row as u64;
            if !frame.is_multiple_of(self.step) {
                continue;
            }
            for placed in &mut self.joints {
                let mut placed_offset = placed.offset;
                for &(axis, column) in &placed.columns {
                    if let Some(column) = block.columns.get(column) {
                        placed_offset[axis] = column.decimal_value_at(row);
                    }
                }
                placed.found.push(placed_offset);
            }
            if self
                .joints
                .first()
                .is_some_and(|joint| joint.found.len() >= MAX_BONE_SAMPLE_FRAMES)
            {
                // Half of the samples go and later ones come half as often, so that the samples stay even over any
                // length.
                self.step *= 2;
                for placed in &mut self.joints {
                    let mut nth = 0;
                    placed.found.retain(|_| {
                        nth += 1;
                        nth % 2 == 1
                    });
                }
            }
        }
    }

    /// Records in the hierarchy the positions of joints whose movement contradicts their offsets; returns
    /// these joints.
    pub fn record_joint_positions(&self, hierarchy: &mut BvhHierarchy) -> Vec<usize> {
        let mut moved = Vec::new();
        for placed in &self.joints {
            let settled_place = scene::median_joint_place(placed.offset, &placed.found);
            hierarchy.joints[placed.joint].placed = settled_place.map(|at| {
                at.to_array()
                    .map(|value| number_with_decimals(value, BONE_POSITION_DECIMALS))
            });
            moved.extend(settled_place.map(|_| placed.joint));
        }
        moved
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bvh::bvh_convert::skeleton_from_hierarchy;
    use crate::bvh::raw::{BvhReader, MotionBlock};

    /// Hips, a chest with position channels, and a fingertip whose offset is 60 cm off; a marker that moves in the room.
    fn file(frames: usize) -> String {
        let six = "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation";
        let mut text = format!(
            "HIERARCHY\nROOT Hips\n{{\nOFFSET 0 0 0\n{six}\nJOINT Chest\n{{\nOFFSET 0 40 0\n{six}\n\
             JOINT Finger\n{{\nOFFSET 5 0 0\n{six}\nJOINT Tip\n{{\nOFFSET 60 3 0\n{six}\n}}\n}}\n}}\n\
             JOINT Marker\n{{\nOFFSET 1 1 1\n{six}\n}}\n}}\nMOTION\nFrames: {frames}\nFrame Time: 0.01\n"
        );
        for frame in 0..frames {
            let marker = (frame % 50) as f64 * 4.0;
            text += &format!(
                "0 90 0 0 0 0  0 40 0.1 0 0 0  5 0 0 0 0 0  2.{} 0 0 0 0 0  {marker} {marker} 3 0 0 0\n",
                frame % 3
            );
        }
        text
    }

    #[test]
    fn joint_positions_equal_those_of_the_movement() {
        for frames in [1, 700, 5000] {
            let text = file(frames);
            let mut reader = BvhReader::open_bvh(text.as_bytes()).expect("a file");
            let mut hierarchy = reader.bvh_hierarchy().clone();
            let mut bones = BonePositions::new(&hierarchy);
            let mut block = MotionBlock::default();
            while reader.next_block(&mut block).expect("rows") {
                bones.sample_motion_block(&block);
            }
            let moved = bones.record_joint_positions(&mut hierarchy);
            assert!(moved.contains(&3) && !moved.contains(&2), "{frames}: {moved:?}");
            assert_eq!(moved.contains(&4), frames == 1, "a marker that moves is no bone");
            let skeleton = skeleton_from_hierarchy(&hierarchy).expect("a tree");
            let tip = skeleton.joint_at(3).offset;
            assert!(tip.distance(DVec3::new(2.1, 0.0, 0.0)) < 0.2, "{tip}");
            assert_eq!(hierarchy.joints[3].offset[0].to_string(), "60");
        }
    }
}
