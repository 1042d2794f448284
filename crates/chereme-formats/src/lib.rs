//! Foreign files to and from the movement and sign models.

pub mod bvh;
pub mod eaf;
mod finding;
mod tally;

pub use finding::{Finding, Severity};
