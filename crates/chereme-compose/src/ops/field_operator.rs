//! The common settings of operators, described for a form.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use chereme_sign::words::InterfaceText;

use crate::face_parts::FacePart;
use crate::recipe_settings::{PostureTransition, SigningSpot};
use crate::units::{BodyDirection, HandChoice, RecipeFactor, RecipeLength, RecipeSeconds};

/// A setting of an operator.
#[derive(Debug)]
pub struct OperatorSetting<'a> {
    /// The caption of its field.
    pub label: InterfaceText,
    /// The value, changed in place.
    pub field: OperatorField<'a>,
}

impl<'a> OperatorSetting<'a> {
    /// Creates a setting from the caption of its field and its value.
    #[must_use]
    pub fn new(label: InterfaceText, field: OperatorField<'a>) -> Self {
        Self { label, field }
    }

    /// Creates the usual setting for one hand or both.
    pub(crate) fn hands_field_setting(hands: &'a mut HandChoice) -> Self {
        Self::new(InterfaceText::from_id("setting-hand"), OperatorField::Hands(hands))
    }

    /// Creates the usual setting for a transition.
    pub(crate) fn transition_field_setting(via: &'a mut PostureTransition) -> Self {
        Self::new(InterfaceText::from_id("setting-transition"), OperatorField::Via(via))
    }
}

/// The kinds of settings that operators share.
#[derive(Debug)]
pub enum OperatorField<'a> {
    /// One hand or both.
    Hands(&'a mut HandChoice),
    /// One hand.
    Hand(&'a mut HandChoice),
    /// A count within a range.
    Count(&'a mut u32, RangeInclusive<u32>),
    /// A factor, with the range of a slider.
    Factor(&'a mut RecipeFactor, RangeInclusive<f64>),
    /// An optional factor, and its initial value in a form.
    OptionalFactor(&'a mut Option<RecipeFactor>, f64),
    /// A length, and the greatest length of a slider in metres or arms.
    Length(&'a mut RecipeLength, f64),
    /// An optional time in seconds, and its initial value in a form.
    Time(&'a mut Option<RecipeSeconds>, f64),
    /// Directions of the signer; opposite ones exclude each other.
    Directions(&'a mut Vec<BodyDirection>),
    /// An optional place in the signing space.
    Spot(&'a mut Option<SigningSpot>),
    /// The address of a sign.
    Sign(&'a mut String),
    /// The address of a body.
    Body(&'a mut String),
    /// Values of the parts of the face.
    Face(&'a mut BTreeMap<FacePart, String>),
    /// A transition.
    Via(&'a mut PostureTransition),
}
