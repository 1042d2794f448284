//! Retrieval: which tokens answer a query.

mod directory;
pub(crate) mod index;
pub(crate) mod terms;
