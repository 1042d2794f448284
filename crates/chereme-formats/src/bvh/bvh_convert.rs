//! Interprets a BVH file as a skeleton and its movement, and converts back.
//!
//! Everything here is in the file's own unit and axes; a [`SpaceConvention`](chereme_motion::SpaceConvention)
//! takes it to metres in model space. A position channel replaces its axis of the OFFSET, rotations
//! are multiplied in the order in which their channels are written, and scale channels are left out.

use std::sync::Arc;

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{
    Clip, ClipError, FrameRate, JointChannel as Movement, RateError, RotationOrder, Skeleton, SkeletonError,
    SkeletonJoint, SpaceAxis,
};

use super::raw::{BvhChannel, BvhHierarchy, ChannelFix, Column, ExactDecimal, FileNumber, RawJoint};

/// The frame rate of a file without a frame time, which only files of at most one frame may lack.
const UNTIMED_FRAME_RATE: (u32, u32) = (30, 1);

/// Returns the skeleton of a hierarchy, in the file's unit and axes; of several End Sites of a joint the
/// first is its tip. A joint's position is the one from its movement if known, else its offset.
///
/// # Errors
/// [`SkeletonError`] if the joints are not a tree; hierarchies from the reader always are.
pub fn skeleton_from_hierarchy(hierarchy: &BvhHierarchy) -> Result<Skeleton, SkeletonError> {
    let joint = |raw: &RawJoint| SkeletonJoint {
        tip: raw.end_sites.first().map(position_from_numbers),
        ..SkeletonJoint::new(
            raw.name.clone(),
            raw.parent,
            position_from_numbers(raw.placed.as_ref().unwrap_or(&raw.offset)),
        )
    };
    Skeleton::new(hierarchy.joints.iter().map(joint).collect())
}

fn position_from_numbers(numbers: &[FileNumber; 3]) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|axis| numbers[axis].to_f64()))
}

/// Returns the frame rate for a frame time; 30 frames per second if it is missing or not positive, which
/// the reader allows in files of at most one frame.
///
/// # Errors
/// [`RateError`] if the frame time is shorter than a microsecond or longer than a day.
pub fn rate_from_frame_time(frame_time: Option<&FileNumber>) -> Result<FrameRate, RateError> {
    let Some(time) = frame_time.filter(|time| time.to_f64() > 0.0) else {
        return FrameRate::new(UNTIMED_FRAME_RATE.0, UNTIMED_FRAME_RATE.1);
    };
    let text = time.to_string();
    let decimals = text.split_once('.').map_or(0, |(_, fraction)| fraction.len());
    FrameRate::from_frame_time(time.to_f64(), decimals as u32)
}

/// Builds a clip from the columns of a file, block by block.
pub struct ClipBuilder {
    skeleton: Arc<Skeleton>,
    /// Positions of the joints along axes without a position channel.
    offsets: Vec<DVec3>,
    layouts: Vec<JointChannelLayout>,
    movements: Vec<Movement>,
}

/// The columns of a joint's channels in the motion.
struct JointChannelLayout {
    positions: Vec<(SpaceAxis, usize)>,
    rotations: Vec<(SpaceAxis, usize)>,
}

const CHANNEL_AXES: [SpaceAxis; 3] = [SpaceAxis::X, SpaceAxis::Y, SpaceAxis::Z];
const POSITION_CHANNELS: [BvhChannel; 3] = [BvhChannel::Xposition, BvhChannel::Yposition, BvhChannel::Zposition];
const XYZ_ROTATIONS: [BvhChannel; 3] = [BvhChannel::Xrotation, BvhChannel::Yrotation, BvhChannel::Zrotation];
/// The order of rotations that most exporters write.
const EXPORTER_ROTATION_CHANNELS: [BvhChannel; 3] =
    [BvhChannel::Zrotation, BvhChannel::Xrotation, BvhChannel::Yrotation];

impl ClipBuilder {
    /// Starts a clip of a hierarchy; `fix` corrects the order of the root's columns if it differs from the
    /// header.
    ///
    /// # Errors
    /// The same as [`skeleton_from_hierarchy`]'s.
    pub fn new(hierarchy: &BvhHierarchy, fix: Option<ChannelFix>) -> Result<Self, SkeletonError> {
        let skeleton = Arc::new(skeleton_from_hierarchy(hierarchy)?);
        let layouts: Vec<JointChannelLayout> = hierarchy
            .joints
            .iter()
            .zip(hierarchy.joint_channel_columns())
            .enumerate()
            .map(|(at, (joint, columns))| {
                let fixed = fix
                    .filter(|_| at == 0)
                    .map(|fix| fix.apply_channel_fix(&joint.channels));
                let channels = fixed.as_ref().unwrap_or(&joint.channels);
                let of = |wanted: fn(BvhChannel) -> bool| {
                    let numbered = channels.iter().zip(columns.clone());
                    numbered
                        .filter(|(channel, _)| wanted(**channel))
                        .map(|(channel, column)| (CHANNEL_AXES[channel.channel_axis()], column))
                        .collect()
                };
                JointChannelLayout {
                    positions: of(BvhChannel::is_position),
                    rotations: of(BvhChannel::is_rotation),
                }
            })
            .collect();
        let movements = layouts
            .iter()
            .map(|layout| Movement {
                rotations: Vec::new(),
                translations: (!layout.positions.is_empty()).then(Vec::new),
            })
            .collect();
        Ok(Self {
            skeleton,
            offsets: hierarchy
                .joints
                .iter()
                .map(|joint| position_from_numbers(&joint.offset))
                .collect(),
            layouts,
            movements,
        })
    }

    /// Adds the rows `rows` of a block; `column` returns the columns that were read; joints without such
    /// columns stay at rest.
    pub fn push_block_rows<'c>(&mut self, rows: std::ops::Range<usize>, column: impl Fn(usize) -> Option<&'c Column>) {
        for (index, (layout, movement)) in self.layouts.iter().zip(&mut self.movements).enumerate() {
            let rotations: Vec<(SpaceAxis, &Column)> = layout
                .rotations
                .iter()
                .filter_map(|&(axis, at)| Some((axis, column(at)?)))
                .collect();
            movement.rotations.extend(rows.clone().map(|row| {
                rotations.iter().fold(DQuat::IDENTITY, |turned, (axis, column)| {
                    turned * axis.axis_rotation(column.decimal_value_at(row).to_radians())
                })
            }));
            let Some(translations) = &mut movement.translations else {
                continue;
            };
            let offset = self.offsets[index];
            let positions: Vec<(SpaceAxis, &Column)> = layout
                .positions
                .iter()
                .filter_map(|&(axis, at)| Some((axis, column(at)?)))
                .collect();
            translations.extend(rows.clone().map(|row| {
                let mut joint_place = offset;
                for (axis, column) in &positions {
                    joint_place[axis.index()] = column.decimal_value_at(row);
                }
                joint_place
            }));
        }
    }

    /// Returns the clip of all rows added.
    ///
    /// # Errors
    /// [`ClipError`] if a number is too large for a position.
    pub fn finish_bvh_clip(self, rate: FrameRate) -> Result<Clip, ClipError> {
        Clip::new(self.skeleton, rate, self.movements)
    }
}

/// Returns a hierarchy for a skeleton from another format: six channels at the root, three rotations in
/// the order ZXY elsewhere. Numbers have `decimals` digits after the point; braces and line ends in names,
/// which BVH cannot hold, become underscores.
#[must_use]
pub fn hierarchy_from_skeleton(skeleton: &Skeleton, decimals: u8) -> BvhHierarchy {
    let numbers = |at: DVec3| at.to_array().map(|value| number_with_decimals(value, decimals));
    let joints = skeleton
        .skeleton_joints()
        .iter()
        .map(|joint| {
            let positions = POSITION_CHANNELS.into_iter().filter(|_| joint.parent.is_none());
            RawJoint {
                name: writable(&joint.name),
                parent: joint.parent,
                offset: numbers(joint.offset),
                channels: positions.chain(EXPORTER_ROTATION_CHANNELS).collect(),
                end_sites: joint.tip.into_iter().map(numbers).collect(),
                placed: None,
            }
        })
        .collect();
    BvhHierarchy { joints }
}

/// Returns a name that a BVH line can hold: braces and line ends become underscores.
fn writable(name: &str) -> String {
    name.trim().replace(['{', '}', '\n', '\r'], "_")
}

pub(super) fn number_with_decimals(value: f64, decimals: u8) -> FileNumber {
    let large = || value.to_string().parse().unwrap_or(FileNumber::ZERO_NUMBER);
    ExactDecimal::from_rounded_value(value, decimals).map_or_else(large, FileNumber::Decimal)
}

/// Returns `hierarchy` with the channels added that `clip`, of the same joints, needs: position channels
/// for joints that leave their offset, and all three rotations for joints whose rotations their channels
/// cannot express.
#[must_use]
pub fn widen_hierarchy(hierarchy: &BvhHierarchy, clip: &Clip) -> BvhHierarchy {
    let mut wide = hierarchy.clone();
    for (joint, movement) in wide.joints.iter_mut().zip(clip.joint_channels()) {
        if leaves_its_offset(joint, movement) {
            joint.channels.retain(|channel| !channel.is_position());
            joint.channels.splice(0..0, POSITION_CHANNELS);
        }
        match RotationChannelOrder::from_raw_joint(joint) {
            Some(turning) if turning.says_all(&movement.rotations) => {}
            Some(turning) => joint.channels.extend(turning.missing_rotation_channels()),
            None => {
                joint.channels.retain(|channel| !channel.is_rotation());
                joint.channels.extend(EXPORTER_ROTATION_CHANNELS);
            }
        }
    }
    wide
}

fn leaves_its_offset(joint: &RawJoint, movement: &Movement) -> bool {
    let offset = position_from_numbers(&joint.offset);
    let fixed: Vec<usize> = POSITION_CHANNELS
        .into_iter()
        .filter(|channel| !joint.channels.contains(channel))
        .map(BvhChannel::channel_axis)
        .collect();
    let leaves = |at: &DVec3| fixed.iter().any(|&axis| (at[axis] - offset[axis]).abs() > 1e-9);
    movement.translations.iter().flatten().any(leaves)
}

/// The rotation channels of a joint, followed by the axes without a channel.
struct RotationChannelOrder {
    order: RotationOrder,
    written: usize,
}

impl RotationChannelOrder {
    /// Returns the rotation channels of a joint; `None` if an axis has two.
    fn from_raw_joint(joint: &RawJoint) -> Option<Self> {
        let rotations = joint.channels.iter().filter(|channel| channel.is_rotation());
        let mut axes: Vec<SpaceAxis> = rotations.map(|channel| CHANNEL_AXES[channel.channel_axis()]).collect();
        let written = axes.len();
        for axis in EXPORTER_ROTATION_CHANNELS.map(|channel| CHANNEL_AXES[channel.channel_axis()]) {
            if !axes.contains(&axis) {
                axes.push(axis);
            }
        }
        let order = <[SpaceAxis; 3]>::try_from(axes).ok().and_then(RotationOrder::new)?;
        Some(Self { order, written })
    }

    /// Returns the angles of rotations in radians, without jumps, in the order of the channels.
    fn continuous_channel_angles(&self, rotations: &[DQuat]) -> Vec<[f64; 3]> {
        let mut near = [0.0; 3];
        let next = |rotation: &DQuat| {
            near = self.order.nearest_euler_angles(*rotation, near);
            near
        };
        rotations.iter().map(next).collect()
    }

    /// Returns whether the written channels alone express the rotations.
    fn says_all(&self, rotations: &[DQuat]) -> bool {
        let unsaid = |angles: &[f64; 3]| angles[self.written..].iter().any(|a| a.abs() > 1e-7);
        self.written == 3 || !self.continuous_channel_angles(rotations).iter().any(unsaid)
    }

    /// Returns the channels that are not written.
    fn missing_rotation_channels(&self) -> Vec<BvhChannel> {
        let channel = |axis: &SpaceAxis| XYZ_ROTATIONS[axis.index()];
        self.order.rotation_axes()[self.written..].iter().map(channel).collect()
    }
}

/// A clip that the channels of a hierarchy cannot express.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum BackError {
    /// The clip and the hierarchy have different numbers of joints.
    #[error("the clip has {clip} joints and the hierarchy {hierarchy}")]
    Joints {
        /// The joints of the clip.
        clip: usize,
        /// The joints of the hierarchy.
        hierarchy: usize,
    },
    /// A joint turns about an axis without a rotation channel, or has two channels for one axis.
    #[error("the rotation channels of joint {joint:?} can't say how it turns; widen the hierarchy first")]
    Channels {
        /// The joint's name.
        joint: String,
    },
    /// A number has more than eighteen digits.
    #[error("joint {joint:?} is too far away to be written with {decimals} decimals")]
    TooLarge {
        /// The joint's name.
        joint: String,
        /// The requested decimals.
        decimals: u8,
    },
}

/// Returns the columns of `clip`, in the file's unit and axes, for the channels of `hierarchy`, with
/// `decimals` digits after the point; angles continue without jumps.
///
/// # Errors
/// [`BackError`] if the hierarchy does not fit the clip; see [`widen_hierarchy`].
pub fn columns_from_clip(clip: &Clip, hierarchy: &BvhHierarchy, decimals: u8) -> Result<Vec<Column>, BackError> {
    if clip.clip_skeleton().len() != hierarchy.joints.len() {
        let (clip, hierarchy) = (clip.clip_skeleton().len(), hierarchy.joints.len());
        return Err(BackError::Joints { clip, hierarchy });
    }
    let mut all = Vec::with_capacity(hierarchy.channel_count());
    for (index, joint) in hierarchy.joints.iter().enumerate() {
        let angles = joint_channel_angles(clip, index, joint)?;
        let mut next = 0;
        for channel in &joint.channels {
            let axis = channel.channel_axis();
            let values: Vec<f64> = if channel.is_rotation() {
                next += 1;
                angles.iter().map(|angles| angles[next - 1].to_degrees()).collect()
            } else if channel.is_position() {
                (0..clip.clip_frame_count())
                    .map(|frame| clip.joint_translation(index, frame)[axis])
                    .collect()
            } else {
                vec![1.0; clip.clip_frame_count()]
            };
            let too_large = || BackError::TooLarge {
                joint: joint.name.clone(),
                decimals,
            };
            all.push(Column::from_rounded_values(values, decimals).ok_or_else(too_large)?);
        }
    }
    Ok(all)
}

/// The angles of a joint in radians, frame by frame, in the order of its rotation channels.
fn joint_channel_angles(clip: &Clip, index: usize, joint: &RawJoint) -> Result<Vec<[f64; 3]>, BackError> {
    let rotations = &clip.joint_channel(index).rotations;
    match RotationChannelOrder::from_raw_joint(joint) {
        Some(turning) if turning.says_all(rotations) => Ok(turning.continuous_channel_angles(rotations)),
        _ => Err(BackError::Channels {
            joint: joint.name.clone(),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::super::raw::{BvhReader, MotionBlock};
    use super::*;

    const FILE: &str = "HIERARCHY\nROOT Hips\n{\nOFFSET 0 90 0\n\
        CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n\
        JOINT Chest\n{\nOFFSET 0 40 1.5\nCHANNELS 3 Yrotation Zrotation Xrotation\n\
        JOINT Arm\n{\nOFFSET 20 0 0\nCHANNELS 1 Zrotation\nEnd Site\n{\nOFFSET 30 0 0\n}\n}\n}\n}\n\
        MOTION\nFrames: 3\nFrame Time: 0.008333\n\
        1 91 2 10 20 30 5 -15 25 90\n1 92 2 11 21 31 6 -16 26 45\n1 93 2 12 22 32 7 -17 27 0\n";

    fn read() -> (BvhHierarchy, MotionBlock, Clip) {
        let mut reader = BvhReader::open_bvh(FILE.as_bytes()).expect("a file");
        let hierarchy = reader.bvh_hierarchy().clone();
        let rate = rate_from_frame_time(reader.bvh_motion_header().frame_time.as_ref()).expect("a rate");
        let mut block = MotionBlock::default();
        assert!(reader.next_block(&mut block).expect("rows"));
        let mut builder = ClipBuilder::new(&hierarchy, None).expect("a tree");
        builder.push_block_rows(0..block.frames, |at| block.columns.get(at));
        let clip = builder.finish_bvh_clip(rate).expect("a clip");
        (hierarchy, block, clip)
    }

    #[test]
    fn positions_replace_the_offset_and_rotations_multiply_as_written() {
        let (_, _, clip) = read();
        assert_eq!(
            (clip.clip_frame_count(), clip.clip_frame_rate()),
            (3, FrameRate::new(120, 1).expect("rate"))
        );
        assert_eq!(clip.joint_translation(0, 1), DVec3::new(1.0, 92.0, 2.0));
        assert_eq!(clip.joint_translation(1, 1), DVec3::new(0.0, 40.0, 1.5));
        let [z, x, y] = [10f64, 20.0, 30.0].map(f64::to_radians);
        let want = DQuat::from_rotation_z(z) * DQuat::from_rotation_x(x) * DQuat::from_rotation_y(y);
        assert!(clip.joint_channel(0).rotations[0].angle_between(want) < 1e-7);
        let arm = clip.model_pose(2);
        let tip = arm.bone_tip_position(clip.clip_skeleton(), 2).expect("a tip");
        assert!((tip.distance(arm.model_joint_position(2)) - 30.0).abs() < 1e-9);
    }

    #[test]
    fn converted_columns_read_back_unchanged() {
        let (hierarchy, block, clip) = read();
        assert_eq!(widen_hierarchy(&hierarchy, &clip), hierarchy);
        let back = columns_from_clip(&clip, &hierarchy, 6).expect("columns");
        for (at, column) in block.columns.iter().enumerate() {
            for frame in 0..3 {
                let (a, b) = (column.decimal_value_at(frame), back[at].decimal_value_at(frame));
                assert!((a - b).abs() < 2e-6, "column {at}, frame {frame}: {a} {b}");
            }
        }
        let again = hierarchy_of_same_shape(&clip);
        assert_eq!(again.joints.len(), 3);
    }

    #[test]
    fn channels_are_widened_for_movement_that_they_cannot_hold() {
        let (hierarchy, _, clip) = read();
        let (skeleton, rate) = (clip.clip_skeleton().clone(), clip.clip_frame_rate());
        let mut channels = clip.into_channels();
        channels[2].rotations[1] = DQuat::from_rotation_y(0.5);
        channels[1].translations = Some(vec![DVec3::X; 3]);
        let clip = Clip::new(skeleton, rate, channels).expect("a clip");
        let refused = columns_from_clip(&clip, &hierarchy, 6);
        assert!(matches!(refused, Err(BackError::Channels { joint }) if joint == "Arm"));
        let wide = widen_hierarchy(&hierarchy, &clip);
        assert_eq!(wide.joints[2].channels, EXPORTER_ROTATION_CHANNELS);
        assert_eq!(wide.joints[1].channels[..3], POSITION_CHANNELS);
        let back = columns_from_clip(&clip, &wide, 6).expect("columns");
        let angle = back.last().expect("columns").decimal_value_at(1).to_radians();
        assert!((angle - 0.5).abs() < 1e-7);

        let mut twice = hierarchy;
        let zxz = [BvhChannel::Zrotation, BvhChannel::Xrotation, BvhChannel::Zrotation];
        twice.joints[2].channels = zxz.to_vec();
        assert_eq!(
            widen_hierarchy(&twice, &clip).joints[2].channels,
            EXPORTER_ROTATION_CHANNELS
        );
    }

    #[test]
    fn a_missing_frame_time_means_30_frames_a_second() {
        let thirty = FrameRate::new(30, 1).expect("rate");
        for time in [None, Some("0"), Some("-0.01"), Some("0.033333"), Some("3.33333e-2")] {
            let number = time.map(|text| text.parse::<FileNumber>().expect(text));
            assert_eq!(rate_from_frame_time(number.as_ref()), Ok(thirty), "{time:?}");
        }
    }

    fn hierarchy_of_same_shape(clip: &Clip) -> BvhHierarchy {
        let made = super::hierarchy_from_skeleton(clip.clip_skeleton(), 6);
        let same = skeleton_from_hierarchy(&made).expect("a tree");
        assert_eq!(&same, clip.clip_skeleton().as_ref());
        made
    }

    #[test]
    fn joints_without_columns_stay_at_rest() {
        let (hierarchy, block, _) = read();
        let mut builder = ClipBuilder::new(&hierarchy, None).expect("a tree");
        builder.push_block_rows(1..3, |at| block.columns.get(at).filter(|_| at >= 6));
        let clip = builder
            .finish_bvh_clip(FrameRate::new(30, 1).expect("rate"))
            .expect("a clip");
        assert_eq!(clip.clip_frame_count(), 2);
        assert_eq!(clip.joint_translation(0, 0), DVec3::new(0.0, 90.0, 0.0));
        assert_eq!(clip.joint_channel(0).rotations[1], DQuat::IDENTITY);
        assert!(clip.joint_channel(1).rotations[0].angle_between(DQuat::IDENTITY) > 0.1);
    }
}
