//! The common settings of operators, described for a form.

use std::ops::RangeInclusive;

use crate::units::{Factor, Hands, Seconds};

/// A setting of an operator, with a name for looking up its labels.
#[derive(Debug)]
pub struct Setting<'a> {
    /// The name, such as `scale`.
    pub name: &'static str,
    /// The value, changed in place.
    pub field: Field<'a>,
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
    /// An optional time in seconds, and its initial value in a form.
    Time(&'a mut Option<Seconds>, f64),
    /// The address of a sign.
    Sign(&'a mut String),
    /// A transition.
    Via(&'a mut crate::recipe::Transition),
}
