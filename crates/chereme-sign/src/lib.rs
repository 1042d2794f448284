//! What is said about movement: tiers, component inventories, notation, keys.

pub mod component;
pub mod query;
pub mod relation;
pub mod text;
pub mod tier;

pub use component::{Component, Field, FieldError, HandRef, Handedness, Phase, Reading};
pub use relation::{Relation, RelationError};
pub use tier::{
    Annotation, AnnotationId, Change, Edit, EditError, Seam, Stereotype, Tier, TierId, TierRole,
    TierSet, Violation, check, plan,
};
