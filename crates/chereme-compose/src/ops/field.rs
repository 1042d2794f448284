//! The usual settings of operators, described for a form.

use std::ops::RangeInclusive;

use crate::units::{Factor, Hands, Seconds};

/// A setting of an operator, with the name under which its words are found.
#[derive(Debug)]
pub struct Setting<'a> {
    /// The name, such as `scale`.
    pub name: &'static str,
    /// The value, to be changed in place.
    pub field: Field<'a>,
}

/// The kinds of settings that many operators have.
#[derive(Debug)]
pub enum Field<'a> {
    /// One hand or both.
    Hands(&'a mut Hands),
    /// One hand.
    Hand(&'a mut Hands),
    /// A count in a range.
    Count(&'a mut u32, RangeInclusive<u32>),
    /// A factor, with the range of a slider.
    Factor(&'a mut Factor, RangeInclusive<f64>),
    /// A factor that may be left out, and the one to begin with.
    OptionalFactor(&'a mut Option<Factor>, f64),
    /// A time in seconds that may be left out, and the one to begin with.
    Time(&'a mut Option<Seconds>, f64),
    /// The address of a sign.
    Sign(&'a mut String),
    /// A transition.
    Via(&'a mut crate::recipe::Transition),
}
