//! The description of movement: tiers, component inventories, notation, keys.
//!
//! Signs differ in their *components*: the hand's configuration, its placement, movement and orientation, and the
//! activity of face and body. Annotators write them on tiers of a recording, with values from inventories; searches
//! ask for them by field. Everything here is plain data and pure functions on it.
//!
//! ```
//! use chereme_motion::{RecordingInstant, TimeSpan};
//! use chereme_sign::{AnnotationId, AskedTierChange, ComponentField, Tier, TierId, TierSet, inventory, plan_tier_change};
//!
//! let shapes = inventory::builtin_for(&"right.handshape".parse::<ComponentField>()?).expect("built in");
//! assert_eq!(shapes.find_inventory_value("bent-B").map(|shape| shape.value_name_in("fr")), Some("main plate pliée à la base"));
//!
//! let mut tiers = TierSet::new([Tier::root_tier(TierId(1), "gloss")], []);
//! let span = |from, to| TimeSpan::span_between(RecordingInstant::from_millis(from), RecordingInstant::from_millis(to));
//! let add = |from, to| AskedTierChange::Add { tier: TierId(1), span: span(from, to), value: "BOL".into() };
//! let mut ids = 0;
//! let mut fresh = || {
//!     ids += 1;
//!     AnnotationId(ids)
//! };
//! let edits = plan_tier_change(&tiers, &add(0, 400), &mut fresh)?;
//! tiers.apply_edits(edits);
//! let error = plan_tier_change(&tiers, &add(300, 700), &mut fresh).expect_err("annotations never overlap");
//! assert!(error.to_string().contains("start it at 0.400s or after"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | module | holds |
//! |---|---|
//! | [`component`] | components, hands, phases; fields as queries spell them; readings and the kinds of missing ones |
//! | [`tier`] | tiers, annotations, and the rules of ELAN's stereotypes for every change |
//! | [`relation`] | temporal relations between spans |
//! | [`inventory`] | the values of components as data, and those that come with the program |
//! | [`token`] | the component values of a gloss from the tiers around it |
//! | [`milestones`] | the times at which an expression of the face begins, changes and ends, relative to its signs |
//! | [`query`] | the query language |
//! | [`hamnosys`] | signs as notation: the tree that HamNoSys and SiGML write down |
//! | [`cue`] | cued speech: codes as data, phones to keys, French text to phones |
//! | [`remedy`] | remedies for errors and findings, typed by the programs in which they can be followed |
//! | [`text`] | folding of case and accents, and suggestions for misspelt words |
//! | [`tuned`] | documents of tuned numbers with their units and meanings |
//! | [`words`] | words in English and French, and the language of an interface |

pub mod component;
pub mod cue;
pub mod hamnosys;
pub mod inventory;
pub mod milestones;
pub mod query;
pub mod relation;
pub mod remedy;
pub mod text;
pub mod tier;
pub mod token;
pub mod tuned;
#[cfg(test)]
#[path = "../../../tests/shared/tuned_faults.rs"]
mod tuned_faults;
pub mod words;

pub use component::{
    ComponentField, ComponentReading, FieldError, HandRef, SignComponent, SignPhase, SignerHandedness,
};
pub use inventory::{ComponentInventory, InventoryError, InventoryValue};
pub use relation::{RelationError, TimeRelation};
pub use remedy::{ErrorRemedy, RemedyChoice};
pub use tier::{
    AnnotatedHands, AnnotationId, AskedTierChange, EditError, MergeSeam, RoleError, RoleWords, Tier, TierAnnotation,
    TierEdit, TierId, TierRole, TierSet, TierStereotype, TierTopic, TierViolation, check_tier_set, plan_tier_change,
};
