//! FBX: skeletons with movement and the weights of blend shapes, as MotionBuilder, Maya, Shogun, Rokoko, Unreal
//! and Blender write them, binary or ASCII.
//!
//! The library `ufbx` parses the file and evaluates its curves, layers, pivots and pre-rotations; this module
//! chooses the nodes that are joints, folds scales into offsets, and finds rate and range. No other file is opened.

mod fbx_read;
mod joints;
#[cfg(test)]
mod tests;

pub use fbx_read::{FbxError, read_fbx};
