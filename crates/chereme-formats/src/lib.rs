//! Reads and writes foreign files: translates them to the models of movement and signs, and back.

pub mod anvil;
pub mod avatar_rig;
pub mod bvh;
pub mod c3d;
pub mod compare;
pub mod curves;
pub mod eaf;
pub mod exmaralda;
pub mod faces;
#[cfg(feature = "fbx")]
pub mod fbx;
mod finding;
pub mod gltf;
#[cfg(test)]
#[path = "../../../tests/shared/golden.rs"]
mod golden;
pub mod hns;
pub mod keypoints;
pub mod lexicon;
mod markup;
pub mod mp4;
mod noughts;
pub mod points;
pub mod pose;
mod reach;
pub mod roles;
mod scene;
pub mod sigml;
pub mod signstream;
pub mod subtitles;
pub mod table;
mod tally;
#[cfg(test)]
mod tests;
pub mod textgrid;
pub mod timecode;
pub mod tracks;
pub mod transcript;
pub mod trc;
mod windows_1252;
pub mod xra;

pub use finding::{FindingSeverity, ImportFinding, ReaderCorrection};
pub use markup::MarkupError;
pub use reach::TooFar;
pub use scene::BodyScene;
