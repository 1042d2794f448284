//! Foreign files to and from the movement and sign models.

mod finding;

pub use finding::{Finding, Severity};
