//! The operators, one module each.

pub(crate) mod clear;
pub(crate) mod configure;
pub(crate) mod cut;
pub(crate) mod expression;
pub(crate) mod join;
pub(crate) mod mirror;
pub(crate) mod nonmanual;
pub(crate) mod orient;
pub(crate) mod place;
pub(crate) mod point;
pub(crate) mod repeat;
pub(crate) mod retarget;
pub(crate) mod retime;
pub(crate) mod reverse;
pub(crate) mod say;
pub(crate) mod shape;
pub(crate) mod spell;
pub(crate) mod then;
