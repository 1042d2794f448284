//! The shared parts of the tests across crates: small files as people would have them, processes at work on a
//! corpus, and the repository itself.

pub mod files;
pub mod repository;
pub mod study;
pub mod workers;
