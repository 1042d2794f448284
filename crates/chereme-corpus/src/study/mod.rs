//! Perceptual studies: what people see in signs.

pub mod answers;
pub mod order;
pub mod plan;
