//! Perceptual studies: what people see in signs.

pub mod answers;
pub mod plan;
