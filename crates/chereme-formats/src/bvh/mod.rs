//! Biovision Hierarchy (BVH): a skeleton and its captured channels, as text.
//!
//! [`raw`] says what the file says, number by number, and writes it back equal; [`convert`] says what we mean by it,
//! [`bones`] where the movement puts joints.
//! The format has no standard; the nearest to one is the description by Lander, "Working with Motion Capture File
//! Formats", Game Developer, January 1998. What real exporters make of it is tolerated where its meaning is clear.

pub mod bones;
pub mod convert;
pub mod raw;
