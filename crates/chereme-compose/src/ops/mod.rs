//! The operators, one module each.

pub(crate) mod configure;
pub(crate) mod join;
pub(crate) mod mirror;
pub(crate) mod place;
pub(crate) mod repeat;
pub(crate) mod retarget;
pub(crate) mod reverse;
pub(crate) mod then;
