//! Infers bones from the movement: the positions that position channels give a joint, however wrong its
//! offset is.
//!
//! Capture programs write position channels for every joint, and some write wrong offsets that nobody
//! notices: fingertips 60 cm from their fingers. The movement is right all the same, as position channels
//! replace the offset; but lengths and rest postures come from offsets.

use chereme_motion::glam::DVec3;

use super::convert::number;
use super::raw::{Block, Hierarchy};
use crate::scene;

/// The most frames from which a median is taken.
const MOST: usize = 2048;
/// Decimals of numbers in the file's unit.
const DECIMALS: u8 = 6;

/// Collects the positions of joints with position channels while a file is read.
#[derive(Debug, Clone)]
pub struct Bones {
    joints: Vec<Placed>,
    /// One frame out of this many is sampled.
    step: u64,
}

/// A joint that is not the root and has position channels.
#[derive(Debug, Clone)]
struct Placed {
    joint: usize,
    offset: DVec3,
    columns: Vec<(usize, usize)>,
    found: Vec<DVec3>,
}

impl Bones {
    /// Returns an estimator for a hierarchy, without frames yet. It leaves out joints that carry most of the body: their
    /// positions are in the room, not relative to a parent's bone.
    #[must_use]
    pub fn new(hierarchy: &Hierarchy) -> Self {
        let count = hierarchy.joints.len();
        let mut below = vec![1_usize; count];
        for joint in (0..count).rev() {
            if let Some(parent) = hierarchy.joints[joint].parent {
                below[parent] += below[joint];
            }
        }
        let joints = hierarchy.joints.iter().zip(hierarchy.columns()).enumerate();
        let joints = joints.filter(|(joint, _)| *joint > 0 && below[*joint] * 2 <= count);
        let joints = joints.filter_map(|(joint, (raw, columns))| {
            let columns = raw.channels.iter().zip(columns);
            let columns: Vec<(usize, usize)> = columns
                .filter(|(channel, _)| channel.is_position())
                .map(|(channel, column)| (channel.axis(), column))
                .collect();
            (!columns.is_empty()).then(|| Placed {
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
    pub fn push(&mut self, block: &Block) {
        for row in 0..block.frames {
            let frame = block.first_frame + row as u64;
            if !frame.is_multiple_of(self.step) {
                continue;
            }
            for placed in &mut self.joints {
                let mut at = placed.offset;
                for &(axis, column) in &placed.columns {
                    if let Some(column) = block.columns.get(column) {
                        at[axis] = column.value(row);
                    }
                }
                placed.found.push(at);
            }
            if self.joints.first().is_some_and(|it| it.found.len() >= MOST) {
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
    pub fn place(&self, hierarchy: &mut Hierarchy) -> Vec<usize> {
        let mut moved = Vec::new();
        for placed in &self.joints {
            let at = scene::placed(placed.offset, &placed.found);
            hierarchy.joints[placed.joint].placed =
                at.map(|at| at.to_array().map(|value| number(value, DECIMALS)));
            moved.extend(at.map(|_| placed.joint));
        }
        moved
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bvh::convert::skeleton;
    use crate::bvh::raw::{Block, Reader};

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
            let mut reader = Reader::open(text.as_bytes()).expect("a file");
            let mut hierarchy = reader.hierarchy().clone();
            let mut bones = Bones::new(&hierarchy);
            let mut block = Block::default();
            while reader.next_block(&mut block).expect("rows") {
                bones.push(&block);
            }
            let moved = bones.place(&mut hierarchy);
            assert!(
                moved.contains(&3) && !moved.contains(&2),
                "{frames}: {moved:?}"
            );
            assert_eq!(
                moved.contains(&4),
                frames == 1,
                "a marker that moves is no bone"
            );
            let skeleton = skeleton(&hierarchy).expect("a tree");
            let tip = skeleton.joint(3).offset;
            assert!(tip.distance(DVec3::new(2.1, 0.0, 0.0)) < 0.2, "{tip}");
            assert_eq!(hierarchy.joints[3].offset[0].to_string(), "60");
        }
    }
}
