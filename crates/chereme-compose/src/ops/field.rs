//! The common settings of operators, described for a form.

use std::ops::RangeInclusive;

use chereme_sign::words::Text;

use crate::recipe::{Spot, Transition};
use crate::units::{Direction, Factor, Hands, Length, Seconds};

/// A setting of an operator.
#[derive(Debug)]
pub struct Setting<'a> {
    /// The caption of its field.
    pub label: Text,
    /// The value, changed in place.
    pub field: Field<'a>,
}

impl<'a> Setting<'a> {
    /// Creates a setting from the caption of its field and its value.
    #[must_use]
    pub fn new(label: Text, field: Field<'a>) -> Self {
        Self { label, field }
    }

    /// Creates the usual setting for one hand or both.
    pub(crate) fn hands(hands: &'a mut Hands) -> Self {
        Self::new(Text::new("Hand", "Main"), Field::Hands(hands))
    }

    /// Creates the usual setting for a transition.
    pub(crate) fn via(via: &'a mut Transition) -> Self {
        Self::new(Text::new("Transition", "Transition"), Field::Via(via))
    }
}

/// The kinds of settings that operators share.
#[derive(Debug)]
pub enum Field<'a> {
    /// One hand or both.
    Hands(&'a mut Hands),
    /// One hand.
    Hand(&'a mut Hands),
    /// A count within a range.
    Count(&'a mut u32, RangeInclusive<u32>),
    /// A factor, with the range of a slider.
    Factor(&'a mut Factor, RangeInclusive<f64>),
    /// An optional factor, and its initial value in a form.
    OptionalFactor(&'a mut Option<Factor>, f64),
    /// A length, and the greatest length of a slider in metres or arms.
    Length(&'a mut Length, f64),
    /// An optional time in seconds, and its initial value in a form.
    Time(&'a mut Option<Seconds>, f64),
    /// Directions of the signer; opposite ones exclude each other.
    Directions(&'a mut Vec<Direction>),
    /// An optional place in the signing space.
    Spot(&'a mut Option<Spot>),
    /// The address of a sign.
    Sign(&'a mut String),
    /// A transition.
    Via(&'a mut Transition),
}
