//! Foreign files to and from the movement and sign models.

pub mod bvh;
pub mod eaf;
mod finding;
pub mod hns;
pub mod lexicon;
pub mod roles;
pub mod sigml;
pub mod subtitles;
pub mod table;
mod tally;
pub mod textgrid;

pub use finding::{Finding, Severity};
