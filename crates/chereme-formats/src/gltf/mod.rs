//! glTF 2.0: writes movement as GLB for Blender, three.js and game engines, and reads skeletons with
//! movement.
//!
//! [`write_glb()`] makes a GLB with a skin, a small mesh of bones and the annotations, [`vrma`] the movement of a
//! humanoid for avatars; [`read_gltf`] returns the
//! skeleton, its movement and the weights of morph targets. Source: the glTF 2.0 specification of the
//! Khronos Group.

mod accessor;
mod avatar_face;
#[cfg(test)]
mod avatar_tests;
mod container;
mod error;
mod gltf_figure;
mod gltf_model;
mod gltf_read;
mod gltf_write;
mod rig;
mod sample;
#[cfg(test)]
mod tests;
pub mod vrma;

pub use crate::scene::BodyScene;
pub use error::GltfError;
pub use gltf_figure::{GlbFigure, GlbFigureBone, GlbFigureMorph, GlbVertex};
pub use gltf_read::read_gltf;
pub use gltf_write::{GlbDescription, MovementNote, write_glb, write_glb_with_figure};
