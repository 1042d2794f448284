//! Biovision Hierarchy (BVH): a skeleton and its captured channels, as text.
//!
//! [`raw`] mirrors the file, number by number, and writes it back equal; [`bvh_convert`] interprets it, and
//! [`bones`] infers the positions of joints from the movement. The format has no standard; the nearest
//! document is the description by Lander, "Working with Motion Capture File Formats", Game Developer,
//! January 1998. Deviations of real exporters are tolerated if their meaning is clear.

pub mod bones;
pub mod bvh_convert;
pub mod raw;
