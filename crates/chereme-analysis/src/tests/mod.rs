//! Golden tables: every number that the modules find in generated movement.

mod cued;
mod signals;
