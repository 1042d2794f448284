//! The terminal skin: the binary chereme.
fn main() {}
