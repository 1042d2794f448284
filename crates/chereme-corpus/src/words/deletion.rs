//! Words about deleted recordings and signs.

pub use crate::words::texts::deleting::*;
