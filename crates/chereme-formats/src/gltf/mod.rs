//! glTF 2.0: writes movement as GLB for Blender, three.js and game engines, and reads skeletons with
//! movement.
//!
//! [`write()`] makes a GLB with a skin, a small mesh of bones and the annotations, [`vrma`] the movement of a
//! humanoid for avatars; [`read`] returns the
//! skeleton, its movement and the weights of morph targets. Source: the glTF 2.0 specification of the
//! Khronos Group.

mod accessor;
mod avatar_face;
#[cfg(test)]
mod avatar_tests;
mod container;
mod error;
mod model;
mod read;
mod rig;
mod sample;
#[cfg(test)]
mod tests;
pub mod vrma;
mod write;

pub use crate::scene::Scene;
pub use error::Error;
pub use read::read;
pub use write::{About, Note, write};
