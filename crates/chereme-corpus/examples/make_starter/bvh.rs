//! Writes a clip as BVH: centimetres, degrees.

use chereme_formats::bvh::raw::{
    BvhChannel, BvhHierarchy, BvhWriter, Column, ExactDecimal, FileNumber, MotionBlock, RawJoint,
};
use chereme_motion::glam::DVec3;
use chereme_motion::{Clip, SpaceAxis};

use super::signer::rotation_order;

/// The number of decimals of positions and of angles; for fingers, whose bones are short, one less.
const DIGITS: u8 = 3;

/// Returns the bytes of the file.
pub(crate) fn write(clip: &Clip) -> Vec<u8> {
    let hierarchy = BvhHierarchy {
        joints: (0..clip.clip_skeleton().len())
            .map(|joint| raw_joint(clip, joint))
            .collect(),
    };
    let columns: Vec<Column> = (0..clip.clip_skeleton().len())
        .flat_map(|joint| columns(clip, joint))
        .collect();
    let frame_time = number(clip.clip_frame_rate().frame_time(), 7);
    let frames = clip.clip_frame_count();
    let block = MotionBlock {
        first_frame: 0,
        frames,
        columns,
    };
    let out = BvhWriter::new(Vec::new(), &hierarchy, Some((Some(&frame_time), frames as u64)));
    let written = out.and_then(|mut out| {
        out.write_motion_block(&block)?;
        out.finish_bvh_writing()
    });
    written.expect("the hierarchy and its columns belong together")
}

fn raw_joint(clip: &Clip, joint: usize) -> RawJoint {
    let it = clip.clip_skeleton().joint_at(joint);
    let offset = |v: DVec3| (v * 100.0).to_array().map(|x| number(x, DIGITS));
    let root = it.parent.is_none();
    let positions = [BvhChannel::Xposition, BvhChannel::Yposition, BvhChannel::Zposition];
    let rotations = rotation_order(&it.name).rotation_axes().map(|axis| match axis {
        SpaceAxis::X => BvhChannel::Xrotation,
        SpaceAxis::Y => BvhChannel::Yrotation,
        SpaceAxis::Z => BvhChannel::Zrotation,
    });
    RawJoint {
        name: it.name.clone(),
        parent: it.parent,
        offset: offset(it.offset),
        channels: positions.into_iter().filter(|_| root).chain(rotations).collect(),
        end_sites: it.tip.map(offset).into_iter().collect(),
        placed: None,
    }
}

fn columns(clip: &Clip, joint: usize) -> Vec<Column> {
    let mut columns: Vec<Vec<f64>> = Vec::new();
    if clip.clip_skeleton().joint_parent(joint).is_none() {
        let places = (0..clip.clip_frame_count()).map(|frame| clip.joint_translation(joint, frame) * 100.0);
        let places: Vec<DVec3> = places.collect();
        columns.extend([0, 1, 2].map(|axis| places.iter().map(|place| place[axis]).collect()));
    }
    let order = rotation_order(&clip.clip_skeleton().joint_at(joint).name);
    let mut near = [0.0; 3];
    let turns: Vec<[f64; 3]> = clip
        .joint_channel(joint)
        .rotations
        .iter()
        .map(|&q| {
            near = order.nearest_euler_angles(q, near);
            near.map(f64::to_degrees)
        })
        .collect();
    columns.extend([0, 1, 2].map(|n| turns.iter().map(|turn| turn[n]).collect()));
    let name = &clip.clip_skeleton().joint_at(joint).name;
    let finger = name.contains("Hand") && name.ends_with(char::is_numeric);
    let digits = if finger { DIGITS - 1 } else { DIGITS };
    columns.iter().map(|values| column(values, digits)).collect()
}

/// Returns a column; a column with the same whole number throughout is written without decimals.
fn column(values: &[f64], digits: u8) -> Column {
    let rounded = |digits| Column::from_rounded_values(values.iter().copied(), digits);
    let column = rounded(digits).expect("angles and places are finite");
    let first = column.mantissas.first().copied().unwrap_or(0);
    let still = column.mantissas.iter().all(|&mantissa| mantissa == first);
    if still && first % 10i64.pow(u32::from(digits)) == 0 {
        return rounded(0).expect("angles and places are finite");
    }
    column
}

fn number(value: f64, digits: u8) -> FileNumber {
    FileNumber::Decimal(ExactDecimal::from_rounded_value(value, digits).expect("offsets are finite"))
}
